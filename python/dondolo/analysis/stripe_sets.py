"""Stripes with records of their own at each level: as matrices, joined and cut."""

from __future__ import annotations

import dataclasses
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from dondolo._fortran.library import constants
from dondolo.analysis.work import Work
from dondolo.errors import InputError

if TYPE_CHECKING:
    from dondolo.analysis.stripes import Stripes

# Fields (levels, histories), and what they have where a record does not run
_MATRICES = {
    "edp": np.nan,
    "collapsed": False,
    "impacts": 0,
    "time_of_peak": np.nan,
    "scale": np.nan,
    "edp_error": np.nan,
    "status": 0,
    "edp_lowest": np.nan,
    "edp_highest": np.nan,
    "uplift": False,
    "ran": False,
}
# Fields with a text for each record, or with none
_OF_RECORDS = ("events", "checksums")

# What must be the same for stripes to be joined
_SHARED = ("im", "engine", "rtol", "atol", "edp_limit")


def in_matrix(values: NDArray[Any], ran: NDArray[np.bool_]) -> NDArray[Any]:
    """Values of the histories that were run, stripe by stripe, as a matrix (levels, histories); NaN elsewhere, or 0."""
    if len(values) == ran.size:
        return values.reshape(ran.shape)
    matrix = np.full(ran.shape, np.nan if values.dtype.kind == "f" else 0, dtype=values.dtype)
    matrix[ran] = values
    return matrix


def span(counts: NDArray[Any]) -> str:
    """Counts in words: one number, or the least and the most."""
    few, many = int(counts.min()), int(counts.max())
    return str(few) if few == many else f"{few} to {many}"


def cut(stripes: Stripes, which: Any) -> Stripes:
    """The stripes of some levels, and of some records if there is a second index."""
    levels, records = which if isinstance(which, tuple) and len(which) == 2 else (which, slice(None))
    rows = _chosen("levels", len(stripes.levels), levels)
    kept = np.zeros(stripes.n_records, dtype=bool)
    kept[_chosen("records", stripes.n_records, records)] = True
    columns = kept[stripes.record_index]
    # A record that runs at none of the levels takes no part.
    ran = (stripes.ran[rows] & columns).reshape(len(rows), -1, stripes.n_records).any(axis=(0, 1))
    columns &= ran[stripes.record_index]
    if not columns.any() or not stripes.ran[np.ix_(rows, columns)].any(axis=1).all():
        raise InputError("stripes: a level is left without records")
    return _with(stripes, stripes.levels[rows], lambda name, values: values[np.ix_(rows, columns)], columns)


def join(one: Stripes, other: Stripes) -> Stripes:
    """The stripes of two runs of one wall."""
    if type(other) is not type(one):
        raise InputError(f"stripes: cannot be joined with {type(other).__name__}")
    if one.wall != other.wall:
        raise InputError(f"stripes: are of the walls '{one.wall.name}' and '{other.wall.name}': must be of one")
    for name in _SHARED:
        first, second = getattr(one, name), getattr(other, name)
        if first != second:
            raise InputError(f"stripes: {name} = {first!r} and {second!r}: must be the same")
    signs = np.unique(one.polarity)
    if not np.array_equal(signs, np.unique(other.polarity)):
        raise InputError("stripes: were run with other polarities: must be the same")
    if (one.edp_error is None) != (other.edp_error is None):
        raise InputError("stripes: only one has estimated errors")
    if (one.status is None) != (other.status is None):
        raise InputError("stripes: only one is certified")
    if (one.uplift is None) != (other.uplift is None):
        raise InputError("stripes: only one has vertical motion")
    names = [part.record_names[: part.n_records] for part in (one, other)]
    for own in names:
        if len(set(own)) < len(own):
            raise InputError("stripes: two records have the same name, so that they cannot be joined")
    joint = list(dict.fromkeys([*names[0], *names[1]]))
    # The levels of the other, by the names that the first has for them
    nearest = one.levels[np.abs(one.levels[:, None] - other.levels).argmin(axis=0)]
    theirs = np.where(np.abs(nearest - other.levels) <= constants().same_level * other.levels, nearest, other.levels)
    levels = np.union1d(one.levels, theirs)
    rows = [np.searchsorted(levels, own) for own in (one.levels, theirs)]
    place = {name: i for i, name in enumerate(joint)}
    order = one.polarity[:: one.n_records]
    columns = []
    for part, own in zip((one, other), names, strict=True):
        block = np.array([int(np.flatnonzero(order == sign)[0]) for sign in part.polarity])
        columns.append(block * len(joint) + np.array([place[own[i]] for i in part.record_index]))
    shape = (len(levels), len(order) * len(joint))
    twice = np.zeros(shape, dtype=int)
    for part, row, column in zip((one, other), rows, columns, strict=True):
        twice[np.ix_(row, column)] += part.ran
    if (twice > 1).any():
        level, column = np.argwhere(twice > 1)[0]
        raise InputError(f"levels = {levels[level]:g}: record '{joint[column % len(joint)]}' runs in both stripes")

    def matrix(name: str, values: NDArray[Any]) -> NDArray[Any]:
        whole = np.full(shape, _MATRICES[name], dtype=values.dtype)
        for part, row, column in zip((one, other), rows, columns, strict=True):
            # Both may have the level: only what ran is taken over.
            block = whole[np.ix_(row, column)]
            whole[np.ix_(row, column)] = np.where(part.ran, getattr(part, name), block)
        return whole

    joined = _with(one, levels, matrix)
    polarity = np.repeat(order, len(joint)).astype(one.polarity.dtype)
    polarity.flags.writeable = False
    work = Work.total([one.work, other.work])
    of_records: dict[str, Any] = {name: _of_records(name, (one, other), joint) for name in _OF_RECORDS}
    names_twice = tuple(joint) * len(order)
    return dataclasses.replace(joined, record_names=names_twice, polarity=polarity, work=work, **of_records)


def stack(parts: Sequence[Stripes]) -> Stripes:
    """The stripes of runs of the same histories at other levels."""
    several = sorted(parts, key=lambda part: float(part.levels[0]))
    levels = np.concatenate([part.levels for part in several])
    whole = _with(several[0], levels, lambda name, _: np.concatenate([getattr(part, name) for part in several]))
    return dataclasses.replace(whole, work=Work.total(part.work for part in several))


def _of_records(what: str, parts: Sequence[Stripes], joint: Sequence[str]) -> tuple[str, ...]:
    """A text of each record of two runs."""
    found: dict[str, str] = {}
    for part in parts:
        for name, text in zip(part.record_names, getattr(part, what), strict=False):
            if found.setdefault(name, text) != text:
                raise InputError(f"stripes: record '{name}' differs ({what}), so that they cannot be joined")
    return tuple(found.get(name, "") for name in joint) if found else ()


def _with(stripes: Stripes, levels: NDArray[Any], change: Any, columns: NDArray[np.bool_] | None = None) -> Stripes:
    """Stripes with other levels, each matrix changed, and with some of the columns only."""
    fields: dict[str, Any] = {"levels": levels}
    for name in _MATRICES:
        values = getattr(stripes, name)
        fields[name] = None if values is None else change(name, values)
    if columns is not None:
        fields["polarity"] = stripes.polarity[columns]
        chosen = zip(stripes.record_names, columns, strict=True)
        fields["record_names"] = tuple(name for name, here in chosen if here)
        kept = np.unique(stripes.record_index[columns]).tolist()
        for name in _OF_RECORDS:
            texts = getattr(stripes, name)
            fields[name] = tuple(texts[i] for i in kept) if texts else ()
    for values in fields.values():
        if isinstance(values, np.ndarray):
            values.flags.writeable = False
    return dataclasses.replace(stripes, **fields)


def _chosen(what: str, length: int, which: Any) -> NDArray[np.int64]:
    """Numbers of the rows of an index, in their order, each once."""
    try:
        rows = np.unique(np.atleast_1d(np.arange(length)[which]))
    except (IndexError, TypeError, ValueError):
        raise InputError(f"stripes[{which!r}]: must be a slice, numbers or a mask of {length} {what}") from None
    if not len(rows):
        raise InputError(f"stripes: no {what} are left")
    return rows
