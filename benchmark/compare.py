"""Run the benchmark: python compare.py EXECUTABLE RECORDS [--quick].

Tables are written to out/benchmark, and without --quick docs/performance.md and the speeds in README.md from them.
"""

import os
import platform
import re
import sys
import tempfile
import time
from pathlib import Path

import page
from problem import ROOT, SINGLE_BLOCKS, problem, write_case
from programs import BUILD, DONDOLO, PEERS, run_peer, say, weights, write_results
from rounds import alternate, write_rounds
from scaling import measure

OUT = ROOT / "out" / "benchmark"
ROUNDS = 7  # of all programs in turns, for the ratios


def compare(executable, records, quick):
    """Run dondolo and its peers on the same histories; then the best settings of the first wall in turns."""
    found, turns = [], []
    for wall in SINGLE_BLOCKS[:1] if quick else SINGLE_BLOCKS:
        each = problem(wall, records)
        first = wall == SINGLE_BLOCKS[0]
        say(f"{wall}, {len(each)} histories under {each.name} accelerograms")
        # Slow peers run on the first wall only, all others with one setting per method on the second.
        peers = [DONDOLO, *(peer for peer in PEERS if first or peer.part == 1)]
        shares = weights(executable, each, 3)
        own = []
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "problem.bin"
            each.write(path)
            case = write_case(folder, each.wall, each.motions, 1e-8)
            for peer in peers:
                all_settings = peer is DONDOLO or (first and not quick)
                chosen = peer if all_settings else peer.quick()
                own += run_peer(chosen, each, case if peer.takes_case else path, shares)
            if first:
                turns = alternate(executable, each, own, path, case, 2 if quick else ROUNDS)
        found += own
    return found, turns


def machine():
    """Lines that describe processor, system and compiler."""
    lines = []
    information = Path("/proc/cpuinfo")
    model = platform.processor() or platform.machine()
    if information.is_file():
        match = re.search(r"model name\s*: (.*)", information.read_text())
        model = match.group(1) if match else model
    lines.append(f"processor: {model}, {os.cpu_count()} cores, {platform.machine()}")
    lines.append(f"system: {platform.system()} {platform.release().split('-')[0]}, Python {platform.python_version()}")
    lines.append(f"peers in C++: {(BUILD / 'compiler').read_text().strip()}")
    return lines


def main():
    """Run the whole benchmark."""
    executable, records = sys.argv[1:3]
    quick = "--quick" in sys.argv
    start = time.monotonic()
    OUT.mkdir(parents=True, exist_ok=True)
    results, turns = compare(executable, records, quick)
    write_results(OUT / "programs.csv", results)
    write_rounds(OUT / "rounds.csv", turns)
    measure(executable, OUT / "scaling.csv", 1 if quick else 3)
    (OUT / "machine.txt").write_text("\n".join(machine()) + "\n", encoding="utf-8")
    if not quick:
        page.write(OUT)
    say(f"{time.monotonic() - start:.0f} s; the tables are in {OUT}")


if __name__ == "__main__":
    main()
