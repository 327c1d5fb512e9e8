"""Which histories a curve was fitted to: what its standard errors and a bootstrap follow from."""

from __future__ import annotations

from collections.abc import Hashable, Iterable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from dondolo._base.arguments import FloatArray
from dondolo._storage.saved import part_of_results
from dondolo.errors import InputError


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


def given_labels(records: int, events: Sequence[Any]) -> tuple[str, ...]:
    """Labels that a user gives, one for each record; none may be missing, for all that are would be one event."""
    if isinstance(events, str) or not isinstance(events, Iterable):
        raise InputError(f"events = {events!r}: must be labels, one for each record")
    labels = list(events)
    if len(labels) != records:
        raise InputError(f"events: {len(labels)} labels for {records} records: must be as many")
    for i, label in enumerate(labels):
        if label is None or label == "" or label != label or not isinstance(label, Hashable):
            raise InputError(f"events: label {i + 1} = {label!r}: must be a name or a number")
    return tuple(f"event {label}" for label in labels)
