"""Facades and walls with several mechanisms, counted in the same histories: docs/theory.md, section 6."""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from dondolo._base.arguments import FloatArray
from dondolo._storage import tables
from dondolo.curves.fitting import fit
from dondolo.curves.fragility import Fragility
from dondolo.curves.table import errors_table
from dondolo.populations.curve import Group

if TYPE_CHECKING:
    from dondolo.populations.typology import Typology


def grouped(typology: Typology) -> list[Group]:
    """The curves of all mechanisms of groups that have a wall of several; none if there is one wall only."""
    walls = _walls(typology)
    several = {typology.population.groups[first] for first, end in walls if end - first > 1}
    if len(walls) == 1 or not several:
        return []
    return [one for one in typology.groups if one.mechanism == "all" and (not one.group or one.group in several)]


def unions_table(typology: Typology) -> tables.Table:
    """Columns of ``_unions.csv``: walls, then means, of each all damage states, of these all levels."""
    states = [typology.at(edp) for edp in typology.edp_thresholds]
    blocks = [
        _rows(state, name, state.unions[name], state.combined[name]) for name in typology.unions for state in states
    ]
    for group in grouped(typology):
        for state in states:
            product = next(one.fit for one in grouped(state) if one.group == group.group)
            fraction = _counted(state)[f"group {group.group}"]
            blocks.append(_block(state, "", group.group, state.group_unions[group.group], product, fraction))
    return {name: [value for block in blocks for value in block[name]] for name in blocks[0]}


def _rows(state: Typology, name: str, union: Fragility, product: Fragility) -> tables.Table:
    """Rows of a facade or a wall in a damage state."""
    people = state.population
    place = people.wholes.index(name)
    counts = _counted(state)[f"wall {name}"]
    rows = _block(state, name, people.groups[place], union, product, counts / union.histories)
    rows |= {"mechanisms": [people.wholes.count(name)] * len(state.levels), "histories": union.histories.astype(int)}
    return rows | {"collapses": counts}


def _counted(state: Typology) -> dict[str, FloatArray]:
    assert state.union_counts is not None
    return state.union_counts


def _block(
    state: Typology, name: str, group: str, union: Fragility, product: Fragility, fraction: FloatArray
) -> tables.Table:
    """Rows of a union in a damage state, in the order of the columns; a mean has no counts."""
    number = len(state.levels)
    nothing = [None] * number
    independent = product.saturation * product.collapses / product.histories
    return {
        "wall": [name] * number,
        "group": [group] * number,
        "mechanisms": nothing,
        "im": [state.im] * number,
        "im_level": state.levels,
        "histories": nothing,
        "collapses": nothing,
        "fraction": fraction,
        "independent_fraction": independent,
        "edp_threshold": [float(state.edp_thresholds[-1])] * number,
        "theta": [union.theta] * number,
        "beta": [union.beta] * number,
        "status": [union.status] * number,
        **{name: values * number for name, values in errors_table([union]).items()},
        "independent_theta": [product.theta] * number,
        "independent_beta": [product.beta] * number,
        **{f"independent_{name}": values * number for name, values in errors_table([product]).items()},
    }


def _walls(typology: Typology) -> list[tuple[int, int]]:
    """First row of each wall or facade, and the row after its last."""
    people = typology.population
    return list(pairwise(np.append(people.first_rows, len(people)).tolist()))


def mean_curve(typology: Typology, group: Group, fraction: FloatArray) -> Fragility:
    """The lognormal fitted to mean fractions of the walls of a group, without a clustered error."""
    histories, saturation = group.fit.histories, group.saturation
    share = np.minimum(fraction / saturation, 1.0) if saturation > 0.0 else fraction
    edp = float(typology.edp_thresholds[-1])
    origin = {"im": typology.im, "edp_threshold": edp, "saturation": saturation}
    return fit(typology.levels, histories * share, histories, **origin)
