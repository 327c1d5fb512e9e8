"""Comparison of a run of the benchmark with earlier ones."""

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
        "with seven rounds each (simulated, normal errors)."
    )
    body = []
    for other in others:
        common = pairs(found, runs[other])
        agree = sum(mine.agrees(theirs) for mine, theirs in common)
        body.append([other.date, f"{agree} of {many(len(common), 'ratio')}"])
    lines += table(["earlier run", "agree"], body)
    body = [
        [mine.name, stated(mine), stated(theirs), "yes" if mine.agrees(theirs) else "no"]
        for mine, theirs in pairs(found, runs[latest])
    ]
    return lines + table(["ratio", f"{run.date}", f"{latest.date}", "agree"], body)


def stated(figure):
    """Median and quartiles of a ratio."""
    median, lower, upper = (rounded(value, 3) for value in (figure.median, figure.lower, figure.upper))
    return f"{median}, {lower} to {upper}"
