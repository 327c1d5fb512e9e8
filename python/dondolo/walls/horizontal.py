"""Walls that bend horizontally between transverse walls."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import ClassVar

from dondolo._storage.saved import part_of_results
from dondolo.walls.chains import ChainWall
from dondolo.walls.wall import DEFAULT


@part_of_results
@dataclass(frozen=True, repr=False, kw_only=True)
class HorizontalBending(ChainWall):
    """A wall that bends horizontally between two transverse walls, an arch of two leaves in its thickness.

    It is a band of 1 m height, a chain of rigid bodies in its plan (docs/chains.md): masses and forces are those of
    this band. The transverse walls or ties hold its ends by a constant thrust, and its weight neither holds nor pushes
    it. Density, restitution_value, restitution_factor, restitution_sd, restitution_seed, base_level, gravity, name and
    building are those of `OneSidedWall`; restitution_value must be given. Its height is its length.

    Parameters
    ----------
    length : float, optional
        Length of a wall that bends horizontally, between the transverse walls [m]. Must be given.
    thickness : float
        Thickness of the wall [m].
    end_thrust : float, optional
        Thrust that holds both its ends, per metre of height: the least of what ties and transverse walls can take
        [N/m]. Must be given.
    density : float, optional
        Density of the masonry [kg/m3], 1800 if left out.
    sides : float, optional
        1: the wall can rock to one side only; 2: to both, and changes side at every impact, where the thrust line
        exists for both. Must be given.
    hinge_depth : float, optional
        Depth of the hinge behind the outer face, of two_block and horizontal of each hinge behind its face [m]. It or
        compressive_strength must be given; 0, hinges at the faces, is not on the safe side.
    compressive_strength : float, optional
        Strength of the masonry, from which that depth follows [Pa]: the thrust over 2 · 0.85 f.
    stress_block : float, optional
        Stress in the compressed part of the base / that strength, 0.85 if not given.
    hinge_x : float, optional
        Place of the hinge along it, from its first end [m]; where it is weakest if left out.
    push : sequence of float, optional
        Forces that push it outwards, per metre of height, such as thrusts of a roof [N/m].
    push_x : sequence of float, optional
        Places of these forces along it, from its first end [m].

    Raises
    ------
    InputError
        An invalid value; the message is that of the executable.

    Notes
    -----
    The wall keeps the hinge that it has found: ``replace(wall, thickness=0.3, hinge_x=None)`` finds that of another.

    Examples
    --------
    >>> import dondolo as dd
    >>> band = dd.HorizontalBending(
    ...     length=4.0,
    ...     thickness=0.45,
    ...     density=1900.0,
    ...     end_thrust=25e3,
    ...     compressive_strength=1.5e6,
    ...     push=[400.0],
    ...     push_x=[1.5],
    ...     sides=1,
    ...     restitution_value=0.7,
    ... )
    >>> round(band.hinge_x, 3)
    1.971
    >>> round(band.trigger_acceleration / band.gravity, 4)
    0.6234
    """

    mechanism: ClassVar[str] = "horizontal"

    length: float = DEFAULT
    thickness: float = DEFAULT
    end_thrust: float = DEFAULT
    density: float = DEFAULT
    hinge_depth: float | None = None
    compressive_strength: float | None = None
    stress_block: float | None = None
    hinge_x: float | None = None
    push: Sequence[float] | None = None
    push_x: Sequence[float] | None = None
    sides: float = DEFAULT

    def _share(self) -> float:
        """None of gravity acts in the plane of the motion, which is the plan."""
        return 0.0

    def _facts(self) -> list[tuple[str, str]]:
        """What a reader wants to know."""
        return [(what, text) for what, text in super()._facts() if what not in ("R", "alpha", "height")]
