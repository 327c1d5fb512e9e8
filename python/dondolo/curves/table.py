"""Curves as the library takes them for tables of results."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from dondolo._fortran.tables import FlatCurve, TableColumns, fragility_columns
from dondolo.walls.wall import Wall

if TYPE_CHECKING:
    from dondolo.curves.fragility import Fragility


def flat(curve: Fragility) -> FlatCurve:
    """A curve as the library takes it."""
    (naive_11, naive_12), (_, naive_22) = curve.naive_covariance.tolist()
    (own_11, own_12), (_, own_22) = curve.covariance.tolist()
    return FlatCurve(
        status=curve.status,
        errors=curve.errors,
        theta=curve.theta,
        beta=curve.beta,
        naive_11=naive_11,
        naive_12=naive_12,
        naive_22=naive_22,
        log_likelihood=curve.log_likelihood,
        bracket_low=curve.bracket[0],
        bracket_high=curve.bracket[1],
        covariance_11=own_11,
        covariance_12=own_12,
        covariance_22=own_22,
        degrees_of_freedom=curve.degrees_of_freedom,
        deviance=curve.deviance,
        deviance_dof=curve.deviance_dof,
        clusters=curve.clusters,
        edp_threshold=curve.edp_threshold or 0.0,
    )


def fragility_table(walls: Sequence[Wall | None], curves: Sequence[Fragility]) -> TableColumns:
    """Columns of ``_fragility.csv``."""
    names = [(wall.name, wall.mechanism) if wall else ("", "") for wall in walls]
    return fragility_columns(names, [curve.im for curve in curves], [flat(curve) for curve in curves])
