"""Ratios of every full run, in runs.csv, and their comparison with earlier runs."""

import csv
import statistics
import subprocess
from dataclasses import astuple, dataclass, fields, replace
from datetime import UTC, datetime
from pathlib import Path

from beside import FACADES, STRIPS, WALLS
from problem import ROOT
from rounds import LIMIT, STILL, compared, core_of, ratio, references, shares, times_of
from scaling import VARIANTS, spread_of
from spread import NAMES, Spread

FILE = Path(__file__).resolve().parent / "runs.csv"
SOURCES = ("src", "app", "python", "benchmark", "meson.build", ":!benchmark/runs.csv")
UNCOMMITTED = "+"  # ends the commit of a run whose sources were not committed
QUIET = 0.1  # largest unrest of a run that other programs on the machine have not disturbed


@dataclass(frozen=True)
class Run:
    """Date of a run, and what it ran: runs are compared if all but the date agree."""

    date: str  # UTC
    commit: str
    processor: str
    variant: str
    compiler: str  # and its options
    version: str

    @property
    def is_committed(self):
        """Whether the commit says what was run."""
        return not self.commit.endswith(UNCOMMITTED)

    def is_comparable(self, other):
        """Whether another run is of the same sources, compiler and machine."""
        return self.is_committed and replace(other, date=self.date) == self


@dataclass(frozen=True)
class Figure:
    """A ratio of a run: its name and its spread over the rounds."""

    name: str
    spread: Spread

    def agrees(self, stated):
        """Whether each median, of this and of a stated spread, lies within the least and the largest of the other."""
        mine = self.spread
        return mine.least <= stated.median <= mine.largest and stated.least <= mine.median <= stated.largest

    def agrees_closely(self, stated):
        """Whether each median lies between the quartiles of the other."""
        mine = self.spread
        return mine.lower <= stated.median <= mine.upper and stated.lower <= mine.median <= stated.upper


def unrest(found):
    """How far apart the quartiles of a ratio are, relative to its median: the median of several ratios."""
    return statistics.median((each.spread.upper - each.spread.lower) / each.spread.median for each in found)


def is_quiet(found):
    """Whether the ratios of a run show that it was not disturbed."""
    return unrest(found) <= QUIET


def new_run(report):
    """Run of now, of an executable with this report of --benchmark."""
    date = datetime.now(UTC).strftime("%Y-%m-%dT%H:%M:%SZ")
    return Run(date, commit(), report.processor, report.variant, report.compiler, report.version)


def commit():
    """Latest commit that changed the sources, with UNCOMMITTED at its end if they differ from it or there is none."""
    try:
        found = git("log", "-1", "--format=%H", "--", *SOURCES)[:12]
        return found + (UNCOMMITTED if git("status", "--porcelain", "--", *SOURCES) else "")
    except (OSError, subprocess.CalledProcessError):
        return UNCOMMITTED


def git(*words):
    """What a command of git prints."""
    return subprocess.run(["git", *words], cwd=ROOT, check=True, capture_output=True, text=True).stdout.strip()


def figures(results, turns, rows):
    """Ratios of a run. A program without rounds has none."""
    first = [each for each in results if each.wall == results[0].wall]
    found = {}
    for name, best, what in compared(first):
        key = (best.name, best.setting)
        if set(times_of(turns, *key)) == {0}:
            continue
        for engine, under in references(first).items():
            found[f"{name} / {engine}"] = ratio(turns, key, under, what)
    lanes = references(first)["lanes"]
    found["histories / call from Python"] = ratio(turns, lanes, lanes, "own")
    found["call without motion / call from Python"] = ratio(turns, (STILL, 1e-8), lanes)
    if times_of(turns, LIMIT, 0.0):
        found["lanes / arithmetic limit"] = ratio(turns, lanes, (LIMIT, 0.0))
    if core_of(turns):
        found["additions / multiplication"] = core_of(turns)
    found |= {f"share of the arithmetic limit, {mechanism}": share for mechanism, share in shares(turns).items()}
    for row in rows:
        size = int(row["size"])
        if row["kind"] in ("strong efficiency", "weak efficiency") and size > 1:
            found[f"{row['kind']}, {size} threads"] = spread_of(row)
        if row["kind"] == "variant speed-up" and size > 0:
            found[f"speed-up of {VARIANTS[size]}"] = spread_of(row)
        if row["kind"] == "facade ratio" and size > 0:
            found[f"facade with {list(FACADES)[size]} / bare"] = spread_of(row)
        if row["kind"] == "strip ratio" and size > 0:
            found[f"strip, {list(STRIPS)[size]} / rigid"] = spread_of(row)
        if row["kind"] == "kind ratio" and size > 0:
            found[f"{list(WALLS)[size]} / facade"] = spread_of(row)
    return [Figure(name, Spread(*(float(f"{x:.4g}") for x in astuple(spread)))) for name, spread in found.items()]


COLUMNS = [field.name for field in fields(Run)] + ["figure", *NAMES]


def append(path, run, found):
    """Append the ratios of a run to a file, which is made if there is none."""
    is_new = not path.is_file()
    with open(path, "a", newline="", encoding="utf-8") as file:
        writer = csv.writer(file, lineterminator="\n")
        if is_new:
            writer.writerow(COLUMNS)
        writer.writerows([*astuple(run), each.name, *astuple(each.spread)] for each in found)


def read(path):
    """Ratios of the runs of a file, as {run: ratios}; none if there is no file."""
    found = {}
    if path.is_file():
        with open(path, newline="", encoding="utf-8") as file:
            header, *rows = csv.reader(file)
        if header != COLUMNS:
            raise SystemExit(f"{path}: its columns must be {', '.join(COLUMNS)}")
        about = len(fields(Run))
        for row in rows:
            spread = Spread(*map(float, row[about + 1 :]))
            found.setdefault(Run(*row[:about]), []).append(Figure(row[about], spread))
    return found


def earlier(runs, run):
    """Those of several runs that were before a run and can be compared with it, the latest first."""
    return sorted(
        (each for each in runs if each.date < run.date and run.is_comparable(each)),
        key=lambda each: each.date,
        reverse=True,
    )


def together(runs):
    """Spread of each ratio over all rounds of several runs, as {name: spread}.

    The median is that of the runs, the quartiles are the least and the largest that a run has.
    """
    spreads = {}
    for found in runs:
        for each in found:
            spreads.setdefault(each.name, []).append(each.spread)
    return {
        name: Spread(
            statistics.median(each.median for each in several),
            min(each.lower for each in several),
            max(each.upper for each in several),
            min(each.least for each in several),
            max(each.largest for each in several),
        )
        for name, several in spreads.items()
    }
