"""Chapters of a report on designs of a wall: alternatives, each beside the first, and nothing over them."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from typing import Any

import numpy as np

from dondolo._base.wording import decimal, say
from dondolo.checks.plots import check_name, draw_safety
from dondolo.curves.fragility import Fragility
from dondolo.curves.wording import errors_in_words
from dondolo.figures import style
from dondolo.figures.options import Options
from dondolo.populations.typology import Typology
from dondolo.reporting.blocks import Block, Cards, Details, Picture
from dondolo.reporting.columns import chosen, shown
from dondolo.reporting.content import THETA, Piece, Table, level, level_head, pieces, state_name
from dondolo.reporting.numerals import number, probability
from dondolo.reporting.parts import captioned, paragraph
from dondolo.retrofit.designs import DesignComparison

# What sentences that are said elsewhere are marked by for the catalogues
_ = str
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


def summary(found: DesignComparison) -> list[Block]:
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
    return [Cards(tuple(cards))]


def designs(found: DesignComparison) -> list[Block]:
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
    confidence = decimal(f"{100.0 * found.confidence:.4g}")
    sentence = (
        _(
            "Left: curves of the designs, with their fractions of collapse, and the capacity of each by the nonlinear"
            " check of SLV, as peak acceleration. Right: median of each over that of the first, with {confidence} %"
            " intervals, beside the ratio of the static accelerations with the ties at yield."
        )
        if found.checks and found.im == "pga"
        else _(
            "Left: curves of the designs, with their fractions of collapse. Right: median of each over that of the"
            " first, with {confidence} % intervals, beside the ratio of the static accelerations with the ties at"
            " yield."
        )
    )
    caption = say(
        "Designs beside the first, '{first}': ratios of the medians with {confidence} % intervals, steel, gain for each"
        " kg/m of steel more, and static acceleration with the ties at yield.",
        first=found.names[0],
        confidence=confidence,
    )
    blocks: list[Block] = [
        paragraph(
            say(
                "The walls are designs of one wall under the same records. A record that is hard on the wall is hard on"
                " all its designs: the ratio of two medians is known better than either of them, and its interval comes"
                " from the records in pairs."
            )
        ),
        Picture(found.plot, say(sentence, confidence=confidence), alt),
        captioned(shown(chosen(found._table(), *_COMPARED), found.im), caption),
    ]
    if found.checks:
        of_checks = say(
            "Checks by NTC 2018 of the designs, and their differences to the first. A bound of a return period has no"
            " difference."
        )
        of_indices = say("Safety indices of the designs; from 1 on the check is satisfied.")
        alt = say("Safety indices of the designs, those of the table.")
        blocks += [captioned(_checks(found), of_checks), Picture(partial(_indices, found), of_indices, alt)]
    return blocks


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


def numbers(people: Typology) -> list[Block]:
    """Parameters and intervals of each design in each damage state, and its fractions at the levels."""
    limit = float(people.edp_thresholds[-1])
    states = {state_name(float(edp), limit): people.at(float(edp)) for edp in people.edp_thresholds[::-1]}
    blocks: list[Block] = [
        paragraph(
            say("Designs are alternatives, of which one will be built: each has its own curve, and nothing is averaged"
                " over them.")
        )
    ]  # fmt: skip
    for place, (state, one) in enumerate(states.items()):
        table = _curves_table(one)
        if not place:
            caption = say("{state}: parameters of each design with 95 % intervals.", state=state.capitalize())
            blocks.append(captioned(table, caption))
            continue
        caption = say("Damage state {state}: parameters of each design with 95 % intervals.", state=state)
        blocks.append(Details(say("Curves of the damage state {state}", state=state), (captioned(table, caption),)))
    for state, one in states.items():
        title = say("Fractions at the levels, {state}", state=state)
        caption = say("Fraction of the histories of each design, {state}.", state=state)
        blocks += [Details(title, (captioned(table, caption),)) for table in _levels_tables(one)]
    return blocks


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
