"""Figures of motions, stripes and curves: Matplotlib axes in, axes out.

Every function draws into the axes it is given, or into a new figure, and returns them.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from dondolo._fortran import _binding
from dondolo.errors import DondoloError, InputError
from dondolo.figures import style

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from dondolo.analysis.efficiency import IntensityComparison
    from dondolo.analysis.overturning import OverturningSpectrum
    from dondolo.analysis.response import Response
    from dondolo.analysis.stripes import Stripes
    from dondolo.curves.fragility import Fragility

# Points of a curve; enough for a smooth line
_POINTS = 301


def plot_history(response: Response, axes: Sequence[Axes] | None = None) -> Any:
    """Draw a motion: ground acceleration above, rotation / capacity below, impacts marked.

    Parameters
    ----------
    response : Response
        A motion computed with its time history.
    axes : two Axes, optional
        Where to draw; a new figure if left out.

    Returns
    -------
    ndarray of two Axes
        Acceleration [g] against time [s], and rotation / capacity against time [s].

    Raises
    ------
    DondoloError
        The response has no time history.
    """
    if (
        response.time is None
        or response.rotation is None
        or response.ground_acceleration is None
        or response.after_impact is None
    ):
        raise DondoloError("this response has no time history: simulate with history=True")
    if axes is None:
        axes = style.new_axes(2, (7.2, 4.6), sharex=True, height_ratios=(2, 3))
    above, below = axes
    time, wall = response.time, response.wall
    above.plot(time, response.ground_acceleration / wall.gravity, color=style.GREY, linewidth=0.8)
    trigger = wall.trigger_acceleration / wall.gravity
    for sign in (-1.0, 1.0) if wall.two_sided else (-1.0,):
        above.axhline(sign * trigger, color=style.RED, linewidth=0.9, linestyle="--")
    above.plot([], [], color=style.RED, linewidth=0.9, linestyle="--", label="trigger acceleration")
    above.set_ylabel("ground\nacceleration [g]")
    above.set_title(
        f"{wall.name}, record {response.record.name}, scale {response.scale:.4g}", loc="left", parse_math=False
    )
    style.legend(above, loc="lower right", bbox_to_anchor=(1.0, 1.0), borderaxespad=0.0)

    ratio = response.rotation / wall.capacity_angle
    below.plot(time, ratio, color=style.BLUE, label="rotation")
    impacts = time[response.after_impact]
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
    return np.asarray([above, below])


def plot_stripes(stripes: Stripes, ax: Axes | None = None) -> Axes:
    """Draw every history of a multiple stripe analysis: EDP against intensity, collapses set apart above.

    Figure 4a of Nale et al.

    Parameters
    ----------
    stripes : Stripes
        Result of `multiple_stripe`.
    ax : Axes, optional
        Where to draw; a new figure if left out.

    Returns
    -------
    Axes
        EDP against the level of intensity.
    """
    if ax is None:
        ax = style.new_axes()
    levels, edp, collapsed = stripes.levels, np.asarray(stripes.edp), np.asarray(stripes.collapsed)
    x = np.broadcast_to(levels[:, None], edp.shape)
    limit = stripes.edp_limit
    ax.plot(
        x[~collapsed],
        edp[~collapsed],
        linestyle="none",
        marker="o",
        markersize=4,
        markerfacecolor="none",
        markeredgecolor=style.BLUE,
        markeredgewidth=0.8,
        label="survives" if not collapsed.all() else None,
    )
    row = 1.1 * limit
    reached = collapsed.any(axis=1)
    ax.plot(
        levels[reached],
        np.full(reached.sum(), row),
        linestyle="none",
        marker="^",
        markersize=7,
        color=style.RED,
        label=f"collapses (of {edp.shape[1]})" if reached.any() else None,
    )
    for level, count in zip(levels[reached], collapsed.sum(axis=1)[reached], strict=True):
        ax.annotate(
            str(count), (level, row), (0, 6), textcoords="offset points", ha="center", fontsize=7.5, color=style.RED
        )
    ax.axhline(limit, color=style.BLACK, linewidth=0.9, linestyle="--", label="collapse limit")
    ax.set_ylim(0.0, 1.25 * limit)
    ax.set_xlim(0.0, 1.05 * levels.max())
    ax.set_xlabel(style.im_label(stripes.im))
    ax.set_ylabel("EDP = largest rotation / capacity")
    ax.set_title(stripes.wall.name, loc="left", parse_math=False)
    style.legend(ax, loc="upper left", bbox_to_anchor=(0.0, 0.8))
    return ax


def plot_fragility(
    fragility: Fragility,
    stripes: Stripes | None = None,
    ax: Axes | None = None,
    level: float = 0.95,
    label: str | None = None,
    color: str = style.BLUE,
    linestyle: str = "-",
    marker: str = "o",
) -> Axes:
    """Draw a fragility curve with its confidence band, and the fractions of collapse it was fitted to.

    Figure 4b of Nale et al. The bars of the fractions are Clopper and Pearson's exact binomial intervals.

    Parameters
    ----------
    fragility : Fragility
        A fitted curve; without a fit only the fractions and the bracket of the median are drawn.
    stripes : Stripes, optional
        Adds the name of the wall; the fractions are those that the curve was fitted to.
    ax : Axes, optional
        Where to draw; a new figure if left out.
    level : float
        Confidence of band and bars.
    label : str, optional
        Name of the curve where several are drawn; median and dispersion if left out.
    color, linestyle, marker : str
        Of the curve and its fractions, to tell several apart.

    Returns
    -------
    Axes
        Probability of collapse against intensity.
    """
    from scipy.stats import beta as beta_distribution

    if not 0.0 < level < 1.0:
        raise InputError(f"level = {level}: must lie between 0 and 1")
    if ax is None:
        ax = style.new_axes()
    x, z, n = (np.asarray(part, dtype=float) for part in (fragility.levels, fragility.collapses, fragility.histories))
    tail = 0.5 * (1.0 - level)
    counted = n > 0.0
    x, z, n = x[counted], z[counted], n[counted]
    fraction = z / n
    low = np.where(z > 0.0, beta_distribution.ppf(tail, z, n - z + 1.0), 0.0)
    high = np.where(z < n, beta_distribution.ppf(1.0 - tail, z + 1.0, n - z), 1.0)
    # Counts are those of the walls that can collapse, the curve is that of all.
    fraction, low, high = (fragility.saturation * part for part in (fraction, low, high))
    ax.errorbar(
        x,
        fraction,
        (fraction - low, high - fraction),
        linestyle="none",
        marker=marker,
        markersize=4.5,
        color=style.BLACK if label is None else color,
        elinewidth=0.8,
        capsize=2,
        label=f"fractions, {100.0 * level:.4g} % intervals" if label is None else None,
        zorder=3,
    )
    right = 1.05 * x.max()
    if fragility.has_fit:
        grid = np.linspace(right / _POINTS, right, _POINTS)
        band = np.asarray(fragility.interval(grid, level=level))
        text = f"{100.0 * level:.4g} % band" if label is None else None
        ax.fill_between(grid, band[0], band[1], color=color, alpha=0.2, linewidth=0.0, label=text)
        unit = f" {_binding.unit_of(fragility.im)}".rstrip()
        text = label or f"θ = {fragility.theta:.3g}{unit}, β = {fragility.beta:.3g}"
        ax.plot(grid, fragility(grid), color=color, linestyle=linestyle, label=text)
    else:
        ax.axvspan(
            fragility.bracket[0],
            min(fragility.bracket[1], right),
            color=style.LIGHT,
            alpha=0.6,
            linewidth=0.0,
            label=f"median somewhere here ({fragility.status})",
            zorder=0,
        )
    ax.set_xlim(0.0, right)
    ax.set_ylim(-0.02, 1.02)
    ax.set_xlabel(style.im_label(fragility.im))
    ax.set_ylabel("probability of collapse")
    if stripes is not None:
        ax.set_title(stripes.wall.name, loc="left", parse_math=False)
    style.legend(ax, loc="upper left" if label is None else "lower right")
    return ax


def plot_intensities(comparison: IntensityComparison, axes: Sequence[Axes] | None = None) -> Any:
    """Draw the curves of several intensity measures on one scale, and their dispersions.

    Parameters
    ----------
    comparison : IntensityComparison
        Result of `compare_intensities`.
    axes : sequence of two Axes, optional
        Where to draw; a new figure if left out.

    Returns
    -------
    array of two Axes
        Probability of collapse against scale factor over its median, for an amplitude the intensity over its median:
        the steeper, the more efficient; and the dispersions with 95 % intervals, the most efficient measure at the top.
    """
    import matplotlib.pyplot as plt

    if axes is None:
        axes = style.new_axes(size=(9.0, 4.0), columns=2)
    left, right = axes
    order = np.argsort(comparison.ratio)
    colors = plt.get_cmap("viridis")(np.linspace(0.0, 0.9, len(order)))
    grid = np.geomspace(0.2, 5.0, _POINTS)
    for row, (i, color) in enumerate(zip(order, colors, strict=True)):
        curve = comparison.curves[i]
        power = _binding.describe_measure(curve.im).power
        left.plot(
            grid,
            curve(grid**power * curve.theta),
            color=color,
            linestyle=("-", "--", "-.", ":")[row % 4],
            label=curve.im,
        )
        left.plot(
            (curve.levels / curve.theta) ** (1.0 / power),
            curve.collapses / curve.histories,
            linestyle="none",
            marker="o",
            markersize=3,
            color=color,
        )
        low, high = (end / power for end in curve.parameter_interval()["beta"])
        right.errorbar(
            [comparison.dispersion[i]],
            [row],
            xerr=[[comparison.dispersion[i] - low], [high - comparison.dispersion[i]]],
            color=color,
            marker="o",
            markersize=5,
            capsize=3,
        )
    left.set_xscale("log")
    left.set_xlim(0.2, 5.0)
    left.set_xticks([0.2, 0.5, 1.0, 2.0, 5.0], ["0.2", "0.5", "1", "2", "5"])
    left.set_xticks([], minor=True)
    left.set_xlabel("scale factor / its median")
    left.set_ylabel("probability of collapse")
    left.set_title(comparison.stripes[0].wall.name, loc="left", parse_math=False)
    style.legend(left, loc="upper left")
    right.set_yticks(range(len(order)), [comparison.ims[i] for i in order])
    right.invert_yaxis()
    right.set_xlim(left=0.0)
    right.set_xlabel("dispersion of the scale factor, 95 % interval")
    return axes


def plot_overturning_spectrum(spectrum: OverturningSpectrum, ax: Axes | None = None) -> Axes:
    """Draw which amplitudes overturn, without and with impacts before, against the frequency of the pulse.

    As Zhang and Makris (2001) draw it. Every frequency of the scan is a column, cut at the amplitudes where the state
    changes.

    Parameters
    ----------
    spectrum : OverturningSpectrum
        Result of `overturning_spectrum`.
    ax : Axes, optional
        Where to draw; a new figure if left out.

    Returns
    -------
    Axes
        a_p/(g tan alpha), the amplitude as a part of the trigger acceleration, against omega_p/p.
    """
    from matplotlib.collections import PolyCollection

    from dondolo.analysis.overturning import State

    if ax is None:
        ax = style.new_axes()
    x, unit = spectrum.frequency_ratio, spectrum.amplitude_unit
    inner = 0.5 * (x[1:] + x[:-1])
    first, last = (x[0] - inner[0], x[-1] - inner[-1]) if len(x) > 1 else (-0.5 * x[0], 0.5 * x[0])
    edges = np.concatenate([[x[0] + first], inner, [x[-1] + last]])
    # Lightness and hatching tell them apart in grey.
    looks = {
        State.OVERTURNED: (style.BLUE, style.BLUE, None, "overturns without impact"),
        State.OVERTURNED_AFTER_IMPACTS: (style.BRICK, style.RED, "////", "overturns after impacts"),
        State.SAFE: ("white", style.GREY, None, "survives, no impact during the pulse"),
        State.SAFE_AFTER_IMPACTS: ("white", style.GREY, "..", "survives, impacts during the pulse"),
        State.AT_REST: (style.LIGHT, style.LIGHT, None, "does not rock"),
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
            ax.plot(edges[i : i + 2], [height, height], color=style.BLACK, linewidth=0.9)
    ax.axhline(1.0, color=style.BLACK, linewidth=0.9, linestyle="--", label="trigger acceleration")
    ax.set_xlim(edges[0], edges[-1])
    ax.set_ylim(0.0, spectrum.amplitude_ratio[-1])
    ax.set_xlabel("frequency of the pulse $\\omega_p / p$")
    one_block = spectrum.wall.mechanism != "two_block"
    ax.set_ylabel("amplitude $a_p / (g\\,\\tan\\alpha)$" if one_block else "amplitude / trigger acceleration")
    ax.set_title(f"{spectrum.wall.name}, {spectrum.pulse}", loc="left", parse_math=False)
    style.legend(ax, loc="upper center", bbox_to_anchor=(0.5, -0.15), ncols=2)
    return ax
