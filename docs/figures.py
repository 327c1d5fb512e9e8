"""Draw the figures of the README and of docs into docs/figures, from the embedded synthetic accelerograms."""

from pathlib import Path

import matplotlib

matplotlib.use("agg")

import matplotlib.pyplot as plt
import numpy as np

import dondolo as dd
from dondolo import style

root = Path(__file__).resolve().parents[1]
records = dd.read_catalogue(root / "data/records/synthetic44.csv")


def main() -> None:
    """Draw all figures."""
    wall = dd.OneSidedWall(height=1.5, thickness=0.25, name="parapet")
    stripes = dd.multiple_stripe(wall, records, levels=np.linspace(0.1, 1.2, 12), polarity="both")
    with plt.rc_context(style.RC):
        figure, axes = plt.subplots(1, 2, figsize=(9.6, 3.8), layout="constrained")
    dd.plot_stripes(stripes, axes[0])
    dd.plot_fragility(stripes.fit(), stripes, axes[1])
    figure.savefig(root / "docs/figures/quick_start.png", dpi=100)

    ims = ["pga", "pgv", "pgd", "arias", "cav", "hi", "sa(0.2)", "sa(0.5)", "sa(1)", "saavg(0.2:2)"]
    axes = dd.plot_intensities(dd.compare_intensities(wall, records, ims))
    axes[0].figure.savefig(root / "docs/figures/intensity_measures.png", dpi=100)

    walls = [
        (dd.OneSidedWall(height=1.5, thickness=0.25, name="one_sided"), 0.6),
        (dd.FreeStandingWall(height=1.8, thickness=0.45, name="free_standing"), -0.6),
        (dd.TwoBlockWall(height=3.0, thickness=0.25, hinge=0.6, name="two_block"), 0.8),
    ]
    with plt.rc_context(style.RC):
        figure, axes = plt.subplots(1, 3, figsize=(9.6, 4.0), layout="constrained")
    for ax, (shown, part) in zip(axes, walls, strict=True):
        dd.plot_wall(shown, rotation=part * shown.capacity_angle, ax=ax)
        ax.set_title(shown.name, loc="left", family="monospace")
    figure.savefig(root / "docs/figures/mechanisms.png", dpi=100)


if __name__ == "__main__":
    main()
