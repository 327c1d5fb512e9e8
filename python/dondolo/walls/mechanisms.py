"""The walls of each mechanism."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import KW_ONLY, InitVar, dataclass
from typing import ClassVar, Literal

from dondolo._fortran.walls import WallData
from dondolo._storage.saved import part_of_results
from dondolo.walls.parts import Bed, Interlock, Load, PushedMass, Section, Spring, Thrust, Tie
from dondolo.walls.wall import DEFAULT, Terms, Wall

# What the package exports of the walls: a new mechanism is added here alone
__all__ = ["FreeStandingWall", "OneSidedWall", "Terms", "TwoBlockWall", "Wall"]


@dataclass(frozen=True, repr=False, kw_only=True)
class BlockWall(Wall):
    """What walls of one block share: storeys, the hinge, and what they carry."""

    sections: Sequence[Section] = ()
    mass: float | None = None
    centroid_depth: float | None = None
    centroid_height: float | None = None
    hinge_inertia: float | None = None
    hinge_depth: float | None = None
    compressive_strength: float | None = None
    stress_block: float | None = None
    edge_radius: float | None = None
    loads: Sequence[Load] = ()
    pushed_masses: Sequence[PushedMass] = ()
    thrusts: Sequence[Thrust] = ()
    springs: Sequence[Spring] = ()
    beds: Sequence[Bed] = ()


@part_of_results
@dataclass(frozen=True, repr=False)
class OneSidedWall(BlockWall):
    """A wall that rotates outwards only, about its outer base edge (a facade that came loose, a parapet).

    Parameters
    ----------
    height : float
        Height of the wall [m].
    thickness : float
        Thickness of the wall [m].
    density : float, optional
        Density of the masonry [kg/m3], 1800 if left out.
    restitution : {'default', 'sorrentino', 'impulse', 'constant'}, optional
        Model of the impacts, 'default' if left out: against the walls behind that of Sorrentino, AlShawa and Decanini
        (2011) for the bare block; 'impulse' is the same balance with the depth of the hinge and the masses that the
        wall carries.
    restitution_value : float, optional
        Speed after / before an impact, only with restitution = 'constant': 0 <= value < 1.
    restitution_factor : float, optional
        Factor on the speed ratio of any model, 1 if left out.
    gravity : float, optional
        Acceleration of gravity [m/s2], 9.81 if left out.
    name : str, optional
        Name in the results, 'wall' if left out.
    building : Building, optional
        What the wall stands on, where that is not the ground: its floor moves as the building makes it.
    sections : sequence of Section, optional
        Storeys from the bottom, instead of height and thickness.
    leaves : float, optional
        Number of equal leaves that nothing connects: each rocks alone with its part of the thickness.
    hinge_level : float, optional
        Heights of hinges: each makes a wall of what is above it [m]. A wall has one: it becomes the part of the facade
        above that level; `facade` makes a wall of each of several.
    hinge_at : {'storeys'}, optional
        A hinge at the bottom of every section, instead of hinge_level, for `facade`.
    mass : float, optional
        Mass of the body, instead of its density [kg/m].
    centroid_depth : float, optional
        Depth of its centroid behind the outer face, with mass [m].
    centroid_height : float, optional
        Height of its centroid, with mass [m].
    hinge_inertia : float, optional
        Its inertia about the hinge, with mass [kg m2/m].
    hinge_depth : float, optional
        Depth of the hinge behind the outer face, of each hinge of two_block behind its face [m].
    compressive_strength : float, optional
        Strength of the masonry, from which that depth follows [Pa].
    stress_block : float, optional
        Stress in the compressed part of the base / that strength, 0.85 if not given.
    edge_radius : float, optional
        Radius of the edge that the wall rolls on, which is also the depth of its hinge at rest [m].
    loads : sequence of Load, optional
        Vertical loads that go with the wall.
    pushed_masses : sequence of PushedMass, optional
        Masses that the wall pushes and does not carry.
    thrusts : sequence of Thrust, optional
        Horizontal forces outwards.
    springs : sequence of Spring, optional
        Springs that pull and push.
    beds : sequence of Bed, optional
        Springs spread over a height.
    ties : sequence of Tie, optional
        Ties that hold the wall.
    interlock : Interlock, optional
        Stones that overlap those of transverse walls, whose friction holds the wall.
    masonry_compression : float, optional
        Mean strength of the masonry in compression at plates of ties; compressive_strength if not given [Pa].
    masonry_shear : float, optional
        Mean shear strength without compression there [Pa].
    masonry_tension : float, optional
        Mean tensile strength there [Pa].
    masonry_friction : float, optional
        Coefficient of friction there, with tie_compression.
    masonry_knowledge_factor : float, optional
        Confidence factor FC of these strengths, which are divided by 2 FC; 1.35 if not given.
    bearing_factor : float, optional
        Strength under a plate / strength of the masonry, of the engineer; 1.0 if not given.

    Raises
    ------
    InputError
        A value that makes no sense, with the sentence of the executable.

    Notes
    -----
    Equation (1) of Nale et al.; docs/theory.md, section 2. Depths are measured from the outer face of the base, towards
    which the wall falls, heights from the base.

    Examples
    --------
    >>> import dondolo as dd
    >>> wall = dd.OneSidedWall(height=3.0, thickness=0.25)
    >>> round(wall.frequency_parameter, 6)
    2.210895

    A floor of 10 kN/m whose mass the wall pushes too, and a roof that thrusts:

    >>> facade = dd.OneSidedWall(
    ...     3.0,
    ...     0.25,
    ...     loads=[dd.Load(10e3, depth=0.175, height=3.0, inertia="both")],
    ...     thrusts=[dd.Thrust(200.0, height=3.0)],
    ... )
    >>> round(facade.trigger_acceleration / facade.gravity, 4)
    0.0563
    """

    mechanism: ClassVar[str] = "one_sided"

    _: KW_ONLY
    ties: Sequence[Tie] = ()
    interlock: Interlock | None = None
    masonry_compression: float | None = None
    masonry_shear: float | None = None
    masonry_tension: float | None = None
    masonry_friction: float | None = None
    masonry_knowledge_factor: float | None = None
    bearing_factor: float | None = None
    leaves: float | None = None
    hinge_level: InitVar[float | Sequence[float] | None] = None
    hinge_at: InitVar[Literal["storeys"] | None] = None

    def __post_init__(self, hinge_level: float | Sequence[float] | None, hinge_at: str | None) -> None:
        self._understand(hinge_level=hinge_level, hinge_at=hinge_at)


@part_of_results
@dataclass(frozen=True, repr=False)
class FreeStandingWall(BlockWall):
    """A wall that stands free and rocks to both sides (the block of Housner 1963).

    Parameters are those of `OneSidedWall` except its ties; the models of restitution are 'default', 'impulse' (both
    1 - 3/2 sin^2 alpha for a bare block) and 'constant'. Since it rocks to both sides, what it carries bears at half
    its thickness, and nothing thrusts.

    Examples
    --------
    >>> import dondolo as dd
    >>> pinnacle = dd.FreeStandingWall(height=1.5, thickness=0.25, name="pinnacle")
    >>> pinnacle.two_sided
    True
    """

    mechanism: ClassVar[str] = "free_standing"


@part_of_results
@dataclass(frozen=True, repr=False, kw_only=True)
class TwoBlockWall(Wall):
    """A vertical strip held at base and top that folds at a hinge in between (equation (3) of Nale et al.).

    Parameters are those of a bare `OneSidedWall`, its hinge_depth, compressive_strength and stress_block, the models
    of restitution 'default', 'sorrentino', 'impulse' and 'constant', and those below. 'default' is 'sorrentino', or
    'impulse' where the wall lifts the mass of an overburden, which 'sorrentino' does not know.

    Parameters
    ----------
    hinge : float, optional
        Height of the intermediate hinge / height of the wall, 0.5 if left out.
    overburden : float, optional
        Vertical load on the top, per metre of wall [N/m], 0 if left out.
    overburden_inertia : float, optional
        Part of that load whose mass the wall lifts: 0 for a force alone (springs, tendons), 1 for a storey of wall
        above. It decides the result and must be given with a load (docs/loads.md).
    eccentricity : float, optional
        Distance of that load from the centreline towards the active top hinge [m], 0 if left out. The hinge of a wall
        that folds outwards is at its outer face: a load nearer the inner face has a negative eccentricity.
    bearing : {'inner', 'outer', 'centre'}, optional
        Where that load bears, instead of the eccentricity: near the inner or the outer face, or on the centreline.
    bearing_distance : float, optional
        Distance of the load's resultant from the inner or the outer face [m]: half the length that joists bear on the
        wall, a third where they bear harder on its edge.

    Notes
    -----
    The wall keeps a bearing as its eccentricity. It is that of a wall that folds outwards; docs/theory.md, section 2.

    Examples
    --------
    Joists that bear 0.12 m into the wall from its inner face:

    >>> import dondolo as dd
    >>> wall = dd.TwoBlockWall(
    ...     3.0, 0.25, overburden=8000.0, overburden_inertia=0.0, bearing="inner", bearing_distance=0.06
    ... )
    >>> wall.eccentricity
    -0.065
    """

    mechanism: ClassVar[str] = "two_block"

    hinge: float = DEFAULT
    overburden: float = DEFAULT
    overburden_inertia: float | None = None
    eccentricity: float = DEFAULT
    hinge_depth: float | None = None
    compressive_strength: float | None = None
    stress_block: float | None = None
    bearing: InitVar[Literal["inner", "outer", "centre"] | None] = None
    bearing_distance: InitVar[float | None] = None

    def __post_init__(self, bearing: str | None, bearing_distance: float | None) -> None:
        self._understand(bearing=bearing, bearing_distance=bearing_distance)


MECHANISMS: dict[str, type[Wall]] = {kind.mechanism: kind for kind in (OneSidedWall, FreeStandingWall, TwoBlockWall)}


def wall_from(data: WallData) -> Wall:
    """A wall that Fortran has understood already."""
    wall = object.__new__(MECHANISMS[data.properties["mechanism"]])
    wall._fill(data)
    return wall
