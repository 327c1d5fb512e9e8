"""Units that engineers use: the one place where quantities of results, in those of the SI, are converted."""

from __future__ import annotations

from typing import NamedTuple

from dondolo.reporting.numerals import Numeral, number


class Unit(NamedTuple):
    """A unit as it is shown, and its number in that of the results."""

    name: str
    factor: float = 1.0


# By the unit of the results
UNITS = {
    "": Unit(""),
    "g": Unit("g"),
    "s": Unit("s"),
    "m": Unit("m"),
    "m/s2": Unit("m/s²"),
    "kg/m": Unit("kg/m"),
    "kg": Unit("kg"),
    "kg/m3": Unit("kg/m³"),
    "m2/m": Unit("cm²/m", 1e4),
    "N/m": Unit("kN/m", 1e-3),
    "N": Unit("kN", 1e-3),
    "year": Unit("years"),
    "N m/m": Unit("kNm/m", 1e-3),
    "N m2/m": Unit("kNm²/m", 1e-3),
    "N m": Unit("kNm", 1e-3),
    "N m2": Unit("kNm²", 1e-3),
    "Pa": Unit("MPa", 1e-6),
}
# Small lengths: displacements, and sizes of sections
CENTIMETRES = Unit("cm", 1e2)


def quantity(value: float | None, unit: Unit, figures: int = 4) -> Numeral:
    """A number in a unit that engineers use, with the unit after it."""
    return number(None if value is None else unit.factor * value, figures, f" {unit.name}" if unit.name else "")


def cell(value: float | None, unit: Unit, figures: int = 4) -> Numeral:
    """The same number for a column that is headed by the unit."""
    return number(None if value is None else unit.factor * value, figures)
