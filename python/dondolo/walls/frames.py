"""Populations out of data frames, by the reader of their files."""

from __future__ import annotations

import re
import tempfile
from pathlib import Path
from typing import Any

from dondolo._base.arguments import argument_error, shortened
from dondolo._fortran.walls import WallData, read_walls
from dondolo._storage import tables
from dondolo.errors import InputError


def read_frame(frame: Any, gravity: float | None, occurrence: str) -> tuple[list[WallData], dict[str, Any]]:
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
        for i, value in enumerate(column):
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
