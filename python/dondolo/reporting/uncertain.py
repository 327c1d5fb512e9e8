"""Facts of a report on a wall whose properties are not known for certain."""

from __future__ import annotations

from typing import Any

import numpy as np

from dondolo._base.wording import say
from dondolo.populations.uncertain_wall import UncertainWall
from dondolo.reporting.columns import shown, source_name
from dondolo.reporting.content import BETA, THETA, Facts, Piece, Symbol, figure, level, pieces
from dondolo.reporting.numerals import number


def summary(found: UncertainWall) -> dict[str, Any]:
    """The main numbers of the wall."""
    of_model = pieces("dispersion of the model, standard deviation of ln {theta}", theta=THETA)
    cards: list[tuple[Piece, Piece, Piece]] = [
        (pieces("median {theta}", theta=THETA), level(found.theta, found.im), say("geometric mean of the variants")),
        (Symbol("β", "model"), number(found.beta_model, 3), of_model),
        (Symbol("β", "records"), number(found.beta_records, 3), say("dispersion between records")),
        (Symbol("β", "total"), number(found.beta_total, 3), say("both together")),
    ]
    return {"cards": cards, "shares": []}


def model(found: UncertainWall) -> dict[str, Any]:
    """What the curve owes to each source."""
    facts: Facts = [
        (pieces("median {theta} of the sample", theta=THETA), level(found.theta, found.im)),
        (pieces("{beta} of the model", beta=BETA), number(found.beta_model, 3)),
        (pieces("{beta} of the records", beta=BETA), number(found.beta_records, 3)),
        (pieces("{beta} of both", beta=BETA), number(found.beta_total, 3)),
        (pieces("{theta} of the wall as given", theta=THETA), level(found.as_given.theta, found.im)),
        (pieces("{theta} with all sources at their medians", theta=THETA), level(found.at_medians.theta, found.im)),
        (say("variants"), str(len(found.sample))),
    ]
    spans = zip(found.sources, found.ends, strict=True)
    words = "; ".join(
        say("{source}: {low:.3g} to {high:.3g}", source=source_name(name), low=low.theta, high=high.theta)
        for name, (low, high) in spans
    )
    alt = say(
        "Curves of the variants, and what moves their median, with each source at its fractiles: {words}.", words=words
    )
    return {
        "facts": facts,
        "figure": figure(found.plot, alt),
        "sources": shown(found._table(), found.im),
        "has_indices": bool(np.isfinite(found.total).all()),
    }
