"""Numbers as a report shows them: so many figures, thin blanks between thousands, powers of ten, a dash for none.

Nothing here is HTML: a numeral keeps its power of ten apart, and the templates set it.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from dondolo._fortran.library import shown_probability

# Typography, by name: they look like others
_DASH, _MINUS, _THIN_BLANK = "\N{EN DASH}", "\N{MINUS SIGN}", "\N{NARROW NO-BREAK SPACE}"
_BLANK = "\N{NO-BREAK SPACE}"


@dataclass(frozen=True)
class Numeral:
    """A number in characters.

    Attributes
    ----------
    text : str
        What is left of the power of ten.
    power : str
        Of ten; empty for none.
    unit : str
        What follows, with its blank.
    """

    text: str
    power: str = ""
    unit: str = ""


NONE = Numeral(_DASH)


def number(value: float | None, figures: int = 4, unit: str = "") -> Numeral:
    """A number with so many significant figures; a dash for none."""
    if value is None or np.isnan(value):
        return replace(NONE, unit=unit)
    if np.isinf(value):
        return Numeral("∞" if value > 0.0 else f"{_MINUS}∞", unit=unit)
    if value == round(value) and abs(value) < 1e15:
        if abs(value) >= 10**figures:
            return whole(value, unit)
        return Numeral(_signed(str(int(value))), unit=unit)
    mantissa, _, power = f"{value:.{figures}g}".partition("e")
    if power and 0 < int(power) < 6:
        return whole(float(f"{value:.{figures}g}"), unit)
    return Numeral(_signed(mantissa), _signed(str(int(power))) if power else "", unit)


def parameter(value: float | None) -> Numeral:
    """A number with four significant figures, also where they are zeros: for columns of a kind."""
    if value is None:
        return NONE
    text = f"{value:#.4g}".removesuffix(".")
    return number(value) if "e" in text or not np.isfinite(value) else Numeral(_signed(text))


def whole(value: float, unit: str = "") -> Numeral:
    """A count, with thin blanks between thousands."""
    return Numeral(f"{int(value):,}".replace(",", _THIN_BLANK), unit=unit)


def probability(value: float) -> Numeral:
    """A probability."""
    return NONE if np.isnan(value) else Numeral(shown_probability(value))


def chance(found: tuple[float, float, float] | None) -> tuple[Numeral | str, ...]:
    """A probability with its interval, if known; a tail of the fit is only known to be small. A dash for none."""
    if found is None:
        return (NONE,)
    value, low, high = found
    if np.isnan(low) or probability(high) == probability(value):
        return (probability(value),)
    ends = (Numeral(shown_probability(end).replace(" ", _BLANK)) for end in (low, high))
    return probability(value), " (", next(ends), _DASH, next(ends), ")"


def percent(share: float) -> Numeral:
    """A share in per cent; a dash for none."""
    if not np.isfinite(share):
        return number(share)
    return Numeral("<0.1 %") if 0.0 < share < 0.0005 else number(100.0 * share, 3, " %")


def _signed(text: str) -> str:
    """A number in characters with a true minus sign."""
    return text.replace("-", _MINUS)
