"""Ctrl-C: in the middle of one history that would take minutes, and between blocks, where what is complete is kept."""

import inspect
import os
import signal
import subprocess
import sys
import threading
import time

import numpy as np
import pytest
from costs import unit
from public import public_things

import dondolo as dd
from dondolo._base.interrupts import deferred
from dondolo.analysis import certificate, cloud, overturning, request, stripe_runs
from dondolo.populations import blocks, study, uncertain_wall

# Kicks of the ground start chains of bounces that hardly lose speed: some 40 000 impacts each second of the record
PROGRAM = """
import os, signal, sys, threading
import numpy as np
import dondolo as dd

signal.signal(signal.SIGINT, signal.default_int_handler)
wall = dd.OneSidedWall(3.0, 0.25, restitution_value=0.99999)
ground = 0.6 * wall.trigger_acceleration * np.sin(2.0 * np.pi * 0.01 * np.arange(500_000))
for i in range(1, 4):
    ground[i::500] = -wall.trigger_acceleration * (1.0 + 1e-6)
record = dd.Record(ground, 0.01)
threading.Timer(0.3, os.kill, (os.getpid(), signal.SIGINT)).start()
solver = dd.Solver(engine=sys.argv[2])
try:
    if sys.argv[1] == "simulate":
        dd.simulate(wall, record, solver=solver, history=False)
    else:
        dd.multiple_stripe(wall, [record], [record.peak_acceleration / wall.gravity], solver=solver, progress=False)
    print("done")
except KeyboardInterrupt:
    print("interrupted")
short = dd.Record(ground[:200], 0.01)
print(dd.simulate(wall, short, 0.5).impacts)
"""


@pytest.mark.parametrize("engine", ["rk45", "lanes"])
@pytest.mark.parametrize("what", ["simulate", "stripes"])
def test_a_history_is_broken_off(what, engine):
    """The whole would take half an hour. What comes after is not broken off."""
    command = [sys.executable, "-c", PROGRAM, what, engine]
    done = subprocess.run(command, capture_output=True, text=True, timeout=60)
    assert done.stdout.split() == ["interrupted", "0"], done.stderr


@pytest.mark.parametrize("engine", ["rk45", "lanes"])
def test_an_event_breaks_a_history_off(engine):
    """In a thread of its own, as of a page whose reader leaves: at once, not after the present block of histories."""
    wall = dd.OneSidedWall(3.0, 0.25, restitution_value=0.99999)
    ground = 0.6 * wall.trigger_acceleration * np.sin(2.0 * np.pi * 0.01 * np.arange(500_000))
    for i in range(1, 4):
        ground[i::500] = -wall.trigger_acceleration * (1.0 + 1e-6)
    record, stop, raised = dd.Record(ground, 0.01), threading.Event(), []

    def run():
        level = record.peak_acceleration / wall.gravity
        with pytest.raises(dd.errors.Interrupted, match="0 of 1 stripes are complete"):
            dd.multiple_stripe(wall, [record], [level], solver=dd.Solver(engine=engine), progress=False, stop=stop)
        raised.append(time.perf_counter())

    beside = threading.Thread(target=run)
    beside.start()
    time.sleep(0.5)
    assert beside.is_alive()
    begin = time.perf_counter()
    stop.set()
    beside.join(30.0)
    assert raised
    assert raised[0] - begin < 2.0
    # What comes after is not broken off.
    short = dd.Record(ground[:200], 0.01)
    assert dd.multiple_stripe(wall, [short], [0.001], progress=False, stop=threading.Event()).edp.shape == (1, 1)


# Another thread goes on, whole, while Ctrl-C breaks off what the main thread computes
BESIDE = """
import os, signal, threading
import numpy as np
import dondolo as dd

signal.signal(signal.SIGINT, signal.default_int_handler)
records, wall, levels = list(dd.example_records()), dd.OneSidedWall(1.5, 0.25), np.linspace(0.05, 1.5, 40)
run = lambda several: dd.multiple_stripe(wall, several, levels, progress=False, threads=2).edp
expected = run(records)
mine = [dd.Record(record.acceleration, record.dt, record.name) for record in records[:8]]
found, stop = [], threading.Event()
def other():
    while not stop.is_set():
        try:
            found.append("same" if np.array_equal(run(records), expected) else "wrong")
        except BaseException as error:
            found.append(repr(error))
beside = threading.Thread(target=other)
beside.start()
broken_off = 0
for i in range(60):
    timer = threading.Timer(0.002 + 0.0007 * i, os.kill, (os.getpid(), signal.SIGINT))
    try:
        timer.start()
        while True:
            run(mine)
    except (KeyboardInterrupt, dd.errors.Interrupted):
        broken_off += 1
stop.set()
beside.join()
print(broken_off, len(found) > 9, *sorted(set(found)))
"""


@pytest.mark.slow
def test_another_thread_is_not_broken_off():
    done = subprocess.run([sys.executable, "-c", BESIDE], capture_output=True, text=True, timeout=60)
    assert done.stdout.split() == ["60", "True", "same"], done.stderr


def test_the_executable_dies_of_it(executable, tmp_path):
    wall = dd.OneSidedWall(3.0, 0.25)
    ground = 0.6 * wall.trigger_acceleration * np.sin(2.0 * np.pi * 0.01 * np.arange(100_000))
    for i in range(1, 4):
        ground[i::500] = -wall.trigger_acceleration * (1.0 + 1e-6)
    np.savetxt(tmp_path / "r.txt", ground, fmt="%.17g")
    (tmp_path / "records.csv").write_text("file,dt_s,units\nr.txt,0.01,m/s2\n")
    (tmp_path / "case.nml").write_text(
        "&job task = 'history' output = 'out/long' /\n"
        "&wall mechanism = 'one_sided' height = 3 thickness = 0.25\n"
        "restitution_value = 0.99999 /\n"
        "&records catalogue = 'records.csv' /\n&history record = 1 /\n&solver engine = 'rk45' /\n"
    )
    run = subprocess.Popen(
        [executable, "case.nml"], cwd=tmp_path, preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL)
    )
    time.sleep(1.0)
    run.send_signal(signal.SIGINT)
    assert run.wait(60) == -signal.SIGINT
    assert not (tmp_path / "out").exists()


@pytest.fixture
def interrupt_at(monkeypatch):
    """Let Ctrl-C come when a function of a module is called for a time, before or after what it does."""

    def arrange(module, name, call, after=False):
        inner, calls = getattr(module, name), []

        def called(*arguments, **named):
            calls.append(name)
            if len(calls) == call and not after:
                os.kill(os.getpid(), signal.SIGINT)
            result = inner(*arguments, **named)
            if len(calls) == call and after:
                os.kill(os.getpid(), signal.SIGINT)
            return result

        monkeypatch.setattr(module, name, called)
        return calls

    return arrange


@pytest.mark.parametrize("after", [False, True])
@pytest.mark.parametrize("name", ["next_level", "_stripes"])
def test_between_levels_that_are_chosen(name, after, wall, few, interrupt_at):
    """Three stripes are complete, and come out whole."""
    interrupt_at(stripe_runs, name, 3, after)
    with pytest.raises(dd.errors.Interrupted, match=r"interrupted: 3 of 6 stripes are complete") as caught:
        dd.adaptive_stripes(wall, few, budget=6 * len(few), progress=False)
    partial = caught.value.partial
    again = dd.multiple_stripe(wall, few, partial.levels, progress=False)
    assert np.array_equal(partial.edp, again.edp)
    assert partial.work == again.work


def test_while_the_first_level_is_chosen(wall, few, interrupt_at):
    interrupt_at(stripe_runs, "rounded", 1)
    with pytest.raises(dd.errors.Interrupted, match=r"interrupted: 0 of 6 stripes are complete") as caught:
        dd.adaptive_stripes(wall, few, budget=6 * len(few), progress=False)
    assert caught.value.partial is None


@pytest.mark.parametrize(("name", "complete"), [("next_level", 3), ("_stripes", 2)])
def test_a_handler_of_the_users_may_raise_anywhere(name, complete, wall, few, interrupt_at):
    def mine(number, frame):
        raise KeyboardInterrupt

    before = signal.signal(signal.SIGINT, mine)
    try:
        interrupt_at(stripe_runs, name, 3)
        with pytest.raises(dd.errors.Interrupted, match=rf"interrupted: {complete} of 6 stripes") as caught:
            dd.adaptive_stripes(wall, few, budget=6 * len(few), progress=False)
        assert signal.getsignal(signal.SIGINT) is mine
    finally:
        signal.signal(signal.SIGINT, before)
    assert len(caught.value.partial.levels) == complete


@pytest.mark.parametrize(("run", "how"), [(dd.multiple_stripe, [0.3, 0.6, 0.9]), (dd.adaptive_stripes, 24)])
@pytest.mark.parametrize("name", ["_stripes", "warn_of_errors"])
def test_when_all_stripes_are_complete(name, run, how, wall, few, interrupt_at):
    interrupt_at(stripe_runs, name, 3 if run is dd.adaptive_stripes and name == "_stripes" else 1)
    with pytest.raises(dd.errors.Interrupted, match=r"interrupted: 3 of 3 stripes are complete") as caught:
        run(wall, few, how, progress=False)
    assert len(caught.value.partial.levels) == 3


@pytest.mark.parametrize("after", [False, True])
def test_while_all_stripes_are_joined(after, wall, few, interrupt_at):
    interrupt_at(stripe_runs, "stack", 1, after)
    with pytest.raises(dd.errors.Interrupted, match=r"interrupted: 6 of 6 stripes are complete") as caught:
        dd.adaptive_stripes(wall, few, budget=6 * len(few), progress=False)
    assert len(caught.value.partial.levels) == 6


def test_when_all_walls_are_complete(few, interrupt_at):
    walls = [dd.OneSidedWall(1.5, 0.25), dd.OneSidedWall(2.0, 0.3)]
    with pytest.warns(dd.errors.DondoloWarning):
        whole = dd.typology(walls, few, [0.3, 0.6, 0.9], progress=False)
    interrupt_at(study, "combine", 1)
    with pytest.raises(dd.errors.Interrupted, match="interrupted: 2 of 2 walls are complete") as caught:
        dd.typology(walls, few, [0.3, 0.6, 0.9], progress=False)
    assert np.array_equal(caught.value.partial.exceedances, whole.exceedances)


def test_between_blocks_of_walls(few, interrupt_at):
    walls = [dd.OneSidedWall(1.5 + 0.1 * i, 0.25) for i in range(6)]
    interrupt_at(blocks, "upload_walls", 3)
    with pytest.raises(dd.errors.Interrupted, match="interrupted: 4 of 6 walls are complete") as caught:
        dd.typology(walls, few, [0.3, 0.6, 0.9], block=2, progress=False)
    assert len(caught.value.partial.walls) == 4


def test_a_cloud_and_a_spectrum_that_are_complete(wall, few, interrupt_at):
    interrupt_at(cloud, "fit", 1)
    calls = interrupt_at(cloud, "fit", 1)
    with pytest.raises(KeyboardInterrupt):
        dd.cloud(wall, few, progress=False)
    assert calls
    interrupt_at(overturning, "_bisect", 1)
    with pytest.raises(dd.errors.Interrupted, match="the scans of 2 of 2 frequencies are complete") as caught:
        dd.overturning_spectrum(
            wall, dd.pulses.one_sine, frequencies=[1.0, 2.0], amplitudes=[0.2, 0.5, 1.0, 2.0], progress=False
        )
    assert caught.value.partial.edp.shape == (4, 2)


def test_certificates_so_far(wall, few, interrupt_at, monkeypatch):
    stripes = dd.multiple_stripe(wall, few, [0.4, 0.6, 0.8], estimate_error=True, progress=False)
    monkeypatch.setattr(certificate, "is_doubtful", lambda edp, *_: np.ones(edp.shape, dtype=bool))
    monkeypatch.setattr(certificate, "_BLOCK", 5)
    # The first is of the rounding of the records.
    interrupt_at(certificate, "check", 3, after=True)
    with pytest.raises(dd.errors.Interrupted, match="interrupted: 10 of 24 histories in doubt are certified") as caught:
        stripes.certify(few, progress=False)
    assert np.count_nonzero(caught.value.partial.status) == 10


def test_deferred_interrupts():
    """Once for all that are nested, and as usual afterwards."""
    reached = []

    def nested():
        with deferred() as outer:
            with deferred() as inner:
                os.kill(os.getpid(), signal.SIGINT)
            reached.append(outer.requested and inner is outer)

    def failing():
        with deferred():
            os.kill(os.getpid(), signal.SIGINT)
            raise ValueError("wrong")

    with pytest.raises(KeyboardInterrupt):
        nested()
    assert reached == [True]
    with deferred() as told:
        with pytest.raises(KeyboardInterrupt), told.heard():
            os.kill(os.getpid(), signal.SIGINT)
        told.answered = True
    with pytest.raises(ValueError, match="wrong"):
        failing()
    assert signal.getsignal(signal.SIGINT) is signal.default_int_handler


def _stop_after(monkeypatch, module, name, call):
    """An event that is set when a function of a module has been called for a time."""
    event, inner, calls = threading.Event(), getattr(module, name), []

    def called(*arguments, **named):
        result = inner(*arguments, **named)
        calls.append(name)
        if len(calls) == call:
            event.set()
        return result

    monkeypatch.setattr(module, name, called)
    return event


def _in_a_thread(call):
    """What a call raises in a thread of its own."""
    raised = []

    def run():
        try:
            call()
        except BaseException as error:
            raised.append(error)

    thread = threading.Thread(target=run)
    thread.start()
    thread.join(60)
    assert not thread.is_alive()
    return raised


@pytest.mark.parametrize("is_main", [True, False])
def test_an_event_ends_stripes_after_a_block(is_main, wall, few, monkeypatch):
    """The stripes that are complete are kept, and are those of a run of their levels."""
    monkeypatch.setattr(request, "_FIRST_SAMPLES", (len(few) + 1) * max(map(len, few)))
    monkeypatch.setattr(request, "_SECONDS", 1e-9)
    stop = _stop_after(monkeypatch, request.Pace, "learn", 2)
    levels = [0.2, 0.4, 0.6, 0.8, 1.0, 1.2]

    def run():
        dd.multiple_stripe(wall, few, levels, progress=False, stop=stop)

    if is_main:
        with pytest.raises(dd.errors.Interrupted, match="of 6 stripes are complete") as caught:
            run()
        error = caught.value
        assert signal.getsignal(signal.SIGINT) is signal.default_int_handler
    else:
        (error,) = _in_a_thread(run)
        assert isinstance(error, dd.errors.Interrupted)
    part = error.partial
    whole = dd.multiple_stripe(wall, few, part.levels, progress=False)
    assert 0 < len(part.levels) < 6
    assert part.edp.tolist() == whole.edp.tolist()
    # An event of an earlier run ends nothing of the next
    assert len(dd.multiple_stripe(wall, few, levels, progress=False).levels) == 6


def test_an_event_that_was_set_before(wall, few):
    """Nothing is run, and nothing is kept."""
    stop = threading.Event()
    stop.set()
    with pytest.raises(dd.errors.Interrupted, match="interrupted: 0 of 2 stripes are complete") as caught:
        dd.Study(few, [0.4, 0.8]).run(wall, progress=False, stop=stop)
    assert caught.value.partial is None
    with pytest.raises(dd.errors.Interrupted):
        dd.adaptive_stripes(wall, few, 60, progress=False, stop=stop)
    grid = {"frequencies": [1.0, 2.0], "amplitudes": [0.2, 1.0]}
    with pytest.raises(dd.errors.Interrupted):
        dd.overturning_spectrum(wall, dd.pulses.ricker, **grid, progress=False, stop=stop)
    with pytest.raises(dd.errors.InputError, match=r"stop: must be a threading\.Event, not bool"):
        dd.multiple_stripe(wall, few, [0.4], progress=False, stop=True)


@pytest.mark.parametrize("is_main", [True, False])
def test_an_event_ends_a_population_after_a_block(is_main, few, monkeypatch, tmp_path):
    """The walls that are complete are in the checkpoint, from which the same call goes on."""
    walls = [dd.OneSidedWall(1.5 + 0.1 * i, 0.25, name=f"w{i}") for i in range(4)]
    how = {"levels": [0.4, 0.8], "checkpoint": tmp_path / "part", "block": 1, "progress": False}
    stop = _stop_after(monkeypatch, blocks.Blocks, "learn", 2)

    def run():
        dd.typology(walls, few, **how, stop=stop)

    if is_main:
        with pytest.raises(dd.errors.Interrupted, match="2 of 4 walls are complete") as caught:
            run()
        error = caught.value
    else:
        (error,) = _in_a_thread(run)
    assert len(error.partial.population) == 2
    resumed, whole = dd.typology(walls, few, **how), dd.typology(walls, few, [0.4, 0.8], progress=False)
    assert resumed["all"](0.6) == whole["all"](0.6)
    assert os.listdir(tmp_path) == ["part"]


def test_every_long_run_has_an_event():
    """What shows a progress bar can be ended from another thread."""
    things = public_things()
    methods = [
        getattr(kind, name) for kind in things.values() if inspect.isclass(kind) for name in dir(kind) if name[0] != "_"
    ]
    calls = [call for call in (*things.values(), *methods) if inspect.isfunction(call)]
    long = {call.__qualname__: call for call in calls if "progress" in inspect.signature(call).parameters}
    assert {"multiple_stripe", "run_case", "cloud", "Stripes.certify"} <= set(long)
    for name, call in long.items():
        assert "stop" in inspect.signature(call).parameters, name


def test_an_event_ends_a_cloud(wall, few, monkeypatch):
    """Nothing of a cloud that is not whole is kept; whole when the event comes, it is."""
    monkeypatch.setattr(request, "_FIRST_SAMPLES", 2 * max(map(len, few)))
    monkeypatch.setattr(request, "_SECONDS", 1e-9)
    stop = _stop_after(monkeypatch, request.Pace, "learn", 2)
    with pytest.raises(dd.errors.Interrupted, match=f"interrupted: . of {len(few)} histories are complete") as caught:
        dd.cloud(wall, few, progress=False, stop=stop)
    assert caught.value.partial is None
    monkeypatch.undo()
    stop = _stop_after(monkeypatch, request.Pace, "learn", 1)
    with pytest.raises(dd.errors.Interrupted, match=f"{len(few)} of {len(few)} histories are complete") as caught:
        dd.cloud(wall, few, scale=2.0, progress=False, stop=stop)
    assert caught.value.partial.edp.tolist() == dd.cloud(wall, few, scale=2.0, progress=False).edp.tolist()


def test_an_event_ends_certificates(wall, few, monkeypatch):
    """What is certified is kept, and the rest is certified by a second call."""
    stripes = dd.multiple_stripe(wall, few, [0.4, 0.6, 0.8], estimate_error=True, progress=False)
    monkeypatch.setattr(certificate, "is_doubtful", lambda edp, *_: np.ones(edp.shape, dtype=bool))
    monkeypatch.setattr(certificate, "_BLOCK", 5)
    # The first is of the rounding of the records.
    stop = _stop_after(monkeypatch, certificate, "check", 3)
    with pytest.raises(dd.errors.Interrupted, match="interrupted: 10 of 24 histories in doubt are certified") as caught:
        stripes.certify(few, progress=False, stop=stop)
    assert np.count_nonzero(caught.value.partial.status) == 10
    resumed, whole = caught.value.partial.certify(few, progress=False), stripes.certify(few, progress=False)
    assert resumed.edp_highest.tolist() == whole.edp_highest.tolist()
    with pytest.raises(dd.errors.Interrupted, match="0 of 24 histories have their friction"):
        stripes.friction_demand(few, progress=False, stop=stop)


def test_an_event_ends_what_runs_several_walls(wall, few, monkeypatch):
    """Designs, samples, hinges and measures end with it."""
    stop = threading.Event()
    stop.set()
    how = {"progress": False, "stop": stop}
    two_block = dd.TwoBlockWall(3.0, 0.25, hinge=0.6)
    sources = {"thickness": dd.distributions.Uniform(0.24, 0.26)}
    with pytest.raises(dd.errors.Interrupted):
        dd.compare_designs({"bare": wall, "thicker": dd.OneSidedWall(1.5, 0.4)}, few, [0.4, 0.8], **how)
    with pytest.raises(dd.errors.Interrupted):
        dd.propagate_uncertainty(wall, few, [0.4, 0.8], sources=sources, n_variants=8, **how)
    with pytest.raises(dd.errors.Interrupted):
        dd.weakest_hinge(two_block, few, [0.4, 0.8], hinges=[0.5, 0.6], **how)
    with pytest.raises(dd.errors.Interrupted):
        dd.compare_intensities(wall, few, ["pga"], **how)


@pytest.mark.filterwarnings("ignore::dondolo.errors.DondoloWarning")
def test_what_several_analyses_have_finished_is_kept(wall, few, monkeypatch):
    """An event in the last analysis of an uncertain wall, and in the second design: the ones before are there."""
    stop = threading.Event()
    how = {"progress": False, "stop": stop}
    sources = {"thickness": dd.distributions.Uniform(0.24, 0.26)}
    inner = uncertain_wall.multiple_stripe

    def stopped(*arguments, **named):
        stop.set()
        return inner(*arguments, **named)

    with monkeypatch.context() as patch:
        patch.setattr(uncertain_wall, "multiple_stripe", stopped)
        with pytest.raises(dd.errors.Interrupted, match="12 of 12 walls are complete; of the estimate") as caught:
            dd.propagate_uncertainty(wall, few, [0.4, 0.8, 1.2], sources=sources, n_variants=8, **how)
    whole = dd.typology(caught.value.partial.population, few, [0.4, 0.8, 1.2], progress=False)
    assert np.array_equal(caught.value.partial.exceedances, whole.exceedances)
    stop.clear()
    run = dd.Study.run

    def second(self, wall, **named):
        if wall.thickness == 0.4:
            stop.set()
        return run(self, wall, **named)

    designs = {"bare": wall, "thicker": dd.OneSidedWall(1.5, 0.4), "more": dd.OneSidedWall(1.5, 0.5)}
    with monkeypatch.context() as patch:
        patch.setattr(dd.Study, "run", second)
        with pytest.raises(dd.errors.Interrupted, match="1 of 3 designs are complete; of the next interr") as caught:
            dd.compare_designs(designs, few, [0.4, 0.8, 1.2], **how)
    found, alone = caught.value.partial, dd.compare_designs({"bare": wall}, few, [0.4, 0.8, 1.2], progress=False)
    assert found.names == ("bare",)
    assert np.array_equal(found.stripes[0].edp, alone.stripes[0].edp)
    assert np.array_equal(found.typology.exceedances, alone.typology.exceedances)


LONG_CASE = """
&job task = '{task}', output = 'out/long' /
&wall mechanism = 'one_sided', height = 3, thickness = 0.25, restitution_value = {restitution} /
&records catalogue = 'records.csv' /
{group}
&solver engine = '{engine}' /
"""


@pytest.mark.parametrize(("task", "engine"), [("history", "rk45"), ("stripes", "rk45"), ("stripes", "lanes")])
@pytest.mark.parametrize("is_main", [True, False])
def test_an_event_breaks_a_case_off(is_main, task, engine, tmp_path):
    """The whole would take minutes, or some seconds in lanes. No file is left, and the next run is whole."""
    trigger, is_history = dd.OneSidedWall(3.0, 0.25).trigger_acceleration, task == "history"
    peak, frequency = (0.6, 1.0) if is_history else (1.0, 3.0)
    ground = peak * trigger * np.sin(2.0 * np.pi * frequency * 0.01 * np.arange(500_000))
    if is_history:
        for i in range(1, 4):
            ground[i::500] = -trigger * (1.0 + 1e-6)
    np.savetxt(tmp_path / "r.txt", ground, fmt="%.17g")
    np.savetxt(tmp_path / "short.txt", ground[:200], fmt="%.17g")
    (tmp_path / "records.csv").write_text("file,dt_s,units\nr.txt,0.01,m/s2\n")
    level = np.abs(ground).max() / 9.80665
    levels = level * np.linspace(1.1, 1.6, 1000)
    listed = ", ".join(map(repr, levels.tolist()))
    group = "&history record = 1 /" if is_history else f"&stripes levels = {listed} /"
    restitution = 0.99999 if is_history else 0.5
    (tmp_path / "case.nml").write_text(LONG_CASE.format(task=task, group=group, engine=engine, restitution=restitution))
    before, stop = sorted(os.listdir(tmp_path)), threading.Event()
    threading.Timer(0.5, stop.set).start()

    def run():
        dd.run_case(tmp_path / "case.nml", progress=False, stop=stop)

    # CPU time, in which other programs have no part
    begin = time.process_time()
    if is_main:
        with pytest.raises(dd.errors.Interrupted) as caught:
            run()
        error = caught.value
        assert signal.getsignal(signal.SIGINT) is signal.default_int_handler
    else:
        (error,) = _in_a_thread(run)
    assert time.process_time() - begin < 200.0 * unit()
    assert (str(error), error.partial) == ("interrupted", None)
    assert sorted(os.listdir(tmp_path)) == before
    # An event of an earlier run ends nothing of the next, which runs in the same threads.
    (tmp_path / "records.csv").write_text("file,dt_s,units\nshort.txt,0.01,m/s2\n")
    assert dd.run_case(tmp_path / "case.nml", progress=False).run is not None


def test_an_event_ends_a_case_of_a_population(tmp_path):
    """The walls that are complete are kept in memory; nothing is written, a checkpoint neither."""
    records = dd.RecordSet(dd.synthetic_records(6.5, 10.0, "shallow", n_records=10))
    records.to_catalogue(tmp_path / "records.csv")
    rows = "\n".join(f"w{i},one_sided,{1.5 + 0.0001 * i:g},0.25" for i in range(3000))
    (tmp_path / "walls.csv").write_text(f"name,mechanism,height,thickness\n{rows}\n")
    (tmp_path / "case.nml").write_text(
        "&job task = 'typology', output = 'out/walls' /\n&population file = 'walls.csv' /\n"
        "&records catalogue = 'records.csv' /\n&stripes first = 0.05, last = 2, count = 40 /\n"
    )
    before, stop = sorted(os.listdir(tmp_path)), threading.Event()
    threading.Timer(0.3, stop.set).start()
    with pytest.raises(dd.errors.Interrupted) as caught:
        dd.run_case(tmp_path / "case.nml", progress=False, stop=stop)
    assert caught.value.partial is None or len(caught.value.partial.population) < 3000
    assert sorted(os.listdir(tmp_path)) == before
    with pytest.raises(dd.errors.InputError, match=r"stop: must be a threading\.Event, not int"):
        dd.run_case(tmp_path / "case.nml", progress=False, stop=1)
