"""Where a wall is, what it carries and what holds it, at rest and as it moves, for the page to draw."""

from __future__ import annotations

from typing import Any

import numpy as np

from dondolo.analysis.plots_response import motion_span
from dondolo.analysis.response import Response
from dondolo.errors import InputError
from dondolo.walls.drawing import support_height
from dondolo.walls.drawing_chain import outlines_at
from dondolo.walls.drawing_loads import inner_face
from dondolo.walls.elevation import height_of
from dondolo.walls.horizontal import HorizontalBending
from dondolo.walls.parts import parts_of
from dondolo.walls.shape import Points, shape, width_of
from dondolo.walls.wall import MasonryWall, Wall

# Pictures of a film a second, and at most
_RATE, _MOST = 25.0, 400
# Points of the trace
_TRACE = 600


def picture(wall: Wall) -> dict[str, Any] | None:
    """The wall at rest and at half of its capacity; None for one that has no shape."""
    if isinstance(wall, HorizontalBending):
        return _plan(wall)
    if not isinstance(wall, MasonryWall):
        return None
    rest, leaning = shape(wall, 0.0), shape(wall, 0.5 * wall.capacity_angle)
    t = width_of(wall)
    # Forces of a corner are those of the whole
    force = "total" if wall.mechanism == "corner" else "force"

    def placed(of: str, *names: str) -> list[list[float]]:
        """Numbers of the parts of a kind, the depth turned into the place from the inner face."""
        return [
            [
                t - (part.depth if part.depth is not None else 0.0),
                height_of(wall, part) if of == "loads" else part.height,
                *(getattr(part, name) or 0.0 for name in names),
            ]
            for part in parts_of(wall, of)
        ]

    thrusts = [
        [
            t - (inner_face(wall, height_of(wall, part)) if part.depth is None else part.depth),
            height_of(wall, part),
            getattr(part, force),
        ]
        for part in parts_of(wall, "thrusts")
    ]
    return {
        "height": wall.height,
        "thickness": t,
        "kind": wall.mechanism,
        "rest": _rounded(rest.blocks),
        "leaning": _rounded(leaning.blocks),
        "hinges": np.round(rest.hinges, 4).tolist(),
        "loads": placed("loads", force),
        "thrusts": thrusts,
        "ties": placed("ties", "plate_height", "plate_diameter"),
        "overburden": [getattr(wall, "overburden", 0.0) or 0.0, getattr(wall, "eccentricity", 0.0) or 0.0],
        "interlock": bool(parts_of(wall, "interlock")),
        "building": None if wall.building is None else support_height(wall),
    }


def _plan(wall: HorizontalBending) -> dict[str, Any]:
    """A wall that bends horizontally: points have their places along it, and outwards from its outer face."""
    hinges = wall._rows("joint_table")[:, [4, 3]] * [1.0, -1.0]
    return {
        "kind": wall.mechanism,
        "length": wall.length,
        "thickness": wall.thickness,
        "rest": _rounded(_leaves(wall, 0.0)),
        "leaning": _rounded(_leaves(wall, 0.5 * wall.capacity_angle)),
        "hinges": np.round(hinges, 4).tolist(),
        "thrust": wall.end_thrust,
        "pushes": np.column_stack([wall.push_x or [], wall.push or []]).tolist(),
    }


def _leaves(wall: HorizontalBending, rotation: float) -> list[Points]:
    """Its leaves in the plan at a rotation."""
    return [corners[:, ::-1] for _body, _is_opening, corners in outlines_at(wall, rotation)]


def motion_of(response: Response) -> dict[str, Any]:
    """A motion as a film: instants, rotation over capacity, and the blocks at each instant."""
    time, _, rotation, _ = response._motion()
    wall = response.wall
    if not isinstance(wall, (HorizontalBending, MasonryWall)):
        raise InputError(f"wall '{wall.name}': has no shape to draw, it is given by a table")
    first, last = motion_span(response)
    instants = np.linspace(first, last, int(min(_MOST, max(2.0, (last - first) * _RATE))))
    angles = np.interp(instants, time, rotation)
    blocks = [_leaves(wall, q) if isinstance(wall, HorizontalBending) else shape(wall, q).blocks for q in angles]
    span = np.linspace(first, last, _TRACE)
    ratio = np.interp(span, time, rotation) / wall.capacity_angle
    peak = int(np.argmax(np.abs(angles)))
    return {
        "instants": np.round(instants, 4).tolist(),
        "frames": [_rounded(block) for block in blocks],
        "ratio": np.round(angles / wall.capacity_angle, 4).tolist(),
        "trace": [np.round(span, 3).tolist(), np.round(ratio, 4).tolist()],
        "peak": peak,
        "edp": response.edp,
        "collapsed": bool(response.collapsed),
        "impacts": int(response.impacts),
    }


def _rounded(blocks: list[Points]) -> list[Any]:
    """Corners to a tenth of a millimetre."""
    return [np.round(block, 4).tolist() for block in blocks]
