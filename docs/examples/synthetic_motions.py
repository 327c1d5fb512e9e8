"""Synthetic records of one earthquake scenario and site, and a fragility curve computed with them."""

# %%
from pathlib import Path

import numpy as np

import dondolo as dd

out = Path("out/examples")
out.mkdir(parents=True, exist_ok=True)

# %% Magnitude 6 at 10 km on rock; the same seed gives the same records on every machine
records = dd.synthetic_records(magnitude=6.0, distance=10.0, site="rock", n_records=40, seed=1)
print(records[0])
pga = np.array([record.peak_acceleration for record in records]) / 9.81
print(f"PGA: median {np.median(pga):.3f} g, standard deviation of its logarithm {np.log(pga).std(ddof=1):.3f}")

# %% Only the phases are random: the records are similar to each other, and the curve is steep
wall = dd.OneSidedWall(height=1.5, thickness=0.25, name="parapet")
stripes = dd.multiple_stripe(wall, records, levels=np.linspace(0.3, 1.2, 10), polarity="both")
curve = stripes.fit()
print(curve)

# %%
curve.plot().figure.savefig(out / "synthetic_motions.png")
