"""A population in blocks of walls: run here or by an executor, and put into a store."""

from __future__ import annotations

import os
import time
from collections.abc import Iterator, Sequence
from contextlib import nullcontext
from dataclasses import replace
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray

from dondolo._base.arguments import FloatArray, argument_error, as_count
from dondolo._base.interrupts import Interrupts
from dondolo._fortran import _core
from dondolo._fortran.library import Stoppable, available_threads, receive
from dondolo.analysis.request import Request, progress_bar
from dondolo.errors import DondoloError
from dondolo.populations.store import Contents, Store
from dondolo.walls.wall import Wall
from dondolo.walls.wall import upload as upload_walls

# Loaded where they are used: sockets and futures would make every import of dondolo slower.
if TYPE_CHECKING:
    from concurrent.futures import Executor


IntArray = NDArray[np.int32]

# What a block should take [s]: here, where Ctrl-C loses it, and in a worker; and the least where workers share out the
# last ones of a long run
_SECONDS_HERE, _SECONDS_THERE = 0.5, 1.5
_LEAST_SECONDS = 0.1
# A guess for the first block: histories of a thread
_FIRST_HISTORIES = 25_000
# The most histories of a thread in a block, for the memory of walls that hardly move: a few tens of MB
_MOST_HISTORIES = 200_000


class Part(NamedTuple):
    """What came of a block.

    Attributes
    ----------
    block : ndarray of int
        Its rows, as the store takes them.
    seconds : float
        What it took.
    """

    block: IntArray
    seconds: float


class Shared(NamedTuple):
    """What the blocks of a study share.

    Attributes
    ----------
    request : Request
        Without walls.
    states : ndarray, shape (states,)
        EDP from which on a history is in a state; the last is collapse.
    """

    request: Request
    states: FloatArray

    def run(self, walls: Sequence[Wall], first: int, interrupts: Interrupts | None = None) -> Part:
        """Run consecutive rows of the population, the first of which has a number, from 0.

        An event of the interrupts raises KeyboardInterrupt, as Ctrl-C does.
        """
        start = time.perf_counter()
        study, people = self.request._study, upload_walls(walls)
        with Stoppable(interrupts):
            sent = _core.stores.run_rows(study.number, people.number, len(walls), self.states, first + 1)
        try:
            rows = receive(sent)
        except DondoloError:
            # Fortran has broken the block off.
            if interrupts is None or not interrupts.requested:
                raise
            raise KeyboardInterrupt from None
        return Part(rows.integers, time.perf_counter() - start)


def run_walls(
    request: Request,
    histories: IntArray,
    states: FloatArray,
    executor: Executor | None,
    checkpoint: str | os.PathLike[str] | None,
    block: int | None,
    progress: bool,
    interrupts: Interrupts,
) -> Contents:
    """Run all walls, or those that are complete when Ctrl-C or an event stops it, heard while they run alone."""
    from dondolo.populations.crew import CrewError

    _check(executor, block)
    with Store(checkpoint, request, states) as store:
        store.claim()
        try:
            with interrupts.heard():
                _run_rest(store, request, histories, states, executor, block, progress, interrupts)
        except KeyboardInterrupt:
            # What is complete is in the store.
            pass
        except CrewError as error:
            later = "a checkpoint would keep them" if checkpoint is None else "the same call resumes from there"
            raise DondoloError(
                f"executor: {error}; {store.complete().sum()} of {len(histories)} rows are complete, {later}"
            ) from error.__cause__
        return store.read()


def _run_rest(
    store: Store,
    request: Request,
    histories: IntArray,
    states: FloatArray,
    executor: Executor | None,
    block: int | None,
    progress: bool,
    interrupts: Interrupts,
) -> None:
    """Run the walls that are not complete."""
    from dondolo.populations.crew import Crew

    complete = store.complete()
    sizes = np.array(request.totals(histories), dtype=np.int64)
    seconds = _SECONDS_HERE if executor is None else _SECONDS_THERE
    blocks = Blocks(sizes, complete, request.threads or available_threads(), block, seconds)
    shared = Shared(replace(request, walls=()), states)

    def parts_here() -> Iterator[tuple[int, int, Part]]:
        while place := blocks.take():
            first, count = place
            yield first, count, shared.run(request.walls[first : first + count], first, interrupts)

    with (
        progress_bar(
            int(sizes.sum()), progress, f"{len(histories)} rows", "history", int(sizes[complete].sum())
        ) as bar,
        nullcontext() if executor is None else Crew(executor, shared) as crew,
    ):
        for first, count, part in parts_here() if crew is None else crew.run(request.walls, blocks):
            store.put(part.block, count)
            blocks.learn(first, count, part.seconds)
            bar.update(int(sizes[first : first + count].sum()))
            if interrupts.requested:
                raise KeyboardInterrupt


class Blocks:
    """The walls that are still to be run, cut into blocks of the time that is wished for.

    Parameters
    ----------
    sizes : ndarray of int, shape (walls,)
        Histories of each wall, of all stripes.
    done : ndarray of bool, shape (walls,)
        Walls that need not be run.
    threads : int
        Threads that a block is run on.
    walls : int or None
        Walls of a block, if given.
    seconds : float
        What a block should take.
    """

    def __init__(
        self, sizes: NDArray[np.int64], done: NDArray[np.bool_], threads: int, walls: int | None, seconds: float
    ) -> None:
        self._seconds = seconds
        self._ends = np.cumsum(sizes)
        edges = np.flatnonzero(np.diff(np.concatenate([[True], done, [True]]).astype(np.int8)))
        self._gaps = [(int(first), int(end)) for first, end in edges.reshape(-1, 2)]
        self._gaps.reverse()
        self._total = self._left = int(sizes[~done].sum())
        self._size = float(_FIRST_HISTORIES * threads)
        self._most = float(_MOST_HISTORIES * threads)
        self._walls = walls

    def take(self, shares: int = 1) -> tuple[int, int] | None:
        """First wall and number of walls of the next block; what is left should go into so many shares at least."""
        if not self._gaps:
            return None
        first, end = self._gaps.pop()
        before = int(self._ends[first - 1]) if first else 0
        if self._walls is None:
            # Blocks become smaller towards the end, so that all workers end together.
            least = min(self._size * _LEAST_SECONDS / self._seconds, self._total / shares)
            size = min(self._size, max(self._left / shares, least))
            cut = int(np.searchsorted(self._ends, before + size, side="right"))
            cut = min(max(cut, first + 1), end)
        else:
            cut = min(first + self._walls, end)
        if cut < end:
            self._gaps.append((cut, end))
        self._left -= int(self._ends[cut - 1]) - before
        return first, cut - first

    def learn(self, first: int, count: int, seconds: float) -> None:
        """What a block took."""
        histories = int(self._ends[first + count - 1] - (self._ends[first - 1] if first else 0))
        wished = histories * self._seconds / max(seconds, 1e-6)
        self._size = min(max(wished, 0.25 * self._size), 4.0 * self._size, self._most)


def _check(executor: Executor | None, block: int | None) -> None:
    from concurrent.futures import Executor

    if executor is not None and not isinstance(executor, Executor):
        raise argument_error(
            "wrong_type", "executor", f": must be an executor of concurrent.futures, not {type(executor).__name__}"
        )
    if block is not None:
        as_count("block", block, 1)
