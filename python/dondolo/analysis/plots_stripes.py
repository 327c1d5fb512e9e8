"""Figures of multiple stripe and incremental analyses."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from dondolo._base.shown import span
from dondolo._fortran.records import blank_unit
from dondolo.analysis.certificate import Certified
from dondolo.analysis.incremental import Incremental
from dondolo.analysis.stripes import Stripes
from dondolo.curves.fragility import Fragility
from dondolo.curves.plots import parameters
from dondolo.figures import curves, style

if TYPE_CHECKING:
    from matplotlib.axes import Axes


def draw_stripes(stripes: Stripes, ax: Axes | None) -> Axes:
    """Draw EDP against intensity, collapses set apart above."""
    ax = style.axes(ax)
    levels, edp, collapsed = stripes.levels, np.asarray(stripes.edp), np.asarray(stripes.collapsed)
    survives = stripes.ran & ~collapsed
    x = np.broadcast_to(levels[:, None], edp.shape)
    limit = stripes.edp_limit
    _draw_bounds(stripes, ax)
    ax.plot(
        x[survives],
        edp[survives],
        linestyle="none",
        marker="o",
        markersize=4,
        markerfacecolor="none",
        markeredgecolor=style.BLUE,
        markeredgewidth=0.8,
        label="survives" if survives.any() else None,
    )
    row = 1.1 * limit
    reached = collapsed.any(axis=1)
    ax.plot(
        levels[reached],
        np.full(reached.sum(), row),
        linestyle="none",
        marker="^",
        markersize=7,
        color=style.RED,
        label=f"collapses (of {span(stripes.histories)})" if reached.any() else None,
    )
    for level, count in zip(levels[reached], collapsed.sum(axis=1)[reached], strict=True):
        ax.annotate(
            str(count), (level, row), (0, 6), textcoords="offset points", ha="center", fontsize=7.5, color=style.RED
        )
    ax.axhline(limit, color=style.BLACK, linewidth=0.9, linestyle="--", label="collapse limit")
    ax.set_ylim(0.0, 1.25 * limit)
    ax.set_xlim(0.0, 1.05 * levels.max())
    ax.set_xlabel(style.im_label(stripes.im))
    ax.set_ylabel("EDP = largest rotation / capacity")
    style.title(ax, stripes.wall.name)
    if stripes.status is None:
        style.legend(ax, loc="upper left", bbox_to_anchor=(0.0, 0.8))
    else:
        # Bounds may run through the whole figure.
        style.legend(ax, loc="upper center", bbox_to_anchor=(0.5, -0.14), ncols=2)
    return ax


def _draw_bounds(stripes: Stripes, ax: Axes) -> None:
    """Of certified stripes: EDPs between which the last digit of the input decides, and what they make of theta."""
    if stripes.status is None or stripes.edp_lowest is None or stripes.edp_highest is None:
        return
    rows, columns = np.nonzero(stripes.status == Certified.NOT_COMPUTABLE)
    if len(rows):
        lowest, highest = stripes.edp_lowest[rows, columns], stripes.edp_highest[rows, columns]
        ax.vlines(stripes.levels[rows], lowest, highest, color=style.PURPLE, linewidth=2.0, zorder=1)
        text = f"not computable ({len(rows)}): between these"
        ax.plot(stripes.levels[rows], highest, "_", color=style.PURPLE, markersize=7, label=text)
        ax.plot(stripes.levels[rows], lowest, "_", color=style.PURPLE, markersize=7)
    low, high = stripes.theta_bounds
    if np.isfinite([low, high]).all():
        unit = blank_unit(stripes.im)
        text = f"certified: θ = {low:.5g}{unit}" if low == high else f"certified: θ from {low:.5g} to {high:.5g}{unit}"
        ax.axvspan(low, high, color=style.PURPLE, alpha=0.35, linewidth=1.0, label=text, zorder=0)


def draw_damage_states(stripes: Stripes, ax: Axes | None, fits: Sequence[Fragility]) -> Axes:
    """Draw the fitted curve of each damage state, collapse the boldest."""
    states = {float(fit.edp_threshold or 0.0): fit for fit in fits}
    ax = curves.axes(ax, len(states) + 1)
    grid = curves.grid(stripes.levels)
    for threshold, look, marks in curves.state_looks(list(states)):
        curve = states[threshold]
        text = f"EDP ≥ {threshold:g}: {parameters(curve)}"
        ax.plot(stripes.levels, curve.collapses / curve.histories, **marks, label=None if curve.has_fit else text)
        if curve.has_fit:
            ax.plot(grid, curve(grid), **look, label=text)
    return curves.finish(ax, stripes.im, grid, stripes.wall.name, "probability to reach the state")


def draw_incremental(incremental: Incremental, ax: Axes | None) -> Axes:
    """Draw a line for each history, and the fractiles, bold."""
    ax = style.axes(ax, (6.0, 5.0))
    stripes, levels = incremental.stripes, incremental.levels
    edge = 1.2 * stripes.edp_limit
    first = incremental.first_collapse
    for i in range(len(first)):
        before = levels < first[i]
        x, y = _until_collapse(stripes.edp[before, i], levels[before], first[i], edge)
        ax.plot(x, y, color=style.GREY, linewidth=0.6, alpha=0.8)
    ax.plot([], [], color=style.GREY, linewidth=0.6, label=f"{len(first)} histories")
    again = ~stripes.collapsed & (levels[:, None] > first)
    if again.any():
        ax.plot(
            stripes.edp[again],
            np.broadcast_to(levels[:, None], again.shape)[again],
            linestyle="none",
            marker="o",
            markersize=3,
            markerfacecolor="white",
            markeredgecolor=style.RED,
            label=f"survive above their first collapse ({incremental.resurrected.sum()} histories)",
        )
    for edp, (text, line) in zip(incremental.edp_fractiles, (("16", "--"), ("50", "-"), ("84", "-.")), strict=True):
        gone = np.isinf(edp)
        end = levels[np.argmax(gone)] if gone.any() else np.inf
        x, y = _until_collapse(edp[levels < end], levels[levels < end], end, edge)
        ax.plot(x, y, color=style.BLUE, linewidth=2.4, linestyle=line, label=f"{text} % fractile of the EDP")
    ax.axvline(stripes.edp_limit, color=style.BLACK, linewidth=0.9, linestyle=":", label="collapse limit")
    ax.set_xlim(0.0, edge)
    ax.set_ylim(0.0, 1.05 * levels[-1])
    ax.set_xlabel("EDP = largest rotation / capacity")
    ax.set_ylabel(style.im_label(stripes.im))
    style.title(ax, stripes.wall.name)
    style.legend(ax, loc="upper center", bbox_to_anchor=(0.5, -0.14), ncols=2, handlelength=3.2)
    return ax


def _until_collapse(edp: Any, levels: Any, collapse: float, edge: float) -> tuple[Any, Any]:
    """A curve from the origin; from the last survival it runs flat, at the level of the collapse, to the edge."""
    x, y = np.append(0.0, edp), np.append(0.0, levels)
    if np.isfinite(collapse):
        x, y = np.append(x, [x[-1], edge]), np.append(y, [collapse, collapse])
    return x, y
