"""Hazard curves of many sites, from the files that the OpenQuake engine exports, read once."""

from __future__ import annotations

import os
from collections import defaultdict
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from dondolo._base.arguments import FloatArray, argument_error
from dondolo._base.files import as_files, described
from dondolo._base.shown import Shown
from dondolo._fortran.library import warn
from dondolo.errors import DondoloWarning, InputError
from dondolo.hazard.hazard import HazardCurve
from dondolo.hazard.openquake import CurveFiles, Site

# Duplicates that a message names
_NAMED = 5


@dataclass(frozen=True, eq=False, repr=False, kw_only=True)
class SiteHazards(Shown):
    """Hazard curves of the sites of one calculation, as `read_site_hazards` reads them.

    ``hazards[12]`` is the curve of a site by its number from 0, ``hazards[13.4, 42.35]`` that of its longitude and
    latitude, to 0.001 degrees; iteration goes over the curves.

    Attributes
    ----------
    sites : ndarray, shape (sites, 2)
        Longitude and latitude [degrees].
    curves : tuple of HazardCurve
    im : str
        Intensity measure.
    duplicates : tuple of tuple of int
        Numbers of sites that have the same coordinates.
    """

    sites: FloatArray
    curves: tuple[HazardCurve, ...]
    im: str
    duplicates: tuple[tuple[int, ...], ...]
    _files: CurveFiles

    def __len__(self) -> int:
        return len(self.curves)

    def __iter__(self) -> Iterator[HazardCurve]:
        return iter(self.curves)

    def __getitem__(self, site: Site) -> HazardCurve:
        """Curve of a site.

        Raises
        ------
        InputError
            There is no such site; its coordinates are those of several sites with different curves.
        """
        row = self._files.row_of(site)
        if not isinstance(site, (int, np.integer)):
            same = next((several for several in self.duplicates if row in several), (row,))
            if any(not _alike(self.curves[row], self.curves[other]) for other in same):
                numbers = ", ".join(map(str, same))
                raise argument_error(
                    "out_of_range",
                    "site",
                    f" = {site}: is that of the sites {numbers}, whose curves differ: give its number",
                )
        return self.curves[row]

    def _facts(self) -> list[tuple[str, str]]:
        facts = [("sites", str(len(self))), ("measure", self.im)]
        return facts + ([("duplicates", str(len(self.duplicates)))] if self.duplicates else [])


def _alike(one: HazardCurve, other: HazardCurve) -> bool:
    return np.array_equal(one.levels, other.levels) and np.array_equal(one.annual_frequency, other.annual_frequency)


def read_site_hazards(
    paths: str | os.PathLike[str] | Sequence[str | os.PathLike[str]], *, im: str | None = None
) -> SiteHazards:
    """Read the hazard curves of all sites that the OpenQuake engine has exported.

    Parameters
    ----------
    paths : path or sequence of path
        As of `HazardCurve.from_openquake`: the file of the mean, with those of its quantiles or without them.
    im : str, optional
        Measure of files whose imt is AvgSA, such as 'saavg(0.2:2)'.

    Returns
    -------
    SiteHazards
        A curve for each row of the files, in their order; each file is read once.

    Raises
    ------
    InputError
        As of `HazardCurve.from_openquake`; a site with fewer than two levels with a probability between 0 and 1.

    Warns
    -----
    DondoloWarning
        Sites with the same coordinates; levels that are left out or frequencies that were levelled, at how many sites.

    Examples
    --------
    >>> import dondolo as dd
    >>> hazard = dd.HazardCurve([0.05, 0.5, 3.0], [0.05, 1e-3, 1e-7])
    >>> files = hazard.to_openquake(".", site=(11.62, 44.83))
    >>> hazards = dd.read_site_hazards(files)
    >>> len(hazards), round(float(hazards[11.62, 44.83](0.5)), 5)
    (1, 0.001)
    """
    names = as_files("paths", paths)
    files = CurveFiles(names, im)
    source = list(map(described, names))
    curves, levelled, shortened = [], 0, 0
    for row in range(len(files.sites)):
        levels, mean, fractiles, raised, without = files.at(row)
        try:
            curves.append(HazardCurve(levels, mean, im=files.im, fractiles=fractiles, source=source))
        except InputError as error:
            raise error.placed(files.place(row)) from None
        levelled += raised > 0
        shortened += len(without) > 0
    where: defaultdict[Any, list[int]] = defaultdict(list)
    for row, site in enumerate(files.sites.tolist()):
        where[tuple(site)].append(row)
    duplicates = tuple(tuple(rows) for rows in where.values() if len(rows) > 1)
    notes = []
    for count, what in (
        (levelled, "frequencies that rise with the level in their last printed digit were levelled"),
        (shortened, "levels with a probability of 0 or 1 are left out"),
    ):
        if count:
            notes.append(DondoloWarning(f"{names[0]}: {count} of {len(curves)} sites: {what}", "note"))
    if duplicates:
        listed = "; ".join(" and ".join(map(str, rows)) for rows in duplicates[:_NAMED])
        more = f"; and {len(duplicates) - _NAMED} more" if len(duplicates) > _NAMED else ""
        notes.append(DondoloWarning(f"{names[0]}: sites with the same coordinates: {listed}{more}", "note"))
    warn(notes)
    return SiteHazards(sites=files.sites, curves=tuple(curves), im=files.im, duplicates=duplicates, _files=files)
