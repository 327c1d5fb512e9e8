"""Which tie for this facade? Designs of ties compared on the same records."""

# %%
import os
from pathlib import Path

import dondolo as dd

data = Path(__file__).resolve().parents[2] / "data"
out = Path("out/examples")
out.mkdir(parents=True, exist_ok=True)

# %% Recorded accelerograms, if the folder DONDOLO_RECORDS has them, else the embedded synthetic ones
recorded = Path(os.environ.get("DONDOLO_RECORDS", "")) / "italy44.csv"
records = dd.read_catalogue(recorded if recorded.is_file() else data / "records" / "synthetic44.csv")

# %% A facade of three storeys, with ties at its three floors: a bar of 12 mm every 4 m, 8 m long
tie = {"area": 2.8e-5, "length": 8.0, "strength": 1.8e8}
floors = (3.0, 6.0, 8.5)
designs = {
    "as it stands": dd.OneSidedWall(9.0, 0.5),
    "three ties, anchors give way": dd.OneSidedWall(
        9.0, 0.5, ties=[dd.Tie(floor, anchor_force=0.999 * 1.8e8 * 2.8e-5, **tie) for floor in floors]
    ),
    "three ties, strain 2 %": dd.OneSidedWall(9.0, 0.5, ties=[dd.Tie(floor, strain=0.02, **tie) for floor in floors]),
    "three ties, strain 10 %": dd.OneSidedWall(9.0, 0.5, ties=[dd.Tie(floor, strain=0.10, **tie) for floor in floors]),
}
levels = [0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 1.0, 1.2, 1.5, 2.0]
site = dd.Site(ag=0.2, f0=2.5, tc_star=0.35, soil="B")
found = dd.compare_designs(designs, records, levels, site=site)
print(found.to_frame().to_string())
found.plot().figure.savefig(out / "which_tie.png")
