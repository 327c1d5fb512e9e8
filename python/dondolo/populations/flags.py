"""Which history reaches which state, a bit each: what is kept of a population."""

from __future__ import annotations

import functools
from collections.abc import Iterable
from dataclasses import dataclass, fields, replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from dondolo._base.arguments import FloatArray, argument_error, as_array
from dondolo._fortran.populations import FlatFlags
from dondolo._storage.saved import part_of_results
from dondolo.curves.sample import cluster_labels

Bits = NDArray[np.uint8]


@part_of_results
@dataclass(frozen=True, eq=False)
class Flags:
    """The states that every history of every wall reaches.

    The bits of a wall stand together, state by state, level by level and history by history, and begin with a byte of
    their own.

    Attributes
    ----------
    histories : ndarray of int, shape (walls,)
        Histories of each wall in a stripe in which every record runs.
    levels : int
        Number of levels.
    states : int
        Number of states, collapse among them.
    runs : ndarray, shape (records, levels)
        1 where a record runs at a level, else 0. The histories of a wall are those of all records, and again in the
        other polarity if there are two.
    clusters : tuple of str
        Label of the cluster of each record (`Sample.clusters`).
    bits : ndarray of uint8
        Eight flags a byte.
    state : int
        Place of the state that is asked for; the last, collapse, if not said.
    """

    histories: NDArray[np.int32]
    levels: int
    states: int
    runs: FloatArray
    clusters: tuple[str, ...]
    bits: Bits
    state: int = -1

    @classmethod
    def empty(
        cls, histories: NDArray[np.int32], levels: int, states: int, runs: FloatArray, clusters: tuple[str, ...]
    ) -> Flags:
        """No history reaches anything."""
        sizes = _bytes_of(histories, levels * states)
        return cls(histories, levels, states, runs, clusters, np.zeros(int(sizes.sum()), dtype=np.uint8))

    @classmethod
    def of_counts(cls, exceedances: NDArray[np.int32], histories: NDArray[np.int32]) -> Flags:
        """Flags of counts (states, levels, walls), as if of one record: which histories they are of is not known.

        Histories are (levels, walls).
        """
        states, levels, walls = exceedances.shape
        most = histories.max(axis=0)
        bits = [np.packbits(np.arange(most[i]) < exceedances[:, :, i, None]) for i in range(walls)]
        # Levels have the same share of the records for all walls.
        runs = (histories[:, 0] / most[0])[None, :]
        return cls(most, levels, states, runs, cluster_labels(1), np.concatenate(bits))

    @property
    def records(self) -> int:
        """Number of records."""
        return len(self.runs)

    def drawn(self, records: FloatArray) -> FloatArray:
        """Histories at each level (samples, levels), relative to all records, if each record comes so many times."""
        if self.runs.all():
            return np.ones((len(records), self.levels))
        return np.asarray(records @ self.runs / self.records)

    @functools.cached_property
    def labels(self) -> tuple[str, ...]:
        """Label of each cluster of records, in the order they appear in."""
        return tuple(dict.fromkeys(self.clusters))

    @functools.cached_property
    def _members(self) -> FloatArray:
        """1 where a record belongs to a cluster, shape (clusters, records)."""
        return np.array([[own == label for own in self.clusters] for label in self.labels], dtype=float)

    def _flat(self) -> FlatFlags:
        """The same as Fortran takes it."""
        numbers = {label: number for number, label in enumerate(self.labels, 1)}
        bits = np.zeros(-(-len(self.bits) // 4) * 4, dtype=np.uint8)
        bits[: len(self.bits)] = self.bits
        clusters = np.array([numbers[label] for label in self.clusters], dtype=np.int32)
        state = self.state % self.states + 1
        return FlatFlags(
            self.states, state, self.histories, bits.view(np.int32), clusters, (self.runs > 0.0).astype(np.int32)
        )

    @functools.cached_property
    def _starts(self) -> NDArray[np.int64]:
        """Where the bytes of each wall begin, and the end of the last."""
        return np.append(0, np.cumsum(_bytes_of(self.histories, self.levels * self.states)))

    def __getstate__(self) -> dict[str, Any]:
        # Not what is easily computed again
        return {one.name: getattr(self, one.name) for one in fields(self)}

    def place(self, first: int, count: int) -> slice:
        """Where the bytes of some walls are, from number `first` on."""
        return slice(int(self._starts[first]), int(self._starts[first + count]))

    def of(self, walls: ArrayLike) -> NDArray[np.bool_]:
        """Flags (walls, states, levels, histories) of walls that have equally many histories."""
        chosen = np.asarray(walls)
        histories = int(self.histories[chosen[0]])
        size = self._starts[chosen[0] + 1] - self._starts[chosen[0]]
        packed = self.bits[self._starts[chosen][:, None] + np.arange(size)]
        flags = np.unpackbits(packed, axis=1, count=self.states * self.levels * histories)
        return flags.reshape(len(chosen), self.states, self.levels, histories).view(np.bool_)

    def reached(self, walls: ArrayLike, records: FloatArray) -> FloatArray:
        """Histories that reach the state (walls, samples, levels) over those of all records at all levels.

        `records` (samples, records) says how often each sample has each record.
        """
        chosen = np.asarray(walls)
        found = np.empty((len(chosen), len(records), self.levels))
        for places in self.alike(chosen):
            flags = self.of(chosen[places])[:, self.state]
            rows, levels, histories = flags.shape
            # Both polarities of a record stay together.
            of_record = flags.reshape(rows, levels, -1, self.records).sum(axis=2, dtype=np.float64)
            drawn = records @ of_record.reshape(rows * levels, -1).T
            found[places] = np.moveaxis(drawn.reshape(len(records), rows, levels), 1, 0) / histories
        return found

    def at(self, state: int) -> Flags:
        """The same, of another state."""
        return replace(self, state=state)

    def alike(self, walls: NDArray[np.int64]) -> Iterable[NDArray[np.int64]]:
        """Places in a list of walls, of those with equally many histories together."""
        histories = self.histories[walls]
        return (np.flatnonzero(histories == number) for number in np.unique(histories))

    def counts(self, first: int, count: int) -> NDArray[np.int32]:
        """How many histories reach each state (states, levels, walls), of some walls from number `first` on."""
        walls = np.arange(first, first + count)
        counts = np.empty((self.states, self.levels, count), dtype=np.int32)
        for places in self.alike(walls):
            counts[:, :, places] = np.moveaxis(self.of(walls[places]).sum(axis=-1, dtype=np.int32), 0, -1)
        return counts

    def chosen(self, walls: NDArray[np.int64]) -> Flags:
        """Those of some walls only."""
        bits = [self.bits[self.place(int(i), 1)] for i in walls]
        return replace(self, histories=self.histories[walls], bits=np.concatenate(bits))


def states_of(edp_thresholds: ArrayLike | None, edp_limit: float) -> FloatArray:
    """EDP from which on a history is in each state: what a user gives, checked, and collapse as the last."""
    given = np.empty(0) if edp_thresholds is None else as_array("edp_thresholds", edp_thresholds)
    for one, other in zip(np.append(0.0, given), given, strict=False):
        if not other > 0.0:
            raise argument_error("out_of_range", "edp_thresholds", f" = {other:g}: must be positive")
        if not other > one:
            raise argument_error("not_increasing", "edp_thresholds", f" = {other:g}: must increase")
        if not other <= edp_limit:
            raise argument_error(
                "out_of_range", "edp_thresholds", f" = {other:g}: must be at most edp_limit = {edp_limit:g}"
            )
    states = np.append(given[given < edp_limit], edp_limit)
    states.flags.writeable = False
    return states


def _bytes_of(histories: NDArray[np.int32], flags: int) -> NDArray[np.int64]:
    """Bytes that walls take with so many flags a history."""
    return (histories.astype(np.int64) * flags + 7) // 8
