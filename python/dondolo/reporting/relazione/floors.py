"""The steps from the modes of a building to the spectrum of its floor, C7.2.3, with the numbers of a check.

Steps are shown only if they give the numbers of the check.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np

from dondolo._fortran.checks import SheetRow
from dondolo.records.building import Building
from dondolo.records.codes import LimitState
from dondolo.reporting.blocks import Block, CaptionedTable, symbol_of
from dondolo.reporting.content import Piece, Symbol, Table
from dondolo.reporting.numerals import Numeral, number
from dondolo.reporting.relazione.document import Document, _
from dondolo.reporting.relazione.formulas import FIGURES
from dondolo.reporting.relazione.subjects import Subject
from dondolo.reporting.units import UNITS, cell
from dondolo.walls.mechanisms import TwoBlockWall

# How well the steps give the numbers of the check
_SAME = 1e-9
# Dampings of a building at 1.5 and at 2 times its period
_MIDDLE, _LONGEST = 0.10, 0.20
# Bounds of resonance, as parts of the period of a mode
_LOWER, _UPPER = 0.8, 1.1


class Mode(NamedTuple):
    """A mode of the building at the level of the wall.

    Attributes
    ----------
    period : float
        [s].
    damping : float
        Damping ratio.
    shape : float
        Participation factor times shape.
    ground : float
        Spectral acceleration of the ground [g].
    peak : float
        Peak acceleration that it gives the floor [g].
    """

    period: float
    damping: float
    shape: float
    ground: float
    peak: float

    def resonance(self, period: float, damping: float) -> float:
        """Amplification of its peak for a wall."""
        most = 1.1 * _eta(damping) / math.sqrt(self.damping)
        ratio = period / self.period
        if ratio < _LOWER:
            return float(most / (1.0 + (most - 1.0) * (1.0 - ratio / _LOWER) ** 1.6))
        if ratio < _UPPER:
            return most
        return float(most / (1.0 + (most - 1.0) * (ratio / _UPPER - 1.0) ** 1.2))


def _eta(damping: float) -> float:
    return max(math.sqrt(10.0 / (5.0 + 100.0 * damping)), 0.55)


def _shapes(one: Subject) -> tuple[float, ...]:
    """Participation times shape of each mode at the level of the wall, of a strip the mean of its floors."""
    building = one.wall.building
    assert building is not None
    if building.participation is None and building.storeys is not None and building.building_height is not None:
        level = one.check._row("mechanism", "", "level")
        return (_gamma(building.storeys) * (0.0 if level is None else level.value) / building.building_height,)
    base = building.participations
    top = building.participation_top
    if top is None or not isinstance(one.wall, TwoBlockWall):
        return base
    ends = (top,) if isinstance(top, float) else tuple(top)
    return tuple(0.5 * (low + high) for low, high in zip(base, ends, strict=True))


def _gamma(storeys: int) -> float:
    return 3.0 * storeys / (2.0 * storeys + 1.0)


def building_in(one: Subject, state: LimitState, method: str = "") -> Building | None:
    """The building that the demand of a nonlinear check has, by its method; '': as given, for the linear check."""
    own = one.wall.building
    if own is None or not one.is_on_floor:
        return None
    check = one.check
    periods = own.periods
    given = (own.damping,) if isinstance(own.damping, float) else tuple(own.damping or ())
    dampings = given if len(given) == len(periods) else given * len(periods)
    first = max(periods)
    row = check._row(method, state, "building_period") if method else check._row("mechanism", "SLD", "given_period")
    ratio = first / first if row is None else row.value / first
    stated = check._row("mechanism", state if method else "SLD", "given_damping")
    if stated is not None:
        dampings = (stated.value,) * len(periods)
    elif method and check._has("nonlinear", state, "building_zeta"):
        dampings = tuple(_softened(damping, ratio) for damping in dampings)
    return Building([ratio * period for period in periods], damping=dampings, participation=_shapes(one))


def _softened(damping: float, ratio: float) -> float:
    """Damping ratio of a mode whose period is longer."""
    if ratio > 1.5:
        return _MIDDLE + (_LONGEST - _MIDDLE) * (ratio - 1.5) / 0.5
    return damping + (_MIDDLE - damping) * (ratio - 1.0) / 0.5


def modes_in(one: Subject, state: LimitState, method: str = "") -> list[Mode]:
    """The modes of that building; none on the ground."""
    building = building_in(one, state, method)
    if building is None:
        return []
    modes = []
    sizes = (building.periods, np.atleast_1d(building.damping or 0.0), building.participations)
    for period, damping, shape in zip(*sizes, strict=True):
        ground = _ground(one, state, period, damping)
        peak = ground * abs(shape) * math.sqrt(1.0 + 0.0004 * (100.0 * damping) ** 2)
        modes.append(Mode(period, damping, shape, ground, peak))
    return modes


def _ground(one: Subject, state: LimitState, period: float, damping: float) -> float:
    """Spectral acceleration of the ground [g]."""
    spectrum = one.check.site.spectrum(periods=[period, 1.01 * period], damping=damping, limit_state=state)
    return float(spectrum.sa[0])


def peak_of(document: Document, one: Subject, row: SheetRow) -> list[Block]:
    """The steps to the peak acceleration of the floor a_Z, of the building as given."""
    state: LimitState = row.limit_state  # type: ignore[assignment]
    modes = modes_in(one, state)
    total = math.hypot(*(mode.peak for mode in modes))
    if not modes or not math.isclose(max(total, one.check.value("site", state, "pga")), row.value, rel_tol=_SAME):
        return []
    words = _(
        "Each mode of the building gives the level of the wall {peak} = {ground}({period}, {damping}) |{gamma} {shape}|"
        " √(1 + {factor} {damping}²), with {damping} in per cent; the squares are added (Circolare, C7.2.3). {origin}"
    )
    blocks: list[Block] = []
    if state == "SLD":
        blocks += _first_period(document, one)
        blocks.append(document.say(words, origin=_origin(document, one), **_symbols(document)))
    caption = document.text(_("Peak acceleration of the floor, {state}, with the building as given."), state=state)
    rows: list[tuple[Piece, list[Piece]]] = [*_head(modes), ((symbol_of("a_Z,k"), " [g]"), [*_shown(modes, "peak")])]
    return [*blocks, _table(document, rows, caption), _sum(document, "a_Z", total)]


def demand_of(document: Document, one: Subject, row: SheetRow) -> list[Block]:
    """The steps to the spectral acceleration of the floor S_eZ(T), of the building at the limit state."""
    state: LimitState = row.limit_state  # type: ignore[assignment]
    check = one.check
    modes = modes_in(one, state, row.method)
    if not modes:
        return []
    period, damping = (check.value(row.method, state, name) for name in ("period", "damping"))
    resonances = [mode.resonance(period, damping) for mode in modes]
    parts = [mode.peak * factor for mode, factor in zip(modes, resonances, strict=True)]
    ground = _ground(one, state, period, damping)
    if not math.isclose(max(math.hypot(*parts), ground), row.value, rel_tol=_SAME):
        return []
    blocks: list[Block] = []
    if (row.method, state) == ("nonlinear", "SLV"):
        words = _(
            "Of each mode {demand} = R {peak}, with the largest amplification A = {most} η/√{damping}, {damping} a"
            " fraction: R is A/[1 + (A - 1)(1 - {wall}/({lower} {period}))^{first}] for {wall} < {lower} {period}, A up"
            " to {upper} {period}, and A/[1 + (A - 1)({wall}/({upper} {period}) - 1)^{second}] beyond (C7.2.3)."
        )
        values = {"most": Numeral("1.1"), "lower": Numeral("0.8"), "upper": Numeral("1.1"), "first": Numeral("1.6")}
        blocks.append(document.say(words, second=Numeral("1.2"), **values, **_symbols(document)))
    most = [1.1 * _eta(damping) / math.sqrt(mode.damping) for mode in modes]
    rows: list[tuple[Piece, list[Piece]]] = [
        *_head(modes),
        ((symbol_of("a_Z,k"), " [g]"), [*_shown(modes, "peak")]),
        ("A", [cell(value, UNITS[""], FIGURES) for value in most]),
        ("R", [cell(value, UNITS[""], FIGURES) for value in resonances]),
        ((symbol_of("S_eZ,k"), " [g]"), [cell(value, UNITS[""], FIGURES) for value in parts]),
    ]
    caption = document.text(_("Spectral acceleration of the floor at the period of {state}."), state=state)
    return [*blocks, _table(document, rows, caption), _sum(document, "S_eZ", math.hypot(*parts))]


def _symbols(document: Document) -> dict[str, Any]:
    return {
        "peak": symbol_of("a_Z,k"), "ground": symbol_of("S_e"), "period": Symbol("T", "k"), "damping": Symbol("ξ", "k"),
        "gamma": symbol_of("gamma"), "shape": Symbol("ψ", "k"), "factor": Numeral("0.0004"),
        "demand": symbol_of("S_eZ,k"), "wall": symbol_of("T"),
    }  # fmt: skip


def _first_period(document: Document, one: Subject) -> list[Block]:
    """The period of the first mode that follows from the displacement of the top."""
    building = one.wall.building
    if building is None or building.top_displacement is None:
        return []
    words = _(
        "The period of the building is {period} = 2 √{displacement} = 2 √{value} = {result}, {displacement} [m] the"
        " displacement of its top under its weights applied sideways, given by the designer (NTC 7.3.3.2, [7.3.6])."
    )
    values = {"value": number(building.top_displacement, FIGURES), "result": number(building.periods[0], FIGURES, " s")}
    return [document.say(words, period=Symbol("T", "1"), displacement=symbol_of("d"), **values)]


def _origin(document: Document, one: Subject) -> tuple[Any, ...]:
    """Where participation factor and shape come from."""
    building, level = one.wall.building, one.check._row("mechanism", "", "level")
    assert building is not None
    if building.participation is not None or building.storeys is None or level is None:
        return (document.text(_("Participation factors times shapes are given by the designer.")),)
    height = building.building_height
    assert height is not None
    return (
        symbol_of("gamma"), f" = 3n/(2n + 1) = {3 * building.storeys}/{2 * building.storeys + 1} = ",
        number(_gamma(building.storeys), FIGURES), " [C7.2.10], ", Symbol("ψ", "1"), " = z/H = ",
        number(level.value, FIGURES), "/", number(height, FIGURES), " = ", number(level.value / height, FIGURES), ".",
    )  # fmt: skip


def _shown(modes: list[Mode], field: str) -> list[Piece]:
    return [cell(getattr(mode, field), UNITS[""], FIGURES) for mode in modes]


def _head(modes: list[Mode]) -> list[tuple[Piece, list[Piece]]]:
    """What the tables of both have first."""
    return [
        ((Symbol("T", "k"), " [s]"), _shown(modes, "period")),
        (Symbol("ξ", "k"), _shown(modes, "damping")),
        ((symbol_of("gamma"), " ", Symbol("ψ", "k")), _shown(modes, "shape")),
        ((symbol_of("S_e"), "(", Symbol("T", "k"), ", ", Symbol("ξ", "k"), ") [g]"), _shown(modes, "ground")),
    ]


def _table(document: Document, rows: list[tuple[Piece, list[Piece]]], caption: str) -> CaptionedTable:
    columns: dict[Piece, Any] = {document.text(_("quantity")): [head for head, _values in rows]}
    for place in range(len(rows[0][1])):
        columns[document.text(_("mode {k}"), k=place + 1)] = [values[place] for _head_of, values in rows]
    return CaptionedTable(Table.of(columns), caption)


def _sum(document: Document, symbol: str, value: float) -> Block:
    """The sum of squares, without the bound of the ground."""
    return document.say(
        _("The root of the sum of the squares is {value} g; {symbol} is not less than the ground has."),
        value=number(value, FIGURES), symbol=symbol_of(symbol),
    )  # fmt: skip
