"""Range of the levels of lognormal curves in a fragility model: from where they begin to where they end."""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from dondolo.curves.fragility import Fragility
from dondolo.curves.limited import LimitedFragility
from dondolo.curves.state_order import crossing

# Dispersions from the medians to the ends of the range of a function
_REACH_DOWN, _REACH_UP = 6.0, 3.0
# Where curves cross at such a probability, or at its complement, the range may end there
RARE = 1e-3


def range_of(curves: list[Fragility]) -> tuple[float, float]:
    """Where lognormal curves begin and end; where limits are given, within these."""
    low, high = given_range(curves, None, None)
    limits = [curve.limits for curve in curves if isinstance(curve, LimitedFragility)]
    lowest = [limit.min_iml for limit in limits if limit.min_iml is not None]
    highest = [limit.max_iml for limit in limits if limit.max_iml is not None]
    return max([low, *lowest]), min([high, *highest])


def given_range(curves: list[Fragility], min_iml: float | None, max_iml: float | None) -> tuple[float, float]:
    """What is given, or where the curves begin and end."""
    low = min(curve.theta * np.exp(-_REACH_DOWN * curve.beta) for curve in curves)
    high = max(curve.theta * np.exp(_REACH_UP * curve.beta) for curve in curves)
    for cross, is_below in unseen_crossings(curves):
        if is_below:
            low = max(low, cross)
        else:
            high = min(high, cross)
    return float(low if min_iml is None else min_iml), float(high if max_iml is None else max_iml)


def unseen_crossings(curves: list[Fragility]) -> list[tuple[float, bool]]:
    """Where states that follow each other cross at a probability that nobody sees, and whether below what is seen."""
    found = []
    for lighter, heavier in pairwise(curves):
        cross = crossing(lighter, heavier)
        # The heavier curve is the higher one below the crossing if it is the flatter, above if it is the steeper.
        if lighter.beta < heavier.beta and lighter(cross) <= RARE:
            found.append((cross, True))
        if lighter.beta > heavier.beta and lighter(cross) >= 1.0 - RARE:
            found.append((cross, False))
    return found
