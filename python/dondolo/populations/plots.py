"""Figures of populations: Matplotlib axes in, axes out, as in dondolo.plots."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from dondolo._fortran import _binding
from dondolo.analysis.stripes import Stripes
from dondolo.errors import InputError
from dondolo.figures import style

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from dondolo.curves.fragility import Fragility
    from dondolo.populations.curve import Group
    from dondolo.populations.typology import Typology

# Points of a curve; enough for a smooth line
_POINTS = 301
# Most walls that are drawn one by one
_THIN = 300
# Width of a lognormal beside the mean that it is fitted to
_FITTED = 0.6
# What tells lines apart in grey
_LINES: tuple[Any, ...] = ("-", "--", "-.", ":", (0, (5, 1, 1, 1, 1, 1)), (0, (8, 2)), (0, (1, 3)))


def plot_typology(typology: Typology, ax: Axes | None = None, mechanism: str | None = None, group: str = "") -> Axes:
    """Draw the curves of a population, thin, with their weighted mean and fractiles.

    Figure 5 of Nale et al.: the red line is the typological curve.

    Parameters
    ----------
    typology : Typology
        Result of `typology`.
    ax : Axes, optional
        Where to draw; a new figure if left out.
    mechanism, group : str, optional
        Only the walls of this mechanism, of this group.

    Returns
    -------
    Axes
        Probability of collapse against intensity.

    Raises
    ------
    InputError
        There are no such walls.
    """
    curve = typology[mechanism or "all", group]
    ax = _axes(ax, 3)
    grid = _grid(typology.levels)
    members = curve.members
    walls = len(members.weights)
    drawn = np.unique(np.linspace(0, walls - 1, _THIN).round().astype(int))
    thin = curve.probabilities(grid)[drawn]
    ax.plot(grid, thin.T, color=style.GREY, linewidth=0.5, alpha=0.5 if len(drawn) > 40 else 1.0, zorder=1)
    text = f"{len(drawn)} of {walls} walls" if len(drawn) < walls else style.counted(walls, "wall")
    ax.plot([], [], color=style.GREY, linewidth=0.5, label=text)
    _band(ax, typology, grid, mechanism, group, style.BLUE)
    mean = curve.mean(grid)
    ax.plot(grid, mean, color=style.RED, linewidth=2.4, label="weighted mean", zorder=4)
    if curve.fit.has_fit:
        fitted = f"lognormal, {_parameters(curve.fit)}"
        ax.plot(grid, curve.fit(grid), color=style.BLACK, linewidth=1.2, linestyle="--", label=fitted, zorder=5)
    ax.plot(
        typology.levels,
        curve.mean_fraction,
        linestyle="none",
        marker="o",
        markersize=4,
        markerfacecolor="white",
        markeredgecolor=style.RED,
        label="weighted fractions",
        zorder=6,
    )
    return _finish(ax, typology, grid, _name(curve, typology))


def plot_combination(typology: Typology, ax: Axes | None = None, group: str = "") -> Axes:
    """Draw the mean curve of each mechanism, and that of all together with its fractiles.

    A thin line beside a mean curve is the lognormal of the parameters told.

    Parameters
    ----------
    typology : Typology
        Result of `typology`.
    ax : Axes, optional
        Where to draw; a new figure if left out.
    group : str, optional
        Only the walls of this group.

    Returns
    -------
    Axes
        Probability of collapse against intensity: of a mechanism, if it can occur; of all, in series, each with its
        probability of occurrence.
    """
    curves = [curve for curve in typology.groups if curve.group == group and curve.mechanism != "all"]
    whole = typology["all", group]
    ax = _axes(ax, len(curves) + 4)
    grid = _grid(typology.levels)
    _band(ax, typology, grid, None, group, style.GREY)
    where = " where it can occur" if np.any(typology.population.p_occ < 1.0) else ""
    for curve, line in zip(curves, _LINES[1:], strict=False):
        look = {"color": style.BLUE, "linestyle": line, "linewidth": 1.8, "zorder": 3}
        _mean(ax, typology, grid, curve, f"{style.mechanism_name(curve.mechanism)}{where}", look)
    look = {"color": style.RED, "linewidth": 2.4, "zorder": 4}
    _mean(ax, typology, grid, whole, style.mechanism_name(whole.mechanism), look)
    _explain_fitted(ax, [*curves, whole])
    return _finish(ax, typology, grid, f"group {group}" if group else "population")


def plot_groups(typology: Typology, mechanism: str | None = None, ax: Axes | None = None) -> Axes:
    """Draw the mean curve of each group beside that of the population.

    A thin line beside a mean curve is the lognormal of the parameters told.

    Parameters
    ----------
    typology : Typology
        Result of `typology`, of a population with groups.
    mechanism : str, optional
        Only the walls of this mechanism; groups without it are left out.
    ax : Axes, optional
        Where to draw; a new figure if left out.

    Returns
    -------
    Axes
        Probability of collapse against intensity.

    Raises
    ------
    InputError
        The population has no groups, or no such mechanism.
    """
    import matplotlib.pyplot as plt

    whole = typology[mechanism or "all"]
    names = list(dict.fromkeys(curve.group for curve in typology.groups if curve.group))
    if not names:
        raise InputError("group: no wall of this population belongs to a group")
    known = {(curve.group, curve.mechanism) for curve in typology.groups}
    names = [name for name in names if mechanism is None or (name, mechanism) in known]
    curves = [typology[mechanism or "all", name] for name in names]
    ax = _axes(ax, len(names) + 2)
    grid = _grid(typology.levels)
    colors = plt.get_cmap("viridis")(np.linspace(0.0, 0.85, len(names)))
    for i, (curve, color) in enumerate(zip(curves, colors, strict=True)):
        look = {"color": color, "linestyle": _LINES[i % len(_LINES)], "linewidth": 1.8}
        _mean(ax, typology, grid, curve, f"{curve.group} ({style.counted(curve.walls, 'wall')})", look)
    look = {"color": style.RED, "linewidth": 2.4}
    _mean(ax, typology, grid, whole, f"population ({style.counted(whole.walls, 'wall')})", look)
    _explain_fitted(ax, [*curves, whole])
    return _finish(ax, typology, grid, style.mechanism_name(mechanism or "all"))


def plot_damage_states(
    states: Typology | Stripes,
    ax: Axes | None = None,
    edp: Sequence[float] | None = None,
    mechanism: str | None = None,
    group: str = "",
) -> Axes:
    """Draw one curve a damage state, collapse the boldest.

    For a population a thin line beside a mean curve is the lognormal of the parameters told.

    Parameters
    ----------
    states : Typology or Stripes
        A population run with `edp_thresholds`, of which the weighted means are drawn; or the stripes of one wall, of
        which the fitted curves are.
    ax : Axes, optional
        Where to draw; a new figure if left out.
    edp : sequence of float, optional
        Rotation / capacity that make the states; all thresholds of a population if left out, for stripes 0.1, 0.4 and
        1 times their `edp_limit`.
    mechanism, group : str, optional
        As for `plot_typology`; not for stripes.

    Returns
    -------
    Axes
        Probability to reach each state against intensity.
    """
    import matplotlib.pyplot as plt

    if edp is None:
        if isinstance(states, Stripes):
            edp = [share * states.edp_limit for share in (0.1, 0.4, 1.0)]
        else:
            edp = list(states.edp_thresholds)
    ax = _axes(ax, len(edp) + 1)
    grid = _grid(states.levels)
    means: list[Group] = []
    looks = zip(sorted(edp), plt.get_cmap("viridis")(np.linspace(0.85, 0.0, len(edp))), strict=True)
    for i, (threshold, color) in enumerate(looks):
        bold = 1.2 + 1.4 * (i + 1) / len(edp)
        look = {"color": color, "linewidth": bold, "linestyle": _LINES[(len(edp) - 1 - i) % len(_LINES)]}
        marks = {"color": color, "linestyle": "none", "marker": "osD^v<>"[i % 7], "markersize": 4}
        if isinstance(states, Stripes):
            curve = states.fit(threshold)
            text = f"EDP ≥ {threshold:g}: {_parameters(curve)}"
            ax.plot(states.levels, curve.collapses / curve.histories, **marks, label=None if curve.has_fit else text)
            if curve.has_fit:
                ax.plot(grid, curve(grid), **look, label=text)
        else:
            state = states.at(threshold)
            one = state[mechanism or "all", group]
            means.append(one)
            _mean(ax, state, grid, one, f"EDP ≥ {threshold:g}", look)
            ax.plot(states.levels, one.mean_fraction, **marks)
    _explain_fitted(ax, means)
    whose = states.wall.name if isinstance(states, Stripes) else _name(states[mechanism or "all", group], states)
    _finish(ax, states, grid, whose)
    ax.set_ylabel("probability to reach the state")
    return ax


def _axes(ax: Axes | None, rows: int) -> Axes:
    """Those given, or axes of a new figure with room for so many rows of a legend below."""
    return style.new_axes(size=(6.0, 3.8 + 0.19 * rows)) if ax is None else ax


def _grid(levels: Any) -> Any:
    """Levels that a curve is drawn at."""
    right = 1.05 * float(np.max(levels))
    return np.linspace(right / _POINTS, right, _POINTS)


def _band(ax: Axes, typology: Typology, grid: Any, mechanism: str | None, group: str, color: str) -> None:
    """Fractiles of the walls: a band with edges, and the median."""
    low, median, high = typology[mechanism or "all", group].fractiles(grid)
    ax.fill_between(grid, low, high, color=color, alpha=0.22, linewidth=0.0, label="16 to 84 % of the walls", zorder=2)
    for edge in (low, high):
        ax.plot(grid, edge, color=color, linewidth=0.7, zorder=2)
    ax.plot(grid, median, color=color, linewidth=1.6, linestyle=":", label="median of the walls", zorder=3)


def _mean(ax: Axes, typology: Typology, grid: Any, curve: Group, name: str, look: dict[str, Any]) -> None:
    """A mean curve, and thin beside it the lognormal whose parameters its label tells."""
    fitted = f"lognormal {_parameters(curve.fit)}" if curve.fit.has_fit else _parameters(curve.fit)
    text = style.label(f"{name}: mean; {fitted}")
    ax.plot(grid, typology[curve.mechanism, curve.group].mean(grid), **look, label=text)
    if curve.fit.has_fit:
        ax.plot(grid, curve.fit(grid), color=look["color"], linewidth=_FITTED, zorder=look.get("zorder"))


def _explain_fitted(ax: Axes, curves: Sequence[Group]) -> None:
    """What the thin lines beside means are."""
    if any(curve.fit.has_fit for curve in curves):
        ax.plot([], [], color=style.BLACK, linewidth=_FITTED, label="thin: lognormals fitted to the mean fractions")


def _finish(ax: Axes, what: Typology | Stripes, grid: Any, title: str) -> Axes:
    """Axes, title and legend."""
    ax.set_xlim(0.0, grid[-1])
    ax.set_ylim(-0.02, 1.02)
    ax.set_xlabel(style.im_label(what.im))
    ax.set_ylabel("probability of collapse")
    ax.set_title(title, loc="left", parse_math=False)
    longest = max(map(len, ax.get_legend_handles_labels()[1]))
    style.legend(ax, loc="upper center", bbox_to_anchor=(0.5, -0.15), ncols=1 if longest > 36 else 2)
    return ax


def _name(curve: Group, typology: Typology) -> str:
    """Mechanism and group of a curve."""
    grouped = any(one.group for one in typology.groups)
    group = f", group {curve.group}" if curve.group else ", population" if grouped else ""
    return style.mechanism_name(curve.mechanism) + group


def _parameters(fit: Fragility) -> str:
    """Median and dispersion for a legend."""
    if not fit.has_fit:
        return f"no fit ({fit.status.replace('_', ' ')})"
    unit = f" {_binding.unit_of(fit.im)}".rstrip()
    times = f", times {fit.saturation:.2g}" if fit.saturation < 1.0 else ""
    return f"θ = {fit.theta:.3g}{unit}, β = {fit.beta:.3g}{times}"
