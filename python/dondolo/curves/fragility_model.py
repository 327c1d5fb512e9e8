"""Fragility models as OpenQuake keeps them, NRML 0.5 (dondolo.curves.nrml has the format, nrml_reader reads them).

A continuous function has mean and standard deviation of the intensity, from which theta and beta follow but for
rounding. So that what is written is read again to the bit, dondolo writes theta and beta in a comment above them, which
is believed where they give this mean and standard deviation.
"""

from __future__ import annotations

import os
from dataclasses import dataclass, field
from xml.etree import ElementTree

import numpy as np

from dondolo._base.shown import Shown
from dondolo._fortran.origins import check_replaced, derived_mark
from dondolo._storage import tables
from dondolo._storage.saved import Saved
from dondolo.curves.discrete import DiscreteFragility
from dondolo.curves.fragility import Fragility
from dondolo.curves.limited import Limits, limited
from dondolo.hazard.openquake import imt_of, times

NAMESPACE = "http://openquake.org/xmlns/nrml/0.5"
LIMITS = ("noDamageLimit", "minIML", "maxIML")


Function = Fragility | DiscreteFragility


@dataclass(frozen=True, eq=False, repr=False, kw_only=True)
class FragilityModel(Shown, Saved):
    """A fragility model of OpenQuake, as `read_nrml` reads it.

    Attributes
    ----------
    functions : dict of dict
        Taxonomy -> limit state -> `Fragility` (continuous) or `DiscreteFragility`, as `write_nrml` takes them; the
        limits of the function are applied to its curves.
    limits : dict
        Taxonomy -> (no_damage_limit, min_iml, max_iml) in the unit of the curves' levels; None where not given.
    id, description, asset_category, loss_category : str
    imts : dict
        Taxonomy -> OpenQuake's measure, of those functions whose measure in dondolo does not give it ('AvgSA').
    """

    functions: dict[str, dict[str, Function]]
    limits: dict[str, Limits]
    id: str
    description: str
    asset_category: str
    loss_category: str
    imts: dict[str, str] = field(default_factory=dict)

    def __post_init__(self) -> None:
        # One place for models that are read, made and loaded
        functions = {
            taxonomy: {state: _with_limits(curve, self.limits[taxonomy]) for state, curve in curves.items()}
            for taxonomy, curves in self.functions.items()
        }
        object.__setattr__(self, "functions", functions)
        super().__post_init__()

    def write(self, path: str | os.PathLike[str], *, run: str = "") -> None:
        """Write the model, NRML 0.5; the file appears whole or not at all.

        Parameters
        ----------
        path : path
            The file; its folder must exist. An earlier model of dondolo is replaced, any other file is not.
        run : str
            Name of the run whose curves they are, which the file then gives.

        Raises
        ------
        InputError
            A file that is no model of dondolo.
        DondoloError
            The file cannot be written.

        Examples
        --------
        >>> import dondolo as dd
        >>> dd.Fragility.of_parameters(0.8, 0.4, im="pga").to_nrml("one.xml")
        >>> dd.read_nrml("one.xml").write("copy.xml")
        """
        check_replaced(path, "model")
        root = ElementTree.Element("nrml", {"xmlns": NAMESPACE})
        attributes = {"id": self.id, "assetCategory": self.asset_category, "lossCategory": self.loss_category}
        model = ElementTree.SubElement(root, "fragilityModel", attributes)
        ElementTree.SubElement(model, "description").text = self.description
        ElementTree.SubElement(model, "limitStates").text = " ".join(next(iter(self.functions.values())))
        for taxonomy, curves in self.functions.items():
            _append(model, taxonomy, curves, self.limits[taxonomy], self.imts.get(taxonomy))
        ElementTree.indent(root)
        head = ["<?xml version='1.0' encoding='utf-8'?>", f"<!-- {derived_mark('model', run)} -->"]
        tables.write_lines(path, [*head, ElementTree.tostring(root, encoding="unicode")])

    def _facts(self) -> list[tuple[str, str]]:
        first = next(iter(self.functions.values()))
        states = ", ".join(first)
        return [("id", self.id), ("functions", str(len(self.functions))), ("limit states", states)]


def _with_limits(curve: Function, limits: Limits) -> Function:
    """A curve with the limits of its function."""
    if isinstance(curve, Fragility):
        return limited(curve, limits)
    if curve.no_damage_limit == limits.no_damage_limit:
        return curve
    return DiscreteFragility(curve.levels, curve.probability, im=curve.im, no_damage_limit=limits.no_damage_limit)


def _append(
    model: ElementTree.Element, taxonomy: str, curves: dict[str, Function], limits: Limits, name: str | None
) -> None:
    """Add a function."""
    first = next(iter(curves.values()))
    imt, unit = imt_of(first.im, name)
    given = {name: times(value, unit) for name, value in zip(LIMITS, limits, strict=True) if value is not None}
    continuous = isinstance(first, Fragility)
    kind = {"format": "continuous", "shape": "logncdf"} if continuous else {"format": "discrete"}
    function = ElementTree.SubElement(model, "fragilityFunction", {"id": taxonomy, **kind})
    imls = ElementTree.Element("imls", {"imt": imt, **given})
    if name is not None:
        # The engine skips comments anywhere but before the first element of a function.
        model.insert(len(model) - 1, ElementTree.Comment(f" {imt} of the next function: im = {first.im} "))
    function.append(imls)
    if isinstance(first, DiscreteFragility):
        imls.text = " ".join(times(level, unit) for level in first.levels)
    for state, curve in curves.items():
        if isinstance(curve, Fragility):
            function.append(ElementTree.Comment(f" theta = {float(curve.theta)!r}, beta = {float(curve.beta)!r} "))
            mean, deviation = (times(value, unit) for value in moments(curve.theta, curve.beta))
            ElementTree.SubElement(function, "params", {"ls": state, "mean": mean, "stddev": deviation})
        else:
            poes = ElementTree.SubElement(function, "poes", {"ls": state})
            poes.text = " ".join(times(p, 1) for p in curve.probability)


def moments(theta: float, beta: float) -> tuple[float, float]:
    """Mean and standard deviation of the lognormal distribution with a median and a dispersion."""
    with np.errstate(over="ignore", invalid="ignore"):
        mean = float(theta * np.exp(0.5 * beta * beta))
        return mean, float(mean * np.sqrt(np.expm1(beta * beta)))
