"""Figures of the page, and those of single tests, which stay with who has the motions."""

from pathlib import Path

import matplotlib

matplotlib.use("agg")

import boulders
import campaigns
import matplotlib.pyplot as plt
import numpy as np
import scores
import values
from scipy.special import ndtr

from dondolo.figures.style import BLACK, BLUE, GREY, LIGHT, RED
from dondolo.figures.themes import theme

#: Widths of figures [inches]: one panel, two panels side by side
ONE, TWO = 5.4, 9.6


def draw(known: dict, statistics: dict, folder: Path, width: float | None = None) -> list[Path]:
    """Draw the figures of the page.

    Parameters
    ----------
    known : dict of Campaign
        The campaigns.
    statistics : dict
        Their statistics.
    folder : Path
        Where the files go.
    width : float, optional
        Width of all figures [inches]; panels are stacked where it has no room for two.

    Returns
    -------
    list of Path
    """
    folder.mkdir(parents=True, exist_ok=True)
    drawn = [
        _limestone(known["limestone"], statistics["limestone"], folder, width),
        _strips(known["safego"], statistics["safego"], folder, width),
    ]
    if "granite" in statistics:
        drawn.append(_curves(statistics["granite"]["specimens"], folder, width))
    return drawn


def _panels(width: float | None, height: float = 3.9):
    """Two panels, side by side or one above the other."""
    wide = TWO if width is None else width
    stacked = wide < 5.0
    size = (wide, 1.75 * height) if stacked else (wide, height if wide > 7.5 else 0.9 * height)
    return plt.subplots(2 if stacked else 1, 1 if stacked else 2, figsize=size, layout="constrained")


def _save(figure, folder: Path, name: str) -> Path:
    """Write a figure."""
    path = folder / f"experiments_{name}.png"
    figure.savefig(path, dpi=100)
    plt.close(figure)
    return path


def _limestone(campaign, found: dict, folder: Path, width) -> Path:
    """Speed ratios over Housner's: single impacts, and the mean of ten."""
    tests = campaigns.distinct(campaign.tests)
    first = [row for row in tests if row["test"].endswith("impact 1")]
    shape = np.array([float(row["height"]) / float(row["thickness"]) for row in first])
    ratio = np.array([float(row["measured"]) / values._speed_ratio(row) for row in first])
    one = found["first_impact"]
    with plt.rc_context(dict(theme().rc)):
        figure, (left, right) = _panels(width)
        mean = one["mean_ratio"]
        for sd, color, label in (
            (one["sd_ratio"], LIGHT, "90 % of single impacts"),
            (one["between_ratio"], GREY, "90 %, uncertainty of the mean"),
        ):
            left.axhspan(mean - 1.645 * sd, mean + 1.645 * sd, color=color, alpha=0.6, linewidth=0.0, label=label)
        left.axhline(1.0, color=BLACK, label="Housner")
        left.plot(
            shape, ratio, linestyle="none", marker="o", markersize=4, color=BLUE, mfc="none", label="first impact"
        )
        left.set(xlabel="slenderness H/B", ylabel="speed ratio, measured / computed", title="First impacts")
        ten = found["ten_impacts"]["by_slenderness"]
        x = np.array([float(name) for name in ten])
        grid = np.linspace(3.5, 15.5, 200)
        right.plot(grid, 1.0 - 1.5 / (1.0 + grid**2), color=BLACK, label="Housner")
        measured = [part["measured"] for part in ten.values()]
        right.plot(x, measured, linestyle="none", marker="s", color=RED, label="mean of ten impacts in a row")
        right.set(xlabel="slenderness H/B", ylabel="speed kept per impact", title="Repeated rocking")
        left.legend(fontsize=theme().legend, ncols=2 if figure.get_figwidth() > 9.0 else 1)
        left.set_ylim(top=1.02 * float(ratio.max()) + (0.05 if figure.get_figwidth() > 9.0 else 0.09))
        right.legend(fontsize=theme().legend)
    return _save(figure, folder, "limestone")


def _curves(specimens: dict, folder: Path, width) -> Path:
    """Measured and computed curves of the boulders, with the standard error of the ratio of medians."""
    with plt.rc_context(dict(theme().rc)):
        figure, panels = _panels(width)
        x = np.geomspace(0.02, 0.6, 300)
        for ax, name in zip(panels, boulders.SPECIMENS, strict=True):
            curve = specimens[name]["curve"]
            computed = scores.Lognormal(curve["theta_computed"], curve["beta_computed"])
            measured = scores.Lognormal(curve["theta_measured"], curve["beta_measured"])
            shifts = np.exp([-curve["se_bias"], curve["se_bias"]])
            band = [ndtr(np.log(x / (computed.theta * one)) / computed.beta) for one in shifts]
            ax.fill_between(x, band[1], band[0], color=LIGHT, linewidth=0.0, label="s.e. of the ratio of medians")
            ax.plot(
                x, measured(x), color=BLACK, label=f"measured: θ = {measured.theta:.3f} m/s, β = {measured.beta:.2f}"
            )
            ax.plot(
                x, computed(x), color=RED, linestyle="--",
                label=f"computed: θ = {computed.theta:.3f} m/s, β = {computed.beta:.2f}",
            )  # fmt: skip
            ax.set(
                xlabel="published PGV of the table [m/s]", ylabel="probability of overturning",
                title=f"Specimen {name}, {curve['motions']} motions", ylim=(0.0, 1.32), xlim=(0.0, 0.5),
            )  # fmt: skip
            ax.set_yticks(np.arange(0.0, 1.01, 0.2))
            ax.legend(fontsize=theme().legend, loc="upper left")
    return _save(figure, folder, "curves")


def _strips(campaign, found: dict, folder: Path, width) -> Path:
    """Peaks of US-1 against PGA, with the computed trigger acceleration."""
    tests = [row for row in campaign.tests if row["quantity"] == "peak_displacement" and row["pga"]]
    with plt.rc_context(dict(theme().rc)):
        wide = ONE if width is None else width
        figure, ax = plt.subplots(figsize=(wide, min(3.9, 0.85 * wide)), layout="constrained")
        ax.axvspan(
            found["trigger_least_g"], found["trigger_largest_g"], color=LIGHT, label="computed trigger acceleration"
        )
        for motion, marker, color in (("HU12", "o", BLUE), ("EC40", "s", RED), ("FR76", "^", BLACK)):
            part = [row for row in tests if row["motion"] == motion]
            x, y = (np.array([float(row[key]) for row in part]) for key in ("pga", "measured"))
            ax.plot(
                x, 1e3 * y, linestyle="none", marker=marker, color=color, mfc="none", label=f"measured, motion {motion}"
            )
        ax.set(xlabel="PGA of the table [g]", ylabel="largest displacement [mm]", yscale="log", ylim=(0.1, 400.0))
        ax.set(xlim=(0.0, 1.5), title="Strip US-1")
        ax.set_yticks([0.1, 1.0, 10.0, 100.0], ["0.1", "1", "10", "100"])
        ax.legend(fontsize=theme().legend, loc="upper left")
    return _save(figure, folder, "strips")


def draw_tests(tests, specimens: dict, factors: dict, folder: Path) -> list[Path]:
    """Draw single tests of the boulders, for who has them: the share fallen against 1/s*, and the wrong flags.

    Parameters
    ----------
    tests : boulders.Tests
        The tests.
    specimens : dict
        Statistics of each specimen.
    factors : dict of ndarray
        Smallest factors at which each computed specimen falls.
    folder : Path
        Where the files go, which git ignores.

    Returns
    -------
    list of Path
    """
    folder.mkdir(parents=True, exist_ok=True)
    with plt.rc_context(dict(theme().rc)):
        figure, panels = _panels(None)
        for ax, name in zip(panels, boulders.SPECIMENS, strict=True):
            single, x = specimens[name]["single_motion"], 1.0 / factors[name]
            edges = np.quantile(x, np.linspace(0.0, 1.0, 15))
            place = np.clip(np.searchsorted(edges, x, side="right") - 1, 0, 13)
            middle = [np.exp(np.log(x[place == i]).mean()) for i in range(14)]
            share = [tests.fell[name][place == i].mean() for i in range(14)]
            grid = np.geomspace(0.1, 10.0, 300)
            ax.plot(middle, share, "o", color=BLUE, label="measured, 14 equal parts")
            ax.plot(grid, ndtr((np.log(grid) - single["bias"]) / single["beta_single"]), color=BLACK, label="probit")
            ax.axvline(1.0, color=GREY, linestyle=":", label="computed: falls from here on")
            ax.set(xscale="log", xlabel="1/s*", ylabel="share that overturned", title=f"Specimen {name}")
            ax.legend(fontsize=theme().legend)
    drawn = [_save(figure, folder, "single_motions")]
    with plt.rc_context(dict(theme().rc)):
        figure, panels = _panels(None)
        for ax, name in zip(panels, boulders.SPECIMENS, strict=True):
            fell, wrong = tests.fell[name], (factors[name] <= 1.0) != tests.fell[name]
            pga = tests.pgv / (tests.pace * boulders.motions.GRAVITY)
            for chosen, look, label in (
                (~fell, {"marker": "o", "color": BLUE, "mfc": "none"}, "stood"),
                (fell, {"marker": "s", "color": RED}, "overturned"),
                (wrong, {"marker": "x", "color": BLACK, "markersize": 8}, "computed otherwise"),
            ):
                ax.plot(
                    tests.pace[chosen], pga[chosen], **({"linestyle": "none", "markersize": 4, "label": label} | look)
                )
            ax.set(xscale="log", yscale="log", xlabel="PGV/PGA [s]", ylabel="PGA [g]", title=f"Specimen {name}")
            ax.legend(fontsize=theme().legend)
    return [*drawn, _save(figure, folder, "map")]
