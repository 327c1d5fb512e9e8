"""Typological fragility: the curve of a population of walls."""

from __future__ import annotations

import dataclasses
import os
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from dondolo._base.arguments import argument_error, as_number, one_of
from dondolo._base.shown import Shown, shown_dispersion
from dondolo._fortran.curves import warnings_of_union
from dondolo._fortran.library import warn
from dondolo._fortran.records import levels_in_words
from dondolo._fortran.tables import plain
from dondolo._storage import tables
from dondolo._storage.saved import Saved
from dondolo.curves.fragility_model import Function
from dondolo.curves.plots import parameters
from dondolo.errors import InputError
from dondolo.populations.curve import PopulationCurve
from dondolo.populations.row_curves import RowCurves
from dondolo.populations.stored_curves import StoredCurves
from dondolo.populations.typology_tables import TableName, comments_of, tables_of, write_typology
from dondolo.walls.wall import notes_on_supports

if TYPE_CHECKING:
    from matplotlib.axes import Axes


@dataclass(frozen=True, eq=False, repr=False, kw_only=True)
class Typology(RowCurves, Shown, Saved):
    """Fragility of a population of walls.

    A damage state is reached where rotation / capacity reaches a threshold; collapse is the last. Attributes are those
    of collapse unless stated otherwise; `at` gives the other states.

    Attributes
    ----------
    population : Population
        The walls, one row per mechanism.
    im : str
        Intensity measure.
    levels : ndarray, shape (levels,)
    edp_thresholds : ndarray, shape (thresholds,)
        Rotation / capacity, increasing; the last is that of collapse, edp_limit.
    exceedances : ndarray of int, shape (thresholds, levels, rows)
        How many histories of each row reach them.
    histories : ndarray of int, shape (levels, rows)
        Histories of each row in each stripe.
    curves : tuple of Fragility
        Curve of each row.
    combined : dict of str to Fragility
        Curve of each wall or facade by its name: that of its row, or where it has several mechanisms or one that may
        not occur, the lognormal fitted to the combined fractions. Mechanisms that occur together are independent.
    groups : tuple of Group
        The curves: those of the whole population, then those of each group, in the order they appear in; for each
        mechanism, and the last for all, if there are several or one that may not occur. Empty for the designs of a
        case, which are alternatives: there is no mean over them.
    work : Work
        Work done and skipped for all walls.
    flags : Flags
        The states that every history reaches, packed, which `bootstrap` over records needs; None for results that were
        read back.
    warnings : tuple of DondoloWarning
        Warnings of the run, and of the curves of this state.
    stored_curves : StoredCurves
        Contents of the files on the curves, in place of the flags; None for results of a run.
    union_curves, group_union_curves : dict of str to Fragility
        `unions` and `group_unions`; None if they are not known.
    union_counts : dict of str to ndarray
        Collapses at each level of 'wall NAME' counted in the same histories, and mean fractions of 'group NAME'.
    ties : tuple of TieCounts
        What the histories do to the ties of each row: how many make each `yielded` and `broken`, and its mean and
        largest plastic elongation; None where that is not known.
    record_formats : tuple of str
        `Stripes.record_formats`.

    Examples
    --------
    >>> import dondolo as dd
    >>> walls = [dd.OneSidedWall(1.5, 0.25, name="a"), dd.OneSidedWall(1.8, 0.25, name="b")]
    >>> people = dd.Population(walls, group_names=["old", "new"])
    >>> records = dd.synthetic_records(6.5, 10.0, "shallow", n_records=10)
    >>> found = dd.typology(people, records, [0.6, 0.8, 1.0], edp_thresholds=[0.4], progress=False)
    >>> axes = found.plot_groups(), found.plot_damage_states(), found.plot_combination()
    """

    _states: dict[float, Typology] = field(default_factory=dict)

    def _with_union_warnings(self) -> Typology:
        """The same with what there is to say of the curve of one facade, which is its number."""
        if not self.facade or not self.knows_unions:
            return self
        union = self.unions[self.facade]
        said = warnings_of_union(self.facade, union.status, union.theta)
        return dataclasses.replace(self, warnings=tuple(dict.fromkeys([*self.warnings, *said])))

    def __getitem__(self, key: str | tuple[str, str]) -> PopulationCurve:
        """A curve of the population, or of a part of it: of a mechanism, or of a mechanism and a group.

        Parameters
        ----------
        key : str or (str, str)
            Mechanism, 'all' for all that can occur; group, '' for the whole population.

        Returns
        -------
        PopulationCurve

        Raises
        ------
        InputError
            There is no such mechanism or group.
        """
        several = (key, "") if isinstance(key, str) else key
        if not (isinstance(several, tuple) and [type(word) for word in several] == [str, str]):
            raise InputError(f"typology[{key!r}]: must be a mechanism, or a mechanism and a group")
        mechanism, group = several
        if self.are_alternatives:
            raise InputError(
                f"typology[{key!r}]: the walls are designs of one wall, alternatives with no curve in common; those of"
                " each are in curves"
            )
        known = {one.group: None for one in self.groups}
        one_of("group", group, known)
        of_group = {one.mechanism: one for one in self.groups if one.group == group}
        # Where there is but one mechanism, and it can occur in all walls, its curve is that of all.
        last = list(of_group)[-1]
        one_of("mechanism", mechanism, (*of_group, "all"))
        return PopulationCurve._of(of_group[last if mechanism == "all" else mechanism], self)

    def at(self, edp_threshold: float) -> Typology:
        """The typology of one damage state.

        Parameters
        ----------
        edp_threshold : float
            One of `edp_thresholds`.

        Returns
        -------
        Typology
            With this threshold alone.

        Raises
        ------
        InputError
            There is no such threshold.

        Warns
        -----
        DondoloWarning
            Walls that have no fit in this state, a fit that extrapolates.
        """
        value = as_number("edp_threshold", edp_threshold)
        place = np.flatnonzero(self.edp_thresholds == value)
        if len(place) == 0:
            known = ", ".join(f"{one:g}" for one in self.edp_thresholds)
            raise argument_error("not_a_word", "edp_threshold", f" = {value}: must be one of {known}")
        if len(self.edp_thresholds) == 1:
            return self
        if value not in self._states:
            number = int(place[0])
            self._states[value] = self._at_last() if number == len(self.edp_thresholds) - 1 else self._at(number)
        return self._states[value]

    def _at_last(self) -> Typology:
        """The typology of collapse alone."""
        last, counts = self.edp_thresholds[-1:], self.exceedances[-1:]
        stored = None if self.stored_curves is None else self.stored_curves.at(-1)
        return dataclasses.replace(
            self, edp_thresholds=last, exceedances=counts, stored_curves=stored, flags=self.flags, _states={}
        )

    def _at(self, number: int) -> Typology:
        """The typology of another state."""
        # These two modules need each other: curves make a typology, which makes those of its states.
        from dondolo.populations.combination import combine_rows

        place = slice(number, number + 1)
        state = combine_rows(
            self.population,
            self.im,
            self.levels,
            self.edp_thresholds[place],
            self.exceedances[place],
            self.histories,
            self.work,
            None if self.flags is None else self.flags.at(number),
            self.are_alternatives,
        )
        if self.stored_curves is not None:
            state = self.stored_curves.at(number).put_into(state)._with_union_warnings()
        warn(warning.placed(f"damage state {self.edp_thresholds[number]:g}: ") for warning in state.warnings)
        return dataclasses.replace(state, ties=self.ties, record_formats=self.record_formats)

    def nrml_functions(self) -> tuple[dict[str, dict[str, Function]], list[str]]:
        """Fragility functions of a population for `write_nrml`, one per group and mechanism, with damage states.

        Of one facade, or one wall with several mechanisms, there is one function by its name: the curve of the same
        histories, `Typology.unions`. Designs have one function each by their names. Where collapse is the only state
        these are the lognormals themselves.

        They are the mean curves of each group, which the report integrates too, and not the lognormals fitted to them:
        those tend to 1 in OpenQuake, also where some walls cannot collapse, and cross.

        Returns
        -------
        functions : dict of dict
            Taxonomy (group/mechanism, 'population' for the whole; the name of a facade or a design) ->
            damage state ('edp_0p4' for 0.4, 'collapse') -> curve.
        sentences : list of str
            Where curves were raised, and by how much; names that had to be changed.

        Notes
        -----
        Levels reach from where the probability is 1e-9, or a thousandth of the lowest level of the analysis, to where
        it has come to all but 0.14 % of its end, or a hundred times the highest. There are 12 to 40, close where the
        curves bend and where their risk comes from: so many that under hazards x^-1 to x^-3 frequencies are within
        0.3 % and probabilities within 0.004, unless 40 are not enough.

        A less severe state is at least as probable as a more severe one. The means of fitted curves may cross; where
        they do, the curve of the less severe state is raised to that of the more severe. Fractions of walls without a
        fit may decrease from level to level; the mean then stays where it is. Both only ever raise a curve.

        Examples
        --------
        >>> import dondolo as dd
        >>> walls = [dd.OneSidedWall(1.5, 0.25, name="a"), dd.OneSidedWall(1.8, 0.25, name="b")]
        >>> records = dd.synthetic_records(magnitude=6.5, distance=10.0, site="shallow", n_records=10)
        >>> typology = dd.typology(walls, records, levels=[0.6, 0.8, 1.0], progress=False)
        >>> functions, sentences = typology.nrml_functions()
        >>> list(functions)
        ['population/one_sided']
        >>> dd.write_nrml("centre.xml", functions)
        """
        from dondolo.populations.nrml_functions import nrml_functions

        return nrml_functions(self)

    def plot_union(self, ax: Axes | None = None, *, name: str | None = None, **options: Any) -> Axes:
        """Draw the mechanisms of a facade or of a wall, their product, and the union of the same histories.

        Parameters
        ----------
        ax : Axes, optional
            Where to draw; a new figure if left out.
        name : str, optional
            One of `unions`; must be given if there are several.
        **options
            Parts to leave out by False (`legend`, `title`, `points`), and keywords of Matplotlib for the curves: see
            docs/printing.md.

        Returns
        -------
        Axes
            Probability of collapse against intensity.

        Raises
        ------
        InputError
            There is no such facade, or the results were read back from files without `unions`.
        """
        from dondolo.populations.plots import draw_union

        if not self.unions:
            raise argument_error("not_given", "unions", ": there are none; they are of walls with several mechanisms")
        chosen = next(iter(self.unions)) if name is None and len(self.unions) == 1 else name
        one_of("name", chosen, self.unions)
        return draw_union(self, str(chosen), ax, options)

    def plot(self, ax: Axes | None = None, **options: Any) -> Axes:
        """Draw the curve of the whole population, ``typology["all"].plot()``, or of one facade, `plot_union`.

        Parameters
        ----------
        ax : Axes, optional
            Where to draw; a new figure if left out.
        **options
            Parts to leave out by False (`legend`, `title`, `band`, `points`), and keywords of Matplotlib for the mean:
            see docs/printing.md.

        Returns
        -------
        Axes
            Probability of collapse against intensity.

        Raises
        ------
        InputError
            The walls are designs of one wall.
        """
        return self.plot_union(ax, **options) if self.facade and self.knows_unions else self["all"].plot(ax, **options)

    def plot_combination(self, ax: Axes | None = None, *, group: str = "", **options: Any) -> Axes:
        """Draw the mean curve of each mechanism, and that of all together with its fractiles.

        A thin line beside a mean curve is the lognormal with the parameters of the legend.

        Parameters
        ----------
        ax : Axes, optional
            Where to draw; a new figure if left out.
        group : str
            Only the walls of this group; '' for the whole population.
        **options
            Parts to leave out by False (`legend`, `title`, `band`), and keywords of Matplotlib for the curves: see
            docs/printing.md.

        Returns
        -------
        Axes
            Probability of collapse against intensity: of a mechanism, if it can occur; of all, each with its
            probability of occurrence.

        Raises
        ------
        InputError
            There is no such group.
        """
        from dondolo.populations.plots import draw_combination

        return draw_combination(self, ax, group, options)

    def plot_groups(self, ax: Axes | None = None, *, mechanism: str = "all", **options: Any) -> Axes:
        """Draw the mean curve of each group beside that of the population.

        A thin line beside a mean curve is the lognormal with the parameters of the legend.

        Parameters
        ----------
        ax : Axes, optional
            Where to draw; a new figure if left out.
        mechanism : str
            Only the walls of this mechanism; groups without it are left out.
        **options
            Parts to leave out by False (`legend`, `title`), and keywords of Matplotlib for the curves: see
            docs/printing.md.

        Returns
        -------
        Axes
            Probability of collapse against intensity.

        Raises
        ------
        InputError
            The population has no groups, or no such mechanism.
        """
        from dondolo.populations.plots import draw_groups

        return draw_groups(self, ax, mechanism, options)

    def plot_damage_states(
        self,
        ax: Axes | None = None,
        *,
        edp_thresholds: Sequence[float] | None = None,
        mechanism: str = "all",
        group: str = "",
        **options: Any,
    ) -> Axes:
        """Draw the mean curve of each damage state, or the curve of one facade, collapse the boldest.

        A thin line beside a mean curve is the lognormal with the parameters of the legend.

        Parameters
        ----------
        ax : Axes, optional
            Where to draw; a new figure if left out.
        edp_thresholds : sequence of float, optional
            Which of `edp_thresholds`; all if left out.
        mechanism, group : str
            Only the walls of this mechanism, of this group, as in ``typology[mechanism, group]``.
        **options
            Parts to leave out by False (`legend`, `title`, `points`), and keywords of Matplotlib for the curves: see
            docs/printing.md.

        Returns
        -------
        Axes
            Probability to reach each state against intensity.

        Raises
        ------
        InputError
            There is no such threshold, mechanism or group.
        """
        from dondolo.populations.plots import draw_damage_states

        return draw_damage_states(self, ax, edp_thresholds, mechanism, group, options)

    def to_frame(self, table: TableName = "typology") -> Any:
        """One of the tables 'typology', 'fragility', 'stripes', 'walls', 'unions' and 'ties' as a pandas DataFrame."""
        return tables.frame(plain(tables.choose(tables_of(self), table)))

    def to_csv(
        self, path: str | os.PathLike[str], table: TableName = "typology", *, spreadsheet_safe: bool = False
    ) -> None:
        """Write one of the tables 'typology', 'fragility', 'stripes', 'walls', 'unions' and 'ties' like the executable.

        There is one of unions if any wall has several mechanisms, one of ties if any has ties, and none of 'typology'
        for designs.

        With `spreadsheet_safe`, names that a spreadsheet would read as formulas get an apostrophe.
        """
        chosen = plain(tables.choose(tables_of(self), table))
        tables.write_csv(path, chosen, comments_of(self), spreadsheet_safe=spreadsheet_safe)

    def _stored(self) -> dict[str, Any]:
        """What a file has of it: all but what follows from the rest."""
        names = ("population", "im", "levels", "edp_thresholds", "exceedances", "histories", "work", "flags")
        stored = {name: getattr(self, name) for name in (*names, "warnings", "stored_curves", "ties", "record_formats")}
        return stored | {"are_alternatives": self.are_alternatives}

    @classmethod
    def _restored(
        cls, stored_curves: StoredCurves | None, record_formats: tuple[str, ...] = (), **more: Any
    ) -> Typology:
        from dondolo.populations.combination import combine_rows

        rest = {name: more.pop(name) for name in ("warnings", "ties")}
        typology = combine_rows(more.pop("population"), **more)
        if stored_curves is not None:
            typology = stored_curves.put_into(typology)
        return dataclasses.replace(typology, record_formats=record_formats, **rest)

    def write_results(self, prefix: str | os.PathLike[str], *, spreadsheet_safe: bool = False) -> None:
        """Write all tables into files of the names that the executable gives them.

        They are what `read_results` and the commands ``python -m dondolo plot``, ``report`` and ``nrml`` read. They are
        published at once, in place of those of an earlier run; what that run has left with this prefix beside them,
        such as ``out/centre_histories.csv``, is removed.

        Parameters
        ----------
        prefix : path
            Prefix of the files, such as ``out/centre`` for ``out/centre_typology.csv``; folders are made.
        spreadsheet_safe : bool
            Put an apostrophe before names that a spreadsheet would read as formulas; `read_results` removes it.

        Raises
        ------
        InputError
            Walls of different gravity, for which the files have no place; another run is writing them; or a file of the
            same name is not a result of dondolo.
        DondoloError
            A file cannot be written.

        Warns
        -----
        DondoloWarning
            Earlier results are replaced; reports, workbooks or figures are out of date.
        """
        write_typology(self, prefix, spreadsheet_safe)

    def _facts(self) -> list[tuple[str, str]]:
        fitted = sum(curve.has_fit for curve in self.combined.values())
        notes = [*notes_on_supports(self.walls), *self.work._notes()]
        facts = [
            ("walls", f"{len(self.combined)}, {fitted} of them with a curve"),
            ("levels", levels_in_words(self.levels, self.im)),
        ]
        if len(self.edp_thresholds) > 1:
            facts.append(("damage states", " ".join(f"{edp:g}" for edp in self.edp_thresholds)))
        if self.are_alternatives:
            facts[0] = ("designs", f"{len(self.walls)}, {fitted} of them with a curve")
            return [
                *facts,
                *((name, parameters(one)) for name, one in self.combined.items()),
                ("work", str(self.work)),
                *notes,
            ]
        if self.facade and self.knows_unions:
            facts[0] = ("facade", f"{self.facade}, {len(self.walls)} mechanisms, counted in the same histories")
            facts += self.unions[self.facade]._facts()
            if not self.population._has_single_alternatives(self.facade):
                facts.append(("taken as independent", parameters(self.combined[self.facade])))
            return [*facts, ("work", str(self.work)), *notes]
        whole = self["all"]
        facts += whole.fit._facts()
        if whole.fitted > 0.0:
            text = f"{shown_dispersion(whole.beta_walls):.3g} between walls, {whole.beta_records:.3g} between records"
            facts.append(("dispersion", text))
        return [*facts, ("work", str(self.work)), *notes]
