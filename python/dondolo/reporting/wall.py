"""Facts of a report on one wall: its stripes and curve, or one motion."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from dondolo._base.shown import span
from dondolo._fortran.records import blank_unit
from dondolo._fortran.tables import plain
from dondolo.analysis.certificate import Certified
from dondolo.analysis.plots_stripes import draw_damage_states
from dondolo.analysis.response import Response
from dondolo.analysis.stripe_tables import stripes_table
from dondolo.analysis.stripes import States, Stripes
from dondolo.curves.fragility import Fragility
from dondolo.reporting.columns import chosen, of_curve, parameters_of, shown
from dondolo.reporting.content import (
    BETA,
    THETA,
    Piece,
    Table,
    figure,
    level,
    level_head,
    state_name,
)
from dondolo.reporting.numerals import number, percent, probability, whole
from dondolo.reporting.statuses import STATUSES, crossings, in_words

# Samples of the bootstrap
_SAMPLES = 2000


def summary(stripes: Stripes, curve: Fragility) -> dict[str, Any]:
    """The main numbers of a wall."""
    cards: list[tuple[Piece, Piece, Piece]] = []
    if curve.has_fit:
        spread = ("standard error of ln ", THETA, " ", number(curve.se_ln_theta, 3))
        cards.append((("median ", THETA), level(curve.theta, stripes.im), spread))
        cards.append((("dispersion ", BETA), number(curve.beta, 3), ("standard error ", number(curve.se_beta, 3))))
    else:
        low, high = curve.bracket
        cards.append(("fit", "none", curve.status.replace("_", " ")))
        cards.append(("median between", (number(low, 3), " and ", level(high, stripes.im)), "levels"))
    histories = f"{len(stripes.levels)} levels of {span(stripes.histories)}"
    cards.append(("histories", whole(stripes.ran.sum()), histories))
    share = (percent(stripes.collapsed.sum() / stripes.ran.sum()), " of the histories")
    cards.append(("collapses", whole(stripes.collapsed.sum()), share))
    return {"cards": cards, "shares": []}


def curves(stripes: Stripes, states: Sequence[Fragility]) -> dict[str, Any]:
    """Figures of the histories, the curve and the damage states."""
    unit, curve = blank_unit(stripes.im), states[-1]
    counts = zip(stripes.levels, stripes.collapses, stripes.histories, strict=True)
    levels = ", ".join(f"{z} of {n} at {x:g}{unit}" for x, z, n in counts)
    return {
        "stripes": figure(
            stripes.plot,
            f"Largest rotation over capacity of every history at every level. Collapses: {levels}.",
        ),
        "fragility": figure(curve.plot, f"Fractions of collapse and fitted fragility curve: {in_words(curve)}."),
        "states": figure(
            lambda: draw_damage_states(stripes, None, states, {}),
            f"Fragility curves of the damage states EDP {', '.join(f'{one.edp_threshold:g}' for one in states)}.",
        )
        if len(states) > 1
        else None,
    }


def numbers(stripes: Stripes, fits: Sequence[Fragility]) -> dict[str, Any]:
    """Tables of the damage states and of the stripes."""
    curve = fits[-1]
    table = plain(stripes_table(stripes, [stripes.edp_limit]))
    levels = chosen(table, "im_level", "histories", "collapses", "fraction")
    levels |= of_curve(curve, stripes.levels) | {"median_edp": np.median(stripes.edp, axis=1)}
    names = [state_name(float(one.edp_threshold or 0.0), stripes.edp_limit) for one in fits]
    kept = ("theta", "se_ln_theta", "beta", "se_beta", "log_likelihood", "deviance", "deviance_dof", "status")
    states = {"damage_state": names} | parameters_of(fits, *kept)
    states["deviance_dof"] = [one.deviance_dof if one.has_fit else None for one in fits]
    crossed = None
    if all(one.has_fit for one in fits):
        crossed = crossings({stripes.wall.name: fits}, names, stripes.levels, stripes.im)
    return {"states": shown(states, stripes.im), "crossings": crossed, "levels": shown(levels, stripes.im)}


def uncertainty(curve: Fragility) -> dict[str, Any]:
    """Intervals of the parameters by each method, or the levels between which the median lies."""
    if not curve.has_fit:
        low, high = curve.bracket
        return {
            "intervals": None,
            "low": number(low),
            "high": level(high, curve.im),
            "status": curve.status,
            "meaning": STATUSES[curve.status],
        }
    methods = {}
    if curve.has_errors:
        methods[f"covariance, {curve._kind()}"] = curve.parameter_interval()
    if curve.sample is not None:
        methods[f"bootstrap of the records, {_SAMPLES} samples"] = curve.bootstrap(
            n_resamples=_SAMPLES
        ).parameter_interval()
    ends = {
        f"{name}_{side}": [interval[name][place] for interval in methods.values()]
        for name in ("theta", "beta")
        for place, side in enumerate(("low", "high"))
    }
    return {"intervals": shown({"method": list(methods), **ends})}


def certificates(stripes: Stripes, curves: Sequence[Fragility], states: States) -> dict[str, Any]:
    """How many histories are certified in which way at each level, and bounds of each curve."""
    assert stripes.status is not None
    columns: dict[Piece, Sequence[Piece]] = {level_head(stripes.im): [number(x) for x in stripes.levels]}
    for kind in Certified:
        columns[kind.name.lower()] = [whole(n) for n in (stripes.status == kind).sum(axis=1)]
    thresholds = [float(one.edp_threshold or 0.0) for one in curves]
    bounds = stripes.state_bounds(thresholds, states=states)
    for threshold in thresholds:
        name = state_name(threshold, stripes.edp_limit)
        ends = zip(*stripes.exceedance_bounds(threshold), stripes.histories, strict=True)
        columns[f"fraction, {name}"] = [
            probability(low / n) if low == high else (probability(low / n), " to ", probability(high / n))
            for low, high, n in ends
        ]
    medians = {
        "damage_state": [state_name(threshold, stripes.edp_limit) for threshold in thresholds],
        "theta": [one.theta for one in curves],
        "theta_lowest": [low for low, _ in bounds],
        "theta_greatest": [high for _, high in bounds],
    }
    counts = [(kind.name.lower(), whole(int(np.count_nonzero(stripes.status == kind)))) for kind in Certified]
    return {"counts": counts, "levels": Table.of(columns), "medians": shown(medians, stripes.im)}


def motion_summary(motion: Response) -> dict[str, Any]:
    """The main numbers of a motion."""
    cards: list[tuple[Piece, Piece, Piece]] = [
        ("EDP", number(motion.edp), "largest rotation / capacity"),
        ("collapse", "yes" if motion.collapsed else "no", f"limit: EDP = {motion.edp_limit:g}"),
        ("impacts", whole(motion.impacts), "before the end of the record"),
        ("time of the peak", number(motion.time_of_peak, unit=" s"), "of the largest rotation"),
    ]
    return {"cards": cards, "shares": []}


def motion(motion: Response) -> dict[str, Any]:
    """Figures of a motion."""
    outcome = "it overturns" if motion.collapsed else f"largest rotation {motion.edp:.4g} of the capacity"
    alt = (
        f"{motion._support.capitalize()} acceleration and rotation over time: {outcome} at {motion.time_of_peak:.4g} s."
    )
    return {
        "record": motion.record.name,
        "scale": f"{motion.scale:.4g}",
        "support": motion._support,
        "history": None if motion.time is None else figure(motion.plot, alt),
        "wall": figure(motion.plot_peak, f"The wall at its largest rotation: {outcome}."),
    }
