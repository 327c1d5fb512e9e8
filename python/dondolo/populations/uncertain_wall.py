"""Curve of one wall with uncertain properties, sampled, all variants under the same records."""

from __future__ import annotations

import math
import os
import threading
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from dondolo._base.arguments import FloatArray, argument_error, as_count, instance_of
from dondolo._fortran.buildings import BUILDING_NAMES, BUILDING_PROPERTIES
from dondolo._fortran.library import warn
from dondolo._fortran.records import blank_unit
from dondolo._fortran.tables import TableColumns, plain, source_columns
from dondolo._fortran.uncertainty import (
    check_factor,
    factor_parameters,
    published_factors,
    sensitivity,
    smallest_sample,
)
from dondolo._fortran.walls import WALL_LISTS, WALL_NUMBERS
from dondolo._storage import tables
from dondolo._storage.saved import Saved
from dondolo.analysis.request import Polarity
from dondolo.analysis.solver import Solver
from dondolo.analysis.stripe_runs import multiple_stripe
from dondolo.analysis.stripes import Stripes
from dondolo.curves.fitting import fit_fragility
from dondolo.curves.fragility import Fragility
from dondolo.curves.table import flat
from dondolo.errors import DondoloError, DondoloWarning, InputError, Interrupted, silent
from dondolo.populations.curve import PopulationCurve
from dondolo.populations.study import typology
from dondolo.populations.typology import Typology
from dondolo.populations.typology_tables import write_typology
from dondolo.records.building import Building
from dondolo.records.level_rows import lasting
from dondolo.records.record import Record
from dondolo.walls.distributions import Choice, Distribution, Normal, Uniform, no_distribution
from dondolo.walls.parts import parts_of
from dondolo.walls.population import Population
from dondolo.walls.sampling import draw, in_words, make_walls
from dondolo.walls.wall import Wall, property_of, upload

if TYPE_CHECKING:
    from concurrent.futures import Executor

    from matplotlib.axes import Axes

# Shares at which one source alone is moved to its ends, and where it stays otherwise
_ENDS = (0.05, 0.95)
_MIDDLE = 0.5
# The source that a published distribution may be named for
_FACTOR = "restitution_factor"
# Walls of a sample at most, as in a case
_MOST = 10000
# An outcome in doubt: twice the estimated error reaches the limit, or the error is such a share of it that the estimate
# itself is lost, as src/core/motion/common/response.f90 has it
_SAFETY, _SATURATED = 2.0, 1e-2


@dataclass(frozen=True, eq=False, repr=False, kw_only=True)
class UncertainWall(tables.Tabular, Saved):
    """Result of the analysis of a wall with uncertain properties.

    Attributes
    ----------
    sources : tuple of str
        The uncertain properties.
    distributions : tuple of str
        The distribution of each, in words.
    values : ndarray, shape (sources, 3)
        Each at its fractiles 5, 50 and 95 %, in its own unit.
    typology : Typology
        All walls: the sample, and with a weight of 0, so that they take no part in the curve of the sample, the wall as
        it was given, that with all sources at their medians, and those with one source at its lower and upper end.
    first, total : ndarray, shape (sources,)
        Sobol indices of ln theta: the part of its variance in the sample that is due to a source alone, and together
        with the others.
    first_interval, total_interval : ndarray, shape (sources, 2)
        Their 95 % intervals.
    rest : float
        Part of that variance that no polynomial of the sources explains: theta as a count of a few records is rough.
    numbers : (float, float)
        Medians of the wall with its sources at their medians, with every doubtful history counted as a collapse, and
        with none.
    """

    sources: tuple[str, ...]
    distributions: tuple[str, ...]
    values: FloatArray
    typology: Typology
    first: FloatArray
    first_interval: FloatArray
    total: FloatArray
    total_interval: FloatArray
    rest: float
    numbers: tuple[float, float]

    @property
    def im(self) -> str:
        """Intensity measure of the curves."""
        return self.typology.im

    @property
    def _samples(self) -> int:
        """How many rows are the sample."""
        return len(self.typology.walls) - 2 - 2 * len(self.sources)

    @property
    def sample(self) -> Population:
        """The sampled walls."""
        return self.typology.population[: self._samples]

    @property
    def curve(self) -> PopulationCurve:
        """The mean curve of the sample, which includes records and model: the curve to use."""
        return self.typology["all"]

    @property
    def as_given(self) -> Fragility:
        """Curve of the wall as it was given."""
        return self.typology.curves[self._samples]

    @property
    def at_medians(self) -> Fragility:
        """Curve of the wall with all sources at their medians."""
        return self.typology.curves[self._samples + 1]

    @property
    def ends(self) -> tuple[tuple[Fragility, Fragility], ...]:
        """Curves with one source at its fractiles 5 and 95 % and all others at their medians, for each source."""
        curves = self.typology.curves[self._samples + 2 :]
        return tuple(zip(curves[::2], curves[1::2], strict=True))

    @property
    def thetas(self) -> FloatArray:
        """Median of each sampled wall, shape (walls,); NaN for one without a curve."""
        return np.array([curve.theta for curve in self.typology.curves[: self._samples]])

    @property
    def theta(self) -> float:
        """Median of the curve with its uncertain model: the geometric mean of those in the sample; NaN if none."""
        thetas = self.thetas
        return float(np.exp(np.log(thetas[np.isfinite(thetas)]).mean())) if np.isfinite(thetas).any() else np.nan

    @property
    def beta_records(self) -> float:
        """Aleatory dispersion, of the records: root mean square of beta in the sample."""
        return self.curve.beta_records

    @property
    def beta_model(self) -> float:
        """Epistemic dispersion, of the model: standard deviation of ln theta in the sample."""
        return self.curve.beta_walls

    @property
    def beta_total(self) -> float:
        """Both together."""
        return math.hypot(self.beta_records, self.beta_model)

    def plot(self, ax: Iterable[Any] | None = None, **options: Any) -> Axes:
        """Draw the curves of the sample, and what moves the median: records, each source, numbers.

        Parameters
        ----------
        ax : two Axes, optional
            Where to draw; a new figure if left out.
        **options
            Parts to leave out by False (`legend`, `title`, `band`, `bars`), and keywords of Matplotlib for the mean:
            see docs/printing.md.

        Returns
        -------
        Axes
            The first of the figure's: probability of collapse against intensity; and a tornado diagram: the median's 95
            % interval for other records, its values with one source at its 5 and 95 % fractiles, and what the estimated
            error of the numbers could change.
        """
        from dondolo.populations.plots_uncertain import draw_uncertain_wall

        return draw_uncertain_wall(self, ax, options)

    def write_results(self, prefix: str | os.PathLike[str], *, spreadsheet_safe: bool = False) -> None:
        """Write all tables into files of the names that the executable gives them, as `Typology.write_results`.

        `read_results` gives the same, but for `rest` and `numbers`.

        Parameters
        ----------
        prefix, spreadsheet_safe
            As for `Typology.write_results`.

        Raises
        ------
        InputError
            Another run is writing them, or a file of the same name is not a result of dondolo.
        DondoloError
            A file cannot be written.
        """
        write_typology(self.typology, prefix, spreadsheet_safe, {"_sources.csv": self._columns()}, {"uncertainty": {}})

    def _comments(self) -> list[str]:
        return [f"unit of theta: {blank_unit(self.im).strip() or '1'}", *tables.lines_of(self._facts())]

    def _columns(self) -> TableColumns:
        """Columns of ``_sources.csv``."""
        return source_columns(
            list(zip(self.sources, self.distributions, strict=True)),
            self.values,
            [(flat(low), flat(high)) for low, high in self.ends],
            {
                "first": self.first,
                "first_interval": self.first_interval.T,
                "total": self.total,
                "total_interval": self.total_interval.T,
            },
        )

    def _table(self) -> tables.Table:
        return plain(self._columns())

    def _facts(self) -> list[tuple[str, str]]:
        unit = blank_unit(self.im)
        low, high = self.curve.fractiles(self.theta, (0.16, 0.84)).ravel()
        fitted = int(np.isfinite(self.thetas).sum())
        facts = [
            *((("variants with a fit", f"{fitted} of {self._samples}"),) if fitted < self._samples else ()),
            ("theta", f"{self.theta:.4g}{unit}"),
            ("beta of records", f"{self.beta_records:.3g}"),
            ("beta of the model", f"{self.beta_model:.3g}"),
            ("beta in all", f"{self.beta_total:.3g}"),
            ("P(collapse) at theta, fractiles 16 and 84 %", f"{low:.2g} to {high:.2g}"),
            ("as given", f"theta {self.as_given.theta:.4g}{unit}"),
        ]
        for name, first, total in zip(self.sources, self.first, self.total, strict=True):
            facts.append(
                (name, f"{100.0 * first:.0f} % of the model's variance, {100.0 * total:.0f} % with the others")
            )
        return facts


def propagate_uncertainty(
    wall: Wall,
    records: Record | Iterable[Record] | Mapping[float, Record | Iterable[Record]],
    levels: ArrayLike,
    *,
    sources: Mapping[str, Distribution | str],
    n_variants: int = 200,
    seed: int = 1,
    im: str = "pga",
    polarity: Polarity = "as_recorded",
    solver: Solver | None = None,
    threads: int = 0,
    executor: Executor | None = None,
    progress: bool = True,
    stop: threading.Event | None = None,
) -> UncertainWall:
    """Sample the uncertain properties of a wall, and apportion the variance of its median among them.

    The sample is a Latin hypercube of independent properties. All its walls are shaken by the same records, so that the
    scatter of their medians is that of the model alone.

    Parameters
    ----------
    wall : Wall
        The wall; properties that are not sources keep their values.
    records, levels, im, polarity, solver, threads, executor, progress, stop
        As for `typology`.
    sources : mapping of str to distribution
        Numbers of the wall (restitution_factor, hinge, hinge_depth, density, thickness ...), or wedge_angle, one angle
        for all its wedges, and their distributions, such as `Uniform`, `Triangular` or `Normal`. For restitution_factor
        the name of a published distribution:
        'graziotti_2016', uniform, 0.84 to 0.90 times equation (4) for walls of two blocks with the model 'sorrentino';
        for free-standing blocks, times Housner's value, 'colombo_2025' for stone, normal with mean 0.990 and standard
        deviation 0.018, cut off on both sides where a speed ratio would reach 1, or 'elgawady_2010' for concrete,
        uniform, 0.90 to 1.0. They are refused for other models.
    n_variants : int
        Walls of the sample, at most 10 000, and at least 2 + 6 k + k (k - 1) for k sources.
    seed : int
        Seed of the random numbers; the same seed gives the same walls.

    Returns
    -------
    UncertainWall

    Raises
    ------
    InputError
        A source that is not a number of the wall, a sampled wall that is impossible, too small a sample, and errors of
        `typology`.
    DondoloError
        Fewer walls with a curve than the indices need: the levels do not reach up or down to their medians.
    Interrupted
        Ctrl-C or `stop`; its `partial` is the typology of the variants that are complete.

    Warns
    -----
    DondoloWarning
        Warnings of `typology`; variants without a fit, which theta, dispersions and indices leave out.

    Notes
    -----
    docs/reading_a_curve.md. Indices come from the sample as it is, by regression on polynomials of the ranks; no
    walls are run for them alone.

    Examples
    --------
    >>> import dondolo as dd
    >>> wall = dd.TwoBlockWall(3.0, 0.25, hinge=0.6)
    >>> records = dd.synthetic_records(magnitude=6.5, distance=10.0, site="shallow", n_records=10)
    >>> sources = {"restitution_factor": "graziotti_2016", "hinge": dd.distributions.Triangular(0.5, 0.6, 0.75)}
    >>> levels = [0.5, 1.0, 1.5, 2.0, 3.0]
    >>> found = dd.propagate_uncertainty(wall, records, levels, sources=sources, n_variants=40, progress=False)
    >>> found.sources
    ('restitution_factor', 'hinge')
    >>> bool(found.beta_total > found.beta_records)
    True
    """
    instance_of("wall", wall, Wall)
    known = _distributions(wall, sources)
    n, seed = as_count("n_variants", n_variants, smallest_sample(len(known)), _MOST), as_count("seed", seed, 0)
    if isinstance(name := sources.get(_FACTOR), str):
        # Variants with the model's own speed ratios: what is published is a ratio to them
        bare = _sampled(wall, known | {_FACTOR: Choice((1.0,))}, n, seed)[0]
        check_factor(upload((bare[n + 1],)), name)
        parameters = factor_parameters(upload(tuple(bare)), name)
        if len(parameters) == 4:
            known[_FACTOR] = Normal(*parameters[:2], low=parameters[2], high=parameters[3])
    people, values = _sampled(wall, known, n, seed)
    several = lasting(records)
    found = typology(
        people,
        several,
        levels,
        im=im,
        polarity=polarity,
        solver=solver,
        threads=threads,
        executor=executor,
        progress=progress,
        stop=stop,
    )
    try:
        with silent():
            middle = multiple_stripe(
                people[n + 1],
                several,
                levels,
                im=im,
                polarity=polarity,
                solver=solver,
                estimate_error=True,
                threads=threads,
                progress=False,
                stop=stop,
            )
    except Interrupted as interrupted:
        told = str(interrupted).removeprefix("interrupted: ")
        raise Interrupted(
            f"interrupted: {len(people)} of {len(people)} walls are complete; of the estimate of errors {told}", found
        ) from None
    return _result(known, values, found, _numbers(middle))


def _sampled(wall: Wall, known: Mapping[str, Distribution], n: int, seed: int) -> tuple[Population, FloatArray]:
    """All walls that are run, and the values of the sources at their ends and medians."""
    values = np.array(
        [[float(known[what].ppf(np.array([q]))[0]) for q in (_ENDS[0], _MIDDLE, _ENDS[1])] for what in known]
    )
    return _variants(wall, known, draw(n, seed, known, {}), values), values


def _distributions(wall: Wall, sources: Any) -> dict[str, Distribution]:
    """The distribution of each source."""
    if not isinstance(sources, Mapping) or not sources:
        raise argument_error(
            "wrong_type", "sources", ": must be a mapping of properties of the wall to distributions, at least one"
        )
    own = [
        what
        for what in WALL_NUMBERS
        if what in type(wall).__dataclass_fields__ and what not in WALL_LISTS and what not in BUILDING_NAMES
    ]
    if parts_of(wall, "wedges"):
        # One angle for all wedges
        own.append("wedge_angle")
    if wall.building is not None:
        own += _of_building(wall.building)
    found: dict[str, Distribution] = {}
    for what, given in sources.items():
        if what not in own:
            raise argument_error("not_a_word", "sources", f": {what!r}: must be one of {', '.join(own)}")
        if isinstance(given, str):
            published = published_factors()
            if what != _FACTOR or given not in published:
                names = ", ".join(map(repr, published))
                error = no_distribution(what, given)
                raise InputError(f"{error}; names are for restitution_factor, {names}")
            tests = published[given]
            found[what] = (Normal if tests.kind == "normal" else Uniform)(tests.first, tests.second)
        elif isinstance(given, Distribution):
            found[what] = given
        else:
            raise no_distribution(what, given)
    return found


def _of_building(building: Building) -> list[str]:
    """What may be uncertain of a building: real numbers, and what it has of each mode if it has one."""
    kinds = ("real", "list") if len(building.participations) == 1 else ("real",)
    return [row.name for row in BUILDING_PROPERTIES if row.kind in kinds]


def _variants(
    wall: Wall, known: Mapping[str, Distribution], sampled: Mapping[str, FloatArray], values: FloatArray
) -> Population:
    """All walls that are run, in the order that `UncertainWall` has them."""
    own = {what: value for what, value in wall._properties().items() if value is not None}
    name = own.pop("name")
    mechanism = own.pop("mechanism")
    n = len(next(iter(sampled.values())))
    single = np.repeat(values[:, 1:2], 1 + 2 * len(values), axis=1)
    for i, (low, _, high) in enumerate(values):
        single[i, 1 + 2 * i : 3 + 2 * i] = low, high
    columns = {what: np.append(sampled[what], row) for what, row in zip(known, single, strict=True)}
    names = [f"{name} {i:0{max(4, len(str(n)))}d}" for i in range(1, n + 1)]
    names += [f"{name}, medians"]
    names += [f"{name}, {what} at {end:.0%}" for what in known for end in _ENDS]
    walls = make_walls(mechanism, names, own | columns, wall.gravity)
    origin = "; ".join(f"{what} = {in_words(one)}" for what, one in known.items())
    return Population(
        (*walls[:n], wall, *walls[n:]),
        np.repeat([1.0, 0.0], [n, len(names) - n + 1]),
        origin=(f"{n} variants of the wall '{name}', a Latin hypercube", origin),
    )


def _numbers(stripes: Stripes) -> tuple[float, float]:
    """Medians if all histories in doubt collapse, and if none does."""
    error = np.nan_to_num(np.asarray(stripes.edp_error))
    reaches = stripes.edp + _SAFETY * error >= stripes.edp_limit
    doubtful = (error > 0.0) & (reaches | (error > _SATURATED * stripes.edp_limit))
    with silent():
        low, high = (
            fit_fragility(stripes.levels, (collapsed & stripes.ran).sum(axis=1), stripes.histories, im=stripes.im).theta
            for collapsed in (stripes.collapsed | doubtful, stripes.collapsed & ~doubtful)
        )
    return low, high


def _result(
    known: Mapping[str, Distribution], values: FloatArray, found: Typology, numbers: tuple[float, float]
) -> UncertainWall:
    """Curves and indices of what was run."""
    n = len(found.walls) - 2 - 2 * len(known)
    thetas = np.array([curve.theta for curve in found.curves[:n]])
    fitted = np.isfinite(thetas)
    sampled = np.array([[np.ravel(property_of(wall, what))[0] for what in known] for wall in found.walls[:n]])
    try:
        indices = sensitivity(sampled[fitted], np.log(thetas[fitted]))
    except InputError as error:
        raise DondoloError(f"{fitted.sum()} of {n} sampled walls have a curve: {error}") from None
    if not fitted.all():
        sentence = (
            f"theta, dispersions and Sobol indices are of the {fitted.sum()} of {n} variants that have a fit: the"
            " levels must reach below and above the medians of all"
        )
        warn([DondoloWarning(sentence, "variants_without_fit", numbers={"fitted": int(fitted.sum()), "variants": n})])
    return UncertainWall(
        sources=tuple(known),
        distributions=tuple(in_words(one) for one in known.values()),
        values=values,
        typology=found,
        numbers=numbers,
        **indices._asdict(),
    )
