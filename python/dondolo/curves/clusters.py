"""Changes of a curve if a cluster of its histories is left out: what standard errors and comparisons follow from."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np

from dondolo._base.arguments import FloatArray
from dondolo._fortran.curves import cluster_changes
from dondolo._storage.saved import part_of_results
from dondolo.curves.sample import Sample


@part_of_results
@dataclass(frozen=True, eq=False, repr=False)
class Clusters:
    """Clusters of histories, each independent of the others.

    Attributes
    ----------
    kind : str
        'records', which may be those of an earthquake together, or 'walls'.
    labels : tuple of str
        Label of each cluster; the same label is the same cluster in every curve.
    changes : ndarray, shape (clusters, 2)
        Change of ln theta and of beta, to first order, if the cluster is left out.
    """

    kind: str
    labels: tuple[str, ...]
    changes: FloatArray

    @property
    def covariance(self) -> FloatArray:
        """Covariance of ln theta and beta."""
        covariance: FloatArray = self.changes.T @ self.changes
        return covariance


class Errors(NamedTuple):
    """Standard errors of a curve, as `Fragility` has them."""

    covariance: FloatArray
    errors: str
    clusters: int
    degrees_of_freedom: float
    parts: tuple[Clusters, ...] = ()


def errors_of_parts(parts: Iterable[Clusters]) -> Errors:
    """Standard errors from independent kinds of clusters; degrees of freedom after Satterthwaite, for ln theta."""
    several = tuple(parts)
    covariance: FloatArray = np.sum([part.covariance for part in several], axis=0)
    degrees = freedom([(float(part.covariance[0, 0]), len(part.labels) - 1) for part in several])
    return Errors(covariance, "clustered", len(several[0].labels), degrees, several)


def freedom(variances: Sequence[tuple[float, int]]) -> float:
    """Degrees of freedom of a sum of variances, each with its own (Satterthwaite)."""
    whole = sum(variance for variance, _ in variances)
    if not whole > 0.0:
        return float(min(degrees for _, degrees in variances))
    return whole**2 / sum(variance**2 / degrees for variance, degrees in variances)


def no_errors(errors: str, clusters: int) -> Errors:
    """Why there are no standard errors."""
    return Errors(np.full((2, 2), np.nan), errors, clusters, np.nan)


def errors_of_table(
    se_ln_theta: float, se_beta: float, covariance: float, clusters: int, degrees_of_freedom: float
) -> Errors:
    """Clustered standard errors from the numbers that tables have of them."""
    matrix = np.array([[se_ln_theta**2, covariance], [covariance, se_beta**2]])
    return Errors(matrix, "clustered", clusters, degrees_of_freedom)


def errors_of_sample(sample: Sample, at: tuple[float, float]) -> Errors:
    """Standard errors of a curve with parameters (theta, beta) fitted to stripes, clustered by record or event."""
    labels = tuple(dict.fromkeys(sample.clusters))
    collapses, histories = sample.by_cluster(labels)
    ran = histories.any(axis=1)
    return errors_of_counts(
        "records", np.array(labels)[ran].tolist(), sample.levels, collapses[ran], histories[ran], at
    )


def errors_of_counts(
    kind: str,
    labels: Sequence[str],
    levels: FloatArray,
    collapses: FloatArray,
    histories: FloatArray,
    at: tuple[float, float],
) -> Errors:
    """Standard errors of a curve with parameters (theta, beta), from counts (clusters, levels) of each cluster."""
    return errors_of_changes(kind, labels, *cluster_changes(levels, collapses, histories, *at))


def errors_of_changes(
    kind: str, labels: Sequence[str], changes: FloatArray, covariance: FloatArray, errors: str
) -> Errors:
    """Standard errors from the changes (clusters, 2) if each cluster is left out, or why there are none."""
    if errors != "clustered":
        return no_errors(errors, len(labels))
    changes.flags.writeable = False
    parts = (Clusters(kind, tuple(labels), changes),)
    return Errors(covariance, "clustered", len(labels), float(len(labels) - 1), parts)
