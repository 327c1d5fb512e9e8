"""What has a name in the words of the language in force: columns, cells, items of a calculation, warnings.

Names are those of docs/files.md, and their words are in the catalogues, under what each is the name of. What a user has
named, identifiers of a case and formulas are not translated; a warning is worded from its numbers.
"""

from __future__ import annotations

import re
from collections import defaultdict

from dondolo._base.wording import named, say
from dondolo.errors import DondoloWarning
from dondolo.reporting.language import Language
from dondolo.reporting.numerals import number

# Units that names of columns end with
UNITS = {
    "_kg_m3": "kg/m³",
    "_m_s2": "m/s²",
    "_nm2_m": "N m²/m",
    "_nm_m": "N m/m",
    "_n_m": "N/m",
    "_nm2": "N m²",
    "_nm": "N m",
    "_m2_m": "m²/m",
    "_j_m": "J/m",
    "_kg_m": "kg/m",
    "_rad_s": "rad/s",
    "_1_s2": "1/s²",
    "_rad": "rad",
    "_pa": "Pa",
    "_deg": "°",
    "_kg": "kg",
    "_km": "km",
    "_m": "m",
    "_n": "N",
    "_s": "s",
    "_g": "g",
}
# Code of the warning of strips that bend before they open, of which no check of rigid blocks makes a green verdict
BENDING = "bending_neglected"
_PART = re.compile(r"^([a-z]+?)(\d+)(_.*)?$")


def heading(name: str) -> str:
    """The head of a column: its words, the number of the part that it is of, and its unit."""

    def words_of(plain: str) -> str:
        return named("head of a column", plain, "")

    found = None if words_of(name) else _PART.match(name)
    place, plain = (f" {found[2]}", f"{found[1]}{found[3] or ''}") if found else ("", name)
    if words := words_of(plain):
        return words + place
    for ending, unit in UNITS.items():
        if plain.endswith(ending) and (words := words_of(plain.removesuffix(ending))):
            return f"{words}{place} [{unit}]"
    return name


def in_words(column: str, value: str) -> str:
    """A cell of a column of words."""
    if column == "item":
        return item_in_words(value)
    found = _PART.match(column)
    return named(f"{found[1]}{found[3] or ''}" if found else column.removeprefix("independent_"), value)


def item_in_words(name: str, what: str = "item") -> str:
    """An item of a calculation, such as 'load 1'."""
    kind, _, place = name.partition(" ")
    words = named(what, name, "")
    return words or f"{named(what, kind)} {place}".strip()


def the_item_in_words(name: str) -> str:
    """An item within a sentence: in Italian with its article."""
    return item_in_words(name, "item with its article")


def warning(language: Language, found: DondoloWarning) -> str:
    """A warning from its numbers."""
    if language.code == "en":
        return str(found)
    with language.in_force():
        values = defaultdict(lambda: "\N{EN DASH}", found.subject)
        values["per"] = "" if found.subject.get("of") == "whole" else "/m"
        if "item" in found.subject:
            name = found.subject["item"]
            values |= {"item": item_in_words(name), "the_item": the_item_in_words(name)}
        # Documents have forces in kN and kN/m, results in N and N/m.
        numbers = {name: 1e-3 * value if "_force" in name else value for name, value in found.numbers.items()}
        values |= {name: language.plain(number(value)) for name, value in numbers.items()}
        unknown = say("warning {code} (see the file of the results)", code=found.code)
        return named("warning", found.code, unknown).format_map(values)
