"""Intensity measures: tables of records, and response spectra."""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from dondolo._base.arguments import FloatArray, as_array, as_measures, as_number
from dondolo._fortran import _binding, _core
from dondolo._storage import tables
from dondolo.errors import InputError
from dondolo.records.record import Record, as_records, intensities, place_of

# What a table of records shows unless told otherwise
_COLUMNS = ("pga", "pgv", "pgd", "arias", "cav", "d5-75", "d5-95", "hi", "sa(0.5)", "sa(1)", "saavg(0.2:2)")


@dataclass(frozen=True, eq=False, repr=False)
class Spectrum:
    """Elastic response spectrum of a record.

    Attributes
    ----------
    periods : ndarray, shape (periods,)
        [s]
    damping : float
        Damping ratio.
    sd : ndarray, shape (periods,)
        Spectral displacement: the largest displacement relative to the ground [m].
    """

    periods: FloatArray
    damping: float
    sd: FloatArray

    @property
    def sv(self) -> FloatArray:
        """Pseudo-spectral velocity, 2 pi / T times the displacement [m/s]."""
        return 2.0 * np.pi / self.periods * self.sd

    @property
    def sa(self) -> FloatArray:
        """Pseudo-spectral acceleration, (2 pi / T)**2 times the displacement [m/s2]."""
        return (2.0 * np.pi / self.periods) ** 2 * self.sd

    def to_frame(self) -> Any:
        """The spectrum as a pandas DataFrame."""
        return tables.frame({"period [s]": self.periods, "sd [m]": self.sd, "sv [m/s]": self.sv, "sa [m/s2]": self.sa})

    def __repr__(self) -> str:
        low, high = self.periods.min(), self.periods.max()
        return f"<Spectrum: {len(self.periods)} periods, {low:g} to {high:g} s, damping {self.damping:g}>"


def response_spectrum(record: Record, periods: ArrayLike, damping: float = 0.05) -> Spectrum:
    """Elastic response spectrum of a record.

    The motion of every oscillator is exact for the piecewise linear accelerogram, with peaks between samples, and with
    the free oscillations after the record.

    Parameters
    ----------
    record : Record
        The accelerogram.
    periods : array_like, shape (periods,)
        Periods of the oscillators, 0.01 to 20 [s].
    damping : float
        Damping ratio, at least 0 and below 1.

    Returns
    -------
    Spectrum

    Raises
    ------
    InputError
        No record, or periods or a damping beyond what is allowed.
    """
    if not isinstance(record, Record):
        raise InputError(f"record: {type(record).__name__} is no record")
    several = as_array("periods", periods).copy()
    if not len(several):
        raise InputError("periods: must be given")
    ratio = as_number("damping", damping)
    displacement, stat, message = _core.spectrum(*place_of(record), several, ratio)
    _binding.check(stat, message)
    for array in (several, displacement):
        array.flags.writeable = False
    return Spectrum(several, ratio, displacement)


def intensity_table(
    records: Record | Iterable[Record], ims: str | Iterable[str] = _COLUMNS, gravity: float | None = None
) -> Any:
    """Intensity measures of records.

    Parameters
    ----------
    records : Record or iterable of Record
        The accelerograms.
    ims : str or iterable of str
        Intensity measures, as for `Record.intensity`.
    gravity : float, optional
        What g is [m/s2]; 9.81 if left out.

    Returns
    -------
    pandas.DataFrame
        A row for each record; the columns are the record's name and the measures with their units, as 'pga [g]'.
        pandas is no dependency of dondolo: the extra 'tables' installs it.

    Raises
    ------
    InputError
        No records, or no such measure.
    """
    several = as_records(records)
    table: dict[str, Any] = {"record": [record.name for record in several]}
    for im in as_measures(ims):
        measure = _binding.describe_measure(im, of_record=True)
        table[f"{measure.name} [{measure.unit}]"] = intensities(several, im, gravity)
    return tables.frame(table)
