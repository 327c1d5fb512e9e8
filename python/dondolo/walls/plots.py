"""Figure of what a population is made of."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any, get_args

import numpy as np

from dondolo._base.arguments import one_of
from dondolo.figures import style
from dondolo.figures.options import Options
from dondolo.figures.themes import theme
from dondolo.walls.population import Kind, Population
from dondolo.walls.wall import properties_of
from dondolo.walls.wall_rows import triggers_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_SLENDERNESS = (5, 10, 20, 40)
_BINS = 30


def draw_population(population: Population, ax: Iterable[Axes] | None, by: Kind, given: dict[str, Any]) -> Axes:
    """Draw thickness against height above (on the axis where there is none), trigger accelerations below."""
    one_of("by", by, get_args(Kind))
    options = Options(given)
    above, below = style.panels(ax, 2, (6.0, 6.0), height_ratios=(3, 2))
    keys = np.array(population.group_names if by == "group" else properties_of(population.walls, "mechanism"))
    height = np.array(properties_of(population.walls, "height"))
    thickness = np.array([one or 0.0 for one in properties_of(population.walls, "thickness")])
    trigger = np.array(triggers_of(population.walls))
    edges = np.linspace(0.0, 1.02 * trigger.max(), _BINS + 1)
    for i, key in enumerate(dict.fromkeys(keys.tolist())):
        here = keys == key
        line = {"color": style.COLOURS[i % len(style.COLOURS)], "linestyle": style.LINES[i % len(style.LINES)]}
        if by == "mechanism":
            line = style.mechanism_look(key)
        marker = style.MARKERS[i % len(style.MARKERS)]
        marks = {"marker": marker, "markersize": 5, "markerfacecolor": "none", "markeredgewidth": 0.8}
        look = options.look(**marks, markeredgecolor=line["color"]) | {"linestyle": "none"}
        above.plot(height[here], thickness[here], **look)
        # One entry of the legend for both panels
        above.plot([], [], **line, **marks, label=style.label(f"{key or 'no group'} ({here.sum()})"))
        below.stairs(
            np.histogram(trigger[here], edges, weights=population.weights[here])[0],
            edges,
            linewidth=1.4,
            **line,
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
            fontsize=theme().note,
            color=style.GREY,
            annotation_clip=False,
        )
    above.set_xlim(0.0, right)
    above.set_ylim(0.0, top)
    above.set_xlabel("height [m]")
    style.y_label(above, "thickness [m]")
    below.set_xlim(left=0.0)
    below.set_ylim(bottom=0.0)
    below.set_xlabel("trigger acceleration [g]")
    style.y_label(below, "weight")
    style.title(above, "", options)
    style.legend(below, options, also=(above,))
    first: Axes = above
    return first
