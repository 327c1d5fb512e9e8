"""What result files know of the curves of a population besides counts: standard errors, and unions of mechanisms.

Counts do not tell which record brings which wall down.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from dondolo._base.arguments import FloatArray
from dondolo._storage.saved import part_of_results
from dondolo.curves.clusters import Errors
from dondolo.curves.fitting import with_errors
from dondolo.curves.fragility import Fragility

if TYPE_CHECKING:
    from dondolo.populations.typology import Typology

Curves = tuple[dict[str, Fragility], ...]


@part_of_results
@dataclass(frozen=True, eq=False, repr=False)
class StoredCurves:
    """Standard errors of the curves of rows, then of groups, then of walls that are no row; and unions.

    Attributes
    ----------
    kinds : tuple of str
        `errors` of each curve, state by state.
    clusters : ndarray of int, shape (states, curves)
    covariances : ndarray, shape (states, curves, 2, 2)
    degrees_of_freedom : ndarray, shape (states, curves)
    unions, group_unions : tuple of dict of str to Fragility
        `Typology.unions` and `group_unions` in each state; None if the files have none.
    counts : tuple of dict of str to ndarray
        `Typology.union_counts` in each state; None if the files have none.
    """

    kinds: tuple[str, ...]
    clusters: np.ndarray[Any, Any]
    covariances: FloatArray
    degrees_of_freedom: FloatArray
    unions: Curves | None = None
    group_unions: Curves | None = None
    counts: tuple[dict[str, FloatArray], ...] | None = None

    @classmethod
    def of(cls, errors: Sequence[Sequence[Errors]]) -> StoredCurves:
        """Standard errors of each state, without unions."""
        return cls(
            tuple(one.errors for state in errors for one in state),
            np.array([[one.clusters for one in state] for state in errors]),
            np.array([[one.covariance for one in state] for state in errors]),
            np.array([[one.degrees_of_freedom for one in state] for state in errors]),
        )

    def at(self, state: int) -> StoredCurves:
        """Those of one state."""
        place = state % len(self.clusters)
        number = self.clusters.shape[1]
        return StoredCurves(
            self.kinds[number * place : number * (place + 1)],
            self.clusters[[place]],
            self.covariances[[place]],
            self.degrees_of_freedom[[place]],
            None if self.unions is None else (self.unions[place],),
            None if self.group_unions is None else (self.group_unions[place],),
            None if self.counts is None else (self.counts[place],),
        )

    def put_into(self, typology: Typology) -> Typology:
        """The typology of the last state with what is known of it."""
        people, one = typology.population, self.at(-1)
        alone = people._has_curve_of_row.tolist()
        mixed = [curve for curve, has_row in zip(typology.combined.values(), alone, strict=True) if not has_row]
        found = [
            with_errors(curve, Errors(np.array(covariance), kind, int(clusters), float(degrees)))
            if curve.has_fit
            else curve
            for curve, kind, covariance, clusters, degrees in zip(
                (*typology.curves, *(group.fit for group in typology.groups), *mixed),
                one.kinds,
                one.covariances[0],
                one.clusters[0],
                one.degrees_of_freedom[0],
                strict=True,
            )
        ]
        rows, groups = len(typology.curves), len(typology.groups)
        rest = iter(found[rows + groups :])
        walls = zip(typology.combined, people.first_rows.tolist(), alone, strict=True)
        return replace(
            typology,
            curves=tuple(found[:rows]),
            combined={name: found[first] if is_row else next(rest) for name, first, is_row in walls},
            groups=tuple(
                replace(group, fit=fit) for group, fit in zip(typology.groups, found[rows : rows + groups], strict=True)
            ),
            stored_curves=self,
            union_curves=None if one.unions is None else one.unions[0],
            group_union_curves=None if one.group_unions is None else one.group_unions[0],
            union_counts=None if one.counts is None else one.counts[0],
        )
