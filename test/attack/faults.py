"""Every call of a run on its files fails once: open, read, write, flush, fsync, rename, remove, close, allocate.

A library that is preloaded (faults.inc) counts the calls and makes one fail: with an error, cut short, or by the kill
of the process before or after it. Whatever happens, a reader then finds the old results or the new ones, the run said
what was wrong unless it was killed, and the next run ends with the same bytes as one that nothing disturbed.
"""

from __future__ import annotations

import errno
import json
import os
import shutil
import subprocess
from collections.abc import Callable
from pathlib import Path

from readers import Tally
from runs import Ended, Judge, Study, changed
from samples import Programs, write_inputs

ERRORS = (errno.ENOSPC, errno.EIO, errno.EDQUOT)
SHORT, KILL, KILL_AFTER = 0, -1, -2
# Allocations that fail; from the second size on they are of the input's size, and the run says what it lacks [bytes]
SMALL, LARGE = 32768, 2**20


def build(folder: Path) -> Path:
    """Compile the library that is preloaded."""
    library = folder / "faults.so"
    source = Path(__file__).with_name("faults.inc")
    subprocess.run(["gcc", "-shared", "-fPIC", "-O1", "-x", "c", source, "-o", library, "-ldl"], check=True)
    return library


class Faults:
    """Failing calls.

    Parameters
    ----------
    programs : Programs
    folder : Path
        To work in.
    """

    def __init__(self, programs: Programs, folder: Path) -> None:
        self.programs, self.folder = programs, folder
        folder.mkdir(parents=True)
        self.library = build(folder)
        self.judge = Judge(programs, folder)

    def environment(self, at: int, how: int, large: int = 0) -> dict[str, str]:
        """What makes the call `at` fail."""
        given = {
            "LD_PRELOAD": str(self.library),
            "ATTACK_FOLDER": str(self.folder),
            "ATTACK_AT": str(at),
            "ATTACK_HOW": str(how),
        }
        if at == 0:
            given["ATTACK_LOG"] = str(self.folder / "log")
        return given | ({"ATTACK_LARGE": str(large)} if large else {})

    def calls(self, run: Callable[[dict[str, str]], Ended], large: int = 0) -> list[str]:
        """The calls of a run that nothing disturbs."""
        log = self.folder / "log"
        log.unlink(missing_ok=True)
        ended = run(self.environment(0, 0, large))
        if ended.code != 0:
            raise RuntimeError(f"the library itself disturbs: {ended}")
        return log.read_text().splitlines() if log.exists() else []

    def families(self, step: int) -> dict[str, Callable[[], Tally]]:
        """Every `step`-th call of each run."""
        return {
            "faults typology": lambda: self.executable("typology", step),
            "faults stripes": lambda: self.executable("stripes", step),
            "faults typology (Python)": lambda: self.python("typology", step),
            "faults save (Python)": lambda: self.python("save", step),
            "memory typology": lambda: self.executable("typology", step, SMALL),
            "memory stripes": lambda: self.executable("stripes", step, SMALL),
        }

    def executable(self, task: str, step: int, large: int = 0) -> Tally:
        """Calls of the executable on its inputs and results, or its large allocations."""
        tally = Tally(f"{'memory' if large else 'faults'} {task}")
        old = Study(self.programs, self.folder / "old", task, walls=5)
        new = Study(self.programs, self.folder / "new", task, walls=4)
        new.case.write_text(new.case.read_text().replace("0.5, 0.8", "0.5, 0.9"))
        self.trials(tally, old, new.whole, new.contents, lambda faults: new.run(faults), step, large)
        return tally

    def python(self, what: str, step: int) -> Tally:
        """Calls of Python that runs a population with a checkpoint and saves its tables, or saves a result."""
        tally = Tally(f"faults {what} (Python)")
        old = Study(self.programs, self.folder / "old", "typology", walls=5)
        write_inputs(self.folder / "new", 4)
        script = Path(__file__).with_name("python_run.py")

        def run(faults: dict[str, str]) -> Ended:
            given = (faults.get(f"ATTACK_{name}", otherwise) for name, otherwise in (("AT", 0), ("HOW", 0)))
            request = [what, str(self.folder), *map(int, given), faults.get("ATTACK_LOG", "")]
            print(json.dumps(request), file=runs.stdin, flush=True)
            return Ended(*json.loads(runs.stdout.readline()))

        def whole() -> dict[str, bytes]:
            old.clean()
            old.out.mkdir()
            if (ended := run({})).code != 0:
                raise RuntimeError(str(ended))
            return old.contents()

        # Runs are forks of one process, which has imported what they need.
        environment = os.environ | {"LD_PRELOAD": str(self.library), "ATTACK_FOLDER": str(self.folder)}
        command = [self.programs.python, script, "-"]
        with subprocess.Popen(
            command, env=environment, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True
        ) as runs:
            self.trials(tally, old, whole, old.contents, run, step)
            runs.stdin.close()
        return tally

    def trials(
        self,
        tally: Tally,
        old: Study,
        make_new: Callable[[], dict[str, bytes]],
        contents: Callable[[], dict[str, bytes]],
        run: Callable[[dict[str, str]], Ended],
        step: int,
        large: int = 0,
    ) -> None:
        """All trials of a run that replaces the results of `old`."""
        prefix = old.out / "study"
        expected = make_new()
        new_digest = self.judge.digest(prefix)
        old.whole()
        old_digest = self.judge.digest(prefix)
        kept = self.folder / "kept"
        shutil.rmtree(kept, ignore_errors=True)
        shutil.copytree(old.out, kept)
        calls = self.calls(run, large)
        if old_digest == new_digest or not calls:
            raise RuntimeError("nothing is attacked")
        for number in range(1, len(calls) + 1, step):
            kinds = (errno.ENOMEM,) if large else (ERRORS[number % 3], SHORT, KILL, KILL_AFTER)
            for how in kinds:
                if how == SHORT and not any(
                    f" {name} " in calls[number - 1] for name in ("fwrite", "write", "pwrite", "pread")
                ):
                    continue
                old.clean()
                shutil.copytree(kept, old.out)
                label = f"{tally.family}: call {number} ({calls[number - 1].split(' ', 1)[1]}) {name_of(how)}"
                ended = run(self.environment(number, how, large))
                found = self.judge.digest(prefix)
                # What gfortran says of a small allocation is its own.
                waived = large and ended.code != 0 and int(calls[number - 1].split()[2]) < LARGE
                wrong = "" if waived else ended.unclear()
                if not wrong and found not in (old_digest, new_digest):
                    wrong = f"code {ended.code}, and then: {found}"
                if not wrong and ended.code == 0 and found != new_digest:
                    wrong = "code 0, but the old results"
                for path in old.out.glob("*.npz"):
                    if not (said := self.judge.reader.ask("archive", path)).startswith("read"):
                        wrong = wrong or f"{path.name}: {said}"
                again = run({})
                if not wrong and (again.code != 0 or (differ := changed(contents(), expected))):
                    wrong = (
                        f"the next run: code {again.code} {again.said[-1:]}"
                        if again.code
                        else f"the next run differs: {differ}"
                    )
                tally.cases += 1
                if wrong:
                    tally.failures.append(f"{label}: {wrong}")
                elif found == new_digest:
                    tally.read += 1
                else:
                    tally.refused += 1


def name_of(how: int) -> str:
    """What happens to the call."""
    special = {SHORT: "cut short", KILL: "killed before", KILL_AFTER: "killed after"}
    return special.get(how) or f"fails with {errno.errorcode[how]}"
