"""What an analysis takes for records: each once, with the rows of each level, or times their factors."""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from dondolo._base.arguments import FloatArray, argument_error, as_array, wrong_type
from dondolo.errors import InputError
from dondolo.records.columns import factors_of
from dondolo.records.record import Record, as_records
from dondolo.records.record_set import RecordSet


class LevelRows(NamedTuple):
    """Which records run at which levels, one row each.

    Attributes
    ----------
    record : ndarray of int
        Place of the record, from 1.
    level : ndarray
        In the unit of the measure; 0: every level.
    factor : ndarray
        Factor on the record; 0: computed from the measure.
    """

    record: NDArray[np.int32]
    level: FloatArray
    factor: FloatArray


def records_at_levels(
    records: Any, levels: ArrayLike | None
) -> tuple[tuple[Record, ...], FloatArray, LevelRows | None]:
    """What an analysis takes for records and levels: each record once, the levels, and the rows of each level.

    Parameters
    ----------
    records : Record, iterable of Record, RecordSet or mapping
        A set with levels, or a mapping of levels to records, chooses the records of each level.
    levels : array_like or None
        Left out where the records have levels.

    Returns
    -------
    records : tuple of Record
    levels : ndarray
    rows : LevelRows or None
        None: every record runs at every level.
    """
    if isinstance(records, Mapping):
        records = RecordSet.of_levels(records)
    if not isinstance(records, RecordSet) or (records.level is None and records.factor is None):
        if levels is None:
            raise argument_error("not_given", "levels", ": must be given")
        return as_records(records), _as_levels(levels), None
    if records.level is None:
        raise argument_error(
            "not_together",
            "records",
            ": have factors and no levels: must be given as {level: records}, or without factors (the attribute"
            " records of the set)",
        )
    each = tuple(dict.fromkeys(records.records))
    place = {id(record): i + 1 for i, record in enumerate(each)}
    level = np.nan_to_num(records.level, nan=0.0)
    factor = np.zeros(len(records)) if records.factor is None else np.nan_to_num(records.factor, nan=0.0)
    if levels is None:
        levels = np.unique(level[level > 0.0])
        if not len(levels):
            raise argument_error("not_given", "levels", ": must be given")
    number = np.array([place[id(record)] for record in records.records], dtype=np.int32)
    return each, _as_levels(levels), LevelRows(number, level, factor)


def _as_levels(levels: ArrayLike) -> FloatArray:
    """What a user gives for levels; a word such as 'auto' asks for levels that are chosen."""
    if isinstance(levels, str):
        raise wrong_type("levels", levels, "numbers", "adaptive_stripes chooses levels")
    return as_array("levels", levels).copy()


def scaled_records(records: Record | Iterable[Record]) -> tuple[Record, ...]:
    """What an analysis without levels takes for records: those of a set times their factors, one for each row."""
    factors = factors_of(records) if isinstance(records, RecordSet) else None
    several = as_records(records)
    if factors is None:
        return several
    found: dict[tuple[int, float], Record] = {}
    for record, factor in zip(several, factors.tolist(), strict=True):
        if (id(record), factor) not in found:
            found[id(record), factor] = record if factor == 1.0 else _times(record, factor)
    return tuple(found[id(record), factor] for record, factor in zip(several, factors.tolist(), strict=True))


def _times(record: Record, factor: float) -> Record:
    """A record times a factor."""
    upwards = None if record.vertical is None else factor * record.vertical
    return record.processed(factor * record.acceleration, f"times {factor:.6g}", vertical=upwards)


def plain_records(records: Any) -> tuple[Record, ...]:
    """What chooses levels or factors by itself takes for records: no set that has them."""
    for what in ("level", "factor"):
        if isinstance(records, RecordSet) and getattr(records, what) is not None:
            raise InputError(f"records: have {what}s of their own: must be without (the attribute records of the set)")
    return as_records(records)


def lasting(records: Any) -> Any:
    """Records that are taken more than once: sets and mappings as they are, all others as a tuple."""
    return records if isinstance(records, (Mapping, RecordSet)) else as_records(records)
