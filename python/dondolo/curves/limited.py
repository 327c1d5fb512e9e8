"""Lognormal curves that count within limits alone, as fragility models of OpenQuake have them."""

from __future__ import annotations

from dataclasses import dataclass, field, fields
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from dondolo._base.arguments import argument_error, as_levels, shaped
from dondolo._fortran.records import blank_unit
from dondolo._storage.saved import part_of_results
from dondolo.curves.fragility import Fragility


@part_of_results
class Limits(NamedTuple):
    """Limits of a function, in the unit of its levels; None: not given.

    Attributes
    ----------
    no_damage_limit : float or None
        Intensity up to which there is no damage.
    min_iml, max_iml : float or None
        Range of a continuous function, constant beyond; None for a discrete one.
    """

    no_damage_limit: float | None = None
    min_iml: float | None = None
    max_iml: float | None = None


@dataclass(frozen=True, eq=False, repr=False, kw_only=True)
class LimitedFragility(Fragility):
    """A lognormal curve with limits: 0 up to `no_damage_limit`, constant below `min_iml` and above `max_iml`.

    Curves of `read_nrml` have this class; theta and beta are those of the curve without limits.

    Attributes
    ----------
    limits : Limits
    """

    limits: Limits = field(default_factory=Limits)

    def __post_init__(self) -> None:
        super().__post_init__()
        none, low, high = self.limits
        if low is not None and high is not None and not low < high:
            raise argument_error("not_increasing", "min_iml", f" = {low:g}, max_iml = {high:g}: must increase")
        if none is not None and high is not None and not none < high:
            raise argument_error("out_of_range", "no_damage_limit", f" = {none:g}: must be below max_iml = {high:g}")

    def __call__(self, x: ArrayLike) -> Any:
        values = as_levels(x)
        none, low, high = self.limits
        flat = values.ravel()
        inside = np.clip(flat, 0.0 if low is None else low, np.inf if high is None else high)
        found = np.asarray(super().__call__(inside))
        return shaped(found if none is None else np.where(flat <= none, 0.0, found), values)

    def ppf(self, p: ArrayLike) -> Any:
        self._need_fit()
        values, _ = self._probits(p)
        none, low, _ = self.limits
        flat = values.ravel()
        level = np.asarray(super().ppf(flat))
        # The lowest level with the probability: where the curve jumps, that of the jump
        least = 0.0 if none is None else none
        level = np.where(level <= max(least, 0.0 if low is None else low), least, level)
        return shaped(np.where(flat > self(np.inf), np.inf, level), values)

    @property
    def _end(self) -> float:
        return float(self(np.inf))

    @property
    def _corners(self) -> tuple[float, ...]:
        return tuple(limit for limit in self.limits if limit is not None)

    def _facts(self) -> list[tuple[str, str]]:
        unit = blank_unit(self.im)
        named = zip(Limits._fields, self.limits, strict=True)
        return [*super()._facts(), *((name, f"{limit:.6g}{unit}") for name, limit in named if limit is not None)]


def limited(curve: Fragility, limits: Limits) -> Fragility:
    """The curve of given parameters with limits; the same curve if it has them, or if there are none.

    Standard errors, which are those of a curve without limits, are left out.
    """
    if getattr(curve, "limits", Limits()) == limits:
        return curve
    plain = Fragility.of_parameters(curve.theta, curve.beta, im=curve.im)
    if limits == Limits():
        return plain
    return LimitedFragility(**{one.name: getattr(plain, one.name) for one in fields(Fragility)}, limits=limits)
