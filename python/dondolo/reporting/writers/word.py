"""Blocks as a file of Word, by python-docx, in the styles of an office's template if there is one."""

from __future__ import annotations

import io
import os
import zipfile
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from dondolo._fortran.files import whole_file
from dondolo.errors import DondoloError
from dondolo.reporting.blocks import (
    Annexes,
    Aside,
    Block,
    Bullets,
    CaptionedTable,
    Cards,
    Facts,
    Field,
    Formula,
    Heading,
    Listing,
    Note,
    Paragraph,
    Picture,
    Stamp,
    unfolded,
)
from dondolo.reporting.content import Symbol
from dondolo.reporting.numerals import Numeral
from dondolo.reporting.writers.drawing import drawn
from dondolo.reporting.writers.imprint import Imprint, numbered, title_of
from dondolo.reporting.writers.template import open_template
from dondolo.reporting.writers.word_fields import Entry, add_bookmark, add_contents, add_number
from dondolo.reporting.writers.word_formulas import formula_of
from dondolo.reporting.writers.word_pages import set_pages, set_properties
from dondolo.reporting.writers.word_tables import breakable, room_of, tighten

# What sentences that are said elsewhere are marked by for the catalogues
_ = str
_DOTS_PER_INCH = 300
# Of figures [cm], of what is between the margins [cm], and of small letters [points]
_WIDTH, _TEXT, _SMALL = 15.5, 16.6, 8.5
# Height of the frame for a stamp [cm], and levels of headings in the contents
_STAMP, _LISTED = 3.5, 2
_LANGUAGES = {"it": "it-IT", "en": "en-GB"}
_TABLE = "Dondolo Table"


def check_docx() -> None:
    """Refuse to make a document of Word where nothing can write it.

    Raises
    ------
    DondoloError
        python-docx is not installed.
    """
    try:
        import docx  # noqa: F401
    except ImportError:
        raise DondoloError(
            "python-docx is not installed: pip install python-docx, or write the report as HTML or PDF"
        ) from None


def write_word(
    target: Path, blocks: Sequence[Block], imprint: Imprint, template: str | os.PathLike[str] | None
) -> list[str]:
    """Write blocks as a file of Word, which appears whole or not at all; gives what was left out of the template.

    Raises
    ------
    DondoloError
        The file cannot be written.
    InputError
        The template is no file of Word, or too large.
    """
    import docx

    if template is None:
        file = docx.Document()
        set_pages(file, imprint)
        left_out: list[str] = []
    else:
        file, left_out = open_template(template)
    with imprint.language.in_force():
        _Writer(file, imprint).write(blocks)
    set_properties(file, title_of(blocks), imprint)
    # Packed in memory: zipfile would leave a file half open that a full disk has no room for.
    packed = io.BytesIO()
    file.save(packed)
    with zipfile.ZipFile(packed, "a") as archive:
        # Word drops it when it saves the file, which is the office's own from then on.
        archive.comment = imprint.mark.encode()
    with whole_file(target) as part:
        part.write_bytes(packed.getvalue())
    return left_out


class _Writer:
    """What puts blocks into a file of Word."""

    def __init__(self, file: Any, imprint: Imprint) -> None:
        self._file, self._imprint, self._language = file, imprint, imprint.language
        # Bookmarks of the headings that are in the contents
        self._marks: dict[int, str] = {}
        # Of a template a style of letters may have the name of one of paragraphs.
        self._styles = {style.name for style in file.styles if str(style.type).startswith(("PARAGRAPH", "TABLE"))}

    def write(self, blocks: Sequence[Block]) -> None:
        """All blocks, in their order."""
        from docx.oxml import OxmlElement
        from docx.oxml.ns import qn

        normal = self._file.styles["Normal"].element.get_or_add_rPr()
        language = normal.find(qn("w:lang"))
        if language is None:
            language = OxmlElement("w:lang")
            normal.append(language)
        language.set(qn("w:val"), _LANGUAGES[self._language.code])
        shown = numbered(list(unfolded(blocks)), self._language)
        self._marks = {
            id(block): f"_Toc{place:06}"
            for place, block in enumerate(shown, 1)
            if isinstance(block, Annexes) or (isinstance(block, Heading) and 0 < block.level <= _LISTED)
        }
        first = next((block for block in shown if id(block) in self._marks), None)
        if self._imprint.kicker:
            self._paragraph("Normal", self._imprint.kicker)
        for block in shown:
            if block is first:
                self._contents(shown)
            self._write(block)
        if self._imprint.colophon:
            self._put(self._paragraph("Normal", ""), self._imprint.colophon, size=_SMALL)

    def _contents(self, shown: Sequence[Block]) -> None:
        """The table of contents, after what the title page has and before the first chapter."""
        paragraph = self._file.add_paragraph()
        self._run(paragraph, self._language.text(_("Contents")), bold=True)
        entries = [
            Entry(block.text, block.level if isinstance(block, Heading) else 1, self._marks[id(block)])
            for block in shown
            if isinstance(block, Heading | Annexes) and id(block) in self._marks
        ]
        add_contents(self._file, entries, width=_TEXT)
        self._file.add_page_break()

    def _write(self, block: Block) -> None:
        if isinstance(block, Heading):
            heading = self._paragraph("Title" if block.level == 0 else f"Heading {block.level}", block.text)
            if id(block) in self._marks:
                add_bookmark(heading, self._marks[id(block)])
        elif isinstance(block, Annexes):
            heading = self._paragraph("Heading 1", block.text)
            heading.paragraph_format.page_break_before = True
            add_bookmark(heading, self._marks[id(block)])
        elif isinstance(block, Stamp):
            self._stamp(block)
        elif isinstance(block, Paragraph):
            look = {"size": _SMALL} if block.look == "footnote" else {}
            self._put(self._paragraph("Normal", ""), block.pieces, **look)
        elif isinstance(block, Note):
            _border(self._paragraph("Normal", block.pieces))
        elif isinstance(block, Bullets):
            for sentence in block.sentences:
                self._bullet(sentence)
        elif isinstance(block, Aside):
            title = self._paragraph("Normal", "")
            self._run(title, block.title, bold=True)
            for paragraph in (title, *map(self._bullet, block.sentences)):
                _border(paragraph)
        elif isinstance(block, Facts):
            self._rows(block.pairs, (5.0, 11.5))
        elif isinstance(block, Cards):
            self._rows(block.entries, (4.5, 4.0, 8.0))
        elif isinstance(block, CaptionedTable):
            self._table(block)
        elif isinstance(block, Picture):
            self._picture(block)
        elif isinstance(block, Formula):
            self._formula(block)
        elif isinstance(block, Listing):
            self._listing(block)

    def _paragraph(self, style: str, pieces: Any) -> Any:
        paragraph = self._file.add_paragraph(style=style if style in self._styles else None)
        self._put(paragraph, pieces)
        return paragraph

    def _put(self, paragraph: Any, piece: Any, **look: Any) -> None:
        """A piece as runs of a paragraph."""
        if isinstance(piece, tuple):
            for part in piece:
                self._put(paragraph, part, **look)
        elif isinstance(piece, Numeral):
            self._run(
                paragraph,
                self._language.decimal(piece.text) + (" \N{MULTIPLICATION SIGN} 10" if piece.power else ""),
                **look,
            )
            if piece.power:
                self._run(paragraph, piece.power, superscript=True, **look)
            if piece.unit:
                self._run(paragraph, piece.unit, **look)
        elif isinstance(piece, Symbol):
            self._run(paragraph, piece.letter, italic=True, **look)
            if piece.index:
                self._run(paragraph, self._language.text(piece.index), subscript=True, **look)
            if piece.mark:
                self._run(paragraph, piece.mark, **look)
        elif isinstance(piece, Field):
            self._run(paragraph, piece.text, highlight=True, **look)
        elif piece:
            self._run(paragraph, piece, **look)

    @staticmethod
    def _run(
        paragraph: Any,
        text: str,
        *,
        italic: bool = False,
        bold: bool = False,
        subscript: bool = False,
        superscript: bool = False,
        highlight: bool = False,
        size: float | None = None,
    ) -> None:
        from docx.enum.text import WD_COLOR_INDEX
        from docx.shared import Pt

        run = paragraph.add_run(text)
        for name, given in (("italic", italic), ("bold", bold), ("subscript", subscript), ("superscript", superscript)):
            if given:
                setattr(run.font, name, True)
        if highlight:
            run.font.highlight_color = WD_COLOR_INDEX.YELLOW
        if size is not None:
            run.font.size = Pt(size)

    def _caption(self, text: str, word: str) -> Any:
        """A caption whose number Word keeps up to date."""
        paragraph = self._file.add_paragraph(style="Caption" if "Caption" in self._styles else None)
        number, _blank, rest = text.removeprefix(f"{word} ").partition(". ")
        paragraph.add_run(f"{word} ")
        add_number(paragraph, f"SEQ {word} \\* ARABIC", number)
        paragraph.add_run(f". {rest}")
        return paragraph

    def _new_table(self, rows: int, columns: int) -> Any:
        table = self._file.add_table(rows, columns)
        for name in (_TABLE, "Table Grid"):
            if name in self._styles:
                table.style = name
                break
        return table

    def _rows(self, rows: Sequence[tuple[Any, ...]], widths: tuple[float, ...]) -> None:
        """Names and what they are, beside each other; the value of a card is bold."""
        from docx.shared import Cm

        table = self._new_table(len(rows), len(widths))
        table.autofit = False
        for column, width in zip(table.columns, widths, strict=True):
            column.width = Cm(width)
        for row, several in zip(table.rows, rows, strict=True):
            for place, (cell, piece, width) in enumerate(zip(row.cells, several, widths, strict=True)):
                cell.width = Cm(width)
                look = {"bold": True} if place == 1 and len(widths) > 2 else {}
                self._put(_tight(cell.paragraphs[0]), piece, size=9.5, **look)
        self._space()

    def _bullet(self, sentence: str) -> Any:
        """A sentence of a list."""
        is_styled = "List Bullet" in self._styles
        return _tight(self._paragraph("List Bullet", sentence if is_styled else f"\N{BULLET} {sentence}"))

    def _stamp(self, block: Stamp) -> None:
        """A frame on the right, with room for a stamp and a signature."""
        from docx.shared import Cm

        self._space()
        table = self._new_table(1, 1)
        table.autofit = False
        table.alignment = 2
        table.rows[0].height = Cm(_STAMP)
        cell = table.cell(0, 0)
        cell.width = table.columns[0].width = Cm(7.0)
        self._put(_tight(cell.paragraphs[0]), block.text, size=_SMALL)

    def _space(self) -> None:
        """Room below a table, which has no margin of its own."""
        from docx.shared import Pt

        paragraph = self._file.add_paragraph()
        paragraph.paragraph_format.space_after = Pt(0)
        paragraph.paragraph_format.line_spacing = Pt(6)

    def _table(self, block: CaptionedTable) -> None:
        from docx.enum.text import WD_ALIGN_PARAGRAPH
        from docx.oxml import OxmlElement
        from docx.oxml.ns import qn
        from docx.shared import Cm

        shown, rows = block.table, list(block.table.rows)
        caption = self._caption(block.caption, self._language.text(_("Table")))
        caption.paragraph_format.keep_with_next = True
        table = self._new_table(1 + len(rows), len(shown.columns))
        header = OxmlElement("w:tblHeader")
        header.set(qn("w:val"), "true")
        table.rows[0]._tr.get_or_add_trPr().append(header)
        heads = tuple(column.head for column in shown.columns)
        texts = [[self._language.plain(piece) for piece in column] for column in zip(heads, *rows, strict=True)]
        room = room_of(texts, _TEXT)
        if room.is_tight:
            tighten(table)
        widths = [Cm(width) for width in room.widths]
        for column, width in zip(table.columns, widths, strict=True):
            column.width = width
        # The cells of python-docx are looked up from the first on: by rows they are found in one go.
        for place, (row, pieces) in enumerate(zip(table.rows, (heads, *rows), strict=True)):
            whole_row = OxmlElement("w:cantSplit")
            row._tr.get_or_add_trPr().append(whole_row)
            strong = not place or place > len(rows) - block.strong
            for cell, piece, column, width in zip(row.cells, pieces, shown.columns, widths, strict=True):
                cell.width = width
                paragraph = _tight(cell.paragraphs[0])
                # A short table stays on one page, and its caption with it.
                paragraph.paragraph_format.keep_with_next = shown.is_short and place < len(rows)
                self._put(paragraph, breakable(piece), size=room.size, **({"bold": True} if strong else {}))
                if not column.is_text:
                    paragraph.alignment = WD_ALIGN_PARAGRAPH.RIGHT
        self._space()

    def _picture(self, block: Picture) -> None:
        from docx.shared import Cm

        stream, tallest = io.BytesIO(), Cm(self._imprint.tallest)
        with drawn(block.draw) as figure:
            figure.savefig(stream, format="png", dpi=_DOTS_PER_INCH, bbox_inches="tight", metadata={"Software": None})
        paragraph = self._file.add_paragraph()
        paragraph.alignment = 1
        paragraph.paragraph_format.keep_with_next = True
        stream.seek(0)
        picture = paragraph.add_run().add_picture(stream, width=Cm(_WIDTH))
        if picture.height > tallest:
            picture.width, picture.height = int(picture.width * tallest / picture.height), tallest
        picture._inline.docPr.set("descr", block.alt)
        self._caption(block.caption, self._language.text(_("Figure")))

    def _formula(self, block: Formula) -> None:
        _tight(self._file.add_paragraph())._p.append(formula_of(block, self._language))

    def _listing(self, block: Listing) -> None:
        from docx.shared import Pt

        for line in block.text.split("\n"):
            paragraph = _tight(self._file.add_paragraph())
            run = paragraph.add_run(line)
            run.font.name, run.font.size = "Courier New", Pt(7.5)


def _tight(paragraph: Any) -> Any:
    """A paragraph without room around it."""
    from docx.shared import Pt

    paragraph.paragraph_format.space_after = Pt(0)
    return paragraph


def _border(paragraph: Any) -> None:
    """A line on the left of a paragraph that is set apart."""
    from docx.oxml import OxmlElement
    from docx.oxml.ns import qn

    sides = OxmlElement("w:pBdr")
    left = OxmlElement("w:left")
    sides.append(left)
    for name, value in (("val", "single"), ("sz", "24"), ("space", "6"), ("color", "666666")):
        left.set(qn(f"w:{name}"), value)
    paragraph._p.get_or_add_pPr().insert_element_before(sides, "w:shd", "w:tabs", "w:spacing", "w:ind", "w:jc")
