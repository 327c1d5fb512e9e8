"""What several chapters of a report are made of: paragraphs, tables of the first rows, states that cross."""

from __future__ import annotations

from typing import Any, Literal

from dondolo._base.wording import say
from dondolo.reporting.blocks import Block, CaptionedTable, Paragraph
from dondolo.reporting.content import Table

# Rows of a table that are written; what is left out is said
ROWS = 500


def paragraph(*sentences: str | tuple[Any, ...], look: Literal["", "lead", "footnote"] = "") -> Paragraph:
    """A paragraph of sentences, or of sentences in pieces."""
    parts = [part for sentence in sentences for part in (" ", sentence)]
    return Paragraph(tuple(parts[1:]), look)


def captioned(table: Table, caption: str) -> CaptionedTable:
    """A table with its caption; of a long one the first rows, and how many there are."""
    if table.total > ROWS:
        words = say("First {shown} of {total} rows; all are in the result files.", shown=ROWS, total=table.total)
        table, caption = table.first(ROWS), f"{caption} {words}"
    return CaptionedTable(table, caption)


def crossing_states(table: Table | None, advice: str) -> list[Block]:
    """Damage states that cross, and what to do; nothing if there are none."""
    if table is None:
        return []
    words = say(
        "The curves of the damage states are fitted each on its own, and cross: a more severe state seems more probable"
        " than a less severe one, which cannot be. Where they do the larger of both probabilities is on the safe side."
    )
    return [paragraph(words, advice), captioned(table, say("Damage states that cross."))]


def on_lognormal_curves() -> str:
    """What a fragility curve is."""
    return say(
        "The curve is P(C | IM = x) = Φ(ln(x/θ)/β), Φ the standard normal distribution: θ is the median, the level at"
        " which the probability is one half, and β the dispersion, the standard deviation of ln IM at collapse. Where"
        " mechanisms may not occur it is that of the walls that can collapse, times their share."
    )
