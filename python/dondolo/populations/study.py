"""Run a population: walls and records in, the typological curve out."""

from __future__ import annotations

import dataclasses
import os
import threading
from collections.abc import Iterable, Mapping
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from dondolo._base.arguments import FloatArray
from dondolo._base.interrupts import as_event, deferred
from dondolo._fortran.library import as_text, warn
from dondolo._fortran.populations import warnings_of_occurrence
from dondolo.analysis.request import Polarity, new_request
from dondolo.analysis.solver import Solver, as_solver
from dondolo.errors import DondoloWarning, Interrupted
from dondolo.populations.blocks import run_walls
from dondolo.populations.combination import combine
from dondolo.populations.flags import states_of
from dondolo.populations.store import Contents, IntArray
from dondolo.populations.typology import Typology
from dondolo.records.record import Record
from dondolo.walls.population import Population
from dondolo.walls.wall import Wall

if TYPE_CHECKING:
    from concurrent.futures import Executor


def typology(
    population: Population | Iterable[Wall],
    records: Record | Iterable[Record] | Mapping[float, Record | Iterable[Record]],
    levels: ArrayLike | None = None,
    *,
    im: str = "pga",
    polarity: Polarity = "as_recorded",
    solver: Solver | None = None,
    edp_thresholds: ArrayLike | None = None,
    threads: int = 0,
    executor: Executor | None = None,
    checkpoint: str | os.PathLike[str] | None = None,
    block: int | None = None,
    progress: bool = True,
    stop: threading.Event | None = None,
) -> Typology:
    """Fragility of a population of walls.

    Parameters
    ----------
    population : Population or iterable of Wall
        The walls; without weights they count alike.
    records, levels, im, polarity, solver, threads, progress
        As for `multiple_stripe`.
    edp_thresholds : array_like, optional
        Rotations / capacity from which on a history is in a state of damage, increasing and at most `edp_limit`;
        collapse is always the last state. All states come from the same histories. Without thresholds only collapses
        are counted, which takes less time.
    executor : concurrent.futures.Executor, optional
        Where blocks of walls are run (a pool of processes started by "spawn", Dask, MPI); each block then takes one
        thread unless `threads` says otherwise. Without it OpenMP runs the histories of this process. A process that is
        made by a fork works on one thread, whatever `threads` says: OpenMP's other threads do not survive it.
    checkpoint : path, optional
        File that keeps the finished blocks: the same call resumes from it after an interruption, with the same results
        to the bit. It is kept at the end.
    block : int, optional
        Rows of a block (a row is one mechanism of a wall), the unit of checkpoints and executors; as many as take one
        to two seconds if left out. Results do not depend on it.
    stop : threading.Event, optional
        Once another thread has set it, the run ends after its block, as by Ctrl-C.

    Returns
    -------
    Typology

    Raises
    ------
    InputError
        Input that cannot be run; the message is that of the executable; a checkpoint of another study.
    DondoloError
        The executor failed, or the checkpoint cannot be written.
    Interrupted
        Ctrl-C or `stop`; its `partial` is the typology of the walls that are complete.

    Warns
    -----
    DondoloWarning
        Walls or PGAs that look as if they were given in another unit, scale factors above 10,
        walls without a fit, a fit that extrapolates.

    Examples
    --------
    >>> import dondolo as dd
    >>> walls = [dd.OneSidedWall(1.5, 0.25, name="a"), dd.OneSidedWall(1.8, 0.25, name="b")]
    >>> people = dd.Population(walls, group_names=["old", "new"])
    >>> records = dd.synthetic_records(6.5, 10.0, "shallow", n_records=10)
    >>> found = dd.typology(people, records, [0.6, 0.8, 1.0], edp_thresholds=[0.4], progress=False)
    >>> curve = found["all"]
    >>> found.at(0.4)["all"].fit.theta < curve.fit.theta
    True
    >>> curve.fractiles(0.8).shape, curve.probabilities(0.8).shape
    ((3,), (2,))
    """
    people = population if isinstance(population, Population) else Population(population)  # type: ignore[arg-type]
    if executor is not None and threads == 0:
        threads = 1
    limit = as_solver(solver)._settings().edp_limit
    states = states_of(edp_thresholds, limit)
    alone = len(states) == 1
    request = new_request(people.walls, records, levels, im, polarity, solver, threads, collapses_only=alone)
    plan = request.plan(states)
    names = b"".join(as_text("name", name) + b"\n" for name in people.wholes)
    of_occurrence = warnings_of_occurrence(names, people.p_occ, people.alternative_numbers, people._numbers_of_rows)
    with deferred(as_event(stop)) as interrupts:
        run = run_walls(request, plan.histories, states, executor, checkpoint, block, progress, interrupts)
        result, complete, number = typology_of(
            people,
            request.im,
            request.levels,
            states,
            run,
            request.share,
            plan.histories,
            [*plan.warnings, *of_occurrence],
        )
        result = dataclasses.replace(result, record_formats=request.facts.formats)
        if complete < number or interrupts.requested:
            raise Interrupted(f"interrupted: {complete} of {number} walls are complete", result)
    warn(result.warnings)
    return result


def typology_of(
    people: Population,
    im: str,
    levels: FloatArray,
    states: FloatArray,
    run: Contents,
    share: FloatArray,
    histories: IntArray,
    warnings: Iterable[DondoloWarning] = (),
) -> tuple[Typology, int, int]:
    """The typology of the walls that are complete, how many these are, and of how many.

    Parameters
    ----------
    people, im, levels, states
        What was run.
    run : Contents
        The rows that are complete.
    share : ndarray, shape (levels,)
        Share of the records that run at each level.
    histories : ndarray of int, shape (rows,)
        Histories of each row in a stripe in which every record runs.
    warnings : iterable of DondoloWarning
        What was warned of before anything was run.

    Raises
    ------
    Interrupted
        No wall is complete.
    """
    # A wall is complete with all its mechanisms.
    first = people.first_rows
    whole = np.logical_and.reduceat(run.complete, first)
    rows = np.repeat(whole, np.diff(np.append(first, len(people))))
    if not whole.any():
        raise Interrupted("interrupted: no wall is complete")
    runs = np.rint(share[:, None] * histories).astype(np.int32)
    result = combine(people, im, levels, states, run.exceedances, runs, run.complete, run.work, run.flags)
    ties = tuple(run.ties[i] for i in np.flatnonzero(rows[run.complete]))
    result = dataclasses.replace(result, warnings=(*warnings, *result.warnings), ties=ties)
    return result, int(whole.sum()), len(whole)
