"""What all figures share: colours that colour-blind eyes tell apart, shapes that tell them apart in grey, legends."""

from __future__ import annotations

import re
import textwrap
from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Any
from weakref import WeakKeyDictionary, WeakSet

import numpy as np
from numpy.typing import NDArray

from dondolo._base.arguments import argument_error
from dondolo._fortran.records import describe_measure
from dondolo.errors import InputError
from dondolo.figures.options import Options
from dondolo.figures.themes import PAGE, theme
from dondolo.figures.wording import decimal, say, set_decimal_marks

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.axis import Axis

# Several axes of one figure
Panels = NDArray[np.object_]

# Okabe and Ito (2008), Color universal design. Their lightness in grey is in brackets.
BLUE = "#0072B2"  # 46
RED = "#D55E00"  # 53
GREEN = "#009E73"  # 58
PURPLE = "#CC79A7"  # 62
ORANGE = "#E69F00"  # 71
BLACK = "#000000"
GREY = "#8C8C8C"
LIGHT = "#D9D9D9"
BRICK = "#E8C9A8"

# What tells curves of one figure apart: colours in this order, and dashes where they are printed in grey
COLOURS = (BLUE, RED, BLACK, GREEN, PURPLE, ORANGE)
LINES: tuple[Any, ...] = ("-", "--", "-.", ":", (0, (5, 1, 1, 1, 1, 1)), (0, (8, 2)), (0, (1, 3)))
MARKERS = "osD^v<>"

# Each mechanism has one colour and one dash, and all of them together have another, in every figure that compares them.
MECHANISMS: dict[str, tuple[str, Any]] = {
    "one_sided": (BLUE, "--"),
    "two_block": (ORANGE, "-."),
    "free_standing": (GREEN, ":"),
    "corner": (BLACK, (0, (1, 3))),
    "tabulated": (PURPLE, (0, (5, 1, 1, 1, 1, 1))),
    "chain": (BLACK, (0, (8, 2))),
    "horizontal": (GREEN, (0, (8, 2, 1, 2))),
    "all": (RED, "-"),
}

# What sentences that are said elsewhere are marked by for the catalogues
_ = str
# Mechanisms in words
_NAMES = {
    "one_sided": _("one-sided"),
    "two_block": _("two-block"),
    "free_standing": _("free-standing"),
    "corner": _("corner"),
    "tabulated": _("tabulated"),
    "chain": _("chain of bodies"),
    "horizontal": _("horizontal bending"),
    "all": _("all mechanisms"),
}
# Periods in the names of measures
_NUMBER = re.compile(r"\d+(?:\.\d+)?")
# Symbols with an index
_INDEXED = re.compile(r"\b([^\W\d_])_([A-Za-z0-9]+)")
# Mark of what has a label with formulas in the legend
FORMULA = "formula"
# Label of the axis of rotations
EDP = _("EDP = largest rotation / capacity")

# Main artists of results, from which one knows what an Axes shows
_MAIN: WeakSet[Any] = WeakSet()
# Figures that dondolo made, which grow with what is below their axes; of each row of panels, how much [inches]
_OWN: WeakKeyDictionary[Any, dict[int, float]] = WeakKeyDictionary()
# Room that axes have below their labels [pt]
_ROOMS: WeakKeyDictionary[Any, float] = WeakKeyDictionary()

# Mark of what a legend explains besides lines
_NOTE = "note"
# Layout of legends, in units of their letters: a row, the space between rows, line, its distance, space between columns
_ROW, _BETWEEN, _LINE, _PAD, _SPACE = 1.25, 0.3, 2.4, 0.5, 1.4
# What margins leave of the width of a panel, and what labels at its left take of that [pt]
_ROOM, _LEFT = 0.94, 34.0
# What legends leave of the height of a panel: of figures that do not grow with them, and of those that do
_HIGH = (0.48, 0.8)


def im_label(im: str) -> str:
    """Axis label of an intensity measure: words and unit of those that dondolo knows."""
    try:
        measure = describe_measure(im)
    except InputError:
        return im if im else say("intensity measure")
    return f"{_measure_name(measure.title)} [{measure.unit or '-'}]"


def _measure_name(title: str) -> str:
    """A measure in words: its periods apart."""
    numbers = _NUMBER.findall(title)
    places = ("first", "last")[: len(numbers)]
    sentence = _NUMBER.sub("{}", title).format(*(f"{{{place}}}" for place in places))
    return say(sentence, **dict(zip(places, map(decimal, numbers), strict=True)))


def mechanism_name(mechanism: str) -> str:
    """A mechanism in words."""
    return say(_NAMES.get(mechanism, mechanism))


def counted_walls(number: int) -> str:
    """How many: 1 wall, 2 walls."""
    return say("1 wall") if number == 1 else say("{number} walls", number=number)


def label(text: str) -> str:
    """A label that begins with what a user wrote: Matplotlib leaves those that begin with '_' out of legends."""
    return f" {text}" if text.startswith("_") else text


def mechanism_look(mechanism: str) -> dict[str, Any]:
    """Colour and dash of a mechanism."""
    color, linestyle = MECHANISMS.get(mechanism, (PURPLE, ":"))
    return {"color": color, "linestyle": linestyle}


def new_axes(rows: int = 1, size: tuple[float, float] = (6.0, 4.0), columns: int = 1, **options: Any) -> Any:
    """Axes of a new figure in the style in force; where it is narrow, panels are below each other."""
    import matplotlib.pyplot as plt

    current = theme()
    if current.width is not None:
        wide = current.width / 25.4
        if columns > 1 and wide < 0.6 * size[0]:
            size = (size[0] / columns, size[1] * columns)
            rows, columns = rows * columns, 1
            options = {name: value for name, value in options.items() if name != "width_ratios"}
        size = (wide, min(size[1] * max(wide / size[0], 0.7), PAGE / 25.4, rows * 4.6))
    # Not within rc_context: the first figure of a session chooses the backend, which turns interactive mode on, and
    # leaving the context would turn it off again. Without it a notebook shows no further figure.
    figure = plt.figure(figsize=size, dpi=current.rc["figure.dpi"], layout="constrained")
    _OWN[figure] = {}
    with plt.rc_context(dict(current.rc)):
        return figure.subplots(rows, columns, **options)


def axes(ax: Axes | None, size: tuple[float, float] = (6.0, 4.0)) -> Axes:
    """The axes given, or those of a new figure."""
    one: Axes = panels(None if ax is None else [ax], 1, size)[0]
    return one


def panels(ax: Iterable[Axes] | None, rows: int, size: tuple[float, float], columns: int = 1, **options: Any) -> Panels:
    """The axes given, as many as needed, or those of a new figure; with letters if the style has them."""
    from matplotlib.axes import Axes

    if ax is None:
        given = np.ravel(np.atleast_1d(new_axes(rows, size, columns, **options)))
    else:
        count = rows * columns
        given = np.ravel(np.asarray(ax, dtype=object))
        if len(given) != count or not all(isinstance(one, Axes) for one in given):
            several = "an Axes" if count == 1 else f"{count} Axes"
            raise argument_error("wrong_type", "ax", f": must be {several} of Matplotlib")
    for one in given:
        if not one.get_title(loc="left"):
            _set_title(one, "")
    return given


def plain_ticks(axis: Axis) -> None:
    """Ticks of a logarithmic axis, whose limits are known: at 1, 2 and 5 times powers of ten if few, written out."""
    from matplotlib.ticker import FormatStrFormatter, LogLocator, NullFormatter

    low, high = axis.get_view_interval()
    # More than three powers of ten have room for nothing between them.
    axis.set_major_locator(LogLocator(subs=(1.0, 2.0, 5.0) if high < 1e3 * low else (1.0,)))
    axis.set_major_formatter(FormatStrFormatter("%g"))
    axis.set_minor_formatter(NullFormatter())


def title(ax: Axes, text: str, options: Options, **looks: Any) -> None:
    """The title of a figure, unless a user wants another or none; its numbers get the mark of the language."""
    set_decimal_marks(ax.figure)
    _set_title(ax, options.title(text), **looks)


def _set_title(ax: Axes, text: str, **looks: Any) -> None:
    """A title that holds names, which are no formulas, after the letter of its panel, in lines that fit."""
    letter = _letter(ax)
    if not text and not letter:
        return
    size = looks.get("fontsize", _points("axes.titlesize"))
    room = _room(ax) - _LEFT
    if ax.figure.get_layout_engine() is None:
        # The axes stay where they are.
        room = (_share(ax)[1] - ax.get_position().x0) * 72.0 * ax.figure.bbox.width / ax.figure.dpi
    lines = _wrapped(f"{letter} {text}".strip(), size, room)
    # With y given Matplotlib measures the ticks once less in every layout and drawing: no ticks are above these axes.
    ax.set_title("\n".join(lines), loc="left", y=1.0, parse_math=False, **looks)


def _letter(ax: Axes) -> str:
    """Letter of a panel, '' for axes that have a figure to themselves, and in styles without letters."""
    grid = ax.get_subplotspec()
    if not theme().letters or grid is None or grid.get_gridspec().nrows * grid.get_gridspec().ncols == 1:
        return ""
    places = [place for one in ax.figure.axes if (place := one.get_subplotspec()) is not None]
    return f"({'abcdefghijklmnopqrstuvwxyz'[list(dict.fromkeys(places)).index(grid) % 26]})"


def _points(setting: str) -> float:
    """A size of letters in Matplotlib's settings [pt]."""
    import matplotlib as mpl
    from matplotlib.font_manager import FontProperties

    settings: Any = mpl.rcParams
    return FontProperties(size=settings[setting]).get_size_in_points()


def _width(text: str, size: float) -> float:
    """Width of a text [pt]."""
    from matplotlib.font_manager import FontProperties
    from matplotlib.textpath import text_to_path

    return float(text_to_path.get_text_width_height_descent(text, FontProperties(size=size), ismath=False)[0])


def _wrapped(text: str, size: float, room: float) -> list[str]:
    """A text in lines that are no wider than the room there is [pt]; formulas stay whole."""
    lines = []
    for line in text.split("\n"):
        wide = 0.0 if "$" in line else _width(line, size)
        lines += [line] if wide <= room else textwrap.wrap(line, max(8, int(len(line) * room / wide) - 1))
    return lines


def y_label(ax: Axes, text: str, **looks: Any) -> None:
    """The label of the ordinate, in lines that are no longer than the axes are high."""
    place, part = ax.get_subplotspec(), 1.0
    if place is not None:
        grid = place.get_gridspec()
        ratios = np.ones(grid.nrows) if grid.get_height_ratios() is None else np.asarray(grid.get_height_ratios())
        part = float(ratios[place.rowspan.start : place.rowspan.stop].sum() / ratios.sum())
    high = _HIGH[1] if ax.figure in _OWN else _HIGH[0]
    room = high * part * 72.0 * ax.figure.bbox.height / ax.figure.dpi
    ax.set_ylabel("\n".join(_wrapped(text, _points("axes.labelsize"), room)), **looks)


def in_lines(text: str, ax: Axes, part: float) -> str:
    """A label in lines that take no more than a part of the width that axes have."""
    size = _points("axes.labelsize")
    return "\n".join(_wrapped(text, size, part * _room(ax)))


def _room(ax: Axes) -> float:
    """Width that a figure leaves to an Axes and what belongs to it [pt]."""
    start, end = _share(ax)
    return _ROOM * 72.0 * ax.figure.bbox.width / ax.figure.dpi * (end - start)


def main(ax: Axes, artist: Any) -> None:
    """Remember the main artist of a result, from which those that are drawn later differ."""
    _MAIN.add(artist)


def mains(ax: Axes) -> list[Any]:
    """Main artists of the results that an Axes shows."""
    return [artist for artist in _MAIN if artist.axes is ax]


def apart(ax: Axes, options: Options, color: str = BLUE, linestyle: Any = "-") -> dict[str, Any]:
    """Colour, dash and marker of a result: unlike those that the axes show already, unless a user gives them."""
    others = mains(ax)
    used = {one.get_color() for one in others}
    if color in used:
        color = next((one for one in COLOURS if one not in used), COLOURS[len(others) % len(COLOURS)])
    if others:
        linestyle = LINES[len(others) % len(LINES)]
    own = {"color": color, "linestyle": linestyle, "marker": MARKERS[len(others) % len(MARKERS)]}
    return own | {name: value for name, value in options.look().items() if name in own}


def count_texts(ax: Axes, x: NDArray[np.float64], y: float, counts: Iterable[int], **looks: Any) -> None:
    """Numbers above marks: upright where there is room, turned where there is less, left out where there is none."""
    size = theme().note
    low, high = ax.get_xlim()
    # What labels of the axis leave of the width
    across = (x - low) / (high - low) * (_room(ax) - 5.0 * size)
    texts = [str(count) for count in counts]
    # Letters are half as wide as high.
    wide = 0.65 * size * max(map(len, texts), default=0) + 1.0
    turned = bool(len(x) > 1 and np.diff(np.sort(across)).min() < wide)
    need, last = 1.2 * size if turned else wide, -np.inf
    for place, at, text in zip(across, x, texts, strict=True):
        if place - last >= need:
            last = place
            ax.annotate(
                text,
                (at, y),
                (0, 5),
                textcoords="offset points",
                ha="center",
                va="bottom",
                fontsize=size,
                rotation=90.0 if turned else 0.0,
                **looks,
            )


def in_math(text: str) -> str:
    """A text whose symbols with an index, such as a_g S, are set as such; it may hold no names that a user gives."""
    return _INDEXED.sub(lambda found: rf"${found[1]}_\mathrm{{{found[2]}}}$", text)


def note(ax: Axes, text: str) -> None:
    """Explain something in the legend, once, that has no line of its own."""
    if text not in ax.get_legend_handles_labels()[1]:
        ax.plot([], [], linestyle="none", label=text, gid=_NOTE)


def is_note(handle: Any) -> bool:
    """Is an entry of a legend an explanation?"""
    return getattr(handle, "get_gid", lambda: None)() == _NOTE


def legend(ax: Axes, options: Options, also: Sequence[Axes] = ()) -> None:
    """The legend of axes, and of others above them, if there is something to explain; names in it are no formulas.

    It is below the axes, in as many columns as they have room for, and covers nothing.
    """
    if not options.legend:
        return
    found = [pair for one in (*also, ax) for pair in zip(*one.get_legend_handles_labels(), strict=True)]
    if not found:
        return
    # What explains all of them comes last.
    found.sort(key=lambda pair: is_note(pair[0]))
    size, room = theme().legend, _room(ax)
    texts, columns = _in_columns([label for _, label in found], size, room)
    make_room(ax, size * sum(_heights(texts, columns)))
    drawn = ax.legend(
        [handle for handle, _ in found],
        texts,
        loc="upper center",
        bbox_to_anchor=(0.5 * sum(_share(ax)), 0.0),
        bbox_transform=_below(ax),
        frameon=False,
        ncols=columns,
        fontsize=size,
        handlelength=_LINE,
        handletextpad=_PAD,
        labelspacing=_BETWEEN,
        columnspacing=_SPACE,
        borderaxespad=0.0,
        borderpad=0.2,
    )
    for text, (handle, _label) in zip(drawn.get_texts(), found, strict=True):
        text.set_parse_math(getattr(handle, "get_gid", lambda: None)() == FORMULA)


def _in_columns(labels: list[str], size: float, room: float) -> tuple[list[str], int]:
    """Labels in lines that fit, and how many columns of them do, three at most."""
    line = size * (_LINE + _PAD)
    texts = ["\n".join(_wrapped(label, size, room - line)) for label in labels]
    column = line + max(_width(part, size) for text in texts for part in text.split("\n"))
    return texts, max(1, min(3, len(texts), int((room + _SPACE * size) / (column + _SPACE * size))))


def _heights(texts: list[str], columns: int) -> list[float]:
    """Heights of the rows of a legend, in units of its letters."""
    rows = -(-len(texts) // columns)
    heights = [_ROW * (text.count("\n") + 1) + _BETWEEN for text in texts]
    # Entries run down the columns.
    return [max(heights[row::rows]) for row in range(rows)]


def _below(ax: Axes) -> Any:
    """Place below ticks and label of the abscissa, at whatever height the axes end."""
    from matplotlib.transforms import ScaledTranslation, blended_transform_factory

    depth = 7.0 + 1.2 * _points("xtick.labelsize") if ax.xaxis.get_tick_params().get("labelbottom", True) else 4.0
    if text := ax.get_xlabel():
        depth += 6.0 + 1.35 * _points("axes.labelsize") * (text.count("\n") + 1)
    down = ScaledTranslation(0.0, -depth / 72.0, ax.figure.dpi_scale_trans)
    return blended_transform_factory(ax.figure.transSubfigure, ax.transAxes + down)


def _share(ax: Axes) -> tuple[float, float]:
    """Ends of the part of the width of a figure that belongs to axes, with their labels."""
    place = ax.get_subplotspec()
    if place is None:
        shown = ax.get_position()
        return float(shown.x0), float(shown.x1)
    grid = place.get_gridspec()
    ratios = np.ones(grid.ncols) if grid.get_width_ratios() is None else np.asarray(grid.get_width_ratios())
    ends = np.append(0.0, np.cumsum(ratios) / ratios.sum())
    return float(ends[place.colspan.start]), float(ends[place.colspan.stop])


def make_room(ax: Axes, height: float) -> None:
    """Room below the label of the abscissa [pt]: a figure of dondolo grows by it, axes without a layout give it up.

    Layout engines make it themselves. Where panels are in one row, the highest counts.
    """
    from matplotlib.layout_engine import ConstrainedLayoutEngine, TightLayoutEngine

    figure: Any = ax.figure
    given = _ROOMS.get(ax, 0.0)
    more = max(0.0, height - given) / 72.0
    _ROOMS[ax] = max(height, given)
    if figure in _OWN:
        place = ax.get_subplotspec()
        row = 0 if place is None else place.rowspan.stop
        of_row = _OWN[figure]
        more = max(0.0, height / 72.0 - of_row.get(row, 0.0))
        of_row[row] = of_row.get(row, 0.0) + more
        wide, high = figure.get_size_inches()
        figure.set_size_inches(wide, high + more)
    elif not isinstance(figure.get_layout_engine(), ConstrainedLayoutEngine | TightLayoutEngine):
        # As a colour bar takes its room from its axes
        box = ax.get_position(original=True)
        lift = min(more * figure.dpi / figure.bbox.height, 0.75 * box.height)
        ax.set_position((box.x0, box.y0 + lift, box.width, box.height - lift))
        ax.set_in_layout(True)
