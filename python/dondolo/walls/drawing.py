"""The wall itself, drawn to scale at rest and rotated, with its hinges and what it carries."""

from __future__ import annotations

from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from dondolo._base.arguments import FloatArray
from dondolo.figures import style
from dondolo.figures.options import Options
from dondolo.figures.themes import theme
from dondolo.figures.wording import say
from dondolo.walls.chains import ChainWall
from dondolo.walls.drawing_chain import draw_chain
from dondolo.walls.drawing_loads import caption, draw_loads
from dondolo.walls.elevation import axis_of, height_of
from dondolo.walls.mechanisms import Corner, TabulatedWall, TwoBlockWall
from dondolo.walls.parts import parts_of
from dondolo.walls.shape import shape, wedges, width_of
from dondolo.walls.wall import MasonryWall, Wall

if TYPE_CHECKING:
    from matplotlib.axes import Axes


# Values of a table
_MARKS: dict[str, Any] = {"linestyle": "none", "marker": "o", "markerfacecolor": "none", "markersize": 3.5}


def draw_wall(wall: Wall, rotation: float, ax: Axes | None, given: dict[str, Any], note: str = "") -> Axes:
    """Draw a wall at rest (dashed) and rotated, with its hinges and what it carries; of a tabulated wall its moment."""
    from matplotlib.patches import Polygon

    options = Options(given)
    if isinstance(wall, ChainWall):
        return draw_chain(wall, rotation, ax, options, note)
    if isinstance(wall, TabulatedWall):
        return _draw_moment(wall, rotation, ax, options, note)
    assert isinstance(wall, MasonryWall)
    lines = caption(wall)
    ax = style.axes(ax, (3.6, 4.6))
    draw_surroundings(ax, wall)
    for block in shape(wall, 0.0).blocks:
        ax.fill(*block.T, facecolor="none", edgecolor=style.GREY, linestyle="--", linewidth=0.9)
    now = shape(wall, rotation)
    for block in now.blocks:
        own = {"facecolor": style.BRICK, "edgecolor": style.BLACK, "linewidth": 1.1, "alpha": 0.9}
        ax.fill(*block.T, **options.look(Polygon, **own))
    ax.plot(*now.hinges.T, linestyle="none", marker="o", color=style.RED, markersize=6, label=say("hinge"), zorder=4)
    frame(ax, wall)
    _draw_supports(ax, wall)
    draw_loads(ax, wall, rotation, now)
    if lines:
        size, text = theme().note, "\n".join(lines)
        style.make_room(ax, 1.3 * size * len(lines))
        ax.annotate(text, (0.0, 0.0), (-30, -34), "axes fraction", textcoords="offset points", fontsize=size, va="top")
    style.title(
        ax, say("{wall}\nrotation {rotation:.3g} rad{note}", wall=wall.name, rotation=rotation, note=note), options
    )
    # A legend's own marker would pass for one more hinge.
    base = now.hinges[0]
    right = base[0] > 0.5 * width_of(wall)
    depth = wall.base_hinge_depth
    ax.annotate(
        say("hinge, {depth:.3g} mm deep", depth=1e3 * depth) if depth > 0.0 else say("hinge"),
        base,
        (9 if right else -9, 6),
        textcoords="offset points",
        ha="left" if right else "right",
        fontsize=theme().legend,
        color=style.RED,
    )
    return ax


def _draw_moment(wall: TabulatedWall, rotation: float, ax: Axes | None, options: Options, note: str) -> Axes:
    """Draw the restoring moment of a tabulated wall, which has no shape, and where it is."""
    ax = style.axes(ax, (4.6, 3.4))
    q = np.linspace(0.0, float(np.max(wall.rotation)), 201)
    ax.plot(q, _moment(wall, q), **options.look(color=style.BLUE, label=say("as computed")))
    table = np.asarray(wall.rotation)
    ax.plot(table, 1e-3 * np.asarray(wall.moment), color=style.GREY, label=say("table"), **_MARKS)
    ax.plot(
        abs(rotation),
        _moment(wall, abs(rotation)),
        color=style.RED,
        linestyle="none",
        marker="o",
        label=say("rotation"),
    )
    ax.axhline(0.0, color=style.BLACK, linewidth=0.8)
    ax.axvline(wall.capacity_angle, color=style.BLACK, linewidth=0.8, linestyle="--", label=say("capacity"))
    ax.set_xlabel(say("rotation [rad]"))
    ax.set_ylabel(say("restoring moment [kN m per metre]"))
    style.title(
        ax, say("{wall}\nrotation {rotation:.3g} rad{note}", wall=wall.name, rotation=rotation, note=note), options
    )
    style.legend(ax, options)
    return ax


def _moment(wall: TabulatedWall, rotation: ArrayLike) -> FloatArray:
    """Restoring moment G - Q [kN m per metre]."""
    terms = wall.terms(rotation)
    return 1e-3 * (terms.restoring_moment - terms.load_force)


def draw_surroundings(ax: Axes, wall: MasonryWall) -> None:
    """The ground, what is behind a one-sided wall, the top support of a two-block wall."""
    t, h = width_of(wall), wall.height
    reach = _reach(wall)
    ax.plot([-reach, t + reach], [0.0, 0.0], color=style.BLACK, linewidth=1.6)
    if isinstance(wall, TwoBlockWall):
        for left in (-0.5 * reach, t):
            ax.fill_between([left, left + 0.5 * reach], h, 1.03 * h, facecolor=style.LIGHT, linewidth=0.0)
        ax.annotate(say("held at the top"), (t + 0.1 * reach, 0.955 * h), fontsize=theme().note)
    elif not wall.two_sided:
        ax.fill_betweenx([0.0, h], -reach, 0.0, facecolor=style.LIGHT, hatch="//", edgecolor="white", linewidth=0.0)
        middle, is_whole = _free_height(wall)
        # Between labels of what holds the wall there is half the room.
        # A panel may have anything behind it: a roof, a floor, masonry.
        text = say("transverse wall") if axis_of(wall) is None else say("what is behind")
        if isinstance(wall, Corner):
            text = say("both walls")
        text = text if is_whole else text.replace(" ", "\n")
        ax.annotate(text, (-0.5 * reach, middle), rotation=90, ha="center", va="center", fontsize=theme().note)


def _draw_supports(ax: Axes, wall: MasonryWall) -> None:
    """The building as it leans, and arrows where it moves the wall: at its base, and at the top of what holds it."""
    if wall.building is None:
        return
    reach, lean = _reach(wall), 0.05
    arrow = {"arrowstyle": "-|>", "color": style.BLUE, "linewidth": 1.6}
    end = -0.1 * reach
    ax.annotate("", (end, 0.0), (end - 0.7 * reach, 0.0), arrowprops=arrow, zorder=5)
    ax.annotate(
        say("base moves"),
        (end - 0.35 * reach, 0.0),
        (0, 3),
        textcoords="offset points",
        fontsize=theme().note,
        ha="center",
        color=style.BLUE,
    )
    top = support_height(wall)
    if top > 0.0:
        ax.plot([0.0, lean * top], [0.0, top], color=style.BLUE, linewidth=1.4, linestyle="--", zorder=3)
        end += lean * top
        ax.annotate("", (end, top), (end - 0.7 * reach, top), arrowprops={**arrow, "arrowstyle": "->"}, zorder=5)
        words = say("top moves") if isinstance(wall, TwoBlockWall) else say("building leans")
        ax.annotate(
            words,
            (end - 0.35 * reach, top),
            (0, 3),
            textcoords="offset points",
            fontsize=theme().note,
            ha="center",
            color=style.BLUE,
        )


def support_height(wall: MasonryWall) -> float:
    """Height above its base up to which a building moves a wall [m]; 0: the building moves its base alone."""
    if not wall.support_share > 0.0:
        return 0.0
    if isinstance(wall, TwoBlockWall):
        return wall.height
    # k is J(0)/L(0) over the height of what the wall leans on (docs/theory.md, section 1)
    at_rest = wall.terms(0.0)
    return float(at_rest.inertia / at_rest.excitation_lever) / wall.support_share


def _free_height(wall: MasonryWall) -> tuple[float, bool]:
    """Height in the middle of the largest part behind the wall without labels of what holds it; is that all of it?"""
    taken = [0.0, wall.height]
    if 0.0 < support_height(wall) < wall.height:
        taken.append(support_height(wall))
    taken += [part.height for of in ("ties", "springs") for part in parts_of(wall, of)]
    taken += [height_of(wall, thrust) for thrust in parts_of(wall, "thrusts")]
    if parts_of(wall, "interlock"):
        taken.append(wall.height / 3.0)
    taken.sort()
    gap, bottom = max((above - below, below) for below, above in pairwise(taken))
    # A label stands above its height
    return bottom + (0.5 if len(taken) == 2 else 0.55) * gap, len(taken) == 2


def _reach(wall: MasonryWall) -> float:
    """How much room to leave on both sides [m]."""
    behind = [-float(np.min(wedge)) for wedge in wedges(wall)]
    return max(1.2 * width_of(wall), 0.22 * wall.height, *(1.15 * reach for reach in behind))


def frame(ax: Axes, wall: MasonryWall) -> None:
    """Scale and limits of the axes."""
    reach = _reach(wall)
    ax.set_aspect("equal")
    ax.set_xlim(-reach, width_of(wall) + 1.3 * reach)
    ax.set_ylim(-0.04 * wall.height, 1.12 * wall.height)
    ax.set_xlabel("x [m]")
    ax.set_ylabel("y [m]")
    ax.grid(False)
