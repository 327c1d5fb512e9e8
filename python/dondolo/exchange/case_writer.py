"""Writing a case of a wall and a study that were made in Python."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

import numpy as np

from dondolo._base.arguments import argument_error, as_path, instance_of
from dondolo._fortran.files import whole_file
from dondolo._fortran.library import properties
from dondolo.analysis.stripe_runs import Study
from dondolo.checks.ntc import CodeCheck
from dondolo.errors import InputError, Problem, silent
from dondolo.exchange.case_text import case_text
from dondolo.exchange.cases import Case, read_case
from dondolo.walls.wall import Wall


def write_case(
    path: str | os.PathLike[str],
    wall: Wall,
    study: Study,
    *,
    catalogue: str | os.PathLike[str],
    title: str = "",
    output: str = "",
    check: CodeCheck | None = None,
) -> None:
    """Write a case that the executable runs to the results of ``study.run(wall)``, with units and meanings as comments.

    The case is read back before it is put in place: a wall or study that it cannot represent is refused.

    Parameters
    ----------
    path : path
        The case, a file that does not exist yet.
    wall : Wall
        The wall.
    study : Study
        Records, levels, measure, polarity and solver.
    catalogue : path
        Catalogue of the records of the study, from the folder of the case.
    title, output : str
        Title, and prefix of the result files; ``out/`` and the name of the case if left out.
    check : CodeCheck, optional
        A check of the wall, whose site and factors the case gets.

    Raises
    ------
    InputError
        There is a file of this name; the catalogue has other records than the study; the case cannot represent the
        study.

    Examples
    --------
    >>> import dondolo as dd
    >>> records = dd.RecordSet(dd.synthetic_records(6.5, 10.0, "shallow", n_records=4))
    >>> records.to_catalogue("records.csv")
    >>> wall, study = dd.OneSidedWall(1.5, 0.25), dd.Study(dd.read_catalogue("records.csv"), [0.6, 0.8, 1.0])
    >>> dd.write_case("parapet.nml", wall, study, catalogue="records.csv", title="Parapet")
    >>> dd.run_case("parapet.nml", progress=False).stripes.collapses.tolist() == study.run(wall).collapses.tolist()
    True
    """
    target = Path(os.fsdecode(as_path(path)))
    instance_of("wall", wall, Wall)
    instance_of("study", study, Study)
    if target.exists() or target.is_symlink():
        raise InputError(f"{target}: already exists: remove it, or choose another path")
    if study._request.rows is not None:
        raise argument_error(
            "not_together",
            "study",
            ": its records have levels of their own, which belong in a catalogue: write the case by hand",
        )
    job = {"task": "stripes", "title": title, "output": output or f"out/{target.stem}"}
    settings: dict[str, dict[str, Any]] = {"job": job, **wall_settings(wall), **study._settings()}
    settings["records"] = {"catalogue": os.fsdecode(as_path(catalogue)), **settings["records"]}
    settings["solver"]["gravity"] = wall.gravity
    if check is not None:
        settings["check"] = instance_of("check", check, CodeCheck)._settings()[0]
    text = case_text(settings, commented=True) + "\n"
    with whole_file(target) as part:
        part.write_text(text, encoding="utf-8", newline="\n")
        try:
            with silent():
                written = read_case(part)
        except InputError as error:
            named = (Problem(*(word.replace(str(part), str(target)) for word in one)) for one in error.errors)
            raise InputError(str(error).replace(str(part), str(target)), errors=named) from None
        _compare(written, wall, study)


def wall_settings(wall: Wall) -> dict[str, dict[str, Any]]:
    """The groups &wall and &building of a wall."""
    known = {name: value for name, value in wall._properties().items() if value is not None}
    own = {row.name for row in properties("wall")}
    values = {name: _plain(value) for name, value in known.items() if name in own}
    groups = {"wall": {"name": wall.name, "mechanism": wall.mechanism} | values}
    if wall.building is not None:
        given = wall.building._values()
        groups["building"] = {name: _plain(value) for name, value in given.items() if value is not None}
    return groups


def _plain(value: Any) -> Any:
    """A value without NumPy's types."""
    return value.tolist() if isinstance(value, (np.ndarray, np.generic)) else value


def _compare(case: Case, wall: Wall, study: Study) -> None:
    """Refuse a case that does not say what it was written from."""
    found = case.population.walls[0]
    known = found._properties()
    differs = [name for name, value in wall._properties().items() if not _same(known[name], value)]
    if differs or found.gravity != wall.gravity:
        raise InputError(f"wall '{wall.name}': a case cannot contain its {', '.join(differs) or 'gravity'}")
    sums = [[record.checksum for record in records] for records in (case.records, study.records)]
    if sums[0] != sums[1]:
        raise argument_error(
            "not_together", "catalogue", f": has {len(sums[0])} records, others than the {len(sums[1])} of the study"
        )
    verticals = ([record.vertical for record in records] for records in (case.records, study.records))
    if not all(_same(*pair) for pair in zip(*verticals, strict=True)):
        raise argument_error(
            "not_together", "records", ": a case cannot contain the factors on their vertical components"
        )
    for group, values in study._settings().items():
        for name, value in values.items():
            if not _same(case.settings[group][name], value):
                raise argument_error("not_together", "study", f": a case cannot contain its {name} = {value}")


def _same(one: Any, other: Any) -> bool:
    """Whether a property has one value in both, or in neither."""
    if one is None or other is None:
        return one is other
    return bool(np.array_equal(np.atleast_1d(one), np.atleast_1d(other)))
