"""Choice of the next level of stripes: where it adds most information on the fragility curve.

A record is taken for one with a capacity, lognormal with the curve's theta and beta, of which a stripe shows whether it
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
        Of three digits; None if no further level would add information.
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
    gains = _determinants(cuts, np.log(places / theta) / beta)
    # The first of those that are best but for rounding, so that no rounding decides
    return float(places[np.argmax(gains >= gains.max() * (1.0 - 1e-9))])


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


def _determinants(cuts: FloatArray, added: FloatArray) -> FloatArray:
    """Determinant of the information on the mean and ln of the standard deviation of a normal in classes, of one value.

    Parameters
    ----------
    cuts : ndarray, shape (cuts,)
        Bounds of the classes, increasing, in standard deviations from the mean.
    added : ndarray, shape (n,)
        One more bound, for each determinant.

    Returns
    -------
    ndarray, shape (n,)
    """
    bounds = np.concatenate([[-np.inf], cuts, [np.inf]])
    classes = _information(bounds[:-1], bounds[1:])
    # Only the class that is divided changes.
    divided = np.searchsorted(cuts, added)
    parts = _information(bounds[divided], added) + _information(added, bounds[divided + 1])
    mean, both, spread = classes.sum(axis=1)[:, None] - classes[:, divided] + parts
    determinants: FloatArray = mean * spread - both**2
    return determinants


def _information(low: FloatArray, high: FloatArray) -> FloatArray:
    """What classes from low to high tell of the mean, of both and of ln of the spread, shape (3, classes)."""
    from scipy.special import ndtr

    # Classes in the upper tail are differences of small numbers, taken from the side that keeps the digits.
    share = np.where(low < 0.0, ndtr(high) - ndtr(low), ndtr(-low) - ndtr(-high))
    of_mean, of_spread = (np.subtract(*pair) for pair in zip(_slopes(high), _slopes(low), strict=True))
    # A class that no value reaches tells nothing.
    ratios = [np.divide(slope, share, out=np.zeros_like(share), where=share > 0.0) for slope in (of_mean, of_spread)]
    return np.stack([of_mean * ratios[0], of_mean * ratios[1], of_spread * ratios[1]])


def _slopes(bound: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Derivatives of the probability below a bound with respect to the bound and to its logarithm, signs aside."""
    height = np.exp(-0.5 * bound**2) / np.sqrt(2.0 * np.pi)
    return height, np.where(np.isinf(bound), 0.0, bound) * height
