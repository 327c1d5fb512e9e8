"""Running a case file in Python, without writing files."""

from __future__ import annotations

import os
import threading
from collections.abc import Iterator
from contextlib import contextmanager
from typing import Any

import numpy as np
from numpy.typing import NDArray

from dondolo._base.arguments import as_flag, as_path
from dondolo._base.interrupts import Interrupts, as_event, deferred
from dondolo._fortran import _core
from dondolo._fortran.library import Parcel, Stoppable, receive, warn
from dondolo._fortran.tables import unpack_table
from dondolo._storage.columns import ColumnsInMemory
from dondolo._storage.run_file import parse_run_file
from dondolo.analysis.request import progress_bar
from dondolo.analysis.work import Work
from dondolo.errors import DondoloError, Interrupted, silent
from dondolo.exchange.cases import Case, case_of
from dondolo.exchange.results import Results, Source, results_of
from dondolo.populations.store import Contents, contents_of
from dondolo.populations.study import typology_of

# Seconds between two looks at how far a run is
_PAUSE = 0.05


def run_case(path: str | os.PathLike[str], *, progress: bool = True, stop: threading.Event | None = None) -> Results:
    """Run a case file as the executable does, with its results in memory and no files written.

    Parameters
    ----------
    path : path
        A namelist file; paths in it are relative to it.
    progress : bool
        Show a progress bar in a terminal or notebook.
    stop : threading.Event, optional
        Once another thread has set it, the run is broken off within about a second.

    Returns
    -------
    Results
        The same as `read_results` gives for the files of the executable, to the bit, and in addition which record makes
        which wall of a population collapse, and the records.

    Raises
    ------
    InputError
        The case is wrong; the message is that of the executable.
    DondoloError
        The run failed.
    Interrupted
        Ctrl-C or `stop`; its `partial` is the typology of the walls that are complete, None for one wall.

    Warns
    -----
    DondoloWarning
        Warnings of the executable.

    Examples
    --------
    >>> from pathlib import Path
    >>> import dondolo as dd
    >>> records = dd.RecordSet(dd.synthetic_records(6.5, 10.0, "shallow", n_records=10))
    >>> records.to_catalogue("records.csv")
    >>> _ = Path("parapet.nml").write_text(
    ...     '''
    ...     &wall    mechanism = 'one_sided', height = 1.5, thickness = 0.25 /
    ...     &records catalogue = 'records.csv' /
    ...     &stripes levels = 0.6, 0.8, 1.0 /
    ...     '''
    ... )
    >>> dd.run_case("parapet.nml", progress=False).fragility.status
    'ok'
    """
    name = as_path(path)
    with deferred(as_event(stop)) as interrupts:
        with Stoppable(), _watched(as_flag("progress", progress), interrupts) as shared:
            *sent, answer = _core.cases.run_case(name, shared.ctypes.data)
        case, rows = map(receive, sent)
        known = case_of(case) if case.address else None
        contents = None if known is None or not rows.address else _contents(known, rows)
        try:
            tables = receive(answer)
        except DondoloError:
            if not interrupts.requested:
                raise
        if interrupts.requested:
            interrupts.answered = True
            raise Interrupted(*_interrupted(known, contents))
        assert known is not None
        results = _results(os.fspath(path), known, contents, tables)
    warn(results.run.warnings)
    return results


def _results(path: str, case: Case, contents: Contents | None, parcel: Parcel) -> Results:
    """Results out of the tables that Fortran has sent."""
    tables, text = _tables(parcel)
    run = parse_run_file(text, path)
    flags = None if contents is None else contents.flags
    return results_of(run, Source(tables.__getitem__, frozenset(tables)), case, flags)


def _tables(parcel: Parcel) -> tuple[dict[str, ColumnsInMemory], str]:
    """The tables of a parcel by what their names end with, and the text of the file of the run."""
    tables = {name: ColumnsInMemory(name, unpack_table(parcel, name)) for name in parcel["tables"]}
    return tables, "\n".join(parcel["run"])


def _contents(case: Case, parcel: Parcel) -> Contents:
    """What the store of a population has, with the records that run at each level and counts of the work."""
    work = Work._of_counts(parcel["work"].astype(np.int64))
    return contents_of(parcel, case.records, parcel["runs"].T.astype(np.float64), work)


def _interrupted(case: Case | None, contents: Contents | None) -> tuple[str, Any]:
    """What is said of a run that was stopped, and what is complete."""
    if case is None or contents is None:
        return "interrupted", None
    histories = np.zeros(len(case.population), dtype=np.int32)
    histories[contents.complete] = contents.flags.histories
    try:
        with silent():
            found, complete, number = typology_of(
                case.population,
                case.im,
                case.levels,
                case.edp_thresholds,
                contents,
                np.asarray(contents.flags.runs.mean(axis=0)),
                histories,
            )
    except Interrupted as nothing:
        return str(nothing), None
    return f"interrupted: {complete} of {number} walls are complete", found


@contextmanager
def _watched(is_shown: bool, interrupts: Interrupts) -> Iterator[NDArray[np.int32]]:
    """Watch a run from another thread: gives what it shares with it.

    The run writes how many histories are done, and how many there are, and ends early once the third number is not 0.
    """
    shared, over = np.zeros(3, dtype=np.int32), threading.Event()
    shared[2] = interrupts.requested

    def watch() -> None:
        bar, shown = None, 0
        while not over.wait(_PAUSE):
            shared[2] = interrupts.requested
            done, total = shared[:2].tolist()
            if total == 0 or not is_shown:
                continue
            # Certificates are a work of their own.
            if bar is None or bar.total != total:
                if bar is not None:
                    bar.close()
                bar, shown = progress_bar(total, True, "case", "history", done), done
            bar.update(done - shown)
            shown = done
        if bar is not None:
            bar.close()

    watcher = threading.Thread(target=watch, daemon=True)
    watcher.start()
    try:
        yield shared
    finally:
        over.set()
        watcher.join()
