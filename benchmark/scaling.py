"""Cost of dondolo against threads, walls, levels, and the length and sampling of records, and its memory.

The engine is the default one. Accelerograms are the embedded synthetic ones.
"""

import csv
import os
import re
import subprocess
import tempfile
import time
from dataclasses import asdict
from functools import partial
from pathlib import Path

import numpy as np
from cores import Cores
from problem import ROOT
from spread import NAMES, Spread

import dondolo as dd

CATALOGUE = ROOT / "data" / "records" / "synthetic44.csv"
LEVELS = np.linspace(0.05, 1.0, 20)
VARIANTS = ("baseline", "avx2", "avx512")[: ("baseline", "avx2", "avx512", "native").index(dd.Solver.variant()) + 1]
WALL = dd.OneSidedWall(height=3.0, thickness=0.25)


def walls(count):
    """Walls with heights from 2 to 4 m."""
    return [dd.OneSidedWall(height=float(h), thickness=0.25, name=f"w{i}") for i, h in enumerate(heights(count))]


def heights(count):
    """Heights, the middle one for a single wall."""
    return np.linspace(2.0, 4.0, count) if count > 1 else np.array([3.0])


def typology(executable, count, threads, folder, variant=None):
    """Seconds of the histories of a population, and the largest memory of the process [MiB]."""
    lines = ["name,mechanism,height,thickness", *(f"w{i},one_sided,{h},0.25" for i, h in enumerate(heights(count)))]
    environment = {"DONDOLO_VARIANT": variant} if variant else {}
    stripes = "&stripes first = 0.05 last = 1.0 count = 20 /"
    return run_population(executable, lines, stripes, threads, folder, environment)


def run_population(executable, lines, groups, threads, folder, environment=None, population=""):
    """Run the lines of a table of walls; groups of the case, more of &population, and variables of the environment.

    Returns the seconds of its histories, and the largest memory of the process [MiB].
    """
    table = Path(folder) / "population.csv"
    table.write_text("\n".join(lines) + "\n", encoding="utf-8")
    case = Path(folder) / "case.nml"
    case.write_text(
        f"&job task = 'typology' output = '{folder}/result' threads = {threads} /\n"
        f"&population file = '{table}' {population} /\n&records catalogue = '{CATALOGUE}' /\n{groups}\n",
        encoding="utf-8",
    )
    peak = 0.0
    streams = {"stdout": subprocess.PIPE, "stderr": subprocess.DEVNULL}
    with subprocess.Popen([executable, case], text=True, env=os.environ | (environment or {}), **streams) as process:
        while process.poll() is None:
            # Peak memory of the process itself; that of children in getrusage includes Python's own memory.
            held = re.search(r"VmHWM:\s+(\d+) kB", Path(f"/proc/{process.pid}/status").read_text())
            peak = int(held.group(1)) / 1024.0 if held else peak
            time.sleep(0.005)
        printed = process.stdout.read()
    return float(re.search(r"histories in +(\S+) s", printed).group(1)), peak


def row(kind, size, histories, values):
    """Row of the table: the spread of several values."""
    return {"kind": kind, "size": size, "histories": histories} | asdict(Spread.of(values))


def spread_of(row):
    """Spread of a row."""
    return Spread(*(row[name] for name in NAMES))


def threads(executable, repeats):
    """Measure strong scaling, with a fixed population, and weak scaling, with one that grows with the threads.

    The numbers of threads take turns; beside the seconds there are the efficiencies of each turn, relative to one
    thread in the same turn.
    """
    most = os.cpu_count()
    counts = sorted({*(2**k for k in range(20) if 2**k <= most), most})
    rows, cores = [], Cores()
    for kind, walls_of in (("strong", lambda n: 40 * most), ("weak", lambda n: 40 * n)):
        seconds = {n: [] for n in counts}
        for _ in range(repeats):
            for n in counts:
                with tempfile.TemporaryDirectory() as folder:
                    (taken, _), _ = cores.turn(partial(typology, executable, walls_of(n), n, folder), n)
                seconds[n].append(taken)
        for n in counts:
            share = walls_of(n) / walls_of(1) / n
            efficiency = [share * one / several for one, several in zip(seconds[1], seconds[n], strict=True)]
            rows.append(row(kind, n, 880 * walls_of(n), seconds[n]))
            rows.append(row(f"{kind} efficiency", n, 880 * walls_of(n), efficiency))
    return rows


def variants(executable, repeats):
    """Measure every build variant that this processor supports, on one thread, in turns.

    Beside the seconds there is the speed-up of each turn relative to the first variant.
    """
    seconds, cores = {name: [] for name in VARIANTS}, Cores()
    for _ in range(repeats):
        for name in VARIANTS:
            with tempfile.TemporaryDirectory() as folder:
                (taken, _), _ = cores.turn(partial(typology, executable, 16, 1, folder, name))
            seconds[name].append(taken)
    rows = []
    for place, name in enumerate(VARIANTS):
        gains = [slow / fast for slow, fast in zip(seconds[VARIANTS[0]], seconds[name], strict=True)]
        rows.append(row("variant", place, 880 * 16, seconds[name]))
        rows.append(row("variant speed-up", place, 880 * 16, gains))
    return rows


def memory(executable):
    """Measure peak memory against the number of histories."""
    rows = []
    for count in (1, 4, 16, 64, 256):
        with tempfile.TemporaryDirectory() as folder:
            _, peak = typology(executable, count, os.cpu_count(), folder)
        rows.append(row("memory", count, 880 * count, [peak]))
    return rows


def timed(several, records, levels, repeats):
    """Seconds of multiple stripe analyses of some walls on one thread, after a run that is not timed."""
    found = []
    for _ in range(repeats + 1):
        start = time.perf_counter()
        for wall in several:
            dd.multiple_stripe(wall, records, levels, threads=1, progress=False)
        found.append(time.perf_counter() - start)
    return found[1:]


def costs(repeats):
    """Measure time against number of walls, number of levels, length and time step of the records."""
    records = dd.read_catalogue(CATALOGUE)
    rows, cores = [], Cores()

    def add(kind, size, walls_of, records_of, levels):
        seconds, _ = cores.turn(partial(timed, walls_of, records_of, levels, repeats))
        rows.append(row(kind, size, len(walls_of) * len(records_of) * len(levels), seconds))

    for count in (1, 2, 4, 8):
        add("walls", count, walls(count), records, LEVELS)
    for count in (6, 11, 22, 44):
        add("records", count, [WALL], records[:count], LEVELS)
    for count in (5, 10, 20, 40, 80):
        add("levels", count, [WALL], records, np.linspace(0.05, 1.0, count))
    for times in (1, 2, 4, 8):
        # The same motion repeated: a record of several shocks
        longer = [dd.Record(np.tile(r.acceleration, times), r.dt, name=r.name) for r in records]
        add("shocks", times, [WALL], longer, LEVELS)
    for parts in (1, 2, 4, 8):
        # Linear interpolation, like the record itself: the same input, and the same motion
        finer = [dd.Record(refined(r.acceleration, parts), r.dt / parts, name=r.name) for r in records]
        add("samples", parts, [WALL], finer, LEVELS)
    return rows


def refined(acceleration, parts):
    """Refine samples by linear interpolation."""
    places = np.arange(parts * (len(acceleration) - 1) + 1) / parts
    return np.interp(places, np.arange(len(acceleration)), acceleration)


def measure(executable, repeats):
    """Measure everything: rows of kind, size, histories, and spread [s, or MiB for memory]."""
    return threads(executable, repeats) + variants(executable, repeats) + costs(repeats) + memory(executable)


def write_scaling(path, rows):
    """Write a table of what `measure` found."""
    with open(path, "w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, ["kind", "size", "histories", *NAMES])
        writer.writeheader()
        writer.writerows(rows)


def read_scaling(path):
    """Read a table of what `measure` found."""
    numbers = ("size", "histories", *NAMES)
    with open(path, newline="", encoding="utf-8") as file:
        return [row | {name: float(row[name]) for name in numbers} for row in csv.DictReader(file)]
