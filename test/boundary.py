"""What Python costs beyond Fortran: `python boundary.py CATALOGUE`, of the installation that runs it.

The stripes of a wall under the records of a catalogue at 20 levels, by the executable and by `multiple_stripe`, both on
one thread, counted in machine instructions by valgrind: counts do not depend on what else the machine does. Of the
executable those of `multiple_stripe` alone count; of Python, after the first call, those of one call more.
"""

import os
import re
import subprocess
import sys
import tempfile
from pathlib import Path

CALLS = (2, 4)

CASE = """
&job task = 'stripes' output = 'result' threads = 1 /
&wall mechanism = 'one_sided' height = 3, thickness = 0.25 /
&records catalogue = '{catalogue}' /
&stripes first = 0.05, last = 1, count = 20 /
"""

CALL = """
import sys, warnings, numpy, dondolo as dd
warnings.simplefilter("ignore")
records, wall = dd.read_catalogue(sys.argv[1]), dd.OneSidedWall(3.0, 0.25)
for _ in range(int(sys.argv[2])):
    dd.multiple_stripe(wall, records, levels=numpy.linspace(0.05, 1.0, 20), threads=1, progress=False)
"""


def count(folder, command, *options):
    """Instructions of a program."""
    valgrind = ["valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null", *options]
    # Valgrind does not know the widest vectors.
    environment = os.environ | {"OMP_NUM_THREADS": "1", "DONDOLO_VARIANT": "avx2"}
    done = subprocess.run([*valgrind, *command], cwd=folder, env=environment, capture_output=True, text=True)
    if done.returncode:
        sys.exit(done.stderr)
    return int(re.search(r"Collected : (\d+)", done.stderr)[1])


def main():
    """Count and compare."""
    catalogue = str(Path(sys.argv[1]).resolve())
    with tempfile.TemporaryDirectory() as folder:
        Path(folder, "case.nml").write_text(CASE.format(catalogue=catalogue))
        executable = Path(sys.executable).with_name("dondolo")
        counted = "--toggle-collect=__dondolo_fragility_stripes_MOD_multiple_stripe"
        fortran = count(folder, [executable, "case.nml"], counted)
        few, many = (count(folder, [sys.executable, "-c", CALL, catalogue, str(calls)]) for calls in CALLS)
    python = (many - few) / (CALLS[1] - CALLS[0])
    print(f"Fortran {fortran / 1e6:.1f}e6, Python {python / 1e6:.1f}e6 instructions: ratio {python / fortran:.4f}")


main()
