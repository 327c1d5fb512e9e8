"""How often each wall of a population collapses, and how likely that is within some years.

A mechanism can occur in a wall, or it cannot, for all earthquakes: a wall is a mixture of what can occur in it, each
combination of mechanisms, or each of its exclusive alternatives, with a frequency lambda_is of its own. The
probability that a wall drawn by weight collapses within t years is

    sum over walls and combinations of  share_is (1 - exp(-lambda_is t)),

and the mean frequency is the sum of share_is lambda_is.
"""

from __future__ import annotations

import functools
import itertools
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np

from dondolo._base.arguments import FloatArray
from dondolo.curves.members import Members
from dondolo.curves.occurrence import wall_probability
from dondolo.hazard.hazard import HazardCurve
from dondolo.hazard.integrals import Contributions, of_function, of_lognormal

# Walls that are integrated together: a few tens of MB
_BLOCK = 100
# So many dispersions away a normal distribution is 0 or 1 to all digits
_DISPERSIONS = 10.0


class WallFrequencies(NamedTuple):
    """Shares of walls and combinations of mechanisms, one each row, and the bounds of their frequencies.

    Attributes
    ----------
    share : ndarray
        Of the weight; what is missing to 1 are walls in which nothing can occur.
    low, high : ndarray
        [1/year]
    """

    share: FloatArray
    low: FloatArray
    high: FloatArray

    def probability(self, years: float) -> tuple[float, float]:
        """Bounds of the probability of a collapse within so many years, positive."""
        # Shares may add up to more than 1 by rounding.
        low, high = (min(1.0, float(-self.share @ np.expm1(-ends * years))) for ends in (self.low, self.high))
        return low, high


def wall_frequencies(members: Members, hazard: HazardCurve) -> WallFrequencies:
    """Frequencies of the walls behind a mean curve.

    Parameters
    ----------
    members : Members
        The walls.
    hazard : HazardCurve
        Of the same measure.

    Returns
    -------
    WallFrequencies
    """
    # There may be nothing that can occur at all
    found = [(np.zeros(0),) * 3]
    for share, mechanisms in _combinations(members):
        fitted = np.zeros(len(share), dtype=bool)
        if len(mechanisms) == 1:
            fitted = ~np.isnan(members.theta[mechanisms[0]])
            rows = mechanisms[0, fitted]
            parts = of_lognormal(members.theta[rows], members.beta[rows], hazard)
            found.append((share[fitted], *_bounds(parts, hazard)))
        rest = np.flatnonzero(~fitted)
        for start in range(0, len(rest), _BLOCK):
            block = rest[start : start + _BLOCK]
            rows = mechanisms[:, block]
            parts = of_function(functools.partial(_any_of, members, rows), hazard, _ends_of(members, rows, hazard))
            found.append((share[block], *_bounds(parts, hazard)))
    return WallFrequencies(*(np.concatenate(column) for column in zip(*found, strict=True)))


def _combinations(members: Members) -> Iterator[tuple[FloatArray, np.ndarray]]:
    """What can occur together: shares of walls of the weight, and rows (mechanisms, walls) that can occur in each."""
    weights = members.weights / members.weights.sum()
    is_exclusive = members.alternative[members.rows[0][1]] > 0
    places = [(walls[~is_exclusive[walls]], rows[~is_exclusive[walls]]) for walls, rows in members.rows]
    independent = [(walls, rows) for walls, rows in places if len(walls)]
    for occurs in itertools.product((True, False), repeat=len(independent)):
        share, chosen = np.where(is_exclusive, 0.0, weights), []
        for there, (walls, rows) in zip(occurs, independent, strict=True):
            p_occ, row = np.zeros(len(share)), np.zeros(len(share), dtype=np.intp)
            p_occ[walls], row[walls] = members.p_occ[rows], rows
            share = share * (p_occ if there else 1.0 - p_occ)
            chosen += [row] if there else []
        these = np.flatnonzero(share > 0.0)
        if chosen and len(these):
            yield share[these], np.stack(chosen)[:, these]
    if not is_exclusive.any():
        return
    # Each alternative, of equally many mechanisms together
    wall = np.repeat(np.arange(len(weights)), np.diff(members.rows[0][1], append=len(members.p_occ)))
    begins = np.flatnonzero((np.diff(wall, prepend=-1) != 0) | (np.diff(members.alternative, prepend=-1) != 0))
    number = np.diff(begins, append=len(wall))
    share = np.where(members.alternative[begins] > 0, weights[wall[begins]] * members.p_occ[begins], 0.0)
    for size in np.unique(number).tolist():
        these = np.flatnonzero((number == size) & (share > 0.0))
        if len(these):
            yield share[these], begins[these] + np.arange(size)[:, None]


def _any_of(members: Members, rows: np.ndarray, x: FloatArray) -> FloatArray:
    """Probabilities (walls, x) of walls in which these rows (mechanisms, walls) can occur."""
    occurs = np.ones(rows.size), np.zeros(rows.size, dtype=np.int32)
    return wall_probability(*occurs, members.rows_at(rows.T.ravel(), x), np.arange(0, rows.size, len(rows)))


def _ends_of(members: Members, rows: np.ndarray, hazard: HazardCurve) -> tuple[float, float]:
    """Where the integrals of fitted rows begin and end, in ln x: walls of a kind need little of the whole range."""
    mean, beta = np.log(members.theta[rows]), members.beta[rows]
    if np.isnan(mean).any():
        return -np.inf, np.inf
    # P H, with the power law H, is a normal density k beta dispersions below the median
    low = mean - (hazard._slopes()[0] * beta + _DISPERSIONS) * beta
    return float(low.min()), float((mean + _DISPERSIONS * beta).max())


def _bounds(parts: Contributions, hazard: HazardCurve) -> tuple[FloatArray, FloatArray]:
    """Bounds of the frequencies."""
    beyond = 0.0 if hazard.endless else float(hazard.annual_frequency[-1])
    return parts.inside + parts.above, parts.inside + parts.below + beyond
