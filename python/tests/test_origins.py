"""Files of others: none is replaced, waited for or followed, from either language; what dondolo has written is."""

import os
import re
import shutil
import socket
import subprocess
import warnings

import numpy as np
import pytest

import dondolo as dd
from dondolo.__main__ import main
from dondolo._fortran.files import whole_file

pytestmark = pytest.mark.filterwarnings("ignore::dondolo.errors.DondoloWarning")

CASE = """&job task = '{task}', output = 'out/x' /
{walls}
&records catalogue = '{root}/data/records/synthetic44.csv' /
&stripes levels = 0.3, 0.6, 0.9 /
"""
WALL = "&wall mechanism = 'one_sided', height = {height}, thickness = 0.25, name = 'w' /"
# What a user may have: no file of dondolo, though some say its name
FOREIGN = {
    "a table": "level,counts\n0.1,3\n",
    "a remark": "# dondolo results of March, by hand\nlevel\n1\n",
    "an object": '{"run": "20260101T000000Z-0123456789abcdef", "by": "dondolo"}\n',
    "a page": '<html><head><meta name="generator" content="my dondolo report"></head></html>\n',
    "nothing": "",
}


@pytest.fixture
def folder(tmp_path, root):
    """Cases with one output: of a wall, of another, of a population."""
    for name, height in (("a", 1.5), ("b", 2.5)):
        text = CASE.format(task="stripes", walls=WALL.format(height=height), root=root)
        (tmp_path / f"{name}.nml").write_text(text)
    (tmp_path / "walls.csv").write_text("mechanism,height,thickness\none_sided,1.5,0.25\none_sided,2,0.3\n")
    text = CASE.format(task="typology", walls="&population file = 'walls.csv' /", root=root)
    (tmp_path / "people.nml").write_text(text)
    (tmp_path / "out").mkdir()
    return tmp_path


@pytest.fixture
def start(executable, folder):
    """Run the executable in the folder; nothing may wait."""

    def call(*arguments):
        return subprocess.run(
            [executable, "--quiet", *arguments], cwd=folder, capture_output=True, text=True, timeout=60, check=False
        )

    return call


@pytest.fixture(scope="module")
def people(few):
    walls = [dd.OneSidedWall(1.5, 0.25, name="a"), dd.OneSidedWall(2.0, 0.3, name="b")]
    return dd.typology(walls, few[:3], [0.3, 0.6, 0.9], progress=False)


def refused(done, path, why):
    """One sentence that names the file, and exit code 2."""
    assert done.returncode == 2
    assert re.fullmatch(rf"dondolo: .*{re.escape(str(path))}: {why}.*\n", done.stderr), done.stderr


@pytest.mark.parametrize("content", FOREIGN.values(), ids=FOREIGN)
def test_no_result_takes_the_place_of_another_file(content, start, folder, people):
    for suffix in ("walls.csv", "stripes.csv", "run.json", "fragility.csv"):
        path = folder / "out" / f"x_{suffix}"
        path.write_text(content)
        kind = "a run file" if suffix == "run.json" else "a table of results"
        for arguments in (["a.nml"], ["--check", "a.nml"], ["people.nml"]):
            refused(start(*arguments), f"out/{path.name}", f"exists, and is not {kind} of dondolo")
        with pytest.raises(dd.errors.InputError, match=rf"x_{suffix}: exists, and is not {kind} of dondolo$"):
            people.write_results(folder / "out/x")
        assert os.listdir(folder / "out") == [path.name]
        assert path.read_text() == content
        path.unlink()


THINGS = ["a symbolic link", "a dangling link", "a pipe", "a socket"]


def put(thing, path):
    """Put something in the place of a file."""
    target = path.parent.parent / "mine.txt"
    target.write_text("mine")
    if thing == "a symbolic link":
        path.symlink_to(target)
    elif thing == "a dangling link":
        path.symlink_to(target.with_name("none.txt"))
    elif thing == "a pipe":
        os.mkfifo(path)
    else:
        # The path of a socket may have about 100 bytes.
        here = os.getcwd()
        os.chdir(path.parent)
        with socket.socket(socket.AF_UNIX) as listener:
            listener.bind(path.name)
        os.chdir(here)
    return re.sub("dangling", "symbolic", thing)


@pytest.mark.parametrize("thing", THINGS)
def test_links_and_pipes_are_neither_followed_nor_waited_for(thing, start, folder, people, few):
    """In the places of results, locks, checkpoints and counts of parts."""
    walls = people.walls
    places = {
        "x_stripes.csv": ["a.nml"],
        "x_run.json": ["a.nml"],
        "x.lock": ["a.nml"],
        "x.checkpoint": ["people.nml"],
        "x.checkpoint.lock": ["people.nml"],
        "x_walls_1-1.counts": ["--walls", "1:1", "people.nml"],
    }
    for name, arguments in places.items():
        path = folder / "out" / name
        why = ("cannot be written: " if name in ("x_stripes.csv", "x_run.json") else "") + "is " + put(thing, path)
        refused(start(*arguments), f"out/{name}", why)
        if name in ("x_stripes.csv", "x_run.json", "x.lock"):
            with pytest.raises(dd.errors.InputError, match=f"{name}: {why}"):
                people.write_results(folder / "out/x")
        if name == "x.checkpoint":
            with pytest.raises(dd.errors.InputError, match=f"{name}: {why}"):
                dd.typology(walls, few[:3], [0.3, 0.6, 0.9], checkpoint=path, progress=False)
        assert os.listdir(folder / "out") == [name]
        path.unlink()
    for name in ("table.csv", "curve.npz", "records.csv", "model.xml"):
        path = folder / "out" / name
        why = "cannot be written: is " + put(thing, path)
        writes = {
            "table.csv": lambda path=path: people.to_csv(path),
            "curve.npz": lambda path=path: people["all"].fit.save(path),
            "records.csv": lambda path=path: dd.RecordSet(few[:2]).to_catalogue(path),
            "model.xml": lambda path=path: dd.write_nrml(path, {"w": {"collapse": people["all"].fit}}),
        }
        with pytest.raises(dd.errors.InputError, match=f"{name}: {why}"):
            writes[name]()
        path.unlink()
    assert (folder / "mine.txt").read_text() == "mine"
    assert not (folder / "none.txt").exists()
    assert os.listdir(folder / "out") == []


@pytest.mark.parametrize("thing", ["a pipe", "a socket"])
def test_what_is_read_is_a_regular_file(thing, start, folder, root):
    path = folder / "out/input"
    put(thing, path)
    reads = [dd.read_record, dd.read_catalogue, dd.Population.from_csv, dd.HazardCurve.from_csv, dd.load]
    for read in (*reads, dd.read_nrml, dd.HazardCurve.from_openquake):
        with pytest.raises(dd.errors.InputError, match=f"input: is {thing}, not a regular file"):
            read(path)
    (folder / "records.csv").write_text("file,dt_s,units\nout/input,0.01,g\n")
    (folder / "a.nml").write_text((folder / "a.nml").read_text().replace(f"{root}/data/records/synthetic44", "records"))
    refused(start("a.nml"), "out/input", f"is {thing}, not a regular file")
    path.rename(folder / "x_run.json")
    with pytest.raises(dd.errors.InputError, match=f"x_run.json: is {thing}, not a regular file"):
        dd.read_results(folder / "x")


@pytest.fixture
def command(folder, monkeypatch, capsys):
    """Run a command of Python in the folder: its exit code and what it says on stderr."""
    monkeypatch.chdir(folder)
    before = warnings.showwarning

    def call(*arguments):
        code = main(list(arguments))
        warnings.showwarning = before
        return code, capsys.readouterr().err

    return call


@pytest.mark.slow
def test_what_is_made_of_results_knows_its_run(start, folder, command):
    """It is replaced where it is dondolo's, and named as out of date when another run replaces the results."""
    assert start("a.nml").returncode == 0
    made = ["x_fragility.png", "x_fragility.xml", "x_report.html", "x_stripes.png", "x_tables.xlsx"]
    commands = (["plot", "out/x"], ["report", "out/x"], ["xlsx", "out/x"], ["nrml", "out/x"])
    for _ in range(2):
        for arguments in commands:
            assert command(*arguments) == (0, "")
    before = {name: (folder / "out" / name).read_bytes() for name in made}
    run = dd.read_results(folder / "out/x").run.run
    assert all(f" of run {run}".encode() in content for content in before.values())
    # The same case again, and another one
    for name, replaced in (("a", "a"), ("b", "a")):
        run = dd.read_results(folder / "out/x").run.run
        done = start(f"{name}.nml")
        assert done.returncode == 0
        when = f"{run[:4]}-{run[4:6]}-{run[6:8]} {run[9:11]}:{run[11:13]}:{run[13:15]} UTC"
        notes = re.findall("(?m)^dondolo: note: (.*)$", done.stderr)
        whose = f"out/x: a run replaces the results of run {run}, begun {when}, of the case '{replaced}.nml'"
        assert notes[0] == whose
        assert sorted(line.split(":")[0] for line in notes[1:]) == [f"out/{name}" for name in made]
        assert all("is out of date: it shows other results than those of out/x_run.json" in line for line in notes[1:])
    assert {name: (folder / "out" / name).read_bytes() for name in made} == before
    status = start("--status", "out/x").stdout.splitlines()
    assert sorted(line.split(":")[0] for line in status[2:]) == [f"out/{name}" for name in made]
    people = dd.read_results(folder / "out/x")
    assert people.run.run != run
    for arguments in commands:
        assert command(*arguments) == (0, "")
    assert start("--status", "out/x").stdout.splitlines()[2:] == []


@pytest.mark.slow
def test_nothing_made_of_results_takes_the_place_of_another_file(start, folder, command):
    assert start("a.nml").returncode == 0
    page = FOREIGN["a page"]
    kinds = {
        "x_stripes.png": (["plot"], "a figure"),
        "x_stripes.svg": (["plot", "--format", "svg"], "a figure"),
        "x_report.html": (["report"], "a report"),
        "x_tables.xlsx": (["xlsx"], "a workbook"),
        "x_fragility.xml": (["nrml"], "a fragility model"),
    }
    for name, (arguments, noun) in kinds.items():
        path = folder / "out" / name
        path.write_text(page)
        code, err = command(*arguments, "out/x")
        assert (code, err) == (2, f"dondolo: out/{name}: exists, and is not {noun} of dondolo\n")
        assert path.read_text() == page
        # One kind does not take the place of another.
        shutil.copy(folder / "out/x_stripes.csv", path)
        assert command(*arguments, "out/x")[0] == 2
        path.unlink()


@pytest.mark.slow
@pytest.mark.parametrize("kind", ["svg", "pdf", "eps", "jpg", "tiff", "webp"])
def test_figures_of_every_format_are_known(kind, start, folder, command):
    pil = pytest.importorskip("PIL.Image")
    assert start("a.nml").returncode == 0
    for _ in range(2):
        assert command("plot", "--format", kind, "out/x")[0] == 0
    if kind in ("jpg", "tiff", "webp"):
        with pil.open(folder / f"out/x_stripes.{kind}") as image:
            assert np.asarray(image).std() > 1.0


@pytest.mark.slow
def test_a_workbook_that_was_saved_since_is_the_users(start, folder):
    openpyxl = pytest.importorskip("openpyxl")
    assert start("a.nml").returncode == 0
    path = folder / "out/x_tables.xlsx"
    for _ in range(2):
        dd.write_workbook(folder / "out/x", path)
    book = openpyxl.load_workbook(path)
    assert book.properties.creator == "dondolo"
    book.create_sheet("notes")["A1"] = "mine"
    book.save(path)
    with pytest.raises(dd.errors.InputError, match="exists, and is not a workbook of dondolo"):
        dd.write_workbook(folder / "out/x", path)
    assert openpyxl.load_workbook(path)["notes"]["A1"].value == "mine"


def test_python_says_whose_results_it_replaces(people, folder):
    people.write_results(folder / "out/x")
    run = dd.read_results(folder / "out/x").run.run
    dd.report(dd.read_results(folder / "out/x"), folder / "out/x_report.html")
    with pytest.warns(dd.errors.DondoloWarning) as told:
        people.write_results(folder / "out/x")
    sentences = [str(one.message) for one in told]
    assert [f"a run replaces the results of run {run}, begun " in one for one in sentences] == [True, False]
    assert "x_report.html: is out of date" in sentences[1]


def test_a_file_that_is_named_itself_is_replaced(people, folder):
    """As pandas does it: the exception of docs/reliability.md."""
    path = folder / "mine.csv"
    path.write_text("mine")
    people.to_csv(path)
    assert path.read_text().startswith("# dondolo ")
    with whole_file(path) as part:
        part.write_text("other")
    assert path.read_text() == "other"
