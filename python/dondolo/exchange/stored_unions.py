"""Unions of mechanisms that stand in result files of a population, counted there in the same histories."""

from __future__ import annotations

import numpy as np

from dondolo.curves.fitting import fit, with_errors
from dondolo.curves.fragility import Fragility
from dondolo.curves.series import in_series
from dondolo.exchange.result_file import ResultFile
from dondolo.exchange.stored_errors import errors_of_row
from dondolo.populations.typology import Typology


def kept_unions(typology: Typology, table: ResultFile) -> tuple[dict[str, Fragility], ...]:
    """Curve of each facade or wall with several mechanisms, in each damage state.

    Parameters
    ----------
    typology : Typology
        Without them.
    table : ResultFile
        ``_unions.csv``: of each facade or wall all damage states, of these all levels.

    Returns
    -------
    tuple of dict of str to Fragility

    Raises
    ------
    InputError
        The table does not fit the walls.
    """
    people = typology.population
    names = [name for name in dict.fromkeys(people.wholes) if people.wholes.count(name) > 1]
    states, levels = len(typology.edp_thresholds), len(typology.levels)
    with table.reading():
        found = table.texts("wall")
        if [name for name in dict.fromkeys(found) if name] != names or len(found) % (states * levels):
            raise ValueError("wall: must be those of several mechanisms, in the order of the population")
        return tuple(
            {name: _union(typology, table, (i * states + k) * levels) for i, name in enumerate(names)}
            for k in range(states)
        )


def _union(typology: Typology, table: ResultFile, first: int) -> Fragility:
    """The curve of the rows of a state, fitted again."""
    rows = range(first, first + len(typology.levels))
    chosen = [own == table.texts("wall")[first] for own in typology.population.wholes]
    saturation = float(in_series(typology.population.p_occ[chosen], np.array([0]))[0])
    histories = np.array([table.number("histories", row) for row in rows])
    reached = np.array([table.number("collapses", row) for row in rows]) / (saturation or 1.0)
    origin = {"im": typology.im, "edp_threshold": table.number("edp_threshold", first), "saturation": saturation}
    curve = fit(typology.levels, np.minimum(reached, histories), histories, **origin)
    return with_errors(curve, errors_of_row(table, first)) if curve.has_fit else curve
