"""The library as a whole: its version and defaults, tables of properties, statuses, parcels, and warnings.

Statuses become exceptions with the sentence of the executable, and parcels become arrays.
"""

from __future__ import annotations

import functools
import json
import math
import os
import re
import sys
import threading
import warnings
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from dondolo._base.arguments import FloatArray, argument_error
from dondolo._base.interrupts import Interrupts
from dondolo._fortran import _core
from dondolo.errors import DondoloError, DondoloWarning, InputError, MissingFileError, Problem, visible

_PACKAGE = str(Path(__file__).parents[1]) + os.sep
# Each line is one object without blanks around it; json.loads would look for blanks first.
_DECODER = json.JSONDecoder()


# A power of ten in a number
_POWER = re.compile(r"(?<=\d)e([+-]\d+)\b")
_SUPERSCRIPTS = str.maketrans("0123456789-", "⁰¹²³⁴⁵⁶⁷⁸⁹⁻")


class Constants(NamedTuple):
    """What Fortran says of itself.

    Attributes
    ----------
    longest_name, fewest_clusters : int
        Bytes of a name, and clusters that standard errors need.
    rtol, atol, edp_limit, gravity : float
        Defaults.
    least_share : float
        Part of a distribution that must be left where it is cut off.
    same_level : float
        Part of a level by which another differs.
    least_ratio : float
        Likelihood ratio from which on a slope is significant.
    sum_tolerance : float
        By how much a sum of probabilities may miss 1.
    version, commit : str
    statuses, fitted, errors, work, notes : tuple of str
        Statuses of fits, those that have a curve, kinds of standard errors, counts of work, and what the names of
        columns begin with that are kept with walls as they stand.
    """

    longest_name: int
    fewest_clusters: int
    rtol: float
    atol: float
    edp_limit: float
    gravity: float
    least_share: float
    same_level: float
    least_ratio: float
    sum_tolerance: float
    version: str
    commit: str
    statuses: tuple[str, ...]
    fitted: tuple[str, ...]
    errors: tuple[str, ...]
    work: tuple[str, ...]
    notes: tuple[str, ...]


class Property(NamedTuple):
    """A property of walls, or of another group, as Fortran's table has it.

    Attributes
    ----------
    name : str
        As in namelists and in Python.
    kind : str
        'real', 'integer', 'text', 'logical', 'list', 'either', or 'words' for a list of choices.
    unit : str
        '' for a number.
    default : str
        As in a namelist; 'required', or 'optional' where there is none.
    smallest, largest : float
        Range of a number.
    bounds : str
        'positive' for a number greater than 0, 'less' for one less than the largest.
    choices, owners : tuple of str
        What a text can be; the mechanisms that have it, () for all.
    instead : str
        What can take its place, where one of both must be given.
    column : str
        Its column in the tables of results.
    meaning : str
        One sentence.
    absent : float or None
        What stands in the place of an optional number that is not given beside the others of its kind, if anything.
    not_with : tuple of str
        Properties of the same group beside which it cannot be given.
    """

    name: str
    kind: str
    unit: str
    default: str
    smallest: float
    largest: float
    bounds: str
    choices: tuple[str, ...]
    owners: tuple[str, ...]
    instead: str
    column: str
    meaning: str
    absent: float | None
    not_with: tuple[str, ...]


@dataclass(frozen=True, eq=False)
class Parcel:
    """Contents that came from Fortran; what was put in under a name is ``parcel[name]``."""

    integers: NDArray[np.int32]
    reals: FloatArray
    lines: list[str]
    address: int
    names: Mapping[str, str] = field(default_factory=dict)

    def __getitem__(self, name: str) -> Any:
        """What has a name: an array in its shape, a list of texts, or a single value."""
        kind, start, *shape = self.names[name].split()
        lengths = tuple(int(length) for length in shape)
        first, number = int(start), math.prod(lengths)
        found = getattr(self, kind)[first : first + number]
        if kind == "lines":
            return found if shape else found[0]
        return found.reshape(lengths) if shape else found[0].item()

    def named(self, names: Iterable[str]) -> dict[str, Any]:
        """What has these names, by name."""
        return {name: self[name] for name in names}

    def series(self, length: int) -> FloatArray:
        """Its next series, an array of its own; all of them must be taken, each once."""
        values: FloatArray = _core.library.take_series(self.address, length)
        return values


# Kinds of errors, see dondolo_base_error
_WRONG_INPUT = {2: InputError, 3: MissingFileError}
_NO_MEMORY = 4

# What there is where nothing was sent
_NOTHING = Parcel(np.empty(0, dtype=np.int32), np.empty(0), [], 0)


@functools.cache
def constants() -> Constants:
    """Ask Fortran for its version, defaults and the names of its statuses."""
    parcel = receive(_core.library.constants())
    words: dict[str, Any] = {name: tuple(parcel[name]) for name in ("statuses", "fitted", "errors", "work", "notes")}
    return Constants(**parcel.named(Constants._fields) | words)


@functools.cache
def properties(group: str) -> tuple[Property, ...]:
    """The table of properties of a group of a case ('wall', 'solver' ...), or of rows of a population ('member')."""
    return tuple(_property(*line.split("\t")) for line in receive(_core.library.properties(group.encode())).lines)


def _property(*entries: str) -> Property:
    """A property out of its line."""
    name, kind, unit, default, smallest, largest, bounds, choices, owners, instead, column, meaning = entries[:12]
    absent, excluded = entries[12:]
    return Property(
        name,
        kind,
        unit,
        default,
        float(smallest),
        float(largest),
        bounds,
        tuple(choices.split()),
        tuple(owners.split()),
        instead,
        column,
        meaning,
        None if float(absent) == sys.float_info.max else float(absent),
        tuple(excluded.split(", ")) if excluded else (),
    )


def flat_values(rows: Sequence[Property], values: Mapping[str, Any]) -> tuple[bytes, FloatArray, NDArray[np.int32]]:
    """Values of a group as Fortran takes them: texts, numbers, and how many values each number has; None is not given.

    All are in the order of the group's table, which Fortran has too.
    """
    texts = [row.name for row in rows if row.kind == "text"]
    lists = [np.atleast_1d(() if values[row.name] is None else values[row.name]) for row in rows if row.kind != "text"]
    words = b"\n".join(b"" if values[name] is None else as_text(name, values[name]) for name in texts)
    # f2py takes no empty arrays
    return words, np.concatenate([*lists, [0.0]]), np.array([len(own) for own in lists], dtype=np.int32)


def with_units(group: str, facts: Iterable[tuple[str, str]]) -> list[tuple[str, str]]:
    """Facts of a wall or a building, name and text; those that are properties of the group get their unit."""
    units = {row.name: row.unit for row in properties(group)}
    return [
        (what, f"{_POWER.sub(_raised, text)} {units[what]}".strip() if what in units else text) for what, text in facts
    ]


def _raised(power: re.Match[str]) -> str:
    """A power of ten as people write it."""
    return "\N{MULTIPLICATION SIGN}10" + str(int(power[1])).translate(_SUPERSCRIPTS)


def shown_probability(value: float) -> str:
    """A probability as the executable prints it."""
    return str(_core.library.shown_probability(value).decode().strip())


def bibtex(used: Iterable[str]) -> list[str]:
    """Lines of BibTeX of dondolo and of the sources of what was used, in the words of dondolo_files_references."""
    return receive(_core.library.cite(",".join(used).encode())).lines


def source_keys(used: Iterable[str]) -> tuple[str, ...]:
    """Keys of these sources."""
    return tuple(receive(_core.library.cite_keys(",".join(used).encode())).lines)


def build_variant() -> str:
    """Name of the build variant: see `Solver.variant`."""
    name, failure = _core.library.variant()
    check(failure)
    return str(name.decode().strip())


def available_threads() -> int:
    """Threads that OpenMP gives, which honours OMP_NUM_THREADS and the processors of the process."""
    return int(_core.library.available_threads())


def check(sent: NDArray[np.int64]) -> None:
    """Raise the error that a procedure has sent in the place of a parcel, if it has."""
    kind = int(sent[-1])
    if kind > 0:
        parcel = _take(sent.tolist())
        last = len(parcel.lines) - int(parcel.integers[0])
        sentences, about = parcel.lines[:last], parcel.lines[last:]
        message = "\n".join(sentences).strip()
        if kind in _WRONG_INPUT:
            errors = [Problem(one, *line.split("\t")) for one, line in zip(sentences, about, strict=False)]
            raise _WRONG_INPUT[kind](message, errors=errors)
        raise (MemoryError if kind == _NO_MEMORY else DondoloError)(message)


class Stoppable:
    """Let Ctrl-C stop what Fortran computes; Python hears of it in its main thread alone (a context manager).

    Parameters
    ----------
    interrupts : Interrupts, optional
        Of the work, whose event then stops it too, in any thread.
    """

    def __init__(self, interrupts: Interrupts | None = None) -> None:
        self._flag = None if interrupts is None else interrupts.flag

    def __enter__(self) -> None:
        if self._flag is not None:
            _core.library.stop_at(self._flag.ctypes.data)
        self._listens = threading.current_thread() is threading.main_thread()
        if self._listens:
            _core.library.listen()

    def __exit__(self, *_: object) -> None:
        if self._listens:
            _core.library.end_listening()
        if self._flag is not None:
            _core.library.stop_at(0)


# OpenMP's threads do not survive a fork: a process that is made by one works with the thread that it has. Windows has
# no fork.
if sys.platform != "win32":
    os.register_at_fork(after_in_child=_core.library.work_alone)


def as_text(name: str, value: Any) -> bytes:
    """Turn what a user gives for a name or a word into the bytes Fortran takes, which says what they may be."""
    if not isinstance(value, str):
        raise argument_error("not_a_string", name, f" = {value!r}: must be a string")
    try:
        text = value.encode()
    except UnicodeEncodeError:
        raise argument_error("not_a_string", name, f" = {value!r}: must be a string") from None
    # What Python prints has no character that Fortran refuses. A text of f2py would end at NUL.
    if not value.isprintable() or len(text) > constants().longest_name:
        check(_core.library.check_text(name.encode(), text.replace(b"\0", b"\xc0\x80")))
    return text


def check_characters(name: str, text: str) -> None:
    """Refuse what no document can have, anywhere in a text of several lines: control characters and the like."""
    if text.isprintable():
        return
    for place, character in enumerate(text):
        if character.isprintable() or character in "\t\n\r":
            continue
        try:
            as_text(name, character)
        except InputError:
            before = visible(text[max(0, place - 20) : place])
            sentence = (
                f"{name}: has {visible(character)} after '{before}': must be without control characters and marks of "
                "direction"
            )
            raise InputError(sentence, errors=[Problem(sentence, "not_a_string", name)]) from None


def within_name(text: str) -> str:
    """A text made of names: where it has more bytes than a name may have, its middle is left out."""
    content, most = text.encode(), constants().longest_name
    if len(content) <= most:
        return text
    # Room for the dots between the halves
    half = most // 2 - 3
    return f"{content[:half].decode(errors='ignore')} ... {content[-half:].decode(errors='ignore')}"


def text_lines(texts: Iterable[str]) -> bytes:
    """Texts as Fortran takes them, a line each."""
    return b"".join(text.encode() + b"\n" for text in texts)


def receive(sent: NDArray[np.int64]) -> Parcel:
    """Take the parcel that a procedure has sent, or raise the error that came in its place."""
    check(sent)
    return _take(sent.tolist())


def _take(sent: list[int]) -> Parcel:
    """Take a parcel: its address, its numbers of integers, reals and characters, and how many lines are names."""
    address, *sizes, kind = sent
    if not address:
        return _NOTHING
    integers, reals, words = _core.library.take_parcel(address, *sizes)
    text = words.tobytes()[: sizes[-1]].decode("utf-8", "replace")
    lines = text.split("\n")[:-1]
    first = len(lines) + min(kind, 0)
    return Parcel(integers, reals, lines[:first], address, dict(line.split(" ", 1) for line in lines[first:]))


def unpack_warning(data: dict[str, Any]) -> DondoloWarning:
    """A warning of Fortran, from its JSON object."""
    return DondoloWarning(str(data["sentence"]), str(data["code"]), data["subject"], data["numbers"])


def unpack_warnings(lines: Iterable[str]) -> list[DondoloWarning]:
    """Warnings of Fortran, a JSON object on each line."""
    return [unpack_warning(_DECODER.raw_decode(line)[0]) for line in lines]


def warn_of_notes(sentences: Iterable[str]) -> None:
    """Warn of how a table was read."""
    warn(DondoloWarning(sentence, "note") for sentence in sentences)


def warn(found: Iterable[DondoloWarning]) -> None:
    """Warn of each, where the user's own line is."""
    depth = 0
    for one in found:
        depth = depth or _depth_of_user()
        warnings.warn(one, stacklevel=depth)


def _depth_of_user() -> int:
    """How many calls the user's own line is above the caller's."""
    frame, depth = sys._getframe(1), 1
    while frame.f_back is not None and frame.f_code.co_filename.startswith(_PACKAGE):
        frame, depth = frame.f_back, depth + 1
    return depth
