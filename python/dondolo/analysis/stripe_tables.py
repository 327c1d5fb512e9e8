"""Tables of stripes, as the executable has them, and the set of files that they make."""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
from numpy.typing import ArrayLike

from dondolo._fortran.library import constants
from dondolo._fortran.records import unit_of
from dondolo._fortran.tables import TableColumns, history_columns, stripe_columns
from dondolo._storage.result_set import write_set
from dondolo._storage.run_file import RunFile, sources_of_fits
from dondolo.analysis.stripe_fits import States, fit_warnings, thresholds_of
from dondolo.curves.table import fragility_table
from dondolo.errors import silent
from dondolo.walls.ties import number_of_ties, tie_table
from dondolo.walls.wall import walls_table

if TYPE_CHECKING:
    from dondolo.analysis.stripes import Stripes

# Code of the warning of damage states that are reached while the joints of a strip are closed
_WHILE_CLOSED = "threshold_while_closed"
#: Names of the tables
TableName = Literal["histories", "stripes", "walls"]

# Columns that stripes have as matrices, or not at all
_COLUMNS = (
    *("scale", "edp", "time_of_peak", "collapsed", "impacts"),
    *("edp_error", "status", "edp_lowest", "edp_highest", "edp_rounded", "uplift"),
)


def histories_table(stripes: Stripes) -> TableColumns:
    """Columns of ``_histories.csv``."""
    ran = stripes.ran
    level, history = np.nonzero(ran)

    def of_rows(values: Any) -> Any:
        return np.zeros(len(level)) if values is None else values[ran]

    columns = {name: of_rows(getattr(stripes, name)) for name in _COLUMNS} | {
        "record": stripes.record_index[history] + 1,
        "polarity": stripes.polarity[history],
        "level": stripes.levels[level],
    }
    texts = (stripes.wall.name, stripes.wall.mechanism, *stripes.record_names[: stripes.n_records])
    has = {
        "has_errors": stripes.edp_error is not None,
        "has_certificates": stripes.status is not None,
        "has_uplifts": stripes.uplift is not None,
    }
    return history_columns(texts, stripes.im, columns, has)


def tables_of(stripes: Stripes) -> dict[TableName, Callable[[], TableColumns]]:
    """What makes each table of stripes."""
    return {
        "histories": lambda: histories_table(stripes),
        "stripes": lambda: stripes_table(stripes, [stripes.edp_limit]),
        "walls": lambda: walls_table((stripes.wall,)),
    }


def comments_of(stripes: Stripes) -> list[str]:
    """Head of a table in a file."""
    numbers = f"rtol = {stripes.rtol!r}, atol = {stripes.atol!r}, edp_limit = {stripes.edp_limit!r}"
    return [
        repr(stripes.wall),
        f"engine = '{stripes.engine}', {numbers}",
        f"unit of im_level: {unit_of(stripes.im) or '1'}",
    ]


def stripes_table(stripes: Stripes, edp_thresholds: Sequence[float]) -> TableColumns:
    """Columns of ``_stripes.csv``."""
    reached = np.array([stripes.exceedances(edp) for edp in edp_thresholds])[:, :, None]
    wall = [(stripes.wall.name, stripes.wall.mechanism)]
    sizes = stripes.histories[:, None]
    return stripe_columns(wall, stripes.im, stripes.levels, np.array(edp_thresholds), sizes, reached, stripes.uplifts)


def write_stripes(
    stripes: Stripes,
    prefix: str | os.PathLike[str],
    edp_thresholds: ArrayLike | None,
    states: States,
    spreadsheet_safe: bool,
) -> None:
    """Write all tables, with the curves of damage states: see `Stripes.write_results`."""
    levels = [stripes.edp_limit] if edp_thresholds is None else thresholds_of(stripes, edp_thresholds)
    with silent():
        curves = stripes.fit_damage_states(levels, states=states)
        of_collapse = curves[-1] if states == "ordinal" else stripes.fit()
    found = {
        "_walls.csv": walls_table((stripes.wall,)),
        "_histories.csv": histories_table(stripes),
        "_stripes.csv": stripes_table(stripes, levels),
        "_fragility.csv": fragility_table([stripes.wall] * len(curves), curves),
    }
    if number_of_ties(stripes.wall):
        sizes = stripes.histories[:, None]
        found["_ties.csv"] = tie_table((stripes.wall,), stripes.im, stripes.levels, (stripes.ties,), sizes)
    names = stripes.record_names[: stripes.n_records]
    facts = (
        one or ("",) * stripes.n_records for one in (names, stripes.events, stripes.checksums, stripes.record_formats)
    )
    of_states = (one for curve in curves[:-1] for one in fit_warnings(stripes, curve) if one.code == _WHILE_CLOSED)
    run = RunFile(
        constants().version,
        settings={
            "job": {"task": "stripes"},
            "stripes": {
                "im": stripes.im,
                "levels": stripes.levels.tolist(),
                "edp_thresholds": levels,
                "states": states,
            },
            "solver": {
                "engine": stripes.engine,
                "rtol": stripes.rtol,
                "atol": stripes.atol,
                "edp_limit": stripes.edp_limit,
                "gravity": stripes.wall.gravity,
            },
        },
        records=tuple(
            {"name": name, "event": event, "checksum": checksum} | ({"format": form} if form else {})
            for name, event, checksum, form in zip(*facts, strict=True)
        ),
        work=stripes.work._asdict(),
        warnings=(*stripes.warnings, *of_states, *fit_warnings(stripes, of_collapse)),
        shape={"walls": 1, "levels": len(stripes.levels), "states": len(levels), "records": stripes.n_records},
    )
    used = sources_of_fits(stripes.im, (stripes.wall,)) | {stripes.engine, states, *stripes.record_formats}
    write_set(prefix, found, run.citing(*used), spreadsheet_safe=spreadsheet_safe)
