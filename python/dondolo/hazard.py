"""Hazard curves: how often an intensity is exceeded.

Levels and frequencies are joined by straight lines of ln H against ln x, so that between two levels H is a power law,
H(x) = H_j (x/x_j)^-k_j. Nothing is known beyond the levels.

Units are those of dondolo: accelerations in g, all else in SI units. Hazard is often published as a return period,
H = 1/T, or as the probability p of being exceeded in t years, H = -ln(1 - p)/t.
"""

from __future__ import annotations

import csv
import os
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from dondolo import _binding, tables
from dondolo._arguments import FloatArray, as_array, as_levels, as_number, shaped
from dondolo.errors import InputError


@dataclass(frozen=True, eq=False, repr=False, init=False)
class HazardCurve:
    """Mean annual frequency with which an intensity is exceeded, a power law between each two levels.

    Parameters
    ----------
    im_levels : array_like, shape (levels,)
        Levels of intensity, positive and increasing, in the unit of dondolo; at least two.
    annual_frequency : array_like, shape (levels,)
        Mean annual frequency of exceedance of each, positive and not increasing [1/year].
    im : str
        Intensity measure.

    Attributes
    ----------
    im_levels, annual_frequency : ndarray, shape (levels,)
    im : str
    endless : bool
        Do the power laws of the first and the last step go on beyond the levels? Only those of `power_law` do.

    Examples
    --------
    >>> hazard = HazardCurve([0.1, 0.2, 0.4], [0.01, 0.002, 0.0002])
    >>> round(hazard(0.2), 6)
    0.002
    """

    im_levels: FloatArray
    annual_frequency: FloatArray
    im: str
    endless: bool

    def __init__(self, im_levels: ArrayLike, annual_frequency: ArrayLike, im: str = "pga") -> None:
        x = as_array("im_levels", im_levels).copy()
        h = as_array("annual_frequency", annual_frequency).copy()
        if len(x) != len(h):
            raise InputError(f"{len(x)} im_levels, {len(h)} annual_frequency: must be as many")
        if len(x) < 2:
            raise InputError("im_levels: must be two at least")
        for what, values in (("im_levels", x), ("annual_frequency", h)):
            wrong = ~((values > 0.0) & (values < np.inf))
            if wrong.any():
                hint = "; leave out the levels that are never exceeded" if what == "annual_frequency" else ""
                raise InputError(f"{what} = {values[wrong][0]:g}: must be positive{hint}")
        for what, values, falls in (
            ("im_levels = {:g}, {:g}: must increase strictly", x, x[1:] <= x[:-1]),
            ("annual_frequency = {:g}, {:g}: must not increase with the level", h, h[1:] > h[:-1]),
        ):
            if falls.any():
                i = int(np.argmax(falls))
                raise InputError(what.format(values[i], values[i + 1]))
        for array in (x, h):
            array.flags.writeable = False
        for what, value in (
            ("im_levels", x),
            ("annual_frequency", h),
            ("im", _binding.describe_measure(im).name),
            ("endless", False),
        ):
            object.__setattr__(self, what, value)

    @classmethod
    def power_law(cls, k0: float, k: float, im: str = "pga") -> HazardCurve:
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
        """
        for what, value in (("k0", k0), ("k", k)):
            if not 0.0 < as_number(what, value) < np.inf:
                raise InputError(f"{what} = {value:g}: must be positive")
        levels = np.array([0.5, 2.0])
        curve = cls(levels, k0 * levels**-k, im)
        object.__setattr__(curve, "endless", True)
        return curve

    @classmethod
    def from_csv(cls, path: str | os.PathLike[str]) -> HazardCurve:
        """Read a hazard curve.

        Parameters
        ----------
        path : path
            A CSV file of two columns: the levels, whose head names the intensity measure, and 'annual_frequency'. Lines
            that begin with # are comments::

                # my site, soil class A
                pga,annual_frequency
                0.05,0.02
                0.1,0.006

        Returns
        -------
        HazardCurve
        """
        name = os.fspath(path)
        try:
            lines = Path(path).read_text(encoding="utf-8-sig").splitlines()
        except (OSError, UnicodeDecodeError) as error:
            reason = error.strerror if isinstance(error, OSError) else "not UTF-8"
            raise InputError(f"{name}: cannot be read: {reason}") from error
        rows = [
            (number, row)
            for number, line in enumerate(lines, 1)
            if line.strip() and not line.startswith("#")
            for row in csv.reader([line])
        ]
        head = [cell.strip() for cell in rows[0][1]] if rows else []
        if len(head) != 2 or head[1] != "annual_frequency":
            raise InputError(f"{name}: the first line must be the name of an intensity measure and 'annual_frequency'")
        for number, row in rows[1:]:
            if not _is_pair(row):
                raise InputError(f"{name}: line {number}: must be two numbers")
        values = np.array([row for _, row in rows[1:]], dtype=np.float64).reshape(-1, 2)
        try:
            return cls(values[:, 0], values[:, 1], head[0])
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
        """
        values = as_levels(x)
        flat = values.ravel()
        with np.errstate(divide="ignore", over="ignore"):
            h, _ = self._continued(np.log(flat))
        return shaped(np.where(self._covers(flat), h, np.nan), values)

    def _covers(self, x: FloatArray) -> Any:
        """Where is the curve given?"""
        return ((x >= self.im_levels[0]) & (x <= self.im_levels[-1])) | self.endless

    def _continued(self, u: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Frequency and exponent at u = ln x; those of the first and the last step go on beyond the levels."""
        known, slope = np.log(self.im_levels), self._slopes()
        step = np.clip(np.searchsorted(known, u, side="right") - 1, 0, len(slope) - 1)
        return self.annual_frequency[step] * np.exp(-slope[step] * (u - known[step])), slope[step]

    def _slopes(self) -> FloatArray:
        """Exponents k of the power laws of each step."""
        return -np.diff(np.log(self.annual_frequency)) / np.diff(np.log(self.im_levels))

    def to_frame(self) -> Any:
        """The curve as a pandas DataFrame."""
        return tables.frame({self.im: self.im_levels, "annual_frequency": self.annual_frequency})

    def to_csv(self, path: str | os.PathLike[str]) -> None:
        """Write the curve as `from_csv` reads it."""
        comments = [f"unit of {self.im}: {_binding.unit_of(self.im) or '1'}, of annual_frequency: 1/year"]
        tables.write_csv(path, {self.im: self.im_levels, "annual_frequency": self.annual_frequency}, comments)

    def _facts(self) -> list[tuple[str, str]]:
        unit = f" {_binding.unit_of(self.im)}".rstrip()
        if self.endless:
            k = float(self._slopes()[0])
            return [("power law", f"{self(1.0):.4g} {self.im}^-{k:.4g} a year")]
        first, last = self.im_levels[[0, -1]]
        return [
            ("levels", f"{len(self.im_levels)} of {self.im}, {first:g} to {last:g}{unit}"),
            ("exceeded", f"{self.annual_frequency[0]:.3g} to {self.annual_frequency[-1]:.3g} times a year"),
        ]

    def __repr__(self) -> str:
        return "<HazardCurve: " + ", ".join(f"{what} {text}" for what, text in self._facts()) + ">"

    def _repr_html_(self) -> str:
        return tables.html_of("HazardCurve", self._facts())


def _is_pair(row: list[str]) -> bool:
    """Are these two numbers?"""
    try:
        return len([float(cell) for cell in row]) == 2
    except ValueError:
        return False
