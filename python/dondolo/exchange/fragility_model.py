"""Fragility models as OpenQuake keeps them: NRML 0.5, written and read (dondolo.exchange.nrml has the format).

A continuous function has mean and standard deviation of the intensity, from which theta and beta follow but for
rounding. So that what is written is read again to the bit, dondolo writes theta and beta in a comment above them, which
is believed where they give this mean and standard deviation.
"""

from __future__ import annotations

import os
import re
from dataclasses import dataclass
from itertools import pairwise
from typing import Any, NamedTuple
from xml.etree import ElementTree

import numpy as np
from numpy.typing import ArrayLike

from dondolo._base.arguments import FloatArray, as_array, increasing
from dondolo._base.files import as_file, check_replaced, read_text
from dondolo._base.shown import Shown
from dondolo._fortran.library import constants
from dondolo._fortran.records import blank_unit, describe_measure
from dondolo._storage import tables
from dondolo._storage.saved import Saved, part_of_results
from dondolo.curves.fragility import Fragility
from dondolo.errors import InputError
from dondolo.risk.openquake import im_of, imt_of, over, times

NAMESPACE = "http://openquake.org/xmlns/nrml/0.5"
#: What stands in the second line of every file of dondolo
MARK = "<!-- dondolo "
_LIMITS = ("noDamageLimit", "minIML", "maxIML")
_PARAMETERS = re.compile(r"\s*theta = (\S+), beta = (\S+)\s*")


@dataclass(frozen=True, eq=False, init=False, repr=False)
class DiscreteFragility(Shown, Saved):
    """A fragility curve as probabilities at levels, such as the mean of a typology.

    Parameters
    ----------
    levels : array_like, shape (levels,)
        Levels of intensity, positive and increasing; at least two.
    probability : array_like, shape (levels,)
        Of reaching the state, between 0 and 1, not decreasing.
    im : str
        Intensity measure.

    Examples
    --------
    >>> import dondolo as dd
    >>> curve = dd.DiscreteFragility([0.1, 0.2, 0.4], [0.0, 0.25, 0.75])
    """

    levels: FloatArray
    probability: FloatArray
    im: str

    def __init__(self, levels: ArrayLike, probability: ArrayLike, *, im: str = "pga") -> None:
        x = increasing("levels", levels)
        p = as_array("probability", probability).copy()
        if len(x) != len(p):
            raise InputError(f"{len(x)} levels, {len(p)} probabilities: must be as many")
        if not np.all((p >= 0.0) & (p <= 1.0)):
            raise InputError(f"probability = {p[~((p >= 0.0) & (p <= 1.0))][0]:g}: must lie between 0 and 1")
        if np.any(np.diff(p) < 0.0):
            i = int(np.argmax(np.diff(p) < 0.0))
            raise InputError(f"probability = {p[i]:g}, {p[i + 1]:g}: must not decrease with the level")
        p.flags.writeable = False
        for what, value in (("levels", x), ("probability", p), ("im", describe_measure(im).name)):
            object.__setattr__(self, what, value)

    def _facts(self) -> list[tuple[str, str]]:
        unit = blank_unit(self.im)
        ends = f"{self.levels[0]:.4g} to {self.levels[-1]:.4g}{unit}"
        chances = f"{self.probability[0]:.4g} to {self.probability[-1]:.4g}"
        return [("levels", f"{len(self.levels)} of {self.im}, {ends}"), ("probability", chances)]


Curve = Fragility | DiscreteFragility


@part_of_results
class Limits(NamedTuple):
    """Where a function counts, in the unit of its levels; None: not given.

    Attributes
    ----------
    no_damage_limit : float or None
        Intensity up to which there is no damage.
    min_iml, max_iml : float or None
        Range of a continuous function, constant beyond; None for a discrete one.
    """

    no_damage_limit: float | None = None
    min_iml: float | None = None
    max_iml: float | None = None


@dataclass(frozen=True, eq=False, repr=False, kw_only=True)
class FragilityModel(Shown, Saved):
    """A fragility model of OpenQuake, as `read_nrml` reads it.

    Attributes
    ----------
    functions : dict of dict
        Taxonomy -> limit state -> `Fragility` (continuous) or `DiscreteFragility`, as `write_nrml` takes them.
    limits : dict
        Taxonomy -> (no_damage_limit, min_iml, max_iml) in the unit of the curves' levels; None where not given.
    id, description, asset_category, loss_category : str
    """

    functions: dict[str, dict[str, Curve]]
    limits: dict[str, Limits]
    id: str
    description: str
    asset_category: str
    loss_category: str

    def write(self, path: str | os.PathLike[str]) -> None:
        """Write the model, NRML 0.5; the file appears whole or not at all.

        Parameters
        ----------
        path : path
            The file; its folder must exist. An earlier model of dondolo is replaced, any other file is not.

        Raises
        ------
        InputError
            A file that is no model of dondolo.
        DondoloError
            The file cannot be written.
        """
        check_replaced(path, MARK, "fragility model")
        root = ElementTree.Element("nrml", {"xmlns": NAMESPACE})
        attributes = {"id": self.id, "assetCategory": self.asset_category, "lossCategory": self.loss_category}
        model = ElementTree.SubElement(root, "fragilityModel", attributes)
        ElementTree.SubElement(model, "description").text = self.description
        ElementTree.SubElement(model, "limitStates").text = " ".join(next(iter(self.functions.values())))
        for taxonomy, curves in self.functions.items():
            _append(model, taxonomy, curves, self.limits[taxonomy])
        ElementTree.indent(root)
        head = ["<?xml version='1.0' encoding='utf-8'?>", f"{MARK}{constants().version} -->"]
        tables.write_lines(path, [*head, ElementTree.tostring(root, encoding="unicode")])

    def _facts(self) -> list[tuple[str, str]]:
        first = next(iter(self.functions.values()))
        states = ", ".join(first)
        return [("id", self.id), ("functions", str(len(self.functions))), ("limit states", states)]


def _append(model: ElementTree.Element, taxonomy: str, curves: dict[str, Curve], limits: Limits) -> None:
    """Add a function."""
    first = next(iter(curves.values()))
    imt, unit = imt_of(first.im)
    given = {name: times(value, unit) for name, value in zip(_LIMITS, limits, strict=True) if value is not None}
    continuous = isinstance(first, Fragility)
    kind = {"format": "continuous", "shape": "logncdf"} if continuous else {"format": "discrete"}
    function = ElementTree.SubElement(model, "fragilityFunction", {"id": taxonomy, **kind})
    imls = ElementTree.SubElement(function, "imls", {"imt": imt, **given})
    if isinstance(first, DiscreteFragility):
        imls.text = " ".join(times(level, unit) for level in first.levels)
    for state, curve in curves.items():
        if isinstance(curve, Fragility):
            function.append(ElementTree.Comment(f" theta = {float(curve.theta)!r}, beta = {float(curve.beta)!r} "))
            mean, deviation = (times(value, unit) for value in _moments(curve.theta, curve.beta))
            ElementTree.SubElement(function, "params", {"ls": state, "mean": mean, "stddev": deviation})
        else:
            poes = ElementTree.SubElement(function, "poes", {"ls": state})
            poes.text = " ".join(times(p, 1) for p in curve.probability)


def _moments(theta: float, beta: float) -> tuple[float, float]:
    """Mean and standard deviation of the lognormal distribution with a median and a dispersion."""
    mean = float(theta * np.exp(0.5 * beta**2))
    return mean, float(mean * np.sqrt(np.expm1(beta**2)))


def read_nrml(path: str | os.PathLike[str]) -> FragilityModel:
    """Read a fragility model of OpenQuake, NRML 0.5.

    Parameters
    ----------
    path : path
        The file.

    Returns
    -------
    FragilityModel
        Continuous functions as `Fragility` without standard errors, discrete ones as `DiscreteFragility`. A model of
        dondolo gives the curves that were written, equal to the bit.

    Raises
    ------
    InputError
        The file cannot be read, is no such model, or has a measure that dondolo does not know.

    Examples
    --------
    >>> import dondolo as dd
    >>> curve = dd.fit_fragility([0.2, 0.4], [11, 33], 44, im="pga")
    >>> dd.write_nrml("fragility.xml", {"parapets": {"collapse": curve}})
    >>> dd.read_nrml("fragility.xml").functions["parapets"]["collapse"].theta == curve.theta
    True
    """
    source = as_file("path", path)
    text = read_text(source)
    try:
        parser = ElementTree.XMLParser(target=ElementTree.TreeBuilder(insert_comments=True))
        root = ElementTree.fromstring(text, parser)
    except (ElementTree.ParseError, ValueError) as error:
        raise InputError(f"{source}: is no XML: {error}") from None
    try:
        return _model(root)
    except InputError as error:
        raise InputError(f"{source}: {error}") from None


def _model(root: ElementTree.Element) -> FragilityModel:
    version = re.fullmatch(r"\{http://openquake\.org/xmlns/nrml/([\d.]+)\}nrml", str(root.tag))
    if not version:
        raise InputError("is no NRML: must begin with the element nrml of OpenQuake")
    if version.group(1) != "0.5":
        raise InputError(f"is NRML {version.group(1)}: must be 0.5, into which 'oq upgrade_nrml' turns it")
    models = _children(root, "fragilityModel")
    if len(models) != 1:
        raise InputError(f"must have one fragilityModel, there are {len(models)}")
    (model,) = models
    states = _text(model, "limitStates").split()
    if not states or len(set(states)) < len(states):
        raise InputError("limitStates: must be names, each once")
    functions: dict[str, dict[str, Curve]] = {}
    limits: dict[str, Limits] = {}
    for function in _children(model, "fragilityFunction"):
        taxonomy = _attribute(function, "id")
        if taxonomy in functions:
            raise InputError(f"fragilityFunction '{taxonomy}': is a duplicate")
        try:
            functions[taxonomy], limits[taxonomy] = _function(function, states)
        except InputError as error:
            raise InputError(f"fragilityFunction '{taxonomy}': {error}") from None
    if not functions:
        raise InputError("must have a fragilityFunction")
    return FragilityModel(
        functions=functions,
        limits=limits,
        id=_attribute(model, "id"),
        description=" ".join(_text(model, "description").split()),
        asset_category=_attribute(model, "assetCategory"),
        loss_category=_attribute(model, "lossCategory"),
    )


def _function(function: ElementTree.Element, states: list[str]) -> tuple[dict[str, Curve], Limits]:
    """The curves of a function, and its limits."""
    kind = _attribute(function, "format")
    if kind not in ("continuous", "discrete"):
        raise InputError(f"format = '{kind}': must be continuous or discrete")
    of_levels = _children(function, "imls")
    if len(of_levels) != 1:
        raise InputError(f"must have one imls, there are {len(of_levels)}")
    (imls,) = of_levels
    im, unit = im_of(_attribute(imls, "imt"))
    given = {name: over(_checked(name, imls.attrib[name]), unit) for name in _LIMITS if name in imls.attrib}
    limits = Limits(*(given.get(name) for name in _LIMITS))
    rows = _children(function, "params" if kind == "continuous" else "poes")
    names = [_attribute(row, "ls") for row in rows]
    if names != states:
        raise InputError(f"has the limit states {' '.join(names)}: must be {' '.join(states)}")
    if kind == "continuous":
        if function.get("shape", "logncdf") != "logncdf":
            raise InputError(f"shape = '{function.get('shape')}': must be logncdf")
        if limits.min_iml is None or limits.max_iml is None:
            raise InputError("imls: must have minIML and maxIML")
        told = _told(function)
        return {
            state: _lognormal(row, told.get(id(row)), im, unit) for state, row in zip(names, rows, strict=True)
        }, limits
    levels = [over(_checked("imls", word), unit) for word in (imls.text or "").split()]
    curves: dict[str, Curve] = {}
    for state, row in zip(names, rows, strict=True):
        chances = [float(_checked("poes", word)) for word in (row.text or "").split()]
        try:
            curves[state] = DiscreteFragility(levels, chances, im=im)
        except InputError as error:
            raise InputError(f"limit state '{state}': {error}") from None
    return curves, limits


def _told(function: ElementTree.Element) -> dict[int, str]:
    """Comments just above elements."""
    comment: Any = ElementTree.Comment
    return {id(after): before.text or "" for before, after in pairwise(function) if before.tag is comment}


def _lognormal(row: ElementTree.Element, comment: str | None, im: str, unit: int) -> Fragility:
    """The curve with a mean and a standard deviation."""
    words = [_checked(name, _attribute(row, name)) for name in ("mean", "stddev")]
    mean, deviation = (over(word, unit) for word in words)
    if not (0.0 < mean < np.inf and 0.0 < deviation < np.inf):
        raise InputError(f"mean = {words[0]}, stddev = {words[1]}: must be positive")
    found = _PARAMETERS.fullmatch(comment or "")
    if found:
        theta, beta = (float(_checked("comment", word)) for word in found.groups())
        if _moments(theta, beta) == (mean, deviation):
            return Fragility.of_parameters(theta, beta, im=im)
    ratio = deviation / mean
    return Fragility.of_parameters(mean / float(np.hypot(1.0, ratio)), float(np.sqrt(np.log1p(ratio**2))), im=im)


def _children(element: ElementTree.Element, name: str) -> list[ElementTree.Element]:
    return element.findall(f"{{{NAMESPACE}}}{name}")


def _text(element: ElementTree.Element, name: str) -> str:
    """Text of the child of a name."""
    found = element.find(f"{{{NAMESPACE}}}{name}")
    if found is None:
        raise InputError(f"must have {name}")
    return "".join(found.itertext())


def _attribute(element: ElementTree.Element, name: str) -> str:
    value = element.get(name)
    if not value:
        raise InputError(f"{str(element.tag).rpartition('}')[2]}: must have {name}")
    return value


def _checked(name: str, word: str) -> str:
    """A text that is a finite number, not negative."""
    try:
        value: Any = float(word)
    except ValueError:
        value = np.nan
    if not 0.0 <= value < np.inf:
        raise InputError(f"{name} = '{word}': must be a number, not negative")
    return word
