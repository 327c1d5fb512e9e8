"""Figure of a check: its lines on a fragility curve."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from dondolo.curves.fragility import Fragility
from dondolo.figures import curves, style
from dondolo.figures.options import Options

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from dondolo.checks.ntc import CodeCheck


def draw_check(check: CodeCheck, curve: Fragility, ax: Axes | None, given: dict[str, Any]) -> Axes:
    """Draw a curve, the peak acceleration of the site, and what the wall withstands by each formula."""
    options = Options(given, "band", "bars", "points")
    chances = check.probabilities(curve)
    ax = curve.plot(curves.axes(ax), **given | {"legend": False})
    right = max(ax.get_xlim()[1], 1.05 * max(check.pga, *check.capacities.values()))
    for i, ((method, state), chance) in enumerate(chances.items()):
        level = check.value(method, state, "pga" if method == "site" else "capacity_pga")
        name = f"a_g S of the site {state}".strip() + ":" if method == "site" else f"{method} {state} withstands"
        look = (
            {"color": style.BLACK, "linewidth": 1.8}
            if method == "site"
            else {
                "color": style.RED if method == "nonlinear" else style.GREY,
                "linewidth": 1.2,
                "linestyle": style.LINES[i % len(style.LINES)],
            }
        )
        ax.axvline(level, label=f"{name} {level:.3g} g, P = {chance:.2g}", zorder=1, **look)
        ax.plot(level, chance, marker="x", markersize=6, color=look["color"], zorder=4)
    ax.set_xlim(0.0, right)
    style.legend(ax, options)
    return ax
