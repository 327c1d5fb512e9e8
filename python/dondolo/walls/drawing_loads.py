"""What a wall carries and what holds it, drawn on it: loads, masses, thrusts, springs and ties, with their values.

Shapes tell them apart without colour: arrows down are loads, filled with a mass that the wall moves and open without
one, arrows to the side are thrusts, squares are masses that are pushed alone, zigzags are springs, dashed lines with a
plate are ties, teeth behind the wall are stones that interlock with transverse walls.
"""

from __future__ import annotations

import textwrap
from typing import TYPE_CHECKING, Any

import numpy as np

from dondolo.figures import style
from dondolo.figures.themes import theme
from dondolo.figures.wording import decimal, in_english, say
from dondolo.walls.elevation import height_of
from dondolo.walls.mechanisms import Corner, TwoBlockWall
from dondolo.walls.parts import Load, Thrust, Tie, parts_of
from dondolo.walls.shape import Points, Shape, moved, storeys, width_of
from dondolo.walls.wall import MasonryWall, effective_property

if TYPE_CHECKING:
    from matplotlib.axes import Axes

# Parts of a load that the wall lifts and pushes
_PARTS = {"none": (0.0, 0.0), "vertical": (1.0, 0.0), "both": (1.0, 1.0)}
# What sentences that are said elsewhere are marked by for the catalogues
_ = str
# What ties and friction are made of: words, property, factor and unit
_OF_TIES = (
    (_("length"), "tie_length", 1.0, " m"),
    (_("modulus"), "tie_modulus", 1e-9, " GPa"),
    (_("yield stress"), "tie_strength", 1e-6, " MPa"),
    (_("preload"), "tie_preload", 1e-6, " MPa"),
    (_("breaks at a strain of"), "tie_strain", 1.0, ""),
    (_("anchor gives way at"), "tie_anchor_force", 1e-3, " kN/m"),
    (_("anchor gives way at"), "tie_anchor_total", 1e-3, " kN"),
    (_("bar"), "tie_bar", 1e3, " mm"),
    (_("every"), "tie_spacing", 1.0, " m"),
    (_("plate wide"), "tie_plate_width", 1e3, " mm"),
    (_("high"), "tie_plate_height", 1e3, " mm"),
    (_("diameter"), "tie_plate_diameter", 1e3, " mm"),
    (_("thick"), "tie_plate_thickness", 1e3, " mm"),
)
_OF_FRICTION = (
    (_("coefficient"), "interlock_friction", 1.0, ""),
    (_("overlap"), "interlock_overlap", 1.0, " m"),
    (_("course"), "interlock_course", 1.0, " m"),
    (_("transverse walls thick"), "interlock_thickness", 1.0, " m"),
    (_("every"), "interlock_spacing", 1.0, " m"),
)
# Characters of a line below the drawing
_ACROSS = 44
_PREFIXES = ((1e6, "M"), (1e3, "k"), (1.0, ""))


def draw_loads(ax: Axes, wall: MasonryWall, rotation: float, now: Shape) -> None:
    """Draw what acts on a wall where it has turned.

    Parameters
    ----------
    ax : Axes
        Has the limits of the drawing.
    wall : MasonryWall
        The wall.
    rotation : float
        Signed rotation [rad].
    now : Shape
        Where it is then.
    """
    size = 0.09 * wall.height
    if isinstance(wall, TwoBlockWall) and wall.overburden > 0.0:
        _, _, active, other = now.blocks[1]
        lifted = wall.overburden_inertia or 0.0
        words = f"{_with_prefix(wall.overburden, 'N/m')} {_in_words(lifted, 0.0)}"
        # The eccentricity is measured towards the active top hinge
        part = 0.5 + wall.eccentricity / wall.thickness
        _arrow_down(ax, other + part * (active - other), size, words, is_mass=lifted > 0.0)
    for load in parts_of(wall, "loads"):
        lifted, pushed = _PARTS[load.inertia] if load.inertia else (load.lifted, load.pushed)
        words = f"{force_in_words(load)} {_in_words(lifted, pushed)}"
        _arrow_down(ax, _place(wall, load.depth, height_of(wall, load), rotation), size, words, is_mass=lifted > 0.0)
    for mass in parts_of(wall, "inertial_masses"):
        at = _place(wall, mass.depth, height_of(wall, mass), rotation)
        ax.plot(*at, marker="s", color=style.BLACK, markersize=7, zorder=5)
        _words(ax, at, say("{mass:.4g} kg/m pushed", mass=mass.mass), (9, -3))
    for thrust in parts_of(wall, "thrusts"):
        height = height_of(wall, thrust)
        depth = inner_face(wall, height) if thrust.depth is None else thrust.depth
        at = _place(wall, depth, height, rotation)
        arrow = {"arrowstyle": "-|>", "color": style.RED, "linewidth": 1.8}
        ax.annotate("", tuple(at), tuple(np.subtract(at, (1.4 * size, 0.0))), arrowprops=arrow, zorder=5)
        words = say("{force} thrust", force=force_in_words(thrust))
        _words(ax, np.subtract(at, (1.4 * size, 0.0)), words, (0, 4), ha="center")
    for spring in parts_of(wall, "springs"):
        at = _place(wall, spring.depth, spring.height, rotation)
        _spring(ax, wall, at, size, _with_prefix(spring.stiffness, "N/m²"))
    for tie in parts_of(wall, "ties"):
        _frustum(ax, wall, tie, rotation)
        plate = tie.plate_height or tie.plate_diameter or 0.5 * size
        area = 1e4 * tie.section
        whole = isinstance(wall, Corner)
        words = say("tie {area:.3g} cm²", area=area) if whole else say("tie {area:.3g} cm²/m", area=area)
        _tie(ax, _place(wall, tie.depth or 0.0, tie.height, rotation), size, plate, words)
    for stones in parts_of(wall, "interlock"):
        _teeth(ax, wall, stones, rotation)
    for bed in parts_of(wall, "distributed_springs"):
        for height in np.linspace(bed.bottom, bed.top, 5):
            words = _with_prefix(bed.stiffness, "N/m³") if height == bed.bottom else ""
            _spring(ax, wall, _place(wall, bed.depth, float(height), rotation), size, words)


def caption(wall: MasonryWall) -> list[str]:
    """Lines that say what the ties of a wall and its friction are made of; none for a wall without them.

    Parameters
    ----------
    wall : MasonryWall
        The wall.

    Returns
    -------
    list of str
    """
    lines = []
    for head, rows in ((say("Ties"), _OF_TIES), (say("Friction"), _OF_FRICTION)):
        parts = []
        for words, name, factor, unit in rows:
            # 0 is none, of all but preload
            if (value := effective_property(wall, name)) is not None and (np.any(value) or name == "tie_preload"):
                numbers = dict.fromkeys(decimal(f"{factor * one:.4g}") for one in np.atleast_1d(value))
                parts.append(f"{say(words)} {(', ' if in_english() else say(' and ')).join(numbers)}{unit}")
        if parts:
            lines += textwrap.wrap(f"{head}: {'; '.join(parts)}", _ACROSS)
    return lines


def _tie(ax: Axes, at: Points, size: float, plate: float, text: str) -> None:
    """A tie from behind the wall, and the plate that anchors it."""
    behind = np.subtract(at, (at[0] + 1.4 * size, 0.0))
    ax.plot(*zip(behind, at, strict=True), color=style.BLACK, linewidth=1.4, linestyle=(0, (6, 2, 1, 2)), zorder=5)
    ax.plot([at[0], at[0]], [at[1] - 0.5 * plate, at[1] + 0.5 * plate], color=style.BLACK, linewidth=3.0, zorder=5)
    _words(ax, behind, text, (0, 3))


def _frustum(ax: Axes, wall: MasonryWall, tie: Tie, rotation: float) -> None:
    """The frustum of masonry that a plate would pull out, at 45 degrees."""
    if not (plate := tie.plate_height or tie.plate_diameter):
        return
    outer = tie.depth or 0.0
    leaf = tie.leaf or inner_face(wall, tie.height) - outer
    for way in (-1.0, 1.0):
        start = tie.height + 0.5 * way * plate
        depth = min(leaf, wall.height - start if way > 0.0 else start)
        ends = [_place(wall, outer, start, rotation), _place(wall, outer + depth, start + way * depth, rotation)]
        ax.plot(*np.transpose(ends), color=style.BLACK, linewidth=1.0, linestyle=":", zorder=5)


def _teeth(ax: Axes, wall: MasonryWall, stones: Any, rotation: float) -> None:
    """Stones that overlap those of a transverse wall; every tooth is several courses where they would not be seen."""
    step, overlap = wall.height / min(24, max(2, int(wall.height / stones.course))), stones.overlap
    for bottom in np.arange(0.0, wall.height - 1.5 * step, 2.0 * step):
        inner = inner_face(wall, bottom + 0.5 * step)
        corners = [(inner, bottom), (inner + overlap, bottom), (inner + overlap, bottom + step), (inner, bottom + step)]
        places = [_place(wall, depth, height, rotation) for depth, height in corners]
        ax.fill(*np.transpose(places), facecolor=style.BRICK, edgecolor=style.BLACK, linewidth=0.8, zorder=3)
    at = _place(wall, inner_face(wall, wall.height / 3.0) + overlap, wall.height / 3.0, rotation)
    _words(ax, at, say("friction"), (-4, -4), ha="right")


def _in_words(lifted: float, pushed: float) -> str:
    """Which parts of a load are masses that the wall moves."""
    if not lifted and not pushed:
        return say("dead")
    parts = ((lifted, say("lifted")), (pushed, say("pushed")))
    return ", ".join(what if part == 1.0 else decimal(f"{100.0 * part:.3g} % {what}") for part, what in parts if part)


def inner_face(wall: MasonryWall, height: float) -> float:
    """Depth of the inner face at a height, the innermost where storeys meet."""
    slack = 1e-6 * wall.height
    inner = [
        width_of(wall) - float(corners[0, 0])
        for corners in storeys(wall)
        if corners[0, 1] - slack <= height <= corners[2, 1] + slack
    ]
    return max(inner)


def _place(wall: MasonryWall, depth: float, height: float, rotation: float) -> Points:
    """Where a point of a wall is."""
    at: Points = moved(wall, np.array([[width_of(wall) - depth, height]]), abs(rotation))[0]
    # What rocks to both sides carries in its middle, or as a strip the mirror image: docs/theory.md, section 2
    return np.array([width_of(wall) - at[0], at[1]]) if rotation < 0.0 else at


def force_in_words(part: Load | Thrust) -> str:
    """The force of a load or a thrust, per metre of wall or in all."""
    return _with_prefix(part.force, "N/m") if part.force is not None else _with_prefix(part.total or 0.0, "N")


def _with_prefix(value: float, unit: str) -> str:
    """A value with a prefix of its unit."""
    factor, prefix = next((pair for pair in _PREFIXES if value >= pair[0]), _PREFIXES[-1])
    return decimal(f"{value / factor:.4g} {prefix}{unit}")


def _words(ax: Axes, at: Points, text: str, shift: tuple[float, float], ha: str = "left") -> None:
    """A value beside what it belongs to."""
    back = {"facecolor": "white", "edgecolor": "none", "alpha": 0.75, "pad": 0.6}
    ax.annotate(
        text,
        tuple(at),
        shift,
        textcoords="offset points",
        fontsize=theme().note,
        ha=ha,
        va="bottom",
        zorder=6,
        bbox=back,
    )


def _arrow_down(ax: Axes, at: Points, size: float, text: str, *, is_mass: bool) -> None:
    """A load, its arrow filled where a mass goes with it."""
    arrow = {
        "arrowstyle": "-|>,head_width=0.3,head_length=0.55",
        "edgecolor": style.BLUE,
        "facecolor": style.BLUE if is_mass else "white",
        "linewidth": 1.6,
    }
    ax.annotate("", tuple(at), tuple(np.add(at, (0.0, size))), arrowprops=arrow, zorder=5)
    _words(ax, np.add(at, (0.0, 0.6 * size)), text, (6, 0))


def _spring(ax: Axes, wall: MasonryWall, at: Points, size: float, text: str) -> None:
    """A spring between the wall and what stands still, behind it or before it."""
    away = 1.0 if at[0] > 0.5 * width_of(wall) else -1.0
    along = np.array([0.0, 0.2, 0.3, 0.5, 0.7, 0.9, 1.0, 1.2]) * size
    across = np.array([0.0, 0.0, 1.0, -1.0, 1.0, -1.0, 0.0, 0.0]) * 0.14 * size
    ax.plot(at[0] + away * along, at[1] + across, color=style.BLACK, linewidth=1.0, zorder=5)
    if text:
        _words(ax, np.add(at, (away * along[-1], 0.0)), text, (4 * away, -3), ha="left" if away > 0.0 else "right")
