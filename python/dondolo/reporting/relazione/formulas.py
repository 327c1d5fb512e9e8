"""Formulas of the sheet of a check as a document sets them: in symbols, with the numbers put in, and the value.

The sheet has them as lines of text, ``alpha_0 g/(e* FC)`` and ``0.23 * 9.81/(0.94 * 1.35)``: products are blanks or
stars, and all that stands before a slash is its numerator. The n-th number of the second is that of the n-th symbol of
the first, and so has its unit.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from typing import Any

from dondolo._fortran.checks import SheetRow
from dondolo.checks.ntc import CodeCheck
from dondolo.reporting.blocks import Formula, Fraction, Root, symbol_of
from dondolo.reporting.content import Symbol
from dondolo.reporting.numerals import Numeral
from dondolo.reporting.relazione.document import Document
from dondolo.reporting.relazione.sums import sums_of
from dondolo.reporting.units import CENTIMETRES, UNITS, Unit, cell
from dondolo.walls.chains import ChainWall
from dondolo.walls.mechanisms import Corner, TabulatedWall, TwoBlockWall

# Figures of what is to be calculated again by hand
FIGURES = 6
# Units in which formulas hold as they do in those of the SI: forces in kN, masses in t
COHERENT = {"kg/m": Unit("t/m", 1e-3), "kg": Unit("t", 1e-3)}
_COHERENT = COHERENT | {"Pa": Unit("kN/m²", 1e-3), "N/m3": Unit("kN/m³", 1e-3)}
_COHERENT |= {name: UNITS[name] for name in ("N", "N/m", "N m", "N m/m", "N m2", "N m2/m")}
# Units of symbols that are no rows of a sheet: sums over the items, gravity, and a multiplier
_GIVEN = {
    "g": "m/s2", "sum stabilising": "N m/m", "sum overturning": "N m/m", "sum P": "N/m", "sum P z": "N m/m",
    "sum P z^2": "N m2/m", "alpha(d_C)": "",
    # Spectral accelerations of the modes of a building and of the ground
    "S_eZ,m": "g", "S_e(T)": "g",
    # Of the period of a free element
    "kappa": "", "lambda": "", "L": "m", "W": "N/m3",
    # Of a strip: thrusts and ties, and the upper block about the hinge between the two
    "H": "N/m", "V": "N/m",
    "sum H": "N/m", "sum T": "N/m", "M_P,2": "N m/m", "M_H,2": "N m/m", "M_T,2": "N m/m", "M_Q,2": "N m/m", "h_2": "m",
}  # fmt: skip
_SUMS = {"sum stabilising": symbol_of("M_stab"), "sum overturning": symbol_of("M_ov")}
_POWERS = {"^2": "²", "^3": "³", "^(3/4)": "³⁄⁴"}  # noqa: RUF001
# Displacements, which are small
_SMALL = ("displacement", "demand")
# Characters of symbols and numbers that fit beside each other on a page
_WIDEST = 56
# The same with what is left of them beyond a few characters, and the place in the code
_WIDEST_LINE = 62
_TOKEN = re.compile(
    r"(?P<opens>(?:sqrt|min|max|ln)?[(\[])|(?P<pi>pi\b)"
    r"|(?P<name>sum [A-Z] [a-z](?!\w)(?:\^2)?|sum \w+|[^\W\d_]+(?:_\w+(?:,\w+)*)?\*?(?:\([^()]*\))?)"
    r"|(?P<number>\d+(?:\.\d*)?(?:[eE][+-]?\d+)?)|(?P<power>\^(?:\d|\(3/4\)))|(?P<sign> [-+] |, )|(?P<blank> \* | )"
    r"|(?P<over>/)|(?P<minus>-)|(?P<closes>[)\]])"
)


def formulas_of(document: Document, row: SheetRow, check: CodeCheck, symbol: str = "") -> list[Formula]:
    """The formula of a row that has its numbers, in one line or in two.

    Parameters
    ----------
    document : Document
        For the language.
    row : SheetRow
        Its value is the last side.
    check : CodeCheck
        Its sheet has the units of the symbols, and all figures of their values.
    symbol : str
        Of the quantity; '' for that of the row.
    """
    units = {one.symbol: one.unit for one in check.rows} | _GIVEN
    if isinstance(check.wall, (ChainWall, Corner)):
        units = {name: unit.removesuffix("/m") for name, unit in units.items()}
    # Numbers in formulas have eight figures, of which six would be rounded twice.
    exact = {f"{value:.8g}": value for value in (*(one.value for one in check.rows), *sums_of(check.items).values())}
    leaves, values = _leaves(row.expression), _leaves(row.numbers)
    names = ["" if leaf[0].isdigit() else units.get(leaf) for leaf in leaves]
    known = [name for name in names if name is not None]
    # Without the unit of each number all stay in those of the SI.
    is_known = len(known) == len(values) == len(leaves)
    scales = [_coherent(name) for name in known] if is_known else [Unit("")] * len(values)
    numerals = iter(
        [cell(exact.get(value, float(value)), unit, FIGURES) for value, unit in zip(values, scales, strict=True)]
    )
    # Levers of the weights: heights of walls that turn about their base, displacements of strips, chains and tables
    lever = "d_x" if isinstance(check.wall, (TabulatedWall, TwoBlockWall, ChainWall)) else "z"
    symbols = _Reader(row.expression, " ", lambda name: _symbol(name, lever)).all()
    numbers = _Reader(row.numbers, " · ", lambda _text: next(numerals)).all()
    unit = _coherent(row.unit) if is_known else Unit(row.unit.replace("2", "²"))
    value: Any = cell(row.value, unit, FIGURES)
    if unit.name:
        value = (value, f" {document.unit(unit.name)}")
    head = symbol_of(symbol or row.symbol)
    # Tables have displacements in cm
    also = ((cell(row.value, CENTIMETRES, FIGURES), " cm"),) if row.quantity in _SMALL else ()
    width = _width((symbols, numbers, *also))
    line = width + max(0, _width(head) - 2) + len(row.formula)
    if width <= _WIDEST - 8 * len(also) and line <= _WIDEST_LINE:
        return [Formula((head, symbols, numbers, value, *also), row.formula)]
    return [Formula((head, symbols)), Formula((head, numbers, value, *also), row.formula)]


def _coherent(unit: str) -> Unit:
    return _COHERENT.get(unit) or Unit(UNITS[unit].name)


def _leaves(text: str) -> list[str]:
    """Symbols and numbers of a formula, in their order."""
    return [found[0] for found in _TOKEN.finditer(text) if found.lastgroup in ("name", "number")]


def _symbol(name: str, lever: str) -> Any:
    """A symbol, a sum of symbols, or a number."""
    if name[0].isdigit():
        return cell(float(name), UNITS[""])
    if name in _SUMS:
        return _SUMS[name]
    words = name.partition("^")[0].split(" ")
    if words[0] != "sum":
        return symbol_of(name)
    arms = (" ", symbol_of(lever if words[2] == "z" else words[2])) if len(words) > 2 else ()
    return ("Σ", symbol_of(words[1]), *arms, *("²" * name.count("^")))


class _Group(tuple[Any, ...]):
    """Parts in brackets, which those of a fraction need not have."""

    __slots__ = ()


class _Reader:
    """What makes parts of a formula of a line of text."""

    def __init__(self, text: str, product: str, leaf: Callable[[str], Any]) -> None:
        self._tokens = [(found.lastgroup, found[0]) for found in _TOKEN.finditer(text)]
        self._product, self._leaf, self._at = product, leaf, 0

    def all(self) -> tuple[Any, ...]:
        """All parts."""
        parts = [self._factors()]
        while self._next() == "sign":
            sign = self._take()
            parts += ["; " if sign == ", " else sign, self._factors()]
        return tuple(parts)

    def _next(self) -> str | None:
        return self._tokens[self._at][0] if self._at < len(self._tokens) else None

    def _take(self) -> str:
        self._at += 1
        return self._tokens[self._at - 1][1]

    def _factors(self) -> Any:
        """A product, of which all that stands before a slash is the top of a fraction."""
        parts: tuple[Any, ...] = (self._factor(),)
        while (kind := self._next()) in ("blank", "over"):
            self._take()
            if kind == "blank":
                parts = (*parts, self._product, self._factor())
            else:
                parts = (Fraction(_bare(parts), _bare((self._factor(),))),)
        return parts[0] if len(parts) == 1 else parts

    def _factor(self) -> Any:
        kind, text = self._next(), self._take()
        part: Any
        if kind == "minus":
            inner = self._factor()
            return (text.replace("-", "\N{MINUS SIGN}"), inner)
        if kind == "opens":
            inside = self.all()
            closes = self._take()
            name, opens = text[:-1], text[-1]
            if name:
                part = Root(inside) if name == "sqrt" else (f"{name}(", inside, ")")
            else:
                part = _Group((opens, inside, closes))
        else:
            part = "π" if kind == "pi" else self._leaf(text)
        return (part, _POWERS[self._take()]) if self._next() == "power" else part


def _bare(parts: tuple[Any, ...]) -> Any:
    """Parts without the brackets round all of them."""
    return parts[0][1] if len(parts) == 1 and isinstance(parts[0], _Group) else parts


def _width(part: Any) -> int:
    """Characters of a part beside each other."""
    if isinstance(part, Fraction):
        return max(_width(part.top), _width(part.bottom))
    if isinstance(part, Root):
        return 1 + _width(part.inside)
    if isinstance(part, Symbol):
        return len(part.letter + part.index)
    if isinstance(part, Numeral):
        return len(part.text + part.power)
    return len(part) if isinstance(part, str) else sum(map(_width, part))
