"""The chapters of a report on a run: figures, tables, inputs, checks and versions, as blocks."""

from __future__ import annotations

from datetime import datetime
from typing import Any

from dondolo._base.arguments import argument_error, instance_of
from dondolo._base.wording import say
from dondolo._fortran.library import as_text, constants
from dondolo._fortran.origins import derived_mark
from dondolo.analysis.response import Response
from dondolo.analysis.stripes import Stripes
from dondolo.checks.ntc import CodeCheck
from dondolo.hazard.hazard import HazardCurve
from dondolo.populations.typology import Typology
from dondolo.reporting import designs, facade, reading, typology, uncertain, wall
from dondolo.reporting.beginning import judgement, lead
from dondolo.reporting.blocks import Block, Facts, Heading
from dondolo.reporting.code_check import code_check, code_checks
from dondolo.reporting.content import date_in_words
from dondolo.reporting.inputs import checks, inputs, software
from dondolo.reporting.language import Language
from dondolo.reporting.parts import paragraph
from dondolo.reporting.records import records
from dondolo.reporting.risk import risk_chapter
from dondolo.reporting.run import Run, run_of
from dondolo.reporting.ties import ties
from dondolo.reporting.walls import DRAWN, walls
from dondolo.reporting.words import warning
from dondolo.reporting.writers.imprint import Imprint

# Chapters: an anchor, a title, and blocks
_Chapters = list[tuple[str, str, list[Block]]]


def gather(results: Any, hazard: HazardCurve | None, check: CodeCheck | None, title: str | None) -> Run:
    """What is known of the run, and whether the rest is of it."""
    run = run_of(results)
    if title is not None:
        run.title = as_text("title", title).decode()
    if check is not None:
        run.check = instance_of("check", check, CodeCheck)
        if not isinstance(run.results, Stripes) or run.results.wall != check.wall:
            raise argument_error("not_together", "check", ": must be of the one wall of the report")
    if hazard is not None:
        instance_of("hazard", hazard, HazardCurve)
        if isinstance(run.results, Response):
            words = ": must be left out for a single motion, which has no fragility"
            raise argument_error("not_together", "hazard", words)
        if hazard.rigid_ground:
            _check_ground(run)
    return run


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


def imprint_of(run: Run, language: Language) -> Imprint:
    """What the report says of itself."""
    colophon = say(
        "Report made by dondolo {version} on {made}. The page holds all it needs: it can be kept, sent and printed."
        " Results are those of models with the limits said above; to judge whether they apply is the reader's task.",
        version=constants().version,
        made=date_in_words(datetime.now().astimezone()),
    )
    kicker = say("Rocking masonry walls in earthquakes")
    mark = derived_mark("report", "" if run.file is None else run.file.run)
    return Imprint(language, mark, run.title, kicker=kicker, colophon=colophon)


def blocks_of(run: Run, hazard: HazardCurve | None, language: Language) -> list[Block]:
    """The report as blocks."""
    blocks: list[Block] = [Heading(run.title, 0), paragraph(lead(run), look="lead")]
    for anchor, title, chapter in _chapters(run, hazard, language):
        blocks += [Heading(title, 1, anchor), *chapter]
    return blocks


def _chapters(run: Run, hazard: HazardCurve | None, language: Language) -> _Chapters:
    """All chapters."""
    summary, chapters = _of_results(run)
    if not isinstance(run.results, Response) and (found_ties := ties(run.results)):
        chapters.append(("ties", say("Ties"), found_ties))
    chapters += _of_checks(run, language)
    warnings = [warning(language, one) for one in run.warnings]
    if hazard is not None:
        risk, short = risk_chapter(run, hazard, language)
        chapters.append(("risk", say("Annual frequency of collapse"), risk))
        warnings += short
    without_soil = hazard is not None and hazard.rigid_ground
    return [
        ("summary", say("Summary"), [*judgement(run, warnings, without_soil=without_soil), *summary]),
        *chapters,
        ("inputs", say("What was run"), inputs(run)),
        ("walls", _title_of_walls(run), walls(run)),
        ("records", say("Records"), records(run)),
        ("checks", say("Checks"), checks(run)),
        ("limits", say("Limits of the models"), reading.limits(run)),
        ("symbols", say("Symbols and terms"), reading.symbols(run)),
        ("software", say("Software"), software(run)),
        ("references", say("References"), reading.references(run)),
    ]


def _of_results(run: Run) -> tuple[list[Block], _Chapters]:
    """The main numbers, and the chapters on curves or on a motion."""
    results = run.results
    if isinstance(results, Response):
        return wall.motion_summary(results), [
            ("motion", say("Motion"), wall.motion(results)),
            ("numbers", say("Numbers"), [Facts(tuple(results._facts()))]),
        ]
    if isinstance(results, Stripes):
        assert run.curve is not None
        chapters = [
            ("curves", say("Histories and fragility curve"), wall.curves(results, run.states)),
            ("numbers", say("Stripes and damage states"), wall.numbers(results, run.states)),
            ("uncertainty", say("Uncertainty of the curve"), wall.uncertainty(run.curve)),
        ]
        if results.status is not None:
            told = wall.certificates(results, run.states, run.how)
            chapters.insert(2, ("certificates", say("Certified histories"), told))
        return wall.summary(results, run.curve), chapters
    if run.designs is not None:
        return designs.summary(run.designs), [
            ("designs", say("Designs"), designs.designs(run.designs)),
            ("numbers", say("Parameters of each design"), designs.numbers(results)),
        ]
    if run.facade:
        return facade.summary(results), [
            ("curves", say("Fragility curves"), facade.curves(results)),
            ("numbers", say("Parameters and levels"), facade.numbers(results)),
            ("uncertainty", say("Uncertainty of the curve"), facade.uncertainty(results)),
        ]
    words = typology.words_of(run.uncertain is not None)
    chapters = [
        ("curves", say("Fragility curves"), typology.curves(results, words)),
        ("numbers", say("Parameters and fractiles"), typology.numbers(results, words)),
        ("uncertainty", words.uncertainty, typology.uncertainty(results, words)),
    ]
    if run.uncertain is None:
        return typology.summary(results), chapters
    model = ("model", say("Uncertainty of the model"), uncertain.model(run.uncertain))
    return uncertain.summary(run.uncertain), [model, *chapters]


def _of_checks(run: Run, language: Language) -> _Chapters:
    """The chapters on checks by a building code."""
    chapters: _Chapters = []
    if run.check is not None:
        chapters.append(("code_check", say("Check by NTC 2018"), code_check(run.check, run.curve, language)))
    if run.checks and isinstance(run.results, Typology):
        told = code_checks(
            run.checks,
            run.results.curves,
            run.results.population.p_occ.tolist(),
            facade=run.results.unions[run.facade] if run.facade else None,
            with_sheets=run.is_alike and len(run.checks) <= DRAWN,
        )
        chapters.append(("code_checks", say("Checks by NTC 2018"), told))
    return chapters


def _title_of_walls(run: Run) -> str:
    """Title of the chapter on the walls."""
    if run.designs is not None:
        return say("The designs")
    if run.facade:
        return say("The facade and its mechanisms")
    if run.uncertain is not None:
        return say("The wall and its variants")
    return say("Walls") if len(run.population) > 1 else say("The wall")
