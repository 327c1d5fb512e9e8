"""Result files, read back into objects."""

from __future__ import annotations

import os
import re
from collections.abc import Sequence
from dataclasses import dataclass, fields, replace
from datetime import datetime
from typing import Any

import numpy as np

from dondolo._base.files import as_file
from dondolo._fortran import _binding
from dondolo.analysis.response import Response
from dondolo.analysis.stripes import Stripes
from dondolo.analysis.work import Work
from dondolo.curves.fragility import Fragility
from dondolo.errors import InputError
from dondolo.exchange.result_file import ResultFile
from dondolo.populations.combination import combine
from dondolo.populations.typology import Typology
from dondolo.records.record import Record
from dondolo.walls.population import Population
from dondolo.walls.wall import MECHANISMS, Wall

# Columns of _walls.csv and the numbers of a wall
_WALL_COLUMNS = {row.column: row.name for row in _binding.WALL_PROPERTIES if row.column and row.kind != "text"}


@dataclass(frozen=True)
class StoredResults:
    """What the result files of one run hold; what its task does not make is None.

    Attributes
    ----------
    population : Population
        The walls and their weights.
    response : Response or None
        Task 'history'.
    stripes, fragility : Stripes, Fragility or None
        Task 'stripes'.
    typology : Typology or None
        Task 'typology'.
    comments : tuple of str
        Head of the files: versions, the case with all its variables, counts of the work, warnings of the run.
    written : datetime or None
        When the file of the walls was last written.
    """

    population: Population
    response: Response | None = None
    stripes: Stripes | None = None
    fragility: Fragility | None = None
    typology: Typology | None = None
    comments: tuple[str, ...] = ()
    written: datetime | None = None

    @property
    def edp_thresholds(self) -> list[float]:
        """Damage states that the case of a wall names [rotation / capacity], if there are several."""
        line = next((line for line in self.comments if line.startswith("edp_thresholds = ")), "")
        values = [float(value) for value in re.findall(r"[0-9][-+0-9.eE]*", line)]
        return values if len(values) > 1 else []


def read_results(prefix: str | os.PathLike[str]) -> StoredResults:
    """Read the result files of the executable, or those that `Typology.save` wrote.

    Parameters
    ----------
    prefix : path
        What their names begin with: `output` of the case, for example ``out/parapet``.

    Returns
    -------
    StoredResults
        The same objects as those of a run in Python; curves are fitted again, to the same counts.

    Raises
    ------
    InputError
        They are not result files of dondolo; the file and the line are named.
    MissingFileError
        There are no such files.
    """
    as_file("prefix", prefix)
    prefix = os.fspath(prefix)
    walls = ResultFile(prefix + "_walls.csv")
    written = datetime.fromtimestamp(os.path.getmtime(walls.path)).astimezone()
    with walls.reading():
        population = _population(walls)
        # The files of another task may lie there from a run before: the walls' file tells the task of the last.
        task = walls.word(r"&job task = '(\w+)'", "")
        edp_limit = walls.setting("edp_limit", 1.0)
    stored = StoredResults(population, comments=tuple(walls.comments), written=written)
    if task == "history":
        history = ResultFile(prefix + "_history.csv")
        with history.reading():
            return replace(stored, response=_response(history, population.walls[0], edp_limit))
    if task == "stripes":
        histories = ResultFile(prefix + "_histories.csv")
        with histories.reading():
            stripes = _stripes(histories, population.walls[0])
        return replace(stored, stripes=stripes, fragility=stripes.fit())
    counts = ResultFile(prefix + "_stripes.csv")
    with counts.reading():
        return replace(stored, typology=_typology(counts, population))


def heads(start: str, comments: Sequence[str]) -> list[str]:
    """What stands in the comments after a word."""
    return [line[len(start) :].strip() for line in comments if line.startswith(start)]


def _work(comments: list[str]) -> Work:
    """What was computed, out of the comments."""
    for comment in comments:
        if comment.startswith("work:"):
            counts = {name: int(count) for name, count in re.findall(r"(\w+) = (\d+)", comment)}
            if counts.keys() <= {field.name for field in fields(Work)}:
                return Work(**counts)
    raise ValueError("no comment '# work:' with its counts")


def _population(table: ResultFile) -> Population:
    """Walls as they were given."""
    gravity = table.setting("gravity", 9.81)
    walls: list[Wall] = []
    for i, (name, kind) in enumerate(zip(table.texts("wall"), table.texts("mechanism"), strict=True)):
        given: dict[str, Any] = {
            argument: table.number(column, i) for column, argument in _WALL_COLUMNS.items() if table.texts(column)[i]
        }
        try:
            if kind not in MECHANISMS:
                raise InputError(f"mechanism = {kind!r}: must be one of {', '.join(map(repr, MECHANISMS))}")
            restitution = table.texts("restitution_model")[i]
            walls.append(MECHANISMS[kind](name=name, restitution=restitution, gravity=gravity, **given))
        except (TypeError, ValueError) as error:
            raise ValueError(f"{table.place(i)}: {error}") from error
    weights, p_occ = table.numbers("weight"), table.numbers("p_occ")
    return Population(tuple(walls), weights, tuple(table.texts("group")), p_occ)


def _response(table: ResultFile, wall: Wall, edp_limit: float) -> Response:
    """A motion; its record is what the history shows of it."""
    time, acceleration = table.numbers("time_s"), table.numbers("ground_acceleration_m_s2")
    rotation, velocity = table.numbers("rotation_rad"), table.numbers("velocity_rad_s")
    scale = table.setting("scale", 1.0)
    # Rows stand at every sample and at impacts in between: the samples are the multiples of the commonest step.
    with np.errstate(over="ignore"):
        steps, counts = np.unique(np.round(np.diff(time), 9), return_counts=True)
    if not np.any(steps > 0.0) or scale == 0.0:
        raise ValueError("no motion: time_s must increase, and scale must not be 0")
    dt = float(steps[np.argmax(np.where(steps > 0.0, counts, 0))])
    at_sample = np.abs(time / dt - np.round(time / dt)) < 1e-6
    _, first = np.unique(np.round(time[at_sample] / dt), return_index=True)
    record = Record(acceleration[at_sample][first] / scale, dt, name=table.word("record:(.*)").strip())
    return Response(
        wall,
        record,
        scale,
        table.setting("edp", 0.0),
        table.setting("collapsed", 0.0) == 1.0,
        int(table.setting("impacts", 0.0)),
        table.setting("time_of_peak_s", 0.0),
        edp_limit,
        time,
        acceleration,
        rotation,
        velocity,
        table.numbers("side").astype(np.int8),
        table.numbers("after_impact") == 1.0,
        table.setting("edp_error", 0.0) if any(line.startswith("edp_error:") for line in table.comments) else None,
    )


def _stripes(table: ResultFile, wall: Wall) -> Stripes:
    """All histories of a wall."""
    levels = np.unique(table.numbers("im_level"))
    if len(table) % len(levels):
        raise ValueError(f"{len(table)} rows: must be as many at each of the {len(levels)} levels")
    shape = (len(levels), len(table) // len(levels))
    first = slice(0, shape[1])
    polarity = [-1 if word == "reversed" else 1 for word in table.texts("polarity")[first]]
    return Stripes(
        wall=wall,
        im=table.texts("im")[0],
        levels=levels,
        edp=table.numbers("edp").reshape(shape),
        collapsed=table.numbers("collapsed").reshape(shape) == 1.0,
        impacts=table.counts("impacts").reshape(shape),
        time_of_peak=table.numbers("time_of_peak_s").reshape(shape),
        scale=table.numbers("scale").reshape(shape),
        record_names=tuple(table.texts("record")[first]),
        polarity=np.asarray(polarity, dtype=np.int32),
        engine=table.word(r"&solver engine = '(\w+)'", "auto"),
        rtol=table.setting("rtol", np.nan),
        atol=table.setting("atol", np.nan),
        edp_limit=table.setting("edp_limit", 1.0),
        work=_work(table.comments),
        edp_error=table.numbers("edp_error").reshape(shape) if "edp_error" in table else None,
    )


def _typology(table: ResultFile, population: Population) -> Typology:
    """Counts of all walls of a population."""
    thresholds = np.unique(table.numbers("edp_threshold"))
    levels = np.unique(table.numbers("im_level"))
    shape = (len(population), len(thresholds), len(levels))
    if len(table) != np.prod(shape):
        product = " x ".join(map(str, shape))
        raise ValueError(f"{len(table)} rows: must be {product}, one for each wall, damage state and level")
    counts = table.counts("collapses").reshape(shape).transpose(1, 2, 0)
    histories = table.counts("histories", 1).reshape(shape)[:, 0, 0]
    everyone = np.ones(len(population), dtype=bool)
    im = table.texts("im")[0]
    result = combine(population, im, levels, thresholds, counts, histories, everyone, _work(table.comments))
    return replace(result, warnings=tuple(dict.fromkeys([*heads("warning:", table.comments), *result.warnings])))
