"""Figures of risk: hazard and fragility, what intensities contribute, and how uncertain that is."""

from __future__ import annotations

import itertools
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

import numpy as np

from dondolo._fortran.records import blank_unit
from dondolo.curves.risk import Risk, between, probability
from dondolo.figures import style
from dondolo.figures.options import Options
from dondolo.figures.wording import in_words_of_figures, say
from dondolo.hazard.plots import fractile_lines, intensity_axis, plot_hazard

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from dondolo.curves.risk_uncertainty import RiskUncertainty

# Of the largest contribution, what a figure of bins leaves out
_LEAST = 1e-3


def draw_risk(risk: Risk, ax: Iterable[Axes] | None, given: dict[str, Any]) -> Axes:
    """Draw the hazard, the fragility, and the intensities that the risk comes from."""
    options = Options(given, "points")
    above, middle, below = style.panels(ax, 3, (6.0, 6.0), sharex=True)
    look = style.apart(middle, options)
    line = options.look(color=look["color"], linestyle=look["linestyle"])
    hazard = risk.hazard
    x, density = risk._smooth_density()
    plot_hazard(above, hazard, x, options, {})
    above.set_yscale("log")
    style.y_label(above, say("exceeded\n[1/year]"))
    style.title(
        above,
        say("mean annual frequency of collapse:\n{bounds}", bounds=_between(risk, say("a year"))),
        options,
    )
    style.main(middle, middle.plot(x, probability(risk.fragility, x), **line)[0])
    middle.set_ylim(-0.02, 1.02)
    style.y_label(middle, say("probability\nof collapse"))
    share = density / (risk.inside if risk.inside > 0.0 else 1.0)
    first = not style.mains(below)
    below.fill_between(x, share, color=style.BRICK if first else look["color"], linewidth=0.0, alpha=0.5)
    style.main(below, below.plot(x, share, **{**line, "color": style.RED if first else line["color"]})[0])
    below.set_ylim(bottom=0.0)
    style.y_label(below, say("share of the risk\nper unit of ln IM"))
    intensity_axis(below, hazard.im, x[0], x[-1])
    style.legend(below, options, also=(above, middle))
    top: Axes = above
    return top


def _between(risk: Risk, unit: str) -> str:
    """The bounds of the annual frequency."""
    with in_words_of_figures():
        return between(*risk.bounds, unit, 3)


def draw_deaggregation(risk: Risk, ax: Axes | None, bins: int, given: dict[str, Any]) -> Axes:
    """Draw the shares of bins of intensity, and the intensity that contributes most."""
    from matplotlib.patches import Rectangle

    options = Options(given)
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
        **options.look(Rectangle, facecolor=style.BRICK, edgecolor=style.RED, linewidth=0.8),
    )
    if density.max() > 0.0:
        most = risk.dominant_level
        text = f"{most:.3g}{blank_unit(risk.hazard.im)} contributes most"
        ax.axvline(most, color=style.BLACK, linestyle="--", linewidth=1.0, label=text)
    ax.margins(y=0.08)
    above = 100.0 * risk.above[0] / whole
    beyond = f";\n{above:.2g} % from above the levels" if above >= 0.05 else ""
    style.title(ax, f"{_between(risk, 'collapses a year')}{beyond}", options)
    style.y_label(ax, "share of the frequency [%]")
    intensity_axis(ax, risk.hazard.im, edges[0], edges[-1])
    style.legend(ax, options)
    return ax


def draw_uncertainty(found: RiskUncertainty, ax: Axes | None, confidence: float, given: dict[str, Any]) -> Axes:
    """Draw the distributions of the annual frequency, with estimates and intervals."""
    options = Options(given, "band", "points")
    ax = style.axes(ax, (6.0, 3.8))
    cases = [(found.annual_frequency, found.risk.annual_frequency, "mean hazard")]
    cases += [(found.fractiles[q], found.estimates[q], f"fractile {q:g} of the hazard") for q in found.fractiles]
    for (draws, estimate, name), line in zip(cases, itertools.chain(["-"], fractile_lines()), strict=False):
        seen = np.sort(draws[np.isfinite(draws) & (draws > 0.0)])
        if not len(seen):
            continue
        color = style.BLUE if line == "-" else style.GREY
        share = np.arange(1, len(seen) + 1) / len(draws)
        wide = 1.8 if line == "-" else 1.2
        ax.plot(seen, share, **options.look(color=color, linestyle=line, label=name, linewidth=wide))
        if options.points:
            ax.plot(estimate, np.mean(draws <= estimate), marker="o", color=color, markersize=5)
    low, high = found.interval(confidence=confidence)
    if options.band:
        ax.axvspan(low, min(high, ax.get_xlim()[1]), color=style.BLUE, alpha=0.12, linewidth=0.0, zorder=0)
    ax.set_xscale("log")
    style.plain_ticks(ax.xaxis)
    ax.set_ylim(0.0, 1.0)
    ax.set_xlabel("mean annual frequency of collapse [1/year]")
    style.y_label(ax, "probability of less")
    words = f"{found.risk.annual_frequency:.3g} a year, {100.0 * confidence:.4g} % interval {low:.3g} to {high:.3g}"
    style.title(ax, words, options)
    style.legend(ax, options)
    return ax
