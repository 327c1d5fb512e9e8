"""Figures of walls that are not known for certain."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

import numpy as np

from dondolo._fortran.records import blank_unit
from dondolo._fortran.walls import WALL_PROPERTIES
from dondolo.figures import curves, style

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from dondolo.populations.uncertain_wall import UncertainWall
    from dondolo.populations.weakest_hinge import HingeSearch

# Most curves that are drawn one by one
_THIN = 200
_HEIGHT = 0.55
_UNITS = {row.name: row.unit for row in WALL_PROPERTIES}


def draw_uncertain_wall(found: UncertainWall, ax: Iterable[Any] | None) -> style.Panels:
    """Draw the curves of the sample, and what moves the median."""
    axes = left, right = style.panels(ax, 1, (10.5, 4.4), columns=2)
    _draw_curves(found, left)
    _draw_tornado(found, right)
    return axes


def _draw_curves(found: UncertainWall, ax: Any) -> None:
    """The curves of the sample with their mean, and that of the medians with the band of its records."""
    grid = curves.grid(found.typology.levels)
    walls = len(found.sample)
    drawn = np.unique(np.linspace(0, walls - 1, _THIN).round().astype(int))
    curves.thin(ax, grid, found.curve.probabilities(grid)[drawn], 0.4, 0.4)
    ax.plot([], [], color=style.GREY, linewidth=0.6, label=f"sample of the model, {len(drawn)} of {walls} variants")
    middle = found.at_medians
    if middle.has_errors:
        low, high = middle.interval(grid)
        ax.fill_between(
            grid, low, high, color=style.BLUE, alpha=0.22, linewidth=0.0, label="other records, 95 % band", zorder=2
        )
    if middle.has_fit:
        ax.plot(grid, middle(grid), color=style.BLUE, linestyle="--", label="sources at their medians", zorder=3)
    ax.plot(grid, found.curve(grid), color=style.RED, linewidth=2.4, label="mean of the sample", zorder=4)
    if found.as_given.has_fit:
        ax.plot(grid, found.as_given(grid), color=style.BLACK, linestyle=":", label="wall as given", zorder=5)
    ax.set_xlim(0.0, grid[-1])
    ax.set_ylim(-0.02, 1.02)
    ax.set_xlabel(style.im_label(found.im))
    ax.set_ylabel("probability of collapse")
    style.legend(ax, loc="upper center", bbox_to_anchor=(0.5, -0.15))


def _draw_tornado(found: UncertainWall, ax: Any) -> None:
    """What moves the median, the widest on top."""
    middle = found.at_medians
    bars = [
        (
            # Another statistic than the interval of the records below
            f"{name}\n{low:.4g} to {high:.4g} {_UNITS[name]}".rstrip() + ", 5 to 95 %",
            tuple(curve.theta for curve in ends),
            f"{100.0 * share:.0f} %" if np.isfinite(share) else "no index",
        )
        for name, (low, _, high), ends, share in zip(found.sources, found.values, found.ends, found.total, strict=True)
    ]
    if middle.has_errors:
        bars.append(("records\n95 % interval", middle.parameter_interval()["theta"], ""))
    bars.append(("numbers\nestimated error", found.numbers, ""))
    bars = [(name, span, share) for name, span, share in bars if np.isfinite(span).all()]
    bars.sort(key=lambda bar: abs(bar[1][1] - bar[1][0]))
    for row, (_, (at_low, at_high), share) in enumerate(bars):
        is_source = bool(share)
        look = {"color": style.RED if is_source else style.BLUE, "hatch": None if is_source else "///", "alpha": 0.75}
        ax.barh(row, at_high - at_low, left=at_low, height=_HEIGHT, edgecolor=style.BLACK, linewidth=0.6, **look)
        # A span as narrow as this would not be seen
        ax.plot([at_low, at_high], [row, row], "|", color=style.BLACK, markersize=11.0)
        if share:
            ax.annotate(
                share, (max(at_low, at_high), row), (5, 0), textcoords="offset points", va="center", fontsize=8.5
            )
    if not bars:
        ax.set_axis_off()
        ax.text(0.5, 0.5, "no medians", transform=ax.transAxes, ha="center")
        return
    ax.axvline(middle.theta, color=style.BLUE, linestyle="--", linewidth=1.2, zorder=0)
    if found.as_given.has_fit:
        ax.axvline(found.as_given.theta, color=style.BLACK, linestyle=":", zorder=0)
    ax.set_yticks(range(len(bars)), [name for name, _, _ in bars], parse_math=False)
    ax.grid(visible=False, axis="y")
    reach = [value for _, span, _ in bars for value in span]
    reach += [curve.theta for curve in (middle, found.as_given) if curve.has_fit]
    wide = max(reach) - min(reach)
    ax.set_xlim(min(reach) - 0.05 * wide, max(reach) + 0.15 * wide)
    unit = blank_unit(found.im).strip()
    ax.set_xlabel(f"median θ [{unit or '-'}]; % of the model's variance (total Sobol index)")


def draw_hinges(found: HingeSearch, ax: Axes | None) -> Axes:
    """Draw medians and trigger accelerations against the height of the hinge, each relative to its lowest."""
    ax = style.axes(ax, (6.0, 4.4))
    lowest = float(np.nanmin(found.thetas))
    fitted = [i for i, curve in enumerate(found.curves) if curve.has_errors]
    bounds = np.array([found.curves[i].parameter_interval()["theta"] for i in fitted]).reshape(-1, 2) / lowest
    ax.fill_between(
        found.hinges[fitted], *bounds.T, color=style.BLUE, alpha=0.2, linewidth=0.0, label="95 % interval of the median"
    )
    unit = blank_unit(found.typology.im)
    ax.plot(found.hinges, found.thetas / lowest, "o-", color=style.BLUE, markersize=4, label=f"θ / {lowest:.3g}{unit}")
    trigger = float(found.triggers.min())
    ax.plot(found.hinges, found.triggers / trigger, "--", color=style.BLACK, label=f"trigger / {trigger:.3g} g")
    ax.plot(found.hinge, 1.0, "v", color=style.RED, markersize=9, label=f"collapses first: {found.hinge:g}")
    ax.plot(
        found.first_to_rock, 1.0, "^", color=style.BLACK, markersize=7, label=f"rocks first: {found.first_to_rock:g}"
    )
    ax.set_xlabel("height of the hinge / height of the wall")
    ax.set_ylabel("relative to the lowest [-]")
    style.legend(ax, loc="upper center", bbox_to_anchor=(0.5, -0.14), ncols=2)
    return ax
