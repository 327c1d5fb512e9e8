"""Chapters 13 to 16 of a calculation report: histories, fragility, summary and run."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from dondolo._storage.run_file import RunFile
from dondolo.checks.side_by_side import chance_at
from dondolo.curves.fragility import Fragility
from dondolo.reporting.blocks import (
    Block,
    CaptionedTable,
    Heading,
    Note,
    Picture,
    symbol_of,
)
from dondolo.reporting.content import BETA, THETA, Piece, Table
from dondolo.reporting.numerals import NONE, Numeral, chance, number, probability, whole
from dondolo.reporting.relazione.checks import governed, method_name, outcome, value_of
from dondolo.reporting.relazione.document import Document, _
from dondolo.reporting.relazione.drawings import draw_fragility, draw_indices
from dondolo.reporting.relazione.sums import without_of
from dondolo.reporting.statuses import STATUSES
from dondolo.reporting.units import CENTIMETRES, UNITS, cell
from dondolo.reporting.words import warning

_CHECKS = (("linear", "SLD"), ("linear", "SLV"), ("nonlinear", "SLV"), ("nonlinear", "SLC"))
_DYNAMIC = (("dynamic", "SLV"), ("dynamic", "SLC"))
_STATES = ("SLD", "SLV", "SLC")


def histories(document: Document) -> list[Block]:
    """Chapter 13."""
    blocks: list[Block] = [Heading(document.text(_("Dynamic analysis")))]
    if not document.subjects.has_histories:
        return [*blocks, document.say(_("No check by time histories is part of this calculation."))]
    heads = {
        "records": document.text(_("records")),
        "histories": document.text(_("histories")),
        "beyond": document.text(_("beyond collapse")),
        "mean_displacement": document.text(_("mean of the largest displacements [cm]")),
        "displacement": document.text(_("capacity [cm]")),
    }
    made = [(name, one, key) for name, one in document.each() for key in _DYNAMIC if key in one.check._verified]
    columns: dict[Piece, Sequence[Piece]] = {
        document.text(_("wall")): [name for name, *_rest in made],
        document.text(_("limit state")): [document.state(state) for *_rest, (_method, state) in made],
        "PGA [g]": [number(one.check.value(*key, "pga")) for _name, one, key in made],
    }
    for quantity, head in heads.items():
        values = [one.check.value(*key, quantity) for _name, one, key in made]
        lengths = "displacement" in quantity
        columns[head] = [cell(x, CENTIMETRES) if lengths else whole(x) for x in values]
    columns[document.text(_("outcome"))] = [outcome(document, one.check, key) for _name, one, key in made]
    text = document.text(_("outcome"))
    tied = _(
        "{what}: the time histories contain all ties, and their capacity is that of the curve with all of them; the"
        " nonlinear check does not count {ties}."
    )
    return [
        *blocks,
        CaptionedTable(
            Table.of(columns, (document.text(_("limit state")), text)),
            document.text(_("Time histories at the peak acceleration of the site (Circolare, C8.7.1.2.1.9).")),
        ),
        document.say(
            _(
                "A history that goes beyond {d0} enters the mean with {d0}; one such history fails the check, whatever"
                " the mean."
            ),
            d0=symbol_of("d_0*"),
        ),
        *(
            document.say(tied, what=f"{name}, {state}", ties=document.the_item(ties))
            for name, one, (_method, state) in made
            if (ties := without_of(one, state))
        ),
        document.say(
            _(
                "Records with their event, date, magnitude, station and component are in the annexes. NTC"
                " 3.2.3.6 asks for"
                " records that are compatible with the spectrum of the site, which the code does not check."
            )
        ),
        *document.written("record_selection", _("selection of the records and their compatibility with the spectrum")),
    ]


def _curves(document: Document) -> list[tuple[str, Fragility]]:
    """Curves of the walls, and of the facade that they are mechanisms of."""
    found = [(name, one.curve) for name, one in document.each() if one.curve is not None]
    if document.subjects.facade and document.subjects.union is not None:
        found.insert(0, (document.subjects.facade, document.subjects.union))
    return found


def fragility(document: Document) -> list[Block]:
    """Chapter 14."""
    curves = _curves(document)
    blocks: list[Block] = [
        Heading(document.text(_("Fragility curve and probability of collapse"))),
        document.say(_("Further information, which NTC 2018 do not ask for: the curve is that of the time histories.")),
    ]
    if not curves:
        return [*blocks, document.say(_("The results have no fragility curve."))]
    pga = document.subjects.several[0].check.pga
    ends = [
        curve.parameter_interval()["theta"] if curve.has_errors else (math.nan, math.nan) for _name, curve in curves
    ]
    columns: dict[Piece, Sequence[Piece]] = {
        document.text(_("wall")): [name for name, _curve in curves],
        (document.text(_("median")), " ", THETA, " [g]"): [number(curve.theta) for _name, curve in curves],
        document.text(_("95 % interval from")): [number(low) for low, _high in ends],
        document.text(_("to")): [number(high) for _low, high in ends],
        (document.text(_("dispersion")), " ", BETA): [number(curve.beta) for _name, curve in curves],
        (document.text(_("probability at")), " ", symbol_of("a_g S")): [
            probability(float(curve(pga))) if curve.has_fit else NONE for _name, curve in curves
        ],
        document.text(_("status")): [
            document.language.named("status", curve.status, STATUSES[curve.status]) for _name, curve in curves
        ],
    }
    blocks.append(
        CaptionedTable(
            Table.of(columns, (document.text(_("status")),)), document.text(_("Fragility curves of collapse."))
        )
    )
    if any(curve.has_fit for _name, curve in curves):
        blocks.append(
            Picture(
                lambda: draw_fragility(document),
                document.text(_("Fragility curves, and the peak acceleration of the site.")),
                document.text(_("Probability of collapse against peak acceleration.")),
            )
        )
    return blocks


def summary(document: Document) -> list[Block]:
    """Chapter 15."""
    several = document.subjects.several
    rows: list[tuple[Piece, Sequence[Piece]]] = []
    for name in ("alpha_0", "a_0"):
        unit = UNITS["m/s2"] if name == "a_0" else UNITS[""]
        head = (symbol_of("a_0*"), " [m/s²]") if name == "a_0" else (symbol_of("alpha_0"),)
        rows.append((head, [cell(one.check.value("mechanism", "SLV", name), unit, 5) for one in several]))
    for method, state in _CHECKS:
        name = f"{method_name(document, method)} {document.state(state)}"
        ratios = [one.check._outcome((method, state), "ratio") for one in several]
        words = ", ".join((name, document.text(_("capacity / demand"))))
        head_of: Piece = (f"{name}, ", symbol_of("ζ_E")) if state == "SLV" else words
        rows.append((head_of, [number(ratio, 4) for ratio in ratios]))
        if (method, state) == ("nonlinear", several[0].check.ultimate_state):
            words = ", ".join((name, document.text(_("governed by"))))
            rows.append((words, [governed(document, one, state) for one in several]))
        rows.append(
            (
                f"{name}, {document.text(_('outcome'))}",
                [outcome(document, one.check, (method, state)) for one in several],
            )
        )
    periods = [("nonlinear", state, "return_period_capacity") for state in ("SLV", "SLC")]
    has_periods = any(one.check._has(*periods[0]) for one in several)
    ultimate = several[0].check.ultimate_state
    head = (f"{document.text(_('safety index of the wall'))} ({method_name(document, 'nonlinear')} {ultimate}), ",)
    rows.append(((*head, symbol_of("ζ_E")), [number(one.index, 4) for one in several]))
    for method, state, quantity in periods if has_periods else []:
        head_of = (f"{method_name(document, method)} {state}, ", symbol_of("T_R,C"), f" [{document.unit('years')}]")
        found = [value_of(document, one.check, one.check._row(method, state, quantity)) for one in several]
        rows.append((head_of, found))
    for method, state in _DYNAMIC:
        if document.subjects.has_histories:
            name = f"{method_name(document, method)} {document.state(state)}, {document.text(_('outcome'))}"
            key = (method, state)
            found = [outcome(document, one.check, key) if key in one.check._verified else NONE for one in several]
            rows.append((name, found))
    blocks: list[Block] = [
        Heading(document.text(_("Summary of the checks"))),
        document.beside(document.text(_("quantity")), rows, document.text(_("Checks of all walls."))),
    ]
    least = document.subjects.least
    if document.subjects.are_mechanisms and least.has_ratios:
        index = (
            _("The least safety index of the facade is {index}, of the mechanism {name}.")
            if document.subjects.facade
            else _("The least safety index of these mechanisms is {index}, of {name}.")
        )
        blocks.append(document.say(index, index=number(least.index, 4), name=least.wall.name))
        blocks.append(_mechanisms(document))
    elif len(several) > 1 and not document.subjects.are_mechanisms:
        blocks += _differences(document)
    if not has_periods:
        blocks.append(document.say(_why_no_period(document)))
    if has_periods:
        words = _(
            "A return period of the capacity outside the range in which it is meaningful, which is assumed and not read"
            " in a norm, is given as a bound. It follows straight lines in the logarithms of {ag} and {period} through"
            " the hazards of the limit states, prolonged where the sheet says that the capacity is outside of them."
        )
        blocks.append(document.say(words, ag=symbol_of("a_g"), period=symbol_of("T_R")))
    blocks += [
        document.say(
            _(
                "The site spectrum keeps its shape and its factor of soil while it is scaled to the capacity, so that"
                " {zeta} is the ratio of peak accelerations {ags}. It is that of the local mechanism. The"
                " safety index of"
                " the building is the least of all mechanisms and of the global analysis."
            ),
            zeta=symbol_of("ζ_E"),
            ags=symbol_of("a_g S"),
        ),
        *document.written(
            "building_index", _("safety index of the building, and the other mechanisms that were checked")
        ),
        *_interventions(document),
    ]
    return blocks


def _mechanisms(document: Document) -> CaptionedTable:
    """Mechanisms beside each other, the one of the least safety index last."""
    ordered = sorted(document.each(), key=lambda pair: -pair[1].index)
    state = ordered[0][1].check.ultimate_state
    periods = [one.check._row("nonlinear", state, "return_period_capacity") for _name, one in ordered]
    hinges = [one.check._row("mechanism", state, "hinge") for _name, one in ordered]
    chances = [chance_at(one.curve, one.check.value("site", state, "pga")) for _name, one in ordered]
    columns: dict[Piece, Sequence[Piece]] = {
        document.text(_("mechanism")): [name for name, _one in ordered],
        document.text(_("hinge, height over that of the wall")): [number(row.value if row else 0.0) for row in hinges],
        symbol_of("alpha_0"): [number(one.check.value("mechanism", state, "alpha_0")) for _name, one in ordered],
        (symbol_of("a_0*"), " [m/s²]"): [number(one.check.value("mechanism", state, "a_0")) for _name, one in ordered],
        (symbol_of("ζ_E"), f", {state}"): [number(one.index) for _name, one in ordered],
    }
    if any(periods):
        columns[symbol_of("T_R,C"), f" [{document.unit('years')}]"] = [
            value_of(document, one.check, row) for (_name, one), row in zip(ordered, periods, strict=True)
        ]
    if any(chances):
        columns[document.text(_("P(collapse) at the site"))] = [chance(one) for one in chances]
    caption = document.text(_("Mechanisms beside each other, that of the least safety index last."))
    return CaptionedTable(Table.of(columns), caption, strong=1)


def _interventions(document: Document) -> list[Block]:
    """What NTC 2018 ask of interventions, beside the index; the verdict on one is the designer's."""
    values = {
        "local": {}, "improved": {"schools": number(0.6), "increase": number(0.1)},
        "full": {"full": Numeral("1.0"), "reduced": Numeral("0.80")},
    }  # fmt: skip
    conditions = [
        document.say(words, zeta=symbol_of("ζ_E"), **values.get(name, {})).pieces
        for name, words in (
            ("assessment", _("{zeta} and the return period of the capacity are stated")),
            ("local", _("no mechanism may lose safety, one at least must gain; repair of damage: none may lose")),
            (
                "improved",
                _(
                    "of the building: {zeta} of at least {schools} for schools of class III and for class IV, raised by"
                    " at least {increase} for the rest of class III and for class II; class I is not named, cultural"
                    " heritage has no limit"
                ),
            ),
            ("full", _("of the building: {zeta} of at least {full} in cases a, b and d, {reduced} in cases c and e")),
        )
    ]
    columns: dict[Piece, Sequence[Piece]] = {
        document.text(_("intervention")): [
            document.text(words)
            for words in (_("evaluation"), _("repair or local work"), _("improvement"), _("adjustment"))
        ],
        document.text(_("condition of the norm")): conditions,
        document.text(_("place")): ["NTC 8.3", "NTC 8.4.1, C8.4.1", "NTC 8.4.2", "NTC 8.4.3"],
    }
    blocks: list[Block] = [
        CaptionedTable(
            Table.of(columns, [*map(document.text, (_("intervention"), _("condition of the norm"), _("place")))]),
            document.text(_("What NTC 2018 ask of interventions.")),
        ),
        document.say(
            _("Class of use and kind of work are for the designer to state, and so is what follows from them.")
        ),
    ]
    if document.subjects.are_mechanisms:
        return blocks
    (_name, first), *others = document.each()
    for name, one in others:
        if math.isclose(one.index, first.index, rel_tol=1e-9):
            sentence = _("{wall}: no increase is demonstrated at {state}.")
            blocks.append(document.say(sentence, wall=name, state=one.check.ultimate_state))
    return blocks


def _why_no_period(document: Document) -> str:
    """Why the capacity has no return period."""
    ag = document.subjects.several[0].check.site.hazard.ag
    if len(ag) < len(_STATES):
        return _(
            "The return period of the capacity is not given: the hazard of the site is one for all limit states, and a"
            " line through return periods needs that of each."
        )
    if np.any(np.diff(ag) <= 0.0):
        return _(
            "The return period of the capacity is not given: the accelerations of the limit states do not increase from"
            " SLD to SLC."
        )
    return _("The return period of the capacity is not given: the check has no reference life.")


def _differences(document: Document) -> list[Block]:
    """What designs change with respect to the first state, and a drawing of the safety indices."""
    (_name, first), *others = document.each()
    heads: dict[tuple[str, str, str], Piece] = {
        ("mechanism", "", "alpha_0"): ("Δ", symbol_of("alpha_0")),
        ("mechanism", "", "a_0"): ("Δ", symbol_of("a_0*"), " [m/s²]"),
    }
    for method, state in _CHECKS[1:]:
        name = f"{method_name(document, method)} {document.state(state)}"
        heads[method, state, "zeta_e"] = ("Δ", symbol_of("ζ_E"), f", {name}")
    if first.check._has("nonlinear", "SLV", "return_period_capacity"):
        years = f" [{document.unit('years')}]"
        heads["nonlinear", "SLV", "return_period_capacity"] = ("Δ", symbol_of("T_R,C"), ", SLV", years)
    columns: dict[Piece, Sequence[Piece]] = {
        document.text(_("difference to the state as it stands")): [*heads.values()]
    }
    for name, one in others:
        cells: list[Piece] = []
        for key in heads:
            row, base = one.check._row(*key), first.check._row(*key)
            # A difference of bounds is none.
            known = row is not None and base is not None and not row.bound and not base.bound
            cells.append(number(row.value - base.value) if row and base and known else NONE)
        columns[name] = cells
    return [
        CaptionedTable(Table.of(columns), document.text(_("The design beside the state as it stands."))),
        Picture(
            lambda: draw_indices(document),
            document.text(_("Safety indices of the states; from 1 on the check is satisfied.")),
            document.text(_("Safety index of each state by the linear and the nonlinear check.")),
        ),
    ]


def run(document: Document) -> list[Block]:
    """Chapter 16."""
    blocks: list[Block] = [Heading(document.text(_("General information on the calculation")))]
    for title, one in runs_of(document):
        blocks.append(Heading(title, 2))
        warnings, remarks = notes_of(document, one)
        if not warnings:
            blocks.append(document.say(_("No warnings on the calculation.")))
        for head, several in (
            (_("Warnings on the calculation: "), warnings),
            (_("Remarks on the check: "), remarks),
        ):
            blocks += [Note("plain", (document.text(head), text, ".")) for text in several]
        if one.work:
            blocks.append(
                document.say(
                    _("Histories: {histories}; steps of integration: {steps}; impacts located: {impacts}."),
                    **{name: whole(one.work.get(name, 0)) for name in ("histories", "steps", "impacts")},
                )
            )
    return blocks


def notes_of(document: Document, one: RunFile) -> tuple[list[str], list[str]]:
    """Warnings on the calculation of a run and remarks on its checks, each once."""
    remarks = [note for _name, each in document.each() if each.results.run is one for note in each.check.notes]
    first, second = (
        list(dict.fromkeys(warning(document.language, note) for note in several)) for several in (one.warnings, remarks)
    )
    return first, second


def runs_of(document: Document) -> list[tuple[str, RunFile]]:
    """The runs of the document, each once, and what they are called."""
    found: dict[int, tuple[list[str], RunFile]] = {}
    for name, one in document.each():
        found.setdefault(id(one.results), ([], one.results.run))[0].append(name)
    return [(", ".join(names), one) for names, one in found.values()]
