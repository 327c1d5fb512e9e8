"""The elevation of a facade, drawn to scale: its openings, the line that it turns about, and where forces act."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from dondolo.figures import style
from dondolo.figures.options import Options
from dondolo.figures.themes import theme
from dondolo.figures.wording import say
from dondolo.walls.drawing_loads import force_in_words
from dondolo.walls.elevation import axis_of, holes_of, outline_of, turning
from dondolo.walls.parts import parts_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from dondolo.walls.mechanisms import OneSidedWall


def draw_elevation(wall: OneSidedWall, ax: Axes | None, options: Options) -> Axes:
    """Draw an elevation: what turns in the colour of masonry, what stays below the line in grey."""
    from matplotlib.patches import Polygon

    ax = style.axes(ax, (5.2, 4.4))
    outline = outline_of(wall)
    assert outline is not None
    moves = turning(wall, outline)
    ax.fill(*outline.T, facecolor=style.LIGHT, edgecolor="none", zorder=1)
    own = {"facecolor": style.BRICK, "edgecolor": "none", "alpha": 0.9, "zorder": 2}
    ax.fill(*moves.T, **options.look(Polygon, **own))
    for hole in holes_of(wall):
        ax.fill(*hole.T, facecolor="white", edgecolor=style.BLACK, linewidth=0.8, zorder=3)
    ax.fill(*outline.T, facecolor="none", edgecolor=style.BLACK, linewidth=1.1, zorder=4)
    ends = ends_of_axis(wall)
    ax.plot(*ends.T, color=style.RED, linewidth=1.8, linestyle="--", label=say("hinge"), zorder=5)
    low, high = np.minimum(outline.min(axis=0), ends.min(axis=0)), np.maximum(outline.max(axis=0), ends.max(axis=0))
    wide = float(high[0] - low[0])
    ax.set_xlim(low[0] - 0.08 * wide, high[0] + 0.34 * wide)
    ax.set_ylim(low[1] - 0.05 * (high[1] - low[1]), high[1] + 0.14 * (high[1] - low[1]))
    size = 0.09 * float(high[1] - low[1])
    for load in parts_of(wall, "loads"):
        _mark(ax, wall, load, force_in_words(load), size, float(outline[:, 0].max()), "load")
    for thrust in parts_of(wall, "thrusts"):
        words = say("{force} thrust", force=force_in_words(thrust))
        _mark(ax, wall, thrust, words, size, float(outline[:, 0].max()), "thrust")
    for tie in parts_of(wall, "ties"):
        words = say("tie {area:.3g} cm²/m", area=1e4 * tie.section)
        _mark(ax, wall, tie, words, size, float(outline[:, 0].max()), "tie")
    ax.set_aspect("equal")
    ax.set_xlabel("x [m]")
    ax.set_ylabel("z [m]")
    ax.grid(False)
    style.title(ax, say("{wall}: elevation", wall=wall.name), options)
    return ax


def ends_of_axis(wall: OneSidedWall) -> Any:
    """Ends of the line that a wall turns about where it leaves the elevation [m]."""
    outline = outline_of(wall)
    assert outline is not None
    axis = axis_of(wall)
    left, right = float(outline[:, 0].min()), float(outline[:, 0].max())
    if axis is None:
        return np.array([(left, 0.0), (right, 0.0)])
    # Of a panel what lies on the line and above it, and at least the two points that are given
    on = turning(wall, outline)
    spans = [float(np.dot(point - axis.at, axis.along)) for point in on if abs(axis.above(point)) < 1e-9 * (right - left)]
    given = np.array([wall.axis_x, wall.axis_z]).T
    spans += [float(np.dot(point - axis.at, axis.along)) for point in given]
    return np.array([axis.at + min(spans) * axis.along, axis.at + max(spans) * axis.along])


def _mark(ax: Axes, wall: OneSidedWall, part: Any, words: str, size: float, right: float, kind: str) -> None:
    """A force at its place; of a wall whose forces are per metre a line along its height."""
    color = {"load": style.BLUE, "thrust": style.RED, "tie": style.BLACK}[kind]
    look = {"fontsize": theme().note, "color": color, "zorder": 7}
    if axis_of(wall) is None:
        left = float(np.min(wall.elevation_x or 0.0))
        ax.plot([left, right], [part.height] * 2, color=color, linewidth=0.9, linestyle=":", zorder=6)
        ax.annotate(words, (right, part.height), (4, 0), textcoords="offset points", va="center", **look)
        return
    at = (part.x, part.height)
    if kind == "load":
        arrow = {"arrowstyle": "-|>", "color": color, "linewidth": 1.6}
        ax.annotate("", at, (at[0], at[1] + size), arrowprops=arrow, zorder=6)
        ax.annotate(words, (at[0], at[1] + 0.6 * size), (6, 0), textcoords="offset points", **look)
    else:
        # It acts normal to the face.
        ax.plot(*at, marker="x", markersize=7, color=color, zorder=6)
        ax.annotate(words, at, (7, -10), textcoords="offset points", **look)
