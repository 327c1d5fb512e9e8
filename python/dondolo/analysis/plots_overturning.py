"""Figure of an overturning spectrum."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from dondolo.analysis.overturning import OverturningSpectrum, State
from dondolo.figures import style
from dondolo.figures.options import Options
from dondolo.figures.wording import say

if TYPE_CHECKING:
    from matplotlib.axes import Axes


def draw_spectrum(spectrum: OverturningSpectrum, ax: Axes | None, given: dict[str, Any]) -> Axes:
    """Draw which amplitudes overturn, a column for each frequency, cut where the state changes."""
    from matplotlib.collections import PolyCollection

    options = Options(given)
    ax = style.axes(ax, (6.0, 3.8))
    x, unit = spectrum.frequency_ratio, spectrum.amplitude_unit
    inner = 0.5 * (x[1:] + x[:-1])
    first, last = (x[0] - inner[0], x[-1] - inner[-1]) if len(x) > 1 else (-0.5 * x[0], 0.5 * x[0])
    edges = np.concatenate([[x[0] + first], inner, [x[-1] + last]])
    # Lightness and hatching tell them apart in grey.
    looks = {
        State.OVERTURNED: (style.BLUE, style.BLUE, None, say("overturns without impact")),
        State.OVERTURNED_AFTER_IMPACTS: (style.BRICK, style.RED, "////", say("overturns after impacts")),
        State.SAFE: ("white", style.GREY, None, say("survives, no impact during the pulse")),
        State.SAFE_AFTER_IMPACTS: ("white", style.GREY, "..", say("survives, impacts during the pulse")),
        State.AT_REST: (style.LIGHT, style.LIGHT, None, say("does not rock")),
    }
    columns = [(i, window) for i in range(len(x)) for window in spectrum.windows(i)]
    for state, (face, edge, hatch, label) in looks.items():
        corners = []
        for i, window in columns:
            if window.state == state:
                low, high = 0.0 if state == State.AT_REST else window.lower / unit, window.upper / unit
                corners.append([(edges[i], low), (edges[i + 1], low), (edges[i + 1], high), (edges[i], high)])
        if corners:
            ax.add_collection(PolyCollection(corners, facecolor=face, edgecolor="none", antialiased=False))
            if hatch:
                ax.add_collection(PolyCollection(corners, facecolor="none", edgecolor=edge, hatch=hatch, linewidth=0.0))
            ax.fill_between([], [], [], facecolor=face, edgecolor=edge, hatch=hatch, linewidth=0.6, label=label)
    for boundary in spectrum.boundaries:
        if max(boundary.below, boundary.above) >= State.OVERTURNED_AFTER_IMPACTS:
            i = int(np.searchsorted(spectrum.frequencies, boundary.frequency))
            height = 0.5 * (boundary.lower + boundary.upper) / unit
            ax.plot(edges[i : i + 2], [height, height], **options.look(color=style.BLACK, linewidth=0.9))
    ax.axhline(1.0, color=style.BLACK, linewidth=0.9, linestyle="--", label=say("trigger acceleration"))
    ax.set_xlim(edges[0], edges[-1])
    ax.set_ylim(0.0, spectrum.amplitude_ratio[-1])
    ax.set_xlabel(say("frequency of the pulse") + " $\\omega_p / p$")
    one_block = spectrum.wall.mechanism not in ("two_block", "tabulated", "chain", "horizontal")
    ratio = say("amplitude") + " $a_p / (g\\,\\tan\\alpha)$" if one_block else say("amplitude / trigger acceleration")
    style.y_label(ax, ratio)
    style.title(ax, f"{spectrum.wall.name}, {spectrum.pulse}", options)
    style.legend(ax, options)
    return ax
