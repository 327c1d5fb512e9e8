"""What users give, checked and turned into what is computed with; one clear line where it cannot be."""

from __future__ import annotations

import os
import re
from collections.abc import Iterable, Mapping
from typing import Any, TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

from dondolo.errors import Code, InputError, Problem

FloatArray = NDArray[np.float64]
_T = TypeVar("_T")
# What packages of units write for numbers without one
_NO_UNITS = ("", "1", "dimensionless", "(dimensionless)")
# How m/s2 is written, and units in the names of columns
_SI = re.compile(r"(m|met(er|re)s?)(/| / | per | ?\* ?| )\(?(s|sec|seconds?)(/s(ec)?| ?(\*\*|\^)? ?-?2|²|⁻²| squared)")
_UNIT = re.compile(r"m?g|g's|[cm]?gals?|%g|counts?|cts|volts?|mv|.*[a-z]2?(/| per | )\(?s.*|[cm]?m|in|ft")
# What Python or NumPy would turn into a number, and what is most likely a mistake
_NO_NUMBERS = (str, bytes, bool, np.bool_, np.timedelta64, np.datetime64)


def argument_error(code: Code, variable: str, sentence: str) -> InputError:
    """The error of an argument; its sentence begins with the name of the variable, and often its value."""
    return InputError(variable + sentence, errors=[Problem(variable + sentence, code, variable)])


def _unit_of(value: Any) -> str:
    """Unit of what a package of units has made (Astropy, Pint, unyt, netCDF4 ...), '' for plain numbers."""
    # The entries of a table of pandas are attributes too: there the unit is one of the type of its numbers
    holder = getattr(value, "dtype", None) if hasattr(value, "iloc") else value
    unit = getattr(holder, "unit", None)
    unit = getattr(holder, "units", None) if unit is None else unit
    return "" if unit is None or str(unit) in _NO_UNITS else str(unit)


def refuse_units(name: str, value: Any) -> None:
    """Refuse a number, numbers or a list of numbers with a unit: packages of units strip it from some, unasked."""
    several: Iterable[Any] = value if isinstance(value, (list, tuple)) else ()
    if getattr(getattr(value, "dtype", None), "kind", "") == "O":
        several = np.asarray(value, dtype=object).ravel()
    for one in (value, *{type(one): one for one in several}.values()):
        if unit := _unit_of(one):
            raise _unit_error(name, unit)


def refuse_other_accelerations(name: str, value: Any) -> None:
    """Refuse samples that pandas or xarray say to be in other units than m/s2, in their attributes or their name."""
    said = getattr(value, "attrs", None)
    units = [str(said[key]) for key in ("units", "unit") if key in said] if isinstance(said, Mapping) else []
    if isinstance(title := getattr(value, "name", None), str):
        within = re.findall(r"[(\[]([^()\[\]]+)[)\]]", title)
        units += [text for text in within if _UNIT.fullmatch(text.strip().lower())]
    for unit in units:
        if unit not in _NO_UNITS and not _SI.fullmatch(unit.strip().lower()):
            raise _unit_error(name, unit)


def _unit_error(name: str, unit: str) -> InputError:
    return argument_error(
        "not_a_number",
        name,
        f": has the unit {unit!r}: must be plain numbers in the unit that is documented, as"
        " quantity.to_value(unit) of Astropy and quantity.m_as(unit) of Pint give them",
    )


def as_number(name: str, value: Any) -> float:
    """Turn what a user gives for a number into one."""
    refuse_units(name, value)
    if isinstance(value, _NO_NUMBERS):
        raise argument_error("not_a_number", name, f" = {value!r}: must be a number")
    try:
        return float(value)
    except (TypeError, ValueError, OverflowError):
        raise argument_error("not_a_number", name, f" = {value!r}: must be a number") from None


def shortened(value: Any) -> str:
    """What a user gives in place of something else, for a message: what a long object contains does not help."""
    text = repr(value)
    return text if len(text) <= 80 and "\n" not in text else f"a {type(value).__name__}"


def as_count(name: str, value: Any, least: int, most: int | None = None) -> int:
    """Turn what a user gives for a whole number into one."""
    whole = isinstance(value, (int, np.integer)) and not isinstance(value, bool)
    if not whole or value < least or (most is not None and value > most):
        allowed = f"at least {least}" if most is None else f"between {least} and {most}"
        raise argument_error("not_an_integer", name, f" = {value!r}: must be an integer, {allowed}")
    return int(value)


def as_flag(name: str, value: Any) -> bool:
    """Turn what a user gives for yes or no into it; a text, of which even 'no' would be true, is refused."""
    if not isinstance(value, (bool, np.bool_)):
        raise argument_error("not_a_flag", name, f" = {value!r}: must be True or False")
    return bool(value)


def as_array(name: str, values: ArrayLike) -> FloatArray:
    """Turn what a user gives for a row of numbers into one."""
    refuse_units(name, values)
    try:
        given = np.asarray(values)
        if given.dtype.kind not in "biufO" or isinstance(values, np.ma.MaskedArray):
            raise TypeError
        array = np.ascontiguousarray(given, dtype=np.float64)
    except (TypeError, ValueError, OverflowError):
        raise argument_error("not_numbers", name, ": must be numbers") from None
    if array.ndim != 1:
        raise argument_error(
            "not_numbers", name, f": must be one row of numbers, not an array of {array.ndim} dimensions"
        )
    if not array.size:
        # f2py takes no empty arrays
        raise argument_error("not_given", name, ": must be given")
    return array


def increasing(name: str, values: ArrayLike, *, from_zero: bool = False, why: str = "") -> FloatArray:
    """Convert levels of a curve to positive numbers that increase, the first may be 0: a copy that is read-only."""
    levels = as_array(name, values).copy()
    allowed = "not negative" if from_zero else "positive"
    if len(levels) < 2:
        raise argument_error("wrong_length", name, f": must be at least two, {allowed} and increasing{why}")
    wrong = ~(((levels >= 0.0) if from_zero else (levels > 0.0)) & (levels < np.inf))
    if wrong.any():
        sentence = f" = {levels[wrong][0]:g}: must {'not be negative' if from_zero else 'be positive'}"
        raise argument_error("out_of_range", name, sentence)
    falls = levels[1:] <= levels[:-1]
    if falls.any():
        i = int(np.argmax(falls))
        raise argument_error(
            "not_increasing", name, f" = {levels[i]:.15g}, {levels[i + 1]:.15g}: must increase strictly"
        )
    levels.flags.writeable = False
    return levels


def instance_of(name: str, value: Any, kind: type[_T]) -> _T:
    """Check that what a user gives is of a class."""
    if not isinstance(value, kind):
        raise wrong_type(name, value, f"a {kind.__name__}")
    return value


def wrong_type(name: str, value: Any, allowed: str, hint: str = "") -> InputError:
    """The error of an argument of another type than is allowed; a hint says what to write instead."""
    return argument_error("wrong_type", name, f": must be {allowed}, not {type(value).__name__}{hint and f' ({hint})'}")


def one_of(name: str, value: Any, allowed: Iterable[str]) -> None:
    """Check a word that a user gives for an option."""
    words = list(dict.fromkeys(allowed))
    if not isinstance(value, str) or value not in words:
        raise argument_error("not_a_word", name, f" = {value!r}: must be one of {', '.join(map(repr, words))}")


def as_measures(ims: str | Iterable[str]) -> list[str]:
    """Turn what a user gives for the names of measures into a list of them; a text is one."""
    if isinstance(ims, str):
        return [ims]
    if not isinstance(ims, Iterable):
        raise argument_error("wrong_type", "ims", f" = {ims!r}: must be names of intensity measures")
    return list(ims)


def as_sentences(name: str, sentences: str | Iterable[str]) -> tuple[str, ...]:
    """Turn what a user gives for sentences into a tuple of them; a text is one."""
    several = (sentences,) if isinstance(sentences, str) else sentences
    if not isinstance(several, Iterable):
        raise argument_error("wrong_type", name, f" = {sentences!r}: must be sentences")
    found = tuple(several)
    for one in found:
        if not isinstance(one, str):
            raise argument_error("not_a_string", name, f" = {one!r}: must be a string")
    return found


def as_path(path: str | os.PathLike[str]) -> bytes:
    """Turn a path into the bytes Fortran takes, which divides folders by '/' on Windows too."""
    try:
        return os.fsencode(path).replace(os.fsencode(os.sep), b"/")
    except TypeError:
        raise argument_error("wrong_type", "path", f" = {shortened(path)}: must be the path of a file") from None


def as_generator(rng: Any) -> np.random.Generator:
    """Turn what a user gives for a seed into a generator of random numbers; None: a different one every time."""
    try:
        return np.random.default_rng(rng)
    except (TypeError, ValueError):
        sentence = f" = {rng!r}: must be an integer, at least 0, a Generator or None"
        raise argument_error("not_an_integer", "rng", sentence) from None


def as_levels(x: ArrayLike) -> FloatArray:
    """Turn what a user gives for levels of intensity into an array; its shape is kept."""
    refuse_units("x", x)
    try:
        given = np.asarray(x)
        # NumPy would turn texts and flags into numbers
        if given.dtype.kind not in "iufO" or (
            given.dtype == object and any(isinstance(one, _NO_NUMBERS) for one in given.flat)
        ):
            raise TypeError
        values = given.astype(np.float64)
    except (TypeError, ValueError, OverflowError):
        raise argument_error("not_numbers", "x", ": must be numbers") from None
    if np.isnan(values).any():
        raise argument_error("not_a_number", "x", " = nan: must be a number")
    if not np.all(values >= 0.0):
        raise argument_error("out_of_range", "x", ": must be levels of intensity, not negative")
    return values


def as_probabilities(name: str, p: ArrayLike) -> FloatArray:
    """Turn what a user gives for probabilities into an array; its shape is kept."""
    refuse_units(name, p)
    try:
        values = np.asarray(p, dtype=np.float64)
    except (TypeError, ValueError, OverflowError):
        raise argument_error("not_numbers", name, ": must be numbers") from None
    wrong = ~((values >= 0.0) & (values <= 1.0))
    if np.any(wrong):
        raise argument_error("not_a_probability", name, f" = {values[wrong][0]:g}: must lie between 0 and 1")
    return values


def shaped(values: FloatArray, like: FloatArray) -> Any:
    """Values in the shape of the argument: a float for a scalar."""
    return float(values[0]) if like.ndim == 0 else values.reshape(like.shape)


def tails(confidence: float) -> tuple[float, float]:
    """Probabilities at the ends of an interval of a confidence."""
    confidence = as_number("confidence", confidence)
    if not 0.0 < confidence < 1.0:
        raise argument_error("not_a_probability", "confidence", f" = {confidence}: must lie between 0 and 1")
    # A confidence next to 1 must not round to certainty, which has no quantile
    return 0.5 - 0.5 * confidence, min(0.5 + 0.5 * confidence, float(np.nextafter(1.0, 0.0)))
