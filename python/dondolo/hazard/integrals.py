"""Integrals of a probability over a hazard curve, which is a power law H(x) = H_j (x/x_j)^-k between two levels.

With u = ln x it is the integral of P k H du, between cuts of which each two lie in one step of the curve.

Lognormal
    P = Phi(z), z = (u - ln theta)/beta. By parts, and since phi(z) H is again a normal density times a constant, the
    integral has a closed form. With the Mills ratio M(t) = (1 - Phi(t))/phi(t) and a = z + k beta it is, from -inf
    to u and from u to inf,

        B(u) = H(u) phi(z) (M(-a) - M(-z)),    T(u) = H(u) (Phi(z) + phi(z) M(a)).

    Below a = 0 the part of a step is a difference of B, above it one of T: there they are small where the part is, so
    that the digits of the tails are kept; and phi H and M are at hand where H alone would overflow. Where k beta is
    small the difference in B is an integral of -M'(t) = 1 - t M(t), by Gauss's rule of two points. By hand, since
    `scipy.integrate.quad_vec` takes ten times as long for 1000 curves.
Other curves
    Gauss's rule in panels, which are halved until the integral of each changes by less than its share of 10^-8 of the
    whole. Several curves are integrated together. By hand, since `quad_vec` asks for one intensity at a time, and
    curves of populations, and functions of users, are quick for many at once alone.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from dondolo._base.arguments import FloatArray
from dondolo.errors import DondoloError
from dondolo.hazard.hazard import HazardCurve

# A probability at intensities (points,), of one curve or of several: (..., points)
Probability = Callable[[FloatArray], FloatArray]

# Relative error that an integral aims at
_TOLERANCE = 1e-8
# The least part of that error that a panel is allowed
_SMALLEST_SHARE = 1e-3
# Points of Gauss's rule in a panel, how often a panel is halved, and how many there may be
_NODES = 8
_HALVINGS = 60
_MOST_PANELS = 1_000_000
# Below this k beta the difference of two Mills ratios has lost the digits that their derivative has
_NEAR = 1e-3
# A normal quantile beyond all tails, whose square is a number
_FAR_TAIL = 1e150
# A range without end is cut there, in ln x, and into such steps; the lowest must not add more than this part
_FAR = 50.0
_STEP = 0.5
_NEGLIGIBLE = 1e-12


class Contributions(NamedTuple):
    """What intensities contribute to annual frequencies [1/year], of one curve or of several, shape (...).

    Attributes
    ----------
    inside : ndarray
        Within the levels; all of them, for a power law without end.
    below, above : ndarray
        At most below the lowest level, inf if that has no bound; at least above the highest.
    error : ndarray
        Estimated error of `inside`.
    """

    inside: FloatArray
    below: FloatArray
    above: FloatArray
    error: FloatArray


def of_lognormal(theta: FloatArray, beta: FloatArray, hazard: HazardCurve) -> Contributions:
    """What intensities contribute where the probability is Phi(ln(x/theta)/beta)."""
    from scipy.special import ndtr

    nothing = np.zeros(np.shape(theta))
    if hazard.endless:
        return Contributions(
            lognormal_integrals(theta, beta, hazard, np.array([-np.inf, np.inf]))[..., 0], nothing, nothing, nothing
        )
    cuts = np.log(hazard.levels)
    inside = lognormal_integrals(theta, beta, hazard, cuts).sum(axis=-1)
    below = lognormal_integrals(theta, beta, hazard, np.array([-np.inf, cuts[0]]))[..., 0]
    with np.errstate(over="ignore"):
        above = ndtr((cuts[-1] - np.log(theta)) / beta) * hazard.annual_frequency[-1]
    return Contributions(inside, below, above, nothing)


def of_function(
    probability: Probability,
    hazard: HazardCurve,
    ends: tuple[float, float] = (-_FAR, _FAR),
    corners: tuple[float, ...] = (),
) -> Contributions:
    """What intensities contribute where the probability is a function; an endless power law may give inf.

    The ends are those, in ln x, below which the probability does not count, and above which it stays; the corners are
    levels at which it has a jump or a kink. Raises DondoloError where the function is too rough.
    """

    def parts_of(cuts: FloatArray) -> tuple[FloatArray, FloatArray]:
        return integrals(lambda u: integrand(probability, hazard, u), cuts)

    def steps(low: float, high: float) -> FloatArray:
        return with_corners(np.linspace(low, high, math.ceil((high - low) / _STEP) + 1), corners)

    def converged(parts: FloatArray, beside: FloatArray | float = 0.0) -> FloatArray:
        whole = beside + parts.sum(axis=-1)
        return np.where((parts[..., 0] <= _NEGLIGIBLE * whole) & (whole < np.inf), parts.sum(axis=-1), np.inf)

    low, top = max(ends[0], -_FAR), min(ends[1], _FAR)
    if hazard.endless:
        parts, error = parts_of(steps(low, top))
        # What is still above: between the probability there and 1
        p, h = probability(np.exp([top]))[..., 0], float(hazard(np.exp(top)))
        return Contributions(converged(parts) + p * h, 0.0 * p, 0.0 * p, error + (1.0 - p) * h)
    cuts = with_corners(np.log(hazard.levels), corners)
    parts, error = parts_of(cuts)
    inside = parts.sum(axis=-1)
    # Far enough for its lowest step to tell whether there is an end
    below, _ = parts_of(steps(min(low, cuts[0]) - 10.0 * _STEP, cuts[0]))
    above = probability(hazard.levels[-1:])[..., 0] * hazard.annual_frequency[-1]
    return Contributions(inside, converged(below, inside), above, error)


def with_corners(cuts: FloatArray, corners: tuple[float, ...]) -> FloatArray:
    """Cuts in ln x, and between them those of levels at which a curve has a jump or a kink."""
    with np.errstate(divide="ignore"):
        inner = np.log(corners)
    return np.union1d(cuts, inner[(inner > cuts[0]) & (inner < cuts[-1])]) if len(corners) else cuts


def integrand(probability: Probability, hazard: HazardCurve, u: FloatArray) -> FloatArray:
    """P(C | x) |dH/d(ln x)| at u = ln x."""
    k, start, frequency = hazard._power_laws(u)
    # Below the levels H may overflow where P vanishes, but not their logarithms
    with np.errstate(divide="ignore", over="ignore"):
        return k * np.exp(np.log(probability(np.exp(u))) + np.log(frequency) - k * (u - start))


def nodes(hazard: HazardCurve, reach: tuple[float, float]) -> tuple[FloatArray, FloatArray]:
    """Points u = ln x and weights by which sum(weights * P) is an annual frequency, for the smooth P of many walls.

    Of a power law without end between the ends of the reach, in x; of levels, P H at the highest is part of it, the
    lower bound of what is above.
    """
    point, weight = np.polynomial.legendre.leggauss(_NODES)
    ends = np.log(hazard.levels)
    if hazard.endless:
        with np.errstate(divide="ignore"):
            ends = np.clip(np.log(reach), -_FAR, _FAR)
    cuts = [np.linspace(low, high, math.ceil((high - low) / _STEP) + 1)[:-1] for low, high in pairwise(ends)]
    low = np.concatenate(cuts)
    half = 0.5 * np.diff(np.append(low, ends[-1]))[:, None]
    u = ((low[:, None] + half) + half * point).ravel()
    k, start, frequency = hazard._power_laws(u)
    weights = (half * weight).ravel() * k * frequency * np.exp(-k * (u - start))
    if hazard.endless:
        return u, weights
    return np.append(u, ends[-1]), np.append(weights, hazard.annual_frequency[-1])


def lognormal_integrals(theta: FloatArray, beta: FloatArray, hazard: HazardCurve, cuts: FloatArray) -> FloatArray:
    """Integrals of lognormal curves between cuts.

    Parameters
    ----------
    theta, beta : ndarray, shape (...)
        Medians and dispersions.
    hazard : HazardCurve
        Its first and last power laws go on beyond the levels.
    cuts : ndarray, shape (parts + 1,)
        In ln x, increasing; the first may be -inf, the last inf.

    Returns
    -------
    ndarray, shape (..., parts)
        [1/year]; inf where there is no such number.
    """
    from scipy.special import erfcx, log_ndtr

    low, high = cuts[:-1], cuts[1:]
    k, start, frequency = hazard._power_laws(low)
    mean, beta = np.log(theta)[..., None], np.asarray(beta)[..., None]

    def logarithms(u: FloatArray) -> tuple[FloatArray, FloatArray, FloatArray]:
        # z, of which infinities would make NaN; a; and the logarithm of H
        z = np.clip((u - mean) / beta, -_FAR_TAIL, _FAR_TAIL)
        return z, z + k * beta, np.log(frequency) - k * (u - start)

    # M(t) phi(t) is exp(-t^2/2) erfcx(t/sqrt(2))/2
    def below(u: FloatArray) -> FloatArray:
        z, a, ln_h = logarithms(u)
        difference = erfcx(-a / np.sqrt(2.0)) - erfcx(-z / np.sqrt(2.0))
        near = k * beta < _NEAR
        if near.any():
            middle, half = -0.5 * (a + z), 0.5 * k * beta / np.sqrt(3.0)
            falls = [np.sqrt(2.0 / np.pi) - t * erfcx(t / np.sqrt(2.0)) for t in (middle - half, middle + half)]
            difference = np.where(near, 0.5 * k * beta * (falls[0] + falls[1]), difference)
        return np.where(np.isfinite(u), 0.5 * np.exp(ln_h - 0.5 * z**2) * difference, 0.0)

    def above(u: FloatArray) -> FloatArray:
        z, a, ln_h = logarithms(u)
        found = np.exp(ln_h + log_ndtr(z)) + 0.5 * np.exp(ln_h - 0.5 * z**2) * erfcx(a / np.sqrt(2.0))
        return np.where(np.isfinite(u), found, 0.0)

    middle = mean - k * beta**2
    with np.errstate(over="ignore", invalid="ignore"):
        left = np.where(low < middle, below(np.minimum(high, middle)) - below(low), 0.0)
        right = np.where(high > middle, above(np.maximum(low, middle)) - above(high), 0.0)
    # Where H is level there is nothing but rounding, and no integral is negative
    return np.where(k > 0.0, np.maximum(left + right, 0.0), 0.0)


def integrals(function: Callable[[FloatArray], FloatArray], cuts: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Integrals of functions between cuts by Gauss's rule.

    Panels are halved where that changes their integral, all at once: a call of the mean of many walls takes long,
    whatever the number of points, and libraries call point by point.

    Parameters
    ----------
    function : callable
        Of u = ln x (points,), with values (..., points) that are not negative; inf where they are beyond all numbers.
    cuts : ndarray, shape (parts + 1,)
        In ln x, increasing.

    Returns
    -------
    parts : ndarray, shape (..., parts)
        inf where the function is.
    error : ndarray, shape (...)
        Estimated error of their sum.

    Raises
    ------
    DondoloError
        The function is too rough.
    """
    node, weight = np.polynomial.legendre.leggauss(_NODES)

    def gauss(low: FloatArray, high: FloatArray) -> FloatArray:
        half = 0.5 * (high - low)
        points = (low + half)[:, None] + half[:, None] * node
        values = function(points.ravel())
        return values.reshape(values.shape[:-1] + points.shape) @ weight * half

    low, high = cuts[:-1], cuts[1:]
    owner = np.arange(len(low))
    coarse = gauss(low, high)
    done, error = np.zeros(coarse.shape), np.zeros(coarse.shape[:-1])
    by_panel = np.moveaxis(done, -1, 0)
    for _ in range(_HALVINGS):
        if len(low) > _MOST_PANELS:
            raise DondoloError("fragility: is too rough to be integrated")
        middle = 0.5 * (low + high)
        halves = gauss(np.append(low, middle), np.append(middle, high))
        fine = halves[..., : len(low)] + halves[..., len(low) :]
        with np.errstate(invalid="ignore"):
            off = np.abs(fine - coarse)
        total = done.sum(axis=-1) + fine.sum(axis=-1)
        # A jump never earns the share of its panel
        share = np.maximum((high - low) / (cuts[-1] - cuts[0]), _SMALLEST_SHARE)
        enough = (off <= _TOLERANCE * total[..., None] * share) | np.isinf(fine)
        settled = enough.reshape(-1, len(low)).all(axis=0)
        np.add.at(by_panel, owner[settled], np.moveaxis(fine[..., settled], -1, 0))
        error += off[..., settled].sum(axis=-1)
        rough = ~settled
        if not rough.any():
            return done, error
        owner, coarse = np.tile(owner[rough], 2), halves[..., np.tile(rough, 2)]
        low, high = np.append(low[rough], middle[rough]), np.append(middle[rough], high[rough])
    # What is left are panels about jumps, too narrow to matter
    np.add.at(by_panel, owner, np.moveaxis(coarse, -1, 0))
    return done, error + np.abs(coarse).sum(axis=-1)
