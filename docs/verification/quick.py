"""Errors of dondolo and of its shortcuts under the synthetic accelerograms: python quick.py EXECUTABLE SHORTCUTS.

What `./run verification` computes with --quick, or where there are no recorded accelerograms: no page, but the
histories of three walls must agree with the reference in 33 digits. Fails if a flag is wrong, or an error larger than
expected.
"""

import sys

from cases import WALLS, motions, run
from histories import Errors, Histories
from sections_accuracy import LARGE
from study import DEFAULT, ENGINE, TIGHT, Study, read_reference, run_shortcuts

# Largest errors of EDPs that are accepted: ten times those of November 2026, by relative tolerance
MOST = {DEFAULT: 1.5e-4, TIGHT: 1e-7}


def show(wall, name, histories, exact):
    """Print and return the errors of histories."""
    errors = Errors(histories, exact)
    print(f"{wall:<14} {name:<40} {errors.flags():>11} {errors.above(LARGE):>18} {errors.worst():>13.1e}")
    return errors


def main():
    """Print the errors of each wall, and judge them."""
    executable, shortcuts = sys.argv[1:3]
    synthetic = motions("none")["synthetic"]
    study = Study()
    wrong = []
    print(f"{'wall':<14} {'by':<40} {'wrong flags':>11} {'EDPs off by > 1e-6':>18} {'largest error':>13}")
    for wall in WALLS:
        read_reference(study, wall, "synthetic")
        exact = study.exact[wall, "synthetic"]
        for rtol, most in MOST.items():
            histories = Histories.of(run(executable, wall, synthetic, rtol, solver=ENGINE)["histories"])
            errors = show(wall, f"rk45, rtol = {rtol:g}", histories, exact)
            if errors.flags() > 0 or errors.worst() > most:
                wrong.append(f"{wall} with rtol = {rtol:g}")
        for name, histories in run_shortcuts(shortcuts, wall, synthetic).items():
            show(wall, name, histories, exact)
    sys.exit(f"verification: errors are too large for {', '.join(wrong)}" if wrong else 0)


if __name__ == "__main__":
    main()
