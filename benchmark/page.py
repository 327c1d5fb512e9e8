"""Write docs/performance.md and its figures from the tables in out/benchmark: python page.py."""

import csv

from problem import ROOT
from programs import read_results
from sections_programs import programs
from sections_scaling import scaling


def write(folder):
    """Write the page and its figures."""
    results = read_results(folder / "programs.csv")
    machine = (folder / "machine.txt").read_text(encoding="utf-8").splitlines()
    with open(folder / "scaling.csv", newline="", encoding="utf-8") as file:
        numbers = ("size", "histories", "value")
        rows = [row | {what: float(row[what]) for what in numbers} for row in csv.DictReader(file)]
    lines = [
        "# Performance",
        "",
        "Time against error for the histories of [verification.md](verification.md). Written by `./run benchmark`.",
        "",
        *programs(results, machine),
        *scaling(rows),
    ]
    (ROOT / "docs" / "performance.md").write_text("\n".join(lines).rstrip() + "\n", encoding="utf-8")


if __name__ == "__main__":
    write(ROOT / "out" / "benchmark")
