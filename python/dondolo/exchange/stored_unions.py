"""Unions of mechanisms that stand in result files of a population, counted there in the same histories."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from dondolo._storage.columns import Columns
from dondolo.curves.clusters import Errors, no_errors
from dondolo.curves.fitting import fit, with_errors
from dondolo.curves.fragility import Fragility
from dondolo.curves.series import in_series
from dondolo.exchange.stored_errors import errors_of_row
from dondolo.populations.curve import Group
from dondolo.populations.typology import Typology
from dondolo.populations.unions import grouped, mean_curve, mean_union_of, union_of

Curves = tuple[dict[str, Fragility], ...]


def kept_unions(typology: Typology, table: Columns) -> tuple[Curves, Curves]:
    """Curve of each facade or wall with several mechanisms, and of each mean over walls, in each damage state.

    Parameters
    ----------
    typology : Typology
        Without them.
    table : Columns
        ``_unions.csv``: of each facade or wall, and then of each mean, all damage states, of these all levels.

    Returns
    -------
    unions, group_unions : tuple of dict of str to Fragility

    Raises
    ------
    InputError
        The table does not fit the walls.
    """
    people = typology.population
    names = [name for name in dict.fromkeys(people.wholes) if people.wholes.count(name) > 1]
    groups = grouped(typology)
    states, levels = len(typology.edp_thresholds), len(typology.levels)
    with table.reading():
        found = table.texts("wall")
        if [name for name in dict.fromkeys(found) if name] != names or len(found) % (states * levels):
            raise ValueError("wall: must be those of several mechanisms, in the order of the population")
        means = table.texts("group")[len(names) * states * levels :: states * levels]
        if means != [one.group for one in groups]:
            raise ValueError("group: must be those of walls with several mechanisms, in the order of the population")
        return tuple(
            {name: _union(typology, table, (i * states + k) * levels, k) for i, name in enumerate(names)}
            for k in range(states)
        ), tuple(
            {
                one.group: _mean(typology, table, one, ((len(names) + i) * states + k) * levels, k)
                for i, one in enumerate(groups)
            }
            for k in range(states)
        )


def _mean(typology: Typology, table: Columns, group: Group, first: int, state: int) -> Fragility:
    """A mean over walls, fitted again; its standard errors are not stored, but follow from flags."""
    fraction = np.array([table.number("fraction", row) for row in range(first, first + len(typology.levels))])
    curve = mean_curve(typology, group, fraction)
    curve = replace(curve, edp_threshold=table.number("edp_threshold", first))
    if not curve.has_fit:
        return curve
    if typology.flags is None:
        return with_errors(curve, no_errors("given", 0))
    counted = mean_union_of(typology, typology.flags.at(state), group)
    return with_errors(curve, Errors(*(getattr(counted, name) for name in Errors._fields)))


def _union(typology: Typology, table: Columns, first: int, state: int) -> Fragility:
    """The curve of the rows of a state, fitted again; with what each cluster changes where that is known."""
    rows = range(first, first + len(typology.levels))
    name = table.texts("wall")[first]
    chosen = np.flatnonzero([own == name for own in typology.population.wholes])
    saturation = float(in_series(typology.population.p_occ[chosen], np.array([0]))[0])
    histories = np.array([table.number("histories", row) for row in rows])
    reached = np.array([table.number("collapses", row) for row in rows]) / (saturation or 1.0)
    origin = {"im": typology.im, "edp_threshold": table.number("edp_threshold", first), "saturation": saturation}
    curve = fit(typology.levels, np.minimum(reached, histories), histories, **origin)
    if not curve.has_fit:
        return curve
    errors = errors_of_row(table, first)
    if typology.flags is not None and errors.errors == "clustered":
        errors = errors._replace(parts=union_of(typology, typology.flags.at(state), chosen).parts)
    return with_errors(curve, errors)
