"""Further walls, section 9: errors of both engines, and what the estimated error finds of them.

python sections_walls.py RECORDS writes this section of docs/studies/verification.md alone.
"""

import sys
import warnings
from pathlib import Path

import numpy as np
from cases import ROOT, TABLES, motions, read_table
from markdown import paragraph, small, table
from more_walls import more_walls
from sections_accuracy import LARGE

import dondolo as dd

TITLE = "## 9. Further walls"
PAGE = ROOT / "docs" / "studies" / "verification.md"
ENGINES = ("lanes", "rk45")


def rates(wall, records, rows, engine):
    """Wrong flags, EDPs off by more than 1e-6, those found, false alarms, and the errors of the computable ones."""
    told = [
        dd.simulate(
            wall,
            records[row["record"]],
            float(row["scale"]),
            history=False,
            estimate_error=True,
            solver=dd.Solver(engine=engine),
        )
        for row in rows
    ]
    exact = np.array([float(row["edp"]) for row in rows])
    error = np.abs(np.array([one.edp for one in told]) - exact)
    doubted = np.array([one.edp_error for one in told]) > LARGE
    wrong = np.array([one.collapsed for one in told]) != (exact >= 1.0)
    computable = np.array([row["status"] == "quadruple" for row in rows])
    counts = [wrong.sum(), (error > LARGE).sum(), ((error > LARGE) & doubted).sum(), ((error <= LARGE) & doubted).sum()]
    return np.array(counts), error[computable].max()


def walls(folder):
    """Lines of the section."""
    sets = motions(folder)
    records = {name: {one.name: one for one in dd.read_catalogue(each.catalogue)} for name, each in sets.items()}
    tables = {name: read_table(Path(TABLES) / f"walls_{name}.csv") for name in sets}
    change = max(float(row["edp_change"]) for rows in tables.values() for row in rows if row["status"] == "quadruple")
    lines = []
    for name, wall in more_walls().items():
        mine = {where: [row for row in rows if row["wall"] == name] for where, rows in tables.items()}
        every = [row for rows in mine.values() for row in rows]
        collapses = sum(float(row["edp"]) >= 1.0 for row in every)
        cells = [f"`{name}`", len(every), collapses, sum(row["status"] == "not_computable" for row in every)]
        for engine in ENGINES:
            found = [rates(wall, records[where], rows, engine) for where, rows in mine.items()]
            counts = sum(each[0] for each in found)
            cells += [", ".join(map(str, counts)), small(max(each[1] for each in found))]
        lines.append(cells)
    number = sum(map(len, tables.values()))
    unsettled = sum(row["status"] == "not_computable" for rows in tables.values() for row in rows)
    head = ["wall", "histories", "collapse", "not computable"]
    head += [text for engine in ENGINES for text in (f"{engine}: flags, EDPs, found, false", "largest error")]
    return [
        TITLE,
        "",
        *paragraph(
            "Twelve more walls ([walls.csv](../../test/reference/walls.csv)) are slender and squat, small and large, "
            "with hinges at 0.35 to 0.85 of the height, loads beside the axis, and restitutions of up to 0.995. Each "
            f"runs under every second record of both sets with a random factor, {number} histories. In 33 digits two "
            f"tolerances agree to {small(change)}, but for {unsettled} histories that the last digit of the factor "
            "decides. Columns of an engine have the wrong flags, the EDPs with errors above 1e-6, those that the "
            "estimated error finds, and its false alarms; the largest error is that of the computable histories."
        ),
        *table(head, lines),
        *paragraph(
            "[test_certificates](../../python/tests/test_certificates.py) runs every third history; "
            "docs/verification/more_walls.py writes the tables."
        ),
    ]


def main():
    """Replace the section."""
    warnings.simplefilter("ignore", dd.errors.DondoloWarning)
    before, _, there = PAGE.read_text(encoding="utf-8").partition(TITLE)
    _, mark, after = there.partition("\n## ")
    section = "\n".join(walls(sys.argv[1])).rstrip() + "\n"
    PAGE.write_text(before.rstrip() + "\n\n" + section + mark + after, encoding="utf-8")


if __name__ == "__main__":
    main()
