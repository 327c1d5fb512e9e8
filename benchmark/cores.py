"""The core that a turn runs on: one that other programs leave alone, if there is one.

A processor with two threads on a core shares its units between them, and the other thread may belong to another machine
of the same host, which nothing else shows: peers/core.cpp. A turn waits for a core that is free, and is taken again if
the core is shared at its end.
"""

import math
import os
import subprocess
import time

from programs import BUILD

GAUGE = BUILD / "core"
FREE = 0.85  # of the most additions that any core has done: a core that does fewer is shared
WAIT = 3.0  # seconds that a turn waits for a core that is not
STEADY = 1.1  # times the shortest multiplication: a longer one was interrupted, and makes a core look free
MOST = 16  # cores that are tried
TRIES = 3  # times that a turn is taken whose core is shared at its end


class Cores:
    """The cores that this process may run on."""

    def __init__(self):
        """All that the system gives; it is not asked for one where it cannot be, or where there is no gauge."""
        self.own = os.sched_getaffinity(0) if hasattr(os, "sched_getaffinity") and GAUGE.is_file() else set()
        self.most = 0.0  # additions in the time of a multiplication
        self.shortest = math.inf  # seconds of a multiplication

    def turn(self, take, count=1):
        """Take a turn on the cores that other programs leave most of.

        Parameters
        ----------
        take : function
            Takes the turn: what it starts runs on these cores.
        count : int
            How many cores.

        Returns
        -------
        taken
            What the turn gave, the last of TRIES if all of them were disturbed.
        gauges : list of (float, float)
            Of each core, before the turn and after it: seconds of an addition beside others, and of a multiplication
            that waits for the one before.
        """
        if not self.own:
            return take(), []
        try:
            for _ in range(TRIES):
                chosen = self.choose(count)
                # More cores than are tried: all of them
                os.sched_setaffinity(0, set(chosen) if len(chosen) == count else self.own)
                taken, after = take(), self.gauges(chosen)
                if self.are_free(after):
                    break
        finally:
            os.sched_setaffinity(0, self.own)
        return taken, [*chosen.values(), *after.values()]

    def choose(self, count):
        """So many cores with their gauges; they are free, unless that takes too long."""
        end = time.monotonic() + WAIT
        while True:
            found = self.gauges(self.own)
            best = sorted(found, key=lambda core: self.left(found[core]), reverse=True)[:count]
            chosen = {core: found[core] for core in best}
            if self.are_free(chosen) or time.monotonic() > end:
                return chosen

    def gauges(self, cores):
        """What cores have for a program, as `turn` gives it."""
        found = {core: measured(core) for core in sorted(cores)[:MOST]}
        self.shortest = min(self.shortest, *(multiplication for _, multiplication in found.values()))
        self.most = max(self.most, *map(self.left, found.values()))
        return found

    def left(self, gauge):
        """What other programs leave of a core, additions in the time of a multiplication; 0 if that is not known."""
        return additions(*gauge) if gauge[1] <= STEADY * self.shortest else 0.0

    def are_free(self, found):
        """Whether other programs leave the cores of some gauges alone."""
        return all(self.left(each) >= FREE * self.most for each in found.values())


def measured(core):
    """Seconds of an addition beside others on a core, and of a multiplication that waits for the one before."""
    os.sched_setaffinity(0, {core})
    done = subprocess.run([GAUGE], check=True, capture_output=True, text=True)
    multiplication, addition = (float(line.split()[1]) for line in done.stdout.splitlines())
    return addition, multiplication


def additions(addition, multiplication):
    """Additions beside others in the time of a multiplication."""
    return multiplication / addition
