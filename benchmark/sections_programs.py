"""Comparison of dondolo with other programs on the same histories."""

import figures
from markdown import bullets, many, paragraph, small, table

SHARE, WRONG = 0.01, 1  # acceptable share of histories with an error above 1e-6, acceptable number of wrong flags

METHODS = [
    "*C++ by hand*: one or several Nyström steps of order four from sample to sample; events by Newton's method on the "
    "step.",
    "*Boost.odeint*: Dormand-Prince stepper, with controlled steps that end at every sample, or with free steps and "
    "dense output. *SUNDIALS*: ARKODE's Dormand-Prince pair and CVODE's Adams method with their own root finding, "
    "stopped at every sample, or free. The libraries are Debian's builds.",
    "*heyoka*: Taylor's method with its own events, called from Python, one history after the other or in lanes. "
    "*numbalsoda*: the whole program compiled by Numba, sample by sample.",
    "*SciPy*: `solve_ivp` with events, from sample to sample or over the whole record; the right-hand side is "
    "compiled. *GNU Octave*: `ode45` with events over the whole record, or with steps no longer than a sample.",
]


def acceptable(result):
    """Whether a setting is accurate enough to be compared."""
    return result.share <= SHARE and result.flags <= WRONG


def chosen(results):
    """Cheapest acceptable setting of a program, or the one with the fewest errors."""
    good = [each for each in results if acceptable(each)]
    if good:
        return min(good, key=lambda each: each.ms_of_all)
    return min(results, key=lambda each: (each.flags / each.histories + each.share, each.ms_of_all))


def by_program(results):
    """Results as {program: results}, in their order."""
    found = {}
    for each in results:
        found.setdefault(each.program, []).append(each)
    return found


def settings(results):
    """Rows of every program at every setting."""
    return [
        [
            each.name,
            f"{each.setting:g}",
            each.histories,
            f"{each.ms_of_all:.3g}",
            each.flags,
            each.above,
            small(each.worst),
            small(each.median),
        ]
        for each in results
    ]


def programs(results, machine):
    """Section 1."""
    wall = results[0].wall
    first = [each for each in results if each.wall == wall]
    figures.work(first)
    versions = dict.fromkeys(
        f"dondolo {each.version}" if each.program == "dondolo" else each.version for each in results
    )
    lines = [
        "## 1. Other programs",
        "",
        *paragraph(
            "Every program computes the same motion (theory.md, sections 1 to 4): accelerograms linear between their "
            "samples, rocking from the exact crossing of the trigger, impacts, the rule that ends a chain of bounces, "
            "the peak at q' = 0, and the motion after the record by its energy. Programs in the same language share "
            "all source except the integration. All run on one core; times are medians of the integration alone."
        ),
        *bullets(METHODS),
        *paragraph(
            f"Versions: {'; '.join(versions)}. {'; '.join(machine)}. Absolute tolerances are one hundredth of the "
            "relative ones, in units of the capacity."
        ),
        *paragraph(
            "Slow programs run only a part of the histories. Their times are divided by the ratio of the mean times "
            "per history that rk45, which runs history by history, needs for that part and for all histories."
        ),
        "![error against time per history](figures/performance_work.png)",
        "",
    ]
    head = ["program", "setting", "histories", "ms per history", "wrong flags", "> 1e-6", "worst", "median"]
    for name in dict.fromkeys(each.wall for each in results):
        own = [each for each in results if each.wall == name]
        lines += [*paragraph(f"`{name}`, {own[0].accelerograms} accelerograms"), *table(head, settings(own))]
    return lines + ratios(first)


def ratios(results):
    """Table of the times of other programs relative to dondolo."""
    engines = [each for each in results if each.program == "dondolo"]
    defaults = [each for each in engines if each.setting == 1e-8]
    tight = [each for each in engines if each.method == "lanes" and each.setting == 1e-12]
    rows = []
    for program, own in by_program(results).items():
        if program == "dondolo":
            continue
        best = chosen(own)
        rows.append(
            [
                program,
                f"{best.name.partition(', ')[2]}, {best.setting:g}",
                f"{best.ms_of_all:.3g}",
                f"{best.above} of {best.histories}, {many(best.flags, 'wrong flag')}",
                *(f"{best.ms_of_all / each.ms_of_all:.3g}" for each in defaults + tight),
            ]
        )
    heads = [f"times `{each.method}`" for each in defaults] + [f"times `{each.method}`, 1e-12" for each in tight]
    return [
        *paragraph(
            f"The table gives each program's cheapest setting with at most {100 * SHARE:g} % of the EDPs with an error "
            f"above 1e-6 and at most {many(WRONG, 'wrong flag')}, or, if there is none, its most accurate setting. The "
            "last columns are its time relative to that of dondolo's engines, at their defaults and at a tight "
            "tolerance:"
        ),
        *table(["program", "setting", "ms", "errors", *heads], rows),
    ]
