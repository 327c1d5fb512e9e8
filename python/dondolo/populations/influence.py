"""How much an integral of the mean curve of a population changes if a cluster of records, or a wall, is left out."""

from __future__ import annotations

import numpy as np

from dondolo._base.arguments import FloatArray
from dondolo._fortran.curves import cluster_changes
from dondolo._fortran.library import constants
from dondolo.curves.members import Members
from dondolo.curves.occurrence import wall_probability, wall_slopes
from dondolo.errors import DondoloError
from dondolo.populations.flags import Flags

# Numbers that are held at a time: rows x the larger of levels of the integral, and clusters x levels
_NUMBERS = 2_000_000


def changes(
    members: Members, flags: Flags, rows: np.ndarray, x: FloatArray, weights: FloatArray
) -> dict[str, FloatArray]:
    """Changes of sum(weights * P(x)), P the mean curve, to first order, by clusters of records and by walls.

    Parameters
    ----------
    members : Members
        The walls.
    flags : Flags
        The states that the histories of all walls reach.
    rows : ndarray of int
        The wall in the flags of each row of the members.
    x, weights : ndarray, shape (levels,)
        Intensities of the integral, and their weights.

    Returns
    -------
    dict
        'clusters of records' and, if there are several, 'walls' -> change if each is left out.

    Raises
    ------
    DondoloError
        Fewer than three clusters of records.
    """
    labels = flags.labels
    if len(labels) < (fewest := constants().fewest_clusters):
        raise DondoloError(f"no standard errors: fewer than {fewest} clusters of records")
    member = flags._members
    part = member @ flags.runs / flags.records
    share = members.weights / members.weights.sum()
    first = members.rows[0][1]
    ends = np.append(first[1:], len(rows))
    of_records, of_walls = np.zeros(len(labels)), np.zeros(len(first))
    step = max(1, _NUMBERS // max(len(x), part.size))
    # Straight lines between the levels of the analysis, for rows without a fit
    levels = np.append(0.0, members.levels)
    lines = np.stack([np.interp(x, levels, one) for one in np.eye(len(levels))[1:]])
    for start in range(0, len(first), step):
        walls = slice(start, start + step)
        these = np.arange(first[walls][0], ends[walls][-1])
        starts = first[walls] - these[0]
        probability = members.rows_at(these, x)
        occurs = members.p_occ[these], members.alternative[these]
        of_walls[walls] = wall_probability(*occurs, probability, starts) @ weights
        owner = np.repeat(np.arange(len(starts)), ends[walls] - first[walls])
        slopes = wall_slopes(*occurs, probability, starts)
        slopes *= share[walls][owner, None] * weights
        shares = flags.reached(rows[these], member)
        for row, slope, counts in zip(these, slopes, shares, strict=True):
            of_records += _of_row(members, int(row), x, slope, lines, counts, part)
    found = {"clusters of records": of_records}
    if len(first) > 1:
        found["walls"] = share * (share @ of_walls - of_walls) / (1.0 - share)
    return found


def _of_row(
    members: Members,
    row: int,
    x: FloatArray,
    slope: FloatArray,
    lines: FloatArray,
    counts: FloatArray,
    part: FloatArray,
) -> FloatArray:
    """Change of sum(slope * P(x)) of a row if each cluster is left out; counts and part are (clusters, levels)."""
    theta, beta = float(members.theta[row]), float(members.beta[row])
    if np.isfinite(theta):
        moved, _, errors = cluster_changes(members.levels, counts, part, theta, beta)
        if errors == "clustered":
            z = np.log(x / theta) / beta
            density = slope * np.exp(-0.5 * z**2) / (np.sqrt(2.0 * np.pi) * beta)
            change: FloatArray = -(moved @ np.array([density.sum(), density @ z]))
            return change
    # By its fractions
    rest = part.sum(axis=0) - part
    with np.errstate(invalid="ignore", divide="ignore"):
        left = (counts.sum(axis=0) - counts) / rest - counts.sum(axis=0) / part.sum(axis=0)
    return np.asarray(np.where(rest > 0.0, left, 0.0) @ (lines @ slope))
