"""dondolo in a process that is warm, as the other programs are: a call of multiple_stripe from Python, on one thread.

Called as a peer, with a case in place of the problem: CASE METHOD SETTING REPEATS EVERY [FACTOR]. The method is the
engine, the setting its relative tolerance; levels are multiplied by the factor. A second holds the whole call, all
histories of it, but no reading; its own are those in which Fortran runs the histories.
"""

import sys
import time
from importlib.metadata import version
from types import SimpleNamespace

import dondolo as dd
from dondolo._fortran import _core


class Watch:
    """Seconds that a procedure has taken since they were asked for last."""

    def __init__(self, procedure):
        self.procedure, self.seconds = procedure, 0.0

    def __call__(self, *given):
        start = time.perf_counter()
        try:
            return self.procedure(*given)
        finally:
            self.seconds += time.perf_counter() - start

    def read(self):
        """The seconds, which begin anew."""
        seconds, self.seconds = self.seconds, 0.0
        return seconds


def watched(module, name):
    """A watch on a procedure of a module of the extension, which lets none of its own be replaced."""
    there = getattr(_core, module)
    procedures = {each: getattr(there, each) for each in dir(there) if not each.startswith("__")}
    watch = Watch(procedures[name])
    setattr(_core, module, SimpleNamespace(**procedures | {name: watch}))
    return watch


def main():
    """Run all histories the required number of times, after a call that is not timed."""
    path, engine, setting, repeats, every, *factor = sys.argv[1:]
    case = dd.read_case(path)
    rtol = float(setting)
    solver = dd.Solver(rtol=rtol, atol=rtol / 100.0, engine=engine)
    wall, levels = case.population[0], case.levels * float(*factor or [1.0])

    def call():
        return dd.multiple_stripe(wall, case.records, levels, solver=solver, threads=1, progress=False)

    stripes = call()
    histories = watched("stripes", "run_block")
    print("version dondolo", version("dondolo"), dd.Solver.variant())
    # 0 repeats: one for each line of standard input
    for _ in range(int(repeats)) if int(repeats) else sys.stdin:
        start = time.perf_counter()
        stripes = call()
        seconds = time.perf_counter() - start
        print("own", histories.read())
        print("seconds", seconds, flush=True)
    # Level by level, as in the tables of the reference
    for edp, collapsed in zip(
        stripes.edp.ravel()[:: int(every)], stripes.collapsed.ravel()[:: int(every)], strict=True
    ):
        print(repr(float(edp)), int(collapsed), 0)


main()
