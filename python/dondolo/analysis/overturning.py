"""Overturning spectra: the amplitudes of a pulse that overturn a wall, at every frequency of the pulse."""

from __future__ import annotations

import os
import threading
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from enum import IntEnum
from typing import TYPE_CHECKING, Any, Literal, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from dondolo._base.arguments import FloatArray, argument_error, as_array, as_number, instance_of, one_of
from dondolo._base.interrupts import as_event, deferred
from dondolo._base.shown import Shown
from dondolo._fortran import _core
from dondolo._fortran.histories import Settings
from dondolo._fortran.library import Stoppable, as_text, check
from dondolo._storage import tables
from dondolo._storage.saved import Saved, part_of_results
from dondolo.analysis.request import Pace, check_threads, in_blocks, progress_bar
from dondolo.analysis.solver import Solver, as_solver
from dondolo.errors import Interrupted
from dondolo.records.record import Record
from dondolo.records.suite import upload
from dondolo.walls.wall import Wall
from dondolo.walls.wall import upload as upload_walls

if TYPE_CHECKING:
    from matplotlib.axes import Axes

# Rotation / capacity from which a wall counts as overturned
_EDP_LIMIT = 5.0
# A wall that overturns after its impact has had energy for the way over the top before it, and more by 1/e^2: with
# x = e/sqrt(1 - e^2) the fall of a slender block from 5 alpha takes at most (asinh(x) + asinh(4 x))/p: 9/p for 0.999.
_LONGEST_FALL = 10.0


@part_of_results
class State(IntEnum):
    """Outcome of a pulse, in the order in which it usually changes with the amplitude."""

    AT_REST = 0
    SAFE = 1
    SAFE_AFTER_IMPACTS = 2
    OVERTURNED_AFTER_IMPACTS = 3
    OVERTURNED = 4


@part_of_results
class Boundary(NamedTuple):
    """A change of state between two amplitudes of one frequency.

    Attributes
    ----------
    frequency : float
        Of the pulse [Hz].
    lower, upper : float
        Amplitudes that enclose the change [g].
    below, above : State
        States at these two amplitudes.
    """

    frequency: float
    lower: float
    upper: float
    below: State
    above: State


class Window(NamedTuple):
    """Amplitudes of one frequency between two changes of state.

    Attributes
    ----------
    lower, upper : float
        From and to, each the middle of a boundary's bracket or the end of the scan [g].
    state : State
        Outcome of the pulse.
    """

    lower: float
    upper: float
    state: State


_Table = Literal["map", "boundaries"]


@dataclass(frozen=True, eq=False, repr=False, kw_only=True)
class OverturningSpectrum(Shown, Saved):
    """Result of a scan over frequencies and amplitudes of a pulse.

    Attributes
    ----------
    wall : Wall
        The wall.
    pulse : str
        Name of the pulse's records, without the frequency.
    frequencies : ndarray, shape (frequencies,)
        Of the pulse [Hz].
    amplitudes : ndarray, shape (amplitudes,)
        Peak ground accelerations [g].
    state : ndarray of int, shape (amplitudes, frequencies)
        A `State` for every point of the grid.
    edp : ndarray, shape (amplitudes, frequencies)
        Largest rotation / capacity; edp_limit where the wall overturns.
    impacts : ndarray of int, shape (amplitudes, frequencies)
        Impacts while the pulse lasts.
    boundaries : tuple of Boundary
        Changes of state between neighbouring amplitudes, by frequency and amplitude.
    edp_limit, polarity
        How it was computed.
    """

    wall: Wall
    pulse: str
    frequencies: FloatArray
    amplitudes: FloatArray
    state: np.ndarray[Any, np.dtype[np.int8]]
    edp: FloatArray
    impacts: np.ndarray[Any, np.dtype[np.int32]]
    boundaries: tuple[Boundary, ...]
    edp_limit: float
    polarity: str

    @property
    def overturned(self) -> np.ndarray[Any, np.dtype[np.bool_]]:
        """Where the wall overturns, with or without impacts before, shape (amplitudes, frequencies)."""
        return self.state >= State.OVERTURNED_AFTER_IMPACTS

    @property
    def frequency_ratio(self) -> FloatArray:
        """omega_p/p, the frequencies as parts of the wall's frequency parameter."""
        return 2.0 * np.pi * self.frequencies / self.wall.frequency_parameter

    @property
    def amplitude_unit(self) -> float:
        """Trigger acceleration of the wall [g], tan alpha for one block: the unit of `amplitude_ratio`."""
        return self.wall.trigger_acceleration / self.wall.gravity

    @property
    def amplitude_ratio(self) -> FloatArray:
        """a_p/(g tan alpha), the amplitudes as parts of the trigger acceleration."""
        return self.amplitudes / self.amplitude_unit

    def windows(self, place: int) -> list[Window]:
        """All amplitudes of one frequency, cut where the state changes.

        Parameters
        ----------
        place : int
            Its place among the frequencies, from 0.

        Returns
        -------
        list of Window
            From the lowest amplitude to the highest.
        """
        chosen = float(self.frequencies[place])
        states, ends = [State(self.state[0, place])], [float(self.amplitudes[0])]
        for boundary in self.boundaries:
            if boundary.frequency == chosen:
                states.append(boundary.above)
                ends.append(0.5 * (boundary.lower + boundary.upper))
        ends.append(float(self.amplitudes[-1]))
        return [Window(*window) for window in zip(ends, ends[1:], states, strict=False)]

    def plot(self, ax: Axes | None = None, **options: Any) -> Axes:
        """Draw which amplitudes overturn, without and with impacts before, against the frequency of the pulse.

        As Zhang and Makris (2001) draw it. Every frequency of the scan is a column, cut at the amplitudes where the
        state changes.

        Parameters
        ----------
        ax : Axes, optional
            Where to draw; a new figure if left out.
        **options
            Parts to leave out by False (`legend`, `title`), and keywords of Matplotlib for the boundaries: see
            docs/printing.md.

        Returns
        -------
        Axes
            a_p/(g tan alpha), the amplitude as a part of the trigger acceleration, against omega_p/p.
        """
        from dondolo.analysis.plots_overturning import draw_spectrum

        return draw_spectrum(self, ax, options)

    def _tables(self) -> dict[_Table, Any]:
        count = len(self.amplitudes)
        return {
            "map": lambda: {
                "frequency_hz": np.repeat(self.frequencies, count),
                "amplitude_g": np.tile(self.amplitudes, len(self.frequencies)),
                "state": [State(int(value)).name.lower() for value in self.state.T.ravel()],
                "edp": self.edp.T.ravel(),
                "impacts": self.impacts.T.ravel(),
            },
            "boundaries": lambda: {
                "frequency_hz": [boundary.frequency for boundary in self.boundaries],
                "lower_g": [boundary.lower for boundary in self.boundaries],
                "upper_g": [boundary.upper for boundary in self.boundaries],
                "below": [boundary.below.name.lower() for boundary in self.boundaries],
                "above": [boundary.above.name.lower() for boundary in self.boundaries],
            },
        }

    def to_frame(self, table: _Table = "map") -> Any:
        """One of the tables 'map' and 'boundaries' as a pandas DataFrame."""
        return tables.frame(tables.choose(self._tables(), table))

    def to_csv(self, path: str | os.PathLike[str], table: _Table = "map") -> None:
        """Write one of the tables 'map' and 'boundaries'."""
        comments = [repr(self.wall), f"pulse: {self.pulse}, {self.polarity}", f"edp_limit = {self.edp_limit!r}"]
        tables.write_csv(path, tables.choose(self._tables(), table), comments)

    def _facts(self) -> list[tuple[str, str]]:
        return [
            ("wall", self.wall.name),
            ("pulse", self.pulse),
            ("frequencies", f"{len(self.frequencies)}, {self.frequencies[0]:g} to {self.frequencies[-1]:g} Hz"),
            ("amplitudes", f"{len(self.amplitudes)}, {self.amplitudes[0]:g} to {self.amplitudes[-1]:g} g"),
            ("overturned", f"{self.overturned.sum()} of {self.state.size}"),
            ("changes of state", str(len(self.boundaries))),
        ]


def overturning_spectrum(
    wall: Wall,
    pulse: Callable[[float, float], Record],
    *,
    frequencies: ArrayLike,
    amplitudes: ArrayLike,
    polarity: Literal["as_recorded", "reversed"] = "as_recorded",
    tolerance: float = 1e-4,
    solver: Solver | None = None,
    threads: int = 0,
    progress: bool = True,
    stop: threading.Event | None = None,
) -> OverturningSpectrum:
    """Scan amplitudes and frequencies of a pulse for those that overturn a wall.

    Parameters
    ----------
    wall : Wall
        The wall.
    pulse : callable
        A record for an amplitude [g] and a frequency [Hz], such as `pulses.ricker` or `pulses.one_sine`; the
        record of amplitude 1 is scaled to the peak ground accelerations of the scan.
    frequencies : array_like, shape (frequencies,)
        Frequencies of the pulse [Hz], positive and increasing.
    amplitudes : array_like, shape (amplitudes,)
        Peak ground accelerations [g], positive and increasing: the scan.
    polarity : {'as_recorded', 'reversed'}
        Which way round a one-sided wall feels the pulse.
    tolerance : float
        Every change of state between two neighbouring amplitudes is bisected until its bracket is shorter than this
        part of the amplitude.
    solver : Solver, optional
        How the motions are integrated, with an edp_limit of 5 if it has none: a block passes its capacity and may come
        back while the pulse lasts, so that 1, which is right for fragility, is too low for an overturning spectrum;
        docs/processing.md shows how limits compare. Squat walls need less than 5, since the limit must lie within the
        geometry.
    threads : int
        Number of threads; 0: all (OMP_NUM_THREADS is honoured). Results do not depend on it.
    progress : bool
        Show progress bars in a terminal or notebook.
    stop : threading.Event, optional
        As for `multiple_stripe`.

    Returns
    -------
    OverturningSpectrum

    Raises
    ------
    InputError
        Input that cannot be run.
    Interrupted
        Ctrl-C or `stop`; its `partial` has the frequencies whose scan is complete, with the brackets that were reached.

    Notes
    -----
    Overturning is not monotone in the amplitude: safe amplitudes lie above some that overturn (Zhang and Makris 2001).
    So the whole range is scanned, and a window narrower than the steps of the scan can be missed. Impacts before
    overturning are counted to the end, also after the pulse; a wall that survives always falls back on its base, and
    its impacts are those while the pulse lasts. docs/processing.md compares with published values.

    Examples
    --------
    >>> import dondolo as dd
    >>> wall = dd.FreeStandingWall(1.5, 0.25, name="pinnacle")
    >>> spectrum = dd.overturning_spectrum(
    ...     wall, dd.pulses.one_sine, frequencies=[1.0, 2.0], amplitudes=[0.2, 1.0, 3.0], progress=False
    ... )
    >>> spectrum.overturned.tolist()  # amplitudes down, frequencies across
    [[False, False], [True, True], [True, True]]
    >>> [window.state.name for window in spectrum.windows(0)]
    ['SAFE_AFTER_IMPACTS', 'OVERTURNED_AFTER_IMPACTS', 'SAFE', 'OVERTURNED']
    >>> round(spectrum.boundaries[0].lower, 4)  # in g, at the first frequency
    0.2034
    """
    instance_of("wall", wall, Wall)
    one_of("polarity", polarity, ("as_recorded", "reversed"))
    frequency, amplitude = _increasing("frequencies", frequencies), _increasing("amplitudes", amplitudes)
    if not callable(pulse):
        raise argument_error(
            "wrong_type",
            "pulse",
            f" = {pulse!r}: must be a function of an amplitude and a frequency, such as dd.pulses.one_sine",
        )
    width = as_number("tolerance", tolerance)
    if not 1e-12 <= width <= 1.0:
        raise argument_error("out_of_range", "tolerance", f" = {width:g}: must lie between 1e-12 and 1")
    how = as_solver(solver)
    settings = how._settings(edp_limit=_EDP_LIMIT)
    runner = _Runner(
        wall,
        tuple(_pulse(pulse, value) for value in frequency),
        -1.0 if polarity == "reversed" else 1.0,
        as_text("engine", how.engine),
        settings,
        check_threads(threads),
        progress,
    )
    with deferred(as_event(stop)) as interrupts:
        spectrum, stopped = _spectrum(runner, frequency, amplitude, width, polarity)
        if stopped or interrupts.requested:
            complete = len(spectrum.frequencies)
            sentence = f"interrupted: the scans of {complete} of {len(frequency)} frequencies are complete"
            raise Interrupted(sentence, spectrum if complete else None)
        return spectrum


def _spectrum(
    runner: _Runner, frequency: FloatArray, amplitude: FloatArray, width: float, polarity: str
) -> tuple[OverturningSpectrum, bool]:
    """The spectrum of the frequencies whose scan is complete, and whether Ctrl-C stopped it."""
    wall = runner.wall
    columns, rows = len(frequency), len(amplitude)
    places = np.repeat(np.arange(columns), rows)
    outcome, stopped = runner.run(places, np.tile(amplitude, columns), f"{wall.name}: scan")
    complete = outcome.done // rows if stopped else columns
    state = outcome.state.reshape(columns, rows)[:complete]
    brackets = [
        _Bracket(i, amplitude[j], amplitude[j + 1], state[i, j], state[i, j + 1])
        for i, j in np.argwhere(state[:, 1:] != state[:, :-1])
    ]
    if not stopped:
        brackets, stopped = _bisect(runner, brackets, width, f"{wall.name}: boundaries")
    flat: tuple[Any, ...] = tuple(outcome[:3])
    states, edp, impacts = (values.reshape(columns, rows)[:complete].T.copy() for values in flat)
    spectrum = OverturningSpectrum(
        wall=wall,
        pulse=runner.pulses[0].name.removesuffix(f" {frequency[0]:g} Hz"),
        frequencies=frequency[:complete].copy(),
        amplitudes=amplitude,
        state=states,
        edp=edp,
        impacts=impacts,
        boundaries=tuple(
            Boundary(float(frequency[b.place]), float(b.lower), float(b.upper), State(b.below), State(b.above))
            for b in sorted(brackets)
        ),
        edp_limit=runner.settings.edp_limit,
        polarity=polarity,
    )
    return spectrum, stopped


class _Bracket(NamedTuple):
    """Two amplitudes of different states at one frequency."""

    place: int
    lower: float
    upper: float
    below: int
    above: int


class _Outcome(NamedTuple):
    """States and responses of some histories."""

    state: np.ndarray[Any, np.dtype[np.int8]]
    edp: FloatArray
    impacts: np.ndarray[Any, np.dtype[np.int32]]
    done: int


class _Runner(NamedTuple):
    """Histories of one wall under pulses, each of its own amplitude."""

    wall: Wall
    pulses: tuple[Record, ...]
    sign: float
    engine: bytes
    settings: Settings
    threads: int
    progress: bool

    def run(self, places: Any, amplitudes: FloatArray, label: str) -> tuple[_Outcome, bool]:
        """Run pulse places[i] with amplitudes[i]; the second result says whether Ctrl-C stopped it."""
        total = len(places)
        edp, impacts = np.zeros(total), np.zeros(total, dtype=np.int32)
        state = np.zeros(total, dtype=np.int8)

        def block(done: int, count: int) -> None:
            here = slice(done, done + count)
            state[here], edp[here], impacts[here] = self._states(places[here], amplitudes[here])

        samples = float(np.mean([len(pulse) for pulse in self.pulses]))
        with progress_bar(total, self.progress, label, "history") as bar:
            done, stopped = in_blocks(total, Pace(samples), block, bar.update)
        return _Outcome(state, edp, impacts, done), stopped

    def _states(self, places: Any, amplitudes: FloatArray) -> tuple[Any, FloatArray, Any]:
        edp, collapsed, impacts, time = self._histories(places, amplitudes)
        hit = impacts > 0
        # Impacts are counted while the pulse lasts only: a wall that falls later may have had one in between.
        ends = np.array([pulse.duration for pulse in self.pulses])
        unsure = collapsed & ~hit & (time > ends[places])
        if unsure.any():
            pulses = list(self.pulses)
            for place in np.unique(places[unsure]):
                wait = (time - ends[places])[unsure & (places == place)].max()
                wait = min(wait, _LONGEST_FALL / self.wall.frequency_parameter)
                pulse = pulses[place]
                still = np.zeros(int(np.ceil(wait / pulse.dt)) + 1)
                pulses[place] = Record(np.concatenate([pulse.acceleration, still]), pulse.dt, pulse.name)
            later = self._replace(pulses=tuple(pulses))
            hit[unsure] = later._histories(places[unsure], amplitudes[unsure])[2] > 0
        state = np.where(hit, State.SAFE_AFTER_IMPACTS, State.SAFE)
        state[edp == 0.0] = State.AT_REST
        state[collapsed] = np.where(hit, State.OVERTURNED_AFTER_IMPACTS, State.OVERTURNED)[collapsed]
        return state, edp, impacts

    def _histories(self, places: Any, amplitudes: FloatArray) -> tuple[FloatArray, Any, Any, FloatArray]:
        scale = (
            self.sign
            * amplitudes
            * self.wall.gravity
            / np.array([pulse.peak_acceleration for pulse in self.pulses])[places]
        )
        people, suite = upload_walls((self.wall,)), upload(self.pulses)
        with Stoppable():
            edp, collapsed, impacts, time, _, failure = _core.histories.run_scaled(
                people.number,
                suite.number,
                (np.asarray(places) + 1).astype(np.int32),
                np.ascontiguousarray(scale),
                self.engine,
                self.threads,
                **self.settings._asdict(),
            )
        check(failure)
        return edp, collapsed == 1, impacts, time


def _bisect(runner: _Runner, brackets: Sequence[_Bracket], tolerance: float, label: str) -> tuple[list[_Bracket], bool]:
    """Halve every bracket until all are short; a third state in a bracket makes two of it."""
    wide, short = list(brackets), []
    while True:
        short += [bracket for bracket in wide if bracket.upper - bracket.lower <= tolerance * bracket.upper]
        wide = [bracket for bracket in wide if bracket.upper - bracket.lower > tolerance * bracket.upper]
        if not wide:
            return short, False
        middle = np.array([0.5 * (bracket.lower + bracket.upper) for bracket in wide])
        outcome, stopped = runner.run(np.array([bracket.place for bracket in wide]), middle, label)
        if stopped:
            return short + wide, True
        halves = []
        for bracket, amplitude, state in zip(wide, middle, outcome.state, strict=True):
            halves.append(bracket._replace(upper=amplitude, above=state))
            halves.append(bracket._replace(lower=amplitude, below=state))
        wide = [half for half in halves if half.below != half.above]


def _pulse(pulse: Callable[[float, float], Record], frequency: float) -> Record:
    """The pulse of amplitude 1 at a frequency."""
    record = pulse(1.0, float(frequency))
    if not isinstance(record, Record):
        raise argument_error("wrong_type", "pulse", f": must return a Record, not {type(record).__name__}")
    if not record.peak_acceleration > 0.0:
        raise argument_error("out_of_range", "pulse", f": is zero at {frequency:g} Hz")
    return record


def _increasing(name: str, values: ArrayLike) -> FloatArray:
    """Positive, increasing numbers."""
    array = as_array(name, values).copy()
    if not np.all((array > 0.0) & (array < np.inf)):
        raise argument_error("out_of_range", name, ": must be positive")
    if not np.all(np.diff(array) > 0.0):
        raise argument_error("not_increasing", name, ": must increase")
    return array
