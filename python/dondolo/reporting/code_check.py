"""Facts of a report on the check of a wall by a building code."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from dondolo.checks.ntc import CodeCheck
from dondolo.curves.fragility import Fragility
from dondolo.reporting.content import Piece, Symbol, Table, figure
from dondolo.reporting.numerals import NONE, number, probability, whole
from dondolo.walls.parts import parts_of
from dondolo.walls.wall import Wall


def code_check(check: CodeCheck, curve: Fragility | None) -> dict[str, Any]:
    """Tables of the verdicts and of the sheet, and the lines of the check on the curve."""
    drawn = None
    chances: dict[tuple[str, str], float] = {}
    if curve is not None and curve.has_fit and curve.im == "pga":
        chances = check.probabilities(curve)
        words = "; ".join(
            f"{' '.join(key).strip()} {probability(value).text}"
            for key, value in chances.items()
            if key not in check.not_applicable
        )
        drawn = figure(
            lambda: check.plot(curve=curve), f"Lines of the checks on the fragility curve. Probabilities: {words}."
        )
    kinematic = list(check.capacities)
    dynamic = [key for key in check.verified if key[0] == "dynamic"]
    columns: dict[Piece, Sequence[Piece]] = {
        "check": [f"{method}, {state}" for method, state in kinematic],
        (Symbol("a", "g"), Symbol("S"), " of the site [g]"): [number(_site(check, state)) for _, state in kinematic],
        "withstands [g]": [number(check._outcome(key, "capacity_pga")) for key in kinematic],
        "capacity / demand": [number(check._outcome(key, "ratio"), 3) for key in kinematic],
        "verdict": [check._verdict(key) for key in kinematic],
    }
    if chances:
        columns["P(collapse) at the site"] = [
            probability(chances.get(("site", state), chances.get(("site", ""), np.nan))) for _, state in kinematic
        ]
        columns["at what it withstands"] = [
            probability(np.nan if key in check.not_applicable else chances[key]) for key in kinematic
        ]
    histories: dict[Piece, Sequence[Piece]] = {"limit state": [state for _, state in dynamic]}
    for name, head in _DYNAMIC.items():
        histories[head] = [number(check.value(*key, name)) for key in dynamic]
    histories["verdict"] = [check._verdict(key) for key in dynamic]
    return {
        "checks": Table.of(columns, ("verdict",)),
        "histories": Table.of(histories, ("verdict",)) if dynamic else None,
        "figure": drawn,
        "site": ", ".join(f"{name} {text}" for name, text in check.site._facts()),
        "sheet": _sheet(check),
        "notes": list(map(str, check.notes)),
        "one_hazard": _site(check, "SLD") >= _site(check, "SLC"),
    }


_DYNAMIC = {
    "pga": "PGA [g]",
    "records": "records",
    "histories": "histories",
    "beyond": "beyond collapse",
    "mean_displacement": "mean displacement [m]",
    "displacement": "capacity [m]",
}


# Walls that are named where they do not pass a check
_NAMED = 4
# Kinematic checks of the walls of a population: method and limit state
_KINEMATIC = (("linear", "SLD"), ("linear", "SLV"), ("nonlinear", "SLV"), ("nonlinear", "SLC"))


def code_checks(
    checks: Sequence[CodeCheck | None], curves: Sequence[Fragility], *, facade: Fragility | None, with_sheets: bool
) -> dict[str, Any]:
    """What the kinematic checks say of each wall of a population, and its probability of collapse at the site.

    Parameters
    ----------
    checks, curves
        Of each row.
    facade : Fragility or None
        Curve of the one facade that the rows are mechanisms of.
    with_sheets : bool
        Whether each row has its calculation sheet, as designs and the mechanisms of a facade have.
    """
    made = [(check, curve) for check, curve in zip(checks, curves, strict=True) if check is not None]
    columns: dict[Piece, Sequence[Piece]] = {"wall": [check.wall.name for check, _ in made]}
    for key in _KINEMATIC:
        columns[f"{' '.join(key)} [g]"] = [number(check._outcome(key, "capacity_pga"), 3) for check, _ in made]
        columns[f"{' '.join(key)}, ratio"] = [number(check._outcome(key, "ratio"), 3) for check, _ in made]
    if curves[0].im == "pga":
        columns["P(collapse) at the site"] = [
            probability(float(curve(check.pga)) if curve.has_fit else np.nan) for check, curve in made
        ]
    held = [
        (", ".join(key), whole(sum(check._verdict(key) == "verified" for check, _ in made)), len(made))
        for key in _KINEMATIC
    ]
    site = ", ".join(f"{name} {text}" for name, text in made[0][0].site._facts()) if made else ""
    together: Piece | None = None
    if made and facade is not None and facade.has_fit and facade.im == "pga":
        # Far below the levels a curve that is fitted on its own may be less than that of a mechanism, which bounds it.
        pga = made[0][0].pga
        together = probability(max(float(facade(pga)), *(float(one(pga)) for one in curves if one.has_fit)))
    return {
        "checks": Table.of(columns),
        "held": held,
        "site": site,
        "open": sum(bool(check.open_ties) for check, _ in made),
        "left_out": len(checks) - len(made),
        "together": together,
        "sheets": [(check.wall.name, _sheet(check)) for check, _ in made] if with_sheets else [],
    }


# Numbers of the sheet that are 1 or 0
_YES_OR_NO = ("applicable", "hierarchy", "plate_verified", "anchor_checked")
# What is open of ties whose anchors are known
_OPEN_TIES = {
    "hierarchy": "hierarchy of strengths not respected, the anchor gives way before the bar yields",
    "plate_verified": "plate too thin",
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


def verdict(checks: Sequence[CodeCheck | None], walls: Sequence[Wall], *, without_soil: bool) -> Verdict | None:
    """The verdict on the walls of a report; None if nothing was checked and nothing is in doubt.

    Parameters
    ----------
    checks : sequence of CodeCheck or None
        Of each wall; None for one that could not be checked.
    walls : sequence of Wall
        All walls of the report.
    without_soil : bool
        Whether the hazard of the annual frequency is without the factor of soil and topography.
    """
    made = [check for check in checks if check is not None]
    missed, doubts = _failed(made), []
    if made and len(made) < len(checks):
        doubts.append(f"not checked: {len(checks) - len(made)} of {len(checks)} walls")
    if made and (loose := unchecked_anchors(walls)):
        doubts.append(f"anchors of the ties not checked: {_named(loose, walls)}")
    if without_soil:
        doubts.append("the hazard is that of rigid, level ground, without the factor S of soil and topography")
    if not made:
        return Verdict("doubt", "Not checked by a building code", tuple(doubts)) if doubts else None
    for item, names in (
        (f"{check.wall.name}, {item}", names) for check in made for item, names in check.open_ties.items()
    ):
        doubts += [f"{_OPEN_TIES[name]}: {item}" for name in names if name in _OPEN_TIES]
    verdicts = [holds for check in made for key, holds in check.verified.items() if key not in check.not_applicable]
    if missed:
        words = f"{verdicts.count(False)} of {len(verdicts)} checks by NTC 2018 not satisfied"
    elif doubts:
        # What is open may turn any of them: nothing is called satisfied.
        reasons = "; ".join(one.partition(":")[0] for one in doubts)
        words = f"open: {reasons}; none of {len(verdicts)} checks by NTC 2018 fails"
    else:
        words = f"all {len(verdicts)} checks by NTC 2018 satisfied"
    index = min(made, key=lambda check: check.value("nonlinear", "SLV", "ratio"))
    whose = f", {index.wall.name}" if len(made) > 1 else ""
    words = f"{words[0].upper()}{words[1:]}; ζ_E {_ratio(index):.3g} (nonlinear SLV{whose})"
    return Verdict("failed" if missed else "doubt" if doubts else "fine", words, (*missed, *doubts))


def unchecked_anchors(walls: Sequence[Wall]) -> list[Wall]:
    """Walls with ties whose anchors have no strength, so that the bars alone are checked."""
    return [
        wall
        for wall in walls
        if any(not (tie.anchor_force or tie.plate_width or tie.plate_diameter) for tie in parts_of(wall, "ties"))
    ]


def _ratio(check: CodeCheck) -> float:
    return check.value("nonlinear", "SLV", "ratio")


def _named(some: Sequence[Wall], walls: Sequence[Wall]) -> str:
    """Walls by their names, or how many they are."""
    return ", ".join(wall.name for wall in some) if len(some) <= _NAMED else f"{len(some)} of {len(walls)} walls"


def _failed(made: Sequence[CodeCheck]) -> list[str]:
    """The checks that walls do not pass, a sentence each."""
    sentences = []
    for key in dict.fromkeys(key for check in made for key in check.verified):
        missed = [check for check in made if not check.verified.get(key, True) and key not in check.not_applicable]
        if not missed:
            continue
        ratios = [check.value(*key, "ratio") for check in missed if key[0] != "dynamic"]
        word = "capacity / demand" if len(missed) == 1 else "least capacity / demand"
        least = f", {word} {min(ratios):.3g}" if ratios else ""
        what = f"{' '.join(key)}{least}"
        if len(made) == 1:
            sentences.append(what)
        else:
            sentences.append(f"{what}: {_named([check.wall for check in missed], [check.wall for check in made])}")
    return sentences


def _site(check: CodeCheck, state: str) -> float:
    return check.value("site", state, "pga")


def _sheet(check: CodeCheck) -> Table:
    """All numbers, in the order of the calculation."""
    counts = ("records", "histories", "beyond", "verified", *_YES_OR_NO)
    shown = [row for row in check.rows if row.quantity != "probability"]
    columns: dict[Piece, Sequence[Piece]] = {
        "quantity": [row.meaning for row in shown],
        "check": [f"{row.item or row.method} {row.limit_state}".strip() for row in shown],
        "symbol": [row.symbol or NONE for row in shown],
        "value": [
            NONE
            if check._is_void(row)
            else whole(row.value)
            if row.quantity in counts
            else (f"{row.bound} " * bool(row.bound), number(row.value, 6))
            for row in shown
        ],
        "unit": [row.unit or NONE for row in shown],
        "formula": [row.formula or NONE for row in shown],
    }
    return Table.of(columns, ("check", "symbol", "unit", "formula"))
