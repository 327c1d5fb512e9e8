"""Run the benchmark: python compare.py EXECUTABLE RECORDS [--quick].

Tables are written to out/benchmark. Without --quick the ratios are appended to runs.csv, and
docs/studies/performance.md and the speeds in two pages are written from the tables.
"""

import os
import platform
import re
import sys
import tempfile
from dataclasses import replace
from pathlib import Path

import arithmetic
import beside
import page
import populations
import runs
from problem import ROOT, SINGLE_BLOCKS, problem, write_case
from programs import BUILD, DONDOLO, PEERS, run_peer, weights, write_results
from progress import Progress, say
from rounds import QUICK_ROUNDS, ROUNDS, Rounds, write_rounds
from scaling import measure, write_scaling

OUT = ROOT / "out" / "benchmark"


def compare(executable, records, quick, progress):
    """Run dondolo and its peers on the same histories; results, turns of the best settings, and rows of the scaling.

    The rounds come in three groups: after the first wall, after the second, and after the scaling.
    """
    found = []
    problems = [problem(wall, records) for wall in (SINGLE_BLOCKS[:1] if quick else SINGLE_BLOCKS)]
    plan(progress, problems, quick)
    *rounds, last = QUICK_ROUNDS if quick else ROUNDS
    with tempfile.TemporaryDirectory() as folder:
        turns = None
        for each, count in zip(problems, rounds, strict=True):
            say(f"{each.wall}, {len(each)} histories under {each.name} accelerograms")
            own, path, case = settings(each, folder, turns is None and not quick, progress)
            found += own
            if turns is None:
                turns = Rounds(executable, each, own, path, case)
            turns.group(count)
            progress.finish("rounds")
        repeats = 1 if quick else sum(ROUNDS)
        rows = measure(executable, repeats) + beside.measure(repeats) + populations.measure(executable, quick)
        progress.finish("scaling")
        turns.group(last)
        progress.finish("rounds")
        return found, turns.turns, rows


def chosen_peers(first, whole):
    """Dondolo and the peers for a wall: slow ones run on the first only, all but dondolo there with every setting."""
    peers = [peer for peer in PEERS if first or peer.part == 1]
    return [DONDOLO, *(peer if whole else peer.quick() for peer in peers)]


def plan(progress, problems, quick):
    """Plan the steps of the benchmark."""
    for each in problems:
        first = each is problems[0]
        factor = 1.0 if first else 1.7
        progress.plan(f"{each.wall}, weights", 1.0)
        for peer in chosen_peers(first, first and not quick):
            for method, values in peer.methods.items():
                progress.plan(f"{each.wall}, {peer.name}, {method}", factor * peer.expected * len(values))
    for count in QUICK_ROUNDS if quick else ROUNDS:
        progress.plan("rounds", 38.0 * count)
    progress.plan("scaling", 40.0 if quick else 210.0)


def settings(each, folder, whole, progress):
    """Results of dondolo and its peers for one wall, and the files of the problem and of dondolo's case."""
    path = Path(folder) / f"{each.wall}.bin"
    each.write(path)
    place = Path(folder) / each.wall
    place.mkdir()
    case = write_case(place, each.wall, each.motions, 1e-8)
    shares = weights(each)
    progress.finish(f"{each.wall}, weights")
    found = []
    for peer in chosen_peers(each.wall == SINGLE_BLOCKS[0], whole):
        for method in peer.methods:
            one = replace(peer, methods={method: peer.methods[method]})
            found += run_peer(one, each, case if peer.takes_case else path, shares)
            progress.finish(f"{each.wall}, {peer.name}, {method}")
    return found, path, case


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
    progress = Progress()
    OUT.mkdir(parents=True, exist_ok=True)
    results, turns, rows = compare(executable, records, quick, progress)
    write_results(OUT / "programs.csv", results)
    write_rounds(OUT / "rounds.csv", turns)
    write_scaling(OUT / "scaling.csv", rows)
    (OUT / "machine.txt").write_text("\n".join(machine()) + "\n", encoding="utf-8")
    run, ratios = runs.new_run(arithmetic.measured(executable)), runs.figures(results, turns, rows)
    (OUT / "run.csv").unlink(missing_ok=True)
    runs.append(OUT / "run.csv", run, ratios)
    if not quick:
        runs.append(runs.FILE, run, ratios)
        page.write(OUT)
    if not runs.is_quiet(ratios):
        say("other programs on the machine have disturbed this run: its times vary too much; run it again")
    say(f"{progress.elapsed():.0f} s; the tables are in {OUT}")


if __name__ == "__main__":
    main()
