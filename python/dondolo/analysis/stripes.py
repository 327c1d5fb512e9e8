"""Stripes of one wall: the outcomes of its histories at each level, and the curves fitted to them."""

from __future__ import annotations

import os
import threading
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from numpy.typing import ArrayLike

from dondolo._base.arguments import FloatArray
from dondolo._base.shown import Shown
from dondolo._fortran.tables import plain
from dondolo._storage import tables
from dondolo._storage.saved import Saved
from dondolo.analysis.histories import cut, join
from dondolo.analysis.outcomes import Counts, Outcomes
from dondolo.analysis.stripe_fits import States, exceedance_bounds, fit_damage_states, fit_stripes, state_bounds
from dondolo.analysis.stripe_tables import TableName, comments_of, tables_of, write_stripes
from dondolo.curves.fragility import Fragility
from dondolo.errors import InputError
from dondolo.records.record import Record

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from dondolo.analysis.incremental import Incremental


@dataclass(frozen=True, eq=False, repr=False, kw_only=True)
class Stripes(Outcomes, Shown, Saved):
    """Result of a multiple stripe analysis: the outcome of every record at every level of intensity.

    Stripes of one wall are joined by ``+`` and indexed by level: ``stripes[:5]`` are the five lowest,
    ``stripes[stripes.levels < 1.0]`` those of a mask; a second index selects records. The result has the records that
    run at one of its levels.

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
    runs : dict of str to Work
        Work done and skipped by each of the runs that the stripes come from, also by histories that are no longer among
        them; the keys are checksums of the histories.
    edp_error : ndarray, shape (levels, histories), or None
        Estimated errors of `edp`; None unless asked for.
    status : ndarray of int, shape (levels, histories), or None
        How each history is certified, a `Certified`; None unless asked for. 0 for one that was not run, or that an
        interrupted run left in doubt.
    edp_lowest, edp_highest : ndarray, shape (levels, histories), or None
        EDPs between which the last digit of the input decides, equal but for `Certified.NOT_COMPUTABLE`; None unless
        certified.
    edp_rounded : ndarray, shape (levels, histories), or None
        EDPs with every sample of the records moved within half a unit of its last printed digit; NaN where a record
        does not run or has no printed digits; None unless certified.
    uplift : ndarray of bool, shape (levels, histories), or None
        Whether the ground accelerates downwards by g or more at some instant, as `Response.uplift`; None without
        vertical motion.
    events : tuple of str, length records
        `Record.event` of each record: those of one event depend on each other; '' for a record by itself.
    checksums : tuple of str, length records
        `Record.checksum` of each.
    record_formats : tuple of str, length records
        Format that each was read in, 'synthetic' if dondolo made it, '' if neither is known.
    warnings : tuple of DondoloWarning
        Warnings of `runs`: of the wall, the records, the levels and estimated errors; also of levels and records that
        are no longer among them.

    Examples
    --------
    >>> import dondolo as dd
    >>> records = dd.synthetic_records(6.5, 10.0, "shallow", n_records=10)
    >>> stripes = dd.multiple_stripe(dd.OneSidedWall(1.5, 0.25), records, [0.6, 0.8, 1.0, 1.2], progress=False)
    >>> low, high = stripes[:2], stripes[2:]
    >>> (low + high).collapses.tolist() == stripes.collapses.tolist()
    True
    >>> stripes[:, :5].histories.tolist()
    [5, 5, 5, 5]
    """

    def __post_init__(self) -> None:
        super().__post_init__()
        for name in ("edp", "collapsed", "impacts", "time_of_peak", "scale"):
            if getattr(self, name).shape != self.ran.shape:
                raise InputError(f"{name}: must have the shape of ran, {self.ran.shape}")

    def __getitem__(self, which: Any) -> Stripes:
        """The stripes of some levels, by a slice, numbers or a mask; a second index chooses among the records."""
        return cut(self, which)

    def __iter__(self) -> Iterator[Stripes]:
        """The stripe of each level."""
        return (self[i] for i in range(len(self)))

    def __add__(self, other: Stripes) -> Stripes:
        """The stripes of both, of one wall; records of the same name are the same, and run once at a level."""
        return join(self, other)

    @property
    def theta_bounds(self) -> tuple[float, float]:
        """Theta with every history whose outcome is not computable counted as a collapse, and with none.

        NaN where there is no curve.

        Raises
        ------
        NotKnownError
            Stripes that are not certified.
        """
        ((low, high),) = state_bounds(self, [self.edp_limit], "separate", "theta_bounds")
        return low, high

    def state_bounds(
        self, edp_thresholds: ArrayLike | None = None, *, states: States = "separate"
    ) -> tuple[tuple[float, float], ...]:
        """Bounds of theta of damage states, from the histories that are not computable.

        Parameters
        ----------
        edp_thresholds, states
            As for `fit_damage_states`.

        Returns
        -------
        tuple of (float, float)
            Of each state: theta with every history whose outcome is not computable counted as reaching it, and with
            none; NaN where there is no curve.

        Raises
        ------
        InputError
            Stripes that are not certified, and as `fit_damage_states`.
        """
        return state_bounds(self, edp_thresholds, states)

    def exceedance_bounds(self, edp_threshold: float) -> tuple[Counts, Counts]:
        """Bounds of the number of histories of each stripe that reach a threshold.

        Parameters
        ----------
        edp_threshold : float
            As for `exceedances`.

        Returns
        -------
        fewest, most : ndarray of int, shape (levels,)
            With every history whose outcome is not computable counted as not reaching it, and as reaching it.

        Raises
        ------
        InputError
            Stripes that are not certified, and as `exceedances`.
        """
        return exceedance_bounds(self, edp_threshold)

    def fit(self, edp_threshold: float | None = None, *, events: Sequence[Any] | None = None) -> Fragility:
        """Fit a fragility curve by maximum likelihood, with standard errors that are clustered by record or by event.

        Parameters
        ----------
        edp_threshold : float, optional
            Rotation / capacity that defines a damage state; collapse if left out.
        events : sequence, optional
            A label for each record, such as its recording or its earthquake, in place of `events`: records with the
            same label depend on each other.

        Returns
        -------
        Fragility
            `status` states whether there is a curve.

        Warns
        -----
        DondoloWarning
            There is no curve, or it extrapolates; the message is that of the executable.
        """
        return fit_stripes(self, edp_threshold, events)

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

        Examples
        --------
        >>> import dondolo as dd
        >>> records = dd.synthetic_records(6.5, 10.0, "shallow", n_records=20)
        >>> stripes = dd.multiple_stripe(dd.OneSidedWall(1.5, 0.25), records, [0.4, 0.6, 0.8, 1.0], progress=False)
        >>> heavy, collapse = stripes.fit_damage_states([0.4, 1.0])
        >>> heavy.theta < collapse.theta
        True
        >>> axes = stripes.plot_damage_states(edp_thresholds=[0.4, 1.0])
        """
        return fit_damage_states(self, edp_thresholds, states, events)

    def certify(
        self,
        records: Record | Iterable[Record] | Mapping[float, Record | Iterable[Record]],
        *,
        threads: int = 0,
        progress: bool = True,
        stop: threading.Event | None = None,
    ) -> Stripes:
        """Rerun in 33 digits every history whose estimated error leaves its outcome in doubt.

        Parameters
        ----------
        records : Record, iterable of Record, RecordSet, or mapping of float to these
            The accelerograms that they were run with.
        threads : int
            Number of threads; 0: all (OMP_NUM_THREADS is honoured). Results do not depend on it.
        progress : bool
            Show a progress bar in a terminal or notebook.
        stop : threading.Event, optional
            As for `multiple_stripe`.

        Returns
        -------
        Stripes
            The same with `status`, `edp_lowest`, `edp_highest` and `edp_rounded`. Histories that were run again in 33
            digits have the EDP, the flag, the impacts, the time of the peak and the error of that run.

        Raises
        ------
        InputError
            Stripes without estimated errors, other records, or a build without quadruple precision.
        Interrupted
            Ctrl-C or `stop`; its `partial` has all stripes, with a status of 0 for the doubtful histories that were not
            yet rerun. Its own `certify` resumes there. At most 16 histories in progress are lost.

        Notes
        -----
        Of stripes that an interrupted run left only the histories without a status are run. A history is in doubt if
        twice its estimated error exceeds 1e-6, or may turn the outcome. It is run at a relative tolerance of 1e-12,
        1e-14, 1e-16 and 1e-18 until two neighbours agree to 1e-7, and then with factors on its record one unit in the
        last place smaller and greater (docs/reading_a_curve.md).

        Examples
        --------
        >>> import dondolo as dd
        >>> wall, records = dd.OneSidedWall(1.5, 0.25), dd.synthetic_records(6.5, 10.0, "shallow", n_records=4)
        >>> stripes = dd.multiple_stripe(wall, records, [0.8, 1.0], estimate_error=True, progress=False)
        >>> certified = stripes.certify(records, progress=False)
        >>> bool((certified.status == dd.results.Certified.DOUBLE).all())
        True
        >>> fewest, most = certified.exceedance_bounds(0.5)
        >>> fewest.tolist() == most.tolist()
        True
        >>> len(certified.state_bounds([0.5, 1.0]))
        2
        """
        from dondolo.analysis.certificate import certify

        return certify(self, records, threads=threads, progress=progress, stop=stop)

    def incremental(self) -> Incremental:
        """Read the stripes as an incremental dynamic analysis, record by record.

        Returns
        -------
        Incremental
            Each history (record and polarity) as a curve. Many levels, close to each other and up to the collapse of
            all histories, make a good one.

        Raises
        ------
        InputError
            The levels have records of their own.

        Notes
        -----
        Vamvatsikos and Cornell (2002). The docstring of the module dondolo.analysis.incremental has the formulas.

        Examples
        --------
        >>> import dondolo as dd
        >>> records = dd.synthetic_records(6.5, 10.0, "shallow", n_records=20)
        >>> stripes = dd.multiple_stripe(dd.OneSidedWall(1.5, 0.25), records, [0.4, 0.6, 0.8, 1.0], progress=False)
        >>> found = stripes.incremental()
        >>> found.fit().theta <= stripes.fit().theta
        True
        """
        from dondolo.analysis.incremental import incremental

        return incremental(self)

    def friction_demand(
        self,
        records: Record | Iterable[Record] | Mapping[float, Record | Iterable[Record]],
        *,
        progress: bool = True,
        stop: threading.Event | None = None,
    ) -> FloatArray:
        """Coefficient of friction that each history needs so that the wall does not slide while it rocks.

        Parameters
        ----------
        records : Record, iterable of Record, RecordSet, or mapping of float to these
            The accelerograms that they were run with.
        progress : bool
            Show a progress bar in a terminal or notebook.
        stop : threading.Event, optional
            As for `multiple_stripe`.

        Returns
        -------
        ndarray, shape (levels, histories)
            `Response.friction_demand` of each history: 0 where the wall does not move, infinite where it would lift
            off, NaN where a record does not run.

        Raises
        ------
        InputError
            Other records, or a wall that is more than a rectangular block.
        Interrupted
            `stop`; nothing is kept.

        Notes
        -----
        Stripes keep peaks and no forces: every history in which the wall moves is run again, with its motion. Wall and
        records are those of the stripes, so that the motions are too.

        Examples
        --------
        >>> import dondolo as dd
        >>> records = dd.synthetic_records(magnitude=6.5, distance=10.0, site="shallow", n_records=4)
        >>> stripes = dd.multiple_stripe(dd.OneSidedWall(1.5, 0.25), records, [0.3, 0.9], progress=False)
        >>> demand = stripes.friction_demand(records, progress=False)
        >>> sliding = (demand > 0.6).sum(axis=1)
        >>> sliding.shape
        (2,)
        """
        from dondolo.analysis.sliding import friction_demand

        return friction_demand(self, records, progress=progress, stop=stop)

    def plot(self, ax: Axes | None = None, **options: Any) -> Axes:
        """Draw every history: EDP against intensity, collapses set apart above.

        Figure 4a of Nale et al.

        Parameters
        ----------
        ax : Axes, optional
            Where to draw; a new figure if left out.
        **options
            Parts to leave out by False (`legend`, `title`, `counts`), and keywords of Matplotlib for the points: see
            docs/printing.md.

        Returns
        -------
        Axes
            EDP against the level of intensity.
        """
        from dondolo.analysis.plots_stripes import draw_stripes

        return draw_stripes(self, ax, options)

    def plot_damage_states(
        self,
        ax: Axes | None = None,
        *,
        edp_thresholds: ArrayLike | None = None,
        states: States = "separate",
        **options: Any,
    ) -> Axes:
        """Draw the fitted curve of each damage state, collapse the boldest.

        Parameters
        ----------
        ax : Axes, optional
            Where to draw; a new figure if left out.
        edp_thresholds, states
            As for `fit_damage_states`.
        **options
            Parts to leave out by False (`legend`, `title`, `points`), and keywords of Matplotlib for the curves: see
            docs/printing.md.

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

        return draw_damage_states(self, ax, self.fit_damage_states(edp_thresholds, states=states), options)

    def to_frame(self, table: TableName = "histories") -> Any:
        """One of the tables 'histories', 'stripes' and 'walls' as a pandas DataFrame."""
        return tables.frame(plain(tables.choose(tables_of(self), table)))

    def to_csv(
        self, path: str | os.PathLike[str], table: TableName = "histories", *, spreadsheet_safe: bool = False
    ) -> None:
        """Write one of the tables 'histories', 'stripes' and 'walls' as the executable does.

        With `spreadsheet_safe`, names that a spreadsheet would read as formulas get an apostrophe.
        """
        chosen = plain(tables.choose(tables_of(self), table))
        tables.write_csv(path, chosen, comments_of(self), spreadsheet_safe=spreadsheet_safe)

    def write_results(
        self,
        prefix: str | os.PathLike[str],
        *,
        edp_thresholds: ArrayLike | None = None,
        states: States = "separate",
        spreadsheet_safe: bool = False,
    ) -> None:
        """Write all tables, with the curves of damage states, into files of the names that the executable gives them.

        `read_results` gives these stripes again, to the bit.

        Parameters
        ----------
        prefix : path
            Prefix of the files, such as ``out/parapet`` for ``out/parapet_histories.csv``; folders are made.
        edp_thresholds : array_like, optional
            Damage states [rotation / capacity], increasing; collapse alone if left out.
        states : {'separate', 'ordinal'}
            As for `fit_damage_states`.
        spreadsheet_safe : bool
            Put an apostrophe before names that a spreadsheet would read as formulas; `read_results` removes it.

        Raises
        ------
        InputError
            As `fit_damage_states`; another run is writing them, or a file of the same name is not a result of dondolo.
        DondoloError
            A file cannot be written.

        Warns
        -----
        DondoloWarning
            Earlier results are replaced; reports, workbooks or figures are out of date.
        """
        write_stripes(self, prefix, edp_thresholds, states, spreadsheet_safe)
