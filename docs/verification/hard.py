"""Search hard histories and write the tables hard_*.csv of test/reference: python hard.py RECORDS [WALLS MOST].

Random walls, each under every record with a random factor, by both engines at their defaults with estimated errors.
Those that an engine doubts, and those on which the engines disagree, are candidates; MOST of them, chosen at random,
are run in 33 digits (docs/studies/certification.md).
"""

import csv
import sys
import time
import warnings
from dataclasses import replace
from pathlib import Path

import numpy as np
from cases import TABLES, motions

import dondolo as dd

SEEDS = {"synthetic": 1, "recorded": 2}
LARGE = 1e-6  # error of an EDP that counts
# What tells the walls apart
PROPERTIES = (
    "mechanism",
    "height",
    "thickness",
    "hinge",
    "overburden",
    "overburden_inertia",
    "eccentricity",
    "restitution",
    "restitution_value",
    "restitution_factor",
)
COLUMNS = [*PROPERTIES, "record", "scale", "edp", "edp_lowest", "edp_highest", "status"]


def random_wall(rng):
    """A wall, realistic or not: slender or squat, small or large, of any restitution."""
    draw = rng.uniform
    kind = rng.choice(["one", "free", "two"], p=[0.4, 0.25, 0.35])
    mode = rng.choice(["default", "factor", "constant"], p=[0.3, 0.35, 0.35])
    how = {}
    if mode == "constant":
        how = {"restitution_value": float(np.round(1.0 - 10.0 ** draw(-4.0, -0.5), 6))}
    while True:
        try:
            return _wall(kind, mode, how, rng)
        except dd.errors.InputError:
            # Factors that leave no loss of speed, overburdens that push the wall over
            continue


def _wall(kind, mode, how, rng):
    draw = rng.uniform
    if kind == "one":
        if mode == "factor":
            how = {"restitution_factor": round(draw(0.6, 2.2), 3)}
        height = draw(1.5, 8.0)
        return dd.OneSidedWall(round(height, 3), round(height / draw(4.0, 20.0), 3), **how)
    if kind == "free":
        if mode == "factor":
            how = {"restitution_factor": round(draw(0.85, 1.1), 3)}
        height = 10.0 ** draw(-0.5, 0.9)
        return dd.FreeStandingWall(round(height, 3), round(height / draw(2.0, 12.0), 3), **how)
    if mode == "factor":
        how = {"restitution_factor": round(draw(0.8, 1.1), 3)}
    height = draw(2.0, 5.0)
    thickness = round(height / draw(6.0, 20.0), 3)
    load = {"hinge": round(draw(0.35, 0.85), 3)}
    if rng.random() < 0.5:
        load["overburden"] = round(10.0 ** draw(2.0, 4.7))
        load["overburden_inertia"] = float(rng.choice([0.0, 1.0])) if mode != "factor" else 0.0
        load["eccentricity"] = round(draw(-0.4, 0.4) * thickness, 4)
    return dd.TwoBlockWall(round(height, 3), thickness, **load, **how)


def stripe(wall, record, factor, engine):
    """One history as a stripe, with its estimated error."""
    polarity = "reversed" if factor < 0.0 else "as_recorded"
    level = abs(factor) * record.peak_acceleration / wall.gravity
    return dd.multiple_stripe(
        wall,
        record,
        [level],
        polarity=polarity,
        solver=dd.Solver(engine=engine),
        estimate_error=True,
        threads=1,
        progress=False,
    )


def candidates(records, walls, rng):
    """Histories in doubt or dispute, as (wall, record, stripes by lanes); how many there were."""
    found = []
    for _ in range(walls):
        wall = random_wall(rng)
        peaks = wall.trigger_acceleration * 10.0 ** rng.uniform(0.02, 0.8, len(records))
        signs = rng.choice([-1.0, 1.0], len(records))
        for record, peak, sign in zip(records, peaks, signs, strict=True):
            runs = [
                stripe(wall, record, sign * peak / record.peak_acceleration, engine) for engine in ("lanes", "rk45")
            ]
            edps, errors = (np.array([getattr(run, name)[0, 0] for run in runs]) for name in ("edp", "edp_error"))
            if errors.max() > LARGE or abs(edps[0] - edps[1]) > LARGE:
                found.append((wall, record, runs[0]))
    return found, walls * len(records)


def row(wall, record, stripes):
    """A row of the table; the scale is that of the stripe, with the sign of its polarity."""
    # A doubt that certify cannot overlook
    doubted = replace(stripes, edp_error=np.ones_like(stripes.edp_error))
    certified = doubted.certify(record, progress=False)
    values = [getattr(wall, name, None) for name in PROPERTIES]
    numbers = (certified.scale * certified.polarity, certified.edp, certified.edp_lowest, certified.edp_highest)
    return [
        *("" if value is None else value for value in values),
        record.name,
        *(repr(float(each[0, 0])) for each in numbers),
        dd.results.Certified(certified.status[0, 0]).name.lower(),
    ]


def main():
    """Write the table of each set of accelerograms that is there."""
    folder, *numbers = sys.argv[1:]
    walls, most = (int(number) for number in numbers) if numbers else (300, 60)
    warnings.simplefilter("ignore", dd.errors.DondoloWarning)
    for name, each in motions(folder).items():
        start = time.monotonic()
        rng = np.random.default_rng(SEEDS[name])
        found, histories = candidates(dd.read_catalogue(each.catalogue), walls, rng)
        rng.shuffle(found)
        path = Path(TABLES) / f"hard_{name}.csv"
        with open(path, "w", newline="", encoding="utf-8") as file:
            file.write(f"# some of the {len(found)} doubtful of {histories} histories of random walls, in 33 digits\n")
            writer = csv.writer(file, lineterminator="\n")
            writer.writerow(COLUMNS)
            writer.writerows(row(*one) for one in found[:most])
        print(f"{path.name}: {time.monotonic() - start:.0f} s", file=sys.stderr)


if __name__ == "__main__":
    main()
