"""Long work in blocks: many histories of one wall or of many, each block one call of Fortran.

A block takes less than half a second, so that little is lost when Ctrl-C breaks it off and what is finished is kept.
"""

from __future__ import annotations

import builtins
import functools
import time
import warnings
from bisect import bisect_right
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import accumulate
from typing import Any, Literal, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from dondolo._base.arguments import FloatArray, as_count, as_flag
from dondolo._base.interrupts import deferred
from dondolo._fortran import _core
from dondolo._fortran.handles import Handle
from dondolo._fortran.histories import Settings
from dondolo._fortran.library import Stoppable, as_text, check, properties, receive, unpack_warnings
from dondolo._fortran.records import describe_measure
from dondolo.analysis.solver import Solver, as_solver
from dondolo.analysis.work import Work
from dondolo.errors import DondoloError, DondoloWarning
from dondolo.records.level_rows import LevelRows, records_at_levels
from dondolo.records.record import Record
from dondolo.records.suite import Facts, Suite
from dondolo.records.suite import upload as upload_records
from dondolo.walls.wall import ColumnsOfWalls, Wall
from dondolo.walls.wall import upload as upload_walls

IntArray = np.ndarray[Any, np.dtype[np.int32]]

_SECONDS = 0.4
# A guess for the first block: samples that are surely gone through within about a block's time. Sets of records at
# twenty levels have fewer: each further block costs the engine vectors that are half empty
_FIRST_SAMPLES = 20_000_000

#: A level of any measure that takes no record beyond all bounds
SMALL_LEVEL = 1e-6
# EDP thresholds where collapse is the only state: no joint opens so late
_COLLAPSE = np.ones(1)

# What a request has in Fortran
_UPLOADED = ("_suite", "_study", "_people", "kept")

#: Polarities of the records in an analysis
Polarity = Literal["as_recorded", "reversed", "both"]


def polarity_names(signs: IntArray) -> list[str]:
    """The polarities of histories as tables have them, of +1 and -1."""
    return ["reversed" if sign < 0 else "as_recorded" for sign in signs]


class Plan(NamedTuple):
    """What will be run, checked.

    Attributes
    ----------
    histories : ndarray of int, shape (walls,)
        Histories of each wall in a stripe in which every record runs.
    record, polarity : ndarray of int, shape (histories,)
        Of the last wall: index of each history's record, and +1 or -1.
    scale : ndarray, shape (levels, histories)
        Of the last wall: factors on the records, without the sign of the polarity; 0 where one does not run.
    ran : ndarray of bool, shape (levels, histories)
        Of the last wall: which histories run at each level.
    warnings : list of DondoloWarning
        What the user should know.
    """

    histories: Any
    record: Any
    polarity: Any
    scale: FloatArray
    ran: np.ndarray[Any, np.dtype[np.bool_]]
    warnings: list[DondoloWarning]


class Outcome(NamedTuple):
    """Flat results, wall by wall and level by level."""

    edp: FloatArray
    collapsed: Any
    impacts: Any
    time_of_peak: FloatArray
    edp_error: FloatArray
    work: Work
    done: int


@functools.lru_cache(maxsize=1)
def _all_run(levels: int, histories: int) -> np.ndarray[Any, np.dtype[np.bool_]]:
    """What stripes have for which of their histories run where all do."""
    ran = np.ones((levels, histories), dtype=np.bool_)
    ran.flags.writeable = False
    return ran


class StudyHandle(Handle):
    """Records, levels and settings in Fortran.

    Attributes
    ----------
    shared : tuple or None
        Gravity and sides of the walls that have the same plan, and the plan, without the warnings of a wall alone.
    """

    __slots__ = ("shared",)

    def __init__(self, number: int, needs: Handle | None = None) -> None:
        super().__init__(number, needs)
        self.shared: tuple[tuple[float, bool], Plan] | None = None


class Kept:
    """Where requests that differ in their walls alone keep what they share in Fortran."""

    __slots__ = ("study",)

    def __init__(self) -> None:
        self.study: StudyHandle | None = None


@dataclass(frozen=True)
class Request:
    """Stripes of some walls, as asked for; it can be sent to another process.

    Without a measure (im = '') levels are factors on the records as they stand.
    """

    walls: Sequence[Wall]
    records: tuple[Record, ...]
    levels: FloatArray
    im: str
    polarity: str
    engine: str
    settings: Settings
    threads: int
    rows: LevelRows | None = None
    kept: Kept | None = None

    @functools.cached_property
    def _suite(self) -> Suite:
        """The records in Fortran."""
        return upload_records(self.records, self.threads)

    @functools.cached_property
    def _study(self) -> StudyHandle:
        """Records, levels and settings in Fortran."""
        # Motions of floors belong to a study, and would stay with it.
        kept = self.kept if all(wall.building is None for wall in self.walls) else None
        if kept is not None and kept.study is not None:
            return kept.study
        suite = self._suite
        im, polarity, engine = (as_text(what, getattr(self, what)) for what in ("im", "polarity", "engine"))
        if self.im:
            suite.measure(self.im, self.threads)
        number, failure = _core.stripes.new_study(
            suite.number, im, self.levels, polarity, engine, self.threads, **self.settings._asdict()
        )
        check(failure)
        study = StudyHandle(number, suite)
        if self.rows is not None:
            check(_core.stripes.choose_records(number, *self.rows))
        if kept is not None:
            kept.study = study
        return study

    @functools.cached_property
    def _people(self) -> Handle:
        """The walls in Fortran."""
        return upload_walls(self.walls)

    def __getstate__(self) -> dict[str, Any]:
        # What was uploaded stays in its process.
        return {what: value for what, value in self.__dict__.items() if what not in _UPLOADED}

    @property
    def facts(self) -> Facts:
        """What results tell of the records."""
        return self._suite.facts(self.records)

    @functools.cached_property
    def runs(self) -> FloatArray:
        """1 where a record runs at a level, else 0, shape (records, levels)."""
        if self.rows is None:
            return np.ones((len(self.records), len(self.levels)))
        runs, failure = _core.stripes.runs_of_records(self._study.number, len(self.records), len(self.levels))
        check(failure)
        return np.asarray(runs, dtype=np.float64)

    @functools.cached_property
    def share(self) -> FloatArray:
        """Share of the records that run at each level, shape (levels,)."""
        return np.ones(len(self.levels)) if self.rows is None else np.asarray(self.runs.mean(axis=0))

    def plan(self, edp_thresholds: FloatArray = _COLLAPSE) -> Plan:
        """Check everything; nothing is run."""
        study, people, wall = self._study, self._people, self.walls[0]
        # Ties hold a strip outwards alone: the direction of a record then matters
        like, shared = (wall.gravity, wall.two_sided and not getattr(wall, "ties", ())), study.shared
        if len(self.walls) == 1 and shared is not None and shared[0] == like:
            of_wall = unpack_warnings(receive(_core.stripes.check_wall(study.number, people.number)).lines)
            plan = shared[1]
            # A warning of its own for each caller, who may raise it
            return plan._replace(warnings=of_wall + [one.placed("") for one in plan.warnings])
        walls = len(self.walls)
        parcel = receive(_core.stripes.plan(study.number, people.number, walls, edp_thresholds))
        # Results may share it, and nobody changes it.
        parcel.integers.flags.writeable = parcel.reals.flags.writeable = False
        scale, found = parcel["scale"], unpack_warnings(parcel["warnings"])
        ran = _all_run(*scale.shape) if self.rows is None else parcel["ran"] == 1
        plan = Plan(parcel["histories"], parcel["record"], parcel["polarity"], scale, ran, found)
        if parcel["is_shared"] and walls == 1 and self.rows is None:
            of_all = found[parcel["warnings_of_walls"] :]
            study.shared = like, plan._replace(warnings=[one.placed("") for one in of_all])
        return plan

    def totals(self, histories: IntArray) -> list[int]:
        """Histories of each wall in all stripes."""
        stripes = len(self.levels) if self.rows is None else float(self.share.sum())
        return [round(number * stripes) for number in histories.tolist()]

    def run(self, histories: IntArray, progress: bool, label: str) -> tuple[Outcome, bool]:
        """Run all histories; the second result says whether it was stopped before the end."""
        totals = self.totals(histories)
        with progress_bar(sum(totals), progress, label, "history") as bar:
            return self.advance(totals, Pace(self.facts.samples), bar.update)

    def advance(self, totals: Sequence[int], pace: Pace, report: Callable[[int], object]) -> tuple[Outcome, bool]:
        """The same at a pace, with each wall's histories, and with a report of how many were done in each call."""
        ends = list(accumulate(totals))
        total = ends[-1]
        edp, peak, error = np.empty(total), np.empty(total), np.empty(total)
        collapsed, impacts = np.empty(total, dtype=np.int32), np.empty(total, dtype=np.int32)
        study, people = self._study.number, self._people.number
        work = Work()

        def block(done: int, count: int) -> None:
            nonlocal work
            # The walls that the block touches
            one, last = bisect_right(ends, done), bisect_right(ends, done + count - 1)
            first = done - (ends[one - 1] if one else 0)
            here = slice(done, done + count)
            rows = (values[here] for values in (edp, collapsed, impacts, peak, error))
            with deferred() as interrupts, Stoppable(interrupts):
                counts, failure = _core.stripes.run_block(study, people, one + 1, last + 1, first + 1, *rows, count)
            check(failure)
            work = Work.total([work, Work._of_counts(counts)])

        done, interrupted = in_blocks(total, pace, block, report)
        return Outcome(edp, collapsed.astype(np.bool_), impacts, peak, error, work, done), interrupted


class Pace:
    """How many histories take the time of a block, learnt from block to block.

    Parameters
    ----------
    samples : float
        Those of a record, on average.
    """

    def __init__(self, samples: float) -> None:
        self._size = max(1.0, _FIRST_SAMPLES / samples)

    def count(self, left: int) -> int:
        """Histories of the next block."""
        return min(int(self._size), left)

    def learn(self, count: int, seconds: float) -> None:
        """What a block took."""
        self._size = max(1.0, count * min(max(_SECONDS / max(seconds, 1e-6), 0.25), 4.0))


def in_blocks(
    total: int, pace: Pace, block: Callable[[int, int], None], report: Callable[[int], object]
) -> tuple[int, bool]:
    """Run histories block by block: how many are done, and whether it was stopped before the end.

    `block(done, count)` runs the next `count` histories.
    """
    done = 0
    with deferred() as interrupts:
        try:
            while done < total and not interrupts.requested:
                count = pace.count(total - done)
                start = time.perf_counter()
                block(done, count)
                pace.learn(count, time.perf_counter() - start)
                done += count
                report(count)
        except KeyboardInterrupt:
            # Of a handler of the user's
            return done, True
        except DondoloError:
            # Fortran has broken the block off.
            if not interrupts.requested:
                raise
        interrupts.answered = interrupts.signalled
        return done, interrupts.requested


def new_request(
    walls: Sequence[Wall],
    records: Any,
    levels: ArrayLike | None,
    im: str,
    polarity: str,
    solver: Solver | None,
    threads: int,
    estimate_error: bool = False,
    collapses_only: bool = False,
) -> Request:
    """A request out of what a user gives; for records and levels see `records_at_levels`.

    Levels that are equally spaced but for rounding become those of ``first, last, count`` of a case.
    """
    team = check_threads(threads)
    several, given, rows = records_at_levels(records, levels)
    settled: FloatArray = _core.stripes.settle(given)
    settled.flags.writeable = False
    how = as_solver(solver)
    settings = how._settings(estimate_error, collapses_only)
    name = describe_measure(im).name
    people = walls if isinstance(walls, ColumnsOfWalls) else tuple(walls)
    return Request(people, several, settled, name, polarity, how.engine, settings, team, rows)


def check_threads(threads: int) -> int:
    """A number of threads; 0 stands for all."""
    return as_count("threads", threads, 0, _most_threads())


@functools.cache
def _most_threads() -> int:
    (row,) = (row for row in properties("job") if row.name == "threads")
    return int(row.largest)


class _NoBar:
    """A progress bar that is not wanted."""

    def __enter__(self) -> _NoBar:
        return self

    def __exit__(self, *_: object) -> None:
        pass

    def update(self, count: int) -> None:
        """More is done."""


def progress_bar(total: int, wanted: bool, label: str, unit: str, initial: int = 0) -> Any:
    """A progress bar, hidden where stderr is neither a terminal nor a notebook's. `initial` are done already."""
    if not as_flag("progress", wanted):
        return _NoBar()
    # None: hidden unless stderr is a terminal. A notebook's is none, and shows the bar all the same.
    return _bar()(
        total=total,
        desc=label,
        unit=f" {unit}",
        unit_scale=True,
        initial=initial,
        disable=False if hasattr(builtins, "get_ipython") else None,
        leave=False,
    )


@functools.cache
def _bar() -> Any:
    """The kind of bar that fits: a widget in a notebook, plain text elsewhere and without ipywidgets."""
    from tqdm import TqdmWarning

    with warnings.catch_warnings():
        warnings.simplefilter("ignore", TqdmWarning)
        from tqdm.auto import tqdm
    return tqdm
