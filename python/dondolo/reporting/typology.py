"""Facts of a report on the curves of a population."""

from __future__ import annotations

import functools
from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np

from dondolo._base.shown import shown_dispersion
from dondolo._base.wording import decimal, in_english, say
from dondolo.curves.fragility import Fragility
from dondolo.curves.wording import errors_in_words
from dondolo.errors import DondoloError
from dondolo.figures import style
from dondolo.figures.style import counted_walls, mechanism_name
from dondolo.populations.curve import Group
from dondolo.populations.typology import Typology
from dondolo.reporting.columns import parameters_of, shown
from dondolo.reporting.content import (
    BETA,
    THETA,
    Piece,
    Symbol,
    Table,
    figure,
    level,
    level_unit,
    pieces,
    state_name,
)
from dondolo.reporting.numerals import number, parameter, percent
from dondolo.reporting.statuses import crossings, in_words, short_status


class Words(NamedTuple):
    """What a report calls a population.

    Attributes
    ----------
    whole : str
        All of it.
    singles : str
        Its members.
    uncertainty : str
        Title of the chapter on the uncertainty of its curve.
    """

    whole: str
    singles: str
    uncertainty: str


def words_of(variants: bool) -> Words:
    """Words for walls, or for the variants of one wall whose properties are uncertain."""
    if variants:
        return Words(say("all variants"), say("single variants"), say("Uncertainty of the mean curve of the variants"))
    return Words(say("whole population"), say("single walls"), say("Uncertainty of the typological curve"))


# Samples of the bootstrap
_SAMPLES = 500
# Facades that are drawn one by one
_FACADES = 6


def summary(people: Typology) -> dict[str, Any]:
    """The main numbers, and what collapses at three of the levels."""
    curve = people["all"]
    cards: list[tuple[Piece, Piece, Piece]] = []
    if curve.fit.has_fit:
        whose: Piece = say("of collapse, whole population")
        if curve.upper_asymptote < 1.0:
            # Theta of the walls that can collapse is below the level at which half of all do.
            half = float(curve.fit.ppf(0.5))
            of_all = (
                pieces("half of all at {level}", level=level(half, people.im))
                if np.isfinite(half)
                else (say("half of all at no level"),)
            )
            share = say(
                "of collapse, the {share:.3g} % of the population that can collapse; ",
                share=100.0 * curve.upper_asymptote,
            )
            whose = (share, *of_all)
        cards.append((pieces("median {theta}", theta=THETA), level(curve.fit.theta, people.im), whose))
        of_mean = say("of the lognormal fitted to the mean")
        cards.append((pieces("dispersion {beta}", beta=BETA), number(curve.fit.beta, 3), of_mean))
    else:
        cards.append((say("lognormal fit"), say("none"), short_status(curve.fit.status)))
    between = number(shown_dispersion(curve.beta_walls), 3)
    cards.append((Symbol("β", "walls"), between, say("dispersion between walls")))
    cards.append((Symbol("β", "records"), number(curve.beta_records, 3), say("dispersion between records")))
    chosen = dict.fromkeys(int(i) for i in np.linspace(0, len(people.levels) - 1, 5)[1:-1]) or [0]
    shares = [(percent(curve.mean_curve[i]), level(people.levels[i], people.im)) for i in chosen]
    return {"cards": cards, "shares": shares, "measure": style.im_label(people.im).split(" [")[0]}


def curves(people: Typology) -> dict[str, Any]:
    """Figures of the curves, and of the damage states with those that cross."""
    of_all = [curve for curve in people.groups if not curve.group]
    found: dict[str, Any] = dict.fromkeys(("combination", "groups", "states", "crossings"))
    if len(of_all) > 1:
        alt = say("Mean fragility curve of each mechanism and of all together.") + " " + _in_words(of_all)
        found["combination"] = figure(people.plot_combination, alt)
    found["mechanisms"] = []
    for curve in sorted(of_all, key=lambda one: one.mechanism == "all"):
        name = mechanism_name(curve.mechanism)
        words = {"walls": counted_walls(curve.n_walls), "mechanism": name}
        alt = say("Fragility curves of {walls}, {mechanism}, their mean and fractiles.", **words) + " "
        drawn = figure(people[curve.mechanism].plot, alt + _in_words([curve]))
        found["mechanisms"].append((name[0].upper() + name[1:], drawn))
    if grouped := [curve for curve in combined(people) if curve.group]:
        alt = say("Mean fragility curve of each group beside that of the population.") + " " + _in_words(grouped)
        found["groups"] = figure(people.plot_groups, alt)
    found["facades"] = []
    for name, union in list(unions(people).items())[:_FACADES]:
        if name not in people.population.facades:
            continue
        alt = say("Curves of the walls of facade {name}, their product and the union of the same histories.", name=name)
        texts = " " + _curve_in_words(say("facade {name}", name=name), union) + "."
        found["facades"].append((name, figure(functools.partial(people.plot_union, name=name), alt + texts)))
    if len(people.edp_thresholds) > 1:
        of_states = _in_words([people.at(edp)["all"] for edp in people.edp_thresholds])
        alt = say("Probability to reach each damage state. {words}", words=of_states)
        found["states"] = figure(people.plot_damage_states, alt)
        found["crossings"] = _crossings(people)
    return found


def _crossings(people: Typology) -> Table | None:
    """Mean curves of damage states that cross."""
    limit = float(people.edp_thresholds[-1])
    states = {
        f"{curve.group or say('whole population')}, {mechanism_name(curve.mechanism)}": [
            people.at(edp)[curve.mechanism, curve.group] for edp in people.edp_thresholds
        ]
        for curve in people.groups
    }
    return crossings(states, [state_name(float(edp), limit) for edp in people.edp_thresholds], people.levels, people.im)


def combined(people: Typology) -> list[Group]:
    """The last curve of the population and of each group: all mechanisms."""
    return list({curve.group: curve for curve in people.groups}.values())


def _in_words(curves: Sequence[Group]) -> str:
    """Curves in words, for those who cannot see them."""
    texts = []
    for curve in curves:
        who = f"{curve.group or say('population')}, {mechanism_name(curve.mechanism)}"
        texts.append(_curve_in_words(who, curve.fit))
    return "; ".join(texts) + "."


def _curve_in_words(who: str, fit: Fragility) -> str:
    """A curve of a damage state in words."""
    if fit.edp_threshold is None or not fit.has_fit:
        return f"{who}: {in_words(fit)}"
    return say(
        "{whose}, EDP {threshold:g}: {words}", whose=who, threshold=float(fit.edp_threshold), words=in_words(fit)
    )


def unions(people: Typology) -> dict[str, Fragility]:
    """Facades and walls with several mechanisms in the same histories; none if the files have none."""
    return people.unions if people.knows_unions else {}


def _unions_table(people: Typology) -> Table | None:
    """Parameters of the unions beside those of the products."""
    if not (found := unions(people)):
        return None
    products = [people.combined[name] for name in found]
    columns = {
        "whole": list(found),
        "mechanisms": [people.population.wholes.count(name) for name in found],
        **parameters_of(found.values(), "theta", "beta", "se_ln_theta", "status"),
        "independent_theta": [curve.theta for curve in products],
        "independent_beta": [curve.beta for curve in products],
    }
    return shown(columns, people.im)


def numbers(people: Typology, words: Words) -> dict[str, Any]:
    """Tables of parameters and of probabilities at the levels."""
    limit, whole_population = float(people.edp_thresholds[-1]), people["all"]
    return {
        "words": words,
        "curves": _curves_table(people, words),
        "unions": _unions_table(people),
        "has_alternatives": bool(people.population.alternative_numbers.any()),
        "states": [
            (state_name(edp, limit), _curves_table(people.at(edp), words)) for edp in people.edp_thresholds[:-1]
        ],
        "levels": [
            (state_name(edp, limit), _levels_table(people, people.at(float(edp))["all"]))
            for edp in people.edp_thresholds[::-1]
        ],
        "others": [
            (
                f"{curve.group or words.whole.capitalize()}, {mechanism_name(curve.mechanism)}",
                _levels_table(people, curve),
            )
            for curve in people.groups
            if (curve.group, curve.mechanism) != (whole_population.group, whole_population.mechanism)
        ],
    }


def _curves_table(people: Typology, words: Words) -> Table:
    """Parameters of all curves of one state."""
    curves = people.groups

    def misfit(curve: Group) -> float:
        if not curve.fit.has_fit:
            return np.nan
        return float(np.abs(curve.fit(people.levels) - curve.mean_fraction).max())

    columns = {
        "group": [curve.group or words.whole for curve in curves],
        "mechanism": [curve.mechanism for curve in curves],
        "walls": [curve.n_walls for curve in curves],
        "weight": [curve.weight for curve in curves],
        **parameters_of((curve.fit for curve in curves), "theta", "se_ln_theta", "beta", "se_beta"),
        "beta_walls": [curve.beta_walls for curve in curves],
        "beta_records": [curve.beta_records for curve in curves],
        "beta_total": [curve.beta_total for curve in curves],
        "misfit": [misfit(curve) for curve in curves],
        "fitted": [curve.fitted for curve in curves],
        "status": [curve.fit.status for curve in curves],
    }
    return shown(columns, people.im)


def _levels_table(people: Typology, curve: Group) -> Table:
    """Means and fractiles at the levels."""
    low, middle, high = curve.level_fractiles
    columns = {
        "im_level": people.levels,
        "mean_fraction": curve.mean_fraction,
        "mean_curve": curve.mean_curve,
        "fractile_16": low,
        "fractile_50": middle,
        "fractile_84": high,
    }
    return shown(columns | ({"lognormal": curve.fit(people.levels)} if curve.fit.has_fit else {}), people.im)


def _parameters(people: Typology, ends: Mapping[str, tuple[float, float]]) -> Table:
    """Parameters of the whole population with their intervals, a row each."""
    fit = people["all"].fit
    rows = [(fit.theta, *ends["theta"]), (fit.beta, *ends["beta"])]
    columns: dict[Piece, Sequence[Piece]] = {say("parameter"): [(THETA, f" [{level_unit(people.im)}]"), BETA]}
    columns |= {
        head: [parameter(row[i]) for row in rows] for i, head in enumerate((say("estimate"), say("from"), say("to")))
    }
    return Table.of(columns)


def uncertainty(people: Typology) -> dict[str, Any]:
    """Intervals of the fit and of the bootstrap, or why there are none."""
    return _fitted(people) | _drawn(people)


def _fitted(people: Typology) -> dict[str, Any]:
    """Intervals by the covariance of the fit."""
    fit = people["all"].fit
    if not fit.has_errors:
        return {"fitted": None}
    clusters = errors_in_words(fit)
    if len(people.combined) > 1 and not any(part.kind == "walls" for part in fit.parts):
        clusters += say(", and walls")
    return {"fitted": _parameters(people, fit.parameter_interval()), "clusters": clusters}


def _drawn(people: Typology) -> dict[str, Any]:
    """Intervals of the bootstrap."""
    curve = people["all"]
    stored = people.flags is None
    try:
        samples = people["all"].bootstrap(n_resamples=_SAMPLES, over=("walls",) if stored else ("records", "walls"))
        intervals = samples.parameter_interval()
    except DondoloError as error:
        return {"problem": str(error) if in_english() else say("see the English message of the library")}
    low, high = samples.mean_interval()
    levels = {"im_level": people.levels, "mean_fraction": curve.mean_fraction, "mean_low": low, "mean_high": high}
    return {
        "problem": "",
        "samples": _SAMPLES,
        "drawn": say(" and ").join(map(say, samples.over)),
        "stored": stored,
        "without_fit": decimal(f"{100.0 * samples.without_fit:.3g} %") if samples.without_fit else "",
        "parameters": _parameters(people, intervals),
        "levels": shown(levels, people.im),
    }
