"""Accelerograms read from files."""

from __future__ import annotations

import os
from typing import Literal

import numpy as np

from dondolo._base.arguments import as_number, one_of
from dondolo._fortran.records import records_of_file
from dondolo.records.record import Record, record_from
from dondolo.records.record_set import RecordSet


def read_record(
    path: str | os.PathLike[str],
    *,
    dt: float | None = None,
    units: str | None = None,
    channel: str | int | None = None,
    format: str | None = None,
    columns: str | None = None,
) -> Record:
    r"""Read one channel of an accelerogram file; the format is recognised by its content.

    Parameters
    ----------
    path : path
        The file; its stem names the record, with the channel's name where there are several.
    dt : float, optional
        Time step [s], needed where the file does not state it.
    units : str, optional
        Units of the values such as 'm/s2', 'gal' or 'g', needed where the file does not state them.
    channel : str or int, optional
        Name of the channel or its number from 1, needed where the file has several. A name goes before a number.
    format : str, optional
        Name of the format, as docs/ground_motions.md lists them, needed where it is not recognised.
    columns : str, optional
        What plain columns are, where the file does not say so: 'time', 'acceleration' or 'other' for each of them, as
        in 'time, acceleration', or 'rows' where values go along the rows. With units, and dt unless a column is one of
        times, what stands above the values is passed over.

    Returns
    -------
    Record

    Raises
    ------
    InputError
        The file is missing, of an unknown format, wrong or incomplete; it has no such channel.

    Examples
    --------
    A column in g, its time step given, as the file does not state it.

    >>> from pathlib import Path
    >>> import dondolo as dd
    >>> _ = Path("station.txt").write_text("0.0\n0.1\n-0.2\n0.0\n")
    >>> record = dd.read_record("station.txt", dt=0.01, units="g")
    >>> record.name, round(record.peak_acceleration, 3)  # in m/s2
    ('station', 1.961)
    """
    name = str(channel) if isinstance(channel, int) else channel
    ((data,), _) = records_of_file(path, 0, dt, units, name, format, columns)
    return record_from(data)


def read_records(
    path: str | os.PathLike[str],
    *,
    dt: float | None = None,
    units: str | None = None,
    format: str | None = None,
    columns: str | None = None,
) -> list[Record]:
    r"""Read all channels of an accelerogram file.

    Parameters
    ----------
    path, dt, units, format, columns
        As those of `read_record`.

    Returns
    -------
    list of Record
        One for each channel.

    Raises
    ------
    InputError
        The file is missing, of an unknown format, wrong or incomplete.

    Examples
    --------
    >>> from pathlib import Path
    >>> import dondolo as dd
    >>> _ = Path("station.txt").write_text("0.0\n0.1\n-0.2\n0.0\n")
    >>> len(dd.read_records("station.txt", dt=0.01, units="g"))
    1
    """
    return [record_from(data) for data in records_of_file(path, 2, dt, units, layout=format, columns=columns)[0]]


def read_catalogue(
    path: str | os.PathLike[str],
    *,
    vertical: Literal["none", "recorded"] = "none",
    vertical_factor: float = 1.0,
) -> RecordSet:
    r"""Read all records of a catalogue.

    Parameters
    ----------
    path : path
        A CSV table with the columns file, dt_s, units, channel, format and columns; files are relative to its folder.
        The columns level and factor say which records run at which levels of intensity, and how they are scaled. All
        other columns are metadata of the records.
    vertical : {'none', 'recorded'}
        'recorded': each record has the vertical component that the column vertical of the catalogue names.
    vertical_factor : float
        Factor on it, beside that of the record in analyses; negative for components that are positive downwards.

    Returns
    -------
    RecordSet

    Raises
    ------
    InputError
        The catalogue or one of its records is wrong.

    Examples
    --------
    >>> from pathlib import Path
    >>> import dondolo as dd
    >>> _ = Path("station.txt").write_text("0.0\n0.1\n-0.2\n0.0\n")
    >>> _ = Path("records.csv").write_text("file,dt_s,units,magnitude\nstation.txt,0.01,g,6.1\n")
    >>> records = dd.read_catalogue("records.csv")
    >>> records[0].metadata["magnitude"]
    '6.1'
    """
    one_of("vertical", vertical, ("none", "recorded"))
    on_vertical = as_number("vertical_factor", vertical_factor) if vertical == "recorded" else None
    several, (place, level, factor) = records_of_file(path, 1, vertical_factor=on_vertical)
    records = [record_from(data) for data in several]
    if not len(place):
        return RecordSet(records)
    given = factor if factor.any() else None
    rows = [None if values is None else np.where(values > 0.0, values, np.nan) for values in (level, given)]
    return RecordSet([records[i - 1] for i in place], level=rows[0], factor=rows[1])
