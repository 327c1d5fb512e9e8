"""Kinds of the columns of the tables of results, by their names: a cell of a file is only text.

Fortran puts values under names (`src/study/case/results/*_rows.f90`); a test compares what it puts with this list.
"""

from __future__ import annotations

import re

from dondolo._fortran.files import DEGREES, INTEGER, REAL, TEXT
from dondolo._fortran.walls import WALL_PROPERTIES, is_note

_TEXTS = frozenset(
    (
        *("wall", "mechanism", "group", "facade", "occurrence", "alternative", "im", "record", "polarity", "status"),
        *("errors", "independent_errors", "design", "return_period_bound", "source", "distribution", "method"),
        *("limit_state", "quantity", "symbol", "unit", "formula", "meaning", "item", "expression", "numbers", "bound"),
        *(row.column for row in WALL_PROPERTIES if row.kind == "text"),
    )
)
# Of each value of a list of words, whose columns have its number behind their first word
_WORDS = frozenset(row.column for row in WALL_PROPERTIES if row.kind == "words")
_DEGREES = frozenset(("degrees_of_freedom", "independent_degrees_of_freedom"))
# Whole numbers of which a table may have none: those that are there show that they are whole
_WHOLE = frozenset(
    (
        *("clusters", "independent_clusters", "deviance_dof", "mechanisms"),
        *("anchors_checked", "hierarchy", "plates_verified"),
    )
)


def kind_of(name: str) -> int:
    """Kind of a column; a number is real unless the table says otherwise, or its cells are written as whole numbers."""
    if name in _TEXTS or is_note(name) or re.sub(r"\d+", "", name, count=1) in _WORDS:
        return TEXT
    return DEGREES if name in _DEGREES else INTEGER if name in _WHOLE else REAL
