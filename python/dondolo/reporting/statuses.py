"""Facts on the fits that several chapters share: their statuses, and damage states whose curves cross."""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Mapping, Sequence
from itertools import pairwise

import numpy as np

from dondolo._base.arguments import FloatArray
from dondolo._base.wording import in_english, named, say
from dondolo._fortran.records import blank_unit
from dondolo.curves.fragility import Fragility
from dondolo.reporting.content import Piece, Table, level_head
from dondolo.reporting.numerals import number, whole

# From how much on damage states are said to cross
_CROSSING = 1e-3

STATUSES = {
    "ok": "a curve",
    "extrapolated": "a curve whose median θ lies outside the levels of the analysis: to be used with care",
    "nearly_flat": "a curve whose slope is not significant: θ and β are not reliable",
    "no_collapse": "no history reached the state at any level: no curve",
    "all_collapse": "every history reached the state at every level: no curve",
    "separated": "no overlap between levels that reach the state and levels that do not: any steep curve fits",
    "single_level": "one level only: no curve",
    "decreasing": "the state does not become more frequent with the level: no curve",
    "not_converged": "the maximum of the likelihood was not found: no curve",
}


def status_meaning(status: str) -> str:
    """A status of a fit in words."""
    return named("status", status, STATUSES[status])


def short_status(status: str) -> str:
    """A status of a fit in few words."""
    return say(status.replace("_", " "))


def in_words(curve: Fragility) -> str:
    """A curve in words, for those who cannot see it."""
    if not curve.has_fit:
        return say("no fit ({status})", status=curve.status if in_english() else short_status(curve.status))
    return say(
        "median {theta:.3g}{unit}, dispersion {beta:.3g}",
        theta=curve.theta,
        unit=blank_unit(curve.im),
        beta=curve.beta,
    )


def status_table(states: Mapping[str, Sequence[Fragility]]) -> Table:
    """How many curves have which status, a column for each damage state."""
    counts = {name: Counter(curve.status for curve in curves) for name, curves in states.items()}
    found = [status for status in STATUSES if any(count[status] for count in counts.values())]
    shown = found if in_english() else [short_status(status) for status in found]
    columns: dict[Piece, Sequence[Piece]] = {say("status"): shown}
    columns |= {name: [whole(count[status]) for status in found] for name, count in counts.items()}
    meaning = say("meaning")
    columns[meaning] = [status_meaning(status) for status in found]
    return Table.of(columns, (meaning,))


def crossings(
    curves: Mapping[str, Sequence[Callable[[FloatArray], FloatArray]]],
    names: Sequence[str],
    levels: FloatArray,
    im: str,
) -> Table | None:
    """Find where a more severe damage state is more probable than a less severe one: fitted curves may cross.

    Parameters
    ----------
    curves : mapping
        Whose -> functions of the intensity, from the least severe state to collapse.
    names : sequence of str
        Of the states.
    levels : ndarray
        Of the analysis; looked at is what lies up to the highest.
    im : str
        Intensity measure.

    Returns
    -------
    Table or None
        None if no two states cross.
    """
    x = np.linspace(0.0, levels[-1], 201)[1:]
    rows = []
    for whose, states in curves.items():
        values = [state(x) for state in states]
        for i, (lighter, heavier) in enumerate(pairwise(values)):
            most = int(np.argmax(heavier - lighter))
            if heavier[most] - lighter[most] > _CROSSING:
                rows.append((whose, names[i + 1], names[i], number(heavier[most] - lighter[most], 2), number(x[most])))
    if not rows:
        return None
    heads = (
        say("curve"),
        say("more probable is"),
        say("than"),
        say("by up to"),
        say("at {level}", level=level_head(im)),
    )
    return Table.of(dict(zip(heads, zip(*rows, strict=True), strict=True)), heads[:3])
