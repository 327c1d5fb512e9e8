"""Several threads at once, and processes made by a fork."""

import itertools
import multiprocessing
import os
import subprocess
import sys
import threading

import pytest

import dondolo as dd

FORK = """
import multiprocessing, sys
import numpy as np
import dondolo as dd

wall = dd.OneSidedWall(3.0, 0.25)
records = [dd.Record(3.0 * np.sin(0.05 * i * np.arange(400)), 0.01, f"r{i}") for i in (1, 2, 3)]

def run(threads):
    stripes = dd.multiple_stripe(wall, records, [0.2, 0.4, 0.6], im="sa(0.5)", threads=threads, progress=False)
    return stripes.edp.tobytes(), dd.fit_fragility([1.0, 2.0, 3.0], [1, 2, 3], [4, 4, 4]).theta

here = run(2)
with multiprocessing.get_context("fork").Pool(2) as pool:
    assert set(pool.map_async(run, [0, 1, 2, 4]).get(60)) == {here}
"""


IDLE = """
import os, time
import numpy as np
import dondolo as dd

wall = dd.OneSidedWall(3.0, 0.25)
records = [dd.Record(3.0 * np.sin(0.05 * i * np.arange(400)), 0.01, f"r{i}") for i in range(1, 9)]
spent = 0.0
for _ in range(20):
    dd.multiple_stripe(wall, records, [0.2, 0.4, 0.6], threads=2, progress=False)
    start = time.process_time()
    time.sleep(0.03)
    spent += time.process_time() - start
print(spent, os.environ.get("OMP_WAIT_POLICY"))
"""


def failures(wall, record, k):
    """What says what is wrong with several things, each with a number of its own."""
    small, large = 10.0**-k, 10.0**k
    return [
        lambda: dd.Record([0.0, 1.0], -small),
        lambda: dd.Record([0.0, 1e5 * large], 0.01),
        lambda: wall.terms(1000.0 + small),
        lambda: dd.simulate(wall, record, solver=dd.Solver(rtol=large)),
        lambda: dd.simulate(wall, record, solver=dd.Solver(engine="x" * k)),
        lambda: dd.multiple_stripe(wall, [record], [large], im="pgd" + k * "x"),
        lambda: dd.fit_fragility([1.0, 2.0], [large, 1], [2, 2]),
    ]


def sentence(call):
    try:
        call()
    except dd.errors.InputError as error:
        return str(error)
    return "no error"


def test_threads_sleep_between_calls():
    """They do not spin for 20 ms after each, as those of gfortran do by default; programs started later may choose."""
    environment = {
        name: value for name, value in os.environ.items() if name not in ("OMP_WAIT_POLICY", "GOMP_SPINCOUNT")
    }
    printed = subprocess.run([sys.executable, "-c", IDLE], capture_output=True, text=True, check=True, env=environment)
    spent, policy = printed.stdout.split()
    assert float(spent) < 0.05
    assert policy == "None"


def test_sentences_of_threads_are_whole(wall, sine):
    """Threads that fail at the same time each get the sentence that one alone gets.

    DONDOLO_SENTENCES is the number of sentences, here and in test/test_sentences.f90, where no Python stands between.
    """
    threads = 8
    each = int(os.environ.get("DONDOLO_SENTENCES", "20000")) // threads
    calls = [call for k in range(1, 10) for call in failures(wall, sine, k)]
    right = [sentence(call) for call in calls]
    assert "no error" not in right
    wrong = []

    def fail_often(start):
        for i in itertools.islice(itertools.cycle(range(len(calls))), start, start + each):
            text = sentence(calls[i])
            if text != right[i]:
                wrong.append(text)

    interval = sys.getswitchinterval()
    sys.setswitchinterval(1e-5)
    try:
        threads = [threading.Thread(target=fail_often, args=(7 * k,)) for k in range(threads)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
    finally:
        sys.setswitchinterval(interval)
    assert not wrong, wrong[:3]


def test_a_fork_after_a_run_does_not_hang():
    """OpenMP's threads do not survive a fork: the children work alone, and give the same bits."""
    if "fork" not in multiprocessing.get_all_start_methods():
        return
    done = subprocess.run([sys.executable, "-W", "ignore", "-c", FORK], capture_output=True, text=True, timeout=100)
    assert done.returncode == 0, done.stderr


def test_threads_are_those_that_the_process_may_use():
    """OMP_NUM_THREADS and the affinity, both of which OpenMP heeds."""
    program = "from dondolo._fortran.library import available_threads; print(available_threads())"
    free = {what: value for what, value in os.environ.items() if not what.startswith(("OMP_", "GOMP_"))}
    one = min(os.sched_getaffinity(0))
    for more, expected in (({}, 1), ({"OMP_NUM_THREADS": "3"}, 3)):
        run = subprocess.run(
            [sys.executable, "-c", f"import os; os.sched_setaffinity(0, {{{one}}})\n{program}"],
            env=free | more,
            capture_output=True,
            text=True,
            check=True,
        )
        assert int(run.stdout) == expected


SMALL_STACKS = """
import numpy as np
import dondolo as dd

records = [dd.Record(3.0 * np.sin(0.05 * i * np.arange(400)), 0.01, f"r{i}") for i in range(1, 9)]
tie = dd.Tie(2.0, depth=0.25, area=5e-6, length=2.0)
for wall in dd.OneSidedWall(3.0, 0.25), dd.OneSidedWall(3.0, 0.25, ties=[tie]), dd.TwoBlockWall(3.0, 0.25):
    for engine in "lanes", "rk45":
        dd.multiple_stripe(wall, records, [0.2, 0.4], threads=4, progress=False, solver=dd.Solver(engine=engine))
    dd.simulate(wall, records[0])
dd.typology([dd.OneSidedWall(h, 0.25) for h in (2.0, 3.0, 4.0)], records, [0.2, 0.4], threads=3, progress=False)
dd.multiple_stripe(wall, records, [0.2, 0.4], threads=3, certify=True, progress=False)
"""


@pytest.mark.parametrize("stack", ["64K", "128K", "256K"])
def test_small_stacks_of_threads_in_python(stack):
    """128 KiB are what threads have with musl, and anybody can set less."""
    done = subprocess.run(
        [sys.executable, "-W", "ignore", "-c", SMALL_STACKS],
        env=os.environ | {"OMP_STACKSIZE": stack},
        capture_output=True,
        text=True,
    )
    assert done.returncode == 0, (done.returncode, done.stderr)


@pytest.mark.parametrize("stack", ["64", "128", "256"])
@pytest.mark.parametrize("name", ["parapet", "two_block", "tied_facade", "history"])
def test_small_stacks_of_the_executable(executable, root, tmp_path, stack, name):
    """That of the process too, by `ulimit -s`."""
    shell = f"ulimit -s {stack} && exec '{executable}' --threads 4 '{root}/data/cases/{name}.nml'"
    done = subprocess.run(
        ["bash", "-c", shell],
        cwd=tmp_path,
        env=os.environ | {"OMP_STACKSIZE": f"{stack}K"},
        capture_output=True,
        text=True,
    )
    assert done.returncode == 0, (done.returncode, done.stderr)
    assert (tmp_path / f"out/{name}_run.json").is_file()


@pytest.mark.parametrize("limit", [1, 2])
def test_printed_threads_are_those_that_ran(executable, root, tmp_path, limit):
    """OpenMP gives fewer than are asked for where OMP_THREAD_LIMIT says so."""
    done = subprocess.run(
        [executable, "--threads", "6", root / "data/cases/parapet.nml"],
        cwd=tmp_path,
        env=os.environ | {"OMP_THREAD_LIMIT": str(limit)},
        capture_output=True,
        text=True,
    )
    assert f"a second on {limit} thread" in done.stdout, done.stdout
