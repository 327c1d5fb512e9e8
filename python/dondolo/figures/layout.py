"""Layout of a finished figure."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

# Room that curves leave for numbers and labels at their left, and at their right [inch]
_LEFT, _RIGHT = 0.55, 0.05


def lay_out(figure: Figure, *, is_cut: bool = False) -> None:
    """Lay out a figure for good: while it has a layout engine, savefig draws it twice.

    Parameters
    ----------
    figure : Figure
        One of dondolo's.
    is_cut : bool
        Whether its edges will be cut, or moved, to what it shows.
    """
    from matplotlib.layout_engine import ConstrainedLayoutEngine

    engine = figure.get_layout_engine()
    if engine is None:
        return
    one = figure.axes[0]
    if len(figure.axes) == 1 and one.get_aspect() == "auto" and isinstance(engine, ConstrainedLayoutEngine):
        for line in one.spines.values():
            # For the size of each line of a frame Matplotlib computes all ticks again. It is where the axes end.
            line.set_in_layout(False)
        # Numbers at ticks change with the size of the axes, so that they are measured twice; but it may be off by
        # some points where edges are cut, and from here it hardly changes.
        if is_cut:
            wide = figure.get_figwidth()
            _place(one, _LEFT / wide, 1.0 - _RIGHT / wide, *one.get_position(original=True).intervaly)
        for _ in range(1 if is_cut else 2):
            _fill(figure, one, engine.get())
    else:
        engine.execute(figure)
    figure.set_layout_engine(None)


def _fill(figure: Figure, ax: Axes, pads: dict[str, float]) -> None:
    """Give axes the room that a figure has beside their labels, as the engine of Matplotlib does for several."""
    width, height = figure.get_size_inches()
    across, up = pads["w_pad"] / width, pads["h_pad"] / height
    box = ax.get_position(original=True)
    shown = ax.get_tightbbox(for_layout_only=True)
    if shown is None:
        return
    shown = shown.transformed(figure.transFigure.inverted())
    left, right = box.x0 - shown.x0 + across, 1.0 - (shown.x1 - box.x1) - across
    bottom, top = box.y0 - shown.y0 + up, 1.0 - (shown.y1 - box.y1) - up
    _place(ax, left, right, bottom, top)


def _place(ax: Axes, left: float, right: float, bottom: float, top: float) -> None:
    """Put axes into a part of their figure, unless nothing is left of it."""
    if left < right and bottom < top:
        ax.set_position((left, bottom, right - left, top - bottom))
        ax.set_in_layout(True)


def apart(levels: list[float], gap: float) -> list[float]:
    """Levels in rising order that are at least a gap apart, as near to given ones as that allows.

    Parameters
    ----------
    levels : list of float
        In rising order.
    gap : float
        Least distance of two.

    Returns
    -------
    list of float
    """
    groups: list[list[float]] = []
    for place, level in enumerate(levels):
        # Where levels are too close their mean keeps its place
        groups.append([level - place * gap, 1.0])
        while len(groups) > 1 and groups[-2][0] > groups[-1][0]:
            mean, count = groups.pop()
            before, many = groups[-1]
            groups[-1] = [(before * many + mean * count) / (many + count), many + count]
    means = [mean for mean, count in groups for _ in range(round(count))]
    return [mean + place * gap for place, mean in enumerate(means)]
