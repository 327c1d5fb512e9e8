"""Histories of stripes as a long table, one row each: joining concatenates rows, cutting leaves some out.

A row has the places of its level, record and polarity. `matrix` lays a column out as stripes have it, (levels,
histories), where the histories of a stripe are those of all records, and again in the other polarity if there are two.
"""

from __future__ import annotations

import dataclasses
from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from dondolo._base.arguments import argument_error
from dondolo._fortran.library import constants
from dondolo.errors import InputError

if TYPE_CHECKING:
    from dondolo.analysis.stripes import Stripes

IntArray = NDArray[np.intp]

# Columns of the table, the last of which every row has
_COLUMNS = (
    "edp",
    "collapsed",
    "impacts",
    "time_of_peak",
    "scale",
    "edp_error",
    "status",
    "edp_lowest",
    "edp_highest",
    "edp_rounded",
    "uplift",
    "ran",
)
# Texts of each record; results read from files may lack them
_OF_RECORDS = ("record_names", "events", "checksums", "record_formats")
# What must be the same for stripes to be joined
_SHARED = ("im", "engine", "rtol", "atol", "edp_limit")
# Columns that stripes have or not, and what one of two then lacks
_OPTIONAL = {"edp_error": "has estimated errors", "status": "is certified", "uplift": "has vertical motion"}


class _Part(NamedTuple):
    """Stripes, and the new places of their levels and records, -1 for what is left out."""

    stripes: Stripes
    level: IntArray
    record: IntArray


def matrix(values: NDArray[Any], shape: tuple[int, ...], places: Any) -> NDArray[Any]:
    """A column of the table, each value at its place (level, history); NaN elsewhere, or 0.

    The places are indices; or a mask, whose values come level by level and need no copy where all are there.
    """
    if isinstance(places, np.ndarray) and len(values) == places.size:
        return values.reshape(shape)
    whole = np.full(shape, np.nan if values.dtype.kind == "f" else 0, dtype=values.dtype)
    whole[places] = values
    return whole


def cut(stripes: Stripes, which: Any) -> Stripes:
    """The stripes of some levels, and of some records if there is a second index."""
    levels, records = which if isinstance(which, tuple) and len(which) == 2 else (which, slice(None))
    rows = _chosen("levels", len(stripes.levels), levels)
    kept = _chosen("records", stripes.n_records, records)
    ran = np.asarray(stripes.ran.reshape(len(stripes.levels), -1, stripes.n_records).any(axis=1))[np.ix_(rows, kept)]
    if not ran.any(axis=1).all():
        raise argument_error("not_given", "stripes", ": a level is left without records")
    # A record that runs at none of the levels takes no part.
    part = _Part(stripes, _places(rows, len(stripes.levels)), _places(kept[ran.any(axis=0)], stripes.n_records))
    return _concatenated([part], stripes.levels[rows])


def join(one: Stripes, other: Stripes) -> Stripes:
    """The stripes of two runs of one wall."""
    if type(other) is not type(one):
        raise argument_error("wrong_type", "stripes", f": cannot be joined with {type(other).__name__}")
    if one.wall != other.wall:
        raise argument_error(
            "not_together",
            "stripes",
            f": belong to the walls '{one.wall.name}' and '{other.wall.name}': must belong to one",
        )
    for name in _SHARED:
        first, second = getattr(one, name), getattr(other, name)
        if first != second:
            raise argument_error("not_together", "stripes", f": {name} = {first!r} and {second!r}: must be the same")
    if not np.array_equal(np.unique(one.polarity), np.unique(other.polarity)):
        raise argument_error("not_together", "stripes", ": were run with different polarities: must be the same")
    for name, what in _OPTIONAL.items():
        if (getattr(one, name) is None) != (getattr(other, name) is None):
            raise argument_error("wrong_length", "stripes", f": only one {what}")
    names = [part.record_names[: part.n_records] for part in (one, other)]
    if any(len(set(own)) < len(own) for own in names):
        raise argument_error(
            "not_together", "stripes", ": two records have the same name, so that they cannot be joined"
        )
    place = {name: i for i, name in enumerate(dict.fromkeys([*names[0], *names[1]]))}
    # The levels of the other, by the names that the first has for them
    nearest = one.levels[np.abs(one.levels[:, None] - other.levels).argmin(axis=0)]
    theirs = np.where(np.abs(nearest - other.levels) <= constants().same_level * other.levels, nearest, other.levels)
    levels = np.union1d(one.levels, theirs)
    parts = [
        _Part(stripes, np.searchsorted(levels, own_levels), np.array([place[name] for name in own]))
        for stripes, own_levels, own in zip((one, other), (one.levels, theirs), names, strict=True)
    ]
    return _concatenated(parts, levels)


def stack(several: Iterable[Stripes]) -> Stripes:
    """The stripes of runs of the same histories at other levels."""
    ordered = sorted(several, key=lambda stripes: float(stripes.levels[0]))
    levels = np.concatenate([stripes.levels for stripes in ordered])
    ends = np.cumsum([len(stripes.levels) for stripes in ordered])
    return _concatenated(
        [
            _Part(stripes, np.arange(end - len(stripes.levels), end), np.arange(stripes.n_records))
            for stripes, end in zip(ordered, ends, strict=True)
        ],
        levels,
    )


def _concatenated(parts: Sequence[_Part], levels: NDArray[Any]) -> Stripes:
    """The rows of all parts that are not left out, as stripes."""
    first = parts[0].stripes
    signs, n_records = first.polarity[:: first.n_records], 1 + max(int(part.record.max()) for part in parts)
    rows, kept = [], []
    for stripes, level, record in parts:
        row, history = np.nonzero(stripes.ran)
        second = stripes.polarity[history] != signs[0]
        row, number = level[row], record[stripes.record_index[history]]
        keep = (row >= 0) & (number >= 0)
        rows.append(np.stack([row, second * n_records + number])[:, keep])
        kept.append(keep)
    places = np.concatenate(rows, axis=1)
    found, times = np.unique(places, axis=1, return_counts=True)
    texts: dict[str, Any] = {name: _texts(name, parts, n_records) for name in _OF_RECORDS}
    if (times > 1).any():
        level_of, history_of = found[:, np.argmax(times > 1)]
        name = texts["record_names"][history_of % n_records]
        raise InputError(f"levels = {levels[level_of]:g}: record '{name}' runs in both stripes")
    shape = len(levels), len(signs) * n_records

    def column(name: str) -> NDArray[Any]:
        each = (getattr(part.stripes, name)[part.stripes.ran][keep] for part, keep in zip(parts, kept, strict=True))
        return matrix(np.concatenate(list(each)), shape, tuple(places))

    columns: dict[str, Any] = {name: column(name) for name in _COLUMNS if getattr(first, name) is not None}
    texts["record_names"] *= len(signs)
    # A run counts once, in however many parts its histories come.
    runs = {key: work for part in parts for key, work in part.stripes.runs.items()}
    polarity = np.repeat(signs, n_records)
    heard = tuple(dict.fromkeys(one for part in parts for one in part.stripes.warnings))
    return dataclasses.replace(first, levels=levels, polarity=polarity, runs=runs, warnings=heard, **columns, **texts)


def _texts(what: str, parts: Sequence[_Part], n_records: int) -> tuple[str, ...]:
    """A text of each record of all parts; none where no part has them."""
    found: dict[int, str] = {}
    for stripes, _, record in parts:
        for place, text in zip(record.tolist(), getattr(stripes, what), strict=False):
            if place >= 0 and found.setdefault(place, text) != text:
                name = stripes.record_names[record.tolist().index(place)]
                raise argument_error(
                    "not_together", "stripes", f": record '{name}' differs ({what}), so that they cannot be joined"
                )
    return tuple(found.get(place, "") for place in range(n_records)) if found else ()


def _places(kept: IntArray, length: int) -> IntArray:
    """New places of so many rows of which some are kept."""
    places = np.full(length, -1)
    places[kept] = np.arange(len(kept))
    return places


def _chosen(what: str, length: int, which: Any) -> IntArray:
    """Numbers of the rows of an index, in their order, each once."""
    try:
        rows = np.unique(np.atleast_1d(np.arange(length)[which]))
    except (IndexError, TypeError, ValueError):
        raise InputError(f"stripes[{which!r}]: must be a slice, numbers or a mask of {length} {what}") from None
    if not len(rows):
        raise InputError(f"stripes: no {what} are left")
    return rows
