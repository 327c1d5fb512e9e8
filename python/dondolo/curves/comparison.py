"""Comparison of two fragility curves."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from dondolo._base.arguments import FloatArray, argument_error, wrong_type
from dondolo._base.shown import Shown
from dondolo._fortran.curves import compare_parameters
from dondolo._storage.saved import Saved
from dondolo.curves.clusters import freedom
from dondolo.curves.curve import Curve
from dondolo.curves.fragility import Fragility
from dondolo.errors import InputError

Interval = tuple[float, float]


@dataclass(frozen=True, repr=False, kw_only=True)
class Comparison(Shown, Saved):
    """Result of the comparison of two curves.

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
        raise argument_error("not_together", "im", f" = '{first.im}' and '{second.im}': must be the same")
    for curve in (first, second):
        curve._quantile(confidence)
        if curve.errors == "clustered" and not curve.parts:
            raise InputError(
                "curves: that of one wall of a population, or of a population read from files, has no records of its"
                " own: compare curves of Stripes.fit or of a typology computed in Python"
            )
    if first.errors != second.errors:
        raise InputError(f"standard errors: {first.errors} and {second.errors}: both must be of one kind")
    # In ln theta and ln beta
    scales = np.array([1.0, 1.0 / first.beta]), np.array([1.0, 1.0 / second.beta])
    if first.errors == "naive":
        roots = (np.diag(scale) @ _root(curve.covariance) for curve, scale in zip((first, second), scales, strict=True))
        changes = np.hstack(list(roots)).T
        return _comparison(first, second, ("naive", 0), changes, (np.inf, np.inf), confidence)
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
            parts += [(changes, len(labels) - 1) for labels, changes in several]
    variances = [(np.square(part).sum(axis=0), number) for part, number in parts]
    degrees = [freedom([(float(own[i]), number) for own, number in variances]) for i in range(2)]
    changes = np.concatenate([part for part, _ in parts])
    return _comparison(first, second, (pairing, shared), changes, degrees, confidence)


def _root(covariance: FloatArray) -> FloatArray:
    """A matrix whose product with its transpose is a covariance."""
    values, vectors = np.linalg.eigh(covariance)
    root: FloatArray = vectors * np.sqrt(np.maximum(values, 0.0))
    return root


def _joint(several: Sequence[tuple[tuple[str, ...], FloatArray]]) -> FloatArray:
    """Sum of changes, of which those of the same cluster come together."""
    place = {
        label: number for number, label in enumerate(dict.fromkeys(one for labels, _ in several for one in labels))
    }
    changes = np.zeros((len(place), 2))
    for labels, own in several:
        changes[[place[label] for label in labels]] += own
    return changes


def _comparison(
    first: Fragility,
    second: Fragility,
    pairing: tuple[str, int],
    changes: FloatArray,
    degrees: Sequence[float],
    confidence: float,
) -> Comparison:
    """A comparison from the changes (clusters, 2) of the logarithms of both ratios if each cluster is left out."""
    ratios = np.array([first.theta / second.theta, first.beta / second.beta])
    found = [
        compare_parameters(ratio, np.ascontiguousarray(own), number, confidence)
        for ratio, own, number in zip(ratios.tolist(), changes.T, degrees, strict=True)
    ]
    (interval, p_value), (beta_interval, beta_p_value) = found
    return Comparison(
        pairing=pairing[0],
        shared=pairing[1],
        ratio=float(ratios[0]),
        ratio_interval=interval,
        p_value=p_value,
        beta_ratio=float(ratios[1]),
        beta_interval=beta_interval,
        beta_p_value=beta_p_value,
        curves_p_value=_hotelling(np.log(ratios), changes.T @ changes, min(degrees)),
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
