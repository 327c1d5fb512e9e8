"""Records drawn with replacement, and the curves fitted to them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from dondolo._base.arguments import FloatArray, argument_error, as_count, as_generator, as_levels, shaped, tails
from dondolo._base.shown import Shown
from dondolo._fortran.curves import fit_curves
from dondolo._fortran.library import constants
from dondolo._storage.saved import Saved
from dondolo.curves.sample import Sample
from dondolo.errors import DondoloError

Interval = tuple[float, float]


@dataclass(frozen=True, eq=False, repr=False, kw_only=True)
class Bootstrap(Shown, Saved):
    """Curves fitted to records drawn with replacement.

    Attributes
    ----------
    theta, beta : ndarray, shape (samples,)
        Parameters of each; NaN where a sample has no fit.
    status : ndarray of str, shape (samples,)
        What came of each fit; '' where it failed.
    """

    theta: FloatArray
    beta: FloatArray
    status: np.ndarray[Any, Any]

    @property
    def without_fit(self) -> float:
        """Share of the samples without a fit; they take no part in the intervals."""
        return float(np.mean(np.isnan(self.theta)))

    def interval(self, x: ArrayLike, *, confidence: float = 0.95) -> tuple[Any, Any]:
        """Percentile interval of the probability at levels (of each on its own, not of the curve as a whole).

        Parameters
        ----------
        x : array_like
            Levels of intensity, not negative.
        confidence : float
            Confidence, between 0 and 1.

        Returns
        -------
        low, high : float or ndarray, shape of x

        Raises
        ------
        DondoloError
            No sample has a fit.
        """
        from scipy.special import ndtr

        values = as_levels(x)
        theta, beta = self._fitted()
        with np.errstate(divide="ignore"):
            curves = ndtr(np.log(values.ravel() / theta[:, None]) / beta[:, None])
        curves *= self._ends()[~np.isnan(self.theta), None]
        low, high = np.quantile(curves, tails(confidence), axis=0)
        return shaped(low, values), shaped(high, values)

    def parameter_interval(self, *, confidence: float = 0.95) -> dict[str, Interval]:
        """Percentile intervals of theta and beta.

        Parameters
        ----------
        confidence : float
            Confidence, between 0 and 1.

        Returns
        -------
        dict
            'theta' and 'beta': (low, high).

        Raises
        ------
        DondoloError
            No sample has a fit.
        """
        ends = tails(confidence)
        found = {}
        for name, values in zip(("theta", "beta"), self._fitted(), strict=True):
            low, high = np.quantile(values, ends)
            found[name] = (float(low), float(high))
        return found

    def _ends(self) -> FloatArray:
        """What the curve of each sample tends to."""
        return np.ones_like(self.theta)

    def _fitted(self) -> tuple[FloatArray, FloatArray]:
        fitted = ~np.isnan(self.theta)
        if not fitted.any():
            raise DondoloError("none of the samples of the bootstrap has a fit")
        return self.theta[fitted], self.beta[fitted]

    def __repr__(self) -> str:
        return f"<Bootstrap of {len(self.theta)} samples, {self.without_fit:.1%} without a fit>"

    def _facts(self) -> list[tuple[str, str]]:
        facts = [("samples", str(len(self.theta))), ("without a fit", f"{self.without_fit:.1%}")]
        if self.without_fit < 1.0:
            found = self.parameter_interval()
            facts += [(f"{name}, 95 % interval", f"{low:.4g} to {high:.4g}") for name, (low, high) in found.items()]
        return facts


def draw_records(labels: Sequence[Any], n_resamples: int, rng: Any) -> FloatArray:
    """How often each record comes in each of some samples drawn with replacement: (samples, records).

    Records with the same label are drawn together. Each sample has as many records as there are.
    """
    n_resamples, generator = as_count("n_resamples", n_resamples, 1), as_generator(rng)
    places: dict[Any, int] = {}
    place = [places.setdefault(label, len(places)) for label in labels]
    if len(places) < 2:
        what = "records" if len(labels) < 2 else "events"
        raise argument_error("wrong_length", what, f": at least two are needed to draw from, there is {len(places)}")
    drawn = generator.multinomial(len(places), np.full(len(places), 1.0 / len(places)), size=n_resamples)[:, place]
    # Events with many records must not make a sample count for more histories than there are.
    times: FloatArray = drawn * (len(labels) / drawn.sum(axis=1, keepdims=True))
    return times


def resample(sample: Sample, times: FloatArray) -> Bootstrap:
    """Fit the histories again with each record taken so many times."""
    place = sample.record_index
    collapses = times[:, place] @ sample.collapsed.T.astype(np.float64)
    histories = times[:, place] @ sample.ran.T.astype(np.float64)
    theta, beta, status = fit_samples(sample.levels, np.minimum(collapses, histories), histories)
    return Bootstrap(theta=theta, beta=beta, status=status)


def fit_samples(
    levels: FloatArray, collapses: FloatArray, histories: FloatArray
) -> tuple[FloatArray, FloatArray, np.ndarray[Any, Any]]:
    """Curves of many samples: theta and beta, NaN where a sample has no fit, and the status of each."""
    curves = fit_curves(levels, collapses, histories)
    status = np.array([one.status for one in curves])
    fitted = np.isin(status, constants().fitted)
    theta, beta = (np.array(values) for values in zip(*((one.theta, one.beta) for one in curves), strict=True))
    return np.where(fitted, theta, np.nan), np.where(fitted, beta, np.nan), status
