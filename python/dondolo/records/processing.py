"""Processing of records: every function returns a new record that says what was done to it.

Nothing here is applied by itself: an analysis takes records as they are.
"""

from __future__ import annotations

import re
from collections.abc import Callable
from functools import partial
from typing import Any, NamedTuple

import numpy as np

from dondolo._base.arguments import FloatArray, as_count, as_number
from dondolo._fortran import _binding, _core
from dondolo.errors import InputError
from dondolo.records.record import Record, place_of

# Two time steps, or their ratio to a whole number, are the same within this: steps in files have few digits.
_SAME = 1e-9
# Least number of periods of the lowest corner that a record must hold
_SHORTEST = 0.1
# Largest numerator and denominator of a ratio of time steps, and most samples of a record with a new step
_LARGEST_FACTOR = 1000
_MOST_SAMPLES = 100_000_000
# How the formats write a component that is vertical, also after a station: UP, U-D, UD1, ICC-UP, HNZ (SEED)
_VERTICAL = re.compile(r"(.*[-_ .])?[-+]?(U|D|UP|DN|DWN|DOWN|UD\d?|DU|Z|V|VRT|VER\w*|[A-Z][HLGMN]Z)", re.IGNORECASE)


class RotD(NamedTuple):
    """A measure of two horizontal components, over all directions in their plane (Boore 2010).

    Attributes
    ----------
    rotd50, rotd100 : float
        Median and largest value of the measure over the directions.
    angle : float
        Direction of the largest value, from the first component towards the second [degrees].
    angles : ndarray
        Directions, 0 included and 180 excluded, since the opposite direction is the same [degrees].
    values : ndarray
        The measure in each direction.
    """

    rotd50: float
    rotd100: float
    angle: float
    angles: FloatArray
    values: FloatArray


def correct_baseline(record: Record, kind: str = "constant", order: int | None = None) -> Record:
    """Take off a baseline.

    Parameters
    ----------
    record : Record
        The record.
    kind : {'constant', 'linear', 'velocity'}
        'constant': the mean of the samples; 'linear': their straight line of least squares; 'velocity': a polynomial is
        fitted to the velocity, from 0 at the start, and its derivative taken off the acceleration.
    order : int, optional
        Degree of the polynomial of 'velocity', 1 to 8; 2 if left out.

    Returns
    -------
    Record

    Raises
    ------
    InputError
        An unknown kind, an order where there is none.

    Notes
    -----
    The first step of ITACA and ESM is the constant (Paolucci et al. 2011). Of a digital record whose zero has shifted,
    a polynomial of the velocity takes off what integrates to a drift (Boore 2001; Chiu 1997 fits a straight line).
    """
    values, count = _of(record), len(record)
    if kind != "velocity" and order is not None:
        raise InputError(f"order = {order!r}: only with kind 'velocity'")
    if kind == "constant":
        return record.processed(values - values.mean(), "baseline: mean taken off")
    if kind == "linear":
        x = np.linspace(-1.0, 1.0, count)
        slope = (x @ values) / (x @ x)
        line = "baseline: straight line of least squares taken off"
        return record.processed(values - values.mean() - slope * x, line)
    if kind != "velocity":
        raise InputError(f"kind = {kind!r}: must be one of 'constant', 'linear', 'velocity'")
    degree = as_count("order", 2 if order is None else order, 1, 8)
    if count <= degree:
        raise InputError(f"order = {degree}: must be less than the number of samples, {count}")
    powers = np.arange(1, degree + 1)
    x = np.linspace(0.0, 1.0, count)[:, None]
    factors = np.linalg.lstsq(x**powers, velocity(record), rcond=None)[0]
    drift = (x ** (powers - 1)) @ (powers * factors) / record.duration
    line = f"baseline: derivative of a polynomial of degree {degree} through the velocity taken off"
    return record.processed(values - drift, line)


def band_pass(
    record: Record,
    low: float | None,
    high: float | None,
    order: int = 4,
    taper: float = 0.05,
    keep_padding: bool = False,
) -> Record:
    """Filter with Butterworth's band-pass, passed forwards and back: no phase is moved.

    Parameters
    ----------
    record : Record
        The record.
    low, high : float or None
        Corner frequencies [Hz], low < high < Nyquist's frequency 1/(2 dt); None for low: a low-pass, for high: a
        high-pass.
    order : int
        Order of one pass, 1 to 10. Both passes together have the gain 1/(1 + (low/f)^(2 order)) below the band (that of
        one pass squared): one half, not its root, at a corner.
    taper : float
        Part of the record at either end, 0 to 0.5, that half a cosine brings to zero before the filter.
    keep_padding : bool
        Keep the zeros that the filter needs at both ends, with what it leaves in them?

    Returns
    -------
    Record

    Raises
    ------
    InputError
        Corners out of order, or beyond Nyquist's frequency; an order or a taper out of range; a keep_padding that is
        neither True nor False.

    Notes
    -----
    1.5 order/low seconds of zeros go before and after the record, as long at each end as Converse and Brady (1992) ask
    for both together (Boore 2005, On pads and filters, BSSA 95(2):745-750); without a low corner `high` takes its
    place. Without its padded ends a record's velocity and displacement are not quite those of the filtered motion and
    may drift, which `keep_padding` avoids (Boore 2005). ITACA tapers 2 to 5 % and filters with order 2 (Paolucci et al.
    2011).
    """
    from scipy import signal

    values, nyquist = _of(record), 0.5 / record.dt
    corners = [as_number(what, value) for what, value in (("low", low), ("high", high)) if value is not None]
    if not corners:
        raise InputError("low, high: one of them must be given")
    for what, value in (("low", low), ("high", high)):
        if value is not None and not 0.0 < value < nyquist:
            raise InputError(
                f"{what} = {value:g} Hz: must be positive and below {nyquist:g} Hz, Nyquist's frequency of this record"
            )
    if corners[0] >= corners[-1] and len(corners) == 2:
        raise InputError(f"low = {corners[0]:g}, high = {corners[1]:g} Hz: must increase")
    if corners[0] * record.duration < _SHORTEST:
        raise InputError(
            f"{'low' if low is not None else 'high'} = {corners[0]:g} Hz: its period must not exceed ten times the "
            f"duration of the record, {record.duration:g} s"
        )
    if not isinstance(keep_padding, (bool, np.bool_)):
        raise InputError(f"keep_padding = {keep_padding!r}: must be True or False")
    degree = as_count("order", order, 1, 10)
    part = as_number("taper", taper)
    if not 0.0 <= part <= 0.5:
        raise InputError(f"taper = {taper:g}: must lie between 0 and 0.5")
    kind = "low" if low is None else "high" if high is None else "band"
    sections = signal.butter(degree, np.squeeze(corners), kind, fs=1.0 / record.dt, output="sos")
    pad = int(np.ceil(1.5 * degree / corners[0] / record.dt))
    if part > 0.0:
        values = values * signal.windows.tukey(len(values), 2.0 * part)
    padded = np.concatenate([np.zeros(pad), values, np.zeros(pad)])
    filtered = signal.sosfiltfilt(sections, padded, padtype=None)
    if not keep_padding:
        filtered = filtered[pad:-pad]
    text = "-".join(f"{value:g}" for value in corners)
    step = (
        f"{kind}-pass {text} Hz, Butterworth order {degree}, zero phase (two passes), taper {100.0 * part:g} %, "
        f"{pad * record.dt:.6g} s of zeros at each end, {'kept' if keep_padding else 'cut off again'}"
    )
    return record.processed(filtered, step)


def resample(record: Record, dt: float) -> Record:
    """Give a record another time step.

    Parameters
    ----------
    record : Record
        The record.
    dt : float
        New time step [s].

    Returns
    -------
    Record
        It says which of the two ways was taken.

    Raises
    ------
    InputError
        The steps have no ratio of whole numbers up to 1000, the new one is too long for the record, or there would be
        more than 100 million samples.

    Notes
    -----
    Where the new step divides the old one, new samples lie on the straight lines between the old: the same function of
    time, exactly. Otherwise SciPy's polyphase filter (`scipy.signal.resample_poly`, Kaiser's window with 5.0) makes a
    band-limited signal: frequencies above half the lower of the two sampling rates are taken out, which keeps them from
    coming back as lower ones, and the straight lines between samples are others than before.
    """
    values, step = _of(record), as_number("dt", dt)
    if not 0.0 < step < np.inf:
        raise InputError(f"dt = {dt:g} s: must be positive")
    if record.duration < step:
        raise InputError(f"dt = {step:g} s: must not exceed the duration of the record, {record.duration:g} s")
    ratio = record.dt / step
    if ratio > _LARGEST_FACTOR * (1.0 + _SAME) or (len(values) - 1) * ratio >= _MOST_SAMPLES:
        raise InputError(
            f"dt = {step:g} s: must not be less than a thousandth of the record's {record.dt:g} s, nor make more than "
            f"{_MOST_SAMPLES} samples"
        )
    parts = round(ratio)
    if parts >= 1 and abs(ratio - parts) <= _SAME * ratio:
        inner = np.arange(parts) / parts
        lines = values[:-1, None] + np.diff(values)[:, None] * inner
        text = f"resampled from {record.dt:g} to {step:g} s, linear between the samples (exact)"
        return record.processed(np.append(lines.ravel(), values[-1]), text, record.dt / parts)
    from fractions import Fraction

    from scipy import signal

    part = Fraction(ratio).limit_denominator(_LARGEST_FACTOR)
    up, down = part.numerator, part.denominator
    if not 0 < up <= _LARGEST_FACTOR or abs(ratio - up / down) > _SAME * ratio:
        raise InputError(
            f"dt = {step:g} s: its ratio to the record's {record.dt:g} s must be one of whole numbers up to "
            f"{_LARGEST_FACTOR}"
        )
    filtered = signal.resample_poly(values, up, down, padtype="line")
    inside = (len(values) - 1) * up // down + 1
    text = f"resampled from {record.dt:g} to {step:g} s, polyphase filter {up}/{down} with anti-aliasing"
    return record.processed(filtered[:inside], text, record.dt * down / up)


def trim(record: Record, low: float = 0.05, high: float = 0.95, before: float = 1.0, after: float = 1.0) -> Record:
    """Cut a record to its significant duration.

    Parameters
    ----------
    record : Record
        The record.
    low, high : float
        Parts of Arias' integral of the squared acceleration at which the significant duration begins and ends.
    before, after : float
        Margins that are kept before and after it [s].

    Returns
    -------
    Record
        Whole samples; the first and the last are not brought to zero.

    Raises
    ------
    InputError
        Parts that do not increase from 0 to 1, a negative margin, a record without motion.

    Notes
    -----
    Significant duration: Trifunac and Brady (1975). Ground acceleration is zero before a record begins and after it
    ends, so that a cut is a jump to zero: look at the margins.
    """
    values = _of(record)
    low, high, before, after = (
        as_number(*pair) for pair in (("low", low), ("high", high), ("before", before), ("after", after))
    )
    if not 0.0 <= low < high <= 1.0:
        raise InputError(f"low = {low:g}, high = {high:g}: must increase, between 0 and 1")
    for what, margin in (("before", before), ("after", after)):
        if not 0.0 <= margin < np.inf:
            raise InputError(f"{what} = {margin:g} s: must not be negative")
    first, last = significant_times(record, low, high)
    start = max(0, int(np.floor((first - before) / record.dt)))
    stop = min(len(values) - 1, int(np.ceil((last + after) / record.dt)))
    text = (
        f"trimmed to {start * record.dt:.6g}-{stop * record.dt:.6g} s: {100.0 * low:g}-{100.0 * high:g} % of Arias' "
        f"integral, margins {before:g} and {after:g} s"
    )
    return record.processed(values[start : stop + 1], text)


def reverse(record: Record) -> Record:
    """A record of the other polarity.

    Parameters
    ----------
    record : Record
        The record.

    Returns
    -------
    Record
    """
    return record.processed(-_of(record), "reversed polarity")


def rotate(first: Record, second: Record, angle: float) -> Record:
    """The component of two horizontal components in a direction.

    Parameters
    ----------
    first, second : Record
        Two components at right angles, of the same step and number of samples.
    angle : float
        Direction, from the first component towards the second [degrees].

    Returns
    -------
    Record
        first cos(angle) + second sin(angle), with the metadata that both share.

    Raises
    ------
    InputError
        Records that do not belong together (steps, lengths, stations or dates differ), a vertical component, an angle
        that is none.
    """
    _pair(first, second)
    direction = as_number("angle", angle)
    if not np.isfinite(direction):
        raise InputError(f"angle = {direction}: must be a number")
    values = _component(first.acceleration, second.acceleration, direction)
    steps = first.processing
    if steps != second.processing:
        steps = tuple(f"{part.name}: {step}" for part in (first, second) for step in part.processing)
    text = f"component at {direction:g} degrees from '{first.name}' towards '{second.name}'"
    shared = dict(first.metadata.items() & second.metadata.items())
    metadata = {key: value for key, value in first.metadata.items() if key in shared}
    return Record(values, first.dt, f"{first.name} at {direction:g} degrees", (*steps, text), metadata=metadata)


def rotd(
    first: Record, second: Record, measure: str | Callable[[Record], float] | None = None, angles: int = 180
) -> RotD:
    """Median and largest value of a measure over all directions of two horizontal components.

    Parameters
    ----------
    first, second : Record
        Two components at right angles, of the same step and number of samples.
    measure : str or callable, optional
        Name of an intensity measure, in the unit of `Record.intensity` ('pga' is in g), or a number of a record that
        does not depend on its polarity; the peak ground acceleration in m/s2 if left out.
    angles : int
        Directions in half a circle: 180 for steps of one degree, as Boore (2010) takes.

    Returns
    -------
    RotD

    Raises
    ------
    InputError
        As for `rotate`; an unknown measure or one that is no number.

    Notes
    -----
    RotD50 and RotD100: Boore (2010), Orientation-independent, nongeometric-mean measures of seismic intensity from two
    horizontal components of motion, BSSA 100(4):1830-1835. The largest peak is missed by up to 1 - cos(90/angles
    degrees): 4e-5 of it for 180.
    """
    _pair(first, second)
    count = as_count("angles", angles, 1, 36000)
    directions = 180.0 * np.arange(count) / count
    if isinstance(measure, str):
        measure = partial(Record.intensity, im=_binding.describe_measure(measure, of_record=True).name)
    if measure is not None and not callable(measure):
        raise InputError(f"measure = {measure!r}: must be the name of a measure or a function of a record")
    values = np.empty(count)
    for i, direction in enumerate(directions):
        if measure is None:
            values[i] = np.abs(_component(first.acceleration, second.acceleration, direction)).max()
        else:
            values[i] = as_number("measure", measure(rotate(first, second, direction)))
    if np.isnan(values).any():
        raise InputError("measure: must be a number in every direction")
    largest = int(values.argmax())
    return RotD(float(np.median(values)), float(values[largest]), float(directions[largest]), directions, values)


def velocity(record: Record) -> FloatArray:
    """Ground velocity at the samples, 0 at the first [m/s]; exact for accelerations linear in between."""
    values, stat, message = _core.ground_velocity(*place_of(record), len(record))
    _binding.check(stat, message)
    return np.asarray(values)


def significant_times(record: Record, low: float, high: float) -> tuple[float, float]:
    """Times at which Arias' integral reaches two parts of its end value [s]; 0 and 1: where motion begins and ends."""
    (first, last), stat, message = _core.significant_times(*place_of(record), low, high)
    _binding.check(stat, message)
    if not last > 0.0:
        raise InputError(f"record '{record.name}': has no motion")
    return float(first), float(last)


def _component(first: FloatArray, second: FloatArray, angle: float) -> FloatArray:
    """Of two components, in a direction [degrees]; quarters of a circle are exact."""
    turn = np.radians(angle % 360.0)
    cosine, sine = (np.cos(turn), np.sin(turn)) if angle % 90.0 else np.round((np.cos(turn), np.sin(turn)))
    component: FloatArray = cosine * first + sine * second
    return component


def _of(record: Any) -> FloatArray:
    """Samples of what must be a record."""
    if not isinstance(record, Record):
        raise InputError(f"record: {type(record).__name__} is no record")
    return record.acceleration


def _pair(first: Any, second: Any) -> None:
    """Check that two records can be components of one motion."""
    _of(first), _of(second)
    if len(first) != len(second):
        raise InputError(
            f"components '{first.name}' and '{second.name}': {len(first)} and {len(second)} samples: must be as many"
        )
    if abs(first.dt - second.dt) > _SAME * first.dt:
        raise InputError(
            f"components '{first.name}' and '{second.name}': dt = {first.dt:g} and {second.dt:g} s: must be the same"
        )
    for key in ("station", "date"):
        one, other = (record.metadata.get(key, "") for record in (first, second))
        if one and other and one != other:
            raise InputError(
                f"components '{first.name}' and '{second.name}': {key} = '{one}' and '{other}': must be the same"
            )
    for record in (first, second):
        component = record.metadata.get("component", "").strip()
        if _VERTICAL.fullmatch(component):
            raise InputError(f"record '{record.name}': component = '{component}': is vertical, must be horizontal")
