"""Attacks on dondolo: damaged files, failing calls, kills, runs side by side. `./run attack [N]` calls it.

    python attack.py --programs EXECUTABLE CHECKED READERS [--cases N] [--parts PART...] [--case FAMILY:NUMBER]
"""

from __future__ import annotations

import argparse
import shutil
import sys
import tempfile
import time
from pathlib import Path

from readers import Attack, Tally, shares
from samples import ROOT, Programs

KEPT = ROOT / "build/attack"


def main() -> int:
    """Attack, print the table, say how it went."""
    parser = argparse.ArgumentParser(description="attack dondolo")
    parser.add_argument("--programs", nargs=3, type=Path, required=True)
    parser.add_argument("--cases", type=int, default=1000, help="damaged files of each family")
    parser.add_argument("--case", metavar="FAMILY:NUMBER", help="only this case, as a failure names it")
    parser.add_argument("--families", nargs="*", help="only these")
    given = parser.parse_args()
    programs = Programs(*(path.resolve() for path in given.programs))
    folder = Path(tempfile.mkdtemp(prefix="dondolo-attack-", dir="/dev/shm" if Path("/dev/shm").is_dir() else None))
    try:
        tallies = attack(programs, folder, given)
    finally:
        shutil.rmtree(folder, ignore_errors=True)
    return report(tallies)


def attack(programs: Programs, folder: Path, given: argparse.Namespace) -> list[Tally]:
    """All that is asked for."""
    files = Attack(programs, folder, KEPT)
    if given.case:
        family, _, number = given.case.partition(":")
        return [files.run(family, range(int(number), int(number) + 1))]
    tallies = []
    for family, cases in shares(given.cases, files):
        if given.families and family not in given.families:
            continue
        began = time.monotonic()
        tally = files.run(family, range(cases))
        tallies.append(tally)
        print(f"{family}: {tally.cases} cases, {len(tally.failures)} failures, {time.monotonic() - began:.0f} s", file=sys.stderr)
    return tallies


def report(tallies: list[Tally]) -> int:
    """Print the table and the failures."""
    print(f"{'family':<12}{'cases':>9}{'accepted':>10}{'refused':>9}{'failures':>10}")
    for one in tallies:
        print(f"{one.family:<12}{one.cases:>9}{one.read:>10}{one.refused:>9}{len(one.failures):>10}  {one.skipped}".rstrip())
    for one in tallies:
        for failure in one.failures[:10]:
            print(f"FAILED  {failure}")
    return int(any(one.failures for one in tallies))


if __name__ == "__main__":
    sys.exit(main())
