"""Fits of the lognormal by Fortran, with the standard errors that belong to the sample."""

from __future__ import annotations

import dataclasses
from collections.abc import Sequence
from typing import Any, TypeVar

import numpy as np
from numpy.typing import ArrayLike

from dondolo._base.arguments import FloatArray, argument_error, as_array, as_number
from dondolo._fortran.curves import CurveData, fit_curves, warnings_of_curve
from dondolo._fortran.library import constants, warn
from dondolo._fortran.records import name_of_measure
from dondolo.curves.clusters import Errors, errors_of_sample
from dondolo.curves.fragility import Fragility
from dondolo.curves.sample import sample_of_outcomes
from dondolo.errors import DondoloWarning, InputError
from dondolo.records.record import Record

_Curve = TypeVar("_Curve", bound=Fragility)


def fit_fragility(
    levels: ArrayLike,
    collapses: ArrayLike,
    histories: ArrayLike | None = None,
    *,
    im: str = "",
    records: Sequence[Record | str] | None = None,
    events: Sequence[Any] | None = None,
) -> Fragility:
    """Fit a lognormal fragility curve by maximum likelihood (Baker 2015), to counts or to the outcome of each history.

    Parameters
    ----------
    levels : array_like, shape (levels,), or (levels, 1) with outcomes
        Levels of intensity, positive.
    collapses : array_like, shape (levels,) or (levels, histories)
        Collapses at each level, which need not be integers (weighted counts); or at each level, one row for each as in
        `Stripes.collapsed`, whether each history collapses, 1 or 0, or NaN where it was not run: of any program, or of
        a shaking table. As many histories as levels are refused where the outcomes leave open which are the rows;
        levels as a column, ``levels[:, None]``, say that these are the rows.
    histories : array_like, shape (levels,) or scalar, optional
        Histories at each level, with counts.
    im : str, optional
        Intensity measure of the levels, such as 'pga': the name on axes, and what may be compared.
    records : sequence of Record or str, shape (histories,), optional
        The record of each history, with outcomes, as such or by a name; each is of a record of its own if left out.
        Histories of one record depend on each other, and curves of the same records are compared as such.
    events : sequence, shape (histories,), optional
        A label for each history, with outcomes, in place of the events that the records have: histories of one event
        depend on each other.

    Returns
    -------
    Fragility
        Its status says whether there is a curve. That of counts has naive standard errors; that of outcomes clustered
        ones, and a bootstrap.

    Raises
    ------
    InputError
        Impossible counts or outcomes, fractions in place of counts, outcomes that are not levels first, a measure that
        is not a string, records or labels that are not one per history.

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

    Outcomes of five histories of three records, one of which was not run at the highest level:

    >>> outcomes = [[0, 0, 0, 0, 0], [0, 1, 1, 0, 0], [1, 1, float("nan"), 0, 1]]
    >>> curve = dd.fit_fragility([0.2, 0.4, 0.8], outcomes, records=["a", "a", "b", "b", "c"])
    >>> curve.errors, curve.clusters
    ('clustered', 3)
    """
    measure = name_of_measure(im)
    if np.ndim(collapses) == 2:
        if histories is not None:
            raise argument_error("not_together", "histories", ": only with counts of collapses")
        sample = sample_of_outcomes(levels, collapses, records, events)
        counts = (sample.collapsed & sample.ran).sum(axis=1, dtype=np.float64), sample.ran.sum(axis=1, dtype=np.float64)
        curve = fit(sample.levels, *counts, im=measure, sample=sample)
    else:
        for what, value in (("records", records), ("events", events)):
            if value is not None:
                raise argument_error(
                    "not_together", what, ": only with the outcomes of histories, shape (levels, histories)"
                )
        if histories is None:
            raise argument_error("not_given", "histories", ": must be given with counts of collapses")
        curve = fit(*_counts(levels, collapses, histories), given=True, im=measure)
    if curve.has_fit:
        warn(warnings_of_fit(curve))
    return curve


def warnings_of_fit(curve: Fragility) -> list[DondoloWarning]:
    """Warnings of a fitted curve of counts without a wall: it extrapolates, or is nearly flat."""
    return warnings_of_curve(None, curve.levels, 0.0, curve.status, curve.theta, curve.beta, curve.bracket)


def counts_are_flat(levels: FloatArray, collapses: ArrayLike, histories: int) -> bool:
    """Whether collapses hardly increase with the level: whether the binomial fit to them is nearly flat."""
    counts = np.asarray(collapses, dtype=np.float64)
    (found,) = fit_curves(levels, counts[None, :], np.full((1, len(levels)), float(histories)))
    return found.status == "nearly_flat"


def fit(
    levels: FloatArray, collapses: FloatArray, histories: FloatArray, *, given: bool = False, **origin: Any
) -> Fragility:
    """Fit without a warning, to given counts or others; with a sample in `origin`, standard errors are clustered."""
    (data,) = fit_curves(levels, collapses[None, :], histories[None, :], given=given)
    curve = curve_of(data, levels, collapses, histories, **origin)
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
    is_there = data.status in constants().fitted

    def of_fit(value: float) -> float:
        return value if is_there else np.nan

    both = of_fit(data.covariance)
    covariance = np.array([[of_fit(data.var_ln_theta), both], [both, of_fit(data.var_beta)]])
    return Fragility(
        theta=of_fit(data.theta),
        beta=of_fit(data.beta),
        covariance=covariance,
        status=data.status,
        log_likelihood=of_fit(data.log_likelihood),
        deviance=of_fit(data.deviance),
        deviance_dof=data.deviance_dof,
        bracket=(data.bracket_low, np.inf if data.bracket_high >= np.finfo(np.float64).max else data.bracket_high),
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
