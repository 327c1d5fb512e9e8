"""Cost of ties, friction, moving supports, scatter, chains and joints that bend, and of what no history takes.

Ratios are of turns taken one after the other; accelerograms are the embedded synthetic ones.
"""

import os
import subprocess
import sys
import tempfile
import time
from contextlib import chdir
from dataclasses import asdict
from functools import partial

import numpy as np
from cores import Cores
from scaling import CATALOGUE, LEVELS, row, spread_of, timed

import dondolo as dd


def facade(*heights, **more):
    """A facade with ties at some heights."""
    ties = [dd.Tie(height, area=5e-5, length=8.0) for height in heights]
    return dd.OneSidedWall(height=9.0, thickness=0.5, ties=ties, **more)


INTERLOCK = dd.Interlock(overlap=0.12, course=0.1, thickness=0.5, spacing=5.0)
BUILDING = dd.Building(0.3, storeys=3, level=0.0, building_height=9.0)
#: The first is what the others are compared with
FACADES = {
    "bare": facade(),
    "one tie": facade(8.5),
    "two ties": facade(8.5, 5.5),
    "three ties": facade(8.5, 5.5, 2.5),
    "friction": facade(interlock=INTERLOCK),
    "friction and a tie": facade(8.5, interlock=INTERLOCK),
    "moving supports": facade(building=BUILDING),
    "moving supports and a tie": facade(8.5, building=BUILDING),
}


def strip(**more):
    """A strip between two floors that carries a load as a dead force."""
    load = {"overburden": 21e3, "overburden_inertia": 0.0}
    return dd.TwoBlockWall(2.85, 0.21, density=1884.0, hinge=0.72, restitution_factor=0.87, **load, **more)


#: The first is what the others are compared with
STRIPS = {"rigid": strip()} | {f"period {period} s": strip(elastic_period=period) for period in (0.03, 0.06, 0.1, 0.15)}
STRIP_LEVELS = np.linspace(0.3, 3.3, 26)
#: At one level, and on its own building: the strip of rigid blocks first
ON_BUILDING = {"building": dd.Building(0.3, storeys=3, level=6.0, building_height=9.0)}
PAIRS = {
    "one level of 1 g": ({}, [1.0]),
    "on its own building": (ON_BUILDING, STRIP_LEVELS),
}
#: Kinds of walls; the first is what the others are compared with
WALLS = {
    "facade": facade(),
    "facade with a tie": facade(8.5),
    "facade, scatter of restitution": facade(restitution_sd=0.05),
    "facade on a building": facade(building=BUILDING),
    "block that rocks to both sides": dd.FreeStandingWall(3.0, 0.4),
    "strip of two blocks": dd.TwoBlockWall(4.0, 0.25, hinge=0.6),
    "strip that bends, 0.1 s": dd.TwoBlockWall(4.0, 0.25, hinge=0.6, elastic_period=0.1),
    "chain, horizontal bending": dd.horizontal_bending(
        6.0, 0.3, 1900.0, thrust=10e3, hinge_depth=0.01, sides=2, restitution_value=0.74
    ),
}
#: What is done in a process in which it has been done before, but for the import
FIXED = {
    "import dondolo": "a new process, without NumPy's import",
    "import numpy": "the same process",
    "catalogue": "44 records read",
    "case": "a case of one wall and 44 records read",
    "report": "an HTML page of one wall",
    "report of a population": "an HTML page of twelve walls",
    "figure": "the curve of a wall, saved as PNG",
    "workbook": "the tables of twelve walls",
}


def in_turns(kind, walls, levels, repeats):
    """Measure walls in turns: rows of seconds, and of ratios to the first one in the same turn."""
    records = dd.read_catalogue(CATALOGUE)
    seconds, cores = {name: [] for name in walls}, Cores()
    for _ in range(repeats):
        for name, wall in walls.items():
            (taken,), _ = cores.turn(partial(timed, [wall], records, levels, 1))
            seconds[name].append(taken)
    rows, histories, first = [], len(records) * len(levels), next(iter(seconds.values()))
    for place, own in enumerate(seconds.values()):
        ratios = [mine / other for mine, other in zip(own, first, strict=True)]
        rows.append(row(kind, place, histories, own))
        rows.append(row(f"{kind} ratio", place, histories, ratios))
    return rows


def kinds(repeats):
    """Seconds of kinds of walls, and ratios to the first, as they are and per sample interval of rocking."""
    records, levels = dd.read_catalogue(CATALOGUE), LEVELS
    rows = in_turns("kind", WALLS, levels, repeats)
    rocked = [dd.multiple_stripe(wall, records, levels, progress=False).work.rocked for wall in WALLS.values()]
    own = [found for found in rows if found["kind"] == "kind ratio"]
    per_sample = [(spread_of(one).times(rocked[0] / number), one) for one, number in zip(own, rocked, strict=True)]
    return rows + [one | asdict(spread) | {"kind": "kind ratio per sample"} for spread, one in per_sample]


def imports():
    """Seconds of NumPy's import and of dondolo's after it, in a new process."""
    program = (
        "import time; start = time.perf_counter(); import numpy; middle = time.perf_counter(); import dondolo; "
        "print(middle - start, time.perf_counter() - middle)"
    )
    printed = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, check=True).stdout
    return tuple(map(float, printed.split()))


def fixed(repeats):
    """Measure what costs the same for few histories and many."""
    import matplotlib as mpl
    import matplotlib.pyplot as plt

    mpl.use("agg")
    records = dd.read_catalogue(CATALOGUE)
    walls = [dd.OneSidedWall(float(h), 0.25, name=f"w{i}") for i, h in enumerate(np.linspace(1.0, 3.0, 12))]
    seconds = {name: [] for name in FIXED}
    with tempfile.TemporaryDirectory() as folder, chdir(folder):
        stripes = dd.multiple_stripe(walls[0], records, LEVELS, progress=False)
        typology = dd.typology(walls, records, LEVELS, progress=False)
        typology.write_results("walls")
        with open("case.nml", "w", encoding="utf-8") as file:
            file.write(
                "&wall mechanism = 'one_sided' height = 1.5 thickness = 0.25 /\n"
                f"&records catalogue = '{CATALOGUE}' /\n&stripes first = 0.05 last = 1.0 count = 20 /\n"
            )

        def figure():
            ax = stripes.fit().plot()
            ax.figure.savefig(os.devnull, format="png")
            plt.close(ax.figure)

        works = {
            "catalogue": lambda: dd.read_catalogue(CATALOGUE),
            "case": lambda: dd.read_case("case.nml"),
            "report": lambda: dd.report(stripes, "wall.html"),
            "report of a population": lambda: dd.report(typology, "walls.html"),
            "figure": figure,
            "workbook": lambda: dd.write_workbook("walls", "walls.xlsx"),
        }
        for work in works.values():
            work()
        cores = Cores()
        for _ in range(repeats):
            (numpy_alone, own), _ = cores.turn(imports)
            seconds["import numpy"].append(numpy_alone)
            seconds["import dondolo"].append(own)
            for name, work in works.items():
                seconds[name].append(cores.turn(partial(seconds_of, work))[0])
    return [row("fixed", place, 0, seconds[name]) for place, name in enumerate(FIXED)]


def seconds_of(work):
    """Seconds that some work takes."""
    start = time.perf_counter()
    work()
    return time.perf_counter() - start


def measure(repeats):
    """Measure all: rows as those of the scaling."""
    walls = in_turns("facade", FACADES, LEVELS, repeats) + in_turns("strip", STRIPS, STRIP_LEVELS, repeats)
    for name, (more, levels) in PAIRS.items():
        pair = {"rigid": strip(**more), "bends": strip(elastic_period=0.1, **more)}
        walls += in_turns(f"strip, {name}", pair, levels, repeats)
    return walls + kinds(repeats) + fixed(repeats)
