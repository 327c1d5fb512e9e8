"""Chapters of a report on one wall: its stripes and curve, or one motion."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial

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
from dondolo.reporting.blocks import Block, Cards, Facts, Picture
from dondolo.reporting.columns import chosen, of_curve, parameters_of, shown
from dondolo.reporting.content import BETA, THETA, Pairs, Piece, Table, level, level_head, pieces, state_name
from dondolo.reporting.numerals import number, percent, probability, whole
from dondolo.reporting.parts import captioned, crossing_states, on_lognormal_curves, paragraph
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


def summary(stripes: Stripes, curve: Fragility) -> list[Block]:
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
    return [Cards(tuple(cards))]


def curves(stripes: Stripes, states: Sequence[Fragility]) -> list[Block]:
    """Figures of the histories, the curve and the damage states."""
    unit, curve = blank_unit(stripes.im), states[-1]
    counts = zip(stripes.levels, stripes.collapses, stripes.histories, strict=True)
    levels = ", ".join(say("{many} of {of} at {level:g}{unit}", many=z, of=n, level=x, unit=unit) for x, z, n in counts)
    blocks: list[Block] = [
        paragraph(on_lognormal_curves()),
        Picture(
            stripes.plot,
            say("Every history of the analysis. EDP is the largest rotation over the capacity, the rotation at which"
                " the wall overturns; triangles mark collapses, with their number."),
            say("Largest rotation over capacity of every history at every level. Collapses: {levels}.", levels=levels),
        ),
        Picture(
            curve.plot,
            say("The curve fitted by maximum likelihood, and the fractions of collapse. The band is the 95 % interval"
                " of the curve, by the covariance of the fit; the bars are exact binomial intervals of one stripe each"
                " (Clopper and Pearson), which take its histories as independent: the two are different statistics,"
                " and bars may be narrower."),
            say("Fractions of collapse and fitted fragility curve: {words}.", words=in_words(curve)),
        ),
    ]  # fmt: skip
    if len(states) > 1:
        thresholds = (", " if in_english() else "; ").join(decimal(f"{one.edp_threshold:g}") for one in states)
        blocks.append(
            Picture(
                partial(draw_damage_states, stripes, None, states, {}),
                say("Damage states: a history reaches a state if its EDP reaches the threshold."),
                say("Fragility curves of the damage states EDP {thresholds}.", thresholds=thresholds),
            )
        )
    return blocks


def numbers(stripes: Stripes, fits: Sequence[Fragility]) -> list[Block]:
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
    advice = say(
        "With states = 'ordinal', in &stripes or of fit_damage_states in Python, all states have one dispersion, and"
        " their curves do not cross."
    )
    return [
        captioned(shown(states, stripes.im), say("Curves of the damage states.")),
        *crossing_states(crossed, advice),
        captioned(shown(levels, stripes.im), say("Stripes: outcomes at each level.")),
    ]


def uncertainty(curve: Fragility) -> list[Block]:
    """Intervals of the parameters by each method, or the levels between which the median lies."""
    if not curve.has_fit:
        low, high = curve.bracket
        sentence = pieces(
            "There is no finite fit, and so no interval: half of the histories begin to collapse between {low} and"
            " {high} (status {status}: {meaning}).",
            low=number(low),
            high=level(high, curve.im),
            status=curve.status if in_english() else short_status(curve.status),
            meaning=status_meaning(curve.status),
        )
        return [paragraph(sentence)]
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
    on_records = say(
        "The same records are run at every level. The clustered covariance and the bootstrap, which draws whole"
        " records, account for that; naive errors treat all histories as independent, and are too small."
    )
    on_tails = say(
        "Where levels reach far into the tails, intervals of β are somewhat too narrow: of exactly lognormal capacities"
        " they contain it in 92, 93 and 93 % of the studies with 22, 44 and 100 records."
    )
    table = shown({"method": list(methods), **ends})
    return [paragraph(on_records), captioned(table, say("95 % intervals of the parameters.")), paragraph(on_tails)]


def certificates(stripes: Stripes, curves: Sequence[Fragility], states: States) -> list[Block]:
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
    counts: Pairs = [
        (say(_CERTIFIED[kind]), whole(int(np.count_nonzero(stripes.status == kind)))) for kind in Certified
    ]
    if stripes.edp_rounded is not None:
        changed, known = stripes.rounding_changes()
        among = pieces("{changed} of {known}", changed=whole(changed), known=whole(known)) if known else say("unknown")
        counts.append((say("outcomes that the rounding of the records changes"), among))
    on_rounding = say(
        "Rocking amplifies rounding errors, in some histories until they decide the outcome. Histories whose estimated"
        " error left the outcome in doubt were rerun in 33 digits. A history is not computable if the last digit of the"
        " factor on its record, or of the tolerance, decides the outcome: its EDP lies between bounds, and so do the"
        " medians, with every such history that may reach a damage state counted as reaching it, and with none."
    )
    on_digits = say(
        "All histories were also run with every sample of their records moved within half a unit of its last printed"
        " digit; records whose samples are no decimals of few digits have no such digits."
    )
    of_medians = say("Medians, and their bounds from the histories that are not computable.")
    of_levels = say("How the histories of each level are certified, and the fractions that reach each damage state.")
    return [
        paragraph(on_rounding, on_digits),
        Facts(tuple(counts)),
        captioned(shown(medians, stripes.im), of_medians),
        captioned(Table.of(columns), of_levels),
    ]


def motion_summary(motion: Response) -> list[Block]:
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
    return [Cards(tuple(cards))]


# What moves in a time history, by what the wall feels
_MOVED = {
    "ground": _("Ground acceleration of {record}, times {scale}, and rotation of the wall."),
    "floor": _("Acceleration of the floor that the wall stands on under {record}, times {scale}, and rotation of the"
               " wall."),
    "felt": _("Acceleration of the base of the wall, of its top, and what the wall feels of both under {record}, times"
              " {scale}, and rotation of the wall."),
}  # fmt: skip


def motion(motion: Response) -> list[Block]:
    """Figures of a motion."""
    outcome = (
        say("it overturns")
        if motion.collapsed
        else say("largest rotation {edp:.4g} of the capacity", edp=float(motion.edp))
    )
    blocks: list[Block] = [
        paragraph(
            say("Rotation is given over the capacity, the rotation at which the wall overturns under its own weight.")
        )
    ]
    if motion.time is not None:
        scale = decimal(f"{motion.scale:.4g}")
        caption = say(_MOVED[motion._support], record=motion.record.name, scale=scale)
        alt = say(
            "{support} acceleration and rotation over time: {outcome} at {time:.4g} s.",
            support=say(_SUPPORTS[motion._support]),
            outcome=outcome,
            time=float(motion.time_of_peak),
        )
        blocks.append(Picture(motion.plot, caption, alt))
    caption = say("The wall at its largest rotation, drawn to scale.")
    alt = say("The wall at its largest rotation: {outcome}.", outcome=outcome)
    return [*blocks, Picture(motion.plot_peak, caption, alt)]
