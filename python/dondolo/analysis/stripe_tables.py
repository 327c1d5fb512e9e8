"""Tables of stripes, as the executable has them."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from dondolo._fortran.tables import TableColumns, history_columns

if TYPE_CHECKING:
    from dondolo.analysis.stripes import Stripes

# Columns that stripes have as matrices, or not at all
_COLUMNS = (
    *("scale", "edp", "time_of_peak", "collapsed", "impacts"),
    *("edp_error", "status", "edp_lowest", "edp_highest", "uplift"),
)


def histories_table(stripes: Stripes) -> TableColumns:
    """Columns of ``_histories.csv``."""
    ran = stripes.ran
    level, history = np.nonzero(ran)

    def of_rows(values: Any) -> Any:
        return np.zeros(len(level)) if values is None else values[ran]

    columns = {name: of_rows(getattr(stripes, name)) for name in _COLUMNS} | {
        "record": stripes.record_index[history] + 1,
        "polarity": stripes.polarity[history],
        "level": stripes.levels[level],
    }
    texts = (stripes.wall.name, stripes.wall.mechanism, *stripes.record_names[: stripes.n_records])
    has = {
        "has_errors": stripes.edp_error is not None,
        "has_certificates": stripes.status is not None,
        "has_uplifts": stripes.uplift is not None,
    }
    return history_columns(texts, stripes.im, columns, has)
