"""Print the table of docs/studies/code_checks.md: DONDOLO_RECORDS=FOLDER python docs/code_checks.py."""

import os
from pathlib import Path

import numpy as np

import dondolo as dd

LEVELS = np.round(np.concatenate([0.02 * np.arange(1, 30), 0.1 * np.arange(6, 21)]), 2)
SITE = dd.Site(ag=0.2, f0=2.5, tc_star=0.35, soil="B")
FLOORS = [dd.Load(force, depth=0.4, height=z, inertia="both") for force, z in ((8e3, 3.0), (8e3, 6.0), (5e3, 9.0))]
WALLS = {
    "3 m by 0.25 m": dd.OneSidedWall(3.0, 0.25),
    "parapet, 1.5 m by 0.25 m": dd.OneSidedWall(1.5, 0.25),
    "facade, 9 m by 0.5 m": dd.OneSidedWall(9.0, 0.5),
    "the same with three floors": dd.OneSidedWall(9.0, 0.5, loads=FLOORS),
    "and a thrust of 1.5 kN/m": dd.OneSidedWall(9.0, 0.5, loads=FLOORS, thrusts=[dd.Thrust(1.5e3, height=9.0)]),
}


def dynamic(check, stripes, state):
    """The highest level up to which every stripe meets the criterion for histories [g]."""
    allowed = check.value("nonlinear", state, "displacement") / check.value("mechanism", "", "d_0")
    # Of one block without an edge the displacement is proportional to the sine of the rotation.
    end = stripes.wall.capacity_angle
    mean = np.sin(np.minimum(stripes.edp, 1.0) * end).mean(axis=1) / np.sin(end)
    good = ~(stripes.edp >= 1.0).any(axis=1) & (mean <= allowed)
    return stripes.levels[: np.argmin(good)].max(initial=0.0)


if __name__ == "__main__":
    records = dd.read_catalogue(Path(os.environ["DONDOLO_RECORDS"]) / "italy44.csv")
    print("| wall | θ, g | β | linear, q = 2 | P | nonlinear SLV | P | nonlinear SLC | P | histories up to |")
    print("|---|---|---|---|---|---|---|---|---|---|")
    for name, wall in WALLS.items():
        check = dd.check_ntc(wall, SITE)
        stripes = dd.multiple_stripe(wall, records, LEVELS, polarity="both", progress=False)
        curve = stripes.fit()
        chances = check.probabilities(curve)
        cells = [name, f"{curve.theta:.3f}", f"{curve.beta:.3f}"]
        for key in (("linear", "SLV"), ("nonlinear", "SLV"), ("nonlinear", "SLC")):
            cells += [f"{check.capacities[key]:.3f}", f"{chances[key]:.0e}"]
        print("|", " | ".join([*cells, f"{dynamic(check, stripes, 'SLV'):.2f}"]), "|")
