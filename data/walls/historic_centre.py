"""Make historic_centre.csv, an illustrative population of walls, again: python data/walls/historic_centre.py [FOLDER].

Nothing in it was surveyed. Ranges are those of ordinary brick building in Italian centres; what depends on a building's
upkeep - probabilities of occurrence, weights - is assumed, and said to be so at the head of the table.
"""

import sys
from dataclasses import replace
from pathlib import Path

import numpy as np

import dondolo as dd

SEED = 1348

ORIGIN = (
    "An ILLUSTRATIVE historic centre of brick. No wall in it was surveyed: surveyed data of centres such as Ferrara",
    "are not public. Do not use it for decisions: put walls of your own in its place.",
    "Lengths in m, density in kg/m3, overburden in N per metre of wall. The weight is the number of such walls.",
    "Thickness is that of bricks of 0.25 m laid one, one and a half and two bricks thick, 0.12 m a single leaf.",
    "one_sided: the facade over all its storeys, or what stands free above them, overturns on its base.",
    "two_block: the top storey, held at its floors, folds outwards or inwards; it carries the load of the roof.",
    "Both can happen to the same facade; p_occ follows from how it is held (assumed): neither tie rods nor anchored",
    "floors 0.8 and 0.15, tie rods or anchored floors in part 0.35 and 0.5, both throughout 0.05 and 0.8.",
    "restitution_factor: 0.84 to 0.90, the range of Graziotti and others (2016). Made by historic_centre.py:",
)


# Values as one would measure them: to the centimetre, 10 kg/m3, 100 N/m
def height_of_facade(samples):
    """All storeys."""
    return np.round(samples["storeys"] * height_of_storey(samples), 2)


def height_of_storey(samples):
    """From floor to floor."""
    return np.round(samples["storey"], 2)


def height_of_free_part(samples):
    """What stands free."""
    return np.round(samples["free"], 2)


def density(samples):
    """Of brickwork."""
    return 10.0 * np.round(samples["brickwork"] / 10.0)


def load_of_roof(samples):
    """On the top of the wall."""
    return 100.0 * np.round(samples["roof"] / 100.0)


def hinge(samples):
    """Share of the height."""
    return np.round(samples["crack"], 2)


def restitution_factor(samples):
    """Of a wall that folds."""
    return np.round(samples["factor"], 3)


def p_overturns(samples):
    """By how the facade is held, from not at all to well."""
    return np.array([0.8, 0.35, 0.05])[samples["held"].astype(int)]


def p_folds(samples):
    """By how the facade is held, from not at all to well."""
    return np.array([0.15, 0.5, 0.8])[samples["held"].astype(int)]


def facades(group, n, seed, weight, storeys, storey, thickness, held, roof):
    """Facades of one type of building, with both mechanisms."""
    return dd.Population.sample(
        {
            "one_sided": {"height": height_of_facade, "p_occ": p_overturns},
            "two_block": {
                "height": height_of_storey,
                "p_occ": p_folds,
                "hinge": hinge,
                "overburden": load_of_roof,
                "overburden_inertia": 0.0,
                "restitution": "sorrentino",
                "restitution_factor": restitution_factor,
            },
        },
        n_walls=n,
        seed=seed,
        variables={
            "storeys": storeys,
            "storey": storey,
            "held": dd.distributions.Choice((0, 1, 2), held),
            "brickwork": dd.distributions.Normal(1800.0, 80.0, low=1600.0, high=2000.0),
            "roof": roof,
            "crack": dd.distributions.Triangular(0.5, 0.6, 0.75),
            "factor": dd.distributions.Uniform(0.84, 0.90),
        },
        correlation={("storeys", "thickness"): 0.5, ("storey", "thickness"): 0.3},
        weight=weight,
        group=group,
        thickness=thickness,
        density=density,
    )


def free_parts(group, n, seed, weight, free, thickness):
    """What stands free above the roof: it overturns."""
    return dd.Population.sample(
        "one_sided",
        n_walls=n,
        seed=seed,
        variables={"free": free, "brickwork": dd.distributions.Normal(1800.0, 80.0, low=1600.0, high=2000.0)},
        correlation={("free", "thickness"): 0.5},
        weight=weight,
        group=group,
        height=height_of_free_part,
        thickness=thickness,
        density=density,
    )


def centre():
    """The whole population."""
    population = (
        facades(
            "row houses",
            n=90,
            seed=SEED,
            weight=12,
            storeys=dd.distributions.Choice((2, 3), (0.6, 0.4)),
            storey=dd.distributions.Lognormal(3.0, 0.06, low=2.8, high=3.5),
            thickness=dd.distributions.Choice((0.25, 0.38), (0.45, 0.55)),
            held=(0.35, 0.45, 0.2),
            roof=dd.distributions.Uniform(1000.0, 4000.0),
        )
        + facades(
            "town houses",
            n=60,
            seed=SEED + 1,
            weight=6,
            storeys=dd.distributions.Choice((3, 4), (0.7, 0.3)),
            storey=dd.distributions.Lognormal(3.3, 0.08, low=2.9, high=4.0),
            thickness=dd.distributions.Choice((0.38, 0.51), (0.6, 0.4)),
            held=(0.25, 0.45, 0.3),
            roof=dd.distributions.Uniform(2000.0, 6000.0),
        )
        + facades(
            "palaces",
            n=30,
            seed=SEED + 2,
            weight=2,
            storeys=dd.distributions.Choice((2, 3), (0.5, 0.5)),
            storey=dd.distributions.Uniform(3.8, 4.5),
            thickness=dd.distributions.Choice((0.38, 0.51), (0.25, 0.75)),
            held=(0.15, 0.45, 0.4),
            roof=dd.distributions.Uniform(3000.0, 8000.0),
        )
        + free_parts(
            "gables",
            n=30,
            seed=SEED + 3,
            weight=8,
            free=dd.distributions.Triangular(1.2, 2.0, 3.5),
            thickness=dd.distributions.Choice((0.25, 0.38), (0.7, 0.3)),
        )
        + free_parts(
            "parapets",
            n=30,
            seed=SEED + 4,
            weight=10,
            free=dd.distributions.Triangular(0.6, 0.9, 1.5),
            thickness=dd.distributions.Choice((0.12, 0.25), (0.3, 0.7)),
        )
    )
    return replace(population, origin=(*ORIGIN, *population.origin))


if __name__ == "__main__":
    folder = Path(sys.argv[1]) if len(sys.argv) > 1 else Path(__file__).parent
    centre().to_csv(folder / "historic_centre.csv")
