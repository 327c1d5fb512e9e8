"""Facts of a report on designs of a wall: alternatives, each beside the first, and nothing over them."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from dondolo._base.wording import decimal, say
from dondolo.checks.plots import check_name, draw_safety
from dondolo.curves.fragility import Fragility
from dondolo.curves.wording import errors_in_words
from dondolo.figures import style
from dondolo.figures.options import Options
from dondolo.populations.typology import Typology
from dondolo.reporting.columns import chosen, shown
from dondolo.reporting.content import (
    THETA,
    Piece,
    Table,
    figure,
    level,
    level_head,
    pieces,
    state_name,
)
from dondolo.reporting.numerals import number, probability
from dondolo.retrofit.designs import DesignComparison

# Columns of the comparison
_COMPARED = (
    "design", "theta", "beta", "ratio", "ratio_low", "ratio_high", "p_value", "steel_kg_m", "gain_per_kg", "alpha_0_g",
    "static_ratio",
)  # fmt: skip
_CHECKED = ("design", "alpha_0", "a_0_m_s2", "zeta_e_linear", "zeta_e")
_CHANGED = ("alpha_0_change", "a_0_change_m_s2", "zeta_e_linear_change", "zeta_e_change")
# Designs of a table of levels: what fits across a page
_ACROSS = 6

# Designs whose main numbers stand at the beginning
_CARDS = 8


def summary(found: DesignComparison) -> dict[str, Any]:
    """The main numbers: the median of the first, and what the others make of it."""
    first = found.curves[0]
    median = level(first.theta, found.im) if first.has_fit else say("none")
    cards: list[tuple[Piece, Piece, Piece]] = [
        (pieces("median {theta}, {first}", theta=THETA, first=found.names[0]), median, say("of collapse"))
    ]
    for name, ratio, (low, high) in list(zip(found.names, found.ratio, found.ratio_interval, strict=True))[1:_CARDS]:
        text = number(ratio, 3, say(" times")) if np.isfinite(ratio) else say("no ratio")
        interval = (
            say("{low:.3g} to {high:.3g} times the median of the first", low=low, high=high)
            if np.isfinite(ratio)
            else say("of medians")
        )
        cards.append((name, text, interval))
    return {"cards": cards, "shares": []}


def designs(found: DesignComparison) -> dict[str, Any]:
    """What each design gains against the first."""
    low, high = found.ratio_interval.T
    pairs = zip(found.names, found.ratio, low, high, strict=True)
    words = "; ".join(
        say("{name}: {ratio:.3g} ({least:.3g} to {most:.3g})", name=name, ratio=ratio, least=least, most=most)
        for name, ratio, least, most in pairs
    )
    alt = say(
        "Fragility curves of the designs, and the ratios of their medians to that of the first. {words}.", words=words
    )
    return {
        "first": found.names[0],
        "confidence": decimal(f"{100.0 * found.confidence:.4g}"),
        "figure": figure(found.plot, alt),
        "table": shown(chosen(found._table(), *_COMPARED), found.im),
        "has_checks": bool(found.checks) and found.im == "pga",
        "checks": _checks(found) if found.checks else None,
        "indices": figure(lambda: _indices(found), say("Safety indices of the designs, those of the table."))
        if found.checks
        else None,
    }


def _checks(found: DesignComparison) -> Table:
    """The checks of all designs beside each other, with their differences to the first."""
    table = found._table()
    columns = chosen(table, *_CHECKED)
    periods, bounds = table["return_period_capacity"], table["return_period_bound"]
    if np.isfinite(np.asarray(periods, float)).any():
        columns["return_period"] = [
            (f"{bound} " if bound else "", number(years)) for bound, years in zip(bounds, periods, strict=True)
        ]
    columns |= chosen(table, *_CHANGED)
    if "return_period" in columns:
        columns["return_period_change"] = table["return_period_change"]
    return shown(columns)


def _indices(found: DesignComparison) -> Any:
    """Draw the safety indices of the designs."""
    ax = style.new_axes(1, (7.0, 0.9 + 0.6 * len(found.names)))
    words = {key: check_name(*key) for key in (("linear", "SLV"), ("nonlinear", "SLV"), ("nonlinear", "SLC"))}
    draw_safety(ax, found.names, found.checks, words, decimal, (style.GREY, style.RED, style.BLACK))
    style.legend(ax, Options({}))
    return ax


def numbers(people: Typology) -> dict[str, Any]:
    """Parameters and intervals of each design in each damage state, and its fractions at the levels."""
    limit = float(people.edp_thresholds[-1])
    states = {state_name(float(edp), limit): people.at(float(edp)) for edp in people.edp_thresholds[::-1]}
    return {
        "curves": [(state, _curves_table(one)) for state, one in states.items()],
        "levels": [(state, table) for state, one in states.items() for table in _levels_tables(one)],
    }


def _curves_table(people: Typology) -> Table:
    """Parameters with their 95 % intervals."""
    curves = people.curves
    ends = [curve.parameter_interval() if curve.has_errors else None for curve in curves]

    def interval(name: str, place: int) -> list[float]:
        return [np.nan if one is None else one[name][place] for one in ends]

    columns = {
        "design": [wall.name for wall in people.walls],
        "theta": [curve.theta for curve in curves],
        "theta_low": interval("theta", 0),
        "theta_high": interval("theta", 1),
        "beta": [curve.beta for curve in curves],
        "beta_low": interval("beta", 0),
        "beta_high": interval("beta", 1),
        "errors": [_errors(curve) for curve in curves],
        "status": [curve.status for curve in curves],
    }
    return shown(columns, people.im)


def _errors(curve: Fragility) -> str:
    return errors_in_words(curve) if curve.has_fit else ""


def _levels_tables(people: Typology) -> list[Table]:
    """The fraction of the histories of each design that reach a state at each level."""
    fractions = people.collapses / people.histories
    tables = []
    for first in range(0, len(people.walls), _ACROSS):
        columns: dict[Piece, Sequence[Piece]] = {level_head(people.im): [number(x) for x in people.levels]}
        for place in range(first, min(first + _ACROSS, len(people.walls))):
            columns[people.walls[place].name] = [probability(p) for p in fractions[:, place]]
        tables.append(Table.of(columns))
    return tables
