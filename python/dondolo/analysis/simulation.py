"""Simulation of one motion of one wall."""

from __future__ import annotations

import functools
from copy import copy
from typing import Any

import numpy as np

from dondolo._base.arguments import as_flag, as_number, instance_of
from dondolo._fortran import _core
from dondolo._fortran.histories import warnings_of_errors, warnings_of_motion
from dondolo._fortran.library import Stoppable, as_text, check, receive, warn
from dondolo.analysis.response import Response
from dondolo.analysis.solver import Solver, as_solver
from dondolo.errors import DondoloWarning
from dondolo.records.record import Record
from dondolo.records.suite import place_of
from dondolo.walls.ties import number_of_ties
from dondolo.walls.wall import Wall, upload


def simulate(
    wall: Wall,
    record: Record,
    scale: float = 1.0,
    *,
    initial_rotation: float = 0.0,
    initial_velocity: float = 0.0,
    solver: Solver | None = None,
    history: bool = True,
    estimate_error: bool = False,
) -> Response:
    """The motion of a wall under an accelerogram.

    Parameters
    ----------
    wall : Wall
        The wall.
    record : Record
        The accelerogram.
    scale : float
        Factor on it; negative reverses its polarity.
    initial_rotation : float
        Rotation of the wall at the start [rad], positive towards side 1; less than what counts as collapse. A one-sided
        wall has only side 1.
    initial_velocity : float
        Its angular velocity at the start [rad/s], positive towards side 1.
    solver : Solver, optional
        How the motion is integrated.
    history : bool
        Whether to keep the time history.
    estimate_error : bool
        Whether to run it twice more, to estimate the error of the EDP.

    Returns
    -------
    Response

    Raises
    ------
    InputError
        An invalid setting; the message is that of the executable.

    Warns
    -----
    DondoloWarning
        A wall or a PGA that looks as if it were given in another unit, a record without motion; with an estimated
        error, a history in doubt.

    Notes
    -----
    One motion is far less certain than a curve: on a shake table, ln(measured / computed capacity) of two boulders
    under single motions scattered with a standard deviation of 0.30 and 0.37 (docs/experiments.md).

    Equations (1) to (4) of Nale et al.; docs/theory.md, section 4. The engine is that of the stripes: EDP, flag,
    impacts and estimated error are those that `multiple_stripe` gives this history, to the bit. A wall that is not at
    rest at the start is integrated by 'rk45'.

    Examples
    --------
    >>> import dondolo as dd
    >>> wall = dd.OneSidedWall(1.5, 0.25, name="parapet")
    >>> record = dd.synthetic_records(6.5, 10.0, "shallow", n_records=1)[0]
    >>> response = dd.simulate(wall, record, scale=2.0)
    >>> response.collapsed, len(response.time) == len(response.rotation)
    (False, True)
    >>> response.ties is None or response.uplift
    False

    Free rocking on still ground:

    >>> still = dd.Record([0.0, 0.0], 0.01, name="still")
    >>> released = dd.simulate(wall, still, initial_rotation=0.5 * wall.capacity_angle)
    >>> released.edp, float(released.time[released.rotation == 0.0][0]) > 0.5
    (0.5, False)
    """
    instance_of("wall", wall, Wall)
    instance_of("record", record, Record)
    factor = as_number("scale", scale)
    rotation = as_number("initial_rotation", initial_rotation)
    velocity = as_number("initial_velocity", initial_velocity)
    history, estimate_error = as_flag("history", history), as_flag("estimate_error", estimate_error)
    how = as_solver(solver)
    settings = how._settings(estimate_error)
    handle, (suite, place) = upload((wall,)), place_of(record)
    with Stoppable():
        edp, collapsed, impacts, time_of_peak, edp_error, sent = _core.histories.simulate(
            handle.number,
            suite.number,
            place,
            factor,
            as_text("engine", how.engine),
            rotation,
            velocity,
            int(history),
            **settings._asdict(),
        )
    check(sent)
    motion: dict[str, Any] = {}
    # What was sent is received before anything is warned of, since a warning may be an error.
    if history:
        parcel = receive(sent)
        motion = {name: parcel[name] for name in ("time", "ground_acceleration", "rotation", "velocity")}
        motion |= {"side": parcel["side"].astype(np.int8), "after_impact": parcel["after_impact"] == 1}
        if number_of_ties(wall):
            times = np.column_stack([parcel["time_of_yield"], parcel["time_of_fracture"]])
            motion["tie_times"] = np.where(times < 0.0, np.nan, times)
    # Each its own: one that is raised as an error keeps what raised it.
    of_scale, moves = factor if record.vertical is not None else 1.0, (rotation, velocity) != (0.0, 0.0)
    found = [copy(one) for one in _warnings(wall, (suite.number, place), of_scale, moves)]
    if estimate_error:
        found += warnings_of_errors(np.array([edp]), np.array([edp_error]), settings.edp_limit)
    warn(found)
    return Response(
        wall=wall,
        record=record,
        scale=factor,
        edp=edp,
        collapsed=collapsed == 1,
        impacts=impacts,
        time_of_peak=time_of_peak,
        edp_limit=settings.edp_limit,
        edp_error=edp_error if estimate_error else None,
        initial_rotation=rotation,
        initial_velocity=velocity,
        **motion,
    )


@functools.lru_cache
def _warnings(wall: Wall, record: tuple[int, int], scale: float, moves: bool) -> list[DondoloWarning]:
    """What looks odd about a wall and a record; kept, since one motion takes little longer."""
    return warnings_of_motion(upload((wall,)), record, scale, moves)
