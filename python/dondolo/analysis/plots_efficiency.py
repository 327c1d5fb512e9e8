"""Figure of intensity measures that are compared."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

import numpy as np

from dondolo._fortran.records import describe_measure
from dondolo.analysis.efficiency import IntensityComparison
from dondolo.figures import style
from dondolo.figures.curves import POINTS

if TYPE_CHECKING:
    from matplotlib.axes import Axes


def draw_comparison(comparison: IntensityComparison, ax: Iterable[Axes] | None) -> style.Panels:
    """Draw the curves of all measures on one scale, and their dispersions."""
    import matplotlib.pyplot as plt

    axes = left, right = style.panels(ax, 1, (9.0, 4.0), columns=2)
    order = np.argsort(comparison.ratio)
    colors = plt.get_cmap("viridis")(np.linspace(0.0, 0.9, len(order)))
    grid = np.geomspace(0.2, 5.0, POINTS)
    for row, (i, color) in enumerate(zip(order, colors, strict=True)):
        curve = comparison.curves[i]
        power = describe_measure(curve.im).power
        left.plot(
            grid,
            curve(grid**power * curve.theta),
            color=color,
            linestyle=("-", "--", "-.", ":")[row % 4],
            label=curve.im,
        )
        left.plot(
            (curve.levels / curve.theta) ** (1.0 / power),
            curve.collapses / curve.histories,
            linestyle="none",
            marker="o",
            markersize=3,
            color=color,
        )
        width = None
        if curve.has_errors:
            low, high = (end / power for end in curve.parameter_interval()["beta"])
            width = [[comparison.dispersion[i] - low], [high - comparison.dispersion[i]]]
        right.errorbar(
            [comparison.dispersion[i]],
            [row],
            xerr=width,
            color=color,
            marker="o",
            markersize=5,
            capsize=3,
        )
    left.set_xscale("log")
    left.set_xlim(0.2, 5.0)
    left.set_xticks([0.2, 0.5, 1.0, 2.0, 5.0], ["0.2", "0.5", "1", "2", "5"])
    left.set_xticks([], minor=True)
    left.set_xlabel("scale factor / its median")
    left.set_ylabel("probability of collapse")
    style.title(left, comparison.stripes[0].wall.name)
    style.legend(left, loc="upper left")
    right.set_yticks(range(len(order)), [comparison.ims[i] for i in order])
    right.invert_yaxis()
    right.set_xlim(left=0.0)
    right.set_xlabel("dispersion of the scale factor, 95 % interval")
    return axes
