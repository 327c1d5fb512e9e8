"""Figure of a cloud analysis."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from dondolo.analysis.cloud import Cloud
from dondolo.figures import style

if TYPE_CHECKING:
    from matplotlib.axes import Axes

# Points of a curve; enough for a smooth line
_POINTS = 401


def draw_cloud(cloud: Cloud, ax: Axes | None) -> Axes:
    """Draw the points, the line fitted to those that rock, and the probability of collapse."""
    ax = style.axes(ax, (6.4, 4.4))
    x, limit, line = cloud.intensity, cloud.edp_limit, cloud.regression
    rocks = ~cloud.collapsed & (cloud.edp > 0.0)
    still = cloud.edp == 0.0
    bottom = 0.3 * (cloud.edp[rocks].min() if rocks.any() else 0.1 * limit)
    marks = (
        (rocks, cloud.edp, "o", style.BLUE, "rocks"),
        (cloud.collapsed, np.full(len(x), 1.5 * limit), "^", style.RED, "collapses"),
        (still, np.full(len(x), 1.4 * bottom), "s", style.GREY, "does not move"),
    )
    for which, height, marker, color, text in marks:
        if which.any():
            ax.plot(
                x[which],
                height[which],
                linestyle="none",
                marker=marker,
                markersize=4.5,
                markerfacecolor="none",
                markeredgecolor=color,
                label=f"{text} ({which.sum()})",
            )
    grid = np.geomspace(0.9 * x.min(), 1.1 * x.max(), _POINTS)
    if line.status == "ok":
        median = np.exp(line.intercept + line.slope * np.log(grid))
        text = f"median: slope {line.slope:.3g}, dispersion {line.sigma:.3g}"
        ax.plot(grid, median, color=style.BLUE, linewidth=2.0, label=text)
        for sign in (-1.0, 1.0):
            ax.plot(
                grid,
                median * np.exp(sign * line.sigma),
                color=style.BLUE,
                linewidth=0.9,
                linestyle="--",
                label="16 and 84 %" if sign > 0.0 else None,
            )
    ax.axhline(limit, color=style.BLACK, linewidth=0.9, linestyle=":", label="collapse limit")
    ax.set_xscale("log")
    ax.set_yscale("log")
    style.plain_ticks(ax.xaxis)
    style.plain_ticks(ax.yaxis)
    ax.set_xlim(grid[0], grid[-1])
    ax.set_ylim(bottom, 2.2 * limit)
    ax.set_xlabel(style.im_label(cloud.im))
    ax.set_ylabel("EDP = largest rotation / capacity")
    style.title(ax, cloud.wall.name)
    if cloud.collapse.status in ("ok", "separated"):
        right = ax.twinx()
        right.plot(grid, cloud.collapse(grid), color=style.RED, linewidth=1.6)
        right.set_ylim(-0.02, 1.02)
        right.set_ylabel("probability of collapse", color=style.RED)
        right.grid(False)
        ax.plot([], [], color=style.RED, linewidth=1.6, label="collapse (right axis)")
    style.legend(ax, loc="upper center", bbox_to_anchor=(0.5, -0.16), ncols=3)
    return ax
