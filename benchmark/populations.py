"""Growth of time and memory with the walls of a population, of each kind that a study has.

One thread; accelerograms are the embedded synthetic ones.
"""

import tempfile
from functools import partial

from cores import Cores
from scaling import heights, row, run_population

#: Levels are few: what a row costs beside its histories is to be seen
STRIPES = "&stripes levels = 0.2, 0.5 /"
#: Of each kind the columns behind the name, what the rows of a wall with a height hold, and more of &population
KINDS = {
    "bare": ("mechanism,height,thickness", lambda h: [f"one_sided,{h},0.25"], ""),
    "two mechanisms, with unions": (
        "mechanism,height,thickness,hinge,p_occ",
        lambda h: [f"one_sided,{h},0.25,,0.6", f"two_block,{h},0.25,0.6,0.5"],
        "",
    ),
    "designs": (
        "mechanism,height,thickness,tie1_height,tie1_area,tie1_length",
        lambda h: [f"one_sided,{h},0.25,{0.9 * h},5e-5,8.0"],
        "designs = .true.",
    ),
    "moving supports": (
        "mechanism,height,thickness,period1,storeys,level,building_height",
        lambda h: [f"one_sided,{h},0.25,0.3,3,6.0,9.0"],
        "",
    ),
}
SIZES = (100, 400, 1600)


def lines_of(kind, count):
    """The table of some walls of a kind: one line a mechanism."""
    head, rows, _ = KINDS[kind]
    return [f"name,{head}"] + [f"w{i},{line}" for i, h in enumerate(heights(count)) for line in rows(h)]


def measure(executable, quick):
    """Measure seconds and memory [MiB] of each kind: rows as those of the scaling, the size the number of walls."""
    rows, cores = [], Cores()
    for kind, (_, lines, more) in KINDS.items():
        for count in SIZES[:2] if quick else SIZES:
            with tempfile.TemporaryDirectory() as folder:
                work = partial(run_population, executable, lines_of(kind, count), STRIPES, 1, folder, population=more)
                (seconds, peak), _ = cores.turn(work)
            histories = 2 * 44 * count * len(lines(3.0))
            rows.append(row(f"population, {kind}", count, histories, [seconds]))
            rows.append(row(f"population memory, {kind}", count, histories, [peak]))
    return rows
