"""Are two fragility curves the same?"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from dondolo._base.arguments import FloatArray, tails, wrong_type
from dondolo._base.shown import Shown
from dondolo._storage.saved import Saved
from dondolo.curves.clusters import freedom
from dondolo.curves.curve import Curve
from dondolo.curves.fragility import Fragility
from dondolo.errors import InputError

Interval = tuple[float, float]


@dataclass(frozen=True, repr=False, kw_only=True)
class Comparison(Shown, Saved):
    """Two curves compared.

    Attributes
    ----------
    pairing : str
        'paired', both curves have the same clusters of records; 'partly', some of them; 'unpaired', none; 'naive', all
        histories of both are taken for independent.
    shared : int
        Clusters of records that both curves have.
    ratio : float
        Median of the first / median of the second.
    ratio_interval : (float, float)
        Confidence interval of the ratio.
    p_value : float
        Probability of a ratio at least as far from 1 if the medians were equal.
    beta_ratio : float
        Dispersion of the first / dispersion of the second.
    beta_interval : (float, float)
        Confidence interval of that ratio.
    beta_p_value : float
        Probability of a ratio at least as far from 1 if the dispersions were equal.
    curves_p_value : float
        Probability of differences at least as large, in both together, if the curves were one and the same
        (Hotelling's test); NaN where they determine only one of them.
    degrees_of_freedom : float
        Of Student's t for the ratio of the medians; inf for 'naive'.
    """

    pairing: str
    shared: int
    ratio: float
    ratio_interval: Interval
    p_value: float
    beta_ratio: float
    beta_interval: Interval
    beta_p_value: float
    curves_p_value: float
    degrees_of_freedom: float

    def _facts(self) -> list[tuple[str, str]]:
        def ratio(value: float, interval: Interval, p_value: float) -> str:
            return "{:.4g} ({:.4g} to {:.4g}), p {:.3g}".format(value, *interval, p_value)

        return [
            ("pairing", f"{self.pairing}, {self.shared} clusters shared"),
            ("ratio of the medians", ratio(self.ratio, self.ratio_interval, self.p_value)),
            ("ratio of the dispersions", ratio(self.beta_ratio, self.beta_interval, self.beta_p_value)),
            ("p of one and the same curve", f"{self.curves_p_value:.3g}"),
        ]


def compare(one: Curve, other: Curve, *, confidence: float = 0.95) -> Comparison:
    """Compare two curves: see `Curve.compare`."""
    if not isinstance(other, Curve):
        raise wrong_type("other", other, "a fragility curve")
    first, second = one._fitted(), other._fitted()
    if first.im != second.im:
        raise InputError(f"im = '{first.im}' and '{second.im}': must be the same")
    for curve in (first, second):
        curve._quantile(confidence)
        if curve.errors == "clustered" and not curve.parts:
            raise InputError(
                "curves: that of one wall of a population, or of a population that was read back, does not know its"
                " records: compare curves of Stripes.fit or of a typology that was run"
            )
    if first.errors != second.errors:
        raise InputError(f"standard errors: {first.errors} and {second.errors}: both must be of one kind")
    # In ln theta and ln beta
    scales = np.array([1.0, 1.0 / first.beta]), np.array([1.0, 1.0 / second.beta])
    if first.errors == "naive":
        covariance = sum(
            np.outer(scale, scale) * curve.covariance for curve, scale in zip((first, second), scales, strict=True)
        )
        return _comparison(first, second, ("naive", 0), np.asarray(covariance), (np.inf, np.inf), confidence)
    parts: list[tuple[FloatArray, int]] = []
    pairing, shared = "unpaired", 0
    for kind in dict.fromkeys(part.kind for curve in (first, second) for part in curve.parts):
        several = [
            (part.labels, sign * part.changes * scale)
            for curve, scale, sign in zip((first, second), scales, (1.0, -1.0), strict=True)
            for part in curve.parts
            if part.kind == kind
        ]
        common = set.intersection(*(set(labels) for labels, _ in several)) if len(several) == 2 else set()
        if kind == "records":
            shared = len(common)
            same = all(shared == len(labels) for labels, _ in several)
            pairing = "paired" if same else "partly" if shared else "unpaired"
        if common:
            # No more degrees of freedom than the curve with fewer clusters has
            parts.append((_joint(several), min(len(labels) for labels, _ in several) - 1))
        else:
            parts += [(changes.T @ changes, len(labels) - 1) for labels, changes in several]
    covariance = np.sum([part for part, _ in parts], axis=0)
    degrees = [freedom([(float(part[i, i]), number) for part, number in parts]) for i in range(2)]
    return _comparison(first, second, (pairing, shared), covariance, degrees, confidence)


def _joint(several: Sequence[tuple[tuple[str, ...], FloatArray]]) -> FloatArray:
    """Covariance of a sum of changes, of which those of the same cluster come together."""
    place = {
        label: number for number, label in enumerate(dict.fromkeys(one for labels, _ in several for one in labels))
    }
    changes = np.zeros((len(place), 2))
    for labels, own in several:
        changes[[place[label] for label in labels]] += own
    covariance: FloatArray = changes.T @ changes
    return covariance


def _comparison(
    first: Fragility,
    second: Fragility,
    pairing: tuple[str, int],
    covariance: FloatArray,
    degrees: Sequence[float],
    confidence: float,
) -> Comparison:
    from scipy.special import stdtr, stdtrit

    difference = np.log([first.theta / second.theta, first.beta / second.beta])
    found: list[tuple[float, Interval, float]] = []
    for value, variance, freedom_ in zip(difference, np.diag(covariance), degrees, strict=True):
        # Student's t with more than 1e15 degrees of freedom is the normal distribution to rounding.
        number = min(freedom_, 1e15)
        error = float(np.sqrt(variance))
        half = float(stdtrit(number, tails(confidence)[1])) * error
        # Curves of the same histories do not differ at all.
        p_value = float(2.0 * stdtr(number, -abs(value) / error)) if error > 0.0 else float(value == 0.0)
        found.append((float(np.exp(value)), (float(np.exp(value - half)), float(np.exp(value + half))), p_value))
    (ratio, interval, p_value), (beta_ratio, beta_interval, beta_p_value) = found
    return Comparison(
        pairing=pairing[0],
        shared=pairing[1],
        ratio=ratio,
        ratio_interval=interval,
        p_value=p_value,
        beta_ratio=beta_ratio,
        beta_interval=beta_interval,
        beta_p_value=beta_p_value,
        curves_p_value=_hotelling(difference, covariance, min(degrees)),
        degrees_of_freedom=degrees[0],
    )


def _hotelling(difference: FloatArray, covariance: FloatArray, degrees: float) -> float:
    """Probability of differences at least as large if there were none, by Hotelling's T squared."""
    from scipy.special import fdtrc

    if not difference.any():
        return 1.0
    if np.linalg.matrix_rank(covariance, hermitian=True) != 2 or degrees <= 1.0:
        return np.nan
    squared = float(difference @ np.linalg.solve(covariance, difference))
    # Without an end to the degrees of freedom it is chi-squared with two of them.
    if np.isinf(degrees):
        return float(np.exp(-0.5 * squared))
    return float(fdtrc(2.0, degrees - 1.0, squared * (degrees - 1.0) / (2.0 * degrees)))
