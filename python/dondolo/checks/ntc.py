"""Checks of a wall by NTC 2018 and Circolare 7/2019: kinematic, and the criterion for time histories.

What is computed, and by which formulas, is in Fortran (``check/ntc_check.f90``) and in docs/code_checks.md.
"""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any, Literal

import numpy as np

from dondolo._base.arguments import argument_error, instance_of
from dondolo._base.shown import Shown
from dondolo._fortran.checks import (
    CalculationItem,
    SheetRow,
    SiteInput,
    calculation_items,
    check_notes,
    dynamic_sheet,
    kinematic_sheet,
    site_input,
)
from dondolo._fortran.library import constants, properties
from dondolo._fortran.tables import Safety
from dondolo._storage import tables
from dondolo._storage.saved import Saved, part_of_results
from dondolo.analysis.request import Polarity
from dondolo.analysis.solver import Solver, as_solver
from dondolo.analysis.stripe_runs import multiple_stripe
from dondolo.analysis.stripes import Stripes
from dondolo.curves.fragility import Fragility
from dondolo.errors import DondoloWarning
from dondolo.records.codes import LimitState, Site
from dondolo.records.record import Record
from dondolo.walls.wall import Wall, upload

if TYPE_CHECKING:
    from matplotlib.axes import Axes

part_of_results(SheetRow)

# What is not satisfied of a tie, in words
_OPEN = {
    "hierarchy": "anchor gives way before the bar yields",
    "plate_verified": "plate too thin",
    "anchor_checked": "anchor not checked",
}

# What a check comes to in words
Verdict = Literal[
    "verified", "verified if its ties are", "verified if no hinge slides", "not verified", "not applicable"
]
# The ultimate limit state that a verdict rests on
UltimateState = Literal["SLV", "SLC"]
# The same in numbers
_OUTCOMES = ("ratio", "zeta_e", "capacity_ag", "capacity_pga", "return_period_capacity", "probability",
             "probability_low", "probability_high")  # fmt: skip


@dataclass(frozen=True, eq=False, repr=False, kw_only=True)
class CodeCheck(Shown, Saved):
    """A check of a wall by a building code: a sheet, every number with its formula.

    Attributes
    ----------
    wall : Wall
        The wall.
    site : Site
        The hazard.
    rows : tuple of SheetRow
        The sheet: method, limit state, quantity, symbol, value, unit, formula, meaning and item of each number.
    """

    wall: Wall
    site: Site
    rows: tuple[SheetRow, ...]

    @property
    def pga(self) -> float:
        """Peak acceleration at the site a_g S [g], of SLV where limit states differ."""
        return self.value("site", "SLV", "pga")

    def value(self, method: str, limit_state: str, quantity: str, *, item: str | None = None) -> float:
        """A number of the sheet.

        Parameters
        ----------
        method : str
            'site', 'mechanism', 'tie', 'linear', 'nonlinear', 'dynamic', 'assigned' for the given
            hinge of a strip, or 'untied' for the curve without some ties if that is taken.
        limit_state : str
            'SLD', 'SLV' or 'SLC'; of numbers that are the same in all, any.
        quantity : str
            Its name, such as 'alpha_0', 'd_0' or 'capacity_pga'.
        item : str, optional
            Part of the wall that it belongs to, such as 'tie 2'; the first that has the number if left out.

        Returns
        -------
        float
            In the unit of the sheet.

        Raises
        ------
        InputError
            The sheet has no such number.
        """
        row = self._row(method, limit_state, quantity, item)
        if row is not None:
            return row.value
        raise argument_error(
            "unknown_name",
            "quantity",
            f" = {quantity!r}: the check has none for method {method!r}, state {limit_state!r}",
        )

    def _row(self, method: str, limit_state: str, quantity: str, item: str | None = None) -> SheetRow | None:
        """The first such row, or None."""
        for row in self.rows:
            same = (row.quantity, row.method) == (quantity, method) and row.limit_state in ("", limit_state)
            if same and item in (None, row.item):
                return row
        return None

    def _has(self, method: str, limit_state: str, quantity: str, *, item: str | None = None) -> bool:
        """Whether the sheet has a number, for the arguments of `value`."""
        return self._row(method, limit_state, quantity, item) is not None

    def _is_void(self, row: SheetRow) -> bool:
        """Whether a number is what a check comes to that is not applicable, and would be read as if it held."""
        return row.quantity in _OUTCOMES and (row.method, row.limit_state) in self.not_applicable

    def _outcome(self, key: tuple[str, str], quantity: str) -> float:
        """What a check (method, limit state) comes to; NaN if it is not applicable."""
        row = self._row(*key, quantity)
        return np.nan if row is None or self._is_void(row) else row.value

    def _safety(self) -> Safety:
        """What it comes to."""
        rows = {
            "activation": self._row("mechanism", "", "a_0"),
            "multiplier": self._row("mechanism", "", "alpha_0"),
            "linear": self._row("linear", "SLV", "zeta_e"),
            "nonlinear": self._row("nonlinear", self.ultimate_state, "zeta_e"),
            "years": (years := self._row("nonlinear", self.ultimate_state, "return_period_capacity")),
        }
        bound = {"<": -1.0, ">": 1.0}.get(years.bound, 0.0) if years is not None else 0.0
        return Safety(**{name: np.nan if row is None else row.value for name, row in rows.items()}, bound=bound)

    def _verdict(self, key: tuple[str, str]) -> Verdict:
        """The outcome of a check (method, limit state) in words; none is verified while something of a tie is open."""
        if key in self.not_applicable:
            return "not applicable"
        if not self._verified[key]:
            return "not verified"
        if self.open_ties:
            return "verified if its ties are"
        return "verified if no hinge slides" if self.sliding else "verified"

    @property
    def _given_factor(self) -> float:
        """The confidence factor that is given, by the level of knowledge."""
        row = self._row("mechanism", "", "knowledge_given") or self._row("mechanism", "", "knowledge_factor")
        assert row is not None
        return row.value

    @property
    def items(self) -> tuple[CalculationItem, ...]:
        """The terms of the sums behind alpha_0, M* and e*, the executable's ``_calculation.csv``."""
        return calculation_items(upload((self.wall,)))

    @property
    def notes(self) -> tuple[DondoloWarning, ...]:
        """Remarks: a strip whose given hinge is not the weakest, a period beyond those of the spectrum.

        `str` of each is its sentence, and its code, subject and numbers are those of a warning.
        """
        return check_notes(self.rows)

    @property
    def capacities(self) -> dict[tuple[str, str], float]:
        """Capacity by each kinematic check, as peak acceleration at the site [g]: (method, limit state)."""
        return self._of("capacity_pga")

    @property
    def verified(self) -> dict[tuple[str, str], bool] | None:
        """The verdict of each check: (method, limit state). One that is not applicable verifies nothing.

        None where there is no spectrum at the level of the wall: its base is on a building that is not given.
        """
        return self._verified or None

    @property
    def _verified(self) -> dict[tuple[str, str], bool]:
        return {key: value == 1.0 for key, value in self._of("verified").items()}

    @property
    def not_applicable(self) -> tuple[tuple[str, str], ...]:
        """Checks that are not applicable: linear SLV with q > 1 where an anchor gives way before its bar yields.

        All, where there is no spectrum at the level of the wall.
        """
        return tuple(self._of("applicable"))

    @property
    def required(self) -> tuple[tuple[str, str], ...]:
        """Checks that the verdict on the wall rests on, (method, limit state); all others are information (NTC 8.3)."""
        found = self._of("required")
        # A sheet of an earlier version has no such rows.
        return tuple(key for key, value in found.items() if value) or (("nonlinear", "SLV"),)

    @property
    def ultimate_state(self) -> UltimateState:
        """The ultimate limit state among them."""
        return "SLC" if ("nonlinear", "SLC") in self.required else "SLV"

    @property
    def zeta_e(self) -> float:
        """Safety index of the wall: capacity / demand of the nonlinear check of the ultimate state."""
        return self._outcome(("nonlinear", self.ultimate_state), "ratio")

    @property
    def satisfied(self) -> bool:
        """Whether all that the verdict rests on is verified, and nothing is open of ties or hinges."""
        return all(self._verdict(key) == "verified" for key in self.required)

    @property
    def sliding(self) -> tuple[str, ...]:
        """Hinges that slide before they turn, with the friction that is given, such as 'base hinge'."""
        return tuple(row.item for row in self.rows if row.quantity == "turns_first" and not row.value)

    @property
    def open_ties(self) -> dict[str, tuple[str, ...]]:
        """Ties with unsatisfied requirements: {'tie 1': ('hierarchy', 'plate_verified', 'anchor_checked')}."""
        found: dict[str, tuple[str, ...]] = {}
        for row in self.rows:
            if (
                row.method == "tie"
                and row.quantity in ("hierarchy", "plate_verified", "anchor_checked")
                and not row.value
            ):
                found[row.item] = (*found.get(row.item, ()), row.quantity)
        return found

    def probabilities(self, curve: Fragility) -> dict[tuple[str, str], float]:
        """Probability of collapse at the peak accelerations of the check, by a fragility curve.

        Parameters
        ----------
        curve : Fragility
            Its measure is 'pga'.

        Returns
        -------
        dict
            (method, limit state): at the capacity by each kinematic check, and at a_g S of the site; empty where there
            is no spectrum at the level of the wall.

        Raises
        ------
        InputError
            A curve of another measure.
        DondoloError
            There is no curve.

        Examples
        --------
        >>> import dondolo as dd
        >>> check = dd.check_ntc(dd.OneSidedWall(3.0, 0.25), dd.Site(ag=0.2, f0=2.5, tc_star=0.35, soil="B"))
        >>> found = check.probabilities(dd.Fragility.of_parameters(0.5, 0.4, im="pga"))
        >>> round(found["site", ""], 4)
        0.0333
        """
        if instance_of("curve", curve, Fragility).im != "pga":
            raise argument_error("not_together", "curve", f": its measure is {curve.im!r}, must be 'pga'")
        if self.verified is None:
            return {}
        return {key: float(curve(level)) for key, level in {**self._of("pga", "site"), **self.capacities}.items()}

    def dynamic(
        self,
        stripes: Stripes | Record | Iterable[Record] | Mapping[float, Record | Iterable[Record]],
        *,
        polarity: Polarity = "as_recorded",
        solver: Solver | None = None,
    ) -> CodeCheck:
        """Add the criterion of Circolare 7/2019, C8.7.1.2.1.9, for time histories at the peak acceleration of the site.

        SLV and SLC are verified if no history goes beyond d_0* and the mean of the largest displacements is at most
        that which the nonlinear check allows. That no history may makes the verdict depend on their number.

        Parameters
        ----------
        stripes : Stripes, Record, iterable of Record, RecordSet, or mapping of float to these
            Histories of the wall of the check with PGA for measure and a_g S of the site (`CodeCheck.pga`) among the
            levels; of records, one stripe is run. Records with factors, such as those of a `Selection`, are given as
            ``{check.pga: selection.records}``, with the levels of both limit states where they differ.
        polarity : {'as_recorded', 'reversed', 'both'}
            Of records. A one-sided wall feels their sign: with 'both' it meets the criterion in either direction.
        solver : Solver, optional
            Of records. Their histories are followed to d_0* at least, whatever its `edp_limit`.

        Returns
        -------
        CodeCheck
            With the lines of method 'dynamic'.

        Raises
        ------
        InputError
            Stripes of another wall or measure, without the level, or whose histories end before the capacity (edp_limit
            less than 1).
        """
        states: tuple[LimitState, ...] = ("SLV", "SLC")
        levels = {state: self.site.pga(limit_state=state) for state in states}
        if not isinstance(stripes, Stripes):
            several: Sequence[float] = sorted(set(levels.values()))
            how = as_solver(solver)
            if how.edp_limit is not None and how.edp_limit < 1.0:
                how = replace(how, edp_limit=1.0)
            stripes = multiple_stripe(self.wall, stripes, several, polarity=polarity, progress=False, solver=how)
        if stripes.im != "pga" or stripes.wall != self.wall:
            raise argument_error("not_together", "stripes", ": must be of the wall of the check, with im = 'pga'")
        if stripes.edp_limit < 1.0:
            raise argument_error(
                "out_of_range",
                "edp_limit",
                f" = {stripes.edp_limit:g}: must be at least 1: histories are followed to d_0*",
            )
        rows = tuple(row for row in self.rows if row.method != "dynamic")
        handle = upload((self.wall,))
        for state, level in levels.items():
            found = np.flatnonzero(np.abs(stripes.levels - level) <= constants().same_level * level)
            if not len(found):
                raise argument_error(
                    "out_of_range",
                    "stripes",
                    f": have no level of {level:.10g} g, the peak acceleration of {state}: levels must have "
                    f"check.site.pga(limit_state={state!r}) among them",
                )
            ran = stripes.ran[found[0]]
            edp = stripes.edp[found[0]][ran]
            rows += dynamic_sheet(handle, state, level, len(np.unique(stripes.record_index[ran])), edp)
        return replace(self, rows=rows)

    def plot(self, ax: Axes | None = None, *, curve: Fragility, **options: Any) -> Axes:
        """Draw the checks as lines on a fragility curve, with the probability of collapse at each.

        Parameters
        ----------
        ax : Axes, optional
            Where to draw; a new figure if left out.
        curve : Fragility
            Its measure is 'pga'.
        **options
            Parts to leave out by False (`legend`, `title`, `band`, `bars`, `points`), and keywords of Matplotlib for
            the curve: see docs/printing.md.

        Returns
        -------
        Axes
            Probability of collapse against PGA.

        Raises
        ------
        InputError
            A curve of another measure.
        DondoloError
            There is no curve.
        """
        from dondolo.checks.plots import draw_check

        return draw_check(self, curve, ax, options)

    def to_frame(self) -> Any:
        """The sheet as a pandas DataFrame."""
        return tables.frame(self._table())

    def to_csv(self, path: str | os.PathLike[str]) -> None:
        """Write the sheet as the executable's ``_check.csv``."""
        tables.write_csv(path, self._table())

    def _settings(self) -> tuple[dict[str, Any], SiteInput]:
        """The group &check of a case with this site and these factors, and the same as Fortran takes it."""
        friction = self._row("mechanism", "", "friction")
        values = self.site._values(
            knowledge_factor=self._given_factor,
            behaviour=self.value("linear", "SLV", "behaviour"),
            ultimate_state=self.ultimate_state,
            friction=None if friction is None else friction.value,
            building_period=self._of_states("given_period"),
            building_damping=self._of_states("given_damping"),
        )
        lists = {row.name for row in properties("check") if row.kind == "list"}
        settings = {
            name: np.atleast_1d(value).tolist() if name in lists else value
            for name, value in values.items()
            if value is not None
        }
        return settings, site_input(values)

    def _table(self) -> tables.Table:
        return {name: [getattr(row, name) for row in self.rows] for name in SheetRow._fields}

    def _of(self, quantity: str, *methods: str) -> dict[tuple[str, str], float]:
        return {
            (row.method, row.limit_state): row.value
            for row in self.rows
            if row.quantity == quantity and (not methods or row.method in methods)
        }

    def _of_states(self, quantity: str) -> tuple[float, ...] | None:
        """What is given for each limit state; None if nothing is."""
        return tuple(row.value for row in self.rows if row.quantity == quantity) or None

    def _facts(self) -> list[tuple[str, str]]:
        names = ("alpha_0", "mass_ratio", "a_0", "d_0")
        shown = {row.quantity: row for row in self.rows if row.method == "mechanism"}
        facts = [(shown[name].symbol, f"{shown[name].value:.6g} {shown[name].unit}".strip()) for name in names]
        for method, state in self._verified or self.not_applicable:
            text: str = self._verdict((method, state))
            if (method, state) in self.not_applicable:
                pass
            elif (method, state) in self.capacities:
                text += f", a_g S up to {self.capacities[method, state]:.4g} g"
            else:
                count = [self.value(method, state, name) for name in ("beyond", "histories", "records")]
                beyond, of, records = map(round, count)
                histories = "history" if of == 1 else "histories"
                text += f", {beyond} of {of} {histories} of {records} record{'s' * (records != 1)}"
                # A symmetric wall has no other direction.
                if count[1] == count[2] and self.wall.mechanism == "one_sided":
                    text += " in one direction"
                text += " beyond d_0*"
            if (method, state) in self.required:
                text += ", required"
            facts.append((f"{method} {state}", text))
        facts += [(item, "slides before it turns") for item in self.sliding]
        return [*facts, *((item, ", ".join(_OPEN[name] for name in names)) for item, names in self.open_ties.items())]


def check_ntc(
    wall: Wall,
    site: Site,
    *,
    knowledge_factor: float = 1.35,
    behaviour: float = 2.0,
    ultimate_state: UltimateState = "SLV",
    friction: float | None = None,
    building_period: float | Sequence[float] | None = None,
    building_damping: float | Sequence[float] | None = None,
) -> CodeCheck:
    """Kinematic check of a wall by NTC 2018 and Circolare 7/2019, C8.7.1.2.1.

    Parameters
    ----------
    wall : Wall
        On a `Building` the check is that at its floor, of a strip that at the mean of its two floors.
    site : Site
        The hazard.
    knowledge_factor : float
        Confidence factor FC, 1 to 1.35. The check of a wall without `compressive_strength` has 1.35 all the same.
    behaviour : float
        Behaviour factor q of the linear check, 1 to 2.
    ultimate_state : {'SLV', 'SLC'}
        What the verdict rests on (NTC 8.3), with SLD for a site of class of use IV; SLC needs its own hazard.
    friction : float, optional
        Coefficient of friction at the hinges, for which a wall is marked that slides before it turns.
    building_period : float or sequence of three floats, optional
        Period of the first mode of the building [s], one for all limit states or those of SLD, SLV and SLC; other modes
        keep their ratio to it. If left out, SLV and SLC take the worst of 1 to 2 times that of the `Building`.
    building_damping : float or sequence of three floats, optional
        Damping ratio of the modes of the building, with `building_period`; that of the `Building` if left out.

    Returns
    -------
    CodeCheck
        SLD and SLV linear, SLV and SLC nonlinear.

    Raises
    ------
    InputError
        Factors that the code does not have, a mode without damping.

    Warns
    -----
    DondoloWarning
        A wall that looks as if it were given in another unit.

    Examples
    --------
    >>> import dondolo as dd
    >>> site = dd.Site(ag=0.2, f0=2.5, tc_star=0.35, soil="B")
    >>> check = dd.check_ntc(dd.OneSidedWall(height=3.0, thickness=0.25), site)
    >>> round(check.value("nonlinear", "SLV", "capacity_ag"), 11)
    0.08206169897
    """
    handle = upload((instance_of("wall", wall, Wall),))
    given = instance_of("site", site, Site)._input(
        knowledge_factor=knowledge_factor,
        behaviour=behaviour,
        ultimate_state=ultimate_state,
        friction=friction,
        building_period=building_period,
        building_damping=building_damping,
    )
    return CodeCheck(wall=wall, site=site, rows=kinematic_sheet(handle, given))
