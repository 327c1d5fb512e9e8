"""Buildings that walls stand on, as filters of accelerograms."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import KW_ONLY, dataclass
from typing import TYPE_CHECKING, Any

from numpy.typing import ArrayLike

from dondolo._base.shown import html_of
from dondolo._fortran.buildings import BUILDING_NAMES, BuildingData, building_values, describe_building
from dondolo._fortran.library import with_units
from dondolo._storage.saved import part_of_results

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from dondolo.records.codes import Site

# One value or several
Values = float | Sequence[float]


@part_of_results
@dataclass(frozen=True, repr=False)
class Building:
    """A linear building that a wall stands on and leans on.

    Parameters
    ----------
    period : float or sequence of float, optional
        Periods of the modes of the building that the wall stands on [s].
    damping : float or sequence of float, optional
        Their damping ratios, or one for all; 0.05 if not given.
    participation : float or sequence of float, optional
        Their participation factors times their shapes at the level of the wall, no percentages.
    storeys : int, optional
        Number n of storeys, instead of participation: 3 n / (2 n + 1) level / building_height.
    level : float, optional
        Height of the wall's floor above the ground, with storeys [m].
    building_height : float, optional
        Height of the building, with storeys [m].
    top_displacement : float, optional
        Displacement d of the top of the building under its weights applied sideways, instead of period: 2 sqrt(d) [m].
    level_top : float, optional
        Height above the ground up to which the building moves the wall, with storeys; that of the top of the wall or of
        the building if not given [m].
    participation_top : float or sequence of float, optional
        Participation factors times shapes at the top of the wall, with participation; the same if not given.
    diaphragm_period : float, optional
        Period of the flexible floor that holds the top of a two_block wall; rigid if not given [s].
    diaphragm_damping : float, optional
        Its damping ratio, 0.05 if not given.
    diaphragm_participation : float, optional
        Its participation factor times its shape where the wall is, 1.27 if not given.
    refine : int, optional
        Parts that a step of a record is divided into; 0: as many as the shortest period needs, 0 if not given.

    Raises
    ------
    InputError
        An invalid value, lists of different lengths, a level above the building.

    Notes
    -----
    The floor moves with u_g'' + sum participation d'', d'' + 2 damping omega d' + omega^2 d = -u_g'' for each mode;
    what the modes leave out of the building moves with the ground. A wall that leans on the building, or spans between
    two of its floors, feels both of its supports (`Wall.support_share`, `Record.under`); level_top equal to level lets
    it move with its base alone. The building stays linear: docs/buildings.md.

    Examples
    --------
    The roof of a house of three storeys:

    >>> import dondolo as dd
    >>> house = dd.Building(0.3, storeys=3, level=9.0, building_height=9.0)
    >>> house.participations
    (1.2857142857142858,)
    >>> parapet = dd.OneSidedWall(1.5, 0.25, building=house)
    """

    period: Values | None = None
    _: KW_ONLY
    damping: Values | None = None
    participation: Values | None = None
    storeys: int | None = None
    level: float | None = None
    building_height: float | None = None
    top_displacement: float | None = None
    level_top: float | None = None
    participation_top: Values | None = None
    diaphragm_period: float | None = None
    diaphragm_damping: float | None = None
    diaphragm_participation: float | None = None
    refine: int | None = None

    def __post_init__(self) -> None:
        values = building_values(vars(self))
        data = describe_building(values)
        filled: dict[str, Any] = {"period": data.period, "damping": data.damping, "_data": data}
        if values["diaphragm_period"] is not None:
            filled["diaphragm_damping"], filled["diaphragm_participation"] = data.diaphragm
        for name, value in (values | filled).items():
            object.__setattr__(self, name, value)

    def _values(self) -> dict[str, Any]:
        """Its properties by their names."""
        derived = {"period"} if self.top_displacement is not None else set()
        return {name: None if name in derived else getattr(self, name) for name in BUILDING_NAMES}

    @property
    def periods(self) -> tuple[float, ...]:
        """Period of each mode [s], as given or of top_displacement."""
        return self._understood.period

    @property
    def participations(self) -> tuple[float, ...]:
        """Participation factor times shape of each mode, as given or of storeys and level."""
        return self._understood.participation

    @property
    def free_vibration(self) -> float:
        """How long walls are followed after a record, until 1e-4 of each mode's amplitude is left [s].

        A facade that stands on the ground leans on a building that vibrates. The floor alone (`Record.on_floor`) is
        followed as long as the modes that move it; at the level 0 there are none.
        """
        return self._understood.free_vibration

    @property
    def _understood(self) -> BuildingData:
        data: BuildingData = self.__dict__["_data"]
        return data

    def plot(
        self,
        ax: Axes | None = None,
        *,
        records: Iterable[Any],
        periods: ArrayLike | None = None,
        damping: float = 0.05,
        site: Site | None = None,
        **options: Any,
    ) -> Axes:
        """Draw the response spectra of the floor against those of the ground.

        Parameters
        ----------
        ax : Axes, optional
            Where to draw; a new figure if left out.
        records : iterable of Record
            Motions of the ground; the records of a `RecordSet` are taken times their factors.
        periods : array_like, optional
            [s]; 100 from 0.05 to 4 s if left out.
        damping : float
            Damping ratio of what stands on the floor.
        site : Site, optional
            Whose spectrum of the floor by the code, of SLV, is drawn beside them; the records are drawn as they are.
        **options
            Parts to leave out by False (`legend`, `title`), and keywords of Matplotlib for the medians: see
            docs/printing.md.

        Returns
        -------
        Axes
            Medians over the records of both, and the spectra of each floor, against period; the periods of the modes
            are dotted.
        """
        from dondolo.records.level_rows import scaled_records
        from dondolo.records.plots import draw_floor

        return draw_floor(self, scaled_records(records), periods, damping, ax=ax, site=site, given=options)

    def _facts(self) -> list[tuple[str, str]]:
        """What a reader wants to know, name and text."""
        given = [(name, value) for name, value in self._values().items() if value is not None]
        given += [("periods", self.periods)] * (self.top_displacement is not None)
        given += [("participations", self.participations)] * (self.participation is None)
        return [(name, _in_words(value)) for name, value in given]

    def __repr__(self) -> str:
        return f"<Building: {', '.join(f'{what}={text}' for what, text in self._facts())}>"

    def _repr_html_(self) -> str:
        return html_of("Building", with_units("building", self._facts()))


def _in_words(value: Any) -> str:
    """A value, or several, as text."""
    return " ".join(f"{one:.6g}" for one in (value if isinstance(value, tuple) else (value,)))


def building_from(values: Mapping[str, Any]) -> Building | None:
    """The building among the properties of a wall; None: it stands on the ground."""
    own = {name: values[name] for name in BUILDING_NAMES if values.get(name) is not None}
    return Building(**own) if own else None
