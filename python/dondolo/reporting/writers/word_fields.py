"""Fields of a file of Word, which Word keeps up to date: numbers of pages, tables and figures, and the contents."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

# Chapters and their parts, with links, from the styles of headings
_CONTENTS = 'TOC \\o "1-2" \\h \\z \\u'
# Indent of a level of the contents [cm]
_INDENT = 0.6


class Entry(NamedTuple):
    """A line of the contents: a heading, its level, and the bookmark at it."""

    title: str
    level: int
    bookmark: str


def add_number(paragraph: Any, instruction: str, shown: str) -> None:
    """A number.

    Parameters
    ----------
    paragraph : Paragraph
        Where it is added.
    instruction : str
        What Word computes.
    shown : str
        What is shown until then.
    """
    paragraph._p.append(_field(instruction, shown))


def add_bookmark(paragraph: Any, name: str) -> None:
    """A bookmark around a paragraph.

    Parameters
    ----------
    paragraph : Paragraph
        A heading.
    name : str
        Its name, whose digits are its number in the file.
    """
    number = "".join(filter(str.isdigit, name))
    start = _element("w:bookmarkStart", id=str(int(number)), name=name)
    element = paragraph._p
    properties = element.pPr
    element.insert(0 if properties is None else element.index(properties) + 1, start)
    element.append(_element("w:bookmarkEnd", id=str(int(number))))


def add_contents(file: Any, entries: Sequence[Entry], *, width: float) -> None:
    """The table of contents, at the end of a file as it is written: Word sets the pages when it opens the file.

    Parameters
    ----------
    file : Document
        Of python-docx.
    entries : sequence of Entry
        Headings with a number of their page, which are links. They are shown until then, and by programs that do
        not update fields.
    width : float
        Of a line [cm].
    """
    from docx.enum.text import WD_TAB_ALIGNMENT, WD_TAB_LEADER
    from docx.shared import Cm, Pt

    lines = []
    for entry in entries:
        name = f"toc {entry.level}"
        line = file.add_paragraph(style=name if any(style.name == name for style in file.styles) else None)
        shape = line.paragraph_format
        shape.space_after, shape.line_spacing, shape.left_indent = Pt(0), 1.0, Cm(_INDENT * (entry.level - 1))
        shape.tab_stops.add_tab_stop(Cm(width), WD_TAB_ALIGNMENT.RIGHT, WD_TAB_LEADER.DOTS)
        lines.append(line)
    start = [
        _in_run(_element("w:fldChar", fldCharType="begin", dirty="true")),
        _in_run(_text("w:instrText", _CONTENTS)),
        _in_run(_element("w:fldChar", fldCharType="separate")),
    ]
    for run in start:
        lines[0]._p.append(run)
    for line, entry in zip(lines, entries, strict=True):
        link = _element("w:hyperlink", anchor=entry.bookmark, history="1")
        link.append(_in_run(_text("w:t", entry.title)))
        link.append(_in_run(_element("w:tab")))
        link.append(_field(f"PAGEREF {entry.bookmark} \\h", ""))
        line._p.append(link)
    lines[-1]._p.append(_in_run(_element("w:fldChar", fldCharType="end")))


def _field(instruction: str, shown: str) -> Any:
    """What Word computes, and what is shown until then."""
    field = _element("w:fldSimple", instr=instruction)
    field.append(_in_run(_text("w:t", shown)))
    return field


def _element(tag: str, /, **attributes: str) -> Any:
    """An element of Word with attributes of its own namespace."""
    from docx.oxml import OxmlElement
    from docx.oxml.ns import qn

    made = OxmlElement(tag)
    for key, value in attributes.items():
        made.set(qn(f"w:{key}"), value)
    return made


def _text(name: str, words: str) -> Any:
    made = _element(name)
    made.text = words
    return made


def _in_run(element: Any) -> Any:
    run = _element("w:r")
    run.append(element)
    return run
