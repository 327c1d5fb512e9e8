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
from dondolo._fortran.library import constants
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
# What cells that are all numbers are made of
_NUMBERS = re.compile(r"[-+.,0-9eE ]*", re.ASCII)
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


def is_average(imt: str) -> bool:
    """Whether a name of OpenQuake is that of an average spectral acceleration, whose periods it does not give."""
    return re.fullmatch(r"AvgSA(\(\d+\.?\d*\))?", imt) is not None


def imt_of(im: str, imt: str | None = None) -> tuple[str, int]:
    """OpenQuake's name of an intensity measure, and its unit in that of dondolo; that of an average is given."""
    if im.startswith("saavg("):
        if imt is None or not is_average(imt):
            given = "is not given" if imt is None else f" = {imt!r}"
            raise argument_error(
                "not_a_word", "imt", f" {given.strip()}: must be 'AvgSA' or 'AvgSA(T)' for {im}, as the hazard has it"
            )
        return imt, 1
    spectral = re.fullmatch(r"sa\((.+)\)", im)
    if spectral:
        return f"SA({float(spectral.group(1))!r})", 1
    if im not in _MEASURES:
        raise argument_error("not_a_word", "im", f" = '{im}': must be 'pga', 'pgv' or 'sa(T)' for OpenQuake")
    return _MEASURES[im]


def im_of(imt: str, average: str | None = None) -> tuple[str, int]:
    """Intensity measure of OpenQuake's name, and OpenQuake's unit in that of dondolo; that of an average is given."""
    word = imt.strip()
    for im, (name, unit) in _MEASURES.items():
        if word.upper() == name:
            return im, unit
    if is_average(word):
        measure = "" if average is None else describe_measure(average).name
        if not measure.startswith("saavg("):
            raise argument_error(
                "not_a_word", "im", f" of {word}: must be given as 'saavg(T1:T2)', whose periods its name does not have"
            )
        return measure, 1
    spectral = re.fullmatch(r"SA\(([^)]+)\)", word, re.IGNORECASE)
    if not spectral:
        raise argument_error("not_a_word", "imt", f" = '{imt}': must be PGA, PGV, SA(T) or AvgSA")
    return describe_measure(f"sa({spectral.group(1)})").name, 1


def is_of_openquake(path: str | os.PathLike[str]) -> bool:
    """Whether a file has hazard curves as the engine exports them: a line of titles with poe-x."""
    lines = (line for line in read_text(path).splitlines() if line.strip() and not line.startswith("#"))
    return any(title.strip().startswith(_LEVEL) for title in next(lines, "").split(","))


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


class CurveFiles:
    """Hazard curves of one calculation and measure: those of the mean at its sites, and of quantiles.

    Parameters
    ----------
    paths : sequence of str
        The file of the mean, and those of the quantiles.
    im : str, optional
        Measure of files whose imt is AvgSA.

    Attributes
    ----------
    im : str
    sites : ndarray, shape (sites, 2)
        Longitude and latitude of each site [degrees].
    time : float
        Investigation time [years].
    """

    def __init__(self, paths: Sequence[str], im: str | None = None) -> None:
        files = [_read(path) for path in paths]
        if not files:
            raise argument_error("not_given", "paths", ": must be at least one file")
        first = files[0]
        for other in files[1:]:
            for what in ("imt", "time", "levels"):
                if getattr(other, what) != getattr(first, what):
                    both = f"{getattr(other, what)} and {getattr(first, what)}"
                    shown = f"{what} differs" if what == "levels" else both
                    raise InputError(f"{other.path}: does not belong to the calculation of {first.path}: {shown}")
            if not np.array_equal(other.sites, first.sites):
                raise InputError(f"{other.path}: has other sites than {first.path}")
        try:
            self.im, unit = im_of(first.imt, im)
        except InputError as error:
            raise error.placed(str(first.path)) from None
        self._levels = np.array([over(level, unit) for level in first.levels])
        quantiles = {one.kind: one for one in files if one.kind.startswith("quantile-") and len(files) > 1}
        means = [one for one in files if one not in quantiles.values()]
        if len(means) != 1 or len(quantiles) != len(files) - 1:
            kinds = ", ".join(repr(one.kind or Path(one.path).name) for one in files)
            raise argument_error(
                "wrong_length", "paths", f": must be one mean and its quantiles, each once; there are {kinds}"
            )
        self._first = first
        self._shares = [_share(one) for one in quantiles.values()]
        self._poe = np.stack([means[0].poe, *(one.poe for one in quantiles.values())], axis=1)
        self.sites, self.time = first.sites, first.time

    def row_of(self, site: Site | None) -> int:
        """Number of the site that is asked for."""
        return _row(self._first, site)

    def place(self, row: int) -> str:
        """A site in words."""
        return f"{self._first.path}: site {row}"

    def at(self, row: int) -> tuple[FloatArray, FloatArray, dict[float, FloatArray], int, FloatArray]:
        """Levels, annual frequencies of the mean and of the fractiles at a site.

        The last two are how many values were levelled, and the levels that are left out.
        """
        levelled_curves = [levelled(curve) for curve in self._poe[row]]
        poe = np.stack([curve for curve, _ in levelled_curves])
        # No frequency follows from certainty, nor from a probability that is rounded to 0
        kept = np.all(poe < 1.0, axis=0) & (poe[0] > 0.0)
        if kept.sum() < 2:
            raise InputError(f"{self.place(row)}: has fewer than two levels with a probability between 0 and 1")
        with np.errstate(over="ignore"):
            frequency = -np.log1p(-poe[:, kept]) / self._first.time
        raised = sum(int(which.sum()) for _, which in levelled_curves)
        fractiles = dict(zip(self._shares, frequency[1:], strict=True))
        return self._levels[kept], frequency[0], fractiles, raised, self._levels[~kept]


def read_curves(
    paths: Sequence[str], site: Site | None, average: str | None
) -> tuple[str, FloatArray, FloatArray, dict[float, FloatArray], list[DondoloWarning]]:
    """Measure, levels, annual frequencies of the mean and of the fractiles of a site, from files of one calculation.

    The last are the notes of how they were read.
    """
    files = CurveFiles(paths, average)
    row = files.row_of(site)
    levels, mean, fractiles, raised, without = files.at(row)
    notes = [note_of(files.place(row), raised)] if raised else []
    if len(without):
        left = ", ".join(f"{level:g}" for level in without)
        text = f"{files.place(row)}: levels with a probability of 0 or 1 are left out: {left}"
        notes.append(DondoloWarning(text, "note"))
    return files.im, levels, mean, fractiles, notes


def write_curves(
    folder: str | os.PathLike[str],
    im: str,
    levels: FloatArray,
    curves: Mapping[str, FloatArray],
    site: tuple[float, float],
    time: float,
    average: str | None,
) -> list[str]:
    """Write annual frequencies of statistics ('mean', 'quantile-0.16' ...) at a site, a file each."""
    imt, unit = imt_of(im, average)
    longitude, latitude = coordinates_of(site)
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
        head = f"#{commas}\"generated_by='dondolo {constants().version}', {about}\""
        tables.write_lines(path, [head, ",".join(titles), row])
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
    for i, row in enumerate(rows[1:]):
        if len(row) != len(titles):
            raise InputError(f"{path}: site {i}: has {len(row)} cells, the titles are {len(titles)}")
    values = _values(path, [[row[j] for j in columns] for row in rows[1:]], [titles[j] for j in columns])
    poe = values[:, 2:]
    wrong = ~((poe >= 0.0) & (poe <= 1.0))
    if wrong.any():
        i, j = np.argwhere(wrong)[0]
        raise InputError(f"{path}: site {i}: {_LEVEL}{levels[j]} = {poe[i, j]:g}: must lie between 0 and 1")
    return _File(path, kind, imt, years, levels, values[:, :2], poe)


def _values(path: str, cells: list[list[str]], titles: list[str]) -> FloatArray:
    """Cells (sites, columns) as numbers: all at once if they are, one by one to find the one that is not."""
    if _NUMBERS.fullmatch(",".join(map(",".join, cells))):
        try:
            values = np.array(cells).astype(np.float64)
        except ValueError:
            values = np.array([[np.nan]])
        if np.isfinite(values).all():
            return values
    return np.array(
        [
            [_number(path, f"site {i}: {title}", cell) for title, cell in zip(titles, row, strict=True)]
            for i, row in enumerate(cells)
        ]
    )


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
    longitude, latitude = coordinates_of(site)
    # Degrees of longitude are the shorter ones away from the equator, and go round
    east = (file.sites[:, 0] - longitude + 180.0) % 360.0 - 180.0
    off = np.hypot(east * np.cos(np.radians(latitude)), file.sites[:, 1] - latitude)
    row = int(np.argmin(off))
    if off[row] > _NEAR:
        near = f"({file.sites[row, 0]:g}, {file.sites[row, 1]:g})"
        raise InputError(f"site = ({longitude:g}, {latitude:g}): is not in {file.path}; the nearest is {near}")
    return row


def coordinates_of(site: Any) -> tuple[float, float]:
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
