"""Styles of figures: that of the screen, and that of journals."""

from __future__ import annotations

from collections.abc import Mapping
from contextlib import AbstractContextManager
from dataclasses import dataclass, field, replace
from types import MappingProxyType
from typing import Any

from dondolo._base.arguments import argument_error, as_number, one_of
from dondolo._base.wording import ENGLISH, Wording

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
    """A style: settings of Matplotlib, sizes of letters [pt], width [mm], whether panels have letters, and language."""

    rc: Mapping[Any, Any] = field(default_factory=lambda: MappingProxyType(_SCREEN))
    legend: float = 8.5
    note: float = 7.5
    width: float | None = None
    letters: bool = False
    wording: Wording = ENGLISH


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


def put_style(name: str, width: float | None, wording: Wording) -> AbstractContextManager[None]:
    """Choose the style of figures: see `dondolo.style`."""
    one_of("style", name, _THEMES)
    chosen = replace(_THEMES[name], wording=wording)
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
