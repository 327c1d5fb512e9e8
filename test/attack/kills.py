"""Kills at random moments, runs side by side on one output or one checkpoint, and disks that are full."""

from __future__ import annotations

import os
import random
import signal
import subprocess
import time
from collections.abc import Callable
from functools import partial
from pathlib import Path

from readers import Tally
from runs import Ended, Judge, Study, changed
from samples import Programs

SIGNALS = (signal.SIGKILL, signal.SIGTERM, signal.SIGINT)
# Sizes of the small disk, and largest files [kB]
SIZES = (4, 8, 12, 16, 20, 24, 28, 32, 40, 48, 64, 96)
# Walls and samples of a record of a run that is killed: about 0.2 s
WALLS, SAMPLES = 40, 3000
PYTHON_RUN = Path(__file__).with_name("python_run.py")


class Kills:
    """Runs that do not end as they should, or not alone.

    Parameters
    ----------
    programs : Programs
    folder : Path
        To work in.
    """

    def __init__(self, programs: Programs, folder: Path) -> None:
        self.programs, self.folder = programs, folder
        folder.mkdir(parents=True)
        self.judge = Judge(programs, folder)
        self.prefix = folder / "out/study"

    def study(self, name: str, task: str, walls: int, more: str = "") -> Study:
        """A study whose output is that of all the others."""
        return Study(self.programs, self.folder / name, task, walls, SAMPLES, more=more)

    def python(self, what: str = "typology") -> subprocess.Popen[str]:
        """Begin the population of ``new`` in Python, with a checkpoint."""
        command = [self.programs.python, PYTHON_RUN, what, str(self.folder)]
        return subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)

    def kills(self, trials: int) -> Tally:
        """Kill runs at random moments; then let them go on."""
        tally = Tally("killed")
        for task, share in (("typology", 0.6), ("stripes", 0.25), ("python", 0.15)):
            old = self.study("old", "stripes" if task == "stripes" else "typology", 7)
            new = self.study("new", old.task, WALLS)
            start = self.python if task == "python" else new.start
            old.whole()
            old_digest = self.judge.digest(self.prefix)
            old.clean()
            old.out.mkdir()
            began = time.monotonic()
            ended = end(start())
            length = time.monotonic() - began
            expected, new_digest = new.contents(), self.judge.digest(self.prefix)
            if ended.code != 0:
                raise RuntimeError(f"{task}: {ended}")
            for number in range(round(share * trials)):
                chance = random.Random(f"kills:{task}:{number}")
                label = f"kills:{task}:{number}"
                old.whole()
                # Several kills of one run, before it may end
                for _ in range(chance.choice((1, 1, 2, 3))):
                    process = start()
                    time.sleep(chance.uniform(0.0, 1.05 * length))
                    process.send_signal(how := chance.choice(SIGNALS))
                    ended = end(process)
                    found = self.judge.digest(self.prefix)
                    tally.cases += 1
                    wrong = "" if task == "python" and ended.code in (1, -how) else ended.unclear()
                    if not wrong and found not in (old_digest, new_digest):
                        wrong = found
                    if wrong:
                        tally.failures.append(f"{label}: {how.name}: {wrong}")
                    elif found == new_digest:
                        tally.read += 1
                    else:
                        tally.refused += 1
                ended = end(start())
                differ = changed(new.contents(), expected)
                if ended.code != 0 or differ:
                    tally.failures.append(
                        f"{label}: goes on with code {ended.code} {ended.said[-1:]}; differs: {differ}"
                    )
        return tally

    def together(self, trials: int) -> Tally:
        """Two and three runs of different studies at once on one output: one whole study, clear refusals."""
        tally = Tally("one output")
        kinds = ("typology", "stripes", "history")
        studies = [self.study(f"at_once_{i}", "typology", WALLS + i) for i in range(3)]
        studies += [self.study(f"at_once_{task}", task, WALLS) for task in kinds[1:]]
        known = {}
        for study in studies:
            contents = study.whole()
            known[self.judge.digest(self.prefix)] = (study, contents)
        for number in range(trials):
            chance = random.Random(f"together:{number}")
            chosen = chance.sample(studies[:3], 2 + number % 2) if chance.random() < 0.8 else chance.sample(studies, 2)
            studies[0].clean()
            self.compare(tally, f"together:{number}", [study.start for study in chosen], known)
        return tally

    def one_checkpoint(self, trials: int) -> Tally:
        """Two and three runs at once on one checkpoint: parts of the executable, populations in Python, both."""
        tally = Tally("one checkpoint")
        study = self.study("new", "typology", WALLS)
        part = partial(study.start, "--walls", f"1:{WALLS}")
        for starts, share in (([part] * 3, 0.6), ([self.python] * 2, 0.4)):
            study.clean()
            study.out.mkdir()
            ended = end(starts[0]())
            expected = study.contents()
            if ended.code != 0:
                raise RuntimeError(str(ended))
            for number in range(round(share * trials)):
                study.clean()
                study.out.mkdir()
                self.compare(tally, f"checkpoint:{number}", starts[: 2 + number % 2], {"": (study, expected)})
        return tally

    def compare(
        self,
        tally: Tally,
        label: str,
        starts: list[Callable[[], subprocess.Popen[str]]],
        known: dict[str, tuple[Study, dict[str, bytes]]],
    ) -> None:
        """Run at once, and look at what came of it."""
        ended = [end(process) for process in [start() for start in starts]]
        codes = sorted(one.code for one in ended)
        found = "" if "" in known else self.judge.digest(self.prefix)
        wrong = "; ".join(filter(None, (one.unclear() for one in ended)))
        if not wrong and found not in known:
            wrong = f"the results are those of no study: {found}"
        if not wrong and (differ := changed(known[found][0].contents(), known[found][1])):
            wrong = f"codes {codes}, and files differ: {differ}"
        if not wrong and (0 not in codes or any(code not in (0, 2) for code in codes)):
            wrong = f"codes {codes}: {[one.said[:1] for one in ended]}"
        tally.cases += 1
        if wrong:
            tally.failures.append(f"{label}: {wrong}")
            return
        tally.read += codes.count(0)
        tally.refused += codes.count(2)

    def full_disks(self) -> Tally:
        """Disks and files that have room for some of the results."""
        tally = Tally("full disk")
        old = self.study("old", "typology", 4)
        new = self.study("new", "typology", 12)
        expected = new.whole()
        new_digest = self.judge.digest(self.prefix)
        old.whole()
        old_digest = self.judge.digest(self.prefix)
        for size in SIZES:
            # bash counts blocks of 1024 bytes
            limited = ["bash", "-c", f'ulimit -f {size}; exec "$@"', "bash", *new.command()]
            old.whole()
            ended = end(subprocess.Popen(limited, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True))
            self.after_full(tally, f"files of {size} kB", ended, new, (old_digest, new_digest), expected)
        mount = ["mount", "-t", "tmpfs", "-o", "size=256k", "none", str(old.out)]
        if os.geteuid() != 0 or subprocess.run(mount, capture_output=True, check=False).returncode != 0:
            tally.skipped = "the small disk was left out: mounting it needs root"
            return tally
        try:
            for size in SIZES:
                for path in old.out.iterdir():
                    path.unlink()
                subprocess.run(["mount", "-o", "remount,size=256k", old.out], check=True)
                old.run()
                used = sum(-(-path.stat().st_size // 4096) * 4 for path in old.out.iterdir())
                subprocess.run(["mount", "-o", f"remount,size={used + size}k", old.out], check=True)
                ended = new.run()
                found = self.judge.digest(self.prefix)
                subprocess.run(["mount", "-o", "remount,size=256k", old.out], check=True)
                self.after_full(tally, f"disk of {size} kB", ended, new, (old_digest, new_digest), expected, found)
        finally:
            subprocess.run(["umount", old.out], check=False)
        return tally

    def after_full(
        self,
        tally: Tally,
        label: str,
        ended: Ended,
        new: Study,
        digests: tuple[str, str],
        expected: dict[str, bytes],
        found: str = "",
    ) -> None:
        """The old results or the new ones; then the next run has room."""
        found = found or self.judge.digest(self.prefix)
        wrong = ended.unclear()
        if not wrong and found != digests[ended.code == 0]:
            wrong = f"code {ended.code}, and then: {found}"
        again = new.run()
        if not wrong and (again.code != 0 or changed(new.contents(), expected)):
            wrong = f"the next run: code {again.code} {again.said[-1:]} differs: {changed(new.contents(), expected)}"
        tally.cases += 1
        if wrong:
            tally.failures.append(f"{label}: {wrong}")
        elif ended.code == 0:
            tally.read += 1
        else:
            tally.refused += 1


def end(process: subprocess.Popen[str]) -> Ended:
    """Wait for a run."""
    said = process.communicate(timeout=300)[1]
    return Ended(process.returncode, (said or "").splitlines())
