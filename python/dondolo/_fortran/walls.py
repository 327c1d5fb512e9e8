"""Walls, as Fortran takes them and as it has understood them."""

from __future__ import annotations

import itertools
import os
from collections.abc import Callable, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from dondolo._base.arguments import FloatArray, argument_error, as_array, as_flag, as_number, as_path, refuse_units
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
        what: [
            value
            if what in WALL_TEXTS or what in WALL_LISTS
            else float(as_flag(what, value))
            if what in WALL_FLAGS
            else as_number(what, value)
        ]
        for what, value in values.items()
        if value is not None
    }
    pull = constants().gravity if gravity is None else as_number("gravity", gravity)
    return describe_walls(1, several, [pull])[0]


def describe_walls(count: int, values: Mapping[str, Any], gravity: ArrayLike) -> WallTable:
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
    refuse_units(what, value)
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


def chain_motion(wall: Handle, rotation: ArrayLike, bodies: int) -> FloatArray:
    """Positions x, y and phi of the bodies of a chain, in the shape of the rotations, then bodies, then 3."""
    values, shape = np.ravel(rotation), np.shape(rotation)
    positions, failure = _core.walls.chain_motion(wall.number, as_array("rotation", values), bodies)
    check(failure)
    found: FloatArray = positions.T.reshape(*shape, bodies, 3)
    return found


class ChainFacts(NamedTuple):
    """What is known of the sides and of the impact of a chain.

    Attributes
    ----------
    outwards, inwards : float
        Multipliers; huge if it moves to one side, or inwards as its mirror image.
    bound : float
        Upper bound of the restitution; huge if it is not known.
    is_mirrored, is_image : bool
        Whether it moves inwards as its mirror image, and whether all of its masonry is one.
    """

    outwards: float
    inwards: float
    bound: float
    is_mirrored: bool
    is_image: bool


def chain_facts(wall: Handle) -> ChainFacts:
    """What is known of the sides and of the impact of a chain."""
    numbers, failure = _core.walls.chain_facts(wall.number)
    check(failure)
    outwards, inwards, bound, mirrored, image = map(float, numbers)
    return ChainFacts(outwards, inwards, bound, mirrored > 0.0, image > 0.0)


def chain_rows(wall: Handle, table: int) -> FloatArray:
    """Numbers of the rows of a chain, one after the other: of its bodies (1), joints (2), actions (3) or ties (4)."""
    # f2py takes no empty arrays
    room = 1
    while True:
        numbers, count, failure = _core.walls.chain_rows(wall.number, table, room)
        check(failure)
        if count <= room:
            found: FloatArray = numbers[:count]
            return found
        room = count


def bending_period(wall: Handle, modulus: float) -> float:
    """Period of a strip between pinned ends [s], of a modulus of elasticity [Pa]; huge if its load buckles it."""
    period, failure = _core.walls.bending_period(wall.number, modulus)
    check(failure)
    return float(period)


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


class WallTable:
    """Walls as Fortran has understood them, as columns: a property takes room where a wall has it.

    Parameters
    ----------
    statics : ndarray, shape (walls, quantities)
        Gravity and the static quantities.
    two_sided : ndarray of bool, shape (walls,)
    texts : mapping of str to sequence
        Texts of each wall, '' for none.
    numbers : mapping of str to ndarray
        Numbers of each wall, NaN for none; a property that no wall has is left out.
    lists : mapping of str to (ndarray, ndarray)
        Values of all walls, and how many each wall has; likewise.
    """

    __slots__ = ("_ends", "lists", "numbers", "statics", "texts", "two_sided")

    def __init__(
        self,
        statics: FloatArray,
        two_sided: NDArray[np.bool_],
        texts: Mapping[str, Sequence[str]],
        numbers: Mapping[str, FloatArray],
        lists: Mapping[str, tuple[FloatArray, NDArray[np.int32]]],
    ) -> None:
        self.statics, self.two_sided = statics, two_sided
        self.texts, self.numbers, self.lists = texts, numbers, lists
        self._ends: dict[str, NDArray[np.intp]] = {}

    def __len__(self) -> int:
        return len(self.statics)

    def __getstate__(self) -> tuple[Any, ...]:
        return self.statics, self.two_sided, self.texts, self.numbers, self.lists

    def __setstate__(self, state: tuple[Any, ...]) -> None:
        self.__init__(*state)  # type: ignore[misc]

    def column(self, what: str) -> list[Any]:
        """A property of all walls: a text, a number or a tuple, None where a wall does not have it."""
        if what in WALL_WORDS:
            return [tuple(word.strip() for word in own.split(",")) if own else None for own in self.texts[what]]
        if what in WALL_TEXTS:
            return [own or None for own in self.texts[what]]
        if what in self.lists:
            return [self._list(what, i) for i in range(len(self))]
        if what not in self.numbers:
            return [None] * len(self)
        return [None if one != one else one for one in self.numbers[what].tolist()]

    def _list(self, what: str, i: int) -> tuple[float, ...] | None:
        values, counts = self.lists[what]
        if what not in self._ends:
            self._ends[what] = np.cumsum(counts)
        end = int(self._ends[what][i])
        own = values[end - int(counts[i]) : end].tolist()
        return tuple(own) if own else None

    def __getitem__(self, i: int) -> WallData:
        """The wall of a row."""
        properties: dict[str, Any] = dict.fromkeys(WALL_NUMBERS)
        properties |= {what: texts[i] for what, texts in self.texts.items()}
        for what in WALL_WORDS:
            own = properties[what]
            properties[what] = tuple(word.strip() for word in own.split(",")) if own else None
        properties |= {what: self._list(what, i) for what in self.lists}
        for what, values in self.numbers.items():
            value = float(values[i])
            if value == value:
                properties[what] = bool(value) if what in WALL_FLAGS else value
        gravity, *statics = self.statics[i].tolist()
        return WallData(properties, gravity, tuple(statics), bool(self.two_sided[i]))

    def take(self, rows: NDArray[np.intp]) -> WallTable:
        """The walls of some rows."""
        lists = {}
        for what, (values, counts) in self.lists.items():
            own = counts[rows]
            first = (np.cumsum(counts) - counts)[rows]
            lists[what] = values[np.repeat(first - (np.cumsum(own) - own), own) + np.arange(own.sum())], own
        chosen = rows.tolist()
        texts = {what: tuple(own[i] for i in chosen) for what, own in self.texts.items()}
        numbers = {what: values[rows] for what, values in self.numbers.items()}
        return WallTable(self.statics[rows], self.two_sided[rows], texts, numbers, lists)

    @classmethod
    def join(cls, tables: Sequence[WallTable]) -> WallTable:
        """Walls of several tables, one after the other."""
        nothing = np.empty(0)
        numbers = {
            what: np.concatenate([one.numbers.get(what, np.full(len(one), np.nan)) for one in tables])
            for what in dict.fromkeys(what for one in tables for what in one.numbers)
        }
        lists = {}
        for what in dict.fromkeys(what for one in tables for what in one.lists):
            parts = [one.lists.get(what, (nothing, np.zeros(len(one), dtype=np.int32))) for one in tables]
            values, counts = zip(*parts, strict=True)
            lists[what] = np.concatenate(values), np.concatenate(counts)
        return cls(
            np.concatenate([one.statics for one in tables]),
            np.concatenate([one.two_sided for one in tables]),
            {what: tuple(itertools.chain.from_iterable(one.texts[what] for one in tables)) for what in WALL_TEXTS},
            numbers,
            lists,
        )

    @property
    def flat(self) -> FlatWall:
        """The walls as Fortran takes them."""
        given = np.zeros((len(self), len(WALL_NUMBERS)), dtype=np.int32)
        columns = {what: ~np.isnan(values) for what, values in self.numbers.items()}
        columns |= {what: counts for what, (_, counts) in self.lists.items()}
        for i, what in enumerate(WALL_NUMBERS):
            if what in columns:
                given[:, i] = columns[what]
        first = np.cumsum(given).reshape(given.shape) - given
        # f2py takes no empty arrays
        numbers = np.zeros(int(given.sum()) + 1)
        for i, what in enumerate(WALL_NUMBERS):
            if what in self.numbers:
                there = columns[what]
                numbers[first[there, i]] = self.numbers[what][there]
            elif what in self.lists:
                values, counts = self.lists[what]
                numbers[np.repeat(first[:, i] - (np.cumsum(counts) - counts), counts) + np.arange(len(values))] = values
        texts = "\n".join(itertools.chain.from_iterable(zip(*(self.texts[what] for what in WALL_TEXTS), strict=True)))
        return FlatWall(texts.encode(), numbers, given.T, np.ascontiguousarray(self.statics[:, 0]))


def shared(texts: Sequence[str]) -> tuple[str, ...]:
    """Texts of which those that are alike are one."""
    known: dict[str, str] = {}
    return tuple(known.setdefault(text, text) for text in texts)


def unpack_walls(parcel: Parcel) -> WallTable:
    """Walls out of a parcel."""
    words, texts, given = len(WALL_TEXTS), parcel["walls_texts"], parcel["walls_given"]
    values, numbers, lists = parcel["walls_values"], {}, {}
    of_walls = given.sum(axis=1)
    # Where the next values of each wall are
    first = np.cumsum(of_walls) - of_walls
    for what, counts in zip((WALL_NUMBERS[i] for i in parcel["walls_numbers"]), given.T, strict=True):
        if what in WALL_LISTS:
            before = np.cumsum(counts) - counts
            lists[what] = values[np.repeat(first - before, counts) + np.arange(counts.sum())], counts.copy()
        else:
            numbers[what] = np.where(counts > 0, values[np.minimum(first, len(values) - 1)], np.nan)
        first = first + counts
    return WallTable(
        parcel["walls_statics"].copy(),
        parcel["walls_two_sided"] == 1,
        {what: shared(texts[i::words]) for i, what in enumerate(WALL_TEXTS)},
        numbers,
        lists,
    )


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
) -> tuple[WallTable, dict[str, Any]]:
    """Read a population: its walls, and what `Population` has of each.

    occurrence: where the table does not say it; noted: the words of a note on how the table was read.
    """
    pull = constants().gravity if gravity is None else as_number("gravity", gravity)
    parcel = receive(_core.walls.read_walls(as_path(path), pull, as_text("occurrence", occurrence)))
    warn_of_notes(map(noted, parcel["notes"]))
    return unpack_walls(parcel), rows_of(parcel)


def rows_of(parcel: Parcel) -> dict[str, Any]:
    """What a parcel has of each row of a population besides its wall, by the names of `Population`."""
    words = {"group_names": "group", "facades": "facade", "occurrence": "occurrence", "alternatives": "alternative"}
    found: dict[str, Any] = {name: shared(parcel[f"walls_{own}"]) for name, own in words.items()}
    names, notes = parcel["walls_note_names"], parcel["walls_notes"]
    found["notes"] = {name: shared(notes[i :: len(names)]) for i, name in enumerate(names)}
    return found | {"weights": parcel["walls_weight"].copy(), "p_occ": parcel["walls_p_occ"].copy()}


def is_note(column: str) -> bool:
    """Is a column of a table of walls one that is kept as it stands?"""
    return column.lower().startswith(constants().notes)


# What walls are made of, in Fortran's order; gravity crosses by itself
WALL_PROPERTIES = properties("wall") + BUILDING_PROPERTIES
WALL_TEXTS = tuple(row.name for row in WALL_PROPERTIES if row.kind in ("text", "words"))
WALL_NUMBERS = tuple(row.name for row in WALL_PROPERTIES if row.name not in WALL_TEXTS)
# Those that have several values, and those whose values are texts
WALL_LISTS = frozenset(row.name for row in WALL_PROPERTIES if row.kind in ("list", "words"))
WALL_WORDS = tuple(row.name for row in WALL_PROPERTIES if row.kind == "words")
# Those that are yes or no
WALL_FLAGS = frozenset(row.name for row in WALL_PROPERTIES if row.kind == "logical")
# Those that only some walls have: tables show them where one of theirs has them
WALL_EXTRAS = frozenset(
    row.name
    for row in properties("wall")
    # Every strip has a hinge, given or found.
    if row.default == "optional" and row.owners and row.column and row.name != "hinge"
) | frozenset(("restitution_sd", "restitution_seed", "base_level", *BUILDING_NAMES))
# How the mechanisms of a wall occur
OCCURRENCE = next(row.choices for row in properties("row") if row.name == "occurrence")
INDEPENDENT, EXCLUSIVE = OCCURRENCE
# What stands in the place of those that are not given beside the others of their kind
WALL_ABSENT = {row.name: row.absent for row in WALL_PROPERTIES if row.absent is not None}
