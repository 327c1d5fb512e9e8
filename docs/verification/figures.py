"""Figures of docs/studies/verification.md."""

import matplotlib

matplotlib.use("agg")

import matplotlib.pyplot as plt
import numpy as np
from cases import ROOT
from study import DEFAULT, TOLERANCES

from dondolo.figures.style import BLACK, BLUE, GREY, MECHANISMS, RED
from dondolo.figures.themes import theme

FOLDER = ROOT / "docs" / "figures"
LOWEST = 1e-17  # errors of zero are drawn at this value
LOOKS = {
    mechanism: {"color": MECHANISMS[mechanism][0], "marker": marker}
    for mechanism, marker in (("one_sided", "o"), ("two_block", "s"), ("free_standing", "^"))
}
QUANTILES = {
    "median": (0.5, {"color": BLUE, "marker": "o", "linestyle": "-"}),
    "99 %": (0.99, {"color": RED, "marker": "s", "linestyle": "--"}),
    "worst": (1.0, {"color": BLACK, "marker": "^", "linestyle": ":"}),
}


def save(figure, name):
    """Write a figure under the name used in the page."""
    FOLDER.mkdir(exist_ok=True)
    figure.savefig(FOLDER / f"verification_{name}.png", dpi=100)
    plt.close(figure)


def shown(errors):
    """Errors bounded from below for a logarithmic axis."""
    return np.maximum(errors, LOWEST)


def work(study):
    """Draw error against tolerance, and against time per history."""
    with plt.rc_context(dict(theme().rc)):
        figure, axes = plt.subplots(2, 3, figsize=(9.6, 6.4), sharey=True, layout="constrained")
        for column, (wall, name) in enumerate(study.recorded()):
            milliseconds = [study.milliseconds[wall, name, rtol] for rtol in TOLERANCES]
            for label, (part, look) in QUANTILES.items():
                errors = shown([study.errors(wall, name, rtol).quantile(part) for rtol in TOLERANCES])
                axes[0, column].loglog(TOLERANCES, errors, label=label, markersize=4, **look)
                axes[1, column].loglog(milliseconds, errors, label=label, markersize=4, **look)
            axes[0, column].axvline(DEFAULT, color=GREY, linewidth=1, zorder=0)
            axes[1, column].axvline(study.milliseconds[wall, name, DEFAULT], color=GREY, linewidth=1, zorder=0)
            axes[0, column].invert_xaxis()
            axes[0, column].set(title=wall, xlabel="rtol", xticks=TOLERANCES[::2])
            ticks = [t for t in (0.1, 0.2, 0.5, 1, 2, 5) if 0.8 * min(milliseconds) < t < 1.2 * max(milliseconds)]
            axes[1, column].set(xlabel="time per history [ms]")
            axes[1, column].set_xticks(ticks, [f"{tick:g}" for tick in ticks])
            axes[1, column].set_xticks([], minor=True)
        for row in axes:
            row[0].set(ylabel="error of the EDP")
        figure.legend(
            *axes[0, 0].get_legend_handles_labels(),
            loc="outside lower center",
            ncols=3,
            title="of the histories that rock and do not collapse",
            title_fontsize=8.5,
        )
        axes[0, 2].annotate(
            "default",
            (DEFAULT, 0.98),
            xycoords=("data", "axes fraction"),
            color="#555555",
            xytext=(4, 0),
            textcoords="offset points",
            va="top",
            fontsize=8.5,
        )
    save(figure, "work")


def boundary(study, nearest):
    """Draw errors of the histories nearest to the limit, and the error of all against their margin."""
    with plt.rc_context(dict(theme().rc)):
        figure, (left, right) = plt.subplots(1, 2, figsize=(9.6, 4.2), layout="constrained")
        for wall, name, i in nearest:
            errors = shown([study.errors(wall, name, rtol).edp[i] for rtol in TOLERANCES])
            left.loglog(TOLERANCES, errors, linewidth=1, markersize=3.5, **LOOKS[wall])
        left.axvline(DEFAULT, color=GREY, linewidth=1, zorder=0)
        left.invert_xaxis()
        left.set(
            xlabel="rtol",
            xticks=TOLERANCES[::2],
            ylabel="error of the EDP",
            title=f"the {len(nearest)} histories nearest the limit",
        )
        for wall in LOOKS:
            for name in ("recorded", "synthetic"):
                exact = study.exact[wall, name]
                errors = study.errors(wall, name, DEFAULT)
                here = errors.moving
                right.loglog(
                    1.0 - exact.edp[here],
                    shown(errors.edp[here]),
                    linestyle="",
                    markersize=3,
                    label=wall if name == "recorded" else None,
                    markerfacecolor="none",
                    **LOOKS[wall],
                )
        line = np.array([1e-4, 1.0])
        right.loglog(line, line, color=GREY, linewidth=1)
        right.annotate("above the line an error\ncan change the flag", (1.1e-4, 2e-2), color="#555555", fontsize=8.5)
        right.set(
            xlabel="1 - EDP", ylabel="error of the EDP at the defaults", title="all that rock and do not collapse"
        )
        right.set_xticks([1e-4, 1e-3, 1e-2, 1e-1, 1.0])
        right.legend(loc="lower left", markerscale=1.5)
    save(figure, "boundary")


def estimate(study):
    """Draw estimated against true error."""
    with plt.rc_context(dict(theme().rc)):
        figure, axes = plt.subplots(1, 3, figsize=(9.6, 3.6), sharey=True, layout="constrained")
        line = np.array([LOWEST, 1.0])
        for ax, wall in zip(axes, LOOKS, strict=True):
            for name, fill in (("recorded", LOOKS[wall]["color"]), ("synthetic", "none")):
                errors = study.estimate_errors(wall, name, DEFAULT)
                estimates = study.estimated[wall, name, DEFAULT].spread
                here = errors.moving
                ax.loglog(
                    shown(errors.edp[here]),
                    shown(estimates[here]),
                    linestyle="",
                    markersize=3,
                    label=name,
                    markerfacecolor=fill,
                    markeredgewidth=0.6,
                    **LOOKS[wall],
                )
            ax.loglog(line, line, color=GREY, linewidth=1, zorder=0)
            for draw in (ax.axvline, ax.axhline):
                draw(1e-6, color=GREY, linewidth=1, linestyle=":", zorder=0)
            ax.set(title=wall, xlabel="true error of the EDP", xticks=[1e-17, 1e-13, 1e-9, 1e-5, 1e-1])
            ax.legend(loc="upper left")
        axes[0].set(ylabel="estimated error")
    save(figure, "estimate")


def shortcuts(table):
    """Draw wrong flags and wrong EDPs of each shortcut; the table is {wall: {shortcut: errors}}."""
    names = list(next(iter(table.values())))
    with plt.rc_context(dict(theme().rc)):
        figure, (left, right) = plt.subplots(1, 2, figsize=(9.6, 3.8), sharey=True, layout="constrained")
        for offset, (wall, each) in zip((-0.22, 0.0, 0.22), table.items(), strict=True):
            places = np.arange(len(names)) + offset
            look = {"linestyle": "", "markersize": 5, "label": wall} | LOOKS[wall]
            left.plot([each[name].flags() for name in names], places, **look)
            right.plot([each[name].above(1e-3) for name in names], places, **look)
        left.set_yticks(range(len(names)), names)
        left.invert_yaxis()
        total = len(next(iter(table["one_sided"].values())).edp)
        left.set(xlabel=f"wrong collapse flags of {total}")
        right.set_xscale("symlog", linthresh=1)
        right.set_xticks([0, 1, 10, 100], ["0", "1", "10", "100"])
        right.set(xlabel=f"histories of {total} with an EDP off by more than 0.001", xlim=(-0.3, total))
        left.legend(loc="upper right")
    save(figure, "shortcuts")
