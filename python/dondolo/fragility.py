"""Fragility curves: the lognormal fitted by Fortran, and what statistics adds to it."""

from __future__ import annotations

import os
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from dondolo import _binding, tables
from dondolo.errors import DondoloError, InputError

if TYPE_CHECKING:
    from dondolo.stripes import Stripes
    from dondolo.walls import Wall

FloatArray = _binding.FloatArray
Interval = tuple[float, float]


@dataclass(frozen=True, eq=False, repr=False)
class Fragility:
    """A fragility curve P(C | IM = x) = Phi(ln(x/theta)/beta), equation (5) of Nale et al., or why there is none.

    Attributes
    ----------
    theta, beta : float
        Median, in the unit of the levels, and dispersion (standard deviation of the logarithm); NaN without a fit.
    covariance : ndarray, shape (2, 2)
        Covariance of ln theta and beta from the Fisher information.
    status : str
        'ok', 'extrapolated' (theta outside the levels), 'no_collapse', 'all_collapse', 'separated', 'single_level' or
        'decreasing'; the first two have a curve.
    log_likelihood : float
        With the binomial coefficients; NaN without a fit.
    bracket : (float, float)
        Levels between which half of the histories begin to collapse; 0 or inf where a side is open.
    levels, collapses, histories : ndarray, shape (levels,)
        What it was fitted to.
    im : str
        Intensity measure.
    edp : float or None
        Rotation / capacity of the damage state; None where only counts were given.
    saturation : float
        What the probability tends to: 1, but for populations in which no mechanism may occur (`Group`); theta and beta
        are then those of the walls in which one can, and the probability is that of all.
    stripes : Stripes or None
        The analysis behind it, which `bootstrap` needs.
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
    edp: float | None = None
    saturation: float = 1.0
    stripes: Stripes | None = field(default=None, repr=False)

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
        values = _levels_of(x)
        return shaped(self.saturation * _binding.probability(self.theta, self.beta, values.ravel()), values)

    def interval(self, x: ArrayLike, level: float = 0.95, method: str = "delta") -> tuple[Any, Any]:
        """Confidence interval of the probability at levels (of each on its own, not of the curve as a whole).

        Parameters
        ----------
        x : array_like
            Levels of intensity, positive.
        level : float
            Confidence, between 0 and 1.
        method : {'delta', 'profile'}
            From the covariance, on the scale of the normal quantile of the probability; or from the profile likelihood,
            which is slower and right for small counts too.

        Returns
        -------
        low, high : float or ndarray, shape of x
        """
        self._need_fit()
        quantile = _quantile(level)
        values = _levels_of(x)
        if not np.all(values > 0.0):
            raise InputError(f"x = {values.min():g}: must be positive")
        at = np.log(values.ravel() / self.theta)
        probit = at / self.beta
        # Gradient of the probit with respect to (ln theta, beta)
        gradient = np.stack([np.full_like(at, -1.0 / self.beta), -probit / self.beta])
        half = quantile * np.sqrt(np.einsum("ik,ij,jk->k", gradient, self.covariance, gradient))
        if method == "delta":
            low, high = probit - half, probit + half
        elif method == "profile":
            low, high = self._likelihood().probit_interval(at, half, 0.5 * quantile**2)
        else:
            raise InputError(f"method = {method!r}: must be one of 'delta', 'profile'")
        from scipy.special import ndtr

        return shaped(self.saturation * ndtr(low), values), shaped(self.saturation * ndtr(high), values)

    def parameter_interval(self, level: float = 0.95, method: str = "delta") -> dict[str, Interval]:
        """Confidence intervals of theta and beta.

        Parameters
        ----------
        level : float
            Confidence, between 0 and 1.
        method : {'delta', 'profile'}
            From the covariance, on logarithmic scales; or from the profile likelihood, where 0 and inf are bounds that
            the data leave open.

        Returns
        -------
        dict
            'theta' and 'beta': (low, high).
        """
        self._need_fit()
        quantile = _quantile(level)
        if method == "delta":
            theta = _spread(self.theta, quantile * self.se_ln_theta)
            return {"theta": theta, "beta": _spread(self.beta, quantile * self.se_beta / self.beta)}
        if method != "profile":
            raise InputError(f"method = {method!r}: must be one of 'delta', 'profile'")
        likelihood = self._likelihood()
        drop = 0.5 * quantile**2
        low, high = likelihood.median_interval(quantile * self.se_ln_theta, drop)
        flat, steep = likelihood.slope_interval(quantile * self.se_beta / self.beta**2, drop)
        with np.errstate(over="ignore"):
            theta = (self.theta * float(np.exp(low)), self.theta * float(np.exp(high)))
        return {"theta": theta, "beta": (1.0 / steep, 1.0 / flat if flat > 0.0 else np.inf)}

    def bootstrap(self, n: int = 2000, seed: int | np.random.Generator | None = 0) -> Bootstrap:
        """Fit the curve again to records drawn with replacement.

        A record stays whole: it brings its histories at all levels and of both polarities, so that their dependence is
        kept, which the covariance neglects. All fits are one call of Fortran.

        Parameters
        ----------
        n : int
            Number of samples.
        seed : int, Generator or None
            Of the random numbers; None: different every time.

        Returns
        -------
        Bootstrap
        """
        self._need_fit()
        if self.stripes is None:
            raise DondoloError("bootstrap: needs the stripes, so it is for curves that come from Stripes.fit")
        if not isinstance(n, (int, np.integer)) or n < 1:
            raise InputError(f"n = {n!r}: must be a whole number, at least 1")
        return resample(self.stripes, draw(self.stripes, n, seed))

    def to_frame(self) -> Any:
        """The curve as a pandas DataFrame of one row."""
        return tables.frame(tables.fragility_table([self.wall], [self]))

    def to_csv(self, path: str | os.PathLike[str]) -> None:
        """Write the curve as the executable's ``_fragility.csv``."""
        comments = [f"unit of theta: {_binding.unit_of(self.im) or '1'}"] if self.im else []
        tables.write_csv(path, tables.fragility_table([self.wall], [self]), comments)

    def _need_fit(self) -> None:
        if not self.has_fit:
            low, high = self.bracket
            raise DondoloError(
                f"no curve was fitted (status '{self.status}'): the median lies between {low:g} and {high:g}"
            )

    def _likelihood(self) -> Any:
        from dondolo._likelihood import Likelihood

        return Likelihood(self.levels, self.collapses, self.histories, self.theta, self.beta)

    def _facts(self) -> list[tuple[str, str]]:
        unit = f" {_binding.unit_of(self.im)}".rstrip()
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

    def __repr__(self) -> str:
        return "<Fragility: " + ", ".join(f"{what} {text}" for what, text in self._facts()) + ">"

    def _repr_html_(self) -> str:
        return tables.html_of("Fragility", self._facts())


@dataclass(frozen=True, eq=False, repr=False)
class Bootstrap:
    """Curves fitted to records drawn with replacement.

    Attributes
    ----------
    theta, beta : ndarray, shape (samples,)
        Parameters of each; NaN where a sample has no fit.
    status : ndarray of str, shape (samples,)
        What came of each fit; '' where it failed.
    """

    theta: FloatArray
    beta: FloatArray
    status: np.ndarray[Any, Any]

    @property
    def without_fit(self) -> float:
        """Share of the samples without a fit; they take no part in the intervals."""
        return float(np.mean(np.isnan(self.theta)))

    def interval(self, x: ArrayLike, level: float = 0.95) -> tuple[Any, Any]:
        """Percentile interval of the probability at levels; arguments as those of `Fragility.interval`."""
        return self._interval(x, level, np.ones_like(self.theta))

    def _interval(self, x: ArrayLike, level: float, saturation: FloatArray) -> tuple[Any, Any]:
        """The interval of curves that tend to a saturation."""
        from scipy.special import ndtr

        values = _levels_of(x)
        theta, beta = self._fitted()
        with np.errstate(divide="ignore"):
            curves = ndtr(np.log(values.ravel() / theta[:, None]) / beta[:, None])
        curves *= saturation[~np.isnan(self.theta), None]
        low, high = np.quantile(curves, tails(level), axis=0)
        return shaped(low, values), shaped(high, values)

    def parameter_interval(self, level: float = 0.95) -> dict[str, Interval]:
        """Percentile intervals of theta and beta."""
        ends = tails(level)
        return {
            name: tuple(float(end) for end in np.quantile(values, ends))
            for name, values in zip(("theta", "beta"), self._fitted(), strict=True)
        }  # type: ignore[return-value]

    def _fitted(self) -> tuple[FloatArray, FloatArray]:
        fitted = ~np.isnan(self.theta)
        if not fitted.any():
            raise DondoloError("none of the samples of the bootstrap has a fit")
        return self.theta[fitted], self.beta[fitted]

    def __repr__(self) -> str:
        return f"<Bootstrap of {len(self.theta)} samples, {self.without_fit:.1%} without a fit>"


def fit_fragility(levels: ArrayLike, collapses: ArrayLike, histories: ArrayLike, im: str = "") -> Fragility:
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
    >>> curve = fit_fragility([0.2, 0.4], [11, 33], 44)
    >>> round(curve.theta, 9), round(curve.beta, 9)
    (0.282842712, 0.513830774)
    """
    curve = fit(*_counts(levels, collapses, histories), im=im)
    if curve.status == "extrapolated":
        low, high = curve.levels.min(), curve.levels.max()
        _binding.warn([f"theta = {curve.theta:.4g} lies outside the levels {low:g} to {high:g}: the fit extrapolates"])
    return curve


def fit(levels: FloatArray, collapses: FloatArray, histories: FloatArray, **origin: Any) -> Fragility:
    """Fit without a warning."""
    curves, statuses = _binding.fit_curves(levels, collapses[None, :], histories[None, :])
    return curve_of(_binding.CurveData(statuses[0], curves[0]), levels, collapses, histories, **origin)


def curve_of(
    data: _binding.CurveData, levels: FloatArray, collapses: FloatArray, histories: FloatArray, **origin: Any
) -> Fragility:
    """A curve as Fortran has fitted it."""
    theta, beta, var_theta, both, var_beta, height, low, high = (float(value) for value in data.numbers)
    if data.status not in ("ok", "extrapolated"):
        theta = beta = var_theta = both = var_beta = height = np.nan
    largest = np.finfo(np.float64).max
    covariance = np.array([[var_theta, both], [both, var_beta]])
    for array in (covariance, levels, collapses, histories):
        array.flags.writeable = False
    return Fragility(
        theta,
        beta,
        covariance,
        data.status,
        height,
        (low, np.inf if high >= largest else high),
        levels,
        collapses,
        histories,
        **origin,
    )


def draw(stripes: Stripes, n: int, seed: int | np.random.Generator | None) -> np.ndarray[Any, Any]:
    """How often each record comes in each of n samples drawn with replacement: (samples, records)."""
    records = int(stripes.record_index.max()) + 1
    return np.random.default_rng(seed).multinomial(records, np.full(records, 1.0 / records), size=n)


def resample(stripes: Stripes, times: np.ndarray[Any, Any]) -> Bootstrap:
    """Fit the stripes again with each record taken so many times."""
    place = stripes.record_index
    collapses = times[:, place] @ stripes.collapsed.T.astype(np.float64)
    histories = np.repeat(times[:, place].sum(axis=1, keepdims=True), len(stripes.levels), axis=1)
    curves, statuses = _binding.fit_curves(stripes.levels, collapses, histories.astype(np.float64))
    status = np.array(statuses)
    fitted = np.isin(status, ("ok", "extrapolated"))
    return Bootstrap(np.where(fitted, curves[:, 0], np.nan), np.where(fitted, curves[:, 1], np.nan), status)


def shaped(values: FloatArray, like: FloatArray) -> Any:
    """Values in the shape of the argument: a float for a scalar."""
    return float(values[0]) if like.ndim == 0 else values.reshape(like.shape)


def _counts(levels: ArrayLike, collapses: ArrayLike, histories: ArrayLike) -> tuple[FloatArray, FloatArray, FloatArray]:
    # Copies: the curve keeps them, and what the caller does with theirs must not change it.
    x, z = _binding.as_array("levels", levels).copy(), _binding.as_array("collapses", collapses).copy()
    if np.ndim(histories) == 0:
        n = np.full(len(x), _binding.as_number("histories", histories))
    else:
        n = _binding.as_array("histories", histories).copy()
    if not len(x) == len(z) == len(n):
        raise InputError(f"{len(x)} levels, {len(z)} collapses, {len(n)} histories: must be as many")
    return x, z, n


def _levels_of(x: ArrayLike) -> FloatArray:
    try:
        values = np.asarray(x, dtype=np.float64)
    except (TypeError, ValueError, OverflowError):
        raise InputError("x: must be numbers") from None
    if not np.all(values >= 0.0):
        raise InputError("x: must be levels of intensity, not negative")
    return values


def _quantile(level: float) -> float:
    from scipy.special import ndtri

    return float(ndtri(tails(level)[1]))


def tails(level: float) -> tuple[float, float]:
    """Probabilities at the ends of an interval of a confidence."""
    level = _binding.as_number("level", level)
    if not 0.0 < level < 1.0:
        raise InputError(f"level = {level}: must lie between 0 and 1")
    return 0.5 - 0.5 * level, 0.5 + 0.5 * level


def _spread(value: float, log_width: float) -> Interval:
    return value * float(np.exp(-log_width)), value * float(np.exp(log_width))
