"""One content whatever the route: the executable's files, `run_case`, and files that Python writes of its results.

What is compared follows from the list of tables and from the fields of results: a new part is covered by being there.
"""

import csv
import dataclasses
import io
import subprocess
import warnings
from collections.abc import Sequence
from pathlib import Path

import numpy as np
import pytest

import dondolo as dd
from dondolo._fortran.files import TABLES
from dondolo.exchange import running

ROOT = Path(__file__).resolve().parents[2]
READY = sorted(path.stem for path in (ROOT / "data/cases").glob("*.nml"))
LONG = {"historic_centre", "uncertain_strip"}
# Cases of tables and columns that no ready case has, out of one that is ready
MORE = {
    "certified": ("parapet", {"&stripes": "&solver certify = .true. /\n&stripes edp_thresholds = 0.3, 1.0,"}),
    "checked": ("tied_facade", {"&stripes": "&check ag = 0.2, f0 = 2.5, tc_star = 0.35 /\n&stripes"}),
    "ordinal": ("two_block", {"&stripes": "&stripes edp_thresholds = 0.2, 0.5, states = 'ordinal',"}),
    "tied_history": (
        "tied_facade",
        {
            "'stripes'": "'history'",
            "&stripes": "&history im_level = 1.5 /\n&solver estimate_error = .true. /\n&stripes",
        },
    ),
    "states": (
        "facades",
        {"&stripes": "&stripes edp_thresholds = 0.2, 0.6, 1.0,", "'typology'": "'typology', histories = .true."},
    ),
    "alternatives": (
        "population",
        {
            "walls/population.csv'": "walls/alternatives.csv', occurrence = 'exclusive'",
            "&stripes": "&stripes edp_thresholds = 0.5,",
        },
    ),
    "designs_in_states": ("designs", {"&stripes": "&stripes edp_thresholds = 0.4,"}),
    "few_variants": (
        "uncertain_strip",
        {"variants = 200": "variants = 40", "count = 15": "count = 5, edp_thresholds = 0.3, 1.0"},
    ),
}
CASES = [pytest.param(name, marks=pytest.mark.slow if name in LONG else ()) for name in (*READY, *MORE)]
# What files do not tell: which history is which, and the record of a motion; what only files have: where they are
NOT_IN_FILES = {"Typology.flags", "Typology.stored_curves", "Fragility.parts", "Results.case", "Response.record"} | {
    f"RunFile.{name}" for name in ("run", "path", "written", "files", "content")
}
# Nor, of a typology that is written by itself, its records: it has their formats, which are in the run's references
WRITTEN_ALONE = NOT_IN_FILES | {"Typology.record_formats"}


def case_of(name, folder):
    """A case in a folder, its results to be put there."""
    stem, changes = MORE.get(name, (name, {}))
    text = (ROOT / f"data/cases/{stem}.nml").read_text().replace("'../", f"'{ROOT}/data/")
    for old, new in changes.items():
        assert old in text
        text = text.replace(old, new)
    path = folder / f"{name}.nml"
    path.write_text(text.replace(f"'out/{stem}'", f"'{folder}/{name}'"))
    return path


@pytest.fixture(scope="module")
def ran(executable, tmp_path_factory):
    """Run a case once, by the executable and from Python: the prefix of the files, the results, and their tables."""
    known = {}

    def run(name):
        if name not in known:
            folder = tmp_path_factory.mktemp(name)
            case = case_of(name, folder)
            subprocess.run([executable, "--quiet", case], cwd=folder, capture_output=True, check=True)
            with warnings.catch_warnings():
                warnings.simplefilter("ignore", dd.errors.DondoloWarning)
                results = dd.run_case(case, progress=False)
            known[name] = folder / name, results, sent.pop()
        return known[name]

    sent = []

    def listen(parcel):
        tables, text = take(parcel)
        sent.append(tables)
        return tables, text

    take = running._tables
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(running, "_tables", listen)
        yield run
    if set(READY) <= set(known):
        written = {path.name.removeprefix(name) for name in known for path in known[name][0].parent.glob("*.csv")}
        assert written == set(TABLES), "a table that no case has is compared by none"


def differences(mine, theirs, place, ignored):
    """Where two results differ: in the type, the shape or a bit of anything that they are made of."""
    if type(mine) is not type(theirs):
        yield f"{place}: {type(mine).__name__}, {type(theirs).__name__}"
    elif isinstance(mine, np.ndarray):
        if mine.dtype != theirs.dtype or mine.shape != theirs.shape or mine.tobytes() != theirs.tobytes():
            yield f"{place}: {mine}, {theirs}"
    elif isinstance(mine, dict):
        if list(mine) != list(theirs):
            yield f"{place}: {list(mine)}, {list(theirs)}"
        for key in mine.keys() & theirs.keys():
            yield from differences(mine[key], theirs[key], f"{place}[{key!r}]", ignored)
    elif isinstance(mine, Sequence) and not isinstance(mine, str):
        if len(mine) != len(theirs):
            yield f"{place}: {len(mine)}, {len(theirs)}"
        for i, (one, two) in enumerate(zip(mine, theirs, strict=False)):
            yield from differences(one, two, f"{place}[{i}]", ignored)
    elif dataclasses.is_dataclass(mine):
        for name in parts_of(type(mine)):
            if f"{type(mine).__name__}.{name}" not in ignored:
                yield from differences(getattr(mine, name), getattr(theirs, name), f"{place}.{name}", ignored)
    elif isinstance(mine, float):
        if np.float64(mine).tobytes() != np.float64(theirs).tobytes():
            yield f"{place}: {mine!r}, {theirs!r}"
    elif isinstance(mine, dd.Wall):
        if repr(mine) != repr(theirs) or mine != theirs:
            yield f"{place}: {mine!r}, {theirs!r}"
    elif isinstance(mine, (dd.errors.DondoloWarning, bool, int, str, type(None))):
        if mine != theirs:
            yield f"{place}: {mine!r}, {theirs!r}"
    else:
        yield from differences(vars(mine), vars(theirs), place, ignored)


def parts_of(kind):
    """What an object is made of: its fields, and of results what follows from them."""
    names = [field.name for field in dataclasses.fields(kind) if not field.name.startswith("_")]
    return [*names, *{dd.results.Results: ("checks",), dd.results.Typology: ()}.get(kind, ())]


@pytest.mark.parametrize("name", CASES)
def test_tables(name, ran):
    """Columns in memory are those of the files: names, rows, texts, and numbers to the bit."""
    prefix, _, tables = ran(name)
    there = {end: prefix.with_name(prefix.name + end) for end in TABLES}
    assert set(tables) == {end for end, path in there.items() if path.is_file()}
    for end, table in tables.items():
        lines = [line for line in there[end].read_text().splitlines(keepends=True) if not line.startswith("#")]
        names, *rows = csv.reader(io.StringIO("".join(lines)))
        assert list(table) == names
        assert len(table) == len(rows) > 0
        for column, cells in zip(names, zip(*rows, strict=True), strict=True):
            given = [table.given(column, i) for i in range(len(rows))]
            assert given == [bool(cell) for cell in cells], f"{end}: {column}"
            own = table.column(column).values
            if isinstance(own, list):
                assert own == list(cells), f"{end}: {column}"
            else:
                numbers = np.array([float(cell) if cell else np.nan for cell in cells])
                assert np.array_equal(own, numbers, equal_nan=True), f"{end}: {column}"


@pytest.mark.parametrize("name", CASES)
@pytest.mark.filterwarnings("ignore::dondolo.errors.DondoloWarning")
def test_results(name, ran):
    """`run_case` has what `read_results` has of the executable's files."""
    prefix, mine, _ = ran(name)
    assert [*differences(mine, dd.read_results(prefix), name, NOT_IN_FILES)] == []


@pytest.mark.parametrize("name", ["facades", "states", "alternatives", "designs_in_states"])
@pytest.mark.filterwarnings("ignore::dondolo.errors.DondoloWarning")
def test_damage_states(name, ran):
    """The same of every damage state."""
    prefix, mine, _ = ran(name)
    theirs = dd.read_results(prefix).typology
    for edp in mine.typology.edp_thresholds:
        assert [*differences(mine.typology.at(edp), theirs.at(edp), name, NOT_IN_FILES)] == []


def cells(path):
    """Names of columns and rows of a table."""
    return [*csv.reader(line for line in path.read_text().splitlines() if not line.startswith("#"))]


@pytest.mark.parametrize("name", CASES)
@pytest.mark.filterwarnings("ignore::dondolo.errors.DondoloWarning")
def test_written_results(name, ran, tmp_path):
    """Results from memory and from files, written by Python: the executable's tables, and the same results again."""
    prefix, mine, _ = ran(name)
    theirs = dd.read_results(prefix)
    for number, results in enumerate((mine, theirs)):
        written = tmp_path / str(number)
        results.write_results(written)
        for end in TABLES:
            there = prefix.with_name(prefix.name + end)
            assert written.with_name(written.name + end).is_file() == there.is_file()
            assert not there.is_file() or cells(written.with_name(written.name + end)) == cells(there), end
        assert [*differences(theirs, dd.read_results(written), name, NOT_IN_FILES)] == []


@pytest.mark.parametrize("name", CASES)
@pytest.mark.filterwarnings("ignore::dondolo.errors.DondoloWarning")
def test_written_objects(name, ran, tmp_path):
    """A part of the results that is written alone is read again as it is, from memory and from files."""
    prefix, mine, _ = ran(name)
    theirs = dd.read_results(prefix)
    for part in ("stripes", "typology", "uncertain", "designs"):
        for number, whole in enumerate((mine, theirs)):
            one = getattr(whole, part)
            if one is None:
                continue
            given = {"edp_thresholds": mine.edp_thresholds or None, "states": mine.states} if part == "stripes" else {}
            one.write_results(tmp_path / f"{part}{number}", **given)
            back = dd.read_results(tmp_path / f"{part}{number}")
            assert [*differences(getattr(theirs, part), getattr(back, part), f"{name}.{part}", WRITTEN_ALONE)] == []
            if part == "stripes":
                ignored = {*NOT_IN_FILES, "Fragility.parts"}
                assert [*differences(theirs.fragility, back.fragility, f"{name}.fragility", ignored)] == []


@pytest.mark.parametrize("name", CASES)
@pytest.mark.filterwarnings("ignore::dondolo.errors.DondoloWarning")
def test_objects_of_python(name, ran):
    """The walls and records of a case, analysed by `multiple_stripe` and `typology`: the results of the executable."""
    _, mine, _ = ran(name)
    case = mine.case
    if case.task == "history":
        pytest.skip("a history is no study")
    solver = dd.Solver(rtol=case.rtol, atol=case.atol, edp_limit=case.edp_limit, engine=case.engine)
    given = {"im": case.im, "polarity": case.polarity, "solver": solver, "progress": False}
    if case.task == "stripes":
        wall = case.population.walls[0]
        own = dd.multiple_stripe(
            wall, case.records, case.levels, estimate_error=case.estimate_error, certify=case.certify, **given
        )
        ignored = {f"Stripes.{field}" for field in ("engine", "runs", "work")}
        assert [*differences(own, mine.stripes, name, ignored)] == []
        return
    own = dd.typology(case.population, case.records, case.levels, edp_thresholds=case.edp_thresholds, **given)
    # Designs are alternatives in a case; Python is not told, and warns of no table.
    ignored = {"Typology.population", "Typology.warnings"} | ({"Typology.groups"} if case.designs else set())
    if case.designs:
        ignored |= {"Typology.group_union_curves"}
    assert [*differences(own, mine.typology, name, ignored)] == []


def without_paths(results):
    """Names of the tables of a set and their bytes below the comments."""
    return {
        end: "".join(line for line in path.read_text().splitlines(keepends=True) if not line.startswith("#"))
        for end in TABLES
        if (path := results.with_name(results.name + end)).is_file()
    }


@pytest.mark.parametrize("name", ["parapet", "tied_facade", "checked", "certified", "ordinal"])
@pytest.mark.filterwarnings("ignore::dondolo.errors.DondoloWarning")
def test_stripes_of_python(name, ran, tmp_path):
    """Stripes that Python writes alone: the tables of the executable, to the byte, but for those of the case."""
    prefix, mine, _ = ran(name)
    mine.stripes.write_results(tmp_path / "own", edp_thresholds=mine.edp_thresholds or None, states=mine.states)
    theirs = without_paths(prefix)
    own = without_paths(tmp_path / "own")
    assert set(theirs) - set(own) <= {"_check.csv", "_calculation.csv"}
    assert own == {end: theirs[end] for end in own}
    assert ("_ties.csv" in own) == (name in ("tied_facade", "checked"))


@pytest.mark.filterwarnings("ignore::dondolo.errors.DondoloWarning")
def test_designs_of_python(ran, tmp_path):
    """Designs that Python compares: the tables of the executable's case with designs, to the byte."""
    prefix, mine, _ = ran("designs")
    walls = {wall.name: wall for wall in mine.population.walls}
    site = dd.Site(0.2, 2.5, 0.35, soil="B")
    own = dd.compare_designs(walls, mine.case.records, mine.case.levels, site=site, progress=False)
    own.write_results(tmp_path / "own")
    assert without_paths(tmp_path / "own") == without_paths(prefix)
    back = dd.read_results(tmp_path / "own")
    ignored = {*WRITTEN_ALONE, "Typology.warnings", "Typology.work", "Work.walls"}
    assert [*differences(mine.designs, back.designs, "designs", ignored)] == []
    assert [check.rows for check in back.checks] == [check.rows for check in mine.checks]
    levels = {name: np.array(mine.case.levels) * (1.0 if name == "bare" else 1.1) for name in walls}
    one = dd.compare_designs(walls, mine.case.records[:4], levels | {next(iter(walls)): [0.5, 1.0]}, progress=False)
    with pytest.raises(dd.errors.InputError, match="levels of their own"):
        one.write_results(tmp_path / "other")


@pytest.mark.parametrize("name", ["population", "designs", "facade_hinges", "states", "designs_in_states"])
@pytest.mark.filterwarnings("ignore::dondolo.errors.DondoloWarning")
def test_written_by_python(name, ran, tmp_path):
    """Files that Python writes of results hold the same typology."""
    prefix, mine, _ = ran(name)
    theirs = dd.read_results(prefix).typology
    for number, typology in enumerate((mine.typology, theirs)):
        typology.write_results(tmp_path / str(number))
        back = dd.read_results(tmp_path / str(number)).typology
        assert [*differences(theirs, back, name, WRITTEN_ALONE)] == []


def test_warnings(tmp_path):
    """Stripes carry the warnings of their runs, by every route; a curve warns of itself."""
    wall = dd.OneSidedWall(1.5, 0.25)
    records = dd.synthetic_records(6.5, 10.0, "shallow", n_records=4)
    with warnings.catch_warnings(record=True) as heard:
        warnings.simplefilter("always", dd.errors.DondoloWarning)
        stripes = dd.multiple_stripe(wall, records, [0.5, 9.0], estimate_error=True, progress=False)
        later = dd.multiple_stripe(wall, records, [0.7], estimate_error=True, progress=False)
    codes = [one.code for one in stripes.warnings]
    assert {"levels_above_usual", "scale_factors_large"} <= set(codes)
    assert [one.message for one in heard] == [*stripes.warnings, *later.warnings]
    assert stripes[:1].warnings == stripes.warnings
    assert (stripes + later).warnings == tuple(dict.fromkeys([*stripes.warnings, *later.warnings]))
    assert stripes.certify(records, progress=False).warnings == tuple(
        one for one in stripes.warnings if one.code not in ("ill_conditioned", "collapse_in_doubt")
    )
    stripes.save(tmp_path / "stripes.npz")
    assert dd.load(tmp_path / "stripes.npz").warnings == stripes.warnings
    stripes.write_results(tmp_path / "stripes")
    with warnings.catch_warnings(record=True) as heard:
        warnings.simplefilter("always", dd.errors.DondoloWarning)
        curve = stripes.fit()
        of_curve = [one.message for one in heard]
        back = dd.read_results(tmp_path / "stripes")
    assert back.stripes.warnings == stripes.warnings
    assert back.run.warnings == (*stripes.warnings, *of_curve)
    assert back.fragility.status == curve.status
