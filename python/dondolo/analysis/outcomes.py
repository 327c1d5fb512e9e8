"""Outcomes of the histories of stripes, and their counts at each level."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from dondolo._base.arguments import FloatArray, argument_error, as_number
from dondolo._base.shown import span
from dondolo._fortran.records import levels_in_words
from dondolo._fortran.uncertainty import restitution_sentence
from dondolo.analysis.work import Work
from dondolo.errors import DondoloWarning, NotKnownError
from dondolo.walls.ties import TieCounts, tallies_of_ties
from dondolo.walls.wall import Wall, notes_on_supports, upload

#: Counts of histories
Counts = NDArray[np.int64]


@dataclass(frozen=True, eq=False, repr=False, kw_only=True)
class Outcomes:
    """What became of each history at each level; `Stripes` describes the fields."""

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
    runs: dict[str, Work]
    edp_error: FloatArray | None = None
    status: np.ndarray[Any, np.dtype[np.int32]] | None = None
    edp_lowest: FloatArray | None = None
    edp_highest: FloatArray | None = None
    edp_rounded: FloatArray | None = None
    uplift: np.ndarray[Any, np.dtype[np.bool_]] | None = None
    events: tuple[str, ...] = ()
    checksums: tuple[str, ...] = ()
    record_formats: tuple[str, ...] = ()
    warnings: tuple[DondoloWarning, ...] = ()

    def __len__(self) -> int:
        """Number of levels."""
        return len(self.levels)

    @property
    def work(self) -> Work:
        """Work done and skipped by all of `runs`, each counted once."""
        return Work.total(self.runs.values())

    @property
    def n_records(self) -> int:
        """Number of records."""
        return len(self.record_names) // len(np.unique(self.polarity))

    @property
    def record_index(self) -> Counts:
        """Which record each history belongs to, from 0, shape (histories,); names may repeat, this does not."""
        # All records come in one polarity, and again in the other if there are two.
        return np.arange(len(self.record_names)) % self.n_records

    @property
    def collapses(self) -> Counts:
        """Collapses in each stripe, shape (levels,)."""
        counts: Counts = self.collapsed.sum(axis=1)
        return counts

    @property
    def histories(self) -> Counts:
        """Histories of each stripe, shape (levels,)."""
        counts: Counts = self.ran.sum(axis=1)
        return counts

    @property
    def fraction(self) -> FloatArray:
        """Fraction of collapses in each stripe, shape (levels,)."""
        return self.collapses / self.histories

    @property
    def uplifts(self) -> Counts | None:
        """Histories of each stripe with `uplift`, shape (levels,); None without vertical motion."""
        if self.uplift is None:
            return None
        counts: Counts = self.uplift.sum(axis=1)
        return counts

    @property
    def ties(self) -> TieCounts:
        """Effect of the histories of each stripe on the ties of the wall."""
        return tallies_of_ties(self.wall, self.edp, self.ran)

    @property
    def broken_ties(self) -> FloatArray:
        """Share of the histories of each stripe that break each tie, shape (levels, ties)."""
        return self.ties.broken / self.histories[:, None]

    def exceedances(self, edp_threshold: float) -> Counts:
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

        Examples
        --------
        >>> import dondolo as dd
        >>> records = dd.synthetic_records(6.5, 10.0, "shallow", n_records=10)
        >>> stripes = dd.multiple_stripe(dd.OneSidedWall(1.5, 0.25), records, [0.6, 0.8, 1.0], progress=False)
        >>> bool((stripes.exceedances(0.4) >= stripes.collapses).all())
        True
        """
        threshold = as_number("edp_threshold", edp_threshold)
        if not 0.0 < threshold <= self.edp_limit:
            raise argument_error(
                "out_of_range",
                "edp_threshold",
                f" = {threshold:g}: must be positive and at most edp_limit = {self.edp_limit:g}",
            )
        counts: Counts = (self.edp >= threshold).sum(axis=1)
        return counts

    def rounding_changes(self, edp_threshold: float | None = None) -> tuple[int, int]:
        """Number of outcomes that hang on the rounding of the printed digits of the records.

        Parameters
        ----------
        edp_threshold : float, optional
            Rotation / capacity of a damage state, as for `exceedances`; collapse if left out.

        Returns
        -------
        changed, known : int
            Histories that reach the threshold under the record as it is or with its samples moved within half a unit of
            their last printed digit, but not under both; and the histories of records whose printed digits are known.

        Raises
        ------
        NotKnownError
            Stripes that are not certified.
        InputError
            As `exceedances`.

        Examples
        --------
        >>> import dondolo as dd
        >>> records = dd.example_records()[:4]
        >>> wall = dd.OneSidedWall(3.0, 0.25)
        >>> stripes = dd.multiple_stripe(wall, records, [0.5, 0.7], certify=True, progress=False)
        >>> stripes.rounding_changes()
        (0, 8)
        """
        if self.edp_rounded is None:
            raise NotKnownError("rounding_changes: only of certified stripes")
        threshold = self.edp_limit if edp_threshold is None else as_number("edp_threshold", edp_threshold)
        self.exceedances(threshold)
        known = ~np.isnan(self.edp_rounded)
        changed = known & ((self.edp >= threshold) != (self.edp_rounded >= threshold))
        return int(changed.sum()), int(known.sum())

    def _facts(self) -> list[tuple[str, str]]:
        facts = [
            ("wall", self.wall.name),
            ("levels", levels_in_words(self.levels, self.im)),
            ("histories of a stripe", span(self.histories)),
            ("collapses", " ".join(map(str, self.collapses))),
            ("work", str(self.work)),
        ]
        if self.status is not None:
            sure, again, unknown = np.bincount(self.status[self.status > 0], minlength=4)[1:4]
            facts.append(("certified", f"{sure} in double, {again} in quadruple precision, {unknown} not computable"))
        if self.edp_rounded is not None:
            changed, known = self.rounding_changes()
            facts.append(("rounding of records", f"changes {changed} of {known} outcomes" if known else "not known"))
        restitution = restitution_sentence(upload((self.wall,)))
        if restitution:
            facts.insert(1, ("restitution", restitution))
        return [*facts, *notes_on_supports((self.wall,)), *self.work._notes()]
