"""Typological fragility: the curve of a population of walls."""

from __future__ import annotations

import os
from collections.abc import Iterable
from concurrent.futures import Executor
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from dondolo import _binding, tables
from dondolo._blocks import run_walls
from dondolo._flags import Flags, states_of
from dondolo._request import new_request
from dondolo.errors import InputError, Interrupted
from dondolo.fragility import Fragility, _levels_of, curve_of, shaped
from dondolo.records import Record, as_records
from dondolo.typology_bootstrap import TypologyBootstrap, resample_population
from dondolo.walls import Population, Wall
from dondolo.work import Work

FloatArray = _binding.FloatArray
IntArray = np.ndarray[Any, np.dtype[np.int32]]


@dataclass(frozen=True, eq=False)
class Group:
    """Walls of one mechanism, or all walls of a population, together.

    Attributes
    ----------
    mechanism : str
        'all' for walls of several mechanisms.
    weight : float
        Sum of the weights.
    mean_fraction : ndarray, shape (levels,)
        Weighted mean of the walls' fractions of collapse.
    mean_curve : ndarray, shape (levels,)
        Weighted mean of the walls' curves (the red line of figure 5 of Nale et al.); a wall without a fit takes part
        with its fractions.
    fit : Fragility
        The lognormal curve fitted to the weighted counts; its standard errors take the walls' histories for
        independent.
    """

    mechanism: str
    weight: float
    mean_fraction: FloatArray
    mean_curve: FloatArray
    fit: Fragility


@dataclass(frozen=True, eq=False, repr=False)
class Typology:
    """Fragility of a population of walls.

    Attributes
    ----------
    population : Population
        The walls.
    im : str
        Intensity measure.
    levels : ndarray, shape (levels,)
    collapses : ndarray of int, shape (levels, walls)
    histories : ndarray of int, shape (walls,)
        Histories of a stripe of each wall.
    curves : tuple of Fragility
        Curve of each wall.
    groups : tuple of Group
        A group for each mechanism, in the order they appear in, and the last for all walls (the same where there is
        but one mechanism).
    work : Work
        What was computed for all walls, and what was not.
    flags : Flags
        The states that every history reaches, packed, which `bootstrap` needs.
    """

    population: Population
    im: str
    levels: FloatArray
    collapses: IntArray
    histories: IntArray
    curves: tuple[Fragility, ...]
    groups: tuple[Group, ...]
    work: Work
    flags: Flags | None = None

    @property
    def walls(self) -> tuple[Wall, ...]:
        """The walls."""
        return self.population.walls

    @property
    def weights(self) -> FloatArray:
        """Their weights, shape (walls,)."""
        return self.population.weights

    @property
    def weight(self) -> float:
        """Sum of the weights."""
        return self.groups[-1].weight

    @property
    def mean_fraction(self) -> FloatArray:
        """Weighted mean of the walls' fractions of collapse, shape (levels,)."""
        return self.groups[-1].mean_fraction

    @property
    def mean_curve(self) -> FloatArray:
        """Weighted mean of the walls' curves, shape (levels,)."""
        return self.groups[-1].mean_curve

    def group(self, mechanism: str | None = None) -> Group:
        """The walls of a mechanism together; of all if None."""
        known = {group.mechanism: group for group in self.groups}
        if mechanism is None:
            return self.groups[-1]
        if mechanism not in known:
            raise InputError(f"mechanism = {mechanism!r}: must be one of {', '.join(map(repr, known))}")
        return known[mechanism]

    def fit(self, mechanism: str | None = None) -> Fragility:
        """The lognormal curve fitted to the weighted counts of the walls of a mechanism, of all if None."""
        return self.group(mechanism).fit

    def mean(self, x: ArrayLike, mechanism: str | None = None) -> Any:
        """Weighted mean of the walls' curves.

        Parameters
        ----------
        x : array_like
            Levels of intensity, not negative. Between the levels, the fractions of a wall without a fit are
            interpolated linearly in x, from 0 at x = 0; above the highest level they stay.
        mechanism : str, optional
            Of its walls only.

        Returns
        -------
        float or ndarray, shape of x
        """
        values = _levels_of(x)
        flat = values.ravel()
        mean = np.zeros(len(flat))
        group = self.group(mechanism)
        for i, (curve, weight) in enumerate(zip(self.curves, self.weights, strict=True)):
            if group.mechanism not in ("all", self.walls[i].mechanism):
                continue
            if curve.has_fit:
                part = curve(flat)
            else:
                fraction = self.collapses[:, i] / self.histories[i]
                part = np.interp(flat, np.append(0.0, self.levels), np.append(0.0, fraction))
            mean += weight / group.weight * part
        return shaped(mean, values)

    def bootstrap(
        self,
        n: int = 1000,
        seed: int | np.random.Generator | None = 0,
        over: str | Iterable[str] = ("records", "walls"),
        mechanism: str | None = None,
        group: str = "",
    ) -> TypologyBootstrap:
        """Fit the curve again to records and walls drawn with replacement.

        All walls are shaken by the same records: a record that is drawn counts for all of them, at all levels and in
        both polarities, and a wall that is drawn brings all its mechanisms. The standard errors of the fit know nothing
        of that and are too small.

        Parameters
        ----------
        n : int
            Number of samples.
        seed : int, Generator or None
            Of the random numbers; None: different every time.
        over : {'records', 'walls'} or both
            What is drawn.
        mechanism : str, optional
            The curve of one mechanism; all combined if left out.
        group : str
            The curve of one group; '' for the whole population.

        Returns
        -------
        TypologyBootstrap
        """
        return resample_population(self.population, self.flags, self.levels, -1, n, seed, over, mechanism, group)

    def _tables(self) -> dict[str, Any]:
        return {
            "typology": lambda: tables.typology_table(self),
            "fragility": lambda: tables.fragility_table(self.walls, self.curves),
            "stripes": lambda: tables.stripes_table(
                self.walls, self.im, self.levels, self.collapses, list(self.histories)
            ),
            "walls": lambda: self.population._table(),
        }

    def to_frame(self, table: str = "typology") -> Any:
        """One of the tables 'typology', 'fragility', 'stripes' and 'walls' as a pandas DataFrame."""
        return tables.frame(tables.choose(self._tables(), table))

    def to_csv(self, path: str | os.PathLike[str], table: str = "typology") -> None:
        """Write one of the tables 'typology', 'fragility', 'stripes' and 'walls' as the executable does."""
        comments = [f"unit of im_level and theta: {_binding.unit_of(self.im) or '1'}"]
        tables.write_csv(path, tables.choose(self._tables(), table), comments)

    def _facts(self) -> list[tuple[str, str]]:
        fitted = sum(curve.has_fit for curve in self.curves)
        unit = _binding.unit_of(self.im)
        return [
            ("walls", f"{len(self.walls)}, {fitted} of them with a curve"),
            ("levels", f"{len(self.levels)} of {self.im}, {self.levels[0]:g} to {self.levels[-1]:g} {unit}".strip()),
            *self.fit()._facts(),
            ("work", str(self.work)),
        ]

    def __repr__(self) -> str:
        return "<Typology: " + ", ".join(f"{what} {text}" for what, text in self._facts()) + ">"

    def _repr_html_(self) -> str:
        return tables.html_of("Typology", self._facts())


def typology(
    population: Population | Iterable[Wall],
    records: Record | Iterable[Record],
    levels: ArrayLike,
    im: str = "pga",
    polarity: str = "as_recorded",
    engine: str = "auto",
    rtol: float | None = None,
    atol: float | None = None,
    edp_limit: float | None = None,
    edp_thresholds: ArrayLike | None = None,
    threads: int = 0,
    executor: Executor | None = None,
    checkpoint: str | os.PathLike[str] | None = None,
    block: int | None = None,
    progress: bool = True,
) -> Typology:
    """Fragility of a population of walls.

    Parameters
    ----------
    population : Population or iterable of Wall
        The walls; without weights they count alike.
    records, levels, im, polarity, engine, rtol, atol, edp_limit, threads, progress
        As for `multiple_stripe`.
    edp_thresholds : array_like, optional
        Rotations / capacity from which on a history is in a state of damage, increasing and at most `edp_limit`;
        collapse is always the last state. All states come from the same histories. Without thresholds only collapses
        are asked for, which takes less time.
    executor : concurrent.futures.Executor, optional
        Where blocks of walls are run (a pool of processes started by "spawn", Dask, MPI); each block then takes one
        thread unless `threads` says otherwise. Without it OpenMP runs the histories of this process. A pool of
        processes must not fork after a run of this process: OpenMP's threads do not survive it.
    checkpoint : path, optional
        File that keeps the blocks that are finished: the same call goes on from there after whatever ended it, and its
        results are the same to the bit. It stays when all is done.
    block : int, optional
        Walls of a block, the unit of checkpoints and executors; as many as take one to two seconds if left out. Results
        do not depend on it.

    Returns
    -------
    Typology

    Raises
    ------
    InputError
        What cannot be run, with the sentence of the executable; a checkpoint of another study.
    DondoloError
        The executor failed, or the checkpoint cannot be written.
    Interrupted
        Ctrl-C; its `partial` is the typology of the walls that are complete.

    Warns
    -----
    DondoloWarning
        Scale factors above 10, records without motion, walls without a fit, a fit that extrapolates.
    """
    people = population if isinstance(population, Population) else Population(population)  # type: ignore[arg-type]
    if executor is not None and threads == 0:
        threads = 1
    several = as_records(records)
    limit = float(_binding.settings(rtol, atol, edp_limit)[2])
    states = states_of(edp_thresholds, limit)
    alone = len(states) == 1
    request = new_request(
        people.walls, several, levels, im, polarity, engine, rtol, atol, edp_limit, threads, collapses_only=alone
    )
    plan = request.plan()
    run = run_walls(request, plan.histories, states, executor, checkpoint, block, progress)
    if not run.complete.any():
        raise Interrupted("interrupted: no wall is complete")
    collapses, work = np.ascontiguousarray(run.exceedances[-1].T), Work.total(run.works)
    result, sentences = combine(people, request.im, request.levels, plan.histories, collapses, run.complete, work)
    result = replace(result, flags=run.flags.chosen(np.flatnonzero(run.complete)))
    if not run.complete.all():
        raise Interrupted(f"interrupted: {run.complete.sum()} of {len(run.complete)} walls are complete", result)
    _binding.warn([*plan.warnings, *sentences])
    return result


def combine(
    people: Population,
    im: str,
    levels: FloatArray,
    histories: IntArray,
    collapses: IntArray,
    complete: np.ndarray[Any, Any],
    work: Work,
) -> tuple[Typology, list[str]]:
    """The curves of the walls that are complete, from their counts (walls, levels); and what to warn of."""
    chosen = np.flatnonzero(complete)
    walls = tuple(people.walls[i] for i in chosen)
    weights = np.ascontiguousarray(people.weights[chosen])
    histories, collapses = histories[chosen], collapses[chosen]
    if not weights.any():
        weights = np.ones(len(chosen))
    people = Population(walls, weights, tuple(people.groups[i] for i in chosen), people.p_occ[chosen])
    flat = _binding.join_walls([wall._flat for wall in walls])
    curves, groups, sentences = _binding.fit_walls(flat, levels, collapses, histories, weights)
    sizes = np.repeat(histories.astype(np.float64)[:, None], len(levels), axis=1)
    counts = collapses.astype(np.float64)
    own = tuple(
        curve_of(curve, levels, z, n, im=im, wall=wall)
        for curve, z, n, wall in zip(curves, counts, sizes, walls, strict=True)
    )
    together = []
    for group in groups:
        members = np.array([group.mechanism in ("all", wall.mechanism) for wall in walls])
        # The counts that the curve was fitted to, for its profile likelihood
        share = np.where(members, weights, 0.0) / group.weight * members.sum()
        z, n = share @ counts, share @ sizes
        curve = curve_of(group.curve, levels, np.minimum(z, n), n, im=im)
        together.append(Group(*group[:-1], curve))
    histories.flags.writeable = False
    result = Typology(
        people,
        im,
        levels,
        np.ascontiguousarray(collapses.T),
        histories,
        own,
        tuple(together),
        work,
    )
    return result, sentences
