"""Random walls of docs/verification between two supports."""

import csv
import shutil
import sys
from pathlib import Path

import numpy as np
import pytest

import dondolo as dd

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "docs/verification"))

import random_supports
import two_supports
import yardsticks


@pytest.mark.skipif(shutil.which("gfortran") is None, reason="needs gfortran")
def test_random_walls():
    """Both kinds, with what the page counts."""
    records = dd.example_records()[:6]
    rng = np.random.default_rng(11)
    rows = [random_supports.random_strip(rng), random_supports.random_facade(rng)]
    program = yardsticks.Program()
    walls = [
        random_supports.Wall(row, two_supports.compare(program, row, records, random_supports.SHARES), 6)
        for row in rows
    ]
    lines = "\n".join(random_supports.report(walls, "synthetic"))
    assert "2 random walls" in lines
    worst = max((wall.pair.difference for wall in walls), key=abs)
    assert f"{100 * worst:+.0f} %" in lines


def test_going_on(tmp_path):
    """A table of a run that was stopped is read as it was written, and other walls are refused."""
    path = tmp_path / "walls.csv"
    assert random_supports.known(path) == []
    pair = two_supports.Pair(np.array([0.5, 0.3]), np.array([0.51, 0.31]), 0.125, 0.07)
    rows = [random_supports.random_strip(np.random.default_rng(k)) for k in (1, 2)]
    with open(path, "w", newline="", encoding="utf-8") as file:
        out = csv.writer(file)
        out.writerow(random_supports.COLUMNS)
        out.writerow(random_supports.Wall(rows[0], pair, 16).cells())
    (found,) = random_supports.known(path)
    wall = random_supports.recall(found, rows[0])
    assert (*wall.pair.exact, *wall.pair.own) == (0.5, 0.3, 0.51, 0.31)
    assert (wall.pair.flags, wall.pair.drift, wall.components) == (0.125, 0.07, 16)
    with pytest.raises(SystemExit, match="is not the wall"):
        random_supports.recall(found, rows[1])
