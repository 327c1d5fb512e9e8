"""What the histories of a population do to its ties."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from dondolo._base.arguments import FloatArray
from dondolo._storage import tables
from dondolo._storage.saved import part_of_results
from dondolo.walls.wall import Wall

IntArray = NDArray[np.int32]


@part_of_results
class TieCounts(NamedTuple):
    """What the histories of one row of a population do to its ties, each of shape (levels, ties).

    Attributes
    ----------
    yielded, broken : ndarray of int
        How many histories stretch a tie for good, and break it.
    mean_elongation, largest_elongation : ndarray
        Plastic elongation: mean of the histories of a stripe, and the largest [m].
    """

    yielded: IntArray
    broken: IntArray
    mean_elongation: FloatArray
    largest_elongation: FloatArray

    @classmethod
    def of_rows(cls, ties: IntArray, levels: int, counts: IntArray, lengths: FloatArray) -> tuple[TieCounts, ...]:
        """Those of rows, as Fortran sends them: of each row both kinds of numbers, level by level."""
        ends = np.cumsum(2 * levels * ties)[:-1]
        found = []
        for own, more in zip(np.split(counts, ends), np.split(lengths, ends), strict=True):
            found.append(cls(*own.reshape(2, levels, -1), *more.reshape(2, levels, -1)))
        return tuple(found)


def tie_table(
    walls: Iterable[Wall], im: str, levels: FloatArray, counts: Sequence[TieCounts], histories: IntArray
) -> tables.Table:
    """Columns of ``_ties.csv``, which has no rows of walls without ties; histories are (levels, walls)."""
    rows = [
        (wall, own, runs, level, tie)
        for wall, own, runs in zip(walls, counts, histories.T, strict=True)
        for level in range(len(levels))
        for tie in range(own.broken.shape[1])
    ]
    table: tables.Table = {
        "wall": [wall.name for wall, *_ in rows],
        "mechanism": [wall.mechanism for wall, *_ in rows],
        "im": [im] * len(rows),
        "im_level": [levels[level] for *_, level, _ in rows],
        "tie": [tie + 1 for *_, tie in rows],
        "histories": [runs[level] for _, _, runs, level, _ in rows],
    }
    columns = {
        name: np.array([values[level, tie] for _, own, _, level, tie in rows for values in (getattr(own, name),)])
        for name in TieCounts._fields
    }
    # In this order, as in Fortran: to the bit
    share = 1.0 / np.array(table["histories"], dtype=np.float64)
    return table | {
        "yielded": columns["yielded"],
        "broken": columns["broken"],
        "share_yielded": share * columns["yielded"],
        "share_broken": share * columns["broken"],
        "mean_plastic_elongation_m": columns["mean_elongation"],
        "largest_plastic_elongation_m": columns["largest_elongation"],
    }
