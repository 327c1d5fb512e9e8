"""Rows of a population: checks of their names, weights, probabilities and alternatives."""

from __future__ import annotations

import math
from collections.abc import Iterable, Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from dondolo._base.arguments import FloatArray, argument_error, as_array, one_of
from dondolo._fortran.library import as_text, constants
from dondolo._fortran.walls import EXCLUSIVE, INDEPENDENT, OCCURRENCE
from dondolo.errors import InputError
from dondolo.walls.wall import Wall

# Name that Fortran gives a wall without one
UNNAMED = "wall"


def several(name: str, values: Any, what: str) -> tuple[Any, ...]:
    """Turn what a user gives for several things into a tuple of them; a text is not several."""
    if isinstance(values, (str, bytes)) or not isinstance(values, Iterable):
        raise InputError(f"{name} = {values!r}: must be {what}")
    return tuple(values)


def words_of_rows(name: str, given: Any, walls: Sequence[Wall]) -> tuple[str, ...]:
    """Names of groups or facades, one for each wall; empty where there is none."""
    words = ("",) * len(walls) if given is None else several(name, given, "a name for each wall")
    if len(words) != len(walls):
        raise InputError(f"{len(walls)} walls, {len(words)} {name}: must be as many")
    for wall, word in zip(walls, words, strict=True):
        _on_one_line(name.removesuffix("s"), word, wall)
    # A table cannot tell blanks from nothing.
    return tuple(word if word.strip(" ") else "" for word in words)


def named_walls(walls: Sequence[Wall]) -> tuple[Wall, ...]:
    """Walls of which each that was given no name has one of its own."""
    taken = {wall.name for wall in walls}
    named, number = [], 0
    for i, wall in enumerate(walls, 1):
        if wall.name == UNNAMED:
            number = max(number + 1, i)
            while f"wall {number}" in taken:
                number += 1
            wall = wall._renamed(f"wall {number}")
        named.append(wall)
    return tuple(named)


def _on_one_line(what: str, text: str, wall: Wall) -> None:
    """Check a text of a wall."""
    try:
        as_text(what, text)
    except InputError as error:
        raise error.placed(f"wall {wall.name!r}") from None


def shares_of_rows(name: str, values: ArrayLike | None, walls: Sequence[Wall], largest: float) -> FloatArray:
    """Numbers of the walls, between 0 and the largest allowed; 1 each if left out."""
    shares = np.ones(len(walls)) if values is None else as_array(name, values).copy()
    if len(shares) != len(walls):
        raise InputError(f"{len(walls)} walls, {len(shares)} values of {name}: must be as many")
    wrong = ~((shares >= 0.0) & (shares <= largest) & (shares < math.inf))
    if wrong.any():
        first = int(np.argmax(wrong))
        allowed = "must not be negative" if largest == math.inf else f"must lie between 0 and {largest:g}"
        raise InputError(f"wall {walls[first].name!r}: {name} = {shares[first]}: {allowed}")
    shares.flags.writeable = False
    return shares


def occurrence_of_rows(given: Any, walls: Sequence[Wall]) -> tuple[str, ...]:
    """How the mechanisms of each wall occur; one word is that of all."""
    if given is None:
        given = INDEPENDENT
    words = (given,) * len(walls) if isinstance(given, str) else several("occurrence", given, "a word for each wall")
    if len(words) != len(walls):
        raise InputError(f"{len(walls)} walls, {len(words)} words of occurrence: must be as many")
    for word in words:
        one_of("occurrence", word, OCCURRENCE)
    return words


def numbered_alternatives(
    wholes: Sequence[str], p_occ: Sequence[float], occurrence: Sequence[str], alternatives: Sequence[str]
) -> NDArray[np.int32]:
    """Numbers of alternatives, each wall's from 1 on, checked; 0 for independent mechanisms."""
    numbers = np.zeros(len(wholes), dtype=np.int32)
    total, known = 0.0, set[str]()
    for i, (whole, name) in enumerate(zip(wholes, alternatives, strict=True)):
        if occurrence[i] != EXCLUSIVE:
            if name:
                raise InputError(f"wall {whole!r}: alternative = {name!r}: only for occurrence = {EXCLUSIVE!r}")
            continue
        begins = i == 0 or wholes[i - 1] != whole
        if begins:
            total, known = 0.0, set()
        if not begins and name and alternatives[i - 1] == name:
            numbers[i] = numbers[i - 1]
            if p_occ[i] != p_occ[i - 1]:
                raise InputError(f"wall {whole!r}: mechanisms of one alternative, {name!r}, must have the same p_occ")
            continue
        if name in known:
            raise InputError(f"wall {whole!r}: alternative = {name!r}: its rows must be consecutive")
        known |= {name} if name else set()
        numbers[i] = 1 if begins else numbers[i - 1] + 1
        total += p_occ[i]
        if total > 1.0 + constants().sum_tolerance:
            raise InputError(
                f"wall {whole!r}: the probabilities p_occ of its exclusive alternatives add up to {total:.6g}, must be"
                " at most 1"
            )
    return numbers


def check_names(
    walls: Sequence[Wall],
    of_rows: Sequence[tuple[float, str, str]],
    facades: Sequence[str],
    alternatives: Sequence[str],
) -> None:
    """Walls with one name must be mechanisms of one wall, and those of one facade must be on consecutive rows.

    Of rows there are the weight, the group and the occurrence, the same for all of a wall.
    """
    first: dict[str, int] = {}
    first_of: dict[str, int] = {}
    for i, (wall, facade) in enumerate(zip(walls, facades, strict=True)):
        one, whole = first.setdefault(wall.name, i), "wall"
        if one != i and (walls[i - 1].name != wall.name or facades[i - 1] != facade):
            raise argument_error(
                "not_together",
                "name",
                f" = {wall.name!r}: another wall has this name; mechanisms of one wall must be on consecutive rows",
            )
        # Exclusive alternatives may have a mechanism in common, each with a hinge of its own.
        alone = of_rows[i][-1] == EXCLUSIVE and not alternatives[i]
        others = [] if alone else [j for j in range(one, i) if alternatives[j] == alternatives[i]]
        if wall.mechanism in (walls[j].mechanism for j in others):
            raise argument_error(
                "not_together", "name", f" = {wall.name!r}: another wall of this name has the same mechanism"
            )
        if facade:
            one, whole = first_of.setdefault(facade, i), "facade"
            if one != i and facades[i - 1] != facade:
                wrong = f"facade = {facade!r}: another facade has this name"
                raise InputError(f"{wrong}; walls of one facade must be on consecutive rows")
        if of_rows[i] != of_rows[one]:
            same = "weight and group" if of_rows[i][:2] != of_rows[one][:2] else "occurrence"
            raise argument_error(
                "not_together", "name", f" = {wall.name!r}: mechanisms of one {whole} must have the same {same}"
            )
    for facade in first_of:
        if facade in first and facades[first[facade]] != facade:
            raise argument_error(
                "not_together", "facade", f" = {facade!r}: a wall that is not part of it has this name"
            )
