"""Walls, as Fortran takes them and as it has understood them."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from dondolo._base.arguments import FloatArray, as_array, as_number, as_path, as_text
from dondolo._fortran import _core
from dondolo._fortran.handles import Handle
from dondolo._fortran.library import Parcel, check, constants, properties, receive, warn_of_notes
from dondolo.errors import InputError


class FlatWall(NamedTuple):
    """A wall, or several, as Fortran takes them."""

    texts: bytes
    numbers: FloatArray
    given: NDArray[np.int32]
    gravity: Any


class WallData(NamedTuple):
    """A wall as Fortran has understood it."""

    properties: dict[str, Any]
    gravity: float
    statics: tuple[float, ...]
    two_sided: bool


def flat_wall(values: Mapping[str, Any], gravity: float) -> FlatWall:
    """A wall as Fortran takes it, of properties that it has checked."""
    numbers = [values.get(what) for what in WALL_NUMBERS]
    return FlatWall(
        "\n".join(values.get(what) or "" for what in WALL_TEXTS).encode(),
        np.array([0.0 if value is None else value for value in numbers]),
        np.array([value is not None for value in numbers], dtype=np.int32),
        gravity,
    )


def describe_wall(values: Mapping[str, Any], gravity: Any) -> WallData:
    """Let Fortran check a wall, fill in its defaults and compute its static quantities."""
    several = {
        what: [value if what in WALL_TEXTS else as_number(what, value)]
        for what, value in values.items()
        if value is not None
    }
    pull = constants().gravity if gravity is None else as_number("gravity", gravity)
    return describe_walls(1, several, [pull])[0]


def describe_walls(count: int, values: Mapping[str, Any], gravity: ArrayLike) -> list[WallData]:
    """The same for many walls: values of each property for all of them; what is None or not there gets its default."""
    shape = (count, len(WALL_NUMBERS))
    numbers, given = np.zeros(shape), np.zeros(shape, dtype=np.int32)
    for i, what in enumerate(WALL_NUMBERS):
        if what in values:
            given[:, i] = [value is not None for value in values[what]]
            numbers[:, i] = [0.0 if value is None else value for value in values[what]]
    nothing = [None] * count
    texts = b"\n".join(
        b"" if text is None else as_text(what, text)
        for wall in zip(*(values.get(what, nothing) for what in WALL_TEXTS), strict=True)
        for what, text in zip(WALL_TEXTS, wall, strict=True)
    )
    return unpack_walls(receive(*_core.walls.describe_walls(texts, numbers.T, given.T, gravity)), count)


def wall_terms(wall: Handle, rotation: ArrayLike) -> FloatArray:
    """J, C, G, L, Q and V of a wall, one row each, in the shape of the rotations."""
    try:
        values, shape = np.ravel(rotation), np.shape(rotation)
    except ValueError:
        raise InputError("rotation: must be numbers") from None
    terms, stat, message = _core.walls.wall_terms(wall.number, as_array("rotation", values))
    check(stat, message)
    found: FloatArray = terms.T.reshape(6, *shape)
    return found


def unpack_walls(parcel: Parcel, count: int, reals: int = 0, integers: int = 0, lines: int = 0) -> list[WallData]:
    """Walls out of a parcel, from given places on."""
    known, words = len(WALL_NUMBERS), len(WALL_TEXTS)
    rows = parcel.reals[reals : reals + count * _WALL_REALS].reshape(count, _WALL_REALS).tolist()
    masks = parcel.integers[integers : integers + count * _WALL_INTEGERS].reshape(count, _WALL_INTEGERS).tolist()
    return [
        WallData(
            dict(zip(WALL_TEXTS, parcel.lines[lines + words * i : lines + words * (i + 1)], strict=True))
            | {what: row[k] if given[k] else None for k, what in enumerate(WALL_NUMBERS)},
            row[known],
            tuple(row[known + 1 :]),
            bool(given[known]),
        )
        for i, (row, given) in enumerate(zip(rows, masks, strict=True))
    ]


def walls_end(count: int) -> tuple[int, int, int]:
    """How many reals, integers and lines of a parcel so many walls take."""
    return count * _WALL_REALS, count * _WALL_INTEGERS, len(WALL_TEXTS) * count


def join_walls(walls: Sequence[FlatWall]) -> FlatWall:
    """Several walls, one after the other."""
    return FlatWall(
        b"\n".join(wall.texts for wall in walls),
        np.stack([wall.numbers for wall in walls]).T,
        np.stack([wall.given for wall in walls]).T,
        np.array([wall.gravity for wall in walls]),
    )


def read_walls(
    path: str | os.PathLike[str], gravity: float | None
) -> tuple[list[WallData], FloatArray, list[str], FloatArray]:
    """Read a population: its walls, their weights and groups, and the probabilities of their mechanisms."""
    pull = constants().gravity if gravity is None else as_number("gravity", gravity)
    parcel = receive(*_core.walls.read_walls(as_path(path), pull))
    count = len(parcel.integers) // _WALL_INTEGERS
    weights, p_occ = parcel.reals[count * _WALL_REALS :].reshape(2, count)
    groups = len(WALL_TEXTS) * count
    warn_of_notes(parcel.lines[groups + count :])
    return unpack_walls(parcel, count), weights, parcel.lines[groups : groups + count], p_occ


# What walls are made of, in Fortran's order; gravity crosses by itself
WALL_PROPERTIES = properties("wall")


WALL_TEXTS = tuple(row.name for row in WALL_PROPERTIES if row.kind == "text")


WALL_NUMBERS = tuple(row.name for row in WALL_PROPERTIES if row.kind != "text")


_WALL_REALS = len(WALL_NUMBERS) + 7


_WALL_INTEGERS = len(WALL_NUMBERS) + 1
