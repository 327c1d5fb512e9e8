"""Chapters of a report on the check of a wall by a building code."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from typing import Any

import numpy as np

from dondolo._base.wording import decimal, in_english, say
from dondolo.checks.ntc import CodeCheck
from dondolo.checks.side_by_side import side_by_side, ties_not_counted
from dondolo.curves.fragility import Fragility
from dondolo.reporting.blocks import Block, Details, Heading, Paragraph, Picture
from dondolo.reporting.check_words import check_in_words, name_among, required, sheet_table
from dondolo.reporting.content import Piece, Symbol, Table, pieces
from dondolo.reporting.language import Language
from dondolo.reporting.numerals import NONE, chance, number, probability, whole
from dondolo.reporting.parts import captioned, paragraph
from dondolo.reporting.units import UNITS, quantity
from dondolo.reporting.words import the_item_in_words, warning
from dondolo.walls.wall import Wall

# What sentences that are said elsewhere are marked by for the catalogues
_ = str
_VERDICTS = (
    _("verified"), _("not verified"), _("not applicable"), _("verified if its ties are"),
    _("verified if no hinge slides"),
)  # fmt: skip
_DYNAMIC = {
    "pga": _("PGA [g]"),
    "records": _("records"),
    "histories": _("histories"),
    "beyond": _("beyond collapse"),
    "mean_displacement": _("mean displacement [m]"),
    "displacement": _("capacity [m]"),
}
# Symbols of the hazard of a site
_SITE = {"ag": Symbol("a", "g"), "f0": Symbol("F", "0"), "tc_star": Symbol("T", "C", "*"), "V_R": Symbol("V", "R")}
# Kinematic checks of the walls of a population: method and limit state
_KINEMATIC = (("linear", "SLD"), ("linear", "SLV"), ("nonlinear", "SLV"), ("nonlinear", "SLC"))


def code_check(check: CodeCheck, curve: Fragility | None, language: Language) -> list[Block]:
    """Tables of the verdicts and of the sheet, and the lines of the check on the curve."""
    is_drawn = curve is not None and curve.has_fit and curve.im == "pga" and check.verified is not None
    drawn = curve if is_drawn else None
    chances = {} if drawn is None else check.probabilities(drawn)
    on_checks = say(
        "The wall is verified by the kinematic formulas of Circolare 7/2019 to NTC 2018, C8.7.1.2.1, and by its"
        " criterion for time histories, C8.7.1.2.1.9. A kinematic check is a verification by formula; the fragility"
        " curve gives the probability that the wall collapses at a peak acceleration. Both are given here, and need not"
        " agree."
    )
    on_verdict = say(
        "The verdict rests on the check of the ultimate state, and for class of use IV on SLD too (NTC 8.3); the others"
        " are information."
    )
    caption = say(
        "Checks: capacity, demand, and the probability of collapse by the fragility curve, with its 95 % interval, at"
        " the peak acceleration that each allows and at that of the site."
    )
    blocks: list[Block] = [
        paragraph(on_checks, on_verdict),
        captioned(_beside(check, curve, with_chances=bool(chances)), caption),
        *_histories(check),
    ]
    if drawn is not None:
        words = "; ".join(
            f"{check_in_words(*key)} {decimal(probability(value).text)}"
            for key, value in chances.items()
            if key not in check.not_applicable
        )
        alt = say("Lines of the checks on the fragility curve. Probabilities: {words}.", words=words)
        caption = say(
            "The checks on the fragility curve: the capacity of the wall by each formula, the peak acceleration of the"
            " site, and the probability of collapse at each."
        )
        blocks.append(Picture(partial(check.plot, curve=drawn), caption, alt))
    if _site(check, "SLD") >= _site(check, "SLC"):
        blocks.append(
            paragraph(
                say("One hazard is given for all limit states. That of the code is lower for SLD and higher for SLC:"
                    " the ratio at SLC is unconservative.")
            )
        )  # fmt: skip
    blocks += [paragraph(say("Note: {note}.", note=warning(language, note))) for note in check.notes]
    sheet = _("Site: {site}. Every number with the place of its formula in the Circolare (C) or in NTC 2018.")
    return [
        *blocks,
        Heading(say("Calculation sheet"), 2),
        paragraph(pieces(sheet, site=_site_in_words(check))),
        captioned(sheet_table(check), say("Calculation sheet.")),
    ]


def _beside(check: CodeCheck, curve: Fragility | None, *, with_chances: bool) -> Table:
    """All checks beside each other."""
    lines = side_by_side(check, curve)
    verdicts = say("verdict")
    columns: dict[Piece, Sequence[Piece]] = {
        say("check"): [check_in_words(one.method, one.limit_state, ", ") for one in lines],
        say("capacity of the wall"): [_amount(one.capacity, one.unit) for one in lines],
        say("demand"): [_amount(one.demand, one.unit) for one in lines],
        say("capacity / demand"): [number(one.ratio, 3) for one in lines],
        pieces("{ag}{s} of the site [g]", ag=Symbol("a", "g"), s=Symbol("S")): [number(one.site_pga) for one in lines],
        pieces("{ag}{s} allowed [g]", ag=Symbol("a", "g"), s=Symbol("S")): [number(one.allowed_pga) for one in lines],
        verdicts: [_worded(check, (one.method, one.limit_state)) for one in lines],
    }
    if with_chances:
        columns[say("P(collapse) where allowed")] = [chance(one.at_allowed) for one in lines]
        columns[say("P(collapse) at the site")] = [chance(one.at_site) for one in lines]
    return Table.of(columns, (verdicts,))


def _histories(check: CodeCheck) -> list[Block]:
    """The check by time histories, or that there is none."""
    dynamic = [key for key in check._verified if key[0] == "dynamic"]
    if not dynamic:
        words = _("The criterion for time histories is left out: no records were run at the peak acceleration of the"
                  " site.")  # fmt: skip
        return [paragraph(say(words))]
    verdicts = say("verdict")
    histories: dict[Piece, Sequence[Piece]] = {say("limit state"): [state for _method, state in dynamic]}
    for name, head in _DYNAMIC.items():
        histories[say(head)] = [number(check.value(*key, name)) for key in dynamic]
    histories[verdicts] = [_worded(check, key) for key in dynamic]
    caption = say(
        "Time histories at the peak acceleration of the site. None may exceed the displacement of collapse, so that the"
        " verdict depends on their number; the mean of the largest displacements may not exceed the capacity."
    )
    on_records = say(
        "NTC 2018, 3.2.3.6 requires records that are compatible with the spectrum of the site. This is not checked"
        " here."
    )
    tied = _(
        "{what}: the time histories contain all ties, and their capacity is that of the curve with all of them; the"
        " nonlinear check does not count {ties}."
    )
    return [
        captioned(Table.of(histories, (verdicts,)), caption),
        paragraph(on_records),
        *(
            paragraph(say(tied, what=state, ties=the_item_in_words(ties)))
            for _method, state in dynamic
            if (ties := ties_not_counted(check, state))
        ),
    ]


def code_checks(
    checks: Sequence[CodeCheck | None],
    curves: Sequence[Fragility],
    p_occ: Sequence[float],
    *,
    facade: Fragility | None,
    with_sheets: bool,
) -> list[Block]:
    """What the kinematic checks say of each wall of a population, and its probability of collapse at the site.

    Parameters
    ----------
    checks, curves, p_occ
        Of each row: its check, its curve if its mechanism can occur, and the probability of that.
    facade : Fragility or None
        Curve of the one facade that the rows are mechanisms of.
    with_sheets : bool
        Whether each row has its calculation sheet, as designs and the mechanisms of a facade have.
    """
    given = [(check, curve) for check, curve in zip(checks, curves, strict=True) if check is not None]
    made = [(check, curve) for check, curve in given if check.verified is not None]
    walls = [check.wall for check, _curve in given]
    on_checks = say(
        "Each wall is checked by the kinematic formulas of Circolare 7/2019 to NTC 2018, C8.7.1.2.1, mechanism by"
        " mechanism. A check is a verification by formula; the fragility curve of the wall gives the probability that"
        " it collapses. They need not agree."
    )
    blocks: list[Block] = [paragraph(on_checks)]
    if made:
        blocks.append(_counted([check for check, _curve in made]))
    if left_out := len(checks) - len(made):
        words = _("Rows not checked: {left_out} of {total}; the table of checks among the result files gives the"
                  " reason.")  # fmt: skip
        blocks.append(paragraph(say(words, left_out=left_out, total=len(checks))))
    if made:
        caption = say("Kinematic checks: capacity as peak acceleration at the site, and its ratio to that of the site.")
        blocks.append(captioned(_kinematic(made, walls), caption))
    if made and facade is not None and facade.has_fit and facade.im == "pga":
        # Far below the levels a curve that is fitted on its own may be less than that of a mechanism, which bounds it.
        pga = made[0][0].pga
        alone = [share * float(one(pga)) for share, one in zip(p_occ, curves, strict=True) if one.has_fit]
        together = probability(max(float(facade(pga)), *alone))
        sentence = _(
            "Probability of collapse by any mechanism that occurs, at the peak acceleration of the site, in the same"
            " histories: {probability}."
        )
        blocks.append(paragraph(pieces(sentence, probability=together)))
    if with_sheets and given:
        on_sheets = say("Every number with the place of its formula in the Circolare (C) or in NTC 2018.")
        blocks += [Heading(say("Calculation sheets"), 2), paragraph(on_sheets)]
        for check, _curve in given:
            name = name_among(check.wall, walls)
            blocks.append(
                Details(name, (captioned(sheet_table(check), say("Calculation sheet of {name}.", name=name)),))
            )
    return blocks


def _kinematic(made: Sequence[tuple[CodeCheck, Fragility]], walls: Sequence[Wall]) -> Table:
    """The kinematic checks of each wall, and its probability of collapse at the site."""
    columns: dict[Piece, Sequence[Piece]] = {say("wall"): [name_among(check.wall, walls) for check, _curve in made]}
    for key in _KINEMATIC:
        columns[f"{check_in_words(*key)} [g]"] = [
            number(check._outcome(key, "capacity_pga"), 3) for check, _curve in made
        ]
        columns[say("{check}, ratio", check=check_in_words(*key))] = [
            number(check._outcome(key, "ratio"), 3) for check, _curve in made
        ]
    if made[0][1].im == "pga":
        columns[say("P(collapse) at the site")] = [
            probability(float(curve(check.pga)) if curve.has_fit else np.nan) for check, curve in made
        ]
    return Table.of(columns)


def _counted(made: Sequence[CodeCheck]) -> Paragraph:
    """How many walls pass each check, and what makes others not count as verified."""
    of = len(made)
    held = "; ".join(
        say(
            "{check}: {many} of {of}",
            check=check_in_words(*key, ", "),
            many=whole(sum(check._verdict(key) == "verified" for check in made)).text,
            of=of,
        )
        for key in _KINEMATIC
    )
    sentences: list[str | tuple[Any, ...]] = [
        pieces("Site: {site}. Verified are", site=_site_in_words(made[0])),
        f"{held}.",
    ]
    if which := required(made[0]):
        rest = _("The verdict rests on {which} (NTC 8.3): satisfied by {many} of {of}; the rest is information.")
        sentences.append(say(rest, which=which, many=sum(check.satisfied for check in made), of=of))
    counts = {
        _("Of {many} a hinge slides before it turns: none of these counts as verified."): sum(
            bool(check.sliding) for check in made
        ),
        _("Of {open} something of the ties is open (anchor not checked or weaker than the bar, plate too thin): none of"
          " these counts as verified."): sum(bool(check.open_ties) for check in made),
        _("Of {many} the modes of the building give less than the ground, which governs: a choice of dondolo, by"
          " analogy with [C7.2.11]."): sum(
            any(note.code == "ground_governs" for note in check.notes) for check in made
        ),
        _("Of {many} no compressive strength is given: their confidence factor is 1.35, whatever is given"
          " (C8.7.1.2.1.3)."): sum(check._has("mechanism", "", "knowledge_given") for check in made),
    }  # fmt: skip
    sentences += [say(words, many=many, open=many) for words, many in counts.items() if many]
    return paragraph(*sentences)


def _worded(check: CodeCheck, key: tuple[str, str]) -> str:
    """The outcome of a check; that which the verdict does not rest on is information."""
    words = say(check._verdict(key))
    return (
        words if key in check.required or key in check.not_applicable else say("{verdict} (information)", verdict=words)
    )


def _site_in_words(check: CodeCheck) -> tuple[Any, ...]:
    """The hazard of the site and its ground."""
    site = check.site
    facts = dict(site._facts())
    if not in_english():
        facts = {name: decimal(text.replace(", ", "; ")) for name, text in facts.items()}
    facts["ground"] = say("soil {soil}, topography {topography}", soil=site.soil, topography=site.topography)
    if "V_R" in facts:
        facts["V_R"] = say("{years:g} years", years=site.hazard.reference_life)
    heads = {"ground": say("ground"), "place": say("coordinates"), **_SITE}
    words = [(heads[name], f" {text}") for name, text in facts.items()]
    return tuple(piece for place, fact in enumerate(words) for piece in (*([", "] if place else []), *fact))


def _site(check: CodeCheck, state: str) -> float:
    return check.value("site", state, "pga")


def _amount(value: float, unit: str) -> Piece:
    """A capacity or a demand with its unit; a dash for none."""
    return NONE if np.isnan(value) else quantity(value, UNITS[unit])
