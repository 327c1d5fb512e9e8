"""The walls of each mechanism."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import KW_ONLY, InitVar, dataclass
from typing import TYPE_CHECKING, Any, ClassVar, Literal

from dondolo._base.arguments import argument_error, as_number
from dondolo._fortran.walls import WallData, bending_period
from dondolo._storage.saved import part_of_results
from dondolo.walls.chains import Chain
from dondolo.walls.horizontal import HorizontalBending
from dondolo.walls.parts import (
    DistributedSpring,
    InertialMass,
    Interlock,
    Load,
    Opening,
    Section,
    Spring,
    Thrust,
    Tie,
    Wedge,
)
from dondolo.walls.tabulated import TabulatedWall
from dondolo.walls.wall import DEFAULT, MasonryWall, Terms, Wall, upload

if TYPE_CHECKING:
    from matplotlib.axes import Axes

# What the package exports of the walls: a new mechanism is added here alone
__all__ = [
    "Chain",
    "Corner",
    "FreeStandingWall",
    "HorizontalBending",
    "OneSidedWall",
    "TabulatedWall",
    "Terms",
    "TwoBlockWall",
    "Wall",
]


@dataclass(frozen=True, repr=False, kw_only=True)
class BlockWall(MasonryWall):
    """Base class of walls of one block: storeys, hinge, and loads."""

    sections: Sequence[Section] = ()
    mass: float | None = None
    centroid_depth: float | None = None
    centroid_height: float | None = None
    hinge_inertia: float | None = None
    hinge_depth: float | None = None
    compressive_strength: float | None = None
    stress_block: float | None = None
    young_modulus: float | Sequence[float] | None = None
    edge_radius: float | None = None
    loads: Sequence[Load] = ()
    inertial_masses: Sequence[InertialMass] = ()
    thrusts: Sequence[Thrust] = ()
    springs: Sequence[Spring] = ()
    distributed_springs: Sequence[DistributedSpring] = ()


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
    base_level : float, optional
        Height of its base above the ground, on a building that is not given: a check by a code has no spectrum there;
        hinge_level sets it [m].
    restitution : {'default', 'sorrentino', 'impulse'}, optional
        Model of the impacts, 'default' if left out: against the walls behind that of Sorrentino, AlShawa and Decanini
        (2011) for the bare block; 'impulse' is the same balance with the depth of the hinge and the masses that the
        wall carries.
    restitution_value : float, optional
        Speed after / before an impact, instead of a model: 0 <= value < 1.
    restitution_factor : float, optional
        Factor on the restitution e of any model, 1 if left out.
    restitution_sd : float, optional
        Standard deviation of the restitution e, which then varies from impact to impact, uniformly about that of the
        model (docs/theory.md, section 3).
    restitution_seed : float, optional
        Seed of the random numbers of these ratios, 1 if not given.
    gravity : float, optional
        Acceleration of gravity [m/s2], 9.81 if left out.
    name : str, optional
        Name in the results, 'wall' if left out.
    building : Building, optional
        Building that the wall stands on, if not on the ground: it moves the wall's floor.
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
        Depth of the hinge behind the outer face, of two_block and horizontal of each hinge behind its face [m].
    compressive_strength : float, optional
        Strength of the masonry, from which that depth follows [Pa].
    stress_block : float, optional
        Stress in the compressed part of the base / that strength, 0.85 if not given.
    young_modulus : float or sequence of float, optional
        Young's modulus of the masonry of a free element, reduced for cracks: one value or a range, for checks [Pa].
        The wall is then a free element; docs/code_checks.md has the values of Table C8.5.I.
    free : bool, optional
        Is the wall a free element, such as a parapet, which no transverse walls hold?
    edge_radius : float, optional
        Radius of the edge that the wall rolls on, which is also the depth of its hinge at rest [m].
    loads : sequence of Load, optional
        Vertical loads that go with the wall.
    inertial_masses : sequence of InertialMass, optional
        Masses that the wall pushes and does not carry.
    thrusts : sequence of Thrust, optional
        Horizontal forces outwards.
    springs : sequence of Spring, optional
        Springs that pull and push.
    distributed_springs : sequence of DistributedSpring, optional
        Springs spread over a height.
    ties : sequence of Tie, optional
        Ties that hold the wall.
    interlock : Interlock, optional
        Stones that overlap those of transverse walls, whose friction holds the wall.
    facade_length : float, optional
        Length of the facade: the masses of its wedges, and of an elevation, are divided by it [m].
    wedges : sequence of Wedge, optional
        Wedges of transverse walls that turn with the wall. 'default' is then 'impulse', the only model of restitution.
    elevation_x : sequence of float, optional
        Places along the facade of the corners of its elevation, around it, instead of height [m].
    elevation_z : sequence of float, optional
        Heights of these corners above the base [m]. 'default' is then 'impulse', the only model of restitution.
    openings : sequence of Opening, optional
        Doors and windows in this elevation.
    axis_x : sequence of float, optional
        Places along the facade of two points of the line about which what is above it turns [m]: a panel, whose heights
        are distances from this line, in the face. Loads, masses and thrusts then have an x.
    axis_z : sequence of float, optional
        Heights of these two points above the base [m].
    half_gable : bool, optional
        Is the panel one half of a gable that its ridge pushes out? It then has a check, and no time histories.
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
        An invalid value; the message is that of the executable.

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
    facade_length: float | None = None
    wedges: Sequence[Wedge] = ()
    elevation_x: Sequence[float] | None = None
    elevation_z: Sequence[float] | None = None
    openings: Sequence[Opening] = ()
    axis_x: Sequence[float] | None = None
    axis_z: Sequence[float] | None = None
    half_gable: bool | None = None
    masonry_compression: float | None = None
    masonry_shear: float | None = None
    masonry_tension: float | None = None
    masonry_friction: float | None = None
    masonry_knowledge_factor: float | None = None
    bearing_factor: float | None = None
    leaves: float | None = None
    free: bool | None = None
    hinge_level: InitVar[float | Sequence[float] | None] = None
    hinge_at: InitVar[Literal["storeys"] | None] = None

    def __post_init__(self, hinge_level: float | Sequence[float] | None, hinge_at: str | None) -> None:
        self._understand(hinge_level=hinge_level, hinge_at=hinge_at)

    def plot_elevation(self, ax: Axes | None = None, **options: Any) -> Axes:
        """Draw the elevation of the wall with its openings, and the line that it turns about.

        Parameters
        ----------
        ax : Axes, optional
            Where to draw; a new figure if left out.
        **options
            Parts to leave out by False, as for `plot`: see docs/printing.md.

        Returns
        -------
        Axes
            Metres, to scale. What is below the line stays.

        Raises
        ------
        InputError
            A wall without an elevation.

        Examples
        --------
        >>> import dondolo as dd
        >>> gable = {"elevation_x": [0.0, 6.0, 6.0, 3.0, 0.0], "elevation_z": [0.0, 0.0, 5.0, 7.0, 5.0]}
        >>> facade = dd.OneSidedWall(thickness=0.5, density=1900.0, facade_length=6.0, **gable)
        >>> facade.plot_elevation().get_ylabel()
        'z [m]'
        """
        from dondolo.figures.options import Options
        from dondolo.walls.drawing_elevation import draw_elevation

        if self.elevation_x is None:
            raise argument_error("not_given", "elevation_x", ": the wall has no elevation to draw")
        return draw_elevation(self, ax, Options(options))


@part_of_results
@dataclass(frozen=True, repr=False)
class FreeStandingWall(BlockWall):
    """A wall that stands free and rocks to both sides (the block of Housner 1963).

    Parameters are those of `OneSidedWall` except its ties; the models of restitution are 'default' and 'impulse',
    both 1 - 3/2 sin^2 alpha for a bare block. Since it rocks to both sides, what it carries bears at half
    its thickness, and nothing thrusts.

    Examples
    --------
    >>> import dondolo as dd
    >>> pinnacle = dd.FreeStandingWall(height=1.5, thickness=0.25, name="pinnacle")
    >>> pinnacle.two_sided
    True

    A restitution that varies from impact to impact:

    >>> varying = dd.FreeStandingWall(1.5, 0.25, restitution_sd=0.01)
    >>> varying.restitution_coefficient == pinnacle.restitution_coefficient
    True
    """

    mechanism: ClassVar[str] = "free_standing"


@part_of_results
@dataclass(frozen=True, repr=False, kw_only=True)
class TwoBlockWall(MasonryWall):
    """A vertical strip held at base and top that folds at a hinge in between (equation (3) of Nale et al.).

    Parameters are those of a bare `OneSidedWall`, its hinge_depth, compressive_strength and stress_block, the models
    of restitution 'default', 'sorrentino' and 'impulse', and those below. 'default' is 'sorrentino', or
    'impulse' where the wall lifts the mass of an overburden, which 'sorrentino' does not include.

    Parameters
    ----------
    hinge : float, optional
        Height of the intermediate hinge / height of the wall; where alpha_0 is least if left out, as the code asks.
    hinge_range : sequence of float, optional
        Lowest and highest such height among which the weakest hinge is looked for, 0.1 and 0.9 if not given.
    elastic_period : float, optional
        Period of the small vibrations of the strip between its supports, load included, before its joints open [s]:
        such a strip bends before it rocks (docs/theory.md, section 7). Rigid blocks if left out.
    elastic_damping : float, optional
        Damping ratio of these vibrations, with elastic_period; 0.05 if not given.
    overburden : float, optional
        Vertical load on the top, per metre of wall [N/m], 0 if left out.
    overburden_inertia : float, optional
        Part of that load whose mass the wall lifts: 0 for a force alone (springs, tendons), 1 for a storey of wall
        above. It decides the result and must be given with a load (docs/mechanisms.md).
    eccentricity : float, optional
        Distance of that load from the centreline towards the active top hinge [m], 0 if left out. The hinge of a wall
        that folds outwards is at its outer face: a load nearer the inner face has a negative eccentricity.
    bearing : {'inner', 'outer', 'centre'}, optional
        Where that load bears, instead of the eccentricity: near the inner or the outer face, or on the centreline.
    bearing_distance : float, optional
        Distance of the load's resultant from the inner or the outer face [m]: half the length that joists bear on the
        wall, a third where they bear harder on its edge.
    loads : sequence of Load, optional
        Vertical loads that go with the wall, such as floors between its base and its top.
    inertial_masses : sequence of InertialMass, optional
        Masses that the wall pushes and does not carry.
    thrusts : sequence of Thrust, optional
        Horizontal forces outwards; they do not decay.
    ties : sequence of Tie, optional
        Ties that hold the wall between its base and its top; the masonry at their plates is that of `OneSidedWall`.

    Notes
    -----
    The wall keeps the hinge that it has found: ``replace(wall, thickness=0.3, hinge=None)`` finds that of another one.
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
    hinge_range: Sequence[float] | None = None
    elastic_period: float | None = None
    elastic_damping: float | None = None
    overburden: float = DEFAULT
    overburden_inertia: float | None = None
    eccentricity: float = DEFAULT
    hinge_depth: float | None = None
    compressive_strength: float | None = None
    stress_block: float | None = None
    loads: Sequence[Load] = ()
    inertial_masses: Sequence[InertialMass] = ()
    thrusts: Sequence[Thrust] = ()
    ties: Sequence[Tie] = ()
    masonry_compression: float | None = None
    masonry_shear: float | None = None
    masonry_tension: float | None = None
    masonry_friction: float | None = None
    masonry_knowledge_factor: float | None = None
    bearing_factor: float | None = None
    bearing: InitVar[Literal["inner", "outer", "centre"] | None] = None
    bearing_distance: InitVar[float | None] = None

    def __post_init__(self, bearing: str | None, bearing_distance: float | None) -> None:
        self._understand(bearing=bearing, bearing_distance=bearing_distance)

    def bending_period(self, young_modulus: float) -> float:
        """Period of the small vibrations of the strip between pinned ends: a proposal for `elastic_period`.

        Parameters
        ----------
        young_modulus : float
            Modulus of elasticity of the masonry, cracks included [Pa].

        Returns
        -------
        float
            T_1 = (2/pi) H^2 sqrt(m/(E I c)), c = 1 - (N + W/2) H^2/(pi^2 E I) [s] (docs/theory.md, section 7).
            A measured period comes first: joints close under load, so that a wall gets stiffer with it, and this
            formula softer.

        Raises
        ------
        InputError
            A modulus that is not positive, or under which the load buckles the strip.

        Examples
        --------
        >>> import dondolo as dd
        >>> strip = dd.TwoBlockWall(3.0, 0.25, overburden=5000.0, overburden_inertia=0.0, hinge=0.6)
        >>> round(strip.bending_period(1e9), 6)
        0.106951
        """
        modulus = as_number("young_modulus", young_modulus)
        if not modulus > 0.0:
            raise argument_error("out_of_range", "young_modulus", f" = {modulus:.6g}: must be positive")
        period = bending_period(upload((self,)), modulus)
        if not period < 1e9:
            raise argument_error("out_of_range", "young_modulus", f" = {modulus:.6g}: the load buckles the strip")
        return period


@part_of_results
@dataclass(frozen=True, repr=False)
class Corner(MasonryWall):
    """A corner of two walls at right angles that overturns along their bisector (*ribaltamento del cantonale*).

    Cracks rise in both walls from the base of the corner, and the masonry above them turns about a hinge near its outer
    edge. Depths of loads and thrusts are measured on the bisector, from the outer edge inwards; records are components
    along the bisector (docs/mechanisms.md). Masses and forces are those of the whole corner, so that its loads and
    thrusts have a `total` in place of a force per metre. Density, restitution_value, restitution_factor,
    restitution_sd, restitution_seed, base_level, gravity, name and building are those of `OneSidedWall`; the only model
    of restitution is 'impulse'.

    Parameters
    ----------
    height : float
        Height of the wall [m].
    thickness : float
        Thickness of the wall [m], of both walls.
    wing_angle : float, optional
        Angle of the cracks in both walls of a corner with the vertical; 0: no wings [deg]. Must be given.
    wing_length : float, optional
        Greatest length of each wing behind the inner face of the other wall, up to the first opening; none if not given
        [m].
    hinge_depth : float, optional
        Depth of the hinge behind the outer face, of two_block and horizontal of each hinge behind its face [m]:
        of a corner behind its outer edge, on the bisector. It or compressive_strength must be given.
    compressive_strength : float, optional
        Strength of the masonry, from which that depth follows [Pa].
    stress_block : float, optional
        Stress in the compressed part of the base / that strength, 0.85 if not given.
    loads : sequence of Load, optional
        Vertical loads that go with the wall.
    thrusts : sequence of Thrust, optional
        Horizontal forces outwards, along the bisector.
    ties : sequence of Tie, optional
        Ties along one of the two walls each, by the diameter of their `bar`; `depth` is that of the anchor on the
        bisector.
    hinge_level : float, optional
        Heights of hinges: each makes a wall of what is above it [m]. The cracks then begin at this level.

    Raises
    ------
    InputError
        An invalid value; the message is that of the executable.

    Examples
    --------
    A corner with a hip rafter that thrusts:

    >>> import dondolo as dd
    >>> corner = dd.Corner(
    ...     3.2,
    ...     0.5,
    ...     density=1900.0,
    ...     wing_angle=30.0,
    ...     hinge_depth=0.03,
    ...     loads=[dd.Load(total=6e3, depth=0.45, height=3.2, inertia="both")],
    ...     thrusts=[dd.Thrust(total=2e3, depth=0.4, height=3.2)],
    ... )
    >>> round(corner.trigger_acceleration / corner.gravity, 4)
    0.3269
    """

    mechanism: ClassVar[str] = "corner"

    _: KW_ONLY
    wing_angle: float = DEFAULT
    wing_length: float | None = None
    hinge_depth: float | None = None
    compressive_strength: float | None = None
    stress_block: float | None = None
    loads: Sequence[Load] = ()
    thrusts: Sequence[Thrust] = ()
    ties: Sequence[Tie] = ()
    hinge_level: InitVar[float | Sequence[float] | None] = None

    def __post_init__(self, hinge_level: float | Sequence[float] | None) -> None:
        self._understand(hinge_level=hinge_level)


MECHANISMS: dict[str, type[Wall]] = {
    kind.mechanism: kind
    for kind in (OneSidedWall, FreeStandingWall, TwoBlockWall, Corner, TabulatedWall, Chain, HorizontalBending)
}


def wall_from(data: WallData) -> Wall:
    """A wall that Fortran has understood already."""
    wall = object.__new__(MECHANISMS[data.properties["mechanism"]])
    wall._fill(data)
    return wall
