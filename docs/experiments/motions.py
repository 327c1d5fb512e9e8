"""Motions of shake tables as dondolo runs them: read, filtered and resampled in one fixed way."""

from pathlib import Path

import numpy as np
from scipy.signal import butter, sosfiltfilt

GRAVITY = 9.81
#: Sampling of the table [Hz], and every which sample is kept
RATE, KEPT = 800.0, 4
#: Corners of the filters [Hz] and their orders
LOW_PASS, LOW_ORDER = 30.0, 4
HIGH_PASS, HIGH_ORDER = 0.1, 2


def table_motion(measured, *, high_pass: float = HIGH_PASS, kept: int = KEPT, gravity: float = GRAVITY):
    """Acceleration of a table from its accelerometer.

    The median is subtracted; a Butterworth filter of order 4 at 30 Hz runs forward and back at 800 Hz; every fourth
    sample is kept; one of order 2 at 0.1 Hz runs forward and back.

    Parameters
    ----------
    measured : array_like
        Acceleration as measured at 800 Hz [g].
    high_pass : float
        Corner of the second filter [Hz].
    kept : int
        Every which sample is kept.
    gravity : float
        What g is [m/s2].

    Returns
    -------
    acceleration : ndarray
        At 200 Hz if every fourth sample is kept [m/s2].
    dt : float
        Step [s].
    """
    motion = np.asarray(measured, dtype=float)
    motion = motion - np.median(motion)
    motion = sosfiltfilt(butter(LOW_ORDER, LOW_PASS, "lowpass", fs=RATE, output="sos"), motion)[::kept]
    rate = RATE / kept
    motion = sosfiltfilt(butter(HIGH_ORDER, high_pass, "highpass", fs=rate, output="sos"), motion)
    return gravity * motion, 1.0 / rate


def second_column(path: Path):
    """The second column of a file of numbers that are separated by blanks, below one line of titles.

    Parameters
    ----------
    path : Path
        The file.

    Returns
    -------
    ndarray
    """
    titles, _, text = path.read_bytes().partition(b"\n")
    columns = len(titles.strip(b"\r\n\t ").split(b"\t"))
    numbers = np.array(text.split(), dtype=float)
    return numbers.reshape(-1, columns)[:, 1]
