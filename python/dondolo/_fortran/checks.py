"""Checks by building codes, and elastic spectra."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from dondolo._base.arguments import FloatArray
from dondolo._fortran import _core
from dondolo._fortran.handles import Handle
from dondolo._fortran.library import Parcel, check, receive, unpack_warnings, warn
from dondolo.errors import DondoloWarning

#: Limit states: damage, life safety, collapse
STATES = ("SLD", "SLV", "SLC")


class SheetRow(NamedTuple):
    """A line of the sheet of a check.

    Attributes
    ----------
    method : str
        'site', 'mechanism', 'tie', 'linear', 'nonlinear' or 'dynamic'.
    limit_state : str
        'SLD', 'SLV' or 'SLC'; '' for all.
    quantity : str
        What the number is.
    symbol : str
        In the code; '' where it has none.
    value : float
        In its unit.
    unit : str
        '' for a number.
    formula : str
        Where the code has the formula.
    meaning : str
        The quantity in words.
    item : str
        What of the wall it is of, such as 'tie 1'; '' for the wall.
    expression : str
        The formula in symbols; '' where the number is given or has none.
    numbers : str
        The same with numbers in place of the symbols, of eight digits.
    bound : str
        '<' or '>' where the value is only a bound, '' where it is not.
    """

    method: str
    limit_state: str
    quantity: str
    symbol: str
    value: float
    unit: str
    formula: str
    meaning: str
    item: str = ""
    expression: str = ""
    numbers: str = ""
    bound: str = ""


class CalculationItem(NamedTuple):
    """A term of the sums behind a kinematic check, per metre of wall; NaN where an item has no such number.

    Attributes
    ----------
    item : str
        'section 1', 'masonry', 'load 1', 'mass 1', 'thrust 1', 'tie 1', 'friction 1'; of a strip 'lower block',
        'upper block', 'load on top'.
    force : float
        Weight, force outwards, or largest force of a tie [N/m].
    depth : float
        Behind the outer face [m].
    arm : float
        Rise for a unit of rotation [m].
    lever : float
        Horizontal travel for a unit of rotation [m].
    stabilising : float
        Its moment against the mechanism [N m/m].
    overturning : float
        Its moment that helps the mechanism [N m/m].
    force_lever : float
        Weight times lever [N m/m]; 'masonry' has none, since the sections have it.
    force_lever2 : float
        Weight times lever squared [N m2/m]; the sections have none, since the masonry moves as one body.
    """

    item: str
    force: float
    depth: float
    arm: float
    lever: float
    stabilising: float
    overturning: float
    force_lever: float
    force_lever2: float


class SiteInput(NamedTuple):
    """What a user says of a check, as Fortran takes it."""

    texts: bytes
    numbers: FloatArray
    given: tuple[int, int, int, int]


def ntc_parameters(site: SiteInput, state: str) -> FloatArray:
    """a_g S [g], F_0, T_B, T_C and T_D [s] of the spectrum of NTC 2018 in a limit state."""
    parameters, failure = _core.checks.ntc_parameters(*site, STATES.index(state) + 1)
    check(failure)
    return np.asarray(parameters)


def code_spectrum(
    parameters: Sequence[float] | FloatArray, damping: float, modes: FloatArray, periods: FloatArray
) -> FloatArray:
    """Ordinates [g] of the spectrum of a code at periods [s]; with modes, of shape (modes, 3), that of a floor."""
    return np.asarray(_core.checks.code_spectrum(parameters, damping, modes.ravel(), periods))


def kinematic_sheet(wall: Handle, site: SiteInput) -> tuple[SheetRow, ...]:
    """The sheet of a kinematic check; warns of a wall that is most likely a slip."""
    parcel = receive(_core.checks.check_ntc(wall.number, *site))
    warn(unpack_warnings(parcel.lines[len(parcel.reals) :]))
    return _rows(parcel)


def dynamic_sheet(wall: Handle, state: str, pga: float, records: int, edp: FloatArray) -> tuple[SheetRow, ...]:
    """The sheet of the criterion for time histories in a limit state."""
    return _rows(receive(_core.checks.check_histories(wall.number, STATES.index(state) + 1, pga, records, edp)))


def check_notes(rows: Sequence[SheetRow]) -> tuple[DondoloWarning, ...]:
    """What a reader of a sheet should know."""
    lines = "\n".join(f"{row.method}\t{row.limit_state}\t{row.quantity}\t{row.item}" for row in rows)
    values = np.array([row.value for row in rows], float)
    return tuple(unpack_warnings(receive(_core.checks.check_notes(lines.encode(), values)).lines))


def calculation_items(wall: Handle) -> tuple[CalculationItem, ...]:
    """The items of the kinematic check of a wall."""
    parcel = receive(_core.checks.calculation_items(wall.number))
    numbers = np.reshape(parcel.reals, (len(parcel.lines), -1)).tolist()
    return tuple(CalculationItem(name, *row) for name, row in zip(parcel.lines, numbers, strict=True))


def capacity_curve(wall: Handle, knowledge_factor: float, points: int) -> tuple[FloatArray, FloatArray]:
    """Displacements [m] from 0 to d_0*, and the spectral accelerations of capacity there [m/s2]."""
    displacements, accelerations, failure = _core.checks.capacity_curve(wall.number, knowledge_factor, points)
    check(failure)
    return np.asarray(displacements), np.asarray(accelerations)


def _rows(parcel: Parcel) -> tuple[SheetRow, ...]:
    """Lines of a sheet."""
    rows = []
    for line, value in zip(parcel.lines[: len(parcel.reals)], parcel.reals.tolist(), strict=True):
        method, state, quantity, symbol, unit, *words = line.split("\t")
        rows.append(SheetRow(method, state, quantity, symbol, value, unit, *words))
    return tuple(rows)
