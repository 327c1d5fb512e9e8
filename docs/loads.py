"""Measure what docs/studies/curves.md says of loads: DONDOLO_RECORDS=FOLDER python docs/loads.py."""

import os

import numpy as np

import dondolo as dd

records = dd.read_catalogue(os.environ["DONDOLO_RECORDS"] + "/italy44.csv")
levels = np.r_[np.arange(0.05, 0.6, 0.05), np.arange(0.6, 2.01, 0.1)]
load = {inertia: [dd.Load(10e3, depth=0.175, height=3.0, inertia=inertia)] for inertia in ("none", "vertical", "both")}
cases = {
    "bare": {},
    "load, 'none'": {"loads": load["none"]},
    "load, 'vertical'": {"loads": load["vertical"]},
    "load, 'both'": {"loads": load["both"]},
    "load, 'both', impulse": {"loads": load["both"], "restitution": "impulse"},
    "thrust 0.2": {"thrusts": [dd.Thrust(200.0, height=3.0)]},
    "hinge 10": {"hinge_depth": 0.01},
    "hinge 20": {"hinge_depth": 0.02},
    "strength": {"compressive_strength": 1e6},
}
# Where a two-block wall lifts its load; the speed ratio alone is that of the mass on a wall whose load is dead
strip = {"hinge": 0.6, "overburden": 20e3}
strips = {
    "bare": {"hinge": 0.6},
    "dead": {**strip, "overburden_inertia": 0.0},
    "dead, impulse": {**strip, "overburden_inertia": 0.0, "restitution": "impulse"},
    "dead, ratio 0.487": {
        **strip,
        "overburden_inertia": 0.0,
        "restitution_value": 0.48729473876118,
    },
    "half lifted": {**strip, "overburden_inertia": 0.5},
    "lifted": {**strip, "overburden_inertia": 1.0},
    "lifted, strength": {**strip, "overburden_inertia": 1.0, "compressive_strength": 1e6},
}
far = np.r_[levels, np.arange(2.2, 4.41, 0.2)]
walls = {name: dd.OneSidedWall(3.0, 0.25, **more) for name, more in cases.items()}
walls |= {f"strip, {name}": dd.TwoBlockWall(3.0, 0.25, **more) for name, more in strips.items()}
for name, wall in walls.items():
    at = far if wall.two_sided else levels
    f = dd.multiple_stripe(wall, records, at, polarity="both").fit()
    trigger = wall.trigger_acceleration / wall.gravity
    numbers = f"{wall.capacity_angle:.4f} {wall.restitution_coefficient:.3f} {f.theta:.3f} {f.beta:.3f}"
    print(f"{name:24s} {trigger:.4f} {numbers} {f.status}")
