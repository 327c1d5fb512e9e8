"""Files that are written: their paths, whole or not at all, and none that holds something else."""

from __future__ import annotations

import codecs
import errno
import fcntl
import os
import re
import stat
import zlib
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

from dondolo.errors import DondoloError, InputError, MissingFileError

#: A name of a run
RUN_NAME = re.compile(r"\d{8}T\d{6}Z-[0-9a-f]{16}")
# How often a part is made that another process takes for a dead one
_TRIES = 5
# What is no regular file
_THINGS = {
    stat.S_IFLNK: "a symbolic link",
    stat.S_IFDIR: "a folder",
    stat.S_IFIFO: "a pipe",
    stat.S_IFSOCK: "a socket",
}


def new_run() -> str:
    """A name for a run that no other has: time (UTC) and 64 random bits."""
    return f"{datetime.now(UTC):%Y%m%dT%H%M%SZ}-{os.urandom(8).hex()}"


def create(path: Path) -> int:
    """Make an empty file, and give its descriptor; one that exists is not touched, and no link followed."""
    return os.open(path, os.O_WRONLY | os.O_CREAT | os.O_EXCL | os.O_NOFOLLOW | os.O_CLOEXEC, 0o666)


def synchronize(path: Path) -> None:
    """Bring a file, or the names of the files of a folder, to the disk."""
    descriptor = os.open(path, os.O_RDONLY)
    try:
        os.fsync(descriptor)
    except OSError as error:
        # Some file systems have nothing to synchronize, and say so.
        if error.errno not in (errno.EINVAL, errno.ENOTSUP):
            raise
    finally:
        os.close(descriptor)


def release(descriptor: int) -> None:
    """Close a lock; whatever the system says, nothing was written through it that could be lost."""
    with suppress(OSError):
        os.close(descriptor)


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


def thing(path: str | os.PathLike[str], *, follow_symlinks: bool) -> str:
    """What is at a path: '' for nothing or a regular file, else words such as 'a pipe'."""
    try:
        mode = (os.stat(path) if follow_symlinks else os.lstat(path)).st_mode
    except (OSError, ValueError):
        return ""
    return "" if stat.S_ISREG(mode) else _THINGS.get(stat.S_IFMT(mode), "a device")


def check_regular(path: str | os.PathLike[str]) -> None:
    """Refuse to read what is no regular file: a pipe would be waited for, and a device has no end.

    Who reads a folder is told so by the system.
    """
    what = thing(path, follow_symlinks=True)
    if what and what != _THINGS[stat.S_IFDIR]:
        raise InputError(f"{os.fspath(path)}: is {what}, not a regular file")


def read_bytes(path: str | os.PathLike[str]) -> bytes:
    """The bytes of a regular file.

    Raises
    ------
    InputError
        It cannot be read, or is something else.
    MissingFileError
        There is none.
    """
    check_regular(path)
    try:
        return Path(path).read_bytes()
    except FileNotFoundError as error:
        raise MissingFileError(f"{path}: cannot be read: {error.strerror}") from error
    except OSError as error:
        raise InputError(f"{path}: cannot be read: {error.strerror}") from error


def read_text(path: str | os.PathLike[str]) -> str:
    """The text of a file: UTF-8, or UTF-16 with a byte order mark, as the readers in Fortran take them.

    Raises
    ------
    InputError
        It cannot be read, or is no text.
    MissingFileError
        There is none.
    """
    content = read_bytes(path)
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
    return f"{Path(path)} (CRC-32 {zlib.crc32(read_bytes(path)):08x})"


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
