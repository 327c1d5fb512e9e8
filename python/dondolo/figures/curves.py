"""What figures of fragility curves have in common: grid, looks of the lines, limits and legend."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from dondolo.figures import style
from dondolo.figures.options import Options
from dondolo.figures.wording import say

if TYPE_CHECKING:
    from matplotlib.axes import Axes

# Points of a curve; enough for a smooth line
POINTS = 301
# Chords of a thin curve of probabilities are off by about this much; a pixel is nearly ten times as much
_OFF = 4e-4


def grid(levels: ArrayLike) -> NDArray[np.float64]:
    """Levels at which a curve is drawn."""
    right = 1.05 * float(np.max(levels))
    return np.linspace(right / POINTS, right, POINTS)


def axes(ax: Axes | None) -> Axes:
    """The axes given, or those of a new figure."""
    return style.axes(ax, (6.0, 3.8))


def thin(ax: Axes, x: NDArray[np.float64], many: NDArray[np.float64], width: float, alpha: float) -> None:
    """Many thin curves (curves, points) as one artist, above bands and under all else; the limits of the axes stay."""
    from matplotlib.collections import LineCollection

    lines = [np.column_stack([x[kept], y[kept]]) for y, kept in zip(many, _corners(many), strict=True)]
    drawn = LineCollection(lines, colors=style.GREY, linewidths=width, alpha=alpha, zorder=1.6)
    ax.add_collection(drawn, autolim=False)


def _corners(many: NDArray[np.float64]) -> NDArray[np.bool_]:
    """Which points of curves (curves, points) to draw: every tenth at least, and more where a curve bends."""
    bends = np.abs(np.diff(many, 2, axis=1))
    # A chord of n steps is off by bends n^2 / 8.
    passed = np.floor(np.cumsum(0.1 + np.sqrt(bends / (8.0 * _OFF)), axis=1))
    kept = np.ones(many.shape, dtype=bool)
    kept[:, 1:-1] = np.diff(passed, axis=1, prepend=0.0) > 0.0
    return kept


def state_looks(thresholds: Sequence[float]) -> Iterator[tuple[float, dict[str, Any], dict[str, Any]]]:
    """Each damage state, its line and its marks: the more severe, the darker and bolder."""
    import matplotlib.pyplot as plt

    count = len(thresholds)
    colors = plt.get_cmap("viridis")(np.linspace(0.85, 0.0, count))
    for i, (threshold, color) in enumerate(zip(sorted(thresholds), colors, strict=True)):
        bold = 1.2 + 1.4 * (i + 1) / count
        look = {"color": color, "linewidth": bold, "linestyle": style.LINES[(count - 1 - i) % len(style.LINES)]}
        yield threshold, look, {"color": color, "linestyle": "none", "marker": style.MARKERS[i % 7], "markersize": 4}


def finish(ax: Axes, options: Options, im: str, right: float, title: str, ylabel: str | None = None) -> Axes:
    """Limits, labels, title and legend; axes that have a curve already get no narrower."""
    is_first = len(style.mains(ax)) <= 1
    ax.set_xlim(0.0, right if is_first else max(right, ax.get_xlim()[1]))
    ax.set_ylim(-0.02, 1.02)
    ax.set_xlabel(style.im_label(im))
    style.y_label(ax, ylabel or say("probability of collapse"))
    style.title(ax, title, options)
    style.legend(ax, options)
    return ax
