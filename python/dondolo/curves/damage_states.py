"""Curves of damage states with one dispersion, which never cross."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from dondolo._fortran.curves import fit_ordinal
from dondolo.curves.clusters import errors_of_changes
from dondolo.curves.fitting import curve_of, with_errors
from dondolo.curves.fragility import Fragility
from dondolo.curves.sample import Sample


def fit_states(samples: Sequence[Sample], thresholds: Sequence[float], **origin: Any) -> tuple[Fragility, ...]:
    """Fit the curves of damage states together, without a warning.

    Parameters
    ----------
    samples : sequence of Sample
        The same histories with each state in place of collapse, from the lowest state up.
    thresholds : sequence of float
        EDP thresholds of the states, for the curves.
    **origin
        Other fields of the curves.

    Returns
    -------
    tuple of Fragility
        They keep no sample, for the bootstrap fits one curve alone.
    """
    first = samples[0]
    labels = tuple(dict.fromkeys(first.clusters))
    counts = [sample.by_cluster(labels) for sample in samples]
    histories = counts[0][1]
    ran = np.flatnonzero(histories.any(axis=1))
    kept = [labels[i] for i in ran]
    reached = np.stack([one[ran] for one, _ in counts], axis=1)
    found = []
    fits = fit_ordinal(first.levels, reached, histories[ran])
    for i, (threshold, (data, errors)) in enumerate(zip(thresholds, fits, strict=True)):
        numbers = reached[:, i].sum(axis=0), histories.sum(axis=0)
        curve = curve_of(data, first.levels, *numbers, edp_threshold=threshold, **origin)
        found.append(with_errors(curve, errors_of_changes("records", kept, *errors)) if curve.has_fit else curve)
    return tuple(found)
