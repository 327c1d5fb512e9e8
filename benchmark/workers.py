"""Overhead of Dask: blocks of walls in this process against the same blocks by workers of a cluster on this machine.

Every run has one thread per worker; the kinds of runs alternate, so that a machine that slows down affects all of
them. Usage: python benchmark/workers.py [RUNS] [BLOCKS]
"""

from __future__ import annotations

import multiprocessing
import os
import statistics
import sys
import time
import warnings
from concurrent.futures import Executor, ProcessPoolExecutor
from pathlib import Path

import numpy as np
from distributed import Client, LocalCluster

import dondolo as dd

ROOT = Path(__file__).resolve().parents[1]
LEVELS = np.linspace(0.1, 2.0, 20)
# Walls per block: with 44 records about 100 000 histories, more than a second on one thread
WALLS = 130


def seconds(population: dd.Population, records: list[dd.Record], executor: Executor | None) -> float:
    """Time a typology in blocks of WALLS walls, one thread each."""
    start = time.perf_counter()
    dd.typology(population, records, LEVELS, threads=1, block=WALLS, executor=executor, progress=False)
    return time.perf_counter() - start


def main(runs: int = 5, blocks: int = 8) -> None:
    """Time all kinds of runs and print a table."""
    warnings.simplefilter("ignore", dd.errors.DondoloWarning)
    records = dd.read_catalogue(ROOT / "data/records/synthetic44.csv")
    heights = np.random.default_rng(0).uniform(1.5, 4.5, WALLS * blocks)
    population = dd.Population([dd.OneSidedWall(h, 0.25, name=f"wall {i}") for i, h in enumerate(heights)])
    spawn = multiprocessing.get_context("spawn")

    def cluster(workers: int) -> LocalCluster:
        return LocalCluster(n_workers=workers, threads_per_worker=1, dashboard_address=":0")

    with (
        cluster(1) as small,
        cluster(2) as large,
        Client(small) as one,
        Client(large) as two,
        ProcessPoolExecutor(2, mp_context=spawn) as pool,
    ):
        kinds: dict[str, tuple[Executor | None, int]] = {
            "this process": (None, 1),
            "Dask, 1 worker": (one.get_executor(), 1),
            "Dask, 2 workers": (two.get_executor(), 2),
            "2 processes": (pool, 2),
        }
        times: dict[str, list[float]] = {name: [] for name in kinds}
        for executor, _ in kinds.values():
            # Start the processes and send them the records.
            seconds(dd.Population(population.walls[:WALLS]), records, executor)
        print(f"load average before: {os.getloadavg()[0]:.2f}")
        for _ in range(runs):
            for name, (executor, _) in kinds.items():
                times[name].append(seconds(population, records, executor))
        print(f"load average after: {os.getloadavg()[0]:.2f}")
    histories = WALLS * blocks * len(records) * len(LEVELS)
    print(f"{blocks} blocks, {histories} histories, {dd.Solver.variant()}, medians of {runs} runs")
    alone = statistics.median(times["this process"])
    print(f"{'':18}{'time [s]':>10}{'block [s]':>11}{'overhead':>10}   all runs [s]")
    for name, (_, workers) in kinds.items():
        median = statistics.median(times[name])
        overhead = 100.0 * (median * workers / alone - 1.0)
        listed = " ".join(f"{value:.2f}" for value in times[name])
        print(f"{name:18}{median:10.2f}{median * workers / blocks:11.2f}{overhead:9.1f}%   {listed}")


if __name__ == "__main__":
    main(*map(int, sys.argv[1:]))
