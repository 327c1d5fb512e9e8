"""Chains of rigid bodies in a calculation report: their drawing, what they are made of, and the steps to the capacity.

Places of the bodies over the rotation are those of the code; the moment, the lever and the displacement that follow
from them and from the weights of the table of the calculation are made here again. Steps are shown only if they give
the numbers of the check.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np
from numpy.polynomial import Chebyshev

from dondolo._base.arguments import FloatArray
from dondolo._fortran.walls import chain_facts
from dondolo.figures import style
from dondolo.reporting.blocks import Block, CaptionedTable, Picture, symbol_of
from dondolo.reporting.content import Piece, Table
from dondolo.reporting.numerals import number
from dondolo.reporting.relazione.document import Document, _
from dondolo.reporting.relazione.subjects import Subject
from dondolo.reporting.relazione.sums import of_tie
from dondolo.reporting.units import UNITS, Unit, cell
from dondolo.walls.chain_parts import Point
from dondolo.walls.chains import Chain, ChainMotion, ChainWall
from dondolo.walls.drawing_chain import ends_of_ties
from dondolo.walls.ties import ties_of
from dondolo.walls.wall import upload

# Rotations at which a chain is looked at, less one, and the degree of the polynomials through them
_NODES, _DEGREE = 48, 32
# How near forces and elongations are that are the same
_SAME = 1e-9
# Share of the capacity at which a chain is drawn
_DRAWN = 0.7
_DARK, _MIDDLE, _PALE, _STILL = "#000000", "#6e6e6e", "#e2e2e2", "#c4c4c4"
_WORDS, _TITLES = 8.5, 10.5
_ARROW = {"arrowstyle": "-|>", "color": _DARK, "linewidth": 1.1, "shrinkA": 0.0, "shrinkB": 0.0}
_TONNES = Unit("t", 1e-3)
# Letters of what acts on a chain, as items of the calculation name it
_LETTERS = {"load": "N", "mass": "Q", "thrust": "H"}


def named_actions(wall: ChainWall) -> list[tuple[str, FloatArray]]:
    """The rows of what acts on bodies that move, each with its item in the calculation."""
    found, counts = [], dict.fromkeys(_LETTERS, 0)
    for row in wall._rows("action_table"):
        if row[0] < 1.0:
            continue
        word = "load" if row[3] > 0.0 else "mass" if row[6] > 0.0 else "thrust"
        counts[word] += 1
        found.append((f"{word} {counts[word]}", row))
    return found


def terms_of_chain(one: Subject) -> tuple[FloatArray, dict[str, FloatArray]]:
    """Rotations up to the capacity, and over them the moment M, the lever S = ΣP x' and the displacement d."""
    wall = one.wall
    assert isinstance(wall, ChainWall)
    rotation = 0.5 * wall.capacity_angle * (1.0 - np.cos(np.pi * np.arange(_NODES + 1) / _NODES))
    at = wall.motion(rotation)
    actions = dict(named_actions(wall))
    weights, first, places = [], [], []
    for item in one.check.items:
        if np.isnan(item.force_lever):
            continue
        word, _blank, count = item.item.partition(" ")
        if word == "body":
            x = at.x[:, int(count) - 1]
        else:
            row = actions[item.item]
            x = _places(at, int(row[0]), (-row[1], row[2]))[:, 0]
        weights.append(item.force)
        first.append(item.force * item.lever)
        places.append(x - x[0])
    # Towards the side whose terms are used
    side = np.sign(np.dot(first, [place[-1] for place in places]))
    moved = Chebyshev.fit(rotation, side * np.dot(weights, places), _DEGREE, domain=[0.0, rotation[-1]])
    # Ties are added where they hold.
    terms = (replace(wall, tie_table=None) if isinstance(wall, Chain) else wall).terms(rotation)
    columns = {
        "M": np.asarray(terms.restoring_moment - terms.load_force),
        "S": moved.deriv()(rotation),
        "d": side * np.dot(first, places) / np.sum(first),
    }
    return rotation, columns


class TieOfChain(NamedTuple):
    """A tie of a chain over the rotation.

    Attributes
    ----------
    force : float
        Its largest force [N].
    travel : Chebyshev
        How much longer it gets [m].
    fracture : float
        The same where it breaks [m].
    """

    force: float
    travel: Chebyshev
    fracture: float

    def moment(self, rotation: float) -> float:
        """What it adds to the moment that holds a chain which is pushed out for the first time [N m]."""
        if self.travel(rotation) > self.fracture * (1.0 + _SAME):
            return 0.0
        return float(self.force * self.travel.deriv()(rotation))


def ties_over(one: Subject, rotation: FloatArray) -> list[TieOfChain]:
    """The ties of a chain, by the places of their ends at some rotations."""
    wall = one.wall
    assert isinstance(wall, ChainWall)
    at = wall.motion(rotation)
    items = [item for item in one.check.items if item.item.startswith("tie")]
    found = []
    for row, bar, item in zip(wall._rows("tie_table"), ties_of(wall), items, strict=True):
        near = _places(at, int(row[0]), (-row[2], row[3]))
        if row[1] > 0.0:
            length = np.linalg.norm(near - _places(at, int(row[1]), (-row[5], row[6])), axis=1)
            travel = length - length[0]
        else:
            angle = np.radians(row[4])
            travel = (near - near[0]) @ [np.cos(angle), np.sin(angle)]
        strain, preload, modulus, strength = (
            of_tie(bar, name) for name in ("strain", "preload", "modulus", "strength")
        )
        is_brittle = item.force < (1.0 - _SAME) * strength * bar.section
        stretched = item.force / bar.section / modulus if is_brittle else strain
        curve = Chebyshev.fit(rotation, travel, _DEGREE, domain=[0.0, rotation[-1]])
        found.append(TieOfChain(item.force, curve, (stretched - preload / modulus) * bar.length))
    return found


def _places(at: ChainMotion, body: int, point: Point) -> FloatArray:
    """Places of a point of a body at some rotations, of which the first is at rest."""
    k = body - 1
    across, up = point[0] - at.x[0, k], point[1] - at.y[0, k]
    c, s = np.cos(at.turn[:, k]), np.sin(at.turn[:, k])
    return np.column_stack([at.x[:, k] + across * c + up * s, at.y[:, k] + up * c - across * s])


def scheme(document: Document, one: Subject, name: str) -> list[Block]:
    """The drawing of a chain, and the tables of its bodies, joints and actions."""
    assert isinstance(one.wall, ChainWall)
    picture = Picture(
        lambda: draw_chain(document, one),
        document.titled(document.text(_("Bodies, hinges and loads; the mechanism displaced")), name),
        document.text(_("The chain at rest with its loads, and displaced.")),
    )
    tables = [_bodies(document, one, name), _joints(document, one.wall, name), *_actions(document, one.wall, name)]
    return [picture, *tables, *_plane(document, one.wall), *_sides(document, one.wall)]


def _bodies(document: Document, one: Subject, name: str) -> CaptionedTable:
    """Masses and centroids."""
    assert isinstance(one.wall, ChainWall)
    rest = one.wall.motion(0.0)
    items = [item for item in one.check.items if item.item.startswith("body ")]
    columns: dict[Piece, Any] = {
        document.text(_("body")): [str(k) for k in range(1, len(items) + 1)],
        document.text(_("mass [t]")): [cell(item.force / one.wall.gravity, _TONNES, 5) for item in items],
        document.text(_("depth of the centroid [m]")): [number(-float(x) + 0.0, 5) for x in rest.x],
        document.text(_("height of the centroid [m]")): [number(float(y), 5) for y in rest.y],
    }
    caption = document.titled(document.text(_("Rigid bodies that move")), name)
    return CaptionedTable(Table.of(columns), caption)


def _joints(document: Document, wall: ChainWall, name: str) -> CaptionedTable:
    """Hinges and guides."""
    stands = bool((wall._rows("body_table")[:, 0] == 0.0).any())
    still = document.text(_("ground, or masonry that stands still") if stands else _("ground"))

    def body(value: float) -> str:
        return still if value == 0.0 else document.text(_("body {count}"), count=int(value))

    rows = wall._rows("joint_table")
    kinds = [
        document.text(_("hinge"))
        if row[0] == 2.0
        else document.text(
            _("guide, holds the direction at {angle}°"), angle=document.language.decimal(f"{row[5]:.4g}")
        )
        for row in rows
    ]
    columns: dict[Piece, Any] = {
        document.text(_("joint")): kinds,
        document.text(_("between")): [f"{body(row[1])}, {body(row[2])}" for row in rows],
        document.text(_("depth [m]")): [number(float(row[3]), 5) for row in rows],
        document.text(_("height [m]")): [number(float(row[4]), 5) for row in rows],
    }
    words = [document.text(_("between"))]
    return CaptionedTable(Table.of(columns, words), document.titled(document.text(_("Joints of the chain")), name))


def _actions(document: Document, wall: ChainWall, name: str) -> list[CaptionedTable]:
    """What acts on the bodies that move."""
    rows = named_actions(wall)
    if not rows:
        return []

    def kind(row: FloatArray) -> str:
        if row[7] > 0.0:
            return document.text(_("thrust at {angle}°"), angle=document.language.decimal(f"{row[8]:.4g}"))
        if row[6] > 0.0:
            return document.text(_("mass that is pushed"))
        moved = (
            _("with its mass, pushed and lifted") if row[5] > 0.0
            else _("with its mass, lifted alone") if row[4] > 0.0
            else _("force without mass")
        )  # fmt: skip
        return document.text(moved) + (f", {document.text(_('held sideways'))}" if row[9] > 0.0 else "")

    force = UNITS["N"]
    columns: dict[Piece, Any] = {
        document.text(_("item")): [document.item(item) for item, _row in rows],
        document.text(_("on")): [document.text(_("body {count}"), count=int(row[0])) for _item, row in rows],
        document.text(_("depth [m]")): [number(float(row[1]), 5) for _item, row in rows],
        document.text(_("height [m]")): [number(float(row[2]), 5) for _item, row in rows],
        document.text(_("force [kN]")): [
            cell(float(row[3] or row[7] or row[6] * wall.gravity), force, 5) for _item, row in rows
        ],
        document.text(_("kind")): [kind(row) for _item, row in rows],
    }
    words = [document.text(word) for word in (_("on"), _("kind"))]
    return [CaptionedTable(Table.of(columns, words), document.titled(document.text(_("Actions on the chain")), name))]


def _plane(document: Document, wall: ChainWall) -> list[Block]:
    """What of gravity acts in the plane of the motion, where it is not all of it."""
    share = wall._share()
    if share == 0.0:
        words = _(
            "The plane of the motion is the plan: heights are places along the wall. Gravity acts normal to it, so that"
            " weights neither hold the bodies nor push them, and stand only in the sums of what the earthquake moves."
        )
        return [document.say(words)]
    if share < 1.0:
        words = _("In the plane of the motion acts the part {share} of gravity.")
        return [document.say(words, share=number(share, 5))]
    return []


def _sides(document: Document, wall: ChainWall) -> list[Block]:
    """The motion to the other side, and the restitution with its bound."""
    facts = chain_facts(upload((wall,)))
    blocks: list[Block] = []
    if not wall.sides > 1.0:
        blocks.append(document.say(_("The chain moves outwards alone.")))
    elif facts.is_mirrored:
        words = (
            _("Inwards the chain moves as its mirror image, which all of its masonry is, with its loads.")
            if facts.is_image
            else _(
                "Inwards the chain is taken to move as its mirror image; its tables do not show that the masonry and"
                " its loads are one."
            )
        )
        blocks.append(document.say(words))
    else:
        words = _(
            "Inwards the same joints open at their other ends: {alpha} is {outwards} outwards and {inwards} inwards;"
            " the terms of the lesser are used for both."
        )
        values: dict[str, Any] = {"outwards": number(facts.outwards), "inwards": number(facts.inwards)}
        blocks.append(document.say(words, alpha=symbol_of("alpha_0"), **values))
    given = {"given": number(wall.restitution_coefficient)}
    if facts.bound <= 1.0:
        words = _(
            "Restitution of an impact: {given} in the time histories; an impact on all joints, which open but do not"
            " slide, leaves {bound}, an upper bound."
        )
        return [*blocks, document.say(words, bound=number(facts.bound), **given)]
    words = _("Restitution of an impact: {given} in the time histories; no upper bound is known of these joints.")
    return [*blocks, document.say(words, **given)]


def draw_chain(document: Document, one: Subject) -> Any:
    """A chain at rest with what acts on it, and displaced."""
    from matplotlib.patches import Polygon

    wall = one.wall
    assert isinstance(wall, ChainWall)
    rest, moved = style.new_axes(1, (6.6, 4.4), 2)
    rotation = _DRAWN * wall.capacity_angle
    for ax, q in ((rest, 0.0), (moved, rotation)):
        if ax is moved:
            for _body, is_opening, corners in wall.outlines():
                if not is_opening:
                    ax.add_patch(Polygon(corners, facecolor="none", edgecolor=_MIDDLE, linewidth=0.8, linestyle="--"))
        for body, is_opening, corners in wall.outlines(rotation=q):
            look = "white" if is_opening else _STILL if body == 0 else _PALE
            ax.add_patch(Polygon(corners, facecolor=look, edgecolor=_DARK, linewidth=0.9))
        for ends in ends_of_ties(wall, q):
            ax.plot(*ends.T, color=_DARK, linewidth=1.2, linestyle=(0, (6, 2, 1, 2)), zorder=4)
        for row in wall._rows("joint_table"):
            body, at = (int(row[1]), (-row[3], row[4])) if row[1] > 0.0 else (int(row[2]), (-row[6], row[7]))
            x, y = wall._moved([at], body, q)[0]
            marker = "o" if row[0] == 2.0 else "s"
            ax.plot(x, y, linestyle="none", marker=marker, markersize=5, color=_DARK, zorder=5)
        ax.set_aspect("equal")
        ax.axis("off")
    centres = wall.motion(0.0)
    for count, (x, y) in enumerate(zip(centres.x, centres.y, strict=True), 1):
        ring = {"boxstyle": "circle,pad=0.2", "facecolor": "white", "edgecolor": _DARK, "linewidth": 0.7}
        rest.annotate(str(count), (x, y), ha="center", va="center", fontsize=_WORDS, bbox=ring)
    _arrows(document, rest, wall)
    for count, (end, _other) in enumerate(ends_of_ties(wall, 0.0), 1):
        rest.annotate(f"T{count}", end, (4, 4), textcoords="offset points", fontsize=_WORDS)
    low, high = _limits(wall, rotation)
    for ax in (rest, moved):
        ax.set_xlim(low[0], high[0])
        ax.set_ylim(low[1], high[1])
    rest.set_title(document.text(_("at rest")), fontsize=_TITLES)
    moved.set_title(document.text(_("displaced, not to scale")), fontsize=_TITLES)
    return rest


def _limits(wall: ChainWall, rotation: float) -> tuple[FloatArray, FloatArray]:
    """Corners of what is drawn at rest and displaced, with room for loads and their words."""
    points = [corners for q in (0.0, rotation) for _body, _is_opening, corners in wall.outlines(rotation=q)]
    points += [np.array([(-row[3], row[4])]) for row in wall._rows("joint_table")]
    points += [np.array([(-row[1], row[2])]) for row in wall._rows("action_table")]
    points += ends_of_ties(wall, 0.0)
    at = wall.motion(0.0)
    found = np.vstack([*points, np.column_stack([at.x, at.y])])
    low, high = found.min(axis=0), found.max(axis=0)
    room = 0.16 * float(max(high - low))
    return low - room, high + room * np.array([1.6, 1.2])


def _arrows(document: Document, ax: Any, wall: ChainWall) -> None:
    """Loads, masses and thrusts on a chain at rest."""
    size = 0.12 * max(wall.height, 1.0)
    for item, row in named_actions(wall):
        word, _blank, count = item.partition(" ")
        force = row[3] or row[7] or row[6] * wall.gravity
        x, y = -row[1], row[2]
        words = f"{_LETTERS[word]}{count} = {document.language.decimal(f'{1e-3 * force:.4g}')} kN"
        if word == "mass":
            ax.plot(x, y, linestyle="none", marker="D", markersize=5, color=_MIDDLE, zorder=5)
            ax.annotate(words, (x, y), (6, 5), textcoords="offset points", fontsize=_WORDS)
            continue
        angle = np.radians(row[8] if word == "thrust" else -90.0)
        start = (x - size * np.cos(angle), y - size * np.sin(angle))
        ax.annotate("", (x, y), start, arrowprops=_ARROW, zorder=6)
        ax.annotate(words, start, (4, 3), textcoords="offset points", fontsize=_WORDS)
