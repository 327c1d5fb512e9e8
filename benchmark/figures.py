"""Figures of docs/performance.md."""

import matplotlib

matplotlib.use("agg")

import matplotlib.pyplot as plt
import numpy as np
from dondolo.figures.style import BLACK, BLUE, GREY, LIGHT, RC, RED
from matplotlib.ticker import NullFormatter
from problem import ROOT
from scaling import VALUES

FOLDER = ROOT / "docs" / "figures"
LOWEST = 1e-17  # errors of zero are drawn at this value
OPEN = {"markerfacecolor": "white"}
LOOKS = {
    "dondolo, rk45": {"color": RED, "marker": "o", "linewidth": 2.2},
    "dondolo, lanes": {"color": RED, "marker": "*", "markersize": 9, "linewidth": 2.2},
    "C++ by hand, RKN4, steps a sample": {"color": BLUE, "marker": "s"},
    "Boost.odeint, cut": {"color": BLUE, "marker": "^"},
    "Boost.odeint, free": {"color": BLUE, "marker": "^", "linestyle": ":", **OPEN},
    "heyoka, scalar": {"color": BLACK, "marker": "D"},
    "heyoka, batch": {"color": BLACK, "marker": "D", "linestyle": ":", **OPEN},
    "SUNDIALS, dopri5": {"color": BLACK, "marker": "v"},
    "SUNDIALS, adams": {"color": BLACK, "marker": "<", "linestyle": "--"},
    "SUNDIALS, adams_free": {"color": BLACK, "marker": "<", "linestyle": ":", **OPEN},
    "numbalsoda, dop853": {"color": GREY, "marker": "p"},
    "numbalsoda, lsoda": {"color": GREY, "marker": "p", "linestyle": ":", **OPEN},
    "SciPy, RK45": {"color": GREY, "marker": "o"},
    "SciPy, DOP853": {"color": GREY, "marker": "s"},
    "SciPy, LSODA": {"color": GREY, "marker": "^"},
    "SciPy, RK45/record": {"color": GREY, "marker": "o", "linestyle": ":", **OPEN},
    "GNU Octave, ode45": {"color": BLACK, "marker": "x"},
    "GNU Octave, ode45/sample": {"color": BLACK, "marker": "+"},
}
MEASURES = (
    ("median", "median"),
    ("most", "99 % are no worse"),
    ("worst", "worst"),
)


def save(figure, name):
    """Write a figure under the name used in the page."""
    FOLDER.mkdir(exist_ok=True)
    figure.savefig(FOLDER / f"performance_{name}.png", dpi=100)
    plt.close(figure)


def work(results):
    """Draw error against time per history, for every program."""
    with plt.rc_context(RC):
        figure, axes = plt.subplots(2, 2, figsize=(9.6, 9.6), sharex=True, layout="constrained")
        for name, look in LOOKS.items():
            own = [each for each in results if each.name == name]
            if not own:
                continue
            times = [each.ms_of_all for each in own]
            style = {"markersize": 4.5, "linewidth": 1.1} | look
            for ax, (what, _) in zip(axes.flat, MEASURES, strict=False):
                ax.loglog(times, np.maximum([getattr(each, what) for each in own], LOWEST), label=name, **style)
            axes[1, 1].plot(times, [100.0 * each.share for each in own], **style)
        for ax, (_, title) in zip(axes.flat, MEASURES, strict=False):
            ax.set(title=title, ylabel="error of the EDP")
        axes[1, 1].set_yscale("symlog", linthresh=0.1)
        axes[1, 1].set_yticks([0, 0.1, 1, 10, 100], ["0", "0.1", "1", "10", "100"])
        axes[1, 1].set(title="EDPs off by more than 1e-6", ylabel="% of the histories", ylim=(-0.02, 100))
        axes[1, 1].axhline(1.0, color=GREY, linewidth=1, zorder=0)
        for ax in axes[1]:
            ax.set(xlabel="time per history [ms]")
            ax.xaxis.set_minor_formatter(NullFormatter())
        for ax, (what, _) in zip(axes.flat, MEASURES, strict=False):
            for theirs, color, label in ((True, LIGHT, "the others"), (False, "#F2C9AE", "dondolo")):
                own = [each for each in results if (each.program != "dondolo") == theirs]
                times, errors = front(own, what)
                ax.step(times, errors, where="post", color=color, linewidth=5, zorder=0, label=f"front of {label}")
        handles = axes[0, 0].get_legend_handles_labels()
        figure.legend(*handles, loc="outside lower center", ncols=4)
    save(figure, "work")


def front(results, what):
    """The settings that no other is better than in both time and error: times, and errors."""
    times, errors = [], []
    for each in sorted(results, key=lambda each: each.ms_of_all):
        error = max(getattr(each, what), LOWEST)
        if not errors or error < errors[-1]:
            times.append(each.ms_of_all)
            errors.append(error)
    return times, errors


def scaling(rows):
    """Draw time against threads, walls, levels, length and sampling of the records; memory against histories."""
    panels = (
        ("threads", "threads", "speed-up"),
        ("records", "records", "time per record / of the fewest"),
        ("levels", "levels", "time per level / of the fewest"),
        ("shocks", "length of the records", "time / of the shortest"),
        ("samples", "samples for one of the record", "time / of one"),
        ("memory", "walls", "peak memory [MiB]"),
    )
    with plt.rc_context(RC):
        figure, axes = plt.subplots(2, 3, figsize=(9.6, 5.6), layout="constrained")
        for ax, (kind, xlabel, ylabel) in zip(axes.flat, panels, strict=True):
            if kind == "threads":
                looks = {"strong": {"marker": "o", "color": BLUE}, "weak": {"marker": "s", "color": RED}}
                for which, look in looks.items():
                    own = [row for row in rows if row["kind"] == f"{which} efficiency"]
                    size = np.array([row["size"] for row in own])
                    middle, least, largest = (size * [row[what] for row in own] for what in VALUES)
                    bars = np.array([middle - least, largest - middle])
                    ax.errorbar(size, middle, bars, label=which, markersize=4.5, capsize=3, **look)
                ax.plot(size, size, color=GREY, linewidth=1, zorder=0)
                ax.legend()
            else:
                own = [row for row in rows if row["kind"] == kind]
                size, value, least, largest = (np.array([row[what] for row in own]) for what in ("size", *VALUES))
                unit = 1.0 if kind == "memory" else value[0]
                if kind in ("records", "levels"):
                    unit = unit * size / size[0]
                bars = np.array([value - least, largest - value]) / unit
                ax.errorbar(size, value / unit, bars, marker="o", markersize=4.5, capsize=3, color=BLUE)
                ax.set_ylim(0.0, 1.1 * max(largest / unit))
                ax.set_xscale("log")
            ax.set_xticks(size, [f"{each:g}" for each in size])
            ax.set_xticks([], minor=True)
            ax.set(xlabel=xlabel, ylabel=ylabel)
    save(figure, "scaling")
