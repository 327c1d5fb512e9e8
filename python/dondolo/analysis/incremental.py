"""Incremental dynamic analysis: the histories of a multiple stripe analysis, record by record.

In incremental dynamic analysis (IDA, Vamvatsikos and Cornell 2002) a record is scaled up step by step, and its EDP is
drawn against the intensity. Multiple stripes hold all of that: every record at every level. They are read here along
the records instead of along the levels; nothing is run again.

First collapse
    IM_i, the lowest level at which history i collapses. A rocking wall may survive a level above that (a
    *resurrection*): impacts and the phase of the motion decide, not the intensity alone.
Fractiles
    The EDP of a share s of the histories at a level is the smallest value that at least the share s does not exceed,
    a collapse counting as infinite. The fractiles of the first collapse are the same of IM_i, a history without a
    collapse counting as infinite. Both are values of the data, without interpolation.
Fragility
    P(C | IM = x) is the share of histories that have collapsed on the way up to x. The levels are a grid: the
    intensity at which a history first collapses, its capacity, lies between the level before IM_i and IM_i; below the
    lowest level, it lies above 0; without a collapse, above the highest. So the capacities, which are lognormal, are
    censored in intervals. With n_j histories that first collapse at x_j and m that stand to the end, the likelihood

        product over levels of (P_j - P_(j-1))^n_j,  times  (1 - P_J)^m,    P_j = Phi(ln(x_j/theta)/beta),  P_0 = 0

    is maximised. In (1/beta, ln theta/beta) its logarithm is concave, so the maximum is the only one. (The moments of
    ln IM_i, and the likelihood of Baker 2015 for an analysis that ends before all collapse, take IM_i itself for the
    capacity, which is too large by half a step.)

Where walls are resurrected the curve still depends on the step: the closer the levels, the sooner one of them is met
that brings the wall down. A free-standing wall of 2 m by 0.5 m, under 44 components recorded in Italy, has theta =
0.83, 0.81 and 0.78 g with steps of 0.1, 0.05 and 0.0125 g up to 3 g; 27, 32 and 40 of its 44 histories are resurrected.
`Stripes.fit` has 0.94 g with all three: it uses the collapses of each level, and counts a resurrection as the survival
it is. For rocking walls it is the better estimate of P(C | IM); this one answers when a record first brings the wall
down on the way up.

References: Vamvatsikos and Cornell (2002), Earthquake Engineering and Structural Dynamics 31, 491-514; Baker (2015),
Earthquake Spectra 31, 579-599.
"""

from __future__ import annotations

import os
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from dondolo._base.arguments import FloatArray, argument_error
from dondolo._base.shown import Shown
from dondolo._fortran.library import constants, warn
from dondolo._fortran.records import blank_unit, unit_of
from dondolo._storage import tables
from dondolo._storage.saved import Saved
from dondolo.analysis.request import polarity_names
from dondolo.analysis.stripe_fits import sample_of
from dondolo.analysis.stripes import Stripes
from dondolo.curves.clusters import Clusters, errors_of_parts, no_errors
from dondolo.curves.fitting import counts_are_flat, warnings_of_fit, with_errors
from dondolo.curves.fragility import Fragility
from dondolo.errors import DondoloWarning

if TYPE_CHECKING:
    from matplotlib.axes import Axes

# Shares of the histories that fractiles are given for
SHARES = (0.16, 0.50, 0.84)
# Of Newton's method, and of halvings of a step
_MOST_STEPS = 100


@dataclass(frozen=True, eq=False, repr=False, kw_only=True)
class FirstCollapseFragility(Fragility):
    """A lognormal fitted to first collapses.

    As `Fragility`, but its covariance is that of a sample of capacities, clustered as that of stripes, and its
    collapses count each history at all levels from its first collapse on. It has no binomial likelihood:
    `log_likelihood` is NaN.
    """

    def _facts(self) -> list[tuple[str, str]]:
        return [fact for fact in super()._facts() if fact[0] != "log likelihood"]


_Table = Literal["records", "fractiles"]


@dataclass(frozen=True, eq=False, repr=False, kw_only=True)
class Incremental(Shown, Saved):
    """The histories of a multiple stripe analysis, record by record.

    Attributes
    ----------
    stripes : Stripes
        The analysis; `stripes.edp[:, i]` is the EDP curve of history i.
    first_collapse : ndarray, shape (histories,)
        The lowest level at which each history collapses; inf where none does. The intensity at which it does lies
        between the level before and this one.
    last_survival : ndarray, shape (histories,)
        The highest level that each history survives; 0 where there is none.
    edp_fractiles : ndarray, shape (3, levels)
        EDP that 16, 50 and 84 % of the histories do not exceed; inf where so many do not survive.
    level_fractiles : ndarray, shape (3,)
        Level by which 16, 50 and 84 % of the histories have collapsed once; inf where the levels end before.
    counted : ndarray of int, shape (levels,)
        Histories that have collapsed at the level or before.
    """

    # Its facts have commas.
    _separator = "; "

    stripes: Stripes
    first_collapse: FloatArray
    last_survival: FloatArray
    edp_fractiles: FloatArray
    level_fractiles: FloatArray
    counted: np.ndarray[Any, np.dtype[np.int64]]

    @property
    def levels(self) -> FloatArray:
        """The levels of intensity."""
        return self.stripes.levels

    @property
    def resurrected(self) -> np.ndarray[Any, np.dtype[np.bool_]]:
        """Which histories survive a level above their first collapse, shape (histories,)."""
        return self.last_survival > self.first_collapse

    @property
    def fraction(self) -> FloatArray:
        """Share of the histories that have collapsed at the level or before, shape (levels,)."""
        return self.counted / len(self.first_collapse)

    def fit(self) -> FirstCollapseFragility:
        """Fit a lognormal to the intensities of first collapse, each known to lie between two levels.

        Returns
        -------
        FirstCollapseFragility
            By maximum likelihood of capacities between two levels. Its status is 'ok', 'extrapolated' (theta outside
            the levels) or 'nearly_flat' (less than half of the histories collapse between two levels, and the counts
            hardly increase with the level, as for `fit_fragility`); without a curve it is 'no_collapse', 'all_collapse'
            (all at the lowest level), 'single_level', 'decreasing' (some collapse at the lowest level and no other at
            any) or 'separated' (else, where at most one level has both histories that have collapsed and histories that
            have not).

        Warns
        -----
        DondoloWarning
            There is no curve, it extrapolates, or it is nearly flat.
        """
        levels, n = self.levels, len(self.first_collapse)
        theta = beta = np.nan
        covariance = np.full((2, 2), np.nan)
        sample, errors = sample_of(self.stripes), None
        if self.counted[-1] == 0:
            status = "no_collapse"
        elif self.counted[0] == n:
            status = "all_collapse"
        elif len(levels) == 1:
            status = "single_level"
        elif self.counted[0] == self.counted[-1]:
            status = "decreasing"
        elif np.count_nonzero((self.counted > 0) & (self.counted < n)) < 2:
            status = "separated"
        else:
            labels = tuple(dict.fromkeys(sample.clusters))
            # Histories of each cluster between two levels, below the lowest and above the highest
            place = np.searchsorted(levels, self.first_collapse)
            numbers = {label: i for i, label in enumerate(labels)}
            number = np.array([numbers[label] for label in sample.clusters])[sample.record_index]
            counts = np.zeros((len(labels), len(levels) + 1))
            np.add.at(counts, (number, place), 1.0)
            mean, beta, covariance, changes = _censored(np.log(levels), counts)
            theta = float(np.exp(mean))
            if len(labels) < constants().fewest_clusters:
                errors = no_errors("few_clusters", len(labels))
            elif changes is None:
                errors = no_errors("one_cluster", len(labels))
            else:
                errors = errors_of_parts([Clusters("records", labels, changes)])
            status = "ok" if levels[0] <= theta <= levels[-1] else "extrapolated"
            # A history is its own control: where most of them collapse between two levels, few of them show a slope
            few = 2 * (self.counted[-1] - self.counted[0]) < n
            if status == "ok" and few and counts_are_flat(levels, self.counted, n):
                status = "nearly_flat"
        half = self.fraction >= 0.5
        first = int(np.argmax(half)) if half.any() else len(levels)
        curve = FirstCollapseFragility(
            theta=theta,
            beta=beta,
            covariance=covariance,
            status=status,
            log_likelihood=np.nan,
            bracket=(float(levels[first - 1]) if first else 0.0, float(levels[first]) if half.any() else np.inf),
            levels=levels,
            collapses=self.counted.astype(np.float64),
            histories=np.full(len(levels), float(n)),
            im=self.stripes.im,
            wall=self.stripes.wall,
            naive_covariance=covariance,
        )
        if curve.has_fit:
            warn(warnings_of_fit(curve))
        else:
            sentence = f"no curve of first collapses is fitted (status '{status}')"
            warn([DondoloWarning(sentence, status, {"wall": self.stripes.wall.name}, {"levels": len(levels)})])
        return curve if errors is None else with_errors(curve, errors)

    def plot(self, ax: Axes | None = None, **options: Any) -> Axes:
        """Draw a line for each history, and their fractiles, bold.

        As Vamvatsikos and Cornell (2002) draw them: a flat line is a collapse. A history that survives a level above
        its first collapse has a circle there.

        Parameters
        ----------
        ax : Axes, optional
            Where to draw; a new figure if left out.
        **options
            Parts to leave out by False (`legend`, `title`, `points`), and keywords of Matplotlib for the fractiles: see
            docs/printing.md.

        Returns
        -------
        Axes
            Level of intensity against EDP.
        """
        from dondolo.analysis.plots_stripes import draw_incremental

        return draw_incremental(self, ax, options)

    def _tables(self) -> dict[_Table, Any]:
        stripes = self.stripes
        none = np.where(np.isfinite(self.edp_fractiles), self.edp_fractiles, np.nan)
        return {
            "records": lambda: {
                "wall": [stripes.wall.name] * len(self.first_collapse),
                "record": stripes.record_names,
                "polarity": polarity_names(stripes.polarity),
                "im": [stripes.im] * len(self.first_collapse),
                "first_collapse": np.where(np.isfinite(self.first_collapse), self.first_collapse, np.nan),
                "last_survival": np.where(self.last_survival > 0.0, self.last_survival, np.nan),
                "resurrected": self.resurrected.astype(int),
            },
            "fractiles": lambda: {
                "im": [stripes.im] * len(self.levels),
                "im_level": self.levels,
                "edp_16": none[0],
                "edp_50": none[1],
                "edp_84": none[2],
                "histories": stripes.histories,
                "collapsed_once": self.counted,
                "fraction": self.fraction,
            },
        }

    def to_frame(self, table: _Table = "records") -> Any:
        """One of the tables 'records' and 'fractiles' as a pandas DataFrame; what is infinite is empty."""
        return tables.frame(tables.choose(self._tables(), table))

    def to_csv(
        self, path: str | os.PathLike[str], table: _Table = "records", *, spreadsheet_safe: bool = False
    ) -> None:
        """Write one of the tables 'records' and 'fractiles'; what is infinite is empty.

        With `spreadsheet_safe`, names that a spreadsheet would read as formulas get an apostrophe.
        """
        comments = [repr(self.stripes.wall), f"unit of the levels: {unit_of(self.stripes.im) or '1'}"]
        tables.write_csv(path, tables.choose(self._tables(), table), comments, spreadsheet_safe=spreadsheet_safe)

    def _facts(self) -> list[tuple[str, str]]:
        unit = blank_unit(self.stripes.im)
        none = f"above {self.levels[-1]:g}"
        fractiles = (f"{level:g}" if np.isfinite(level) else none for level in self.level_fractiles)
        return [
            ("wall", self.stripes.wall.name),
            ("histories", f"{len(self.first_collapse)}, {self.counted[-1]} of them collapse"),
            ("first collapse of 16, 50, 84 %", ", ".join(fractiles) + unit),
            ("survive a higher level later", str(self.resurrected.sum())),
        ]


def incremental(stripes: Stripes) -> Incremental:
    """Read stripes as an incremental dynamic analysis: see `Stripes.incremental`."""
    if not stripes.ran.all():
        raise argument_error(
            "not_together", "stripes", ": have records of their own at each level: every record must run at every level"
        )
    levels, collapsed = stripes.levels, stripes.collapsed
    first = np.where(collapsed.any(axis=0), levels[np.argmax(collapsed, axis=0)], np.inf)
    last = np.where(collapsed.all(axis=0), 0.0, levels[len(levels) - 1 - np.argmin(collapsed[::-1], axis=0)])
    edp = np.where(collapsed, np.inf, stripes.edp)
    return Incremental(
        stripes=stripes,
        first_collapse=first,
        last_survival=last,
        edp_fractiles=fractiles(edp),
        level_fractiles=fractiles(first),
        counted=(first[None, :] <= levels[:, None]).sum(axis=1),
    )


def fractiles(values: FloatArray) -> FloatArray:
    """The smallest values along the last axis that 16, 50 and 84 % do not exceed, one row each."""
    return np.quantile(values, SHARES, axis=-1, method="inverted_cdf")


def _censored(x: FloatArray, by_cluster: FloatArray) -> tuple[float, float, FloatArray, FloatArray | None]:
    """Mean and deviation of a normal sample of which only the intervals are known, and their covariance.

    Between the values x, which increase, below and above them lie so many of each cluster (clusters, intervals).
    Besides the covariance of independent values comes the change of mean and deviation if each cluster is left out, to
    first order; None if one of them alone determines them. In c = 1/deviation and
    a = mean/deviation the logarithm of the likelihood, sum(n ln(Phi(z_j) - Phi(z_(j-1)))) with z = c x - a, is concave.
    By hand, since SciPy's fit to censored data stops after some four digits and gives no covariance.
    """
    from scipy.special import log_ndtr

    counts = by_cluster.sum(axis=0)
    some = counts > 0.0
    n, shift = counts[some], float(np.average(x, weights=counts[:-1]))
    y = x - shift
    ends = np.stack([np.append(-np.inf, y)[some], np.append(y, np.inf)[some]])
    finite = np.isfinite(ends)
    # 0 instead of the infinite ends, whose density vanishes
    y = np.where(finite, ends, 0.0)

    def intervals(p: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        """Of each interval the logarithm of its probability, its ends, and their densities / probability."""
        z = np.where(finite, p[1] * y - p[0], ends)
        # The tail that is the smaller one keeps its digits
        low, high = np.where(z[0] > 0.0, -z[::-1], z)
        tail = log_ndtr(high)
        log_p = tail + np.log1p(-np.exp(log_ndtr(low) - tail))
        z = np.where(finite, z, 0.0)
        return log_p, z, np.where(finite, np.exp(-0.5 * z**2 - 0.5 * np.log(2.0 * np.pi) - log_p), 0.0)

    def height(p: FloatArray) -> float:
        return float(n @ intervals(p)[0]) if p[1] > 0.0 else -np.inf

    # Of each interval
    def slope_and_curvature(p: FloatArray) -> tuple[FloatArray, FloatArray]:
        _, (low, high), (below, above) = intervals(p)
        slope = np.array([below - above, above * y[1] - below * y[0]])
        # Minus the second derivatives of ln(Phi(high) - Phi(low)) with respect to the ends
        ll, hh, lh = below * (below - low), above * (above + high), -below * above
        across = -(ll * y[0] + hh * y[1] + lh * (y[0] + y[1]))
        steep = ll * y[0] ** 2 + hh * y[1] ** 2 + 2.0 * lh * y[0] * y[1]
        return slope, np.array([[ll + hh + 2.0 * lh, across], [across, steep]])

    # Newton's method; a step that does not rise is halved
    p = np.array([0.0, 1.0 / (x[-1] - x[0])])
    for _ in range(_MOST_STEPS):
        slope, curvature = (part @ n for part in slope_and_curvature(p))
        step = np.linalg.solve(curvature, slope)
        for _ in range(_MOST_STEPS):
            if height(p + step) >= height(p) + 1e-4 * float(slope @ step) - 1e-13 * abs(height(p)):
                break
            step *= 0.5
        p = p + step
        if np.all(np.abs(step) <= 1e-10 * (1.0 + np.abs(p))):
            break
    a, c = p
    # (mean, deviation) = (a/c, 1/c)
    jacobian = np.array([[1.0 / c, -a / c**2], [0.0, -1.0 / c**2]])
    slopes, curvatures = slope_and_curvature(p)
    own = by_cluster[:, some]
    rest = np.moveaxis(curvatures @ (n - own).T, -1, 0)
    changes = None
    if np.all(np.linalg.det(rest) > 1e-12 * np.linalg.det(curvatures @ n)):
        changes = -np.linalg.solve(rest, (own @ slopes.T)[..., None])[..., 0] @ jacobian.T
    covariance = jacobian @ np.linalg.inv(curvatures @ n) @ jacobian.T
    return float(a / c) + shift, float(1.0 / c), covariance, changes
