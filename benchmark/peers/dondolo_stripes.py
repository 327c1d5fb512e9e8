"""dondolo in a process that is warm, as the other programs are: a call of multiple_stripe from Python, on one thread.

Called as a peer, with a case in place of the problem: CASE METHOD SETTING REPEATS EVERY. The method is the engine, the
setting its relative tolerance. A second holds the whole call, all histories of it, but no reading.
"""

import sys
import time
from importlib.metadata import version

import dondolo as dd


def main():
    """Run all histories the required number of times, after a call that is not timed."""
    path, engine, setting, repeats, every = sys.argv[1:]
    case = dd.read_case(path)
    rtol = float(setting)
    solver = dd.Solver(rtol=rtol, atol=rtol / 100.0, engine=engine)
    wall = case.population[0]

    def call():
        return dd.multiple_stripe(wall, case.records, case.levels, solver=solver, threads=1, progress=False)

    stripes = call()
    print("version dondolo", version("dondolo"), dd.build_variant())
    # 0 repeats: one for each line of standard input
    for _ in range(int(repeats)) if int(repeats) else sys.stdin:
        start = time.perf_counter()
        stripes = call()
        print("seconds", time.perf_counter() - start, flush=True)
    # Level by level, as in the tables of the reference
    for edp, collapsed in zip(
        stripes.edp.ravel()[:: int(every)], stripes.collapsed.ravel()[:: int(every)], strict=True
    ):
        print(repr(float(edp)), int(collapsed), 0)


main()
