"""Histories that a curve was fitted to, for its standard errors and bootstrap."""

from __future__ import annotations

from collections.abc import Hashable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from dondolo._base.arguments import FloatArray, argument_error, as_array
from dondolo._storage.saved import part_of_results
from dondolo.errors import InputError
from dondolo.records.record import Record
from dondolo.records.suite import upload


@part_of_results
@dataclass(frozen=True, eq=False, repr=False, kw_only=True)
class Sample:
    """Histories of one wall, stripe by stripe.

    Attributes
    ----------
    levels : ndarray, shape (levels,)
        Intensities of the stripes.
    collapsed : ndarray of bool, shape (levels, histories)
        Which histories collapse, or reach the damage state of the curve.
    ran : ndarray of bool, shape (levels, histories)
        Which histories were run.
    record_index : ndarray of int, shape (histories,)
        Record of each history, from 0.
    record_names : tuple of str
        Names of the records.
    clusters : tuple of str
        Label of each record; records with the same label depend on each other.
    """

    levels: FloatArray
    collapsed: np.ndarray[Any, np.dtype[np.bool_]]
    ran: np.ndarray[Any, np.dtype[np.bool_]]
    record_index: np.ndarray[Any, np.dtype[np.int64]]
    record_names: tuple[str, ...]
    clusters: tuple[str, ...]

    @property
    def n_records(self) -> int:
        """Number of records."""
        return len(self.record_names)

    def by_cluster(self, labels: Sequence[str]) -> tuple[FloatArray, FloatArray]:
        """Collapses and histories (clusters, levels) of the clusters with these labels, all that there are."""
        numbers = {label: number for number, label in enumerate(labels)}
        places = np.array([numbers[label] for label in self.clusters])[self.record_index]
        member = places == np.arange(len(labels))[:, None]
        return member @ (self.collapsed & self.ran).T.astype(float), member @ self.ran.T.astype(float)


def cluster_labels(records: int, events: Sequence[str] = (), checksums: Sequence[str] = ()) -> tuple[str, ...]:
    """Label of the cluster of each record: its event, else the record itself.

    Parameters
    ----------
    records : int
        Number of records.
    events : sequence of str
        Event of each record, '' for none; empty if no record has one.
    checksums : sequence of str
        Checksum of each record, which makes the label of a record without an event the same in every analysis, and that
        of a record that is given twice the same; empty if they are not known.

    Returns
    -------
    tuple of str
    """
    own = [f"record {one}" for one in checksums] or [f"number {i + 1}" for i in range(records)]
    named = events or [""] * records
    return tuple(f"event {event}" if event else label for event, label in zip(named, own, strict=True))


def given_labels(number: int, events: Sequence[Any], one: str = "record", several: str = "records") -> tuple[str, ...]:
    """Labels that a user gives, one for each record, say; none may be missing, for all that are would be one event."""
    if isinstance(events, str) or not isinstance(events, Iterable):
        raise argument_error("wrong_length", "events", f" = {events!r}: must be labels, one for each {one}")
    labels = list(events)
    if len(labels) != number:
        raise argument_error(
            "wrong_length", "events", f": {len(labels)} labels for {number} {several}: must be as many"
        )
    for i, label in enumerate(labels):
        if label is None or label == "" or label != label or not isinstance(label, Hashable):
            raise argument_error("not_a_string", "events", f": label {i + 1} = {label!r}: must be a name or a number")
    return tuple(f"event {label}" for label in labels)


def sample_of_outcomes(
    levels: ArrayLike,
    outcomes: ArrayLike,
    records: Sequence[Record | str] | None,
    events: Sequence[Any] | None,
) -> Sample:
    """Histories of any program as a sample, see `fit_fragility`."""
    is_column = np.ndim(levels) == 2 and np.shape(levels)[1] == 1
    x = as_array("levels", np.ravel(levels) if is_column else levels).copy()
    try:
        flags = np.asarray(outcomes, dtype=np.float64)
    except (TypeError, ValueError):
        raise argument_error("not_numbers", "collapses", ": must be numbers") from None
    shape = f": outcomes of shape {flags.shape} for {len(x)} levels"
    if len(flags) != len(x):
        turned = "; transpose it" if flags.shape[1] == len(x) else ""
        raise argument_error(
            "wrong_length", "collapses", f"{shape}: must be (levels, histories), one row for each level{turned}"
        )
    ran = ~np.isnan(flags)
    wrong = ran & (flags != 0.0) & (flags != 1.0)
    if wrong.any():
        raise argument_error(
            "out_of_range", "collapses", f" = {flags[wrong][0]:g}: the outcome of a history must be 0, 1 or NaN"
        )
    if not ran.any():
        raise argument_error("not_given", "collapses", ": no history was run")
    if flags.shape == flags.T.shape and not is_column and _may_be_turned(x, flags):
        raise argument_error(
            "not_together",
            "collapses",
            f"{shape}, (levels, histories): with the rows as histories, collapses fall no more often from a level to a"
            " higher one; transpose it if they are histories, else give the levels as a column, levels[:, None]",
        )
    number = flags.shape[1]
    several = [f"history {i + 1}" for i in range(number)] if records is None else _as_records(records, number)
    # Name, key and label of each, as stripes label theirs
    motions = tuple(dict.fromkeys(one for one in several if isinstance(one, Record)))
    events_of = dict(zip(motions, upload(motions).events(), strict=True)) if motions else {}
    told = [_told(one, events_of) for one in several]
    names, known, labels = (list(column) for column in zip(*told, strict=True))
    if events is not None:
        labels = list(given_labels(number, events, "history", "histories"))
    first = {key: i for i, key in reversed(list(enumerate(known)))}
    place = {key: number for number, key in enumerate(dict.fromkeys(known))}
    for i, key in enumerate(known):
        if labels[i] != labels[first[key]]:
            raise InputError(f"events: '{labels[i]}' and '{labels[first[key]]}' for one record, '{names[i]}'")
    return Sample(
        levels=x,
        collapsed=flags == 1.0,
        ran=ran,
        record_index=np.array([place[key] for key in known], dtype=np.int64),
        record_names=tuple(names[first[key]] for key in place),
        clusters=tuple(labels[first[key]] for key in place),
    )


def _may_be_turned(levels: FloatArray, flags: FloatArray) -> bool:
    """Whether as many levels as histories, levels first, may be the other way round: by what collapses, then stands."""

    def falls(outcomes: FloatArray) -> int:
        rising = outcomes[np.argsort(levels, kind="stable")]
        return int(((rising == 0.0) * np.cumsum(rising == 1.0, axis=0)).sum())

    return not np.array_equal(flags, flags.T, equal_nan=True) and falls(flags) >= falls(flags.T)


def _told(record: Record | str, events: Mapping[Record, str]) -> tuple[str, str, str]:
    """Name of a record, what is the same for the same record, and the label of its cluster."""
    if isinstance(record, str):
        return record, f"record {record}", f"record {record}"
    key = f"record {record.checksum}"
    return record.name, key, f"event {events[record]}" if events[record] else key


def _as_records(records: Any, histories: int) -> list[Record | str]:
    """The record of each history, or its name."""
    if isinstance(records, (str, Record)) or not isinstance(records, Iterable):
        raise argument_error("wrong_length", "records", f" = {records!r}: must be one for each history")
    several = list(records)
    if len(several) != histories:
        raise argument_error("wrong_length", "records", f": {len(several)} for {histories} histories: must be as many")
    for one in several:
        if not isinstance(one, Record) and (not isinstance(one, str) or not one):
            raise argument_error("wrong_type", "records", f": {one!r}: must be a Record or a name")
    return several
