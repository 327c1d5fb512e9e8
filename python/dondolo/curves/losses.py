"""Losses of damage states, as the OpenQuake engine takes them: vulnerability functions and consequences.

In a limit state i a wall loses a share r_i of its value, which the user gives: dondolo knows none. If P_i(x) is the
probability of reaching state i at an intensity x, the ratio of the loss has the distribution

    P(r = r_i | x) = P_i(x) - P_(i+1)(x),    P(r = 0 | x) = 1 - P_1(x),

with the mean m(x) = sum of r_i (P_i - P_(i+1)) and the standard deviation s(x) = sqrt(sum r_i^2 (P_i - P_(i+1)) - m^2).
A vulnerability function gives it at levels:

BT, LN
    A beta distribution, or a lognormal, with the mean m and the coefficient of variation s/m. A beta distribution needs
    s^2 < m (1 - m), which is the variance of ratios of 0 and 1 alone: s is at most 0.99 of that. A lognormal has
    ratios above 1, which the curves of losses of the engine leave out.
PM
    The distribution itself, a probability for each ratio, which event-based jobs and scenarios sample. classical_risk
    of the engine 3.26 does not take it.

The levels are evenly spaced in ln x, at most 10 % apart: the engine takes the function as constant around each of them,
and counts no shaking beyond the last, which is therefore at six times the end of the curves. Mean ratios rise by a
share of 1e-9 from level to level at the least, since the engine leaves out levels at which they do not.

The spread of the ratio within a state, which surveys of damage give too, is left out: s is that between the states.

Source: OpenQuake engine manual, "Vulnerability Models" and "Consequence Models"; openquake.risklib.read_nrml of the
engine, version 3.26.
"""

from __future__ import annotations

import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any, Literal, get_args
from xml.etree import ElementTree

import numpy as np

from dondolo._base.arguments import FloatArray, argument_error, as_number, one_of
from dondolo._base.files import read_text
from dondolo._fortran.origins import check_replaced, derived_mark
from dondolo._storage import tables
from dondolo.curves.fragility import Fragility
from dondolo.curves.fragility_model import NAMESPACE, Function
from dondolo.curves.nrml import LossCategory, checked_states, written_words
from dondolo.curves.nrml_range import range_of
from dondolo.errors import InputError
from dondolo.hazard.openquake import imt_of, times

#: Distribution of the ratio at a level
Distribution = Literal["BT", "LN", "PM"]
#: What a table of consequences can be of, besides losses
Consequence = Literal["losses", "fatalities", "injured", "homeless", "collapsed", "non_operational"]
#: How far beyond the ends of curves the levels go, where stronger shaking is too rare to matter, and in how many steps
BEYOND = 6.0
_ABOVE = 5
# Least rise of a mean ratio from level to level, as a share of it
_RISE = 1e-9
# Largest step of the levels of a vulnerability function, in ln x
_STEP = 0.1
# Largest spread of a beta distribution, in those of a distribution of 0 and 1 alone
_BETA = 0.99
# Titles of a table of consequences before those of the states
_TITLES = ["risk_id", "consequence", "peril", "loss_type"]


def write_vulnerability(
    path: str | os.PathLike[str],
    functions: Mapping[str, Mapping[str, Function]],
    ratios: Mapping[str, float],
    *,
    distribution: Distribution = "BT",
    loss_category: LossCategory = "structural",
    asset_category: str = "buildings",
    imt: str | None = None,
    run: str = "",
) -> None:
    """Write vulnerability functions for OpenQuake, NRML 0.5: the loss of each taxonomy at levels of intensity.

    Parameters
    ----------
    path : path
        The file; its folder must exist. An earlier model of dondolo is replaced, any other file is not.
    functions : mapping of mappings
        Taxonomy -> limit state -> curve, as `write_nrml` takes them; `Typology.nrml_functions` makes those of a
        population.
    ratios : mapping of str to float
        Limit state -> share of the value that is lost in it, 0 to 1, which must not decrease with the state. There is
        no default: docs/openquake.md lists sources.
    distribution : {'BT', 'LN', 'PM'}
        Distribution of the ratio at a level: a beta distribution or a lognormal with the mean and the spread of the
        states, or their probabilities themselves, which classical_risk does not take.
    loss_category, asset_category : str
        As of `write_nrml`.
    imt : str, optional
        OpenQuake's measure of curves against saavg(T1:T2), as of `write_nrml`.
    run : str
        Name of the run whose curves they are.

    Raises
    ------
    InputError
        Names and measures that the format does not allow; ratios of other states, out of range or decreasing.
    DondoloError
        A curve without a fit; the file cannot be written.

    Examples
    --------
    >>> import dondolo as dd
    >>> light, collapse = (dd.Fragility.of_parameters(theta, 0.4, im="pga") for theta in (0.3, 0.8))
    >>> functions = {"parapets": {"light": light, "collapse": collapse}}
    >>> dd.write_vulnerability("vulnerability.xml", functions, {"light": 0.1, "collapse": 1.0})
    """
    check_replaced(path, "model")
    one_of("distribution", distribution, get_args(Distribution))
    one_of("loss_category", loss_category, get_args(LossCategory))
    states = checked_states(functions)
    lost = _ratios("ratios", ratios, states, 1.0)
    root = ElementTree.Element("nrml", {"xmlns": NAMESPACE})
    attributes = {
        "id": "dondolo",
        "assetCategory": written_words("asset_category", asset_category),
        "lossCategory": loss_category,
    }
    model = ElementTree.SubElement(root, "vulnerabilityModel", attributes)
    shares = ", ".join(f"{state} {ratio:g}" for state, ratio in zip(states, lost, strict=True))
    ElementTree.SubElement(model, "description").text = f"Rocking masonry walls, by dondolo; shares lost: {shares}"
    for taxonomy, curves in functions.items():
        try:
            _append(model, taxonomy, list(curves.values()), lost, (distribution, imt))
        except InputError as error:
            raise error.placed(f"taxonomy '{taxonomy}'") from None
    ElementTree.indent(root)
    head = ["<?xml version='1.0' encoding='utf-8'?>", f"<!-- {derived_mark('model', run)} -->"]
    tables.write_lines(path, [*head, ElementTree.tostring(root, encoding="unicode")])


def _ratios(name: str, given: Mapping[str, float], states: tuple[str, ...], most: float) -> FloatArray:
    """What is lost in each state, in their order."""
    if not isinstance(given, Mapping) or set(given) != set(states):
        has = ", ".join(map(str, given)) if isinstance(given, Mapping) else repr(given)
        raise argument_error("wrong_type", name, f" = {has}: must be a number for each of {', '.join(states)}")
    lost = np.array([as_number(f"{name}[{state}]", given[state]) for state in states])
    for state, ratio in zip(states, lost, strict=True):
        if not 0.0 <= ratio <= most:
            raise argument_error("out_of_range", f"{name}[{state}]", f" = {ratio:g}: must lie between 0 and {most:g}")
    if np.any(np.diff(lost) < 0.0):
        raise argument_error(
            "not_increasing", name, f" = {', '.join(f'{ratio:g}' for ratio in lost)}: must not decrease with the state"
        )
    return lost


def loss_levels(curves: list[Function]) -> FloatArray:
    """Levels of the vulnerability function of some limit states: from where they begin to beyond their ends."""
    lognormals = [curve for curve in curves if isinstance(curve, Fragility)]
    first = curves[0]
    if lognormals:
        low, high = range_of(lognormals)
    else:
        positive = first.levels[first.levels > 0.0]
        low, high = float(positive[0]), float(positive[-1])
    inner = np.geomspace(low, high, max(12, int(np.ceil(np.log(high / low) / _STEP)) + 1))
    return np.append(inner, high * np.geomspace(1.0, BEYOND, _ABOVE + 1)[1:])


def _append(
    model: ElementTree.Element,
    taxonomy: str,
    curves: list[Function],
    lost: FloatArray,
    how: tuple[Distribution, str | None],
) -> None:
    """Add the function of a taxonomy."""
    distribution, average = how
    im = curves[0].im
    name, unit = imt_of(im, average if im.startswith("saavg(") else None)
    levels = loss_levels(curves)
    reached = np.minimum.accumulate([np.asarray(curve(levels)) for curve in curves], axis=0)
    inside = reached - np.append(reached[1:], np.zeros((1, len(levels))), axis=0)
    function = ElementTree.SubElement(model, "vulnerabilityFunction", {"id": taxonomy, "dist": distribution})
    ElementTree.SubElement(function, "imls", {"imt": name}).text = " ".join(times(level, unit) for level in levels)
    if distribution == "PM":
        # States with the same ratio are one, and one of nothing is no damage.
        unique = np.unique(np.append(0.0, lost))
        chances = [inside[lost == ratio].sum(axis=0) for ratio in unique]
        chances[0] = np.clip(1.0 - sum(chances[1:], np.zeros(len(levels))), 0.0, 1.0)
        for ratio, chance in zip(unique, chances, strict=True):
            row = ElementTree.SubElement(function, "probabilities", {"lr": repr(float(ratio))})
            row.text = _row(chance)
        return
    mean = _rising(lost @ inside)
    variance = np.maximum(lost**2 @ inside - mean**2, 0.0)
    deviation = np.sqrt(variance)
    if distribution == "BT":
        deviation = np.minimum(deviation, _BETA * np.sqrt(mean * (1.0 - mean)))
    spread = np.divide(deviation, mean, out=np.zeros(len(mean)), where=mean > 0.0)
    ElementTree.SubElement(function, "meanLRs").text = _row(mean)
    ElementTree.SubElement(function, "covLRs").text = _row(spread)


def _rising(mean: FloatArray) -> FloatArray:
    """Mean ratios that rise throughout, by a share of 1e-9 at the least, up to 1 at most."""
    growth = (1.0 + _RISE) ** np.arange(len(mean))
    risen: FloatArray = np.maximum.accumulate(mean / growth) * growth
    return np.asarray(np.minimum(risen, 1.0 / growth[::-1]))


def _row(values: FloatArray) -> str:
    return " ".join(repr(float(value)) for value in values)


def write_consequences(
    path: str | os.PathLike[str],
    functions: Mapping[str, Mapping[str, Function]],
    consequences: Mapping[Consequence, Mapping[str, float]],
    *,
    loss_category: LossCategory = "structural",
) -> None:
    """Write a table of consequences for OpenQuake's analyses of damage: losses, and what becomes of occupants.

    Parameters
    ----------
    path : path
        The CSV file; its folder must exist. An earlier table of consequences is replaced, any other file is not.
    functions : mapping of mappings
        Taxonomy -> limit state -> curve, as of `write_nrml`.
    consequences : mapping of mappings
        Consequence -> limit state -> share, 0 to 1: of the value of an asset ('losses'), of its occupants
        ('fatalities', 'injured'), of its residents ('homeless') or of its number ('collapsed', 'non_operational').
        There is no default: docs/openquake.md lists sources.
    loss_category : {'structural', 'nonstructural', 'contents', 'business_interruption'}
        That of the fragility model.

    Raises
    ------
    InputError
        An unknown consequence; shares of other states, out of range or decreasing; a file that is no such table.
    DondoloError
        The file cannot be written.

    Examples
    --------
    >>> import dondolo as dd
    >>> functions = {"parapets": {"collapse": dd.Fragility.of_parameters(0.8, 0.4, im="pga")}}
    >>> dd.write_consequences("consequences.csv", functions, {"losses": {"collapse": 1.0}})
    """
    states = checked_states(functions)
    one_of("loss_category", loss_category, get_args(LossCategory))
    if not isinstance(consequences, Mapping) or not consequences:
        raise argument_error("wrong_type", "consequences", ": must be a mapping of consequences, at least one")
    table: dict[str, Any] = {title: [] for title in [*_TITLES, *states]}
    for kind, given in consequences.items():
        one_of("consequences", kind, get_args(Consequence))
        shares = _ratios(kind, given, states, 1.0)
        for taxonomy in functions:
            cells = [taxonomy, kind, "groundshaking", loss_category, *map(float, shares)]
            for title, cell in zip(table, cells, strict=True):
                table[title].append(cell)
    _check_table(path)
    tables.write_lines(path, tables.csv_lines(table, [], tables.shortest))


def _check_table(path: str | os.PathLike[str]) -> None:
    """Refuse to replace what is no table of consequences: the engine reads no comment that would say whose it is."""
    target = Path(path)
    if target.is_file() and not target.is_symlink():
        first = read_text(target).split("\n", 1)[0]
        if first.startswith(",".join(_TITLES)):
            return
    check_replaced(path, "model")
