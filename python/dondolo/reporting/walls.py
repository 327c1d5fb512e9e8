"""Chapter of a report on its walls: their properties, statics and curves, and drawings of them."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from dondolo._base.wording import in_english, property_name, say
from dondolo._fortran.library import Property
from dondolo._fortran.walls import WALL_EXTRAS, WALL_PROPERTIES
from dondolo.analysis.response import Response
from dondolo.figures.style import mechanism_name
from dondolo.populations.typology import Typology
from dondolo.reporting.blocks import Block, Details, Facts, Picture
from dondolo.reporting.columns import parameters_of, shown
from dondolo.reporting.content import Column, Pairs, Piece, Symbol, Table, pieces
from dondolo.reporting.numerals import number
from dondolo.reporting.parts import ROWS, captioned
from dondolo.reporting.run import Run
from dondolo.reporting.units import UNITS, Unit
from dondolo.reporting.words import in_words
from dondolo.walls.chains import TABLES, ChainWall
from dondolo.walls.mechanisms import OneSidedWall
from dondolo.walls.parts import parts_of
from dondolo.walls.population import Population
from dondolo.walls.table import occurrence_columns
from dondolo.walls.tabulated import TERMS, TabulatedWall
from dondolo.walls.wall import Wall, effective_property, notes_on_supports

# What sentences that are said elsewhere are marked by for the catalogues
_ = str
# What stands behind properties of a wall in place of their units
_INSTEAD = {"hinge": _("of the height"), "eccentricity": _("m, to the outer side"), "restitution": _("model")}

# Properties of every wall of a population, and those that a wall of its mechanism has
_SIZES = ("height", "thickness", "density")
_OF_TWO_BLOCKS = ("hinge", "overburden", "overburden_inertia", "eccentricity")
# Designs, or mechanisms of a facade, that are drawn one by one and have their calculation sheets
DRAWN = 24
# Columns of a table of further properties: what fits across a page
_ACROSS = 8


def mechanism_of(wall: Wall) -> str:
    """The mechanism of a wall in words: with wedges of transverse walls its overturning is compound."""
    return say("compound overturning") if parts_of(wall, "wedges") else mechanism_name(wall.mechanism)


def walls(run: Run) -> list[Block]:
    """The walls with their statics, and their curves."""
    people = run.population
    if len(people) == 1:
        blocks: list[Block] = [Facts(tuple(_wall_facts(run)))]
        if not isinstance(run.results, Response):
            alt = say(
                "The wall at rest and at half of its capacity, with what it carries and what holds it, drawn to scale."
            )
            blocks.append(Picture(people.walls[0].plot, alt, alt))
        return [*blocks, *_elevations(people.walls)]
    facts = people._facts()
    if run.designs is not None:
        facts = [(say("designs"), str(len(people)))]
    elif run.is_alike:
        facts = [(say("facade"), people.wholes[0]), (say("mechanisms"), str(len(people)))]
    blocks = [Facts((*facts, *people._ranges(), *notes_on_supports(people.walls)))]
    if run.is_alike and len(people) <= DRAWN:
        caption = _("{name}: at rest (dashed) and at half of its capacity, to scale.")
        alt = _("{wall}, at rest and at half of its capacity, with what it carries and what holds it, drawn to scale.")
        blocks += [Picture(wall.plot, say(caption, name=wall.name), say(alt, wall=wall.name)) for wall in people.walls]
        blocks += _elevations(people.walls)
    return [*blocks, _tables(run)]


def _tables(run: Run) -> Details:
    """Properties, statics and curves of all walls."""
    people = run.population
    main, further = _main_properties(people, run.is_alike), _further_properties(people.walls)
    parts = [
        say("Further properties of the walls that have them.")
        if len(further) == 1
        else say(
            "Further properties of the walls that have them, part {number} of {parts}.",
            number=number,
            parts=len(further),
        )
        for number in range(1, len(further) + 1)
    ]
    title = (
        say("Tables of the walls and mechanisms ({shown} of {total} rows)", shown=ROWS, total=main.total)
        if main.total > ROWS
        else say("Tables of the walls and mechanisms (rows: {total})", total=main.total)
    )
    return Details(
        title,
        (
            captioned(main, say("Walls and mechanisms with their main properties.")),
            *(captioned(table, caption) for table, caption in zip(further, parts, strict=True)),
            captioned(_statics(run), say("Statics of the walls, and their curves of collapse.")),
        ),
    )


def _elevations(walls: Sequence[Wall]) -> list[Picture]:
    """Drawings of the elevations of walls that have one."""
    caption = _("{name}: elevation; what turns is brown, what stays is grey.")
    alt = _("Elevation of {wall} with its openings and the line that it turns about, drawn to scale.")
    return [
        Picture(wall.plot_elevation, say(caption, name=wall.name), say(alt, wall=wall.name))
        for wall in walls
        if isinstance(wall, OneSidedWall) and wall.elevation_x is not None
    ]


def _wall_facts(run: Run) -> Pairs:
    """Properties and statics of the one wall."""
    wall = run.population.walls[0]
    pairs: Pairs = [(say("name"), wall.name), (say("mechanism"), mechanism_of(wall))]
    for row in WALL_PROPERTIES[2:]:
        if row.name in TERMS or row.name in TABLES:
            continue
        unit, factor = _unit(row)
        if value := _set(row.name, effective_property(wall, row.name), factor):
            pairs.append((property_name(row.name), (value, f" {unit}" if unit else "")))
    if isinstance(wall, TabulatedWall):
        pairs += wall._facts()[:1]
    if wall.base_hinge_depth > 0.0 and getattr(wall, "hinge_depth", None) is None:
        pairs.append((say("depth of the hinge"), number(wall.base_hinge_depth, unit=" m")))
    pairs += [
        (pieces("trigger {a0}", a0=Symbol("a", "0")), number(wall.trigger_acceleration / wall.gravity, unit=" g")),
        (say("capacity"), number(wall.capacity_angle, unit=" rad")),
        (pieces("frequency parameter {p}", p=Symbol("p")), number(wall.frequency_parameter, unit=" rad/s")),
        (say("restitution e of impacts"), number(wall.restitution_coefficient)),
        (say("gravity"), number(wall.gravity, unit=" m/s²")),
    ]
    if wall.support_share > 0.0:
        pairs += [
            (
                pieces("share {k} of the relative acceleration of its supports", k=Symbol("k")),
                number(wall.support_share),
            ),
            (
                pieces("tilt {tau} by their relative displacement", tau=Symbol("τ")),
                number(wall.support_tilt, unit=" 1/s²"),
            ),
        ]
    pairs += notes_on_supports((wall,))
    if isinstance(run.results, Typology):
        weights, p_occ = run.population.weights, run.population.p_occ
        pairs += [(say("weight"), number(weights[0])), (Symbol("p", "occ"), number(p_occ[0]))]
    return pairs


def _main_properties(people: Population, is_alike: bool) -> Table:
    """What every wall of a population has, and the loads of its top; designs and hinges of a facade have no weights."""
    walls = people.walls
    columns: dict[str, Sequence[Any]] = {"wall": [wall.name for wall in walls]}
    if any(people.group_names):
        columns["group"] = people.group_names
    columns["mechanism"] = [wall.mechanism for wall in walls]
    if not is_alike:
        columns["weight"] = people.weights.tolist()
    if not is_alike or np.any(people.p_occ < 1.0):
        columns["p_occ"] = people.p_occ.tolist()
    columns |= occurrence_columns(people.occurrence, people.alternatives)
    for what in (*_SIZES, *_OF_TWO_BLOCKS):
        values = [getattr(wall, what, None) for wall in walls]
        if any(value is not None for value in values):
            columns[what] = values
    misfits = [wall.misfit if isinstance(wall, (ChainWall, TabulatedWall)) else None for wall in walls]
    if any(misfit is not None for misfit in misfits):
        columns["table_misfit"] = misfits
    notes = (Column(name, texts, True) for name, texts in people.notes.items())
    return Table((*shown(columns).columns, *notes))


def _further_properties(walls: Sequence[Wall]) -> list[Table]:
    """Sections, loads, ties, floors: what some of the walls have, as many columns a table as a page is wide."""
    rows = [
        row for row in WALL_PROPERTIES if row.name in WALL_EXTRAS and row.name not in (*_OF_TWO_BLOCKS, *TERMS, *TABLES)
    ]
    units = {row.name: _unit(row) for row in rows}
    known = {
        name: [_set(name, effective_property(wall, name), unit.factor) for wall in walls]
        for name, unit in units.items()
    }
    having = [i for i in range(len(walls)) if any(cells[i] for cells in known.values())]
    # Plates of ties and the like are 0 where they are not given: they have a column only where a wall has them.
    absent = {name for name in units if all(_is_absent(effective_property(wall, name)) for wall in walls)}
    columns: list[tuple[Piece, Sequence[Piece]]] = [
        (property_name(name) + (f" [{unit.name}]" if unit.name else ""), cells)
        for name, unit in units.items()
        if name not in absent and any(cells := [known[name][i] for i in having])
    ]
    tables = []
    for first in range(0, len(columns), _ACROSS):
        part: dict[Piece, Sequence[Piece]] = {say("wall"): [walls[i].name for i in having]}
        part |= dict(columns[first : first + _ACROSS])
        tables.append(Table.of(part, map(str, part)))
    return tables


def _is_absent(values: Any) -> bool:
    """Is a property not given, or 0, or every number of a list?"""
    several = values if isinstance(values, tuple) else (values,)
    return all(value is None or value == 0.0 for value in several)


def _unit(row: Property) -> Unit:
    """The unit that a property is shown in."""
    if row.name in _INSTEAD:
        return Unit(say(_INSTEAD[row.name]))
    return UNITS.get(row.unit, Unit(say(row.unit)))


def _set(name: str, value: Any, factor: float = 1.0) -> Piece:
    """A property to be set, times a factor if it is a number; empty if it is not given."""
    if isinstance(value, tuple):
        between = ", " if in_english() else "; "
        parts = [part for one in value for part in (between, _set(name, one, factor))]
        return tuple(parts[1:])
    if value is None or isinstance(value, str):
        return in_words(name, value or "")
    return "" if np.isnan(value) else number(factor * value, 6)


def _statics(run: Run) -> Table:
    """Statics and curves of the walls of a population."""
    walls, results = run.population.walls, run.results
    columns: dict[str, Sequence[Any]] = {
        "wall": [wall.name for wall in walls],
        "mechanism": [wall.mechanism for wall in walls],
        "trigger": [wall.trigger_acceleration / wall.gravity for wall in walls],
        "capacity_rad": [wall.capacity_angle for wall in walls],
        "p_rad_s": [wall.frequency_parameter for wall in walls],
        "restitution": [wall.restitution_coefficient for wall in walls],
    }
    if not isinstance(results, Typology):
        return shown(columns)
    return shown(columns | parameters_of(results.curves, "theta", "beta", "status"), results.im)
