"""Risk: how often a wall collapses, from its fragility and the hazard of its site.

The hazard curve H(x) is the mean annual frequency of IM > x. With the fragility P(C | x) the mean annual frequency of
collapse is (Cornell and Krawinkler 2000; McGuire 2004)

    lambda = integral of P(C | x) |dH(x)|.

Hazard
    Levels and frequencies are joined by straight lines of ln H against ln x: between two levels H is a power law,
    H(x) = H_j (x/x_j)^-k_j. So the integral over a step is that of P k_j H d(ln x), by Gauss's rule in panels that are
    halved until the integral of each changes by less than its share of 10^-8 of the whole.
Beyond the levels
    A curve is given between its lowest and highest level, and what lies outside is not made up but bounded. P does not
    fall with x, so that the events above the highest level x_n contribute between P(x_n) H(x_n) and H(x_n). Those below
    the lowest, x_1, contribute at least 0, and at most the integral with the first power law continued to x = 0: hazard
    curves bend down on logarithmic axes, they are steeper at rare levels than at frequent ones. `Risk.frequency` is the
    lower bound. Hazard curves should begin where nothing collapses and end where nearly all does; a warning says when
    the bounds differ by more than 1 %.
Power laws
    With H = k0 x^-k for all x, and a lognormal fragility, it is (Cornell 1996)

        lambda = k0 theta^-k exp(k^2 beta^2/2).

    For k > 0 and a P that falls more slowly than x^k towards x = 0, there is no finite frequency, and an error says so.
Time
    Events are a Poisson process: P(at least one collapse in t years) = 1 - exp(-lambda t); the return period is
    1/lambda. What stands after a collapse is the same wall.

Units are those of dondolo: accelerations in g, all else in SI units. Hazard is often published as a return period,
H = 1/T, or as the probability p of being exceeded in t years, H = -ln(1 - p)/t.

References: Cornell (1996), Calculating building seismic performance reliability: a basis for multi-level design norms,
11th World Conference on Earthquake Engineering, paper 2122; Cornell and Krawinkler (2000), Progress and challenges in
seismic performance assessment, PEER Center News 3(2); McGuire (2004), Seismic hazard and risk analysis, EERI MNO-10.
"""

from __future__ import annotations

import functools
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from dondolo import _binding, tables
from dondolo._arguments import FloatArray, as_array, as_levels, as_number, shaped
from dondolo.errors import DondoloError, InputError
from dondolo.fragility import Fragility
from dondolo.hazard import HazardCurve

Curve = Fragility | Callable[[Any], Any]

# Relative error that an integral aims at
_TOLERANCE = 1e-8
# The least part of that error that a panel is allowed
_SMALLEST_SHARE = 1e-3
# Points of Gauss's rule in a panel, and how often a panel is halved
_NODES = 8
_HALVINGS = 60
# A range without end is cut so far away, in ln x, and into such steps; the lowest must not add more than this part
_FAR = 50.0
_STEP = 0.5
_NEGLIGIBLE = 1e-12
# Bounds that differ by more than this are worth a warning
_WIDE = 0.01


@dataclass(frozen=True, eq=False, repr=False)
class Risk:
    """Mean annual frequency of collapse, and where it comes from.

    Attributes
    ----------
    fragility : Fragility or callable
    hazard : HazardCurve
    inside : float
        What the range of the hazard curve contributes [1/year].
    below, above : (float, float)
        Bounds of what intensities below and above that range contribute [1/year]; (0, 0) for a power law without end.
    error : float
        Estimated error of the integration of `inside` [1/year].
    """

    fragility: Curve
    hazard: HazardCurve
    inside: float
    below: tuple[float, float]
    above: tuple[float, float]
    error: float

    @property
    def bounds(self) -> tuple[float, float]:
        """Bounds of the mean annual frequency of collapse [1/year]."""
        return (self.inside + self.below[0] + self.above[0], self.inside + self.below[1] + self.above[1])

    @property
    def frequency(self) -> float:
        """Mean annual frequency of collapse, its lower bound [1/year]."""
        return self.bounds[0]

    @property
    def return_period(self) -> float:
        """Mean time between collapses [year]; inf where nothing collapses."""
        return 1.0 / self.frequency if self.frequency > 0.0 else np.inf

    def probability(self, years: float) -> float:
        """Probability of a collapse within some years.

        Parameters
        ----------
        years : float
            Length of time, not negative.

        Returns
        -------
        float
        """
        time = as_number("years", years)
        if not time >= 0.0:
            raise InputError(f"years = {time:g}: must not be negative")
        return float(-np.expm1(-self.frequency * time))

    def density(self, x: ArrayLike) -> Any:
        """Deaggregation: what intensities contribute to the frequency, P(C | x) |dH/d(ln x)|.

        Parameters
        ----------
        x : array_like
            Intensities, positive.

        Returns
        -------
        float or ndarray, shape of x
            [1/year] a unit of ln x; 0 beyond the levels of the hazard curve.
        """
        values = as_levels(x)
        if not np.all(values > 0.0):
            raise InputError("x: must be positive")
        flat = values.ravel()
        return shaped(np.where(self.hazard._covers(flat), self._integrand(np.log(flat)), 0.0), values)

    def deaggregate(self, edges: ArrayLike) -> FloatArray:
        """Deaggregation: what the intensities between edges contribute to the frequency.

        Parameters
        ----------
        edges : array_like, shape (bins + 1,)
            Intensities, positive and increasing.

        Returns
        -------
        ndarray, shape (bins,)
            [1/year]. Without the part beyond the levels of the hazard curve.
        """
        x = as_array("edges", edges)
        if len(x) < 2 or not np.all(x > 0.0) or not np.all(np.diff(x) > 0.0) or not np.isfinite(x[-1]):
            raise InputError("edges: must be two at least, positive and increasing")
        levels = self.hazard.im_levels
        if not self.hazard.endless:
            x = np.clip(x, levels[0], levels[-1])
        cuts = np.unique(np.concatenate([x, levels[(levels > x[0]) & (levels < x[-1])]]))
        if len(cuts) == 1:
            return np.zeros(len(x) - 1)
        parts, _ = _integrals(self._integrand, np.log(cuts))
        return np.diff(np.append(0.0, np.cumsum(parts))[np.searchsorted(cuts, x)])

    def _integrand(self, u: FloatArray) -> FloatArray:
        return _integrand(self.fragility, self.hazard, u)

    def _facts(self) -> list[tuple[str, str]]:
        low, high = self.bounds
        text = f"{low:.6g} a year" if high == low else f"between {low:.4g} and {high:.4g} a year"
        return [
            ("mean annual frequency of collapse", text),
            ("return period", f"{self.return_period:.6g} years"),
            ("probability in 50 years", f"{self.probability(50.0):.4g}"),
        ]

    def __repr__(self) -> str:
        return "<Risk: " + ", ".join(f"{what} {text}" for what, text in self._facts()) + ">"

    def _repr_html_(self) -> str:
        return tables.html_of("Risk", self._facts())


def mean_annual_frequency(fragility: Curve, hazard: HazardCurve) -> Risk:
    """Mean annual frequency of collapse: the fragility integrated over the hazard.

    Parameters
    ----------
    fragility : Fragility or callable
        A fitted curve, or a function from intensities (an array) to probabilities that do not fall with the intensity,
        such as the `mean` of a typology.
    hazard : HazardCurve
        Of the same intensity measure.

    Returns
    -------
    Risk

    Raises
    ------
    InputError
        The measures differ; the function gives no probabilities.
    DondoloError
        The fragility has no curve; the frequency is not finite.

    Warns
    -----
    DondoloWarning
        Intensities beyond the hazard curve may contribute more than 1 %.

    Notes
    -----
    The docstring of the module dondolo.risk has the formulas.

    Examples
    --------
    >>> from dondolo import fit_fragility
    >>> curve = fit_fragility([0.2, 0.4], [11, 33], 44, im="pga")
    >>> risk = mean_annual_frequency(curve, HazardCurve.power_law(1e-4, 2.5))
    >>> round(risk.return_period, 3)
    186.44
    """
    if not isinstance(hazard, HazardCurve):
        raise InputError(f"hazard: {type(hazard).__name__} is no hazard curve")
    if not callable(fragility):
        raise InputError(f"fragility: {type(fragility).__name__} is no curve")
    # A method knows the measure of its object, as the mean of a typology does; a plain function does not.
    method = fragility.func if isinstance(fragility, functools.partial) else fragility
    im = getattr(method, "im", "") or getattr(getattr(method, "__self__", None), "im", "")
    if im and im != hazard.im:
        raise InputError(f"im = '{im}' of the fragility and '{hazard.im}' of the hazard: must be the same")
    if isinstance(fragility, Fragility):
        fragility._need_fit()

    def integrand(u: FloatArray) -> FloatArray:
        return _integrand(fragility, hazard, u)

    if hazard.endless:
        cuts = np.linspace(-_FAR, _FAR, round(2.0 * _FAR / _STEP) + 1)
        parts, error = _integrals(integrand, cuts)
        # What is still above: between the probability there and 1
        p, h = float(_probability(fragility, np.exp(cuts[-1:]))[0]), float(hazard(np.exp(cuts[-1])))
        total = float(parts.sum()) + p * h
        if parts[0] > _NEGLIGIBLE * total:
            raise DondoloError(
                "the mean annual frequency is not finite, or hardly: towards an intensity of 0 the probability falls"
                " no faster than the power law rises; give levels of the hazard instead"
            )
        return Risk(fragility, hazard, total, (0.0, 0.0), (0.0, 0.0), error + (1.0 - p) * h)
    cuts = np.log(hazard.im_levels)
    parts, error = _integrals(integrand, cuts)
    inside = float(parts.sum())
    rest = _integrals(integrand, np.linspace(cuts[0] - _FAR, cuts[0], round(_FAR / _STEP) + 1))[0]
    most = float(rest.sum()) if rest[0] <= _NEGLIGIBLE * (inside + rest.sum()) else np.inf
    last = float(hazard.annual_frequency[-1])
    surely = last * float(_probability(fragility, hazard.im_levels[-1:])[0])
    risk = Risk(fragility, hazard, inside, (0.0, most), (surely, last), error)
    low, high = risk.bounds
    if low < (1.0 - _WIDE) * high:
        unit = f" {_binding.unit_of(hazard.im)}".rstrip()
        first, last = hazard.im_levels[[0, -1]]
        _binding.warn(
            [
                f"the hazard curve, {first:g} to {last:g}{unit}, is too short: the mean annual frequency of collapse"
                f" lies between {low:.3g} and {high:.3g}"
            ]
        )
    return risk


def _probability(fragility: Curve, x: FloatArray) -> FloatArray:
    """Probabilities of collapse, checked."""
    p = np.asarray(fragility(x), dtype=np.float64)
    if p.shape != x.shape:
        raise InputError(f"fragility: gives an array of shape {p.shape} for intensities of shape {x.shape}")
    if not np.all((p >= 0.0) & (p <= 1.0)):
        raise InputError(f"fragility = {p[~((p >= 0.0) & (p <= 1.0))][0]:g}: must lie between 0 and 1")
    return p


def _integrand(fragility: Curve, hazard: HazardCurve, u: FloatArray) -> FloatArray:
    """P(C | x) |dH/d(ln x)| at u = ln x."""
    h, slope = hazard._continued(u)
    return _probability(fragility, np.exp(u)) * slope * h


def _integrals(integrand: Callable[[FloatArray], FloatArray], cuts: FloatArray) -> tuple[FloatArray, float]:
    """Integrals between cuts, and their estimated error.

    Panels are halved where that changes their integral, all at once: a call of the mean of many walls takes long,
    whatever the number of points, and libraries call point by point.
    """
    node, weight = np.polynomial.legendre.leggauss(_NODES)

    def gauss(low: FloatArray, high: FloatArray) -> FloatArray:
        half = 0.5 * (high - low)
        points = (low + half)[:, None] + half[:, None] * node
        return integrand(points.ravel()).reshape(points.shape) @ weight * half

    low, high = cuts[:-1], cuts[1:]
    owner = np.arange(len(low))
    coarse, done, error = gauss(low, high), np.zeros(len(low)), 0.0
    for _ in range(_HALVINGS):
        middle = 0.5 * (low + high)
        fine = gauss(np.append(low, middle), np.append(middle, high)).reshape(2, -1)
        off = np.abs(fine.sum(axis=0) - coarse)
        share = (high - low) / (cuts[-1] - cuts[0])
        total = done.sum() + fine.sum()
        # A jump never earns the share of its panel
        settled = off <= _TOLERANCE * total * np.maximum(share, _SMALLEST_SHARE)
        np.add.at(done, owner[settled], fine.sum(axis=0)[settled])
        error += float(off[settled].sum())
        rough = ~settled
        if not rough.any():
            return done, error
        low, high = np.append(low[rough], middle[rough]), np.append(middle[rough], high[rough])
        owner, coarse = np.tile(owner[rough], 2), fine[:, rough].ravel()
    # What is left are panels about jumps, too narrow to matter
    np.add.at(done, owner, coarse)
    return done, error + float(np.abs(coarse).sum())
