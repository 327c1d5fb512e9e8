"""Records in Fortran: uploaded once as a suite, and what is measured there."""

from __future__ import annotations

import weakref
from collections.abc import Mapping
from operator import is_
from typing import NamedTuple, Protocol

import numpy as np

from dondolo._base.arguments import FloatArray, argument_error, as_number
from dondolo._fortran import _core
from dondolo._fortran.handles import Handle
from dondolo._fortran.library import as_text, check, constants, receive
from dondolo.errors import InputError

# What a weak reference refers to, None if it is gone
_referred = weakref.ref.__call__


# What metadata are asked for the labels of a record
_LABELS = ("event", "station", "date", "stated date", "event time", "event latitude", "event longitude")


class Labels(NamedTuple):
    """What metadata say of the earthquake of a record, '' where it is not known.

    Attributes
    ----------
    earthquake : str
        Its name or origin.
    cluster : str
        Label of the records that depend on each other: the earthquake, else station and date.
    date : str
        As ISO 8601 has it, or as it is stated where it is no day of the calendar.
    """

    earthquake: str
    cluster: str
    date: str


class Component(NamedTuple):
    """Which way a component points, whether it is vertical.

    Key and text are those of the metadata that show it, or 'name' and the name; '' where nothing does.
    """

    key: str
    text: str
    is_vertical: bool


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

    @property
    def event(self) -> str: ...

    @property
    def _labels(self) -> Labels: ...

    @property
    def checksum(self) -> str: ...

    @property
    def largest_fall(self) -> float: ...

    def __len__(self) -> int: ...


class Facts(NamedTuple):
    """What results tell of their records.

    Attributes
    ----------
    names, events, checksums, formats : tuple of str
        Of each record.
    falls : ndarray, shape (records,), or None
        `Record.largest_fall` of each [m/s2]; None without vertical motion.
    samples : float
        Samples of a record, on average.
    """

    names: tuple[str, ...]
    events: tuple[str, ...]
    checksums: tuple[str, ...]
    formats: tuple[str, ...]
    falls: FloatArray | None
    samples: float


class Suite(Handle):
    """Records that were uploaded, which it does not keep alive.

    Parameters
    ----------
    number : int
        The handle of Fortran.
    records : tuple of Record
        The records.
    """

    __slots__ = ("_facts", "_measured", "_members")

    def __init__(self, number: int, records: tuple[Motion, ...]) -> None:
        super().__init__(number)
        self._members = tuple(map(weakref.ref, records))
        self._facts: Facts | None = None
        self._measured: set[str] = set()

    def holds(self, records: tuple[Motion, ...]) -> bool:
        """Whether these are its records, in their order."""
        return len(records) == len(self._members) and all(map(is_, map(_referred, self._members), records))

    def events(self) -> tuple[str, ...]:
        """Label of the cluster of each record, '' for none: its event, with the date where several have the name."""
        return tuple(receive(_core.records.cluster_labels(self.number)).lines)

    def measure(self, im: str, threads: int) -> None:
        """Let Fortran measure its records, which keeps the values for all studies to come."""
        if im not in self._measured:
            check(_core.records.measure_suite(self.number, as_text("im", im), threads))
            self._measured.add(im)

    def facts(self, records: tuple[Motion, ...]) -> Facts:
        """What results tell of its records, which must be given."""
        if self._facts is None:
            moves_up = any(record.vertical is not None for record in records)
            self._facts = Facts(
                tuple(record.name for record in records),
                self.events(),
                tuple(record.checksum for record in records),
                tuple(record.metadata.get("format", "") for record in records),
                np.array([record.largest_fall for record in records]) if moves_up else None,
                sum(map(len, records)) / len(records),
            )
        return self._facts


def upload(records: tuple[Motion, ...], threads: int = 1) -> Suite:
    """The records as a suite in Fortran, joined by threads. The same records in the same order are uploaded once.

    Each record keeps the suite that it was uploaded with last, and its place there: a suite lives as long as one of its
    records does, and has not come into another.
    """
    suite: Suite | None = records[0].__dict__.get("_home", (None, 0))[0]
    if suite is not None and suite.holds(records):
        return suite
    verticals = [record.vertical for record in records if record.vertical is not None]
    handle, failure = _core.records.new_suite(
        "\n".join(record.name for record in records).encode(),
        "\n".join(line for record in records for line in _label_lines(record)).encode(),
        np.array([len(record) for record in records], dtype=np.int32),
        np.array([record.dt for record in records]),
        np.concatenate([record.acceleration for record in records]),
        np.array([record.vertical is not None for record in records], dtype=np.int32),
        # f2py takes no empty arrays
        np.concatenate(verticals or [np.zeros(1)]),
        threads,
    )
    check(failure)
    suite = Suite(handle, records)
    for i, record in enumerate(records):
        object.__setattr__(record, "_home", (suite, i))
    return suite


def place_of(record: Motion) -> tuple[Suite, int]:
    """Where Fortran has a record: a suite, and the number in it from 1.

    The suite must be kept until Fortran has returned: another thread may upload the record again, beside others.
    """
    if "_home" not in record.__dict__:
        upload((record,))
    suite, place = record.__dict__["_home"]
    return suite, place + 1


def intensities(records: tuple[Motion, ...], im: str, gravity: float | None = None) -> FloatArray:
    """An intensity measure of several records, in the unit of its levels."""
    pull = constants().gravity if gravity is None else as_number("gravity", gravity)
    if not 0.0 < pull < np.inf:
        raise argument_error("out_of_range", "gravity", f" = {pull:g}: must be positive")
    suite = upload(records)
    values, failure = _core.records.intensities(suite.number, as_text("im", im), len(records), pull, 0)
    check(failure)
    return np.asarray(values)


def labels_of(metadata: Mapping[str, str]) -> Labels:
    """What metadata say of the earthquake of a record (dondolo_records_earthquake)."""
    known = {key: metadata[key] for key in _LABELS if key in metadata}
    if not known:
        return Labels("", "", "")
    parcel = receive(_core.records.labels_of(_lines(known), len(known)))
    return Labels(**parcel.named(Labels._fields))


def component_of(metadata: Mapping[str, str], name: str) -> Component:
    """Which way a component points, by its metadata, else by a name (dondolo_records_direction)."""
    parcel = receive(_core.records.component_of(_lines(metadata), len(metadata), _one_line(name).encode() or b" "))
    return Component(parcel["key"], parcel["text"], bool(parcel["is_vertical"]))


def check_components(first: Motion, second: Motion) -> None:
    """Refuse two records whose stations, days or earthquakes differ: they are no components of one motion."""
    labels = (first.metadata, second.metadata)
    parcel = receive(_core.records.difference_of(*(part for one in labels for part in (_lines(one), len(one)))))
    if parcel["key"]:
        raise InputError(
            f"components '{first.name}' and '{second.name}': {parcel['key']} = '{parcel['one']}' and"
            f" '{parcel['other']}': must be the same"
        )


def _lines(metadata: Mapping[str, str]) -> bytes:
    """Metadata as Fortran takes them, keys and values in turn."""
    return "\n".join(_one_line(text) for pair in metadata.items() for text in pair).encode() or b" "


def _label_lines(record: Motion) -> tuple[str, ...]:
    """Labels of a record as a suite takes them."""
    labels, component = record._labels, component_of(record.metadata, "")
    station, form, motion = (_one_line(record.metadata.get(key, "")) for key in ("station", "format", "motion"))
    return labels.earthquake, station, labels.date, form, motion, component.key, _one_line(component.text)


def _one_line(text: str) -> str:
    return " ".join(text.split())


def check_motions(records: tuple[Motion, ...]) -> None:
    """Refuse records without motion, as analyses at levels do (dondolo_record_dead_channel)."""
    suite = upload(records)
    check(_core.records.check_motions(suite.number))


def spectral_displacements(record: Motion, periods: FloatArray, damping: float) -> FloatArray:
    """Largest displacements of oscillators relative to the ground [m]."""
    suite, place = place_of(record)
    values, failure = _core.records.spectrum(suite.number, place, periods, damping)
    check(failure)
    return np.asarray(values)


def velocity(record: Motion) -> FloatArray:
    """Ground velocity at the samples, 0 at the first [m/s]; exact for accelerations linear in between."""
    suite, place = place_of(record)
    values, failure = _core.records.ground_velocity(suite.number, place, len(record))
    check(failure)
    return np.asarray(values)


def significant_times(record: Motion, low: float, high: float) -> tuple[float, float]:
    """Times at which Arias' integral reaches two parts of its end value [s]; 0 and 1: where motion begins and ends."""
    low, high = as_number("low", low), as_number("high", high)
    if not 0.0 <= low < high <= 1.0:
        raise argument_error("not_increasing", "low", f" = {low:g}, high = {high:g}: must increase, between 0 and 1")
    suite, place = place_of(record)
    (first, last), failure = _core.records.significant_times(suite.number, place, low, high)
    check(failure)
    if not last > 0.0:
        raise InputError(f"record '{record.name}': has no motion")
    return float(first), float(last)
