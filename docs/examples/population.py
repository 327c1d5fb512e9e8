"""Typological curve of a population of walls (figure 5 of Nale et al.)."""

# %%
from pathlib import Path

import numpy as np

import dondolo as dd

data = Path(__file__).resolve().parents[2] / "data"
out = Path("out/examples")
out.mkdir(parents=True, exist_ok=True)

# %% 24 types of walls of a fictitious historic centre; the weight is the number of walls of each type
population = dd.Population.from_csv(data / "walls" / "population.csv")
print(population)

# %% Analysis of each wall under the synthetic suite
records = dd.read_catalogue(data / "records" / "synthetic44.csv")
centre = dd.typology(population, records, levels=np.linspace(0.2, 2.0, 10))
print(centre)
print(f"P(collapse | 0.5 g) of a wall of this centre: {centre['all'](0.5):.3f}")

# %% Tables: CSV, or a DataFrame if pandas is installed
centre.to_csv(out / "population_fragility.csv", table="fragility")

# %%
centre.plot().figure.savefig(out / "population.png")
