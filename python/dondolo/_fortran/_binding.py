"""The only module that touches the Fortran extension.

Statuses become exceptions with the sentence of the executable, parcels become arrays, and arrays become contiguous
float64 before they cross.
"""

from __future__ import annotations

import functools
import json
import os
import sys
import threading
import warnings
from collections.abc import Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from dondolo._base.arguments import FloatArray, as_array, as_number, as_path, as_text
from dondolo._fortran import _core
from dondolo._fortran.handles import Handle
from dondolo.errors import DondoloError, DondoloWarning, InputError, MissingFileError

_PACKAGE = str(Path(__file__).parents[1]) + os.sep


class Constants(NamedTuple):
    """What Fortran says of itself."""

    rtol: float
    atol: float
    edp_limit: float
    gravity: float
    version: str
    statuses: tuple[str, ...]
    errors: tuple[str, ...]


class Property(NamedTuple):
    """A property of walls, or of another group, as Fortran's table has it.

    Attributes
    ----------
    name : str
        As in namelists and in Python.
    kind : str
        'real', 'integer', 'text', 'logical', 'list' or 'either'.
    unit : str
        '' for a number.
    default : str
        As in a namelist; 'required', or 'optional' where there is none.
    smallest, largest : float
        Range of a number.
    bounds : str
        'positive' for a number greater than 0, 'less' for one less than the largest.
    choices, owners : tuple of str
        What a text can be; the mechanisms that have it, () for all.
    column : str
        Its column in the tables of results.
    meaning : str
        One sentence.
    """

    name: str
    kind: str
    unit: str
    default: str
    smallest: float
    largest: float
    bounds: str
    choices: tuple[str, ...]
    owners: tuple[str, ...]
    column: str
    meaning: str


class FlatWall(NamedTuple):
    """A wall, or several, as Fortran takes them."""

    texts: bytes
    numbers: FloatArray
    given: NDArray[np.int32]
    gravity: Any


class WallData(NamedTuple):
    """A wall as Fortran has understood it."""

    properties: dict[str, Any]
    gravity: float
    statics: tuple[float, ...]
    two_sided: bool


class RecordData(NamedTuple):
    """A record as Fortran has read it."""

    name: str
    dt: float
    acceleration: FloatArray
    metadata: dict[str, str]


class MeasureData(NamedTuple):
    """An intensity measure.

    Attributes
    ----------
    name : str
        As dondolo writes it.
    unit : str
        Of its levels; '' for a number.
    title : str
        What it is, in words.
    power : int
        Power of a record's scale that it grows by.
    """

    name: str
    unit: str
    title: str
    power: int


class CurveData(NamedTuple):
    """A fitted curve, or why there is none."""

    status: str
    numbers: FloatArray


class Parcel(NamedTuple):
    """Contents that came from Fortran."""

    integers: NDArray[np.int32]
    reals: FloatArray
    lines: list[str]


class FlatPopulation(NamedTuple):
    """A population as Fortran takes it, with the counts of one damage state.

    Attributes
    ----------
    texts : bytes
        Mechanism and group of each row, a line each.
    levels : ndarray, shape (levels,)
    counts : ndarray of int, shape (levels, rows)
    histories : ndarray of int, shape (rows,)
    shares : ndarray, shape (2, rows)
        Weight of the wall and probability of occurrence.
    rows : ndarray of int, shape (walls,)
        How many each wall has.
    """

    texts: bytes
    levels: FloatArray
    counts: NDArray[np.int32]
    histories: NDArray[np.int32]
    shares: FloatArray
    rows: NDArray[np.int32]


class GroupData(NamedTuple):
    """A curve of a population, or of one of its groups."""

    group: str
    mechanism: str
    walls: int
    weight: float
    beta_walls: float
    beta_records: float
    fitted: float
    saturation: float
    histories: float
    mean_fraction: FloatArray
    mean_curve: FloatArray
    fractiles: FloatArray
    curve: CurveData


class PopulationData(NamedTuple):
    """Curves of mechanisms, of walls and of their population; fractions are those of the walls (walls, levels)."""

    rows: list[CurveData]
    walls: list[CurveData]
    fractions: FloatArray
    groups: list[GroupData]
    warnings: list[DondoloWarning]


@functools.cache
def constants() -> Constants:
    """Ask Fortran for its version, defaults and the names of its statuses."""
    defaults, version, statuses, errors = _core.library.constants()
    rtol, atol, edp_limit, gravity = (float(value) for value in defaults)
    return Constants(
        rtol,
        atol,
        edp_limit,
        gravity,
        version=version.decode().strip(),
        statuses=tuple(statuses.decode().split()),
        errors=tuple(errors.decode().split()),
    )


@functools.cache
def properties(group: str) -> tuple[Property, ...]:
    """The table of properties of a group of a case ('wall', 'solver' ...), or of rows of a population ('member')."""
    rows = (line.split("\t") for line in receive(*_core.library.properties(group.encode())).lines)
    return tuple(
        Property(
            name,
            kind,
            unit,
            default,
            float(smallest),
            float(largest),
            bounds,
            tuple(choices.split()),
            tuple(owners.split()),
            column,
            meaning,
        )
        for name, kind, unit, default, smallest, largest, bounds, choices, owners, column, meaning in rows
    )


def build_variant() -> str:
    """The build variant that the engine lanes runs here.

    Returns
    -------
    str
        "baseline", "avx2" or "avx512", the best that the processor can run, or what the environment variable
        DONDOLO_VARIANT names; "native" in a build for one processor. Variants differ by rounding only.

    Raises
    ------
    InputError
        DONDOLO_VARIANT names none that this build and this processor have.
    """
    name, stat, message = _core.library.variant()
    check(stat, message)
    return str(name.decode().strip())


def check(stat: int, message: bytes) -> None:
    """Raise what a status says."""
    if stat == 0:
        return
    sentence = message.decode("utf-8", "replace").strip()
    raise {2: InputError, 3: MissingFileError, 4: MemoryError}.get(stat, DondoloError)(sentence)


@contextmanager
def stoppable() -> Iterator[None]:
    """Let Ctrl-C stop what Fortran computes; Python hears of it in its main thread alone."""
    if threading.current_thread() is not threading.main_thread():
        yield
        return
    _core.library.listen()
    try:
        yield
    finally:
        _core.library.end_listening()


# OpenMP's threads do not survive a fork: a process that is made by one works with the thread that it has.
os.register_at_fork(after_in_child=_core.library.work_alone)


def receive(sent: NDArray[np.int64], stat: int, message: bytes) -> Parcel:
    """Take the parcel that a procedure has sent: its address and sizes."""
    check(stat, message)
    integers, reals, characters = _core.library.take_parcel(*sent)
    text = characters.astype(np.uint8).tobytes().decode("utf-8", "replace")
    return Parcel(integers, reals, text.split("\n")[:-1])


def unpack_warning(data: dict[str, Any]) -> DondoloWarning:
    """A warning of Fortran, from its JSON object."""
    return DondoloWarning(str(data["sentence"]), str(data["code"]), data["subject"], data["numbers"])


def unpack_warnings(lines: Iterable[str]) -> list[DondoloWarning]:
    """Warnings of Fortran, a JSON object on each line."""
    return [unpack_warning(json.loads(line)) for line in lines]


def warn_of_notes(sentences: Iterable[str]) -> None:
    """Warn of how a table was read."""
    warn(DondoloWarning(sentence, "note") for sentence in sentences)


def warn(found: Iterable[DondoloWarning]) -> None:
    """Warn of each, where the user's own line is."""
    frame, depth = sys._getframe(), 1
    while frame.f_back is not None and frame.f_code.co_filename.startswith(_PACKAGE):
        frame, depth = frame.f_back, depth + 1
    for one in found:
        warnings.warn(one, stacklevel=depth)


def settings(
    rtol: float | None,
    atol: float | None,
    edp_limit: float | None,
    estimate_error: bool = False,
    collapses_only: bool = False,
) -> FloatArray:
    """rtol, atol and edp_limit, with Fortran's own defaults where there is None, and 1 or 0 for each of the others."""
    if rtol is None and atol is None and edp_limit is None and not estimate_error and not collapses_only:
        return _default_settings()
    default = constants()
    return np.array(
        [
            default.rtol if rtol is None else as_number("rtol", rtol),
            default.atol if atol is None else as_number("atol", atol),
            default.edp_limit if edp_limit is None else as_number("edp_limit", edp_limit),
            float(bool(estimate_error)),
            float(bool(collapses_only)),
        ]
    )


@functools.cache
def _default_settings() -> FloatArray:
    default = constants()
    return np.array([default.rtol, default.atol, default.edp_limit, 0.0, 0.0])


def flat_wall(values: Mapping[str, Any], gravity: float) -> FlatWall:
    """A wall as Fortran takes it, of properties that it has checked."""
    numbers = [values.get(what) for what in WALL_NUMBERS]
    return FlatWall(
        "\n".join(values.get(what) or "" for what in WALL_TEXTS).encode(),
        np.array([0.0 if value is None else value for value in numbers]),
        np.array([value is not None for value in numbers], dtype=np.int32),
        gravity,
    )


def describe_wall(values: Mapping[str, Any], gravity: Any) -> WallData:
    """Let Fortran check a wall, fill in its defaults and compute its static quantities."""
    several = {
        what: [value if what in WALL_TEXTS else as_number(what, value)]
        for what, value in values.items()
        if value is not None
    }
    pull = constants().gravity if gravity is None else as_number("gravity", gravity)
    return describe_walls(1, several, [pull])[0]


def describe_walls(count: int, values: Mapping[str, Any], gravity: ArrayLike) -> list[WallData]:
    """The same for many walls: values of each property for all of them; what is None or not there gets its default."""
    shape = (count, len(WALL_NUMBERS))
    numbers, given = np.zeros(shape), np.zeros(shape, dtype=np.int32)
    for i, what in enumerate(WALL_NUMBERS):
        if what in values:
            given[:, i] = [value is not None for value in values[what]]
            numbers[:, i] = [0.0 if value is None else value for value in values[what]]
    nothing = [None] * count
    texts = b"\n".join(
        b"" if text is None else as_text(what, text)
        for wall in zip(*(values.get(what, nothing) for what in WALL_TEXTS), strict=True)
        for what, text in zip(WALL_TEXTS, wall, strict=True)
    )
    return unpack_walls(receive(*_core.walls.describe_walls(texts, numbers.T, given.T, gravity)), count)


def wall_terms(wall: Handle, rotation: ArrayLike) -> FloatArray:
    """J, C, G, L, Q and V of a wall, one row each, in the shape of the rotations."""
    try:
        values, shape = np.ravel(rotation), np.shape(rotation)
    except ValueError:
        raise InputError("rotation: must be numbers") from None
    terms, stat, message = _core.walls.wall_terms(wall.number, as_array("rotation", values))
    check(stat, message)
    found: FloatArray = terms.T.reshape(6, *shape)
    return found


def unpack_walls(parcel: Parcel, count: int, reals: int = 0, integers: int = 0, lines: int = 0) -> list[WallData]:
    """Walls out of a parcel, from given places on."""
    known, words = len(WALL_NUMBERS), len(WALL_TEXTS)
    rows = parcel.reals[reals : reals + count * _WALL_REALS].reshape(count, _WALL_REALS).tolist()
    masks = parcel.integers[integers : integers + count * _WALL_INTEGERS].reshape(count, _WALL_INTEGERS).tolist()
    return [
        WallData(
            dict(zip(WALL_TEXTS, parcel.lines[lines + words * i : lines + words * (i + 1)], strict=True))
            | {what: row[k] if given[k] else None for k, what in enumerate(WALL_NUMBERS)},
            row[known],
            tuple(row[known + 1 :]),
            bool(given[known]),
        )
        for i, (row, given) in enumerate(zip(rows, masks, strict=True))
    ]


def walls_end(count: int) -> tuple[int, int, int]:
    """How many reals, integers and lines of a parcel so many walls take."""
    return count * _WALL_REALS, count * _WALL_INTEGERS, len(WALL_TEXTS) * count


def unpack_records(parcel: Parcel, count: int, reals: int = 0, integers: int = 0, lines: int = 0) -> list[RecordData]:
    """Records out of a parcel, from given places on."""
    lengths = parcel.integers[integers : integers + count]
    entries = parcel.integers[integers + count : integers + 2 * count]
    ends = reals + count + np.cumsum(lengths)
    ends_of_metadata = lines + count + 2 * np.cumsum(entries)
    records = []
    for i in range(count):
        words = parcel.lines[ends_of_metadata[i] - 2 * entries[i] : ends_of_metadata[i]]
        records.append(
            RecordData(
                parcel.lines[lines + i],
                float(parcel.reals[reals + i]),
                parcel.reals[ends[i] - lengths[i] : ends[i]],
                dict(zip(words[::2], words[1::2], strict=True)),
            )
        )
    return records


def records_end(parcel: Parcel, count: int, integers: int = 0, lines: int = 0) -> int:
    """Line of a parcel after its records."""
    return lines + count + 2 * int(parcel.integers[integers + count : integers + 2 * count].sum())


def join_walls(walls: Sequence[FlatWall]) -> FlatWall:
    """Several walls, one after the other."""
    return FlatWall(
        b"\n".join(wall.texts for wall in walls),
        np.stack([wall.numbers for wall in walls]).T,
        np.stack([wall.given for wall in walls]).T,
        np.array([wall.gravity for wall in walls]),
    )


def read_records(
    path: str | os.PathLike[str],
    what: int,
    dt: float | None = None,
    units: str | None = None,
    channel: str | None = None,
    layout: str | None = None,
) -> list[RecordData]:
    """Read one channel of a file (what = 0), all records of a catalogue (1), or all channels of a file (2)."""
    step = 0.0 if dt is None else as_number("dt", dt)
    texts = (
        b"" if text is None else as_text(name, text)
        for name, text in (("units", units), ("channel", channel), ("format", layout))
    )
    parcel = receive(*_core.records.read_records(as_path(path), what, int(dt is not None), step, *texts))
    count = len(parcel.integers) // 2
    warn_of_notes(parcel.lines[records_end(parcel, count) :])
    return unpack_records(parcel, count)


def read_number_table(path: str | os.PathLike[str]) -> tuple[list[str], FloatArray]:
    """Read a table of numbers: the names of its columns, and its numbers (rows, columns)."""
    parcel = receive(*_core.records.read_number_table(as_path(path)))
    columns, rows = (int(count) for count in parcel.integers)
    warn_of_notes(parcel.lines[columns:])
    return parcel.lines[:columns], parcel.reals.reshape(rows, columns)


def catalogue_table(path: str | os.PathLike[str]) -> list[str]:
    """The table of the records of a catalogue, as the executable prints it."""
    parcel = receive(*_core.records.catalogue_table(as_path(path), constants().gravity))
    lines = int(parcel.integers[0])
    warn_of_notes(parcel.lines[lines:])
    return parcel.lines[:lines]


def read_walls(
    path: str | os.PathLike[str], gravity: float | None
) -> tuple[list[WallData], FloatArray, list[str], FloatArray]:
    """Read a population: its walls, their weights and groups, and the probabilities of their mechanisms."""
    pull = constants().gravity if gravity is None else as_number("gravity", gravity)
    parcel = receive(*_core.walls.read_walls(as_path(path), pull))
    count = len(parcel.integers) // _WALL_INTEGERS
    weights, p_occ = parcel.reals[count * _WALL_REALS :].reshape(2, count)
    groups = len(WALL_TEXTS) * count
    warn_of_notes(parcel.lines[groups + count :])
    return unpack_walls(parcel, count), weights, parcel.lines[groups : groups + count], p_occ


def describe_measure(im: str, of_record: bool = False) -> MeasureData:
    """A measure that records can be scaled by, or one that they have of themselves."""
    return _describe_measure(as_text("im", im), of_record)


@functools.cache
def _describe_measure(im: bytes, of_record: bool) -> MeasureData:
    parcel = receive(*_core.records.describe_measure(im, int(of_record)))
    name, unit, title = parcel.lines
    return MeasureData(name, unit, title, int(parcel.integers[0]))


def unit_of(im: str) -> str:
    """The unit of the levels of a measure; '' for a number, and for a name that dondolo does not know."""
    try:
        return describe_measure(im).unit
    except InputError:
        return ""


def fit_curves(levels: FloatArray, collapses: FloatArray, histories: FloatArray) -> tuple[FloatArray, list[str]]:
    """Fit many curves in one call: collapses and histories are (curves, levels)."""
    z, n = np.ascontiguousarray(collapses), np.ascontiguousarray(histories)
    curves, codes, stat, message = _core.curves.fit_curves(levels, z.T, n.T)
    check(stat, message)
    names = constants().statuses
    return curves.T, [names[code - 1] for code in codes]


def cluster_changes(
    levels: FloatArray, collapses: FloatArray, histories: FloatArray, theta: float, beta: float
) -> tuple[FloatArray, str]:
    """Changes (clusters, 2) of ln theta and beta if each cluster is left out, and what standard errors there are.

    Collapses and histories are (clusters, levels).
    """
    changes, code, stat, message = _core.curves.cluster_changes(levels, collapses.T, histories.T, theta, beta)
    check(stat, message)
    return changes.T, constants().errors[code - 1]


def cluster_curves(
    levels: FloatArray, collapses: FloatArray, histories: FloatArray, curves: Sequence[tuple[str, float, float]]
) -> tuple[FloatArray, list[str], NDArray[np.int32]]:
    """Covariances (curves, 2, 2) of many curves, what standard errors each has, and its number of clusters.

    Collapses are (curves, clusters, levels), histories, the same for all curves, (clusters, levels).
    """
    names, known = constants().statuses, constants().errors
    numbers = np.zeros((len(curves), 8))
    numbers[:, :2] = [(theta, beta) for _, theta, beta in curves]
    codes = np.array([names.index(status) + 1 for status, *_ in curves], dtype=np.int32)
    found = _core.curves.cluster_curves(levels, collapses.T, histories.T[..., None], numbers.T, codes)
    covariances, errors, clusters, stat, message = found
    check(stat, message)
    return covariances[[[0, 1], [1, 2]]].transpose(2, 0, 1), [known[code - 1] for code in errors], clusters


def fit_walls(names: bytes, population: FlatPopulation) -> PopulationData:
    """Curves of the mechanisms of walls, of the walls and of their population, and warnings.

    Names are those of the wall of each row, one a line.
    """
    parcel = receive(*_core.curves.fit_walls(population.texts, names, *population[1:]))
    levels, histories, rows = population.levels, population.histories, population.rows
    m, r, w, number = len(levels), len(histories), len(rows), int(parcel.integers[0])
    known = ("", *constants().statuses)
    status = [known[code] for code in parcel.integers[1 : 1 + r + w + number]]
    walls = parcel.integers[1 + r + w + number :]
    numbers, fractions, groups = np.split(parcel.reals, np.cumsum([8 * (r + w), m * w]))
    curves = [CurveData(*pair) for pair in zip(status, numbers.reshape(r + w, 8), strict=False)]
    together = []
    for i, row in enumerate(groups.reshape(number, 6 + 5 * m + 8)):
        mean_fraction, mean_curve, fractiles, curve = np.split(row[6:], np.cumsum([m, m, 3 * m]))
        together.append(
            GroupData(
                parcel.lines[2 * i],
                parcel.lines[2 * i + 1],
                int(walls[i]),
                float(row[0]),
                float(row[1]),
                float(row[2]),
                float(row[3]),
                float(row[4]),
                float(row[5]),
                mean_fraction,
                mean_curve,
                np.ascontiguousarray(fractiles.reshape(m, 3).T),
                CurveData(status[r + w + i], curve),
            )
        )
    found = unpack_warnings(parcel.lines[2 * number :])
    return PopulationData(curves[:r], curves[r:], fractions.reshape(w, m), together, found)


def curve_of_population(
    population: FlatPopulation,
    curves: Sequence[tuple[str, float, float]],
    which: tuple[str, str],
    x: FloatArray,
    q: FloatArray,
    members: bool = False,
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """A curve of a population at some levels: its mean, fractiles (q, x) and members' probabilities (members, x).

    Curves are status, theta and beta of each row; which: the mechanism, or 'all', and the group. The probabilities are
    there with `members` only.
    """
    statuses = constants().statuses
    numbers = np.zeros((len(curves), 8))
    numbers[:, :2] = [curve[1:] for curve in curves]
    codes = np.array([statuses.index(status) + 1 for status, *_ in curves], dtype=np.int32)
    texts = (as_text("group", text) for text in which)
    mean, fractiles, *sent = _core.curves.curve_of_population(*population, numbers.T, codes, *texts, x, q, int(members))
    check(*sent[1:])
    found = np.zeros((0, len(x)))
    if members:
        parcel = receive(*sent)
        found = parcel.reals.reshape(len(x), int(parcel.integers[0])).T
    return mean, fractiles, found


def in_series(probabilities: FloatArray, rows: NDArray[np.integer[Any]]) -> FloatArray:
    """Probability that any mechanism of each wall happens (walls, n), from those of all rows (rows, n)."""
    whole: FloatArray = _core.curves.in_series(np.ascontiguousarray(probabilities).T, rows.astype(np.int32)).T
    return whole


def warnings_of_curve(wall: Handle, levels: FloatArray, largest_edp: float, curve: CurveData) -> list[DondoloWarning]:
    """What the executable would warn of, of the curve of one wall."""
    code = constants().statuses.index(curve.status) + 1
    parcel = receive(*_core.curves.warn_of_curve(wall.number, levels, largest_edp, curve.numbers, code))
    return unpack_warnings(parcel.lines)


def warnings_of_motion(wall: Handle, record: str, pga: float) -> list[DondoloWarning]:
    """What the executable would warn of, of a wall and a record, before it runs one motion."""
    return unpack_warnings(receive(*_core.histories.warn_of_motion(wall.number, record.encode(), pga)).lines)


def warnings_of_errors(
    edp: FloatArray, edp_error: FloatArray, edp_limit: float, record: str = "", level: float = 0.0
) -> list[DondoloWarning]:
    """What the executable would warn of, of estimated errors; record and level are those of the largest.

    Without a record it is one history.
    """
    parcel = receive(*_core.histories.warn_of_errors(edp.ravel(), edp_error.ravel(), edp_limit, record.encode(), level))
    return unpack_warnings(parcel.lines)


def probability(theta: float, beta: float, x: FloatArray) -> FloatArray:
    """Probabilities of collapse of a lognormal curve."""
    found: FloatArray = _core.curves.probability(theta, beta, x)
    return found


# What walls are made of, in Fortran's order; gravity crosses by itself
WALL_PROPERTIES = properties("wall")
WALL_TEXTS = tuple(row.name for row in WALL_PROPERTIES if row.kind == "text")
WALL_NUMBERS = tuple(row.name for row in WALL_PROPERTIES if row.kind != "text")
_WALL_REALS = len(WALL_NUMBERS) + 7
_WALL_INTEGERS = len(WALL_NUMBERS) + 1
