"""What a document says of itself beside its blocks."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

from dondolo.reporting.blocks import Block, CaptionedTable, Heading, Picture
from dondolo.reporting.language import Language

# What sentences that are said elsewhere are marked by for the catalogues
_ = str


@dataclass(frozen=True)
class Imprint:
    """Of a document.

    Attributes
    ----------
    language : Language
    mark : str
        By which dondolo knows the file.
    short : str
        What kind of a document it is, beside the title of each page.
    kicker, colophon : str
        What stands above the title of a page, and at its end.
    author, work, place, revision : str
        Of the project; empty for those that are not known.
    keywords : str
    is_for_paper : bool
        Whether chapters, tables and figures have numbers wherever it is read, as they have in Word.
    tallest : float
        Height that a figure may have in Word [cm].
    """

    language: Language
    mark: str
    short: str
    kicker: str = ""
    colophon: str = ""
    author: str = ""
    work: str = ""
    place: str = ""
    revision: str = ""
    keywords: str = ""
    is_for_paper: bool = False
    tallest: float = 9.0


def title_of(blocks: Sequence[Block]) -> str:
    """The title of a document: its first heading."""
    return next(block.text for block in blocks if isinstance(block, Heading))


def numbered(blocks: Sequence[Block], language: Language) -> list[Block]:
    """Blocks whose chapters, tables and figures have their numbers."""
    chapters = tables = figures = 0
    made: list[Block] = []
    for block in blocks:
        if isinstance(block, Heading) and block.level == 1:
            chapters += 1
            block = replace(block, text=f"{chapters}. {block.text}")
        elif isinstance(block, CaptionedTable):
            tables += 1
            block = replace(block, caption=f"{language.text(_('Table'))} {tables}. {block.caption}")
        elif isinstance(block, Picture):
            figures += 1
            block = replace(block, caption=f"{language.text(_('Figure'))} {figures}. {block.caption}")
        made.append(block)
    return made
