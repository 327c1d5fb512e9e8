"""Levels of intensity that suit a wall, from a grid that does not move with the sliders."""

from __future__ import annotations

import math
import threading
from collections.abc import Sequence

import numpy as np

import dondolo as dd
from dondolo.exchange.cases import Case
from dondolo.records.suite import intensities

# Levels in a decade of the grid, and at most of a study
_PER_DECADE, _MOST = 20, 20
# Measures of record and wall, whose levels are of the order of 1
_OF_WALL = ("pga/a0", "p*pgv/a0")
# Levels of one trial
_TRIAL = 9


def chosen_levels(
    case: Case, few: Sequence[dd.Record], threads: int, stop: threading.Event | None = None
) -> list[float]:
    """Levels from that at which no record overturns the wall to that at which all do, by a trial with a few records."""
    wall = case.population.walls[0]
    solver = dd.Solver(rtol=1e-5, atol=1e-7, edp_limit=case.edp_limit)
    start = wall.trigger_acceleration / wall.gravity
    if case.im in _OF_WALL:
        start = 1.0
    elif case.im != "pga":
        pga, measure = (intensities(tuple(few), im, wall.gravity) for im in ("pga", case.im))
        start *= float(np.median(measure / pga))
    low = high = math.floor(_PER_DECADE * math.log10(max(start, 1e-4)))
    fractions: dict[int, float] = {}
    # Up from the trigger in steps of a seventh of a decade, until all collapse; a wall may need several trials.
    for _ in range(5):
        trial = [high + 3 * step for step in range(_TRIAL)]
        stripes = dd.multiple_stripe(
            wall,
            few,
            [_level(place) for place in trial],
            im=case.im,
            polarity=case.polarity,  # type: ignore[arg-type]
            solver=solver,
            threads=threads,
            progress=False,
            stop=stop,
        )
        fractions |= dict(zip(trial, stripes.fraction.tolist(), strict=True))
        high = trial[-1]
        if fractions[high] == 1.0:
            break
    none = [place for place, share in fractions.items() if share == 0.0]
    every = [place for place, share in fractions.items() if share == 1.0]
    low = max(none, default=low)
    high = min((place for place in every if place > low), default=high)
    step = max(1, math.ceil((high - low + 3) / (_MOST - 1)))
    return [_level(place) for place in range(low - 1, high + 3, step)]


def _level(place: int) -> float:
    """A level of the grid, of three digits."""
    return float(f"{10.0 ** (place / _PER_DECADE):.3g}")
