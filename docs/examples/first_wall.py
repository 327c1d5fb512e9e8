"""A first wall: its properties, one time history, and its figures.

Run it as a script, or cell by cell (# %%) in an editor that supports notebooks. Figures are written to out/examples.
"""

# %%
from pathlib import Path

import dondolo as dd

data = Path(__file__).resolve().parents[2] / "data"
out = Path("out/examples")
out.mkdir(parents=True, exist_ok=True)

# %% A brick parapet that a roof or buttresses hold from behind, up to its top: it can only overturn outwards
wall = dd.OneSidedWall(height=1.5, thickness=0.25, name="parapet")
print(wall)
print(f"rocking starts at {wall.trigger_acceleration / wall.gravity:.3f} g")

# %% A synthetic accelerogram of the embedded suite, scaled by a factor of two
records = dd.read_catalogue(data / "records" / "synthetic44.csv")
record = next(record for record in records if "friuli_1976_sep_15" in record.name)
motion = dd.simulate(wall, record, scale=2.0)
print(motion)

# %% Plots of the time history, and of the wall at its peak
ax = motion.plot()
ax.figure.savefig(out / "first_wall_history.png")
motion.plot_peak().figure.savefig(out / "first_wall_peak.png")
