"""The curves of a population out of the counts of its rows; the fits, means and fractiles are Fortran's."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from dondolo._base.arguments import FloatArray
from dondolo._fortran.curves import fit_walls
from dondolo._fortran.library import as_text
from dondolo.analysis.work import Work
from dondolo.curves.fitting import curve_of
from dondolo.curves.series import in_series
from dondolo.errors import Interrupted
from dondolo.populations.curve import Group, IntArray, flat_population
from dondolo.populations.rows import curves_of_rows, curves_of_walls, has_curve_of_row
from dondolo.populations.typology import Typology
from dondolo.walls.population import Population


def combine(
    people: Population,
    im: str,
    levels: FloatArray,
    edp_thresholds: FloatArray,
    exceedances: IntArray,
    histories: IntArray,
    complete: np.ndarray[Any, Any],
    work: Work,
) -> Typology:
    """The curves of the walls whose rows are all complete.

    Exceedances are (thresholds, levels, rows); thresholds increase, and the last is that of collapse.
    """
    first = people.first_rows
    rows = np.diff(np.append(first, len(people.walls)))
    chosen = np.flatnonzero(np.repeat(np.logical_and.reduceat(complete, first), rows))
    if len(chosen) == 0:
        raise Interrupted("interrupted: no wall is complete")
    if len(chosen) < len(people.walls):
        if not people.weights[chosen].any():
            raise Interrupted("interrupted: no wall of any weight is complete")
        people = people._chosen(chosen.tolist())
    counts = np.ascontiguousarray(exceedances[:, :, chosen], dtype=np.int32)
    sizes = np.ascontiguousarray(histories[:, chosen], dtype=np.int32)
    return combine_rows(people, im, levels, np.asarray(edp_thresholds, dtype=np.float64), counts, sizes, work)


def combine_rows(
    people: Population,
    im: str,
    levels: FloatArray,
    edp_thresholds: FloatArray,
    exceedances: IntArray,
    histories: IntArray,
    work: Work,
) -> Typology:
    """The curves of the last state."""
    origin = {"im": im, "edp_threshold": float(edp_thresholds[-1])}
    names = b"".join(as_text("name", wall.name) + b"\n" for wall in people.walls)
    data = fit_walls(names, flat_population(people, levels, exceedances[-1].T, histories))
    own = curves_of_rows(people, levels, exceedances[-1], histories, data.rows, **origin)
    first = people.first_rows
    occurrences, least = in_series(people.p_occ, first), np.minimum.reduceat(histories, first, axis=1)
    others = []
    for k in np.flatnonzero(~has_curve_of_row(people)):
        n = least[:, k].astype(np.float64)
        occurrence, fraction = float(occurrences[k]), data.fractions[k]
        conditional = np.minimum(fraction / occurrence, 1.0) if occurrence > 0.0 else fraction
        others.append(curve_of(data.walls[k], levels, n * conditional, n, **origin, saturation=occurrence))
    together = []
    for group in data.groups:
        n, values = group.histories, group.values
        share, saturation = values["mean_fraction"], values["saturation"]
        if saturation > 0.0:
            share = share / saturation
        if not values["fitted"] > 0.0:
            values |= {"beta_walls": math.nan, "beta_records": math.nan}
        fit = curve_of(group.curve, levels, n * np.minimum(share, 1.0), n, **origin, saturation=saturation)
        together.append(Group(**values, fit=fit))
    return Typology(
        population=people,
        im=im,
        levels=levels,
        edp_thresholds=edp_thresholds,
        exceedances=exceedances,
        histories=histories,
        curves=own,
        combined=curves_of_walls(people, own, others),
        groups=tuple(together),
        work=work,
        warnings=tuple(data.warnings),
    )
