"""Curves of populations, as Fortran finds them."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from dondolo._base.arguments import FloatArray
from dondolo._fortran import _core
from dondolo._fortran.library import Parcel, as_text, check, constants, receive, unpack_warnings
from dondolo.errors import DondoloWarning


class FlatPopulation(NamedTuple):
    """A population as Fortran takes it, with the counts of one damage state.

    Attributes
    ----------
    texts : bytes
        Mechanism and group of each row, a line each.
    levels : ndarray, shape (levels,)
    counts : ndarray of int, shape (levels, rows)
    histories : ndarray of int, shape (levels, rows)
    shares : ndarray, shape (2, rows)
        Weight of the wall and probability of occurrence.
    alternative : ndarray of int, shape (rows,)
        Number of the alternative of each row among those of its wall; 0: its mechanisms are independent.
    rows : ndarray of int, shape (walls,)
        How many each wall has.
    """

    texts: bytes
    levels: FloatArray
    counts: NDArray[np.int32]
    histories: NDArray[np.int32]
    shares: FloatArray
    alternative: NDArray[np.int32]
    rows: NDArray[np.int32]


class FlatCurves(NamedTuple):
    """Curves of the rows of a population as Fortran takes them, (rows,); statuses are places among the names."""

    theta: FloatArray
    beta: FloatArray
    statuses: NDArray[np.int32]

    @classmethod
    def of(cls, curves: Sequence[tuple[float, float, str]]) -> FlatCurves:
        """Curves that are known by theta, beta and status."""
        theta, beta, status = zip(*curves, strict=True)
        places = [constants().statuses.index(name) + 1 for name in status]
        return cls(np.array(theta), np.array(beta), np.array(places, dtype=np.int32))


class FlatFlags(NamedTuple):
    """Which histories reach which state, as Fortran takes it.

    Attributes
    ----------
    states, state : int
        How many states there are, and the one that is asked for, from 1; 0 without flags.
    sizes : ndarray of int, shape (rows,)
        Histories of a stripe of each row in which every record runs.
    bits : ndarray of int
        The flags of all rows, 32 a number.
    clusters : ndarray of int, shape (records,)
        Number of the cluster of each record, from 1.
    runs : ndarray of int, shape (records, levels)
        1 where a record runs at a level.
    """

    states: int
    state: int
    sizes: NDArray[np.int32]
    bits: NDArray[np.int32]
    clusters: NDArray[np.int32]
    runs: NDArray[np.int32]


def fit_population(names: bytes, population: FlatPopulation, flags: FlatFlags | None, are_alternatives: bool) -> Parcel:
    """Curves of rows, of their walls and of their population in a damage state; names are two of each row, a line each.

    What the parcel has is listed in populations.f90. Without flags standard errors are naive.
    """
    if flags is None:
        nothing = np.ones(1, dtype=np.int32)
        rows, levels = population.counts.shape[1], len(population.levels)
        flags = FlatFlags(0, 0, np.zeros(rows, np.int32), nothing, nothing, np.ones((1, levels), np.int32))
    texts, *rest = population
    return receive(_core.populations.fit_population(texts, names, *rest, int(are_alternatives), *flags))


def warnings_of_occurrence(
    names: bytes, p_occ: FloatArray, alternative: NDArray[np.int32], rows: NDArray[np.int32]
) -> list[DondoloWarning]:
    """Warnings of the executable for the probabilities of occurrence; names of walls or facades, a line a row."""
    found = receive(_core.populations.warn_of_occurrence(names, p_occ, alternative, rows))
    return unpack_warnings(found.lines)


def curve_of_population(
    population: FlatPopulation,
    curves: FlatCurves,
    which: tuple[str, str],
    x: FloatArray,
    q: FloatArray,
    members: bool = False,
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """A curve of a population at some levels: its mean, fractiles (q, x) and members' probabilities (members, x).

    Curves are those of the rows; which: the mechanism, or 'all', and the group. The probabilities are there with
    `members` only.
    """
    texts = (as_text("group", text) for text in which)
    mean, fractiles, sent = _core.populations.curve_of_population(
        *population, *texts, x, q, int(members), **curves._asdict()
    )
    check(sent)
    return mean, fractiles, receive(sent)["probabilities"].T if members else np.zeros((0, len(x)))
