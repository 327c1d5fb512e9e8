"""Figures of docs/studies/performance.md."""

from dataclasses import asdict

import matplotlib

matplotlib.use("agg")

import cost_model
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.ticker import NullFormatter
from programs import DONDOLO

from dondolo.figures.style import BLACK, BLUE, BRICK, GREY, LIGHT, RED, mechanism_name
from dondolo.figures.themes import theme

LOWEST = 1e-17  # errors of zero are drawn at this value
OPEN = {"markerfacecolor": "white"}
# One colour and one mark for each program, whose settings are joined method by method
LOOKS = {
    "dondolo, lanes": {"color": RED, "marker": "*", "markersize": 10, "linewidth": 2.2},
    "dondolo, rk45": {"color": RED, "marker": "o", "linewidth": 2.2},
    "C++ by hand": {"color": BLUE, "marker": "s"},
    "Boost.odeint": {"color": BLUE, "marker": "^", **OPEN},
    "heyoka": {"color": BLACK, "marker": "D"},
    "SUNDIALS": {"color": BLACK, "marker": "v", **OPEN},
    "numbalsoda": {"color": GREY, "marker": "p"},
    "SciPy": {"color": GREY, "marker": "o", **OPEN},
    "GNU Octave": {"color": BLACK, "marker": "x"},
}
MEASURES = (("median", "median error of the EDP"), ("worst", "largest error of the EDP"))


def save(figure, folder, name):
    """Write a figure under the name used in the page."""
    folder.mkdir(exist_ok=True)
    figure.savefig(folder / f"performance_{name}.png", dpi=100)
    plt.close(figure)


def work(folder, results):
    """Draw error against time per history, for every program."""
    with plt.rc_context(dict(theme().rc)):
        figure, axes = plt.subplots(1, 3, figsize=(10.4, 4.6), sharex=True, layout="constrained")
        for name, look in LOOKS.items():
            style = {"markersize": 4.5, "linewidth": 1.0} | look
            methods = dict.fromkeys(each.name for each in results if each.name.startswith(name))
            for i, method in enumerate(methods):
                own = [each for each in results if each.name == method]
                times, label = [each.ms_of_all for each in own], name if i == 0 else None
                for ax, (what, _) in zip(axes, MEASURES, strict=False):
                    ax.loglog(times, np.maximum([getattr(each, what) for each in own], LOWEST), label=label, **style)
                axes[2].plot(times, [100.0 * each.share for each in own], **style)
        for ax, (what, ylabel) in zip(axes, MEASURES, strict=False):
            ax.set(ylabel=ylabel, xlim=ax.get_xlim(), ylim=ax.get_ylim())
            for own, label, dashes in (
                ([each for each in results if each.program != DONDOLO.name], "best of the others", "-"),
                ([each for each in results if each.program == DONDOLO.name], "best of dondolo", (0, (1.6, 0.5))),
            ):
                times, errors = front(own, what)
                # From the upper end of the axes to their right end
                corners = [times[0], *times, ax.get_xlim()[1]], [ax.get_ylim()[1], *errors, errors[-1]]
                color = LIGHT if dashes == "-" else BRICK
                ax.step(*corners, where="post", linewidth=5, zorder=0, color=color, linestyle=dashes, label=label)
        axes[2].set_yscale("symlog", linthresh=0.1)
        axes[2].set_yticks([0, 0.1, 1, 10, 100], ["0", "0.1", "1", "10", "100"])
        axes[2].set(ylabel="EDPs off by more than 1e-6 [%]", ylim=(-0.02, 100))
        axes[2].axhline(1.0, color=GREY, linewidth=1, zorder=0)
        for ax in axes:
            ax.set(xlabel="time per history [ms]")
            ax.xaxis.set_minor_formatter(NullFormatter())
        figure.legend(*axes[0].get_legend_handles_labels(), loc="outside lower center", ncols=6, frameon=False)
    save(figure, folder, "work")


def front(results, what):
    """The settings that no other is better than in both time and error: times, and errors."""
    times, errors = [], []
    for each in sorted(results, key=lambda each: each.ms_of_all):
        error = max(getattr(each, what), LOWEST)
        if not errors or error < errors[-1]:
            times.append(each.ms_of_all)
            errors.append(error)
    return times, errors


# Kind of row, label of the size, label of the value, and whether the time is divided by the size
PANELS = (
    ("walls", "walls, a call for each", "time per wall [ms]", True),
    ("records", "records", "time per record [ms]", True),
    ("levels", "levels", "time per level [ms]", True),
    ("shocks", "repetitions of the record", "time [ms]", False),
    ("samples", "samples for one of the record", "time [ms]", False),
)
MODEL = {"color": BLACK, "linewidth": 1.1, "linestyle": "--"}


def scaling(folder, rows):
    """Draw time against threads, walls, records, levels, length and sampling, with the fitted growth; and memory."""
    with plt.rc_context(dict(theme().rc)):
        figure, axes = plt.subplots(2, 4, figsize=(12.0, 5.8), layout="constrained")
        speed_ups(axes[0, 0], rows)
        for ax, (kind, xlabel, ylabel, is_divided) in zip(axes.flat[1:], PANELS, strict=False):
            own = [row for row in rows if row["kind"] == kind]
            size = np.array([row["size"] for row in own])
            unit = 1e3 / (size if is_divided else 1.0)
            draw_spreads(
                ax, size, own, unit, label="measured; threads: strong scaling", color=BLUE, marker="o", linestyle="none"
            )
            fine = np.geomspace(size[0], size[-1], 60)
            model = 1e3 * cost_model.modelled(rows, kind, fine) / (fine if is_divided else 1.0)
            ax.plot(fine, model, label="fitted growth; threads: Amdahl's law", **MODEL)
            ax.set(xscale="log", xlabel=xlabel, ylabel=ylabel)
            from_zero(ax)
            ticks(ax, size)
        own = [row for row in rows if row["kind"] == "memory"]
        size = [row["histories"] for row in own]
        axes[1, 2].plot(size, [row["median"] for row in own], marker="o", markersize=4.5, color=BLUE)
        axes[1, 2].set(xscale="log", xlabel="histories", ylabel="peak memory [MiB]")
        from_zero(axes[1, 2])
        axes[1, 3].axis("off")
        drawn = [ax.get_legend_handles_labels() for ax in (axes[0, 0], axes[0, 1])]
        handles, labels = ([*threads, *sizes] for threads, sizes in zip(*drawn, strict=True))
        axes[1, 3].legend(handles, labels, loc="center left")
    save(figure, folder, "scaling")


def speed_ups(ax, rows):
    """Draw speed-up against threads, with Amdahl's law."""
    looks = {
        "strong": {"marker": "o", "color": BLUE},
        "weak": {"marker": "s", "color": RED, "label": "weak scaling", **OPEN},
    }
    for kind, look in looks.items():
        own = [row for row in rows if row["kind"] == f"{kind} efficiency"]
        size = np.array([row["size"] for row in own])
        draw_spreads(ax, size, own, size, linestyle="none", **look)
    share = cost_model.serial_share(rows)
    fine = np.linspace(1.0, size[-1], 60)
    ax.plot(fine, fine, color=GREY, linewidth=1, zorder=0, label="ideal")
    if share is not None:
        ax.plot(fine, cost_model.speed_up(share, fine), **MODEL)
    ax.set(xlabel="threads", ylabel="speed-up")
    ticks(ax, size)


def from_zero(ax):
    """Let the ordinate begin at zero and end above what is drawn."""
    ax.set_ylim(0.0, 1.08 * ax.dataLim.ymax)


def draw_spreads(ax, size, rows, unit, **look):
    """Draw medians, with bars from the lower to the upper quartile."""
    middle, bars = bars_of(rows)
    ax.errorbar(size, unit * middle, unit * bars, markersize=4.5, capsize=3, **look)


def bars_of(rows):
    """Medians, and the lengths of bars to the lower and to the upper quartile."""
    middle, lower, upper = (np.array([row[what] for row in rows]) for what in ("median", "lower", "upper"))
    return middle, np.array([middle - lower, upper - middle])


def ticks(ax, size):
    """Ticks at the sizes, and nowhere else."""
    ax.set_xticks(size, [f"{each:g}" for each in size])
    ax.set_xticks([], minor=True)


def arithmetic(folder, shares):
    """Draw the share of the arithmetic limit that each mechanism reaches, from {mechanism: spread}."""
    with plt.rc_context(dict(theme().rc)):
        figure, ax = plt.subplots(figsize=(7.2, 2.6), layout="constrained")
        places, rows = np.arange(len(shares)), [asdict(share.times(100.0)) for share in shares.values()]
        medians, bars = bars_of(rows)
        ax.barh(places, medians, height=0.55, color=BRICK, edgecolor=BLACK, label="steps of the engine, median")
        ax.errorbar(medians, places, xerr=bars, fmt="none", color=BLACK, capsize=4, label="quartiles of the rounds")
        ax.axvline(100.0, color=BLACK, linestyle="--", label="loop of multiplications and additions")
        ax.set_yticks(places, [mechanism_name(each) for each in shares])
        ax.invert_yaxis()
        ax.grid(axis="y", visible=False)
        ax.set(xlabel="operations per second / those of the loop [%]", xlim=(0.0, 105.0))
        figure.legend(loc="outside lower center", ncols=3)
    save(figure, folder, "arithmetic")
