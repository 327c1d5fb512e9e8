"""Walls as the columns of a table."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

from dondolo._fortran.walls import WALL_EXTRAS, WALL_LISTS, WALL_PROPERTIES
from dondolo._storage import tables
from dondolo.walls.wall import Wall, property_of


def property_columns(walls: Sequence[Wall], heads: Mapping[str, str]) -> tables.Table:
    """Columns of properties under their heads; a list has as many, numbered, as a wall has values."""
    table: tables.Table = {}
    for what, head in heads.items():
        values = [property_of(wall, what) for wall in walls]
        # The executable writes whole numbers, those of storeys, as it writes all others.
        values = [float(value) if isinstance(value, int) else value for value in values]
        if what in WALL_EXTRAS and all(value is None for value in values):
            continue
        if what not in WALL_LISTS:
            table[head] = values
            continue
        lists = [value or () for value in values]
        for i in range(max(map(len, lists))):
            table[numbered(head, i + 1)] = [value[i] if i < len(value) else None for value in lists]
    return table


def _support_columns(walls: Sequence[Wall]) -> tables.Table:
    """What walls feel of their supports; no columns where none stands on a building."""
    if all(wall.building is None for wall in walls):
        return {}
    return {
        "support_share": [None if wall.building is None else wall.support_share for wall in walls],
        "support_tilt_1_s2": [None if wall.building is None else wall.support_tilt for wall in walls],
    }


def numbered(name: str, number: int) -> str:
    """Name of one value of a list: the number stands behind its first word."""
    stem, *rest = name.split("_", 1)
    return "_".join([f"{stem}{number}", *rest])


def walls_table(
    walls: Sequence[Wall],
    weights: Iterable[float] = (1.0,),
    groups: Iterable[str] = ("",),
    p_occ: Iterable[float] = (1.0,),
    facades: Sequence[str] = (),
) -> tables.Table:
    """Columns of ``_walls.csv``; that of facades only where there are some."""

    def column(what: str) -> list[Any]:
        return [getattr(wall, what, None) for wall in walls]

    return {
        **property_columns(walls, {row.name: row.column for row in WALL_PROPERTIES if row.column}),
        "alpha_rad": column("slenderness_angle"),
        "p_rad_s": column("frequency_parameter"),
        "trigger_acceleration_m_s2": column("trigger_acceleration"),
        "capacity_rad": column("capacity_angle"),
        "restitution": column("restitution_coefficient"),
        "weight": list(weights),
        "group": list(groups),
        "p_occ": list(p_occ),
        **_support_columns(walls),
        **({"facade": list(facades)} if any(facades) else {}),
    }
