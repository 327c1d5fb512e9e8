"""Order of limit states: a state contains the next one, which is never more probable."""

from __future__ import annotations

from collections.abc import Mapping
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from dondolo.curves.discrete import DiscreteFragility
from dondolo.curves.fragility import Fragility

# Of a difference of probits
_ROUNDING = 1e-9


class Disorder(NamedTuple):
    """Two limit states that follow each other, the second of which is the more probable one.

    Attributes
    ----------
    lighter, heavier : str
    where : {'throughout', 'below', 'above', 'at'}
        Side of `level` on which it is; at this level of a discrete function.
    level : float
        Intensity; NaN throughout.
    """

    lighter: str
    heavier: str
    where: str
    level: float

    def __str__(self) -> str:
        place = "" if self.where == "throughout" else f" {self.where} {self.level:.4g}"
        return f"'{self.heavier}' is more probable than '{self.lighter}'{place}"


def crossing(first: Fragility, second: Fragility) -> float:
    """Intensity at which two curves cross: probits are straight lines of ln x. 0 for curves that are parallel."""
    if first.beta == second.beta:
        return 0.0
    rise = 1.0 / first.beta - 1.0 / second.beta
    # Nearly parallel curves cross so far away that it is nowhere.
    with np.errstate(over="ignore"):
        return float(np.exp((np.log(first.theta) / first.beta - np.log(second.theta) / second.beta) / rise))


def disorder_of_lognormals(curves: Mapping[str, Fragility], low: float, high: float) -> Disorder | None:
    """First disorder within a range. The difference of two probits is a straight line of ln x: its ends decide."""
    with np.errstate(divide="ignore"):
        ends = np.log([max(low, 5e-324), high])
    for lighter, heavier in pairwise(curves):
        first, second = curves[lighter], curves[heavier]
        gap = (ends - np.log(first.theta)) / first.beta - (ends - np.log(second.theta)) / second.beta
        if (gap >= -_ROUNDING).all():
            continue
        if (gap <= _ROUNDING).all():
            return Disorder(lighter, heavier, "throughout", np.nan)
        return Disorder(lighter, heavier, "below" if gap[0] < 0.0 else "above", crossing(first, second))
    return None


def disorder_at_levels(curves: Mapping[str, DiscreteFragility]) -> Disorder | None:
    """First disorder of curves of the same levels."""
    for lighter, heavier in pairwise(curves):
        first, second = curves[lighter].probability, curves[heavier].probability
        wrong = second > first
        if wrong.any():
            where = "throughout" if (second >= first).all() else "at"
            level = np.nan if where == "throughout" else float(curves[lighter].levels[wrong][0])
            return Disorder(lighter, heavier, where, level)
    return None
