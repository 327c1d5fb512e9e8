"""Files that are written: whole or not at all, under the locks of the library, and sets of results."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from dondolo._base.arguments import FloatArray, as_path
from dondolo._base.files import as_file, thing
from dondolo._fortran import _core
from dondolo._fortran.library import check, receive
from dondolo.errors import DondoloError, InputError

#: What the names of the tables of a set end with, of any task
TABLES = tuple(receive(_core.cases.result_tables()).lines)
RUN_FILE = "_run.json"
#: Kinds of columns, as src/study/case/results/columns.f90 has them
TEXT, REAL, INTEGER, DEGREES = range(4)


class Written(NamedTuple):
    """A table of a set.

    Attributes
    ----------
    name : str
        What its file name ends with, such as ``_walls.csv``.
    bytes : int
        Its length.
    crc32 : str
        CRC-32 of what follows the line that names the run: the same for the same results.
    """

    name: str
    bytes: int
    crc32: str


class Column(NamedTuple):
    """A column of a table: its kind, and its texts, or its numbers with NaN where a cell is empty."""

    kind: int
    values: Sequence[str] | FloatArray


@contextmanager
def whole_file(path: Any) -> Iterator[Path]:
    """A file that appears whole or not at all: gives the part to write, which then takes the file's place.

    The part has a name that no other process gives a file, `FILE.RUN.new`; of two that write one file, the later one
    stays. It is locked while it is written, so that the parts of killed processes are known, and removed when the file
    is written again.

    Parameters
    ----------
    path : path
        The file; its folder must exist.

    Yields
    ------
    Path
        An empty file beside the file, gone at the end whatever happens.

    Raises
    ------
    InputError
        No path, or that of a symbolic link, a folder, a pipe or a device.
    DondoloError
        The file cannot be written.
    """
    target = as_file("path", path)
    if what := thing(target, follow_symlinks=False):
        raise InputError(f"{target}: cannot be written: is {what}")
    handle, run, failure = _core.files.begin_file(as_path(target))
    check(failure)
    try:
        yield target.with_name(f"{target.name}.{run.decode()}.new")
        check(_core.files.publish_file(handle))
    except OSError as error:
        raise DondoloError(f"{target}: cannot be written: {error.strerror}") from error
    finally:
        _core.files.close_files(handle)


@contextmanager
def locked(path: Path) -> Iterator[bool]:
    """Hold the lock of a file, so that one process at a time writes it.

    Parameters
    ----------
    path : Path
        The file; its folder must exist.

    Yields
    ------
    bool
        Whether a process was killed while it had the lock.

    Raises
    ------
    InputError
        Another process has the lock, or its file is something else.
    DondoloError
        The lock cannot be written.
    """
    handle, was_killed, failure = _core.files.take_lock(as_path(path))
    check(failure)
    try:
        yield bool(was_killed)
    finally:
        _core.files.close_files(handle)


class ResultSet:
    """A set of files in the making.

    Attributes
    ----------
    run : str
        Name of the run.
    written : list of Written
        The tables so far.
    """

    def __init__(self, handle: int, run: str) -> None:
        self.run = run
        self.written: list[Written] = []
        self._handle = handle

    def write(
        self, name: str, columns: Mapping[str, Column], comments: Sequence[str] = (), *, spreadsheet_safe: bool = False
    ) -> None:
        """Write a table under its name before it is published; `name` is what its name ends with."""
        words: dict[str, int] = {}
        numbers = [
            [words.setdefault(text, len(words) + 1) for text in column.values] if column.kind == TEXT else column.values
            for column in columns.values()
        ]
        size, checksum, failure = _core.files.write_table(
            self._handle,
            name.encode(),
            _lines(comments),
            _lines(columns),
            np.array([column.kind for column in columns.values()], dtype=np.int32),
            np.array(numbers, dtype=np.float64).T,
            _lines(words),
            int(spreadsheet_safe),
        )
        check(failure)
        self.written.append(Written(name, int(size), checksum.decode()))

    def publish(self, text: str) -> None:
        """Publish the set at once; `text` is the file of its run."""
        check(_core.files.publish_set(self._handle, text.encode()))


@contextmanager
def result_set(prefix: Path) -> Iterator[ResultSet]:
    """Write a set of files that is then published at once, under the lock of its prefix.

    Parameters
    ----------
    prefix : Path
        What their names begin with; folders are made.

    Yields
    ------
    ResultSet
        What is not published at the end is removed.

    Raises
    ------
    InputError
        Another run has the lock, or its file is something else; the name of a file is that of one that dondolo has not
        written.
    DondoloError
        The files cannot be written.
    """
    handle, run, failure = _core.files.begin_set(as_path(prefix))
    check(failure)
    try:
        yield ResultSet(handle, run.decode())
    finally:
        _core.files.close_files(handle)


def published_run(prefix: str | os.PathLike[str]) -> str:
    """Name of the run whose results are published; empty if there is none."""
    return str(_core.files.published_run(as_path(prefix)).decode().strip())


def _lines(texts: Any) -> bytes:
    """Texts, a line each."""
    return b"".join(text.encode() + b"\n" for text in texts)
