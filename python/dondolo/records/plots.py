"""Figures of records, of their response spectra, and of floors under them."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from dondolo._base.arguments import FloatArray, increasing
from dondolo.figures import style
from dondolo.figures.options import Options
from dondolo.records.building import Building
from dondolo.records.record import Record
from dondolo.records.record_set import RecordSet
from dondolo.records.spectrum import Spectrum
from dondolo.records.target import TargetSpectrum

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from dondolo.records.codes import Site

_PERIODS = np.geomspace(0.05, 4.0, 100)


def draw_record(record: Record, ax: Iterable[Axes] | None, given: dict[str, Any]) -> Axes:
    """Draw acceleration and velocity over time."""
    options = Options(given, "band", "points")
    axes = above, below = style.panels(ax, 2, (7.2, 4.0), sharex=True)
    is_first = not style.mains(above)
    look = style.apart(above, options)
    line = options.look(color=look["color"], linestyle=look["linestyle"], linewidth=0.9)
    time = record.time
    peak = int(np.argmax(np.abs(record.acceleration)))
    if record.peak_acceleration > 0.0 and options.band:
        low, high = record.significant_times()
        words = f"5 to 95 % of the Arias intensity, {high - low:.3g} s"
        for panel in axes:
            panel.axvspan(
                low, high, color=style.LIGHT, alpha=0.5, linewidth=0.0, label=words if panel is above else None
            )
    if record.vertical is not None:
        above.plot(time, record.vertical, color=style.GREY, linewidth=0.7, label="vertical")
    style.main(above, above.plot(time, record.acceleration, **line)[0])
    if options.points:
        label = f"PGA {record.peak_acceleration:.3g} m/s2 at {time[peak]:.4g} s"
        above.plot(time[peak], record.acceleration[peak], linestyle="none", marker="o", color=style.RED, label=label)
    style.y_label(above, "acceleration\n[m/s2]")
    style.title(above, record.name, options)
    below.plot(time, record.velocity, **{"label": f"PGV {record.intensity('pgv'):.3g} m/s"} | line)
    style.y_label(below, "velocity\n[m/s]")
    below.set_xlabel("time [s]")
    end = max(time[-1], record.dt)
    for panel in axes:
        panel.set_xlim(time[0], end if is_first else max(end, panel.get_xlim()[1]))
    style.legend(below, options, also=(above,))
    first: Axes = above
    return first


def draw_spectrum(spectrum: Spectrum, ax: Axes | None, given: dict[str, Any]) -> Axes:
    """Draw the pseudo-acceleration against the period."""
    options = Options(given)
    ax = style.axes(ax)
    look = style.apart(ax, options)
    look.pop("marker")
    order = np.argsort(spectrum.periods)
    words = f"damping {100.0 * spectrum.damping:.4g} %"
    line = options.look(**look, label=words)
    style.main(ax, ax.plot(spectrum.periods[order], spectrum.pseudo_acceleration[order], **line)[0])
    ax.set_ylim(bottom=0.0)
    ax.set_xlim(left=0.0)
    ax.set_xlabel("period [s]")
    style.y_label(ax, "pseudo-spectral acceleration [m/s2]")
    style.title(ax, "", options)
    style.legend(ax, options)
    return ax


def draw_spectra(
    records: RecordSet,
    target: TargetSpectrum | None,
    periods: ArrayLike | None,
    ax: Axes | None,
    given: dict[str, Any],
) -> Axes:
    """Draw the spectra of records, their median and dispersion, and a target."""
    options = Options(given, "band")
    ax = style.axes(ax)
    look = style.apart(ax, options)
    look.pop("marker")
    if periods is None:
        periods = _PERIODS if target is None else target.periods
    t = increasing("periods", periods)
    sa = records.spectra(t, damping=0.05 if target is None else target.damping)
    for i, one in enumerate(sa):
        ax.plot(t, one, color=style.GREY, linewidth=0.6, alpha=0.7, label=f"{len(sa)} records" if i == 0 else None)
    mean, spread = np.log(sa).mean(axis=0), np.log(sa).std(axis=0, ddof=1) if len(sa) > 1 else np.zeros(len(t))
    line = options.look(**look, linewidth=2.2, label="their median")
    style.main(ax, ax.plot(t, np.exp(mean), **line)[0])
    if len(sa) > 1 and options.band:
        for sign in (-1.0, 1.0):
            label = "16 and 84 % of a lognormal" if sign > 0.0 else None
            ax.plot(t, np.exp(mean + sign * spread), color=look["color"], linewidth=1.0, linestyle="--", label=label)
    if target is not None:
        ax.plot(target.periods, target.sa, color=style.RED, linewidth=2.2, linestyle="-.", label="target")
        if target.covariance.any() and options.band:
            for sign in (-1.0, 1.0):
                edge = target.sa * np.exp(sign * target.dispersion)
                ax.plot(target.periods, edge, color=style.RED, linewidth=1.0, linestyle=":")
        if target.anchor is not None:
            ax.axvline(target.anchor, color=style.BLACK, linewidth=0.8, linestyle=":")
    return _finish(ax, t, options)


def draw_floor(
    building: Building,
    records: tuple[Record, ...],
    periods: ArrayLike | None,
    damping: float,
    *,
    ax: Axes | None,
    site: Site | None,
    given: dict[str, Any],
) -> Axes:
    """Draw the spectra of a floor, the median of those of the ground, and the spectrum of the floor by the code."""
    options = Options(given)
    ax = style.axes(ax)
    t = increasing("periods", _PERIODS if periods is None else periods)
    ground, floor = (
        RecordSet(several).spectra(t, damping=damping)
        for several in (records, tuple(record.on_floor(building) for record in records))
    )
    for i, one in enumerate(floor):
        ax.plot(
            t, one, color=style.GREY, linewidth=0.6, alpha=0.7, label=f"floor, {len(floor)} records" if i == 0 else None
        )
    looks = (("floor, median", style.RED, "-"), ("ground, median", style.BLUE, "-."))
    for spectra, (label, color, dashes) in zip((floor, ground), looks, strict=True):
        line = options.look(color=color, linestyle=dashes, linewidth=2.2, label=label)
        ax.plot(t, np.exp(np.log(spectra).mean(axis=0)), **line)
    if site is not None:
        code = site.spectrum(periods=t, damping=damping, building=building)
        ax.plot(t, code.sa, color=style.BLACK, linewidth=1.8, linestyle="--", label="floor, Circolare C7.2.3")
    for period in building.periods:
        ax.axvline(period, color=style.BLACK, linewidth=0.8, linestyle=":")
    return _finish(ax, t, options)


def _finish(ax: Axes, periods: FloatArray, options: Options) -> Axes:
    """Scales and names of the axes of spectra."""
    ax.set_xscale("log")
    ax.set_yscale("log")
    ax.set_xlim(periods[0], periods[-1])
    ax.set_xlabel("period [s]")
    style.y_label(ax, "spectral acceleration [g]")
    style.title(ax, "", options)
    style.plain_ticks(ax.xaxis)
    style.plain_ticks(ax.yaxis)
    style.legend(ax, options)
    return ax
