"""Blocks as a file of Word, by python-docx, in the styles of an office's template if there is one."""

from __future__ import annotations

import io
import os
import re
import zipfile
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from dondolo._fortran.files import whole_file
from dondolo.errors import DondoloError
from dondolo.figures.layout import lay_out
from dondolo.reporting.blocks import (
    Annexes,
    Block,
    CaptionedTable,
    Facts,
    Field,
    Formula,
    Heading,
    Listing,
    Note,
    Paragraph,
    Picture,
    Stamp,
)
from dondolo.reporting.content import Symbol
from dondolo.reporting.numerals import Numeral
from dondolo.reporting.relazione.document import Document, _
from dondolo.reporting.relazione.template import open_template
from dondolo.reporting.relazione.web import numbered
from dondolo.reporting.relazione.word_fields import Entry, add_bookmark, add_contents, add_number
from dondolo.reporting.relazione.word_formulas import formula_of
from dondolo.reporting.relazione.word_pages import set_pages, set_properties

_DOTS_PER_INCH = 300
# Of figures [cm], of what is between the margins [cm], and of small letters [points]
_WIDTH, _HEIGHT, _TEXT, _SMALL = 15.5, 6.0, 16.6, 8.5
# Of a long cell no more than these widths of letters count
_LONGEST = 21
# Margins of a cell, and size of a point [cm]
_MARGINS, _POINT = 0.42, 2.54 / 72
# Widths of bold letters over their size, narrow and wide ones, capitals and all others
_NARROW, _BROAD = "fijlrt.,:;'|()[]/- *", "mwMW%@"
# Columns of a table that takes small letters; sizes of letters [points], of which a table takes the first with room
_WIDE, _SIZES = 6, (8.5, 7.0, 6.5, 6.0, 5.5)
# Height of the frame for a stamp [cm], and levels of headings in the contents
_STAMP, _LISTED = 3.5, 2
# Words longer than this are parted after these marks, where names of files and records are
_PARTED, _MARKS = 12, re.compile(r"(?<=[_/\N{EN DASH}])")
# Where lines may end; at blanks that hold together they may not
_BLANKS = re.compile(r"[ \t\n]+")
_LANGUAGES = {"it": "it-IT", "en": "en-GB"}
_TABLE = "Dondolo Table"


def write_word(
    target: Path, blocks: Sequence[Block], document: Document, mark: str, template: str | os.PathLike[str] | None
) -> list[str]:
    """Write blocks as a file of Word, which appears whole or not at all; gives what was left out of the template.

    Raises
    ------
    DondoloError
        python-docx is not installed; the file cannot be written.
    InputError
        The template is no file of Word, or too large.
    """
    try:
        import docx
    except ImportError:
        raise DondoloError(
            "python-docx is not installed: pip install python-docx, or write the report as HTML or PDF"
        ) from None
    title = next(block.text for block in blocks if isinstance(block, Heading))
    if template is None:
        file = docx.Document()
        set_pages(file, title, document)
        left_out: list[str] = []
    else:
        file, left_out = open_template(template)
    _Writer(file, document).write(blocks)
    set_properties(file, title, document, mark)
    # Packed in memory: zipfile would leave a file half open that a full disk has no room for.
    packed = io.BytesIO()
    file.save(packed)
    with zipfile.ZipFile(packed, "a") as archive:
        # Word drops it when it saves the file, which is the office's own from then on.
        archive.comment = mark.encode()
    with whole_file(target) as part:
        part.write_bytes(packed.getvalue())
    return left_out


class _Writer:
    """What puts blocks into a file of Word."""

    def __init__(self, file: Any, document: Document) -> None:
        self._file, self._document = file, document
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
        language.set(qn("w:val"), _LANGUAGES[self._document.language.code])
        shown = numbered(blocks, self._document)
        self._marks = {
            id(block): f"_Toc{place:06}"
            for place, block in enumerate(shown, 1)
            if isinstance(block, Annexes) or (isinstance(block, Heading) and 0 < block.level <= _LISTED)
        }
        first = next((block for block in shown if id(block) in self._marks), None)
        for block in shown:
            if block is first:
                self._contents(shown)
            self._write(block)

    def _contents(self, shown: Sequence[Block]) -> None:
        """The table of contents, after what the title page has and before the first chapter."""
        paragraph = self._file.add_paragraph()
        self._run(paragraph, self._document.text(_("Contents")), bold=True)
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
            self._paragraph("Normal", block.pieces)
        elif isinstance(block, Note):
            paragraph = self._paragraph("Normal", block.pieces)
            _border(paragraph)
        elif isinstance(block, Facts):
            self._facts(block)
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
                self._document.language.decimal(piece.text) + (" \N{MULTIPLICATION SIGN} 10" if piece.power else ""),
                **look,
            )
            if piece.power:
                self._run(paragraph, piece.power, superscript=True, **look)
            if piece.unit:
                self._run(paragraph, piece.unit, **look)
        elif isinstance(piece, Symbol):
            self._run(paragraph, piece.letter, italic=True, **look)
            if piece.index:
                self._run(paragraph, self._document.text(piece.index), subscript=True, **look)
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

    def _facts(self, block: Facts) -> None:
        from docx.shared import Cm

        table = self._new_table(len(block.pairs), 2)
        table.autofit = False
        for column, width in zip(table.columns, (5.0, 11.5), strict=True):
            column.width = Cm(width)
        for row, (name, value) in zip(table.rows, block.pairs, strict=True):
            for cell, piece, width in zip(row.cells, (name, value), (5.0, 11.5), strict=True):
                cell.width = Cm(width)
                self._put(_tight(cell.paragraphs[0]), piece, size=9.5)
        self._space()

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

        shown, rows = block.table, list(block.table.all_rows)
        caption = self._caption(block.caption, self._document.text(_("Table")))
        caption.paragraph_format.keep_with_next = True
        table = self._new_table(1 + len(rows), len(shown.columns))
        header = OxmlElement("w:tblHeader")
        header.set(qn("w:val"), "true")
        table.rows[0]._tr.get_or_add_trPr().append(header)
        heads = tuple(column.head for column in shown.columns)
        size, measures = self._widths((heads, *rows))
        widths = [Cm(width) for width in measures]
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
                self._put(paragraph, _breakable(piece), size=size, **({"bold": True} if strong else {}))
                if not column.is_text:
                    paragraph.alignment = WD_ALIGN_PARAGRAPH.RIGHT
        self._space()

    def _widths(self, rows: Sequence[tuple[Any, ...]]) -> tuple[float, list[float]]:
        """Size of letters of a table and widths of its columns [cm]: no word is parted, long cells get more."""
        texts = [[self._document.language.plain(piece) for piece in column] for column in zip(*rows, strict=True)]
        words = [max(breadth(word) for text in column for word in parts_of_text(text) or [""]) for column in texts]
        # Every column has room for its longest word, and the rest goes to those with many long cells.
        sizes = _SIZES[1:] if len(texts) > _WIDE else _SIZES
        needs: list[float] = []
        for size in sizes:
            needs = [_MARGINS + _POINT * size * word for word in words]
            if sum(needs) <= _TEXT:
                break
        rest = max(0.0, _TEXT - sum(needs))
        wanted = [
            0.05 + sum(max(0.0, min(_LONGEST, breadth(text)) - word) for text in column) / len(column)
            for word, column in zip(words, texts, strict=True)
        ]
        widths = [need + rest * want / sum(wanted) for need, want in zip(needs, wanted, strict=True)]
        return size, [_TEXT * width / sum(widths) for width in widths]

    def _picture(self, block: Picture) -> None:
        import matplotlib.pyplot as plt
        from docx.shared import Cm

        axes = block.draw()
        drawing = (axes if hasattr(axes, "figure") else axes[0]).figure
        stream = io.BytesIO()
        try:
            lay_out(drawing, is_cut=True)
            drawing.savefig(stream, format="png", dpi=_DOTS_PER_INCH, bbox_inches="tight", metadata={"Software": None})
        finally:
            plt.close(drawing)
        paragraph = self._file.add_paragraph()
        paragraph.alignment = 1
        paragraph.paragraph_format.keep_with_next = True
        stream.seek(0)
        picture = paragraph.add_run().add_picture(stream, width=Cm(_WIDTH))
        if picture.height > Cm(_HEIGHT):
            picture.width, picture.height = int(picture.width * Cm(_HEIGHT) / picture.height), Cm(_HEIGHT)
        picture._inline.docPr.set("descr", block.alt)
        self._caption(block.caption, self._document.text(_("Figure")))

    def _formula(self, block: Formula) -> None:
        _tight(self._file.add_paragraph())._p.append(formula_of(block, self._document))

    def _listing(self, block: Listing) -> None:
        from docx.shared import Pt

        for line in block.text.split("\n"):
            paragraph = _tight(self._file.add_paragraph())
            run = paragraph.add_run(line)
            run.font.name, run.font.size = "Courier New", Pt(7.5)


def parts_of_text(text: str) -> list[str]:
    """What of a text stays on one line: its words, and of long names the parts between their marks."""
    return [part for word in _BLANKS.split(text) for part in (_MARKS.split(word) if len(word) > _PARTED else [word])]


def breadth(word: str) -> float:
    """Width of a word in bold letters over their size."""
    return sum(0.4 if one in _NARROW else 0.9 if one in _BROAD else 0.74 if one.isupper() else 0.62 for one in word)


def _breakable(piece: Any) -> Any:
    """A cell whose long names may go on in the next line after their marks."""
    if isinstance(piece, tuple):
        return tuple(map(_breakable, piece))
    if not isinstance(piece, str):
        return piece
    words = piece.split(" ")
    return " ".join("\N{ZERO WIDTH SPACE}".join(_MARKS.split(one)) if len(one) > _PARTED else one for one in words)


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
