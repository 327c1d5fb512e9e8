"""Write the tables of test/reference: python reference.py EXECUTABLE RECORDS [--quick] [WALL...].

The executable must compute in real128. Every history is run at two tolerances that differ by a factor of a hundred; the
change of its EDP bounds the error of the table. A table takes up to half an hour on two cores. With --quick nothing is
written: one history of each wall is run again, and must agree with the table.
"""

import csv
import os
import sys
import tempfile
import time
from decimal import Decimal
from pathlib import Path

from cases import LOADED_WALLS, TABLES, WALLS, Motions, motions, read_table, reference_motions, run

# Errors of the one-sided wall are amplified most, by up to 1e11, so it has the tightest tolerance.
# Those of walls with loads are held to less, and take a sixth of the time.
RTOL = {"one_sided": 1e-20, "two_block": 1e-18, "free_standing": 1e-18} | dict.fromkeys(LOADED_WALLS, 1e-16)
ALL = WALLS | LOADED_WALLS
COLUMNS = "record,im_level,edp,collapsed,impacts,time_of_peak_s,edp_change"


def table(executable, wall, motions):
    """Yield the lines of one table."""
    rtol = RTOL[wall]
    exact, wider = (
        run(executable, wall, motions, tolerance, os.cpu_count(), "engine = 'rk45'")["histories"]
        for tolerance in (rtol, 100.0 * rtol)
    )
    yield f"# {ALL[wall]}"
    yield f"# {motions.catalogue.name}, PGA in g: {motions.stripes}"
    yield f"# dondolo in real128, rtol = {rtol}, atol = {rtol / 100.0:.0e}; edp_change: EDP at 100 times that less this"
    yield COLUMNS
    for row, other in zip(exact, wider, strict=True):
        change = Decimal(other["edp"]) - Decimal(row["edp"])
        numbers = {"level": (row["im_level"], 4), "edp": (row["edp"], 20), "time": (row["time_of_peak_s"], 16)}
        text = {
            what: f"{Decimal(value):.{digits}g}" if float(value) else "0" for what, (value, digits) in numbers.items()
        }
        yield (
            f"{row['record']},{text['level']},{text['edp']},{row['collapsed']},{row['impacts']},{text['time']},"
            f"{float(change):.1e}"
        )


def check_history(executable, wall):
    """Run the first history of a table that nearly collapses again; is it the same?"""
    table = TABLES / f"{wall}_synthetic.csv"
    row = next(row for row in read_table(table) if 0.2 < float(row["edp"]) < 0.9)
    whole = motions("none")["synthetic"].catalogue
    record = next(record for record in read_table(whole) if Path(record["file"]).stem == row["record"])
    with tempfile.TemporaryDirectory() as folder:
        one = Path(folder) / "one.csv"
        with open(one, "w", newline="", encoding="utf-8") as file:
            writer = csv.DictWriter(file, record)
            writer.writeheader()
            writer.writerow(record | {"file": whole.parent / record["file"]})
        again = run(executable, wall, Motions(one, f"levels = {row['im_level']}"), RTOL[wall], 1, "engine = 'rk45'")
    edp = again["histories"][0]["edp"]
    difference = abs(Decimal(edp) - Decimal(row["edp"]))
    print(f"{wall}, {row['record']} at {row['im_level']} g: EDP {row['edp']}, again {float(difference):.1e} off")
    # Far below what any double holds; libraries of mathematics may differ by rounding.
    return difference < Decimal("1e-18")


def main():
    """Write every table, or those of the walls that are named, whose accelerograms are available."""
    executable, records, *words = sys.argv[1:]
    walls = [word for word in words if word != "--quick"]
    if unknown := set(walls) - set(ALL):
        sys.exit(f"reference: no wall {', '.join(sorted(unknown))}; there are {', '.join(ALL)}")
    if "--quick" in words:
        different = [wall for wall in walls or ["one_sided"] if not check_history(executable, wall)]
        sys.exit(f"reference: not as in test/reference: {', '.join(different)}" if different else 0)
    TABLES.mkdir(exist_ok=True)
    for wall in walls or ALL:
        for name, each in reference_motions(records, wall).items():
            start = time.monotonic()
            lines = list(table(executable, wall, each))
            path = TABLES / f"{wall}_{name}.csv"
            path.write_text("\n".join(lines) + "\n", encoding="utf-8")
            print(f"{path.name}: {len(lines) - 4} histories, {time.monotonic() - start:.0f} s", file=sys.stderr)


if __name__ == "__main__":
    main()
