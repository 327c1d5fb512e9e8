"""Figure of a risk."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

import numpy as np

from dondolo.figures import style
from dondolo.risk.frequency import Risk, between, probability

if TYPE_CHECKING:
    from matplotlib.axes import Axes

# Points of a curve; enough for a smooth line
_POINTS = 401


def draw_risk(risk: Risk, ax: Iterable[Axes] | None) -> style.Panels:
    """Draw the hazard, the fragility, and the intensities that the risk comes from."""
    axes = above, middle, below = style.panels(ax, 3, (6.0, 6.6), sharex=True, height_ratios=(2, 2, 2))
    hazard = risk.hazard
    ends = np.log(hazard.levels[[0, -1]])
    if hazard.endless:
        # Where the risk comes from
        wide = np.linspace(-20.0, 20.0, 4001)
        density = risk.density(np.exp(wide))
        ends = wide[density > 1e-3 * density.max()][[0, -1]] if density.max() > 0.0 else ends
    grid = np.exp(np.linspace(ends[0], ends[1], _POINTS))
    grid[[0, -1]] = np.exp(ends) if hazard.endless else hazard.levels[[0, -1]]
    above.plot(grid, hazard(grid), color=style.BLACK)
    if not hazard.endless:
        above.plot(hazard.levels, hazard.annual_frequency, linestyle="none", marker="o", markersize=4, color="black")
    above.set_yscale("log")
    above.set_ylabel("exceeded\n[1/year]")
    above.set_title(f"mean annual frequency of collapse:\n{between(*risk.bounds, 'a year', 3)}", loc="left")
    middle.plot(grid, probability(risk.fragility, grid), color=style.BLUE)
    middle.set_ylim(-0.02, 1.02)
    middle.set_ylabel("probability\nof collapse")
    share = risk.density(grid) / (risk.inside if risk.inside > 0.0 else 1.0)
    below.fill_between(grid, share, color=style.BRICK, linewidth=0.0)
    below.plot(grid, share, color=style.RED)
    below.set_ylim(bottom=0.0)
    below.set_ylabel("share of the risk\na unit of ln IM")
    below.set_xscale("log")
    below.set_xlim(grid[0], grid[-1])
    below.set_xlabel(style.im_label(hazard.im))
    style.plain_ticks(below.xaxis)
    return axes
