"""State of the ties of a wall after a motion: it follows from the largest rotation."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from dondolo._base.arguments import FloatArray
from dondolo._fortran.tables import TableColumns, tie_columns
from dondolo._fortran.walls import open_anchors, tie_states, tie_tallies
from dondolo._storage.saved import part_of_results
from dondolo.walls.chain_actions import PointTie
from dondolo.walls.chains import ChainWall
from dondolo.walls.mechanisms import Corner
from dondolo.walls.parts import Tie, parts_of
from dondolo.walls.wall import Wall, upload

IntArray = NDArray[np.int32]


class TieStates(NamedTuple):
    """State of ties after motions, each an array whose last axis is that of the ties.

    Attributes
    ----------
    plastic_elongation : ndarray
        Elongation that stays [m]; of a broken tie that at which it broke.
    energy : ndarray
        Energy that it has dissipated, yield force times plastic elongation [J per metre of wall].
    broken : ndarray of bool
        Whether it is broken.
    """

    plastic_elongation: FloatArray
    energy: FloatArray
    broken: np.ndarray[Any, np.dtype[np.bool_]]


@part_of_results
class TieCounts(NamedTuple):
    """Counts of what the histories of stripes do to the ties of a wall, each of shape (levels, ties).

    Attributes
    ----------
    yielded, broken : ndarray of int
        Number of histories that yield a tie, and that break it.
    mean_elongation, largest_elongation : ndarray
        Plastic elongation: mean of the histories of a stripe, and the largest [m].
    """

    yielded: IntArray
    broken: IntArray
    mean_elongation: FloatArray
    largest_elongation: FloatArray

    @classmethod
    def of_walls(cls, ties: Iterable[int], levels: int, *columns: NDArray[Any]) -> tuple[TieCounts, ...]:
        """Those of walls with so many ties each, out of columns of all ties of all levels of all walls."""
        found, first = [], 0
        for number in ties:
            rows = slice(first, first + levels * number)
            found.append(cls(*(column[rows].reshape(levels, number) for column in columns)))
            first = rows.stop
        return tuple(found)


class Bar(NamedTuple):
    """A tie as the motion of a wall feels it.

    Attributes
    ----------
    height : float
        Of its anchor [m].
    section, length : float
        Section, per metre of wall [m2/m] or of a whole body [m2], and length that is free to stretch [m].
    modulus, strength, preload, strain, anchor_force : float or None
        As of `Tie`; None: what is usual.
    """

    height: float
    section: float
    length: float
    modulus: float | None
    strength: float | None
    preload: float | None
    strain: float | None
    anchor_force: float | None


def given_ties(wall: Wall) -> tuple[Tie | PointTie, ...]:
    """The ties of a wall as they are given, of a chain as its rows have them."""
    if isinstance(wall, ChainWall):
        return tuple(map(PointTie._of_row, wall._rows("tie_table").tolist()))
    return parts_of(wall, "ties")


def ties_of(wall: Wall) -> tuple[Bar, ...]:
    """The ties of a wall along its motion: of a corner each goes along one wall, at 45 degrees from the bisector."""
    share = math.sqrt(0.5) if isinstance(wall, Corner) else 1.0
    found = []
    for tie in given_ties(wall):
        anchor = getattr(tie, "anchor_total", None) or tie.anchor_force
        bar = (tie.modulus, tie.strength, tie.preload, tie.strain)
        found.append(Bar(tie.height, share * tie.section, tie.length / share, *bar, anchor and share * anchor))
    return tuple(found)


def number_of_ties(wall: Wall) -> int:
    """How many ties a wall has."""
    return len(given_ties(wall))


def ties_without_anchor(wall: Wall) -> list[int]:
    """Numbers, from 1, of the ties whose anchors have neither a plate nor a force at which they give way."""
    ties = number_of_ties(wall)
    found: list[int] = (1 + np.flatnonzero(open_anchors(upload((wall,)), ties))).tolist() if ties else []
    return found


def states_of_ties(wall: Wall, edp: ArrayLike) -> TieStates:
    """State of the ties of a wall after motions.

    Parameters
    ----------
    wall : Wall
        The wall.
    edp : array_like
        Largest rotation / capacity of each motion.

    Returns
    -------
    TieStates
        Arrays of the shape of `edp` and one axis more, that of the ties, which is empty for a wall without any.
    """
    ties = number_of_ties(wall)
    if not ties:
        none = np.zeros((*np.shape(edp), 0))
        return TieStates(none, none, none == 1.0)
    return TieStates(*tie_states(upload((wall,)), edp, ties))


def tallies_of_ties(wall: Wall, edp: FloatArray, ran: NDArray[np.bool_]) -> TieCounts:
    """What histories, (levels, histories) of which some ran, do to the ties of a wall."""
    ties, levels = number_of_ties(wall), len(edp)
    counts, elongations = np.zeros((2, 0), np.int32), np.zeros((2, 0))
    if ties:
        counts, elongations = tie_tallies(upload((wall,)), edp, ran, ties)
    (found,) = TieCounts.of_walls([ties], levels, *counts, *elongations)
    return found


def tie_table(
    walls: Sequence[Wall], im: str, levels: FloatArray, counts: Sequence[TieCounts], histories: NDArray[np.integer[Any]]
) -> TableColumns:
    """Columns of ``_ties.csv``, which has no rows of walls without ties; histories are (levels, walls)."""
    columns = zip(*counts, strict=True)
    yielded, broken, mean, largest = (np.concatenate([one.ravel() for one in column]) for column in columns)
    names, ties = [(wall.name, wall.mechanism) for wall in walls], [number_of_ties(wall) for wall in walls]
    return tie_columns(names, im, levels, ties, histories, np.array([yielded, broken]), np.array([mean, largest]))
