"""The core that a turn runs on: one that other programs leave alone, if there is one.

A processor with two threads on a core shares its units between them, and the other thread may belong to another machine
of the same host, which nothing else shows: peers/core.cpp.
"""

import os
import subprocess
import time

from programs import BUILD

GAUGE = BUILD / "core"
FREE = 0.85  # of the most additions that any core has done: a core that does fewer is shared
WAIT = 3.0  # seconds that a turn waits for a core that is not
MOST = 4  # cores that are tried


class Cores:
    """The cores that this process may run on."""

    def __init__(self):
        """All that the system gives; it is not asked for one where it cannot be, or where there is no gauge."""
        self.own = os.sched_getaffinity(0) if hasattr(os, "sched_getaffinity") and GAUGE.is_file() else set()
        self.most = 0.0  # additions in the time of a multiplication

    def choose(self):
        """Go to the core that other programs leave most of, with all that is started from now on.

        Returns
        -------
        (float, float) or None
            Seconds of an addition beside others there, and of a multiplication that waits for the one before.
        """
        end = time.monotonic() + WAIT
        while self.own:
            found = {core: measured(core) for core in sorted(self.own)[:MOST]}
            core = max(found, key=lambda each: additions(*found[each]))
            best = additions(*found[core])
            self.most = max(self.most, best)
            if best >= FREE * self.most or time.monotonic() > end:
                os.sched_setaffinity(0, {core})
                return found[core]
        return None

    def leave(self):
        """Run on all of them again."""
        if self.own:
            os.sched_setaffinity(0, self.own)


def measured(core):
    """Seconds of an addition beside others on a core, and of a multiplication that waits for the one before."""
    os.sched_setaffinity(0, {core})
    done = subprocess.run([GAUGE], check=True, capture_output=True, text=True)
    multiplication, addition = (float(line.split()[1]) for line in done.stdout.splitlines())
    return addition, multiplication


def additions(addition, multiplication):
    """Additions beside others in the time of a multiplication."""
    return multiplication / addition
