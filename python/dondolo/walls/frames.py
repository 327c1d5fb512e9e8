"""Populations out of data frames, by the reader of their files."""

from __future__ import annotations

import re
import tempfile
from pathlib import Path
from typing import Any

import numpy as np

from dondolo._base.arguments import argument_error, shortened
from dondolo._fortran.library import properties
from dondolo._fortran.walls import WALL_PROPERTIES, WallTable, is_note, read_walls
from dondolo._storage import tables
from dondolo.errors import InputError

# Columns of texts; a number read in the place of one has lost its form: 1.10 is 1.1
_TEXTS = frozenset(row.name for row in (*WALL_PROPERTIES, *properties("row")) if row.kind == "text")


def read_frame(frame: Any, gravity: float | None, occurrence: str) -> tuple[WallTable, dict[str, Any]]:
    """Read a data frame as the file that it would be: its walls, and what `Population` has of each."""
    table = _columns(frame)
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "frame.csv"
        tables.write_lines(path, tables.csv_lines(table, (), tables.shortest))
        try:
            return read_walls(path, gravity, occurrence, lambda text: _placed(text, path))
        except InputError as error:
            problems = [
                one._replace(message=_placed(one.message, path), place=_placed(one.place, path)) for one in error.errors
            ]
            raise InputError(_placed(str(error), path), errors=problems) from None


def _columns(frame: Any) -> tables.Table:
    """Columns of a data frame with None where there is nothing."""
    if not all(hasattr(frame, name) for name in ("columns", "notna", "iloc")):
        raise argument_error("wrong_type", "frame", f" = {shortened(frame)}: must be a pandas DataFrame")
    names = [str(name) for name in frame.columns]
    if len(set(names)) < len(names):
        twice = next(name for name in names if names.count(name) > 1)
        raise argument_error("not_together", "frame", f": column {twice!r} is there twice")
    given = frame.astype(object).where(frame.notna(), None)
    table = {name: given.iloc[:, i].tolist() for i, name in enumerate(names)}
    for name, column in table.items():
        is_text = name.lower() in _TEXTS
        if is_note(name):
            # A date, say
            plain = (type(None), bool, int, float, str)
            table[name] = [one if isinstance(one, plain) else str(one) for one in column]
            continue
        for i, value in enumerate(column):
            if is_text and isinstance(value, (float, np.floating)):
                sentence = f".iloc[{i}]: {name} = {value}: must be a string (read_csv(..., dtype={{{name!r}: str}}))"
                raise argument_error("not_a_string", "frame", sentence)
            try:
                tables.cell(value, tables.shortest)
            except (TypeError, ValueError):
                sentence = f".iloc[{i}]: {name} = {shortened(value)}: must be a number or a string"
                raise argument_error("not_a_number", "frame", sentence) from None
    return table


def _placed(text: str, path: Path) -> str:
    """A message with the place in the frame, not in its file, whose first line has the names of the columns."""
    rows = re.sub(re.escape(f"{path}: line ") + r"(\d+)", lambda found: f"frame.iloc[{int(found[1]) - 2}]", text)
    return rows.replace(str(path), "frame")
