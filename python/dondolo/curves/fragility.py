"""Fragility curves: the lognormal fitted by Fortran, and what statistics adds to it."""

from __future__ import annotations

import os
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, Literal, get_args

import numpy as np
from numpy.typing import ArrayLike

from dondolo._base.arguments import FloatArray, as_array, as_levels, as_number, one_of, shaped, tails
from dondolo._base.shown import Shown
from dondolo._fortran.curves import CurveData, fit_curves, probability
from dondolo._fortran.library import warn
from dondolo._fortran.records import blank_unit, unit_of
from dondolo._storage import tables
from dondolo._storage.saved import Saved
from dondolo.curves.bootstrap import Bootstrap, draw_records, resample
from dondolo.curves.sample import Sample
from dondolo.errors import DondoloError, DondoloWarning, InputError
from dondolo.figures import style
from dondolo.walls.wall import Wall

if TYPE_CHECKING:
    from matplotlib.axes import Axes

Interval = tuple[float, float]

#: How an interval is found
Method = Literal["delta", "profile"]


@dataclass(frozen=True, eq=False, repr=False, kw_only=True)
class Fragility(Shown, Saved):
    """A fragility curve P(C | IM = x) = Phi(ln(x/theta)/beta), equation (5) of Nale et al., or why there is none.

    Attributes
    ----------
    theta, beta : float
        Median, in the unit of the levels, and dispersion (standard deviation of the logarithm); NaN without a fit.
    covariance : ndarray, shape (2, 2)
        Covariance of ln theta and beta from the Fisher information.
    status : str
        'ok', 'extrapolated' (theta outside the levels), 'no_collapse', 'all_collapse', 'separated', 'single_level',
        'decreasing' or 'not_converged'; the first two have a curve.
    log_likelihood : float
        With the binomial coefficients; NaN without a fit.
    bracket : (float, float)
        Levels between which half of the histories begin to collapse; 0 or inf where a side is open.
    levels, collapses, histories : ndarray, shape (levels,)
        What it was fitted to.
    im : str
        Intensity measure.
    edp_threshold : float or None
        Rotation / capacity of the damage state; None where only counts were given.
    saturation : float
        What the probability tends to: 1, but for populations in which no mechanism may occur (`Group`); theta and beta
        are then those of the walls in which one can, and the probability is that of all.
    sample : Sample or None
        The histories behind it, which `bootstrap` draws from; None where only counts were given.
    """

    theta: float
    beta: float
    covariance: FloatArray
    status: str
    log_likelihood: float
    bracket: Interval
    levels: FloatArray
    collapses: FloatArray
    histories: FloatArray
    im: str = ""
    wall: Wall | None = None
    edp_threshold: float | None = None
    saturation: float = 1.0
    sample: Sample | None = field(default=None, repr=False)

    @property
    def has_fit(self) -> bool:
        """Is there a curve?"""
        return self.status in ("ok", "extrapolated")

    @property
    def se_ln_theta(self) -> float:
        """Standard error of ln theta."""
        return float(np.sqrt(self.covariance[0, 0]))

    @property
    def se_beta(self) -> float:
        """Standard error of beta."""
        return float(np.sqrt(self.covariance[1, 1]))

    def __call__(self, x: ArrayLike) -> Any:
        """Probability of collapse at levels.

        Parameters
        ----------
        x : array_like
            Levels of intensity, not negative.

        Returns
        -------
        float or ndarray, shape of x

        Raises
        ------
        DondoloError
            There is no curve.
        InputError
            A level that is negative or no number.
        """
        self._need_fit()
        values = as_levels(x)
        return shaped(self.saturation * probability(self.theta, self.beta, values.ravel()), values)

    def interval(self, x: ArrayLike, *, confidence: float = 0.95, method: Method = "delta") -> tuple[Any, Any]:
        """Confidence interval of the probability at levels (of each on its own, not of the curve as a whole).

        Parameters
        ----------
        x : array_like
            Levels of intensity, positive.
        confidence : float
            Confidence, between 0 and 1.
        method : {'delta', 'profile'}
            From the covariance, on the scale of the normal quantile of the probability; or from the profile likelihood,
            which is slower and right for small counts too.

        Returns
        -------
        low, high : float or ndarray, shape of x

        Raises
        ------
        DondoloError
            There is no curve.
        InputError
            Levels that are not positive, a confidence beyond 0 and 1, no such method.
        """
        one_of("method", method, get_args(Method))
        self._need_fit()
        quantile = _quantile(confidence)
        values = as_levels(x)
        if not np.all(values > 0.0):
            raise InputError(f"x = {values.min():g}: must be positive")
        at = np.log(values.ravel() / self.theta)
        probit = at / self.beta
        # Gradient of the probit with respect to (ln theta, beta)
        gradient = np.stack([np.full_like(at, -1.0 / self.beta), -probit / self.beta])
        half = quantile * np.sqrt(np.einsum("ik,ij,jk->k", gradient, self.covariance, gradient))
        if method == "delta":
            low, high = probit - half, probit + half
        else:
            low, high = self._likelihood().probit_interval(at, half, 0.5 * quantile**2)
        from scipy.special import ndtr

        return shaped(self.saturation * ndtr(low), values), shaped(self.saturation * ndtr(high), values)

    def parameter_interval(self, *, confidence: float = 0.95, method: Method = "delta") -> dict[str, Interval]:
        """Confidence intervals of theta and beta.

        Parameters
        ----------
        confidence : float
            Confidence, between 0 and 1.
        method : {'delta', 'profile'}
            From the covariance, on logarithmic scales; or from the profile likelihood, where 0 and inf are bounds that
            the data leave open.

        Returns
        -------
        dict
            'theta' and 'beta': (low, high).

        Raises
        ------
        DondoloError
            There is no curve.
        InputError
            A confidence beyond 0 and 1, no such method.
        """
        one_of("method", method, get_args(Method))
        self._need_fit()
        quantile = _quantile(confidence)
        if method == "delta":
            theta = _spread(self.theta, quantile * self.se_ln_theta)
            return {"theta": theta, "beta": _spread(self.beta, quantile * self.se_beta / self.beta)}
        likelihood = self._likelihood()
        drop = 0.5 * quantile**2
        low, high = likelihood.median_interval(quantile * self.se_ln_theta, drop)
        flat, steep = likelihood.slope_interval(quantile * self.se_beta / self.beta**2, drop)
        with np.errstate(over="ignore"):
            theta = (self.theta * float(np.exp(low)), self.theta * float(np.exp(high)))
        return {"theta": theta, "beta": (1.0 / steep, 1.0 / flat if flat > 0.0 else np.inf)}

    def bootstrap(
        self,
        *,
        n_resamples: int = 2000,
        seed: int | np.random.Generator | None = 0,
        events: Sequence[Any] | None = None,
    ) -> Bootstrap:
        """Fit the curve again to records drawn with replacement.

        A record stays whole: it brings its histories at all levels and of both polarities, so that their dependence is
        kept, which the covariance neglects. All fits are one call of Fortran.

        Parameters
        ----------
        n_resamples : int
            Number of samples.
        seed : int, Generator or None
            Of the random numbers; None: different every time.
        events : sequence, optional
            A label for each record, such as its recording or its earthquake: records with the same label are drawn
            together. The two horizontal components of a recording are alike; drawn one by one they look like twice as
            much evidence as they are.

        Returns
        -------
        Bootstrap

        Raises
        ------
        InputError
            As many labels as records are needed.
        DondoloError
            The curve does not come from stripes.
        """
        self._need_fit()
        if self.sample is None:
            raise DondoloError("bootstrap: needs the stripes, so it is for curves that come from Stripes.fit")
        return resample(self.sample, draw_records(self.sample.n_records, n_resamples, seed, events))

    def plot(
        self,
        ax: Axes | None = None,
        *,
        confidence: float = 0.95,
        label: str | None = None,
        color: str = style.BLUE,
        linestyle: str = "-",
        marker: str = "o",
    ) -> Axes:
        """Draw the curve with its confidence band, and the fractions of collapse it was fitted to.

        Figure 4b of Nale et al. The bars of the fractions are Clopper and Pearson's exact binomial intervals. Without a
        fit only the fractions and the bracket of the median are drawn.

        Parameters
        ----------
        ax : Axes, optional
            Where to draw; a new figure if left out.
        confidence : float
            Confidence of band and bars.
        label : str, optional
            Name of the curve where several are drawn into the same axes; median and dispersion if left out.
        color, linestyle, marker : str
            Of the curve and its fractions, to distinguish several.

        Returns
        -------
        Axes
            Probability of collapse against intensity.

        Raises
        ------
        InputError
            A confidence beyond 0 and 1.
        """
        from dondolo.curves.plots import draw_fragility

        return draw_fragility(self, ax, confidence, label, color, linestyle, marker)

    def to_frame(self) -> Any:
        """The curve as a pandas DataFrame of one row."""
        return tables.frame(fragility_table([self.wall], [self]))

    def to_csv(self, path: str | os.PathLike[str], *, spreadsheet_safe: bool = False) -> None:
        """Write the curve as the executable's ``_fragility.csv``.

        With `spreadsheet_safe` an apostrophe stands before names that a spreadsheet would take for formulas.
        """
        comments = [f"unit of theta: {unit_of(self.im) or '1'}"] if self.im else []
        tables.write_csv(path, fragility_table([self.wall], [self]), comments, spreadsheet_safe=spreadsheet_safe)

    def _need_fit(self) -> None:
        if not self.has_fit:
            low, high = self.bracket
            raise DondoloError(
                f"no curve was fitted (status '{self.status}'): the median lies between {low:g} and {high:g}"
            )

    def _likelihood(self) -> Any:
        from dondolo.curves.likelihood import Likelihood

        return Likelihood(self.levels, self.collapses, self.histories, self.theta, self.beta)

    def _facts(self) -> list[tuple[str, str]]:
        unit = blank_unit(self.im)
        if not self.has_fit:
            low, high = self.bracket
            return [("status", self.status), ("median between", f"{low:g} and {high:g}{unit}")]
        ends = [("saturation", f"{self.saturation:.6g}")] if self.saturation < 1.0 else []
        return [
            ("theta", f"{self.theta:.6g}{unit} (standard error of ln theta {self.se_ln_theta:.3g})"),
            ("beta", f"{self.beta:.6g} (standard error {self.se_beta:.3g})"),
            *ends,
            ("log likelihood", f"{self.log_likelihood:.6g}"),
            ("status", self.status),
        ]


def fit_fragility(levels: ArrayLike, collapses: ArrayLike, histories: ArrayLike, *, im: str = "") -> Fragility:
    """Fit a lognormal fragility curve by maximum likelihood (Baker 2015).

    Parameters
    ----------
    levels : array_like, shape (levels,)
        Levels of intensity, positive.
    collapses : array_like, shape (levels,)
        Collapses at each level; need not be whole numbers (weighted counts).
    histories : array_like, shape (levels,) or scalar
        Histories at each level.
    im : str, optional
        Intensity measure of the levels, such as 'pga': the name on axes, and what may be compared.

    Returns
    -------
    Fragility
        Its status says whether there is a curve.

    Raises
    ------
    InputError
        Counts that cannot be.

    Warns
    -----
    DondoloWarning
        The median lies outside the levels.

    Examples
    --------
    >>> import dondolo as dd
    >>> curve = dd.fit_fragility([0.2, 0.4], [11, 33], 44)
    >>> round(curve.theta, 9), round(curve.beta, 9)
    (0.282842712, 0.513830774)
    """
    curve = fit(*_counts(levels, collapses, histories), im=im)
    if curve.status == "extrapolated":
        warn([extrapolation(curve)])
    return curve


def extrapolation(curve: Fragility) -> DondoloWarning:
    """The warning that a curve with its median outside the levels is worth."""
    low, high = float(curve.levels.min()), float(curve.levels.max())
    return DondoloWarning(
        f"theta = {curve.theta:.4g} lies outside the levels {low:g} to {high:g}: the fit extrapolates",
        "extrapolated",
        numbers={"levels": len(curve.levels), "first_level": low, "last_level": high, "theta": curve.theta},
    )


def fit(levels: FloatArray, collapses: FloatArray, histories: FloatArray, **origin: Any) -> Fragility:
    """Fit without a warning."""
    curves, statuses = fit_curves(levels, collapses[None, :], histories[None, :])
    return curve_of(CurveData(statuses[0], curves[0]), levels, collapses, histories, **origin)


def curve_of(
    data: CurveData, levels: FloatArray, collapses: FloatArray, histories: FloatArray, **origin: Any
) -> Fragility:
    """A curve as Fortran has fitted it."""
    theta, beta, var_theta, both, var_beta, height, low, high = (float(value) for value in data.numbers)
    if data.status not in ("ok", "extrapolated"):
        theta = beta = var_theta = both = var_beta = height = np.nan
    largest = np.finfo(np.float64).max
    return Fragility(
        theta=theta,
        beta=beta,
        covariance=np.array([[var_theta, both], [both, var_beta]]),
        status=data.status,
        log_likelihood=height,
        bracket=(low, np.inf if high >= largest else high),
        levels=levels,
        collapses=collapses,
        histories=histories,
        **origin,
    )


def _counts(levels: ArrayLike, collapses: ArrayLike, histories: ArrayLike) -> tuple[FloatArray, FloatArray, FloatArray]:
    # Copies: the curve keeps them, and what the caller does with theirs must not change it.
    x, z = as_array("levels", levels).copy(), as_array("collapses", collapses).copy()
    if np.ndim(histories) == 0:
        n = np.full(len(x), as_number("histories", histories))
    else:
        n = as_array("histories", histories).copy()
    if not len(x) == len(z) == len(n):
        raise InputError(f"{len(x)} levels, {len(z)} collapses, {len(n)} histories: must be as many")
    return x, z, n


def _quantile(confidence: float) -> float:
    from scipy.special import ndtri

    return float(ndtri(tails(confidence)[1]))


def _spread(value: float, log_width: float) -> Interval:
    return value * float(np.exp(-log_width)), value * float(np.exp(log_width))


def fragility_table(walls: Sequence[Wall | None], curves: Sequence[Fragility]) -> tables.Table:
    """Columns of ``_fragility.csv``."""
    return {
        "wall": [wall.name if wall else "" for wall in walls],
        "mechanism": [wall.mechanism if wall else "" for wall in walls],
        "im": [curve.im for curve in curves],
        "theta": [curve.theta for curve in curves],
        "beta": [curve.beta for curve in curves],
        "se_ln_theta": [curve.se_ln_theta for curve in curves],
        "se_beta": [curve.se_beta for curve in curves],
        "log_likelihood": [curve.log_likelihood for curve in curves],
        "status": [curve.status for curve in curves],
        "bracket_low": [curve.bracket[0] if curve.bracket[0] > 0.0 else None for curve in curves],
        "bracket_high": [curve.bracket[1] if np.isfinite(curve.bracket[1]) else None for curve in curves],
        "edp_threshold": [curve.edp_threshold for curve in curves],
    }
