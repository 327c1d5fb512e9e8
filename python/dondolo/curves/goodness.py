"""How well a lognormal fits: deviance, a bootstrap of it under the curve, residuals, and fits to fewer levels.

The deviance is twice what the likelihood of the curve is below that of the fractions themselves. If all histories were
independent it would have about a chi-square distribution with as many degrees of freedom as there are levels less two.
They are not: the same records run at every level, so that the fractions of neighbouring levels err together, a smooth
curve follows them, and the deviance is far smaller. Its chi-square probability is then close to 1 whatever the curve.

The bootstrap keeps the dependence. Clusters of records are drawn with replacement, each with its histories at all
levels, from histories of which the curve is true: at each level as few outcomes are changed as make the fraction that
of the curve, those of the histories that are nearest to the other outcome, by the number of levels at which they
collapse. One of them is changed with a probability, so that the expected fraction is that of the curve exactly. The
p-value is the part of these samples, fitted again, whose deviance is not smaller, (1 + number)/(1 + samples).

Curves of counts know no records: their samples are binomial, as if all histories were independent.
"""

from __future__ import annotations

import dataclasses
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from dondolo._base.arguments import FloatArray, argument_error, as_count, as_generator, as_number
from dondolo._base.shown import Shown
from dondolo._fortran.curves import fit_curves
from dondolo._fortran.library import constants
from dondolo._fortran.records import blank_unit
from dondolo._storage.saved import Saved
from dondolo.curves.fitting import fit
from dondolo.curves.sample import Sample
from dondolo.errors import DondoloError, InputError

if TYPE_CHECKING:
    from dondolo.curves.fragility import Fragility


@dataclass(frozen=True, eq=False, repr=False, kw_only=True)
class GoodnessOfFit(Shown, Saved):
    """Goodness of fit of a fragility curve: `Fragility.goodness_of_fit`.

    Attributes
    ----------
    deviance : float
        Twice what the likelihood of the curve is below that of the fractions themselves.
    degrees_of_freedom : int
        Levels less parameters.
    p_value : float
        Part of the samples of the bootstrap with at least this deviance; NaN if none were asked for. Small values are
        evidence against the lognormal.
    independent_p_value : float
        The same by chi-square, as if all histories were independent: close to 1 for stripes of the same records,
        whatever the curve.
    residuals : ndarray, shape (levels,)
        Fraction less curve at each level, over the standard deviation of a binomial fraction.
    levels : ndarray, shape (levels,)
    resampled : {'', 'clusters', 'histories'}
        What the samples consist of: clusters of records, or independent histories for a curve of counts.
    n_resamples : int
        Samples with a fit; those without take no part.
    """

    deviance: float
    degrees_of_freedom: int
    p_value: float
    independent_p_value: float
    residuals: FloatArray
    levels: FloatArray
    resampled: str = ""
    n_resamples: int = 0
    im: str = ""

    def _facts(self) -> list[tuple[str, str]]:
        facts = [("deviance", f"{self.deviance:.4g} on {self.degrees_of_freedom} degrees of freedom")]
        if self.resampled:
            facts.append(("p-value", f"{self.p_value:.3g} by {self.n_resamples} samples of {self.resampled}"))
        facts.append(("p-value of independent histories", f"{self.independent_p_value:.3g}"))
        worst = int(np.argmax(np.abs(self.residuals)))
        where = f"{self.residuals[worst]:.2g} at {self.levels[worst]:g}{blank_unit(self.im)}"
        return [*facts, ("largest residual", where)]


def goodness_of_fit(curve: Fragility, n_resamples: int, rng: Any) -> GoodnessOfFit:
    """See `Fragility.goodness_of_fit`."""
    from scipy.special import gammaincc

    number = as_count("n_resamples", n_resamples, 0)
    counted = curve.histories > 0.0
    levels, collapses, histories = curve.levels[counted], curve.collapses[counted], curve.histories[counted]
    if not len(levels) or not np.isfinite(curve.deviance):
        raise DondoloError("goodness of fit: the curve was not fitted to levels")
    chance = _chances(curve, levels)
    residuals = (collapses / histories - chance) * np.sqrt(histories / (chance * (1.0 - chance)))
    dof = curve.deviance_dof
    found = GoodnessOfFit(
        deviance=curve.deviance,
        degrees_of_freedom=dof,
        p_value=np.nan,
        independent_p_value=float(gammaincc(0.5 * dof, 0.5 * curve.deviance)) if dof else 1.0,
        residuals=residuals,
        levels=levels,
        im=curve.im,
    )
    if number == 0:
        return found
    if curve.deviance_dof != len(levels) - 2:
        raise DondoloError("n_resamples: curves that were fitted together have no bootstrap of their own")
    generator = as_generator(rng)
    if curve.sample is not None:
        counts, what = _draw_clusters(curve, curve.sample, number, generator), "clusters"
    else:
        if np.any(collapses % 1.0) or np.any(histories % 1.0):
            raise DondoloError("n_resamples: weighted counts cannot be resampled: counts of histories must be integers")
        drawn = generator.binomial(histories.astype(np.int64), chance, size=(number, len(levels))).astype(np.float64)
        counts, what = (levels, drawn, np.broadcast_to(histories, drawn.shape)), "histories"
    deviances = np.array([one.deviance for one in fit_curves(*counts) if one.status in constants().fitted])
    p_value = (1 + np.count_nonzero(deviances >= curve.deviance)) / (1 + len(deviances))
    return dataclasses.replace(found, p_value=float(p_value), resampled=what, n_resamples=len(deviances))


def _chances(curve: Fragility, levels: FloatArray) -> FloatArray:
    """Probabilities of the curve, of the walls that can collapse, away from 0 and 1, where a residual has no scale."""
    tiny = np.finfo(np.float64).tiny
    chances: FloatArray = np.clip(
        np.asarray(curve(levels)) / curve.upper_asymptote, tiny, 1.0 - np.finfo(np.float64).eps
    )
    return chances


def _draw_clusters(
    curve: Fragility, sample: Sample, number: int, generator: np.random.Generator
) -> tuple[FloatArray, FloatArray, FloatArray]:
    """Levels, collapses and histories (samples, levels) of samples of clusters of which the curve is true."""
    labels = tuple(dict.fromkeys(sample.clusters))
    if len(labels) < 2:
        raise InputError("n_resamples: at least two records or events are needed to draw from")
    chance = _true_outcomes(sample, _chances(curve, sample.levels), generator)
    places = {label: place for place, label in enumerate(labels)}
    of_record = np.array([places[label] for label in sample.clusters])
    of_history = of_record[sample.record_index]
    members = [np.flatnonzero(of_history == place) for place in range(len(labels))]
    collapses, histories = np.empty((2, number, len(sample.levels)))
    for i in range(number):
        drawn = np.concatenate([members[place] for place in generator.integers(0, len(members), len(members))])
        # One number for a history at all levels: those that are changed by chance change together.
        outcomes = generator.random(len(drawn)) < chance[:, drawn]
        ran = sample.ran[:, drawn]
        collapses[i], histories[i] = (outcomes & ran).sum(axis=1), ran.sum(axis=1)
    return sample.levels, collapses, histories


def _true_outcomes(sample: Sample, chance: FloatArray, generator: np.random.Generator) -> FloatArray:
    """Probability of collapse (levels, histories), 0 or 1 but for one history a level; its sums are the curve's."""
    outcomes = (sample.collapsed & sample.ran).astype(np.float64)
    # How near a history is to the other outcome; equal ones in the order of chance
    rank = outcomes.sum(axis=0) + 0.5 * generator.random(outcomes.shape[1])
    for level, row in enumerate(outcomes):
        ran = sample.ran[level]
        missing = chance[level] * np.count_nonzero(ran) - row.sum()
        rises = missing > 0.0
        able = np.flatnonzero(ran & (row == (0.0 if rises else 1.0)))
        able = able[np.argsort(-rank[able] if rises else rank[able])]
        row[able] += np.sign(missing) * np.clip(abs(missing) - np.arange(len(able)), 0.0, 1.0)
    return outcomes


def refit(curve: Fragility, low: float, high: float) -> Fragility:
    """See `Fragility.refit`."""
    low, high = as_number("low", low), as_number("high", high)
    kept = (curve.levels >= low) & (curve.levels <= high)
    if not kept.any():
        raise argument_error("out_of_range", "low", f" = {low:g}, high = {high:g}: there are no levels between them")
    sample = curve.sample
    if sample is not None:
        sample = dataclasses.replace(
            sample, levels=sample.levels[kept], collapsed=sample.collapsed[kept], ran=sample.ran[kept]
        )
    return fit(
        curve.levels[kept],
        curve.collapses[kept],
        curve.histories[kept],
        im=curve.im,
        wall=curve.wall,
        edp_threshold=curve.edp_threshold,
        upper_asymptote=curve.upper_asymptote,
        sample=sample,
    )
