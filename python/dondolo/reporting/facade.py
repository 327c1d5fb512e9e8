"""Chapters of a report on one facade, or one wall with several mechanisms, counted in the same histories."""

from __future__ import annotations

from typing import Any

from dondolo._base.wording import say
from dondolo._fortran.walls import EXCLUSIVE
from dondolo.populations.typology import Typology
from dondolo.reporting import wall
from dondolo.reporting.blocks import Block, Cards, Details, Picture
from dondolo.reporting.columns import of_curve, parameters_of, shown
from dondolo.reporting.content import BETA, THETA, Piece, Table, level, pieces, state_name
from dondolo.reporting.numerals import number
from dondolo.reporting.parts import captioned, crossing_states, on_lognormal_curves, paragraph
from dondolo.reporting.statuses import crossings, in_words, short_status

# What sentences that are said elsewhere are marked by for the catalogues
_ = str
# Mechanisms whose medians stand at the beginning
_CARDS = 4


def summary(people: Typology) -> list[Block]:
    """The main numbers: the curve of the same histories, and the median of each mechanism."""
    curve = people.unions[people.facade]
    cards: list[tuple[Piece, Piece, Piece]] = []
    if curve.has_fit:
        whose = say("of collapse by any of its mechanisms, counted in the same histories")
        if _is_exclusive(people):
            whose = say("of collapse, each history with the probability of the mechanisms that collapse in it")
        if curve.upper_asymptote < 1.0:
            whose += say(", if one can occur ({share:.3g} %)", share=100.0 * curve.upper_asymptote)
        cards.append((pieces("median {theta}", theta=THETA), level(curve.theta, people.im), whose))
        error = pieces("standard error {error}", error=number(curve.se_beta, 3))
        cards.append((pieces("dispersion {beta}", beta=BETA), number(curve.beta, 3), error))
    else:
        cards.append((say("fit"), say("none"), short_status(curve.status)))
    for row, one in list(zip(people.walls, people.curves, strict=True))[:_CARDS]:
        median = level(one.theta, people.im) if one.has_fit else say("none")
        cards.append((pieces("median {theta} alone", theta=THETA), median, row.name))
    return [Cards(tuple(cards))]


def _is_exclusive(people: Typology) -> bool:
    """Whether one of the mechanisms of the facade occurs, each with its probability."""
    occurrence = people.population.occurrence
    return any(
        whole == people.facade and kind == EXCLUSIVE
        for whole, kind in zip(people.population.wholes, occurrence, strict=True)
    )


def curves(people: Typology) -> list[Block]:
    """Figures of the curves, and of the damage states with those that cross."""
    name = people.facade
    alt = say("Curves of the mechanisms of {name}, and of any of them in the same histories.", name=name) + " "
    sentence = _(
        "{name}: each of its mechanisms alone, any of them in the same histories (bold, with the fractions at the"
        " levels), and independent mechanisms (thin grey)."
    )
    if _is_exclusive(people):
        alt = say("Curves of the mechanisms of {name}, and of all with their probabilities.", name=name) + " "
        sentence = _(
            "{name}: each of its mechanisms alone, all of them in the same histories with the probabilities of their"
            " alternatives (bold, with the fractions at the levels), and independent mechanisms within an alternative"
            " (thin grey)."
        )
        if people.population._has_single_alternatives(name):
            sentence = _(
                "{name}: each of its mechanisms alone, and all of them in the same histories with their probabilities"
                " (bold, with the fractions at the levels)."
            )
    alt += f"{name}: {in_words(people.unions[name])}."
    blocks: list[Block] = [
        paragraph(on_lognormal_curves()),
        Picture(people.plot_union, say(sentence, name=name), alt),
    ]
    if len(people.edp_thresholds) > 1:
        states = [people.at(float(edp)).unions[name] for edp in people.edp_thresholds]
        words = "; ".join(
            say("EDP {threshold:g}: {words}.", threshold=curve.edp_threshold, words=in_words(curve)) for curve in states
        )
        alt = say("Probability to reach each damage state. {words}", words=words)
        caption = say(
            "Damage states, any mechanism, in the same histories. EDP is the largest rotation over the capacity; a"
            " history reaches a state if its EDP comes to the threshold."
        )
        blocks.append(Picture(people.plot_damage_states, caption, alt))
        if all(curve.has_fit for curve in states):
            names = [state_name(float(edp), float(people.edp_thresholds[-1])) for edp in people.edp_thresholds]
            crossed = crossings({name: states}, names, people.levels, people.im)
            advice = say("dondolo nrml takes it: it raises the curve of the less severe state.")
            blocks += crossing_states(crossed, advice)
    return blocks


def numbers(people: Typology) -> list[Block]:
    """Tables of parameters and of fractions at the levels, and what independent mechanisms would give."""
    limit, name = float(people.edp_thresholds[-1]), people.facade
    states = {state_name(float(edp), limit): people.at(float(edp)) for edp in people.edp_thresholds[::-1]}
    counted = (
        say(
            "One of the mechanisms, or of their alternatives, occurs. A history, of one record, polarity and level,"
            " counts with the sum of the probabilities of those that reach the state in it."
        )
        if _is_exclusive(people)
        else say("A history, of one record, polarity and level, counts if any of the mechanisms reaches the state in"
                 " it.")
    )  # fmt: skip
    blocks: list[Block] = [paragraph(counted, say("The curve of each mechanism alone is that of the same histories."))]
    (main, *others) = states.items()
    caption = say("{state}: parameters of the curves.", state=main[0].capitalize())
    blocks.append(captioned(_curves_table(main[1]), caption))
    for state, one in others:
        caption = say("Damage state {state}: parameters of the curves.", state=state)
        title = say("Curves of the damage state {state}", state=state)
        blocks.append(Details(title, (captioned(_curves_table(one), caption),)))
    caption = say("{state}: histories that any mechanism collapses in, at the levels.", state=main[0].capitalize())
    blocks.append(captioned(_levels_table(main[1]), caption))
    for state, one in others:
        caption = say("Damage state {state}: histories in which any mechanism reaches it, at the levels.", state=state)
        blocks.append(Details(say("Levels, {state}", state=state), (captioned(_levels_table(one), caption),)))
    product = people.combined[name]
    if product.has_fit and not people.population._has_single_alternatives(name):
        theta, beta = level(product.theta, people.im), number(product.beta, 3)
        sentence = _(
            "Footnote. Independent mechanisms would give {parameters}. One record causes several of them, or none: the"
            " product 1 - ∏ (1 - P) counts them as if each had records of its own."
        )
        parameters = (THETA, " = ", theta, ", ", BETA, " = ", beta)
        blocks.append(paragraph(pieces(sentence, parameters=parameters), look="footnote"))
    return blocks


def _curves_table(people: Typology) -> Table:
    """Parameters of a state: of the facade, and of each mechanism alone."""
    union = people.unions[people.facade]
    curves = [union, *people.curves]
    columns = {
        "curve": [people.facade, *(row.name for row in people.walls)],
        "mechanism": [
            say("all of them") if _is_exclusive(people) else say("any of them"),
            *(row.mechanism for row in people.walls),
        ],
        **parameters_of(curves, "theta", "se_ln_theta", "beta", "se_beta"),
        "upper_asymptote": [union.upper_asymptote, *people.population.p_occ],
        "status": [curve.status for curve in curves],
    }
    return shown(columns, people.im)


def _levels_table(people: Typology) -> Table:
    """How many histories reach a state at each level, by any mechanism and by each."""
    union = people.unions[people.facade]
    reached = union.upper_asymptote * union.collapses
    columns: dict[str, Any] = {
        "im_level": people.levels,
        "histories": union.histories,
        "reached": reached,
        "fraction": reached / union.histories,
    }
    return shown(columns | of_curve(union, people.levels), people.im)


def uncertainty(people: Typology) -> list[Block]:
    """Intervals of the parameters."""
    return wall.uncertainty(people.unions[people.facade])
