"""Files that are written: their paths, whole or not at all, and none that holds something else."""

from __future__ import annotations

import codecs
import errno
import fcntl
import os
import re
import zlib
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import Any

from dondolo._base.transactions import RUN_NAME, create, new_run, release, synchronize
from dondolo.errors import DondoloError, InputError, MissingFileError

# How often a part is made that another process takes for a dead one
_TRIES = 5


def as_file(name: str, path: Any, *suffixes: str) -> Path:
    """Turn what a user gives for the path of a file into one; its name must end in one of the suffixes, if any."""
    try:
        target = Path(path)
        named = bool(target.name) and not os.fspath(path).endswith(os.sep)
        valid = named and b"\0" not in os.fsencode(target)
    except (TypeError, UnicodeEncodeError):
        valid = False
    if not valid:
        raise InputError(f"{name} = {path!r}: must be the path of a file")
    if suffixes and target.suffix.lower() not in suffixes:
        raise InputError(f"{name} = {os.fspath(path)!r}: must end in {' or '.join(suffixes)}")
    return target


def read_text(path: str | os.PathLike[str]) -> str:
    """The text of a file: UTF-8, or UTF-16 with a byte order mark, as the readers in Fortran take them.

    Raises
    ------
    InputError
        It cannot be read, or is no text.
    MissingFileError
        There is none.
    """
    try:
        content = Path(path).read_bytes()
    except FileNotFoundError as error:
        raise MissingFileError(f"{path}: cannot be read: {error.strerror}") from error
    except OSError as error:
        raise InputError(f"{path}: cannot be read: {error.strerror}") from error
    utf16 = content.startswith((codecs.BOM_UTF16_LE, codecs.BOM_UTF16_BE))
    try:
        return content.decode("utf-16" if utf16 else "utf-8-sig")
    except UnicodeDecodeError as error:
        begin = content.rfind(b"\n", 0, error.start) + 1
        number = content.count(b"\n", 0, begin) + 1
        place = f"line {number}: byte {error.start - begin + 1}"
        raise InputError(f"{path}: {place} is not {error.encoding.upper()}: save it as UTF-8") from None


def described(path: str | os.PathLike[str]) -> str:
    """A file that was read, as results tell their source: its path and the checksum of its bytes."""
    target = Path(path)
    # A pipe has been read, and gives nothing any more
    if not target.is_file():
        return str(target)
    return f"{target} (CRC-32 {zlib.crc32(target.read_bytes()):08x})"


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
        No path.
    DondoloError
        The file cannot be written.
    """
    target = as_file("path", path)
    _remove_dead_parts(target)
    part, lock = target, None
    try:
        part, lock = _new_part(target)
        yield part
        synchronize(part)
        part.replace(target)
    except OSError as error:
        raise DondoloError(f"{target}: cannot be written: {error.strerror}") from error
    finally:
        # What is in the way of this is in the way of writing, too, and has been said.
        if lock is not None:
            with suppress(OSError):
                part.unlink()
            release(lock)


def _new_part(target: Path) -> tuple[Path, int]:
    """A new part of a file, and the descriptor of its lock."""
    for _ in range(_TRIES):
        part = target.with_name(f"{target.name}.{new_run()}.new")
        descriptor = create(part)
        # A file system without locks refuses none.
        with suppress(OSError):
            fcntl.flock(descriptor, fcntl.LOCK_EX)
        # Who found it before it was locked has removed it.
        if part.exists():
            return part, descriptor
        release(descriptor)
    raise OSError(errno.EBUSY, os.strerror(errno.EBUSY))


def _remove_dead_parts(target: Path) -> None:
    """Remove the parts of a file that nobody writes any more."""
    named = re.compile(rf"{re.escape(target.name)}\.{RUN_NAME.pattern}\.new")
    with suppress(OSError):
        for name in filter(named.fullmatch, os.listdir(target.parent)):
            part = target.with_name(name)
            descriptor = os.open(part, os.O_RDONLY | os.O_NOFOLLOW | os.O_NONBLOCK | os.O_CLOEXEC)
            with suppress(OSError):
                fcntl.flock(descriptor, fcntl.LOCK_EX | fcntl.LOCK_NB)
                part.unlink()
            os.close(descriptor)


def check_replaced(path: Any, mark: str, kind: str) -> None:
    """May a file be replaced? Only one of its kind: a slip of the pen must not cost results.

    Parameters
    ----------
    path : path
        The file.
    mark : str
        What is near the beginning or the end of every file of the kind.
    kind : str
        What it is, for the message.
    """
    target = as_file("path", path)
    try:
        with target.open("rb") as file:
            ends = file.read(500)
            file.seek(max(target.stat().st_size - 500, 0))
            ends += file.read(500)
    except FileNotFoundError:
        return
    except OSError as error:
        raise DondoloError(f"{target}: cannot be written: {error.strerror}") from error
    if mark.encode() not in ends:
        raise InputError(f"{target}: exists, and is no {kind} of dondolo")
