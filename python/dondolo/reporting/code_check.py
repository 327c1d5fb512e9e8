"""Facts of a report on the check of a wall by a building code."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from dondolo._base.wording import decimal, in_english, named, say
from dondolo._fortran.checks import SheetRow
from dondolo.checks.ntc import CodeCheck
from dondolo.checks.plots import check_name
from dondolo.checks.side_by_side import side_by_side, ties_not_counted
from dondolo.curves.fragility import Fragility
from dondolo.errors import DondoloWarning
from dondolo.reporting.content import Piece, Symbol, Table, figure, pieces
from dondolo.reporting.inputs import mechanism_of
from dondolo.reporting.language import Language
from dondolo.reporting.numerals import NONE, chance, number, probability, whole
from dondolo.reporting.units import UNITS, Unit, cell, quantity
from dondolo.reporting.words import BENDING, in_words, item_in_words, the_item_in_words, warning
from dondolo.walls.ties import ties_without_anchor
from dondolo.walls.wall import Wall


def code_check(check: CodeCheck, curve: Fragility | None, language: Language) -> dict[str, Any]:
    """Tables of the verdicts and of the sheet, and the lines of the check on the curve."""
    drawn = None
    chances: dict[tuple[str, str], float] = {}
    if curve is not None and curve.has_fit and curve.im == "pga" and check.verified is not None:
        chances = check.probabilities(curve)
        words = "; ".join(
            f"{_name(*key)} {decimal(probability(value).text)}"
            for key, value in chances.items()
            if key not in check.not_applicable
        )
        alt = say("Lines of the checks on the fragility curve. Probabilities: {words}.", words=words)
        drawn = figure(lambda: check.plot(curve=curve), alt)
    lines = side_by_side(check, curve)
    dynamic = [key for key in check._verified if key[0] == "dynamic"]
    verdicts = say("verdict")
    columns: dict[Piece, Sequence[Piece]] = {
        say("check"): [_name(one.method, one.limit_state, ", ") for one in lines],
        say("capacity of the wall"): [_amount(one.capacity, one.unit) for one in lines],
        say("demand"): [_amount(one.demand, one.unit) for one in lines],
        say("capacity / demand"): [number(one.ratio, 3) for one in lines],
        pieces("{ag}{s} of the site [g]", ag=Symbol("a", "g"), s=Symbol("S")): [number(one.site_pga) for one in lines],
        pieces("{ag}{s} allowed [g]", ag=Symbol("a", "g"), s=Symbol("S")): [number(one.allowed_pga) for one in lines],
        verdicts: [_worded(check, (one.method, one.limit_state)) for one in lines],
    }
    if chances:
        columns[say("P(collapse) where allowed")] = [chance(one.at_allowed) for one in lines]
        columns[say("P(collapse) at the site")] = [chance(one.at_site) for one in lines]
    histories: dict[Piece, Sequence[Piece]] = {say("limit state"): [state for _, state in dynamic]}
    for name, head in _DYNAMIC.items():
        histories[say(head)] = [number(check.value(*key, name)) for key in dynamic]
    histories[verdicts] = [_worded(check, key) for key in dynamic]
    return {
        "checks": Table.of(columns, (verdicts,)),
        "histories": Table.of(histories, (verdicts,)) if dynamic else None,
        "tied": [(state, the_item_in_words(ties)) for _, state in dynamic if (ties := ties_not_counted(check, state))],
        "figure": drawn,
        "site": _site_in_words(check),
        "sheet": _sheet(check),
        "notes": [warning(language, note) for note in check.notes],
        "one_hazard": _site(check, "SLD") >= _site(check, "SLC"),
    }


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
# Walls that are named where they do not pass a check
_NAMED = 4
# Kinematic checks of the walls of a population: method and limit state
_KINEMATIC = (("linear", "SLD"), ("linear", "SLV"), ("nonlinear", "SLV"), ("nonlinear", "SLC"))


def code_checks(
    checks: Sequence[CodeCheck | None],
    curves: Sequence[Fragility],
    p_occ: Sequence[float],
    *,
    facade: Fragility | None,
    with_sheets: bool,
) -> dict[str, Any]:
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
    walls = [check.wall for check, _ in given]
    columns: dict[Piece, Sequence[Piece]] = {say("wall"): [_name_among(check.wall, walls) for check, _ in made]}
    for key in _KINEMATIC:
        columns[f"{_name(*key)} [g]"] = [number(check._outcome(key, "capacity_pga"), 3) for check, _ in made]
        columns[say("{check}, ratio", check=_name(*key))] = [
            number(check._outcome(key, "ratio"), 3) for check, _ in made
        ]
    if curves[0].im == "pga":
        columns[say("P(collapse) at the site")] = [
            probability(float(curve(check.pga)) if curve.has_fit else np.nan) for check, curve in made
        ]
    held = [
        (_name(*key, ", "), whole(sum(check._verdict(key) == "verified" for check, _ in made)), len(made))
        for key in _KINEMATIC
    ]
    site = _site_in_words(made[0][0]) if made else ()
    together: Piece | None = None
    if made and facade is not None and facade.has_fit and facade.im == "pga":
        # Far below the levels a curve that is fitted on its own may be less than that of a mechanism, which bounds it.
        pga = made[0][0].pga
        alone = [share * float(one(pga)) for share, one in zip(p_occ, curves, strict=True) if one.has_fit]
        together = probability(max(float(facade(pga)), *alone))
    return {
        "checks": Table.of(columns),
        "held": held,
        "site": site,
        "rests_on": _required(made[0][0]) if made else "",
        "satisfied": sum(check.satisfied for check, _ in made),
        "of": len(made),
        "sliding": sum(bool(check.sliding) for check, _ in made),
        "open": sum(bool(check.open_ties) for check, _ in made),
        "of_ground": sum(any(note.code == "ground_governs" for note in check.notes) for check, _ in made),
        "raised": sum(check._has("mechanism", "", "knowledge_given") for check, _ in made),
        "left_out": len(checks) - len(made),
        "together": together,
        "sheets": [(_name_among(check.wall, walls), _sheet(check)) for check, _ in given] if with_sheets else [],
    }


# Numbers of the sheet that are 1 or 0
_YES_OR_NO = (
    *("verified", "free_element", "applicable", "required", "extrapolated", "turns_first", "hierarchy"),
    *("plate_verified", "anchor_checked"),
)
# References with words
_LAWS = (_("D.M. 14-1-2008, annex A"), _("D.M. 14-1-2008, annex B"))
# What is open of ties whose anchors are known
_OPEN_TIES = {
    "hierarchy": _("hierarchy of strengths not respected, the anchor gives way before the bar yields"),
    "plate_verified": _("plate too thin"),
}


class Verdict(NamedTuple):
    """What the checks come to, at the beginning of a report.

    Attributes
    ----------
    tone : str
        'failed', 'doubt' or 'fine': the colour, which the words repeat.
    words : str
        How many checks are satisfied, and the safety index.
    reasons : tuple of str
        The checks that are not, and what was not checked.
    """

    tone: str
    words: str
    reasons: tuple[str, ...]


def verdict(
    checks: Sequence[CodeCheck | None],
    walls: Sequence[Wall],
    warnings: Sequence[DondoloWarning],
    *,
    without_soil: bool,
) -> Verdict | None:
    """The verdict on the walls of a report; None if nothing was checked and nothing is in doubt.

    Parameters
    ----------
    checks : sequence of CodeCheck or None
        Of each wall; None for one that could not be checked.
    walls : sequence of Wall
        All walls of the report.
    warnings : sequence of DondoloWarning
        Of the run.
    without_soil : bool
        Whether the hazard of the annual frequency is without the factor of soil and topography.
    """
    made = [check for check in checks if check is not None and check.verified is not None]
    missed, doubts = _failed(made), []
    lifted = [check.wall for check in checks if check is not None and check.verified is None]
    if lifted:
        doubts.append(say("no spectrum at the level of the wall: {walls}", walls=_named(lifted, walls)))
    if made and len(made) < len(checks):
        doubts.append(say("not checked: {left} of {walls} walls", left=len(checks) - len(made), walls=len(checks)))
    if made and (loose := unchecked_anchors(walls)):
        doubts.append(say("anchors of the ties not checked: {walls}", walls=_named(loose, walls)))
    if made and (bent := [one for one in warnings if one.code == BENDING]):
        doubts.append(say("bending of strips before they open neglected: {wall}", wall=bent[0].subject["wall"]))
    if without_soil:
        doubts.append(say("the hazard is that of rigid, level ground, without the factor S of soil and topography"))
    if not made:
        return Verdict("doubt", say("Not checked by a building code"), tuple(doubts)) if doubts else None
    for item, names in (
        (f"{_name_among(check.wall, walls)}, {item_in_words(item)}", names)
        for check in made
        for item, names in check.open_ties.items()
    ):
        doubts += [f"{say(_OPEN_TIES[name])}: {item}" for name in names if name in _OPEN_TIES]
    for check in made:
        whose = f"{_name_among(check.wall, walls)}, " if len(made) > 1 else ""
        doubts += [
            say("a hinge slides before it turns: {hinge}", hinge=whose + item_in_words(item)) for item in check.sliding
        ]
    verdicts = [check._verified[key] for check in made for key in check.required]
    if missed:
        which = _required(made[0])
        words = (
            say("not satisfied by NTC 2018: the check that the verdict rests on ({which})", which=which)
            if len(verdicts) == 1
            else say(
                "not satisfied by NTC 2018: {failed} of {checks} checks that the verdict rests on ({which})",
                failed=verdicts.count(False),
                checks=len(verdicts),
                which=which,
            )
        )
    elif doubts:
        # What is open may turn any of them: nothing is called satisfied.
        reasons = "; ".join(one.partition(":")[0] for one in doubts)
        words = say(
            "open: {reasons}; no check by NTC 2018 fails that the verdict rests on ({which})",
            reasons=reasons,
            which=_required(made[0]),
        )
    else:
        words = say("satisfied by NTC 2018: all that the verdict rests on ({which})", which=_required(made[0]))
    index = min(made, key=lambda check: check.zeta_e)
    whose = f" ({_name_among(index.wall, walls)})" if len(made) > 1 else ""
    words = f"{words[0].upper()}{words[1:]}; ζ_E {decimal(f'{index.zeta_e:.3g}')}{whose}"
    return Verdict("failed" if missed else "doubt" if doubts else "fine", words, (*missed, *doubts))


def unchecked_anchors(walls: Sequence[Wall]) -> list[Wall]:
    """Walls with ties whose anchors have no strength, so that the bars alone are checked."""
    return [wall for wall in walls if ties_without_anchor(wall)]


def _required(check: CodeCheck) -> str:
    """The checks that the verdict rests on."""
    return ", ".join(_name(*key) for key in check.required)


def _worded(check: CodeCheck, key: tuple[str, str]) -> str:
    """The outcome of a check; that which the verdict does not rest on is information."""
    words = say(check._verdict(key))
    return (
        words if key in check.required or key in check.not_applicable else say("{verdict} (information)", verdict=words)
    )


def _named(some: Sequence[Wall], walls: Sequence[Wall]) -> str:
    """Walls by their names, or how many they are."""
    return (
        ", ".join(_name_among(wall, walls) for wall in some)
        if len(some) <= _NAMED
        else say("{some} of {walls} walls", some=len(some), walls=len(walls))
    )


def _name_among(wall: Wall, walls: Sequence[Wall]) -> str:
    """The name of a wall, with its mechanism where other rows have the same name."""
    is_alone = sum(other.name == wall.name for other in walls) == 1
    return wall.name if is_alone else f"{wall.name}, {mechanism_of(wall)}"


def _failed(made: Sequence[CodeCheck]) -> list[str]:
    """The checks that the verdict rests on and walls do not pass, a sentence each."""
    sentences = []
    for key in dict.fromkeys(key for check in made for key in check.required):
        missed = [check for check in made if not check._verified.get(key, True)]
        if not missed:
            continue
        ratios = [check.value(*key, "ratio") for check in missed]
        what = _name(*key)
        if len(missed) == 1:
            what = say("{check}, capacity / demand {ratio:.3g}", check=what, ratio=min(ratios))
        else:
            what = say("{check}, least capacity / demand {ratio:.3g}", check=what, ratio=min(ratios))
        if len(made) == 1:
            sentences.append(what)
        else:
            sentences.append(f"{what}: {_named([check.wall for check in missed], [check.wall for check in made])}")
    return sentences


def _name(method: str, state: str, between: str = " ") -> str:
    """A check in words."""
    if method == "site":
        return say("site {state}", state=state).strip()
    return f"{method}{between}{state}".strip() if in_english() else check_name(method, state)


def _unit(row: SheetRow) -> Unit:
    """The unit that a number of the sheet is shown in."""
    return UNITS.get(row.unit, Unit(row.unit))


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


def _flag(row: SheetRow) -> Piece:
    """A number of the sheet that is 1 or 0; English meanings say what each is, Italian ones are cut before."""
    if in_english():
        return whole(row.value)
    if row.value > 0.0:
        return say("yes")
    return say("perhaps") if row.quantity == "free_element" else say("no")


def _meaning(row: SheetRow) -> str:
    """What a number of the sheet is."""
    return row.meaning if in_english() else named("quantity of a check", row.quantity).partition(":")[0]


def _sheet(check: CodeCheck) -> Table:
    """All numbers, in the order of the calculation."""
    counts = ("records", "histories", "beyond")
    shown = [row for row in check.rows if not row.quantity.startswith("probability")]
    texts = say("check"), say("symbol"), say("unit"), say("formula")
    columns: dict[Piece, Sequence[Piece]] = {
        say("quantity"): [_meaning(row) for row in shown],
        texts[0]: [
            f"{item_in_words(row.item) if row.item else in_words('method', row.method)} {row.limit_state}".strip()
            for row in shown
        ],
        texts[1]: [row.symbol or NONE for row in shown],
        say("value"): [
            NONE
            if check._is_void(row)
            else whole(row.value)
            if row.quantity in counts
            else _flag(row)
            if row.quantity in _YES_OR_NO
            else (f"{row.bound} " * bool(row.bound), cell(row.value, _unit(row), 6))
            for row in shown
        ],
        texts[2]: [say(_unit(row).name) if row.unit else NONE for row in shown],
        texts[3]: [say(row.formula) if row.formula in _LAWS else row.formula or NONE for row in shown],
    }
    return Table.of(columns, texts)
