"""Fields that all walls share, checked by Fortran, and the quantities that follow from them."""

from __future__ import annotations

import copy
import dataclasses
import functools
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import KW_ONLY, dataclass
from typing import TYPE_CHECKING, Any, ClassVar, Literal, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from dondolo._base.arguments import FloatArray, argument_error, as_number, instance_of, one_of
from dondolo._base.shown import html_of
from dondolo._base.wording import in_english, named, say
from dondolo._fortran import _core
from dondolo._fortran.buildings import BUILDING_NAMES, Motion, felt_motion, support_notes
from dondolo._fortran.handles import Handle
from dondolo._fortran.library import check, with_units
from dondolo._fortran.tables import TableColumns, plain, wall_columns
from dondolo._fortran.walls import (
    INDEPENDENT,
    WALL_ABSENT,
    WALL_PROPERTIES,
    FlatWall,
    WallData,
    describe_wall,
    flat_wall,
    join_walls,
    wall_terms,
)
from dondolo._storage import tables
from dondolo.errors import DondoloWarning, InputError
from dondolo.records.building import Building, building_from
from dondolo.walls.parts import KINDS, PLACES, in_whole, named_by_parts, parts_from, parts_of, properties_of_parts

if TYPE_CHECKING:
    from matplotlib.axes import Axes

# What is left out gets its value from Fortran; from then on it is there.
DEFAULT: Any = None

# What walls without parts share
_NO_LISTS: dict[str, Any] = {}

# Walls as notes of the library name them
_GREEK = (("R", "radius", "m"), ("alpha", "slenderness_angle", "rad"), ("p", "frequency_parameter", "rad/s"))


class Terms(NamedTuple):
    """Terms of the equation of motion J q'' + C q'^2 + G = -s L u_g'' + Q at some rotations, per metre of wall; of a
    corner or a chain, whole.

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
        Q, the generalised force of carried loads [N m]; 0 without any, ties that have not yielded included.
    """

    inertia: FloatArray
    inertia_rate: FloatArray
    restoring_moment: FloatArray
    excitation_lever: FloatArray
    load_force: FloatArray


@dataclass(frozen=True, repr=False)
class Wall:
    """Base class of all walls. Use `OneSidedWall`, `FreeStandingWall`, `TwoBlockWall`, `Corner`, `HorizontalBending`,
    `TabulatedWall` or `Chain`.

    Every number that is left out (None) gets its default from the Fortran library and is then an attribute of the wall.

    Examples
    --------
    >>> import dondolo as dd
    >>> parapet, strip = dd.OneSidedWall(1.5, 0.25), dd.TwoBlockWall(3.0, 0.25)
    >>> all(isinstance(wall, dd.Wall) for wall in (parapet, strip))
    True
    >>> round(parapet.trigger_acceleration / parapet.gravity, 4)  # in g
    0.1667
    """

    mechanism: ClassVar[str] = ""

    height: float = DEFAULT
    _: KW_ONLY
    base_level: float | None = None
    restitution: Literal["default", "sorrentino", "impulse"] = DEFAULT
    restitution_value: float | None = None
    restitution_factor: float | None = None
    restitution_sd: float | None = None
    restitution_seed: float | None = None
    gravity: float = DEFAULT
    name: str = DEFAULT
    building: Building | None = None

    def __post_init__(self) -> None:
        self._understand()

    def _sources(self) -> tuple[str, ...]:
        """What it uses of the methods of others, in the words of dondolo_files_references."""
        building = () if self.building is None else ("building",)
        return self.mechanism, f"{self.mechanism}/{self.restitution}", *building

    def _understand(self, **more: Any) -> None:
        """Let Fortran check what is said of the wall, and what is given besides its fields."""
        if not self.mechanism:
            raise TypeError(
                "Wall has no mechanism: use OneSidedWall, FreeStandingWall, TwoBlockWall, Corner, HorizontalBending,"
                " TabulatedWall or Chain"
            )
        if self.building is not None:
            instance_of("building", self.building, Building)
        lists = properties_of_parts(self)
        object.__setattr__(self, "_lists", lists)
        properties = self._properties() | more
        for row in WALL_PROPERTIES:
            word = properties[row.name]
            # The library reads words in any case, as its files may have them; those of a program are exact.
            if row.choices and isinstance(word, str) and word != word.lower():
                one_of(row.name, word, row.choices)
        data = described(properties, self.gravity)
        if more.get("hinge_level") is not None:
            # The wall above a hinge is on a floor of its own.
            del self.__dict__["building"]
        self._fill(data)

    def _properties(self) -> dict[str, Any]:
        """Its properties by their names, None where one does not apply."""
        return {row.name: property_of(self, row.name) for row in WALL_PROPERTIES}

    @classmethod
    @functools.cache
    def _fields(cls) -> frozenset[str]:
        """Names of its fields."""
        return frozenset(field.name for field in dataclasses.fields(cls))

    def _fill(self, data: WallData) -> None:
        """Take over what Fortran has understood."""
        own = self._fields()
        filled: dict[str, Any] = {what: value for what, value in data.properties.items() if what in own}
        filled |= {"gravity": data.gravity, "_statics": data.statics, "_two_sided": data.two_sided}
        lists = {what: value for what, value in data.properties.items() if what in PLACES and value is not None}
        filled |= {of: parts for of, parts in parts_from(lists).items() if of in own}
        filled["_lists"] = lists or _NO_LISTS
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
    def greatest_acceleration(self) -> float:
        """Greatest static acceleration that a wall with ties resists [m/s2]; without ties the trigger."""
        return self._static(7)

    @property
    def plastic_acceleration(self) -> float:
        """Acceleration that moves a wall whose ties all yield, alpha_0 g of design [m/s2]; without ties the trigger."""
        return self._static(8)

    @property
    def support_share(self) -> float:
        """Share k of the acceleration of its top relative to its base that moves the wall; 0 without a top support."""
        return self._static(9)

    @property
    def support_tilt(self) -> float:
        """Tilt tau, the factor on the relative displacement of top and base [1/s2]; 0 without a top support."""
        return self._static(10)

    @property
    def opening_edp(self) -> float:
        """Rotation / capacity at which joints that bend open, q_y/q_c; 0 for rigid blocks."""
        return self._static(12)

    @property
    def opening_acceleration(self) -> float:
        """Spectral acceleration at `elastic_period` that opens joints that bend [m/s2]; 0 for rigid blocks."""
        return self._static(13)

    @property
    def elastic_restitution(self) -> float:
        """Speed ratio e_0 of a passage of the rest position of joints that bend; 0 for rigid blocks."""
        return self._static(14)

    def _felt(self, acceleration: FloatArray, vertical: FloatArray | None, dt: float, what: str) -> Motion | None:
        """The motion that the wall feels, or that of its base or its top; None without a building."""
        return None if self.building is None else felt_motion(acceleration, vertical, dt, upload((self,)), what)

    @property
    def two_sided(self) -> bool:
        """Whether the wall rocks to both sides."""
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

        Examples
        --------
        >>> import dondolo as dd
        >>> wall = dd.OneSidedWall(1.5, 0.25)
        >>> bool(wall.potential(0.5 * wall.capacity_angle) < wall.potential(wall.capacity_angle))
        True
        """
        energy: FloatArray = wall_terms(upload((self,)), rotation)[5]
        return energy

    def plot(self, ax: Axes | None = None, *, rotation: float | None = None, **options: Any) -> Axes:
        """Draw the wall at rest (dashed) and rotated, with the hinges it rotates about.

        Parameters
        ----------
        ax : Axes, optional
            Where to draw; a new figure if left out.
        rotation : float, optional
            Signed rotation, of the lower block for two-block walls [rad]; half the capacity if left out.
        **options
            Parts to leave out by False (`legend`, `title`), and keywords of Matplotlib for the blocks: see
            docs/printing.md.

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
            raise argument_error(
                "out_of_range",
                "rotation",
                f" = {angle:g}: a one-sided wall rotates outwards only, it must not be negative",
            )
        # Asked for what it weighs there, a wall refuses rotations that it cannot have.
        self.terms(abs(angle))
        return draw_wall(self, angle, ax, options)

    def _facts(self) -> list[tuple[str, str]]:
        """What a reader wants to know, name and text."""
        own = {field.name: getattr(self, field.name) for field in dataclasses.fields(self) if field.name != "name"}
        if self.restitution_value is not None:
            # The number takes the place of a model.
            del own["restitution"]
        facts = [(what, _in_words(value)) for what, value in own.items() if value is not None and what not in KINDS]
        facts += [(letter, f"{getattr(self, what):.6g} {unit}") for letter, what, unit in _GREEK]
        trigger = f"{self.trigger_acceleration:.6g} m/s2 ({self.trigger_acceleration / self.gravity:.4g} g)"
        return [*facts, ("trigger", trigger), ("restitution e", f"{self.restitution_coefficient:.6g}")]

    def _parts(self) -> dict[str, list[Any]]:
        """Its parts as it is computed with, by the names that it has for them."""
        return {of: [(part, in_whole(part)) for part in parts] for of in KINDS if (parts := parts_of(self, of))}

    def __repr__(self) -> str:
        facts = [f"{what}={text}" for what, text in self._facts()]
        for of, parts in self._parts().items():
            words = (
                f"{type(part).__name__}({', '.join(f'{what}={text}' for what, _, text in own)})" for part, own in parts
            )
            facts.append(f"{of}=[{', '.join(words)}]")
        return f"<{type(self).__name__} {self.name!r}: {', '.join(facts)}>"

    def _repr_html_(self) -> str:
        facts = with_units("wall", self._facts())
        for of, parts in self._parts().items():
            for number, (_, own) in enumerate(parts, 1):
                values = (f"{what} {with_units('wall', [(name, text)])[0][1]}" for what, name, text in own)
                facts.append((f"{of} {number}", ", ".join(values)))
        return html_of(f"{type(self).__name__} '{self.name}'", facts)

    def to_frame(self) -> Any:
        """The wall and its static quantities as a pandas DataFrame of one row."""
        return tables.frame(plain(walls_table((self,))))


@dataclass(frozen=True, repr=False)
class MasonryWall(Wall):
    """Base class of walls of one or two blocks, which have a section of masonry."""

    thickness: float = DEFAULT
    _: KW_ONLY
    density: float = DEFAULT


def _in_words(value: Any) -> str:
    """A property as text."""
    return f"{value:.6g}" if isinstance(value, float) else str(value)


def described(properties: Mapping[str, Any], gravity: float | None) -> WallData:
    """Let Fortran check a wall; what is wrong of a list is said of the part that the value belongs to."""
    try:
        return describe_wall(properties, gravity)
    except InputError as error:
        raise named_by_parts(error, properties) from None


def upload(walls: Sequence[Wall]) -> Handle:
    """The walls in Fortran; one alone is uploaded once."""
    alone = walls[0].__dict__ if len(walls) == 1 else {}
    if "_handle" in alone:
        return alone["_handle"]  # type: ignore[no-any-return]
    flat = walls.flat if isinstance(walls, ColumnsOfWalls) else join_walls([wall._flat for wall in walls])
    number, failure = _core.walls.new_walls(*flat)
    check(failure)
    # Another thread may have uploaded it in the meantime, and uses its handle.
    handle: Handle = alone.setdefault("_handle", Handle(number))
    return handle


def walls_table(
    walls: Sequence[Wall],
    words: Iterable[Sequence[str]] | None = None,
    weights: FloatArray | None = None,
    p_occ: FloatArray | None = None,
    notes: Sequence[str] = (),
) -> TableColumns:
    """Columns of ``_walls.csv``; words are group, facade, occurrence, alternative and notes of each wall.

    By themselves walls have a weight of 1, no group, and independent mechanisms.
    """
    ones = np.ones(len(walls))
    shares = (ones if weights is None else weights, ones if p_occ is None else p_occ)
    return wall_columns(upload(walls), words or [("", "", INDEPENDENT, "")] * len(walls), notes, *shares)


def notes_on_supports(walls: Sequence[Wall]) -> list[tuple[str, str]]:
    """Notes on the motion of the bases and supports of walls, as facts, as the executable prints them."""
    return [(say("note"), _said(note)) for note in support_notes(upload(walls))]


def _said(note: DondoloWarning) -> str:
    """A note of the library in the language in force, by its code; walls that it counts are set in their place."""
    if in_english():
        return str(note)
    count, of = (int(note.numbers.get(name, 1)) for name in ("walls", "of_walls"))
    one = say("of the wall") if of == 1 else say("of 1 wall")
    walls = one if count == 1 else say("of {number} walls", number=count)
    return named("note on supports", note.code, str(note)).format(walls=walls)


def property_of(wall: Wall, name: str) -> Any:
    """A property of a wall, of its parts as a list, or of the building that it stands on; None where it has none."""
    if name in PLACES:
        return wall.__dict__["_lists"].get(name)
    if name in KINDS:
        # A file of a chain, where other walls have parts of this name
        return None
    return getattr(wall.building if name in BUILDING_NAMES else wall, name, None)


class ColumnsOfWalls(Sequence["Wall"]):
    """Walls that are kept as columns: `WallColumns` makes them."""

    flat: FlatWall

    def column(self, name: str) -> list[Any]:
        """A property of all walls, as `property_of` has it."""
        raise NotImplementedError


def properties_of(walls: Sequence[Wall], name: str) -> list[Any]:
    """A property of several walls, as `property_of` has it."""
    return walls.column(name) if isinstance(walls, ColumnsOfWalls) else [property_of(wall, name) for wall in walls]


def effective_property(wall: Wall, name: str) -> Any:
    """A property of a wall as it is computed with: that of a tie, say, which is not given, is the usual one."""
    value = property_of(wall, name)
    if value is None and name in PLACES and getattr(wall, PLACES[name][0], None):
        return WALL_ABSENT.get(name)
    return value
