"""The tables of a chain as files that cases and tables of walls name: bodies, joints, what acts on them, and ties."""

from __future__ import annotations

import os
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from dondolo._base.arguments import FloatArray, argument_error
from dondolo._storage.tables import Table, csv_lines, shortest, write_lines
from dondolo.walls.chain_actions import INERTIAS
from dondolo.walls.chain_parts import MASS, SECTOR

if TYPE_CHECKING:
    from dondolo.walls.chains import ChainWall

# Depths and heights below this are roundings of zero / height
_ZERO = 1e-12
# Words of the parts of a load that are lifted and pushed
_WORDS = {parts: word for word, parts in INERTIAS.items()}


def write_tables(wall: ChainWall, prefix: str | os.PathLike[str]) -> tuple[Path, ...]:
    """Write the files of a chain: what begins with a prefix; they have all digits, but roundings of zero are 0."""
    least = _ZERO * float(wall.height)
    tables = {
        "bodies": _bodies(_zeros(wall._rows("body_table"), [5, 6], least)),
        "joints": _joints(_zeros(wall._rows("joint_table"), [3, 4, 6, 7], least)),
        "actions": _actions(_zeros(wall._rows("action_table"), [1, 2], least)),
        "ties": _ties(_zeros(wall._rows("tie_table"), [2, 3, 5, 6], least)),
    }
    paths = []
    for name, table in tables.items():
        if not len(table["body"]):
            continue
        paths.append(Path(f"{os.fspath(prefix)}_{name}.csv"))
        write_lines(paths[-1], csv_lines(table, (), shortest))
    return tuple(paths)


def _zeros(rows: FloatArray, places: list[int], least: float) -> FloatArray:
    """Rows whose depths and heights are 0 where they are less than a rounding of it."""
    rows = rows.copy()
    rows[:, places] = np.where(np.abs(rows[:, places]) < least, 0.0, rows[:, places])
    return rows


def _numbers(values: FloatArray) -> list[int]:
    return [int(value) for value in values]


def _bodies(rows: FloatArray) -> Table:
    """Rows of bodies: corners, masses and sectors have columns of their own."""

    def of(kind: int, place: int) -> list[float | None]:
        return [float(row[place]) if row[2] == kind else None for row in rows]

    return {
        "body": _numbers(rows[:, 0]),
        "part": _numbers(rows[:, 1]),
        "width [m]": [None if row[2] == MASS else float(row[3]) for row in rows],
        "density [kg/m3]": [None if row[2] == MASS else float(row[4]) for row in rows],
        "depth [m]": rows[:, 5] + 0.0,
        "height [m]": rows[:, 6] + 0.0,
        "mass [kg]": of(MASS, 7),
        "inertia [kg m2]": of(MASS, 8),
        "inner [m]": of(SECTOR, 7),
        "outer [m]": of(SECTOR, 8),
        "from [deg]": of(SECTOR, 9),
        "to [deg]": of(SECTOR, 10),
    }


def _joints(rows: FloatArray) -> Table:
    """Rows of joints: the point of the other body only where it is another one."""
    is_other = [bool((row[3:5] != row[6:8]).any()) for row in rows]
    for other, row in zip(is_other, rows, strict=True):
        if other and not row[6:8].any():
            raise argument_error(
                "out_of_range", "other_at", " = (0, 0): a file has no word for this point; move the origin"
            )
    return {
        "type": ["pin" if row[0] == 2.0 else "guide" for row in rows],
        "body": _numbers(rows[:, 1]),
        "other": _numbers(rows[:, 2]),
        "depth [m]": rows[:, 3] + 0.0,
        "height [m]": rows[:, 4] + 0.0,
        "angle [deg]": rows[:, 5] + 0.0,
        "other_depth [m]": [float(row[6]) if other else None for other, row in zip(is_other, rows, strict=True)],
        "other_height [m]": [float(row[7]) if other else None for other, row in zip(is_other, rows, strict=True)],
    }


def _actions(rows: FloatArray) -> Table:
    """Rows of actions."""
    words = []
    for row in rows:
        moved = (float(row[4]), float(row[5]))
        if moved not in _WORDS:
            raise argument_error("not_a_word", "inertia", f": a file has no word for parts {moved} of a load that move")
        words.append(_WORDS[moved] if row[3] > 0.0 else "none")
    return {
        "body": _numbers(rows[:, 0]),
        "depth [m]": rows[:, 1] + 0.0,
        "height [m]": rows[:, 2] + 0.0,
        "load [N]": rows[:, 3],
        "inertia": words,
        "held": ["yes" if row[9] > 0.0 else "no" for row in rows],
        "mass [kg]": rows[:, 6],
        "thrust [N]": rows[:, 7],
        "angle [deg]": rows[:, 8],
    }


def _ties(rows: FloatArray) -> Table:
    """Rows of ties: of one to the ground its other anchor is not known."""

    def of_two(place: int) -> list[float | None]:
        return [float(row[place]) if row[1] > 0.0 else None for row in rows]

    return {
        "body": _numbers(rows[:, 0]),
        "other": _numbers(rows[:, 1]),
        "depth [m]": rows[:, 2] + 0.0,
        "height [m]": rows[:, 3] + 0.0,
        "angle [deg]": rows[:, 4] + 0.0,
        "other_depth [m]": of_two(5),
        "other_height [m]": of_two(6),
        "area [m2]": rows[:, 7],
        "length [m]": rows[:, 8],
        "modulus [Pa]": rows[:, 9],
        "strength [Pa]": rows[:, 10],
        "preload [Pa]": rows[:, 11],
        "strain": rows[:, 12],
        "anchor_force [N]": [float(force) if force > 0.0 else None for force in rows[:, 13]],
    }
