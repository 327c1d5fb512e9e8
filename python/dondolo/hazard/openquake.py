"""Hazard curves as the OpenQuake engine exports them, and its names of intensity measures.

A file has the curves of many sites, for one measure and one statistic::

    #,,,,,"generated_by='OpenQuake engine 3.20.0', ..., kind='mean', investigation_time=50.0, imt='PGA'"
    lon,lat,depth,poe-0.0050000,poe-0.0070000,...
    13.40000,42.35000,0.00000,9.999999E-01,...

Older engines write ``# mean, investigation_time=50.0, imt="PGA"``, or the path of a realization in place of the
statistic. A first column may name the sites (custom_site_id). Source: openquake.calculators.export.hazard and
openquake.baselib.writers of the engine, versions 2 to 3.26.
"""

from __future__ import annotations

import csv
import os
import re
from collections.abc import Mapping, Sequence
from decimal import Decimal
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from dondolo._base.arguments import FloatArray, argument_error, as_number
from dondolo._base.files import read_text
from dondolo._fortran.records import describe_measure
from dondolo._storage import tables
from dondolo.errors import DondoloError, DondoloWarning, InputError
from dondolo.hazard.printed import levelled, note_of

#: Number of a site in a file, from 0, or its longitude and latitude [degrees]
Site = int | tuple[float, float]

# OpenQuake's names, and its unit in that of dondolo
_MEASURES = {"pga": ("PGA", 1), "pgv": ("PGV", 100)}
_LEVEL = "poe-"
_DECIMAL = re.compile(r"[-+]?(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?", re.ASCII)
# How far from a site of a file its coordinates may be given [degrees]
_NEAR = 1e-3


class _File(NamedTuple):
    """Curves of one statistic: '' if it is not told."""

    path: str
    kind: str
    imt: str
    time: float
    levels: tuple[str, ...]
    sites: FloatArray
    poe: FloatArray


def imt_of(im: str) -> tuple[str, int]:
    """OpenQuake's name of an intensity measure, and its unit in that of dondolo."""
    spectral = re.fullmatch(r"sa\((.+)\)", im)
    if spectral:
        return f"SA({float(spectral.group(1))!r})", 1
    if im not in _MEASURES:
        raise argument_error("not_a_word", "im", f" = '{im}': must be 'pga', 'pgv' or 'sa(T)' for OpenQuake")
    return _MEASURES[im]


def im_of(imt: str) -> tuple[str, int]:
    """Intensity measure of OpenQuake's name, and OpenQuake's unit in that of dondolo."""
    word = imt.strip()
    for im, (name, unit) in _MEASURES.items():
        if word.upper() == name:
            return im, unit
    spectral = re.fullmatch(r"SA\(([^)]+)\)", word, re.IGNORECASE)
    if not spectral:
        raise argument_error("not_a_word", "imt", f" = '{imt}': must be PGA, PGV or SA(T)")
    return describe_measure(f"sa({spectral.group(1)})").name, 1


def times(value: float, unit: int) -> str:
    """A number in OpenQuake's unit, in as few digits as give it again: 1.1 times 100 is 110."""
    exact = Decimal(repr(float(value))) * unit
    short = repr(float(exact))
    return short if over(short, unit) == value else str(exact)


def over(text: str, unit: int) -> float:
    """A number in the unit of dondolo, from its text in OpenQuake's."""
    value = as_written(text)
    # Decimal fails for exponents beyond its own.
    return value if unit == 1 or value == 0.0 else float(Decimal(text.strip()) / unit)


def as_written(text: str) -> float:
    """A finite number as files have it, not as Python's literals may be; ValueError for any other string."""
    value = float(text) if _DECIMAL.fullmatch(text.strip()) else np.nan
    if not np.isfinite(value):
        raise ValueError("must be a number")
    return value


def read_curves(
    paths: Sequence[str], site: Site | None
) -> tuple[str, FloatArray, FloatArray, dict[float, FloatArray], list[DondoloWarning]]:
    """Measure, levels, annual frequencies of the mean and of the fractiles of a site, from files of one calculation.

    The last are the notes of how they were read.
    """
    files = [_read(path) for path in paths]
    if not files:
        raise argument_error("not_given", "paths", ": must be at least one file")
    first = files[0]
    for other in files[1:]:
        for what in ("imt", "time", "levels"):
            if getattr(other, what) != getattr(first, what):
                shown = f"{what} differs" if what == "levels" else f"{getattr(other, what)} and {getattr(first, what)}"
                raise InputError(f"{other.path}: does not belong to the calculation of {first.path}: {shown}")
        if not np.array_equal(other.sites, first.sites):
            raise InputError(f"{other.path}: has other sites than {first.path}")
    row = _row(first, site)
    try:
        im, unit = im_of(first.imt)
    except InputError as error:
        raise error.placed(str(first.path)) from None
    levels = np.array([over(level, unit) for level in first.levels])
    quantiles = {one.kind: one for one in files if one.kind.startswith("quantile-") and len(files) > 1}
    means = [one for one in files if one not in quantiles.values()]
    if len(means) != 1 or len(quantiles) != len(files) - 1:
        kinds = ", ".join(repr(one.kind or Path(one.path).name) for one in files)
        raise argument_error(
            "wrong_length", "paths", f": must be one mean and its quantiles, each once; there are {kinds}"
        )
    poe = np.stack([means[0].poe[row], *(one.poe[row] for one in quantiles.values())])
    curves = [levelled(curve) for curve in poe]
    poe = np.stack([curve for curve, _ in curves])
    # No frequency follows from certainty, nor from a probability that is rounded to 0
    kept = np.all(poe < 1.0, axis=0) & (poe[0] > 0.0)
    if kept.sum() < 2:
        raise InputError(f"{first.path}: site {row}: has fewer than two levels with a probability between 0 and 1")
    raised = sum(int(which.sum()) for _, which in curves)
    notes = [note_of(f"{first.path}: site {row}", raised)] if raised else []
    if not kept.all():
        left = ", ".join(f"{level:g}" for level in levels[~kept])
        text = f"{first.path}: site {row}: levels with a probability of 0 or 1 are left out: {left}"
        notes.append(DondoloWarning(text, "note"))
    with np.errstate(over="ignore"):
        frequency = -np.log1p(-poe[:, kept]) / first.time
    shares = [_share(one) for one in quantiles.values()]
    return im, levels[kept], frequency[0], dict(zip(shares, frequency[1:], strict=True)), notes


def write_curves(
    folder: str | os.PathLike[str],
    im: str,
    levels: FloatArray,
    curves: Mapping[str, FloatArray],
    site: tuple[float, float],
    time: float,
) -> list[str]:
    """Write annual frequencies of statistics ('mean', 'quantile-0.16' ...) at a site, a file each."""
    imt, unit = imt_of(im)
    longitude, latitude = _coordinates(site)
    if not Path(folder).is_dir():
        raise DondoloError(f"{os.fspath(folder)}: is not a folder")
    titles = ["lon", "lat", "depth", *(_LEVEL + times(level, unit) for level in levels)]
    written = []
    for kind, frequency in curves.items():
        name = f"quantile_curve-{kind.removeprefix('quantile-')}" if kind != "mean" else "hazard_curve-mean"
        path = Path(folder, f"{name}-{imt}.csv")
        about = f"kind='{kind}', investigation_time={time!r}, imt='{imt}'"
        commas = "," * (len(titles) - 1)
        cells = [longitude, latitude, 0.0, *-np.expm1(-frequency * time)]
        row = ",".join(repr(float(cell)) for cell in cells)
        tables.write_lines(path, [f"#{commas}\"generated_by='dondolo', {about}\"", ",".join(titles), row])
        written.append(str(path))
    return written


def _read(path: str) -> _File:
    """A file of curves, checked."""
    lines = [line for line in read_text(path).splitlines() if line.strip()]
    comments = [line for line in lines if line.startswith("#")]
    try:
        rows = list(csv.reader(line for line in lines if not line.startswith("#")))
    except csv.Error as error:
        raise InputError(f"{path}: is not a CSV table: {error}") from None
    if len(rows) < 2:
        raise InputError(f"{path}: must have a line of titles and one of each site")
    titles = [title.strip() for title in rows[0]]
    here = [i for i, title in enumerate(titles) if title.startswith(_LEVEL)]
    if not here or not {"lon", "lat"} <= set(titles):
        raise InputError(f"{path}: must have the columns lon, lat, and {_LEVEL}x of each level x")
    about = " ".join(comments)
    kind, imt, time = (_told(about, what) for what in ("kind", "imt", "investigation_time"))
    name = Path(path).name
    if not kind:
        found = re.search(r"#\W*(mean|quantile-[\d.]+)\b", about) or re.match(r"hazard_curve-(mean)-", name)
        quantile = re.match(r"quantile_curve-([\d.]+)-", name)
        kind = found.group(1) if found else f"quantile-{quantile.group(1)}" if quantile else ""
    if not time:
        raise InputError(f"{path}: must have a comment with investigation_time=, in years")
    years = _number(path, "investigation_time", time)
    if not 0.0 < years < np.inf:
        raise InputError(f"{path}: investigation_time = {years:g}: must be positive, in years")
    if not imt:
        raise InputError(f"{path}: must have a comment with imt=, the intensity measure")
    levels = tuple(titles[i].removeprefix(_LEVEL) for i in here)
    for level in levels:
        _number(path, "level", level)
    columns = [titles.index("lon"), titles.index("lat"), *here]
    values = np.empty((len(rows) - 1, len(columns)))
    for i, row in enumerate(rows[1:]):
        if len(row) != len(titles):
            raise InputError(f"{path}: site {i}: has {len(row)} cells, the titles are {len(titles)}")
        values[i] = [_number(path, f"site {i}: {titles[j]}", row[j]) for j in columns]
    poe = values[:, 2:]
    wrong = ~((poe >= 0.0) & (poe <= 1.0))
    if wrong.any():
        i, j = np.argwhere(wrong)[0]
        raise InputError(f"{path}: site {i}: {_LEVEL}{levels[j]} = {poe[i, j]:g}: must lie between 0 and 1")
    return _File(path, kind, imt, years, levels, values[:, :2], poe)


def _told(about: str, what: str) -> str:
    """What a comment says of something: what='value', what="value" or what=value."""
    found = re.search(rf"""\b{what}\s*=\s*(?:'([^']*)'|"+([^"]*)"+|([^\s,"']+))""", about)
    return next((word for word in found.groups() if word), "") if found else ""


def _number(path: str, what: str, text: str) -> float:
    try:
        return as_written(text)
    except ValueError:
        raise InputError(f"{path}: {what} = {text!r}: must be a number") from None


def _share(file: _File) -> float:
    """Share of a quantile."""
    return _number(file.path, "kind", file.kind.removeprefix("quantile-"))


def _row(file: _File, site: Any) -> int:
    """Number of the site that is asked for."""
    count = len(file.sites)
    if site is None:
        if count > 1:
            raise InputError(f"{file.path}: has {count} sites: site must be its number, from 0, or (lon, lat)")
        return 0
    if isinstance(site, (int, np.integer)) and not isinstance(site, bool):
        if not 0 <= site < count:
            raise argument_error(
                "out_of_range", "site", f" = {site}: must be between 0 and {count - 1}, the sites of {file.path}"
            )
        return int(site)
    longitude, latitude = _coordinates(site)
    # Degrees of longitude are the shorter ones away from the equator, and go round
    east = (file.sites[:, 0] - longitude + 180.0) % 360.0 - 180.0
    off = np.hypot(east * np.cos(np.radians(latitude)), file.sites[:, 1] - latitude)
    row = int(np.argmin(off))
    if off[row] > _NEAR:
        near = f"({file.sites[row, 0]:g}, {file.sites[row, 1]:g})"
        raise InputError(f"site = ({longitude:g}, {latitude:g}): is not in {file.path}; the nearest is {near}")
    return row


def _coordinates(site: Any) -> tuple[float, float]:
    """Longitude and latitude."""
    try:
        longitude, latitude = site
    except (TypeError, ValueError):
        raise argument_error("wrong_type", "site", f" = {site!r}: must be (longitude, latitude) in degrees") from None
    east, north = as_number("longitude", longitude), as_number("latitude", latitude)
    if not (-180.0 <= east <= 360.0 and -90.0 <= north <= 90.0):
        raise argument_error(
            "out_of_range", "site", f" = ({east:g}, {north:g}): must be (longitude, latitude) in degrees"
        )
    return east, north
