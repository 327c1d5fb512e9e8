"""The elevation of a facade: corners and openings, what of it turns, and heights above the line that it turns about."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from dondolo._base.arguments import FloatArray
from dondolo.walls.parts import parts_of
from dondolo.walls.wall import Wall


@dataclass(frozen=True)
class Axis:
    """The line that a wall turns about, in its face.

    Attributes
    ----------
    at : ndarray, shape (2,)
        A point of it (x, z) [m].
    along : ndarray, shape (2,)
        Its direction, of length 1, towards +x.
    """

    at: FloatArray
    along: FloatArray

    def above(self, points: FloatArray) -> FloatArray:
        """Distances of points (x, z) above it [m]."""
        offset = np.asarray(points) - self.at
        distance: FloatArray = offset[..., 1] * self.along[0] - offset[..., 0] * self.along[1]
        return distance


def axis_of(wall: Wall) -> Axis | None:
    """The line that a panel turns about; None of a wall that turns about its base."""
    given = [getattr(wall, name, None) for name in ("axis_x", "axis_z")]
    if any(values is None for values in given):
        return None
    points = np.array(given).T
    points = points[np.argsort(points[:, 0])]
    step = points[1] - points[0]
    return Axis(points[0], step / np.hypot(*step))


def height_of(wall: Wall, part: Any) -> float:
    """Height of a load, a mass or a thrust above the base, or above the line that a panel turns about [m]."""
    axis = axis_of(wall)
    return float(part.height if axis is None else axis.above(np.array([part.x, part.height])))


def outline_of(wall: Wall) -> FloatArray | None:
    """Corners (x, z) of the elevation of a wall [m], of shape (corners, 2); None of one that has none."""
    given = [getattr(wall, name, None) for name in ("elevation_x", "elevation_z")]
    return None if any(values is None for values in given) else np.array(given).T


def holes_of(wall: Wall) -> list[FloatArray]:
    """Corners of the openings in the elevation of a wall [m]."""
    return [
        np.array([(one.x, one.z), (one.x + one.width, one.z), (one.x + one.width, one.z + one.height),
                  (one.x, one.z + one.height)])
        for one in parts_of(wall, "openings")
    ]  # fmt: skip


def turning(wall: Wall, corners: FloatArray) -> FloatArray:
    """The part of a polygon above the line that a wall turns about; where it falls apart, edges on the line join it."""
    axis = axis_of(wall) or Axis(np.zeros(2), np.array([1.0, 0.0]))
    above = axis.above(corners)
    found = []
    for place, corner in enumerate(corners):
        after = (place + 1) % len(corners)
        if above[place] >= 0.0:
            found.append(corner)
        if (above[place] < 0.0) != (above[after] < 0.0):
            share = above[place] / (above[place] - above[after])
            found.append(corner + share * (corners[after] - corner))
    return np.array(found).reshape(-1, 2)
