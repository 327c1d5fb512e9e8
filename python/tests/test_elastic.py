"""Strips whose joints bend before they open: values of an independent program, and a second one here."""

import os
import subprocess
import sys

import numpy as np
import pandas as pd
import pytest
from scipy.integrate import solve_ivp

import dondolo as dd

pytestmark = pytest.mark.filterwarnings("ignore::dondolo.errors.DondoloWarning")

# Reduced restitution and a load as a dead force
COMMON = {"overburden_inertia": 0.0, "restitution": "sorrentino", "restitution_factor": 0.87}
WALLS = {
    "SAFEGo": {"height": 2.85, "thickness": 0.21, "density": 1884.0, "hinge": 0.72, "overburden": 21e3},
    "SIN-01": {"height": 2.764, "thickness": 0.102, "density": 1835.0, "hinge": 0.6, "overburden": 10.2e3},
    "docs": {"height": 3.0, "thickness": 0.25, "density": 1800.0, "hinge": 0.6, "overburden": 5e3},
}

#: T_1: q_y [rad], e_0 and L_y/J_y [1/m], in 33 digits
JOINTS = [
    ("SAFEGo", 0.03, 0.00016842266111958, 0.8587296484578, 0.690809951737),
    ("SAFEGo", 0.10, 0.0018288776543032, 0.8854597548804, 0.691968701089),
    ("SAFEGo", 0.15, 0.0039902208331937, 0.9051849633175, 0.693450134926),
    ("SIN-01", 0.06, 0.00043794755558611, 0.8853148573450, 0.889535557352),
    ("SIN-01", 0.15, 0.0026092368286393, 0.9203894911937, 0.890451577529),
    ("docs", 0.03, 0.000079058267674352, 0.8390154441289, 0.766836469379),
    ("docs", 0.10, 0.00087312624880223, 0.8530062288538, 0.767470770777),
]

#: Periods n and T [s] of the motion, its amplitude [m/s2]; peak [rad], None for a collapse, and time [s], in 33 digits
PEAKS = [
    ("SAFEGo", 0.03, 1, 0.28, 7.5, 0.0001206657941221, 0.080337485431),
    ("SAFEGo", 0.03, 2, 0.12, 13.94, 0.01043906605661, 0.211806596451),
    ("SAFEGo", 0.06, 2, 0.22, 9.65, 0.001183844118874, 0.407088689527),
    ("SAFEGo", 0.10, 1, 0.19, 12.87, 0.04250229247937, 0.300593703579),
    ("SAFEGo", 0.10, 1, 0.47, 11.79, None, 0.423523352680),
    ("SAFEGo", 0.15, 1, 0.37, 9.4, 0.06238168072129, 0.546083062867),
    ("SIN-01", 0.03, 1, 0.37, 6.46, 0.03600308905509, 0.499138389997),
    ("SIN-01", 0.06, 1, 0.47, 6.0, 0.002752222872655, 0.195460144010),
    ("SIN-01", 0.10, 2, 0.22, 4.91, 0.02368385423776, 0.382096809562),
    ("SIN-01", 0.15, 1, 0.47, 6.0, None, 0.419100771523),
    ("docs", 0.03, 2, 0.12, 5.88, 0.005250956273790, 0.209306556952),
    ("docs", 0.06, 1, 0.28, 3.17, 0.0002415052512283, 0.051279645693),
    ("docs", 0.10, 2, 0.22, 4.07, 0.01746019798432, 0.532079661670),
    ("docs", 0.15, 1, 0.47, 4.98, 0.07064322280414, 0.630676486857),
    ("docs", 0.15, 1, 0.37, 6.01, 0.1118167377617, 0.937650819856),
]


def strip(name, period, **more):
    return dd.TwoBlockWall(**WALLS[name], **COMMON, elastic_period=period, **more)


def wave(periods, period, amplitude, dt=0.01):
    time = dt * np.arange(round(periods * period / dt) + 1)
    return dd.Record(np.round(amplitude * np.sin(2 * np.pi * time / period), 6), dt, name="wave")


@pytest.mark.parametrize(("name", "period", "opening", "restitution", "lever"), JOINTS)
def test_joints(name, period, opening, restitution, lever):
    wall = strip(name, period)
    assert wall.opening_edp * wall.capacity_angle == pytest.approx(opening, rel=1e-12)
    assert wall.elastic_restitution == pytest.approx(restitution, rel=1e-12)
    assert wall.opening_acceleration == pytest.approx((2 * np.pi / period) ** 2 * opening / lever, rel=1e-12)


@pytest.mark.parametrize(("name", "period", "periods", "length", "amplitude", "peak", "time"), PEAKS)
def test_peaks(name, period, periods, length, amplitude, peak, time):
    wall, record = strip(name, period), wave(periods, length, amplitude)
    solver = dd.Solver(engine="rk45", rtol=1e-12, atol=1e-14)
    response = dd.simulate(wall, record, solver=solver, history=False)
    assert response.collapsed == (peak is None)
    assert response.time_of_peak == pytest.approx(time, abs=1e-9)
    if peak is not None:
        assert response.edp * wall.capacity_angle == pytest.approx(peak, rel=1e-9)
    # The mirror image is the same motion, and so is a time history.
    assert dd.simulate(wall, record, -1.0, solver=solver, history=False).edp == response.edp
    history = dd.simulate(wall, record, solver=solver)
    assert history.edp == response.edp
    assert np.abs(history.rotation).max() <= response.edp * wall.capacity_angle * (1 + 1e-12)
    if peak is not None:
        assert np.abs(history.rotation).max() == pytest.approx(peak, rel=0.02)
    # At the usual tolerances, and by the other engine
    assert dd.simulate(wall, record, history=False).edp == pytest.approx(response.edp, abs=1e-6)
    other = dd.simulate(wall, record, solver=dd.Solver(engine="lanes", rtol=1e-11, atol=1e-13))
    assert other.collapsed == (peak is None)
    assert other.time_of_peak == pytest.approx(time, abs=1e-7)
    if peak is not None:
        assert other.edp * wall.capacity_angle == pytest.approx(peak, rel=1e-8)
        assert np.abs(other.rotation).max() == pytest.approx(peak, rel=0.02)
    same = np.interp(history.time, other.time, other.rotation) - history.rotation
    assert np.abs(same[history.time < time]).max() < 1e-3 * wall.capacity_angle


def test_peaks_of_lanes(root):
    """All 72 values in 33 digits, at the tolerance of the other engine's test."""
    rows = pd.read_csv(root / "test/reference/bent_strips.csv", comment="#", dtype={"peak": str})
    solver = dd.Solver(engine="lanes", rtol=1e-11, atol=1e-13)
    assert len(rows) == 72
    for row in rows.itertuples():
        wall = strip(row.wall, row.elastic_period)
        response = dd.simulate(wall, wave(row.n, row.period, row.amplitude), solver=solver, history=False)
        assert response.collapsed == row.peak.endswith("collapse"), row
        assert response.time_of_peak == pytest.approx(row.time, abs=1e-7), row
        if not response.collapsed:
            assert response.edp * wall.capacity_angle == pytest.approx(abs(float(row.peak)), rel=1e-7), row


def test_joints_that_never_open_but_lose_energy():
    """The passage of x = 0 may be faster than at the opening, if the ground then brakes the wall."""
    rng = np.random.default_rng(5)
    wall = dd.TwoBlockWall(3.0, 0.25, elastic_period=0.12, elastic_damping=0.02)
    found = 0
    for _ in range(1200):
        motion = rng.normal(size=60) * rng.uniform(0.3, 1.2) * wall.trigger_acceleration
        record = dd.Record(motion, 0.01, name="noise")
        response = dd.simulate(wall, record, history=False)
        if response.edp >= wall.opening_edp or response.impacts == 0:
            continue
        found += 1
        steps = dd.simulate(wall, record, solver=dd.Solver(engine="rk45", rtol=1e-12, atol=1e-14))
        for other in (steps, dd.simulate(wall, record)):
            assert other.edp == pytest.approx(response.edp, rel=1e-11)
            assert other.time_of_peak == pytest.approx(response.time_of_peak, abs=1e-12)
            assert other.impacts == response.impacts
        peak = peak_of(wall, 0.12, record, after=0.2, xi=0.02)
        assert response.edp * wall.capacity_angle == pytest.approx(peak, rel=1e-6)
    assert found >= 5


@pytest.mark.slow
@pytest.mark.parametrize("name", WALLS)
def test_engines_agree(name, recorded):
    """Flags of 44 components at levels from bending to collapse. Histories next to a collapse may be apart."""
    for period in (0.03, 0.06, 0.10, 0.15):
        wall, levels = strip(name, period), np.linspace(0.3, 2.0, 6)
        lanes, steps = (
            dd.multiple_stripe(
                wall, list(recorded.values()), levels=levels, solver=dd.Solver(engine=engine), progress=False
            )
            for engine in ("lanes", "rk45")
        )
        assert np.count_nonzero(lanes.collapsed != steps.collapsed) <= 1
        assert np.count_nonzero(np.abs(lanes.edp - steps.edp) > 1e-6) <= 12
        assert np.median(np.abs(lanes.edp - steps.edp)) < 1e-12


def test_estimates(records):
    """Estimates and certificates work as of walls that do not bend."""
    wall, levels = strip("SAFEGo", 0.1), np.linspace(0.5, 2.5, 5)
    plain = dd.multiple_stripe(wall, records[:8], levels=levels, progress=False)
    stripes = dd.multiple_stripe(wall, records[:8], levels=levels, certify=True, progress=False)
    doubtful = np.nan_to_num(stripes.edp_error) > 1e-6
    assert np.array_equal(stripes.edp[~doubtful], plain.edp[~doubtful])
    assert np.count_nonzero(doubtful) < 8


def peak_of(wall, period, record, after=2.0, xi=0.05):
    """Largest rotation, by another method: DOP853 with events in both branches."""
    w, opening = 2 * np.pi / period, wall.opening_edp * wall.capacity_angle
    at_opening = wall.terms(opening)
    lever, e, speed = float(at_opening.excitation_lever / at_opening.inertia), wall.elastic_restitution, w * opening
    a, dt = record.acceleration, record.dt
    grid = np.append(dt * np.arange(a.size), dt * (a.size - 1) + after)
    state, peak = np.zeros(2), 0.0
    is_open = False
    for first, last, here, slope in zip(
        grid[:-1], grid[1:], np.append(a[:-1], 0.0), np.append(np.diff(a) / dt, 0.0), strict=True
    ):
        t = first
        while t < last:
            ground = lambda t, h=here, s=slope, t0=first: h + s * (t - t0)  # noqa: E731

            def rate(t, y, open_now=is_open, ground=ground):
                if not open_now:
                    return [y[1], -lever * ground(t) - 2 * xi * w * y[1] - w**2 * y[0]]
                side = np.sign(y[0])
                at = wall.terms(min(abs(y[0]), 1.2 * wall.capacity_angle))
                j, c, g, l_, load = (float(x) for x in at)
                return [y[1], side * (load - g - side * l_ * ground(t) - c * y[1] ** 2) / j]

            leaves = lambda t, y: abs(y[0]) - opening  # noqa: E731
            leaves.terminal, leaves.direction = True, -1 if is_open else 1
            zero = lambda t, y: y[0]  # noqa: E731
            zero.terminal = True
            turns = lambda t, y: y[1]  # noqa: E731
            done = solve_ivp(
                rate,
                (t, last),
                state,
                method="DOP853",
                events=[leaves, turns] if is_open or state[0] == 0.0 else [leaves, turns, zero],
                rtol=1e-11,
                atol=1e-15,
                max_step=period / 20,
            )
            peak = max(peak, *np.abs(done.y[0]), *(abs(y[0]) for y in done.y_events[1]))
            t, state = done.t[-1], done.y[:, -1]
            if done.status == 1 and done.t_events[0].size:
                is_open = not is_open
                state[0] = np.sign(state[0]) * opening * (1 + (1e-13 if is_open else -1e-13))
            elif done.status == 1:
                if abs(state[1]) > speed:
                    state[1] = np.sign(state[1]) * np.sqrt(e**2 * state[1] ** 2 + (1 - e**2) * speed**2)
                state[0] = np.sign(state[1]) * 1e-18
    return peak


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(6))
def test_against_another_method(seed):
    rng = np.random.default_rng(seed)
    height, period = rng.uniform(2.4, 4.0), rng.uniform(0.04, 0.15)
    wall = dd.TwoBlockWall(
        height,
        height / rng.uniform(11.0, 24.0),
        hinge=rng.uniform(0.4, 0.75),
        overburden=rng.uniform(0.0, 20e3),
        **COMMON,
        elastic_period=period,
    )
    a = rng.normal(size=26) * 0.8 * wall.trigger_acceleration
    a[[0, -1]] = 0.0
    record = dd.Record(a, 0.02, name="noise")
    response = dd.simulate(wall, record, solver=dd.Solver(engine="rk45", rtol=1e-12, atol=1e-14), history=False)
    assert not response.collapsed
    assert response.edp * wall.capacity_angle == pytest.approx(peak_of(wall, period, record), rel=1e-6)


@pytest.mark.parametrize(
    ("name", "modulus", "period"),
    [("docs", 1e9, 0.106950818000), ("SAFEGo", 1e9, 0.118771904401), ("SIN-01", 3e9, 0.131652126742)],
)
def test_periods(name, modulus, period):
    """Finite elements of the beam give 1e-6 more."""
    wall = dd.TwoBlockWall(**WALLS[name], **COMMON)
    assert wall.bending_period(modulus) == pytest.approx(period, rel=1e-11)
    with pytest.raises(dd.errors.InputError, match=r"young_modulus = 1e\+06: the load buckles the strip"):
        wall.bending_period(1e6)
    with pytest.raises(dd.errors.InputError, match="young_modulus = 0: must be positive"):
        wall.bending_period(0.0)


def test_damping():
    """What is not given is 5 per cent; less of it moves the wall more."""
    record = wave(2, 0.22, 9.0)
    edps = [
        dd.simulate(strip("SAFEGo", 0.06, **more), record, history=False).edp
        for more in ({}, {"elastic_damping": 0.05}, {"elastic_damping": 0.0}, {"elastic_damping": 0.2})
    ]
    assert edps[0] == edps[1]
    assert edps[2] > edps[0] > edps[3]


def test_short_periods_are_rigid_blocks():
    """Single pulses; of a long motion some outcomes stay apart for any period."""
    rigid = dd.TwoBlockWall(**WALLS["docs"], **COMMON)
    record = wave(1, 0.37, 6.2)
    exact = dd.simulate(rigid, record, history=False).edp
    apart = [
        abs(dd.simulate(strip("docs", period), record, history=False).edp - exact) for period in (0.03, 0.003, 3e-4)
    ]
    assert 0.02 < apart[0] < 0.03
    assert apart[1] < 5e-4
    assert apart[2] < 6e-5


def test_stripes(records):
    """Histories of a stripe share a filter; that changes nothing, and threads and groups do not either."""
    wall, levels = strip("docs", 0.1), np.linspace(0.2, 1.4, 7)
    stripes = dd.multiple_stripe(wall, records, levels=levels, progress=False)
    some = dd.multiple_stripe(wall, records[3:5], levels=levels[2:4], threads=1, progress=False)
    assert np.array_equal(some.edp, stripes.edp[2:4, 3:5])
    for record, scale, edp in zip(records[::9], stripes.scale[4, ::9], stripes.edp[4, ::9], strict=True):
        alone = dd.simulate(wall, record, scale)
        assert alone.edp == edp
        assert alone.edp >= min(1.0, 0.999 * np.abs(alone.rotation).max() / wall.capacity_angle)
    rigid = dd.multiple_stripe(dd.TwoBlockWall(**WALLS["docs"], **COMMON), records, levels=levels, progress=False)
    assert stripes.fit().theta < rigid.fit().theta
    assert stripes.work.still == np.count_nonzero(stripes.edp < wall.opening_edp)


@pytest.mark.slow
def test_medians_of_recorded_motions(recorded):
    """44 components, against a program with steps of its own; good to half a per cent."""
    for name, period, levels, theta in (
        ("SAFEGo", 0.10, 0.3 + 0.12 * np.arange(26), 1.2838),
        ("SIN-01", 0.15, 0.1 + 0.06 * np.arange(26), 0.5508),
        ("docs", 0.06, 0.1 + 0.1 * np.arange(26), 0.8841),
    ):
        curve = dd.multiple_stripe(strip(name, period), list(recorded.values()), levels=levels, progress=False).fit()
        assert curve.theta == pytest.approx(theta, rel=5e-3)


def test_refusals(records):
    for more, match in (
        ({"elastic_period": 0.1, "restitution_sd": 0.02}, "elastic_period = 0.1: not with restitution_sd"),
        ({"elastic_period": 0.1, "thrusts": [dd.Thrust(1e3, height=1.0)]}, "not with thrust"),
        ({"elastic_period": 0.1, "ties": [dd.Tie(height=1.5, area=1e-4, length=5.0)]}, "not with heights of ties"),
        ({"elastic_damping": 0.1}, "elastic_damping: only with elastic_period"),
        ({"elastic_period": 2.0}, "elastic_period = 2: this wall does not rock, it bends"),
        ({"elastic_period": 1e-5}, "elastic_period = 1e-5: must lie between 0.0001 and 10 s"),
        ({"elastic_period": 0.1, "elastic_damping": 0.3}, "elastic_damping = 0.3: must lie between 0 and 0.2"),
    ):
        with pytest.raises(dd.errors.InputError, match=match):
            dd.TwoBlockWall(3.0, 0.25, overburden=5e3, overburden_inertia=0.0, hinge=0.6, **more)
    wall = strip("docs", 0.1)
    with pytest.raises(dd.errors.InputError, match=r"edp_limit = 0\.005: must be more than 0\.00737"):
        dd.simulate(wall, records[0], solver=dd.Solver(edp_limit=0.005))


@pytest.mark.slow
def test_the_page_has_these_medians(root, recordings):
    """What docs/bending.md says of the recorded components, computed again."""
    done = subprocess.run(
        [sys.executable, root / "docs/bending.py", "--check"],
        env=os.environ | {"DONDOLO_RECORDS": str(recordings)},
        capture_output=True,
        text=True,
    )
    assert done.returncode == 0, done.stderr
