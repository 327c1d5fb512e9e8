"""Costs that a busy or slow machine does not change: ratios of CPU times, each the least of three taken in turns."""

import time


def growth(work, small, large):
    """How many times as much CPU time work(large) takes as work(small)."""
    best = {small: float("inf"), large: float("inf")}
    for _ in range(3):
        for size in best:
            start = time.process_time()
            work(size)
            best[size] = min(best[size], time.process_time() - start)
    return best[large] / best[small]
