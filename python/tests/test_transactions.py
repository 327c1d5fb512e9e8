"""Two runs at one output, kills at random moments, and sets of files that do not belong together."""

import contextlib
import fcntl
import json
import os
import random
import re
import shutil
import signal
import struct
import subprocess
import time
from datetime import UTC, datetime, timedelta

import pytest

import dondolo as dd
from dondolo._fortran.files import TABLES, result_set, whole_file

pytestmark = pytest.mark.filterwarnings("ignore::dondolo.errors.DondoloWarning")

CASE = """&job task = 'stripes', output = 'out/x' /
&wall mechanism = 'one_sided', height = {height}, thickness = 0.25, name = '{name}' /
&records catalogue = '{root}/data/records/synthetic44.csv' /
&stripes first = 0.02, last = 2.0, count = {count} /
"""
FILES = ["x_fragility.csv", "x_histories.csv", "x_run.json", "x_stripes.csv", "x_walls.csv"]


@pytest.fixture
def folder(tmp_path, root):
    """Two cases with one output."""
    for name, height in (("a", 1.5), ("b", 2.5)):
        (tmp_path / f"{name}.nml").write_text(CASE.format(name=name, height=height, root=root, count=50))
    return tmp_path


def start(executable, folder, name):
    """Begin a run."""
    return subprocess.Popen(
        [executable, "--quiet", f"{name}.nml"],
        cwd=folder,
        stderr=subprocess.PIPE,
        text=True,
        # What a shell has let a process in the background ignore it goes on to ignore.
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),
    )


def test_names_of_tables(root):
    """Python replaces, and removes, what the executable would: the tables of docs/files.md."""
    names = re.findall(r"(?m)^\| `PREFIX(_\w+\.csv)` \|", (root / "docs/files.md").read_text())
    assert sorted(names) == sorted(TABLES)


def test_a_set_replaces_a_larger_one(few, tmp_path):
    tied = dd.OneSidedWall(3.0, 0.25, ties=[dd.Tie(2.8, area=0.0001, length=5.0)])
    for wall, has_ties in ((tied, True), (dd.OneSidedWall(3.0, 0.25), False)):
        dd.typology([wall], few, [0.2, 0.5], progress=False).write_results(tmp_path / "x")
        assert (tmp_path / "x_ties.csv").exists() == has_ties
        assert len(dd.read_results(tmp_path / "x").population.walls) == 1


def whose(folder):
    """The wall of the results."""
    return dd.read_results(folder / "out/x").population.walls[0].name


def test_two_runs_at_one_output(executable, folder):
    """One whole study, and one clear refusal unless the second began when the first had ended."""
    for _ in range(10):
        shutil.rmtree(folder / "out", ignore_errors=True)
        runs = {name: start(executable, folder, name) for name in "ab"}
        said = {name: run.communicate()[1] for name, run in runs.items()}
        codes = {name: run.returncode for name, run in runs.items()}
        assert sorted(codes.values()) in ([0, 0], [0, 2]), said
        if 2 in codes.values():
            assert codes[whose(folder)] == 0
            assert "out/x: is being written by another run" in said["a" if codes["a"] == 2 else "b"]
        assert sorted(os.listdir(folder / "out")) == FILES


def test_a_second_run_is_refused_while_the_first_goes_on(executable, folder):
    """The first is stopped where it holds the lock, however fast the machine."""
    start(executable, folder, "a").communicate()
    first = start(executable, folder, "a")
    lock = folder / "out/x.lock"
    while not (lock.exists() and lock.read_text()):
        assert first.poll() is None, first.communicate()[1]
        time.sleep(0.001)
    first.send_signal(signal.SIGSTOP)
    second = start(executable, folder, "b")
    said = second.communicate()[1]
    assert "out/x: is being written by another run" in said
    assert "replaces the results" not in said
    assert second.returncode == 2
    first.send_signal(signal.SIGCONT)
    assert (first.wait(), whose(folder), sorted(os.listdir(folder / "out"))) == (0, "a", FILES)


def test_kills_leave_the_old_set_or_the_new(executable, folder):
    began = time.monotonic()
    assert start(executable, folder, "a").wait() == 0
    lasts = time.monotonic() - began
    for turn in range(8):
        run = start(executable, folder, "ba"[turn % 2])
        time.sleep(random.uniform(0.3, 1.1) * lasts)
        run.kill()
        run.communicate()
        assert whose(folder) in "ab"
    assert start(executable, folder, "b").wait() == 0
    assert (whose(folder), sorted(os.listdir(folder / "out"))) == ("b", FILES)


def test_published_files_are_found_under_either_name(executable, folder):
    """A run that was killed when it had published its set, and renamed half of the files."""
    assert start(executable, folder, "a").wait() == 0
    run = dd.read_results(folder / "out/x").run.run
    for name in FILES[:2] + FILES[-1:]:
        (folder / "out" / name).rename(folder / f"out/{name}.{run}.part")
    (folder / "out/x_walls.csv").write_text("# dondolo 0.1.0\n# run: 20260101T000000Z-0123456789abcdef\nwall\na\n")
    assert whose(folder) == "a"
    # The next run ends what it had begun.
    with result_set(folder / "out/x"):
        pass
    assert sorted(os.listdir(folder / "out")) == FILES


def test_files_of_two_runs_are_refused(executable, folder):
    for name in "ab":
        assert start(executable, folder, name).wait() == 0
        shutil.copytree(folder / "out", folder / name)
    shutil.copy(folder / "a/x_histories.csv", folder / "b/x_histories.csv")
    with pytest.raises(
        dd.errors.InputError, match=r"b/x_histories\.csv: is of run .*, .*b/x_run\.json of run .*: they do not belong"
    ):
        dd.read_results(folder / "b/x")
    table = folder / "a/x_histories.csv"
    table.write_bytes(table.read_bytes()[:-3])
    with pytest.raises(dd.errors.InputError, match=r"x_histories\.csv: "):
        dd.read_results(folder / "a/x")
    with pytest.raises(dd.errors.InputError, match=r"must be the prefix of result files, '.*a/x'"):
        dd.read_results(folder / "a/x_walls.csv")


@pytest.mark.parametrize("name", ["20261122T232756Z-8a37df$(id)", "a\0b", "../x"])
def test_a_run_of_another_name_is_refused(name, executable, folder):
    """It is part of names of files; a reader also waited for it for ever."""
    assert start(executable, folder, "a").wait() == 0
    path = folder / "out/x_run.json"
    run = dd.read_results(folder / "out/x").run.run
    path.write_text(path.read_text().replace(run, json.dumps(name)[1:-1]))
    with pytest.raises(dd.errors.InputError, match=r"x_run\.json: run = .*: must be a name such as"):
        dd.read_results(folder / "out/x")


@pytest.mark.parametrize("mine", ["mine", ""])
def test_nothing_of_the_user_is_replaced(mine, executable, folder):
    (folder / "out").mkdir()
    lock = folder / "out/x.lock"
    lock.write_text(mine)
    run = start(executable, folder, "a")
    assert "out/x.lock: exists, and is not a lock of dondolo" in run.communicate()[1]
    assert run.returncode == 2
    with pytest.raises(dd.errors.InputError, match=r"x\.lock: exists, and is not a lock"), result_set(folder / "out/x"):
        pass
    assert os.listdir(folder / "out") == ["x.lock"]
    assert lock.read_text() == mine
    if not mine:
        # One that a run has made and not yet signed when it was killed has the sticky bit, and is taken.
        lock.chmod(0o1644)
        with result_set(folder / "out/x"):
            pass
        assert not os.listdir(folder / "out")


def test_parts_of_dead_writers_are_removed(folder):
    dead = folder / "curve.csv.20260101T000000Z-0123456789abcdef.new"
    other = [folder / name for name in ("curve.csv.mine.new", f"x{dead.name}", "curve.csv.part")]
    for path in (dead, *other):
        path.write_text("half")
    with whole_file(folder / "curve.csv") as part:
        assert not dead.exists()
        part.write_text("outer")
        # Another writes it meanwhile, and leaves the part of the first.
        with whole_file(folder / "curve.csv") as inner:
            inner.write_text("inner")
        assert part.read_text() == "outer"
        assert (folder / "curve.csv").read_text() == "inner"
    assert (folder / "curve.csv").read_text() == "outer"
    assert [path.read_text() for path in other] == ["half"] * 3
    assert not [name for name in os.listdir(folder) if name.startswith("curve.csv.2")]


LOCK = "dondolo lock\nrun 20260101T000000Z-0123456789abcdef\npid 4321\nhost here\nsince {since}\nrows 1\n"


@pytest.fixture(scope="module")
def checkpoint(tmp_path_factory, few):
    """Bytes of a checkpoint of five rows that were run in blocks of two, and of its first two blocks."""
    path = tmp_path_factory.mktemp("status") / "x.counts"
    walls = [dd.OneSidedWall(1.5 + 0.1 * i, 0.25, name=f"w{i}") for i in range(5)]
    dd.typology(walls, few[:2], [0.3, 0.9], checkpoint=path, block=2, threads=1, progress=False)
    whole = path.read_bytes()
    first = whole.partition(b"\n")[0]
    at = len(first) + 1 + int(first.split()[3])
    for _ in range(4):
        at += struct.unpack_from("=q", whole, at + 16)[0]
    return whole, whole[:at]


@pytest.mark.parametrize(
    ("left", "lock", "held", "said"),
    [
        (
            "some",
            "",
            False,
            ["interrupted; nothing is running, and the same command resumes it", "4 of 5 rows in {path}, 80 %"],
        ),
        (
            "some",
            LOCK,
            False,
            ["interrupted: process 4321 on here, begun {since}, has ended", "4 of 5 rows in {path}, 80 %"],
        ),
        (
            "some",
            LOCK,
            True,
            ["running: process 4321 on here since {since}", "4 of 5 rows in {path}, 80 %, about 20 s left"],
        ),
        ("all", "", False, ["complete; nothing is running", "5 of 5 rows in {path}, 100 %"]),
        ("cut", "", False, ["interrupted; nothing is running", "4 of 5 rows in {path}, 80 %"]),
        ("none", LOCK, True, ["running: process 4321 on here"]),
        ("none", "", False, []),
    ],
)
def test_status_of_a_checkpoint(left, lock, held, said, checkpoint, run, tmp_path):
    """Of an output whose checkpoint is the executable's, and of a file of counts."""
    whole, some = checkpoint
    content = {"some": some, "all": whole, "cut": whole[:-3]}.get(left)
    since = f"{datetime.now(UTC) - timedelta(seconds=60):%Y-%m-%dT%H:%M:%SZ}"
    for name, output in (("out.checkpoint", "out"), ("x.counts", "x.counts")):
        path = tmp_path / name
        if content:
            path.write_bytes(content)
        keeper = tmp_path / f"{name}.lock"
        if lock:
            keeper.write_text(lock.format(since=since))
        with contextlib.ExitStack() as stack:
            if held:
                fcntl.flock(stack.enter_context(keeper.open()), fcntl.LOCK_EX)
            done = run("--status", output)
            if said and (content or name == "out.checkpoint"):
                assert done.returncode == 0, done.stderr
                lines = done.stdout.splitlines()
                assert len(lines) == len(said)
                for line, begin in zip(lines, said, strict=True):
                    assert line.startswith(f"{output}: {begin.format(path=name, since=since)}")
            elif not said:
                assert done.returncode == 2
                assert f"{output}: no lock, no checkpoint and no results have this prefix" in done.stderr
        assert not content or path.read_bytes() == content


def test_status_of_results(executable, folder):
    assert start(executable, folder, "a").wait() == 0
    done = subprocess.run([executable, "--status", "out/x"], cwd=folder, capture_output=True, text=True, check=True)
    name = dd.read_results(folder / "out/x").run.run
    finished, results = done.stdout.splitlines()
    assert finished == "out/x: finished; nothing is running"
    assert results == f"out/x: results are those of run {name}"


@pytest.mark.parametrize("number", [signal.SIGINT, signal.SIGTERM, signal.SIGHUP])
def test_signals_end_a_run_in_order(executable, folder, root, number):
    """And --status says who runs; Python shares the lock."""
    # The engine that steps one history after the other is still at it when the questions have been asked.
    text = CASE.format(name="a", height=1.5, root=root, count=1000)
    (folder / "a.nml").write_text(text + "&solver engine = 'rk45', rtol = 1e-13 /\n")
    # Under nohup SIGHUP is ignored, and what a process ignores its children ignore.
    before = signal.getsignal(number)
    try:
        if before == signal.SIG_IGN:
            signal.signal(number, signal.SIG_DFL)
        run = start(executable, folder, "a")
    finally:
        signal.signal(number, before)
    lock = folder / "out/x.lock"
    while run.poll() is None and not (lock.exists() and lock.stat().st_size):
        time.sleep(0.01)
    status = subprocess.run([executable, "--status", "out/x"], cwd=folder, capture_output=True, text=True, check=True)
    assert f"out/x: running: process {run.pid} on " in status.stdout
    with (
        pytest.raises(dd.errors.InputError, match=rf"written by another run \(process {run.pid} on"),
        result_set(folder / "out/x"),
    ):
        pass
    run.send_signal(number)
    assert "dondolo: interrupted" in run.communicate()[1]
    assert run.returncode == -number
    assert not (folder / "out").exists()


def test_all_files_are_written_by_one_layer(root):
    """Whole or not at all: Python through parts, Fortran through the writer; docs/developing/architecture.md."""
    writing = re.compile(r"""\.write_(?:text|bytes)\(|\bopen\([^)]*["'][wax]""")
    for path in (root / "python/dondolo").rglob("*.py"):
        for line in filter(writing.search, path.read_text().splitlines()):
            # An example writes what a user has.
            if line.lstrip().startswith(">>>"):
                continue
            assert re.search(r"\bpart\b|\bstaged\(|\barchive\.open", line), f"{path}: {line}"
    for path in (root / "src").rglob("*.[fF]90"):
        assert not re.search(r"(?i)action\s*=\s*'(?:read)?write'", path.read_text()), path
