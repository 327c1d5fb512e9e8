"""One table of a run: columns, and the place of whatever is wrong with it."""

from __future__ import annotations

import csv
import math
from collections.abc import Iterator
from contextlib import contextmanager

import numpy as np
from numpy.typing import NDArray

from dondolo._base.arguments import FloatArray
from dondolo._base.files import read_text
from dondolo.errors import InputError


class ResultFile:
    """A result file.

    What is wrong with its contents is raised as a ValueError without its path, which `reading` adds.

    Parameters
    ----------
    path : str
        The file.

    Raises
    ------
    InputError
        It cannot be read, or is no table.
    """

    def __init__(self, path: str) -> None:
        self.path = path
        lines = read_text(path).replace("\r\n", "\n").split("\n")
        # Comments stand at the head: a # or a line end in a cell begins none.
        head = next((i for i, line in enumerate(lines) if not line.startswith("#")), len(lines))
        self._lines: list[int] = []
        with self.reading():
            self._columns = self._read(lines[head:], head)

    def _read(self, lines: list[str], head: int) -> dict[str, list[str]]:
        rows = csv.reader(line + "\n" for line in lines)
        body = []
        try:
            names = next(rows, [])
            for row in filter(None, rows):
                self._lines.append(head + rows.line_num)
                if len(row) != len(names):
                    raise ValueError(f"{self.place(-1)}: {len(row)} cells: must be {len(names)} as in the header")
                body.append(row)
        except csv.Error as error:
            raise ValueError(f"line {head + rows.line_num}: {error}") from error
        if not body:
            raise ValueError("no rows")
        return dict(zip(names, map(list, zip(*body, strict=True)), strict=True))

    @contextmanager
    def reading(self) -> Iterator[None]:
        """Turn whatever is wrong with the contents into an InputError that names the file."""
        try:
            yield
        except (ArithmeticError, LookupError, TypeError, ValueError) as error:
            raise InputError(f"{self.path}: {error}") from error

    def __contains__(self, name: str) -> bool:
        return name in self._columns

    def __len__(self) -> int:
        return len(self._lines)

    def place(self, i: int) -> str:
        """Line of a row."""
        return f"line {self._lines[i]}"

    def texts(self, name: str) -> list[str]:
        """A column."""
        if name not in self._columns:
            raise ValueError(f"no column '{name}'")
        return self._columns[name]

    def number(self, name: str, i: int) -> float:
        """A cell that is a finite number."""
        cell = self.texts(name)[i]
        try:
            value = float(cell)
        except ValueError:
            value = math.nan
        if not math.isfinite(value):
            raise ValueError(f"{self.place(i)}: {name} = {cell!r}: must be a number")
        return value

    def numbers(self, name: str) -> FloatArray:
        """A column of finite numbers."""
        cells = self.texts(name)
        try:
            values = np.array([float(cell) for cell in cells])
        except ValueError:
            values = np.array([math.nan])
        if not np.isfinite(values).all():
            # Names the first that is no number
            values = np.array([self.number(name, i) for i in range(len(self))])
        values.flags.writeable = False
        return values

    def counts(self, name: str, least: int = 0) -> NDArray[np.int32]:
        """A column of whole numbers."""
        values = self.numbers(name)
        wrong = (values < least) | (values > np.iinfo(np.int32).max) | (values != np.floor(values))
        if wrong.any():
            i = int(np.argmax(wrong))
            raise ValueError(f"{self.place(i)}: {name} = {values[i]:.15g}: must be an integer, at least {least}")
        return values.astype(np.int32)
