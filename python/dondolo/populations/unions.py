"""Facades and walls with several mechanisms, counted in the same histories: docs/theory.md, section 6."""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np

from dondolo._base.arguments import FloatArray
from dondolo._storage import tables
from dondolo.curves.clusters import errors_of_counts, errors_of_parts, no_errors
from dondolo.curves.fitting import fit, with_errors
from dondolo.curves.fragility import Fragility
from dondolo.curves.series import in_series
from dondolo.curves.table import errors_table
from dondolo.errors import InputError
from dondolo.populations.curve import Group
from dondolo.populations.flags import Flags

if TYPE_CHECKING:
    from dondolo.populations.typology import Typology

_MISSING = "the results were read back from files without *_unions.csv"


def unions_of(typology: Typology) -> dict[str, Fragility]:
    """Curve of each facade or wall with several mechanisms, by its name."""
    flags = _flags_of(typology)
    people = typology.population
    return {
        people.wholes[first]: union_of(typology, flags, np.arange(first, end))
        for first, end in _walls(typology)
        if end - first > 1
    }


def group_unions_of(typology: Typology) -> dict[str, Fragility]:
    """Weighted mean over the population ('') and over each group with a wall of several mechanisms, fitted."""
    flags = _flags_of(typology)
    return {group.group: mean_union_of(typology, flags, group) for group in grouped(typology)}


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
            blocks.append(_mean_rows(state, group.group, state.group_unions[group.group], product))
    return {name: [value for block in blocks for value in block[name]] for name in blocks[0]}


def _rows(state: Typology, name: str, union: Fragility, product: Fragility) -> tables.Table:
    """Rows of a facade or a wall in a damage state."""
    people = state.population
    place = people.wholes.index(name)
    counts = union.saturation * union.collapses
    rows = _block(state, name, people.groups[place], union, product)
    rows |= {"mechanisms": [people.wholes.count(name)] * len(state.levels), "histories": union.histories.astype(int)}
    errors = errors_table([union])
    return rows | {"collapses": counts} | {what: value * len(state.levels) for what, value in errors.items()}


def _mean_rows(state: Typology, group: str, mean: Fragility, product: Fragility) -> tables.Table:
    """Rows of a mean in a damage state, which has no counts; its standard errors are not stored."""
    return _block(state, "", group, mean, product)


def _block(state: Typology, name: str, group: str, union: Fragility, product: Fragility) -> tables.Table:
    """Rows of a union in a damage state, in the order of the columns."""
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
        "fraction": union.saturation * union.collapses / union.histories,
        "independent_fraction": independent,
        "edp_threshold": [float(state.edp_thresholds[-1])] * number,
        "theta": [union.theta] * number,
        "beta": [union.beta] * number,
        "status": [union.status] * number,
        **dict.fromkeys(errors_table([union]), nothing),
        "independent_theta": [product.theta] * number,
        "independent_beta": [product.beta] * number,
        **{f"independent_{name}": values * number for name, values in errors_table([product]).items()},
    }


def _flags_of(typology: Typology) -> Flags:
    if typology.flags is None:
        raise InputError(f"unions: {_MISSING}")
    return typology.flags


def _walls(typology: Typology) -> list[tuple[int, int]]:
    """First row of each wall or facade, and the row after its last."""
    people = typology.population
    return list(pairwise(np.append(people.first_rows, len(people)).tolist()))


def _survival(typology: Typology, flags: Flags, rows: np.ndarray[Any, np.dtype[np.int64]]) -> FloatArray:
    """Probability that a wall with these rows stands in each history, shape (levels, histories)."""
    survival: FloatArray = np.ones((flags.levels, int(flags.histories[rows].max())))
    for row, p in zip(rows, typology.population.p_occ[rows], strict=True):
        own = flags.of([row])[0, flags.state]
        # A wall that is the same from both sides runs each record once: reversed it ends alike.
        survival *= 1.0 - p * np.tile(own, survival.shape[1] // own.shape[1])
    return survival


def _members(flags: Flags) -> tuple[tuple[str, ...], FloatArray]:
    """Labels of the clusters of records, and which records belong to each, shape (clusters, records)."""
    labels = tuple(dict.fromkeys(flags.clusters))
    return labels, np.array([[own == label for own in flags.clusters] for label in labels], dtype=float)


def _by_cluster(survival: FloatArray, flags: Flags, member: FloatArray) -> FloatArray:
    """Histories of each cluster in which a wall collapses, shape (clusters, levels)."""
    polarities = survival.shape[1] // flags.records
    reached: FloatArray = member @ (1.0 - survival).reshape(flags.levels, polarities, flags.records).sum(axis=1).T
    return reached


def union_of(typology: Typology, flags: Flags, rows: np.ndarray[Any, np.dtype[np.int64]]) -> Fragility:
    """Curve of the union of some rows."""
    survival = _survival(typology, flags, rows)
    labels, member = _members(flags)
    reached = _by_cluster(survival, flags, member)
    histories = survival.shape[1] // flags.records * member @ flags.runs
    saturation = float(in_series(typology.population.p_occ[rows], np.array([0]))[0])
    if saturation > 0.0:
        reached /= saturation
    total = histories.sum(axis=0)
    counts = np.minimum(reached.sum(axis=0), total)
    edp = float(typology.edp_thresholds[-1])
    curve = fit(typology.levels, counts, total, im=typology.im, edp_threshold=edp, saturation=saturation)
    if not curve.has_fit:
        return curve
    at = curve.theta, curve.beta
    return with_errors(curve, errors_of_counts("records", labels, typology.levels, reached, histories, at))


def mean_union_of(typology: Typology, flags: Flags, group: Group) -> Fragility:
    """The weighted mean of the unions of the walls of a group, fitted; its errors are over records and walls."""
    people = typology.population
    labels, member = _members(flags)
    part = member @ flags.runs / flags.records
    run = part.sum(axis=0)
    shares, weights, occurring = [], [], []
    for first, end in _walls(typology):
        if not people.weights[first] > 0.0 or group.group not in ("", people.groups[first]):
            continue
        rows = np.arange(first, end)
        survival = _survival(typology, flags, rows)
        shares.append(_by_cluster(survival, flags, member) / survival.shape[1])
        weights.append(people.weights[first])
        occurring.append(people.weights[first] * float(in_series(people.p_occ[rows], np.array([0]))[0]))
    reached = np.tensordot(np.array(weights), np.array(shares), axes=1)
    fraction = np.minimum(reached.sum(axis=0) / run / np.sum(weights), 1.0)
    curve = mean_curve(typology, group, fraction)
    if not curve.has_fit:
        return curve
    total, at = float(np.sum(occurring)), (curve.theta, curve.beta)
    records = errors_of_counts("records", labels, typology.levels, reached / total, part, at)
    if records.errors != "clustered" or len(shares) == 1:
        return with_errors(curve, records)
    walls = np.array(weights)[:, None] * np.array(shares).sum(axis=1) / total
    names = [f"wall {number + 1}" for number in range(len(walls))]
    histories = np.array(occurring)[:, None] / total * run
    drawn = errors_of_counts("walls", names, typology.levels, walls, histories, at)
    if drawn.errors != "clustered":
        why = {"few_clusters": "few_walls", "one_cluster": "one_wall"}[drawn.errors]
        return with_errors(curve, no_errors(why, drawn.clusters))
    return with_errors(curve, errors_of_parts((*records.parts, *drawn.parts)))


def mean_curve(typology: Typology, group: Group, fraction: FloatArray) -> Fragility:
    """The lognormal fitted to mean fractions of the walls of a group, without a clustered error."""
    histories, saturation = group.fit.histories, group.saturation
    share = np.minimum(fraction / saturation, 1.0) if saturation > 0.0 else fraction
    edp = float(typology.edp_thresholds[-1])
    origin = {"im": typology.im, "edp_threshold": edp, "saturation": saturation}
    return fit(typology.levels, histories * share, histories, **origin)
