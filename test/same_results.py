"""Compare the tables of two systems: python same_results.py FOLDER FOLDER

The C library's mathematics differ between systems in the last bit. Every count of collapses, every name and the number
of rows must be the same, medians within 1e-9 and EDPs within 1e-5 of the capacity. Prints how many tables there are and
the largest differences.
"""

import csv
import sys
from pathlib import Path

# Columns of numbers that are no counts, and how far they may differ: absolute and relative
MOST = {"theta": (0.0, 1e-9), "beta": (0.0, 1e-9), "edp": (1e-5, 0.0)}
# The last impacts of a motion that ends, and when a wall that hardly moves is where: they depend on the last bits
CHAOTIC = {"impacts", "time_of_peak_s"}
COUNTS = {"collapses", "histories", "fraction", "collapsed", "clusters", "status", "bracket_low", "bracket_high"}
OTHER = (1e-8, 1e-5)


def table(path: Path) -> list[list[str]]:
    """Rows of a table without its comments."""
    with path.open(encoding="utf-8", newline="") as file:
        return list(csv.reader(line for line in file if not line.startswith("#")))


def compare(ours: Path, theirs: Path, worst: dict[str, float]) -> list[str]:
    """What differs between two tables more than it may."""
    one, other = table(ours), table(theirs)
    if len(one) != len(other) or one[0] != other[0]:
        return [f"{ours.name}: other rows or columns"]
    found = []
    for number, (row, its) in enumerate(zip(one[1:], other[1:], strict=True), 1):
        for name, cell, other_cell in zip(one[0], row, its, strict=True):
            if cell == other_cell or name in CHAOTIC:
                continue
            absolute, relative = MOST.get(name, OTHER)
            try:
                a, b = float(cell), float(other_cell)
            except ValueError:
                a = b = float("nan")
            if name in MOST:
                difference = abs(a - b) / (abs(a) if relative else 1.0)
                worst[name] = max(worst.get(name, 0.0), difference)
            if name in COUNTS or not abs(a - b) <= max(absolute, relative * abs(a)):
                found.append(f"{ours.name}: row {number}, {name}: {cell} and {other_cell}")
    return found


def main(ours: Path, theirs: Path) -> int:
    """Compare all tables of two folders; number of differences."""
    tables = sorted(path.relative_to(ours) for path in ours.rglob("*.csv"))
    found = [f"{path}: only in one folder" for path in tables if not (theirs / path).exists()]
    worst: dict[str, float] = {}
    for path in tables:
        if (theirs / path).exists():
            found += compare(ours / path, theirs / path, worst)
    largest = ", ".join(f"{name} {value:.1e}" for name, value in worst.items())
    print(f"{len(tables)} tables; largest differences: {largest}")
    print(*found[:20], sep="\n")
    return len(found) + (not tables)


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1]), Path(sys.argv[2])) > 0)
