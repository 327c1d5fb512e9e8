"""Steps of the check of a wall that is a table or a chain: its columns, and what follows from them at d_0* and at d_C.

The curves through the columns are made here again, by NumPy. Steps are shown only if they give the numbers of the
check.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.polynomial import Chebyshev

from dondolo._base.arguments import FloatArray
from dondolo.reporting.blocks import Block, CaptionedTable, Formula, Fraction, symbol_of
from dondolo.reporting.content import Piece, Symbol, Table
from dondolo.reporting.numerals import Numeral
from dondolo.reporting.relazione.chains import TieOfChain, terms_of_chain, ties_over
from dondolo.reporting.relazione.document import Document, _
from dondolo.reporting.relazione.formulas import FIGURES
from dondolo.reporting.relazione.subjects import Subject
from dondolo.reporting.units import UNITS, Unit, cell
from dondolo.walls.chains import ChainWall
from dondolo.walls.mechanisms import TabulatedWall

# Rows of the table that are printed, and how well the steps give the numbers of the check
_MOST, _SAME = 41, 1e-6
# Highest degree of a polynomial, and how near to the smallest the residual variance of a lower one is
_DEGREE, _NEAR = 32, 2.0
# Halvings that find a rotation
_ENOUGH = 200


class Terms:
    """Columns of a wall over the rotation θ, by its table or chain: moment M, lever S = ΣP x', displacement d."""

    def __init__(self, one: Subject) -> None:
        wall = one.wall
        self.columns: dict[str, FloatArray]
        self.ties: list[TieOfChain] = []
        if isinstance(wall, TabulatedWall):
            self.rotation = np.asarray(wall.rotation, float)
            lever = wall.weighted_lever
            self.columns = {
                "M": np.asarray(wall.moment, float),
                "S": np.asarray(wall.lever, float) * wall.gravity if lever is None else np.asarray(lever, float),
                "d": np.asarray(wall.travel, float),
            }
        else:
            self.rotation, self.columns = terms_of_chain(one)
            self.ties = ties_over(one, self.rotation)
        self._curves = {name: _curve(self.rotation, values) for name, values in self.columns.items()}
        self.capacity = wall.capacity_angle

    def at(self, name: str, rotation: float) -> float:
        """A term at a rotation, without ties."""
        return float(self._curves[name](rotation))

    def moment_at(self, rotation: float) -> float:
        """The moment with what ties add to it that have not broken."""
        return self.at("M", rotation) + sum(tie.moment(rotation) for tie in self.ties)

    def rotation_of(self, d: float) -> float:
        """The rotation at which the displacement is d."""
        low, high = 0.0, self.capacity
        for _halving in range(_ENOUGH):
            middle = 0.5 * (low + high)
            low, high = (middle, high) if self.at("d", middle) < d else (low, middle)
        return 0.5 * (low + high)


def _curve(rotation: FloatArray, values: FloatArray) -> Chebyshev:
    """The polynomial of the least degree that is about as near to the values as any."""
    found = []
    for degree in range(min(_DEGREE, len(rotation) - 2) + 1):
        curve = Chebyshev.fit(rotation, values, degree, domain=[0.0, rotation[-1]])
        left = float(np.sum((curve(rotation) - values) ** 2)) / (len(rotation) - degree - 1)
        found.append((max(left, (4.0 * np.finfo(float).eps * float(np.max(np.abs(values)))) ** 2), curve))
    least = min(left for left, _fit in found)
    return next(curve for left, curve in found if left <= _NEAR * least)


class _Place(NamedTuple):
    """A displacement of the check: its name, rotation, moment, lever, displacement and multiplier."""

    name: Piece
    rotation: float
    moment: float
    lever: float
    d: float
    multiplier: float


def _places(one: Subject, terms: Terms) -> list[_Place]:
    """d_0* and, if anything is verified, d_C of SLV and SLC; none if the table does not give their numbers."""
    check = one.check
    factor, ratio = (check.value("mechanism", "SLV", name) for name in ("knowledge_factor", "mass_ratio"))
    near = _SAME * check.value("mechanism", "SLV", "alpha_0")
    names: list[tuple[Piece, float, float]] = [(symbol_of("d_0*"), check.value("mechanism", "SLV", "d_0"), 0.0)]
    for state in ("SLV", "SLC") if one.has_ratios else ():
        d, a = (check.value("nonlinear", state, name) for name in ("displacement", "acceleration"))
        names.append(((symbol_of("d_C"), f", {state}"), d, a * ratio * factor / one.wall.gravity))
    found = []
    for name, d, expected in names:
        rotation = terms.rotation_of(d)
        # At the end of the capacity only weights count.
        moment = terms.moment_at(rotation) if expected > 0.0 else terms.at("M", rotation)
        lever = terms.at("S", rotation)
        multiplier = moment / lever
        if not math.isclose(multiplier, expected, rel_tol=_SAME, abs_tol=near):
            return []
        found.append(_Place(name, rotation, moment, lever, d, 0.0 if expected == 0.0 else multiplier))
    return found


def table_of(document: Document, one: Subject) -> list[Block]:
    """The columns of the table, of many rows some."""
    assert isinstance(one.wall, TabulatedWall)
    terms = Terms(one)
    count = len(terms.rotation)
    rows = sorted({*np.linspace(0, count - 1, min(count, _MOST)).round().astype(int).tolist()})
    theta, moment = Symbol("θ"), UNITS["N m/m"]
    columns: dict[Piece, Any] = {
        (theta, " [rad]"): _column(terms.rotation[rows]),
        (symbol_of("M"), " [kNm/m]"): _column(terms.columns["M"][rows], moment),
        (symbol_of("S"), " [kNm/m]"): _column(terms.columns["S"][rows], moment),
        (symbol_of("d"), " [m]"): _column(terms.columns["d"][rows]),
    }
    words = _(
        "The wall is a table that the designer gives: over the rotation {theta} the moment {moment} of all that holds"
        " and pushes it, the lever {lever} = {sum}, by which the weights move outwards for a unit of rotation, and the"
        " displacement {d} of the equivalent oscillator (C8.7.1.4); of each body and load its weight {weight} and its"
        " displacement {first} for a unit of rotation at rest. Between the rows a polynomial is taken."
    )
    symbols: dict[str, Any] = {
        "theta": theta, "moment": symbol_of("M"), "lever": symbol_of("S"), "d": symbol_of("d"),
        "sum": ("Σ", symbol_of("P"), " ", symbol_of("d_x"), "(", theta, ")"), "weight": symbol_of("P"),
        "first": symbol_of("d_x"),
    }  # fmt: skip
    caption = document.text(_("The table of the wall, per metre of wall."))
    if len(rows) < count:
        caption = document.text(
            _("The table of the wall, per metre of wall: {shown} of its {count} rows."), shown=len(rows), count=count
        )
    return [document.say(words, **symbols), CaptionedTable(Table.of(columns), caption)]


def _column(values: Sequence[float] | FloatArray, unit: Unit = UNITS[""]) -> list[Numeral]:
    return [cell(float(value), unit, FIGURES) for value in values]


def table_steps(document: Document, one: Subject) -> list[Block]:
    """The terms of the table at d_0* and at d_C, and the capacity that follows, a column each."""
    places = _places(one, Terms(one))
    is_chain = isinstance(one.wall, ChainWall)
    if not places and is_chain:
        words = _(
            "Positions of the bodies do not give {d0} and {a} here as the calculation has them: they are those of the"
            " code."
        )
        return [document.say(words, d0=symbol_of("d_0*"), a=symbol_of("a(d_C)"))]
    if not places:
        words = _(
            "Polynomials through the rows that are given here differ from those of the calculation: {d0} and {a} are"
            " those of the code."
        )
        return [document.say(words, d0=symbol_of("d_0*"), a=symbol_of("a(d_C)"))]
    moment = one.unit("N m/m")
    scale = one.wall.gravity / (
        one.check.value("mechanism", "SLV", "mass_ratio") * one.check.value("mechanism", "SLV", "knowledge_factor")
    )
    theta = Symbol("θ")
    # Where the moment vanishes, its rounding does not count
    rows: list[tuple[Piece, list[Numeral]]] = [
        ((symbol_of("d"), " [m]"), _column([place.d for place in places])),
        ((theta, " [rad]"), _column([place.rotation for place in places])),
        ((symbol_of("M"), f" [{moment.name}]"), _column([place.multiplier * place.lever for place in places], moment)),
        ((symbol_of("S"), f" [{moment.name}]"), _column([place.lever for place in places], moment)),
        (symbol_of("alpha"), _column([place.multiplier for place in places])),
        ((symbol_of("a"), " [m/s²]"), _column([place.multiplier * scale for place in places])),
    ]
    columns: dict[Piece, Any] = {document.text(_("quantity")): [head for head, _values in rows]}
    for at, place in enumerate(places):
        columns[place.name] = [values[at] for _head, values in rows]
    words = (
        _(
            "At {d0} the moment {moment} of all that holds and pushes the chain vanishes. The positions of the bodies"
            " at a displacement {d} = Σ {weight} {first} Δx/Σ {weight} {first} follow from the joints, with the"
            " rotation {theta} of the body that drives; {lever} = Σ {weight} x' is how fast the weights move"
            " outwards there:"
        )
        if is_chain
        else _(
            "At {d0} the moment {moment} vanishes. At a displacement {d} the column {d} of the table gives the rotation"
            " {theta}, and the others what holds the wall there:"
        )
    )
    names = {"d0": symbol_of("d_0*"), "moment": symbol_of("M"), "d": symbol_of("d"), "theta": theta}
    if is_chain:
        names |= {"lever": symbol_of("S"), "weight": symbol_of("P"), "first": symbol_of("d_x")}
    caption = document.text(
        _("Terms of the chain, multiplier and capacity a = α g/(e* FC).")  # noqa: RUF001
        if is_chain
        else _("Terms of the table, multiplier and capacity a = α g/(e* FC).")  # noqa: RUF001
    )
    return [
        document.say(words, **names),
        Formula((symbol_of("alpha"), Fraction(symbol_of("M"), symbol_of("S")))),
        CaptionedTable(Table.of(columns), caption),
    ]
