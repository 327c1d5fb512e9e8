"""Facts of a report on a wall whose properties are not known for certain."""

from __future__ import annotations

from typing import Any

import numpy as np

from dondolo.populations.uncertain_wall import UncertainWall
from dondolo.reporting.columns import shown
from dondolo.reporting.content import BETA, THETA, Facts, Piece, Symbol, figure, level
from dondolo.reporting.numerals import number


def summary(found: UncertainWall) -> dict[str, Any]:
    """The main numbers of the wall."""
    of_model = ("dispersion of the model, standard deviation of ln ", THETA)
    cards: list[tuple[Piece, Piece, Piece]] = [
        (("median ", THETA), level(found.theta, found.im), "geometric mean of the variants"),
        (Symbol("β", "model"), number(found.beta_model, 3), of_model),
        (Symbol("β", "records"), number(found.beta_records, 3), "dispersion between records"),
        (Symbol("β", "total"), number(found.beta_total, 3), "both together"),
    ]
    return {"cards": cards, "shares": []}


def model(found: UncertainWall) -> dict[str, Any]:
    """What the curve owes to each source."""
    facts: Facts = [
        (("median ", THETA, " of the sample"), level(found.theta, found.im)),
        ((BETA, " of the model"), number(found.beta_model, 3)),
        ((BETA, " of the records"), number(found.beta_records, 3)),
        ((BETA, " of both"), number(found.beta_total, 3)),
        ((THETA, " of the wall as given"), level(found.as_given.theta, found.im)),
        ((THETA, " with all sources at their medians"), level(found.at_medians.theta, found.im)),
        ("variants", str(len(found.sample))),
    ]
    spans = zip(found.sources, found.ends, strict=True)
    words = "; ".join(f"{name}: {low.theta:.3g} to {high.theta:.3g}" for name, (low, high) in spans)
    alt = f"Curves of the variants, and what moves their median, with each source at its fractiles: {words}."
    return {
        "facts": facts,
        "figure": figure(found.plot, alt),
        "sources": shown(found._table(), found.im),
        "has_indices": bool(np.isfinite(found.total).all()),
    }
