"""Comparison of dondolo with other programs on the same histories."""

from cores import TRIES, WAIT
from markdown import bullets, many, paragraph, small, table
from rounds import (
    COLD,
    LIMIT,
    SHARE,
    SLOWEST,
    STILL,
    TURN,
    WORST,
    WRONG,
    compared,
    core_of,
    ratio,
    references,
    shares,
    times_of,
)
from spread import Spread, rounded

METHODS = [
    "*C++ by hand*: one or several Nyström steps of order four from sample to sample; events by Newton's method on the "
    "step.",
    "*Boost.odeint*: Dormand-Prince stepper, with controlled steps that end at every sample, or with free steps and "
    "dense output. *SUNDIALS*: ARKODE's Dormand-Prince pair and CVODE's Adams method with their own root finding, "
    "stopped at every sample, or free.",
    "*heyoka*: Taylor's method with its own events, called from Python, one history after the other or in lanes; *own* "
    "is the time within the library's steps. *numbalsoda*: the whole program compiled by Numba, sample by sample.",
    "*SciPy*: `solve_ivp` with events, from sample to sample or over the whole record; the right-hand side is "
    "compiled. *GNU Octave*: `ode45` with events over the whole record, or with steps no longer than a sample.",
]


def settings(results):
    """Rows of every program at every setting."""
    return [
        [
            each.name,
            f"{each.setting:g}",
            each.histories,
            rounded(each.ms_of_all, 3),
            each.flags,
            each.above,
            small(each.worst),
            small(each.median),
        ]
        for each in results
    ]


def programs(results, turns, machine):
    """Section 1."""
    wall = results[0].wall
    first = [each for each in results if each.wall == wall]
    versions = dict.fromkeys(each.version for each in results)
    lines = [
        "## 1. Other programs",
        "",
        *paragraph(
            "Every program computes the same motion (theory.md, sections 1 to 4). Programs in the same language share "
            "all source except the integration. Those in C++, heyoka and Numba are compiled for the processor at hand; "
            "dondolo's are portable binaries, of which the engine `lanes` chooses the variant that fits. All run on "
            "one core, in a warm process: reading and compilation are over before the clock starts. Times hold the "
            "integration of all histories: of dondolo a call of `multiple_stripe` from Python, of heyoka and SciPy "
            "with their loop in Python, of GNU Octave with an interpreted right-hand side as well."
        ),
        *bullets(METHODS),
        *paragraph(
            f"Versions: {'; '.join(versions)}. {'; '.join(machine)}. Absolute tolerances are one hundredth of the "
            "relative ones, in units of the capacity."
        ),
        *paragraph(
            f"Slow programs run only a part of the histories: {parts(first)}. Their times are divided by the ratio of "
            "the mean numbers of evaluations per history that rk45 needs for that part and for all histories. The "
            f"figure has every setting of `{wall}`; a front joins the settings that no other of dondolo, or of the "
            "other programs, beats in both time and error."
        ),
        "![error against time per history](../figures/performance_work.png)",
        "",
    ]
    head = ["program", "setting", "histories", "ms per history", "wrong flags", "> 1e-6", "worst", "median"]
    for name in dict.fromkeys(each.wall for each in results if each.wall != wall):
        own = [each for each in results if each.wall == name]
        lines += [*paragraph(f"`{name}`, {own[0].accelerograms} accelerograms"), *table(head, settings(own))]
    return lines + ratios(first, turns) + limits(first, turns)


def parts(results):
    """Programs that ran a part of the histories, in words."""
    most = max(each.histories for each in results)
    found = {}
    for each in results:
        if each.histories < most:
            found.setdefault((each.program, each.histories), []).append(each.method)
    words = (f"{name} ({', '.join(dict.fromkeys(methods))}) {n}" for (name, n), methods in found.items())
    return f"{'; '.join(words)} of {most}"


def ratios(results, turns):
    """Table of the times of other programs relative to dondolo, from the rounds."""
    engines = references(results)
    rows = []
    for name, best, what in compared(results):
        key = (best.name, best.setting)
        times = times_of(turns, *key, what)
        rows.append(
            [
                name,
                f"{best.method}, {best.setting:g}",
                Spread.of(times.values()).stated(),
                f"{best.above} of {best.histories}, {many(best.flags, 'wrong flag')}",
                len(set(times) - {0}) or "none",
                *(ratio(turns, key, under, what).stated() for under in engines.values()),
            ]
        )
    rounds = max(turn.round for turn in turns)
    heads = [f"times `{engine}`" for engine in engines]
    return [
        *paragraph(
            f"Of `{results[0].wall}`, for each program the cheapest setting with at most {100 * SHARE:g} % of the EDPs "
            f"with an error above 1e-6 and at most {many(WRONG, 'wrong flag')}, or, if there is none, its most "
            "accurate setting. *As accurate* is the cheapest with no more wrong flags, no larger share of errors above "
            f"1e-6 and at most {WORST:g} times the largest error of `lanes` at its defaults, where that is another "
            f"one. These settings ran in {many(rounds, 'round')}, in which every program has its turn, in a new "
            f"process. A turn is as many calls as fit in {TURN:g} s, and counts by their median; a program that takes "
            f"more than {SLOWEST:g} s has none. The last columns are the times relative to those of dondolo's engines "
            "in the same round, at their defaults and at a tight tolerance. Times and ratios are median, lower to "
            "upper quartile, and in brackets the least and the largest of the rounds."
        ),
        *table(["program", "setting", "ms for all histories", "errors", "rounds", *heads], rows),
    ]


def limits(results, turns):
    """What dondolo's own times hold, and how far they are from the limit of the processor."""
    lanes = references(results)["lanes"]
    histories = next(each.histories for each in results if each.name == lanes[0])
    still = Spread.of(times_of(turns, STILL, 1e-8).values())
    warm, whole, cold = (
        Spread.of(times_of(turns, *key).values()).stated() for key in (lanes, (COLD, 1e-8), (COLD, 1e-8, "own"))
    )
    lines = paragraph(
        f"The {histories} histories take the engine `lanes` {warm} ms in a call from Python that is warm, of which the "
        f"histories themselves are {ratio(turns, lanes, lanes, 'own').times(100.0).stated()} %. Calls of as many "
        f"histories that never move take {still.stated()} ms each, "
        f"{ratio(turns, (STILL, 1e-8), lanes).times(100.0).stated()} % of it. "
        f"The whole command `dondolo CASE.nml` takes {whole} ms, with reading and writing; its histories take {cold} "
        "ms of it."
    )
    if core_of(turns):
        lines += paragraph(
            f"Each turn ran on the core that other programs left most of just before, and waited up to {WAIT:g} s for "
            f"one that they left alone; if that core was shared at its end it was taken again, {TRIES} times at most. "
            "A core that also runs a thread of another program does as few as half of the independent additions in the "
            f"time of a multiplication that waits for the one before; here they were {core_of(turns).stated()}."
        )
    loop = times_of(turns, LIMIT, 0.0).values()
    if not loop:
        return lines
    lines += paragraph(
        f"In the same rounds a loop of 3.24e6 times 90 fused multiplications and additions in the widest vectors of "
        f"the processor takes {Spread.of(loop).stated()} ms; the call from Python takes "
        f"{ratio(turns, lanes, (LIMIT, 0.0)).stated()} times as long. The loop measures the processor, so that "
        "machines can be compared."
    )
    lines += paragraph(
        "`dondolo --benchmark` counts the multiplications and additions of the engine's steps, a fused one as two, and "
        "ran on one thread in the same rounds, with the embedded synthetic accelerograms. Impacts, starts and all else "
        "that is no step are not counted."
    )
    lines += table(
        ["mechanism", "% of the operations per second of the loop"],
        [[f"`{mechanism}`", share.times(100.0).stated()] for mechanism, share in shares(turns).items()],
    )
    return [*lines, "![share of the arithmetic limit by mechanism](../figures/performance_arithmetic.png)", ""]


def speeds(results, turns):
    """The speeds of the README, from the same rounds."""
    first = [each for each in results if each.wall == results[0].wall]
    lanes = references(first)["lanes"]
    mine = next(each for each in first if each.name == lanes[0])
    factors = {}
    for name, best, what in compared(first):
        factors[name] = rounded(ratio(turns, (best.name, best.setting), lanes, what).median)
    words = [
        f"{factors[program]} times as fast as {program}{' called from Python' if program == 'heyoka' else ''}"
        for program in ("Boost.odeint", "heyoka", "SciPy")
        if program in factors
    ]
    median = rounded(Spread.of(times_of(turns, *lanes).values()).median, 3)
    sentence = (
        f"{mine.histories} time histories of one wall take {median} ms on one core. That is {', '.join(words)}, "
        "each at its cheapest setting that is accurate enough."
    )
    return paragraph(sentence, indent="  ")[:-1]
