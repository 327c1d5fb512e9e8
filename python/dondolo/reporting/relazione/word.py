"""Blocks as a file of Word, by python-docx, in the styles of an office's template if there is one."""

from __future__ import annotations

import io
import os
import zipfile
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from dondolo._base.arguments import argument_error
from dondolo._base.files import read_bytes
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
    Fraction,
    Heading,
    Listing,
    Note,
    Paragraph,
    Picture,
    Root,
)
from dondolo.reporting.content import Symbol
from dondolo.reporting.numerals import Numeral
from dondolo.reporting.relazione.document import Document, _
from dondolo.reporting.relazione.web import numbered
from dondolo.reporting.relazione.word_fields import add_contents, add_number

_DOTS_PER_INCH = 300
# Of figures [cm], of what is between the margins [cm], and of cells [points]
_WIDTH, _HEIGHT, _TEXT, _SMALL, _SMALLER = 15.5, 9.0, 16.6, 8.5, 7.0
# Characters of a column: of the longest cell no more than these count
_LONGEST = 34
# Margins of a cell, and width of a wide font's bold letter over its size [cm]
_MARGINS, _LETTER = 0.42, 0.0245
# Columns of a table that takes small letters
_WIDE = 7
_LANGUAGES = {"it": "it-IT", "en": "en-GB"}
_TABLE = "Dondolo Table"


def write_word(
    target: Path, blocks: Sequence[Block], document: Document, mark: str, template: str | os.PathLike[str] | None
) -> None:
    """Write blocks as a file of Word, which appears whole or not at all.

    Raises
    ------
    DondoloError
        python-docx is not installed; the file cannot be written.
    InputError
        The template is no file of Word.
    """
    try:
        import docx
    except ImportError:
        raise DondoloError(
            "python-docx is not installed: pip install 'dondolo[documents]', or write the report as HTML or PDF"
        ) from None
    if template is None:
        file = docx.Document()
        _set_page(file)
    else:
        try:
            file = docx.Document(io.BytesIO(read_bytes(template)))
        except (ValueError, KeyError, zipfile.BadZipFile) as error:
            raise argument_error(
                "out_of_range", "template", f" = {os.fspath(template)!r}: is not a file of Word: {error}"
            ) from None
    _Writer(file, document).write(blocks)
    file.core_properties.comments = mark
    file.core_properties.author = document.project.words.get("designer", "")
    with whole_file(target) as part:
        file.save(str(part))
        with zipfile.ZipFile(part, "a") as archive:
            # Word drops it when it saves the file, which is the office's own from then on.
            archive.comment = mark.encode()


def _set_page(file: Any) -> None:
    """A4, and letters that are on every machine."""
    from docx.oxml.ns import qn
    from docx.shared import Cm, Pt, RGBColor

    section = file.sections[0]
    section.page_width, section.page_height = Cm(21.0), Cm(29.7)
    section.left_margin = section.right_margin = Cm(2.2)
    section.top_margin = section.bottom_margin = Cm(2.0)
    sizes = {"Normal": 10.5, "Title": 18, "Heading 1": 13, "Heading 2": 11.5, "Caption": 9}
    for name, size in sizes.items():
        style = file.styles[name]
        style.font.name, style.font.size = "Arial", Pt(size)
        style.font.color.rgb = RGBColor(0, 0, 0)
        fonts = style.element.get_or_add_rPr().get_or_add_rFonts()
        for kind in ("w:asciiTheme", "w:hAnsiTheme", "w:eastAsiaTheme", "w:cstheme"):
            fonts.attrib.pop(qn(kind), None)
        fonts.set(qn("w:hAnsi"), "Arial")
    file.styles["Normal"].paragraph_format.space_after = Pt(5)
    paragraph = section.footer.paragraphs[0]
    paragraph.alignment = 1
    add_number(paragraph, "PAGE", "1")


class _Writer:
    """What puts blocks into a file of Word."""

    def __init__(self, file: Any, document: Document) -> None:
        self._file, self._document = file, document
        self._styles = {style.name for style in file.styles}

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
        chapters = [block for block in shown if isinstance(block, Heading) and block.level == 1]
        for block in shown:
            if chapters and block is chapters[0]:
                self._contents([chapter.text for chapter in chapters])
            self._write(block)

    def _contents(self, chapters: Sequence[str]) -> None:
        """The table of contents, on a page of its own before the first chapter."""
        self._file.add_page_break()
        paragraph = self._file.add_paragraph()
        self._run(paragraph, self._document.text(_("Contents")), bold=True)
        add_contents(self._file, chapters)
        self._file.add_page_break()

    def _write(self, block: Block) -> None:
        if isinstance(block, Heading):
            self._paragraph("Title" if block.level == 0 else f"Heading {block.level}", block.text)
        elif isinstance(block, Annexes):
            self._file.add_page_break()
            self._paragraph("Title", block.text)
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
        for row, (name, value) in zip(table.rows, block.pairs, strict=True):
            for cell, piece, width in zip(row.cells, (name, value), (5.0, 11.5), strict=True):
                cell.width = Cm(width)
                self._put(_tight(cell.paragraphs[0]), piece, size=9.5)
        self._space()

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
        size = _SMALLER if len(shown.columns) > _WIDE else _SMALL
        header = OxmlElement("w:tblHeader")
        header.set(qn("w:val"), "true")
        table.rows[0]._tr.get_or_add_trPr().append(header)
        heads = tuple(column.head for column in shown.columns)
        widths = [Cm(width) for width in self._widths((heads, *rows), size)]
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
                self._put(paragraph, piece, size=size, **({"bold": True} if strong else {}))
                if not column.is_text:
                    paragraph.alignment = WD_ALIGN_PARAGRAPH.RIGHT
        self._space()

    def _widths(self, rows: Sequence[tuple[Any, ...]], size: float) -> list[float]:
        """Widths of the columns of a table [cm]: no word is parted where there is room, long cells get more."""
        texts = [[self._document.language.plain(piece) for piece in column] for column in zip(*rows, strict=True)]
        words = [max(len(word) for text in column for word in text.split() or [""]) for column in texts]
        longest = [min(_LONGEST, max(map(len, column[1:]), default=0)) for column in texts]
        # Every column has room for its longest word, and the rest goes to those with long cells.
        needs = [_MARGINS + _LETTER * size * word for word in words]
        rest = max(0.0, _TEXT - sum(needs))
        wanted = [max(0.5, 0.5 * long - word) for word, long in zip(words, longest, strict=True)]
        widths = [need + rest * want / sum(wanted) for need, want in zip(needs, wanted, strict=True)]
        return [_TEXT * width / sum(widths) for width in widths]

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
        from docx.oxml import OxmlElement

        paragraph = self._file.add_paragraph()
        math = OxmlElement("m:oMathPara")
        inner = OxmlElement("m:oMath")
        for place, side in enumerate(block.sides):
            if place:
                _math_text(inner, " = ")
            self._math(inner, side)
        math.append(inner)
        paragraph._p.append(math)

    def _math(self, parent: Any, part: Any) -> None:
        """A part of a formula in Office's own notation."""
        if isinstance(part, tuple):
            for one in part:
                self._math(parent, one)
        elif isinstance(part, Fraction):
            made = _child(parent, "m:f")
            self._math(_child(made, "m:num"), part.top)
            self._math(_child(made, "m:den"), part.bottom)
        elif isinstance(part, Root):
            made = _child(parent, "m:rad")
            properties = _child(made, "m:radPr")
            _value(_child(properties, "m:degHide"), "1")
            _child(made, "m:deg")
            self._math(_child(made, "m:e"), part.inside)
        elif isinstance(part, Symbol):
            kind = {(True, True): "m:sSubSup", (True, False): "m:sSub", (False, True): "m:sSup"}
            name = kind.get((bool(part.index), bool(part.mark)))
            if name is None:
                _math_text(parent, part.letter)
                return
            made = _child(parent, name)
            _math_text(_child(made, "m:e"), part.letter)
            if part.index:
                _math_text(_child(made, "m:sub"), self._document.text(part.index), upright=True)
            if part.mark:
                _math_text(_child(made, "m:sup"), part.mark, upright=True)
        elif isinstance(part, Numeral):
            _math_text(parent, self._document.language.decimal(part.text), upright=True)
            if part.power:
                made = _child(parent, "m:sSup")
                _math_text(_child(made, "m:e"), "·10")
                _math_text(_child(made, "m:sup"), part.power)
            if part.unit:
                _math_text(parent, part.unit, upright=True)
        else:
            _math_text(parent, part.replace(" · ", "\N{THIN SPACE}·\N{THIN SPACE}"), upright=True)

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
    from docx.oxml.ns import qn

    sides = _child(paragraph._p.get_or_add_pPr(), "w:pBdr")
    left = _child(sides, "w:left")
    for name, value in (("val", "single"), ("sz", "24"), ("space", "6"), ("color", "666666")):
        left.set(qn(f"w:{name}"), value)


def _child(parent: Any, name: str) -> Any:
    from docx.oxml import OxmlElement

    made = OxmlElement(name)
    parent.append(made)
    return made


def _value(element: Any, value: str) -> None:
    from docx.oxml.ns import qn

    element.set(qn("m:val"), value)


def _math_text(parent: Any, text: str, *, upright: bool = False) -> None:
    """Characters of a formula."""
    run = _child(parent, "m:r")
    if upright:
        # Text, not operators: LibreOffice takes a star for a product that lacks a factor.
        _child(_child(run, "m:rPr"), "m:nor")
    made = _child(run, "m:t")
    made.text = text
    made.set("{http://www.w3.org/XML/1998/namespace}space", "preserve")
