"""Facades and walls with several mechanisms, counted in the same histories: docs/theory.md, section 6."""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from dondolo._base.arguments import FloatArray
from dondolo.curves.clusters import errors_of_counts
from dondolo.curves.fitting import fit, with_errors
from dondolo.curves.fragility import Fragility
from dondolo.curves.series import in_series
from dondolo.errors import InputError
from dondolo.populations.flags import Flags

if TYPE_CHECKING:
    from dondolo.populations.typology import Typology


def unions_of(typology: Typology) -> dict[str, Fragility]:
    """Curve of each facade or wall with several mechanisms, by its name."""
    flags = typology.flags
    if flags is None:
        raise InputError(
            "unions: the results were read back from files without *_unions.csv, which the executable writes"
        )
    people = typology.population
    ends = np.append(people.first_rows, len(people))
    return {
        people.wholes[first]: _union(typology, flags, np.arange(first, end))
        for first, end in pairwise(ends)
        if end - first > 1
    }


def _union(typology: Typology, flags: Flags, rows: np.ndarray[tuple[int], np.dtype[np.int64]]) -> Fragility:
    """Curve of the union of some rows."""
    p_occ = typology.population.p_occ[rows]
    survival: FloatArray = np.ones((flags.levels, int(flags.histories[rows].max())))
    for row, p in zip(rows, p_occ, strict=True):
        own = flags.of([row])[0, flags.state]
        # A wall that is the same from both sides runs each record once: reversed it ends alike.
        survival *= 1.0 - p * np.tile(own, survival.shape[1] // own.shape[1])
    labels = tuple(dict.fromkeys(flags.clusters))
    member = np.array([[own == label for own in flags.clusters] for label in labels], dtype=float)
    polarities = survival.shape[1] // flags.records
    reached = member @ (1.0 - survival).reshape(flags.levels, polarities, flags.records).sum(axis=1).T
    histories = polarities * member @ flags.runs
    saturation = float(in_series(p_occ, np.array([0]))[0])
    if saturation > 0.0:
        reached /= saturation
    total = histories.sum(axis=0)
    counts = np.minimum(reached.sum(axis=0), total)
    edp = float(typology.edp_thresholds[-1])
    curve = fit(typology.levels, counts, total, im=typology.im, edp_threshold=edp, saturation=saturation)
    if not curve.has_fit:
        return curve
    at = curve.theta, curve.beta
    return with_errors(curve, errors_of_counts("records", labels, typology.levels, reached, histories, at))
