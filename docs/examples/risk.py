"""From a wall to its risk: incremental and cloud analysis, annual frequency of collapse, and a file for OpenQuake."""

# %%
from pathlib import Path

import numpy as np

import dondolo as dd

data = Path(__file__).resolve().parents[2] / "data"
out = Path("out/examples")
out.mkdir(parents=True, exist_ok=True)

# %% Closely spaced stripes, evaluated record by record
wall = dd.OneSidedWall(height=1.5, thickness=0.25, name="parapet")
records = dd.read_catalogue(data / "records" / "synthetic44.csv")
stripes = dd.multiple_stripe(wall, records, levels=0.05 * np.arange(2, 33), polarity="both")
ida = stripes.incremental()
print(ida)
print("fitted to first collapses:", ida.fit())
print("fitted to stripes:        ", stripes.fit())
ida.plot().figure.savefig(out / "incremental.png")

# %% Cloud analysis with one scale factor for all records
cloud = dd.cloud(wall, records, scale=2.5, polarity="both")
print(cloud)
print("P(EDP > 0.4 | 0.6 g) =", round(cloud.fit(0.4)(0.6), 3))
print("the same against the PGV:", cloud.against("pgv"))
cloud.plot().figure.savefig(out / "cloud.png")

# %% Annual frequency of collapse for the hazard of a fictitious site, given as annual frequencies of exceedance
hazard = dd.HazardCurve([0.02, 0.05, 0.1, 0.2, 0.4, 0.8, 1.6], [0.1, 0.03, 0.01, 2.5e-3, 4e-4, 5e-5, 4e-6], im="pga")
curve = stripes.fit()
risk = curve.risk(hazard)
print(risk)
for low, high in ((0.02, 0.4), (0.4, 0.8), (0.8, 1.6)):
    share = risk.deaggregate([low, high])[0] / risk.annual_frequency
    print(f"{100 * share:.0f} % of it comes from {low} to {high} g")
print(f"{100 * risk.above[0] / risk.annual_frequency:.0f} % of it, at least, from above")
risk.plot().figure.savefig(out / "risk.png")

# %% The curve for OpenQuake, with rotations of 0.4 of the capacity as a less severe damage state
reached = dd.fit_fragility(stripes.levels, (stripes.edp >= 0.4).sum(axis=1), stripes.edp.shape[1], im="pga")
dd.write_nrml(out / "parapet.xml", {"parapets": {"rotated": reached, "collapse": curve}}, id="parapets")
