"""Comparison of a run of the benchmark with earlier ones."""

import statistics

import numpy as np
from markdown import many, paragraph, table
from rounds import ROUNDS
from runs import Figure, earlier, together
from spread import Spread


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
        "variant in `benchmark/runs.csv`. Their spread is that of all their rounds: the median of their medians, the "
        "least lower and the largest upper quartile that one of them has, and the least and the largest value. A ratio "
        "agrees if each median, of this run and of the earlier ones, lies between the least and the largest value of "
        "the other, closely if it lies between the quartiles. Of runs that differ by chance alone "
        f"{by_chance} % of the ratios would agree and {closely_by_chance} % closely (simulated, {sum(ROUNDS)} normal "
        "errors a run)."
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
