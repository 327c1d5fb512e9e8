"""Case files."""

from __future__ import annotations

import json
import os
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

from dondolo._base.arguments import FloatArray, argument_error, as_path, wrong_type
from dondolo._base.shown import Shown
from dondolo._fortran import _core
from dondolo._fortran.library import Parcel, as_text, receive, warn_of_notes
from dondolo._fortran.records import levels_in_words, unpack_records
from dondolo._fortran.walls import rows_of, unpack_walls
from dondolo._storage.run_file import RunFile
from dondolo.analysis.stripe_fits import States
from dondolo.checks.ntc import UltimateState
from dondolo.exchange.case_checks import check_options, site_of
from dondolo.exchange.case_text import Settings
from dondolo.records.codes import Site
from dondolo.records.record import Record, as_records, record_from
from dondolo.records.record_set import RecordSet
from dondolo.records.suite import upload
from dondolo.walls.population import Population
from dondolo.walls.wall_columns import WallColumns

# What a case has of a parcel as it is
_WORDS = ("task", "title", "output", "im", "polarity", "engine", "states")
_NUMBERS = ("rtol", "atol", "edp_limit", "threads", "scale", "initial_rotation", "initial_velocity")


@dataclass(frozen=True, eq=False, repr=False, kw_only=True)
class Case(Shown):
    """A case file, read and checked.

    Attributes
    ----------
    task : str
        'history', 'stripes' or 'typology'.
    title, output : str
        Title, and path prefix of the result files; running a case from Python writes none.
    population : Population
        The walls; one unless the task is 'typology'.
    records : tuple of Record
    im, polarity, engine : str
    levels : ndarray, shape (levels,)
    edp_thresholds : ndarray, shape (thresholds,)
        Damage states, rotation / capacity; the last is edp_limit, collapse.
    states : {'separate', 'ordinal'}
        How their curves are fitted, as `Stripes.fit_damage_states`.
    rtol, atol, edp_limit : float
    estimate_error, certify : bool
    threads : int
    record_index : int
        Which record a time history is of, from 0.
    scale : float
        Factor on it, with the sign of its polarity.
    initial_rotation, initial_velocity : float
        State of the wall at the start of a time history [rad, rad/s].
    site : Site or None
        Hazard of a check by NTC 2018.
    knowledge_factor, behaviour : float
        Factors of that check.
    ultimate_state : str
        Ultimate limit state that its verdict rests on.
    friction : float or None
        Coefficient of friction at the hinges, for that check.
    building_period, building_damping : tuple of floats or None
        Period and damping ratio of the building for the limit states, for that check.
    designs : bool
        Whether the walls are designs of one wall, each to be compared with the first.
    settings : mapping
        Its groups, each a mapping of variables to values, defaults included.
    """

    task: str
    title: str
    output: str
    population: Population
    records: tuple[Record, ...]
    im: str
    polarity: str
    engine: str
    levels: FloatArray
    edp_thresholds: FloatArray
    states: States
    rtol: float
    atol: float
    edp_limit: float
    estimate_error: bool
    certify: bool
    threads: int
    record_index: int
    scale: float
    initial_rotation: float
    initial_velocity: float
    site: Site | None = None
    knowledge_factor: float = 1.35
    behaviour: float = 2.0
    ultimate_state: UltimateState = "SLV"
    friction: float | None = None
    building_period: tuple[float, ...] | None = None
    building_damping: tuple[float, ...] | None = None
    designs: bool = False
    settings: Settings

    @classmethod
    def from_text(cls, text: str, records: Iterable[Record], *, name: str = "case.nml") -> Case:
        """Read a case from its text, with records that are in memory. No file that it names is opened.

        Parameters
        ----------
        text : str
            Contents of a case file.
        records : iterable of Record
            The accelerograms, in place of those of its catalogue; of a `RecordSet` without levels.
        name : str
            Name of the case in messages.

        Returns
        -------
        Case

        Raises
        ------
        InputError
            As `read_case`; a case that needs a table of walls or of a wall's terms, or vertical components where the
            records have none.

        Examples
        --------
        >>> import dondolo as dd
        >>> records = dd.synthetic_records(6.5, 10.0, "shallow", n_records=4)
        >>> text = '''
        ...     &wall    mechanism = 'one_sided', height = 1.5, thickness = 0.25 /
        ...     &records catalogue = 'records.csv' /
        ...     &stripes levels = 0.6, 0.8, 1.0 /
        ...     '''
        >>> case = dd.results.Case.from_text(text, records)
        >>> case.settings["wall"]["density"]
        1800
        """
        if not isinstance(text, str):
            raise wrong_type("text", text, "a string")
        if isinstance(records, RecordSet) and records.level is not None:
            raise argument_error(
                "not_together", "records", ": have levels of their own, which a case takes from its catalogue only"
            )
        several = tuple(as_records(records))
        suite = upload(several)
        # A text of f2py would end at NUL
        content = text.encode("utf-8", "replace").replace(b"\0", b"\xc0\x80")
        return case_of(receive(_core.cases.read_text(as_text("name", name), content, suite.number)), several)

    def _facts(self) -> list[tuple[str, str]]:
        facts = [
            ("title", self.title),
            ("task", self.task),
            ("population", repr(self.population)),
            ("records", str(len(self.records))),
        ]
        if self.task != "history":
            facts.append(("levels", levels_in_words(self.levels, self.im)))
        return facts


def read_case(path: str | os.PathLike[str]) -> Case:
    """Read a case file and all files that it names, and check them.

    Parameters
    ----------
    path : path
        A namelist file.

    Returns
    -------
    Case

    Raises
    ------
    InputError
        Errors of the case; of the table of a population all of them, one per line. Messages are those of the
        executable.

    Examples
    --------
    >>> from pathlib import Path
    >>> import dondolo as dd
    >>> records = dd.RecordSet(dd.synthetic_records(6.5, 10.0, "shallow", n_records=4))
    >>> records.to_catalogue("records.csv")
    >>> _ = Path("parapet.nml").write_text(
    ...     '''
    ...     &wall    mechanism = 'one_sided', height = 1.5, thickness = 0.25 /
    ...     &records catalogue = 'records.csv' /
    ...     &stripes levels = 0.6, 0.8, 1.0 /
    ...     '''
    ... )
    >>> case = dd.read_case("parapet.nml")
    >>> case.population[0].height, case.levels.tolist()
    (1.5, [0.6, 0.8, 1.0])
    """
    return case_of(receive(_core.cases.read_case(as_path(path))))


def case_of(parcel: Parcel, given: tuple[Record, ...] | None = None) -> Case:
    """A case as Fortran sends it, with its records unless they are given; how its tables were read is warned of."""
    values: dict[str, Any] = {name: parcel[name] for name in (*_WORDS, *_NUMBERS)}
    values |= {name: bool(parcel[name]) for name in ("estimate_error", "certify", "designs")}
    values |= {name: parcel[name].copy() for name in ("levels", "edp_thresholds")}
    settings = json.loads(parcel["settings"])["settings"]
    if "check" in settings:
        values |= check_options(settings["check"])
        values["site"] = site_of(RunFile(version="", settings=settings))
    walls = WallColumns.of_data(unpack_walls(parcel))
    records = given or tuple(record_from(data) for data in unpack_records(parcel))
    warn_of_notes(parcel["notes"])
    return Case(
        **values,
        population=Population(walls, **rows_of(parcel)),
        records=records,
        record_index=parcel["record"] - 1,
        settings=settings,
    )
