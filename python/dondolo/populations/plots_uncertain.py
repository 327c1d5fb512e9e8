"""Figures of walls that are not known for certain."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

import numpy as np

from dondolo._base.wording import property_name
from dondolo._fortran.records import blank_unit
from dondolo._fortran.walls import WALL_PROPERTIES
from dondolo.figures import curves, style
from dondolo.figures.options import Options
from dondolo.figures.themes import theme
from dondolo.figures.wording import in_words_of_figures, say

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from dondolo.populations.uncertain_wall import UncertainWall
    from dondolo.populations.weakest_hinge import HingeSearch

# Most curves that are drawn one by one
_THIN = 60
_ROWS = {row.name: row for row in WALL_PROPERTIES}
# What sentences that are said elsewhere are marked by for the catalogues
_ = str
# Words for properties whose names are those of variables
_WORDS = {
    "restitution_factor": _("ratio of restitution"),
    "restitution_value": _("restitution"),
    "hinge": _("height of the hinge"),
    "hinge_depth": _("depth of the hinge"),
    "compressive_strength": _("strength"),
}


def draw_uncertain_wall(found: UncertainWall, ax: Iterable[Any] | None, given: dict[str, Any]) -> Axes:
    """Draw the curves of the sample, and what moves the median."""
    options = Options(given, "band", "bars")
    left, right = style.panels(ax, 1, (9.6, 3.8), columns=2)
    _draw_curves(found, left, options)
    _draw_tornado(found, right, options)
    first: Axes = left
    return first


def _draw_curves(found: UncertainWall, ax: Any, options: Options) -> None:
    """The curves of the sample with their mean, and that of the medians with the band of its records."""
    grid = curves.grid(found.typology.levels)
    walls = len(found.sample)
    drawn = np.unique(np.linspace(0, walls - 1, _THIN).round().astype(int))
    middle = found.at_medians
    if options.band:
        curves.thin(ax, grid, found.curve.probabilities(grid)[drawn], 0.5, 0.6)
        text = say("sample of the model, {drawn} of {walls} variants", drawn=len(drawn), walls=walls)
        ax.plot([], [], color=style.GREY, linewidth=0.5, label=text)
        if middle.has_errors:
            ax.fill_between(
                grid,
                *middle.interval(grid),
                color=style.BLUE,
                alpha=0.3,
                linewidth=0.0,
                label=say("other records, 95 % band"),
            )
    if middle.has_fit:
        ax.plot(grid, middle(grid), color=style.BLUE, linestyle="--", label=say("sources at their medians"), zorder=3)
    look = options.look(color=style.RED, linewidth=2.2, label=say("mean of the sample"), zorder=2.5)
    style.main(ax, ax.plot(grid, found.curve(grid), **look)[0])
    if found.as_given.has_fit:
        ax.plot(grid, found.as_given(grid), color=style.BLACK, linestyle=":", label=say("wall as given"), zorder=5)
    curves.finish(ax, options, found.im, grid[-1], "")


def _draw_tornado(found: UncertainWall, ax: Any, options: Options) -> None:
    """What moves the median, the widest on top: from the median of the model to its value at either end of a source."""
    middle = found.at_medians
    bars = [
        (_name_of(name, low, high), tuple(curve.theta for curve in ends), share)
        for name, (low, _, high), ends, share in zip(found.sources, found.values, found.ends, found.total, strict=True)
    ]
    if middle.has_errors:
        bars.append((say("records, 95 % interval"), middle.parameter_interval()["theta"], None))
    bars.append((say("numerical error"), found.numbers, None))
    bars = [bar for bar in bars if np.isfinite(bar[1]).all()] if middle.has_fit else []
    if not bars:
        ax.set_axis_off()
        ax.text(0.5, 0.5, say("no medians"), transform=ax.transAxes, ha="center")
        return
    bars.sort(key=lambda bar: max(*bar[1], middle.theta) - min(*bar[1], middle.theta))
    for row, (name, ends, share) in enumerate(bars):
        # Above its bar: at the left of the axes names would take half of a narrow figure.
        look: dict[str, Any] = {"xycoords": ("axes fraction", "data"), "fontsize": theme().note, "zorder": 4}
        look["bbox"] = {"facecolor": "white", "edgecolor": "none", "alpha": 0.75, "pad": 0.3}
        ax.annotate(name, (0.0, row), (3, 4), textcoords="offset points", va="bottom", parse_math=False, **look)
        color, face = (style.BLUE, style.BLUE) if share is None else (style.RED, "white")
        # The median may lie beyond both ends: a line from it to the farthest, and a mark for each end
        reach = [min(*ends, middle.theta), max(*ends, middle.theta)]
        ax.plot(reach, [row, row], color=color, linewidth=3.0, solid_capstyle="butt", zorder=2)
        marks = ("|", "|") if share is None else ("o", "s")
        for end, marker, filled in zip(ends, marks, (face, color), strict=True):
            ax.plot(end, row, marker, color=color, markerfacecolor=filled, markersize=5.5, zorder=3)
        if share is not None and options.bars:
            text = f"{100.0 * share:.0f} %" if np.isfinite(share) else say("no index")
            ax.annotate(text, (1.0, row), (3, 0), textcoords="offset points", va="center", **look)
    for marker, filled, label in (("o", "white", say("source at 5 %")), ("s", style.RED, say("source at 95 %"))):
        ax.plot([], [], marker, color=style.RED, markerfacecolor=filled, label=label)
    ax.axvline(
        middle.theta, color=style.BLUE, linestyle="--", linewidth=1.2, zorder=0, label=say("all at their medians")
    )
    if found.as_given.has_fit:
        ax.axvline(found.as_given.theta, color=style.BLACK, linestyle=":", zorder=0, label=say("wall as given"))
    if options.bars and np.isfinite(found.total).any():
        style.note(ax, _of_shares(found))
    ax.set_yticks([])
    ax.set_ylim(-0.5, len(bars) + 0.1)
    unit = blank_unit(found.im).strip()
    ax.set_xlabel(say("median θ [{unit}]", unit=unit or "-"))
    style.legend(ax, options)


def _name_of(source: str, low: float, high: float) -> str:
    """A source in words, with the range between its fractiles 5 and 95 %."""
    with in_words_of_figures():
        name = say(_WORDS[source]) if source in _WORDS else property_name(source)
    unit = _ROWS[source].unit
    return say("{source}, {low:.4g} to {high:.4g} {unit}", source=name, low=low, high=high, unit=unit).rstrip()


def _of_shares(found: UncertainWall) -> str:
    """What the shares at the right are, and why their sum is not 100 %."""
    total = 100.0 * float(np.nansum(found.total))
    words = say("right: shares in the variance of ln θ, each with its interactions: {total:.0f}\u00a0%", total=total)
    if not np.isfinite(found.rest):
        return words
    return words + say("; another {rest:.0f}\u00a0% are noise of the counts", rest=100.0 * found.rest)


def draw_hinges(found: HingeSearch, ax: Axes | None, given: dict[str, Any]) -> Axes:
    """Draw medians and trigger accelerations against the height of the hinge, each relative to its lowest."""
    options = Options(given, "band")
    ax = style.axes(ax, (6.0, 3.8))
    lowest = float(np.nanmin(found.thetas))
    fitted = [i for i, curve in enumerate(found.curves) if curve.has_errors]
    bounds = np.array([found.curves[i].parameter_interval()["theta"] for i in fitted]).reshape(-1, 2) / lowest
    if options.band:
        text = "95 % interval of the median"
        ax.fill_between(found.hinges[fitted], *bounds.T, color=style.BLUE, alpha=0.2, linewidth=0.0, label=text)
    unit = blank_unit(found.typology.im)
    look = {"color": style.BLUE, "marker": "o", "markersize": 4, "label": f"θ / {lowest:.3g}{unit}"}
    style.main(ax, ax.plot(found.hinges, found.thetas / lowest, **options.look(**look))[0])
    trigger = float(found.triggers.min())
    ax.plot(found.hinges, found.triggers / trigger, "--", color=style.BLACK, label=f"trigger / {trigger:.3g} g")
    ax.plot(found.hinge, 1.0, "v", color=style.RED, markersize=9, label=f"collapses first: {found.hinge:g}")
    ax.plot(
        found.first_to_rock, 1.0, "^", color=style.BLACK, markersize=7, label=f"rocks first: {found.first_to_rock:g}"
    )
    ax.set_xlabel("height of the hinge / height of the wall")
    style.y_label(ax, "relative to the lowest [-]")
    style.title(ax, "", options)
    style.legend(ax, options)
    return ax
