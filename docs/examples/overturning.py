"""Overturning spectrum: amplitudes and frequencies of a pulse that overturn a pinnacle (Zhang and Makris 2001)."""

# %%
from pathlib import Path

import numpy as np

import dondolo as dd

out = Path("out/examples")
out.mkdir(parents=True, exist_ok=True)

# %% A pulse is a record: 1 Hz, 0.4 g, chords within 1e-5 of the amplitude
pinnacle = dd.FreeStandingWall(height=1.8, thickness=0.45, name="pinnacle")
print(dd.simulate(pinnacle, dd.pulses.ricker(0.4, 1.0), solver=dd.Solver(edp_limit=5.0)))

# %% Scan of all amplitudes, since a stronger pulse may be safer
spectrum = dd.overturning_spectrum(
    pinnacle, dd.pulses.one_sine, frequencies=np.linspace(0.2, 3.0, 57), amplitudes=np.linspace(0.1, 2.4, 47)
)
print(spectrum)

# %% Amplitudes in g at which the state changes at 1 Hz; both ends of every bracket have been run
for boundary in spectrum.boundaries:
    if np.isclose(boundary.frequency, 1.0):
        print(f"{boundary.lower:.5f} {boundary.below.name:26} {boundary.upper:.5f} {boundary.above.name}")

# %% A pulse with more cycles: any function of amplitude and frequency that returns a record
near_fault = dd.overturning_spectrum(
    pinnacle,
    lambda amplitude, frequency: dd.pulses.mavroeidis_papageorgiou(amplitude, frequency, phase=90.0, gamma=2.5),
    frequencies=[0.5, 1.0, 2.0],
    amplitudes=np.linspace(0.1, 2.4, 24),
)
print(near_fault.overturned.any(axis=0))

# %%
spectrum.to_csv(out / "overturning_boundaries.csv", table="boundaries")
spectrum.plot().figure.savefig(out / "overturning.png")
