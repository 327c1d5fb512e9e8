"""Measure what docs/ties.md says, and draw its figure of designs: DONDOLO_RECORDS=FOLDER python docs/ties.py."""

import os
import runpy
from pathlib import Path

import numpy as np

import dondolo as dd

records = dd.read_catalogue(os.environ["DONDOLO_RECORDS"] + "/italy44.csv")
levels = np.r_[np.arange(0.05, 0.6, 0.05), np.arange(0.6, 2.01, 0.1)]
# A bar of 14 mm every 3 m, stressed to 30 MPa
tie = {"tie_height": 8.5, "tie_area": 5e-5, "tie_length": 8.0, "tie_preload": 3e7}
cases = {
    "bare": {},
    "strain 2 %": tie,
    "anchor gives way": {**tie, "tie_anchor_force": 8999.0},
    "strain 0.5 %": {**tie, "tie_strain": 0.005},
    "strain 10 %": {**tie, "tie_strain": 0.1},
    "no preload": {**tie, "tie_preload": 0.0},
    "half the section": {**tie, "tie_area": 2.5e-5},
    "twice the section": {**tie, "tie_area": 1e-4},
    "two ties": {**tie, "tie_height": [8.5, 5.5]},
}
for name, more in cases.items():
    wall = dd.OneSidedWall(9.0, 0.5, **more)
    stripes = dd.multiple_stripe(wall, records, levels, polarity="both")
    f = stripes.fit()
    statics = (wall.trigger_acceleration, wall.greatest_acceleration, wall.plastic_acceleration)
    broken = stripes.broken_ties[np.searchsorted(levels, 0.5 - 1e-9)] if more else ()
    shares = " ".join(f"{share:.2f}" for share in broken)
    numbers = " ".join(f"{a / wall.gravity:.3f}" for a in statics)
    print(f"{name:20s} {numbers} {f.theta:.3f} {f.beta:.3f} {f.status} | broken at 0.5 g: {shares}")

docs = Path(__file__).parent
found = runpy.run_path(str(docs / "examples/which_tie.py"))["found"]
found.plot()[0].figure.savefig(docs / "figures/which_tie.png", dpi=100)
