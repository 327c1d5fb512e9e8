"""Facts of a report on what was run: case, walls, records, checks, software."""

from __future__ import annotations

import platform
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from dondolo._base.wording import decimal, in_english, property_name, say
from dondolo._fortran.library import Property, build_variant, constants
from dondolo._fortran.walls import WALL_EXTRAS, WALL_PROPERTIES
from dondolo._storage.run_file import RECORD_FACTS, RunFile
from dondolo.analysis.response import Response
from dondolo.analysis.stripes import Stripes
from dondolo.exchange.case_text import case_text
from dondolo.figures.style import mechanism_name
from dondolo.populations.typology import Typology
from dondolo.records.record import Record
from dondolo.records.synthetic import SYNTHETIC
from dondolo.reporting.columns import parameters_of, shown
from dondolo.reporting.content import (
    Column,
    Facts,
    Piece,
    Symbol,
    Table,
    date_in_words,
    figure,
    level_unit,
    measure_name,
    pieces,
    state_name,
)
from dondolo.reporting.numerals import number, percent, whole
from dondolo.reporting.run import Run
from dondolo.reporting.statuses import status_table
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
# What a table of records says of each
_DESCRIBED = ("event", *RECORD_FACTS)


def mechanism_of(wall: Wall) -> str:
    """The mechanism of a wall in words: with wedges of transverse walls its overturning is compound."""
    return say("compound overturning") if parts_of(wall, "wedges") else mechanism_name(wall.mechanism)


def inputs(run: Run) -> dict[str, Any]:
    """The case with all its variables, and the files that it is made of."""
    case, files = "", None
    if run.file is not None and "records" in run.file.settings:
        case = case_text(run.file.settings)
    if run.file is not None and run.file.inputs:
        files = _files_table(run.file)
    return {"case": case, "settings": [*run.settings, *_levels(run)], "files": files}


def _files_table(file: RunFile) -> Table:
    """Input files with their checksums."""
    missing, role = say("removed during the run"), say("role")
    columns: dict[Piece, Sequence[Piece]] = {
        say("file"): [str(one["path"]) for one in file.inputs],
        role: [say(str(one["role"])) for one in file.inputs],
        say("bytes"): [missing if one["bytes"] is None else whole(one["bytes"]) for one in file.inputs],
        "CRC-32": [missing if one["crc32"] is None else str(one["crc32"]) for one in file.inputs],
    }
    return Table.of(columns, (role,))


def _levels(run: Run) -> Facts:
    """The levels of stripes and populations."""
    if isinstance(run.results, Response):
        return []
    return [
        (
            say("levels of {im}", im=measure_name(run.results.im)),
            (", " if in_english() else "; ").join(decimal(f"{level:g}") for level in run.results.levels),
        )
    ]


def _elevations(walls: Sequence[Wall]) -> list[tuple[str, Any]]:
    """Drawings of the elevations of walls that have one."""
    alt = _("Elevation of {wall} with its openings and the line that it turns about, drawn to scale.")
    return [
        (wall.name, figure(wall.plot_elevation, say(alt, wall=wall.name)))
        for wall in walls
        if isinstance(wall, OneSidedWall) and wall.elevation_x is not None
    ]


def walls(run: Run) -> dict[str, Any]:
    """The walls with their statics, and their curves."""
    people = run.population
    if len(people) == 1:
        drawing = None
        if not isinstance(run.results, Response):
            alt = say(
                "The wall at rest and at half of its capacity, with what it carries and what holds it, drawn to scale."
            )
            drawing = figure(people.walls[0].plot, alt)
        elevations = _elevations(people.walls)
        return {
            "facts": _wall_facts(run), "tables": [], "drawing": drawing, "drawings": [], "elevations": elevations
        }  # fmt: skip
    further = _further_properties(people.walls)
    facts, drawings = people._facts(), []
    if run.is_alike and len(people) <= DRAWN:
        alt = _("{wall}, at rest and at half of its capacity, with what it carries and what holds it, drawn to scale.")
        drawings = [(wall.name, figure(wall.plot, say(alt, wall=wall.name))) for wall in people.walls]
    if run.designs is not None:
        facts = [(say("designs"), str(len(people)))]
    elif run.is_alike:
        facts = [(say("facade"), people.wholes[0]), (say("mechanisms"), str(len(people)))]
    tables = [
        (say("Walls and mechanisms with their main properties."), _main_properties(people, run.is_alike)),
        *(
            (
                say("Further properties of the walls that have them.")
                if len(further) == 1
                else say(
                    "Further properties of the walls that have them, part {number} of {parts}.",
                    number=number,
                    parts=len(further),
                ),
                table,
            )
            for number, table in enumerate(further, 1)
        ),
        (say("Statics of the walls, and their curves of collapse."), _statics(run)),
    ]
    return {
        "facts": [*facts, *people._ranges(), *notes_on_supports(people.walls)],
        "tables": tables,
        "drawing": None,
        "drawings": drawings,
        "elevations": _elevations(people.walls) if drawings else [],
    }


def _wall_facts(run: Run) -> Facts:
    """Properties and statics of the one wall."""
    wall = run.population.walls[0]
    pairs: Facts = [(say("name"), wall.name), (say("mechanism"), mechanism_of(wall))]
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


def has_vertical(run: Run) -> bool | None:
    """Whether vertical ground motion was applied; None where the results do not know."""
    if run.file is not None:
        return bool(run.file.setting("records", "vertical", "none") == "recorded")
    if run.records:
        return any(record.vertical is not None for record in run.records)
    return run.results.uplift is not None if isinstance(run.results, Stripes) else None


def on_ground(run: Run) -> bool | None:
    """Whether no wall stands on a building, or every one (False); None where some do."""
    grounded = {wall.building is None for wall in run.population.walls}
    return grounded.pop() if len(grounded) == 1 else None


def records(run: Run) -> dict[str, Any]:
    """The records, and what is known of them."""
    results = run.results
    pairs: Facts = []
    if run.file is not None:
        catalogue = run.file.setting("records", "catalogue", "")
        polarity = say(run.file.setting("records", "polarity", "").replace("_", " "))
        pairs += [(name, text) for name, text in ((say("catalogue"), catalogue), (say("polarity"), polarity)) if text]
    if has_vertical(run):
        factor = 1.0 if run.file is None else run.file.setting("records", "vertical_factor", 1.0)
        scaled = "" if factor == 1.0 else say(", times {factor:g}", factor=float(factor))
        applied = say("applied: recorded components, scaled as their records")
        pairs.append((say("vertical motion"), applied + scaled))
    if isinstance(results, Typology):
        few, many = int(results.histories.min()), int(results.histories.max())
        text = say("{few} to {many}, by mechanism", few=few, many=many) if few < many else str(few)
        pairs.append((say("histories of a stripe"), text))
    if isinstance(results, Response):
        pairs += [
            *run.records[0]._facts(),
            (say("record"), results.record.name),
            (say("factor"), number(results.scale)),
        ]
    formats = _formats(run)
    if SYNTHETIC in formats:
        counts = {"some": list(formats).count(SYNTHETIC), "all": len(formats)}
        pairs.append((say("origin"), say("{some} of {all} records are synthetic: computed, not recorded", **counts)))
    found: dict[str, Any] = {"facts": pairs, "histories": None, "records": None}
    found["is_motion"] = isinstance(results, Response)
    if isinstance(results, Stripes):
        found |= {"histories": _histories_table(results), "levels": len(results.levels)}
    if run.records and not found["is_motion"]:
        found["records"] = _records_table(run.records)
    elif run.file is not None and run.file.records:
        found["records"] = _stored_records_table(run.file.records)
    elif isinstance(results, Stripes) and any(results.events):
        named = zip(results.record_names, results.events, strict=False)
        found["records"] = _stored_records_table([{"name": name, "event": event} for name, event in named])
    return found


def _formats(run: Run) -> Sequence[str]:
    """Formats that the records were read in."""
    if run.records:
        return [record.metadata.get("format", "") for record in run.records]
    if run.file is not None and run.file.records:
        return [one.get("format", "") for one in run.file.records]
    return run.results.record_formats if isinstance(run.results, Stripes) else ()


def _stored_records_table(stored: Sequence[Mapping[str, str]]) -> Table:
    """Records of result files, which have their names and headers, and not their samples."""
    columns: dict[Piece, Sequence[Piece]] = {say("record"): [one["name"] for one in stored]}
    described = _described(stored)
    return Table.of(columns | described, tuple(map(str, described)))


def _described(headers: Sequence[Mapping[str, str]]) -> dict[Piece, Sequence[Piece]]:
    """What headers and catalogue state of each record, and that they do not."""
    missing = say("not given")
    return {say(name): [one.get(name) or missing for one in headers] for name in _DESCRIBED}


def _histories_table(stripes: Stripes) -> Table:
    """The histories of a stripe; the level over the factor is the intensity of the record as it is."""
    polarity = say("polarity")
    unscaled = np.nanmax(stripes.levels[:, None] / stripes.scale, axis=0)
    columns: dict[Piece, Sequence[Piece]] = {
        say("record"): list(stripes.record_names),
        polarity: [say("reversed") if sign < 0 else say("as recorded") for sign in stripes.polarity],
        say("{im} unscaled [{unit}]", im=stripes.im, unit=level_unit(stripes.im)): [number(x) for x in unscaled],
        say("factor from"): [number(x) for x in np.nanmin(stripes.scale, axis=0)],
        say("to"): [number(x) for x in np.nanmax(stripes.scale, axis=0)],
        say("collapses"): [whole(z) for z in stripes.collapsed.sum(axis=0)],
    }
    return Table.of(columns, (polarity,))


def _records_table(records: Sequence[Record]) -> Table:
    """Records that are at hand."""
    columns: dict[Piece, Sequence[Piece]] = {say("record"): [one.name for one in records]}
    described = _described([one.metadata for one in records])
    columns |= described
    columns |= {
        "PGA [g]": [number(one.intensity("pga")) for one in records],
        "PGV [m/s]": [number(one.intensity("pgv")) for one in records],
        say("duration [s]"): [number(one.duration) for one in records],
        say("time step [s]"): [number(one.dt) for one in records],
    }
    if any(one.processing for one in records):
        columns[say("processing")] = ["; ".join(one.processing) for one in records]
    if any("reading" in one.metadata for one in records):
        columns[say("reading")] = [one.metadata.get("reading", "") for one in records]
    return Table.of(columns, (*map(str, described), say("processing"), say("reading")))


def checks(run: Run) -> dict[str, Any]:
    """What to look at before the numbers are believed."""
    results = run.results
    if isinstance(results, Response):
        rows: Piece = say("none") if results.time is None else whole(len(results.time))
        pairs: Facts = [(say("limit of the EDP"), number(results.edp_limit)), (say("rows of the time history"), rows)]
        if results.edp_error is not None:
            pairs.insert(0, (say("largest estimated error of an EDP"), number(results.edp_error, 3)))
        return {"statuses": None, "facts": pairs}
    if isinstance(results, Typology):
        limit = float(results.edp_thresholds[-1])
        states = {state_name(float(edp), limit): results.at(float(edp)).curves for edp in results.edp_thresholds}
        error = None
    else:
        states = {state_name(float(one.edp_threshold or 0.0), results.edp_limit): (one,) for one in run.states}
        error = results.edp_error
    scales: Piece = say("none")
    if run.scales is not None:
        share = percent(run.scales.many / run.scales.histories)
        scales = pieces(
            "{share} of the histories, the largest {largest}", share=share, largest=number(run.scales.largest)
        )
    pairs = [(say("scale factors above 10"), scales)]
    if error is not None:
        pairs.append((say("largest estimated error of an EDP"), number(float(np.nanmax(error)), 3)))
    work = results.work
    histories, runs = counted_histories(results)
    still = (whole(work.still // runs), " (", percent(work.still / max(work.histories, 1)), ")")
    pairs += [(say("histories"), whole(histories)), (say("of these never move"), still)]
    if runs > 1:
        pairs.append((say("runs of each history, to estimate its error; what follows counts all"), whole(runs)))
    pairs += [
        (say("sample intervals"), whole(work.intervals)),
        (say("of these with rocking"), (whole(work.rocked), " (", percent(work.rocked / max(work.intervals, 1)), ")")),
        (say("steps of the integration"), whole(work.steps)),
        (say("impacts located"), whole(work.impacts)),
        *work._notes(),
    ]
    return {"statuses": status_table(states), "facts": pairs}


def counted_histories(results: Typology | Stripes) -> tuple[int, int]:
    """How many histories there are, and how many times each was run: several to estimate its error."""
    runs = results.work.histories
    histories = int(results.ran.sum()) if isinstance(results, Stripes) else runs
    return histories, runs // max(histories, 1)


def software(run: Run) -> Facts:
    """Versions of what ran, and of what writes the report."""
    from importlib.metadata import version

    pairs: Facts = []
    if run.file is None:
        pairs.append((say("build variant of this machine"), build_variant()))
    else:
        pairs.append((say("run by"), f"dondolo {run.file.version}"))
        known = {
            say("compiler"): run.file.compiler and f"{run.file.compiler}, real{run.file.real_bits}",
            say("engine and build variant"): run.file.engine,
        }
        pairs += [(name, text) for name, text in known.items() if text]
        if run.file.written is not None:
            pairs.append((say("result files written"), date_in_words(run.file.written)))
    pairs += [(say("report by"), f"dondolo {constants().version}"), ("Python", platform.python_version())]
    return pairs + [(name, version(name.lower())) for name in ("NumPy", "SciPy", "Matplotlib")]
