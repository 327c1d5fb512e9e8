"""Walls: what is said of them, and the mechanism that follows."""

from __future__ import annotations

import copy
import dataclasses
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import KW_ONLY, InitVar, dataclass
from typing import TYPE_CHECKING, Any, ClassVar, Literal, NamedTuple

from numpy.typing import ArrayLike

from dondolo._base.arguments import FloatArray, as_number, instance_of, one_of
from dondolo._base.shown import html_of
from dondolo._fortran import _core
from dondolo._fortran.buildings import BUILDING_NAMES
from dondolo._fortran.handles import Handle
from dondolo._fortran.library import check
from dondolo._fortran.walls import (
    WALL_EXTRAS,
    WALL_LISTS,
    WALL_PROPERTIES,
    FlatWall,
    WallData,
    describe_wall,
    flat_wall,
    join_walls,
    wall_terms,
)
from dondolo._storage import tables
from dondolo._storage.saved import part_of_results
from dondolo.errors import InputError
from dondolo.records.building import Building, building_from

if TYPE_CHECKING:
    from matplotlib.axes import Axes

# What the package exports of the walls: a new mechanism is added here alone
__all__ = ["FreeStandingWall", "OneSidedWall", "Terms", "TwoBlockWall", "Wall"]

# What is left out gets its value from Fortran; from then on it is there.
_DEFAULT: Any = None

# One value or several
Values = float | Sequence[float] | None

_GREEK = (("R", "radius", "m"), ("alpha", "slenderness_angle", "rad"), ("p", "frequency_parameter", "rad/s"))


class Terms(NamedTuple):
    """Terms of the equation of motion J q'' + C q'^2 + G = -s L u_g'' + Q at some rotations, per metre of wall.

    Attributes
    ----------
    inertia : ndarray
        J [kg m2].
    inertia_rate : ndarray
        C = 1/2 dJ/dq [kg m2].
    restoring_moment : ndarray
        G, of gravity [N m].
    excitation_lever : ndarray
        L [kg m].
    load_force : ndarray
        Q, the generalised force of carried loads [N m]; 0 without an overburden.
    """

    inertia: FloatArray
    inertia_rate: FloatArray
    restoring_moment: FloatArray
    excitation_lever: FloatArray
    load_force: FloatArray


@dataclass(frozen=True, repr=False)
class Wall:
    """What all walls share. Use `OneSidedWall`, `FreeStandingWall` or `TwoBlockWall`.

    Every number that is left out (None) gets its default from the Fortran library, and stands in the wall afterwards.
    """

    mechanism: ClassVar[str] = ""

    height: float = _DEFAULT
    thickness: float = _DEFAULT
    _: KW_ONLY
    density: float = _DEFAULT
    restitution: Literal["default", "sorrentino", "impulse", "constant"] = _DEFAULT
    restitution_value: float | None = None
    restitution_factor: float | None = None
    gravity: float = _DEFAULT
    name: str = _DEFAULT
    building: Building | None = None

    def __post_init__(self) -> None:
        self._understand()

    def _understand(self, **more: Any) -> None:
        """Let Fortran check what is said of the wall, and what is given besides its fields."""
        if not self.mechanism:
            raise TypeError("Wall has no mechanism: use OneSidedWall, FreeStandingWall or TwoBlockWall")
        if self.building is not None:
            instance_of("building", self.building, Building, "no building")
        properties = self._properties() | more
        for row in WALL_PROPERTIES:
            word = properties[row.name]
            # The library reads words in any case, as its files may have them; those of a program are exact.
            if row.choices and isinstance(word, str) and word != word.lower():
                one_of(row.name, word, row.choices)
        self._fill(describe_wall(properties, self.gravity))

    def _properties(self) -> dict[str, Any]:
        """Its properties by their names, None where one does not apply."""
        return {row.name: property_of(self, row.name) for row in WALL_PROPERTIES}

    def _fill(self, data: WallData) -> None:
        """Take over what Fortran has understood."""
        own = {field.name for field in dataclasses.fields(self)}
        filled: dict[str, Any] = {what: value for what, value in data.properties.items() if what in own}
        filled |= {"gravity": data.gravity, "_statics": data.statics, "_two_sided": data.two_sided}
        if "building" not in self.__dict__:
            filled["building"] = building_from(data.properties)
        for what, value in filled.items():
            object.__setattr__(self, what, value)

    def _renamed(self, name: str) -> Wall:
        """The same wall with another name, which stands on one line."""
        other = copy.copy(self)
        object.__setattr__(other, "name", name)
        return other

    def __getstate__(self) -> dict[str, Any]:
        # What was uploaded stays in its process, and a copy may get another name.
        return {what: value for what, value in self.__dict__.items() if what != "_handle"}

    def __setstate__(self, state: dict[str, Any]) -> None:
        self.__dict__.update(state)

    @property
    def _flat(self) -> FlatWall:
        """The wall as Fortran takes it; made when it is needed, for it takes more memory than the wall."""
        return flat_wall(self._properties(), self.gravity)

    def _static(self, place: int) -> float:
        """One of the static quantities, in the order of Fortran."""
        return float(self.__dict__["_statics"][place])

    @property
    def radius(self) -> float:
        """Half diagonal R [m], of the lower block of a two-block wall."""
        return self._static(0)

    @property
    def slenderness_angle(self) -> float:
        """Slenderness angle alpha [rad], of the lower block of a two-block wall."""
        return self._static(1)

    @property
    def frequency_parameter(self) -> float:
        """Frequency parameter p [rad/s]; p^2 = 3 g/(4 R) for one block."""
        return self._static(2)

    @property
    def trigger_acceleration(self) -> float:
        """Ground acceleration at which the wall begins to rock [m/s2]."""
        return self._static(3)

    @property
    def capacity_angle(self) -> float:
        """Rotation at which the restoring moment vanishes [rad]."""
        return self._static(4)

    @property
    def restitution_coefficient(self) -> float:
        """Speed after an impact / speed before it, 0 <= e < 1."""
        return self._static(5)

    @property
    def base_hinge_depth(self) -> float:
        """Depth of the hinge at the base behind the face [m]: given, of crushed masonry, or of a round edge; else 0."""
        return self._static(6)

    @property
    def two_sided(self) -> bool:
        """Does it rock to both sides?"""
        return bool(self.__dict__["_two_sided"])

    def terms(self, rotation: ArrayLike) -> Terms:
        """Terms of the equation of motion at given rotations.

        Parameters
        ----------
        rotation : array_like
            Rotations q [rad], at least 0 and less than the geometric end; of the lower block for a two-block wall.

        Returns
        -------
        Terms
            J, C, G, L and Q, each in the shape of `rotation`.

        Raises
        ------
        InputError
            A rotation that the wall cannot have.

        Notes
        -----
        Equations (1) and (3) of Nale et al. in the common form; docs/theory.md, section 2. One block can rotate until
        its centroid is level with its corner (alpha + pi/2), a two-block wall until its upper block lies flat.

        Examples
        --------
        >>> import dondolo as dd
        >>> wall = dd.TwoBlockWall(height=3.0, thickness=0.25, hinge=0.6)
        >>> terms = wall.terms([0.0, 0.05])
        >>> terms.excitation_lever.round(3).tolist()
        [1215.0, 1221.916]
        """
        return Terms(*wall_terms(upload((self,)), rotation)[:5])

    def potential(self, rotation: ArrayLike) -> FloatArray:
        """Potential energy of gravity and of carried loads at given rotations.

        Parameters
        ----------
        rotation : array_like
            Rotations q [rad], as for `terms`.

        Returns
        -------
        ndarray, shape of rotation
            V [J per metre of wall], measured from the base, with V' = G - Q.

        Raises
        ------
        InputError
            A rotation that the wall cannot have.

        Notes
        -----
        1/2 J q'^2 + V is constant in still ground; docs/theory.md, section 2.
        """
        energy: FloatArray = wall_terms(upload((self,)), rotation)[5]
        return energy

    def plot(self, ax: Axes | None = None, *, rotation: float | None = None) -> Axes:
        """Draw the wall at rest (dashed) and rotated, with the hinges it rotates about.

        Parameters
        ----------
        ax : Axes, optional
            Where to draw; a new figure if left out.
        rotation : float, optional
            Signed rotation, of the lower block for two-block walls [rad]; half the capacity if left out.

        Returns
        -------
        Axes
            Metres, to scale.

        Raises
        ------
        InputError
            A rotation that the wall cannot have.
        """
        from dondolo.walls.drawing import draw_wall

        angle = 0.5 * self.capacity_angle if rotation is None else as_number("rotation", rotation)
        if not self.two_sided and angle < 0.0:
            raise InputError(f"rotation = {angle:g}: a one-sided wall rotates outwards only, it must not be negative")
        # Asked for what it weighs there, a wall refuses rotations that it cannot have.
        self.terms(abs(angle))
        return draw_wall(self, angle, ax)

    def _facts(self) -> list[tuple[str, str]]:
        """What a reader wants to know, name and text."""
        own = [
            (field.name, getattr(self, field.name))
            for field in dataclasses.fields(self)
            if field.name != "name" and getattr(self, field.name) is not None
        ]
        facts = [(what, _in_words(value)) for what, value in own]
        facts += [(letter, f"{getattr(self, what):.6g} {unit}") for letter, what, unit in _GREEK]
        trigger = f"{self.trigger_acceleration:.6g} m/s2 ({self.trigger_acceleration / self.gravity:.4g} g)"
        return [*facts, ("trigger", trigger), ("speed ratio", f"{self.restitution_coefficient:.6g}")]

    def __repr__(self) -> str:
        facts = ", ".join(f"{what}={text}" for what, text in self._facts())
        return f"<{type(self).__name__} {self.name!r}: {facts}>"

    def _repr_html_(self) -> str:
        return html_of(f"{type(self).__name__} '{self.name}'", self._facts())

    def to_frame(self) -> Any:
        """The wall and its static quantities as a pandas DataFrame of one row."""
        return tables.frame(walls_table([self]))


def _in_words(value: Any) -> str:
    """A property as text."""
    if isinstance(value, tuple):
        return " ".join(map(_in_words, value))
    return f"{value:.6g}" if isinstance(value, float) else str(value)


@dataclass(frozen=True, repr=False, kw_only=True)
class BlockWall(Wall):
    """What walls of one block share: storeys, the hinge, and what they carry."""

    section_height: Values = None
    section_thickness: Values = None
    section_fill: Values = None
    section_offset: Values = None
    section_base_width: Values = None
    section_top_width: Values = None
    mass: float | None = None
    centroid_depth: float | None = None
    centroid_height: float | None = None
    hinge_inertia: float | None = None
    hinge_depth: float | None = None
    compressive_strength: float | None = None
    stress_block: float | None = None
    edge_radius: float | None = None
    load: Values = None
    load_depth: Values = None
    load_height: Values = None
    load_inertia: str | Sequence[str] | None = None
    load_lifted: Values = None
    load_pushed: Values = None
    load_seat: Values = None
    inertia_mass: Values = None
    inertia_depth: Values = None
    inertia_height: Values = None
    thrust: Values = None
    thrust_depth: Values = None
    thrust_height: Values = None
    thrust_decay: Values = None
    spring: Values = None
    spring_depth: Values = None
    spring_height: Values = None
    bed: Values = None
    bed_depth: Values = None
    bed_bottom: Values = None
    bed_top: Values = None


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
    section_height : float or sequence of float, optional
        Heights of the storeys from the bottom, instead of height [m].
    section_thickness : float or sequence of float, optional
        Their thicknesses, instead of thickness [m].
    section_fill : float or sequence of float, optional
        Part of each storey that is masonry, 1 if not given.
    section_offset : float or sequence of float, optional
        Depth of the outer face of each storey behind that of the lowest, 0 if not given [m].
    section_base_width : float or sequence of float, optional
        Width of each elevation at its bottom / width that values per metre refer to, 1 if not given.
    section_top_width : float or sequence of float, optional
        The same at its top, as at its bottom if not given; 0 for a gable.
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
    load : float or sequence of float, optional
        Vertical loads that go with the wall, per metre of wall [N/m].
    load_depth : float or sequence of float, optional
        Depth of each load behind the outer face [m].
    load_height : float or sequence of float, optional
        Height of each load above the base [m].
    load_inertia : {'none', 'vertical', 'both'} or sequence of them, optional
        Which mass of each load the wall moves: 'none' is a dead force, 'vertical' a mass that other walls hold
        sideways, 'both' one that the wall pushes too (docs/loads.md); one for all loads or one for each.
    load_lifted : float or sequence of float, optional
        Part of each load whose mass the wall lifts, with load_pushed instead of load_inertia.
    load_pushed : float or sequence of float, optional
        Part of each load whose mass the wall pushes.
    load_seat : float or sequence of float, optional
        Horizontal travel at which each load loses its seat [m].
    inertia_mass : float or sequence of float, optional
        Masses that the wall pushes and does not carry, per metre of wall [kg/m].
    inertia_depth : float or sequence of float, optional
        Depth of each of them behind the outer face [m].
    inertia_height : float or sequence of float, optional
        Height of each of them above the base [m].
    thrust : float or sequence of float, optional
        Horizontal forces outwards, per metre of wall [N/m].
    thrust_depth : float or sequence of float, optional
        Depth of each thrust behind the outer face, the inner face if not given [m].
    thrust_height : float or sequence of float, optional
        Height of each thrust above the base [m].
    thrust_decay : float or sequence of float, optional
        Travel over which each thrust falls to 1/e, constant if not given [m].
    spring : float or sequence of float, optional
        Stiffness of springs that pull and push, per metre of wall [N/m2].
    spring_depth : float or sequence of float, optional
        Depth of each spring behind the outer face [m].
    spring_height : float or sequence of float, optional
        Height of each spring above the base [m].
    bed : float or sequence of float, optional
        Stiffness of springs spread over a height, per metre of wall and of height [N/m3].
    bed_depth : float or sequence of float, optional
        Depth of each bed behind the outer face [m].
    bed_bottom : float or sequence of float, optional
        Height at which each bed begins [m].
    bed_top : float or sequence of float, optional
        Height at which each bed ends [m].

    Raises
    ------
    InputError
        A value that makes no sense, with the sentence of the executable.

    Notes
    -----
    Equation (1) of Nale et al.; docs/theory.md, section 2. Depths are measured from the outer face of the base, towards
    which the wall falls, heights from the base. What belongs to several loads is a value for each, or one for all;
    which inertia to choose is the subject of docs/loads.md.

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
    ...     load=10e3,
    ...     load_depth=0.175,
    ...     load_height=3.0,
    ...     load_inertia="both",
    ...     thrust=200.0,
    ...     thrust_height=3.0,
    ... )
    >>> round(facade.trigger_acceleration / facade.gravity, 4)
    0.0563
    """

    mechanism: ClassVar[str] = "one_sided"


@part_of_results
@dataclass(frozen=True, repr=False)
class FreeStandingWall(BlockWall):
    """A wall that stands free and rocks to both sides (the block of Housner 1963).

    Parameters are those of `OneSidedWall`; the models of restitution are 'default', 'impulse' (both
    1 - 3/2 sin^2 alpha for a bare block) and 'constant'. Since it rocks to both sides, what it carries bears at half
    its thickness, and nothing thrusts.
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

    hinge: float = _DEFAULT
    overburden: float = _DEFAULT
    overburden_inertia: float | None = None
    eccentricity: float = _DEFAULT
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


def upload(walls: tuple[Wall, ...]) -> Handle:
    """The walls in Fortran; one alone is uploaded once."""
    alone = walls[0].__dict__ if len(walls) == 1 else {}
    if "_handle" in alone:
        return alone["_handle"]  # type: ignore[no-any-return]
    number, stat, message = _core.walls.new_walls(*join_walls([wall._flat for wall in walls]))
    check(stat, message)
    alone["_handle"] = handle = Handle(number)
    return handle


def property_of(wall: Wall, name: str) -> Any:
    """A property of a wall, or of the building that it stands on; None where it has none."""
    return getattr(wall.building if name in BUILDING_NAMES else wall, name, None)


def property_columns(walls: Sequence[Wall], heads: Mapping[str, str]) -> tables.Table:
    """Columns of properties under their heads; a list has as many, numbered, as a wall has values."""
    table: tables.Table = {}
    for what, head in heads.items():
        values = [property_of(wall, what) for wall in walls]
        if what in WALL_EXTRAS and all(value is None for value in values):
            continue
        if what not in WALL_LISTS:
            table[head] = values
            continue
        lists = [value or () for value in values]
        for i in range(max(map(len, lists))):
            table[numbered(head, i + 1)] = [value[i] if i < len(value) else None for value in lists]
    return table


def numbered(name: str, number: int) -> str:
    """Name of one value of a list: the number stands behind its first word."""
    stem, *rest = name.split("_", 1)
    return "_".join([f"{stem}{number}", *rest])


def walls_table(
    walls: Sequence[Wall],
    weights: Iterable[float] = (1.0,),
    groups: Iterable[str] = ("",),
    p_occ: Iterable[float] = (1.0,),
) -> tables.Table:
    """Columns of ``_walls.csv``."""

    def column(what: str) -> list[Any]:
        return [getattr(wall, what, None) for wall in walls]

    return {
        **property_columns(walls, {row.name: row.column for row in WALL_PROPERTIES if row.column}),
        "alpha_rad": column("slenderness_angle"),
        "p_rad_s": column("frequency_parameter"),
        "trigger_acceleration_m_s2": column("trigger_acceleration"),
        "capacity_rad": column("capacity_angle"),
        "restitution": column("restitution_coefficient"),
        "weight": list(weights),
        "group": list(groups),
        "p_occ": list(p_occ),
    }
