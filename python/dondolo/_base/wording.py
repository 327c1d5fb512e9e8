"""Sentences in the language of the document that is being written, which is English outside of one."""

from __future__ import annotations

import re
import string
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from typing import Any, NamedTuple


class Wording(NamedTuple):
    """A language.

    Attributes
    ----------
    translate : callable
        Gives the sentence of an English one, or the same where there is none.
    mark : str
        Decimal mark.
    """

    translate: Callable[[str], str] = str
    mark: str = "."


ENGLISH = Wording()
_CURRENT: ContextVar[Wording | None] = ContextVar("wording", default=None)
_LINE_END = re.compile(r"\s*\n\s*")


class _Formatter(string.Formatter):
    """Values in their places, numbers with the decimal mark of the language."""

    def format_field(self, value: Any, format_spec: str) -> Any:
        text = format(value, format_spec)
        return decimal(text) if isinstance(value, float) else text


@contextmanager
def in_words_of(wording: Wording) -> Iterator[None]:
    """Write in a language until the end of the block."""
    token = _CURRENT.set(wording)
    try:
        yield
    finally:
        _CURRENT.reset(token)


def of_document() -> Wording | None:
    """The language of the document that is being written; None outside of one."""
    return _CURRENT.get()


def in_english() -> bool:
    """Whether English is written."""
    return _current() is ENGLISH


def _current() -> Wording:
    return _CURRENT.get() or ENGLISH


def key(sentence: str) -> str:
    """A sentence as catalogues have it: in one line."""
    return _LINE_END.sub(" ", sentence)


def say(sentence: str, **values: Any) -> str:
    """A sentence in the language in force, with values in the places that it names.

    Catalogues are made of the sentences that are literals in calls of this function, and of those marked by ``_``.
    """
    current = _current()
    if current is ENGLISH:
        return sentence.format(**values) if values else sentence
    known = key(sentence)
    found = current.translate(known)
    found = sentence if found == known else found
    return _Formatter().format(found, **values) if values else found


def named(what: str, name: str, english: str | None = None) -> str:
    """What has a name, in the language in force; `what` it is the name of is its context in catalogues.

    Where there is none it is in English: the name itself, if nothing else is given.
    """
    known = f"{what}\4{name}"
    found = _current().translate(known)
    return found if found != known else name if english is None else english


def property_name(name: str) -> str:
    """A property of a wall in words, or what else a source of uncertainty is."""
    english = name.replace("_", " ")
    found = say(english)
    meaning = named("property of a case", name, "")
    return named("head of a column", name, meaning) if meaning and found == english else found


def decimal(text: str) -> str:
    """The digits of a number with the decimal mark of the language in force."""
    return text.replace(".", _current().mark)
