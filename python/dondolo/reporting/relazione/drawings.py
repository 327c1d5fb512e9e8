"""Drawings of a calculation report, in greys that survive a photocopy, with words of its language."""

from __future__ import annotations

import math
from dataclasses import fields, replace
from typing import TYPE_CHECKING, Any

import numpy as np

from dondolo._fortran.checks import capacity_curve
from dondolo.checks.plots import draw_safety
from dondolo.figures import style
from dondolo.figures.layout import apart
from dondolo.figures.options import Options
from dondolo.records.building import Building
from dondolo.records.codes import LimitState
from dondolo.reporting.relazione.document import Document, _
from dondolo.reporting.relazione.floors import building_in
from dondolo.reporting.relazione.subjects import Subject
from dondolo.reporting.relazione.sums import is_held, reactions_of, taken_of, ties_left_out, without_of
from dondolo.reporting.relazione.tabulated import Terms
from dondolo.walls.chains import Chain
from dondolo.walls.mechanisms import TabulatedWall, TwoBlockWall
from dondolo.walls.parts import parts_of
from dondolo.walls.shape import shape, width_of
from dondolo.walls.wall import MasonryWall, Wall, upload

if TYPE_CHECKING:
    from matplotlib.axes import Axes

# Damping ratios of the nonlinear checks
_DAMPINGS = {"SLV": 0.08, "SLC": 0.10}
_STATES: tuple[LimitState, ...] = ("SLD", "SLV", "SLC")
_DARK, _MIDDLE, _PALE, _LINES = "#000000", "#6e6e6e", "#e2e2e2", ("-", "--", ":", "-.", (0, (5, 1)), (0, (1, 1)))
_POINTS = 400
_CENTIMETRES = 100.0
# A curve beyond its levels
_BEYOND: dict[str, Any] = {"color": _MIDDLE, "linestyle": (0, (2, 2)), "linewidth": 0.9}
# Sizes of the words in the scheme of the mechanism, which pages show at two thirds of its size
_WORDS, _TITLES = 9.0, 10.5
# Height of a line of words in that scheme / height of the wall
_ROW = 0.055
# Least rotation that is drawn [rad]
_SEEN = 0.08


def _axes(document: Document, size: tuple[float, float], columns: int = 1) -> Any:
    """Axes whose numbers have the decimal mark of the language."""
    from matplotlib.ticker import FuncFormatter

    made = style.new_axes(1, size, columns)
    for ax in np.ravel(made):
        for axis in (ax.xaxis, ax.yaxis):
            axis.set_major_formatter(FuncFormatter(lambda value, place: document.language.decimal(f"{value:.6g}")))
    return made


def draw_wall(document: Document, one: Subject) -> Any:
    """A wall at rest with the items of its table, and displaced with the reactions at its hinge."""
    rest, moved = _axes(document, (6.6, 4.2), 2)
    wall = one.checked
    assert isinstance(wall, MasonryWall)
    rotation = 0.45 * wall.capacity_angle
    if not isinstance(wall, TwoBlockWall):
        rotation = max(rotation, _SEEN)
    now, later = shape(wall, 0.0), shape(wall, rotation)
    hinge, behind = now.hinges[0], -min(float(block[:, 0].min()) for block in now.blocks)
    width = width_of(wall)
    reach = max(1.3 * width, 0.26 * wall.height, behind)
    for ax in (rest, moved):
        for block in now.blocks:
            ax.fill(*block.T, facecolor=_PALE if ax is rest else "none", edgecolor=_DARK if ax is rest else _MIDDLE,
                    linewidth=0.9, linestyle="-" if ax is rest else "--")  # fmt: skip
        ax.plot([-0.85 * reach, width + reach], [0.0, 0.0], color=_DARK, linewidth=1.4)
        ax.set_aspect("equal")
        ax.axis("off")
        ax.set_xlim(-1.3 * reach, width + 1.5 * reach)
        ax.set_ylim(-0.13 * wall.height, 1.14 * wall.height)
    for block in later.blocks:
        moved.fill(*block.T, facecolor=_PALE, edgecolor=_DARK, linewidth=0.9)
    for ax, points in ((rest, now.hinges), (moved, later.hinges)):
        ax.plot(*points.T, linestyle="none", marker="o", markersize=5, color=_DARK, zorder=5)
    _dimensions(document, rest, one, reach)
    _items(document, rest, one, reach)
    base = later.hinges[0]
    if not isinstance(wall, TwoBlockWall):
        forces, unit = reactions_of(one), one.unit("N/m").name
        _arrow(moved, base, (base[0], -0.11 * wall.height), f"V = {_kilo(document, forces.vertical)} {unit}", up=True)
        words = f"H = {_kilo(document, abs(forces.activated))} {unit}"
        # The base holds the wall against the force that it takes from it: below the ground, clear of the hinge.
        side, low = 1.0 if forces.activated >= 0.0 else -1.0, -0.05 * wall.height
        start = (base[0] + side * 0.6 * reach, low)
        moved.annotate("", (base[0] + side * 0.08 * reach, low), start, arrowprops=_ARROW)
        moved.annotate(words, start, (4.0 * side, 0), textcoords="offset points", ha="left" if side > 0.0 else "right",
                       va="center", fontsize=_WORDS)  # fmt: skip
    rest.set_title(document.text(_("at rest")), fontsize=_TITLES)
    moved.set_title(document.text(_("displaced, not to scale")), fontsize=_TITLES)
    rest.annotate(document.text(_("hinge")), hinge, (6, -11), textcoords="offset points", fontsize=_WORDS)
    return rest


def draw_table(document: Document, one: Subject) -> Any:
    """Moment and lever of a tabulated wall over its rotation, as the steps have them, and the rows of its table."""
    panels = _axes(document, (6.6, 2.8), 2)
    assert isinstance(one.wall, TabulatedWall)
    terms = Terms(one)
    rotations = np.linspace(0.0, terms.rotation[-1], _POINTS)
    for ax, name in zip(panels, ("M", "S"), strict=True):
        ax.plot(rotations, [1e-3 * terms.at(name, rotation) for rotation in rotations], color=_DARK)
        ax.plot(terms.rotation, 1e-3 * terms.columns[name], color=_MIDDLE, linestyle="none", marker="o", markersize=3.5,
                markerfacecolor="none")  # fmt: skip
        ax.set_ylim(bottom=0.0)
        ax.set_xlabel("θ [rad]")
        ax.set_ylabel(f"{name} [kNm/m]")
    return panels[0]


_SIZE = {
    "arrowstyle": "|-|, widthA=0.25, widthB=0.25", "color": _MIDDLE, "linewidth": 0.7, "shrinkA": 0.0, "shrinkB": 0.0,
}  # fmt: skip
_ARROW = {"arrowstyle": "-|>", "color": _DARK, "linewidth": 1.1, "shrinkA": 0.0, "shrinkB": 0.0}


def _kilo(document: Document, value: float) -> str:
    """A force in kN/m or kN, in characters."""
    return document.language.decimal(f"{1e-3 * value:.4g}")


def _arrow(ax: Axes, to: Any, start: Any, words: str, *, up: bool = False) -> None:
    ax.annotate("", to, start, arrowprops=_ARROW)
    ax.annotate(words, start, (5, -2 if up else 1), textcoords="offset points", fontsize=_WORDS, va="center")


def _dimensions(document: Document, ax: Axes, one: Subject, reach: float) -> None:
    """Heights of the storeys and thicknesses, in centimetres, beyond what pushes and holds the wall."""
    wall = one.checked
    assert isinstance(wall, MasonryWall)
    x, bottom = -1.05 * reach, 0.0
    parts = getattr(wall, "sections", ()) or ()
    sizes = [(part.height, part.thickness) for part in parts] or [(wall.height, width_of(wall))]
    right = width_of(wall)
    if isinstance(wall, TwoBlockWall):
        middle = wall.hinge * wall.height
        sizes = [(middle, right), (wall.height - middle, right)]
    for height, thickness in sizes:
        ax.annotate("", (x, bottom), (x, bottom + height), arrowprops=_SIZE)
        words = document.language.decimal(f"{_CENTIMETRES * height:.5g}")
        ax.annotate(words, (x, bottom + 0.5 * height), (-3, 0), textcoords="offset points", rotation=90, ha="right",
                    va="center", fontsize=_WORDS)  # fmt: skip
        words = document.language.decimal(f"{_CENTIMETRES * thickness:.5g}")
        ax.annotate(words, (right - 0.5 * thickness, bottom + 0.12 * height), ha="center", fontsize=_WORDS)
        bottom += height
    ax.annotate("cm", (x, -0.06 * one.wall.height), ha="center", fontsize=_WORDS)


# Letters of the items; of what is not among them P
_LETTERS = {"load": "N", "mass": "Q", "thrust": "H", "tie": "T", "friction": "F", "wedge": "C", "wing": "A"}
# Blocks of a strip: their weights, and whether the hinge is below them
_BLOCKS = {"lower block": ("P1", 0.0), "upper block": ("P2", 1.0)}
# Fields of a wall with the parts that items stand for
_PARTS_OF = {"load": "loads", "mass": "inertial_masses", "thrust": "thrusts", "tie": "ties"}


def _items(document: Document, ax: Axes, one: Subject, reach: float) -> None:
    """Weights, thrusts and ties where they act; words beside the wall keep clear of each other."""
    wall = one.checked
    assert isinstance(wall, MasonryWall)
    right = width_of(wall)
    labels: list[tuple[float, str]] = []
    for item in one.check.items:
        if item.item in _BLOCKS and isinstance(wall, TwoBlockWall):
            name, share = _BLOCKS[item.item]
            z = wall.height * (0.5 * wall.hinge + share * 0.5)
            ax.plot(0.5 * right, z, marker="+", markersize=8, color=_DARK)
            labels.append((z, f"{name} = {_kilo(document, item.force)}"))
        if item.item == "load on top" and isinstance(wall, TwoBlockWall):
            x = 0.5 * right + (wall.eccentricity or 0.0)
            ax.annotate("", (x, wall.height), (x, 1.09 * wall.height), arrowprops=_ARROW)
            ax.annotate(f"N = {_kilo(document, item.force)}", (x, 1.05 * wall.height), (6, 0),
                        textcoords="offset points", fontsize=_WORDS)  # fmt: skip
        # Both wings of a corner stand behind each other
        if item.item in ("masonry", "wing 2") or np.isnan(item.depth):
            continue
        word, _blank, count = item.item.rpartition(" ")
        letter = _LETTERS.get(word, "P")
        words = f"{letter}{count} = {_kilo(document, item.force)}"
        if word == "wing":
            words = f"{letter}1 = {letter}2 = {_kilo(document, item.force)}"
        x, z = right - item.depth, item.lever
        if isinstance(wall, TwoBlockWall):
            # The lever of what is on the upper block is no height
            z = parts_of(wall, _PARTS_OF[word])[int(count) - 1].height
        if word == "thrust":
            _arrow(ax, (x, z), (-0.7 * reach, z), "")
            ax.annotate(words, (-0.7 * reach, z), (0, -9), textcoords="offset points", fontsize=_WORDS)
        elif is_held(item):
            ax.plot([right, -0.75 * reach], [z, z], color=_DARK, linewidth=1.4)
            ax.plot(
                [right + 0.02, right + 0.02], [z - 0.03 * wall.height, z + 0.03 * wall.height], color=_DARK, linewidth=3
            )
            labels.append((z - 0.02 * wall.height, words))
        elif word in ("section", "wedge", "corner", "wing"):
            ax.plot(x, z, marker="+", markersize=8, color=_DARK)
            labels.append((z, words))
        else:
            ax.annotate("", (x, z), (x, z + 0.09 * wall.height), arrowprops=_ARROW)
            labels.append((z + 0.06 * wall.height, words))
    labels.sort()
    for z, (_level, words) in zip(apart([at for at, _words in labels], _ROW * wall.height), labels, strict=True):
        ax.annotate(words, (right + 0.06, z), (4, 0), textcoords="offset points", fontsize=_WORDS, va="center")
    ax.annotate(one.unit("N/m").name, (right + 0.9 * reach, -0.11 * wall.height), ha="center", fontsize=_WORDS)


def draw_capacity(document: Document, one: Subject) -> Any:
    """The curve of capacity, and the demand of SLV and SLC at their damping, in acceleration and displacement."""
    ax = _axes(document, (6.0, 3.6))
    check, wall = one.check, one.wall
    factor = check.value("mechanism", "SLV", "knowledge_factor")
    d, a = capacity_curve(upload((wall,)), factor, _POINTS)
    ax.plot(_CENTIMETRES * d, a, color=_DARK, linewidth=1.8, label=document.text(_("capacity, a(d)")))
    for ties in dict.fromkeys(filter(None, (without_of(one, state) for state in ("SLV", "SLC")))):
        less = capacity_curve(upload((_without(one, ties),)), factor, _POINTS)
        words = document.text(_("capacity without {ties}"), ties=document.the_item(ties))
        ax.plot(_CENTIMETRES * less[0], less[1], color=_DARK, linewidth=1.2, linestyle=(0, (5, 1)), label=words)
    longest = 0.0
    lines: tuple[tuple[LimitState, str], ...] = (("SLV", "--"), ("SLC", ":")) if one.has_ratios else ()
    for state, line in lines:
        method = taken_of(one, state)
        reached, period = (check.value(method, state, name) for name in ("displacement", "period"))
        height = check.value(method, state, "acceleration")
        longest = max(longest, reached, check.value(method, state, "demand"))
        periods = np.geomspace(0.02, max(4.0, 1.3 * period), _POINTS)
        building = building_in(one, state, method)
        demand = check.site.spectrum(periods=periods, damping=_DAMPINGS[state], limit_state=state, building=building).sa
        words = document.text(_("demand, {state}"), state=state)
        if not _is_demand_of(one, state, period, building):
            # The code's spectrum of a strip is that between its floors: of it only the point at T is at hand.
            ax.plot(_CENTIMETRES * check.value(method, state, "demand"),
                    wall.gravity * check.value(method, state, "spectral_demand"),
                    marker="^" if state == "SLV" else "v", color=_MIDDLE, linestyle="none", label=words)  # fmt: skip
            continue
        ax.plot(_CENTIMETRES * wall.gravity * demand * (periods / (2.0 * np.pi)) ** 2, wall.gravity * demand,
                color=_MIDDLE, linestyle=line, label=words)  # fmt: skip
        ax.plot(_CENTIMETRES * reached, height, marker="o" if state == "SLV" else "s", color=_DARK, linestyle="none",
                label=document.text(_("capacity of displacement, {state}"), state=state))  # fmt: skip
    ax.set_xlim(0.0, _CENTIMETRES * max(1.02 * d[-1], 1.1 * longest))
    ax.set_ylim(bottom=0.0)
    ax.set_xlabel("d [cm]")
    ax.set_ylabel("a [m/s²]")
    style.legend(ax, Options({}))
    return ax


def _is_demand_of(one: Subject, state: LimitState, period: float, building: Building | None) -> bool:
    """Whether the spectrum of a building, or of the ground, is that of the check."""
    spectrum = one.check.site.spectrum(
        periods=[period, 1.01 * period], damping=_DAMPINGS[state], limit_state=state, building=building
    )
    return math.isclose(spectrum.sa[0], one.check.value(taken_of(one, state), state, "spectral_demand"), rel_tol=1e-9)


def _without(one: Subject, name: str) -> Wall:
    """The wall of a curve that does not count some ties."""
    left_out = ties_left_out(one, name)
    if isinstance(one.wall, Chain):
        rows = one.wall._rows("tie_table")
        kept = [row for place, row in enumerate(rows.tolist(), 1) if f"tie {place}" not in left_out]
        return replace(one.wall, tie_table=[number for row in kept for number in row] or None)
    ties = [tie for place, tie in enumerate(parts_of(one.wall, "ties")) if f"tie {place + 1}" not in left_out]
    assert isinstance(one.wall, MasonryWall)
    has_plates = any(tie.plate_width is not None or tie.plate_diameter is not None for tie in ties)
    # Without plates the strengths of the masonry behind them are refused.
    masonry = [field.name for field in fields(one.wall) if field.name.startswith("masonry_") and not has_plates]
    given: dict[str, Any] = {"ties": ties, **dict.fromkeys(masonry)}
    wall = replace(one.wall, **given)
    hinges = [row.value for row in one.check.rows if (row.method, row.item, row.quantity) == ("untied", name, "hinge")]
    return replace(wall, hinge=hinges[0]) if hinges else wall  # type: ignore[call-arg]


def draw_floor(document: Document, one: Subject) -> Any:
    """The spectrum of the floor at SLV, with the building that the demand has and as it is given, and of the ground."""
    ax = _axes(document, (6.0, 3.1))
    check, state = one.check, "SLV"
    method = taken_of(one, state)
    period = check.value(method, state, "period")
    periods = np.linspace(0.0, max(2.0, 1.3 * period), _POINTS)[1:]
    building, given = building_in(one, "SLV", method), building_in(one, "SLV")
    assert building is not None
    assert given is not None

    def drawn(of: Building | None, words: str, **look: Any) -> None:
        found = check.site.spectrum(periods=periods, damping=_DAMPINGS["SLV"], building=of)
        ax.plot(periods, found.sa, label=words, **look)

    first = document.language.decimal(f"{max(building.periods):.3g}")
    drawn(building, document.text(_("floor, building with T = {period} s"), period=first), color=_DARK, linewidth=1.8)
    if building.periods != given.periods:
        first = document.language.decimal(f"{max(given.periods):.3g}")
        words = document.text(_("floor, building with T = {period} s"), period=first)
        drawn(given, words, color=_MIDDLE, linestyle="--")
    drawn(None, document.text(_("ground")), color=_MIDDLE, linestyle=":")
    ax.plot(period, check.value(method, state, "spectral_demand"), marker="o", color=_DARK, linestyle="none",
            label=style.in_math("S_eZ(T_SLV)"), gid=style.FORMULA)  # fmt: skip
    ax.axvline(period, color=_MIDDLE, linewidth=0.8)
    ax.set_xlim(0.0, periods[-1])
    ax.set_ylim(bottom=0.0)
    ax.set_xlabel("T [s]")
    ax.set_ylabel(style.in_math("S_eZ [g]"))
    style.legend(ax, Options({}))
    return ax


def draw_anchor(document: Document, one: Subject, item: str) -> Any:
    """The plate of a tie: in section, where the frustum grows by the depth on each side, and from the front."""
    ax, front = _axes(document, (6.6, 3.4), 2)
    found = {row.quantity: row.value for row in one.check.rows if (row.method, row.item) == ("tie", item)}
    round_plate = found.get("plate_diameter", 0.0)
    width, height = (round_plate or found[name] for name in ("plate_width", "plate_height"))
    depth, thick = found["masonry_thickness"], found.get("plate_thickness") or 0.04 * found["masonry_thickness"]
    # A frustum that meets the top of the wall ends there.
    above = min(depth, found.get("edge_distance", depth))
    top, bottom, reach = 0.5 * height + above, -0.5 * height - depth, 0.5 * width + depth
    is_cut = above < depth
    # Section: the inner face is at 0, the plate outside
    floor, roof = 1.15 * bottom, top if is_cut else 1.15 * top
    ax.fill([0.0, depth, depth, 0.0], [floor, floor, roof, roof], facecolor="none", edgecolor=_MIDDLE, linewidth=0.8)
    outline = [depth, depth - min(above, depth), 0.0, 0.0, depth], [0.5 * height, top, top, bottom, -0.5 * height]
    ax.fill(*outline, facecolor=_PALE, edgecolor=_DARK, linestyle="--", linewidth=0.9)
    ax.fill([depth, depth + thick, depth + thick, depth], [-0.5 * height, -0.5 * height, 0.5 * height, 0.5 * height],
            facecolor=_DARK)  # fmt: skip
    ax.plot([-0.5 * depth, depth + 2.0 * thick], [0.0, 0.0], color=_DARK, linewidth=1.6)
    ax.annotate("45°", (0.55 * depth, -0.5 * height - 0.2 * depth), fontsize=7.5, ha="center")
    circle = np.linspace(0.0, 2.0 * np.pi, 181)
    faces = ((reach, (bottom, top), _PALE, "--"), (0.5 * width, (-0.5 * height, 0.5 * height), _DARK, "-"))
    for half, (least, most), face, line in faces:
        x, y = np.array([-half, half, half, -half]), np.array([least, least, most, most])
        if round_plate:
            x, y = half * np.cos(circle), np.minimum(half * np.sin(circle), most)
        front.fill(x, y, facecolor=face, edgecolor=_DARK, linestyle=line, linewidth=0.9)
    size = document.language.decimal
    sizes = [(ax, (0.0, depth), f"t = {size(f'{_CENTIMETRES * depth:.4g}')}")]
    name = "D" if round_plate else "a"
    sizes.append((front, (-0.5 * width, 0.5 * width), f"{name} = {size(f'{_CENTIMETRES * width:.4g}')}"))
    if found["shear_force"] == found["anchor_force"]:
        _shear_surface(ax, front, (width, height, depth), above, is_round=bool(round_plate))
        sizes.append((front, (0.5 * width, 0.5 * (width + depth)), "t/2"))
    low = 1.28 * bottom
    for panel, (start, end), words in sizes:
        panel.annotate("", (start, low), (end, low), arrowprops=_SIZE)
        panel.annotate(
            words, (0.5 * (start + end), low), (0, -9), textcoords="offset points", ha="center", fontsize=7.5
        )
    beside = depth + 4.0 * thick
    heights = [((-0.5 * height, 0.5 * height), height, "D" if round_plate else "b")]
    if is_cut:
        heights.append(((0.5 * height, top), above, "c"))
        for panel, ends in ((ax, (-0.5 * depth, beside)), (front, (-1.05 * reach, 1.05 * reach))):
            panel.plot(ends, [top, top], color=_DARK, linewidth=1.4)
        ax.annotate(document.text(_("top of the wall")), (-0.5 * depth, top), (0, 3), textcoords="offset points",
                    fontsize=7.5)  # fmt: skip
    for (start, end), length, name in heights:
        ax.annotate("", (beside, start), (beside, end), arrowprops=_SIZE)
        ax.annotate(f"{name} = {size(f'{_CENTIMETRES * length:.4g}')}", (beside, 0.5 * (start + end)), (4, 0),
                    textcoords="offset points", fontsize=7.5, va="center")  # fmt: skip
    names = {
        "bar_force": _("bar"), "bearing_force": _("bearing"), "shear_force": _("shear"), "cone_force": _("frustum"),
        "band_force": _("band"),
    }  # fmt: skip
    lines = [f"{document.text(words)} {_kilo(document, found[one])} kN" for one, words in names.items() if one in found]
    front.annotate("\n".join(lines), (1.1 * reach, -0.3 * depth), fontsize=7.5, va="center")
    # One scale: the panels have the same ends, and their titles one height.
    room, middle = 3.3 * reach, 0.5 * depth
    for panel, words, left, at in (
        (ax, _("section"), middle - 0.5 * room, middle),
        (front, _("front"), -1.05 * reach, 0.0),
    ):
        panel.set_aspect("equal")
        panel.axis("off")
        panel.set_xlim(left, left + room)
        panel.set_ylim(1.5 * bottom, roof + 0.35 * depth)
        panel.annotate(document.text(words), (at, roof), (0, 16), textcoords="offset points", ha="center", fontsize=9)
    return ax


def _shear_surface(ax: Axes, front: Axes, sizes: tuple[float, float, float], above: float, *, is_round: bool) -> None:
    """The surface at t/2 round a plate: where the top of the wall is nearer the upper face is missing.

    Parameters
    ----------
    ax, front : Axes
        Section and front.
    sizes : tuple
        Width and height of the plate, or twice its diameter, and thickness of the masonry.
    above : float
        Distance from the plate to the top of the wall, or the thickness if that is farther.
    is_round : bool
        Whether the plate is circular: at the top half of its surface is left.
    """
    width, height, depth = sizes
    look: dict[str, Any] = {"color": _DARK, "linestyle": ":", "linewidth": 1.5}
    is_open = above < 0.5 * depth
    half, least = 0.5 * (width + depth), -0.5 * (height + depth)
    most = 0.5 * height + above if is_open else -least
    for level in (least,) if is_open else (least, most):
        ax.plot([0.0, depth], [level, level], **look)
    if is_round:
        angle = np.linspace(-np.pi if is_open else 0.0, 0.0 if is_open else 2.0 * np.pi, 181)
        front.plot(half * np.cos(angle), half * np.sin(angle), **look)
        return
    x, y = [-half, -half, half, half], [most, least, least, most]
    front.plot(x if is_open else [*x, -half], y if is_open else [*y, most], **look)


def draw_spectra(document: Document) -> Any:
    """Elastic spectra of the limit states, with the equivalent periods of the first wall."""
    ax = _axes(document, (6.0, 3.1))
    check = document.subjects.several[0].check
    periods = np.linspace(0.0, 4.0, _POINTS)[1:]
    states = _STATES if len(check.site.hazard.ag) > 1 else ("SLV",)
    for state, line in zip(states, _LINES, strict=False):
        ax.plot(periods, check.site.spectrum(periods=periods, limit_state=state).sa, color=_DARK, linestyle=line,
                label=state if len(states) > 1 else None)  # fmt: skip
    ax.set_xlabel("T [s]")
    ax.set_ylabel(style.in_math("S_e [g]"))
    ax.set_xlim(0.0, 4.0)
    ax.set_ylim(bottom=0.0)
    if len(states) > 1:
        style.legend(ax, Options({}))
    return ax


def draw_fragility(document: Document) -> Any:
    """Fragility curves of the walls, with the peak acceleration of the site."""
    ax = _axes(document, (6.0, 3.4))
    named = [(name, one.curve) for name, one in document.each()]
    if document.subjects.facade and document.subjects.union is not None:
        named.append((document.subjects.facade, document.subjects.union))
    drawn = [(name, curve) for name, curve in named if curve is not None and curve.has_fit]
    pga = document.subjects.several[0].check.pga
    right = max([1.2 * pga, *(float(curve.ppf(0.98)) for _name, curve in drawn)])
    is_beyond = False
    for place, (name, curve) in enumerate(drawn):
        last = float(np.max(curve.levels, initial=0.0))
        x = np.linspace(0.0, min(last, right), _POINTS)[1:]
        ax.plot(x, curve(x), color=_DARK, linestyle=_LINES[place % len(_LINES)], linewidth=1.5, label=name)
        if last < right:
            x, is_beyond = np.linspace(last, right, _POINTS), True
            ax.plot(x, curve(x), **_BEYOND)
    if is_beyond:
        ax.plot([], [], label=document.text(_("beyond the highest level")), **_BEYOND)
    words = document.text(_("a_g S of the site, SLV"))
    ax.axvline(pga, color=_MIDDLE, linewidth=1.0, linestyle=(0, (6, 3)), label=style.in_math(words), gid=style.FORMULA)
    ax.set_xlim(0.0, right)
    ax.set_ylim(0.0, 1.0)
    ax.set_xlabel("PGA [g]")
    ax.set_ylabel(document.text(_("probability of collapse")))
    style.legend(ax, Options({}))
    return ax


def draw_indices(document: Document) -> Any:
    """Safety indices of the states."""
    several = document.each()
    ax = _axes(document, (6.0, 0.6 + 0.6 * len(several)))
    words = {
        (method, state): f"{document.text(name)} {state}"
        for method, state, name in (
            ("linear", "SLV", _("linear")), ("nonlinear", "SLV", _("nonlinear")), ("nonlinear", "SLC", _("nonlinear")),
        )
    }  # fmt: skip
    draw_safety(ax, [name for name, _one in several], [one.check for _name, one in several], words,
                document.language.decimal, (_DARK, _MIDDLE, _PALE))  # fmt: skip
    style.legend(ax, Options({}))
    return ax
