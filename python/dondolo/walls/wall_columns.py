"""Many walls as columns: an object of each is made when it is asked for."""

from __future__ import annotations

import weakref
from collections.abc import Iterator, Sequence
from typing import Any, overload

import numpy as np

from dondolo._fortran.buildings import BUILDING_NAMES
from dondolo._fortran.walls import (
    WALL_LISTS,
    WALL_NUMBERS,
    WALL_TEXTS,
    WALL_WORDS,
    FlatWall,
    WallTable,
    shared,
)
from dondolo.walls.mechanisms import MECHANISMS, wall_from
from dondolo.walls.parts import PLACES
from dondolo.walls.wall import ColumnsOfWalls, Wall, property_of


class WallColumns(ColumnsOfWalls):
    """Walls of a table; it is used as a tuple of them.

    Parameters
    ----------
    table : WallTable
        What Fortran has understood, without what walls do not keep: `of_data` leaves it out.
    """

    def __init__(self, table: WallTable) -> None:
        self._table = table
        # A wall that is in use stays the same object.
        self._made: weakref.WeakValueDictionary[int, Wall] = weakref.WeakValueDictionary()

    @classmethod
    def of_data(cls, table: WallTable) -> WallColumns:
        """Walls out of a parcel: a wall keeps what is a field of its class, or of its parts or its building."""
        mechanisms = np.array(table.texts["mechanism"])
        kinds = dict.fromkeys(table.texts["mechanism"])
        kept = {kind: MECHANISMS[kind]._fields() | PLACES.keys() | {*BUILDING_NAMES, "mechanism"} for kind in kinds}

        def lost(what: str) -> Any:
            return np.isin(mechanisms, [kind for kind in kinds if what not in kept[kind]])

        texts, numbers, lists = dict(table.texts), dict(table.numbers), dict(table.lists)
        for what, own in table.texts.items():
            if (gone := lost(what)).any():
                texts[what] = shared(["" if out else word for out, word in zip(gone.tolist(), own, strict=True)])
        for what, values in table.numbers.items():
            if (gone := lost(what)).any():
                numbers[what] = np.where(gone, np.nan, values)
        for what, (values, counts) in table.lists.items():
            if (gone := lost(what)).any():
                lists[what] = values[~np.repeat(gone, counts)], np.where(gone, 0, counts).astype(np.int32)
        numbers = {what: values for what, values in numbers.items() if not np.isnan(values).all()}
        lists = {what: both for what, both in lists.items() if len(both[0])}
        return cls(WallTable(table.statics, table.two_sided, texts, numbers, lists))

    @classmethod
    def of_walls(cls, walls: Sequence[Wall]) -> WallColumns:
        """Walls that there are as objects."""
        texts: dict[str, Sequence[str]] = {}
        numbers, lists = {}, {}
        for what in WALL_TEXTS:
            own = [property_of(wall, what) for wall in walls]
            words = [",".join(map(str, one or ())) for one in own] if what in WALL_WORDS else [one or "" for one in own]
            texts[what] = shared(words)
        for what in WALL_NUMBERS:
            values = [property_of(wall, what) for wall in walls]
            if all(value is None for value in values):
                continue
            if what in WALL_LISTS:
                several = [() if value is None else np.atleast_1d(value) for value in values]
                counts = np.array([len(one) for one in several], dtype=np.int32)
                lists[what] = np.concatenate([np.asarray(one, dtype=np.float64) for one in several]), counts
            else:
                numbers[what] = np.array([np.nan if value is None else value for value in values], dtype=np.float64)
        statics = np.array([(wall.gravity, *wall.__dict__["_statics"]) for wall in walls])
        two_sided = np.array([wall.two_sided for wall in walls])
        made = cls(WallTable(statics, two_sided, texts, numbers, lists))
        made._made.update(enumerate(walls))
        return made

    @classmethod
    def join(cls, parts: Sequence[WallColumns]) -> WallColumns:
        """Walls of several, one after the other."""
        return cls(WallTable.join([part._table for part in parts]))

    @property
    def flat(self) -> FlatWall:  # type: ignore[override]
        """The walls as Fortran takes them."""
        return self._table.flat

    @property
    def names(self) -> Sequence[str]:
        """Their names."""
        return self._table.texts["name"]

    def column(self, name: str) -> list[Any]:
        """A property of all walls, as `property_of` has it."""
        return self._table.column(name)

    def statics(self, name: str) -> list[float]:
        """A static quantity of all walls."""
        values: list[float] = self._table.statics[:, _STATICS.index(name)].tolist()
        return values

    def renamed(self, names: Sequence[str]) -> WallColumns:
        """The same walls under other names."""
        table = self._table
        texts = {**table.texts, "name": tuple(names)}
        made = WallColumns(WallTable(table.statics, table.two_sided, texts, table.numbers, table.lists))
        for i, wall in list(self._made.items()):
            if wall.name == names[i]:
                made._made[i] = wall
        return made

    def take(self, rows: Any) -> WallColumns:
        """The walls of some rows."""
        chosen = np.asarray(rows, dtype=np.intp)
        made = WallColumns(self._table.take(chosen))
        for i, row in enumerate(chosen.tolist() if self._made else ()):
            if (wall := self._made.get(row)) is not None:
                made._made[i] = wall
        return made

    @overload
    def __getitem__(self, index: int) -> Wall: ...

    @overload
    def __getitem__(self, index: slice) -> Sequence[Wall]: ...

    def __getitem__(self, index: Any) -> Wall | Sequence[Wall]:
        if isinstance(index, slice):
            return self.take(np.arange(len(self))[index])
        row = range(len(self))[index]
        wall = self._made.get(row)
        if wall is None:
            wall = self._made[row] = wall_from(self._table[row])
        return wall

    def __iter__(self) -> Iterator[Wall]:
        return (self[i] for i in range(len(self)))

    def __len__(self) -> int:
        return len(self._table)

    def __add__(self, other: Sequence[Wall]) -> Sequence[Wall]:
        return (*self, *other)

    def __radd__(self, other: Sequence[Wall]) -> Sequence[Wall]:
        return (*other, *self)

    def __eq__(self, other: object) -> bool:
        if not isinstance(other, (tuple, WallColumns)):
            return NotImplemented
        return len(self) == len(other) and all(a == b for a, b in zip(self, other, strict=True))

    def __hash__(self) -> int:
        return hash(tuple(self))

    def __repr__(self) -> str:
        return repr(tuple(self))

    def __getstate__(self) -> WallTable:
        return self._table

    def __setstate__(self, table: WallTable) -> None:
        self.__init__(table)  # type: ignore[misc]


# Columns of the static quantities that many walls are asked for at once
_STATICS = ("gravity", "radius", "slenderness_angle", "frequency_parameter", "trigger_acceleration")


def as_columns(walls: tuple[Wall, ...]) -> Sequence[Wall]:
    """Several walls as columns; one alone, and those of classes of the user's, stay as they are."""
    if len(walls) == 1 or any(type(wall) is not MECHANISMS.get(wall.mechanism) for wall in walls):
        return walls
    return WallColumns.of_walls(walls)


def statics_of(walls: Sequence[Wall], name: str) -> list[float]:
    """A static quantity of several walls."""
    return walls.statics(name) if isinstance(walls, WallColumns) else [getattr(wall, name) for wall in walls]
