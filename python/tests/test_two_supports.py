"""The independent program of docs/verification on walls between two supports, and dondolo beside it."""

import shutil
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import dondolo as dd

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "docs/verification"))

import two_supports
import yardsticks


@pytest.fixture(scope="module")
def program():
    if shutil.which("gfortran") is None:
        pytest.skip("needs gfortran")
    return yardsticks.Program()


@pytest.mark.parametrize("case", two_supports.SWINGS)
def test_first_swings(program, case):
    """Start, turn and peak of swings that two derivations and two integrators in 40 digits agree on."""
    assert two_supports.swing(program, case) == pytest.approx(two_supports.SWINGS[case][3], rel=two_supports.PRECISE)


def test_tolerance(program, monkeypatch):
    """The error of a swing follows the tolerance."""
    monkeypatch.setattr(yardsticks, "TOLERANCE", 1e-5)
    exact = two_supports.SWINGS["c"][3]
    assert two_supports.swing(program, "c") != pytest.approx(exact, rel=1e-8)
    assert two_supports.swing(program, "c") == pytest.approx(exact, rel=1e-4)


def test_motions_of_supports(program):
    """Case 1 of a mode and a diaphragm in series, by exponential and by integration."""
    house = yardsticks.House(0.3, 6 / 7, 9 / 7, 0.05, 0.4, 0.10, 1.3)
    ground = np.array([[0.0, 1.0, -1.0, 1e-300, 0.0]])
    base, delta, _, rise = program.motions(house, ground, 0.05)[0, 1:5].T
    assert base == pytest.approx([0.3269764737570011, 0.3789313800132266, -0.1014051812442816, -0.6652606430405487])
    top = [-0.03170419682706897, -0.107224455755688, 0.8745712061813077, 0.923447045998603]
    assert base + rise == pytest.approx(top, rel=1e-11)
    drift = [-7.18269851052766e-5, -0.00102199285846769, -0.002792160923449984, -0.002325503645432566]
    assert delta == pytest.approx(drift, rel=1e-11)


def test_speeds_of_supports(program):
    """Differences of the drift are its speed."""
    ground = np.sin(2.0 * np.pi * np.outer([1.0, 1.5], np.arange(200) * 0.005))
    motion = program.motions(yardsticks.House(0.2, 0.3, 1.1, 0.05, 0.5), ground, 0.005)
    differences = (motion[:, 2:, 1] - motion[:, :-2, 1]) / 0.01
    assert differences == pytest.approx(motion[:, 1:-1, 2], abs=2e-3 * np.abs(differences).max())


STILL = [
    two_supports.strip("strip", 0.0, 0.0),
    two_supports.facade("facade", 9.0, 0.5, two_supports.leans(0.3, 0.0)),
    two_supports.facade("facade with its tie", 9.0, 0.5, two_supports.leans(0.3, 0.0), 5e-5),
]


@pytest.mark.parametrize("row", STILL, ids=lambda row: row.name)
def test_supports_that_do_not_drift_apart(program, row):
    """Peaks are those of dondolo, in whose equations nothing is then left out."""
    records = dd.example_records()[:4]
    levels = np.array([0.6, 0.9])
    peaks, drift = two_supports.peaks(program, row, records, levels)
    solver = dd.Solver(rtol=1e-12, atol=1e-14)
    edp = np.asarray(dd.multiple_stripe(row.wall, records, levels, polarity="both", progress=False, solver=solver).edp)
    assert (drift == 0.0).all()
    assert ((edp > 0.05) & (edp < 1.0)).any()
    assert peaks == pytest.approx(edp, rel=2e-6, abs=1e-9)


def test_collapses_under_a_soft_diaphragm(program):
    """The record of both supports collapses what the exact model does, that of the base alone does not."""
    row = two_supports.strip("strip", 6 / 7, 9 / 7, diaphragm=0.4)
    records, shares = dd.example_records()[:8], np.array([0.8, 1.25])
    alone = replace(row, wall=two_supports.strip("base alone", 6 / 7, 6 / 7).wall)
    print(two_supports.compare(program, row, records, shares), two_supports.compare(program, alone, records, shares))
    assert two_supports.compare(program, row, records, shares).flags <= 1 / 6
    assert two_supports.compare(program, alone, records, shares).flags >= 2 / 6
