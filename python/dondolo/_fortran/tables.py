"""Columns of the tables of results, as the library has them, of results that Python has as objects."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from dondolo._base.arguments import FloatArray
from dondolo._fortran import _core
from dondolo._fortran.files import INTEGER, REAL, TEXT, Column
from dondolo._fortran.handles import Handle
from dondolo._fortran.library import Parcel, constants, receive, text_lines

#: A table of results
TableColumns = dict[str, Column]
IntArray = NDArray[np.integer[Any]]


class FlatCurve(NamedTuple):
    """A curve as the library takes it for a table.

    Attributes
    ----------
    numbers : tuple of float
        theta, beta, naive covariance (3), log likelihood, bracket (2), covariance (3), degrees of freedom, deviance
        and EDP threshold, 0 if it is not known.
    status, errors : str
    clusters, deviance_dof : int
    """

    numbers: tuple[float, ...]
    status: str
    errors: str
    clusters: int
    deviance_dof: int


def unpack_table(parcel: Parcel, name: str) -> TableColumns:
    """A table of a parcel; those of one parcel must be unpacked in their order, each once."""
    rows = parcel[f"{name}:rows"]
    columns: TableColumns = {}
    for head, kind in zip(parcel[name], parcel[f"{name}:kinds"].tolist(), strict=True):
        if kind == TEXT:
            columns[head] = Column(kind, parcel[f"{name}:{head}"])
            continue
        values = parcel.series(rows)
        values.flags.writeable = False
        columns[head] = Column(kind, values)
    return columns


def wall_columns(
    walls: Handle, words: Iterable[tuple[str, str, str, str]], weights: FloatArray, p_occ: FloatArray
) -> TableColumns:
    """Columns of ``_walls.csv``; words are group, facade, occurrence and alternative of each wall."""
    texts = text_lines(word for own in words for word in own)
    return _receive(_core.tables.wall_table(walls.number, texts, np.stack([weights, p_occ])))


def history_columns(
    texts: Iterable[str], im: str, integers: Sequence[Any], reals: Sequence[Any], has: tuple[bool, bool, bool]
) -> TableColumns:
    """Columns of ``_histories.csv``; texts, numbers and what they have as tables.f90 lists them."""
    flags = np.array(has, dtype=np.int32)
    numbers = np.array(integers), np.array(reals)
    return _receive(_core.tables.history_table(text_lines(texts), im.encode(), *numbers, flags))


def stripe_columns(
    walls: Iterable[tuple[str, str]],
    im: str,
    levels: FloatArray,
    thresholds: FloatArray,
    histories: IntArray,
    reached: IntArray,
    uplift: IntArray | None = None,
) -> TableColumns:
    """Columns of ``_stripes.csv``.

    Walls are names and mechanisms; histories are (levels, walls), those that reach states (states, levels, walls).
    Uplift, (levels,), is that of one wall.
    """
    more = np.zeros(len(levels), dtype=np.int32) if uplift is None else uplift
    counts = reached.transpose(1, 0, 2)
    return _receive(
        _core.tables.stripe_table(
            _pairs(walls), im.encode(), levels, thresholds, histories, counts, more, uplift is not None
        )
    )


def fragility_columns(
    walls: Iterable[tuple[str, str]], ims: Iterable[str], curves: Sequence[FlatCurve]
) -> TableColumns:
    """Columns of ``_fragility.csv``."""
    words = (
        word
        for (name, mechanism), im, curve in zip(walls, ims, curves, strict=True)
        for word in (name, mechanism, im, curve.errors)
    )
    return _receive(_core.tables.fragility_table(text_lines(words), *flat_curves(curves)))


def typology_columns(
    parts: Iterable[tuple[str, str]],
    im: str,
    levels: FloatArray,
    curves: Sequence[FlatCurve],
    sums: Sequence[Sequence[float]],
    means: Sequence[FloatArray],
) -> TableColumns:
    """Columns of ``_typology.csv``.

    Of each curve mechanism and group; weight, both dispersions, saturation and share that is fitted; and (5, levels)
    mean fraction, mean curve and fractiles.
    """
    words = (word for part, curve in zip(parts, curves, strict=True) for word in (*part, curve.errors))
    flat = np.array(sums).T, np.array(means).T
    return _receive(_core.tables.typology_table(text_lines(words), im.encode(), levels, *flat_curves(curves), *flat))


def union_columns(
    names: Iterable[tuple[str, str]],
    im: str,
    levels: FloatArray,
    mechanisms: Sequence[int],
    curves: Sequence[tuple[FlatCurve, FlatCurve]],
    counts: Sequence[FloatArray],
) -> TableColumns:
    """Columns of ``_unions.csv``.

    Of each union name and group, how many mechanisms (0 for a mean), its curve and that of the product, and (4, levels)
    histories, collapses and both fractions.
    """
    words = (word for name, both in zip(names, curves, strict=True) for word in (*name, *(one.errors for one in both)))
    numbers = np.array(mechanisms, dtype=np.int32)
    flat = (*_flat_pairs(curves), np.array(counts).T)
    return _receive(_core.tables.union_table(text_lines(words), im.encode(), levels, numbers, *flat))


def tie_columns(
    walls: Iterable[tuple[str, str]],
    im: str,
    levels: FloatArray,
    ties: Sequence[int],
    histories: IntArray,
    counts: IntArray,
    elongations: FloatArray,
) -> TableColumns:
    """Columns of ``_ties.csv``.

    Histories are (levels, walls); counts and elongations (2, n) of all ties of all levels of all walls.
    """
    numbers = np.array(ties, dtype=np.int32)
    return _receive(_core.tables.tie_table(_pairs(walls), im.encode(), levels, numbers, histories, counts, elongations))


def design_columns(
    names: Iterable[str], im: str, curves: Sequence[FlatCurve], numbers: Sequence[FloatArray]
) -> TableColumns:
    """Columns of ``_designs.csv``; numbers as tables.f90 lists them, NaN for none."""
    words = (word for name, curve in zip(names, curves, strict=True) for word in (name, curve.errors))
    flat = (*flat_curves(curves), np.nan_to_num(numbers))
    return _receive(_core.tables.design_table(text_lines(words), im.encode(), *flat))


def source_columns(
    sources: Iterable[tuple[str, str]],
    values: FloatArray,
    curves: Sequence[tuple[FlatCurve, FlatCurve]],
    indices: Sequence[FloatArray],
) -> TableColumns:
    """Columns of ``_sources.csv``.

    Of each source name and distribution, three fractiles, the curves at the outer ones, and Sobol indices with bounds.
    """
    words = (
        word for names, both in zip(sources, curves, strict=True) for word in (*names, *(one.errors for one in both))
    )
    return _receive(_core.tables.source_table(text_lines(words), values.T, *_flat_pairs(curves), np.array(indices)))


def trace_columns(reals: Sequence[Any], side: Any, after_impact: Any, capacity: float) -> TableColumns:
    """Columns of ``_history.csv``; the first are time, acceleration, rotation and velocity."""
    integers = np.array([side, after_impact], dtype=np.int32).T
    return _receive(_core.tables.trace_table(np.array(reals).T, integers, capacity))


def plain(columns: TableColumns) -> dict[str, Any]:
    """Columns as lists and arrays, integers where numbers are; None in the place of an integer that is missing."""
    return {name: _plain(*column) for name, column in columns.items()}


def _plain(kind: int, values: Any) -> Any:
    if kind in (TEXT, REAL):
        return values
    if kind == INTEGER and np.isfinite(values).all():
        return values.astype(np.int64)
    return [None if one != one else int(one) if one.is_integer() else one for one in values.tolist()]


def _receive(sent: NDArray[np.int64]) -> TableColumns:
    return unpack_table(receive(sent), "table")


def _pairs(walls: Iterable[tuple[str, str]]) -> bytes:
    return text_lines(word for wall in walls for word in wall)


def flat_curves(curves: Sequence[FlatCurve]) -> tuple[FloatArray, NDArray[np.int32]]:
    """Numbers (14, curves) and codes (3, curves)."""
    names = constants().statuses
    codes = [(names.index(curve.status) + 1, curve.clusters, curve.deviance_dof) for curve in curves]
    return np.array([curve.numbers for curve in curves]).T, np.array(codes, dtype=np.int32).T


def _flat_pairs(curves: Sequence[tuple[FlatCurve, FlatCurve]]) -> tuple[FloatArray, NDArray[np.int32]]:
    """The same of pairs: (14, 2, pairs) and (3, 2, pairs)."""
    numbers, codes = flat_curves([curve for both in curves for curve in both])
    return numbers.reshape(14, -1, 2).transpose(0, 2, 1), codes.reshape(3, -1, 2).transpose(0, 2, 1)
