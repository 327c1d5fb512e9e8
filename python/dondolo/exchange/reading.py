"""Result files, read back into results."""

from __future__ import annotations

import os
from pathlib import Path

from dondolo._base.arguments import argument_error
from dondolo._base.files import as_file
from dondolo._fortran.files import RUN_FILE, TABLES, published_run
from dondolo._storage.run_file import RunFile, read_run_file
from dondolo.errors import InputError, MissingFileError, silent
from dondolo.exchange.cases import read_case
from dondolo.exchange.result_file import MixedError, ResultFile
from dondolo.exchange.results import Results, Source, results_of

# How often results are read again that another run replaces meanwhile
_TRIES = 20
# Prefixes that a message shows
_SHOWN = 5


def read_results(prefix: str | os.PathLike[str]) -> Results:
    """Read the result files of the executable, or those that `Typology.write_results` wrote.

    Parameters
    ----------
    prefix : path
        Prefix of the files: `output` of the case, for example ``out/parapet``.

    Returns
    -------
    Results
        The same as those of `run_case`; curves are fitted again, to the same counts. Those of a typology cannot be
        compared: the files do not contain which record makes which wall collapse. What the run warned of is in
        `RunFile.warnings`, and is not repeated.

    Raises
    ------
    InputError
        They are not result files of dondolo, do not belong to one run, or were changed after the run; the file is
        named, and the line if there is one.
    MissingFileError
        There are no such files.

    Examples
    --------
    >>> import dondolo as dd
    >>> walls = dd.Population([dd.OneSidedWall(1.5, 0.25, name="a"), dd.OneSidedWall(1.8, 0.25, name="b")])
    >>> records = dd.synthetic_records(6.5, 10.0, "shallow", n_records=10)
    >>> dd.typology(walls, records, [0.6, 0.8, 1.0], progress=False).write_results("parapets")
    >>> dd.read_results("parapets").typology["all"].fit.status
    'ok'
    """
    name = as_file("prefix", prefix).name
    prefix = os.fspath(prefix)
    tries = 0
    while True:
        try:
            run = read_run_file(prefix + RUN_FILE)
        except MissingFileError:
            for end in (*TABLES, RUN_FILE):
                if name.endswith(end):
                    start = prefix.removesuffix(end)
                    raise argument_error(
                        "wrong_type", "prefix", f" = {prefix!r}: must be the prefix of result files, {start!r}"
                    ) from None
            _refuse_other(prefix)
            raise
        try:
            return _read(prefix, run)
        except (MissingFileError, MixedError):
            # Unless another run has published its results meanwhile
            tries += 1
            if tries == _TRIES or published_run(prefix) == run.run:
                raise


def _refuse_other(prefix: str) -> None:
    """Refuse a case, another file, a folder, a prefix with an underscore or a suffix: name the prefix that is meant."""
    path, what = Path(prefix), f"prefix = {prefix!r}"
    if prefix.endswith("_") and Path(prefix[:-1] + RUN_FILE).is_file():
        raise InputError(f"{what}: must be the prefix of result files, {prefix[:-1]!r}")
    if path.is_dir():
        found = sorted(str(one).removesuffix(RUN_FILE) for one in path.glob(f"*{RUN_FILE}"))
        more = f" and {len(found) - _SHOWN} more" if len(found) > _SHOWN else ""
        names = ", ".join(map(repr, found[:_SHOWN])) + more
        if found:
            raise InputError(f"{what}: is a folder, must be the prefix of result files, such as {names}")
    if not path.is_file():
        start = os.path.splitext(prefix)[0]
        if path.suffix.lower() == ".nml" or (path.suffix and Path(start + RUN_FILE).is_file()):
            raise argument_error(
                "wrong_type", "prefix", f" = {prefix!r}: must be the prefix of result files, such as {start!r}"
            )
        return
    if path.suffix.lower() != ".nml":
        raise InputError(f"{what}: is a file, must be the prefix of result files")
    with silent():
        output = read_case(prefix).output
    run = "" if Path(output + RUN_FILE).is_file() else f"; there are none yet, dondolo {prefix} writes them"
    raise InputError(f"{what}: is a case, must be the prefix of its result files, {output!r}{run}")


def _read(prefix: str, run: RunFile) -> Results:
    """The results of a run."""
    names = frozenset(file.name for file in run.files)
    return results_of(run, Source(lambda name: ResultFile(prefix + name, run), names))
