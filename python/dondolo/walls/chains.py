"""Chains of rigid bodies with one degree of freedom: bodies, joints, and what acts on them."""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import KW_ONLY, InitVar, dataclass
from pathlib import Path
from typing import Any, ClassVar, Literal, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from dondolo._base.arguments import FloatArray, argument_error, as_number, as_path, one_of, wrong_type
from dondolo._fortran.walls import chain_facts, chain_motion
from dondolo._storage.saved import part_of_results
from dondolo.walls.chain_tables import write_tables
from dondolo.walls.wall import DEFAULT, Wall, upload

# Numbers of a row of each table
TABLES = {"body_table": 11, "joint_table": 8, "action_table": 10}

# Kinds of rows of bodies
_CORNER, _MASS, _SECTOR = 0, 1, 2

# Which parts of a load a chain lifts and pushes
_INERTIAS = {"none": (0.0, 0.0), "vertical": (1.0, 0.0), "both": (1.0, 1.0)}

# Sides of the outline of a sector on each of its arcs
_SIDES = 24

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
        return [[_CORNER, *own, -x, y, 0.0, 0.0, 0.0, 0.0] for x, y in (_point("corners", at) for at in self.corners)]


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
        return [[_SECTOR, as_number("width", self.width), as_number("density", self.density), -x, y, *numbers]]


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
        return [[_MASS, 0.0, 0.0, -x, y, mass, inertia, 0.0, 0.0]]


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


class ChainMotion(NamedTuple):
    """Positions of the bodies of a chain at some rotations.

    Attributes
    ----------
    x, y : ndarray, shape (*rotation.shape, bodies)
        Places of their centroids, outwards and upwards [m].
    turn : ndarray, shape (*rotation.shape, bodies)
        Their turns from the vertical outwards [rad].
    """

    x: FloatArray
    y: FloatArray
    turn: FloatArray


@part_of_results
@dataclass(frozen=True, repr=False, kw_only=True)
class Chain(Wall):
    """A chain of rigid bodies with one degree of freedom: an arch, a portal, a frame, a strip with any loads.

    Bodies, joints and what acts on them say how it moves; the terms of its equation of motion follow (docs/chains.md).
    All numbers are those of the whole chain, not per metre. Height, restitution_value, restitution_factor,
    restitution_sd, restitution_seed, gravity, name and building are those of `OneSidedWall`; restitution_value must be
    given.

    Parameters
    ----------
    bodies : str, path or sequence of Body, optional
        CSV file of the rigid bodies, or the bodies. At most 8 that move; they are numbered from 1, without those that
        stand still.
    joints : str, path or sequence of Pin or Guide, optional
        CSV file of the hinges and guides between them, or the joints. A pin has two equations, a guide one; n bodies
        need 3 n - 1.
    actions : str, path or sequence of PointLoad, PointMass or PointThrust, optional
        CSV file of loads, pushed masses and thrusts at points of the bodies, or a list of them.
    driver : float, optional
        Number of the body whose turn is the rotation q; 1 if left out.
    gravity_share : float, optional
        Part of gravity that acts in the plane of the motion; 1 if left out, 0 for horizontal bending, whose plane is
        the plan.
    sides : float, optional
        1: the wall can rock to one side only; 2: to both, and changes side at every impact. Must be given.
    body_table : sequence of float, optional
        Rows of the bodies as numbers, 11 a row, instead of their file.
    joint_table : sequence of float, optional
        Rows of the joints as numbers, 8 a row, instead of their file.
    action_table : sequence of float, optional
        Rows of the actions as numbers, 10 a row, instead of their file.

    Raises
    ------
    InputError
        Joints that leave more or less than one degree of freedom, or depend on one another; bodies that overlap; a
        hinge on the side on which its joint closes; a chain that does not stand at rest; two sides whose multipliers or
        capacities differ by more than 2 %.

    Notes
    -----
    The chain moves outwards, towards +x. With `sides=2` it moves inwards too: if all joints are horizontal they open at
    their other ends, and the terms of the lesser multiplier are used for both; if not, as its mirror image.

    Examples
    --------
    A strip between two floors, folding at 1.8 m:

    >>> import dondolo as dd
    >>> t, brick = 0.25, {"width": 1.0, "density": 1800.0}
    >>> lower = dd.Body([dd.Part([(0.0, 0.0), (-t, 0.0), (-t, 1.8), (0.0, 1.8)], **brick)])
    >>> upper = dd.Body([dd.Part([(0.0, 1.8), (-t, 1.8), (-t, 3.0), (0.0, 3.0)], **brick)])
    >>> joints = [dd.Pin(1, 0, (0.0, 0.0)), dd.Pin(1, 2, (-t, 1.8)), dd.Guide(2, 0, (0.0, 3.0))]
    >>> chain = dd.Chain(height=3.0, bodies=[lower, upper], joints=joints, sides=2, restitution_value=0.9)
    >>> strip = dd.TwoBlockWall(3.0, 0.25, hinge=0.6)
    >>> bool(abs(chain.capacity_angle / strip.capacity_angle - 1.0) < 1e-12)
    True
    """

    mechanism: ClassVar[str] = "chain"

    bodies: InitVar[str | os.PathLike[str] | Sequence[Body] | None] = None
    joints: InitVar[str | os.PathLike[str] | Sequence[Pin | Guide] | None] = None
    actions: InitVar[str | os.PathLike[str] | Sequence[PointLoad | PointMass | PointThrust] | None] = None
    driver: float | None = None
    gravity_share: float | None = None
    sides: float = DEFAULT
    body_table: Sequence[float] | None = None
    joint_table: Sequence[float] | None = None
    action_table: Sequence[float] | None = None

    def __post_init__(self, bodies: Any, joints: Any, actions: Any) -> None:
        files = {}
        kinds = (Body,), (Pin, Guide), (PointLoad, PointMass, PointThrust)
        for name, given, kind in zip(("bodies", "joints", "actions"), (bodies, joints, actions), kinds, strict=True):
            if given is None:
                continue
            if isinstance(given, (str, os.PathLike)):
                files[name] = as_path(given).decode()
                continue
            table = {"bodies": "body_table", "joints": "joint_table", "actions": "action_table"}[name]
            if getattr(self, table) is not None:
                raise argument_error("not_together", table, f": give either it or {name}")
            for one in given:
                if not isinstance(one, kind):
                    raise wrong_type(name, one, " or ".join(f"dondolo.{each.__name__}" for each in kind))
            numbers = _flat_bodies(given) if name == "bodies" else [float(x) for one in given for x in one._row()]
            object.__setattr__(self, table, numbers or None)
        self._understand(**files)

    @property
    def misfit(self) -> float:
        """Largest distance of a sampled term from the polynomial that is computed with / largest value."""
        return self._static(11)

    @property
    def impact_bound(self) -> float:
        """Restitution that an impact on all joints leaves, an upper bound without sliding; NaN if not all are known."""
        bound = chain_facts(upload((self,))).bound
        return bound if bound <= 1.0 else float("nan")

    def motion(self, rotation: ArrayLike) -> ChainMotion:
        """Positions of the bodies at given rotations, on the side whose terms are used.

        Parameters
        ----------
        rotation : array_like
            Rotations q of the driver [rad], at least 0 and less than the geometric end.

        Returns
        -------
        ChainMotion
            Places and turns of the bodies, in the shape of `rotation` and one number for each body.

        Raises
        ------
        InputError
            A rotation that the chain cannot have.

        Examples
        --------
        >>> import dondolo as dd
        >>> block = dd.Body([dd.GivenMass(1350.0, (-0.125, 1.5), 1019.53125)])
        >>> chain = dd.Chain(
        ...     height=3.0, bodies=[block], joints=[dd.Pin(1, 0, (0.0, 0.0))], sides=1, restitution_value=0.48
        ... )
        >>> chain.motion(0.05).turn.round(12).tolist()
        [0.05]
        """
        numbers = self._rows("body_table")
        found = chain_motion(upload((self,)), rotation, int(numbers[:, 0].max()))
        return ChainMotion(found[..., 0], found[..., 1], found[..., 2])

    def outlines(self, *, rotation: float = 0.0) -> list[tuple[int, bool, FloatArray]]:
        """Outlines of the parts at a rotation, of those that have one.

        Parameters
        ----------
        rotation : float, optional
            Rotation q of the driver [rad], at rest if left out.

        Returns
        -------
        list of tuple
            Number of the body, whether it is an opening, and corners (x, y), of shape (corners, 2) [m].

        Examples
        --------
        >>> import dondolo as dd
        >>> block = dd.Body([dd.Part([(0.0, 0.0), (-0.25, 0.0), (-0.25, 3.0), (0.0, 3.0)], width=1.0, density=1800.0)])
        >>> foot = dd.Pin(1, 0, (0.0, 0.0))
        >>> chain = dd.Chain(height=3.0, bodies=[block], joints=[foot], sides=1, restitution_value=0.48)
        >>> chain.outlines()[0][2].shape
        (4, 2)
        """
        found = []
        for body, is_opening, corners in self._outlines_at_rest():
            found.append((body, is_opening, self._moved(corners, body, rotation)))
        return found

    def write_tables(self, prefix: str | os.PathLike[str]) -> tuple[Path, ...]:
        """Write the files of its bodies, joints and actions, for a case or a table of walls.

        Parameters
        ----------
        prefix : str or path
            What their names begin with: `arch` gives `arch_bodies.csv`, `arch_joints.csv` and `arch_actions.csv`, the
            last only if something acts on it. Files of these names are replaced.

        Returns
        -------
        tuple of Path
            The files that were written.

        Raises
        ------
        InputError
            A part of a load other than those that words have.

        Examples
        --------
        >>> import dondolo as dd
        >>> block = dd.Body([dd.GivenMass(1350.0, (-0.125, 1.5), 1019.53125)])
        >>> chain = dd.Chain(
        ...     height=3.0, bodies=[block], joints=[dd.Pin(1, 0, (0.0, 0.0))], sides=1, restitution_value=0.48
        ... )
        >>> [path.name for path in chain.write_tables("block")]
        ['block_bodies.csv', 'block_joints.csv']
        """
        return write_tables(self, prefix)

    def _moved(self, points: ArrayLike, body: int, rotation: float) -> FloatArray:
        """Points of a body at a rotation."""
        if body == 0:
            return np.asarray(points, dtype=np.float64)
        rest, now = self.motion(0.0), self.motion(rotation)
        k = body - 1
        offset = np.asarray(points) - [rest.x[k], rest.y[k]]
        c, s = np.cos(now.turn[k]), np.sin(now.turn[k])
        moved: FloatArray = offset @ np.array([[c, -s], [s, c]]) + [now.x[k], now.y[k]]
        return moved

    def _rows(self, table: str) -> FloatArray:
        """Rows of a table."""
        given = getattr(self, table)
        return np.asarray([] if given is None else given, dtype=np.float64).reshape(-1, TABLES[table])

    def _outlines_at_rest(self) -> list[tuple[int, bool, FloatArray]]:
        """Outlines of the parts: those of masses that are given are not known."""
        found: list[tuple[int, bool, list[Point]]] = []
        last: tuple[float, ...] = ()
        for row in self._rows("body_table"):
            body, kind, is_opening, at = int(row[0]), int(row[2]), bool(row[3] < 0.0), (-row[5], row[6])
            if kind == _SECTOR:
                angles = np.radians(np.linspace(row[9], row[10], _SIDES + 1))
                arcs = [
                    (at[0] + r * np.cos(a), at[1] + r * np.sin(a))
                    for r, way in ((row[8], angles), (row[7], angles[::-1]))
                    for a in way
                ]
                found.append((body, is_opening, arcs))
            elif kind == _CORNER:
                if tuple(row[:3]) != last:
                    found.append((body, is_opening, []))
                found[-1][2].append(at)
            last = tuple(row[:3])
        return [(body, is_opening, np.array(corners)) for body, is_opening, corners in found]

    def _facts(self) -> list[tuple[str, str]]:
        """What a reader wants to know: how many bodies and joints it has, not their numbers."""
        facts = dict(super()._facts())
        facts |= {table: str(len(self._rows(table))) for table in TABLES if table in facts}
        return [(what, text) for what, text in facts.items() if what not in ("R", "alpha")]


def _point(name: str, at: Any) -> Point:
    """A point as two numbers."""
    try:
        x, y = at
    except (TypeError, ValueError):
        raise argument_error("not_numbers", name, f" = {at!r}: must be two numbers, x and y") from None
    return as_number(name, x), as_number(name, y)


def _flat_bodies(bodies: Sequence[Body]) -> list[float]:
    """Rows of bodies, one after the other: those that stand still are one, of number 0."""
    found, moving, standing = [], 0, 0
    for body in bodies:
        moving += not body.stands
        for k, part in enumerate(body.parts, 1 + standing * body.stands):
            found += [float(number) for row in part._rows() for number in (0 if body.stands else moving, k, *row)]
        standing += len(body.parts) * body.stands
    return found
