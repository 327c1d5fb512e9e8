"""The wall itself, drawn to scale at rest and rotated, hinges marked.

Positions follow docs/theory.md, section 2. Outwards is to the right.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from dondolo.figures import style
from dondolo.walls.wall import TwoBlockWall, Wall

if TYPE_CHECKING:
    from matplotlib.axes import Axes

Points = np.ndarray[Any, np.dtype[np.float64]]


@dataclass(frozen=True)
class Shape:
    """Where a wall is.

    Attributes
    ----------
    blocks : list of ndarray, shape (4, 2)
        Corners of its blocks [m], from the base on its left, counter-clockwise.
    hinges : ndarray, shape (hinges, 2)
        Corners about which the blocks rotate [m].
    """

    blocks: list[Points]
    hinges: Points


def shape(wall: Wall, rotation: float) -> Shape:
    """The position of a wall at a rotation.

    Parameters
    ----------
    wall : Wall
        The wall; at rest its base lies on y = 0, from x = 0 to x = thickness.
    rotation : float
        Signed rotation, of the lower block for two-block walls [rad]; positive: outwards, to the right.

    Returns
    -------
    Shape
    """
    side = -1.0 if rotation < 0.0 else 1.0
    t, q = wall.thickness, abs(rotation)
    if isinstance(wall, TwoBlockWall):
        blocks, hinges = _two_blocks(wall, q)
    else:
        toe = np.array([t, 0.0])
        blocks, hinges = [_turned(_rectangle(t, wall.height), toe, -q)], toe[None, :]
    if side < 0.0:
        blocks = [_mirrored(block, t) for block in blocks]
        hinges = _mirrored(hinges, t)
    return Shape(blocks, hinges)


def _two_blocks(wall: TwoBlockWall, q: float) -> tuple[list[Points], Points]:
    """Both blocks folded to the right: R2 sin(beta2) = R1 sin(beta1) keeps base and top hinge on one vertical."""
    t = wall.thickness
    lower, upper = wall.hinge * wall.height, (1.0 - wall.hinge) * wall.height
    alpha1, alpha2 = np.arctan2(t, lower), np.arctan2(t, upper)
    beta1 = alpha1 - q
    beta2 = np.arcsin(np.hypot(t, lower) * np.sin(beta1) / np.hypot(t, upper))
    base = np.array([t, 0.0])
    middle = base + np.hypot(t, lower) * np.array([-np.sin(beta1), np.cos(beta1)])
    top = middle + np.hypot(t, upper) * np.array([np.sin(beta2), np.cos(beta2)])
    corner = np.array([t, upper])
    blocks = [
        _turned(_rectangle(t, lower), base, -q),
        _turned(_rectangle(t, upper), corner, alpha2 - beta2) + (top - corner),
    ]
    return blocks, np.array([base, middle, top])


def _rectangle(width: float, height: float) -> Points:
    return np.array([[0.0, 0.0], [width, 0.0], [width, height], [0.0, height]])


def _turned(points: Points, centre: Points, angle: float) -> Points:
    """Points turned about a centre, counter-clockwise."""
    cos, sin = np.cos(angle), np.sin(angle)
    turned: Points = (points - centre) @ np.array([[cos, sin], [-sin, cos]]) + centre
    return turned


def _mirrored(points: Points, width: float) -> Points:
    return np.column_stack([width - points[:, 0], points[:, 1]])


def draw_wall(wall: Wall, rotation: float, ax: Axes | None, note: str = "") -> Axes:
    """Draw a wall at rest (dashed) and rotated, with the hinges it rotates about."""
    ax = style.axes(ax, (3.6, 4.6))
    draw_surroundings(ax, wall)
    for block in shape(wall, 0.0).blocks:
        ax.fill(*block.T, facecolor="none", edgecolor=style.GREY, linestyle="--", linewidth=0.9)
    moved = shape(wall, rotation)
    for block in moved.blocks:
        ax.fill(*block.T, facecolor=style.BRICK, edgecolor=style.BLACK, linewidth=1.1, alpha=0.9)
    ax.plot(*moved.hinges.T, linestyle="none", marker="o", color=style.RED, markersize=6, label="hinge", zorder=4)
    frame(ax, wall)
    ax.set_title(f"{wall.name}\nrotation {rotation:.3g} rad{note}", loc="left", fontsize=9.5, parse_math=False)
    # A legend's own marker would pass for one more hinge.
    base = moved.hinges[0]
    right = base[0] > 0.5 * wall.thickness
    ax.annotate(
        "hinge",
        base,
        (9 if right else -9, 6),
        textcoords="offset points",
        ha="left" if right else "right",
        fontsize=8.5,
        color=style.RED,
    )
    return ax


def draw_surroundings(ax: Axes, wall: Wall) -> None:
    """The ground, the transverse wall of a one-sided wall, the top support of a two-block wall."""
    t, h = wall.thickness, wall.height
    reach = _reach(wall)
    ax.plot([-reach, t + reach], [0.0, 0.0], color=style.BLACK, linewidth=1.6)
    if isinstance(wall, TwoBlockWall):
        for left in (-0.5 * reach, t):
            ax.fill_between([left, left + 0.5 * reach], h, 1.03 * h, facecolor=style.LIGHT, linewidth=0.0)
        ax.annotate("held at the top", (t + 0.1 * reach, 0.955 * h), fontsize=7.5)
    elif not wall.two_sided:
        ax.fill_betweenx([0.0, h], -reach, 0.0, facecolor=style.LIGHT, hatch="//", edgecolor="white", linewidth=0.0)
        ax.annotate("transverse wall", (-0.5 * reach, 0.5 * h), rotation=90, ha="center", va="center", fontsize=7.5)


def _reach(wall: Wall) -> float:
    """How much room to leave on both sides [m]."""
    return max(1.2 * wall.thickness, 0.22 * wall.height)


def frame(ax: Axes, wall: Wall) -> None:
    """Scale and limits of the axes."""
    reach = _reach(wall)
    ax.set_aspect("equal")
    ax.set_xlim(-reach, wall.thickness + 1.3 * reach)
    ax.set_ylim(-0.04 * wall.height, 1.12 * wall.height)
    ax.set_xlabel("x [m]")
    ax.set_ylabel("y [m]")
    ax.grid(False)
