"""Methods that all fragility curves share."""

from __future__ import annotations

import math
import os
from abc import ABC, abstractmethod
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np
from numpy.typing import ArrayLike

from dondolo._base.arguments import FloatArray, argument_error, as_probabilities, shaped
from dondolo.hazard.hazard import HazardCurve

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from dondolo.curves.comparison import Comparison
    from dondolo.curves.discrete import DiscreteFragility
    from dondolo.curves.fragility import Fragility
    from dondolo.curves.risk import Risk

# Halvings of an interval of ln x, down to rounding
_HALVINGS = 60
_POINTS = 2001


class Curve(ABC):
    """A fragility curve: the probability of collapse, or of a damage state, at intensities.

    Attributes
    ----------
    im : str
        Intensity measure; '' if it is not known.

    Examples
    --------
    >>> import dondolo as dd
    >>> isinstance(dd.DiscreteFragility([0.2, 0.4], [0.1, 0.6]), dd.results.Curve)
    True
    """

    im: str
    # Does it hide how many walls are behind it?
    _hides_walls: ClassVar[bool] = False

    @abstractmethod
    def __call__(self, x: ArrayLike) -> Any:
        """Probability at levels of intensity, not negative."""

    @abstractmethod
    def ppf(self, p: ArrayLike) -> Any:
        """Lowest levels at which the probability is p, infinite where it does not come to that."""

    def plot(self, ax: Axes | None = None, *, label: str | None = None, **options: Any) -> Axes:
        """Draw the curve.

        Parameters
        ----------
        ax : Axes, optional
            Where to draw; a new figure if left out.
        label : str, optional
            Name of the curve where several are drawn into the same axes.
        **options
            Parts to leave out by False (`legend`, `title`, `points`), and keywords of Matplotlib for the curve: see
            docs/printing.md.

        Returns
        -------
        Axes
            Probability against intensity.

        Raises
        ------
        DondoloError
            There is no curve.

        Examples
        --------
        >>> import dondolo as dd
        >>> one, other = (dd.DiscreteFragility([0.2, 0.4], p) for p in ([0.1, 0.6], [0.2, 0.7]))
        >>> axes = one.plot(label="as it stands")
        >>> axes = other.plot(axes, label="weaker", color="black", linestyle="--")
        """
        from dondolo.curves.plots import draw_any

        return draw_any(self, ax, label, options)

    def risk(self, hazard: HazardCurve) -> Risk:
        """Mean annual frequency of collapse: the curve integrated over the hazard.

        Parameters
        ----------
        hazard : HazardCurve
            Of the same intensity measure.

        Returns
        -------
        Risk
            Of the curve of a population its probabilities within some years are those of the walls, each with its own
            frequency; of a discrete one, and of a function, those of one wall (`Risk.probability_bounds`).

        Raises
        ------
        InputError
            The measures differ; the curve gives no probabilities, or they fall by more than 0.01.
        DondoloError
            There is no curve; the frequency is not finite; the curve is too rough to be integrated.

        Warns
        -----
        DondoloWarning
            Intensities beyond the hazard curve may contribute more than 1 %.

        Notes
        -----
        The docstring of the module dondolo.curves.risk has the formulas.

        Examples
        --------
        >>> import dondolo as dd
        >>> curve = dd.fit_fragility([0.2, 0.4], [11, 33], 44, im="pga")
        >>> risk = curve.risk(dd.HazardCurve.power_law(1e-4, 2.5))
        >>> round(risk.return_period, 3)
        186.44
        """
        from dondolo.curves.risk import risk_of

        return risk_of(self, hazard)

    def scenario(self, median: ArrayLike, dispersion: float) -> Any:
        """Probability under one ground motion that is itself uncertain: the mean of the curve over a lognormal.

        Parameters
        ----------
        median : array_like
            Median of the intensity at the site, or at several sites, as a ground-motion model or a ShakeMap gives it,
            not negative; in the unit of the curve's levels.
        dispersion : float
            Standard deviation of its natural logarithm, 0 to 3: the total one, within and between events. A ShakeMap
            gives it beside the median.

        Returns
        -------
        float or ndarray, shape of median
            For each site by itself: walls of a town share the event, so that their collapses are not independent.

        Raises
        ------
        InputError
            A median that is negative or not finite; a dispersion that is not between 0 and 3.
        DondoloError
            There is no curve.

        Notes
        -----
        The docstring of the module dondolo.curves.scenario has the formulas. Lognormal curves and those of straight
        lines are exact; of others the error is below 1e-9 where they are smooth.

        Examples
        --------
        >>> import dondolo as dd
        >>> curve = dd.Fragility.of_parameters(0.8, 0.4, im="pga")
        >>> round(curve.scenario(0.4, 0.6), 4), round(curve(0.4), 4)
        (0.1682, 0.0416)
        """
        from dondolo.curves.scenario import scenario_probability

        return scenario_probability(self, median, dispersion)

    def compare(self, other: Curve, *, confidence: float = 0.95) -> Comparison:
        """Compare medians and dispersions with those of another curve of the same intensity measure.

        The covariance of the differences of ln theta and ln beta takes in what the curves share: records that are the
        same, by their content, and records of the same event depend on each other in both. Records that only one of the
        curves has are independent of the other curve.

        Parameters
        ----------
        other : Curve
            The ratios are those of this curve to the other. Both have standard errors, clustered or naive; of a
            population they are those of the lognormal fitted to its mean.
        confidence : float
            Of the intervals.

        Returns
        -------
        Comparison
            `pairing` states which records the curves share.

        Raises
        ------
        InputError
            Curves of different measures; one clustered and one naive; curves whose records are not known.
        DondoloError
            A curve without a fit or without standard errors.

        Examples
        --------
        >>> import dondolo as dd
        >>> one, other = (dd.fit_fragility([0.2, 0.4], counts, 44, im="pga") for counts in ([11, 33], [5, 25]))
        >>> round(one.compare(other).ratio, 3)
        0.771
        """
        from dondolo.curves.comparison import compare

        return compare(self, other, confidence=confidence)

    def to_nrml(
        self, path: str | os.PathLike[str], *, taxonomy: str = "walls", state: str = "collapse", **model: Any
    ) -> None:
        """Write the curve alone as a fragility model of OpenQuake; `write_nrml` writes several into one.

        Parameters
        ----------
        path : path
            The file, as for `write_nrml`.
        taxonomy, state : str
            Names in the model.
        **model
            Other arguments of `write_nrml`: id, description, limits ...

        Raises
        ------
        InputError
            The curve cannot be stored in the format.
        DondoloError
            There is no curve; the file cannot be written.

        Notes
        -----
        A lognormal is written as continuous, any other curve as discrete, at the 12 to 40 levels that its frequencies
        need: see `Typology.nrml_functions`.

        Examples
        --------
        >>> import dondolo as dd
        >>> dd.Fragility.of_parameters(0.8, 0.4, im="pga").to_nrml("parapets.xml", taxonomy="parapet")
        >>> dd.read_nrml("parapets.xml").functions["parapet"]["collapse"].theta
        0.8
        """
        from dondolo.curves.nrml import write_nrml

        write_nrml(path, {taxonomy: {state: self._as_function()}}, **model)

    def _as_function(self) -> Fragility | DiscreteFragility:
        """The curve as a fragility model has it."""
        from dondolo.curves.discrete import DiscreteFragility
        from dondolo.curves.straight_lines import few_straight_lines

        self._need_fit()
        found = np.unique(self.ppf([0.05, 0.25, 0.5, 0.75, 0.95]))
        levels, p = few_straight_lines(lambda x: np.asarray(self(x))[None], found[np.isfinite(found) & (found > 0.0)])
        return DiscreteFragility(levels, np.maximum.accumulate(p[0]), im=self.im)

    def _need_fit(self) -> None:
        """Raise DondoloError if there is no curve: that of a function is always there."""
        return

    def _fitted(self) -> Fragility:
        """The lognormal whose parameters are compared."""
        raise argument_error("wrong_type", "curves", f": no standard errors are known of a {type(self).__name__}")

    @property
    def _corners(self) -> tuple[float, ...]:
        """Levels at which the curve has a jump or a kink, if it knows them."""
        return ()

    @property
    def _drawn_to(self) -> float:
        """Level up to which the curve is drawn: to where little is left to come."""
        far = float(self.ppf(0.98))
        return far if np.isfinite(far) else float(self.ppf(0.5))

    @property
    def _marked(self) -> FloatArray:
        """Levels at which the curve is drawn with a mark."""
        return np.empty(0)

    @property
    def _end(self) -> float:
        """Probability that it tends to."""
        return 1.0


def inverse(curve: Curve, p: ArrayLike, ends: tuple[float, float]) -> Any:
    """Lowest levels between two ends, positive, at which a curve comes to probabilities: infinite where it does not."""
    values = as_probabilities("p", p)
    flat = values.ravel()
    u = np.linspace(math.log(ends[0]), math.log(ends[1]), _POINTS)
    # A mean with fractions of walls may fall a little
    risen = np.maximum.accumulate(np.asarray(curve(np.exp(u)), dtype=np.float64))
    after = np.searchsorted(risen, flat, side="left")
    within = np.clip(after, 1, _POINTS - 1)
    low, high = u[within - 1], u[within]
    for _ in range(_HALVINGS):
        middle = 0.5 * (low + high)
        reached = np.asarray(curve(np.exp(middle))) >= flat
        low, high = np.where(reached, low, middle), np.where(reached, middle, high)
    found: FloatArray = np.where(after >= _POINTS, np.inf, np.exp(high))
    return shaped(np.where(flat <= 0.0, 0.0, found), values)
