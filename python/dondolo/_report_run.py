"""What a report knows of a run: gathered from whatever holds its results."""

from __future__ import annotations

import re
import warnings
from collections.abc import Sequence
from dataclasses import dataclass, field
from datetime import datetime
from typing import Any, NamedTuple

import numpy as np

from dondolo.analysis.response import Response
from dondolo.analysis.stripes import Stripes
from dondolo.curves.fragility import Fragility
from dondolo.errors import DondoloWarning, InputError
from dondolo.exchange.cases import Results
from dondolo.exchange.results import StoredResults, heads
from dondolo.populations.typology import Typology
from dondolo.records.record import Record
from dondolo.walls.population import Population

_STATES = (0.1, 0.4, 1.0)


class LargeScales(NamedTuple):
    """Histories whose record is scaled by more than 10.

    Attributes
    ----------
    many : int
    histories : int
        Of these.
    largest : float
        Scale factor.
    """

    many: int
    histories: int
    largest: float

    @classmethod
    def of(cls, stripes: Stripes) -> LargeScales | None:
        """Those of a wall, if there are any."""
        many = int(np.sum(stripes.scale > 10.0))
        return cls(many, stripes.scale.size, float(stripes.scale.max())) if many else None

    @classmethod
    def told(cls, sentences: Sequence[str]) -> LargeScales | None:
        """Those that a run of a population warns of, if it does."""
        for line in sentences:
            if found := re.match(r"scale factors above 10 in (\d+) of (\d+) histories, the largest (\S+)", line):
                return cls(int(found.group(1)), int(found.group(2)), float(found.group(3)))
        return None

    def __str__(self) -> str:
        return f"scale factors above 10 in {self.many} of {self.histories} histories, the largest {self.largest:.4g}"


@dataclass
class Run:
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
    scales : LargeScales or None
        None if there are none.
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
    scales: LargeScales | None = None


def run_of(results: Any) -> Run:
    """Gather what the objects hold."""
    if isinstance(results, StoredResults):
        given = results.typology or results.stripes or results.response
        run = run_of(given)
        run.comments, run.written = results.comments, results.written
        run.title = quoted("title", results.comments) or run.title
        run.population = results.population
        run.warnings = _merged(heads("warning:", results.comments), run.warnings)
        run.thresholds = results.edp_thresholds or run.thresholds
        return run
    if isinstance(results, Results):
        case = results.case
        run = run_of(results.typology or results.stripes or results.response)
        run.title, run.population = case.title or run.title, case.population
        run.records = case.records if case.task != "history" else (case.records[case.record],)
        run.settings = [
            ("task", case.task),
            ("intensity measure", case.im),
            *([("polarity", case.polarity)] if case.task != "history" else []),
            ("levels", ", ".join(f"{level:g}" for level in case.levels) or "none"),
            ("damage states (EDP)", ", ".join(f"{edp:g}" for edp in case.edp_thresholds)),
            ("engine", case.engine),
            ("rtol, atol", f"{case.rtol:g}, {case.atol:g}"),
            ("edp_limit", f"{case.edp_limit:g}"),
        ]
        if case.task == "stripes" and len(case.edp_thresholds) > 1:
            run.thresholds = case.edp_thresholds
        return run
    if isinstance(results, Typology):
        walls = len(results.combined)
        title = f"Fragility of {walls} walls" if walls > 1 else f"Fragility of {results.walls[0].name}"
        found = list(results.warnings)
        return Run(results, results.population, title, warnings=found, scales=LargeScales.told(found))
    if isinstance(results, Stripes):
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always", DondoloWarning)
            curve = results.fit()
        found = [str(one.message) for one in caught if issubclass(one.category, DondoloWarning)]
        scales = LargeScales.of(results)
        if scales:
            found.insert(0, str(scales))
        settings = [
            ("engine", results.engine),
            ("rtol, atol", f"{results.rtol:g}, {results.atol:g}"),
            ("edp_limit", f"{results.edp_limit:g}"),
        ]
        thresholds = [share * results.edp_limit for share in _STATES]
        title = f"Fragility of {results.wall.name}"
        people = Population((results.wall,))
        return Run(results, people, title, curve, thresholds, settings=settings, warnings=found, scales=scales)
    if isinstance(results, Response):
        title = f"{results.wall.name} in {results.record.name}"
        return Run(results, Population((results.wall,)), title, records=(results.record,))
    raise InputError(f"results: {type(results).__name__} is nothing that a report can be made of")


def quoted(name: str, comments: Sequence[str]) -> str:
    """A text of the case."""
    for line in comments:
        found = re.match(rf"(?:&\w+ +)?{name} = '((?:[^']|'')*)'", line)
        if found:
            return found.group(1).replace("''", "'")
    return ""


def _merged(first: Sequence[str], second: Sequence[str]) -> list[str]:
    """Sentences of both, once each: of a run, and of the same fits repeated; a run knows more of its scale factors."""
    scales = any(line.startswith("scale factors above") for line in first)
    kept = [line for line in second if not (scales and line.startswith("scale factors above"))]
    return list(dict.fromkeys([*first, *kept]))
