"""Curves that Fortran fits and evaluates: of walls, and of populations."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from dondolo._base.arguments import FloatArray
from dondolo._fortran import _core
from dondolo._fortran.handles import Handle
from dondolo._fortran.library import as_text, check, constants, receive, unpack_warnings
from dondolo.errors import DondoloWarning


class CurveData(NamedTuple):
    """A fitted curve, or why there is none."""

    status: str
    numbers: FloatArray


class FlatPopulation(NamedTuple):
    """A population as Fortran takes it, with the counts of one damage state.

    Attributes
    ----------
    texts : bytes
        Mechanism and group of each row, a line each.
    levels : ndarray, shape (levels,)
    counts : ndarray of int, shape (levels, rows)
    histories : ndarray of int, shape (levels, rows)
    shares : ndarray, shape (2, rows)
        Weight of the wall and probability of occurrence.
    rows : ndarray of int, shape (walls,)
        How many each wall has.
    """

    texts: bytes
    levels: FloatArray
    counts: NDArray[np.int32]
    histories: NDArray[np.int32]
    shares: FloatArray
    rows: NDArray[np.int32]


class GroupData(NamedTuple):
    """A curve of a population, or of one of its groups: the values of a `Group`, and its curve with its histories."""

    values: dict[str, Any]
    histories: FloatArray
    curve: CurveData


class PopulationData(NamedTuple):
    """Curves of mechanisms, of walls and of their population; fractions are those of the walls (walls, levels)."""

    rows: list[CurveData]
    walls: list[CurveData]
    fractions: FloatArray
    groups: list[GroupData]
    warnings: list[DondoloWarning]


def fit_curves(levels: FloatArray, collapses: FloatArray, histories: FloatArray) -> tuple[FloatArray, list[str]]:
    """Fit many curves in one call: collapses and histories are (curves, levels)."""
    z, n = np.ascontiguousarray(collapses), np.ascontiguousarray(histories)
    curves, codes, failure = _core.curves.fit_curves(levels, z.T, n.T)
    check(failure)
    names = constants().statuses
    return curves.T, [names[code - 1] for code in codes]


def cluster_changes(
    levels: FloatArray, collapses: FloatArray, histories: FloatArray, theta: float, beta: float
) -> tuple[FloatArray, str]:
    """Changes (clusters, 2) of ln theta and beta if each cluster is left out, and what standard errors there are.

    Collapses and histories are (clusters, levels).
    """
    changes, code, failure = _core.curves.cluster_changes(levels, collapses.T, histories.T, theta, beta)
    check(failure)
    return changes.T, constants().errors[code - 1]


def fit_ordinal(
    levels: FloatArray, reached: FloatArray, histories: FloatArray
) -> list[tuple[CurveData, FloatArray, str]]:
    """Curves of damage states with one dispersion: each with its changes, and what standard errors it has.

    Histories that reach each state are (clusters, states, levels), histories (clusters, levels); changes, of ln theta
    and beta if each cluster is left out, (clusters, 2).
    """
    found = _core.curves.fit_ordinal(levels, np.ascontiguousarray(reached).T, np.ascontiguousarray(histories).T)
    curves, statuses, changes, errors, failure = found
    check(failure)
    names, known = constants().statuses, constants().errors
    return [
        (CurveData(names[statuses[i] - 1], curves[:, i]), changes[:, i].T.copy(), known[errors[i] - 1])
        for i in range(reached.shape[1])
    ]


def coded(curves: Sequence[tuple[str, float, float]]) -> tuple[FloatArray, NDArray[np.int32]]:
    """Numbers (8, curves) and codes (curves,) of curves that are known by status, theta and beta."""
    names = constants().statuses
    numbers = np.zeros((len(curves), 8))
    numbers[:, :2] = [(theta, beta) for _, theta, beta in curves]
    return numbers.T, np.array([names.index(status) + 1 for status, *_ in curves], dtype=np.int32)


def cluster_curves(
    levels: FloatArray, collapses: FloatArray, histories: FloatArray, curves: Sequence[tuple[str, float, float]]
) -> tuple[FloatArray, list[str], NDArray[np.int32]]:
    """Covariances (curves, 2, 2) of many curves, what standard errors each has, and its number of clusters.

    Collapses are (curves, clusters, levels), histories, the same for all curves, (clusters, levels).
    """
    found = _core.curves.cluster_curves(levels, collapses.T, histories.T[..., None], *coded(curves))
    covariances, errors, clusters, failure = found
    check(failure)
    known = constants().errors
    return covariances[[[0, 1], [1, 2]]].transpose(2, 0, 1), [known[code - 1] for code in errors], clusters


def fit_walls(names: bytes, population: FlatPopulation) -> PopulationData:
    """Curves of the mechanisms of walls, of the walls and of their population, and warnings.

    Names are those of the wall of each row, one a line.
    """
    parcel = receive(_core.curves.fit_walls(population.texts, names, *population[1:]))
    rows = population.rows
    m, r, w, number = len(population.levels), population.counts.shape[1], len(rows), int(parcel.integers[0])
    known = ("", *constants().statuses)
    status = [known[code] for code in parcel.integers[1 : 1 + r + w + number]]
    walls = parcel.integers[1 + r + w + number :]
    numbers, fractions, groups = np.split(parcel.reals, np.cumsum([8 * (r + w), m * w]))
    curves = [CurveData(*pair) for pair in zip(status, numbers.reshape(r + w, 8), strict=False)]
    together = []
    for i, row in enumerate(groups.reshape(number, 5 + 6 * m + 8)):
        single, histories, mean_fraction, mean_curve, fractiles, curve = np.split(row, np.cumsum([5, m, m, m, 3 * m]))
        means = ("weight", "beta_walls", "beta_records", "fitted", "saturation")
        values: dict[str, Any] = dict(zip(means, single.tolist(), strict=True))
        values |= {"group": parcel.lines[2 * i], "mechanism": parcel.lines[2 * i + 1], "n_walls": int(walls[i])}
        values |= {"mean_fraction": mean_fraction, "mean_curve": mean_curve}
        values["level_fractiles"] = np.ascontiguousarray(fractiles.reshape(m, 3).T)
        together.append(GroupData(values, histories, CurveData(status[r + w + i], curve)))
    found = unpack_warnings(parcel.lines[2 * number :])
    return PopulationData(curves[:r], curves[r:], fractions.reshape(w, m), together, found)


def curve_of_population(
    population: FlatPopulation,
    curves: tuple[FloatArray, NDArray[np.int32]],
    which: tuple[str, str],
    x: FloatArray,
    q: FloatArray,
    members: bool = False,
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """A curve of a population at some levels: its mean, fractiles (q, x) and members' probabilities (members, x).

    Curves are those of the rows, as `coded`; which: the mechanism, or 'all', and the group. The probabilities are
    there with `members` only.
    """
    texts = (as_text("group", text) for text in which)
    mean, fractiles, sent = _core.curves.curve_of_population(*population, *curves, *texts, x, q, int(members))
    check(sent)
    found = np.zeros((0, len(x)))
    if members:
        parcel = receive(sent)
        found = parcel.reals.reshape(len(x), int(parcel.integers[0])).T
    return mean, fractiles, found


def rows_in_series(probabilities: FloatArray, rows: NDArray[np.integer[Any]]) -> FloatArray:
    """Probability that any mechanism of each wall happens (walls, n), from those of all rows (rows, n)."""
    whole: FloatArray = _core.curves.in_series(np.ascontiguousarray(probabilities).T, rows.astype(np.int32)).T
    return whole


def warnings_of_curve(
    wall: Handle | None, levels: FloatArray, largest_edp: float, curve: CurveData
) -> list[DondoloWarning]:
    """Warnings of the executable for the curve of one wall, or of counts without a wall."""
    code = constants().statuses.index(curve.status) + 1
    number = 0 if wall is None else wall.number
    parcel = receive(_core.curves.warn_of_curve(number, levels, largest_edp, curve.numbers, code))
    return unpack_warnings(parcel.lines)


def warnings_of_union(name: str, status: str, theta: float) -> list[DondoloWarning]:
    """What the executable would warn of, of the curve of one facade or wall with several mechanisms."""
    code = constants().statuses.index(status) + 1
    return unpack_warnings(receive(_core.curves.warn_of_union(as_text("name", name), theta, code)).lines)


def probability(theta: float, beta: float, x: FloatArray) -> FloatArray:
    """Probabilities of collapse of a lognormal curve."""
    found: FloatArray = _core.curves.probability(theta, beta, x)
    return found


def student_quantile(p: float, degrees: float) -> float:
    """Quantile of Student's t with a finite number of degrees of freedom, of a probability of at least one half."""
    return float(_core.curves.student_quantile(p, degrees))
