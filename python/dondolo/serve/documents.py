"""Reports of the case on the page, each made in a process of its own, so that curves go on meanwhile."""

from __future__ import annotations

import json
import subprocess
import sys
import tempfile
from importlib.util import find_spec
from pathlib import Path

from dondolo._base.arguments import argument_error
from dondolo._fortran.files import whole_file
from dondolo.errors import DondoloError, InputError, Problem

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


def available_documents() -> list[str]:
    """The kinds of documents that can be made with the packages that are installed."""
    return [kind for kind in DOCUMENTS if kind not in _NEEDS or find_spec(_NEEDS[kind]) is not None]


def make_document(text: str, kind: str, lang: str) -> bytes:
    """Run a case and write a document of its results.

    Parameters
    ----------
    text : str
        The case.
    kind : str
        One of `DOCUMENTS`.
    lang : {'en', 'it'}
        Its language.

    Returns
    -------
    bytes

    Raises
    ------
    InputError
        The case cannot be run, or its document not be written, with the sentence of the library.
    """
    if kind not in DOCUMENTS or lang not in ("en", "it"):
        raise argument_error("not_a_word", "kind", f" = {kind!r}: must be one of {', '.join(DOCUMENTS)}")
    with tempfile.TemporaryDirectory(prefix="dondolo-") as folder:
        case, made = (
            Path(folder) / "case.nml",
            Path(folder) / f"{kind}.{'docx' if kind == 'relazione_word' else 'html'}",
        )
        with whole_file(case) as part:
            part.write_text(text, encoding="utf-8", newline="\n")
        command = [sys.executable, "-W", "ignore", "-m", "dondolo.serve.documents", str(case), str(made), lang]
        try:
            done = subprocess.run(command, capture_output=True, text=True, timeout=_LONGEST, check=False)
        except subprocess.TimeoutExpired:
            raise DondoloError(f"{kind}: takes more than {_LONGEST:g} s") from None
        if done.returncode != 0 or not made.exists():
            raise _refused(done.stderr.replace(f"{folder}/", ""))
        return made.read_bytes()


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
