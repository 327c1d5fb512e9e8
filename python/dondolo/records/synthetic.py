"""Synthetic records from the project's own generator."""

from __future__ import annotations

from typing import Any, Literal

from dondolo._base.arguments import argument_error, as_count, as_number
from dondolo._fortran import _core
from dondolo._fortran.library import as_text, receive
from dondolo._fortran.records import unpack_records
from dondolo.records.record import Record

#: Format of records that were computed, not recorded
SYNTHETIC = "synthetic"


def synthetic_records(
    magnitude: float,
    distance: float,
    site: Literal["rock", "shallow", "deep"],
    *,
    n_records: int = 1,
    seed: int = 1,
    first: int = 0,
    deviations: float = 0.0,
) -> list[Record]:
    """Realisations of the model of Sabetta and Pugliese (1996) for an Italian earthquake.

    Parameters
    ----------
    magnitude : float
        Magnitude of the earthquake, 4 to 7.5 (the model was calibrated on 4.6 to 6.8).
    distance : float
        Epicentral distance [km], 0 to 150 (calibrated up to 100).
    site : {'rock', 'shallow', 'deep'}
        Rock, shallow alluvium or deep alluvium.
    n_records : int
        Number of records.
    seed : int
        Seed of the random phases, positive. The same seed makes the same records on every machine.
    first : int
        Number of the first realisation, from 0: the records of (n_records=5, first=0) and (n_records=5, first=5) are
        those of n_records=10.
    deviations : float
        Standard deviations by which duration and energy exceed their medians, -3 to 3.

    Returns
    -------
    list of Record
        With a time step of 0.005 s, named after the arguments, which their metadata hold too: magnitude,
        distance_km, site, seed, realisation, deviations and format ('synthetic'). State that they are synthetic where
        you show them. Realisations are independent: each is an event of its own, named after the record.

    Raises
    ------
    InputError
        An argument outside its range.

    Notes
    -----
    The generator of ``dondolo-synthetic44``, with one stream of random numbers per realisation; only the phases are
    random, so that two realisations differ less than two recorded motions of a magnitude and distance.
    docs/processing.md shows what the model gives and how it differs from recordings.

    Examples
    --------
    >>> import dondolo as dd
    >>> records = dd.synthetic_records(magnitude=6.5, distance=10.0, site="shallow", n_records=3)
    >>> len(records), records[0].dt
    (3, 0.005)
    """
    numbers = [
        as_number(what, value)
        for what, value in (("magnitude", magnitude), ("distance", distance), ("deviations", deviations))
    ]
    for what, value, least in (("n_records", n_records, 1), ("seed", seed, 1), ("first", first, 0)):
        as_count(what, value, least, 2**31 - 1)
    if int(first) + int(n_records) > 2**31:
        raise argument_error(
            "out_of_range",
            "first",
            f" = {first}, n_records = {n_records}: realisations must have numbers below 2147483648",
        )
    place = as_text("site", site)
    return [_realisation(*numbers[:2], place, int(seed), int(first) + i, numbers[2]) for i in range(n_records)]


def _realisation(*arguments: Any) -> Record:
    parcel = receive(_core.records.synthetic_record(*arguments))
    (data,) = unpack_records(parcel)
    magnitude, distance, site, seed, realisation, deviations = arguments
    metadata = {
        "event": data.name,
        "magnitude": f"{magnitude:.15g}",
        "distance_km": f"{distance:.15g}",
        "site": site.decode(),
        "seed": str(seed),
        "realisation": str(realisation),
        "deviations": f"{deviations:.15g}",
        "format": SYNTHETIC,
    }
    return Record(data.acceleration, data.dt, data.name, metadata=metadata)
