"""Chapter 17 of a calculation report: comparisons of the results with simple calculations."""

from __future__ import annotations

import math
from collections.abc import Sequence
from fractions import Fraction as Exact
from typing import Any

from dondolo.reporting.blocks import Block, Heading, symbol_of
from dondolo.reporting.content import Piece
from dondolo.reporting.numerals import number
from dondolo.reporting.relazione.capacity import shown
from dondolo.reporting.relazione.document import Document, _
from dondolo.reporting.relazione.subjects import Subject
from dondolo.reporting.relazione.sums import Turning, sums_of, turning_of
from dondolo.walls.chains import ChainWall
from dondolo.walls.mechanisms import TabulatedWall, TwoBlockWall

# T_SLV of a curve of capacity that is a straight line: 1.68 pi sqrt(0.4/0.6)
_STRAIGHT = 1.68 * math.pi * math.sqrt(0.4 / 0.6)


def comparisons(document: Document) -> list[Block]:
    """Chapter 17."""
    rows: list[tuple[Piece, Sequence[Piece]]] = []
    several = document.subjects.several

    def compare(head: Piece, values: Sequence[float], figures: int = 6) -> None:
        rows.append((head, [number(value, figures) for value in values]))

    exact = [_exact_multiplier(one) for one in several]
    compare((symbol_of("alpha_0"), document.text(_(" of the check"))), [_of(one, "alpha_0") for one in several])
    compare((symbol_of("alpha_0"), document.text(_(" from the items, in fractions"))), exact)
    balance = [_balance(one) for one in several]
    compare(document.text(_("sum of moments at activation / stabilising moment")), balance, 1)
    compare((symbol_of("d_0*"), document.text(_(" of the check [cm]"))), [100.0 * _of(one, "d_0") for one in several])
    compare(
        (symbol_of("d_0*"), document.text(_(" of the weights alone, same control point [cm]"))),
        [100.0 * _bare_displacement(one) for one in several],
    )
    periods = [one.check._outcome(("nonlinear", "SLV"), "period") for one in several]
    compare((symbol_of("T_SLV"), document.text(_(" of the check [s]"))), periods)
    straight = [_STRAIGHT * math.sqrt(_of(one, "d_0") / _of(one, "a_0")) for one in several]
    compare((symbol_of("T_SLV"), document.text(_(" of a straight capacity curve [s]"))), straight)
    return [
        Heading(document.text(_("Reasoned judgement of acceptability of the results"))),
        document.beside(
            document.text(_("comparison")), rows, document.text(_("Comparisons with simple calculations (NTC 10.2.1)."))
        ),
        document.say(
            _(
                "Fractions use the items of the table of the calculation alone. A straight line from {a0} to"
                " {d0} has the period"
                " {period}; ties and thrusts make the capacity curve another one."
            ),
            a0=symbol_of("a_0*"),
            d0=symbol_of("d_0*"),
            period=(
                document.language.decimal("1.68 π √(0.4/0.6) √("),
                symbol_of("d_0*"),
                "/",
                symbol_of("a_0*"),
                ")",
            ),
        ),
        *_bare_steps(document),
        *document.written("judgement", _("reasoned judgement of the designer on the results")),
    ]


def _of(one: Subject, name: str) -> float:
    return one.check.value("mechanism", "SLV", name)


def _exact_multiplier(one: Subject) -> float:
    """alpha_0 from the items, in exact arithmetic."""
    top = bottom = Exact(0)
    for item in one.check.items:
        for name, sign in (("stabilising", 1), ("overturning", -1)):
            if not math.isnan(value := getattr(item, name)):
                top += sign * Exact(value)
        if not math.isnan(item.force_lever):
            bottom += Exact(item.force_lever)
    return float(top / bottom)


def _balance(one: Subject) -> float:
    """Moments about the hinge that are left at activation, by the sheet, over those that hold."""
    sums = sums_of(one.check.items)
    left = sums["stabilising"] - sums["overturning"] - _of(one, "alpha_0") * sums["force_lever"]
    return abs(left) / sums["stabilising"]


def _bare_displacement(one: Subject) -> float:
    """Displacement d_0* if the weights alone held the wall, without thrusts: at the control point of the check.

    NaN of a table, whose moment is all that holds it and pushes it, and of a chain, whose weights move apart.
    """
    if isinstance(one.wall, (TabulatedWall, ChainWall)):
        return math.nan
    if isinstance(one.wall, TwoBlockWall):
        return one.check.items[0].arm
    sums = turning_of(one.check.items)
    return _bare_sine(sums) * sums.second / sums.first


def _bare_sine(sums: Turning) -> float:
    """Sine of the rotation at which the moment of the weights alone vanishes."""
    return sums.weights / math.hypot(sums.weights, sums.first - sums.pushed)


def _bare_steps(document: Document) -> list[Block]:
    """The formula of that displacement with its numbers, of walls that turn about their base."""
    found: dict[float, Any] = {}
    for one in document.subjects.several:
        if not one.is_turning:
            continue
        moment, second = one.unit("N m/m"), one.unit("N m2/m")
        sums = turning_of(one.check.items)
        sine, lowered = _bare_sine(sums), shown(sums.first - sums.pushed, moment)
        numbers = (
            "sin arctan(", shown(sums.weights, moment), "/", lowered, ") · ", shown(sums.second, second), "/",
            shown(sums.first, moment), " = ", shown(sine * sums.second / sums.first), " m",
        )  # fmt: skip
        found.setdefault(sine, numbers)
    if not found:
        return []
    words = _("{d0} of the weights alone: {numbers}.")
    return [
        document.say(
            words,
            d0=symbol_of("d_0*"),
            numbers=tuple(piece for numbers in found.values() for piece in ("; ", *numbers))[1:],
        )
    ]
