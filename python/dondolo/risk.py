"""Risk: how often a wall collapses, from its fragility and the hazard of its site.

The hazard curve H(x) is the mean annual frequency of IM > x. With the fragility P(C | x) the mean annual frequency of
collapse is (Cornell and Krawinkler 2000; McGuire 2004)

    lambda = integral of P(C | x) |dH(x)|.

Hazard
    Levels and frequencies are joined by straight lines of ln H against ln x: between two levels H is a power law,
    H(x) = H_j (x/x_j)^-k_j. So the integral over a step is that of P k_j H d(ln x): of a fitted lognormal in closed
    form, of any other curve by Gauss's rule (dondolo._risk_integrals).
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
    Events are a Poisson process: of one wall P(at least one collapse in t years) = 1 - exp(-lambda t), and the return
    period is 1/lambda. What stands after a collapse is the same wall. A curve with the saturation s is of a wall in
    which something can occur with the probability s, for all events: s (1 - exp(-lambda t/s)).
Populations
    The mean curve gives the mean frequency, lambda = sum(w_i lambda_i)/sum(w_i): the share of the walls lost a year.
    The probability that a wall drawn by weight collapses in t years is another mean,

        sum(w_i (1 - exp(-lambda_i t)))/sum(w_i) <= 1 - exp(-lambda t) <= lambda t:

    walls that never collapse take no part however long the time is, and weak ones collapse once. The mean curve does
    not tell it, only the curves of the walls do.

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
from dondolo._arguments import FloatArray, as_levels, as_number, increasing, shaped
from dondolo._risk_integrals import integrals, lognormal_integrals
from dondolo.errors import DondoloError, InputError
from dondolo.fragility import Fragility
from dondolo.hazard import HazardCurve
from dondolo.typology import Typology

Curve = Fragility | Callable[[Any], Any]

# A range without end is cut so far away, in ln x, and into such steps; the lowest must not add more than this part
_FAR = 50.0
_STEP = 0.5
_NEGLIGIBLE = 1e-12
# Bounds that differ by more than this are worth a warning
_WIDE = 0.01
# A wall without a fit takes part in a mean with its counts, so that the mean may fall, by no more than this
_FALL = 0.01


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
        Estimated error of the integration of `inside` [1/year]; 0 for a fitted curve, of which the integral has a
        closed form.
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
        """Mean annual frequency of collapse, its lower bound [1/year]: the end that is not on the safe side."""
        return self.bounds[0]

    @property
    def return_period(self) -> float:
        """Mean time between collapses of one wall [year], that of `frequency`; inf where nothing collapses.

        The longest that is possible, which is not on the safe side: `return_period_bounds` has both ends.
        """
        return self.return_period_bounds[1]

    @property
    def return_period_bounds(self) -> tuple[float, float]:
        """Bounds of the return period [year], the shorter first; 0 where the frequency has no upper bound."""
        low, high = (1.0 / value if value > 0.0 else np.inf for value in self.bounds)
        return high, low

    def probability(self, years: float) -> float:
        """Probability that one wall collapses within some years, that of `frequency`.

        The least that is possible, which is not on the safe side: `probability_bounds` has both ends.

        Parameters
        ----------
        years : float
            Length of time [year], not negative.

        Returns
        -------
        float

        Raises
        ------
        InputError
            Years that are negative or no number.
        DondoloError
            The curve is the mean of a population.
        """
        return self.probability_bounds(years)[0]

    def probability_bounds(self, years: float) -> tuple[float, float]:
        """Bounds of the probability that one wall collapses within some years.

        Of a curve with a saturation, for a wall in which a mechanism can occur with that probability; the fit of a
        population is taken for one of walls that are alike. The mean of a population does not tell such a probability:
        see the docstring of the module dondolo.risk.

        Parameters
        ----------
        years : float
            Length of time [year], not negative.

        Returns
        -------
        low, high : float

        Raises
        ------
        InputError
            Years that are negative or no number.
        DondoloError
            The curve is the mean of a population.
        """
        time = as_number("years", years)
        if not time >= 0.0:
            raise InputError(f"years = {time:g}: must not be negative")
        if self._of_several:
            raise DondoloError(
                "probability: is of one wall, and this frequency is the mean of several; that of a population is the"
                " weighted mean of the probabilities of its walls"
            )
        most = self.fragility.saturation if isinstance(self.fragility, Fragility) else 1.0
        # No time is no collapse, whatever the frequency
        low, high = (most * -np.expm1(-value / most * time) if time * value > 0.0 else 0.0 for value in self.bounds)
        return float(low), float(high)

    @property
    def _of_several(self) -> bool:
        """Is the curve the mean of a typology?"""
        return isinstance(_object_of(self.fragility), Typology)

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

        Raises
        ------
        InputError
            Intensities that are not positive or no numbers.
        """
        values = as_levels(x)
        if not np.all(values > 0.0):
            raise InputError("x: must be positive")
        flat = values.ravel()
        inside = self.hazard._covers(flat)
        return shaped(np.where(inside, _integrand(self.fragility, self.hazard, np.log(flat)), 0.0), values)

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

        Raises
        ------
        InputError
            Edges that are less than two, not positive or do not increase.
        """
        x = increasing("edges", edges)
        levels = self.hazard.im_levels
        if not self.hazard.endless:
            x = np.clip(x, levels[0], levels[-1])
        cuts = np.unique(np.concatenate([x, levels[(levels > x[0]) & (levels < x[-1])]]))
        if len(cuts) == 1:
            return np.zeros(len(x) - 1)
        parts, _ = _integrals(self.fragility, self.hazard, np.log(cuts))
        return np.diff(np.append(0.0, np.cumsum(parts))[np.searchsorted(cuts, x)])

    def _facts(self) -> list[tuple[str, str]]:
        facts = [("mean annual frequency of collapse", _between(*self.bounds, "a year"))]
        if self._of_several:
            return facts
        return [
            *facts,
            ("return period", _between(*self.return_period_bounds, "years")),
            ("probability in 50 years", _between(*self.probability_bounds(50.0))),
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
        The measures differ; the function gives no probabilities, or they fall by more than 0.01.
    DondoloError
        The fragility has no curve; the frequency is not finite; the function is too rough to be integrated.

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
    # The object of a method knows its measure, as a typology does that of its mean; a plain function does not.
    im = getattr(_object_of(fragility), "im", "")
    if im and im != hazard.im:
        raise InputError(f"im = '{im}' of the fragility and '{hazard.im}' of the hazard: must be the same")
    if isinstance(fragility, Fragility):
        fragility._need_fit()

    if hazard.endless:
        top = np.inf if isinstance(fragility, Fragility) else _FAR
        total, error = _from_zero(fragility, hazard, top, 2.0 * _FAR)
        if np.isinf(total):
            raise DondoloError(
                "the mean annual frequency is not finite, or hardly: towards an intensity of 0 the probability falls"
                " no faster than the power law rises; give levels of the hazard instead"
            )
        if np.isfinite(top):
            # What is still above: between the probability there and 1
            p, h = float(_probability(fragility, np.exp([top]))[0]), float(hazard(np.exp(top)))
            total, error = total + p * h, error + (1.0 - p) * h
        return Risk(fragility, hazard, total, (0.0, 0.0), (0.0, 0.0), error)
    cuts = np.log(hazard.im_levels)
    parts, error = _integrals(fragility, hazard, cuts)
    inside = float(parts.sum())
    most, _ = _from_zero(fragility, hazard, cuts[0], _FAR, inside)
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


def _object_of(fragility: Curve) -> Any:
    """What a curve is a method of; the curve itself if it is none."""
    method = fragility.func if isinstance(fragility, functools.partial) else fragility
    return getattr(method, "__self__", method)


def _probability(fragility: Curve, x: FloatArray) -> FloatArray:
    """Probabilities of collapse, checked."""
    given = fragility(x)
    try:
        p = np.asarray(given, dtype=np.float64)
    except (TypeError, ValueError):
        raise InputError("fragility: must give numbers for an array of intensities") from None
    if p.shape != x.shape:
        raise InputError(f"fragility: gives an array of shape {p.shape} for intensities of shape {x.shape}")
    if not np.all((p >= 0.0) & (p <= 1.0)):
        raise InputError(f"fragility = {p[~((p >= 0.0) & (p <= 1.0))][0]:g}: must lie between 0 and 1")
    order = np.argsort(x, kind="stable")
    risen = np.maximum.accumulate(p[order])
    falls = p[order] < risen - _FALL
    if falls.any():
        i = int(np.argmax(falls))
        at, now = x[order][i], p[order][i]
        raise InputError(f"fragility = {now:g} at {at:g}, {risen[i]:g} below: must not fall with the intensity")
    return p


def _integrand(fragility: Curve, hazard: HazardCurve, u: FloatArray) -> FloatArray:
    """P(C | x) |dH/d(ln x)| at u = ln x."""
    k, start, frequency = hazard._power_laws(u)
    # Below the levels H may overflow where P vanishes, but not their logarithms
    with np.errstate(divide="ignore", over="ignore"):
        return k * np.exp(np.log(_probability(fragility, np.exp(u))) + np.log(frequency) - k * (u - start))


def _integrals(fragility: Curve, hazard: HazardCurve, cuts: FloatArray) -> tuple[FloatArray, float]:
    """What intensities between cuts in ln x contribute, and the estimated error of the sum."""
    if isinstance(fragility, Fragility):
        return lognormal_integrals(fragility, hazard, cuts), 0.0
    return integrals(lambda u: _integrand(fragility, hazard, u), cuts)


def _from_zero(
    fragility: Curve, hazard: HazardCurve, top: float, width: float, beside: float = 0.0
) -> tuple[float, float]:
    """What intensities up to the top, in ln x, contribute if the first power law goes on; inf if that has no end.

    Of a curve without a closed form, from the width below the top on; the lowest step of that must be nothing beside
    the whole.
    """
    if isinstance(fragility, Fragility):
        return float(lognormal_integrals(fragility, hazard, np.array([-np.inf, top]))[0]), 0.0
    parts, error = _integrals(fragility, hazard, np.linspace(top - width, top, round(width / _STEP) + 1))
    total = float(parts.sum())
    return (total if parts[0] <= _NEGLIGIBLE * (beside + total) < np.inf else np.inf), error


def _between(low: float, high: float, unit: str = "") -> str:
    """One number where both are the same to the digits shown, else both ends."""
    ends = f"{low:.4g}", f"{high:.4g}"
    return f"{ends[0] if ends[0] == ends[1] else f'between {ends[0]} and {ends[1]}'} {unit}".rstrip()
