"""Facts of a report on one facade, or one wall with several mechanisms, counted in the same histories."""

from __future__ import annotations

from typing import Any

from dondolo._base.wording import say
from dondolo._fortran.walls import EXCLUSIVE
from dondolo.populations.typology import Typology
from dondolo.reporting import wall
from dondolo.reporting.columns import of_curve, parameters_of, shown
from dondolo.reporting.content import BETA, THETA, Piece, Table, figure, level, pieces, state_name
from dondolo.reporting.numerals import number
from dondolo.reporting.statuses import crossings, in_words, short_status

# Mechanisms whose medians stand at the beginning
_CARDS = 4


def summary(people: Typology) -> dict[str, Any]:
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
    return {"cards": cards, "shares": []}


def _is_exclusive(people: Typology) -> bool:
    """Whether one of the mechanisms of the facade occurs, each with its probability."""
    occurrence = people.population.occurrence
    return any(
        whole == people.facade and kind == EXCLUSIVE
        for whole, kind in zip(people.population.wholes, occurrence, strict=True)
    )


def curves(people: Typology) -> dict[str, Any]:
    """Figures of the curves, and of the damage states with those that cross."""
    name = people.facade
    alt = say("Curves of the mechanisms of {name}, and of any of them in the same histories.", name=name) + " "
    if _is_exclusive(people):
        alt = say("Curves of the mechanisms of {name}, and of all with their probabilities.", name=name) + " "
    found: dict[str, Any] = {
        "name": name,
        "is_exclusive": _is_exclusive(people),
        "has_product": not people.population._has_single_alternatives(name),
        "union": figure(people.plot_union, alt + f"{name}: {in_words(people.unions[name])}."),
        "states": None,
        "crossings": None,
    }
    if len(people.edp_thresholds) > 1:
        states = [people.at(float(edp)).unions[name] for edp in people.edp_thresholds]
        words = "; ".join(
            say("EDP {threshold:g}: {words}.", threshold=curve.edp_threshold, words=in_words(curve)) for curve in states
        )
        found["states"] = figure(
            people.plot_damage_states, say("Probability to reach each damage state. {words}", words=words)
        )
        if all(curve.has_fit for curve in states):
            names = [state_name(float(edp), float(people.edp_thresholds[-1])) for edp in people.edp_thresholds]
            found["crossings"] = crossings({name: states}, names, people.levels, people.im)
    return found


def numbers(people: Typology) -> dict[str, Any]:
    """Tables of parameters and of fractions at the levels, and what independent mechanisms would give."""
    limit, name = float(people.edp_thresholds[-1]), people.facade
    states = {state_name(float(edp), limit): people.at(float(edp)) for edp in people.edp_thresholds[::-1]}
    product = people.combined[name]
    return {
        "is_exclusive": _is_exclusive(people),
        "curves": [(state, _curves_table(one)) for state, one in states.items()],
        "levels": [(state, _levels_table(one)) for state, one in states.items()],
        "product": (THETA, " = ", level(product.theta, people.im), ", ", BETA, " = ", number(product.beta, 3))
        if product.has_fit and not people.population._has_single_alternatives(name)
        else None,
    }


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


def uncertainty(people: Typology) -> dict[str, Any]:
    """Intervals of the parameters."""
    return wall.uncertainty(people.unions[people.facade])
