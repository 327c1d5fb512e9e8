"""Measure ties for docs/ties.md and docs/studies/curves.md, and draw their designs.

DONDOLO_RECORDS=FOLDER python docs/ties.py
"""

import os
import runpy
import statistics
import time
from dataclasses import replace
from pathlib import Path

import numpy as np

import dondolo as dd

records = dd.read_catalogue(os.environ["DONDOLO_RECORDS"] + "/italy44.csv")
levels = np.r_[np.arange(0.05, 0.6, 0.05), np.arange(0.6, 2.01, 0.1)]
# A bar of 14 mm every 3 m, stressed to 30 MPa
tie = dd.Tie(8.5, area=5e-5, length=8.0, preload=3e7)
cases = {
    "bare": [],
    "strain 2 %": [tie],
    "anchor gives way": [replace(tie, anchor_force=8999.0)],
    "strain 0.5 %": [replace(tie, strain=0.005)],
    "strain 10 %": [replace(tie, strain=0.1)],
    "no preload": [replace(tie, preload=0.0)],
    "half the section": [replace(tie, area=2.5e-5)],
    "twice the section": [replace(tie, area=1e-4)],
    "two ties": [tie, replace(tie, height=5.5)],
}
for name, ties in cases.items():
    wall = dd.OneSidedWall(9.0, 0.5, ties=ties)
    stripes = dd.multiple_stripe(wall, records, levels, polarity="both", progress=False)
    f = stripes.fit()
    statics = (wall.trigger_acceleration, wall.greatest_acceleration, wall.plastic_acceleration)
    broken = stripes.broken_ties[np.searchsorted(levels, 0.5 - 1e-9)] if ties else ()
    shares = " ".join(f"{share:.2f}" for share in broken)
    numbers = " ".join(f"{a / wall.gravity:.3f}" for a in statics)
    print(f"{name:20s} {numbers} {f.theta:.3f} {f.beta:.3f} {f.status} | broken at 0.5 g: {shares}")

print("in front of a building of 9 m, by its period: theta, its ratio to the bare wall; broken at 0.3 g, period 0.3 s")
bare: dict[float, float] = {}
for name, ties in cases.items():
    cells, shares = [], ""
    for period in (0.2, 0.3, 0.5):
        house = dd.Building(period, storeys=3, level=0.0, building_height=9.0)
        wall = dd.OneSidedWall(9.0, 0.5, building=house, ties=ties)
        stripes = dd.multiple_stripe(wall, records, levels, polarity="both", progress=False)
        theta = stripes.fit().theta
        cells.append(f"{theta:.3f} ({theta / bare.setdefault(period, theta):.2f})")
        if ties and period == 0.3:
            broken = stripes.broken_ties[np.searchsorted(levels, 0.3 - 1e-9)]
            shares = ", ".join(f"{100.0 * share:.0f} %" for share in broken)
    print(f"| {name} | {' | '.join(cells)} | {shares} |")

print("milliseconds of processor time for a history on one thread, in turns, ratio to the bare facade")
facades = [(height, thickness) for height in (6.0, 7.0, 8.0, 9.0, 10.0) for thickness in (0.4, 0.5)]
interlock = dd.Interlock(overlap=0.12, course=0.1, thickness=0.5, spacing=5.0)
parts = {name: [0.9, 0.6, 0.3][:number] for number, name in enumerate(("none", "one", "two", "three"))}
few = np.linspace(0.1, 1.0, 10)
for engine, measured in (("lanes", facades), ("rk45", facades[1:8:6])):
    seconds: dict[str, list[float]] = {}
    for height, thickness in measured:
        walls = {
            name: dd.OneSidedWall(height, thickness, ties=[replace(tie, height=part * height) for part in own])
            for name, own in parts.items()
        }
        walls["friction"] = dd.OneSidedWall(height, thickness, interlock=interlock)
        solver = dd.Solver(engine=engine)
        for name, wall in walls.items():
            # The first call, which is not timed, uploads the records.
            taken = []
            for _ in range(3 if engine == "lanes" else 2):
                start = time.process_time()
                dd.multiple_stripe(wall, records, few, polarity="both", solver=solver, threads=1, progress=False)
                taken.append(time.process_time() - start)
            seconds.setdefault(name, []).append(1e3 * min(taken[1:]) / (2 * len(records) * len(few)))
    for name, several in seconds.items():
        ratios = [mine / bare for mine, bare in zip(several, seconds["none"], strict=True)]
        spread = f"{statistics.median(ratios):.1f} ({min(ratios):.1f} to {max(ratios):.1f})"
        print(f"{engine}: | {name} | {statistics.median(several):.3f} | {spread} |")

docs = Path(__file__).parent
found = runpy.run_path(str(docs / "examples/which_tie.py"))["found"]
found.plot().figure.savefig(docs / "figures/which_tie.png", dpi=100)
