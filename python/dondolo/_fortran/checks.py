"""Checks by building codes, and elastic spectra."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from dondolo._base.arguments import FloatArray
from dondolo._fortran import _core
from dondolo._fortran.handles import Handle
from dondolo._fortran.library import check, flat_values, properties, receive, text_lines, unpack_warnings, warn
from dondolo._fortran.tables import FlatCurve, TableColumns, flat_curves, plain, unpack_table
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
    """Values of ``&check`` as Fortran takes them (`flat_values`)."""

    texts: bytes
    numbers: FloatArray
    given: NDArray[np.int32]


class CodeParameters(NamedTuple):
    """The elastic spectrum of a code.

    Attributes
    ----------
    pga : float
        a_g S [g].
    amplification : float
        F_0; 2.5 in Eurocode 8.
    corners : ndarray, shape (3,)
        T_B, T_C and T_D [s].
    """

    pga: float
    amplification: float
    corners: FloatArray


class HazardMesh(NamedTuple):
    """The place of a site in the grid of hazard (D.M. 14-1-2008, annex B, table 1), whose nodes are in ED50.

    Attributes
    ----------
    latitude, longitude : float
        The site in ED50 [deg].
    use_coefficient : float
        Coefficient C_U of the class of use.
    ids : ndarray of int, shape (4,)
        The nodes of the mesh: a node, and its neighbours in the east, the south-east and the south.
    latitudes, longitudes : ndarray, shape (4,)
        Of the nodes [deg].
    distances : ndarray, shape (4,)
        From the site [km].
    grid_years : ndarray, shape (9,)
        Return periods of the grid.
    values : ndarray, shape (4, 9, 3)
        a_g [g], F_0 and T_C* [s] of each node and return period.
    tabulated : ndarray, shape (9, 3)
        The same at the site, from the nodes.
    """

    latitude: float
    longitude: float
    use_coefficient: float
    ids: NDArray[np.int32]
    latitudes: FloatArray
    longitudes: FloatArray
    distances: FloatArray
    grid_years: FloatArray
    values: FloatArray
    tabulated: FloatArray


class SiteHazard(NamedTuple):
    """Hazard of a site by NTC 2018.

    Attributes
    ----------
    ag, f0, tc_star : tuple of float
        a_g [g], F_0 and T_C* [s] of SLD, SLV and SLC; of one element where all limit states have the same.
    reference_life : float
        V_R [years]; 0 if unknown.
    exceedance, return_periods : tuple of float
        P_VR, and T_R [years] of the limit states; empty if unknown.
    mesh : HazardMesh or None
        Where these come from; None where they are given.
    """

    ag: tuple[float, ...]
    f0: tuple[float, ...]
    tc_star: tuple[float, ...]
    reference_life: float
    exceedance: tuple[float, ...]
    return_periods: tuple[float, ...]
    mesh: HazardMesh | None


class Modes(NamedTuple):
    """Modes of a building at a floor: periods [s], damping ratios, and participation factors times shape."""

    period: FloatArray
    damping: FloatArray
    participation: FloatArray


NO_MODES = Modes(np.empty(0), np.empty(0), np.empty(0))


def site_input(values: Mapping[str, Any]) -> SiteInput:
    """Values of ``&check`` by their names; the code has one default."""
    return SiteInput(*flat_values(properties("check"), {"code": None, **values}))


def site_hazard(site: SiteInput) -> SiteHazard:
    """The hazard of a site, given or from its coordinates."""
    parcel = receive(_core.checks.site_hazard(*site))
    mesh = None
    if "ids" in parcel.names:
        values: dict[str, Any] = {name: np.copy(value)[()] for name, value in parcel.named(HazardMesh._fields).items()}
        shape = (-1, len(values["grid_years"]), 3)
        values |= {"values": values["values"].reshape(shape), "tabulated": values["tabulated"].reshape(shape)[0]}
        mesh = HazardMesh(**values)
    lists = {
        name: tuple(parcel[name].tolist()) for name in SiteHazard._fields if name not in ("reference_life", "mesh")
    }
    return SiteHazard(**lists, reference_life=parcel["reference_life"], mesh=mesh)


def ntc_parameters(site: SiteInput, state: str) -> CodeParameters:
    """The spectrum of the ground of NTC 2018 in a limit state."""
    parcel = receive(_core.checks.ntc_parameters(*site, STATES.index(state) + 1))
    return CodeParameters(**parcel.named(CodeParameters._fields))


def code_spectrum(parameters: CodeParameters, damping: float, modes: Modes, periods: FloatArray) -> FloatArray:
    """Ordinates [g] of the spectrum of a code at periods [s]; with modes, that of a floor."""
    # f2py takes no empty arrays
    flat = {f"mode_{name}": np.append(values, 0.0) for name, values in modes._asdict().items()}
    own = {**parameters._asdict(), "damping": damping, "periods": periods, "modes": len(modes.period)}
    return np.asarray(_core.checks.code_spectrum(**own, **flat))


def kinematic_sheet(wall: Handle, site: SiteInput) -> tuple[SheetRow, ...]:
    """The sheet of a kinematic check; warns of a wall that is most likely a slip."""
    parcel = receive(_core.checks.check_ntc(wall.number, *site))
    warn(unpack_warnings(parcel["warnings"]))
    return sheet_rows(plain(unpack_table(parcel, "table")))


def dynamic_sheet(wall: Handle, state: str, pga: float, records: int, edp: FloatArray) -> tuple[SheetRow, ...]:
    """The sheet of the criterion for time histories in a limit state."""
    parcel = receive(_core.checks.check_histories(wall.number, STATES.index(state) + 1, pga, records, edp))
    return sheet_rows(plain(unpack_table(parcel, "table")))


def sheet_rows(columns: Mapping[str, Any]) -> tuple[SheetRow, ...]:
    """The rows of a sheet out of the columns of ``_check.csv``."""
    rows = [columns[name].tolist() if name == "value" else columns[name] for name in SheetRow._fields]
    return tuple(map(SheetRow, *rows))


def check_columns(walls: Handle, site: SiteInput, im: str, curves: Sequence[FlatCurve]) -> TableColumns:
    """Columns of ``_checks.csv`` of walls without groups, with their curves of collapse."""
    sent = _core.checks.check_table(walls.number, *site, im.encode(), **flat_curves(curves))
    return unpack_table(receive(sent), "table")


def check_notes(rows: Sequence[SheetRow]) -> tuple[DondoloWarning, ...]:
    """What a reader of a sheet should know."""
    names = ("method", "limit_state", "quantity", "item", "unit")
    texts = {name: text_lines(getattr(row, name) for row in rows) for name in names}
    values = np.array([row.value for row in rows], float)
    return tuple(unpack_warnings(receive(_core.checks.check_notes(values=values, **texts)).lines))


def calculation_items(wall: Handle) -> tuple[CalculationItem, ...]:
    """The items of the kinematic check of a wall."""
    parcel = receive(_core.checks.calculation_items(wall.number))
    names, *numbers = CalculationItem._fields
    return tuple(map(CalculationItem, parcel[names], *(parcel[name].tolist() for name in numbers)))


def capacity_curve(wall: Handle, knowledge_factor: float, points: int) -> tuple[FloatArray, FloatArray]:
    """Displacements [m] from 0 to d_0*, and the spectral accelerations of capacity there [m/s2]."""
    displacements, accelerations, failure = _core.checks.capacity_curve(wall.number, knowledge_factor, points)
    check(failure)
    return np.asarray(displacements), np.asarray(accelerations)
