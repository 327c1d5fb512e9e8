"""Walls as the columns of a table."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING

from dondolo._fortran.walls import EXCLUSIVE, WALL_EXTRAS, WALL_LISTS, WALL_PROPERTIES
from dondolo._storage import tables
from dondolo.walls.wall import Wall, properties_of

if TYPE_CHECKING:
    from dondolo.walls.population import Population


def population_columns(population: Population) -> tables.Table:
    """Columns of a population's table, as it is read."""
    names = {row.name: row.name for row in WALL_PROPERTIES if row.column}
    table = property_columns(population.walls, names)
    table |= {"weight": population.weights, "group": population.group_names, "p_occ": population.p_occ}
    table |= {"facade": population.facades} if any(population.facades) else {}
    return table | occurrence_columns(population.occurrence, population.alternatives) | dict(population.notes)


def property_columns(walls: Sequence[Wall], heads: Mapping[str, str]) -> tables.Table:
    """Columns of properties under their heads; a list has as many, numbered, as a wall has values."""
    table: tables.Table = {}
    for what, head in heads.items():
        values = properties_of(walls, what)
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


def numbered(name: str, number: int) -> str:
    """Name of one value of a list: the number stands behind its first word."""
    stem, *rest = name.split("_", 1)
    return "_".join([f"{stem}{number}", *rest])


def occurrence_columns(occurrence: Sequence[str], alternatives: Sequence[str]) -> tables.Table:
    """How the mechanisms of each wall occur; no columns where all are independent."""
    if EXCLUSIVE not in occurrence:
        return {}
    return {"occurrence": list(occurrence), "alternative": list(alternatives)}
