"""Curve of a population or of a part of it, with the walls behind it."""

from __future__ import annotations

import functools
import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field, fields
from typing import TYPE_CHECKING, Any

import numpy as np

from dondolo._base.arguments import FloatArray
from dondolo._base.shown import Shown, shown_dispersion
from dondolo._base.wording import say
from dondolo._fortran.library import as_text
from dondolo._fortran.populations import FlatPopulation, curve_of_population
from dondolo._fortran.records import blank_unit
from dondolo._storage.saved import Saved
from dondolo.curves.fragility import Fragility
from dondolo.curves.mean_curve import MeanCurve
from dondolo.curves.members import Members
from dondolo.errors import DondoloError
from dondolo.figures import style
from dondolo.populations.bootstrap import TypologyBootstrap, resample_population
from dondolo.populations.flags import Flags
from dondolo.populations.influence import changes
from dondolo.walls.population import Population
from dondolo.walls.wall import properties_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from dondolo.populations.typology import Typology

IntArray = np.ndarray[Any, np.dtype[np.int32]]


def flat_population(people: Population, levels: FloatArray, counts: IntArray, histories: IntArray) -> FlatPopulation:
    """A population as Fortran takes it; counts are those of a damage state (rows, levels)."""
    words = (
        as_text("group", word)
        for both in zip(properties_of(people.walls, "mechanism"), people.group_names, strict=True)
        for word in both
    )
    return FlatPopulation(
        b"".join(word + b"\n" for word in words),
        levels,
        np.ascontiguousarray(counts).T,
        histories,
        np.stack([people.weights, people.p_occ]),
        people.alternative_numbers,
        people._numbers_of_rows,
    )


@dataclass(frozen=True, eq=False, kw_only=True)
class Group(Saved):
    """Numbers of a curve of a population or of one of its groups: of one mechanism, or of all together.

    Attributes
    ----------
    group : str
        '' for the whole population.
    mechanism : str
        'all' for all mechanisms that can occur, with their probabilities.
    n_walls : int
        How many walls, those of no weight left out.
    weight : float
        Sum of the weights, in walls; of one mechanism a wall counts as often as it can occur.
    mean_fraction : ndarray, shape (levels,)
        Weighted mean of the walls' fractions of collapse, 0 to 1.
    mean_curve : ndarray, shape (levels,)
        Weighted mean of the walls' curves (the red line of figure 5 of Nale et al.); a wall without a fit takes part
        with its fractions.
    level_fractiles : ndarray, shape (3, levels)
        What 16, 50 and 84 % of the weight do not exceed.
    beta_walls, beta_records : float
        Dispersion between walls, the weighted standard deviation of ln theta, and between records, the weighted root
        mean square of beta, over the walls with a curve; NaN if there are none.
    fitted : float
        Share of what can occur that has a curve.
    upper_asymptote : float
        What the mean curve tends to: the share of the weight in which any mechanism can occur; 1 for one mechanism.
    fit : Fragility
        The lognormal curve fitted to the mean fractions / upper asymptote, that of the walls in which a mechanism can
        occur; its standard errors are clustered by record and by wall. Its values are those for all walls: they tend to
        the upper asymptote, as the mean curve does.
    """

    group: str
    mechanism: str
    n_walls: int
    weight: float
    mean_fraction: FloatArray
    mean_curve: FloatArray
    level_fractiles: FloatArray
    beta_walls: float
    beta_records: float
    fitted: float
    upper_asymptote: float
    fit: Fragility

    @property
    def beta_total(self) -> float:
        """Dispersion between walls and between records together."""
        return math.hypot(self.beta_walls, self.beta_records)


@dataclass(frozen=True, eq=False, repr=False, kw_only=True)
class PopulationCurve(Shown, Group, MeanCurve):
    """The curve of a population or of one of its groups, of one mechanism or of all: ``typology[mechanism, group]``.

    Has the attributes of `Group`, at the levels of the analysis, and the means, fractiles and probabilities of the
    walls at any level.

    Examples
    --------
    >>> import dondolo as dd
    >>> walls = [dd.OneSidedWall(1.5, 0.25, name="a"), dd.OneSidedWall(1.8, 0.25, name="b")]
    >>> records = dd.synthetic_records(magnitude=6.5, distance=10.0, site="shallow", n_records=10)
    >>> curve = dd.typology(walls, records, levels=[0.6, 0.8, 1.0], progress=False)["all"]
    >>> curve(0.9) > curve(0.6)
    True
    """

    _source: Typology = field(repr=False)

    @classmethod
    def _of(cls, data: Group, source: Typology) -> PopulationCurve:
        """The curve of some walls of an analysis."""
        return cls(**{one.name: getattr(data, one.name) for one in fields(data)}, _source=source)

    def _stored(self) -> dict[str, Any]:
        return {"typology": self._source, "mechanism": self.mechanism, "group": self.group}

    @classmethod
    def _restored(cls, typology: Typology, mechanism: str, group: str) -> PopulationCurve:
        return typology[mechanism, group]

    @property
    def im(self) -> str:  # type: ignore[override]
        """Intensity measure."""
        return self._source.im

    @property
    def levels(self) -> FloatArray:
        """Levels of the analysis, shape (levels,)."""
        return self._source.levels

    @functools.cached_property
    def _chosen(self) -> np.ndarray[Any, np.dtype[np.bool_]]:
        """Which rows of the population take part."""
        people = self._source.population
        chosen = people.weights > 0.0
        if self.group:
            chosen &= np.array([name == self.group for name in people.group_names])
        if self.mechanism != "all":
            chosen &= (people.p_occ > 0.0) & (np.array(properties_of(people.walls, "mechanism")) == self.mechanism)
        return chosen

    @functools.cached_property
    def members(self) -> Members:
        """The walls behind the curve."""
        source, people, chosen = self._source, self._source.population, self._chosen
        rows = np.flatnonzero(chosen)
        counts = source.exceedances[-1][:, rows] / source.histories[:, rows]
        curves = [source.curves[i] for i in rows.tolist()]
        if self.mechanism == "all":
            # Weights and groups are those of whole walls
            first = np.searchsorted(rows, people.first_rows[chosen[people.first_rows]])
            occurs = people.p_occ[rows], people.alternative_numbers[rows]
            return Members(self.levels, curves, counts, people.weights[rows[first]], *occurs, first)
        return Members(self.levels, curves, counts, *people._of_one_mechanism(rows))

    @property
    def knows_records(self) -> bool:
        """Whether it is known which record makes which wall collapse; not for results read from files."""
        return self._source.flags is not None

    def changes(self, x: FloatArray, weights: FloatArray) -> dict[str, FloatArray]:
        """Changes of sum(weights * curve(x)) if each cluster of records, or each wall, is left out, by their kind.

        Examples
        --------
        >>> import numpy as np
        >>> import dondolo as dd
        >>> people = dd.Population([dd.OneSidedWall(1.5, 0.25, name="a"), dd.OneSidedWall(1.8, 0.25, name="b")])
        >>> records = dd.synthetic_records(6.5, 10.0, "shallow", n_records=10)
        >>> curve = dd.typology(people, records, [0.6, 0.8, 1.0], progress=False)["all"]
        >>> {kind: len(changes) for kind, changes in curve.changes(np.array([0.6, 0.8]), np.array([0.5, 0.5])).items()}
        {'clusters of records': 10, 'walls': 2}
        """
        flags = self._source.flags
        if flags is None:
            raise DondoloError(
                "uncertainty: results read from files contain counts, but not the records they belong to"
            )
        return changes(self.members, flags, np.flatnonzero(self._chosen), x, weights)

    def _at(self, x: FloatArray, q: FloatArray, members: bool = False) -> tuple[FloatArray, FloatArray, FloatArray]:
        return curve_of_population(*self._source._flat, (self.mechanism, self.group), x, q, members)

    @property
    def _drawn_to(self) -> float:
        return float(self.levels[-1])

    def plot(self, ax: Axes | None = None, *, label: str | None = None, **options: Any) -> Axes:
        """Draw the curves of the walls, thin, with their weighted mean and fractiles; or the mean alone, with a name.

        Figure 5 of Nale et al.: the red line is the typological curve.

        Parameters
        ----------
        ax : Axes, optional
            Where to draw; a new figure if left out.
        label : str, optional
            Name of the curve where several are drawn into the same axes: only the mean is drawn.
        **options
            Parts to leave out by False (`legend`, `title`, `band`, `points`), and keywords of Matplotlib for the mean:
            see docs/printing.md.

        Returns
        -------
        Axes
            Probability of collapse against intensity.
        """
        if label is not None:
            from dondolo.curves.plots import draw_any

            return draw_any(self, ax, label, options, style.mechanism_look(self.mechanism)["color"])
        from dondolo.populations.plots import draw_curve

        return draw_curve(self, ax, options)

    def bootstrap(
        self,
        *,
        n_resamples: int = 1000,
        rng: int | np.random.Generator | None = 0,
        over: str | Iterable[str] = ("records", "walls"),
        events: Sequence[Any] | None = None,
    ) -> TypologyBootstrap:
        """Fit the curve again to records and walls drawn with replacement.

        All walls are shaken by the same records: a record that is drawn counts for all of them, at all levels and in
        both polarities, and a wall that is drawn brings all its mechanisms. The clustered standard errors of the fit
        estimate the same.

        Parameters
        ----------
        n_resamples : int
            Number of samples.
        rng : int, Generator or None
            Of the random numbers; None: different every time.
        over : {'records', 'walls'} or both
            What is drawn. Of both, records alone where there is one wall.
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
            Fewer than two events or walls, labels that are not one for each record.
        DondoloError
            Records cannot be drawn where the results were read back from files.
        """
        source = self._source
        flags = source.flags
        if flags is None:
            if over not in ("walls", ("walls",), ["walls"]):
                raise DondoloError(
                    f"over = {over!r}: must be 'walls' for results read from files, which have counts,"
                    " but not the records they belong to"
                )
            flags = Flags.of_counts(source.exceedances, source.histories)
        mechanism, group = self.mechanism, self.group
        return resample_population(
            source.population, flags, self.levels, n_resamples, rng, over, mechanism, group, events
        )

    def _title(self) -> str:
        """Mechanism and group."""
        grouped = any(self._source.population.group_names)
        group = say(", group {group}", group=self.group) if self.group else say(", population") if grouped else ""
        return style.mechanism_name(self.mechanism) + group

    def __repr__(self) -> str:
        where = f", group {self.group!r}" if self.group else ""
        unit, fit = blank_unit(self.fit.im), self.fit
        numbers = f"theta {fit.theta:.6g}{unit}, beta {fit.beta:.6g}" if fit.has_fit else f"no fit ({fit.status})"
        return f"<PopulationCurve of {self.n_walls} walls: mechanism {self.mechanism!r}{where}, {numbers}>"

    def _facts(self) -> list[tuple[str, str]]:
        facts = [("curve", self._title()), ("walls", str(self.n_walls)), *self.fit._facts()]
        if self.fitted > 0.0:
            text = f"{shown_dispersion(self.beta_walls):.3g} between walls, {self.beta_records:.3g} between records"
            facts.append(("dispersion", text))
        return facts
