"""The independent program of docs/verification on walls between two supports, and dondolo beside it."""

import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import dondolo as dd

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "docs/verification"))

import moving_supports
import two_supports


@pytest.mark.parametrize("case", two_supports.SWINGS)
def test_first_swings(case):
    """Start, turn and peak of swings that two derivations and two integrators in 40 digits agree on."""
    assert two_supports.swing(case, parts=40) == pytest.approx(two_supports.SWINGS[case][3], rel=1e-6)


def test_motions_of_supports():
    """Case 1 of a mode and a diaphragm in series, by exponential and by integration."""
    house = moving_supports.House(0.3, 6 / 7, 9 / 7, 0.05, 0.4, 0.10, 1.3)
    motion = moving_supports.supports(house, np.array([[0.0, 1.0, -1.0, 0.0]]), 0.05, after=0.3)[2::2, :, 0]
    base = [0.3269764737570011, 0.3789313800132266, -0.1014051812442816, -0.6652606430405487]
    top = [-0.03170419682706897, -0.107224455755688, 0.8745712061813077, 0.923447045998603]
    delta = [-7.18269851052766e-5, -0.00102199285846769, -0.002792160923449984, -0.002325503645432566]
    assert motion[:4, moving_supports.BASE] == pytest.approx(base, rel=1e-10)
    assert motion[:4, moving_supports.BASE] + motion[:4, moving_supports.RISE] == pytest.approx(top, rel=1e-10)
    assert motion[:4, moving_supports.DELTA] == pytest.approx(delta, rel=1e-10)


STILL = [
    (two_supports.strip("strip", 0.0, 0.0), 1e-4),
    (two_supports.facade("facade", 9.0, 0.5, 0.3, top=0.0), 1e-4),
    (two_supports.facade("facade with its tie", 9.0, 0.5, 0.3, top=0.0, tied=True), 5e-3),
]


@pytest.mark.parametrize(("row", "within"), STILL, ids=lambda given: getattr(given, "name", ""))
def test_supports_that_do_not_drift_apart(row, within):
    """Peaks are those of dondolo, in whose equations nothing is then left out."""
    records = [dd.example_records()[1]]
    levels = np.array([0.6, 0.9])
    peaks, drift = two_supports.peaks(row, records, levels, parts=2)
    edp = np.asarray(dd.multiple_stripe(row.wall, records, levels, polarity="both", progress=False).edp)
    assert drift[0] == 0.0
    assert ((edp > 0.05) & (edp < 1.0)).any()
    assert peaks == pytest.approx(edp, rel=within, abs=1e-6)


def test_collapses_under_a_soft_diaphragm():
    """The record of both supports collapses what the exact model does, that of the base alone does not."""
    row = two_supports.strip("strip", 6 / 7, 9 / 7, diaphragm=0.4)
    records, shares = dd.example_records()[:3], np.array([0.8, 1.25])
    assert two_supports.compare(row, records, shares).flags <= 1 / 6
    alone = replace(row, wall=two_supports.strip("base alone", 6 / 7, 6 / 7).wall)
    assert two_supports.compare(alone, records, shares).flags >= 2 / 6
