"""What can go wrong, and what a user should know."""

from __future__ import annotations

import warnings
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any


class DondoloError(Exception):
    """The work failed."""


class InputError(DondoloError, ValueError):
    """What was asked for is wrong; the message is the sentence of the executable."""


class MissingFileError(FileNotFoundError, InputError):
    """A file that was asked for does not exist."""


class DondoloWarning(UserWarning):
    """Results that are correct but may mislead."""


@contextmanager
def silent() -> Iterator[None]:
    """No warnings of dondolo, where what they would say is said in another way."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", DondoloWarning)
        yield


class Interrupted(KeyboardInterrupt):
    """Ctrl-C stopped a long run; what was finished is kept.

    Attributes
    ----------
    partial : Stripes, Typology or None
        The finished part as a result of its own: the complete stripes, or the complete walls; None if there are none.

    Examples
    --------
    In a notebook, after the interruption: ``import sys; partial = sys.last_value.partial``.
    """

    def __init__(self, message: str, partial: Any = None) -> None:
        super().__init__(message)
        self.partial = partial
