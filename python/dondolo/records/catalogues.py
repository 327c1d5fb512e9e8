"""Catalogues: made of folders of accelerogram files, and written of sets of records."""

from __future__ import annotations

import csv
import os
import re
import zlib
from collections.abc import Mapping
from contextlib import suppress
from itertools import count, product
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from dondolo._base.arguments import FloatArray, argument_error, as_flag
from dondolo._base.files import as_file, read_bytes, read_text, synchronize, thing
from dondolo._fortran.files import locked
from dondolo._fortran.library import constants
from dondolo._fortran.origins import check_replaced
from dondolo._storage import tables
from dondolo.errors import DondoloError, InputError
from dondolo.records.directions import is_search_result, other_quantity, vertical_mark
from dondolo.records.reading import read_records
from dondolo.records.record import Record
from dondolo.records.synthetic import SYNTHETIC

if TYPE_CHECKING:
    from dondolo.records.record_set import RecordSet

# Second line of catalogues that sets of records were written to; end of the first line of those made of a folder
_MARK, _FOUND = "# records written by dondolo", ": records found"
# Columns of files and of their checksums, and the names of the files that a set of records is written to
_FILES = (("file", "crc32"), ("vertical", "vertical_crc32"))
_NAMED = re.compile(r"\d+_.*_([0-9a-f]{8})(?:_\d+)?\.txt")
# Metadata that a file of columns states otherwise
_STATED = ("format", "quantity", "units", "dt", "channel", "reading")

#: Words of a refusal that columns, dt and units can mend; of one that dt can; and of one that dt or units can
_UNCLEAR, _COARSE, _MISSING = "a row of a catalogue must say", "are read with a dt_s, or dt", "must be given"

#: Metadata that stand in a catalogue, for its readers.
_KEYS = ("event", "date", "station", "component", "magnitude")


class Catalogue(NamedTuple):
    """What was found in a folder."""

    path: Path
    records: int
    problems: list[str]
    contradictions: list[str]


def build_catalogue(
    folder: str | os.PathLike[str],
    file: str | os.PathLike[str] | None = None,
    dt: float | None = None,
    units: str | None = None,
    vertical: bool = False,
    layout: str | None = None,
) -> Catalogue:
    """Write a catalogue of all accelerogram files in a folder and the folders in it, one row per channel.

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
        Keep vertical components, which are left out otherwise. They are recognised by the metadata (component,
        channel, axis and others), else by the file's name: docs/ground_motions.md.
    layout : str, optional
        What the columns of plain files are that do not say so, as `columns` of `read_records`.

    Returns
    -------
    Catalogue
        Its path, its number of records, one line for each file or channel that is left out, with the reason, and one
        for each file that states another step or other units than are given: what it states counts.

    Raises
    ------
    InputError
        No such folder, no accelerogram in it, or a file that is no catalogue stands where it would be written.
    """
    as_flag("vertical", vertical)
    root = Path(folder)
    if root.is_file():
        raise InputError(
            f"{root}: is a file: must be the folder of the accelerograms. A catalogue of one file is a table of one"
            f" row, 'file,dt_s,units' and below it '{root.name},0.01,g' with its own time step [s] and units"
        )
    if not root.is_dir():
        raise InputError(f"{root}: no such folder")
    target = root / "catalogue.csv" if file is None else Path(file)
    if file is None and target.exists():
        raise InputError(f"{target}: already exists: to replace it, name it: -o {target}")
    columns = ("file", "channel", "dt_s", "units", *(("columns",) if layout else ()), *_KEYS)
    check_replaced(target, "catalogue")
    table: dict[str, list[str]] = {column: [] for column in columns}
    problems, contradictions = [], []
    files = [path for path in sorted(root.rglob("*")) if path.is_file() and not _is_hidden(path, root)]
    for path in files:
        if path.resolve() == target.resolve():
            continue
        place = Path(os.path.relpath(path, target.parent)).as_posix()
        try:
            place.encode()
            if is_search_result(path):
                raise InputError(f"{path}: a list of search results of PEER, not an accelerogram")
            records, given = _read(path, dt, units, layout)
            contradictions += _contradictions(path, dt, units, given)
        except UnicodeEncodeError:
            problems.append(f"{path}: a name that UTF-8 does not know")
            continue
        except InputError as error:
            options = " (options --dt and --units)" if _MISSING in str(error) else ""
            options = " (option --dt)" if _COARSE in str(error) and dt is None else options
            options = " (option --columns)" if _UNCLEAR in str(error) and not layout else options
            problems.append(f"{error}{options}")
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
            row += (record.metadata.get("units", given.units),)
            row += (given.columns,) if layout else ()
            row += tuple(record.metadata.get(key, "") for key in _KEYS)
            for column, text in zip(columns, row, strict=True):
                table[column].append(text)
    if not table["file"]:
        raise InputError("\n".join([*problems, f"{root}: no accelerogram that can be read"]))
    tables.write_lines(target, tables.csv_lines(table, [f"dondolo {constants().version}{_FOUND}"]))
    return Catalogue(target, len(table["file"]), problems, contradictions)


def write_catalogue(records: RecordSet, path: str | os.PathLike[str]) -> None:
    """Write a set of records as a catalogue, and its accelerograms as files of columns in a folder beside it.

    Every file has the samples with all their digits. Its name is a number, the name of the record, of which it has the
    characters that every file system takes, and the checksum of the file: no file of an earlier catalogue is touched
    before the table, which states the checksums, takes the place of the earlier one. What only it named is removed
    then, unless it has been changed.
    """
    target = as_file("path", path)
    check_replaced(target, "records")
    if not target.suffix:
        raise argument_error("out_of_range", "path", f" = {os.fspath(path)!r}: must have a suffix, such as .csv")
    each = list(dict.fromkeys(records.records))
    names = [record.name for record in each]
    for name in names:
        if names.count(name) > 1:
            raise argument_error(
                "not_together", "records", f": two have the name {name!r}: must have names of their own in a catalogue"
            )
    folder = target.with_suffix("")
    with locked(target) as killed:
        check_replaced(target, "records")
        earlier = _files_of(target)
        if killed:
            earlier |= _left_by_killed(folder)
        added: list[Path] = []
        try:
            is_new = not folder.exists()
            folder.mkdir(exist_ok=True)
            files, verticals = {}, {}
            for i, record in enumerate(each, 1):
                stem = f"{i:0{len(str(len(each)))}d}_{re.sub(r'[^A-Za-z0-9_.-]+', '_', record.name)[:80]}"
                about = {key: value for key, value in record.metadata.items() if key not in _STATED}
                lines = [f"# {key}: {' '.join(value.split())}" for key, value in about.items()]
                files[record] = _write_record(folder, stem, lines, record.dt, record.acceleration, added)
                if record.vertical is not None:
                    verticals[record] = _write_record(folder, f"{stem}_vertical", [], record.dt, record.vertical, added)
            synchronize(folder)
            lines = tables.csv_lines(_table(records, files, verticals), [f"dondolo {constants().version}"])
            tables.write_lines(target, [lines[0], _MARK, *lines[1:]])
        except BaseException as error:
            # What comes too late to keep the table from its place must not cost its files.
            for file in set(added) - _files_of(target):
                with suppress(OSError):
                    file.unlink()
            if is_new:
                with suppress(OSError):
                    folder.rmdir()
            if isinstance(error, OSError) and not isinstance(error, DondoloError):
                raise DondoloError(f"{folder}: cannot be written: {error.strerror}") from error
            raise
        named = {target.parent / file.place for file in (*files.values(), *verticals.values())}
        for file in earlier - named:
            with suppress(OSError):
                file.unlink()


class _RecordFile(NamedTuple):
    """A file of a record: its path from the folder of the catalogue, and its checksum."""

    place: str
    crc32: str


def _write_record(
    folder: Path, stem: str, about: list[str], dt: float, samples: FloatArray, added: list[Path]
) -> _RecordFile:
    """Write a file of a record, unless it is there already; another of its name stays; note what is added."""
    lines = [*about, "# units: m/s2", f"# dt: {dt!r}", *map(repr, samples.tolist())]
    content = ("\n".join(lines) + "\n").encode()
    crc32 = f"{zlib.crc32(content):08x}"
    for i in count(1):
        again = f"_{i}" if i > 1 else ""
        file = folder / f"{stem}_{crc32}{again}.txt"
        if not os.path.lexists(file):
            added.append(file)
            tables.write_lines(file, lines)
            break
        if not thing(file, follow_symlinks=False) and file.read_bytes() == content:
            break
    return _RecordFile(f"{folder.name}/{file.name}", crc32)


def _table(
    records: RecordSet, files: Mapping[Record, _RecordFile], verticals: Mapping[Record, _RecordFile]
) -> tables.Table:
    """Columns of a catalogue."""
    table: tables.Table = {
        "file": [files[record].place for record in records],
        "name": [record.name for record in records],
        "dt_s": [tables.shortest(record.dt) for record in records],
        "units": ["m/s2"] * len(records),
        "crc32": [files[record].crc32 for record in records],
    }
    if any(record.metadata.get("format") == SYNTHETIC for record in records):
        # Other formats are those of the files that the records were read from.
        formats = (record.metadata.get("format", "") for record in records)
        table["format"] = [SYNTHETIC if form == SYNTHETIC else "" for form in formats]
    if verticals:
        none = _RecordFile("", "")
        table["vertical"] = [verticals.get(record, none).place for record in records]
        table["vertical_crc32"] = [verticals.get(record, none).crc32 for record in records]
    for what in ("level", "factor"):
        values = getattr(records, what)
        if values is not None:
            table[what] = ["" if np.isnan(value) else tables.shortest(value) for value in values]
    return table


def _files_of(target: Path) -> set[Path]:
    """The files that a catalogue of records names, of those that are in its folder and as they were written."""
    found: set[Path] = set()
    if not target.exists():
        return found
    # A table that was changed so that it cannot be read names nothing that may be removed.
    with suppress(InputError, csv.Error):
        rows = csv.DictReader(line for line in read_text(target).splitlines() if not line.startswith("#"))
        for row in rows:
            for place, crc32 in ((row.get(what), row.get(sum_)) for what, sum_ in _FILES):
                if place and crc32 and _is_unchanged(file := target.parent / place, crc32, target.with_suffix("")):
                    found.add(file)
    return found


def _left_by_killed(folder: Path) -> set[Path]:
    """Files of records that a process may have left that was killed: those with their own checksum in their names."""
    named = {file: _NAMED.fullmatch(file.name) for file in folder.glob("*.txt")}
    return {file for file, found in named.items() if found and _is_unchanged(file, found[1], folder)}


def _is_unchanged(file: Path, crc32: str, folder: Path) -> bool:
    """Whether a file is in a folder, and has a checksum."""
    try:
        return file.parent == folder and f"{zlib.crc32(read_bytes(file)):08x}" == crc32
    except InputError:
        return False


class _Given(NamedTuple):
    """What a file did not state, and was given."""

    dt: float | None
    units: str
    columns: str


def _read(path: Path, dt: float | None, units: str | None, layout: str | None) -> tuple[list[Record], _Given]:
    """All channels of a file, and what it did not state."""
    # What a file states may not be given unless it agrees, so that each is tried without the other first
    attempts = dict.fromkeys(product((None, layout), (None, dt), (None, units)))
    for what, step, unit in attempts:
        try:
            records = read_records(path, dt=step, units=unit, columns=what)
            return records, _Given(step, unit or "", what or "")
        except InputError as error:
            reason = error
            if not any(words in str(error) for words in (_UNCLEAR, _COARSE, _MISSING)):
                break
    raise reason


def _contradictions(path: Path, dt: float | None, units: str | None, given: _Given) -> list[str]:
    """What a file states otherwise than it is given, by the rule of `read_records`; nothing if all is the same."""
    if dt == given.dt and (units or "") == given.units:
        return []
    try:
        read_records(path, dt=dt, units=units, columns=given.columns or None)
    except InputError as error:
        return [str(error)]
    return []


def _is_hidden(path: Path, root: Path) -> bool:
    return any(part.startswith(".") for part in path.relative_to(root).parts)
