"""Hazard curves: how often an intensity is exceeded.

Levels and frequencies are joined by straight lines of ln H against ln x, so that between two levels H is a power law,
H(x) = H_j (x/x_j)^-k_j. Nothing is known beyond the levels.

Power laws have an integral with a fragility in closed form, and kinks; `HazardCurve.smoothed` gives a curve without
them (dondolo.hazard.smoothing). What is integrated and drawn is the curve that is given.

Fractiles
    The hazard of a site is uncertain, and published as a mean with fractiles: in a share q of what may be true the
    frequency is at most that of the fractile q. A fractile is a hazard curve too; where nothing is exceeded any more
    its frequency is 0.

Units are those of dondolo: accelerations in g, all else in SI units. Hazard is often published as a return period,
H = 1/T, or as the probability p of being exceeded in t years, H = -ln(1 - p)/t.
"""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from dondolo._base.arguments import (
    FloatArray,
    argument_error,
    as_count,
    as_flag,
    as_levels,
    as_number,
    as_sentences,
    increasing,
    shaped,
)
from dondolo._base.files import as_file, as_files, described
from dondolo._base.shown import Shown
from dondolo._fortran.histories import warnings_of_levels
from dondolo._fortran.library import warn
from dondolo._fortran.records import describe_measure, levels_in_words
from dondolo._storage import tables
from dondolo._storage.saved import Saved
from dondolo.errors import InputError
from dondolo.hazard.frequencies import checked_fractiles, checked_frequencies
from dondolo.hazard.hazard_table import FRACTILE, comment_of_unit, read_hazard, states_unit
from dondolo.hazard.openquake import Site, read_curves, write_curves
from dondolo.hazard.smoothing import monotone_cubics

if TYPE_CHECKING:
    from matplotlib.axes import Axes

# Levels that make a curve
_FEWEST = 2
# Behind the error of a hazard curve with one level
_WHY_TWO = ": an annual frequency of collapse is an integral over a hazard curve, for which one point is not enough"


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
    fractiles : mapping of float to array_like, shape (levels,), optional
        Share q, between 0 and 1 -> annual frequency of the fractile q, not increasing with the level [1/year].
    endless : bool
        Whether the power law through two levels continues beyond them: see `power_law`.
    source : iterable of str, optional
        Origin of the curve and changes to it, one sentence each, for reports; `from_csv` and `from_openquake`
        name their files and how they were read.
    rigid_ground : bool
        Whether the levels are accelerations of rigid, level ground, without the factors of soil and topography of the
        site, as those that `from_csv` reads from a column 'ag' are. A report refuses them beside a check with such
        factors.

    Raises
    ------
    InputError
        Levels and frequencies that are not a hazard curve; an unknown measure; fractiles that cross.

    Attributes
    ----------
    levels : ndarray, shape (levels,)
        In the unit of the measure: accelerations in g, all else in SI units.
    annual_frequency : ndarray, shape (levels,)
        The mean, where there are fractiles [1/year].
    im : str
    fractiles : dict
        Share -> annual frequency, in increasing order; empty if none are known.
    endless : bool
    source : tuple of str
    rigid_ground : bool

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
    fractiles: dict[float, FloatArray]
    endless: bool
    source: tuple[str, ...]
    rigid_ground: bool

    def __init__(
        self,
        levels: ArrayLike,
        annual_frequency: ArrayLike,
        *,
        im: str = "pga",
        fractiles: Mapping[float, ArrayLike] | None = None,
        endless: bool = False,
        source: Iterable[str] = (),
        rigid_ground: bool = False,
    ) -> None:
        x = increasing("levels", levels, why=_WHY_TWO)
        h = checked_frequencies(annual_frequency, len(x))
        if endless and len(x) != 2:
            raise argument_error(
                "wrong_length", "endless", f": must have two levels, which give the power law, not {len(x)}"
            )
        for what, value in (
            ("levels", x),
            ("annual_frequency", h),
            ("im", describe_measure(im).name),
            ("fractiles", checked_fractiles(fractiles, len(x))),
            ("endless", as_flag("endless", endless)),
            ("source", as_sentences("source", source)),
            ("rigid_ground", as_flag("rigid_ground", rigid_ground)),
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
            k0 or k is not positive; an unknown measure.
        """
        for what, value in (("k0", k0), ("k", k)):
            if not 0.0 < as_number(what, value) < np.inf:
                raise argument_error("out_of_range", what, f" = {value:g}: must be positive")
        levels = np.array([0.5, 2.0])
        return cls(levels, k0 * levels**-k, im=im, endless=True)

    @classmethod
    def from_csv(cls, path: str | os.PathLike[str]) -> HazardCurve:
        """Read a hazard curve.

        Parameters
        ----------
        path : path
            A CSV table. One column is the levels: its title is the intensity measure, or 'ag' with its unit, 'ag (g)',
            'ag (g/10)' or 'ag (m/s2)', which is the PGA. Another says how often they are exceeded: 'annual_frequency'
            [1/year], 'return_period' [years] or 'poe', the probability of exceedance in 'investigation_time' [years],
            a third column. Columns 'fractile_0.16' and so on are the fractiles, in the unit of the other.
            'TR', 'F0' and 'TC*' of the Italian code's tables are known, and the last two not used.
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
            The file cannot be read, or is no such table; a cell is not a number; the values are not a hazard curve.

        Warns
        -----
        DondoloWarning
            Levels that no ground motion reaches, which may be in another unit; ag, and columns that are not used.

        Notes
        -----
        ag of the Italian code is that of rigid, level ground: multiply it by the factors of soil and topography of the
        site. Tables of spreadsheets with semicolons and decimal commas are read as those of walls and records are.

        Examples
        --------
        >>> import dondolo as dd
        >>> hazard = dd.HazardCurve([0.05, 0.5, 3.0], [0.05, 1e-3, 1e-7])
        >>> hazard.to_csv("hazard.csv")
        >>> float(dd.HazardCurve.from_csv("hazard.csv")(0.5))
        0.001
        """
        name = os.fspath(as_file("path", path))
        im, levels, frequency, fractiles, notes, is_rigid = read_hazard(name)
        source = [described(name), *map(str, notes)]
        try:
            curve = cls(levels, frequency, im=im, fractiles=fractiles, source=source, rigid_ground=is_rigid)
        except InputError as error:
            raise error.placed(str(name)) from None
        # The unit of what dondolo has written is known.
        doubts = [] if states_unit(name, curve.im) else warnings_of_levels(curve.im, curve.levels)
        warn([*notes, *(one.placed(f"{name}: ") for one in doubts)])
        return curve

    @classmethod
    def from_openquake(
        cls,
        paths: str | os.PathLike[str] | Sequence[str | os.PathLike[str]],
        *,
        site: Site | None = None,
        im: str | None = None,
    ) -> HazardCurve:
        """Read a hazard curve that the OpenQuake engine has exported; `read_site_hazards` reads those of all sites.

        Parameters
        ----------
        paths : path or sequence of path
            CSV files of one calculation and measure, 'hazard_curve-mean-PGA_1.csv', or that with its
            'quantile_curve-0.16-PGA_1.csv' and so on. One file alone is the curve, whatever its statistic.
        site : int or (float, float), optional
            Number of the site in the files, from 0, or its longitude and latitude [degrees], to 0.001 degrees; may be
            left out where there is one.
        im : str, optional
            Measure of files whose imt is AvgSA, such as 'saavg(0.2:2)'.

        Returns
        -------
        HazardCurve
            The fractiles are those of the quantile files.

        Raises
        ------
        InputError
            A file that cannot be read or is no such table; files that do not belong together; a site that is not in
            them; a measure that dondolo does not know.

        Warns
        -----
        DondoloWarning
            Levels with a probability of 0 or 1, of which no frequency follows, are left out.

        Notes
        -----
        The comment in the first line of a file gives the measure, the investigation time t and the kind of the curve,
        and a column 'poe-x' the probability p that x is exceeded in t years, of which the frequency is -ln(1 - p)/t.
        Levels of SA and PGA are in g, as here; those of PGV are in cm/s there and in m/s here.

        Examples
        --------
        >>> import dondolo as dd
        >>> hazard = dd.HazardCurve([0.05, 0.5, 3.0], [0.05, 1e-3, 1e-7])
        >>> files = hazard.to_openquake(".", site=(11.62, 44.83))
        >>> round(float(dd.HazardCurve.from_openquake(files)(0.5)), 5)
        0.001
        """
        files = as_files("paths", paths)
        measure, levels, mean, fractiles, notes = read_curves(files, site, im)
        source = [*map(described, files), *map(str, notes)]
        try:
            curve = cls(levels, mean, im=measure, fractiles=fractiles, source=source)
        except InputError as error:
            raise error.placed(str(files[0])) from None
        warn(notes)
        return curve

    def to_openquake(
        self,
        folder: str | os.PathLike[str],
        *,
        site: tuple[float, float],
        investigation_time: float = 50.0,
        imt: str | None = None,
    ) -> list[str]:
        """Write the curve as the OpenQuake engine exports it: a file for the mean, and one for each fractile.

        Parameters
        ----------
        folder : path
            Where the files are written; it must exist. Files of the same names are replaced.
        site : (float, float)
            Longitude and latitude [degrees].
        investigation_time : float
            For which probabilities of exceedance are given [years].
        imt : str, optional
            OpenQuake's name of the measure saavg(T1:T2), 'AvgSA' or 'AvgSA(T)'; left out for others.

        Returns
        -------
        list of str
            Paths of the files: 'hazard_curve-mean-PGA.csv', 'quantile_curve-0.16-PGA.csv' ...

        Raises
        ------
        InputError
            A measure that OpenQuake does not have; a time that is not positive; an invalid site.
        DondoloError
            A file cannot be written.
        """
        time = as_number("investigation_time", investigation_time)
        if not 0.0 < time < np.inf:
            raise argument_error("out_of_range", "investigation_time", f" = {time:g}: must be positive")
        curves = {"mean": self.annual_frequency, **{f"quantile-{q:g}": h for q, h in self.fractiles.items()}}
        return write_curves(folder, self.im, self.levels, curves, site, time, imt)

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
            Intensities that are negative or not numbers.
        """
        values = as_levels(x)
        flat = values.ravel()
        with np.errstate(divide="ignore", over="ignore"):
            u = np.log(flat)
            k, start, frequency = self._power_laws(u)
            h = frequency * np.exp(-k * (u - start))
        return shaped(np.where(self._covers(flat), h, np.nan), values)

    def fractile(self, q: float) -> HazardCurve:
        """The curve of a fractile.

        Parameters
        ----------
        q : float
            One of the shares that `fractiles` has.

        Returns
        -------
        HazardCurve
            Of the levels that are exceeded at all.

        Raises
        ------
        InputError
            A share that the curve does not have; fewer than two levels that are exceeded.

        Examples
        --------
        >>> import dondolo as dd
        >>> hazard = dd.HazardCurve([0.05, 0.5, 3.0], [0.05, 1e-3, 1e-7], fractiles={0.84: [0.1, 2e-3, 2e-7]})
        >>> float(hazard.fractile(0.84)(0.5))
        0.002
        """
        share = as_number("q", q)
        if share not in self.fractiles:
            has = ", ".join(f"{one:g}" for one in self.fractiles) or "none"
            raise argument_error(
                "not_a_word", "q", f" = {share:g}: must be one of the fractiles of the hazard curve; there is {has}"
            )
        h = self.fractiles[share]
        exceeded = h > 0.0
        if exceeded.sum() < _FEWEST:
            raise InputError(
                f"fractile {share:g} of the hazard curve: must be exceeded at {_FEWEST} levels or more, not at"
                f" {exceeded.sum()}"
            )
        source = (*self.source, f"fractile {share:g}")
        return HazardCurve(
            self.levels[exceeded], h[exceeded], im=self.im, source=source, rigid_ground=self.rigid_ground
        )

    def _curves(self) -> dict[float, HazardCurve]:
        """The curves of the fractiles, of those that are exceeded at enough levels for one."""
        return {q: self.fractile(q) for q, h in self.fractiles.items() if (h > 0.0).sum() >= _FEWEST}

    def smoothed(self, *, steps: int = 16) -> HazardCurve:
        """The curve with more levels, on the monotone cubic of ln H against ln x through its own.

        Parameters
        ----------
        steps : int
            Number of steps that each step of this curve is divided into.

        Returns
        -------
        HazardCurve
            A power law without end is itself.

        Raises
        ------
        InputError
            Steps that are not a positive integer.

        Notes
        -----
        The docstring of the module dondolo.hazard.smoothing states by how much that changes annual frequencies.

        Examples
        --------
        >>> import dondolo as dd
        >>> len(dd.HazardCurve([0.05, 0.5, 3.0], [0.05, 1e-3, 1e-7]).smoothed(steps=4).levels)
        9
        """
        parts = as_count("steps", steps, 1)
        if self.endless:
            return self
        x, (mean, *others) = monotone_cubics(self.levels, [self.annual_frequency, *self.fractiles.values()], parts)
        fractiles = dict(zip(self.fractiles, others, strict=True))
        source = (*self.source, f"smoothed, {parts} steps in each")
        return HazardCurve(x, mean, im=self.im, fractiles=fractiles, source=source, rigid_ground=self.rigid_ground)

    def plot(self, ax: Axes | None = None, **options: Any) -> Axes:
        """Draw the curve on logarithmic axes.

        Parameters
        ----------
        ax : Axes, optional
            Where to draw; a new figure if left out.
        **options
            Parts to leave out by False (`legend`, `title`, `band`, `points`), and keywords of Matplotlib for the mean:
            see docs/printing.md.

        Returns
        -------
        Axes
            Annual frequency of exceedance against intensity: the mean with its levels and the fractiles, power laws
            between them, and return periods at the right.
        """
        from dondolo.hazard.plots import draw_hazard

        return draw_hazard(self, ax, options)

    def _covers(self, x: FloatArray) -> Any:
        """Where is the curve given?"""
        return ((x >= self.levels[0]) & (x <= self.levels[-1])) | self.endless

    def _power_laws(self, u: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Of the step at u = ln x: exponent, and ln level and frequency where it begins; the outer ones go on."""
        known, slope = np.log(self.levels), self._slopes()
        step = np.clip(np.searchsorted(known, u, side="right") - 1, 0, len(slope) - 1)
        return slope[step], known[step], self.annual_frequency[step]

    def _slope_at(self, u: FloatArray) -> FloatArray:
        """Exponent at u = ln x, a line between those of the middles of the steps."""
        known = np.log(self.levels)
        return np.interp(u, 0.5 * (known[:-1] + known[1:]), self._slopes())

    def _slopes(self) -> FloatArray:
        """Exponents k of the power laws of each step."""
        # No -0 where two frequencies are the same
        return 0.0 - np.diff(np.log(self.annual_frequency)) / np.diff(np.log(self.levels))

    def to_frame(self) -> Any:
        """The curve as a pandas DataFrame, with a column for each fractile."""
        return tables.frame(self._table())

    def to_csv(self, path: str | os.PathLike[str]) -> None:
        """Write the curve as `from_csv` reads it."""
        tables.write_csv(path, self._table(), [comment_of_unit(self.im)])

    def _table(self) -> tables.Table:
        fractiles = {f"{FRACTILE}{q!r}": h for q, h in self.fractiles.items()}
        title = "ag (g)" if self.rigid_ground else self.im
        return {title: self.levels, "annual_frequency": self.annual_frequency, **fractiles}

    def _facts(self) -> list[tuple[str, str]]:
        if self.endless:
            k = float(self._slopes()[0])
            return [("power law", f"{self(1.0):.4g} {self.im}^-{k:.4g} a year")]
        facts = [
            ("levels", levels_in_words(self.levels, self.im)),
            ("annual frequency", f"{self.annual_frequency[0]:.3g} to {self.annual_frequency[-1]:.3g}"),
        ]
        return facts + ([("fractiles", " ".join(f"{q:g}" for q in self.fractiles))] if self.fractiles else [])
