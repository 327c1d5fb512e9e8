"""Languages of a document: sentences from the catalogues of gettext, decimal marks and dates.

Sentences of the sources are English. Catalogues are ``locale/LANGUAGE.po``, compiled when the package is built.
"""

from __future__ import annotations

import gettext
import os
import re
from datetime import datetime
from importlib import resources
from typing import Any

from dondolo._base.arguments import one_of
from dondolo.errors import DondoloError
from dondolo.reporting.content import Symbol
from dondolo.reporting.numerals import Numeral

LANGUAGES = ("en", "it")
_PLACE = re.compile(r"\{(\w+)\}")
_MONTHS = {
    "en": "January February March April May June July August September October November December",
    "it": "gennaio febbraio marzo aprile maggio giugno luglio agosto settembre ottobre novembre dicembre",
}


class Language:
    """A language of documents.

    Parameters
    ----------
    code : {'en', 'it'}, optional
        That of the environment variable ``DONDOLO_LANG`` if left out, or English.
    """

    def __init__(self, code: str | None = None) -> None:
        given, name = (os.environ.get("DONDOLO_LANG", "en"), "DONDOLO_LANG") if code is None else (code, "lang")
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

    def text(self, sentence: str, **values: object) -> str:
        """A sentence, with values in the places that it names."""
        found = self._catalogue.gettext(sentence)
        return found.format(**values) if values else found

    def pieces(self, sentence: str, **values: Any) -> tuple[Any, ...]:
        """A sentence as pieces: numbers, symbols and fields stay what they are in the places that it names."""
        parts = _PLACE.split(self._catalogue.gettext(sentence))
        return tuple(values[part] if place % 2 else part for place, part in enumerate(parts) if part)

    def decimal(self, text: str) -> str:
        """The digits of a number with the decimal mark of the language."""
        return text.replace(".", ",") if self.code == "it" else text

    def plain(self, piece: Any) -> str:
        """A piece as characters, for labels of figures and descriptions of them."""
        if isinstance(piece, Numeral):
            return self.decimal(piece.text) + (f"·10^{piece.power}" if piece.power else "") + piece.unit
        if isinstance(piece, Symbol):
            return f"{piece.letter}{'_' if piece.index else ''}{piece.index}{piece.mark}"
        return "".join(map(self.plain, piece)) if isinstance(piece, tuple) else str(getattr(piece, "text", piece))

    def date(self, moment: datetime) -> str:
        """A date in words."""
        return f"{moment.day} {_MONTHS[self.code].split()[moment.month - 1]} {moment.year}"
