"""Chapters of a report on one wall: its stripes and curve, or one motion."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from dondolo._fortran import _binding
from dondolo._page import (
    Markup,
    cards,
    facts,
    figure,
    joined,
    number,
    paragraph,
    parameter,
    percent,
    probability,
    table,
    whole,
)
from dondolo._report_words import (
    BETA,
    LOGNORMAL,
    STATUSES,
    THETA,
    Chapter,
    crossings,
    level_head,
    state_name,
    with_unit,
)
from dondolo.analysis.response import Response
from dondolo.analysis.stripes import Stripes
from dondolo.curves.fragility import Fragility

# Samples of the bootstrap
_SAMPLES = 2000


def stripes_cards(stripes: Stripes, curve: Fragility) -> Markup:
    """The main numbers of a wall."""
    entries: list[tuple[Any, Any, Any]] = []
    if curve.has_fit:
        spread = joined("standard error of ln ", THETA, " ", number(curve.se_ln_theta, 3))
        entries.append((joined("median ", THETA), with_unit(curve.theta, stripes.im), spread))
        entries.append(
            (joined("dispersion ", BETA), number(curve.beta, 3), joined("standard error ", number(curve.se_beta, 3)))
        )
    else:
        low, high = curve.bracket
        entries.append(("fit", "none", curve.status.replace("_", " ")))
        entries.append(("median between", joined(number(low, 3), " and ", with_unit(high, stripes.im)), "levels"))
    total = stripes.collapsed.size
    entries.append(("histories", whole(total), f"{len(stripes.levels)} levels of {stripes.edp.shape[1]}"))
    entries.append(
        ("collapses", whole(stripes.collapsed.sum()), joined(percent(stripes.collapsed.mean()), " of the histories"))
    )
    return cards(entries)


def stripes_chapters(stripes: Stripes, curve: Fragility, thresholds: Sequence[float]) -> list[Chapter]:
    """Figures, tables and intervals of a wall."""
    return [
        ("curves", "Histories and fragility curve", _stripes_figures(stripes, curve, thresholds)),
        ("numbers", "Stripes and damage states", _stripes_tables(stripes, curve, thresholds)),
        ("uncertainty", "Uncertainty of the curve", _stripes_uncertainty(curve)),
    ]


def _stripes_figures(stripes: Stripes, curve: Fragility, thresholds: Sequence[float]) -> Markup:
    unit = f" {_binding.unit_of(stripes.im)}".rstrip()
    levels = ", ".join(
        f"{z} of {n} at {x:g}{unit}"
        for x, z, n in zip(stripes.levels, stripes.collapses, stripes.histories, strict=True)
    )
    fitted = (
        f"median {curve.theta:.3g}{unit}, dispersion {curve.beta:.3g}" if curve.has_fit else f"no fit ({curve.status})"
    )
    pieces = [
        paragraph(LOGNORMAL),
        figure(
            stripes.plot,
            f"Largest rotation over capacity of every history at every level. Collapses: {levels}.",
            "Every history of the analysis. EDP is the largest rotation over the capacity, the rotation at which the"
            " wall overturns; triangles stand for collapses, with their number.",
        ),
        figure(
            curve.plot,
            f"Fractions of collapse and fitted fragility curve: {fitted}.",
            "The curve fitted by maximum likelihood, with its 95 % band, and the fractions of collapse with exact"
            " binomial intervals.",
        ),
    ]
    if len(thresholds) > 1:
        pieces.append(
            figure(
                lambda: stripes.plot_damage_states(edp=thresholds),
                f"Fragility curves of the damage states EDP {', '.join(f'{edp:g}' for edp in thresholds)}.",
                "Damage states: a history reaches a state if its EDP comes to the threshold.",
            )
        )
    return joined(*pieces)


def _stripes_tables(stripes: Stripes, curve: Fragility, thresholds: Sequence[float]) -> Markup:
    columns: dict[Any, Any] = {
        level_head(stripes.im): [number(level) for level in stripes.levels],
        "histories": [whole(n) for n in stripes.histories],
        "collapses": [whole(z) for z in stripes.collapses],
        "fraction": [probability(p) for p in stripes.fraction],
    }
    if curve.has_fit:
        low, high = curve.interval(stripes.levels)
        columns["fitted curve"] = [probability(p) for p in curve(stripes.levels)]
        columns["95 % band from"] = [probability(p) for p in low]
        columns["to"] = [probability(p) for p in high]
    columns["median EDP"] = [number(value, 3) for value in np.median(stripes.edp, axis=1)]
    states = [curve if edp == stripes.edp_limit else stripes.fit(float(edp)) for edp in thresholds]
    fits: dict[Any, Any] = {
        "damage state": [state_name(edp, stripes.edp_limit) for edp in thresholds],
        joined(THETA, f" [{_binding.unit_of(stripes.im) or '-'}]"): [parameter(one.theta) for one in states],
        joined("standard error of ln ", THETA): [number(one.se_ln_theta, 3) for one in states],
        BETA: [parameter(one.beta) for one in states],
        joined("standard error of ", BETA): [number(one.se_beta, 3) for one in states],
        "log likelihood": [parameter(one.log_likelihood) for one in states],
        "status": [one.status for one in states],
    }
    names = fits["damage state"]
    crossed = (
        crossings({stripes.wall.name: states}, names, stripes.levels, stripes.im)
        if all(one.has_fit for one in states)
        else ""
    )
    return joined(
        table("Curves of the damage states.", fits, ("status",)),
        crossed,
        table("Stripes: what happens at each level.", columns),
    )


def _stripes_uncertainty(curve: Fragility) -> Markup:
    if not curve.has_fit:
        low, high = curve.bracket
        return paragraph(
            "There is no finite fit, and so no interval: half of the histories begin to collapse between ",
            number(low),
            " and ",
            with_unit(high, curve.im),
            f" (status {curve.status}: {STATUSES[curve.status]}).",
        )
    methods = {
        "covariance (delta method)": curve.parameter_interval(),
        "profile likelihood": curve.parameter_interval(method="profile"),
    }
    if curve.sample is not None:
        methods[f"bootstrap of the records, {_SAMPLES} samples"] = curve.bootstrap(_SAMPLES).parameter_interval()
    columns: dict[Any, Any] = {"method": list(methods)}
    for letter, name in ((THETA, "theta"), (BETA, "beta")):
        columns[joined(letter, " from")] = [parameter(interval[name][0]) for interval in methods.values()]
        columns[joined(letter, " to")] = [parameter(interval[name][1]) for interval in methods.values()]
    return joined(
        paragraph(
            "The first two methods take all histories for independent. The bootstrap draws whole records, and so knows"
            " that the stripes share them: it is the one to rely on where they differ."
        ),
        table("95 % intervals of the parameters.", columns),
    )


def response_cards(motion: Response) -> Markup:
    """The main numbers of a motion."""
    edp = number(motion.edp, 4)
    return cards(
        [
            ("EDP", edp, "largest rotation / capacity"),
            ("collapse", "yes" if motion.collapsed else "no", f"limit: EDP = {motion.edp_limit:g}"),
            ("impacts", whole(motion.impacts), "before the end of the record"),
            ("time of the peak", joined(number(motion.time_of_peak), " s"), "of the largest rotation"),
        ]
    )


def response_chapters(motion: Response) -> list[Chapter]:
    """Figures of a motion."""
    outcome = "it overturns" if motion.collapsed else f"largest rotation {motion.edp:.4g} of the capacity"
    pieces = [
        paragraph(
            "Rotation is given over the capacity, the rotation at which the wall overturns under its own weight."
        ),
        *(
            [
                figure(
                    motion.plot,
                    f"Ground acceleration and rotation over time: {outcome} at {motion.time_of_peak:.4g} s.",
                    f"Ground acceleration of {motion.record.name}, times {motion.scale:.4g}, and rotation of the wall.",
                )
            ]
            if motion.time is not None
            else []
        ),
        figure(
            motion.plot_peak,
            f"The wall at its largest rotation: {outcome}.",
            "The wall at its largest rotation, drawn to scale.",
        ),
    ]
    return [
        ("motion", "Motion", joined(*pieces)),
        ("numbers", "Numbers", facts((name, text) for name, text in motion._facts())),
    ]
