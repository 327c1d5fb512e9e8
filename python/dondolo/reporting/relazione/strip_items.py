"""Steps of the check of a strip with loads, thrusts and ties at its height: levers of its items at d_0* and at d_C.

The lower block turns by θ about the hinge at the base, the upper one by φ about that between them, so that the hinge on
top keeps its place sideways. Steps are shown only if they give the numbers of the check.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any, NamedTuple

from dondolo._fortran.checks import CalculationItem
from dondolo.reporting.blocks import Block, CaptionedTable, Formula, Fraction, Root, symbol_of
from dondolo.reporting.content import Piece, Symbol, Table
from dondolo.reporting.numerals import Numeral
from dondolo.reporting.relazione.document import Document, _
from dondolo.reporting.relazione.formulas import FIGURES
from dondolo.reporting.relazione.subjects import Subject
from dondolo.reporting.relazione.sums import is_held
from dondolo.reporting.units import UNITS, Unit, cell
from dondolo.walls.mechanisms import TwoBlockWall
from dondolo.walls.parts import parts_of

_SAME = 1e-9
# Fields of a wall with the parts that items are of
_PARTS = {"load": "loads", "mass": "inertial_masses", "thrust": "thrusts", "tie": "ties"}


class Moved(NamedTuple):
    """A strip at a displacement.

    Attributes
    ----------
    name : Piece
    d : float
        Of the equivalent oscillator [m].
    lower, upper, ratio : float
        Rotations of the blocks [rad], and d upper/d lower.
    across, up : tuple of float
        Displacements of the items outwards and upwards for a unit of rotation of the lower block [m].
    weights, thrusts, ties, moving : float
        ΣP d_y, ΣH d_x, ΣT d_x and Σ(P + Q) d_x [N m/m].
    """

    name: Piece
    d: float
    lower: float
    upper: float
    ratio: float
    across: tuple[float, ...]
    up: tuple[float, ...]
    weights: float
    thrusts: float
    ties: float
    moving: float

    def multiplier(self, *, with_ties: bool) -> float:
        """Its multiplier."""
        return (self.weights - self.thrusts + (self.ties if with_ties else 0.0)) / self.moving


def _place(wall: TwoBlockWall, item: CalculationItem) -> tuple[float, float]:
    """Where an item is: outwards from the middle line, and above the base [m]."""
    if item.item in ("lower block", "upper block"):
        return 0.0, 0.5 * wall.height * (wall.hinge + (item.item == "upper block"))
    if item.item == "load on top":
        return wall.eccentricity or 0.0, wall.height
    word, _blank, count = item.item.rpartition(" ")
    return 0.5 * wall.thickness - item.depth, parts_of(wall, _PARTS[word])[int(count) - 1].height


def moved_strip(wall: TwoBlockWall, items: Sequence[CalculationItem], name: Piece, d: float) -> Moved:
    """The strip where the equivalent oscillator has moved by d."""
    w, joint, above = items[0].arm, wall.hinge * wall.height, (1.0 - wall.hinge) * wall.height
    first, second = (math.fsum(x for one in items if not math.isnan(x := getattr(one, of)))
                     for of in ("force_lever", "force_lever2"))  # fmt: skip
    radius = math.hypot(w, 0.5 * joint)
    q = math.atan2(w, 0.5 * joint) - math.asin((w - 0.5 * joint * d * first / second) / radius)
    sin, cos = math.sin(q), math.cos(q)
    reach = math.hypot(2.0 * w, above)
    p = math.acos((2.0 * w * cos - joint * sin) / reach) - math.acos(2.0 * w / reach)
    along, rise = joint * cos + 2.0 * w * sin, 2.0 * w * cos - joint * sin
    ratio = along / (2.0 * w * math.sin(p) + above * math.cos(p))
    across, up = [], []
    for item in items:
        x, z = _place(wall, item)
        if z > joint:
            x, z = x + w, z - joint
            across.append(along - ratio * (x * math.sin(p) + z * math.cos(p)))
            up.append(rise + ratio * (x * math.cos(p) - z * math.sin(p)))
        else:
            across.append(z * cos + (w - x) * sin)
            up.append((w - x) * cos - z * sin)
    sums = {"weights": 0.0, "thrusts": 0.0, "ties": 0.0, "moving": 0.0}
    for item, out, lift in zip(items, across, up, strict=True):
        if is_held(item):
            sums["ties"] += item.force * out
        elif not math.isnan(item.overturning):
            sums["thrusts"] += item.force * out
        elif not math.isnan(item.stabilising):
            sums["weights"] += item.force * lift
        if item.lever and not math.isnan(item.force_lever):
            sums["moving"] += item.force_lever / item.lever * out
    return Moved(name, d, q, p, ratio, tuple(across), tuple(up), **sums)


def strip_of_items(document: Document, one: Subject) -> list[Block]:
    """The strip at d_0* and at d_C of SLV and SLC, and its multipliers; nothing if they are not those of the check."""
    wall, items, check = one.checked, one.check.items, one.check
    assert isinstance(wall, TwoBlockWall)
    if not one.has_ratios:
        return []
    factor, ratio = (check.value("mechanism", "SLV", name) for name in ("knowledge_factor", "mass_ratio"))
    states: list[tuple[Piece, float, float]] = [(symbol_of("d_0*"), check.value("mechanism", "SLV", "d_0"), 0.0)]
    for state in ("SLV", "SLC"):
        d, a = (check.value("nonlinear", state, name) for name in ("displacement", "acceleration"))
        states.append(((symbol_of("d_C"), f", {state}"), d, a * ratio * factor / wall.gravity))
    found: list[tuple[Moved, bool]] = []
    for name, d, expected in states:
        moved = moved_strip(wall, items, name, d)
        # d_0* is that without ties; at d_C they hold, or all have broken
        held = next(
            (kept for kept in ((True, False) if found else (False,))
             if math.isclose(moved.multiplier(with_ties=kept), expected, rel_tol=_SAME, abs_tol=1e-6)), None,
        )  # fmt: skip
        if held is None:
            return []
        found.append((moved, held and moved.ties > 0.0))
    return [*_geometry(document, [moved for moved, _held in found], items[0].arm), *_multipliers(found),
            _levers(document, wall, items, [moved for moved, _held in found])]  # fmt: skip


def _shown(value: float, unit: Unit = UNITS[""]) -> Numeral:
    return cell(value, unit, FIGURES)


def _geometry(document: Document, found: Sequence[Moved], w: float) -> list[Block]:
    """Rotations of the blocks, and what displacements follow from them."""
    theta, phi, ratio, along, rise = Symbol("θ"), Symbol("φ"), symbol_of("K"), Symbol("X", "M"), Symbol("Y", "M")
    words = _(
        "With the strip displaced by {d} the lower block has turned by {theta} and the upper one by {phi}, {k} ="
        " d{phi}/d{theta}; {w} = {half} m, {x} is the distance of an item from the middle line, outwards, {z} its"
        " height, and {above} that above the hinge. Below the hinge an item moves by {first} and {second} for a unit of"
        " {theta}, above it by {third} and {fourth}, with the velocities of the hinge {xm} and {ym}:"
    )
    x, z, sin, cos = symbol_of("x"), symbol_of("z"), ("sin ", theta), ("cos ", theta)
    out, lift, w_of, joint = symbol_of("d_x"), symbol_of("d_y"), symbol_of("w"), ("r ", symbol_of("H"))
    above = Symbol("ζ")
    values: dict[str, Any] = {
        "d": symbol_of("d"), "theta": theta, "phi": phi, "k": ratio, "w": w_of, "half": _shown(w), "x": x, "z": z,
        "above": (above, " = ", z, " - ", *joint),
        "first": (out, " = ", z, " ", *cos, " + (", w_of, " - ", x, ") ", *sin),
        "second": (lift, " = (", w_of, " - ", x, ") ", *cos, " - ", z, " ", *sin),
        "third": (out, " = ", along, " - ", ratio, " [(", x, " + ", w_of, ") sin ", phi, " + ", above, " cos ", phi,
                  "]"),
        "fourth": (lift, " = ", rise, " + ", ratio, " [(", x, " + ", w_of, ") cos ", phi, " - ", above, " sin ", phi,
                   "]"),
        "xm": (along, " = ", *joint, " ", *cos, " + 2 ", w_of, " ", *sin),
        "ym": (rise, " = 2 ", w_of, " ", *cos, " - ", *joint, " ", *sin),
    }  # fmt: skip
    rows: list[tuple[Piece, list[Numeral]]] = [
        ((symbol_of("d"), " [m]"), [_shown(one.d) for one in found]),
        ((theta, " [rad]"), [_shown(one.lower) for one in found]),
        ((phi, " [rad]"), [_shown(one.upper) for one in found]),
        (ratio, [_shown(one.ratio) for one in found]),
    ]
    columns: dict[Piece, Any] = {document.text(_("quantity")): [head for head, _values in rows]}
    for place, one in enumerate(found):
        columns[one.name] = [numbers[place] for _head, numbers in rows]
    caption = document.text(_("Rotations of the strip."))
    # What holds at rest of the items has its sums in the table of the calculation
    half, reach = Fraction(joint, "2"), Symbol("R")
    first, second = (("Σ(", symbol_of("P"), " + ", symbol_of("Q"), ") ", out, power) for power in ("", "²"))
    return [
        document.say(words, **values),
        Formula(((half, " ", *sin, " + ", w_of, " (1 - ", *cos, ")"),
                 (symbol_of("d"), " ", half, " ", Fraction(first, second)))),
        Formula((reach, Root(("4 ", w_of, "² + (1 - r)² ", symbol_of("H"), "²")))),
        Formula((phi, ("arccos ", Fraction(("2 ", w_of, " ", *cos, " - ", *joint, " ", *sin), reach), " - arccos ",
                       Fraction(("2 ", w_of), reach)))),
        CaptionedTable(Table.of(columns), caption),
    ]  # fmt: skip


def _multipliers(found: Sequence[tuple[Moved, bool]]) -> list[Block]:
    """The multiplier in symbols and, at each displacement, in numbers."""
    moment = UNITS["N m/m"]
    out, lift = symbol_of("d_x"), symbol_of("d_y")

    def total(force: str, lever: Piece) -> tuple[Any, ...]:
        return ("Σ", symbol_of(force), " ", lever)

    bottom = ("Σ(", symbol_of("P"), " + ", symbol_of("Q"), ") ", out)
    top = (*total("P", lift), " - ", *total("H", out), " + ", *total("T", out))
    blocks: list[Block] = [Formula((symbol_of("alpha"), Fraction(top, bottom)))]
    for one, held in found[1:]:
        numbers = (_shown(one.weights, moment), " - ", _shown(one.thrusts, moment), " + ",
                   _shown(one.ties if held else 0.0, moment))  # fmt: skip
        value = _shown(one.multiplier(with_ties=held))
        blocks.append(Formula((("α(", one.name, ")"), Fraction(numbers, _shown(one.moving, moment)), value)))  # noqa: RUF001
    return blocks


def _levers(
    document: Document, wall: TwoBlockWall, items: Sequence[CalculationItem], found: Sequence[Moved]
) -> CaptionedTable:
    """Where each item is, and how it moves at each displacement."""
    places = [_place(wall, item) for item in items]
    columns: dict[Piece, Any] = {
        document.text(_("item")): [document.item(item.item) for item in items],
        (symbol_of("x"), " [m]"): [_shown(x) for x, _z in places],
        (symbol_of("z"), " [m]"): [_shown(z) for _x, z in places],
    }
    for one in found:
        columns[(symbol_of("d_y"), " [m], ", one.name)] = [_shown(value) for value in one.up]
        columns[(symbol_of("d_x"), " [m], ", one.name)] = [_shown(value) for value in one.across]
    caption = document.text(_("Displacements of the items for a unit of rotation of the lower block."))
    return CaptionedTable(Table.of(columns), caption)
