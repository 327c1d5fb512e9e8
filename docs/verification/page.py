"""Write docs/studies/verification.md and its figures: python page.py EXECUTABLE SHORTCUTS RECORDS.

EXECUTABLE is dondolo, SHORTCUTS dondolo-shortcuts, RECORDS the folder that contains italy44.csv. Every number of the
page is computed in a run or read from test/reference. The script takes some minutes on one core.
"""

import sys

from cases import ROOT
from markdown import bullets, many, power, small
from sections_accuracy import LARGE, targets, truth, work_precision
from sections_flags import ORDINARY, doubts, estimates, flags, largest_shift, wrong_flags
from sections_joints import joints
from sections_loaded import loaded
from sections_shortcuts import ALL, shortcut_errors, shortcuts, tests
from sections_ties import ties
from sections_walls import walls
from study import DEFAULT, collect


def summary(study):
    """Summary of the page."""
    pairs = study.pairs()
    total = sum(len(study.exact[pair]) for pair in pairs)
    change = max(study.exact[pair].spread.max() for pair in pairs)
    by_default = [study.errors(*pair, DEFAULT) for pair in pairs]
    shift, _ = largest_shift(study, [DEFAULT])
    widest, _ = largest_shift(study, ORDINARY)
    counts = [sum(column) for column in zip(*doubts(study).values(), strict=True)]
    found = shortcut_errors(study)
    spoiled = {name: [each[name] for each in found.values()] for name in next(iter(found.values()))}
    recorded = sum(len(errors.edp) for errors in spoiled[ALL])
    single = {name: sum(e.flags() for e in each) for name, each in spoiled.items() if name != ALL}
    worst = max(single, key=single.get)
    rows = wrong_flags(study)
    exactly = "the exact ones" if shift == 0.0 else f"within {shift:.2g} standard errors of the exact ones"
    off = "with an error above 1e-6"
    return bullets(
        [
            f"Reference: {total} histories of three walls in 33 digits; none changes by more than {small(change)} if "
            "the tolerance is relaxed a hundredfold.",
            f"Engine rk45 at its defaults: {many(sum(e.flags() for e in by_default), 'wrong collapse flag')}; "
            f"{many(sum(e.above(LARGE) for e in by_default), 'EDP')} {off}, the largest "
            f"{small(max(e.worst() for e in by_default))}.",
            f"Fragility: θ and β at the defaults are {exactly}; {many(len(rows), 'wrong flag')} between rtol = "
            f"{power(ORDINARY[0])} and {power(ORDINARY[-1])}, and shifts of at most {widest:.2g} standard errors.",
            f"The estimated error detects {counts[1]} of the {many(counts[0], 'EDP')} {off}, with "
            f"{many(counts[3], 'false alarm')}.",
            f'The worst single shortcut, "{worst}": {single[worst]} wrong flags of {recorded}, '
            f"{sum(e.above(1e-3) for e in spoiled[worst])} EDPs with an error above 1e-3.",
        ]
    )


def write(study, executable, records):
    """Write the page and its figures."""
    lines = [
        "# Verification",
        "",
        "Error of dondolo's results relative to the exact solution of its equations. Written by `./run verification`.",
        "",
        *summary(study),
    ]
    lines += truth(study) + work_precision(study) + targets(study) + flags(study) + estimates(study)
    lines += shortcuts(study) + tests() + loaded(executable, records) + walls(records) + ties(records) + joints(records)
    (ROOT / "docs" / "studies" / "verification.md").write_text("\n".join(lines).rstrip() + "\n", encoding="utf-8")


def main():
    """Run the study and write the page."""
    executable, shortcuts_executable, records = sys.argv[1:4]
    write(collect(executable, shortcuts_executable, records), executable, records)


if __name__ == "__main__":
    main()
