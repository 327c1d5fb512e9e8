"""Chapters 0 to 9 of a calculation report: the work, the norms, the site, materials, models, analysis, and the code."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any, Literal

from dondolo._fortran.checks import ntc_parameters
from dondolo._fortran.library import constants
from dondolo.errors import InputError
from dondolo.figures.style import mechanism_name
from dondolo.records.codes import LimitState
from dondolo.reporting.blocks import Block, CaptionedTable, Facts, Heading, Note, Picture, Stamp, symbol_of
from dondolo.reporting.content import Piece, Table
from dondolo.reporting.numerals import NONE, number
from dondolo.reporting.relazione.checks import governed, method_name, required
from dondolo.reporting.relazione.document import Document, _
from dondolo.reporting.relazione.drawings import draw_spectra
from dondolo.reporting.relazione.elevations import panels
from dondolo.reporting.relazione.outcome import notes_of, runs_of
from dondolo.reporting.relazione.site_grid import coordinates, grid
from dondolo.reporting.relazione.subjects import Subject
from dondolo.reporting.relazione.sums import of_tie
from dondolo.reporting.relazione.ties import open_ties_of
from dondolo.reporting.tested import sentences
from dondolo.reporting.units import CENTIMETRES, UNITS, quantity
from dondolo.walls.chains import Chain, ChainWall
from dondolo.walls.horizontal import HorizontalBending
from dondolo.walls.mechanisms import Corner, OneSidedWall, TabulatedWall, TwoBlockWall
from dondolo.walls.parts import parts_of
from dondolo.walls.ties import ties_of

_STATES: tuple[LimitState, ...] = ("SLD", "SLV", "SLC")


def title_page(document: Document) -> list[Block]:
    """Chapter 0."""
    words = document.project.words
    pairs: list[tuple[Piece, Any]] = [
        (document.text(_("Work")), document.word("work", _("work"))),
        (document.text(_("Place")), document.word("place", _("municipality and address"))),
        (document.text(_("Client")), document.word("client", _("client"))),
        (document.text(_("Designer")), document.word("designer", _("designer"))),
        (document.text(_("Date")), document.word("date", _("date"))),
        (document.text(_("Revision")), words.get("revision", "0")),
        (document.text(_("Walls")), "; ".join(document.names)),
    ]
    found = [notes_of(document, one) for _name, one in runs_of(document)]
    counts = [sum(len(notes[place]) for notes in found) for place in range(2)]
    words_of_notes = _("warnings on the calculation: {warnings}, remarks on the checks: {remarks} (chapter 16)")
    pairs.append((document.text(_("To be read")), document.text(words_of_notes, warnings=counts[0], remarks=counts[1])))
    return [
        Heading(document.text(_("Calculation report: local mechanisms of masonry walls")), 0),
        Facts(tuple(pairs)),
        *_whole(document),
        *(_verdict(document, name, one) for name, one in document.each()),
        Stamp(document.text(_("Stamp and signature of the designer"))),
    ]


def _whole(document: Document) -> list[Block]:
    """The safety index of a facade, or of several mechanisms of a building: the least of them."""
    if not document.subjects.are_mechanisms:
        return []
    least = document.subjects.least
    if not least.has_ratios:
        sentence = (
            _("{facade}: check NOT feasible, since that of its mechanism {name} is not.")
            if document.subjects.facade
            else _("The check of {name} is NOT feasible.")
        )
        words = document.say(sentence, facade=document.subjects.facade, name=least.wall.name)
        return [Note("failed", words.pieces)]
    sentence = (
        _("{facade}: {zeta} = {index}, the least of its mechanisms, that of {name}.")
        if document.subjects.facade
        else _("Least safety index of the mechanisms of this report: {zeta} = {index}, that of {name}.")
    )
    values = {"facade": document.subjects.facade, "zeta": symbol_of("ζ_E"), "name": least.wall.name}
    kind: Literal["failed", "plain"] = "plain" if least.index >= 1.0 else "failed"
    return [Note(kind, document.say(sentence, index=number(least.index), **values).pieces)]


def _verdict(document: Document, name: str, one: Subject) -> Note:
    """What the checks of a wall come to; never 'fine' where something of a tie is open."""
    check = one.check
    values = {"wall": name, "which": required(document, check), "zeta": symbol_of("ζ_E"), "index": number(one.index)}
    if not one.has_ratios:
        sentence = _(
            "{wall}: check NOT feasible: the base is {level} above the ground, and the spectrum at this level is not"
            " given (Circolare, C8.7.1.2.1.5, C8.7.1.2.1.8)."
        )
        level = quantity(check.value("mechanism", "", "level"), UNITS["m"])
        return Note("failed", document.say(sentence, wall=name, level=level).pieces)
    values["what"] = governed(document, one, check.ultimate_state)
    found = {name for names in open_ties_of(check).values() for name in names}
    reasons = [document.text(words) for name, words in _OPEN.items() if name in found]
    if check.sliding:
        reasons.append(document.text(_("a hinge slides before it turns")))
    if document.has_one_hazard:
        reasons.append(document.text(_("SLC with the only hazard given, not that of SLC at the site")))
    for method, state in check.not_applicable:
        reasons.append(f"{method_name(document, method)} {state} {document.text(_('not applicable'))}")
    more: tuple[Any, ...] = ("; " + "; ".join(reasons) + ".",) if reasons else (".",)
    if not all(check._verified[key] for key in check.required):
        sentence = _("{wall}: NOT satisfied ({which}); {zeta} = {index} ({what})")
        return Note("failed", (*document.say(sentence, **values).pieces, *more))
    if one.is_bent and not found:
        sentence = _(
            "{wall}: no check of rigid blocks fails that the verdict rests on ({which}), but the strip bends before it"
            " opens, which they neglect; {zeta} = {index} ({what})"
        )
        return Note("doubt", (*document.say(sentence, **values).pieces, *more))
    if found:
        # What is open of a tie may turn any of them: nothing is called satisfied.
        sentence = _("{wall}: ties open, no check fails that the verdict rests on ({which}); {zeta} = {index} ({what})")
        return Note("doubt", (*document.say(sentence, **values).pieces, *more))
    if check.sliding:
        sentence = _(
            "{wall}: no check fails that the verdict rests on ({which}), but the mechanism is not the first to start;"
            " {zeta} = {index} ({what})"
        )
        return Note("doubt", (*document.say(sentence, **values).pieces, *more))
    sentence = _("{wall}: satisfied ({which}); {zeta} = {index} ({what})")
    return Note("fine", (*document.say(sentence, **values).pieces, *more))


# What is open of ties, at a glance
_OPEN = {
    "hierarchy": _("anchors of ties weaker than the bars"),
    "plate_verified": _("plates of ties too thin"),
    "anchor_knowledge": _("anchors of ties checked with a smaller confidence factor"),
    "anchor_checked": _("anchors of ties NOT checked"),
}


def description(document: Document) -> list[Block]:
    """Chapter 1."""
    return [
        Heading(document.text(_("Description of the work"))),
        *document.written("description", _("description of the building, its structural type and its use")),
        *document.written("survey", _("survey, cracks, connections of walls and floors")),
        document.say(_("Drawings of the walls are in the chapter on the mechanism.")),
    ]


def norms(document: Document) -> list[Block]:
    """Chapter 2."""
    return [
        Heading(document.text(_("Normative frame and purpose"))),
        document.say(
            _(
                "The checks follow the D.M. of 17 January 2018 (NTC 2018), chapters 3, 8 and 10, and the"
                " Circolare of 21"
                " January 2019, n. 7, C8.7.1.2.1, for local mechanisms of collapse. The evaluation concludes"
                " whether use"
                " may continue, be changed, or safety be raised (NTC 8.3). The safety index {zeta} is the"
                " largest seismic"
                " action sustained over that of a new building, compared in {ags} (Circolare, C8.3)."
            ),
            zeta=symbol_of("ζ_E"),
            ags=symbol_of("a_g S"),
        ),
        *document.written(
            "purpose", _("purpose: evaluation, improvement (NTC 8.4.2), adjustment (NTC 8.4.3) or local work")
        ),
    ]


def site(document: Document) -> list[Block]:
    """Chapter 3."""
    check, numbers = document.subjects.several[0].check, document.project.numbers
    assumed = document.text(_("value assumed by the designer"))

    def given(name: str, prompt: str, unit: str = "") -> Any:
        if name not in numbers:
            return document.field(name, prompt)
        return (number(numbers[name], 8, unit), f" ({assumed})")

    hazard = check.site.hazard
    mesh = hazard.mesh
    pairs: list[tuple[Piece, Any]] = (
        coordinates(document, check.site, mesh)
        if mesh
        else [
            (
                document.text(_("Latitude, longitude")),
                (given("latitude", _("latitude")), ", ", given("longitude", _("longitude"))),
            ),
            (
                (document.text(_("Nominal life")), " ", symbol_of("V_N")),
                given("nominal_life", _("nominal life"), _years(document)),
            ),
            (
                (document.text(_("Coefficient of use")), " ", symbol_of("C_U")),
                given("use_coefficient", _("coefficient of use")),
            ),
        ]
    )
    life = hazard.reference_life or None
    stated = life if mesh else None
    if not mesh and {"nominal_life", "use_coefficient"} <= numbers.keys():
        stated = numbers["nominal_life"] * numbers["use_coefficient"]
    if stated is not None:
        if life is not None and not math.isclose(life, stated, rel_tol=1e-9):
            raise InputError(
                f"nominal_life, use_coefficient: their product is {stated:g} years, but the reference_life of the check"
                f" is {life:g} years"
            )
        life = stated
        sides = (symbol_of("C_U"), " ", symbol_of("V_N"), " = ", number(life, 8, _years(document)), " (NTC, [3.2.0])")
        pairs.append(((document.text(_("Reference life")), " ", symbol_of("V_R")), sides))
    elif life is not None:
        given_life = (number(life, 8, _years(document)), f" ({assumed})")
        pairs.append(((document.text(_("Reference life")), " ", symbol_of("V_R")), given_life))
    ground = document.text(
        _("soil {soil}, topography {topography}"), soil=check.site.soil, topography=check.site.topography
    )
    pairs += [
        (document.text(_("Ground")), ground),
        (document.text(_("Reference of the class of soil")), document.word("soil_reference", _("geological report"))),
    ]
    states = _STATES if len(hazard.ag) > 1 else ("SLV",)
    heads: list[tuple[str, str]] = [
        ("a_g", "g"),
        ("F_0", ""),
        ("T_C*", "s"),
        ("S", ""),
        ("T_B", "s"),
        ("T_C", "s"),
        ("T_D", "s"),
        ("a_g S", "g"),
    ]
    columns: dict[Piece, Sequence[Piece]] = {
        document.text(_("limit state")): [one if len(states) > 1 else document.text(_("all")) for one in states]
    }
    rows = []
    has_periods = bool(hazard.exceedance) and len(states) > 1
    for state in states:
        spectrum = ntc_parameters(check.site._input(), state)
        names = ("ag", "f0", "tc_star", "soil_factor")
        rows.append([*(check.value("site", state, name) for name in names), *spectrum.corners.tolist(), spectrum.pga])
        if has_periods:
            rows[-1] += [hazard.exceedance[len(rows) - 1], check.value("site", state, "return_period_demand")]
    if has_periods:
        heads += [("P_VR", ""), ("T_R,D", document.text(_("years")))]
    for place, (symbol, unit) in enumerate(heads):
        columns[(symbol_of(symbol), f" [{unit}]" if unit else "")] = [number(row[place], 4) for row in rows]
    blocks: list[Block] = [
        Heading(document.text(_("Parameters of design"))),
        Facts(tuple(pairs)),
        CaptionedTable(Table.of(columns), document.text(_("Hazard of the site and spectra (NTC 3.2.3.2.1)."))),
        Picture(
            lambda: draw_spectra(document),
            document.text(_("Elastic spectra of horizontal acceleration, damping 5 %.")),
            document.text(_("Elastic spectra of acceleration against period.")),
        ),
    ]
    if mesh:
        blocks += grid(document, hazard, mesh)
    elif has_periods:
        words = _(
            "Return periods are those of reference life and probabilities of exceedance, both assumed by the designer:"
            " {symbol} = -{life}/ln(1 - {chance}) (NTC 3.2.1)."
        )
        symbols = {"symbol": symbol_of("T_R"), "life": symbol_of("V_R"), "chance": symbol_of("P_VR")}
        blocks.append(document.say(words, **symbols))
    if len(states) == 1:
        words = _(
            "One hazard is given for all limit states: that of the code is lower for SLD and higher for SLC. The rows"
            " of SLC are not results of SLC at this site, and those of SLD are on the safe side."
        )
        blocks.append(Note("doubt", document.say(words).pieces))
    return blocks


def _years(document: Document) -> str:
    return " " + document.text(_("years"))


def modelling(document: Document) -> list[Block]:
    """Chapter 5."""
    blocks: list[Block] = [Heading(document.text(_("Criteria of modelling")))]
    walls = [one.wall for one in document.subjects.several]
    for name, one in document.each():
        words = _mechanism(document, one.wall.mechanism)
        if parts_of(one.wall, "wedges"):
            words = document.text(_("compound overturning outwards, with wedges of the transverse walls"))
        height = quantity(one.wall.height, UNITS["m"])
        if isinstance(one.wall, HorizontalBending):
            sentence = _("{wall}: {mechanism}, length {length}, thickness {thickness}.")
            sizes = {"length": height, "thickness": quantity(one.wall.thickness, CENTIMETRES)}
            blocks.append(document.say(sentence, wall=name, mechanism=words, **sizes))
            continue
        if isinstance(one.wall, (TabulatedWall, ChainWall)):
            sentence = _("{wall}: {mechanism}, height {height}.")
            blocks.append(document.say(sentence, wall=name, mechanism=words, height=height))
            continue
        blocks.append(
            document.say(
                _("{wall}: {mechanism}, height {height}, thickness at the base {thickness}."),
                wall=name,
                mechanism=words,
                height=height,
                thickness=quantity(one.wall.thickness, CENTIMETRES),
            )
        )
    if any(one.is_turning for one in document.subjects.several):
        blocks.append(
            document.say(
                _(
                    "The wall is a macroelement of rigid blocks without tensile strength that turns about a"
                    " hinge near its"
                    " outer face. The masonry moves as one rigid body, since the wall is taken as monolithic over its"
                    " height: the fraction {ratio} of participating mass has its overall centroid (Circolare,"
                    " C8.7.1.2.1.1). Cut into parts it would have a smaller {ratio} and a greater {a0}, so that one"
                    " body is on the safe side for {a0}."
                ),
                ratio=symbol_of("e*"),
                a0=symbol_of("a_0*"),
            )
        )
    if any(getattr(wall, "compressive_strength", None) for wall in walls):
        blocks.append(
            document.say(_("The hinge is set back from the face by the compressive strength of the masonry."))
        )
    if any(getattr(wall, "hinge_depth", None) for wall in walls):
        blocks.append(document.say(_("The hinge is set back from the face by a depth that the designer gives.")))
    if any(isinstance(wall, TwoBlockWall) for wall in walls):
        blocks.append(
            document.say(
                _(
                    "A strip between two floors bends: two rigid blocks turn about hinges at the base, at an"
                    " intermediate"
                    " height and at the top, which the floor holds. The load on top is held sideways by the"
                    " floor: it is"
                    " neither in the denominator of the multiplier nor in the participating mass."
                )
            )
        )
    if any(isinstance(wall, TabulatedWall) for wall in walls):
        words = _(
            "A wall is a table of the terms of its mechanism of one degree of freedom, a kinematic chain that the"
            " designer has studied. dondolo checks that the table agrees with itself at rest: the lever with weights"
            " and displacements, and the displacement of the equivalent oscillator with C8.7.1.4."
        )
        blocks.append(document.say(words))
    if any(isinstance(wall, HorizontalBending) for wall in walls):
        words = _(
            "A wall that bends horizontally is an arch of two leaves in its thickness, a band of 1 m height with one"
            " degree of freedom. A constant thrust holds its ends, the least of what ties and transverse walls can"
            " take, which the designer gives; weights neither hold the leaves nor push them, and torsion of the masonry"
            " above and below is neglected. The hinge between the leaves is where {alpha} is least, unless its place is"
            " given. {alpha} follows from virtual work of all forces, {d0} from the finite displacements of the leaves,"
            " with the mean of C8.7.1.4 over all weights as the control point. No leaf slides."
        )
        blocks.append(document.say(words, alpha=symbol_of("alpha_0"), d0=symbol_of("d_0*")))
        blocks += document.written("end_thrust", _("what thrust ties and transverse walls can take, and why"))
    if any(isinstance(wall, Chain) for wall in walls):
        words = _(
            "A chain is made of rigid bodies with hinges between them, which the designer chooses, and has one degree"
            " of freedom: the positions of all bodies follow from the joints and from the rotation of one. {alpha}"
            " follows from virtual work of all weights and forces, {d0} from the finite displacements of the bodies,"
            " with the mean of C8.7.1.4 over all weights as the control point. No body slides, and no hinge is crushed"
            " beyond its place. The check looks for no hinges but those given."
        )
        blocks.append(document.say(words, alpha=symbol_of("alpha_0"), d0=symbol_of("d_0*")))
        blocks += document.written("chain_hinges", _("why these hinges are the weakest, and others that were tried"))
    if any(isinstance(wall, (Corner, OneSidedWall)) for wall in walls):
        blocks.append(document.say(_("The calculation assumes that the wall does not turn inwards.")))
        blocks += document.written("inward_rotation", _("why the wall does not turn inwards"))
    if any(ties_of(wall) for wall in walls):
        words = _(
            "Ties act with the least of the yield force of the bar and the strength of the anchor, if that is known,"
            " until they break; they do not act up to collapse. The limit analysis of {alpha} counts this force {force}"
            " in full, as if the ties were already active, whatever their preload {preload}; the anchor has to move"
            " outwards by ({force}/{area} - {preload}) {length}/{modulus} before they reach it: {travels}."
        )
        names = {"alpha": "alpha_0", "force": "T", "preload": "sigma_0", "area": "A", "length": "l", "modulus": "E"}
        blocks.append(
            document.say(words, travels=_travels(document), **{key: symbol_of(name) for key, name in names.items()})
        )
    if any(parts_of(wall, "interlock") for wall in walls):
        blocks.append(document.say(_("Interlocking with the transverse walls acts by friction, course by course.")))
    if any(parts_of(wall, "wedges") for wall in walls):
        words = _(
            "Wedges of the transverse walls turn with the wall: their angles and lengths are a judgement on the bond of"
            " the masonry. They act by their weight and their mass alone, without friction on the cracks."
        )
        blocks.append(document.say(words))
    if any(getattr(wall, "elevation_x", None) for wall in walls):
        words = _(
            "The elevation of a facade is a polygon from which doors and windows are taken away. Its mass, its centroid"
            " and its inertia are those of this figure above the hinge, per metre of the length of the facade."
        )
        blocks.append(document.say(words))
    blocks += panels(document)
    if any(isinstance(wall, Corner) for wall in walls):
        words = _(
            "A corner overturns along the bisector of its two walls: its square base carries a wing of each wall, above"
            " a crack whose angle is a judgement on the bond of the masonry. Depths are measured on the bisector, from"
            " the outer edge; the hinge is behind this edge. Masses and forces of a corner are those of the whole. The"
            " demand is the spectrum of one component of the motion, along the bisector, of which the Circolare says"
            " nothing."
        )
        blocks.append(document.say(words))
    if any(one.is_on_floor for one in document.subjects.several):
        blocks.append(
            document.say(
                _("The demand is that of the building at the level of the wall (Circolare, C7.2.3, C8.7.1.12).")
            )
        )
    if any("modal_" in row.quantity for one in document.subjects.several for row in one.check.rows):
        names = {"a_z": "a_Z", "pga": "a_g S", "s_ez": "S_eZ", "s_e": "S_e"}
        words = _(
            "Near the ground the modes of the building give less than the ground itself, which then governs: {a_z} is"
            " at least {pga}, and {s_ez} at least {s_e} at every period. This is assumed by analogy with [C7.2.11];"
            " [C7.2.5] has it beyond the first period only."
        )
        blocks.append(document.say(words, **{key: symbol_of(symbol) for key, symbol in names.items()}))
    found = sentences(
        (wall.mechanism for wall in walls), lambda one: _mechanism(document, one), document.language.decimal
    )
    blocks += [document.say(words, **values) for words, values in found]
    return blocks + document.written("mechanism", _("reasons for the mechanism chosen, from survey and details"))


def _mechanism(document: Document, mechanism: str) -> str:
    """A mechanism in the words of the document."""
    return document.language.named("mechanism", mechanism, mechanism_name(mechanism))


def _travels(document: Document) -> tuple[Any, ...]:
    """How far the anchor of each tie moves until the tie has its full force."""
    pieces: list[Any] = []
    for name, one in document.each():
        items = [item for item in one.check.items if item.item.startswith("tie")]
        for tie, item in zip(ties_of(one.wall), items, strict=False):
            stress = item.force / tie.section - of_tie(tie, "preload")
            which = ", ".join([name] * (len(document.names) > 1) + [document.item(item.item)])
            travel = quantity(stress * tie.length / of_tie(tie, "modulus"), CENTIMETRES)
            pieces += ["; ", f"{which}: ", travel]
    return tuple(pieces[1:])


def actions(document: Document) -> list[Block]:
    """Chapter 6."""
    whole = [
        document.say(
            _("{wall}: forces are those of the whole chain, heights and depths those of its tables."), wall=name
        )
        for name, one in document.each()
        if isinstance(one.wall, Chain)
    ]
    if len(whole) == len(document.subjects.several):
        words = _(
            "Forces are those of the whole chain. Loads carried are positive downwards; thrusts have their directions"
            " in the table of actions, heights and depths are those of the tables. In the seismic combination permanent"
            " loads are increased by the part {psi} of variable ones."
        )
        whole = [document.say(words, psi=(symbol_of("ψ_2"), " ", symbol_of("Q_k")))]
    words = _("{wall}: forces are those of a band of 1 m height, heights are places along the wall.")
    whole += [
        document.say(words, wall=name) for name, one in document.each() if isinstance(one.wall, HorizontalBending)
    ]
    return [
        Heading(document.text(_("Actions and seismic combination"))),
        *whole,
        *_per_metre(document),
        *_of_corners(document),
        document.say(
            _(
                "{p} are the weights that a wall carries, its own among them, {q} those of masses that it pushes"
                " without carrying them, {h} thrusts and {t} forces of ties. {q} count in the sums of weights"
                " times heights and in {ratio}, but hold nothing."
            ),
            p=symbol_of("P"),
            q=symbol_of("Q"),
            h=symbol_of("H"),
            t=symbol_of("T"),
            ratio=symbol_of("e*"),
        ),
        *document.written("load_analysis", _("analysis of loads of floors and roof")),
        *document.written("combinations", _("combinations of loads, and why they are exhaustive (NTC 10.2.1)")),
    ]


def _of_corners(document: Document) -> list[Block]:
    """The conventions of corners: all of them beside walls that have others, or where there are corners alone."""
    several = document.subjects.several
    if not any(isinstance(one.wall, Corner) for one in several):
        return []
    if any(not one.is_whole for one in several):
        return [document.say(_("Forces of a corner are in all, not per metre."))]
    words = _(
        "Forces of a corner are those of the whole. Loads carried are positive downwards, thrusts outwards along the"
        " bisector; heights are above the hinge, depths are measured on the bisector from the outer edge. In the"
        " seismic combination permanent loads are increased by the part {psi} of variable ones."
    )
    return [document.say(words, psi=(symbol_of("ψ_2"), " ", symbol_of("Q_k")))]


def _per_metre(document: Document) -> list[Block]:
    """The conventions of walls whose forces are per metre, if there are any."""
    if all(one.is_whole for one in document.subjects.several):
        return []
    return [
        document.say(
            _(
                "Forces are per metre of wall. Loads carried by the wall are positive downwards, thrusts"
                " outwards, forces of"
                " ties inwards; heights are above the hinge, depths behind the outer face. Their values are in"
                " the table of"
                " the calculation of each wall. In the seismic combination permanent loads are increased by the part"
                " {psi} of variable ones."
            ),
            psi=(symbol_of("ψ_2"), " ", symbol_of("Q_k")),
        )
    ]


def analysis(document: Document) -> list[Block]:
    """Chapter 7."""
    blocks: list[Block] = [
        Heading(document.text(_("Type of analysis"))),
        document.say(
            _(
                "Linear kinematic analysis: SLD, and SLV with the behaviour factor (Circolare, C8.7.1.2.1.5,"
                " C8.7.1.2.1.7)."
                " Nonlinear kinematic analysis: SLV and SLC, with the capacity curve of the equivalent"
                " oscillator and the"
                " displacement spectrum at the secant period (C8.7.1.2.1.6, C8.7.1.2.1.8)."
            )
        ),
    ]
    if document.subjects.has_histories:
        blocks.append(
            document.say(
                _(
                    "Nonlinear dynamic analysis: time histories of the rocking wall with impacts"
                    " (C8.7.1.2.1.9), none of"
                    " which may go beyond the displacement of collapse."
                )
            )
        )
    return blocks + document.written("analysis_reason", _("reasons for the type of analysis (NTC 10.2.1)"))


def code(document: Document) -> list[Block]:
    """Chapters 8 and 9."""
    several = document.subjects.several
    runs = list({one.results.run.run: one.results.run for one in several}.values())
    pairs: list[tuple[Piece, Any]] = [
        (document.text(_("Title")), "dondolo"),
        (document.text(_("Authors, producer and distributor")), _contributors(document)),
        (document.text(_("Version")), constants().version),
        (document.text(_("Licence")), "MIT"),
    ]
    for run in runs:
        parts = [run.run or NONE]
        if run.written is not None:
            parts.append(", " + document.language.date(run.written))
        if run.compiler:
            parts.append(", " + document.text(_("compiled by {compiler}"), compiler=run.compiler))
        if run.version != constants().version:
            parts.append(", " + document.text(_("version {version}"), version=run.version))
        pairs.append((document.text(_("Run")), tuple(parts)))
    return [
        Heading(document.text(_("Code of calculation"))),
        Facts(tuple(pairs)),
        document.say(_("Files of the calculation and their checksums are in the annexes.")),
        Heading(document.text(_("Reliability and validation of the code"))),
        document.say(
            _(
                "The documentation of the producer contains the theoretical basis ({theory}), the fields of use"
                " and limits"
                " ({check}), and the comparison with independent solutions and with a reference of 33 digits"
                " ({verification})."
            ),
            theory="docs/theory.md",
            check="docs/code_checks.md",
            verification="docs/verification.md",
        ),
        *document.written(
            "code_suitability",
            _("preliminary examination of the suitability of the code to this case (Circolare, C10.2.1)"),
        ),
    ]


def _contributors(document: Document) -> str:
    return document.text(_("the dondolo contributors"))
