"""Regressions of one variable on the logarithm of an intensity: a straight line, and a logistic curve.

The line, ln y = a + b ln x + sigma epsilon, is fitted by least squares; sigma^2 is the sum of the squared residuals
over n - 2. The logistic curve P(x) = 1/(1 + exp(-(b0 + b1 ln x))) maximises the likelihood of what happened at each x.
Its logarithm is concave, and has a finite maximum only where the two kinds overlap strictly in x; where they do not,
they are separated, and any steep enough curve fits (Albert and Anderson 1984, Biometrika 71, 1-10).
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from dondolo._base.arguments import FloatArray, as_levels, as_probabilities, shaped
from dondolo._storage.saved import part_of_results
from dondolo.curves.curve import Curve
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
@dataclass(frozen=True, kw_only=True)
class Logistic(Curve):
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
    """

    b0: float
    b1: float
    status: str
    bracket: tuple[float, float]
    histories: int
    count: int
    likelihood_ratio: float = np.nan
    im: str = ""

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
            Intensities that are negative or no numbers.
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


def logistic_regression(x: FloatArray, kind: BoolArray, im: str = "") -> Logistic:
    """Logistic regression on ln x by maximum likelihood, of an intensity measure."""
    n, count = len(x), int(kind.sum())
    none = Logistic(b0=np.nan, b1=np.nan, status="none", bracket=(0.0, np.inf), histories=n, count=count, im=im)
    if count in (0, n):
        return replace(none, status="all") if count else none
    here, there = x[kind], x[~kind]
    low, high = sorted((float(here.min()), float(there.max())))
    decreasing = replace(none, status="decreasing", bracket=(low, high))
    if here.max() <= there.min():
        return decreasing
    if here.min() >= there.max():
        return replace(decreasing, status="separated")
    from scipy.optimize import minimize
    from scipy.special import expit

    u = np.log(x)
    shift, unit = u.mean(), u.std()
    design = np.stack([np.ones(n), (u - shift) / unit])

    def height(b: FloatArray) -> float:
        eta = b @ design
        return float(np.logaddexp(0.0, eta).sum() - eta[kind].sum())

    def gradient(b: FloatArray) -> FloatArray:
        found: FloatArray = design @ (expit(b @ design) - kind)
        return found

    def hessian(b: FloatArray) -> FloatArray:
        p = expit(b @ design)
        found: FloatArray = (design * (p * (1.0 - p))) @ design.T
        return found

    found = minimize(height, np.zeros(2), jac=gradient, hess=hessian, method="trust-exact", options={"gtol": 1e-9})
    b1 = float(found.x[1] / unit)
    if b1 <= 0.0:
        return decreasing
    flat = -count * np.log(count / n) - (n - count) * np.log1p(-count / n)
    ratio = float(2.0 * (flat - found.fun))
    return replace(decreasing, b0=float(found.x[0] - b1 * shift), b1=b1, status="ok", likelihood_ratio=ratio)
