"""Count the lines that tests have run: python line_coverage.py FOLDER (see line_coverage.sh)."""

import json
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]


def fortran_lines() -> tuple[int, int]:
    """Lines of the library that ran, and all that a compiler makes code of, by gcov."""
    ran: dict[tuple[str, int], bool] = {}
    for data in sorted(ROOT.glob("build/**/src_*.gcda")):
        command = ["gcov", "--json-format", "--stdout", data.name]
        done = subprocess.run(command, cwd=data.parent, capture_output=True, text=True, check=True)
        for text in done.stdout.splitlines():
            for source in json.loads(text)["files"]:
                # A submodule or a generic may be compiled in several objects.
                for line in source["lines"]:
                    place = (source["file"], line["line_number"])
                    ran[place] = ran.get(place, False) or line["count"] > 0
    return sum(ran.values()), len(ran)


def python_lines(path: Path) -> tuple[int, int]:
    """Lines of the package that ran, and all statements, by coverage.py."""
    totals = json.loads(path.read_text())["totals"]
    return totals["covered_lines"], totals["num_statements"]


def main(folder: Path) -> None:
    """Print the shares of both languages, and that of all their lines."""
    counts = {"Fortran": fortran_lines()}
    if (folder / "python.json").exists():
        counts["Python"] = python_lines(folder / "python.json")
    counts = {name: pair for name, pair in counts.items() if pair[1] > 0}
    if len(counts) > 1:
        counts["both"] = (sum(ran for ran, _ in counts.values()), sum(lines for _, lines in counts.values()))
    for name, (ran, lines) in counts.items():
        print(f"{name:<8} {ran:6d} of {lines:6d} lines: {ran / lines:.1%}")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
