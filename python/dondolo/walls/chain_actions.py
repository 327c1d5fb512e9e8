"""What acts on the bodies of a chain: loads, masses that are pushed, thrusts and ties at points of them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import KW_ONLY, dataclass
from typing import Literal

from dondolo._base.arguments import argument_error, as_number, one_of
from dondolo._fortran.walls import WALL_ABSENT
from dondolo.walls.chain_parts import Point, place_of

# Which parts of a load a chain lifts and pushes
INERTIAS = {"none": (0.0, 0.0), "vertical": (1.0, 0.0), "both": (1.0, 1.0)}


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
        Which mass of it the chain moves: docs/mechanisms.md.
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
        one_of("inertia", self.inertia, tuple(INERTIAS))
        own = INERTIAS[self.inertia]
        at = place_of("at", self.at)
        return [self.body, *at, as_number("force", self.force), *own, 0.0, 0.0, 0.0, float(self.held)]


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
        return [self.body, *place_of("at", self.at), 0.0, 0.0, 0.0, as_number("mass", self.mass), 0.0, 0.0, 0.0]


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
        force, angle = as_number("force", self.force), as_number("angle", self.angle)
        return [self.body, *place_of("at", self.at), 0.0, 0.0, 0.0, 0.0, force, angle, 0.0]


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
    >>> rod = dd.PointTie(3, (2.5, 3.5), area=3.1e-4, length=5.0)  # from the head of a pier to the ground
    >>> between_two = {"other": 1, "other_at": (-1.5, 3.5)}
    >>> chord = dd.PointTie(3, (1.5, 3.5), area=3.1e-4, length=3.0, **between_two)
    >>> rod.angle, chord.other
    (0.0, 1)
    """

    body: int
    at: Point
    _: KW_ONLY
    area: float
    length: float
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
        at = place_of("at", self.at)
        far = [0.0, 0.0] if self.other_at is None else place_of("other_at", self.other_at)
        numbers = [as_number(name, getattr(self, name)) for name in ("area", "length")]
        for name in ("modulus", "strength", "preload", "strain"):
            given = getattr(self, name)
            numbers.append(float(WALL_ABSENT[f"tie_{name}"]) if given is None else as_number(name, given))
        numbers.append(0.0 if self.anchor_force is None else as_number("anchor_force", self.anchor_force))
        if self.anchor_force is not None and not numbers[-1] > 0.0:
            raise argument_error("out_of_range", "anchor_force", f" = {numbers[-1]:g}: must be positive")
        return [self.body, self.other, *at, as_number("angle", self.angle), *far, *numbers]

    @classmethod
    def _of_row(cls, row: Sequence[float]) -> PointTie:
        """The tie of a row."""
        ground = not row[1] > 0.0
        return cls(
            int(row[0]),
            (-row[2], row[3]),
            area=row[7],
            length=row[8],
            angle=row[4],
            other=0 if ground else int(row[1]),
            other_at=None if ground else (-row[5], row[6]),
            modulus=row[9],
            strength=row[10],
            preload=row[11],
            strain=row[12],
            anchor_force=row[13] if row[13] > 0.0 else None,
        )

    @property
    def height(self) -> float:
        """Height of its anchor [m]."""
        return self.at[1]

    @property
    def section(self) -> float:
        """Section [m2]."""
        return self.area
