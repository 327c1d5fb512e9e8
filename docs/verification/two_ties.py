"""Write test/reference/two_ties_recorded.csv: python two_ties.py RECORDS [LEVEL...], levels of PGA in g.

A facade with two ties under the recorded accelerograms, every history in 33 digits and not the doubtful ones alone, at
relative tolerances of 1e-12, 1e-14 ... until two neighbours differ by 1e-7 at most (docs/studies/certification.md).
Levels that the table has already are kept; the others take five to twenty minutes each.
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

PATH = Path(TABLES) / "two_ties_recorded.csv"
COLUMNS = ["record", "im_level", "scale", "edp", "edp_change", "edp_lowest", "edp_highest", "status"]
LEVELS = (0.6, 0.7, 0.8, 0.9, 1.0)


def facade():
    """A facade of 9 m by 0.5 m; at 8.5 and 5.5 m a bar of 14 mm every 3 m, stressed to 30 MPa."""
    return dd.OneSidedWall(9.0, 0.5, ties=[dd.Tie(height, area=5e-5, length=8.0, preload=3e7) for height in (8.5, 5.5)])


def rows(level, records):
    """Rows of one level."""
    told = dd.multiple_stripe(facade(), records, [level], estimate_error=True, threads=1, progress=False)
    # A doubt that certify cannot overlook
    exact = replace(told, edp_error=np.ones_like(told.edp_error)).certify(records, progress=False, threads=1)
    numbers = (exact.edp, exact.edp_error, exact.edp_lowest, exact.edp_highest)
    for k, record in enumerate(records):
        edp, change, lowest, highest = (float(each[0, k]) for each in numbers)
        status = dd.results.Certified(exact.status[0, k]).name.lower()
        scale = float(exact.scale[0, k])
        yield [record.name, level, repr(scale), repr(edp), f"{change:.1e}", repr(lowest), repr(highest), status]


def main():
    """Write the table, whole after each level."""
    warnings.simplefilter("ignore", dd.errors.DondoloWarning)
    folder, *levels = sys.argv[1:]
    records = dd.read_catalogue(motions(folder)["recorded"].catalogue)
    table = [list(row.values()) for row in read_table(PATH)] if PATH.is_file() else []
    there = {float(row[1]) for row in table}
    for level in [float(text) for text in levels] or LEVELS:
        if level in there:
            continue
        start = time.monotonic()
        table.extend(rows(level, records))
        table.sort(key=lambda row: float(row[1]))
        with open(PATH, "w", newline="", encoding="utf-8") as file:
            file.write("# in 33 digits; edp_change: difference of the last two tolerances, or of the bounds\n")
            writer = csv.writer(file, lineterminator="\n")
            writer.writerow(COLUMNS)
            writer.writerows(table)
        print(f"{level} g: {time.monotonic() - start:.0f} s", file=sys.stderr)


if __name__ == "__main__":
    main()
