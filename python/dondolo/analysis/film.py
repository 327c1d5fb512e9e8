"""Film of a motion: the wall beside its rotation."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.animation import FuncAnimation

from dondolo._base.arguments import argument_error, as_number
from dondolo.analysis.plots_response import motion_span
from dondolo.analysis.response import Response
from dondolo.errors import InputError
from dondolo.figures import style
from dondolo.figures.layout import lay_out
from dondolo.figures.options import Options
from dondolo.walls.drawing import draw_surroundings, frame
from dondolo.walls.shape import shape
from dondolo.walls.wall import MasonryWall


class _Film(FuncAnimation):
    """An animation that draws every frame once where it is saved: Matplotlib's draws it on its canvas too."""

    _saving = False

    def save(self, *arguments: Any, **options: Any) -> None:
        self._saving = True
        try:
            super().save(*arguments, **options)
        finally:
            self._saving = False

    def _post_draw(self, framedata: Any, blit: bool) -> None:
        if not self._saving:
            super()._post_draw(framedata, blit)  # type: ignore[misc]


def animate(response: Response, frames_per_second: float, speed: float) -> FuncAnimation:
    """Animate the wall beside its rotation."""
    rate, pace = as_number("frames_per_second", frames_per_second), as_number("speed", speed)
    if not (0.0 < pace < np.inf and 1.0 <= rate < np.inf):
        raise argument_error(
            "out_of_range", "speed", f" = {speed}, frames_per_second = {frames_per_second}: must be positive"
        )
    time, _, rotation, _ = response._motion()
    first, last = motion_span(response)
    wall = response.wall
    if not isinstance(wall, MasonryWall):
        raise InputError(f"wall '{wall.name}': has no shape to draw, it is given by a table")
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
    style.title(right, f"{wall.name}, record {response.record.name}", Options({}))
    right.set_xlim(first, last)
    instants = np.arange(first, last + 0.5 * pace / rate, pace / rate)

    def draw(frame: int) -> list[Any]:
        now = min(instants[frame], last)
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
    return _Film(left.figure, draw, frames=len(instants), interval=1000.0 / rate, blit=False)
