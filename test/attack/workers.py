"""Workers that are killed: of a pool of processes, of Dask, of MPI."""

from __future__ import annotations

import importlib.util
import os
import random
import shutil
import signal
import subprocess
import time
from collections.abc import Callable
from contextlib import suppress
from pathlib import Path

from kills import PYTHON_RUN, SAMPLES
from readers import Tally
from runs import Study, changed
from samples import Programs

# Enough for a dozen blocks after the workers have begun
WALLS = 60


class Workers:
    """Kills of workers; then the study goes on without them.

    Parameters
    ----------
    programs : Programs
    folder : Path
        To work in.
    """

    def __init__(self, programs: Programs, folder: Path) -> None:
        self.programs, self.folder = programs, folder
        folder.mkdir(parents=True)
        self.study = Study(programs, folder / "new", "typology", WALLS, SAMPLES)

    def families(self, trials: int) -> dict[str, Callable[[], Tally]]:
        """Kills of each kind of worker that is installed."""
        mpiexec = shutil.which("mpiexec", path=f"{self.programs.python.parent}:{os.environ['PATH']}")
        no_dask = "" if importlib.util.find_spec("distributed") else "Dask is not installed"
        there = mpiexec and importlib.util.find_spec("mpi4py")
        no_mpi = "" if there else "mpi4py or mpiexec is not installed"
        return {
            "workers pool": lambda: self.kills("pool", [], trials),
            "workers dask": lambda: self.kills("dask", [], trials, no_dask),
            "workers mpi": lambda: self.kills("mpi", [mpiexec or "", "-n", "3"], trials, no_mpi),
        }

    def command(self, what: str) -> list[str | Path]:
        """The command of a run in Python."""
        more = ["-m", "mpi4py.futures"] if what == "mpi" else []
        return [self.programs.python, *more, PYTHON_RUN, what, str(self.folder)]

    def kills(self, what: str, before: list[str], trials: int, skipped: str = "") -> Tally:
        """Kill a worker at a random moment, several times."""
        tally = Tally(f"workers {what}", skipped=skipped)
        if skipped:
            return tally
        expected, _ = self.undisturbed([self.programs.python, PYTHON_RUN, "typology", str(self.folder)])
        same, length = self.undisturbed([*before, *self.command(what)])
        if differ := changed(expected, same):
            tally.failures.append(f"{what}: other results than without workers: {differ}")
        for number in range(trials):
            chance = random.Random(f"{what}:{number}")
            self.study.clean()
            self.study.out.mkdir()
            process = subprocess.Popen(
                [*before, *self.command(what)],
                stdout=subprocess.DEVNULL,
                stderr=subprocess.DEVNULL,
                start_new_session=True,
            )
            time.sleep(chance.uniform(0.4, 0.95) * length)
            if alive := workers_of(process.pid):
                with suppress(ProcessLookupError):
                    os.kill(chance.choice(alive), signal.SIGKILL)
            try:
                code = process.wait(60)
            except subprocess.TimeoutExpired:
                os.killpg(process.pid, signal.SIGKILL)
                code = process.wait()
                tally.failures.append(f"{what}:{number}: HANGS after the kill of a worker")
            again = subprocess.run(self.command("typology"), capture_output=True, text=True, check=False)
            # What the killed run has left of its workers would be in the way of the next one
            with suppress(ProcessLookupError):
                os.killpg(process.pid, signal.SIGKILL)
            tally.cases += 1
            tally.read += code == 0
            tally.refused += code != 0
            if again.returncode != 0 or (differ := changed(self.study.contents(), expected)):
                why = again.stderr.splitlines()[-1:] if again.returncode else differ
                tally.failures.append(
                    f"{what}:{number}: ended with code {code}, and goes on with {again.returncode}: {why}"
                )
        return tally

    def undisturbed(self, command: list[str | Path]) -> tuple[dict[str, bytes], float]:
        """What a run writes, and how long it takes [s]."""
        self.study.clean()
        self.study.out.mkdir()
        began = time.monotonic()
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        if done.returncode != 0:
            raise RuntimeError(f"an undisturbed run ended with {done.returncode}: {done.stderr.strip()[-2000:]}")
        return self.study.contents(), time.monotonic() - began


def workers_of(process: int) -> list[int]:
    """Processes below one that have none below them and run Python."""
    leaves = []
    with suppress(OSError):
        below = [int(word) for word in Path(f"/proc/{process}/task/{process}/children").read_text().split()]
        for child in below:
            leaves += workers_of(child)
            command = Path(f"/proc/{child}/cmdline").read_bytes()
            # The tracker of shared resources is no worker.
            if b"python" in command.split(b"\0")[0] and b"resource_tracker" not in command and not workers_of(child):
                leaves.append(child)
    return leaves
