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
        own = {
            f"rk45, rtol = {rtol:g}": Histories.of(run(executable, wall, synthetic, rtol, solver=ENGINE)["histories"])
            for rtol in (DEFAULT, TIGHT)
        }
        for name, histories in (own | run_shortcuts(shortcuts, wall, synthetic)).items():
            errors = Errors(histories, exact)
            print(f"{wall:<14} {name:<40} {errors.flags():>11} {errors.above(LARGE):>18} {errors.worst():>13.1e}")
            if name in own and (errors.flags() > 0 or errors.worst() > (1e-2 if name.endswith("e-08") else 1e-4)):
                wrong.append(f"{wall} by {name}")
    sys.exit(f"verification: errors are too large for {', '.join(wrong)}" if wrong else 0)


if __name__ == "__main__":
    main()
