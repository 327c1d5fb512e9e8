"""Tables: the executable's CSV files, column by column and digit by digit, and pandas where it is installed."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable, Mapping, Sequence
from typing import Any

import numpy as np

from dondolo._base.arguments import as_flag, one_of
from dondolo._base.shown import Shown
from dondolo._fortran.files import whole_file
from dondolo._fortran.library import constants
from dondolo.errors import DondoloError

# Columns of equal length, arrays or lists
Table = dict[str, Any]


def digits(value: float) -> str:
    """A number with 17 significant digits, as the executable writes it."""
    return f"{value:.16E}"


def shortest(value: float) -> str:
    """A number with as few digits as tell it from all others: for tables that people read and change."""
    return repr(float(value)).removesuffix(".0")


# What a spreadsheet takes for the beginning of a formula
_FORMULA = ("=", "+", "-", "@")


def cell(value: Any, number: Callable[[float], str] = digits, spreadsheet_safe: bool = False) -> str:
    """A value as it stands in a table: flags 0/1, empty where there is none."""
    if value is None:
        return ""
    if isinstance(value, str):
        return quoted(guarded(value, spreadsheet_safe))
    if isinstance(value, (bool, np.bool_)):
        return str(int(value))
    if isinstance(value, (int, np.integer)):
        return str(value)
    return "" if np.isnan(value) else number(value)


def quoted(text: str) -> str:
    """A text as a cell: in quotes where RFC 4180 asks for them, or where a # or blanks would be lost."""
    if any(character in text for character in ',"#\n\r') or text != text.strip():
        return '"' + text.replace('"', '""') + '"'
    return text


def guarded(text: str, spreadsheet_safe: bool) -> str:
    """A text with an apostrophe where a spreadsheet would take it for a formula, or where it seems to have one already.

    `unguarded` takes it away, as src/study/files/csv_row.f90 does.
    """
    is_formula = spreadsheet_safe and text.startswith(_FORMULA)
    return f"'{text}" if is_formula or unguarded(text) != text else text


def unguarded(text: str) -> str:
    """A text that was read, without the apostrophe that guards it."""
    return text[1:] if text.startswith("'") and text[1:].startswith((*_FORMULA, "'")) else text


def write_csv(
    path: str | os.PathLike[str], table: Table, comments: Iterable[str] = (), spreadsheet_safe: bool = False
) -> None:
    """Write a table; it appears whole or not at all.

    Parameters
    ----------
    path : path
        The file; its folder must exist.
    table : dict
        Columns of equal length.
    comments : iterable of str
        Lines for the head of the file.
    spreadsheet_safe : bool
        Guard strings that a spreadsheet would read as formulas.
    """
    write_lines(path, result_lines(table, comments, spreadsheet_safe))


def result_lines(table: Table, comments: Iterable[str], spreadsheet_safe: bool = False) -> list[str]:
    """Lines of a table of results; the first names dondolo."""
    head = [f"dondolo {constants().version}", *comments]
    return csv_lines(table, head, spreadsheet_safe=spreadsheet_safe)


def csv_lines(
    table: Table,
    comments: Iterable[str],
    number: Callable[[float], str] = digits,
    spreadsheet_safe: bool = False,
) -> list[str]:
    """Lines of a table: comments, names of the columns, rows."""
    as_flag("spreadsheet_safe", spreadsheet_safe)
    lines = [*(f"# {comment}" for comment in comments), ",".join(map(quoted, table))]
    rows = zip(*table.values(), strict=True)
    return lines + [",".join(cell(value, number, spreadsheet_safe) for value in row) for row in rows]


def write_lines(path: str | os.PathLike[str], lines: Sequence[str]) -> None:
    """Write a text file; it appears whole or not at all."""
    with whole_file(path) as part:
        part.write_text("\n".join(lines) + "\n", encoding="utf-8", newline="\n")


def frame(table: Table) -> Any:
    """A table as a pandas DataFrame."""
    try:
        import pandas as pd
    except ImportError:
        raise DondoloError("pandas is not installed: pip install pandas; CSV files need no pandas") from None
    return pd.DataFrame(table)


def choose(tables: Mapping[Any, Any], name: str) -> Table:
    """One of several tables of an object, made when it is asked for."""
    one_of("table", name, tables)
    table: Table = tables[name]()
    return table


class Tabular(Shown):
    """A result with one table; its facts stand in the head of the file."""

    def _table(self) -> Table:
        raise NotImplementedError

    def _comments(self) -> list[str]:
        return lines_of(self._facts())

    def to_frame(self) -> Any:
        """The table as a pandas DataFrame.

        Raises
        ------
        DondoloError
            There is no pandas.
        """
        return frame(self._table())

    def to_csv(self, path: str | os.PathLike[str], *, spreadsheet_safe: bool = False) -> None:
        """Write the table; what was found stands in the head of the file.

        Parameters
        ----------
        path : path
            The file; its folder must exist.
        spreadsheet_safe : bool
            Put an apostrophe before names that a spreadsheet would read as formulas.

        Raises
        ------
        DondoloError
            The file cannot be written.
        """
        write_csv(path, self._table(), self._comments(), spreadsheet_safe=spreadsheet_safe)


def lines_of(facts: Iterable[tuple[str, str]]) -> list[str]:
    """Facts as lines for the head of a file."""
    return [f"{what}: {text}" for what, text in facts]
