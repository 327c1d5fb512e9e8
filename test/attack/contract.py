"""Plain columns laid out by chance: each is read with the values that it was made of, or refused.

The motion is known; the file wraps it, adds times, other quantities, counts, steps, factors, marks of missing values,
titles and remarks in any order, and the caller gives what belongs to it. Another value than that of the motion is a
failure, and so is a record of a column that is no acceleration.
"""

from __future__ import annotations

import random
import subprocess
import sys
import warnings
from collections.abc import Callable
from math import cos, exp, sin
from pathlib import Path

STEPS = (0.005, 0.01, 0.02)
# Lines above the values that say nothing false; {n} is the number of values, {dt} their step
TRUE = (
    "# dt: {dt}",
    "dt = {dt} s",
    "# npts: {n}",
    "# units: m/s2",
    "Acceleration in m/s2",
    "# event: Valley 3",
    "{n} {dt}",
    "{n}",
    "{dt}",
    "# duration: {length} s",
    "# PGA: {peak} m/s2",
    "# filter: 0.1 to 25 Hz",
    "t a",
    "time,acc",
    "acc",
    "# low-pass 20 Hz",
)
# Lines that contradict the values or what is given: none may be passed over
FALSE = (
    "# dt: {other}",
    "# passo: {other}",
    "# takt: {other}",
    "# DELTA = {other}",
    "# factor: 0.01",
    "# Gain: 2,5",
    "# units: cm/s2",
    "# units: counts",
    "velocity (m/s)",
    "# Spostamento",
    "# npts: {more}",
    "{more} {dt}",
    "{n} {other}",
    "# PGA: 99.5",
    "# durata: 1000 s",
    "# dt (ms): 2,5",
    "values x 100",
    "# 1 unit is 0.01 m/s2",
)


def laid_out(chance: random.Random) -> tuple[str, dict[str, object], list[float], float, bool]:
    """Text of a file, what is given, the values and the step, and whether a line is false."""
    n, dt = chance.randrange(80, 400), chance.choice(STEPS)
    phase, size = chance.uniform(0.0, 6.0), chance.uniform(0.5, 8.0)
    motion = [round(size * sin(0.37 * i + phase) * exp(-(((i - n / 3) / (n / 6)) ** 2)), 6) for i in range(n)]
    times = [round(dt * i, 6) for i in range(n)]
    others = [round(0.1 * size * cos(0.11 * i), 6) for i in range(n)]
    separator = chance.choice((" ", "  ", "\t", ",", ";"))
    columns: list[list[float]] = chance.choice(
        (
            [motion],
            [motion],
            [times, motion],
            [motion, times],
            [times, motion, others],
            [motion, others],
            [others, times, motion],
        )
    )
    values = motion
    is_false = False
    if chance.random() < 0.1:
        at = chance.randrange(1, n - 1)
        motion[at] = chance.choice((-999.0, 9999.0, 1.0e30, -99999.0))
        is_false = True
    if columns == [motion] and chance.random() < 0.3:
        wide = chance.randrange(2, 11)
        rows = [motion[i : i + wide] for i in range(0, n, wide)]
    else:
        rows = [list(row) for row in zip(*columns, strict=True)]
    known = {
        "n": n,
        "dt": dt,
        "length": round(n * dt, 3),
        "peak": f"{max(map(abs, motion)):.4g}",
        "more": n + 7,
        "other": dt * 2,
    }
    top = [chance.choice(TRUE) for _ in range(chance.choice((0, 0, 1, 1, 2)))]
    if chance.random() < 0.4:
        top.insert(chance.randrange(len(top) + 1), chance.choice(FALSE))
        is_false = True
    lines = [line.format(**known) for line in top] + [separator.join(f"{x:.6f}" for x in row) for row in rows]
    given: dict[str, object] = {"units": "m/s2"}
    if is_false or chance.random() < 0.6:
        given["dt"] = dt
    return "\n".join(lines) + "\n", given, values, dt, is_false


def outcome(path: Path, number: int) -> str:
    """What comes of a case."""
    import dondolo as dd

    content, given, values, dt, is_false = laid_out(random.Random(f"columns:{number}"))
    path.write_text(content)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            records = dd.read_records(path, **given)  # type: ignore[arg-type]
    except dd.errors.InputError as error:
        return f"refused {error}"
    if is_false:
        return "WRONG: a line or a value that is false is passed over"
    if len(records) != 1:
        return f"WRONG: {len(records)} records"
    read = records[0].acceleration.tolist()
    if (
        len(read) != len(values)
        or records[0].dt != dt
        or max(abs(x - y) for x, y in zip(read, values, strict=True)) > 1.0e-5
    ):
        return f"WRONG: {len(read)} values at {records[0].dt} s, not {len(values)} at {dt} s"
    return f"read {len(read)}"


def families(python: Path | str, folder: Path, cases: int) -> dict[str, Callable[[], object]]:
    """The family of plain columns."""
    from readers import Tally

    def run() -> Tally:
        tally = Tally("columns")
        folder.mkdir(parents=True, exist_ok=True)
        said = subprocess.run([python, __file__, folder, str(cases)], check=True, capture_output=True, text=True).stdout
        for number, line in enumerate(said.splitlines()):
            tally.note(line, f"columns:{number}")
        return tally

    return {"columns": run}


if __name__ == "__main__":
    for case in range(int(sys.argv[2])):
        print(outcome(Path(sys.argv[1]) / "motion.txt", case).replace("\n", "|"))
