"""Chapters of a report on what was run: the case, what to look at before numbers are believed, and the software."""

from __future__ import annotations

import platform
from collections.abc import Sequence

import numpy as np

from dondolo._base.wording import decimal, in_english, say
from dondolo._fortran.library import build_variant, constants
from dondolo._storage.run_file import RunFile
from dondolo.analysis.response import Response
from dondolo.analysis.stripes import Stripes
from dondolo.exchange.case_text import case_text
from dondolo.populations.typology import Typology
from dondolo.reporting.blocks import Block, Details, Facts, Listing
from dondolo.reporting.content import Pairs, Piece, Table, date_in_words, measure_name, pieces, state_name
from dondolo.reporting.numerals import number, percent, whole
from dondolo.reporting.parts import captioned, paragraph
from dondolo.reporting.run import Run
from dondolo.reporting.statuses import status_table


def inputs(run: Run) -> list[Block]:
    """The case with all its variables, and the files that it is made of."""
    case = ""
    if run.file is not None and "records" in run.file.settings:
        case = case_text(run.file.settings)
    if case:
        blocks: list[Block] = [paragraph(say("The case with all its variables, given or by default.")), Listing(case)]
    else:
        words = say("The results were computed in Python, without a case file, with these settings.")
        settings = (*run.settings, *_levels(run))
        blocks = [paragraph(words), *([Facts(settings)] if settings else [])]
    if run.file is not None and run.file.inputs:
        table = _files_table(run.file)
        title = say("Files of the case and their checksums ({total})", total=table.total)
        caption = say("Input files of the results, with their CRC-32 as in zlib and gzip.")
        blocks.append(Details(title, (captioned(table, caption),)))
    return blocks


def _files_table(file: RunFile) -> Table:
    """Input files with their checksums."""
    missing, role = say("removed during the run"), say("role")
    columns: dict[Piece, Sequence[Piece]] = {
        say("file"): [str(one["path"]) for one in file.inputs],
        role: [say(str(one["role"])) for one in file.inputs],
        say("bytes"): [missing if one["bytes"] is None else whole(one["bytes"]) for one in file.inputs],
        "CRC-32": [missing if one["crc32"] is None else str(one["crc32"]) for one in file.inputs],
    }
    return Table.of(columns, (role,))


def _levels(run: Run) -> Pairs:
    """The levels of stripes and populations."""
    if isinstance(run.results, Response):
        return []
    return [
        (
            say("levels of {im}", im=measure_name(run.results.im)),
            (", " if in_english() else "; ").join(decimal(f"{level:g}") for level in run.results.levels),
        )
    ]


def checks(run: Run) -> list[Block]:
    """What to look at before the numbers are believed."""
    results = run.results
    if isinstance(results, Response):
        rows: Piece = say("none") if results.time is None else whole(len(results.time))
        pairs: Pairs = [(say("limit of the EDP"), number(results.edp_limit)), (say("rows of the time history"), rows)]
        if results.edp_error is not None:
            pairs.insert(0, (say("largest estimated error of an EDP"), number(results.edp_error, 3)))
        return [Facts(tuple(pairs))]
    if isinstance(results, Typology):
        limit = float(results.edp_thresholds[-1])
        states = {state_name(float(edp), limit): results.at(float(edp)).curves for edp in results.edp_thresholds}
        error = None
    else:
        states = {state_name(float(one.edp_threshold or 0.0), results.edp_limit): (one,) for one in run.states}
        error = results.edp_error
    scales: Piece = say("none")
    if run.scales is not None:
        share = percent(run.scales.many / run.scales.histories)
        scales = pieces(
            "{share} of the histories, the largest {largest}", share=share, largest=number(run.scales.largest)
        )
    pairs = [(say("scale factors above 10"), scales)]
    if error is not None:
        pairs.append((say("largest estimated error of an EDP"), number(float(np.nanmax(error)), 3)))
    work = results.work
    histories, runs = counted_histories(results)
    still = (whole(work.still // runs), " (", percent(work.still / max(work.histories, 1)), ")")
    pairs += [(say("histories"), whole(histories)), (say("of these never move"), still)]
    if runs > 1:
        pairs.append((say("runs of each history, to estimate its error; what follows counts all"), whole(runs)))
    pairs += [
        (say("sample intervals"), whole(work.intervals)),
        (say("of these with rocking"), (whole(work.rocked), " (", percent(work.rocked / max(work.intervals, 1)), ")")),
        (say("steps of the integration"), whole(work.steps)),
        (say("impacts located"), whole(work.impacts)),
        *work._notes(),
    ]
    counts = say("Counts of the work are the same for any number of threads: they identify the run.")
    return [
        captioned(status_table(states), say("Fits of the single walls and mechanisms by their status.")),
        Facts(tuple(pairs)),
        paragraph(counts),
    ]


def counted_histories(results: Typology | Stripes) -> tuple[int, int]:
    """How many histories there are, and how many times each was run: several to estimate its error."""
    runs = results.work.histories
    histories = int(results.ran.sum()) if isinstance(results, Stripes) else runs
    return histories, runs // max(histories, 1)


def software(run: Run) -> list[Block]:
    """Versions of what ran, and of what writes the report."""
    from importlib.metadata import version

    pairs: Pairs = []
    if run.file is None:
        pairs.append((say("build variant of this machine"), build_variant()))
    else:
        pairs.append((say("run by"), f"dondolo {run.file.version}"))
        known = {
            say("compiler"): run.file.compiler and f"{run.file.compiler}, real{run.file.real_bits}",
            say("engine and build variant"): run.file.engine,
        }
        pairs += [(name, text) for name, text in known.items() if text]
        if run.file.written is not None:
            pairs.append((say("result files written"), date_in_words(run.file.written)))
    pairs += [(say("report by"), f"dondolo {constants().version}"), ("Python", platform.python_version())]
    packages = ((name, version(name.lower())) for name in ("NumPy", "SciPy", "Matplotlib"))
    return [Facts((*pairs, *packages))]
