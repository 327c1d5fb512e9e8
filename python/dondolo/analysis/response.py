"""Response of one wall to one accelerogram."""

from __future__ import annotations

import os
from collections.abc import Iterable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from dondolo._base.arguments import FloatArray
from dondolo._base.shown import Shown
from dondolo._base.wording import decimal, say
from dondolo._fortran.tables import plain, trace_columns
from dondolo._storage import tables
from dondolo._storage.saved import Saved
from dondolo.analysis.base_forces import base_forces, friction_demand
from dondolo.errors import DondoloError
from dondolo.records.record import Record
from dondolo.walls.ties import TieStates, states_of_ties
from dondolo.walls.wall import Wall, notes_on_supports

if TYPE_CHECKING:
    from matplotlib.animation import FuncAnimation
    from matplotlib.axes import Axes

# What the head of `_history.csv` says of each tie
_TIE = ("plastic_elongation_m", "energy_j_m", "broken", "time_of_yield_s", "time_of_fracture_s")


@dataclass(frozen=True, eq=False, repr=False, kw_only=True)
class Response(Shown, Saved):
    """Result of one time-history analysis.

    Attributes
    ----------
    wall, record : Wall, Record
        What moved, and what moved it.
    scale : float
        Factor on the record, negative if its polarity was reversed.
    initial_rotation, initial_velocity : float
        State of the wall at the start, positive towards side 1 [rad, rad/s].
    edp : float
        Engineering demand parameter: largest rotation / capacity (equation (6) of Nale et al.); edp_limit for a
        collapse.
    collapsed : bool
        Whether the rotation reached `edp_limit`.
    impacts : int
        Impacts located before the end of the record; chains of bounces that are closed at once are not counted.
    time_of_peak : float
        Time of the largest rotation, or of reaching the limit [s].
    time, ground_acceleration, rotation, velocity : ndarray, shape (rows,), or None
        Time history at every sample and before and after every impact, until rest or 10 s past the end of the record
        [s, m/s2, rad, rad/s]; rotation and velocity carry the sign of the side. The acceleration is that of what the
        wall stands on: of the ground, or of its floor where it has a building. None with history=False.
    side : ndarray of int, shape (rows,), or None
        +1 or -1: the side on which the wall is, at rest the last one; always +1 for one-sided walls.
    after_impact : ndarray of bool, shape (rows,), or None
        True in the row just after an impact; the row before it, of the same time, is just before that impact. Impacts
        after the end of the record are marked too, so that there may be more of them than `impacts`.
    edp_error : float or None
        Estimated error of `edp`; None unless asked for. 0 where both runs collapse, which says nothing of how closely.
    tie_times : ndarray, shape (ties, 2), or None
        When each tie first yields and when it breaks [s]; NaN for never. None for walls without ties and with
        history=False.
    uplift : bool
        Whether the ground, scaled, accelerates downwards by g or more at some instant: the wall is without support
        there, which the model does not describe. No collapse.
    """

    wall: Wall
    record: Record
    scale: float
    edp: float
    collapsed: bool
    impacts: int
    time_of_peak: float
    edp_limit: float = 1.0
    time: FloatArray | None = None
    ground_acceleration: FloatArray | None = None
    rotation: FloatArray | None = None
    velocity: FloatArray | None = None
    side: np.ndarray[Any, np.dtype[np.int8]] | None = None
    after_impact: np.ndarray[Any, np.dtype[np.bool_]] | None = None
    edp_error: float | None = None
    tie_times: FloatArray | None = None
    initial_rotation: float = 0.0
    initial_velocity: float = 0.0

    @property
    def _support(self) -> str:
        """What moves the wall: the ground, the floor that it stands on, or what it feels of both its supports."""
        if self.wall.building is None:
            return "ground"
        return "felt" if self.wall.support_share > 0.0 else "floor"

    @property
    def ties(self) -> TieStates:
        """State of the ties after the motion: plastic elongation, energy, whether broken, each of shape (ties,)."""
        return states_of_ties(self.wall, self.edp)

    @property
    def uplift(self) -> bool:
        return bool(abs(self.scale) * self.record.largest_fall >= self.wall.gravity)

    def base_forces(self) -> tuple[FloatArray, FloatArray]:
        """Forces between the base and the ground at the rows of the time history.

        Returns
        -------
        normal, shear : ndarray, shape (rows,)
            Per metre of wall [N/m]: upwards on the wall, and in the direction in which the ground acceleration is
            positive. The model ends where the normal force falls below 0, and needs a coefficient of friction of
            abs(shear) / normal.

        Raises
        ------
        DondoloError
            The response has no time history.
        InputError
            A wall of two blocks, or one that is more than a rectangular block.

        Notes
        -----
        Momentum of the block: M (g + v_g'') + (S q')' and M s u_g'' + (L q')', with S = G/g, S' = -L and L' = S. The
        block slides, if it does, from the first row on that needs more friction than there is, which no equation of
        dondolo describes. When a one-sided wall is at rest its transverse walls take part of the shear force.

        Examples
        --------
        >>> import dondolo as dd
        >>> record = dd.synthetic_records(6.5, 10.0, "shallow", n_records=1)[0]
        >>> response = dd.simulate(dd.OneSidedWall(1.5, 0.25), record, scale=2.0)
        >>> normal, shear = response.base_forces()
        >>> normal.shape == shear.shape == response.time.shape
        True
        """
        return base_forces(self)

    def friction_demand(self) -> float:
        """Largest coefficient of friction that the block needs while it rocks, so that it does not slide.

        Returns
        -------
        float
            Largest abs(shear) / normal of `base_forces` in the rows in which it moves, and at least the tangent of the
            slenderness angle, which it needs where it begins to; 0 if it does not move, infinite where it would lift
            off.

        Raises
        ------
        DondoloError
            The response has no time history.
        InputError
            A wall of two blocks, or one that is more than a rectangular block.

        Notes
        -----
        What an impact needs is left out: there the forces are impulses.
        """
        return friction_demand(self)

    @property
    def peak_rotation(self) -> float:
        """Signed rotation at the peak [rad]; positive without a time history, which has the side."""
        rotation = self.edp * self.wall.capacity_angle
        if self.rotation is None:
            return rotation
        return float(np.copysign(rotation, self.rotation[np.argmax(np.abs(self.rotation))]))

    def plot(self, ax: Iterable[Axes] | None = None, **options: Any) -> Axes:
        """Draw the motion: acceleration of the ground above, or of the floor of a wall with a building, rotation below.

        Impacts are marked.

        Parameters
        ----------
        ax : two Axes, optional
            Where to draw; a new figure if left out.
        **options
            Parts to leave out by False (`legend`, `title`, `points`), and keywords of Matplotlib for the rotation: see
            docs/printing.md.

        Returns
        -------
        Axes
            The first of the figure's: acceleration [g] and rotation / capacity against time [s].

        Raises
        ------
        DondoloError
            The response has no time history.
        """
        from dondolo.analysis.plots_response import draw_history

        return draw_history(self, ax, options)

    def plot_peak(self, ax: Axes | None = None, **options: Any) -> Axes:
        """Draw the wall at the peak of the motion, and dashed at rest: `Wall.plot` at `peak_rotation`.

        Parameters
        ----------
        ax : Axes, optional
            Where to draw; a new figure if left out.
        **options
            Parts to leave out by False (`legend`, `title`), and keywords of Matplotlib for the blocks: see
            docs/printing.md.

        Returns
        -------
        Axes
            Metres, to scale.
        """
        from dondolo.figures import wording
        from dondolo.walls.drawing import draw_wall

        return draw_wall(self.wall, self.peak_rotation, ax, options, wording.decimal(f", EDP = {self.edp:.3g}"))

    def animate(self, *, frames_per_second: float = 25, speed: float = 1.0) -> FuncAnimation:
        """Animate the motion: the wall beside its rotation.

        The film begins 0.5 s before the wall first moves and ends 1 s after it comes to rest, or with the motion. Of a
        wall that does not move it shows the whole record.

        Parameters
        ----------
        frames_per_second : float
            Frames per second of the film, at least 1.
        speed : float
            Seconds of motion per second of film.

        Returns
        -------
        FuncAnimation
            Save it with Matplotlib's writers: ``animation.save("wall.gif", writer="pillow")``, or an MP4 where ffmpeg
            is installed. Keep a reference to it while it is shown.

        Raises
        ------
        DondoloError
            The response has no time history.
        InputError
            A speed that is not positive.

        Examples
        --------
        >>> import dondolo as dd
        >>> record = dd.synthetic_records(6.5, 10.0, "shallow", n_records=1)[0]
        >>> film = dd.simulate(dd.OneSidedWall(1.5, 0.25), record, scale=2.0).animate(frames_per_second=10)
        >>> film.save("motion.gif")  # doctest: +SKIP
        """
        from dondolo.analysis import film

        return film.animate(self, frames_per_second, speed)

    def _motion(self) -> tuple[FloatArray, FloatArray, FloatArray, np.ndarray[Any, np.dtype[np.bool_]]]:
        """Time, acceleration of ground or floor, rotation, and which rows are just after an impact."""
        columns = self.time, self.ground_acceleration, self.rotation, self.after_impact
        if any(column is None for column in columns):
            raise DondoloError("this response has no time history: simulate with history=True")
        return columns  # type: ignore[return-value]

    def _facts(self) -> list[tuple[str, str]]:
        facts = [
            (say("wall"), self.wall.name),
            (say("record"), self.record.name),
            (say("scale"), decimal(f"{self.scale:.6g}")),
            *self._initial_state(),
            ("EDP", decimal(f"{self.edp:.6g}")),
            (say("collapsed"), say("yes") if self.collapsed else say("no")),
            (say("impacts"), str(self.impacts)),
            (say("time of the peak"), decimal(f"{self.time_of_peak:.6g} s")),
        ]
        if self.edp_error is not None:
            both = self.collapsed and self.edp_error == 0.0
            error = say("estimated error of the EDP"), decimal(f"{self.edp_error:.2g}")
            fact = (say("twice more"), say("collapses too")) if both else error
            facts.insert(4, fact)
        for number, (elongation, energy, broken) in enumerate(zip(*self.ties, strict=True), 1):
            end = say("broken") if broken else say("stretched for good") if elongation > 0.0 else say("as it was")
            text = say("{end}, {elongation:.4g} m, {energy:.4g} J/m", end=end, elongation=elongation, energy=energy)
            facts.append((say("tie {number}", number=number), text))
        return [*facts, *notes_on_supports((self.wall,))]

    def _initial_state(self) -> list[tuple[str, str]]:
        if self.initial_rotation == 0.0 and self.initial_velocity == 0.0:
            return []
        state = {"rotation": self.initial_rotation, "velocity": self.initial_velocity}
        return [(say("initial state"), say("{rotation:.6g} rad, {velocity:.6g} rad/s", **state))]

    def _table(self) -> tables.Table:
        time, acceleration, rotation, after_impact = self._motion()
        columns = {
            "time": time,
            "acceleration": acceleration,
            "rotation": rotation,
            "velocity": self.velocity,
            "side": self.side,
            "after_impact": after_impact,
        }
        return plain(trace_columns(columns, self.wall.capacity_angle))

    def to_frame(self) -> Any:
        """The time history as a pandas DataFrame."""
        return tables.frame(self._table())

    def to_csv(self, path: str | os.PathLike[str]) -> None:
        """Write the time history as the executable's ``_history.csv``."""
        comments = [
            f"record: {self.record.name}",
            f"scale: {tables.cell(self.scale)}",
            f"initial_rotation_rad: {tables.cell(self.initial_rotation)}",
            f"initial_velocity_rad_s: {tables.cell(self.initial_velocity)}",
            f"edp: {tables.cell(self.edp)}",
            f"collapsed: {int(self.collapsed)}",
            f"impacts: {self.impacts}",
            f"time_of_peak_s: {tables.cell(self.time_of_peak)}",
        ]
        if self.edp_error is not None:
            comments.append(f"edp_error: {tables.cell(self.edp_error)}")
        if self.tie_times is not None:
            for number, (*state, times) in enumerate(zip(*self.ties, self.tie_times, strict=True), 1):
                values = (*state[:2], int(state[2]), *times)
                said = [f"{name} = {tables.cell(one)}" for name, one in zip(_TIE, values, strict=True) if one == one]
                comments.append(f"tie {number}: {', '.join(said)}")
        tables.write_csv(path, self._table(), comments)
