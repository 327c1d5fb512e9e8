"""Chapter of a report on how often a wall collapses at its site."""

from __future__ import annotations

import warnings
from collections.abc import Sequence
from typing import Any

from dondolo._base.wording import decimal, say
from dondolo._fortran.histories import warnings_of_levels
from dondolo._fortran.records import blank_unit
from dondolo.curves.risk import Risk, between
from dondolo.curves.risk_uncertainty import RiskUncertainty
from dondolo.errors import DondoloError, DondoloWarning
from dondolo.hazard.hazard import HazardCurve
from dondolo.populations.typology import Typology
from dondolo.reporting.blocks import Block, Picture
from dondolo.reporting.content import Piece, Table, level_unit, pieces, state_name
from dondolo.reporting.language import Language
from dondolo.reporting.numerals import number, percent
from dondolo.reporting.parts import captioned, paragraph
from dondolo.reporting.run import Run
from dondolo.reporting.typology import combined
from dondolo.reporting.words import warning

# What sentences that are said elsewhere are marked by for the catalogues
_ = str
_YEARS = 50.0


def _cases(run: Run) -> tuple[list[tuple[str, Any]], int, str]:
    """Names and curves of which the frequency is taken, which of them is drawn, and whose that one is."""
    results = run.results
    if run.designs is not None:
        return (
            [
                (say("{whose}, collapse", whose=name), curve)
                for name, curve in zip(run.designs.names, run.designs.curves, strict=True)
                if curve.has_fit
            ],
            0,
            f", {run.designs.names[0]}",
        )
    if not isinstance(results, Typology):
        return [(say("collapse"), run.curve)], 0, ""
    limit = float(results.edp_thresholds[-1])
    last = len(results.edp_thresholds) - 1
    if run.facade:
        states = [results.at(float(edp)).unions[run.facade] for edp in results.edp_thresholds]
        names = [state_name(float(edp), limit) for edp in results.edp_thresholds]
        return [(name, curve) for name, curve in zip(names, states, strict=True)], last, ""
    cases: list[tuple[str, Any]] = [
        (say("whole population, {state}", state=state_name(edp, limit)), results.at(float(edp))["all"])
        for edp in results.edp_thresholds
    ]
    cases += [
        (say("{whose}, collapse", whose=one.group), results["all", one.group]) for one in combined(results) if one.group
    ]
    return cases, last, say(", whole population")


def risk_chapter(run: Run, hazard: HazardCurve, language: Language) -> tuple[list[Block], list[str]]:
    """How often a wall collapses at the site, and what to warn of; for populations, a wall drawn by weight."""
    cases, main, whose = _cases(run)
    population = isinstance(run.results, Typology) and not run.is_alike
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always", DondoloWarning)
        risks = [fragility.risk(hazard) for _, fragility in cases]
    risk = risks[main]
    found = [
        say("hazard: {warning}", warning=warning(language, one)) for one in warnings_of_levels(hazard.im, hazard.levels)
    ]
    if any(issubclass(one.category, DondoloWarning) for one in caught):
        short = [name for (name, _), one in zip(cases, risks, strict=True) if one.bounds[0] < 0.99 * one.bounds[1]]
        first, last = hazard.levels[[0, -1]]
        found.append(
            say(
                "the hazard curve, {first:g} to {last:g}{unit}, is too short: the bounds of the annual frequency"
                " differ by more than 1 % for {curves}",
                first=first,
                last=last,
                unit=blank_unit(hazard.im),
                curves="; ".join(short),
            )
        )
    uncertain = [_uncertainty(one) for one in risks]
    of_main = uncertain[main]
    kind = of_main.kind if of_main else ""
    of_frequencies = (
        say(
            "Mean annual frequencies. Two numbers are bounds for what the hazard may be beyond its levels, and the"
            " interval is that of the curve's uncertainty ({uncertain_by}) under the mean hazard.",
            uncertain_by=kind,
        )
        if kind
        else say("Mean annual frequencies. Two numbers are bounds for what the hazard may be beyond its levels; the"
                 " curve has no standard errors, and the frequency no confidence interval.")
    )  # fmt: skip
    low, high = risk.bounds
    frequency = between(low, high, say("a year"), 3)
    sentences = _introduction(hazard, frequency, is_sure=f"{low:.3g}" == f"{high:.3g}", is_population=population)
    caption = say(
        "Above, the hazard of the site; in the middle, the fragility; below, the intensities that contribute to the"
        " frequency of collapse."
    )
    alt = say("Hazard, fragility and the intensities that the risk comes from: {frequency}.", frequency=frequency)
    above, below = ([number(bound, 3) for bound in ends] for ends in (risk.above, risk.below))
    blocks: list[Block] = [
        paragraph(*sentences),
        Picture(risk.plot, caption, alt),
        captioned(_frequencies(cases, risks, uncertain, population), of_frequencies),
    ]
    if (fractiles := _fractiles(of_main)) is not None:
        of_fractiles = say(
            "Annual frequency of collapse for the mean hazard and for its fractiles, each with the interval of the"
            " curve's uncertainty."
        )
        blocks.append(captioned(fractiles, of_fractiles))
    of_parts = say(
        "Deaggregation of the frequency of collapse{whose}: contributions of the intensities between the levels of the"
        " hazard.",
        whose=whose,
    )
    on_tails = pieces(
        "Above the highest level: between {low} and {high} a year; below the lowest: up to {below}.",
        low=above[0],
        high=above[1],
        below=below[1],
    )
    return [*blocks, captioned(_deaggregation(risk, hazard), of_parts), paragraph(on_tails)], found


def _introduction(hazard: HazardCurve, frequency: str, *, is_sure: bool, is_population: bool) -> list[str]:
    """What the frequency is, and of which hazard."""
    sentences = [
        say("The mean annual frequency of collapse is the integral of the fragility over the hazard of the site,"
            " λ = ∫ P(C | x) |dH(x)|, where H(x) is the annual frequency with which the intensity x is exceeded.")
    ]  # fmt: skip
    if is_population:
        sentences.append(
            say(
                "For a population it is that of a wall drawn by weight: the share of the walls lost a year; and the"
                " probability in {years} years is the share lost in that time, from the frequency of each wall.",
                years=f"{_YEARS:g}",
            )
        )
    sentences.append(
        say("It is {frequency}: the hazard beyond its levels does not change these digits.", frequency=frequency)
        if is_sure
        else say(
            "It is {frequency}: the hazard beyond its levels is unknown, which the bounds allow for.",
            frequency=frequency,
        )
    )
    sentences.append(say("Events are assumed to be a Poisson process."))
    if hazard.endless:
        sentences.append(say("The hazard is as given; it must include the effects of soil and topography."))
    else:
        first, last = (decimal(f"{level:g}{blank_unit(hazard.im)}") for level in hazard.levels[[0, -1]])
        words = _("The hazard is as given, from {first} to {last}; it must include the effects of soil and topography.")
        sentences.append(say(words, first=first, last=last))
    if hazard.source:
        sentences.append(say("Its source: {source}.", source="; ".join(hazard.source)))
    return sentences


def _frequencies(
    cases: Sequence[tuple[str, Any]],
    risks: Sequence[Risk],
    uncertain: Sequence[RiskUncertainty | None],
    population: bool,
) -> Table:
    """Annual frequencies of all curves, with their intervals."""
    frequencies: dict[Piece, Sequence[Piece]] = {
        say("curve"): [name for name, _ in cases],
        say("annual frequency [1/year]"): [_ends(*one.bounds) for one in risks],
    }
    frequencies[say("95 % interval [1/year]")] = ["" if one is None else _ends(*one.interval()) for one in uncertain]
    if not population:
        frequencies[say("return period [years]")] = [_ends(*one.return_period_bounds) for one in risks]
    within = say("probability in {years:g} years", years=_YEARS)
    frequencies[within] = [_ends(*one.probability_bounds(_YEARS)) for one in risks]
    return Table.of(frequencies)


def _deaggregation(risk: Risk, hazard: HazardCurve) -> Table:
    """What the intensities between the levels of the hazard contribute."""
    edges = hazard.levels
    parts = risk.deaggregate(edges)
    unit = level_unit(hazard.im)
    deaggregation: dict[Piece, Sequence[Piece]] = {
        say("{im} from [{unit}]", im=hazard.im, unit=unit): [number(x) for x in edges[:-1]],
        say("to [{unit}]", unit=unit): [number(x) for x in edges[1:]],
        say("exceeded, lower end [1/year]"): [number(h, 3) for h in hazard.annual_frequency[:-1]],
        say("contribution [1/year]"): [number(part, 3) for part in parts],
        say("share"): [percent(part / risk.annual_frequency if risk.annual_frequency > 0.0 else 0.0) for part in parts],
    }
    return Table.of(deaggregation)


def _uncertainty(risk: Risk) -> RiskUncertainty | None:
    """Distribution of an annual frequency; None for a curve without standard errors."""
    try:
        return risk.uncertainty()
    except DondoloError:
        return None


def _fractiles(uncertain: RiskUncertainty | None) -> Table | None:
    """Annual frequencies and intervals for the fractiles of the hazard; None if it has none."""
    if uncertain is None or not uncertain.fractiles:
        return None
    table = uncertain.table()
    return Table.of(
        {
            say("hazard"): [say("mean") if one == "mean" else decimal(str(one)) for one in table["hazard"]],
            say("annual frequency [1/year]"): [number(x, 3) for x in table["annual_frequency"]],
            say("95 % interval [1/year]"): [
                _ends(low, high) for low, high in zip(table["low"], table["high"], strict=True)
            ],
        }
    )


def _ends(low: float, high: float) -> Piece:
    """Both bounds, or one number where they are the same to the digits shown."""
    ends = number(low, 3), number(high, 3)
    return ends[0] if ends[0] == ends[1] else pieces("{low} to {high}", low=ends[0], high=ends[1])
