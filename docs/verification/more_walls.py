"""Write the tables walls_*.csv of test/reference: python more_walls.py RECORDS.

The walls of test/reference/walls.csv, each under every second record with a random factor, in 33 digits: at relative
tolerances of 1e-12, 1e-14 ... until two neighbours differ by 1e-7 at most (docs/studies/certification.md).
"""

import csv
import sys
import time
import warnings
from dataclasses import replace
from pathlib import Path

import numpy as np
from cases import TABLES, motions, read_table

import dondolo as dd

SEEDS = {"synthetic": 11, "recorded": 12}
WALLS = {"one_sided": dd.OneSidedWall, "free_standing": dd.FreeStandingWall, "two_block": dd.TwoBlockWall}
COLUMNS = ["wall", "record", "scale", "edp", "edp_change", "edp_lowest", "edp_highest", "status"]
# PGA / trigger of the factors, as powers of ten
POWERS = (0.05, 0.65)


def more_walls():
    """The walls by their names."""
    walls = {}
    for row in read_table(Path(TABLES) / "walls.csv"):
        name, kind = row.pop("name"), WALLS[row.pop("mechanism")]
        said = {what: text if what == "restitution" else float(text) for what, text in row.items() if text}
        walls[name] = kind(**said, name=name)
    return walls


def exact(wall, record, scale):
    """One history in 33 digits, as stripes."""
    told = dd.multiple_stripe(
        wall,
        record,
        [abs(scale) * record.peak_acceleration / wall.gravity],
        polarity="reversed" if scale < 0.0 else "as_recorded",
        estimate_error=True,
        progress=False,
    )
    # A doubt that certify cannot overlook
    return replace(told, edp_error=np.ones_like(told.edp_error)).certify(record, progress=False, threads=1)


def main():
    """Write the table of each set of accelerograms that is there."""
    warnings.simplefilter("ignore", dd.errors.DondoloWarning)
    for name, each in motions(sys.argv[1]).items():
        start = time.monotonic()
        rng = np.random.default_rng(SEEDS[name])
        path = Path(TABLES) / f"walls_{name}.csv"
        with open(path, "w", newline="", encoding="utf-8") as file:
            file.write("# in 33 digits; edp_change: difference of the last two tolerances, or of the bounds\n")
            writer = csv.writer(file, lineterminator="\n")
            writer.writerow(COLUMNS)
            for wall in more_walls().values():
                for record in dd.read_catalogue(each.catalogue)[::2]:
                    peak = wall.trigger_acceleration * 10.0 ** rng.uniform(*POWERS)
                    told = exact(wall, record, float(rng.choice([-1.0, 1.0]) * peak / record.peak_acceleration))
                    scale, edp, change, *bounds = (
                        float(values[0, 0])
                        for values in (
                            told.scale * told.polarity,
                            told.edp,
                            told.edp_error,
                            told.edp_lowest,
                            told.edp_highest,
                        )
                    )
                    status = dd.results.Certified(told.status[0, 0]).name.lower()
                    numbers = [repr(scale), repr(edp), f"{change:.1e}"]
                    writer.writerow([wall.name, record.name, *numbers, *map(repr, bounds), status])
                file.flush()
                print(f"{name}, {wall.name}: {time.monotonic() - start:.0f} s", file=sys.stderr)


if __name__ == "__main__":
    main()
