"""Progress of the benchmark: which step runs, and when the last is expected to end."""

import sys
import time


def say(text):
    """Print a progress message."""
    print(f"benchmark: {text}", file=sys.stderr, flush=True)


class Progress:
    """Steps with the seconds that each is expected to take; the expectation follows the steps that are done."""

    def __init__(self):
        """Begin with an empty plan."""
        self.left = []
        self.done = 0.0
        self.start = time.monotonic()

    def plan(self, name, seconds):
        """Add a step."""
        self.left.append((name, seconds))

    def finish(self, name):
        """Take a step, wherever it is in the plan, as done, and print the expected end."""
        for place, (planned, seconds) in enumerate(self.left):
            if planned == name:
                self.done += seconds
                del self.left[place]
                break
        gone = self.elapsed()
        ahead = sum(seconds for _, seconds in self.left)
        # The plan is of a quiet machine: how much slower this one is shows after some steps
        slower = max(0.5, gone / self.done) if self.done > 20.0 else 1.0
        end = time.strftime("%H:%M:%S", time.localtime(time.time() + slower * ahead))
        say(f"{name}: done after {gone:.0f} s; {len(self.left)} steps are left, until {end}")

    def elapsed(self):
        """Seconds since the start."""
        return time.monotonic() - self.start
