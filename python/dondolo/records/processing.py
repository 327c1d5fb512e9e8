"""What is done to the samples of a record: each function gives the new ones and the sentence that says what was done.

The methods of `Record` that call them say what their arguments mean.
"""

from __future__ import annotations

from typing import Literal, get_args

import numpy as np

from dondolo._base.arguments import FloatArray, argument_error, as_count, as_flag, as_number, one_of
from dondolo.errors import InputError
from dondolo.records.suite import Motion, significant_times, velocity

#: Kinds of baselines
Baseline = Literal["constant", "linear", "velocity"]

# Two time steps, or their ratio to a whole number, are the same within this: steps in files have few digits.
SAME_STEP = 1e-9
# Least number of periods of the lowest corner that a record must hold
_SHORTEST = 0.1
# Largest numerator and denominator of a ratio of time steps, and most samples of a record with a new step
_LARGEST_FACTOR = 1000
_MOST_SAMPLES = 100_000_000


def correct_baseline(record: Motion, kind: Baseline, order: int | None) -> tuple[FloatArray, str]:
    """Correct the baseline."""
    values, count = record.acceleration, len(record)
    one_of("kind", kind, get_args(Baseline))
    if kind != "velocity" and order is not None:
        raise argument_error("not_together", "order", f" = {order!r}: only with kind 'velocity'")
    if kind == "constant":
        return values - values.mean(), "baseline: mean taken off"
    if kind == "linear":
        x = np.linspace(-1.0, 1.0, count)
        slope = (x @ values) / (x @ x)
        line = "baseline: straight line of least squares taken off"
        return values - values.mean() - slope * x, line
    degree = as_count("order", 2 if order is None else order, 1, 8)
    if count <= degree:
        raise argument_error("out_of_range", "order", f" = {degree}: must be less than the number of samples, {count}")
    powers = np.arange(1, degree + 1)
    x = np.linspace(0.0, 1.0, count)[:, None]
    factors = np.linalg.lstsq(x**powers, velocity(record), rcond=None)[0]
    drift = (x ** (powers - 1)) @ (powers * factors) / record.duration
    line = f"baseline: derivative of a polynomial of degree {degree} through the velocity taken off"
    return values - drift, line


def band_pass(
    record: Motion, low: float | None, high: float | None, order: int, taper: float, keep_padding: bool
) -> tuple[FloatArray, str]:
    """Filter with Butterworth's band-pass, passed forwards and back: no phase is moved."""
    from scipy import signal

    values, nyquist = record.acceleration, 0.5 / record.dt
    corners = [as_number(what, value) for what, value in (("low", low), ("high", high)) if value is not None]
    if not corners:
        raise InputError("low, high: one of them must be given")
    for what, value in (("low", low), ("high", high)):
        if value is not None and not 0.0 < value < nyquist:
            raise argument_error(
                "out_of_range",
                what,
                f" = {value:g} Hz: must be positive and below {nyquist:g} Hz, Nyquist's frequency of this record",
            )
    if corners[0] >= corners[-1] and len(corners) == 2:
        raise argument_error("not_increasing", "low", f" = {corners[0]:g}, high = {corners[1]:g} Hz: must increase")
    if corners[0] * record.duration < _SHORTEST:
        raise InputError(
            f"{'low' if low is not None else 'high'} = {corners[0]:g} Hz: its period must not exceed ten times the "
            f"duration of the record, {record.duration:g} s"
        )
    as_flag("keep_padding", keep_padding)
    degree = as_count("order", order, 1, 10)
    part = as_number("taper", taper)
    if not 0.0 <= part <= 0.5:
        raise argument_error("out_of_range", "taper", f" = {taper:g}: must lie between 0 and 0.5")
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
    return filtered, step


def resample(record: Motion, dt: float) -> tuple[FloatArray, str, float]:
    """Give a record another time step."""
    values, step = record.acceleration, as_number("dt", dt)
    if not 0.0 < step < np.inf:
        raise argument_error("out_of_range", "dt", f" = {dt:g} s: must be positive")
    if record.duration < step:
        raise argument_error(
            "out_of_range", "dt", f" = {step:g} s: must not exceed the duration of the record, {record.duration:g} s"
        )
    ratio = record.dt / step
    if ratio > _LARGEST_FACTOR * (1.0 + SAME_STEP) or (len(values) - 1) * ratio >= _MOST_SAMPLES:
        raise argument_error(
            "out_of_range",
            "dt",
            f" = {step:g} s: must not be less than a thousandth of the record's {record.dt:g} s, nor make more than "
            f"{_MOST_SAMPLES} samples",
        )
    parts = round(ratio)
    if parts >= 1 and abs(ratio - parts) <= SAME_STEP * ratio:
        inner = np.arange(parts) / parts
        lines = values[:-1, None] + np.diff(values)[:, None] * inner
        text = f"resampled from {record.dt:g} to {step:g} s, linear between the samples (exact)"
        return np.append(lines.ravel(), values[-1]), text, record.dt / parts
    from fractions import Fraction

    from scipy import signal

    part = Fraction(ratio).limit_denominator(_LARGEST_FACTOR)
    up, down = part.numerator, part.denominator
    if not 0 < up <= _LARGEST_FACTOR or abs(ratio - up / down) > SAME_STEP * ratio:
        raise argument_error(
            "out_of_range",
            "dt",
            f" = {step:g} s: its ratio to the record's {record.dt:g} s must be a ratio of integers up to "
            f"{_LARGEST_FACTOR}",
        )
    filtered = signal.resample_poly(values, up, down, padtype="line")
    inside = (len(values) - 1) * up // down + 1
    text = f"resampled from {record.dt:g} to {step:g} s, polyphase filter {up}/{down} with anti-aliasing"
    return filtered[:inside], text, record.dt * down / up


def trim(record: Motion, low: float, high: float, before: float, after: float) -> tuple[slice, str]:
    """Samples of the significant duration of a record."""
    low, high, before, after = (
        as_number(*pair) for pair in (("low", low), ("high", high), ("before", before), ("after", after))
    )
    for what, margin in (("before", before), ("after", after)):
        if not 0.0 <= margin < np.inf:
            raise argument_error("out_of_range", what, f" = {margin:g} s: must not be negative")
    first, last = significant_times(record, low, high)
    start = max(0, int(np.floor((first - before) / record.dt)))
    stop = min(len(record) - 1, int(np.ceil((last + after) / record.dt)))
    text = (
        f"trimmed to {start * record.dt:.6g}-{stop * record.dt:.6g} s: {100.0 * low:g}-{100.0 * high:g} % of Arias' "
        f"integral, margins {before:g} and {after:g} s"
    )
    return slice(start, stop + 1), text
