"""One motion: the numbers, the history, the sides."""

import pickle

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import dondolo as dd

TWO_SIDED = dd.FreeStandingWall(height=6.0, thickness=0.9)


def test_under_the_threshold_nothing_moves(wall, sine):
    response = dd.simulate(wall, sine, scale=0.999 * wall.trigger_acceleration)
    assert (response.edp, response.collapsed, response.impacts) == (0.0, False, 0)
    assert not response.rotation.any()


def test_history(sine):
    # The peak comes after the sine: zeros keep it within the record.
    sine = dd.Record(np.append(sine.acceleration, np.zeros(300)), sine.dt)
    response = dd.simulate(TWO_SIDED, sine, scale=2.0)
    assert 0.0 < response.edp < 1.0
    assert response.time.shape == response.rotation.shape == response.velocity.shape == response.side.shape
    assert np.all(np.diff(response.time) >= 0.0)
    assert response.edp == pytest.approx(np.abs(response.rotation).max() / TWO_SIDED.capacity_angle, rel=1e-3)
    inside = response.time <= sine.duration
    expected = 2.0 * np.interp(response.time[inside], sine.time, sine.acceleration)
    assert response.ground_acceleration[inside] == pytest.approx(expected, abs=1e-9)


def test_sides_and_impacts(sine):
    response = dd.simulate(TWO_SIDED, sine, scale=2.0)
    moving = response.rotation != 0.0
    assert np.array_equal(response.side[moving], np.sign(response.rotation[moving]))
    assert set(response.side) == {-1, 1}
    # Before an impact the wall comes back (q' < 0), after it it leaves (q' > 0), on the other side
    after = np.flatnonzero(response.after_impact)
    before = after - 1
    assert np.sum(response.time[after] <= sine.duration) == response.impacts > 2
    assert len(after) > response.impacts
    assert np.array_equal(response.time[before], response.time[after])
    assert not moving[before].any()
    assert not moving[after].any()
    speed = response.side * response.velocity
    assert np.all(speed[before] < 0.0)
    np.testing.assert_allclose(speed[after], -TWO_SIDED.restitution_coefficient * speed[before], rtol=1e-15)
    assert np.array_equal(response.side[before], -response.side[after])
    # No other rows are of an impact
    assert np.all(np.diff(response.time)[np.setdiff1d(np.arange(len(moving) - 1), before)] > 0.0)


def test_one_sided_walls_have_one_side(wall, sine):
    response = dd.simulate(wall, sine, scale=3.0)
    assert np.all(response.side == 1)
    assert response.after_impact.sum() >= response.impacts > 0


def test_without_history(wall, sine):
    short, long = (dd.simulate(wall, sine, scale=3.0, history=history) for history in (False, True))
    assert short.time is short.side is short.after_impact is None
    assert (short.edp, short.collapsed, short.impacts) == (long.edp, long.collapsed, long.impacts)
    assert short.time_of_peak == long.time_of_peak
    with pytest.raises(dd.errors.DondoloError, match="no time history"):
        short.to_csv("nowhere.csv")


def test_collapse(wall, sine):
    response = dd.simulate(wall, sine, scale=9.0, solver=dd.Solver(edp_limit=0.8))
    assert response.collapsed
    assert response.edp == 0.8
    assert response.time_of_peak == response.time[-1]


def test_negative_scale_is_the_reversed_record(wall, sine):
    reversed_record = dd.Record(-sine.acceleration, sine.dt)
    assert dd.simulate(wall, sine, -3.0).edp == dd.simulate(wall, reversed_record, 3.0).edp


def test_pickle(wall, sine):
    response = dd.simulate(wall, sine, scale=3.0)
    again = pickle.loads(pickle.dumps(response))
    assert np.array_equal(again.rotation, response.rotation)
    assert again.wall == wall


@pytest.mark.parametrize(
    ("changes", "sentence"),
    [
        ({"scale": float("nan")}, "scale = NaN: makes record 'sine' exceed"),
        ({"scale": 1e6}, "scale = 1000000: makes record 'sine' exceed 10000 m/s2"),
        ({"record": 3}, "record: must be a Record, not int"),
        ({"wall": "parapet"}, "wall: must be a Wall, not str"),
    ],
)
def test_errors(wall, sine, changes, sentence):
    arguments = {"wall": wall, "record": sine} | changes
    with pytest.raises(dd.errors.InputError) as caught:
        dd.simulate(**arguments)
    assert str(caught.value).startswith(sentence)


@pytest.mark.filterwarnings("ignore:The .float_precision. argument is deprecated")
def test_table(wall, sine, tmp_path):
    pandas = pytest.importorskip("pandas")
    response = dd.simulate(wall, sine, scale=3.0)
    response.to_csv(tmp_path / "history.csv")
    table = pandas.read_csv(tmp_path / "history.csv", comment="#", float_precision="round_trip")
    pandas.testing.assert_frame_equal(table, response.to_frame(), check_exact=True)


@settings(max_examples=30, deadline=None)
@given(scale=st.floats(0.1, 20.0), factor=st.floats(0.2, 5.0), kind=st.sampled_from(["one", "free", "two"]))
def test_scaling_the_record_or_its_factor(scale, factor, kind):
    wall = {
        "one": dd.OneSidedWall(2.0, 0.3),
        "free": TWO_SIDED,
        "two": dd.TwoBlockWall(3.0, 0.25, hinge=0.6, overburden=2000.0, overburden_inertia=0.0),
    }[kind]
    motion = np.sin(0.06 * np.arange(300)) * np.exp(-0.01 * np.arange(300))
    first = dd.simulate(wall, dd.Record(motion, 0.01), scale, history=False)
    second = dd.simulate(wall, dd.Record(motion * 2.0**3, 0.01), scale / 2.0**3, history=False)
    assert (first.edp, first.collapsed, first.impacts) == (second.edp, second.collapsed, second.impacts)
    assert 0.0 <= first.edp <= 1.0
    assert first.collapsed == (first.edp == 1.0)
    assert dd.simulate(wall, dd.Record(motion, 0.01), scale * factor, history=False).time_of_peak >= 0.0


@pytest.mark.parametrize(("engine", "step", "least"), [("rk45", 1, 0.0), ("rk45", 20, 0.0), ("lanes", 20, 1e-11)])
def test_estimated_error(wall, sine, engine, step, least):
    """The estimate is close to how far the EDP really is off, whether samples or tolerances limit the steps."""
    sine = dd.Record(sine.acceleration[::step], step * sine.dt)
    assert dd.simulate(wall, sine, 2.0).edp_error is None
    exact = dd.simulate(wall, sine, 2.0, solver=dd.Solver(rtol=1e-13, atol=1e-15), history=False).edp
    for rtol in (1e-3, 1e-4, 1e-5, 1e-6):
        solver = dd.Solver(engine=engine, rtol=rtol, atol=0.01 * rtol)
        rough = dd.simulate(wall, sine, 2.0, solver=solver, estimate_error=True)
        assert rough.edp != exact
        assert rough.edp_error == pytest.approx(abs(rough.edp - exact), rel=0.2, abs=least)
        assert "estimated error" in repr(rough)
    assert dd.simulate(wall, sine, 2.0, estimate_error=True).edp_error < 1e-9


def test_tightest_tolerances_are_doubted_too(wall, sine):
    """Where rounding rules, the other runs still take other steps."""
    tightest = dd.simulate(wall, sine, 2.0, solver=dd.Solver(rtol=2.3e-15, atol=1e-17), estimate_error=True)
    assert 0.0 < tightest.edp_error < 1e-9


def test_a_history_in_doubt_is_warned_of(wall, records):
    record = next(each for each in records if each.name == "18_l_aquila_2009_apr_07_m5.5_a")
    rk45 = dd.Solver(engine="rk45")
    with pytest.warns(dd.errors.DondoloWarning, match="ill-conditioned: the estimated error of the EDP is 0.000"):
        dd.simulate(
            wall, record, 0.8 * 9.81 / record.peak_acceleration, solver=rk45, estimate_error=True, history=False
        )
    collapse = dd.simulate(wall, record, 10.0 * 9.81 / record.peak_acceleration, estimate_error=True, history=False)
    assert collapse.collapsed
    assert "twice more collapses too" in repr(collapse)
