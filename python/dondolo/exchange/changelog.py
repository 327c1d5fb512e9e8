"""Results that change between versions: the tables of that name in CHANGELOG.md, installed with the package."""

from __future__ import annotations

import re
from collections.abc import Iterable
from importlib import resources
from itertools import pairwise
from typing import NamedTuple

_HEADING = "### Results that change"
_SECTION = re.compile(r"(?m)^## (\d+(?:\.\d+)*)")
# A name of a variable, a group, a mechanism or a column in a sentence
_NAME = re.compile(r"`&?([a-z]\w+)`")


class Change(NamedTuple):
    """A row of the table.

    Attributes
    ----------
    version : str
        Of the section that it is in: results of versions before may differ.
    what, by_how_much, who : str
        Its cells, in Markdown.
    """

    version: str
    what: str
    by_how_much: str
    who: str

    def concerns(self, names: Iterable[str]) -> bool:
        """Whether it names a variable, group, mechanism or column among these."""
        return not set(_NAME.findall(" ".join(self))).isdisjoint(names)


def all_changes() -> list[Change]:
    """Every row, newest version first."""
    text = resources.files("dondolo").joinpath("CHANGELOG.md").read_text(encoding="utf-8")
    found = []
    starts = [*_SECTION.finditer(text), None]
    for start, after in pairwise(starts):
        assert start is not None
        section = text[start.end() : len(text) if after is None else after.start()]
        for table in section.split(_HEADING)[1:]:
            rows = [line for line in table.split("\n###")[0].split("\n") if line.startswith("|")]
            # The first two are the titles and the line below them.
            found += [Change(start[1], *_cells(row)) for row in rows[2:]]
    return found


def changes_between(one: str, other: str) -> list[Change]:
    """Rows that results of two versions may differ by: of sections after the older, up to the newer.

    Of builds of one version that is not yet released, those of its own section: a build may lack some of them.
    """
    low, high = sorted((_key(one), _key(other)))
    return [row for row in all_changes() if low < _key(row.version) <= high or low == _key(row.version) == high]


def _key(version: str) -> tuple[int, ...]:
    """A version as numbers; what follows them, such as .dev1, does not count."""
    return tuple(int(part) for part in re.match(r"[\d.]*", version)[0].strip(".").split(".") if part)  # type: ignore[index]


def _cells(row: str) -> tuple[str, str, str]:
    what, by_how_much, who = (cell.strip() for cell in row.strip().strip("|").split(" | "))
    return what, by_how_much, who
