"""Whose files are: dondolo replaces what it has written itself, and nothing else (base/system/origin.f90)."""

from __future__ import annotations

import os

from dondolo._base.arguments import as_path
from dondolo._fortran import _core
from dondolo._fortran.library import check, receive


def check_replaced(path: str | os.PathLike[str], kind: str) -> None:
    """Check that a file may be replaced: only one of its kind is, so that a slip of the pen costs nothing.

    Parameters
    ----------
    path : path
        The file.
    kind : str
        What will take its place: 'report', 'workbook', 'figure', 'film', 'model', 'table', 'run', 'result', 'records'
        (a catalogue that `RecordSet.to_catalogue` wrote) or 'catalogue' (one that was made of a folder).

    Raises
    ------
    InputError
        Something else is there: another file, a symbolic link, a folder, a pipe, a device.
    """
    check(_core.origins.check_replaced(as_path(path), kind.encode()))


def derived_mark(kind: str, run: str) -> str:
    """The mark that a file made of the results of a run has in its metadata, by which it may be replaced.

    Parameters
    ----------
    kind : str
        'report', 'workbook', 'figure', 'film' or 'model'.
    run : str
        Name of the run; empty for results that are in no files.
    """
    return str(_core.origins.derived_mark(kind.encode(), run.encode()).decode().rstrip())


def replaced(prefix: str | os.PathLike[str]) -> list[str]:
    """Whose results with a prefix a run would replace: one sentence, or none."""
    return receive(_core.origins.replaced(as_path(prefix))).lines


def outdated(prefix: str | os.PathLike[str]) -> list[str]:
    """What was made of other results than those with a prefix: a sentence for each file."""
    return receive(_core.origins.outdated(as_path(prefix))).lines
