"""Regressions of one variable on the logarithm of an intensity: a straight line, and a logistic curve.

The line, ln y = a + b ln x + sigma epsilon, is fitted by least squares; sigma^2 is the sum of the squared residuals
over n - 2. The logistic curve P(x) = 1/(1 + exp(-(b0 + b1 ln x))) maximises the likelihood of what happened at each x.
Its logarithm is concave, and has a finite maximum only where the two kinds overlap strictly in x; where they do not,
they are separated, and any steep enough curve fits (Albert and Anderson 1984, Biometrika 71, 1-10). Its standard errors
are clustered as those of a lognormal (dondolo_fragility_logit).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from dondolo._base.arguments import FloatArray, as_levels, as_probabilities, shaped, tails
from dondolo._base.shown import Shown
from dondolo._fortran.curves import fit_logit, normal_or_student
from dondolo._fortran.records import blank_unit
from dondolo._storage.saved import part_of_results
from dondolo.curves.curve import Curve
from dondolo.curves.delta_method import half_width, positive_levels
from dondolo.curves.wording import shown_error
from dondolo.errors import DondoloError

BoolArray = np.ndarray[Any, np.dtype[np.bool_]]


@part_of_results
@dataclass(frozen=True, kw_only=True)
class Regression:
    """ln EDP = intercept + slope ln IM + sigma epsilon.

    Attributes
    ----------
    slope, intercept, sigma : float
        NaN without a fit.
    se_slope : float
        Standard error of the slope.
    r2 : float
        Share of the variance of ln EDP that the line explains.
    histories : int
        Those that rock and do not collapse.
    status : str
        'ok', or 'too_few': less than three of them, or all of one intensity.
    """

    slope: float
    intercept: float
    sigma: float
    se_slope: float
    r2: float
    histories: int
    status: str

    @property
    def likelihood_ratio(self) -> float:
        """Likelihood ratio statistic against no slope; NaN without a fit."""
        with np.errstate(divide="ignore"):
            return float(-self.histories * np.log1p(-self.r2))


@part_of_results
@dataclass(frozen=True, eq=False, repr=False, kw_only=True)
class Logistic(Curve, Shown):
    """P(x) = 1/(1 + exp(-(b0 + b1 ln x))), or why there is no such curve.

    Attributes
    ----------
    b0, b1 : float
        NaN without a curve.
    status : str
        'ok'; 'none', no history is of the kind: P = 0; 'all', each is: P = 1; 'separated': P = 0 up to the bracket, 1
        from it on and NaN within; 'decreasing': the kind does not become more frequent with intensity, P = NaN.
    bracket : (float, float)
        Where the probability rises: the intensities, in order, of the lowest history of the kind and the highest of
        the other kind.
    histories, count : int
        All, and those of the kind.
    likelihood_ratio : float
        Likelihood ratio statistic against no slope; NaN without a curve.
    im : str
        Intensity measure.
    covariance : ndarray, shape (2, 2)
        Covariance of b0 and b1, of the kind that `errors` says; NaN without standard errors.
    errors : str
        'clustered': histories of one record or event depend on each other; 'naive': all are taken for independent, for
        counts, fewer than three clusters, or one that alone determines the curve; 'given': the curve was not fitted
        here.
    degrees_of_freedom : float
        Of Student's t in intervals: clusters - 1; inf for 'naive'.
    deviance : float
        Of a curve of stripes, as `Fragility.deviance`, to be compared with that; NaN for points.
    """

    b0: float
    b1: float
    status: str
    bracket: tuple[float, float]
    histories: int
    count: int
    likelihood_ratio: float = np.nan
    im: str = ""
    covariance: FloatArray = field(default_factory=lambda: np.full((2, 2), np.nan))
    errors: str = "given"
    degrees_of_freedom: float = np.inf
    deviance: float = np.nan

    @property
    def theta(self) -> float:
        """Median, in the unit of the intensities."""
        return float(np.exp(-self.b0 / self.b1))

    @property
    def se_b0(self) -> float:
        """Standard error of b0."""
        return float(np.sqrt(self.covariance[0, 0]))

    @property
    def se_b1(self) -> float:
        """Standard error of b1."""
        return float(np.sqrt(self.covariance[1, 1]))

    def interval(self, x: ArrayLike, *, confidence: float = 0.95) -> tuple[Any, Any]:
        """Confidence interval of the probability at intensities (of each on its own), on the scale of the logit.

        Parameters
        ----------
        x : array_like
            Intensities, positive.
        confidence : float
            Confidence, between 0 and 1.

        Returns
        -------
        low, high : float or ndarray, shape of x

        Raises
        ------
        DondoloError
            There is no curve, or it has no standard errors.
        InputError
            Intensities that are not positive, a confidence that is not between 0 and 1.

        Examples
        --------
        >>> import dondolo as dd
        >>> curve = dd.fit_fragility([0.2, 0.4], [11, 33], 44).logit()
        >>> [round(float(end), 4) for end in curve.interval(0.4)]
        [0.6026, 0.8558]
        """
        from scipy.special import expit

        self._need_fit()
        if self.errors == "given":
            raise DondoloError("no standard errors: the parameters were given")
        quantile = normal_or_student(tails(confidence)[1], self.degrees_of_freedom)
        values = positive_levels(x)
        design = np.stack([np.ones(values.size), np.log(values.ravel())])
        logit = np.array([self.b0, self.b1]) @ design
        half = half_width(design, self.covariance, quantile)
        return shaped(expit(logit - half), values), shaped(expit(logit + half), values)

    def __call__(self, x: ArrayLike) -> Any:
        """Probability at intensities.

        Parameters
        ----------
        x : array_like
            Intensities, not negative, in the unit of those it was fitted to.

        Returns
        -------
        float or ndarray, shape of x
            NaN where the data do not say: see `status`.

        Raises
        ------
        InputError
            Intensities that are negative or not numbers.
        """
        values = as_levels(x)
        return shaped(self._at(values.ravel()), values)

    def ppf(self, p: ArrayLike) -> Any:
        """Lowest intensities at which the probability is p: the inverse of the curve.

        Parameters
        ----------
        p : array_like
            Probabilities, 0 to 1.

        Returns
        -------
        float or ndarray, shape of p
            Infinite where the curve does not come to p, NaN where the data do not say: see `status`.

        Raises
        ------
        InputError
            A probability that is not between 0 and 1.
        """
        from scipy.special import logit

        values = as_probabilities("p", p)
        flat = values.ravel()
        if self.status == "ok":
            return shaped(np.exp((logit(flat) - self.b0) / self.b1), values)
        within = {"none": np.inf, "all": 0.0}.get(self.status, np.nan)
        high = self.bracket[1] if self.status == "separated" else within
        return shaped(np.where(flat <= 0.0, 0.0, np.where(flat >= 1.0, high, within)), values)

    def _need_fit(self) -> None:
        if self.status != "ok":
            raise DondoloError(f"no curve was fitted (status '{self.status}')")

    def _facts(self) -> list[tuple[str, str]]:
        unit = blank_unit(self.im)
        facts = [("measure", self.im)] if self.im else []
        facts.append(("histories", f"{self.histories}, of the kind {self.count}"))
        if self.status == "ok":
            facts += [
                ("b0", f"{self.b0:.6g}" + shown_error("standard error", self.se_b0)),
                ("b1", f"{self.b1:.6g}" + shown_error("standard error", self.se_b1)),
                ("theta", f"{self.theta:.6g}{unit}"),
                ("standard errors", self.errors),
            ]
        elif self.status == "separated":
            facts.append(("theta", f"between {self.bracket[0]:g} and {self.bracket[1]:g}{unit}"))
        return [*facts, ("status", self.status)]

    def _at(self, x: FloatArray, gap: float = np.nan) -> FloatArray:
        """Probabilities, with a value for the gap of a separated sample.

        Parameters
        ----------
        x : ndarray, shape (points,)
            Intensities, not negative.
        gap : float
            What stands for the probability within the bracket of a separated sample.

        Returns
        -------
        ndarray, shape (points,)
        """
        from scipy.special import expit

        if self.status == "ok":
            with np.errstate(divide="ignore"):
                found: FloatArray = expit(self.b0 + self.b1 * np.log(x))
                return found
        if self.status == "separated":
            low, high = self.bracket
            return np.where(x >= high, 1.0, np.where(x > low, gap, 0.0))
        return np.full(len(x), {"none": 0.0, "all": 1.0}.get(self.status, np.nan))


def regress(x: FloatArray, y: FloatArray) -> Regression:
    """Line by least squares."""
    n = len(x)
    if n < 3 or x.min() == x.max():
        nothing = dict.fromkeys(("slope", "intercept", "sigma", "se_slope", "r2"), np.nan)
        return Regression(**nothing, histories=n, status="too_few")
    from scipy.stats import linregress

    line = linregress(x, y)
    left = y - line.intercept - line.slope * x
    sigma = float(np.sqrt(left @ left / (n - 2)))
    return Regression(
        slope=float(line.slope),
        intercept=float(line.intercept),
        sigma=sigma,
        se_slope=float(line.stderr),
        r2=float(line.rvalue**2),
        histories=n,
        status="ok",
    )


def logistic_regression(x: FloatArray, kind: BoolArray, im: str = "", labels: Sequence[str] = ()) -> Logistic:
    """Logistic regression of points on ln x by maximum likelihood; each is of the cluster of its label, if any."""
    return _logistic(x, kind.astype(np.float64), np.ones(len(x)), im, labels or [""] * len(x))


def logistic_of_stripes(
    levels: FloatArray, collapses: FloatArray, histories: FloatArray, im: str, labels: Sequence[str]
) -> Logistic:
    """Logistic curve of counts (clusters, levels) of labelled clusters; without labels, of independent histories."""
    from scipy.special import xlogy

    known = labels or [""]
    several = np.tile(levels, len(known)), collapses.ravel(), histories.ravel()
    curve = _logistic(*several, im, [label for label in known for _ in levels])
    if curve.status != "ok":
        return curve
    z, n = collapses.sum(axis=0), histories.sum(axis=0)
    p = curve(levels)
    # 0 ln(0/0) = 0 at levels without histories
    whole = np.where(n > 0.0, n, 1.0)
    deviance = 2.0 * float(np.sum(xlogy(z, z / (whole * p)) + xlogy(n - z, (n - z) / (whole * (1.0 - p)))))
    return replace(curve, deviance=max(deviance, 0.0))


def _logistic(x: FloatArray, z: FloatArray, n: FloatArray, im: str, labels: Sequence[str]) -> Logistic:
    """Logistic curve of counts, each of a cluster; clusters that all have one label are independent histories."""
    histories, count = float(n.sum()), float(z.sum())
    many, some = round(histories), round(count)
    none = Logistic(b0=np.nan, b1=np.nan, status="none", bracket=(0.0, np.inf), histories=many, count=some, im=im)
    if count in (0.0, histories):
        return replace(none, status="all") if count else none
    here, there = x[z > 0.0], x[z < n]
    low, high = sorted((float(here.min()), float(there.max())))
    decreasing = replace(none, status="decreasing", bracket=(low, high))
    if here.max() <= there.min():
        return decreasing
    if here.min() >= there.max():
        return replace(decreasing, status="separated")
    ran = n > 0.0
    places = {label: place for place, label in enumerate(dict.fromkeys(np.array(labels)[ran].tolist()), 1)}
    cluster = np.array([places.get(label, 0) for label in labels])
    numbers, errors = fit_logit(x[ran], z[ran], n[ran], cluster[ran])
    b0, b1, var0, both, var1, height = (float(number) for number in numbers)
    if not errors or b1 <= 0.0:
        return decreasing
    flat = count * np.log(count / histories) + (histories - count) * np.log1p(-count / histories)
    return replace(
        decreasing,
        b0=b0,
        b1=b1,
        status="ok",
        likelihood_ratio=2.0 * (height - float(flat)),
        covariance=np.array([[var0, both], [both, var1]]),
        errors=errors,
        degrees_of_freedom=float(len(places) - 1) if errors == "clustered" else np.inf,
    )
