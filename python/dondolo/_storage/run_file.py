"""The file of a run: what ran, on which inputs, and what to beware of, as data beside the tables."""

from __future__ import annotations

import json
import math
import os
import zlib
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, fields, replace
from datetime import datetime
from typing import Any

from dondolo._base.arguments import argument_error, increasing
from dondolo._base.files import RUN_NAME, read_text
from dondolo._fortran.files import Written
from dondolo._fortran.library import constants, source_keys, unpack_warning
from dondolo.errors import DondoloWarning, InputError

FORMAT = "dondolo run 2"
# The last but one day of the calendar [s since 1970]
_LATEST = 253_402_128_000.0

# What is known of a record, if its header or the catalogue states it
RECORD_FACTS = ("date", "magnitude", "station", "component")


def run_of(table: str) -> tuple[str, str]:
    """The run that a table names, empty if it names none, and what follows that line."""
    lines = table.split("\n", 2)
    if len(lines) < 3 or not lines[0].startswith("# dondolo ") or not lines[1].startswith("# run: "):
        return "", table
    return lines[1].removeprefix("# run: "), lines[2]


def described(name: str, table: str) -> Written:
    """A table as the file of its run lists it."""
    return Written(name, len(table.encode()), f"{zlib.crc32(run_of(table)[1].encode()):08x}")


@dataclass(frozen=True)
class HistoryResult:
    """Result of a time history: what its table of rows does not hold.

    Attributes
    ----------
    record : str
    scale, initial_rotation_rad, initial_velocity_rad_s, edp : float
    collapsed : bool
    impacts : int
    time_of_peak_s : float
    edp_error : float or None
        None if it was not estimated.
    tie_times : tuple of pairs of float
        When each tie first yields and when it breaks, NaN for never; empty for a wall without ties.
    """

    record: str
    scale: float
    initial_rotation_rad: float
    initial_velocity_rad_s: float
    edp: float
    collapsed: bool
    impacts: int
    time_of_peak_s: float
    edp_error: float | None = None
    tie_times: tuple[tuple[float, float], ...] = ()


@dataclass(frozen=True)
class RunFile:
    """Contents of a file ``PREFIX_run.json``; docs/files.md describes its keys.

    Attributes
    ----------
    version : str
        Of the dondolo that ran.
    commit : str
        That it was built from, with '-dirty' behind it if its sources differed; 'unknown' outside a repository.
    references : tuple of str
        Keys of the sources of what the case uses; `dd.cite` has their entries.
    compiler, engine : str
        Compiler of the executable; engines that ran, with the build variant. Empty if unknown.
    real_bits : int
        Bits of a number.
    settings : mapping
        Group -> variable -> value, all in force.
    inputs : tuple of mapping
        Files of the case: role, path, bytes, crc32.
    records : tuple of mapping
        Records of the case: name, event (label of its cluster, '' for none), checksum of its samples, and what is known
        of date, magnitude, station, component and format.
    work : mapping
        Counts of what was computed, by name; empty for a time history.
    history : HistoryResult or None
        None for other tasks.
    notes : tuple of str
        How tables were read.
    warnings : tuple of DondoloWarning
    written : datetime or None
        When the file was written; None for results in memory.
    path : str
        The file, or the case that was run, for messages.
    run : str
        Name of the run, which every table of the set gives; '' for results in memory.
    shape : mapping
        Numbers of walls (rows of the population), levels, damage states and records; Python does not write the last.
    files : tuple of Written
        The tables of the set.
    confidence : float
        Of the intervals in the tables; NaN where Python wrote them, but for designs.
    content : mapping
        All that the file has; empty for results that are in none.
    """

    version: str
    compiler: str = ""
    engine: str = ""
    real_bits: int = 64
    settings: Mapping[str, Mapping[str, Any]] = field(default_factory=dict)
    inputs: tuple[Mapping[str, Any], ...] = ()
    records: tuple[Mapping[str, str], ...] = ()
    work: Mapping[str, int] = field(default_factory=dict)
    history: HistoryResult | None = None
    notes: tuple[str, ...] = ()
    warnings: tuple[DondoloWarning, ...] = ()
    written: datetime | None = None
    path: str = ""
    run: str = ""
    shape: Mapping[str, int] = field(default_factory=dict)
    files: tuple[Written, ...] = ()
    confidence: float = float("nan")
    commit: str = "unknown"
    references: tuple[str, ...] = ()
    content: Mapping[str, Any] = field(default_factory=dict, repr=False)

    def citing(self, *used: str) -> RunFile:
        """The same, with the keys of the sources of what was used, in the words of dondolo_files_references."""
        return replace(self, references=source_keys(dict.fromkeys(used)))

    def setting(self, group: str, name: str, default: Any) -> Any:
        """A variable of a group; `default`, which has the type it must have, if it is not there."""
        try:
            return _member(self.settings.get(group, {}), name, type(default), default)
        except ValueError as error:
            raise InputError(f"{self.path}: settings: {group}: {error}") from error

    @property
    def edp_thresholds(self) -> list[float]:
        """Damage states that the case names [rotation / capacity], if there are several."""
        given = self.setting("stripes", "edp_thresholds", [])
        if len(given) < 2:
            return []
        limit = self.setting("solver", "edp_limit", constants().edp_limit)
        try:
            levels: list[float] = increasing("edp_thresholds", given).tolist()
            if levels[-1] > limit:
                raise argument_error(
                    "out_of_range", "edp_thresholds", f" = {levels[-1]:g}: must be at most edp_limit = {limit:g}"
                )
        except InputError as error:
            raise error.placed(f"{self.path}: settings: stripes") from None
        return levels

    @property
    def begun(self) -> datetime:
        """When the run began, with which its name begins [UTC]."""
        return _begun(self.run)

    def to_json(self) -> str:
        """The text of the file."""
        if self.content:
            files = [file._asdict() for file in self.files]
            return _text_of({**self.content, "run": self.run, "files": files})
        content: dict[str, Any] = {"format": FORMAT, "run": self.run, "version": self.version}
        content["commit"] = constants().commit
        content["references"] = self.references
        content |= {name: getattr(self, name) for name in ("compiler", "engine") if getattr(self, name)}
        content |= {"settings": self.settings, "inputs": self.inputs, "shape": self.shape, "records": self.records}
        content["files"] = [file._asdict() for file in self.files]
        if self.work:
            content["work"] = self.work
        if math.isfinite(self.confidence):
            content["standard_errors"] = {"confidence": self.confidence}
        content |= {"notes": self.notes, "warnings": [one.as_data() for one in self.warnings]}
        return _text_of(content)


def sources_of_measure(im: str) -> tuple[str, str]:
    """Words of an intensity measure among those of dondolo_files_references."""
    return im, im.partition("(")[0]


def sources_of_fits(im: str, walls: Iterable[Any]) -> set[str]:
    """Words of curves that were fitted to the counts of walls at levels of a measure."""
    return {"fit", "clustered", *sources_of_measure(im)}.union(*(wall._sources() for wall in walls))


def _text_of(content: Mapping[str, Any]) -> str:
    return json.dumps(content, indent=2, ensure_ascii=False, allow_nan=False)


def read_run_file(path: str) -> RunFile:
    """Read a file of a run.

    Parameters
    ----------
    path : str
        The file.

    Returns
    -------
    RunFile

    Raises
    ------
    InputError
        It is no file of a run; the key that is wrong is named.
    MissingFileError
        There is none.
    """
    text = read_text(path)
    try:
        written = _date(os.stat(path).st_mtime)
    except OSError as error:
        raise InputError(f"{path}: {error}") from error
    return parse_run_file(text, path, written)


def parse_run_file(text: str, path: str, written: datetime | None = None) -> RunFile:
    """The contents of a file of a run; `path` names it in messages, and results in memory have no date."""
    try:
        content = json.loads(text)
    except (ValueError, RecursionError) as error:
        raise InputError(f"{path}: not JSON: {error}") from error
    if not isinstance(content, dict) or content.get("format") != FORMAT:
        raise InputError(f"{path}: not a run file: format must be '{FORMAT}'")
    try:
        work, history = _member(content, "work", dict, {}), _member(content, "history", dict, {})
        shape = _member(content, "shape", dict)
        return RunFile(
            _member(content, "version", str),
            _member(content, "compiler", str, ""),
            _member(content, "engine", str, ""),
            _member(content, "real_bits", int, 64),
            {group: _settings(content["settings"], group) for group in _member(content, "settings", dict)},
            tuple(_input(one) for one in _all(content, "inputs", dict)),
            tuple(
                {key: _member(one, key, str) for key in ("name", "event", "checksum")}
                | {key: _member(one, key, str) for key in (*RECORD_FACTS, "format") if key in one}
                for one in _all(content, "records", dict)
            ),
            {name: _member(work, name, int) for name in work},
            _history(history) if history else None,
            tuple(_all(content, "notes", str)),
            tuple(_warning(one) for one in _all(content, "warnings", dict)),
            written,
            path,
            _run(content) if written else "",
            {name: _member(shape, name, int) for name in shape},
            tuple(_written(one) for one in _all(content, "files", dict)),
            _member(_member(content, "standard_errors", dict, {}), "confidence", float, float("nan")),
            _member(content, "commit", str, "unknown"),
            tuple(_all(content, "references", str)),
            content,
        )
    except (LookupError, TypeError, ValueError) as error:
        raise InputError(f"{path}: {error}") from error


def _date(seconds: float) -> datetime:
    """Local date and time; clocks of file systems go further than the calendar, which ends in the year 9999."""
    return datetime.fromtimestamp(min(max(seconds, 0.0), _LATEST)).astimezone()


def _run(content: Mapping[str, Any]) -> str:
    """Name of the run, which stands in names of files."""
    run: str = _member(content, "run", str)
    try:
        if RUN_NAME.fullmatch(run) and _begun(run):
            return run
    except ValueError:
        pass
    raise ValueError(f"run = {run!r}: must be a name such as 20260131T235959Z-0123456789abcdef")


def _begun(run: str) -> datetime:
    """The date in the name of a run."""
    return datetime.strptime(run[:16], "%Y%m%dT%H%M%S%z")


def _settings(content: Mapping[str, Any], group: str) -> dict[str, Any]:
    """Variables of a group: words, numbers, flags, and lists of them."""
    values: dict[str, Any] = _member(content, group, dict)
    for name, value in values.items():
        for one in value if isinstance(value, list) else [value]:
            if not isinstance(one, (str, bool, int, float)) or (isinstance(one, float) and not math.isfinite(one)):
                raise ValueError(f"settings: {group}: {name} = {one!r}: must be a word, a flag or a number")
    return values


def _input(content: Mapping[str, Any]) -> dict[str, Any]:
    """An input file; one that was removed during the run has neither size nor checksum."""
    given: dict[str, Any] = {key: _member(content, key, str) for key in ("role", "path")}
    for key, kind in (("bytes", int), ("crc32", str)):
        given[key] = None if content[key] is None else _member(content, key, kind)
    return given


def _warning(content: Mapping[str, Any]) -> DondoloWarning:
    """A warning of the run."""
    for key in ("sentence", "code"):
        _member(content, key, str)
    subject, numbers = _member(content, "subject", dict), _member(content, "numbers", dict)
    for name in subject:
        _member(subject, name, str)
    for name in numbers:
        _member(numbers, name, float)
    return unpack_warning(dict(content))


def _written(content: Mapping[str, Any]) -> Written:
    """A table of the set."""
    return Written(_member(content, "name", str), _member(content, "bytes", int), _member(content, "crc32", str))


def _history(content: Mapping[str, Any]) -> HistoryResult:
    """Result of a time history."""
    kinds = {"record": str, "collapsed": bool, "impacts": int}
    values = {one.name: _member(content, one.name, kinds.get(one.name, float)) for one in fields(HistoryResult)[:-2]}
    error = _member(content, "edp_error", float) if "edp_error" in content else None
    never = float("nan")
    times = [
        (_member(tie, "time_of_yield_s", float, never), _member(tie, "time_of_fracture_s", float, never))
        for tie in _all(content, "ties", dict)
    ]
    return HistoryResult(**values, edp_error=error, tie_times=tuple(times))


def _member(content: Mapping[str, Any], name: str, kind: type, default: Any = None) -> Any:
    """A member of an object, which must be of a type."""
    value = content.get(name, default)
    if kind is float and type(value) is int:
        try:
            value = float(value)
        except OverflowError:
            raise ValueError(f"{name}: must be a number below 1.8e308") from None
    if type(value) is not kind:
        raise ValueError(f"{name} = {value!r}: must be of type {kind.__name__}")
    return value


def _all(content: Mapping[str, Any], name: str, kind: type) -> list[Any]:
    """A list whose elements must be of a type."""
    values: list[Any] = _member(content, name, list, [])
    for value in values:
        if type(value) is not kind:
            raise ValueError(f"{name}: {value!r}: must be of type {kind.__name__}")
    return values
