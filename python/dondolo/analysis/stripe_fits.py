"""Curves fitted to stripes, and bounds of them from the histories that are not computable."""

from __future__ import annotations

import dataclasses
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
from numpy.typing import ArrayLike, NDArray

from dondolo._base.arguments import FloatArray, argument_error, as_array, one_of
from dondolo._fortran.curves import warnings_of_curve
from dondolo._fortran.library import warn
from dondolo.curves.damage_states import fit_states
from dondolo.curves.fitting import fit
from dondolo.curves.fragility import Fragility
from dondolo.curves.sample import Sample, cluster_labels, given_labels
from dondolo.errors import DondoloWarning, NotKnownError, silent
from dondolo.walls.wall import upload

if TYPE_CHECKING:
    from dondolo.analysis.stripes import Stripes

#: Fits of damage states: each on its own, or all with one dispersion
States = Literal["separate", "ordinal"]

# Damage states if none are named, as shares of the collapse limit
_SHARES = (0.1, 0.4, 1.0)


def fit_stripes(stripes: Stripes, edp_threshold: float | None, events: Sequence[Any] | None = None) -> Fragility:
    """The curve of collapse, or of a damage state: see `Stripes.fit`."""
    state = stripes if edp_threshold is None else _state(stripes, edp_threshold)
    curve = fit(
        stripes.levels,
        state.collapses.astype(np.float64),
        stripes.histories.astype(np.float64),
        im=stripes.im,
        wall=stripes.wall,
        edp_threshold=state.edp_limit,
        sample=sample_of(state, events),
    )
    _warn_of(stripes, curve, "" if edp_threshold is None else _of_state(edp_threshold))
    return curve


def fit_damage_states(
    stripes: Stripes, edp_thresholds: ArrayLike | None, states: States, events: Sequence[Any] | None = None
) -> tuple[Fragility, ...]:
    """The curves of damage states: see `Stripes.fit_damage_states`."""
    one_of("states", states, ("separate", "ordinal"))
    limits = thresholds_of(stripes, edp_thresholds)
    if states == "separate":
        return tuple(fit_stripes(stripes, threshold, events) for threshold in limits)
    samples = [sample_of(_state(stripes, threshold), events) for threshold in limits]
    curves = fit_states(samples, limits, im=stripes.im, wall=stripes.wall)
    for curve, threshold in zip(curves, limits, strict=True):
        _warn_of(stripes, curve, _of_state(threshold))
    return curves


def thresholds_of(stripes: Stripes, edp_thresholds: ArrayLike | None) -> list[float]:
    """Thresholds of damage states, checked."""
    if edp_thresholds is None:
        return [share * stripes.edp_limit for share in _SHARES]
    limits: list[float] = as_array("edp_thresholds", edp_thresholds).tolist()
    if not limits:
        raise argument_error("not_given", "edp_thresholds", ": must be given")
    for before, threshold in zip([0.0, *limits], limits, strict=False):
        stripes.exceedances(threshold)
        if not threshold > before:
            raise argument_error(
                "not_increasing", "edp_thresholds", f" = {before:g}, {threshold:g}: must increase strictly"
            )
    return limits


def fit_warnings(stripes: Stripes, curve: Fragility) -> list[DondoloWarning]:
    """What the executable would warn of, of a curve of stripes."""
    numbers = curve.theta, curve.beta, curve.bracket
    largest = float(np.nanmax(stripes.edp))
    walls = upload((stripes.wall,))
    state = stripes.edp_limit if curve.edp_threshold is None else curve.edp_threshold
    return warnings_of_curve(
        walls, stripes.levels, largest, curve.status, *numbers, records=stripes.n_records, edp_threshold=state
    )


def sample_of(stripes: Stripes, events: Sequence[Any] | None = None) -> Sample:
    """The histories of stripes as a curve keeps them."""
    names = stripes.record_names[: stripes.n_records]
    return Sample(
        levels=stripes.levels,
        collapsed=stripes.collapsed,
        ran=stripes.ran,
        record_index=stripes.record_index,
        record_names=names,
        clusters=cluster_labels(len(names), stripes.events, stripes.checksums)
        if events is None
        else given_labels(len(names), events),
    )


def state_bounds(
    stripes: Stripes, edp_thresholds: ArrayLike | None, states: States, asked: str = "state_bounds"
) -> tuple[tuple[float, float], ...]:
    """Bounds of theta of damage states: see `Stripes.state_bounds`; asked: by which name."""
    lowest, highest = _certified_edps(stripes, asked)
    with silent():
        low, high = (
            fit_damage_states(
                dataclasses.replace(stripes, edp=edp, collapsed=edp >= stripes.edp_limit), edp_thresholds, states
            )
            for edp in (highest, lowest)
        )
    return tuple((one.theta, other.theta) for one, other in zip(low, high, strict=True))


def exceedance_bounds(stripes: Stripes, edp_threshold: float) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Bounds of the number of histories that reach a threshold: see `Stripes.exceedance_bounds`."""
    bounds = _certified_edps(stripes, "exceedance_bounds")
    fewest, most = (dataclasses.replace(stripes, edp=edp).exceedances(edp_threshold) for edp in bounds)
    return fewest, most


def _certified_edps(stripes: Stripes, asked: str) -> tuple[FloatArray, FloatArray]:
    """The lowest and the highest EDPs."""
    if stripes.edp_lowest is None or stripes.edp_highest is None:
        raise NotKnownError(f"{asked}: only of certified stripes")
    return stripes.edp_lowest, stripes.edp_highest


def _state(stripes: Stripes, edp_threshold: float) -> Stripes:
    """Stripes as if collapse were a smaller rotation, which the bootstrap of a damage state takes for it."""
    stripes.exceedances(edp_threshold)
    edp, collapsed = np.minimum(stripes.edp, edp_threshold), stripes.edp >= edp_threshold
    return dataclasses.replace(stripes, edp=edp, collapsed=collapsed, edp_limit=edp_threshold)


def _of_state(edp_threshold: float) -> str:
    return f"damage state {edp_threshold:g} in place of collapse: "


def _warn_of(stripes: Stripes, curve: Fragility, where: str) -> None:
    """Warn of a curve as the executable does."""
    warn(one.placed(where) for one in fit_warnings(stripes, curve))
