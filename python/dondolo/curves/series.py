"""Mechanisms of a wall in series: it collapses by whichever comes first, each independent of the others."""

from __future__ import annotations

from typing import Any

import numpy as np

from dondolo._base.arguments import FloatArray
from dondolo._fortran.curves import rows_in_series, slopes_in_series


def in_series(probabilities: FloatArray, first: np.ndarray[Any, Any]) -> FloatArray:
    """Probability that at least one of the mechanisms of each wall happens, 1 - prod(1 - p).

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
    number = np.diff(first, append=len(probabilities))
    whole = rows_in_series(probabilities.reshape(len(probabilities), -1), number)
    return whole.reshape(len(first), *probabilities.shape[1:])


def series_slopes(p_occ: FloatArray, probabilities: FloatArray, first: np.ndarray[Any, Any]) -> FloatArray:
    """Derivative of the probability of a wall with respect to that of each of its mechanisms if it can occur.

    Parameters
    ----------
    p_occ : ndarray, shape (rows,)
        Probability that each mechanism can occur.
    probabilities : ndarray, shape (rows, levels)
        Of the mechanisms, wall by wall.
    first : ndarray of int, shape (walls,)
        The first row of each wall, increasing from 0.

    Returns
    -------
    ndarray, shape (rows, levels)
    """
    return slopes_in_series(p_occ, probabilities, np.diff(first, append=len(p_occ)))
