"""Facades: the walls above their hinges, which share their records."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Literal

import numpy as np

from dondolo._base.arguments import argument_error, as_array, wrong_type
from dondolo.walls.mechanisms import Corner, OneSidedWall, wall_from
from dondolo.walls.population import Population
from dondolo.walls.wall import described


def facade(wall: OneSidedWall | Corner, *, hinge_level: Sequence[float] | Literal["storeys"] = "storeys") -> Population:
    """The walls above the hinges of a facade: see `Population.of_facade`."""
    if not isinstance(wall, (OneSidedWall, Corner)):
        raise wrong_type("wall", wall, "a OneSidedWall or a Corner")
    if isinstance(hinge_level, str):
        if hinge_level != "storeys":
            raise argument_error("wrong_type", "hinge_level", f" = {hinge_level!r}: must be heights or 'storeys'")
        if isinstance(wall, Corner) or not wall.sections:
            raise argument_error("not_together", "hinge_level", " = 'storeys': only with sections")
        levels = np.append(0.0, np.cumsum([section.height for section in wall.sections])[:-1])
    else:
        levels = as_array("hinge_level", hinge_level)
    if len(levels) == 0:
        raise argument_error("not_given", "hinge_level", ": must be given")
    if np.any(np.diff(levels) <= 0.0):
        raise argument_error("not_increasing", "hinge_level", ": must increase")
    properties, walls = wall._properties(), []
    for level in levels.tolist():
        own = {"hinge_level": [level], "name": f"{wall.name} at {np.format_float_positional(level, trim='-')} m"}
        walls.append(wall_from(described(properties | own, wall.gravity)))
    return Population(tuple(walls), facades=(wall.name,) * len(walls))
