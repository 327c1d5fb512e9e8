"""Where a wall is, at rest and rotated.

Positions follow docs/theory.md, section 2. Outwards is to the right, so that depths are measured from the right.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import Any

import numpy as np

from dondolo.walls.mechanisms import Corner, TwoBlockWall
from dondolo.walls.parts import Section, parts_of
from dondolo.walls.wall import MasonryWall

Points = np.ndarray[Any, np.dtype[np.float64]]


@dataclass(frozen=True)
class Shape:
    """Where a wall is.

    Attributes
    ----------
    blocks : list of ndarray, shape (corners, 2)
        Corners of its blocks [m], four from the base on its left, counter-clockwise; after them those of wedges.
    hinges : ndarray, shape (hinges, 2)
        Corners about which the blocks rotate [m].
    """

    blocks: list[Points]
    hinges: Points


def shape(wall: MasonryWall, rotation: float) -> Shape:
    """The position of a wall at a rotation.

    Parameters
    ----------
    wall : MasonryWall
        The wall; at rest its base lies on y = 0, from x = 0 to x = thickness.
    rotation : float
        Signed rotation, of the lower block for two-block walls [rad]; positive: outwards, to the right.

    Returns
    -------
    Shape
    """
    side = -1.0 if rotation < 0.0 else 1.0
    t, q = width_of(wall), abs(rotation)
    if isinstance(wall, TwoBlockWall):
        blocks, hinges = _two_blocks(wall, q)
    else:
        outer = storeys(wall)
        widths = [storey[1, 0] - storey[0, 0] for storey in outer]
        leaves = range(int(getattr(wall, "leaves", None) or 1))
        blocks = [
            moved(wall, storey, q) - (leaf * width, 0.0)
            for leaf in leaves
            for storey, width in zip(outer, widths, strict=True)
        ]
        blocks += [moved(wall, wedge, q) for wedge in wedges(wall)]
        base = t - wall.base_hinge_depth + _edge(wall) * q
        hinges = np.array([[base - leaf * widths[0], 0.0] for leaf in leaves])
    if side < 0.0:
        blocks = [_mirrored(block, t) for block in blocks]
        hinges = _mirrored(hinges, t)
    return Shape(blocks, hinges)


def width_of(wall: MasonryWall) -> float:
    """What the base of a wall covers of the plane of its motion [m]: its thickness, of a corner its diagonal."""
    return wall.thickness * math.sqrt(2.0) if isinstance(wall, Corner) else wall.thickness


def storeys(wall: MasonryWall) -> list[Points]:
    """The storeys of one block at rest, those of its outer leaf if it has several.

    Parameters
    ----------
    wall : MasonryWall
        The wall; one of two blocks has one storey.

    Returns
    -------
    list of ndarray, shape (4, 2)
        Corners of each from the bottom [m], as in `Shape.blocks`.
    """
    sections = parts_of(wall, "sections") or (Section(wall.height, width_of(wall)),)
    leaves = getattr(wall, "leaves", None) or 1.0
    found = []
    bottom = 0.0
    for section in sections:
        thickness = section.thickness / leaves
        left = width_of(wall) - (section.offset or 0.0) - thickness
        found.append(np.add(_rectangle(thickness, section.height), (left, bottom)))
        bottom += section.height
    return found


def wedges(wall: MasonryWall) -> list[Points]:
    """The wedges of transverse walls behind the storeys of a wall at rest; equal ones once. Of a corner its wings.

    Parameters
    ----------
    wall : MasonryWall
        The wall.

    Returns
    -------
    list of ndarray, shape (corners, 2)
        Corners of the part of each in each storey [m].
    """
    found = {}
    given = [
        (math.tan(math.radians(wedge.angle)), wedge.bottom, wedge.top, wedge.length)
        for wedge in parts_of(wall, "wedges")
    ]
    if isinstance(wall, Corner):
        # Seen along the normal to the bisector, both wings are one
        seen = math.sqrt(0.5)
        length = math.inf if wall.wing_length is None else wall.wing_length
        given = [(seen * math.tan(math.radians(wall.wing_angle)), 0.0, wall.height, seen * length)]
    for slope, bottom, top, length in given:
        full = bottom + length / slope if slope > 0.0 else top
        for corners in storeys(wall):
            low, high = max(corners[0, 1], bottom), min(corners[2, 1], top)
            levels = [low, *([full] if low < full < high else []), high]
            reach = [min(slope * (level - bottom), length) for level in levels]
            if high > low and max(reach) > 0.0:
                face = corners[0, 0]
                back = [(face - far, level) for far, level in zip(reach, levels, strict=True)]
                found[tuple(back)] = np.array([(face, low), (face, high), *reversed(back)])
    return list(found.values())


def _edge(wall: MasonryWall) -> float:
    """Radius of the edge that one block rolls on."""
    return getattr(wall, "edge_radius", None) or 0.0


def moved(wall: MasonryWall, points: Points, rotation: float) -> Points:
    """Points of a wall, given at rest, where it has turned outwards.

    Parameters
    ----------
    wall : MasonryWall
        The wall; of two blocks, those above its hinge turn with the upper one.
    points : ndarray, shape (points, 2)
        Where they are at rest [m].
    rotation : float
        Rotation, not negative [rad].

    Returns
    -------
    ndarray, shape (points, 2)
        Where they are [m]; a wall with a round edge rolls.
    """
    if isinstance(wall, TwoBlockWall):
        base, corner, top, back = _fold(wall, rotation)
        lower = np.array([0.0, wall.hinge * wall.height])
        above = points[:, 1:] > lower[1]
        folded: Points = np.where(
            above, _turned(points - lower, corner, back) + (top - corner), _turned(points, base, -rotation)
        )
        return folded
    centre = np.array([width_of(wall) - wall.base_hinge_depth, _edge(wall)])
    turned: Points = np.add(_turned(points, centre, -rotation), (_edge(wall) * rotation, 0.0))
    return turned


def _two_blocks(wall: TwoBlockWall, q: float) -> tuple[list[Points], Points]:
    """Both blocks folded to the right, and their hinges."""
    base, corner, top, back = _fold(wall, q)
    lower, upper = wall.hinge * wall.height, (1.0 - wall.hinge) * wall.height
    middle = _turned(np.array([[wall.base_hinge_depth, lower]]), base, -q)[0]
    blocks = [
        _turned(_rectangle(wall.thickness, lower), base, -q),
        _turned(_rectangle(wall.thickness, upper), corner, back) + (top - corner),
    ]
    return blocks, np.array([base, middle, top])


def _fold(wall: TwoBlockWall, q: float) -> tuple[Points, Points, Points, float]:
    """Hinge at the base, that of the top on the upper block at rest and where it goes, and how far that turns back.

    R2 sin(beta2) = R1 sin(beta1) keeps base and top hinge on one vertical.
    """
    t, u = wall.thickness, wall.base_hinge_depth
    apart = t - 2.0 * u
    lower, upper = wall.hinge * wall.height, (1.0 - wall.hinge) * wall.height
    alpha1, alpha2 = np.arctan2(apart, lower), np.arctan2(apart, upper)
    beta1 = alpha1 - q
    beta2 = np.arcsin(np.hypot(apart, lower) * np.sin(beta1) / np.hypot(apart, upper))
    base = np.array([t - u, 0.0])
    middle = base + np.hypot(apart, lower) * np.array([-np.sin(beta1), np.cos(beta1)])
    top = middle + np.hypot(apart, upper) * np.array([np.sin(beta2), np.cos(beta2)])
    return base, np.array([t - u, upper]), top, float(alpha2 - beta2)


def _rectangle(width: float, height: float) -> Points:
    return np.array([[0.0, 0.0], [width, 0.0], [width, height], [0.0, height]])


def _turned(points: Points, centre: Points, angle: float) -> Points:
    """Points turned about a centre, counter-clockwise."""
    cos, sin = np.cos(angle), np.sin(angle)
    turned: Points = (points - centre) @ np.array([[cos, sin], [-sin, cos]]) + centre
    return turned


def _mirrored(points: Points, width: float) -> Points:
    return np.column_stack([width - points[:, 0], points[:, 1]])
