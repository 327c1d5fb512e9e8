"""A population of walls sampled from distributions, for a town without a survey of individual walls."""

# %%
from pathlib import Path

import numpy as np

import dondolo as dd

data = Path(__file__).resolve().parents[2] / "data"
out = Path("out/examples")
out.mkdir(parents=True, exist_ok=True)

# %% Facades of two or three storeys. They overturn as a whole if they are not tied, and their top storey folds if it is
# held by floors; p_occ is the probability of each case. Thickness and height of the storey are positively correlated.
facades = dd.Population.sample(
    {
        "one_sided": {"p_occ": 0.4, "height": lambda samples: samples["storeys"] * samples["storey"]},
        "two_block": {
            "p_occ": 0.6,
            "height": lambda samples: samples["storey"],
            "hinge": dd.distributions.Triangular(0.5, 0.6, 0.75),
            "overburden": dd.distributions.Uniform(2000.0, 6000.0),
            "overburden_inertia": 0.0,
            "restitution_factor": dd.distributions.Uniform(0.84, 0.90),
        },
    },
    n_walls=30,
    seed=1,
    variables={
        "storeys": dd.distributions.Choice((2, 3), (0.6, 0.4)),
        "storey": dd.distributions.Lognormal(3.2, 0.1, low=2.8, high=4.5),
    },
    thickness=dd.distributions.Choice((0.25, 0.38, 0.51), (0.2, 0.5, 0.3)),
    correlation={("storey", "thickness"): 0.5},
    group="facades",
    weight=20,
)
parapets = dd.Population.sample(
    "one_sided",
    n_walls=10,
    seed=2,
    height=dd.distributions.Triangular(0.6, 0.9, 1.5),
    thickness=dd.distributions.Choice((0.12, 0.25)),
    group="parapets",
    weight=45,
)
town = facades + parapets
print(town)

# %% The table for the executable; its header documents the sampling
town.to_csv(out / "town.csv")
assert dd.Population.from_csv(out / "town.csv").walls == town.walls

# %%
town.plot().figure.savefig(out / "sampled_population.png")

# %% Their fragility
records = dd.read_catalogue(data / "records" / "synthetic44.csv")
fragility = dd.typology(town, records, levels=np.linspace(0.2, 2.0, 10))
for mechanism in ("one_sided", "two_block"):
    print(mechanism, fragility[mechanism].fit)
