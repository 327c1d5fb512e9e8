"""Facts of a report on one facade, or one wall with several mechanisms, counted in the same histories."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from dondolo._fortran.records import blank_unit
from dondolo.curves.fragility import Fragility
from dondolo.figures.style import mechanism_name
from dondolo.populations.typology import Typology
from dondolo.reporting import wall
from dondolo.reporting.content import BETA, THETA, Piece, Table, figure, level, level_head, level_unit, state_name
from dondolo.reporting.numerals import number, parameter, percent, probability, whole
from dondolo.reporting.statuses import crossings

# Mechanisms whose medians stand at the beginning
_CARDS = 4


def summary(people: Typology) -> dict[str, Any]:
    """The main numbers: the curve of the same histories, and the median of each mechanism."""
    curve = people.unions[people.facade]
    cards: list[tuple[Piece, Piece, Piece]] = []
    if curve.has_fit:
        whose = "of collapse by any of its mechanisms, counted in the same histories"
        if curve.saturation < 1.0:
            whose += f", if one can occur ({100.0 * curve.saturation:.3g} %)"
        cards.append((("median ", THETA), level(curve.theta, people.im), whose))
        cards.append((("dispersion ", BETA), number(curve.beta, 3), ("standard error ", number(curve.se_beta, 3))))
    else:
        cards.append(("fit", "none", curve.status.replace("_", " ")))
    for row, one in list(zip(people.walls, people.curves, strict=True))[:_CARDS]:
        median = level(one.theta, people.im) if one.has_fit else "none"
        cards.append((("median ", THETA, " alone"), median, row.name))
    return {"cards": cards, "shares": []}


def curves(people: Typology) -> dict[str, Any]:
    """Figures of the curves, and of the damage states with those that cross."""
    name = people.facade
    alt = f"Curves of the mechanisms of {name}, and of any of them in the same histories. "
    found: dict[str, Any] = {
        "name": name,
        "union": figure(people.plot_union, alt + _in_words(name, people.unions[name])),
        "states": None,
        "crossings": None,
    }
    if len(people.edp_thresholds) > 1:
        states = [people.at(float(edp)).unions[name] for edp in people.edp_thresholds]
        words = "; ".join(_in_words(f"EDP {curve.edp_threshold:g}", curve) for curve in states)
        found["states"] = figure(people.plot_damage_states, f"Probability to reach each damage state. {words}")
        if all(curve.has_fit for curve in states):
            names = [state_name(float(edp), float(people.edp_thresholds[-1])) for edp in people.edp_thresholds]
            found["crossings"] = crossings({name: states}, names, people.levels, people.im)
    return found


def _in_words(who: str, curve: Fragility) -> str:
    """A curve in words, for those who cannot see it."""
    if not curve.has_fit:
        return f"{who}: no fit ({curve.status})."
    return f"{who}: median {curve.theta:.3g}{blank_unit(curve.im)}, dispersion {curve.beta:.3g}."


def numbers(people: Typology) -> dict[str, Any]:
    """Tables of parameters and of fractions at the levels, and what independent mechanisms would give."""
    limit, name = float(people.edp_thresholds[-1]), people.facade
    states = {state_name(float(edp), limit): people.at(float(edp)) for edp in people.edp_thresholds[::-1]}
    product = people.combined[name]
    return {
        "curves": [(state, _curves_table(one)) for state, one in states.items()],
        "levels": [(state, _levels_table(one)) for state, one in states.items()],
        "product": (THETA, " = ", level(product.theta, people.im), ", ", BETA, " = ", number(product.beta, 3))
        if product.has_fit
        else None,
    }


def _curves_table(people: Typology) -> Table:
    """Parameters of a state: of the facade, and of each mechanism alone."""
    union = people.unions[people.facade]
    rows = [(people.facade, "any of them", union)]
    rows += [
        (row.name, mechanism_name(row.mechanism), curve) for row, curve in zip(people.walls, people.curves, strict=True)
    ]
    fits = [curve for _, _, curve in rows]
    columns: dict[Piece, Sequence[Piece]] = {
        "curve": [name for name, _, _ in rows],
        "mechanism": [kind for _, kind, _ in rows],
        (THETA, f" [{level_unit(people.im)}]"): [parameter(one.theta) for one in fits],
        ("standard error of ln ", THETA): [number(one.se_ln_theta, 3) for one in fits],
        BETA: [parameter(one.beta) for one in fits],
        ("standard error of ", BETA): [number(one.se_beta, 3) for one in fits],
        "can occur": [percent(union.saturation), *(percent(p) for p in people.population.p_occ)],
        "status": [one.status for one in fits],
    }
    return Table.of(columns, ("mechanism", "status"))


def _levels_table(people: Typology) -> Table:
    """How many histories reach a state at each level, by any mechanism and by each."""
    union = people.unions[people.facade]
    columns: dict[Piece, Sequence[Piece]] = {
        level_head(people.im): [number(x) for x in people.levels],
        "histories": [whole(n) for n in union.histories],
        "reach it": [number(z) for z in union.saturation * union.collapses],
        "fraction": [
            probability(z / n) for z, n in zip(union.saturation * union.collapses, union.histories, strict=True)
        ],
    }
    if union.has_fit:
        columns["curve"] = [probability(p) for p in union(people.levels)]
    if union.has_errors:
        low, high = union.interval(people.levels)
        columns["95 % band from"] = [probability(p) for p in low]
        columns["to"] = [probability(p) for p in high]
    return Table.of(columns)


def uncertainty(people: Typology) -> dict[str, Any]:
    """Intervals of the parameters."""
    return wall.uncertainty(people.unions[people.facade])
