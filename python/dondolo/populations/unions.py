"""Facades and walls with several mechanisms, counted in the same histories: docs/theory.md, section 6."""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from dondolo._base.arguments import FloatArray
from dondolo._fortran.tables import FlatCurve, TableColumns, union_columns
from dondolo.curves.fitting import fit
from dondolo.curves.fragility import Fragility
from dondolo.curves.table import flat
from dondolo.populations.curve import Group

if TYPE_CHECKING:
    from dondolo.populations.typology import Typology


def grouped(typology: Typology) -> list[Group]:
    """The curves of all mechanisms of groups that have a wall of several; none if there is one wall only."""
    walls = _walls(typology)
    several = {typology.population.group_names[first] for first, end in walls if end - first > 1}
    if len(walls) == 1 or not several:
        return []
    return [one for one in typology.groups if one.mechanism == "all" and (not one.group or one.group in several)]


def unions_table(typology: Typology) -> TableColumns:
    """Columns of ``_unions.csv``: walls, then means, of each all damage states, of these all levels."""
    states, people = [typology.at(edp) for edp in typology.edp_thresholds], typology.population
    names: list[tuple[str, str]] = []
    mechanisms: list[int] = []
    curves: list[tuple[FlatCurve, FlatCurve]] = []
    counts: list[FloatArray] = []

    def add(name: tuple[str, str], number: int, union: Fragility, product: Fragility, *counted: FloatArray) -> None:
        names.append(name)
        mechanisms.append(number)
        curves.append((flat(union), flat(product)))
        counts.append(np.array([*counted, product.upper_asymptote * product.collapses / product.histories]))

    for name in typology.unions:
        group, number = people.group_names[people.wholes.index(name)], people.wholes.count(name)
        for state in states:
            union, found = state.unions[name], _counted(state)[f"wall {name}"]
            fraction = found / union.histories
            add((name, group), number, union, state.combined[name], union.histories, found, fraction)
    for one in grouped(typology):
        for state in states:
            product = next(other.fit for other in grouped(state) if other.group == one.group)
            fraction = _counted(state)[f"group {one.group}"]
            none = np.zeros(len(state.levels))
            add(("", one.group), 0, state.group_unions[one.group], product, none, none, fraction)
    return union_columns(names, typology.im, typology.levels, mechanisms, curves, counts)


def _counted(state: Typology) -> dict[str, FloatArray]:
    assert state.union_counts is not None
    return state.union_counts


def _walls(typology: Typology) -> list[tuple[int, int]]:
    """First row of each wall or facade, and the row after its last."""
    people = typology.population
    return list(pairwise(np.append(people.first_rows, len(people)).tolist()))


def mean_curve(typology: Typology, group: Group, fraction: FloatArray) -> Fragility:
    """The lognormal fitted to mean fractions of the walls of a group, without a clustered error."""
    histories, upper_asymptote = group.fit.histories, group.upper_asymptote
    share = np.minimum(fraction / upper_asymptote, 1.0) if upper_asymptote > 0.0 else fraction
    edp = float(typology.edp_thresholds[-1])
    return fit(
        typology.levels,
        histories * share,
        histories,
        im=typology.im,
        edp_threshold=edp,
        upper_asymptote=upper_asymptote,
    )
