"""All runs reported in docs/studies/verification.md."""

import re
import statistics
import subprocess
import sys
import tempfile
from dataclasses import dataclass, field
from pathlib import Path

from cases import DENSE_LEVELS, DENSE_WALLS, TABLES, WALLS, Motions, motions, read_table, run, write_case
from histories import Errors, Histories

TOLERANCES = [10.0**-digits for digits in range(3, 14)]
DEFAULT, TIGHT, TIGHTEST = 1e-8, 1e-12, 1e-13
REPEATS = 3
# The engine that is verified here; docs/studies/performance.md compares the engine lanes with the same reference
ENGINE = "engine = 'rk45'"


@dataclass
class Study:
    """Results by (wall, set) and by the varied parameter."""

    exact: dict = field(default_factory=dict)  # (wall, set): histories of the reference
    made_with: dict = field(default_factory=dict)  # (wall, set): the line of the reference with its settings
    runs: dict = field(default_factory=dict)  # (wall, set, rtol): histories
    milliseconds: dict = field(default_factory=dict)  # (wall, set, rtol): time per history
    estimated: dict = field(default_factory=dict)  # (wall, set, rtol): histories with estimated errors
    dense: dict = field(default_factory=dict)  # wall: run and its errors on the dense grid of levels
    shortcuts: dict = field(default_factory=dict)  # wall: {shortcut: histories}

    def errors(self, wall, name, rtol):
        """Errors of a run."""
        return Errors(self.runs[wall, name, rtol], self.exact[wall, name])

    def pairs(self):
        """Walls and sets, the recorded set first."""
        return list(self.exact)

    def recorded(self):
        """Walls and the recorded set only."""
        return [pair for pair in self.pairs() if pair[1] == "recorded"]

    def estimate_errors(self, wall, name, rtol):
        """Errors of a run with estimated errors."""
        return Errors(self.estimated[wall, name, rtol], self.exact[wall, name])


def collect(executable, shortcuts, records):
    """Run the whole study."""
    sets = motions(records)
    if "recorded" not in sets:
        sys.exit(f"verification: {Path(records) / 'italy44.csv'} not found; set DONDOLO_RECORDS to its folder")
    study = Study()
    for name in sets:
        for wall in WALLS:
            read_reference(study, wall, name)
    # Repeat the whole series of tolerances, so that a disturbance does not affect only one of them.
    seconds = {}
    for repeat in range(REPEATS):
        for wall, name in study.pairs():
            for rtol in TOLERANCES:
                result = run(executable, wall, sets[name], rtol, solver=ENGINE)
                study.runs[wall, name, rtol] = Histories.of(result["histories"])
                found = re.search(r"histories in +(\S+) s", result["printed"]).group(1)
                seconds.setdefault((wall, name, rtol), []).append(float(found))
            print(f"round {repeat + 1} of {REPEATS}: {wall}, {name}", file=sys.stderr)
    for key, values in seconds.items():
        study.milliseconds[key] = 1e3 * statistics.median(values) / len(study.runs[key])
    for key in study.runs:
        if key[2] == DEFAULT or study.errors(*key).flags():
            result = run(executable, key[0], sets[key[1]], key[2], solver=f"{ENGINE} estimate_error = .true.")
            study.estimated[key] = Histories.of(result["histories"])
    dense = Motions(sets["recorded"].catalogue, DENSE_LEVELS)
    for wall in DENSE_WALLS:
        default = run(executable, wall, dense, DEFAULT, solver=f"{ENGINE} estimate_error = .true.")
        tight = run(executable, wall, dense, TIGHTEST, solver=ENGINE)
        runs = [Histories.of(each["histories"]) for each in (default, tight)]
        study.dense[wall] = (runs[0], Errors(*runs))
        print(f"dense grid: {wall}", file=sys.stderr)
    for wall in WALLS:
        study.shortcuts[wall] = run_shortcuts(shortcuts, wall, sets["recorded"])
        print(f"shortcuts: {wall}", file=sys.stderr)
    return study


def read_reference(study, wall, name):
    """Read a table of test/reference."""
    path = TABLES / f"{wall}_{name}.csv"
    if not path.is_file():
        sys.exit(f"verification: {path} not found; create it with ./run reference")
    study.exact[wall, name] = Histories.of(read_table(path))
    with open(path, encoding="utf-8") as file:
        study.made_with[wall, name] = next(line for line in file if "real128" in line)


def run_shortcuts(executable, wall, motions):
    """Histories of every shortcut at the default tolerances."""
    with tempfile.TemporaryDirectory() as folder:
        table = Path(folder) / "shortcuts.csv"
        with open(table, "w", encoding="utf-8") as file:
            subprocess.run([executable, write_case(folder, wall, motions, DEFAULT)], check=True, stdout=file)
        rows = {}
        for row in read_table(table):
            rows.setdefault(row["shortcut"], []).append(row)
    return {name: Histories.of(each) for name, each in rows.items()}
