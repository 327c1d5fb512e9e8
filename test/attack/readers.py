"""Damaged files for every reader: many in one process, which sanitizers watch; results and archives in Python.

What a reader may do with a file is to read it, with values that can be, or to refuse it by one clear sentence that
names it. It must not crash, hang, leak, take much memory, or take what cannot be.
"""

from __future__ import annotations

import io
import json
import os
import random
import re
import select
import signal
import subprocess
import time
import zipfile
import zlib
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path

from mutate_data import Damage
from samples import TASKS, Programs, case, readers_samples, result_sets, write_inputs

# CPU time that one small file may take [s], and memory of a process that reads many of them [kB]
LONGEST_CPU, LARGEST_MEMORY = 10.0, 1_500_000
# Longest sentence of a refusal [bytes]: names that a file gives are shown
LONGEST_MESSAGE = 4000
SANITIZERS = {
    "ASAN_OPTIONS": "max_allocation_size_mb=3000:allocator_may_return_null=1:quarantine_size_mb=8",
    "UBSAN_OPTIONS": "print_stacktrace=1",
    "OMP_NUM_THREADS": "1",
}
FORTRAN = ("case", "walls", "catalogue", "numbers", "records", "store")
PYTHON = ("results", "archive", "hazard", "openquake", "nrml", "template")
COMMANDS = ("report", "plot", "xlsx", "curves")
EXECUTABLE = ("study", "merge")


@dataclass
class Tally:
    """What came of the cases of a family."""

    family: str
    cases: int = 0
    read: int = 0
    refused: int = 0
    skipped: str = ""
    failures: list[str] = field(default_factory=list)
    sentences: Counter[str] = field(default_factory=Counter)

    def note(self, said: str, label: str) -> bool:
        """Count an answer; False if it is a failure."""
        self.cases += 1
        if said.startswith("read"):
            self.read += 1
            return True
        if said.startswith("refused "):
            self.refused += 1
            self.sentences[re.sub(r"'[^']*'|\d+", "?", said)[:80]] += 1
            return True
        self.failures.append(f"{label}: {said}")
        return False


def template() -> bytes:
    """A template of an office with a macro, a link and a field of another file; no archive without python-docx."""
    try:
        import docx
    except ImportError:
        return b"PK"
    file, made, changed = docx.Document(), io.BytesIO(), io.BytesIO()
    file.sections[0].header.paragraphs[0].text = "Studio"
    file.save(made)
    of = "http://schemas.microsoft.com/office/2006/relationships/vbaProject"
    link = "http://schemas.openxmlformats.org/officeDocument/2006/relationships/hyperlink"
    relations = (
        f'<Relationship Id="m" Type="{of}" Target="vbaProject.bin"/><Relationship Id="l" Type="{link}" Target="x:/" '
    )
    field = '<w:p><w:fldSimple w:instr="INCLUDETEXT c:/a.txt"/></w:p>'
    with zipfile.ZipFile(made) as archive, zipfile.ZipFile(changed, "w", zipfile.ZIP_DEFLATED) as office:
        for name in archive.namelist():
            content = archive.read(name)
            if name == "word/_rels/document.xml.rels":
                end = b"</Relationships>"
                content = content.replace(end, relations.encode() + b'TargetMode="External"/>' + end)
            if name == "word/document.xml":
                content = content.replace(b"<w:body>", b"<w:body>" + field.encode())
            office.writestr(name, content)
        office.writestr("word/vbaProject.bin", b"Sub AutoOpen()")
    return changed.getvalue()


class Reader:
    """A process that answers lines `FAMILY PATH`, and is watched."""

    def __init__(self, command: list[str | Path], folder: Path, environment: dict[str, str]) -> None:
        self.command, self.folder, self.environment = command, folder, os.environ | environment
        self.process: subprocess.Popen[bytes] | None = None

    def start(self) -> subprocess.Popen[bytes]:
        if self.process is None:
            self.stderr = (self.folder / "stderr").open("w+b")
            self.process = subprocess.Popen(
                self.command,
                stdin=subprocess.PIPE,
                stdout=subprocess.PIPE,
                stderr=self.stderr,
                cwd=self.folder,
                env=self.environment,
            )
            self.rest = b""
        return self.process

    def ask(self, family: str, path: Path) -> str:
        """The answer for a file, or what became of the process."""
        process = self.start()
        assert process.stdin is not None
        assert process.stdout is not None
        before, began = self.cpu(), time.monotonic()
        try:
            process.stdin.write(f"{family} {path}\n".encode())
            process.stdin.flush()
        except BrokenPipeError:
            return self.died()
        while b"\n" not in self.rest:
            ready, _, _ = select.select([process.stdout], [], [], 2.0)
            if ready:
                if not (more := os.read(process.stdout.fileno(), 1 << 16)):
                    return self.died()
                self.rest += more
            elif self.cpu() - before > LONGEST_CPU or time.monotonic() - began > 300.0:
                process.kill()
                self.died()
                return f"HANGS: more than {LONGEST_CPU:g} s"
        said, self.rest = self.rest.split(b"\n", 1)
        return judged(said, path)

    def died(self) -> str:
        """What a process that ended says of it."""
        assert self.process is not None
        code = self.process.wait()
        self.process = None
        self.stderr.seek(0)
        lines = self.stderr.read().decode(errors="replace").splitlines()
        marks = (
            "ERROR: ",
            "runtime error",
            "Fortran runtime",
            "Error allocating",
            "Error termination",
            "Traceback",
            "Error:",
        )
        why = [line.strip() for line in lines if any(mark in line for mark in marks)] + lines[-1:]
        place = [line.strip() for line in lines if re.search(r"in __dondolo\S+ |#\d+ .*dondolo_", line)][:2]
        return f"ENDS with code {code}: {' / '.join(why[:1] + place)}"

    def cpu(self) -> float:
        """CPU time of the process so far [s]."""
        assert self.process is not None
        try:
            words = Path(f"/proc/{self.process.pid}/stat").read_text().rpartition(")")[2].split()
        except OSError:
            return 0.0
        return (int(words[11]) + int(words[12])) / os.sysconf("SC_CLK_TCK")

    def memory(self) -> int:
        """Largest memory of the process so far [kB]."""
        if self.process is None or self.process.poll() is not None:
            return 0
        found = re.search(r"VmHWM:\s*(\d+)", Path(f"/proc/{self.process.pid}/status").read_text())
        return int(found[1]) if found else 0

    def end(self) -> str:
        """Let the process end; what it says then, such as of memory that it lost."""
        if self.process is None:
            return ""
        assert self.process.stdin is not None
        self.process.stdin.close()
        return "" if self.process.wait() == 0 else self.died()


def agreeing(files: dict[str, bytes]) -> bytes:
    """The file of a run with the lengths and check sums of its tables made right, so that their contents are read."""
    run = json.loads(files["_run.json"])
    for one in run.get("files", []):
        content = files[one["name"]]
        body = (
            content.split(b"\n", 2)[2:] if content.split(b"\n", 2)[1:2] and b"\n# run: " in content[:200] else [content]
        )
        one |= {"bytes": len(content), "crc32": f"{zlib.crc32(b''.join(body)):08x}"}
    return json.dumps(run).encode()


def judged(said: bytes, path: Path) -> str:
    """An answer, and what is wrong with its sentence if anything is."""
    try:
        text = said.decode()
    except UnicodeDecodeError:
        return f"UNCLEAR: not UTF-8: {said[:200]!r}"
    if text.startswith("refused "):
        lines = text.removeprefix("refused ").split("|")
        if not lines[0].strip():
            return "UNCLEAR: no sentence"
        if any(
            ord(c) < 32 or 127 <= ord(c) < 160 or c in "\u2028\u2029\u202a\u202b\u202d\u202e\u2066\u2067" for c in text
        ):
            return f"UNCLEAR: control characters: {text[:300]!r}"
        if max(map(len, lines)) > LONGEST_MESSAGE:
            return f"UNCLEAR: {max(map(len, lines))} characters: {text[:100]}"
        if str(path) not in text and path.parent.name not in text:
            return f"UNCLEAR: does not name the file: {text[:200]}"
    return text


class Attack:
    """All families of damaged files.

    Parameters
    ----------
    programs : Programs
    folder : Path
        To work in, in memory if possible.
    kept : Path
        Where files that made something fail are kept.
    """

    def __init__(self, programs: Programs, folder: Path, kept: Path) -> None:
        self.programs, self.folder, self.kept = programs, folder, kept
        self.inputs = folder / "inputs"
        self.samples = readers_samples(programs, self.inputs)
        self.results = result_sets(programs, folder / "results")
        self.samples["archive"] = self.archives()
        self.samples["hazard"] = self.samples["numbers"]
        self.samples["template"] = [template()]

    def archives(self) -> list[bytes]:
        """Results that Python saves."""
        out = self.folder / "archives"
        out.mkdir(exist_ok=True)
        subprocess.run([self.programs.python, Path(__file__).with_name("results.py"), "samples", out], check=True)
        return [path.read_bytes() for path in sorted(out.iterdir())]

    def shares(self, cases: int) -> Iterator[tuple[str, int]]:
        """How many cases each family gets: a whole run of the executable costs as much as many readings."""
        for family in (*FORTRAN, *PYTHON, *COMMANDS, *EXECUTABLE):
            yield family, max(1, cases // 10) if family in (*EXECUTABLE, *COMMANDS) else cases

    def damaged(self, family: str, number: int) -> tuple[random.Random, bytes]:
        """Contents of a case: always the same for its family and number."""
        chance = random.Random(f"{family}:{number}")
        samples = self.samples[family]
        damage = Damage(chance, samples)
        kinds = {"store": damage.store, "archive": damage.archive, "template": damage.office}
        content = chance.choice(samples)
        if len(content) > 20_000 and chance.random() < 0.95:
            content = chance.choice([one for one in samples if len(one) <= 20_000] or samples)
        return chance, kinds.get(family, damage.text)(content)

    def prepare(self, family: str, number: int) -> tuple[str, Path]:
        """Write the files of a case: the family to ask for, and the path."""
        if family == "results" or family in COMMANDS:
            return family, self.damaged_results(family, number)
        suffix = {"archive": ".npz", "case": ".nml", "template": ".docx"}.get(family, "")
        path = self.inputs / f"attacked{suffix}"
        path.write_bytes(self.damaged(family, number)[1])
        return family, path

    def damaged_results(self, family: str, number: int) -> Path:
        """A set of result files one of which is damaged, or that of another run."""
        chance = random.Random(f"{family}:{number}")
        task = chance.choice(TASKS)
        files = dict(self.results[task])
        damage = Damage(chance, [one for kind in self.results.values() for one in kind.values()])
        name = chance.choice(("_run.json", "_walls.csv", chance.choice(sorted(files))))
        kind = damage.json if name.endswith(".json") else damage.text
        files[name] = kind(files[name])
        if name != "_run.json" and chance.random() < 0.7:
            files["_run.json"] = agreeing(files)
        folder = self.folder / "attacked"
        folder.mkdir(exist_ok=True)
        for old in folder.iterdir():
            old.unlink()
        for suffix, content in files.items():
            (folder / f"study{suffix}").write_bytes(content)
        return folder / "study"

    def reader(self, family: str) -> Reader:
        """A process for a family."""
        if family in (*PYTHON, *COMMANDS):
            return Reader([self.programs.python, Path(__file__).with_name("results.py"), "attack"], self.folder, {})
        return Reader([self.programs.readers, "attack"], self.folder, SANITIZERS)

    def run(self, family: str, numbers: range) -> Tally:
        """Cases of a family, one after the other."""
        tally = Tally(family)
        if family in EXECUTABLE:
            for number in numbers:
                self.try_executable(family, number, tally)
            return tally
        reader = self.reader(family)
        largest = 0
        for number in numbers:
            asked, path = self.prepare(family, number)
            if not tally.note(reader.ask(asked, path), f"{family}:{number}") and path.is_file():
                self.kept.mkdir(parents=True, exist_ok=True)
                (self.kept / f"{family}_{number}").write_bytes(path.read_bytes())
            if number % 50 == 0 and (memory := reader.memory()) > max(largest, LARGEST_MEMORY):
                largest = memory
                tally.failures.append(f"{family}:{number}: MEMORY: {memory} kB by one of the last 50")
        if said := reader.end():
            tally.failures.append(f"{family}: at the end: {said}")
        return tally

    def try_executable(self, family: str, number: int, tally: Tally) -> None:
        """A whole case, one of whose files is damaged, or a merge of damaged counts."""
        chance = random.Random(f"{family}:{number}")
        folder = self.folder / "whole"
        write_inputs(folder)
        out = folder / "out"
        for old in out.glob("*") if out.is_dir() else ():
            old.unlink()
        task = "typology" if family == "merge" else chance.choice(TASKS)
        files = {"case.nml": case(task, str(out / "study")).encode()}
        files |= {name: (folder / name).read_bytes() for name in ("records.csv", "walls.csv", "r1.txt")}
        arguments: list[str | Path] = [folder / "case.nml"]
        if family == "merge":
            counts = folder / "damaged.counts"
            damage = Damage(chance, self.samples["store"])
            content = self.samples["store"][0]
            counts.write_bytes(damage.store(content) if chance.random() < 0.95 else content)
            arguments = ["--merge", *arguments, counts]
        else:
            name = chance.choice(sorted(files))
            files[name] = Damage(chance, list(files.values())).text(files[name])
            arguments = ["--check"] * chance.choice((0, 0, 1)) + arguments
        for name, content in files.items():
            (folder / name).write_bytes(content)
        said = run_whole([self.programs.checked, *arguments], folder, out)
        tally.note(said, f"{family}:{number}")


def run_whole(command: list[str | Path], folder: Path, out: Path) -> str:
    """Run the executable on a case: as a reader's answer."""
    limited = ["bash", "-c", 'ulimit -t 60; exec "$@"', "bash", *command]
    with subprocess.Popen(
        limited, cwd=folder, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, env=os.environ | SANITIZERS
    ) as process:
        try:
            error = process.communicate(timeout=600)[1]
        except subprocess.TimeoutExpired:
            process.kill()
            return "HANGS: more than 600 s"
    code = process.returncode
    if code == -signal.SIGXCPU:
        return "HANGS: more than 60 s of CPU time"
    lines = error.decode(errors="replace").splitlines()
    told = [line for line in lines if not line.startswith(("dondolo: warning: ", "dondolo: note: "))]
    if code not in (0, 1, 2) or any("runtime error" in line or "Sanitizer" in line for line in lines):
        return f"ENDS with code {code}: {' / '.join(told[:4])[:500]}"
    if any(not line.startswith("dondolo: ") for line in lines):
        return f"UNCLEAR: {told[:3]}"
    files = sorted(out.glob("*")) if out.is_dir() else []
    if code == 0:
        return "read" if not told and not (bad := not_numbers(files)) else f"UNSOUND: {told} {bad}"
    if files:
        return f"LEAVES {[path.name for path in files]} after: {told[:1]}"
    return f"refused {told[0]}" if told else "UNCLEAR: no sentence"


def not_numbers(files: list[Path]) -> list[str]:
    """Cells of result files that are NaN or infinite."""
    bad = re.compile(rb"(?i)(?:^|[,\s:\[])[-+]?(?:nan|inf(?:inity)?)(?=[,\s\]}]|$)", re.M)
    return [f"{path.name}: {bad.search(content)!r}" for path in files if bad.search(content := path.read_bytes())]
