"""Rows of a population: checks of their names, weights, probabilities and alternatives."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from dondolo._base.arguments import FloatArray, argument_error, as_array, one_of
from dondolo._fortran.library import as_text, constants
from dondolo._fortran.walls import EXCLUSIVE, INDEPENDENT, OCCURRENCE, is_note, shared
from dondolo.errors import InputError

# Name that Fortran gives a wall without one
UNNAMED = "wall"


def several(name: str, values: Any, what: str) -> tuple[Any, ...]:
    """Turn what a user gives for several things into a tuple of them; a text is not several."""
    if isinstance(values, (str, bytes)) or not isinstance(values, Iterable):
        raise InputError(f"{name} = {values!r}: must be {what}")
    return tuple(values)


def words_of_rows(name: str, given: Any, walls: Sequence[str]) -> tuple[str, ...]:
    """Names of groups or facades, one for each wall of these names; empty where there is none."""
    words = ("",) * len(walls) if given is None else several(name, given, "a name for each wall")
    if len(words) != len(walls):
        raise InputError(f"{len(walls)} walls, {len(words)} {name}: must be as many")
    known = set[str]()
    for wall, word in zip(walls, words, strict=True):
        if not isinstance(word, str) or word not in known:
            _on_one_line(name if is_note(name) else name.removesuffix("_names").removesuffix("s"), word, wall)
            known.add(word)
    # A table cannot tell blanks from nothing.
    return shared([word if word.strip(" ") else "" for word in words])


def notes_of_rows(given: Any, walls: Sequence[str]) -> dict[str, tuple[str, ...]]:
    """Columns that are kept with the walls as they stand, by their names: a text for each wall."""
    if given is None:
        return {}
    if not isinstance(given, Mapping):
        raise argument_error("wrong_type", "notes", f" = {given!r}: must be a mapping of names to texts of each wall")
    names = [name.lower() if isinstance(name, str) else name for name in given]
    for name in given:
        as_text("notes", name)
        if not is_note(name):
            raise argument_error("unknown_name", "notes", f": {name!r}: must begin with x_ or note")
        if names.count(name.lower()) > 1:
            raise argument_error("not_together", "notes", f": {name!r} is there twice")
    # A table has no blanks at the ends of lines.
    return {
        name: shared([word.rstrip(" ") for word in words_of_rows(name, words, walls)]) for name, words in given.items()
    }


def names_of_rows(names: Sequence[str]) -> tuple[str, ...]:
    """Names of walls, of which each that was given no name has one of its own."""
    taken = set(names)
    named, number = [], 0
    for i, name in enumerate(names, 1):
        if name == UNNAMED:
            number = max(number + 1, i)
            while f"wall {number}" in taken:
                number += 1
            name = f"wall {number}"
        named.append(name)
    return tuple(named)


def _on_one_line(what: str, text: str, wall: str) -> None:
    """Check a text of a wall."""
    try:
        as_text(what, text)
    except InputError as error:
        raise error.placed(f"wall {wall!r}") from None


def shares_of_rows(name: str, values: ArrayLike | None, walls: Sequence[str], largest: float) -> FloatArray:
    """Numbers of the walls, between 0 and the largest allowed; 1 each if left out."""
    shares = np.ones(len(walls)) if values is None else as_array(name, values).copy()
    if len(shares) != len(walls):
        raise InputError(f"{len(walls)} walls, {len(shares)} values of {name}: must be as many")
    wrong = ~((shares >= 0.0) & (shares <= largest) & (shares < math.inf))
    if wrong.any():
        first = int(np.argmax(wrong))
        allowed = "must not be negative" if largest == math.inf else f"must lie between 0 and {largest:g}"
        raise InputError(f"wall {walls[first]!r}: {name} = {shares[first]}: {allowed}")
    shares.flags.writeable = False
    return shares


def occurrence_of_rows(given: Any, walls: Sequence[str]) -> tuple[str, ...]:
    """How the mechanisms of each wall occur; one word is that of all."""
    if given is None:
        given = INDEPENDENT
    words = (given,) * len(walls) if isinstance(given, str) else several("occurrence", given, "a word for each wall")
    if len(words) != len(walls):
        raise InputError(f"{len(walls)} walls, {len(words)} words of occurrence: must be as many")
    for word in words:
        if word not in OCCURRENCE:
            one_of("occurrence", word, OCCURRENCE)
    return shared(words)


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
    walls: Sequence[str],
    mechanisms: Sequence[str],
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
        one, whole = first.setdefault(wall, i), "wall"
        if one != i and (walls[i - 1] != wall or facades[i - 1] != facade):
            raise argument_error(
                "not_together",
                "name",
                f" = {wall!r}: another wall has this name; mechanisms of one wall must be on consecutive rows",
            )
        # Exclusive alternatives may have a mechanism in common, each with a hinge of its own.
        alone = of_rows[i][-1] == EXCLUSIVE and not alternatives[i]
        others = [] if alone else [j for j in range(one, i) if alternatives[j] == alternatives[i]]
        if mechanisms[i] in (mechanisms[j] for j in others):
            raise argument_error(
                "not_together", "name", f" = {wall!r}: another wall of this name has the same mechanism"
            )
        if facade:
            one, whole = first_of.setdefault(facade, i), "facade"
            if one != i and facades[i - 1] != facade:
                wrong = f"facade = {facade!r}: another facade has this name"
                raise InputError(f"{wrong}; walls of one facade must be on consecutive rows")
        if of_rows[i] != of_rows[one]:
            same = "weight and group" if of_rows[i][:2] != of_rows[one][:2] else "occurrence"
            raise argument_error(
                "not_together", "name", f" = {wall!r}: mechanisms of one {whole} must have the same {same}"
            )
    for facade in first_of:
        if facade in first and facades[first[facade]] != facade:
            raise argument_error(
                "not_together", "facade", f" = {facade!r}: a wall that is not part of it has this name"
            )
