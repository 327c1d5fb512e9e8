"""Intervals of curves and of their parameters, by the delta method."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from dondolo._base.arguments import FloatArray, argument_error, as_levels, shaped

if TYPE_CHECKING:
    from dondolo.curves.lognormal import LognormalCurve


def positive_levels(x: ArrayLike) -> FloatArray:
    """Levels at which a curve has an interval: it is linear in their logarithm, which 0 has not."""
    values = as_levels(x)
    if not np.all(values > 0.0):
        raise argument_error("out_of_range", "x", f" = {values.min():g}: must be positive")
    return values


def half_width(gradient: FloatArray, covariance: FloatArray, quantile: float) -> FloatArray:
    """Half the width of an interval on the scale of the curve's line: `gradient` has a row for each parameter."""
    width: FloatArray = quantile * np.sqrt(np.einsum("ik,ij,jk->k", gradient, covariance, gradient))
    return width


def probability_interval(curve: LognormalCurve, x: ArrayLike, quantile: float) -> tuple[Any, Any]:
    """Interval of the probability at levels: see `Fragility.interval`."""
    values = positive_levels(x)
    probit = np.log(values.ravel() / curve.theta) / curve.beta
    # Gradient of the probit with respect to (ln theta, beta)
    gradient = np.stack([np.full_like(probit, -1.0 / curve.beta), -probit / curve.beta])
    half = half_width(gradient, curve.covariance, quantile)
    from scipy.special import ndtr

    low, high = curve.upper_asymptote * ndtr(probit - half), curve.upper_asymptote * ndtr(probit + half)
    return shaped(low, values), shaped(high, values)


def level_interval(curve: LognormalCurve, p: FloatArray, probit: FloatArray, quantile: float) -> tuple[Any, Any]:
    """Interval of the levels of probabilities, which come with their probits: see `Fragility.ppf_interval`."""
    if not np.all(np.isfinite(probit)):
        wrong = p.ravel()[~np.isfinite(probit)][0]
        raise argument_error(
            "out_of_range", "p", f" = {wrong:g}: must be greater than 0 and less than {curve.upper_asymptote:g}"
        )
    half = half_width(np.stack([np.ones_like(probit), probit]), curve.covariance, quantile)
    level = curve.theta * np.exp(curve.beta * probit)
    return shaped(level * np.exp(-half), p), shaped(level * np.exp(half), p)


def parameter_interval(curve: LognormalCurve, quantile: float) -> dict[str, tuple[float, float]]:
    """Intervals of theta and beta: see `Fragility.parameter_interval`."""
    width = np.exp(quantile * curve.se_ln_theta)
    half = quantile * curve.se_beta / curve.beta
    beta = (curve.beta / (1.0 + half), curve.beta / (1.0 - half) if half < 1.0 else np.inf)
    return {"theta": (float(curve.theta / width), float(curve.theta * width)), "beta": beta}
