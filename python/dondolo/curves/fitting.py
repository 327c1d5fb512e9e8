"""Fits of the lognormal by Fortran, with the standard errors that belong to the sample."""

from __future__ import annotations

import dataclasses
from typing import Any, TypeVar

import numpy as np
from numpy.typing import ArrayLike

from dondolo._base.arguments import FloatArray, as_array, as_number
from dondolo._fortran.curves import CurveData, fit_curves, warnings_of_curve
from dondolo._fortran.library import constants, warn
from dondolo._fortran.records import name_of_measure
from dondolo.curves.clusters import Errors, errors_of_sample
from dondolo.curves.fragility import Fragility
from dondolo.errors import DondoloWarning, InputError

_Curve = TypeVar("_Curve", bound=Fragility)


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
        Counts that cannot be, a measure that is no text.

    Warns
    -----
    DondoloWarning
        The median lies outside the levels, or the collapses hardly become more frequent with the level.

    Examples
    --------
    >>> import dondolo as dd
    >>> curve = dd.fit_fragility([0.2, 0.4], [11, 33], 44)
    >>> round(curve.theta, 9), round(curve.beta, 9)
    (0.282842712, 0.513830774)
    """
    curve = fit(*_counts(levels, collapses, histories), im=name_of_measure(im))
    if curve.has_fit:
        warn(warnings_of_fit(curve))
    return curve


def warnings_of_fit(curve: Fragility) -> list[DondoloWarning]:
    """Warnings of a fitted curve of counts without a wall: it extrapolates, or is nearly flat."""
    numbers = np.array([curve.theta, curve.beta, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0])
    return warnings_of_curve(None, curve.levels, 0.0, CurveData(curve.status, numbers))


def counts_are_flat(levels: FloatArray, collapses: ArrayLike, histories: int) -> bool:
    """Whether collapses hardly increase with the level: whether the binomial fit to them is nearly flat."""
    counts = np.asarray(collapses, dtype=np.float64)
    return fit_curves(levels, counts[None, :], np.full((1, len(levels)), float(histories)))[1][0] == "nearly_flat"


def fit(levels: FloatArray, collapses: FloatArray, histories: FloatArray, **origin: Any) -> Fragility:
    """Fit without a warning; with a sample in `origin`, its standard errors are clustered."""
    curves, statuses = fit_curves(levels, collapses[None, :], histories[None, :])
    curve = curve_of(CurveData(statuses[0], curves[0]), levels, collapses, histories, **origin)
    if curve.has_fit and curve.sample is not None:
        return with_errors(curve, errors_of_sample(curve.sample, (curve.theta, curve.beta)))
    return curve


def with_errors(curve: _Curve, errors: Errors) -> _Curve:
    """A curve with other standard errors."""
    errors.covariance.flags.writeable = False
    return dataclasses.replace(curve, **errors._asdict())


def curve_of(
    data: CurveData, levels: FloatArray, collapses: FloatArray, histories: FloatArray, **origin: Any
) -> Fragility:
    """A curve as Fortran has fitted it."""
    theta, beta, var_theta, both, var_beta, height, low, high = (float(value) for value in data.numbers)
    if data.status not in constants().fitted:
        theta = beta = var_theta = both = var_beta = height = np.nan
    largest = np.finfo(np.float64).max
    covariance = np.array([[var_theta, both], [both, var_beta]])
    return Fragility(
        theta=theta,
        beta=beta,
        covariance=covariance,
        status=data.status,
        log_likelihood=height,
        bracket=(low, np.inf if high >= largest else high),
        levels=levels,
        collapses=collapses,
        histories=histories,
        naive_covariance=covariance,
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
