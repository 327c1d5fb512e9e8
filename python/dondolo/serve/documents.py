"""Reports of the case on the page, each made in a process of its own, so that curves go on meanwhile."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import tempfile
import threading
import time
from importlib.util import find_spec
from pathlib import Path

from dondolo._base.arguments import one_of
from dondolo._fortran.files import whole_file
from dondolo.errors import DondoloError, InputError, Interrupted, Problem
from dondolo.reporting.language import LANGUAGES

#: Kinds of documents and their media types
DOCUMENTS = {
    "report": "text/html; charset=utf-8",
    "relazione": "text/html; charset=utf-8",
    "relazione_word": "application/vnd.openxmlformats-officedocument.wordprocessingml.document",
}
# What a kind needs beside dondolo's own dependencies
_NEEDS = {"relazione_word": "docx"}
# What a document may take [s]
_LONGEST = 300.0
# Seconds between two looks at whether it is made
_PAUSE = 0.05


def available_documents() -> list[str]:
    """The kinds of documents that can be made with the packages that are installed."""
    return [kind for kind in DOCUMENTS if kind not in _NEEDS or find_spec(_NEEDS[kind]) is not None]


def make_document(text: str, kind: str, lang: str, stop: threading.Event) -> bytes:
    """Run a case and write a document of its results.

    Parameters
    ----------
    text : str
        The case.
    kind : str
        One of `DOCUMENTS`.
    lang : {'en', 'it'}
        Its language.
    stop : threading.Event
        Once it is set, the process is killed.

    Returns
    -------
    bytes

    Raises
    ------
    Interrupted
        It was stopped.
    InputError
        The case cannot be run, or its document not be written, with the sentence of the library.
    """
    one_of("kind", kind, DOCUMENTS)
    one_of("lang", lang, LANGUAGES)
    with tempfile.TemporaryDirectory(prefix="dondolo-") as folder:
        case, made = (
            Path(folder) / "case.nml",
            Path(folder) / f"{kind}.{'docx' if kind == 'relazione_word' else 'html'}",
        )
        with whole_file(case) as part:
            part.write_text(text, encoding="utf-8", newline="\n")
        command = [sys.executable, "-W", "ignore", "-m", "dondolo.serve.documents", str(case), str(made), lang]
        code, said = _run(command, Path(folder), kind, stop)
        if code != 0 or not made.exists():
            raise _refused(said.replace(f"{folder}/", ""))
        return made.read_bytes()


def _run(command: list[str], folder: Path, kind: str, stop: threading.Event) -> tuple[int, str]:
    """Run the process of a document, with its files in a folder: its exit code, and what it says on stderr."""
    with tempfile.TemporaryFile(dir=folder) as said:
        # In a group of its own Ctrl-C reaches the server alone, which ends it and what it has begun.
        process = subprocess.Popen(
            command,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.DEVNULL,
            stderr=said,
            env=os.environ | dict.fromkeys(("TMPDIR", "TEMP", "TMP"), str(folder)),
            start_new_session=True,
        )
        try:
            last = time.monotonic() + _LONGEST
            while process.poll() is None:
                if stop.wait(_PAUSE):
                    raise Interrupted("interrupted")
                if time.monotonic() > last:
                    raise DondoloError(f"{kind}: takes more than {_LONGEST:g} s")
        finally:
            if process.poll() is None:
                if sys.platform == "win32":
                    process.kill()
                else:
                    os.killpg(process.pid, signal.SIGKILL)
                process.wait()
        said.seek(0)
        return process.returncode, said.read().decode(errors="replace")


def _refused(said: str) -> InputError:
    """The error that another process has written to stderr, by `_main` if it could be foreseen."""
    last = said.strip().splitlines()[-1:] or ["no document was written"]
    try:
        errors = [Problem(*one) for one in json.loads(last[0])]
    except (ValueError, TypeError):
        errors = [Problem(last[0])]
    return InputError("\n".join(one.message for one in errors), errors=errors)


def _main(case: str, made: str, lang: str) -> int:
    """Write the document of a case; what is wrong goes to stderr, as JSON."""
    import matplotlib

    import dondolo as dd

    matplotlib.use("agg")
    try:
        results = dd.run_case(case, progress=False)
        if Path(made).name.startswith("relazione"):
            dd.calculation_report([results], made, lang=lang)
        else:
            dd.report(results, made, lang=lang)
    except DondoloError as error:
        problems = error.errors if isinstance(error, InputError) else (Problem(str(error)),)
        print(json.dumps(problems), file=sys.stderr)
        return 1
    return 0


if __name__ == "__main__":
    sys.exit(_main(*sys.argv[1:]))
