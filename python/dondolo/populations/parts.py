"""Blocks of walls: how many walls each has, and running one."""

from __future__ import annotations

import time
from collections.abc import Callable
from dataclasses import replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from dondolo._base.arguments import FloatArray
from dondolo.analysis.request import Pace, Request
from dondolo.analysis.work import Work
from dondolo.populations.flags import pack
from dondolo.walls.wall import Wall

IntArray = NDArray[np.int32]

# What a block should take [s], and the least where workers share out the last ones of a long run
_SECONDS = 1.5
_LEAST_SECONDS = 0.1
# A guess for the first block: histories of a thread
_FIRST_HISTORIES = 25_000
# The most histories of a thread in a block, for the memory of walls that hardly move: a few tens of MB
_MOST_HISTORIES = 200_000


class Part(NamedTuple):
    """What came of a block.

    Attributes
    ----------
    walls : int
        How many of its walls are complete.
    flags : bytes
        Theirs, packed.
    work : Work
        What was computed.
    seconds : float
        What it took.
    interrupted : bool
        Did Ctrl-C stop it?
    """

    walls: int
    flags: bytes
    work: Work
    seconds: float
    interrupted: bool


class Shared:
    """What the blocks of a study share, and a pace that is learnt from one to the next.

    Parameters
    ----------
    request : Request
        Without walls.
    states : ndarray
        EDP from which on a history is in each state; the last is collapse.
    """

    def __init__(self, request: Request, states: FloatArray) -> None:
        self.request = replace(request, walls=())
        self.states = states
        self._pace = Pace(request.samples)

    def run(self, walls: tuple[Wall, ...], histories: IntArray, report: Callable[[int], object]) -> Part:
        """Run walls; after Ctrl-C some of them may not be complete."""
        start = time.perf_counter()
        sizes = histories.astype(np.int64) * len(self.request.levels)
        outcome, interrupted = replace(self.request, walls=walls).advance(histories, self._pace, report)
        complete = int(np.searchsorted(np.cumsum(sizes), outcome.done, side="right"))
        flags = pack(outcome.edp, outcome.collapsed, self.states, sizes[:complete])
        return Part(complete, flags.tobytes(), outcome.work, time.perf_counter() - start, interrupted)


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
    """

    def __init__(self, sizes: NDArray[np.int64], done: NDArray[np.bool_], threads: int, walls: int | None) -> None:
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
            least = min(self._size * _LEAST_SECONDS / _SECONDS, self._total / shares)
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
        wished = histories * _SECONDS / max(seconds, 1e-6)
        self._size = min(max(wished, 0.25 * self._size), 4.0 * self._size, self._most)
