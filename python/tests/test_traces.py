"""The motion of one history is that of its stripe."""

import numpy as np
import pytest

import dondolo as dd

WALLS = (
    dd.OneSidedWall(3.0, 0.25),
    dd.TwoBlockWall(3.0, 0.25, hinge=0.6, restitution_factor=0.87),
    dd.FreeStandingWall(2.0, 0.5),
)
OUTCOME = ("edp", "collapsed", "impacts", "time_of_peak", "edp_error")

pytestmark = pytest.mark.filterwarnings("ignore::dondolo.errors.DondoloWarning")


def check_traces(wall, records, levels, **solver):
    """Every history of stripes by itself, with and without its rows; the rows of those that rock."""
    stripes = dd.multiple_stripe(
        wall, records, levels, polarity="both", estimate_error=True, progress=False, solver=dd.Solver(**solver)
    )
    traces = []
    for (i, j), scale in np.ndenumerate(stripes.scale * stripes.polarity):
        record = records[stripes.record_index[j]]
        for history in (True, False):
            trace = dd.simulate(wall, record, scale, history=history, estimate_error=True, solver=dd.Solver(**solver))
            for name in OUTCOME:
                assert getattr(trace, name) == getattr(stripes, name)[i, j], (name, i, j, history)
            if history:
                check_rows(trace)
                traces.append(trace)
    return traces


def check_rows(trace):
    """The rows reach the peak, and have a row at every sample and two at every impact."""
    reached = np.abs(trace.rotation) / trace.wall.capacity_angle
    during = trace.time <= trace.record.duration
    assert trace.after_impact[during].sum() == trace.impacts
    ends = trace.time[-1] if trace.collapsed else trace.record.duration
    samples = trace.record.time[trace.record.time <= ends]
    assert np.isin(samples, trace.time).all()
    if trace.collapsed:
        assert reached[-1] == pytest.approx(trace.edp_limit, rel=1e-13)
        assert trace.time[-1] == pytest.approx(trace.time_of_peak, rel=1e-6)
    else:
        # The peak itself lies between two samples.
        assert trace.edp * (1.0 - 5e-3) - 1e-4 <= reached.max(initial=0.0) <= trace.edp * (1.0 + 1e-12)
    ground = trace.scale * np.interp(trace.time, trace.record.time, trace.record.acceleration)
    np.testing.assert_allclose(trace.ground_acceleration[during], ground[during], atol=1e-9)
    assert not trace.ground_acceleration[~during].any()


@pytest.mark.parametrize("wall", WALLS, ids=lambda wall: wall.mechanism)
def test_traces_are_those_of_the_stripe(wall, few):
    traces = check_traces(wall, few, [0.2, 0.5, 1.0])
    assert sum(trace.impacts > 0 and not trace.collapsed for trace in traces) >= 10


@pytest.mark.parametrize("wall", WALLS, ids=lambda wall: wall.mechanism)
def test_recorded_traces_are_those_of_the_stripe(wall, recorded):
    check_traces(wall, list(recorded.values())[::11], [0.3, 0.6])


def test_history_in_which_the_engines_differ(recorded):
    """A history that hangs in the balance: 0.93 by one engine, a collapse by the other."""
    wall, record, level = dd.OneSidedWall(3.1345, 0.2493), [recorded["20090406_0132_GSA_NS"]], 0.72420245
    lanes, rk45 = (check_traces(wall, record, [level], engine=engine) for engine in ("auto", "rk45"))
    assert lanes[0].edp != rk45[0].edp


def test_traces_under_vertical_motion(few):
    records = [record.with_vertical(dd.Record(0.5 * record.acceleration[::-1], record.dt)) for record in few[:3]]
    for wall in WALLS:
        check_traces(wall, records, [0.4, 0.8])


def test_engines_move_alike(few):
    """Row by row, where no rounding has grown."""
    for wall in WALLS:
        for record in few:
            for factor in (2.0, -4.0):
                scale = factor * wall.trigger_acceleration / record.peak_acceleration
                lanes, rk45 = (
                    dd.simulate(wall, record, scale, solver=dd.Solver(engine=engine, rtol=1e-11, atol=1e-13))
                    for engine in ("lanes", "rk45")
                )
                assert len(lanes.time) == len(rk45.time)
                for name in ("side", "after_impact"):
                    assert np.array_equal(getattr(lanes, name), getattr(rk45, name)), name
                unit = wall.capacity_angle
                np.testing.assert_allclose(lanes.rotation, rk45.rotation, atol=1e-6 * unit)


def test_traces_of_tied_walls(few):
    """Ties yield, break and go on after the record: what they come to is that of `rk45`."""
    wall = dd.OneSidedWall(3.0, 0.3, ties=[dd.Tie(2.5, area=1e-05, length=5.0)])
    traces = check_traces(wall, few[:4], [0.5, 1.0, 2.0])
    assert any(trace.ties.broken[0] for trace in traces)
    assert any(trace.ties.plastic_elongation[0] > 0.0 and not trace.ties.broken[0] for trace in traces)
    for trace in traces:
        other = dd.simulate(wall, trace.record, trace.scale, solver=dd.Solver(engine="rk45", rtol=1e-10, atol=1e-12))
        assert trace.tie_times == pytest.approx(other.tie_times, abs=1e-4, nan_ok=True)
        assert trace.ties.plastic_elongation == pytest.approx(other.ties.plastic_elongation, rel=1e-4, abs=1e-7)


@pytest.mark.parametrize("factor", [1.1, 1.3, 1.4])
def test_motion_after_the_record(factor):
    """Cut off while the wall rocks: it goes on in still ground, to rest or to its collapse."""
    ground = np.append(np.zeros(5), np.full(60, -1.0))
    record = dd.Record(ground, 0.01)
    wall = dd.FreeStandingWall(2.0, 0.5)
    lanes, rk45 = (
        dd.simulate(wall, record, factor * wall.trigger_acceleration, solver=dd.Solver(engine=engine))
        for engine in ("lanes", "rk45")
    )
    assert lanes.collapsed == rk45.collapsed == (factor > 1.2)
    assert lanes.time[-1] > record.duration + 0.1
    assert len(lanes.time) == len(rk45.time)
    np.testing.assert_allclose(lanes.time, rk45.time, atol=1e-6)
    np.testing.assert_allclose(lanes.rotation, rk45.rotation, atol=1e-7)
    np.testing.assert_allclose(lanes.velocity, rk45.velocity, atol=1e-6)
