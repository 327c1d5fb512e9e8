"""From the hazard and the spectrum of a site to an annual frequency of collapse with its interval.

The site and its hazard are invented. Records are embedded synthetic ones: few, and scaled far. For a study take
recorded accelerograms, the hazard of the site, and a median spectrum and dispersion of a ground motion model.
"""

# %%
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

import dondolo as dd

data = Path(__file__).resolve().parents[2] / "data"
out = Path("out/examples")
out.mkdir(parents=True, exist_ok=True)

# %% The site: frequencies at which Sa(0.3 s) is exceeded, with fractiles, and the shape of the spectrum
sa = [0.05, 0.1, 0.2, 0.4, 0.8, 1.6, 3.2, 6.4]
mean = np.array([0.06, 0.025, 8e-3, 2e-3, 3.5e-4, 4e-5, 3e-6, 1.5e-7])
hazard = dd.HazardCurve(sa, mean, im="sa(0.3)", fractiles={0.16: 0.5 * mean, 0.5: 0.85 * mean, 0.84: 1.5 * mean})
code = dd.Site(0.26, 2.36, 0.35, soil="B").spectrum(periods=np.geomspace(0.1, 2.0, 20))
spectrum = dd.TargetSpectrum(code.periods, code.sa, dispersion=0.6)

# %% Records of their own for each level, which match the spectrum conditional on it
records = dd.RecordSet(dd.read_catalogue(data / "records" / "synthetic44.csv")).filter("magnitude >= 5.5")
targets = {level: spectrum.conditional(0.3, level) for level in (0.6, 1.0, 1.4, 1.8, 2.4, 3.2)}
chosen = {level: dd.RecordSet(records).select(target, 20, max_factor=40.0) for level, target in targets.items()}
for level, selection in chosen.items():
    print(f"Sa(0.3 s) = {level} g:", selection)

# %% Stripes, fragility with a clustered interval, annual frequency with its own
wall = dd.OneSidedWall(height=2.0, thickness=0.3, name="gable")
stripes = dd.multiple_stripe(wall, {level: one.records for level, one in chosen.items()}, im="sa(0.3)")
curve = stripes.fit()
risk = curve.risk(hazard)
spread = risk.uncertainty()
print(curve, curve.parameter_interval(), risk, spread, sep="\n")
print(f"{risk.dominant_level:.2g} g contribute most; shares between the levels of the hazard:")
print(np.round(risk.deaggregate(hazard.levels) / risk.annual_frequency, 3))

# %%
figure, axes = plt.subplots(2, 2, figsize=(11.0, 8.0), layout="constrained")
chosen[1.4].plot(axes[0, 0])
for draw, ax in zip((curve.plot, risk.plot_deaggregation, spread.plot), axes.flat[1:], strict=True):
    draw(ax)
figure.savefig(out / "site_risk.png")
