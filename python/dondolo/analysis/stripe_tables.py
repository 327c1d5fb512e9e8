"""Tables of stripes, as the executable writes them."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from dondolo._base.arguments import FloatArray
from dondolo._storage import tables
from dondolo.analysis.certificate import Certified
from dondolo.analysis.request import polarity_names
from dondolo.walls.wall import Wall

if TYPE_CHECKING:
    from dondolo.analysis.stripes import Stripes


def histories_table(stripes: Stripes) -> tables.Table:
    """Columns of ``_histories.csv``."""
    ran = stripes.ran
    level, history = np.nonzero(ran)
    signs = polarity_names(stripes.polarity)
    table: tables.Table = {
        "wall": [stripes.wall.name] * len(level),
        "mechanism": [stripes.wall.mechanism] * len(level),
        "record": [stripes.record_names[i] for i in history],
        "polarity": [signs[i] for i in history],
        "im": [stripes.im] * len(level),
        "im_level": stripes.levels[level],
        "scale": stripes.scale[ran],
        "edp": stripes.edp[ran],
        "collapsed": stripes.collapsed[ran].astype(int),
        "impacts": stripes.impacts[ran],
        "time_of_peak_s": stripes.time_of_peak[ran],
    }
    if stripes.edp_error is not None:
        table["edp_error"] = stripes.edp_error[ran]
    if stripes.status is not None and stripes.edp_lowest is not None and stripes.edp_highest is not None:
        table["status"] = [Certified(one).name.lower() if one else "" for one in stripes.status[ran]]
        table["edp_lowest"] = stripes.edp_lowest[ran]
        table["edp_highest"] = stripes.edp_highest[ran]
    if stripes.uplift is not None:
        table["uplift"] = stripes.uplift[ran].astype(int)
    return table


def stripes_table(
    walls: Sequence[Wall],
    im: str,
    levels: FloatArray,
    edp_thresholds: ArrayLike,
    exceedances: np.ndarray[Any, Any],
    histories: ArrayLike,
    uplift: ArrayLike | None = None,
) -> tables.Table:
    """Columns of ``_stripes.csv``; exceedances are (thresholds, levels, walls), histories (levels, walls).

    With vertical motion one wall has its histories with uplift, (levels,).
    """
    thresholds = np.asarray(edp_thresholds)
    states, number = len(thresholds), len(levels)
    counts = exceedances.transpose(2, 0, 1).ravel()
    sizes = np.repeat(np.asarray(histories).T[:, None, :], states, axis=1).ravel()
    table = {
        "wall": [wall.name for wall in walls for _ in range(states * number)],
        "mechanism": [wall.mechanism for wall in walls for _ in range(states * number)],
        "im": [im] * len(counts),
        "im_level": np.tile(levels, states * len(walls)),
        "histories": sizes,
        "collapses": counts,
        "fraction": counts / sizes,
        "edp_threshold": np.tile(np.repeat(thresholds, number), len(walls)),
    }
    return table if uplift is None else table | {"uplift": np.tile(uplift, states * len(walls))}
