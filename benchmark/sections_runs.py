"""Comparison of a run of the benchmark with earlier ones."""

import statistics

from markdown import many, paragraph, table
from runs import earlier, pairs
from spread import rounded

# Two samples of seven values of one normal distribution, by simulation
BY_CHANCE = 45


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
        "`benchmark/runs.csv`. A ratio of two runs agrees if each median lies between the quartiles of the other. "
        f"Quartiles hold half of the rounds: of runs that differ by chance alone, {BY_CHANCE} % of the ratios agree "
        "with seven rounds each (simulated, normal errors). All rounds of a run share its "
        "processes, so that what differs from process to process does not show in its quartiles. How far two runs "
        "are apart is the difference of their medians."
    )
    body = []
    for other in others:
        common = pairs(found, runs[other])
        agree = sum(mine.agrees(theirs) for mine, theirs in common)
        apart = [abs(difference(mine, theirs)) for mine, theirs in common]
        count = f"{agree} of {many(len(common), 'ratio')}"
        body.append([other.date, count, f"{statistics.median(apart):.1f} %", f"{max(apart):.1f} %"])
    lines += table(["earlier run", "agree", "median difference", "largest difference"], body)
    body = [
        [
            mine.name,
            stated(mine),
            stated(theirs),
            f"{difference(mine, theirs):+.1f} %",
            "yes" if mine.agrees(theirs) else "no",
        ]
        for mine, theirs in pairs(found, runs[latest])
    ]
    return lines + table(["ratio", f"{run.date}", f"{latest.date}", "difference", "agree"], body)


def difference(mine, theirs):
    """By how much the median of a ratio is larger than that of an earlier run [%]."""
    return 100.0 * (mine.median / theirs.median - 1.0)


def stated(figure):
    """Median and quartiles of a ratio."""
    median, lower, upper = (rounded(value, 3) for value in (figure.median, figure.lower, figure.upper))
    return f"{median}, {lower} to {upper}"
