"""Results in files: each is written whole to one file and read back, equal to the bit.

A file is a NumPy archive (.npz): a ZIP archive of arrays in NumPy's .npy format, none of them pickled, so that reading
one runs no code from it. Its first member, ``dondolo.json``, has the version of the format, the version of dondolo and
the tree of the result; the other members are the arrays that the tree names. The tree has JSON's own null, true,
false, strings and finite numbers; a tuple is an array, and everything else an object with one key that says its kind:

==================================  ===========================================================
``{"float": "nan"}``                a float that JSON lacks: nan, inf, -inf
``{"array": "3.npy"}``              an array
``{"scalar": "3.npy"}``             a NumPy scalar
``{"list": [...]}``                 a list
``{"mapping": [[key, value], ..]}`` a mapping
``{"Stripes": {field: value}}``     a result, or a part of one: a dataclass or named tuple
``{"State": value}``                a member of an enumeration
==================================  ===========================================================

A class takes part through its name: results inherit from `Saved`, their parts are marked by `part_of_results`. What is
read is made by the constructor of its class, which checks it as it does any other input; what a wall derives from its
numbers is derived again. A class of many parts says what is stored of it and makes itself of that again (`_stored`,
`_restored`). A result gives the same bytes whenever it is saved.
"""

from __future__ import annotations

import dataclasses
import io
import json
import math
import os
from collections.abc import Callable, Mapping
from enum import Enum
from inspect import signature
from pathlib import Path
from types import NoneType, UnionType
from typing import TYPE_CHECKING, Any, Literal, TypeVar, Union, get_args, get_origin, get_type_hints

import numpy as np

from dondolo._base.arguments import argument_error
from dondolo._base.files import as_file, check_regular
from dondolo._fortran.files import whole_file
from dondolo._fortran.library import constants
from dondolo._fortran.origins import check_replaced
from dondolo.errors import DondoloWarning, InputError, MissingFileError

if TYPE_CHECKING:
    from zipfile import ZipInfo

_VERSION = 1
# Fields that archives of earlier versions do not have, and what they are there
_ADDED: dict[str, dict[str, Any]] = {
    **{
        kind: {"deviance": math.nan, "deviance_dof": 0}
        for kind in ("Fragility", "FirstCollapseFragility", "LimitedFragility")
    },
    **{
        kind: {"restitution_sd": None, "restitution_seed": None, "base_level": None}
        for kind in ("FreeStandingWall", "OneSidedWall", "TabulatedWall", "TwoBlockWall")
    },
    "HazardCurve": {"rigid_ground": False},
    "Response": {"initial_rotation": 0.0, "initial_velocity": 0.0},
    "Stripes": {"record_formats": ()},
    "Logistic": {
        "likelihood_ratio": math.nan,
        "im": "",
        "covariance": np.full((2, 2), math.nan),
        "errors": "given",
        "degrees_of_freedom": math.inf,
        "deviance": math.nan,
    },
}
_CONTENT = "dondolo.json"
# What every file has in its first bytes: the first member is not compressed
_MARK = '{"format": "dondolo result"'
_SUFFIX = ".npz"
# The first bytes of a file, which have the mark
_HEAD = 500

_Array = np.ndarray[Any, Any]
_T = TypeVar("_T")
_TYPES: dict[str, type] = {}


def part_of_results(kind: type[_T]) -> type[_T]:
    """Let a dataclass, named tuple or enumeration be part of saved results (a decorator)."""
    _TYPES[kind.__name__] = kind
    return kind


# Its room knows nothing of files.
part_of_results(DondoloWarning)


class Saved:
    """A result that can be saved: a dataclass, whose arrays are read-only."""

    def __init_subclass__(cls, **more: Any) -> None:
        super().__init_subclass__(**more)
        part_of_results(cls)

    def __post_init__(self) -> None:
        # Nobody changes a result.
        for value in vars(self).values():
            if type(value) is np.ndarray:
                value.flags.writeable = False

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the result to a file, from which `dondolo.load` reads it back, equal to the bit.

        Parameters
        ----------
        path : path
            The file, whose name must end in .npz; an older result is replaced.

        Raises
        ------
        InputError
            Another suffix; a file that is no result of dondolo; a result with a part that cannot be saved, such as a
            function of yours.
        DondoloError
            The file cannot be written.

        Examples
        --------
        >>> import dondolo as dd
        >>> dd.Fragility.of_parameters(0.8, 0.4, im="pga").save("curve.npz")
        >>> dd.load("curve.npz").theta
        0.8
        """
        import zipfile

        target = as_file("path", path)
        if target.suffix != _SUFFIX:
            raise argument_error("out_of_range", "path", f" = {os.fspath(path)!r}: must end in {_SUFFIX}")
        arrays: list[_Array] = []
        tree = _encode(self, type(self).__name__, arrays, {})
        content = {"format": "dondolo result", "format_version": _VERSION, "dondolo": constants().version}
        check_replaced(target, "result")
        with whole_file(target) as part, zipfile.ZipFile(part, "w") as archive:
            # A ZipInfo has a date of its own, not today's.
            archive.writestr(zipfile.ZipInfo(_CONTENT), json.dumps(content | {"result": tree}, allow_nan=False))
            for i, array in enumerate(arrays):
                with archive.open(zipfile.ZipInfo(_member(i)), "w", force_zip64=True) as member:
                    np.lib.format.write_array(member, array, allow_pickle=False)


def load(path: str | os.PathLike[str]) -> Any:
    """Read a result that its method `save` wrote.

    Parameters
    ----------
    path : path
        The file, ``*.npz``. The tables of a run, of `Typology.write_results` too, are read by `read_results`.

    Returns
    -------
    Fragility, Stripes, Response, ...
        The result, of the class that was saved and equal to the bit; its arrays are read-only.

    Raises
    ------
    MissingFileError
        There is no such file.
    InputError
        The file cannot be read, is not a saved result, is damaged, or has a format or a part that this version does
        not know.

    Examples
    --------
    >>> import dondolo as dd
    >>> curve = dd.fit_fragility([0.2, 0.4, 0.6], [1, 5, 9], [10, 10, 10])
    >>> curve.save("curve.npz")  # doctest: +SKIP
    >>> dd.load("curve.npz").theta == curve.theta  # doctest: +SKIP
    True
    """
    source = as_file("path", path)
    check_regular(source)
    try:
        with source.open("rb") as file:
            data = file.read(_HEAD)
            is_saved = _MARK.encode() in data
            data += file.read() if is_saved else b""
    except FileNotFoundError as error:
        raise MissingFileError(f"{source}: cannot be read: {error.strerror}") from error
    except OSError as error:
        raise InputError(f"{source}: cannot be read: {error.strerror}") from error
    except MemoryError as error:
        raise InputError(f"{source}: cannot be read: it does not fit in memory") from error
    if not is_saved:
        raise InputError(f"{source}: is not a result saved by dondolo")
    result, origin, arrays = _unpack(data, source)
    try:
        loaded = _decode(result, arrays)
        if not isinstance(loaded, Saved):
            raise InputError(f"its content must be a result, not {type(loaded).__name__}")
        # Arrays of shapes that do not belong together, and impossible numbers, are found here, not where the result is
        # shown first.
        with np.errstate(over="raise", invalid="raise"):
            repr(loaded)
    except RecursionError as error:
        raise InputError(f"{source}: was saved by dondolo {origin}: its content is nested too deeply") from error
    # Content that is wrong raises any kind of error in the constructors of results.
    except Exception as error:
        sentence = " ".join(str(error).split())
        raise InputError(f"{source}: was saved by dondolo {origin}: {sentence}") from error
    return loaded


def _member(place: int) -> str:
    """Name of an array in the archive."""
    return f"{place}.npy"


def _unpack(data: bytes, source: Path) -> tuple[Any, str, dict[str, _Array]]:
    """The tree in an archive, the version that wrote it, and the arrays; the check sums of all are compared."""
    import zipfile

    arrays: dict[str, _Array] = {}
    try:
        with zipfile.ZipFile(io.BytesIO(data)) as archive:
            _check_sizes(archive.infolist(), len(data))
            content = json.loads(archive.read(_CONTENT))
            for name in archive.namelist():
                if name != _CONTENT:
                    arrays[name] = _array(archive.read(name))
        result, version, origin = content["result"], int(content["format_version"]), str(content["dondolo"])
    except InputError as error:
        raise error.placed(f"{source}: is damaged") from None
    # Bytes that are wrong raise a dozen kinds of errors in zipfile and its decoders.
    except Exception as error:
        raise InputError(f"{source}: is damaged: not a complete archive of a result") from error
    if version > _VERSION:
        raise InputError(
            f"{source}: was saved by dondolo {origin} in format {version};"
            f" this is {constants().version}, which reads formats up to {_VERSION}"
        )
    return result, origin, arrays


def _check_sizes(members: list[ZipInfo], size: int) -> None:
    """Refuse members that are larger than the file can hold, before any of them is read.

    `Saved.save` compresses nothing, so that together they are smaller than the file; those of a bomb, which are
    compressed or overlap, are larger.
    """
    for member in members:
        if member.compress_type != 0 or member.file_size != member.compress_size:
            raise InputError(f"member '{member.filename}' is compressed, which no saved result is")
    whole = sum(member.file_size for member in members)
    if whole > size:
        raise InputError(f"its members have {whole} bytes, more than the {size} of the file")


def _array(data: bytes) -> _Array:
    """An array from the bytes of its member; its header is compared with them before memory is reserved."""
    file = io.BytesIO(data)
    version = np.lib.format.read_magic(file)
    read_header = {
        (1, 0): np.lib.format.read_array_header_1_0,
        (2, 0): np.lib.format.read_array_header_2_0,
    }.get(version)
    if read_header is None:
        raise InputError(f"an array has the unknown version {version[0]}.{version[1]}")
    shape, _, dtype = read_header(file)
    count = math.prod(shape)
    if (
        dtype.hasobject
        or any(length < 0 for length in shape)
        or max(dtype.itemsize, 1) * count != len(data) - file.tell()
    ):
        raise InputError(f"an array of shape {shape} and type {dtype} does not have {len(data) - file.tell()} bytes")
    file.seek(0)
    array: _Array = np.lib.format.read_array(file, allow_pickle=False)
    array.flags.writeable = False
    return array


def _encode(value: Any, where: str, arrays: list[_Array], places: dict[int, str]) -> Any:
    """The tree of a value; its arrays are appended, each once."""

    def inner(value: Any, where: str) -> Any:
        return _encode(value, where, arrays, places)

    def stored(array: _Array) -> str:
        if array.dtype.hasobject:
            raise InputError(f"{where}: an array of objects cannot be saved")
        if id(array) not in places:
            places[id(array)] = _member(len(arrays))
            arrays.append(array)
        return places[id(array)]

    kind = type(value)
    if value is None or kind in (bool, int, str):
        return value
    if kind is float:
        return value if math.isfinite(value) else {"float": repr(value)}
    if kind is tuple:
        return [inner(one, f"{where}[{i}]") for i, one in enumerate(value)]
    if kind is list:
        return {"list": [inner(one, f"{where}[{i}]") for i, one in enumerate(value)]}
    if kind is np.ndarray:
        return {"array": stored(value)}
    if isinstance(value, np.generic):
        return {"scalar": stored(np.asarray(value))}
    if isinstance(value, Mapping):
        return {"mapping": [[inner(key, where), inner(one, f"{where}[{key!r}]")] for key, one in value.items()]}
    if _TYPES.get(kind.__name__) is not kind:
        raise InputError(f"{where}: a {kind.__name__} cannot be saved")
    if isinstance(value, Enum):
        return {kind.__name__: value.value}
    return {kind.__name__: {name: inner(one, f"{where}.{name}") for name, one in _content(value).items()}}


def _decode(tree: Any, arrays: Mapping[str, _Array]) -> Any:
    """The value of a tree."""
    if isinstance(tree, list):
        return tuple(_decode(one, arrays) for one in tree)
    if not isinstance(tree, dict):
        return tree
    ((what, inner),) = tree.items()
    plain: dict[str, Callable[[], Any]] = {
        "float": lambda: float(inner),
        "array": lambda: arrays[inner],
        "scalar": lambda: arrays[inner][()],
        "list": lambda: [_decode(one, arrays) for one in inner],
        "mapping": lambda: {_decode(key, arrays): _decode(one, arrays) for key, one in inner},
    }
    if what in plain:
        return plain[what]()
    if what not in _TYPES:
        raise InputError(f"{what}: is not a type of result in this version, {constants().version}")
    kind = _TYPES[what]
    if issubclass(kind, Enum):
        return kind(inner)
    return _made(kind, {name: _decode(one, arrays) for name, one in inner.items()})


def _content(value: Any) -> dict[str, Any]:
    """What is stored of a result or a part of one, by name."""
    if isinstance(value, DondoloWarning):
        return value.as_data()
    if hasattr(value, "_stored"):
        stored: dict[str, Any] = value._stored()
        return stored
    return {name: getattr(value, name) for name in _fields(type(value))}


def _made(kind: Any, values: dict[str, Any]) -> Any:
    """A result or a part of one, from what is stored of it."""
    if kind is DondoloWarning:
        return kind(**values)
    if hasattr(kind, "_restored"):
        return kind._restored(**values)
    fields = _fields(kind)
    values = {**_ADDED.get(kind.__name__, {}), **values}
    if set(values) != set(fields):
        wrong = sorted(set(values) ^ set(fields))[0]
        raise InputError(f"{kind.__name__}: has {'no' if wrong in fields else 'an unknown'} field {wrong!r}")
    hints = get_type_hints(kind)
    for name, value in values.items():
        if not _suits(value, hints[name]):
            raise InputError(f"{kind.__name__}.{name}: must not be {type(value).__name__}")
    given = [name for name in fields if name in signature(kind).parameters]
    made = kind(**{name: values[name] for name in given})
    for name in fields:
        # What a constructor does not take it derives, or a method adds
        if name not in given:
            object.__setattr__(made, name, values[name])
    return made


def _suits(value: Any, hint: Any) -> bool:
    """Is a value of the type that a field is declared with? Of the types that results have; others are not judged."""
    origin, inner = get_origin(hint), get_args(hint)
    if origin in (Union, UnionType):
        return any(_suits(value, one) for one in inner)
    if origin is Literal:
        return value in inner
    if origin is np.ndarray:
        (dtype,) = get_args(inner[1]) or (np.generic,)
        return isinstance(value, np.ndarray) and (dtype is Any or np.issubdtype(value.dtype, dtype))
    if origin is tuple and len(inner) == 2 and inner[1] is Ellipsis:
        return isinstance(value, tuple) and all(_suits(one, inner[0]) for one in value)
    numbers = {float: (float, int, np.floating, np.integer), int: (int, np.integer), bool: (bool, np.bool_)}
    kind = numbers.get(hint, origin or hint)
    if kind is NoneType or isinstance(kind, (type, tuple)):
        return isinstance(value, kind) and (hint not in (int, float) or not isinstance(value, bool))
    return True


def _fields(kind: Any) -> tuple[str, ...]:
    """Names of the fields of a dataclass or named tuple."""
    if dataclasses.is_dataclass(kind):
        return tuple(field.name for field in dataclasses.fields(kind))
    return tuple(kind._fields)
