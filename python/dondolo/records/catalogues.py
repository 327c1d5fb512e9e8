"""Catalogues: made of folders of accelerogram files, and written of sets of records."""

from __future__ import annotations

import os
import re
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from dondolo._base.arguments import as_flag
from dondolo._base.files import as_file, check_replaced
from dondolo._fortran.library import constants
from dondolo._storage import tables
from dondolo.errors import DondoloError, InputError
from dondolo.records.directions import is_search_result, other_quantity, vertical_mark
from dondolo.records.reading import read_records
from dondolo.records.record import Record

if TYPE_CHECKING:
    from dondolo.records.record_set import RecordSet

#: What stands in the second line of catalogues that sets of records were written to
_MARK = "# records written by dondolo"
# Metadata that a file of columns states otherwise
_STATED = ("format", "quantity", "units", "dt", "channel", "reading")

#: Metadata that stand in a catalogue, for its readers.
_KEYS = ("event", "date", "station", "component", "magnitude")


class Catalogue(NamedTuple):
    """What was found in a folder."""

    path: Path
    records: int
    problems: list[str]


def build_catalogue(
    folder: str | os.PathLike[str],
    file: str | os.PathLike[str] | None = None,
    dt: float | None = None,
    units: str | None = None,
    vertical: bool = False,
) -> Catalogue:
    """Write a catalogue of all accelerogram files in a folder and the folders in it, one row a channel.

    Parameters
    ----------
    folder : path
        Where the files are.
    file : path, optional
        The catalogue, in place of an earlier one; ``catalogue.csv`` in the folder if left out, where there must be none
        yet.
    dt, units : optional
        Time step [s] and units for the files that do not state them.
    vertical : bool
        Keep vertical components, which are left out otherwise. They are recognised by component, channel and axis in
        the metadata, else by the file's name: UP, UD, DWN, VERT, HNZ, HGZ, or V or Z at its end.

    Returns
    -------
    Catalogue
        Its path, its number of records, and one line for each file or channel that is left out, with the reason.

    Raises
    ------
    InputError
        No such folder, no accelerogram in it, or a file that is no catalogue stands where it would be written.
    """
    as_flag("vertical", vertical)
    root = Path(folder)
    if not root.is_dir():
        raise InputError(f"{root}: no such folder")
    target = root / "catalogue.csv" if file is None else Path(file)
    if file is None and target.exists():
        raise InputError(f"{target}: already exists: name the catalogue with -o, which replaces it if it is one")
    columns = ("file", "channel", "dt_s", "units", *_KEYS)
    check_replaced(target, ",".join(columns), "catalogue")
    table: dict[str, list[str]] = {column: [] for column in columns}
    problems = []
    files = [path for path in sorted(root.rglob("*")) if path.is_file() and not _is_hidden(path, root)]
    for path in files:
        if path.resolve() == target.resolve():
            continue
        place = Path(os.path.relpath(path, target.parent)).as_posix()
        try:
            place.encode()
            if is_search_result(path):
                raise InputError(f"{path}: a list of search results of PEER, no accelerogram")
            records, given_units = _read(path, dt, units)
        except UnicodeEncodeError:
            problems.append(f"{path}: a name that UTF-8 does not know")
            continue
        except InputError as error:
            problems.append(str(error))
            continue
        for record in records:
            quantity = other_quantity(record, path)
            if quantity:
                problems.append(f"{path}: no acceleration, by {quantity!r} in its name; it does not state its units")
                continue
            mark = "" if vertical else vertical_mark(record, path)
            if mark:
                problems.append(f"{path}: a vertical component, by its {mark}")
                continue
            row: tuple[str, ...] = (place, record.metadata.get("channel", ""), f"{record.dt:.12g}")
            row += (record.metadata.get("units", given_units),)
            row += tuple(record.metadata.get(key, "") for key in _KEYS)
            for column, text in zip(columns, row, strict=True):
                table[column].append(text)
    if not table["file"]:
        raise InputError("\n".join([*problems, f"{root}: no accelerogram that can be read"]))
    tables.write_csv(target, table)
    return Catalogue(target, len(table["file"]), problems)


def write_catalogue(records: RecordSet, path: str | os.PathLike[str]) -> None:
    """Write a set of records as a catalogue, and its accelerograms as files of columns in a folder beside it.

    Every file has the samples with all their digits. Names of files are numbers and the names of the records, those of
    their characters that every file system takes.
    """
    target = as_file("path", path)
    check_replaced(target, _MARK, "catalogue of records")
    if not target.suffix:
        raise InputError(f"path = {os.fspath(path)!r}: must have a suffix, such as .csv")
    each = list(dict.fromkeys(records.records))
    names = [record.name for record in each]
    for name in names:
        if names.count(name) > 1:
            raise InputError(f"records: two have the name {name!r}: must have names of their own in a catalogue")
    folder = target.with_suffix("")
    try:
        folder.mkdir(exist_ok=True)
    except OSError as error:
        raise DondoloError(f"{folder}: cannot be written: {error.strerror}") from error
    files, verticals = {}, {}
    for i, record in enumerate(each, 1):
        stem = re.sub(r"[^A-Za-z0-9_.-]+", "_", record.name)[:80]
        files[record] = f"{folder.name}/{i:0{len(str(len(each)))}d}_{stem}.txt"
        about = {key: value for key, value in record.metadata.items() if key not in _STATED}
        lines = [f"# {key}: {' '.join(value.split())}" for key, value in about.items()]
        lines += ["# units: m/s2", f"# dt: {record.dt!r}", *map(repr, record.acceleration.tolist())]
        tables.write_lines(target.parent / files[record], lines)
        if record.vertical is not None:
            verticals[record] = files[record].removesuffix(".txt") + "_vertical.txt"
            lines = ["# units: m/s2", f"# dt: {record.dt!r}", *map(repr, record.vertical.tolist())]
            tables.write_lines(target.parent / verticals[record], lines)
    table: tables.Table = {
        "file": [files[record] for record in records],
        "name": [record.name for record in records],
        "dt_s": [tables.shortest(record.dt) for record in records],
        "units": ["m/s2"] * len(records),
    }
    if verticals:
        table["vertical"] = [verticals.get(record, "") for record in records]
    for what in ("level", "factor"):
        values = getattr(records, what)
        if values is not None:
            table[what] = ["" if np.isnan(value) else tables.shortest(value) for value in values]
    lines = tables.csv_lines(table, [f"dondolo {constants().version}"])
    tables.write_lines(target, [lines[0], _MARK, *lines[1:]])


def _read(path: Path, dt: float | None, units: str | None) -> tuple[list[Record], str]:
    """All channels of a file, and the units that it did not state."""
    # What a file states may not be given unless it agrees, so that each is tried without the other first
    attempts = dict.fromkeys([(None, None), (None, units), (dt, None), (dt, units)])
    for attempt in attempts:
        try:
            return read_records(path, dt=attempt[0], units=attempt[1]), attempt[1] or ""
        except InputError as error:
            reason = error
            if attempt == (None, None) and "must be given" not in str(error):
                break
    raise reason


def _is_hidden(path: Path, root: Path) -> bool:
    return any(part.startswith(".") for part in path.relative_to(root).parts)
