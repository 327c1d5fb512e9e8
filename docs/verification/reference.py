"""Write the tables of test/reference: python reference.py EXECUTABLE RECORDS [WALL...], with an executable in real128.

Every history is run at two tolerances that differ by a factor of a hundred; the change of its EDP bounds the error of
the table. A table takes up to half an hour on two cores.
"""

import os
import sys
import time
from decimal import Decimal

from cases import LOADED_WALLS, TABLES, WALLS, reference_motions, run

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


def main():
    """Write every table, or those of the walls that are named, whose accelerograms are available."""
    executable, records, *walls = sys.argv[1:]
    if unknown := set(walls) - set(ALL):
        sys.exit(f"reference: no wall {', '.join(sorted(unknown))}; there are {', '.join(ALL)}")
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
