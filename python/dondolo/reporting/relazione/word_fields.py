"""Fields of a file of Word, which Word keeps up to date: numbers of pages, tables and figures, and the contents."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

# Chapters and their parts, with links, from the styles of headings
_CONTENTS = 'TOC \\o "1-2" \\h \\z \\u'


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
    field = _element("w:fldSimple", instr=instruction)
    run, text = _element("w:r"), _element("w:t")
    text.text = shown
    run.append(text)
    field.append(run)
    paragraph._p.append(field)


def add_contents(file: Any, chapters: Sequence[str]) -> None:
    """The table of contents, at the end of a file as it is written: Word sets the pages when it opens the file.

    Parameters
    ----------
    file : Document
        Of python-docx.
    chapters : sequence of str
        Titles that are shown until then, and by programs that do not update fields.
    """
    lines = [file.add_paragraph() for _chapter in chapters]
    for line in lines:
        line.paragraph_format.space_after = 0
    start = [
        _in_run(_element("w:fldChar", fldCharType="begin", dirty="true")),
        _in_run(_text("w:instrText", _CONTENTS)),
        _in_run(_element("w:fldChar", fldCharType="separate")),
    ]
    for run in start:
        lines[0]._p.append(run)
    for line, title in zip(lines, chapters, strict=True):
        line.add_run(title)
    lines[-1]._p.append(_in_run(_element("w:fldChar", fldCharType="end")))


def _element(name: str, **attributes: str) -> Any:
    """An element of Word with attributes of its own namespace."""
    from docx.oxml import OxmlElement
    from docx.oxml.ns import qn

    made = OxmlElement(name)
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
