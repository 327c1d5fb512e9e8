"""Tables: the executable's CSV files, column by column and digit by digit, and pandas where it is installed."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from dondolo import _binding
from dondolo._arguments import FloatArray
from dondolo._files import whole_file
from dondolo.errors import DondoloError, InputError

if TYPE_CHECKING:
    from dondolo.fragility import Fragility
    from dondolo.motion import Response
    from dondolo.population import Population
    from dondolo.stripes import Stripes
    from dondolo.typology import Typology
    from dondolo.walls import Wall

Table = dict[str, Sequence[Any]]


def digits(value: float) -> str:
    """A number with 17 significant digits, as the executable writes it."""
    return f"{value:.16E}"


def shortest(value: float) -> str:
    """A number with as few digits as tell it from all others: for tables that people read and change."""
    return repr(float(value)).removesuffix(".0")


def cell(value: Any, number: Callable[[float], str] = digits) -> str:
    """A value as it stands in a table: flags 0/1, empty where there is none."""
    if value is None:
        return ""
    if isinstance(value, str):
        return quoted(value)
    if isinstance(value, (bool, np.bool_)):
        return str(int(value))
    if isinstance(value, (int, np.integer)):
        return str(value)
    return "" if np.isnan(value) else number(value)


def quoted(text: str) -> str:
    """A text as a cell: in quotes where RFC 4180 asks for them, or where a # or blanks would be lost."""
    if any(character in text for character in ',"#\n\r') or text != text.strip():
        return '"' + text.replace('"', '""') + '"'
    return text


def write_csv(path: str | os.PathLike[str], table: Table, comments: Iterable[str] = ()) -> None:
    """Write a table; it appears whole or not at all.

    Parameters
    ----------
    path : path
        The file; its folder must exist.
    table : dict
        Columns of equal length.
    comments : iterable of str
        Lines for the head of the file.
    """
    write_lines(path, csv_lines(table, [f"dondolo {_binding.constants().version}", *comments]))


def csv_lines(table: Table, comments: Iterable[str], number: Callable[[float], str] = digits) -> list[str]:
    """Lines of a table: comments, names of the columns, rows."""
    lines = [*(f"# {comment}" for comment in comments), ",".join(table)]
    return lines + [",".join(cell(value, number) for value in row) for row in zip(*table.values(), strict=True)]


def write_lines(path: str | os.PathLike[str], lines: Sequence[str]) -> None:
    """Write a text file; it appears whole or not at all."""
    with whole_file(path) as part:
        part.write_text("\n".join(lines) + "\n", encoding="utf-8")


def frame(table: Table) -> Any:
    """A table as a pandas DataFrame."""
    try:
        import pandas as pd
    except ImportError:
        raise DondoloError("pandas is not installed: pip install 'dondolo[tables]'; CSV files need no pandas") from None
    return pd.DataFrame(table)


def walls_table(
    walls: Sequence[Wall],
    weights: Iterable[float] = (1.0,),
    groups: Iterable[str] = ("",),
    p_occ: Iterable[float] = (1.0,),
) -> Table:
    """Columns of ``_walls.csv``."""

    def column(what: str) -> list[Any]:
        return [getattr(wall, what, None) for wall in walls]

    return {
        **{row.column: column(row.name) for row in _binding.WALL_PROPERTIES if row.column},
        "alpha_rad": column("slenderness_angle"),
        "p_rad_s": column("frequency_parameter"),
        "trigger_acceleration_m_s2": column("trigger_acceleration"),
        "capacity_rad": column("capacity_angle"),
        "restitution": column("restitution_coefficient"),
        "weight": list(weights),
        "group": list(groups),
        "p_occ": list(p_occ),
    }


def population_table(population: Population) -> Table:
    """Columns of a population's table, as it is read."""
    names = [row.name for row in _binding.WALL_PROPERTIES if row.column]
    table: Table = {name: [getattr(wall, name, None) for wall in population.walls] for name in names}
    return table | {"weight": population.weights, "group": population.groups, "p_occ": population.p_occ}


def history_table(response: Response) -> Table:
    """Columns of ``_history.csv``."""
    return {
        "time_s": response.time,
        "ground_acceleration_m_s2": response.ground_acceleration,
        "rotation_rad": response.rotation,
        "velocity_rad_s": response.velocity,
        "edp": np.abs(response.rotation) / response.wall.capacity_angle,
        "side": np.asarray(response.side, dtype=int),
        "after_impact": np.asarray(response.after_impact, dtype=int),
    }


def histories_table(stripes: Stripes) -> Table:
    """Columns of ``_histories.csv``."""
    levels, histories = stripes.edp.shape
    polarity = ["reversed" if sign < 0 else "as_recorded" for sign in stripes.polarity]
    table: Table = {
        "wall": [stripes.wall.name] * stripes.edp.size,
        "mechanism": [stripes.wall.mechanism] * stripes.edp.size,
        "record": list(stripes.record_names) * levels,
        "polarity": polarity * levels,
        "im": [stripes.im] * stripes.edp.size,
        "im_level": np.repeat(stripes.levels, histories),
        "scale": stripes.scale.ravel(),
        "edp": stripes.edp.ravel(),
        "collapsed": stripes.collapsed.ravel().astype(int),
        "impacts": stripes.impacts.ravel(),
        "time_of_peak_s": stripes.time_of_peak.ravel(),
    }
    if stripes.edp_error is not None:
        table["edp_error"] = stripes.edp_error.ravel()
    return table


def stripes_table(
    walls: Sequence[Wall],
    im: str,
    levels: FloatArray,
    edp_thresholds: Sequence[float],
    exceedances: np.ndarray[Any, Any],
    histories: Sequence[int],
) -> Table:
    """Columns of ``_stripes.csv``; exceedances are (thresholds, levels, walls)."""
    states, number = len(edp_thresholds), len(levels)
    counts = exceedances.transpose(2, 0, 1).ravel()
    sizes = np.repeat(np.asarray(histories), states * number)
    return {
        "wall": [wall.name for wall in walls for _ in range(states * number)],
        "mechanism": [wall.mechanism for wall in walls for _ in range(states * number)],
        "im": [im] * len(counts),
        "im_level": np.tile(levels, states * len(walls)),
        "histories": sizes,
        "collapses": counts,
        "fraction": counts / sizes,
        "edp_threshold": np.tile(np.repeat(np.asarray(edp_thresholds), number), len(walls)),
    }


def fragility_table(walls: Sequence[Wall | None], curves: Sequence[Fragility]) -> Table:
    """Columns of ``_fragility.csv``."""
    return {
        "wall": [wall.name if wall else "" for wall in walls],
        "mechanism": [wall.mechanism if wall else "" for wall in walls],
        "im": [curve.im for curve in curves],
        "theta": [curve.theta for curve in curves],
        "beta": [curve.beta for curve in curves],
        "se_ln_theta": [curve.se_ln_theta for curve in curves],
        "se_beta": [curve.se_beta for curve in curves],
        "log_likelihood": [curve.log_likelihood for curve in curves],
        "status": [curve.status for curve in curves],
        "bracket_low": [curve.bracket[0] if curve.bracket[0] > 0.0 else None for curve in curves],
        "bracket_high": [curve.bracket[1] if np.isfinite(curve.bracket[1]) else None for curve in curves],
        "edp_threshold": [curve.edp for curve in curves],
    }


def typology_table(typology: Typology) -> Table:
    """Columns of ``_typology.csv``, one block of rows a damage state."""
    blocks = [_typology_of(typology.at(edp)) for edp in typology.edp_thresholds]
    return {name: [value for block in blocks for value in block[name]] for name in blocks[0]}


def _typology_of(typology: Typology) -> Table:
    """Columns of ``_typology.csv`` of one damage state."""
    number, groups = len(typology.levels), typology.groups

    def repeated(values: Iterable[Any]) -> list[Any]:
        return [value for value in values for _ in range(number)]

    return {
        "mechanism": repeated(group.mechanism for group in groups),
        "im": [typology.im] * (number * len(groups)),
        "im_level": np.tile(typology.levels, len(groups)),
        "weight": repeated(group.weight for group in groups),
        "mean_fraction": np.concatenate([group.mean_fraction for group in groups]),
        "mean_curve": np.concatenate([group.mean_curve for group in groups]),
        "theta": repeated(group.fit.theta for group in groups),
        "beta": repeated(group.fit.beta for group in groups),
        "status": repeated(group.fit.status for group in groups),
        "group": repeated(group.group for group in groups),
        "fractile_16": np.concatenate([group.fractiles[0] for group in groups]),
        "fractile_50": np.concatenate([group.fractiles[1] for group in groups]),
        "fractile_84": np.concatenate([group.fractiles[2] for group in groups]),
        "beta_walls": repeated(group.beta_walls for group in groups),
        "beta_records": repeated(group.beta_records for group in groups),
        "saturation": repeated(group.saturation for group in groups),
        "edp_threshold": [typology.edp_thresholds[-1]] * (number * len(groups)),
    }


def choose(tables: Mapping[str, Any], name: str) -> Table:
    """One of several tables of an object, made when it is asked for."""
    if name not in tables:
        raise InputError(f"table = {name!r}: must be one of {', '.join(map(repr, tables))}")
    return tables[name]()
