"""Cost of dondolo against threads, walls, levels, and the length and sampling of records, and its memory.

The engine is the default one. Accelerograms are the embedded synthetic ones.
"""

import csv
import os
import re
import statistics
import subprocess
import tempfile
import time
from pathlib import Path

import numpy as np
from problem import ROOT
from programs import say

import dondolo as dd

CATALOGUE = ROOT / "data" / "records" / "synthetic44.csv"
LEVELS = np.linspace(0.05, 1.0, 20)
VARIANTS = ("baseline", "avx2", "avx512")[: ("baseline", "avx2", "avx512", "native").index(dd.build_variant()) + 1]
WALL = dd.OneSidedWall(height=3.0, thickness=0.25)


def walls(count):
    """Walls with heights from 2 to 4 m."""
    return [dd.OneSidedWall(height=float(h), thickness=0.25, name=f"w{i}") for i, h in enumerate(heights(count))]


def heights(count):
    """Heights, the middle one for a single wall."""
    return np.linspace(2.0, 4.0, count) if count > 1 else np.array([3.0])


def typology(executable, count, threads, folder, variant=None):
    """Seconds of the histories of a population, and the largest memory of the process [MiB]."""
    population = Path(folder) / "population.csv"
    lines = ["name,mechanism,height,thickness", *(f"w{i},one_sided,{h},0.25" for i, h in enumerate(heights(count)))]
    population.write_text("\n".join(lines) + "\n", encoding="utf-8")
    case = Path(folder) / "case.nml"
    case.write_text(
        f"&job task = 'typology' output = '{folder}/result' threads = {threads} /\n"
        f"&population file = '{population}' /\n&records catalogue = '{CATALOGUE}' /\n"
        f"&stripes first = 0.05 last = 1.0 count = 20 /\n",
        encoding="utf-8",
    )
    peak = 0.0
    environment = os.environ | ({"DONDOLO_VARIANT": variant} if variant else {})
    streams = {"stdout": subprocess.PIPE, "stderr": subprocess.DEVNULL}
    with subprocess.Popen([executable, case], text=True, env=environment, **streams) as process:
        while process.poll() is None:
            # Peak memory of the process itself; that of children in getrusage includes Python's own memory.
            held = re.search(r"VmHWM:\s+(\d+) kB", Path(f"/proc/{process.pid}/status").read_text())
            peak = int(held.group(1)) / 1024.0 if held else peak
            time.sleep(0.005)
        printed = process.stdout.read()
    return float(re.search(r"histories in +(\S+) s", printed).group(1)), peak


def threads(executable, repeats):
    """Measure strong scaling, with a fixed population, and weak scaling, with one that grows with the threads."""
    cores = os.cpu_count()
    counts = sorted({*(2**k for k in range(20) if 2**k <= cores), cores})
    rows = []
    for kind, walls_of in (("strong", lambda n: 40 * cores), ("weak", lambda n: 40 * n)):
        for n in counts:
            with tempfile.TemporaryDirectory() as folder:
                seconds = [typology(executable, walls_of(n), n, folder)[0] for _ in range(repeats)]
            rows.append({"kind": kind, "size": n, "histories": 880 * walls_of(n), "value": statistics.median(seconds)})
        say(f"threads, {kind}: {counts}")
    return rows


def memory(executable):
    """Measure peak memory against the number of histories."""
    rows = []
    for count in (1, 4, 16, 64, 256):
        with tempfile.TemporaryDirectory() as folder:
            _, peak = typology(executable, count, os.cpu_count(), folder)
        rows.append({"kind": "memory", "size": count, "histories": 880 * count, "value": peak})
    say("memory")
    return rows


def variants(executable, repeats):
    """Measure every build variant that this processor supports, on one thread."""
    rows = []
    for place, name in enumerate(VARIANTS):
        with tempfile.TemporaryDirectory() as folder:
            seconds = [typology(executable, 16, 1, folder, name)[0] for _ in range(repeats)]
        rows.append({"kind": "variant", "size": place, "histories": 880 * 16, "value": statistics.median(seconds)})
    say("build variants")
    return rows


def timed(wall, records, levels, repeats):
    """Seconds of a multiple stripe analysis on one thread."""
    found = []
    for _ in range(repeats):
        start = time.perf_counter()
        dd.multiple_stripe(wall, records, levels, threads=1, progress=False)
        found.append(time.perf_counter() - start)
    return statistics.median(found)


def costs(repeats):
    """Measure time against number of walls, number of levels, length and time step of the records."""
    records = dd.read_catalogue(CATALOGUE)
    rows = []

    def add(kind, size, histories, seconds):
        rows.append({"kind": kind, "size": size, "histories": histories, "value": seconds})

    for count in (1, 2, 4, 8):
        seconds = sum(timed(wall, records, LEVELS, repeats) for wall in walls(count))
        add("walls", count, count * len(records) * len(LEVELS), seconds)
    for count in (6, 11, 22, 44):
        add("records", count, count * len(LEVELS), timed(WALL, records[:count], LEVELS, repeats))
    for count in (5, 10, 20, 40, 80):
        add("levels", count, count * len(records), timed(WALL, records, np.linspace(0.05, 1.0, count), repeats))
    for times in (1, 2, 4, 8):
        # The same motion repeated: a record of several shocks
        longer = [dd.Record(np.tile(r.acceleration, times), r.dt, name=r.name) for r in records]
        add("shocks", times, len(records) * len(LEVELS), timed(WALL, longer, LEVELS, repeats))
    for parts in (1, 2, 4, 8):
        # Linear interpolation, like the record itself: the same input, and the same motion
        finer = [dd.Record(refined(r.acceleration, parts), r.dt / parts, name=r.name) for r in records]
        add("samples", parts, len(records) * len(LEVELS), timed(WALL, finer, LEVELS, repeats))
    say("walls, levels, length and sampling of records")
    return rows


def refined(acceleration, parts):
    """Refine samples by linear interpolation."""
    places = np.arange(parts * (len(acceleration) - 1) + 1) / parts
    return np.interp(places, np.arange(len(acceleration)), acceleration)


def measure(executable, path, repeats):
    """Measure everything and write a table: kind, size, histories, value [s, or MiB for memory]."""
    rows = threads(executable, repeats) + variants(executable, repeats) + costs(repeats) + memory(executable)
    with open(path, "w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, ["kind", "size", "histories", "value"])
        writer.writeheader()
        writer.writerows(rows)
