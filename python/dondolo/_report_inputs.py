"""Chapters of a report on what was run: case, walls, records, checks, limits, software."""

from __future__ import annotations

import platform
from collections.abc import Sequence
from typing import Any

import numpy as np

from dondolo._fortran import _binding
from dondolo._page import (
    ROWS,
    Markup,
    details,
    escaped,
    facts,
    joined,
    number,
    paragraph,
    parameter,
    percent,
    symbol,
    table,
    tag,
    whole,
)
from dondolo._report_run import Run, quoted
from dondolo._report_words import BETA, THETA, date_in_words, state_name, status_table
from dondolo.analysis.response import Response
from dondolo.analysis.stripes import Stripes
from dondolo.exchange.results import heads
from dondolo.figures.style import mechanism_name
from dondolo.populations.typology import Typology
from dondolo.records.record import Record


def inputs_chapter(run: Run) -> Markup:
    """The case with all its variables, as the files repeat it."""
    first = next((i for i, line in enumerate(run.comments) if line.startswith("&")), None)
    if first is None:
        text = "The results were made in Python, not from a case file; these settings stand in them."
        return joined(paragraph(text), facts([*run.settings, *_levels(run)]))
    last = max(i for i, line in enumerate(run.comments) if line.endswith("/"))
    lines = [line if line.startswith("&") else f"   {line}" for line in run.comments[first : last + 1]]
    return joined(
        paragraph("The case with all its variables: what was given, and the defaults of what was left out."),
        tag("pre", "\n".join(lines)),
    )


def _levels(run: Run) -> list[tuple[str, str]]:
    """The levels of results that come without a case."""
    if (run.settings and run.settings[0][0] == "task") or isinstance(run.results, Response):
        return []
    return [(f"levels of {run.results.im}", ", ".join(f"{level:g}" for level in run.results.levels))]


def walls_chapter(run: Run) -> Markup:
    """The walls with their statics, and their curves."""
    people = run.population
    walls = people.walls
    if len(walls) == 1:
        wall = walls[0]
        names = {
            "height": "m", "thickness": "m", "density": "kg/m3", "hinge": "of the height", "overburden": "N/m",
            "eccentricity": "m, to the outer side", "restitution": "model", "restitution_value": "",
            "restitution_factor": "",
        }  # fmt: skip
        given = [(name.replace("_", " "), getattr(wall, name, None), unit) for name, unit in names.items()]
        pairs = [
            ("name", escaped(wall.name)),
            ("mechanism", escaped(mechanism_name(wall.mechanism))),
            *(
                (name, joined(value if isinstance(value, str) else number(value, 6), f" {unit}"))
                for name, value, unit in given
                if value is not None and not (isinstance(value, float) and np.isnan(value))
            ),
            (joined("trigger ", symbol("a", "0")), joined(number(wall.trigger_acceleration / wall.gravity), " g")),
            ("capacity", joined(number(wall.capacity_angle), " rad")),
            (joined("frequency parameter ", symbol("p")), joined(number(wall.frequency_parameter), " rad/s")),
            ("speed ratio of impacts", number(wall.restitution_coefficient)),
            ("gravity", joined(number(wall.gravity), " m/s2")),
        ]
        if isinstance(run.results, Typology):
            pairs += [("weight", number(people.weights[0])), (symbol("p", "occ"), number(people.p_occ[0]))]
        return facts(pairs)
    columns: dict[Any, Any] = {"wall": [wall.name for wall in walls]}
    if any(people.groups):
        columns["group"] = list(people.groups)
    columns |= {
        "mechanism": [mechanism_name(wall.mechanism) for wall in walls],
        "weight": [number(weight) for weight in people.weights],
        symbol("p", "occ"): [number(p) for p in people.p_occ],
        "height [m]": [number(wall.height) for wall in walls],
        "thickness [m]": [number(wall.thickness) for wall in walls],
        "density [kg/m3]": [number(wall.density) for wall in walls],
    }
    for what, head in (("hinge", "hinge / height"), ("overburden", "overburden [N/m]"), ("eccentricity", "ecc. [m]")):
        values = [getattr(wall, what, None) for wall in walls]
        if any(value is not None for value in values):
            columns[head] = [number(value) for value in values]
    columns |= {
        joined(symbol("a", "0"), " [g]"): [number(wall.trigger_acceleration / wall.gravity) for wall in walls],
        "capacity [rad]": [number(wall.capacity_angle) for wall in walls],
        joined(symbol("p"), " [rad/s]"): [number(wall.frequency_parameter) for wall in walls],
        "speed ratio": [number(wall.restitution_coefficient) for wall in walls],
    }
    results = run.results
    if isinstance(results, Typology):
        unit = _binding.unit_of(results.im) or "-"
        columns |= {
            joined(THETA, f" [{unit}]"): [parameter(curve.theta) for curve in results.curves],
            BETA: [parameter(curve.beta) for curve in results.curves],
            "status": [curve.status for curve in results.curves],
        }
    words = ("group", "mechanism", "status")
    content = table("Walls and mechanisms with their statics and curves of collapse.", columns, words)
    rows = f"{min(ROWS, len(walls))} of {len(walls)}" if len(walls) > ROWS else str(len(walls))
    return joined(
        facts([*people._facts(), *people._ranges()]),
        details(f"Table of the walls and mechanisms ({rows} rows)", content),
    )


def records_chapter(run: Run) -> Markup:
    """The records, and what is known of them."""
    results = run.results
    if isinstance(results, Stripes):
        # The level over the factor is the intensity of the record as it is.
        unscaled = results.levels[0] / results.scale[0]
        columns: dict[Any, Any] = {
            "record": list(results.record_names),
            "polarity": ["reversed" if sign < 0 else "as recorded" for sign in results.polarity],
            f"{results.im} unscaled [{_binding.unit_of(results.im) or '-'}]": [number(x) for x in unscaled],
            "largest factor": [number(x) for x in results.scale[-1]],
            "collapses": [whole(z) for z in results.collapsed.sum(axis=0)],
        }
        text = f"Records, and collapses at {len(results.levels)} levels."
        content = details(f"Table of the histories of a stripe ({len(unscaled)})", table(text, columns, ("polarity",)))
    elif run.records:
        content = _records_table(run.records)
    else:
        content = paragraph(
            "The results hold counts of histories, not the records: keep the catalogue and its files with this report."
        )
    pairs: list[tuple[Any, Any]] = []
    catalogue, polarity = quoted("catalogue", run.comments), quoted("polarity", run.comments)
    if catalogue:
        pairs.append(("catalogue", catalogue))
    if polarity:
        pairs.append(("polarity", polarity.replace("_", " ")))
    if isinstance(results, Typology):
        few, many = int(results.histories.min()), int(results.histories.max())
        pairs.append(("histories of a stripe", f"{few} to {many}, by mechanism" if few < many else str(few)))
    if isinstance(results, Response):
        pairs += [(name, text) for name, text in run.records[0]._facts()]
        pairs += [("record", results.record.name), ("factor", number(results.scale))]
        content = Markup("")
    return joined(facts(pairs) if pairs else "", content)


def _records_table(records: Sequence[Record]) -> Markup:
    """Records that are at hand."""
    known = [key for key in ("event", "date", "station", "component") if any(key in one.metadata for one in records)]
    columns: dict[Any, Any] = {"record": [one.name for one in records]}
    columns |= {key: [one.metadata.get(key, "") for one in records] for key in known}
    columns |= {
        "PGA [g]": [number(one.intensity("pga")) for one in records],
        "PGV [m/s]": [number(one.intensity("pgv")) for one in records],
        "duration [s]": [number(one.duration) for one in records],
        "time step [s]": [number(one.dt) for one in records],
        "processing": ["; ".join(one.processing) for one in records],
    }
    if not any(one.processing for one in records):
        del columns["processing"]
    return details(
        f"Table of the records ({len(records)})",
        table("Records as they are, not scaled.", columns, (*known, "processing")),
    )


def checks_chapter(run: Run) -> Markup:
    """What to look at before the numbers are believed."""
    results = run.results
    pieces = []
    if isinstance(results, Typology):
        limit = float(results.edp_thresholds[-1])
        states = {state_name(float(edp), limit): results.at(float(edp)).curves for edp in results.edp_thresholds}
        pieces.append(status_table(states))
    elif isinstance(results, Stripes):
        states = {state_name(float(edp), results.edp_limit): [results.fit(float(edp))] for edp in run.thresholds}
        pieces.append(status_table(states))
    pairs: list[tuple[Any, Any]] = [("scale factors above 10", _scales(run))] if pieces else []
    error = getattr(results, "edp_error", None)
    if error is not None:
        pairs.append(("largest estimated error of an EDP", number(float(np.max(error)), 3)))
    if not isinstance(results, Response):
        work = results.work
        pairs += [
            ("histories", whole(work.histories)),
            ("of these never move", joined(whole(work.still), " (", percent(work.still / max(work.histories, 1)), ")")),
            ("sample intervals", whole(work.intervals)),
            (
                "of these with rocking",
                joined(whole(work.rocked), " (", percent(work.rocked / max(work.intervals, 1)), ")"),
            ),
            ("steps of the integration", whole(work.steps)),
            ("impacts located", whole(work.impacts)),
        ]
    else:
        pairs += [("limit of the EDP", number(results.edp_limit)), ("rows of the time history", _rows_of(results))]
    text = "Counts of the work are the same for any number of threads: a run can be told by them."
    return joined(*pieces, facts(pairs), paragraph(text) if not isinstance(results, Response) else "")


def _rows_of(motion: Response) -> Markup:
    return Markup("none") if motion.time is None else whole(len(motion.time))


def _scales(run: Run) -> Markup:
    """Share of the histories whose records are scaled by a lot."""
    if run.scales is None:
        return Markup("none")
    share = run.scales.many / run.scales.histories
    return joined(percent(share), " of the histories, the largest ", number(run.scales.largest))


def limits_chapter(results: Any) -> Markup:
    """What the models leave out."""
    lines = [
        "The motion is that of the base of the wall. A wall of an upper storey needs the motion of its floor.",
        "Walls are rigid: no sliding, no crushing of the hinges, no vertical ground motion, no flexible floors.",
        "Each mechanism moves on its own, and walls do not interact.",
        "Impacts are instantaneous and lose the same share of the speed at any speed.",
        "Records that are scaled by large factors may not resemble earthquakes of that strength.",
    ]
    if isinstance(results, Typology):
        lines.append(
            "The curves hold the variability of the records and of the walls in the table; how well the models and"
            " their parameters describe walls comes on top."
        )
        lines.append(
            "Mechanisms of a wall are taken for independent of each other, given the intensity; in fact the same record"
            " shakes them."
        )
    else:
        lines.append("Nothing here describes how sure the properties of the wall are.")
    return tag("ul", *(tag("li", line) for line in lines))


def software_chapter(run: Run) -> Markup:
    """Versions of what ran, and of what wrote this page."""
    from importlib.metadata import version

    pairs: list[tuple[Any, Any]] = []
    if run.comments:
        pairs.append(("run by", run.comments[0]))
        pairs += [
            (name, text)
            for name in ("compiler", "engine and build variant")
            for text in heads(f"{name}:", run.comments)
        ]
    else:
        pairs.append(("build variant of this machine", _binding.build_variant()))
    if run.written is not None:
        pairs.append(("result files written", date_in_words(run.written)))
    pairs += [("report by", f"dondolo {_binding.constants().version}"), ("Python", platform.python_version())]
    pairs += [(name, version(name.lower())) for name in ("NumPy", "SciPy", "Matplotlib")]
    return facts(pairs)
