"""One style for all figures: colours that colour-blind eyes tell apart; shape and lightness tell them apart in grey."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from dondolo._fortran.records import describe_measure
from dondolo.errors import InputError

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.axis import Axis

# Several axes of one figure
Panels = NDArray[np.object_]

# Okabe and Ito (2008), Color universal design
BLUE = "#0072B2"
RED = "#D55E00"
PURPLE = "#CC79A7"
BLACK = "#000000"
GREY = "#8C8C8C"
LIGHT = "#D9D9D9"
BRICK = "#E8C9A8"

_DPI = 110.0

# Mark of what a legend explains besides lines
_NOTE = "note"

RC: dict[Any, Any] = {
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
    "figure.dpi": _DPI,
    "savefig.dpi": 160,
    "savefig.bbox": "tight",
    "lines.linewidth": 1.4,
}


def im_label(im: str) -> str:
    """Axis label of an intensity measure: words and unit of those that dondolo knows."""
    try:
        measure = describe_measure(im)
    except InputError:
        return im if im else "intensity measure"
    return f"{measure.title} [{measure.unit or '-'}]"


def mechanism_name(mechanism: str) -> str:
    """A mechanism in words."""
    return "all mechanisms" if mechanism == "all" else mechanism.replace("_", "-")


def counted(number: int, noun: str) -> str:
    """How many: 1 wall, 2 walls."""
    return f"{number} {noun}{'' if number == 1 else 's'}"


def label(text: str) -> str:
    """A label that begins with what a user wrote: Matplotlib leaves those that begin with '_' out of legends."""
    return f" {text}" if text.startswith("_") else text


def new_axes(rows: int = 1, size: tuple[float, float] = (6.0, 4.0), columns: int = 1, **options: Any) -> Any:
    """Axes of a new figure in the style of dondolo."""
    import matplotlib.pyplot as plt

    # Not within rc_context: the first figure of a session chooses the backend, which turns interactive mode on, and
    # leaving the context would turn it off again. Without it a notebook shows no further figure.
    figure = plt.figure(figsize=size, dpi=_DPI, layout="constrained")
    with plt.rc_context(RC):
        return figure.subplots(rows, columns, **options)


def axes(ax: Axes | None, size: tuple[float, float] = (6.0, 4.0)) -> Axes:
    """The axes given, or those of a new figure."""
    if ax is None:
        return new_axes(size=size)  # type: ignore[no-any-return]
    one: Axes = panels([ax], 1, size)[0]
    return one


def panels(ax: Iterable[Axes] | None, rows: int, size: tuple[float, float], columns: int = 1, **options: Any) -> Panels:
    """The axes given, as many as needed, or those of a new figure."""
    from matplotlib.axes import Axes

    if ax is None:
        return np.atleast_1d(new_axes(rows, size, columns, **options))
    count = rows * columns
    given = np.ravel(np.asarray(ax, dtype=object))
    if len(given) != count or not all(isinstance(one, Axes) for one in given):
        several = "an Axes" if count == 1 else f"{count} Axes"
        raise InputError(f"ax: must be {several} of Matplotlib")
    return given


def plain_ticks(axis: Axis) -> None:
    """Ticks of a logarithmic axis at 1, 2 and 5 times powers of ten, written out."""
    from matplotlib.ticker import FormatStrFormatter, LogLocator, NullFormatter

    axis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0)))
    axis.set_major_formatter(FormatStrFormatter("%g"))
    axis.set_minor_formatter(NullFormatter())


def title(ax: Axes, text: str, **options: Any) -> None:
    """A title that holds names, which are no formulas."""
    # With y given Matplotlib measures the ticks once less in every layout and drawing: no ticks are above these axes.
    ax.set_title(text, loc="left", y=1.0, parse_math=False, **options)


def note(ax: Axes, text: str) -> None:
    """Explain something in the legend, once, that has no line of its own."""
    if text not in ax.get_legend_handles_labels()[1]:
        ax.plot([], [], linestyle="none", label=text, gid=_NOTE)


def is_note(handle: Any) -> bool:
    """Is an entry of a legend an explanation?"""
    return getattr(handle, "get_gid", lambda: None)() == _NOTE


def legend(ax: Axes, **options: Any) -> None:
    """A legend without a frame, if there is something to explain; names in it are no formulas."""
    handles, labels = ax.get_legend_handles_labels()
    if handles:
        # What explains all of them comes last.
        order = sorted(range(len(handles)), key=lambda i: is_note(handles[i]))
        handles, labels = [handles[i] for i in order], [labels[i] for i in order]
        for text in ax.legend(handles, labels, frameon=False, fontsize=8.5, **options).get_texts():
            text.set_parse_math(False)
