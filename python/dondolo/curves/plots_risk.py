"""Figures of risk: hazard and fragility, what intensities contribute, and how uncertain that is."""

from __future__ import annotations

import itertools
from collections.abc import Iterable
from typing import TYPE_CHECKING

import numpy as np

from dondolo._fortran.records import blank_unit
from dondolo.curves.risk import Risk, between, probability
from dondolo.figures import style
from dondolo.hazard.plots import fractile_lines, intensity_axis, plot_hazard

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from dondolo.curves.risk_uncertainty import RiskUncertainty

# Of the largest contribution, what a figure of bins leaves out
_LEAST = 1e-3


def draw_risk(risk: Risk, ax: Iterable[Axes] | None) -> style.Panels:
    """Draw the hazard, the fragility, and the intensities that the risk comes from."""
    axes = above, middle, below = style.panels(ax, 3, (6.0, 6.6), sharex=True, height_ratios=(2, 2, 2))
    hazard = risk.hazard
    x, density = risk._smooth_density()
    plot_hazard(above, hazard, x)
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
    intensity_axis(below, hazard.im, x[0], x[-1])
    return axes


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
    intensity_axis(ax, risk.hazard.im, edges[0], edges[-1])
    return ax


def draw_uncertainty(found: RiskUncertainty, ax: Axes | None, confidence: float) -> Axes:
    """Draw the distributions of the annual frequency, with estimates and intervals."""
    ax = style.axes(ax, (6.0, 4.0))
    cases = [(found.annual_frequency, found.risk.annual_frequency, "mean hazard")]
    cases += [(found.fractiles[q], found.estimates[q], f"fractile {q:g} of the hazard") for q in found.fractiles]
    for (draws, estimate, name), line in zip(cases, itertools.chain(["-"], fractile_lines()), strict=False):
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
