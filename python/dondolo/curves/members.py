"""The walls behind a curve of a population, at any level of intensity."""

from __future__ import annotations

from typing import Any

import numpy as np

from dondolo._base.arguments import FloatArray
from dondolo._fortran.curves import probability_of_rows
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
        return probability_of_rows(self.levels, self.fractions[:, rows], self.theta[rows], self.beta[rows], x)
