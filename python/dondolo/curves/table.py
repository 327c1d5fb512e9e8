"""Curves as the rows of a table, as the executable writes them."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from dondolo._storage import tables
from dondolo.walls.wall import Wall

if TYPE_CHECKING:
    from dondolo.curves.fragility import Fragility

# Columns that standard errors are made of
ERRORS = ("se_ln_theta", "se_beta", "cov_ln_theta_beta", "errors", "clusters", "degrees_of_freedom")
_BOUNDS = ("theta_low", "theta_high", "beta_low", "beta_high")


def fragility_table(walls: Sequence[Wall | None], curves: Sequence[Fragility]) -> tables.Table:
    """Columns of ``_fragility.csv``."""
    return {
        "wall": [wall.name if wall else "" for wall in walls],
        "mechanism": [wall.mechanism if wall else "" for wall in walls],
        "im": [curve.im for curve in curves],
        "theta": [curve.theta for curve in curves],
        "beta": [curve.beta for curve in curves],
        "se_ln_theta": [curve.se_ln_theta for curve in curves],
        "se_beta": [curve.se_beta for curve in curves],
        "log_likelihood": [curve.log_likelihood for curve in curves],
        "status": [curve.status for curve in curves],
        "bracket_low": [curve.bracket[0] if curve.bracket[0] > 0.0 else None for curve in curves],
        "bracket_high": [curve.bracket[1] if np.isfinite(curve.bracket[1]) else None for curve in curves],
        "edp_threshold": [curve.edp_threshold for curve in curves],
        **{name: [row[name] for row in map(_bounds, curves)] for name in _BOUNDS},
        "errors": [curve.errors if curve.has_fit else None for curve in curves],
        "clusters": [curve.clusters if curve.has_fit else None for curve in curves],
        "degrees_of_freedom": [_freedom(curve) if curve.has_fit else None for curve in curves],
        "naive_se_ln_theta": [float(np.sqrt(curve.naive_covariance[0, 0])) for curve in curves],
        "naive_se_beta": [float(np.sqrt(curve.naive_covariance[1, 1])) for curve in curves],
        "cov_ln_theta_beta": [float(curve.covariance[0, 1]) for curve in curves],
        "deviance": [curve.deviance for curve in curves],
        "deviance_dof": [curve.deviance_dof if curve.has_fit else None for curve in curves],
    }


def errors_table(curves: Sequence[Fragility]) -> tables.Table:
    """Columns of the standard errors of ``_typology.csv``."""
    table = fragility_table([None] * len(curves), curves)
    return {name: table[name] for name in ERRORS}


def _freedom(curve: Fragility) -> float:
    """Degrees of freedom as in the table, where those of records alone are whole numbers."""
    degrees = curve.degrees_of_freedom if curve.errors == "clustered" else float(max(curve.clusters - 1, 0))
    return int(degrees) if degrees.is_integer() else degrees


def _bounds(curve: Fragility) -> dict[str, float | None]:
    """Bounds of the 95 % intervals; None where there are none."""
    if not (curve.has_fit and np.isfinite(curve.se_beta)):
        return dict.fromkeys(_BOUNDS)
    ends = [end for name in ("theta", "beta") for end in curve.parameter_interval()[name]]
    return {name: end if np.isfinite(end) else None for name, end in zip(_BOUNDS, ends, strict=True)}
