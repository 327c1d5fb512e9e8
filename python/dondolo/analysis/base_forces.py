"""Forces between the base of a rocking block and the ground, and the friction that they need."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from dondolo._base.arguments import FloatArray
from dondolo.errors import InputError
from dondolo.walls.wall import MasonryWall, Wall

if TYPE_CHECKING:
    from dondolo.analysis.response import Response


def base_forces(response: Response) -> tuple[FloatArray, FloatArray]:
    """Normal and shear force at the rows of a time history: see `Response.base_forces`."""
    time, ground, rotation, _ = response._motion()
    velocity, side = np.abs(np.asarray(response.velocity)), np.asarray(response.side, dtype=np.float64)
    mass = _mass_of_block(response.wall)
    upwards = np.zeros_like(time)
    if response.record.vertical is not None:
        upwards = abs(response.scale) * np.interp(time, response.record.time, response.record.vertical, right=0.0)
    terms = response.wall.terms(np.abs(rotation))
    vertical_lever, lever = terms.restoring_moment / response.wall.gravity, terms.excitation_lever
    moment = terms.restoring_moment + vertical_lever * upwards + side * lever * ground
    moves = (rotation != 0.0) | (velocity > 0.0)
    turning = np.where(moves, -moment / terms.inertia, 0.0)
    normal = mass * (response.wall.gravity + upwards) + vertical_lever * turning - lever * velocity**2
    shear = mass * ground + side * (lever * turning + vertical_lever * velocity**2)
    return normal, shear


def friction_demand(response: Response) -> float:
    """Largest coefficient of friction of a motion: see `Response.friction_demand`."""
    normal, shear = base_forces(response)
    moves = (np.asarray(response.rotation) != 0.0) | (np.asarray(response.velocity) != 0.0)
    if not moves.any():
        return 0.0
    normal, shear = normal[moves], np.abs(shear[moves])
    if (normal <= 0.0).any():
        return float("inf")
    return float(max(np.max(shear / normal), np.tan(response.wall.slenderness_angle)))


def _mass_of_block(wall: Wall) -> float:
    """Mass of a wall that is a rectangular block and nothing more, by its terms [kg/m]."""
    problem = InputError(f"wall '{wall.name}': must be one rectangular block for its base forces")
    if not isinstance(wall, MasonryWall):
        raise problem
    mass, half, arm = wall.density * wall.height * wall.thickness, 0.5 * wall.height, 0.5 * wall.thickness
    angles = np.array([0.0, 0.5 * wall.capacity_angle])
    sine, cosine = np.sin(angles), np.cos(angles)
    expected = (
        4.0 / 3.0 * mass * (half**2 + arm**2) + 0.0 * angles,
        0.0 * angles,
        mass * wall.gravity * (arm * cosine - half * sine),
        mass * (half * cosine + arm * sine),
        0.0 * angles,
    )
    if wall.mechanism == "two_block" or not np.allclose(wall.terms(angles), expected, rtol=1e-9, atol=0.0):
        raise problem
    return mass
