"""What blocks hold: symbols, tables, and sentences with numerals in their places. All are data, which writers set."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from datetime import datetime
from typing import Any

from dondolo._base.wording import say
from dondolo._fortran.records import blank_unit, unit_of
from dondolo.reporting.numerals import Numeral, number

# What sentences that are said elsewhere are marked by for the catalogues
_ = str
MONTHS = (
    _("January"), _("February"), _("March"), _("April"), _("May"), _("June"), _("July"), _("August"), _("September"),
    _("October"), _("November"), _("December"),
)  # fmt: skip
_PLACE = re.compile(r"\{(\w+)\}")
# Rows of a table that stays on one page, and columns of those that take smaller letters on paper, and on any page
_SHORT, _MANY, _WIDE = 14, 7, 11
# Measures that sentences have in capitals
_ABBREVIATIONS = ("pga", "pgv", "pgd", "cav", "hi")


@dataclass(frozen=True)
class Symbol:
    """A quantity: an italic letter, an upright index below, and a mark above, such as a star."""

    letter: str
    index: str = ""
    mark: str = ""


THETA, BETA = Symbol("θ"), Symbol("β")

# What a cell or a term holds: a text, a symbol, a numeral, or several of them in a row
Piece = str | Symbol | Numeral | tuple[Any, ...]
# Names and what they are
Pairs = list[tuple[Piece, Piece]]


@dataclass(frozen=True)
class Column:
    """A column of a table: its head, its cells, and whether they are words, which are set flush left."""

    head: Piece
    cells: Sequence[Piece]
    is_text: bool = False


@dataclass(frozen=True)
class Table:
    """Columns of equal length; the first heads the rows."""

    columns: tuple[Column, ...]

    @classmethod
    def of(cls, columns: dict[Piece, Sequence[Piece]], texts: Iterable[str] = ()) -> Table:
        """A table of heads and cells.

        Parameters
        ----------
        columns : dict
            Head -> cells.
        texts : iterable of str
            Heads of the columns that hold words, as the first one does.
        """
        words = {next(iter(columns)), *texts}
        return cls(tuple(Column(head, cells, head in words) for head, cells in columns.items()))

    @property
    def total(self) -> int:
        """How many rows there are."""
        return len(self.columns[0].cells)

    @property
    def is_short(self) -> bool:
        """Whether it should not be parted by the end of a page."""
        return self.total <= _SHORT

    @property
    def breadth(self) -> str:
        """How wide it is: 'many' columns need smaller letters on paper, and a 'wide' table on any page."""
        columns = len(self.columns)
        return "wide" if columns > _WIDE else "many" if columns > _MANY else ""

    @property
    def rows(self) -> Iterable[tuple[Piece, ...]]:
        """Its rows."""
        return zip(*(column.cells for column in self.columns), strict=True)

    def first(self, rows: int) -> Table:
        """Its first rows."""
        return Table(tuple(replace(column, cells=column.cells[:rows]) for column in self.columns))


def pieces(sentence: str, **values: Any) -> tuple[Any, ...]:
    """A sentence in the language in force as pieces: numbers and symbols stay what they are in their places."""
    return in_places(say(sentence), values)


def in_places(sentence: str, values: Mapping[str, Any]) -> tuple[Any, ...]:
    """A sentence in the pieces between the places that it names, and what is set there."""
    parts = _PLACE.split(sentence)
    return tuple(values[part] if place % 2 else part for place, part in enumerate(parts) if part)


def said(piece: Piece) -> Piece:
    """A piece whose words are those of the language in force."""
    if isinstance(piece, tuple):
        return tuple(map(said, piece))
    return say(piece) if isinstance(piece, str) else piece


def state_name(edp: float, limit: float) -> str:
    """A damage state in words."""
    return say("collapse") if edp == limit else say("EDP ≥ {edp:g}", edp=float(edp))


def level_unit(im: str) -> str:
    """Unit of a measure for the head of a column."""
    return unit_of(im) or "-"


def measure_name(im: str) -> str:
    """A measure in a sentence: abbreviations in capitals."""
    return im.upper() if im in _ABBREVIATIONS else im


def level_head(im: str) -> str:
    """Head of a column of levels."""
    return f"{im} [{level_unit(im)}]"


def level(value: float, im: str) -> Numeral:
    """A level of intensity and its unit."""
    return number(value, 3, blank_unit(im))


def date_in_words(moment: datetime) -> str:
    """A date in words."""
    return f"{moment.day} {say(MONTHS[moment.month - 1])} {moment:%Y, %H:%M %Z}".strip().replace(
        " ", "\N{NO-BREAK SPACE}"
    )
