"""Write tables of docs/bending.md and docs/studies/curves.md: DONDOLO_RECORDS=FOLDER python docs/bending.py [--check].

Medians under the 44 components of italy44.csv. With --check nothing is written, and it fails if a page has other
numbers. Some ten seconds on one core.
"""

import os
import re
import sys
import warnings
from pathlib import Path

import numpy as np

import dondolo as dd

PAGES = tuple(Path(__file__).parent / name for name in ("bending.md", "studies/curves.md"))
COMMON = {"overburden_inertia": 0.0, "restitution": "sorrentino", "restitution_factor": 0.87}
# Strips of the table of medians, and their levels in g
STRIPS = {
    "2.85 x 0.21 m, 21 kN/m": (
        {"height": 2.85, "thickness": 0.21, "density": 1884.0, "hinge": 0.72, "overburden": 21e3},
        0.3 + 0.12 * np.arange(26),
    ),
    "2.764 x 0.102 m, 10.2 kN/m": (
        {"height": 2.764, "thickness": 0.102, "density": 1835.0, "hinge": 0.6, "overburden": 10.2e3},
        0.1 + 0.06 * np.arange(26),
    ),
    "3 x 0.25 m, 5 kN/m": (
        {"height": 3.0, "thickness": 0.25, "density": 1800.0, "hinge": 0.6, "overburden": 5e3},
        0.1 + 0.1 * np.arange(26),
    ),
}
PERIODS = (0.03, 0.06, 0.10, 0.15)
# One strip under more and more load, N/W
LOADED, LOADS = {"height": 3.0, "thickness": 0.25, "density": 1800.0, "hinge": 0.6}, (0.0, 0.5, 1.0, 2.0, 4.0)
# States: collapse, and damage at these EDPs
STATES = (1.0, 0.25, 0.05)


def curves(wall, levels, records):
    """Median of each state, and that of the first opening."""
    stripes = dd.multiple_stripe(wall, records, levels, progress=False)
    states = STATES if not wall.opening_edp else (*STATES, wall.opening_edp)
    return [stripes.fit(edp).theta for edp in states]


def strips_by_period(records):
    """Rows of the strips: median of rigid blocks, ratios at the periods, and openings."""
    rows = []
    for name, (sizes, levels) in STRIPS.items():
        rigid = dd.TwoBlockWall(**sizes, **COMMON)
        exact = curves(rigid, levels, records)
        found = []
        for period in PERIODS:
            wall = dd.TwoBlockWall(**sizes, **COMMON, elastic_period=period)
            # It opens far below the levels of collapse.
            low = np.geomspace(0.15, 2.5, 26) * rigid.trigger_acceleration / rigid.gravity
            found.append((curves(wall, levels, records), curves(wall, low, records)[-1]))
        ratios = " | ".join(f"{one[0] / exact[0]:.3f}" for one, _ in found)
        opens = " ".join(f"{low * rigid.gravity / rigid.trigger_acceleration:.2f}" for _, low in found)
        rows.append(
            f"| {name} | {rigid.frequency_parameter:.1f} | {exact[0]:.3f} | {ratios} | "
            f"{found[2][0][1] / exact[1]:.3f} | {opens} |"
        )
    return [
        "| strip | p, 1/s | θ rigid, g | T₁ = 0.03 s | 0.06 | 0.10 | 0.15 | EDP 0.25, 0.10 s | opens "
        "at PGA/a₀, T₁ 0.03, 0.06, 0.10, 0.15 |",
        "|---|---|---|---|---|---|---|---|---|",
        *rows,
    ]


def strips_by_load(records):
    """Rows of one strip under more and more load: ratios of collapse and damage over s."""
    weight = 1800.0 * 0.25 * 3.0 * 9.81
    rows = []
    for load in LOADS:
        sizes = LOADED | {"overburden": load * weight}
        more = COMMON if load else {name: value for name, value in COMMON.items() if name != "overburden_inertia"}
        rigid = dd.TwoBlockWall(**sizes, **more)
        levels = np.geomspace(0.35, 4.5, 26) * rigid.trigger_acceleration / rigid.gravity
        exact = curves(rigid, levels, records)
        found = [curves(dd.TwoBlockWall(**sizes, **more, elastic_period=T), levels, records) for T in PERIODS[1:]]
        slow = " ".join(f"{rigid.frequency_parameter * T / (2.0 * np.pi):.3f}" for T in PERIODS[1:])
        cells = [" ".join(f"{one[k] / exact[k]:.2f}" for one in found) for k in range(len(STATES))]
        rows.append(f"| {load:g} | {rigid.frequency_parameter:.1f} | {slow} | {' | '.join(cells)} |")
    return [
        "| N/W | p, 1/s | s at T₁ 0.06, 0.10, 0.15 s | collapse | EDP 0.25 | EDP 0.05 |",
        "|---|---|---|---|---|---|",
        *rows,
    ]


def uncertain(records):
    """The strip with a period that is known to 30 %."""
    sizes, levels = STRIPS["2.85 x 0.21 m, 21 kN/m"]
    more = {name: value for name, value in COMMON.items() if name != "restitution_factor"}
    found = dd.propagate_uncertainty(
        dd.TwoBlockWall(**sizes, **more, elastic_period=0.107),
        records,
        levels,
        sources={
            "elastic_period": dd.distributions.Lognormal(0.107, 0.3, low=0.04, high=0.25),
            "restitution_factor": "graziotti_2016",
        },
        n_variants=60,
        progress=False,
    )
    share = found.first[list(found.sources).index("elastic_period")]
    return [
        f"Of the first strip, 60 variants on the same records: θ is {found.theta:.2f} g, records "
        "alone contribute a dispersion of "
        f"{found.beta_records:.2f}, the model",
        f"one of {found.beta_model:.3f}, {100.0 * share:.0f} % of whose variance is that of the period.",
    ]


def tables(records):
    """The parts of the pages, by name."""
    return {"loads": strips_by_load(records), "strips": strips_by_period(records), "uncertain": uncertain(records)}


def main():
    """Write the tables, or compare them."""
    warnings.simplefilter("ignore", dd.errors.DondoloWarning)
    records = dd.read_catalogue(os.environ["DONDOLO_RECORDS"] + "/italy44.csv")
    parts, differ, found = tables(records), [], 0
    for page in PAGES:
        text = made = page.read_text(encoding="utf-8")
        for name, lines in parts.items():
            part = f"<!-- {name} -->\n" + "\n".join(lines) + f"\n<!-- end of {name} -->"
            pattern = f"<!-- {name} -->.*?<!-- end of {name} -->"
            made, n = re.subn(pattern, lambda _, part=part: part, made, flags=re.DOTALL)
            found += n
        if "--check" not in sys.argv:
            page.write_text(made, encoding="utf-8")
        elif made != text:
            differ.append(page.name)
    if found != len(parts):
        sys.exit(f"{found} of {len(parts)} parts are in the pages")
    if differ:
        sys.exit(f"other numbers in {', '.join(differ)}: run docs/bending.py")


if __name__ == "__main__":
    main()
