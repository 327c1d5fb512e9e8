"""A run of Python whose calls fail, or that is killed.

    python python_run.py typology FOLDER | save FOLDER
"""

from __future__ import annotations

import sys
import warnings
from pathlib import Path

import dondolo as dd


def main() -> None:
    """Run, and write to FOLDER/out/study."""
    what, folder = sys.argv[1], Path(sys.argv[2])
    warnings.simplefilter("ignore")
    records = dd.read_catalogue(folder / "new/records.csv")
    people = dd.read_population(folder / "new/walls.csv")
    levels = [0.1, 0.2, 0.3, 0.5, 0.9]
    checkpoint = folder / "out/study.counts" if what == "typology" else None
    typology = dd.typology(people, records, levels=levels, checkpoint=checkpoint, block=2, threads=1, progress=False)
    typology.save(folder / "out/study")
    if what == "save":
        dd.fit_fragility([0.2, 0.4, 0.6], [1, 5, 9], [10, 10, 10]).save(folder / "out/curve.npz")


if __name__ == "__main__":
    try:
        main()
    except dd.DondoloError as error:
        print(f"dondolo: {error}", file=sys.stderr)
        sys.exit(1)
