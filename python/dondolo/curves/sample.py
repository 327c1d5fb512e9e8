"""Which histories a curve was fitted to: what a bootstrap draws from."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from dondolo._base.arguments import FloatArray
from dondolo._storage.saved import part_of_results


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
    """

    levels: FloatArray
    collapsed: np.ndarray[Any, np.dtype[np.bool_]]
    ran: np.ndarray[Any, np.dtype[np.bool_]]
    record_index: np.ndarray[Any, np.dtype[np.int64]]
    record_names: tuple[str, ...]

    @property
    def n_records(self) -> int:
        """Number of records."""
        return len(self.record_names)
