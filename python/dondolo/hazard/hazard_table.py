"""Tables of hazard as they are published: levels of intensity, and how often each is exceeded."""

from __future__ import annotations

import os
import re
from typing import Any

import numpy as np

from dondolo._base.arguments import FloatArray
from dondolo._base.files import read_text
from dondolo._fortran.library import constants
from dondolo._fortran.records import describe_measure, read_number_table, unit_of
from dondolo.errors import DondoloWarning, InputError
from dondolo.hazard.printed import levelled, note_of

#: Columns that say how often a level is exceeded.
_FREQUENCIES = ("annual_frequency", "return_period", "poe")

#: What titles of fractiles begin with
FRACTILE = "fractile_"

#: Names that the tables of the Italian code (NTC) have for columns.
_NTC_NAMES = {"tr": "return_period", "t_r": "return_period", "a_g": "ag"}

#: Columns of these tables that describe the shape of a response spectrum.
_NTC_SHAPE = ("f0", "fo", "f_0", "f_o", "tc", "tc*", "t_c", "t_c*")

_YEARS = ("year", "years", "yr", "anno", "anni")


#: Share -> annual frequencies of a fractile
Fractiles = dict[float, FloatArray]


def read_hazard(
    path: str | os.PathLike[str],
) -> tuple[str, FloatArray, FloatArray, Fractiles, list[DondoloWarning], bool]:
    """Intensity measure, levels and annual frequencies of a table, and of its fractiles; how it was read.

    Last comes whether the levels are ag, that of rigid, level ground.
    """
    titles, values = read_number_table(path)
    try:
        if any(title.lower().startswith("poe-") for title in titles):
            raise InputError("is of OpenQuake: must be read by HazardCurve.from_openquake")
        im, levels, columns, unused = _understand(titles, values)
        is_rigid = any(_name_and_unit(title)[0] == "ag" for title in titles)
        raised = _level(columns)
        frequency, fractiles = _frequencies(columns)
    except InputError as error:
        raise error.placed(os.fspath(path)) from None
    notes = [note_of(os.fspath(path), raised)] if raised else []
    if unused:
        names = ", ".join(unused)
        subject = {"file": os.fspath(path), "columns": names}
        notes.append(
            DondoloWarning(f"{subject['file']}: columns that are not used: {names}", "columns_unused", subject)
        )
    if is_rigid:
        subject = {"file": os.fspath(path)}
        text = "ag is taken for the PGA; that of rigid ground must be multiplied by the factors of soil and topography"
        notes.append(DondoloWarning(f"{subject['file']}: {text}", "hazard_of_rigid_ground", subject))
    return im, levels, frequency, fractiles, notes, is_rigid


def comment_of_unit(im: str) -> str:
    """The comment in which a table of dondolo states the unit of its levels."""
    return f"unit of {im}: {unit_of(im) or '1'}, of annual_frequency: 1/year"


def states_unit(path: str | os.PathLike[str], im: str) -> bool:
    """Whether a table was written by dondolo, with the unit of its levels."""
    comments = [line[1:].strip() for line in read_text(path).splitlines() if line.startswith("#")]
    return bool(comments) and comments[0].startswith("dondolo ") and comment_of_unit(im) in comments


def _understand(titles: list[str], values: FloatArray) -> tuple[str, FloatArray, dict[str, FloatArray], list[str]]:
    """Measure, levels, the columns that say how often they are exceeded, and the names of those that are not used."""
    columns: dict[str, FloatArray] = {}
    measures: list[tuple[str, FloatArray]] = []
    unused = []
    for title, column in zip(titles, values.T, strict=True):
        name, unit = _name_and_unit(title)
        if name in _NTC_SHAPE:
            unused.append(title)
        elif name in (*_FREQUENCIES, "investigation_time") or name.startswith(FRACTILE):
            if name in columns:
                raise InputError(f"column {title!r}: {name} is a duplicate")
            if unit and (name not in ("return_period", "investigation_time") or unit not in _YEARS):
                raise InputError(f"column {title!r}: {name} must be {_unit_of(name)}")
            columns[name] = column
        else:
            measures.append(_levels(title, name, unit, column))
    if len(measures) != 1:
        which = ", ".join(repr(name) for name, _ in measures) or "none"
        raise InputError(f"one column must be the levels of a measure, such as 'pga' or 'ag (g)'; there is {which}")
    im, levels = measures[0]
    return im, levels, columns, unused


def _name_and_unit(title: str) -> tuple[str, str]:
    """Name of a column, in lower case, and what stands in brackets at its end, if it is no name of a measure."""
    name, unit = title.strip().lower(), ""
    found = re.fullmatch(r"(.*?)\s*[\[(]([^\])]*)[\])]", name)
    if found and not name.startswith("sa"):
        name, unit = found.group(1), re.sub(r"[\s^]", "", found.group(2)).replace("²", "2")
    return _NTC_NAMES.get(name, name), unit


def _levels(title: str, name: str, unit: str, column: FloatArray) -> tuple[str, FloatArray]:
    """Measure and levels of a column, in the unit of dondolo."""
    gravity = constants().gravity
    sizes = {"g": 1.0, "g/10": 0.1, "m/s2": 1.0 / gravity, "cm/s2": 0.01 / gravity, "gal": 0.01 / gravity}
    if name == "ag" and not unit:
        raise InputError(
            f"column {title!r}: the unit must follow the name: 'ag (g)', 'ag (m/s2)', or 'ag (g/10)' as in annex B"
            " of the Italian code NTC 2008"
        )
    if unit and name in ("ag", "pga"):
        if unit not in sizes:
            raise InputError(f"column {title!r}: the unit must be one of {', '.join(map(repr, sizes))}")
        return "pga", column * sizes[unit]
    try:
        # A table with decimal commas may have them in a period too: Sa(0,5)
        measure = re.sub(r"(?<=\d),(?=\d)", ".", title.strip())
        return describe_measure(measure).name, column
    except InputError as error:
        raise InputError(
            f"column {title!r}: must be an intensity measure, ag, {', '.join(_FREQUENCIES)} or investigation_time"
            f" ({error})"
        ) from None


def _frequencies(columns: dict[str, FloatArray]) -> tuple[FloatArray, Fractiles]:
    """Annual frequencies of exceedance, and those of fractiles [1/year]."""
    given = [name for name in _FREQUENCIES if name in columns]
    if len(given) != 1:
        raise InputError(
            "one column must be annual_frequency, return_period or poe (with investigation_time); "
            f"there is {', '.join(given) or 'none'}"
        )
    (name,) = given
    if (name == "poe") != ("investigation_time" in columns):
        raise InputError("poe and investigation_time (years) belong together")
    time = columns.get("investigation_time", np.ones(1))
    _check("investigation_time", time, time > 0.0, "must be positive, in years")
    fractiles = {
        _share(title): _as_frequency(title, name, column, time)
        for title, column in columns.items()
        if title.startswith(FRACTILE)
    }
    return _as_frequency(name, name, columns[name], time), fractiles


def _level(columns: dict[str, FloatArray]) -> int:
    """Level rises within the last printed digit in the columns of frequencies; how many values were raised."""
    raised = 0
    for title, column in columns.items():
        if title == "investigation_time":
            continue
        # Return periods increase where frequencies decrease
        sign = -1.0 if "return_period" in columns else 1.0
        found, which = levelled(sign * column)
        columns[title] = sign * found
        raised += int(which.sum())
    return raised


def _share(title: str) -> float:
    """Share of a fractile, from the title of its column."""
    try:
        share = float(title.removeprefix(FRACTILE))
    except ValueError:
        share = np.nan
    if not 0.0 < share < 1.0:
        raise InputError(f"column {title!r}: must be as {FRACTILE}0.16")
    return share


def _as_frequency(title: str, kind: str, column: FloatArray, time: FloatArray) -> FloatArray:
    """A column of a kind as annual frequencies."""
    if kind == "annual_frequency":
        return column
    if kind == "return_period":
        _check(title, column, column > 0.0, "must be positive, in years")
        with np.errstate(over="ignore"):
            return 1.0 / column
    # A fractile may never be exceeded
    above = column >= 0.0 if title != kind else column > 0.0
    _check(title, column, above & (column < 1.0), "must lie between 0 and 1, both excluded; 10 % is 0.1")
    with np.errstate(over="ignore"):
        return np.asarray(-np.log1p(-column) / time)


def _check(name: str, column: FloatArray, right: np.ndarray[Any, Any], allowed: str) -> None:
    """Refuse the first value that is not right."""
    if not right.all():
        raise InputError(f"{name} = {column[~right][0]:g}: {allowed}")


def _unit_of(name: str) -> str:
    """Unit of a column, in words."""
    return {"annual_frequency": "per year", "poe": "a probability between 0 and 1"}.get(name, "in years")
