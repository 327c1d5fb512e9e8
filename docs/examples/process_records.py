"""Baseline, filter, time step, length and direction of records: every step is documented in the new record."""

# %%
from pathlib import Path

import dondolo as dd

data = Path(__file__).resolve().parents[2] / "data"
out = Path("out/examples")
out.mkdir(parents=True, exist_ok=True)

# %% Two horizontal components of a synthetic motion, the first with an offset
records = dd.read_catalogue(data / "records" / "synthetic44.csv")
first, second = (record for record in records if "friuli_1976_sep_15" in record.name)
first = first.processed(first.acceleration + 0.02, "zero shifted by 0.02 m/s2")

# %% Records are never corrected implicitly; explicit processing is documented in the record
clean = first.correct_baseline().band_pass(low=0.1, high=25.0).trim()
print(clean)
print(*clean.processing, sep="\n")

# %% Half the time step changes nothing, since the motion is linear between samples; 0.01 s requires a filter
wall = dd.OneSidedWall(height=1.5, thickness=0.25, name="parapet")
for record in (first, first.resample(0.0025), first.resample(0.01)):
    print(f"EDP {dd.simulate(wall, record, scale=2.0).edp:.6f}", *record.processing[1:])

# %% A facade responds to the component along its normal, here at 30 degrees from the first component
normal = first.rotate(second, 30.0)
print(dd.simulate(wall, normal, scale=2.0))

# %% Median and largest value over all directions, of the peak acceleration and of the EDP of a two-sided wall
peaks = first.rotd(second)
print(f"PGA: RotD50 {peaks.rotd50:.3f}, RotD100 {peaks.rotd100:.3f} g at {peaks.angle:.0f} degrees")
pinnacle = dd.FreeStandingWall(height=1.8, thickness=0.45, name="pinnacle")
rocking = first.rotd(second, lambda record: dd.simulate(pinnacle, record, 1.5, history=False).edp, n_angles=36)
print(f"EDP: RotD50 {rocking.rotd50:.3f}, RotD100 {rocking.rotd100:.3f} at {rocking.angle:.0f} degrees")

# %%
ax = dd.simulate(wall, clean, scale=2.0).plot()
ax.figure.savefig(out / "process_records.png")
