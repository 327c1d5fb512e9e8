"""Chapter of a report on how often a wall collapses at its site."""

from __future__ import annotations

import warnings
from typing import Any

from dondolo._fortran import _binding
from dondolo._page import Markup, figure, joined, number, paragraph, percent, table
from dondolo._report_typology import combined
from dondolo._report_words import Chapter, state_name
from dondolo.errors import DondoloWarning
from dondolo.populations.typology import Typology
from dondolo.risk.frequency import between
from dondolo.risk.hazard import HazardCurve

_YEARS = 50.0


def risk_chapter(results: Any, curve: Any, hazard: HazardCurve) -> tuple[Chapter, list[str]]:
    """How often a wall collapses at the site, and what to warn of; for populations, a wall drawn by weight."""
    from dondolo.risk.frequency import mean_annual_frequency

    population = isinstance(results, Typology)
    if population:
        limit = float(results.edp_thresholds[-1])
        cases = [
            (f"whole population, {state_name(edp, limit)}", results.at(float(edp))["all"])
            for edp in results.edp_thresholds
        ]
        cases += [(f"{one.group}, collapse", results["all", one.group]) for one in combined(results) if one.group]
        main = len(results.edp_thresholds) - 1
    else:
        cases, main = [("collapse", curve)], 0
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always", DondoloWarning)
        risks = [mean_annual_frequency(fragility, hazard) for _, fragility in cases]
    risk = risks[main]
    low, high = risk.bounds
    found = []
    if any(issubclass(one.category, DondoloWarning) for one in caught):
        short = [
            (name, one) for (name, _), one in zip(cases, risks, strict=True) if one.bounds[0] < 0.99 * one.bounds[1]
        ]
        first, last = hazard.im_levels[[0, -1]]
        unit = f" {_binding.unit_of(hazard.im)}".rstrip()
        found.append(
            f"the hazard curve, {first:g} to {last:g}{unit}, is too short: the bounds of the annual frequency differ by"
            f" more than 1 % for {'; '.join(name for name, _ in short)}"
        )
    columns: dict[Any, Any] = {
        "curve": [name for name, _ in cases],
        "annual frequency [1/year]": [_ends(*one.bounds) for one in risks],
    }
    if not population:
        columns["return period [years]"] = [_ends(*one.return_period_bounds) for one in risks]
    columns[f"probability in {_YEARS:g} years"] = [_ends(*one.probability_bounds(_YEARS)) for one in risks]
    edges = hazard.im_levels
    parts = risk.deaggregate(edges)
    unit = _binding.unit_of(hazard.im) or "-"
    shares: dict[Any, Any] = {
        f"{hazard.im} from [{unit}]": [number(x) for x in edges[:-1]],
        f"to [{unit}]": [number(x) for x in edges[1:]],
        "exceeded, lower end [1/year]": [number(h, 3) for h in hazard.annual_frequency[:-1]],
        "contribution [1/year]": [number(part, 3) for part in parts],
        "share": [percent(part / risk.frequency if risk.frequency > 0.0 else 0.0) for part in parts],
    }
    meaning = (
        "For a population it is that of a wall drawn by weight: the share of the walls lost a year; and the probability"
        f" in {_YEARS:g} years is the share lost in that time, from the frequency of each wall. "
        if population
        else ""
    )
    same = f"{low:.3g}" == f"{high:.3g}"
    content = joined(
        paragraph(
            "The mean annual frequency of collapse is the integral of the fragility over the hazard of the site,"
            " λ = ∫ P(C | x) |dH(x)|, where H(x) is how often a year the intensity x is exceeded. ",
            meaning,
            f"It is {between(low, high, 'a year', 3)}: ",
            "what lies beyond the levels of the hazard does not change these digits."
            if same
            else "nothing is known of the hazard beyond its levels, which the bounds allow for.",
            " Events are taken for a Poisson process.",
        ),
        figure(
            risk.plot,
            f"Hazard, fragility and the intensities that the risk comes from: {between(low, high, 'a year', 3)}.",
            "Above, the hazard of the site; in the middle, the fragility; below, which intensities the frequency of"
            " collapse comes from.",
        ),
        table(
            "Mean annual frequencies. Two numbers are bounds for what the hazard may be beyond its levels, not a"
            " confidence interval: the uncertainty of the curves and of the hazard is not included.",
            columns,
        ),
        table(
            f"Deaggregation of the frequency of collapse{', whole population' if population else ''}: what intensities"
            " between the levels of the hazard contribute.",
            shares,
        ),
        paragraph(
            "Above the highest level: between ",
            number(risk.above[0], 3),
            " and ",
            number(risk.above[1], 3),
            " a year; below the lowest: up to ",
            number(risk.below[1], 3),
            ".",
        ),
    )
    return ("risk", "Annual frequency of collapse", content), found


def _ends(low: float, high: float) -> Markup:
    """Both bounds, or one number where they are the same to the digits shown."""
    ends = number(low, 3), number(high, 3)
    return ends[0] if ends[0] == ends[1] else joined(ends[0], " to ", ends[1])
