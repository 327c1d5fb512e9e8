"""Measure what docs/facades.md says: DONDOLO_RECORDS=FOLDER python docs/facades.py."""

import os

import numpy as np

import dondolo as dd

records = dd.read_catalogue(os.environ["DONDOLO_RECORDS"] + "/italy44.csv")
levels = np.r_[np.arange(0.02, 0.5, 0.04), np.arange(0.5, 1.51, 0.1)]
storeys = {"section_height": [4.0, 3.5, 3.0], "section_thickness": [0.60, 0.45, 0.30], "name": "facade"}
floors = {"load": [12e3, 12e3, 6e3], "load_height": [4.0, 7.5, 10.5], "load_depth": [0.5, 0.35, 0.2]}
floors |= {"load_inertia": "both", "compressive_strength": 1.5e6}
roof = {"thrust": 200.0, "thrust_height": 10.5}
house = {"building": dd.Building(0.3, storeys=3, level=0.0, building_height=10.5)}
cases = {
    "on the ground": floors,
    "on its building": {**floors, **house},
    "the same, roof thrusts": {**floors, **house, **roof},
}
for name, more in cases.items():
    found = dd.typology(dd.facade(dd.OneSidedWall(**storeys, **more)), records, levels, polarity="both")
    union, product = found.unions["facade"], found.combined["facade"]
    thetas = " | ".join(f"{curve.theta:.3f}" for curve in found.curves)
    print(f"| {name} | {thetas} | {union.theta:.3f} | {union.beta:.3f} | {product.theta:.3f} | {product.beta:.3f} |")
