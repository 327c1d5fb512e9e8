"""How columns of results are shown in a report: the head of each and its digits, by its name.

Names are those of the tables of results, docs/files.md; columns that only a report has are named here. Numbers come
from the results' own tables.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping
from functools import partial
from typing import Any, NamedTuple

from dondolo._base.arguments import FloatArray
from dondolo._base.shown import shown_dispersion
from dondolo._base.wording import in_english, property_name
from dondolo.curves.fragility import Fragility
from dondolo.figures.style import mechanism_name
from dondolo.reporting.content import BETA, THETA, Column, Piece, Symbol, Table, level_head, level_unit, said
from dondolo.reporting.numerals import NONE, number, parameter, percent, probability, whole
from dondolo.reporting.statuses import short_status
from dondolo.reporting.units import UNITS, cell
from dondolo.reporting.words import in_words


class _Shown(NamedTuple):
    """Head of a column, which may depend on the intensity measure, how a cell is set, and whether it is words."""

    head: Piece | Callable[[str], Piece]
    cell: Callable[[Any], Piece]
    is_text: bool = False


def _in_unit(*before: Any) -> Callable[[str], Piece]:
    """A head with the unit of the levels."""
    return lambda im: (*before, f" [{level_unit(im)}]")


def source_name(name: str) -> str:
    """A property whose uncertainty is a source."""
    return name if in_english() else property_name(name)


def _status(name: str) -> str:
    """Status of a fit: its name in English, as in the tables of results."""
    return name if in_english() else short_status(name)


_two, _three, _significant = partial(number, figures=2), partial(number, figures=3), partial(number, figures=4)
_COLUMNS: dict[str, _Shown] = {
    # Who
    "wall": _Shown("wall", str, True),
    "curve": _Shown("curve", str, True),
    "design": _Shown("design", str, True),
    "whole": _Shown("facade or wall", str, True),
    "method": _Shown("method", str, True),
    "group": _Shown("group", str, True),
    "damage_state": _Shown("damage state", str, True),
    "mechanism": _Shown("mechanism", mechanism_name, True),
    "mechanisms": _Shown("mechanisms", whole),
    "walls": _Shown("walls", whole),
    "weight": _Shown("weight", number),
    "p_occ": _Shown(Symbol("p", "occ"), number),
    "occurrence": _Shown("occurrence", partial(in_words, "occurrence"), True),
    "alternative": _Shown("alternative", str, True),
    "upper_asymptote": _Shown("can occur", percent),
    # Lognormal curves
    "theta": _Shown(_in_unit(THETA), parameter),
    "beta": _Shown(BETA, parameter),
    "se_ln_theta": _Shown(("standard error of ln ", THETA), _three),
    "se_beta": _Shown(("standard error of ", BETA), _three),
    "log_likelihood": _Shown("log likelihood", parameter),
    "deviance": _Shown("deviance", _three),
    "deviance_dof": _Shown("its degrees of freedom", lambda value: NONE if value is None else whole(value)),
    "theta_low": _Shown((THETA, " from"), parameter),
    "theta_high": _Shown((THETA, " to"), parameter),
    "beta_low": _Shown((BETA, " from"), parameter),
    "beta_high": _Shown((BETA, " to"), parameter),
    "theta_lowest": _Shown(("lowest ", THETA), parameter),
    "theta_greatest": _Shown(("greatest ", THETA), parameter),
    "independent_theta": _Shown((THETA, ", independent"), parameter),
    "independent_beta": _Shown((BETA, ", independent"), parameter),
    "errors": _Shown("standard errors", str, True),
    "status": _Shown("status", _status, True),
    # Of populations
    "beta_walls": _Shown(Symbol("β", "walls"), lambda value: parameter(shown_dispersion(value))),
    "beta_records": _Shown(Symbol("β", "records"), parameter),
    "beta_total": _Shown(Symbol("β", "total"), parameter),
    "misfit": _Shown("misfit", _two),
    "fitted": _Shown("fitted", percent),
    # At the levels
    "im_level": _Shown(level_head, number),
    "histories": _Shown("histories", whole),
    "collapses": _Shown("collapses", whole),
    "reached": _Shown("reach it", number),
    "fraction": _Shown("fraction", probability),
    "probability": _Shown("fitted curve", probability),
    "band_low": _Shown("95 % band from", probability),
    "band_high": _Shown("to", probability),
    "median_edp": _Shown("median EDP", _three),
    "mean_fraction": _Shown("mean of fractions", probability),
    "mean_curve": _Shown("mean of curves", probability),
    "fractile_16": _Shown("16 % fractile", probability),
    "fractile_50": _Shown("50 % fractile", probability),
    "fractile_84": _Shown("84 % fractile", probability),
    "lognormal": _Shown("lognormal", probability),
    "mean_low": _Shown("from", probability),
    "mean_high": _Shown("to", probability),
    # Designs
    "ratio": _Shown("ratio of medians", _three),
    "ratio_low": _Shown("from", _three),
    "ratio_high": _Shown("to", _three),
    "p_value": _Shown("p of no difference", _two),
    "steel_kg_m": _Shown("steel [kg/m]", _three),
    "gain_per_kg": _Shown("gain per kg/m", percent),
    "alpha_0_g": _Shown((Symbol("α", "0"), " [g]"), number),  # noqa: RUF001
    "static_ratio": _Shown("its ratio", _three),
    # Their checks
    "alpha_0": _Shown(Symbol("α", "0"), number),  # noqa: RUF001
    "a_0_m_s2": _Shown((Symbol("a", "0", "*"), " [m/s²]"), number),
    "zeta_e_linear": _Shown((Symbol("ζ", "E"), ", linear SLV"), _three),
    "zeta_e": _Shown((Symbol("ζ", "E"), ", nonlinear"), _three),
    "return_period": _Shown((Symbol("T", "R,C"), " [years]"), tuple),
    "alpha_0_change": _Shown(("Δ", Symbol("α", "0")), number),  # noqa: RUF001
    "a_0_change_m_s2": _Shown(("Δ", Symbol("a", "0", "*"), " [m/s²]"), number),
    "zeta_e_linear_change": _Shown(("Δ", Symbol("ζ", "E"), ", linear SLV"), _three),
    "zeta_e_change": _Shown(("Δ", Symbol("ζ", "E"), ", nonlinear"), _three),
    "return_period_change": _Shown(("Δ", Symbol("T", "R,C"), " [years]"), _three),
    # Sources of uncertainty
    "source": _Shown("source", source_name, True),
    "distribution": _Shown("distribution", str, True),
    "value_5": _Shown("at 5 %", _significant),
    "value_50": _Shown("at 50 %", _significant),
    "value_95": _Shown("at 95 %", _significant),
    "theta_5": _Shown(_in_unit(THETA, " at 5 %"), parameter),
    "theta_95": _Shown(_in_unit(THETA, " at 95 %"), parameter),
    "first": _Shown("first-order", percent),
    "first_low": _Shown("first-order, from", _two),
    "first_high": _Shown("first-order, to", _two),
    "total": _Shown("total", percent),
    "total_low": _Shown("total, from", _two),
    "total_high": _Shown("total, to", _two),
    # Walls
    "height": _Shown("height [m]", number),
    "thickness": _Shown("thickness [m]", number),
    "density": _Shown("density [kg/m3]", number),
    "table_misfit": _Shown("misfit of its table", number),
    "hinge": _Shown("hinge / height", number),
    "overburden": _Shown("overburden [kN/m]", partial(cell, unit=UNITS["N/m"])),
    "overburden_inertia": _Shown("of it lifted", number),
    "eccentricity": _Shown("ecc. [m]", number),
    "trigger": _Shown((Symbol("a", "0"), " [g]"), number),
    "capacity_rad": _Shown("capacity [rad]", number),
    "p_rad_s": _Shown((Symbol("p"), " [rad/s]"), number),
    "restitution": _Shown("restitution e", number),
}


def shown(columns: Mapping[str, Any], im: str = "") -> Table:
    """Columns as a table.

    Parameters
    ----------
    columns : mapping
        Name -> values; the first one heads the rows.
    im : str
        Intensity measure of the levels.
    """
    made = []
    for place, (name, values) in enumerate(columns.items()):
        head, cell, is_text = _COLUMNS[name]
        title = head(im) if callable(head) else head
        made.append(Column(said(title), [cell(value) for value in values], is_text or not place))
    return Table(tuple(made))


def chosen(table: Mapping[str, Any], *names: str) -> dict[str, Any]:
    """Some columns of a table of results, in this order."""
    return {name: table[name] for name in names}


def parameters_of(curves: Iterable[Fragility], *names: str) -> dict[str, Any]:
    """Columns of parameters of curves, by the names of their attributes."""
    several = list(curves)
    return {name: [getattr(curve, name) for curve in several] for name in names}


def of_curve(curve: Fragility, levels: FloatArray) -> dict[str, Any]:
    """Columns of a fitted curve at the levels, with its band; none without a fit."""
    columns: dict[str, Any] = {"probability": curve(levels)} if curve.has_fit else {}
    if curve.has_errors:
        columns["band_low"], columns["band_high"] = curve.interval(levels)
    return columns
