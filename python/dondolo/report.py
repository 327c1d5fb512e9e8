"""One page that tells a run: figures, tables, inputs, checks and versions, in a file that needs nothing else."""

from __future__ import annotations

import os
from collections.abc import Sequence
from datetime import datetime

from dondolo import _report_inputs as asked
from dondolo._base.arguments import as_text
from dondolo._base.files import check_replaced
from dondolo._fortran import _binding
from dondolo._page import Markup, joined, page, paragraph, tag, whole
from dondolo._report_risk import risk_chapter
from dondolo._report_run import Run, run_of
from dondolo._report_typology import typology_cards, typology_chapters, typology_sentences
from dondolo._report_wall import response_cards, response_chapters, stripes_cards, stripes_chapters
from dondolo._report_words import date_in_words, symbols
from dondolo._storage import tables
from dondolo.analysis.response import Response
from dondolo.analysis.stripes import Stripes
from dondolo.errors import InputError, silent
from dondolo.exchange.cases import Results
from dondolo.exchange.results import StoredResults
from dondolo.figures.style import mechanism_name
from dondolo.populations.typology import Typology
from dondolo.risk.hazard import HazardCurve

_GENERATOR = "dondolo report"


def report(
    results: StoredResults | Results | Typology | Stripes | Response,
    path: str | os.PathLike[str],
    hazard: HazardCurve | None = None,
    title: str | None = None,
) -> None:
    """Write a report of a run: one HTML file that opens offline, appears whole or not at all, and prints on A4.

    Parameters
    ----------
    results : StoredResults, Results, Typology, Stripes or Response
        What `read_results`, `run_case`, `typology`, `multiple_stripe` or `simulate` gave. Files know most of a run.
    path : path
        The file; its folder must exist. An earlier report is replaced, any other file is not.
    hazard : HazardCurve, optional
        Of the site: adds the annual frequency of collapse with its bounds and deaggregation.
    title : str, optional
        Title of the page; that of the case if left out.

    Raises
    ------
    InputError
        Nothing that a report can be made of; a hazard curve of another intensity measure; a file that is no report.
    DondoloError
        The file cannot be written; with a hazard curve, there is no fragility curve.

    Notes
    -----
    What the run and the fits warn of stands in the report, and is not given as a warning again.

    Examples
    --------
    >>> import dondolo as dd
    >>> (record,) = dd.synthetic_records(magnitude=6.5, distance=10.0, site="shallow")
    >>> response = dd.simulate(dd.OneSidedWall(height=1.5, thickness=0.25), record, scale=2.0)
    >>> dd.report(response, "report.html", title="Parapet")
    """
    import matplotlib.pyplot as plt

    check_replaced(path, _GENERATOR, "report")
    run = run_of(results)
    if title is not None:
        run.title = as_text("title", title).decode()
    if hazard is not None and not isinstance(hazard, HazardCurve):
        raise InputError(f"hazard: {type(hazard).__name__} is no hazard curve")
    if hazard is not None and isinstance(run.results, Response):
        raise InputError("hazard: must be left out for a single motion, which has no fragility")
    # Choose the backend first: that may turn interactive mode on, and ioff restores the mode it finds.
    plt.draw_if_interactive()
    with plt.ioff(), silent():
        text = _text(run, hazard)
    tables.write_lines(path, [text.rstrip("\n")])


def _text(run: Run, hazard: HazardCurve | None) -> str:
    """The whole page."""
    results = run.results
    chapters: list[tuple[str, str, Markup]] = []
    if isinstance(results, Typology):
        summary = joined(typology_cards(results), typology_sentences(results))
        chapters += typology_chapters(results)
    elif isinstance(results, Stripes):
        assert run.curve is not None
        summary = stripes_cards(results, run.curve)
        chapters += stripes_chapters(results, run.curve, run.thresholds)
    else:
        summary = response_cards(results)
        chapters += response_chapters(results)
    found = list(run.warnings)
    if hazard is not None:
        chapter, short = risk_chapter(results, run.curve, hazard)
        chapters.append(chapter)
        found += short
    im = getattr(results, "im", "pga")
    chapters += [
        ("inputs", "What was run", asked.inputs_chapter(run)),
        ("walls", "Walls" if len(run.population) > 1 else "The wall", asked.walls_chapter(run)),
        ("records", "Records", asked.records_chapter(run)),
        ("checks", "Checks", asked.checks_chapter(run)),
        ("limits", "Limits of the models", asked.limits_chapter(results)),
        ("symbols", "Symbols and terms", symbols(im)),
        ("software", "Software", asked.software_chapter(run)),
    ]
    head = joined(
        paragraph("Rocking masonry walls in earthquakes", class_="kicker"),
        tag("h1", run.title),
        paragraph(_lead(run), class_="lead"),
    )
    chapters.insert(0, ("summary", "Summary", joined(_warnings(found), summary)))
    made = f"Report made by dondolo {_binding.constants().version} on {date_in_words(datetime.now().astimezone())}."
    foot = paragraph(
        made,
        " The page holds all it needs: it can be kept, sent and printed. Results are those of models with the limits"
        " said above; to judge whether they apply is the reader's task.",
    )
    return page(run.title, f"{_GENERATOR} {_binding.constants().version}", head, chapters, foot)


def _lead(run: Run) -> str:
    """What this is, in a line."""
    results = run.results
    parts = []
    if isinstance(results, Typology):
        rows, walls = len(results.walls), len(results.combined)
        counted = results["all"].walls
        parts.append(f"{walls} walls" + (f" with {rows} mechanisms" if rows > walls else ""))
        if counted < walls:
            parts[-1] += f", {walls - counted} of them of weight 0 and in no curve of the population"
    else:
        parts.append(f"{results.wall.name}: {mechanism_name(results.wall.mechanism)}")
    if isinstance(results, Response):
        parts.append(f"one motion under {results.record.name}, scale {results.scale:.4g}")
    else:
        unit = _binding.unit_of(results.im)
        number_of = len(results.levels)
        between = f"{results.levels[0]:g} to {results.levels[-1]:g} {unit}".strip()
        parts.append(f"{number_of} level{'s' if number_of > 1 else ''} of {results.im}, {between}")
        parts.append(f"{whole(results.work.histories)} histories")
    if run.written is not None:
        parts.append(f"run of {date_in_words(run.written)}")
    return "; ".join(parts) + "."


def _warnings(found: Sequence[str]) -> Markup:
    """What the run warned of, prominently."""
    if not found:
        return tag("aside", tag("h2", "No warnings"), class_="warnings fine")
    word = "Warning" if len(found) == 1 else f"{len(found)} warnings"
    return tag("aside", tag("h2", word), tag("ul", *(tag("li", line) for line in found)), class_="warnings")
