"""Checks of a wall, a line each: what it withstands, what is asked of it, and how likely its collapse is.

Ratios, verdicts and accelerations are those of the sheet; page, report and calculation report show them alike.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from dondolo.curves.fragility import Fragility

if TYPE_CHECKING:
    from dondolo.checks.ntc import CodeCheck, Verdict


class Chance(NamedTuple):
    """A probability of collapse by a fragility curve.

    Attributes
    ----------
    value : float
    low, high : float
        Ends of its 95 % confidence interval; NaN for a curve without standard errors.
    """

    value: float
    low: float
    high: float


class StateLine(NamedTuple):
    """A kinematic check at a glance.

    Attributes
    ----------
    method, limit_state : str
    unit : str
        'm/s2' of a linear check, 'm' of a nonlinear one.
    capacity, demand : float
        In this unit: q a_0* and that over the ratio, or d_C and d_D of the curve that the ratio is of. NaN if the check
        is not applicable.
    ratio : float
        Capacity / demand, of the nonlinear checks not below that at activation; NaN if it is not applicable.
    site_pga, allowed_pga : float
        a_g S of the site, and the largest that the check allows [g].
    verdict : Verdict
    required : bool
        Whether the verdict on the wall rests on it.
    at_allowed, at_site : Chance or None
        Probability of collapse at these accelerations; None without a curve.
    """

    method: str
    limit_state: str
    unit: str
    capacity: float
    demand: float
    ratio: float
    site_pga: float
    allowed_pga: float
    verdict: Verdict
    required: bool
    at_allowed: Chance | None
    at_site: Chance | None


def side_by_side(check: CodeCheck, curve: Fragility | None) -> tuple[StateLine, ...]:
    """The kinematic checks of a wall, in the order of the sheet.

    Parameters
    ----------
    check : CodeCheck
        The check.
    curve : Fragility or None
        Of collapse; one of another measure than 'pga', or without parameters, gives no probability.
    """
    return tuple(_line(check, *key, curve) for key in check.capacities or check.not_applicable)


def _line(check: CodeCheck, method: str, state: str, curve: Fragility | None) -> StateLine:
    key = (method, state)
    site, allowed = check.value("site", state, "pga"), check._outcome(key, "capacity_pga")
    ratio = check._outcome(key, "ratio")
    if method == "linear":
        unit, behaviour = "m/s2", check._row("linear", state, "behaviour")
        capacity = check.value("mechanism", "", "a_0") * (1.0 if behaviour is None else behaviour.value)
        demand = capacity / ratio
    else:
        taken = ("untied", state) if ties_not_counted(check, state) else key
        unit, capacity, demand = "m", check._outcome(taken, "displacement"), check._outcome(taken, "demand")
    if np.isnan(ratio):
        capacity = demand = np.nan
    return StateLine(
        method,
        state,
        unit,
        capacity,
        demand,
        ratio,
        site,
        allowed,
        check._verdict(key),
        key in check.required,
        chance_at(curve, allowed),
        chance_at(curve, site),
    )


def ties_not_counted(check: CodeCheck, state: str) -> str:
    """The ties that the ratio of a nonlinear check does not count, such as 'tie 1'; '' if it counts all."""
    less, tied = (check._row("nonlinear", state, name) for name in ("less_zeta", "tied_zeta"))
    return less.item if less is not None and tied is not None and less.value > tied.value else ""


def chance_at(curve: Fragility | None, pga: float) -> Chance | None:
    """Probability of collapse at a peak acceleration [g]; None where no curve gives it."""
    if curve is None or not curve.has_fit or curve.im != "pga" or np.isnan(pga):
        return None
    low, high = curve.interval(pga) if curve.has_errors else (np.nan, np.nan)
    return Chance(float(curve(pga)), float(low), float(high))
