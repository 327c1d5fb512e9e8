"""Facts of a report on one wall: its stripes and curve, or one motion."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from dondolo._base.shown import span
from dondolo._fortran.records import blank_unit
from dondolo.analysis.certificate import Certified
from dondolo.analysis.plots_stripes import draw_damage_states
from dondolo.analysis.response import Response
from dondolo.analysis.stripes import States, Stripes
from dondolo.curves.fragility import Fragility
from dondolo.reporting.content import (
    BETA,
    THETA,
    Piece,
    Table,
    figure,
    level,
    level_head,
    level_unit,
    state_name,
)
from dondolo.reporting.numerals import number, parameter, percent, probability, whole
from dondolo.reporting.statuses import STATUSES, crossings

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
    fit = f"no fit ({curve.status})"
    if curve.has_fit:
        fit = f"median {curve.theta:.3g}{unit}, dispersion {curve.beta:.3g}"
    return {
        "stripes": figure(
            stripes.plot,
            f"Largest rotation over capacity of every history at every level. Collapses: {levels}.",
        ),
        "fragility": figure(curve.plot, f"Fractions of collapse and fitted fragility curve: {fit}."),
        "states": figure(
            lambda: draw_damage_states(stripes, None, states),
            f"Fragility curves of the damage states EDP {', '.join(f'{one.edp_threshold:g}' for one in states)}.",
        )
        if len(states) > 1
        else None,
    }


def numbers(stripes: Stripes, fits: Sequence[Fragility]) -> dict[str, Any]:
    """Tables of the damage states and of the stripes."""
    curve = fits[-1]
    levels: dict[Piece, Sequence[Piece]] = {
        level_head(stripes.im): [number(x) for x in stripes.levels],
        "histories": [whole(n) for n in stripes.histories],
        "collapses": [whole(z) for z in stripes.collapses],
        "fraction": [probability(p) for p in stripes.fraction],
    }
    if curve.has_fit:
        levels["fitted curve"] = [probability(p) for p in curve(stripes.levels)]
    if curve.has_errors:
        low, high = curve.interval(stripes.levels)
        levels["95 % band from"] = [probability(p) for p in low]
        levels["to"] = [probability(p) for p in high]
    levels["median EDP"] = [number(value, 3) for value in np.median(stripes.edp, axis=1)]
    names = [state_name(float(one.edp_threshold or 0.0), stripes.edp_limit) for one in fits]
    states: dict[Piece, Sequence[Piece]] = {
        "damage state": names,
        (THETA, f" [{level_unit(stripes.im)}]"): [parameter(one.theta) for one in fits],
        ("standard error of ln ", THETA): [number(one.se_ln_theta, 3) for one in fits],
        BETA: [parameter(one.beta) for one in fits],
        ("standard error of ", BETA): [number(one.se_beta, 3) for one in fits],
        "log likelihood": [parameter(one.log_likelihood) for one in fits],
        "status": [one.status for one in fits],
    }
    crossed = None
    if all(one.has_fit for one in fits):
        crossed = crossings({stripes.wall.name: fits}, names, stripes.levels, stripes.im)
    return {"states": Table.of(states, ("status",)), "crossings": crossed, "levels": Table.of(levels)}


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
    columns: dict[Piece, Sequence[Piece]] = {"method": list(methods)}
    for letter, name in ((THETA, "theta"), (BETA, "beta")):
        columns[letter, " from"] = [parameter(interval[name][0]) for interval in methods.values()]
        columns[letter, " to"] = [parameter(interval[name][1]) for interval in methods.values()]
    return {"intervals": Table.of(columns)}


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
    medians: dict[Piece, Sequence[Piece]] = {
        "damage state": [state_name(threshold, stripes.edp_limit) for threshold in thresholds],
        (THETA, f" [{level_unit(stripes.im)}]"): [parameter(one.theta) for one in curves],
        ("lowest ", THETA): [parameter(low) for low, _ in bounds],
        ("greatest ", THETA): [parameter(high) for _, high in bounds],
    }
    counts = [(kind.name.lower(), whole(int(np.count_nonzero(stripes.status == kind)))) for kind in Certified]
    return {"counts": counts, "levels": Table.of(columns), "medians": Table.of(medians)}


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
