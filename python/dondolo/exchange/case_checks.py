"""Checks by a building code of the walls of a case, run here or read back from result files."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from dondolo._fortran.checks import SheetRow, sheet_rows
from dondolo._storage.columns import Columns
from dondolo._storage.run_file import RunFile
from dondolo.checks.ntc import CodeCheck, check_ntc
from dondolo.errors import InputError, silent
from dondolo.records.codes import Site
from dondolo.walls.wall import Wall


def site_of(run: RunFile) -> Site:
    """The site of a case with a group &check."""
    hazard = (run.setting("check", name, [0.0]) for name in ("ag", "f0", "tc_star"))
    words = {name: run.setting("check", name, "") for name in ("soil", "topography")}
    life = run.setting("check", "reference_life", 0.0)
    exceedance = run.setting("check", "exceedance", [0.0])
    return Site(
        *(values if len(values) > 1 else values[0] for values in hazard),
        **words,
        reference_life=life or None,
        exceedance=exceedance if life else None,
    )


def checks_of_run(walls: Iterable[Wall], run: RunFile) -> tuple[CodeCheck | None, ...]:
    """The kinematic check of each wall, made again to the numbers of ``_checks.csv``; empty without a group &check."""
    if "check" not in run.settings:
        return ()
    given = run.settings["check"]
    factors = {name: float(given[name]) for name in ("knowledge_factor", "behaviour") if name in given}
    return kinematic_checks(walls, site_of(run), **factors)


def kinematic_checks(walls: Iterable[Wall], site: Site | None, **factors: float) -> tuple[CodeCheck | None, ...]:
    """The kinematic check of each wall of a population, None for one that has none; empty without a site."""
    checks: list[CodeCheck | None] = []
    for wall in () if site is None else walls:
        assert site is not None
        try:
            # The run has said what the walls look like.
            with silent():
                checks.append(check_ntc(wall, site, **factors))
        except InputError:
            checks.append(None)
    return tuple(checks)


def complete_checks(checks: Iterable[CodeCheck | None]) -> tuple[CodeCheck, ...]:
    """The checks of designs; none where one of them cannot be checked."""
    found = tuple(checks)
    return tuple(one for one in found if one is not None) if None not in found else ()


def stored_check(table: Columns, run: RunFile, wall: Wall) -> CodeCheck:
    """The check of a wall, ``_check.csv``."""
    columns: dict[str, Any] = {name: table.texts(name) for name in SheetRow._fields}
    columns["value"] = table.numbers("value")
    return CodeCheck(wall=wall, site=site_of(run), rows=sheet_rows(columns))
