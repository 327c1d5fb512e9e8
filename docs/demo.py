"""One line for each curve of a run of the demo: python demo.py PREFIX."""

import csv
import json
import sys
from pathlib import Path


def rows(path):
    """Rows of a table of results."""
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))


def curves(prefix):
    """Median and dispersion of the curves of collapse: of walls, or of a population but not of its groups."""
    typology = Path(f"{prefix}_typology.csv")
    several = rows(typology if typology.is_file() else f"{prefix}_fragility.csv")
    # Damage states come before collapse, which is the last of each.
    return {
        row["mechanism"] if typology.is_file() else row["wall"]: (row["theta"], row["beta"])
        for row in several
        if not row.get("group")
    }


def main():
    """Print the title of the run, and its curves or its one history."""
    prefix = sys.argv[1]
    run = json.loads(Path(f"{prefix}_run.json").read_text(encoding="utf-8"))
    print(run["settings"]["job"]["title"])
    if history := run.get("history"):
        outcome = "collapse" if history["collapsed"] else f"no collapse, largest EDP {history['edp']:.3f}"
        print(f"   {history['record']}, scaled by {history['scale']:.3f}: {outcome}, {history['impacts']} impacts")
        return
    for name, (theta, beta) in curves(prefix).items():
        print(f"   {name:<20} theta {float(theta):.3f} g, beta {float(beta):.3f}")


if __name__ == "__main__":
    main()
