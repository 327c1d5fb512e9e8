"""Columns of the tables of results, as the library has them, of results that Python has as objects."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
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


class TableNumbers(NamedTuple):
    """Numbers of a curve in the order in which a table takes them (as_curve in boundary.f90).

    Covariances are those of (ln theta, beta): both variances and what is between; `edp_threshold` is 0 if not known.
    """

    theta: float
    beta: float
    naive_11: float
    naive_12: float
    naive_22: float
    log_likelihood: float
    bracket_low: float
    bracket_high: float
    own_11: float
    own_12: float
    own_22: float
    degrees_of_freedom: float
    deviance: float
    edp_threshold: float


class FlatCurve(NamedTuple):
    """A curve as the library takes it for a table."""

    numbers: TableNumbers
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
    texts: Iterable[str], im: str, columns: Mapping[str, NDArray[Any]], has: Mapping[str, bool]
) -> TableColumns:
    """Columns of ``_histories.csv``; numbers and what they have under the names that tables.f90 has for them."""
    return _receive(_core.tables.history_table(text_lines(texts), im.encode(), **columns, **has))


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


class Safety(NamedTuple):
    """What the check of a design comes to, for its table; NaN for none.

    Attributes
    ----------
    activation, multiplier : float
        a_0* [m/s2] and alpha_0.
    linear, nonlinear : float
        Safety indices of SLV by both checks.
    years : float
        Return period of the capacity by the nonlinear check of SLV.
    bound : float
        Whether this is a bound: -1 an upper one, 1 a lower one, else 0.
    """

    activation: float = math.nan
    multiplier: float = math.nan
    linear: float = math.nan
    nonlinear: float = math.nan
    years: float = math.nan
    bound: float = math.nan


def design_columns(
    names: Iterable[str],
    im: str,
    curves: Sequence[FlatCurve],
    columns: Mapping[str, FloatArray],
    safety: Sequence[Safety],
) -> TableColumns:
    """Columns of ``_designs.csv``; numbers under the names that tables.f90 has for them, NaN for none."""
    columns = {**columns, **dict(zip(Safety._fields, np.array(safety).T, strict=True))}
    words = (word for name, curve in zip(names, curves, strict=True) for word in (name, curve.errors))
    numbers = {what: np.nan_to_num(values) for what, values in columns.items()}
    return _receive(_core.tables.design_table(text_lines(words), im.encode(), *flat_curves(curves), **numbers))


def source_columns(
    sources: Iterable[tuple[str, str]],
    values: FloatArray,
    curves: Sequence[tuple[FlatCurve, FlatCurve]],
    indices: Mapping[str, FloatArray],
) -> TableColumns:
    """Columns of ``_sources.csv``.

    Of each source name and distribution, three fractiles, the curves at the outer ones, and Sobol indices with their
    intervals under the names that tables.f90 has for them.
    """
    words = (
        word for names, both in zip(sources, curves, strict=True) for word in (*names, *(one.errors for one in both))
    )
    return _receive(_core.tables.source_table(text_lines(words), values.T, *_flat_pairs(curves), **indices))


def trace_columns(columns: Mapping[str, Any], capacity: float) -> TableColumns:
    """Columns of ``_history.csv``; numbers under the names that tables.f90 has for them."""
    return _receive(_core.tables.trace_table(**columns, capacity=capacity))


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
    return numbers.reshape(len(numbers), -1, 2).transpose(0, 2, 1), codes.reshape(3, -1, 2).transpose(0, 2, 1)
