"""Pages of a file of Word that has no template: letters, margins, header and footer; and the properties of any."""

from __future__ import annotations

from datetime import UTC, datetime
from typing import Any

from dondolo.reporting.writers.imprint import Imprint
from dondolo.reporting.writers.word_fields import add_number

# What sentences that are said elsewhere are marked by for the catalogues
_ = str
# Characters that a property of a file of Word has room for
_ROOM = 255
_SIZES = {"Normal": 10, "Title": 18, "Heading 1": 13, "Heading 2": 11.5, "Heading 3": 10, "Caption": 9}
_FONT = "Arial"
# Of the header and the footer [points]
_MARGINAL = 8


def set_pages(file: Any, imprint: Imprint) -> None:
    """A4, letters that are on every machine, a header from the second page on, and page numbers.

    Parameters
    ----------
    file : Document
        Of python-docx.
    imprint : Imprint
        For what the header has.
    """
    from docx.oxml.ns import qn
    from docx.shared import Cm, Pt, RGBColor

    section = file.sections[0]
    section.page_width, section.page_height = Cm(21.0), Cm(29.7)
    section.left_margin = section.right_margin = Cm(2.2)
    section.top_margin, section.bottom_margin = Cm(1.9), Cm(1.7)
    section.header_distance, section.footer_distance = Cm(1.0), Cm(0.9)
    for name, size in _SIZES.items():
        style = file.styles[name]
        style.font.name, style.font.size = _FONT, Pt(size)
        style.font.color.rgb = RGBColor(0, 0, 0)
        fonts = style.element.get_or_add_rPr().get_or_add_rFonts()
        for kind in ("w:asciiTheme", "w:hAnsiTheme", "w:eastAsiaTheme", "w:cstheme"):
            fonts.attrib.pop(qn(kind), None)
        fonts.set(qn("w:hAnsi"), _FONT)
    file.styles["Normal"].paragraph_format.space_after = Pt(4)
    file.styles["Heading 1"].paragraph_format.space_before = Pt(12)
    # The title page has its words already, but its number too
    section.different_first_page_header_footer = True
    _put_header(section.header.paragraphs[0], imprint)
    for footer in (section.footer, section.first_page_footer):
        paragraph = footer.paragraphs[0]
        paragraph.alignment = 1
        add_number(paragraph, "PAGE", "1")
        paragraph.add_run(" / ")
        add_number(paragraph, "NUMPAGES", "1")
        for run in paragraph.runs:
            run.font.size = Pt(_MARGINAL)


def _put_header(paragraph: Any, imprint: Imprint) -> None:
    """The work and its revision on the left, the report on the right, and a line below."""
    from docx.oxml import OxmlElement
    from docx.oxml.ns import qn
    from docx.shared import Pt

    revision = imprint.revision and imprint.language.text(_("revision {number}"), number=imprint.revision)
    left = ", ".join(filter(None, (imprint.work, revision)))
    # The style of headers has a stop in the middle, and one on the right
    paragraph.add_run(f"{left}\t\t{imprint.short}").font.size = Pt(_MARGINAL)
    line = OxmlElement("w:bottom")
    for name, value in (("val", "single"), ("sz", "4"), ("space", "3"), ("color", "888888")):
        line.set(qn(f"w:{name}"), value)
    sides = OxmlElement("w:pBdr")
    sides.append(line)
    paragraph._p.get_or_add_pPr().insert_element_before(sides, "w:shd", "w:tabs", "w:spacing", "w:ind", "w:jc")


def set_properties(file: Any, title: str, imprint: Imprint) -> None:
    """Title, subject, author, language and date of a file, and the mark by which dondolo knows it."""
    found = file.core_properties
    found.title = title[:_ROOM]
    found.subject = ", ".join(filter(None, (imprint.work, imprint.place)))[:_ROOM]
    found.author = found.last_modified_by = imprint.author[:_ROOM]
    found.version = imprint.revision[:_ROOM]
    found.keywords = imprint.keywords
    found.language = imprint.language.code
    found.created = found.modified = datetime.now(UTC).replace(microsecond=0)
    found.comments = imprint.mark
