"""Compare the tables of two systems: python same_results.py FOLDER FOLDER [--again PROGRAM PROGRAM]

The C library's mathematics differ between systems in the last bit. Every count of collapses, every name and the number
of rows must be the same, medians within 1e-9 and EDPs within 1e-5 of the capacity. Prints how many tables there are and
the largest differences.

Some motions magnify the last bit beyond that, also between the build variants of one system. With the programs that
made the tables, each one argument with its words as a shell reads them, the ready cases of such rows run again with
`estimate_error`: a row may differ more if both programs call it ill-conditioned, repeat its EDP to the digit, and
estimate errors that explain the difference. Each is printed.
"""

import argparse
import csv
import json
import re
import shlex
import subprocess
import sys
import tempfile
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


class Programs:
    """The two programs that made the tables, to ask how sure they are of an EDP."""

    def __init__(self, commands: list[str], folder: Path):
        self.commands = [shlex.split(command) for command in commands]
        self.folder = folder
        self.estimates: dict[str, list[tuple[float, list[dict[str, str]]]]] = {}

    def ask(self, case: str) -> list[tuple[float, list[dict[str, str]]]]:
        """Of both: the error above which an EDP is ill-conditioned, and the rows of a ready case with their errors."""
        if case not in self.estimates:
            self.estimates[case] = [self.run(command, case, i) for i, command in enumerate(self.commands)]
        return self.estimates[case]

    def run(self, command: list[str], case: str, number: int) -> tuple[float, list[dict[str, str]]]:
        """The same of one of them."""
        folder = self.folder / f"{case}_{number}"
        folder.mkdir()
        printed = subprocess.run([*command, "--example", case], capture_output=True, check=True)
        text = printed.stdout.decode().replace("\r", "")
        text, given = re.subn(r"^&solver\b", "&solver\n   estimate_error = .true.", text, flags=re.MULTILINE)
        if not given:
            text += "&solver\n   estimate_error = .true.\n/\n"
        text = re.sub(r"output *= *'[^']*'", "output = 'again'", text)
        (folder / "case.nml").write_text(text, encoding="utf-8", newline="\n")
        subprocess.run([*command, "--quiet", "case.nml"], cwd=folder, capture_output=True, check=True)
        warnings = json.loads((folder / "again_run.json").read_text(encoding="utf-8"))["warnings"]
        limits = [warning["numbers"]["limit"] for warning in warnings if warning["code"] == "ill_conditioned"]
        head, *rows = table(folder / "again_histories.csv")
        return min(limits, default=float("inf")), [dict(zip(head, row, strict=True)) for row in rows]

    def explain(self, case: str, number: int, edps: list[str]) -> str | None:
        """Why the EDPs of a row, counted from 1, may differ; None if they may not."""
        difference = abs(float(edps[0]) - float(edps[1]))
        errors = []
        for edp, (limit, rows) in zip(edps, self.ask(case), strict=True):
            error = float(rows[number - 1]["edp_error"])
            # That of the same motion, and in doubt
            if rows[number - 1]["edp"] != edp or not error > limit:
                return None
            errors.append(error)
        if not difference <= sum(errors):
            return None
        return (
            f"{case}: row {number} is ill-conditioned by either program: {edps[0]} and {edps[1]}, "
            f"estimated errors {errors[0]:.1e} and {errors[1]:.1e}"
        )


def compare(
    ours: Path, theirs: Path, worst: dict[str, float], programs: Programs | None
) -> tuple[list[str], list[str]]:
    """What differs between two tables more than it may, and what may differ because it is ill-conditioned."""
    one, other = table(ours), table(theirs)
    if len(one) != len(other) or one[0] != other[0]:
        return [f"{ours.name}: other rows or columns"], []
    found, explained = [], []
    case = ours.name.removesuffix("_histories.csv")
    for number, (row, its) in enumerate(zip(one[1:], other[1:], strict=True), 1):
        for name, cell, other_cell in zip(one[0], row, its, strict=True):
            if cell == other_cell or name in CHAOTIC:
                continue
            absolute, relative = MOST.get(name, OTHER)
            try:
                a, b = float(cell), float(other_cell)
            except ValueError:
                a = b = float("nan")
            is_close = abs(a - b) <= max(absolute, relative * abs(a))
            if name == "edp" and abs(a - b) > absolute and programs and case != ours.name:
                why = programs.explain(case, number, [cell, other_cell])
                if why:
                    explained.append(why)
                    continue
            if name in MOST:
                difference = abs(a - b) / (abs(a) if relative else 1.0)
                worst[name] = max(worst.get(name, 0.0), difference)
            if name in COUNTS or not is_close:
                found.append(f"{ours.name}: row {number}, {name}: {cell} and {other_cell}")
    return found, explained


def main(ours: Path, theirs: Path, programs: Programs | None = None) -> int:
    """Compare all tables of two folders; number of differences."""
    tables = sorted(path.relative_to(ours) for path in ours.rglob("*.csv"))
    found = [f"{path}: only in one folder" for path in tables if not (theirs / path).exists()]
    explained: list[str] = []
    worst: dict[str, float] = {}
    for path in tables:
        if (theirs / path).exists():
            differences, reasons = compare(ours / path, theirs / path, worst, programs)
            found += differences
            explained += reasons
    largest = ", ".join(f"{name} {value:.1e}" for name, value in worst.items())
    print(f"{len(tables)} tables; largest differences: {largest}; {len(explained)} ill-conditioned rows differ more")
    print(*explained, *found[:20], sep="\n")
    return len(found) + (not tables)


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("folders", nargs=2, type=Path)
    parser.add_argument("--again", nargs=2, metavar="PROGRAM")
    given = parser.parse_args()
    with tempfile.TemporaryDirectory() as place:
        sys.exit(main(*given.folders, Programs(given.again, Path(place)) if given.again else None) > 0)
