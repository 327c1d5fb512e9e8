"""Comparison of a run of the benchmark with earlier ones."""

import statistics

import numpy as np
from markdown import many, paragraph, table
from rounds import ROUNDS
from runs import QUIET, Figure, earlier, is_quiet, together, unrest
from spread import Spread


def earlier_runs(runs, run):
    """Section 3. Runs as {run: ratios}, among them this one."""
    lines = ["## 3. Earlier runs", ""]
    if not run.is_committed:
        return lines + paragraph("This run is of sources that were not committed, and is not compared with others.")
    lines += paragraph(
        f"Earlier runs in `benchmark/runs.csv` are of the same commit ({run.commit}), options, processor and build "
        "variant. Runs that other programs disturbed are listed, and not compared: the quartiles of half of their "
        f"ratios are farther apart than {100.0 * QUIET:g} % of the median. In this run they are within "
        f"{apart(runs[run])}."
    )
    if not is_quiet(runs[run]):
        return lines + paragraph("**This run was disturbed**, and is not compared with others.")
    others = earlier(runs, run)
    if not others:
        return lines + paragraph("There is no earlier run.")
    quiet = [other for other in others if is_quiet(runs[other])]
    lines += table(
        ["earlier run", "quartiles within", "median difference", "largest difference"],
        [
            [other.date, apart(runs[other]), *(differences(runs, run, other) if other in quiet else ["disturbed", ""])]
            for other in others
        ],
    )
    return lines + (comparison(runs, run, quiet) if quiet else [])


def comparison(runs, run, others):
    """How many ratios of a run agree with those of other runs, and those that do not."""
    stated = together(runs[other] for other in others)
    found = [each for each in runs[run] if each.name in stated]
    agree = sum(each.agrees(stated[each.name]) for each in found)
    closely = sum(each.agrees_closely(stated[each.name]) for each in found)
    by_chance, closely_by_chance = chances(len(others))
    lines = paragraph(
        "A ratio agrees if the medians of both lie within the range of the other, closely if within the quartiles. By "
        f"chance alone {by_chance} % of the ratios would agree and {closely_by_chance} % closely (simulated, "
        f"{sum(ROUNDS)} normal errors a run)."
    )
    lines += paragraph(
        f"{agree} of {many(len(found), 'ratio')} agree with {many(len(others), 'earlier run')}, {closely} of them "
        "closely."
    )
    body = [
        [each.name, each.spread.stated(), stated[each.name].stated(), f"{difference(each, stated[each.name]):+.1f} %"]
        for each in found
        if not each.agrees(stated[each.name])
    ]
    if not body:
        return lines
    return lines + paragraph("Those that do not:") + table(["ratio", run.date, "earlier runs", "difference"], body)


def apart(found):
    """How far apart the quartiles of half of the ratios are at most, in words."""
    return f"{100.0 * unrest(found):.1f} %"


def differences(runs, run, other):
    """Median and largest difference between the ratios of two runs, in words."""
    before = {each.name: each.spread for each in runs[other]}
    found = [abs(difference(each, before[each.name])) for each in runs[run] if each.name in before]
    return [f"{statistics.median(found):.1f} %", f"{max(found):.1f} %"]


def difference(mine, stated):
    """By how much the median of a ratio is larger than that of earlier runs [%]."""
    return 100.0 * (mine.spread.median / stated.median - 1.0)


def chances(earlier_runs, trials=4000):
    """Parts of ratios that agree, and closely, with some earlier runs if all differ by normal errors alone [%]."""
    generator = np.random.default_rng(7)
    agree = closely = 0
    for _ in range(trials):
        mine, *before = (
            Figure("", Spread.of(generator.normal(size=sum(ROUNDS)).tolist())) for _ in range(earlier_runs + 1)
        )
        stated = together([each] for each in before)[""]
        agree += mine.agrees(stated)
        closely += mine.agrees_closely(stated)
    return round(100.0 * agree / trials), round(100.0 * closely / trials)
