"""Measure what docs/loads.md says: DONDOLO_RECORDS=FOLDER python docs/loads.py."""

import os

import numpy as np

import dondolo as dd

records = dd.read_catalogue(os.environ["DONDOLO_RECORDS"] + "/italy44.csv")
levels = np.r_[np.arange(0.05, 0.6, 0.05), np.arange(0.6, 2.01, 0.1)]
load = {"load": 10e3, "load_depth": 0.175, "load_height": 3.0}
cases = {
    "bare": {},
    "load, 'none'": {**load, "load_inertia": "none"},
    "load, 'vertical'": {**load, "load_inertia": "vertical"},
    "load, 'both'": {**load, "load_inertia": "both"},
    "load, 'both', impulse": {**load, "load_inertia": "both", "restitution": "impulse"},
    "thrust 0.2": {"thrust": 200.0, "thrust_height": 3.0},
    "hinge 10": {"hinge_depth": 0.01},
    "hinge 20": {"hinge_depth": 0.02},
    "strength": {"compressive_strength": 1e6},
}
for name, more in cases.items():
    wall = dd.OneSidedWall(3.0, 0.25, **more)
    f = dd.multiple_stripe(wall, records, levels, polarity="both").fit()
    trigger = wall.trigger_acceleration / wall.gravity
    print(f"{name:24s} {trigger:.4f} {wall.capacity_angle:.4f} {f.theta:.3f} {f.beta:.3f} {f.status}")
