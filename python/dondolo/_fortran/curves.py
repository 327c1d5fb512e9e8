"""Curves that Fortran fits and evaluates."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from dondolo._base.arguments import FloatArray
from dondolo._fortran import _core
from dondolo._fortran.handles import Handle
from dondolo._fortran.library import Parcel, as_text, check, constants, receive, unpack_warnings
from dondolo.errors import DondoloWarning


class CurveData(NamedTuple):
    """A fitted curve, or why there is none; variances and covariance are naive, those of ln theta and beta."""

    status: str
    theta: float
    beta: float
    var_ln_theta: float
    covariance: float
    var_beta: float
    log_likelihood: float
    bracket_low: float
    bracket_high: float
    deviance: float
    deviance_dof: int


class FittedCurve(NamedTuple):
    """A curve with its standard errors of the kind `errors`; only clustered ones have a covariance here."""

    data: CurveData
    se_ln_theta: float
    se_beta: float
    cov_ln_theta_beta: float
    errors: str
    clusters: int
    degrees_of_freedom: float


def fit_curves(
    levels: FloatArray, collapses: FloatArray, histories: FloatArray, *, given: bool = False
) -> list[CurveData]:
    """Fit many curves in one call: collapses and histories are (curves, levels).

    Counts that a user gives are refused if they look like fractions.
    """
    z, n = np.ascontiguousarray(collapses), np.ascontiguousarray(histories)
    return _curves(receive(_core.curves.fit_curves(levels, z.T, n.T, given)), "")


def fitted_curves(parcel: Parcel, prefix: str) -> list[FittedCurve]:
    """The curves of a parcel whose names begin with a prefix."""
    kinds = constants().errors
    names = ("se_ln_theta", "se_beta", "cov_ln_theta_beta", "errors", "clusters", "degrees_of_freedom")
    own = _columns(parcel, prefix, names)
    return [
        FittedCurve(fit, of_theta, of_beta, both, kinds[code - 1], clusters, degrees)
        for fit, (of_theta, of_beta, both, code, clusters, degrees) in zip(_curves(parcel, prefix), own, strict=True)
    ]


def _curves(parcel: Parcel, prefix: str) -> list[CurveData]:
    """The curves of a parcel, without what is known of their errors."""
    statuses = constants().statuses
    names = ("status", "theta", "beta", "naive_covariance", "log_likelihood", "bracket", "deviance", "deviance_dof")
    return [
        CurveData(statuses[status - 1], theta, beta, var_theta, both, var_beta, height, low, high, deviance, dof)
        for status, theta, beta, (var_theta, both, var_beta), height, (low, high), deviance, dof in _columns(
            parcel, prefix, names
        )
    ]


def _columns(parcel: Parcel, prefix: str, names: Iterable[str]) -> Iterator[tuple[Any, ...]]:
    """What a parcel has under names with a prefix, of each curve."""
    return zip(*(parcel[prefix + name].tolist() for name in names), strict=True)


def cluster_changes(
    levels: FloatArray, collapses: FloatArray, histories: FloatArray, theta: float, beta: float
) -> tuple[FloatArray, FloatArray, str]:
    """Changes (clusters, 2) of ln theta and beta if each cluster is left out, covariance, and the kind of errors.

    Collapses and histories are (clusters, levels).
    """
    changes, covariance, code, failure = _core.curves.cluster_changes(levels, collapses.T, histories.T, theta, beta)
    check(failure)
    return changes.T, covariance, constants().errors[code - 1]


def fit_ordinal(
    levels: FloatArray, reached: FloatArray, histories: FloatArray
) -> list[tuple[CurveData, tuple[FloatArray, FloatArray, str]]]:
    """Curves of damage states with one dispersion: each with its changes, its covariance, and what errors it has.

    Histories that reach each state are (clusters, states, levels), histories (clusters, levels); changes, of ln theta
    and beta if each cluster is left out, (clusters, 2).
    """
    parcel = receive(
        _core.curves.fit_ordinal(levels, np.ascontiguousarray(reached).T, np.ascontiguousarray(histories).T)
    )
    changes, covariances, kinds = parcel["changes"], parcel["covariance"], constants().errors
    return [
        (data, (changes[:, i].copy(), covariances[i].T.copy(), kinds[code - 1]))
        for i, (data, code) in enumerate(zip(_curves(parcel, ""), parcel["errors"], strict=True))
    ]


def fit_logit(
    levels: FloatArray, collapses: FloatArray, histories: FloatArray, cluster: NDArray[np.integer[Any]]
) -> tuple[FloatArray, str]:
    """Logistic curve of counts, each at a level and of a cluster from 1; all 1 for independent histories.

    Gives b0, b1, their covariance (var b0, both, var b1) and log likelihood, and what errors there are: '' without a
    finite maximum, 'naive' or 'clustered'.
    """
    numbers, done, failure = _core.curves.fit_logit(levels, collapses, histories, cluster.astype(np.int32))
    check(failure)
    return numbers, ("", "naive", "clustered")[done]


def probability_of_rows(
    levels: FloatArray, fractions: FloatArray, theta: FloatArray, beta: FloatArray, x: FloatArray
) -> FloatArray:
    """Probabilities (rows, n) of rows of a population if they can occur; fractions are (levels, rows)."""
    found: FloatArray = _core.curves.row_probability(levels, np.asfortranarray(fractions), theta, beta, x).T
    return found


def probability_of_walls(
    p_occ: FloatArray, alternative: NDArray[np.int32], probabilities: FloatArray, rows: NDArray[np.integer[Any]]
) -> FloatArray:
    """Probability that each wall collapses (walls, n), from those of all rows if they can occur (rows, n)."""
    p = np.ascontiguousarray(probabilities).T
    whole: FloatArray = _core.curves.wall_probability(p_occ, alternative, p, rows.astype(np.int32)).T
    return whole


def slopes_of_walls(
    p_occ: FloatArray, alternative: NDArray[np.int32], probabilities: FloatArray, rows: NDArray[np.integer[Any]]
) -> FloatArray:
    """Derivative (rows, n) of the probability of each wall with respect to that of each of its rows."""
    p = np.ascontiguousarray(probabilities).T
    slopes: FloatArray = _core.curves.wall_slopes(p_occ, alternative, p, rows.astype(np.int32)).T
    return slopes


def warnings_of_curve(
    wall: Handle | None,
    levels: FloatArray,
    largest_edp: float,
    status: str,
    theta: float,
    beta: float,
    bracket: tuple[float, float],
    records: int = 0,
    edp_threshold: float = 1.0,
) -> list[DondoloWarning]:
    """Warnings of the executable for the curve of one wall from so many records, or of counts without a wall."""
    code = constants().statuses.index(status) + 1
    number = 0 if wall is None else wall.number
    ends = np.minimum(bracket, np.finfo(np.float64).max)
    parcel = receive(
        _core.curves.warn_of_curve(
            number,
            levels,
            largest_edp,
            edp_threshold=edp_threshold,
            records=records,
            theta=theta,
            beta=beta,
            bracket=ends,
            status=code,
        )
    )
    return unpack_warnings(parcel.lines)


def warnings_of_union(name: str, status: str, theta: float) -> list[DondoloWarning]:
    """What the executable would warn of, of the curve of one facade or wall with several mechanisms."""
    code = constants().statuses.index(status) + 1
    return unpack_warnings(receive(_core.curves.warn_of_union(as_text("name", name), theta=theta, status=code)).lines)


def compare_parameters(
    ratio: float, changes: FloatArray, degrees: float, confidence: float
) -> tuple[tuple[float, float], float]:
    """Interval of the ratio of a parameter of two curves, and the probability of one as far from 1 if they were equal.

    Changes are those of its logarithm if each cluster is left out.
    """
    interval, p_value = _core.curves.compare_parameters(ratio, changes, degrees, confidence)
    return (float(interval[0]), float(interval[1])), float(p_value)


def probability(theta: float, beta: float, x: FloatArray) -> FloatArray:
    """Probabilities of collapse of a lognormal curve."""
    found: FloatArray = _core.curves.probability(theta, beta, x)
    return found


def student_quantile(p: float, degrees: float) -> float:
    """Quantile of Student's t with a finite number of degrees of freedom, of a probability of at least one half."""
    return float(_core.curves.student_quantile(p, degrees))


def normal_or_student(p: float, degrees: float) -> float:
    """Quantile of Student's t, or with infinite degrees of freedom of the normal distribution."""
    from statistics import NormalDist

    # scipy.special, which has both too, takes longer to import than a figure to draw
    return student_quantile(p, degrees) if np.isfinite(degrees) else NormalDist().inv_cdf(p)
