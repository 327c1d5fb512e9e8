"""Accelerograms, and their processing."""

from __future__ import annotations

import os
from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, Literal

from numpy.typing import ArrayLike

from dondolo._base.arguments import FloatArray, argument_error, as_number, instance_of, one_of, wrong_type
from dondolo._fortran import _core
from dondolo._fortran.buildings import floor_motion
from dondolo._fortran.library import receive, within_name
from dondolo._fortran.records import RecordData
from dondolo._storage.saved import part_of_results
from dondolo.records import processing as process
from dondolo.records.accelerogram import Accelerogram
from dondolo.records.building import Building
from dondolo.records.processing import Baseline
from dondolo.records.rotation import RotD, over_directions, rotated
from dondolo.records.suite import check_components

if TYPE_CHECKING:
    from matplotlib.axes import Axes


@part_of_results
@dataclass(frozen=True, eq=False, repr=False, init=False)
class Record(Accelerogram):
    """An accelerogram: ground acceleration at equal steps of time, linear in between.

    Parameters
    ----------
    acceleration : array_like, shape (samples,)
        Ground acceleration at 0, dt, 2 dt, ... [m/s2]; at least two samples.
    dt : float
        Time step [s].
    name : str, optional
        Name in tables and figures.
    processing : iterable of str, optional
        Processing since the record was read, one sentence per step; the methods that process it add theirs.
    metadata : mapping of str to str, optional
        Metadata of the record.
    vertical : array_like, shape (samples,), optional
        Vertical ground acceleration at the same times, positive upwards [m/s2].

    Attributes
    ----------
    acceleration : ndarray of float64, read-only
        A copy of the argument.
    vertical : ndarray of float64, read-only, or None
        A copy of the argument. A wall is moved by both components; measures are those of the horizontal one.
    processing : tuple of str
        Steps of processing, the first first; () for a record as it was read.
    metadata : mapping of str to str, read-only
        Header of its file, in its order. Keys that mean the same in every format are event, date,
        station, network, component, magnitude, latitude, longitude (of the station), processing, format,
        quantity and units; all others are as the file names them.
    peak_acceleration : float
        Largest ground acceleration [m/s2].

    Raises
    ------
    InputError
        A step that is not positive, a sample that is not an acceleration, too few samples; more or fewer vertical
        samples.

    Examples
    --------
    >>> import numpy as np
    >>> import dondolo as dd
    >>> t = np.arange(0.0, 10.0, 0.01)
    >>> record = dd.Record(3.0 * np.sin(2.0 * np.pi * t), dt=0.01, name="sine")
    >>> round(record.intensity("pga"), 4)  # in g
    0.3058
    >>> record.spectrum([0.1, 0.5, 1.0]).pseudo_acceleration.shape
    (3,)
    """

    def plot(self, ax: Iterable[Axes] | None = None, **options: Any) -> Axes:
        """Draw acceleration and velocity over time.

        Parameters
        ----------
        ax : two Axes, optional
            Where to draw; a new figure if left out.
        **options
            Parts to leave out by False (`legend`, `title`, `band`, `points`), and keywords of Matplotlib for the lines:
            see docs/printing.md.

        Returns
        -------
        Axes
            The first of the figure's: acceleration above, with its peak and, shaded, the time from 5 to 95 % of Arias'
            integral; velocity below.
        """
        from dondolo.records.plots import draw_record

        return draw_record(self, ax, options)

    def with_vertical(self, vertical: Record | None, *, factor: float = 1.0) -> Record:
        """The record with another record as its vertical component, or without one.

        Parameters
        ----------
        vertical : Record or None
            The vertical component, as long as the record; None: none. If its step differs, both are put on a common
            grid, on which they are the same functions of time.
        factor : float
            Factor on it, beside that of the record in analyses; -1 for a component that is positive downwards.

        Returns
        -------
        Record

        Raises
        ------
        InputError
            Another length; steps whose ratio is not one of integers up to 50; stations, dates or events that differ; a
            factor that is not finite.

        Notes
        -----
        docs/ground_motions.md, Vertical motion.

        Examples
        --------
        >>> import dondolo as dd
        >>> record = dd.synthetic_records(6.5, 10.0, "shallow", n_records=1)[0]
        >>> both = record.with_vertical(record, factor=0.5)
        >>> bool((both.vertical == 0.5 * record.acceleration).all())
        True
        """
        values, dt, samples, steps = self.acceleration, self.dt, None, self.processing
        if vertical is not None:
            up = _as_record(vertical)
            check_components(self, up)
            joined = receive(
                _core.records.join_vertical(values, dt, up.acceleration, up.dt, as_number("factor", factor))
            )
            values, samples = joined["acceleration"], joined["vertical"]
            if joined["dt"] != dt:
                dt = joined["dt"]
                steps = (*steps, f"samples every {dt:g} s, with those of a vertical component of {up.dt:g} s")
        return Record(values, dt, self.name, processing=steps, metadata=self.metadata, vertical=samples)

    def processed(
        self, acceleration: ArrayLike, step: str, *, dt: float | None = None, vertical: ArrayLike | None = None
    ) -> Record:
        """A record made from this one by a step of processing, one of your own for instance.

        Parameters
        ----------
        acceleration : array_like, shape (samples,)
            The new samples [m/s2].
        step : str
            Description of the step, for `processing`.
        dt : float, optional
            The new time step [s], that of this record if left out.
        vertical : array_like, shape (samples,), optional
            The new samples of the vertical component [m/s2]. If left out, the new record has none.

        Returns
        -------
        Record
            Of the same name and metadata, with the step added to its history of processing.
        """
        steps = (*self.processing, step)
        dt = self.dt if dt is None else dt
        return Record(acceleration, dt, self.name, processing=steps, metadata=self.metadata, vertical=vertical)

    def _filtered(self, filtered: Callable[[Record], tuple[FloatArray, str]]) -> Record:
        """The record made by a step of processing, which its vertical component takes too: both stay in phase."""
        values, step = filtered(self)
        upwards = None if self.vertical is None else filtered(Record(self.vertical, self.dt, self.name))[0]
        return self.processed(values, step, vertical=upwards)

    def correct_baseline(self, kind: Baseline = "constant", *, order: int | None = None) -> Record:
        """Correct the baseline.

        Parameters
        ----------
        kind : {'constant', 'linear', 'velocity'}
            'constant': the mean of the samples; 'linear': their straight line of least squares; 'velocity': a
            polynomial is fitted to the velocity, from 0 at the start, and its derivative is subtracted from the
            acceleration.
        order : int, optional
            Degree of the polynomial of 'velocity', 1 to 8; 2 if left out.

        Returns
        -------
        Record

        Raises
        ------
        InputError
            An unknown kind, or an order with a kind other than 'velocity'.

        Notes
        -----
        The first step of ITACA and ESM is the constant (Paolucci et al. 2011). Of a digital record whose zero has
        shifted, a polynomial of the velocity removes what integrates to a drift (Boore 2001; Chiu 1997 fits a
        straight line).
        """
        return self._filtered(lambda record: process.correct_baseline(record, kind, order))

    def band_pass(
        self,
        low: float | None,
        high: float | None,
        *,
        order: int = 4,
        taper: float = 0.05,
        keep_padding: bool = False,
    ) -> Record:
        """Filter with Butterworth's band-pass, passed forwards and back: no phase is moved.

        Parameters
        ----------
        low, high : float or None
            Corner frequencies [Hz], low < high < Nyquist's frequency 1/(2 dt); None for low: a low-pass, for high: a
            high-pass.
        order : int
            Order of one pass, 1 to 10. Both passes together have the gain 1/(1 + (low/f)^(2 order)) below the band
            (that of one pass squared): one half, not its root, at a corner.
        taper : float
            Part of the record at either end, 0 to 0.5, that half a cosine brings to zero before the filter.
        keep_padding : bool
            Whether to keep the zeros that the filter needs at both ends, with the filtered motion in them.

        Returns
        -------
        Record

        Raises
        ------
        InputError
            Corners out of order, or beyond Nyquist's frequency; an order or a taper out of range; a keep_padding that
            is neither True nor False.

        Notes
        -----
        1.5 order/low seconds of zeros go before and after the record, as long at each end as Converse and Brady (1992)
        ask for both together (Boore 2005, On pads and filters, BSSA 95(2):745-750); without a low corner `high` takes
        its place. Without its padded ends a record's velocity and displacement are not quite those of the filtered
        motion and may drift, which `keep_padding` avoids (Boore 2005). ITACA tapers 2 to 5 % and filters with order 2
        (Paolucci et al. 2011).
        """
        return self._filtered(lambda record: process.band_pass(record, low, high, order, taper, keep_padding))

    def resample(self, dt: float) -> Record:
        """The record with another time step.

        Parameters
        ----------
        dt : float
            New time step [s].

        Returns
        -------
        Record
            Its `processing` states which of the two methods was used.

        Raises
        ------
        InputError
            The ratio of the steps is not one of integers up to 1000, the new one is too long for the record, or there
            would be more than 100 million samples.

        Notes
        -----
        Where the new step divides the old one, new samples lie on the straight lines between the old: the same function
        of time, exactly. Otherwise SciPy's polyphase filter (`scipy.signal.resample_poly`, Kaiser's window with 5.0)
        makes a band-limited signal: frequencies above half the lower of the two sampling rates are taken out, which
        keeps them from coming back as lower ones, and the straight lines between samples are others than before.
        """
        values, step, new = process.resample(self, dt)
        upwards = None
        if self.vertical is not None:
            upwards = process.resample(Record(self.vertical, self.dt, self.name), dt)[0]
        return self.processed(values, step, dt=new, vertical=upwards)

    def trim(self, *, low: float = 0.05, high: float = 0.95, before: float = 1.0, after: float = 1.0) -> Record:
        """Cut to the significant duration.

        Parameters
        ----------
        low, high : float
            Parts of Arias' integral of the squared acceleration at which the significant duration begins and ends.
        before, after : float
            Margins that are kept before and after it [s].

        Returns
        -------
        Record
            Whole samples; the first and the last are not brought to zero.

        Raises
        ------
        InputError
            Parts that do not increase from 0 to 1, a negative margin, a record without motion.

        Notes
        -----
        Significant duration: Trifunac and Brady (1975). Ground acceleration is zero before a record begins and after it
        ends, so that a cut is a jump to zero: look at the margins.
        """
        kept, step = process.trim(self, low, high, before, after)
        upwards = None if self.vertical is None else self.vertical[kept]
        return self.processed(self.acceleration[kept], step, vertical=upwards)

    def on_floor(self, building: Building) -> Record:
        """The motion of a floor of a building under the record.

        Parameters
        ----------
        building : Building
            The building, as the level of the floor sees it.

        Returns
        -------
        Record
            Absolute acceleration of the floor, at refined samples, until the building has come to rest.

        Notes
        -----
        Analyses filter by themselves where a wall stands on a building, and scale by measures of the ground motion;
        a record of a floor has measures of its own. docs/buildings.md.

        Examples
        --------
        >>> import dondolo as dd
        >>> record = dd.synthetic_records(6.5, 10.0, "shallow", n_records=1)[0]
        >>> floor = record.on_floor(dd.Building(0.3, storeys=3, level=9.0, building_height=9.0))
        >>> floor.peak_acceleration > record.peak_acceleration
        True
        """
        instance_of("building", building, Building)
        values, upwards, parts = floor_motion(self.acceleration, self.vertical, self.dt, building._values())
        return self.processed(values, within_name(f"on a floor of {building!r}"), dt=self.dt / parts, vertical=upwards)

    def under(self, wall: Any, *, at: Literal["felt", "base", "top"] = "felt") -> Record:
        """The motion that moves a wall on a building under the record.

        Parameters
        ----------
        wall : Wall
            A wall with a building.
        at : {'felt', 'base', 'top'}
            What the wall feels of both its supports, or the motion of one of them.

        Returns
        -------
        Record
            a_base + k (a_top - a_base) - tau delta, with k and tau of the wall (`Wall.support_share`,
            `Wall.support_tilt`) and delta the relative displacement of top and base; or the absolute acceleration of
            one of them. The same wall without a building has the same histories under it, to the bit.

        Raises
        ------
        InputError
            What is given is not a wall, or is a wall without a building.

        Notes
        -----
        docs/theory.md, section 1. Analyses filter by themselves, and scale by measures of the ground motion.

        Examples
        --------
        >>> import dondolo as dd
        >>> wall = dd.TwoBlockWall(3.0, 0.25, building=dd.Building(0.3, storeys=3, level=6.0, building_height=9.0))
        >>> record = dd.example_records()[0]
        >>> record.under(wall).dt < record.dt
        True
        """
        one_of("at", at, ("felt", "base", "top"))
        felt = getattr(wall, "_felt", lambda *_: None)(self.acceleration, self.vertical, self.dt, at)
        if felt is None:
            raise argument_error("wrong_type", "wall", ": must be a wall with a building")
        values, upwards, parts = felt
        what = "felt by" if at == "felt" else f"at the {at} of"
        return self.processed(values, within_name(f"{what} wall '{wall.name}'"), dt=self.dt / parts, vertical=upwards)

    def reverse(self) -> Record:
        """The record of the other polarity; its vertical component stays as it is.

        Returns
        -------
        Record

        Examples
        --------
        >>> import dondolo as dd
        >>> record = dd.Record([0.0, 1.0, -2.0], dt=0.01)
        >>> record.reverse().acceleration.tolist()
        [-0.0, -1.0, 2.0]
        """
        return self.processed(-self.acceleration, "reversed polarity", vertical=self.vertical)

    def rotate(self, other: Record, angle: float) -> Record:
        """The component of this and another horizontal component in a direction.

        Parameters
        ----------
        other : Record
            The component at right angles, of the same step and number of samples.
        angle : float
            Direction, from this component towards the other [degrees].

        Returns
        -------
        Record
            self cos(angle) + other sin(angle), with the metadata that both share, and with their vertical component if
            both have the same.

        Raises
        ------
        InputError
            Records that do not belong together (steps, lengths, stations, dates or events differ), a vertical
            component, an angle that is not a number.
        """
        return Record(**rotated(self, _as_record(other), angle))

    def rotd(self, other: Record, measure: str | Callable[[Record], float] = "pga", *, n_angles: int = 180) -> RotD:
        """Median and largest value of a measure over all directions of this and another horizontal component.

        Parameters
        ----------
        other : Record
            The component at right angles, of the same step and number of samples.
        measure : str or callable
            Name of an intensity measure, in the unit of `Record.intensity` ('pga' is in g), or a number of a record
            that does not depend on its polarity.
        n_angles : int
            Directions in half a circle: 180 for steps of one degree, as Boore (2010) takes.

        Returns
        -------
        RotD

        Raises
        ------
        InputError
            As for `rotate`; an unknown measure or one that is no number.

        Notes
        -----
        RotD50 and RotD100: Boore (2010), Orientation-independent, nongeometric-mean measures of seismic intensity from
        two horizontal components of motion, BSSA 100(4):1830-1835. The largest peak is missed by up to 1 -
        cos(90/n_angles degrees): 4e-5 of it for 180.
        """
        return over_directions(self, _as_record(other), measure, n_angles)


def record_from(data: RecordData) -> Record:
    """A record as Fortran has read it."""
    record = object.__new__(Record)
    record._hold(data)
    return record


def as_records(records: Record | Iterable[Record]) -> tuple[Record, ...]:
    """One record or several as a tuple of them."""
    if isinstance(records, Record):
        records = (records,)
    if isinstance(records, (str, os.PathLike)):
        raise wrong_type("records", records, "a Record or several", f"read_catalogue reads {os.fspath(records)!r}")
    if not isinstance(records, Iterable):
        hint = "it has them as its attribute records" if hasattr(records, "records") else ""
        raise wrong_type("records", records, "a Record or several", hint)
    several = tuple(records)
    if not several:
        raise argument_error("not_given", "records", ": must be given")
    if set(map(type, several)) != {Record}:
        for record in several:
            instance_of("records", record, Record)
    return several


def _as_record(record: Any) -> Record:
    return instance_of("record", record, Record)
