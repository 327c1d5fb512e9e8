"""Reader of fragility models of OpenQuake, NRML 0.5 (dondolo.curves.nrml has the format)."""

from __future__ import annotations

import os
import re
from itertools import pairwise
from typing import Any
from xml.etree import ElementTree

import numpy as np

from dondolo._base.arguments import argument_error
from dondolo._base.files import as_file, read_text
from dondolo._fortran.library import warn
from dondolo.curves.discrete import DiscreteFragility
from dondolo.curves.fragility import Fragility
from dondolo.curves.fragility_model import LIMITS, NAMESPACE, FragilityModel, Function, moments
from dondolo.curves.limited import Limits
from dondolo.curves.state_order import disorder_at_levels, disorder_of_lognormals
from dondolo.errors import DondoloWarning, InputError
from dondolo.hazard.openquake import as_written, im_of, is_average, over

# More than the format has, which is four
_DEEPEST = 100
_PARAMETERS = re.compile(r"\s*theta = (\S+), beta = (\S+)\s*")
# The comment above a function whose measure of OpenQuake is not one of dondolo
_MEASURE = re.compile(r"\s*(\S+) of the next function: im = (\S+)\s*")


def read_nrml(path: str | os.PathLike[str], *, im: str | None = None) -> FragilityModel:
    """Read a fragility model of OpenQuake, NRML 0.5.

    Parameters
    ----------
    path : path
        The file.
    im : str, optional
        Measure of the functions whose imt is AvgSA, such as 'saavg(0.2:2)': OpenQuake's name does not give the
        periods. A model of dondolo has them in a comment.

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
        model, notes = _model(_parsed(text), im)
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


def _model(root: ElementTree.Element, im: str | None) -> tuple[FragilityModel, list[DondoloWarning]]:
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
    states = _text(model, "limitStates").replace(",", " ").split()
    if not states or len(set(states)) < len(states):
        raise InputError("limitStates: must be names, each once")
    functions: dict[str, dict[str, Function]] = {}
    limits: dict[str, Limits] = {}
    notes: list[DondoloWarning] = []
    imts: dict[str, str] = {}
    measures = {key: found for key, text in _told(model).items() if (found := _MEASURE.fullmatch(text))}
    for function in _children(model, "fragilityFunction"):
        taxonomy = _attribute(function, "id")
        if taxonomy in functions:
            raise InputError(f"fragilityFunction '{taxonomy}': is a duplicate")
        try:
            told = measures.get(id(function))
            functions[taxonomy], limits[taxonomy], imt = _function(
                function, states, im or (told.group(2) if told else None)
            )
            if is_average(imt):
                imts[taxonomy] = imt
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
        imts=imts,
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


def _function(
    function: ElementTree.Element, states: list[str], average: str | None
) -> tuple[dict[str, Function], Limits, str]:
    """The curves of a function, its limits, and OpenQuake's measure."""
    kind = _attribute(function, "format").lower()
    if kind not in ("continuous", "discrete"):
        raise argument_error("not_a_word", "format", f" = '{kind}': must be continuous or discrete")
    of_levels = _children(function, "imls")
    if len(of_levels) != 1:
        raise InputError(f"must have one imls, there are {len(of_levels)}")
    (imls,) = of_levels
    imt = _attribute(imls, "imt").strip()
    im, unit = im_of(imt, average)
    given = {name: over(_checked(name, imls.attrib[name]), unit) for name in LIMITS if name in imls.attrib}
    limits = Limits(*(given.get(name) for name in LIMITS))
    rows = _children(function, "params" if kind == "continuous" else "poes")
    names = [_attribute(row, "ls") for row in rows]
    if names != states:
        raise InputError(f"has the limit states {' '.join(names)}: must be {' '.join(states)}")
    if kind == "continuous":
        if function.get("shape", "logncdf") != "logncdf":
            raise argument_error("not_a_word", "shape", f" = '{function.get('shape')}': must be logncdf")
        if limits.min_iml is None or limits.max_iml is None:
            raise InputError("imls: must have minIML and maxIML")
        comments = _told(function)
        return (
            {state: _lognormal(row, comments.get(id(row)), im, unit) for state, row in zip(names, rows, strict=True)},
            limits,
            imt,
        )
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
    return curves, limits, imt


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
        if moments(theta, beta) == (mean, deviation):
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
