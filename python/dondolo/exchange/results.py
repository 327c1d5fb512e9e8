"""Results of a case as objects: views of the columns of its tables, which come from files or from memory."""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np

from dondolo._base.arguments import FloatArray, one_of
from dondolo._base.shown import Shown
from dondolo._fortran.files import TABLES
from dondolo._fortran.library import constants
from dondolo._fortran.walls import (
    WALL_EXTRAS,
    WALL_LISTS,
    WALL_PROPERTIES,
    WALL_TEXTS,
    WALL_WORDS,
    describe_wall,
    describe_walls,
    is_note,
)
from dondolo._storage.columns import Columns
from dondolo._storage.result_set import write_set
from dondolo._storage.run_file import HistoryResult, RunFile
from dondolo.analysis import histories
from dondolo.analysis.certificate import Certified
from dondolo.analysis.response import Response
from dondolo.analysis.stripe_fits import States, fit_warnings
from dondolo.analysis.stripes import Stripes
from dondolo.analysis.work import Work
from dondolo.checks.ntc import CodeCheck
from dondolo.curves.fragility import Fragility
from dondolo.errors import DondoloWarning, InputError, silent
from dondolo.exchange.case_checks import checks_of_run, stored_check
from dondolo.exchange.cases import Case
from dondolo.exchange.stored_curves import stored_curves
from dondolo.exchange.stored_designs import stored_designs
from dondolo.exchange.stored_ties import stored_ties
from dondolo.populations.combination import combine_rows
from dondolo.populations.flags import Flags
from dondolo.populations.typology import Typology
from dondolo.populations.uncertain_wall import UncertainWall
from dondolo.records.record import Record
from dondolo.retrofit.designs import DesignComparison
from dondolo.walls.mechanisms import MECHANISMS
from dondolo.walls.population import Population
from dondolo.walls.table import numbered
from dondolo.walls.wall import Wall
from dondolo.walls.wall_columns import WallColumns

# What only some populations have
_UNIONS, _TIES, _DESIGNS = "_unions.csv", "_ties.csv", "_designs.csv"
# Columns of _walls.csv and the numbers of a wall
_COLUMNS = {row.column: row.name for row in WALL_PROPERTIES if row.column}
_WALL_COLUMNS = {column: name for column, name in _COLUMNS.items() if name not in WALL_TEXTS and name not in WALL_LISTS}
_LIST_COLUMNS = {column: name for column, name in _COLUMNS.items() if name in WALL_LISTS}


@dataclass(frozen=True, eq=False, repr=False, kw_only=True)
class Results(Shown):
    """Results of a case, run here or read from files; those of other tasks are None.

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
        Of a case with a group &uncertainty: its typology, and its variance by source. Its `numbers` and `rest`
        are NaN, since a case does not have them.
    designs : DesignComparison or None
        Of a case with ``designs = .true.``, without `stripes`; read back it has the ratios of the medians alone in its
        `comparisons`.
    check : CodeCheck or None
        Of a case with a group &check.
    run : RunFile
        Record of the run: version, settings, inputs with checksums, counts of the work, warnings.
    case : Case or None
        The case that `run_case` ran, with its records; None for results read from files.
    edp_thresholds : list of float
        Damage states that the case names [rotation / capacity], if there are several.
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
    case: Case | None = None
    edp_thresholds: Sequence[float] = ()
    _source: Source

    def write_results(self, prefix: str | os.PathLike[str], *, spreadsheet_safe: bool = False) -> None:
        """Write all tables into files of the names that the executable gives them.

        `read_results` gives these results again, to the bit.

        Parameters
        ----------
        prefix : path
            Prefix of the files, such as ``out/centre`` for ``out/centre_typology.csv``; folders are made.
        spreadsheet_safe : bool
            Put an apostrophe before names that a spreadsheet would read as formulas; `read_results` removes it.

        Raises
        ------
        InputError
            Another run is writing them, or a file of the same name is not a result of dondolo.
        DondoloError
            A file cannot be written.

        Warns
        -----
        DondoloWarning
            Earlier results are replaced; reports, workbooks or figures are out of date.
        """
        names = [name for name in TABLES if name in self._source.names]
        tables = {name: {one: self._source[name].column(one) for one in self._source[name]} for name in names}
        write_set(prefix, tables, self.run, spreadsheet_safe=spreadsheet_safe)

    @cached_property
    def checks(self) -> tuple[CodeCheck | None, ...]:
        """The kinematic check of each row of a population with a group &check, None where it has none; else empty."""
        return () if self.typology is None else checks_of_run(self.population.walls, self.run)

    def _facts(self) -> list[tuple[str, str]]:
        names = ("response", "stripes", "fragility", "typology", "designs", "check")
        made = [(name, repr(found)) for name in names if (found := getattr(self, name)) is not None]
        case = self.run.setting("job", "title", "") or self.run.setting("job", "output", "")
        facts = [("case", case)] if case else []
        if self.run.run:
            facts.append(("run", f"{self.run.run} of dondolo {self.run.version}"))
        return [*facts, ("population", repr(self.population)), *made]

    @property
    def states(self) -> States:
        """How the curves of damage states are fitted: 'separate' or 'ordinal'."""
        return "ordinal" if self.run.setting("stripes", "states", "separate") == "ordinal" else "separate"


class Source:
    """Where the tables of a run come from.

    Parameters
    ----------
    get : callable
        Gives the table of a name such as '_walls.csv'.
    names : set of str
        The names that there are.
    """

    def __init__(self, get: Callable[[str], Columns], names: frozenset[str]) -> None:
        self.names = names
        self._get = get
        self._known: dict[str, Columns] = {}

    def __getitem__(self, name: str) -> Columns:
        if name not in self._known:
            self._known[name] = self._get(name)
        return self._known[name]

    def get(self, name: str) -> Columns | None:
        """A table that the run may not have."""
        return self[name] if name in self.names else None

    def check(self) -> None:
        """Check that all tables that were looked at are as their run has made them."""
        for table in self._known.values():
            table.check()


# What there is to warn of, the run has warned of: `RunFile.warnings`.
@silent()
def results_of(run: RunFile, source: Source, case: Case | None = None, flags: Flags | None = None) -> Results:
    """The results of a run.

    Parameters
    ----------
    run : RunFile
        What ran.
    source : Source
        Its tables.
    case : Case or None
        What was run, if it was run here.
    flags : Flags or None
        Which history of its population reaches which state, which files do not tell.

    Raises
    ------
    InputError
        Tables that do not fit together.
    """
    # The tables of another task may lie there from a run before: the file of the run names the task of the last.
    task = run.setting("job", "task", "")
    tasks = ("history", "stripes", "typology")
    if task not in tasks:
        raise InputError(f"{run.path}: settings: job: task = {task!r}: must be one of {', '.join(map(repr, tasks))}")
    if task == "history" and run.history is None:
        raise InputError(f"{run.path}: no 'history'")
    try:
        work = Work(**run.work)
    except TypeError as error:
        raise InputError(f"{run.path}: work: {error}") from error
    walls = source["_walls.csv"]
    with walls.reading():
        population = _population(walls, run.setting("solver", "gravity", constants().gravity))
    results = Results(population=population, run=run, case=case, edp_thresholds=run.edp_thresholds, _source=source)
    if task == "history":
        results = _of_history(results, source["_history.csv"])
    elif task == "stripes":
        results = _of_stripes(results, source, work)
    else:
        results = _of_typology(results, source, work, flags)
    source.check()
    return results


def _of_history(results: Results, table: Columns) -> Results:
    """Results of the task 'history'."""
    run, case = results.run, results.case
    assert run.history is not None
    limit = run.setting("solver", "edp_limit", constants().edp_limit)
    record = None if case is None else case.records[case.record_index]
    with table.reading():
        response = _response(table, results.population.walls[0], run.history, limit, record)
    return replace(results, response=response)


def _of_stripes(results: Results, source: Source, work: Work) -> Results:
    """Results of the task 'stripes'."""
    run, table = results.run, source["_histories.csv"]
    limit = run.setting("solver", "edp_limit", constants().edp_limit)
    tolerances = run.setting("solver", "rtol", np.nan), run.setting("solver", "atol", np.nan)
    with table.reading():
        wall, engine = results.population.walls[0], run.setting("solver", "engine", "auto")
        stripes = _stripes(table, wall, engine, *tolerances, limit, work)
        if len(run.records) == stripes.n_records:
            events, checksums = (tuple(one[key] for one in run.records) for key in ("event", "checksum"))
            stripes = replace(stripes, events=events, checksums=checksums, record_formats=_formats(run))
        ordinal = results.states == "ordinal" and results.edp_thresholds
        curves = stripes.fit_damage_states(results.edp_thresholds, states="ordinal") if ordinal else [stripes.fit()]
    # The run also warns of the curve.
    of_curve = {one.code for one in fit_warnings(stripes, curves[-1])}
    stripes = replace(stripes, warnings=tuple(one for one in run.warnings if one.code not in of_curve))
    results = replace(results, stripes=stripes, fragility=curves[-1])
    if "check" not in run.settings:
        return results
    sheet = source["_check.csv"]
    with sheet.reading():
        return replace(results, check=stored_check(sheet, run, results.population.walls[0]))


def _of_typology(results: Results, source: Source, work: Work, flags: Flags | None) -> Results:
    """Results of the task 'typology'."""
    run, table = results.run, source["_stripes.csv"]
    are_designs = bool(run.setting("population", "designs", False))
    with table.reading():
        typology = _typology(table, results.population, work, run.warnings, flags, are_designs)
    if flags is None:
        groups = None if are_designs else source["_typology.csv"]
        typology = stored_curves(typology, source["_fragility.csv"], groups, source.get(_UNIONS)).put_into(typology)
    ties = stored_ties(typology, source.get(_TIES))
    typology = replace(typology, ties=ties, record_formats=_formats(run))
    results = replace(results, typology=typology)
    if "uncertainty" in run.settings:
        sources = source["_sources.csv"]
        with sources.reading():
            results = replace(results, uncertain=_uncertain(sources, typology))
    beside = source.get(_DESIGNS) if are_designs else None
    if beside is not None:
        with beside.reading():
            results = replace(results, designs=stored_designs(typology, beside, run))
    return results


def _formats(run: RunFile) -> tuple[str, ...]:
    """Format of each record, '' where it is not known."""
    return tuple(one.get("format", "") for one in run.records)


def _population(table: Columns, gravity: float) -> Population:
    """Walls as they were given."""
    lists = {column: argument for column, argument in _LIST_COLUMNS.items() if numbered(column, 1) in table}
    names, models = table.texts("wall"), table.texts("restitution_model")
    rows: list[dict[str, Any]] = []
    for i, kind in enumerate(table.texts("mechanism")):
        given: dict[str, Any] = {
            argument: table.number(column, i)
            for column, argument in _WALL_COLUMNS.items()
            if (column in table or argument not in WALL_EXTRAS) and table.given(column, i)
        }
        given |= {argument: values for column, argument in lists.items() if (values := _list(table, column, i))}
        rows.append(given | {"name": names[i], "restitution": models[i], "mechanism": kind})
    walls = _walls(table, rows, gravity)
    weights, p_occ = table.numbers("weight"), table.numbers("p_occ")
    columns = {"facades": "facade", "occurrence": "occurrence", "alternatives": "alternative"}
    more: dict[str, Any] = {name: table.texts(column) for name, column in columns.items() if column in table}
    more["notes"] = {name: table.texts(name) for name in table if is_note(name)}
    return Population(walls, weights, group_names=tuple(table.texts("group")), p_occ=p_occ, **more)


def _walls(table: Columns, rows: Sequence[dict[str, Any]], gravity: float) -> Sequence[Wall]:
    """Walls of their properties, all at once; a row that is wrong is found one by one."""
    words = dict.fromkeys(word for given in rows for word in given)
    try:
        return WallColumns.of_data(
            describe_walls(len(rows), {word: [one.get(word) for one in rows] for word in words}, [gravity] * len(rows))
        )
    except InputError:
        for i, given in enumerate(rows):
            try:
                one_of("mechanism", given["mechanism"], MECHANISMS)
                describe_wall(given, gravity)
            except (TypeError, ValueError) as error:
                raise ValueError(f"{table.place(i)}: {error}") from error
        raise


def _list(table: Columns, column: str, i: int) -> list[Any]:
    """Values of a list in a row, up to the first that is not there."""
    values: list[Any] = []
    while (one := numbered(column, len(values) + 1)) in table and table.given(one, i):
        is_word = _LIST_COLUMNS[column] in WALL_WORDS
        values.append(table.texts(one)[i] if is_word else table.number(one, i))
    return values


def _response(table: Columns, wall: Wall, result: HistoryResult, edp_limit: float, record: Record | None) -> Response:
    """A motion; where its record is not at hand, it is what the history shows of it."""
    time, acceleration = table.numbers("time_s"), table.numbers("ground_acceleration_m_s2")
    rotation, velocity = table.numbers("rotation_rad"), table.numbers("velocity_rad_s")
    scale = result.scale
    if result.collapsed != (result.edp >= edp_limit):
        raise ValueError(f"collapsed = {result.collapsed}: edp = {result.edp:g} and edp_limit = {edp_limit:g} differ")
    return Response(
        wall=wall,
        record=_record(time, acceleration, result) if record is None else record,
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
        initial_rotation=result.initial_rotation_rad,
        initial_velocity=result.initial_velocity_rad_s,
    )


def _record(time: FloatArray, acceleration: FloatArray, result: HistoryResult) -> Record:
    """What a history shows of its record."""
    # Rows stand at every sample and at impacts in between: the samples are the multiples of the commonest step.
    with np.errstate(over="ignore", invalid="ignore"):
        steps, counts = np.unique(np.round(np.diff(time), 9), return_counts=True)
        if not np.any(steps > 0.0) or result.scale == 0.0:
            raise ValueError("no motion: time_s must increase, and scale must not be 0")
        dt = float(steps[np.argmax(np.where(steps > 0.0, counts, 0))])
        at_sample = np.abs(time / dt - np.round(time / dt)) < 1e-6
        _, first = np.unique(np.round(time[at_sample] / dt), return_index=True)
        return Record(acceleration[at_sample][first] / result.scale, dt, name=result.record)


def _stripes(
    table: Columns, wall: Wall, engine: str, rtol: float, atol: float, edp_limit: float, work: Work
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
        return histories.matrix(values, ran.shape, (row, column))

    certified: dict[str, Any] = {}
    if "status" in table:
        numbers = [Certified[word.upper()] for word in table.texts("status")]
        certified = {
            "status": matrix(np.asarray(numbers, dtype=np.int32)),
            "edp_lowest": matrix(table.numbers("edp_lowest")),
            "edp_highest": matrix(table.numbers("edp_highest")),
        }
        # Results of earlier builds do not have it.
        if "edp_rounded" in table:
            certified["edp_rounded"] = matrix(table.given_numbers("edp_rounded"))
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
        runs=work._of_run(levels, names, signs, table.numbers("edp")),
        edp_error=matrix(table.numbers("edp_error")) if "edp_error" in table else None,
        uplift=matrix(table.numbers("uplift")) == 1.0 if "uplift" in table else None,
        **certified,
    )


def _typology(
    table: Columns,
    population: Population,
    work: Work,
    warnings: tuple[DondoloWarning, ...],
    flags: Flags | None,
    are_designs: bool,
) -> Typology:
    """Counts of all walls of a population, and its curves."""
    thresholds = np.unique(table.numbers("edp_threshold"))
    levels = np.unique(table.numbers("im_level"))
    shape = (len(population), len(thresholds), len(levels))
    if len(table) != np.prod(shape):
        product = " x ".join(map(str, shape))
        raise ValueError(f"{len(table)} rows: must be {product}, one for each wall, damage state and level")
    counts = table.counts("collapses").reshape(shape).transpose(1, 2, 0)
    histories = table.counts("histories", 1).reshape(shape)[:, 0].T
    of_rows = np.ascontiguousarray(counts), np.ascontiguousarray(histories)
    result = combine_rows(population, table.texts("im")[0], levels, thresholds, *of_rows, work, flags, are_designs)
    return replace(result, warnings=tuple(dict.fromkeys([*warnings, *result.warnings])))


def _uncertain(table: Columns, typology: Typology) -> UncertainWall:
    """What a wall with variants owes to each of its uncertain properties."""
    if len(typology.walls) < 3 + 2 * len(table):
        raise ValueError(f"{len(table)} rows: are too many sources for the {len(typology.walls)} walls of the run")

    # What a curve that does not exist leaves is empty.
    def numbers(name: str) -> Any:
        return np.array([table.number(name, i) if table.given(name, i) else np.nan for i in range(len(table))])

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
