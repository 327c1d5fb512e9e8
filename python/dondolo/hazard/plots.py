"""Figures of hazard curves."""

from __future__ import annotations

import itertools
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from dondolo._base.arguments import FloatArray
from dondolo.figures import style
from dondolo.figures.options import Options
from dondolo.figures.wording import say
from dondolo.hazard.hazard import HazardCurve

if TYPE_CHECKING:
    from matplotlib.axes import Axes

# Of a curve that is drawn
_POINTS = 200


def draw_hazard(hazard: HazardCurve, ax: Axes | None, given: dict[str, Any]) -> Axes:
    """Draw the annual frequencies of exceedance, with return periods at the right."""
    options = Options(given, "points", "band")
    ax = style.axes(ax)
    is_first = not style.mains(ax)
    look = style.apart(ax, options, style.BLACK)
    look.pop("marker")
    low, high = hazard.levels[[0, -1]]
    plot_hazard(ax, hazard, np.geomspace(low, high, _POINTS), options, options.look(**look))
    ax.set_yscale("log")
    style.y_label(ax, say("annual frequency of exceedance [1/year]"))
    if is_first:
        ax.secondary_yaxis("right", functions=(_inverse, _inverse)).set_ylabel(say("return period [years]"))
    else:
        low, high = min(low, ax.get_xlim()[0]), max(high, ax.get_xlim()[1])
    intensity_axis(ax, hazard.im, low, high)
    style.title(ax, "", options)
    style.legend(ax, options)
    return ax


def _inverse(value: ArrayLike) -> ArrayLike:
    """Return periods of frequencies, and the other way round."""
    with np.errstate(divide="ignore"):
        inverse: FloatArray = 1.0 / np.asarray(value, dtype=np.float64)
    return inverse


def plot_hazard(ax: Axes, hazard: HazardCurve, x: FloatArray, options: Options, look: dict[str, Any]) -> None:
    """The mean, its points, and the fractiles; intensities are those at which an endless one is drawn."""
    if not hazard.endless:
        # Its kinks; between them power laws are straight lines on these axes.
        x = hazard.levels
        color = look.get("color", style.BLACK)
        if options.points:
            ax.plot(x, hazard.annual_frequency, linestyle="none", marker="o", markersize=4, color=color)
    label = say("mean") if hazard.fractiles else None
    style.main(ax, ax.plot(x, hazard(x), **{"color": style.BLACK, "label": label} | look)[0])
    if not options.band:
        return
    for (q, fractile), line in zip(hazard._curves().items(), fractile_lines(), strict=False):
        ax.plot(
            fractile.levels,
            fractile.annual_frequency,
            color=style.GREY,
            linestyle=line,
            label=say("fractile {q:g}", q=q),
        )


def fractile_lines() -> Iterator[object]:
    """Lines of fractiles, again from the first if there are more."""
    return itertools.cycle(style.LINES[1:])


def intensity_axis(ax: Axes, im: str, low: float, high: float) -> None:
    """The logarithmic axis of intensities."""
    ax.set_xscale("log")
    ax.set_xlim(low, high)
    ax.set_xlabel(style.im_label(im))
    style.plain_ticks(ax.xaxis)
