"""The executable's job from Python: a case file in, results as objects out."""

from __future__ import annotations

import os
from contextlib import nullcontext
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from dondolo._base.arguments import FloatArray, as_path
from dondolo._base.shown import Shown
from dondolo._fortran import _core
from dondolo._fortran.library import receive, warn_of_notes
from dondolo._fortran.records import levels_in_words, records_end, unpack_records
from dondolo._fortran.walls import unpack_walls, walls_end
from dondolo.analysis.response import Response, simulate
from dondolo.analysis.solver import Solver
from dondolo.analysis.stripe_runs import multiple_stripe
from dondolo.analysis.stripes import States, Stripes
from dondolo.checks.ntc import CodeCheck, check_ntc
from dondolo.curves.fragility import Fragility
from dondolo.errors import silent
from dondolo.exchange.case_checks import complete_checks, kinematic_checks
from dondolo.populations.study import typology
from dondolo.populations.typology import Typology
from dondolo.records.codes import Site
from dondolo.records.record import Record, record_from
from dondolo.retrofit.designs import DesignComparison, compare_designs
from dondolo.walls.mechanisms import wall_from
from dondolo.walls.population import Population


@dataclass(frozen=True, eq=False, repr=False, kw_only=True)
class Case(Shown):
    """A case file, read and checked.

    Attributes
    ----------
    task : str
        'history', 'stripes' or 'typology'.
    title, output : str
        Title, and path prefix of the result files; running a case from Python writes none.
    population : Population
        The walls; one unless the task is 'typology'.
    records : tuple of Record
    im, polarity, engine : str
    levels : ndarray, shape (levels,)
    edp_thresholds : ndarray, shape (thresholds,)
        Damage states, rotation / capacity; the last is edp_limit, collapse.
    states : {'separate', 'ordinal'}
        How their curves are fitted, as `Stripes.fit_damage_states`.
    rtol, atol, edp_limit : float
    estimate_error, certify : bool
    threads : int
    record_index : int
        Which record a time history is of, from 0.
    scale : float
        Factor on it, with the sign of its polarity.
    site : Site or None
        Hazard of a check by NTC 2018.
    confidence, behaviour : float
        Factors of that check.
    designs : bool
        Whether the walls are designs of one wall, each to be compared with the first.
    """

    task: str
    title: str
    output: str
    population: Population
    records: tuple[Record, ...]
    im: str
    polarity: str
    engine: str
    levels: FloatArray
    edp_thresholds: FloatArray
    states: States
    rtol: float
    atol: float
    edp_limit: float
    estimate_error: bool
    certify: bool
    threads: int
    record_index: int
    scale: float
    site: Site | None = None
    confidence: float = 1.35
    behaviour: float = 2.0
    designs: bool = False

    def _facts(self) -> list[tuple[str, str]]:
        facts = [
            ("title", self.title),
            ("task", self.task),
            ("population", repr(self.population)),
            ("records", str(len(self.records))),
        ]
        if self.task != "history":
            facts.append(("levels", levels_in_words(self.levels, self.im)))
        return facts

    def run(self, *, progress: bool = True) -> Results:
        """Run it; see `run_case`.

        Parameters
        ----------
        progress : bool
            Show a progress bar in a terminal or notebook.

        Returns
        -------
        Results
        """
        how = Solver(rtol=self.rtol, atol=self.atol, edp_limit=self.edp_limit, engine=self.engine)  # type: ignore[arg-type]
        if self.task == "history":
            record = self.records[self.record_index]
            response = simulate(self.population[0], record, self.scale, estimate_error=self.estimate_error, solver=how)
            return Results(case=self, response=response)
        ensemble: dict[str, Any] = {
            "im": self.im,
            "polarity": self.polarity,
            "threads": self.threads,
            "progress": progress,
            "solver": how,
        }
        if self.task == "stripes":
            ensemble |= {"estimate_error": self.estimate_error, "certify": self.certify}
            stripes = multiple_stripe(self.population[0], self.records, self.levels, **ensemble)
            curves = [stripes.fit()]
            if self.states == "ordinal":
                curves = [*stripes.fit_damage_states(self.edp_thresholds, states="ordinal")]
            return Results(case=self, stripes=stripes, fragility=curves[-1], check=self._check(how))
        checks = kinematic_checks(
            self.population.walls, self.site, confidence=self.confidence, behaviour=self.behaviour
        )
        compared = None
        if self.designs:
            walls = {wall.name: wall for wall in self.population.walls}
            compared = compare_designs(walls, self.records, self.levels, **ensemble)
            compared = replace(compared, checks=complete_checks(checks))
        ensemble["edp_thresholds"] = self.edp_thresholds
        # What is said of a mean over designs is of nothing, and the rest of it is said.
        with silent() if self.designs else nullcontext():
            found = typology(self.population, self.records, self.levels, **ensemble)
        if self.designs:
            found = found._as_alternatives()
        return Results(case=self, typology=found, designs=compared, checks=checks)

    def _check(self, solver: Solver) -> CodeCheck | None:
        """The check of the wall, its histories by one stripe more."""
        if self.site is None:
            return None
        # The stripes have said what the wall looks like.
        with silent():
            check = check_ntc(self.population[0], self.site, confidence=self.confidence, behaviour=self.behaviour)
        return check.dynamic(self.records, polarity=self.polarity, solver=solver)  # type: ignore[arg-type]


@dataclass(frozen=True, eq=False, repr=False, kw_only=True)
class Results(Shown):
    """Results of a case; what its task does not make is None.

    Attributes
    ----------
    case : Case
    response : Response or None
        Of the task 'history'.
    stripes, fragility : Stripes, Fragility or None
        Of the task 'stripes'.
    typology : Typology or None
        Of the task 'typology'; of designs their curves alone, with nothing over them (`Typology.are_alternatives`).
    check : CodeCheck or None
        Of a case with a group &check.
    designs : DesignComparison or None
        Of a case with ``designs = .true.``.
    checks : tuple of CodeCheck or None
        The kinematic check of each row of a population with a group &check, None where it has none; else empty.
    """

    case: Case
    response: Response | None = None
    stripes: Stripes | None = None
    fragility: Fragility | None = None
    typology: Typology | None = None
    check: CodeCheck | None = None
    designs: DesignComparison | None = None
    checks: tuple[CodeCheck | None, ...] = ()

    def _facts(self) -> list[tuple[str, str]]:
        names = ("response", "stripes", "fragility", "typology", "designs", "check")
        made = [(name, repr(found)) for name in names if (found := getattr(self, name)) is not None]
        return [("case", self.case.title or self.case.output), *made]


def read_case(path: str | os.PathLike[str]) -> Case:
    """Read a case file and all it names, and check everything.

    Parameters
    ----------
    path : path
        A namelist file.

    Returns
    -------
    Case

    Raises
    ------
    InputError
        What is wrong, with the sentence of the executable; of the table of a population everything, a line each.
    """
    parcel = receive(_core.cases.read_case(as_path(path)))
    walls, levels, records, thresholds, threads, record = (int(value) for value in parcel.integers[:6])
    are_designs = bool(parcel.integers[9])
    rtol, atol, edp_limit, second_runs, scale = (float(value) for value in parcel.reals[:5])
    task, title, output, im, polarity, engine, states, soil, topography = parcel.lines[:9]
    counts = parcel.integers[6:9]
    hazard = 5 + levels + thresholds
    places = [hazard + (int(counts.sum()) + 2 if counts.any() else 0), 10, 9]
    check: dict[str, Any] = {}
    if counts.any():
        *values, (confidence, behaviour) = np.split(parcel.reals[hazard : places[0]], np.cumsum(counts))
        site = Site(*(one.tolist() if len(one) > 1 else one[0] for one in values), soil=soil, topography=topography)  # type: ignore[arg-type]
        check = {"site": site, "confidence": float(confidence), "behaviour": float(behaviour)}
    people = [wall_from(data) for data in unpack_walls(parcel, walls, *places)]
    reals, integers, lines = walls_end(parcel, walls, *places)
    weight, p_occ = parcel.reals[reals : reals + 2 * walls].reshape(2, walls)
    groups, facades = parcel.lines[lines : lines + walls], parcel.lines[lines + walls : lines + 2 * walls]
    lines += 2 * walls
    motions = unpack_records(parcel, records, reals + 2 * walls, integers, lines)
    warn_of_notes(parcel.lines[records_end(parcel, records, integers, lines) :])
    return Case(
        task=task,
        title=title,
        output=output,
        population=Population(tuple(people), weight, groups=tuple(groups), p_occ=p_occ, facades=tuple(facades)),
        records=tuple(record_from(data) for data in motions),
        im=im,
        polarity=polarity,
        engine=engine,
        levels=parcel.reals[5 : 5 + levels].copy(),
        edp_thresholds=parcel.reals[5 + levels : 5 + levels + thresholds].copy(),
        states="ordinal" if states == "ordinal" else "separate",
        rtol=rtol,
        atol=atol,
        edp_limit=edp_limit,
        estimate_error=second_runs > 0.0,
        certify=second_runs == 2.0,
        threads=threads,
        record_index=record - 1,
        scale=scale,
        designs=are_designs,
        **check,
    )


def run_case(path: str | os.PathLike[str], *, progress: bool = True) -> Results:
    """Run a case file as the executable does, with the results as objects and no files written.

    Parameters
    ----------
    path : path
        A namelist file; paths in it are relative to it.
    progress : bool
        Show a progress bar in a terminal or notebook.

    Returns
    -------
    Results

    Raises
    ------
    InputError
        The case is wrong.
    Interrupted
        Ctrl-C; its `partial` has what is complete.
    """
    return read_case(path).run(progress=progress)
