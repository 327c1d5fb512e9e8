"""The beginning of a report: what it is of, its verdict, and the warnings on the calculation."""

from __future__ import annotations

from collections.abc import Sequence

from dondolo._base.wording import property_name, say
from dondolo._fortran.records import blank_unit
from dondolo.analysis.response import Response
from dondolo.figures import style
from dondolo.populations.typology import Typology
from dondolo.reporting.blocks import Aside, Block
from dondolo.reporting.content import date_in_words, measure_name
from dondolo.reporting.inputs import counted_histories
from dondolo.reporting.numerals import whole
from dondolo.reporting.parts import paragraph
from dondolo.reporting.run import Run
from dondolo.reporting.verdict import verdict
from dondolo.reporting.walls import mechanism_of


def judgement(run: Run, warnings: Sequence[str], *, without_soil: bool) -> list[Block]:
    """The verdict, if something was checked or is in doubt, and the warnings.

    Parameters
    ----------
    run : Run
        What was run.
    warnings : sequence of str
        In the language in force.
    without_soil : bool
        Whether the hazard of the annual frequency is without the factor of soil and topography.
    """
    checked = run.checks if run.check is None else (run.check,)
    found = verdict(checked, run.population.walls, run.warnings, without_soil=without_soil)
    title = (
        say("Warning on the calculation")
        if len(warnings) == 1
        else say("{many} warnings on the calculation", many=len(warnings))
    )
    return [
        *([found] if found else []),
        Aside("warnings", "", title, tuple(warnings))
        if warnings
        else paragraph(say("No warnings on the calculation.")),
    ]


def lead(run: Run) -> str:
    """What this is, in a line."""
    results = run.results
    parts = []
    if run.uncertain is not None:
        everything, many = run.uncertain.typology.walls, len(run.uncertain.sample)
        wall, names = everything[many], ", ".join(map(property_name, run.uncertain.sources))
        words = {"wall": wall.name, "mechanism": mechanism_of(wall), "names": names}
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
        parts.append(f"{results.wall.name}: {mechanism_of(results.wall)}")
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
        histories, runs = counted_histories(results)
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
