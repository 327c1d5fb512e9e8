"""Figures of documents: drawn in the language in force, laid out, and closed."""

from __future__ import annotations

import base64
import io
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from typing import Any

from dondolo.figures.layout import lay_out
from dondolo.figures.wording import set_decimal_marks

# A drawing is embedded as SVG up to this size, and as pixels beyond: many thin curves make large drawings
_SVG_BYTES = 600_000
_DOTS_PER_INCH = 180
# Around a drawing [inch]
_MARGIN = 0.1


@contextmanager
def drawn(draw: Callable[[], Any]) -> Iterator[Any]:
    """A figure of Matplotlib until the end of the block.

    Parameters
    ----------
    draw : callable
        Gives Matplotlib axes, or several of one figure.
    """
    import matplotlib.pyplot as plt

    axes = draw()
    figure = (axes if hasattr(axes, "figure") else axes[0]).figure
    try:
        set_decimal_marks(figure)
        lay_out(figure, is_cut=True)
        yield figure
    finally:
        plt.close(figure)


def embedded(draw: Callable[[], Any]) -> str:
    """A drawing as a data URI: SVG, or PNG where that would be large."""
    import matplotlib as mpl

    # The same bytes every time: no date, and names in the drawing by a fixed salt.
    with drawn(draw) as figure, mpl.rc_context({"svg.hashsalt": "dondolo"}):
        shown = figure.get_tightbbox().padded(_MARGIN)
        stream, kind = io.BytesIO(), "svg+xml"
        figure.savefig(stream, format="svg", metadata={"Date": None}, bbox_inches=shown)
        if stream.tell() > _SVG_BYTES:
            stream, kind = io.BytesIO(), "png"
            figure.savefig(stream, format="png", dpi=_DOTS_PER_INCH, bbox_inches=shown)
    return f"data:image/{kind};base64,{base64.b64encode(stream.getvalue()).decode()}"
