"""Typological fragility: the curve of a population of walls."""

from __future__ import annotations

import dataclasses
import math
import os
from collections.abc import Iterable, Sequence
from contextlib import ExitStack
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from dondolo._base.arguments import FloatArray, as_levels, as_number, shaped
from dondolo._base.files import as_file, remove_old, whole_file
from dondolo._base.shown import Shown
from dondolo._fortran import _binding
from dondolo._storage import tables
from dondolo._storage.run_file import RunFile
from dondolo.analysis.stripes import stripes_table
from dondolo.analysis.work import Work
from dondolo.curves.fragility import Fragility, fragility_table
from dondolo.errors import DondoloError, DondoloWarning, InputError
from dondolo.populations.bootstrap import TypologyBootstrap, resample_population
from dondolo.populations.flags import Flags
from dondolo.populations.members import Members
from dondolo.walls.population import Population
from dondolo.walls.wall import Wall

IntArray = np.ndarray[Any, np.dtype[np.int32]]


@dataclass(frozen=True, eq=False)
class Group:
    """A curve of a population, or of one of its groups: of one mechanism, or of all together.

    Attributes
    ----------
    group : str
        '' for the whole population.
    mechanism : str
        'all' for whatever makes the walls collapse: mechanisms in series, each with its probability of occurrence.
    walls : int
        How many walls, those of no weight left out.
    weight : float
        Sum of the weights, in walls; of one mechanism a wall counts as often as it can occur.
    mean_fraction : ndarray, shape (levels,)
        Weighted mean of the walls' fractions of collapse, 0 to 1.
    mean_curve : ndarray, shape (levels,)
        Weighted mean of the walls' curves (the red line of figure 5 of Nale et al.); a wall without a fit takes part
        with its fractions.
    fractiles : ndarray, shape (3, levels)
        What 16, 50 and 84 % of the weight do not exceed.
    beta_walls, beta_records : float
        Dispersion between walls, the weighted standard deviation of ln theta, and between records, the weighted root
        mean square of beta, over the walls with a curve; NaN if there are none.
    fitted : float
        Share of what can occur that has a curve.
    saturation : float
        What the mean curve tends to: the share of the weight in which any mechanism can occur; 1 for one mechanism.
    fit : Fragility
        The lognormal curve fitted to the mean fractions / saturation, that of the walls in which a mechanism can occur;
        its standard errors take the walls' histories for independent. Its values are those for all walls: they tend to
        the saturation, as the mean curve does.
    """

    group: str
    mechanism: str
    walls: int
    weight: float
    mean_fraction: FloatArray
    mean_curve: FloatArray
    fractiles: FloatArray
    beta_walls: float
    beta_records: float
    fitted: float
    saturation: float
    fit: Fragility

    @property
    def beta_total(self) -> float:
        """Dispersion between walls and between records together."""
        return math.hypot(self.beta_walls, self.beta_records)


@dataclass(frozen=True, eq=False, repr=False)
class Typology(Shown):
    """Fragility of a population of walls.

    A damage state is reached where rotation / capacity comes to a threshold; collapse is the last. Whatever names no
    state is that of collapse; `at` gives the others.

    Attributes
    ----------
    population : Population
        The walls, one row a mechanism.
    im : str
        Intensity measure.
    levels : ndarray, shape (levels,)
    edp_thresholds : ndarray, shape (thresholds,)
        Rotation / capacity, increasing; the last is that of collapse, edp_limit.
    exceedances : ndarray of int, shape (thresholds, levels, rows)
        How many histories of each row reach them.
    histories : ndarray of int, shape (rows,)
        Histories of a stripe of each row.
    curves : tuple of Fragility
        Curve of each row.
    combined : dict of str to Fragility
        Curve of each wall by its name, mechanisms in series: that of its row, or where there are several or one that
        may not occur, the lognormal fitted to the combined fractions.
    groups : tuple of Group
        The curves: those of the whole population, then those of each group, in the order they appear in; for each
        mechanism, and the last for all, if there are several or one that may not occur.
    work : Work
        What was computed for all walls, and what was not.
    flags : Flags
        The states that every history reaches, packed, which `bootstrap` over records needs; None for results that were
        read back.
    warnings : tuple of DondoloWarning
        What was warned of: by the run, and of the curves of this state.
    """

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
    _states: dict[float, Typology] = field(default_factory=dict)

    @property
    def walls(self) -> tuple[Wall, ...]:
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
    def weight(self) -> float:
        """Sum of the weights of the walls."""
        return self.group().weight

    @property
    def mean_fraction(self) -> FloatArray:
        """Weighted mean of the walls' fractions of collapse, shape (levels,)."""
        return self.group().mean_fraction

    @property
    def mean_curve(self) -> FloatArray:
        """Weighted mean of the walls' curves, shape (levels,)."""
        return self.group().mean_curve

    def group(self, mechanism: str | None = None, group: str = "") -> Group:
        """A curve of the population.

        Parameters
        ----------
        mechanism : str, optional
            One of the mechanisms, or 'all'; all combined if left out.
        group : str
            One of the groups; '' for the whole population.

        Returns
        -------
        Group

        Raises
        ------
        InputError
            There is no such mechanism or group.
        """
        known = {one.group: None for one in self.groups}
        if group not in known:
            raise InputError(f"group = {group!r}: must be one of {', '.join(map(repr, known))}")
        of_group = {one.mechanism: one for one in self.groups if one.group == group}
        if mechanism is None:
            return list(of_group.values())[-1]
        if mechanism not in of_group:
            raise InputError(f"mechanism = {mechanism!r}: must be one of {', '.join(map(repr, of_group))}")
        return of_group[mechanism]

    def fit(self, mechanism: str | None = None, group: str = "") -> Fragility:
        """The lognormal curve of the walls that can collapse, see `Group`.

        Parameters
        ----------
        mechanism, group : str, optional
            As for `group`.

        Returns
        -------
        Fragility
            Its status says whether there is a curve.

        Raises
        ------
        InputError
            There is no such mechanism or group.
        """
        return self.group(mechanism, group).fit

    def at(self, edp: float) -> Typology:
        """The typology of one damage state.

        Parameters
        ----------
        edp : float
            One of `edp_thresholds`.

        Returns
        -------
        Typology
            With this threshold alone.

        Raises
        ------
        InputError
            There is no such threshold.

        Warns
        -----
        DondoloWarning
            Walls that have no fit in this state, a fit that extrapolates.
        """
        value = as_number("edp", edp)
        place = np.flatnonzero(self.edp_thresholds == value)
        if len(place) == 0:
            raise InputError(f"edp = {value}: must be one of {', '.join(f'{one:g}' for one in self.edp_thresholds)}")
        if len(self.edp_thresholds) == 1:
            return self
        if value not in self._states and place[0] == len(self.edp_thresholds) - 1:
            last, counts = self.edp_thresholds[-1:], self.exceedances[-1:]
            self._states[value] = dataclasses.replace(self, edp_thresholds=last, exceedances=counts, _states={})
        if value not in self._states:
            counts, threshold = self.exceedances[place], self.edp_thresholds[place]
            # These two modules need each other: curves make a typology, which makes those of its states.
            from dondolo.populations.combination import combine_rows

            state = combine_rows(self.population, self.im, self.levels, threshold, counts, self.histories, self.work)
            flags = None if self.flags is None else self.flags.at(int(place[0]))
            self._states[value] = dataclasses.replace(state, flags=flags)
            _binding.warn(warning.placed(f"damage state {value:g}: ") for warning in state.warnings)
        return self._states[value]

    def probabilities(self, x: ArrayLike, mechanism: str | None = None, group: str = "") -> FloatArray:
        """Probability that each wall collapses, mechanisms in series; of one mechanism, if it can occur.

        Parameters
        ----------
        x : array_like
            Levels of intensity, not negative. Between the levels, the fractions of a wall without a fit are
            interpolated linearly in x, from 0 at x = 0; above the highest level they stay.
        mechanism, group : str
            As for `group`.

        Returns
        -------
        ndarray, shape (walls,) and that of x
            Walls of no weight left out.

        Raises
        ------
        InputError
            No such mechanism or group, or a level that is negative or no number.
        """
        values = as_levels(x)
        probabilities, _ = self._members(mechanism, group).at(values.ravel())
        return probabilities.reshape((len(probabilities), *values.shape))

    def mean(self, x: ArrayLike, mechanism: str | None = None, group: str = "") -> Any:
        """Weighted mean of the walls' curves at any levels.

        Parameters
        ----------
        x : array_like
            Levels of intensity, as for `probabilities`.
        mechanism, group : str, optional
            As for `group`.

        Returns
        -------
        float or ndarray, shape of x

        Raises
        ------
        InputError
            As `probabilities`.
        """
        values = as_levels(x)
        members = self._members(mechanism, group)
        parts = (members.at(part) for part in members.parts(values.ravel()))
        mean = np.concatenate([weights @ part / weights.sum() for part, weights in parts] or [np.zeros(0)])
        return shaped(np.minimum(mean, 1.0), values)

    def fractiles(
        self, x: ArrayLike, q: ArrayLike = (0.16, 0.5, 0.84), mechanism: str | None = None, group: str = ""
    ) -> FloatArray:
        """Fractiles of the walls' curves at any levels: what a share of the weight does not exceed.

        Parameters
        ----------
        x : array_like
            Levels of intensity, as for `probabilities`.
        q : array_like
            Shares of the weight, above 0 and up to 1.
        mechanism, group : str
            As for `group`.

        Returns
        -------
        ndarray, shape of q and that of x
            At each level the smallest probability such that the walls up to it have at least the share.

        Raises
        ------
        InputError
            As `probabilities`, or a share beyond 0 and 1.
        """
        values = as_levels(x)
        try:
            shares = np.asarray(q, dtype=np.float64)
        except (TypeError, ValueError):
            shares = np.array(np.nan)
        if not np.all((shares > 0.0) & (shares <= 1.0)):
            raise InputError("q: must be shares of the weight, above 0 and up to 1")
        members = self._members(mechanism, group)
        found = np.zeros((shares.size, values.size))
        done = 0
        for part in members.parts(values.ravel()):
            probabilities, weights = members.at(part)
            order = np.argsort(probabilities, axis=0, kind="stable")
            reached = np.cumsum(weights[order], axis=0)
            # The rounding that Fortran allows, too
            targets = (shares.ravel() - 1e-12)[:, None] * weights.sum()
            for k in range(probabilities.shape[1]):
                place = np.minimum(np.searchsorted(reached[:, k], targets[:, 0]), len(weights) - 1)
                found[:, done + k] = probabilities[order[place, k], k]
            done += probabilities.shape[1]
        return found.reshape(shares.shape + values.shape)

    def _members(self, mechanism: str | None, group: str) -> Members:
        """The walls behind a curve."""
        curve = self.group(mechanism, group)
        people = self.population
        chosen = people.weights > 0.0
        if group:
            chosen &= np.array([name == group for name in people.groups])
        if curve.mechanism != "all":
            chosen &= (people.p_occ > 0.0) & np.array([wall.mechanism == curve.mechanism for wall in people.walls])
        rows = np.flatnonzero(chosen)
        counts = self.collapses[:, rows] / self.histories[rows]
        curves = [self.curves[i] for i in rows]
        if curve.mechanism == "all":
            # Weights and groups are those of whole walls
            first = np.searchsorted(rows, people.first_rows[chosen[people.first_rows]])
            return Members(self.levels, curves, counts, people.weights[rows[first]], people.p_occ[rows], first)
        weights = people.weights[rows] * people.p_occ[rows]
        return Members(self.levels, curves, counts, weights, np.ones(len(rows)), np.arange(len(rows)))

    def bootstrap(
        self,
        n: int = 1000,
        seed: int | np.random.Generator | None = 0,
        over: str | Iterable[str] = ("records", "walls"),
        mechanism: str | None = None,
        group: str = "",
        events: Sequence[Any] | None = None,
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
            What is drawn. Of both, records alone where there is one wall.
        mechanism : str, optional
            The curve of one mechanism; all combined if left out.
        group : str
            The curve of one group; '' for the whole population.
        events : sequence, optional
            A label for each record, such as its recording or its earthquake: records with the same label are drawn
            together. The two horizontal components of a recording are alike; drawn one by one they look like twice as
            much evidence as they are.

        Returns
        -------
        TypologyBootstrap

        Raises
        ------
        InputError
            No such mechanism or group, fewer than two events or walls, labels that are not one for each record.
        DondoloError
            Records cannot be drawn where the results were read back from files.
        """
        flags = self.flags
        if flags is None:
            if over not in ("walls", ("walls",), ["walls"]):
                raise DondoloError(
                    f"over = {over!r}: must be 'walls' for results that were read back: their files hold counts,"
                    " and not which records they are of"
                )
            flags = Flags.of_counts(self.exceedances, self.histories)
        self.group(mechanism, group)
        return resample_population(self.population, flags, self.levels, n, seed, over, mechanism, group, events)

    def _tables(self) -> dict[str, Any]:
        return {
            "typology": lambda: typology_table(self),
            "fragility": self._curves_table,
            "stripes": lambda: stripes_table(
                self.walls, self.im, self.levels, self.edp_thresholds, self.exceedances, self.histories
            ),
            "walls": lambda: self.population._table(),
        }

    def _curves_table(self) -> tables.Table:
        states = [self.at(edp).curves for edp in self.edp_thresholds]
        walls = [wall for wall in self.walls for _ in states]
        return fragility_table(walls, [curve for row in zip(*states, strict=True) for curve in row])

    def to_frame(self, table: str = "typology") -> Any:
        """One of the tables 'typology', 'fragility', 'stripes' and 'walls' as a pandas DataFrame."""
        return tables.frame(tables.choose(self._tables(), table))

    def to_csv(self, path: str | os.PathLike[str], table: str = "typology") -> None:
        """Write one of the tables 'typology', 'fragility', 'stripes' and 'walls' as the executable does."""
        counts = ", ".join(f"{name} = {count}" for name, count in dataclasses.asdict(self.work).items())
        comments = [
            *(f"gravity = {tables.shortest(pull)}" for pull in dict.fromkeys(wall.gravity for wall in self.walls)),
            f"unit of im_level and theta: {_binding.unit_of(self.im) or '1'}",
            f"work: {counts}",
            *(f"warning: {sentence}" for sentence in self.warnings),
        ]
        tables.write_csv(path, tables.choose(self._tables(), table), comments)

    def save(self, prefix: str | os.PathLike[str]) -> None:
        """Write all tables into files of the names that the executable gives them.

        They are what `read_results` and the commands ``python -m dondolo plot``, ``report`` and ``nrml`` read. Files of
        these names are replaced when all are written; what an earlier run has left with this prefix beside them, such
        as ``out/centre_histories.csv``, is removed.

        Parameters
        ----------
        prefix : path
            What the names begin with, such as ``out/centre`` for ``out/centre_typology.csv``; the folder must exist.

        Raises
        ------
        InputError
            Walls of different gravity, for which the files have no place.
        DondoloError
            A file cannot be written.
        """
        pulls = {wall.gravity for wall in self.walls}
        if len(pulls) > 1:
            raise InputError(
                f"gravity = {min(pulls):g} and {max(pulls):g}: must be the same for all walls that are saved"
            )
        start = as_file("prefix", prefix)
        with ExitStack() as files:
            # The last to get its name, which makes the others a run
            part = files.enter_context(whole_file(start.with_name(f"{start.name}_run.json")))
            part.write_text(self._run_file(pulls.pop()).to_json() + "\n", encoding="utf-8")
            for table in self._tables():
                part = files.enter_context(whole_file(start.with_name(f"{start.name}_{table}.csv")))
                self.to_csv(part, table)
        for table in ("histories", "history"):
            remove_old(start.with_name(f"{start.name}_{table}.csv"), "# dondolo ")

    def _run_file(self, gravity: float) -> RunFile:
        stripes = {"im": self.im, "levels": self.levels.tolist(), "edp_thresholds": self.edp_thresholds.tolist()}
        solver = {"edp_limit": float(self.edp_thresholds[-1]), "gravity": gravity}
        settings = {"job": {"task": "typology"}, "stripes": stripes, "solver": solver}
        version, work = _binding.constants().version, dataclasses.asdict(self.work)
        return RunFile(version, settings=settings, work=work, warnings=self.warnings)

    def _facts(self) -> list[tuple[str, str]]:
        fitted = sum(curve.has_fit for curve in self.combined.values())
        unit, whole = _binding.unit_of(self.im), self.group()
        facts = [
            ("walls", f"{len(self.combined)}, {fitted} of them with a curve"),
            ("levels", f"{len(self.levels)} of {self.im}, {self.levels[0]:g} to {self.levels[-1]:g} {unit}".strip()),
        ]
        if len(self.edp_thresholds) > 1:
            facts.append(("damage states", " ".join(f"{edp:g}" for edp in self.edp_thresholds)))
        facts += whole.fit._facts()
        if whole.fitted > 0.0:
            text = f"{whole.beta_walls:.3g} between walls, {whole.beta_records:.3g} between records"
            facts.append(("dispersion", text))
        return [*facts, ("work", str(self.work))]


def typology_table(typology: Typology) -> tables.Table:
    """Columns of ``_typology.csv``, one block of rows a damage state."""
    blocks = [_typology_of(typology.at(edp)) for edp in typology.edp_thresholds]
    return {name: [value for block in blocks for value in block[name]] for name in blocks[0]}


def _typology_of(typology: Typology) -> tables.Table:
    """Columns of ``_typology.csv`` of one damage state."""
    number, groups = len(typology.levels), typology.groups

    def repeated(values: Iterable[Any]) -> list[Any]:
        return [value for value in values for _ in range(number)]

    return {
        "mechanism": repeated(group.mechanism for group in groups),
        "im": [typology.im] * (number * len(groups)),
        "im_level": np.tile(typology.levels, len(groups)),
        "weight": repeated(group.weight for group in groups),
        "mean_fraction": np.concatenate([group.mean_fraction for group in groups]),
        "mean_curve": np.concatenate([group.mean_curve for group in groups]),
        "theta": repeated(group.fit.theta for group in groups),
        "beta": repeated(group.fit.beta for group in groups),
        "status": repeated(group.fit.status for group in groups),
        "group": repeated(group.group for group in groups),
        "fractile_16": np.concatenate([group.fractiles[0] for group in groups]),
        "fractile_50": np.concatenate([group.fractiles[1] for group in groups]),
        "fractile_84": np.concatenate([group.fractiles[2] for group in groups]),
        "beta_walls": repeated(group.beta_walls for group in groups),
        "beta_records": repeated(group.beta_records for group in groups),
        "saturation": repeated(group.saturation for group in groups),
        "edp_threshold": [typology.edp_thresholds[-1]] * (number * len(groups)),
    }
