"""Fragility models as OpenQuake keeps them: NRML 0.5, written and read (dondolo.curves.nrml has the format).

A continuous function has mean and standard deviation of the intensity, from which theta and beta follow but for
rounding. So that what is written is read again to the bit, dondolo writes theta and beta in a comment above them, which
is believed where they give this mean and standard deviation.
"""

from __future__ import annotations

import os
import re
from dataclasses import dataclass
from itertools import pairwise
from typing import Any
from xml.etree import ElementTree

import numpy as np

from dondolo._base.arguments import argument_error
from dondolo._base.files import as_file, read_text
from dondolo._base.shown import Shown
from dondolo._fortran.library import warn
from dondolo._fortran.origins import check_replaced, derived_mark
from dondolo._storage import tables
from dondolo._storage.saved import Saved
from dondolo.curves.discrete import DiscreteFragility
from dondolo.curves.fragility import Fragility
from dondolo.curves.limited import Limits, limited
from dondolo.curves.state_order import disorder_at_levels, disorder_of_lognormals
from dondolo.errors import DondoloWarning, InputError
from dondolo.hazard.openquake import as_written, im_of, imt_of, over, times

NAMESPACE = "http://openquake.org/xmlns/nrml/0.5"
_LIMITS = ("noDamageLimit", "minIML", "maxIML")
# More than the format has, which is four
_DEEPEST = 100
_PARAMETERS = re.compile(r"\s*theta = (\S+), beta = (\S+)\s*")


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
    """

    functions: dict[str, dict[str, Function]]
    limits: dict[str, Limits]
    id: str
    description: str
    asset_category: str
    loss_category: str

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
            _append(model, taxonomy, curves, self.limits[taxonomy])
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


def _append(model: ElementTree.Element, taxonomy: str, curves: dict[str, Function], limits: Limits) -> None:
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
    with np.errstate(over="ignore", invalid="ignore"):
        mean = float(theta * np.exp(0.5 * beta * beta))
        return mean, float(mean * np.sqrt(np.expm1(beta * beta)))


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
        dondolo gives the parameters and probabilities that were written, equal to the bit. The limits of a function
        are applied to its curves: the probability is 0 up to noDamageLimit, and constant below minIML and above maxIML.

    Raises
    ------
    InputError
        The file cannot be read, is no such model, or has a measure that dondolo does not know; limits are in the wrong
        order; a more severe limit state is more probable throughout.

    Warns
    -----
    DondoloWarning
        Limit states cross; noDamageLimit is not below the levels of a discrete function.

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
        model, notes = _model(_parsed(text))
    except InputError as error:
        raise error.placed(str(source)) from None
    warn(one.placed(f"{source}: ") for one in notes)
    return model


class _Tree(ElementTree.TreeBuilder):
    """Builder of a tree that keeps comments, and refuses what only serves to exhaust a reader."""

    def __init__(self) -> None:
        super().__init__(insert_comments=True)
        self._depth = 0

    def start(self, tag: Any, attrs: Any) -> Any:
        self._depth += 1
        if self._depth > _DEEPEST:
            raise InputError(f"is nested more than {_DEEPEST} elements deep")
        return super().start(tag, attrs)

    def end(self, tag: Any) -> Any:
        self._depth -= 1
        return super().end(tag)

    def doctype(self, name: str, public: str | None, system: str | None) -> None:
        """Refuse entities, which may refer to other files, and expand to any length."""
        raise InputError("has a document type declaration (DOCTYPE), which NRML does not have")


def _parsed(text: str) -> ElementTree.Element:
    """The tree of a file."""
    try:
        return ElementTree.fromstring(text, ElementTree.XMLParser(target=_Tree()))
    except (ElementTree.ParseError, ValueError) as error:
        if isinstance(error, InputError):
            raise
        raise InputError(f"is not XML: {error}") from None


def _model(root: ElementTree.Element) -> tuple[FragilityModel, list[DondoloWarning]]:
    """The model, and what is doubtful about it."""
    version = re.fullmatch(r"\{http://openquake\.org/xmlns/nrml/([\d.]+)\}nrml", str(root.tag))
    if not version:
        raise InputError("is not NRML: must begin with the element nrml of OpenQuake")
    if version.group(1) != "0.5":
        raise InputError(f"is NRML {version.group(1)}: must be 0.5, into which 'oq upgrade_nrml' turns it")
    models = _children(root, "fragilityModel")
    if len(models) != 1:
        raise InputError(f"must have one fragilityModel, there are {len(models)}")
    (model,) = models
    states = _text(model, "limitStates").split()
    if not states or len(set(states)) < len(states):
        raise InputError("limitStates: must be names, each once")
    functions: dict[str, dict[str, Function]] = {}
    limits: dict[str, Limits] = {}
    notes: list[DondoloWarning] = []
    for function in _children(model, "fragilityFunction"):
        taxonomy = _attribute(function, "id")
        if taxonomy in functions:
            raise InputError(f"fragilityFunction '{taxonomy}': is a duplicate")
        try:
            functions[taxonomy], limits[taxonomy] = _function(function, states)
            doubt = _doubt(functions[taxonomy], limits[taxonomy])
        except InputError as error:
            raise error.placed(f"fragilityFunction '{taxonomy}'") from None
        if doubt is not None:
            notes.append(doubt.placed(f"fragilityFunction '{taxonomy}': "))
    if not functions:
        raise InputError("must have a fragilityFunction")
    made = FragilityModel(
        functions=functions,
        limits=limits,
        id=_attribute(model, "id"),
        description=" ".join(_text(model, "description").split()),
        asset_category=_attribute(model, "assetCategory"),
        loss_category=_attribute(model, "lossCategory"),
    )
    return made, notes


def _doubt(curves: dict[str, Function], limits: Limits) -> DondoloWarning | None:
    """A doubt about a function that `write_nrml` would refuse to write.

    Raises
    ------
    InputError
        The limits are in the wrong order, or a more severe state is more probable throughout.
    """
    none, low, high = limits
    lognormals = {state: curve for state, curve in curves.items() if isinstance(curve, Fragility)}
    levels = {state: curve for state, curve in curves.items() if isinstance(curve, DiscreteFragility)}
    if lognormals and low is not None and high is not None:
        if not low < high:
            raise argument_error("not_increasing", "minIML", f" = {low:g}, maxIML = {high:g}: must increase")
        if none is not None and none >= high:
            raise argument_error("out_of_range", "noDamageLimit", f" = {none:g}: must be below maxIML = {high:g}")
        found = disorder_of_lognormals(lognormals, max(low, none or 0.0), high)
    else:
        found = disorder_at_levels(levels)
    if found is not None:
        if found.where == "throughout":
            raise InputError(f"{found}: limit states must be in the order from the lightest to the heaviest")
        numbers = {"level": found.level}
        sentence = f"{found}: the curves cross, the larger of both probabilities is on the safe side"
        return DondoloWarning(sentence, "limit_states_cross", {"state": found.heavier}, numbers)
    for state, curve in levels.items():
        if none is not None and none >= curve.levels[0] and np.interp(none, curve.levels, curve.probability) > 0.0:
            first = float(curve.levels[0])
            sentence = (
                f"noDamageLimit = {none:g} is not below the lowest level, {first:g}: the probabilities of '{state}' up"
                " to it are taken for 0"
            )
            numbers = {"no_damage_limit": none, "first_level": first}
            return DondoloWarning(sentence, "levels_below_no_damage_limit", {"state": state}, numbers)
    return None


def _function(function: ElementTree.Element, states: list[str]) -> tuple[dict[str, Function], Limits]:
    """The curves of a function, and its limits."""
    kind = _attribute(function, "format")
    if kind not in ("continuous", "discrete"):
        raise argument_error("not_a_word", "format", f" = '{kind}': must be continuous or discrete")
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
            raise argument_error("not_a_word", "shape", f" = '{function.get('shape')}': must be logncdf")
        if limits.min_iml is None or limits.max_iml is None:
            raise InputError("imls: must have minIML and maxIML")
        told = _told(function)
        return {
            state: _lognormal(row, told.get(id(row)), im, unit) for state, row in zip(names, rows, strict=True)
        }, limits
    levels = [over(_checked("imls", word), unit) for word in _content(imls).split()]
    beyond = [level for level in levels if not (limits.min_iml or 0.0) <= level <= (limits.max_iml or np.inf)]
    if beyond:
        raise InputError(
            f"imls = {beyond[0]:g}: must not be beyond minIML and maxIML, which are of continuous functions"
        )
    curves: dict[str, Function] = {}
    for state, row in zip(names, rows, strict=True):
        chances = [float(_checked("poes", word)) for word in _content(row).split()]
        try:
            curves[state] = DiscreteFragility(levels, chances, im=im)
        except InputError as error:
            raise error.placed(f"limit state '{state}'") from None
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
        raise argument_error("out_of_range", "mean", f" = {words[0]}, stddev = {words[1]}: must be positive")
    found = _PARAMETERS.fullmatch(comment or "")
    if found:
        theta, beta = (float(_checked("comment", word)) for word in found.groups())
        if _moments(theta, beta) == (mean, deviation):
            return Fragility.of_parameters(theta, beta, im=im)
    ratio = deviation / mean
    return Fragility.of_parameters(mean / float(np.hypot(1.0, ratio)), float(np.sqrt(np.log1p(ratio * ratio))), im=im)


def _children(element: ElementTree.Element, name: str) -> list[ElementTree.Element]:
    return element.findall(f"{{{NAMESPACE}}}{name}")


def _text(element: ElementTree.Element, name: str) -> str:
    """Text of the child of a name."""
    found = element.find(f"{{{NAMESPACE}}}{name}")
    if found is None:
        raise InputError(f"must have {name}")
    return _content(found)


def _content(element: ElementTree.Element) -> str:
    """Text of an element without that of comments in it."""
    return " ".join([element.text or "", *(inner.tail or "" for inner in element)])


def _attribute(element: ElementTree.Element, name: str) -> str:
    value = element.get(name)
    if not value:
        raise InputError(f"{str(element.tag).rpartition('}')[2]}: must have {name}")
    return value


def _checked(name: str, word: str) -> str:
    """A string that is a finite number, not negative."""
    try:
        value = as_written(word)
    except ValueError:
        value = np.nan
    if not value >= 0.0:
        raise argument_error("not_a_number", name, f" = '{word}': must be a number, not negative")
    return word
