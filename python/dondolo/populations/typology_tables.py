"""Tables of a typology, as the executable has them, and the set of files that they make."""

from __future__ import annotations

import dataclasses
import os
from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from dondolo._base.arguments import argument_error
from dondolo._fortran.library import constants
from dondolo._fortran.records import unit_of
from dondolo._fortran.tables import TableColumns, stripe_columns, typology_columns
from dondolo._storage import tables
from dondolo._storage.result_set import write_set
from dondolo._storage.run_file import RunFile, sources_of_fits
from dondolo.curves.table import flat, fragility_table
from dondolo.walls.ties import tie_table
from dondolo.walls.wall import properties_of
from dondolo.walls.wall_columns import statics_of

if TYPE_CHECKING:
    from dondolo.populations.typology import Typology

#: Names of the tables
TableName = Literal["typology", "fragility", "stripes", "walls", "unions", "ties"]


def tables_of(typology: Typology) -> dict[TableName, Callable[[], TableColumns]]:
    """What makes each table that there is of a typology."""
    found: dict[TableName, Callable[[], TableColumns]] = (
        {} if typology.are_alternatives else {"typology": lambda: typology_table(typology)}
    )
    found |= {
        "fragility": lambda: _curves_table(typology),
        "stripes": lambda: stripe_columns(
            list(zip(*(properties_of(typology.walls, what) for what in ("name", "mechanism")), strict=True)),
            typology.im,
            typology.levels,
            typology.edp_thresholds,
            typology.histories,
            typology.exceedances,
        ),
        "walls": lambda: typology.population._table(),
    }
    if len(typology.combined) < len(typology.walls) and typology.knows_unions:
        from dondolo.populations.unions import unions_table

        found["unions"] = lambda: unions_table(typology)
    ties = typology.ties
    if ties is not None and any(own.broken.size for own in ties):
        found["ties"] = lambda: tie_table(typology.walls, typology.im, typology.levels, ties, typology.histories)
    return found


def _curves_table(typology: Typology) -> TableColumns:
    """Columns of ``_fragility.csv``, the curves of all damage states of each row."""
    states = [typology.at(edp).curves for edp in typology.edp_thresholds]
    walls = [wall for wall in typology.walls for _ in states]
    return fragility_table(walls, [curve for row in zip(*states, strict=True) for curve in row])


def comments_of(typology: Typology) -> list[str]:
    """Lines above a table that is written alone."""
    counts = ", ".join(f"{name} = {count}" for name, count in typology.work._asdict().items())
    return [
        *(f"gravity = {tables.shortest(pull)}" for pull in dict.fromkeys(statics_of(typology.walls, "gravity"))),
        f"unit of im_level and theta: {unit_of(typology.im) or '1'}",
        f"work: {counts}",
        *(f"warning: {sentence}" for sentence in typology.warnings),
    ]


def write_typology(
    typology: Typology,
    prefix: str | os.PathLike[str],
    spreadsheet_safe: bool,
    more: Mapping[str, TableColumns] | None = None,
    settings: Mapping[str, dict[str, Any]] | None = None,
    confidence: float = np.nan,
) -> None:
    """Write all tables and some more, with the settings and the confidence of these."""
    pulls = set(statics_of(typology.walls, "gravity"))
    if len(pulls) > 1:
        raise argument_error(
            "not_together",
            "gravity",
            f" = {min(pulls):g} and {max(pulls):g}: must be the same for all walls that are saved",
        )
    found = {f"_{name}.csv": table() for name, table in tables_of(typology).items()} | dict(more or {})
    run = _run_file(typology, pulls.pop())
    run = dataclasses.replace(run, settings={**run.settings, **(settings or {})}, confidence=confidence)
    used = sources_of_fits(typology.im, typology.walls) | ({"check", "uncertainty"} & run.settings.keys())
    used |= {*typology.record_formats}
    write_set(prefix, found, run.citing(*used), spreadsheet_safe=spreadsheet_safe)


def _run_file(typology: Typology, gravity: float) -> RunFile:
    """The run of a typology, whose walls have one gravity."""
    levels, thresholds = typology.levels.tolist(), typology.edp_thresholds.tolist()
    stripes = {"im": typology.im, "levels": levels, "edp_thresholds": thresholds}
    solver = {"edp_limit": thresholds[-1], "gravity": gravity}
    settings: dict[str, Any] = {"job": {"task": "typology"}, "stripes": stripes, "solver": solver}
    if typology.are_alternatives:
        settings["population"] = {"designs": True}
    shape = {"walls": len(typology.walls), "levels": len(levels), "states": len(thresholds)}
    version, work = constants().version, typology.work._asdict()
    return RunFile(version, settings=settings, work=work, warnings=typology.warnings, shape=shape)


def typology_table(typology: Typology) -> TableColumns:
    """Columns of ``_typology.csv``, one block of rows a damage state."""
    groups = [group for edp in typology.edp_thresholds for group in typology.at(edp).groups]
    return typology_columns(
        [(one.mechanism, one.group) for one in groups],
        typology.im,
        typology.levels,
        [flat(one.fit) for one in groups],
        [(one.weight, one.beta_walls, one.beta_records, one.upper_asymptote, one.fitted) for one in groups],
        [np.array([one.mean_fraction, one.mean_curve, *one.level_fractiles]) for one in groups],
    )
