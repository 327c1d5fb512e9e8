"""What the histories of a population do to its ties, as it stands in result files."""

from __future__ import annotations

import numpy as np

from dondolo._storage.columns import Columns
from dondolo.populations.typology import Typology
from dondolo.walls.ties import TieCounts, number_of_ties


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
        return TieCounts.of_walls(ties, levels, *np.zeros((2, 0), np.int32), *np.zeros((2, 0)))
    with table.reading():
        if len(table) != levels * sum(ties):
            raise ValueError(f"{len(table)} rows: must be {levels * sum(ties)}, one for each tie and level")
        counts = table.counts("yielded"), table.counts("broken")
        lengths = (table.numbers(f"{which}_plastic_elongation_m") for which in ("mean", "largest"))
        return TieCounts.of_walls(ties, levels, *counts, *lengths)
