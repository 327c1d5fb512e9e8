"""Weakest hinge of a wall of two blocks: curves for a range of hinge heights under the same records."""

from __future__ import annotations

import threading
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from dondolo._base.arguments import FloatArray, increasing, instance_of
from dondolo._fortran.library import warn
from dondolo._fortran.records import blank_unit
from dondolo._fortran.walls import WALL_PROPERTIES, describe_wall
from dondolo._storage import tables
from dondolo._storage.saved import Saved
from dondolo.analysis.request import Polarity
from dondolo.analysis.solver import Solver
from dondolo.curves.fragility import Fragility
from dondolo.errors import DondoloError, DondoloWarning
from dondolo.populations.study import typology
from dondolo.populations.typology import Typology
from dondolo.records.record import Record
from dondolo.walls.mechanisms import TwoBlockWall, wall_from
from dondolo.walls.population import Population
from dondolo.walls.wall import Wall

if TYPE_CHECKING:
    from matplotlib.axes import Axes

# Heights that are tried / height of the wall
_HEIGHTS = np.round(np.arange(0.40, 0.901, 0.02), 2)


@dataclass(frozen=True, eq=False, repr=False, kw_only=True)
class HingeSearch(tables.Tabular, Saved):
    """Curves of a wall of two blocks for several heights of its hinge.

    Attributes
    ----------
    hinges : ndarray, shape (hinges,)
        Heights of the hinge / height of the wall.
    typology : Typology
        A wall for each of them, under the same records.
    """

    hinges: FloatArray
    typology: Typology

    @property
    def curves(self) -> tuple[Fragility, ...]:
        """Curve for each height."""
        return self.typology.curves

    @property
    def thetas(self) -> FloatArray:
        """Their medians, shape (hinges,); NaN without a curve."""
        return np.array([curve.theta for curve in self.curves])

    @property
    def triggers(self) -> FloatArray:
        """Acceleration at which each begins to rock [g], shape (hinges,)."""
        return np.array([wall.trigger_acceleration / wall.gravity for wall in self.typology.walls])

    @property
    def hinge(self) -> float:
        """The height with the lowest median: the hinge that collapses first under these records."""
        return float(self.hinges[np.nanargmin(self.thetas)])

    @property
    def first_to_rock(self) -> float:
        """The height that begins to rock first: what a static check takes for the weakest."""
        return float(self.hinges[np.argmin(self.triggers)])

    @property
    def wall(self) -> Wall:
        """The wall with the hinge that collapses first."""
        return self.typology.walls[int(np.nanargmin(self.thetas))]

    @property
    def curve(self) -> Fragility:
        """Its curve."""
        return self.curves[int(np.nanargmin(self.thetas))]

    def plot(self, ax: Axes | None = None, **options: Any) -> Axes:
        """Draw medians and trigger accelerations against the height of the hinge.

        Parameters
        ----------
        ax : Axes, optional
            Where to draw; a new figure if left out.
        **options
            Parts to leave out by False (`legend`, `title`, `band`), and keywords of Matplotlib for the medians: see
            docs/printing.md.

        Returns
        -------
        Axes
            Median with its 95 % interval, and below it the trigger acceleration, relative to their lowest values.
        """
        from dondolo.populations.plots_uncertain import draw_hinges

        return draw_hinges(self, ax, options)

    def _table(self) -> tables.Table:
        return {
            "hinge": self.hinges,
            "theta": self.thetas,
            "beta": [curve.beta for curve in self.curves],
            "se_ln_theta": [curve.se_ln_theta for curve in self.curves],
            "trigger_g": self.triggers,
        }

    def _facts(self) -> list[tuple[str, str]]:
        return [
            ("hinge that collapses first", f"{self.hinge:g}"),
            ("theta", f"{np.nanmin(self.thetas):.4g}{blank_unit(self.typology.im)}"),
            ("hinge that rocks first", f"{self.first_to_rock:g}"),
            ("hinges", f"{len(self.hinges)} from {self.hinges[0]:g} to {self.hinges[-1]:g}"),
        ]


def weakest_hinge(
    wall: TwoBlockWall,
    records: Record | Iterable[Record] | Mapping[float, Record | Iterable[Record]],
    levels: ArrayLike,
    *,
    hinges: ArrayLike = _HEIGHTS,
    im: str = "pga",
    polarity: Polarity = "as_recorded",
    solver: Solver | None = None,
    threads: int = 0,
    progress: bool = True,
    stop: threading.Event | None = None,
) -> HingeSearch:
    """Find the height of the hinge at which a wall of two blocks collapses first.

    Where the wall will crack is not known before it has. A static check takes the height with the lowest multiplier;
    here each height has its own curve under the same records, and the lowest median decides.

    Parameters
    ----------
    wall : TwoBlockWall
        The wall; its own hinge is not used.
    records, levels, im, polarity, solver, threads, progress, stop
        As for `typology`.
    hinges : array_like
        Heights of the hinge / height of the wall, increasing; 0.4 to 0.9 in steps of 0.02 if left out.

    Returns
    -------
    HingeSearch

    Raises
    ------
    InputError
        A height that the wall cannot have, and errors of `typology`.
    DondoloError
        No height has a curve, or one without may be the weakest: the levels do not reach its median.
    Interrupted
        As `typology`.

    Warns
    -----
    DondoloWarning
        Warnings of `typology`; the lowest median is at an end of the heights, beyond which it may fall further.

    Notes
    -----
    Medians are fitted to counts, and those of neighbouring heights differ by less than they are known: what the search
    gives is a range of weak heights rather than one. docs/reading_a_curve.md.

    Examples
    --------
    >>> import dondolo as dd
    >>> records = dd.synthetic_records(magnitude=6.5, distance=10.0, site="shallow", n_records=10)
    >>> wall = dd.TwoBlockWall(3.0, 0.25, restitution_factor=0.87)
    >>> found = dd.weakest_hinge(wall, records, [0.5, 1.0, 1.5, 2.0], hinges=[0.5, 0.6, 0.7, 0.8], progress=False)
    >>> found.hinge in (0.5, 0.6, 0.7, 0.8)
    True
    """
    instance_of("wall", wall, TwoBlockWall)
    heights = increasing("hinges", hinges)
    own = wall._properties()
    walls = (
        wall_from(describe_wall(own | {"hinge": height, "name": f"{wall.name}, hinge at {height:g}"}, wall.gravity))
        for height in heights.tolist()
    )
    found = typology(
        Population(tuple(walls)),
        records,
        levels,
        im=im,
        polarity=polarity,
        solver=solver,
        threads=threads,
        progress=progress,
        stop=stop,
    )
    if not any(curve.has_fit for curve in found.curves):
        raise DondoloError(f"hinges: no height has a curve (status '{found.curves[0].status}'): choose other levels")
    result = HingeSearch(hinges=heights, typology=found)
    for height, curve in zip(heights.tolist(), found.curves, strict=True):
        if not curve.has_fit and curve.bracket[0] < np.nanmin(result.thetas):
            raise DondoloError(
                f"hinge at {height:g}: may be weaker than all others, but has no curve (status '{curve.status}'):"
                " choose other levels"
            )
    warn(_warnings(result))
    return result


def _warnings(result: HingeSearch) -> list[DondoloWarning]:
    """Whether medians still fall at the end where the lowest is, unless a wall can have no hinge beyond."""
    known = np.flatnonzero(np.isfinite(result.thetas))
    (limits,) = (row for row in WALL_PROPERTIES if row.name == "hinge")
    for end, limit, side in ((0, limits.smallest, "lower"), (-1, limits.largest, "higher")):
        height = float(result.hinges[end])
        if len(known) > 1 and height == result.hinge and height != limit:
            sentence = (
                f"the hinge that collapses first is at an end of the range, {height:g}: {side} ones may be weaker"
            )
            return [DondoloWarning(sentence, "hinge_at_end", {"wall": result.wall.name}, {"hinge": height})]
    return []
