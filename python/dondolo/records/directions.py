"""Files that are no horizontal accelerograms, recognised by what they say of themselves or by their names."""

from __future__ import annotations

import re
from pathlib import Path

from dondolo.records.record import Record

#: Words for a vertical component, and codes of channels that end in Z.
_VERTICAL = re.compile(r"up|upx|ud\d?|\w*dwn|\w*\dup|vert|vertical[ei]?|[bcdehlms][nhgl]z")

#: The same where no other word follows.
_LAST = re.compile(r"[uvz]|az|dn|down|ver")

#: Words for a horizontal component; a number is an azimuth.
_HORIZONTAL = re.compile(r"[nsew]{1,2}[x\d]?|[xy]|[hlrt]\d?|[ns]\d+[ew]|\d{1,3}|[bcdehlms][nhgl][en\d]")

#: Words that may follow and say nothing of the direction.
_OTHER = re.compile(r"acc?|a|accel|acceleration|at2|asc|txt|csv|dat|c|d|cor|corr|corrected|deg")

#: Words for other quantities than acceleration.
_QUANTITY = re.compile(r"vt2|dt2|vel|velocity|dis|disp|displ|displacement")

#: Inclinations of the format smc, and azimuths of cosmos, that are vertical.
_CODES = (("smc", "inclination", ("0", "180")), ("cosmos", "azimuth", ("400", "401", "402")))


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
    known = record.metadata
    for layout, key, codes in _CODES:
        if known.get("format") == layout and known.get(key) in codes:
            return f"{key} {known[key]}"
    for key in ("component", "channel", "axis"):
        text = known.get(key, "")
        found = _direction(text)
        if found:
            return f"{key} {text!r}" if found == "vertical" else ""
    return f"name {path.name!r}" if _direction(path.name) == "vertical" else ""


def _direction(text: str) -> str:
    """'vertical', 'horizontal', or '' where a text does not say."""
    words = [word for word in _words(text) if not _OTHER.fullmatch(word)]
    if "column" in words:
        return ""
    if words and _LAST.fullmatch(words[-1]):
        return "vertical"
    for word in reversed(words):
        if _VERTICAL.fullmatch(word):
            return "vertical"
        if _HORIZONTAL.fullmatch(word):
            return "horizontal"
    return ""


def _words(text: str) -> list[str]:
    """Words of a text in lower case, without what stands in brackets."""
    return re.findall("[a-z0-9]+", re.sub(r"[(\[].*?[)\]]", " ", text.lower()))
