"""Result files, read back into objects."""

from __future__ import annotations

import os
from dataclasses import dataclass, replace
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np

from dondolo._base.arguments import one_of
from dondolo._base.files import as_file
from dondolo._base.shown import Shown
from dondolo._fortran.library import constants
from dondolo._fortran.walls import WALL_EXTRAS, WALL_LISTS, WALL_PROPERTIES, WALL_TEXTS, WALL_WORDS, describe_wall
from dondolo._storage.run_file import HistoryResult, RunFile, read_run_file
from dondolo._storage.transactions import RUN_FILE, TABLES, published_run
from dondolo.analysis.certificate import Certified
from dondolo.analysis.response import Response
from dondolo.analysis.stripes import States, Stripes
from dondolo.analysis.work import Work
from dondolo.checks.ntc import CodeCheck
from dondolo.curves.fragility import Fragility
from dondolo.errors import DondoloWarning, InputError, MissingFileError, silent
from dondolo.exchange.case_checks import checks_of_run, stored_check
from dondolo.exchange.result_file import MixedError, ResultFile
from dondolo.exchange.stored_designs import stored_designs
from dondolo.exchange.stored_errors import kept_errors
from dondolo.exchange.stored_ties import stored_ties
from dondolo.exchange.stored_unions import kept_unions
from dondolo.populations.combination import combine
from dondolo.populations.typology import Typology
from dondolo.populations.uncertain_wall import UncertainWall
from dondolo.records.record import Record
from dondolo.retrofit.designs import DesignComparison
from dondolo.walls.mechanisms import MECHANISMS, wall_from
from dondolo.walls.population import Population
from dondolo.walls.table import numbered
from dondolo.walls.wall import Wall

# How often results are read again that another run replaces meanwhile
_TRIES = 20
# Prefixes that a message shows
_SHOWN = 5
# What only some populations have
_UNIONS, _TIES, _DESIGNS = "_unions.csv", "_ties.csv", "_designs.csv"
# Columns of _walls.csv and the numbers of a wall
_COLUMNS = {row.column: row.name for row in WALL_PROPERTIES if row.column}
_WALL_COLUMNS = {column: name for column, name in _COLUMNS.items() if name not in WALL_TEXTS and name not in WALL_LISTS}
_LIST_COLUMNS = {column: name for column, name in _COLUMNS.items() if name in WALL_LISTS}


@dataclass(frozen=True, repr=False, kw_only=True)
class StoredResults(Shown):
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
        Task 'typology'; of designs their curves alone, with nothing over them (`Typology.are_alternatives`).
    uncertain : UncertainWall or None
        Of a case with a group &uncertainty: its typology, and what that owes to each source. Its `numbers` and `rest`
        are NaN, since the files do not have them.
    designs : DesignComparison or None
        Of a case with ``designs = .true.``: without `stripes`, and with the ratios of the medians alone in its
        `comparisons`.
    check : CodeCheck or None
        Of a case with a group &check.
    run : RunFile
        What ran: version, settings, inputs with checksums, counts of the work, warnings.
    """

    population: Population
    run: RunFile
    response: Response | None = None
    stripes: Stripes | None = None
    fragility: Fragility | None = None
    typology: Typology | None = None
    uncertain: UncertainWall | None = None
    designs: DesignComparison | None = None
    check: CodeCheck | None = None

    @cached_property
    def checks(self) -> tuple[CodeCheck | None, ...]:
        """The kinematic check of each row of a population with a group &check, None where it has none; else empty."""
        return () if self.typology is None else checks_of_run(self.population.walls, self.run)

    def _facts(self) -> list[tuple[str, str]]:
        names = ("response", "stripes", "fragility", "typology", "designs", "check")
        made = [(name, repr(found)) for name in names if (found := getattr(self, name)) is not None]
        return [("run", f"{self.run.run} of dondolo {self.run.version}"), ("population", repr(self.population)), *made]

    @property
    def edp_thresholds(self) -> list[float]:
        """Damage states that the case names [rotation / capacity], if there are several."""
        return self.run.edp_thresholds

    @property
    def states(self) -> States:
        """How the curves of damage states are fitted: 'separate' or 'ordinal'."""
        return "ordinal" if self.run.setting("stripes", "states", "separate") == "ordinal" else "separate"


def read_results(prefix: str | os.PathLike[str]) -> StoredResults:
    """Read the result files of the executable, or those that `Typology.write_results` wrote.

    Parameters
    ----------
    prefix : path
        What their names begin with: `output` of the case, for example ``out/parapet``.

    Returns
    -------
    StoredResults
        The same objects as those of a run in Python; curves are fitted again, to the same counts. Those of a typology
        have the standard errors of the files, and cannot be compared: the files do not tell which record brings which
        wall down.

    Raises
    ------
    InputError
        They are not result files of dondolo, are not all of one run, or not as their run has written them; the file is
        named, and the line if there is one.
    MissingFileError
        There are no such files.
    """
    name = as_file("prefix", prefix).name
    prefix = os.fspath(prefix)
    tries = 0
    while True:
        try:
            run = read_run_file(prefix + RUN_FILE)
        except MissingFileError:
            for end in (*TABLES, RUN_FILE):
                if name.endswith(end):
                    start = prefix.removesuffix(end)
                    raise InputError(f"prefix = {prefix!r}: must be what the names begin with, {start!r}") from None
            _refuse_other(prefix)
            raise
        try:
            return _read(prefix, run)
        except (MissingFileError, MixedError):
            # Unless another run has published its results meanwhile
            tries += 1
            if tries == _TRIES or published_run(Path(prefix)) == run.run:
                raise


def _refuse_other(prefix: str) -> None:
    """Refuse a case, another file, a folder or a prefix with an underscore, and name the prefix that is meant."""
    path, what = Path(prefix), f"prefix = {prefix!r}"
    if prefix.endswith("_") and Path(prefix[:-1] + RUN_FILE).is_file():
        raise InputError(f"{what}: must be what the names begin with, {prefix[:-1]!r}")
    if path.is_dir():
        found = sorted(str(one).removesuffix(RUN_FILE) for one in path.glob(f"*{RUN_FILE}"))
        more = f" and {len(found) - _SHOWN} more" if len(found) > _SHOWN else ""
        names = ", ".join(map(repr, found[:_SHOWN])) + more
        if found:
            raise InputError(f"{what}: is a folder, must be what the names of result files begin with, such as {names}")
    if not path.is_file():
        return
    if path.suffix.lower() != ".nml":
        raise InputError(f"{what}: is a file, must be what the names of result files begin with")
    from dondolo.exchange.cases import read_case

    with silent():
        output = read_case(prefix).output
    run = "" if Path(output + RUN_FILE).is_file() else f"; there are none yet, dondolo {prefix} writes them"
    raise InputError(f"{what}: is a case, must be what the names of its result files begin with, {output!r}{run}")


def _read(prefix: str, run: RunFile) -> StoredResults:
    """The results of a run."""
    # The tables of another task may lie there from a run before: the file of the run names the task of the last.
    task = run.setting("job", "task", "")
    names = {"history": "history", "stripes": "histories", "typology": "stripes"}
    if task not in names:
        raise InputError(f"{run.path}: settings: job: task = {task!r}: must be one of {', '.join(map(repr, names))}")
    gravity = run.setting("solver", "gravity", constants().gravity)
    result = run.history if task == "history" else None
    if task == "history" and result is None:
        raise InputError(f"{run.path}: no 'history'")
    try:
        work = Work(**run.work)
    except TypeError as error:
        raise InputError(f"{run.path}: work: {error}") from error
    limit = run.setting("solver", "edp_limit", constants().edp_limit)
    tolerances = run.setting("solver", "rtol", np.nan), run.setting("solver", "atol", np.nan)
    engine, thresholds = run.setting("solver", "engine", "auto"), run.edp_thresholds
    walls = ResultFile(prefix + "_walls.csv", run)
    with walls.reading():
        population = _population(walls, gravity)
    stored = StoredResults(population=population, run=run)
    table = ResultFile(f"{prefix}_{names[task]}.csv", run)
    with table.reading():
        if result is not None:
            stored = replace(stored, response=_response(table, population.walls[0], result, limit))
        elif task == "stripes":
            stripes = _stripes(table, population.walls[0], engine, *tolerances, limit, work)
            if len(run.records) == stripes.n_records:
                events, checksums = (tuple(one[key] for one in run.records) for key in ("event", "checksum"))
                stripes = replace(stripes, events=events, checksums=checksums)
            stored = replace(stored, stripes=stripes)
            ordinal = stored.states == "ordinal" and thresholds
            curves = stripes.fit_damage_states(thresholds, states="ordinal") if ordinal else [stripes.fit()]
            stored = replace(stored, fragility=curves[-1])
        else:
            stored = replace(stored, typology=_typology(table, population, work, run.warnings))
    are_designs = bool(run.setting("population", "designs", False))
    if stored.typology is not None and are_designs:
        stored = replace(stored, typology=stored.typology._as_alternatives())
    if stored.typology is not None:
        stored = replace(stored, typology=_with_tables(stored.typology, prefix, run))
    if stored.typology is not None and "uncertainty" in run.settings:
        sources = ResultFile(prefix + "_sources.csv", run)
        with sources.reading():
            stored = replace(stored, uncertain=_uncertain(sources, stored.typology))
        sources.check(run)
    if stored.typology is not None and are_designs and any(file.name == _DESIGNS for file in run.files):
        beside = ResultFile(prefix + _DESIGNS, run)
        with beside.reading():
            stored = replace(stored, designs=stored_designs(stored.typology, beside, run))
        beside.check(run)
    walls.check(run)
    table.check(run)
    if task == "stripes" and "check" in run.settings:
        sheet = ResultFile(prefix + "_check.csv", run)
        with sheet.reading():
            stored = replace(stored, check=stored_check(sheet, run, population.walls[0]))
        sheet.check(run)
    return stored


def _population(table: ResultFile, gravity: float) -> Population:
    """Walls as they were given."""
    walls: list[Wall] = []
    lists = {column: argument for column, argument in _LIST_COLUMNS.items() if numbered(column, 1) in table}
    for i, (name, kind) in enumerate(zip(table.texts("wall"), table.texts("mechanism"), strict=True)):
        given: dict[str, Any] = {
            argument: table.number(column, i)
            for column, argument in _WALL_COLUMNS.items()
            if (column in table or argument not in WALL_EXTRAS) and table.texts(column)[i]
        }
        given |= {argument: values for column, argument in lists.items() if (values := _list(table, column, i))}
        try:
            one_of("mechanism", kind, MECHANISMS)
            given |= {"name": name, "restitution": table.texts("restitution_model")[i]}
            walls.append(wall_from(describe_wall(given | {"mechanism": kind}, gravity)))
        except (TypeError, ValueError) as error:
            raise ValueError(f"{table.place(i)}: {error}") from error
    weights, p_occ = table.numbers("weight"), table.numbers("p_occ")
    facades = tuple(table.texts("facade")) if "facade" in table else ("",) * len(walls)
    return Population(tuple(walls), weights, groups=tuple(table.texts("group")), p_occ=p_occ, facades=facades)


def _list(table: ResultFile, column: str, i: int) -> list[Any]:
    """Values of a list in a row, up to the first that is not there."""
    values: list[Any] = []
    while (one := numbered(column, len(values) + 1)) in table and table.texts(one)[i]:
        is_word = _LIST_COLUMNS[column] in WALL_WORDS
        values.append(table.texts(one)[i] if is_word else table.number(one, i))
    return values


def _response(table: ResultFile, wall: Wall, result: HistoryResult, edp_limit: float) -> Response:
    """A motion; its record is what the history shows of it."""
    time, acceleration = table.numbers("time_s"), table.numbers("ground_acceleration_m_s2")
    rotation, velocity = table.numbers("rotation_rad"), table.numbers("velocity_rad_s")
    scale = result.scale
    if result.collapsed != (result.edp >= edp_limit):
        raise ValueError(f"collapsed = {result.collapsed}: edp = {result.edp:g} and edp_limit = {edp_limit:g} differ")
    # Rows stand at every sample and at impacts in between: the samples are the multiples of the commonest step.
    with np.errstate(over="ignore", invalid="ignore"):
        steps, counts = np.unique(np.round(np.diff(time), 9), return_counts=True)
        if not np.any(steps > 0.0) or scale == 0.0:
            raise ValueError("no motion: time_s must increase, and scale must not be 0")
        dt = float(steps[np.argmax(np.where(steps > 0.0, counts, 0))])
        at_sample = np.abs(time / dt - np.round(time / dt)) < 1e-6
        _, first = np.unique(np.round(time[at_sample] / dt), return_index=True)
        record = Record(acceleration[at_sample][first] / scale, dt, name=result.record)
    return Response(
        wall=wall,
        record=record,
        scale=scale,
        edp=result.edp,
        collapsed=result.collapsed,
        impacts=result.impacts,
        time_of_peak=result.time_of_peak_s,
        edp_limit=edp_limit,
        time=time,
        ground_acceleration=acceleration,
        rotation=rotation,
        velocity=velocity,
        side=table.counts("side", -1, 1).astype(np.int8),
        after_impact=table.numbers("after_impact") == 1.0,
        edp_error=result.edp_error,
        tie_times=np.array(result.tie_times) if result.tie_times else None,
    )


def _stripes(
    table: ResultFile, wall: Wall, engine: str, rtol: float, atol: float, edp_limit: float, work: Work
) -> Stripes:
    """All histories of a wall."""
    levels, row = np.unique(table.numbers("im_level"), return_inverse=True)
    # The histories of a stripe are those of all records, and again in the other polarity if there are two.
    signs = [-1 if word == "reversed" else 1 for word in table.texts("polarity")]
    names, both = tuple(dict.fromkeys(table.texts("record"))), tuple(dict.fromkeys(signs))
    places = {pair: i for i, pair in enumerate((sign, name) for sign in both for name in names)}
    column = np.array([places[pair] for pair in zip(signs, table.texts("record"), strict=True)])
    ran = np.zeros((len(levels), len(places)), dtype=bool)
    ran[row, column] = True
    if np.count_nonzero(ran) < len(table):
        raise ValueError(f"{len(table)} rows: a record is a duplicate at a level")
    # To estimate errors every history runs several times.
    if work.histories % len(table) or ("edp_error" not in table and work.histories != len(table)):
        raise ValueError(f"{len(table)} rows: are not the {work.histories} histories of the run")

    def matrix(values: Any) -> Any:
        found = np.full(ran.shape, np.nan if values.dtype.kind == "f" else 0, dtype=values.dtype)
        found[row, column] = values
        return found

    certified: dict[str, Any] = {}
    if "status" in table:
        numbers = [Certified[word.upper()] for word in table.texts("status")]
        certified = {
            "status": matrix(np.asarray(numbers, dtype=np.int32)),
            "edp_lowest": matrix(table.numbers("edp_lowest")),
            "edp_highest": matrix(table.numbers("edp_highest")),
        }
    return Stripes(
        wall=wall,
        im=table.texts("im")[0],
        levels=levels,
        edp=matrix(table.numbers("edp")),
        collapsed=matrix(table.numbers("collapsed")) == 1.0,
        impacts=matrix(table.counts("impacts")),
        time_of_peak=matrix(table.numbers("time_of_peak_s")),
        scale=matrix(table.numbers("scale")),
        ran=ran,
        record_names=names * len(both),
        polarity=np.repeat(np.asarray(both, dtype=np.int32), len(names)),
        engine=engine,
        rtol=rtol,
        atol=atol,
        edp_limit=edp_limit,
        work=work,
        edp_error=matrix(table.numbers("edp_error")) if "edp_error" in table else None,
        uplift=matrix(table.numbers("uplift")) == 1.0 if "uplift" in table else None,
        **certified,
    )


def _typology(table: ResultFile, population: Population, work: Work, warnings: tuple[DondoloWarning, ...]) -> Typology:
    """Counts of all walls of a population."""
    thresholds = np.unique(table.numbers("edp_threshold"))
    levels = np.unique(table.numbers("im_level"))
    shape = (len(population), len(thresholds), len(levels))
    if len(table) != np.prod(shape):
        product = " x ".join(map(str, shape))
        raise ValueError(f"{len(table)} rows: must be {product}, one for each wall, damage state and level")
    counts = table.counts("collapses").reshape(shape).transpose(1, 2, 0)
    histories = table.counts("histories", 1).reshape(shape)[:, 0].T
    everyone = np.ones(len(population), dtype=bool)
    im = table.texts("im")[0]
    result = combine(population, im, levels, thresholds, counts, histories, everyone, work)
    return replace(result, warnings=tuple(dict.fromkeys([*warnings, *result.warnings])))


def _uncertain(table: ResultFile, typology: Typology) -> UncertainWall:
    """What a wall with variants owes to each of its uncertain properties."""
    if len(typology.walls) < 3 + 2 * len(table):
        raise ValueError(f"{len(table)} rows: are too many sources for the {len(typology.walls)} walls of the run")

    # What a curve that does not exist leaves is empty.
    def numbers(name: str) -> Any:
        return np.array([table.number(name, i) if cell else np.nan for i, cell in enumerate(table.texts(name))])

    def several(*names: str) -> Any:
        return np.array([numbers(name) for name in names]).T

    return UncertainWall(
        sources=tuple(table.texts("source")),
        distributions=tuple(table.texts("distribution")),
        values=several("value_5", "value_50", "value_95"),
        typology=typology,
        first=numbers("first"),
        first_interval=several("first_low", "first_high"),
        total=numbers("total"),
        total_interval=several("total_low", "total_high"),
        rest=np.nan,
        numbers=(np.nan, np.nan),
    )


def _with_tables(typology: Typology, prefix: str, run: RunFile) -> Typology:
    """A typology with what its tables know besides counts: standard errors, unions of mechanisms, ties."""
    names = {file.name for file in run.files}
    curves = ResultFile(f"{prefix}_fragility.csv", run)
    groups = None if typology.are_alternatives else ResultFile(f"{prefix}_typology.csv", run)
    unions, ties = (ResultFile(prefix + name, run) if name in names else None for name in (_UNIONS, _TIES))
    kept = kept_errors(typology, curves, groups)
    of_walls, of_groups = (None, None) if unions is None else kept_unions(typology, unions)
    typology = replace(
        kept.put_into(typology, -1),
        kept_errors=kept,
        kept_unions=of_walls,
        kept_group_unions=of_groups,
        ties=stored_ties(typology, ties),
    )
    for table in (curves, groups, unions, ties):
        if table is not None:
            table.check(run)
    return typology
