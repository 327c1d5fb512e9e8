"""Checks of annual frequencies of exceedance, of a mean curve and of fractiles."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from numpy.typing import ArrayLike

from dondolo._base.arguments import FloatArray, argument_error, as_array, as_number
from dondolo.errors import InputError


def checked_frequencies(given: ArrayLike, count: int) -> FloatArray:
    """Annual frequencies of so many levels as a curve keeps them."""
    h = as_array("annual_frequency", given).copy()
    if len(h) != count:
        raise InputError(f"{count} levels, {len(h)} annual_frequency: must be as many")
    wrong = ~((h > 0.0) & (h < np.inf))
    if wrong.any():
        hint = "; leave out the levels that are never exceeded" if h[wrong][0] == 0.0 else ""
        raise argument_error("out_of_range", "annual_frequency", f" = {h[wrong][0]:g}: must be positive{hint}")
    hint = ": are these return periods? Their inverses are annual frequencies" if np.all(h > 1.0) else ""
    _check_fall("annual_frequency", h, hint)
    h.flags.writeable = False
    return h


def checked_fractiles(given: Mapping[float, ArrayLike] | None, count: int) -> dict[float, FloatArray]:
    """Fractiles as a curve keeps them, from the lowest share to the highest."""
    if given is None:
        return {}
    if not isinstance(given, Mapping):
        raise argument_error("wrong_type", "fractiles", ": must be a mapping of shares to annual frequencies")
    found: dict[float, FloatArray] = {}
    for q in sorted(given, key=lambda one: as_number("fractiles", one)):
        share, what = float(q), f"fractiles[{float(q):g}]"
        if not 0.0 < share < 1.0:
            raise argument_error("not_a_probability", what, ": the share must lie between 0 and 1")
        h = as_array(what, given[q]).copy()
        if len(h) != count:
            raise argument_error("wrong_length", what, f": {len(h)} frequencies for {count} levels: must be as many")
        if not np.all((h >= 0.0) & (h < np.inf)):
            raise argument_error(
                "out_of_range", what, f" = {h[~((h >= 0.0) & (h < np.inf))][0]:g}: must not be negative"
            )
        _check_fall(what, h)
        for lower, other in list(found.items())[-1:]:
            if np.any(h < other):
                i = int(np.argmax(h < other))
                raise argument_error(
                    "out_of_range", what, f" = {h[i]:g}: must not be less than {other[i]:g} of the fractile {lower:g}"
                )
        h.flags.writeable = False
        found[share] = h
    return found


def _check_fall(what: str, h: FloatArray, hint: str = "") -> None:
    """Refuse frequencies that increase with the level."""
    rises = h[1:] > h[:-1]
    if rises.any():
        i = int(np.argmax(rises))
        raise argument_error(
            "out_of_range", what, f" = {h[i]:.15g}, {h[i + 1]:.15g}: must not increase with the level{hint}"
        )
