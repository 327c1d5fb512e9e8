"""Integrals of a probability over a hazard curve, which is a power law H(x) = H_j (x/x_j)^-k between two levels.

With u = ln x it is the integral of P k H du, between cuts of which each two lie in one step of the curve.

Lognormal
    P = Pi Phi(z), z = (u - ln theta)/beta. By parts, and since phi(z) H is again a normal density times a constant, the
    integral has a closed form. With the Mills ratio M(t) = (1 - Phi(t))/phi(t) and a = z + k beta it is, from -inf
    to u and from u to inf,

        B(u) = Pi H(u) phi(z) (M(-a) - M(-z)),    T(u) = Pi H(u) (Phi(z) + phi(z) M(a)).

    Below a = 0 the part of a step is a difference of B, above it one of T: there they are small where the part is, so
    that the digits of the tails are kept; and phi H and M are at hand where H alone would overflow.
Other curves
    Gauss's rule in panels, which are halved until the integral of each changes by less than its share of 10^-8 of the
    whole.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from dondolo._arguments import FloatArray
from dondolo.errors import DondoloError
from dondolo.fragility import Fragility
from dondolo.hazard import HazardCurve

# Relative error that an integral aims at
_TOLERANCE = 1e-8
# The least part of that error that a panel is allowed
_SMALLEST_SHARE = 1e-3
# Points of Gauss's rule in a panel, how often a panel is halved, and how many there may be
_NODES = 8
_HALVINGS = 60
_MOST_PANELS = 1_000_000


def lognormal_integrals(curve: Fragility, hazard: HazardCurve, cuts: FloatArray) -> FloatArray:
    """Integrals of a fitted curve between cuts.

    Parameters
    ----------
    curve : Fragility
        With a fit.
    hazard : HazardCurve
        Its first and last power laws go on beyond the levels.
    cuts : ndarray, shape (parts + 1,)
        In ln x, increasing; the first may be -inf, the last inf.

    Returns
    -------
    ndarray, shape (parts,)
        [1/year]; inf where there is no such number.
    """
    from scipy.special import erfcx, log_ndtr

    low, high = cuts[:-1], cuts[1:]
    k, start, frequency = hazard._power_laws(low)
    mean, beta = np.log(curve.theta), curve.beta

    def logarithms(u: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        # z, a, and the logarithm of exp(-z^2/2) H
        z = (u - mean) / beta
        return z, z + k * beta, np.log(frequency) - k * (u - start) - 0.5 * z**2

    # M(t) phi(t) is exp(-t^2/2) erfcx(t/sqrt(2))/2
    def below(u: FloatArray) -> FloatArray:
        z, a, density = logarithms(u)
        found = 0.5 * np.exp(density) * (erfcx(-a / np.sqrt(2.0)) - erfcx(-z / np.sqrt(2.0)))
        return np.where(np.isfinite(u), found, 0.0)

    def above(u: FloatArray) -> FloatArray:
        z, a, density = logarithms(u)
        found = np.exp(density + 0.5 * z**2 + log_ndtr(z)) + 0.5 * np.exp(density) * erfcx(a / np.sqrt(2.0))
        return np.where(np.isfinite(u), found, 0.0)

    middle = mean - k * beta**2
    with np.errstate(over="ignore", invalid="ignore"):
        left = np.where(low < middle, below(np.minimum(high, middle)) - below(low), 0.0)
        right = np.where(high > middle, above(np.maximum(low, middle)) - above(high), 0.0)
    # Where H is level there is nothing but rounding
    return curve.saturation * np.where(k > 0.0, left + right, 0.0)


def integrals(integrand: Callable[[FloatArray], FloatArray], cuts: FloatArray) -> tuple[FloatArray, float]:
    """Integrals of a function between cuts by Gauss's rule.

    Panels are halved where that changes their integral, all at once: a call of the mean of many walls takes long,
    whatever the number of points, and libraries call point by point.

    Parameters
    ----------
    integrand : callable
        Of u = ln x, not negative; inf where it is beyond all numbers.
    cuts : ndarray, shape (parts + 1,)
        In ln x, increasing.

    Returns
    -------
    parts : ndarray, shape (parts,)
        inf where the integrand is.
    error : float
        Estimated error of their sum.

    Raises
    ------
    DondoloError
        The integrand is too rough.
    """
    node, weight = np.polynomial.legendre.leggauss(_NODES)

    def gauss(low: FloatArray, high: FloatArray) -> FloatArray:
        half = 0.5 * (high - low)
        points = (low + half)[:, None] + half[:, None] * node
        return integrand(points.ravel()).reshape(points.shape) @ weight * half

    low, high = cuts[:-1], cuts[1:]
    owner = np.arange(len(low))
    coarse, done, error = gauss(low, high), np.zeros(len(low)), 0.0
    for _ in range(_HALVINGS):
        if len(low) > _MOST_PANELS:
            raise DondoloError("fragility: is too rough to be integrated")
        middle = 0.5 * (low + high)
        fine = gauss(np.append(low, middle), np.append(middle, high)).reshape(2, -1)
        both = fine.sum(axis=0)
        with np.errstate(invalid="ignore"):
            off = np.abs(both - coarse)
        share = (high - low) / (cuts[-1] - cuts[0])
        # A jump never earns the share of its panel
        allowed = _TOLERANCE * (done.sum() + both.sum()) * np.maximum(share, _SMALLEST_SHARE)
        settled = (off <= allowed) | np.isinf(both)
        np.add.at(done, owner[settled], both[settled])
        error += float(off[settled].sum())
        rough = ~settled
        if not rough.any():
            return done, error
        low, high = np.append(low[rough], middle[rough]), np.append(middle[rough], high[rough])
        owner, coarse = np.tile(owner[rough], 2), fine[:, rough].ravel()
    # What is left are panels about jumps, too narrow to matter
    np.add.at(done, owner, coarse)
    return done, error + float(np.abs(coarse).sum())
