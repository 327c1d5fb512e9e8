"""Chapter 4 of a calculation report: every strength that it uses, with its factor, its field and its origin."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from typing import Any

from dondolo._base.arguments import argument_error
from dondolo.reporting.blocks import Block, CaptionedTable, Facts, Heading, Note, symbol_of
from dondolo.reporting.content import Piece, Table
from dondolo.reporting.numerals import NONE, number
from dondolo.reporting.relazione.document import Document, _
from dondolo.reporting.relazione.subjects import Subject
from dondolo.reporting.relazione.sums import of_tie, sums_of
from dondolo.reporting.units import CENTIMETRES, UNITS, Unit, cell, quantity
from dondolo.walls.chains import Chain
from dondolo.walls.mechanisms import Corner
from dondolo.walls.ties import ties_of
from dondolo.walls.wall import MasonryWall

# Partial factor of the masonry in seismic checks (Circolare, C8.7.1), of the strengths at plates
_GAMMA = "gamma_M"


def materials(document: Document) -> list[Block]:
    """Chapter 4."""
    several = document.subjects.several
    for one in several:
        _check_level(document.project.words.get("knowledge_level", ""), one)
    level = document.word("knowledge_level", _("level of knowledge: LC1, LC2 or LC3"))
    rows = [*_masonry(document), *_at_plates(document), *_steel(document)]
    columns: dict[Piece, Sequence[Piece]] = {
        document.text(_("property")): [head for head, _field, _cells in rows],
        document.text(_("field")): [field for _head, field, _cells in rows],
    }
    for place, name in enumerate(document.names):
        columns[name] = [cells[place] for _head, _field, cells in rows]
    blocks: list[Block] = [
        Heading(document.text(_("Materials and level of knowledge"))),
        Facts(((document.text(_("Level of knowledge")), level),)),
        CaptionedTable(
            Table.of(columns, (document.text(_("field")),)),
            document.text(_("Masonry, ties and their factors, with the fields of the data that they come from.")),
        ),
        document.say(
            _(
                "All values are assumed by the designer, but for those marked as default, which are dondolo's for"
                " fields left out. The confidence factor of the check divides the capacity (Circolare,"
                " C8.7.1.2.1.3)."
            )
        ),
        *_hinge(document),
        *_factors(document),
    ]
    return blocks + document.written("tests", _("tests and inspections, and the strengths that follow from them"))


_Row = tuple[Piece, str, list[Piece]]


def _masonry(document: Document) -> list[_Row]:
    """Of the wall itself."""
    several = document.subjects.several
    walls = [one.wall for one in several]
    densities = [_densities(one) if isinstance(one, Chain) else number(getattr(one, "density", None)) for one in walls]
    strengths = [getattr(wall, "compressive_strength", None) for wall in walls]
    factors = [one.check.value("mechanism", "SLV", "knowledge_factor") for one in several]
    rows: list[_Row] = [
        (document.text(_("density [kg/m³]")), "density", densities),
        (
            (document.text(_("mean compressive strength at the hinge")), " ", symbol_of("f_m"), " [MPa]"),
            "compressive_strength",
            [cell(one, UNITS["Pa"]) if one else NONE for one in strengths],
        ),
        (
            (document.text(_("depth of the hinge")), " ", symbol_of("u"), " [cm]"),
            "hinge_depth",
            [
                NONE if isinstance(one, Chain) else cell(getattr(one, "base_hinge_depth", None), CENTIMETRES)
                for one in walls
            ],
        ),
    ]
    if any(strengths):
        rows[-1] = (rows[-1][0], "compressive_strength", rows[-1][2])
    given = [one.check._given_factor for one in several]
    if given != factors:
        known = document.text(_("confidence factor FC of the level of knowledge"))
        rows.append((known, "knowledge_factor", [*map(number, given)]))
    # That of the check is the one that was given, or follows from it
    field = "knowledge_factor" if given == factors else ""
    return [*rows, (document.text(_("confidence factor FC of the check")), field, [*map(number, factors)])]


def _densities(wall: Chain) -> Piece:
    """Densities of the parts of a chain, from the least; a dash if its masses are given."""
    found = sorted({float(row[4]) for row in wall._rows("body_table") if row[4] > 0.0})
    return tuple(piece for density in found for piece in ("; ", number(density)))[1:] or NONE


def _marked(document: Document, value: Piece, *, is_default: bool) -> Piece:
    """A value, marked if it is a default."""
    return (value, f" ({document.text(_('default'))})") if is_default else value


def _plate_of(one: Subject) -> str:
    """The first tie whose anchor is computed from its plate; '' for none."""
    return next((row.item for row in one.check.rows if row.quantity == "anchor_knowledge"), "")


def _at_plates(document: Document) -> list[_Row]:
    """Of the masonry at the plates of ties, if there are any."""
    several = document.subjects.several
    if not any(map(_plate_of, several)):
        return []
    fields: tuple[tuple[str, Any, Unit | None], ...] = (
        ("masonry_compression", (document.text(_("mean compressive strength at the plates")), " ", symbol_of("f_m")),
         UNITS["Pa"]),
        ("masonry_shear", (document.text(_("mean shear strength without compression")), " ", symbol_of("f_v0")),
         UNITS["Pa"]),
        ("masonry_tension", (document.text(_("mean tensile strength")), " ", symbol_of("f_t")), UNITS["Pa"]),
        ("masonry_knowledge_factor", (document.text(_("confidence factor FC at the plates")),), None),
        ("bearing_factor", (document.text(_("bearing strength over compressive strength")), " ", symbol_of("k")), None),
        (_GAMMA, (document.text(_("partial factor of the masonry (Circolare, C8.7.1)")), " ", symbol_of(_GAMMA)), None),
    )  # fmt: skip
    rows: list[_Row] = []
    for field, head, unit in fields:
        cells: list[Piece] = []
        for one in several:
            if not _plate_of(one):
                cells.append(NONE)
                continue
            value, is_default = _of_plates(one, field)
            cells.append(_marked(document, cell(value, unit or UNITS[""]), is_default=is_default))
        rows.append(((*head, " [MPa]") if unit else head, NONE.text if field == _GAMMA else field, cells))
    frictions = [getattr(one.wall, "masonry_friction", None) for one in several]
    if any(frictions):
        head = (document.text(_("coefficient of friction at the plates")), " ", symbol_of("mu"))
        rows.append((head, "masonry_friction", [number(one) if one else NONE for one in frictions]))
    return rows


def _of_plates(one: Subject, field: str) -> tuple[float, bool]:
    """A property of the masonry at the plates, and whether it is a default."""
    check, item, wall = one.check, _plate_of(one), one.wall
    factor = check.value("tie", "", "anchor_knowledge", item=item)
    given = getattr(wall, field, None)
    partial = wall.masonry_shear / (factor * check.value("tie", "", "shear_strength", item=item))  # type: ignore[union-attr]
    if field == _GAMMA:
        return partial, False
    if field == "masonry_knowledge_factor":
        return factor, given is None
    strength = getattr(wall, "masonry_compression", None) or getattr(wall, "compressive_strength", None) or math.nan
    if field == "masonry_compression":
        return strength, False
    if field == "bearing_factor":
        return check.value("tie", "", "bearing_strength", item=item) * factor * partial / strength, given is None
    return float(given or math.nan), False


def _steel(document: Document) -> list[_Row]:
    """Of the ties, if there are any: a number for those that are alike."""
    several = document.subjects.several
    if not any(ties_of(one.wall) for one in several):
        return []
    fields = (
        (
            "strength",
            (document.text(_("design yield stress of bar and plate")), " ", symbol_of("f_yd"), " [MPa]"),
            "Pa",
        ),
        ("modulus", (document.text(_("modulus of elasticity of the ties")), " ", symbol_of("E"), " [MPa]"), "Pa"),
        ("preload", (document.text(_("stress of the ties at rest")), " ", symbol_of("sigma_0"), " [MPa]"), "Pa"),
        ("strain", (document.text(_("ultimate strain of the ties")), " ", symbol_of("ε_u")), ""),
    )
    rows: list[_Row] = []
    for field, head, unit in fields:
        cells: list[Piece] = []
        for one in several:
            ties = ties_of(one.wall)
            values = list(dict.fromkeys(of_tie(tie, field) for tie in ties))
            shown = tuple(piece for value in values for piece in ("; ", cell(value, UNITS[unit])))[1:]
            is_default = all(getattr(tie, field) is None for tie in ties)
            cells.append(_marked(document, shown, is_default=is_default) if ties else NONE)
        rows.append((head, f"tie_{field}", cells))
    return rows


def _hinge(document: Document) -> list[Block]:
    """That the depth of the hinge takes the mean strength, and what the confidence factor would make of it."""
    made: list[Any] = []
    for name, one in document.each():
        factor, sums = one.check.value("mechanism", "SLV", "knowledge_factor"), sums_of(one.check.items)
        if not getattr(one.wall, "compressive_strength", None) or factor <= 1.0 or not one.is_turning:
            continue
        assert isinstance(one.wall, MasonryWall)
        # In proportion to 1/f; of a corner, whose crushed triangle grows to both sides, to its root
        deeper = ((math.sqrt(factor) if isinstance(one.wall, Corner) else factor) - 1.0) * one.wall.base_hinge_depth
        multiplier = sums["alpha_0"] - sums["carried"] * deeper / sums["force_lever"]
        depth = quantity(one.wall.base_hinge_depth + deeper, CENTIMETRES)
        made += ["; ", f"{name}: ", symbol_of("u"), " = ", depth, ", ", symbol_of("alpha_0"), " = ", number(multiplier)]
        made += [f" {document.text(_('instead of'))} ", number(sums["alpha_0"])]
    if not made:
        return []
    words = _(
        "The depth {u} of the hinge takes the mean strength {f}, divided neither by FC nor by a partial factor, because"
        " FC divides the capacity as a whole. To divide {f} by FC as well would be on the safe side: {found}."
    )
    return [document.say(words, u=symbol_of("u"), f=symbol_of("f_m"), found=tuple(made[1:]))]


def _factors(document: Document) -> list[Block]:
    """Two confidence factors for one wall need a reason."""
    blocks: list[Block] = []
    for name, one in document.each():
        if not (item := _plate_of(one)):
            continue
        plates = one.check.value("tie", "", "anchor_knowledge", item=item)
        factor = one.check._given_factor
        if plates == factor:
            continue
        words = _(
            "{wall}: two confidence factors, {plates} for the masonry at the plates (field {field}, default {default})"
            " and {factor} for the check. If the level of knowledge is the same, give that field the value of the"
            " check; otherwise give the reason."
        )
        values: dict[str, Any] = {"wall": name, "plates": number(plates), "factor": number(factor)}
        values["default"] = number(1.35)
        blocks.append(Note("doubt", document.say(words, field="masonry_knowledge_factor", **values).pieces))
    return blocks


# Least confidence factors of the levels of knowledge, and their names in a text
_FACTORS = {"LC1": 1.35, "LC2": 1.2, "LC3": 1.0}
_LEVEL = re.compile(r"\bLC\d+\b", re.IGNORECASE)


def _check_level(level: str, one: Subject) -> None:
    """Refuse a text that names not one level of knowledge, or one whose confidence factor is above that of a check."""
    if not level:
        return
    named = {found.upper() for found in _LEVEL.findall(level)}
    if len(named) != 1 or not named <= _FACTORS.keys():
        raise argument_error("not_a_word", "knowledge_level", f" = {level!r}: must name one of {', '.join(_FACTORS)}")
    least = _FACTORS[named.pop()]
    factor = one.check._given_factor
    if factor < least:
        raise argument_error(
            "not_together",
            "knowledge_level",
            f" = {level!r}: asks for a confidence factor of {least:g}, but wall '{one.wall.name}' is given {factor:g}",
        )
