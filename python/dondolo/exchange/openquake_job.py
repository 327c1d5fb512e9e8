"""A folder of inputs with which the OpenQuake engine computes damage and losses of the walls of a run."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import numpy as np

from dondolo._base.arguments import FloatArray, argument_error, instance_of
from dondolo._base.files import as_file, read_bytes
from dondolo._fortran.files import whole_file
from dondolo._fortran.library import constants
from dondolo._fortran.origins import derived_mark
from dondolo._storage import tables
from dondolo.curves.losses import loss_levels, write_consequences, write_vulnerability
from dondolo.curves.nrml import write_nrml
from dondolo.errors import DondoloError
from dondolo.exchange.exposure import Assets, Functions, assets_of, functions_of
from dondolo.exchange.job_files import damage_job, risk_job, scenario_job
from dondolo.exchange.results import Results
from dondolo.hazard.hazard import HazardCurve
from dondolo.hazard.openquake import CurveFiles, imt_of, is_of_openquake, times

# Levels of the hazard: at least so many, and no farther apart in ln x
_FEWEST, _STEP = 60, 0.06
# Years of the hazard: enough for probabilities of exceedance that single precision resolves, 10 events at most
_YEARS, _EVENTS = 50.0, 10.0
# Level that no earthquake exceeds, in the last that is known
_NEVER = 1.001
# Length of a degree of latitude [km]
_DEGREE = 111.2


def write_openquake(
    results: Results,
    folder: str | os.PathLike[str],
    *,
    site: tuple[float, float] | None = None,
    hazard: HazardCurve | str | os.PathLike[str] | None = None,
    ratios: Mapping[str, float] | None = None,
    fatalities: Mapping[str, float] | None = None,
    motion: Sequence[str | os.PathLike[str]] | None = None,
    imt: str | None = None,
) -> list[str]:
    """Write the inputs of OpenQuake for the walls of a run: exposure, functions and jobs.

    Parameters
    ----------
    results : Results
        Of `read_results` or `run_case`: a population, a facade or a wall. Columns x_lon and x_lat [degrees], x_value
        and x_occupants of its table of walls are those of the assets: value and occupants of all walls of a row.
    folder : path
        A new or empty folder, or one that was written so before, whose files are replaced.
    site : (float, float), optional
        Longitude and latitude of all walls [degrees], where the table has no x_lon and x_lat.
    hazard : HazardCurve or path, optional
        Hazard of the town: one curve, or a file of hazard curves that OpenQuake has exported. Without it the jobs run
        after a job of hazard, by ``oq engine --run job_damage.ini --hc ID``.
    ratios : mapping of str to float, optional
        Damage state -> share of the value that is lost, as of `write_vulnerability`; without it there are no losses.
    fatalities : mapping of str to float, optional
        Damage state -> share of the occupants that die, for the scenario; needs x_occupants.
    motion : sequence of path, optional
        The ground motion of a scenario: a table of ground-motion fields and one of their sites, as OpenQuake takes
        them, or grid.xml and uncertainty.xml of a ShakeMap.
    imt : str, optional
        OpenQuake's measure of a run against saavg(T1:T2), as of `write_nrml`.

    Returns
    -------
    list of str
        Paths of the files. The comments of the jobs say what their results mean.

    Raises
    ------
    InputError
        A folder with other files; a run without curves, or of designs; walls whose place is not known; a hazard of
        another measure; ratios of other states.
    DondoloError
        A file cannot be written.

    Examples
    --------
    >>> import dondolo as dd
    >>> walls = dd.Population([dd.OneSidedWall(1.5, 0.25, name="a"), dd.OneSidedWall(1.8, 0.25, name="b")])
    >>> records = dd.synthetic_records(6.5, 10.0, "shallow", n_records=10)
    >>> dd.typology(walls, records, [0.6, 0.8, 1.0], progress=False).write_results("town")
    >>> files = dd.write_openquake(dd.read_results("town"), "job", site=(11.62, 44.83))
    >>> [file.rpartition("/")[2] for file in files][-1]
    'job_damage.ini'
    """
    instance_of("results", results, Results)
    functions, _ = functions_of(results)
    assets = assets_of(results, functions, site)
    if fatalities is not None and assets.occupants is None:
        raise argument_error("not_given", "fatalities", ": must not be given without a column x_occupants of the walls")
    im = next(iter(next(iter(functions.values())).values())).im
    name, unit = imt_of(im, imt)
    levels = _levels(functions)
    run = results.run.run
    target = _folder(folder)
    used = {risk_id: functions[risk_id] for risk_id in dict.fromkeys(assets.risk_ids.values())}
    paths = [target / file for file in ("exposure.xml", "exposure.csv", "taxonomy_mapping.csv", "fragility.xml")]
    _write_exposure(paths[0], paths[1], assets)
    mapping = {
        "taxonomy": [*assets.risk_ids],
        "risk_id": [*assets.risk_ids.values()],
        "weight": [1] * len(assets.risk_ids),
    }
    tables.write_lines(paths[2], tables.csv_lines(mapping, []))
    write_nrml(paths[3], used, id="walls", imt=imt if im.startswith("saavg(") else None, run=run)
    consequences: dict[Any, Mapping[str, float]] = {}
    if ratios is not None:
        paths.append(target / "vulnerability.xml")
        write_vulnerability(paths[-1], used, ratios, imt=imt, run=run)
        consequences["losses"] = ratios
    if fatalities is not None:
        consequences["fatalities"] = fatalities
    if consequences:
        paths.append(target / "consequences.csv")
        write_consequences(paths[-1], used, consequences)
    facts: dict[str, Any] = {
        "mark": derived_mark("model", run),
        "imt": name,
        "levels": f"logscale({levels[0] * unit:.4g}, {levels[-1] * unit:.4g}, {len(levels)})",
        "has_occupants": assets.occupants is not None,
        "has_consequences": bool(consequences),
    }
    if hazard is not None:
        paths.append(target / "hazard_curves.csv")
        facts |= _write_hazard(paths[-1], hazard, (im, name, unit), levels, assets)
    jobs = {"job_damage.ini": damage_job(facts)}
    if ratios is not None:
        jobs["job_risk.ini"] = risk_job(facts)
    if motion is not None:
        copied = _copy_motion(target, motion)
        paths += copied
        jobs["job_scenario.ini"] = scenario_job(facts, [path.name for path in copied])
    # The damage job comes last: a folder that has it is one of these.
    for file in sorted(jobs, reverse=True):
        paths.append(target / file)
        tables.write_lines(paths[-1], jobs[file])
    return [str(path) for path in paths]


def _folder(folder: str | os.PathLike[str]) -> Path:
    """The folder, which is made if it is new; one with files of others is refused."""
    target = as_file("folder", folder)
    if target.is_dir():
        job = target / "job_damage.ini"
        ours = job.is_file() and job.read_bytes().startswith(b"# dondolo model ")
        if not ours and any(target.iterdir()):
            raise argument_error(
                "out_of_range",
                "folder",
                f" = {target}: has other files: must be a new or empty folder, or one of such jobs",
            )
        return target
    try:
        target.mkdir(parents=True)
    except OSError as error:
        raise DondoloError(f"{target}: cannot be made: {error.strerror}") from None
    return target


def _levels(functions: Functions) -> FloatArray:
    """Levels of the hazard for all functions."""
    ends = [loss_levels(list(curves.values()))[[0, -1]] for curves in functions.values()]
    # The levels go on beyond the curves: the engine counts no earthquake above the last.
    low, high = min(low for low, _ in ends), max(high for _, high in ends)
    return np.geomspace(low, high, max(_FEWEST, int(np.ceil(np.log(high / low) / _STEP)) + 1))


def _write_exposure(model: Path, table: Path, assets: Assets) -> None:
    """Write the exposure model and the table of its assets."""
    space = "http://openquake.org/xmlns/nrml/0.5"
    root = ElementTree.Element("nrml", {"xmlns": space})
    about = {"id": "walls", "category": "buildings", "taxonomySource": "dondolo"}
    exposure = ElementTree.SubElement(root, "exposureModel", about)
    ElementTree.SubElement(exposure, "description").text = f"Walls, by dondolo {constants().version}"
    kinds = ElementTree.SubElement(ElementTree.SubElement(exposure, "conversions"), "costTypes")
    ElementTree.SubElement(kinds, "costType", {"name": "structural", "type": "aggregated", "unit": "value"})
    ElementTree.SubElement(exposure, "occupancyPeriods").text = "" if assets.occupants is None else "night"
    ElementTree.SubElement(exposure, "tagNames")
    ElementTree.SubElement(exposure, "assets").text = table.name
    ElementTree.indent(root)
    tables.write_lines(
        model, ["<?xml version='1.0' encoding='utf-8'?>", ElementTree.tostring(root, encoding="unicode")]
    )
    columns: dict[str, Any] = {
        "id": assets.ids,
        "lon": assets.places[:, 0],
        "lat": assets.places[:, 1],
        "taxonomy": assets.taxonomies,
        "number": assets.numbers,
        "structural": assets.values,
    }
    if assets.occupants is not None:
        columns["night"] = assets.occupants
    tables.write_lines(table, tables.csv_lines(columns, [], tables.shortest))


def _write_hazard(
    path: Path,
    hazard: HazardCurve | str | os.PathLike[str],
    measure: tuple[str, str, int],
    levels: FloatArray,
    assets: Assets,
) -> dict[str, Any]:
    """Write the hazard of the town, and what the jobs have to know of it."""
    im, imt, unit = measure
    if not isinstance(hazard, HazardCurve):
        source = as_file("hazard", hazard)
        if is_of_openquake(source):
            files = CurveFiles([os.fspath(source)], im if im.startswith("saavg(") else None)
            _check_measure(files.im, im)
            _copy(source, path)
            return {"hazard": path.name, "time": files.time, "distance": _distance(assets, files.sites)}
        hazard = HazardCurve.from_csv(source)
    _check_measure(hazard.im, im)
    if not hazard.endless:
        low, high = max(levels[0], hazard.levels[0]), min(levels[-1], hazard.levels[-1])
        if not low < high:
            ends = f"{hazard.levels[0]:g} to {hazard.levels[-1]:g}"
            raise argument_error("out_of_range", "hazard", f" = {ends}: must reach levels of the curves")
        inner = np.geomspace(low, high, len(levels))
        inner[[0, -1]] = low, high
        levels = inner
    frequency = np.asarray(hazard(levels))
    years = float(min(_YEARS, max(_EVENTS / frequency[0], 1.0)))
    centre = assets.places.mean(axis=0)
    # The engine counts no earthquake above the last level; with one that is never exceeded, those above the last known
    # level count as if they were at it, as the lower bound of `Risk` has them.
    levels, frequency = np.append(levels, _NEVER * levels[-1]), np.append(frequency, 0.0)
    titles = ["lon", "lat", "depth", *(f"poe-{times(level, unit)}" for level in levels)]
    about = f"generated_by='dondolo {constants().version}', kind='mean', investigation_time={years!r}, imt='{imt}'"
    cells = [*centre, 0.0, *-np.expm1(-frequency * years)]
    row = ",".join(repr(float(cell)) for cell in cells)
    tables.write_lines(path, [f'#{"," * (len(titles) - 1)}"{about}"', ",".join(titles), row])
    return {"hazard": path.name, "time": years, "distance": _distance(assets, centre[None])}


def _copy(source: Path, target: Path) -> None:
    """Copy a file, which appears whole or not at all."""
    content = read_bytes(source)
    with whole_file(target) as part:
        part.write_bytes(content)


def _check_measure(found: str, wanted: str) -> None:
    if found != wanted:
        raise argument_error("out_of_range", "hazard", f": is of '{found}': must be of '{wanted}', as the curves are")


def _distance(assets: Assets, sites: FloatArray) -> float:
    """Distance within which every asset has a site [km], rounded up."""
    farthest = 0.0
    for longitude, latitude in np.unique(assets.places, axis=0):
        east = (sites[:, 0] - longitude + 180.0) % 360.0 - 180.0
        off = np.hypot(east * np.cos(np.radians(latitude)), sites[:, 1] - latitude)
        farthest = max(farthest, float(off.min()))
    return float(np.ceil(max(1.0, 1.02 * _DEGREE * farthest)))


def _copy_motion(folder: Path, motion: Sequence[str | os.PathLike[str]]) -> list[Path]:
    """Copy the ground motion of a scenario beside its job."""
    if isinstance(motion, (str, os.PathLike)) or len(motion) != 2:
        raise argument_error("wrong_type", "motion", ": must be two files: fields and sites, or those of a ShakeMap")
    sources = [as_file("motion", one) for one in motion]
    suffixes = {source.suffix.lower() for source in sources}
    names = {frozenset([".csv"]): ("gmfs.csv", "sites.csv"), frozenset([".xml"]): ("grid.xml", "uncertainty.xml")}
    if frozenset(suffixes) not in names:
        raise argument_error("out_of_range", "motion", ": must be two tables, .csv, or two files of a ShakeMap, .xml")
    copied = [folder / name for name in names[frozenset(suffixes)]]
    for source, target in zip(sources, copied, strict=True):
        if not (target.exists() and target.samefile(source)):
            _copy(source, target)
    return copied
