"""Comparison of intensity measures by how well they predict the collapse of a wall."""

from __future__ import annotations

import threading
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from dondolo._base.arguments import FloatArray, argument_error, as_count, as_measures
from dondolo._base.interrupts import as_event, deferred
from dondolo._fortran.library import constants
from dondolo._fortran.records import blank_unit, describe_measure
from dondolo._storage import tables
from dondolo._storage.saved import Saved
from dondolo.analysis.request import SMALL_LEVEL, Polarity, new_request
from dondolo.analysis.solver import Solver
from dondolo.analysis.stripe_fits import sample_of
from dondolo.analysis.stripe_runs import multiple_stripe
from dondolo.analysis.stripes import Stripes
from dondolo.curves import fitting
from dondolo.curves.bootstrap import draw_records, resample
from dondolo.curves.fragility import Fragility
from dondolo.errors import DondoloError, Interrupted
from dondolo.records.level_rows import plain_records
from dondolo.records.record import Record
from dondolo.walls.wall import Wall

if TYPE_CHECKING:
    from matplotlib.axes import Axes

# Levels of an analysis reach so many dispersions from the median, where 0.6 % and 99.4 % collapse
_REACH = 2.5
# A search for levels ends after so many stripes; from one to the next accelerations change by the square root of 2
_LONGEST_SEARCH = 40


@dataclass(frozen=True, eq=False, repr=False, kw_only=True)
class IntensityComparison(tables.Tabular, Saved):
    """Fragility curves of one wall and one set of records for several intensity measures.

    Attributes
    ----------
    stripes : tuple of Stripes
        The analysis of each measure, with levels of its own.
    curves : tuple of Fragility
        Their curves.
    dispersion : ndarray, shape (measures,)
        Of the scale factor at which a record makes the wall collapse: beta, halved for the Arias intensity, which grows
        with the square of the scale. By beta alone a measure and its square would seem to differ.
    se_dispersion : ndarray, shape (measures,)
        Its standard errors.
    ratio : ndarray, shape (measures,)
        Dispersion / the smallest of all.
    ratio_interval : ndarray, shape (measures, 2)
        95 % percentile intervals of that ratio, from resampled records that all measures share.
    """

    stripes: tuple[Stripes, ...]
    curves: tuple[Fragility, ...]
    dispersion: FloatArray
    se_dispersion: FloatArray
    ratio: FloatArray
    ratio_interval: FloatArray

    @property
    def ims(self) -> tuple[str, ...]:
        """The intensity measures."""
        return tuple(curve.im for curve in self.curves)

    @property
    def best(self) -> str:
        """The measure with the smallest dispersion."""
        return self.ims[int(np.argmin(self.ratio))]

    def plot(self, ax: Iterable[Axes] | None = None, **options: Any) -> Axes:
        """Draw the curves of all measures on one scale, and their dispersions.

        Parameters
        ----------
        ax : two Axes, optional
            Where to draw; a new figure if left out.
        **options
            Parts to leave out by False (`legend`, `title`, `bars`, `points`), and keywords of Matplotlib for the
            curves: see docs/printing.md.

        Returns
        -------
        Axes
            The first of the figure's: probability of collapse against scale factor over its median, for an amplitude
            the intensity over its median: the steeper, the more efficient; and the dispersions with 95 % intervals, the
            most efficient measure at the top.
        """
        from dondolo.analysis.plots_efficiency import draw_comparison

        return draw_comparison(self, ax, options)

    def _table(self) -> tables.Table:
        return {
            "im": self.ims,
            "unit": [describe_measure(im).unit or "-" for im in self.ims],
            "theta": [curve.theta for curve in self.curves],
            "beta": [curve.beta for curve in self.curves],
            "se_ln_theta": [curve.se_ln_theta for curve in self.curves],
            "se_beta": [curve.se_beta for curve in self.curves],
            "dispersion": self.dispersion,
            "se_dispersion": self.se_dispersion,
            "histories": [int(stripes.histories.sum()) for stripes in self.stripes],
            "largest_scale": [float(stripes.scale.max()) for stripes in self.stripes],
            "ratio": self.ratio,
            "ratio_low": self.ratio_interval[:, 0],
            "ratio_high": self.ratio_interval[:, 1],
        }

    def __str__(self) -> str:
        lines = [
            f"{'im':<14}{'unit':<5}{'theta':>9}{'se ln':>8}{'beta':>8}{'se':>8}{'dispersion':>12}{'se':>8}"
            f"{'ratio (95 %)':>19}{'histories':>11}{'scale':>7}"
        ]
        for i in np.argsort(self.ratio):
            curve = self.curves[i]
            ratio = f"{self.ratio[i]:.2f}" + self._interval_in_words(i, " ({:.2f}-{:.2f})")
            unit = describe_measure(curve.im).unit or "-"
            lines.append(
                f"{curve.im:<14}{unit:<5}{curve.theta:>9.4g}{curve.se_ln_theta:>8.4f}{curve.beta:>8.4f}"
                f"{curve.se_beta:>8.4f}{self.dispersion[i]:>12.4f}{self.se_dispersion[i]:>8.4f}"
                f"{ratio:>19}{int(self.stripes[i].histories.sum()):>11}"
                f"{self.stripes[i].scale.max():>7.1f}"
            )
        return "\n".join(lines)

    def __repr__(self) -> str:
        return f"<IntensityComparison: {len(self.ims)} measures, smallest dispersion with {self.best}>"

    def _facts(self) -> list[tuple[str, str]]:
        return [
            (
                self.ims[i],
                f"theta {self.curves[i].theta:.4g}{blank_unit(self.ims[i])}, dispersion {self.dispersion[i]:.3g},"
                f" {self.ratio[i]:.3g} times the smallest" + self._interval_in_words(i, " ({:.3g} to {:.3g})"),
            )
            for i in np.argsort(self.ratio).tolist()
        ]

    def _interval_in_words(self, i: int, words: str) -> str:
        """The interval of a ratio; nothing where too few clusters leave it open."""
        ends = self.ratio_interval[i]
        return words.format(*ends) if np.isfinite(ends).all() else ""


def compare_intensities(
    wall: Wall,
    records: Record | Iterable[Record],
    ims: str | Iterable[str],
    *,
    n_levels: int = 15,
    polarity: Polarity = "as_recorded",
    solver: Solver | None = None,
    n_resamples: int = 1000,
    rng: int | np.random.Generator | None = 0,
    events: Sequence[Any] | None = None,
    threads: int = 0,
    progress: bool = True,
    stop: threading.Event | None = None,
) -> IntensityComparison:
    """Compare intensity measures by the dispersion of a wall's fragility: the smaller, the more efficient.

    Every measure gets a multiple stripe analysis of its own. A search by few stripes finds its levels, so that all
    curves are fitted to the same range of probabilities: the levels are spaced evenly in ln IM, 2.5 dispersions
    to both sides of the median.

    Parameters
    ----------
    wall : Wall
        The wall.
    records : Record or iterable of Record
        The accelerograms.
    ims : str or iterable of str
        Intensity measures, as for `multiple_stripe`.
    n_levels : int
        Stripes of each analysis, at least 2.
    polarity : {'as_recorded', 'reversed', 'both'}
        As for `multiple_stripe`.
    solver : Solver, optional
        Tolerances, collapse limit and engine.
    n_resamples : int
        Samples of records for the intervals of the ratios.
    rng : int, Generator or None
        Of these samples.
    events : sequence, optional
        A label for each record in place of its event; records with the same label depend on each other.
    threads, progress, stop
        As for `multiple_stripe`.

    Returns
    -------
    IntensityComparison

    Raises
    ------
    InputError
        Records with levels or factors of their own, measures that are not known.
    DondoloError
        A measure without a curve: too few records, say.
    Interrupted
        Ctrl-C or `stop`.

    Examples
    --------
    >>> import dondolo as dd
    >>> wall = dd.OneSidedWall(1.5, 0.25, name="parapet")
    >>> records = dd.synthetic_records(6.5, 10.0, "shallow", n_records=12)
    >>> found = dd.compare_intensities(wall, records, ["pga", "pgv"], n_levels=6, n_resamples=20, progress=False)
    >>> found.best
    'pga'
    """
    several = plain_records(records)
    names = [describe_measure(im).name for im in as_measures(ims)]
    if not names or len(set(names)) < len(names):
        raise argument_error("not_given", "ims", ": must be given, and differ")
    count = as_count("n_levels", n_levels, 2)
    analyses, curves = [], []
    with deferred(as_event(stop)):
        for im in names:
            grid = _levels(wall, several, im, count, polarity, solver, threads)
            how: dict[str, Any] = {"polarity": polarity, "solver": solver, "threads": threads, "progress": progress}
            analyses.append(multiple_stripe(wall, several, grid, im=im, **how))
            curves.append(analyses[-1].fit(events=events))
            if not curves[-1].has_fit:
                raise DondoloError(f"im = '{im}': no curve was fitted (status '{curves[-1].status}')")
    power = np.array([describe_measure(im).power for im in names], dtype=np.float64)
    dispersion = np.array([curve.beta for curve in curves]) / power
    error = np.array([curve.se_beta for curve in curves]) / power
    # The same samples for all measures: what the records have in common does not blur the ratios.
    clusters = sample_of(analyses[0], events).clusters
    interval = np.full((len(names), 2), np.nan)
    if len(set(clusters)) >= constants().fewest_clusters:
        times = draw_records(clusters, n_resamples, rng)
        drawn = np.array([resample(sample_of(stripes), times).beta for stripes in analyses]) / power[:, None]
        interval = np.nanquantile(drawn / drawn[np.argmin(dispersion)], (0.025, 0.975), axis=1).T
    return IntensityComparison(
        stripes=tuple(analyses),
        curves=tuple(curves),
        dispersion=dispersion,
        se_dispersion=error,
        ratio=dispersion / dispersion.min(),
        ratio_interval=interval,
    )


def _levels(
    wall: Wall,
    records: tuple[Record, ...],
    im: str,
    count: int,
    polarity: Polarity,
    solver: Solver | None,
    threads: int,
) -> FloatArray:
    """Levels that cover a curve from nearly none to nearly all collapses."""
    pga = np.array([record.peak_acceleration for record in records])

    def plan_at(levels: Sequence[float]) -> Any:
        request = new_request((wall,), records, levels, im, polarity, solver, threads)
        return request, request.plan()

    def collapses_at(level: float) -> tuple[int, int]:
        request, plan = plan_at([level])
        outcome, interrupted = request.run(plan.histories, False, "")
        if interrupted:
            raise Interrupted("interrupted: in the search for levels", None)
        return int(outcome.collapsed.sum()), len(outcome.collapsed)

    # The search begins where half of the records reach the trigger acceleration.
    _, plan = plan_at([SMALL_LEVEL])
    histories = len(plan.record)
    power = describe_measure(im).power
    peaks = plan.scale[0] * pga[plan.record]
    start = SMALL_LEVEL * float(wall.trigger_acceleration / np.median(peaks)) ** power
    factor = 2.0 ** (0.5 * power)
    tried = {start: collapses_at(start)}
    for step, last in ((1.0 / factor, 0), (factor, histories)):
        level = start
        while (tried[level][0] > 0 if step < 1.0 else tried[level][0] < last) and len(tried) < _LONGEST_SEARCH:
            level *= step
            tried[level] = collapses_at(level)
    x = np.array(sorted(tried))
    z, n = np.array([tried[level] for level in x], dtype=np.float64).T
    pilot = fitting.fit(x, z, n, im=im)
    reach = np.linspace(-_REACH, _REACH, count)
    if pilot.has_fit:
        return pilot.theta * np.exp(pilot.beta * reach)
    # Too steep a curve for the search: between the last level that nothing fails at and the first that all fails at
    low, high = x[z == 0].max(initial=x[0]), x[z >= histories].min(initial=x[-1])
    return np.geomspace(low, high, count)
