"""Print what docs/reading_a_curve.md says of restitution and of the hinge.

DONDOLO_RECORDS=FOLDER python docs/model_uncertainty.py
"""

import os
from pathlib import Path

import numpy as np

import dondolo as dd

LEVELS = np.round(np.concatenate([0.05 * np.arange(2, 30), 0.1 * np.arange(15, 31)]), 2)
STRIP = {"height": 3.0, "thickness": 0.25}
LOW, FACTOR, HIGH = 0.84, 0.87, 0.90
HINGES = (0.3, 0.5, 0.6, 0.7, 0.9)


def speed(hinge, thickness=0.25, model="sorrentino"):
    """Speed after an impact / speed before it by a model."""
    return dd.TwoBlockWall(3.0, thickness, hinge=hinge, restitution=model).restitution_coefficient


def median(records, **more):
    """Median of the bare strip [g]."""
    return dd.multiple_stripe(dd.TwoBlockWall(**STRIP, **more), records, LEVELS, progress=False).fit().theta


def rows(*values):
    """Cells of a row."""
    return " | ".join(f"{value:.3f}" for value in values)


if __name__ == "__main__":
    records = dd.read_catalogue(Path(os.environ["DONDOLO_RECORDS"]) / "italy44.csv")
    print("H/t 6, 7.9, 12, 25, hinge at 0.5:", rows(*(speed(0.5, 3.0 / ratio) for ratio in (6.0, 7.9, 12.0, 25.0))))
    print("equation (4), hinge at 0.3 ... 0.9:", rows(*map(speed, HINGES)))
    impulse = [speed(hinge, model="impulse") for hinge in HINGES]
    print("impulse:", rows(*impulse))
    ratios = [speed(hinge) / one for hinge, one in zip(HINGES, impulse, strict=True)]
    print("range as a ratio to impulse, from:", rows(*(LOW * ratio for ratio in ratios)))
    print("to:", rows(*(HIGH * ratio for ratio in ratios)))
    print(
        "theta, hinge at 0.6, sorrentino:",
        rows(*(median(records, hinge=0.6, restitution_factor=factor) for factor in (LOW, FACTOR, HIGH, 1.0))),
    )
    print(
        "the same factors on impulse:",
        rows(
            *(
                median(records, hinge=0.6, restitution="impulse", restitution_factor=factor)
                for factor in (LOW, FACTOR, HIGH, 1.0)
            )
        ),
    )
    kept = {"restitution_value": FACTOR * speed(0.6)}
    low, high, alone = (
        median(records, hinge=0.6, restitution_factor=FACTOR),
        median(records, hinge=0.88, restitution_factor=FACTOR),
        median(records, hinge=0.88, **kept),
    )
    print("theta, hinge at 0.6, at 0.88, and at 0.88 with the speed ratio at 0.6:", rows(low, high, alone))
    triggers = [dd.TwoBlockWall(**STRIP, hinge=hinge).trigger_acceleration / 9.81 for hinge in (0.6, 0.88)]
    print("trigger at 0.6 and at 0.88:", rows(*triggers))
