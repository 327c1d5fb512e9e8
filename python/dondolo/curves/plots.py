"""Figure of a fragility curve."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from dondolo._base.arguments import tails
from dondolo._fortran.records import blank_unit
from dondolo.curves.curve import Curve
from dondolo.curves.fragility import Fragility
from dondolo.figures import curves, style

if TYPE_CHECKING:
    from matplotlib.axes import Axes


def draw_fragility(
    fragility: Fragility, ax: Axes | None, confidence: float, label: str | None, color: str, linestyle: str, marker: str
) -> Axes:
    """Draw a curve with its confidence band, and the fractions of collapse with Clopper and Pearson's intervals."""
    # The quantile of the beta distribution; scipy.stats, which has it too, takes longer to import than a figure to draw
    from scipy.special import betaincinv

    lower, upper = tails(confidence)
    ax = style.axes(ax)
    x, z, n = (np.asarray(part, dtype=float) for part in (fragility.levels, fragility.collapses, fragility.histories))
    counted = n > 0.0
    x, z, n = x[counted], z[counted], n[counted]
    fraction = z / n
    low = np.where(z > 0.0, betaincinv(z, n - z + 1.0, lower), 0.0)
    high = np.where(z < n, betaincinv(z + 1.0, n - z, upper), 1.0)
    # Counts are those of the walls that can collapse, the curve is that of all.
    fraction, low, high = (fragility.saturation * part for part in (fraction, low, high))
    if len(x):
        ax.errorbar(
            x,
            fraction,
            (fraction - low, high - fraction),
            linestyle="none",
            marker=marker,
            markersize=4.5,
            color=style.BLACK if label is None else color,
            elinewidth=0.8,
            capsize=2,
            label=f"fractions; {_of_bars(confidence)}" if label is None else None,
            zorder=3,
        )
    grid = curves.grid(x if len(x) else fragility.theta * np.exp(3.0 * fragility.beta))
    right = grid[-1]
    if fragility.has_fit:
        if fragility.has_errors:
            band = np.asarray(fragility.interval(grid, confidence=confidence))
            text = _of_band(fragility, confidence) if label is None else None
            ax.fill_between(grid, band[0], band[1], color=color, alpha=0.2, linewidth=0.0, label=text)
        unit = blank_unit(fragility.im)
        text = label or f"θ = {fragility.theta:.3g}{unit}, β = {fragility.beta:.3g}"
        ax.plot(grid, fragility(grid), color=color, linestyle=linestyle, label=text)
    elif fragility.bracket[0] < fragility.bracket[1]:
        ax.axvspan(
            fragility.bracket[0],
            min(fragility.bracket[1], right),
            color=style.LIGHT,
            alpha=0.6,
            linewidth=0.0,
            label=f"median somewhere here ({fragility.status})",
            zorder=0,
        )
    ax.set_xlim(0.0, right)
    ax.set_ylim(-0.02, 1.02)
    ax.set_xlabel(style.im_label(fragility.im))
    ax.set_ylabel("probability of collapse")
    if label is not None and len(x):
        # Where several curves share the axes
        style.note(ax, _of_bars(confidence))
    if label is not None and fragility.has_errors:
        style.note(ax, _of_band(fragility, confidence))
    if fragility.wall is not None and label is None:
        style.title(ax, fragility.wall.name)
    style.legend(ax, loc="upper left" if label is None else "lower right")
    return ax


def draw_any(curve: Curve, ax: Axes | None, label: str | None, color: str, linestyle: str) -> Axes:
    """Draw a curve from 0, with all its corners, and marks where it knows the probability."""
    ax = style.axes(ax)
    grid, marked = curves.grid(curve._drawn_to), curve._marked
    # Just above a limit a curve may jump.
    corners = [one for corner in curve._corners for one in (corner, np.nextafter(corner, np.inf))]
    x = np.unique(np.concatenate([grid, [one for one in corners if one <= grid[-1]]]))
    ax.plot(x, curve(x), color=color, linestyle=linestyle, label=label)
    if len(marked):
        ax.plot(marked, curve(marked), color=color, linestyle="none", marker="o", markersize=3)
    ax.set_xlim(0.0, float(x[-1]))
    ax.set_ylim(-0.02, 1.02)
    ax.set_xlabel(style.im_label(curve.im))
    ax.set_ylabel("probability")
    if label is not None:
        style.legend(ax, loc="lower right")
    return ax


def _of_bars(confidence: float) -> str:
    """What the bars are: another statistic than the band."""
    return f"bars: {100.0 * confidence:.4g} % of one stripe, exact binomial"


def _of_band(fragility: Fragility, confidence: float) -> str:
    """What the band is, by the standard errors of the curve."""
    kinds = " and ".join(part.kind for part in fragility.parts) or "records"
    how = f"clustered by {kinds}" if fragility.errors == "clustered" else "histories independent"
    return f"band: {100.0 * confidence:.4g} % of the curve, {how}"


def parameters(fit: Fragility) -> str:
    """Median and dispersion for a legend."""
    if not fit.has_fit:
        return f"no fit ({fit.status.replace('_', ' ')})"
    unit = blank_unit(fit.im)
    times = f", times {fit.saturation:.2g}" if fit.saturation < 1.0 else ""
    return f"θ = {fit.theta:.3g}{unit}, β = {fit.beta:.3g}{times}"
