"""Elastic spectra of building codes.

NTC 2018 (D.M. 17/01/2018, 3.2.3.2.1) and Eurocode 8 (EN 1998-1:2004, 3.2.2.2) have elastic spectra of one form, which
Fortran has (``check/code_spectrum.f90``), for rigid ground of acceleration a_g, with S the factor of soil and
topography, eta = sqrt(10/(5 + 100 xi)) >= 0.55 that of damping, and F0 the largest amplification (2.5 in EC8)::

    T < T_B:           S_e = a_g S [1 + T/T_B (eta F0 - 1)]
    T_B <= T < T_C:    S_e = a_g S eta F0
    T_C <= T < T_D:    S_e = a_g S eta F0 T_C/T
    T_D <= T:          S_e = a_g S eta F0 T_C T_D/T^2
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import KW_ONLY, dataclass
from typing import Any, Literal, get_args

import numpy as np
from numpy.typing import ArrayLike

from dondolo._base.arguments import argument_error, as_array, as_number, increasing, one_of
from dondolo._base.shown import Shown
from dondolo._fortran.checks import (
    NO_MODES,
    STATES,
    CodeParameters,
    Modes,
    SiteHazard,
    SiteInput,
    code_spectrum,
    ntc_parameters,
    site_hazard,
    site_input,
)
from dondolo._storage.saved import part_of_results
from dondolo.records.building import Building
from dondolo.records.target import TargetSpectrum

#: Classes of soil
Soil = Literal["A", "B", "C", "D", "E"]
#: Classes of topography of NTC 2018
Topography = Literal["T1", "T2", "T3", "T4"]
#: Classes of use of NTC 2018
UseClass = Literal["I", "II", "III", "IV"]
#: Limit states of NTC 2018: damage, life safety, collapse
LimitState = Literal["SLD", "SLV", "SLC"]

# Periods of a spectrum unless given [s]
_PERIODS = np.geomspace(0.05, 4.0, 60)

# Period, damping ratio and participation of each mode of a building: those of the ground
# EN 1998-1, tables 3.2 and 3.3: S, T_B, T_C, T_D
_EC8_SOILS = {
    1: {
        "A": (1.0, 0.15, 0.4, 2.0),
        "B": (1.2, 0.15, 0.5, 2.0),
        "C": (1.15, 0.20, 0.6, 2.0),
        "D": (1.35, 0.20, 0.8, 2.0),
        "E": (1.4, 0.15, 0.5, 2.0),
    },
    2: {
        "A": (1.0, 0.05, 0.25, 1.2),
        "B": (1.35, 0.05, 0.25, 1.2),
        "C": (1.5, 0.10, 0.25, 1.2),
        "D": (1.8, 0.10, 0.30, 1.2),
        "E": (1.6, 0.05, 0.25, 1.2),
    },
}


# What a check needs besides a site, and what it takes where that is not given
CHECK_OPTIONS: dict[str, Any] = {
    "knowledge_factor": 1.35, "behaviour": 2.0, "ultimate_state": "SLV", "friction": None,
    "building_period": None, "building_damping": None,
}  # fmt: skip


@part_of_results
@dataclass(frozen=True, repr=False)
class Site(Shown):
    """Hazard and ground of a site by NTC 2018: `ag`, `f0` and `tc_star`, or coordinates in Italy.

    Parameters
    ----------
    ag : float or sequence of three floats, optional
        Peak acceleration on rigid, level ground [g]: one for all limit states, or those of SLD, SLV and SLC.
    f0 : float or sequence of three floats, optional
        Largest amplification on such ground, 2.2 to 5.
    tc_star : float or sequence of three floats, optional
        Period at which the constant velocity begins on such ground [s].
    soil : {'A', 'B', 'C', 'D', 'E'}
        Class of soil.
    topography : {'T1', 'T2', 'T3', 'T4'}
        The factor of the table, which is that of the top of a slope.
    reference_life : float, optional
        Reference period V_R [years], for return periods.
    exceedance : sequence of three floats, optional
        Probabilities of exceedance in that period of SLD, SLV and SLC, with reference_life.
    latitude, longitude : float, optional
        Of the site, in WGS84 [deg], with nominal_life and in place of ag, f0, tc_star, reference_life and exceedance.
    nominal_life : float, optional
        Nominal life V_N [years].
    use_class : {'I', 'II', 'III', 'IV'}
        Class of use, with its coefficient C_U.

    Raises
    ------
    InputError
        Parameters that the code does not have; both values and coordinates; a place outside the grid of hazard.

    Examples
    --------
    >>> import dondolo as dd
    >>> site = dd.Site(ag=0.2, f0=2.5, tc_star=0.35, soil="B")
    >>> round(site.pga(), 12)
    0.24
    >>> [f"{ag:.3f}" for ag in dd.Site(latitude=42.3498, longitude=13.3999, nominal_life=50).hazard.ag]
    ['0.104', '0.261', '0.334']
    """

    ag: float | Sequence[float] | None = None
    f0: float | Sequence[float] | None = None
    tc_star: float | Sequence[float] | None = None
    _: KW_ONLY
    soil: Soil = "A"
    topography: Topography = "T1"
    reference_life: float | None = None
    exceedance: Sequence[float] | None = None
    latitude: float | None = None
    longitude: float | None = None
    nominal_life: float | None = None
    use_class: UseClass = "II"

    def __post_init__(self) -> None:
        for name in ("ag", "f0", "tc_star", "reference_life", "exceedance", "latitude", "longitude", "nominal_life"):
            value = getattr(self, name)
            if value is None:
                continue
            is_list = np.ndim(value) or name == "exceedance"
            given = tuple(as_array(name, value).tolist()) if is_list else as_number(name, value)
            object.__setattr__(self, name, given)
        self._parameters("SLV")

    @property
    def hazard(self) -> SiteHazard:
        """Hazard of the limit states, given or from the coordinates.

        `ag` [g], `f0` and `tc_star` [s] are tuples of SLD, SLV and SLC, or of one value for all; `reference_life` V_R,
        `exceedance` P_VR and `return_periods` [years] are 0 and () if unknown. `mesh` is None without coordinates; else
        it has the place in ED50 (`latitude`, `longitude`), and the `ids`, `latitudes`, `longitudes` and `distances`
        [km] of the four nodes of the grid, with their `values`, shape (nodes, `grid_years`, parameters), and those of
        the site, `tabulated`.
        """
        return site_hazard(self._input())

    def _values(self, **options: Any) -> dict[str, Any]:
        """Values of ``&check``: the site, and `CHECK_OPTIONS`; None for what is not given."""
        words = {name: CHECK_OPTIONS[name] if value is None else value for name, value in options.items()}
        numbers = {
            name: tuple(as_array(name, value).tolist()) if np.ndim(value) else as_number(name, value)
            for name, value in words.items()
            if name != "ultimate_state" and value is not None
        }
        return {**vars(self), **CHECK_OPTIONS, **words, **numbers}

    def _input(self, **options: Any) -> SiteInput:
        """The same as Fortran takes it."""
        return site_input(self._values(**options))

    def pga(self, *, limit_state: LimitState = "SLV") -> float:
        """Peak acceleration at the site a_g S [g] in a limit state."""
        return self._parameters(limit_state).pga

    def spectrum(
        self,
        *,
        periods: ArrayLike | None = None,
        damping: float = 0.05,
        limit_state: LimitState = "SLV",
        building: Building | None = None,
    ) -> TargetSpectrum:
        """Elastic horizontal spectrum, of the ground or of a floor.

        Parameters
        ----------
        periods : array_like, optional
            [s]; 60 from 0.05 to 4 s if left out.
        damping : float
            Damping ratio.
        limit_state : {'SLD', 'SLV', 'SLC'}
            Whose hazard, where each has its own.
        building : Building, optional
            At whose floor; the ground if left out.

        Returns
        -------
        TargetSpectrum
            Without a dispersion.

        Raises
        ------
        InputError
            Periods that do not increase, a damping ratio beyond 0 and 1, a building with a mode without damping.

        Notes
        -----
        NTC 2018, 3.2.3.2.1: S_S and C_C of table 3.2.IV, S_T of table 3.2.V, T_C = C_C T_C*, T_B = T_C/3,
        T_D = 4 a_g/g + 1.6 s. Floors: Circolare 7/2019, C7.2.3 (docs/code_checks.md).
        """
        modes = NO_MODES
        if building is not None:
            own = building._understood
            modes = Modes(*map(np.atleast_1d, (building.periods, own.damping, own.participation)))
            if not modes.damping.all():
                raise argument_error(
                    "out_of_range", "damping", " = 0: must be positive for the spectrum of a floor of the code"
                )
        return _spectrum(self._parameters(limit_state), damping, periods, modes)

    def _parameters(self, limit_state: str) -> CodeParameters:
        one_of("limit_state", limit_state, STATES)
        return ntc_parameters(self._input(), limit_state)

    def _facts(self) -> list[tuple[str, str]]:
        hazard = self.hazard

        def words(values: Any) -> str:
            # The grid has three decimals
            return ", ".join(f"{value:.3f}" if hazard.mesh else f"{value:g}" for value in values)

        ground = f"soil {self.soil}, topography {self.topography}"
        return [
            *([("place", f"{self.latitude:.9g}, {self.longitude:.9g}")] if hazard.mesh else []),
            ("ag", f"{words(hazard.ag)} g"),
            ("f0", words(hazard.f0)),
            ("tc_star", f"{words(hazard.tc_star)} s"),
            ("ground", ground),
            *([("V_R", f"{hazard.reference_life:g} years")] if hazard.reference_life else []),
        ]


def ec8_spectrum(
    ag: float,
    *,
    soil: Soil = "A",
    kind: Literal[1, 2] = 1,
    damping: float = 0.05,
    periods: ArrayLike | None = None,
) -> TargetSpectrum:
    """The spectrum of Eurocode 8: see `TargetSpectrum.ec8`."""
    a = as_number("ag", ag)
    if not 0.0 < a < np.inf:
        raise argument_error("out_of_range", "ag", f" = {a:g}: must be positive")
    one_of("soil", soil, get_args(Soil))
    if kind not in tuple(_EC8_SOILS):
        raise argument_error("out_of_range", "kind", f" = {kind!r}: must be 1 or 2")
    amplified, *corners = _EC8_SOILS[kind][soil]
    return _spectrum(CodeParameters(a * amplified, 2.5, np.array(corners)), damping, periods)


def _spectrum(
    parameters: CodeParameters, damping: float, periods: ArrayLike | None, modes: Modes = NO_MODES
) -> TargetSpectrum:
    """Spectrum of the form that both codes have, or of a floor above it."""
    ratio = as_number("damping", damping)
    if not 0.0 < ratio < 1.0:
        raise argument_error("out_of_range", "damping", f" = {ratio:g}: must lie between 0 and 1")
    t = increasing("periods", _PERIODS if periods is None else periods)
    return TargetSpectrum(t, code_spectrum(parameters, ratio, modes, t), damping=ratio)
