"""Parts of walls: storeys, and what a wall carries, what pushes it and what holds it.

Their numbers are properties of walls in the library's table, where a list goes through all parts of a kind: the second
value of `tie_height` is `ties[1].height`. Names, units, ranges and meanings come from that table.
"""

from __future__ import annotations

import dataclasses
import functools
import inspect
import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import KW_ONLY, dataclass
from typing import Any, ClassVar, Literal, TypeVar

import numpy as np

from dondolo._base.arguments import as_number, one_of
from dondolo._fortran.walls import WALL_ABSENT, WALL_LISTS, WALL_PROPERTIES
from dondolo._storage.saved import part_of_results
from dondolo.errors import InputError

_ROWS = {row.name: row for row in WALL_PROPERTIES}
# How the table says what is computed with where a number is not given
_LEFT_OUT = re.compile(r" if not given$")
# Numbers of ties of which 0 says that there is none
_NONE = frozenset(row.name for row in WALL_PROPERTIES if row.name.startswith("tie_") and row.absent == 0.0) - {
    "tie_depth",
    "tie_preload",
}


@dataclass(frozen=True, repr=False)
class Part:
    """What parts share: their properties, the names of which in tables begin with the word of their kind."""

    word: ClassVar[str]

    def __post_init__(self) -> None:
        for name, row in self._rows().items():
            value = getattr(self, name)
            if value is None:
                continue
            if row.choices:
                one_of(name, value, row.choices)
            else:
                object.__setattr__(self, name, as_number(name, value))

    @classmethod
    @functools.cache
    def _rows(cls) -> dict[str, Any]:
        """Rows of the table, by the names of its fields; the number that a kind is named after has no second word."""
        names = [field.name for field in dataclasses.fields(cls)]
        return {name: _ROWS.get(f"{cls.word}_{name}", _ROWS.get(cls.word)) for name in names}

    def __repr__(self) -> str:
        given = {name: getattr(self, name) for name in self._rows()}
        words = ", ".join(f"{name}={value!r}" for name, value in given.items() if value is not None)
        return f"{type(self).__name__}({words})"


Kind = TypeVar("Kind", bound=type[Part])


def _described(kind: Kind) -> Kind:
    """A kind of parts with what the table says of its numbers in its docstring."""
    if kind.__doc__ is None:
        return kind
    lines = ["Parameters", "----------"]
    for name, row in kind._rows().items():
        (field,) = (field for field in dataclasses.fields(kind) if field.name == name)
        what = "{" + ", ".join(map(repr, row.choices)) + "}" if row.choices else "float"
        meaning = _LEFT_OUT.sub(" if left out", row.meaning[0].upper() + row.meaning[1:])
        lines.append(f"{name} : {what}{'' if field.default is dataclasses.MISSING else ', optional'}")
        lines.append(f"    {meaning}{f' [{row.unit}]' if row.unit else ''}.")
    head, _, rest = inspect.cleandoc(kind.__doc__).partition("\n\n")
    kind.__doc__ = "\n\n".join(filter(None, [head, "\n".join(lines), rest]))
    return kind


@_described
@part_of_results
@dataclass(frozen=True, repr=False)
class Section(Part):
    """A storey of a wall; a wall has them from the bottom, instead of a height and a thickness.

    Examples
    --------
    >>> import dondolo as dd
    >>> wall = dd.OneSidedWall(sections=[dd.Section(4.0, 0.6), dd.Section(3.0, 0.45)])
    >>> wall.height, wall.thickness
    (7.0, 0.6)
    """

    word: ClassVar[str] = "section"

    height: float
    thickness: float
    _: KW_ONLY
    fill: float | None = None
    offset: float | None = None
    base_width: float | None = None
    top_width: float | None = None


@_described
@part_of_results
@dataclass(frozen=True, repr=False)
class Load(Part):
    """A vertical load that goes with a wall. Its inertia decides the result and must be given: docs/mechanisms.md.

    Examples
    --------
    A floor whose mass the wall pushes too:

    >>> import dondolo as dd
    >>> floor = dd.Load(10e3, depth=0.175, height=3.0, inertia="both")
    >>> round(dd.OneSidedWall(3.0, 0.25, loads=[floor]).trigger_acceleration, 4)
    0.67

    A load of 6 kN on a corner, which is no wall whose loads are per metre:

    >>> rafter = dd.Load(total=6e3, depth=0.45, height=3.2, inertia="both")
    >>> corner = dd.Corner(3.2, 0.5, wing_angle=20.0, hinge_depth=0.03, loads=[rafter])
    >>> round(corner.trigger_acceleration / corner.gravity, 3)
    0.291
    """

    word: ClassVar[str] = "load"

    force: float | None = None
    _: KW_ONLY
    depth: float
    height: float
    inertia: Literal["none", "vertical", "both"] | None = None
    lifted: float | None = None
    pushed: float | None = None
    seat: float | None = None
    total: float | None = None
    x: float | None = None


@_described
@part_of_results
@dataclass(frozen=True, repr=False)
class InertialMass(Part):
    """A mass that a wall pushes and does not carry.

    Examples
    --------
    >>> import dondolo as dd
    >>> floor = dd.InertialMass(600.0, depth=0.175, height=3.0)
    >>> round(dd.OneSidedWall(3.0, 0.25, inertial_masses=[floor]).trigger_acceleration, 4)
    0.4328
    """

    word: ClassVar[str] = "inertia"

    mass: float
    _: KW_ONLY
    depth: float
    height: float
    x: float | None = None


@_described
@part_of_results
@dataclass(frozen=True, repr=False)
class Thrust(Part):
    """A horizontal force that pushes a wall outwards, of a vault or of a roof.

    Examples
    --------
    >>> import dondolo as dd
    >>> roof = dd.Thrust(200.0, height=3.0)
    >>> round(dd.OneSidedWall(3.0, 0.25, thrusts=[roof]).trigger_acceleration, 4)
    0.5212
    """

    word: ClassVar[str] = "thrust"

    force: float | None = None
    _: KW_ONLY
    depth: float | None = None
    height: float
    decay: float | None = None
    total: float | None = None
    x: float | None = None


@_described
@part_of_results
@dataclass(frozen=True, repr=False)
class Spring(Part):
    """A spring that pulls and pushes a wall.

    Examples
    --------
    >>> import dondolo as dd
    >>> rod = dd.Spring(500.0, depth=0.0, height=3.0)
    >>> dd.OneSidedWall(3.0, 0.25, springs=[rod]).springs
    (Spring(stiffness=500.0, depth=0.0, height=3.0),)
    """

    word: ClassVar[str] = "spring"

    stiffness: float
    _: KW_ONLY
    depth: float
    height: float


@_described
@part_of_results
@dataclass(frozen=True, repr=False)
class DistributedSpring(Part):
    """Springs spread over a height of a wall.

    Examples
    --------
    >>> import dondolo as dd
    >>> fill = dd.DistributedSpring(200.0, depth=0.25, bottom=0.0, top=3.0)
    >>> dd.OneSidedWall(3.0, 0.25, distributed_springs=[fill]).distributed_springs
    (DistributedSpring(stiffness=200.0, depth=0.25, bottom=0.0, top=3.0),)
    """

    word: ClassVar[str] = "distributed_spring"

    stiffness: float
    _: KW_ONLY
    depth: float
    bottom: float
    top: float


@_described
@part_of_results
@dataclass(frozen=True, repr=False)
class Tie(Part):
    """A tie that holds a wall until it yields and breaks, or its anchor gives way.

    It is given by its `area`, or by the diameter of its `bar` and their `spacing`; its anchor by the force at which it
    gives way, or by its plate, with the strengths of the masonry that the wall has (docs/ties.md). A tie of a corner
    has a `bar` alone, and its anchor an `anchor_total`.

    Examples
    --------
    >>> import dondolo as dd
    >>> rods = [dd.Tie(height, area=5e-5, length=8.0) for height in (8.5, 5.5)]
    >>> wall = dd.OneSidedWall(9.0, 0.5, ties=rods)
    >>> round(wall.greatest_acceleration / wall.trigger_acceleration, 2)
    7.32

    The same with plates, whose masonry gives way before the bars yield:

    >>> plate = {"plate_width": 0.3, "plate_height": 0.3, "plate_thickness": 0.015}
    >>> rods = [dd.Tie(height, bar=0.014, spacing=3.0, length=8.0, **plate) for height in (8.5, 5.5)]
    >>> masonry = {"masonry_compression": 2e6, "masonry_shear": 2e4, "masonry_tension": 3e4}
    >>> wall = dd.OneSidedWall(9.0, 0.5, ties=rods, **masonry)
    >>> round(wall.greatest_acceleration / wall.trigger_acceleration, 2)
    3.39
    """

    word: ClassVar[str] = "tie"

    height: float
    _: KW_ONLY
    depth: float | None = None
    area: float | None = None
    bar: float | None = None
    spacing: float | None = None
    length: float
    modulus: float | None = None
    strength: float | None = None
    preload: float | None = None
    strain: float | None = None
    anchor_force: float | None = None
    anchor_total: float | None = None
    plate_width: float | None = None
    plate_height: float | None = None
    plate_diameter: float | None = None
    plate_thickness: float | None = None
    leaf: float | None = None
    compression: float | None = None

    @property
    def section(self) -> float:
        """Section per metre of wall [m2/m], whether given by its area or by its bars; of a corner the whole [m2]."""
        if self.bar:
            return float(0.25 * np.pi * self.bar**2 / (self.spacing or 1.0))
        return self.area or 0.0


@_described
@part_of_results
@dataclass(frozen=True, repr=False, kw_only=True)
class Interlock(Part):
    """Stones of a wall that overlap those of transverse walls, whose friction holds it.

    Examples
    --------
    >>> import dondolo as dd
    >>> stones = dd.Interlock(overlap=0.12, course=0.1, thickness=0.25, spacing=5.0)
    >>> dd.OneSidedWall(3.0, 0.25, interlock=stones).interlock.friction is None
    True
    """

    word: ClassVar[str] = "interlock"

    overlap: float
    course: float
    thickness: float
    spacing: float
    friction: float | None = None


@_described
@part_of_results
@dataclass(frozen=True, repr=False, kw_only=True)
class Wedge(Part):
    """A wedge of a transverse wall that turns with a facade: compound overturning (docs/mechanisms.md).

    Examples
    --------
    Two transverse walls of 45 cm behind a facade 6 m long:

    >>> import dondolo as dd
    >>> wedge = dd.Wedge(thickness=0.45, angle=20.0, bottom=0.0, top=7.0, length=4.0)
    >>> facade = dd.OneSidedWall(7.0, 0.55, facade_length=6.0, wedges=[wedge, wedge])
    >>> bare = dd.OneSidedWall(7.0, 0.55)
    >>> [round(wall.trigger_acceleration / wall.gravity, 3) for wall in (bare, facade)]
    [0.079, 0.149]
    """

    word: ClassVar[str] = "wedge"

    thickness: float
    angle: float
    bottom: float
    top: float
    length: float


@_described
@part_of_results
@dataclass(frozen=True, repr=False, kw_only=True)
class Opening(Part):
    """A door or a window in the elevation of a facade (docs/mechanisms.md).

    Examples
    --------
    A facade 6 m long and 7 m high with a door:

    >>> import dondolo as dd
    >>> door = dd.Opening(x=2.5, z=0.0, width=1.0, height=2.2)
    >>> corners = {"elevation_x": [0.0, 6.0, 6.0, 0.0], "elevation_z": [0.0, 0.0, 7.0, 7.0]}
    >>> facade = dd.OneSidedWall(thickness=0.5, facade_length=6.0, openings=[door], **corners)
    >>> facade.height
    7.0
    """

    word: ClassVar[str] = "opening"

    x: float
    z: float
    width: float
    height: float


# The kinds, by the names that walls have for them
KINDS: dict[str, type[Part]] = {
    "sections": Section,
    "wedges": Wedge,
    "openings": Opening,
    "loads": Load,
    "inertial_masses": InertialMass,
    "thrusts": Thrust,
    "springs": Spring,
    "distributed_springs": DistributedSpring,
    "ties": Tie,
    "interlock": Interlock,
}
# Those of which a wall has several
_LISTS = frozenset(of for of, kind in KINDS.items() if next(iter(kind._rows().values())).name in WALL_LISTS)
# Field and name in it of the properties that are properties of parts
PLACES = {row.name: (of, name) for of, kind in KINDS.items() for name, row in kind._rows().items()}


def parts_of(wall: Any, of: str) -> tuple[Any, ...]:
    """The parts of a kind that a wall has, checked; what it has one of as one."""
    given, kind = getattr(wall, of, None), KINDS[of]
    if given is None:
        return ()
    if of not in _LISTS:
        given = (given,)
    if isinstance(given, Part) or not isinstance(given, Iterable):
        raise InputError(f"{of} = {given!r}: must be a list of dondolo.{kind.__name__}")
    parts = tuple(given)
    for place, part in enumerate(parts):
        if not isinstance(part, kind):
            raise InputError(f"{_where(of, place)} = {part!r}: must be a dondolo.{kind.__name__}")
    return parts


def properties_of_parts(wall: Any) -> dict[str, Any]:
    """The properties of a wall that its parts have, as its lists: a value for each of them."""
    properties = {}
    for of, kind in KINDS.items():
        parts = parts_of(wall, of)
        for name, row in kind._rows().items():
            values = [getattr(part, name) for part in parts]
            if any(value is not None for value in values):
                values = [_value(of, name, values, place) for place in range(len(values))]
                # One word stands for all, as in cases
                several = values[:1] if row.choices and len(set(values)) == 1 else values
                properties[row.name] = tuple(several) if of in _LISTS else values[0]
    return properties


def _value(of: str, name: str, values: Sequence[Any], place: int) -> Any:
    """A value of a part, the usual one where only others of its kind have one."""
    if values[place] is not None:
        return values[place]
    usual = WALL_ABSENT.get(KINDS[of]._rows()[name].name)
    if usual is None:
        other = next(i for i, value in enumerate(values) if value is not None)
        raise InputError(f"{_where(of, place)}.{name}: must be given, as {_where(of, other)} has one")
    return usual


def parts_from(properties: Mapping[str, Any]) -> dict[str, Any]:
    """Parts out of the lists of a wall, by the names that walls have for them."""
    found: dict[str, Any] = {}
    for of, kind in KINDS.items():
        rows = kind._rows().items()
        own: dict[str, Any] = {name: value for name, row in rows if (value := properties.get(row.name)) is not None}
        if of not in _LISTS:
            found[of] = kind(**own) if own else None
            continue
        count = max(map(len, own.values()), default=0)
        # One value stands for all
        columns = {name: value * count if len(value) == 1 else value for name, value in own.items()}
        found[of] = tuple(kind(**{name: value[i] for name, value in columns.items()}) for i in range(count))
    return found


def in_whole(part: Part) -> list[tuple[str, str, str]]:
    """A part as it is computed with, what is not given the usual number: names of fields, properties and values."""
    values = [(name, row.name, getattr(part, name)) for name, row in part._rows().items()]
    known = [(name, what, WALL_ABSENT.get(what) if value is None else value) for name, what, value in values]
    return [
        (name, what, f"{value:.6g}" if isinstance(value, float) else repr(value))
        for name, what, value in known
        if value is not None and not (what in _NONE and value == 0.0)
    ]


def _where(of: str, place: int) -> str:
    """How a message names a part."""
    return f"{of}[{place}]" if of in _LISTS else of


def named_by_parts(error: InputError, properties: Mapping[str, Any]) -> InputError:
    """An error of the library, which knows lists, with the parts that walls have in Python instead."""
    message = "\n".join(_by_parts(line, properties) for line in str(error).split("\n"))
    errors = [one._replace(message=_by_parts(one.message, properties)) for one in error.errors]
    return InputError(
        message,
        errors=[
            one._replace(variable=_PART.match(one.message)[0]) if one.variable in PLACES else one  # type: ignore[index]
            for one in errors
        ],
    )


def _by_parts(sentence: str, properties: Mapping[str, Any]) -> str:
    """One sentence of a message."""
    told = re.match(_BEGINNING, sentence)
    about = PLACES[told[1]][0] if told else ""
    if told:
        of, name = PLACES[told[1]]
        values, rest = properties.get(told[1]), sentence[told.end(1) :]
        if rest.startswith(" = "):
            several = values if isinstance(values, tuple) else (values,)
            place = next((i for i, value in enumerate(several) if _is_off(told[1], value)), 0)
            sentence = f"{_where(of, place)}.{name} = {_number(several[place])}{rest[rest.index(':') :]}"
        else:
            sentence = f"{of}: {name}{rest}" if "_" in told[1] else f"{of}{rest}"
    # What the library has numbered itself, from 1
    sentence = re.sub(_NUMBERED, lambda found: f"{_where(_OF_WORDS[found[1]], int(found[2]) - 1)}.{found[3]}", sentence)
    sentence = _VALUE.sub(r"\1 = \2: must", sentence)

    def known(found: re.Match[str]) -> str:
        of, name = PLACES[found[0]]
        return name if of == about or f"{of}[" in sentence else f"{name}{'es' if name.endswith('s') else 's'} of {of}"

    return re.sub(_NAMES, known, sentence)


def _number(value: float | str) -> str:
    return repr(value) if isinstance(value, str) else f"{value:.15g}"


def _is_off(name: str, value: float | str) -> bool:
    """Is a value beyond the range of its property?"""
    row = _ROWS[name]
    if isinstance(value, str):
        return value not in row.choices
    return not row.smallest <= value <= row.largest or (row.bounds == "positive" and not value > 0.0)


# Words and names of the library in its sentences: patterns that are compiled for the first error, not at every import
_OF_WORDS = {kind.word: of for of, kind in KINDS.items()}
_BEGINNING = rf"({'|'.join(sorted(PLACES, key=len, reverse=True))})\b(?= = |: |,)"
# What a sentence about a part begins with: loads[0].force
_PART = re.compile(r"[\w.\[\]]*")
_NUMBERED = rf"\b({'|'.join(_OF_WORDS)}) (\d+)(?:: its|,) (?:\1_)?(\w+)"
_VALUE = re.compile(r"^(\S+\]\.\w+)(?: =)? ([^\s:]+) must")
_NAMES = rf"\b({'|'.join(name for name in PLACES if '_' in name)})\b"
