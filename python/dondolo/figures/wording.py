"""Words of figures: in the language of the document that is being written, outside of one in that of the style."""

from __future__ import annotations

from contextlib import AbstractContextManager
from typing import Any

from dondolo._base import wording
from dondolo._base.wording import ENGLISH, Wording, in_words_of, of_document
from dondolo.figures.themes import theme


def say(sentence: str, **values: Any) -> str:
    """A sentence of a figure, with values in the places that it names, as `dondolo._base.wording.say`."""
    with in_words_of_figures():
        return wording.say(sentence, **values)


def decimal(text: str) -> str:
    """The digits of a number with the decimal mark of the language in force."""
    return text.replace(".", in_force().mark)


def in_english() -> bool:
    """Whether figures are drawn in English."""
    return in_force() is ENGLISH


def in_words_of_figures() -> AbstractContextManager[None]:
    """Let other rooms say what a figure asks them in the language of figures, until the end of a block."""
    return in_words_of(in_force())


def in_force() -> Wording:
    """The language of figures that are drawn now."""
    return of_document() or theme().wording


def set_decimal_marks(drawing: Any) -> None:
    """Give numbers of axes the decimal mark of the language in force; names beside ticks are those of the user."""
    from matplotlib.ticker import FixedLocator

    if in_english():
        return
    mark = in_force().mark
    for ax in (one for main in drawing.axes for one in (main, *main.child_axes)):
        for axis in (ax.xaxis, ax.yaxis):
            if not isinstance(axis.get_major_locator(), FixedLocator):
                ticks = axis.get_major_formatter()
                plain = type(ticks).format_ticks.__get__(ticks)
                ticks.format_ticks = lambda values, plain=plain: [one.replace(".", mark) for one in plain(values)]
