"""Styles of figures: that of the screen, and that of journals."""

from __future__ import annotations

from collections.abc import Mapping
from contextlib import AbstractContextManager
from dataclasses import dataclass, field, replace
from types import MappingProxyType
from typing import Any

from dondolo._base.arguments import argument_error, as_number, one_of

# Widths of a column of a journal, and of its page, are 88 and 180 mm; a page is not higher than this [mm].
COLUMN = 88.0
PAGE = 230.0

_SCREEN: dict[Any, Any] = {
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "grid.color": "#E6E6E6",
    "grid.linewidth": 0.6,
    "axes.axisbelow": True,
    "font.size": 9.5,
    "axes.titlesize": 10.5,
    "legend.frameon": False,
    "legend.fontsize": 8.5,
    "figure.dpi": 110.0,
    "savefig.dpi": 110,
    "savefig.bbox": "tight",
    "lines.linewidth": 1.4,
}
_JOURNAL: dict[Any, Any] = _SCREEN | {
    # Fonts embedded as TrueType: journals refuse Type 3, which is Matplotlib's default.
    "pdf.fonttype": 42,
    "ps.fonttype": 42,
    "font.size": 8.0,
    "axes.titlesize": 8.0,
    "axes.labelsize": 8.0,
    "xtick.labelsize": 7.0,
    "ytick.labelsize": 7.0,
    "legend.fontsize": 7.0,
    "axes.linewidth": 0.6,
    "grid.linewidth": 0.4,
    "lines.linewidth": 1.2,
    "hatch.linewidth": 0.5,
    "savefig.dpi": 600,
    # A figure is as wide in the file as it was made.
    "savefig.bbox": None,
}


@dataclass(frozen=True)
class Theme:
    """A style: settings of Matplotlib, sizes of letters [pt], width [mm], and whether panels have letters."""

    rc: Mapping[Any, Any] = field(default_factory=lambda: MappingProxyType(_SCREEN))
    legend: float = 8.5
    note: float = 7.5
    width: float | None = None
    letters: bool = False


_THEMES = {
    "screen": Theme(),
    "journal": Theme(rc=MappingProxyType(_JOURNAL), legend=7.0, note=6.5, width=COLUMN, letters=True),
}


@dataclass
class _State:
    """The style that is in force, and the settings of Matplotlib that it replaced."""

    theme: Theme
    replaced: dict[str, Any]


_state = _State(_THEMES["screen"], {})


def theme() -> Theme:
    """The style in force."""
    return _state.theme


class _Style(AbstractContextManager[None]):
    """A style in force; as a context manager it ends with its block."""

    def __init__(self, before: _State) -> None:
        self._before = before

    def __exit__(self, *error: object) -> None:
        _put(self._before.theme, is_journal=bool(self._before.replaced))


def style(name: str = "screen", *, width: float | None = None) -> AbstractContextManager[None]:
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

    Returns
    -------
    context manager
        Ends the style where its block ends. Without `with` the style is in force until the next call.

    Raises
    ------
    InputError
        There is no such style, or no such width.

    Examples
    --------
    >>> import dondolo as dd
    >>> curve = dd.fit_fragility([0.2, 0.4], [11, 33], 44, im="pga")
    >>> with dd.style("journal", width=88):
    ...     ax = curve.plot(title=False)
    ...     ax.figure.savefig("curve.pdf")
    """
    one_of("style", name, _THEMES)
    chosen = _THEMES[name]
    if width is not None:
        # Below 40 mm the text of 7 pt leaves no room for curves.
        if not 40.0 <= (wide := as_number("width", width)) <= 1000.0:
            raise argument_error("out_of_range", "width", f" = {wide:g}: must lie between 40 and 1000 mm")
        chosen = replace(chosen, width=wide)
    before = replace(_state)
    _put(chosen, is_journal=name == "journal")
    return _Style(before)


def _put(chosen: Theme, *, is_journal: bool) -> None:
    """Put a style in force: settings of Matplotlib, or those that a user has."""
    import matplotlib as mpl

    settings: Any = mpl.rcParams
    if is_journal and not _state.replaced:
        _state.replaced = {key: settings[key] for key in _JOURNAL}
    settings.update(chosen.rc if is_journal else _state.replaced)
    if not is_journal:
        _state.replaced = {}
    _state.theme = chosen
