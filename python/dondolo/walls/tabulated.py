"""Walls whose terms of the equation of motion are given over the rotation."""

from __future__ import annotations

import os
from collections.abc import Callable, Sequence
from dataclasses import InitVar, dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import ArrayLike

from dondolo._base.arguments import FloatArray, as_array, as_path
from dondolo._base.wording import say
from dondolo._storage.saved import part_of_results
from dondolo.walls.wall import DEFAULT, Wall

# Columns of the table of a tabulated wall
TERMS = ("rotation", "inertia", "lever", "moment", "vertical_lever")

# Columns that checks need besides
CHECK_TERMS = ("travel", "weighted_lever")

# Rotations at which functions are asked for their values
_NODES = 41

#: A term of a tabulated wall: its values, one for all rotations, or a function of the rotation
Term = float | Sequence[float] | ArrayLike | Callable[[FloatArray], ArrayLike]


@part_of_results
@dataclass(frozen=True, repr=False, kw_only=True)
class TabulatedWall(Wall):
    """A wall whose terms of the equation of motion are given: of any mechanism with one rotation.

    J(q) q'' + 1/2 J'(q) q'^2 + M(q) = -s L(q) u_g'', with M = G - Q (docs/own_mechanism.md). Height, restitution_value,
    restitution_factor, restitution_sd, restitution_seed, gravity, name and building are those of `OneSidedWall`;
    restitution_value must be given.

    Parameters
    ----------
    rotation : array_like, optional
        Rotations q of the table, from 0 to where the restoring moment has vanished [rad]. The last alone where the
        terms are functions, which are then asked for their values at 41 Chebyshev nodes.
    inertia : array_like, float or callable, optional
        Inertia J at each rotation, per metre of wall [kg m2/m].
    lever : array_like, float or callable, optional
        Sum of the masses times their horizontal levers L at each rotation, per metre of wall [kg m/m].
    moment : array_like, float or callable, optional
        Restoring moment G - Q at each rotation, per metre of wall [N m/m].
    vertical_lever : array_like, float or callable, optional
        Sum of the masses times their vertical levers S at each rotation, for vertical ground motion [kg m/m].
    travel : array_like, float or callable, optional
        Displacement d of the equivalent oscillator (C8.7.1.4) at each rotation, for checks [m].
    weighted_lever : array_like, float or callable, optional
        Sum of all weights times their horizontal levers at each rotation, for checks; gravity times lever if not given
        and nothing is carried [N m/m].
    weight : sequence of float, optional
        Weight of each body and load, for checks, per metre of wall [N/m].
    displacement : sequence of float, optional
        How far each of them moves outwards for a unit of rotation at rest [m].
    sides : float, optional
        1: the wall can rock to one side only; 2: to both, and changes side at every impact. Must be given.
    top_share : float, optional
        Share k of the acceleration of its top, relative to that of its base, that moves the wall. With top_tilt, for a
        wall in a `building` that holds its top.
    top_tilt : float, optional
        Tilt tau: factor on the displacement of the top relative to the base [1/s2].
    table : str or path, optional
        CSV file of the terms over the rotation, instead of the lists: columns rotation [rad], inertia [kg m2/m], lever
        [kg m/m], moment [N m/m] and perhaps vertical_lever [kg m/m], each with its unit in brackets; also mrad, deg,
        t m2/m, t m/m, kN m/m. With a column power in place of rotation its rows are the coefficients of polynomials in
        the rotation, and `rotation` says how far they hold.

    Raises
    ------
    InputError
        A table that is not smooth: the polynomials through it miss a value by more than 0.1 % of the largest; or one of
        no wall: inertia and lever must be positive, and the moment must fall to 0 once.

    Notes
    -----
    Polynomials of up to degree 32 pass through the table, by least squares, with as few powers as it asks for; `misfit`
    is the largest distance of a value from them. The capacity is the rotation at which the moment vanishes.

    Examples
    --------
    The block of Housner (1963) by its formulas:

    >>> import numpy as np
    >>> import dondolo as dd
    >>> block = dd.FreeStandingWall(2.0, 0.5)
    >>> mass, radius, alpha = 1800.0, np.hypot(1.0, 0.25), np.arctan2(0.25, 1.0)
    >>> same = dd.TabulatedWall(
    ...     2.0,
    ...     rotation=alpha,
    ...     inertia=4.0 / 3.0 * mass * radius**2,
    ...     lever=lambda q: mass * radius * np.cos(alpha - q),
    ...     moment=lambda q: mass * 9.81 * radius * np.sin(alpha - q),
    ...     sides=2,
    ...     restitution_value=block.restitution_coefficient,
    ... )
    >>> bool(abs(same.frequency_parameter / block.frequency_parameter - 1.0) < 1e-12)
    True
    >>> bool(same.misfit < 1e-14)
    True
    """

    mechanism: ClassVar[str] = "tabulated"

    rotation: Sequence[float] | ArrayLike = DEFAULT
    inertia: Term = DEFAULT
    lever: Term = DEFAULT
    moment: Term = DEFAULT
    vertical_lever: Term | None = None
    travel: Term | None = None
    weighted_lever: Term | None = None
    weight: Sequence[float] | None = None
    displacement: Sequence[float] | None = None
    sides: float = DEFAULT
    top_share: float | None = None
    top_tilt: float | None = None
    table: InitVar[str | os.PathLike[str] | None] = None

    def __post_init__(self, table: str | os.PathLike[str] | None) -> None:
        if table is None and self.rotation is not None:
            self._sample()
        self._understand(table=None if table is None else as_path(table).decode())

    def _sample(self) -> None:
        """Put values in the place of functions and of single numbers."""
        q = as_array("rotation", np.ravel(np.asarray(self.rotation)))
        if np.ndim(self.rotation) == 0:
            q = 0.5 * q * (1.0 - np.cos(np.pi * np.arange(_NODES) / (_NODES - 1)))
        object.__setattr__(self, "rotation", q)
        for name in (*TERMS[1:], *CHECK_TERMS):
            term = getattr(self, name)
            if term is None:
                continue
            values = as_array(name, np.ravel(np.asarray(term(q) if callable(term) else term)))
            object.__setattr__(self, name, np.full(len(q), values[0]) if len(values) == 1 else values)

    @property
    def misfit(self) -> float:
        """Largest distance of a value of the table from the polynomial that is computed with / largest value."""
        return self._static(11)

    def _facts(self) -> list[tuple[str, str]]:
        """What a reader wants to know: of the table how far it goes."""
        facts = dict(super()._facts())
        rotation = np.asarray(self.rotation)
        table = {"rotations": rotation.size, "last": float(rotation[-1]), "misfit": float(self.misfit)}
        own = {say("table"): say("{rotations} rotations up to {last:.6g} rad, misfit {misfit:.2g}", **table)}
        left_out = (*TERMS, *CHECK_TERMS, "R", "alpha")
        return [*own.items(), *((what, text) for what, text in facts.items() if what not in left_out)]
