"""Tables of stripes, as the executable has them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from dondolo._fortran.tables import TableColumns, history_columns

if TYPE_CHECKING:
    from dondolo.analysis.stripes import Stripes


def histories_table(stripes: Stripes) -> TableColumns:
    """Columns of ``_histories.csv``."""
    ran = stripes.ran
    level, history = np.nonzero(ran)

    def of_rows(values: Any) -> Any:
        return np.zeros(len(level)) if values is None else values[ran]

    integers = [
        stripes.record_index[history] + 1,
        stripes.polarity[history],
        *map(of_rows, (stripes.collapsed, stripes.impacts, stripes.status, stripes.uplift)),
    ]
    reals = [
        stripes.levels[level],
        *map(of_rows, (stripes.scale, stripes.edp, stripes.time_of_peak)),
        *map(of_rows, (stripes.edp_error, stripes.edp_lowest, stripes.edp_highest)),
    ]
    texts = (stripes.wall.name, stripes.wall.mechanism, *stripes.record_names[: stripes.n_records])
    has = stripes.edp_error is not None, stripes.status is not None, stripes.uplift is not None
    return history_columns(texts, stripes.im, integers, reals, has)
