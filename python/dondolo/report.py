"""One page that tells a run: figures, tables, inputs, checks and versions, in a file that needs nothing else."""

from __future__ import annotations

import os
import platform
import re
import warnings
from collections.abc import Sequence
from dataclasses import dataclass, field
from datetime import datetime
from importlib.metadata import version
from pathlib import Path
from typing import Any

import numpy as np

from dondolo import _binding, tables
from dondolo import _report_results as shown
from dondolo._page import (
    ROWS,
    Markup,
    details,
    escaped,
    facts,
    joined,
    number,
    page,
    paragraph,
    percent,
    symbol,
    table,
    tag,
    whole,
)
from dondolo._request import new_request
from dondolo.cases import Results
from dondolo.errors import DondoloError, DondoloWarning, InputError
from dondolo.fragility import Fragility
from dondolo.hazard import HazardCurve
from dondolo.motion import Response
from dondolo.records import Record
from dondolo.results import StoredResults
from dondolo.stripes import Stripes
from dondolo.typology import Typology, combine
from dondolo.walls import Population

_GENERATOR = "dondolo report"
# Shares of the limit that make the damage states of a wall where the case names none
_STATES = (0.1, 0.4, 1.0)
_LARGE_SCALE = 10.0


@dataclass
class _Run:
    """All that is known of a run.

    Attributes
    ----------
    results : Typology, Stripes or Response
    population : Population
    title : str
    curve : Fragility or None
        Of stripes.
    thresholds : sequence of float
        Damage states of stripes.
    records : tuple of Record
        Those that are at hand.
    settings : list
        Names of what was asked for, and values.
    comments : tuple of str
        Head of the result files.
    written : datetime or None
        Their date.
    warnings : list of str
    """

    results: Typology | Stripes | Response
    population: Population
    title: str
    curve: Fragility | None = None
    thresholds: Sequence[float] = ()
    records: tuple[Record, ...] = ()
    settings: list[tuple[Any, Any]] = field(default_factory=list)
    comments: tuple[str, ...] = ()
    written: datetime | None = None
    warnings: list[str] = field(default_factory=list)


def report(
    results: StoredResults | Results | Typology | Stripes | Response,
    path: str | os.PathLike[str],
    hazard: HazardCurve | None = None,
    title: str | None = None,
) -> None:
    """Write a report of a run: one HTML file that opens offline, appears whole or not at all, and prints on A4.

    Parameters
    ----------
    results : StoredResults, Results, Typology, Stripes or Response
        What `read_results`, `run_case`, `typology`, `multiple_stripe` or `simulate` gave. Files know most of a run.
    path : path
        The file; its folder must exist. An earlier report is replaced, any other file is not.
    hazard : HazardCurve, optional
        Of the site: adds the annual frequency of collapse with its bounds and deaggregation.
    title : str, optional
        Title of the page; that of the case if left out.

    Raises
    ------
    InputError
        Nothing that a report can be made of; a hazard curve of another intensity measure; a file that is no report.
    DondoloError
        The file cannot be written; with a hazard curve, there is no fragility curve.

    Notes
    -----
    What the run and the fits warn of stands in the report, and is not given as a warning again.

    Examples
    --------
    >>> dd.report(dd.read_results("out/historic_centre"), "report.html")  # doctest: +SKIP
    """
    import matplotlib.pyplot as plt

    _check_target(Path(path))
    run = _run_of(results)
    if title is not None:
        run.title = title
    if hazard is not None and not isinstance(hazard, HazardCurve):
        raise InputError(f"hazard: {type(hazard).__name__} is no hazard curve")
    if hazard is not None and isinstance(run.results, Response):
        raise InputError("hazard: must be left out for a single motion, which has no fragility")
    with plt.ioff():
        text = _text(run, hazard)
    tables.write_lines(path, [text.rstrip("\n")])


def _check_target(path: Path) -> None:
    """Only a report may be replaced: a slip of the pen must not cost results."""
    try:
        with path.open(encoding="utf-8", errors="replace") as file:
            start = file.read(500)
    except FileNotFoundError:
        return
    except OSError as error:
        raise DondoloError(f"{path}: cannot be written: {error.strerror}") from error
    if _GENERATOR not in start:
        raise InputError(f"{path}: exists, and is no report of dondolo")


# --- What is known of a run


def _run_of(results: Any) -> _Run:
    """Gather what the objects hold."""
    if isinstance(results, StoredResults):
        given = results.typology or results.stripes or results.response
        run = _run_of(given)
        run.comments, run.written = results.comments, results.written
        run.title = _quoted("title", results.comments) or run.title
        run.population = results.population
        run.warnings = _merged(_heads("warning:", results.comments), run.warnings)
        run.thresholds = _thresholds(results) or run.thresholds
        return run
    if isinstance(results, Results):
        case = results.case
        run = _run_of(results.typology or results.stripes or results.response)
        run.title, run.population = case.title or run.title, case.population
        run.records = case.records if case.task != "history" else (case.records[case.record],)
        run.settings = [
            ("task", case.task),
            ("intensity measure", case.im),
            *([("polarity", case.polarity)] if case.task != "history" else []),
            ("levels", ", ".join(f"{level:g}" for level in case.levels) or "–"),
            ("damage states (EDP)", ", ".join(f"{edp:g}" for edp in case.edp_thresholds)),
            ("engine", case.engine),
            ("rtol, atol", f"{case.rtol:g}, {case.atol:g}"),
            ("edp_limit", f"{case.edp_limit:g}"),
        ]
        if case.task == "typology":
            solver = (case.engine, case.rtol, case.atol, case.edp_limit, 1)
            plan = new_request(case.population.walls, case.records, case.levels, case.im, case.polarity, *solver).plan()
            run.warnings = _merged(plan.warnings, run.warnings)
        if case.task == "stripes" and len(case.edp_thresholds) > 1:
            run.thresholds = case.edp_thresholds
        return run
    if isinstance(results, Typology):
        everyone = np.ones(len(results.population), dtype=bool)
        counts = (results.edp_thresholds[-1:], results.exceedances[-1:], results.histories)
        _, found = combine(results.population, results.im, results.levels, *counts, everyone, results.work)
        walls = len(results.combined)
        title = f"Fragility of {walls} walls" if walls > 1 else f"Fragility of {results.walls[0].name}"
        return _Run(results, results.population, title, warnings=found)
    if isinstance(results, Stripes):
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always", DondoloWarning)
            curve = results.fit()
        large = float(np.mean(results.scale > _LARGE_SCALE))
        found = [str(one.message) for one in caught if issubclass(one.category, DondoloWarning)]
        if large:
            many, most = int(np.sum(results.scale > _LARGE_SCALE)), results.scale.max()
            found.insert(
                0, f"scale factors above 10 in {many} of {results.scale.size} histories, the largest {most:.4g}"
            )
        settings = [
            ("engine", results.engine),
            ("rtol, atol", f"{results.rtol:g}, {results.atol:g}"),
            ("edp_limit", f"{results.edp_limit:g}"),
        ]
        thresholds = [share * results.edp_limit for share in _STATES]
        title = f"Fragility of {results.wall.name}"
        return _Run(results, Population((results.wall,)), title, curve, thresholds, settings=settings, warnings=found)
    if isinstance(results, Response):
        title = f"{results.wall.name} in {results.record.name}"
        return _Run(results, Population((results.wall,)), title, records=(results.record,))
    raise InputError(f"results: {type(results).__name__} is nothing that a report can be made of")


def _heads(start: str, comments: Sequence[str]) -> list[str]:
    """What stands in the comments after a word."""
    return [line[len(start) :].strip() for line in comments if line.startswith(start)]


def _quoted(name: str, comments: Sequence[str]) -> str:
    """A text of the case."""
    for line in comments:
        found = re.match(rf"(?:&\w+ +)?{name} = '((?:[^']|'')*)'", line)
        if found:
            return found.group(1).replace("''", "'")
    return ""


def _thresholds(stored: StoredResults) -> list[float]:
    """Damage states that the case of a wall names, if there are several."""
    line = next((line for line in stored.comments if line.startswith("edp_thresholds = ")), "")
    values = [float(value) for value in re.findall(r"[0-9][-+0-9.eE]*", line)]
    return values if len(values) > 1 else []


def _merged(first: Sequence[str], second: Sequence[str]) -> list[str]:
    """Sentences of both, once each: of a run, and of the same fits repeated; a run knows more of its scale factors."""
    scales = any(line.startswith("scale factors above") for line in first)
    kept = [line for line in second if not (scales and line.startswith("scale factors above"))]
    return list(dict.fromkeys([*first, *kept]))


# --- The page


def _text(run: _Run, hazard: HazardCurve | None) -> str:
    """The whole page."""
    results = run.results
    chapters: list[tuple[str, str, Markup]] = []
    if isinstance(results, Typology):
        summary = joined(shown.typology_cards(results), shown.typology_sentences(results))
        chapters += shown.typology_chapters(results)
    elif isinstance(results, Stripes):
        assert run.curve is not None
        summary = shown.stripes_cards(results, run.curve)
        chapters += shown.stripes_chapters(results, run.curve, run.thresholds)
    else:
        summary = shown.response_cards(results)
        chapters += shown.response_chapters(results)
    found = list(run.warnings)
    if hazard is not None:
        chapter, short = shown.risk_chapter(results, run.curve, hazard)
        chapters.append(chapter)
        found += short
    im = getattr(results, "im", "pga")
    chapters += [
        ("inputs", "What was run", _inputs(run)),
        ("walls", "Walls" if len(run.population) > 1 else "The wall", _walls(run)),
        ("records", "Records", _records(run)),
        ("checks", "Checks", _checks(run)),
        ("limits", "Limits of the models", _limits(results)),
        ("symbols", "Symbols and terms", shown.symbols(im)),
        ("software", "Software", _software(run)),
    ]
    head = joined(
        paragraph("Rocking masonry walls in earthquakes", class_="kicker"),
        tag("h1", run.title),
        paragraph(_lead(run), class_="lead"),
    )
    chapters.insert(0, ("summary", "Summary", joined(_warnings(found), summary)))
    made = f"Report made by dondolo {_binding.constants().version} on {_date(datetime.now().astimezone())}."
    foot = paragraph(
        made,
        " The page holds all it needs: it can be kept, sent and printed. Results are those of models with the limits"
        " said above; to judge whether they apply is the reader's task.",
    )
    return page(run.title, f"{_GENERATOR} {_binding.constants().version}", head, chapters, foot)


def _date(moment: datetime) -> str:
    """A date in words."""
    return f"{moment.day} {moment:%B %Y, %H:%M %Z}".strip()


def _lead(run: _Run) -> str:
    """What this is, in a line."""
    results = run.results
    parts = []
    if isinstance(results, Typology):
        rows, walls = len(results.walls), len(results.combined)
        parts.append(f"{walls} walls" + (f" with {rows} mechanisms" if rows > walls else ""))
    else:
        parts.append(f"{results.wall.name}: {shown.mechanism_name(results.wall.mechanism)}")
    if isinstance(results, Response):
        parts.append(f"one motion under {results.record.name}, scale {results.scale:.4g}")
    else:
        unit = _binding.unit_of(results.im)
        number_of = len(results.levels)
        between = f"{results.levels[0]:g} to {results.levels[-1]:g} {unit}".strip()
        parts.append(f"{number_of} level{'s' if number_of > 1 else ''} of {results.im}, {between}")
        parts.append(f"{whole(results.work.histories)} histories")
    if run.written is not None:
        parts.append(f"run of {_date(run.written)}")
    return "; ".join(parts) + "."


def _warnings(found: Sequence[str]) -> Markup:
    """What the run warned of, prominently."""
    if not found:
        return tag("aside", tag("h2", "No warnings"), class_="warnings fine")
    word = "Warning" if len(found) == 1 else f"{len(found)} warnings"
    return tag("aside", tag("h2", word), tag("ul", *(tag("li", line) for line in found)), class_="warnings")


def _inputs(run: _Run) -> Markup:
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


def _levels(run: _Run) -> list[tuple[str, str]]:
    """The levels of results that come without a case."""
    if (run.settings and run.settings[0][0] == "task") or isinstance(run.results, Response):
        return []
    return [(f"levels of {run.results.im}", ", ".join(f"{level:g}" for level in run.results.levels))]


def _walls(run: _Run) -> Markup:
    """The walls with their statics, and their curves."""
    people = run.population
    walls = people.walls
    if len(walls) == 1:
        wall = walls[0]
        names = {
            "height": "m", "thickness": "m", "density": "kg/m3", "hinge": "of the height", "overburden": "N/m",
            "eccentricity": "m", "restitution": "model", "restitution_value": "", "restitution_factor": "",
        }  # fmt: skip
        given = [(name.replace("_", " "), getattr(wall, name, None), unit) for name, unit in names.items()]
        pairs = [
            ("name", escaped(wall.name)),
            ("mechanism", escaped(shown.mechanism_name(wall.mechanism))),
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
        return facts(pairs)
    columns: dict[Any, Any] = {"wall": [wall.name for wall in walls]}
    if any(people.groups):
        columns["group"] = list(people.groups)
    columns |= {
        "mechanism": [shown.mechanism_name(wall.mechanism) for wall in walls],
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
            joined(shown.THETA, f" [{unit}]"): [number(curve.theta) for curve in results.curves],
            shown.BETA: [number(curve.beta) for curve in results.curves],
            "status": [curve.status for curve in results.curves],
        }
    words = ("group", "mechanism", "status")
    content = table("Walls and mechanisms with their statics and curves of collapse.", columns, words)
    shown_rows = f"{min(ROWS, len(walls))} of {len(walls)}" if len(walls) > ROWS else str(len(walls))
    return joined(
        facts([*people._facts(), *people._ranges()]),
        details(f"Table of the walls and mechanisms ({shown_rows} rows)", content),
    )


def _records(run: _Run) -> Markup:
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
            "The results hold counts of histories and not the records: keep the catalogue and its files with this report."
        )
    pairs: list[tuple[Any, Any]] = []
    catalogue, polarity = _quoted("catalogue", run.comments), _quoted("polarity", run.comments)
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


def _checks(run: _Run) -> Markup:
    """What to look at before the numbers are believed."""
    results = run.results
    pieces = []
    if isinstance(results, Typology):
        limit = float(results.edp_thresholds[-1])
        states = {
            shown.state_name(float(edp), limit): shown.quiet(results.at, float(edp)).curves
            for edp in results.edp_thresholds
        }
        pieces.append(shown.status_table(states))
    elif isinstance(results, Stripes):
        states = {
            shown.state_name(float(edp), results.edp_limit): [shown.quiet(results.fit, float(edp))]
            for edp in run.thresholds
        }
        pieces.append(shown.status_table(states))
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


def _scales(run: _Run) -> Markup:
    """Share of the histories whose records are scaled by a lot."""
    if isinstance(run.results, Stripes):
        large = float(np.mean(run.results.scale > _LARGE_SCALE))
        return joined(percent(large), " of the histories, the largest ", number(float(run.results.scale.max())))
    pattern = r"scale factors above 10 in (\d+) of (\d+) histories, the largest ([0-9.eE+-]+)"
    for line in run.warnings:
        found = re.match(pattern, line)
        if found:
            share = int(found.group(1)) / int(found.group(2))
            return joined(percent(share), " of the histories, the largest ", number(float(found.group(3))))
    return Markup("none" if run.comments or run.records else "not known: results in Python do not hold the factors")


def _limits(results: Any) -> Markup:
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
            "The curves hold the variability of the records and of the walls in the table; how well the models and their"
            " parameters describe walls comes on top."
        )
        lines.append(
            "Mechanisms of a wall are taken for independent of each other, given the intensity; in fact the same record"
            " shakes them."
        )
    else:
        lines.append("Nothing here describes how sure the properties of the wall are.")
    return tag("ul", *(tag("li", line) for line in lines))


def _software(run: _Run) -> Markup:
    """Versions of what ran, and of what wrote this page."""
    pairs: list[tuple[Any, Any]] = []
    if run.comments:
        pairs.append(("run by", run.comments[0]))
        pairs += [
            (name, text)
            for name in ("compiler", "engine and build variant")
            for text in _heads(f"{name}:", run.comments)
        ]
    else:
        pairs.append(("build variant of this machine", _binding.build_variant()))
    if run.written is not None:
        pairs.append(("result files written", _date(run.written)))
    pairs += [("report by", f"dondolo {_binding.constants().version}"), ("Python", platform.python_version())]
    pairs += [(name, version(name.lower())) for name in ("NumPy", "SciPy", "Matplotlib")]
    return facts(pairs)
