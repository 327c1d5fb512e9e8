"""Accelerograms."""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from types import MappingProxyType

import numpy as np
from numpy.typing import ArrayLike

from dondolo._base.arguments import FloatArray, as_array, as_number, as_text
from dondolo._base.shown import html_of
from dondolo._fortran import _binding, _core
from dondolo._fortran.handles import Handle
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
    processing : iterable of str, optional
        What was done to the record since it was read, a sentence a step; functions that process records add theirs.
    metadata : mapping of str to str, optional
        What is known of the record.

    Attributes
    ----------
    acceleration : ndarray of float64, read-only
        A copy of what was given.
    processing : tuple of str
        Steps of processing, the first first; () for a record as it was read.
    metadata : mapping of str to str, read-only
        What the header of its file says, in its order. Keys that mean the same in every format are event, date,
        station, network, component, magnitude, latitude, longitude (of the station), processing, format,
        quantity and units; all others are as the file names them.
    pga : float
        Peak ground acceleration [m/s2].

    Raises
    ------
    InputError
        A step that is not positive, a sample that is no acceleration, too few samples.
    """

    acceleration: FloatArray
    dt: float
    name: str = "record"
    processing: tuple[str, ...] = ()
    metadata: Mapping[str, str] = field(default_factory=dict)
    pga: float = field(init=False)

    def __init__(
        self,
        acceleration: ArrayLike,
        dt: float,
        name: str = "record",
        processing: Iterable[str] = (),
        *,
        metadata: Mapping[str, str] = MappingProxyType({}),
    ) -> None:
        values = as_array("acceleration", acceleration).copy()
        step = as_number("dt", dt)
        as_text("name", name)
        steps = (processing,) if isinstance(processing, str) else tuple(processing)
        for text in steps:
            as_text("processing", text)
        pga, stat, message = _core.check_record(values, step)
        _binding.check(stat, message)
        values.flags.writeable = False
        if not isinstance(metadata, Mapping):
            raise InputError(f"metadata: {type(metadata).__name__} is no mapping")
        known = MappingProxyType({str(key): str(value) for key, value in metadata.items()})
        for what, value in (
            ("acceleration", values),
            ("dt", step),
            ("name", name),
            ("processing", steps),
            ("metadata", known),
            ("pga", pga),
        ):
            object.__setattr__(self, what, value)

    def processed(self, acceleration: ArrayLike, step: str, dt: float | None = None) -> Record:
        """A record made from this one by a step of processing, one of your own for instance.

        Parameters
        ----------
        acceleration : array_like, shape (samples,)
            The new samples [m/s2].
        step : str
            What was done, for `processing`.
        dt : float, optional
            The new time step [s], that of this record if left out.

        Returns
        -------
        Record
            Of the same name and metadata, with the step added to its history of processing.
        """
        steps = (*self.processing, step)
        return Record(acceleration, self.dt if dt is None else dt, self.name, steps, metadata=self.metadata)

    @property
    def duration(self) -> float:
        """Time of the last sample [s]."""
        return (len(self.acceleration) - 1) * self.dt

    @property
    def time(self) -> FloatArray:
        """Times of the samples [s]."""
        time: FloatArray = self.dt * np.arange(len(self.acceleration), dtype=np.float64)
        return time

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
            *((key, self.metadata[key]) for key in ("event", "date", "station", "component") if key in self.metadata),
            *(("processing", step) for step in self.processing),
        ]

    def __repr__(self) -> str:
        return f"<Record {self.name!r}: " + ", ".join(f"{what} {text}" for what, text in self._facts()) + ">"

    def _repr_html_(self) -> str:
        return html_of(f"Record '{self.name}'", self._facts())

    def __getstate__(self) -> dict[str, object]:
        # A mapping proxy cannot be pickled, and what was uploaded stays in its process.
        state = {**self.__dict__, "metadata": dict(self.metadata)}
        state.pop("_home", None)
        return state

    def __setstate__(self, state: dict[str, object]) -> None:
        self.__dict__.update(state)
        self.__dict__["metadata"] = MappingProxyType(self.metadata)
        self.acceleration.flags.writeable = False


def read_record(
    path: str | os.PathLike[str],
    dt: float | None = None,
    units: str | None = None,
    channel: str | int | None = None,
    format: str | None = None,
) -> Record:
    """Read one channel of an accelerogram file; the format is recognised by its content.

    Parameters
    ----------
    path : path
        The file; its stem names the record, with the channel's name where there are several.
    dt : float, optional
        Time step [s], needed where the file does not state it.
    units : str, optional
        Units of the values such as 'm/s2', 'gal' or 'g', needed where the file does not state them.
    channel : str or int, optional
        Name of the channel or its number from 1, needed where the file holds several. A name goes before a number.
    format : str, optional
        Name of the format, as docs/ground_motions.md lists them, needed where it is not recognised.

    Returns
    -------
    Record

    Raises
    ------
    InputError
        The file is missing, unknown, wrong, or says less than is needed; it has no such channel.
    """
    name = str(channel) if isinstance(channel, int) else channel
    (data,) = _binding.read_records(path, 0, dt, units, name, format)
    return _as_record(data)


def read_records(
    path: str | os.PathLike[str], dt: float | None = None, units: str | None = None, format: str | None = None
) -> list[Record]:
    """Read all channels of an accelerogram file.

    Parameters
    ----------
    path, dt, units, format
        As those of `read_record`.

    Returns
    -------
    list of Record
        One for each channel.

    Raises
    ------
    InputError
        The file is missing, unknown, wrong, or says less than is needed.
    """
    return [_as_record(data) for data in _binding.read_records(path, 2, dt, units, layout=format)]


def read_catalogue(path: str | os.PathLike[str]) -> list[Record]:
    """Read all records of a catalogue.

    Parameters
    ----------
    path : path
        A CSV table with the columns file, dt_s, units, channel and format; files are relative to its folder.

    Returns
    -------
    list of Record

    Raises
    ------
    InputError
        The catalogue or one of its records is wrong.
    """
    return [_as_record(data) for data in _binding.read_records(path, 1)]


def _as_record(data: _binding.RecordData) -> Record:
    return Record(data.acceleration, data.dt, data.name, metadata=data.metadata)


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


def intensities(records: Iterable[Record], im: str, gravity: float | None = None) -> FloatArray:
    """An intensity measure of several records, in the unit of its levels."""
    pull = _binding.constants().gravity if gravity is None else as_number("gravity", gravity)
    if not 0.0 < pull < np.inf:
        raise InputError(f"gravity = {pull:g}: must be positive")
    several = as_records(records)
    values, stat, message = _core.intensities(upload(several).number, as_text("im", im), len(several), pull, 0)
    _binding.check(stat, message)
    return np.asarray(values)


def flatten(records: tuple[Record, ...]) -> _binding.FlatRecords:
    """All records as Fortran takes them."""
    return _binding.FlatRecords(
        "\n".join(record.name for record in records).encode(),
        np.array([len(record) for record in records], dtype=np.int32),
        np.array([record.dt for record in records]),
        np.concatenate([record.acceleration for record in records]),
    )


def upload(records: tuple[Record, ...]) -> Handle:
    """The records as a suite in Fortran. The same records in the same order are uploaded once.

    Each record keeps the suite that it was uploaded with last, and its place there: a suite lives as long as one of its
    records does, and has not come into another.
    """
    homes = [record.__dict__.get("_home", (None, 0, 0)) for record in records]
    suite: Handle | None = homes[0][0]
    if suite is not None and homes == [(suite, i, len(records)) for i in range(len(records))]:
        return suite
    handle, stat, message = _core.new_suite(*flatten(records))
    _binding.check(stat, message)
    suite = Handle(handle)
    for i, record in enumerate(records):
        object.__setattr__(record, "_home", (suite, i, len(records)))
    return suite


def place_of(record: Record) -> tuple[int, int]:
    """Where Fortran has a record: the handle of a suite, and the number in it from 1."""
    if "_home" not in record.__dict__:
        upload((record,))
    suite, place, _ = record.__dict__["_home"]
    return suite.number, place + 1
