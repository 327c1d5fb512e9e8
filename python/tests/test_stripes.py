"""Multiple stripes: results, blocks, threads, interruption."""

import os
import pickle
import signal
import threading
import time

import numpy as np
import pytest

import dondolo as dd
from dondolo._fortran import _core
from dondolo.analysis import request

LEVELS = [0.2, 0.5, 0.9]


@pytest.fixture(scope="module")
def analysis(wall, few):
    """A small analysis with both polarities."""
    return dd.multiple_stripe(wall, few, LEVELS, polarity="both", progress=False)


def test_shapes(analysis, few):
    shape = (3, 2 * len(few))
    for what in ("edp", "collapsed", "impacts", "time_of_peak", "scale"):
        assert getattr(analysis, what).shape == shape
        assert not getattr(analysis, what).flags.writeable
    assert analysis.record_names == 2 * tuple(record.name for record in few)
    assert list(analysis.polarity) == [1] * len(few) + [-1] * len(few)
    assert np.array_equal(analysis.collapses, analysis.collapsed.sum(axis=1))
    assert np.array_equal(analysis.histories, [shape[1]] * 3)
    assert np.array_equal(analysis.fraction, analysis.collapses / shape[1])
    assert np.array_equal(analysis.edp[analysis.collapsed], np.ones(analysis.collapsed.sum()))
    assert repr(analysis).startswith("<Stripes: wall parapet")
    assert "parapet" in analysis._repr_html_()


def test_every_history_is_the_motion_it_stands_for(analysis, wall, few):
    records = 2 * list(few)
    for j in range(3):
        for i, record in enumerate(records):
            assert analysis.scale[j, i] == pytest.approx(LEVELS[j] * 9.81 / record.peak_acceleration, rel=1e-15)
            scale = analysis.polarity[i] * analysis.scale[j, i]
            motion = dd.simulate(wall, record, scale, solver=dd.Solver(engine="lanes"), history=False)
            assert motion.edp == analysis.edp[j, i]
            assert motion.impacts == analysis.impacts[j, i]
            assert motion.time_of_peak == analysis.time_of_peak[j, i]


def test_work(analysis, wall, few):
    work = analysis.work
    assert work.histories == analysis.edp.size
    assert work.still == (analysis.edp == 0.0).sum() > 0
    assert work.intervals == 2 * 3 * sum(len(record.acceleration) - 1 for record in few)
    assert 0 < work.rocked < work.intervals
    assert work.steps >= work.rocked
    assert work.evaluations >= work.steps
    assert f"{work.still} of {work.histories} histories never move" in repr(analysis)
    # Below the trigger nothing is integrated; with estimated errors, three times nothing.
    trigger = wall.trigger_acceleration / wall.gravity
    for estimate_error, times in ((False, 1), (True, 3)):
        calm = dd.multiple_stripe(wall, few, [0.999 * trigger], estimate_error=estimate_error, progress=False).work
        samples = sum(len(record.acceleration) - 1 for record in few)
        assert calm == dd.results.Work(histories=times * len(few), still=times * len(few), intervals=times * samples)


def test_two_sided_walls_run_both_polarities_once(few):
    wall = dd.FreeStandingWall(2.0, 0.4)
    both = dd.multiple_stripe(wall, few, LEVELS, polarity="both", progress=False)
    once = dd.multiple_stripe(wall, few, LEVELS, progress=False)
    assert both.edp.shape == once.edp.shape
    assert np.array_equal(both.edp, once.edp)


@pytest.mark.parametrize("threads", [1, 2, 3, 7])
def test_threads_change_nothing(analysis, wall, few, threads):
    other = dd.multiple_stripe(wall, few, LEVELS, polarity="both", threads=threads, progress=False)
    assert np.array_equal(other.edp, analysis.edp)
    assert np.array_equal(other.time_of_peak, analysis.time_of_peak)
    assert other.work == analysis.work


@pytest.mark.parametrize("samples", [1, 20_000])
def test_blocks_change_nothing(analysis, wall, few, samples, monkeypatch, replace_procedure):
    monkeypatch.setattr(request, "_FIRST_SAMPLES", samples)
    monkeypatch.setattr(request, "_SECONDS", 0.0)
    sizes = []
    run_block = _core.stripes.run_block

    def spy(*arguments):
        sizes.append(arguments[-1])
        return run_block(*arguments)

    replace_procedure("stripes.run_block", spy)
    other = dd.multiple_stripe(wall, few, LEVELS, polarity="both", progress=False)
    assert len(sizes) > 3
    assert sum(sizes) == other.edp.size
    assert np.array_equal(other.edp, analysis.edp)
    assert np.array_equal(other.collapsed, analysis.collapsed)
    assert other.work == analysis.work


def test_two_python_threads_at_once(analysis, wall, few):
    found = []

    def work():
        found.append(dd.multiple_stripe(wall, few, LEVELS, polarity="both", threads=1, progress=False).edp)

    team = [threading.Thread(target=work) for _ in range(4)]
    for member in team:
        member.start()
    for member in team:
        member.join()
    assert len(found) == 4
    assert all(np.array_equal(edp, analysis.edp) for edp in found)


def test_the_lock_is_released(wall):
    long = dd.Record(np.sin(0.3 * np.arange(1_000_000)), 0.01)
    ticks = []
    motion = threading.Thread(target=lambda: dd.simulate(wall, long, 2.0, history=False))
    start = time.perf_counter()
    motion.start()
    while motion.is_alive():
        ticks.append(time.perf_counter())
        time.sleep(0.001)
    assert ticks[-1] - start > 0.02
    assert max(np.diff([start, *ticks])) < 0.6 * (ticks[-1] - start)


def test_pickle(analysis):
    again = pickle.loads(pickle.dumps(analysis))
    assert np.array_equal(again.edp, analysis.edp)
    assert repr(again) == repr(analysis)


@pytest.mark.parametrize(
    ("changes", "sentence"),
    [
        ({"levels": []}, "levels: must be given"),
        ({"levels": [0.2, 0.2]}, "levels = 0.2, 0.2: must increase strictly"),
        ({"levels": [0.2, np.nan]}, "levels = NaN: must be positive"),
        ({"levels": [1e6]}, "levels = 1000000: scales record"),
        ({"im": "pgx"}, "im = 'pgx': must be one of 'pga'"),
        ({"polarity": "up"}, "polarity = 'up': must be one of 'as_recorded', 'reversed', 'both'"),
        ({"threads": -1}, "threads = -1: must be an integer, between 0 and 1024"),
        ({"threads": 1.5}, "threads = 1.5: must be an integer, between 0 and 1024"),
        ({"solver": "rk45"}, "solver: must be a Solver, not str"),
        ({"records": []}, "records: must be given"),
        ({"records": [1.0]}, "records: must be a Record, not float"),
        ({"wall": None}, "wall: must be a Wall, not NoneType"),
    ],
)
def test_errors(wall, few, changes, sentence):
    arguments = {"wall": wall, "records": few, "levels": LEVELS, "progress": False} | changes
    with pytest.raises(dd.errors.InputError) as caught:
        dd.multiple_stripe(**arguments)
    assert str(caught.value).startswith(sentence)


def test_stripes_without_motion_of_the_wall(wall, sine):
    stripes = dd.multiple_stripe(wall, sine, [0.1], progress=False)
    with pytest.warns(dd.errors.DondoloWarning, match="the wall begins to rock at a PGA of 0.1667 g") as caught:
        assert stripes.fit().status == "no_collapse"
    assert caught[0].filename == __file__


def test_values_in_other_units_warn(sine):
    """Each is named with its unit, in an analysis of stripes and in one motion."""
    strong = dd.Record(1000.0 * sine.acceleration, sine.dt, "strong")
    strip = dd.TwoBlockWall(
        3.0, 0.25, density=18.0, overburden=15.0, overburden_inertia=0.0, gravity=32.2, name="strip"
    )
    sentences = [
        "wall 'strip': density = 18 kg/m3 is less than 500 kg/m3: is it in kN/m3 or t/m3?",
        "wall 'strip': overburden = 15 N/m is less than 200 N/m: is it in kN/m?",
        "wall 'strip': gravity = 32.2 m/s2 is more than 10 m/s2: is it in cm/s2 or ft/s2?",
        f"record 'strong': a PGA of {strong.peak_acceleration / 32.2:.4g} g, more than 3 g: wrong units?",
    ]
    with pytest.warns(dd.errors.DondoloWarning) as caught:
        dd.multiple_stripe(strip, strong, [0.1], progress=False)
    assert [str(one.message) for one in caught] == sentences
    for _ in range(2):
        with pytest.warns(dd.errors.DondoloWarning) as caught:
            dd.simulate(strip, strong, 1e-3, history=False)
        assert [str(one.message) for one in caught] == sentences
        assert caught[0].filename == __file__


def test_a_wrong_time_step_warns(sine):
    """PGV / PGA of a sine is its period / pi; one in ten samples as many seconds is no earthquake's."""
    wall = dd.OneSidedWall(3.0, 0.25)
    right = dd.Record(sine.acceleration, sine.dt, "right", metadata={"event": "A"})
    for dt, limit, why in (
        (10.0 * sine.dt, "more than 0.5", ", or a baseline that drifts"),
        (0.01 * sine.dt, "less than 0.015", ""),
    ):
        wrong = dd.Record(sine.acceleration, dt, "wrong", metadata={"event": "B"})
        ratio = wrong.intensity("pgv") / wrong.peak_acceleration
        sentence = f"record 'wrong': PGV / PGA = {ratio:.4g} s, {limit} s: wrong time step{why}?"
        with pytest.warns(dd.errors.DondoloWarning) as caught:
            dd.simulate(wall, wrong, 1e-3, history=False)
        assert [str(one.message) for one in caught] == [sentence]
        with pytest.warns(dd.errors.DondoloWarning) as caught:
            dd.multiple_stripe(wall, [right, wrong], [0.1], progress=False)
        assert [str(one.message) for one in caught] == [f"{sentence} (1 of 2 records)"]
        assert caught[0].message.code == "record_pgv_pga"


def test_velocities_in_other_units_warn(sine):
    with pytest.warns(dd.errors.DondoloWarning, match="levels up to 20 of pgv, more than 5 m/s: are they in cm/s"):
        dd.multiple_stripe(dd.OneSidedWall(3.0, 0.25), sine, [10.0, 20.0], im="pgv", progress=False)


def test_interruption_keeps_what_is_complete(wall, records, monkeypatch, replace_procedure):
    monkeypatch.setattr(request, "_FIRST_SAMPLES", 1)
    monkeypatch.setattr(request, "_SECONDS", 0.0)
    done = []
    run_block = _core.stripes.run_block

    def stop(*arguments):
        done.append(arguments[-1])
        if sum(done) > 100:
            os.kill(os.getpid(), signal.SIGINT)
        return run_block(*arguments)

    replace_procedure("stripes.run_block", stop)
    with pytest.raises(dd.errors.Interrupted) as caught:
        dd.multiple_stripe(wall, records, LEVELS, progress=False)
    partial = caught.value.partial
    assert isinstance(caught.value, KeyboardInterrupt)
    assert len(partial.levels) == 2
    monkeypatch.undo()
    whole = dd.multiple_stripe(wall, records, LEVELS, progress=False)
    assert np.array_equal(partial.edp, whole.edp[:2])


def test_interruption_is_quick(records):
    wall = dd.FreeStandingWall(6.0, 1.0)
    """Of work that takes half a minute on a quick machine little is done when Ctrl-C comes after half a second."""
    timer = threading.Timer(0.5, os.kill, (os.getpid(), signal.SIGINT))
    timer.start()
    with pytest.raises(dd.errors.Interrupted) as caught:
        dd.multiple_stripe(wall, list(records) * 50, np.linspace(0.2, 2.0, 500), progress=False)
    timer.cancel()
    partial = caught.value.partial
    assert partial is None or len(partial.levels) < 250


def test_progress_is_silent_without_a_terminal(wall, few, capfd):
    dd.multiple_stripe(wall, few, LEVELS)
    assert capfd.readouterr() == ("", "")


@pytest.mark.filterwarnings("ignore:The .float_precision. argument is deprecated")
def test_tables(analysis, tmp_path):
    pandas = pytest.importorskip("pandas")
    for name in ("histories", "stripes", "walls"):
        analysis.to_csv(tmp_path / "table.csv", name)
        table = pandas.read_csv(
            tmp_path / "table.csv", comment="#", float_precision="round_trip", dtype={"group": object}
        ).fillna({"group": ""})
        pandas.testing.assert_frame_equal(table, analysis.to_frame(name), check_exact=True, check_dtype=False)
    with pytest.raises(dd.errors.InputError, match="table = 'walks': must be one of 'histories', 'stripes', 'walls'"):
        analysis.to_frame("walks")
    with pytest.raises(dd.errors.DondoloError, match="cannot be written"):
        analysis.to_csv(tmp_path / "nowhere" / "table.csv")


def test_estimated_errors(wall, records):
    """They come with the stripes, leave all else as it is, and tell the histories that are off; a warning says so."""
    plain = dd.multiple_stripe(wall, records, [0.8], solver=dd.Solver(engine="rk45"), progress=False)
    assert plain.edp_error is None
    assert "edp_error" not in plain.to_frame()
    with pytest.warns(dd.errors.DondoloWarning) as caught:
        told = dd.multiple_stripe(
            wall, records, [0.8], solver=dd.Solver(engine="rk45"), estimate_error=True, progress=False
        )
    sentence = str(caught[-1].message)
    worst = told.record_names[int(told.edp_error.argmax())]
    assert sentence.startswith(
        "ill-conditioned: 1 of 44 histories with an estimated error of the EDP above 1e-6; the largest"
    )
    assert sentence.endswith(f"(record '{worst}' at level 0.8)")
    assert np.array_equal(told.edp, plain.edp)
    exact = dd.multiple_stripe(
        wall, records, [0.8], solver=dd.Solver(engine="rk45", rtol=1e-13, atol=1e-15), progress=False
    )
    off = abs(told.edp - exact.edp)
    assert np.array_equal(off > 1e-6, told.edp_error > 1e-6)
    assert told.edp_error.max() == pytest.approx(off.max(), rel=0.1)
    assert not told.edp_error.flags.writeable
    assert list(told.to_frame()["edp_error"]) == list(told.edp_error.ravel())
