"""Facts of a report on one wall: its stripes and curve, or one motion."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from dondolo._base.shown import span
from dondolo._base.wording import decimal, in_english, say
from dondolo._fortran.records import blank_unit
from dondolo._fortran.tables import plain
from dondolo.analysis.certificate import Certified
from dondolo.analysis.plots_stripes import draw_damage_states
from dondolo.analysis.response import Response
from dondolo.analysis.stripe_fits import States
from dondolo.analysis.stripe_tables import stripes_table
from dondolo.analysis.stripes import Stripes
from dondolo.curves.fragility import Fragility
from dondolo.curves.wording import errors_in_words
from dondolo.reporting.columns import chosen, of_curve, parameters_of, shown
from dondolo.reporting.content import (
    BETA,
    THETA,
    Facts,
    Piece,
    Table,
    figure,
    level,
    level_head,
    pieces,
    state_name,
)
from dondolo.reporting.numerals import number, percent, probability, whole
from dondolo.reporting.statuses import crossings, in_words, short_status, status_meaning

# What sentences that are said elsewhere are marked by for the catalogues
_ = str
_SUPPORTS = {"ground": _("Ground"), "floor": _("Floor"), "felt": _("Felt")}
_CERTIFIED = {
    Certified.DOUBLE: _("double"),
    Certified.QUADRUPLE: _("quadruple"),
    Certified.NOT_COMPUTABLE: _("not_computable"),
}
# Samples of the bootstrap
_SAMPLES = 2000


def summary(stripes: Stripes, curve: Fragility) -> dict[str, Any]:
    """The main numbers of a wall."""
    cards: list[tuple[Piece, Piece, Piece]] = []
    if curve.has_fit:
        spread = pieces("standard error of ln {theta} {error}", theta=THETA, error=number(curve.se_ln_theta, 3))
        cards.append((pieces("median {theta}", theta=THETA), level(curve.theta, stripes.im), spread))
        error = pieces("standard error {error}", error=number(curve.se_beta, 3))
        cards.append((pieces("dispersion {beta}", beta=BETA), number(curve.beta, 3), error))
    else:
        low, high = curve.bracket
        cards.append((say("fit"), say("none"), short_status(curve.status)))
        ends = pieces("{low} and {high}", low=number(low, 3), high=level(high, stripes.im))
        cards.append((say("median between"), ends, say("levels")))
    several = span(stripes.histories)
    histories = (
        say("{levels} levels of {histories}", levels=len(stripes.levels), histories=several)
        if len(stripes.levels) > 1
        else say("1 level of {histories}", histories=several)
    )
    cards.append((say("histories"), whole(stripes.ran.sum()), histories))
    share = pieces("{share} of the histories", share=percent(stripes.collapsed.sum() / stripes.ran.sum()))
    cards.append((say("collapses"), whole(stripes.collapsed.sum()), share))
    return {"cards": cards, "shares": []}


def curves(stripes: Stripes, states: Sequence[Fragility]) -> dict[str, Any]:
    """Figures of the histories, the curve and the damage states."""
    unit, curve = blank_unit(stripes.im), states[-1]
    counts = zip(stripes.levels, stripes.collapses, stripes.histories, strict=True)
    levels = ", ".join(say("{many} of {of} at {level:g}{unit}", many=z, of=n, level=x, unit=unit) for x, z, n in counts)
    return {
        "stripes": figure(
            stripes.plot,
            say("Largest rotation over capacity of every history at every level. Collapses: {levels}.", levels=levels),
        ),
        "fragility": figure(
            curve.plot, say("Fractions of collapse and fitted fragility curve: {words}.", words=in_words(curve))
        ),
        "states": figure(
            lambda: draw_damage_states(stripes, None, states, {}),
            say(
                "Fragility curves of the damage states EDP {thresholds}.",
                thresholds=(", " if in_english() else "; ").join(decimal(f"{one.edp_threshold:g}") for one in states),
            ),
        )
        if len(states) > 1
        else None,
    }


def numbers(stripes: Stripes, fits: Sequence[Fragility]) -> dict[str, Any]:
    """Tables of the damage states and of the stripes."""
    curve = fits[-1]
    table = plain(stripes_table(stripes, [stripes.edp_limit]))
    levels = chosen(table, "im_level", "histories", "collapses", "fraction")
    levels |= of_curve(curve, stripes.levels) | {"median_edp": np.nanmedian(stripes.edp, axis=1)}
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
            "status": curve.status if in_english() else short_status(curve.status),
            "meaning": status_meaning(curve.status),
        }
    methods = {}
    if curve.has_errors:
        methods[say("covariance, {kind}", kind=errors_in_words(curve))] = curve.parameter_interval()
    if curve.sample is not None:
        methods[say("bootstrap of the records, {samples} samples", samples=_SAMPLES)] = curve.bootstrap(
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
        columns[say(_CERTIFIED[kind])] = [whole(n) for n in (stripes.status == kind).sum(axis=1)]
    thresholds = [float(one.edp_threshold or 0.0) for one in curves]
    bounds = stripes.state_bounds(thresholds, states=states)
    for threshold in thresholds:
        name = state_name(threshold, stripes.edp_limit)
        ends = zip(*stripes.exceedance_bounds(threshold), stripes.histories, strict=True)
        columns[say("fraction, {state}", state=name)] = [
            probability(low / n)
            if low == high
            else pieces("{low} to {high}", low=probability(low / n), high=probability(high / n))
            for low, high, n in ends
        ]
    medians = {
        "damage_state": [state_name(threshold, stripes.edp_limit) for threshold in thresholds],
        "theta": [one.theta for one in curves],
        "theta_lowest": [low for low, _ in bounds],
        "theta_greatest": [high for _, high in bounds],
    }
    counts: Facts = [
        (say(_CERTIFIED[kind]), whole(int(np.count_nonzero(stripes.status == kind)))) for kind in Certified
    ]
    if stripes.edp_rounded is not None:
        changed, known = stripes.rounding_changes()
        among = pieces("{changed} of {known}", changed=whole(changed), known=whole(known)) if known else say("unknown")
        counts.append((say("outcomes that the rounding of the records changes"), among))
    return {"counts": counts, "levels": Table.of(columns), "medians": shown(medians, stripes.im)}


def motion_summary(motion: Response) -> dict[str, Any]:
    """The main numbers of a motion."""
    cards: list[tuple[Piece, Piece, Piece]] = [
        ("EDP", number(motion.edp), say("largest rotation / capacity")),
        (
            say("collapse"),
            say("yes") if motion.collapsed else say("no"),
            say("limit: EDP = {limit:g}", limit=float(motion.edp_limit)),
        ),
        (say("impacts"), whole(motion.impacts), say("before the end of the record")),
        (say("time of the peak"), number(motion.time_of_peak, unit=" s"), say("of the largest rotation")),
    ]
    return {"cards": cards, "shares": []}


def motion(motion: Response) -> dict[str, Any]:
    """Figures of a motion."""
    outcome = (
        say("it overturns")
        if motion.collapsed
        else say("largest rotation {edp:.4g} of the capacity", edp=float(motion.edp))
    )
    alt = say(
        "{support} acceleration and rotation over time: {outcome} at {time:.4g} s.",
        support=say(_SUPPORTS[motion._support]),
        outcome=outcome,
        time=float(motion.time_of_peak),
    )
    return {
        "record": motion.record.name,
        "scale": decimal(f"{motion.scale:.4g}"),
        "support": motion._support,
        "history": None if motion.time is None else figure(motion.plot, alt),
        "wall": figure(motion.plot_peak, say("The wall at its largest rotation: {outcome}.", outcome=outcome)),
    }
