"""Fragility functions for OpenQuake: NRML 0.5, the format of the engine's fragility models.

A model is a set of fragility functions, one for each taxonomy (class of assets) of an exposure model, and each of them
has a curve for each limit state, the same states in the same order throughout::

    <nrml xmlns="http://openquake.org/xmlns/nrml/0.5">
      <fragilityModel id=... assetCategory=... lossCategory=...>
        <description>...</description>
        <limitStates>damage collapse</limitStates>
        <fragilityFunction id="taxonomy" format="continuous" shape="logncdf">
          <imls imt="PGA" noDamageLimit=... minIML=... maxIML=.../>
          <params ls="damage" mean=... stddev=.../>
          <params ls="collapse" mean=... stddev=.../>
        </fragilityFunction>
        <fragilityFunction id="another" format="discrete">
          <imls imt="SA(0.5)" noDamageLimit=...>0.1 0.2 0.3</imls>
          <poes ls="damage">0.0 0.2 0.4</poes>
          <poes ls="collapse">0.0 0.1 0.3</poes>
        </fragilityFunction>
      </fragilityModel>
    </nrml>

Continuous
    A lognormal distribution function. Its parameters are the mean and standard deviation of the intensity itself, not
    of its logarithm: mean = theta exp(beta^2/2), stddev = mean sqrt(exp(beta^2) - 1). OpenQuake takes the curve as
    constant below minIML and above maxIML, and as 0 up to noDamageLimit. Unless given, minIML is six dispersions below
    the lowest median and maxIML three above the highest, and noDamageLimit is minIML. The lower end is far down because
    weak shaking is frequent: of the risk under a hazard x^-k the share Phi(k beta - 6) is cut off.
Discrete
    Probabilities at levels, straight lines in between, constant above the last level. Without noDamageLimit OpenQuake
    draws a line from 0 at an intensity of 1e-10, and suggests levels of the hazard from there on, which are too far
    apart. So the first level is one at which no state is more probable than 1e-9, and noDamageLimit is 0.1 % below it,
    unless given. `Typology.nrml_functions` writes the mean curves of a population so, at 12 to 40 levels, which lie
    close where the curves bend.
    A curve that has more at its first level, and no limit, is a line from no intensity: the level on it at which 1e-9
    is left is added, and a warning names the limit as the remedy.
States
    A state contains the next, so its probability is never the smaller one. Lognormal curves of different dispersion
    cross somewhere; between minIML and maxIML they must not. A range that is not given ends where two curves cross,
    if all states have less than 0.1 % there or more than 99.9 %. Where another state has a probability to lose, the
    function is written as discrete, and the lighter of the two raised to the heavier. Curves that cross in between
    are refused.
Units
    PGA and SA(T) in g, as here (OpenQuake's g is the standard 9.80665 m/s2, that of dondolo's levels is the wall's
    gravity, 9.81 unless given: 0.03 %). PGV in cm/s: levels are multiplied by 100. An average spectral acceleration is
    AvgSA in g, whose periods stand in a comment above the function. Other measures are refused.
Names
    Those of functions may have accents and blanks, but no quotes and no #; those of limit states are of letters,
    digits, - and _, at most 75. In an exposure model written as XML taxonomies must be ASCII without blanks; in one
    written as CSV they may be as in the fragility model.

Source: OpenQuake engine manual, "Fragility Models"; openquake.risklib.read_nrml and openquake.risklib.scientific of the
engine, version 3.26.
"""

from __future__ import annotations

import os
import re
from collections.abc import Mapping
from typing import Any, Literal, get_args

import numpy as np

from dondolo._base.arguments import argument_error, as_number, one_of
from dondolo._fortran.library import warn
from dondolo._fortran.origins import check_replaced
from dondolo.curves.discrete import DiscreteFragility
from dondolo.curves.fragility import Fragility
from dondolo.curves.fragility_model import FragilityModel, Function
from dondolo.curves.limited import LimitedFragility, Limits
from dondolo.curves.nrml_range import RARE, given_range, unseen_crossings
from dondolo.curves.state_order import disorder_at_levels, disorder_of_lognormals
from dondolo.curves.straight_lines import BEGIN, few_straight_lines, in_order
from dondolo.errors import DondoloError, DondoloWarning, InputError
from dondolo.hazard.openquake import imt_of

#: Losses that a model is for
LossCategory = Literal["structural", "nonstructural", "contents", "business_interruption"]
_NAME = re.compile(r"[A-Za-z0-9_-]{1,100}")
# What the engine's reader accepts: no quotes and no number sign
_TAXONOMY = re.compile(r"[^#'\"]{1,100}")
_STATE = re.compile(r"[A-Za-z0-9_-]{1,75}")
# The limit below which a discrete function is 0, as a share of its first level
_LIMIT = 0.999
# Probabilities at the first level above which levels that are added below it are said
_SAID = 1e3 * BEGIN


def write_nrml(
    path: str | os.PathLike[str],
    functions: Mapping[str, Mapping[str, Function]],
    *,
    id: str = "dondolo",
    description: str = "Rocking masonry walls, by dondolo",
    asset_category: str = "buildings",
    loss_category: LossCategory = "structural",
    no_damage_limit: float | None = None,
    min_iml: float | None = None,
    max_iml: float | None = None,
    imt: str | None = None,
    run: str = "",
) -> None:
    """Write fragility functions for OpenQuake, NRML 0.5; the file appears whole or not at all.

    Parameters
    ----------
    path : path
        The file; its folder must exist. An earlier model of dondolo is replaced, any other file is not.
    functions : mapping of mappings
        Taxonomy -> limit state -> curve. Each taxonomy has the same limit states, from the lightest to the heaviest;
        its curves are all `Fragility`, written as continuous, or all `DiscreteFragility` of the same levels, written as
        discrete. Taxonomies may differ in that, and in the intensity measure. `Typology.nrml_functions` makes
        those of a population. Curves of `read_nrml` keep their limits unless others are given.
    id : str
        Name of the model: letters, digits, - and _, at most 100.
    description : str
        A printable text.
    asset_category : str
        Of the exposure model, such as 'buildings'.
    loss_category : {'structural', 'nonstructural', 'contents', 'business_interruption'}
        What is lost.
    no_damage_limit : float, optional
        Intensity up to which there is no damage. If left out, `min_iml` for continuous functions; for discrete ones
        0.1 % below the first level, which has a probability of at most 1e-9: see Warns.
    min_iml, max_iml : float, optional
        Range of the continuous functions. If left out, from six dispersions below the lowest median to three above the
        highest. These three are in the unit of the curves' levels, and for all functions.
    imt : str, optional
        OpenQuake's measure of curves against saavg(T1:T2), 'AvgSA' or 'AvgSA(T)', as the hazard to be used has it. The
        periods are given in a comment, which `read_nrml` reads. For other measures it must be left out.
    run : str
        Name of the run whose curves they are, which the file then gives; empty if they are not of result files.

    Raises
    ------
    InputError
        Names, measures or crossing curves that the format does not allow; a file that is no model of dondolo.
    DondoloError
        A curve without a fit; the file cannot be written.

    Warns
    -----
    DondoloWarning
        Discrete curves without a limit that have more than 1e-6 at their first level: the level at which the line from
        no intensity has 1e-9 is added, far below the others.

    Examples
    --------
    >>> import dondolo as dd
    >>> curve = dd.fit_fragility([0.2, 0.4], [11, 33], 44, im="pga")
    >>> dd.write_nrml("fragility.xml", {"parapets": {"collapse": curve}})
    """
    check_replaced(path, "model")
    if not isinstance(id, str) or not _NAME.fullmatch(id):
        raise argument_error("not_a_string", "id", f" = {id!r}: must be of letters, digits, - and _, at most 100")
    description = written_words("description", description)
    asset_category = written_words("asset_category", asset_category)
    one_of("loss_category", loss_category, get_args(LossCategory))
    limits = {"no_damage_limit": no_damage_limit, "min_iml": min_iml, "max_iml": max_iml}
    for what, value in limits.items():
        if value is not None and not 0.0 < as_number(what, value) < np.inf:
            raise argument_error("out_of_range", what, f" = {value:g}: must be positive")
    states = checked_states(functions)
    averages: dict[str, str | None] = {}
    of_functions: dict[str, Limits] = {}
    doubts: list[DondoloWarning] = []
    written: dict[str, dict[str, Function]] = {}
    for taxonomy, given in functions.items():
        curves = dict(given)
        own = _own_limits(taxonomy, curves)
        # A limit of 0 is none, and 1e-10 to the engine.
        none, low, high = (
            (mine or None) if value is None else float(value) for mine, value in zip(own, limits.values(), strict=True)
        )
        if isinstance(given[states[0]], Fragility) and low is None and high is None:
            curves = _uncut(curves)  # type: ignore[arg-type]
        averages[taxonomy] = imt if curves[states[0]].im.startswith("saavg(") else None
        try:
            imt_of(curves[states[0]].im, averages[taxonomy])
        except InputError as error:
            raise error.placed(f"taxonomy '{taxonomy}'") from None
        if isinstance(curves[states[0]], Fragility):
            found = _continuous(taxonomy, curves, none, low, high)  # type: ignore[arg-type]
            if none is None and own != Limits():
                # Constant below min_iml, as the curve has it
                found = found._replace(no_damage_limit=None)
        else:
            found = _discrete(taxonomy, curves, none)  # type: ignore[arg-type]
            if none is None:
                curves, found, doubt = _begun(taxonomy, curves)  # type: ignore[arg-type]
                doubts += doubt
        of_functions[taxonomy] = found
        written[taxonomy] = curves
    imts = {taxonomy: name for taxonomy, name in averages.items() if name is not None}
    if imt is not None and not imts:
        raise argument_error("not_a_word", "imt", f" = {imt!r}: must be left out, since no curve is of saavg(T1:T2)")
    FragilityModel(
        functions=written,
        limits=of_functions,
        id=id,
        description=description,
        asset_category=asset_category,
        loss_category=loss_category,
        imts=imts,
    ).write(path, run=run)
    warn(doubts)


def written_words(name: str, text: Any) -> str:
    """A text as the format takes it, and XML."""
    words = " ".join(text.split()) if isinstance(text, str) else ""
    if not words or not words.isprintable():
        raise argument_error("not_a_string", name, f" = {text!r}: must be a string of printable characters")
    return words


def _is_taxonomy(name: Any) -> bool:
    """Whether the engine takes a name as it stands."""
    if not isinstance(name, str) or not _TAXONOMY.fullmatch(name):
        return False
    return name.isprintable() and name == " ".join(name.split())


def checked_states(functions: Mapping[str, Mapping[str, Function]]) -> tuple[str, ...]:
    """The limit states, the same for all taxonomies, whose curves are of a kind, of one measure and fitted."""
    states = _states(functions)
    for taxonomy, curves in functions.items():
        _check_curves(taxonomy, curves)
    return states


def _states(functions: Mapping[str, Mapping[str, Function]]) -> tuple[str, ...]:
    """The limit states, the same for all taxonomies."""
    if not isinstance(functions, Mapping) or not functions:
        raise argument_error("wrong_type", "functions", ": must be a mapping of taxonomies, at least one")
    states: tuple[str, ...] = ()
    for taxonomy, curves in functions.items():
        if not _is_taxonomy(taxonomy):
            raise InputError(
                f"taxonomy {taxonomy!r}: must be printable, at most 100 characters, without quotes, # and blanks at its"
                " ends"
            )
        if not isinstance(curves, Mapping) or not curves:
            raise InputError(f"taxonomy '{taxonomy}': must be a mapping of limit states, at least one")
        states = states or tuple(curves)
        if tuple(curves) != states:
            raise InputError(
                f"taxonomy '{taxonomy}': has the limit states {', '.join(map(str, curves))}: must be"
                f" {', '.join(map(str, states))}, as of the first taxonomy"
            )
    for state in states:
        # The engine adds a state of that name.
        if not isinstance(state, str) or not _STATE.fullmatch(state) or state == "no_damage":
            raise InputError(
                f"limit state {state!r}: must be of letters, digits, - and _, at most 75, and not 'no_damage'"
            )
    return states


def _check_curves(taxonomy: str, curves: Mapping[str, Function]) -> None:
    """Are all curves of a kind, of one measure, and fitted?"""
    kinds = {type(curve) for curve in curves.values()}
    discrete = kinds == {DiscreteFragility}
    if not discrete and not all(issubclass(kind, Fragility) for kind in kinds):
        raise InputError(f"taxonomy '{taxonomy}': its curves must be all Fragility or all DiscreteFragility")
    if len({curve.im for curve in curves.values()}) > 1:
        raise InputError(f"taxonomy '{taxonomy}': its curves must be of one intensity measure")
    for state, curve in curves.items():
        if isinstance(curve, Fragility) and not curve.has_fit:
            raise DondoloError(
                f"taxonomy '{taxonomy}', limit state '{state}': has no curve (status '{curve.status}'); its fractions"
                " can be written as DiscreteFragility"
            )
        if isinstance(curve, Fragility) and curve.upper_asymptote < 1.0:
            raise InputError(
                f"taxonomy '{taxonomy}', limit state '{state}': tends to {curve.upper_asymptote:.3g}, and a lognormal"
                " of the format tends to 1; its fractions can be written as DiscreteFragility"
            )


def _own_limits(taxonomy: str, curves: Mapping[str, Function]) -> Limits:
    """Limits that the curves themselves have."""
    found = {
        curve.limits
        if isinstance(curve, LimitedFragility)
        else Limits(curve.no_damage_limit)
        if isinstance(curve, DiscreteFragility)
        else Limits()
        for curve in curves.values()
    }
    if len(found) > 1:
        raise InputError(f"taxonomy '{taxonomy}': its curves must have the same limits")
    return found.pop()


def _continuous(
    taxonomy: str,
    curves: Mapping[str, Fragility],
    no_damage_limit: float | None,
    min_iml: float | None,
    max_iml: float | None,
) -> Limits:
    """Limits of a function of lognormal curves, checked."""
    low, high = given_range(list(curves.values()), min_iml, max_iml)
    none = low if no_damage_limit is None else float(no_damage_limit)
    if not low < high:
        raise InputError(f"taxonomy '{taxonomy}': min_iml = {low:g}, max_iml = {high:g}: must increase")
    if none >= high:
        raise InputError(f"taxonomy '{taxonomy}': no_damage_limit = {none:g}: must be below max_iml = {high:g}")
    _check_order(taxonomy, curves, low, high)
    return Limits(none, low, high)


def _uncut(functions: dict[str, Fragility]) -> dict[str, Function]:
    """The same curves; where the crossing of two would cut something of another, all of them at levels, raised."""
    curves = list(functions.values())
    harmless = all(
        curves[0](cross) <= RARE if is_below else curves[-1](cross) >= 1.0 - RARE
        for cross, is_below in unseen_crossings(curves)
    )
    low, high = given_range(curves, None, None)
    if harmless or not low < high:
        return dict(functions)
    fitted = np.unique(np.concatenate([curve.levels for curve in curves] + [[curve.theta for curve in curves]]))
    levels, raw = few_straight_lines(lambda x: np.array([curve(x) for curve in curves]), fitted)
    return {
        state: DiscreteFragility(levels, p, im=curve.im)
        for (state, curve), p in zip(functions.items(), in_order(raw), strict=True)
    }


def _check_order(taxonomy: str, curves: Mapping[str, Fragility], low: float, high: float) -> None:
    """Check that no curves cross within a range."""
    found = disorder_of_lognormals(curves, low, high)
    if found is None:
        return
    if found.where == "throughout":
        raise InputError(
            f"taxonomy '{taxonomy}': {found}: limit states must be given from the lightest to the heaviest"
        )
    end = {"below": "min_iml", "above": "max_iml"}[found.where]
    raise InputError(
        f"taxonomy '{taxonomy}': {found}, where the curves cross: choose {end} to leave that out of"
        f" {low:.4g} to {high:.4g}, or write them as DiscreteFragility"
    )


def _discrete(taxonomy: str, curves: Mapping[str, DiscreteFragility], no_damage_limit: float | None) -> Limits:
    """Limits of a function of probabilities at levels, checked."""
    names = list(curves)
    levels = curves[names[0]].levels
    for name in names:
        if not np.array_equal(curves[name].levels, levels):
            raise InputError(f"taxonomy '{taxonomy}': its curves must have the same levels")
    found = disorder_at_levels(curves)
    if found is not None:
        raise InputError(
            f"taxonomy '{taxonomy}': {found}: limit states must be given from the lightest to the heaviest, and their"
            " curves must not cross"
        )
    if no_damage_limit is not None and no_damage_limit >= levels[0]:
        raise InputError(
            f"taxonomy '{taxonomy}': no_damage_limit = {no_damage_limit:g}: must be below the lowest level,"
            f" {levels[0]:g}"
        )
    return Limits(None if no_damage_limit is None else float(no_damage_limit))


def _begun(
    taxonomy: str, curves: Mapping[str, DiscreteFragility]
) -> tuple[dict[str, Function], Limits, list[DondoloWarning]]:
    """Discrete curves without a limit from a level on at which none has more than `BEGIN`, the limit just below it."""
    first = next(iter(curves.values()))
    # A level of 0 is 1e-10 to the engine; nothing is damaged there.
    kept = first.levels > 0.0
    levels, p = first.levels[kept], np.array([curve.probability[kept] for curve in curves.values()])
    most, doubts = float(p[:, 0].max()), []
    if most > BEGIN or len(levels) == 1:
        share = min(BEGIN / most, 0.5) if most > 0.0 else 0.5
        levels, p = np.append(share * levels[0], levels), np.hstack([share * p[:, :1], p])
    if most > _SAID:
        numbers = {"probability": most, "level": float(levels[1]), "first_level": float(levels[0])}
        sentence = (
            f"taxonomy '{taxonomy}': has a probability of {most:.3g} at its lowest level, {levels[1]:.4g}, and a line"
            f" from no intensity below it: begins at {levels[0]:.3g}, which makes the levels that OpenQuake suggests"
            " too far apart: give no_damage_limit, or levels in job.ini"
        )
        doubts.append(DondoloWarning(sentence, "begins_at_no_intensity", {"taxonomy": taxonomy}, numbers))
    made: dict[str, Function] = {
        state: DiscreteFragility(levels, chances, im=first.im) for state, chances in zip(curves, p, strict=True)
    }
    return made, Limits(_LIMIT * float(levels[0])), doubts
