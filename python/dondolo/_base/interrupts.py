"""Ctrl-C or an event in long work: it is noted at once, and heard where nothing that is complete is lost."""

from __future__ import annotations

import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType

import numpy as np
from numpy.typing import NDArray

from dondolo._base.arguments import wrong_type

# How often a thread that looks at an event looks whether its work is over [s]
_PAUSE = 0.02


class Interrupts:
    """Ctrl-C, or an event that was set, while work is under way.

    Parameters
    ----------
    stop : threading.Event, optional
        The event.

    Attributes
    ----------
    signalled : bool
        Whether Ctrl-C has come.
    answered : bool
        Whether who asked for it tells its caller, so that nothing is raised at the end.
    """

    def __init__(self, stop: threading.Event | None = None) -> None:
        self.signalled = self.answered = False
        self._is_heard = self._is_over = False
        self._stop = stop
        self._flag: NDArray[np.int32] | None = None

    @property
    def flag(self) -> NDArray[np.int32] | None:
        """A number that is not 0 once the event was set, for what Fortran computes; None without an event."""
        if self._stop is not None and self._flag is None:
            self._flag = np.array([self._stop.is_set()], dtype=np.int32)
            threading.Thread(target=self._watch, args=(self._stop, self._flag), daemon=True).start()
        return self._flag

    def _watch(self, stop: threading.Event, flag: NDArray[np.int32]) -> None:
        while not self._is_over:
            if stop.wait(_PAUSE):
                flag[0] = 1
                return

    def end(self) -> None:
        """The work is over: the event is looked at no more."""
        self._is_over = True

    @property
    def requested(self) -> bool:
        """Whether the work is to end."""
        return self.signalled or (self._stop is not None and self._stop.is_set())

    @contextmanager
    def heard(self) -> Iterator[None]:
        """Let it raise KeyboardInterrupt at once, as it does where nobody waits: for what waits for others."""
        self._is_heard = True
        try:
            if self.requested:
                raise KeyboardInterrupt
            yield
        finally:
            self._is_heard = False

    def note(self, number: int, frame: FrameType | None) -> None:
        """Take note of it: the handler of the signal."""
        self.signalled = True
        if self._is_heard:
            raise KeyboardInterrupt


def as_event(stop: threading.Event | None) -> threading.Event | None:
    """The event that ends a run, if there is one."""
    if stop is not None and not isinstance(stop, threading.Event):
        raise wrong_type("stop", stop, "a threading.Event")
    return stop


class _Outermost(threading.local):
    """What a thread has under way."""

    interrupts: Interrupts | None = None


_OUTERMOST = _Outermost()


@contextmanager
def deferred(stop: threading.Event | None = None) -> Iterator[Interrupts]:
    """Let Ctrl-C wait until it is asked for, or else until the end; inside another, that of the other is given.

    Only Python's own handler, which raises KeyboardInterrupt anywhere, is put aside, and in the main thread alone; one
    of the user's stays, and what it raises is not held back. An event is looked at in any thread.
    """
    if _OUTERMOST.interrupts is not None:
        yield _OUTERMOST.interrupts
        return
    here = Interrupts(stop)
    is_main = threading.current_thread() is threading.main_thread()
    is_put_aside = is_main and signal.getsignal(signal.SIGINT) is signal.default_int_handler
    try:
        _OUTERMOST.interrupts = here
        if is_put_aside:
            signal.signal(signal.SIGINT, here.note)
        yield here
    finally:
        _OUTERMOST.interrupts = None
        here.end()
        if is_put_aside:
            signal.signal(signal.SIGINT, signal.default_int_handler)
    if here.signalled and not here.answered:
        raise KeyboardInterrupt
