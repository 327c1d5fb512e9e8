"""Runs that end before their time, and go on."""

import os
import random
import re
import signal
import struct
import subprocess
import sys
import time

import numpy as np
import pytest
import study

import dondolo as dd
from dondolo._fortran import _core
from dondolo.populations.store import Store

pytestmark = [pytest.mark.slow, pytest.mark.filterwarnings("ignore::dondolo.errors.DondoloWarning")]

# Says of every block that it is run and that it is kept, and ends with all results in a folder
RUN = """
import sys, warnings
from pathlib import Path
import dondolo as dd, study
from dondolo.populations import blocks, store
warnings.simplefilter("ignore")
run, put = blocks.Shared.run, store.Store.put
def tell_run(self, walls, first, interrupts=None):
    print("run", first, len(walls), flush=True)
    tell_run.first = first
    return run(self, walls, first, interrupts)
def tell_put(self, block, rows):
    put(self, block, rows)
    print("kept", tell_run.first, rows, flush=True)
blocks.Shared.run, store.Store.put = tell_run, tell_put
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


def head_of(content):
    """Length of the head of a checkpoint: its first line says how long the rest is."""
    first, _, _ = content.partition(b"\n")
    return len(first) + 1 + int(first.split()[3])


def kept(path):
    """Numbers of the rows that a checkpoint holds, from 0."""
    content = path.read_bytes() if path.exists() else b""
    rows, at = set(), head_of(content) if b"\n" in content else len(content)
    while at + 40 <= len(content):
        row, _, _, _, length = struct.unpack_from("=iiiiq", content, at)
        if at + length <= len(content):
            rows.add(row - 1)
        at += length
    return rows


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
    path, folder = tmp_path / "study.counts", tmp_path / "out"
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


def test_complete(whole, tmp_path, replace_procedure):
    path = tmp_path / "study.counts"
    dd.typology(**study.arguments(checkpoint=path, block=7))
    assert kept(path) == set(range(60))
    replace_procedure("stores.run_rows", None)
    # Weights, groups and names are of no matter to histories.
    people = study.arguments()["population"]
    again = dd.typology(**study.arguments(checkpoint=path))
    assert of(again, tmp_path / "out") == whole
    other = dd.typology(**study.arguments(checkpoint=path, population=dd.Population(people.walls)))
    assert np.array_equal(other.collapses, again.collapses)
    assert not np.array_equal(other["all"].mean_fraction, again["all"].mean_fraction)


def test_ctrl_c(whole, tmp_path, monkeypatch, replace_procedure):
    path = tmp_path / "study.counts"
    run_rows, calls = _core.stores.run_rows, []

    def stop(*given):
        calls.append(given)
        if len(calls) > 5:
            raise KeyboardInterrupt
        return run_rows(*given)

    replace_procedure("stores.run_rows", stop)
    with pytest.raises(dd.errors.Interrupted, match=r"interrupted: 15 of 60 walls are complete") as caught:
        dd.typology(**study.arguments(checkpoint=path, block=3))
    monkeypatch.undo()
    partial = caught.value.partial
    assert kept(path) == set(range(15))
    assert len(partial.walls) == 15
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
    "rtol 1e-8 there, 1e-6 here": {"solver": dd.Solver(rtol=1e-6)},
    "atol 1e-10 there, 1e-9 here": {"solver": dd.Solver(atol=1e-9)},
    "edp_limit 1 there, 0.9 here": {"solver": dd.Solver(edp_limit=0.9)},
    "edp_thresholds 0.1, 0.4, 1 there, 1 here": {"edp_thresholds": None},
}


@pytest.fixture(scope="module")
def finished(tmp_path_factory):
    """A checkpoint of a run that is complete."""
    path = tmp_path_factory.mktemp("finished") / "study.counts"
    dd.typology(**study.arguments(checkpoint=path))
    return path


@pytest.mark.parametrize("sentence", CHANGES)
def test_another_study(finished, sentence):
    with pytest.raises(dd.errors.InputError) as caught:
        dd.typology(**study.arguments(checkpoint=finished, **CHANGES[sentence]))
    assert str(caught.value).startswith(f"{finished}: belongs to another study: ")
    assert sentence in str(caught.value).replace("number of rows", "")
    if sentence not in ("other walls", "edp_limit 1 there, 0.9 here"):
        assert str(caught.value).endswith(f"study: {sentence}")


def test_another_build(finished, tmp_path):
    path = tmp_path / "study.counts"
    content = finished.read_bytes()
    line, _, rest = content.partition(b"\n")
    for name, other, why in (
        ("build variant", b"z80", r"build variant z80 there, \S+ here"),
        ("dondolo", b"9.9", r"dondolo 9\.9 there, \S+ here"),
    ):
        length = head_of(content) - len(line) - 1
        head = re.sub(rb"(?m)^%s = .*$" % name.encode(), name.encode() + b" = " + other, rest[:length])
        # Fingerprints are those of the store.
        first = b"dondolo counts 5 %08d " % len(head)
        path.write_bytes(first + fingerprint(head, b"") + b"\n" + head + rest[length:])
        with pytest.raises(dd.errors.InputError, match=f"another study: {why}$"):
            dd.typology(**study.arguments(checkpoint=path))


def fingerprint(*texts):
    """The fingerprint of some texts, by its definition."""
    values = [1, 2]
    for text in texts:
        padded = text + b" " * (-len(text) % 4)
        for number in (len(text), *struct.unpack(f"={len(padded) // 4}i", padded)):
            values = [
                (value * base + number % prime + 1) % prime
                for value, base, prime in zip(values, (1103515245, 1597334677), (2147483647, 2147483629), strict=True)
            ]
    return b"%08X%08X" % tuple(values)


def test_files_that_are_no_checkpoints(finished, whole, tmp_path):
    path = tmp_path / "study.counts"

    def refused(sentence, kind=dd.errors.InputError):
        with pytest.raises(kind, match=sentence) as caught:
            dd.typology(**study.arguments(checkpoint=path))
        assert "\n" not in str(caught.value)

    path.write_text("height,thickness\n" * 1000)
    refused(r"study\.counts: not a dondolo counts file, or its header is corrupt")
    path.write_bytes(b"dondolo counts 2" + bytes(1000))
    refused("was written by another version of dondolo")
    content = finished.read_bytes()
    path.write_bytes(content[:100] + b"x" + content[101:])
    refused("not a dondolo counts file, or its header is corrupt")
    for wrong in (3, "", "a\0b", b"a"):
        with pytest.raises(dd.errors.InputError, match=r"checkpoint = .*: must be the path of a file"):
            dd.typology(**study.arguments(checkpoint=wrong))
    # A row that is damaged is computed again, with those behind it; a file that was cut goes on.
    for cut in (5, head_of(content), len(content) // 2, len(content) - 1):
        path.write_bytes(content[:cut])
        assert of(dd.typology(**study.arguments(checkpoint=path)), tmp_path / "out") == whole
        assert path.read_bytes() == content
    place = len(content) // 2
    path.write_bytes(content[:place] + bytes([content[place] ^ 16]) + content[place + 1 :])
    assert of(dd.typology(**study.arguments(checkpoint=path)), tmp_path / "out") == whole
    assert path.read_bytes() == content
    path.unlink()
    path.mkdir()
    refused("not a dondolo counts file")
    path = path / "missing" / "study.counts"
    refused("cannot be written", dd.errors.DondoloError)


def store_of(path):
    """The store of the study in this process."""
    from dondolo.analysis.request import new_request

    given = study.arguments()
    request = new_request(
        given["population"].walls, given["records"], given["levels"], "pga", given["polarity"], dd.Solver(), threads=1
    )
    return Store(path, request, np.array([*given["edp_thresholds"], 1.0]))


def test_two_runs(tmp_path, monkeypatch):
    path = tmp_path / "study.counts"
    with store_of(path) as first:
        first.claim()
        with pytest.raises(dd.errors.DondoloError, match="is being written by another run"):
            dd.typology(**study.arguments(checkpoint=path))
    dd.typology(**study.arguments(checkpoint=path))
    # Who has all rows needs to write nothing.
    with store_of(path) as first:
        first.claim()
        dd.typology(**study.arguments(checkpoint=path))


def test_two_processes_that_begin_together(whole, tmp_path):
    """On a file that is not there, and on one that is not finished."""
    path = tmp_path / "study.counts"
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
            path.write_bytes(path.read_bytes()[: path.stat().st_size // 2])


def test_a_file_that_cannot_be_written_can_be_read(finished, whole, tmp_path):
    os.chmod(finished, 0o444)
    assert of(dd.typology(**study.arguments(checkpoint=finished)), tmp_path / "out") == whole


# A process that may write files of a limited size only
FULL = """
import sys, warnings
import dondolo as dd, study
warnings.simplefilter("ignore")
import resource
resource.setrlimit(resource.RLIMIT_FSIZE, (3000, 3000))
try:
    dd.typology(**study.arguments(checkpoint=sys.argv[1], block=5, progress=False))
except dd.errors.DondoloError as error:
    print(error)
"""


def test_full_disk(whole, tmp_path):
    path = tmp_path / "study.counts"
    command = [sys.executable, "-c", FULL, str(path)]
    done = subprocess.run(command, cwd=os.path.dirname(__file__), capture_output=True, text=True)
    assert re.search(r"cannot be written whole: is the disk full\? It holds \d+ of 60 rows", done.stdout), done
    assert 0 < len(kept(path)) < 60
    assert of(dd.typology(**study.arguments(checkpoint=path)), tmp_path / "out") == whole


def test_rows_are_counted_and_called_so(few, tmp_path):
    """Two walls with three mechanisms"""
    path = tmp_path / "study.counts"
    walls = [
        dd.OneSidedWall(1.5, 0.25, name="a"),
        dd.TwoBlockWall(3.0, 0.25, name="a"),
        dd.OneSidedWall(2, 0.3, name="b"),
    ]
    dd.typology(walls, few, [0.4, 0.8], checkpoint=path, progress=False)
    assert kept(path) == {0, 1, 2}
    with pytest.raises(dd.errors.InputError, match="another study: number of rows 3 there, 2 here"):
        dd.typology(walls[:2], few, [0.4, 0.8], checkpoint=path, progress=False)


@pytest.mark.parametrize("im", ["pga/a0", "p*pgv/a0"])
def test_each_block_scales_to_its_own_walls(im, tmp_path):
    """Levels in terms of the wall are the same in any block, and for the wall alone."""
    people = study.arguments()["population"].walls[:9]
    given = study.arguments(im=im, levels=[0.8, 1.3, 2.5], population=dd.Population(people))
    together = dd.typology(**given, block=9)
    for block in (1, 4):
        apart = dd.typology(**given, block=block)
        assert of(apart, tmp_path / str(block)) == of(together, tmp_path / "together")
    assert len(np.unique(together.collapses, axis=-1)) > 1
    for i, wall in enumerate(people):
        options = {name: given[name] for name in ("levels", "im", "polarity", "progress")}
        alone = dd.multiple_stripe(wall, given["records"], **options)
        assert np.array_equal(together.collapses[..., i], alone.collapses)


def test_blocks_change_nothing(whole, tmp_path):
    for block in (1, 59, 1000):
        assert of(dd.typology(**study.arguments(block=block)), tmp_path / str(block)) == whole
    for wrong in (0, 1.5, True):
        with pytest.raises(dd.errors.InputError, match=r"block = .*: must be an integer, at least 1"):
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
        with pytest.raises(dd.errors.InputError, match=f"edp_thresholds = .*: must be {allowed}|must {allowed}"):
            dd.typology(**study.arguments(edp_thresholds=wrong))
