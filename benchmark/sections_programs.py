"""Comparison of dondolo with other programs on the same histories."""

import statistics

import figures
from markdown import bullets, many, paragraph, small, table
from programs import DONDOLO, PEERS
from rounds import COLD, LIMIT, SHARE, SLOW, SLOWEST, TURN, WRONG, by_program, chosen, ratio, times_of

METHODS = [
    "*C++ by hand*: one or several Nyström steps of order four from sample to sample; events by Newton's method on the "
    "step.",
    "*Boost.odeint*: Dormand-Prince stepper, with controlled steps that end at every sample, or with free steps and "
    "dense output. *SUNDIALS*: ARKODE's Dormand-Prince pair and CVODE's Adams method with their own root finding, "
    "stopped at every sample, or free. The libraries are Debian's builds.",
    "*heyoka*: Taylor's method with its own events, called from Python, one history after the other or in lanes: its "
    "wheel has the library without the headers of its C++ interface, so that no program in C++ is built with it here; "
    "of the lanes the time within the library's own steps is given as well. "
    "*numbalsoda*: the whole program compiled by Numba, sample by sample.",
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
    figures.work(first)
    versions = dict.fromkeys(each.version for each in results)
    lines = [
        "## 1. Other programs",
        "",
        *paragraph(
            "Every program computes the same motion (theory.md, sections 1 to 4): accelerograms linear between their "
            "samples, rocking from the exact crossing of the trigger, impacts, the rule that ends a chain of bounces, "
            "the peak at q' = 0, and the motion after the record by its energy. Programs in the same language share "
            "all source except the integration. All run on one core, in a warm process: reading and compilation "
            "are over before the clock starts. Times are medians of several repeats where a program is not too slow "
            "for them; how much they vary is stated for the best settings below."
        ),
        *bullets(METHODS),
        *table(
            ["program", "its time holds"], {peer.name: [peer.name, peer.holds] for peer in (DONDOLO, *PEERS)}.values()
        ),
        *paragraph(
            f"Versions: {'; '.join(versions)}. {'; '.join(machine)}. Absolute tolerances are one hundredth of the "
            "relative ones, in units of the capacity."
        ),
        *paragraph(
            f"Slow programs run only a part of the histories: {parts(first)}. Their times are divided by the ratio of "
            "the mean times per history that rk45, which runs history by history, needs for that part and for all "
            "histories."
        ),
        "![error against time per history](figures/performance_work.png)",
        "",
    ]
    head = ["program", "setting", "histories", "ms per history", "wrong flags", "> 1e-6", "worst", "median"]
    for name in dict.fromkeys(each.wall for each in results):
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
    own = [(each.name, each.setting) for each in results if each.program == DONDOLO.name]
    engines = [each for each in own if each[1] == 1e-8]
    tight = ("dondolo, lanes", 1e-12)
    rows = []
    for program, several in by_program(results).items():
        if program == DONDOLO.name:
            continue
        best = chosen(several)
        key = (best.name, best.setting)
        errors = f"{best.above} of {best.histories}, {many(best.flags, 'wrong flag')}"
        for what, name in (("ms", program), *((("own", f"{program}, own steps"),) if best.own > 0.0 else ())):
            times = times_of(turns, *key, what)
            rows.append(
                [
                    name,
                    f"{best.name.partition(', ')[2]}, {best.setting:g}",
                    ranged(list(times.values())),
                    errors,
                    len(set(times) - {0}) or "none",
                    *(spread(*ratio(turns, key, under, what)) for under in (*engines, tight)),
                ]
            )
    heads = [f"times `{name.partition(', ')[2]}`" for name, _ in engines] + ["times `lanes`, 1e-12"]
    rounds = max(turn.round for turn in turns)
    return [
        *paragraph(
            f"For each program the cheapest setting with at most {100 * SHARE:g} % of the EDPs with an error above "
            f"1e-6 and at most {many(WRONG, 'wrong flag')}, or, if there is none, its most accurate setting. These "
            f"settings ran in {many(rounds, 'round')}, in which every program has its turn, each in a warm process. "
            "A third of the rounds ran before the second wall and the measurements of section 2, a third between them "
            f"and a third after both. A turn is as many calls as fit in {TURN:g} s, at least one, and counts by their "
            f"median. A program that takes more than {SLOW:g} s has one turn in each third; one that takes more than "
            f"{SLOWEST:g} s has none, nor has Octave, and its time of the table above is compared with all rounds of "
            "dondolo. The last columns are the times relative to those of dondolo's engines in the same round, at "
            "their defaults and at a tight tolerance: median, and in brackets the least and the largest of the rounds."
        ),
        *table(["program", "setting", "ms for all histories", "errors", "rounds", *heads], rows),
    ]


def ranged(values):
    """Median of some times, and in brackets the least and the largest."""
    return spread(statistics.median(values), min(values), max(values))


def spread(median, least, largest):
    """A ratio with its range over the rounds."""
    if least == largest:
        return rounded(median, 3)
    return f"{rounded(median, 3)} ({rounded(least, 3)} to {rounded(largest, 3)})"


def limits(results, turns):
    """What dondolo's own times hold, and how far they are from the limit of the processor."""
    lanes = ("dondolo, lanes", 1e-8)
    histories = next(each.histories for each in results if each.name == lanes[0])
    warm, cold = (list(times_of(turns, *key).values()) for key in (lanes, (COLD, 1e-8)))
    lines = paragraph(
        f"The {histories} histories take the engine `lanes` {ranged(warm)} ms in a call from Python that is warm. The "
        f"executable, started anew, needs {ranged(cold)} ms for the same, without the reading of the records before it."
    )
    loop = list(times_of(turns, LIMIT, 0.0).values())
    if not loop:
        return lines
    median, least, largest = ratio(turns, lanes, (LIMIT, 0.0))
    return lines + paragraph(
        f"In the same rounds a loop of 3.24e6 times 90 fused multiplications and additions in the widest vectors of "
        f"the processor, which computes nothing else, takes {ranged(loop)} ms. The call from Python takes "
        f"{spread(median, least, largest)} times as long. The loop measures the processor, so that machines can be "
        "compared; it is not a count of the operations of the histories."
    )


def speeds(results, turns):
    """The speeds of the README, from the same rounds."""
    first = [each for each in results if each.wall == results[0].wall]
    lanes = ("dondolo, lanes", 1e-8)
    mine = next(each for each in first if each.name == lanes[0])
    variant = mine.version.split()[-1]
    factors = []
    for program in ("Boost.odeint", "heyoka", "SciPy"):
        own = [each for each in first if each.program == program]
        if own:
            key = (chosen(own).name, chosen(own).setting)
            factors.append(f"{rounded(ratio(turns, key, lanes)[0])} times as fast as {program}")
            if chosen(own).own > 0.0:
                factors[-1] += f" called from Python ({rounded(ratio(turns, key, lanes, 'own')[0])} of its own steps)"
    times = times_of(turns, *lanes).values()
    sentence = (
        f"{mine.histories} time histories of one wall under recorded motions take "
        f"{rounded(statistics.median(times))} ms ({rounded(min(times))} to {rounded(max(times))}) on one core in a "
        f"call from Python (`{variant}`): {', '.join(factors)}, each at its cheapest setting that is accurate enough, "
        "all warm and in the same rounds."
    )
    return paragraph(sentence, indent="  ")[:-1]


def rounded(value, digits=2):
    """A number with so many digits that count, without an exponent."""
    return f"{float(f'{value:.{digits}g}'):.10g}"
