"""The report of a run: one page with figures, tables, inputs, checks and versions, in one self-contained file."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from datetime import datetime
from importlib import resources
from typing import TYPE_CHECKING, Any

from dondolo._base.arguments import argument_error, instance_of
from dondolo._base.files import as_file
from dondolo._base.wording import decimal, property_name, say
from dondolo._fortran.library import as_text, constants
from dondolo._fortran.origins import check_replaced, derived_mark
from dondolo._fortran.records import blank_unit
from dondolo._storage import tables
from dondolo.analysis.response import Response
from dondolo.analysis.stripes import Stripes
from dondolo.checks.ntc import CodeCheck
from dondolo.errors import silent
from dondolo.exchange.citing import cite
from dondolo.exchange.results import Results
from dondolo.figures import style
from dondolo.figures.style import mechanism_name
from dondolo.hazard.hazard import HazardCurve
from dondolo.populations.typology import Typology
from dondolo.populations.uncertain_wall import UncertainWall
from dondolo.reporting import designs, facade, inputs, typology, uncertain, wall
from dondolo.reporting.code_check import code_check, code_checks, verdict
from dondolo.reporting.content import BETA, THETA, Symbol, date_in_words, measure_name
from dondolo.reporting.language import Language
from dondolo.reporting.numerals import NONE, whole
from dondolo.reporting.pdf import check_printer, write_pdf
from dondolo.reporting.risk import risk_facts
from dondolo.reporting.run import Run, run_of
from dondolo.reporting.tested import sentences
from dondolo.reporting.ties import ties
from dondolo.reporting.words import warning

if TYPE_CHECKING:
    from jinja2 import Environment


@dataclass(frozen=True)
class Chapter:
    """A chapter: its id to link to, its title, its template, and what this sets."""

    id: str
    title: str
    template: str
    facts: Mapping[str, Any] | Sequence[Any]


def report(
    results: Results | Typology | UncertainWall | Stripes | Response,
    path: str | os.PathLike[str],
    *,
    hazard: HazardCurve | None = None,
    check: CodeCheck | None = None,
    title: str | None = None,
    lang: str | None = None,
) -> None:
    """Write a report of a run: one file that appears whole or not at all, HTML that opens offline, or PDF on A4.

    Parameters
    ----------
    results : Results, Typology, UncertainWall, Stripes or Response
        What `read_results`, `run_case`, `typology`, `propagate_uncertainty`, `multiple_stripe` or `simulate`
        gave. The results of a case know most of a run.
    path : path
        The file, ``*.html``, ``*.htm`` or ``*.pdf``; its folder must exist. PDF is printed by Chromium or WeasyPrint.
        An earlier report is replaced, any other file is not.
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
        The file cannot be written; with a hazard curve, there is no fragility curve; for PDF, neither Chromium nor
        WeasyPrint is installed.

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
    target = as_file("path", path, ".html", ".htm", ".pdf")
    if target.suffix.lower() == ".pdf":
        check_printer()
    check_replaced(target, "report")
    language = Language(lang)
    with language.in_force():
        text, mark = _page(results, hazard, check, title, language)
    if target.suffix.lower() == ".pdf":
        write_pdf(path, text, mark)
    else:
        tables.write_lines(path, [text.rstrip("\n")])


def _page(
    results: Any, hazard: HazardCurve | None, check: CodeCheck | None, title: str | None, language: Language
) -> tuple[str, str]:
    """The text of the page and the mark of its run."""
    import matplotlib.pyplot as plt

    run = run_of(results)
    if title is not None:
        run.title = as_text("title", title).decode()
    if check is not None:
        run.check = instance_of("check", check, CodeCheck)
        if not isinstance(run.results, Stripes) or run.results.wall != check.wall:
            raise argument_error("not_together", "check", ": must be of the one wall of the report")
    if hazard is not None:
        instance_of("hazard", hazard, HazardCurve)
    if hazard is not None and isinstance(run.results, Response):
        raise argument_error("not_together", "hazard", ": must be left out for a single motion, which has no fragility")
    if hazard is not None and hazard.rigid_ground:
        _check_ground(run)
    # Choose the backend first: that may turn interactive mode on, and ioff restores the mode it finds.
    plt.draw_if_interactive()  # type: ignore[no-untyped-call]
    with plt.ioff(), silent():
        chapters = _chapters(run, hazard, language)
    version, template = constants().version, environment(language).get_template("page.html.j2")
    mark = derived_mark("report", "" if run.file is None else run.file.run)
    text = template.render(
        lang=language.code,
        title=run.title,
        generator=mark,
        lead=_lead(run),
        chapters=chapters,
        version=version,
        made=date_in_words(datetime.now().astimezone()),
    )
    return text, mark


def _check_ground(run: Run) -> None:
    """Refuse a hazard curve of rigid ground where the check of the wall has factors of soil or topography."""
    site = next((one.site for one in (run.check, *run.checks) if one is not None), None)
    if site is not None and (site.soil, site.topography) != ("A", "T1"):
        raise argument_error(
            "not_together",
            "hazard",
            f": its levels are ag, of rigid, level ground, and the check has soil {site.soil}, topography"
            f" {site.topography}: multiply each ag by S, the factor of soil and topography at that ag, and title the"
            " column pga",
        )


def environment(language: Language) -> Environment:
    """The templates, which escape all that they set, with the decimal mark of a language."""
    from jinja2 import Environment, FunctionLoader, StrictUndefined

    folder = resources.files("dondolo.reporting") / "templates"
    made = Environment(
        loader=FunctionLoader(lambda name: (folder / name).read_text(encoding="utf-8")),
        autoescape=True,
        undefined=StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
    )
    letters = {f"beta_{index}": Symbol("β", index) for index in ("walls", "records", "total")}
    made.filters["decimal"] = language.decimal
    made.globals |= {"say": _said, "theta": THETA, "beta": BETA, "none_text": NONE.text, **letters}
    return made


def _said(sentence: str, **values: Any) -> Any:
    """A sentence of a template in the language in force, escaped as its values are."""
    from markupsafe import Markup, escape

    found = Markup(escape(say(sentence)))
    return found.format(**values) if values else found


def _chapters(run: Run, hazard: HazardCurve | None, language: Language) -> list[Chapter]:
    """All chapters of a page."""
    results = run.results
    if run.designs is not None and isinstance(results, Typology):
        summary = designs.summary(run.designs)
        chapters = [
            Chapter("designs", say("Designs"), "designs", designs.designs(run.designs)),
            Chapter("numbers", say("Parameters of each design"), "designs_numbers", designs.numbers(results)),
        ]
    elif run.facade and isinstance(results, Typology):
        summary = facade.summary(results)
        chapters = [
            Chapter("curves", say("Fragility curves"), "facade_curves", facade.curves(results)),
            Chapter("numbers", say("Parameters and levels"), "facade_numbers", facade.numbers(results)),
            Chapter("uncertainty", say("Uncertainty of the curve"), "wall_uncertainty", facade.uncertainty(results)),
        ]
    elif isinstance(results, Typology):
        summary = typology.summary(results)
        words = typology.words_of(run.uncertain is not None)
        chapters = [
            Chapter("curves", say("Fragility curves"), "typology_curves", typology.curves(results) | {"words": words}),
            Chapter("numbers", say("Parameters and fractiles"), "typology_numbers", typology.numbers(results, words)),
            Chapter(
                "uncertainty",
                words.uncertainty,
                "typology_uncertainty",
                typology.uncertainty(results) | {"words": words},
            ),
        ]
        if run.uncertain is not None:
            summary = uncertain.summary(run.uncertain)
            model = Chapter(
                "model", say("Uncertainty of the model"), "model_uncertainty", uncertain.model(run.uncertain)
            )
            chapters.insert(0, model)
    elif isinstance(results, Stripes):
        assert run.curve is not None
        summary = wall.summary(results, run.curve)
        figures = wall.curves(results, run.states)
        numbers = wall.numbers(results, run.states)
        chapters = [
            Chapter("curves", say("Histories and fragility curve"), "wall_curves", figures),
            Chapter("numbers", say("Stripes and damage states"), "wall_numbers", numbers),
            Chapter("uncertainty", say("Uncertainty of the curve"), "wall_uncertainty", wall.uncertainty(run.curve)),
        ]
        if results.status is not None:
            told = wall.certificates(results, run.states, run.how)
            chapters.insert(2, Chapter("certificates", say("Certified histories"), "certificates", told))
    else:
        summary = wall.motion_summary(results)
        chapters = [
            Chapter("motion", say("Motion"), "motion", wall.motion(results)),
            Chapter("numbers", say("Numbers"), "facts", results._facts()),
        ]
    if not isinstance(results, Response) and (found_ties := ties(results)) is not None:
        chapters.append(Chapter("ties", say("Ties"), "ties", found_ties))
    if run.check is not None:
        chapters.append(
            Chapter("code_check", say("Check by NTC 2018"), "code_check", code_check(run.check, run.curve, language))
        )
    if run.checks and isinstance(results, Typology):
        facts = code_checks(
            run.checks,
            results.curves,
            results.population.p_occ.tolist(),
            facade=results.unions[run.facade] if run.facade else None,
            with_sheets=run.is_alike and len(run.checks) <= inputs.DRAWN,
        )
        chapters.append(Chapter("code_checks", say("Checks by NTC 2018"), "code_checks", facts))
    found = [warning(language, one) for one in run.warnings]
    if hazard is not None:
        facts, short = risk_facts(run, hazard, language)
        chapters.append(Chapter("risk", say("Annual frequency of collapse"), "risk", facts))
        found += short
    measure = style.im_label(getattr(results, "im", "pga"))
    checked = run.checks if run.check is None else (run.check,)
    found_verdict = verdict(
        checked, run.population.walls, run.warnings, without_soil=hazard is not None and hazard.rigid_ground
    )
    known = run.file is not None and run.file.references
    cited = [run.file] if known else [results, run.curve, run.check, run.uncertain, *run.records]
    return [
        Chapter("summary", say("Summary"), "summary", {"verdict": found_verdict, "warnings": found, **summary}),
        *chapters,
        Chapter("inputs", say("What was run"), "inputs", inputs.inputs(run)),
        Chapter("walls", _title_of_walls(run), "walls", inputs.walls(run)),
        Chapter("records", say("Records"), "records", inputs.records(run)),
        Chapter("checks", say("Checks"), "checks", inputs.checks(run)),
        Chapter(
            "limits",
            say("Limits of the models"),
            "limits",
            {
                "is_population": isinstance(results, Typology) and not run.is_alike,
                "has_mechanisms": isinstance(results, Typology) and len(results.combined) < len(results.walls),
                "is_uncertain": run.uncertain is not None,
                "is_shaken": inputs.has_vertical(run),
                "on_ground": inputs.on_ground(run),
                "tested": _tested(run),
            },
        ),
        Chapter("symbols", say("Symbols and terms"), "symbols", {"measure": measure, "is_alike": run.is_alike}),
        Chapter("software", say("Software"), "facts", inputs.software(run)),
        Chapter("references", say("References"), "references", cite(*(one for one in cited if one is not None))),
    ]


def _tested(run: Run) -> list[str]:
    """What is known of tests of the mechanisms."""
    mechanisms = (wall.mechanism for wall in run.population.walls)
    return [say(words, **values) for words, values in sentences(mechanisms, mechanism_name, decimal)]


def _title_of_walls(run: Run) -> str:
    """Title of the chapter on the walls."""
    if run.designs is not None:
        return say("The designs")
    if run.facade:
        return say("The facade and its mechanisms")
    if run.uncertain is not None:
        return say("The wall and its variants")
    return say("Walls") if len(run.population) > 1 else say("The wall")


def _lead(run: Run) -> str:
    """What this is, in a line."""
    results = run.results
    parts = []
    if run.uncertain is not None:
        everything, many = run.uncertain.typology.walls, len(run.uncertain.sample)
        wall, names = everything[many], ", ".join(map(property_name, run.uncertain.sources))
        words = {"wall": wall.name, "mechanism": inputs.mechanism_of(wall), "names": names}
        parts.append(say("{wall}: {mechanism}, its {names} uncertain", **words))
        parts.append(say("{variants} variants, and {others} beside them", variants=many, others=len(everything) - many))
    elif run.designs is not None and isinstance(results, Typology):
        designs = len(results.walls)
        parts.append(
            say("{designs} designs of one wall", designs=designs) if designs > 1 else say("1 design of one wall")
        )
    elif run.facade and isinstance(results, Typology):
        many = len(results.walls)
        parts.append(
            say("{facade}: {mechanisms} mechanisms, under the same records", facade=run.facade, mechanisms=many)
        )
    elif isinstance(results, Typology):
        rows, walls = len(results.walls), len(results.combined)
        counted = results["all"].n_walls
        parts.append(
            say("{walls} walls with {mechanisms} mechanisms", walls=walls, mechanisms=rows)
            if rows > walls
            else style.counted_walls(walls)
        )
        if counted < walls:
            parts[-1] += say(
                ", {without} of them of weight 0 and in no curve of the population", without=walls - counted
            )
    else:
        parts.append(f"{results.wall.name}: {inputs.mechanism_of(results.wall)}")
    if isinstance(results, Response):
        parts.append(
            say("one motion under {record}, scale {scale:.4g}", record=results.record.name, scale=results.scale)
        )
    else:
        levels = results.levels
        span = {"im": measure_name(results.im), "first": levels[0], "last": levels[-1], "unit": blank_unit(results.im)}
        parts.append(
            say("{levels} levels of {im}, {first:g} to {last:g}{unit}", levels=len(levels), **span)
            if len(levels) > 1
            else say("1 level of {im}, {first:g} to {last:g}{unit}", **span)
        )
        histories, runs = inputs.counted_histories(results)
        parts.append(
            say("{histories} histories, each run {runs} times", histories=whole(histories).text, runs=runs)
            if runs > 1
            else say("{histories} histories", histories=whole(histories).text)
            if histories != 1
            else say("1 history")
        )
    if run.file is not None and run.file.written is not None:
        parts.append(say("run of {date}", date=date_in_words(run.file.written)))
    return "; ".join(parts) + "."
