"""Records, tables and intensity measures that Fortran reads and describes."""

from __future__ import annotations

import functools
import os
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from dondolo._base.arguments import FloatArray, as_number, as_path
from dondolo._fortran import _core
from dondolo._fortran.library import Parcel, as_text, constants, receive, warn_of_notes
from dondolo.errors import InputError


class RecordData(NamedTuple):
    """A record as Fortran has read and checked it, with arrays of its own."""

    name: str
    dt: float
    acceleration: FloatArray
    peak: float
    metadata: dict[str, str]
    vertical: FloatArray | None


class MeasureData(NamedTuple):
    """An intensity measure.

    Attributes
    ----------
    name : str
        As dondolo writes it.
    unit : str
        Of its levels; '' for a number.
    title : str
        What it is, in words.
    power : int
        Power of a record's scale that it grows by.
    """

    name: str
    unit: str
    title: str
    power: int


def unpack_records(parcel: Parcel) -> list[RecordData]:
    """Records out of a parcel."""
    horizontal = [parcel.series(length) for length in parcel["records_samples"].tolist()]
    upwards = [parcel.series(length) if length else None for length in parcel["records_verticals"].tolist()]
    words = iter(parcel["records_metadata"])
    metadata = [{next(words): next(words) for _ in range(number)} for number in parcel["records_entries"].tolist()]
    steps, peaks = parcel["records_dt"].tolist(), parcel["records_pga"].tolist()
    return list(map(RecordData, parcel["records_name"], steps, horizontal, peaks, metadata, upwards))


def records_of_file(
    path: str | os.PathLike[str],
    what: int,
    dt: float | None = None,
    units: str | None = None,
    channel: str | None = None,
    layout: str | None = None,
    columns: str | None = None,
    vertical_factor: float | None = None,
) -> tuple[list[RecordData], tuple[NDArray[np.int32], FloatArray, FloatArray]]:
    """Read one channel of a file (what = 0), all records of a catalogue (1), or all channels of a file (2).

    Vertical components are read with a factor on them. Of a catalogue with levels also the record (from 1), level and
    factor of each row, 0 where it has none; else empty.
    """
    step = 0.0 if dt is None else as_number("dt", dt)
    texts = (
        b"" if text is None else as_text(name, text)
        for name, text in (("units", units), ("channel", channel), ("format", layout), ("columns", columns))
    )
    vertical = (0, 0.0) if vertical_factor is None else (1, vertical_factor)
    parcel = receive(_core.records.read_records(as_path(path), what, int(dt is not None), step, *texts, *vertical))
    records = unpack_records(parcel)
    # After all has been taken, since a warning may be an error
    warn_of_notes(parcel["notes"])
    if "row_record" not in parcel.names:
        return records, (np.zeros(0, dtype=np.int32), np.zeros(0), np.zeros(0))
    return records, (parcel["row_record"], parcel["row_level"], parcel["row_factor"])


def read_number_table(path: str | os.PathLike[str]) -> tuple[list[str], FloatArray]:
    """Read a table of numbers: the names of its columns, and its numbers (rows, columns)."""
    parcel = receive(_core.records.read_number_table(as_path(path)))
    warn_of_notes(parcel["notes"])
    return parcel["columns"], parcel["numbers"]


def catalogue_table(path: str | os.PathLike[str]) -> list[str]:
    """The table of the records of a catalogue, as the executable prints it."""
    parcel = receive(_core.records.catalogue_table(as_path(path), constants().gravity))
    warn_of_notes(parcel["notes"])
    table: list[str] = parcel["table"]
    return table


def describe_measure(im: str, of_record: bool = False) -> MeasureData:
    """A measure that records can be scaled by, or one that they have of themselves."""
    return _describe_measure(as_text("im", im), of_record)


@functools.cache
def _describe_measure(im: bytes, of_record: bool) -> MeasureData:
    parcel = receive(_core.records.describe_measure(im, int(of_record)))
    return MeasureData(**parcel.named(MeasureData._fields))


def name_of_measure(im: str) -> str:
    """A measure as dondolo writes it, 'sa(0.5)' for 'SA(0.50)'; one that it does not know, or '', as it is given."""
    as_text("im", im)
    try:
        return describe_measure(im).name if im else im
    except InputError:
        return im


def unit_of(im: str) -> str:
    """The unit of the levels of a measure; '' for a number, and for a name that dondolo does not know."""
    try:
        return describe_measure(im).unit
    except InputError:
        return ""


def blank_unit(im: str) -> str:
    """The unit with its blank, for the end of a number; '' where there is none."""
    return f" {unit_of(im)}".rstrip()


def levels_in_words(levels: FloatArray, im: str) -> str:
    """How many levels of a measure, from where to where."""
    return f"{len(levels)} of {im}, {levels[0]:g} to {levels[-1]:g}{blank_unit(im)}"
