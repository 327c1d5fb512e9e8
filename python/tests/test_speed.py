"""Guards of the speed that do not depend on the machine's mood: counts, and ratios of times taken side by side."""

import contextlib
import re
import statistics
import subprocess
import sys
import time

import matplotlib
import matplotlib.pyplot as plt
import numpy as np
import pytest
from costs import calls, growth

import dondolo as dd
from dondolo._fortran import _core

pytestmark = pytest.mark.slow

matplotlib.use("agg")

LEVELS = np.linspace(0.1, 1.2, 12)


def timed(wall, records, engine):
    """CPU time of the stripes of a wall, on this thread [s]."""
    start = time.thread_time()
    dd.multiple_stripe(wall, records, LEVELS, solver=dd.Solver(engine=engine), threads=1, progress=False)
    return time.thread_time() - start


def test_work(wall, records):
    """Nothing is computed that the motion does not need: about one step for each interval in which a wall rocks."""
    work = dd.multiple_stripe(wall, records, LEVELS, progress=False).work
    # Impacts, peaks and starts end steps early.
    assert work.rocked <= work.steps <= 1.10 * work.rocked + 3 * work.impacts
    assert work.evaluations <= 1.01 * work.steps
    still = dd.multiple_stripe(wall, records, LEVELS * 1e-3, progress=False).work
    assert still.still == still.histories
    assert still.steps == still.evaluations == still.rocked == 0


def test_lanes_outrun_rk45(wall, records):
    """Twelve times as fast with AVX-512, nine with AVX2, four and a half without; six tenths of that are asked for."""
    ratios = []
    for _ in range(5):
        slow, fast = timed(wall, records, "rk45"), timed(wall, records, "lanes")
        ratios.append(slow / fast)
    least = {"avx512": 7.0, "avx2": 5.5}.get(dd.Solver.variant(), 2.7)
    assert statistics.median(ratios) > least, ratios


def test_a_call_costs_little_beside_its_histories(wall, records, replace_procedure):
    """A twenty-seventh of their time; half as much again is allowed.

    CPU time of the thread, in which other programs have no part. They and the histories empty caches, too: so the calls
    that are timed get the result of histories that ran before, and the least of many of them counts.
    """
    levels = np.linspace(0.05, 1.0, 20)
    inside, results = [], []
    run_block = _core.stripes.run_block

    def stripes():
        dd.multiple_stripe(wall, records, levels, threads=1, progress=False)

    def timed_block(*given):
        start = time.thread_time()
        results.append(run_block(*given))
        inside.append(time.thread_time() - start)
        return results[-1]

    replace_procedure("stripes.run_block", timed_block)
    for _ in range(60):
        stripes()
    # All histories of a call are one block.
    assert len(inside) == 60
    replace_procedure("stripes.run_block", lambda *given: results[-1])
    outside = []
    for _ in range(600):
        start = time.thread_time()
        stripes()
        outside.append(time.thread_time() - start)
    assert min(outside) < 0.055 * min(inside)


def test_a_call_does_little_besides_its_histories(wall, records):
    """About 420 calls of functions, whatever the number of its records and levels; a tenth more is allowed."""

    def stripes(some, levels):
        dd.multiple_stripe(wall, some, levels, threads=1, progress=False)

    counts = []
    for some, number in ((dd.RecordSet(records), 20), (dd.RecordSet(records[:5]), 3)):
        levels = np.linspace(0.2, 1.0, number)
        # The first call of all keeps what later ones use.
        stripes(some, levels)
        counts.append(calls(lambda some=some, levels=levels: stripes(some, levels)))
    assert counts[0] == counts[1] < 465, counts


def tied(*heights):
    """A facade with ties at some heights."""
    return dd.OneSidedWall(9.0, 0.5, ties=[dd.Tie(height, area=5e-5, length=8.0) for height in heights])


# How many times as long as the bare facade each may take; about three quarters of it are measured.
RESTRAINED = {
    "friction": (
        dd.OneSidedWall(9.0, 0.5, interlock=dd.Interlock(overlap=0.12, course=0.1, thickness=0.5, spacing=5.0)),
        2.0,
    ),
    "one tie": (tied(8.5), 2.5),
    "three ties": (tied(8.5, 5.5, 2.5), 4.0),
    "moving supports": (
        dd.OneSidedWall(9.0, 0.5, building=dd.Building(0.3, storeys=3, level=0.0, building_height=9.0)),
        3.6,
    ),
}


@pytest.mark.parametrize("kind", RESTRAINED)
def test_what_restrains_a_wall_costs_little_beside_it(kind, records):
    """CPU time of the thread, in turns with that of the bare facade."""
    wall, most = RESTRAINED[kind]
    timed(wall, records, "lanes")
    ratios = []
    for _ in range(9):
        bare = timed(tied(), records, "lanes")
        ratios.append(timed(wall, records, "lanes") / bare)
    assert statistics.median(ratios) < most, ratios


def test_a_call_without_motion_costs_little(wall, records):
    """With what it needs in the caches a call takes a twenty-fifth of the time of one whose histories move.

    The least of many calls, since other programs empty the caches.
    """
    levels = np.linspace(0.05, 1.0, 20)
    seconds = {1e-3: [], 1.0: []}
    for _ in range(20):
        # Calls of one kind follow one another; more of those that are short.
        for factor, several in ((1e-3, 30), (1.0, 3)):
            for _ in range(several):
                start = time.thread_time()
                stripes = dd.multiple_stripe(wall, records, levels * factor, threads=1, progress=False)
                seconds[factor].append(time.thread_time() - start)
            assert stripes.edp.any() == (factor == 1.0)
    assert min(seconds[1e-3]) < 0.05 * min(seconds[1.0])


def test_a_report_costs_little_more_than_its_figures(stripes, tmp_path):
    """Four to five times the CPU time of one figure, of which it has four; half as much again is allowed."""
    curve = stripes.fit()

    def figure():
        ax = curve.plot()
        ax.figure.savefig(tmp_path / "curve.svg")
        plt.close(ax.figure)

    seconds = {figure: [], lambda: dd.report(stripes, tmp_path / "report.html"): []}
    for _ in range(5):
        for work, several in seconds.items():
            start = time.process_time()
            work()
            several.append(time.process_time() - start)
    alone, report = map(min, seconds.values())
    assert report < 7.0 * alone, seconds


def test_a_call_costs_the_same_for_many_records(wall, records):
    """Instructions of Python, which are the same on any machine."""
    counts = []
    for several in (records, records[:2]):
        # The second call: in the first they are uploaded.
        for _ in range(2):
            count = 0

            def step(frame, event, _):
                nonlocal count
                frame.f_trace_opcodes = True
                count += event == "opcode"
                return step

            sys.settrace(step)
            try:
                dd.multiple_stripe(wall, several, LEVELS, threads=1, progress=False)
            finally:
                sys.settrace(None)
        counts.append(count)
    assert 0 < counts[0] < 1.05 * counts[1]


def test_arithmetic(executable):
    """The engine's operations a second against those of a loop of multiplications and additions in the same run."""
    bound = {"avx512": 45.0, "avx2": 35.0}.get(dd.Solver.variant(), 15.0)
    # Other programs slow the engine more than the loop: the best of three.
    for _ in range(3):
        printed = subprocess.run([executable, "--benchmark", "0.2", "--threads", "1"], capture_output=True, text=True)
        percent = float(re.search(r"operations a second, +(\S+) %", printed.stdout).group(1))
        if percent > bound:
            return
    pytest.fail(printed.stdout)


def case(folder, levels="0.1", title="", job="", groups=""):
    """A case of one wall."""
    path = folder / "case.nml"
    path.write_text(
        f"&job title = '{title}' {job} /\n&wall mechanism = 'one_sided' height = 3 thickness = 0.25 /\n"
        f"&records catalogue = 'records.csv' /\n&stripes levels = {levels} /\n{groups}"
    )
    return path


INPUTS = {
    "levels": lambda folder, n: case(folder, levels=",\n".join(str(1 + i) for i in range(n))),
    "groups": lambda folder, n: case(folder, groups="".join(f"&g{i} a = 1 /\n" for i in range(n))),
    "variables": lambda folder, n: case(folder, job=" ".join(f"v{i} = 1" for i in range(n))),
    "title": lambda folder, n: case(folder, title="x''" * 15 * n),
}


def read_anyway(path):
    """Read a case that may be refused in the end."""
    with contextlib.suppress(dd.errors.InputError):
        dd.read_case(path)


@pytest.mark.parametrize("what", INPUTS)
def test_large_cases_cost_what_they_are_long(what, tmp_path):
    """Eight times the size costs about eight times as much, and not 64 times."""
    folders = {n: tmp_path / str(n) for n in (1500, 12_000)}
    for n, folder in folders.items():
        folder.mkdir()
        (folder / "records.csv").write_text("file,dt_s,units\nr.txt,0.01,m/s2\n")
        (folder / "r.txt").write_text("0.0\n1.0\n")
        folders[n] = INPUTS[what](folder, n)
    assert growth(lambda n: read_anyway(folders[n]), *folders) < 24.0


def test_large_catalogues_cost_what_they_are_long(tmp_path):
    (tmp_path / "r.txt").write_text("0.0\n1.0\n")
    sizes = (500, 4000)
    for n in sizes:
        rows = "".join(f"r.txt,0.01,m/s2,a record with a long name {i}\n" for i in range(n))
        (tmp_path / f"{n}.csv").write_text("file,dt_s,units,name\n" + rows)
    assert growth(lambda n: dd.read_catalogue(tmp_path / f"{n}.csv"), *sizes) < 24.0
