"""How much friction the motions of stripes need: histories in which the wall would slide."""

from __future__ import annotations

import threading
import warnings
from collections.abc import Iterable, Mapping

import numpy as np

from dondolo._base.arguments import FloatArray
from dondolo._base.interrupts import as_event
from dondolo.analysis.certificate import records_of
from dondolo.analysis.request import progress_bar
from dondolo.analysis.simulation import simulate
from dondolo.analysis.solver import Solver
from dondolo.analysis.stripes import Stripes
from dondolo.errors import DondoloWarning, Interrupted
from dondolo.records.record import Record


def friction_demand(
    stripes: Stripes,
    records: Record | Iterable[Record] | Mapping[float, Record | Iterable[Record]],
    *,
    progress: bool = True,
    stop: threading.Event | None = None,
) -> FloatArray:
    """Coefficient of friction of each history: see `Stripes.friction_demand`."""
    event = as_event(stop)
    several = records_of(stripes, records)
    solver = Solver(
        rtol=stripes.rtol,
        atol=stripes.atol,
        edp_limit=stripes.edp_limit,
        engine="rk45" if stripes.engine.startswith("rk45") else "auto",
    )
    demand = np.where(stripes.ran, 0.0, np.nan)
    moved = np.argwhere(stripes.ran & (stripes.edp > 0.0))
    with progress_bar(len(moved), progress, "friction", "history") as bar, warnings.catch_warnings():
        # The stripes have said it.
        warnings.simplefilter("ignore", DondoloWarning)
        for done, (level, history) in enumerate(moved):
            if event is not None and event.is_set():
                raise Interrupted(f"interrupted: {done} of {len(moved)} histories have their friction")
            factor = stripes.scale[level, history] * stripes.polarity[history]
            record = several[stripes.record_index[history]]
            demand[level, history] = simulate(stripes.wall, record, factor, solver=solver).friction_demand()
            bar.update(1)
    return demand
