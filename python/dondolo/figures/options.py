"""Options that the figures of all results share: parts to leave out, and keywords of Matplotlib."""

from __future__ import annotations

from typing import Any

from dondolo._base.arguments import argument_error
from dondolo.errors import InputError

# Parts of figures by the names of their options. docs/printing.md describes them.
PARTS = ("legend", "title", "band", "bars", "points", "counts")


class Options:
    """What a user wants of a figure.

    Parameters
    ----------
    given : dict
        Options of a method `plot`: `legend`, `title` and parts of the figure by their names, all drawn if left out; the
        rest are keywords of Matplotlib.
    parts : str
        Which of `PARTS` the figure has, besides legend and title.

    Raises
    ------
    InputError
        The figure has no such part, or whether to draw it is neither True nor False.
    """

    def __init__(self, given: dict[str, Any], *parts: str) -> None:
        known = ("legend", "title", *parts)
        for name in PARTS:
            if name in given and name not in known:
                raise argument_error("unknown_name", name, f": this figure has none; its parts are {', '.join(known)}")
            value = given.get(name, True)
            if not isinstance(value, bool) and not (name == "title" and isinstance(value, str)):
                kinds = "True, False or a title" if name == "title" else "True or False"
                raise InputError(f"{name} = {value!r}: must be {kinds}")
        self.legend, self.band, self.bars, self.points, self.counts = (
            bool(given.get(name, True)) for name in PARTS if name != "title"
        )
        self._title: bool | str = given.get("title", True)
        self._keywords = {name: value for name, value in given.items() if name not in PARTS}

    def title(self, own: str) -> str:
        """The title: that of the figure, a user's, or none."""
        return self._title if isinstance(self._title, str) else own if self._title else ""

    def look(self, kind: Any = None, **own: Any) -> dict[str, Any]:
        """How the main artists of a figure look: its own way, changed by the keywords of a user."""
        return own | self._normal(kind)

    def has(self, name: str) -> bool:
        """Did a user give a keyword of lines?"""
        return name in self._normal(None)

    def _normal(self, kind: Any) -> dict[str, Any]:
        """Keywords by their long names: lw is linewidth."""
        from matplotlib.cbook import normalize_kwargs
        from matplotlib.lines import Line2D

        normal: dict[str, Any] = normalize_kwargs(self._keywords, kind or Line2D)
        return normal
