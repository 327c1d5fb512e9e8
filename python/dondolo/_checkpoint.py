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

from dondolo.errors import DondoloError, InputError
from dondolo.work import Work

# What marks a database as a checkpoint ('ddlo'), and the number of its layout
_APPLICATION = 0x64646C6F
_LAYOUT = 1

_TABLES = """
CREATE TABLE study (what TEXT PRIMARY KEY, value TEXT NOT NULL) WITHOUT ROWID;
CREATE TABLE block (
   first INTEGER PRIMARY KEY, walls INTEGER NOT NULL, work TEXT NOT NULL, flags BLOB NOT NULL, checksum INTEGER NOT NULL
);
CREATE VIEW progress AS
   SELECT complete, of_walls, CASE complete WHEN of_walls THEN 'complete' ELSE 'incomplete' END AS state
   FROM (SELECT (SELECT coalesce(sum(walls), 0) FROM block) AS complete,
                (SELECT CAST(value AS INTEGER) FROM study WHERE what = 'number of walls') AS of_walls);
"""


class Stored(NamedTuple):
    """A finished block."""

    first: int
    walls: int
    work: Work
    flags: bytes


class Checkpoint:
    """The finished blocks of one study in a file.

    Parameters
    ----------
    path : path
        The file; made if there is none.
    study : mapping of str to str
        All that results depend on, by name; 'number of walls' among it.

    Raises
    ------
    InputError
        The file is something else, damaged, or of another study.
    DondoloError
        It cannot be written, or another run is writing it.
    """

    def __init__(self, path: str | os.PathLike[str], study: Mapping[str, str]) -> None:
        if not isinstance(path, (str, os.PathLike)):
            raise InputError(f"checkpoint = {path!r}: must be the path of a file")
        self._name = f"checkpoint = {os.fspath(path)!r}"
        self._walls = int(study["number of walls"])
        self._done = 0
        try:
            # An absolute path, since SQLite gives a meaning of its own to some names
            self._file = sqlite3.connect(os.path.abspath(path), timeout=0.0, isolation_level=None)
        except sqlite3.Error as error:
            raise self._failure(error) from error
        try:
            self._file.execute("PRAGMA locking_mode = EXCLUSIVE")
            self._open(study)
        except sqlite3.Error as error:
            self._file.close()
            raise self._failure(error) from error
        except BaseException:
            self._file.close()
            raise

    def _open(self, study: Mapping[str, str]) -> None:
        ((application,),) = self._file.execute("PRAGMA application_id")
        ((layout,),) = self._file.execute("PRAGMA user_version")
        ((tables,),) = self._file.execute("SELECT count(*) FROM sqlite_master")
        if not tables and not application:
            self._file.executescript(
                f"BEGIN; PRAGMA application_id = {_APPLICATION}; PRAGMA user_version = {_LAYOUT}; {_TABLES}"
            )
            self._file.executemany("INSERT INTO study VALUES (?, ?)", study.items())
            self._file.execute("COMMIT")
            return
        if application != _APPLICATION:
            raise InputError(f"{self._name}: is a database, but no checkpoint of dondolo")
        if layout != _LAYOUT:
            raise InputError(f"{self._name}: was written by another version of dondolo")
        known = dict(self._file.execute("SELECT what, value FROM study"))
        differing = [
            _difference(what, known.get(what, ""), study.get(what, ""))
            for what in dict.fromkeys([*study, *known])
            if known.get(what) != study.get(what)
        ]
        if differing:
            raise InputError(f"{self._name}: belongs to another study: {'; '.join(differing)}")

    def blocks(self) -> Iterator[Stored]:
        """The blocks that are finished, in the order of walls."""
        end = 0
        try:
            for first, walls, work, flags, checksum in self._file.execute(
                "SELECT first, walls, work, flags, checksum FROM block ORDER BY first"
            ):
                fits = end <= first and 1 <= walls <= self._walls - first
                if not fits or _checksum(first, walls, work, flags) != checksum:
                    raise InputError(f"{self._name}: is damaged (the block of wall {first + 1}): delete it")
                end = first + walls
                self._done += walls
                yield Stored(first, walls, Work(*json.loads(work)), flags)
        except sqlite3.Error as error:
            raise self._failure(error) from error

    def claim(self) -> None:
        """Keep other runs from writing the file, until it is closed or this process ends."""
        try:
            # Any change takes the lock, which the exclusive mode then keeps.
            self._file.execute(f"PRAGMA user_version = {_LAYOUT}")
        except sqlite3.Error as error:
            raise self._failure(error) from error

    def keep(self, first: int, walls: int, work: Work, flags: bytes) -> None:
        """Write a finished block."""
        counts = json.dumps(astuple(work))
        row = (first, walls, counts, flags, _checksum(first, walls, counts, flags))
        try:
            self._file.execute("INSERT INTO block VALUES (?, ?, ?, ?, ?)", row)
        except sqlite3.Error as error:
            raise self._failure(error) from error
        self._done += walls

    def __enter__(self) -> Checkpoint:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._file.close()

    def _failure(self, error: sqlite3.Error) -> DondoloError:
        """What a failure of SQLite means to the user."""
        code = getattr(error, "sqlite_errorcode", 0) & 0xFF
        if code in (sqlite3.SQLITE_NOTADB, sqlite3.SQLITE_CORRUPT, sqlite3.SQLITE_FORMAT):
            return InputError(f"{self._name}: is no checkpoint, or damaged ({error})")
        if code in (sqlite3.SQLITE_BUSY, sqlite3.SQLITE_LOCKED):
            return DondoloError(f"{self._name}: is being written by another run")
        kept = f"; it holds {self._done} of {self._walls} walls" if self._done else ""
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


def _checksum(first: int, walls: int, work: str, flags: bytes) -> int:
    return zlib.crc32(flags, zlib.crc32(f"{first} {walls} {work}".encode()))
