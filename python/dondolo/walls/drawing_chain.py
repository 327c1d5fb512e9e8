"""A chain of rigid bodies, drawn to scale at rest and moved, with its hinges and what acts on it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from dondolo._base.arguments import FloatArray
from dondolo.figures import style
from dondolo.figures.options import Options
from dondolo.figures.themes import theme
from dondolo.figures.wording import say
from dondolo.walls.chains import ChainWall

if TYPE_CHECKING:
    from matplotlib.axes import Axes


def draw_chain(wall: ChainWall, rotation: float, ax: Axes | None, options: Options, note: str) -> Axes:
    """Draw a chain at rest (dashed) and moved; towards its other side as its mirror image."""
    from matplotlib.patches import Polygon

    ax = style.axes(ax, (4.6, 4.2))
    side = -1.0 if rotation < 0.0 else 1.0
    own = {"facecolor": style.BRICK, "edgecolor": style.BLACK, "linewidth": 1.1, "alpha": 0.9}
    for _, is_opening, corners in wall.outlines():
        if not is_opening:
            ax.fill(*corners.T, facecolor="none", edgecolor=style.GREY, linestyle="--", linewidth=0.9)
    middle = _middle(wall)
    for _, is_opening, corners in outlines_at(wall, rotation):
        look = {**own, "facecolor": "white"} if is_opening else options.look(Polygon, **own)
        ax.fill(*corners.T, **look)
    _draw_joints(ax, wall, abs(rotation), side, middle)
    _draw_actions(ax, wall, abs(rotation), side, middle)
    for row, ends in zip(wall._rows("tie_table"), ends_of_ties(wall, abs(rotation)), strict=True):
        x = middle + side * (ends[:, 0] - middle)
        ax.plot(x, ends[:, 1], color=style.BLACK, linewidth=1.4, linestyle=(0, (6, 2, 1, 2)), zorder=5)
        words = say("tie {area:.3g} cm²", area=1e4 * row[7])
        ax.annotate(words, (x[1], ends[1, 1]), (0, 3), textcoords="offset points", fontsize=theme().note)
    ax.set_aspect("equal")
    ax.margins(0.12)
    ax.set_xlabel("x [m]")
    ax.set_ylabel("y [m]")
    ax.grid(False)
    style.title(
        ax, say("{wall}\nrotation {rotation:.3g} rad{note}", wall=wall.name, rotation=rotation, note=note), options
    )
    return ax


def outlines_at(wall: ChainWall, rotation: float) -> list[tuple[int, bool, FloatArray]]:
    """Outlines of a chain at a signed rotation: towards its other side it is its mirror image."""
    side, middle = (-1.0 if rotation < 0.0 else 1.0), _middle(wall)
    return [
        (body, is_opening, np.column_stack([middle + side * (corners[:, 0] - middle), corners[:, 1]]))
        for body, is_opening, corners in wall.outlines(rotation=abs(rotation))
    ]


def _middle(wall: ChainWall) -> float:
    """Line about which the motion to the other side is the mirror image [m]."""
    corners = [corners[:, 0] for _, _, corners in wall.outlines()]
    x = np.concatenate(corners) if corners else wall.motion(0.0).x
    return float(0.5 * (x.min() + x.max()))


def _draw_joints(ax: Axes, wall: ChainWall, rotation: float, side: float, middle: float) -> None:
    """Hinges as dots, guides as open squares."""
    for row in wall._rows("joint_table"):
        body = int(row[1]) or int(row[2])
        at = (-row[3], row[4]) if int(row[1]) else (-row[6], row[7])
        x, y = wall._moved([at], body, rotation)[0]
        look: dict[str, Any] = {"marker": "o"} if int(row[0]) == 2 else {"marker": "s", "markerfacecolor": "white"}
        ax.plot(middle + side * (x - middle), y, linestyle="none", color=style.RED, markersize=6, zorder=4, **look)


def ends_of_ties(wall: ChainWall, rotation: float) -> list[FloatArray]:
    """Anchor of each tie at a rotation, and its other end, of a tie to the ground a point on its way there."""
    found, reach = [], 0.25 * max(wall.height, 1.0)
    for row in wall._rows("tie_table"):
        near = wall._moved([(-row[2], row[3])], int(row[0]), rotation)[0]
        angle = np.radians(row[4])
        far = (
            wall._moved([(-row[5], row[6])], int(row[1]), rotation)[0]
            if row[1] > 0.0
            else np.array([-row[2], row[3]]) - reach * np.array([np.cos(angle), np.sin(angle)])
        )
        found.append(np.array([near, far]))
    return found


def _draw_actions(ax: Axes, wall: ChainWall, rotation: float, side: float, middle: float) -> None:
    """Loads and thrusts as arrows with their values, pushed masses as squares."""
    size = 0.12 * max(wall.height, 1.0)
    for row in wall._rows("action_table"):
        x, y = wall._moved([(-row[1], row[2])], int(row[0]), rotation)[0]
        x = middle + side * (x - middle)
        if row[6] > 0.0:
            ax.plot(x, y, linestyle="none", marker="s", color=style.BLUE, markersize=6, zorder=5)
            ax.annotate(f"{row[6]:.4g} kg", (x, y), (6, 4), textcoords="offset points", fontsize=theme().note)
            continue
        force, angle = (row[3], -90.0) if row[3] > 0.0 else (row[7], row[8])
        step = size * np.array([side * np.cos(np.radians(angle)), np.sin(np.radians(angle))])
        arrow = {"arrowstyle": "-|>", "color": style.BLUE, "linewidth": 1.6}
        ax.annotate("", (x, y), (x - step[0], y - step[1]), arrowprops=arrow, zorder=5)
        ax.annotate(
            f"{1e-3 * force:.4g} kN",
            (x - step[0], y - step[1]),
            (4, 3),
            textcoords="offset points",
            fontsize=theme().note,
            color=style.BLUE,
        )
