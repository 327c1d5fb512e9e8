"""The elevation of a facade in a calculation report: openings, the line that it turns about, sizes in centimetres."""

from __future__ import annotations

import itertools
import math
from typing import TYPE_CHECKING, Any

import numpy as np

from dondolo.figures import style
from dondolo.reporting.blocks import Block, Picture, symbol_of
from dondolo.reporting.content import Symbol
from dondolo.reporting.numerals import number
from dondolo.reporting.relazione.document import Document, _
from dondolo.reporting.relazione.subjects import Subject
from dondolo.walls.drawing_elevation import ends_of_axis
from dondolo.walls.elevation import axis_of, holes_of, outline_of, turning
from dondolo.walls.mechanisms import OneSidedWall
from dondolo.walls.parts import parts_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_DARK, _MIDDLE, _PALE = "#000000", "#6e6e6e", "#e2e2e2"
_WORDS = 9.0
_CENTIMETRES = 100.0
_SIZE = {
    "arrowstyle": "|-|, widthA=0.25, widthB=0.25", "color": _MIDDLE, "linewidth": 0.7, "shrinkA": 0.0, "shrinkB": 0.0,
}  # fmt: skip


def elevation_of(document: Document, one: Subject, name: str) -> list[Block]:
    """The drawing of the elevation of a wall that has one."""
    if not isinstance(one.wall, OneSidedWall) or one.wall.elevation_x is None:
        return []
    return [
        Picture(
            lambda: draw_elevation(document, one),
            document.titled(document.text(_("Elevation of the facade, with the line that it turns about")), name),
            document.text(_("The elevation with its openings; what is hatched stays below the line.")),
        )
    ]


def panels(document: Document) -> list[Block]:
    """What is assumed of panels that turn about an inclined line of their face."""
    blocks: list[Block] = []
    for name, one in document.each():
        axis = axis_of(one.wall)
        if axis is None or not axis.along[1]:
            continue
        words = _(
            "{wall}: the panel turns about a line in its face, inclined at {angle} degrees. Heights are distances from"
            " this line, in the face; of the weights the part cos {beta} = {share} acts in the plane of the motion,"
            " which is normal to the line, so that the stabilising moment of a weight is {force} {arm} cos {beta}. The"
            " panel leans on nothing, and the building moves its axis alone. Friction along the line is not checked."
        )
        values = {
            "wall": name,
            "angle": number(math.degrees(math.atan2(abs(axis.along[1]), axis.along[0])), 4),
            "beta": Symbol("β"),
            "share": number(float(axis.along[0]), 5),
            "force": symbol_of("P"),
            "arm": symbol_of("e"),
        }
        blocks.append(document.say(words, **values))
    return blocks


def draw_elevation(document: Document, one: Subject) -> Any:
    """An elevation to scale, in greys."""
    ax = style.new_axes(1, (5.4, 3.8))
    wall = one.wall
    assert isinstance(wall, OneSidedWall)
    outline = outline_of(wall)
    assert outline is not None
    ax.fill(*outline.T, facecolor="white", edgecolor=_MIDDLE, hatch="///", linewidth=0.0)
    ax.fill(*turning(wall, outline).T, facecolor=_PALE, edgecolor="none")
    for hole in holes_of(wall):
        ax.fill(*hole.T, facecolor="white", edgecolor=_DARK, linewidth=0.8)
    ax.fill(*outline.T, facecolor="none", edgecolor=_DARK, linewidth=1.0)
    ax.plot(*ends_of_axis(wall).T, color=_DARK, linewidth=2.2, linestyle=(0, (5, 2)))
    low, high = outline.min(axis=0), outline.max(axis=0)
    room = 0.1 * float(max(high - low))
    _sizes(document, ax, outline, room)
    if axis_of(wall) is not None:
        for count, load in enumerate(parts_of(wall, "loads"), 1):
            ax.annotate("", (load.x, load.height), (load.x, load.height + room),
                        arrowprops={"arrowstyle": "-|>", "color": _DARK, "linewidth": 1.1})  # fmt: skip
            ax.annotate(f"N{count}", (load.x, load.height + 0.6 * room), (5, 0), textcoords="offset points",
                        fontsize=_WORDS)  # fmt: skip
    ax.set_aspect("equal")
    ax.axis("off")
    ax.set_xlim(low[0] - 2.2 * room, high[0] + 0.8 * room)
    ax.set_ylim(low[1] - 2.0 * room, high[1] + 1.4 * room)
    return ax


def _sizes(document: Document, ax: Axes, outline: Any, room: float) -> None:
    """Width and heights of the corners, in centimetres."""
    low, high = outline.min(axis=0), outline.max(axis=0)
    y = low[1] - 0.8 * room
    ax.annotate("", (low[0], y), (high[0], y), arrowprops=_SIZE)
    words = document.language.decimal(f"{_CENTIMETRES * (high[0] - low[0]):.5g}")
    middle = (0.5 * (low[0] + high[0]), y)
    ax.annotate(f"{words} cm", middle, (0, -3), textcoords="offset points", ha="center", va="top", fontsize=_WORDS)
    x = low[0] - 0.8 * room
    # Heights that are closer than their words are one
    levels = [float(low[1])]
    for level in np.unique(outline[:, 1]):
        if level - levels[-1] > 0.5 * room:
            levels.append(float(level))
    for bottom, top in itertools.pairwise(levels):
        ax.annotate("", (x, bottom), (x, top), arrowprops=_SIZE)
        words = document.language.decimal(f"{_CENTIMETRES * (top - bottom):.5g}")
        ax.annotate(words, (x, 0.5 * (bottom + top)), (-3, 0), textcoords="offset points", rotation=90, ha="right",
                    va="center", fontsize=_WORDS)  # fmt: skip
