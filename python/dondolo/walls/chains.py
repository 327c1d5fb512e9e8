"""Walls that are chains of rigid bodies with one degree of freedom: bodies, joints, and what acts on them."""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import InitVar, dataclass
from pathlib import Path
from typing import Any, ClassVar, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from dondolo._base.arguments import FloatArray, argument_error, as_path, wrong_type
from dondolo._fortran.walls import chain_facts, chain_motion, chain_rows
from dondolo._storage.saved import part_of_results
from dondolo.walls.chain_actions import PointLoad, PointMass, PointThrust, PointTie
from dondolo.walls.chain_parts import CORNER, SECTOR, Body, Guide, Pin, Point, flat_bodies
from dondolo.walls.chain_tables import write_tables
from dondolo.walls.wall import DEFAULT, Wall, upload

# Numbers of a row of each table
TABLES = {"body_table": 11, "joint_table": 8, "action_table": 10, "tie_table": 14}

# Sides of the outline of a sector on each of its arcs
_SIDES = 24


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


class ChainWall(Wall):
    """Base class of walls that are chains of rigid bodies, whose rows are given or follow from their geometry."""

    sides: float

    def _share(self) -> float:
        """Part of gravity that acts in the plane of the motion."""
        return 1.0

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
        """Write the files of its bodies, joints, actions and ties, for a case or a table of walls.

        Parameters
        ----------
        prefix : str or path
            What their names begin with: `arch` gives `arch_bodies.csv`, `arch_joints.csv`, `arch_actions.csv` and
            `arch_ties.csv`, the last two only if something acts on it and if it has ties. Files of these names are
            replaced.

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
        return chain_rows(upload((self,)), 1 + [*TABLES].index(table)).reshape(-1, TABLES[table])

    def _outlines_at_rest(self) -> list[tuple[int, bool, FloatArray]]:
        """Outlines of the parts: those of masses that are given are not known."""
        found: list[tuple[int, bool, list[Point]]] = []
        last: tuple[float, ...] = ()
        for row in self._rows("body_table"):
            body, kind, is_opening, at = int(row[0]), int(row[2]), bool(row[3] < 0.0), (-row[5], row[6])
            if kind == SECTOR:
                angles = np.radians(np.linspace(row[9], row[10], _SIDES + 1))
                arcs = [
                    (at[0] + r * np.cos(a), at[1] + r * np.sin(a))
                    for r, way in ((row[8], angles), (row[7], angles[::-1]))
                    for a in way
                ]
                found.append((body, is_opening, arcs))
            elif kind == CORNER:
                if tuple(row[:3]) != last:
                    found.append((body, is_opening, []))
                found[-1][2].append(at)
            last = tuple(row[:3])
        return [(body, is_opening, np.array(corners)) for body, is_opening, corners in found]


@part_of_results
@dataclass(frozen=True, repr=False, kw_only=True)
class Chain(ChainWall):
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
    ties : str, path or sequence of PointTie, optional
        CSV file of ties, which hold its bodies outwards, or the ties.
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
    tie_table : sequence of float, optional
        Rows of the ties as numbers, 14 a row, instead of their file.

    Raises
    ------
    InputError
        Joints that leave more or less than one degree of freedom, or depend on one another; bodies that overlap; a
        hinge on the side on which its joint closes; a chain that does not stand at rest without its ties; a tie that
        the motion does not stretch; two sides whose multipliers or capacities differ by more than 2 %.

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
    ties: InitVar[str | os.PathLike[str] | Sequence[PointTie] | None] = None
    driver: float | None = None
    gravity_share: float | None = None
    sides: float = DEFAULT
    body_table: Sequence[float] | None = None
    joint_table: Sequence[float] | None = None
    action_table: Sequence[float] | None = None
    tie_table: Sequence[float] | None = None

    def __post_init__(self, bodies: Any, joints: Any, actions: Any, ties: Any) -> None:
        files = {}
        kinds = {
            "bodies": (bodies, "body_table", (Body,)),
            "joints": (joints, "joint_table", (Pin, Guide)),
            "actions": (actions, "action_table", (PointLoad, PointMass, PointThrust)),
            "ties": (ties, "tie_table", (PointTie,)),
        }
        for name, (given, table, kind) in kinds.items():
            if given is None:
                continue
            if isinstance(given, (str, os.PathLike)):
                files[name] = as_path(given).decode()
                continue
            if getattr(self, table) is not None:
                raise argument_error("not_together", table, f": give either it or {name}")
            for one in given:
                if not isinstance(one, kind):
                    raise wrong_type(name, one, " or ".join(f"dondolo.{each.__name__}" for each in kind))
            numbers = flat_bodies(given) if name == "bodies" else [float(x) for one in given for x in one._row()]
            object.__setattr__(self, table, numbers or None)
        self._understand(**files)

    def _share(self) -> float:
        """Part of gravity that acts in the plane of the motion."""
        return 1.0 if self.gravity_share is None else self.gravity_share

    def _rows(self, table: str) -> FloatArray:
        """Rows of a table, without asking Fortran."""
        given = getattr(self, table)
        return np.asarray([] if given is None else given, dtype=np.float64).reshape(-1, TABLES[table])

    def _facts(self) -> list[tuple[str, str]]:
        """What a reader wants to know: how many bodies and joints it has, not their numbers."""
        facts = dict(super()._facts())
        facts |= {table: str(len(self._rows(table))) for table in TABLES if table in facts}
        return [(what, text) for what, text in facts.items() if what not in ("R", "alpha")]
