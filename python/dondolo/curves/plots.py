"""Figure of a fragility curve."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from dondolo._base.arguments import tails
from dondolo._fortran.records import blank_unit
from dondolo.curves.curve import Curve
from dondolo.curves.fragility import Fragility
from dondolo.figures import curves, style
from dondolo.figures.options import Options
from dondolo.figures.wording import say

if TYPE_CHECKING:
    from matplotlib.axes import Axes


def draw_fragility(
    fragility: Fragility, ax: Axes | None, confidence: float, label: str | None, given: dict[str, Any]
) -> Axes:
    """Draw a curve with its confidence band, and the fractions of collapse with Clopper and Pearson's intervals."""
    tails(confidence)
    options = Options(given, "band", "bars", "points")
    ax = curves.axes(ax)
    # The only curve of its axes needs no name.
    is_alone = label is None and not style.mains(ax)
    wall = fragility.wall
    look = style.apart(ax, options, style.BLUE if wall is None else style.mechanism_look(wall.mechanism)["color"])
    marker, line = look.pop("marker"), options.look(**look)
    line = {name: value for name, value in line.items() if not name.startswith("marker")}
    shown = np.asarray(fragility.levels, dtype=float)[np.asarray(fragility.histories) > 0]
    if len(shown) and options.points:
        mark = {"marker": marker, "color": style.BLACK if is_alone else look["color"]}
        _draw_fractions(fragility, ax, confidence, options, is_alone, mark)
    grid = curves.grid(shown if len(shown) else fragility.theta * np.exp(3.0 * fragility.beta))
    if fragility.has_fit:
        if fragility.has_errors and options.band:
            band = np.asarray(fragility.interval(grid, confidence=confidence))
            text = _of_band(fragility, confidence) if is_alone else None
            ax.fill_between(grid, band[0], band[1], color=look["color"], alpha=0.2, linewidth=0.0, label=text)
        unit = blank_unit(fragility.im)
        text = label or say(
            "θ = {theta:.3g}{unit}, β = {beta:.3g}", theta=fragility.theta, unit=unit, beta=fragility.beta
        )
        style.main(ax, ax.plot(grid, fragility(grid), **line | {"label": text})[0])
    elif fragility.bracket[0] < fragility.bracket[1]:
        ax.axvspan(
            fragility.bracket[0],
            min(fragility.bracket[1], grid[-1]),
            color=style.LIGHT,
            alpha=0.6,
            linewidth=0.0,
            label=say("median somewhere here ({status})", status=fragility.status),
            zorder=0,
        )
    # Where several curves share the axes
    if not is_alone and len(shown) and options.points and options.bars:
        style.note(ax, _of_bars(confidence))
    if not is_alone and fragility.has_errors and options.band:
        style.note(ax, _of_band(fragility, confidence))
    return curves.finish(ax, options, fragility.im, grid[-1], wall.name if wall is not None and is_alone else "")


def _draw_fractions(
    fragility: Fragility, ax: Axes, confidence: float, options: Options, is_alone: bool, mark: dict[str, Any]
) -> None:
    """The fractions of collapse, with their exact intervals."""
    # The quantile of the beta distribution; scipy.stats, which has it too, takes longer to import than a figure to draw
    from scipy.special import betaincinv

    lower, upper = tails(confidence)
    x, z, n = (np.asarray(part, dtype=float) for part in (fragility.levels, fragility.collapses, fragility.histories))
    counted = n > 0.0
    x, z, n = x[counted], z[counted], n[counted]
    low = np.where(z > 0.0, betaincinv(z, n - z + 1.0, lower), 0.0)
    high = np.where(z < n, betaincinv(z + 1.0, n - z, upper), 1.0)
    # Counts are those of the walls that can collapse, the curve is that of all.
    fraction, low, high = (fragility.upper_asymptote * part for part in (z / n, low, high))
    ax.errorbar(
        x,
        fraction,
        (fraction - low, high - fraction) if options.bars else None,
        linestyle="none",
        markersize=4.5,
        elinewidth=0.8,
        capsize=2,
        label=(
            (say("fractions; {bars}", bars=_of_bars(confidence)) if options.bars else say("fractions"))
            if is_alone
            else None
        ),
        zorder=3,
        **mark,
    )


def draw_any(curve: Curve, ax: Axes | None, label: str | None, given: dict[str, Any], color: str = style.BLUE) -> Axes:
    """Draw a curve from 0, with all its corners, and marks where it knows the probability."""
    options = Options(given, "points")
    ax = curves.axes(ax)
    grid, marked = curves.grid(curve._drawn_to), curve._marked
    # Just above a limit a curve may jump.
    corners = [one for corner in curve._corners for one in (corner, np.nextafter(corner, np.inf))]
    x = np.unique(np.concatenate([grid, [one for one in corners if one <= grid[-1]]]))
    look = style.apart(ax, options, color)
    marker = look.pop("marker")
    line = {name: value for name, value in options.look(**look).items() if not name.startswith("marker")}
    style.main(ax, ax.plot(x, curve(x), **line | {"label": label})[0])
    if len(marked) and options.points:
        ax.plot(marked, curve(marked), color=look["color"], linestyle="none", marker=marker, markersize=3)
    return curves.finish(ax, options, curve.im, float(x[-1]), "", say("probability"))


def _of_bars(confidence: float) -> str:
    """What the bars are: another statistic than the band."""
    return say("bars: {share:.4g} % of one stripe, exact binomial", share=100.0 * confidence)


def _of_band(fragility: Fragility, confidence: float) -> str:
    """What the band is, by the standard errors of the curve."""
    kinds = say(" and ").join(say(part.kind) for part in fragility.parts) or say("records")
    if fragility.errors == "clustered":
        return say("band: {share:.4g} % of the curve, clustered by {kinds}", share=100.0 * confidence, kinds=kinds)
    return say("band: {share:.4g} % of the curve, histories independent", share=100.0 * confidence)


def parameters(fit: Fragility) -> str:
    """Median and dispersion for a legend."""
    if not fit.has_fit:
        return say("no fit ({status})", status=say(fit.status.replace("_", " ")))
    unit = blank_unit(fit.im)
    times = say(", times {share:.2g}", share=fit.upper_asymptote) if fit.upper_asymptote < 1.0 else ""
    return say("θ = {theta:.3g}{unit}, β = {beta:.3g}", theta=fit.theta, unit=unit, beta=fit.beta) + times
