"""Whole runs: two studies for one output, what lies there afterwards, and whether it is one of the two."""

from __future__ import annotations

import os
import re
import shutil
import signal
import subprocess
from dataclasses import dataclass, field
from pathlib import Path

from readers import Reader
from samples import Programs, case, write_inputs

# What tells one run of a study from another: its name, and when it was
_RUN = re.compile(rb"\d{8}T\d{6}Z-[0-9a-f]{16}|\d{4}-\d\d-\d\dT\d\d:\d\d:\d\d(?:\.\d+)?(?:Z|[+-]\d\d:\d\d)")


@dataclass
class Ended:
    """A run that ended: exit code, or minus the number of a signal; what it said."""

    code: int
    said: list[str] = field(default_factory=list)

    def unclear(self) -> str:
        """What is wrong with how it ended, if anything."""
        told = [line for line in self.said if not line.startswith(("dondolo: warning: ", "dondolo: note: "))]
        if any(not line.startswith("dondolo: ") for line in told):
            return f"code {self.code}: {' / '.join(self.said)[-300:]}"
        if self.code == 0 and told:
            return f"code 0, but: {told[0]}"
        if self.code in (1, 2) and not told:
            return f"code {self.code} without a sentence"
        return (
            ""
            if self.code in (0, 1, 2, -signal.SIGKILL, -signal.SIGTERM, -signal.SIGINT)
            else f"code {self.code}: {told}"
        )


class Study:
    """A study of the executable, whose output lies in a folder that another study uses too.

    Parameters
    ----------
    programs : Programs
    folder : Path
        Its inputs; the output is in ``out`` of the folder above.
    task : str
    walls, samples : int
        How many walls, and how long the records: how long it takes.
    threads : int
    """

    def __init__(
        self,
        programs: Programs,
        folder: Path,
        task: str,
        walls: int = 4,
        samples: int = 300,
        threads: int = 1,
        more: str = "",
    ) -> None:
        self.programs, self.folder, self.task = programs, folder, task
        self.out = folder.parent / "out"
        write_inputs(folder, walls, samples)
        self.case = folder / "case.nml"
        text = case(task, str(self.out / "study"), more).replace("threads = 1", f"threads = {threads}")
        self.case.write_text(text.replace("It''s a study", folder.name))

    def command(self, *arguments: str | Path) -> list[str | Path]:
        """The command that runs it."""
        return [self.programs.executable, "--quiet", *arguments, self.case]

    def run(self, environment: dict[str, str] | None = None, *arguments: str | Path) -> Ended:
        """Run it to its end."""
        done = subprocess.run(
            self.command(*arguments),
            capture_output=True,
            text=True,
            env=os.environ | (environment or {}),
            timeout=120,
            check=False,
        )
        return Ended(done.returncode, done.stderr.splitlines())

    def start(self, *arguments: str | Path) -> subprocess.Popen[str]:
        """Begin a run."""
        return subprocess.Popen(self.command(*arguments), stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)

    def contents(self) -> dict[str, bytes]:
        """What lies in the folder of the output, apart from what tells one run of a study from another."""
        return {path.name: _RUN.sub(b"RUN", path.read_bytes()) for path in sorted(self.out.glob("*"))}

    def clean(self) -> None:
        """Remove all output."""
        shutil.rmtree(self.out, ignore_errors=True)

    def whole(self) -> dict[str, bytes]:
        """What lies there after an undisturbed run."""
        self.clean()
        ended = self.run()
        if ended.code != 0:
            raise RuntimeError(f"{self.case}: {ended}")
        return self.contents()


class Judge:
    """Says of which study the results are that a reader finds under a prefix."""

    def __init__(self, programs: Programs, folder: Path) -> None:
        self.reader = Reader([programs.python, Path(__file__).with_name("results.py"), "attack"], folder, {})

    def digest(self, prefix: Path) -> str:
        """A digest of all results there; ``none`` where there are no files; else what is wrong."""
        return self.reader.ask("set", prefix).removeprefix("read ")


def changed(first: dict[str, bytes], second: dict[str, bytes]) -> str:
    """Names of files that differ, are missing or are too many."""
    return ", ".join(sorted(name for name in first.keys() | second.keys() if first.get(name) != second.get(name)))
