"""A run of Python whose calls fail, or that is killed, or whose workers are.

    python python_run.py typology|save|pool|dask|mpi FOLDER

It reads FOLDER/new and writes FOLDER/out/study. It has a checkpoint, except for ``save``, which saves another result.
With ``-`` in the place of both it makes such a run in a fork for each line of standard input, beside the library of
faults.inc: a list in JSON of the two, of the call that fails, of how, and of the path of a log. It answers with the
exit code and what the run said.
"""

from __future__ import annotations

import ctypes
import json
import os
import sys
import tempfile
import warnings
from collections.abc import Iterator
from concurrent.futures import Executor, ProcessPoolExecutor
from contextlib import contextmanager
from pathlib import Path

import dondolo as dd


@contextmanager
def executor(what: str) -> Iterator[Executor | None]:
    """Two workers, or none."""
    if what == "pool":
        with ProcessPoolExecutor(2) as pool:
            yield pool
    elif what == "dask":
        from distributed import Client, LocalCluster

        with (
            LocalCluster(n_workers=2, threads_per_worker=1, dashboard_address=None) as cluster,
            Client(cluster) as client,
        ):
            yield client.get_executor()
    elif what == "mpi":
        from mpi4py.futures import MPIPoolExecutor

        with MPIPoolExecutor() as pool:
            yield pool
    else:
        yield None


def run(what: str, folder: Path) -> None:
    """Run, and write."""
    warnings.simplefilter("ignore")
    records = dd.read_catalogue(folder / "new/records.csv")
    people = dd.Population.from_csv(folder / "new/walls.csv")
    checkpoint = None if what == "save" else folder / "out/study.counts"
    given = {"levels": [0.1, 0.2, 0.3, 0.5, 0.9], "checkpoint": checkpoint, "block": 2, "progress": False}
    with executor(what) as workers:
        typology = dd.typology(people, records, executor=workers, threads=1, **given)
    typology.write_results(folder / "out/study")
    if what == "save":
        dd.fit_fragility([0.2, 0.4, 0.6], [1, 5, 9], [10, 10, 10]).save(folder / "out/curve.npz")


def asked() -> tuple[str, Path]:
    """What to run: of a fork, what is asked of it; this process does not return but when nobody asks any more."""
    if sys.argv[1] != "-":
        return sys.argv[1], Path(sys.argv[2])
    faults = ctypes.CDLL(None)
    for line in sys.stdin:
        what, folder, at, how, log = json.loads(line)
        with tempfile.TemporaryFile() as said:
            if (child := os.fork()) == 0:
                os.dup2(said.fileno(), sys.stderr.fileno())
                faults.attack_begin(ctypes.c_long(at), ctypes.c_long(how), log.encode())
                return what, Path(folder)
            code = os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
            said.seek(0)
            print(json.dumps([code, said.read().decode(errors="replace").splitlines()]), flush=True)
    sys.exit()


if __name__ == "__main__":
    try:
        run(*asked())
    except dd.errors.DondoloError as error:
        print(f"dondolo: {error}", file=sys.stderr)
        sys.exit(2)
