"""Mean curves of a population as fragility functions: straight lines between levels that are close enough."""

from __future__ import annotations

import functools
import re

import numpy as np

from dondolo._base.arguments import FloatArray
from dondolo._fortran.records import blank_unit
from dondolo.curves.discrete import DiscreteFragility
from dondolo.curves.fragility import Fragility
from dondolo.curves.fragility_model import Function
from dondolo.curves.members import Members
from dondolo.curves.straight_lines import Curves, few_straight_lines, in_order
from dondolo.errors import silent
from dondolo.populations.curve import PopulationCurve
from dondolo.populations.typology import Typology

# What is told of curves that are raised
_TOLD = 1e-4


def nrml_functions(typology: Typology) -> tuple[dict[str, dict[str, Function]], list[str]]:
    """Fragility functions of a population: see `Typology.nrml_functions`."""
    damages = [float(edp) for edp in typology.edp_thresholds[:-1]]
    with silent():
        # What has no fit takes part with its fractions.
        states = {_state_name(edp): typology.at(edp) for edp in damages} | {"collapse": typology}
    functions: dict[str, dict[str, Function]] = {}
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
        levels, raw = few_straight_lines(means, typology.levels)
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
        return np.array([one(x) for one in curves])

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
    if len(curves) == 1 and curves[0].has_fit and curves[0].upper_asymptote == 1.0:
        return curves[0]
    share = np.array([one.upper_asymptote if one.has_fit else 1.0 for one in curves])
    fractions = np.array([one.upper_asymptote * one.collapses / one.histories for one in curves])
    number = np.arange(len(curves))
    members = Members(
        typology.levels, curves, fractions.T, np.ones(len(curves)), share, number.astype(np.int32) * 0, number
    )

    def probabilities(x: FloatArray) -> FloatArray:
        return share[:, None] * members.rows_at(number, x)

    return probabilities


def taxonomy_of(text: str) -> str:
    """A name as the format takes it: accents and blanks stay."""
    plain = "".join(sign if sign.isprintable() else " " for sign in re.sub("[#'\"]", "_", text))
    return " ".join(plain.split())[:100].rstrip() or "_"


def _state_name(edp: float) -> str:
    """Name of a damage state: the format takes neither points nor other signs."""
    return f"edp_{edp!r}".removesuffix(".0").replace(".", "p").replace("+", "")
