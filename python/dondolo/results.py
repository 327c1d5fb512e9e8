"""Result files, read back into objects."""

from __future__ import annotations

import csv
import os
import re
from collections.abc import Sequence
from dataclasses import dataclass, replace
from datetime import datetime
from pathlib import Path
from typing import Any

import numpy as np

from dondolo._files import as_file
from dondolo.combination import combine
from dondolo.errors import InputError
from dondolo.fragility import Fragility
from dondolo.motion import Response
from dondolo.population import Population
from dondolo.records import Record
from dondolo.stripes import Stripes
from dondolo.typology import Typology
from dondolo.walls import MECHANISMS, Wall
from dondolo.work import Work

# Columns of _walls.csv and the arguments of a wall
_WALL_COLUMNS = {
    "height_m": "height",
    "thickness_m": "thickness",
    "density_kg_m3": "density",
    "hinge": "hinge",
    "restitution_value": "restitution_value",
    "restitution_factor": "restitution_factor",
    "overburden_n_m": "overburden",
    "eccentricity_m": "eccentricity",
}

Rows = dict[str, list[str]]


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
        There are no such files, or they are not result files of dondolo.
    """
    as_file("prefix", prefix)
    prefix = os.fspath(prefix)
    walls, comments = _read(prefix + "_walls.csv")
    gravity = _setting(comments, "gravity", 9.81)
    written = datetime.fromtimestamp(os.path.getmtime(prefix + "_walls.csv")).astimezone()
    try:
        population = _population(walls, gravity)
        stored = StoredResults(population, comments=tuple(comments), written=written)
        # The files of another task may lie there from a run before: the walls' file tells the task of the last.
        task = next((found.group(1) for line in comments if (found := re.match(r"&job task = '(\w+)'", line))), "")
        if task == "history":
            return replace(stored, response=_response(prefix + "_history.csv", population.walls[0], comments))
        if task == "stripes":
            stripes = _stripes(prefix + "_histories.csv", population.walls[0])
            return replace(stored, stripes=stripes, fragility=stripes.fit())
        return replace(stored, typology=_typology(prefix + "_stripes.csv", population))
    except (KeyError, ValueError, IndexError) as error:
        if isinstance(error, InputError):
            raise
        raise InputError(f"{prefix}_*.csv: not result files of dondolo ({error})") from error


def heads(start: str, comments: Sequence[str]) -> list[str]:
    """What stands in the comments after a word."""
    return [line[len(start) :].strip() for line in comments if line.startswith(start)]


def _read(path: str) -> tuple[Rows, list[str]]:
    """Columns and comments of a result file."""
    try:
        text = Path(path).read_text(encoding="utf-8")
    except (OSError, UnicodeDecodeError) as error:
        reason = error.strerror if isinstance(error, OSError) else "not UTF-8"
        raise InputError(f"{path}: cannot be read: {reason}") from error
    lines = text.splitlines(keepends=True)
    comments = [line[1:].strip() for line in lines if line.startswith("#")]
    rows = list(csv.reader(line for line in lines if not line.startswith("#")))
    if len(rows) < 2:
        raise InputError(f"{path}: no rows")
    head, *body = rows
    return {name: [row[i] for row in body] for i, name in enumerate(head)}, comments


def _setting(comments: list[str], name: str, default: float) -> float:
    """A number of the case that stands in the comments; what stands in quotes, such as a title, is no setting."""
    for comment in comments:
        bare = re.sub(r"'(?:[^']|'')*'", "''", comment)
        found = re.search(rf"(?:^|^&\w+ +|, ){name}\s*[=:]\s*([-+0-9.eEdD]+)", bare)
        if found and not comment.startswith(("record:", "warning:")):
            return float(found.group(1).lower().replace("d", "e"))
    return default


def _work(comments: list[str]) -> Work:
    """What was computed, out of the comments."""
    for comment in comments:
        if comment.startswith("work:"):
            return Work(**{name: int(count) for name, count in re.findall(r"(\w+) = (\d+)", comment)})
    raise ValueError("no line '# work:'")


def _population(rows: Rows, gravity: float) -> Population:
    """Walls as they were given."""
    walls: list[Wall] = []
    for i, name in enumerate(rows["wall"]):
        given: dict[str, Any] = {
            argument: float(rows[column][i]) for column, argument in _WALL_COLUMNS.items() if rows[column][i]
        }
        kind = MECHANISMS[rows["mechanism"][i]]
        walls.append(kind(name=name, restitution=rows["restitution_model"][i], gravity=gravity, **given))
    weights = [float(cell) for cell in rows["weight"]]
    p_occ = [float(cell) for cell in rows["p_occ"]]
    return Population(tuple(walls), np.asarray(weights), tuple(rows["group"]), np.asarray(p_occ))


def _numbers(rows: Rows, column: str) -> Any:
    values = np.asarray([float(cell) for cell in rows[column]])
    values.flags.writeable = False
    return values


def _response(path: str, wall: Wall, case: list[str]) -> Response:
    """A motion; its record is what the history shows of it."""
    rows, comments = _read(path)
    time, acceleration = _numbers(rows, "time_s"), _numbers(rows, "ground_acceleration_m_s2")
    rotation, velocity = _numbers(rows, "rotation_rad"), _numbers(rows, "velocity_rad_s")
    scale = _setting(comments, "scale", 1.0)
    # Rows stand at every sample and at impacts in between: the samples are the multiples of the commonest step.
    steps, counts = np.unique(np.round(np.diff(time), 9), return_counts=True)
    dt = float(steps[np.argmax(np.where(steps > 0.0, counts, 0))])
    at_sample = np.abs(time / dt - np.round(time / dt)) < 1e-6
    _, first = np.unique(np.round(time[at_sample] / dt), return_index=True)
    name = next(comment[len("record:") :].strip() for comment in comments if comment.startswith("record:"))
    record = Record(acceleration[at_sample][first] / scale, dt, name=name)
    return Response(
        wall,
        record,
        scale,
        _setting(comments, "edp", 0.0),
        _setting(comments, "collapsed", 0.0) == 1.0,
        int(_setting(comments, "impacts", 0.0)),
        _setting(comments, "time_of_peak_s", 0.0),
        _setting(case, "edp_limit", 1.0),
        time,
        acceleration,
        rotation,
        velocity,
        _numbers(rows, "side").astype(np.int8),
        _numbers(rows, "after_impact") == 1.0,
        next((float(line.split()[1]) for line in comments if line.startswith("edp_error:")), None),
    )


def _stripes(path: str, wall: Wall) -> Stripes:
    """All histories of a wall."""
    rows, comments = _read(path)
    levels = np.unique(_numbers(rows, "im_level"))
    shape = (len(levels), len(rows["wall"]) // len(levels))
    first = slice(0, shape[1])
    engine = next(
        (found.group(1) for line in comments if (found := re.match(r"&solver engine = '(\w+)'", line))), "auto"
    )
    return Stripes(
        wall=wall,
        im=rows["im"][0],
        levels=levels,
        edp=_numbers(rows, "edp").reshape(shape),
        collapsed=_numbers(rows, "collapsed").reshape(shape) == 1.0,
        impacts=_numbers(rows, "impacts").reshape(shape).astype(np.int32),
        time_of_peak=_numbers(rows, "time_of_peak_s").reshape(shape),
        scale=_numbers(rows, "scale").reshape(shape),
        record_names=tuple(rows["record"][first]),
        polarity=np.asarray([-1 if word == "reversed" else 1 for word in rows["polarity"][first]], dtype=np.int32),
        engine=engine,
        rtol=_setting(comments, "rtol", np.nan),
        atol=_setting(comments, "atol", np.nan),
        edp_limit=_setting(comments, "edp_limit", 1.0),
        work=_work(comments),
        edp_error=_numbers(rows, "edp_error").reshape(shape) if "edp_error" in rows else None,
    )


def _typology(path: str, population: Population) -> Typology:
    """Counts of all walls of a population."""
    rows, comments = _read(path)
    levels = np.unique(_numbers(rows, "im_level"))
    thresholds = np.unique(_numbers(rows, "edp_threshold"))
    shape = (len(population), len(thresholds), len(levels))
    counts = _numbers(rows, "collapses").reshape(shape).astype(np.int32).transpose(1, 2, 0)
    histories = _numbers(rows, "histories").reshape(shape)[:, 0, 0].astype(np.int32)
    everyone = np.ones(len(population), dtype=bool)
    result = combine(population, rows["im"][0], levels, thresholds, counts, histories, everyone, _work(comments))
    return replace(result, warnings=tuple(dict.fromkeys([*heads("warning:", comments), *result.warnings])))
