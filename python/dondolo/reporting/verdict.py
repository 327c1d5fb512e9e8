"""The verdict at the beginning of a report: how many checks are satisfied, and which are not."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Literal

from dondolo._base.wording import decimal, say
from dondolo.checks.ntc import CodeCheck
from dondolo.errors import DondoloWarning
from dondolo.reporting.blocks import Aside
from dondolo.reporting.check_words import check_in_words, name_among, required
from dondolo.reporting.words import BENDING, item_in_words
from dondolo.walls.ties import ties_without_anchor
from dondolo.walls.wall import Wall

# What sentences that are said elsewhere are marked by for the catalogues
_ = str
# Walls that are named where they do not pass a check
_NAMED = 4
# What is open of ties whose anchors are known
_OPEN_TIES = {
    "hierarchy": _("hierarchy of strengths not respected, the anchor gives way before the bar yields"),
    "plate_verified": _("plate too thin"),
}


def verdict(
    checks: Sequence[CodeCheck | None],
    walls: Sequence[Wall],
    warnings: Sequence[DondoloWarning],
    *,
    without_soil: bool,
) -> Aside | None:
    """What the checks come to, in colours that the words repeat; None if nothing was checked and nothing is in doubt.

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
        return Aside("verdict", "doubt", say("Not checked by a building code"), tuple(doubts)) if doubts else None
    for item, names in (
        (f"{name_among(check.wall, walls)}, {item_in_words(item)}", names)
        for check in made
        for item, names in check.open_ties.items()
    ):
        doubts += [f"{say(_OPEN_TIES[name])}: {item}" for name in names if name in _OPEN_TIES]
    for check in made:
        whose = f"{name_among(check.wall, walls)}, " if len(made) > 1 else ""
        doubts += [
            say("a hinge slides before it turns: {hinge}", hinge=whose + item_in_words(item)) for item in check.sliding
        ]
    verdicts = [check._verified[key] for check in made for key in check.required]
    if missed:
        which = required(made[0])
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
            which=required(made[0]),
        )
    else:
        words = say("satisfied by NTC 2018: all that the verdict rests on ({which})", which=required(made[0]))
    index = min(made, key=lambda check: check.zeta_e)
    whose = f" ({name_among(index.wall, walls)})" if len(made) > 1 else ""
    words = f"{words[0].upper()}{words[1:]}; ζ_E {decimal(f'{index.zeta_e:.3g}')}{whose}"
    tone: Literal["failed", "doubt", "fine"] = "failed" if missed else "doubt" if doubts else "fine"
    return Aside("verdict", tone, words, (*missed, *doubts))


def unchecked_anchors(walls: Sequence[Wall]) -> list[Wall]:
    """Walls with ties whose anchors have no strength, so that the bars alone are checked."""
    return [wall for wall in walls if ties_without_anchor(wall)]


def _named(some: Sequence[Wall], walls: Sequence[Wall]) -> str:
    """Walls by their names, or how many they are."""
    return (
        ", ".join(name_among(wall, walls) for wall in some)
        if len(some) <= _NAMED
        else say("{some} of {walls} walls", some=len(some), walls=len(walls))
    )


def _failed(made: Sequence[CodeCheck]) -> list[str]:
    """The checks that the verdict rests on and walls do not pass, a sentence each."""
    sentences = []
    for key in dict.fromkeys(key for check in made for key in check.required):
        missed = [check for check in made if not check._verified.get(key, True)]
        if not missed:
            continue
        ratios = [check.value(*key, "ratio") for check in missed]
        what = check_in_words(*key)
        if len(missed) == 1:
            what = say("{check}, capacity / demand {ratio:.3g}", check=what, ratio=min(ratios))
        else:
            what = say("{check}, least capacity / demand {ratio:.3g}", check=what, ratio=min(ratios))
        if len(made) == 1:
            sentences.append(what)
        else:
            sentences.append(f"{what}: {_named([check.wall for check in missed], [check.wall for check in made])}")
    return sentences
