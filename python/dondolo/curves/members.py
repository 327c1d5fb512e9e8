"""The walls behind a curve of a population, at any level of intensity."""

from __future__ import annotations

from typing import Any

import numpy as np

from dondolo._base.arguments import FloatArray
from dondolo.curves.fragility import Fragility


class Members:
    """Walls and their probabilities at any level; a wall collapses by any of its rows that can occur."""

    def __init__(
        self,
        levels: FloatArray,
        curves: list[Fragility],
        fractions: FloatArray,
        weights: FloatArray,
        p_occ: FloatArray,
        alternative: np.ndarray[Any, np.dtype[np.int32]],
        first: np.ndarray[Any, Any],
    ) -> None:
        self.levels, self.fractions = levels, fractions
        self.weights, self.p_occ, self.alternative = weights, p_occ, alternative
        self.theta = np.array([curve.theta for curve in curves])
        self.beta = np.array([curve.beta for curve in curves])
        # Of each wall its first row, its second row, ...
        number = np.diff(np.append(first, len(curves)))
        self.rows = [(np.flatnonzero(number > k), first[number > k] + k) for k in range(max(number, default=0))]

    def rows_at(self, rows: np.ndarray[Any, Any], x: FloatArray) -> FloatArray:
        """Probabilities (rows, x) of some rows, if their mechanisms can occur."""
        from scipy.special import ndtr

        with np.errstate(divide="ignore"):
            found: FloatArray = ndtr((np.log(x) - np.log(self.theta[rows])[:, None]) / self.beta[rows][:, None])
        for i in np.flatnonzero(np.isnan(self.theta[rows])):
            found[i] = np.interp(x, np.append(0.0, self.levels), np.append(0.0, self.fractions[:, rows[i]]))
        return found
