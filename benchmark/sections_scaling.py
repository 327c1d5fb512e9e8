"""Scaling with threads and sizes, and memory."""

import cost_model
from beside import FACADES, FIXED, PAIRS, STRIPS, WALLS
from markdown import paragraph, table
from populations import KINDS
from scaling import VARIANTS, spread_of


def scaling(rows):
    """Section 2."""
    lines = [
        "## 2. Threads, sizes, memory",
        "",
        *paragraph(
            "The default engine with the embedded synthetic accelerograms, at 20 levels unless stated otherwise. "
            "Strong scaling has a fixed population of walls, weak scaling one that grows with the threads; "
            "efficiencies are relative to one thread in the same turn. Lines are the growth fitted below."
        ),
        "![threads, sizes, memory](../figures/performance_scaling.png)",
        "",
    ]
    head = ["scaling", "threads", "histories", "s", "histories per second", "efficiency"]
    body = []
    for kind in ("strong", "weak"):
        efficiencies = {r["size"]: r for r in rows if r["kind"] == f"{kind} efficiency"}
        for r in (r for r in rows if r["kind"] == kind):
            rate = r["histories"] / r["median"]
            gain = efficiencies[r["size"]]
            work = [f"{r['histories']:g}", spread_of(r).stated(), f"{rate:.3g}"]
            body.append([kind, f"{r['size']:g}", *work, spread_of(gain).stated(2)])
    lines += table(head, body)
    lines += model(rows)
    gains = [spread_of(row).stated(2) for row in rows if row["kind"] == "variant speed-up"]
    own = [row for row in rows if row["kind"] == "variant"]
    body = [[VARIANTS[int(r["size"])], per_history(r), gain] for r, gain in zip(own, gains, strict=True)]
    lines += table(["build variant", "ms per history", "speed-up"], body)
    body = [[f"{r['histories']:g}", f"{r['median']:.1f}"] for r in rows if r["kind"] == "memory" and r["median"] > 0.0]
    lines += table(["histories", "peak memory, MiB"], body)
    return lines + populations(rows) + kinds(rows) + facades(rows) + strips(rows) + fixed(rows)


def per_history(row):
    """Spread of the milliseconds per history."""
    return spread_of(row).times(1e3 / row["histories"]).stated()


def populations(rows):
    """Populations of each kind: cost of a wall, growth, memory."""
    own = {kind: [r for r in rows if r["kind"] == f"population, {kind}"] for kind in KINDS}
    lines = paragraph(
        "Populations of each kind, at two levels under 44 accelerograms, on one thread, each size once. The exponent "
        "is that of the growth of the time with the number of walls."
    )
    body = []
    for kind, found in own.items():
        peaks = [r["median"] for r in rows if r["kind"] == f"population memory, {kind}"]
        last = found[-1]
        exponent = cost_model.growth(rows, f"population, {kind}")[1]
        counts = f"{found[0]['size']:g} to {last['size']:g}"
        cost = f"{1e3 * last['median'] / last['size']:.3g}"
        body.append([kind, counts, cost, f"{exponent:.2f}", f"{peaks[0]:.0f} to {peaks[-1]:.0f}"])
    return lines + table(["population", "walls", "ms per wall, last size", "exponent", "peak memory, MiB"], body)


def kinds(rows):
    """Kinds of walls beside the facade, as they are and per sample interval of rocking; none in files of before."""
    own = [row for row in rows if row["kind"] == "kind"]
    if not own:
        return []
    lines = paragraph(
        "Kinds of walls at the same levels, in turns on one thread; ratios are to the facade in the same turn. Walls "
        "that survive rock longer than walls that fall: the last column is per sample interval in which a wall rocks."
    )
    gains, per_sample = ([r for r in rows if r["kind"] == f"kind ratio{what}"] for what in ("", " per sample"))
    body = [
        [list(WALLS)[int(row["size"])], per_history(row), spread_of(gain).stated(), spread_of(one).stated()]
        for row, gain, one in zip(own, gains, per_sample, strict=True)
    ]
    return lines + table(["wall", "ms per history", "ratio", "ratio per interval of rocking"], body)


def facades(rows):
    """Ties, friction and moving supports beside the bare wall."""
    lines = paragraph(
        "A facade of 9 m by 0.5 m, bare, with ties at 8.5, 5.5 and 2.5 m, with the friction of transverse walls, and "
        "on the ground in front of a building (period 0.3 s), in turns on one thread; ratios are to the bare facade in "
        "the same turn."
    )
    return lines + in_turns(rows, "facade", list(FACADES))


def strips(rows):
    """Joints that bend beside rigid blocks; none in files of before."""
    if not any(row["kind"] == "strip" for row in rows):
        return []
    lines = paragraph(
        "A strip of 2.85 m by 0.21 m under 21 kN/m, of rigid blocks and with joints that bend before they open "
        "(`elastic_period`), at 26 levels of PGA from 0.3 to 3.3 g, in turns on one thread; ratios are to the rigid "
        "strip in the same turn."
    )
    lines += in_turns(rows, "strip", list(STRIPS))
    gains = {name: [r for r in rows if r["kind"] == f"strip, {name} ratio"] for name in PAIRS}
    body = [[name, spread_of(found[1]).stated()] for name, found in gains.items() if found]
    return lines + table(["the strip with a period of 0.1 s beside the rigid one", "ratio"], body)


def in_turns(rows, kind, names):
    """Walls of a kind that took turns, with their ratios to the first."""
    gains = [spread_of(row).stated() for row in rows if row["kind"] == f"{kind} ratio"]
    own = [row for row in rows if row["kind"] == kind]
    body = [[names[int(r["size"])], per_history(r), gain] for r, gain in zip(own, gains, strict=True)]
    return table([kind, "ms per history", "ratio"], body)


def fixed(rows):
    """What costs the same for few histories and many."""
    lines = paragraph("What no history takes, each in a process that has done it before, but for the imports:")
    names = list(FIXED)
    own = [(names[int(row["size"])], row) for row in rows if row["kind"] == "fixed"]
    body = [[name, FIXED[name], spread_of(row).times(1e3).stated()] for name, row in own]
    return lines + table(["work", "what", "ms"], body)


def model(rows):
    """The fitted cost model in words."""
    (call, record, history), error = cost_model.of_call(rows)
    walls, shocks, samples = (cost_model.growth(rows, kind)[1] for kind in ("walls", "shocks", "samples"))
    serial = cost_model.serial_share(rows)
    text = (
        f"A call takes {1e3 * call:.2g} ms + {1e3 * record:.2g} ms for each record + {1e3 * history:.2g} ms for each "
        f"history on one thread (least squares over the rows of records and levels; the largest error is "
        f"{100 * error:.0f} %). The time grows with the walls to the power {walls:.2f}, with the length of the records "
        f"to {shocks:.2f} and with their sampling to {samples:.2f}."
    )
    if serial is not None:
        text += f" By Amdahl's law {100 * serial:.0f} % of a population are not divided among threads."
    return paragraph(text)
