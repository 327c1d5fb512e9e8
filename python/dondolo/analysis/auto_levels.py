"""Where the next stripe tells most of a fragility curve.

A record is taken for one with a capacity, lognormal with the curve's theta and beta, of which a stripe tells whether it
lies below its level. Stripes so far then leave each capacity between two levels, and the information on (ln theta,
ln beta) is that of grouped data (Kulldorff 1961): running the same records again at a level already run adds none. The
next level is where the determinant of that information, and with it the area of the joint confidence region, gains most
(D-optimal design). Nothing else is decided by the model: curves and standard errors come from all histories.
"""

from __future__ import annotations

import numpy as np

from dondolo._base.arguments import FloatArray
from dondolo.curves.fitting import fit
from dondolo.curves.fragility import Fragility

#: Stripes that a budget must pay for: two that bracket the curve, and one between them
FEWEST = 3
# A dispersion to begin with, until two stripes with some collapses and some survivals tell more
_BETA = 0.4
# A step up or down while nothing or everything collapses
_STEP = 2.0
# How far beyond the levels so far the next may lie
_REACH = 2.0
# Levels to choose from, in units of beta from the median
_PLACES = np.linspace(-2.5, 2.5, 501)
_DIGITS = 3


def next_level(levels: FloatArray, collapses: FloatArray, histories: FloatArray) -> float | None:
    """The level of the next stripe.

    Parameters
    ----------
    levels : ndarray, shape (levels,)
        Those so far, increasing.
    collapses, histories : ndarray, shape (levels,)
        Counts of the stripes so far.

    Returns
    -------
    float or None
        Of three digits; None if no level is left that would tell more.
    """
    low, high = float(levels[0]), float(levels[-1])
    if not collapses.any():
        return rounded(_STEP * high)
    if np.array_equal(collapses, histories):
        return rounded(low / _STEP)
    theta, beta = _guess(levels, collapses, histories)
    places = theta * np.exp(beta * _PLACES)
    places = np.array([rounded(level) for level in places[(places >= low / _REACH) & (places <= high * _REACH)]])
    # What is run already tells nothing new, nor does what differs from it by rounding.
    apart = np.abs(places[:, None] / levels - 1.0).min(axis=1, initial=np.inf) > 10.0**-_DIGITS
    places = places[apart]
    if not len(places):
        return None
    cuts = np.log(levels / theta) / beta
    gains = [_determinant(np.sort(np.append(cuts, np.log(level / theta) / beta))) for level in places]
    # The first of those that are best but for rounding, so that no rounding decides
    return float(places[np.argmax(np.array(gains) >= max(gains) * (1.0 - 1e-9))])


def rounded(level: float) -> float:
    """A level of three digits."""
    return float(f"{level:.{_DIGITS}g}")


def _guess(levels: FloatArray, collapses: FloatArray, histories: FloatArray) -> tuple[float, float]:
    """A curve to go by: that of the stripes, or with half a collapse and half a survival added to each."""
    curve: Fragility = fit(levels, collapses, histories)
    if not curve.has_fit:
        curve = fit(levels, collapses + 0.5, histories + 1.0)
    if curve.has_fit:
        return float(np.clip(curve.theta, levels[0] / _REACH, levels[-1] * _REACH)), min(curve.beta, 2.0)
    # One stripe, or collapses that do not become more frequent
    from scipy.special import ndtri

    share = (collapses.sum() + 0.5) / (histories.sum() + 1.0)
    return float(np.exp(np.log(levels).mean() - _BETA * ndtri(share))), _BETA


def _determinant(cuts: FloatArray) -> float:
    """Determinant of the information on the mean and ln of the standard deviation of a normal in classes, of one value.

    Parameters
    ----------
    cuts : ndarray, shape (cuts,)
        Bounds of the classes, increasing, in standard deviations from the mean.
    """
    from scipy.special import ndtr

    height = np.exp(-0.5 * cuts**2) / np.sqrt(2.0 * np.pi)
    # Classes in the upper tail are differences of small numbers, taken from the side that keeps the digits.
    below, above = np.concatenate([[0.0], ndtr(cuts), [1.0]]), np.concatenate([[1.0], ndtr(-cuts), [0.0]])
    share = np.where(below[:-1] < 0.5, np.diff(below), -np.diff(above))
    slopes = -np.diff(np.array([[0.0, *height, 0.0], [0.0, *(cuts * height), 0.0]]), axis=1)
    with np.errstate(divide="ignore", invalid="ignore"):
        information = np.einsum("ak,bk->ab", slopes, np.where(share > 0.0, slopes / share, 0.0))
    return float(np.linalg.det(information))
