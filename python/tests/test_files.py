"""Files that Python writes: whole or not at all, and read back."""

import dataclasses
import os
import pickle
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
import study

import dondolo as dd
from dondolo._fortran.files import whole_file
from dondolo._fortran.library import build_variant
from dondolo._storage import tables

pytestmark = pytest.mark.filterwarnings("ignore::dondolo.errors.DondoloWarning")


def half(path, error):
    """Begin to write a file, and fail."""
    with whole_file(path) as part:
        part.write_text("half")
        raise error


def test_a_file_appears_whole_or_not_at_all(tmp_path):
    path = tmp_path / "table.csv"
    path.write_text("before")
    for error in (RuntimeError, KeyboardInterrupt):
        with pytest.raises(error):
            half(path, error)
    with pytest.raises(dd.errors.DondoloError, match="cannot be written: No space left"):
        half(path, OSError(28, "No space left on device"))
    # What cannot be encoded leaves nothing behind either.
    with pytest.raises(UnicodeEncodeError):
        tables.write_lines(path, ["a\udc80b"])
    assert (path.read_text(), os.listdir(tmp_path)) == ("before", ["table.csv"])
    with whole_file(path) as part:
        part.write_text("after")
    assert (path.read_text(), os.listdir(tmp_path)) == ("after", ["table.csv"])


WRITTEN = [
    *(
        "city_fragility.csv",
        "city_run.json",
        "city_stripes.csv",
        "city_typology.csv",
        "city_unions.csv",
        "city_walls.csv",
    )
]


@pytest.fixture(scope="module")
def people(few):
    walls = [
        dd.OneSidedWall(1.5, 0.25, name="a", gravity=9.7),
        dd.TwoBlockWall(3.0, 0.25, name="a", gravity=9.7),
        dd.OneSidedWall(2.0, 0.30, name="b, with a comma", gravity=9.7),
    ]
    population = dd.Population(walls, [2.0, 2.0, 1.0], group_names=["low", "low", "high"], p_occ=[0.6, 0.5, 1.0])
    levels = [0.2, 0.4, 0.6, 0.8, 1.0, 1.2]
    return dd.typology(population, few, levels, polarity="both", edp_thresholds=[0.3], progress=False)


@pytest.mark.slow
def test_a_typology_is_saved_and_read_back(people, tmp_path):
    prefix = tmp_path / "city"
    people.write_results(prefix)
    assert sorted(os.listdir(tmp_path)) == WRITTEN
    stored = dd.read_results(prefix)
    again = stored.typology
    assert again.population.walls == people.population.walls
    assert np.array_equal(again.exceedances, people.exceedances)
    assert np.array_equal(again["all"].mean_curve, people["all"].mean_curve)
    assert [curve.fit.theta for curve in again.groups] == [curve.fit.theta for curve in people.groups]
    assert (again.work, again.warnings) == (people.work, people.warnings)
    assert people.warnings
    for command, made in (("nrml", "fragility.xml"), ("report", "report.html"), ("plot", "typology.png")):
        done = subprocess.run(
            [sys.executable, "-m", "dondolo", command, str(prefix)], capture_output=True, text=True, check=False
        )
        assert done.returncode == 0, done.stderr
        assert (tmp_path / f"city_{made}").is_file()
    assert str(people.warnings[0]) in (tmp_path / "city_report.html").read_text().replace("&#39;", "'")


def test_nothing_of_an_earlier_run_is_left(people, tmp_path):
    for name in ("histories", "history", "typology"):
        (tmp_path / f"city_{name}.csv").write_text("# dondolo 0.0.1\nwall\n")
    (tmp_path / "cities_history.csv").write_text("# dondolo 0.0.1\nwall\n")
    people.write_results(tmp_path / "city")
    assert sorted(os.listdir(tmp_path)) == ["cities_history.csv", *WRITTEN]
    # What dondolo did not write is not its own to remove.
    (tmp_path / "city_history.csv").write_text("The history of the city\n")
    people.write_results(tmp_path / "city")
    assert (tmp_path / "city_history.csv").read_text() == "The history of the city\n"
    # A table that cannot be written leaves the others as they were.
    before = [(tmp_path / name).read_bytes() for name in WRITTEN[:-1]]
    (tmp_path / "city_walls.csv").unlink()
    (tmp_path / "city_walls.csv").mkdir()
    changed = dataclasses.replace(people, warnings=(dd.errors.DondoloWarning("other", "note"),))
    with pytest.raises(dd.errors.DondoloError, match=r"city_walls\.csv: cannot be written: is a folder"):
        changed.write_results(tmp_path / "city")
    assert [(tmp_path / name).read_bytes() for name in WRITTEN[:-1]] == before
    assert not list(tmp_path.glob("*.part"))


@pytest.fixture(scope="module")
def damaged(executable, root, tmp_path_factory):
    """The result files of a task with something replaced, and their prefix."""
    folder = tmp_path_factory.mktemp("damaged")
    for task in ("parapet", "history", "population"):
        subprocess.run([executable, "--quiet", root / f"data/cases/{task}.nml"], cwd=folder, check=True)

    def change(task, table, pattern, instead):
        prefix = folder / "out" / task
        path = Path(f"{prefix}_{table}" + ("" if table == "run.json" else ".csv"))
        text = path.read_text()
        changed, number = re.subn(pattern, instead, text, count=1, flags=re.MULTILINE)
        assert number
        path.write_text(changed)
        try:
            with pytest.raises(dd.errors.InputError) as caught:
                dd.read_results(prefix)
        finally:
            path.write_text(text)
        sentence = str(caught.value)
        assert sentence.startswith(f"{path}: ")
        return sentence[len(f"{path}: ") :]

    return change


@pytest.mark.parametrize(
    ("task", "table", "pattern", "instead", "sentence"),
    [
        (
            "population",
            "walls",
            r"^(parapet brick low,.*),.*,.*$",
            r"\1",
            r"line \d+: 18 cells: must be 20 as in the header",
        ),
        (
            "population",
            "stripes",
            r"^(parapet brick low,.*),.*$",
            r"\1",
            r"line \d+: 7 cells: must be 8 as in the header",
        ),
        ("parapet", "histories", r"^(parapet,.*),", r"\1", r"line \d+: 10 cells: must be 11 as in the header"),
        ("parapet", "histories", r"^parapet,", "p" * 200000 + ",", r"line \d+: field larger than field limit"),
        ("history", "run.json", r'"record": ".*",', "", "record = None: must be of type str"),
        ("history", "run.json", r'"collapsed": ', '"collapsed": 1 ', "not JSON: .*line"),
        ("history", "run.json", r'"impacts": ', '"impacts": 1.5, "i": ', "impacts = 1.5: must be of type int"),
        ("history", "run.json", r'^  "history": {$', '"none": {', "no 'history'"),
        ("parapet", "run.json", r"dondolo run 2", "dondolo run 0", "not a run file: format must be 'dondolo run 2'"),
        (
            "parapet",
            "run.json",
            r'"rtol": .*,',
            '"rtol": "small",',
            "settings: solver: rtol = 'small': must be of type",
        ),
        (
            "parapet",
            "run.json",
            r'"task": "stripes"',
            '"task": "dance"',
            "settings: job: task = 'dance': must be one of",
        ),
        ("parapet", "run.json", r'"warnings": \[', '"warnings": [1, ', "warnings: 1: must be of type dict"),
        ("history", "history", ",rotation_rad,", ",rotation,", "no column 'rotation_rad'"),
        ("history", "history", r"^0\.0*E\+00,", "nan,", r"line \d+: time_s = 'nan': must be a number"),
        ("parapet", "run.json", r'"steps": ', '"leaps": ', "work: .*unexpected keyword argument 'leaps'"),
        ("parapet", "histories", r"^parapet,.*\n", "", r"\d+ rows: are not the \d+ histories of the run"),
        ("population", "stripes", r"^parapet brick low,.*\n", "", r"\d+ rows: must be 24 x 1 x 12, one for each wall"),
        ("population", "walls", ",one_sided,", ",arch,", r"line \d+: mechanism = 'arch': must be one of 'one_sided'"),
        (
            "population",
            "walls",
            r"^(parapet brick low,[a-z_]*),[^,]*",
            r"\1,-1",
            r"line \d+: height = -1: must be positive",
        ),
    ],
)
def test_what_is_wrong_with_a_result_file_is_named(damaged, task, table, pattern, instead, sentence):
    assert re.match(sentence, damaged(task, table, pattern, instead))


def test_a_cell_is_no_comment(people, tmp_path):
    people.write_results(tmp_path / "city")
    path = tmp_path / "city_walls.csv"
    # As a file of an earlier version may have it
    forged = path.read_text().replace('"b, with a comma"', "\"b\n# &job task = 'history'\"")
    path.write_text(forged)
    with pytest.raises(dd.errors.InputError, match=r"city_walls\.csv: line \d+: name = .*: must be one line"):
        dd.read_results(tmp_path / "city")


def test_a_missing_file_is_a_missing_file(tmp_path):
    missing = tmp_path / "none.csv"
    catalogue = tmp_path / "records.csv"
    catalogue.write_text("file,dt_s,units\nnone.txt,0.01,g\n")
    case = tmp_path / "case.nml"
    case.write_text("&wall mechanism = 'one_sided' height = 3 thickness = 0.3 / &records catalogue = 'none.csv' /\n")
    for read, path in (
        (dd.read_record, missing),
        (dd.read_records, missing),
        (dd.read_catalogue, missing),
        (dd.read_catalogue, catalogue),
        (dd.Population.from_csv, missing),
        (dd.read_case, missing),
        (dd.read_results, tmp_path / "none"),
        (dd.HazardCurve.from_csv, missing),
    ):
        with pytest.raises(FileNotFoundError) as caught:
            read(path)
        assert isinstance(caught.value, dd.errors.InputError)
        assert pickle.loads(pickle.dumps(caught.value)).args == caught.value.args
        assert "none" in str(caught.value)
    case.write_text(case.read_text() + "&stripes levels = 0.1, 0.2 /\n")
    with pytest.raises(dd.errors.MissingFileError, match=r"&records: catalogue = 'none.csv': there is no file"):
        dd.read_case(case)


def escaped(character):
    """A character as messages show it."""
    words = {"\n": r"\n", "\r": r"\r", "\t": r"\t"}
    code = ord(character)
    return words.get(character) or (f"\\x{code:02x}" if code < 256 else f"\\u{code:04x}")


@pytest.mark.parametrize(
    "character",
    list("\n\r\0\x1b\x0b\x0c\x7f\x85\u2028\u2029\u061c\u200e\u200f\u202a\u202e\u2066\u2069"),
)
def test_names_stand_on_one_line(character, wall, sine, tmp_path):
    name = f"a{character}b"
    for make in (
        lambda: dd.OneSidedWall(3.0, 0.25, name=name),
        lambda: dd.Record(sine.acceleration, sine.dt, name=name),
        lambda: dd.Population([wall], group_names=[name]),
        lambda: dd.Population([wall], origin=[name]),
    ):
        with pytest.raises(dd.errors.InputError, match="must be one line without control characters"):
            make()
    # What a table says is refused as well, and the name that a file gives its record is made plain.
    (tmp_path / "record.txt").write_text("0\n1\n0\n")
    for table, header, row in (
        ("records.csv", "file,dt_s,units,name", f'record.txt,0.01,g,"{name}"'),
        ("walls.csv", "name,mechanism,height,thickness", f'"{name}",one_sided,3,0.25'),
    ):
        (tmp_path / table).write_bytes(f"{header}\n{row}\n".encode())
        read = dd.read_catalogue if table == "records.csv" else dd.Population.from_csv
        refusal = "byte .* is NUL: this is not a text file" if character == "\0" else "name = .*: must be one line"
        with pytest.raises(dd.errors.InputError, match=f"{table}: line 2: {refusal}"):
            read(tmp_path / table)
    if character != "\0":
        path = tmp_path / f"{name}.txt"
        path.write_text("0\n1\n0\n")
        assert dd.read_record(path, dt=0.01, units="g").name == f"a{escaped(character)}b"


def test_files_have_the_names_and_columns_of_the_executable(run, root, tmp_path):
    case = root / "data/cases/population.nml"
    assert run("--quiet", case).returncode == 0
    # The same build variant, so that digits agree
    assert build_variant() in run("--version").stdout
    dd.run_case(case, progress=False).typology.write_results(tmp_path / "mine")
    for table in ("walls", "stripes", "fragility", "typology"):
        rows = [
            [line for line in (tmp_path / name).read_text().splitlines() if not line.startswith("#")]
            for name in (f"mine_{table}.csv", f"out/population_{table}.csv")
        ]
        assert study.same_tables(table, *rows)


def test_standard_errors_of_populations_stay_with_their_files(run, root, tmp_path):
    """By records and walls, of mechanisms in series that may not occur, in groups, in several damage states."""
    case = tmp_path / "case.nml"
    walls = tmp_path / "walls.csv"
    walls.write_text(
        "name,mechanism,height,thickness,hinge,weight,group,p_occ\n"
        "a,one_sided,3.0,0.3,,2,low,0.7\na,two_block,3.0,0.3,0.6,2,low,0.8\n"
        "b,one_sided,2.0,0.25,,1,low,1\nc,one_sided,1.5,0.25,,3,high,0\nc,two_block,2.5,0.2,0.5,3,high,1\n"
        "d,one_sided,2.5,0.3,,1,high,1\ne,two_block,3.0,0.2,0.55,0.5,,0.9\nf,one_sided,2.2,0.3,,0,high,1\n"
    )
    case.write_text(
        f"&job task = 'typology', output = 'out/some' /\n&population file = '{walls}' /\n"
        f"&records catalogue = '{root}/data/records/synthetic44.csv', polarity = 'both' /\n"
        "&stripes im = 'pga', levels = 0.2, 0.4, 0.6, 0.8, 1.0, 1.4, edp_thresholds = 0.3, 1.0 /\n"
    )
    said = run("--threads", 1, case)
    assert said.returncode == 0
    assert "\n  standard errors over records and walls: 0.0" in said.stdout
    assert "  no standard errors: 2 walls, at least 3 are needed for the spread between walls" in said.stdout
    with pytest.warns(dd.errors.DondoloWarning):
        ran = dd.run_case(case, progress=False).typology
    read = dd.read_results(tmp_path / "out/some").typology
    for back in (read, saved_and_loaded(read, tmp_path)):
        for edp in ran.edp_thresholds:
            mine, theirs = ran.at(edp), back.at(edp)
            pairs = [
                *zip(mine.curves, theirs.curves, strict=True),
                *((one.fit, two.fit) for one, two in zip(mine.groups, theirs.groups, strict=True)),
            ]
            kinds = {one.errors for one, _ in pairs if one.has_fit}
            assert {"clustered", "few_walls"} <= kinds
            for one, two in pairs:
                if one.has_fit:
                    assert (one.errors, one.clusters) == (two.errors, two.clusters)
                    np.testing.assert_allclose(two.covariance, one.covariance, rtol=1e-10)
                    np.testing.assert_allclose(two.degrees_of_freedom, one.degrees_of_freedom, rtol=1e-12)
    # Of walls whose mechanisms are in series, by the sums of NumPy
    people, records = ran.population, dd.read_catalogue(root / "data/records/synthetic44.csv")
    given = {"polarity": "both", "edp_thresholds": [0.3], "progress": False}
    with pytest.warns(dd.errors.DondoloWarning):
        objects = dd.typology(people, records, ran.levels, **given)
    for edp in ran.edp_thresholds:
        for name, curve in objects.at(edp).combined.items():
            stored = read.at(edp).combined[name]
            assert (stored.errors, stored.clusters) == (curve.errors, curve.clusters)
            np.testing.assert_allclose(stored.covariance, curve.covariance, rtol=1e-9)
    assert read.combined["a"].se_ln_theta > 1.2 * read.combined["a"].naive_covariance[0, 0] ** 0.5
    with pytest.raises(dd.errors.InputError, match="or of a population read from files, has no records of its own"):
        back["all"].fit.compare(back["all"].fit)


def saved_and_loaded(results, folder):
    """Results out of a file."""
    results.save(folder / "saved.npz")
    return dd.load(folder / "saved.npz")


@pytest.mark.parametrize(
    ("table", "column", "cell", "message"),
    [
        ("typology", "errors", "some", "errors = 'some': must be one of 'clustered', 'few_clusters'"),
        ("fragility", "se_beta", "-1", "se_beta = -1: is not possible"),
        ("fragility", "cov_ln_theta_beta", "2", "cov_ln_theta_beta = 2: is not possible"),
        ("typology", "se_ln_theta", "", "se_ln_theta = '': must be a number"),
        ("typology", "clusters", "1.5", "clusters = 1.5: must be an integer between 0 and 2147483647"),
        ("typology", "degrees_of_freedom", "0", "degrees_of_freedom = 0: is not possible"),
    ],
)
def test_standard_errors_that_cannot_be(few, tmp_path, table, column, cell, message):
    walls = [dd.OneSidedWall(1.5 + 0.2 * i, 0.25, name=f"{i}") for i in range(3)]
    levels = [0.4, 0.6, 0.8, 1.0]
    dd.typology(walls, few, levels, progress=False).write_results(tmp_path / "city")
    path = tmp_path / f"city_{table}.csv"
    lines = path.read_text().splitlines()
    first = next(i for i, line in enumerate(lines) if not line.startswith("#"))
    row = lines[first + 1].split(",")
    row[lines[first].split(",").index(column)] = cell
    lines[first + 1] = ",".join(row)
    path.write_text("\n".join(lines) + "\n")
    with pytest.raises(dd.errors.InputError, match=re.escape(f"city_{table}.csv: line {first + 2}: {message}")):
        dd.read_results(tmp_path / "city")


def test_what_cannot_be_saved(people, few, tmp_path):
    walls = [dd.OneSidedWall(1.5, 0.25, name="a", gravity=9.7), dd.OneSidedWall(1.5, 0.25, name="b")]
    uneven = dd.typology(walls, few, [0.4, 0.8], progress=False)
    with pytest.raises(dd.errors.InputError, match=r"gravity = 9\.7 and 9\.81: must be the same for all walls"):
        uneven.write_results(tmp_path / "city")
    assert not os.listdir(tmp_path)
    with pytest.raises(dd.errors.InputError, match="prefix = 5: must be the path of a file"):
        people.write_results(5)
    with pytest.raises(dd.errors.InputError, match=r"prefix = '.*/': must be the path of a file"):
        people.write_results(f"{tmp_path}/")
