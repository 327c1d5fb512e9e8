"""Is it a lognormal? Deviance with its bootstrap, ranges of levels, and a logistic curve beside the lognormal."""

# %%
import os
from pathlib import Path

import numpy as np
from matplotlib import pyplot as plt

import dondolo as dd

data = Path(__file__).resolve().parents[2] / "data"
out = Path("out/examples")
out.mkdir(parents=True, exist_ok=True)

# %% Recorded accelerograms, if the folder DONDOLO_RECORDS has them, else the embedded synthetic ones
recorded = Path(os.environ.get("DONDOLO_RECORDS", "")) / "italy44.csv"
records = dd.read_catalogue(recorded if recorded.is_file() else data / "records" / "synthetic44.csv")

# %% Three walls at the same levels, each fitted to all of them and to parts
levels = np.linspace(0.1, 2.0, 20)
walls = [
    dd.TwoBlockWall(3.0, 0.25, hinge=0.6, restitution_factor=0.87, name="strip 3.0 x 0.25 m"),
    dd.OneSidedWall(1.5, 0.25, name="parapet 1.5 x 0.25 m"),
    dd.OneSidedWall(6.0, 0.5, name="facade 6.0 x 0.5 m"),
]
ranges = [(0.1, 2.0), (0.1, 1.0), (0.5, 2.0), (0.5, 1.0)]
print(f"{'wall':22}{'levels, g':>12}{'theta, g':>10}{'beta':>8}{'deviance':>10}{'dof':>5}{'p':>7}{'independent':>13}")
curves = {}
for wall in walls:
    curves[wall.name] = whole = dd.multiple_stripe(wall, records, levels, progress=False).fit()
    for low, high in ranges:
        # A level such as 0.1 + 0.4 is 0.5 but for rounding.
        curve = whole.refit(low=0.999 * low, high=1.001 * high)
        fit = curve.goodness_of_fit(n_resamples=999)
        print(
            f"{wall.name:22}{f'{low} - {high}':>12}{curve.theta:10.3f}{curve.beta:8.3f}{fit.deviance:10.2f}"
            f"{fit.degrees_of_freedom:5}{fit.p_value:7.3f}{fit.independent_p_value:13.3f}"
        )

# %% The logistic curve of the same histories: which of both is closer, and where they differ
figure, axes = plt.subplots(1, len(walls), figsize=(11.0, 3.6), sharey=True, layout="constrained")
for ax, (name, curve) in zip(axes, curves.items(), strict=True):
    logit = curve.logit()
    print(
        f"{name}: deviance of the lognormal {curve.deviance:.2f}, of the logistic curve {logit.deviance:.2f};"
        f" P at 0.2 g {curve(0.2):.2g} and {logit(0.2):.2g}"
    )
    x = np.linspace(0.01, 2.0, 200)
    ax.plot(levels, curve.collapses / curve.histories, "ko", markersize=4, label="fractions")
    ax.plot(x, curve(x), color="#0072B2", label=f"lognormal, deviance {curve.deviance:.1f}")
    ax.plot(x, logit(x), "--", color="#D55E00", label=f"logistic, deviance {logit.deviance:.1f}")
    ax.set(xlabel="pga, g", title=name)
    ax.legend(loc="lower right", fontsize="small")
axes[0].set_ylabel("probability of collapse")
figure.savefig(out / "goodness_of_fit.png", dpi=110)
