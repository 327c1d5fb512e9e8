"""What the histories of a population do to its ties, as it stands in result files."""

from __future__ import annotations

import numpy as np

from dondolo._storage.columns import Columns
from dondolo.populations.tie_counts import TieCounts
from dondolo.populations.typology import Typology
from dondolo.walls.ties import number_of_ties


def stored_ties(typology: Typology, table: Columns | None) -> tuple[TieCounts, ...]:
    """What becomes of the ties of each row.

    Parameters
    ----------
    typology : Typology
        Without them.
    table : Columns or None
        ``_ties.csv``: of each row that has ties all levels, of these all ties; None if there is none, since no wall has
        ties.

    Returns
    -------
    tuple of TieCounts

    Raises
    ------
    InputError
        The table does not fit the walls.
    """
    levels, ties = len(typology.levels), [number_of_ties(wall) for wall in typology.walls]
    if table is None:
        return tuple(_counts(np.zeros((4, 0)), levels, number) for number in ties)
    with table.reading():
        if len(table) != levels * sum(ties):
            raise ValueError(f"{len(table)} rows: must be {levels * sum(ties)}, one for each tie and level")
        columns = np.array(
            [
                table.counts("yielded"),
                table.counts("broken"),
                table.numbers("mean_plastic_elongation_m"),
                table.numbers("largest_plastic_elongation_m"),
            ],
            dtype=float,
        )
    ends = levels * np.cumsum(ties)[:-1]
    return tuple(
        _counts(own, levels, number) for own, number in zip(np.split(columns, ends, axis=1), ties, strict=True)
    )


def _counts(columns: np.ndarray[tuple[int, int], np.dtype[np.float64]], levels: int, ties: int) -> TieCounts:
    """Of one row: four columns, level by level."""
    yielded, broken, mean, largest = columns[:, : levels * ties].reshape(4, levels, ties)
    return TieCounts(yielded.astype(np.int32), broken.astype(np.int32), mean, largest)
