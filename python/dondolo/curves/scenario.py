"""Probability of a curve under one ground motion that is itself uncertain.

The intensity X of an event at a site has a lognormal distribution, as ground-motion models give it: a median m and a
dispersion s of ln X. The probability sought is the mean of the curve,

    P = E[F(X)] = integral of F(m exp(s z)) phi(z) dz.

Lognormal curves
    F = c Phi(ln(x/theta)/beta) gives P = c Phi(ln(m/theta) / sqrt(beta^2 + s^2)).
Straight lines
    Of a + b x between two levels, a is multiplied by P(x1 < X <= x2), and b by the part of the mean of X that lies
    there, m exp(s^2/2) times the same probability of a lognormal whose median is m exp(s^2). Both are exact.
Other curves
    Gauss's rule between the corners of the curve, over nine dispersions on either side of the median, in panels of at
    most half a dispersion.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from dondolo._base.arguments import FloatArray, argument_error, as_levels, as_number, shaped
from dondolo._fortran.curves import probability
from dondolo.curves.curve import Curve
from dondolo.curves.discrete import DiscreteFragility
from dondolo.curves.fragility import Fragility
from dondolo.curves.limited import LimitedFragility

# Dispersions on either side of the median that are integrated over, beyond which 1e-19 is left
_REACH = 9.0
# Panels of half a dispersion, and points of Gauss's rule in each
_PANEL, _POINTS = 0.5, 10
# Values of a curve that are held at a time
_AT_A_TIME = 200_000


def scenario_probability(curve: Curve, median: ArrayLike, dispersion: float) -> Any:
    """Mean of a curve over a lognormal intensity: see `Curve.scenario`."""
    values = as_levels(median)
    sigma = as_number("dispersion", dispersion)
    if not 0.0 <= sigma <= 3.0:
        raise argument_error("out_of_range", "dispersion", f" = {sigma:g}: must lie between 0 and 3 (of ln x)")
    medians = values.ravel()
    if not np.isfinite(medians).all():
        raise argument_error("out_of_range", "median", " = inf: must be finite")
    found = np.zeros(len(medians))
    moving = medians > 0.0
    if sigma == 0.0:
        found[moving] = curve(medians[moving])
    elif isinstance(curve, Fragility) and not isinstance(curve, LimitedFragility):
        curve._need_fit()
        both = float(np.hypot(curve.beta, sigma))
        found[moving] = curve.upper_asymptote * probability(curve.theta, both, medians[moving])
    elif isinstance(curve, DiscreteFragility):
        found[moving] = _of_lines(curve, medians[moving], sigma)
    else:
        curve._need_fit()
        found[moving] = _by_quadrature(curve, medians[moving], sigma)
    return shaped(found, values)


def _below(x: FloatArray, medians: FloatArray, sigma: float) -> FloatArray:
    """Probabilities (medians, levels) that lognormal intensities do not exceed levels."""
    ratio = x[None, :] / medians[:, None]
    return np.asarray(probability(1.0, sigma, ratio.ravel())).reshape(ratio.shape)


def _of_lines(curve: DiscreteFragility, medians: FloatArray, sigma: float) -> FloatArray:
    """Means of straight lines."""
    x, p = curve._lines
    least = curve._least
    if least > x[0]:
        # Nothing is damaged up to the limit, where the curve jumps.
        kept = x > least
        p = np.append(np.interp(least, x, p), p[kept])
        x = np.append(least, x[kept])
    slope = np.diff(p) / np.diff(x)
    share = np.diff(_below(x, medians, sigma), axis=1)
    mean = medians * np.exp(0.5 * sigma * sigma)
    part = mean[:, None] * np.diff(_below(x, medians * np.exp(sigma * sigma), sigma), axis=1)
    # From the end that is nearer in probability: no difference of what is nearly the same
    inner = share @ (p[:-1] - slope * x[:-1]) + part @ slope
    return np.asarray(np.clip(inner + p[-1] * (1.0 - _below(x[-1:], medians, sigma)[:, 0]), 0.0, 1.0))


def _by_quadrature(curve: Curve, medians: FloatArray, sigma: float) -> FloatArray:
    """Means of a curve by Gauss's rule between its corners."""
    nodes, weights = np.polynomial.legendre.leggauss(_POINTS)
    corners = np.log([corner for corner in curve._corners if 0.0 < corner < np.inf])
    found = np.empty(len(medians))
    points: list[FloatArray] = []
    shares: list[FloatArray] = []
    first = 0
    for number, centre in enumerate(np.log(medians)):
        z = (corners - centre) / sigma
        ends = np.unique(np.concatenate([np.arange(-_REACH, _REACH + _PANEL, _PANEL), z[np.abs(z) < _REACH]]))
        half, middle = 0.5 * np.diff(ends), 0.5 * (ends[:-1] + ends[1:])
        at = (middle[:, None] + half[:, None] * nodes).ravel()
        share = (half[:, None] * weights).ravel() * np.exp(-0.5 * at * at) / np.sqrt(2.0 * np.pi)
        points.append(np.exp(centre + sigma * at))
        shares.append(share)
        if sum(map(len, points)) >= _AT_A_TIME or number == len(medians) - 1:
            values = np.asarray(curve(np.concatenate(points)), dtype=np.float64)
            starts = np.concatenate([[0], np.cumsum([len(one) for one in points])[:-1]])
            found[first : number + 1] = np.add.reduceat(values * np.concatenate(shares), starts)
            points, shares, first = [], [], number + 1
    return np.clip(found, 0.0, 1.0)
