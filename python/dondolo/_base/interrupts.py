"""Ctrl-C in long work: it is noted at once, and heard where nothing that is complete is lost."""

from __future__ import annotations

import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from types import FrameType


class Interrupts:
    """Ctrl-C while work is under way.

    Attributes
    ----------
    requested : bool
        Whether it has come.
    answered : bool
        Whether who asked for it tells its caller, so that nothing is raised at the end.
    """

    def __init__(self) -> None:
        self.requested = self.answered = False
        self._is_heard = False

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
        self.requested = True
        if self._is_heard:
            raise KeyboardInterrupt


@contextmanager
def deferred() -> Iterator[Interrupts]:
    """Let Ctrl-C wait until it is asked for, or else until the end; inside another, that of the other is given.

    Only Python's own handler, which raises KeyboardInterrupt anywhere, is put aside, and in the main thread alone; one
    of the user's stays, and what it raises is not held back.
    """
    if threading.current_thread() is not threading.main_thread():
        yield Interrupts()
        return
    before = signal.getsignal(signal.SIGINT)
    outer = getattr(before, "__self__", None)
    if isinstance(outer, Interrupts):
        yield outer
        return
    here = Interrupts()
    if before is not signal.default_int_handler:
        yield here
        return
    signal.signal(signal.SIGINT, here.note)
    try:
        yield here
    finally:
        signal.signal(signal.SIGINT, before)
    if here.requested and not here.answered:
        raise KeyboardInterrupt
