"""How much friction the motions of stripes need: histories in which the wall would slide."""

from __future__ import annotations

import warnings
from collections.abc import Iterable, Mapping

import numpy as np

from dondolo._base.arguments import FloatArray, instance_of
from dondolo.analysis.certificate import records_of
from dondolo.analysis.request import progress_bar
from dondolo.analysis.response import simulate
from dondolo.analysis.solver import Solver
from dondolo.analysis.stripes import Stripes
from dondolo.errors import DondoloWarning
from dondolo.records.record import Record


def friction_demand(
    stripes: Stripes,
    records: Record | Iterable[Record] | Mapping[float, Record | Iterable[Record]],
    *,
    progress: bool = True,
) -> FloatArray:
    """Coefficient of friction that each history needs so that the wall does not slide while it rocks.

    Parameters
    ----------
    stripes : Stripes
        Stripes of a wall that is a rectangular block.
    records : Record, iterable of Record, RecordSet, or mapping of float to these
        The accelerograms that they were run with.
    progress : bool
        Show a progress bar in a terminal or notebook.

    Returns
    -------
    ndarray, shape (levels, histories)
        `Response.friction_demand` of each history: 0 where the wall does not move, infinite where it would lift off,
        NaN where a record does not run.

    Raises
    ------
    InputError
        No stripes, other records, or a wall that is more than a rectangular block.

    Notes
    -----
    Stripes keep peaks and no forces: every history in which the wall moves is run again, with its motion. Wall and
    records are those of the stripes, so that the motions are too.

    Examples
    --------
    >>> import dondolo as dd
    >>> records = dd.synthetic_records(magnitude=6.5, distance=10.0, site="shallow", count=4)
    >>> stripes = dd.multiple_stripe(dd.OneSidedWall(1.5, 0.25), records, [0.3, 0.9], progress=False)
    >>> demand = dd.friction_demand(stripes, records, progress=False)
    >>> sliding = (demand > 0.6).sum(axis=1)
    >>> sliding.shape
    (2,)
    """
    instance_of("stripes", stripes, Stripes, "no stripes")
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
        for level, history in moved:
            factor = stripes.scale[level, history] * stripes.polarity[history]
            record = several[stripes.record_index[history]]
            demand[level, history] = simulate(stripes.wall, record, factor, solver=solver).friction_demand()
            bar.update(1)
    return demand
