"""Mean curves of a population as fragility functions: straight lines between levels that are close enough."""

from __future__ import annotations

import functools
import re
from collections.abc import Callable

import numpy as np

from dondolo._base.arguments import FloatArray, instance_of
from dondolo._fortran.records import blank_unit
from dondolo.curves.discrete import DiscreteFragility
from dondolo.curves.fragility import Fragility
from dondolo.curves.members import Members
from dondolo.errors import silent
from dondolo.exchange.fragility_model import Curve
from dondolo.populations.curve import PopulationCurve
from dondolo.populations.typology import Typology

# A function begins where no state is more probable, and ends where what is left to come of each is a smaller share:
# those of a lognormal six dispersions below and three above its median, as continuous functions do. OpenQuake draws a
# straight line from 0 to the beginning, and weak shaking is frequent.
_BEGIN, _REST = 1e-9, 1.35e-3
# It begins at this share of the lowest level at the least, and ends at so many times the highest at most.
_LOWEST, _HIGHEST = 1e-3, 100.0
# How far straight lines may be from a curve, as a share of its probability, and in all
_SHARE, _LEAST = 0.005, 1e-9
# What is told of curves that are raised
_TOLD = 1e-4

Curves = Callable[[FloatArray], FloatArray]


def nrml_functions(typology: Typology) -> tuple[dict[str, dict[str, Curve]], list[str]]:
    """Fragility functions of a population for `write_nrml`, one a group and mechanism, with its damage states.

    Of one facade, or one wall with several mechanisms, there is one function by its name: the curve of the same
    histories, `Typology.unions`. Designs have one function each by their names. Where collapse is the only state these
    are the lognormals themselves.

    They are the mean curves, `Typology.mean`, which the report integrates too, and not the lognormals fitted to them:
    those tend to 1 in OpenQuake, also where some walls cannot collapse, and cross.

    Parameters
    ----------
    typology : Typology
        A population.

    Returns
    -------
    functions : dict of dict
        Taxonomy (group/mechanism, 'population' for the whole; the name of a facade or a design) ->
        damage state ('edp_0p4' for 0.4, 'collapse') -> curve.
    sentences : list of str
        Where curves were raised, and by how much; names that had to be changed.

    Raises
    ------
    InputError
        No typology.

    Notes
    -----
    Levels reach from where the probability is 1e-9, or a thousandth of the lowest level of the analysis, to where it
    has come to all but 0.14 % of its end, or a hundred times the highest. Straight lines between them differ from the
    mean curve by 0.5 % of the probability or 1e-9, whichever is more, at most (tried in the middle between levels).

    A less severe state is at least as probable as a more severe one. The means of fitted curves may cross; where they
    do, the curve of the less severe state is raised to that of the more severe. Fractions of walls without a fit may
    decrease from level to level; the mean then stays where it is. Both only ever raise a curve.

    Examples
    --------
    >>> import dondolo as dd
    >>> walls = [dd.OneSidedWall(1.5, 0.25, name="a"), dd.OneSidedWall(1.8, 0.25, name="b")]
    >>> records = dd.synthetic_records(magnitude=6.5, distance=10.0, site="shallow", count=10)
    >>> typology = dd.typology(walls, records, levels=[0.6, 0.8, 1.0], progress=False)
    >>> functions, sentences = dd.nrml_functions(typology)
    >>> list(functions)
    ['population/one_sided']
    >>> dd.write_nrml("centre.xml", functions)
    """
    instance_of("typology", typology, Typology, "no typology")
    damages = [float(edp) for edp in typology.edp_thresholds[:-1]]
    with silent():
        # What has no fit takes part with its fractions.
        states = {_state_name(edp): typology.at(edp) for edp in damages} | {"collapse": typology}
    functions: dict[str, dict[str, Curve]] = {}
    sentences = []
    parts = _parts(typology, list(states.values()))
    for text, kind, whose, means in parts:
        plain = taxonomy_of(text)
        names = (plain if k == 1 else f"{plain[:96]}_{k}" for k in range(1, len(parts) + 1))
        name = next(name for name in names if name not in functions)
        if name != plain:
            sentences.append(f"'{name}': is that of the {kind} {whose!r}; '{plain}' is another {kind}'s")
        if isinstance(means, Fragility):
            functions[name] = {"collapse": means}
            continue
        levels, raw = straight_lines(means, typology.levels)
        ordered = in_order(raw)
        rising = np.maximum.accumulate(ordered, axis=1)
        functions[name] = {
            state: DiscreteFragility(levels, p, im=typology.im) for state, p in zip(states, rising, strict=True)
        }
        unit = blank_unit(typology.im)
        for state, before, inside, after in zip(states, raw, ordered, rising, strict=True):
            for lift, reason in (
                (inside - before, "where a more severe state is more probable"),
                (after - inside, "where it decreases"),
            ):
                most = int(np.argmax(lift))
                if lift[most] > _TOLD:
                    sentences.append(
                        f"'{name}', '{state}': raised by up to {lift[most]:.2g}, at {levels[most]:.3g}{unit}, {reason}"
                    )
    return functions, sentences


def _parts(typology: Typology, states: list[Typology]) -> list[tuple[str, str, str, Curves | Fragility]]:
    """What has a function: text of its taxonomy, kind, name, and its probabilities in each state (states, levels)."""
    if typology.are_alternatives:
        rows = [(wall.name, [state.curves[row] for state in states]) for row, wall in enumerate(typology.walls)]
        return [(name, "design", name, _single(typology, curves)) for name, curves in rows]
    if typology.facade and typology.knows_unions:
        name = typology.facade
        return [(name, "facade", name, _single(typology, [state.unions[name] for state in states]))]

    def means(x: FloatArray, curves: list[PopulationCurve]) -> FloatArray:
        return np.array([one.mean(x) for one in curves])

    return [
        (
            f"{one.group or 'population'}/{one.mechanism}",
            "group",
            one.group,
            functools.partial(means, curves=[state[one.mechanism, one.group] for state in states]),
        )
        for one in typology.groups
    ]


def _single(typology: Typology, curves: list[Fragility]) -> Curves | Fragility:
    """The curves of one wall: a lognormal that tends to 1; functions with damage states, which may cross."""
    if len(curves) == 1 and curves[0].has_fit and curves[0].saturation == 1.0:
        return curves[0]
    share = np.array([one.saturation if one.has_fit else 1.0 for one in curves])
    fractions = np.array([one.saturation * one.collapses / one.histories for one in curves])
    number = np.arange(len(curves))
    members = Members(typology.levels, curves, fractions.T, np.ones(len(curves)), share, number)

    def probabilities(x: FloatArray) -> FloatArray:
        return share[:, None] * members.rows_at(number, x)

    return probabilities


def taxonomy_of(text: str) -> str:
    """A name as the format takes it."""
    return re.sub(r"[^!$-&(-~]", "_", text)[:100]


def _state_name(edp: float) -> str:
    """Name of a damage state: the format takes no point."""
    return f"edp_{edp!r}".removesuffix(".0").replace(".", "p").replace("+", "")


def in_order(probabilities: FloatArray) -> FloatArray:
    """Curves (states, levels), each raised to those of the more severe states."""
    return np.maximum.accumulate(probabilities[::-1], axis=0)[::-1]


def straight_lines(means: Curves, levels: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Levels that straight lines between them are close enough to the curves, and the curves (states, levels) there."""
    below = np.geomspace(_LOWEST * levels[0], levels[0], 300)[:-1]
    seldom = np.flatnonzero(means(below).max(axis=0) <= _BEGIN)
    above = np.geomspace(levels[-1], _HIGHEST * levels[-1], 300)
    left = means(above)
    complete = np.flatnonzero((left >= (1.0 - _REST) * left[:, -1:]).all(axis=0))
    # Fractions of walls without a fit have their corners at the levels of the analysis.
    x = np.concatenate([below[seldom[-1] if len(seldom) else 0 :], levels, above[1 : complete[0] + 1]])
    p = means(x)
    while True:
        middle = np.sqrt(x[:-1] * x[1:])
        between, ends = means(middle), in_order(p)
        curve = in_order(between)
        line = ends[:, :-1] + (middle - x[:-1]) / np.diff(x) * np.diff(ends, axis=1)
        far = (np.abs(line - curve) > np.maximum(_SHARE * curve, _LEAST)).any(axis=0)
        if not far.any():
            return x, p
        x, p = np.append(x, middle[far]), np.append(p, between[:, far], axis=1)
        order = np.argsort(x)
        x, p = x[order], p[:, order]
