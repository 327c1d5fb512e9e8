"""Attacks on dondolo: damaged files, calls that fail, kills, runs side by side, full disks. `./run attack` calls it.

    python attack.py --programs EXECUTABLE CHECKED READERS [--cases N] [--only WORD...] [--case FAMILY:NUMBER]

The table says for each family how many cases there were, how many were accepted (read; or the new results are in force)
and refused (with one clear sentence; or the old results stay in force), and how many failed.
"""

from __future__ import annotations

import argparse
import shutil
import sys
import tempfile
import time
import warnings
from collections.abc import Callable, Iterator
from pathlib import Path

from bombs import Bombs
from contract import families as contract_of
from faults import Faults
from kills import Kills
from pages import Pages
from readers import COMMANDS, EXECUTABLE, FORTRAN, PYTHON, Attack, Tally
from samples import ROOT, Programs
from strangers import families as strangers_of
from workers import Workers

# Files that made something fail
KEPT = ROOT / "build/attack"


def main() -> int:
    """Attack, print the table, say how it went."""
    parser = argparse.ArgumentParser(description="attack dondolo")
    parser.add_argument(
        "--programs", nargs=3, type=Path, required=True, help="the executable; it and the readers with sanitizers"
    )
    parser.add_argument(
        "--cases", type=int, default=1000, help="damaged files of each family; all else is in proportion"
    )
    parser.add_argument(
        "--only",
        nargs="*",
        help="families, as the table names them, or files, contract, bombs, strangers, faults, kills, workers, serve",
    )
    parser.add_argument("--case", metavar="FAMILY:NUMBER", help="a damaged file, as a failure names it")
    given = parser.parse_args()
    programs = Programs(*(path.resolve() for path in given.programs))
    # In memory where that is possible
    folder = Path(tempfile.mkdtemp(prefix="dondolo-attack-", dir="/dev/shm" if Path("/dev/shm").is_dir() else None))
    # Archives with two members of one name are damaged on purpose.
    warnings.filterwarnings("ignore", "Duplicate name")
    tallies = []
    began = time.monotonic()
    try:
        for tally in attack(programs, folder, given):
            tallies.append(tally)
            print(f"{tally.family}: {tally.cases} cases, {time.monotonic() - began:.0f} s", file=sys.stderr, flush=True)
            began = time.monotonic()
    finally:
        shutil.rmtree(folder, ignore_errors=True)
        failed = report(tallies)
    return failed


def attack(programs: Programs, folder: Path, given: argparse.Namespace) -> Iterator[Tally]:
    """All that is asked for."""

    def chosen(*names: str) -> bool:
        return not given.only or any(name in given.only for name in names)

    if given.case or chosen("files", *FORTRAN, *PYTHON, *COMMANDS, *EXECUTABLE):
        files = Attack(programs, folder, KEPT)
        if given.case:
            family, _, number = given.case.partition(":")
            yield files.run(family, range(int(number), int(number) + 1))
            return
        for family, cases in files.shares(given.cases):
            if chosen("files", family):
                yield files.run(family, range(cases))
    n = given.cases
    faults = Faults(programs, folder / "faults").families(max(1, 1000 // n))
    kills = Kills(programs, folder / "kills")
    interrupted: dict[str, Callable[[], Tally]] = {
        "full disk": kills.full_disks,
        "killed": lambda: kills.kills(max(4, 180 * n // 1000)),
        "one output": lambda: kills.together(max(4, n // 10)),
        "one checkpoint": lambda: kills.one_checkpoint(max(4, n // 10)),
    }
    strangers = strangers_of(programs, folder / "strangers", max(12, n))
    workers = Workers(programs, folder / "workers").families(max(1, n // 100))
    pages = Pages(programs, folder / "pages").families(max(2, 30 * n // 1000))
    bombs = Bombs(programs, folder / "bombs").families()
    groups: dict[str, dict[str, Callable[[], Tally]]] = {
        "contract": contract_of(programs.python, folder / "contract", given.cases),
        "bombs": bombs,
        "strangers": strangers,
        "faults": faults,
        "kills": interrupted,
        "workers": workers,
        "serve": pages,
    }
    for group, families in groups.items():
        for family, attacked in families.items():
            if chosen(group, family):
                yield attacked()


def report(tallies: list[Tally]) -> int:
    """Print the table and the failures; 1 if there are any."""
    print(f"{'family':<26}{'cases':>9}{'accepted':>10}{'refused':>9}{'failures':>10}")
    for one in tallies:
        print(
            f"{one.family:<26}{one.cases:>9}{one.read:>10}{one.refused:>9}{len(one.failures):>10}",
            f" {one.skipped}" if one.skipped else "",
        )
    for one in tallies:
        for failure in one.failures[:20]:
            print(f"FAILED  {failure}")
    failed = sum(len(one.failures) for one in tallies)
    skipped = sum(bool(one.skipped) for one in tallies)
    print(f"{sum(one.cases for one in tallies) - failed} passed, {failed} failed, {skipped} skipped")
    return int(failed > 0)


if __name__ == "__main__":
    sys.exit(main())
