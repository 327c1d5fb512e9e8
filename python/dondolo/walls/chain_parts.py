"""What a chain is made of: bodies and their parts, joints, and what acts on them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import KW_ONLY, dataclass
from typing import Any, Literal

from dondolo._base.arguments import argument_error, as_number, one_of, wrong_type
from dondolo._fortran.walls import WALL_ABSENT

# Kinds of rows of bodies
CORNER, MASS, SECTOR = 0, 1, 2

# Which parts of a load a chain lifts and pushes
_INERTIAS = {"none": (0.0, 0.0), "vertical": (1.0, 0.0), "both": (1.0, 1.0)}

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
        return [[CORNER, *own, -x, y, 0.0, 0.0, 0.0, 0.0] for x, y in (_point("corners", at) for at in self.corners)]


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
        x, y = _point("centre", self.centre)
        numbers = [as_number(name, getattr(self, name)) for name in ("inner", "outer", "start", "end")]
        return [[SECTOR, as_number("width", self.width), as_number("density", self.density), -x, y, *numbers]]


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
        x, y = _point("at", self.at)
        mass, inertia = as_number("mass", self.mass), as_number("inertia", self.inertia)
        return [[MASS, 0.0, 0.0, -x, y, mass, inertia, 0.0, 0.0]]


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
        x, y = _point("at", self.at)
        return [2.0, self.body, self.other, -x, y, 0.0, -x, y]


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
        x, y = _point("at", self.at)
        far = (x, y) if self.other_at is None else _point("other_at", self.other_at)
        return [1.0, self.body, self.other, -x, y, as_number("angle", self.angle), -far[0], far[1]]


@dataclass(frozen=True)
class PointLoad:
    """A vertical load on a body of a chain.

    Parameters
    ----------
    body : int
        Number of the body, from 1; 0: one that stands still.
    at : tuple
        Where it rests (x, y) [m].
    force : float
        Its weight [N].
    inertia : {'none', 'vertical', 'both'}
        Which mass of it the chain moves: docs/loads.md.
    held : bool, optional
        Whether something else holds it sideways, such as the floor of a strip: it then counts in the moment of a check
        alone.

    Examples
    --------
    >>> import dondolo as dd
    >>> beam = dd.PointLoad(1, (-0.15, 1.5), 4e3, inertia="both")
    >>> beam.held
    False
    """

    body: int
    at: Point
    force: float
    _: KW_ONLY
    inertia: Literal["none", "vertical", "both"]
    held: bool = False

    def _row(self) -> list[float]:
        """The numbers of its row."""
        x, y = _point("at", self.at)
        one_of("inertia", self.inertia, tuple(_INERTIAS))
        own = _INERTIAS[self.inertia]
        return [self.body, -x, y, as_number("force", self.force), *own, 0.0, 0.0, 0.0, float(self.held)]


@dataclass(frozen=True)
class PointMass:
    """A mass that a body of a chain pushes and does not carry.

    Parameters
    ----------
    body : int
        Number of the body, from 1.
    at : tuple
        Where it is pushed (x, y) [m].
    mass : float
        The mass [kg].

    Examples
    --------
    >>> import dondolo as dd
    >>> dd.PointMass(1, (-0.2, 3.0), 600.0)
    PointMass(body=1, at=(-0.2, 3.0), mass=600.0)
    """

    body: int
    at: Point
    mass: float

    def _row(self) -> list[float]:
        """The numbers of its row."""
        x, y = _point("at", self.at)
        return [self.body, -x, y, 0.0, 0.0, 0.0, as_number("mass", self.mass), 0.0, 0.0, 0.0]


@dataclass(frozen=True)
class PointThrust:
    """A force on a body of a chain that keeps its direction.

    Parameters
    ----------
    body : int
        Number of the body, from 1.
    at : tuple
        Where it acts (x, y) [m].
    force : float
        The force [N].
    angle : float, optional
        Its direction, from +x towards +y, outwards if left out [deg].

    Examples
    --------
    >>> import dondolo as dd
    >>> arch = dd.PointThrust(1, (-0.2, 3.0), 1.5e3)
    >>> arch.angle
    0.0
    """

    body: int
    at: Point
    force: float
    _: KW_ONLY
    angle: float = 0.0

    def _row(self) -> list[float]:
        """The numbers of its row."""
        x, y = _point("at", self.at)
        force, angle = as_number("force", self.force), as_number("angle", self.angle)
        return [self.body, -x, y, 0.0, 0.0, 0.0, 0.0, force, angle, 0.0]


@dataclass(frozen=True)
class PointTie:
    """A tie between a body of a chain and the ground, or between two bodies.

    It yields and breaks as ties of other walls do (docs/ties.md), and holds the motion outwards.

    Parameters
    ----------
    body : int
        Number of the body, from 1.
    at : tuple
        Its anchor (x, y) [m].
    area : float
        Section [m2]: the whole of it, not per metre.
    length : float
        Length that is free to stretch, as a rule up to its other anchor [m].
    angle : float, optional
        Of a tie to the ground: direction of a motion that stretches it, from +x towards +y, outwards if left out [deg].
    other : int, optional
        Number of the body at its other end; the ground if left out.
    other_at : tuple, optional
        Its anchor on that body [m].
    modulus : float, optional
        Modulus of elasticity, 2.06e11 if left out [Pa].
    strength : float, optional
        Yield stress, 1.8e8 if left out [Pa].
    preload : float, optional
        Stress at rest, 0 if left out [Pa].
    strain : float, optional
        Strain at which it or its anchorage breaks, 0.02 if left out.
    anchor_force : float, optional
        Force at which its anchor gives way at once; it holds if left out [N].

    Examples
    --------
    >>> import dondolo as dd
    >>> rod = dd.PointTie(3, (2.5, 3.5), 3.1e-4, 5.0)  # from the head of a pier to the ground
    >>> chord = dd.PointTie(3, (1.5, 3.5), 3.1e-4, 3.0, other=1, other_at=(-1.5, 3.5))  # between two piers
    >>> rod.angle, chord.other
    (0.0, 1)
    """

    body: int
    at: Point
    area: float
    length: float
    _: KW_ONLY
    angle: float = 0.0
    other: int = 0
    other_at: Point | None = None
    modulus: float | None = None
    strength: float | None = None
    preload: float = 0.0
    strain: float | None = None
    anchor_force: float | None = None

    def __post_init__(self) -> None:
        if (self.other_at is None) != (self.other == 0):
            raise argument_error("not_together", "other_at", ": must be given with other, a body, and only then")

    def _row(self) -> list[float]:
        """The numbers of its row."""
        x, y = _point("at", self.at)
        far = (0.0, 0.0) if self.other_at is None else _point("other_at", self.other_at)
        numbers = [as_number(name, getattr(self, name)) for name in ("area", "length")]
        for name in ("modulus", "strength", "preload", "strain"):
            given = getattr(self, name)
            numbers.append(float(WALL_ABSENT[f"tie_{name}"]) if given is None else as_number(name, given))
        numbers.append(0.0 if self.anchor_force is None else as_number("anchor_force", self.anchor_force))
        if self.anchor_force is not None and not numbers[-1] > 0.0:
            raise argument_error("out_of_range", "anchor_force", f" = {numbers[-1]:g}: must be positive")
        return [self.body, self.other, -x, y, as_number("angle", self.angle), -far[0] + 0.0, far[1], *numbers]

    @classmethod
    def _of_row(cls, row: Sequence[float]) -> PointTie:
        """The tie of a row."""
        far = {"other": int(row[1]), "other_at": (-row[5], row[6])} if row[1] > 0.0 else {}
        bar = dict(zip(("modulus", "strength", "preload", "strain"), row[9:13], strict=True))
        anchor = row[13] if row[13] > 0.0 else None
        at = (-row[2], row[3])
        return cls(int(row[0]), at, row[7], row[8], angle=row[4], anchor_force=anchor, **bar, **far)

    @property
    def height(self) -> float:
        """Height of its anchor [m]."""
        return self.at[1]

    @property
    def section(self) -> float:
        """Section [m2]."""
        return self.area


def flat_bodies(bodies: Sequence[Body]) -> list[float]:
    """Rows of bodies, one after the other: those that stand still are one, of number 0."""
    found, moving, standing = [], 0, 0
    for body in bodies:
        moving += not body.stands
        for k, part in enumerate(body.parts, 1 + standing * body.stands):
            found += [float(number) for row in part._rows() for number in (0 if body.stands else moving, k, *row)]
        standing += len(body.parts) * body.stands
    return found


def _point(name: str, at: Any) -> Point:
    """A point as two numbers."""
    try:
        x, y = at
    except (TypeError, ValueError):
        raise argument_error("not_numbers", name, f" = {at!r}: must be two numbers, x and y") from None
    return as_number(name, x), as_number(name, y)
