"""Multiple stripe analysis of walls, at levels that are given or chosen one after the other."""

from __future__ import annotations

import dataclasses
import threading
from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from dondolo._base.arguments import FloatArray, argument_error, as_count, as_flag, instance_of
from dondolo._base.interrupts import Interrupts, as_event, deferred
from dondolo._base.shown import Shown
from dondolo._fortran.library import warn
from dondolo._fortran.records import levels_in_words
from dondolo.analysis.auto_levels import FEWEST, next_level, rounded
from dondolo.analysis.certificate import run_again, warn_of_errors, warned
from dondolo.analysis.histories import matrix, stack
from dondolo.analysis.request import Kept, Outcome, Pace, Plan, Polarity, Request, new_request, progress_bar
from dondolo.analysis.solver import Solver
from dondolo.analysis.stripes import Stripes
from dondolo.errors import InputError, Interrupted
from dondolo.records.record import Record
from dondolo.walls.wall import Wall

# A level of any measure that every record can be scaled to
_TRIAL = 1e-3


class Study(Shown):
    """Records, levels and solver, prepared once for several walls.

    Parameters
    ----------
    records : Record, iterable of Record, RecordSet, or mapping of float to these
        The accelerograms, as for `multiple_stripe`.
    levels : array_like, shape (levels,), optional
        Levels of intensity, as for `multiple_stripe`.
    im, polarity, solver, estimate_error, certify, threads
        As for `multiple_stripe`.

    Attributes
    ----------
    records : tuple of Record
    levels : ndarray, shape (levels,)
    im : str

    Raises
    ------
    InputError
        Input that cannot be run with any wall.

    Notes
    -----
    The results of `run` are those of `multiple_stripe`, to the bit. What all walls have in common stays in the library
    as long as the study does; the motions of walls on buildings do not.

    Examples
    --------
    >>> import dondolo as dd
    >>> records = dd.synthetic_records(magnitude=6.5, distance=10.0, site="shallow", n_records=10)
    >>> study = dd.Study(records, [0.6, 0.8, 1.0])
    >>> [study.run(dd.OneSidedWall(1.5, t), progress=False).fit().status for t in (0.24, 0.26)]
    ['ok', 'ok']
    """

    def __init__(
        self,
        records: Record | Iterable[Record] | Mapping[float, Record | Iterable[Record]],
        levels: ArrayLike | None = None,
        *,
        im: str = "pga",
        polarity: Polarity = "as_recorded",
        solver: Solver | None = None,
        estimate_error: bool = False,
        certify: bool = False,
        threads: int = 0,
    ) -> None:
        estimate_error, self._certify = as_flag("estimate_error", estimate_error), as_flag("certify", certify)
        request = new_request((), records, levels, im, polarity, solver, threads, estimate_error or self._certify)
        self._request = dataclasses.replace(request, kept=Kept())

    @property
    def records(self) -> tuple[Record, ...]:
        """The accelerograms."""
        return self._request.records

    @property
    def levels(self) -> FloatArray:
        """Levels of intensity, shape (levels,)."""
        return self._request.levels

    @property
    def im(self) -> str:
        """Intensity measure."""
        return self._request.im

    def run(self, wall: Wall, *, progress: bool = True, stop: threading.Event | None = None) -> Stripes:
        """Run the records at the levels with a wall.

        Parameters
        ----------
        wall : Wall
            The wall.
        progress : bool
            Show a progress bar in a terminal or notebook.
        stop : threading.Event, optional
            As for `multiple_stripe`.

        Returns
        -------
        Stripes

        Raises
        ------
        InputError, Interrupted
            As `multiple_stripe`.

        Warns
        -----
        DondoloWarning
            As `multiple_stripe`.
        """
        instance_of("wall", wall, Wall)
        as_flag("progress", progress)
        request = dataclasses.replace(self._request, walls=(wall,))
        with deferred(as_event(stop)) as interrupts:
            try:
                plan = request.plan()
            except KeyboardInterrupt:
                raise _stopped(0, len(request.levels), None) from None
            warn(plan.warnings)
            outcome, interrupted = request.run(plan.histories, progress, wall.name)
            if not interrupted:
                whole = _stripes(request, plan, outcome, len(request.levels))
                return _finished(whole, request, self._certify, progress, interrupts)
            complete = int(np.searchsorted(np.cumsum(plan.ran.sum(axis=1)), outcome.done, side="right"))
            partial = _stripes(request, plan, outcome, complete) if complete else None
            raise _stopped(complete, len(request.levels), partial)

    def _settings(self) -> dict[str, dict[str, Any]]:
        """The groups &records, &stripes and &solver of a case of this study, but for catalogue and gravity."""
        request = self._request
        settings = request.settings
        return {
            "records": {
                "polarity": request.polarity,
                "vertical": "none" if all(record.vertical is None for record in self.records) else "recorded",
            },
            "stripes": {"im": self.im, "levels": self.levels.tolist()},
            "solver": {
                "engine": request.engine,
                "rtol": settings.rtol,
                "atol": settings.atol,
                "edp_limit": settings.edp_limit,
                "estimate_error": settings.estimate_error,
                "certify": self._certify,
            },
        }

    def _facts(self) -> list[tuple[str, str]]:
        return [
            ("records", str(len(self.records))),
            ("levels", levels_in_words(self.levels, self.im)),
            ("polarity", self._request.polarity),
        ]


def multiple_stripe(
    wall: Wall,
    records: Record | Iterable[Record] | Mapping[float, Record | Iterable[Record]],
    levels: ArrayLike | None = None,
    *,
    im: str = "pga",
    polarity: Polarity = "as_recorded",
    solver: Solver | None = None,
    estimate_error: bool = False,
    certify: bool = False,
    threads: int = 0,
    progress: bool = True,
    stop: threading.Event | None = None,
) -> Stripes:
    """Run records at levels of intensity: every record at every level, or other records at each level.

    Parameters
    ----------
    wall : Wall
        The wall.
    records : Record, iterable of Record, RecordSet, or mapping of float to these
        The accelerograms. With a mapping of levels to records, or a `RecordSet` with levels, a record runs at its
        levels only, with the factor of the set where it has one.
    levels : array_like, shape (levels,), optional
        Levels of intensity, positive and increasing, in the unit of the measure; may be left out where the records have
        levels. Levels that are equally spaced but for rounding, as from `numpy.linspace`, are those of first, last and
        count of a case, rounded to 14 digits.
    im : str
        Intensity measure: 'pga', 'sa(T)' or 'saavg(T1:T2)' with periods in s [g], 'pgv', 'arias' or 'cav' [m/s],
        'pgd' or 'hi' [m], or of record and wall 'pga/a0' or 'p*pgv/a0', numbers without a unit, where a0 is the wall's
        trigger acceleration and p its frequency parameter.
    polarity : {'as_recorded', 'reversed', 'both'}
        'both' doubles the histories, except for two-sided walls, which are symmetric.
    solver : Solver, optional
        How the motions are integrated.
    estimate_error : bool
        Whether to run every history twice more, to estimate the error of its EDP.
    certify : bool
        Whether to estimate errors and rerun every doubtful history in 33 digits: see `Stripes.certify`.
    threads : int
        Number of threads; 0: all (OMP_NUM_THREADS is honoured). Results do not depend on it.
    progress : bool
        Show a progress bar in a terminal or notebook.
    stop : threading.Event, optional
        Once another thread has set it, the run ends after its block of histories, within about a second.

    Returns
    -------
    Stripes

    Raises
    ------
    InputError
        Input that cannot be run; the message is that of the executable; a record without motion, which no factor brings
        to a level.
    Interrupted
        Ctrl-C or `stop`; its `partial` has the stripes that are complete; while histories are certified all stripes,
        with which `certify` resumes.

    Warns
    -----
    DondoloWarning
        Walls or PGAs that look as if they were given in another unit, scale factors above 10; with estimated errors,
        histories in doubt.

    Notes
    -----
    Section 3.3 of Nale et al.

    A `Study` runs several walls alike, `adaptive_stripes` chooses the levels itself.

    Examples
    --------
    >>> import dondolo as dd
    >>> wall = dd.OneSidedWall(1.5, 0.25, name="parapet")
    >>> records = dd.synthetic_records(6.5, 10.0, "shallow", n_records=10)
    >>> stripes = dd.multiple_stripe(wall, records, [0.6, 0.8, 1.0, 1.2], progress=False)
    >>> stripes.collapses.tolist(), stripes.histories.tolist()
    ([0, 6, 8, 10], [10, 10, 10, 10])
    >>> stripes.fit().status
    'ok'

    Records of their own at each level:

    >>> stripes = dd.multiple_stripe(wall, {0.6: records[:4], 1.0: records[4:]}, progress=False)
    >>> stripes.histories.tolist()
    [4, 6]
    """
    instance_of("wall", wall, Wall)
    study = Study(
        records,
        levels,
        im=im,
        polarity=polarity,
        solver=solver,
        estimate_error=estimate_error,
        certify=certify,
        threads=threads,
    )
    return study.run(wall, progress=progress, stop=stop)


def adaptive_stripes(
    wall: Wall,
    records: Record | Iterable[Record],
    budget: int,
    *,
    im: str = "pga",
    polarity: Polarity = "as_recorded",
    solver: Solver | None = None,
    estimate_error: bool = False,
    certify: bool = False,
    threads: int = 0,
    progress: bool = True,
    stop: threading.Event | None = None,
) -> Stripes:
    """Run records at levels chosen one by one, each where it adds most information on the curve of collapse.

    Parameters
    ----------
    wall : Wall
        The wall.
    records : Record or iterable of Record
        The accelerograms, without levels or factors of their own.
    budget : int
        Largest number of histories to run, enough for at least three stripes of all records. A remainder that does not
        suffice for a stripe is not used.
    im, polarity, solver, estimate_error, certify, threads, progress, stop
        As for `multiple_stripe`.

    Returns
    -------
    Stripes
        Those of `multiple_stripe` at these levels, which have three digits.

    Raises
    ------
    InputError
        Input that cannot be run; records with levels of their own; a budget that is too small.
    Interrupted
        Ctrl-C or `stop`; its `partial` has the stripes that are complete.

    Warns
    -----
    DondoloWarning
        As `multiple_stripe`.

    Notes
    -----
    The first level scales the median record to a PGA of twice the wall's trigger acceleration. While nothing or
    everything collapses, the next level is twice or half the last. Then a level maximises the determinant of the
    information on (ln theta, ln beta): a record counts as one capacity, of which stripes tell between which levels it
    lies (docs/reading_a_curve.md). The same levels result for any number of threads. It ends early where the next level
    would scale a record beyond all measure.

    Examples
    --------
    >>> import dondolo as dd
    >>> records = dd.synthetic_records(magnitude=6.5, distance=10.0, site="shallow", n_records=10)
    >>> stripes = dd.adaptive_stripes(dd.OneSidedWall(1.5, 0.25), records, budget=60, progress=False)
    >>> len(stripes.levels)
    6
    """
    instance_of("wall", wall, Wall)
    estimate_error, certify = as_flag("estimate_error", estimate_error), as_flag("certify", certify)
    as_flag("progress", progress)
    if isinstance(records, Mapping) or getattr(records, "level", None) is not None:
        raise argument_error("not_together", "records", ": have levels of their own, and adaptive_stripes chooses them")
    request = new_request((wall,), records, [1.0], im, polarity, solver, threads, estimate_error or certify)
    with deferred(as_event(stop)) as interrupts:
        return _finished(_adaptive(request, budget, progress, interrupts), request, certify, progress, interrupts)


def _stopped(complete: int, stripes: int, partial: Stripes | None) -> Interrupted:
    """What is left when it was stopped."""
    return Interrupted(f"interrupted: {complete} of {stripes} stripes are complete", partial)


def _adaptive(request: Request, budget: int, progress: bool, interrupts: Interrupts) -> Stripes:
    """Stripes at levels that are chosen one after the other."""
    wall = request.walls[0]

    def at(levels: ArrayLike) -> Request:
        several = np.atleast_1d(np.asarray(levels, dtype=np.float64))
        several.flags.writeable = False
        return dataclasses.replace(request, levels=several)

    trials = [at(level).plan() for level in (_TRIAL, 2.0 * _TRIAL)]
    size = len(trials[0].record)
    budget = as_count("budget", budget, 1)
    if budget < FEWEST * size:
        raise argument_error(
            "out_of_range",
            "budget",
            f" = {budget}: must be at least {FEWEST * size}, {FEWEST} stripes of {size} histories",
        )
    # Scales are powers of the level.
    peaks = np.array([request.records[i].peak_acceleration for i in trials[0].record])
    one, two = (float(np.median(plan.scale[0] * peaks)) for plan in trials)
    level: float | None = rounded(_TRIAL * (2.0 * wall.trigger_acceleration / one) ** (1.0 / np.log2(two / one)))
    parts: list[Stripes] = []
    pace = Pace(request.facts.samples)
    is_stopped = False
    try:
        with progress_bar(budget // size * size, progress, wall.name, "history") as bar:
            while level is not None and len(parts) < budget // size and not interrupts.requested:
                here = at(level)
                try:
                    plan = here.plan()
                    outcome, is_stopped = here.advance(here.totals(plan.histories), pace, bar.update)
                except InputError:
                    if not parts:
                        raise
                    break
                if outcome.done == len(outcome.edp):
                    parts.append(_stripes(here, plan, outcome, 1))
                if is_stopped:
                    break
                so_far = sorted((*part.levels, *part.collapses, *part.histories) for part in parts)
                level = next_level(*np.array(so_far, dtype=np.float64).T)
    except KeyboardInterrupt:
        # Of a handler of the user's, at any moment
        is_stopped = True
    if not parts:
        raise _stopped(0, budget // size, None)
    stripes = stack(parts)
    # Those of all levels together, in place of those of each
    found = at(stripes.levels).plan().warnings
    stripes = warned(stripes, found)
    if is_stopped or interrupts.requested:
        raise _stopped(len(parts), budget // size, stripes)
    warn(found)
    return stripes


def _finished(stripes: Stripes, request: Request, certify: bool, progress: bool, interrupts: Interrupts) -> Stripes:
    """The stripes, certified if they are to be, with the warnings of their errors."""
    if certify:
        stripes = run_again(stripes, request.records, request.threads, progress)
    warn_of_errors(stripes)
    if interrupts.requested:
        raise _stopped(len(stripes.levels), len(stripes.levels), stripes)
    return stripes


def _stripes(request: Request, plan: Plan, outcome: Outcome, complete: int) -> Stripes:
    """The stripes up to a level."""
    levels, ran = request.levels[:complete], plan.ran[:complete]
    settings = request.settings
    scale = plan.scale[:complete]
    count = len(outcome.edp) if complete == len(request.levels) else int(ran.sum())
    if count < ran.size:
        scale = np.where(ran, scale, np.nan)
    facts = request.facts
    names = ("edp", "collapsed", "impacts", "time_of_peak", *(("edp_error",) if settings.estimate_error else ()))
    uplift = None
    if facts.falls is not None:
        uplift = ran & (plan.scale[:complete] * facts.falls[plan.record] >= request.walls[0].gravity)
    stripes = Stripes(
        wall=request.walls[0],
        im=request.im,
        levels=levels,
        scale=scale,
        ran=ran,
        record_names=facts.names * (len(plan.record) // len(facts.names)),
        polarity=plan.polarity,
        engine=request.engine,
        rtol=settings.rtol,
        atol=settings.atol,
        edp_limit=settings.edp_limit,
        runs=outcome.work._of_run(levels, facts.checksums, plan.polarity, outcome.edp),
        uplift=uplift,
        events=facts.events,
        checksums=facts.checksums,
        record_formats=facts.formats,
        warnings=tuple(plan.warnings),
        **{name: matrix(getattr(outcome, name)[:count], ran.shape, ran) for name in names},
    )
    return stripes if stripes.edp_error is None else warned(stripes, plan.warnings)
