"""Figure of a motion: its time history."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

import numpy as np

from dondolo._base.arguments import FloatArray
from dondolo.analysis.response import Response
from dondolo.figures import style
from dondolo.figures.options import Options
from dondolo.figures.wording import say
from dondolo.walls.parts import parts_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes


# What is shown before a wall first moves, and after it comes to rest [s]
_BEFORE, _AFTER = 0.5, 1.0


def motion_span(response: Response) -> tuple[float, float]:
    """When to begin and to end showing a motion [s]: about the time in which the wall moves, or all if it does not.

    Parameters
    ----------
    response : Response
        Has a time history.

    Returns
    -------
    (float, float)
    """
    time, _, rotation, _ = response._motion()
    start, end = float(time[0]), float(time[-1])
    moves = np.flatnonzero((rotation != 0.0) | (np.asarray(response.velocity) != 0.0))
    if len(moves):
        start, end = max(start, float(time[moves[0]]) - _BEFORE), min(end, float(time[moves[-1]]) + _AFTER)
    return start, end


def draw_history(response: Response, ax: Iterable[Axes] | None, given: dict[str, Any]) -> Axes:
    """Draw the acceleration of ground or floor above, rotation / capacity below, impacts marked."""
    options = Options(given, "points")
    time, acceleration, rotation, after_impact = response._motion()
    above, below = style.panels(ax, 2, (7.2, 4.2), sharex=True, height_ratios=(2, 3))
    is_first = not style.mains(below)
    wall = response.wall
    if wall.support_share > 0.0:
        motions = response.record.under(wall, at="base"), response.record.under(wall, at="top")
        looks = (say("base"), style.BLUE, "-"), (say("top"), style.PURPLE, (0, (3, 1)))
        for support, (at, colour, dashes) in zip(motions, looks, strict=True):
            shown = support.time <= time[-1]
            values = response.scale * support.acceleration[shown] / wall.gravity
            above.plot(support.time[shown], values, color=colour, linewidth=0.6, linestyle=dashes, label=at, alpha=0.8)
    above.plot(time, acceleration / wall.gravity, color=style.GREY, linewidth=0.8)
    trigger = wall.trigger_acceleration / wall.gravity
    for sign in (-1.0, 1.0) if wall.two_sided else (-1.0,):
        above.axhline(sign * trigger, color=style.RED, linewidth=0.9, linestyle="--")
    # Friction resists in full only where the wall has not been.
    name = say("trigger, first motion") if parts_of(wall, "interlock") else say("trigger acceleration")
    if name not in above.get_legend_handles_labels()[1]:
        above.plot([], [], color=style.RED, linewidth=0.9, linestyle="--", label=name)
    style.y_label(
        above,
        {
            "ground": say("ground\nacceleration [g]"),
            "floor": say("floor\nacceleration [g]"),
            "felt": say("felt\nacceleration [g]"),
        }[response._support],
    )
    words = say(
        "{wall}, record {record}, scale {scale:.4g}", wall=wall.name, record=response.record.name, scale=response.scale
    )
    style.title(above, words, options)

    ratio = rotation / wall.capacity_angle
    look = style.apart(below, options)
    motion = {"color": look["color"], "linestyle": look["linestyle"], "label": say("rotation")}
    style.main(below, below.plot(time, ratio, **options.look(**motion))[0])
    if options.points:
        _draw_marks(response, below, time[after_impact], ratio, look["color"])
    below.set_xlabel(say("time [s]"))
    style.y_label(below, say("rotation / capacity"))
    end = motion_span(response)[1]
    below.set_xlim(time[0], end if is_first else max(end, below.get_xlim()[1]))
    above.set_xlim(below.get_xlim())
    style.legend(below, options, also=(above,))
    first: Axes = above
    return first


def _draw_marks(response: Response, below: Axes, impacts: FloatArray, ratio: FloatArray, color: str) -> None:
    """Impacts, and the peak or the collapse."""
    later = len(impacts) - response.impacts
    below.plot(
        impacts,
        np.zeros(len(impacts)),
        linestyle="none",
        marker="|",
        markersize=9,
        markeredgewidth=0.8,
        color=style.BLACK if color == style.BLUE else color,
        label=say("impacts ({impacts}, and {later} after the record)", impacts=response.impacts, later=later)
        if later
        else say("impacts ({impacts})", impacts=response.impacts),
    )
    peak = int(np.argmax(np.abs(ratio)))
    below.plot(
        [response.time_of_peak],
        [np.copysign(response.edp, ratio[peak])],
        linestyle="none",
        marker="o",
        color=style.RED if color == style.BLUE else color,
        markersize=5,
        label=say("collapse, EDP = {edp:.3g}", edp=response.edp)
        if response.collapsed
        else say("peak, EDP = {edp:.3g}", edp=response.edp),
    )
