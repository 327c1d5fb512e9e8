"""Runs that end before their time, and go on."""

import os
import random
import re
import signal
import sqlite3
import subprocess
import sys
import time
from contextlib import closing, suppress

import numpy as np
import pytest
import study
from dondolo._fortran import _binding, _core
from dondolo.analysis.work import Work
from dondolo.populations import blocks
from dondolo.populations.checkpoint import Checkpoint

import dondolo as dd

pytestmark = [pytest.mark.slow, pytest.mark.filterwarnings("ignore::dondolo.errors.DondoloWarning")]

# Says of every block that it is kept, and ends with all results in a folder
RUN = """
import sys, warnings
from pathlib import Path
import dondolo as dd, study
from dondolo.populations import checkpoint
warnings.simplefilter("ignore")
keep = checkpoint.Checkpoint.keep
def tell(self, first, walls, work, flags):
    print("run", first, walls, flush=True)
    keep(self, first, walls, work, flags)
    print("kept", first, walls, flush=True)
checkpoint.Checkpoint.keep = tell
path, folder, block = sys.argv[1:]
typology = dd.typology(**study.arguments(checkpoint=path, block=int(block), threads=1))
study.write(typology, Path(folder))
"""


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    """The results of a run without interruption and checkpoint."""
    folder = tmp_path_factory.mktemp("whole")
    study.write(dd.typology(**study.arguments(threads=2)), folder)
    return study.contents(folder)


def kept(path):
    """Numbers of the walls that a checkpoint holds."""
    with closing(sqlite3.connect(path)) as file:
        rows = file.execute("SELECT first, rows FROM block").fetchall()
    return {wall for first, walls in rows for wall in range(first, first + walls)}


def of(result, folder):
    study.write(result, folder)
    return study.contents(folder)


def rows_of(contents):
    """What was written but for what was computed: more than the walls that are complete."""
    tables = {name: content.splitlines() for name, content in contents.items() if name.endswith(".csv")}
    rows = {name: [line for line in lines if not line.startswith(b"#")] for name, lines in tables.items()}
    return contents | rows | {"work": b""}


@pytest.mark.parametrize("seed", range(3))
def test_killed_at_random_moments(whole, tmp_path, seed):
    chance = random.Random(seed)
    path, folder = tmp_path / "study.sqlite", tmp_path / "out"
    before: set[int] = set()
    for end in [*(chance.randrange(1, 9) for _ in range(4)), None]:
        block = chance.randrange(1, 4)
        command = [sys.executable, "-c", RUN, str(path), str(folder), str(block)]
        with subprocess.Popen(command, cwd=os.path.dirname(__file__), stdout=subprocess.PIPE, text=True) as process:
            told: dict[str, set[int]] = {"run": set(), "kept": set()}
            for number, line in enumerate(process.stdout, 1):
                # The last line of a process that was killed may be cut.
                if words := re.fullmatch(r"(run|kept) (\d+) (\d+)\n", line):
                    told[words[1]] |= set(range(int(words[2]), int(words[2]) + int(words[3])))
                if number == end:
                    time.sleep(chance.uniform(0.0, 0.02))
                    process.kill()
        # Nothing is run again that was kept, nothing that was said to be kept is lost.
        assert not told["run"] & before
        now = kept(path)
        assert before | told["kept"] <= now <= before | told["run"]
        assert end is None or process.returncode == -signal.SIGKILL
        before = now
    assert process.returncode == 0
    assert study.contents(folder) == whole


def test_complete(whole, tmp_path, monkeypatch):
    path = tmp_path / "study.sqlite"
    dd.typology(**study.arguments(checkpoint=path, block=7))
    with closing(sqlite3.connect(path)) as file:
        assert file.execute("SELECT * FROM progress").fetchall() == [(60, 60, "complete")]
    monkeypatch.setattr(_core, "run_block", None)
    # Weights and groups are of no matter to histories.
    people = study.arguments()["population"]
    again = dd.typology(**study.arguments(checkpoint=path))
    assert of(again, tmp_path / "out") == whole
    other = dd.typology(**study.arguments(checkpoint=path, population=dd.Population(people.walls)))
    assert np.array_equal(other.collapses, again.collapses)
    assert not np.array_equal(other.mean_fraction, again.mean_fraction)


def test_ctrl_c(whole, tmp_path, monkeypatch):
    path = tmp_path / "study.sqlite"
    run_block, calls = _core.run_block, []

    def stop(*given):
        calls.append(given)
        if len(calls) > 5:
            raise KeyboardInterrupt
        return run_block(*given)

    monkeypatch.setattr(_core, "run_block", stop)
    with pytest.raises(dd.Interrupted, match=r"interrupted: \d+ of 60 walls are complete") as caught:
        dd.typology(**study.arguments(checkpoint=path, block=3))
    monkeypatch.undo()
    partial = caught.value.partial
    assert len(kept(path)) <= len(partial.walls) <= len(kept(path)) + 3
    alone = dd.typology(**study.arguments(population=partial.population))
    assert rows_of(of(partial, tmp_path / "partial")) == rows_of(of(alone, tmp_path / "alone"))
    assert of(dd.typology(**study.arguments(checkpoint=path)), tmp_path / "out") == whole


CHANGES = {
    "other walls": {"population": dd.Population([dd.OneSidedWall(3.0, 0.25)] * 1 + [dd.OneSidedWall(2.0, 0.25)])},
    "other records": {"records": [dd.Record(np.sin(np.arange(500.0)), 0.01)]},
    "other levels": {"levels": [0.2, 0.4]},
    "im pga there, pgv here": {"im": "pgv"},
    "polarity both there, reversed here": {"polarity": "reversed"},
    "engine auto there, rk45 here": {"solver": dd.Solver(engine="rk45")},
    "rtol 1e-08 there, 1e-06 here": {"solver": dd.Solver(rtol=1e-6)},
    "atol 1e-10 there, 1e-09 here": {"solver": dd.Solver(atol=1e-9)},
    "edp_limit 1.0 there, 0.9 here": {"solver": dd.Solver(edp_limit=0.9)},
    "edp_thresholds 0.1, 0.4 there, none here": {"edp_thresholds": None},
}


@pytest.fixture(scope="module")
def finished(tmp_path_factory):
    """A checkpoint of a run that is complete."""
    path = tmp_path_factory.mktemp("finished") / "study.sqlite"
    dd.typology(**study.arguments(checkpoint=path))
    return path


@pytest.mark.parametrize("sentence", CHANGES)
def test_another_study(finished, sentence):
    with pytest.raises(dd.InputError) as caught:
        dd.typology(**study.arguments(checkpoint=finished, **CHANGES[sentence]))
    assert str(caught.value).startswith(f"checkpoint = '{finished}': belongs to another study: ")
    assert sentence in str(caught.value).replace("number of rows", "")
    if sentence not in ("other walls", "edp_limit 1.0 there, 0.9 here"):
        assert str(caught.value).endswith(f"study: {sentence}")


def test_another_build(finished, monkeypatch):
    monkeypatch.setattr(_binding, "build_variant", lambda: "z80")
    with pytest.raises(dd.InputError, match=r"another study: build variant .* there, z80 here"):
        dd.typology(**study.arguments(checkpoint=finished))
    constants = _binding.constants()._replace(version="9.9")
    monkeypatch.undo()
    monkeypatch.setattr(_binding, "constants", lambda: constants)
    with pytest.raises(dd.InputError, match=r"another study: dondolo \S+ there, 9.9 here"):
        dd.typology(**study.arguments(checkpoint=finished))


def test_files_that_are_no_checkpoints(finished, tmp_path):
    path = tmp_path / "study.sqlite"

    def refused(sentence, kind=dd.InputError):
        with pytest.raises(kind, match=sentence) as caught:
            dd.typology(**study.arguments(checkpoint=path))
        assert "\n" not in str(caught.value)

    path.write_text("height,thickness\n" * 1000)
    refused("is no checkpoint, or damaged")
    path.unlink()
    with closing(sqlite3.connect(path)) as file:
        file.execute("CREATE TABLE mine (x)")
    refused("is a database, but no checkpoint of dondolo")
    path.write_bytes(finished.read_bytes())
    with closing(sqlite3.connect(path)) as file:
        file.execute("PRAGMA user_version = 1")
    refused("was written by another version of dondolo")
    content = finished.read_bytes()
    path.write_bytes(content[: len(content) // 2])
    refused("is no checkpoint, or damaged")
    with closing(sqlite3.connect(finished)) as file:
        ((flags,),) = file.execute("SELECT flags FROM block ORDER BY first LIMIT 1")
    place = content.index(flags[200:240]) + 5
    path.write_bytes(content[:place] + bytes([content[place] ^ 16]) + content[place + 1 :])
    refused(r"is damaged \(the block of row 1\)")
    # SQLite keeps a value of any type in any column.
    for column, value in (
        ("flags", "text"),
        ("flags", 5),
        ("work", b"bytes"),
        ("work", "[]"),
        ("rows", "many"),
        ("rows", 2.5),
    ):
        path.write_bytes(content)
        with closing(sqlite3.connect(path)) as file, file:
            file.execute(f"UPDATE block SET {column} = ? WHERE first = 0", (value,))
        refused(r"is damaged \(the block of row 1\)")
    # A schema that is not UTF-8, or has no such column
    for name in (b"fl\xe0gs", b"flegs"):
        path.write_bytes(content.replace(b"flags BLOB", name + b" BLOB"))
        refused("is no checkpoint, or damaged")
    path.write_bytes(content)
    with closing(sqlite3.connect(path)) as file, file:
        file.execute("UPDATE study SET value = ? WHERE what = 'im'", (b"pga",))
    refused("belongs to another study: im b'pga' there, pga here")
    for wrong in (3, "", "a\0b", b"a"):
        with pytest.raises(dd.InputError, match=r"checkpoint = .*: must be the path of a file"):
            dd.typology(**study.arguments(checkpoint=wrong))
    path.unlink()
    path.mkdir()
    refused("cannot be written: unable to open", dd.DondoloError)
    path = path / "missing" / "study.sqlite"
    refused("cannot be written: unable to open", dd.DondoloError)


def test_two_runs(tmp_path, monkeypatch):
    path = tmp_path / "study.sqlite"
    monkeypatch.setattr(blocks.Run, "add", interrupt)
    with pytest.raises(dd.Interrupted):
        dd.typology(**study.arguments(checkpoint=path, block=5))
    monkeypatch.undo()
    with Checkpoint(path, of_study(path)) as first:
        assert len(list(first.blocks())) == 1
        monkeypatch.setattr(blocks.Shared, "run", None)
        with pytest.raises(dd.DondoloError, match="is being written by another run"):
            dd.typology(**study.arguments(checkpoint=path))
    monkeypatch.undo()
    dd.typology(**study.arguments(checkpoint=path))


def test_rows_are_counted_and_called_so(few, tmp_path):
    """Two walls with three mechanisms"""
    path = tmp_path / "study.sqlite"
    walls = [
        dd.OneSidedWall(1.5, 0.25, name="a"),
        dd.TwoBlockWall(3.0, 0.25, name="a"),
        dd.OneSidedWall(2, 0.3, name="b"),
    ]
    dd.typology(walls, few, [0.4, 0.8], checkpoint=path, progress=False)
    with closing(sqlite3.connect(path)) as file:
        assert file.execute("SELECT * FROM progress").fetchall() == [(3, 3, "complete")]
    with pytest.raises(dd.InputError, match="another study: number of rows 3 there, 2 here"):
        dd.typology(walls[:2], few, [0.4, 0.8], checkpoint=path, progress=False)


def of_study(path):
    """What a checkpoint says of its study."""
    with closing(sqlite3.connect(path)) as file:
        return dict(file.execute("SELECT what, value FROM study"))


def claimed(file):
    """Is a checkpoint this run's?"""
    with suppress(dd.DondoloError):
        file.claim()
        return True
    return False


@pytest.mark.parametrize("first", [0, 1])
def test_of_two_runs_that_begin_together_one_goes_on(tmp_path, monkeypatch, first):
    path = tmp_path / "study.sqlite"
    monkeypatch.setattr(blocks.Run, "add", interrupt)
    with pytest.raises(dd.Interrupted):
        dd.typology(**study.arguments(checkpoint=path, block=5))
    given = of_study(path)
    with Checkpoint(path, given) as one, Checkpoint(path, given) as other:
        # Both read what is there, and then both want to write, in either order.
        assert len(list(one.blocks())) == len(list(other.blocks())) == 1
        files = [one, other] if first == 0 else [other, one]
        refused = [file for file in files if not claimed(file)]
        assert len(refused) == 1
        files.remove(refused[0])
        files[0].keep(20, 1, Work(), b"flags")
    assert kept(path) == {0, 1, 2, 3, 4, 20}


def test_two_processes_that_begin_together(whole, tmp_path):
    """On a file that is not there, and on one that is not finished."""
    path = tmp_path / "study.sqlite"
    for turn in range(2):
        command = [sys.executable, "-c", RUN, str(path), str(tmp_path / "out"), "3"]
        options = {"cwd": os.path.dirname(__file__), "stdout": subprocess.PIPE, "stderr": subprocess.PIPE, "text": True}
        processes = [subprocess.Popen(command, **options) for _ in range(2)]
        ends = [process.communicate()[1] for process in processes]
        codes = [process.returncode for process in processes]
        # The second one may find it finished.
        assert 0 in codes, ends
        for code, said in zip(codes, ends, strict=True):
            assert code == 0 or "is being written by another run" in said
        assert study.contents(tmp_path / "out") == whole
        if turn == 0:
            with closing(sqlite3.connect(path)) as file, file:
                file.execute("DELETE FROM block WHERE first > 30")


def test_a_file_that_cannot_be_written_can_be_read(finished, whole, tmp_path, monkeypatch):
    connect = sqlite3.connect
    monkeypatch.setattr(
        sqlite3, "connect", lambda path, **options: connect(f"file:{path}?mode=ro", uri=True, **options)
    )
    assert of(dd.typology(**study.arguments(checkpoint=finished)), tmp_path / "out") == whole
    monkeypatch.undo()
    with Checkpoint(finished, of_study(finished)), closing(sqlite3.connect(finished)) as file:
        assert file.execute("SELECT * FROM progress").fetchall() == [(60, 60, "complete")]


def interrupt(*given):
    """Ctrl-C, after the first block was kept."""
    raise KeyboardInterrupt


def test_full_disk(whole, tmp_path, monkeypatch):
    path = tmp_path / "study.sqlite"
    connect = sqlite3.connect

    def small(*given, **settings):
        file = connect(*given, **settings)
        file.execute("PRAGMA page_size = 512")
        file.execute("PRAGMA max_page_count = 10")
        return file

    monkeypatch.setattr(sqlite3, "connect", small)
    with pytest.raises(dd.DondoloError, match=r"cannot be written: .*full; it holds \d+ of 60 rows"):
        dd.typology(**study.arguments(checkpoint=path, block=5))
    monkeypatch.undo()
    assert 0 < len(kept(path)) < 60
    assert of(dd.typology(**study.arguments(checkpoint=path)), tmp_path / "out") == whole


def test_blocks_change_nothing(whole, tmp_path):
    for block in (1, 59, 1000):
        assert of(dd.typology(**study.arguments(block=block)), tmp_path / str(block)) == whole
    for wrong in (0, 1.5, True):
        with pytest.raises(dd.InputError, match=r"block = .*: must be a whole number, at least 1"):
            dd.typology(**study.arguments(block=wrong))


def test_states(whole):
    """Flags and counts are those of the EDPs of each wall."""
    given = study.arguments()
    result = dd.typology(**given)
    for i in (0, 1, 2, 59):
        stripes = dd.multiple_stripe(
            given["population"][i], given["records"], given["levels"], polarity="both", progress=False
        )
        flags = result.flags.of([i])[0]
        for state, threshold in enumerate([0.1, 0.4, 1.0]):
            assert np.array_equal(flags[state], stripes.edp >= threshold)
    # Who asks for collapses alone gets the same collapses.
    alone = dd.typology(**study.arguments(edp_thresholds=None))
    assert alone.flags.states == 1
    assert np.array_equal(alone.collapses, result.collapses)
    # Collapse is the last state, given or not.
    same = dd.typology(**study.arguments(edp_thresholds=[0.1, 0.4, 1.0]))
    assert np.array_equal(same.flags.bits, result.flags.bits)
    for wrong, allowed in (([0.0], "positive"), ([0.4, 0.4], "increase"), ([0.4, 1.1], "at most edp_limit = 1")):
        with pytest.raises(dd.InputError, match=f"edp_thresholds = .*: must be {allowed}|must {allowed}"):
            dd.typology(**study.arguments(edp_thresholds=wrong))
