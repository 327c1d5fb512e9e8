"""Chains of two common mechanisms: horizontal bending of a wall between transverse walls, and arches, also on piers.

Both look for the weakest hinges, by the multiplier that starts the mechanism.
"""

from __future__ import annotations

import itertools
import math
from collections.abc import Sequence
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np

from dondolo._base.arguments import FloatArray, argument_error, as_count, as_number, wrong_type
from dondolo._fortran.library import constants
from dondolo.walls.chain_actions import PointLoad
from dondolo.walls.chain_parts import Body, Part, Pin, Sector
from dondolo.walls.chains import Chain
from dondolo.walls.horizontal import HorizontalBending
from dondolo.walls.wall import DEFAULT

# How much two directions may differ / the lesser, as in the library
_ALIKE = 0.02
# Voussoirs of an arch: all fours of more joints take too long
_MOST = 60


def horizontal_bending(
    length: float,
    thickness: float,
    density: float,
    *,
    thrust: float,
    sides: float,
    restitution_value: float,
    compressive_strength: float | None = None,
    hinge_depth: float | None = None,
    hinge_at: float | None = None,
    pushes: Sequence[tuple[float, float]] = (),
    name: str = DEFAULT,
) -> HorizontalBending:
    """A wall that bends horizontally between two transverse walls, an arch of two leaves in its thickness.

    It is a band of 1 m height: forces and masses of the chain are per metre of height. The transverse walls or ties
    hold its ends by a constant thrust, and its weight neither holds nor pushes it.

    Parameters
    ----------
    length, thickness : float
        Of the wall between the transverse walls [m].
    density : float
        Density of the masonry [kg/m3].
    thrust : float
        Least of the thrusts that ties and transverse walls can take, per metre of height [N/m].
    sides : float
        1, or 2 if the thrust line exists for both directions.
    restitution_value : float
        Ratio of the velocities after and before an impact.
    compressive_strength : float, optional
        Mean strength f of the masonry [Pa]. The hinges lie u = H/(2 · 0.85 f) behind the faces.
    hinge_depth : float, optional
        Depth u of the hinges [m]. With a strength the thrust is at most 0.85 f · 2 u. One of the strength and the depth
        must be given; a depth of 0, hinges at the faces, is not on the safe side.
    hinge_at : float, optional
        Place of the hinge along the wall, from its first end [m]; the weakest if left out.
    pushes : sequence of tuple
        Places along the wall [m] and forces outwards per metre of height [N/m], such as thrusts of a roof.
    name : str, optional
        Name of the wall.

    Returns
    -------
    HorizontalBending

    Raises
    ------
    InputError
        Neither a strength nor a depth, hinges that leave no lever, a thrust that crushes the masonry, or a place beyond
        the wall.

    Notes
    -----
    With leaves L₁ and L₂, s = t - 2 u and the weight W of the band, α₀ = 2 H s (1 + L₁/L₂)/(W L₁) without pushes:
    least in the middle.

    Examples
    --------
    >>> import dondolo as dd
    >>> band = dd.horizontal_bending(4.0, 0.45, 1900.0, thrust=25e3, hinge_depth=0.01, sides=2, restitution_value=0.74)
    >>> band.hinge_x
    2.0
    """
    given: dict[str, Any] = {
        "length": length, "thickness": thickness, "density": density, "end_thrust": thrust, "hinge_x": hinge_at,
        "sides": sides, "restitution_value": restitution_value, "name": name,
    }  # fmt: skip
    if pushes:
        given |= {"push": [force for _place, force in pushes], "push_x": [place for place, _force in pushes]}
    if hinge_depth is None or compressive_strength is None:
        return HorizontalBending(**given, hinge_depth=hinge_depth, compressive_strength=compressive_strength)
    # The thrust crushes the masonry as deep as the strength says.
    crushed = HorizontalBending(**given, compressive_strength=compressive_strength).base_hinge_depth
    depth = as_number("hinge_depth", hinge_depth)
    if crushed > depth:
        most = thrust * depth / crushed
        raise argument_error(
            "out_of_range", "thrust", f" = {thrust:g}: must be at most 0.85 f 2 u = {most:.6g} N/m, which crushes"
            f" the masonry at hinges {depth:g} m behind the faces")  # fmt: skip
    return HorizontalBending(**given, hinge_depth=depth)


class _Stones(NamedTuple):
    """An arch before it is cut into bodies.

    Attributes
    ----------
    inner, outer : ndarray, shape (joints, 2)
        Points of the joints at the intrados and at the extrados [m].
    parts : list
        The stones, as parts of a body.
    weight : ndarray, shape (stones,)
        Of each stone between two joints [N].
    at : ndarray, shape (stones, 2)
        Their centroids [m].
    """

    inner: FloatArray
    outer: FloatArray
    parts: list[Part | Sector]
    weight: FloatArray
    at: FloatArray


def arch(
    radius: float,
    thickness: float,
    embrace: float,
    *,
    voussoirs: int,
    density: float,
    sides: float,
    restitution_value: float,
    width: float = 1.0,
    pier: tuple[float, float] | None = None,
    hinge_depth: float = 0.0,
    loads: Sequence[PointLoad] = (),
    name: str = DEFAULT,
) -> Chain:
    """A circular arch of voussoirs, or a semicircular one on two piers, with its four weakest hinges.

    Parameters
    ----------
    radius : float
        Mean radius [m].
    thickness : float
        Of the ring [m].
    embrace : float
        Angle of the arch, 180 on piers [deg].
    voussoirs : int
        Number of voussoirs. Hinges open at their joints, so that it matters.
    density : float
        Density of the masonry [kg/m3].
    sides : float
        1 for its weaker sway alone, or 2 if it may sway to both sides.
    restitution_value : float
        Ratio of the velocities after and before an impact.
    width : float, optional
        Width across the plane of the arch [m].
    pier : tuple of float, optional
        Width and height of each of two piers, whose inner faces continue the intrados [m].
    hinge_depth : float, optional
        Depth of the hinges behind the edges of the joints [m].
    loads : sequence of PointLoad, optional
        Loads on stones, whose numbers stand in place of those of bodies: 1 is the first from the left, the left pier if
        there is one.
    name : str, optional
        Name of the wall.

    Returns
    -------
    Chain
        Three bodies, with the stones that stand still. The weaker of the sways to the right and to the left is taken,
        for `sides=1` too. The chain sways to the right, towards +x: an arch with loads that sways to the left more
        easily is given as its mirror image.

    Raises
    ------
    InputError
        An arch that falls by itself, or that no four hinges let sway; directions that differ by more than 2 % with
        `sides=2`, sizes that no arch has.

    Notes
    -----
    All fours of joints are tried, with hinges at the intrados and the extrados in turn, and those where every joint
    opens are compared by the multiplier. Voussoirs do not slide.

    Examples
    --------
    The arch of Oppenheim (1992):

    >>> import dondolo as dd
    >>> ring = dd.arch(10.0, 1.5, 157.5, voussoirs=7, density=2400.0, sides=2, restitution_value=0.7)
    >>> round(ring.impact_bound, 3)
    0.748
    """
    for what, value in {"radius": radius, "thickness": thickness, "density": density, "width": width}.items():
        if not as_number(what, value) > 0.0:
            raise argument_error("out_of_range", what, f" = {value}: must be positive")
    count = as_count("voussoirs", voussoirs, 3, _MOST)
    joints = count + 1 + 2 * (pier is not None)
    if not thickness < 2.0 * radius:
        raise argument_error("out_of_range", "thickness", f" = {thickness:g}: must be less than twice the radius")
    if not 0.0 < as_number("embrace", embrace) <= 180.0 or (pier is not None and embrace != 180.0):
        raise argument_error("out_of_range", "embrace", f" = {embrace:g}: must be at most 180, and 180 on piers")
    if not 0.0 <= as_number("hinge_depth", hinge_depth) < 0.5 * thickness:
        raise argument_error("out_of_range", "hinge_depth", f" = {hinge_depth:g}: must be 0 to half of the thickness")
    if pier is not None and not (pier[0] >= thickness and pier[1] > 0.0):
        raise argument_error(
            "out_of_range",
            "pier",
            f" = {pier}: its width must be at least the thickness of the arch, its height positive",
        )
    stones = _stones(radius, thickness, embrace, count, density, width, pier)
    for load in loads:
        if not isinstance(load, PointLoad):
            raise wrong_type("loads", load, "dondolo.PointLoad")
        if not 1 <= load.body <= joints - 1:
            raise argument_error("out_of_range", "loads", f": stone {load.body} must be one of 1 to {joints - 1}")
    found = _weakest_hinges(stones, loads, hinge_depth)
    multipliers = [one.multiplier for one in found]
    if not min(multipliers) < math.inf:
        raise argument_error(
            "out_of_range", "embrace", f" = {embrace:g}: an arch so shallow and {thickness:g} m thick has no four"
            f" hinges among its {joints} joints that open together: it slides or is crushed first")  # fmt: skip
    if min(multipliers) <= 0.0:
        raise argument_error(
            "not_at_rest", "thickness", f" = {thickness:g}: the arch falls by itself, its multiplier is"
            f" {min(multipliers):.4g} with {joints} joints")  # fmt: skip
    if sides > 1.0 and max(multipliers) > (1.0 + _ALIKE) * min(multipliers):
        raise argument_error(
            "out_of_range", "sides", f" = {sides:g}: to the right and to the left the multipliers differ,"
            f" {multipliers[0]:.4g} and {multipliers[1]:.4g}, by more than 2 %")  # fmt: skip
    if multipliers[1] < multipliers[0] * (1.0 - 1e-9):
        stones, loads = _mirrored(stones, loads)
        found = _weakest_hinges(stones, loads, hinge_depth)
    hinges = found[0]
    body_of = np.searchsorted(hinges.joints, np.arange(joints - 1), side="right")
    body_of[body_of == 4] = 0
    moving = [Body([stones.parts[k] for k in np.flatnonzero(body_of == body)]) for body in (1, 2, 3)]
    standing = [Body([stones.parts[k] for k in np.flatnonzero(body_of == 0)], stands=True)] if 0 in body_of else []
    pairs = ((1, 0), (1, 2), (2, 3), (3, 0))
    return Chain(
        height=float(max(stones.outer[:, 1]) - min(stones.inner[:, 1])),
        name=name,
        bodies=[*moving, *standing],
        joints=[Pin(*pair, (float(at[0]), float(at[1]))) for pair, at in zip(pairs, hinges.points, strict=True)],
        actions=[replace(load, body=int(body_of[load.body - 1])) for load in loads] or None,
        sides=sides,
        restitution_value=restitution_value,
    )


def _stones(
    radius: float, thickness: float, embrace: float, count: int, density: float, width: float,
    pier: tuple[float, float] | None,
) -> _Stones:  # fmt: skip
    """Joints and stones from left to right."""
    inside, outside = radius - 0.5 * thickness, radius + 0.5 * thickness
    degrees = 90.0 + embrace * (0.5 - np.arange(count + 1) / count)
    across, up = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    level = pier[1] if pier else 0.0
    inner = np.column_stack([inside * across, level + inside * up])
    outer = np.column_stack([outside * across, level + outside * up])
    parts: list[Part | Sector] = [
        Sector((0.0, level), inside, outside, start=float(b), end=float(a), width=width, density=density)
        for a, b in itertools.pairwise(degrees)
    ]
    half = np.radians(0.5 * embrace / count)
    middle = np.radians(0.5 * (degrees[:-1] + degrees[1:]))
    reach = 2.0 / 3.0 * (outside**3 - inside**3) / (outside**2 - inside**2) * math.sin(half) / half
    at = np.column_stack([reach * np.cos(middle), level + reach * np.sin(middle)])
    mass = np.full(count, density * width * half * (outside**2 - inside**2))
    if pier:
        wide, high = pier
        far = inside + wide
        # Springings are exact, so that piers share their edges.
        inner[[0, -1]], outer[[0, -1]] = [(-inside, high), (inside, high)], [(-outside, high), (outside, high)]
        inner = np.vstack([(-inside, 0.0), inner, (inside, 0.0)])
        outer = np.vstack([(-far, 0.0), outer, (far, 0.0)])
        piers = [
            Part([(s * inside, 0.0), (s * far, 0.0), (s * far, high), (s * inside, high)], width=width, density=density)
            for s in (-1.0, 1.0)
        ]
        parts = [piers[0], *parts, piers[1]]
        centre = inside + 0.5 * wide
        at = np.vstack([(-centre, 0.5 * high), at, (centre, 0.5 * high)])
        mass = np.r_[density * width * wide * high, mass, density * width * wide * high]
    return _Stones(inner, outer, parts, constants().gravity * mass, at)


def _mirrored(stones: _Stones, loads: Sequence[PointLoad]) -> tuple[_Stones, list[PointLoad]]:
    """The same from behind: an arch is its own mirror image, its loads are not."""
    count = len(stones.parts)
    return stones, [replace(load, body=count + 1 - load.body, at=(-load.at[0], load.at[1])) for load in loads]


class _Hinges(NamedTuple):
    """Four hinges: joints from the left, their points [m], and the multiplier."""

    joints: tuple[int, ...]
    points: FloatArray
    multiplier: float


def _weakest_hinges(stones: _Stones, loads: Sequence[PointLoad], depth: float) -> tuple[_Hinges, _Hinges]:
    """The weakest four alternating hinges for a motion to the right, and to the left."""
    along = stones.outer - stones.inner
    inset = depth * along / np.hypot(*along.T)[:, None]
    edges = np.array([stones.inner + inset, stones.outer - inset])
    joints = np.array(list(itertools.combinations(range(len(stones.inner)), 4)))
    best = []
    # Sums of weights and of their first moments left of each joint: of what is moved sideways, and of what is lifted
    sums = [_sums(stones, loads, held=held) for held in (False, True)]
    found = [_of_pattern(edges, joints, sums, stones, pattern) for pattern in ((0, 1, 0, 1), (1, 0, 1, 0))]
    for side in (0, 1):
        multiplier, place, points = min(
            (
                (float(alphas[side][k]), k, points[k])
                for alphas, points in found
                for k in [int(np.argmin(alphas[side]))]
            ),
            key=lambda one: one[0],
        )
        best.append(_Hinges(tuple(int(joint) for joint in joints[place]), points, multiplier))
    return best[0], best[1]


def _sums(stones: _Stones, loads: Sequence[PointLoad], *, held: bool) -> FloatArray:
    """Weight, and weight times x and y, of all stones left of each joint, with loads that are held sideways or not."""
    rows = np.column_stack([stones.weight, stones.weight[:, None] * stones.at])
    for load in loads:
        if held or not load.held:
            rows[load.body - 1] += load.force * np.array([1.0, *load.at])
    return np.vstack([np.zeros(3), np.cumsum(rows, axis=0)])


def _of_pattern(
    edges: FloatArray, joints: np.ndarray, sums: list[FloatArray], stones: _Stones, pattern: tuple[int, ...]
) -> tuple[FloatArray, FloatArray]:
    """Multipliers to the right and to the left of all fours of joints, infinite where one closes; and the hinges."""
    points = np.stack([edges[side, joints[:, k]] for k, side in enumerate(pattern)], axis=1)
    first, second, third = (points[:, k + 1] - points[:, k] for k in range(3))
    # Turns t towards +x: sum of t (P_k+1 - P_k) vanishes, with 1 of the first body
    across = second[:, 0] * third[:, 1] - second[:, 1] * third[:, 0]
    with np.errstate(divide="ignore", invalid="ignore"):
        middle = -(first[:, 0] * third[:, 1] - first[:, 1] * third[:, 0]) / across
        last = -(second[:, 0] * first[:, 1] - second[:, 1] * first[:, 0]) / across
    turns = np.column_stack([np.zeros(len(joints)), np.ones(len(joints)), middle, last, np.zeros(len(joints))])
    # A joint opens by the turn of what follows, relative to what is before, times its length
    opening = np.empty((len(joints), 4))
    for k, side in enumerate(pattern):
        far = edges[1 - side, joints[:, k]] - points[:, k]
        behind = _ahead(stones)[joints[:, k]]
        relative = turns[:, k + 1] - turns[:, k]
        opening[:, k] = relative * (far[:, 1] * behind[:, 0] - far[:, 0] * behind[:, 1])
    moved, risen = np.zeros(len(joints)), np.zeros(len(joints))
    # Velocity of a stone that turns by t about P: t (y - y_P), -t (x - x_P), from the left; each from its own hinge
    start = np.zeros((len(joints), 2))
    for k in range(3):
        t = turns[:, k + 1]
        sideways, lifted = (total[joints[:, k + 1]] - total[joints[:, k]] for total in sums)
        moved += sideways[:, 0] * start[:, 0] + t * (sideways[:, 2] - sideways[:, 0] * points[:, k, 1])
        risen += lifted[:, 0] * start[:, 1] - t * (lifted[:, 1] - lifted[:, 0] * points[:, k, 0])
        step = points[:, k + 1] - points[:, k]
        start = start + np.column_stack([t * step[:, 1], -t * step[:, 0]])
    found = np.full((2, len(joints)), np.inf)
    for sign in (1.0, -1.0):
        with np.errstate(divide="ignore", invalid="ignore"):
            is_open = np.all(sign * opening > 0.0, axis=1) & np.isfinite(across) & (across != 0.0)
            alpha = sign * risen / np.abs(moved)
        for side, way in enumerate((1.0, -1.0)):
            fits = is_open & (sign * way * moved > 0.0)
            found[side, fits] = alpha[fits]
    return found, points


def _ahead(stones: _Stones) -> FloatArray:
    """Direction across each joint, from the stone before it to the one after."""
    along = stones.outer - stones.inner
    across = np.column_stack([along[:, 1], -along[:, 0]])
    middle = 0.5 * (stones.inner + stones.outer)
    # The last joint has a stone only before it
    after = np.vstack([stones.at, 2.0 * middle[-1] - stones.at[-1]]) - middle
    result: FloatArray = across * np.sign(np.sum(across * after, axis=1))[:, None]
    return result
