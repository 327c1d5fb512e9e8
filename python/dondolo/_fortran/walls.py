"""Walls, as Fortran takes them and as it has understood them."""

from __future__ import annotations

import itertools
import os
from collections.abc import Callable, Iterator, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from dondolo._base.arguments import FloatArray, argument_error, as_array, as_number, as_path
from dondolo._fortran import _core
from dondolo._fortran.buildings import BUILDING_NAMES, BUILDING_PROPERTIES
from dondolo._fortran.handles import Handle
from dondolo._fortran.library import Parcel, as_text, check, constants, properties, receive, warn_of_notes


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
    numbers: list[float] = []
    given = []
    for what in WALL_NUMBERS:
        value = values.get(what)
        own = () if value is None else value if what in WALL_LISTS else (value,)
        numbers.extend(own)
        given.append(len(own))
    return FlatWall(
        "\n".join(_words(values.get(what)) or "" for what in WALL_TEXTS).encode(),
        np.array(numbers, dtype=np.float64),
        np.array(given, dtype=np.int32),
        gravity,
    )


def _words(value: Any) -> Any:
    """Several words as one text, with a comma between two."""
    return ",".join(map(str, value)) if isinstance(value, (list, tuple)) else value


def describe_wall(values: Mapping[str, Any], gravity: Any) -> WallData:
    """Let Fortran check a wall, fill in its defaults and compute its static quantities."""
    several = {
        what: [value if what in WALL_TEXTS or what in WALL_LISTS else as_number(what, value)]
        for what, value in values.items()
        if value is not None
    }
    pull = constants().gravity if gravity is None else as_number("gravity", gravity)
    return describe_walls(1, several, [pull])[0]


def describe_walls(count: int, values: Mapping[str, Any], gravity: ArrayLike) -> list[WallData]:
    """The same for many walls: values of each property for all of them; what is None or not there gets its default."""
    known = [(i, what) for i, what in enumerate(WALL_NUMBERS) if what in values]
    columns = {what: [_values(what, value) for value in values[what]] for _, what in known}
    given = np.zeros((count, len(WALL_NUMBERS)), dtype=np.int32)
    for i, what in known:
        given[:, i] = [len(own) for own in columns[what]]
    numbers = [number for wall in range(count) for _, what in known for number in columns[what][wall]]
    nothing = [None] * count
    texts = b"\n".join(
        b"" if text is None else as_text(what, _words(text))
        for wall in zip(*(values.get(what, nothing) for what in WALL_TEXTS), strict=True)
        for what, text in zip(WALL_TEXTS, wall, strict=True)
    )
    # f2py takes no empty arrays
    sent = _core.walls.describe_walls(texts, np.array([*numbers, 0.0]), given.T, gravity)
    return unpack_walls(receive(sent))


def _values(what: str, value: Any) -> Sequence[float]:
    """Values of a property of one wall: those of a list, else one; none for None."""
    if value is None:
        return ()
    if what not in WALL_LISTS:
        return (value,)
    numbers: list[float] = as_array(what, np.atleast_1d(value)).tolist()
    return numbers


def wall_terms(wall: Handle, rotation: ArrayLike) -> FloatArray:
    """J, C, G, L, Q and V of a wall, one row each, in the shape of the rotations."""
    try:
        values, shape = np.ravel(rotation), np.shape(rotation)
    except ValueError:
        raise argument_error("not_numbers", "rotation", ": must be numbers") from None
    terms, failure = _core.walls.wall_terms(wall.number, as_array("rotation", values))
    check(failure)
    found: FloatArray = terms.T.reshape(6, *shape)
    return found


def open_anchors(wall: Handle, ties: int) -> NDArray[np.bool_]:
    """Which ties of a wall have an anchor without a strength, of shape (ties,)."""
    is_open, failure = _core.walls.open_anchors(wall.number, ties)
    check(failure)
    return np.asarray(is_open == 1)


def tie_states(wall: Handle, edp: ArrayLike, ties: int) -> tuple[FloatArray, FloatArray, NDArray[np.bool_]]:
    """Plastic elongation and energy of each tie of a wall, and whether it is broken, of shape (*edp.shape, ties)."""
    peaks = np.asarray(edp, dtype=np.float64)
    elongation, energy, broken, failure = _core.walls.tie_states(wall.number, peaks.ravel(), ties)
    check(failure)
    shape = (*peaks.shape, ties)
    return elongation.T.reshape(shape), energy.T.reshape(shape), broken.T.reshape(shape) == 1


def tie_tallies(
    wall: Handle, edp: FloatArray, ran: NDArray[np.bool_], ties: int
) -> tuple[NDArray[np.int32], FloatArray]:
    """What the histories (levels, histories) that ran do to the ties of a wall, both (2, n), n all ties of all levels.

    Integers: how many stretch it for good and break it; reals: mean and largest plastic elongation [m].
    """
    counts, elongations, failure = _core.walls.tally_ties(wall.number, edp.T, ran.T, ties)
    check(failure)
    return counts.reshape(2, -1, order="F"), elongations.reshape(2, -1, order="F")


def unpack_walls(parcel: Parcel) -> list[WallData]:
    """Walls out of a parcel."""
    words, texts = len(WALL_TEXTS), parcel["walls_texts"]
    values = iter(parcel["walls_values"].tolist())
    columns = [parcel[f"walls_{name}"].tolist() for name in ("statics", "given", "two_sided")]
    return [
        WallData(
            _named(WALL_TEXTS, texts[words * i : words * (i + 1)], WALL_WORDS)
            | {what: _value(values, what, length) for what, length in zip(WALL_NUMBERS, given, strict=True)},
            statics[0],
            tuple(statics[1:]),
            bool(two_sided),
        )
        for i, (statics, given, two_sided) in enumerate(zip(*columns, strict=True))
    ]


def _named(names: Sequence[str], texts: Sequence[str], several: Sequence[str]) -> dict[str, Any]:
    """Texts by their names; those of several words as a tuple, None where there are none."""
    found: dict[str, Any] = dict(zip(names, texts, strict=True))
    for name in several:
        found[name] = tuple(word.strip() for word in found[name].split(",")) if found[name] else None
    return found


def _value(values: Iterator[float], what: str, length: int) -> Any:
    """The next value: a number, a tuple of them for a list, None for none."""
    if length == 0:
        return None
    return tuple(itertools.islice(values, length)) if what in WALL_LISTS else next(values)


def join_walls(walls: Sequence[FlatWall]) -> FlatWall:
    """Several walls, one after the other."""
    return FlatWall(
        b"\n".join(wall.texts for wall in walls),
        # f2py takes no empty arrays
        np.concatenate([*(wall.numbers for wall in walls), [0.0]]),
        np.stack([wall.given for wall in walls]).T,
        np.array([wall.gravity for wall in walls]),
    )


def read_walls(
    path: str | os.PathLike[str], gravity: float | None, occurrence: str, noted: Callable[[str], str] = str
) -> tuple[list[WallData], dict[str, Any]]:
    """Read a population: its walls, and what `Population` has of each.

    occurrence: where the table does not say it; noted: the words of a note on how the table was read.
    """
    pull = constants().gravity if gravity is None else as_number("gravity", gravity)
    parcel = receive(_core.walls.read_walls(as_path(path), pull, as_text("occurrence", occurrence)))
    warn_of_notes(map(noted, parcel["notes"]))
    return unpack_walls(parcel), rows_of(parcel)


def rows_of(parcel: Parcel) -> dict[str, Any]:
    """What a parcel has of each row of a population besides its wall, by the names of `Population`."""
    words = {"groups": "group", "facades": "facade", "occurrence": "occurrence", "alternatives": "alternative"}
    found: dict[str, Any] = {name: tuple(parcel[f"walls_{own}"]) for name, own in words.items()}
    return found | {"weights": parcel["walls_weight"], "p_occ": parcel["walls_p_occ"]}


# What walls are made of, in Fortran's order; gravity crosses by itself
WALL_PROPERTIES = properties("wall") + BUILDING_PROPERTIES
WALL_TEXTS = tuple(row.name for row in WALL_PROPERTIES if row.kind in ("text", "words"))
WALL_NUMBERS = tuple(row.name for row in WALL_PROPERTIES if row.name not in WALL_TEXTS)
# Those that have several values, and those whose values are texts
WALL_LISTS = frozenset(row.name for row in WALL_PROPERTIES if row.kind in ("list", "words"))
WALL_WORDS = tuple(row.name for row in WALL_PROPERTIES if row.kind == "words")
# Those that only some walls have: tables show them where one of theirs has them
WALL_EXTRAS = frozenset(
    row.name for row in properties("wall") if row.default == "optional" and row.owners and row.column
) | frozenset(("restitution_sd", "restitution_seed", *BUILDING_NAMES))
# How the mechanisms of a wall occur
OCCURRENCE = next(row.choices for row in properties("row") if row.name == "occurrence")
INDEPENDENT, EXCLUSIVE = OCCURRENCE
# What stands in the place of those that are not given beside the others of their kind
WALL_ABSENT = {row.name: row.absent for row in WALL_PROPERTIES if row.absent is not None}
