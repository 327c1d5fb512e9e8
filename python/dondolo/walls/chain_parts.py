"""What a chain is made of: bodies and their parts, and joints."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import KW_ONLY, dataclass
from typing import Any

from dondolo._base.arguments import argument_error, as_number, wrong_type

# Kinds of rows of bodies
CORNER, MASS, SECTOR = 0, 1, 2

#: A point (x, y) [m]: x outwards, so that depths behind the outer face are negative, y upwards
Point = tuple[float, float]


@dataclass(frozen=True)
class Part:
    """A polygon of masonry in the plane of the motion, or an opening.

    Parameters
    ----------
    corners : sequence of tuple
        Corners (x, y), x outwards and y upwards [m].
    width : float
        Width across the plane, negative for an opening [m].
    density : float
        Density [kg/m3].

    Examples
    --------
    >>> import dondolo as dd
    >>> pier = dd.Part([(0.0, 0.0), (-1.0, 0.0), (-1.0, 3.5), (0.0, 3.5)], width=1.0, density=1900.0)
    >>> len(pier.corners)
    4
    """

    corners: Sequence[Point]
    width: float
    density: float

    def _rows(self) -> list[list[float]]:
        """The numbers of its rows behind body and part."""
        own = (as_number("width", self.width), as_number("density", self.density))
        return [[CORNER, *own, *place_of("corners", at), 0.0, 0.0, 0.0, 0.0] for at in self.corners]


@dataclass(frozen=True)
class Sector:
    """A part of a ring of masonry between two radii and two angles, such as a voussoir.

    Parameters
    ----------
    centre : tuple
        Centre of the ring (x, y) [m].
    inner, outer : float
        Radii [m].
    start, end : float
        Angles between which it lies, from +x towards +y [deg].
    width : float
        Width across the plane, negative for an opening [m].
    density : float
        Density [kg/m3].

    Examples
    --------
    >>> import dondolo as dd
    >>> stone = dd.Sector((0.0, 3.5), 1.5, 2.0, start=90.0, end=112.5, width=1.0, density=1900.0)
    >>> stone.outer - stone.inner
    0.5
    """

    centre: Point
    inner: float
    outer: float
    _: KW_ONLY
    start: float
    end: float
    width: float
    density: float

    def _rows(self) -> list[list[float]]:
        """The numbers of its row behind body and part."""
        own = (as_number("width", self.width), as_number("density", self.density))
        numbers = [as_number(name, getattr(self, name)) for name in ("inner", "outer", "start", "end")]
        return [[SECTOR, *own, *place_of("centre", self.centre), *numbers]]


@dataclass(frozen=True)
class GivenMass:
    """A mass that is given with its centroid and its inertia.

    Parameters
    ----------
    mass : float
        Mass [kg].
    at : tuple
        Centroid (x, y) [m].
    inertia : float
        Inertia about an axis through it that is normal to the plane of the motion [kg m2].

    Examples
    --------
    >>> import dondolo as dd
    >>> block = dd.GivenMass(1350.0, (-0.125, 1.5), 1019.53125)
    >>> block.at
    (-0.125, 1.5)
    """

    mass: float
    at: Point
    inertia: float

    def _rows(self) -> list[list[float]]:
        """The numbers of its row behind body and part."""
        mass, inertia = as_number("mass", self.mass), as_number("inertia", self.inertia)
        return [[MASS, 0.0, 0.0, *place_of("at", self.at), mass, inertia, 0.0, 0.0]]


@dataclass(frozen=True)
class Body:
    """A rigid body of a chain: the sum of its parts.

    Parameters
    ----------
    parts : sequence of Part, Sector or GivenMass
        Its parts.
    stands : bool, optional
        Whether it stands still in this mechanism, such as the left pier of a portal that sways to the right. It is then
        body 0, and is not counted among the others.

    Examples
    --------
    >>> import dondolo as dd
    >>> block = dd.Body([dd.GivenMass(1350.0, (-0.125, 1.5), 1019.53125)])
    >>> len(block.parts)
    1
    """

    parts: Sequence[Part | Sector | GivenMass]
    _: KW_ONLY
    stands: bool = False

    def __post_init__(self) -> None:
        for part in self.parts:
            if not isinstance(part, (Part, Sector, GivenMass)):
                raise wrong_type("parts", part, "dondolo.Part, Sector or GivenMass")


@dataclass(frozen=True)
class Pin:
    """A hinge: a point that two bodies share, or a body and the ground.

    Parameters
    ----------
    body, other : int
        Numbers of the bodies, from 1; 0 is the ground.
    at : tuple
        The point (x, y) at rest [m].

    Examples
    --------
    >>> import dondolo as dd
    >>> dd.Pin(1, 0, (0.0, 0.0))  # the foot of body 1 on the ground
    Pin(body=1, other=0, at=(0.0, 0.0))
    """

    body: int
    other: int
    at: Point

    def _row(self) -> list[float]:
        """The numbers of its row."""
        at = place_of("at", self.at)
        return [2.0, self.body, self.other, *at, 0.0, *at]


@dataclass(frozen=True)
class Guide:
    """A joint that holds one direction: there the distance of a point of each body stays as it is.

    Parameters
    ----------
    body, other : int
        Numbers of the bodies, from 1; 0 is the ground.
    at : tuple
        Point (x, y) of the first at rest [m].
    angle : float
        Direction that is held, from +x towards +y: 0 for a floor that holds the top of a wall sideways [deg].
    other_at : tuple, optional
        Point of the other at rest; the same one if left out [m].

    Examples
    --------
    >>> import dondolo as dd
    >>> top = dd.Guide(2, 0, (0.0, 3.0))  # a floor holds the top of body 2 sideways
    >>> top.angle
    0.0
    """

    body: int
    other: int
    at: Point
    _: KW_ONLY
    angle: float = 0.0
    other_at: Point | None = None

    def _row(self) -> list[float]:
        """The numbers of its row."""
        at = place_of("at", self.at)
        far = at if self.other_at is None else place_of("other_at", self.other_at)
        return [1.0, self.body, self.other, *at, as_number("angle", self.angle), *far]


def flat_bodies(bodies: Sequence[Body]) -> list[float]:
    """Rows of bodies, one after the other: those that stand still are one, of number 0."""
    found, moving, standing = [], 0, 0
    for body in bodies:
        moving += not body.stands
        for k, part in enumerate(body.parts, 1 + standing * body.stands):
            found += [float(number) for row in part._rows() for number in (0 if body.stands else moving, k, *row)]
        standing += len(body.parts) * body.stands
    return found


def place_of(name: str, at: Any) -> list[float]:
    """Depth and height of a point."""
    x, y = _point(name, at)
    return [-x, y]


def _point(name: str, at: Any) -> Point:
    """A point as two numbers."""
    try:
        x, y = at
    except (TypeError, ValueError):
        raise argument_error("not_numbers", name, f" = {at!r}: must be two numbers, x and y") from None
    return as_number(name, x), as_number(name, y)
