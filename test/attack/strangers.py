"""Files of others in the places of dondolo's: links, pipes and sockets, and files that no run has written.

A run must refuse them with one sentence that names the file, before it computes anything, and leave all as it was;
once the stranger is gone the same run must end as usual. What is read must not be waited for either.
"""

from __future__ import annotations

import os
import random
import shutil
import signal
import socket
import stat
import subprocess
from collections.abc import Callable
from functools import partial
from pathlib import Path

from readers import Tally
from runs import Ended, Study
from samples import Programs

# What a run that waits is given [s]
PATIENCE = 30
RUN = "20260101T000000Z-0123456789abcdef"
# What a user may have under any name; some of it looks like a file of dondolo
TEXTS = (
    b"",
    b"\n",
    b"a,b\n1,2\n",
    b"# dondolo, my notes\na\n1\n",
    b"# dondolo 1st try\na\n1\n",
    b"#dondolo 0.1.0\na\n1\n",
    f'{{"run": "{RUN}", "format": "my run"}}\n'.encode(),
    f'["dondolo run 2", "{RUN}"]\n'.encode(),
    b"dondolo count 4\n",
    b"dondolo_lock\n",
    b"PK\x03\x04 an archive\n",
    b"\x89PNG\r\n\x1a\n a picture\n",
    b"\xff\xfe\x00\x00",
    b"<!-- dondolo --><nrml/>\n",
    b'<meta name="generator" content="dondolo report">\n',
)
# Places of each task: what names of files end with, and the options of the run
RESULTS = {
    "history": ("_walls.csv", "_history.csv", "_run.json", ".lock"),
    "stripes": ("_walls.csv", "_histories.csv", "_stripes.csv", "_fragility.csv", "_run.json", ".lock"),
    "typology": ("_walls.csv", "_typology.csv", "_run.json", ".lock", ".checkpoint", ".checkpoint.lock"),
}
PARTS = ("_walls_1-2.counts", "_walls_1-2.counts.lock")
INPUTS = ("records.csv", "walls.csv", "r2.txt", "case.nml")


class Strangers:
    """Files of others.

    Parameters
    ----------
    programs : Programs
    folder : Path
        To work in.
    """

    def __init__(self, programs: Programs, folder: Path) -> None:
        self.programs, self.folder = programs, folder
        folder.mkdir(parents=True)
        self.mine = folder / "mine.txt"
        self.studies = {task: Study(programs, folder / task, task) for task in RESULTS}
        self.expected: dict[str, dict[str, bytes]] = {}

    def run(self, family: str, trials: int) -> Tally:
        """Put a stranger in a place by chance, as often as is asked for."""
        tally = Tally(family)
        self.expected = {task: study.whole() for task, study in self.studies.items()}
        for number in range(trials):
            chance = random.Random(f"{family}:{number}")
            tally.cases += 1
            if wrong := self.trial(family, chance):
                tally.failures.append(f"{family}:{number}: {wrong}")
            else:
                tally.refused += 1
        return tally

    def trial(self, family: str, chance: random.Random) -> str:
        """What is wrong with one trial, if anything."""
        study = self.studies[chance.choice(list(RESULTS))]
        study.clean()
        study.out.mkdir()
        self.mine.write_bytes(b"mine\n")
        if family != "foreign files" and chance.random() < 0.25:
            return self.input(family, study, chance)
        names = RESULTS[study.task] + (PARTS if study.task == "typology" else ())
        name = chance.choice(names)
        path = study.out / f"study{name}"
        put(family, path, self.mine, chance)
        if name.endswith((".checkpoint", ".counts")) and path.is_file() and not path.stat().st_size:
            # A run may have been killed before its first byte, and an empty file holds nothing.
            path.write_bytes(TEXTS[1])
        before = look(study.out)
        options = ("--walls", "1:2") if name in PARTS else ()
        if not options and chance.random() < 0.2 and not name.endswith((".lock", ".checkpoint")):
            options = ("--check",)
        ended = self.end(study, *options)
        wrong = self.judged(ended, path)
        if not wrong and (look(study.out) != before or self.mine.read_bytes() != b"mine\n"):
            wrong = f"{name}: the folder has changed: {sorted(look(study.out))}"
        if not wrong and (self.folder / "none.txt").exists():
            wrong = f"{name}: a link was followed"
        path.unlink()
        if not wrong and chance.random() < 0.2:
            ended = self.end(study)
            if ended.code or study.contents().keys() != self.expected[study.task].keys():
                wrong = f"{name}: without it the run ends with {ended}"
        return wrong

    def input(self, family: str, study: Study, chance: random.Random) -> str:
        """A stranger in the place of an input: a link is followed, and a pipe is refused."""
        name = chance.choice([name for name in INPUTS if name != "walls.csv" or study.task == "typology"])
        path = study.folder / name
        content = path.read_bytes()
        kept = path.rename(path.with_name("kept.txt"))
        try:
            if family == "links":
                path.symlink_to(kept)
                ended = self.end(study)
                differ = study.contents().keys() != self.expected[study.task].keys()
                return f"{name}: a link to an input: {ended}" if ended.code or differ else ""
            put(family, path, self.mine, chance)
            ended = self.end(study)
            return self.judged(ended, path)
        finally:
            path.unlink()
            kept.rename(path)
            assert path.read_bytes() == content

    def end(self, study: Study, *options: str) -> Ended:
        """Run a study, which may not wait."""
        try:
            done = subprocess.run(
                study.command(*options), capture_output=True, text=True, timeout=PATIENCE, check=False
            )
        except subprocess.TimeoutExpired:
            return Ended(-signal.SIGALRM, ["waits"])
        return Ended(done.returncode, done.stderr.splitlines())

    def judged(self, ended: Ended, path: Path) -> str:
        """What is wrong with a refusal, if anything."""
        if ended.code != 2 or len(ended.said) != 1 or ended.unclear():
            return f"{path.name}: code {ended.code}: {ended.said[:3]}"
        return "" if path.name in ended.said[0] else f"{path.name} is not named: {ended.said[0]}"


def put(family: str, path: Path, mine: Path, chance: random.Random) -> None:
    """Put a stranger in a place."""
    if family == "links":
        path.symlink_to(chance.choice((mine, mine.with_name("none.txt"), Path("/dev/null"), path, mine.parent)))
    elif family == "pipes":
        if chance.random() < 0.7:
            os.mkfifo(path)
        else:
            # The path of a socket may have about 100 bytes.
            here = Path.cwd()
            os.chdir(path.parent)
            with socket.socket(socket.AF_UNIX) as listener:
                listener.bind(path.name)
            os.chdir(here)
    else:
        text = bytearray(chance.choice(TEXTS))
        if text and chance.random() < 0.3:
            # Nor does a byte here or there make it one of dondolo's.
            text[chance.randrange(len(text))] ^= 1 << chance.randrange(8)
        path.write_bytes(bytes(text) * chance.choice((1, 1, 1, 1000)))


def look(folder: Path) -> dict[str, tuple[int, bytes]]:
    """What lies in a folder, no link followed and no pipe opened."""
    found = {}
    for path in folder.iterdir():
        status = path.lstat()
        found[path.name] = (status.st_mode, path.read_bytes() if stat.S_ISREG(status.st_mode) else b"")
    return found


def families(programs: Programs, folder: Path, trials: int) -> dict[str, Callable[[], Tally]]:
    """The families, each with what runs it."""

    def attacked(family: str) -> Tally:
        shutil.rmtree(folder, ignore_errors=True)
        return Strangers(programs, folder).run(family, trials)

    return {family: partial(attacked, family) for family in ("links", "pipes", "foreign files")}
