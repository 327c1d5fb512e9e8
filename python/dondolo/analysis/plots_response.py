"""Figure of a motion: its time history."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

import numpy as np

from dondolo.analysis.response import Response
from dondolo.figures import style
from dondolo.walls.parts import parts_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes


def draw_history(response: Response, ax: Iterable[Axes] | None) -> style.Panels:
    """Draw the acceleration of ground or floor above, rotation / capacity below, impacts marked."""
    time, acceleration, rotation, after_impact = response._motion()
    axes = above, below = style.panels(ax, 2, (7.2, 4.6), sharex=True, height_ratios=(2, 3))
    wall = response.wall
    if wall.support_share > 0.0:
        motions = response.record.under(wall, at="base"), response.record.under(wall, at="top")
        looks = ("base", style.BLUE, "-"), ("top", style.PURPLE, (0, (3, 1)))
        for support, (at, colour, dashes) in zip(motions, looks, strict=True):
            shown = support.time <= time[-1]
            values = response.scale * support.acceleration[shown] / wall.gravity
            above.plot(support.time[shown], values, color=colour, linewidth=0.6, linestyle=dashes, label=at, alpha=0.8)
    above.plot(time, acceleration / wall.gravity, color=style.GREY, linewidth=0.8)
    trigger = wall.trigger_acceleration / wall.gravity
    for sign in (-1.0, 1.0) if wall.two_sided else (-1.0,):
        above.axhline(sign * trigger, color=style.RED, linewidth=0.9, linestyle="--")
    # Friction resists in full only where the wall has not been.
    name = "trigger acceleration" if not parts_of(wall, "interlock") else "trigger, first motion"
    above.plot([], [], color=style.RED, linewidth=0.9, linestyle="--", label=name)
    above.set_ylabel(f"{response._support}\nacceleration [g]")
    style.title(above, f"{wall.name}, record {response.record.name}, scale {response.scale:.4g}")
    style.legend(above, loc="lower right", bbox_to_anchor=(1.0, 1.0), borderaxespad=0.0)

    ratio = rotation / wall.capacity_angle
    below.plot(time, ratio, color=style.BLUE, label="rotation")
    impacts = time[after_impact]
    later = len(impacts) - response.impacts
    below.plot(
        impacts,
        np.zeros(len(impacts)),
        linestyle="none",
        marker="|",
        markersize=9,
        markeredgewidth=0.8,
        color=style.BLACK,
        label=f"impacts ({response.impacts}{f', and {later} after the record' if later else ''})",
    )
    peak = int(np.argmax(np.abs(ratio)))
    height = np.copysign(response.edp, ratio[peak])
    below.plot(
        [response.time_of_peak],
        [height],
        linestyle="none",
        marker="o",
        color=style.RED,
        markersize=5,
        label=f"collapse, EDP = {response.edp:.3g}" if response.collapsed else f"peak, EDP = {response.edp:.3g}",
    )
    below.set_xlabel("time [s]")
    below.set_ylabel("rotation / capacity")
    # A collapse ends high at the right, a motion that survives fades out there.
    style.legend(below, loc="upper left" if response.collapsed else "upper right")
    # Readable where the curve passes behind it too
    below.get_legend().set_frame_on(True)
    below.get_legend().get_frame().set(facecolor="white", alpha=0.8, linewidth=0.0)
    return axes
