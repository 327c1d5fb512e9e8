"""Facts of a report on how often a wall collapses at its site."""

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
from dondolo.reporting.content import Piece, Table, figure, level_unit, pieces, state_name
from dondolo.reporting.language import Language
from dondolo.reporting.numerals import number, percent
from dondolo.reporting.run import Run
from dondolo.reporting.typology import combined
from dondolo.reporting.words import warning

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


def risk_facts(run: Run, hazard: HazardCurve, language: Language) -> tuple[dict[str, Any], list[str]]:
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
    frequencies: dict[Piece, Sequence[Piece]] = {
        say("curve"): [name for name, _ in cases],
        say("annual frequency [1/year]"): [_ends(*one.bounds) for one in risks],
    }
    uncertain = [_uncertainty(one) for one in risks]
    frequencies[say("95 % interval [1/year]")] = ["" if one is None else _ends(*one.interval()) for one in uncertain]
    if not population:
        frequencies[say("return period [years]")] = [_ends(*one.return_period_bounds) for one in risks]
    within = say("probability in {years:g} years", years=_YEARS)
    frequencies[within] = [_ends(*one.probability_bounds(_YEARS)) for one in risks]
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
    shown = uncertain[main]
    low, high = risk.bounds
    frequency = between(low, high, say("a year"), 3)
    facts = {
        "population": population,
        "whose": whose,
        "years": f"{_YEARS:g}",
        "frequency": frequency,
        "levels": []
        if hazard.endless
        else [decimal(f"{level:g}{blank_unit(hazard.im)}") for level in hazard.levels[[0, -1]]],
        "source": hazard.source,
        "is_sure": f"{low:.3g}" == f"{high:.3g}",
        "figure": figure(
            risk.plot,
            say("Hazard, fragility and the intensities that the risk comes from: {frequency}.", frequency=frequency),
        ),
        "frequencies": Table.of(frequencies),
        "uncertain_by": shown.kind if shown else "",
        "fractiles": _fractiles(shown),
        "deaggregation": Table.of(deaggregation),
        "above": [number(bound, 3) for bound in risk.above],
        "below": [number(bound, 3) for bound in risk.below],
    }
    return facts, found


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
