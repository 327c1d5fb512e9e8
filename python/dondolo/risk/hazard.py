"""Hazard curves: how often an intensity is exceeded.

Levels and frequencies are joined by straight lines of ln H against ln x, so that between two levels H is a power law,
H(x) = H_j (x/x_j)^-k_j. Nothing is known beyond the levels.

Units are those of dondolo: accelerations in g, all else in SI units. Hazard is often published as a return period,
H = 1/T, or as the probability p of being exceeded in t years, H = -ln(1 - p)/t.
"""

from __future__ import annotations

import os
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from dondolo._base.arguments import FloatArray, as_array, as_levels, as_number, increasing, shaped
from dondolo._base.files import as_file
from dondolo._base.shown import Shown
from dondolo._fortran.records import describe_measure, levels_in_words, unit_of
from dondolo._storage import tables
from dondolo._storage.saved import Saved
from dondolo.errors import InputError
from dondolo.risk.hazard_table import read_hazard


@dataclass(frozen=True, eq=False, repr=False, init=False)
class HazardCurve(Shown, Saved):
    """Mean annual frequency with which an intensity is exceeded, a power law between each two levels.

    Parameters
    ----------
    levels : array_like, shape (levels,)
        Levels of intensity, positive and increasing, in the unit of dondolo; at least two.
    annual_frequency : array_like, shape (levels,)
        Mean annual frequency of exceedance of each, positive and not increasing [1/year].
    im : str
        Intensity measure.

    Raises
    ------
    InputError
        Levels and frequencies that are no hazard curve; a measure that is not known.

    Attributes
    ----------
    levels : ndarray, shape (levels,)
        In the unit of the measure: accelerations in g, all else in SI units.
    annual_frequency : ndarray, shape (levels,)
        [1/year].
    im : str
    endless : bool
        Do the power laws of the first and the last step go on beyond the levels? Only those of `power_law` do.

    Examples
    --------
    >>> import dondolo as dd
    >>> hazard = dd.HazardCurve([0.1, 0.2, 0.4], [0.01, 0.002, 0.0002])
    >>> round(hazard(0.2), 6)
    0.002
    """

    levels: FloatArray
    annual_frequency: FloatArray
    im: str
    endless: bool

    def __init__(self, levels: ArrayLike, annual_frequency: ArrayLike, *, im: str = "pga") -> None:
        x = increasing("levels", levels)
        h = as_array("annual_frequency", annual_frequency).copy()
        if len(x) != len(h):
            raise InputError(f"{len(x)} levels, {len(h)} annual_frequency: must be as many")
        wrong = ~((h > 0.0) & (h < np.inf))
        if wrong.any():
            hint = "; leave out the levels that are never exceeded" if h[wrong][0] == 0.0 else ""
            raise InputError(f"annual_frequency = {h[wrong][0]:g}: must be positive{hint}")
        rises = h[1:] > h[:-1]
        if rises.any():
            i = int(np.argmax(rises))
            raise InputError(f"annual_frequency = {h[i]:.15g}, {h[i + 1]:.15g}: must not increase with the level")
        h.flags.writeable = False
        for what, value in (
            ("levels", x),
            ("annual_frequency", h),
            ("im", describe_measure(im).name),
            ("endless", False),
        ):
            object.__setattr__(self, what, value)

    @classmethod
    def power_law(cls, k0: float, k: float, *, im: str = "pga") -> HazardCurve:
        """H(x) = k0 x^-k for all x > 0.

        Parameters
        ----------
        k0 : float
            Annual frequency with which an intensity of 1 is exceeded, positive [1/year].
        k : float
            Slope on logarithmic axes, positive; 1 to 4 for most sites.
        im : str
            Intensity measure.

        Returns
        -------
        HazardCurve
            `endless`: the power law itself, without a lowest and a highest level.

        Raises
        ------
        InputError
            k0 or k is not positive; a measure that is not known.
        """
        for what, value in (("k0", k0), ("k", k)):
            if not 0.0 < as_number(what, value) < np.inf:
                raise InputError(f"{what} = {value:g}: must be positive")
        levels = np.array([0.5, 2.0])
        curve = cls(levels, k0 * levels**-k, im=im)
        object.__setattr__(curve, "endless", True)
        return curve

    @classmethod
    def from_csv(cls, path: str | os.PathLike[str]) -> HazardCurve:
        """Read a hazard curve.

        Parameters
        ----------
        path : path
            A CSV table. One column is the levels: its title is the intensity measure, or 'ag' with its unit, 'ag (g)',
            'ag (g/10)' or 'ag (m/s2)', which is the PGA. Another says how often they are exceeded: 'annual_frequency'
            [1/year], 'return_period' [years] or 'poe', the probability of exceedance in 'investigation_time' [years],
            a third column. 'TR', 'F0' and 'TC*' of the Italian code's tables are known, and the last two not used.
            Lines that begin with # are comments::

                # my site, soil class A
                pga,annual_frequency
                0.05,0.02
                0.1,0.006

        Returns
        -------
        HazardCurve

        Raises
        ------
        InputError
            The file cannot be read, or is no such table; a cell is no number; what it holds is no hazard curve.

        Notes
        -----
        ag of the Italian code is that of rigid, level ground: multiply it by the factors of soil and topography of the
        site. Tables of spreadsheets with semicolons and decimal commas are read as those of walls and records are.
        """
        name = os.fspath(as_file("path", path))
        im, levels, frequency = read_hazard(name)
        try:
            return cls(levels, frequency, im=im)
        except InputError as error:
            raise InputError(f"{name}: {error}") from None

    def __call__(self, x: ArrayLike) -> Any:
        """Annual frequency with which intensities are exceeded.

        Parameters
        ----------
        x : array_like
            Intensities, not negative.

        Returns
        -------
        float or ndarray, shape of x
            [1/year]; NaN beyond the levels, where nothing is known.

        Raises
        ------
        InputError
            Intensities that are negative or no numbers.
        """
        values = as_levels(x)
        flat = values.ravel()
        with np.errstate(divide="ignore", over="ignore"):
            u = np.log(flat)
            k, start, frequency = self._power_laws(u)
            h = frequency * np.exp(-k * (u - start))
        return shaped(np.where(self._covers(flat), h, np.nan), values)

    def _covers(self, x: FloatArray) -> Any:
        """Where is the curve given?"""
        return ((x >= self.levels[0]) & (x <= self.levels[-1])) | self.endless

    def _power_laws(self, u: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Of the step at u = ln x: exponent, and ln level and frequency where it begins; the outer ones go on."""
        known, slope = np.log(self.levels), self._slopes()
        step = np.clip(np.searchsorted(known, u, side="right") - 1, 0, len(slope) - 1)
        return slope[step], known[step], self.annual_frequency[step]

    def _slopes(self) -> FloatArray:
        """Exponents k of the power laws of each step."""
        # No -0 where two frequencies are the same
        return 0.0 - np.diff(np.log(self.annual_frequency)) / np.diff(np.log(self.levels))

    def to_frame(self) -> Any:
        """The curve as a pandas DataFrame."""
        return tables.frame({self.im: self.levels, "annual_frequency": self.annual_frequency})

    def to_csv(self, path: str | os.PathLike[str]) -> None:
        """Write the curve as `from_csv` reads it."""
        comments = [f"unit of {self.im}: {unit_of(self.im) or '1'}, of annual_frequency: 1/year"]
        tables.write_csv(path, {self.im: self.levels, "annual_frequency": self.annual_frequency}, comments)

    def _facts(self) -> list[tuple[str, str]]:
        if self.endless:
            k = float(self._slopes()[0])
            return [("power law", f"{self(1.0):.4g} {self.im}^-{k:.4g} a year")]
        return [
            ("levels", levels_in_words(self.levels, self.im)),
            ("exceeded", f"{self.annual_frequency[0]:.3g} to {self.annual_frequency[-1]:.3g} times a year"),
        ]
