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
    "*C++ by hand*: one or several Nyström steps of order four from sample to sample; events by Newton's method.",
    "*Boost.odeint*: Dormand-Prince stepper, with steps that end at every sample (cut), or free steps and dense "
    "output. *SUNDIALS*: ARKODE's Dormand-Prince pair and CVODE's Adams method with their own root finding.",
    "*heyoka*: Taylor's method with its own events, called from Python, one history after the other or in lanes; *own* "
    "is the time within the library's steps. *numbalsoda*: the whole program compiled by Numba.",
    "*SciPy*: `solve_ivp` with events; the right-hand side is compiled. *GNU Octave*: `ode45` with events and an "
    "interpreted right-hand side.",
]


def settings(results):
    """Rows of every program at every setting, of dondolo at its default and at a tight tolerance."""
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
        if each.program != "dondolo" or each.setting in (1e-8, 1e-12)
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
            "Every program computes the same motion (theory.md, sections 1 to 4); those in one language share all "
            "source but the integration. C++, heyoka and Numba are compiled for the processor at hand; dondolo is a "
            "portable binary. All run on one core, in a warm process, without reading and compilation. Times are those "
            "of all histories: of dondolo a call of `multiple_stripe` from Python, of heyoka, SciPy and GNU Octave "
            "with their interpreted loop."
        ),
        *bullets(METHODS),
        *paragraph(
            f"Versions: {'; '.join(versions)}. {'; '.join(machine)}. Absolute tolerances are one hundredth of the "
            "relative ones, in units of the capacity."
        ),
        *paragraph(
            f"Slow programs run only a part of the histories, and their times are scaled by the evaluations of rk45: "
            f"{parts(first)}. The figure has every setting of `{wall}`; a front joins the settings that no other of "
            "dondolo, or of the other programs, beats in both time and error."
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
        relative = {engine: ratio(turns, key, under, what) for engine, under in engines.items()}
        rows.append(
            [
                name,
                f"{best.method}, {best.setting:g}",
                rounded(Spread.of(times.values()).median, 3),
                f"{best.above} of {best.histories}, {many(best.flags, 'wrong flag')}",
                *(one.stated() if engine == "lanes" else rounded(one.median, 3) for engine, one in relative.items()),
            ]
        )
    rounds = max(turn.round for turn in turns)
    heads = [f"times `{engine}`" for engine in engines]
    return [
        *paragraph(
            f"Of `{results[0].wall}`, for each program the cheapest setting with at most {100 * SHARE:g} % of the EDPs "
            f"with an error above 1e-6 and at most {many(WRONG, 'wrong flag')}, or else its most accurate setting. *As "
            "accurate*, where that is another one, is the cheapest with no more wrong flags, no larger share of errors "
            f"above 1e-6 and at most {WORST:g} times the largest error of `lanes` at its defaults. These settings ran "
            f"in {many(rounds, 'round')} in which every program has its turn, the median of the calls that fit in "
            f"{TURN:g} s; programs beyond {SLOWEST:g} s have none. The last columns are the times relative to those of "
            "dondolo's engines in the same round, at their defaults and at a tight tolerance: medians, and for `lanes` "
            "also lower to upper quartile and in brackets the least and the largest of the rounds."
        ),
        *table(["program", "setting", "ms for all histories", "errors", *heads], rows),
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
        f"The {histories} histories take the engine `lanes` {warm} ms in a warm call from Python, of which the "
        f"histories themselves are {ratio(turns, lanes, lanes, 'own').times(100.0).stated()} %. As many histories that "
        f"never move take {still.stated()} ms, {ratio(turns, (STILL, 1e-8), lanes).times(100.0).stated()} % of it. "
        f"The command `dondolo CASE.nml` takes {whole} ms with reading and writing, its histories {cold} ms."
    )
    if core_of(turns):
        lines += paragraph(
            f"Each turn waited up to {WAIT:g} s for a core that other programs left alone; if that core was shared at "
            f"its end it was taken again, {TRIES} times at most. A shared core does as few as half of the independent "
            "additions in the time of a multiplication that waits for the one before; here they were "
            f"{core_of(turns).stated()}."
        )
    loop = times_of(turns, LIMIT, 0.0).values()
    if not loop:
        return lines
    lines += paragraph(
        "To compare machines, a loop of 3.24e6 times 90 fused multiplications and additions in the widest vectors of "
        f"the processor takes {Spread.of(loop).stated()} ms in the same rounds; the call from Python takes "
        f"{ratio(turns, lanes, (LIMIT, 0.0)).stated()} times as long."
    )
    lines += paragraph(
        "`dondolo --benchmark` counts the multiplications and additions of the engine's steps, not those of impacts "
        "and starts (one thread, embedded synthetic accelerograms):"
    )
    lines += table(
        ["mechanism", "% of the operations per second of the loop, which counts a fused one as two"],
        [[f"`{mechanism}`", share.times(100.0).stated()] for mechanism, share in shares(turns).items()],
    )
    return [*lines, "![share of the arithmetic limit by mechanism](../figures/performance_arithmetic.png)", ""]


def speeds(results, turns, machine):
    """The speeds of the README, from the same rounds."""
    processor = machine[0].partition(": ")[2].partition(",")[0].replace("(R)", "")
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
        f"{mine.histories} time histories of one wall under {mine.accelerograms} accelerograms take {median} ms on one "
        f"core ({processor}, {mine.version.rpartition(' ')[2]}). That is {', '.join(words)}, each at its cheapest "
        "setting that is accurate enough."
    )
    return paragraph(sentence, indent="  ")[:-1]
