"""Selecting and scaling records to a target spectrum: the greedy algorithm of Jayaram, Lin and Baker (2011).

The sample mean m and standard deviation s of ln Sa of the n selected records should meet the mean mu and the deviation
sigma of the target at all its periods. The cost is

    sum over periods of (m - mu)^2 + w (s - sigma)^2.

1. n spectra are drawn from the normal distribution of the target, several times, and the draw of least cost is kept.
2. For each spectrum the record is taken that lies nearest, by the sum of squares of ln Sa.
3. Each record is replaced in turn by the one that lowers the cost most, until none does.

The factor on a record brings it to the target's ordinate at the period that the target is conditional on; of other
targets it is that of least squares between the record and the spectrum drawn in its place, so that scaling keeps the
dispersion. Without a dispersion all spectra drawn are the target itself, and the cost keeps the records close to
it, not their mean alone.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from dondolo._base.arguments import FloatArray, argument_error, as_count, as_generator, as_number, instance_of
from dondolo._base.shown import Shown
from dondolo._storage.saved import Saved
from dondolo.records.level_rows import plain_records
from dondolo.records.record import Record
from dondolo.records.record_set import RecordSet
from dondolo.records.suite import check_motions
from dondolo.records.target import TargetSpectrum

if TYPE_CHECKING:
    from matplotlib.axes import Axes

# Draws of spectra of which the best is kept
_DRAWS = 20
# A replacement must lower the cost by more than this part of it
_GAIN = 1e-12
# After so many rounds of replacements, far more than are needed, it is enough
_MOST_ROUNDS = 50


@dataclass(frozen=True, eq=False, repr=False, kw_only=True)
class Selection(Shown, Saved):
    """Records selected and scaled to a target spectrum.

    Attributes
    ----------
    records : RecordSet
        The records with their factors.
    target : TargetSpectrum
    sa : ndarray, shape (records, periods)
        Their scaled spectra at the periods of the target [g].
    """

    records: RecordSet
    target: TargetSpectrum
    sa: FloatArray

    @property
    def factors(self) -> FloatArray:
        """Factor on each record, shape (records,)."""
        assert self.records.factor is not None
        return self.records.factor

    @property
    def median(self) -> FloatArray:
        """Geometric mean of the spectra of the records, shape (periods,) [g]."""
        return np.asarray(np.exp(np.log(self.sa).mean(axis=0)))

    @property
    def dispersion(self) -> FloatArray:
        """Standard deviation of ln Sa of the records, shape (periods,); 0 for one record."""
        return np.asarray(np.log(self.sa).std(axis=0, ddof=1)) if len(self.sa) > 1 else np.zeros(self.sa.shape[1])

    @property
    def misfit(self) -> tuple[float, float]:
        """Root mean squares over the periods of mean and dispersion of ln Sa, less those of the target."""
        mean = np.log(self.median / self.target.sa)
        spread = self.dispersion - self.target.dispersion
        return float(np.sqrt(np.mean(mean**2))), float(np.sqrt(np.mean(spread**2)))

    @property
    def largest_deviation(self) -> tuple[float, float]:
        """Least and largest of median / target - 1 over the periods: (-0.1, 0.2) is 10 % below and 20 % above."""
        ratio = self.median / self.target.sa - 1.0
        return float(ratio.min()), float(ratio.max())

    def plot(self, ax: Axes | None = None, **options: Any) -> Axes:
        """Draw the spectra of the records and the target.

        Parameters
        ----------
        ax : Axes, optional
            Where to draw; a new figure if left out.
        **options
            Parts to leave out by False (`legend`, `title`, `band`), and keywords of Matplotlib for the median: see
            docs/printing.md.

        Returns
        -------
        Axes
        """
        return self.records.plot(ax, target=self.target, **options)

    def _facts(self) -> list[tuple[str, str]]:
        low, high = self.largest_deviation
        mean, spread = self.misfit
        return [
            ("records", str(len(self.records))),
            ("factors", f"{self.factors.min():.3g} to {self.factors.max():.3g}"),
            ("misfit", f"{mean:.3g} of the mean and {spread:.3g} of the dispersion of ln Sa"),
            ("median / target - 1", f"{low:+.1%} to {high:+.1%}"),
        ]


class _Candidates(NamedTuple):
    """Logarithms of Sa (records, periods), and of the factors (places, records), NaN where they are not allowed."""

    ln_sa: FloatArray
    ln_factor: FloatArray


def select_records(
    records: Iterable[Record],
    target: TargetSpectrum,
    n_records: int,
    *,
    max_factor: float = 4.0,
    weight: float | None = None,
    rng: int | np.random.Generator | None = 0,
) -> Selection:
    """Records that meet a target: see `RecordSet.select`."""
    instance_of("target", target, TargetSpectrum)
    several = tuple(dict.fromkeys(RecordSet(plain_records(records)).records))
    places = as_count("n_records", n_records, 1, len(several))
    if weight is None:
        weight = 1.0 if target.covariance.any() else 0.1
    largest, share = as_number("max_factor", max_factor), as_number("weight", weight)
    if not 1.0 <= largest < np.inf:
        raise argument_error("out_of_range", "max_factor", f" = {largest:g}: must be at least 1")
    if not 0.0 <= share < np.inf:
        raise argument_error("out_of_range", "weight", f" = {share:g}: must not be negative")
    generator = as_generator(rng)
    check_motions(several)
    sa = RecordSet(several).spectra(target.periods, damping=target.damping)
    drawn = _draw(target, places, share, generator)
    candidates = _Candidates(np.log(sa), _factors(np.log(sa), target, drawn, np.log(largest)))
    chosen = _nearest(candidates, drawn, largest)
    chosen = _improved(candidates, chosen, np.log(target.sa), target.dispersion, share)
    factor = np.exp(candidates.ln_factor[np.arange(places), chosen])
    # In the order of the records, whatever was drawn
    order = np.argsort(chosen)
    chosen, factor = chosen[order], factor[order]
    scaled = factor[:, None] * sa[chosen]
    scaled.flags.writeable = False
    return Selection(records=RecordSet([several[i] for i in chosen], factor=factor), target=target, sa=scaled)


def _draw(target: TargetSpectrum, count: int, weight: float, generator: np.random.Generator) -> FloatArray:
    """Logarithms of spectra drawn from a target (count, periods), the best of several draws."""
    mean, sigma = np.log(target.sa), target.dispersion
    if not sigma.any():
        return np.tile(mean, (count, 1))
    draws = generator.multivariate_normal(mean, target.covariance, size=(_DRAWS, count), method="eigh")
    spread = draws.std(axis=1, ddof=1) if count > 1 else np.zeros((_DRAWS, len(mean)))
    cost = ((draws.mean(axis=1) - mean) ** 2 + weight * (spread - sigma) ** 2).sum(axis=1)
    return np.asarray(draws[int(np.argmin(cost))])


def _factors(ln_sa: FloatArray, target: TargetSpectrum, drawn: FloatArray, most: float) -> FloatArray:
    """Logarithms of the factors on the records in each place (places, records), NaN where they are not allowed."""
    if most == 0.0:
        return np.zeros((len(drawn), len(ln_sa)))
    if target.anchor is not None:
        here = int(np.searchsorted(target.periods, target.anchor))
        ln_factor = np.tile(np.log(target.sa[here]) - ln_sa[:, here], (len(drawn), 1))
    else:
        ln_factor = drawn.mean(axis=1)[:, None] - ln_sa.mean(axis=1)
    return np.where(np.abs(ln_factor) <= most * (1.0 + _GAIN), ln_factor, np.nan)


def _nearest(candidates: _Candidates, drawn: FloatArray, most: float) -> NDArray[np.int64]:
    """The record that lies nearest to each of the drawn spectra, each record once."""
    free = np.ones(len(candidates.ln_sa), dtype=bool)
    chosen = np.empty(len(drawn), dtype=np.int64)
    for i, spectrum in enumerate(drawn):
        distance = ((candidates.ln_sa + candidates.ln_factor[i][:, None] - spectrum) ** 2).sum(axis=1)
        distance[~free | np.isnan(distance)] = np.inf
        chosen[i] = np.argmin(distance)
        if distance[chosen[i]] == np.inf:
            raise argument_error(
                "out_of_range",
                "n_records",
                f" = {len(drawn)}: only {i} records can be scaled to the target by factors up to {most:g};"
                " a larger max_factor, more records, or fewer to select",
            )
        free[chosen[i]] = False
    return chosen


def _improved(
    candidates: _Candidates, chosen: NDArray[np.int64], mean: FloatArray, sigma: FloatArray, weight: float
) -> NDArray[np.int64]:
    """The choice after each record was replaced in turn by the one that lowers the cost most, until none does."""
    n = len(chosen)
    places = np.arange(n)
    # About the mean, so that no digits are lost in the squares
    about = candidates.ln_sa - mean
    for _ in range(_MOST_ROUNDS):
        changed = False
        for i in places:
            x = about + candidates.ln_factor[i][:, None]
            others = np.delete(about[chosen] + candidates.ln_factor[places, chosen][:, None], i, axis=0)
            m = (others.sum(axis=0) + x) / n
            cost = (m**2).sum(axis=1)
            if n > 1:
                squares = (others**2).sum(axis=0) + x**2 - n * m**2
                s = np.sqrt(np.maximum(squares, 0.0) / (n - 1))
                cost += weight * ((s - sigma) ** 2).sum(axis=1)
            now = cost[chosen[i]]
            cost[np.delete(chosen, i)] = np.inf
            best = int(np.argmin(np.where(np.isnan(cost), np.inf, cost)))
            if cost[best] < now * (1.0 - _GAIN):
                chosen[i], changed = best, True
        if not changed:
            break
    return chosen
