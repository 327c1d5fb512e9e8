"""Checks by a building code of the walls of a case, run here or read back from result files."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import fields
from typing import Any

from dondolo._fortran.checks import SheetRow, sheet_rows
from dondolo._fortran.library import properties
from dondolo._storage.columns import Columns
from dondolo._storage.run_file import RunFile
from dondolo.checks.ntc import CodeCheck, check_ntc
from dondolo.errors import InputError, silent
from dondolo.records.codes import CHECK_OPTIONS, Site
from dondolo.walls.wall import Wall

# Variables of the group &check that the site has
_OF_SITE = tuple(field.name for field in fields(Site))
# A value of each kind of variable
_KINDS: dict[str, Any] = {"text": "", "list": [0.0], "real": 0.0}


def site_of(run: RunFile) -> Site:
    """The site of a case with a group &check."""
    given = run.settings["check"]
    rows = [row for row in properties("check") if row.name in _OF_SITE and row.name in given]
    values = {row.name: run.setting("check", row.name, _KINDS[row.kind]) for row in rows}
    return Site(
        **{name: value[0] if isinstance(value, list) and len(value) == 1 else value for name, value in values.items()}
    )


def checks_of_run(walls: Iterable[Wall], run: RunFile) -> tuple[CodeCheck | None, ...]:
    """The kinematic check of each wall, made again to the numbers of ``_checks.csv``; empty without a group &check."""
    if "check" not in run.settings:
        return ()
    given = run.settings["check"]
    return kinematic_checks(walls, site_of(run), **check_options(given))


def check_options(given: Mapping[str, Any]) -> dict[str, Any]:
    """What a check needs besides a site, of the group &check."""
    lists = {row.name for row in properties("check") if row.kind == "list"}
    kinds: dict[str, Any] = {
        name: tuple if name in lists else str if isinstance(value, str) else float
        for name, value in CHECK_OPTIONS.items()
    }
    return {name: kind(given[name]) for name, kind in kinds.items() if name in given}


def kinematic_checks(walls: Iterable[Wall], site: Site | None, **options: Any) -> tuple[CodeCheck | None, ...]:
    """The kinematic check of each wall of a population, None for one that has none; empty without a site."""
    checks: list[CodeCheck | None] = []
    for wall in () if site is None else walls:
        assert site is not None
        try:
            # The run has said what the walls look like.
            with silent():
                checks.append(check_ntc(wall, site, **options))
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
