"""Comparison of a run of the benchmark with earlier ones."""

import statistics

import numpy as np
from markdown import many, paragraph, table
from rounds import ROUNDS
from runs import earlier, together


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
    stated = together(runs[other] for other in others)
    found = [each for each in runs[run] if each.name in stated]
    agree = sum(each.agrees(stated[each.name]) for each in found)
    closely = sum(each.agrees_closely(stated[each.name]) for each in found)
    by_chance, closely_by_chance = chances(len(others))
    lines += paragraph(
        f"Earlier runs are those of the same commit ({run.commit}), compiler options, processor, version and build "
        "variant in `benchmark/runs.csv`. A machine that is shared is more alike within the minutes of a run than from "
        "one run to the next: the spread of the earlier runs is that of all their rounds. A ratio agrees if the median "
        "of this run lies between their least and their largest value, closely if it lies between the least lower and "
        f"the largest upper quartile that one of them has. Of runs that differ by chance alone {by_chance} % of the "
        f"ratios would agree and {closely_by_chance} % closely (simulated, {sum(ROUNDS)} normal errors a run)."
    )
    lines += paragraph(
        f"{agree} of {many(len(found), 'ratio')} agree with {many(len(others), 'earlier run')}, {closely} of them "
        "closely."
    )
    body = []
    for other in others:
        before = {each.name: each.spread for each in runs[other]}
        apart = [abs(difference(each, before[each.name])) for each in found if each.name in before]
        body.append([other.date, f"{statistics.median(apart):.1f} %", f"{max(apart):.1f} %"])
    lines += table(["earlier run", "median difference", "largest difference"], body)
    body = [
        [
            each.name,
            each.spread.stated(),
            stated[each.name].stated(),
            f"{difference(each, stated[each.name]):+.1f} %",
            "closely" if each.agrees_closely(stated[each.name]) else "yes" if each.agrees(stated[each.name]) else "no",
        ]
        for each in found
    ]
    return lines + table(["ratio", run.date, "earlier runs", "difference", "agree"], body)


def difference(mine, stated):
    """By how much the median of a ratio is larger than that of earlier runs [%]."""
    return 100.0 * (mine.spread.median / stated.median - 1.0)


def chances(earlier_runs, trials=20000):
    """Parts of ratios that agree, and closely, with some earlier runs if all differ by normal errors alone [%]."""
    values = np.random.default_rng(7).normal(size=(trials, earlier_runs + 1, sum(ROUNDS)))
    median = np.median(values[:, 0], axis=1)
    before = values[:, 1:]
    least, largest = before.min(axis=(1, 2)), before.max(axis=(1, 2))
    lower, upper = np.quantile(before, [0.25, 0.75], axis=2)
    return tuple(
        round(100.0 * float(np.mean((low <= median) & (median <= high))))
        for low, high in ((least, largest), (lower.min(axis=1), upper.max(axis=1)))
    )
