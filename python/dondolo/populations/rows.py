"""Curves of the rows of a population, and of its walls; and all of them as arrays, for a file.

A wall with one mechanism, which can occur, has the curve of its row. The others have one of their own.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np

from dondolo._base.arguments import FloatArray
from dondolo._fortran.curves import CurveData
from dondolo.curves.fitting import curve_of
from dondolo.curves.fragility import Fragility
from dondolo.walls.population import Population

IntArray = np.ndarray[Any, np.dtype[np.int32]]


def curves_of_rows(
    people: Population,
    levels: FloatArray,
    collapses: IntArray,
    histories: IntArray,
    fitted: Iterable[CurveData],
    **origin: Any,
) -> tuple[Fragility, ...]:
    """Curves that Fortran has fitted to collapses and histories (levels, rows)."""
    return tuple(
        curve_of(curve, levels, z, n, **origin, wall=wall)
        for curve, z, n, wall in zip(
            fitted, collapses.T.astype(float), histories.T.astype(float), people.walls, strict=True
        )
    )


def has_curve_of_row(people: Population) -> np.ndarray[Any, np.dtype[np.bool_]]:
    """Which walls have the curve of their one row, shape (walls,)."""
    first = people.first_rows
    alone: np.ndarray[Any, np.dtype[np.bool_]] = (np.diff(first, append=len(people)) == 1) & (people.p_occ[first] == 1)
    return alone


def curves_of_walls(people: Population, rows: Sequence[Fragility], others: Iterable[Fragility]) -> dict[str, Fragility]:
    """Curve of each wall or facade by its name; `others` are those that have not the curve of a row, in order."""
    rest = iter(others)
    alone = zip(people.first_rows.tolist(), has_curve_of_row(people).tolist(), strict=True)
    return {people.wholes[i]: rows[i] if own else next(rest) for i, own in alone}


def packed(curves: Sequence[Fragility]) -> dict[str, Any]:
    """What was fitted, as arrays."""
    numbers = [
        [c.theta, c.beta, *c.naive_covariance[[0, 0, 1], [0, 1, 1]], c.log_likelihood, *c.bracket] for c in curves
    ]
    return {"status": np.array([c.status for c in curves], dtype=str), "numbers": np.reshape(numbers, (-1, 8))}


def unpacked(curves: dict[str, Any]) -> list[CurveData]:
    """The same as Fortran gives it."""
    return [CurveData(*pair) for pair in zip(curves["status"].tolist(), curves["numbers"], strict=True)]


def packed_walls(people: Population, combined: dict[str, Fragility]) -> dict[str, Any]:
    """Curves of the walls that have not that of a row, with the counts that they were fitted to."""
    alone = dict(zip(combined, has_curve_of_row(people).tolist(), strict=True))
    curves = [curve for name, curve in combined.items() if not alone[name]]
    counts = np.array([[curve.collapses, curve.histories] for curve in curves])
    return packed(curves) | {"counts": counts, "saturation": np.array([curve.saturation for curve in curves])}


def unpacked_walls(curves: dict[str, Any], levels: FloatArray, **origin: Any) -> list[Fragility]:
    """The same as curves."""
    return [
        curve_of(data, levels, z, n, **origin, saturation=saturation)
        for data, (z, n), saturation in zip(
            unpacked(curves), curves["counts"], curves["saturation"].tolist(), strict=True
        )
    ]
