"""Figures of incremental and cloud analyses: Matplotlib axes in, axes out."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from dondolo.figures import style

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from dondolo.analysis.cloud import Cloud
    from dondolo.analysis.incremental import Incremental

# Points of a curve; enough for a smooth line
_POINTS = 401


def plot_incremental(incremental: Incremental, ax: Axes | None = None) -> Axes:
    """Draw the curves of an incremental dynamic analysis, a line for each history, and their fractiles, bold.

    As Vamvatsikos and Cornell (2002) draw them: a flat line is a collapse. A history that survives a level above its
    first collapse has a circle there.

    Parameters
    ----------
    incremental : Incremental
        Result of `incremental`.
    ax : Axes, optional
        Where to draw; a new figure if left out.

    Returns
    -------
    Axes
        Level of intensity against EDP.
    """
    if ax is None:
        ax = style.new_axes(size=(6.0, 5.0))
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
        ax.plot(x, y, color=style.BLUE, linewidth=2.4, linestyle=line, label=f"{text} % fractile")
    ax.axvline(stripes.edp_limit, color=style.BLACK, linewidth=0.9, linestyle=":", label="collapse limit")
    ax.set_xlim(0.0, edge)
    ax.set_ylim(0.0, 1.05 * levels[-1])
    ax.set_xlabel("EDP = largest rotation / capacity")
    ax.set_ylabel(style.im_label(stripes.im))
    ax.set_title(stripes.wall.name, loc="left", parse_math=False)
    style.legend(ax, loc="upper center", bbox_to_anchor=(0.5, -0.14), ncols=2, handlelength=3.2)
    return ax


def _until_collapse(edp: Any, levels: Any, collapse: float, edge: float) -> tuple[Any, Any]:
    """A curve from the origin; from the last survival it runs flat, at the level of the collapse, to the edge."""
    x, y = np.append(0.0, edp), np.append(0.0, levels)
    if np.isfinite(collapse):
        x, y = np.append(x, [x[-1], edge]), np.append(y, [collapse, collapse])
    return x, y


def plot_cloud(cloud: Cloud, ax: Axes | None = None) -> Axes:
    """Draw the points of a cloud analysis, the line fitted to those that rock, and how likely a collapse is.

    Parameters
    ----------
    cloud : Cloud
        Result of `cloud`.
    ax : Axes, optional
        Where to draw; a new figure if left out.

    Returns
    -------
    Axes
        EDP against intensity, on logarithmic axes. Collapses stand above the limit, walls that do not move at the
        bottom. The probability of collapse has an axis of its own, to the right.
    """
    if ax is None:
        ax = style.new_axes(size=(6.4, 4.4))
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
    ax.set_xlim(grid[0], grid[-1])
    ax.set_ylim(bottom, 2.2 * limit)
    ax.set_xlabel(style.im_label(cloud.im))
    ax.set_ylabel("EDP = largest rotation / capacity")
    ax.set_title(cloud.wall.name, loc="left", parse_math=False)
    if cloud.collapse.status in ("ok", "separated"):
        right = ax.twinx()
        right.plot(grid, cloud.collapse(grid), color=style.RED, linewidth=1.6)
        right.set_ylim(-0.02, 1.02)
        right.set_ylabel("probability of collapse", color=style.RED)
        right.grid(False)
        ax.plot([], [], color=style.RED, linewidth=1.6, label="collapse (right axis)")
    style.legend(ax, loc="upper center", bbox_to_anchor=(0.5, -0.16), ncols=3)
    return ax
