"""The elevation of a facade, drawn to scale: its openings, the line that it turns about, and where forces act."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from dondolo.figures import style
from dondolo.figures.layout import apart
from dondolo.figures.options import Options
from dondolo.figures.themes import theme
from dondolo.figures.wording import say
from dondolo.walls.drawing_loads import force_in_words
from dondolo.walls.elevation import axis_of, holes_of, outline_of, turning
from dondolo.walls.parts import parts_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from dondolo.walls.mechanisms import OneSidedWall


# Of loads, thrusts and ties
_COLOURS = {"load": style.BLUE, "thrust": style.RED, "tie": style.BLACK}


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
    # Forces per metre have their words beside the facade
    has_words = axis_of(wall) is None and any(parts_of(wall, of) for of in ("loads", "thrusts", "ties"))
    ax.set_xlim(low[0] - 0.08 * wide, high[0] + (0.34 if has_words else 0.08) * wide)
    ax.set_ylim(low[1] - 0.05 * (high[1] - low[1]), high[1] + 0.14 * (high[1] - low[1]))
    size = 0.09 * float(high[1] - low[1])
    marks = [(part, force_in_words(part), "load") for part in parts_of(wall, "loads")]
    marks += [(part, say("{force} thrust", force=force_in_words(part)), "thrust") for part in parts_of(wall, "thrusts")]
    marks += [(part, say("tie {area:.3g} cm²/m", area=1e4 * part.section), "tie") for part in parts_of(wall, "ties")]
    marks.sort(key=lambda mark: mark[0].height)
    if axis_of(wall) is None:
        levels = apart([mark[0].height for mark in marks], 0.045 * float(high[1] - low[1]))
        for level, (part, words, kind) in zip(levels, marks, strict=True):
            ends_x = [float(outline[:, 0].min()), float(outline[:, 0].max())]
            ax.plot(ends_x, [part.height] * 2, color=_COLOURS[kind], linewidth=0.9, linestyle=":", zorder=6)
            ax.annotate(words, (ends_x[1], level), (4, 0), textcoords="offset points", va="center",
                        fontsize=theme().note, color=_COLOURS[kind], zorder=7)  # fmt: skip
    else:
        for part, words, kind in marks:
            _mark(ax, part, words, size, kind)
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
    spans = [
        float(np.dot(point - axis.at, axis.along)) for point in on if abs(axis.above(point)) < 1e-9 * (right - left)
    ]
    given = np.array([wall.axis_x, wall.axis_z]).T
    spans += [float(np.dot(point - axis.at, axis.along)) for point in given]
    return np.array([axis.at + min(spans) * axis.along, axis.at + max(spans) * axis.along])


def _mark(ax: Axes, part: Any, words: str, size: float, kind: str) -> None:
    """A force at its place on a panel."""
    look: dict[str, Any] = {"fontsize": theme().note, "color": _COLOURS[kind], "zorder": 7}
    at = (part.x, part.height)
    if kind == "load":
        arrow = {"arrowstyle": "-|>", "color": _COLOURS[kind], "linewidth": 1.6}
        ax.annotate("", at, (at[0], at[1] + size), arrowprops=arrow, zorder=6)
        ax.annotate(words, (at[0], at[1] + 0.6 * size), (6, 0), textcoords="offset points", **look)
    else:
        # It acts normal to the face.
        ax.plot(*at, marker="x", markersize=7, color=_COLOURS[kind], zorder=6)
        ax.annotate(words, at, (7, -10), textcoords="offset points", **look)
