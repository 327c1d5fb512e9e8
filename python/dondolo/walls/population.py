"""Populations: walls, their weights, and the table they are read from."""

from __future__ import annotations

import os
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, overload

import numpy as np
from numpy.typing import ArrayLike

from dondolo._base.arguments import FloatArray, argument_error, one_of
from dondolo._base.shown import Shown
from dondolo._fortran.tables import TableColumns, plain
from dondolo._fortran.walls import (
    INDEPENDENT,
    OCCURRENCE,
    WALL_LISTS,
    WALL_PROPERTIES,
    describe_walls,
    read_walls,
)
from dondolo._storage import tables
from dondolo._storage.saved import part_of_results
from dondolo.errors import InputError
from dondolo.walls.rows import UNNAMED
from dondolo.walls.table import population_columns
from dondolo.walls.wall import Wall, properties_of, walls_table
from dondolo.walls.wall_columns import WallColumns, statics_of
from dondolo.walls.wall_rows import WallRows

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from dondolo.walls.distributions import Distribution
    from dondolo.walls.mechanisms import Corner, OneSidedWall
    from dondolo.walls.sampling import Property

# Words of each row
_OF_ROWS = ("group_names", "facades", "occurrence", "alternatives")

#: What distinguishes walls in a figure
Kind = Literal["mechanism", "group"]


@part_of_results
@dataclass(frozen=True, eq=False, repr=False)
class Population(WallRows, Shown):
    """Walls with their weights: the number of similar walls that each represents.

    Walls with the same name, one after the other, are mechanisms of one wall; those of the same facade are mechanisms
    of the facade, which collapses if any of its walls does (`Population.of_facade` makes them). Walls that were given
    no name are called 'wall' with the number of their row, or the next that no other wall is called by.

    Attributes
    ----------
    walls : sequence of Wall
        The walls, each with one mechanism: the rows of the population. Several are kept as columns, and a wall is made
        when it is asked for.
    weights : ndarray, shape (rows,)
        Their weights, not negative and not all zero; 1 each if left out.
    group_names : tuple of str
        Name of the group that each belongs to, for curves by group; empty if left out.
    p_occ : ndarray, shape (rows,)
        Probability that the mechanism can occur, between 0 and 1; 1 each if left out.
    facades : tuple of str
        Name of the facade that each is part of; empty if left out, or if it is part of none.
    occurrence : tuple of str
        'independent', where each mechanism of the wall can occur whatever the others do, or 'exclusive', where one of
        several alternatives occurs, with the probability `p_occ`; one word is that of all walls, 'independent' if left
        out.
    alternatives : tuple of str
        Name of the alternative of the wall that each mechanism belongs to; those of one alternative occur together.
        Empty if left out: exclusive mechanisms are alternatives each.
    origin : tuple of str
        Origin of the walls, in lines for the header of a file.
    notes : mapping of str to tuple of str
        What is kept with the walls and decides nothing, such as an address: names that begin with ``x_`` or
        ``note``, and a text for each row.

    Raises
    ------
    InputError
        The walls and their weights, groups or probabilities are inconsistent.

    Examples
    --------
    >>> import dondolo as dd
    >>> population = dd.Population(
    ...     [
    ...         dd.OneSidedWall(3.0, 0.25, name="a"),
    ...         dd.TwoBlockWall(3.0, 0.25, name="a"),
    ...         dd.OneSidedWall(6.0, 0.5, name="b"),
    ...     ],
    ...     weights=[2.0, 2.0, 5.0],
    ...     group_names=["low", "low", "high"],
    ...     p_occ=[0.4, 0.6, 1.0],
    ... )
    >>> population
    <Population: walls 2, mechanisms 3, sum of the weights 7, groups 'low' (1), 'high' (1)>
    >>> population[2].name
    'b'
    >>> [wall.mechanism for wall in population.group("low")]
    ['one_sided', 'two_block']

    A wall that overturns or folds, never both:

    >>> walls = [dd.OneSidedWall(3.0, 0.25, name="a"), dd.TwoBlockWall(3.0, 0.25, name="a")]
    >>> dd.Population(walls, p_occ=[0.3, 0.7], occurrence="exclusive").occurrence
    ('exclusive', 'exclusive')
    """

    @classmethod
    def from_csv(
        cls, path: str | os.PathLike[str], *, gravity: float | None = None, occurrence: str = INDEPENDENT
    ) -> Population:
        r"""Read a table of walls.

        Parameters
        ----------
        path : path
            A CSV table: one row per mechanism of a wall, columns named as the parameters of the walls, and weight,
            group, p_occ, occurrence, alternative and facade; others begin with ``x_`` or ``note``, and are kept as
            `notes`. A row with hinge levels becomes a wall for each, all of one facade.
        gravity : float, optional
            [m/s2], 9.81 if left out.
        occurrence : {'independent', 'exclusive'}
            How the mechanisms of a wall occur where the table has no column of this name, or an empty cell.

        Returns
        -------
        Population

        Raises
        ------
        InputError
            The table or one of its walls is wrong.

        Examples
        --------
        >>> from pathlib import Path
        >>> import dondolo as dd
        >>> table = "name,mechanism,height,thickness\na,one_sided,1.5,0.25\nb,two_block,3.0,0.3\n"
        >>> _ = Path("walls.csv").write_text(table)
        >>> [wall.name for wall in dd.Population.from_csv("walls.csv")]
        ['a', 'b']
        """
        one_of("occurrence", occurrence, OCCURRENCE)
        walls, of_rows = read_walls(path, gravity, occurrence)
        origin = (f"read from {Path(path).name}",)
        return Population(WallColumns.of_data(walls), **of_rows, origin=origin)

    @classmethod
    def from_frame(cls, frame: Any, *, gravity: float | None = None, occurrence: str = INDEPENDENT) -> Population:
        """Make the walls of a data frame.

        Parameters
        ----------
        frame : pandas.DataFrame
            Columns and rows as in the table of `Population.from_csv`; NaN and None for what is not given. Names are
            strings: floats are refused, for pandas reads 1.10 as 1.1 without ``dtype={"name": str}``.
        gravity : float, optional
            [m/s2], 9.81 if left out.
        occurrence : {'independent', 'exclusive'}
            As in `Population.from_csv`.

        Returns
        -------
        Population

        Raises
        ------
        InputError
            The frame or one of its walls is wrong; its row is named as in ``frame.iloc[2]``.

        Notes
        -----
        What `Population.to_csv` writes and pandas reads makes the same walls again. `Population.to_frame` is another
        table, of results.

        Examples
        --------
        >>> import pandas as pd
        >>> import dondolo as dd
        >>> frame = pd.DataFrame({"mechanism": "one_sided", "height": [2.4, 3.0], "thickness": 0.3, "weight": [3, 5]})
        >>> dd.Population.from_frame(frame)
        <Population: walls 2, mechanisms 2, sum of the weights 8>
        """
        from dondolo.walls.frames import read_frame

        one_of("occurrence", occurrence, OCCURRENCE)
        walls, of_rows = read_frame(frame, gravity, occurrence)
        return cls(WallColumns.of_data(walls), **of_rows, origin=("read from a data frame",))

    @classmethod
    def sample(
        cls,
        mechanisms: str | Iterable[str] | Mapping[str, Mapping[str, Property]],
        n_walls: int,
        seed: int,
        *,
        variables: Mapping[str, Distribution] | None = None,
        correlation: Mapping[tuple[str, str], float] | None = None,
        group: str = "",
        name: str = "",
        gravity: float | None = None,
        occurrence: str = INDEPENDENT,
        **properties: Property,
    ) -> Population:
        """Make walls with sampled properties.

        A property is a number (or a text, for `restitution` and `bearing`), a distribution, or a function of what was
        sampled, which gets the samples by name, one array of `n_walls` numbers each, and returns such an array or a
        number. A distribution is anything with a method `ppf`, such as `Lognormal` or a frozen distribution of
        `scipy.stats`.

        Parameters
        ----------
        mechanisms : str, iterable of str, or mapping
            'one_sided', 'free_standing' or 'two_block', or several of them: each wall then has all of them. A mapping
            gives each mechanism properties of its own, besides or instead of the common ones: ``{"one_sided": {"p_occ":
            0.4}, "two_block": {"p_occ": 0.6, "hinge": Uniform(0.5, 0.7)}}``.
        n_walls : int
            Number of walls.
        seed : int
            Seed of the random numbers; the same seed gives the same walls.
        variables : mapping, optional
            Distributions of variables that are not properties of a wall, but that properties are functions of.
        correlation : mapping, optional
            Pairs of names of sampled properties and variables, and the correlation of each pair; a property of one
            mechanism is named as in "two_block.hinge". Pairs that are not named have none. Takes more walls than there
            are properties and variables that are sampled.
        group : str, optional
            Group of all walls.
        name : str, optional
            Walls are called so with their number: 'facades 0001'. The name of the group if left out.
        gravity : float, optional
            [m/s2], 9.81 if left out.
        occurrence : {'independent', 'exclusive'}
            How the mechanisms of a wall occur.
        **properties
            Those of the walls - height, thickness, density, restitution, restitution_value, restitution_factor, for
            'two_block' hinge, overburden, eccentricity or bearing and bearing_distance - and weight and p_occ.

        Returns
        -------
        Population
            Its rows go wall by wall, the mechanisms of a wall in their order; `origin` describes the sample.

        Raises
        ------
        InputError
            Inconsistent arguments; or a sampled value that no wall can have, with the names of the wall and the
            property. Nothing is left out or moved: truncate the distribution, or make the property a function of the
            others.

        Notes
        -----
        A correlation is that of the normal scores (the Gaussian copula): of the values of two normal distributions, of
        the logarithms of two lognormal ones. The rank correlation is 6/pi asin(rho/2). The correlation of the sample's
        scores is the one asked for, and zero where none is, but for what the order of n numbers cannot give: of eight
        properties the worst pair is off by some hundredths with 30 walls, by some thousandths with 300. That of the
        values scatters more, since each lies somewhere in its part of the range. Of four properties of which one pair
        was asked for 0.5, 200 seeds each, that pair was off by 0.02 (median; 0.08 at most) with 30 walls, 0.007 (0.04)
        with 100 and 0.002 (0.01) with 300, and the worst of the six pairs by 0.06 (0.19), 0.02 (0.05) and 0.014 (0.04).
        Against a `Choice` the correlation of the values is smaller than that of the scores, however many walls there
        are: 0.45 instead of 0.5 for three values. Where there are no more walls than properties and variables that are
        sampled, these are paired at random.

        References
        ----------
        McKay, Beckman and Conover (1979), Technometrics 21, 239-245; Iman and Conover (1982), Communications in
        Statistics: Simulation and Computation 11, 311-334.

        Examples
        --------
        >>> import dondolo as dd
        >>> from dondolo import distributions
        >>> facades = dd.Population.sample(
        ...     {
        ...         "one_sided": {"p_occ": 0.6},
        ...         "two_block": {"p_occ": 0.4, "hinge": distributions.Triangular(0.5, 0.6, 0.75)},
        ...     },
        ...     n_walls=100,
        ...     seed=1,
        ...     height=distributions.Lognormal(3.2, 0.15, low=2.4, high=4.5),
        ...     thickness=distributions.Choice((0.25, 0.38, 0.51), (0.2, 0.5, 0.3)),
        ...     correlation={("height", "thickness"): 0.5},
        ...     group="facades",
        ... )
        >>> facades
        <Population: walls 100, mechanisms 200, sum of the weights 100, groups 'facades' (100)>
        >>> facades[0].name
        'facades 0001'
        """
        from dondolo.walls.sampling import sample_population

        return sample_population(
            mechanisms,
            n_walls,
            seed,
            variables=variables,
            correlation=correlation,
            group=group,
            name=name,
            gravity=gravity,
            occurrence=occurrence,
            **properties,
        )

    @classmethod
    def of_facade(
        cls, wall: OneSidedWall | Corner, *, hinge_level: Sequence[float] | Literal["storeys"] = "storeys"
    ) -> Population:
        """Make the walls of a facade that can turn out about several hinges.

        Parameters
        ----------
        wall : OneSidedWall or Corner
            The whole facade, its hinge at the base.
        hinge_level : sequence of float or 'storeys'
            Heights of the hinges above the base [m]; 'storeys' for the bottom of each section.

        Returns
        -------
        Population
            One facade: for each hinge the wall 'NAME at Z m' of what is above it, with the sections, loads, thrusts and
            springs there, on the floor of the building at its level. The walls are in series.

        Raises
        ------
        InputError
            A hinge that the wall does not have, or a wall that is not stable at rest.

        Notes
        -----
        docs/theory.md, section 2. `Typology.unions` has the curve of the facade counted in the same histories,
        `Typology.combined` that of the product.

        Examples
        --------
        >>> import dondolo as dd
        >>> storeys = [dd.Section(4.0, 0.6), dd.Section(3.5, 0.45), dd.Section(3.0, 0.3)]
        >>> whole = dd.OneSidedWall(sections=storeys, name="front")
        >>> [wall.name for wall in dd.Population.of_facade(whole)]
        ['front at 0 m', 'front at 4 m', 'front at 7.5 m']
        """
        from dondolo.walls.facade import facade

        return facade(wall, hinge_level=hinge_level)

    def _stored(self) -> dict[str, Any]:
        """What a file has of it: the properties of its walls as columns."""
        columns = {row.name: properties_of(self.walls, row.name) for row in WALL_PROPERTIES}
        return {
            "properties": {
                name: column if None in column or name in WALL_LISTS else np.array(column)
                for name, column in columns.items()
            },
            "gravity": np.array(statics_of(self.walls, "gravity")),
            **{name: getattr(self, name) for name in ("weights", *_OF_ROWS, "p_occ", "origin")},
            **({"notes": dict(self.notes)} if self.notes else {}),
        }

    @classmethod
    def _restored(cls, properties: dict[str, Any], gravity: FloatArray, **more: Any) -> Population:
        return cls(WallColumns.of_data(describe_walls(len(gravity), properties, gravity)), **more)

    @overload
    def __getitem__(self, index: int) -> Wall: ...

    @overload
    def __getitem__(self, index: slice | ArrayLike) -> Population: ...

    def __getitem__(self, index: Any) -> Wall | Population:
        """The wall of a row, or a population of several rows.

        Parameters
        ----------
        index : int, slice or array_like
            Which rows: several as a slice, their numbers or a mask of all rows.

        Returns
        -------
        Wall or Population

        Raises
        ------
        IndexError
            There is no such row.
        InputError
            No rows are selected, or the index does not select rows.
        """
        if isinstance(index, (int, np.integer)):
            return self.walls[int(index)]
        try:
            rows = np.arange(len(self))[index if isinstance(index, slice) else np.asarray(index)]
        except (IndexError, TypeError, ValueError):
            raise InputError(
                f"population[{index!r}]: must be a number, a slice, or numbers or a mask of {len(self)} rows"
            ) from None
        return self._chosen(rows.ravel().tolist())

    def __add__(self, other: Population) -> Population:
        """Both populations together.

        Parameters
        ----------
        other : Population
            Its rows come last.

        Returns
        -------
        Population

        Raises
        ------
        InputError
            Both have a wall of one name.
        """
        if not isinstance(other, Population):
            return NotImplemented
        names = set(properties_of(self.walls, "name")) - {UNNAMED}
        for name, facade in zip(properties_of(other.walls, "name"), other.facades, strict=True):
            if name in names:
                raise argument_error("not_together", "name", f" = {name!r}: both populations have a wall of this name")
            if facade and facade in self.facades:
                raise argument_error(
                    "not_together", "facade", f" = {facade!r}: both populations have a facade of this name"
                )
        both = self.walls, other.walls
        columns = [one for one in both if isinstance(one, WallColumns)]
        nothing = [("",) * len(one) for one in (self, other)]
        return Population(
            WallColumns.join(columns) if len(columns) == 2 else (*self.walls, *other.walls),
            np.concatenate([self.weights, other.weights]),
            p_occ=np.concatenate([self.p_occ, other.p_occ]),
            **{name: getattr(self, name) + getattr(other, name) for name in _OF_ROWS},
            origin=self.origin + other.origin,
            notes={
                name: (*self.notes.get(name, nothing[0]), *other.notes.get(name, nothing[1]))
                for name in (*self.notes, *(name for name in other.notes if name not in self.notes))
            },
        )

    def group(self, name: str) -> Population:
        """The walls of a group.

        Parameters
        ----------
        name : str
            Name of the group; '' for the walls that belong to none.

        Returns
        -------
        Population

        Raises
        ------
        InputError
            No wall belongs to it.
        """
        one_of("group", name, self.group_names)
        return self._chosen([i for i, group in enumerate(self.group_names) if group == name])

    def _chosen(self, chosen: Sequence[int]) -> Population:
        """A population of some of the walls."""
        index = np.fromiter(chosen, dtype=np.intp)
        walls = self.walls.take(index) if isinstance(self.walls, WallColumns) else [self.walls[i] for i in chosen]
        return Population(
            walls,
            self.weights[index],
            p_occ=self.p_occ[index],
            **{name: tuple(getattr(self, name)[i] for i in chosen) for name in _OF_ROWS},
            origin=self.origin,
            notes={name: tuple(texts[i] for i in chosen) for name, texts in self.notes.items()},
        )

    def plot(self, ax: Iterable[Axes] | None = None, *, by: Kind = "mechanism", **options: Any) -> Axes:
        """Draw the walls: thickness against height above, trigger accelerations below.

        Parameters
        ----------
        ax : two Axes, optional
            Where to draw; a new figure if left out.
        by : {'mechanism', 'group'}
            Property that distinguishes the walls.
        **options
            Parts to leave out by False (`legend`, `title`), and keywords of Matplotlib for the marks: see
            docs/printing.md.

        Returns
        -------
        Axes
            The first of the figure's: thickness against height [m], with lines of equal slenderness; and the weight of
            what begins to rock in an interval of ground acceleration [g]. Each mechanism of a wall counts for itself.

        Raises
        ------
        InputError
            No such property.
        """
        from dondolo.walls.plots import draw_population

        return draw_population(self, ax, by, options)

    def to_frame(self) -> Any:
        """The walls, their static quantities and weights.

        Returns
        -------
        pandas.DataFrame
            The columns of the executable's ``*_walls.csv``, with units in their names: one row per mechanism of a wall.

        Raises
        ------
        DondoloError
            There is no pandas.
        """
        return tables.frame(plain(self._table()))

    def to_csv(self, path: str | os.PathLike[str], *, spreadsheet_safe: bool = False) -> None:
        """Write the table that `Population.from_csv` and the executable read.

        Parameters
        ----------
        path : path
            The file; its folder must exist.
        spreadsheet_safe : bool
            Put an apostrophe before names that a spreadsheet would read as formulas; `Population.from_csv` takes it
            away.

        Raises
        ------
        DondoloError
            It cannot be written.

        Notes
        -----
        What is read back is the same to the bit. Gravity is not a column: it is given again when the table is read.
        The lines of `origin` are the header.
        """
        lines = tables.csv_lines(population_columns(self), self.origin, tables.shortest, spreadsheet_safe)
        tables.write_lines(path, lines)

    def _table(self) -> TableColumns:
        words = zip(
            self.group_names, self.facades, self.occurrence, self.alternatives, *self.notes.values(), strict=True
        )
        return walls_table(self.walls, words, self.weights, self.p_occ, tuple(self.notes))
