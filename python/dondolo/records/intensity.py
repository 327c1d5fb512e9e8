"""Tables of the intensity measures of records."""

from __future__ import annotations

from collections.abc import Iterable
from typing import Any

from dondolo._base.arguments import as_measures
from dondolo._fortran.records import describe_measure
from dondolo._storage import tables
from dondolo.records.record import Record, as_records
from dondolo.records.record_set import factors_of
from dondolo.records.suite import intensities

# What a table of records shows unless told otherwise
_COLUMNS = ("pga", "pgv", "pgd", "arias", "cav", "d5-75", "d5-95", "hi", "sa(0.5)", "sa(1)", "saavg(0.2:2)")


def intensity_table(
    records: Record | Iterable[Record], ims: str | Iterable[str] = _COLUMNS, *, gravity: float | None = None
) -> Any:
    """Intensity measures of records.

    Parameters
    ----------
    records : Record or iterable of Record
        The accelerograms. Measures are those of the records of a `RecordSet` times their factors.
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
        No records, or no such measure; a row of a set with a level and no factor.

    Examples
    --------
    >>> import dondolo as dd
    >>> records = dd.synthetic_records(6.5, 10.0, "shallow", n_records=3)
    >>> list(dd.intensity_table(records, ["pga", "d5-95"]).columns)
    ['record', 'pga [g]', 'd5-95 [s]']
    """
    factors = factors_of(records)
    several = as_records(records)
    # A record may have several rows, and a suite must not hold it twice.
    each = tuple(dict.fromkeys(several))
    place = {id(record): i for i, record in enumerate(each)}
    rows = [place[id(record)] for record in several]
    table: dict[str, Any] = {"record": [record.name for record in several]}
    for im in as_measures(ims):
        measure = describe_measure(im, of_record=True)
        values = intensities(each, im, gravity)[rows]
        if factors is not None:
            values = values * factors**measure.power
        table[f"{measure.name} [{measure.unit}]"] = values
    return tables.frame(table)
