"""Run the benchmark: python compare.py EXECUTABLE RECORDS [--quick].

Tables are written to out/benchmark, and without --quick docs/performance.md from them.
"""

import os
import platform
import re
import sys
import tempfile
import time
from pathlib import Path

import page
from problem import ROOT, SINGLE_BLOCKS, problem
from programs import BUILD, PEERS, run_engines, run_peer, say, weights, write_results
from scaling import measure

OUT = ROOT / "out" / "benchmark"


def compare(executable, records, quick):
    """Run dondolo and its peers on the same histories."""
    found = []
    repeats = 1 if quick else 5
    for wall in SINGLE_BLOCKS[:1] if quick else SINGLE_BLOCKS:
        each = problem(wall, records)
        say(f"{wall}, {len(each)} histories under {each.name} accelerograms")
        # Slow peers, and peers that support only one wall, run on the first wall only.
        peers = [peer for peer in PEERS if wall == SINGLE_BLOCKS[0] or peer.part == 1]
        shares = weights(executable, each, 3)
        found += run_engines(executable, each, repeats, quick)
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "problem.bin"
            each.write(path)
            for peer in peers:
                found += run_peer(peer.quick() if quick else peer, each, path, shares)
    return found


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
    write_results(OUT / "programs.csv", compare(executable, records, quick))
    measure(executable, OUT / "scaling.csv", 1 if quick else 5)
    (OUT / "machine.txt").write_text("\n".join(machine()) + "\n", encoding="utf-8")
    if not quick:
        page.write(OUT)
    say(f"{time.monotonic() - start:.0f} s; the tables are in {OUT}")


if __name__ == "__main__":
    main()
