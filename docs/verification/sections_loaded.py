"""Walls with loads, section 8: errors of both engines against the reference, their agreement, and time per history.

python sections_loaded.py EXECUTABLE RECORDS writes this section of docs/studies/verification.md alone.
"""

import sys
import time
import warnings
from dataclasses import replace

import numpy as np
from cases import LOADED_STRIPES, LOADED_WALLS, ROOT, TABLES, read_table, reference_motions, run
from histories import Errors, Histories
from markdown import bullets, paragraph, power, small, table
from sections_accuracy import LARGE, demand
from study import DEFAULT, TIGHTEST

import dondolo as dd

TITLE = "## 8. Walls with loads"
PAGE = ROOT / "docs" / "studies" / "verification.md"
REPEATS = 7
MOST = 1.5  # time per history / that of the bare wall, lanes

LOAD = {inertia: [dd.Load(10e3, depth=0.175, height=3.0, inertia=inertia)] for inertia in ("none", "vertical", "both")}
TOP = dd.Thrust(200.0, height=3.0)
ONE_SIDED = {
    "bare": {},
    "load 'none'": {"loads": LOAD["none"]},
    "load 'vertical'": {"loads": LOAD["vertical"]},
    "load 'both'": {"loads": LOAD["both"]},
    "load 'none', 600 kg/m pushed": {
        "loads": LOAD["none"],
        "inertial_masses": [dd.InertialMass(600.0, depth=0.175, height=3.0)],
    },
    "thrust 0.2 kN/m": {"thrusts": [TOP]},
    "thrust 0.2 kN/m, decay 1 m": {"thrusts": [replace(TOP, decay=1.0)]},
    "thrust 0.2 kN/m, decay 0.05 m": {"thrusts": [replace(TOP, decay=0.05)]},
    "spring 0.5 kN/m/m": {"springs": [dd.Spring(500.0, depth=0.0, height=3.0)]},
    "bed 0.2 kN/m2/m": {"distributed_springs": [dd.DistributedSpring(200.0, depth=0.25, bottom=0.0, top=3.0)]},
    "hinge at 20 mm": {"hinge_depth": 0.02},
    "load 'vertical', 1 MPa": {"loads": LOAD["vertical"], "compressive_strength": 1e6},
    "edge radius 20 mm": {"edge_radius": 0.02},
    "gable": {"sections": [dd.Section(3.0, 0.25, top_width=0.0)]},
}


def walls():
    """Walls by mechanism, the bare one first, and their levels [g]."""
    size = (3.0, 0.25)
    one = {
        name: dd.OneSidedWall(**more) if "sections" in more else dd.OneSidedWall(*size, **more)
        for name, more in ONE_SIDED.items()
    }
    coping = dd.Load(3e3, depth=0.125, height=3.0, inertia="both")
    two = {"hinge": 0.6, "overburden": 20e3}
    near, far = np.linspace(0.05, 1.0, 20), np.linspace(0.2, 4.0, 20)
    return {
        "one_sided": (one, near),
        "free_standing": (
            {"bare": dd.FreeStandingWall(*size), "coping": dd.FreeStandingWall(*size, loads=[coping])},
            near,
        ),
        "two_block": (
            {
                "bare": dd.TwoBlockWall(*size, hinge=0.6),
                "overburden 20 kN/m, dead": dd.TwoBlockWall(*size, **two, overburden_inertia=0.0),
                "overburden 20 kN/m, lifted": dd.TwoBlockWall(*size, **two, overburden_inertia=1.0),
            },
            far,
        ),
    }


def against_reference(executable, records):
    """Rows of errors of both engines against test/reference, and the largest change of a table."""
    rows, change = [], 0.0
    for wall in LOADED_WALLS:
        for name, motions in reference_motions(records, wall).items():
            exact = Histories.of(read_table(TABLES / f"{wall}_{name}.csv"))
            change = max(change, exact.spread.max())
            row = [f"`{wall}`, {name}"]
            for engine in ("lanes", "rk45"):
                found = run(executable, wall, motions, DEFAULT, solver=f"engine = '{engine}'")["histories"]
                errors = Errors(Histories.of(found), exact)
                row += [f"{errors.flags()}, {errors.above(LARGE)}", small(errors.worst()), small(errors.quantile(0.5))]
            rows.append(row)
    return rows, change


def stripes(wall, records, levels, engine, rtol=DEFAULT):
    """All histories of a wall on one thread."""
    solver = dd.Solver(engine=engine, rtol=rtol, atol=rtol / 100.0)
    return dd.multiple_stripe(wall, records, levels, threads=1, progress=False, solver=solver)


def by_engines(records):
    """Rows of agreement and of time, one for each wall; times are the least of some runs, in turns."""
    rows = []
    for mechanism, (each, levels) in walls().items():
        seconds = {name: [] for name in each}
        for _ in range(REPEATS):
            for name, wall in each.items():
                start = time.process_time()
                stripes(wall, records, levels, "lanes")
                seconds[name].append(time.process_time() - start)
        for name, wall in each.items():
            lanes, rk45, tight = (
                stripes(wall, records, levels, *how) for how in (("lanes",), ("rk45",), ("rk45", TIGHTEST))
            )
            off = [np.abs(ran.edp - tight.edp) > LARGE for ran in (lanes, rk45)]
            wrong = [np.count_nonzero(ran.collapsed != tight.collapsed) for ran in (lanes, rk45)]
            ratio = min(seconds[name]) / min(seconds["bare"])
            demand(ratio <= MOST, f"lanes takes at most {MOST} times as long as for the bare wall: {name} {ratio:.2f}")
            demand(lanes.engine == "lanes", f"lanes takes {name}")
            rows.append(
                [
                    f"`{mechanism}`",
                    name,
                    f"{lanes.collapses.sum()}",
                    *(f"{a}, {b.sum()}" for a, b in zip(wrong, off, strict=True)),
                    f"{ratio:.2f}",
                ]
            )
    return rows


def loaded(executable, records):
    """Section 8."""
    errors, change = against_reference(executable, records)
    demand(change < 0.01 * LARGE, "the reference is at least a hundred times more accurate than counted errors")
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", dd.errors.DondoloWarning)
        agreement = by_engines(dd.read_catalogue(f"{records}/italy44.csv"))
    return [
        TITLE,
        "",
        *paragraph(
            "Three walls with loads have tables in 33 digits of their own, of five levels. No EDP of them changes by "
            f"more than {small(change)} if the tolerance is relaxed a hundredfold. Wrong flags and EDPs with errors "
            "above 1e-6 of both engines at the defaults, with the largest and the median error:"
        ),
        *bullets(f"`{wall}`: `{said}`; PGA in g: `{LOADED_STRIPES[wall]}`" for wall, said in LOADED_WALLS.items()),
        *table(["wall", "lanes", "worst", "median", "rk45", "worst", "median"], errors),
        *paragraph(
            "The walls below are 3 m by 0.25 m, with loads on top as in [Loads](../mechanisms.md#loads). Each has 880 "
            "histories of the recorded accelerograms, at 20 levels up to 1 g, or 4 g for `two_block`, compared with "
            f"rk45 at rtol = {power(TIGHTEST)}. The last column is the CPU time of lanes on one thread, the least of "
            f"{REPEATS} runs, over that of the bare wall."
        ),
        *table(
            [
                "",
                "wall",
                "collapses",
                "lanes: flags, EDPs",
                "rk45: flags, EDPs",
                "time / bare",
            ],
            agreement,
        ),
    ]


def main():
    """Write the section into the page in place of what it had."""
    text = PAGE.read_text(encoding="utf-8")
    before, _, there = text.partition(TITLE)
    _, mark, after = there.partition("\n## ")
    section = "\n".join(loaded(*sys.argv[1:3])).rstrip() + "\n"
    PAGE.write_text(before.rstrip() + "\n\n" + section + mark + after, encoding="utf-8")


if __name__ == "__main__":
    main()
