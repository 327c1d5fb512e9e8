"""Fragility curves in words."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from dondolo._base.wording import say
from dondolo._fortran.records import blank_unit

if TYPE_CHECKING:
    from dondolo.curves.fragility import Fragility
    from dondolo.curves.lognormal import LognormalCurve

# What sentences that are said elsewhere are marked by for the catalogues
_ = str
#: Why a curve has no standard errors, or has naive ones
WHY_NO_ERRORS = {
    "naive": _("as if all histories were independent"),
    "few_clusters": _("fewer than three clusters of records"),
    "one_cluster": _("one cluster of records determines the curve"),
    "few_walls": _("two walls: at least three are needed for the spread between walls"),
    "one_wall": _("without one of the walls no curve can be fitted"),
    "given": _("the parameters were given"),
}


def facts_of(curve: Fragility) -> list[tuple[str, str]]:
    """What is shown of a curve, name and text."""
    unit = blank_unit(curve.im)
    what = [("wall", curve.wall.name)] if curve.wall is not None else []
    what += [("measure", curve.im)] if curve.im else []
    what += [("EDP threshold", f"{curve.edp_threshold:g}")] if curve.edp_threshold is not None else []
    if not curve.has_fit:
        text = bracket_in_words(curve).removeprefix("the median lies ")
        return [*what, ("status", curve.status), *([("median", text)] if text else [])]
    ends = [("upper_asymptote", f"{curve.upper_asymptote:.6g}")] if curve.upper_asymptote < 1.0 else []
    return [
        *what,
        ("theta", f"{curve.theta:.6g}{unit}" + shown_error("standard error of ln theta", curve.se_ln_theta)),
        ("beta", f"{curve.beta:.6g}" + shown_error("standard error", curve.se_beta)),
        ("standard errors", errors_in_words(curve) if curve.has_errors else f"none: {errors_in_words(curve)}"),
        *ends,
        *([("log likelihood", f"{curve.log_likelihood:.6g}")] if math.isfinite(curve.log_likelihood) else []),
        ("status", curve.status),
    ]


def bracket_in_words(curve: LognormalCurve, before: str = "") -> str:
    """Where the median lies; nothing where that is not known, as where fractions fall with the level."""
    low, high = curve.bracket
    if low >= high:
        return ""
    return f"{before}the median lies between {low:g} and {high:g}{blank_unit(curve.im)}"


def errors_in_words(curve: LognormalCurve) -> str:
    """What the standard errors are, in words."""
    if curve.errors == "clustered":
        kinds = say(" and ").join(
            say("{walls} walls", walls=len(part.labels))
            if part.kind == "walls"
            else say("{clusters} clusters of {kind}", clusters=len(part.labels), kind=say(part.kind))
            for part in curve.parts
        )
        return kinds or say("{clusters} clusters of {kind}", clusters=curve.clusters, kind=say("records"))
    return say(WHY_NO_ERRORS[curve.errors])


def shown_error(what: str, error: float) -> str:
    """The standard error of a parameter in brackets; nothing where there is none."""
    return f" ({what} {error:.3g})" if np.isfinite(error) else ""
