"""Writing a calculation report: its blocks, and the file that they become."""

from __future__ import annotations

import os
from collections.abc import Sequence

from dondolo._base.arguments import argument_error, instance_of
from dondolo._base.files import as_file
from dondolo._fortran.library import warn_of_notes
from dondolo._fortran.origins import derived_mark
from dondolo.exchange.results import Results


def calculation_report(
    results: Results | Sequence[Results],
    path: str | os.PathLike[str],
    *,
    lang: str | None = None,
    project: str | os.PathLike[str] | None = None,
    template: str | os.PathLike[str] | None = None,
    mechanisms: bool = False,
) -> tuple[str, ...]:
    """Write the calculation report (relazione di calcolo) of checks by NTC 2018: Word, HTML or PDF.

    Parameters
    ----------
    results : Results, or sequence of Results
        Of cases with a group &check, from `read_results` or `run_case`: a wall as it stands, then its designs; or the
        designs of a case, or one facade. A wall and its designs have the same mechanism, height, building, confidence
        factor and ultimate state; thickness, loads, thrusts and ties may differ.
    path : path
        The file, ``*.docx``, ``*.html``, ``*.htm`` or ``*.pdf``; its folder must exist. Word needs python-docx, PDF
        Chromium or WeasyPrint. An earlier report that dondolo wrote is replaced, any other file is not.
    lang : {'en', 'it'}, optional
        Language; that of the environment variable ``DONDOLO_LANG`` if left out, or English.
    project : path, optional
        TOML file with what the engineer states of the project: groups ``[project]`` and ``[texts]``
        (docs/relazione.md).
    template : path, optional
        A Word file or template with the styles, header and footer of the office, for ``*.docx``. Macros, links,
        embedded files, and fields that look into other files do not come along.
    mechanisms : bool
        Whether the results are several mechanisms of one building, with one site, confidence factor and ultimate state:
        none is called a design of another, and the least safety index is that of the report.

    Returns
    -------
    tuple of str
        Names of the fields that are left to write, which the document marks ``[TO BE COMPLETED: ...]``. The reasoned
        judgement of acceptability is one of them unless the project has it: it is never generated.

    Raises
    ------
    InputError
        Results without a check or of a population; an unknown name in the project; another suffix.
    DondoloError
        A program that the format needs is missing; the file cannot be written.

    Warns
    -----
    DondoloWarning
        What of a template did not come along.

    Examples
    --------
    >>> from pathlib import Path
    >>> import dondolo as dd
    >>> dd.RecordSet(dd.synthetic_records(6.5, 10.0, "shallow", n_records=10)).to_catalogue("records.csv")
    >>> _ = Path("parapet.nml").write_text(
    ...     '''
    ...     &wall    mechanism = 'one_sided', height = 1.5, thickness = 0.25 /
    ...     &records catalogue = 'records.csv' /
    ...     &stripes levels = 0.6, 0.8, 1.0 /
    ...     &check   ag = 0.2, f0 = 2.5, tc_star = 0.35, soil = 'B' /
    ...     '''
    ... )
    >>> results = dd.run_case("parapet.nml", progress=False)
    >>> left = dd.calculation_report(results, "relazione.html", lang="it")
    >>> "judgement" in left
    True
    """
    from dondolo.reporting.blocks import fields_of
    from dondolo.reporting.language import Language
    from dondolo.reporting.relazione.chapters import CHAPTERS
    from dondolo.reporting.relazione.document import Document
    from dondolo.reporting.relazione.project import read_project
    from dondolo.reporting.relazione.subjects import subjects_of
    from dondolo.reporting.writers.writing import SUFFIXES, check_target, undisturbed, write

    target = as_file("path", path, *SUFFIXES)
    suffix = target.suffix.lower()
    if template is not None and suffix != ".docx":
        raise argument_error(
            "not_together",
            "template",
            f" = {os.fspath(template)!r}: must be left out for {suffix}, which has no styles of Word",
        )
    check_target(target)
    several = [results] if isinstance(results, Results) else list(results)
    found = [instance_of("results", one, Results) for one in several]
    if not found:
        raise argument_error("not_given", "results", ": must be at least one")
    language = Language(lang)
    document = Document(language, read_project(project), subjects_of(found, mechanisms=mechanisms))
    with undisturbed():
        blocks = [block for chapter in CHAPTERS for block in chapter(document)]
        left_out = write(target, blocks, document.imprint(derived_mark("report", found[0].run.run)), template)
    if left_out:
        warn_of_notes([f"{os.fspath(template or '')}: left out of the document: {', '.join(left_out)}"])
    return tuple(dict.fromkeys(field.key for field in fields_of(blocks)))
