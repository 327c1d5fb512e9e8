"""Curves with an error of their model: the fitted curve and the widened one, always together."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from numpy.typing import ArrayLike

from dondolo._base.arguments import argument_error, as_levels, as_number, shaped
from dondolo._base.wording import say
from dondolo._fortran.curves import probability
from dondolo._fortran.records import blank_unit
from dondolo._storage.saved import Saved
from dondolo._storage.tables import Table, Tabular
from dondolo.curves.fragility import Fragility
from dondolo.hazard.hazard import HazardCurve

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from dondolo.curves.risk import Risk


@dataclass(frozen=True, eq=False, repr=False, kw_only=True)
class ModelError(Tabular, Saved):
    """A fragility curve, and the same curve with an error of its model: `Fragility.with_model_error`.

    Both curves go into every figure and every file; the widened one is never alone.

    Attributes
    ----------
    fragility : Fragility
        The curve that was fitted.
    bias : float
        Mean of ln(measured median / computed median), not positive.
    beta : float
        Standard deviation of ln(measured median / computed median) between walls.

    Examples
    --------
    >>> import dondolo as dd
    >>> curve = dd.Fragility.of_parameters(0.8, 0.4, im="pga")
    >>> found = curve.with_model_error(-0.1, 0.3)
    >>> round(found.theta_used, 4), round(found.beta_used, 4)
    (0.7239, 0.5)
    """

    fragility: Fragility
    bias: float
    beta: float

    @property
    def theta_used(self) -> float:
        """Median of the widened curve, theta exp(bias)."""
        return self.fragility.theta * math.exp(self.bias)

    @property
    def beta_used(self) -> float:
        """Dispersion of the widened curve, the root of the sum of squares of both."""
        return math.hypot(self.fragility.beta, self.beta)

    def probability(self, x: ArrayLike) -> tuple[Any, Any]:
        """Probability of collapse at levels, by both curves.

        Parameters
        ----------
        x : array_like
            Levels of intensity, not negative.

        Returns
        -------
        fitted, widened : float or ndarray, shape of x

        Raises
        ------
        InputError
            A level that is negative or not a number.

        Examples
        --------
        >>> import dondolo as dd
        >>> curve = dd.Fragility.of_parameters(0.8, 0.4, im="pga")
        >>> [round(float(p), 4) for p in curve.with_model_error(0.0, 0.3).probability(0.4)]
        [0.0416, 0.0828]
        """
        values = as_levels(x)
        widened = probability(self.theta_used, self.beta_used, values.ravel())
        return self.fragility(x), shaped(self.fragility.upper_asymptote * widened, values)

    def risk(self, hazard: HazardCurve) -> tuple[Risk, Risk]:
        """Mean annual frequency of collapse by both curves.

        Parameters
        ----------
        hazard : HazardCurve
            Of the same intensity measure.

        Returns
        -------
        fitted, widened : Risk

        Raises
        ------
        InputError
            The measures differ.
        DondoloError
            The frequency is not finite.

        Examples
        --------
        >>> import dondolo as dd
        >>> curve = dd.Fragility.of_parameters(0.8, 0.4, im="pga")
        >>> fitted, widened = curve.with_model_error(-0.1, 0.3).risk(dd.HazardCurve.power_law(1e-4, 2.5))
        >>> round(widened.annual_frequency / fitted.annual_frequency, 3)
        1.701
        """
        return self.fragility.risk(hazard), self._widened().risk(hazard)

    def plot(self, ax: Axes | None = None, *, confidence: float = 0.95, **options: Any) -> Axes:
        """Draw both curves.

        Parameters
        ----------
        ax : Axes, optional
            Where to draw; a new figure if left out.
        confidence : float
            Confidence of the band and the bars of the fitted curve.
        **options
            Parts to leave out by False (`legend`, `title`, `band`, `bars`, `points`), and keywords of Matplotlib for
            the fitted curve: see docs/printing.md.

        Returns
        -------
        Axes
            Probability of collapse against intensity.

        Raises
        ------
        InputError
            A confidence that is not between 0 and 1.
        """
        unit = blank_unit(self.fragility.im)
        fitted = say("fitted: θ = {theta:.3g}{unit}, β = {beta:.3g}", theta=self.fragility.theta, unit=unit,
                     beta=self.fragility.beta)  # fmt: skip
        widened = say("with the error of the model: θ = {theta:.3g}{unit}, β = {beta:.3g}", theta=self.theta_used,
                      unit=unit, beta=self.beta_used)  # fmt: skip
        ax = self.fragility.plot(ax, confidence=confidence, label=fitted, **options)
        parts = {name: value for name, value in options.items() if name in ("legend", "title")}
        return self._widened().plot(ax, label=widened, points=False, bars=False, band=False, **parts)

    def _widened(self) -> Fragility:
        """The widened curve, which does not leave this class but as numbers."""
        import dataclasses

        given = Fragility.of_parameters(self.theta_used, self.beta_used, im=self.fragility.im)
        # With its levels it is drawn as far as the fitted one.
        kept = ("levels", "collapses", "histories", "upper_asymptote", "wall")
        return dataclasses.replace(given, **{name: getattr(self.fragility, name) for name in kept})

    def _table(self) -> Table:
        wall = self.fragility.wall.name if self.fragility.wall is not None else ""
        return {
            "wall": [wall] * 2,
            "curve": ["fitted", "with model error"],
            "im": [self.fragility.im] * 2,
            "theta": [self.fragility.theta, self.theta_used],
            "beta": [self.fragility.beta, self.beta_used],
            "bias": [0.0, self.bias],
            "beta_model": [0.0, self.beta],
        }

    def _facts(self) -> list[tuple[str, str]]:
        unit = blank_unit(self.fragility.im)
        return [
            ("fitted", f"theta {self.fragility.theta:.6g}{unit}, beta {self.fragility.beta:.6g}"),
            ("with model error", f"theta {self.theta_used:.6g}{unit}, beta {self.beta_used:.6g}"),
            ("given", f"bias {self.bias:g}, beta {self.beta:g} of ln(measured median / computed median)"),
        ]


def model_error(curve: Fragility, bias: float, beta: float) -> ModelError:
    """See `Fragility.with_model_error`."""
    shift, spread = as_number("bias", bias), as_number("beta", beta)
    if not -2.0 <= shift <= 0.0:
        reason = "a positive one would raise the median" if shift > 0.0 else "must lie between -2 and 0"
        raise argument_error("out_of_range", "bias", f" = {shift:g}: {reason}")
    if not 0.0 <= spread <= 2.0:
        raise argument_error("out_of_range", "beta", f" = {spread:g}: must lie between 0 and 2")
    return ModelError(fragility=curve, bias=float(shift), beta=float(spread))
