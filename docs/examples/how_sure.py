"""How sure is this curve? Records, restitution, hinge, density and numbers in one figure."""

# %%
import os
from pathlib import Path

import numpy as np

import dondolo as dd

data = Path(__file__).resolve().parents[2] / "data"
out = Path("out/examples")
out.mkdir(parents=True, exist_ok=True)

# %% Recorded accelerograms, if the folder DONDOLO_RECORDS has them, else the embedded synthetic ones
recorded = Path(os.environ.get("DONDOLO_RECORDS", "")) / "italy44.csv"
records = dd.read_catalogue(recorded if recorded.is_file() else data / "records" / "synthetic44.csv")

# %% A strip of facade between two floors, as a surveyor would give it; what he does not know are distributions
strip = dd.TwoBlockWall(3.0, 0.25, hinge=0.6, overburden=5000.0, overburden_inertia=0.0, name="strip")
sources = {
    "restitution_factor": "graziotti_2016",
    "hinge": dd.distributions.Triangular(0.5, 0.6, 0.75),
    "hinge_depth": dd.distributions.Lognormal(0.01, 0.4, high=0.05),
    "density": dd.distributions.Normal(1800.0, 90.0),
}
found = dd.propagate_uncertainty(strip, records, np.linspace(0.2, 3.0, 15), sources=sources, n_variants=400)
print(found)
found.to_csv(out / "how_sure.csv")
found.plot().figure.savefig(out / "how_sure.png", dpi=110)
