"""A facade, its fragility, its check by NTC 2018, and the probability of collapse at the check's PGA."""

# %%
from pathlib import Path

import dondolo as dd

data = Path(__file__).resolve().parents[2] / "data"
out = Path("out/examples")
out.mkdir(parents=True, exist_ok=True)

# %% Three floors that go with a facade of 9 m
floors = [dd.Load(load, depth=0.4, height=height, inertia="both") for load, height in ((8e3, 3), (8e3, 6), (5e3, 9))]
wall = dd.OneSidedWall(9.0, 0.5, loads=floors)
site = dd.Site(ag=0.2, f0=2.5, tc_star=0.35, soil="B")
check = dd.check_ntc(wall, site, knowledge_factor=1.35)
records = dd.read_catalogue(data / "records" / "synthetic44.csv")
stripes = dd.multiple_stripe(wall, records, levels=[0.1, 0.2, check.pga, 0.3, 0.4, 0.5, 0.6, 0.8, 1.0])
check = check.dynamic(stripes)
curve = stripes.fit()
print(check)
print(f"P(collapse at {check.pga:.3g} g) = {curve(check.pga):.3g}")
check.plot(curve=curve).figure.savefig(out / "code_check.png")
check.to_csv(out / "code_check.csv")
dd.report(stripes, out / "code_check.html", check=check)
