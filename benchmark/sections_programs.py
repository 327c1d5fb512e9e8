"""dondolo and other programs on the same histories."""

import figures
from markdown import bullets, many, paragraph, small, table

SHARE, WRONG = 0.01, 1  # what an acceptable setting may have: histories off by more than 1e-6, wrong flags

METHODS = [
    "*C++ by hand*: a Nyström step of order four from sample to sample, or several; events by Newton's method on the "
    "step.",
    "*Boost.odeint*: its Dormand-Prince stepper, controlled and cut at every sample, or with free steps and dense "
    "output. *SUNDIALS*: ARKODE's Dormand-Prince pair and CVODE's Adams method with their own root finding, stopped at "
    "every sample, or free. Debian's builds of the library.",
    "*heyoka*: Taylor's method with its own events, from Python, one history after the other or in lanes. "
    "*numbalsoda*: compiled by Numba as a whole, sample by sample.",
    "*SciPy*: `solve_ivp` with events, from sample to sample, or over the whole record; the right-hand side compiled. "
    "*GNU Octave*: `ode45` with events over the whole record, and with steps no longer than a sample.",
]


def acceptable(result):
    """Is a setting accurate enough to be compared?"""
    return result.share <= SHARE and result.flags <= WRONG


def chosen(results):
    """The cheapest acceptable setting of a program, or the one with the fewest errors."""
    good = [each for each in results if acceptable(each)]
    if good:
        return min(good, key=lambda each: each.ms_of_all)
    return min(results, key=lambda each: (each.flags / each.histories + each.share, each.ms_of_all))


def by_program(results):
    """{program: its results}, in their order."""
    found = {}
    for each in results:
        found.setdefault(each.program, []).append(each)
    return found


def settings(results):
    """Every program at every setting."""
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
    """The section."""
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
            "the peak where q' = 0, the motion after the record by its energy. Those of one language share the source "
            "of what is not integration. All run on one core; times are medians, of the integration alone."
        ),
        *bullets(METHODS),
        *paragraph(
            f"Versions: {'; '.join(versions)}. {'; '.join(machine)}. Absolute tolerances are a hundredth of the "
            "relative ones, in units of the capacity."
        ),
        *paragraph(
            "Slow programs run on a part of the histories. Their times are divided by how much longer rk45, which runs "
            "history by history, takes for a history of that part than for one of all."
        ),
        "![error against time per history](figures/performance_work.png)",
        "",
    ]
    head = ["program", "setting", "histories", "ms a history", "wrong flags", "> 1e-6", "worst", "median"]
    for name in dict.fromkeys(each.wall for each in results):
        own = [each for each in results if each.wall == name]
        lines += [*paragraph(f"`{name}`, {own[0].accelerograms} accelerograms"), *table(head, settings(own))]
    return lines + ratios(first)


def ratios(results):
    """How much faster dondolo is."""
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
            f"Each program's cheapest setting with at most {100 * SHARE:g} % of the EDPs off by more than 1e-6 and at "
            f"most {many(WRONG, 'wrong flag')}, or, if it has none, its most accurate one; and how many times the time "
            "of dondolo's engines, at their defaults and at a tight tolerance, it takes:"
        ),
        *table(["program", "setting", "ms", "errors", *heads], rows),
    ]
