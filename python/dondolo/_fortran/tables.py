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
from dondolo._fortran.library import Parcel, receive, text_lines

#: A table of results
TableColumns = dict[str, Column]
IntArray = NDArray[np.integer[Any]]


class FlatCurve(NamedTuple):
    """A curve as a table takes it.

    Covariances are those of (ln theta, beta): both variances and what is between, naive and of the kind `errors`;
    `edp_threshold` is 0 if not known.
    """

    status: str
    errors: str
    theta: float
    beta: float
    naive_11: float
    naive_12: float
    naive_22: float
    log_likelihood: float
    bracket_low: float
    bracket_high: float
    covariance_11: float
    covariance_12: float
    covariance_22: float
    degrees_of_freedom: float
    deviance: float
    deviance_dof: int
    clusters: int
    edp_threshold: float


def unpack_table(parcel: Parcel, name: str) -> TableColumns:
    """A table of a parcel; those of one parcel must be unpacked in their order, each once."""
    rows = parcel[f"{name}:rows"]
    columns: TableColumns = {}
    for number, (head, kind) in enumerate(zip(parcel[name], parcel[f"{name}:kinds"].tolist(), strict=True), 1):
        values = parcel.series(rows)
        if kind == TEXT:
            # Texts that differ come once.
            words = np.array(parcel[f"{name}:{number}"], dtype=np.object_)
            columns[head] = Column(kind, words[values.astype(np.intp) - 1].tolist())
            continue
        values.flags.writeable = False
        columns[head] = Column(kind, values)
    return columns


def wall_columns(
    walls: Handle, words: Iterable[Sequence[str]], notes: Sequence[str], weights: FloatArray, p_occ: FloatArray
) -> TableColumns:
    """Columns of ``_walls.csv``; words are group, facade, occurrence, alternative and notes of each wall."""
    texts = text_lines(word for own in words for word in own)
    return _receive(_core.tables.wall_table(walls.number, texts, text_lines(notes), np.stack([weights, p_occ])))


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
    words = (word for wall, im in zip(walls, ims, strict=True) for word in (*wall, im))
    return _receive(_core.tables.fragility_table(text_lines(words), **flat_curves(curves)))


def typology_columns(
    parts: Iterable[tuple[str, str]],
    im: str,
    levels: FloatArray,
    curves: Sequence[FlatCurve],
    sums: Sequence[Sequence[float]],
    means: Sequence[FloatArray],
) -> TableColumns:
    """Columns of ``_typology.csv``.

    Of each curve mechanism and group; weight, both dispersions, upper asymptote and fitted share; and (5, levels)
    mean fraction, mean curve and fractiles.
    """
    flat = np.array(sums).T, np.array(means).T
    return _receive(_core.tables.typology_table(_pairs(parts), im.encode(), levels, *flat, **flat_curves(curves)))


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
    flat = np.array(mechanisms, dtype=np.int32), np.array(counts).T
    return _receive(_core.tables.union_table(_pairs(names), im.encode(), levels, *flat, **_flat_pairs(curves)))


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
    numbers = {what: np.nan_to_num(values) for what, values in columns.items()}
    return _receive(_core.tables.design_table(text_lines(names), im.encode(), **flat_curves(curves), **numbers))


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
    return _receive(_core.tables.source_table(_pairs(sources), values.T, **_flat_pairs(curves), **indices))


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


def _pairs(words: Iterable[tuple[str, str]]) -> bytes:
    return text_lines(word for both in words for word in both)


def flat_curves(curves: Sequence[FlatCurve]) -> dict[str, Any]:
    """Curves as Fortran takes them, under the names of its arguments."""
    _, _, *names = FlatCurve._fields
    return {
        "curve_names": text_lines(names),
        "curve_texts": text_lines(word for curve in curves for word in (curve.status, curve.errors)),
        "curve_numbers": np.array([curve[2:] for curve in curves]).T,
    }


def _flat_pairs(curves: Sequence[tuple[FlatCurve, FlatCurve]]) -> dict[str, Any]:
    return flat_curves([curve for both in curves for curve in both])
