"""What a report knows of a run: gathered from whatever holds its results."""

from __future__ import annotations

import warnings
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import Any, NamedTuple

from numpy.typing import ArrayLike

from dondolo._base.arguments import argument_error
from dondolo._base.wording import say
from dondolo._fortran.histories import warnings_of_scales
from dondolo._storage.run_file import RunFile
from dondolo.analysis.response import Response
from dondolo.analysis.stripe_fits import States
from dondolo.analysis.stripes import Stripes
from dondolo.checks.ntc import CodeCheck
from dondolo.curves.fragility import Fragility
from dondolo.errors import DondoloWarning
from dondolo.exchange.results import Results
from dondolo.populations.typology import Typology
from dondolo.populations.uncertain_wall import UncertainWall
from dondolo.records.record import Record
from dondolo.reporting.content import Pairs
from dondolo.retrofit.designs import DesignComparison
from dondolo.walls.population import Population

_LARGE_SCALES = "scale_factors_large"


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
    def among(cls, found: Sequence[DondoloWarning]) -> LargeScales | None:
        """Those that a run warns of, if it does."""
        for numbers in (one.numbers for one in found if one.code == _LARGE_SCALES):
            return cls(int(numbers["histories_beyond"]), int(numbers["histories"]), numbers["largest"])
        return None


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
    states : tuple of Fragility
        Curves of the damage states of stripes, collapse last.
    records : tuple of Record
        Those that are at hand.
    settings : list
        Names of what was asked for, and values.
    file : RunFile or None
        What ran, of the results of a case.
    warnings : list of DondoloWarning
    scales : LargeScales or None
        None if there are none.
    check : CodeCheck or None
        Check by a building code.
    how : {'separate', 'ordinal'}
        How the curves of the damage states are fitted.
    uncertain : UncertainWall or None
        What the results, a typology, are of.
    checks : tuple of CodeCheck or None
        Kinematic checks of the walls of a population, None for one that has none; empty if they are not asked for.
    designs : DesignComparison or None
        What the walls of the results, a typology, are.
    """

    results: Typology | Stripes | Response
    population: Population
    title: str
    curve: Fragility | None = None
    states: tuple[Fragility, ...] = ()
    records: tuple[Record, ...] = ()
    settings: Pairs = field(default_factory=list)
    file: RunFile | None = None
    warnings: list[DondoloWarning] = field(default_factory=list)
    scales: LargeScales | None = None
    check: CodeCheck | None = None
    how: States = "separate"
    uncertain: UncertainWall | None = None
    checks: tuple[CodeCheck | None, ...] = ()
    designs: DesignComparison | None = None

    @property
    def facade(self) -> str:
        """Name of the one facade, or wall with several mechanisms, that the results are of; '' for all else."""
        is_one = isinstance(self.results, Typology) and self.results.knows_unions and self.designs is None
        return self.results.facade if is_one else ""  # type: ignore[union-attr]

    @property
    def is_alike(self) -> bool:
        """Are the walls designs of one wall, or the mechanisms of one facade?"""
        return self.designs is not None or bool(self.facade)


def run_of(results: Any) -> Run:
    """Gather what the objects hold."""
    if isinstance(results, Results):
        return _of_results(results)
    if isinstance(results, UncertainWall):
        run = run_of(results.typology)
        run.uncertain, run.title = (
            results,
            say("Fragility of {wall}, its model uncertain", wall=results.typology.walls[results._samples].name),
        )
        return run
    if isinstance(results, Typology):
        walls = len(results.combined)
        title = (
            say("Fragility of {walls} walls", walls=walls)
            if walls > 1
            else say("Fragility of {wall}", wall=results.population.wholes[0])
        )
        found = list(results.warnings)
        return Run(results, results.population, title, warnings=found, scales=LargeScales.among(found))
    if isinstance(results, Stripes):
        return _of_stripes(results)
    if isinstance(results, Response):
        title = say("{wall} in {record}", wall=results.wall.name, record=results.record.name)
        return Run(results, Population((results.wall,)), title, records=(results.record,))
    raise argument_error(
        "wrong_type", "results", f": must be results of an analysis, such as Stripes, not {type(results).__name__}"
    )


def _of_results(results: Results) -> Run:
    """Results of a case: the run knows its warnings, more of the scale factors than a fit repeated."""
    run = run_of(results.typology or results.stripes or results.response)
    run.file, run.population, run.check = results.run, results.population, results.check
    run.uncertain, run.designs, run.checks = results.uncertain, results.designs, results.checks
    run.title = results.run.setting("job", "title", "") or run.title
    if results.case is not None:
        case = results.case
        run.records = case.records if case.task != "history" else (case.records[case.record_index],)
    known = {one.code for one in results.run.warnings} & {_LARGE_SCALES}
    more = [one for one in run.warnings if one.code not in known]
    run.warnings = list(dict.fromkeys([*results.run.warnings, *more]))
    if results.stripes is not None and results.edp_thresholds:
        _set_states(run, results.stripes, results.edp_thresholds, results.states)
    return run


def _set_states(run: Run, stripes: Stripes, edp_thresholds: ArrayLike | None, states: States) -> None:
    """Fit the damage states; what there is to say of their fits stands beside them."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", DondoloWarning)
        run.states = stripes.fit_damage_states(edp_thresholds, states=states)
    run.curve, run.how = run.states[-1], states


def _of_stripes(stripes: Stripes) -> Run:
    """Stripes of a wall, with their curve and what it warns of."""
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always", DondoloWarning)
        stripes.fit()
    found = [one.message for one in caught if isinstance(one.message, DondoloWarning)]
    of_scales = warnings_of_scales(stripes.levels, stripes.scale, stripes.record_names)
    # Of the stripes that there are; those of the run may be of more.
    of_run = [one for one in stripes.warnings if one.code != _LARGE_SCALES]
    found = [*of_run, *of_scales, *found]
    settings: Pairs = [
        (say("engine"), stripes.engine),
        ("rtol, atol", f"{stripes.rtol:g}, {stripes.atol:g}"),
        ("edp_limit", f"{stripes.edp_limit:g}"),
    ]
    run = Run(
        stripes,
        Population((stripes.wall,)),
        say("Fragility of {wall}", wall=stripes.wall.name),
        settings=settings,
        warnings=found,
        scales=LargeScales.among(of_scales),
    )
    _set_states(run, stripes, None, "separate")
    return run
