"""Which mechanisms of a wall occur, and how likely it collapses by them: independent ones, or exclusive alternatives.

`alternative` is the number of the alternative of each row among those of its wall, from 1 on; 0: the mechanisms of the
wall are independent.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from dondolo._base.arguments import FloatArray
from dondolo._fortran.curves import probability_of_walls, slopes_of_walls


def wall_probability(
    p_occ: FloatArray,
    alternative: NDArray[np.int32],
    probabilities: FloatArray,
    first: np.ndarray[Any, Any],
) -> FloatArray:
    """Probability that each wall collapses by any of its mechanisms.

    Parameters
    ----------
    p_occ : ndarray, shape (rows,)
        Probability that each mechanism can occur.
    alternative : ndarray of int, shape (rows,)
        Its alternative.
    probabilities : ndarray, shape (rows, ...)
        Of the mechanisms if they can occur, wall by wall.
    first : ndarray of int, shape (walls,)
        The first row of each wall, increasing from 0.

    Returns
    -------
    ndarray, shape (walls, ...)
    """
    number = np.diff(first, append=len(probabilities))
    whole = probability_of_walls(p_occ, alternative, probabilities.reshape(len(probabilities), -1), number)
    return whole.reshape(len(first), *probabilities.shape[1:])


def wall_slopes(
    p_occ: FloatArray,
    alternative: NDArray[np.int32],
    probabilities: FloatArray,
    first: np.ndarray[Any, Any],
) -> FloatArray:
    """Derivative of the probability of a wall with respect to that of each of its mechanisms, shape (rows, levels).

    For the parameters see `wall_probability`; probabilities are (rows, levels).
    """
    return slopes_of_walls(p_occ, alternative, probabilities, np.diff(first, append=len(p_occ)))


def saturations(p_occ: FloatArray, alternative: NDArray[np.int32], first: np.ndarray[Any, Any]) -> FloatArray:
    """Probability that any mechanism of each wall can occur, shape (walls,)."""
    return wall_probability(p_occ, alternative, np.ones(len(p_occ)), first)
