"""Histories that are given up end every route with an error: millions of bounces from one sample to the next."""

from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

import dondolo as dd

pytestmark = pytest.mark.slow

#: A restitution next to 1, and slow ground just beyond the trigger of 0.1 g, then still, then beyond it again: the last push keeps
#: the chain of bounces between from being closed
HEIGHT, THICKNESS, RESTITUTION, LEVEL = 1.5, 0.15, 0.9999999999, 0.1 * (1.0 + 4.5e-5)
SHAPE = [0.0, -1.0, 0.0, -1.0, 0.0]
ERROR = r"record '.*slow.*', scale factor .*: the time history does not get beyond the sample at \d+ s and was given up"


@pytest.fixture(scope="module")
def bouncing() -> dd.OneSidedWall:
    """A wall that hardly loses speed."""
    return dd.OneSidedWall(HEIGHT, THICKNESS, restitution="constant", restitution_value=RESTITUTION, name="rubber")


@pytest.fixture(scope="module")
def slow() -> dd.Record:
    """Ten seconds from sample to sample."""
    return dd.Record(np.array(SHAPE), 10.0, "slow")


@pytest.mark.parametrize("engine", ["lanes", "rk45"])
def test_one_history(bouncing: dd.Wall, slow: dd.Record, engine: str) -> None:
    with pytest.raises(dd.DondoloError, match=ERROR):
        dd.simulate(bouncing, slow, scale=LEVEL * 9.81, history=False, solver=dd.Solver(engine=engine))


def test_stripes(bouncing: dd.Wall, slow: dd.Record, sine: dd.Record) -> None:
    with pytest.raises(dd.DondoloError, match=ERROR):
        dd.multiple_stripe(bouncing, [sine, slow], [LEVEL], progress=False)


def test_typology(bouncing: dd.Wall, wall: dd.Wall, slow: dd.Record, sine: dd.Record) -> None:
    """The error names the wall."""
    with pytest.raises(dd.DondoloError, match="rubber.*" + ERROR):
        dd.typology([wall, bouncing, wall], [sine, slow], [LEVEL], progress=False)


@pytest.mark.parametrize("task", ["history", "stripes"])
def test_executable(run: Callable, tmp_path: Path, task: str) -> None:
    """No table is written."""
    (tmp_path / "slow.txt").write_text("\n".join(map(str, SHAPE)) + "\n")
    (tmp_path / "records.csv").write_text("file,dt_s,units\nslow.txt,10,m/s2\n")
    levels = {"history": f"&history record = 1, im_level = {LEVEL!r} /", "stripes": f"&stripes im_levels = {LEVEL!r} /"}
    (tmp_path / "case.nml").write_text(
        f"&job task = '{task}', output = 'results' /\n"
        f"&wall mechanism = 'one_sided', height = {HEIGHT}, thickness = {THICKNESS}, restitution = 'constant',\n"
        f"   restitution_value = {RESTITUTION} /\n"
        f"&records catalogue = 'records.csv' /\n{levels[task]}\n"
    )
    done = run("case.nml")
    assert done.returncode == 1
    assert "was given up" in done.stderr and "slow" in done.stderr
    assert not list(tmp_path.glob("results*"))
