"""Profile likelihood of a fitted curve.

P = Phi(b0 + b1 ln x) with b1 = 1/beta > 0 has a concave log likelihood. Each quantity of interest fixes one line in the
plane of (b0, b1); its profile is the maximum along that line, and its interval is where the profile lies less than half
a quantile of chi-squared below the top (Venzon and Moolgavkar 1988). The three lines are

- the probability at a level x0: b0 + b1 ln x0 = h, along b1;
- the median: the same with h = 0 and x0 = theta, along b1;
- the dispersion: b1 = 1/beta, along b0.
"""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from dondolo._base.arguments import FloatArray

_MOST_STEPS = 100
_SEARCHES = 60


class Likelihood:
    """Binomial likelihood of stripes, without the coefficients.

    Parameters
    ----------
    levels, collapses, histories : ndarray, shape (levels,)
        What was counted.
    theta, beta : float
        The maximum.
    """

    def __init__(
        self, levels: FloatArray, collapses: FloatArray, histories: FloatArray, theta: float, beta: float
    ) -> None:
        self.x = np.log(levels / theta)
        self.collapses = collapses
        self.survivals = histories - collapses
        self.slope = 1.0 / beta
        self.top = float(self._height(self.slope * self.x))

    def _height(self, eta: FloatArray) -> FloatArray:
        from scipy.special import log_ndtr

        found: FloatArray = (self.collapses * log_ndtr(eta) + self.survivals * log_ndtr(-eta)).sum(axis=-1)
        return found

    def _along(self, offset: FloatArray, direction: FloatArray, start: FloatArray, positive: bool) -> FloatArray:
        """Maxima of the likelihood over c of eta = offset + c direction, row by row; Newton with halved steps."""
        from scipy.special import log_ndtr

        c = start.copy()
        height = self._height(offset + c[:, None] * direction)
        for _ in range(_MOST_STEPS):
            eta = offset + c[:, None] * direction
            log_phi = -0.5 * eta**2 - 0.5 * np.log(2.0 * np.pi)
            up = np.exp(log_phi - log_ndtr(eta))
            down = np.exp(log_phi - log_ndtr(-eta))
            score = ((self.collapses * up - self.survivals * down) * direction).sum(axis=1)
            weight = self.collapses * up * (up + eta) + self.survivals * down * (down - eta)
            curvature = (weight * direction**2).sum(axis=1)
            step = np.divide(score, curvature, out=np.zeros_like(score), where=curvature > 0.0)
            if positive:
                step = np.maximum(step, -c)
            for _ in range(_MOST_STEPS):
                trial = self._height(offset + (c + step)[:, None] * direction)
                worse = trial < height - 1e-13 * np.abs(height)
                if not worse.any():
                    break
                step[worse] *= 0.5
            c += step
            height = np.maximum(trial, height)
            if np.all(np.abs(step) <= 1e-10 * (1.0 + np.abs(c))):
                break
        return height

    def at_probit(self, at: FloatArray, probit: FloatArray) -> FloatArray:
        """Profile of the probit h of the probability at levels; `at` is ln of level / theta."""
        start = np.full(len(at), self.slope)
        return self._along(probit[:, None], self.x - at[:, None], start, True)

    def at_slope(self, slope: FloatArray) -> FloatArray:
        """Profile of the slope b1."""
        return self._along(slope[:, None] * self.x, np.ones_like(self.x), np.zeros(len(slope)), False)

    def probit_interval(self, at: FloatArray, step: FloatArray, drop: float) -> tuple[FloatArray, FloatArray]:
        """Interval of the probit at levels; `step` is about its half width, `drop` how far the profile may fall."""

        def short(h: FloatArray, at: FloatArray) -> FloatArray:
            return self.top - drop - self.at_probit(at, h)

        low, high = (_root(short, self.slope * at, sign * step, at) for sign in (-1.0, 1.0))
        return low, high

    def median_interval(self, step: float, drop: float) -> tuple[float, float]:
        """Interval of ln theta, relative to the fitted one; infinite where the data leave it open."""

        def short(at: FloatArray) -> FloatArray:
            return self.top - drop - self.at_probit(at, np.zeros(len(at)))

        low, high = (float(_root(short, np.zeros(1), np.array([sign * step]))[0]) for sign in (-1.0, 1.0))
        return low, high

    def slope_interval(self, step: float, drop: float) -> tuple[float, float]:
        """Interval of the slope b1, from 0 where the data leave it open."""

        def short(slope: FloatArray) -> FloatArray:
            return self.top - drop - self.at_slope(slope)

        centre = np.array([self.slope])
        upper = float(_root(short, centre, np.array([step]))[0])
        if short(np.zeros(1))[0] <= 0.0:
            return 0.0, upper
        return float(_between(short, np.zeros(1), centre)[0]), upper


def _root(short: Callable[..., FloatArray], inside: FloatArray, step: FloatArray, *arguments: FloatArray) -> FloatArray:
    """Where a function that is negative at `inside` becomes positive in the direction of `step`, element by element."""
    outside = inside + step
    for _ in range(_SEARCHES):
        still = short(outside, *arguments) <= 0.0
        if not still.any():
            break
        outside = np.where(still, inside + 2.0 * (outside - inside), outside)
    else:
        outside = np.where(still, np.copysign(np.inf, step), outside)
    shut = np.isfinite(outside)
    outside[shut] = _between(short, inside[shut], outside[shut], *(one[shut] for one in arguments))
    return outside


def _between(
    short: Callable[..., FloatArray], one: FloatArray, other: FloatArray, *arguments: FloatArray
) -> FloatArray:
    """Zeros of a function between points where its signs differ, element by element."""
    from scipy.optimize import elementwise

    ends = np.minimum(one, other), np.maximum(one, other)
    root: FloatArray = elementwise.find_root(short, ends, args=arguments, tolerances={"xatol": 0.0, "xrtol": 1e-13}).x
    return root
