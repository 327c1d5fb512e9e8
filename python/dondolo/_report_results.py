"""Chapters of a report that show results: curves of a population or of a wall, a motion, risk."""

from __future__ import annotations

import warnings
from collections import Counter
from typing import TYPE_CHECKING, Any

import numpy as np

from dondolo import _binding, style
from dondolo._page import (
    Markup,
    cards,
    details,
    facts,
    figure,
    joined,
    number,
    paragraph,
    percent,
    probability,
    symbol,
    table,
    tag,
    whole,
)
from dondolo.errors import DondoloError, DondoloWarning

if TYPE_CHECKING:
    from collections.abc import Sequence

    from dondolo.fragility import Fragility
    from dondolo.hazard import HazardCurve
    from dondolo.motion import Response
    from dondolo.stripes import Stripes
    from dondolo.typology import Group, Typology

Chapter = tuple[str, str, Markup]

# Samples of a bootstrap; of a population, of which each takes longer, fewer
_SAMPLES, _SAMPLES_OF_POPULATION = 2000, 500
_YEARS = 50.0

THETA, BETA = symbol("θ"), symbol("β")

STATUSES = {
    "ok": "a curve",
    "extrapolated": "a curve whose median θ lies outside the levels of the analysis: to be used with care",
    "no_collapse": "no history reached the state at any level: no curve",
    "all_collapse": "every history reached the state at every level: no curve",
    "separated": "no overlap between levels that reach the state and levels that do not: any steep curve fits",
    "single_level": "one level only: no curve",
    "decreasing": "the state does not become more frequent with the level: no curve",
}

_LOGNORMAL = (
    "The curve is P(C | IM = x) = Φ(ln(x/θ)/β), Φ the standard normal distribution: θ is the median, the level at which"
    " the probability is one half, and β the dispersion, the standard deviation of ln IM at collapse."
)


def quiet(state: Any, edp: float) -> Any:
    """A damage state of a population or of a wall; the report counts what the warnings would say."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", DondoloWarning)
        return state(edp)


def state_name(edp: float, limit: float) -> str:
    """A damage state in words."""
    return "collapse" if edp == limit else f"EDP ≥ {edp:g}"


def mechanism_name(mechanism: str) -> str:
    """A mechanism in words."""
    return "all mechanisms" if mechanism == "all" else mechanism.replace("_", "-")


def with_unit(value: float, im: str, figures: int = 3) -> Markup:
    """A level of intensity and its unit."""
    return joined(number(value, figures), f" {_binding.unit_of(im)}".rstrip())


def _level_head(im: str) -> str:
    """Head of a column of levels."""
    return f"{im} [{_binding.unit_of(im) or '-'}]"


# --- Populations


def typology_cards(people: Typology) -> Markup:
    """The main numbers of a population."""
    curve = people.group()
    entries: list[tuple[Any, Any, Any]] = []
    if curve.fit.has_fit:
        entries.append(
            (joined("median ", THETA), with_unit(curve.fit.theta, people.im), "of collapse, whole population")
        )
        entries.append((joined("dispersion ", BETA), number(curve.fit.beta, 3), "of the lognormal fitted to the mean"))
    else:
        entries.append(("lognormal fit", "none", curve.fit.status.replace("_", " ")))
    entries.append((symbol("β", "walls"), number(curve.beta_walls, 3), "dispersion between walls"))
    entries.append((symbol("β", "records"), number(curve.beta_records, 3), "dispersion between records"))
    return cards(entries)


def typology_sentences(people: Typology) -> Markup:
    """The result in words: what collapses at three of the levels."""
    curve = people.group()
    chosen = dict.fromkeys(int(i) for i in np.linspace(0, len(people.levels) - 1, 5)[1:-1])
    parts = [joined(percent(curve.mean_curve[i]), " at ", with_unit(people.levels[i], people.im)) for i in chosen] or [
        joined(percent(curve.mean_curve[0]), " at ", with_unit(people.levels[0], people.im))
    ]
    text = joined(*(joined(", " if k else "", part) for k, part in enumerate(parts)))
    measure = style.im_label(people.im).split(" [")[0]
    return paragraph(
        f"Of the walls, by weight, these shares are expected to collapse for a given {measure}: ", text, "."
    )


def typology_chapters(people: Typology) -> list[Chapter]:
    """Curves, tables and uncertainty of a population."""
    return [
        ("curves", "Fragility curves", _typology_figures(people)),
        ("numbers", "Parameters and fractiles", _typology_tables(people)),
        ("uncertainty", "Uncertainty of the typological curve", _typology_uncertainty(people)),
    ]


def _typology_figures(people: Typology) -> Markup:
    from dondolo.plots_typology import plot_combination, plot_damage_states, plot_groups, plot_typology

    of_all = [curve for curve in people.groups if not curve.group]
    pieces = [
        paragraph(_LOGNORMAL, " Thin lines are the curves of single walls, the red line is their weighted mean."),
    ]
    if len(of_all) > 1:
        pieces.append(
            figure(
                lambda: plot_combination(people),
                "Mean fragility curve of each mechanism and of all together. " + _in_words(of_all),
                "Mechanisms and their combination. A wall collapses by whichever of its mechanisms comes first, each with"
                " the probability that it can occur; the band holds 68 % of the weight.",
            )
        )
    for curve in [one for one in of_all if one.mechanism != "all"] + [one for one in of_all if one.mechanism == "all"]:
        what = mechanism_name(curve.mechanism)
        pieces.append(
            figure(
                lambda curve=curve: plot_typology(people, mechanism=curve.mechanism),
                f"Fragility curves of {curve.walls} walls, {what}, their mean and fractiles. " + _in_words([curve]),
                f"{what[0].upper()}{what[1:]}: curves of single walls, at most 300 of them drawn, weighted mean,"
                " fractiles, and the lognormal fitted to the weighted fractions (dots).",
            )
        )
    grouped = [curve for curve in _combined(people) if curve.group]
    if grouped:
        pieces.append(
            figure(
                lambda: plot_groups(people),
                "Mean fragility curve of each group beside that of the population. " + _in_words(grouped),
                "Groups beside the whole population, all mechanisms of each wall together.",
            )
        )
    if len(people.edp_thresholds) > 1:
        states = [quiet(people.at, edp).group() for edp in people.edp_thresholds]
        pieces.append(
            figure(
                lambda: quiet(lambda _: plot_damage_states(people), 0.0),
                "Probability to reach each damage state. " + _in_words(states),
                "Damage states of the whole population. EDP is the largest rotation over the capacity, the rotation at"
                " which the wall overturns; a history reaches a state if its EDP comes to the threshold.",
            )
        )
    return joined(*pieces)


def _combined(people: Typology) -> list[Group]:
    """The last curve of the population and of each group: all mechanisms."""
    return list({curve.group: curve for curve in people.groups}.values())


def _in_words(curves: Sequence[Group]) -> str:
    """Curves for who cannot see them."""
    texts = []
    for curve in curves:
        who = f"{curve.group or 'population'}, {mechanism_name(curve.mechanism)}"
        if curve.fit.edp is not None and curve.fit.has_fit:
            unit = f" {_binding.unit_of(curve.fit.im)}".rstrip()
            texts.append(
                f"{who}, EDP {curve.fit.edp:g}: median {curve.fit.theta:.3g}{unit}, dispersion {curve.fit.beta:.3g}"
            )
        else:
            texts.append(f"{who}: no fit ({curve.fit.status})")
    return "; ".join(texts) + "."


def _typology_tables(people: Typology) -> Markup:
    limit = float(people.edp_thresholds[-1])
    pieces = [
        paragraph(
            "Each line is one lognormal fitted to the weighted mean fractions. ",
            symbol("β", "walls"),
            " and ",
            symbol("β", "records"),
            " part the dispersion between walls from that between records; they add in squares."
            " The largest misfit is the greatest distance between the fitted curve and the mean fractions at the levels:"
            " a lognormal can only approximate a mixture of walls, and less so one of which some walls cannot collapse.",
        ),
        _curves_table(people, "Collapse"),
    ]
    pieces += [
        details(
            f"Curves of the damage state EDP ≥ {edp:g}",
            _curves_table(quiet(people.at, edp), f"Damage state EDP ≥ {edp:g}"),
        )
        for edp in people.edp_thresholds[:-1]
    ]
    pieces.append(
        paragraph(
            "The fractiles at a level are what 16, 50 and 84 % of the weight of the walls do not exceed: how different"
            " the walls are, not how well the curve is known."
        )
    )
    for edp in people.edp_thresholds[::-1]:
        state = quiet(people.at, float(edp))
        text = f"Whole population, {state_name(edp, limit)}"
        content = _levels_table(state, state.group(), text)
        pieces.append(content if edp == limit else details(text, content))
    others = [curve for curve in people.groups if curve is not people.group()]
    pieces += [
        details(text, _levels_table(people, curve, text))
        for curve in others
        for text in [f"{curve.group or 'Whole population'}, {mechanism_name(curve.mechanism)}, collapse"]
    ]
    return joined(*pieces)


def _curves_table(people: Typology, caption: str) -> Markup:
    """Parameters of all curves of one state."""
    curves = people.groups
    unit = f" [{_binding.unit_of(people.im) or '-'}]"

    def misfit(curve: Group) -> float:
        if not curve.fit.has_fit:
            return np.nan
        return float(np.abs(curve.fit(people.levels) - curve.mean_fraction).max())

    columns: dict[Any, Any] = {
        "group": [curve.group or "whole population" for curve in curves],
        "mechanism": [mechanism_name(curve.mechanism) for curve in curves],
        "walls": [whole(curve.walls) for curve in curves],
        "weight": [number(curve.weight) for curve in curves],
        joined(THETA, unit): [number(curve.fit.theta) for curve in curves],
        BETA: [number(curve.fit.beta) for curve in curves],
        symbol("β", "walls"): [number(curve.beta_walls) for curve in curves],
        symbol("β", "records"): [number(curve.beta_records) for curve in curves],
        "largest misfit": [number(misfit(curve), 2) for curve in curves],
        "weight with a curve": [percent(curve.fitted) for curve in curves],
        "status": [curve.fit.status for curve in curves],
    }
    return table(f"{caption}: parameters of the curves.", columns, ("mechanism", "status"))


def _levels_table(people: Typology, curve: Group, caption: str) -> Markup:
    """Means and fractiles at the levels."""
    columns: dict[Any, Any] = {
        _level_head(people.im): [number(level) for level in people.levels],
        "mean of fractions": [probability(p) for p in curve.mean_fraction],
        "mean of curves": [probability(p) for p in curve.mean_curve],
    }
    for share, row in zip(("16 %", "50 %", "84 %"), curve.fractiles, strict=True):
        columns[f"{share} fractile"] = [probability(p) for p in row]
    if curve.fit.has_fit:
        columns["lognormal"] = [probability(p) for p in curve.fit(people.levels)]
    return table(f"{caption}: probabilities at the levels.", columns)


def _typology_uncertainty(people: Typology) -> Markup:
    curve = people.group()
    stored = people.flags is None
    over = ("walls",) if stored else ("records", "walls")
    try:
        samples = people.bootstrap(_SAMPLES_OF_POPULATION, over=over)
        parameters = samples.parameter_interval()
    except DondoloError as error:
        return paragraph(f"No intervals: {error}.")
    low, high = samples.mean_interval()
    drawn = " and ".join(over)
    text = (
        f"The whole analysis was repeated on {_SAMPLES_OF_POPULATION} samples of {drawn}, drawn with replacement"
        " (bootstrap); the intervals hold the middle 95 % of them."
    )
    if stored:
        text += (
            " Records were not drawn: the result files of a population hold counts, and not which record they are of, so"
            " that what a different choice of records would change is not in these intervals."
        )
    missing = samples.without_fit
    if missing:
        text += f" {100.0 * missing:.3g} % of the samples have no fit and no part in the intervals of θ and β."
    rows = [
        (joined(THETA, f" [{_binding.unit_of(people.im) or '-'}]"), curve.fit.theta, *parameters["theta"]),
        (BETA, curve.fit.beta, *parameters["beta"]),
    ]
    columns: dict[Any, Any] = {
        "parameter": [row[0] for row in rows],
        "estimate": [number(row[1]) for row in rows],
        "from": [number(row[2]) for row in rows],
        "to": [number(row[3]) for row in rows],
    }
    levels: dict[Any, Any] = {
        _level_head(people.im): [number(level) for level in people.levels],
        "mean of fractions": [probability(p) for p in curve.mean_fraction],
        "from": [probability(p) for p in low],
        "to": [probability(p) for p in high],
    }
    return joined(
        paragraph(text),
        table(f"95 % intervals of the parameters, by drawing {drawn}.", columns),
        details(
            "Intervals at the levels",
            table(f"95 % intervals of the mean fraction at each level, by drawing {drawn}.", levels),
        ),
    )


def status_table(states: dict[str, Sequence[Fragility]]) -> Markup:
    """How many curves have which status, a column a damage state."""
    counts = {name: Counter(curve.status for curve in curves) for name, curves in states.items()}
    found = [status for status in STATUSES if any(count[status] for count in counts.values())]
    columns: dict[Any, Any] = {"status": found}
    columns |= {name: [whole(count[status]) for status in found] for name, count in counts.items()}
    columns["meaning"] = [STATUSES[status] for status in found]
    return table("Fits of the single walls and mechanisms by their status.", columns, ("meaning",))


# --- One wall


def stripes_cards(stripes: Stripes, curve: Fragility) -> Markup:
    """The main numbers of a wall."""
    entries: list[tuple[Any, Any, Any]] = []
    if curve.has_fit:
        spread = joined("standard error of ln ", THETA, " ", number(curve.se_ln_theta, 3))
        entries.append((joined("median ", THETA), with_unit(curve.theta, stripes.im), spread))
        entries.append(
            (joined("dispersion ", BETA), number(curve.beta, 3), joined("standard error ", number(curve.se_beta, 3)))
        )
    else:
        low, high = curve.bracket
        entries.append(("fit", "none", curve.status.replace("_", " ")))
        entries.append(("median between", joined(number(low, 3), " and ", with_unit(high, stripes.im)), "levels"))
    total = stripes.collapsed.size
    entries.append(("histories", whole(total), f"{len(stripes.levels)} levels of {stripes.edp.shape[1]}"))
    entries.append(
        ("collapses", whole(stripes.collapsed.sum()), joined(percent(stripes.collapsed.mean()), " of the histories"))
    )
    return cards(entries)


def stripes_chapters(stripes: Stripes, curve: Fragility, thresholds: Sequence[float]) -> list[Chapter]:
    """Figures, tables and intervals of a wall."""
    return [
        ("curves", "Histories and fragility curve", _stripes_figures(stripes, curve, thresholds)),
        ("numbers", "Stripes and damage states", _stripes_tables(stripes, curve, thresholds)),
        ("uncertainty", "Uncertainty of the curve", _stripes_uncertainty(curve)),
    ]


def _stripes_figures(stripes: Stripes, curve: Fragility, thresholds: Sequence[float]) -> Markup:
    from dondolo.plots import plot_fragility, plot_stripes
    from dondolo.plots_typology import plot_damage_states

    unit = f" {_binding.unit_of(stripes.im)}".rstrip()
    levels = ", ".join(
        f"{z} of {n} at {x:g}{unit}"
        for x, z, n in zip(stripes.levels, stripes.collapses, stripes.histories, strict=True)
    )
    fitted = (
        f"median {curve.theta:.3g}{unit}, dispersion {curve.beta:.3g}" if curve.has_fit else f"no fit ({curve.status})"
    )
    pieces = [
        paragraph(_LOGNORMAL),
        figure(
            lambda: plot_stripes(stripes),
            f"Largest rotation over capacity of every history at every level. Collapses: {levels}.",
            "Every history of the analysis. EDP is the largest rotation over the capacity, the rotation at which the wall"
            " overturns; triangles stand for collapses, with their number.",
        ),
        figure(
            lambda: plot_fragility(curve, stripes),
            f"Fractions of collapse and fitted fragility curve: {fitted}.",
            "The curve fitted by maximum likelihood, with its 95 % band, and the fractions of collapse with exact"
            " binomial intervals.",
        ),
    ]
    if len(thresholds) > 1:
        pieces.append(
            figure(
                lambda: quiet(lambda _: plot_damage_states(stripes, edp=thresholds), 0.0),
                f"Fragility curves of the damage states EDP {', '.join(f'{edp:g}' for edp in thresholds)}.",
                "Damage states: a history reaches a state if its EDP comes to the threshold.",
            )
        )
    return joined(*pieces)


def _stripes_tables(stripes: Stripes, curve: Fragility, thresholds: Sequence[float]) -> Markup:
    columns: dict[Any, Any] = {
        _level_head(stripes.im): [number(level) for level in stripes.levels],
        "histories": [whole(n) for n in stripes.histories],
        "collapses": [whole(z) for z in stripes.collapses],
        "fraction": [probability(p) for p in stripes.fraction],
    }
    if curve.has_fit:
        low, high = curve.interval(stripes.levels)
        columns["fitted curve"] = [probability(p) for p in curve(stripes.levels)]
        columns["95 % band from"] = [probability(p) for p in low]
        columns["to"] = [probability(p) for p in high]
    columns["median EDP"] = [number(value, 3) for value in np.median(stripes.edp, axis=1)]
    states = [curve if edp == stripes.edp_limit else quiet(stripes.fit, float(edp)) for edp in thresholds]
    fits: dict[Any, Any] = {
        "damage state": [state_name(edp, stripes.edp_limit) for edp in thresholds],
        joined(THETA, f" [{_binding.unit_of(stripes.im) or '-'}]"): [number(one.theta) for one in states],
        joined("standard error of ln ", THETA): [number(one.se_ln_theta, 3) for one in states],
        BETA: [number(one.beta) for one in states],
        joined("standard error of ", BETA): [number(one.se_beta, 3) for one in states],
        "log likelihood": [number(one.log_likelihood) for one in states],
        "status": [one.status for one in states],
    }
    return joined(
        table("Curves of the damage states.", fits, ("status",)),
        table("Stripes: what happens at each level.", columns),
    )


def _stripes_uncertainty(curve: Fragility) -> Markup:
    if not curve.has_fit:
        low, high = curve.bracket
        return paragraph(
            "There is no finite fit, and so no interval: half of the histories begin to collapse between ",
            number(low),
            " and ",
            with_unit(high, curve.im),
            f" (status {curve.status}: {STATUSES[curve.status]}).",
        )
    methods = {
        "covariance (delta method)": curve.parameter_interval(),
        "profile likelihood": curve.parameter_interval(method="profile"),
    }
    if curve.stripes is not None:
        methods[f"bootstrap of the records, {_SAMPLES} samples"] = curve.bootstrap(_SAMPLES).parameter_interval()
    columns: dict[Any, Any] = {"method": list(methods)}
    for letter, name in ((THETA, "theta"), (BETA, "beta")):
        columns[joined(letter, " from")] = [number(interval[name][0]) for interval in methods.values()]
        columns[joined(letter, " to")] = [number(interval[name][1]) for interval in methods.values()]
    return joined(
        paragraph(
            "The first two methods take all histories for independent. The bootstrap draws whole records, and so knows that"
            " the stripes share them: it is the one to rely on where they differ."
        ),
        table("95 % intervals of the parameters.", columns),
    )


# --- One motion


def response_cards(motion: Response) -> Markup:
    """The main numbers of a motion."""
    edp = number(motion.edp, 4)
    return cards(
        [
            ("EDP", edp, "largest rotation / capacity"),
            ("collapse", "yes" if motion.collapsed else "no", f"limit: EDP = {motion.edp_limit:g}"),
            ("impacts", whole(motion.impacts), "before the end of the record"),
            ("time of the peak", joined(number(motion.time_of_peak), " s"), "of the largest rotation"),
        ]
    )


def response_chapters(motion: Response) -> list[Chapter]:
    """Figures of a motion."""
    from dondolo.drawing import plot_wall
    from dondolo.plots import plot_history

    outcome = "it overturns" if motion.collapsed else f"largest rotation {motion.edp:.4g} of the capacity"
    pieces = [
        paragraph(
            "Rotation is given over the capacity, the rotation at which the wall overturns under its own weight."
        ),
        *(
            [
                figure(
                    lambda: plot_history(motion),
                    f"Ground acceleration and rotation over time: {outcome} at {motion.time_of_peak:.4g} s.",
                    f"Ground acceleration of {motion.record.name}, scaled by {motion.scale:.4g}, and the rotation of the"
                    " wall.",
                )
            ]
            if motion.time is not None
            else []
        ),
        figure(
            lambda: plot_wall(motion),
            f"The wall at its largest rotation: {outcome}.",
            "The wall at its largest rotation, drawn to scale.",
        ),
    ]
    return [
        ("motion", "Motion", joined(*pieces)),
        ("numbers", "Numbers", facts((name, text) for name, text in motion._facts())),
    ]


# --- Risk


def risk_chapter(results: Any, curve: Any, hazard: HazardCurve) -> tuple[Chapter, list[str]]:
    """How often a wall collapses at the site, and what to warn of; for populations, a wall drawn by weight."""
    from dondolo.risk import mean_annual_frequency
    from dondolo.risk_plots import plot_risk
    from dondolo.typology import Typology

    population = isinstance(results, Typology)
    if population:
        limit = float(results.edp_thresholds[-1])
        cases = [
            (f"whole population, {state_name(edp, limit)}", quiet(results.at, float(edp)).mean)
            for edp in results.edp_thresholds
        ]
        cases += [
            (f"{one.group}, collapse", lambda x, name=one.group: results.mean(x, group=name))
            for one in _combined(results)
            if one.group
        ]
        # The measure is checked against that of the population first, by its own method.
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
            f" more than 1 % for {', '.join(name for name, _ in short)}"
        )
    columns: dict[Any, Any] = {
        "curve": [name for name, _ in cases],
        "annual frequency from": [number(one.bounds[0], 3) for one in risks],
        "to [1/year]": [number(one.bounds[1], 3) for one in risks],
        "return period [years]": [number(one.return_period, 3) for one in risks],
        f"probability in {_YEARS:g} years": [number(one.probability(_YEARS), 3) for one in risks],
    }
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
    who = (
        "For a population it is that of a wall drawn by weight: the share of the walls lost a year. "
        if population
        else ""
    )
    content = joined(
        paragraph(
            "The mean annual frequency of collapse is the integral of the fragility over the hazard of the site,"
            " λ = ∫ P(C | x) |dH(x)|, where H(x) is how often a year the intensity x is exceeded. ",
            who,
            "It lies between ",
            number(low, 3),
            " and ",
            number(high, 3),
            " a year: nothing is known of the hazard beyond its levels, which the bounds allow for. Return period and"
            f" probability in {_YEARS:g} years (events as a Poisson process) belong to the lower bound.",
        ),
        figure(
            lambda: plot_risk(risk),
            f"Hazard curve, fragility curve and the intensities that the risk comes from: {low:.3g} to {high:.3g} a year.",
            "Above, the hazard of the site; in the middle, the fragility; below, which intensities the frequency of"
            " collapse comes from.",
        ),
        table("Mean annual frequencies.", columns),
        table(
            "Deaggregation of the frequency of collapse"
            f"{', whole population' if population else ''}: what intensities between the levels of the hazard contribute.",
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


def symbols(im: str) -> Markup:
    """What letters and terms mean."""
    pairs = [
        ("IM, x", f"intensity measure of the ground motion: {style.im_label(im)}"),
        ("C", "collapse: the rotation reaches the limit, unless another damage state is named"),
        ("EDP", "engineering demand parameter: largest rotation / capacity, without a unit"),
        (THETA, "median of a fragility curve, in the unit of IM"),
        (BETA, "dispersion of a fragility curve: standard deviation of ln IM at collapse"),
        (symbol("β", "walls"), joined("dispersion between walls: weighted standard deviation of ln ", THETA)),
        (
            symbol("β", "records"),
            joined("dispersion between records: weighted root mean square of ", BETA, " of the walls"),
        ),
        (symbol("a", "0"), "trigger: ground acceleration at which the wall begins to rock"),
        ("capacity", "rotation at which the wall overturns without further shaking [rad]"),
        (symbol("p"), "frequency parameter of the rocking wall [rad/s]: the smaller, the slower"),
        ("speed ratio", "speed of rotation after an impact over that before it; restitution times what it is given as"),
        (symbol("p", "occ"), "probability that a mechanism can occur in a wall"),
        ("weight", "how many walls, or what share of the centre, a wall stands for"),
    ]
    return joined(facts(pairs), tag("p", "A dash stands for what does not exist, such as the parameters of no fit."))
