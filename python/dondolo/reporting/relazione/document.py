"""A calculation report as it is made: its language, its project, its walls, and what chapters share."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from dondolo._fortran.checks import SheetRow
from dondolo.reporting import numerals
from dondolo.reporting.blocks import Block, CaptionedTable, Field, Paragraph, symbol_of
from dondolo.reporting.content import Piece, Table
from dondolo.reporting.language import Language
from dondolo.reporting.relazione.project import Project
from dondolo.reporting.relazione.subjects import Subject, Subjects
from dondolo.reporting.words import item_in_words, the_item_in_words
from dondolo.reporting.writers.imprint import Imprint

# What sentences of the chapters are marked by for the catalogues
_ = str
# Height that a figure may have in Word [cm]
_TALLEST = 6.0
# Accelerations of demand, with their symbols on the ground and on a floor
_DEMANDS = {
    "floor_pga": (_("peak acceleration"), "a_g S", "a_Z"),
    "spectral_demand": (_("spectral acceleration"), "S_e", "S_eZ"),
}


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

    def imprint(self, mark: str) -> Imprint:
        """What the document says of itself, with the mark by which dondolo knows it."""
        words = self.project.words
        return Imprint(
            self.language,
            mark,
            self.text(_("Calculation report")),
            author=words.get("designer", ""),
            work=words.get("work", ""),
            place=words.get("place", ""),
            revision=words.get("revision", "0"),
            keywords="NTC 2018, C8.7.1.2.1",
            is_for_paper=True,
            tallest=_TALLEST,
        )

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
        """Names of the walls: their states, or the mechanisms of a facade or a building."""
        several = self.subjects.several
        if self.subjects.are_mechanisms or len(several) == 1:
            names = [one.wall.name for one in several]
            # Columns are known by their names
            return tuple(name if names.count(name) == 1 else f"{name} ({place})" for place, name in enumerate(names, 1))
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
        return len(self.subjects.several[0].check.site.hazard.ag) == 1

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

    def meaning(self, row: SheetRow) -> Piece:
        """A quantity of the sheet in words; of an acceleration of demand whether it is the ground's or a floor's."""
        if row.quantity in _DEMANDS and (where := self._where):
            words, ground, floor = _DEMANDS[row.quantity]
            is_on_floor = any(one.is_on_floor for one in self.subjects.several)
            return (f"{self.text(words)} ", symbol_of(floor if is_on_floor else ground), f" ({where})")
        # Forces of whole bodies have the names of those per metre.
        is_whole = row.quantity.endswith("_per_m") and not row.unit.endswith("/m")
        if self.language.code == "en":
            # What the numbers of a verdict mean is of no use where there are words.
            words = row.meaning.partition(";")[0].removeprefix("1: ").removeprefix("0: ")
            words = words.removesuffix(" per metre of wall").removesuffix(",") if is_whole else words
            return self.text(_("outcome")) if row.quantity == "verified" else words.partition(", 0: ")[0]
        words = self.language.named("quantity of a check", row.quantity).partition(":")[0]
        return words.removesuffix(self.text(_(", per metre"))) if is_whole else words

    @property
    def _where(self) -> str:
        """Whose the demand of all walls is; '' where it is not of one place."""
        found = {self._place_of(one) for one in self.subjects.several}
        return found.pop() if len(found) == 1 else ""

    def _place_of(self, one: Subject) -> str:
        """Where the demand of a wall is."""
        if not one.is_on_floor:
            return self.text(_("on the ground"))
        level = one.check._row("mechanism", "", "level")
        if level is None:
            return self.text(_("on a floor of the building"))
        return self.text(_("level z = {level}"), level=self.language.plain(numerals.number(level.value, 4, " m")))

    def unit(self, name: str) -> str:
        """A unit in the language of the document."""
        return self.text(_("years")) if name == "years" else name

    def item(self, name: str) -> str:
        """An item of the calculation, such as 'load 1', in words."""
        with self.language.in_force():
            return item_in_words(name)

    def the_item(self, name: str) -> str:
        """An item within a sentence: in Italian with its article."""
        with self.language.in_force():
            return the_item_in_words(name)
