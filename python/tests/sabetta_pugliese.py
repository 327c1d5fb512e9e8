"""The model of Sabetta and Pugliese (1996) written down again, without Fortran: what many realisations must show.

Also the squared gain of the generator's high-pass at 0.1 Hz, which is this project's own.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from scipy.stats import norm


class Model:
    """Expected power and frequency for one earthquake and site, the median motion."""

    def __init__(self, magnitude: float, distance: float, site: str) -> None:
        shallow, deep = float(site == "shallow"), float(site == "deep")
        self.duration = 10.0 ** (
            -0.783 + 0.193 * magnitude + 0.208 * np.log10(np.hypot(distance, 5.1)) - 0.133 * shallow + 0.138 * deep
        )
        # Integral of the squared acceleration, cm2/s3 to m2/s3
        self.energy = 1e-4 * 10.0 ** (
            0.729 + 0.911 * magnitude - 1.818 * np.log10(np.hypot(distance, 5.3)) + 0.244 * shallow + 0.139 * deep
        )
        first = distance / 7.0
        self.peak, end = first + 0.5 * self.duration, first + 2.5 * self.duration
        self.length = 1.3 * end
        self.s = np.log(end / self.peak) / 3.0
        self.m = np.log(self.peak) + self.s**2
        self.d = np.sqrt(np.log(1.0 + (0.44 + 0.07 * magnitude - 0.08 * shallow + 0.03 * deep) ** 2))
        self._ln_frequency = 3.4 - 0.218 * magnitude - 0.15 * deep
        self._origin, self._last = self.peak - 3.5 - distance / 50.0, self.peak + 0.5 * self.duration

    def power(self, time: Any) -> Any:
        """Expected squared acceleration [m2/s4]."""
        time = np.maximum(time, 1e-9)
        return self.energy * norm.pdf(np.log(time), self.m, self.s) / time

    def husid(self, time: Any) -> Any:
        """Expected part of the energy that has arrived."""
        return norm.cdf(np.log(np.maximum(time, 1e-9)), self.m, self.s)

    def time_of(self, part: float) -> float:
        """When that part of the energy has arrived [s]."""
        return float(np.exp(norm.ppf(part, self.m, self.s)))

    def frequency(self, time: Any) -> Any:
        """Central frequency: the mean of the spectrum [Hz]."""
        return np.exp(self._ln_frequency - 0.35 * np.log(np.maximum(np.minimum(time, self._last) - self._origin, 1.0)))

    def spectrum(self, time: float, frequency: Any) -> Any:
        """Part of the power for each Hz, after the high-pass [1/Hz]."""
        middle = np.log(self.frequency(time)) - 0.5 * self.d**2
        return norm.pdf(np.log(frequency), middle, self.d) / frequency / (1.0 + (0.1 / frequency) ** 8) ** 2


def mean_frequency(records: Any, time: float, width: float) -> float:
    """Mean frequency of the average spectrum of records in a Hann window around a time [Hz]."""
    step = records[0].dt
    half = round(0.5 * width / step)
    first = round(time / step) - half
    window = np.hanning(2 * half + 1)
    total = sum(
        np.abs(np.fft.rfft(window * record.acceleration[first : first + 2 * half + 1])) ** 2 for record in records
    )
    frequency = np.fft.rfftfreq(2 * half + 1, step)
    return float(frequency @ total / total.sum())
