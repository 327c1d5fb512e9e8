"""Buildings, and the motions of their floors."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from dondolo._base.arguments import FloatArray, as_array, as_number, refuse_units
from dondolo._fortran import _core
from dondolo._fortran.handles import Handle
from dondolo._fortran.library import flat_values, properties, receive, unpack_warnings
from dondolo.errors import DondoloWarning


class BuildingData(NamedTuple):
    """A building as Fortran has understood it.

    Values of its modes at the base and the top of a wall, of its diaphragm (zeros without one), and how long its floor
    vibrates after a record [s].
    """

    period: tuple[float, ...]
    damping: tuple[float, ...]
    participation: tuple[float, ...]
    participation_top: tuple[float, ...]
    diaphragm: tuple[float, float]
    free_vibration: float


def building_values(values: Mapping[str, Any]) -> dict[str, Any]:
    """Properties of a building: lists as tuples, whole numbers as such."""
    found: dict[str, Any] = {}
    for row in BUILDING_PROPERTIES:
        value = values.get(row.name)
        if value is None:
            found[row.name] = None
        elif row.kind == "list":
            refuse_units(row.name, value)
            found[row.name] = tuple(as_array(row.name, np.atleast_1d(value)).tolist()) or None
        else:
            number = as_number(row.name, value)
            found[row.name] = int(number) if row.kind == "integer" and number.is_integer() else number
    return found


def describe_building(values: Mapping[str, Any]) -> BuildingData:
    """Let Fortran check a building and work out its modes."""
    parcel = receive(_core.buildings.describe_building(*_flat(values)))
    modes = {name: tuple(parcel[name].tolist()) for name in ("period", "damping", "participation", "participation_top")}
    diaphragm = parcel["diaphragm_damping"], parcel["diaphragm_participation"]
    return BuildingData(**modes, diaphragm=diaphragm, free_vibration=parcel["free_vibration"])


# Horizontal and vertical motion [m/s2], and into how many parts the steps of a record are divided
Motion = tuple[FloatArray, FloatArray | None, int]


def floor_motion(acceleration: FloatArray, vertical: FloatArray | None, dt: float, values: Mapping[str, Any]) -> Motion:
    """Motion of a floor, horizontal and vertical [m/s2], and into how many parts the steps of a record are divided."""
    return _motion(
        _core.buildings.floor_motion(acceleration, _or_one(vertical), dt, *_flat(values)), vertical is not None
    )


def felt_motion(acceleration: FloatArray, vertical: FloatArray | None, dt: float, wall: Handle, what: str) -> Motion:
    """The motion that a wall on a building feels, or that of its base or its top, as of `floor_motion`."""
    sent = _core.buildings.felt_motion(acceleration, _or_one(vertical), dt, wall.number, what)
    return _motion(sent, vertical is not None)


def support_notes(walls: Handle) -> list[DondoloWarning]:
    """Notes on the supports that move walls: a code, how many of how many walls, and a sentence."""
    return unpack_warnings(receive(_core.buildings.support_notes(walls.number)).lines)


def drift_note(drifted: int, histories: int) -> str:
    """What there is to say of histories whose supports drift apart; empty where there are none."""
    (line,) = receive(_core.buildings.drift_note(drifted, histories)).lines
    return line


def _or_one(vertical: FloatArray | None) -> FloatArray:
    """A vertical component, or the one sample that stands for none: f2py takes no empty arrays."""
    return np.zeros(1) if vertical is None else vertical


def _motion(sent: Any, has_vertical: bool) -> Motion:
    """A motion out of its parcel."""
    parcel = receive(sent)
    return parcel["acceleration"], parcel["vertical"] if has_vertical else None, parcel["parts"]


def _flat(values: Mapping[str, Any]) -> tuple[FloatArray, NDArray[np.int32]]:
    _, numbers, given = flat_values(BUILDING_PROPERTIES, values)
    return numbers, given


BUILDING_PROPERTIES = properties("building")
BUILDING_NAMES = tuple(row.name for row in BUILDING_PROPERTIES)
