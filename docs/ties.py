"""Measure what docs/ties.md says, and draw its figure of designs: DONDOLO_RECORDS=FOLDER python docs/ties.py."""

import os
import runpy
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

docs = Path(__file__).parent
found = runpy.run_path(str(docs / "examples/which_tie.py"))["found"]
found.plot().figure.savefig(docs / "figures/which_tie.png", dpi=100)
