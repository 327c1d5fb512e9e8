"""Multiple stripe analysis and fragility curve of one wall, with intervals (figure 4 of Nale et al.)."""

# %%
from pathlib import Path

import numpy as np

import dondolo as dd

data = Path(__file__).resolve().parents[2] / "data"
out = Path("out/examples")
out.mkdir(parents=True, exist_ok=True)

# %% Every record with both polarities at ten levels of peak ground acceleration
wall = dd.OneSidedWall(height=1.5, thickness=0.25, name="parapet")
records = dd.read_catalogue(data / "records" / "synthetic44.csv")
stripes = dd.multiple_stripe(wall, records, levels=np.linspace(0.2, 1.1, 10), polarity="both")
print(stripes)
print("collapses", stripes.collapses, "of", stripes.histories)

# %% The fragility curve and its confidence intervals
curve = stripes.fit()
print(curve)
print("95 % intervals, clustered by event:     ", curve.parameter_interval())
print("95 % intervals by resampling the records:", curve.bootstrap(n_resamples=500, rng=1).parameter_interval())
low, high = curve.interval(0.7)
print(f"P(collapse | 0.7 g) = {curve(0.7):.3f}, between {low:.3f} and {high:.3f}")

# %%
stripes.plot().figure.savefig(out / "stripes.png")
curve.plot().figure.savefig(out / "curve.png")
