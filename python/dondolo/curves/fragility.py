"""Fragility curves: a lognormal with its uncertainty."""

from __future__ import annotations

import math
import os
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from dondolo._base.arguments import FloatArray, argument_error, as_number
from dondolo._base.shown import Shown
from dondolo._fortran.records import name_of_measure, unit_of
from dondolo._fortran.tables import plain
from dondolo._storage import tables
from dondolo._storage.saved import Saved
from dondolo.curves.bootstrap import Bootstrap, draw_records, resample
from dondolo.curves.lognormal import LognormalCurve
from dondolo.curves.sample import Sample, given_labels
from dondolo.curves.wording import facts_of
from dondolo.errors import DondoloError
from dondolo.walls.wall import Wall

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from dondolo.curves.discrete import DiscreteFragility
    from dondolo.curves.goodness import GoodnessOfFit
    from dondolo.curves.model_error import ModelError
    from dondolo.curves.regression import Logistic

Interval = tuple[float, float]


@dataclass(frozen=True, eq=False, repr=False, kw_only=True)
class Fragility(LognormalCurve, Shown, Saved):
    """Lognormal fragility curve P(C | IM = x) = Phi(ln(x/theta)/beta), equation (5) of Nale et al.

    Attributes
    ----------
    theta, beta : float
        Median, in the unit of the levels, and dispersion (standard deviation of the logarithm); NaN without a fit.
    covariance : ndarray, shape (2, 2)
        Covariance of ln theta and beta, of the kind that `errors` says; NaN without standard errors.
    status : str
        'ok', 'extrapolated' (theta outside the levels), 'nearly_flat' (collapses hardly become more frequent with the
        level: the likelihood ratio against no slope is below 3.841, its 95 % quantile), 'no_collapse', 'all_collapse',
        'separated', 'single_level', 'decreasing' or 'not_converged'; the first three have a curve.
    log_likelihood : float
        With the binomial coefficients; NaN without a fit.
    deviance : float
        Twice what the likelihood is below that of the fractions themselves; NaN without a fit. Of curves that were
        fitted together (`Stripes.fit_damage_states` with 'ordinal') that of all of them. `goodness_of_fit` says what it
        means.
    deviance_dof : int
        Levels less parameters: the mean of `deviance` if all histories were independent.
    bracket : (float, float)
        Levels between which half of the histories begin to collapse; 0 or inf where a side is open.
    levels, collapses, histories : ndarray, shape (levels,)
        Counts that it was fitted to.
    im : str
        Intensity measure.
    edp_threshold : float or None
        Rotation / capacity of the damage state; None where only counts were given.
    upper_asymptote : float
        What the probability tends to: 1, but for populations in which no mechanism may occur (`Group`); theta and beta
        are then those of the walls in which one can, and the probability is that of all.
    sample : Sample or None
        The histories behind it, which `bootstrap` draws from; None where only counts were given.
    errors : str
        'clustered': histories of one record or event (of typological curves also: of one wall) depend on each other
        (Mancl and DeRouen 2001); 'naive': all histories are taken for independent, for curves fitted to counts. There
        are no standard errors for 'few_clusters', less than three, 'one_cluster', which alone determines the curve,
        'few_walls', two walls of a population (one alone has errors over records), 'one_wall', without which no curve
        can be fitted, and 'given', a curve that was not fitted here.
    clusters : int
        Number of clusters of records, or of the walls that are too few; 0 for 'naive'.
    degrees_of_freedom : float
        Of Student's t in intervals: clusters - 1; Satterthwaite's over records and walls of a population; inf for
        'naive'.
    naive_covariance : ndarray, shape (2, 2)
        Covariance of ln theta and beta from the Fisher information, as if all histories were independent.
    parts : tuple of Clusters
        The clusters with the change of the parameters if each is left out; () for 'naive', and for the walls of a
        population.

    Examples
    --------
    >>> import dondolo as dd
    >>> curve = dd.Fragility.of_parameters(0.8, 0.4, im="pga")
    >>> round(float(curve(0.8)), 12), round(float(curve.ppf(0.16)), 4)
    (0.5, 0.5374)
    """

    log_likelihood: float
    levels: FloatArray
    collapses: FloatArray
    histories: FloatArray
    wall: Wall | None = None
    edp_threshold: float | None = None
    sample: Sample | None = field(default=None, repr=False)
    naive_covariance: FloatArray = field(default_factory=lambda: np.full((2, 2), np.nan))
    deviance: float = math.nan
    deviance_dof: int = 0

    @classmethod
    def of_parameters(cls, theta: float, beta: float, *, im: str = "") -> Fragility:
        """A curve that was fitted elsewhere.

        Parameters
        ----------
        theta, beta : float
            Median, in the unit of the measure, and dispersion; positive.
        im : str, optional
            Intensity measure.

        Returns
        -------
        Fragility
            Without levels and without standard errors.

        Raises
        ------
        InputError
            Parameters that are not positive, a measure that is not a string.
        """
        for what, value in (("theta", theta), ("beta", beta)):
            if not 0.0 < as_number(what, value) < np.inf:
                raise argument_error("out_of_range", what, f" = {value:g}: must be positive")
        empty = np.zeros(0)
        return cls(
            theta=float(theta),
            beta=float(beta),
            covariance=np.full((2, 2), np.nan),
            status="ok",
            log_likelihood=np.nan,
            bracket=(0.0, np.inf),
            levels=empty,
            collapses=empty,
            histories=empty,
            im=name_of_measure(im),
            errors="given",
        )

    def bootstrap(
        self,
        *,
        n_resamples: int = 2000,
        rng: int | np.random.Generator | None = 0,
        events: Sequence[Any] | None = None,
    ) -> Bootstrap:
        """Fit the curve again to records drawn with replacement.

        A record stays whole: it brings its histories at all levels and of both polarities, and records of one event
        are drawn together, so that their dependence is kept, as the clustered covariance does. All fits are one call of
        Fortran.

        Parameters
        ----------
        n_resamples : int
            Number of samples.
        rng : int, Generator or None
            Of the random numbers; None: different every time.
        events : sequence, optional
            A label for each record in place of those that the curve has: records with the same label are drawn
            together. The two horizontal components of a recording are alike; drawn one by one they look like twice as
            much evidence as they are.

        Returns
        -------
        Bootstrap
            With fewer than about ten records or events its intervals are too narrow; with two there are only three
            curves.

        Raises
        ------
        InputError
            If `events` does not have one label per record, or there are fewer than two records or events.
        DondoloError
            The curve does not come from stripes.

        Examples
        --------
        >>> import numpy as np
        >>> import dondolo as dd
        >>> outcomes = np.random.default_rng(1).random((3, 40)) < [[0.2], [0.5], [0.8]]
        >>> curve = dd.fit_fragility([0.4, 0.6, 0.8], outcomes, records=[f"record {i}" for i in range(40)])
        >>> drawn = curve.bootstrap(n_resamples=200)
        >>> low, high = drawn.parameter_interval()["theta"]
        >>> low < curve.theta < high
        True
        """
        self._need_fit()
        if self.sample is None:
            raise DondoloError("bootstrap: needs the stripes, so it is for curves that come from Stripes.fit")
        labels = self.sample.clusters if events is None else given_labels(self.sample.n_records, events)
        return resample(self.sample, draw_records(labels, n_resamples, rng))

    def goodness_of_fit(self, *, n_resamples: int = 0, rng: int | np.random.Generator | None = 0) -> GoodnessOfFit:
        """Goodness of fit of the lognormal: deviance, residuals and, on request, the p-value of a bootstrap.

        The same records run at every level, so that the deviance is not distributed as chi-square: its p-value by that
        is close to 1 whatever the curve. The bootstrap draws whole records or events from histories of which the curve
        is true; `dondolo.curves.goodness` describes the method, docs/reading_a_curve.md its results.

        Parameters
        ----------
        n_resamples : int
            Number of samples of the bootstrap, 0 for none; 999 resolve a p-value of 0.05.
        rng : int, Generator or None
            Of the random numbers; None: different every time.

        Returns
        -------
        GoodnessOfFit

        Raises
        ------
        DondoloError
            There is no curve, it was not fitted to levels, or its counts cannot be resampled.
        InputError
            Samples of a single record or event.

        Examples
        --------
        >>> import dondolo as dd
        >>> curve = dd.fit_fragility([0.2, 0.4, 0.6, 0.8], [4, 13, 25, 38], 44, im="pga")
        >>> fit = curve.goodness_of_fit(n_resamples=999)
        >>> round(fit.deviance, 3), fit.degrees_of_freedom, fit.p_value > 0.05
        (3.496, 2, True)
        """
        from dondolo.curves.goodness import goodness_of_fit

        self._need_fit()
        return goodness_of_fit(self, n_resamples, rng)

    def refit(self, *, low: float = 0.0, high: float = math.inf) -> Fragility:
        """Fit the curve again to the levels of a range: how much its parameters depend on where the stripes lie.

        Parameters
        ----------
        low, high : float
            Lowest and highest level that take part.

        Returns
        -------
        Fragility
            With standard errors of the same kind.

        Raises
        ------
        InputError
            There are no levels between them.

        Examples
        --------
        >>> import dondolo as dd
        >>> curve = dd.fit_fragility([0.2, 0.4, 0.6, 0.8], [4, 13, 25, 38], 44, im="pga")
        >>> round(curve.theta, 3), round(curve.refit(high=0.6).theta, 3)
        (0.497, 0.551)
        """
        from dondolo.curves.goodness import refit

        return refit(self, low, high)

    def logit(self) -> Logistic:
        """Fit a logistic curve to the same histories, beside the lognormal, which is a probit regression.

        Returns
        -------
        Logistic
            With its parameters' standard errors, clustered if those of this curve are, and a deviance to compare.

        Raises
        ------
        DondoloError
            The curve was not fitted to levels.

        Examples
        --------
        >>> import dondolo as dd
        >>> curve = dd.fit_fragility([0.2, 0.4, 0.6, 0.8], [4, 13, 25, 38], 44, im="pga")
        >>> logit = curve.logit()
        >>> round(logit.theta, 3), round(logit.se_b1, 3), logit.deviance < curve.deviance
        (0.504, 0.474, True)
        """
        from dondolo.curves.regression import logistic_of_stripes

        if not len(self.levels):
            raise DondoloError("logit: the curve was not fitted to levels")
        if self.sample is None:
            return logistic_of_stripes(self.levels, self.collapses[None, :], self.histories[None, :], self.im, ())
        labels = tuple(dict.fromkeys(self.sample.clusters))
        return logistic_of_stripes(self.sample.levels, *self.sample.by_cluster(labels), self.im, labels)

    def with_model_error(self, bias: float, beta: float) -> ModelError:
        """Put an error of the model beside the curve: theta exp(bias) and the root of the sum of squares of both betas.

        There is no default. The numbers are how ln(measured median / computed median) varies between tested walls of
        the mechanism; docs/experiments.md has what is known of them, and which numbers must not be taken.

        Parameters
        ----------
        bias : float
            Mean of ln(measured median / computed median), -2 to 0: a positive one would raise the median.
        beta : float
            Its standard deviation between walls, 0 to 2.

        Returns
        -------
        ModelError
            Both curves.

        Raises
        ------
        InputError
            Numbers outside of their ranges.
        DondoloError
            There is no curve.

        Examples
        --------
        >>> import dondolo as dd
        >>> curve = dd.fit_fragility([0.2, 0.4, 0.6, 0.8], [4, 13, 25, 38], 44, im="pga")
        >>> both = curve.with_model_error(-0.05, 0.25)
        >>> [round(value, 3) for value in (curve.theta, both.theta_used, curve.beta, both.beta_used)]
        [0.497, 0.473, 0.582, 0.634]
        """
        from dondolo.curves.model_error import model_error

        self._need_fit()
        return model_error(self, bias, beta)

    def plot(
        self, ax: Axes | None = None, *, confidence: float = 0.95, label: str | None = None, **options: Any
    ) -> Axes:
        """Draw the curve with its confidence band, and the fractions of collapse it was fitted to.

        Figure 4b of Nale et al. The bars of the fractions are Clopper and Pearson's exact binomial intervals. Without a
        fit only the fractions and the bracket of the median are drawn.

        Parameters
        ----------
        ax : Axes, optional
            Where to draw; a new figure if left out.
        confidence : float
            Confidence of band and bars.
        label : str, optional
            Name of the curve where several are drawn into the same axes; median and dispersion if left out.
        **options
            Parts to leave out by False (`legend`, `title`, `band`, `bars`, `points`), and keywords of Matplotlib for
            the curve: see docs/printing.md.

        Returns
        -------
        Axes
            Probability of collapse against intensity.

        Raises
        ------
        InputError
            A confidence that is not between 0 and 1.
        """
        from dondolo.curves.plots import draw_fragility

        return draw_fragility(self, ax, confidence, label, options)

    def to_frame(self) -> Any:
        """The curve as a pandas DataFrame of one row."""
        from dondolo.curves.table import fragility_table

        return tables.frame(plain(fragility_table([self.wall], [self])))

    def to_csv(self, path: str | os.PathLike[str], *, spreadsheet_safe: bool = False) -> None:
        """Write the curve as the executable's ``_fragility.csv``.

        With `spreadsheet_safe`, names that a spreadsheet would read as formulas get an apostrophe.
        """
        from dondolo.curves.table import fragility_table

        comments = [f"unit of theta: {unit_of(self.im) or '1'}"] if self.im else []
        table = plain(fragility_table([self.wall], [self]))
        tables.write_csv(path, table, comments, spreadsheet_safe=spreadsheet_safe)

    def _fitted(self) -> Fragility:
        return self

    def _as_function(self) -> Fragility | DiscreteFragility:
        self._need_fit()
        # A lognormal of the format tends to 1
        return self if self.upper_asymptote == 1.0 else super()._as_function()

    def _facts(self) -> list[tuple[str, str]]:
        return facts_of(self)
