"""Lognormal curves with the uncertainty of their parameters."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from dondolo._base.arguments import FloatArray, as_levels, as_probabilities, shaped, tails
from dondolo._fortran.curves import normal_or_student, probability
from dondolo._fortran.library import constants
from dondolo.curves.clusters import Clusters
from dondolo.curves.curve import Curve
from dondolo.curves.delta_method import level_interval, parameter_interval, probability_interval
from dondolo.curves.wording import WHY_NO_ERRORS, bracket_in_words
from dondolo.errors import DondoloError

Interval = tuple[float, float]


@dataclass(frozen=True, eq=False, repr=False, kw_only=True)
class LognormalCurve(Curve):
    """A lognormal, its standard errors and intervals, or why there is none; `Fragility` describes the fields."""

    theta: float
    beta: float
    covariance: FloatArray
    status: str
    bracket: Interval
    im: str = ""
    upper_asymptote: float = 1.0
    errors: str = "naive"
    clusters: int = 0
    degrees_of_freedom: float = np.inf
    parts: tuple[Clusters, ...] = ()

    @property
    def has_fit(self) -> bool:
        """Whether there is a curve."""
        return self.status in constants().fitted

    @property
    def has_errors(self) -> bool:
        """Whether there are standard errors."""
        return self.has_fit and self.errors in ("naive", "clustered")

    @property
    def se_ln_theta(self) -> float:
        """Standard error of ln theta."""
        return float(np.sqrt(self.covariance[0, 0]))

    @property
    def se_beta(self) -> float:
        """Standard error of beta."""
        return float(np.sqrt(self.covariance[1, 1]))

    def __call__(self, x: ArrayLike) -> Any:
        """Probability of collapse at levels.

        Parameters
        ----------
        x : array_like
            Levels of intensity, not negative.

        Returns
        -------
        float or ndarray, shape of x

        Raises
        ------
        DondoloError
            There is no curve.
        InputError
            A level that is negative or not a number.
        """
        self._need_fit()
        values = as_levels(x)
        return shaped(self.upper_asymptote * probability(self.theta, self.beta, values.ravel()), values)

    def interval(self, x: ArrayLike, *, confidence: float = 0.95) -> tuple[Any, Any]:
        """Confidence interval of the probability at levels (of each on its own, not of the curve as a whole).

        From the covariance, on the scale of the normal quantile of the probability.

        Parameters
        ----------
        x : array_like
            Levels of intensity, positive.
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
            Levels that are not positive, a confidence that is not between 0 and 1.
        """
        return probability_interval(self, x, self._quantile(confidence))

    def ppf(self, p: ArrayLike) -> Any:
        """Levels at which the probability of collapse is p: the inverse of the curve.

        Parameters
        ----------
        p : array_like
            Probabilities, 0 to 1.

        Returns
        -------
        float or ndarray, shape of p
            In the unit of theta; infinite from `upper_asymptote` on, which the curve does not reach.

        Raises
        ------
        DondoloError
            There is no curve.
        InputError
            A probability that is not between 0 and 1.
        """
        self._need_fit()
        values, probit = self._probits(p)
        return shaped(self.theta * np.exp(self.beta * probit), values)

    def ppf_interval(self, p: ArrayLike, *, confidence: float = 0.95) -> tuple[Any, Any]:
        """Confidence interval of the levels at which the probability of collapse is p (of each on its own).

        From the covariance, symmetric in the logarithm of the level.

        Parameters
        ----------
        p : array_like
            Probabilities, greater than 0 and less than `upper_asymptote`.
        confidence : float
            Confidence, between 0 and 1.

        Returns
        -------
        low, high : float or ndarray, shape of p

        Raises
        ------
        DondoloError
            There is no curve, or it has no standard errors.
        InputError
            A probability at which there is no level, a confidence that is not between 0 and 1.

        Examples
        --------
        >>> import dondolo as dd
        >>> curve = dd.fit_fragility([0.2, 0.4], [11, 33], 44, im="pga")
        >>> [round(float(end), 4) for end in curve.ppf_interval(0.5)]
        [0.2444, 0.3274]
        """
        quantile = self._quantile(confidence)
        values, probit = self._probits(p)
        return level_interval(self, values, probit, quantile)

    def parameter_interval(self, *, confidence: float = 0.95) -> dict[str, Interval]:
        """Confidence intervals of theta and beta.

        From the covariance, symmetric in ln theta and in 1/beta, the slope of the probit regression. Where levels reach
        far into the tails, intervals of 95 % contain the beta of exactly lognormal capacities in 92, 93 and 93 % of
        the studies with 22, 44 and 100 records (docs/reading_a_curve.md).

        Parameters
        ----------
        confidence : float
            Confidence, between 0 and 1.

        Returns
        -------
        dict
            'theta' and 'beta': (low, high); inf where the data leave beta open.

        Raises
        ------
        DondoloError
            There is no curve, or it has no standard errors.
        InputError
            A confidence that is not between 0 and 1.
        """
        return parameter_interval(self, self._quantile(confidence))

    @property
    def _end(self) -> float:
        return self.upper_asymptote

    def _need_fit(self) -> None:
        if not self.has_fit:
            raise DondoloError(f"no curve was fitted (status '{self.status}')" + bracket_in_words(self, ": "))

    def _need_errors(self) -> None:
        self._need_fit()
        if not self.has_errors:
            raise DondoloError(f"no standard errors: {WHY_NO_ERRORS[self.errors]}")

    def _probits(self, p: ArrayLike) -> tuple[FloatArray, FloatArray]:
        """Probabilities as an array, and flat the normal quantiles of their shares of the upper asymptote."""
        from scipy.special import ndtri

        values = as_probabilities("p", p)
        return values, ndtri(np.minimum(values.ravel() / self.upper_asymptote, 1.0))

    def _quantile(self, level: float) -> float:
        """Quantile of Student's t for an interval."""
        upper = tails(level)[1]
        self._need_errors()
        return normal_or_student(upper, self.degrees_of_freedom if self.clusters else np.inf)
