"""Costs that a busy or slow machine does not change: counts, and ratios of CPU times that are taken in turns."""

import sys
import time

import numpy as np


def calls(work):
    """How many functions, of Python and of C, a piece of work calls."""
    count = 0

    def note(frame, event, argument):
        nonlocal count
        count += event in ("call", "c_call")

    sys.setprofile(note)
    try:
        work()
    finally:
        sys.setprofile(None)
    return count


def unit():
    """CPU time of a fixed piece of work, half of it Python's and half NumPy's: 0.1 s where nothing else runs."""
    start = time.process_time()
    total = 0
    for i in range(800_000):
        total += i % 7
    values = np.linspace(0.0, 1.0, 100_000)
    for _ in range(45):
        np.sin(values)
    return time.process_time() - start


def growth(work, small, large):
    """How many times as much CPU time work(large) takes as work(small), each the least of three."""
    best = {small: float("inf"), large: float("inf")}
    for _ in range(3):
        for size in best:
            start = time.process_time()
            work(size)
            best[size] = min(best[size], time.process_time() - start)
    return best[large] / best[small]
