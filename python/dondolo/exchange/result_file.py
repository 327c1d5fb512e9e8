"""One table of a run: columns, and the place of whatever is wrong with it."""

from __future__ import annotations

import csv
import math
import re
from collections.abc import Iterable, Iterator, Sequence
from contextlib import suppress

import numpy as np

from dondolo._base.arguments import FloatArray
from dondolo._base.files import read_text
from dondolo._fortran.files import INTEGER, REAL, TEXT, Column
from dondolo._storage.columns import Columns
from dondolo._storage.kinds import kind_of
from dondolo._storage.run_file import RunFile, described, run_of
from dondolo._storage.tables import digits, unguarded
from dondolo.errors import InputError, MissingFileError

# A whole number of up to nine digits, as dondolo writes it
_WHOLE = re.compile(r"0|-?[1-9]\d{0,8}")


class MixedError(InputError):
    """Files of two runs: another run may have replaced them meanwhile."""


def _text_of(path: str, run: RunFile) -> str:
    """Text of a table, which a run that was killed may have left under its name before it was published."""
    other = ""
    # A run that is ending may rename it after the first look.
    for place in (path, f"{path}.{run.run}.part", path):
        with suppress(MissingFileError):
            text = read_text(place).replace("\r\n", "\n")
            other = run_of(text)[0] or "unknown"
            if other == run.run:
                return text
    if other:
        raise MixedError(f"{path}: is of run {other}, {run.path} of run {run.run}: they do not belong to one set")
    raise MissingFileError(f"{path}: cannot be read: no such file")


class ResultFile(Columns):
    """A table in a result file.

    Parameters
    ----------
    path : str
        The file.
    run : RunFile
        The file of the run, which names its tables.

    Raises
    ------
    InputError
        It cannot be read, or is no table.
    MixedError
        It is of another run.
    """

    def __init__(self, path: str, run: RunFile) -> None:
        self.path = path
        self._run = run
        self._text = _text_of(path, run)
        self._numbers: dict[str, FloatArray] = {}
        lines = self._text.split("\n")
        # Comments stand at the head: a # or a line end in a cell begins none.
        head = next((i for i, line in enumerate(lines) if not line.startswith("#")), len(lines))
        self._lines: Sequence[int] = []
        with self.reading():
            self._columns = self._split(lines[head:], head) or self._read(lines[head:], head)

    def check(self) -> None:
        """Check that the file is as its run has written it; what has a worse place is said first by the others."""
        for written in self._run.files:
            if self.path.endswith(written.name) and (found := described(written.name, self._text)) != written:
                why = f"{found.bytes} bytes, {written.bytes} written" if found.bytes != written.bytes else "its CRC-32"
                raise InputError(f"{self.path}: is not as its run has written it ({why})")

    def _split(self, lines: list[str], head: int) -> dict[str, list[str]]:
        """Columns of a table without quotes and empty lines, of as many cells in each row: the usual case.

        Nothing of any other.
        """
        rows = lines[:-1] if lines and not lines[-1] else lines
        names, body = (rows[0].split(",") if rows else []), ",".join(rows[1:])
        if any(sign in body or sign in rows[0] for sign in "\"'\r") or not body or not all(rows):
            return {}
        if {row.count(",") for row in rows} != {len(names) - 1} or max(map(len, rows)) > csv.field_size_limit():
            return {}
        self._lines = range(head + 2, head + 1 + len(rows))
        cells = body.split(",")
        return {name: cells[i :: len(names)] for i, name in enumerate(names)}

    def _read(self, lines: list[str], head: int) -> dict[str, list[str]]:
        rows = csv.reader(line + "\n" for line in lines)
        body = []
        self._lines = places = []
        try:
            names = next(rows, [])
            for row in filter(None, rows):
                places.append(head + rows.line_num)
                if len(row) != len(names):
                    raise ValueError(f"{self.place(-1)}: {len(row)} cells: must be {len(names)} as in the header")
                body.append(row)
        except csv.Error as error:
            raise ValueError(f"line {head + rows.line_num}: {error}") from error
        if not body:
            raise ValueError("no rows")
        columns: Iterable[list[str]] = map(list, zip(*body, strict=True))
        if any("'" in line for line in lines):
            columns = ([unguarded(cell) for cell in column] for column in columns)
        return dict(zip(names, columns, strict=True))

    def column(self, name: str) -> Column:
        """A column as it is written, of the kind that its name says."""
        cells, kind = self.texts(name), kind_of(name)
        if kind == TEXT:
            return Column(TEXT, cells)
        whole = [_WHOLE.fullmatch(cell) is not None for cell in cells]
        for i, cell in enumerate(cells):
            if cell and not whole[i] and digits(_number(cell)) != cell:
                with self.reading():
                    raise ValueError(f"{self.place(i)}: {name} = {cell!r}: must be a number as dondolo writes it")
        if kind == REAL and any(whole):
            kind = INTEGER
        return Column(kind, np.array([float(cell) if cell else np.nan for cell in cells]))

    def __contains__(self, name: str) -> bool:
        return name in self._columns

    def __iter__(self) -> Iterator[str]:
        """Names of the columns."""
        return iter(self._columns)

    def __len__(self) -> int:
        return len(self._lines)

    def place(self, i: int) -> str:
        """Line of a row."""
        return f"line {self._lines[i]}"

    def texts(self, name: str) -> list[str]:
        """A column; '' where there is nothing."""
        if name not in self._columns:
            raise ValueError(f"no column '{name}'")
        return self._columns[name]

    def _value(self, name: str, i: int) -> float:
        # Of many columns a few cells are asked for.
        return _number(self.texts(name)[i])

    def _values(self, name: str) -> FloatArray:
        if name not in self._numbers:
            cells = self.texts(name)
            try:
                values = np.array([float(cell) for cell in cells])
            except ValueError:
                values = np.array([_number(cell) for cell in cells])
            values.flags.writeable = False
            self._numbers[name] = values
        return self._numbers[name]


def _number(cell: str) -> float:
    """The number in a cell; NaN where there is none."""
    try:
        return float(cell)
    except ValueError:
        return math.nan
