"""Statistics of computed against measured: bias and scatter, curves, single motions, bootstrap over groups."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from scipy.special import log_ndtr, ndtr

#: Fewest specimens of known geometry from which a model error may be given
FEWEST_SPECIMENS = 5
#: Edges of the bins of a reliability table
BINS = np.array([0.0, 0.05, 0.2, 0.4, 0.6, 0.8, 0.95, 1.0])


def log_ratios(measured, computed):
    """ln(measured / computed) where both are positive, and how many computed values are zero.

    A wall that is computed not to move has no ratio; such values are counted, not dropped in silence.
    """
    measured, computed = np.broadcast_arrays(np.asarray(measured, float), np.asarray(computed, float))
    moves = (computed > 0.0) & (measured > 0.0)
    return np.log(measured[moves] / computed[moves]), int(np.sum(computed <= 0.0))


def mean_and_scatter(values) -> dict:
    """Number, mean (bias) and standard deviation of values, each with its standard error."""
    x = np.asarray(values, float)
    n = len(x)
    sd = float(np.std(x, ddof=1)) if n > 1 else float("nan")
    return {
        "n": n,
        "bias": float(np.mean(x)),
        "se_bias": sd / n**0.5,
        "sd": sd,
        "se_sd": sd / (2.0 * (n - 1)) ** 0.5 if n > 1 else float("nan"),
    }


def within_and_between(values, groups) -> dict:
    """Standard deviations within groups and between them, by the one-way analysis of variance with random effects."""
    x, labels = np.asarray(values, float), np.asarray(groups)
    parts = [x[labels == one] for one in dict.fromkeys(labels.tolist())]
    sizes = np.array([len(part) for part in parts])
    means = np.array([part.mean() for part in parts])
    n, k = len(x), len(parts)
    within = sum(float(np.sum((part - part.mean()) ** 2)) for part in parts) / (n - k)
    between = float(np.sum(sizes * (means - x.mean()) ** 2)) / (k - 1)
    typical = (n - np.sum(sizes**2) / n) / (k - 1)
    return {"groups": k, "within": within**0.5, "between": max(0.0, (between - within) / typical) ** 0.5}


def slope(x, y) -> tuple[float, float]:
    """Slope of a straight line by least squares, and its standard error."""
    x, y = np.asarray(x, float), np.asarray(y, float)
    spread = float(np.sum((x - x.mean()) ** 2))
    b = float(np.sum((x - x.mean()) * (y - y.mean())) / spread)
    residual = y - y.mean() - b * (x - x.mean())
    return b, (float(np.sum(residual**2)) / (len(x) - 2) / spread) ** 0.5


@dataclass(frozen=True)
class Lognormal:
    """Median and dispersion of a lognormal fitted to outcomes; NaN if outcomes do not overlap."""

    theta: float
    beta: float

    def __call__(self, x):
        """Probability at levels."""
        return ndtr(np.log(np.asarray(x, float) / self.theta) / self.beta)


def fit_lognormal(x, falls, weights=None) -> Lognormal:
    """Fit a lognormal curve to single outcomes by maximum likelihood.

    Parameters
    ----------
    x : array_like
        Intensity of each test, positive.
    falls : array_like of bool
        Whether the specimen fell.
    weights : array_like, optional
        How often each test counts: numbers of a bootstrap.

    Returns
    -------
    Lognormal
        NaN where all outcomes are alike or do not overlap, or falls become rarer with the intensity.
    """
    z, y = np.log(np.asarray(x, float)), np.asarray(falls, bool)
    w = np.ones(len(z)) if weights is None else np.asarray(weights, float)
    z, y, w = z[w > 0.0], y[w > 0.0], w[w > 0.0]
    none = Lognormal(float("nan"), float("nan"))
    if y.all() or not y.any() or z[y].min() >= z[~y].max():
        return none
    center = np.average(z, weights=w)
    design = np.column_stack([np.ones_like(z), z - center])
    sign = np.where(y, 1.0, -1.0)
    parameters = np.zeros(2)
    value = float(w @ log_ndtr(sign * (design @ parameters)))
    for _ in range(200):
        eta = sign * (design @ parameters)
        mills = np.exp(-0.5 * eta**2 - 0.5 * np.log(2.0 * np.pi) - log_ndtr(eta))
        gradient = design.T @ (w * sign * mills)
        hessian = (design.T * (w * mills * (mills + eta))) @ design
        step = np.linalg.solve(hessian, gradient)
        for _ in range(40):
            tried = parameters + step
            new = float(w @ log_ndtr(sign * (design @ tried)))
            if new >= value:
                break
            step *= 0.5
        if abs(new - value) < 1e-12 * (1.0 + abs(value)) and np.max(np.abs(step)) < 1e-9:
            break
        parameters, value = tried, new
    if parameters[1] <= 0.0:
        return none
    return Lognormal(float(np.exp(center - parameters[0] / parameters[1])), float(1.0 / parameters[1]))


def best_threshold(x, falls) -> float:
    """The one value of an intensity that separates falls from survivals with the fewest errors.

    The middle of all the best ones; above or below all values if that is best.
    """
    x, y = np.asarray(x, float), np.asarray(falls, bool)
    values = np.unique(x)
    tried = np.r_[0.5 * values[0], np.sqrt(values[1:] * values[:-1]), 2.0 * values[-1]]
    right = np.array([np.mean((x >= one) == y) for one in tried])
    return float(np.median(tried[np.isclose(right, right.max())]))


def threshold_across(x, falls, groups):
    """Flags by a threshold that is found, for each group of tests, on all other groups."""
    x, y, labels = np.asarray(x, float), np.asarray(falls, bool), np.asarray(groups)
    flags = np.zeros(len(x), bool)
    for one in dict.fromkeys(labels.tolist()):
        here = labels == one
        flags[here] = x[here] >= best_threshold(x[~here], y[~here])
    return flags


def rightness(computed, measured) -> dict:
    """Share of right flags, false alarms (computed to fall, stood) and misses (computed to stand, fell)."""
    computed, measured = np.asarray(computed, bool), np.asarray(measured, bool)
    return {
        "n": len(measured),
        "fell": int(measured.sum()),
        "computed_to_fall": int(computed.sum()),
        "right": float(np.mean(computed == measured)),
        "always_stands": float(np.mean(~measured)),
        "false_alarms": int(np.sum(computed & ~measured)),
        "misses": int(np.sum(~computed & measured)),
    }


def reliability(probability, falls) -> dict:
    """Brier score, and in how many bins of a reliability table the share agrees within two binomial standard errors.

    Parameters
    ----------
    probability : array_like
        Predicted probability that a specimen falls.
    falls : array_like of bool
        Whether it fell.

    Returns
    -------
    dict
        `brier`; `bins`, those that are not empty; `bins_within`, those that agree.
    """
    p, y = np.asarray(probability, float), np.asarray(falls, float)
    where = np.clip(np.searchsorted(BINS, p, side="right") - 1, 0, len(BINS) - 2)
    filled = within = 0
    for i in range(len(BINS) - 1):
        here = where == i
        n = int(here.sum())
        if n:
            predicted = float(p[here].mean())
            filled += 1
            within += abs(float(y[here].mean()) - predicted) <= 2.0 * (predicted * (1.0 - predicted) / n) ** 0.5
    return {"brier": float(np.mean((p - y) ** 2)), "bins": filled, "bins_within": int(within)}


def bootstrap(groups, statistic: Callable, n: int = 1000, seed: int = 1):
    """Standard errors of a statistic over groups drawn with replacement.

    Parameters
    ----------
    groups : array_like
        Group of each test, such as its waveform: tests of a group are drawn together.
    statistic : callable
        Takes how often each test counts, and returns numbers; NaN where there is no value.
    n : int
        Number of samples.
    seed : int
        Seed of the random numbers.

    Returns
    -------
    ndarray
        Standard deviation of each number over the samples that have it.
    """
    _, place = np.unique(np.asarray(groups), return_inverse=True)
    k = int(place.max()) + 1
    rng = np.random.default_rng(seed)
    drawn = [statistic(np.bincount(rng.integers(0, k, k), minlength=k)[place]) for _ in range(n)]
    return np.nanstd(np.asarray(drawn, float), axis=0, ddof=1)


def model_error(biases, standard_errors) -> dict:
    """How ln(measured median / computed median) varies between specimens of known geometry.

    tau^2 is the variance of the biases less the mean of their squared standard errors; for a new wall it is
    tau sqrt(1 + 1/n), with Student's t of n - 1 degrees of freedom. Below five specimens it is too few to be used.
    """
    x, se = np.asarray(biases, float), np.asarray(standard_errors, float)
    n = len(x)
    if n < 2:
        return {"specimens": n, "bias": float(x.mean()) if n else None, "tau": None, "beta": None, "enough": False}
    tau = max(0.0, float(np.var(x, ddof=1) - np.mean(se**2))) ** 0.5
    return {
        "specimens": n,
        "bias": float(x.mean()),
        "sd": float(np.std(x, ddof=1)),
        "tau": tau,
        "beta": tau * (1.0 + 1.0 / n) ** 0.5,
        "enough": n >= FEWEST_SPECIMENS,
    }
