"""Random walls between two moving supports beside the exact models: python random_supports.py RECORDS [WALLS].

Strips and facades of random sizes, loads, ties and restitution, on random buildings, with diaphragms and without, each
under components chosen at random: of italy44.csv in the folder RECORDS if it is there, else the synthetic ones. Walls
whose medians differ by more than 5 % are run again under all components. Writes the share within 5 % and the worst into
docs/studies/supports.md, and all walls into out/random_supports_*.csv, from which a run that was stopped goes on.
"""

import csv
import sys
import warnings
from dataclasses import dataclass
from itertools import pairwise

import numpy as np
from cases import ROOT
from markdown import paragraph, table
from two_supports import Pair, Row, building, catalogues, compare, facade, replace_between
from yardsticks import House, Program, Strip

import dondolo as dd

WALLS = 1000
SEED = 1
MANY = 16  # components for each wall
# Levels over dondolo's median, and those of walls that are run again
SHARES = np.geomspace(0.6, 1.7, 5)
FINER = np.geomspace(0.5, 2.0, 9)
CLOSE = 0.05
# Bounds of the drift of the supports, over the capacity
DRIFTS = (0.0, 0.05, 0.1, 0.2, 0.4, 0.8, np.inf)


def random_strip(rng):
    """A strip between two floors; two in five under a diaphragm."""
    height, hinge = round(rng.uniform(2.5, 4.0), 1), round(rng.uniform(0.5, 0.8), 2)
    thick, low = round(height / rng.uniform(8.0, 16.0), 2), round(rng.uniform(0.0, 0.9), 2)
    diaphragm = round(rng.uniform(0.15, 0.8), 2) if rng.uniform() < 0.4 else 0.0
    period, damping = round(rng.uniform(0.1, 0.6), 2), round(rng.uniform(0.03, 0.12), 2)
    house = House(period, low, round(low + rng.uniform(0.2, 0.5), 2), damping, diaphragm)
    load, lifted = round(rng.uniform(0.0, 2e4)), round(max(0.0, rng.uniform(-1.0, 1.0)), 2)
    ratio, eccentricity = round(rng.uniform(0.6, 0.9), 2), round(rng.uniform(-0.25, 0.25) * thick, 3)
    wall = dd.TwoBlockWall(
        height,
        thick,
        hinge=hinge,
        overburden=load,
        overburden_inertia=lifted,
        eccentricity=eccentricity,
        restitution_value=ratio,
        building=building(house),
    )
    soft = f", diaphragm of {diaphragm} s" if diaphragm else ""
    name = f"strip {height} m by {thick} m, {load / 1e3:.1f} kN/m, {period} s, {100 * damping:.0f} %{soft}"
    return Row(name, wall, Strip(height, thick, hinge, ratio, 1.0, float(load), lifted, eccentricity), house)


def random_facade(rng):
    """A facade on the ground, one in two with a tie."""
    height = round(rng.uniform(3.0, 12.0), 1)
    thick = round(height / rng.uniform(8.0, 20.0), 2)
    period, top, damping = (round(rng.uniform(*each), 2) for each in ((0.1, 0.6), (1.0, 1.5), (0.03, 0.12)))
    house = House(period, 0.0, top, damping)
    area = round(rng.uniform(2e-5, 1e-4), 6) if rng.uniform() < 0.5 else 0.0
    tie = f", tie of {1e6 * area:.0f} mm2/m" if area else ""
    name = f"facade {height} m by {thick} m, {house.period} s, {100 * house.damping:.0f} %{tie}"
    return facade(name, height, thick, house, area)


def kind(row):
    """Kind of wall for the statistics."""
    if isinstance(row.model, Strip):
        return "strips under diaphragms" if row.house.diaphragm else "strips"
    return "facades with ties" if row.model.tie else "facades"


def statistics(name, walls):
    """Cells of a group of walls."""
    off = np.array([wall.pair.difference for wall in walls])
    close = 100 * np.mean(np.abs(off) <= CLOSE)
    sizes = [f"{100 * value:.1f} %" for value in np.quantile(np.abs(off), (0.5, 0.9))]
    return [
        name,
        len(off),
        f"{close:.1f} %",
        f"{100 * np.median(off):+.1f} %",
        *sizes,
        f"{100 * max(off, key=abs):+.0f} %",
    ]


def report(walls, motions):
    """Lines of the page."""
    head = ["walls", "number", "within 5 %", "median difference", "median size", "90th percentile", "worst"]
    groups = [("all", walls)]
    for group in ("strips", "strips under diaphragms", "facades", "facades with ties"):
        groups.append((group, [wall for wall in walls if kind(wall.row) == group]))
    for low, high in pairwise(DRIFTS):
        bounds = f"drift of {low:g} to {high:g}" if np.isfinite(high) else f"drift above {low:g}"
        groups.append((bounds, [wall for wall in walls if low <= wall.pair.drift < high]))
    again = sum(wall.components > MANY for wall in walls)
    worst = sorted(walls, key=lambda wall: -abs(wall.pair.difference))[:3]
    about = (
        f"{len(walls)} random walls under {MANY} {motions} components each, {len(SHARES)} levels; those {again} that "
        f"differed by more than 5 %, again under all components, {len(FINER)} levels:"
    )
    names = [
        f"{each.row.name}, {100 * each.pair.difference:+.0f} % at a drift of {each.pair.drift:.2f}" for each in worst
    ]
    return [
        *paragraph(about),
        *table(head, [statistics(*each) for each in groups if each[1]]),
        *paragraph(f"The worst: {'; '.join(names)}."),
    ]


COLUMNS = (
    "kind", "wall", "theta_exact", "beta_exact", "theta_own", "beta_own", "difference", "flags", "drift", "components"
)  # fmt: skip


@dataclass
class Wall:
    """A random wall, what `compare` found of it, and under how many components."""

    row: Row
    pair: Pair
    components: int

    def cells(self):
        """Row of the table."""
        pair = self.pair
        numbers = map(float, (*pair.exact, *pair.own, pair.difference, pair.flags, pair.drift))
        return [kind(self.row), self.row.name, *numbers, self.components]


def known(path):
    """Rows of the table of a run that was stopped."""
    if not path.is_file():
        return []
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def recall(each, row):
    """A wall from its row of the table."""
    if each["wall"] != row.name:
        raise SystemExit(f"{each['wall']} is not the wall {row.name}: remove the table of the earlier run")
    exact, own = (
        np.array([float(each[f"{name}_{whose}"]) for name in ("theta", "beta")]) for whose in ("exact", "own")
    )
    return Wall(row, Pair(exact, own, float(each["flags"]), float(each["drift"])), int(each["components"]))


def main():
    """Run the walls, but those that an earlier run left in the table."""
    warnings.simplefilter("ignore", dd.errors.DondoloWarning)
    motions, records = next(iter(catalogues(sys.argv[1]).items()))
    count = int(sys.argv[2]) if len(sys.argv) > 2 else WALLS
    path = ROOT / "out" / f"random_supports_{motions}.csv"
    path.parent.mkdir(exist_ok=True)
    program, old, walls = Program(), known(path), []
    for k in range(count):
        rng = np.random.default_rng([SEED, k])
        row = (random_facade if k % 2 else random_strip)(rng)
        if k < len(old):
            wall = recall(old[k], row)
        else:
            chosen = [records[i] for i in sorted(rng.choice(len(records), MANY, replace=False))]
            wall = Wall(row, compare(program, row, chosen, SHARES), MANY)
        if abs(wall.pair.difference) > CLOSE and wall.components < len(records):
            wall = Wall(row, compare(program, row, records, FINER), len(records))
        walls.append(wall)
        with open(path, "w", newline="", encoding="utf-8") as file:
            out = csv.writer(file)
            out.writerow(COLUMNS)
            out.writerows(
                [each.cells() for each in walls] + [[each[name] for name in COLUMNS] for each in old[k + 1 :]]
            )
    replace_between("random walls", report(walls, motions))


if __name__ == "__main__":
    main()
