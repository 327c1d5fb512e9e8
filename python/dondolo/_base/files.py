"""Paths of files, and what is read of them."""

from __future__ import annotations

import codecs
import errno
import os
import re
import stat
import sys
import zlib
from collections.abc import Iterable
from pathlib import Path
from typing import Any

from dondolo._base.arguments import argument_error, shortened
from dondolo.errors import InputError, MissingFileError

#: A name of a run
RUN_NAME = re.compile(r"\d{8}T\d{6}Z-[0-9a-f]{16}")
# What is no regular file
_THINGS = {
    stat.S_IFLNK: "a symbolic link",
    stat.S_IFDIR: "a folder",
    stat.S_IFIFO: "a pipe",
    stat.S_IFSOCK: "a socket",
}


def synchronize(path: Path) -> None:
    """Bring the names of the files of a folder to the disk; Windows lets nobody do so."""
    if sys.platform == "win32":
        return
    descriptor = os.open(path, os.O_RDONLY)
    try:
        os.fsync(descriptor)
    except OSError as error:
        # Some file systems have nothing to synchronize, and say so.
        if error.errno not in (errno.EINVAL, errno.ENOTSUP):
            raise
    finally:
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
        raise argument_error("wrong_type", name, f" = {shortened(path)}: must be the path of a file")
    if suffixes and target.suffix.lower() not in suffixes:
        raise argument_error("out_of_range", name, f" = {os.fspath(path)!r}: must end in {' or '.join(suffixes)}")
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


def as_files(name: str, paths: Any) -> list[str]:
    """One path or a sequence of them, each that of a file.

    Raises
    ------
    InputError
        Anything else.
    """
    several = [paths] if isinstance(paths, (str, os.PathLike)) else paths
    if not isinstance(several, Iterable):
        raise argument_error("wrong_type", name, f" = {paths!r}: must be the path of a file, or a sequence of them")
    return [os.fspath(as_file(name, one)) for one in several]


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
