"""Tables of results as named columns, wherever they come from: a file, or the library's memory."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from typing import Any

import numpy as np
from numpy.typing import NDArray

from dondolo._base.arguments import FloatArray
from dondolo._fortran.files import Column
from dondolo.errors import InputError


class Columns:
    """Columns of equal length under their names.

    What is wrong with them is raised as a ValueError without the name of the table, which `reading` adds.
    """

    path: str

    def texts(self, name: str) -> list[str]:
        """A column; '' where there is nothing."""
        raise NotImplementedError

    def _values(self, name: str) -> FloatArray:
        """A column of numbers, NaN where there is none or what is there is no number."""
        raise NotImplementedError

    def column(self, name: str) -> Column:
        """A column as it is written."""
        raise NotImplementedError

    def _value(self, name: str, i: int) -> float:
        """A cell of a column of numbers, as `_values` has it."""
        return float(self._values(name)[i])

    def __contains__(self, name: str) -> bool:
        raise NotImplementedError

    def __iter__(self) -> Iterator[str]:
        """Names of the columns."""
        raise NotImplementedError

    def __len__(self) -> int:
        raise NotImplementedError

    def place(self, i: int) -> str:
        """Where a row stands."""
        return f"row {i + 1}"

    def check(self) -> None:
        """Check that the table is as its run has made it; what has a worse place is said first by the others."""

    def given(self, name: str, i: int) -> bool:
        """Is there anything in a cell?"""
        return bool(self.texts(name)[i])

    @contextmanager
    def reading(self) -> Iterator[None]:
        """Turn whatever is wrong with the contents into an InputError that names the table."""
        try:
            yield
        except (ArithmeticError, LookupError, TypeError, ValueError) as error:
            raise InputError(f"{self.path}: {error}") from error

    def number(self, name: str, i: int) -> float:
        """A cell that is a finite number."""
        value = self._value(name, i)
        if not math.isfinite(value):
            raise ValueError(f"{self.place(i)}: {name} = {self.texts(name)[i]!r}: must be a number")
        return value

    def numbers(self, name: str, first: int = 0, count: int | None = None) -> FloatArray:
        """Finite numbers of a column, or of some rows of it."""
        values = self._values(name)[first : None if count is None else first + count]
        if not np.isfinite(values).all():
            # Names the first that is no number
            self.number(name, first + int(np.argmin(np.isfinite(values))))
        return values

    def given_numbers(self, name: str) -> FloatArray:
        """Finite numbers of a column, NaN where a cell is empty."""
        values = self._values(name)
        for i in np.flatnonzero(~np.isfinite(values)):
            if self.given(name, int(i)):
                self.number(name, int(i))
        return values

    def count(self, name: str, i: int) -> int:
        """A cell that is a whole number, not negative."""
        value = self.number(name, i)
        if not 0.0 <= value < 2**31 or value != math.floor(value):
            raise ValueError(f"{self.place(i)}: {name} = {value:.15g}: must be an integer between 0 and {2**31 - 1}")
        return int(value)

    def counts(self, name: str, least: int = 0, most: int = 2**31 - 1) -> NDArray[np.int32]:
        """A column of whole numbers."""
        values = self.numbers(name)
        wrong = (values < least) | (values > most) | (values != np.floor(values))
        if wrong.any():
            i = int(np.argmax(wrong))
            allowed = f"must be an integer between {least} and {most}"
            raise ValueError(f"{self.place(i)}: {name} = {values[i]:.15g}: {allowed}")
        return values.astype(np.int32)


class ColumnsInMemory(Columns):
    """A table that the library has sent.

    Parameters
    ----------
    name : str
        What the name of its file would end with.
    columns : mapping
        Its columns.
    """

    def __init__(self, name: str, columns: Mapping[str, Column]) -> None:
        self.path = name
        self._columns = columns

    def column(self, name: str) -> Column:
        """A column as it is written."""
        if name not in self._columns:
            raise ValueError(f"no column '{name}'")
        return self._columns[name]

    def _column(self, name: str) -> Any:
        return self.column(name).values

    def texts(self, name: str) -> list[str]:
        """A column; '' where there is nothing."""
        column = self._column(name)
        return column if isinstance(column, list) else ["" if math.isnan(value) else repr(value) for value in column]

    def given(self, name: str, i: int) -> bool:
        """Is there anything in a cell?"""
        column = self._column(name)
        return bool(column[i]) if isinstance(column, list) else not math.isnan(column[i])

    def _values(self, name: str) -> FloatArray:
        column = self._column(name)
        if isinstance(column, list):
            raise ValueError(f"{name}: must be numbers")
        return np.asarray(column)

    def __contains__(self, name: str) -> bool:
        return name in self._columns

    def __iter__(self) -> Iterator[str]:
        return iter(self._columns)

    def __len__(self) -> int:
        return len(next(iter(self._columns.values())).values)
