"""Checkpoints: the finished blocks of a long run in one file, which survives whatever ends the run.

The file is a database of SQLite: a block is one transaction, so it is there whole or not at all. The journal is the
default one, since the faster write-ahead log does not work on the network file systems of clusters.
"""

from __future__ import annotations

import hashlib
import json
import os
import sqlite3
import zlib
from collections.abc import Iterator, Mapping
from dataclasses import astuple
from types import TracebackType
from typing import NamedTuple

from dondolo._base.files import as_file
from dondolo.analysis.work import Work
from dondolo.errors import DondoloError, InputError

# What marks a database as a checkpoint ('ddlo'), and the number of its layout
_APPLICATION = 0x64646C6F
_LAYOUT = 2
# How long another run may hold the file while it opens it, or a reader while it is written [ms]
_OPENING, _WRITING = 1000, 60000

_TABLES = (
    "CREATE TABLE study (what TEXT PRIMARY KEY, value TEXT NOT NULL) WITHOUT ROWID",
    """
CREATE TABLE block (
   first INTEGER PRIMARY KEY, rows INTEGER NOT NULL, work TEXT NOT NULL, flags BLOB NOT NULL, checksum INTEGER NOT NULL
)""",
    """
CREATE VIEW progress AS
   SELECT complete, of_rows, CASE complete WHEN of_rows THEN 'complete' ELSE 'incomplete' END AS state
   FROM (SELECT (SELECT coalesce(sum(rows), 0) FROM block) AS complete,
                (SELECT CAST(value AS INTEGER) FROM study WHERE what = 'number of rows') AS of_rows)""",
    f"PRAGMA application_id = {_APPLICATION}",
    f"PRAGMA user_version = {_LAYOUT}",
)


class Stored(NamedTuple):
    """A finished block; a row is one mechanism of one wall."""

    first: int
    rows: int
    work: Work
    flags: bytes


class Checkpoint:
    """The finished blocks of one study in a file.

    The file is this run's from the beginning, before it is read, if no other run has it: who reads first and takes the
    lock later may find that another one, which reads too, keeps it from that. A file that cannot be had can be read.

    Parameters
    ----------
    path : path
        The file; made if there is none.
    study : mapping of str to str
        All that results depend on, by name; 'number of rows' among it.

    Raises
    ------
    InputError
        The file is something else, damaged, or of another study.
    DondoloError
        It cannot be written, or another run is writing it.
    """

    def __init__(self, path: str | os.PathLike[str], study: Mapping[str, str]) -> None:
        target = as_file("checkpoint", path)
        self._name = f"checkpoint = {str(target)!r}"
        self._rows = int(study["number of rows"])
        self._done = 0
        self._refusal: sqlite3.Error | None = None
        try:
            # An absolute path, since SQLite gives a meaning of its own to some names
            self._file = sqlite3.connect(os.path.abspath(target), isolation_level=None)
        except sqlite3.Error as error:
            raise self._failure(error) from error
        try:
            self._file.execute(f"PRAGMA busy_timeout = {_OPENING}")
            self._open(study)
            self._take()
        except (sqlite3.Error, UnicodeDecodeError) as error:
            self._file.close()
            raise self._failure(error) from error
        except BaseException:
            self._file.close()
            raise

    def _take(self) -> None:
        """Take the lock of who will write, while others can read; a refusal is kept for who wants to write."""
        try:
            self._file.execute("BEGIN IMMEDIATE")
        except sqlite3.OperationalError as error:
            self._refusal = error
        else:
            # Locks are not given back from now on, not after a block either.
            self._file.execute("PRAGMA locking_mode = EXCLUSIVE")

    def _open(self, study: Mapping[str, str]) -> None:
        if not self._is_used():
            # Of two runs that begin together one makes the tables.
            self._file.execute("BEGIN IMMEDIATE")
            if not self._is_used():
                for statement in _TABLES:
                    self._file.execute(statement)
                self._file.executemany("INSERT INTO study VALUES (?, ?)", study.items())
            self._file.execute("COMMIT")
        ((application,),) = self._file.execute("PRAGMA application_id")
        ((layout,),) = self._file.execute("PRAGMA user_version")
        if application != _APPLICATION:
            raise InputError(f"{self._name}: is a database, but no checkpoint of dondolo")
        if layout != _LAYOUT:
            raise InputError(f"{self._name}: was written by another version of dondolo")
        known = {str(what): str(value) for what, value in self._file.execute("SELECT what, value FROM study")}
        differing = [
            _difference(what, known.get(what, ""), study.get(what, ""))
            for what in dict.fromkeys([*study, *known])
            if known.get(what) != study.get(what)
        ]
        if differing:
            raise InputError(f"{self._name}: belongs to another study: {'; '.join(differing)}")

    def _is_used(self) -> bool:
        """Does anything stand in the file?"""
        ((application,),) = self._file.execute("PRAGMA application_id")
        ((tables,),) = self._file.execute("SELECT count(*) FROM sqlite_master")
        return bool(tables or application)

    def blocks(self) -> Iterator[Stored]:
        """The blocks that are finished, in the order of rows."""
        end = 0
        try:
            for first, rows, work, flags, checksum in self._file.execute(
                "SELECT first, rows, work, flags, checksum FROM block ORDER BY first"
            ):
                # SQLite keeps a value of any type in any column.
                typed = all(map(isinstance, (first, rows, work, flags), (int, int, str, bytes)))
                fits = typed and end <= first and 1 <= rows <= self._rows - first
                if not fits or _checksum(first, rows, work, flags) != checksum:
                    row = first + 1 if isinstance(first, int) else "?"
                    raise InputError(f"{self._name}: is damaged (the block of row {row}): delete it")
                end = first + rows
                self._done += rows
                yield Stored(first, rows, Work(*json.loads(work)), flags)
        except (sqlite3.Error, UnicodeDecodeError) as error:
            raise self._failure(error) from error

    def claim(self) -> None:
        """Keep other runs from reading and writing the file, until it is closed or this process ends."""
        if self._refusal is not None:
            raise self._failure(self._refusal) from self._refusal
        try:
            # Others may be reading it at this moment.
            self._file.execute(f"PRAGMA busy_timeout = {_WRITING}")
            # Any change takes the lock, which the exclusive mode then keeps.
            self._file.execute(f"PRAGMA user_version = {_LAYOUT}")
            self._file.execute("COMMIT")
        except sqlite3.Error as error:
            raise self._failure(error) from error

    def keep(self, first: int, rows: int, work: Work, flags: bytes) -> None:
        """Write a finished block."""
        counts = json.dumps(astuple(work))
        block = (first, rows, counts, flags, _checksum(first, rows, counts, flags))
        try:
            self._file.execute("INSERT INTO block VALUES (?, ?, ?, ?, ?)", block)
        except sqlite3.Error as error:
            raise self._failure(error) from error
        self._done += rows

    def __enter__(self) -> Checkpoint:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._file.close()

    def _failure(self, error: sqlite3.Error | UnicodeDecodeError) -> DondoloError:
        """What a failure of SQLite means to the user; what it cannot decode, or does not understand, is damaged."""
        code = getattr(error, "sqlite_errorcode", sqlite3.SQLITE_ERROR) & 0xFF
        if code in (sqlite3.SQLITE_ERROR, sqlite3.SQLITE_NOTADB, sqlite3.SQLITE_CORRUPT, sqlite3.SQLITE_FORMAT):
            return InputError(f"{self._name}: is no checkpoint, or damaged ({error})")
        if code in (sqlite3.SQLITE_BUSY, sqlite3.SQLITE_LOCKED):
            return DondoloError(f"{self._name}: is being written by another run")
        kept = f"; it holds {self._done} of {self._rows} rows" if self._done else ""
        return DondoloError(f"{self._name}: cannot be written: {error}{kept}")


def digest(*contents: bytes) -> str:
    """SHA-256 of some contents, each told from the next."""
    total = hashlib.sha256()
    for content in contents:
        total.update(len(content).to_bytes(8, "little"))
        total.update(content)
    return total.hexdigest()


def _difference(what: str, there: str, here: str) -> str:
    """What differs; a digest says nothing to a reader."""
    if max(len(there), len(here)) >= len(digest()) or "" in (there, here):
        return f"other {what}"
    return f"{what} {there} there, {here} here"


def _checksum(first: int, rows: int, work: str, flags: bytes) -> int:
    return zlib.crc32(flags, zlib.crc32(f"{first} {rows} {work}".encode()))
