"""Designs of one wall compared on the same records: the gain of each, and its mass of steel."""

from __future__ import annotations

import os
import threading
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike

from dondolo._base.arguments import FloatArray, argument_error, as_number, instance_of, tails
from dondolo._fortran.checks import check_columns
from dondolo._fortran.records import blank_unit
from dondolo._fortran.tables import Safety, TableColumns, design_columns, plain
from dondolo._storage import tables
from dondolo._storage.saved import Saved
from dondolo.analysis.request import Polarity
from dondolo.analysis.solver import Solver
from dondolo.analysis.stripe_fits import sample_of
from dondolo.analysis.stripe_runs import Study
from dondolo.analysis.stripes import Stripes
from dondolo.analysis.work import Work
from dondolo.checks.ntc import CodeCheck, check_ntc
from dondolo.curves.comparison import Comparison
from dondolo.curves.fragility import Fragility
from dondolo.curves.table import flat
from dondolo.errors import InputError, Interrupted, silent
from dondolo.populations.combination import combine_rows
from dondolo.populations.flags import Flags
from dondolo.populations.typology import Typology
from dondolo.populations.typology_tables import write_typology
from dondolo.records.codes import Site
from dondolo.records.level_rows import lasting
from dondolo.records.record import Record
from dondolo.walls.population import Population
from dondolo.walls.ties import given_ties
from dondolo.walls.wall import Wall, upload

if TYPE_CHECKING:
    from matplotlib.axes import Axes

# Checks that are shown beside the curves: method and limit state
_CHECKS = (("linear", "SLV"), ("nonlinear", "SLV"))

# Of the intervals of the files
_CONFIDENCE = 0.95

# Of steel [kg/m3]
_DENSITY = 7850.0


@dataclass(frozen=True, eq=False, repr=False, kw_only=True)
class DesignComparison(tables.Tabular, Saved):
    """Fragility curves of several designs of a wall under the same records; the first design is the reference.

    Attributes
    ----------
    names : tuple of str
        The designs.
    stripes : tuple of Stripes
        The analysis of each; empty for results read from files.
    curves : tuple of Fragility
        Their curves.
    comparisons : tuple of Comparison or None
        Each design against the first, paired by records; None where one of the two has no curve or no standard errors.
    steel : ndarray, shape (designs,)
        Mass of steel in each [kg per m of wall].
    alpha_0 : ndarray, shape (designs,)
        Static acceleration that each resists with its ties at yield [g], to which the linear kinematic check of the
        Italian code is proportional.
    confidence : float
        Of the intervals.
    checks : tuple of CodeCheck
        The kinematic check of each at the site, by `check_ntc`; empty without a site.
    typology : Typology or None
        The designs as alternatives, with the counts and curves of all; None where they have levels of their own.
    """

    names: tuple[str, ...]
    stripes: tuple[Stripes, ...]
    curves: tuple[Fragility, ...]
    comparisons: tuple[Comparison | None, ...]
    steel: FloatArray
    alpha_0: FloatArray
    confidence: float
    checks: tuple[CodeCheck, ...] = ()
    typology: Typology | None = None

    @property
    def im(self) -> str:
        """Intensity measure of the curves."""
        return self.curves[0].im

    @property
    def ratio(self) -> FloatArray:
        """Median of each design / median of the first, shape (designs,); NaN without a comparison."""
        return np.array([np.nan if one is None else one.ratio for one in self.comparisons])

    @property
    def ratio_interval(self) -> FloatArray:
        """Confidence intervals of these ratios, shape (designs, 2)."""
        return np.array([(np.nan, np.nan) if one is None else one.ratio_interval for one in self.comparisons])

    @property
    def gain_per_kg(self) -> FloatArray:
        """Relative increase of the median for each kg of steel more than in the first, shape (designs,) [m/kg]."""
        more = self.steel - self.steel[0]
        gain: FloatArray = np.full(len(more), np.nan)
        np.divide(self.ratio - 1.0, more, out=gain, where=more > 0.0)
        return gain

    @property
    def static_ratio(self) -> FloatArray:
        """Static acceleration `alpha_0` of each / that of the first: the gain by a check of forces."""
        ratio: FloatArray = self.alpha_0 / self.alpha_0[0]
        return ratio

    def plot(self, ax: Iterable[Any] | None = None, **options: Any) -> Axes:
        """Draw the curves of all designs, and the ratios of their medians to that of the first.

        Parameters
        ----------
        ax : two Axes, optional
            Where to draw; a new figure if left out.
        **options
            Parts to leave out by False (`legend`, `title`, `bars`, `points`), and keywords of Matplotlib for the
            curves: see docs/printing.md.

        Returns
        -------
        Axes
            The first of the figure's: probability of collapse against intensity, with the capacity of each by the
            nonlinear check of SLV where there is one and the measure is PGA; and the ratios with their intervals,
            beside those of the static accelerations.
        """
        from dondolo.retrofit.plots import draw_designs

        return draw_designs(self, ax, options)

    def write_results(self, prefix: str | os.PathLike[str], *, spreadsheet_safe: bool = False) -> None:
        """Write all tables into files of the names that the executable gives them, as `Typology.write_results`.

        `read_results` gives the same, but for `stripes`, and in its `comparisons` the ratios of the medians alone.

        Parameters
        ----------
        prefix, spreadsheet_safe
            As for `Typology.write_results`.

        Raises
        ------
        InputError
            Designs with levels of their own, or intervals of another confidence than 95 %, for which the files have no
            place; another run is writing them, or a file of the same name is not a result of dondolo.
        DondoloError
            A file cannot be written.
        """
        if self.typology is None:
            raise argument_error(
                "not_together", "levels", ": designs with levels of their own have no place in the files of results"
            )
        if self.confidence != _CONFIDENCE:
            raise InputError(f"confidence = {self.confidence:g}: must be {_CONFIDENCE:g} in the files of results")
        more, settings = {"_designs.csv": self._columns()}, {}
        if self.checks:
            settings["check"], site = self.checks[0]._settings()
            curves = [flat(curve) for curve in self.curves]
            more["_checks.csv"] = check_columns(upload(self.typology.walls), site, self.im, curves)
        write_typology(self.typology, prefix, spreadsheet_safe, more, settings, self.confidence)

    def _columns(self) -> TableColumns:
        """Columns of ``_designs.csv``."""
        safety = [check._safety() for check in self.checks] or [Safety()] * len(self.names)
        columns = {
            "steel": self.steel,
            "alpha_0": self.alpha_0,
            "ratio": self.ratio,
            "ratio_low": self.ratio_interval[:, 0],
            "ratio_high": self.ratio_interval[:, 1],
            "p_value": np.array([np.nan if one is None else one.p_value for one in self.comparisons]),
        }
        return design_columns(self.names, self.im, [flat(curve) for curve in self.curves], columns, safety)

    def _table(self) -> tables.Table:
        return {
            **plain(self._columns()),
            **{
                f"{method}_{state.lower()}": [check._outcome((method, state), "capacity_pga") for check in self.checks]
                for method, state in _CHECKS
                if self.checks
            },
        }

    def _facts(self) -> list[tuple[str, str]]:
        unit = blank_unit(self.im)
        facts = []
        for name, curve, one, steel in zip(self.names, self.curves, self.comparisons, self.steel, strict=True):
            text = f"theta {curve.theta:.4g}{unit}" if curve.has_fit else f"no curve ({curve.status})"
            if one is not None and curve is not self.curves[0]:
                low, high = one.ratio_interval
                text += f", x {one.ratio:.3g} ({low:.3g} to {high:.3g})"
            if np.isfinite(steel):
                text += f", steel {steel:.3g} kg/m"
            facts.append((name, text))
        for name, check in zip(self.names, self.checks, strict=False):
            words = {key: f"{level:.4g} g" for key, level in check.capacities.items()}
            words |= dict.fromkeys(check.not_applicable, "not applicable")
            stood = ", ".join(f"{' '.join(key)} {words[key]}" for key in _CHECKS)
            facts.append((f"{name}, check", f"withstands a_g S of {stood}"))
        return facts


def compare_designs(
    designs: Mapping[str, Wall],
    records: Record | Iterable[Record] | Mapping[float, Record | Iterable[Record]],
    levels: ArrayLike | Mapping[str, ArrayLike],
    *,
    steel: Mapping[str, float] | None = None,
    im: str = "pga",
    polarity: Polarity = "as_recorded",
    confidence: float = 0.95,
    site: Site | None = None,
    solver: Solver | None = None,
    threads: int = 0,
    progress: bool = True,
    stop: threading.Event | None = None,
) -> DesignComparison:
    """Compare designs of one wall, such as strengthenings, on the same records.

    A record that is hard on the wall is hard on all its designs. Ratios of their medians are therefore known much
    better than the medians: their intervals come from the differences record by record (`compare`).

    Parameters
    ----------
    designs : mapping of str to Wall
        The wall in each design; the first is what the others are compared with, as a rule the wall as it stands.
    records : Record, iterable of Record, RecordSet, or mapping of float to these
        The accelerograms, as for `multiple_stripe`.
    levels : array_like, or mapping of str to array_like
        Levels of intensity, as for `multiple_stripe`, for all designs or for each.
    steel : mapping of str to float, optional
        Mass of steel in each design [kg per m of wall]; of a design that is not named, that of the wall's ties.
    im, polarity, solver, threads, progress, stop
        As for `multiple_stripe`.
    confidence : float
        Of the intervals.
    site : Site, optional
        Where the wall stands: every design is checked there by `check_ntc`, with its own defaults.

    Returns
    -------
    DesignComparison

    Raises
    ------
    InputError
        No designs, names without a design, and errors of `multiple_stripe` and, with a site, `check_ntc`.
    Interrupted
        Ctrl-C or `stop`; its `partial` is the comparison of the designs that are complete.

    Warns
    -----
    DondoloWarning
        Warnings of `multiple_stripe`; curves that were not fitted, whose ratios are unknown.

    Examples
    --------
    >>> import dondolo as dd
    >>> records = dd.synthetic_records(magnitude=6.5, distance=10.0, site="shallow", n_records=20)
    >>> designs = {"as it stands": dd.OneSidedWall(3.0, 0.30), "thicker": dd.OneSidedWall(3.0, 0.45)}
    >>> found = dd.compare_designs(designs, records, levels=[0.2, 0.4, 0.6, 0.8, 1.0, 1.2], progress=False)
    >>> bool(found.ratio[1] > 1.0)
    True
    """
    if not isinstance(designs, Mapping) or not designs:
        raise argument_error("wrong_type", "designs", ": must be a mapping of names to walls, at least one")
    names = tuple(str(name) for name in designs)
    walls = [instance_of(f"designs[{name!r}]", wall, Wall) for name, wall in designs.items()]
    several = lasting(records)
    tails(confidence)
    masses = _masses(designs, steel)
    # The stripes say what a wall looks like.
    with silent():
        checks = () if site is None else tuple(check_ntc(wall, site) for wall in walls)
    grids = [levels[name] if isinstance(levels, Mapping) else levels for name in _known(designs, levels, "levels")]
    given = {"im": im, "polarity": polarity, "solver": solver, "threads": threads}
    alike = {id(grid): Study(several, grid, **given) for grid in grids}  # type: ignore[arg-type]
    alpha_0 = np.array([wall.plastic_acceleration / wall.gravity for wall in walls])
    stripes: list[Stripes] = []

    def complete() -> DesignComparison:
        curves = tuple(one.fit() for one in stripes)
        n = len(stripes)
        has_levels = all(np.array_equal(one.levels, stripes[0].levels) for one in stripes)
        return DesignComparison(
            names=names[:n],
            stripes=tuple(stripes),
            curves=curves,
            comparisons=tuple(_against(curve, curves[0], confidence) for curve in curves),
            steel=masses[:n],
            alpha_0=alpha_0[:n],
            confidence=float(confidence),
            checks=checks[:n],
            typology=_alternatives(names[:n], stripes) if has_levels else None,
        )

    for wall, grid in zip(walls, grids, strict=True):
        try:
            stripes.append(alike[id(grid)].run(wall, progress=progress, stop=stop))
        except Interrupted as interrupted:
            told = f"interrupted: {len(stripes)} of {len(walls)} designs are complete; of the next {interrupted}"
            with silent():
                raise Interrupted(told, complete() if stripes else None) from None
    return complete()


def _alternatives(names: Sequence[str], stripes: Sequence[Stripes]) -> Typology:
    """The designs as the walls of a typology, under their names."""
    first = stripes[0]
    runs = np.asarray(first.ran.reshape(len(first), -1, first.n_records).any(axis=1).T, dtype=np.float64)
    sizes = np.array([len(one.record_names) for one in stripes], dtype=np.int32)
    bits = np.concatenate([np.packbits(one.collapsed & one.ran) for one in stripes])
    typology = combine_rows(
        Population(tuple(one.wall._renamed(name) for name, one in zip(names, stripes, strict=True))),
        first.im,
        first.levels,
        np.array([first.edp_limit]),
        np.array([one.collapses for one in stripes], dtype=np.int32).T[None],
        np.array([one.histories for one in stripes], dtype=np.int32).T,
        Work.total(work for one in stripes for work in one.runs.values()),
        Flags(sizes, len(first), 1, runs, sample_of(first).clusters, bits),
        are_alternatives=True,
    )
    return replace(typology, ties=tuple(one.ties for one in stripes), record_formats=first.record_formats)


def _known(designs: Mapping[str, Wall], given: object, what: str) -> Iterable[str]:
    """The names of the designs, for each of which a mapping must have something."""
    if isinstance(given, Mapping):
        for name in designs:
            if name not in given:
                raise argument_error("unknown_name", what, f": none for the design {name!r}")
        for name in given:
            if name not in designs:
                raise argument_error("unknown_name", what, f": {name!r} is not a design")
    return designs


def _masses(designs: Mapping[str, Wall], steel: Mapping[str, float] | None) -> FloatArray:
    """Mass of steel in each design [kg/m]."""
    given = steel or {}
    for name in given:
        if name not in designs:
            raise argument_error("unknown_name", "steel", f": {name!r} is not a design")
    masses = np.array([as_number(f"steel[{name!r}]", given.get(name, _steel(wall))) for name, wall in designs.items()])
    for name, mass in zip(designs, masses, strict=True):
        if name in given and not 0.0 <= mass < np.inf:
            raise InputError(f"steel[{name!r}] = {mass:g}: must not be negative")
    return masses


def _against(curve: Fragility, first: Fragility, confidence: float) -> Comparison | None:
    """A design against the first."""
    return curve.compare(first, confidence=confidence) if curve.has_errors and first.has_errors else None


def _steel(wall: Wall) -> float:
    """Mass of the ties of a wall [kg/m]."""
    return _DENSITY * float(sum(tie.section * tie.length for tie in given_ties(wall)))
