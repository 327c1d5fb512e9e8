"""A population in blocks of walls: run here or by an executor, kept in a checkpoint.

Only the blocks in flight hold EDPs; of the others a bit of each history and state is kept.
"""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import nullcontext
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from dondolo._base.arguments import FloatArray, as_count
from dondolo._fortran import _binding
from dondolo.analysis.request import Request, progress_bar
from dondolo.analysis.work import Work
from dondolo.errors import DondoloError, InputError
from dondolo.populations.flags import Flags
from dondolo.populations.parts import Blocks, Part, Shared
from dondolo.records.suite import flatten

# Loaded where they are used: databases, sockets and futures would make every import of dondolo slower by 20 ms.
if TYPE_CHECKING:
    from concurrent.futures import Executor

    from dondolo.populations.checkpoint import Checkpoint
    from dondolo.populations.crew import Crew

IntArray = NDArray[np.int32]


@dataclass(frozen=True, eq=False)
class Run:
    """What is known of the walls so far.

    Attributes
    ----------
    flags : Flags
        States that the histories reach.
    exceedances : ndarray of int, shape (states, levels, walls)
        How many do.
    complete : ndarray of bool, shape (walls,)
    works : list of Work
        What was computed in each block.
    """

    flags: Flags
    exceedances: IntArray
    complete: NDArray[np.bool_]
    works: list[Work]

    def add(self, first: int, part: Part) -> None:
        """Take what came of a block."""
        self.works.append(part.work)
        if not part.walls:
            return
        self.flags.bits[self.flags.place(first, part.walls)] = np.frombuffer(part.flags, dtype=np.uint8)
        here = slice(first, first + part.walls)
        self.exceedances[:, :, here] = self.flags.counts(first, part.walls)
        self.complete[here] = True


def run_walls(
    request: Request,
    histories: IntArray,
    states: FloatArray,
    executor: Executor | None,
    checkpoint: str | os.PathLike[str] | None,
    block: int | None,
    progress: bool,
) -> Run:
    """Run all walls, or those that are complete when Ctrl-C comes."""
    from dondolo.populations.checkpoint import Checkpoint
    from dondolo.populations.crew import CrewError

    _check(executor, block)
    levels, walls = len(request.levels), len(histories)
    run = Run(
        Flags.empty(histories, levels, len(states), len(request.records)),
        np.zeros((len(states), levels, walls), dtype=np.int32),
        np.zeros(walls, dtype=bool),
        [],
    )
    with nullcontext() if checkpoint is None else Checkpoint(checkpoint, _study(request, states)) as file:
        if file is not None:
            for stored in file.blocks():
                run.add(stored.first, Part(stored.rows, stored.flags, stored.work, 0.0, False))
            if not run.complete.all():
                file.claim()
        try:
            _run_rest(run, request, states, executor, file, block, progress)
        except KeyboardInterrupt:
            # What is complete is in `run`.
            pass
        except CrewError as error:
            later = "a checkpoint would keep them" if file is None else "the same call goes on from there"
            raise DondoloError(
                f"executor: {error}; {run.complete.sum()} of {walls} rows are complete, {later}"
            ) from error.__cause__
    return run


def _run_rest(
    run: Run,
    request: Request,
    states: FloatArray,
    executor: Executor | None,
    file: Checkpoint | None,
    block: int | None,
    progress: bool,
) -> None:
    """Run the walls that are not complete."""
    from dondolo.populations.crew import Crew

    histories = run.flags.histories
    sizes = histories.astype(np.int64) * len(request.levels)
    blocks = Blocks(sizes, run.complete, request.threads or _all_threads(), block)
    shared = Shared(request, states)
    done = int(sizes[run.complete].sum())

    def parts_here() -> Iterator[tuple[int, int, Part]]:
        while place := blocks.take():
            first, count = place
            here = slice(first, first + count)
            yield first, count, shared.run(request.walls[here], histories[here], bar.update)

    def parts_there(crew: Crew) -> Iterator[tuple[int, int, Part]]:
        for first, count, part in crew.run(request.walls, histories, blocks):
            bar.update(int(sizes[first : first + count].sum()))
            yield first, count, part

    with (
        progress_bar(int(sizes.sum()), progress, f"{len(histories)} rows", "history", done) as bar,
        nullcontext() if executor is None else Crew(executor, shared) as crew,
    ):
        for first, count, part in parts_here() if crew is None else parts_there(crew):
            if part.walls == count:
                blocks.learn(first, count, part.seconds)
                if file is not None:
                    file.keep(first, count, part.work, part.flags)
            run.add(first, part)
            if part.interrupted:
                raise KeyboardInterrupt


def _all_threads() -> int:
    """How many threads OpenMP will take, for the size of the first blocks."""
    asked = os.environ.get("OMP_NUM_THREADS", "").split(",")[0].strip()
    return int(asked) if asked.isdigit() and int(asked) else os.cpu_count() or 1


def _study(request: Request, states: FloatArray) -> dict[str, str]:
    """All that the flags depend on, for a checkpoint: weights, groups, threads and blocks are not among it."""
    from dondolo.populations.checkpoint import digest

    rtol, atol, *_ = (repr(float(value)) for value in request.settings)
    flat = _binding.join_walls([wall._flat for wall in request.walls])
    records = flatten(request.records)
    return {
        "dondolo": _binding.constants().version,
        "build variant": _binding.build_variant(),
        "number of rows": str(len(request.walls)),
        "walls": digest(flat.texts, *(np.ascontiguousarray(values).tobytes() for values in flat[1:])),
        "records": digest(records.names, *(values.tobytes() for values in records[1:])),
        "im": request.im,
        "levels": digest(request.levels.tobytes()),
        "polarity": request.polarity,
        "engine": request.engine,
        "rtol": rtol,
        "atol": atol,
        "edp_limit": repr(float(states[-1])),
        "edp_thresholds": ", ".join(repr(float(value)) for value in states[:-1]) or "none",
    }


def _check(executor: Executor | None, block: int | None) -> None:
    from concurrent.futures import Executor

    if executor is not None and not isinstance(executor, Executor):
        raise InputError(f"executor: {type(executor).__name__} is no executor of concurrent.futures")
    if block is not None:
        as_count("block", block, 1)
