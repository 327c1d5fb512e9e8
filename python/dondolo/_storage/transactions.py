"""Sets of files that are published at once, under the lock of their prefix, as the executable does it.

``case/results/result_files.f90`` states the steps and why they are safe; names, lock file and order are the same here.
"""

from __future__ import annotations

import fcntl
import os
import re
import stat
import time
import zlib
from collections.abc import Iterable, Iterator
from contextlib import contextmanager, suppress
from datetime import UTC, datetime
from pathlib import Path
from typing import NamedTuple

from dondolo._base.files import create, new_run, release, synchronize, thing
from dondolo._fortran import _core
from dondolo._fortran.library import receive, warn
from dondolo._fortran.origins import check_replaced, outdated, replaced
from dondolo.errors import DondoloError, DondoloWarning, InputError

# What the names of the files of a set end with, of any task
TABLES = tuple(receive(_core.cases.result_tables()).lines)
RUN_FILE = "_run.json"
_LOCK_MARK, _TABLE_MARK = "dondolo lock", "# dondolo "
# How often, and after how many seconds, a lock is tried again: who only looks at it has it for a moment
_TRIES, _PAUSE = 5, 0.02


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


def staged(path: Path, run: str) -> Path:
    """Where a file stands before it is published."""
    return path.with_name(f"{path.name}.{run}.part")


def run_of(table: str) -> tuple[str, str]:
    """The run that a table names, empty if it names none, and what follows that line."""
    lines = table.split("\n", 2)
    if len(lines) < 3 or not lines[0].startswith(_TABLE_MARK) or not lines[1].startswith("# run: "):
        return "", table
    return lines[1].removeprefix("# run: "), lines[2]


def described(name: str, table: str) -> Written:
    """A table as the file of its run lists it."""
    return Written(name, len(table.encode()), f"{zlib.crc32(run_of(table)[1].encode()):08x}")


class Publication:
    """A set of files in the making.

    Parameters
    ----------
    prefix : Path
        What their names begin with.
    run : str
        Name of the run.
    """

    def __init__(self, prefix: Path, run: str) -> None:
        self.run = run
        self.written: list[Written] = []
        self._prefix = prefix

    def write(self, name: str, lines: Iterable[str]) -> None:
        """Write a file under its name before it is published; `name` is what its name ends with."""
        path = _end(self._prefix, name)
        check_replaced(path, _kind(name))
        text = "".join(f"{line}\n" for line in lines)
        try:
            os.close(create(staged(path, self.run)))
            staged(path, self.run).write_text(text, encoding="utf-8")
            synchronize(staged(path, self.run))
        except OSError as error:
            raise DondoloError(f"{path}: cannot be written: {error.strerror}") from error
        self.written.append(described(name, text))

    def publish(self) -> None:
        """Publish what was written, the file of the run among it."""
        paths = [_end(self._prefix, file.name) for file in self.written]
        paths.sort(key=lambda path: not path.name.endswith(RUN_FILE))
        for path in paths:
            check_replaced(path, _kind(path.name))
        for path in paths:
            try:
                staged(path, self.run).replace(path)
                if path in (paths[0], paths[-1]):
                    synchronize(path.parent)
            except OSError as error:
                raise DondoloError(f"{path}: cannot be replaced: {error.strerror}") from error
        for name in TABLES:
            if _end(self._prefix, name) not in paths:
                _remove_old(_end(self._prefix, name))

    def close(self) -> bool:
        """Remove what was not published; is there nothing left for the next run to rename or to remove?"""
        parts = [staged(_end(self._prefix, name), self.run) for name in (*TABLES, RUN_FILE)]
        if published_run(self._prefix) == self.run:
            return not any(part.exists() for part in parts)
        for part in parts:
            with suppress(OSError):
                part.unlink(missing_ok=True)
        return not any(part.exists() for part in parts)


@contextmanager
def publishing(prefix: Path) -> Iterator[Publication]:
    """Write a set of files that is then published at once, under the lock of its prefix.

    Parameters
    ----------
    prefix : Path
        What their names begin with; the folder must exist.

    Yields
    ------
    Publication
        What is not published at the end is removed.

    Raises
    ------
    InputError
        Another run has the lock, or its file is something else; the name of a file is that of one that dondolo has not
        written.
    DondoloError
        The files cannot be written.
    """
    check_replaced(_end(prefix, RUN_FILE), _kind(RUN_FILE))
    notes = replaced(prefix)
    with _locked(prefix) as (lock, killed):
        publication = Publication(prefix, lock.run)
        _end_publishing(prefix, killed)
        lock.sign()
        try:
            yield publication
        finally:
            lock.is_needed = not publication.close()
    for code, sentences in (("results_replaced", notes), ("out_of_date", outdated(prefix))):
        warn(DondoloWarning(sentence, code, {"results": str(prefix)}) for sentence in sentences)


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
    with _locked(path) as (lock, killed):
        lock.sign()
        yield bool(killed)


class _Lock:
    """A lock that this process has.

    Attributes
    ----------
    run : str
        Name of the run that has it.
    is_needed : bool
        Whether its file stays, for the next run to end what this one could not.
    """

    def __init__(self, path: Path, descriptor: int) -> None:
        self.run, self.is_needed = new_run(), False
        self._path, self._descriptor = path, descriptor

    def sign(self) -> None:
        """Say in its file who has it."""
        since = f"{datetime.now(UTC):%Y-%m-%dT%H:%M:%SZ}"
        host = f"pid {os.getpid()}\nhost {os.uname().nodename}"
        text = f"{_LOCK_MARK}\nrun {self.run}\n{host}\nsince {since}\n".encode()
        try:
            os.pwrite(self._descriptor, text, 0)
            os.ftruncate(self._descriptor, len(text))
        except OSError as error:
            raise DondoloError(f"{self._path}: cannot be written: {error.strerror}") from error


@contextmanager
def _locked(what: Path) -> Iterator[tuple[_Lock, str]]:
    """Take the lock of a path: gives it, and the name of a run that was killed while it had it."""
    path = _end(what, ".lock")
    try:
        descriptor, said = _take(path)
    except BlockingIOError as error:
        raise InputError(f"{what}: is being written by another run{_holder(str(error))}") from None
    except OSError as error:
        raise DondoloError(f"{path}: cannot be written: {error.strerror}") from error
    lock = _Lock(path, descriptor)
    try:
        yield lock, _said(said, "run")
    finally:
        # Removed while it is held: who waits for it sees that the file is gone, and makes another. One that cannot be
        # removed is no lock any more.
        if not lock.is_needed:
            with suppress(OSError):
                path.unlink(missing_ok=True)
        # A process that was forked meanwhile does not keep it.
        with suppress(OSError):
            fcntl.flock(descriptor, fcntl.LOCK_UN)
        release(descriptor)


def published_run(prefix: Path) -> str:
    """Name of the run whose results are published; empty if there is none."""
    path = _end(prefix, RUN_FILE)
    if thing(path, follow_symlinks=True):
        return ""
    try:
        with path.open("rb") as file:
            found = re.search(rb'"run": "([0-9a-fTZ-]+)"', file.read(200))
    except OSError:
        return ""
    return found[1].decode() if found else ""


def _end_publishing(prefix: Path, killed: str) -> None:
    """Rename tables of the published set that have not their names yet; remove what a killed run has not published."""
    published = published_run(prefix)
    for name in (*TABLES, RUN_FILE):
        path = _end(prefix, name)
        with suppress(InputError, OSError):
            if published:
                check_replaced(path, _kind(name))
                staged(path, published).replace(path)
        if killed and killed != published:
            with suppress(OSError):
                staged(path, killed).unlink(missing_ok=True)


def _end(prefix: Path, name: str) -> Path:
    return prefix.with_name(prefix.name + name)


def _take(lock: Path) -> tuple[int, str]:
    """Descriptor of a lock file that this process has now, and what the file says, which else is a BlockingIOError."""
    if what := thing(lock, follow_symlinks=False):
        raise InputError(f"{lock}: is {what}, not a regular file")
    flags = os.O_RDWR | os.O_CREAT | os.O_NOFOLLOW | os.O_NONBLOCK | os.O_CLOEXEC
    tries, said = 0, ""
    while tries < _TRIES:
        # The sticky bit tells a lock that is still empty from an empty file of the user's.
        descriptor = os.open(lock, flags, 0o666 | stat.S_ISVTX)
        try:
            said = os.pread(descriptor, 500, 0).decode(errors="replace")
            fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except BlockingIOError:
            os.close(descriptor)
            time.sleep(_PAUSE)
            tries += 1
            continue
        except OSError:
            # A file system without locks refuses none.
            pass
        ours = os.fstat(descriptor)
        # Who had it before has removed the file, unless it is still the one of this name.
        with suppress(FileNotFoundError):
            if stat.S_ISREG(ours.st_mode) and os.path.samestat(ours, os.lstat(lock)):
                said = os.pread(descriptor, 500, 0).decode(errors="replace")
                if said.startswith(_LOCK_MARK) or (not said and ours.st_mode & stat.S_ISVTX):
                    return descriptor, said
                os.close(descriptor)
                raise InputError(f"{lock}: exists, and is no lock of dondolo")
        os.close(descriptor)
        if not stat.S_ISREG(ours.st_mode):
            raise OSError(0, "is no file")
    raise BlockingIOError(said)


def _said(text: str, name: str) -> str:
    """What a lock file says."""
    found = re.search(rf"^{name} ([\w.:-]+)$", text, re.MULTILINE)
    return found[1] if found else ""


def _holder(text: str) -> str:
    """Who has a lock, in parentheses."""
    if not _said(text, "pid"):
        return ""
    return f" (process {_said(text, 'pid')} on {_said(text, 'host')} since {_said(text, 'since')})"


def _remove_old(path: Path) -> None:
    """Remove a table that an earlier run has left and the set does not replace; another file stays."""
    with suppress(InputError, OSError):
        check_replaced(path, "table")
        path.unlink(missing_ok=True)


def _kind(name: str) -> str:
    """What kind of file a result is, by the end of its name."""
    return "run" if name.endswith(RUN_FILE) else "table"
