"""The walls behind a curve of a population, at any level of intensity."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from dondolo._base.arguments import FloatArray
from dondolo.curves.fragility import Fragility
from dondolo.curves.series import in_series

# Numbers that curves of many walls are computed at together: a few tens of MB
_NUMBERS = 2_000_000


class Members:
    """Walls and their probabilities at any level; the rows of a wall are in series."""

    def __init__(
        self,
        levels: FloatArray,
        curves: list[Fragility],
        fractions: FloatArray,
        weights: FloatArray,
        p_occ: FloatArray,
        first: np.ndarray[Any, Any],
    ) -> None:
        self.levels, self.fractions = levels, fractions
        self.weights, self.p_occ, self.first = weights, p_occ, first
        self.theta = np.array([curve.theta for curve in curves])
        self.beta = np.array([curve.beta for curve in curves])
        # Of each wall its first row, its second row, ...
        number = np.diff(np.append(first, len(curves)))
        self.rows = [(np.flatnonzero(number > k), first[number > k] + k) for k in range(max(number, default=0))]

    def parts(self, x: FloatArray) -> list[FloatArray]:
        """Levels in parts that all walls together take little memory for."""
        return np.array_split(x, max(1, math.ceil(len(x) * len(self.p_occ) / _NUMBERS)))

    def at(self, x: FloatArray) -> tuple[FloatArray, FloatArray]:
        """Probabilities (walls, x) and weights (walls,)."""
        rows = self.rows_at(np.arange(len(self.theta)), x) * self.p_occ[:, None]
        return in_series(rows, self.first), self.weights

    def rows_at(self, rows: np.ndarray[Any, Any], x: FloatArray) -> FloatArray:
        """Probabilities (rows, x) of some rows, if their mechanisms can occur."""
        from scipy.special import ndtr

        with np.errstate(divide="ignore"):
            found: FloatArray = ndtr((np.log(x) - np.log(self.theta[rows])[:, None]) / self.beta[rows][:, None])
        for i in np.flatnonzero(np.isnan(self.theta[rows])):
            found[i] = np.interp(x, np.append(0.0, self.levels), np.append(0.0, self.fractions[:, rows[i]]))
        return found
