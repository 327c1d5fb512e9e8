"""Uncertainty of a typological curve: records and walls drawn with replacement."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from dondolo._base.arguments import FloatArray, argument_error, as_count, as_generator, one_of, tails
from dondolo.curves.bootstrap import Bootstrap, draw_records, fit_samples
from dondolo.curves.occurrence import saturations, wall_probability
from dondolo.curves.sample import given_labels
from dondolo.populations.flags import Flags
from dondolo.walls.population import Population
from dondolo.walls.wall import properties_of

# Numbers that are held at a time: samples x walls, and samples x rows of a chunk x levels
_DRAWS = 4_000_000
_FRACTIONS = 8_000_000

_KINDS = ("records", "walls")


@dataclass(frozen=True, eq=False, repr=False, kw_only=True)
class TypologyBootstrap(Bootstrap):
    """Typological curves of records and walls drawn with replacement.

    Attributes
    ----------
    theta, beta : ndarray, shape (samples,)
        Parameters of the lognormal curve fitted to each mean fraction / upper_asymptote; NaN where a sample has no fit.
    status : ndarray of str, shape (samples,)
        What came of each fit; '' where it failed.
    levels : ndarray, shape (levels,)
        Levels of intensity.
    mean_fraction : ndarray, shape (samples, levels)
        Weighted mean of the walls' fractions of collapse; NaN where a sample has no wall that counts.
    upper_asymptote : ndarray, shape (samples,)
        Share of the weight in which any mechanism can occur.
    over : tuple of str
        What was drawn: 'records', 'walls' or both.

    Examples
    --------
    >>> import dondolo as dd
    >>> people = dd.Population([dd.OneSidedWall(1.5, 0.25, name="a"), dd.OneSidedWall(1.8, 0.25, name="b")])
    >>> records = dd.synthetic_records(6.5, 10.0, "shallow", n_records=10)
    >>> found = dd.typology(people, records, [0.6, 0.8, 1.0], progress=False)
    >>> low, high = found["all"].bootstrap(n_resamples=50).mean_interval()
    >>> bool((low <= high).all())
    True
    """

    levels: FloatArray
    mean_fraction: FloatArray
    upper_asymptote: FloatArray
    over: tuple[str, ...]

    @property
    def se_ln_theta(self) -> float:
        """Standard error of ln theta: standard deviation of the samples with a fit."""
        return float(np.std(np.log(self._fitted()[0]), ddof=1))

    @property
    def se_beta(self) -> float:
        """Standard error of beta: standard deviation of the samples with a fit."""
        return float(np.std(self._fitted()[1], ddof=1))

    def mean_interval(self, *, confidence: float = 0.95) -> tuple[FloatArray, FloatArray]:
        """Percentile interval of the mean fraction at each of the levels.

        Parameters
        ----------
        confidence : float
            Confidence, between 0 and 1.

        Returns
        -------
        low, high : ndarray, shape (levels,)
        """
        low, high = np.nanquantile(self.mean_fraction, tails(confidence), axis=0)
        return low, high

    def _ends(self) -> FloatArray:
        return self.upper_asymptote

    def _facts(self) -> list[tuple[str, str]]:
        return [("drawn", " and ".join(self.over)), *super()._facts()]

    def __repr__(self) -> str:
        what = " and ".join(self.over)
        return f"<TypologyBootstrap over {what}: {len(self.theta)} samples, {self.without_fit:.1%} without a fit>"


class _Rows(NamedTuple):
    """The rows of a curve.

    Attributes
    ----------
    row : ndarray of int, shape (rows,)
        Places in the population.
    wall : ndarray of int, shape (rows,)
        Which wall each belongs to, from 0.
    walls : int
        Walls that are drawn from; not all of them have a row in a curve of one mechanism.
    weight : ndarray, shape (rows,)
        Of the wall; with the probability of occurrence in a curve of one mechanism.
    share : ndarray, shape (rows,)
        Factor on the fraction: the probability of occurrence where mechanisms are combined, else 1.
    """

    row: NDArray[np.int64]
    wall: NDArray[np.int64]
    walls: int
    weight: FloatArray
    share: FloatArray
    alternative: NDArray[np.int32]


def resample_population(
    population: Population,
    flags: Flags,
    levels: FloatArray,
    n_resamples: int = 1000,
    rng: int | np.random.Generator | None = 0,
    over: str | Iterable[str] = _KINDS,
    mechanism: str | None = None,
    group: str = "",
    events: Sequence[Any] | None = None,
) -> TypologyBootstrap:
    """Fit the curve of a population again to records and walls drawn with replacement.

    A record is drawn for all walls at once and brings its histories at all levels and of both polarities; a wall brings
    all its mechanisms. For the parameters see `Typology.bootstrap`.
    """
    kinds = (over,) if isinstance(over, str) or not isinstance(over, Iterable) else tuple(over)
    if not kinds or not all(kind in _KINDS for kind in kinds):
        raise argument_error("not_a_word", "over", f" = {over!r}: must name 'records', 'walls' or both")
    n_resamples, generator = as_count("n_resamples", n_resamples, 1), as_generator(rng)
    rows = _rows_of(population, mechanism, group)
    if rows.walls == 1 and "walls" in kinds:
        # Drawn from itself a wall would look certain.
        if "records" not in kinds:
            raise argument_error("wrong_length", "walls", ": at least two are needed to draw from, there is 1")
        kinds = ("records",)
    records = np.ones((n_resamples, flags.records))
    if "records" in kinds:
        labels = flags.clusters if events is None else given_labels(flags.records, events)
        records = draw_records(labels, n_resamples, generator)
    draws = generator if "walls" in kinds else None
    size = max(1, _DRAWS // rows.walls)
    parts = [
        _mean_fractions(rows, flags, records[start : start + size], "records" in kinds, draws)
        for start in range(0, n_resamples, size)
    ]
    fraction, upper_asymptote = (np.concatenate(part) for part in zip(*parts, strict=True))
    counted = np.isfinite(fraction[:, 0])
    # Levels at which none of the drawn records runs count for nothing.
    histories = np.broadcast_to(_histories_behind(rows, flags) * flags.drawn(records), fraction.shape)
    occurring = np.where(counted & (upper_asymptote > 0.0), upper_asymptote, 1.0)
    share = np.clip(np.where(counted[:, None], fraction, 0.0) / occurring[:, None], 0.0, 1.0)
    theta, beta, status = fit_samples(levels, share * histories, histories)
    return TypologyBootstrap(
        theta=np.where(counted, theta, np.nan),
        beta=np.where(counted, beta, np.nan),
        status=np.where(counted, status, ""),
        levels=levels,
        mean_fraction=fraction,
        upper_asymptote=upper_asymptote,
        over=tuple(kind for kind in _KINDS if kind in kinds),
    )


def _rows_of(population: Population, mechanism: str | None, group: str) -> _Rows:
    """The rows of a curve, wall by wall."""
    one_of("group", group, ("", *population.group_names))
    wall = np.searchsorted(population.first_rows, np.arange(len(population)), side="right") - 1
    chosen = np.array([group in ("", own) for own in population.group_names])
    mechanisms = properties_of(population.walls, "mechanism")
    kinds = dict.fromkeys(own for own, here in zip(mechanisms, chosen, strict=True) if here)
    _, wall[chosen] = np.unique(wall[chosen], return_inverse=True)
    walls = int(wall[chosen].max()) + 1
    weight, p_occ = population.weights, population.p_occ
    if mechanism is None or mechanism == "all":
        row = np.flatnonzero(chosen)
        return _Rows(row, wall[row], walls, weight[row], p_occ[row], population.alternative_numbers[row])
    one_of("mechanism", mechanism, (*kinds, "all"))
    row = np.flatnonzero(chosen & (np.array(mechanisms) == mechanism))
    weights, share, alternative, first = population._of_one_mechanism(row)
    number = np.diff(first, append=len(row))
    return _Rows(row, wall[row], walls, np.repeat(weights, number), share, alternative)


def _mean_fractions(
    rows: _Rows,
    flags: Flags,
    records: FloatArray,
    resampled: bool,
    draws: np.random.Generator | None,
) -> tuple[FloatArray, FloatArray]:
    """Mean fractions (samples, levels) and saturations; `records` says how often each record is in each sample."""
    samples = len(records)
    times = np.ones((samples, rows.walls))
    if draws is not None:
        for own in times:
            own[:] = np.bincount(draws.integers(rows.walls, size=rows.walls), minlength=rows.walls)
    # Without drawn records all samples share the fractions.
    if not resampled:
        records = records[:1]
    total, weight, occurring = np.zeros((samples, flags.levels)), np.zeros(samples), np.zeros(samples)
    for part, starts in _chunks(rows, max(1, _FRACTIONS // (len(records) * flags.levels))):
        occurs = rows.share[part], rows.alternative[part]
        collapse = wall_probability(*occurs, _fractions(flags, rows.row[part], records), starts)
        own = times[:, rows.wall[part][starts]] * rows.weight[part][starts]
        weight += own.sum(axis=1)
        occurring += own @ saturations(*occurs, starts)
        if resampled:
            total += np.einsum("sw,wsl->sl", own, collapse)
        else:
            total += own @ collapse[:, 0]
    with np.errstate(invalid="ignore"):
        return np.clip(total / weight[:, None], 0.0, 1.0), occurring / weight


def _fractions(flags: Flags, row: NDArray[np.int64], records: FloatArray) -> FloatArray:
    """Fractions (rows, samples, levels), with each record taken so many times."""
    reached, drawn = flags.reached(row, records), flags.drawn(records)
    fractions: FloatArray = np.divide(reached, drawn, out=np.zeros(reached.shape), where=drawn > 0.0)
    return fractions


def _chunks(rows: _Rows, size: int) -> Iterator[tuple[slice, NDArray[np.int64]]]:
    """Rows of whole walls, about so many, and where in them each wall begins."""
    begins = np.flatnonzero(np.diff(rows.wall, prepend=-1))
    first = 0
    while first < len(begins):
        last = max(first + 1, int(np.searchsorted(begins, begins[first] + size, side="right")))
        end = int(begins[last]) if last < len(begins) else len(rows.row)
        yield slice(int(begins[first]), end), begins[first:last] - begins[first]
        first = last


def _histories_behind(rows: _Rows, flags: Flags) -> float:
    """Histories that the fit takes the mean fraction for, at a level at which every record runs."""
    begins = np.flatnonzero(np.diff(rows.wall, prepend=-1))
    histories = np.minimum.reduceat(flags.histories[rows.row], begins)
    weight = rows.weight[begins]
    if not weight.any():
        raise argument_error("out_of_range", "group", ": the weights of its walls are all zero")
    return float(np.count_nonzero(weight) * (weight @ histories) / weight.sum())
