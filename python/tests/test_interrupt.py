"""Ctrl-C in the middle of one history that would take minutes."""

import signal
import subprocess
import sys
import time

import numpy as np
import pytest

import dondolo as dd

# Kicks of the ground start chains of bounces that hardly lose speed: some 40 000 impacts each second of the record
PROGRAM = """
import os, signal, sys, threading
import numpy as np
import dondolo as dd

signal.signal(signal.SIGINT, signal.default_int_handler)
wall = dd.OneSidedWall(3.0, 0.25, restitution="constant", restitution_value=0.99999)
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
    except (KeyboardInterrupt, dd.Interrupted):
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
        "restitution = 'constant' restitution_value = 0.99999 /\n"
        "&records catalogue = 'records.csv' /\n&history record = 1 /\n&solver engine = 'rk45' /\n"
    )
    run = subprocess.Popen(
        [executable, "case.nml"], cwd=tmp_path, preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL)
    )
    time.sleep(1.0)
    run.send_signal(signal.SIGINT)
    assert run.wait(60) == -signal.SIGINT
    assert not (tmp_path / "out").exists()
