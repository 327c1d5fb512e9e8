"""Room in tables of Word: letters, margins and widths of columns by which no word is parted."""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import Any, NamedTuple

# Of a long cell no more than these widths of letters count
_LONGEST = 21
# Margins of a cell, and of one of a table that has no room for them [cm]; size of a point [cm]
_MARGINS, _TIGHT, _POINT = 0.42, 0.16, 2.54 / 72
# Widths of bold letters over their size, narrow and wide ones, capitals and all others
_NARROW, _BROAD = "fijlrt.,:;'|()[]/- *", "mwMW%@"
# Columns of a table that takes small letters; sizes of letters [points], of which a table takes the first with room
_WIDE, _SIZES = 6, (8.5, 7.0, 6.5, 6.0, 5.5)
# Words longer than this are parted after these marks, where names of files and records are
_PARTED, _MARKS = 12, re.compile(r"(?<=[_/\N{EN DASH}])")
# Where lines may end; at blanks that hold together they may not
_BLANKS = re.compile(r"[ \t\n]+")


class Room(NamedTuple):
    """What a table takes.

    Attributes
    ----------
    size : float
        Of its letters [points].
    is_tight : bool
        Whether its cells have narrow margins.
    widths : list of float
        Of its columns [cm].
    """

    size: float
    is_tight: bool
    widths: list[float]


def room_of(texts: Sequence[Sequence[str]], width: float) -> Room:
    """Letters and columns of a table: no word is parted, and long cells get more.

    Parameters
    ----------
    texts : sequence of sequence of str
        Cells of each column.
    width : float
        Of the table [cm].
    """
    words = [max(breadth(word) for text in column for word in parts_of_text(text) or [""]) for column in texts]
    # Every column has room for its longest word, and the rest goes to those with many long cells.
    sizes = _SIZES[1:] if len(texts) > _WIDE else _SIZES
    needs: list[float] = []
    for margins, size in (*((_MARGINS, one) for one in sizes), (_TIGHT, _SIZES[-1])):
        needs = [margins + _POINT * size * word for word in words]
        if sum(needs) <= width:
            break
    rest = max(0.0, width - sum(needs))
    wanted = [
        0.05 + sum(max(0.0, min(_LONGEST, breadth(text)) - word) for text in column) / len(column)
        for word, column in zip(words, texts, strict=True)
    ]
    widths = [need + rest * want / sum(wanted) for need, want in zip(needs, wanted, strict=True)]
    return Room(size, margins < _MARGINS, [width * one / sum(widths) for one in widths])


def parts_of_text(text: str) -> list[str]:
    """What of a text stays on one line: its words, and of long names the parts between their marks."""
    return [part for word in _BLANKS.split(text) for part in (_MARKS.split(word) if len(word) > _PARTED else [word])]


def breadth(word: str) -> float:
    """Width of a word in bold letters over their size."""
    return sum(0.4 if one in _NARROW else 0.9 if one in _BROAD else 0.74 if one.isupper() else 0.62 for one in word)


def breakable(piece: Any) -> Any:
    """A cell whose long names may go on in the next line after their marks."""
    if isinstance(piece, tuple):
        return tuple(map(breakable, piece))
    if not isinstance(piece, str):
        return piece
    words = piece.split(" ")
    return " ".join("\N{ZERO WIDTH SPACE}".join(_MARKS.split(one)) if len(one) > _PARTED else one for one in words)


def tighten(table: Any) -> None:
    """Give the cells of a table narrow margins."""
    from docx.oxml import OxmlElement
    from docx.oxml.ns import qn

    margins = OxmlElement("w:tblCellMar")
    for side in ("left", "right"):
        margin = OxmlElement(f"w:{side}")
        # In twentieths of a point
        margin.set(qn("w:w"), str(round(20 * 0.4 * _TIGHT / _POINT)))
        margin.set(qn("w:type"), "dxa")
        margins.append(margin)
    table._tbl.tblPr.insert_element_before(margins, "w:tblLook")
