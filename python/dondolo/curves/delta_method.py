"""Intervals of a curve at a level, by the delta method."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from dondolo._base.arguments import FloatArray, as_levels
from dondolo.errors import InputError


def positive_levels(x: ArrayLike) -> FloatArray:
    """Levels at which a curve has an interval: it is linear in their logarithm, which 0 has not."""
    values = as_levels(x)
    if not np.all(values > 0.0):
        raise InputError(f"x = {values.min():g}: must be positive")
    return values


def half_width(gradient: FloatArray, covariance: FloatArray, quantile: float) -> FloatArray:
    """Half the width of an interval on the scale of the curve's line: `gradient` has a row for each parameter."""
    width: FloatArray = quantile * np.sqrt(np.einsum("ik,ij,jk->k", gradient, covariance, gradient))
    return width
