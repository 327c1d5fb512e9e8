"""Chapters of a report on a wall whose properties are not known for certain."""

from __future__ import annotations

import numpy as np

from dondolo._base.wording import say
from dondolo.populations.uncertain_wall import UncertainWall
from dondolo.reporting.blocks import Block, Cards, Facts, Picture
from dondolo.reporting.columns import shown, source_name
from dondolo.reporting.content import BETA, THETA, Pairs, Piece, Symbol, level, pieces
from dondolo.reporting.numerals import number
from dondolo.reporting.parts import captioned, paragraph


def summary(found: UncertainWall) -> list[Block]:
    """The main numbers of the wall."""
    of_model = pieces("dispersion of the model, standard deviation of ln {theta}", theta=THETA)
    cards: list[tuple[Piece, Piece, Piece]] = [
        (pieces("median {theta}", theta=THETA), level(found.theta, found.im), say("geometric mean of the variants")),
        (Symbol("β", "model"), number(found.beta_model, 3), of_model),
        (Symbol("β", "records"), number(found.beta_records, 3), say("dispersion between records")),
        (Symbol("β", "total"), number(found.beta_total, 3), say("both together")),
    ]
    return [Cards(tuple(cards))]


def model(found: UncertainWall) -> list[Block]:
    """What the curve owes to each source."""
    facts: Pairs = [
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
    beginning = say(
        "Uncertain properties of this wall have distributions. The sampled walls are shaken by the same records, so"
        " that the scatter of their medians is due to the model alone. The dispersions add in squares."
    )
    caption = say(
        "Left: curves of the sample and their mean, and with all sources at their medians the curve with the band of"
        " other records. Right: the median with one source at its 5 and 95 % fractiles, all others at their medians,"
        " and its 95 % interval for other records; beside the bars, the part of the variance of ln θ due to a source,"
        " alone or with others."
    )
    of_sources = say(
        "Sources: values at the fractiles, medians there, and first-order and total Sobol indices with their 95 %"
        " intervals."
    )
    of_indices = (
        say(
            "The first-order index is the part of the variance of ln θ in the sample that a source explains alone; the"
            " total index has its products with others too."
        )
        if np.isfinite(found.total).all()
        else say("There are no indices: too few variants have a curve.")
    )
    return [
        paragraph(beginning),
        Facts(tuple(facts)),
        Picture(found.plot, caption, alt),
        captioned(shown(found._table(), found.im), of_sources),
        paragraph(of_indices),
    ]
