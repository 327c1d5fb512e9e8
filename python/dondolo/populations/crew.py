"""Blocks by an executor: a few in flight, and the records sent to each worker once.

Nothing here knows what the executor is. A task has the records with it only if a worker has said that it lacks them; a
worker keeps what it got, and a task without records that finds none comes back undone. How many tasks are in flight
follows from how long they wait for a worker.
"""

from __future__ import annotations

import hashlib
import itertools
import os
import pickle
import socket
import threading
import time
from collections.abc import Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, Executor, Future, wait
from types import TracebackType
from typing import Any, NamedTuple

from dondolo._fortran.library import build_variant, constants
from dondolo.errors import DondoloError, InputError
from dondolo.populations.blocks import Blocks, Part, Shared
from dondolo.walls.wall import Wall

# Studies whose records a worker keeps
_KEPT = 4

_shared: dict[str, Shared] = {}
_lock = threading.Lock()


class CrewError(Exception):
    """The executor failed, by the exception that it gives as cause."""

    def __init__(self, error: BaseException) -> None:
        text = " ".join(str(error).split())
        super().__init__(f"{type(error).__name__}: {text}" if text else type(error).__name__)


class Head(NamedTuple):
    """What a task begins with.

    Attributes
    ----------
    number : int
        No two tasks are the same, since some executors remember results by what was asked for.
    key : str
        Digest of what its study shares.
    build : str
        Version and build variant that results must come from.
    """

    number: int
    key: str
    build: str


class Answer(NamedTuple):
    """What comes back of a task.

    Attributes
    ----------
    worker : str
        Host and process.
    part : Part or None
        None where the worker lacked the records.
    """

    worker: str
    part: Part | None


class Task(NamedTuple):
    """A block as it is sent, with the number of its task and the time."""

    first: int
    count: int  # type: ignore[assignment]
    block: bytes
    number: int = -1
    sent: float = 0.0


def perform(head: Head, block: bytes, parcel: bytes | None) -> Answer:
    """Run a block in a worker; the parcel is what the study shares."""
    worker = f"{socket.gethostname()}:{os.getpid()}"
    if head.build != _build():
        raise InputError(
            f"worker {worker}: has {_build()} and not {head.build}; the environment variable DONDOLO_VARIANT sets the"
            " same build variant everywhere"
        )
    with _lock:
        if parcel is not None and head.key not in _shared:
            while len(_shared) >= _KEPT:
                del _shared[next(iter(_shared))]
            _shared[head.key] = pickle.loads(parcel)
        shared = _shared.get(head.key)
    if shared is None:
        return Answer(worker, None)
    return Answer(worker, shared.run(*pickle.loads(block)))


class Crew:
    """The workers of an executor.

    Parameters
    ----------
    executor : Executor
    shared : Shared
        What the study's blocks share.

    Attributes
    ----------
    sends : int
        How often the records were sent.
    """

    def __init__(self, executor: Executor, shared: Shared) -> None:
        self._executor = executor
        self._parcel = pickle.dumps(shared)
        self._key = hashlib.sha256(self._parcel).hexdigest()
        self._numbers = itertools.count()
        self._flying: dict[Future[Any], Task] = {}
        self._window = max(4, 2 * (os.cpu_count() or 1))
        # Number of the last task by which each worker must have had the records: one that it did, or one that brought
        # them when it lacked them
        self._supplied: dict[str, int] = {}
        self.sends = 0

    def run(self, walls: Sequence[Wall], blocks: Blocks) -> Iterator[tuple[int, int, Part]]:
        """First wall and number of walls of each block that is finished, and what came of it.

        What is finished when something goes wrong comes before the exception.
        """
        try:
            while True:
                while len(self._flying) < self._window and (place := blocks.take(2 * self._window)):
                    first, count = place
                    self._send(Task(first, count, pickle.dumps((walls[first : first + count], first))), carries=False)
                if not self._flying:
                    return
                for future in wait(self._flying, return_when=FIRST_COMPLETED).done:
                    part = self._answer(future)
                    task = self._flying.pop(future)
                    if part is None:
                        self._send_again(task, future.result().worker)
                    else:
                        yield task.first, task.count, part
        except (KeyboardInterrupt, DondoloError, CrewError):
            for future, task in self._flying.items():
                if future.done() and not future.cancelled() and future.exception() is None:
                    part = future.result().part
                    if part is not None:
                        yield task.first, task.count, part
            raise

    def _answer(self, future: Future[Answer]) -> Part | None:
        """What came of a task; None if its worker lacked the records."""
        try:
            answer = future.result()
        except (DondoloError, KeyboardInterrupt):
            raise
        except Exception as error:
            raise CrewError(error) from error
        if answer.part is not None:
            task = self._flying[future]
            self._supplied[answer.worker] = max(task.number, self._supplied.get(answer.worker, -1))
            waited = time.monotonic() - task.sent - answer.part.seconds
            if waited < 0.5 * answer.part.seconds:
                # A worker was idle, or would have been soon.
                self._window += 1
        return answer.part

    def _send(self, task: Task, carries: bool) -> int:
        task = task._replace(number=next(self._numbers), sent=time.monotonic())
        head = Head(task.number, self._key, _build())
        try:
            future = self._executor.submit(perform, head, task.block, self._parcel if carries else None)
        except Exception as error:
            raise CrewError(error) from error
        self.sends += carries
        self._flying[future] = task
        return task.number

    def _send_again(self, task: Task, worker: str) -> None:
        """A worker lacked the records: the task brings them, but if it came before one that did."""
        carries = task.number > self._supplied.get(worker, -1)
        number = self._send(task, carries)
        if carries:
            self._supplied[worker] = number

    def __enter__(self) -> Crew:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        for future in self._flying:
            future.cancel()


def _build() -> str:
    """What results depend on besides the study."""
    return f"dondolo {constants().version}, {build_variant()}"
