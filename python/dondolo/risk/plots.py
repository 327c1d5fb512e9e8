"""Figures of hazard and risk: hazard and fragility, what intensities contribute, and how uncertain that is."""

from __future__ import annotations

import itertools
from collections.abc import Iterable, Iterator
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from dondolo._base.arguments import FloatArray
from dondolo._fortran.records import blank_unit
from dondolo.figures import curves, style
from dondolo.risk.frequency import Risk, between, probability
from dondolo.risk.hazard import HazardCurve

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from dondolo.risk.uncertainty import RiskUncertainty

# Of a curve that is drawn
_POINTS = 200
# Of the largest contribution, what a figure of bins leaves out
_LEAST = 1e-3


def draw_risk(risk: Risk, ax: Iterable[Axes] | None) -> style.Panels:
    """Draw the hazard, the fragility, and the intensities that the risk comes from."""
    axes = above, middle, below = style.panels(ax, 3, (6.0, 6.6), sharex=True, height_ratios=(2, 2, 2))
    hazard = risk.hazard
    x, density = risk._smooth_density()
    _hazard(above, hazard, x)
    above.set_yscale("log")
    above.set_ylabel("exceeded\n[1/year]")
    above.set_title(f"mean annual frequency of collapse:\n{between(*risk.bounds, 'a year', 3)}", loc="left")
    middle.plot(x, probability(risk.fragility, x), color=style.BLUE)
    middle.set_ylim(-0.02, 1.02)
    middle.set_ylabel("probability\nof collapse")
    share = density / (risk.inside if risk.inside > 0.0 else 1.0)
    below.fill_between(x, share, color=style.BRICK, linewidth=0.0)
    below.plot(x, share, color=style.RED)
    below.set_ylim(bottom=0.0)
    below.set_ylabel("share of the risk\nper unit of ln IM")
    _intensities(below, hazard.im, x[0], x[-1])
    return axes


def draw_hazard(hazard: HazardCurve, ax: Axes | None) -> Axes:
    """Draw the annual frequencies of exceedance, with return periods at the right."""
    ax = style.axes(ax)
    low, high = hazard.levels[[0, -1]]
    _hazard(ax, hazard, np.geomspace(low, high, _POINTS))
    ax.set_yscale("log")
    ax.set_ylabel("annual frequency of exceedance [1/year]")
    periods = ax.secondary_yaxis("right", functions=(_inverse, _inverse))
    periods.set_ylabel("return period [years]")
    _intensities(ax, hazard.im, low, high)
    return ax


def _inverse(value: ArrayLike) -> ArrayLike:
    """Return periods of frequencies, and the other way round."""
    with np.errstate(divide="ignore"):
        inverse: FloatArray = 1.0 / np.asarray(value, dtype=np.float64)
    return inverse


def _hazard(ax: Axes, hazard: HazardCurve, x: FloatArray) -> None:
    """The mean, its points, and the fractiles; intensities are those at which an endless one is drawn."""
    if not hazard.endless:
        # Its kinks; between them power laws are straight lines on these axes.
        x = hazard.levels
        ax.plot(x, hazard.annual_frequency, linestyle="none", marker="o", markersize=4, color="black")
    ax.plot(x, hazard(x), color=style.BLACK, label="mean" if hazard.fractiles else None)
    for (q, fractile), line in zip(hazard._curves().items(), _lines(), strict=False):
        ax.plot(fractile.levels, fractile.annual_frequency, color=style.GREY, linestyle=line, label=f"fractile {q:g}")
    if hazard.fractiles:
        style.legend(ax, loc="lower left")


def draw_deaggregation(risk: Risk, ax: Axes | None, bins: int) -> Axes:
    """Draw the shares of bins of intensity, and the intensity that contributes most."""
    ax = style.axes(ax, (6.0, 3.6))
    x, density = risk._smooth_density()
    whole = risk.annual_frequency if risk.annual_frequency > 0.0 else 1.0
    # Where next to nothing comes from is left out
    seen = x[density > _LEAST * density.max()] if density.max() > 0.0 else x
    edges = np.geomspace(seen[0], seen[-1], bins + 1)
    edges[[0, -1]] = seen[[0, -1]]
    ax.bar(
        edges[:-1],
        100.0 * risk.deaggregate(edges) / whole,
        np.diff(edges),
        align="edge",
        color=style.BRICK,
        edgecolor=style.RED,
        linewidth=0.8,
    )
    if density.max() > 0.0:
        most = risk.dominant_level
        ax.axvline(most, color=style.BLACK, linestyle="--", linewidth=1.0)
        text = f"{most:.3g}{blank_unit(risk.hazard.im)} contributes most"
        ax.annotate(
            text,
            (most, 1.0),
            (-5, -4),
            xycoords=("data", "axes fraction"),
            textcoords="offset points",
            ha="right",
            va="top",
        )
    ax.margins(y=0.12)
    above = 100.0 * risk.above[0] / whole
    beyond = f";\n{above:.2g} % from above the levels" if above >= 0.05 else ""
    ax.set_title(f"{between(*risk.bounds, 'collapses a year', 3)}{beyond}", loc="left")
    ax.set_ylabel("share of the frequency [%]")
    _intensities(ax, risk.hazard.im, edges[0], edges[-1])
    return ax


def draw_uncertainty(found: RiskUncertainty, ax: Axes | None, confidence: float) -> Axes:
    """Draw the distributions of the annual frequency, with estimates and intervals."""
    ax = style.axes(ax, (6.0, 4.0))
    cases = [(found.annual_frequency, found.risk.annual_frequency, "mean hazard")]
    cases += [(found.fractiles[q], found.estimates[q], f"fractile {q:g} of the hazard") for q in found.fractiles]
    for (draws, estimate, name), line in zip(cases, itertools.chain(["-"], _lines()), strict=False):
        seen = np.sort(draws[np.isfinite(draws) & (draws > 0.0)])
        if not len(seen):
            continue
        color = style.BLUE if line == "-" else style.GREY
        share = np.arange(1, len(seen) + 1) / len(draws)
        ax.plot(seen, share, color=color, linestyle=line, label=name, linewidth=1.8 if line == "-" else 1.2)
        ax.plot(estimate, np.mean(draws <= estimate), marker="o", color=color, markersize=5)
    low, high = found.interval(confidence=confidence)
    ax.axvspan(low, min(high, ax.get_xlim()[1]), color=style.BLUE, alpha=0.12, linewidth=0.0, zorder=0)
    ax.set_xscale("log")
    ax.set_ylim(0.0, 1.0)
    ax.set_xlabel("mean annual frequency of collapse [1/year]")
    ax.set_ylabel("probability of less")
    ax.set_title(
        f"{found.risk.annual_frequency:.3g} a year, {100.0 * confidence:.4g} % interval {low:.3g} to {high:.3g}",
        loc="left",
    )
    style.legend(ax, loc="lower right")
    return ax


def _lines() -> Iterator[object]:
    """Lines of fractiles, again from the first if there are more."""
    return itertools.cycle(curves.LINES[1:])


def _intensities(ax: Axes, im: str, low: float, high: float) -> None:
    """The logarithmic axis of intensities."""
    ax.set_xscale("log")
    ax.set_xlim(low, high)
    ax.set_xlabel(style.im_label(im))
    style.plain_ticks(ax.xaxis)
