"""Histories on which accuracy is assessed: walls, two sets of accelerograms, and functions to run them."""

import csv
import subprocess
import tempfile
from dataclasses import dataclass, replace
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
TABLES = ROOT / "test" / "reference"

WALLS = {
    "one_sided": "mechanism = 'one_sided' height = 3.0 thickness = 0.25",
    "two_block": "mechanism = 'two_block' height = 3.0 thickness = 0.25 hinge = 0.6 restitution_factor = 0.87",
    "free_standing": "mechanism = 'free_standing' height = 2.0 thickness = 0.5",
}

# Walls with loads: a mass that goes with the wall; the hinge by crushing, the mass only lifted; a storey above
LOADED_WALLS = {
    "one_sided_loaded": "mechanism = 'one_sided' height = 3.0 thickness = 0.25 load = 10.0e3 load_depth = 0.175 "
    "load_height = 3.0 load_inertia = 'both'",
    "one_sided_crushed": "mechanism = 'one_sided' height = 3.0 thickness = 0.25 load = 10.0e3 load_depth = 0.175 "
    "load_height = 3.0 load_inertia = 'vertical' compressive_strength = 1.0e6",
    "two_block_loaded": "mechanism = 'two_block' height = 3.0 thickness = 0.25 hinge = 0.6 overburden = 5.0e3 "
    "overburden_inertia = 1.0",
}
LOADED_STRIPES = dict.fromkeys(LOADED_WALLS, "first = 0.2 last = 1.0 count = 5") | {
    "two_block_loaded": "first = 0.5 last = 1.5 count = 5"
}

# Walls of the dense grid of levels, where a run at a tight tolerance replaces the reference
DENSE_WALLS = WALLS | {"two_block, factor 1": "mechanism = 'two_block' height = 3.0 thickness = 0.25 hinge = 0.6"}
DENSE_LEVELS = "first = 0.02 last = 1.0 count = 50"


@dataclass(frozen=True)
class Motions:
    """A set of accelerograms and the levels of peak ground acceleration, in g, to which they are scaled."""

    catalogue: Path
    stripes: str


def motions(records):
    """Available sets: synthetic ones are part of dondolo, recorded ones are in a folder provided by the user."""
    sets = {"synthetic": Motions(ROOT / "data" / "records" / "synthetic44.csv", "first = 0.1 last = 1.0 count = 10")}
    if (Path(records) / "italy44.csv").is_file():
        recorded = Motions((Path(records) / "italy44.csv").resolve(), "first = 0.05 last = 1.0 count = 20")
        sets = {"recorded": recorded} | sets
    return sets


def reference_motions(records, wall):
    """The sets with the levels of the tables of a wall."""
    return {
        name: replace(each, stripes=LOADED_STRIPES.get(wall, each.stripes)) for name, each in motions(records).items()
    }


def write_case(folder, wall, motions, rtol, threads=1, solver=""):
    """Write the case of all histories of a wall into a folder, and return its path."""
    path = Path(folder) / "case.nml"
    path.write_text(
        f"&job task = 'stripes' output = '{folder}/result' threads = {threads} /\n"
        f"&wall {(DENSE_WALLS | LOADED_WALLS)[wall]} /\n"
        f"&records catalogue = '{motions.catalogue}' /\n"
        f"&stripes {motions.stripes} /\n"
        f"&solver rtol = {rtol} atol = {rtol / 100.0} {solver} /\n",
        encoding="utf-8",
    )
    return path


def run(executable, wall, motions, rtol, threads=1, solver=""):
    """Run all histories of a wall; return the rows of the tables of histories, stripes and fit, and the output."""
    with tempfile.TemporaryDirectory() as folder:
        case = write_case(folder, wall, motions, rtol, threads, solver)
        printed = subprocess.run([executable, case], check=True, capture_output=True, text=True).stdout
        names = ("histories", "stripes", "fragility")
        return {name: read_table(f"{folder}/result_{name}.csv") for name in names} | {"printed": printed}


def read_table(path):
    """Read the rows of one of dondolo's tables."""
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(line for line in file if not line.startswith("#")))
