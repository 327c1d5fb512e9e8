"""Languages of a document: sentences from the catalogues of gettext, decimal marks and dates.

Sentences of the sources are English. Catalogues are ``locale/LANGUAGE.po``, compiled when the package is built.
"""

from __future__ import annotations

import gettext
import os
from contextlib import AbstractContextManager
from datetime import datetime
from importlib import resources
from typing import Any

from dondolo._base.arguments import one_of
from dondolo._base.wording import ENGLISH, Wording, in_words_of, named
from dondolo.errors import DondoloError
from dondolo.reporting.content import MONTHS, Symbol, in_places
from dondolo.reporting.numerals import Numeral

LANGUAGES = ("en", "it")


class Language:
    """A language of documents.

    Parameters
    ----------
    code : {'en', 'it'}, optional
        That of the environment variable ``DONDOLO_LANG`` if left out, or English.
    name : str
        Name of the argument, for messages.
    """

    def __init__(self, code: str | None = None, name: str = "lang") -> None:
        given, name = (os.environ.get("DONDOLO_LANG", "en"), "DONDOLO_LANG") if code is None else (code, name)
        given = given.lower() if isinstance(given, str) else given
        one_of(name, given, LANGUAGES)
        self.code = given
        self._catalogue = gettext.NullTranslations()
        if self.code != "en":
            compiled = resources.files("dondolo.reporting") / "locale" / f"{self.code}.mo"
            try:
                with compiled.open("rb") as file:
                    self._catalogue = gettext.GNUTranslations(file)
            except OSError as error:
                raise DondoloError(f"lang = {self.code!r}: its catalogue cannot be read: {error.strerror}") from None

    @property
    def wording(self) -> Wording:
        """Its sentences and its decimal mark."""
        return ENGLISH if self.code == "en" else Wording(self._catalogue.gettext, self.decimal("."))

    def in_force(self) -> AbstractContextManager[None]:
        """Say the sentences of all rooms in this language until the end of a block."""
        return in_words_of(self.wording)

    def text(self, sentence: str, **values: object) -> str:
        """A sentence, with values in the places that it names."""
        found = self._catalogue.gettext(sentence)
        return found.format(**values) if values else found

    def named(self, what: str, name: str, english: str | None = None) -> str:
        """What has a name, as `dondolo._base.wording.named`."""
        with self.in_force():
            return named(what, name, english)

    def all_named(self, what: str) -> dict[str, str]:
        """All that the catalogue has of a kind, by their names; nothing in English."""
        # Python's gettext has no other way to list a catalogue.
        entries: dict[str, str] = getattr(self._catalogue, "_catalog", {})
        context = f"{what}\4"
        return {key.removeprefix(context): text for key, text in entries.items() if key.startswith(context)}

    def pieces(self, sentence: str, **values: Any) -> tuple[Any, ...]:
        """A sentence as pieces: numbers, symbols and fields stay what they are in the places that it names."""
        return in_places(self._catalogue.gettext(sentence), values)

    def decimal(self, text: str) -> str:
        """The digits of a number with the decimal mark of the language."""
        return text.replace(".", ",") if self.code == "it" else text

    def plain(self, piece: Any) -> str:
        """A piece as characters, for labels of figures and descriptions of them."""
        if isinstance(piece, Numeral):
            return self.decimal(piece.text) + (f"·10^{piece.power}" if piece.power else "") + piece.unit
        if isinstance(piece, Symbol):
            index = f"_{self.text(piece.index)}" if piece.index else ""
            return f"{piece.letter}{index}{piece.mark}"
        return "".join(map(self.plain, piece)) if isinstance(piece, tuple) else str(getattr(piece, "text", piece))

    def date(self, moment: datetime) -> str:
        """A date in words."""
        return f"{moment.day} {self.text(MONTHS[moment.month - 1])} {moment.year}"
