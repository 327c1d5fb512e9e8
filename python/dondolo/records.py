"""Accelerograms."""

from __future__ import annotations

import os
from collections.abc import Iterable
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike

from dondolo import _binding, _core, tables
from dondolo.errors import InputError


@dataclass(frozen=True, eq=False, repr=False, init=False)
class Record:
    """An accelerogram: ground acceleration at equal steps of time, linear in between.

    Parameters
    ----------
    acceleration : array_like, shape (samples,)
        Ground acceleration at 0, dt, 2 dt, ... [m/s2]; at least two samples.
    dt : float
        Time step [s].
    name : str, optional
        Name in tables and figures.

    Attributes
    ----------
    acceleration : ndarray of float64, read-only
        A copy of what was given.
    pga : float
        Peak ground acceleration [m/s2].

    Raises
    ------
    InputError
        A step that is not positive, a sample that is no acceleration, too few samples.
    """

    acceleration: _binding.FloatArray
    dt: float
    name: str = "record"
    pga: float = field(init=False)

    def __init__(self, acceleration: ArrayLike, dt: float, name: str = "record") -> None:
        values = _binding.as_array("acceleration", acceleration).copy()
        step = _binding.as_number("dt", dt)
        _binding.as_text("name", name)
        pga, stat, message = _core.check_record(values, step)
        _binding.check(stat, message)
        values.flags.writeable = False
        for what, value in (("acceleration", values), ("dt", step), ("name", name), ("pga", pga)):
            object.__setattr__(self, what, value)

    @property
    def duration(self) -> float:
        """Time of the last sample [s]."""
        return (len(self.acceleration) - 1) * self.dt

    @property
    def time(self) -> _binding.FloatArray:
        """Times of the samples [s]."""
        return self.dt * np.arange(len(self.acceleration))

    def intensity(self, im: str, gravity: float | None = None) -> float:
        """An intensity measure of the record as it stands.

        Parameters
        ----------
        im : str
            'pga', 'sa(T)' or 'saavg(T1:T2)' [g], 'pgv', 'arias' or 'cav' [m/s], 'pgd' or 'hi' [m], 'd5-75' or
            'd5-95' [s]; T, T1 and T2 are periods [s], as in 'sa(0.5)'.
        gravity : float, optional
            What g is [m/s2]; 9.81 if left out.

        Returns
        -------
        float
            In the unit of its levels: accelerations in g, all else in SI units.
        """
        return float(intensities([self], im, gravity)[0])

    def __len__(self) -> int:
        return len(self.acceleration)

    def _facts(self) -> list[tuple[str, str]]:
        return [
            ("samples", str(len(self))),
            ("dt", f"{self.dt:.6g} s"),
            ("duration", f"{self.duration:.6g} s"),
            ("PGA", f"{self.pga:.6g} m/s2"),
        ]

    def __repr__(self) -> str:
        return f"<Record {self.name!r}: " + ", ".join(f"{what} {text}" for what, text in self._facts()) + ">"

    def _repr_html_(self) -> str:
        return tables.html_of(f"Record '{self.name}'", self._facts())

    def __setstate__(self, state: dict[str, object]) -> None:
        self.__dict__.update(state)
        self.acceleration.flags.writeable = False


def read_record(
    path: str | os.PathLike[str], dt: float | None = None, units: str | None = None, channel: int = 1
) -> Record:
    """Read an accelerogram file; the format is recognised by its content.

    Parameters
    ----------
    path : path
        The file; its stem names the record.
    dt : float, optional
        Time step [s], needed where the file does not state it.
    units : str, optional
        Units of the values such as 'm/s2', 'gal' or 'g', needed where the file does not state them.
    channel : int
        Which of the file's channels, from 1.

    Returns
    -------
    Record

    Raises
    ------
    InputError
        The file is missing, unknown, wrong, or says less than is needed; it has no such channel.
    """
    channels = read_records(path, dt, units)
    if channel not in range(1, len(channels) + 1):
        raise InputError(f"{os.fspath(path)}: channel = {channel!r}: must lie between 1 and {len(channels)}")
    return channels[channel - 1]


def read_records(path: str | os.PathLike[str], dt: float | None = None, units: str | None = None) -> list[Record]:
    """Read all channels of an accelerogram file.

    Parameters
    ----------
    path, dt, units
        As those of `read_record`.

    Returns
    -------
    list of Record
        One for each channel; the formats known so far have one.

    Raises
    ------
    InputError
        The file is missing, unknown, wrong, or says less than is needed.
    """
    return [Record(data.acceleration, data.dt, data.name) for data in _binding.read_records(path, False, dt, units)]


def read_catalogue(path: str | os.PathLike[str]) -> list[Record]:
    """Read all records of a catalogue.

    Parameters
    ----------
    path : path
        A CSV table with the columns file, dt_s and units; files are relative to its folder.

    Returns
    -------
    list of Record

    Raises
    ------
    InputError
        The catalogue or one of its records is wrong.
    """
    return [Record(data.acceleration, data.dt, data.name) for data in _binding.read_records(path, True)]


def as_records(records: Record | Iterable[Record]) -> tuple[Record, ...]:
    """One record or several as a tuple of them."""
    if isinstance(records, Record):
        records = (records,)
    if not isinstance(records, Iterable):
        raise InputError(f"records: {type(records).__name__} is no record")
    several = tuple(records)
    if not several:
        raise InputError("records: must be given")
    for record in several:
        if not isinstance(record, Record):
            raise InputError(f"records: {type(record).__name__} is no record")
    return several


def intensities(records: Iterable[Record], im: str, gravity: float | None = None) -> _binding.FloatArray:
    """An intensity measure of several records, in the unit of its levels."""
    pull = _binding.constants().gravity if gravity is None else _binding.as_number("gravity", gravity)
    if not 0.0 < pull < np.inf:
        raise InputError(f"gravity = {pull:g}: must be positive")
    return _binding.intensities(im, flatten(as_records(records)), pull)


def flatten(records: tuple[Record, ...]) -> _binding.FlatRecords:
    """All records as Fortran takes them; copied once for a whole analysis."""
    return _binding.FlatRecords(
        "\n".join(record.name for record in records).encode(),
        np.array([len(record) for record in records], dtype=np.int32),
        np.array([record.dt for record in records]),
        np.concatenate([record.acceleration for record in records]),
    )
