"""Files that are no horizontal accelerograms, recognised by what they say of themselves or by their names."""

from __future__ import annotations

import re
from pathlib import Path

from dondolo.records.record import Record
from dondolo.records.suite import component_of

#: Words for other quantities than acceleration.
_QUANTITY = re.compile(r"vt2|dt2|vel|velocity|dis|disp|displ|displacement")


def is_search_result(path: Path) -> bool:
    """Is a file PEER's list of what a search has found?"""
    return path.name.lower().endswith("_searchresults.csv")


def other_quantity(record: Record, path: Path) -> str:
    """Word of a file's name that is another quantity than acceleration, where the file does not state its units."""
    last = _words(path.name)[-2:]
    found = [word for word in last if _QUANTITY.fullmatch(word)]
    return found[0] if found and not record.metadata.get("units") else ""


def vertical_mark(record: Record, path: Path) -> str:
    """What shows that a record is a vertical component: its metadata, else the name of its file; '' if nothing does."""
    found = component_of(record.metadata, path.name)
    return f"{found.key} {found.text!r}" if found.is_vertical else ""


def _words(text: str) -> list[str]:
    """Words of a text in lower case, without what stands in brackets."""
    return re.findall("[a-z0-9]+", re.sub(r"[(\[].*?[)\]]", " ", text.lower()))
