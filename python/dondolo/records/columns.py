"""Columns of a table of records: levels and factors, times, metadata and intensity measures."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from dondolo._base.arguments import FloatArray, argument_error, as_array, as_number
from dondolo.errors import InputError
from dondolo.records.suite import intensities

if TYPE_CHECKING:
    from dondolo.records.record_set import RecordSet


def column_names(records: RecordSet) -> tuple[str, ...]:
    """Names of the columns: of the table itself, and the keys of the metadata."""
    keys = dict.fromkeys(key for record in records.records for key in record.metadata)
    own = ["record", *(what for what in ("level", "factor") if getattr(records, what) is not None), "dt", "duration"]
    return (*own, *(key for key in keys if key not in own))


def column_of(records: RecordSet, name: str) -> NDArray[Any]:
    """A column: numbers where every value is one, else texts."""
    if name == "record":
        return np.array([record.name for record in records.records])
    if name in ("level", "factor"):
        values = getattr(records, name)
        return np.full(len(records), np.nan) if values is None else np.asarray(values)
    if name in ("dt", "duration"):
        return np.array([getattr(record, name) for record in records.records])
    if any(name in record.metadata for record in records.records):
        return _numbers([record.metadata.get(name, "") for record in records.records])
    names = [record.name for record in records.records]
    if name in names:
        sentence = f": is the name of a record, not of a column: records[{names.index(name)}] is the record"
        raise argument_error("unknown_name", repr(name), sentence)
    try:
        return intensities_of(records, name)
    except InputError as error:
        raise InputError(
            f"{name!r}: is neither a column ({', '.join(column_names(records))}) nor a measure ({error})"
        ) from None


def intensities_of(records: RecordSet, im: str, gravity: float | None = None) -> FloatArray:
    """An intensity measure of the unscaled records."""
    # A record may have several rows, and a suite must not hold it twice.
    each = tuple(dict.fromkeys(records.records))
    places = {id(record): i for i, record in enumerate(each)}
    return intensities(each, im, gravity)[[places[id(record)] for record in records.records]]


def factors_of(records: RecordSet) -> FloatArray | None:
    """Factors on the rows where there are no levels to find them from; None for records as they stand."""
    if records.level is None and records.factor is None:
        return None
    factor = np.full(len(records), np.nan) if records.factor is None else records.factor
    level = np.full(len(records), np.nan) if records.level is None else records.level
    unknown = np.isnan(factor) & ~np.isnan(level)
    if unknown.any():
        name = records.records[int(np.argmax(unknown))].name
        raise argument_error(
            "not_together",
            "records",
            f": '{name}' has a level and no factor: must have a factor, or no level (the attribute records of the set)",
        )
    return np.nan_to_num(factor, nan=1.0)


def checked_column(name: str, given: ArrayLike, length: int) -> FloatArray:
    """Positive numbers, one for each row; NaN where there is none."""
    values = np.full(length, as_number(name, given)) if np.ndim(given) == 0 else as_array(name, given).copy()
    if len(values) != length:
        raise argument_error("wrong_length", name, f": {len(values)} values for {length} records: must be as many")
    wrong = ~(np.isnan(values) | ((values > 0.0) & (values < np.inf)))
    if wrong.any():
        raise argument_error("out_of_range", name, f" = {values[wrong][0]:g}: must be positive")
    values.flags.writeable = False
    return values


def joined_columns(one: FloatArray | None, other: FloatArray | None, first: int, second: int) -> FloatArray:
    """A column of two sets; NaN where one lacks it."""
    parts = ((one, first), (other, second))
    return np.concatenate([np.full(length, np.nan) if values is None else values for values, length in parts])


def _numbers(texts: list[str]) -> NDArray[Any]:
    """Texts as numbers, NaN where there is nothing, if all others are numbers."""
    try:
        return np.array([float(text) if text else np.nan for text in texts])
    except ValueError:
        return np.array(texts)
