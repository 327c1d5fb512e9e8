"""Figures of a motion: time history, and the wall in motion."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

import numpy as np

from dondolo._base.arguments import as_number
from dondolo.analysis.response import Response
from dondolo.errors import InputError
from dondolo.figures import style
from dondolo.figures.layout import lay_out
from dondolo.walls.drawing import draw_surroundings, frame
from dondolo.walls.shape import shape

if TYPE_CHECKING:
    from matplotlib.animation import FuncAnimation
    from matplotlib.axes import Axes


def draw_history(response: Response, ax: Iterable[Axes] | None) -> style.Panels:
    """Draw ground acceleration above, rotation / capacity below, impacts marked."""
    time, acceleration, rotation, after_impact = response._motion()
    axes = above, below = style.panels(ax, 2, (7.2, 4.6), sharex=True, height_ratios=(2, 3))
    wall = response.wall
    above.plot(time, acceleration / wall.gravity, color=style.GREY, linewidth=0.8)
    trigger = wall.trigger_acceleration / wall.gravity
    for sign in (-1.0, 1.0) if wall.two_sided else (-1.0,):
        above.axhline(sign * trigger, color=style.RED, linewidth=0.9, linestyle="--")
    # Friction resists in full only where the wall has not been.
    name = "trigger acceleration" if getattr(wall, "interlock_overlap", None) is None else "trigger, first motion"
    above.plot([], [], color=style.RED, linewidth=0.9, linestyle="--", label=name)
    above.set_ylabel("ground\nacceleration [g]")
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


def animate(response: Response, frames_per_second: float, speed: float) -> FuncAnimation:
    """Animate the wall beside its rotation."""
    from matplotlib.animation import FuncAnimation

    rate, pace = as_number("frames_per_second", frames_per_second), as_number("speed", speed)
    if not (0.0 < pace < np.inf and 1.0 <= rate < np.inf):
        raise InputError(f"speed = {speed}, frames_per_second = {frames_per_second}: must be positive")
    time, _, rotation, _ = response._motion()
    wall = response.wall
    left, right = style.new_axes(size=(7.6, 4.0), columns=2, width_ratios=(2, 3))
    draw_surroundings(left, wall)
    start = shape(wall, 0.0)
    patches = [
        left.fill(*block.T, facecolor=style.BRICK, edgecolor=style.BLACK, linewidth=1.1)[0] for block in start.blocks
    ]
    (hinges,) = left.plot(*start.hinges.T, linestyle="none", marker="o", color=style.RED, markersize=5, zorder=4)
    frame(left, wall)
    ratio = rotation / wall.capacity_angle
    right.plot(time, ratio, color=style.LIGHT, linewidth=1.0)
    (line,) = right.plot([], [], color=style.BLUE)
    (point,) = right.plot([], [], linestyle="none", marker="o", color=style.RED)
    right.set_xlabel("time [s]")
    right.set_ylabel("rotation / capacity")
    style.title(right, f"{wall.name}, record {response.record.name}")
    instants = np.arange(time[0], time[-1] + 0.5 * pace / rate, pace / rate)

    def draw(frame: int) -> list[Any]:
        now = min(instants[frame], time[-1])
        here = float(np.interp(now, time, rotation))
        moved = shape(wall, here)
        for patch, block in zip(patches, moved.blocks, strict=True):
            patch.set_xy(block)
        hinges.set_data(*moved.hinges.T)
        past = time <= now
        line.set_data(time[past], ratio[past])
        point.set_data([now], [here / wall.capacity_angle])
        return [*patches, hinges, line, point]

    # Once, not for every frame
    lay_out(left.figure)
    return FuncAnimation(left.figure, draw, frames=len(instants), interval=1000.0 / rate, blit=False)
