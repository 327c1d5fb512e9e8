"""Figure of what a population is made of."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, get_args

import numpy as np

from dondolo._base.arguments import one_of
from dondolo.figures import style
from dondolo.walls.population import Kind, Population
from dondolo.walls.wall import MasonryWall

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_COLOURS = (style.RED, style.BLUE, style.BLACK, style.GREY)
_MARKERS = "osDv^<>P"
_LINES = ("-", "--", ":", "-.")
_SLENDERNESS = (5, 10, 20, 40)
_BINS = 30


def draw_population(population: Population, ax: Iterable[Axes] | None, by: Kind) -> style.Panels:
    """Draw thickness against height above (on the axis where there is none), trigger accelerations below."""
    one_of("by", by, get_args(Kind))
    axes = above, below = style.panels(ax, 2, (6.4, 6.0), height_ratios=(3, 2))
    keys = np.array(population.groups if by == "group" else [wall.mechanism for wall in population.walls])
    height = np.array([wall.height for wall in population.walls])
    thickness = np.array([wall.thickness if isinstance(wall, MasonryWall) else 0.0 for wall in population.walls])
    trigger = np.array([wall.trigger_acceleration / wall.gravity for wall in population.walls])
    edges = np.linspace(0.0, 1.02 * trigger.max(), _BINS + 1)
    for i, key in enumerate(dict.fromkeys(keys.tolist())):
        here = keys == key
        colour = _COLOURS[i % len(_COLOURS)]
        above.plot(
            height[here],
            thickness[here],
            linestyle="none",
            marker=_MARKERS[i % len(_MARKERS)],
            markersize=5,
            markerfacecolor="none",
            markeredgecolor=colour,
            markeredgewidth=0.8,
            label=style.label(f"{key or 'no group'} ({here.sum()})"),
        )
        below.stairs(
            np.histogram(trigger[here], edges, weights=population.weights[here])[0],
            edges,
            color=colour,
            linestyle=_LINES[(i + i // len(_COLOURS)) % len(_LINES)],
            linewidth=1.4,
            label=style.label(key or "no group"),
        )
    top, right = 1.12 * thickness.max() or 1.0, 1.05 * height.max()
    for slenderness in _SLENDERNESS:
        end = min(right, slenderness * top)
        above.plot([0.0, end], [0.0, end / slenderness], color=style.GREY, linewidth=0.7, zorder=1)
        above.annotate(
            f"H/t = {slenderness}",
            (end, end / slenderness),
            xytext=(2, 1),
            textcoords="offset points",
            fontsize=7.5,
            color=style.GREY,
            annotation_clip=False,
        )
    above.set_xlim(0.0, right)
    above.set_ylim(0.0, top)
    above.set_xlabel("height [m]")
    above.set_ylabel("thickness [m]")
    style.legend(above, loc="upper left", bbox_to_anchor=(1.09, 1.0))
    below.set_xlim(left=0.0)
    below.set_ylim(bottom=0.0)
    below.set_xlabel("trigger acceleration [g]")
    below.set_ylabel("weight")
    style.legend(below, loc="upper left", bbox_to_anchor=(1.09, 1.0))
    return axes
