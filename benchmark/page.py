"""Write docs/studies/performance.md, its figures and the speeds in two pages from out/benchmark: python page.py."""

import re

import figures
import runs
from problem import ROOT
from programs import read_results
from rounds import read_rounds, shares
from scaling import read_scaling
from sections_programs import programs, speeds
from sections_runs import earlier_runs
from sections_scaling import scaling

# What this writes is between these lines; all else on the page stays.
BEGIN, END = "<!-- begin: written by ./run benchmark -->", "<!-- end: written by ./run benchmark -->"


def write(tables, root=ROOT, log=runs.FILE):
    """Write the page, its figures and the speeds in the README under a root, from tables and the file of all runs."""
    results = read_results(tables / "programs.csv")
    turns = read_rounds(tables / "rounds.csv")
    rows = read_scaling(tables / "scaling.csv")
    machine = (tables / "machine.txt").read_text(encoding="utf-8").splitlines()
    own = runs.read(tables / "run.csv")
    first = [each for each in results if each.wall == results[0].wall]
    folder = root / "docs" / "figures"
    figures.work(folder, first)
    figures.arithmetic(folder, shares(turns))
    figures.scaling(folder, rows)
    sections = [
        *programs(results, turns, machine),
        *scaling(rows),
        *earlier_runs(runs.read(log) | own, next(iter(own))),
    ]
    replace_between(root / "docs" / "studies" / "performance.md", sections)
    # Within a paragraph, where a mark must not begin a line
    for place in ("README.md", "docs/performance.md"):
        replace_between(root / place, speeds(results, turns, machine), around="")


def replace_between(path, lines, around="\n"):
    """Replace what is between the marks of a page."""
    text = path.read_text(encoding="utf-8")
    body = around + "\n".join(lines).strip() + around
    found = re.subn(f"{BEGIN}.*?{END}", lambda _: f"{BEGIN}{body}{END}", text, flags=re.DOTALL)
    if found[1] != 1:
        raise SystemExit(f"{path}: must have one pair of the lines {BEGIN} and {END}")
    path.write_text(found[0], encoding="utf-8")


if __name__ == "__main__":
    write(ROOT / "out" / "benchmark")
