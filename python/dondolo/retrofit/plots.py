"""Figure of designs that are compared."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

import numpy as np

from dondolo.figures import curves, style

if TYPE_CHECKING:
    from dondolo.retrofit.designs import DesignComparison


def draw_designs(found: DesignComparison, ax: Iterable[Any] | None) -> style.Panels:
    """Draw the curves of all designs, and the ratios of their medians to that of the first."""
    import matplotlib.pyplot as plt

    axes = left, right = style.panels(ax, 1, (9.5, 4.6), columns=2)
    colors = plt.get_cmap("viridis")(np.linspace(0.0, 0.85, len(found.names)))
    levels = np.concatenate([curve.levels for curve in found.curves])
    grid = curves.grid(np.unique(levels))
    rows = len(found.names) - 1 - np.arange(len(found.names))
    for i, (name, curve, color) in enumerate(zip(found.names, found.curves, colors, strict=True)):
        look = {"color": color, "linestyle": curves.LINES[i % len(curves.LINES)]}
        if curve.has_fit:
            left.plot(grid, curve(grid), label=name, **look)
        share = curve.collapses / curve.histories
        left.plot(curve.levels, share, linestyle="none", marker="o", markersize=3, color=color)
    if found.im == "pga":
        for i, (check, curve, color) in enumerate(zip(found.checks, found.curves, colors, strict=False)):
            stood = check.capacities["nonlinear", "SLV"]
            at = float(curve(stood)) if curve.has_fit else 0.0
            label = "withstands by the nonlinear check, SLV" if i == 0 else None
            left.plot(stood, at, linestyle="none", marker="v", markersize=7, color=color, label=label, zorder=4)
    left.set_xlim(0.0, grid[-1])
    left.set_ylim(-0.02, 1.02)
    left.set_xlabel(style.im_label(found.im))
    left.set_ylabel("probability of collapse")
    # Below the axes: whatever the curves are, it covers none of them.
    style.legend(left, loc="upper center", bbox_to_anchor=(0.5, -0.18))

    low, high = found.ratio_interval.T
    shown = np.isfinite(found.ratio)
    right.axvline(1.0, color=style.GREY, linewidth=0.8, zorder=0)
    right.errorbar(
        found.ratio[shown],
        rows[shown],
        xerr=[(found.ratio - low)[shown], (high - found.ratio)[shown]],
        linestyle="none",
        marker="o",
        markersize=5,
        color=style.BLACK,
        capsize=3,
        label=f"median of the records, {100.0 * found.confidence:.4g} % intervals",
    )
    right.plot(
        found.static_ratio,
        rows,
        linestyle="none",
        marker="D",
        markersize=6,
        markerfacecolor="none",
        color=style.RED,
        label="by forces: static acceleration, ties at yield",
    )
    known = [*found.static_ratio, *high[shown], 1.0]
    limit = 1.15 * float(max(known))
    for row, ratio, least, most in zip(rows[1:], found.ratio[1:], low[1:], high[1:], strict=True):
        if np.isfinite(ratio):
            # Above the interval, and within the axes
            at, side = (least, "left") if least < 0.5 * limit else (most, "right")
            factor = f"\u00d7 {ratio:.2f} ({least:.2f} to {most:.2f})"
            right.annotate(factor, (at, row), (0, 6), textcoords="offset points", ha=side, va="bottom")
    for row, ratio in zip(rows[1:], found.static_ratio[1:], strict=True):
        factor = f"\u00d7 {ratio:.2f}"
        right.annotate(
            factor, (ratio, row), (0, -7), textcoords="offset points", ha="center", va="top", color=style.RED
        )
    for name, row, mass in zip(found.names, rows, found.steel, strict=True):
        text = f"{name}\n{mass:.3g} kg/m of steel" if np.isfinite(mass) and mass > 0.0 else name
        right.annotate(
            text,
            (0.0, row),
            (-6, 0),
            ("axes fraction", "data"),
            "offset points",
            ha="right",
            va="center",
            parse_math=False,
        )
    right.set_yticks([])
    right.set_ylim(-0.6, len(found.names) - 0.4)
    right.set_xlim(0.0, limit)
    right.set_xlabel(f"ratio to '{found.names[0]}'", parse_math=False)
    style.legend(right, loc="upper center", bbox_to_anchor=(0.5, -0.18))
    return axes
