"""Sets of records: a table of accelerograms, and which of them run at which levels of intensity."""

from __future__ import annotations

import os
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import partial
from itertools import pairwise
from typing import TYPE_CHECKING, Any, overload

import numpy as np
from numpy.typing import ArrayLike, NDArray

from dondolo._base.arguments import FloatArray, argument_error, as_flag, as_measures, as_number
from dondolo._base.shown import Shown
from dondolo._fortran.library import constants
from dondolo._fortran.records import describe_measure
from dondolo._storage import tables
from dondolo._storage.saved import Saved
from dondolo.errors import InputError
from dondolo.records.columns import checked_column, column_names, column_of, factors_of, intensities_of, joined_columns
from dondolo.records.expression import evaluate
from dondolo.records.record import Record, as_records

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from dondolo.records.selection import Selection
    from dondolo.records.target import TargetSpectrum

# Measures that a table shows unless told otherwise, beside metadata and alone
_MEASURES = ("pga", "pgv", "arias", "d5-95")
_TABLE = ("pga", "pgv", "pgd", "arias", "cav", "d5-75", "d5-95", "hi", "sa(0.5)", "sa(1)", "saavg(0.2:2)")


@dataclass(frozen=True, eq=False, repr=False, init=False)
class RecordSet(Shown, Saved):
    """A table of records: metadata, intensity measures, and the level and factor of each row where they are given.

    A set is used wherever records are: it has a length and can be iterated. A record may have several rows, one for
    each level at which it runs.

    Parameters
    ----------
    records : Record or iterable of Record
        The record of each row.
    level : float or array_like, shape (rows,), optional
        Level of intensity at which each row runs; NaN: every level. Those of `records` if left out.
    factor : float or array_like, shape (rows,), optional
        Factor on each record, positive; NaN: computed from the intensity measure. Those of `records` if left out.

    Attributes
    ----------
    records : tuple of Record
    level, factor : ndarray, shape (rows,), or None

    Raises
    ------
    InputError
        No records; levels or factors that are not one per record; values that are not positive.

    Notes
    -----
    The levels and factors of a set are used or refused, never ignored. Analyses at levels (`multiple_stripe`,
    `typology`, `compare_designs` ...) run each row at its level, with its factor; factors without levels are refused.
    Analyses without levels (`cloud`, `RecordSet.intensity_table`, `Building.plot`) take each record times its factor,
    and refuse a row whose factor would follow from its level. Functions that choose levels or factors themselves
    (`compare_intensities`, `RecordSet.select`, `adaptive_stripes`) refuse both. The attribute `records` has the
    unscaled records.

    Examples
    --------
    >>> import dondolo as dd
    >>> records = dd.RecordSet(dd.synthetic_records(6.5, 10.0, "shallow", n_records=3))
    >>> len(records.filter("magnitude > 6 and pga > 0.01"))
    3
    """

    records: tuple[Record, ...]
    level: FloatArray | None
    factor: FloatArray | None

    def __init__(
        self,
        records: Record | Iterable[Record],
        *,
        level: ArrayLike | None = None,
        factor: ArrayLike | None = None,
    ) -> None:
        several = as_records(records)
        if isinstance(records, RecordSet):
            level = records.level if level is None else level
            factor = records.factor if factor is None else factor
        if len({record.name for record in several}) < len(several):
            # A record with several rows is one object, also where it comes from a file.
            known: dict[tuple[str, float, bytes, bytes], Record] = {}
            keys = (
                (
                    record.name,
                    record.dt,
                    record.acceleration.tobytes(),
                    b"" if record.vertical is None else record.vertical.tobytes(),
                )
                for record in several
            )
            several = tuple(known.setdefault(key, record) for key, record in zip(keys, several, strict=True))
        object.__setattr__(self, "records", several)
        for what, given in (("level", level), ("factor", factor)):
            values = None if given is None else checked_column(what, given, len(several))
            object.__setattr__(self, what, values)

    @classmethod
    def of_levels(cls, sets: Mapping[float, Record | Iterable[Record]]) -> RecordSet:
        """Records of several levels as one set.

        Parameters
        ----------
        sets : mapping of float to records
            Level of intensity -> records that run at it; the factors of a `RecordSet` are kept.

        Returns
        -------
        RecordSet
            Its rows are in the order of the levels.

        Raises
        ------
        InputError
            A level that is not positive, has no records, or differs from another by rounding alone.

        Examples
        --------
        >>> import dondolo as dd
        >>> records = dd.synthetic_records(6.5, 10.0, "shallow", n_records=4)
        >>> several = dd.RecordSet.of_levels({0.4: records[:2], 0.8: records[1:]})
        >>> several.level.tolist()
        [0.4, 0.4, 0.8, 0.8, 0.8]
        """
        if not isinstance(sets, Mapping) or not sets:
            raise argument_error(
                "wrong_type", "records", ": must be a mapping of levels to records, at least one level"
            )
        parts = []
        levels = sorted(sets, key=lambda one: as_number("levels", one))
        for one, other in pairwise(levels):
            if other - one <= constants().same_level * other:
                raise argument_error(
                    "not_together", "levels", f" = {float(one)!r}, {float(other)!r}: are the same but for rounding"
                )
        for level in levels:
            several = sets[level]
            if isinstance(several, Sequence) and not several:
                raise argument_error("not_given", "levels", f" = {level:g}: no record runs at this level")
            part = several if isinstance(several, RecordSet) else RecordSet(several)
            parts.append(RecordSet(part.records, level=float(level), factor=part.factor))
        return sum(parts[1:], start=parts[0])

    def __len__(self) -> int:
        return len(self.records)

    def __iter__(self) -> Iterator[Record]:
        return iter(self.records)

    @overload
    def __getitem__(self, which: int) -> Record: ...

    @overload
    def __getitem__(self, which: str) -> NDArray[Any]: ...

    @overload
    def __getitem__(self, which: slice | Sequence[int] | NDArray[Any]) -> RecordSet: ...

    def __getitem__(self, which: Any) -> Any:
        """A record by its number, some rows by a slice, numbers or a mask, or a column by its name."""
        if isinstance(which, str):
            return column_of(self, which)
        if isinstance(which, (int, np.integer)):
            return self.records[which]
        try:
            rows = np.arange(len(self))[which]
        except (IndexError, TypeError, ValueError):
            raise InputError(f"records[{which!r}]: must be a number, a slice, numbers, a mask or a column") from None
        return self._rows(rows)

    def __add__(self, other: Iterable[Record]) -> RecordSet:
        """The rows of both."""
        if not isinstance(other, RecordSet):
            other = RecordSet(other)
        pairs = {"level": (self.level, other.level), "factor": (self.factor, other.factor)}
        joined = {
            what: None if a is None and b is None else joined_columns(a, b, len(self), len(other))
            for what, (a, b) in pairs.items()
        }
        return RecordSet((*self.records, *other.records), **joined)

    @property
    def columns(self) -> tuple[str, ...]:
        """Names of the columns: of the table itself, and the keys of the metadata."""
        return column_names(self)

    def filter(self, expression: str) -> RecordSet:
        """The rows for which an expression holds.

        Parameters
        ----------
        expression : str
            Columns (`columns`) and intensity measures as names, compared, combined by `and`, `or`, `not`, and with
            arithmetic, as in ``"magnitude >= 6 and 0.1 < pga < 0.5"``. Names that are none in Python stand between
            backticks: ``"`sa(0.5)` > 0.3"``. A row whose metadata lack a key does not meet a condition on it.

        Returns
        -------
        RecordSet

        Raises
        ------
        InputError
            The expression cannot be read, has an unknown name, or holds for no record.
        """
        mask = evaluate(expression, partial(column_of, self), len(self))
        if not mask.any():
            raise argument_error("out_of_range", "filter", f": no record meets {expression!r}")
        return self._rows(np.flatnonzero(mask))

    def sort(self, by: str, *, descending: bool = False) -> RecordSet:
        """The rows in the order of a column or an intensity measure; rows without a value come last.

        Parameters
        ----------
        by : str
            A column or an intensity measure.
        descending : bool
            Whether to put the largest first; rows without a value stay last.

        Returns
        -------
        RecordSet

        Examples
        --------
        >>> import dondolo as dd
        >>> records = dd.RecordSet(dd.synthetic_records(6.5, 10.0, "shallow", n_records=4))
        >>> strongest = records.sort("pga", descending=True)[0]
        >>> strongest.peak_acceleration == max(record.peak_acceleration for record in records)
        True
        """
        values = column_of(self, by)
        missing = np.isnan(values) if values.dtype.kind == "f" else values == ""
        # Rows of equal values keep their order.
        rank = np.unique(values, return_inverse=True)[1]
        return self._rows(np.lexsort((-rank if as_flag("descending", descending) else rank, missing)))

    def spectra(self, periods: ArrayLike, *, damping: float = 0.05) -> FloatArray:
        """Pseudo-spectral accelerations of the rows, times their factors.

        Parameters
        ----------
        periods : array_like, shape (periods,)
            0.01 to 20 [s].
        damping : float
            Damping ratio.

        Returns
        -------
        ndarray, shape (rows, periods)
            [g]

        Examples
        --------
        >>> import dondolo as dd
        >>> records = dd.RecordSet(dd.synthetic_records(6.5, 10.0, "shallow", n_records=4))
        >>> records.spectra([0.1, 0.5, 1.0]).shape
        (4, 3)
        """
        found: dict[int, FloatArray] = {}
        for record in self.records:
            if id(record) not in found:
                found[id(record)] = record.spectrum(periods, damping=damping).pseudo_acceleration / constants().gravity
        factor = np.ones(len(self)) if self.factor is None else np.nan_to_num(self.factor, nan=1.0)
        return factor[:, None] * np.stack([found[id(record)] for record in self.records])

    def to_frame(self, ims: str | Iterable[str] = _MEASURES) -> Any:
        """The table as a pandas DataFrame, with intensity measures of the unscaled records.

        Parameters
        ----------
        ims : str or iterable of str
            Intensity measures, as for `Record.intensity`; their columns are named with the unit, as 'pga [g]'.
        """
        table: tables.Table = {name: column_of(self, name) for name in self.columns}
        for im in as_measures(ims):
            measure = describe_measure(im, of_record=True)
            table[f"{measure.name} [{measure.unit}]"] = column_of(self, im)
        return tables.frame(table)

    def intensity_table(self, ims: str | Iterable[str] = _TABLE, *, gravity: float | None = None) -> Any:
        """Intensity measures of the rows, times their factors, without metadata.

        Parameters
        ----------
        ims : str or iterable of str
            Intensity measures, as for `Record.intensity`.
        gravity : float, optional
            Acceleration of gravity [m/s2]; 9.81 if left out.

        Returns
        -------
        pandas.DataFrame
            A row for each record; the columns are the record's name and the measures with their units, as 'pga [g]'.
            pandas is not a dependency of dondolo: the extra 'tables' installs it.

        Raises
        ------
        InputError
            No such measure; a row with a level and no factor.

        Examples
        --------
        >>> import dondolo as dd
        >>> records = dd.RecordSet(dd.synthetic_records(6.5, 10.0, "shallow", n_records=3))
        >>> list(records.intensity_table(["pga", "d5-95"]).columns)
        ['record', 'pga [g]', 'd5-95 [s]']
        """
        factors = factors_of(self)
        table: tables.Table = {"record": column_of(self, "record")}
        for im in as_measures(ims):
            measure = describe_measure(im, of_record=True)
            values = intensities_of(self, im, gravity)
            if factors is not None:
                values = values * factors**measure.power
            table[f"{measure.name} [{measure.unit}]"] = values
        return tables.frame(table)

    def select(
        self,
        target: TargetSpectrum,
        n_records: int,
        *,
        max_factor: float = 4.0,
        weight: float | None = None,
        rng: int | np.random.Generator | None = 0,
    ) -> Selection:
        """Select and scale records so that their spectra meet a target: its mean, or its mean and dispersion.

        Parameters
        ----------
        target : TargetSpectrum
            Of a code (`Site.spectrum`, `TargetSpectrum.ec8`), of a ground motion model with its dispersion, or
            conditional on an ordinate (`TargetSpectrum.conditional`).
        n_records : int
            Number of records to select, each at most once.
        max_factor : float
            Records are scaled by factors between 1/max_factor and max_factor; 1: not at all.
        weight : float, optional
            Weight of the dispersion against the mean, not negative; 1 if left out, and 0.1 for a target without
            dispersion.
        rng : int, Generator or None
            Of the spectra that are drawn from a target with a dispersion; None: different every time.

        Returns
        -------
        Selection

        Raises
        ------
        InputError
            Fewer records than are asked for can be scaled to the target; arguments out of range; a record without
            motion; records with levels or factors of their own.

        Notes
        -----
        Jayaram, Lin and Baker (2011); the docstring of the module dondolo.records.selection has the steps. They find a
        good selection, not the best of all.

        Examples
        --------
        >>> import dondolo as dd
        >>> target = dd.TargetSpectrum.ec8(0.25, soil="C", periods=[0.1, 0.2, 0.5, 1.0, 2.0])
        >>> records = dd.RecordSet(dd.synthetic_records(6.5, 10.0, "shallow", n_records=20))
        >>> found = records.select(target, 7)
        >>> len(found.records)
        7
        """
        from dondolo.records.selection import select_records

        return select_records(self, target, n_records, max_factor=max_factor, weight=weight, rng=rng)

    def to_catalogue(self, path: str | os.PathLike[str]) -> None:
        """Write a catalogue that the executable and `read_catalogue` read, and the accelerograms beside it.

        Parameters
        ----------
        path : path
            The catalogue, a CSV file; an earlier one that this method wrote is replaced. The accelerograms are written
            to a folder of its name without the suffix, with all digits and with the metadata.

        Raises
        ------
        InputError
            The path is that of another file; different records have the same name; another process writes it.
        DondoloError
            The files cannot be written.

        Notes
        -----
        Nothing of an earlier catalogue is replaced but its table, at once and last, so that it is the old or the new
        one whatever fails. The table contains the CRC-32 of each file; readers, the executable included, refuse a file
        with another one. Files that only the earlier catalogue named are removed, unless they were changed since.

        Examples
        --------
        >>> import dondolo as dd
        >>> records = dd.RecordSet(dd.synthetic_records(6.5, 10.0, "shallow", n_records=2))
        >>> records.to_catalogue("records.csv")
        >>> [record.checksum for record in dd.read_catalogue("records.csv")] == [record.checksum for record in records]
        True
        """
        from dondolo.records.catalogues import write_catalogue

        write_catalogue(self, path)

    def plot(
        self,
        ax: Axes | None = None,
        *,
        target: TargetSpectrum | None = None,
        periods: ArrayLike | None = None,
        **options: Any,
    ) -> Axes:
        """Draw the response spectra of the rows, times their factors, their mean and dispersion, and a target.

        Parameters
        ----------
        ax : Axes, optional
            Where to draw; a new figure if left out.
        target : TargetSpectrum, optional
            Drawn too.
        periods : array_like, optional
            [s]; those of the target, or 100 from 0.05 to 4 s, if left out.
        **options
            Parts to leave out by False (`legend`, `title`, `band`), and keywords of Matplotlib for the median: see
            docs/printing.md.

        Returns
        -------
        Axes
            Spectral acceleration against period, both logarithmic.
        """
        from dondolo.records.plots import draw_spectra

        return draw_spectra(self, target, periods, ax, options)

    def _rows(self, rows: NDArray[np.int64]) -> RecordSet:
        if not len(rows):
            raise argument_error("not_given", "records", ": none are left")
        level, factor = (None if values is None else values[rows] for values in (self.level, self.factor))
        return RecordSet([self.records[i] for i in rows], level=level, factor=factor)

    def _facts(self) -> list[tuple[str, str]]:
        peaks = [record.peak_acceleration for record in self.records]
        facts = [("rows", str(len(self)))]
        if events := {record.event for record in self.records if record.event}:
            facts.append(("events", str(len(events))))
        facts.append(("PGA", f"{min(peaks):.3g} to {max(peaks):.3g} m/s2"))
        if self.level is not None:
            levels = np.unique(self.level[~np.isnan(self.level)])
            facts.append(("levels", " ".join(f"{level:g}" for level in levels)))
        if self.factor is not None:
            facts.append(("factors", f"{np.nanmin(self.factor):.3g} to {np.nanmax(self.factor):.3g}"))
        return facts
