"""Measure what docs/studies/curves.md says of supports: DONDOLO_RECORDS=FOLDER python docs/supports.py."""

import os

import numpy as np

import dondolo as dd

records = dd.read_catalogue(os.environ["DONDOLO_RECORDS"] + "/italy44.csv")
levels = np.r_[np.arange(0.05, 0.6, 0.05), np.arange(0.6, 2.01, 0.1)]
STOREYS = {"storeys": 3, "building_height": 9.0}


def run(wall: dd.Wall) -> str:
    """Median and dispersion of a wall, and the share of its histories with drifts beyond 0.2 of its capacity."""
    stripes = dd.multiple_stripe(wall, records, levels, polarity="both", progress=False)
    curve = stripes.fit()
    drifted = stripes.work.drifted / stripes.work.histories
    return f"{curve.theta:.3f} | {curve.beta:.3f} | {100.0 * drifted:.0f} %"


def strip(level: float, **more: float) -> dd.TwoBlockWall:
    """A strip of 3 m by 0.25 m that carries a roof, in a house of 9 m and 0.3 s."""
    house = dd.Building(0.3, level=level, **STOREYS, **more)
    return dd.TwoBlockWall(
        3.0, 0.25, hinge=0.6, overburden=5e3, overburden_inertia=0.0, restitution_factor=0.87, building=house
    )


def facade(building: dd.Building | None, tied: bool) -> dd.OneSidedWall:
    """The facade of docs/ties.md, with its tie of 2 % or without."""
    ties = [dd.Tie(8.5, area=5e-5, length=8.0, preload=3e7)] if tied else []
    return dd.OneSidedWall(9.0, 0.5, building=building, ties=ties)


print("| strip | θ, base alone | β | drift | θ, both supports | β | drift |")
for name, level, more in (
    ("0 to 3 m", 0.0, {}),
    ("3 to 6 m", 3.0, {}),
    ("6 to 9 m", 6.0, {}),
    ("6 to 9 m, diaphragm of 0.2 s", 6.0, {"diaphragm_period": 0.2}),
    ("6 to 9 m, diaphragm of 0.4 s", 6.0, {"diaphragm_period": 0.4}),
    ("6 to 9 m, diaphragm of 0.8 s", 6.0, {"diaphragm_period": 0.8}),
):
    print(f"| {name} | {run(strip(level, level_top=level))} | {run(strip(level, **more))} |")
print("| building | θ bare | β | drift | θ tied | β | drift |")
for name, building in (
    ("none: a surface at rest", None),
    ("0.1 s, 5 %", dd.Building(0.1, level=0.0, **STOREYS)),
    ("0.2 s, 5 %", dd.Building(0.2, level=0.0, **STOREYS)),
    ("0.3 s, 5 %", dd.Building(0.3, level=0.0, **STOREYS)),
    ("0.3 s, 10 %", dd.Building(0.3, damping=0.10, level=0.0, **STOREYS)),
    ("0.45 s, 15 %", dd.Building(0.45, damping=0.15, level=0.0, **STOREYS)),
    ("0.5 s, 5 %", dd.Building(0.5, level=0.0, **STOREYS)),
):
    print(f"| {name} | {run(facade(building, False))} | {run(facade(building, True))} |")
