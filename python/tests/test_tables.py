"""The docs describe every column of every table of a run, and every key of its file."""

import importlib.util
import json
import re
import subprocess

import pytest

import dondolo as dd
from dondolo._fortran.library import constants, properties

# What a case of the repository becomes, so that a column that few runs have is written
CASES = {
    "parapet": {"&stripes": "&solver certify = .true. /\n&stripes edp_thresholds = 0.3,"},
    "history": {"&history": "&solver estimate_error = .true. /\n&history"},
    "tied_facade": {},
    "facade": {},
    "facade_hinges": {},
    "facades": {"task = 'typology'": "task = 'typology', histories = .true."},
    "designs": {},
    "gable": {"&stripes": "&solver estimate_error = .true. /\n&stripes"},
    "population": {},
    "uncertain_strip": {"variants = 200": "variants = 38", "first = 0.2": "first = 0.4", "count = 15": "count = 4"},
}


@pytest.fixture(scope="module")
def written(executable, root, tmp_path_factory):
    """Folder with the results of small cases of every task: of the executable, and of Python."""
    folder = tmp_path_factory.mktemp("tables")
    for name, changes in CASES.items():
        text = (root / f"data/cases/{name}.nml").read_text().replace("'../", f"'{root}/data/")
        text = re.sub(r"output = '[^']*'", f"output = '{name}'", text)
        for old, new in changes.items():
            assert text.count(old) == 1, (name, old)
            text = text.replace(old, new)
        (folder / f"{name}.nml").write_text(text)
    few = dd.example_records()[:3]
    moved = [dd.Record(one.acceleration, one.dt, name=one.name, vertical=0.5 * one.acceleration) for one in few]
    dd.RecordSet(moved).to_catalogue(folder / "records.csv")
    (folder / "vertical.nml").write_text(
        "&job output = 'vertical' /\n&wall mechanism = 'one_sided', height = 3.0, thickness = 0.25 /\n"
        "&records catalogue = 'records.csv', vertical = 'recorded' /\n&stripes levels = 0.2, 0.4 /\n"
    )
    for name in (*CASES, "vertical"):
        subprocess.run([executable, "--quiet", f"{name}.nml"], cwd=folder, check=True, capture_output=True)
    walls = dd.Population.from_csv(root / "data/walls/designs.csv")
    typology = dd.typology(walls, dd.example_records()[:6], [0.3, 0.6, 0.9, 1.2], progress=False)
    typology.write_results(folder / "python")
    walls = dd.Population.from_csv(root / "data/walls/alternatives.csv", occurrence="exclusive")
    exclusive = dd.typology(walls, dd.example_records()[:6], [0.3, 0.6, 0.9, 1.2], progress=False)
    exclusive.write_results(folder / "exclusive")
    return folder


def described(root):
    """Tables and their columns in order, as the page of columns has them."""
    spec = importlib.util.spec_from_file_location("columns", root / "docs/columns.py")
    columns = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(columns)
    parts = re.split(r"(?m)^## `PREFIX_(\w+).csv`\n", columns.page())
    return {
        name: re.findall(r"(?m)^\| `(\w+)` \| [^|]* \| [^|]+ \|$", text)
        for name, text in zip(parts[1::2], parts[2::2], strict=True)
    }


def head(path):
    """Columns of a table."""
    with path.open() as lines:
        return next(line for line in lines if not line.startswith("#")).rstrip("\n").split(",")


def of_a_wall():
    """Columns of the properties of walls and buildings; those of lists without their number."""
    return {row.column: row for group in ("wall", "building") for row in properties(group) if row.column}


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore::dondolo.errors.DondoloWarning")
def test_columns_are_described(written, root):
    page, seen = described(root), {}
    for path in written.glob("*.csv"):
        if "_" in path.name:
            seen.setdefault(path.stem.rpartition("_")[2], []).append(head(path))
    assert set(seen) == set(page)
    for name, heads in seen.items():
        # Nothing is described that no table has
        assert set(page[name]) <= set().union(*heads), name
        for columns in heads:
            if name == "walls":
                plain = [re.sub(r"^([a-z]+)\d+", r"\1", column) for column in columns]
                columns = [column for column in plain if column not in of_a_wall()]
            # In the order of the page
            assert columns == [column for column in page[name] if column in columns], name


def test_tables_and_words_are_listed(root):
    assert {f"PREFIX_{name}.csv" for name in described(root)} == page_names(root)
    text = (root / "docs/files.md").read_text()
    for title, words in (
        ("Status of a fit", constants().statuses),
        ("Kinds of standard errors", {*constants().errors, "given"}),
    ):
        rows = re.findall(r"(?m)^\| ([^|]*) \|.*\|$", text.partition(f"### {title}\n")[2].partition("\n### ")[0])
        assert set(words) == {word for row in rows for word in re.findall(r"`([^`]+)`", row)} - {"status", "errors"}


@pytest.mark.slow
def test_heads_are_skipped(written, root):
    """As the page says for pandas."""
    pandas = pytest.importorskip("pandas")
    call = re.search(r"`pandas\.read_csv\(\"out/(\w+\.csv)\", (.*)\)`", (root / "docs/files.md").read_text())
    table = pandas.read_csv(written / call[1], **eval(f"dict({call[2]})"))
    assert list(table.columns) == head(written / call[1])
    assert table["wall"].eq("parapet").all()


def page_names(root):
    """Names of tables in the list of tables."""
    return set(re.findall(r"(?m)^\| `(PREFIX_\w+\.csv)` \|", (root / "docs/files.md").read_text()))


def test_names_of_columns_of_walls(root):
    """The rule of the page, and those that differ from it."""
    text = (root / "docs/files.md").read_text()
    section = text.partition("**Properties of walls**")[2].partition("\n\n")[0]
    differ = {row.column for row in of_a_wall().values() if row.column != by_rule(row)}
    assert {name for name in differ if f"`{name}`" in section} == differ
    assert f"{['no', 'one', 'two', 'three', 'four'][len(differ)]} names differ" in section.lower()


def by_rule(row):
    """Name of the column of a property by the rule of the page."""
    return re.sub(r"[/ ]", "_", f"{row.name}_{row.unit.lower()}" if row.unit else row.name)


@pytest.mark.slow
def test_keys_are_described(written, root):
    page = (root / "docs/files.md").read_text()
    keys = set(re.findall(r"(?m)^\| `(\w+)` \| (?:string|array|object|integer)", page))
    found = {path.name: set(json.loads(path.read_text())) for path in written.glob("*_run.json")}
    assert len(found) == len(CASES) + 3
    assert set().union(*found.values()) <= keys
    assert {"history"} == found["history_run.json"] - set().union(
        *(found[name] for name in found if name != "history_run.json")
    )
    rows = dict(re.findall(r"(?m)^\| `(\w+)` \| (?:string|array|object) \| (.*) \|$", page))
    for key in set().union(*found.values()) - found["history_run.json"] - {"certified", "floor"}:
        assert "not of task `history`" in rows[key], key


@pytest.mark.slow
def test_settings_in_force(written):
    """All variables with a default are in the settings; others are if they are given."""
    settings = json.loads((written / "tied_facade_run.json").read_text())["settings"]
    for group in ("job", "wall", "records", "stripes", "solver"):
        filled = {
            row.name
            for row in properties(group)
            if row.default != "optional" and (not row.owners or {"stripes", "one_sided"} & set(row.owners))
        }
        assert filled <= set(settings[group]), group
    assert "tie_strength" in settings["wall"]
    assert "tie_modulus" not in settings["wall"]


@pytest.mark.slow
@pytest.mark.filterwarnings("ignore::dondolo.errors.DondoloWarning")
@pytest.mark.parametrize("name", [*CASES, "vertical"])
def test_kinds_of_columns_are_those_of_the_library(written, name):
    """A table that is read has the kinds and the values of the one in memory, whatever its cells look like."""
    here, read = dd.run_case(written / f"{name}.nml", progress=False)._source, dd.read_results(written / name)._source
    assert here.names == read.names
    for table in sorted(here.names):
        for column in here[table]:
            mine, its = here[table].column(column), read[table].column(column)
            assert (mine.kind, len(mine.values)) == (its.kind, len(its.values)), (table, column)
            assert list(map(repr, mine.values)) == list(map(repr, its.values)), (table, column)
