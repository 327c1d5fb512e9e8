"""Curves as straight lines between levels that are close enough."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from dondolo._base.arguments import FloatArray

#: A function begins where no state is more probable, those of a lognormal six dispersions below its median
BEGIN = 1e-9
# It ends where what is left to come of each state is a smaller share, three dispersions above
_REST = 1.35e-3
# It begins at these shares of the lowest level at the least, the second for wide curves alone, and ends at so many
# times the highest at most.
_LOWEST, _HIGHEST = (1e-3, 1e-6), 100.0
# How far straight lines may be from a curve, as a share of its probability, and in all
_SHARE, _LEAST = 0.005, 1e-9
# Slopes k of the hazards x^-k whose damage frequencies few levels are chosen for
_SLOPES = (1.0, 2.0, 3.0)
# So many levels are tried, until these frequencies are that close to those of all levels, and the probabilities too
_COUNTS = range(12, 41, 4)
_CLOSE, _NEAR = 0.003, 0.004
# Share of the levels that are placed evenly along ln x, so that there are some in straight parts too
_EVEN = 0.02

# Of several states: probabilities (states, levels) at levels
Curves = Callable[[FloatArray], FloatArray]


def in_order(probabilities: FloatArray) -> FloatArray:
    """Curves (states, levels), each raised to those of the more severe states."""
    return np.maximum.accumulate(probabilities[::-1], axis=0)[::-1]


def straight_lines(means: Curves, levels: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Levels that straight lines between them are close enough to the curves, and the curves (states, levels) there."""
    for lowest in _LOWEST:
        below = np.geomspace(lowest * levels[0], levels[0], 300)[:-1]
        seldom = np.flatnonzero(means(below).max(axis=0) <= BEGIN)
        if len(seldom):
            break
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


def few_straight_lines(means: Curves, levels: FloatArray) -> tuple[FloatArray, FloatArray]:
    """As `straight_lines`, with as few levels as the damage frequencies need: 12 to 40, close where curves bend.

    The error of a straight line is its curve's bend times the square of its length. So the sum of the errors, each
    weighted by the hazard there, is the least if levels are as dense as the cube root of bend times weight.
    """
    x, raw = straight_lines(means, levels)
    p = np.maximum.accumulate(in_order(raw), axis=1)
    for count in _COUNTS:
        kept = _densest(x, p, count)
        lines = np.array([np.interp(x, x[kept], one[kept]) for one in p])
        exact = _frequencies(x, p)
        off = np.abs(_frequencies(x, lines) - exact)
        if (off <= _CLOSE * exact).all() and np.abs(lines - p).max() <= _NEAR:
            break
    return x[kept], raw[:, kept]


def _frequencies(x: FloatArray, p: FloatArray) -> FloatArray:
    """Damage frequencies (slopes, states) of curves of straight lines under hazards x^-k."""
    hazard = np.array([(x / x[-1]) ** -k for k in _SLOPES])
    middle = 0.5 * (p[:, 1:] + p[:, :-1])
    return np.asarray(-np.diff(hazard, axis=1) @ middle.T + p[:, -1])


def _densest(x: FloatArray, p: FloatArray, count: int) -> NDArray[np.intp]:
    """So many of the levels, or fewer: the first, the last, and those between which the curves bend alike."""
    if len(x) <= count:
        return np.arange(len(x))
    inner, step = x[1:-1], 0.5 * (x[2:] - x[:-2])
    bend = np.abs(np.diff(np.diff(p, axis=1) / np.diff(x), axis=1)) / step
    weight = np.array([(inner / x[-1]) ** (-k - 1.0) for k in _SLOPES])
    share = weight[:, None, :] * bend / np.maximum(_frequencies(x, p), np.finfo(float).tiny)[:, :, None]
    density = share.max(axis=(0, 1)) ** (1.0 / 3.0) * step
    even = step / inner
    # A curve without a bend has levels that are even alone.
    density += (_EVEN * density.sum() or 1.0) * even / even.sum()
    reached = np.cumsum(density) / density.sum()
    places = np.searchsorted(reached, np.linspace(0.0, 1.0, count)[1:-1]) + 1
    return np.unique(np.concatenate([[0], places, [len(x) - 1]]))
