"""Chapters 10 and 11 of a calculation report: the mechanism, and the checks with their numbers."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

from dondolo._fortran.checks import CalculationItem, SheetRow, ntc_parameters
from dondolo.checks.ntc import CodeCheck
from dondolo.reporting.blocks import (
    Block,
    CaptionedTable,
    Formula,
    Fraction,
    Heading,
    Picture,
    Root,
    symbol_of,
)
from dondolo.reporting.content import Piece, Table
from dondolo.reporting.numerals import NONE, number, whole
from dondolo.reporting.relazione.capacity import FIGURES, capacity_of, end_of, shown
from dondolo.reporting.relazione.document import Document, _
from dondolo.reporting.relazione.drawings import draw_capacity, draw_wall
from dondolo.reporting.relazione.subjects import Subject
from dondolo.reporting.units import CENTIMETRES, UNITS, Unit, cell
from dondolo.walls.mechanisms import TwoBlockWall

# Displacements of the sheet, which are small
_LENGTHS = (
    "d_0", "tie_fracture", "displacement", "demand", "mean_displacement", "bar", "plate_width", "plate_height",
    "plate_diameter", "plate_thickness", "plate_needed", "masonry_thickness", "edge_distance",
)  # fmt: skip
_COUNTS = ("records", "histories", "beyond")
# What is 1 or 0
_FLAGS = ("extrapolated", "hierarchy", "plate_verified", "anchor_checked")
# Factors of the period, and damping [%], of the nonlinear checks
_PERIODS = {"SLV": (1.68, 8.0), "SLC": (1.56, 10.0)}


def mechanism(document: Document) -> list[Block]:
    """Chapter 10."""
    blocks: list[Block] = [Heading(document.text(_("Scheme of the mechanism")))]
    for name, one in document.each():
        blocks.append(
            Picture(
                lambda one=one: draw_wall(document, one),  # type: ignore[misc]
                document.titled(document.text(_("Loads, hinge and reactions, and the mechanism displaced")), name),
                document.text(_("The wall at rest with its loads, and displaced about its hinge.")),
            )
        )
    return [*blocks, *_reactions(document)]


def sums_of(items: Sequence[CalculationItem]) -> dict[str, float]:
    """Sums of the items: moments, weights times levers, weight, and horizontal forces outwards."""
    names = ("stabilising", "overturning", "force_lever", "force_lever2")
    found = {name: math.fsum(x for item in items if not math.isnan(x := getattr(item, name))) for name in names}
    weights = [one.force for one in items if not math.isnan(one.force_lever) and one.item != "masonry"]
    found["weight"] = math.fsum(weights)
    # What rests on the hinge: masses that are pushed do not
    found["carried"] = math.fsum(one.force for one in items if not math.isnan(one.arm) and one.item != "masonry"
                                 and not math.isnan(one.stabilising))  # fmt: skip
    found["thrust"] = math.fsum(one.force for one in items if not math.isnan(one.overturning))
    found["held"] = math.fsum(one.force for one in items if _is_tie(one))
    found["alpha_0"] = (found["stabilising"] - found["overturning"]) / found["force_lever"]
    return found


def _is_tie(item: CalculationItem) -> bool:
    return item.item.startswith(("tie", "friction"))


def _reactions(document: Document) -> list[Block]:
    """Reactions at the hinge of walls that turn about their base."""
    several = [(name, one) for name, one in document.each() if not isinstance(one.wall, TwoBlockWall)]
    if not several:
        return []
    unit = UNITS["N/m"]
    columns: dict[Piece, Sequence[Piece]] = {
        document.text(_("reaction at the hinge [kN/m]")): [
            document.text(_("vertical, V = ΣP")),
            document.text(_("horizontal without earthquake, outwards, ΣH - ΣT")),
            document.text(_("horizontal at activation, outwards, ΣH + α₀ Σ(P + Q) - ΣT")),
        ]
    }
    for name, one in several:
        sums = sums_of(one.check.items)
        rest = sums["thrust"] - sums["held"]
        moved = rest + sums["alpha_0"] * sums["weight"]
        columns[name] = [cell(value, unit, 5) for value in (sums["carried"], rest, moved)]
    return [
        CaptionedTable(
            Table.of(columns), document.text(_("Horizontal forces that the base holds, and its vertical reaction."))
        )
    ]


def checks(document: Document) -> list[Block]:
    """Chapter 11."""
    blocks: list[Block] = [Heading(document.text(_("Checks at SLD, SLV and SLC")))]
    for name, one in document.each():
        if len(document.names) > 1:
            blocks.append(Heading(name, 2))
        blocks += [_items(document, one, name), *_formulas(document, one)]
        blocks.append(
            Picture(
                lambda one=one: draw_capacity(document, one),  # type: ignore[misc]
                document.titled(
                    document.text(_("Capacity curve, and the demand of SLV (damping 8 %) and SLC (10 %)")), name
                ),
                document.text(_("Spectral acceleration against displacement: capacity and demand.")),
            )
        )
    if len(document.names) > 1:
        blocks.append(Heading(document.text(_("Numbers of all walls")), 2))
    blocks.append(_sheet(document))
    period = max(
        one.check.value("nonlinear", state, "period") for one in document.subjects.several for state in _PERIODS
    )
    blocks.append(
        document.say(
            _(
                "Beyond {te} of NTC 3.2.3.2.3, which depends on the soil, displacements of the spectrum fall;"
                " here they stay"
                " constant, on the safe side. The longest period of these checks is {period}."
            ),
            te=symbol_of("T_E"),
            period=number(period, 4, " s"),
        )
    )
    return blocks


def _items(document: Document, one: Subject, name: str) -> CaptionedTable:
    """The items with their sums, so that the multiplier can be made again by hand."""
    items, strip = one.check.items, isinstance(one.wall, TwoBlockWall)
    force, moment, second = UNITS["N/m"], UNITS["N m/m"], UNITS["N m2/m"]

    def column(field: str, unit: Unit, figures: int = FIGURES) -> list[Piece]:
        values = [getattr(item, field) for item in items]
        return ["" if math.isnan(value) else cell(value, unit, figures) for value in values]

    sums = sums_of(items)
    lever, arm = ("d_x", "d_y") if strip else ("z", "e")
    columns: dict[Piece, list[Piece]] = {document.text(_("item")): [document.item(item.item) for item in items]}
    columns[(symbol_of("P"), ", ", symbol_of("H"), ", ", symbol_of("T"), " [kN/m]")] = column("force", force)
    if not strip:
        columns[(symbol_of("d"), " [m]")] = column("depth", UNITS["m"])
    columns[(symbol_of(arm), " [m]")] = column("arm", UNITS["m"])
    columns[(symbol_of(lever), " [m]")] = column("lever", UNITS["m"])
    stab, over = document.text(_("stabilising [kNm/m]")), document.text(_("overturning [kNm/m]"))
    columns[stab] = column("stabilising", moment)
    if not strip:
        columns[over] = column("overturning", moment)
    product = (symbol_of("P"), " ", symbol_of(lever), " [kNm/m]")
    square = (symbol_of("P"), " ", symbol_of(lever), "² [kNm²/m]")
    columns[product] = column("force_lever", moment)
    columns[square] = column("force_lever2", second)
    ends: dict[Piece, Piece] = {
        stab: cell(sums["stabilising"], moment, FIGURES),
        over: cell(sums["overturning"], moment, FIGURES),
        product: cell(sums["force_lever"], moment, FIGURES),
        square: cell(sums["force_lever2"], second, FIGURES),
    }
    for place, (head, cells) in enumerate(columns.items()):
        cells.append(document.text(_("sum")) if not place else ends.get(head, ""))
    caption = document.titled(document.text(_("Calculation of the multiplier, item by item, per metre of wall")), name)
    return CaptionedTable(Table.of(columns), caption, strong=1)  # type: ignore[arg-type]


def _formulas(document: Document, one: Subject) -> list[Block]:
    """The steps from the sums to the safety index, with the numbers put in."""
    check, wall = one.check, one.wall
    sums = sums_of(check.items)
    lever = "d_x" if isinstance(wall, TwoBlockWall) else "z"
    moment, second = UNITS["N m/m"], UNITS["N m2/m"]
    total, top = ("Σ", symbol_of("P"), " ", symbol_of(lever)), (symbol_of("M_stab"), " - ", symbol_of("M_rib"))
    factor = check.value("mechanism", "SLV", "knowledge_factor")
    alpha, mass, ratio, a0 = (
        check.value("mechanism", "SLV", name) for name in ("alpha_0", "mass", "mass_ratio", "a_0")
    )
    g = shown(wall.gravity)
    along = shown(sums["force_lever"], moment)
    blocks: list[Block] = [
        Formula(
            (
                (symbol_of("alpha_0")),
                Fraction(top, total),
                Fraction((shown(sums["stabilising"], moment), " - ", shown(sums["overturning"], moment)), along),
                shown(alpha),
            )
        )
    ]
    blocks.append(
        Formula(
            (
                symbol_of("M*"),
                Fraction(("(", *total, ")²"), (symbol_of("g"), " Σ", symbol_of("P"), " ", symbol_of(lever), "²")),
                Fraction(("(", along, ")²"), (g, " · ", shown(sums["force_lever2"], second))),
                (shown(1e-3 * mass), " t/m"),
            )
        )
    )
    blocks.append(
        Formula(
            (
                symbol_of("e*"),
                Fraction((symbol_of("g"), " ", symbol_of("M*")), ("Σ", symbol_of("P"))),
                Fraction((g, " · ", shown(1e-3 * mass)), shown(wall.gravity * mass / ratio, UNITS["N/m"])),
                shown(ratio),
            )
        )
    )
    blocks.append(
        Formula(
            (
                symbol_of("a_0*"),
                Fraction((symbol_of("alpha_0"), " ", symbol_of("g")), (symbol_of("e*"), " FC")),
                Fraction((shown(alpha), " · ", g), (shown(ratio), " · ", shown(factor))),
                (shown(a0), " m/s²"),
            )
        )
    )
    blocks += end_of(document, one)
    for state in ("SLV", "SLC"):
        blocks += _nonlinear(document, one, state)
    return blocks


def _nonlinear(document: Document, one: Subject, state: str) -> list[Block]:
    """Period, demand and ratio of a nonlinear check, with the numbers put in."""
    check = one.check
    names = ("displacement", "acceleration", "period", "spectral_demand", "demand", "ratio")
    d, a, period, ordinate, demand, ratio = (check.value("nonlinear", state, name) for name in names)
    factor, damping = _PERIODS[state]
    g, a0 = one.wall.gravity, check.value("mechanism", state, "a_0")
    blocks: list[Block] = [
        *capacity_of(document, one, state),
        Formula(
            (
                symbol_of(f"T_{state}"),
                (number(factor), " π ", Root(Fraction(symbol_of("d_C"), symbol_of("a(d_C)")))),
                (number(factor), " π ", Root(Fraction(shown(d), shown(a)))),
                (shown(period), " s"),
            )
        ),
    ]
    on_ground = not one.is_on_floor
    if on_ground:
        blocks += _ordinate(one, state, period, damping, ordinate)
    blocks.append(
        Formula(
            (
                symbol_of("d_D"),
                (symbol_of("S_e"), " ", Fraction((symbol_of("T"), "²"), ("4π²"))),
                (shown(ordinate), " · ", shown(g), " · ", Fraction((shown(period), "²"), ("4π²"))),
                (shown(demand), " m"),
            )
        )
    )
    peak = check.value("site", state, "pga" if on_ground else "floor_pga")
    starts = a0 / (g * peak)
    symbol = (symbol_of("a_g S" if on_ground else "a_Z"), " ", symbol_of("g"))
    blocks.append(
        Formula(
            (
                symbol_of("ζ_E"),
                ("max(", Fraction(symbol_of("d_C"), symbol_of("d_D")), "; ", Fraction(symbol_of("a_0*"), symbol), ")"),
                ("max(", shown(d / demand), "; ", shown(starts), ")"),
                shown(ratio),
            )
        )
    )
    return blocks


def _ordinate(one: Subject, state: str, period: float, damping: float, ordinate: float) -> list[Block]:
    """The ordinate of the elastic spectrum of the ground, with the numbers put in."""
    pga, amplified, corners = ntc_parameters(one.check.site._input(), state)
    tb, tc, td = corners.tolist()
    eta = max(math.sqrt(10.0 / (5.0 + damping)), 0.55)
    common = (symbol_of("a_g S"), " η ", symbol_of("F_0"))
    values = (shown(pga), " · ", shown(eta), " · ", shown(amplified))
    t = shown(period)
    if period < tb:
        symbols: Any = (
            symbol_of("a_g S"),
            " [1 + ",
            Fraction(symbol_of("T"), symbol_of("T_B")),
            " (η ",
            symbol_of("F_0"),
            " - 1)]",
        )
        numbers: Any = (
            shown(pga),
            " [1 + ",
            Fraction(t, shown(tb)),
            " (",
            shown(eta),
            " · ",
            shown(amplified),
            " - 1)]",
        )
    elif period < tc:
        symbols, numbers = common, values
    elif period < td:
        symbols = (*common, " ", Fraction(symbol_of("T_C"), symbol_of("T")))
        numbers = (*values, " · ", Fraction(shown(tc), t))
    else:
        symbols = (*common, " ", Fraction((symbol_of("T_C"), " ", symbol_of("T_D")), (symbol_of("T"), "²")))
        numbers = (*values, " · ", Fraction((shown(tc), " · ", shown(td)), (t, "²")))
    result = (shown(ordinate), " g")
    factor = Formula((symbol_of("eta"), Root(Fraction(number(10.0), ("5 + ", symbol_of("xi"), " [%]"))),
                      Root(Fraction(number(10.0), ("5 + ", number(damping)))), shown(eta)))  # fmt: skip
    if tb <= period < td:
        return [factor, Formula((symbol_of("S_e"), symbols, numbers, result))]
    # Symbols and numbers in one line are wider than a page.
    return [factor, Formula((symbol_of("S_e"), symbols)), Formula((symbol_of("S_e"), numbers, result))]


def _sheet(document: Document) -> CaptionedTable:
    """The sheets of all walls beside each other, each number with its place in the norm."""
    rows: dict[tuple[str, str, str], SheetRow] = {}
    for one in document.subjects.several:
        for row in one.check.rows:
            if row.method in ("mechanism", "linear", "nonlinear") and row.quantity != "probability":
                rows.setdefault((row.method, row.limit_state, row.quantity), row)
    # What the first wall has not comes after it
    rows = dict(sorted(rows.items(), key=lambda item: ("mechanism", "linear", "nonlinear").index(item[0][0])))
    columns: dict[Piece, list[Piece]] = {
        document.text(_("quantity")): [document.meaning(row) for row in rows.values()],
        document.text(_("check")): [_check_name(document, row) for row in rows.values()],
        document.text(_("symbol")): [symbol_of(row.symbol) if row.symbol else NONE for row in rows.values()],
    }
    for name, one in document.each():
        known = {(row.method, row.limit_state, row.quantity): row for row in one.check.rows}
        columns[name] = [value_of(document, one.check, known.get(key)) for key in rows]
    columns[document.text(_("unit"))] = [document.unit(unit_of(row).name) for row in rows.values()]
    columns[document.text(_("place"))] = [row.formula for row in rows.values()]
    words = [document.text(word) for word in (_("check"), _("symbol"), _("unit"), _("place"))]
    caption = document.text(_("Numbers of the checks, with their places in NTC 2018 and in the Circolare (C)."))
    return CaptionedTable(Table.of(columns, words), caption)  # type: ignore[arg-type]


def _check_name(document: Document, row: SheetRow) -> str:
    """Method and limit state."""
    return f"{method_name(document, row.method)} {row.limit_state}".strip()


def method_name(document: Document, method: str) -> str:
    """A part of a check in words."""
    names = {
        "mechanism": _("mechanism"),
        "linear": _("linear"),
        "nonlinear": _("nonlinear"),
        "dynamic": _("dynamic"),
        "site": _("site"),
    }
    return document.text(names[method])


def unit_of(row: SheetRow) -> Unit:
    return CENTIMETRES if row.quantity in _LENGTHS else UNITS[row.unit]


def value_of(document: Document, check: CodeCheck, row: SheetRow | None) -> Piece:
    """A number of the sheet, or in words what is one or the other."""
    if row is None or check._is_void(row):
        return NONE
    if row.quantity == "verified":
        return outcome(document, check, (row.method, row.limit_state))
    if row.quantity == "applicable":
        return document.text(_("not applicable"))
    if row.quantity in _FLAGS:
        return document.text(_("yes")) if row.value == 1.0 else document.text(_("no"))
    if row.bound:
        return (f"{row.bound} ", cell(row.value, unit_of(row), 5))
    return whole(row.value) if row.quantity in _COUNTS else cell(row.value, unit_of(row), 5)


def outcome(document: Document, check: CodeCheck, key: tuple[str, str]) -> str:
    """The verdict of a check in words; one that is not for the wall has none."""
    if key in check.not_applicable:
        return document.text(_("not applicable"))
    if not check.verified[key]:
        return document.text(_("NOT satisfied"))
    return document.text(_("satisfied if its ties are")) if check.open_ties else document.text(_("satisfied"))
