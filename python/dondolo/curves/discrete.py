"""Fragility curves as probabilities at levels, joined by straight lines."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from dondolo._base.arguments import (
    FloatArray,
    argument_error,
    as_array,
    as_levels,
    as_number,
    as_probabilities,
    increasing,
    shaped,
)
from dondolo._base.shown import Shown
from dondolo._fortran.records import blank_unit, describe_measure
from dondolo._storage.saved import Saved
from dondolo.curves.curve import Curve
from dondolo.errors import InputError


@dataclass(frozen=True, eq=False, init=False, repr=False)
class DiscreteFragility(Curve, Shown, Saved):
    """A fragility curve as probabilities at levels, such as the mean of a typology, with straight lines in between.

    Above the last level the probability is constant. Below the first it is a straight line from 0, at
    `no_damage_limit` if that is given, and at an intensity of 0 if it is not.

    Parameters
    ----------
    levels : array_like, shape (levels,)
        Levels of intensity, not negative and increasing; at least two.
    probability : array_like, shape (levels,)
        Of reaching the state, between 0 and 1, not decreasing; 0 at an intensity of 0.
    im : str
        Intensity measure.
    no_damage_limit : float, optional
        Intensity up to which the probability is 0, whatever the levels say.

    Raises
    ------
    InputError
        Levels and probabilities that are not a curve; an unknown measure.

    Examples
    --------
    >>> import dondolo as dd
    >>> curve = dd.DiscreteFragility([0.1, 0.2, 0.4], [0.0, 0.25, 0.75])
    >>> round(curve(0.3), 6)
    0.5
    """

    _hides_walls = True

    levels: FloatArray
    probability: FloatArray
    im: str
    no_damage_limit: float | None

    def __init__(
        self,
        levels: ArrayLike,
        probability: ArrayLike,
        *,
        im: str = "pga",
        no_damage_limit: float | None = None,
    ) -> None:
        x = increasing("levels", levels, from_zero=True)
        p = as_array("probability", probability).copy()
        if len(x) != len(p):
            raise InputError(f"{len(x)} levels, {len(p)} probabilities: must be as many")
        if not np.all((p >= 0.0) & (p <= 1.0)):
            raise argument_error(
                "not_a_probability", "probability", f" = {p[~((p >= 0.0) & (p <= 1.0))][0]:g}: must lie between 0 and 1"
            )
        if np.any(np.diff(p) < 0.0):
            i = int(np.argmax(np.diff(p) < 0.0))
            raise argument_error(
                "not_increasing", "probability", f" = {p[i]:g}, {p[i + 1]:g}: must not decrease with the level"
            )
        if x[0] == 0.0 and p[0] > 0.0:
            raise argument_error("out_of_range", "probability", f" = {p[0]:g} at the level 0: must be 0")
        none = None if no_damage_limit is None else as_number("no_damage_limit", no_damage_limit)
        if none is not None and not 0.0 <= none < np.inf:
            raise argument_error("out_of_range", "no_damage_limit", f" = {none:g}: must be finite and not negative")
        p.flags.writeable = False
        for what, value in (
            ("levels", x),
            ("probability", p),
            ("im", describe_measure(im).name),
            ("no_damage_limit", none),
        ):
            object.__setattr__(self, what, value)

    def __call__(self, x: ArrayLike) -> Any:
        """Probability of reaching the state at levels.

        Parameters
        ----------
        x : array_like
            Levels of intensity, not negative.

        Returns
        -------
        float or ndarray, shape of x

        Raises
        ------
        InputError
            A level that is negative or not a number.
        """
        values = as_levels(x)
        flat = values.ravel()
        found = np.where(flat <= self._least, 0.0, np.interp(flat, *self._lines))
        return shaped(found, values)

    def ppf(self, p: ArrayLike) -> Any:
        """Lowest levels at which the probability is p: the inverse of the curve.

        Parameters
        ----------
        p : array_like
            Probabilities, 0 to 1.

        Returns
        -------
        float or ndarray, shape of p
            In the unit of the levels; infinite above the probability of the last level.

        Raises
        ------
        InputError
            A probability that is not between 0 and 1.
        """
        values = as_probabilities("p", p)
        flat = values.ravel()
        x, y = self._lines
        after = np.clip(np.searchsorted(y, flat, side="left"), 1, len(y) - 1)
        rise = y[after] - y[after - 1]
        share = np.divide(flat - y[after - 1], rise, out=np.zeros(len(flat)), where=rise > 0.0)
        level = np.maximum(x[after - 1] + share * (x[after] - x[after - 1]), self._least)
        level = np.where(flat <= 0.0, 0.0, level)
        return shaped(np.where(flat > y[-1], np.inf, level), values)

    @property
    def _drawn_to(self) -> float:
        return float(self.levels[-1])

    @property
    def _marked(self) -> FloatArray:
        return self.levels

    @property
    def _least(self) -> float:
        """Intensity up to which the probability is 0."""
        return 0.0 if self.no_damage_limit is None else self.no_damage_limit

    @property
    def _lines(self) -> tuple[FloatArray, FloatArray]:
        """Ends of the straight lines: levels and probabilities, from where they begin."""
        if self._least >= self.levels[0]:
            return self.levels, self.probability
        return np.append(self._least, self.levels), np.append(0.0, self.probability)

    def _as_function(self) -> DiscreteFragility:
        return self

    @property
    def _end(self) -> float:
        return float(self(np.inf))

    @property
    def _corners(self) -> tuple[float, ...]:
        return (self._least, *self.levels.tolist())

    def _stored(self) -> dict[str, Any]:
        stored = {"levels": self.levels, "probability": self.probability, "im": self.im}
        # Files of versions without the limit are read, and read by them.
        return stored if self.no_damage_limit is None else stored | {"no_damage_limit": self.no_damage_limit}

    @classmethod
    def _restored(cls, levels: Any, probability: Any, im: Any, no_damage_limit: Any = None) -> DiscreteFragility:
        return cls(levels, probability, im=im, no_damage_limit=no_damage_limit)

    def _facts(self) -> list[tuple[str, str]]:
        unit = blank_unit(self.im)
        ends = f"{self.levels[0]:.4g} to {self.levels[-1]:.4g}{unit}"
        chances = f"{self.probability[0]:.4g} to {self.probability[-1]:.4g}"
        facts = [("levels", f"{len(self.levels)} of {self.im}, {ends}"), ("probability", chances)]
        if self.no_damage_limit is not None:
            facts.append(("no_damage_limit", f"{self.no_damage_limit:.4g}{unit}"))
        return facts
