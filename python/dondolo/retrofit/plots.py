"""Figure of designs that are compared."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

import numpy as np

from dondolo.figures import curves, style
from dondolo.figures.options import Options
from dondolo.figures.themes import theme
from dondolo.figures.wording import decimal, say

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from dondolo.retrofit.designs import DesignComparison


def draw_designs(found: DesignComparison, ax: Iterable[Any] | None, given: dict[str, Any]) -> Axes:
    """Draw the curves of all designs, and the ratios of their medians to that of the first."""
    import matplotlib.pyplot as plt

    options = Options(given, "bars", "points")
    left, right = style.panels(ax, 1, (9.5, 3.8), columns=2)
    colors = plt.get_cmap("viridis")(np.linspace(0.0, 0.85, len(found.names)))
    levels = np.concatenate([curve.levels for curve in found.curves])
    grid = curves.grid(np.unique(levels))
    rows = len(found.names) - 1 - np.arange(len(found.names))
    for i, (name, curve, color) in enumerate(zip(found.names, found.curves, colors, strict=True)):
        if curve.has_fit:
            dashes = style.LINES[i % len(style.LINES)]
            left.plot(grid, curve(grid), **options.look(color=color, linestyle=dashes, label=style.label(name)))
        share = curve.collapses / curve.histories
        if options.points:
            look = {"marker": style.MARKERS[i % len(style.MARKERS)], "markersize": 3, "color": color}
            left.plot(curve.levels, share, linestyle="none", **look)
    if found.im == "pga":
        for i, (check, curve, color) in enumerate(zip(found.checks, found.curves, colors, strict=False)):
            stood = check.capacities["nonlinear", "SLV"]
            at = float(curve(stood)) if curve.has_fit else 0.0
            label = say("withstands by the nonlinear check, SLV") if i == 0 else None
            left.plot(stood, at, linestyle="none", marker="v", markersize=7, color=color, label=label, zorder=4)
    curves.finish(left, options, found.im, grid[-1], "")

    low, high = found.ratio_interval.T
    shown = np.isfinite(found.ratio)
    right.axvline(1.0, color=style.GREY, linewidth=0.8, zorder=0)
    right.errorbar(
        found.ratio[shown],
        rows[shown],
        xerr=[(found.ratio - low)[shown], (high - found.ratio)[shown]] if options.bars else None,
        linestyle="none",
        marker="o",
        markersize=5,
        color=style.BLACK,
        capsize=3,
        label=say("median of the records, {share:.4g} % intervals", share=100.0 * found.confidence),
    )
    right.plot(
        found.static_ratio,
        rows,
        linestyle="none",
        marker="D",
        markersize=6,
        markerfacecolor="none",
        color=style.RED,
        label=say("by forces: static acceleration, ties at yield"),
    )
    known = [*found.static_ratio, *high[shown], 1.0]
    limit = 1.15 * float(max(known))
    for row, ratio, least, most in zip(rows[1:], found.ratio[1:], low[1:], high[1:], strict=True):
        if np.isfinite(ratio):
            # Above the interval, and within the axes
            at, side = (least, "left") if least < 0.5 * limit else (most, "right")
            factor = say("\u00d7 {ratio:.2f} ({least:.2f} to {most:.2f})", ratio=ratio, least=least, most=most)
            right.annotate(
                factor, (at, row), (0, 6), textcoords="offset points", ha=side, va="bottom", fontsize=theme().note
            )
    for row, ratio in zip(rows[1:], found.static_ratio[1:], strict=True):
        factor = decimal(f"\u00d7 {ratio:.2f}")
        right.annotate(
            factor,
            (ratio, row),
            (0, -6),
            textcoords="offset points",
            ha="center" if ratio < 0.85 * limit else "right",
            va="top",
            color=style.RED,
            fontsize=theme().note,
        )
    names = [
        style.in_lines(
            say("{name}\n{mass:.3g} kg/m of steel", name=name, mass=mass) if np.isfinite(mass) and mass > 0.0 else name,
            right,
            0.4,
        )
        for name, mass in zip(found.names, found.steel, strict=True)
    ]
    right.set_yticks(rows, names, parse_math=False)
    right.grid(visible=False, axis="y")
    right.set_ylim(-0.6, len(found.names) - 0.4)
    right.set_xlim(0.0, limit)
    right.set_xlabel(style.in_lines(say("ratio to '{first}'", first=found.names[0]), right, 0.6), parse_math=False)
    style.legend(right, options)
    first: Axes = left
    return first
