"""Comparison of a run of the benchmark with earlier ones."""

import statistics

from markdown import many, paragraph, table
from runs import earlier, pairs

# Two samples of seven values of one normal distribution, by simulation
BY_CHANCE, CLOSELY_BY_CHANCE = 87, 45


def earlier_runs(runs, run):
    """Section 3. Runs as {run: ratios}, among them this one."""
    lines = ["## 3. Earlier runs", ""]
    if not run.is_committed:
        return lines + paragraph("This run is of sources that were not committed, and is not compared with others.")
    others = earlier(runs, run)
    if not others:
        return lines + paragraph(
            "`benchmark/runs.csv` has no earlier run of the same commit, compiler options, processor, version and "
            "build variant."
        )
    found = runs[run]
    latest = others[0]
    lines += paragraph(
        f"Runs of the same commit ({run.commit}), compiler options, processor, version and build variant in "
        "`benchmark/runs.csv`. A ratio of two runs agrees if each median lies between the least and the largest value "
        "of the other, closely if it lies between the quartiles. Of runs that differ by chance alone, with seven "
        f"rounds each, {BY_CHANCE} % of the ratios agree and {CLOSELY_BY_CHANCE} % closely (simulated, normal errors)."
    )
    body = []
    for other in others:
        common = pairs(found, runs[other])
        agree = sum(mine.agrees(theirs) for mine, theirs in common)
        closely = sum(mine.agrees_closely(theirs) for mine, theirs in common)
        apart = [abs(difference(mine, theirs)) for mine, theirs in common]
        count = f"{agree} of {many(len(common), 'ratio')}"
        body.append([other.date, count, closely, f"{statistics.median(apart):.1f} %", f"{max(apart):.1f} %"])
    lines += table(["earlier run", "agree", "closely", "median difference", "largest difference"], body)
    body = [
        [
            mine.name,
            mine.spread.stated(),
            theirs.spread.stated(),
            f"{difference(mine, theirs):+.1f} %",
            "closely" if mine.agrees_closely(theirs) else "yes" if mine.agrees(theirs) else "no",
        ]
        for mine, theirs in pairs(found, runs[latest])
    ]
    return lines + table(["ratio", f"{run.date}", f"{latest.date}", "difference", "agree"], body)


def difference(mine, theirs):
    """By how much the median of a ratio is larger than that of an earlier run [%]."""
    return 100.0 * (mine.spread.median / theirs.spread.median - 1.0)
