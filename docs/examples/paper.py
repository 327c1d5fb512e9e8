"""The paper from end to end: its equations, and figures 2 to 5 of other walls and records (docs/paper.md)."""

# %%
import os
import sys
from pathlib import Path

import numpy as np
from matplotlib import pyplot as plt

import dondolo as dd

data = Path(__file__).resolve().parents[2] / "data"
out = Path("out/examples")
out.mkdir(parents=True, exist_ok=True)
small = "--small" in sys.argv[1:]

# %% Section 3.1. The paper does not list its 44 components: recorded ones, if the folder DONDOLO_RECORDS has them, else
# synthetic ones
recorded = Path(os.environ.get("DONDOLO_RECORDS", "")) / "italy44.csv"
is_recorded = recorded.is_file() and not small
records = dd.read_catalogue(recorded if is_recorded else data / "records" / "synthetic44.csv")
source = "44 components recorded in Italy" if is_recorded else "44 synthetic components"
print(f"section 3.1: {source}")

# %% Section 2.1, equations (1) and (2): against the formulas as printed
facade = dd.OneSidedWall(height=6.0, thickness=0.5, name="facade")
half, high, mass = 0.25, 3.0, 1800.0 * 6.0 * 0.5
radius, alpha = np.hypot(half, high), np.arctan2(half, high)
angle = 0.4 * alpha
terms = facade.terms(angle)
printed = {
    "I_0": 4.0 / 3.0 * mass * radius**2,
    "g M R sin(alpha - theta)": 9.81 * mass * radius * np.sin(alpha - angle),
    "M R cos(alpha - theta)": mass * radius * np.cos(alpha - angle),
}
mine = (terms.inertia, terms.restoring_moment, terms.excitation_lever)
for (name, value), term in zip(printed.items(), mine, strict=True):
    print(f"equation (1): {name} = {value:.15g}, dondolo differs by {float(term) / value - 1.0:.0e}")
eta = (1.0 - 1.5 * np.sin(alpha) ** 2) ** 2 * (1.0 - 1.5 * np.cos(alpha) ** 2)
print(f"equation (2): eta = {eta:.15g}, restitution e {facade.restitution_coefficient:.15g}")

# %% Section 2.2, equation (4): with the numerator as printed an impact creates energy; dondolo has it repaired
strip = dd.TwoBlockWall(height=3.0, thickness=0.25, hinge=0.6, restitution_factor=0.87, name="strip")


def equation_4(height: float, thickness: float, hinge: float, *, as_printed: bool) -> float:
    """Coefficient of restitution of two blocks, masses for a unit of density and thickness."""
    halves = 0.5 * thickness, 0.5 * hinge * height, 0.5 * (1.0 - hinge) * height
    m1, m2 = hinge, 1.0 - hinge
    a1, a2 = np.arctan2(halves[0], halves[1]), np.arctan2(halves[0], halves[2])
    r1, r2 = np.hypot(halves[0], halves[1]), np.hypot(halves[0], halves[2])
    i1, i2 = m1 * r1**2 / 3.0, m2 * r2**2 / 3.0
    ratio = np.tan(a2) / np.tan(a1)
    first = i1 * ratio if as_printed else i1 - i2 * ratio
    top = m2 * r1**2 * (2.0 + np.sin(a1) * np.cos(a1) / np.tan(a2) - np.sin(a1) ** 2 * (4.0 + ratio))
    bottom = m2 * r1**2 * (2.0 + np.sin(a1) * np.cos(a1) * (1.0 / np.tan(a2) + np.tan(a2)))
    above = m1 * r1**2 + first - 2.0 * m1 * r1**2 * np.sin(a1) ** 2 + top
    return float(above / (m1 * r1**2 + i1 - i2 * ratio + bottom))


whole = dd.TwoBlockWall(height=3.0, thickness=0.25, hinge=0.5)
print(f"equation (4), hinge at 0.5: as printed {equation_4(3.0, 0.25, 0.5, as_printed=True):.4f},", end=" ")
print(f"repaired {equation_4(3.0, 0.25, 0.5, as_printed=False):.15g}, dondolo {whole.restitution_coefficient:.15g}")

# %% Section 2, "4th-5th order Runge-Kutta": the engine rk45, and the engine lanes, which analyses take by default
levels = np.linspace(0.2, 2.0, 6 if small else 10)
by_engine = {}
for engine in ("rk45", "lanes"):
    solver = dd.Solver(engine=engine, rtol=1e-12, atol=1e-14)
    by_engine[engine] = dd.multiple_stripe(strip, records, levels, solver=solver, progress=False)
flags = int(np.sum(by_engine["rk45"].collapsed != by_engine["lanes"].collapsed))
edp, other = by_engine["rk45"].edp, by_engine["lanes"].edp
apart = np.abs(edp - other)[(edp > 0.0) & (edp < 1.0)]
print(f"engines: {flags} of {edp.size} flags differ; EDPs of {apart.size} that rock and survive", end=" ")
print(f"by {np.median(apart):.0e} in the median, {np.quantile(apart, 0.99):.0e} at 99 %")

# %% Figures 2 and 3: the two mechanisms, drawn to scale, and a motion of each
figure, axes = plt.subplots(2, 2, figsize=(9.0, 6.5), layout="constrained", width_ratios=(1.0, 2.2))
for (left, right), wall in zip(axes, (facade, strip), strict=True):
    wall.plot(left)
    response = dd.simulate(wall, records[0], scale=0.8 * 9.81 / np.abs(records[0].acceleration).max())
    right.plot(response.time, response.rotation / wall.capacity_angle, color="black", linewidth=0.8)
    right.set(xlabel="time, s", ylabel="rotation / capacity", title=f"{wall.name}, {records[0].name}, PGA 0.8 g")
    # From a second before it lifts to a second after it has come to rest
    moving = response.time[response.rotation != 0.0]
    right.set_xlim(max(moving[0] - 1.0, 0.0), moving[-1] + 1.0)
figure.savefig(out / "paper_figures_2_3.png", dpi=110)

# %% Section 3.3, figure 4: stripes, and the curve fitted to their fractions (equations (5) and (6))
stripes = dd.multiple_stripe(strip, records, levels, polarity="both", progress=False)
curve = stripes.fit()
print(f"figure 4: {curve}")
print(f"          levels {levels[0]:g} to {levels[-1]:g} g; {curve.goodness_of_fit(n_resamples=199)}")
figure, (left, right) = plt.subplots(1, 2, figsize=(9.0, 3.8), layout="constrained")
stripes.plot(left)
curve.plot(right)
figure.savefig(out / "paper_figure_4.png", dpi=110)

# %% Section 3.4, figure 5: curves of a population by mechanism, with their mean in red. The survey of Ferrara is not
# public: these walls are illustrative
population = dd.Population.from_csv(data / "walls" / ("population.csv" if small else "historic_centre.csv"))
centre = dd.typology(population, records, levels, progress=False)
figure, axes = plt.subplots(1, 2, figsize=(9.0, 3.8), layout="constrained", sharey=True)
for ax, mechanism in zip(axes, ("one_sided", "two_block"), strict=True):
    centre[mechanism].plot(ax)
    fit = centre[mechanism].fit
    at = centre[mechanism](0.5)
    print(f"figure 5, {mechanism}: theta {fit.theta:.3f} g, beta {fit.beta:.3f}, mean at 0.5 g {at:.3f}")
figure.savefig(out / "paper_figure_5.png", dpi=110)

# %% Section 4, "future research": the mechanisms combined by the probability that each occurs
print(f"typological curve of all mechanisms: {centre['all'](0.5):.3f} at 0.5 g, {centre['all'](1.0):.3f} at 1 g")
print(dd.cite(centre, curve).count("\n@") + 1, "sources, by dd.cite")
