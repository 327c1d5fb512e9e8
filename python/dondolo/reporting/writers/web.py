"""Blocks as a page of HTML, which also is what is printed as PDF: it needs nothing else, and all texts are escaped."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from importlib import resources
from typing import Any

from dondolo._base.wording import say
from dondolo.reporting.blocks import (
    Annexes,
    Aside,
    Block,
    Bullets,
    CaptionedTable,
    Cards,
    Details,
    Facts,
    Field,
    Formula,
    Fraction,
    Heading,
    Listing,
    Note,
    Paragraph,
    Picture,
    Root,
    Stamp,
    linear,
)
from dondolo.reporting.content import Column, Piece, Symbol
from dondolo.reporting.numerals import NONE, Numeral
from dondolo.reporting.writers.drawing import embedded
from dondolo.reporting.writers.imprint import Imprint, numbered, title_of

_NO_BREAK = "\N{NO-BREAK SPACE}"
# Characters that are marks of HTML, in texts and in attributes
_ESCAPED = str.maketrans({"&": "&amp;", "<": "&lt;", ">": "&gt;", '"': "&#34;", "'": "&#39;"})


def escape(text: str) -> str:
    """A text that no browser takes for marks."""
    return text.translate(_ESCAPED)


def page(blocks: Sequence[Block], imprint: Imprint, *, formulas: bool) -> str:
    """A page of blocks, in the language of its imprint.

    Parameters
    ----------
    blocks : sequence of Block
        In their order.
    imprint : Imprint
        For the language, and what stands beside the blocks.
    formulas : bool
        Whether formulas are set as such, by MathML, or in one line.
    """
    with imprint.language.in_force():
        writer = _Writer(imprint, formulas=formulas)
        shown = numbered(blocks, imprint.language) if imprint.is_for_paper else blocks
        return f"""<!DOCTYPE html>
<html lang="{imprint.language.code}">
<head>
{_head(title_of(blocks), imprint)}
</head>
<body>
{writer.body(shown)}
</body>
</html>
"""


def _head(title: str, imprint: Imprint) -> str:
    """What a browser has to know of a page."""
    sheet = resources.files("dondolo.reporting.writers") / ("document.css" if imprint.is_for_paper else "page.css")
    author = f'<meta name="author" content="{escape(imprint.author)}">\n' if imprint.author else ""
    # Nothing may be loaded: the policy makes a browser refuse what the page does not ask for anyway.
    return f"""<meta charset="utf-8">
<meta name="generator" content="{escape(imprint.mark)}">
{author}<meta name="viewport" content="width=device-width, initial-scale=1">
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; img-src data:; style-src 'unsafe-inline'">
<title>{escape(title)}</title>
<link rel="icon" href="data:,">
<style>
{sheet.read_text(encoding="utf-8").rstrip()}
</style>"""


class _Writer:
    """What makes HTML of blocks, in the language in force."""

    def __init__(self, imprint: Imprint, *, formulas: bool) -> None:
        self._imprint, self._formulas = imprint, formulas

    def body(self, blocks: Sequence[Block]) -> str:
        """All blocks; chapters that have anchors are sections, which the beginning of the page lists."""
        starts = [(at, block) for at, block in enumerate(blocks) if isinstance(block, Heading) and block.anchor]
        if not starts:
            return f"<main>\n{self._all(blocks)}\n</main>"
        listed = "\n".join(f'<li><a href="#{one.anchor}">{escape(one.text)}</a></li>' for _at, one in starts)
        sections = "\n".join(
            f'<section id="{one.anchor}" aria-label="{escape(one.text)}">\n{self._all(blocks[first:after])}\n</section>'
            for (first, one), after in zip(starts, [*(at for at, _one in starts[1:]), len(blocks)], strict=True)
        )
        return f"""<header>
<p class="kicker">{escape(self._imprint.kicker)}</p>
{self._all(blocks[: starts[0][0]])}
</header>
<nav aria-label="{escape(say("Contents"))}"><ol>
{listed}
</ol></nav>
<main>
{sections}
</main>
<footer>
<p>{escape(self._imprint.colophon)}</p>
</footer>"""

    def _all(self, blocks: Iterable[Block]) -> str:
        return "\n".join(map(self._block, blocks))

    def _block(self, block: Block) -> str:
        match block:
            case Heading():
                return f"<h{block.level + 1}>{escape(block.text)}</h{block.level + 1}>"
            case Annexes():
                return f'<h1 class="annexes">{escape(block.text)}</h1>'
            case Paragraph():
                return f"<p{_class(block.look)}>{self._piece(block.pieces)}</p>"
            case Note():
                return f'<p class="note {block.kind}">{self._piece(block.pieces)}</p>'
            case Bullets():
                return f"<ul>\n{_items(block.sentences)}\n</ul>"
            case Aside():
                listed = f"\n<ul>\n{_items(block.sentences)}\n</ul>" if block.sentences else ""
                kind = f"{block.kind} {block.tone}".strip()
                return f'<aside class="{kind}"><h3>{escape(block.title)}</h3>{listed}\n</aside>'
            case Facts():
                return self._terms("facts", ((name, (value,)) for name, value in block.pairs))
            case Cards():
                return self._terms("cards", ((name, more) for name, *more in block.entries))
            case Stamp():
                return f'<div class="stamp">{escape(block.text)}</div>'
            case CaptionedTable():
                return self._table(block)
            case Picture():
                image = f'<img src="{embedded(block.draw)}" alt="{escape(block.alt)}">'
                return f"<figure>{image}<figcaption>{escape(block.caption)}</figcaption></figure>"
            case Details():
                return f"<details><summary>{escape(block.title)}</summary>\n{self._all(block.blocks)}\n</details>"
            case Formula():
                return self._formula(block)
            case Listing():
                return f"<pre>{escape(block.text)}</pre>"

    def _piece(self, piece: Any) -> str:
        """A text, a symbol, a numeral, a field, or several of them in a row."""
        match piece:
            case Numeral():
                text = self._imprint.language.decimal(piece.text)
                text = f'<span title="{escape(say("none"))}">{text}</span>' if text == NONE.text else escape(text)
                power = f" \N{MULTIPLICATION SIGN} 10<sup>{piece.power}</sup>" if piece.power else ""
                return text + power + escape(piece.unit)
            case Symbol():
                index = f"<sub>{escape(say(piece.index))}</sub>" if piece.index else ""
                return f"<i>{escape(piece.letter)}</i>{index}{escape(piece.mark)}"
            case Field():
                return f"<mark>{escape(piece.text)}</mark>"
            case tuple():
                return "".join(map(self._piece, piece))
            case _:
                return escape(piece)

    def _terms(self, kind: str, entries: Iterable[tuple[Piece, Sequence[Piece]]]) -> str:
        """Names, what each is, and what is to be said of it."""
        rows = "\n".join(
            f"<div><dt>{self._piece(name)}</dt>"
            + "".join(f"<dd{_class('note' * place)}>{self._piece(one)}</dd>" for place, one in enumerate(several))
            + "</div>"
            for name, several in entries
        )
        return f'<dl class="{kind}">\n{rows}\n</dl>'

    def _table(self, block: CaptionedTable) -> str:
        table, caption = block.table, escape(block.caption)
        heads = "".join(
            f'<th scope="col" class="{_kind(column)}">{self._piece(column.head)}</th>' for column in table.columns
        )
        rows = "\n".join(
            f"<tr{_class('strong' * (place >= table.total - block.strong))}>"
            f'<th scope="row">{self._piece(first)}</th>'
            + "".join(
                f'<td class="{_kind(column, cell)}">{self._piece(cell)}</td>'
                for column, cell in zip(table.columns[1:], cells, strict=True)
            )
            + "</tr>"
            for place, (first, *cells) in enumerate(table.rows)
        )
        return (
            f'<div class="scroll{" short" * table.is_short}" role="region" tabindex="0" aria-label="{caption}">\n'
            f"<table{_class(table.breadth)}><caption>{caption}</caption>\n"
            f"<thead><tr>{heads}</tr></thead>\n<tbody>\n{rows}\n</tbody></table></div>"
        )

    def _formula(self, block: Formula) -> str:
        place = f'<span class="place">({escape(block.place)})</span>' if block.place else ""
        if not self._formulas:
            line = [part for side in block.sides for part in (" = ", *linear(side))]
            return f'<p class="formula">{self._piece(tuple(line[1:]))}{place and f" {place}"}</p>'
        sides = "<mo>=</mo>".join(map(self._math, block.sides))
        return f'<div class="formula"><math display="block">{sides}</math>{place}</div>'

    def _math(self, part: Any) -> str:
        """A part of a formula in MathML."""
        match part:
            case Fraction():
                return f"<mfrac><mrow>{self._math(part.top)}</mrow><mrow>{self._math(part.bottom)}</mrow></mfrac>"
            case Root():
                return f"<msqrt>{self._math(part.inside)}</msqrt>"
            case Numeral():
                power = f"<mo>·</mo><msup><mn>10</mn><mn>{part.power}</mn></msup>" if part.power else ""
                unit = self._math(part.unit) if part.unit else ""
                return f"<mn>{escape(self._imprint.language.decimal(part.text))}</mn>{power}{unit}"
            case Symbol():
                letter, mark = f"<mi>{escape(part.letter)}</mi>", f"<mo>{escape(part.mark)}</mo>" if part.mark else ""
                index = f"<mtext>{escape(say(part.index))}</mtext>" if part.index else ""
                tag = "m" + "sub" * bool(index) + "sup" * bool(mark)
                return f"<{tag}>{letter}{index}{mark}</{tag}>" if index or mark else letter
            case tuple():
                return f"<mrow>{''.join(map(self._math, part))}</mrow>"
            case _:
                return f"<mtext>{escape(part).replace(' ', _NO_BREAK)}</mtext>"


def _class(names: str) -> str:
    return f' class="{names}"' if names else ""


def _items(sentences: Iterable[str]) -> str:
    return "\n".join(f"<li>{escape(one)}</li>" for one in sentences)


def _kind(column: Column, cell: Piece | None = None) -> str:
    """How a cell is set: flush left, or as a number, of which words may take several lines."""
    return "text" if column.is_text else "num words" if isinstance(cell, str) else "num"
