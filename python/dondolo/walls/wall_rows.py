"""Rows of walls: their weights, and which of them are mechanisms of one wall or facade."""

from __future__ import annotations

import functools
import math
from collections import Counter
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import KW_ONLY, dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from dondolo._base.arguments import FloatArray, argument_error, instance_of
from dondolo._base.shown import html_of
from dondolo._base.wording import decimal, say
from dondolo._fortran.library import as_text
from dondolo.walls.rows import (
    check_names,
    names_of_rows,
    notes_of_rows,
    numbered_alternatives,
    occurrence_of_rows,
    several,
    shares_of_rows,
    words_of_rows,
)
from dondolo.walls.wall import Wall, properties_of
from dondolo.walls.wall_columns import WallColumns, as_columns, statics_of


@dataclass(frozen=True, eq=False, repr=False)
class WallRows:
    """Walls in rows, checked, with what they make together; `Population` describes the fields."""

    walls: Sequence[Wall]
    weights: FloatArray = None  # type: ignore[assignment]
    _: KW_ONLY
    group_names: tuple[str, ...] = None  # type: ignore[assignment]
    p_occ: FloatArray = None  # type: ignore[assignment]
    facades: tuple[str, ...] = None  # type: ignore[assignment]
    occurrence: tuple[str, ...] = None  # type: ignore[assignment]
    alternatives: tuple[str, ...] = None  # type: ignore[assignment]
    origin: tuple[str, ...] = ()
    notes: Mapping[str, tuple[str, ...]] = None  # type: ignore[assignment]

    def __post_init__(self) -> None:
        if hasattr(self.walls, "notna"):
            sentence = ": must be walls; Population.from_frame makes them of a data frame"
            raise argument_error("wrong_type", "walls", sentence)
        walls = self._as_walls()
        rows, mechanisms = properties_of(walls, "name"), properties_of(walls, "mechanism")
        weights = shares_of_rows("weight", self.weights, rows, math.inf)
        if not np.any(weights > 0.0):
            raise argument_error("out_of_range", "weight", ": must be positive for at least one wall")
        p_occ = shares_of_rows("p_occ", self.p_occ, rows, 1.0)
        names = ("group_names", "facades", "alternatives")
        groups, facades, alternatives = (words_of_rows(name, getattr(self, name), rows) for name in names)
        occurrence = occurrence_of_rows(self.occurrence, rows)
        notes = notes_of_rows(self.notes, rows)
        origin = several("origin", self.origin, "lines")
        for line in origin:
            as_text("origin", line)
        of_rows = list(zip(weights.tolist(), groups, occurrence, strict=True))
        check_names(rows, mechanisms, of_rows, facades, alternatives)
        filled = {"walls": walls, "weights": weights, "group_names": groups, "p_occ": p_occ, "facades": facades}
        filled |= {"occurrence": occurrence, "alternatives": alternatives, "origin": origin, "notes": notes}
        for name, value in filled.items():
            object.__setattr__(self, name, value)
        numbered_alternatives(self.wholes, p_occ.tolist(), occurrence, alternatives)

    def _as_walls(self) -> Sequence[Wall]:
        """The walls that were given, each of several with a name."""
        given: Sequence[Wall]
        if isinstance(self.walls, WallColumns):
            given = self.walls
        else:
            given = (self.walls,) if isinstance(self.walls, Wall) else several("walls", self.walls, "walls")
            for wall in given:
                instance_of("walls", wall, Wall)
        if not given:
            raise argument_error("not_given", "walls", ": must be given")
        if len(given) == 1:
            # One wall is uploaded once.
            return tuple(given)
        names = names_of_rows(properties_of(given, "name"))
        if not isinstance(given, WallColumns):
            return as_columns(
                tuple(
                    wall if wall.name == name else wall._renamed(name) for wall, name in zip(given, names, strict=True)
                )
            )
        return given if names == tuple(given.names) else given.renamed(names)

    @functools.cached_property
    def wholes(self) -> tuple[str, ...]:
        """Name of what collapses with each row: its facade, or its wall."""
        names = properties_of(self.walls, "name")
        return tuple(facade or name for name, facade in zip(names, self.facades, strict=True))

    @functools.cached_property
    def first_rows(self) -> NDArray[np.intp]:
        """Where among the rows each wall or facade begins: its rows stand one after the other."""
        names = self.wholes
        first = np.array([i for i, name in enumerate(names) if i == 0 or names[i - 1] != name], dtype=np.intp)
        first.flags.writeable = False
        return first

    @functools.cached_property
    def alternative_numbers(self) -> NDArray[np.int32]:
        """Number of the alternative of each row among those of its wall; 0: its mechanisms are independent."""
        numbers = numbered_alternatives(self.wholes, self.p_occ.tolist(), self.occurrence, self.alternatives)
        numbers.flags.writeable = False
        return numbers

    def _has_single_alternatives(self, whole: str) -> bool:
        """Do no two mechanisms of a wall or facade ever occur together?"""
        numbers = self.alternative_numbers[[name == whole for name in self.wholes]]
        return bool(numbers.all()) and len(set(numbers.tolist())) == len(numbers)

    @property
    def _numbers_of_rows(self) -> NDArray[np.int32]:
        """How many rows each wall or facade has, shape (walls,)."""
        return np.diff(self.first_rows, append=len(self)).astype(np.int32)

    def _of_one_mechanism(self, rows: NDArray[np.intp]) -> tuple[FloatArray, FloatArray, NDArray[np.int32], Any]:
        """Weights of the walls of rows of one mechanism, share and alternative of each row, and first row of each wall.

        A wall that has several of these rows is their weighted mean, as one of exclusive alternatives is.
        """
        wall = np.searchsorted(self.first_rows, rows, side="right")
        first = np.flatnonzero(np.diff(wall, prepend=-1))
        number = np.diff(first, append=len(rows))
        total = np.add.reduceat(self.p_occ[rows], first)
        share = np.ones(len(rows))
        np.divide(self.p_occ[rows], np.repeat(total, number), out=share, where=np.repeat(total > 0.0, number))
        alternative = np.arange(1, len(rows) + 1) - np.repeat(first, number)
        return self.weights[rows[first]] * total, share, alternative.astype(np.int32), first

    @property
    def _has_curve_of_row(self) -> NDArray[np.bool_]:
        """Which walls have the curve of their one row, shape (walls,): those of one mechanism that can always occur."""
        first = self.first_rows
        alone: NDArray[np.bool_] = (np.diff(first, append=len(self)) == 1) & (self.p_occ[first] == 1)
        return alone

    def __len__(self) -> int:
        return len(self.walls)

    def __iter__(self) -> Iterator[Wall]:
        return iter(self.walls)

    def _facts(self) -> list[tuple[str, str]]:
        """How many there are, name and text."""
        groups = Counter(self.group_names[i] for i in self.first_rows)
        facts = [
            (say("walls"), str(len(self.first_rows))),
            (say("mechanisms"), str(len(self))),
            (say("sum of the weights"), decimal(f"{self.weights[self.first_rows].sum():.6g}")),
            (say("groups"), ", ".join(f"{name!r} ({count})" for name, count in groups.items())),
        ]
        return facts if any(groups) else facts[:-1]

    def _ranges(self) -> list[tuple[str, str]]:
        """Between which values the properties lie, name and text."""

        def between(what: str, values: Iterable[float], unit: str = "") -> tuple[str, str]:
            values = list(values)
            text = say("{low:.4g} to {high:.4g} {unit}", low=float(min(values)), high=float(max(values)), unit=unit)
            return what, text.strip()

        heights = properties_of(self.walls, "height")
        both = zip(heights, properties_of(self.walls, "thickness"), strict=True)
        sizes = [(height, thickness) for height, thickness in both if thickness is not None]
        facts = [between(say("height"), heights, "m")]
        if sizes:
            facts.append(between(say("thickness"), (thickness for _, thickness in sizes), "m"))
            facts.append(between(say("height / thickness"), (height / thickness for height, thickness in sizes)))
        return [
            *facts,
            between(say("trigger"), triggers_of(self.walls), "g"),
            between("p_occ", self.p_occ),
        ]

    def _repr_html_(self) -> str:
        return html_of("Population", [*self._facts(), *self._ranges()])


def triggers_of(walls: Sequence[Wall]) -> list[float]:
    """Acceleration at which each wall begins to rock, in units of gravity."""
    both = zip(statics_of(walls, "trigger_acceleration"), statics_of(walls, "gravity"), strict=True)
    return [trigger / gravity for trigger, gravity in both]
