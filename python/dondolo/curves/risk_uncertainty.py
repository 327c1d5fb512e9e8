"""Uncertainty of an annual frequency of collapse: that of the fragility, beside that of the hazard.

One curve
    ln theta and 1/beta, the slope of the probit regression, are drawn from the distribution that the intervals of the
    curve rest on: normal with its covariance, times the factor of Student's t with its degrees of freedom. Each draw
    has an annual frequency in closed form. A draw with a slope that is not positive counts as level at 1/2, the limit
    of a curve without bound of beta.
Curve of a population
    The frequency is a sum over walls and records. Left out one at a time, to first order, a wall or a cluster of
    records changes it; the sums of the squares of the changes by records and by walls are its variance, of which the
    degrees of freedom are Satterthwaite's. ln lambda is drawn from Student's t with it. Results that were read back do
    not know their records: there the draws are those of the lognormal fitted to the mean curve, in proportion.
Hazard
    All draws are integrated over the mean hazard, and over each of its fractiles: an interval for each. A fractile of
    the hazard gives the same fractile of the frequency only where one branch of the logic tree is above another at all
    levels, which is why they are not mixed into one distribution. Beyond its levels the hazard is not known: intervals
    reach from the lower end for the least that it may be there to the upper end for the most; what levels below the
    lowest may add is that of the estimate, for the tail of a drawn curve there says nothing.

docs/reading_a_curve.md explains what an interval covers: the choice of the records, and of the walls.
"""

from __future__ import annotations

import os
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from dondolo._base.arguments import FloatArray, as_count, as_generator, tails
from dondolo._base.shown import Shown
from dondolo._storage import tables
from dondolo._storage.saved import Saved
from dondolo.curves.clusters import freedom
from dondolo.curves.fragility import Fragility
from dondolo.curves.mean_curve import MeanCurve
from dondolo.curves.risk import Risk, between, risk_of
from dondolo.curves.wording import errors_in_words
from dondolo.errors import DondoloError
from dondolo.hazard.hazard import HazardCurve
from dondolo.hazard.integrals import nodes, of_lognormal

if TYPE_CHECKING:
    from matplotlib.axes import Axes

Interval = tuple[float, float]


@dataclass(frozen=True, eq=False, repr=False, kw_only=True)
class RiskUncertainty(Shown, Saved):
    """Distribution of an annual frequency of collapse, for the mean hazard and for each of its fractiles.

    Attributes
    ----------
    risk : Risk
        The estimate; frequencies are its lower bounds, as `Risk.annual_frequency`.
    annual_frequency : ndarray, shape (draws,)
        Draws for the mean hazard [1/year], with the least that it may be beyond its levels.
    upper : ndarray, shape (draws,)
        The same with the most that it may be there.
    estimates : dict
        Fractile of the hazard -> annual frequency for it [1/year].
    fractiles : dict
        Fractile of the hazard -> draws for it, shape (draws,) [1/year], with the least beyond its levels.
    upper_fractiles : dict
        The same with the most.
    kind : str
        What was drawn, in words.
    degrees_of_freedom : float
        Of Student's t.

    Examples
    --------
    >>> import dondolo as dd
    >>> hazard = dd.HazardCurve([0.05, 0.5, 3.0], [0.05, 1e-3, 1e-7], fractiles={0.84: [0.1, 2e-3, 2e-7]})
    >>> risk = dd.fit_fragility([0.2, 0.4], [11, 33], 44, im="pga").risk(hazard)
    >>> list(risk.uncertainty(n_draws=200).table())
    ['hazard', 'annual_frequency', 'low', 'high']
    """

    risk: Risk
    annual_frequency: FloatArray
    upper: FloatArray
    estimates: dict[float, float]
    fractiles: dict[float, FloatArray]
    upper_fractiles: dict[float, FloatArray]
    kind: str
    degrees_of_freedom: float

    def interval(self, *, confidence: float = 0.95, hazard: float | None = None) -> Interval:
        """Confidence interval of the annual frequency, whatever the hazard may be beyond its levels.

        Parameters
        ----------
        confidence : float
            Between 0 and 1.
        hazard : float, optional
            Fractile of the hazard; the mean if left out.

        Returns
        -------
        low, high : float
            [1/year]; inf where the data leave it open.

        Raises
        ------
        InputError
            A confidence that is not between 0 and 1, a fractile that the hazard does not have.
        """
        if hazard is not None:
            self.risk.hazard.fractile(hazard)
        draws = (self.annual_frequency, self.upper)
        if hazard is not None:
            draws = self.fractiles[float(hazard)], self.upper_fractiles[float(hazard)]
        low, high = (
            float(np.quantile(of_end, tail, method="closest_observation"))
            for of_end, tail in zip(draws, tails(confidence), strict=True)
        )
        return low, high

    def table(self, *, confidence: float = 0.95) -> tables.Table:
        """Annual frequency and its interval for the mean hazard and each fractile, as columns."""
        cases: list[float | None] = [None, *self.fractiles]
        ends = [self.interval(confidence=confidence, hazard=one) for one in cases]
        return {
            "hazard": ["mean" if one is None else f"{one:g}" for one in cases],
            "annual_frequency": [self.risk.annual_frequency, *self.estimates.values()],
            "low": [low for low, _ in ends],
            "high": [high for _, high in ends],
        }

    def to_frame(self, *, confidence: float = 0.95) -> Any:
        """The same as a pandas DataFrame."""
        return tables.frame(self.table(confidence=confidence))

    def to_csv(self, path: str | os.PathLike[str], *, confidence: float = 0.95) -> None:
        """Write the same to a file, whose folder must exist."""
        table = self.table(confidence=confidence)
        tables.write_csv(path, table, [*tables.lines_of(self._facts()), f"confidence: {confidence:g}"])

    def plot(self, ax: Axes | None = None, *, confidence: float = 0.95, **options: Any) -> Axes:
        """Draw the distribution for the mean hazard and for each fractile, with the intervals.

        Parameters
        ----------
        ax : Axes, optional
            Where to draw; a new figure if left out.
        confidence : float
            Of the intervals, between 0 and 1.
        **options
            Parts to leave out by False (`legend`, `title`, `band`, `points`), and keywords of Matplotlib for the lines:
            see docs/printing.md.

        Returns
        -------
        Axes
            Probability that the annual frequency is less, against it on a logarithmic axis.
        """
        from dondolo.curves.plots_risk import draw_uncertainty

        return draw_uncertainty(self, ax, confidence, options)

    def _facts(self) -> list[tuple[str, str]]:
        facts = [
            ("mean annual frequency of collapse", between(*self.risk.bounds, "a year")),
            ("95 % interval", "{:.4g} to {:.4g}".format(*self.interval())),
        ]
        for q, estimate in self.estimates.items():
            low, high = self.interval(hazard=q)
            facts.append((f"fractile {q:g} of the hazard", f"{estimate:.4g} ({low:.4g} to {high:.4g})"))
        return [*facts, ("draws", f"{len(self.annual_frequency)}, {self.kind}")]


def uncertainty(risk: Risk, n_draws: int, rng: Any) -> RiskUncertainty:
    """Distribution of the annual frequency of a risk: see `Risk.uncertainty`."""
    count, generator = as_count("n_draws", n_draws, 100), as_generator(rng)
    risks = {q: _risk(risk.fragility, hazard) for q, hazard in risk.hazard._curves().items()}
    curve = risk.fragility
    if not isinstance(curve, Fragility | MeanCurve):
        raise DondoloError("uncertainty: no standard errors are known of this curve")
    if isinstance(curve, MeanCurve) and curve.knows_records:
        if curve.fit.errors in ("few_walls", "one_wall"):
            curve.fit._need_errors()
        degrees, _, kind = _of_population(curve, risk.hazard)
        steps = _students(generator, count, degrees)
        draws = [
            np.multiply.outer(one.bounds, np.exp(_of_population(curve, one.hazard)[1] * steps))
            for one in (risk, *risks.values())
        ]
    else:
        fit = curve if isinstance(curve, Fragility) else curve.fit
        degrees, kind = fit.degrees_of_freedom, errors_in_words(fit)
        theta, beta = _parameters(fit, count, generator)
        of_fit = [_risk(fit, one.hazard) for one in (risk, *risks.values())]
        draws = [_frequencies(fit, theta, beta, one) for one in of_fit]
        if fit is not curve:
            kind += ", by the lognormal fitted to the mean"
            draws = [
                own * np.divide(one.bounds, by_fit.bounds)[:, None]
                for own, one, by_fit in zip(draws, (risk, *risks.values()), of_fit, strict=True)
            ]
    return RiskUncertainty(
        risk=risk,
        annual_frequency=draws[0][0],
        upper=draws[0][1],
        estimates={q: one.annual_frequency for q, one in risks.items()},
        fractiles={q: own[0] for q, own in zip(risks, draws[1:], strict=True)},
        upper_fractiles={q: own[1] for q, own in zip(risks, draws[1:], strict=True)},
        kind=kind,
        degrees_of_freedom=degrees,
    )


def _risk(curve: Any, hazard: HazardCurve) -> Risk:
    from dondolo.errors import silent

    # The ends of a fractile are those of the mean, of which was warned.
    with silent():
        return risk_of(curve, hazard)


def _students(generator: np.random.Generator, count: int, degrees: float) -> FloatArray:
    """Draws of Student's t; of the normal distribution for infinite degrees of freedom."""
    normal = generator.standard_normal(count)
    return normal if np.isinf(degrees) else normal * np.sqrt(degrees / generator.chisquare(degrees, count))


def _parameters(curve: Fragility, count: int, generator: np.random.Generator) -> tuple[FloatArray, FloatArray]:
    """Draws of theta and beta; beta is inf where the slope is not positive."""
    curve._need_errors()
    # Covariance of ln theta and 1/beta
    scale = np.diag([1.0, -1.0 / curve.beta**2])
    values, vectors = np.linalg.eigh(scale @ curve.covariance @ scale)
    steps = generator.standard_normal((count, 2)) * np.sqrt(np.maximum(values, 0.0)) @ vectors.T
    degrees = curve.degrees_of_freedom
    if np.isfinite(degrees):
        steps *= np.sqrt(degrees / generator.chisquare(degrees, (count, 1)))
    slope = 1.0 / curve.beta + steps[:, 1]
    with np.errstate(divide="ignore"):
        beta = 1.0 / np.maximum(slope, 0.0)
    return curve.theta * np.exp(steps[:, 0]), beta


def _frequencies(curve: Fragility, theta: FloatArray, beta: FloatArray, risk: Risk) -> FloatArray:
    """Annual frequencies of each draw, for the least and the most that the hazard may be beyond its levels."""
    hazard = risk.hazard
    level = np.isinf(beta)
    parts = of_lognormal(theta, np.where(level, 1.0, beta), hazard)
    flat = np.inf if hazard.endless else 0.5 * hazard.annual_frequency[0]
    least = curve.upper_asymptote * np.where(level, flat, parts.inside + parts.above)
    if hazard.endless:
        return np.stack([least, least])
    above = np.where(level, 0.5 * hazard.annual_frequency[-1], parts.above)
    most = least + curve.upper_asymptote * (hazard.annual_frequency[-1] - above) + risk.below[1]
    return np.stack([least, most])


def _of_population(curve: MeanCurve, hazard: HazardCurve) -> tuple[float, float, str]:
    """Degrees of freedom, standard error of ln lambda, and of what, for the curve of a population."""
    u, weights = nodes(hazard, curve.reach)
    found = curve.changes(np.exp(u), weights)
    whole = float(weights @ curve(np.exp(u)))
    if not whole > 0.0:
        raise DondoloError("uncertainty: nothing collapses at the levels of the hazard curve")
    variances = [(float(changes @ changes), len(changes) - 1) for changes in found.values()]
    kind = " and ".join(f"{len(changes)} {what}" for what, changes in found.items())
    return freedom(variances), float(np.sqrt(sum(variance for variance, _ in variances))) / whole, kind
