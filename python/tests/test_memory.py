"""Too little memory is a MemoryError, and never the end of the process."""

import os
import subprocess
import sys

import pytest

resource = pytest.importorskip("resource")

HEAD = """
import resource, sys
import numpy as np
import dondolo as dd

wall = dd.OneSidedWall(3.0, 0.25)
long = dd.Record(0.5 * np.sin(0.01 * np.arange(1_000_000)), 0.01)
few = [dd.Record(3.0 * np.sin(0.05 * i * np.arange(200)), 0.01, f"r{i}") for i in range(1, 5)]
levels = np.linspace(0.01, 0.02, 50_000)
dd.simulate(wall, few[0])

# Of all addresses, or of what is no file and no stack: pages in all, and of data, in statm
kind, place = {"all": (resource.RLIMIT_AS, 0), "data": (resource.RLIMIT_DATA, 5)}[sys.argv[1]]

def limit(extra):
    used = int(open("/proc/self/statm").read().split()[place]) * resource.getpagesize()
    resource.setrlimit(kind, (used + extra, resource.RLIM_INFINITY))

for extra in map(int, sys.argv[2:]):
    limit(extra * 10**6)
    try:
        WORK
        print("done")
    except MemoryError as error:
        print("MemoryError")
    limit(10**12)
"""

# Each needs more than 100 MB and less than 1 GB beyond what is there
WORKS = {
    "record": "dd.Record(long.acceleration, 0.01)",
    "history": "dd.simulate(wall, long, 3.0)",
    "scaling_values": "dd.multiple_stripe(wall, [long], [0.01], im='pgd', progress=False)",
    "plan": "dd.multiple_stripe(wall, few, levels, progress=False)",
    "spectrum": "long.spectrum([0.1, 0.2])",
    "fit": "dd.fit_fragility(np.linspace(0.1, 1.0, 400_000), np.arange(400_000) // 40_000, np.full(400_000, 10))",
    "catalogue": "dd.read_catalogue(FOLDER + '/records.csv')",
    "population": "dd.Population.from_csv(FOLDER + '/walls.csv')",
}


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    place = tmp_path_factory.mktemp("memory")
    (place / "long.txt").write_text("0.5\n-0.5\n" * 300_000)
    (place / "records.csv").write_text("file,dt_s,units\nlong.txt,0.01,m/s2\n")
    rows = "".join(f"w{i},one_sided,3,0.25\n" for i in range(10_000))
    (place / "walls.csv").write_text("name,mechanism,height,thickness\n" + rows)
    return place


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="reads how much memory a process has in /proc")
@pytest.mark.parametrize("work", WORKS)
@pytest.mark.parametrize("limited", ["all", "data"])
def test_lack_of_memory(work, limited, folder):
    program = HEAD.replace("WORK", WORKS[work]).replace("FOLDER", repr(str(folder)))
    extras = [1, 20, 50, 80, 110, 150, 1500]
    environment = os.environ | {"OMP_NUM_THREADS": "2"}
    command = [sys.executable, "-W", "ignore", "-c", program, limited, *map(str, extras)]
    done = subprocess.run(command, capture_output=True, text=True, timeout=100, env=environment)
    assert done.returncode == 0, done.stderr
    words = done.stdout.split()
    assert len(words) == len(extras)
    assert words[0] == "MemoryError"
    assert words[-1] == "done"
