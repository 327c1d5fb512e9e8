"""Messages: safe on a terminal whatever files are called, of bounded length, and made in linear time."""

import datetime
import json
import os
import subprocess
import sys
import warnings
from unittest import mock

import numpy as np
import pytest
from costs import growth

import dondolo as dd
from dondolo.__main__ import main
from dondolo.errors import visible

# A colour, the title of a window, a mark that turns the direction round, C1, DEL, a separator of lines
STEERING = "\x1b[31m \x1b]0;x\x07 \u202e \u2066 \x9b \x7f \u2028 \r"


def is_safe(text):
    return all(line.isprintable() for line in text.split("\n"))


@pytest.mark.parametrize("kind", [dd.errors.DondoloError, dd.errors.InputError, dd.errors.MissingFileError])
def test_errors_show_what_steers_a_terminal(kind):
    """Of a file that does not exist too, whose class is one of Python's."""
    shown = str(kind(f"{STEERING}.csv: cannot be read\nsecond {STEERING}"))
    assert is_safe(shown)
    assert len(shown.split("\n")) == 2
    assert r"\x1b[31m" in shown
    assert r"\u202e" in shown
    assert len(str(kind("a" * 100_000))) < 2000


def test_warnings_show_what_steers_a_terminal():
    one = dd.errors.DondoloWarning(f"record '{STEERING}'", "note")
    for shown in (str(one), str(one.placed(f"{STEERING}: ")), one.as_data()["sentence"]):
        assert is_safe(shown)
    assert len(str(dd.errors.DondoloWarning("a" * 100_000, "note"))) < 2000


def test_a_path_that_is_not_text_can_be_printed():
    shown = visible(os.fsdecode(b"caff\xe8.csv"))
    assert shown.encode("ascii") == rb"caff\udce8.csv"


@pytest.fixture
def folder(tmp_path):
    """A folder of such a name."""
    made = tmp_path / STEERING
    made.mkdir()
    return made


def test_files_of_such_names(folder):
    """Whichever reader quotes them."""
    bad = folder / "bad"
    bad.write_text("nothing of use\n")
    for read in (
        dd.read_record,
        dd.read_catalogue,
        dd.Population.from_csv,
        dd.HazardCurve.from_csv,
        dd.read_nrml,
        dd.load,
    ):
        for path in (bad, folder / "none"):
            with pytest.raises(dd.errors.InputError) as error:
                read(path)
            assert is_safe(str(error.value))
            assert "\n" not in str(error.value)
    hazard = folder / "hazard.csv"
    hazard.write_text("pga,annual_frequency,F0\n0.1,0.01,1\n9.0,0.001,1\n")
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        dd.HazardCurve.from_csv(hazard)
    assert len(caught) == 2
    assert all(is_safe(str(one.message)) for one in caught)


@pytest.mark.parametrize(
    "arguments",
    [["report", "{}/none"], ["plot", "{}/none"], ["xlsx", "{}/none"], ["nrml", "{}/none"], ["records", "{}/none"]],
)
def test_commands_in_such_folders(folder, arguments, capsys):
    assert main([one.format(folder) for one in arguments]) == 2
    printed = capsys.readouterr()
    assert printed.err.startswith("dondolo: ")
    assert is_safe(printed.out + printed.err)


def test_arguments_that_are_wrong(capsys):
    with pytest.raises(SystemExit):
        main(["report", "a", STEERING])
    assert is_safe(capsys.readouterr().err)


def test_the_executable_in_such_folders(executable, folder):
    """Its errors, its plan, its warnings and the command that it proposes."""
    name = "\x1b[31m\u202e.nml"
    catalogue = os.path.relpath(os.path.dirname(__file__) + "/../../data/records/synthetic44.csv", folder)
    case = f"""&job task = 'stripes', output = 'out/a' /
&wall mechanism = 'one_sided', height = 1.5, thickness = 0.25 /
&records catalogue = '{catalogue}' /
&stripes im = 'pga', levels = 0.5, 9.0 /
"""
    (folder / name).write_text(case)
    (folder / f"a{name}").write_text(case.replace("1.5", "-1.5"))
    for arguments in (["--check", name], [f"a{name}"], [name + "x"], ["--" + name], [name, name]):
        done = subprocess.run([executable, *arguments], cwd=folder, capture_output=True, check=False)
        printed = (done.stdout + done.stderr).decode()
        assert printed
        assert is_safe(printed), arguments


LONG_LISTS = {
    "sections": (
        lambda n: [dd.Section(1e-3, 0.25, fill=fill) for fill in -1.0 - 1e-3 * np.arange(n)],
        lambda n: "[0].fill = -1:",
    ),
    "the last section": (
        lambda n: [dd.Section(1e-3, 0.25, fill=fill) for fill in np.append(np.full(n - 1, 0.5), 7.0)],
        lambda n: f"sections[{n - 1}].fill = 7: must be positive and at most 1",
    ),
    "equal sections": (
        lambda n: [dd.Section(1e-3, 0.25, base_width=np.nan)] * n,
        lambda n: "sections[0].base_width = nan: must",
    ),
    "hinge_level": (lambda n: np.linspace(1.6, 3.0, n), lambda n: "more"),
    "loads": (
        lambda n: [dd.Load(-5.0, depth=0.1, height=1.0, inertia="both")] * n,
        lambda n: "loads[0].force = -5: must",
    ),
}


@pytest.mark.parametrize("what", LONG_LISTS)
def test_long_lists_of_a_wall(what):
    """Eight times the length costs about eight times as much, and not 64 times."""
    make, expected = LONG_LISTS[what]
    name = "sections" if "section" in what else what
    sizes = {} if name == "sections" else {"height": 1.5, "thickness": 0.25}
    lists = {n: make(n) for n in (2000, 16_000)}

    def refused(n):
        with pytest.raises(dd.errors.InputError) as error:
            dd.OneSidedWall(**sizes, **{name: lists[n]})
        return str(error.value)

    for n in lists:
        assert expected(n) in refused(n)
        assert len(refused(n)) < 2000
    assert growth(refused, *lists) < 24.0


@pytest.fixture(scope="module")
def results(tmp_path_factory, wall, few):
    """Tables of a population."""
    prefix = tmp_path_factory.mktemp("messages") / "walls"
    dd.typology([wall, dd.OneSidedWall(2.0, 0.3, name="b")], few, [0.4, 0.8], progress=False).write_results(prefix)
    return prefix


@pytest.mark.parametrize("year", [1970, 2108, 2500])
def test_a_workbook_whatever_the_clock_says(results, tmp_path, year):
    """Archives have no dates before 1980 and after 2107."""
    openpyxl = pytest.importorskip("openpyxl")
    path = tmp_path / "walls.xlsx"
    seconds = datetime.datetime(year, 6, 1, tzinfo=datetime.UTC).timestamp()
    with mock.patch("time.time", return_value=seconds):
        dd.write_workbook(results, path)
        dd.write_workbook(results, path)
    assert openpyxl.load_workbook(path).sheetnames[:2] == ["case", "walls"]


@pytest.mark.parametrize("seconds", [-(2**31), 2**33, 2**60])
def test_results_whatever_their_dates(results, seconds):
    path = results.with_name("walls_run.json")
    with mock.patch("os.stat", return_value=mock.Mock(st_mtime=float(seconds), st_mode=0o100644)):
        from dondolo._storage.run_file import read_run_file

        assert 1970 <= read_run_file(str(path)).written.year <= 9999


@pytest.mark.parametrize(
    ("name", "old", "new"),
    [
        ("_walls.csv", b"height", b"\xffeight"),
        ("_stripes.csv", b"\n0", b"\n"),
        ("_run.json", b'"title": ""', b'"title": {"a": [1]}'),
        ("_run.json", b'"threads": ', b'"threads": 1e999, "x": '),
        ("_run.json", b"_walls.csv", b"_walls/x.csv"),
        ("_run.json", b'"settings"', b'"set"'),
    ],
)
def test_a_damaged_set_of_results_ends_in_a_sentence(results, tmp_path, name, old, new):
    """Of a workbook nothing else is said."""
    pytest.importorskip("xlsxwriter")
    for file in results.parent.iterdir():
        content = file.read_bytes()
        changed = content.replace(old, new, 1) if file.name == f"walls{name}" else content
        (tmp_path / file.name).write_bytes(changed)
    done = subprocess.run(
        [sys.executable, "-m", "dondolo", "xlsx", tmp_path / "walls"], capture_output=True, text=True, check=False
    )
    assert done.returncode in (0, 2)
    lines = done.stderr.splitlines()
    assert len(lines) == (done.returncode == 2)
    assert all(line.startswith(f"dondolo: {tmp_path}") for line in lines)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (lambda run: run["inputs"][0].pop("crc32"), "'crc32'"),
        (lambda run: run["inputs"][0].update(bytes="x"), "bytes = 'x': must be of type int"),
        (lambda run: run["settings"]["job"].update(title={"a": 1}), "settings: job: title = "),
        (lambda run: run["settings"]["job"].update(title=None), "settings: job: title = None"),
        (lambda run: run["settings"]["stripes"].update(levels=[0.1, np.nan]), "settings: stripes: levels = nan"),
        (lambda run: run["settings"]["stripes"].update(edp_thresholds=["x", "y"]), "edp_thresholds: must be numbers"),
        (lambda run: run["settings"]["stripes"].update(edp_thresholds=[0.4, 0.4]), "must increase strictly"),
        (lambda run: run["settings"]["stripes"].update(edp_thresholds=[0.4, 1e9]), "must be at most edp_limit = 1"),
        (lambda run: run["warnings"].append({"code": "note", "sentence": 3}), "sentence = 3: must be of type str"),
        (
            lambda run: run["warnings"].append({"code": "a", "sentence": "b", "subject": {"c": []}, "numbers": {}}),
            r"c = \[\]: must be of type str",
        ),
    ],
)
def test_a_damaged_file_of_a_run_is_refused_where_it_is_read(run, tmp_path, change, message):
    """And not where the report shows what it says."""
    case = tmp_path / "case.nml"
    catalogue = os.path.relpath(os.path.dirname(__file__) + "/../../data/records/synthetic44.csv", tmp_path)
    case.write_text(
        "&job task = 'stripes', output = 'a' /\n&wall mechanism = 'one_sided', height = 1.5, thickness = 0.25 /\n"
        f"&records catalogue = '{catalogue}' /\n&stripes im = 'pga', levels = 0.3, 0.5, edp_thresholds = 0.4, 1.0 /\n"
    )
    assert run("--quiet", case).returncode == 0
    path = tmp_path / "a_run.json"
    content = json.loads(path.read_text())
    dd.read_results(tmp_path / "a")
    change(content)
    path.write_text(json.dumps(content))
    with pytest.raises(dd.errors.InputError, match=rf"a_run\.json: .*{message}"):
        dd.read_results(tmp_path / "a")
