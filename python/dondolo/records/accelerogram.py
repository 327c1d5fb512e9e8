"""Samples of a ground motion, and what is measured on them."""

from __future__ import annotations

import zlib
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from types import MappingProxyType

import numpy as np
from numpy.typing import ArrayLike

from dondolo._base.arguments import FloatArray, as_array, as_number, refuse_other_accelerations, wrong_type
from dondolo._base.shown import html_of
from dondolo._base.wording import decimal, say
from dondolo._fortran import _core
from dondolo._fortran.library import as_text, check, check_characters
from dondolo._fortran.records import RecordData
from dondolo.errors import InputError
from dondolo.records import suite
from dondolo.records.spectrum import Spectrum

# What sentences that are said elsewhere are marked by for the catalogues
_ = str
# What a header can say of a record
_DESCRIBED = (_("event"), _("date"), _("station"), _("component"))


@dataclass(frozen=True, eq=False, repr=False, init=False)
class Accelerogram:
    """Samples of a ground motion, checked and read-only, with their measures; `Record` describes the fields."""

    acceleration: FloatArray
    dt: float
    name: str = "record"
    processing: tuple[str, ...] = ()
    metadata: Mapping[str, str] = field(default_factory=dict)
    vertical: FloatArray | None = None
    peak_acceleration: float = field(init=False)

    def __init__(
        self,
        acceleration: ArrayLike,
        dt: float,
        name: str = "record",
        *,
        processing: Iterable[str] = (),
        metadata: Mapping[str, str] = MappingProxyType({}),
        vertical: ArrayLike | None = None,
    ) -> None:
        refuse_other_accelerations("acceleration", acceleration)
        refuse_other_accelerations("vertical", vertical)
        values = as_array("acceleration", acceleration).copy()
        step = as_number("dt", dt)
        as_text("name", name)
        steps = (processing,) if isinstance(processing, str) else tuple(processing)
        for text in steps:
            as_text("processing", text)
        upwards = None if vertical is None else as_array("vertical", vertical).copy()
        if upwards is not None and len(upwards) != len(values):
            raise InputError(f"vertical: has {len(upwards)} samples, must have {len(values)} as the record")
        peak, failure = _core.records.check_record(values, step, values if upwards is None else upwards)
        check(failure)
        if not isinstance(metadata, Mapping):
            raise wrong_type("metadata", metadata, "a mapping")
        known = {str(key): str(value) for key, value in metadata.items()}
        for key, value in known.items():
            check_characters("metadata", key)
            check_characters(f"metadata[{key!r}]", value)
        self._hold(RecordData(name, step, values, peak, known, upwards), steps)

    def _hold(self, data: RecordData, processing: tuple[str, ...] = ()) -> None:
        """Make it the record of what has been checked, whose arrays and metadata are its own from now on."""
        for array in (data.acceleration, data.vertical):
            if array is not None:
                array.flags.writeable = False
        for what, value in (
            ("acceleration", data.acceleration),
            ("dt", data.dt),
            ("name", data.name),
            ("processing", processing),
            ("metadata", MappingProxyType(data.metadata)),
            ("vertical", data.vertical),
            ("peak_acceleration", data.peak),
        ):
            object.__setattr__(self, what, value)

    @cached_property
    def checksum(self) -> str:
        """CRC-32 of the samples and the time step: records with the same are one and the same motion."""
        found = zlib.crc32(np.float64(self.dt).tobytes(), zlib.crc32(self.acceleration.tobytes()))
        return f"{found if self.vertical is None else zlib.crc32(self.vertical.tobytes(), found):08x}"

    @property
    def largest_fall(self) -> float:
        """Largest downward acceleration of the ground [m/s2], 0 without a vertical component.

        Where a factor makes it reach g the ground falls away from a wall.
        """
        return 0.0 if self.vertical is None else max(0.0, -float(self.vertical.min()))

    @cached_property
    def _labels(self) -> suite.Labels:
        return suite.labels_of(self.metadata)

    @property
    def event(self) -> str:
        """Earthquake of the record, else station and date of the recording, else '': see `Fragility.clusters`."""
        return self._labels.cluster

    @property
    def duration(self) -> float:
        """Time of the last sample [s]."""
        return (len(self.acceleration) - 1) * self.dt

    @property
    def time(self) -> FloatArray:
        """Times of the samples [s]."""
        time: FloatArray = self.dt * np.arange(len(self.acceleration), dtype=np.float64)
        return time

    def intensity(self, im: str, *, gravity: float | None = None) -> float:
        """An intensity measure of the unscaled record.

        Parameters
        ----------
        im : str
            'pga', 'sa(T)' or 'saavg(T1:T2)' [g], 'pgv', 'arias' or 'cav' [m/s], 'pgd' or 'hi' [m], 'd5-75' or
            'd5-95' [s]; T, T1 and T2 are periods [s], as in 'sa(0.5)'. 'arias-trapz' and 'cav-trapz' [m/s] are by the
            trapezoidal rule, as other programs have them.
        gravity : float, optional
            Acceleration of gravity [m/s2]; 9.81 if left out.

        Returns
        -------
        float
            In the unit of its levels: accelerations in g, all else in SI units.
        """
        return float(suite.intensities((self,), im, gravity)[0])

    def spectrum(self, periods: ArrayLike, *, damping: float = 0.05) -> Spectrum:
        """Elastic response spectrum.

        The motion of every oscillator is exact for the piecewise linear accelerogram, with peaks between samples, and
        with the free oscillations after the record.

        Parameters
        ----------
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
            Periods or a damping beyond what is allowed.
        """
        several, ratio = as_array("periods", periods).copy(), as_number("damping", damping)
        return Spectrum(periods=several, damping=ratio, displacement=suite.spectral_displacements(self, several, ratio))

    @property
    def velocity(self) -> FloatArray:
        """Ground velocity at the samples, 0 at the first [m/s]; exact for accelerations linear in between."""
        return suite.velocity(self)

    def significant_times(self, *, low: float = 0.05, high: float = 0.95) -> tuple[float, float]:
        """Times at which Arias' integral of the squared acceleration reaches two parts of its end value [s].

        Parameters
        ----------
        low, high : float
            The parts; 0 and 1: where motion begins and ends.

        Raises
        ------
        InputError
            Parts that do not increase from 0 to 1, a record without motion.

        Examples
        --------
        >>> import dondolo as dd
        >>> record = dd.synthetic_records(6.5, 10.0, "shallow", n_records=1)[0]
        >>> start, end = record.significant_times()
        >>> 0.0 < start < end < record.duration
        True
        """
        return suite.significant_times(self, low, high)

    def __len__(self) -> int:
        return len(self.acceleration)

    def _facts(self) -> list[tuple[str, str]]:
        return [
            (say("samples"), str(len(self))),
            ("dt", decimal(f"{self.dt:.6g} s")),
            (say("duration"), decimal(f"{self.duration:.6g} s")),
            ("PGA", decimal(f"{self.peak_acceleration:.6g} m/s2")),
            *(
                ()
                if self.vertical is None
                else ((say("vertical PGA"), decimal(f"{np.abs(self.vertical).max():.6g} m/s2")),)
            ),
            *((say(one), self.metadata[one]) for one in _DESCRIBED if one in self.metadata),
            *((say("processing"), step) for step in self.processing),
        ]

    def __repr__(self) -> str:
        return f"<Record {self.name!r}: " + ", ".join(f"{what} {text}" for what, text in self._facts()) + ">"

    def _repr_html_(self) -> str:
        return html_of(f"Record '{self.name}'", self._facts())

    def __getstate__(self) -> dict[str, object]:
        # A mapping proxy cannot be pickled, and what was uploaded stays in its process.
        state = {**self.__dict__, "metadata": dict(self.metadata)}
        state.pop("_home", None)
        return state

    def __setstate__(self, state: dict[str, object]) -> None:
        self.__dict__.update(state)
        self.__dict__["metadata"] = MappingProxyType(self.metadata)
        self.acceleration.flags.writeable = False
        if self.__dict__.setdefault("vertical", None) is not None:
            self.vertical.flags.writeable = False  # type: ignore[union-attr]
