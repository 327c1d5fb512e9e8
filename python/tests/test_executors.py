"""Blocks of walls by executors: pools of threads and processes, Dask, MPI."""

import importlib.util
import multiprocessing
import os
import re
import shutil
import signal
import socket
import subprocess
import sys
import time
from concurrent.futures import Executor, Future, ProcessPoolExecutor, ThreadPoolExecutor
from pathlib import Path

import numpy as np
import pytest
import study

import dondolo as dd
from dondolo.populations import blocks, crew

pytestmark = [pytest.mark.slow, pytest.mark.filterwarnings("ignore::dondolo.errors.DondoloWarning")]

SPAWN = multiprocessing.get_context("spawn")


@pytest.fixture(scope="module")
def whole(tmp_path_factory):
    """The results without an executor."""
    folder = tmp_path_factory.mktemp("whole")
    study.write(dd.typology(**study.arguments()), folder)
    return study.contents(folder)


@pytest.fixture
def crews(monkeypatch):
    """The crews that were at work, for how often they sent the records."""
    there = []

    class Watched(crew.Crew):
        def __init__(self, *given):
            super().__init__(*given)
            there.append(self)

    monkeypatch.setattr(crew, "Crew", Watched)
    return there


def of(result, folder):
    study.write(result, folder)
    return study.contents(folder)


class Disturbed(Executor):
    """Another executor, and something that happens before its task of a given number."""

    def __init__(self, executor, number, action):
        self.executor, self.number, self.action = executor, number, action

    def submit(self, *given):
        self.number -= 1
        if self.number == 0:
            self.action()
        return self.executor.submit(*given)


class Machines(Executor):
    """Workers on several machines, in this process and in a fixed order.

    Tasks go round the machines. One that brings the records goes to the first machine that has said that it lacks them,
    as it would to a worker that answers at once while the others compute.
    """

    def __init__(self, count, monkeypatch):
        self.memories = [{} for _ in range(count)]
        self.turn = 0
        self.lacking = []
        self.sizes = []
        self.monkeypatch = monkeypatch

    def submit(self, work, head, block, parcel):
        self.sizes.append(len(block))
        if parcel is None:
            machine = self.turn % len(self.memories)
            self.turn += 1
        else:
            machine = self.lacking.pop(0)
        self.monkeypatch.setattr(crew, "_shared", self.memories[machine])
        self.monkeypatch.setattr(socket, "gethostname", lambda: f"machine {machine}")
        future = Future()
        future.set_result(work(head, block, parcel))
        if future.result().part is None and machine not in self.lacking:
            self.lacking.append(machine)
        return future


@pytest.mark.parametrize("machines", [1, 2, 5, 12])
def test_every_worker_gets_the_records_once(whole, tmp_path, crews, monkeypatch, machines):
    executor = Machines(machines, monkeypatch)
    assert of(dd.typology(**study.arguments(executor=executor, block=1)), tmp_path / "out") == whole
    assert crews[0].sends == machines
    # What goes with each block is small.
    assert max(executor.sizes) < 2000
    # They keep the records, and a worker that has begun anew gets them again.
    executor.memories[machines // 2].clear()
    assert of(dd.typology(**study.arguments(executor=executor, block=1)), tmp_path / "again") == whole
    assert crews[1].sends == 1


def test_no_two_tasks_are_the_same(monkeypatch):
    """Dask gives the old answer where the same is asked for again."""
    asked = []

    class Listening(ThreadPoolExecutor):
        def submit(self, *given):
            asked.append(given)
            return super().submit(*given)

    monkeypatch.setattr(crew, "_shared", {})
    with Listening(1) as executor:
        dd.typology(**study.arguments(executor=executor, block=1))
    # Some were missed and sent again.
    assert len(set(asked)) == len(asked) > 60


def test_threads(whole, tmp_path, crews):
    with ThreadPoolExecutor(3) as executor:
        assert of(dd.typology(**study.arguments(executor=executor, block=2)), tmp_path / "out") == whole
    assert crews[0].sends <= 3


@pytest.fixture(scope="module")
def pool():
    """Two processes."""
    with ProcessPoolExecutor(2, mp_context=SPAWN) as executor:
        yield executor


def test_processes(whole, tmp_path, crews, pool):
    assert of(dd.typology(**study.arguments(executor=pool, block=1)), tmp_path / "one") == whole
    assert 1 <= crews[0].sends <= 4
    assert of(dd.typology(**study.arguments(executor=pool)), tmp_path / "own") == whole
    assert crews[1].sends <= 1
    # At least four blocks a worker
    assert next(crews[1]._numbers) >= 8


def test_few_tasks_are_in_flight(pool, crews):
    most = []

    class Counting(Executor):
        def submit(self, *given):
            most.append(len(crews[0]._flying))
            return pool.submit(*given)

    dd.typology(**study.arguments(executor=Counting(), block=1))
    assert len(most) >= 60
    assert max(most) < 20


def test_ctrl_c(whole, tmp_path, pool):
    path = tmp_path / "study.counts"
    with pytest.raises(dd.errors.Interrupted, match=r"interrupted: \d+ of 60 walls are complete") as caught:
        dd.typology(**study.arguments(executor=Disturbed(pool, 20, stop), block=1, checkpoint=path))
    assert 5 < len(caught.value.partial.walls) < 20
    result = dd.typology(**study.arguments(executor=pool, block=1, checkpoint=path))
    assert of(result, tmp_path / "out") == whole


def stop():
    """Ctrl-C."""
    raise KeyboardInterrupt


def test_a_broken_pool(whole, tmp_path):
    path = tmp_path / "study.counts"

    def kill():
        for process in list(executor._processes):
            os.kill(process, signal.SIGKILL)
        # Python before 3.11.5 can wait forever to send a task to a killed process (python/cpython issue 94777),
        # unless the pipe is closed. Later ones close it.
        if sys.version_info < (3, 11, 5):
            executor._call_queue._reader.close()

    sentence = r"executor: BrokenProcessPool: .*; \d+ of 60 rows are complete, "
    with ProcessPoolExecutor(2, mp_context=SPAWN) as executor:
        disturbed = Disturbed(executor, 20, kill)
        with pytest.raises(dd.errors.DondoloError, match=sentence + "the same call resumes from there"):
            dd.typology(**study.arguments(executor=disturbed, block=1, checkpoint=path))
        with pytest.raises(
            dd.errors.DondoloError, match=r"executor: BrokenProcessPool.*; 0 of 60 .*, a checkpoint would"
        ):
            dd.typology(**study.arguments(executor=executor))
    assert of(dd.typology(**study.arguments(checkpoint=path)), tmp_path / "out") == whole


def test_errors(pool, monkeypatch):
    with pytest.raises(dd.errors.InputError, match=r"executor: must be an executor of concurrent\.futures, not str"):
        dd.typology(**study.arguments(executor="dask"))
    # Workers whose results would differ
    build = crew._build()
    monkeypatch.setattr(crew, "build_variant", lambda: "z80")
    with pytest.raises(
        dd.errors.InputError, match=rf"worker \S+: has {build} and not dondolo .*, z80; .*DONDOLO_VARIANT"
    ):
        dd.typology(**study.arguments(executor=pool))


@pytest.fixture(scope="module")
def cluster():
    """Two processes of Dask, which sets variables of the environment for its workers and leaves them set."""
    environment = dict(os.environ)
    distributed = pytest.importorskip("distributed", reason="needs Dask: pip install distributed")
    with (
        distributed.LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=":0") as there,
        distributed.Client(there) as client,
    ):
        yield client
    os.environ.clear()
    os.environ.update(environment)


def test_dask(whole, tmp_path, crews, cluster):
    executor = cluster.get_executor()
    # Blocks that take longer than a message
    dd.typology(**study.arguments(executor=executor, block=1, solver=dd.Solver(engine="rk45")))
    assert 1 <= crews[0].sends <= 4
    dd.typology(**study.arguments(executor=executor, block=2, solver=dd.Solver(engine="rk45")))
    assert crews[1].sends <= 1
    assert of(dd.typology(**study.arguments(executor=executor, block=1)), tmp_path / "one") == whole
    assert of(dd.typology(**study.arguments(executor=executor)), tmp_path / "own") == whole


def test_a_worker_of_dask_is_killed(whole, tmp_path, crews, cluster):
    workers = list(cluster.run(os.getpid).values())
    killed = []

    def kill():
        killed.append(workers[0])
        os.kill(workers[0], signal.SIGKILL)

    executor = Disturbed(cluster.get_executor(), 20, kill)
    assert of(dd.typology(**study.arguments(executor=executor, block=1)), tmp_path / "out") == whole
    assert killed
    # Its nanny starts another one.
    end = time.monotonic() + 30.0
    while len(now := set(cluster.run(os.getpid).values())) < 2 and time.monotonic() < end:
        time.sleep(0.1)
    assert workers[0] not in now
    assert of(dd.typology(**study.arguments(executor=cluster.get_executor(), block=1)), tmp_path / "again") == whole


MPI = """
import os, signal, sys, time, warnings
from pathlib import Path
from mpi4py.futures import MPIPoolExecutor
import dondolo as dd, study
from dondolo.populations import blocks, crew
warnings.simplefilter("ignore")
def lose(worker):
    os.kill(worker, signal.SIGKILL)
    # Nothing more is taken in until MPI ends this process too.
    time.sleep(60)
class Watched(crew.Crew):
    def __exit__(self, *given):
        print("sends", self.sends, flush=True)
crew.Crew = Watched
if __name__ == "__main__":
    folder, checkpoint, after = Path(sys.argv[1]), sys.argv[2], int(sys.argv[3])
    with MPIPoolExecutor() as executor:
        if after:
            workers = {executor.submit(os.getpid).result() for _ in range(20)}
            from test_executors import Disturbed
            executor = Disturbed(executor, after, lambda: lose(workers.pop()))
        study.write(dd.typology(**study.arguments(executor=executor, block=1, checkpoint=checkpoint)), folder)
"""


@pytest.fixture(scope="module")
def mpiexec():
    """Runs a script on one process that asks and two that work."""
    if importlib.util.find_spec("mpi4py") is None:
        pytest.skip("needs MPI: pip install mpi4py mpich")
    command = shutil.which("mpiexec", path=os.pathsep.join([str(Path(sys.executable).parent), os.environ["PATH"]]))
    if command is None:
        pytest.skip("no mpiexec: pip install mpich")
    version = subprocess.run([sys.executable, "-c", "from mpi4py import MPI"], capture_output=True, text=True)
    if version.returncode:
        pytest.skip(f"mpi4py does not work here: {version.stderr.splitlines()[-1]}")

    def call(folder, *arguments):
        script = folder / "script.py"
        script.write_text(MPI)
        line = [command, "-n", "3", sys.executable, "-m", "mpi4py.futures", str(script), *map(str, arguments)]
        environment = os.environ | {"PYTHONPATH": str(Path(__file__).parent)}
        return subprocess.run(line, cwd=folder, env=environment, capture_output=True, text=True, timeout=120)

    return call


def test_mpi(whole, tmp_path, mpiexec):
    result = mpiexec(tmp_path, tmp_path / "out", tmp_path / "study.counts", 0)
    assert result.returncode == 0, result.stderr
    assert study.contents(tmp_path / "out") == whole
    # MPI may print lines of its own.
    assert int(re.search(r"^sends (\d+)$", result.stdout, re.M).group(1)) <= 4


def test_a_process_of_mpi_is_killed(whole, tmp_path, mpiexec):
    """MPI ends the whole run; the checkpoint is there."""
    path = tmp_path / "study.counts"
    assert mpiexec(tmp_path, tmp_path / "out", path, 20).returncode != 0
    assert not (tmp_path / "out").exists()
    assert path.exists()
    calls = []
    run = blocks.Shared.run
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(blocks.Shared, "run", lambda *given: calls.append(given[1]) or run(*given))
        result = dd.typology(**study.arguments(checkpoint=path, block=1))
    assert 30 < len(calls) < 60
    assert of(result, tmp_path / "out") == whole
    assert np.all(result.histories > 0)
