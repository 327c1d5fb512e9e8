"""Risk: how often a wall collapses, from its fragility and the hazard of its site.

The hazard curve H(x) is the mean annual frequency of IM > x. With the fragility P(C | x) the mean annual frequency of
collapse is (Cornell and Krawinkler 2000; McGuire 2004)

    lambda = integral of P(C | x) |dH(x)|.

Hazard
    Levels and frequencies are joined by straight lines of ln H against ln x: between two levels H is a power law,
    H(x) = H_j (x/x_j)^-k_j. So the integral over a step is that of P k_j H d(ln x): of a fitted lognormal in closed
    form, of any other curve by Gauss's rule (dondolo.hazard.integrals).
Beyond the levels
    A curve is given between its lowest and highest level, and what lies outside is not made up but bounded. P does not
    fall with x, so that the events above the highest level x_n contribute between P(x_n) H(x_n) and H(x_n), times its
    upper asymptote where the curve has one. Those below the lowest, x_1, contribute at least 0, and at most the
    integral with the first power law continued to x = 0: hazard curves bend down on logarithmic axes, they are steeper
    at rare levels than at frequent ones. `Risk.annual_frequency` is the lower bound. Hazard curves should begin where
    nothing collapses and end where nearly all does; a warning says when the bounds differ by more than 1 %.
Power laws
    With H = k0 x^-k for all x, and a lognormal fragility, it is (Cornell 1996)

        lambda = k0 theta^-k exp(k^2 beta^2/2).

    For k > 0 and a P that falls more slowly than x^k towards x = 0, there is no finite frequency, and an error says so.
Time
    Events are a Poisson process: of one wall P(at least one collapse in t years) = 1 - exp(-lambda t), and the return
    period is 1/lambda. What stands after a collapse is the same wall. A curve with the upper asymptote s is of a wall
    in which something can occur with the probability s, for all events: s (1 - exp(-lambda t/s)).
Populations
    The mean curve gives the mean frequency, lambda = sum(w_i lambda_i)/sum(w_i): the share of the walls lost a year.
    The probability that a wall drawn by weight collapses in t years is another mean,

        sum(w_i (1 - exp(-lambda_i t)))/sum(w_i) <= 1 - exp(-lambda t) <= lambda t:

    walls that never collapse take no part however long the time is, and weak ones collapse once. So it is computed
    from the walls behind the mean of a typology; a wall with mechanisms that may not occur is itself a mixture
    (dondolo.curves.risk_of_walls). There is no return period of a population.

Units are those of dondolo: accelerations in g, all else in SI units. Hazard is often published as a return period,
H = 1/T, or as the probability p of being exceeded in t years, H = -ln(1 - p)/t.

References: Cornell (1996), Calculating building seismic performance reliability: a basis for multi-level design norms,
11th World Conference on Earthquake Engineering, paper 2122; Cornell and Krawinkler (2000), Progress and challenges in
seismic performance assessment, PEER Center News 3(2); McGuire (2004), Seismic hazard and risk analysis, EERI MNO-10.
"""

from __future__ import annotations

import functools
from collections.abc import Iterable
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, TypeGuard

import numpy as np
from numpy.typing import ArrayLike

from dondolo._base.arguments import (
    FloatArray,
    argument_error,
    as_count,
    as_levels,
    as_number,
    increasing,
    instance_of,
    shaped,
)
from dondolo._base.shown import Shown
from dondolo._base.wording import decimal, say
from dondolo._fortran.library import warn
from dondolo._fortran.records import blank_unit
from dondolo._storage.saved import Saved
from dondolo.curves.curve import Curve
from dondolo.curves.fragility import Fragility
from dondolo.curves.limited import LimitedFragility
from dondolo.curves.mean_curve import MeanCurve
from dondolo.curves.risk_of_walls import WallFrequencies, wall_frequencies
from dondolo.errors import DondoloError, DondoloWarning
from dondolo.hazard.hazard import HazardCurve
from dondolo.hazard.integrals import (
    integrals,
    integrand,
    lognormal_integrals,
    of_function,
    of_lognormal,
    with_corners,
)

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from dondolo.curves.risk_uncertainty import RiskUncertainty

# Bounds that differ by more than this are worth a warning
_WIDE = 0.01
# A wall without a fit takes part in a mean with its counts, so that the mean may fall, by no more than this
_FALL = 0.01
# Points of a curve in a figure; enough for a smooth line
_POINTS = 801


@dataclass(frozen=True, eq=False, repr=False, kw_only=True)
class Risk(Shown, Saved):
    """Mean annual frequency of collapse, with its bounds and deaggregation.

    Attributes
    ----------
    fragility : Curve
    hazard : HazardCurve
    inside : float
        What the range of the hazard curve contributes [1/year].
    below, above : (float, float)
        Bounds of what intensities below and above that range contribute [1/year]; (0, 0) for a power law without end.
    error : float
        Estimated error of the integration of `inside` [1/year]; 0 for a fitted curve, of which the integral has a
        closed form.

    Examples
    --------
    >>> import dondolo as dd
    >>> hazard = dd.HazardCurve.power_law(1e-4, 2.5)
    >>> risk = dd.Fragility.of_parameters(0.8, 0.4, im="pga").risk(hazard)
    >>> round(risk.return_period), round(risk.probability(50.0), 5)
    (3472, 0.0143)
    >>> low, high = risk.probability_bounds(50.0)
    >>> low == risk.probability(50.0)
    True
    >>> 0.5 < risk.dominant_level < 0.8
    True
    >>> bool(risk.density(0.6) > risk.density(0.2))
    True
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
    def annual_frequency(self) -> float:
        """Mean annual frequency of collapse, its lower, unconservative bound [1/year]."""
        return self.bounds[0]

    @property
    def return_period(self) -> float:
        """Mean time between collapses of one wall [year], that of `annual_frequency`; inf where nothing collapses.

        The longest possible, hence unconservative: `return_period_bounds` has both bounds. Of a
        population it is no more than the inverse of the share lost a year.
        """
        return self.return_period_bounds[1]

    @property
    def return_period_bounds(self) -> tuple[float, float]:
        """Bounds of the return period [year], the shorter first; 0 where the frequency has no upper bound."""
        low, high = (1.0 / value if value > 0.0 else np.inf for value in self.bounds)
        return high, low

    def probability(self, years: float) -> float:
        """Probability that a wall collapses within some years, its lower bound.

        The unconservative bound: `probability_bounds` has both.

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
            Years that are negative or not a number.

        Warns
        -----
        DondoloWarning
            The curve is a function, which is treated as that of one wall.
        """
        return self.probability_bounds(years)[0]

    def probability_bounds(self, years: float) -> tuple[float, float]:
        """Bounds of the probability that a wall collapses within some years.

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
            Years that are negative or not a number.

        Warns
        -----
        DondoloWarning
            The curve is a function, which is treated as that of one wall.

        Notes
        -----
        Of the curve of a population it is that of a wall drawn by weight, the share of the walls that is lost, from the
        frequencies of all walls. The fit of a population is taken for that of walls that are alike, but for its
        upper asymptote. Any function is taken for the curve of one wall: a function hides the walls behind it, so that
        the probability is too high for a population, and a warning says so.
        """
        time = as_number("years", years)
        if not 0.0 <= time < np.inf:
            raise argument_error("out_of_range", "years", f" = {time:g}: must be finite and not negative")
        if time == 0.0:
            # Whatever the frequency
            return 0.0, 0.0
        if self.fragility._hides_walls:
            sentence = (
                "the curve is a function, taken for that of one wall: for a population take the risk of its curve,"
                " typology[mechanism, group].risk(hazard)"
            )
            warn([DondoloWarning(sentence, "function_of_one_wall")])
        return self._walls.probability(time)

    @functools.cached_property
    def _walls(self) -> WallFrequencies:
        """The walls behind the curve."""
        if isinstance(self.fragility, MeanCurve):
            return wall_frequencies(self.fragility.members, self.hazard)
        share = self.fragility.upper_asymptote if isinstance(self.fragility, Fragility) else 1.0
        return WallFrequencies(np.array([share]), *(np.array([end / share]) for end in self.bounds))

    def density(self, x: ArrayLike) -> Any:
        """Deaggregation: what intensities contribute to the frequency, ``P(C | x) |dH/d(ln x)|``.

        Parameters
        ----------
        x : array_like
            Intensities, positive.

        Returns
        -------
        float or ndarray, shape of x
            [1/year] per unit of ln x; 0 beyond the levels of the hazard curve.

        Raises
        ------
        InputError
            Intensities that are not positive or not numbers.
        """
        values = as_levels(x)
        if not np.all(values > 0.0):
            raise argument_error("out_of_range", "x", ": must be positive")
        flat = values.ravel()
        inside = self.hazard._covers(flat)
        found = integrand(functools.partial(probability, self.fragility), self.hazard, np.log(flat))
        return shaped(np.where(inside, found, 0.0), values)

    @functools.cached_property
    def dominant_level(self) -> float:
        """Intensity that contributes most: where the deaggregation against ln x is largest, on the smoothed hazard.

        NaN where nothing collapses.
        """
        x, density = self._smooth_density()
        return float(x[int(np.argmax(density))]) if density.max() > 0.0 else np.nan

    def _smooth_density(self) -> tuple[FloatArray, FloatArray]:
        """Intensities, and the deaggregation on the smoothed hazard, without the kinks of power laws."""
        smooth = self.hazard.smoothed()
        ends = np.log(smooth.levels[[0, -1]])
        if smooth.endless:
            # Where the risk comes from
            wide = np.linspace(-20.0, 20.0, 4001)
            density = self.density(np.exp(wide))
            ends = wide[density > 1e-3 * density.max()][[0, -1]] if density.max() > 0.0 else ends
        u = np.linspace(ends[0], ends[1], _POINTS)
        x = np.exp(u)
        if smooth.endless:
            return x, np.asarray(self.density(x))
        x[[0, -1]] = smooth.levels[[0, -1]]
        slope = smooth._slope_at(u)
        return x, slope * smooth(x) * probability(self.fragility, x)

    def deaggregate(self, edges: ArrayLike) -> FloatArray:
        """Deaggregation: what the intensities between edges contribute to the frequency.

        Parameters
        ----------
        edges : array_like, shape (bins + 1,)
            Intensities, positive and increasing, such as the levels of the hazard curve.

        Returns
        -------
        ndarray, shape (bins,)
            [1/year]. Without the part beyond the levels of the hazard curve.

        Raises
        ------
        InputError
            Fewer than two edges, edges that are not positive or do not increase.
        """
        x = increasing("edges", edges)
        levels = self.hazard.levels
        if not self.hazard.endless:
            x = np.clip(x, levels[0], levels[-1])
        cuts = np.unique(np.concatenate([x, levels[(levels > x[0]) & (levels < x[-1])]]))
        if len(cuts) == 1:
            return np.zeros(len(x) - 1)
        if _is_lognormal(self.fragility):
            curve = self.fragility
            parts = curve.upper_asymptote * lognormal_integrals(
                np.asarray(curve.theta), np.asarray(curve.beta), self.hazard, np.log(cuts)
            )
        else:
            curve_at = functools.partial(probability, self.fragility)
            fine = with_corners(np.log(cuts), self.fragility._corners)
            of_fine, _ = integrals(lambda u: integrand(curve_at, self.hazard, u), fine)
            parts = np.add.reduceat(of_fine, np.searchsorted(fine, np.log(cuts[:-1])))
        return np.diff(np.append(0.0, np.cumsum(parts))[np.searchsorted(cuts, x)])

    def plot_deaggregation(self, ax: Axes | None = None, *, n_bins: int = 20, **options: Any) -> Axes:
        """Draw what intensities contribute to the frequency, in bins, and the one that contributes most.

        Parameters
        ----------
        ax : Axes, optional
            Where to draw; a new figure if left out.
        n_bins : int
            Number of bins, equal on a logarithmic axis.
        **options
            Parts to leave out by False (`legend`, `title`), and keywords of Matplotlib for the bars: see
            docs/printing.md.

        Returns
        -------
        Axes
            Share of the frequency against intensity.
        """
        from dondolo.curves.plots_risk import draw_deaggregation

        return draw_deaggregation(self, ax, as_count("n_bins", n_bins, 1), options)

    def uncertainty(self, *, n_draws: int = 10_000, rng: int | np.random.Generator | None = 0) -> RiskUncertainty:
        """Distribution of the annual frequency: that of the fragility, for the mean hazard and each of its fractiles.

        Parameters
        ----------
        n_draws : int
            Number of draws, at least 100.
        rng : int, Generator or None
            Of the random numbers; None: different every time.

        Returns
        -------
        RiskUncertainty

        Raises
        ------
        InputError
            Too few draws.
        DondoloError
            The curve has no standard errors.

        Notes
        -----
        The docstring of the module dondolo.curves.risk_uncertainty describes what is drawn.

        Examples
        --------
        >>> import dondolo as dd
        >>> curve = dd.fit_fragility([0.2, 0.4], [11, 33], 44, im="pga")
        >>> risk = curve.risk(dd.HazardCurve.power_law(1e-4, 2.5))
        >>> low, high = risk.uncertainty().interval()
        >>> low < risk.annual_frequency < high
        True
        """
        from dondolo.curves.risk_uncertainty import uncertainty

        return uncertainty(self, n_draws, rng)

    def plot(self, ax: Iterable[Axes] | None = None, **options: Any) -> Axes:
        """Draw the hazard, the fragility, and the intensities that the risk comes from.

        Parameters
        ----------
        ax : three Axes, optional
            Where to draw; a new figure if left out.
        **options
            Parts to leave out by False (`legend`, `title`, `points`), and keywords of Matplotlib for the lines: see
            docs/printing.md.

        Returns
        -------
        Axes
            The first of the figure's: annual frequency of exceedance, probability of collapse and share of the risk per
            unit of ln IM, against intensity on a logarithmic axis.
        """
        from dondolo.curves.plots_risk import draw_risk

        return draw_risk(self, ax, options)

    def _facts(self) -> list[tuple[str, str]]:
        of = " of one wall" if self.fragility._hides_walls else ""
        facts = [("mean annual frequency of collapse", between(*self.bounds, "a year"))]
        if not isinstance(self.fragility, MeanCurve):
            facts.append((f"return period{of}", between(*self.return_period_bounds, "years")))
        return [*facts, (f"probability in 50 years{of}", between(*self._walls.probability(50.0)))]


def risk_of(fragility: Curve, hazard: HazardCurve) -> Risk:
    """Mean annual frequency of collapse: see `Curve.risk`."""
    instance_of("hazard", hazard, HazardCurve)
    if fragility.im and fragility.im != hazard.im:
        raise argument_error(
            "not_together",
            "im",
            f" = '{fragility.im}' of the fragility and '{hazard.im}' of the hazard: must be the same",
        )
    fragility._need_fit()
    most = fragility._end
    if _is_lognormal(fragility):
        one = of_lognormal(np.asarray(fragility.theta), np.asarray(fragility.beta), hazard)
        inside, below, above, error = (most * float(part) for part in one)
    else:
        one = of_function(functools.partial(probability, fragility), hazard, corners=fragility._corners)
        inside, below, above, error = map(float, one)
    if np.isinf(inside):
        raise DondoloError(
            "the mean annual frequency is not finite, or hardly: towards an intensity of 0 the probability falls"
            " no faster than the power law rises; give levels of the hazard instead"
        )
    if hazard.endless:
        ends = (0.0, 0.0), (0.0, 0.0)
    else:
        ends = (0.0, below), (above, most * float(hazard.annual_frequency[-1]))
    risk = Risk(fragility=fragility, hazard=hazard, inside=inside, below=ends[0], above=ends[1], error=error)
    low, high = risk.bounds
    if low < (1.0 - _WIDE) * high:
        unit = blank_unit(hazard.im)
        first, last = hazard.levels[[0, -1]]
        sentence = (
            f"the hazard curve, {first:g} to {last:g}{unit}, is too short: the mean annual frequency of collapse"
            f" lies between {low:.3g} and {high:.3g}"
        )
        numbers = {"first_level": float(first), "last_level": float(last), "lower_bound": low, "upper_bound": high}
        warn([DondoloWarning(sentence, "hazard_too_short", {"im": hazard.im}, numbers)])
    return risk


def _is_lognormal(fragility: Curve) -> TypeGuard[Fragility]:
    """Whether a curve is a lognormal without limits, of which integrals have a closed form."""
    return isinstance(fragility, Fragility) and not isinstance(fragility, LimitedFragility)


def probability(fragility: Curve, x: FloatArray) -> FloatArray:
    """Probabilities of collapse, which must not fall."""
    p = np.asarray(fragility(x), dtype=np.float64)
    order = np.argsort(x, kind="stable")
    risen = np.maximum.accumulate(p[order])
    falls = p[order] < risen - _FALL
    if falls.any():
        i = int(np.argmax(falls))
        at, now = x[order][i], p[order][i]
        raise argument_error(
            "out_of_range", "fragility", f" = {now:g} at {at:g}, {risen[i]:g} below: must not fall with the intensity"
        )
    return p


def between(low: float, high: float, unit: str = "", digits: int = 4) -> str:
    """One number where both are the same to the digits shown, else both ends."""
    ends = decimal(f"{low:.{digits}g}"), decimal(f"{high:.{digits}g}")
    both = ends[0] if ends[0] == ends[1] else say("between {low} and {high}", low=ends[0], high=ends[1])
    return f"{both} {unit}".rstrip()
