"""The style of figures, with the language of their words, whose catalogues are here."""

from __future__ import annotations

from contextlib import AbstractContextManager

from dondolo.figures.themes import put_style
from dondolo.reporting.language import Language


def style(name: str = "screen", *, width: float | None = None, language: str = "en") -> AbstractContextManager[None]:
    """Choose the style of figures: at once, or for a block if used as a context manager.

    In the style 'journal' all text has its size in points (8, in legends and at ticks 7), PDF and PostScript embed
    their fonts as TrueType, panels have the letters (a), (b), (c), and a file is as wide as its figure. Your own axes
    have the same settings; save a figure while the style is in force. In every style a mechanism has one colour, and
    dashes tell curves apart in grey.

    Parameters
    ----------
    name : {'screen', 'journal'}
        The style; 'screen' is the one that dondolo begins with.
    width : float, optional
        Width of new figures [mm]: 88 and 180 are usual for a column and a page. 88 in the style 'journal' if left out;
        on the screen each figure has a width of its own.
    language : {'en', 'it'}
        Language of new figures, and their decimal mark. Names, and what a figure gets as a title or a label, stay.

    Returns
    -------
    context manager
        Ends the style where its block ends. Without `with` the style is in force until the next call.

    Raises
    ------
    InputError
        There is no such style, width or language.

    Examples
    --------
    >>> import dondolo as dd
    >>> curve = dd.fit_fragility([0.2, 0.4], [11, 33], 44, im="pga")
    >>> with dd.style("journal", width=88):
    ...     ax = curve.plot(title=False)
    ...     ax.figure.savefig("curve.pdf")
    """
    return put_style(name, width, Language(language, "language").wording)
