"""Figure of a cloud analysis."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from dondolo.analysis.cloud import Cloud
from dondolo.figures import style
from dondolo.figures.options import Options
from dondolo.figures.wording import say

if TYPE_CHECKING:
    from matplotlib.axes import Axes

# Points of a curve; enough for a smooth line
_POINTS = 401


def draw_cloud(cloud: Cloud, ax: Axes | None, given: dict[str, Any]) -> Axes:
    """Draw the points, the line fitted to those that rock, and the probability of collapse."""
    options = Options(given, "band")
    ax = style.axes(ax, (6.4, 4.0))
    others = len(style.mains(ax))
    look = style.apart(ax, options)
    color = look["color"]
    x, limit, line = cloud.intensity, cloud.edp_limit, cloud.regression
    rocks = ~cloud.collapsed & (cloud.edp > 0.0)
    still = cloud.edp == 0.0
    bottom = 0.3 * (cloud.edp[rocks].min() if rocks.any() else 0.1 * limit)
    marks = (
        (rocks, cloud.edp, look["marker"], color, say("rocks")),
        (cloud.collapsed, np.full(len(x), 1.5 * limit), "^", style.RED, say("collapses")),
        (still, np.full(len(x), 1.4 * bottom), "s", style.GREY, say("does not move")),
    )
    for which, height, marker, edge, text in marks:
        if which.any():
            own = options.look(marker=marker, markersize=4.5, markerfacecolor="none", markeredgecolor=edge)
            ax.plot(x[which], height[which], linestyle="none", label=f"{text} ({which.sum()})", **own)
    grid = np.geomspace(0.9 * x.min(), 1.1 * x.max(), _POINTS)
    if line.status == "ok":
        median = np.exp(line.intercept + line.slope * np.log(grid))
        text = say("median: slope {slope:.3g}, dispersion {sigma:.3g}", slope=line.slope, sigma=line.sigma)
        style.main(ax, ax.plot(grid, median, color=color, linestyle=look["linestyle"], linewidth=2.0, label=text)[0])
        for sign in (-1.0, 1.0) if options.band else ():
            ax.plot(
                grid,
                median * np.exp(sign * line.sigma),
                color=color,
                linewidth=0.9,
                linestyle="--",
                label=say("16 and 84 %") if sign > 0.0 else None,
            )
    ax.axhline(limit, color=style.BLACK, linewidth=0.9, linestyle=":", label=say("collapse limit"))
    ax.set_xscale("log")
    ax.set_yscale("log")
    low, high = ax.get_xlim() if others else (np.inf, 0.0)
    ax.set_xlim(min(low, grid[0]), max(high, grid[-1]))
    ax.set_ylim(bottom, 2.2 * limit)
    style.plain_ticks(ax.xaxis)
    style.plain_ticks(ax.yaxis)
    ax.set_xlabel(style.im_label(cloud.im))
    style.y_label(ax, say(style.EDP))
    style.title(ax, cloud.wall.name, options)
    if cloud.collapse.status in ("ok", "separated"):
        right = ax.twinx()
        dashes = style.LINES[(style.LINES.index("-.") + others) % len(style.LINES)]
        right.plot(grid, cloud.collapse(grid), color=style.RED, linewidth=1.6, linestyle=dashes)
        right.set_ylim(-0.02, 1.02)
        style.y_label(right, say("probability of collapse"), color=style.RED)
        right.grid(False)
        ax.plot([], [], color=style.RED, linewidth=1.6, linestyle=dashes, label=say("collapse (right axis)"))
    style.legend(ax, options)
    return ax
