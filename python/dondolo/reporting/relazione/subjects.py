"""The walls of a calculation report: a wall in several states, designs of a wall, or the mechanisms of a facade."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

from dondolo._base.arguments import argument_error
from dondolo.checks.ntc import CodeCheck
from dondolo.curves.fragility import Fragility
from dondolo.errors import InputError, Problem
from dondolo.exchange.results import Results
from dondolo.reporting.units import UNITS, Unit
from dondolo.reporting.words import BENDING
from dondolo.walls.chains import ChainWall
from dondolo.walls.mechanisms import Corner, TabulatedWall, TwoBlockWall
from dondolo.walls.wall import MasonryWall, Wall

# States that stand beside each other in a table
MOST = 6


@dataclass(frozen=True)
class Subject:
    """A wall with its check.

    Attributes
    ----------
    wall : MasonryWall, TabulatedWall or ChainWall
    check : CodeCheck
    curve : Fragility or None
        Of collapse.
    results : Results
        The run that it is of.
    """

    wall: MasonryWall | TabulatedWall | ChainWall
    check: CodeCheck
    curve: Fragility | None
    results: Results

    @property
    def checked(self) -> MasonryWall | TabulatedWall | ChainWall:
        """The wall that is checked: a strip with the hinge of its check."""
        if not isinstance(self.wall, TwoBlockWall):
            return self.wall
        return replace(self.wall, hinge=self.check.value("mechanism", "", "hinge"))

    @property
    def is_turning(self) -> bool:
        """Whether it is a wall of masonry that turns about its base, neither a strip nor a chain nor a table."""
        return not isinstance(self.wall, (TwoBlockWall, TabulatedWall, ChainWall))

    @property
    def is_whole(self) -> bool:
        """Whether masses and forces are those of a whole body, and not per metre of wall."""
        return isinstance(self.wall, (ChainWall, Corner))

    def unit(self, name: str) -> Unit:
        """The unit in which a document has what is per metre of wall, or in all."""
        return UNITS[name.removesuffix("/m") if self.is_whole else name]

    @property
    def has_ratios(self) -> bool:
        """Whether there is a spectrum at the level of the wall, without which nothing is verified."""
        return self.check.verified is not None

    @property
    def is_on_floor(self) -> bool:
        """Whether the demand is that of a floor; at the base of a building it is that of the ground."""
        return any((row.method, row.quantity) == ("site", "floor_pga") for row in self.check.rows)

    @property
    def is_bent(self) -> bool:
        """Whether it is of a run with strips that bend before they open, and a strip."""
        return self.wall.mechanism == "two_block" and any(one.code == BENDING for one in self.results.run.warnings)

    @property
    def index(self) -> float:
        """Safety index of the mechanism: of the nonlinear check of the ultimate state."""
        return self.check.zeta_e


@dataclass(frozen=True)
class Subjects:
    """What a report is of.

    Attributes
    ----------
    several : tuple of Subject
    facade : str
        Name of the facade whose mechanisms they are; '' for states of a wall, the first as it stands.
    union : Fragility or None
        Curve of the facade.
    of_building : bool
        Whether they are several mechanisms of one building, of runs of their own.
    """

    several: tuple[Subject, ...]
    facade: str = ""
    union: Fragility | None = None
    of_building: bool = False

    @property
    def are_mechanisms(self) -> bool:
        """Whether they are mechanisms beside each other, none of them a design of another."""
        return bool(self.facade) or self.of_building

    @property
    def least(self) -> Subject:
        """The one of the least safety index, or without any."""
        return min(self.several, key=lambda one: one.index if one.has_ratios else -math.inf)

    @property
    def has_histories(self) -> bool:
        """Whether any of them is checked by time histories."""
        return any(("dynamic", "SLV") in one.check._verified for one in self.several)


def subjects_of(found: Sequence[Results], *, mechanisms: bool = False) -> Subjects:
    """The walls of results.

    Parameters
    ----------
    found : sequence of Results
        In their order.
    mechanisms : bool
        Whether they are mechanisms of one building, and not a wall and its designs.

    Raises
    ------
    InputError
        Results that have no check, or of a population; several sites; more walls than stand beside each other; designs
        of another wall.
    """
    several: list[Subject] = []
    facade, union = "", None
    runs: set[str] = set()
    for results in found:
        where = results.run.path or "results"
        if results.run.run and results.run.run in runs:
            sentence = f"{where}: is given twice: a wall as it stands and its design are two runs"
            raise InputError(sentence, errors=[Problem(sentence, "not_together", "results", where)])
        runs.add(results.run.run)
        if "check" not in results.run.settings:
            sentence = f"{where}: has no check: run the case with a group &check, which a calculation report is of"
            raise InputError(sentence, errors=[Problem(sentence, "not_given", "check", where)])
        if results.check is not None:
            several.append(Subject(_checked(results.check.wall), results.check, results.fragility, results))
            continue
        people = results.typology
        if people is not None and people.facade and people.knows_unions and results.designs is None:
            if len(found) > 1:
                raise InputError(f"{where}: is a facade with several mechanisms: give it alone")
            facade, union = people.facade, people.unions[people.facade]
        elif results.designs is None or people is None:
            raise InputError(f"{where}: must be a wall, designs of a wall or one facade, not a population")
        for wall, check, curve in zip(people.walls, results.checks, people.curves, strict=True):
            if check is None:
                raise InputError(f"{where}: wall '{wall.name}' is not checked: the table of checks has the reason")
            several.append(Subject(_checked(wall), check, curve, results))
    if len(several) > MOST:
        raise argument_error(
            "out_of_range", "results", f": have {len(several)} walls, must be at most {MOST}: write several reports"
        )
    first = several[0].check.site
    for one in several:
        if one.check.site != first:
            raise InputError(
                f"{one.results.run.path or 'results'}: the site of its check is another than that of the first"
            )
    if mechanisms:
        _need_same(several, _SHARED, "mechanisms of one building have the same")
        return Subjects(tuple(several), of_building=True)
    if not facade:
        _need_same(several, _OF_A_WALL, "a wall as it stands and its designs have the same")
    return Subjects(tuple(several), facade, union)


# What mechanisms of one building share, and what a wall and its designs do beyond that
_SHARED: dict[str, Callable[[Subject], Any]] = {
    "knowledge_factor": lambda one: one.check._given_factor,
    "ultimate_state": lambda one: one.check.ultimate_state,
}
_OF_A_WALL: dict[str, Callable[[Subject], Any]] = {
    "mechanism": lambda one: one.wall.mechanism,
    "height": lambda one: one.wall.height,
    "building": lambda one: one.wall.building,
    **_SHARED,
}


def _need_same(several: Sequence[Subject], what: Mapping[str, Callable[[Subject], Any]], words: str) -> None:
    """Refuse walls that do not belong beside each other, with the names of what differs."""
    first = several[0]
    for one in several[1:]:
        if differing := [name for name, get in what.items() if get(one) != get(first)]:
            sentence = (
                f"{one.results.run.path or 'results'}: wall '{one.wall.name}': {words} {', '.join(what)};"
                f" {', '.join(differing)} of it and of '{first.wall.name}' differ"
            )
            if what is _OF_A_WALL:
                sentence += ": several mechanisms of one building are a report with mechanisms (--mechanisms)"
            raise InputError(sentence, errors=[Problem(sentence, "not_together", differing[0])])


def _checked(wall: Wall) -> MasonryWall | TabulatedWall | ChainWall:
    """A wall as one of the kinds whose parts the chapters name."""
    assert isinstance(wall, (MasonryWall, TabulatedWall, ChainWall))
    return wall
