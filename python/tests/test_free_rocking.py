"""Walls that are not at rest at the start: free rocking against closed forms, and the same by every route."""

import json
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from scipy.special import ellipkinc, ellipkm1

import dondolo as dd

STILL = dd.Record(np.zeros(2), 0.01, name="still")


def quarter(alpha: float, amplitude: float) -> float:
    """Frequency parameter times the time from an amplitude to the impact of one block (docs/theory.md, section 4)."""
    modulus = np.cos(0.5 * (alpha - amplitude))
    argument = np.arcsin(np.cos(0.5 * alpha) / modulus)
    return float(ellipkm1(np.sin(0.5 * (alpha - amplitude)) ** 2) - ellipkinc(argument, modulus**2))


@pytest.mark.parametrize("part", [0.05, 0.5, 0.95])
@pytest.mark.parametrize("kind", [dd.OneSidedWall, dd.FreeStandingWall])
def test_decay_of_one_block(kind, part):
    wall = kind(2.0, 0.4)
    alpha, p, e = wall.capacity_angle, wall.frequency_parameter, wall.restitution_coefficient
    motion = dd.simulate(wall, STILL, initial_rotation=part * alpha, solver=dd.Solver(rtol=1e-12, atol=1e-14))
    assert (motion.edp, motion.time_of_peak) == (pytest.approx(part, rel=1e-15), 0.0)
    after = motion.after_impact
    times, speeds = motion.time[after][:6], np.abs(motion.velocity[after][:6])
    assert len(times) >= 3
    energy = np.cos(alpha - part * alpha) - np.cos(alpha)
    expected, amplitude = 0.0, part * alpha
    for number, (time, speed) in enumerate(zip(times, speeds, strict=True), 1):
        expected += quarter(alpha, amplitude) / p
        assert time == pytest.approx(expected, rel=1e-9)
        left = e ** (2 * number) * energy
        assert speed == pytest.approx(p * np.sqrt(2.0 * left), rel=1e-9)
        amplitude = alpha - np.arccos(np.cos(alpha) + left)
        expected += quarter(alpha, amplitude) / p


def test_slender_blocks_decay_as_housner_says():
    wall = dd.FreeStandingWall(2.0, 0.02, restitution_value=0.9)
    motion = dd.simulate(wall, STILL, initial_rotation=0.6 * wall.capacity_angle)
    p, e, alpha = wall.frequency_parameter, 0.9, wall.capacity_angle
    assert motion.time[motion.after_impact][0] == pytest.approx(np.arccosh(1.0 / 0.4) / p, rel=1e-4)
    ends = np.flatnonzero(motion.after_impact)
    for number in range(1, 5):
        flight = np.abs(motion.rotation[ends[number - 1] : ends[number]]) / alpha
        assert flight.max() == pytest.approx(1.0 - np.sqrt(1.0 - e ** (2 * number) * (1.0 - 0.4**2)), rel=1e-3)


def test_mirrored_start_is_mirrored_motion():
    wall = dd.FreeStandingWall(2.0, 0.4)
    there, back = (
        dd.simulate(wall, STILL, initial_rotation=sign * 0.05, initial_velocity=sign * 0.1) for sign in (1.0, -1.0)
    )
    assert np.array_equal(there.rotation, -back.rotation)
    assert np.array_equal(there.velocity, -back.velocity)
    assert np.array_equal(there.side, -back.side)


def test_a_push_that_overturns():
    """From rest a block overturns with the velocity whose energy lifts it to its capacity."""
    wall = dd.FreeStandingWall(2.0, 0.4)
    limit = wall.frequency_parameter * np.sqrt(2.0 * (1.0 - np.cos(wall.capacity_angle)))
    for sign in (1.0, -1.0):
        assert dd.simulate(wall, STILL, initial_velocity=sign * limit * (1.0 + 1e-9)).collapsed
        survivor = dd.simulate(wall, STILL, initial_velocity=sign * limit * (1.0 - 1e-9))
        assert not survivor.collapsed
        assert survivor.edp > 0.999
    assert dd.simulate(dd.OneSidedWall(2.0, 0.4), STILL, initial_velocity=limit * (1.0 + 1e-9)).collapsed


def test_estimated_error_knows_the_start():
    """Where the start decides whether the wall overturns, the estimate finds that it does."""
    wall = dd.FreeStandingWall(2.0, 0.4)
    limit = wall.frequency_parameter * np.sqrt(2.0 * (1.0 - np.cos(wall.capacity_angle)))
    with pytest.warns(dd.errors.DondoloWarning, match="uncertain|doubt|ill"):
        edge = dd.simulate(wall, STILL, initial_velocity=limit * (1.0 - 1e-14), estimate_error=True)
    assert edge.edp + 2.0 * edge.edp_error >= 1.0 > edge.edp
    sure = dd.simulate(wall, STILL, initial_velocity=0.5 * limit, estimate_error=True)
    assert sure.edp_error < 1e-9


def test_no_warning_of_still_ground(recwarn):
    wall = dd.FreeStandingWall(2.0, 0.4)
    dd.simulate(wall, STILL, initial_rotation=0.01)
    assert not recwarn.list
    with pytest.warns(dd.errors.DondoloWarning, match="moves no wall"):
        dd.simulate(wall, STILL)


@pytest.mark.parametrize(
    ("changes", "sentence"),
    [
        ({"initial_rotation": -0.01}, "initial_rotation = -0.01: must not be negative"),
        ({"initial_rotation": 0.2}, "initial_rotation = 0.2: must lie within 0.197"),
        ({"initial_velocity": -0.01}, "initial_velocity = -0.01: must not be negative"),
        (
            {"initial_rotation": 0.01, "solver": dd.Solver(engine="lanes")},
            "engine = 'lanes': begins every history at rest",
        ),
    ],
)
def test_errors(changes, sentence):
    with pytest.raises(dd.errors.InputError) as caught:
        dd.simulate(dd.OneSidedWall(2.0, 0.4), STILL, **changes)
    assert str(caught.value).startswith(sentence)


def test_the_same_by_every_route(tmp_path, monkeypatch):
    """The executable's files, `run_case`, `read_results`, a saved result and `simulate`."""
    monkeypatch.chdir(tmp_path)
    record = dd.synthetic_records(6.5, 10.0, "shallow", n_records=1)[0]
    dd.RecordSet([record]).to_catalogue("records.csv")
    Path("c.nml").write_text(
        "&job task = 'history', output = 'out/c' /\n"
        "&wall mechanism = 'free_standing', height = 2.0, thickness = 0.4 /\n"
        "&records catalogue = 'records.csv' /\n"
        "&history scale = 0.5, initial_rotation = -0.08, initial_velocity = 0.02 /\n"
    )
    case = dd.read_case("c.nml")
    assert (case.initial_rotation, case.initial_velocity) == (-0.08, 0.02)
    subprocess.run([Path(sys.executable).with_name("dondolo"), "c.nml"], check=True, capture_output=True)
    run = json.loads(Path("out/c_run.json").read_text())
    assert (run["history"]["initial_rotation_rad"], run["history"]["initial_velocity_rad_s"]) == (-0.08, 0.02)
    again = dd.simulate(case.population[0], case.records[0], 0.5, initial_rotation=-0.08, initial_velocity=0.02)
    again.save("response.npz")
    for one in (dd.read_results("out/c").response, dd.run_case("c.nml").response, dd.load("response.npz")):
        assert (one.initial_rotation, one.initial_velocity, one.rotation[0]) == (-0.08, 0.02, -0.08)
        assert (one.edp, one.impacts) == (again.edp, again.impacts)
        assert np.array_equal(one.rotation, again.rotation)
    again.to_csv("again.csv")
    ours, theirs = (Path(name).read_text().splitlines() for name in ("again.csv", "out/c_history.csv"))
    rows = next(i for i, line in enumerate(theirs) if line.startswith("time_s"))
    assert ours[-len(theirs[rows:]) :] == theirs[rows:]
    for line in ("# initial_rotation_rad: ", "# initial_velocity_rad_s: "):
        assert [one for one in ours if one.startswith(line)] == [one for one in theirs if one.startswith(line)] != []
