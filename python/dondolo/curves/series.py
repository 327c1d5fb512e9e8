"""Mechanisms of a wall in series: it collapses by whichever comes first, each independent of the others."""

from __future__ import annotations

from typing import Any

import numpy as np

from dondolo._base.arguments import FloatArray


def in_series(probabilities: FloatArray, first: np.ndarray[Any, Any]) -> FloatArray:
    """Probability that at least one of the mechanisms of each wall happens, 1 - prod(1 - p).

    Added up rather than multiplied, so that small probabilities keep their digits.

    Parameters
    ----------
    probabilities : ndarray, shape (rows, ...)
        Of the mechanisms, wall by wall.
    first : ndarray of int, shape (walls,)
        The first row of each wall, increasing from 0.

    Returns
    -------
    ndarray, shape (walls, ...)
    """
    number = np.diff(np.append(first, len(probabilities)))
    whole: FloatArray = probabilities[first]
    for k in range(1, max(number, default=0)):
        walls = np.flatnonzero(number > k)
        whole[walls] += (1.0 - whole[walls]) * probabilities[first[walls] + k]
    return whole
