"""Exact models of walls between two moving supports beside dondolo: python two_supports.py RECORDS [--quick].

The strip is the Lagrangian of two blocks whose base and top move by themselves (supported_walls.py); the facade a block
on either edge of its base that cannot enter the surface it leans on, which turns with the building, with a tie that is
anchored to the building. Prints the first swings, medians under the recorded components beside those of dondolo, and
random walls. RECORDS is the folder of italy44.csv, or of another catalogue; --quick takes few records and levels.
"""

import sys
import warnings
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from moving_supports import CALM, DELTA, G, Histories, House, supports, window
from scipy.optimize import minimize
from scipy.stats import norm
from supported_walls import Facade, Strip, Tie

import dondolo as dd


def accelerations(base, top, dt, parts):
    """Channels of supports whose accelerations are linear between samples, from rest, at half steps of dt/parts."""
    own, half = np.arange(len(base)) * dt, 0.5 * dt / parts
    times = np.arange(2 * parts * (len(base) - 1) + 1) * half
    rise = np.asarray(top, float) - base
    at = np.minimum((times / dt + 1e-9).astype(int), len(base) - 2)
    s = times - own[at]
    slope = np.diff(rise) / dt
    first = np.r_[0.0, np.cumsum(0.5 * dt * (rise[1:] + rise[:-1]))]
    second = np.r_[0.0, np.cumsum(first[:-1] * dt + dt**2 * (rise[:-1] / 3.0 + rise[1:] / 6.0))]
    delta = second[at] + first[at] * s + rise[at] * s**2 / 2.0 + slope[at] * s**3 / 6.0
    speed = first[at] + rise[at] * s + slope[at] * s**2 / 2.0
    return np.stack([np.interp(times, own, base), delta, speed, rise[at] + slope[at] * s], axis=1)[:, :, None]


SWINGS = {
    "a": (
        Strip(3.0, 0.25, 0.6, 0.0),
        [0, -2.5, -4, -3, -1, 1, 2, 1, 0, 0, 0],
        [0, -4, -5, -1, 2, 2, 1, 0.5, 0, 0, 0],
        (0.0410881947309365, 0.196568113210515, 0.00633721808795554),
    ),
    "b": (
        Strip(3.0, 0.25, 0.6, 0.0),
        [0, -3, -5, -4, -1, 2, 2, 0, 0, 0, 0],
        [0, -1, -3, -6, -4, 1, 4, 3, 1, 0, 0],
        (0.0701681031306596, 0.269316496808315, 0.0143993670685972),
    ),
    "c": (
        Strip(3.5, 0.45, 0.75, 0.0, load=30e3, lifted=0.5, eccentricity=-0.05, depth=0.02),
        [0, -6, -14, -16, -10, 0, 6, 4, 0, 0, 0],
        [0, -10, -20, -14, -4, 6, 8, 2, 0, 0, 0],
        (0.0586948393359829, 0.271129775565439, 0.0324079121356865),
    ),
}


def swing(case, parts=100):
    """Start, turn and peak opening of the first swing of a case."""
    wall, base, top, _ = SWINGS[case]
    motion = accelerations(np.array(base, float), np.array(top, float), 0.05, parts)
    k = round(0.31 / 0.05 * parts)
    found = Histories(wall, motion[: 2 * k + 1], np.zeros(1, int), np.ones(1), 0.05 / parts).run()
    return found.start[0], found.turn[0], found.peak[0] * wall.limit


@dataclass
class Row:
    """A wall of the table: what dondolo is told, the exact model and its building."""

    name: str
    wall: dd.Wall
    model: Strip | Facade
    house: House


def told(house):
    """The building as dondolo is told of it."""
    more = {"participation": house.base, "participation_top": house.top, "damping": house.damping}
    if house.diaphragm > 0.0:
        more["diaphragm_period"], more["diaphragm_damping"] = house.diaphragm, house.diaphragm_damping
        more["diaphragm_participation"] = house.share
    return dd.Building(house.period, **more)


def strip(name, base, top, diaphragm=0.0):
    """A strip of 3 m by 0.25 m that carries a roof, in a house of 0.3 s."""
    house = House(0.3, base, top, diaphragm=diaphragm)
    load = {"overburden": 5e3, "overburden_inertia": 0.0, "restitution_factor": 0.87}
    wall = dd.TwoBlockWall(3.0, 0.25, hinge=0.6, building=told(house), **load)
    return Row(name, wall, Strip(3.0, 0.25, 0.6, factor=0.87, load=5e3), house)


def facade(name, height, thickness, period, top=9 / 7, damping=0.05, tied=False):
    """A facade on the ground, as tall as the building behind it; with the 2 % tie of docs/ties.md."""
    house = House(period, 0.0, top, damping=damping)
    ties, model = [], None
    if tied:
        ties = [dd.Tie(8.5, area=5e-5, length=8.0, preload=3e7)]
        stiffness = 2.06e11 * 5e-5 / 8.0
        model = Tie(8.5, stiffness, 1500.0, 9000.0, 0.02 * 8.0 - 1500.0 / stiffness)
    wall = dd.OneSidedWall(height, thickness, building=told(house), ties=ties)
    return Row(name, wall, Facade(height, thickness, height, model), house)


ROWS = [
    strip("strip, 6 to 9 m, rigid floors", 6 / 7, 9 / 7),
    strip("strip, 3 to 6 m", 3 / 7, 6 / 7),
    strip("strip, 0 to 3 m", 0.0, 3 / 7),
    strip("strip, 6 to 9 m, diaphragm of 0.2 s", 6 / 7, 9 / 7, 0.2),
    strip("strip, 6 to 9 m, diaphragm of 0.4 s", 6 / 7, 9 / 7, 0.4),
    strip("strip, 6 to 9 m, diaphragm of 0.8 s", 6 / 7, 9 / 7, 0.8),
    facade("facade, 9 m by 0.5 m, 0.3 s", 9.0, 0.5, 0.3),
    facade("facade, 9 m by 0.5 m, 0.5 s", 9.0, 0.5, 0.5),
    facade("facade, 9 m by 0.5 m, tie of 2 %, 0.3 s", 9.0, 0.5, 0.3, tied=True),
    facade("facade, 9 m by 0.5 m, tie of 2 %, 0.5 s", 9.0, 0.5, 0.5, tied=True),
    facade("facade, 4 m by 0.6 m, 0.2 s", 4.0, 0.6, 0.2, 1.0),
    facade("facade, 12 m by 0.6 m, 0.4 s", 12.0, 0.6, 0.4),
]
# Levels as parts of dondolo's median, and the levels that find it
PARTS = np.geomspace(0.35, 2.8, 16)
LEVELS = np.geomspace(0.05, 3.0, 24)
MOST = 0.08  # largest difference of medians of these walls that is accepted
RANDOM = 20  # random walls, half of them strips


def fit(levels, collapses, count):
    """Median and dispersion, by maximum likelihood."""

    def lack(p):
        z = (np.log(levels) - p[0]) / np.exp(p[1])
        return -np.sum(collapses * norm.logcdf(z) + (count - collapses) * norm.logcdf(-z))

    found = minimize(
        lack, [np.mean(np.log(levels)), np.log(0.4)], method="Nelder-Mead", options={"xatol": 1e-5, "fatol": 1e-8}
    )
    return np.exp(found.x)


def motions_of(row, records, parts):
    """Channels of the supports under each record, and the peak of its acceleration."""
    ground = np.zeros((len(records), max(len(each.acceleration) for each in records)))
    for k, each in enumerate(records):
        ground[k, : len(each.acceleration)] = each.acceleration
    return supports(row.house, ground, records[0].dt, parts), np.abs(ground).max(axis=1)


def peaks(row, records, levels, parts=1):
    """Peaks of the exact model, (levels, histories), and the drift of the supports at 1 g as a part of the capacity.

    Histories of a facade are the records as they are, then reversed; a strip has no front.
    """
    h = records[0].dt / parts
    motion, largest = motions_of(row, records, parts)
    model = row.model
    span = model.span if isinstance(model, Facade) else model.height
    drift = np.abs(motion[:, DELTA]).max(axis=0) * G / largest / span / model.limit
    ways = (1.0, -1.0) if isinstance(model, Facade) else (1.0,)
    which = np.tile(np.arange(len(records)), len(ways))
    scale = np.outer(levels * G, np.concatenate([way / largest for way in ways]))
    motion = window(motion, levels.max() * G / largest, CALM * G * model.limit, round(12.0 / h))
    found = Histories(model, motion, np.tile(which, len(levels)), scale.ravel(), h).run()
    return found.peak.reshape(scale.shape), drift


@dataclass
class Pair:
    """Median and dispersion by the exact model and by dondolo."""

    exact: np.ndarray
    own: np.ndarray
    flags: float  # share of the histories that one of them collapses alone
    drift: float  # median over the records of the greatest drift at the median, as a part of the capacity

    @property
    def difference(self):
        """Of the medians, as a part of the exact one."""
        return self.own[0] / self.exact[0] - 1.0


def compare(row, records, shares=PARTS, parts=1):
    """Both programs at levels about dondolo's median."""
    asked = {"polarity": "both", "progress": False}
    levels = shares * dd.multiple_stripe(row.wall, records, LEVELS, **asked).fit().theta
    found, drift = peaks(row, records, levels, parts)
    stripes = dd.multiple_stripe(row.wall, records, levels, polarity="both", progress=False)
    flags, own = found >= 1.0, np.asarray(stripes.collapsed)
    exact, ours = (fit(levels, each.sum(axis=1), each.shape[1]) for each in (flags, own))
    return Pair(exact, ours, float(np.mean(flags != own)), float(np.median(drift) * ours[0]))


def table(rows, records, shares=PARTS):
    """Print a line a wall; the largest difference."""
    print("| wall | exact: median, g | dispersion | dondolo: median, g | dispersion | difference | flags | drift |")
    print("|---|---|---|---|---|---|---|---|")
    largest = 0.0
    for row in rows:
        pair = compare(row, records, shares)
        numbers = " | ".join(f"{each:.3f}" for each in (*pair.exact, *pair.own))
        shares_of = f"{100 * pair.difference:+.1f} % | {100 * pair.flags:.1f} % | {pair.drift:.2f}"
        print(f"| {row.name} | {numbers} | {shares_of} |", flush=True)
        largest = max(largest, abs(pair.difference))
    return largest


def random_rows(count, seed):
    """Strips and facades of random sizes, loads and restitution, on random houses, with diaphragms and without."""
    rng = np.random.default_rng(seed)
    rows = []
    for k in range(count):
        period, damping = round(rng.uniform(0.1, 0.6), 2), round(rng.uniform(0.03, 0.12), 2)
        if k % 2:
            height, slender = round(rng.uniform(3.0, 12.0), 1), rng.uniform(8.0, 20.0)
            name = f"facade, {height} m by {height / slender:.2f} m, {period} s, {100 * damping:.0f} %"
            rows.append(facade(name, height, round(height / slender, 2), period, 9 / 7, damping))
            continue
        height, slender, hinge = (
            round(rng.uniform(2.5, 4.0), 1),
            rng.uniform(8.0, 16.0),
            round(rng.uniform(0.5, 0.8), 2),
        )
        thick, low = round(height / slender, 2), rng.uniform(0.0, 0.9)
        diaphragm = round(rng.uniform(0.15, 0.8), 2) if rng.uniform() < 0.4 else 0.0
        house = House(period, low, low + rng.uniform(0.2, 0.5), damping, diaphragm)
        load, ratio = round(rng.uniform(0.0, 2e4)), round(rng.uniform(0.6, 0.9), 2)
        more = {"overburden": load, "overburden_inertia": 0.0, "eccentricity": 0.0, "hinge": hinge}
        wall = dd.TwoBlockWall(
            height, thick, restitution="constant", restitution_value=ratio, building=told(house), **more
        )
        soft = f", diaphragm of {diaphragm} s" if diaphragm else ""
        name = f"strip, {height} m by {thick} m, {load / 1e3:.1f} kN/m, {period} s, {100 * damping:.0f} %{soft}"
        rows.append(Row(name, wall, Strip(height, thick, hinge, ratio, load=load), house))
    return rows


def swings():
    """Print the first swings, and how far they are from the values in 15 digits; the largest difference."""
    print("| first swing | start, s | turn, s | peak opening | largest difference |")
    print("|---|---|---|---|---|")
    largest = 0.0
    for name, (*_, exact) in SWINGS.items():
        found = swing(name)
        off = max(abs(a / b - 1.0) for a, b in zip(found, exact, strict=True))
        print(f"| {name} | {found[0]:.10f} | {found[1]:.10f} | {found[2]:.12f} | {off:.0e} |", flush=True)
        largest = max(largest, off)
    return largest


def main():
    """Swings, table and random walls."""
    warnings.simplefilter("ignore", dd.DondoloWarning)
    quick = "--quick" in sys.argv
    folder = Path(next(each for each in sys.argv[1:] if not each.startswith("--")))
    records = dd.read_catalogue(folder / "italy44.csv" if folder.is_dir() else folder)
    wrong = swings() > 1e-6
    print()
    if quick:
        table([ROWS[0], ROWS[6]], records[2:6], np.array([0.7, 1.0, 1.4]))
    else:
        wrong |= table(ROWS, records) > MOST
        print("\nRandom walls\n")
        table(random_rows(RANDOM, 1), records, np.geomspace(0.5, 2.0, 7))
    sys.exit("two supports: swings or medians are off" if wrong else 0)


if __name__ == "__main__":
    main()
