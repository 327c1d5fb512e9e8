"""Cloud analysis: fragility from unscaled records.

Every record runs once and is a point (IM, EDP). Three models are fitted to the cloud of points, each to the histories
that it is about (Jalayer and others 2017, who have the first and the third):

EDP of the histories that rock and do not collapse
    ln EDP = a + b ln IM + sigma epsilon, epsilon standard normal, by least squares; sigma^2 is the sum of the squared
    residuals / (n - 2).
Rocking
    A wall does not move unless the ground acceleration reaches its trigger. Its EDP is then 0 and has no logarithm:
    such histories are left out of the regression, and P_R(x) = P(rocks | IM = x, no collapse) is fitted to them and to
    those that rock.
Collapse
    P_C(x) = P(collapse | IM = x), fitted to all histories.

P_R and P_C are logistic regressions on ln IM, 1/(1 + exp(-(b0 + b1 ln x))), by maximum likelihood. Together, by total
probability,

    P(EDP > y | IM = x) = P_C + (1 - P_C) P_R Phi((a + b ln x - ln y)/sigma).

Where all histories of a kind lie on one side of all others, any steep enough logistic curve fits (Albert and Anderson
1984): the probability is 0 below and 1 above, and NaN in the gap between them, of which the data say nothing. Rocking
is often of this kind, for the PGA against the trigger.

Without collapses P_C is 0, and the regression alone tells how likely a rotation of the capacity is: an extrapolation,
as in any cloud analysis. Rotations grow faster than by a power law towards the capacity, where the restoring moment
vanishes; a cloud without collapses says little about them, and stripes say more.

The line is a rough model of a rocking wall. A wall that barely lifts has a tiny EDP, to which logarithms give weight:
under 44 components recorded in Italy as they are, a two-block wall of 3 m by 0.25 m (hinge 0.6, factor 0.87) has
b = 13.6, sigma = 2.9 and R2 = 0.60 for the PGA. Look at the points before the curve is used; where enough records
collapse, P_C does most of the work.

Without collapses, and where all histories rock, P(EDP > y) is the lognormal curve

    theta = exp((ln y - a)/b),    beta = sigma/b.

Otherwise the equivalent lognormal has the median of the curve, P(EDP > y | theta) = 1/2, and half of the logarithmic
distance between its 16 % and 84 % as dispersion (Jalayer and others 2017).

References: Jalayer, Ebrahimian, Miano, Manfredi and Sezen (2017), Analytical fragility assessment using unscaled ground
motion records, Earthquake Engineering and Structural Dynamics 46, 2639-2663; Albert and Anderson (1984), Biometrika 71,
1-10.
"""

from __future__ import annotations

import threading
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from dondolo._base.arguments import FloatArray, argument_error, as_number, instance_of
from dondolo._base.interrupts import as_event, deferred
from dondolo._fortran.library import constants, warn
from dondolo._fortran.records import describe_measure, unit_of
from dondolo._storage import tables
from dondolo._storage.saved import Saved
from dondolo.analysis.request import SMALL_LEVEL, Polarity, Request, check_threads, new_request, polarity_names
from dondolo.analysis.solver import Solver, as_solver
from dondolo.analysis.work import Work
from dondolo.curves.regression import Logistic, Regression, logistic_regression, regress
from dondolo.curves.sample import cluster_labels
from dondolo.errors import DondoloError, DondoloWarning, Interrupted
from dondolo.records.level_rows import scaled_records
from dondolo.records.record import Record
from dondolo.records.suite import upload
from dondolo.walls.wall import Wall, notes_on_supports

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from dondolo.analysis.cloud_fragility import CloudFragility

BoolArray = np.ndarray[Any, np.dtype[np.bool_]]

# Probabilities one dispersion below and above the median, with the digits of the source
_LOW, _HIGH = 0.16, 0.84
# The equivalent lognormal is sought so far beyond the points, in ln IM
_REACH = 10.0


@dataclass(frozen=True, eq=False, repr=False, kw_only=True)
class Cloud(tables.Tabular, Saved):
    """Result of a cloud analysis: points (IM, EDP), and the models fitted to them.

    Attributes
    ----------
    wall : Wall
    records : tuple of Record
        As they ran, but for `scale`: those of a `RecordSet` times their factors.
    im : str
        Intensity measure.
    scale : float
        Factor on all records.
    intensity : ndarray, shape (histories,)
        Of each history: accelerations in g, all else in SI units.
    edp : ndarray, shape (histories,)
        Largest rotation / capacity; 0 where the wall does not move, edp_limit for a collapse.
    collapsed : ndarray of bool, shape (histories,)
    record_index : ndarray of int, shape (histories,)
        Record of each history, from 0.
    polarity : ndarray of int, shape (histories,)
        +1 as recorded, -1 reversed.
    regression : Regression
        Of ln EDP on ln IM, of histories that rock and do not collapse.
    rocking : Logistic
        P(rocks | IM, no collapse).
    collapse : Logistic
        P(collapse | IM).
    edp_limit : float
        Rotation / capacity that counts as collapse.
    work : Work
        Work done and skipped.
    """

    # Its facts have commas.
    _separator = "; "

    wall: Wall
    records: tuple[Record, ...]
    im: str
    scale: float
    intensity: FloatArray
    edp: FloatArray
    collapsed: BoolArray
    record_index: np.ndarray[Any, np.dtype[np.int32]]
    polarity: np.ndarray[Any, np.dtype[np.int32]]
    regression: Regression
    rocking: Logistic
    collapse: Logistic
    edp_limit: float
    work: Work

    @property
    def slope(self) -> float:
        """Slope b of the regression."""
        return self.regression.slope

    @property
    def intercept(self) -> float:
        """Intercept a of the regression: ln EDP at IM = 1."""
        return self.regression.intercept

    @property
    def sigma(self) -> float:
        """Standard deviation of ln EDP about the line."""
        return self.regression.sigma

    @property
    def r2(self) -> float:
        """Share of the variance of ln EDP that the line explains."""
        return self.regression.r2

    def against(self, im: str) -> Cloud:
        """The same histories against another intensity measure; nothing is run again.

        Parameters
        ----------
        im : str
            Intensity measure, as for `multiple_stripe`.

        Returns
        -------
        Cloud
        """
        intensity, name = _intensities(self.wall, self.records, im, self.scale, 0)
        intensity = intensity[self.record_index]
        labels = _labels(self.records, self.record_index)
        found = replace(self, im=name, intensity=intensity, **fit(intensity, self.edp, self.collapsed, name, labels))
        warn(found._doubts())
        return found

    def fit(self, edp_threshold: float | None = None) -> CloudFragility:
        """The fragility curve P(EDP > edp_threshold | IM) by total probability.

        Parameters
        ----------
        edp_threshold : float, optional
            Threshold, positive and at most `edp_limit`, which is meant if it is left out.

        Returns
        -------
        CloudFragility
            Its `theta` and `beta` are those of the equivalent lognormal.

        Raises
        ------
        InputError
            A threshold that is not positive or above `edp_limit`.
        DondoloError
            Too few histories rock without collapse, so that there is no regression.
        """
        from dondolo.analysis.cloud_fragility import CloudFragility

        threshold = self._threshold(edp_threshold)
        self._need_line()
        return CloudFragility(cloud=self, edp_threshold=threshold)

    def _lognormal(self, threshold: float) -> tuple[float, float]:
        """Median and dispersion of the lognormal curve that is equivalent to P(EDP > threshold | IM)."""
        if not self.slope > 0.0 or "decreasing" in (self.rocking.status, self.collapse.status):
            return np.nan, np.nan
        if self.collapse.status == "none" and self.rocking.status == "all":
            return float(np.exp((np.log(threshold) - self.intercept) / self.slope)), self.sigma / self.slope
        low, median, high = (self._crossing(p, threshold) for p in (_LOW, 0.5, _HIGH))
        return median, 0.5 * float(np.log(high / low))

    def plot(self, ax: Axes | None = None, **options: Any) -> Axes:
        """Draw the points, the line fitted to those that rock, and the probability of collapse.

        Parameters
        ----------
        ax : Axes, optional
            Where to draw; a new figure if left out.
        **options
            Parts to leave out by False (`legend`, `title`, `band`), and keywords of Matplotlib for the points: see
            docs/printing.md.

        Returns
        -------
        Axes
            EDP against intensity, on logarithmic axes. Collapses are drawn above the limit, walls that do not move at
            the bottom. The probability of collapse has an axis of its own, to the right.
        """
        from dondolo.analysis.plots_cloud import draw_cloud

        return draw_cloud(self, ax, options)

    def _doubts(self) -> list[DondoloWarning]:
        """Warnings of models whose slope is not significant."""
        limit = constants().least_ratio
        models: dict[str, Regression | Logistic] = {
            "the EDP of histories that rock": self.regression,
            "the probability of rocking": self.rocking,
            "the probability of collapse": self.collapse,
        }
        return [
            DondoloWarning(
                f"{what} hardly increases with {self.im} (likelihood ratio against no slope"
                f" {model.likelihood_ratio:.3g}, below {limit:.4g}, its 95 % quantile): medians and dispersions are not"
                " reliable",
                "nearly_flat",
                {"wall": self.wall.name, "im": self.im},
                {"likelihood_ratio": model.likelihood_ratio, "limit": limit},
            )
            for what, model in models.items()
            if model.status == "ok" and model.likelihood_ratio < limit
        ]

    def _threshold(self, edp_threshold: float | None) -> float:
        threshold = self.edp_limit if edp_threshold is None else as_number("edp_threshold", edp_threshold)
        if not 0.0 < threshold <= self.edp_limit:
            raise argument_error(
                "out_of_range",
                "edp_threshold",
                f" = {threshold:g}: must be positive and at most edp_limit = {self.edp_limit:g}",
            )
        return threshold

    def _need_line(self) -> None:
        line = self.regression
        if line.status != "ok":
            raise DondoloError(
                f"no line was fitted (status '{line.status}'): {line.histories} histories rock without collapse, three"
                " of different intensity are needed"
            )

    def _curve(self, x: FloatArray, threshold: float, gap: float = np.nan) -> FloatArray:
        from scipy.special import ndtr

        line = self.regression
        with np.errstate(divide="ignore", invalid="ignore"):
            exceeds = ndtr((line.intercept + line.slope * np.log(x) - np.log(threshold)) / line.sigma)
        collapse = self.collapse._at(x, gap)
        return np.where(collapse == 1.0, 1.0, collapse + (1.0 - collapse) * self.rocking._at(x, gap) * exceeds)

    def _crossing(self, p: float, threshold: float) -> float:
        """Intensity at which the curve, which rises, passes a probability; NaN where that is in a gap."""
        from scipy.optimize import brentq

        ends = np.log(self.intensity.min()) - _REACH, np.log(self.intensity.max()) + _REACH

        def sought(gap: float) -> float:
            def off(u: float) -> float:
                return float(self._curve(np.exp([u]), threshold, gap)[0]) - p

            return brentq(off, *ends, xtol=1e-12) if off(ends[0]) < 0.0 < off(ends[1]) else np.nan

        # The latest and the earliest that the gaps of separated samples allow
        late, early = sought(0.0), sought(1.0)
        return float(np.exp(late)) if late - early < 1e-9 else np.nan

    def _table(self) -> tables.Table:
        return {
            "wall": [self.wall.name] * len(self.edp),
            "mechanism": [self.wall.mechanism] * len(self.edp),
            "record": [self.records[i].name for i in self.record_index],
            "polarity": polarity_names(self.polarity),
            "im": [self.im] * len(self.edp),
            "intensity": self.intensity,
            "scale": [self.scale] * len(self.edp),
            "edp": self.edp,
            "collapsed": self.collapsed.astype(int),
        }

    def _comments(self) -> list[str]:
        return [repr(self.wall), *tables.lines_of(self._facts()[1:]), f"unit of intensity: {unit_of(self.im) or '1'}"]

    def _facts(self) -> list[tuple[str, str]]:
        line = self.regression
        fitted = (
            f"ln EDP = {line.intercept:.4g} + {line.slope:.4g} ln {self.im}, sigma {line.sigma:.4g}, R2 {line.r2:.3g}"
        )
        models = ((self.rocking, "rock, of those without collapse"), (self.collapse, "collapse"))
        return [
            ("wall", self.wall.name),
            ("line", f"{fitted}, {line.histories} histories" if line.status == "ok" else line.status),
            *(
                (
                    what,
                    f"{model.count} of {model.histories}, "
                    + (
                        f"logistic {model.b0:.4g} + {model.b1:.4g} ln {self.im}"
                        if model.status == "ok"
                        else model.status
                    ),
                )
                for model, what in models
            ),
            *notes_on_supports((self.wall,)),
            *self.work._notes(),
        ]


def cloud(
    wall: Wall,
    records: Record | Iterable[Record],
    *,
    im: str = "pga",
    scale: float = 1.0,
    polarity: Polarity = "as_recorded",
    solver: Solver | None = None,
    threads: int = 0,
    progress: bool = True,
    stop: threading.Event | None = None,
) -> Cloud:
    """Cloud analysis: run unscaled records, and fit EDP and collapse to the intensity.

    Parameters
    ----------
    wall : Wall
        The wall.
    records : Record or iterable of Record
        Many accelerograms, of a wide range of intensity. The records of a `RecordSet` run with their factors.
    im : str
        Intensity measure, as for `multiple_stripe`; `Cloud.against` gives others without running again.
    scale : float
        One factor for all records.
    polarity : {'as_recorded', 'reversed', 'both'}
        As for `multiple_stripe`.
    solver, threads, progress, stop
        As for `multiple_stripe`.

    Returns
    -------
    Cloud

    Raises
    ------
    InputError
        Input that cannot be run; a record without motion, whose intensity has no logarithm; a row of a set with a level
        and no factor.
    Interrupted
        Ctrl-C or `stop`; its `partial` is the result if all histories were complete, else None.

    Warns
    -----
    DondoloWarning
        A model whose slope is not significant.

    Notes
    -----
    Jalayer and others (2017). The docstring of the module dondolo.analysis.cloud has the formulas.

    Examples
    --------
    >>> import dondolo as dd
    >>> wall = dd.OneSidedWall(1.5, 0.25, name="parapet")
    >>> records = dd.RecordSet(dd.synthetic_records(6.5, 10.0, "shallow", n_records=30), factor=2.0)
    >>> cloud = dd.cloud(wall, records)
    >>> cloud.regression.slope > 0.0
    True
    >>> curve = cloud.fit()
    >>> bool(curve(0.5) < curve(1.0))
    True
    """
    instance_of("wall", wall, Wall)
    several = scaled_records(records)
    factor = as_number("scale", scale)
    if not 0.0 < factor < np.inf:
        raise argument_error("out_of_range", "scale", f" = {factor:g}: must be positive")
    intensity, name = _intensities(wall, several, im, factor, threads)
    # Without a measure, one stripe whose level is the factor.
    how = as_solver(solver)
    settings = how._settings()
    request = Request(
        (wall,),
        several,
        np.array([factor]),
        "",
        polarity,
        how.engine,
        settings,
        check_threads(threads),
    )
    plan = request.plan()
    warn(plan.warnings)
    with deferred(as_event(stop)):
        outcome, interrupted = request.run(plan.histories, progress, wall.name)
    told = f"interrupted: {outcome.done} of {len(plan.record)} histories are complete"
    if outcome.done < len(plan.record):
        raise Interrupted(told)
    points = intensity[plan.record]
    found = Cloud(
        wall=wall,
        records=several,
        im=name,
        scale=factor,
        intensity=points,
        edp=outcome.edp,
        collapsed=outcome.collapsed,
        record_index=plan.record,
        polarity=plan.polarity,
        **fit(points, outcome.edp, outcome.collapsed, name, _labels(several, plan.record)),
        edp_limit=settings.edp_limit,
        work=outcome.work,
    )
    if interrupted:
        raise Interrupted(told, found)
    warn(found._doubts())
    return found


def _intensities(
    wall: Wall, records: tuple[Record, ...], im: str, factor: float, threads: int
) -> tuple[FloatArray, str]:
    """Intensities of the records times a factor, in the unit of the levels; and the name of the measure.

    Measures that the wall makes dimensionless come with the others: the plan of a stripe says by what each record is
    scaled to its level, and measures grow with a power of the scale.
    """
    request = new_request((wall,), records, [SMALL_LEVEL], im, "as_recorded", None, threads)
    scale = request.plan().scale[0]
    return SMALL_LEVEL * (factor / scale) ** describe_measure(request.im).power, request.im


def _labels(records: tuple[Record, ...], record_index: np.ndarray[Any, np.dtype[np.int32]]) -> list[str]:
    """Label of the cluster of each history: its event, else its record."""
    labels = cluster_labels(len(records), upload(records).events(), [one.checksum for one in records])
    return [labels[i] for i in record_index]


def fit(
    intensity: FloatArray, edp: FloatArray, collapsed: BoolArray, im: str, labels: Sequence[str] = ()
) -> dict[str, Any]:
    """Fit the three models to points, of the clusters of their labels if there are any, by name."""
    x = np.log(intensity)
    stands = ~collapsed
    rest = [label for label, one in zip(labels, stands, strict=bool(labels)) if one]
    return {
        "regression": regress(x[stands & (edp > 0.0)], np.log(edp[stands & (edp > 0.0)])),
        "rocking": logistic_regression(intensity[stands], edp[stands] > 0.0, im, rest),
        "collapse": logistic_regression(intensity, collapsed, im, labels),
    }
