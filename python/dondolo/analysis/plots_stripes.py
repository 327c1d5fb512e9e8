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
from dondolo.figures.options import Options
from dondolo.figures.wording import say

if TYPE_CHECKING:
    from matplotlib.axes import Axes


# Height of the row of collapses, and the distance of further rows, in parts of the limit
_ROW, _NEXT, _TOP = 1.1, 0.17, 1.25


def draw_stripes(stripes: Stripes, ax: Axes | None, given: dict[str, Any]) -> Axes:
    """Draw EDP against intensity, collapses set apart above."""
    options = Options(given, "counts")
    ax = style.axes(ax)
    others = len(style.mains(ax))
    look = style.apart(ax, options)
    levels, edp, collapsed = stripes.levels, np.asarray(stripes.edp), np.asarray(stripes.collapsed)
    survives = stripes.ran & ~collapsed
    x = np.broadcast_to(levels[:, None], edp.shape)
    limit = stripes.edp_limit
    _draw_bounds(stripes, ax)
    own = {"markersize": 4, "markerfacecolor": "none", "markeredgewidth": 0.8, "label": say("survives")}
    marks = options.look(**own | look) | {"linestyle": "none"}
    (drawn,) = ax.plot(x[survives], edp[survives], **marks if survives.any() else marks | {"label": None})
    style.main(ax, drawn)
    row = (_ROW + _NEXT * others) * limit
    color = look["color"] if others else style.RED
    reached = collapsed.any(axis=1)
    ax.plot(
        levels[reached],
        np.full(reached.sum(), row),
        linestyle="none",
        marker="^",
        markersize=7,
        color=color,
        label=say("collapses (of {histories})", histories=span(stripes.histories)) if reached.any() else None,
    )
    is_new = "collapse limit" not in ax.get_legend_handles_labels()[1]
    ax.axhline(
        limit,
        color=style.BLACK,
        linewidth=0.9,
        linestyle="--",
        label=say("collapse limit") if is_new else None,
        zorder=1,
    )
    ax.set_ylim(0.0, max((_TOP + _NEXT * others) * limit, ax.get_ylim()[1] if others else 0.0))
    ax.set_xlim(0.0, max(1.05 * levels.max(), ax.get_xlim()[1] if others else 0.0))
    if options.counts:
        style.count_texts(ax, levels[reached], row, collapsed.sum(axis=1)[reached], color=color)
    ax.set_xlabel(style.im_label(stripes.im))
    style.y_label(ax, say(style.EDP))
    style.title(ax, stripes.wall.name, options)
    style.legend(ax, options)
    return ax


def _draw_bounds(stripes: Stripes, ax: Axes) -> None:
    """Of certified stripes: EDPs between which the last digit of the input decides, and what they make of theta."""
    if stripes.status is None or stripes.edp_lowest is None or stripes.edp_highest is None:
        return
    rows, columns = np.nonzero(stripes.status == Certified.NOT_COMPUTABLE)
    if len(rows):
        lowest, highest = stripes.edp_lowest[rows, columns], stripes.edp_highest[rows, columns]
        ax.vlines(stripes.levels[rows], lowest, highest, color=style.PURPLE, linewidth=2.0, zorder=1)
        text = say("not computable ({histories}): between these", histories=len(rows))
        ax.plot(stripes.levels[rows], highest, "_", color=style.PURPLE, markersize=7, label=text)
        ax.plot(stripes.levels[rows], lowest, "_", color=style.PURPLE, markersize=7)
    low, high = stripes.theta_bounds
    if np.isfinite([low, high]).all():
        unit = blank_unit(stripes.im)
        text = (
            say("certified: θ = {low:.5g}{unit}", low=low, unit=unit)
            if low == high
            else say("certified: θ from {low:.5g} to {high:.5g}{unit}", low=low, high=high, unit=unit)
        )
        ax.axvspan(low, high, color=style.PURPLE, alpha=0.35, linewidth=1.0, label=text, zorder=0)


def draw_damage_states(stripes: Stripes, ax: Axes | None, fits: Sequence[Fragility], given: dict[str, Any]) -> Axes:
    """Draw the fitted curve of each damage state, collapse the boldest."""
    options = Options(given, "points")
    states = {float(fit.edp_threshold or 0.0): fit for fit in fits}
    ax = curves.axes(ax)
    grid = curves.grid(stripes.levels)
    for threshold, look, marks in curves.state_looks(list(states)):
        curve = states[threshold]
        text = say("EDP ≥ {threshold:g}: {words}", threshold=threshold, words=parameters(curve))
        if options.points or not curve.has_fit:
            ax.plot(stripes.levels, curve.collapses / curve.histories, **marks, label=None if curve.has_fit else text)
        if curve.has_fit:
            ax.plot(grid, curve(grid), **options.look(**look, label=text))
    return curves.finish(ax, options, stripes.im, grid[-1], stripes.wall.name, say("probability to reach the state"))


def draw_incremental(incremental: Incremental, ax: Axes | None, given: dict[str, Any]) -> Axes:
    """Draw a line for each history, and the fractiles, bold."""
    options = Options(given, "points")
    ax = style.axes(ax, (6.0, 4.4))
    others = len(style.mains(ax))
    color = style.apart(ax, options)["color"]
    stripes, levels = incremental.stripes, incremental.levels
    edge = 1.2 * stripes.edp_limit
    first = incremental.first_collapse
    for i in range(len(first)):
        before = levels < first[i]
        x, y = _until_collapse(stripes.edp[before, i], levels[before], first[i], edge)
        ax.plot(x, y, color=style.GREY, linewidth=0.6, alpha=0.8)
    ax.plot([], [], color=style.GREY, linewidth=0.6, label=say("{histories} histories", histories=len(first)))
    again = ~stripes.collapsed & (levels[:, None] > first)
    if again.any() and options.points:
        ax.plot(
            stripes.edp[again],
            np.broadcast_to(levels[:, None], again.shape)[again],
            linestyle="none",
            marker="o",
            markersize=3,
            markerfacecolor="white",
            markeredgecolor=style.RED,
            label=say(
                "survive above their first collapse ({histories} histories)", histories=incremental.resurrected.sum()
            ),
        )
    for edp, (text, line) in zip(incremental.edp_fractiles, (("16", "--"), ("50", "-"), ("84", "-.")), strict=True):
        gone = np.isinf(edp)
        end = levels[np.argmax(gone)] if gone.any() else np.inf
        x, y = _until_collapse(edp[levels < end], levels[levels < end], end, edge)
        look = {
            "color": color,
            "linewidth": 2.4,
            "linestyle": line,
            "label": say("{fractile} % fractile of the EDP", fractile=text),
        }
        (drawn,) = ax.plot(x, y, **options.look(**look))
        if text == "50":
            style.main(ax, drawn)
    ax.axvline(stripes.edp_limit, color=style.BLACK, linewidth=0.9, linestyle=":", label=say("collapse limit"))
    ax.set_xlim(0.0, edge)
    ax.set_ylim(0.0, max(1.05 * levels[-1], ax.get_ylim()[1] if others else 0.0))
    ax.set_xlabel(say(style.EDP))
    style.y_label(ax, style.im_label(stripes.im))
    style.title(ax, stripes.wall.name, options)
    style.legend(ax, options)
    return ax


def _until_collapse(edp: Any, levels: Any, collapse: float, edge: float) -> tuple[Any, Any]:
    """A curve from the origin; from the last survival it runs flat, at the level of the collapse, to the edge."""
    x, y = np.append(0.0, edp), np.append(0.0, levels)
    if np.isfinite(collapse):
        x, y = np.append(x, [x[-1], edge]), np.append(y, [collapse, collapse])
    return x, y
