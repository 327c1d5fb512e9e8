"""A study of many walls, small but in many blocks, for tests that stop and share out runs."""

import csv
import math
import re
from pathlib import Path

import numpy as np

import dondolo as dd

ROOT = Path(__file__).resolve().parents[2]
WALLS = 60
LEVELS = np.linspace(0.1, 1.6, 12)


def arguments(**changes) -> dict:
    """What `dd.typology` gets; some walls have twice as many histories as others."""
    rng = np.random.default_rng(7)
    kinds = (dd.OneSidedWall, dd.TwoBlockWall, dd.FreeStandingWall)
    walls = [
        kinds[i % 3](rng.uniform(1.5, 4.5), rng.choice([0.25, 0.38, 0.51]), name=f"wall {i:02}") for i in range(WALLS)
    ]
    given = {
        "population": dd.Population(walls, rng.uniform(0.5, 2.0, WALLS)),
        "records": dd.read_catalogue(ROOT / "data/records/synthetic44.csv")[::8],
        "levels": LEVELS,
        "polarity": "both",
        "edp_thresholds": [0.1, 0.4],
        "progress": False,
    }
    return given | changes


def write(typology: dd.results.Typology, folder: Path) -> None:
    """All tables and arrays."""
    folder.mkdir(parents=True, exist_ok=True)
    for table in ("typology", "fragility", "stripes", "walls"):
        typology.to_csv(folder / f"{table}.csv", table)
    (folder / "flags").write_bytes(typology.flags.bits.tobytes())
    (folder / "collapses").write_bytes(typology.collapses.tobytes())
    (folder / "work").write_text(repr(typology.work))


def nameless(path: Path) -> str:
    """A result file without the name of its run, which nothing depends on."""
    return re.sub(r"\b\d{8}T\d{6}Z-[0-9a-f]{16}\b", "", path.read_text())


def contents(folder: Path) -> dict[str, bytes]:
    """The bytes of all that was written."""
    return {file.name: file.read_bytes() for file in folder.iterdir()}


def same_but_rounding(mine, theirs):
    """Whether lines of two tables are the same but for the last digits of numbers.

    Standard errors of curves are sums that Fortran and NumPy take in another order.
    """
    if len(mine) != len(theirs):
        return False
    names = next(csv.reader(mine))
    tiny = dict.fromkeys(names, 0.0)
    for one, two in zip(csv.reader(mine), csv.reader(theirs), strict=True):
        row = dict(zip(names, one, strict=True))
        # Terms of a covariance may cancel: they are as large as the product of the standard errors.
        if row.get("cov_ln_theta_beta") not in (None, "", "cov_ln_theta_beta"):
            tiny["cov_ln_theta_beta"] = 1e-13 * float(row["se_ln_theta"]) * float(row["se_beta"])
        if len(one) != len(two) or not all(map(_same_cell, one, two, tiny.values())):
            return False
    return True


def same_tables(table, mine, theirs):
    """Whether lines of two result tables are the same; standard errors of curves, and unions, but for last digits."""
    if table not in ("fragility", "typology", "unions"):
        return mine == theirs
    exact = True
    if table == "typology":
        count = next(csv.reader(mine)).index("se_ln_theta")
        rows = [[row[:count] for row in csv.reader(lines)] for lines in (mine, theirs)]
        exact = rows[0] == rows[1]
    return exact and same_but_rounding(mine, theirs)


def _same_cell(one, two, tiny):
    if one == two:
        return True
    try:
        # A whole number by one sum may be none by the other.
        mine, theirs = float(one), float(two)
        return math.isclose(mine, theirs, rel_tol=1e-13, abs_tol=tiny) and (
            mine != theirs or one.isdigit() == two.isdigit()
        )
    except ValueError:
        return False
