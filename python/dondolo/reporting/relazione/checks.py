"""Chapters 10 and 11 of a calculation report: the mechanism, and the checks with their numbers."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any

from dondolo._fortran.checks import SheetRow, ntc_parameters
from dondolo.checks.ntc import CodeCheck
from dondolo.reporting.blocks import (
    Block,
    CaptionedTable,
    Formula,
    Fraction,
    Heading,
    Note,
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
from dondolo.reporting.relazione.sums import Ratios, of_tie, ratios_of, reactions_of, sums_of, turning_of
from dondolo.reporting.units import CENTIMETRES, UNITS, Unit, cell
from dondolo.walls.mechanisms import TwoBlockWall
from dondolo.walls.parts import parts_of

# Displacements of the sheet, which are small
_LENGTHS = (
    "d_0", "tie_fracture", "displacement", "demand", "mean_displacement", "bar", "plate_width", "plate_height",
    "plate_diameter", "plate_thickness", "plate_needed", "masonry_thickness", "edge_distance",
)  # fmt: skip
# What a limit state without a hazard of its own is not to be taken for
_VERDICTS = ("ratio", "zeta_e", "verified")
_COUNTS = ("records", "histories", "beyond")
# What is 1 or 0
_FLAGS = ("extrapolated", "hierarchy", "plate_verified", "anchor_checked")
# Factors of the period, and damping [%], of the nonlinear checks
_PERIODS = {"SLV": (1.68, 8.0), "SLC": (1.56, 10.0)}
# Verdicts of a check as a report of a calculation words them
_OUTCOMES = {
    "verified": _("satisfied"),
    "verified if its ties are": _("satisfied if its ties are"),
    "not verified": _("NOT satisfied"),
    "not applicable": _("not applicable"),
}


def mechanism(document: Document) -> list[Block]:
    """Chapter 10."""
    blocks: list[Block] = [Heading(document.text(_("Scheme of the mechanism")))]
    for name, one in document.each():
        blocks.append(
            Picture(
                lambda one=one: draw_wall(document, one),  # type: ignore[misc]
                document.titled(
                    document.text(
                        _("Loads and hinge; the mechanism displaced, with the reactions of the base at activation")
                    ),
                    name,
                ),
                document.text(_("The wall at rest with its loads, and displaced about its hinge.")),
            )
        )
    return [*blocks, *_reactions(document)]


def _reactions(document: Document) -> list[Block]:
    """Reactions at the hinge of walls that turn about their base."""
    several = [(name, one) for name, one in document.each() if not isinstance(one.wall, TwoBlockWall)]
    if not several:
        return []
    unit = UNITS["N/m"]
    columns: dict[Piece, Sequence[Piece]] = {
        document.text(_("force on the base [kN/m]")): [
            document.text(_("vertical, downwards, ΣP")),
            document.text(_("horizontal without earthquake, outwards, ΣH - Σ σ₀ A")),
            document.text(_("horizontal at activation, outwards, ΣH + α₀ Σ(P + Q) - ΣT")),
        ]
    }
    for name, one in several:
        columns[name] = [cell(value, unit, 5) for value in reactions_of(one)]
    words = _(
        "The reactions V and H of the base on the wall, drawn at activation, are equal and opposite to these forces."
        " Without earthquake a tie has its preload {preload} alone."
    )
    return [
        CaptionedTable(Table.of(columns), document.text(_("Forces that the wall transmits to its base, per metre."))),
        document.say(words, preload=symbol_of("sigma_0")),
    ]


def checks(document: Document) -> list[Block]:
    """Chapter 11."""
    words = _(
        "{zeta} of a nonlinear check is the greater of two ratios, of the displacements {capacity}/{demand} and of the"
        " accelerations {a0}/({peak} {g}): a wall whose mechanism does not start is verified. For SLV it is the"
        " Circolare, C8.7.1.2.1.8, that takes the acceleration of activation (C8.7.1.2.1.5) where the one from the"
        " displacement is less; for SLC, of which it asks for an analogous calculation, the same is assumed."
    )
    peak = "a_Z" if document.subjects.several[0].is_on_floor else "a_g S"
    names = {"zeta": "ζ_E", "capacity": "d_C", "demand": "d_D", "a0": "a_0*", "peak": peak, "g": "g"}
    blocks: list[Block] = [
        Heading(document.text(_("Checks at SLD, SLV and SLC"))),
        document.say(words, **{key: symbol_of(name) for key, name in names.items()}),
    ]
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
    # The masonry as one body has the weight of its sections, which the sum has once.
    counted = f" ({document.text(_('counted above'))})"
    names = [document.item(item.item) + (counted if item.item == "masonry" else "") for item in items]
    columns: dict[Piece, list[Piece]] = {document.text(_("item")): names}  # type: ignore[dict-item]
    forces = (symbol_of("P"), ", ", symbol_of("H"), ", ", symbol_of("T"), " [kN/m]")
    columns[forces] = [
        ("(", value, ")") if item.item == "masonry" else value
        for item, value in zip(items, column("force", force), strict=True)
    ]
    if not strip:
        columns[(symbol_of("d"), " [m]")] = column("depth", UNITS["m"])
    columns[(symbol_of(arm), " [m]")] = column("arm", UNITS["m"])
    if not strip:
        # Thrusts and ties have an arm too, of which their moments change as the wall turns.
        hinge = turning_of(items).hinge
        columns[(symbol_of(arm), " [m]")] = [
            "" if math.isnan(item.depth) else shown(item.depth - hinge, UNITS["m"]) for item in items
        ]
    columns[(symbol_of(lever), " [m]")] = column("lever", UNITS["m"])
    stab, over = document.text(_("stabilising [kNm/m]")), document.text(_("overturning [kNm/m]"))
    columns[stab] = column("stabilising", moment)
    if not strip:
        columns[over] = column("overturning", moment)
    product = (symbol_of("P"), " ", symbol_of(lever), " [kNm/m]")
    square = (symbol_of("P"), " ", symbol_of(lever), "² [kNm²/m]")
    columns[product] = column("force_lever", moment)
    columns[square] = column("force_lever2", second)
    pushes = sums["weight"] > sums["carried"] and not strip
    weights = ("Σ(", symbol_of("P"), " + ", symbol_of("Q"), ") = ") if pushes else ("Σ", symbol_of("P"), " = ")
    ends: dict[Piece, Piece] = {
        forces: (*weights, cell(sums["weight"], force, FIGURES)),
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
    total, top = ("Σ", symbol_of("P"), " ", symbol_of(lever)), (symbol_of("M_stab"), " - ", symbol_of("M_ov"))
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
    governing = ", ".join(f"{state}: {governed(document, ratios_of(one, state))}" for state in ("SLV", "SLC"))
    blocks.append(document.say(_("The ratios are governed by: {what}."), what=governing))
    found = ratios_of(one, "SLV")
    items = [item for item in check.items if item.item.startswith("tie")]
    late = any(
        of_tie(tie, "preload") * tie.section < item.force
        for tie, item in zip(parts_of(wall, "ties"), items, strict=False)
    )
    if found.is_of_activation and late:
        words = _(
            "The activation that governs {zeta} of SLV counts the ties with their full force, which beyond their"
            " preload they have only after the wall has moved. By displacements alone the ratio is {ratio}."
        )
        note = document.say(words, zeta=symbol_of("ζ_E"), ratio=number(found.displacement))
        blocks.append(Note("doubt", note.pieces))
    return blocks


def governed(document: Document, ratios: Ratios) -> str:
    """Which of its two ratios the ratio of a nonlinear check is."""
    return document.text(_("activation") if ratios.is_of_activation else _("displacement"))


def _nonlinear(document: Document, one: Subject, state: str) -> list[Block]:
    """Period, demand and ratio of a nonlinear check, with the numbers put in."""
    check = one.check
    names = ("displacement", "acceleration", "period", "spectral_demand", "demand", "ratio")
    d, a, period, ordinate, demand, ratio = (check.value("nonlinear", state, name) for name in names)
    factor, damping = _PERIODS[state]
    g = one.wall.gravity
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
    found = ratios_of(one, state)
    symbol = (symbol_of("a_g S" if on_ground else "a_Z"), " ", symbol_of("g"))
    blocks.append(
        Formula(
            (
                symbol_of("ζ_E"),
                ("max(", Fraction(symbol_of("d_C"), symbol_of("d_D")), "; ", Fraction(symbol_of("a_0*"), symbol), ")"),
                ("max(", shown(found.displacement), "; ", shown(found.activation), ")"),
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
    sheets = [_sheet_rows(one) for one in document.subjects.several]
    rows: dict[tuple[str, str, str], SheetRow] = {}
    for sheet in sheets:
        for key, row in sheet.items():
            rows.setdefault(key, row)
    # What the first wall has not comes after it
    rows = dict(sorted(rows.items(), key=lambda item: ("mechanism", "linear", "nonlinear").index(item[0][0])))
    columns: dict[Piece, list[Piece]] = {
        document.text(_("quantity")): [
            document.text(_RATIOS[row.quantity]) if row.quantity in _RATIOS else document.meaning(row)
            for row in rows.values()
        ],
        document.text(_("check")): [_check_name(document, row) for row in rows.values()],
        document.text(_("symbol")): [symbol_of(row.symbol) if row.symbol else NONE for row in rows.values()],
    }
    for (name, one), sheet in zip(document.each(), sheets, strict=True):
        columns[name] = [
            governed(document, ratios_of(one, key[1])) if key[2] == "governing"
            else value_of(document, one.check, sheet.get(key))
            for key in rows
        ]  # fmt: skip
    columns[document.text(_("unit"))] = [document.unit(unit_of(row).name) for row in rows.values()]
    columns[document.text(_("place"))] = [row.formula for row in rows.values()]
    words = [document.text(word) for word in (_("check"), _("symbol"), _("unit"), _("place"))]
    caption = document.text(_("Numbers of the checks, with their places in NTC 2018 and in the Circolare (C)."))
    return CaptionedTable(Table.of(columns, words), caption)  # type: ignore[arg-type]


# What the ratio of a nonlinear check is the greater of, and which
_RATIOS = {
    "displacement_ratio": _("ratio of displacements"),
    "activation_ratio": _("ratio at activation"),
    "governing": _("governed by"),
}


def _sheet_rows(one: Subject) -> dict[tuple[str, str, str], SheetRow]:
    """The rows of a sheet that are shown, with the two ratios of each nonlinear check after its demand."""
    rows: dict[tuple[str, str, str], SheetRow] = {}
    for row in one.check.rows:
        if row.method not in ("mechanism", "linear", "nonlinear") or row.quantity == "probability":
            continue
        rows[row.method, row.limit_state, row.quantity] = row
        if (row.method, row.quantity) == ("nonlinear", "demand"):
            found = ratios_of(one, row.limit_state)
            peak = "a_Z" if one.is_on_floor else "a_g S"
            for name, symbol, value in (
                ("displacement_ratio", "d_C/d_D", found.displacement),
                ("activation_ratio", f"a_0*/({peak} g)", found.activation),
                ("governing", "", 0.0),
            ):
                place = "C8.7.1.2.1.8" if row.limit_state == "SLV" else ""
                made = row._replace(quantity=name, symbol=symbol, value=value, unit="", formula=place, expression="")
                rows[row.method, row.limit_state, name] = made
    return rows


def _check_name(document: Document, row: SheetRow) -> str:
    """Method and limit state."""
    state = document.state(row.limit_state) if row.quantity in _VERDICTS else row.limit_state
    return f"{method_name(document, row.method)} {state}".strip()


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
    return document.text(_OUTCOMES[check._verdict(key)])
