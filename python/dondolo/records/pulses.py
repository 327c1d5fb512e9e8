"""Pulses: short ground motions in closed form, sampled so finely that the lines between samples are as good as they.

A pulse of one frequency is what overturning spectra are drawn for, and near-fault records often hold one.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from dondolo._base.arguments import argument_error, as_number
from dondolo._fortran.library import constants
from dondolo.records.record import Record

__all__ = ["mavroeidis_papageorgiou", "one_cosine", "one_sine", "ricker"]

# An error of 1e-12 takes 2.2 million samples for a period.
_SMALLEST_ERROR = 1e-12


def __dir__() -> list[str]:
    return __all__


def one_sine(amplitude: float, frequency: float, *, error: float = 1e-5) -> Record:
    """One period of a sine: a = amplitude sin(2 pi frequency t), a forward displacement.

    Parameters
    ----------
    amplitude : float
        Peak acceleration [g].
    frequency : float
        Frequency of the pulse [Hz].
    error : float
        Largest distance between the samples' chords and the pulse, as a part of the amplitude.

    Returns
    -------
    Record
        Its peaks are samples, so that its peak ground acceleration is the amplitude.

    Raises
    ------
    InputError
        A value that is not positive, an error below 1e-12 or above 0.1.

    Notes
    -----
    Type A of Makris and Roussos (2000); the pulse of Zhang and Makris (2001). A chord over h leaves its function by at
    most h^2/8 ``max |a''|``, which sets the time step.
    """
    return _harmonic(np.sin, "one_sine", amplitude, frequency, error)


def one_cosine(amplitude: float, frequency: float, *, error: float = 1e-5) -> Record:
    """One period of a cosine: a = amplitude cos(2 pi frequency t), a forward and back displacement.

    Parameters
    ----------
    amplitude, frequency, error
        As those of `one_sine`.

    Returns
    -------
    Record
        It begins and ends at its peak acceleration.

    Raises
    ------
    InputError
        As for `one_sine`.

    Notes
    -----
    Type B of Makris and Roussos (2000).

    Examples
    --------
    >>> import dondolo as dd
    >>> pulse = dd.pulses.one_cosine(amplitude=0.3, frequency=1.0)
    >>> round(pulse.intensity("pga"), 12)
    0.3
    """
    return _harmonic(np.cos, "one_cosine", amplitude, frequency, error)


def ricker(amplitude: float, frequency: float, *, error: float = 1e-5) -> Record:
    """Ricker's symmetric wavelet: a = amplitude (1 - 2 x^2) exp(-x^2), x = pi frequency (t - t0).

    Parameters
    ----------
    amplitude, frequency, error
        As those of `one_sine`; the frequency is that of the largest Fourier amplitude.

    Returns
    -------
    Record
        It begins and ends where the wavelet is smaller than error times the amplitude.

    Raises
    ------
    InputError
        As for `one_sine`.

    Notes
    -----
    Ricker (1943); as a pulse for rocking blocks: Vassiliou and Makris (2011).
    ``max |a''|`` = 6 (pi frequency)^2 amplitude.
    """
    from scipy.special import lambertw

    amplitude, frequency, error = _numbers(amplitude=amplitude, frequency=frequency, error=error)
    # Where (2 x^2 - 1) exp(-x^2) = error, at least 2: x^2 - 1/2 = y with y exp(-y) = exp(1/2) error / 2
    end = np.sqrt(max(4.0, 0.5 - lambertw(-0.5 * np.exp(0.5) * error, -1).real))
    count = int(np.ceil(end / np.sqrt(8.0 * error / 6.0)))
    x = end * np.arange(-count, count + 1) / count
    values = _in_si(amplitude) * (1.0 - 2.0 * x**2) * np.exp(-(x**2))
    return Record(values, end / count / (np.pi * frequency), _name("ricker", frequency))


def mavroeidis_papageorgiou(
    velocity: float, frequency: float, *, phase: float = 0.0, gamma: float = 2.0, error: float = 1e-5
) -> Record:
    """The velocity pulse of Mavroeidis and Papageorgiou (2003).

    Parameters
    ----------
    velocity : float
        Amplitude A of the envelope of the velocity [m/s].
    frequency : float
        Prevailing frequency f_p [Hz].
    phase : float
        Phase nu [degrees]: 0 and 180 make the velocity symmetric, 90 and 270 antisymmetric.
    gamma : float
        Oscillatory character, greater than 1: the length of the pulse in periods.
    error : float
        Largest distance between the samples' chords and the acceleration, as a part of 2 pi frequency velocity.

    Returns
    -------
    Record
        The acceleration [m/s2], of duration gamma/frequency; its final velocity is 0.

    Raises
    ------
    InputError
        A value that is not positive, a gamma of 1 or less or above 100, an error below 1e-12 or above 0.1.

    Notes
    -----
    v = A/2 (1 + cos(2 pi f_p/gamma s)) cos(2 pi f_p s + nu), s from -gamma/(2 f_p) to gamma/(2 f_p): Mavroeidis and
    Papageorgiou (2003), A mathematical representation of near-fault ground motions, BSSA 93(3):1099-1131. As a sum of
    three cosines its third derivative is at most A (2 pi f_p)^3 (1 + 3/(2 gamma^2)).
    """
    velocity, frequency, error = _numbers(velocity=velocity, frequency=frequency, error=error)
    nu, gamma = np.radians(as_number("phase", phase)), as_number("gamma", gamma)
    if not np.isfinite(nu):
        raise argument_error("not_a_number", "phase", f" = {phase}: must be a number")
    if not 1.0 < gamma <= 100.0:
        raise argument_error("out_of_range", "gamma", f" = {gamma:g}: must be greater than 1 and at most 100")
    count = int(np.ceil(np.pi * gamma / np.sqrt(8.0 * error / (1.0 + 1.5 / gamma**2))))
    angle = np.pi * gamma * np.arange(-count, count + 1) / count
    slow = angle / gamma
    values = (
        -np.pi
        * frequency
        * velocity
        * (np.sin(slow) * np.cos(angle + nu) / gamma + (1.0 + np.cos(slow)) * np.sin(angle + nu))
    )
    return Record(values, 0.5 * gamma / frequency / count, _name("mavroeidis_papageorgiou", frequency))


def _harmonic(shape: Any, name: str, amplitude: float, frequency: float, error: float) -> Record:
    """One period of a sine or cosine, in a multiple of four steps."""
    amplitude, frequency, error = _numbers(amplitude=amplitude, frequency=frequency, error=error)
    count = 4 * int(np.ceil(0.5 * np.pi / np.sqrt(8.0 * error)))
    values = _in_si(amplitude) * shape(2.0 * np.pi * np.arange(count + 1) / count)
    return Record(values, 1.0 / (frequency * count), _name(name, frequency))


def _in_si(amplitude: float) -> float:
    """A peak acceleration in g as records have it [m/s2]."""
    return amplitude * constants().gravity


def _name(kind: str, frequency: float) -> str:
    return f"{kind} {frequency:g} Hz"


def _numbers(**values: Any) -> tuple[float, ...]:
    """Positive numbers; the error within its limits."""
    numbers = {what: as_number(what, value) for what, value in values.items()}
    for what, value in numbers.items():
        if not 0.0 < value < np.inf:
            raise argument_error("out_of_range", what, f" = {value:g}: must be positive")
    if not _SMALLEST_ERROR <= numbers["error"] <= 0.1:
        raise argument_error(
            "out_of_range", "error", f" = {numbers['error']:g}: must lie between {_SMALLEST_ERROR:g} and 0.1"
        )
    return tuple(numbers.values())
