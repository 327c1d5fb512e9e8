"""Sets of result files, as the executable writes them."""

from __future__ import annotations

import dataclasses
import os
from collections.abc import Mapping

from dondolo._base.arguments import as_flag
from dondolo._base.files import as_file
from dondolo._fortran.files import RUN_FILE, TABLES, Column, result_set
from dondolo._fortran.library import warn
from dondolo._fortran.origins import check_replaced, outdated, replaced
from dondolo._fortran.records import unit_of
from dondolo._storage.run_file import RunFile
from dondolo.errors import DondoloWarning


def write_set(
    prefix: str | os.PathLike[str],
    tables: Mapping[str, Mapping[str, Column]],
    run: RunFile,
    *,
    spreadsheet_safe: bool = False,
) -> None:
    """Publish tables, by what their names end with, and the file of their run, in place of an earlier set.

    Raises
    ------
    InputError
        Another run is writing them, or a file of the same name is not a result of dondolo.
    DondoloError
        A file cannot be written.

    Warns
    -----
    DondoloWarning
        Earlier results are replaced; reports, workbooks or figures are out of date.
    """
    start, is_safe = as_file("prefix", prefix), as_flag("spreadsheet_safe", spreadsheet_safe)
    check_replaced(f"{start}{RUN_FILE}", "run")
    for name in tables:
        check_replaced(f"{start}{name}", "table")
    notes = replaced(start)
    comments = _comments(run)
    with result_set(start) as files:
        for name in sorted(tables, key=TABLES.index):
            files.write(name, tables[name], comments, spreadsheet_safe=is_safe)
        files.publish(dataclasses.replace(run, run=files.run, files=tuple(files.written)).to_json())
    for code, sentences in (("results_replaced", notes), ("out_of_date", outdated(start))):
        warn(DondoloWarning(sentence, code, {"results": str(start)}) for sentence in sentences)


def _comments(run: RunFile) -> list[str]:
    """Lines above the columns: what was computed, and what to beware of."""
    lines = [f"{what}: {_counts(counts)}" for what, counts in (("shape", run.shape), ("work", run.work)) if counts]
    im = run.setting("stripes", "im", "")
    if im:
        lines.append(f"unit of im_level and theta: {unit_of(im) or '1'}")
    return [*lines, *(f"note: {note}" for note in run.notes), *(f"warning: {sentence}" for sentence in run.warnings)]


def _counts(counts: Mapping[str, int]) -> str:
    """Counts by their names."""
    return ", ".join(f"{name} = {count}" for name, count in counts.items())
