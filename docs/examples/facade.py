"""A facade with a hinge at every floor: fragility in the same histories, checks, probabilities at the check's PGA."""

# %%
from pathlib import Path

import dondolo as dd

data = Path(__file__).resolve().parents[2] / "data"
out = Path("out/examples")
out.mkdir(parents=True, exist_ok=True)

# %% The facade of the case facade_hinges, its records and levels
results = dd.run_case(data / "cases" / "facade_hinges.nml")
case, result = results.case, results.typology
union = result.unions["facade"]
for wall, curve in zip(case.population, result.curves, strict=True):
    check = dd.check_ntc(wall, case.site, knowledge_factor=case.knowledge_factor)
    print(f"{wall.name}: θ = {curve.theta:.3g} g, P at {check.pga:.3g} g = {curve(check.pga):.3g}")
    print(check)
print(f"any of them: θ = {union.theta:.3g} g, P at {check.pga:.3g} g = {union(check.pga):.3g}")
result.plot_union(name="facade").figure.savefig(out / "facade.png")
