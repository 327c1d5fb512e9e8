"""Chapters of a report on the curves of a population."""

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
from dondolo.reporting.blocks import Block, CaptionedTable, Cards, Details, Paragraph, Picture
from dondolo.reporting.columns import parameters_of, shown
from dondolo.reporting.content import BETA, THETA, Piece, Symbol, Table, level, level_unit, pieces, state_name
from dondolo.reporting.numerals import number, parameter, percent
from dondolo.reporting.parts import captioned, crossing_states, on_lognormal_curves, paragraph
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


def summary(people: Typology) -> list[Block]:
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
    measure = style.im_label(people.im).split(" [")[0]
    parts: list[Any] = [
        say("Of the walls, by weight, these shares are expected to collapse for a given {measure}:", measure=measure)
    ]
    for collapsed, intensity in shares:
        parts += [", " if len(parts) > 1 else " ", pieces("{share} at {level}", share=collapsed, level=intensity)]
    return [Cards(tuple(cards)), Paragraph((*parts, "."))]


def curves(people: Typology, words: Words) -> list[Block]:
    """Figures of the curves, and of the damage states with those that cross."""
    of_all = [curve for curve in people.groups if not curve.group]
    thin = say(
        "Thin grey lines are the curves of {singles}, bold lines their weighted means; a thin line beside a mean is the"
        " lognormal fitted to it.",
        singles=words.singles,
    )
    blocks: list[Block] = [paragraph(on_lognormal_curves(), thin)]
    if len(of_all) > 1:
        alt = say("Mean fragility curve of each mechanism and of all together.") + " " + _in_words(of_all)
        caption = say(
            "Mechanisms and their combination. A wall collapses by whichever of its mechanisms comes first, each with"
            " the probability that it can occur; the band holds 68 % of the weight."
        )
        blocks.append(Picture(people.plot_combination, caption, alt))
    for curve in sorted(of_all, key=lambda one: one.mechanism == "all"):
        name = mechanism_name(curve.mechanism)
        counted = {"walls": counted_walls(curve.n_walls), "mechanism": name}
        alt = say("Fragility curves of {walls}, {mechanism}, their mean and fractiles.", **counted) + " "
        caption = say(
            "{name}: curves of {singles}, at most 300 of them drawn, weighted mean, fractiles, and the lognormal fitted"
            " to the weighted fractions (dots).",
            name=name[0].upper() + name[1:],
            singles=words.singles,
        )
        blocks.append(Picture(people[curve.mechanism].plot, caption, alt + _in_words([curve])))
    for name, union in list(unions(people).items())[:_FACADES]:
        if name not in people.population.facades:
            continue
        alt = say("Curves of the walls of facade {name}, their product and the union of the same histories.", name=name)
        texts = " " + _curve_in_words(say("facade {name}", name=name), union) + "."
        caption = say(
            "Facade {name}: its walls above each hinge, their product as if they were independent, and the collapse of"
            " any of them in the same histories.",
            name=name,
        )
        blocks.append(Picture(functools.partial(people.plot_union, name=name), caption, alt + texts))
    if grouped := [curve for curve in combined(people) if curve.group]:
        alt = say("Mean fragility curve of each group beside that of the population.") + " " + _in_words(grouped)
        caption = say("Groups beside the whole population, all mechanisms of each wall together.")
        blocks.append(Picture(people.plot_groups, caption, alt))
    if len(people.edp_thresholds) > 1:
        of_states = _in_words([people.at(edp)["all"] for edp in people.edp_thresholds])
        alt = say("Probability to reach each damage state. {words}", words=of_states)
        caption = say(
            "Damage states, {whole}. EDP is the largest rotation over the capacity, the rotation at which the wall"
            " overturns; a history reaches a state if its EDP reaches the threshold.",
            whole=words.whole,
        )
        blocks.append(Picture(people.plot_damage_states, caption, alt))
        advice = say("dondolo nrml takes it: it raises the curve of the less severe state.")
        blocks += crossing_states(_crossings(people), advice)
    return blocks


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


def numbers(people: Typology, words: Words) -> list[Block]:
    """Tables of parameters and of probabilities at the levels."""
    limit, whole = float(people.edp_thresholds[-1]), words.whole.capitalize()
    on_parameters = pieces(
        "Each line is one lognormal fitted to the weighted mean fractions. {beta_walls} and {beta_records} are the"
        " dispersions between walls and between records; they add in squares to {beta_total}, the dispersion of the"
        " mixture of the walls' own lognormals, which {beta} of the one lognormal fitted to it need not equal. The"
        " misfit is the greatest distance between the fitted curve and the mean fractions at the levels: a lognormal"
        " only approximates a mixture of walls. Fitted is the weight of the walls that have a curve of their own.",
        beta_walls=Symbol("β", "walls"),
        beta_records=Symbol("β", "records"),
        beta_total=Symbol("β", "total"),
        beta=BETA,
    )
    of_collapse = captioned(_curves_table(people, words), say("Collapse: parameters of the curves."))
    blocks: list[Block] = [paragraph(on_parameters), of_collapse]
    for edp in people.edp_thresholds[:-1]:
        state = state_name(edp, limit)
        caption = say("Damage state {state}: parameters of the curves.", state=state)
        table = captioned(_curves_table(people.at(edp), words), caption)
        blocks.append(Details(say("Curves of the damage state {state}", state=state), (table,)))
    blocks += _of_unions(people)
    blocks.append(
        paragraph(
            say("The percentiles at a level are the probabilities that 16, 50 and 84 % of the weight of the walls do"
                " not exceed: they show how different the walls are, not how well the curve is known.")
        )
    )  # fmt: skip
    for edp in people.edp_thresholds[::-1]:
        state = state_name(edp, limit)
        caption = say("{whole}, {state}: probabilities at the levels.", whole=whole, state=state)
        table = captioned(_levels_table(people, people.at(float(edp))["all"]), caption)
        blocks.append(table if edp == people.edp_thresholds[-1] else Details(f"{whole}, {state}", (table,)))
    if others := _other_levels(people, words):
        many = say("Each mechanism and group, collapse ({tables} tables)", tables=len(others))
        one = say("Each mechanism and group, collapse (1 table)")
        blocks.append(Details(many if len(others) > 1 else one, tuple(others)))
    return blocks


def _of_unions(people: Typology) -> list[Block]:
    """What facades and walls with several mechanisms do in the same histories."""
    if (table := _unions_table(people)) is None:
        return []
    words = (
        say(
            "A record that causes one mechanism may cause others too. Counted in the same histories, a facade or a wall"
            ' collapses where any of its mechanisms does; "independent" is the product 1 - ∏ (1 - P), of exclusive'
            " alternatives the weighted sum of their products."
        )
        if people.population.alternative_numbers.any()
        else say(
            "A record that causes one mechanism may cause others too. Counted in the same histories, a facade or a wall"
            ' collapses where any of its mechanisms does; "independent" is the product 1 - ∏ (1 - P).'
        )
    )
    caption = say("Facades and walls with several mechanisms, collapse in the same histories.")
    return [paragraph(words), captioned(table, caption)]


def _other_levels(people: Typology, words: Words) -> list[CaptionedTable]:
    """Probabilities at the levels of each mechanism and group, but not of the whole population."""
    whole = people["all"]
    made = []
    for curve in people.groups:
        if (curve.group, curve.mechanism) != (whole.group, whole.mechanism):
            whose = f"{curve.group or words.whole.capitalize()}, {mechanism_name(curve.mechanism)}"
            caption = say("{whose}, collapse: probabilities at the levels.", whose=whose)
            made.append(captioned(_levels_table(people, curve), caption))
    return made


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


def uncertainty(people: Typology, words: Words) -> list[Block]:
    """Intervals of the fit and of the bootstrap, or why there are none."""
    return [*_fitted(people, words), *_drawn(people)]


def _fitted(people: Typology, words: Words) -> list[Block]:
    """Intervals by the covariance of the fit."""
    fit = people["all"].fit
    if not fit.has_errors:
        return []
    clusters = errors_in_words(fit)
    if len(people.combined) > 1 and not any(part.kind == "walls" for part in fit.parts):
        clusters += say(", and walls")
    caption = say(
        "95 % intervals of the parameters, {whole}, by the covariance of the fit: {clusters}.",
        whole=words.whole,
        clusters=clusters,
    )
    return [captioned(_parameters(people, fit.parameter_interval()), caption)]


def _drawn(people: Typology) -> list[Block]:
    """Intervals of the bootstrap."""
    curve = people["all"]
    stored = people.flags is None
    try:
        samples = people["all"].bootstrap(n_resamples=_SAMPLES, over=("walls",) if stored else ("records", "walls"))
        intervals = samples.parameter_interval()
    except DondoloError as error:
        problem = str(error) if in_english() else say("see the English message of the library")
        return [paragraph(say("No intervals by resampling: {problem}.", problem=problem))]
    low, high = samples.mean_interval()
    levels = {"im_level": people.levels, "mean_fraction": curve.mean_fraction, "mean_low": low, "mean_high": high}
    drawn = say(" and ").join(map(say, samples.over))
    sentences = [
        say(
            "The curve was fitted again to {samples} samples of {drawn}, drawn with replacement (bootstrap); the"
            " intervals contain the middle 95 % of them.",
            samples=_SAMPLES,
            drawn=drawn,
        )
    ]
    if stored:
        sentences.append(
            say("Records were not resampled: the result files of a population contain counts, but not the records they"
                " belong to. The effect of a different choice of records is in the intervals of the fit above, not in"
                " these.")
        )  # fmt: skip
    if samples.without_fit:
        share = decimal(f"{100.0 * samples.without_fit:.3g} %")
        sentences.append(
            say("{without_fit} of the samples have no fit and are left out of the intervals of θ and β.",
                without_fit=share)
        )  # fmt: skip
    of_levels = say("95 % intervals of the mean fraction at each level, by drawing {drawn}.", drawn=drawn)
    return [
        paragraph(*sentences),
        captioned(
            _parameters(people, intervals), say("95 % intervals of the parameters, by drawing {drawn}.", drawn=drawn)
        ),
        Details(say("Intervals at the levels"), (captioned(shown(levels, people.im), of_levels),)),
    ]
