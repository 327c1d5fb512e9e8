"""Counts and curves of the rows of a population, of its walls and facades, and of its groups."""

from __future__ import annotations

import functools
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from dondolo._base.arguments import FloatArray
from dondolo._fortran.populations import FlatCurves, FlatPopulation
from dondolo.analysis.work import Work
from dondolo.curves.fragility import Fragility
from dondolo.errors import DondoloWarning, NotKnownError
from dondolo.populations.curve import Group, IntArray, flat_population
from dondolo.populations.flags import Flags
from dondolo.populations.stored_curves import StoredCurves
from dondolo.walls.population import Population
from dondolo.walls.ties import TieCounts
from dondolo.walls.wall import Wall

_MISSING = "unions: the results were read back from files without *_unions.csv"


@dataclass(frozen=True, eq=False, repr=False, kw_only=True)
class RowCurves:
    """What became of the rows of a population, and the curves fitted to it; `Typology` describes the fields."""

    population: Population
    im: str
    levels: FloatArray
    edp_thresholds: FloatArray
    exceedances: IntArray
    histories: IntArray
    curves: tuple[Fragility, ...]
    combined: dict[str, Fragility]
    groups: tuple[Group, ...]
    work: Work
    flags: Flags | None = None
    warnings: tuple[DondoloWarning, ...] = ()
    stored_curves: StoredCurves | None = None
    union_curves: dict[str, Fragility] | None = None
    group_union_curves: dict[str, Fragility] | None = None
    union_counts: dict[str, FloatArray] | None = None
    ties: tuple[TieCounts, ...] | None = None
    record_formats: tuple[str, ...] = ()

    @property
    def walls(self) -> Sequence[Wall]:
        """The walls, one a row: the mechanisms of a wall stand one after the other."""
        return self.population.walls

    @property
    def weights(self) -> FloatArray:
        """Their weights, shape (rows,)."""
        return self.population.weights

    @property
    def collapses(self) -> IntArray:
        """Collapses of each row, shape (levels, rows)."""
        collapses: IntArray = self.exceedances[-1]
        return collapses

    @property
    def broken_ties(self) -> tuple[FloatArray, ...]:
        """Share of the histories of each stripe that break each tie, of each row, shape (levels, ties).

        Raises
        ------
        NotKnownError
            Results that do not have `ties`.
        """
        if self.ties is None:
            raise NotKnownError("broken_ties: these results do not know their ties")
        histories = self.histories.T.astype(np.float64)
        return tuple(own.broken / runs[:, None] for own, runs in zip(self.ties, histories, strict=True))

    @property
    def facade(self) -> str:
        """Name of the one facade, or wall with several mechanisms, that these results are of; '' if they are of more.

        Its curve is that of `unions`; `combined` and ``typology["all"]`` take mechanisms that occur together as
        independent.
        """
        return self.population.wholes[0] if len(self.combined) == 1 < len(self.walls) else ""

    @property
    def are_alternatives(self) -> bool:
        """Whether the walls are designs of one wall, of which one will be built: nothing is a mean over them."""
        return not self.groups

    @property
    def unions(self) -> dict[str, Fragility]:
        """Curve of each facade, or wall with several mechanisms, counted in the same histories.

        A history, of a record, polarity and level, counts if any of the mechanisms reaches the state in it; `combined`
        treats them as independent. Mechanisms that may not occur count with the probability that one that
        reaches the state can, exclusive alternatives with the sum of their probabilities. Standard errors are clustered
        by record.

        Raises
        ------
        NotKnownError
            The results were read back from files without them.
        """
        if self.union_curves is None:
            raise NotKnownError(_MISSING)
        return self.union_curves

    @property
    def group_unions(self) -> dict[str, Fragility]:
        """Curve of the population ('') and of each group with a wall of several mechanisms, in the same histories.

        The lognormal fitted to the weighted mean of `unions` and of the fractions of walls with one mechanism;
        ``typology["all"].fit`` is the same with the mechanisms of each wall as independent. Empty if no wall has
        several mechanisms, or if there is one wall only, which `unions` has. Standard errors are over records and
        walls.

        Raises
        ------
        NotKnownError
            The results were read back from files without them.
        """
        if self.group_union_curves is None:
            raise NotKnownError(_MISSING)
        return self.group_union_curves

    @property
    def knows_unions(self) -> bool:
        """Whether `unions` are known; they are not if the results were read from files without them."""
        return self.union_curves is not None

    @functools.cached_property
    def _flat(self) -> tuple[FlatPopulation, FlatCurves]:
        """The population with its collapses, and the curves of its rows, as Fortran takes them."""
        curves = FlatCurves.of([(curve.theta, curve.beta, curve.status) for curve in self.curves])
        return flat_population(self.population, self.levels, self.collapses.T, self.histories), curves
