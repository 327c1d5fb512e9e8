"""One store for the executable and for Python: each goes on with what the other has begun."""

import os
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import numpy as np
import pytest

import dondolo as dd

pytestmark = pytest.mark.filterwarnings("ignore::dondolo.errors.DondoloWarning")

EXECUTABLE = Path(sys.executable).parent / "dondolo"
LEVELS = [0.1, 0.3, 0.6]

CASE = """&job task = 'typology', output = 'out/z' /
&population file = 'walls.csv' /
&records catalogue = '{records}', polarity = 'both' /
&stripes levels = 0.1, 0.3, 0.6, edp_thresholds = 0.4 /
"""


@pytest.fixture
def folder(tmp_path, root):
    """A case, in a folder of its own."""
    if not EXECUTABLE.exists():
        pytest.skip("the executable is not installed beside Python")
    walls = [
        dd.OneSidedWall(1.5, 0.25, name="a"),
        dd.TwoBlockWall(3.0, 0.25, name="a"),
        *(dd.OneSidedWall(2.0 + 0.3 * i, 0.3, name=f"b{i}") for i in range(5)),
        dd.FreeStandingWall(1.2, 0.2),
    ]
    dd.Population(walls, group_names=["x", "x", "y", "", "y", "", "", ""]).to_csv(tmp_path / "walls.csv")
    (tmp_path / "a.nml").write_text(CASE.format(records=root / "data/records/synthetic44.csv"))
    return tmp_path


def execute(folder, *arguments):
    """Run the executable."""
    done = subprocess.run([EXECUTABLE, *arguments, "a.nml"], cwd=folder, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return done.stdout


def run(folder, root, checkpoint, **options):
    """The same study in Python."""
    return dd.typology(
        dd.Population.from_csv(folder / "walls.csv"),
        dd.read_catalogue(root / "data/records/synthetic44.csv"),
        LEVELS,
        polarity="both",
        edp_thresholds=[0.4],
        checkpoint=checkpoint,
        progress=False,
        **options,
    )


def tables(folder):
    """All lines of the tables but comments."""
    files = sorted((folder / "out").glob("z_*.csv"))
    assert len(files) == 5
    return {file.name: [line for line in file.read_text().splitlines() if line[:1] != "#"] for file in files}


def test_a_run_that_was_killed_when_all_rows_were_in(folder, root):
    """The next run ends what it has left, though there is nothing to put in."""
    execute(folder, "--walls", "1:99")
    store = folder / "out/z_walls_1-8.counts"
    whole = store.read_bytes()
    left = f"{store}.lock", f"{store}.20260101T000000Z-0123456789abcdef.part"
    for again in (lambda: execute(folder, "--walls", "1:99"), lambda: run(folder, root, store)):
        for path in left:
            Path(path).write_text("dondolo lock\nrun 20260101T000000Z-0123456789abcdef\npid 1\nhost here\n")
        again()
        assert [path.name for path in (folder / "out").iterdir()] == [store.name]
        assert store.read_bytes() == whole


def test_the_same_bytes(folder, root):
    """However a study is divided, its store ends with the same bytes."""
    execute(folder, "--walls", "1:99")
    whole = (folder / "out/z_walls_1-8.counts").read_bytes()
    for name, options in {"here": {"block": 3}, "there": {"block": 1, "threads": 1}}.items():
        path = folder / f"{name}.counts"
        with ThreadPoolExecutor(3) as pool:
            result = run(folder, root, path, **options, **({"executor": pool} if name == "there" else {}))
        assert path.read_bytes() == whole
    execute(folder)
    rows = tables(folder)["z_stripes.csv"][1:]
    reached = np.moveaxis(result.exceedances, -1, 0).reshape(-1)
    assert [int(row.split(",")[5]) for row in rows] == reached.tolist()


@pytest.mark.parametrize("share", [0.0, 0.3, 0.6, 0.95])
def test_begun_by_the_executable(folder, root, share):
    """Python goes on with what a run of the executable has left, and with an executor too."""
    execute(folder, "--walls", "1:99")
    whole = (folder / "out/z_walls_1-8.counts").read_bytes()
    for executor in (None, ThreadPoolExecutor(2)):
        path = folder / "cut.counts"
        path.write_bytes(whole[: int(share * len(whole))])
        run(folder, root, path, block=1, executor=executor)
        assert path.read_bytes() == whole


@pytest.mark.parametrize("share", [0.5, 0.7, 0.95])
def test_begun_by_python(folder, root, share):
    """The executable goes on with what a run of Python has left, in whatever order."""
    execute(folder)
    expected = tables(folder)
    with ThreadPoolExecutor(2) as pool:
        run(folder, root, folder / "whole.counts", block=1, executor=pool)
    whole = (folder / "whole.counts").read_bytes()
    (folder / "out/z.checkpoint").write_bytes(whole[: int(share * len(whole))])
    assert "by an earlier run" in execute(folder)
    assert tables(folder) == expected
    assert not os.path.exists(folder / "out/z.checkpoint")
    # A part of the whole population
    (folder / "out/z_walls_1-8.counts").write_bytes(whole[: int(share * len(whole))])
    execute(folder, "--walls", "1:8")
    assert (folder / "out/z_walls_1-8.counts").read_bytes() == whole


def test_histories_are_kept_by_the_executable_alone(folder, root):
    text = (folder / "a.nml").read_text()
    (folder / "a.nml").write_text(text.replace("'out/z'", "'out/z', histories = .true."))
    execute(folder, "--walls", "1:8")
    with pytest.raises(dd.errors.InputError, match="belongs to another study: histories kept there, not kept here"):
        run(folder, root, folder / "out/z_walls_1-8.counts")
