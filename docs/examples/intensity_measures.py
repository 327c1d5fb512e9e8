"""Comparison of intensity measures: the smaller the dispersion between records, the fewer records are needed."""

# %%
from pathlib import Path

import dondolo as dd

data = Path(__file__).resolve().parents[2] / "data"
out = Path("out/examples")
out.mkdir(parents=True, exist_ok=True)

# %% Intensity measures of a record, in the units of the levels, and its response spectrum, in SI units
records = dd.read_catalogue(data / "records" / "synthetic44.csv")
record = records[0]
print(f"PGV {record.intensity('pgv'):.3f} m/s, Sa(0.5 s) {record.intensity('sa(0.5)'):.3f} g")
print(record.spectrum([0.2, 0.5, 1.0]).pseudo_acceleration, "m/s2")

# %% Stripes by spectral acceleration instead of peak ground acceleration
wall = dd.OneSidedWall(height=1.5, thickness=0.25, name="parapet")
stripes = dd.multiple_stripe(wall, records, levels=[0.8, 1.1, 1.4, 1.7, 2.0], im="sa(0.5)")
print(stripes.fit())

# %% A separate analysis for every measure
ims = ["pga", "pgv", "pgd", "arias", "cav", "hi", "sa(0.2)", "sa(0.5)", "sa(1)", "saavg(0.2:2)"]
comparison = dd.compare_intensities(wall, records, ims)
print(comparison)
comparison.plot().figure.savefig(out / "intensity_measures.png")
