"""Formulas in Office's own notation (OMML)."""

from __future__ import annotations

from typing import Any

from dondolo.reporting.blocks import Formula, Fraction, Root
from dondolo.reporting.content import Symbol
from dondolo.reporting.language import Language
from dondolo.reporting.numerals import Numeral


def formula_of(block: Formula, language: Language) -> Any:
    """The element of a formula, which stands in a paragraph of its own.

    Parameters
    ----------
    block : Formula
        Its sides and its place in the code.
    language : Language
        Of the document.
    """
    from docx.oxml import OxmlElement

    made = OxmlElement("m:oMathPara")
    inner = child(made, "m:oMath")
    for place, side in enumerate(block.sides):
        if place:
            _text(inner, " = ")
        _put(inner, side, language)
    if block.place:
        _text(inner, f"\N{EM SPACE}({block.place})", upright=True)
    return made


def child(parent: Any, name: str) -> Any:
    """A new element at the end of another."""
    from docx.oxml import OxmlElement

    made = OxmlElement(name)
    parent.append(made)
    return made


def _put(parent: Any, part: Any, language: Language) -> None:
    """A part of a formula."""
    if isinstance(part, tuple):
        for one in part:
            _put(parent, one, language)
    elif isinstance(part, Fraction):
        made = child(parent, "m:f")
        _put(child(made, "m:num"), part.top, language)
        _put(child(made, "m:den"), part.bottom, language)
    elif isinstance(part, Root):
        made = child(parent, "m:rad")
        _value(child(child(made, "m:radPr"), "m:degHide"), "1")
        child(made, "m:deg")
        _put(child(made, "m:e"), part.inside, language)
    elif isinstance(part, Symbol):
        _symbol(parent, part, language)
    elif isinstance(part, Numeral):
        _text(parent, language.decimal(part.text), upright=True)
        if part.power:
            made = child(parent, "m:sSup")
            _text(child(made, "m:e"), "·10")
            _text(child(made, "m:sup"), part.power)
        if part.unit:
            _text(parent, part.unit, upright=True)
    else:
        _text(parent, part.replace(" · ", "\N{THIN SPACE}·\N{THIN SPACE}"), upright=True)


def _symbol(parent: Any, symbol: Symbol, language: Language) -> None:
    """A letter with what is below and above it."""
    kind = {(True, True): "m:sSubSup", (True, False): "m:sSub", (False, True): "m:sSup"}
    name = kind.get((bool(symbol.index), bool(symbol.mark)))
    if name is None:
        _text(parent, symbol.letter)
        return
    made = child(parent, name)
    _text(child(made, "m:e"), symbol.letter)
    if symbol.index:
        _text(child(made, "m:sub"), language.text(symbol.index), upright=True)
    if symbol.mark:
        _text(child(made, "m:sup"), symbol.mark, upright=True)


def _value(element: Any, value: str) -> None:
    from docx.oxml.ns import qn

    element.set(qn("m:val"), value)


def _text(parent: Any, text: str, *, upright: bool = False) -> None:
    """Characters of a formula."""
    run = child(parent, "m:r")
    if upright:
        # Text, not operators: LibreOffice takes a star for a product that lacks a factor.
        child(child(run, "m:rPr"), "m:nor")
    made = child(run, "m:t")
    made.text = text
    made.set("{http://www.w3.org/XML/1998/namespace}space", "preserve")
