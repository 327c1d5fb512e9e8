"""Records in Fortran: uploaded once as a suite, and what is measured there."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Protocol

import numpy as np

from dondolo._base.arguments import FloatArray, as_number
from dondolo._fortran import _core
from dondolo._fortran.handles import Handle
from dondolo._fortran.library import as_text, check, constants
from dondolo.errors import InputError


class Motion(Protocol):
    """What is computed with of a record, whose class knows these functions."""

    @property
    def acceleration(self) -> FloatArray: ...

    @property
    def vertical(self) -> FloatArray | None: ...

    @property
    def dt(self) -> float: ...

    @property
    def duration(self) -> float: ...

    @property
    def name(self) -> str: ...

    @property
    def metadata(self) -> Mapping[str, str]: ...

    def __len__(self) -> int: ...


def upload(records: tuple[Motion, ...], threads: int = 1) -> Handle:
    """The records as a suite in Fortran, joined by threads. The same records in the same order are uploaded once.

    Each record keeps the suite that it was uploaded with last, and its place there: a suite lives as long as one of its
    records does, and has not come into another.
    """
    homes = [record.__dict__.get("_home", (None, 0, 0)) for record in records]
    suite: Handle | None = homes[0][0]
    if suite is not None and homes == [(suite, i, len(records)) for i in range(len(records))]:
        return suite
    verticals = [record.vertical for record in records if record.vertical is not None]
    handle, stat, message = _core.records.new_suite(
        "\n".join(record.name for record in records).encode(),
        np.array([len(record) for record in records], dtype=np.int32),
        np.array([record.dt for record in records]),
        np.concatenate([record.acceleration for record in records]),
        np.array([record.vertical is not None for record in records], dtype=np.int32),
        # f2py takes no empty arrays
        np.concatenate(verticals or [np.zeros(1)]),
        threads,
    )
    check(stat, message)
    suite = Handle(handle)
    for i, record in enumerate(records):
        object.__setattr__(record, "_home", (suite, i, len(records)))
    return suite


def place_of(record: Motion) -> tuple[int, int]:
    """Where Fortran has a record: the handle of a suite, and the number in it from 1."""
    if "_home" not in record.__dict__:
        upload((record,))
    suite, place, _ = record.__dict__["_home"]
    return suite.number, place + 1


def intensities(records: tuple[Motion, ...], im: str, gravity: float | None = None) -> FloatArray:
    """An intensity measure of several records, in the unit of its levels."""
    pull = constants().gravity if gravity is None else as_number("gravity", gravity)
    if not 0.0 < pull < np.inf:
        raise InputError(f"gravity = {pull:g}: must be positive")
    values, stat, message = _core.records.intensities(upload(records).number, as_text("im", im), len(records), pull, 0)
    check(stat, message)
    return np.asarray(values)


def spectral_displacements(record: Motion, periods: FloatArray, damping: float) -> FloatArray:
    """Largest displacements of oscillators relative to the ground [m]."""
    values, stat, message = _core.records.spectrum(*place_of(record), periods, damping)
    check(stat, message)
    return np.asarray(values)


def velocity(record: Motion) -> FloatArray:
    """Ground velocity at the samples, 0 at the first [m/s]; exact for accelerations linear in between."""
    values, stat, message = _core.records.ground_velocity(*place_of(record), len(record))
    check(stat, message)
    return np.asarray(values)


def significant_times(record: Motion, low: float, high: float) -> tuple[float, float]:
    """Times at which Arias' integral reaches two parts of its end value [s]; 0 and 1: where motion begins and ends."""
    (first, last), stat, message = _core.records.significant_times(*place_of(record), low, high)
    check(stat, message)
    if not last > 0.0:
        raise InputError(f"record '{record.name}': has no motion")
    return float(first), float(last)
