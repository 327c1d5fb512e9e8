"""Measure what docs/studies/curves.md says of facades: DONDOLO_RECORDS=FOLDER python docs/facades.py."""

import os

import numpy as np

import dondolo as dd

records = dd.read_catalogue(os.environ["DONDOLO_RECORDS"] + "/italy44.csv")
levels = np.r_[np.arange(0.02, 0.5, 0.04), np.arange(0.5, 1.51, 0.1)]
storeys = {"sections": [dd.Section(4.0, 0.60), dd.Section(3.5, 0.45), dd.Section(3.0, 0.30)], "name": "facade"}
loads = ((12e3, 4.0, 0.5), (12e3, 7.5, 0.35), (6e3, 10.5, 0.2))
floors = {"loads": [dd.Load(load, height=height, depth=depth, inertia="both") for load, height, depth in loads]}
floors |= {"compressive_strength": 1.5e6}
roof = {"thrusts": [dd.Thrust(200.0, height=10.5)]}
house = {"building": dd.Building(0.3, storeys=3, level=0.0, building_height=10.5)}
cases = {
    "on the ground": floors,
    "on its building": {**floors, **house},
    "the same, roof thrusts": {**floors, **house, **roof},
}
for name, more in cases.items():
    found = dd.typology(dd.Population.of_facade(dd.OneSidedWall(**storeys, **more)), records, levels, polarity="both")
    union, product = found.unions["facade"], found.combined["facade"]
    thetas = " | ".join(f"{curve.theta:.3f}" for curve in found.curves)
    print(f"| {name} | {thetas} | {union.theta:.3f} | {union.beta:.3f} | {product.theta:.3f} | {product.beta:.3f} |")
