"""Curves as straight lines between levels that are close enough."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from dondolo._base.arguments import FloatArray

# A function begins where no state is more probable, and ends where what is left to come of each is a smaller share:
# those of a lognormal six dispersions below and three above its median, as continuous functions do. OpenQuake draws a
# straight line from 0 to the beginning, and weak shaking is frequent.
_BEGIN, _REST = 1e-9, 1.35e-3
# It begins at this share of the lowest level at the least, and ends at so many times the highest at most.
_LOWEST, _HIGHEST = 1e-3, 100.0
# How far straight lines may be from a curve, as a share of its probability, and in all
_SHARE, _LEAST = 0.005, 1e-9

# Of several states: probabilities (states, levels) at levels
Curves = Callable[[FloatArray], FloatArray]


def in_order(probabilities: FloatArray) -> FloatArray:
    """Curves (states, levels), each raised to those of the more severe states."""
    return np.maximum.accumulate(probabilities[::-1], axis=0)[::-1]


def straight_lines(means: Curves, levels: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Levels that straight lines between them are close enough to the curves, and the curves (states, levels) there."""
    below = np.geomspace(_LOWEST * levels[0], levels[0], 300)[:-1]
    seldom = np.flatnonzero(means(below).max(axis=0) <= _BEGIN)
    above = np.geomspace(levels[-1], _HIGHEST * levels[-1], 300)
    left = means(above)
    complete = np.flatnonzero((left >= (1.0 - _REST) * left[:, -1:]).all(axis=0))
    # Fractions of walls without a fit have their corners at the levels of the analysis.
    x = np.concatenate([below[seldom[-1] if len(seldom) else 0 :], levels, above[1 : complete[0] + 1]])
    p = means(x)
    while True:
        middle = np.sqrt(x[:-1] * x[1:])
        between, ends = means(middle), in_order(p)
        curve = in_order(between)
        line = ends[:, :-1] + (middle - x[:-1]) / np.diff(x) * np.diff(ends, axis=1)
        far = (np.abs(line - curve) > np.maximum(_SHARE * curve, _LEAST)).any(axis=0)
        if not far.any():
            return x, p
        x, p = np.append(x, middle[far]), np.append(p, between[:, far], axis=1)
        order = np.argsort(x)
        x, p = x[order], p[:, order]
