"""The curves of a population out of the counts of its rows; the fits, means and fractiles are Fortran's."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from dondolo._base.arguments import FloatArray, as_text
from dondolo._fortran import _binding
from dondolo.analysis.work import Work
from dondolo.curves.fragility import curve_of
from dondolo.curves.series import in_series
from dondolo.errors import Interrupted
from dondolo.populations.curve import Group, IntArray, flat_population
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
    walls = people.walls
    origin = {"im": im, "edp": float(edp_thresholds[-1])}
    first = people.first_rows
    rows = np.diff(np.append(first, len(walls))).astype(np.int32)
    counts = exceedances[-1].T
    names = b"".join(as_text("name", wall.name) + b"\n" for wall in walls)
    data = _binding.fit_walls(names, flat_population(people, levels, counts, histories))
    own = tuple(
        curve_of(curve, levels, z, n, **origin, wall=wall)
        for curve, z, n, wall in zip(data.rows, counts.astype(float), histories.T.astype(float), walls, strict=True)
    )
    combined = {}
    for i, fraction, curve, number in zip(first, data.fractions, data.walls, rows, strict=True):
        if number == 1 and people.p_occ[i] == 1.0:
            combined[walls[i].name] = own[i]
            continue
        n = histories[:, i : i + number].min(axis=1).astype(np.float64)
        occurrence = float(in_series(people.p_occ[i : i + number], np.zeros(1, dtype=np.intp))[0])
        conditional = np.minimum(fraction / occurrence, 1.0) if occurrence > 0.0 else fraction
        combined[walls[i].name] = curve_of(curve, levels, n * conditional, n, **origin, saturation=occurrence)
    together = []
    for group in data.groups:
        n = group.histories
        share = group.mean_fraction / group.saturation if group.saturation > 0.0 else group.mean_fraction
        fit = curve_of(group.curve, levels, n * np.minimum(share, 1.0), n, **origin, saturation=group.saturation)
        betas = (group.beta_walls, group.beta_records) if group.fitted > 0.0 else (math.nan, math.nan)
        means = (group.mean_fraction, group.mean_curve, group.fractiles)
        together.append(
            Group(
                group.group,
                group.mechanism,
                group.walls,
                group.weight,
                *means,
                *betas,
                group.fitted,
                group.saturation,
                fit,
            )
        )
    for array in (edp_thresholds, exceedances, histories):
        array.flags.writeable = False
    return Typology(
        people,
        im,
        levels,
        edp_thresholds,
        exceedances,
        histories,
        own,
        combined,
        tuple(together),
        work,
        warnings=tuple(data.warnings),
    )
