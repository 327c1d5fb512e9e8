"""Figures of populations."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from dondolo._base.arguments import FloatArray, as_array
from dondolo.curves.plots import parameters
from dondolo.errors import InputError
from dondolo.figures import curves, style
from dondolo.populations.curve import PopulationCurve
from dondolo.populations.typology import Typology

if TYPE_CHECKING:
    from matplotlib.axes import Axes

# Most walls that are drawn one by one
_THIN = 300
# Ends and middle of the band of the walls
_FRACTILES = np.array([0.16, 0.5, 0.84])
# Width of a lognormal beside the mean that it is fitted to
_FITTED = 0.6


def draw_curve(curve: PopulationCurve, ax: Axes | None, color: str, linestyle: str) -> Axes:
    """Draw the curves of the walls, thin, with their weighted mean and fractiles."""
    ax = curves.axes(ax, 3)
    grid = curves.grid(curve.levels)
    # In one call, which evaluates the curves of the walls once
    mean, fractiles, probabilities = curve._at(grid, _FRACTILES, members=True)
    walls = len(probabilities)
    drawn = np.unique(np.linspace(0, walls - 1, _THIN).round().astype(int))
    curves.thin(ax, grid, probabilities[drawn], 0.5, 0.5 if len(drawn) > 40 else 1.0)
    text = f"{len(drawn)} of {walls} walls" if len(drawn) < walls else style.counted(walls, "wall")
    ax.plot([], [], color=style.GREY, linewidth=0.5, label=text)
    _band(ax, grid, fractiles, style.BLUE)
    ax.plot(grid, mean, color=color, linestyle=linestyle, linewidth=2.4, label="weighted mean", zorder=4)
    if curve.fit.has_fit:
        fitted = f"lognormal, {parameters(curve.fit)}"
        ax.plot(grid, curve.fit(grid), color=style.BLACK, linewidth=1.2, linestyle="--", label=fitted, zorder=5)
    ax.plot(
        curve.levels,
        curve.mean_fraction,
        linestyle="none",
        marker="o",
        markersize=4,
        markerfacecolor="white",
        markeredgecolor=style.RED,
        label="weighted fractions",
        zorder=6,
    )
    return curves.finish(ax, curve.im, grid, curve._title())


def draw_combination(typology: Typology, ax: Axes | None, group: str) -> Axes:
    """Draw the mean curve of each mechanism, and that of all together with its fractiles."""
    whole = typology["all", group]
    names = [one.mechanism for one in typology.groups if one.group == group and one.mechanism != "all"]
    ax = curves.axes(ax, len(names) + 4)
    grid = curves.grid(typology.levels)
    _band(ax, grid, whole.fractiles(grid, _FRACTILES), style.GREY)
    where = " where it can occur" if np.any(typology.population.p_occ < 1.0) else ""
    parts = [typology[name, group] for name in names]
    for curve, line in zip(parts, curves.LINES[1:], strict=False):
        look = {"color": style.BLUE, "linestyle": line, "linewidth": 1.8, "zorder": 3}
        _mean(ax, grid, curve, f"{style.mechanism_name(curve.mechanism)}{where}", look)
    look = {"color": style.RED, "linewidth": 2.4, "zorder": 4}
    _mean(ax, grid, whole, style.mechanism_name(whole.mechanism), look)
    _explain_fitted(ax, [*parts, whole])
    return curves.finish(ax, typology.im, grid, f"group {group}" if group else "population")


def draw_union(typology: Typology, name: str, ax: Axes | None) -> Axes:
    """Draw the curve of each mechanism of a facade, their product, and the union of the same histories."""
    people = typology.population
    rows = [i for i, whole in enumerate(people.wholes) if whole == name]
    ax = curves.axes(ax, len(rows) + 3)
    grid = curves.grid(typology.levels)
    for i, row in enumerate(rows):
        one = typology.curves[row]
        if not one.has_fit:
            continue
        look = {"color": style.BLUE, "linestyle": curves.LINES[(i + 1) % len(curves.LINES)], "linewidth": 1.5}
        ax.plot(grid, one(grid), label=f"{people[row].name}, {style.mechanism_name(people[row].mechanism)}", **look)
    union, product = typology.unions[name], typology.combined[name]
    # Of mechanisms that never occur together, the product is the same.
    is_alone = people._has_single_alternatives(name)
    for curve, word, color, width in (
        (product, "independent", style.GREY, 1.2),
        (union, "same histories", style.RED, 2.4),
    ):
        if curve.has_fit and not (is_alone and curve is product):
            ax.plot(grid, curve(grid), color=color, linewidth=width, label=f"{word}: {parameters(curve)}")
    fractions = union.saturation * union.collapses / union.histories
    looks: dict[str, Any] = {"color": style.RED, "linestyle": "none", "marker": "o", "markersize": 4}
    ax.plot(union.levels, fractions, **looks, label="fractions of the same histories")
    return curves.finish(ax, typology.im, grid, name)


def draw_groups(typology: Typology, ax: Axes | None, mechanism: str) -> Axes:
    """Draw the mean curve of each group beside that of the population."""
    import matplotlib.pyplot as plt

    whole = typology[mechanism]
    names = list(dict.fromkeys(curve.group for curve in typology.groups if curve.group))
    if not names:
        raise InputError("group: no wall of this population belongs to a group")
    known = {(curve.group, curve.mechanism) for curve in typology.groups}
    names = [name for name in names if mechanism == "all" or (name, mechanism) in known]
    parts = [typology[mechanism, name] for name in names]
    ax = curves.axes(ax, len(names) + 2)
    grid = curves.grid(typology.levels)
    colors = plt.get_cmap("viridis")(np.linspace(0.0, 0.85, len(names)))
    for i, (curve, color) in enumerate(zip(parts, colors, strict=True)):
        look = {"color": color, "linestyle": curves.LINES[i % len(curves.LINES)], "linewidth": 1.8}
        _mean(ax, grid, curve, f"{curve.group} ({style.counted(curve.n_walls, 'wall')})", look)
    look = {"color": style.RED, "linewidth": 2.4}
    _mean(ax, grid, whole, f"population ({style.counted(whole.n_walls, 'wall')})", look)
    _explain_fitted(ax, [*parts, whole])
    return curves.finish(ax, typology.im, grid, style.mechanism_name(mechanism))


def draw_damage_states(
    typology: Typology, ax: Axes | None, edp_thresholds: Sequence[float] | None, mechanism: str, group: str
) -> Axes:
    """Draw the mean curve of each damage state, collapse the boldest."""
    chosen = typology.edp_thresholds if edp_thresholds is None else as_array("edp_thresholds", edp_thresholds)
    thresholds = chosen.tolist()
    ax = curves.axes(ax, len(thresholds) + 1)
    grid = curves.grid(typology.levels)
    if typology.facade and typology.knows_unions and mechanism == "all":
        return _draw_union_states(typology, ax, grid, thresholds)
    states: list[PopulationCurve] = []
    for threshold, look, marks in curves.state_looks(thresholds):
        state = typology.at(threshold)[mechanism, group]
        states.append(state)
        _mean(ax, grid, state, f"EDP ≥ {threshold:g}", look)
        ax.plot(state.levels, state.mean_fraction, **marks)
    _explain_fitted(ax, states)
    title = typology[mechanism, group]._title()
    return curves.finish(ax, typology.im, grid, title, "probability to reach the state")


def _draw_union_states(typology: Typology, ax: Axes, grid: FloatArray, thresholds: list[float]) -> Axes:
    """Draw the curve of one facade in each damage state, in the same histories."""
    name = typology.facade
    for threshold, look, marks in curves.state_looks(thresholds):
        union = typology.at(threshold).unions[name]
        text = style.label(f"EDP ≥ {threshold:g}: {parameters(union)}")
        ax.plot(union.levels, union.saturation * union.collapses / union.histories, **marks)
        ax.plot(grid, union(grid) if union.has_fit else np.full(len(grid), np.nan), **look, label=text)
    return curves.finish(ax, typology.im, grid, name, "probability to reach the state")


def _band(ax: Axes, grid: FloatArray, fractiles: FloatArray, color: str) -> None:
    """Fractiles of the walls: a band with edges, and the median."""
    low, median, high = fractiles
    ax.fill_between(grid, low, high, color=color, alpha=0.22, linewidth=0.0, label="16 to 84 % of the walls", zorder=2)
    for edge in (low, high):
        ax.plot(grid, edge, color=color, linewidth=0.7, zorder=2)
    ax.plot(grid, median, color=color, linewidth=1.6, linestyle=":", label="median of the walls", zorder=3)


def _mean(ax: Axes, grid: FloatArray, curve: PopulationCurve, name: str, look: dict[str, Any]) -> None:
    """A mean curve, and thin beside it the lognormal whose parameters its label tells."""
    fitted = f"lognormal {parameters(curve.fit)}" if curve.fit.has_fit else parameters(curve.fit)
    text = style.label(f"{name}: mean; {fitted}")
    ax.plot(grid, curve(grid), **look, label=text)
    if curve.fit.has_fit:
        ax.plot(grid, curve.fit(grid), color=look["color"], linewidth=_FITTED, zorder=look.get("zorder"))


def _explain_fitted(ax: Axes, means: Sequence[PopulationCurve]) -> None:
    """What the thin lines beside means are."""
    if any(curve.fit.has_fit for curve in means):
        ax.plot([], [], color=style.BLACK, linewidth=_FITTED, label="thin: lognormals fitted to the mean fractions")
