"""A calculation report as it is made: its language, its project, its walls, and what chapters share."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from dondolo._fortran.checks import SheetRow
from dondolo.reporting.blocks import Block, CaptionedTable, Field, Paragraph
from dondolo.reporting.content import Piece, Table
from dondolo.reporting.language import Language
from dondolo.reporting.relazione.project import Project
from dondolo.reporting.relazione.subjects import Subject, Subjects
from dondolo.reporting.relazione.terms import ITEMS, MEANINGS

# What sentences of the chapters are marked by for the catalogues
_ = str


@dataclass(frozen=True)
class Document:
    """What chapters are written of and in.

    Attributes
    ----------
    language : Language
    project : Project
    subjects : Subjects
    """

    language: Language
    project: Project
    subjects: Subjects

    def text(self, sentence: str, **values: object) -> str:
        """A sentence in the language of the document."""
        return self.language.text(sentence, **values)

    def say(self, sentence: str, **values: Any) -> Paragraph:
        """A paragraph."""
        return Paragraph(self.language.pieces(sentence, **values))

    def field(self, key: str, prompt: str) -> Field:
        """What the engineer has to write."""
        return Field(key, self.text(_("[TO BE COMPLETED: {what}]"), what=self.text(prompt)))

    def written(self, key: str, prompt: str) -> list[Block]:
        """Paragraphs of the engineer, or the prompt for them."""
        if key not in self.project.texts:
            return [Paragraph((self.field(key, prompt),))]
        return [Paragraph((part.strip(),)) for part in self.project.texts[key].split("\n\n") if part.strip()]

    def word(self, key: str, prompt: str) -> Piece | Field:
        """A word of the engineer, or the prompt for it."""
        return self.project.words.get(key) or self.field(key, prompt)

    @cached_property
    def names(self) -> tuple[str, ...]:
        """Names of the walls: their states, or the mechanisms of a facade."""
        several = self.subjects.several
        if self.subjects.facade or len(several) == 1:
            return tuple(one.wall.name for one in several)
        states = [self.text(_("as it stands"))]
        many = len(several) - 1
        for number in range(1, many + 1):
            states.append(self.text(_("design {number}"), number=number) if many > 1 else self.text(_("design")))
        return tuple(
            state if one.wall.name.casefold() == state.casefold() else f"{state} ({one.wall.name})"
            for state, one in zip(states, several, strict=True)
        )

    @property
    def has_one_hazard(self) -> bool:
        """Whether one a_g serves all limit states."""
        return np.size(self.subjects.several[0].check.site.ag) == 1

    def state(self, name: str) -> str:
        """A limit state; of SLC it is said if it has no hazard of its own."""
        return self.text(_("SLC (hazard not its own)")) if name == "SLC" and self.has_one_hazard else name

    def titled(self, what: str, name: str) -> str:
        """A caption, with the wall if there are several."""
        return f"{what}: {name}." if len(self.names) > 1 else f"{what}."

    def beside(self, head: str, rows: Sequence[tuple[Piece, Sequence[Piece]]], caption: str) -> CaptionedTable:
        """A table with a column for each wall."""
        columns: dict[Piece, Sequence[Piece]] = {head: [name for name, _ in rows]}
        for place, name in enumerate(self.names):
            columns[name] = [cells[place] for _, cells in rows]
        return CaptionedTable(Table.of(columns), caption)

    def each(self) -> list[tuple[str, Subject]]:
        """Names and walls."""
        return list(zip(self.names, self.subjects.several, strict=True))

    def meaning(self, row: SheetRow) -> str:
        """A quantity of the sheet in words."""
        if self.language.code == "en":
            # What the numbers of a verdict mean is of no use where there are words.
            words = row.meaning.partition(";")[0].removeprefix("1: ").removeprefix("0: ")
            return self.text(_("outcome")) if row.quantity == "verified" else words.partition(", 0: ")[0]
        return MEANINGS.get(row.quantity, row.quantity).partition(":")[0]

    def unit(self, name: str) -> str:
        """A unit in the language of the document."""
        return self.text(_("years")) if name == "years" else name

    def item(self, name: str) -> str:
        """An item of the calculation, such as 'load 1', in words."""
        if self.language.code == "en":
            return name
        word, _, number = name.rpartition(" ")
        return f"{ITEMS[word]} {number}" if word in ITEMS else ITEMS.get(name, name)
