"""The table behind the curve of "In the browser": medians and dispersions of facades, for sliders without a server.

Between the 192 walls of the table ln theta and beta are interpolated; what that costs is measured at the
middles of its cells and written beside it. Run it with the Python of .venv: python docs/live_table.py
"""

from __future__ import annotations

import itertools
import json
import warnings
from pathlib import Path

import numpy as np

import dondolo as dd
from dondolo.serve.levels import chosen_levels

TARGET = Path(__file__).parent / "site/static/curve_table.js"
HEIGHTS = np.round(np.geomspace(2.0, 12.0, 16), 2)
THICKNESSES = np.round(np.geomspace(0.2, 1.0, 12), 3)


def curve_of(height: float, thickness: float) -> dd.results.Fragility:
    """The curve of a facade under the synthetic records in both directions, at levels that suit it."""
    records = tuple(dd.example_records())
    text = f"""
        &wall mechanism = 'one_sided', height = {height}, thickness = {thickness} /
        &records catalogue = 'synthetic44.csv', polarity = 'both' /
        &stripes levels = 1 /"""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", dd.errors.DondoloWarning)
        case = dd.results.Case.from_text(text, records)
        levels = chosen_levels(case, records[::4], 0)
        stripes = dd.multiple_stripe(case.population.walls[0], records, levels, polarity="both", progress=False)
        return stripes.fit()


def interpolated(table: dict[str, list], height: float, thickness: float) -> tuple[float, float]:
    """Median and dispersion between the walls of the table, linear in the logarithms of height and thickness."""
    axes = [np.log(table[name]) for name in ("heights", "thicknesses")]
    places = [
        min(max(int(np.searchsorted(axis, np.log(value))) - 1, 0), len(axis) - 2)
        for axis, value in zip(axes, (height, thickness), strict=True)
    ]
    shares = [
        (np.log(value) - axis[place]) / (axis[place + 1] - axis[place])
        for axis, value, place in zip(axes, (height, thickness), places, strict=True)
    ]
    found = []
    for values in (np.log(table["theta"]), np.array(table["beta"])):
        i, j = places
        rows = (1.0 - shares[0]) * values[i, j : j + 2] + shares[0] * values[i + 1, j : j + 2]
        found.append(float((1.0 - shares[1]) * rows[0] + shares[1] * rows[1]))
    return float(np.exp(found[0])), found[1]


def main() -> None:
    """Compute the table and what interpolation costs."""
    curves = [[curve_of(height, thickness) for thickness in THICKNESSES] for height in HEIGHTS]
    table = {
        "heights": HEIGHTS.tolist(),
        "thicknesses": THICKNESSES.tolist(),
        "theta": [[float(f"{one.theta:.4g}") for one in row] for row in curves],
        "beta": [[round(one.beta, 3) for one in row] for row in curves],
    }
    middles = [np.sqrt(values[1:] * values[:-1])[::3] for values in (HEIGHTS, THICKNESSES)]
    errors = []
    for height, thickness in itertools.product(*middles):
        theta, _ = interpolated(table, height, thickness)
        errors.append(abs(theta / curve_of(height, thickness).theta - 1.0))
    table["error"] = {"median": float(f"{np.median(errors):.1g}"), "largest": float(f"{np.max(errors):.2g}")}
    TARGET.write_text(f"// Written by docs/live_table.py\nexport default {json.dumps(table, separators=(',', ':'))};\n")
    print(f"{TARGET}: {TARGET.stat().st_size} bytes, errors {table['error']}")


if __name__ == "__main__":
    main()
