"""Blocks as a page of HTML, which is also what is printed as PDF."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from typing import Any

from dondolo.reporting.blocks import Block, CaptionedTable, Formula, Heading, Picture, linear
from dondolo.reporting.content import figure
from dondolo.reporting.page import environment
from dondolo.reporting.relazione.document import Document, _


def page(blocks: Sequence[Block], document: Document, mark: str, *, formulas: bool) -> str:
    """A page of blocks.

    Parameters
    ----------
    blocks : sequence of Block
        In their order.
    document : Document
        For the language.
    mark : str
        By which the file is known.
    formulas : bool
        Whether formulas are set as such, by MathML, or in one line.
    """
    template = environment(document.language).get_template("document.html.j2")
    with document.language.in_force():
        return template.render(
            lang=document.language.code,
            title=next(block.text for block in blocks if isinstance(block, Heading)),
            generator=mark,
            author=document.project.words.get("designer", ""),
            formulas=formulas,
            blocks=[(type(block).__name__, _shown(block)) for block in numbered(blocks, document)],
        )


def numbered(blocks: Sequence[Block], document: Document) -> list[Block]:
    """Blocks whose chapters, tables and figures have their numbers."""
    chapters = tables = figures = 0
    made: list[Block] = []
    for block in blocks:
        if isinstance(block, Heading) and block.level == 1:
            chapters += 1
            block = replace(block, text=f"{chapters}. {block.text}")
        elif isinstance(block, CaptionedTable):
            tables += 1
            block = replace(block, caption=f"{document.text(_('Table'))} {tables}. {block.caption}")
        elif isinstance(block, Picture):
            figures += 1
            block = replace(block, caption=f"{document.text(_('Figure'))} {figures}. {block.caption}")
        made.append(block)
    return made


def _shown(block: Block) -> Any:
    """A block as the template takes it: pictures drawn, formulas also in one line."""
    if isinstance(block, Picture):
        drawn = figure(block.draw, block.alt)
        return {"source": drawn.source, "alt": drawn.alt, "caption": block.caption}
    if isinstance(block, Formula):
        line = tuple(part for side in block.sides for part in (" = ", *linear(side)))
        return {"sides": block.sides, "line": line[1:], "place": block.place}
    return block
