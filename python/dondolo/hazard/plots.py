"""Figures of hazard curves."""

from __future__ import annotations

import itertools
from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from dondolo._base.arguments import FloatArray
from dondolo.figures import curves, style
from dondolo.hazard.hazard import HazardCurve

if TYPE_CHECKING:
    from matplotlib.axes import Axes

# Of a curve that is drawn
_POINTS = 200


def draw_hazard(hazard: HazardCurve, ax: Axes | None) -> Axes:
    """Draw the annual frequencies of exceedance, with return periods at the right."""
    ax = style.axes(ax)
    low, high = hazard.levels[[0, -1]]
    plot_hazard(ax, hazard, np.geomspace(low, high, _POINTS))
    ax.set_yscale("log")
    ax.set_ylabel("annual frequency of exceedance [1/year]")
    periods = ax.secondary_yaxis("right", functions=(_inverse, _inverse))
    periods.set_ylabel("return period [years]")
    intensity_axis(ax, hazard.im, low, high)
    return ax


def _inverse(value: ArrayLike) -> ArrayLike:
    """Return periods of frequencies, and the other way round."""
    with np.errstate(divide="ignore"):
        inverse: FloatArray = 1.0 / np.asarray(value, dtype=np.float64)
    return inverse


def plot_hazard(ax: Axes, hazard: HazardCurve, x: FloatArray) -> None:
    """The mean, its points, and the fractiles; intensities are those at which an endless one is drawn."""
    if not hazard.endless:
        # Its kinks; between them power laws are straight lines on these axes.
        x = hazard.levels
        ax.plot(x, hazard.annual_frequency, linestyle="none", marker="o", markersize=4, color="black")
    ax.plot(x, hazard(x), color=style.BLACK, label="mean" if hazard.fractiles else None)
    for (q, fractile), line in zip(hazard._curves().items(), fractile_lines(), strict=False):
        ax.plot(fractile.levels, fractile.annual_frequency, color=style.GREY, linestyle=line, label=f"fractile {q:g}")
    if hazard.fractiles:
        style.legend(ax, loc="lower left")


def fractile_lines() -> Iterator[object]:
    """Lines of fractiles, again from the first if there are more."""
    return itertools.cycle(curves.LINES[1:])


def intensity_axis(ax: Axes, im: str, low: float, high: float) -> None:
    """The logarithmic axis of intensities."""
    ax.set_xscale("log")
    ax.set_xlim(low, high)
    ax.set_xlabel(style.im_label(im))
    style.plain_ticks(ax.xaxis)
