"""Exact models of walls between two moving supports beside dondolo: python two_supports.py RECORDS | --quick.

Prints the first swings, and writes medians under the records beside those of dondolo into docs/studies/supports.md:
those under the recorded components of italy44.csv in the folder RECORDS, and those under the synthetic accelerograms.
With --quick some walls under the synthetic ones, and no page. Fails if swings or medians are off.
"""

import re
import sys
import warnings
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from cases import ROOT
from markdown import table
from scipy.optimize import minimize
from scipy.stats import norm
from yardsticks import Facade, G, House, Program, Strip, Tie

import dondolo as dd

PAGE = ROOT / "docs" / "studies" / "supports.md"

# Wall, accelerations of base and top in m/s2 at samples of 0.05 s, and start, turn and peak opening of the first swing
SWINGS = {
    "a": (
        Strip(3.0, 0.25, 0.6),
        [0, -2.5, -4, -3, -1, 1, 2],
        [0, -4, -5, -1, 2, 2, 1],
        (0.0410881947309365, 0.196568113210515, 0.00633721808795554),
    ),
    "b": (
        Strip(3.0, 0.25, 0.6),
        [0, -3, -5, -4, -1, 2, 2],
        [0, -1, -3, -6, -4, 1, 4],
        (0.0701681031306596, 0.269316496808315, 0.0143993670685972),
    ),
    "c": (
        Strip(3.5, 0.45, 0.75, load=30e3, lifted=0.5, eccentricity=-0.05, depth=0.02),
        [0, -6, -14, -16, -10, 0, 6],
        [0, -10, -20, -14, -4, 6, 8],
        (0.0586948393359829, 0.271129775565439, 0.0324079121356865),
    ),
}


def swing(program, case):
    """Start, turn and peak opening of the first swing of a case."""
    wall, base, top, _ = SWINGS[case]
    found = program.follow(wall, None, np.array([base, top], float), 0.05, [0], [1.0])
    return found.start[0], found.turn[0], found.peak[0] * found.limit


@dataclass
class Row:
    """A wall of the table: what dondolo computes, the exact model and its building."""

    name: str
    wall: dd.Wall
    model: Strip | Facade
    house: House


def building(house):
    """The building as dondolo describes it."""
    more = {"participation": house.base, "participation_top": house.top, "damping": house.damping}
    if house.diaphragm > 0.0:
        more["diaphragm_period"], more["diaphragm_damping"] = house.diaphragm, house.diaphragm_damping
        more["diaphragm_participation"] = house.share
    return dd.Building(house.period, **more)


def strip(name, base, top, diaphragm=0.0):
    """A strip of 3 m by 0.25 m that carries a roof, in a house of 0.3 s."""
    house = House(0.3, base, top, diaphragm=diaphragm)
    load = {"overburden": 5e3, "overburden_inertia": 0.0, "restitution_factor": 0.87}
    wall = dd.TwoBlockWall(3.0, 0.25, hinge=0.6, building=building(house), **load)
    return Row(name, wall, Strip(3.0, 0.25, 0.6, factor=0.87, load=5e3), house)


def facade(name, height, thickness, house, tie_area=0.0):
    """A facade on the ground, as tall as the building behind it; its tie, 0.5 m below the top, is that of docs/ties.md.

    The area is in m2 for each m of facade, 0 for none.
    """
    if tie_area == 0.0:
        wall = dd.OneSidedWall(height, thickness, building=building(house))
        return Row(name, wall, Facade(height, thickness, height), house)
    ties = [dd.Tie(height - 0.5, area=tie_area, length=8.0, preload=3e7)]
    wall = dd.OneSidedWall(height, thickness, building=building(house), ties=ties)
    stiffness, preload = 2.06e11 * tie_area / 8.0, 3e7 * tie_area
    model = Tie(height - 0.5, stiffness, preload, 1.8e8 * tie_area, 0.02 * 8.0 - preload / stiffness)
    return Row(name, wall, Facade(height, thickness, height, model), house)


def leans(period, top=9 / 7):
    """The house that a facade leans on."""
    return House(period, 0.0, top)


ROWS = [
    strip("strip, 0 to 3 m", 0.0, 3 / 7),
    strip("strip, 3 to 6 m", 3 / 7, 6 / 7),
    strip("strip, 6 to 9 m", 6 / 7, 9 / 7),
    strip("the same, diaphragm of 0.2 s", 6 / 7, 9 / 7, 0.2),
    strip("the same, diaphragm of 0.4 s", 6 / 7, 9 / 7, 0.4),
    strip("the same, diaphragm of 0.8 s", 6 / 7, 9 / 7, 0.8),
    facade("facade 9 m by 0.5 m, 0.3 s", 9.0, 0.5, leans(0.3)),
    facade("facade 9 m by 0.5 m, 0.5 s", 9.0, 0.5, leans(0.5)),
    facade("the facade with its tie of 2 %, 0.3 s", 9.0, 0.5, leans(0.3), 5e-5),
    facade("the facade with its tie of 2 %, 0.5 s", 9.0, 0.5, leans(0.5), 5e-5),
    facade("facade 4 m by 0.6 m, 0.2 s", 4.0, 0.6, leans(0.2, 1.0)),
    facade("facade 12 m by 0.6 m, 0.4 s", 12.0, 0.6, leans(0.4)),
]
# Levels as parts of dondolo's median, and the levels that find it
PARTS = np.geomspace(0.35, 2.8, 16)
LEVELS = np.geomspace(0.05, 4.0, 26)
MOST = 0.05  # largest difference of medians of these walls that is accepted
PRECISE = 2e-11  # and of the first swings
QUICK = [ROWS[2], ROWS[4], ROWS[6], ROWS[8]]


def fit(levels, collapses, count):
    """Median and dispersion, by maximum likelihood."""

    def lack(p):
        z = (np.log(levels) - p[0]) / np.exp(p[1])
        return -np.sum(collapses * norm.logcdf(z) + (count - collapses) * norm.logcdf(-z))

    found = minimize(
        lack, [np.mean(np.log(levels)), np.log(0.4)], method="Nelder-Mead", options={"xatol": 1e-5, "fatol": 1e-8}
    )
    return np.exp(found.x)


def peaks(program, row, records, levels):
    """Peaks of the exact model, (levels, histories), and the drift of the supports at 1 g as a part of the capacity.

    Histories of a facade are the records as recorded, then reversed; a strip has no front.
    """
    ground = np.zeros((len(records), max(len(each.acceleration) for each in records)))
    for k, each in enumerate(records):
        ground[k, : len(each.acceleration)] = each.acceleration
    largest = np.abs(ground).max(axis=1)
    ways = row.model.ways
    which = np.tile(np.arange(len(records)), len(ways) * len(levels))
    scale = np.outer(levels * G, np.concatenate([way / largest for way in ways]))
    found = program.follow(row.model, row.house, ground, records[0].dt, which, scale.ravel())
    if found.given_up > 0:
        raise SystemExit(f"{row.name}: {found.given_up} histories do not get on")
    return found.peak.reshape(scale.shape), found.drift * G / largest


@dataclass
class Pair:
    """Median and dispersion by the exact model and by dondolo."""

    exact: np.ndarray
    own: np.ndarray
    flags: float  # share of the histories in which one of them alone collapses
    drift: float  # median over the records of the largest drift at the median, as a part of the capacity

    @property
    def difference(self):
        """Of the medians, as a part of the exact one."""
        return self.own[0] / self.exact[0] - 1.0


def compare(program, row, records, shares=PARTS):
    """Both programs at levels about dondolo's median."""
    asked = {"polarity": "both", "progress": False}
    levels = shares * dd.multiple_stripe(row.wall, records, LEVELS, **asked).fit().theta
    found, drift = peaks(program, row, records, levels)
    flags = found >= 1.0
    own = np.asarray(dd.multiple_stripe(row.wall, records, levels, **asked).collapsed)
    exact, ours = (fit(levels, each.sum(axis=1), each.shape[1]) for each in (flags, own))
    return Pair(exact, ours, float(np.mean(flags != own)), float(np.median(drift) * ours[0]))


HEAD = ["wall", "exact θ", "β", "dondolo θ", "β", "difference", "histories that differ", "drift"]


def cells(name, pair):
    """Row of the table."""
    numbers = [f"{each:.3f}" for each in (*pair.exact, *pair.own)]
    return [name, *numbers, f"{100 * pair.difference:+.1f} %", f"{100 * pair.flags:.1f} %", f"{pair.drift:.2f}"]


def medians(program, rows, records, shares=PARTS):
    """Lines of the table, and which walls are off; prints each as it is known."""
    lines, wrong = [], []
    for row in rows:
        pair = compare(program, row, records, shares)
        lines.append(cells(row.name, pair))
        print("  ".join(lines[-1]), flush=True)
        if abs(pair.difference) > MOST:
            wrong.append(row.name)
    return table(HEAD, lines), wrong


def swings(program):
    """Print the first swings, and how far they are from the values in 15 digits; the largest difference."""
    largest = 0.0
    for name, (*_, exact) in SWINGS.items():
        found = swing(program, name)
        off = max(abs(a / b - 1.0) for a, b in zip(found, exact, strict=True))
        print(f"swing {name}: start {found[0]:.10f} s, turn {found[1]:.10f} s, peak {found[2]:.12f}, off by {off:.0e}")
        largest = max(largest, off)
    return largest


def replace_between(name, lines):
    """Replace what is between the marks of docs/studies/supports.md that have this name."""
    begin, end = (f"<!-- {word}: {name}, written by docs/verification -->" for word in ("begin", "end"))
    text = PAGE.read_text(encoding="utf-8")
    body = "\n".join(lines).strip()
    found = re.subn(f"{begin}.*?{end}", lambda _: f"{begin}\n{body}\n{end}", text, flags=re.DOTALL)
    if found[1] != 1:
        raise SystemExit(f"{PAGE}: must have one pair of the lines {begin} and {end}")
    PAGE.write_text(found[0], encoding="utf-8")


def catalogues(folder):
    """Records by name: recorded ones if the folder has them, and synthetic ones."""
    found = {"synthetic": dd.read_catalogue(ROOT / "data" / "records" / "synthetic44.csv")}
    if (Path(folder) / "italy44.csv").is_file():
        found = {"recorded": dd.read_catalogue(Path(folder) / "italy44.csv")} | found
    return found


def main():
    """Swings and tables."""
    warnings.simplefilter("ignore", dd.errors.DondoloWarning)
    program = Program()
    wrong = ["first swings"] if swings(program) > PRECISE else []
    quick = sys.argv[1] == "--quick"
    for name, records in catalogues("none" if quick else sys.argv[1]).items():
        print(f"{name}: {', '.join(HEAD)}")
        lines, off = medians(program, QUICK if quick else ROWS, records)
        wrong += [f"{wall} ({name})" for wall in off]
        if not quick:
            replace_between(name, lines)
    sys.exit(f"two supports: {', '.join(wrong)}: off" if wrong else 0)


if __name__ == "__main__":
    main()
