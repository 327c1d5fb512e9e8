"""Walls of a run as the assets of OpenQuake, and the fragility functions that they have."""

from __future__ import annotations

import re
from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np

from dondolo._base.arguments import FloatArray, argument_error
from dondolo.curves.fragility_model import Function
from dondolo.errors import DondoloError
from dondolo.exchange.results import Results
from dondolo.hazard.openquake import as_written, coordinates_of
from dondolo.populations.nrml_functions import taxonomy_of
from dondolo.populations.typology import Typology

#: Functions of `write_nrml`
Functions = Mapping[str, Mapping[str, Function]]
#: Columns of a table of walls that the exposure model takes
PLACE, VALUE, OCCUPANTS = ("x_lon", "x_lat"), "x_value", "x_occupants"
# Longest identifier of an asset in the engine
_LONGEST = 50


class Assets(NamedTuple):
    """Assets of an exposure model: the walls, or facades, of a population.

    Attributes
    ----------
    ids, names, taxonomies : list of str
        Identifier in the engine, name of the wall, and class of the asset.
    places : ndarray, shape (assets, 2)
        Longitude and latitude [degrees].
    numbers : ndarray, shape (assets,)
        How many walls each asset is: its weight.
    values : ndarray, shape (assets,)
        Of all its walls together: `x_value`, or their number.
    occupants : ndarray, shape (assets,) or None
        Of all its walls together: `x_occupants`.
    risk_ids : dict of str
        Class -> name of its fragility function.
    """

    ids: list[str]
    names: list[str]
    taxonomies: list[str]
    places: FloatArray
    numbers: FloatArray
    values: FloatArray
    occupants: FloatArray | None
    risk_ids: dict[str, str]


def functions_of(results: Results) -> tuple[Functions, list[str]]:
    """Fragility functions of a run, and what there is to say of them.

    Raises
    ------
    DondoloError
        A wall without a curve.
    InputError
        A single motion, which has no curves.
    """
    if results.typology is not None:
        return results.typology.nrml_functions()
    if results.fragility is None:
        raise argument_error("wrong_type", "results", ": must have curves, and are those of a single motion")
    if not results.fragility.has_fit:
        raise DondoloError(f"has no curve (status '{results.fragility.status}')")
    return {taxonomy_of(results.population[0].name): {"collapse": results.fragility}}, []


def assets_of(results: Results, functions: Functions, site: Any) -> Assets:
    """The walls of a run as assets.

    Parameters
    ----------
    results : Results
        Of a population, a facade or a wall.
    functions : mapping of mappings
        Those of `functions_of`.
    site : (float, float) or None
        Longitude and latitude of walls whose table has none [degrees].

    Raises
    ------
    InputError
        Designs, which are alternatives; walls whose place is not known; notes that are no numbers.
    """
    people, typology = results.population, results.typology
    if typology is not None and typology.are_alternatives:
        raise argument_error(
            "wrong_type", "results", ": are those of designs of one wall, of which a town has one: run it alone"
        )
    first = people.first_rows
    names = [people.wholes[row] for row in first]
    groups = [people.group_names[row] for row in first]
    classes = _classes(typology, functions, groups)
    taxonomies = [classes[group][0] for group in groups]
    notes = {name: [texts[row] for row in first] for name, texts in people.notes.items()}
    numbers = np.asarray(people.weights)[first]
    kept = numbers > 0.0
    longitude, latitude = (_numbers(notes, column, names) for column in PLACE)
    if longitude is None or latitude is None:
        if site is None:
            raise argument_error(
                "not_given", "site", ": must be given (lon, lat), since the table of walls has no x_lon and x_lat"
            )
        places = np.tile(coordinates_of(site), (len(names), 1))
    else:
        places = np.stack([longitude, latitude], axis=1)
        for place in np.unique(places, axis=0):
            coordinates_of(tuple(place))
    values = _numbers(notes, VALUE, names)
    occupants = _numbers(notes, OCCUPANTS, names)
    return Assets(
        ids=[one for one, there in zip(_identifiers(names), kept, strict=True) if there],
        names=[one for one, there in zip(names, kept, strict=True) if there],
        taxonomies=[one for one, there in zip(taxonomies, kept, strict=True) if there],
        places=places[kept],
        numbers=numbers[kept],
        values=(numbers if values is None else values)[kept],
        occupants=None if occupants is None else occupants[kept],
        risk_ids=dict(classes.values()),
    )


def _classes(typology: Typology | None, functions: Functions, groups: list[str]) -> dict[str, tuple[str, str]]:
    """Group -> class of its assets, and their function: that of all mechanisms."""
    named = list(functions)
    if typology is None or len(named) == 1 or (typology.facade and typology.knows_unions):
        return dict.fromkeys(groups, (named[-1], named[-1]))
    last = {one.group: name for one, name in zip(typology.groups, named, strict=True)}
    found: dict[str, tuple[str, str]] = {}
    for group in dict.fromkeys(groups):
        plain = taxonomy_of(group or "population")
        taken = {taxonomy for taxonomy, _ in found.values()}
        options = (plain if k == 1 else f"{plain}_{k}" for k in range(1, len(groups) + 2))
        # The population's own function, where a group has no curve of its own
        found[group] = (next(name for name in options if name not in taken), last.get(group, last[""]))
    return found


def _numbers(notes: dict[str, list[str]], column: str, names: list[str]) -> FloatArray | None:
    """A column of notes as numbers; None without it."""
    if column not in notes:
        return None
    found = np.empty(len(names))
    for i, (name, text) in enumerate(zip(names, notes[column], strict=True)):
        try:
            found[i] = as_written(text)
        except ValueError:
            error = argument_error("not_a_number", column, f" = {text!r}: must be a number")
            raise error.placed(f"wall '{name}'") from None
        if column not in PLACE and found[i] < 0.0:
            error = argument_error("out_of_range", column, f" = {text}: must not be negative")
            raise error.placed(f"wall '{name}'")
    return found


def _identifiers(names: list[str]) -> list[str]:
    """Identifiers of assets: names in ASCII without other signs, each once."""
    taken: set[str] = set()
    found = []
    for number, name in enumerate(names, 1):
        plain = re.sub(r"[^A-Za-z0-9_:-]", "_", name)[:_LONGEST] or "wall"
        if plain in taken:
            plain = f"{plain[: _LONGEST - 8]}_{number}"
        taken.add(plain)
        found.append(plain)
    return found
