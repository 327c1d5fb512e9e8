"""Sums over the items of a calculation, and what follows from them: forces on the base, and two ratios of a check."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from typing import NamedTuple

from dondolo._fortran.checks import CalculationItem
from dondolo._fortran.walls import WALL_ABSENT
from dondolo.checks.ntc import CodeCheck
from dondolo.checks.side_by_side import ties_not_counted
from dondolo.reporting.relazione.subjects import Subject
from dondolo.walls.ties import Bar, ties_of


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
    found["held"] = math.fsum(one.force for one in items if is_held(one))
    found["alpha_0"] = (found["stabilising"] - found["overturning"]) / found["force_lever"]
    return found


def is_held(item: CalculationItem) -> bool:
    """Whether an item holds the wall by a horizontal force: a tie, or the friction of interlocking."""
    return item.item.startswith(("tie", "friction"))


def of_tie(tie: Bar, name: str) -> float:
    """A property of a tie, or the default that the calculation takes for it."""
    given = getattr(tie, name)
    return float(WALL_ABSENT[f"tie_{name}"] if given is None else given)


class Reactions(NamedTuple):
    """Forces that a wall transmits to its base.

    Attributes
    ----------
    vertical : float
        Downwards [N/m].
    at_rest, activated : float
        Outwards: without earthquake, where ties have their preload alone, and at activation [N/m].
    """

    vertical: float
    at_rest: float
    activated: float


def reactions_of(one: Subject) -> Reactions:
    """Forces that a wall which turns about its base transmits to it."""
    sums = sums_of(one.check.items)
    preload = math.fsum(of_tie(tie, "preload") * tie.section for tie in ties_of(one.wall))
    activated = sums["thrust"] + sums["alpha_0"] * sums["weight"] - sums["held"]
    return Reactions(sums["carried"], sums["thrust"] - preload, activated)


class Ratios(NamedTuple):
    """What the ratio of a nonlinear check is the greater of.

    Attributes
    ----------
    displacement : float
        d_C/d_D.
    activation : float
        a_0* over the peak acceleration at the wall.
    """

    displacement: float
    activation: float

    @property
    def is_of_activation(self) -> bool:
        """Whether the acceleration that starts the mechanism governs."""
        return self.activation > self.displacement


def ratios_of(one: Subject, state: str, method: str = "nonlinear") -> Ratios:
    """The two ratios of a nonlinear check: with all ties, or of the curve without some, method 'untied'."""
    check = one.check
    d, demand = (check.value(method, state, name) for name in ("displacement", "demand"))
    start = check.value("mechanism" if method == "nonlinear" else method, state, "a_0")
    return Ratios(d / demand, start / (one.wall.gravity * starting(one, state)))


def starting(one: Subject, state: str) -> float:
    """Acceleration that starts the mechanism [g]: the peak, of a free element that at its period; NaN if unknown."""
    check = one.check
    row = check._row("nonlinear", state, "floor_t0")
    if row is not None:
        return row.value
    if is_free(check):
        return math.nan
    return check.value("site", state, "floor_pga" if one.is_on_floor else "pga")


def is_free(check: CodeCheck) -> bool:
    """Whether the wall is a free element."""
    row = check._row("mechanism", "", "free_element")
    return row is not None and row.value == 1.0


def taken_of(one: Subject, state: str) -> str:
    """The method whose rows the ratio of a nonlinear check is of: 'untied' where it does not count some ties."""
    return "untied" if without_of(one, state) else "nonlinear"


def without_of(one: Subject, state: str) -> str:
    """The ties that the ratio of a nonlinear check does not count, such as 'tie 1'; '' if it counts all."""
    return ties_not_counted(one.check, state)


def ties_left_out(one: Subject, name: str) -> frozenset[str]:
    """The items of ties that a curve does not count, by its name 'tie 1', 'ties 1, 3', or 'ties (12)' for the first."""
    found = re.findall(r"\d+", name)
    if "(" not in name:
        return frozenset(f"tie {place}" for place in found)
    ties = ties_of(one.wall)
    order = sorted(range(len(ties)), key=lambda place: of_tie(ties[place], "strain") * ties[place].length)
    return frozenset(f"tie {place + 1}" for place in order[: int(found[0])])


class Turning(NamedTuple):
    """Sums over the items of a wall that turns about its base: moments at rest, and products with arms.

    Attributes
    ----------
    weights, ties, thrusts : float
        Moments at rest, without earthquake.
    pushed : float
        Weight times height of masses that the wall only pushes.
    first, second, arms : float
        ΣP z, ΣP z² and ΣP e.
    thrust_arms, tie_arms : float
        ΣH e and ΣT e.
    hinge : float
        Depth u of the hinge.
    share : float
        Share of gravity in the plane of the motion; 1 but about an inclined axis.
    """

    weights: float
    ties: float
    thrusts: float
    pushed: float
    first: float
    second: float
    arms: float
    thrust_arms: float
    tie_arms: float
    hinge: float
    share: float

    def multiplier(self, sine: float, *, with_ties: bool) -> float:
        """Multiplier at a rotation."""
        cosine = math.sqrt(1.0 - sine**2)
        ties, arms = (self.ties, self.tie_arms) if with_ties else (0.0, 0.0)
        top = (self.weights + ties - self.thrusts) * cosine - (self.lowered - arms) * sine
        return top / (self.first * cosine + self.arms * sine)

    @property
    def lowered(self) -> float:
        """What loses height for a unit of rotation."""
        return self.share * (self.first - self.pushed) + self.thrust_arms


def turning_of(items: tuple[CalculationItem, ...], broken: frozenset[str] = frozenset()) -> Turning:
    """The sums without the ties that have broken."""
    weights = [one for one in items if not math.isnan(one.arm) and one.item != "masonry"]
    ties = [one for one in items if is_held(one) and one.item not in broken]
    thrusts = [one for one in items if not math.isnan(one.overturning)]
    hinge = weights[0].depth - weights[0].arm
    # Of weights about an inclined axis a part holds; results keep a dozen digits
    share = round(weights[0].stabilising / (weights[0].force * weights[0].arm), 11)
    return Turning(
        weights=math.fsum(one.stabilising for one in weights if not math.isnan(one.stabilising)),
        ties=math.fsum(one.stabilising for one in ties),
        thrusts=math.fsum(one.overturning for one in thrusts),
        pushed=math.fsum(one.force_lever for one in weights if math.isnan(one.stabilising)),
        first=math.fsum(one.force_lever for one in weights),
        second=math.fsum(one.force_lever2 for one in items if not math.isnan(one.force_lever2)),
        arms=math.fsum(one.force * one.arm for one in weights),
        thrust_arms=math.fsum(one.force * (one.depth - hinge) for one in thrusts),
        tie_arms=math.fsum(one.force * (one.depth - hinge) for one in ties),
        hinge=hinge,
        share=share,
    )
