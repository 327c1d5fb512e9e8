"""What documents are made of: blocks, of which HTML, PDF and Word are three views."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any, Literal

from dondolo.reporting.content import Piece, Symbol, Table
from dondolo.reporting.numerals import Numeral

# Letters of symbols by their names in the sheet of a check
_LETTERS = {
    "alpha": "\N{GREEK SMALL LETTER ALPHA}", "gamma": "\N{GREEK SMALL LETTER GAMMA}", "eta": "η", "kappa": "κ",
    "lambda": "λ", "mu": "μ", "pi": "π", "sigma": "\N{GREEK SMALL LETTER SIGMA}", "xi": "ξ", "zeta": "ζ",
}  # fmt: skip
# What sentences that are said elsewhere are marked by for the catalogues
_ = str
# Words below symbols, which documents have in their language
_INDICES = (_("anchor"), _("band"), _("bar"), _("bearing"), _("cone"), _("ov"), _("shear"))
# Words in formulas, which are upright
_UPRIGHT = ("FC", "ln", "max", "min", "sqrt")
_TOKEN = re.compile(r"([^\W\d_]+)(?:_([A-Za-z0-9]+(?:,[A-Za-z0-9]+)*))?(\*?)|([\W\d_]+)")


@dataclass(frozen=True)
class Field:
    """What the engineer has to write, a piece that is seen as such until then.

    Attributes
    ----------
    key : str
        Its name in the file of the project.
    text : str
        The prompt, in the language of the document.
    """

    key: str
    text: str


@dataclass(frozen=True)
class Heading:
    """The title of a chapter (level 1), of a part of one (2) or of a part of that (3); level 0 is that of the document.

    A chapter with an anchor is a section of its page, and can be linked to.
    """

    text: str
    level: int = 1
    anchor: str = ""


@dataclass(frozen=True)
class Paragraph:
    """Pieces in a row; 'lead' is the first of a document, in a line what it is, and a 'footnote' is small."""

    pieces: tuple[Any, ...]
    look: Literal["", "lead", "footnote"] = ""


@dataclass(frozen=True)
class Bullets:
    """A list of sentences."""

    sentences: tuple[str, ...]


@dataclass(frozen=True)
class Aside:
    """A title and a list that are set apart: a verdict, whose colour is its tone, or warnings."""

    kind: Literal["verdict", "warnings"]
    tone: Literal["", "failed", "doubt", "fine"]
    title: str
    sentences: tuple[str, ...]


@dataclass(frozen=True)
class Note:
    """A sentence that is set apart: a verdict ('failed', 'doubt', 'fine') or a remark ('plain')."""

    kind: Literal["failed", "doubt", "fine", "plain"]
    pieces: tuple[Any, ...]


@dataclass(frozen=True)
class Facts:
    """Names and what they are."""

    pairs: tuple[tuple[Piece, Any], ...]


@dataclass(frozen=True)
class Cards:
    """The main numbers: what each is, its value, and what is to be said of it."""

    entries: tuple[tuple[Piece, Piece, Piece], ...]


@dataclass(frozen=True)
class Stamp:
    """Room for a stamp and a signature, with what it is for."""

    text: str


@dataclass(frozen=True)
class CaptionedTable:
    """A table with its caption; `strong` rows at its end are sums."""

    table: Table
    caption: str
    strong: int = 0


@dataclass(frozen=True)
class Picture:
    """A drawing, its caption, and what there is to see for those who cannot see it."""

    draw: Callable[[], Any]
    caption: str
    alt: str


@dataclass(frozen=True)
class Details:
    """Blocks that a page folds up below a title; paper shows them."""

    title: str
    blocks: tuple[Block, ...]


@dataclass(frozen=True)
class Fraction:
    """A part of a formula over another."""

    top: Any
    bottom: Any


@dataclass(frozen=True)
class Root:
    """The square root of a part of a formula."""

    inside: Any


@dataclass(frozen=True)
class Formula:
    """Sides that are equal: in symbols, with the numbers put in, and the value; and its place in the code."""

    sides: tuple[Any, ...]
    place: str = ""


@dataclass(frozen=True)
class Annexes:
    """Here the document ends, and its annexes begin, on a new page."""

    text: str


@dataclass(frozen=True)
class Listing:
    """Lines of a file."""

    text: str


Block = (
    Heading | Paragraph | Bullets | Aside | Note | Facts | Cards | Stamp | CaptionedTable | Picture | Details | Formula
    | Annexes | Listing
)  # fmt: skip


def unfolded(blocks: Iterable[Block]) -> Iterator[Block]:
    """Blocks as paper has them: what a page folds up is a part with a heading."""
    for block in blocks:
        if isinstance(block, Details):
            yield Heading(block.title, 3)
            yield from unfolded(block.blocks)
        else:
            yield block


def fields_of(blocks: Sequence[Block]) -> list[Field]:
    """All that is left to write, in the order of the document."""
    return [piece for block in blocks for piece in _pieces(block) if isinstance(piece, Field)]


def _pieces(block: Block) -> Iterator[Any]:
    """The pieces of a block, one by one."""
    stack: list[Any] = []
    if isinstance(block, Paragraph | Note):
        stack = [block.pieces]
    elif isinstance(block, Facts):
        stack = [value for _, value in block.pairs]
    elif isinstance(block, CaptionedTable):
        stack = [cell for row in block.table.rows for cell in row]
    stack.reverse()
    while stack:
        piece = stack.pop()
        if isinstance(piece, tuple):
            stack.extend(reversed(piece))
        else:
            yield piece


def symbol_of(text: str) -> Piece:
    """A symbol of the sheet of a check, such as ``a_0*``, ``S_eZ(T)`` or ``a_gC S``."""
    pieces: list[Piece] = []
    for word, index, star, other in _TOKEN.findall(text):
        if other:
            pieces.append(other)
        elif word in _UPRIGHT:
            pieces.append(word)
        else:
            pieces.append(Symbol(_LETTERS.get(word, word), index, star))
    return pieces[0] if len(pieces) == 1 else tuple(pieces)


def linear(part: Any) -> tuple[Any, ...]:
    """A part of a formula in one line, for what sets no fractions."""
    if isinstance(part, Fraction):
        return (*_grouped(part.top), "/", *_grouped(part.bottom))
    if isinstance(part, Root):
        return ("√(", *linear(part.inside), ")")
    if isinstance(part, tuple):
        return tuple(piece for one in part for piece in linear(one))
    return (part,)


def _grouped(part: Any) -> tuple[Any, ...]:
    """A part in one line, in brackets if it is more than one symbol or number."""
    pieces = linear(part)
    alone = len(pieces) == 1 and (isinstance(pieces[0], Symbol | Numeral) or " " not in str(pieces[0]))
    return pieces if alone else ("(", *pieces, ")")
