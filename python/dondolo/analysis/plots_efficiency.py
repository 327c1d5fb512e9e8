"""Figure of intensity measures that are compared."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

import numpy as np

from dondolo._fortran.records import describe_measure
from dondolo.analysis.efficiency import IntensityComparison
from dondolo.figures import style
from dondolo.figures.curves import POINTS
from dondolo.figures.options import Options
from dondolo.figures.wording import decimal, say

if TYPE_CHECKING:
    from matplotlib.axes import Axes


# Measures whose curves have a colour each: the most and the least efficient, and PGA
_SHOWN = (style.BLUE, style.RED, style.BLACK)
# Of the scale factor, as a share of its median
_TICKS = (0.2, 0.5, 1.0, 2.0, 5.0)


def draw_comparison(comparison: IntensityComparison, ax: Iterable[Axes] | None, given: dict[str, Any]) -> Axes:
    """Draw the curves of all measures on one scale, and their dispersions."""
    options = Options(given, "bars", "points")
    left, right = style.panels(ax, 1, (9.0, 3.8), columns=2)
    order = np.argsort(comparison.ratio)
    ims = [comparison.ims[i] for i in order]
    named = list(dict.fromkeys([ims[0], ims[-1], *(["pga"] if "pga" in ims else [])]))
    grid = np.geomspace(0.2, 5.0, POINTS)
    for row, (im, i) in enumerate(zip(ims, order, strict=True)):
        curve = comparison.curves[i]
        power = describe_measure(curve.im).power
        # Ten curves that hardly differ have no ten colours: those between the ends are grey, and named at the right.
        own: dict[str, Any] = {"color": style.GREY, "linewidth": 0.7, "zorder": 1.5}
        mark: dict[str, Any] = {"marker": "."}
        if im in named:
            k = named.index(im)
            own = {"color": _SHOWN[k], "linestyle": style.LINES[k], "linewidth": 1.8, "label": im}
            mark = {"marker": style.MARKERS[k]}
            if options.points:
                x = (curve.levels / curve.theta) ** (1.0 / power)
                share = curve.collapses / curve.histories
                left.plot(x, share, linestyle="none", markersize=3.5, color=own["color"], **mark)
        elif ims.index(im) == next(k for k, one in enumerate(ims) if one not in named):
            own["label"] = say("the others, in the order at the right") if len(ims) - len(named) > 1 else im
        left.plot(grid, curve(grid**power * curve.theta), **options.look(**own))
        width = None
        if curve.has_errors and options.bars:
            low, high = (end / power for end in curve.parameter_interval()["beta"])
            width = [[comparison.dispersion[i] - low], [high - comparison.dispersion[i]]]
        look = {"color": own["color"], "marker": mark["marker"] if im in named else "o", "markersize": 5}
        right.errorbar([comparison.dispersion[i]], [row], xerr=width, capsize=3, **look)
    left.set_xscale("log")
    left.set_xlim(0.2, 5.0)
    left.set_xticks(_TICKS, [decimal(f"{tick:g}") for tick in _TICKS])
    left.set_xticks([], minor=True)
    left.set_xlabel(say("scale factor / its median"))
    style.y_label(left, say("probability of collapse"))
    style.title(left, comparison.stripes[0].wall.name, options)
    style.legend(left, options)
    right.set_yticks(range(len(order)), ims)
    right.invert_yaxis()
    right.set_xlim(left=0.0)
    interval = ",\n" + say("95 % interval") if options.bars else ""
    right.set_xlabel(say("dispersion of the scale factor") + interval)
    first: Axes = left
    return first
