"""Multiple stripe analysis of one wall."""

from __future__ import annotations

import dataclasses
import os
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal

import numpy as np
from numpy.typing import ArrayLike

from dondolo._base.arguments import FloatArray, as_array, as_count, as_number, instance_of, one_of
from dondolo._base.shown import Shown
from dondolo._fortran.curves import CurveData, warnings_of_curve
from dondolo._fortran.histories import warnings_of_errors
from dondolo._fortran.library import warn
from dondolo._fortran.records import levels_in_words, unit_of
from dondolo._storage import tables
from dondolo._storage.saved import Saved
from dondolo.analysis.auto_levels import FEWEST, next_level, rounded
from dondolo.analysis.request import Outcome, Pace, Plan, Polarity, Request, new_request, polarity_names, progress_bar
from dondolo.analysis.solver import Solver
from dondolo.analysis.stripe_sets import cut, in_matrix, join, span, stack
from dondolo.analysis.work import Work
from dondolo.curves.damage_states import fit_states
from dondolo.curves.fragility import Fragility, fit
from dondolo.curves.sample import Sample, cluster_labels, given_labels
from dondolo.errors import DondoloWarning, InputError, Interrupted
from dondolo.records.record import Record
from dondolo.walls.wall import Wall, upload, walls_table

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_Table = Literal["histories", "stripes", "walls"]

#: Fits of damage states: each on its own, or all with one dispersion
States = Literal["separate", "ordinal"]

# Damage states if none are named, as shares of the collapse limit
_SHARES = (0.1, 0.4, 1.0)

# A level of any measure that every record can be scaled to
_TRIAL = 1e-3


@dataclass(frozen=True, eq=False, repr=False, kw_only=True)
class Stripes(Shown, Saved):
    """Records at levels of intensity, and who collapses.

    Stripes of one wall are joined by ``+``, and cut by indexing: ``stripes[:5]`` are the five lowest,
    ``stripes[stripes.levels < 1.0]`` those of a mask, and a second index chooses among the records. What is left has
    the records that run at one of its levels.

    Attributes
    ----------
    wall : Wall
        The wall.
    im : str
        Intensity measure.
    levels : ndarray, shape (levels,)
        Its levels: accelerations in g, all else in SI units.
    edp : ndarray, shape (levels, histories)
        Largest rotation / capacity; edp_limit for a collapse, NaN where a record does not run.
    collapsed : ndarray of bool, shape (levels, histories)
    impacts : ndarray of int, shape (levels, histories)
    time_of_peak : ndarray, shape (levels, histories)
        [s]; NaN where a record does not run, as in `scale` and `edp_error`.
    scale : ndarray, shape (levels, histories)
        Factor on the record, without the sign of the polarity.
    ran : ndarray of bool, shape (levels, histories)
        Which histories were run: all of them, unless levels have records of their own.
    record_names : tuple of str, length histories
        Record of each history.
    polarity : ndarray of int, shape (histories,)
        +1 as recorded, -1 reversed.
    engine, edp_limit, rtol, atol
        How it was computed.
    work : Work
        What was computed, and what was not, by the runs that the stripes come from.
    edp_error : ndarray, shape (levels, histories), or None
        Estimated errors of `edp`; None unless asked for.
    events : tuple of str, length records
        `Record.event` of each record: those of one event depend on each other; '' for a record by itself.
    checksums : tuple of str, length records
        `Record.checksum` of each.
    """

    wall: Wall
    im: str
    levels: FloatArray
    edp: FloatArray
    collapsed: np.ndarray[Any, np.dtype[np.bool_]]
    impacts: np.ndarray[Any, np.dtype[np.int32]]
    time_of_peak: FloatArray
    scale: FloatArray
    ran: np.ndarray[Any, np.dtype[np.bool_]]
    record_names: tuple[str, ...]
    polarity: np.ndarray[Any, np.dtype[np.int32]]
    engine: str
    rtol: float
    atol: float
    edp_limit: float
    work: Work
    edp_error: FloatArray | None = None
    events: tuple[str, ...] = ()
    checksums: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        super().__post_init__()
        for name in ("edp", "collapsed", "impacts", "time_of_peak", "scale"):
            if getattr(self, name).shape != self.ran.shape:
                raise InputError(f"{name}: must have the shape of ran, {self.ran.shape}")

    def __getitem__(self, which: Any) -> Stripes:
        """The stripes of some levels, by a slice, numbers or a mask; a second index chooses among the records."""
        return cut(self, which)

    def __add__(self, other: Stripes) -> Stripes:
        """The stripes of both, of one wall; records of the same name are the same, and run once at a level."""
        return join(self, other)

    @property
    def n_records(self) -> int:
        """Number of records."""
        return len(self.record_names) // len(np.unique(self.polarity))

    @property
    def record_index(self) -> np.ndarray[Any, np.dtype[np.int64]]:
        """Which record each history belongs to, from 0, shape (histories,); names may repeat, this does not."""
        # All records come in one polarity, and again in the other if there are two.
        return np.arange(len(self.record_names)) % self.n_records

    @property
    def collapses(self) -> np.ndarray[Any, np.dtype[np.int64]]:
        """Collapses in each stripe, shape (levels,)."""
        counts: np.ndarray[Any, np.dtype[np.int64]] = self.collapsed.sum(axis=1)
        return counts

    @property
    def histories(self) -> np.ndarray[Any, np.dtype[np.int64]]:
        """Histories of each stripe, shape (levels,)."""
        counts: np.ndarray[Any, np.dtype[np.int64]] = self.ran.sum(axis=1)
        return counts

    @property
    def fraction(self) -> FloatArray:
        """Fraction of collapses in each stripe, shape (levels,)."""
        return self.collapses / self.histories

    def exceedances(self, edp_threshold: float) -> np.ndarray[Any, np.dtype[np.int64]]:
        """Histories of each stripe that reach a threshold, shape (levels,).

        Parameters
        ----------
        edp_threshold : float
            Rotation / capacity, positive and at most `edp_limit`, where it counts the collapses.

        Returns
        -------
        ndarray of int, shape (levels,)

        Raises
        ------
        InputError
            A threshold beyond that.
        """
        threshold = as_number("edp_threshold", edp_threshold)
        if not 0.0 < threshold <= self.edp_limit:
            raise InputError(
                f"edp_threshold = {threshold:g}: must be positive and at most edp_limit = {self.edp_limit:g}"
            )
        counts: np.ndarray[Any, np.dtype[np.int64]] = (self.edp >= threshold).sum(axis=1)
        return counts

    def fit(self, edp_threshold: float | None = None, *, events: Sequence[Any] | None = None) -> Fragility:
        """Fit a fragility curve by maximum likelihood, with standard errors that are clustered by record or by event.

        Parameters
        ----------
        edp_threshold : float, optional
            Rotation / capacity that makes a damage state; collapse if left out.
        events : sequence, optional
            A label for each record, such as its recording or its earthquake, in place of `events`: records with the
            same label depend on each other.

        Returns
        -------
        Fragility
            Its status says whether there is a curve.

        Warns
        -----
        DondoloWarning
            With the sentence of the executable, where there is no curve or it extrapolates.
        """
        state = self if edp_threshold is None else self._state(edp_threshold)
        curve = fit(
            self.levels,
            state.collapses.astype(np.float64),
            self.histories.astype(np.float64),
            im=self.im,
            wall=self.wall,
            edp_threshold=state.edp_limit,
            sample=state._sample(events),
        )
        self._warn_of(curve, "" if edp_threshold is None else f"damage state {edp_threshold:g} in place of collapse: ")
        return curve

    def fit_damage_states(
        self,
        edp_thresholds: ArrayLike | None = None,
        *,
        states: States = "separate",
        events: Sequence[Any] | None = None,
    ) -> tuple[Fragility, ...]:
        """Fit the curve of each damage state, each on its own or all with one dispersion.

        Parameters
        ----------
        edp_thresholds : array_like, optional
            Rotation / capacity of the states, increasing; 0.1, 0.4 and 1 times `edp_limit` if left out.
        states : {'separate', 'ordinal'}
            'separate': each as `fit` does; their curves may cross. 'ordinal': the cumulative probit model, with one
            beta for all, so that no curve crosses another (McCullagh 1980). States that the same histories reach share
            a curve.
        events : sequence, optional
            As for `fit`.

        Returns
        -------
        tuple of Fragility
            One for each state. 'ordinal': their log likelihood is that of all together, of the numbers of histories
            between one threshold and the next, and `bootstrap` is not for them.

        Raises
        ------
        InputError
            Thresholds that do not increase, are not positive, or above `edp_limit`.

        Warns
        -----
        DondoloWarning
            As `fit`.
        """
        one_of("states", states, ("separate", "ordinal"))
        limits = self._thresholds(edp_thresholds)
        if states == "separate":
            return tuple(self.fit(threshold, events=events) for threshold in limits)
        samples = [self._state(threshold)._sample(events) for threshold in limits]
        curves = fit_states(samples, limits, im=self.im, wall=self.wall)
        for curve in curves:
            self._warn_of(curve, f"damage state {curve.edp_threshold:g} in place of collapse: ")
        return curves

    def _thresholds(self, edp_thresholds: ArrayLike | None) -> list[float]:
        """Thresholds of damage states, checked."""
        if edp_thresholds is None:
            return [share * self.edp_limit for share in _SHARES]
        limits: list[float] = as_array("edp_thresholds", edp_thresholds).tolist()
        if not limits:
            raise InputError("edp_thresholds: must be given")
        for before, threshold in zip([0.0, *limits], limits, strict=False):
            self.exceedances(threshold)
            if not threshold > before:
                raise InputError(f"edp_thresholds = {before:g}, {threshold:g}: must increase strictly")
        return limits

    def _warn_of(self, curve: Fragility, where: str) -> None:
        """Warn of a curve as the executable does."""
        low, high = curve.bracket
        numbers = np.zeros(8)
        numbers[[0, 6, 7]] = curve.theta, low, min(high, np.finfo(np.float64).max)
        data = CurveData(curve.status, numbers)
        sentences = warnings_of_curve(upload((self.wall,)), self.levels, float(np.nanmax(self.edp)), data)
        warn(sentence.placed(where) for sentence in sentences)

    def plot(self, ax: Axes | None = None) -> Axes:
        """Draw every history: EDP against intensity, collapses set apart above.

        Figure 4a of Nale et al.

        Parameters
        ----------
        ax : Axes, optional
            Where to draw; a new figure if left out.

        Returns
        -------
        Axes
            EDP against the level of intensity.
        """
        from dondolo.analysis.plots_stripes import draw_stripes

        return draw_stripes(self, ax)

    def plot_damage_states(
        self, ax: Axes | None = None, *, edp_thresholds: ArrayLike | None = None, states: States = "separate"
    ) -> Axes:
        """Draw the fitted curve of each damage state, collapse the boldest.

        Parameters
        ----------
        ax : Axes, optional
            Where to draw; a new figure if left out.
        edp_thresholds, states
            As for `fit_damage_states`.

        Returns
        -------
        Axes
            Probability to reach each state against intensity.

        Raises
        ------
        InputError
            As `fit_damage_states`.
        """
        from dondolo.analysis.plots_stripes import draw_damage_states

        return draw_damage_states(self, ax, self.fit_damage_states(edp_thresholds, states=states))

    def _state(self, edp_threshold: float) -> Stripes:
        """The stripes as if collapse were a smaller rotation, which the bootstrap of a damage state takes for it."""
        self.exceedances(edp_threshold)
        edp, collapsed = np.minimum(self.edp, edp_threshold), self.edp >= edp_threshold
        return dataclasses.replace(self, edp=edp, collapsed=collapsed, edp_limit=edp_threshold)

    def _sample(self, events: Sequence[Any] | None = None) -> Sample:
        """The histories as a curve keeps them."""
        names = self.record_names[: self.n_records]
        return Sample(
            levels=self.levels,
            collapsed=self.collapsed,
            ran=self.ran,
            record_index=self.record_index,
            record_names=names,
            clusters=cluster_labels(len(names), self.events, self.checksums)
            if events is None
            else given_labels(len(names), events),
        )

    def _tables(self) -> dict[_Table, Any]:
        return {
            "histories": lambda: histories_table(self),
            "stripes": lambda: stripes_table(
                [self.wall],
                self.im,
                self.levels,
                [self.edp_limit],
                self.collapses[None, :, None],
                self.histories[:, None],
            ),
            "walls": lambda: walls_table([self.wall]),
        }

    def to_frame(self, table: _Table = "histories") -> Any:
        """One of the tables 'histories', 'stripes' and 'walls' as a pandas DataFrame."""
        return tables.frame(tables.choose(self._tables(), table))

    def to_csv(
        self, path: str | os.PathLike[str], table: _Table = "histories", *, spreadsheet_safe: bool = False
    ) -> None:
        """Write one of the tables 'histories', 'stripes' and 'walls' as the executable does.

        With `spreadsheet_safe` an apostrophe stands before names that a spreadsheet would take for formulas.
        """
        comments = [
            repr(self.wall),
            f"engine = '{self.engine}', rtol = {self.rtol!r}, atol = {self.atol!r}, edp_limit = {self.edp_limit!r}",
            f"unit of im_level: {unit_of(self.im) or '1'}",
        ]
        tables.write_csv(path, tables.choose(self._tables(), table), comments, spreadsheet_safe=spreadsheet_safe)

    def _facts(self) -> list[tuple[str, str]]:
        return [
            ("wall", self.wall.name),
            ("levels", levels_in_words(self.levels, self.im)),
            ("histories of a stripe", span(self.histories)),
            ("collapses", " ".join(map(str, self.collapses))),
            ("work", str(self.work)),
        ]


def multiple_stripe(
    wall: Wall,
    records: Record | Iterable[Record] | Mapping[float, Record | Iterable[Record]],
    levels: ArrayLike | Literal["auto"] | None = None,
    *,
    budget: int | None = None,
    im: str = "pga",
    polarity: Polarity = "as_recorded",
    solver: Solver | None = None,
    estimate_error: bool = False,
    threads: int = 0,
    progress: bool = True,
) -> Stripes:
    """Run records at levels of intensity: every record at every level, or other records at each level.

    Parameters
    ----------
    wall : Wall
        The wall.
    records : Record, iterable of Record, RecordSet, or mapping of float to these
        The accelerograms. With a mapping of levels to records, or a `RecordSet` with levels, a record runs at its
        levels only, with the factor of the set where it has one.
    levels : array_like, shape (levels,), or 'auto'
        Levels of intensity, positive and increasing, in the unit of the measure; may be left out where the records have
        levels. 'auto': stripe by stripe, each level is chosen where the histories so far leave most to learn of the
        curve of collapse, rounded to three digits, until the budget is spent (see Notes).
    budget : int, optional
        With levels = 'auto': how many histories to run at most, enough for three stripes of all records. What does not
        suffice for a stripe is not spent.
    im : str
        Intensity measure: 'pga', 'sa(T)' or 'saavg(T1:T2)' with periods in s [g], 'pgv', 'arias' or 'cav' [m/s],
        'pgd' or 'hi' [m], or of record and wall 'pga/a0' or 'p*pgv/a0', numbers without a unit, where a0 is the wall's
        trigger acceleration and p its frequency parameter.
    polarity : {'as_recorded', 'reversed', 'both'}
        'both' doubles the histories, except for two-sided walls, which are symmetric.
    solver : Solver, optional
        How the motions are integrated.
    estimate_error : bool
        Run every history a second time with halved steps, to estimate the error of its EDP?
    threads : int
        Number of threads; 0: all (OMP_NUM_THREADS is honoured). Results do not depend on it.
    progress : bool
        Show a progress bar in a terminal or notebook.

    Returns
    -------
    Stripes

    Raises
    ------
    InputError
        What cannot be run, with the sentence of the executable.
    Interrupted
        Ctrl-C; its `partial` has the stripes that are complete.

    Warns
    -----
    DondoloWarning
        Walls or PGAs that look as if they were given in another unit, scale factors above 10, records without motion;
        with estimated errors, histories in doubt.

    Notes
    -----
    Section 3.3 of Nale et al.

    With levels = 'auto' the first level scales the median record to a PGA of twice the wall's trigger acceleration.
    While nothing or everything collapses, the next level is twice or half the last. Then a level maximises the
    determinant of the information on (ln theta, ln beta): a record counts as one capacity, of which stripes tell
    between which levels it lies (docs/uncertainty.md). The same levels result for any number of threads, and the
    stripes are those of a run at these levels.
    It ends early where the next level would scale a record beyond all measure.
    """
    instance_of("wall", wall, Wall, "no wall")
    if isinstance(levels, str):
        one_of("levels", levels, ("auto",))
        if isinstance(records, Mapping) or getattr(records, "level", None) is not None:
            raise InputError("levels = 'auto': the records have levels of their own")
        request = new_request((wall,), records, [1.0], im, polarity, solver, threads, estimate_error)
        return _auto(request, budget, progress)
    if budget is not None:
        raise InputError(f"budget = {budget!r}: only with levels = 'auto'")
    request = new_request((wall,), records, levels, im, polarity, solver, threads, estimate_error)
    try:
        plan = request.plan()
    except KeyboardInterrupt:
        raise Interrupted(f"interrupted: 0 of {len(request.levels)} stripes are complete", None) from None
    warn(plan.warnings)
    outcome, interrupted = request.run(plan.histories, progress, wall.name)
    if not interrupted:
        stripes = _stripes(request, plan, outcome, len(request.levels))
        warn(_warnings(stripes))
        return stripes
    complete = int(np.searchsorted(np.cumsum(plan.ran.sum(axis=1)), outcome.done, side="right"))
    partial = _stripes(request, plan, outcome, complete) if complete else None
    raise Interrupted(f"interrupted: {complete} of {len(request.levels)} stripes are complete", partial)


def _auto(request: Request, budget: int | None, progress: bool) -> Stripes:
    """Stripes at levels that are chosen one after the other."""
    wall = request.walls[0]

    def at(levels: ArrayLike) -> Request:
        several = np.atleast_1d(np.asarray(levels, dtype=np.float64))
        several.flags.writeable = False
        return dataclasses.replace(request, levels=several)

    trials = [at(level).plan() for level in (_TRIAL, 2.0 * _TRIAL)]
    size = len(trials[0].record)
    if budget is None:
        raise InputError("budget: must be given with levels = 'auto'")
    budget = as_count("budget", budget, 1)
    if budget < FEWEST * size:
        raise InputError(f"budget = {budget}: must be at least {FEWEST * size}, {FEWEST} stripes of {size} histories")
    # Scales are powers of the level.
    peaks = np.array([request.records[i].peak_acceleration for i in trials[0].record])
    one, two = (float(np.median(plan.scale[0] * peaks)) for plan in trials)
    level: float | None = rounded(_TRIAL * (2.0 * wall.trigger_acceleration / one) ** (1.0 / np.log2(two / one)))
    parts: list[Stripes] = []
    pace = Pace(request.samples)
    interrupted = False
    with progress_bar(budget // size * size, progress, wall.name, "history") as bar:
        while level is not None and len(parts) < budget // size and not interrupted:
            here = at(level)
            try:
                plan = here.plan()
                outcome, interrupted = here.advance(plan.histories, pace, bar.update)
            except InputError:
                if not parts:
                    raise
                break
            except KeyboardInterrupt:
                interrupted = True
            if not interrupted:
                parts.append(_stripes(here, plan, outcome, 1))
                so_far = stack(parts)
                counts = so_far.collapses.astype(np.float64), so_far.histories.astype(np.float64)
                level = next_level(so_far.levels, *counts)
    if interrupted:
        text = f"interrupted: {len(parts)} of {budget // size} stripes are complete"
        raise Interrupted(text, stack(parts) if parts else None)
    stripes = stack(parts)
    warn(at(stripes.levels).plan().warnings)
    warn(_warnings(stripes))
    return stripes


def _stripes(request: Request, plan: Plan, outcome: Outcome, complete: int) -> Stripes:
    """The stripes up to a level."""
    levels, ran = request.levels[:complete], plan.ran[:complete]
    rtol, atol, edp_limit, estimated, _ = (float(value) for value in request.settings)
    names = ("edp", "collapsed", "impacts", "time_of_peak", *(("edp_error",) if estimated else ()))
    return Stripes(
        wall=request.walls[0],
        im=request.im,
        levels=levels,
        scale=np.where(ran, plan.scale[:complete], np.nan),
        ran=ran,
        record_names=tuple(request.records[i].name for i in plan.record),
        polarity=plan.polarity,
        engine=request.engine,
        rtol=rtol,
        atol=atol,
        edp_limit=edp_limit,
        work=outcome.work,
        events=tuple(record.event for record in request.records),
        checksums=tuple(record.checksum for record in request.records),
        **{name: in_matrix(getattr(outcome, name)[: ran.sum()], ran) for name in names},
    )


def _warnings(stripes: Stripes) -> list[DondoloWarning]:
    """What the executable would warn of, of estimated errors."""
    if stripes.edp_error is None:
        return []
    level, history = np.unravel_index(np.nanargmax(stripes.edp_error), stripes.edp_error.shape)
    return warnings_of_errors(
        stripes.edp[stripes.ran],
        stripes.edp_error[stripes.ran],
        stripes.edp_limit,
        stripes.record_names[history],
        float(stripes.levels[level]),
    )


def histories_table(stripes: Stripes) -> tables.Table:
    """Columns of ``_histories.csv``."""
    ran = stripes.ran
    level, history = np.nonzero(ran)
    signs = polarity_names(stripes.polarity)
    table: tables.Table = {
        "wall": [stripes.wall.name] * len(level),
        "mechanism": [stripes.wall.mechanism] * len(level),
        "record": [stripes.record_names[i] for i in history],
        "polarity": [signs[i] for i in history],
        "im": [stripes.im] * len(level),
        "im_level": stripes.levels[level],
        "scale": stripes.scale[ran],
        "edp": stripes.edp[ran],
        "collapsed": stripes.collapsed[ran].astype(int),
        "impacts": stripes.impacts[ran],
        "time_of_peak_s": stripes.time_of_peak[ran],
    }
    if stripes.edp_error is not None:
        table["edp_error"] = stripes.edp_error[ran]
    return table


def stripes_table(
    walls: Sequence[Wall],
    im: str,
    levels: FloatArray,
    edp_thresholds: ArrayLike,
    exceedances: np.ndarray[Any, Any],
    histories: ArrayLike,
) -> tables.Table:
    """Columns of ``_stripes.csv``; exceedances are (thresholds, levels, walls), histories (levels, walls)."""
    thresholds = np.asarray(edp_thresholds)
    states, number = len(thresholds), len(levels)
    counts = exceedances.transpose(2, 0, 1).ravel()
    sizes = np.repeat(np.asarray(histories).T[:, None, :], states, axis=1).ravel()
    return {
        "wall": [wall.name for wall in walls for _ in range(states * number)],
        "mechanism": [wall.mechanism for wall in walls for _ in range(states * number)],
        "im": [im] * len(counts),
        "im_level": np.tile(levels, states * len(walls)),
        "histories": sizes,
        "collapses": counts,
        "fraction": counts / sizes,
        "edp_threshold": np.tile(np.repeat(thresholds, number), len(walls)),
    }
