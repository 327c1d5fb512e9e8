"""Chapter of a report on what histories do to ties."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

import numpy as np

from dondolo._base.arguments import FloatArray
from dondolo._base.wording import say
from dondolo.analysis.stripes import Stripes
from dondolo.populations.typology import Typology
from dondolo.reporting.blocks import Block
from dondolo.reporting.content import Piece, Table, level_unit
from dondolo.reporting.numerals import number, percent
from dondolo.reporting.parts import captioned, paragraph
from dondolo.walls.ties import number_of_ties, ties_of
from dondolo.walls.wall import Wall

# What sentences that are said elsewhere are marked by for the catalogues
_ = str
# Columns of levels of a table: what fits across a page
_ACROSS = 10


def ties(results: Typology | Stripes) -> list[Block]:
    """Shares of the histories that stretch each tie for good, and that break it; none without ties, or if not known."""
    if isinstance(results, Stripes):
        if not number_of_ties(results.wall):
            return []
        runs, ties_ = results.histories[:, None], results.ties
        return _tables((results.wall,), results, (ties_.yielded / runs,), (ties_.broken / runs,))
    if results.ties is None or not any(map(number_of_ties, results.walls)):
        return []
    histories = results.histories.T.astype(np.float64)
    yielded = [own.yielded / runs[:, None] for own, runs in zip(results.ties, histories, strict=True)]
    return _tables(results.walls, results, yielded, results.broken_ties)


def _tables(
    walls: Iterable[Wall], results: Typology | Stripes, yielded: Sequence[FloatArray], broken: Sequence[FloatArray]
) -> list[Block]:
    """Tables with a row a tie and a column a level, as many as a page is wide."""
    names = [
        say("{wall}, tie {number} at {height:g} m", wall=wall.name, number=number, height=tie.height)
        for wall in walls
        for number, tie in enumerate(ties_of(wall), 1)
    ]
    beginning = say(
        "A tie with a plastic elongation has yielded; a broken tie no longer holds. Both are counted at the end of each"
        " history."
    )
    blocks: list[Block] = [paragraph(beginning)]
    stretched = _("Share of the histories that stretch each tie for good, {levels}.")
    for sentence, shares in (
        (stretched, yielded),
        (_("Share of the histories that break each tie, {levels}."), broken),
    ):
        rows = np.hstack(shares)
        for first in range(0, len(results.levels), _ACROSS):
            columns: dict[Piece, Sequence[Piece]] = {say("tie"): names}
            for place in range(first, min(first + _ACROSS, len(results.levels))):
                columns[number(results.levels[place], unit=f" {level_unit(results.im)}")] = list(
                    map(percent, rows[place])
                )
            last = results.levels[min(first + _ACROSS, len(results.levels)) - 1]
            span = say(
                "levels {first:g} to {last:g} {unit}",
                first=results.levels[first],
                last=last,
                unit=level_unit(results.im),
            )
            blocks.append(captioned(Table.of(columns), say(sentence, levels=span)))
    return blocks
