"""Figures of populations."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from dondolo._base.arguments import FloatArray, argument_error, as_array
from dondolo.curves.plots import parameters
from dondolo.figures import curves, style
from dondolo.figures.options import Options
from dondolo.figures.wording import decimal, in_words_of_figures, say
from dondolo.populations.curve import PopulationCurve
from dondolo.populations.typology import Typology

if TYPE_CHECKING:
    from matplotlib.axes import Axes

# Most walls that are drawn one by one: more would be an area, which the band is
_THIN = 60
# Ends and middle of the band of the walls
_FRACTILES = np.array([0.16, 0.5, 0.84])
# A lognormal beside the mean that it is fitted to: thin, and dashed so that the mean is seen where they are the same
_FITTED: dict[str, Any] = {"linewidth": 0.8, "linestyle": (0, (4, 4))}
_THICK = 2.4
# Lognormals beside several means, which have dashes themselves
_THIN_LINE = 0.6


def draw_curve(curve: PopulationCurve, ax: Axes | None, given: dict[str, Any]) -> Axes:
    """Draw the curves of the walls, thin, with their weighted mean and fractiles."""
    options = Options(given, "band", "points")
    ax = curves.axes(ax)
    grid = curves.grid(curve.levels)
    # In one call, which evaluates the curves of the walls once
    mean, fractiles, probabilities = curve._at(grid, _FRACTILES, members=True)
    walls = len(probabilities)
    look = style.apart(ax, options, style.RED)
    look.pop("marker")
    if options.band:
        drawn = np.unique(np.linspace(0, walls - 1, _THIN).round().astype(int))
        curves.thin(ax, grid, probabilities[drawn], 0.5, 0.6 if len(drawn) > 20 else 1.0)
        text = (
            say("{drawn} of {walls} walls", drawn=len(drawn), walls=walls)
            if len(drawn) < walls
            else style.counted_walls(walls)
        )
        ax.plot([], [], color=style.GREY, linewidth=0.5, label=text)
        _band(ax, grid, fractiles, style.BLUE)
    line = options.look(**look, linewidth=_THICK, label=say("weighted mean"), zorder=4)
    style.main(ax, ax.plot(grid, mean, **line)[0])
    if curve.fit.has_fit:
        fitted = say("lognormal, {words}", words=parameters(curve.fit))
        ax.plot(grid, curve.fit(grid), color=style.BLACK, label=fitted, zorder=5, **_FITTED)
    if options.points:
        _fractions(ax, curve, say("weighted fractions"))
    return curves.finish(ax, options, curve.im, grid[-1], _title(curve))


def _title(curve: PopulationCurve) -> str:
    with in_words_of_figures():
        return curve._title()


def _fractions(ax: Axes, curve: PopulationCurve, label: str) -> None:
    """Weighted fractions of collapse, through which a mean is seen."""
    look: dict[str, Any] = {"markerfacecolor": "none", "markeredgecolor": style.BLACK, "markeredgewidth": 0.7}
    ax.plot(
        curve.levels, curve.mean_fraction, linestyle="none", marker="o", markersize=4, label=label, zorder=6, **look
    )


def draw_combination(typology: Typology, ax: Axes | None, group: str, given: dict[str, Any]) -> Axes:
    """Draw the mean curve of each mechanism, and that of all together with its fractiles."""
    options = Options(given, "band")
    whole = typology["all", group]
    names = [one.mechanism for one in typology.groups if one.group == group and one.mechanism != "all"]
    ax = curves.axes(ax)
    grid = curves.grid(typology.levels)
    if options.band:
        _band(ax, grid, whole.fractiles(grid, _FRACTILES), style.GREY)
    where = say(" where it can occur") if np.any(typology.population.p_occ < 1.0) else ""
    parts = [typology[name, group] for name in names]
    for curve in parts:
        look = options.look(**style.mechanism_look(curve.mechanism), linewidth=1.8, zorder=3)
        _mean(ax, grid, curve, f"{style.mechanism_name(curve.mechanism)}{where}", look)
    look = options.look(**style.mechanism_look("all"), linewidth=_THICK, zorder=4)
    _mean(ax, grid, whole, style.mechanism_name(whole.mechanism), look)
    _explain_fitted(ax, [*parts, whole])
    return curves.finish(
        ax, options, typology.im, grid[-1], say("group {group}", group=group) if group else say("population")
    )


def draw_union(typology: Typology, name: str, ax: Axes | None, given: dict[str, Any]) -> Axes:
    """Draw the curve of each mechanism of a facade, their product, and the union of the same histories."""
    options = Options(given, "points")
    people = typology.population
    rows = [i for i, whole in enumerate(people.wholes) if whole == name]
    # Mechanisms that a facade has once have their own colours; its hinges share that of their mechanism.
    kinds = [people[row].mechanism for row in rows]
    ax = curves.axes(ax)
    grid = curves.grid(typology.levels)
    for i, row in enumerate(rows):
        one = typology.curves[row]
        if not one.has_fit:
            continue
        look = style.mechanism_look(kinds[i])
        if kinds.count(kinds[i]) > 1:
            look["linestyle"] = style.LINES[(i + 1) % len(style.LINES)]
        label = style.label(f"{people[row].name}, {style.mechanism_name(kinds[i])}")
        ax.plot(grid, one(grid), **options.look(**look, linewidth=1.5, label=label))
    union, product = typology.unions[name], typology.combined[name]
    # Of mechanisms that never occur together, the product is the same.
    is_alone = people._has_single_alternatives(name)
    for curve, word, own in (
        (product, say("independent"), {"color": style.BLACK, "linewidth": 1.2, "linestyle": ":"}),
        (union, say("same histories"), style.mechanism_look("all") | {"linewidth": _THICK}),
    ):
        if curve.has_fit and not (is_alone and curve is product):
            ax.plot(grid, curve(grid), **options.look(**own, label=f"{word}: {parameters(curve)}"))
    if options.points:
        fractions = union.upper_asymptote * union.collapses / union.histories
        looks: dict[str, Any] = {"color": style.RED, "linestyle": "none", "marker": "o", "markersize": 4}
        ax.plot(union.levels, fractions, **looks, label=say("fractions of the same histories"))
    return curves.finish(ax, options, typology.im, grid[-1], name)


def draw_groups(typology: Typology, ax: Axes | None, mechanism: str, given: dict[str, Any]) -> Axes:
    """Draw the mean curve of each group beside that of the population."""
    import matplotlib.pyplot as plt

    options = Options(given)
    whole = typology[mechanism]
    names = list(dict.fromkeys(curve.group for curve in typology.groups if curve.group))
    if not names:
        raise argument_error("not_given", "group", ": no wall of this population belongs to a group")
    known = {(curve.group, curve.mechanism) for curve in typology.groups}
    names = [name for name in names if mechanism == "all" or (name, mechanism) in known]
    parts = [typology[mechanism, name] for name in names]
    ax = curves.axes(ax)
    grid = curves.grid(typology.levels)
    colors = plt.get_cmap("viridis")(np.linspace(0.0, 0.85, len(names)))
    for i, (curve, color) in enumerate(zip(parts, colors, strict=True)):
        look = options.look(color=color, linestyle=style.LINES[(i + 1) % len(style.LINES)], linewidth=1.8)
        _mean(ax, grid, curve, f"{curve.group} ({style.counted_walls(curve.n_walls)})", look)
    look = options.look(**style.mechanism_look("all"), linewidth=_THICK)
    _mean(ax, grid, whole, say("population ({walls})", walls=style.counted_walls(whole.n_walls)), look)
    _explain_fitted(ax, [*parts, whole])
    return curves.finish(ax, options, typology.im, grid[-1], style.mechanism_name(mechanism))


def draw_damage_states(
    typology: Typology,
    ax: Axes | None,
    edp_thresholds: Sequence[float] | None,
    mechanism: str,
    group: str,
    given: dict[str, Any],
) -> Axes:
    """Draw the mean curve of each damage state, collapse the boldest."""
    options = Options(given, "points")
    chosen = typology.edp_thresholds if edp_thresholds is None else as_array("edp_thresholds", edp_thresholds)
    thresholds = chosen.tolist()
    ax = curves.axes(ax)
    grid = curves.grid(typology.levels)
    if typology.facade and typology.knows_unions and mechanism == "all":
        return _draw_union_states(typology, ax, grid, thresholds, options)
    states: list[PopulationCurve] = []
    for threshold, look, marks in curves.state_looks(thresholds):
        state = typology.at(threshold)[mechanism, group]
        states.append(state)
        _mean(ax, grid, state, decimal(f"EDP ≥ {threshold:g}"), options.look(**look))
        if options.points:
            ax.plot(state.levels, state.mean_fraction, **marks)
    _explain_fitted(ax, states)
    title = _title(typology[mechanism, group])
    return curves.finish(ax, options, typology.im, grid[-1], title, say("probability to reach the state"))


def _draw_union_states(
    typology: Typology, ax: Axes, grid: FloatArray, thresholds: list[float], options: Options
) -> Axes:
    """Draw the curve of one facade in each damage state, in the same histories."""
    name = typology.facade
    for threshold, look, marks in curves.state_looks(thresholds):
        union = typology.at(threshold).unions[name]
        text = say("EDP ≥ {threshold:g}: {words}", threshold=threshold, words=parameters(union))
        if options.points:
            ax.plot(union.levels, union.upper_asymptote * union.collapses / union.histories, **marks)
        shown = union(grid) if union.has_fit else np.full(len(grid), np.nan)
        ax.plot(grid, shown, **options.look(**look, label=text))
    return curves.finish(ax, options, typology.im, grid[-1], name, say("probability to reach the state"))


def _band(ax: Axes, grid: FloatArray, fractiles: FloatArray, color: str) -> None:
    """Fractiles of the walls: a band under the lines in it, with edges, and the median."""
    from matplotlib.colors import to_rgb

    low, median, high = fractiles
    # As light as a fifth of the colour on white, but not seen through
    light = tuple(1.0 - 0.22 * (1.0 - part) for part in to_rgb(color))
    ax.fill_between(grid, low, high, color=light, linewidth=0.0, label=say("16 to 84 % of the walls"), zorder=1.4)
    for edge in (low, high):
        ax.plot(grid, edge, color=color, linewidth=0.7, zorder=2)
    ax.plot(grid, median, color=color, linewidth=1.4, linestyle=":", label=say("median of the walls"), zorder=3)


def _mean(ax: Axes, grid: FloatArray, curve: PopulationCurve, name: str, look: dict[str, Any]) -> None:
    """A mean curve, and thin beside it the lognormal whose parameters its label has."""
    text = style.label(f"{name}: {parameters(curve.fit)}")
    style.main(ax, ax.plot(grid, curve(grid), **{"label": text} | look)[0])
    if curve.fit.has_fit:
        ax.plot(grid, curve.fit(grid), color=look["color"], linewidth=_THIN_LINE, zorder=look.get("zorder"))


def _explain_fitted(ax: Axes, means: Sequence[PopulationCurve]) -> None:
    """What the thin lines beside means are."""
    if any(curve.fit.has_fit for curve in means):
        ax.plot(
            [],
            [],
            color=style.BLACK,
            linewidth=_THIN_LINE,
            label=say("thick: means; thin: lognormals of these θ and β"),
        )
