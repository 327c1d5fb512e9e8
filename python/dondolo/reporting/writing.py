"""Writing the report of a run: its chapters are loaded when there is one to write."""

from __future__ import annotations

import os

from dondolo._base.files import as_file
from dondolo.analysis.response import Response
from dondolo.analysis.stripes import Stripes
from dondolo.checks.ntc import CodeCheck
from dondolo.exchange.results import Results
from dondolo.hazard.hazard import HazardCurve
from dondolo.populations.typology import Typology
from dondolo.populations.uncertain_wall import UncertainWall


def report(
    results: Results | Typology | UncertainWall | Stripes | Response,
    path: str | os.PathLike[str],
    *,
    hazard: HazardCurve | None = None,
    check: CodeCheck | None = None,
    title: str | None = None,
    lang: str | None = None,
) -> None:
    """Write a report of a run: one file that appears whole or not at all, HTML that opens offline, Word, or PDF on A4.

    Parameters
    ----------
    results : Results, Typology, UncertainWall, Stripes or Response
        What `read_results`, `run_case`, `typology`, `propagate_uncertainty`, `multiple_stripe` or `simulate`
        gave. The results of a case know most of a run.
    path : path
        The file, ``*.docx``, ``*.html``, ``*.htm`` or ``*.pdf``; its folder must exist. Word needs python-docx, PDF
        Chromium or WeasyPrint. An earlier report is replaced, any other file is not.
    hazard : HazardCurve, optional
        Of the site: adds the annual frequency of collapse with its bounds and deaggregation.
    check : CodeCheck, optional
        Adds the calculation sheet of the check of the wall, and its lines on the curve; files bring their own.
    title : str, optional
        Title of the page; that of the case if left out.
    lang : {'en', 'it'}, optional
        Language; that of the environment variable ``DONDOLO_LANG`` if left out, or English. Names, identifiers of the
        case and messages of the library are not translated.

    Raises
    ------
    InputError
        Results that a report cannot show; a hazard curve of another intensity measure; another suffix; an existing file
        that is not a report.
    DondoloError
        The file cannot be written; a program that the format needs is missing; with a hazard curve, there is no
        fragility curve.

    Notes
    -----
    Warnings of the run and of the fits are in the report, and are not issued again.

    Examples
    --------
    >>> import dondolo as dd
    >>> (record,) = dd.synthetic_records(magnitude=6.5, distance=10.0, site="shallow")
    >>> response = dd.simulate(dd.OneSidedWall(height=1.5, thickness=0.25), record, scale=2.0)
    >>> dd.report(response, "report.html", title="Parapet")
    """
    from dondolo.reporting.language import Language
    from dondolo.reporting.page import blocks_of, gather, imprint_of
    from dondolo.reporting.writers.writing import SUFFIXES, check_target, undisturbed, write

    target = as_file("path", path, *SUFFIXES)
    check_target(target)
    language = Language(lang)
    with language.in_force(), undisturbed():
        run = gather(results, hazard, check, title)
        write(target, blocks_of(run, hazard, language), imprint_of(run, language))
