"""Chapters of a report on the curves of a population."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from dondolo._fortran import _binding
from dondolo._page import (
    Markup,
    cards,
    details,
    figure,
    joined,
    number,
    paragraph,
    parameter,
    percent,
    probability,
    symbol,
    table,
    whole,
)
from dondolo._report_words import (
    BETA,
    LOGNORMAL,
    THETA,
    Chapter,
    crossings,
    level_head,
    state_name,
    with_unit,
)
from dondolo.errors import DondoloError
from dondolo.figures import style
from dondolo.figures.style import counted, mechanism_name
from dondolo.populations.curve import Group
from dondolo.populations.typology import Typology

# Samples of the bootstrap
_SAMPLES = 500


def typology_cards(people: Typology) -> Markup:
    """The main numbers of a population."""
    curve = people["all"]
    entries: list[tuple[Any, Any, Any]] = []
    if curve.fit.has_fit:
        whose = "of collapse, whole population"
        if curve.saturation < 1.0:
            whose = f"of collapse, the {100.0 * curve.saturation:.3g} % of the population that can collapse"
        entries.append((joined("median ", THETA), with_unit(curve.fit.theta, people.im), whose))
        entries.append((joined("dispersion ", BETA), number(curve.fit.beta, 3), "of the lognormal fitted to the mean"))
    else:
        entries.append(("lognormal fit", "none", curve.fit.status.replace("_", " ")))
    entries.append((symbol("β", "walls"), number(curve.beta_walls, 3), "dispersion between walls"))
    entries.append((symbol("β", "records"), number(curve.beta_records, 3), "dispersion between records"))
    return cards(entries)


def typology_sentences(people: Typology) -> Markup:
    """The result in words: what collapses at three of the levels."""
    curve = people["all"]
    chosen = dict.fromkeys(int(i) for i in np.linspace(0, len(people.levels) - 1, 5)[1:-1])
    parts = [joined(percent(curve.mean_curve[i]), " at ", with_unit(people.levels[i], people.im)) for i in chosen] or [
        joined(percent(curve.mean_curve[0]), " at ", with_unit(people.levels[0], people.im))
    ]
    text = joined(*(joined(", " if k else "", part) for k, part in enumerate(parts)))
    measure = style.im_label(people.im).split(" [")[0]
    return paragraph(
        f"Of the walls, by weight, these shares are expected to collapse for a given {measure}: ", text, "."
    )


def typology_chapters(people: Typology) -> list[Chapter]:
    """Curves, tables and uncertainty of a population."""
    return [
        ("curves", "Fragility curves", _typology_figures(people)),
        ("numbers", "Parameters and fractiles", _typology_tables(people)),
        ("uncertainty", "Uncertainty of the typological curve", _typology_uncertainty(people)),
    ]


def _typology_figures(people: Typology) -> Markup:
    of_all = [curve for curve in people.groups if not curve.group]
    pieces = [
        paragraph(
            LOGNORMAL,
            " Thin grey lines are the curves of single walls, bold lines their weighted means; a thin line beside a"
            " mean is the lognormal fitted to it.",
        ),
    ]
    if len(of_all) > 1:
        pieces.append(
            figure(
                people.plot_combination,
                "Mean fragility curve of each mechanism and of all together. " + _in_words(of_all),
                "Mechanisms and their combination. A wall collapses by whichever of its mechanisms comes first, each"
                " with the probability that it can occur; the band holds 68 % of the weight.",
            )
        )
    for curve in [one for one in of_all if one.mechanism != "all"] + [one for one in of_all if one.mechanism == "all"]:
        what = mechanism_name(curve.mechanism)
        pieces.append(
            figure(
                people[curve.mechanism].plot,
                f"Fragility curves of {counted(curve.walls, 'wall')}, {what}, their mean and fractiles. "
                + _in_words([curve]),
                f"{what[0].upper()}{what[1:]}: curves of single walls, at most 300 of them drawn, weighted mean,"
                " fractiles, and the lognormal fitted to the weighted fractions (dots).",
            )
        )
    grouped = [curve for curve in combined(people) if curve.group]
    if grouped:
        pieces.append(
            figure(
                people.plot_groups,
                "Mean fragility curve of each group beside that of the population. " + _in_words(grouped),
                "Groups beside the whole population, all mechanisms of each wall together.",
            )
        )
    if len(people.edp_thresholds) > 1:
        states = [people.at(edp)["all"] for edp in people.edp_thresholds]
        pieces.append(
            figure(
                people.plot_damage_states,
                "Probability to reach each damage state. " + _in_words(states),
                "Damage states of the whole population. EDP is the largest rotation over the capacity, the rotation at"
                " which the wall overturns; a history reaches a state if its EDP comes to the threshold.",
            )
        )
        pieces.append(_crossings(people))
    return joined(*pieces)


def _crossings(people: Typology) -> Markup:
    """Mean curves of damage states that cross."""
    limit = float(people.edp_thresholds[-1])
    curves = {
        f"{curve.group or 'whole population'}, {mechanism_name(curve.mechanism)}": [
            people.at(edp)[curve.mechanism, curve.group].mean for edp in people.edp_thresholds
        ]
        for curve in people.groups
    }
    names = [state_name(float(edp), limit) for edp in people.edp_thresholds]
    return crossings(curves, names, people.levels, people.im)


def combined(people: Typology) -> list[Group]:
    """The last curve of the population and of each group: all mechanisms."""
    return list({curve.group: curve for curve in people.groups}.values())


def _in_words(curves: Sequence[Group]) -> str:
    """Curves for who cannot see them."""
    texts = []
    for curve in curves:
        who = f"{curve.group or 'population'}, {mechanism_name(curve.mechanism)}"
        if curve.fit.edp is not None and curve.fit.has_fit:
            unit = f" {_binding.unit_of(curve.fit.im)}".rstrip()
            texts.append(
                f"{who}, EDP {curve.fit.edp:g}: median {curve.fit.theta:.3g}{unit}, dispersion {curve.fit.beta:.3g}"
            )
        else:
            texts.append(f"{who}: no fit ({curve.fit.status})")
    return "; ".join(texts) + "."


def _typology_tables(people: Typology) -> Markup:
    limit = float(people.edp_thresholds[-1])
    pieces = [
        paragraph(
            "Each line is one lognormal fitted to the weighted mean fractions. ",
            symbol("β", "walls"),
            " and ",
            symbol("β", "records"),
            " part the dispersion between walls from that between records; they add in squares to ",
            symbol("β", "total"),
            ", the dispersion of the mixture of the walls' own lognormals, which ",
            BETA,
            " of the one lognormal fitted to it need not equal."
            " The misfit is the greatest distance between the fitted curve and the mean fractions at the"
            " levels: a lognormal only approximates a mixture of walls."
            " Fitted is the weight of the walls that have a curve of their own.",
        ),
        _curves_table(people, "Collapse"),
    ]
    pieces += [
        details(
            f"Curves of the damage state EDP ≥ {edp:g}",
            _curves_table(people.at(edp), f"Damage state EDP ≥ {edp:g}"),
        )
        for edp in people.edp_thresholds[:-1]
    ]
    pieces.append(
        paragraph(
            "The fractiles at a level are what 16, 50 and 84 % of the weight of the walls do not exceed: how different"
            " the walls are, not how well the curve is known."
        )
    )
    for edp in people.edp_thresholds[::-1]:
        state = people.at(float(edp))
        text = f"Whole population, {state_name(edp, limit)}"
        content = _levels_table(state, state["all"], text)
        pieces.append(content if edp == limit else details(text, content))
    whole = people["all"]
    others = [curve for curve in people.groups if (curve.group, curve.mechanism) != (whole.group, whole.mechanism)]
    rest = [
        _levels_table(
            people, curve, f"{curve.group or 'Whole population'}, {mechanism_name(curve.mechanism)}, collapse"
        )
        for curve in others
    ]
    if rest:
        pieces.append(details(f"Each mechanism and group, collapse ({counted(len(rest), 'table')})", *rest))
    return joined(*pieces)


def _curves_table(people: Typology, caption: str) -> Markup:
    """Parameters of all curves of one state."""
    curves = people.groups
    unit = f" [{_binding.unit_of(people.im) or '-'}]"

    def misfit(curve: Group) -> float:
        if not curve.fit.has_fit:
            return np.nan
        return float(np.abs(curve.fit(people.levels) - curve.mean_fraction).max())

    columns: dict[Any, Any] = {
        "group": [curve.group or "whole population" for curve in curves],
        "mechanism": [mechanism_name(curve.mechanism) for curve in curves],
        "walls": [whole(curve.walls) for curve in curves],
        "weight": [number(curve.weight) for curve in curves],
        joined(THETA, unit): [parameter(curve.fit.theta) for curve in curves],
        BETA: [parameter(curve.fit.beta) for curve in curves],
        symbol("β", "walls"): [parameter(curve.beta_walls) for curve in curves],
        symbol("β", "records"): [parameter(curve.beta_records) for curve in curves],
        symbol("β", "total"): [parameter(curve.beta_total) for curve in curves],
        "misfit": [number(misfit(curve), 2) for curve in curves],
        "fitted": [percent(curve.fitted) for curve in curves],
        "status": [curve.fit.status for curve in curves],
    }
    return table(f"{caption}: parameters of the curves.", columns, ("mechanism", "status"))


def _levels_table(people: Typology, curve: Group, caption: str) -> Markup:
    """Means and fractiles at the levels."""
    columns: dict[Any, Any] = {
        level_head(people.im): [number(level) for level in people.levels],
        "mean of fractions": [probability(p) for p in curve.mean_fraction],
        "mean of curves": [probability(p) for p in curve.mean_curve],
    }
    for share, row in zip(("16 %", "50 %", "84 %"), curve.level_fractiles, strict=True):
        columns[f"{share} fractile"] = [probability(p) for p in row]
    if curve.fit.has_fit:
        columns["lognormal"] = [probability(p) for p in curve.fit(people.levels)]
    return table(f"{caption}: probabilities at the levels.", columns)


def _typology_uncertainty(people: Typology) -> Markup:
    curve = people["all"]
    stored = people.flags is None
    over = ("walls",) if stored else ("records", "walls")
    try:
        samples = people["all"].bootstrap(_SAMPLES, over=over)
        parameters = samples.parameter_interval()
    except DondoloError as error:
        return paragraph(f"No intervals: {error}.")
    low, high = samples.mean_interval()
    drawn = " and ".join(samples.over)
    text = (
        f"The curve was fitted again to {_SAMPLES} samples of {drawn}, drawn with replacement"
        " (bootstrap); the intervals hold the middle 95 % of them."
    )
    if stored:
        text += (
            " Records were not drawn: the result files of a population hold counts, and not which record they are of,"
            " so that what a different choice of records would change is not in these intervals."
        )
    missing = samples.without_fit
    if missing:
        text += f" {100.0 * missing:.3g} % of the samples have no fit and no part in the intervals of θ and β."
    rows = [
        (joined(THETA, f" [{_binding.unit_of(people.im) or '-'}]"), curve.fit.theta, *parameters["theta"]),
        (BETA, curve.fit.beta, *parameters["beta"]),
    ]
    columns: dict[Any, Any] = {
        "parameter": [row[0] for row in rows],
        "estimate": [parameter(row[1]) for row in rows],
        "from": [parameter(row[2]) for row in rows],
        "to": [parameter(row[3]) for row in rows],
    }
    levels: dict[Any, Any] = {
        level_head(people.im): [number(level) for level in people.levels],
        "mean of fractions": [probability(p) for p in curve.mean_fraction],
        "from": [probability(p) for p in low],
        "to": [probability(p) for p in high],
    }
    return joined(
        paragraph(text),
        table(f"95 % intervals of the parameters, by drawing {drawn}.", columns),
        details(
            "Intervals at the levels",
            table(f"95 % intervals of the mean fraction at each level, by drawing {drawn}.", levels),
        ),
    )
