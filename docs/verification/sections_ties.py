"""A facade with two ties, section 10: errors of both engines in every history of some levels.

python sections_ties.py RECORDS writes this section of docs/studies/verification.md alone.
"""

import sys
import warnings

import numpy as np
from cases import ROOT, motions, read_table
from markdown import paragraph, power, small, table
from sections_accuracy import LARGE, demand
from study import DEFAULT, TIGHTEST
from two_ties import PATH, facade

import dondolo as dd

TITLE = "## 10. A facade with two ties"
PAGE = ROOT / "docs" / "studies" / "verification.md"
MOST = 0.01  # share of EDPs with errors above LARGE
RUNS = [(engine, rtol) for engine in ("lanes", "rk45") for rtol in (DEFAULT, TIGHTEST)]


class Level:
    """The histories of one level in 33 digits, and how far a run is off."""

    def __init__(self, rows):
        self.level = float(rows[0]["im_level"])
        self.names = [row["record"] for row in rows]
        self.edp, self.scale = (np.array([float(row[name]) for row in rows]) for name in ("edp", "scale"))
        self.computable = np.array([row["status"] == "quadruple" for row in rows])
        self.change = max(float(row["edp_change"]) for row in rows)

    def errors(self, records, engine, rtol):
        """Errors of the EDPs, which flags are wrong, and which EDPs are doubted."""
        told = dd.multiple_stripe(
            facade(),
            records,
            [self.level],
            estimate_error=True,
            progress=False,
            solver=dd.Solver(engine=engine, rtol=rtol, atol=rtol / 100.0),
        )
        demand(list(told.record_names) == self.names, "the table has the records of the set")
        demand(np.array_equal(told.scale[0], self.scale), "the table has the factors of the stripe")
        wrong = told.collapsed[0] != (self.edp >= 1.0)
        return np.abs(told.edp[0] - self.edp), wrong, told.edp_error[0] > LARGE


def ties(folder):
    """Lines of the section."""
    records = dd.read_catalogue(motions(folder)["recorded"].catalogue)
    rows = read_table(PATH)
    levels = [
        Level([row for row in rows if row["im_level"] == text]) for text in dict.fromkeys(r["im_level"] for r in rows)
    ]
    number, moving = len(rows), sum(np.count_nonzero(each.edp > 0.0) for each in levels)
    collapses = sum(np.count_nonzero(each.edp >= 1.0) for each in levels)
    unsettled = sum(np.count_nonzero(~each.computable) for each in levels)
    computable = np.concatenate([each.computable for each in levels])
    lines = []
    for engine, rtol in RUNS:
        error, wrong, doubted = (
            np.concatenate(parts)
            for parts in zip(*(each.errors(records, engine, rtol) for each in levels), strict=True)
        )
        off = error > LARGE
        cells = [f"{off.sum()} ({100.0 * off.mean():.1f} %)", (off & computable).sum()]
        cells += [
            f"{np.count_nonzero(off & doubted)}, {np.count_nonzero(~off & doubted)}",
            small(error[computable].max()),
        ]
        met = "met" if not wrong.any() and off.mean() <= MOST else "missed"
        lines.append([engine, power(rtol), wrong.sum(), *cells, met])
    grid = ", ".join(f"{each.level:g}" for each in levels)
    return [
        TITLE,
        "",
        *paragraph(
            "A facade of 9 m by 0.5 m with ties at 8.5 and 5.5 m (docs/verification/two_ties.py), under the 44 "
            f"recorded accelerograms at {grid} g. All {number} histories ran in 33 digits: {moving} move, {collapses} "
            f"collapse, and {unsettled} are not computable. *Found* are EDPs with errors above 1e-6 that the estimated "
            "error finds, *false* its false alarms; the largest error is that of the computable ones. No flag may be "
            f"wrong, and at most {100.0 * MOST:.0f} % of all EDPs may be off by more than 1e-6."
        ),
        *table(["engine", "rtol", "wrong flags", "> 1e-6", "computable", "found, false", "largest", ""], lines),
    ]


def main():
    """Replace the section."""
    warnings.simplefilter("ignore", dd.errors.DondoloWarning)
    before = PAGE.read_text(encoding="utf-8").split(TITLE)[0].rstrip()
    PAGE.write_text(before + "\n\n" + "\n".join(ties(sys.argv[1])).rstrip() + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
