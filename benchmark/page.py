"""Write docs/performance.md, its figures and the speeds in README.md from out/benchmark: python page.py."""

import csv
import re

from problem import ROOT
from programs import read_results
from rounds import read_rounds
from scaling import VALUES
from sections_programs import programs, speeds
from sections_scaling import scaling

# What this writes stands between these lines; all else on the page stays.
BEGIN, END = "<!-- begin: written by ./run benchmark -->", "<!-- end: written by ./run benchmark -->"


def write(folder):
    """Write the page, its figures and the speeds in the README."""
    results = read_results(folder / "programs.csv")
    turns = read_rounds(folder / "rounds.csv")
    machine = (folder / "machine.txt").read_text(encoding="utf-8").splitlines()
    with open(folder / "scaling.csv", newline="", encoding="utf-8") as file:
        numbers = ("size", "histories", *VALUES)
        rows = [row | {what: float(row[what]) for what in numbers} for row in csv.DictReader(file)]
    replace_between(ROOT / "docs" / "performance.md", [*programs(results, turns, machine), *scaling(rows)])
    # Within a paragraph, where a mark must not begin a line
    replace_between(ROOT / "README.md", speeds(results, turns), around="")


def replace_between(path, lines, around="\n"):
    """Replace what stands between the marks of a page."""
    text = path.read_text(encoding="utf-8")
    body = around + "\n".join(lines).strip() + around
    found = re.subn(f"{BEGIN}.*?{END}", lambda _: f"{BEGIN}{body}{END}", text, flags=re.DOTALL)
    if found[1] != 1:
        raise SystemExit(f"{path}: must have one pair of the lines {BEGIN} and {END}")
    path.write_text(found[0], encoding="utf-8")


if __name__ == "__main__":
    write(ROOT / "out" / "benchmark")
