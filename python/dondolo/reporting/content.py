"""What the templates of a report set: symbols, tables, figures. All are data; templates escape and lay out."""

from __future__ import annotations

import base64
import io
import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from datetime import datetime
from typing import Any

from dondolo._base.wording import say
from dondolo._fortran.records import blank_unit, unit_of
from dondolo.figures.layout import lay_out
from dondolo.figures.wording import set_decimal_marks
from dondolo.reporting.numerals import Numeral, number

# What sentences that are said elsewhere are marked by for the catalogues
_ = str
MONTHS = (
    _("January"), _("February"), _("March"), _("April"), _("May"), _("June"), _("July"), _("August"), _("September"),
    _("October"), _("November"), _("December"),
)  # fmt: skip
_PLACE = re.compile(r"\{(\w+)\}")
# Rows of a table that are written; what is left out is said
ROWS = 500
# Rows of a table that stays on one page, and columns of one that fills its width
_SHORT, _WIDE = 14, 11
# A drawing is embedded as SVG up to this size, and as pixels beyond: many thin curves make large drawings
_SVG_BYTES = 600_000
_DOTS_PER_INCH = 180
# Measures that sentences have in capitals
_ABBREVIATIONS = ("pga", "pgv", "pgd", "cav", "hi")
# Around a drawing [inch]
_MARGIN = 0.1


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
Facts = list[tuple[Piece, Piece]]


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
    def shown(self) -> int:
        """How many of them are shown."""
        return min(ROWS, self.total)

    @property
    def is_short(self) -> bool:
        """Whether it should not be parted by the end of a page."""
        return self.shown <= _SHORT

    @property
    def is_wide(self) -> bool:
        """Whether it needs small letters on a page."""
        return len(self.columns) > _WIDE

    @property
    def all_rows(self) -> Iterable[tuple[Piece, ...]]:
        """All rows."""
        return zip(*(column.cells for column in self.columns), strict=True)

    @property
    def rows(self) -> Iterable[tuple[Piece, ...]]:
        """The rows that are shown."""
        return zip(*(column.cells[: self.shown] for column in self.columns), strict=True)


@dataclass(frozen=True)
class Figure:
    """A drawing as a data URI, and what there is to see for those who cannot see it."""

    source: str
    alt: str


def figure(draw: Callable[[], Any], alt: str) -> Figure:
    """Draw a figure, embedded: as SVG, or as PNG where that would be large.

    Parameters
    ----------
    draw : callable
        Gives Matplotlib axes, or several of one figure.
    alt : str
        What there is to see.

    Returns
    -------
    Figure
    """
    import matplotlib as mpl
    import matplotlib.pyplot as plt

    axes = draw()
    drawing = (axes if hasattr(axes, "figure") else axes[0]).figure
    try:
        set_decimal_marks(drawing)
        lay_out(drawing, is_cut=True)
        shown = drawing.get_tightbbox().padded(_MARGIN)
        # The same bytes every time: no date, and names in the drawing by a fixed salt.
        with mpl.rc_context({"svg.hashsalt": "dondolo"}):
            stream = io.BytesIO()
            drawing.savefig(stream, format="svg", metadata={"Date": None}, bbox_inches=shown)
            kind = "svg+xml"
            if stream.tell() > _SVG_BYTES:
                stream, kind = io.BytesIO(), "png"
                drawing.savefig(stream, format="png", dpi=_DOTS_PER_INCH, bbox_inches=shown)
    finally:
        plt.close(drawing)
    return Figure(f"data:image/{kind};base64,{base64.b64encode(stream.getvalue()).decode()}", alt)


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
