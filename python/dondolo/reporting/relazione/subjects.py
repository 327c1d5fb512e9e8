"""The walls of a calculation report: a wall in several states, designs of a wall, or the mechanisms of a facade."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from dondolo._base.arguments import argument_error
from dondolo.checks.ntc import CodeCheck
from dondolo.curves.fragility import Fragility
from dondolo.errors import InputError, Problem
from dondolo.exchange.results import Results
from dondolo.walls.wall import MasonryWall, Wall

# States that stand beside each other in a table
MOST = 6


@dataclass(frozen=True)
class Subject:
    """A wall with its check.

    Attributes
    ----------
    wall : MasonryWall
    check : CodeCheck
    curve : Fragility or None
        Of collapse.
    results : Results
        The run that it is of.
    """

    wall: MasonryWall
    check: CodeCheck
    curve: Fragility | None
    results: Results

    @property
    def is_on_floor(self) -> bool:
        """Whether the demand is that of a floor; at the base of a building it is that of the ground."""
        return any((row.method, row.quantity) == ("site", "floor_pga") for row in self.check.rows)

    @property
    def index(self) -> float:
        """Safety index of the mechanism: of the nonlinear check of SLV."""
        return self.check.value("nonlinear", "SLV", "ratio")


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
    """

    several: tuple[Subject, ...]
    facade: str = ""
    union: Fragility | None = None

    @property
    def least(self) -> Subject:
        """The one of the least safety index."""
        return min(self.several, key=lambda one: one.index)

    @property
    def has_histories(self) -> bool:
        """Whether any of them is checked by time histories."""
        return any(("dynamic", "SLV") in one.check.verified for one in self.several)


def subjects_of(found: Sequence[Results]) -> Subjects:
    """The walls of results.

    Raises
    ------
    InputError
        Results that have no check, or of a population; several sites; more walls than stand beside each other.
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
    return Subjects(tuple(several), facade, union)


def _checked(wall: Wall) -> MasonryWall:
    """A wall that has a check: it has sections and a density, for walls of tables have none."""
    assert isinstance(wall, MasonryWall)
    return wall
