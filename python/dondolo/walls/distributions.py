"""Distributions of the properties of walls, by their quantiles."""

from __future__ import annotations

import dataclasses
import math
from dataclasses import KW_ONLY, dataclass
from typing import Any, Protocol, runtime_checkable

import numpy as np
from numpy.typing import ArrayLike

from dondolo._base.arguments import FloatArray, argument_error, as_array, as_number
from dondolo._fortran.library import constants
from dondolo.errors import InputError

__all__ = ["Choice", "Lognormal", "Normal", "Triangular", "Uniform"]


def __dir__() -> list[str]:
    return __all__


@runtime_checkable
class Distribution(Protocol):
    """Anything with quantiles: the distributions of dondolo, frozen distributions of SciPy, objects of one's own."""

    def ppf(self, q: ArrayLike, /) -> FloatArray:
        """Values that are exceeded with probability 1 - q.

        Parameters
        ----------
        q : array_like
            Probabilities, between 0 and 1.

        Returns
        -------
        float or ndarray, shape of q
            In the unit of the parameters; NaN for what is no probability.
        """
        ...


@dataclass(frozen=True)
class Uniform:
    """Uniform distribution on [low, high].

    Parameters
    ----------
    low, high : float
        The smallest and the largest value.

    Raises
    ------
    InputError
        A parameter is not a finite number, or `high` not greater than `low`.

    Examples
    --------
    >>> import dondolo as dd
    >>> float(dd.distributions.Uniform(2.4, 3.6).ppf(0.5))
    3.0
    """

    low: float
    high: float

    def __post_init__(self) -> None:
        _check_numbers(self)
        _check_ends(self.low, self.high)

    def ppf(self, q: ArrayLike, /) -> FloatArray:
        """Values that are exceeded with probability 1 - q, see `Distribution`."""
        from scipy import stats

        quantiles: FloatArray = stats.uniform(self.low, self.high - self.low).ppf(q)
        return quantiles


@dataclass(frozen=True)
class Triangular:
    """Triangular distribution defined by its minimum, mode and maximum.

    Parameters
    ----------
    low, mode, high : float
        The smallest, the most likely and the largest value.

    Raises
    ------
    InputError
        A parameter is not a finite number, `high` not greater than `low`, or `mode` not between them.

    Examples
    --------
    >>> import dondolo as dd
    >>> round(float(dd.distributions.Triangular(0.3, 0.38, 0.5).ppf(0.5)), 4)
    0.3905
    """

    low: float
    mode: float
    high: float

    def __post_init__(self) -> None:
        _check_numbers(self)
        _check_ends(self.low, self.high)
        if not self.low <= self.mode <= self.high:
            raise argument_error(
                "out_of_range", "mode", f" = {self.mode:g}: must lie between {self.low:g} and {self.high:g}"
            )

    def ppf(self, q: ArrayLike, /) -> FloatArray:
        """Values that are exceeded with probability 1 - q, see `Distribution`."""
        from scipy import stats

        width = self.high - self.low
        quantiles: FloatArray = stats.triang((self.mode - self.low) / width, self.low, width).ppf(q)
        return quantiles


class _CutOff:
    """A distribution whose ends must be named: they are no parameters of the whole one."""

    def __new__(cls, *values: Any, **named: Any) -> Any:
        if len(values) > 2:
            ends = ", ".join(f"{name}={value!r}" for name, value in zip(("low", "high"), values[2:], strict=False))
            raise InputError(f"{cls.__name__}: takes two numbers; where it is cut off must be named: {ends}")
        return super().__new__(cls)


@dataclass(frozen=True)
class Normal(_CutOff):
    """Normal distribution, optionally truncated.

    Parameters
    ----------
    mean, sd : float
        Mean and standard deviation, before truncation.
    low, high : float, optional
        Bounds of the truncated distribution: the probability beyond is redistributed in proportion, so that the
        distribution keeps its shape and no samples gather at the bounds.

    Raises
    ------
    InputError
        A parameter is not a finite number, `sd` not positive, `high` not greater than `low`, or next to nothing of the
        distribution between them.

    Examples
    --------
    >>> import dondolo as dd
    >>> float(dd.distributions.Normal(3.0, 0.2, low=2.5, high=3.5).ppf(0.5))
    3.0
    """

    mean: float
    sd: float
    _: KW_ONLY
    low: float | None = None
    high: float | None = None

    def __post_init__(self) -> None:
        _check_numbers(self)
        if not self.sd > 0.0:
            raise argument_error("out_of_range", "sd", f" = {self.sd:g}: must be positive")
        _check_ends(self.low, self.high)
        _check_share(*self._ends())

    def _ends(self) -> tuple[float, float]:
        """Where the standard normal distribution behind it is cut off."""
        low = -math.inf if self.low is None else (self.low - self.mean) / self.sd
        return low, math.inf if self.high is None else (self.high - self.mean) / self.sd

    def ppf(self, q: ArrayLike, /) -> FloatArray:
        """Values that are exceeded with probability 1 - q, see `Distribution`."""
        return self.mean + self.sd * _cut_normal(q, *self._ends())


@dataclass(frozen=True)
class Lognormal(_CutOff):
    """Lognormal distribution, optionally truncated.

    Parameters
    ----------
    theta : float
        Median, before truncation.
    beta : float
        Standard deviation of the logarithm, before truncation.
    low, high : float, optional
        Bounds of the truncated distribution, as for `Normal`.

    Raises
    ------
    InputError
        A parameter is not a positive finite number, `high` not greater than `low`, or next to nothing of the
        distribution between them.

    Examples
    --------
    >>> import dondolo as dd
    >>> float(dd.distributions.Lognormal(0.3, 0.1).ppf(0.5))
    0.3
    """

    theta: float
    beta: float
    _: KW_ONLY
    low: float | None = None
    high: float | None = None

    def __post_init__(self) -> None:
        _check_numbers(self)
        for what in ("theta", "beta", "low", "high"):
            value = getattr(self, what)
            if value is not None and not value > 0.0:
                raise argument_error("out_of_range", what, f" = {value:g}: must be positive")
        _check_ends(self.low, self.high)
        _check_share(*self._ends())

    def _ends(self) -> tuple[float, float]:
        """Where the standard normal distribution behind it is cut off."""
        low = -math.inf if self.low is None else math.log(self.low / self.theta) / self.beta
        return low, math.inf if self.high is None else math.log(self.high / self.theta) / self.beta

    def ppf(self, q: ArrayLike, /) -> FloatArray:
        """Values that are exceeded with probability 1 - q, see `Distribution`."""
        return self.theta * np.exp(self.beta * _cut_normal(q, *self._ends()))


@dataclass(frozen=True)
class Choice:
    """Discrete distribution over some values.

    Parameters
    ----------
    values : sequence of float
        The values, increasing.
    probabilities : sequence of float, optional
        Their probabilities, with the sum 1; equal if left out.

    Raises
    ------
    InputError
        The values do not increase, or there are not as many probabilities, not negative and with the sum 1.

    Examples
    --------
    >>> import dondolo as dd
    >>> dd.distributions.Choice((0.25, 0.38), (0.7, 0.3)).ppf([0.5, 0.8]).tolist()
    [0.25, 0.38]
    """

    values: tuple[float, ...]
    probabilities: tuple[float, ...] = None  # type: ignore[assignment]

    def __post_init__(self) -> None:
        values = as_array("values", self.values)
        shares = np.full(len(values), 1.0 / len(values))
        if self.probabilities is not None:
            shares = as_array("probabilities", self.probabilities)
        if len(shares) != len(values):
            raise InputError(f"{len(values)} values, {len(shares)} probabilities: must be as many")
        if not (np.diff(values) > 0.0).all():
            raise argument_error("not_increasing", "values", ": must rise from one to the next")
        if not ((shares >= 0.0).all() and abs(shares.sum() - 1.0) < 1e-9):
            raise argument_error(
                "out_of_range", "probabilities", f": must not be negative and have the sum 1, not {shares.sum():.6g}"
            )
        object.__setattr__(self, "values", tuple(values.tolist()))
        object.__setattr__(self, "probabilities", tuple(shares.tolist()))

    def ppf(self, q: ArrayLike, /) -> FloatArray:
        """Values that are exceeded with probability 1 - q, see `Distribution`."""
        chance = np.asarray(q, dtype=np.float64)
        ends = np.cumsum(self.probabilities)[:-1]
        found = np.asarray(self.values)[np.searchsorted(ends, chance)]
        return np.where((chance >= 0.0) & (chance <= 1.0), found, np.nan)[()]


def _cut_normal(q: ArrayLike, low: float, high: float) -> FloatArray:
    """Quantiles of the standard normal distribution between two ends."""
    from scipy import stats

    quantiles: FloatArray = stats.truncnorm(low, high).ppf(q)
    return quantiles


def _check_share(low: float, high: float) -> None:
    """Enough of the standard normal distribution must be left between two ends."""
    least = constants().least_share
    share = 0.5 * (math.erfc(-high / math.sqrt(2.0)) - math.erfc(-low / math.sqrt(2.0)))
    if not share >= least:
        raise InputError(
            f"low, high: leave {share:.3g} of the distribution between them, must leave {least:g} at least"
        )


def _check_numbers(distribution: Any) -> None:
    """Make the parameters of a distribution finite numbers."""
    for field in dataclasses.fields(distribution):
        value = getattr(distribution, field.name)
        if value is None:
            continue
        number = as_number(field.name, value)
        if not math.isfinite(number):
            raise argument_error("out_of_range", field.name, f" = {number}: must be finite")
        object.__setattr__(distribution, field.name, number)


def _check_ends(low: float | None, high: float | None) -> None:
    """The ends of a distribution must leave something between them."""
    if low is not None and high is not None and not low < high:
        raise argument_error("out_of_range", "high", f" = {high:g}: must be greater than low = {low:g}")


def no_distribution(what: str, given: Any) -> InputError:
    """The error of what is no distribution; of a text as cases have it, with what to write here."""
    kinds = {kind.__name__.lower(): kind.__name__ for kind in (Uniform, Triangular, Normal, Lognormal)}
    sentence = f"{what} = {given!r}: must be a distribution"
    if isinstance(given, str):
        name, opening, rest = given.strip().partition("(")
        if opening and name.strip().lower() in kinds:
            values = rest.rstrip(" )").split(",")
            ends = [f"{end}={value.strip()}" for end, value in zip(("low", "high"), values[2:], strict=False)]
            cut = name.strip().lower() in ("normal", "lognormal")
            told = [value.strip() for value in values[: 2 if cut else None]] + (ends if cut else [])
            sentence += (
                f", here dd.distributions.{kinds[name.strip().lower()]}({', '.join(told)}); such texts are for cases"
            )
    return InputError(sentence)
