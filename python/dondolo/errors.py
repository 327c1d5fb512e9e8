"""Exceptions and warnings."""

from __future__ import annotations

import warnings
from collections.abc import Iterable, Iterator, Mapping
from contextlib import contextmanager
from typing import Any, Literal, NamedTuple

__all__ = [
    "DondoloError",
    "DondoloWarning",
    "InputError",
    "Interrupted",
    "MissingFileError",
    "NotKnownError",
    "Problem",
]

# What is wrong, for programs; docs/files.md says what each means. The library has its own in base/text/error.f90.
Code = Literal[
    "unknown_name",
    "not_given",
    "not_together",
    "wrong_type",
    "wrong_length",
    "out_of_range",
    "not_increasing",
    "not_a_number",
    "not_numbers",
    "not_an_integer",
    "not_a_flag",
    "not_a_string",
    "not_a_word",
    "not_a_probability",
    "no_such_file",
    "not_at_rest",
]

# Longest line of a message [characters]; the middle of a longer one is left out
_LONGEST = 2000


def _escaped(character: str) -> str:
    """A character, escaped if it cannot be printed."""
    return character if character.isprintable() else character.encode("unicode_escape").decode()


def visible(text: str) -> str:
    """A line as it is safe on a terminal: control characters and marks of direction escaped, a long middle left out.

    Names of files and cells of tables may have any characters.
    """
    line = text if len(text) <= _LONGEST else f"{text[:1500]} ... {text[-400:]}"
    return line if line.isprintable() else "".join(map(_escaped, line))


class DondoloError(Exception):
    """The work failed.

    Messages quote files; control characters and marks of direction in them are escaped, and the middle of a long line
    is left out.
    """

    def __str__(self) -> str:
        return "\n".join(map(visible, super().__str__().split("\n")))


class Problem(NamedTuple):
    """One error of an input.

    Attributes
    ----------
    message : str
        Message, with its place.
    code : str
        Kind of error, for programs, which should not parse messages; docs/files.md lists the codes. '' if none
        applies.
    variable : str
        Name of the argument, property or column as the user writes it, such as ``thickness`` or ``loads[0].force``; ''
        if it is not about one.
    place : str
        Where it is, such as ``walls.csv: line 12`` or ``wall.nml: &wall (line 3)``; '' if it is not in a file.

    Examples
    --------
    >>> import dondolo as dd
    >>> dd.errors.Problem("height = -1: must be positive", "out_of_range", "height").place
    ''
    """

    message: str
    code: str = ""
    variable: str = ""
    place: str = ""


class InputError(DondoloError, ValueError):
    """Wrong input; the message is that of the executable.

    Parameters
    ----------
    sentence : str
        Message: one sentence, or several, one per line.
    errors : iterable of Problem, optional
        What each of them is about.

    Examples
    --------
    >>> import dondolo as dd
    >>> try:
    ...     dd.OneSidedWall(height=-1.0, thickness=0.0)
    ... except dd.errors.InputError as error:
    ...     print(error)
    ...     print([(one.code, one.variable) for one in error.errors])
    height = -1: must be positive
    thickness = 0: must be positive
    [('out_of_range', 'height'), ('out_of_range', 'thickness')]
    """

    # Of those too that OSError makes
    _errors: tuple[Problem, ...] = ()

    def __init__(self, *sentence: object, errors: Iterable[Problem] = ()) -> None:
        super().__init__(*sentence)
        self._errors = tuple(errors)

    @property
    def errors(self) -> tuple[Problem, ...]:
        """All errors; of many, those that the message has room for."""
        return self._errors or tuple(map(Problem, str(self).split("\n")))

    def placed(self, place: str) -> InputError:
        """The same, preceded by a place."""
        errors = [
            one._replace(message=f"{place}: {one.message}", place=f"{place}: {one.place}" if one.place else place)
            for one in self.errors
        ]
        return InputError(f"{place}: {self}", errors=errors)


class MissingFileError(FileNotFoundError, InputError):
    """A file that was asked for does not exist.

    Examples
    --------
    >>> import dondolo as dd
    >>> try:
    ...     dd.read_catalogue("nowhere.csv")
    ... except dd.errors.MissingFileError as error:
    ...     print(error)
    nowhere.csv: no such file
    """

    def __init__(self, *sentence: object, errors: Iterable[Problem] = ()) -> None:
        super().__init__(*sentence)
        self._errors = tuple(errors) or (Problem(str(self), "no_such_file"),)

    # That of OSError comes first, and escapes nothing.
    __str__ = DondoloError.__str__


class NotKnownError(InputError, AttributeError):
    """A result does not have what was asked for, such as bounds of stripes that were not certified; `hasattr` is False.

    Examples
    --------
    >>> import dondolo as dd
    >>> wall, records = dd.OneSidedWall(1.5, 0.25), dd.synthetic_records(6.5, 10.0, "shallow", n_records=4)
    >>> stripes = dd.multiple_stripe(wall, records, [0.6, 0.8], progress=False)
    >>> hasattr(stripes, "theta_bounds"), issubclass(dd.errors.NotKnownError, AttributeError)
    (False, True)
    """


class DondoloWarning(UserWarning):
    """Warning about results that are correct but may mislead.

    Parameters
    ----------
    sentence : str
        Message.
    code : str
        Kind of warning, such as ``scale_factors_large``; docs/files.md lists the codes.
    subject : mapping
        Subject: kind -> name, such as ``{"record": "tolmezzo"}``.
    numbers : mapping
        Name -> number.

    Examples
    --------
    >>> import warnings
    >>> import dondolo as dd
    >>> wall, records = dd.OneSidedWall(1.5, 0.25), dd.synthetic_records(6.5, 10.0, "shallow", n_records=4)
    >>> with warnings.catch_warnings(record=True) as found:
    ...     warnings.simplefilter("always", dd.errors.DondoloWarning)
    ...     stripes = dd.multiple_stripe(wall, records, levels=[8.0, 9.0], progress=False)
    >>> found[0].message.code
    'levels_above_usual'
    """

    def __init__(
        self,
        sentence: str,
        code: str,
        subject: Mapping[str, str] | None = None,
        numbers: Mapping[str, float] | None = None,
    ) -> None:
        super().__init__(sentence)
        self.code, self.subject, self.numbers = code, dict(subject or {}), dict(numbers or {})

    def __str__(self) -> str:
        return visible(super().__str__())

    def __reduce__(self) -> tuple[Any, ...]:
        return DondoloWarning, (str(self), self.code, self.subject, self.numbers)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, DondoloWarning) and self.as_data() == other.as_data()

    def __hash__(self) -> int:
        return hash((str(self), self.code))

    def placed(self, place: str) -> DondoloWarning:
        """The same, its sentence preceded by a place."""
        return DondoloWarning(place + str(self), self.code, self.subject, self.numbers)

    def as_data(self) -> dict[str, Any]:
        """Code, subject, numbers and sentence."""
        return {"code": self.code, "subject": self.subject, "numbers": self.numbers, "sentence": str(self)}


@contextmanager
def silent() -> Iterator[None]:
    """No warnings of dondolo, where what they would say is said in another way."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", DondoloWarning)
        yield


class Interrupted(KeyboardInterrupt):
    """Ctrl-C, or the event that was given as ``stop``, ended a long run; what was finished is kept.

    Attributes
    ----------
    partial : Stripes, Typology, DesignComparison or None
        The finished part as a result of its own: the complete stripes, walls or designs; None if there are none.
        While histories are certified: all stripes, with a status of 0 for those that are still in doubt.

    Examples
    --------
    A run in another thread ends by an event: ``stop=event`` and, from anywhere, ``event.set()``. It raises this, which
    is a `KeyboardInterrupt` and not an `Exception`.

    In a notebook, after the interruption: ``import sys; partial = sys.last_value.partial``. In a script:

    >>> import dondolo as dd
    >>> wall, records = dd.OneSidedWall(1.5, 0.25), dd.synthetic_records(6.5, 10.0, "shallow", n_records=4)
    >>> try:
    ...     stripes = dd.multiple_stripe(wall, records, [0.6, 0.8], progress=False)
    ... except dd.errors.Interrupted as stop:
    ...     stripes = stop.partial
    """

    def __init__(self, message: str, partial: Any = None) -> None:
        super().__init__(message)
        self.partial = partial
