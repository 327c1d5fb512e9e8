"""Words and symbols that the chapters of a report share."""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from datetime import datetime
from itertools import pairwise
from typing import Any

import numpy as np

from dondolo._base.arguments import FloatArray
from dondolo._fortran import _binding
from dondolo._page import Markup, facts, joined, number, symbol, table, tag, whole
from dondolo.curves.fragility import Fragility
from dondolo.figures import style

Chapter = tuple[str, str, Markup]
THETA = symbol("θ")
BETA = symbol("β")
# What is said of damage states that cross
_CROSSING = 1e-3
STATUSES = {
    "ok": "a curve",
    "extrapolated": "a curve whose median θ lies outside the levels of the analysis: to be used with care",
    "no_collapse": "no history reached the state at any level: no curve",
    "all_collapse": "every history reached the state at every level: no curve",
    "separated": "no overlap between levels that reach the state and levels that do not: any steep curve fits",
    "single_level": "one level only: no curve",
    "decreasing": "the state does not become more frequent with the level: no curve",
    "not_converged": "the maximum of the likelihood was not found: no curve",
}
LOGNORMAL = (
    "The curve is P(C | IM = x) = Φ(ln(x/θ)/β), Φ the standard normal distribution: θ is the median, the level at which"
    " the probability is one half, and β the dispersion, the standard deviation of ln IM at collapse. Where"
    " mechanisms may not occur it is that of the walls that can collapse, times their share."
)


def state_name(edp: float, limit: float) -> str:
    """A damage state in words."""
    return "collapse" if edp == limit else f"EDP ≥ {edp:g}"


def with_unit(value: float, im: str, figures: int = 3) -> Markup:
    """A level of intensity and its unit."""
    return joined(number(value, figures), f" {_binding.unit_of(im)}".rstrip())


def level_head(im: str) -> str:
    """Head of a column of levels."""
    return f"{im} [{_binding.unit_of(im) or '-'}]"


def status_table(states: dict[str, Sequence[Fragility]]) -> Markup:
    """How many curves have which status, a column a damage state."""
    counts = {name: Counter(curve.status for curve in curves) for name, curves in states.items()}
    found = [status for status in STATUSES if any(count[status] for count in counts.values())]
    columns: dict[Any, Any] = {"status": found}
    columns |= {name: [whole(count[status]) for status in found] for name, count in counts.items()}
    columns["meaning"] = [STATUSES[status] for status in found]
    return table("Fits of the single walls and mechanisms by their status.", columns, ("meaning",))


def crossings(curves: dict[str, Sequence[Any]], names: Sequence[str], levels: FloatArray, im: str) -> Markup:
    """Where a more severe damage state is more probable than a less severe one: fitted curves may cross.

    Parameters
    ----------
    curves : dict
        Whose -> functions of the intensity, from the least severe state to collapse.
    names : sequence of str
        Of the states.
    levels : ndarray
        Of the analysis; looked at is what lies up to the highest.
    im : str
        Intensity measure.
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
        return Markup("")
    heads = ("curve", "more probable is", "than", "by up to", f"at {level_head(im)}")
    return joined(
        tag(
            "p",
            "The curves of the damage states are fitted each on its own, and cross: a more severe state seems more"
            " probable than a less severe one, which cannot be. Where they do the larger of both probabilities is on"
            " the safe side.",
        ),
        table("Damage states that cross.", dict(zip(heads, zip(*rows, strict=True), strict=True)), heads[:3]),
    )


def symbols(im: str) -> Markup:
    """What letters and terms mean."""
    pairs = [
        ("IM, x", f"intensity measure of the ground motion: {style.im_label(im)}"),
        ("C", "collapse: the rotation reaches the limit, unless another damage state is named"),
        ("EDP", "engineering demand parameter: largest rotation / capacity, without a unit"),
        (THETA, "median of a fragility curve, in the unit of IM"),
        (BETA, "dispersion of a fragility curve: standard deviation of ln IM at collapse"),
        (symbol("β", "walls"), joined("dispersion between walls: weighted standard deviation of ln ", THETA)),
        (
            symbol("β", "records"),
            joined("dispersion between records: weighted root mean square of ", BETA, " of the walls"),
        ),
        (symbol("a", "0"), "trigger: ground acceleration at which the wall begins to rock"),
        ("capacity", "rotation at which the wall overturns without further shaking [rad]"),
        (symbol("p"), "frequency parameter of the rocking wall [rad/s]: the smaller, the slower"),
        ("speed ratio", "speed of rotation after an impact over that before it; restitution times what it is given as"),
        (symbol("p", "occ"), "probability that a mechanism can occur in a wall"),
        ("weight", "how many walls, or what share of the centre, a wall stands for"),
    ]
    return joined(facts(pairs), tag("p", "A dash stands for what does not exist, such as the parameters of no fit."))


def date_in_words(moment: datetime) -> str:
    """A date in words."""
    return f"{moment.day} {moment:%B %Y, %H:%M %Z}".strip().replace(" ", "\N{NO-BREAK SPACE}")
