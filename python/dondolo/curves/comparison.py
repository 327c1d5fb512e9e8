"""Are two fragility curves the same?"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, Literal

import numpy as np

from dondolo._base.arguments import as_generator, instance_of, one_of, tails
from dondolo._fortran.library import warn
from dondolo._storage.saved import Saved
from dondolo.curves import fragility
from dondolo.curves.bootstrap import draw_records, resample
from dondolo.curves.fragility import Fragility
from dondolo.errors import DondoloError, DondoloWarning, InputError


@dataclass(frozen=True, kw_only=True)
class Comparison(Saved):
    """Two curves compared.

    Attributes
    ----------
    method : str
        'likelihood' or 'bootstrap'.
    p_value : float
        Probability of a difference at least as large if the curves were one and the same ('likelihood'), or if their
        medians were ('bootstrap').
    ratio : float
        Median of the first / median of the second.
    ratio_interval : (float, float)
        Confidence interval of the ratio.
    statistic : float
        Twice the gain in log likelihood of two curves over one, chi-squared with 2 degrees of freedom if there is but
        one; NaN for 'bootstrap'.
    """

    method: str
    p_value: float
    ratio: float
    ratio_interval: tuple[float, float]
    statistic: float


def compare(
    first: Fragility,
    second: Fragility,
    *,
    method: Literal["likelihood", "bootstrap"] = "likelihood",
    confidence: float = 0.95,
    n_resamples: int = 2000,
    seed: int | np.random.Generator | None = 0,
    events: Sequence[Any] | None = None,
) -> Comparison:
    """Compare two fragility curves of the same intensity measure.

    Parameters
    ----------
    first, second : Fragility
        Curves with a fit.
    method : {'likelihood', 'bootstrap'}
        Likelihood ratio test of equal theta and beta, for curves from independent records; or bootstrap over records of
        the ratio of the medians, which draws the same records for both where both have the same, and so keeps what they
        share.
    confidence : float
        Confidence of the interval of the ratio.
    n_resamples, seed
        Number of samples of the bootstrap, and seed of its random numbers.
    events : sequence, optional
        A label for each record of the first curve, for the bootstrap of curves from the same records: those with the
        same label are drawn together, as in `Fragility.bootstrap`.

    Returns
    -------
    Comparison

    Raises
    ------
    InputError
        No curves, or curves of different measures; no such method; events where they mean nothing.
    DondoloError
        A curve without a fit, or without what the method needs.

    Warns
    -----
    DondoloWarning
        The curves are of populations, whose walls share their records.
    """
    one_of("method", method, ("likelihood", "bootstrap"))
    for curve in (first, second):
        instance_of("curves", curve, Fragility, "no fragility curve")
    if events is not None and method == "likelihood":
        raise InputError("events: is for method = 'bootstrap'")
    if first.im != second.im:
        raise InputError(f"im = '{first.im}' and '{second.im}': must be the same")
    for curve in (first, second):
        curve._need_fit()
    if any(curve.wall is None and curve.edp_threshold is not None for curve in (first, second)):
        sentence = "walls of a population share their records: the comparison is too sure; its bootstrap tells more"
        warn([DondoloWarning(sentence, "records_shared")])
    if method == "likelihood":
        return _by_likelihood(first, second, confidence)
    return _by_bootstrap(first, second, confidence, n_resamples, seed, events)


def _by_likelihood(first: Fragility, second: Fragility, confidence: float) -> Comparison:
    if np.isnan([first.log_likelihood, second.log_likelihood]).any():
        raise DondoloError("method = 'likelihood': is for curves fitted to counts, not to first collapses")
    pairs = zip(
        (first.levels, first.collapses, first.histories),
        (second.levels, second.collapses, second.histories),
        strict=True,
    )
    together = fragility.fit(*(np.concatenate(pair) for pair in pairs))
    together._need_fit()
    statistic = max(0.0, 2.0 * (first.log_likelihood + second.log_likelihood - together.log_likelihood))
    ratio = first.theta / second.theta
    half = fragility._quantile(confidence) * np.hypot(first.se_ln_theta, second.se_ln_theta)
    # The survival function of chi-squared with 2 degrees of freedom is exp(-x/2).
    return Comparison(
        method="likelihood",
        p_value=float(np.exp(-0.5 * statistic)),
        ratio=ratio,
        ratio_interval=fragility._spread(ratio, half),
        statistic=statistic,
    )


def _by_bootstrap(
    first: Fragility, second: Fragility, confidence: float, n_resamples: int, seed: Any, events: Sequence[Any] | None
) -> Comparison:
    if first.sample is None or second.sample is None:
        raise DondoloError("bootstrap: needs the stripes, so it is for curves that come from Stripes.fit")
    random = as_generator(seed)
    count = first.sample.n_records
    times = draw_records(count, n_resamples, random, events)
    # The same records, by position or, where names are unique, by name
    names = [sample.record_names for sample in (first.sample, second.sample)]
    if names[0] == names[1]:
        others = times
    elif sorted(names[0]) == sorted(names[1]) and len(set(names[0])) == count:
        others = times[:, [names[0].index(name) for name in names[1]]]
    elif events is not None:
        raise InputError("events: is for curves from the same records")
    else:
        others = draw_records(second.sample.n_records, n_resamples, random)
    difference = np.log(resample(first.sample, times).theta)
    difference = difference - np.log(resample(second.sample, others).theta)
    difference = difference[~np.isnan(difference)]
    if not len(difference):
        raise DondoloError("none of the samples of the bootstrap has a fit")
    low, high = np.exp(np.quantile(difference, tails(confidence)))
    below = (np.sum(difference <= 0.0) + 1.0) / (len(difference) + 1.0)
    above = (np.sum(difference >= 0.0) + 1.0) / (len(difference) + 1.0)
    p_value = float(min(1.0, 2.0 * min(below, above)))
    return Comparison(
        method="bootstrap",
        p_value=p_value,
        ratio=first.theta / second.theta,
        ratio_interval=(float(low), float(high)),
        statistic=np.nan,
    )
