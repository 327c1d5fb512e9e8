"""Standard errors of the curves of a population, clustered by record and by wall.

All walls are subjected to the same records, and a population is a sample of the walls that there could be. The records
of a cluster and the mechanisms of a wall depend on each other in any way; both kinds of clusters add their covariance.
What belongs to a record and a wall alone is counted in both, which errs on the side of wide intervals by about one part
in the number of walls or of records.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from dondolo._base.arguments import FloatArray
from dondolo._fortran.curves import cluster_curves
from dondolo._storage.saved import part_of_results
from dondolo.curves.clusters import Errors, errors_of_counts, errors_of_parts, no_errors
from dondolo.curves.fitting import with_errors
from dondolo.curves.fragility import Fragility
from dondolo.curves.series import in_series, series_slopes
from dondolo.populations.curve import Group
from dondolo.populations.flags import Flags
from dondolo.populations.rows import curves_of_walls, has_curve_of_row

if TYPE_CHECKING:
    from dondolo.populations.typology import Typology

# Numbers that are held at a time: rows x clusters x levels
_NUMBERS = 4_000_000


def with_clustered_errors(typology: Typology, flags: Flags) -> Typology:
    """The same typology with clustered standard errors of all its curves.

    Fractions of a wall whose mechanisms are in series are taken as linear in those of its mechanisms.
    """
    people, levels = typology.population, typology.levels
    labels = tuple(dict.fromkeys(flags.clusters))
    member = np.array([[own == label for own in flags.clusters] for label in labels], dtype=float)
    # Histories of each cluster at each level, over those of all records
    part = member @ flags.runs / flags.records
    run = part.sum(axis=0)
    first = people.first_rows
    ends = np.append(first[1:], len(people))
    sums = [_Sum(group, typology, part.shape) for group in typology.groups]
    curves: list[Fragility] = []
    combined = dict(typology.combined)
    for walls in _chunks(first, ends, part.size):
        rows = np.arange(first[walls.start], ends[walls.stop - 1])
        shares = flags.reached(rows, member)
        own = [typology.curves[row] for row in rows]
        curves += _clustered(levels, own, shares, part)
        # Change of the wall's fraction by each cluster: its derivative times what the cluster's outcomes deviate
        starts = first[walls] - rows[0]
        fractions = shares.sum(axis=1) / run
        slopes = series_slopes(people.p_occ[rows], fractions, starts)
        deviations = shares - part * fractions[:, None]
        whole = in_series(people.p_occ[rows, None] * fractions, starts)
        moved = np.add.reduceat(slopes[:, None] * deviations, starts, axis=0)
        occurring = in_series(people.p_occ[rows], starts)
        number = ends[walls] - first[walls]
        mixed = np.flatnonzero((number > 1) | (people.p_occ[first[walls]] < 1.0))
        mixed = mixed[occurring[mixed] > 0.0]
        if len(mixed):
            names = [people.wholes[first[walls][i]] for i in mixed]
            counts = (part * whole[mixed, None] + moved[mixed]) / occurring[mixed, None, None]
            found = _clustered(levels, [combined[name] for name in names], counts, part)
            combined |= dict(zip(names, found, strict=True))
        for name, i in ((people.wholes[first[walls][i]], i) for i in np.flatnonzero(number == 1)):
            if people.p_occ[first[walls][i]] == 1.0:
                combined[name] = curves[rows[0] + starts[i]]
        for one in sums:
            one.add(rows, starts, fractions, deviations, (whole, moved, occurring))
    groups = tuple(replace(one.group, fit=one.curve(labels, part)) for one in sums)
    return replace(typology, curves=tuple(curves), combined=combined, groups=groups)


def _chunks(first: Any, ends: Any, size: int) -> Iterator[slice]:
    """Walls, so many that the numbers of their rows and clusters are not too many."""
    rows, start = max(1, _NUMBERS // size), 0
    while start < len(first):
        stop = max(start + 1, int(np.searchsorted(ends, first[start] + rows, side="right")))
        yield slice(start, stop)
        start = stop


def _clustered(levels: FloatArray, curves: list[Fragility], counts: FloatArray, part: FloatArray) -> list[Fragility]:
    """Curves with clustered errors; only the ratio of counts and histories matters, so that a stripe counts for one."""
    data = [(curve.status, curve.theta, curve.beta) for curve in curves]
    covariances, errors, clusters = cluster_curves(levels, counts, part, data)
    covariances[[kind != "clustered" for kind in errors]] = np.nan
    return [
        with_errors(curve, Errors(covariance, kind, int(number), number - 1.0 if kind == "clustered" else np.nan))
        if curve.has_fit
        else curve
        for curve, covariance, kind, number in zip(curves, covariances, errors, clusters, strict=True)
    ]


@part_of_results
@dataclass(frozen=True, eq=False, repr=False)
class KeptErrors:
    """Standard errors of a typology as its tables have them: of rows, then of groups, then of walls that are no row.

    Attributes
    ----------
    kinds : tuple of str
        `errors` of each curve, state by state; '' without a fit.
    clusters : ndarray of int, shape (states, curves)
    covariances : ndarray, shape (states, curves, 2, 2)
    degrees_of_freedom : ndarray, shape (states, curves)
    """

    kinds: tuple[str, ...]
    clusters: np.ndarray[Any, Any]
    covariances: FloatArray
    degrees_of_freedom: FloatArray

    @classmethod
    def of(cls, errors: Sequence[Sequence[Errors]]) -> KeptErrors:
        """Those of each state."""
        return cls(
            tuple(one.errors for state in errors for one in state),
            np.array([[one.clusters for one in state] for state in errors]),
            np.array([[one.covariance for one in state] for state in errors]),
            np.array([[one.degrees_of_freedom for one in state] for state in errors]),
        )

    def put_into(self, typology: Typology, state: int) -> Typology:
        """The typology of a state with these standard errors."""
        alone = has_curve_of_row(typology.population).tolist()
        mixed = [curve for curve, has_row in zip(typology.combined.values(), alone, strict=True) if not has_row]
        number = self.clusters.shape[1]
        kinds = self.kinds[number * (state % len(self.clusters)) :]
        found = [
            with_errors(curve, Errors(np.array(covariance), kind, int(clusters), float(degrees), curve.parts))
            if curve.has_fit and kind
            else curve
            for curve, kind, covariance, clusters, degrees in zip(
                (*typology.curves, *(group.fit for group in typology.groups), *mixed),
                kinds[:number],
                self.covariances[state],
                self.clusters[state],
                self.degrees_of_freedom[state],
                strict=True,
            )
        ]
        ends = np.cumsum([len(typology.curves), len(typology.groups)]).tolist()
        own, fits, mixed = found[: ends[0]], found[ends[0] : ends[1]], found[ends[1] :]
        return replace(
            typology,
            curves=tuple(own),
            combined=curves_of_walls(typology.population, own, mixed),
            groups=tuple(replace(group, fit=fit) for group, fit in zip(typology.groups, fits, strict=True)),
        )


class _Sum:
    """Sums over the walls of a curve of the population."""

    def __init__(self, group: Group, typology: Typology, shape: tuple[int, ...]) -> None:
        self.group = group
        people = typology.population
        self.weight, self.p_occ = people.weights, people.p_occ
        self.chosen = np.array([group.group in ("", own) for own in people.groups]) & (people.weights > 0.0)
        self.levels = typology.levels
        self.alone = group.mechanism != "all"
        if self.alone:
            self.chosen &= np.array([wall.mechanism == group.mechanism for wall in people.walls])
            self.chosen &= people.weights * people.p_occ > 0.0
        self.moved = np.zeros(shape)
        self.walls: list[FloatArray] = []
        self.occurring: list[FloatArray] = []

    def add(
        self, rows: Any, starts: Any, fractions: FloatArray, deviations: FloatArray, walls: tuple[FloatArray, ...]
    ) -> None:
        """Add some walls: fractions (rows, levels), deviations (rows, clusters, levels), and those of whole walls."""
        if self.alone:
            own = np.flatnonzero(self.chosen[rows])
            weight = self.weight[rows[own]] * self.p_occ[rows[own]]
            occurring, whole, moved = np.ones(len(own)), fractions[own], deviations[own]
        else:
            whole, moved, occurring = walls
            own = np.flatnonzero(self.chosen[rows[starts]])
            weight = self.weight[rows[starts[own]]]
            occurring, whole, moved = occurring[own], whole[own], moved[own]
        self.moved += np.tensordot(weight, moved, axes=1)
        self.walls.append(weight[:, None] * whole)
        self.occurring.append(weight * occurring)

    def curve(self, labels: tuple[str, ...], part: FloatArray) -> Fragility:
        """The fit with its standard errors, over records and, if there are several, walls."""
        fit = self.group.fit
        if not fit.has_fit:
            return fit
        at = fit.theta, fit.beta
        occurring, walls = np.concatenate(self.occurring), np.concatenate(self.walls)
        total = occurring.sum()
        share = walls.sum(axis=0) / total
        counts = part * share + self.moved / total
        records = errors_of_counts("records", labels, self.levels, counts, part, at)
        if records.errors != "clustered" or len(walls) == 1:
            return with_errors(fit, records)
        histories = (occurring / total)[:, None] * part.sum(axis=0)
        names = [f"wall {number + 1}" for number in range(len(walls))]
        drawn = errors_of_counts("walls", names, self.levels, walls / total * part.sum(axis=0), histories, at)
        if drawn.errors != "clustered":
            why = {"few_clusters": "few_walls", "one_cluster": "one_wall"}[drawn.errors]
            return with_errors(fit, no_errors(why, drawn.clusters))
        return with_errors(fit, errors_of_parts((*records.parts, *drawn.parts)))
