"""How many specimens of a mechanism were tested against dondolo: what reports say of the error of the model."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import NamedTuple

# What sentences that are said elsewhere are marked by for the catalogues
_ = str


class Tested(NamedTuple):
    """Tests of a mechanism, as docs/experiments.md has them.

    Attributes
    ----------
    specimens : int
    bias, sd : float or None
        Mean and standard deviation of ln(measured median / computed median); None if no curve was measured.
    """

    specimens: int
    bias: float | None = None
    sd: float | None = None


TESTED = {"free_standing": Tested(2, 0.09, 0.33), "two_block": Tested(3)}

_NONE = _("{mechanism}: no test of this mechanism is in the program.")
_OUTCOMES = _(
    "{mechanism}: tests of this mechanism, {specimens} specimens, too few for a bias of the curve (page Computed"
    " against measured of the documentation)."
)
_CURVES = _(
    "{mechanism}: tests of this mechanism, {specimens} specimens, bias {bias}, standard deviation {sd} of"
    " ln(measured median / computed median), too few to be used (page Computed against measured of the documentation)."
)


def sentences(
    mechanisms: Iterable[str], name: Callable[[str], str], digits: Callable[[str], str]
) -> list[tuple[str, dict[str, str]]]:
    """One sentence for each mechanism, not yet translated, with its values.

    Parameters
    ----------
    mechanisms : iterable of str
        Those of the walls; each is said once.
    name : callable
        The mechanism in words.
    digits : callable
        Digits with the decimal mark of the document.
    """
    found = []
    for mechanism in dict.fromkeys(mechanisms):
        one = TESTED.get(mechanism, Tested(0))
        words = name(mechanism)
        values = {"mechanism": words[:1].upper() + words[1:]}
        if not one.specimens:
            found.append((_NONE, values))
            continue
        values["specimens"] = str(one.specimens)
        if one.bias is None or one.sd is None:
            found.append((_OUTCOMES, values))
            continue
        values |= {"bias": digits(f"{one.bias:+.2f}"), "sd": digits(f"{one.sd:.2f}")}
        found.append((_CURVES, values))
    return found
