"""Chapters 10 and 11 of a calculation report: the mechanism, and the checks with their numbers."""

from __future__ import annotations

import math
from collections.abc import Sequence
from itertools import groupby

from dondolo._fortran.checks import SheetRow
from dondolo.checks.ntc import CodeCheck
from dondolo.checks.side_by_side import side_by_side
from dondolo.reporting.blocks import Block, CaptionedTable, Heading, Note, Picture, symbol_of
from dondolo.reporting.content import Piece, Table
from dondolo.reporting.numerals import NONE, chance, number, whole
from dondolo.reporting.relazione.capacity import capacity_of, displacement_of, end_of, shown
from dondolo.reporting.relazione.chains import scheme
from dondolo.reporting.relazione.document import Document, _
from dondolo.reporting.relazione.drawings import draw_capacity, draw_floor, draw_table, draw_wall
from dondolo.reporting.relazione.elevations import elevation_of
from dondolo.reporting.relazione.floors import building_in, demand_of, peak_of
from dondolo.reporting.relazione.formulas import COHERENT, FIGURES, formulas_of
from dondolo.reporting.relazione.subjects import Subject
from dondolo.reporting.relazione.sums import (
    is_free,
    of_tie,
    ratios_of,
    reactions_of,
    sums_of,
    taken_of,
    ties_left_out,
    turning_of,
    without_of,
)
from dondolo.reporting.relazione.tabulated import table_of
from dondolo.reporting.units import CENTIMETRES, UNITS, Unit, cell, quantity
from dondolo.walls.chains import ChainWall
from dondolo.walls.mechanisms import Corner, TabulatedWall, TwoBlockWall
from dondolo.walls.ties import ties_of

# Displacements of the sheet, which are small
_LENGTHS = (
    "d_0", "halves_overlap",
    "tie_fracture", "displacement", "demand", "mean_displacement", "yield_displacement", "bar", "plate_width",
    "plate_height", "plate_diameter", "plate_thickness", "plate_needed", "masonry_thickness", "edge_distance",
)  # fmt: skip
# What a limit state without a hazard of its own is not to be taken for
_VERDICTS = ("ratio", "zeta_e", "verified")
_COUNTS = ("records", "histories", "beyond")
# What is 1 or 0
_FLAGS = ("free_element", "extrapolated", "required", "turns_first", "hierarchy", "plate_verified", "anchor_checked")
# Parts of a check whose rows are shown, in their order; those of the site and of ties are in tables of their own
_METHODS = ("mechanism", "linear", "nonlinear", "untied", "assigned")
# What says of the ratio again, in accelerations
_AGAIN = ("capacity_ag", "capacity_pga", "zeta_e")
# Verdicts of a check as a report of a calculation words them
_OUTCOMES = {
    "verified": _("satisfied"),
    "verified if its ties are": _("satisfied if its ties are"),
    "verified if no hinge slides": _("satisfied if no hinge slides"),
    "not verified": _("NOT satisfied"),
    "not applicable": _("not applicable"),
}


def mechanism(document: Document) -> list[Block]:
    """Chapter 10."""
    blocks: list[Block] = [Heading(document.text(_("Scheme of the mechanism")))]
    for name, one in document.each():
        if isinstance(one.wall, TabulatedWall):
            blocks.append(
                Picture(
                    lambda one=one: draw_table(document, one),  # type: ignore[misc]
                    document.titled(document.text(_("Moment and lever of the table over the rotation")), name),
                    document.text(_("Moment and lever of the wall against its rotation.")),
                )
            )
            blocks += table_of(document, one)
            continue
        if isinstance(one.wall, ChainWall):
            blocks += scheme(document, one, name)
            continue
        blocks.append(
            Picture(
                lambda one=one: draw_wall(document, one),  # type: ignore[misc]
                document.titled(
                    document.text(
                        _("Loads and hinges; the mechanism displaced")
                        if isinstance(one.wall, TwoBlockWall)
                        else _("Loads and hinge; the mechanism displaced, with the reactions of the base at activation")
                    ),
                    name,
                ),
                document.text(_("The wall at rest with its loads, and displaced about its hinge.")),
            )
        )
        blocks += elevation_of(document, one, name)
    return [*blocks, *_reactions(document)]


def _reactions(document: Document) -> list[Block]:
    """Reactions at the hinge of walls that turn about their base."""
    several = [(name, one) for name, one in document.each() if one.is_turning]
    if not several:
        return []
    # Beside those of a whole body each number has its unit
    is_mixed = any(one.is_whole for _name, one in several)
    head = _("force on the base") if is_mixed else _("force on the base [kN/m]")
    columns: dict[Piece, Sequence[Piece]] = {
        document.text(head): [
            document.text(_("vertical, downwards, ΣP")),
            document.text(_("horizontal without earthquake, outwards, ΣH - Σ σ₀ A")),
            document.text(_("horizontal at activation, outwards, ΣH + α₀ Σ(P + Q) - ΣT")),
        ]
    }
    for name, one in several:
        shown_as = quantity if is_mixed else cell
        columns[name] = [shown_as(value, one.unit("N/m"), 5) for value in reactions_of(one)]
    caption = _("Forces that the wall transmits to its base, per metre.")
    if is_mixed:
        caption = _("Forces that the wall transmits to its base.")
    words = _(
        "The reactions V and H of the base on the wall, drawn at activation, are equal and opposite to these forces."
        " Without earthquake a tie has its preload {preload} alone."
    )
    return [
        CaptionedTable(Table.of(columns), document.text(caption)),
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
    names = {"zeta": "ζ_E", "capacity": "d_C", "demand": "d_D", "a0": "a_0*", "peak": "a_Z", "g": "g"}
    blocks: list[Block] = [
        Heading(document.text(_("Checks at SLD, SLV and SLC"))),
        document.say(words, **{key: symbol_of(name) for key, name in names.items()}),
    ]
    if any(is_free(one.check) for one in document.subjects.several):
        free = _(
            "Of a free element (C8.7.1.2.1.3) the spectral acceleration {demand} at its elastic period, with a damping"
            " of 5 %, takes the place of {peak} (C8.7.1.2.1.5). Values of {modulus} are assumed by the designer, cracks"
            " included; without them only the displacements count."
        )
        symbols = {"demand": "S_eZ(T_0)", "peak": "a_Z", "modulus": "E"}
        blocks.append(document.say(free, **{key: symbol_of(name) for key, name in symbols.items()}))
    for name, one in document.each():
        if len(document.names) > 1:
            blocks.append(Heading(name, 2))
        blocks += [_states(document, one, name), _items(document, one, name), *_formulas(document, one)]
        blocks.append(
            Picture(
                lambda one=one: draw_capacity(document, one),  # type: ignore[misc]
                document.titled(
                    document.text(
                        _("Capacity curve, and the demand of SLV (damping 8 %) and SLC (10 %)")
                        if one.has_ratios
                        else _("Capacity curve")
                    ),
                    name,
                ),
                document.text(_("Spectral acceleration against displacement: capacity and demand.")),
            )
        )
        if one.is_on_floor and building_in(one, "SLV", "nonlinear") is not None:
            blocks.append(
                Picture(
                    lambda one=one: draw_floor(document, one),  # type: ignore[misc]
                    document.titled(
                        document.text(_("Spectrum of the floor at SLV, damping 8 %, and the period of the wall")), name
                    ),
                    document.text(_("Spectral acceleration of the floor and of the ground against period.")),
                )
            )
    if len(document.names) > 1:
        blocks.append(Heading(document.text(_("Numbers of all walls")), 2))
    blocks.append(_sheet(document))
    found = [row.value for one in document.subjects.several for row in one.check.rows if row.quantity == "period"]
    if not found:
        return blocks
    period = max(found)
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


def _states(document: Document, one: Subject, name: str) -> CaptionedTable:
    """The checks, a line each, with the probability of collapse at the acceleration allowed and at that of the site."""
    lines = side_by_side(one.check, one.curve)
    units = {"m": CENTIMETRES, "m/s2": UNITS["m/s2"]}
    ags, allowed, verdicts = symbol_of("a_g S"), document.text(_("allowed")), document.text(_("outcome"))
    columns: dict[Piece, Sequence[Piece]] = {
        document.text(_("check")): [f"{line.limit_state}, {method_name(document, line.method)}" for line in lines],
        document.text(_("capacity of the wall")): [_amount(line.capacity, units[line.unit]) for line in lines],
        document.text(_("demand")): [_amount(line.demand, units[line.unit]) for line in lines],
        document.text(_("capacity / demand")): [number(line.ratio) for line in lines],
        (ags, " ", allowed, " [g]"): [number(line.allowed_pga) for line in lines],
        verdicts: [outcome(document, one.check, (line.method, line.limit_state)) for line in lines],
    }
    words = _("Checks at a glance")
    if any(line.at_site for line in lines):
        words = _("Checks at a glance; probabilities of collapse by the fragility curve, with their 95 % interval")
        chance_of = document.text(_("P(collapse) at"))
        columns[chance_of, " ", ags, " ", allowed] = [chance(line.at_allowed) for line in lines]
        columns[document.text(_("P(collapse) at the site"))] = [chance(line.at_site) for line in lines]
    return CaptionedTable(Table.of(columns, (verdicts,)), document.titled(document.text(words), name))


def _amount(value: float, unit: Unit) -> Piece:
    """A capacity or a demand with its unit; a dash for none."""
    return NONE if math.isnan(value) else quantity(value, unit)


def _items(document: Document, one: Subject, name: str) -> CaptionedTable:
    """The items with their sums, so that the multiplier can be made again by hand."""
    items, turns = one.check.items, one.is_turning
    force, moment, second = one.unit("N/m"), one.unit("N m/m"), one.unit("N m2/m")

    def column(field: str, unit: Unit, figures: int = FIGURES) -> list[Piece]:
        values = [getattr(item, field) for item in items]
        return ["" if math.isnan(value) else cell(value, unit, figures) for value in values]

    sums = sums_of(items)
    lever, arm = ("z", "e") if turns else ("d_x", "d_y")
    # The masonry as one body has the weight of its sections, which the sum has once.
    counted = f" ({document.text(_('counted above'))})"
    names = [document.item(item.item) + (counted if item.item == "masonry" else "") for item in items]
    columns: dict[Piece, list[Piece]] = {document.text(_("item")): names}  # type: ignore[dict-item]
    forces = (symbol_of("P"), ", ", symbol_of("H"), ", ", symbol_of("T"), f" [{force.name}]")
    columns[forces] = [
        ("(", value, ")") if item.item == "masonry" else value
        for item, value in zip(items, column("force", force), strict=True)
    ]
    if turns:
        columns[(symbol_of("d"), " [m]")] = column("depth", UNITS["m"])
    if not isinstance(one.wall, TabulatedWall):
        columns[(symbol_of(arm), " [m]")] = column("arm", UNITS["m"])
    if turns:
        # Thrusts and ties have an arm too, of which their moments change as the wall turns.
        hinge = turning_of(items).hinge
        columns[(symbol_of(arm), " [m]")] = [
            "" if math.isnan(item.depth) else shown(item.depth - hinge, UNITS["m"]) for item in items
        ]
    columns[(symbol_of(lever), " [m]")] = column("lever", UNITS["m"])
    stab, over = (f"{document.text(words)} [{moment.name}]" for words in (_("stabilising"), _("overturning")))
    columns[stab] = column("stabilising", moment)
    if turns or sums["overturning"]:
        columns[over] = column("overturning", moment)
    product = (symbol_of("P"), " ", symbol_of(lever), f" [{moment.name}]")
    square = (symbol_of("P"), " ", symbol_of(lever), f"² [{second.name}]")
    columns[product] = column("force_lever", moment)
    columns[square] = column("force_lever2", second)
    pushes = sums["weight"] > sums["carried"] and turns
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
    words = _("Calculation of the multiplier, item by item, per metre of wall")
    if one.is_whole:
        words = _("Calculation of the multiplier, item by item, of the whole chain")
    if isinstance(one.wall, Corner):
        words = _("Calculation of the multiplier, item by item, of the whole corner")
    caption = document.titled(document.text(words), name)
    return CaptionedTable(Table.of(columns), caption, strong=1)  # type: ignore[arg-type]


def _formulas(document: Document, one: Subject) -> list[Block]:
    """The steps from the sums to the safety index, numbers put in: all rows of the sheet that have a formula."""
    check, wall = one.check, one.wall
    shown_rows = [row for row in check.rows if row.method in _METHODS and not check._is_void(row)]
    blocks: list[Block] = []
    for (method, state), rows in groupby(shown_rows, lambda row: (row.method, row.limit_state)):
        steps = [block for row in rows for block in _steps(document, one, row)]
        if method == "mechanism":
            blocks += [*steps, *end_of(document, one)]
        elif steps and method == "untied":
            ties = document.the_item(without_of(one, state))
            blocks += [document.say(_("{state}, without counting {ties}:"), state=state, ties=ties), *steps]
        elif steps:
            blocks += [document.say(f"{method_name(document, method)}, {state}:"), *steps]
    if not one.has_ratios:
        return blocks
    governing = ", ".join(f"{state}: {governed(document, one, state)}" for state in ("SLV", "SLC"))
    blocks.append(document.say(_("The ratios are governed by: {what}."), what=governing))
    found = ratios_of(one, check.ultimate_state, taken_of(one, check.ultimate_state))
    items = [item for item in check.items if item.item.startswith("tie")]
    late = any(
        of_tie(tie, "preload") * tie.section < item.force for tie, item in zip(ties_of(wall), items, strict=False)
    )
    counted = {item.item for item in items} - ties_left_out(one, without_of(one, check.ultimate_state))
    if found.is_of_activation and late and counted:
        words = _(
            "The activation that governs {zeta} of {state} counts the ties with their full force, which beyond their"
            " preload they have only after the wall has moved. By displacements alone the ratio is {ratio}."
        )
        note = document.say(words, zeta=symbol_of("ζ_E"), state=check.ultimate_state, ratio=number(found.displacement))
        blocks.append(Note("doubt", note.pieces))
    return blocks


def _steps(document: Document, one: Subject, row: SheetRow) -> list[Block]:
    """The formula of a row, after what leads to it."""
    blocks: list[Block] = []
    symbol = ""
    if row.method in ("nonlinear", "untied"):
        if row.quantity == "displacement":
            blocks += displacement_of(document, one, row)
        elif row.quantity == "acceleration":
            blocks += capacity_of(document, one, row)
        elif row.quantity == "ratio":
            symbol = "ζ_E"
        elif row.quantity == "spectral_demand":
            blocks += demand_of(document, one, row)
    elif row.quantity == "governing_t0":
        periods = [one.check.value("mechanism", "", name) for name in ("shortest_t0", "longest_t0")]
        words = _("Of all periods from {shortest} to {longest}, the demand is greatest at {symbol} = {period}.")
        shortest, longest, period = (number(value, 4, " s") for value in (*periods, row.value))
        blocks.append(
            document.say(words, shortest=shortest, longest=longest, symbol=symbol_of("T_0,gov"), period=period)
        )
    elif (row.method, row.quantity) == ("linear", "floor_pga"):
        blocks += peak_of(document, one, row)
    if row.numbers and row.quantity not in _AGAIN:
        if row.quantity in ("friction_needed", "sliding_alpha"):
            blocks.append(document.say(f"{document.item(row.item)}:"))
        blocks += formulas_of(document, row, one.check, symbol)
    return blocks


def governed(document: Document, one: Subject, state: str) -> str:
    """Which of its two ratios the ratio of a nonlinear check is, or which ties it does not count."""
    if not one.has_ratios:
        return "\N{EN DASH}"
    found = ratios_of(one, state, taken_of(one, state))
    what = document.text(_("activation") if found.is_of_activation else _("displacement"))
    ties = without_of(one, state)
    return document.text(_("{what}, without {ties}"), what=what, ties=document.the_item(ties)) if ties else what


def _sheet(document: Document) -> CaptionedTable:
    """The sheets of all walls beside each other, each number with its place in the norm."""
    sheets = [_sheet_rows(one) for one in document.subjects.several]
    rows: dict[tuple[str, str, str], SheetRow] = {}
    for sheet in sheets:
        for key, row in sheet.items():
            rows.setdefault(key, row)
    # What the first wall has not comes after it
    rows = dict(sorted(rows.items(), key=lambda item: _METHODS.index(item[0][0])))
    columns: dict[Piece, list[Piece]] = {
        document.text(_("quantity")): [
            document.text(_RATIOS[row.quantity]) + (f", {document.item(row.item)}" if row.item else "")
            if row.quantity in _RATIOS
            else (document.meaning(row), f", {document.item(row.item)}" if row.item else "")
            for row in rows.values()
        ],
        document.text(_("check")): [_check_name(document, row) for row in rows.values()],
        document.text(_("symbol")): [symbol_of(row.symbol) if row.symbol else NONE for row in rows.values()],
    }
    for (name, one), sheet in zip(document.each(), sheets, strict=True):
        columns[name] = [
            governed(document, one, key[1]) if key[2] == "governing"
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
        if row.method not in _METHODS or row.quantity.startswith("probability"):
            continue
        # Hinges of a strip have a row each, and so have ties that are left out
        parts = ("friction_needed", "sliding_alpha", "turns_first", "less_zeta", "less_sld", "less_hinge")
        of_part = row.item if row.quantity in parts or row.method == "untied" else ""
        rows[row.method, row.limit_state, f"{row.quantity} {of_part}".strip()] = row
        if row.method in ("nonlinear", "untied") and row.quantity == "demand":
            found = ratios_of(one, row.limit_state, row.method)
            for name, symbol, value in (
                ("displacement_ratio", "d_C/d_D", found.displacement),
                ("activation_ratio", f"a_0*/({_starting(one)} g)", found.activation),
                ("governing", "", 0.0),
            ):
                if math.isnan(value):
                    continue
                place = "C8.7.1.2.1.8" if row.limit_state == "SLV" else ""
                if name == "governing" and row.method == "untied":
                    continue
                made = row._replace(quantity=name, symbol=symbol, value=value, unit="", formula=place, expression="")
                rows[row.method, row.limit_state, f"{name} {of_part}".strip()] = made
    return rows


def _starting(one: Subject) -> str:
    """Symbol of the acceleration that starts the mechanism."""
    return "S_eZ(T_0)" if is_free(one.check) else "a_Z"


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
        "untied": _("curve without some ties"),
        "assigned": _("hinge assigned"),
    }
    return document.text(names[method])


def unit_of(row: SheetRow) -> Unit:
    """The unit of a number in tables: masses in t and forces in kN as in formulas, displacements in cm."""
    return CENTIMETRES if row.quantity in _LENGTHS else COHERENT.get(row.unit, UNITS[row.unit])


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
    """The verdict of a check in words; one that is not for the wall has none, and that of some is information."""
    words = document.text(_OUTCOMES[check._verdict(key)])
    return (
        words
        if key in check.required or key in check.not_applicable
        else f"{words} ({document.text(_('information'))})"
    )


def required(document: Document, check: CodeCheck) -> str:
    """The checks that the verdict rests on."""
    return ", ".join(f"{method_name(document, method)} {state}" for method, state in check.required)
