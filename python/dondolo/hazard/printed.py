"""Published frequencies that rise with the level, though only in the last digit that is printed."""

from __future__ import annotations

from decimal import Decimal

import numpy as np
from numpy.typing import NDArray

from dondolo._base.arguments import FloatArray
from dondolo.errors import DondoloWarning


def levelled(values: FloatArray) -> tuple[FloatArray, NDArray[np.bool_]]:
    """Values that must not increase, without rises of up to one unit of the last printed digit.

    Parameters
    ----------
    values : ndarray, shape (n,)
        As they were read from decimals.

    Returns
    -------
    ndarray, shape (n,)
        The value before such a rise is raised to the one after it, which is on the safe side for frequencies; larger
        rises stay, and so do those of values with one significant digit, whose last digit is a tenth of them or more.
    ndarray of bool, shape (n,)
        Which values were raised.
    """
    if not np.any(values[1:] > values[:-1]):
        return values.copy(), np.zeros(len(values), dtype=bool)
    units = _units_of_last_digit(values)
    found = values.copy()
    for i in range(len(values) - 2, -1, -1):
        unit = max(units[i], units[i + 1]) * (1.0 + 1e-6)
        if found[i] < found[i + 1] <= values[i] + unit and unit <= 0.1 * abs(found[i + 1]):
            found[i] = found[i + 1]
    return found, found > values


def note_of(place: str, raised: int) -> DondoloWarning:
    """The note that a curve was levelled."""
    text = f"{place}: {raised} frequencies rise with the level in their last printed digit and were levelled"
    return DondoloWarning(text, "note")


def _units_of_last_digit(values: FloatArray) -> FloatArray:
    """Unit of the last digit of each value: the other values show how many zeros are missing at its end."""
    parts = [Decimal(repr(float(value))) if np.isfinite(value) else Decimal(0) for value in values]
    decimals = max((-int(part.normalize().as_tuple().exponent) for part in parts), default=0)
    digits = max((len(part.normalize().as_tuple().digits) for part in parts), default=1)
    return np.array([max(10.0**-decimals, 10.0 ** (part.adjusted() - digits + 1) if part else 0.0) for part in parts])
