"""What is kept of a population while it runs: Fortran's store, in a file or in memory.

It is that of the executable: each goes on with a file that the other has begun.
"""

from __future__ import annotations

import os
import weakref
from collections.abc import Iterable
from types import TracebackType
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from dondolo._base.arguments import FloatArray, as_path
from dondolo._base.files import as_file
from dondolo._fortran import _core
from dondolo._fortran.library import Parcel, check, receive
from dondolo.analysis.request import Request
from dondolo.analysis.work import Work
from dondolo.curves.sample import cluster_labels
from dondolo.populations.flags import Flags
from dondolo.records.record import Record
from dondolo.records.suite import upload
from dondolo.walls.ties import TieCounts

IntArray = NDArray[np.int32]


class Contents(NamedTuple):
    """What a store has.

    Attributes
    ----------
    complete : ndarray of bool, shape (rows,)
        Which rows.
    exceedances : ndarray of int, shape (states, levels, rows)
        How many histories reach each state; 0 for rows that are not there.
    ties : tuple of TieCounts
        What the histories do to the ties of each row that is there.
    flags : Flags
        Which do, of the rows that are there.
    work : Work
        What was computed for them.
    """

    complete: NDArray[np.bool_]
    exceedances: IntArray
    ties: tuple[TieCounts, ...]
    flags: Flags
    work: Work


class Store:
    """Rows of a population that are finished.

    Parameters
    ----------
    path : path or None
        The file, which need not be there; in memory if None.
    request : Request
        All walls, and what they are tried with.
    states : ndarray
        EDP of each damage state.

    Raises
    ------
    InputError
        The file is something else, damaged, or of another study.
    """

    def __init__(self, path: str | os.PathLike[str] | None, request: Request, states: FloatArray) -> None:
        self._request, self._states = request, states
        file = b"" if path is None else as_path(as_file("checkpoint", path))
        study, people = request._study.number, request._people.number
        handle, failure = _core.stores.open_store(file, study, people, states)
        check(failure)
        self._handle = handle
        self._close = weakref.finalize(self, _core.stores.close_store, handle)

    def complete(self) -> NDArray[np.bool_]:
        """Which rows are there, shape (rows,)."""
        return self._state()[0]

    def claim(self) -> None:
        """Make the file this process's; a `DondoloError` tells that it cannot be written, or that another run does."""
        check(_core.stores.claim_store(self._handle))

    def put(self, block: IntArray, rows: int) -> None:
        """Put in the rows of a block; a `DondoloError` tells that they cannot be written."""
        check(_core.stores.put_block(self._handle, block, rows))

    def read(self) -> Contents:
        """Everything that is there."""
        parcel = receive(_core.stores.read_store(self._handle))
        return contents_of(parcel, self._request.records, self._request.runs, self._state()[1])

    def _state(self) -> tuple[NDArray[np.bool_], Work]:
        there, counts, failure = _core.stores.store_state(self._handle, len(self._request.walls))
        check(failure)
        return there.astype(bool), Work._of_counts(counts)

    def __enter__(self) -> Store:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self._close()


def contents_of(parcel: Parcel, records: Iterable[Record], runs: FloatArray, work: Work) -> Contents:
    """What a store has, as Fortran sends it; `runs` are (records, levels)."""
    histories, reached, ties = (parcel[name] for name in ("histories", "reached", "ties"))
    complete, (_, states, levels) = histories > 0, reached.shape
    tied = TieCounts.of_walls(ties[complete].tolist(), levels, *parcel["tie_counts"].T, *parcel["elongations"].T)
    exceedances = np.ascontiguousarray(np.moveaxis(reached, 0, -1))
    packed = parcel["flags"].view(np.uint8)[: int(parcel["flag_bytes"])]
    several = tuple(records)
    labels = cluster_labels(len(several), upload(several).events(), [record.checksum for record in several])
    flags = Flags(histories[complete], levels, states, runs, labels, packed)
    return Contents(complete, exceedances, tied, flags, work)
