"""Guards of the speed that do not depend on the machine's mood: counts, and ratios of times taken side by side."""

import re
import statistics
import subprocess
import time

import numpy as np

import dondolo as dd

LEVELS = np.linspace(0.1, 1.2, 12)


def timed(wall, records, engine):
    """Seconds of the stripes of a wall on one thread."""
    start = time.perf_counter()
    dd.multiple_stripe(wall, records, LEVELS, engine=engine, threads=1, progress=False)
    return time.perf_counter() - start


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
    """Fourteen times as fast with AVX-512, eight with AVX2, four without; a third of that is asked for."""
    ratios = []
    for _ in range(5):
        slow, fast = timed(wall, records, "rk45"), timed(wall, records, "lanes")
        ratios.append(slow / fast)
    least = {"avx512": 4.0, "avx2": 2.5}.get(dd.build_variant(), 1.2)
    assert statistics.median(ratios) > least, ratios


def test_arithmetic(executable):
    """The engine's operations a second against those of a loop of multiplications and additions in the same run."""
    printed = subprocess.run([executable, "--benchmark", "0.2", "--threads", "1"], capture_output=True, text=True)
    percent = float(re.search(r"operations a second, +(\S+) %", printed.stdout).group(1))
    assert percent > (25.0 if dd.build_variant().startswith("avx") else 8.0), printed.stdout
