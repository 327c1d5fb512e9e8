"""Measure the parapet on a roof of docs/studies/curves.md: DONDOLO_RECORDS=FOLDER python docs/floors.py."""

import os
from collections.abc import Sequence

import numpy as np

import dondolo as dd

records = dd.read_catalogue(os.environ["DONDOLO_RECORDS"] + "/italy44.csv")


def parapet(period: float | None, refine: int | None = None) -> dd.OneSidedWall:
    """The parapet on the ground, or on the roof of a house of three storeys."""
    house = None if period is None else dd.Building(period, damping=0.05, participation=9 / 7, refine=refine)
    return dd.OneSidedWall(1.5, 0.25, building=house)


def run(wall: dd.OneSidedWall, levels: Sequence[float]) -> dd.results.Stripes:
    """Its stripes in both polarities."""
    return dd.multiple_stripe(wall, records, levels, polarity="both", progress=False)


print("base, theta, beta")
for period in (None, 0.2, 0.3, 0.5):
    curve = run(parapet(period), np.linspace(0.1, 1.3, 12)).fit()
    print(f"{period or 'ground'}: {curve.theta:.3f} {curve.beta:.3f}")
print("parts, median error of the EDP, collapses that differ, theta")
levels = [0.2, 0.3, 0.4, 0.5]
finest = run(parapet(0.2, 16), levels)
for parts in (1, 2, 4, 8, 16):
    one = run(parapet(0.2, parts), levels)
    both = ~(one.collapsed | finest.collapsed) & (finest.edp > 0.0)
    error = np.median(np.abs(one.edp - finest.edp)[both] / finest.edp[both])
    print(f"{parts}: {error:.2g} {(one.collapsed != finest.collapsed).sum()} {one.fit().theta:.3f}")
