"""Chapter 3 of a calculation report where coordinates give the hazard: nodes of the grid round the site, and rules."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np

from dondolo._base.arguments import argument_error
from dondolo._fortran.checks import HazardMesh, SiteHazard
from dondolo.records.codes import Site
from dondolo.reporting.blocks import Block, CaptionedTable, symbol_of
from dondolo.reporting.content import Piece, Table
from dondolo.reporting.numerals import Numeral, number
from dondolo.reporting.relazione.document import Document, _

# a_g, F_0 and T_C*: symbol and unit
_PARAMETERS = (("a_g", " [g]"), ("F_0", ""), ("T_C*", " [s]"))


def coordinates(document: Document, site: Site, mesh: HazardMesh) -> list[tuple[Piece, Any]]:
    """The place, its nominal life and class of use, which the case has: the project may only repeat them."""
    own = {
        "latitude": site.latitude,
        "longitude": site.longitude,
        "nominal_life": site.nominal_life,
        "use_coefficient": mesh.use_coefficient,
    }
    for name, value in own.items():
        stated = document.project.numbers.get(name, value)
        if stated != value:
            raise argument_error(
                "not_together", name, f" = {stated:g}: must be {value:.9g}, that of the check, or be left out"
            )
    years = " " + document.text(_("years"))
    return [
        (document.text(_("Latitude, longitude (WGS84)")), (_degrees(site.latitude), "; ", _degrees(site.longitude))),
        (document.text(_("Latitude, longitude (ED50)")), (_degrees(mesh.latitude), "; ", _degrees(mesh.longitude))),
        ((document.text(_("Nominal life")), " ", symbol_of("V_N")), number(site.nominal_life, 8, years)),
        (
            (document.text(_("Class of use, coefficient of use")), " ", symbol_of("C_U")),
            (site.use_class, "; ", number(mesh.use_coefficient), " (NTC, 2.4.II)"),
        ),
    ]


def _degrees(value: float | None) -> Numeral:
    return number(value, 9, "°")


def grid(document: Document, hazard: SiteHazard, mesh: HazardMesh) -> list[Block]:
    """How the hazard follows from the grid, to make it again by hand."""
    names = {
        "p": symbol_of("p"), "p1": symbol_of("p_1"), "p2": symbol_of("p_2"), "pi": symbol_of("p_i"),
        "d": symbol_of("d"), "di": symbol_of("d_i"),
        "T": symbol_of("T_R"), "T1": symbol_of("T_R,1"), "T2": symbol_of("T_R,2"),
        "V": symbol_of("V_R"),
        "P": symbol_of("P_VR"),
    }  # fmt: skip
    words = [
        _(
            "The hazard is that of the grid that NTC 3.2 refers to (D.M. 14 January 2008, annex B, table 1), with the"
            " three decimals of the decree. The grid is in ED50: geocentric coordinates of WGS84 at height 0 are moved"
            " by 87, 98 and 121 m to the ellipsoid International 1924."
        ),
        _(
            "For each return period of the grid a parameter {p} of the site is that of the four nodes of its mesh,"
            " weighted by the inverse of their distances {d}: {p} = Σ({pi}/{di})/Σ(1/{di})."
        ),
        _(
            "Between two return periods 1 and 2 of the grid ln {p} = ln {p1} + ln({p2}/{p1})"
            " ln({T}/{T1})/ln({T2}/{T1}) (annex A), with {T} = -{V}/ln(1 - {P}), held between 30 and 2475 years."
        ),
    ]
    return [
        *(document.say(sentence, **names) for sentence in words),
        CaptionedTable(
            Table.of(_nodes(document, mesh)), document.text(_("Nodes of the mesh that holds the site (ED50)."))
        ),
        CaptionedTable(
            Table.of(_values(document, hazard, mesh)),
            document.text(_("Parameters of the nodes and of the site for the return periods of the grid.")),
        ),
    ]


def _nodes(document: Document, mesh: HazardMesh) -> dict[Piece, Sequence[Piece]]:
    """The nodes with their places."""
    return {
        document.text(_("node")): [str(one) for one in mesh.ids],
        document.text(_("latitude [°]")): [number(one, 9) for one in mesh.latitudes],
        document.text(_("longitude [°]")): [number(one, 9) for one in mesh.longitudes],
        (symbol_of("d"), " [km]"): [number(one, 8) for one in mesh.distances],
    }


def _values(document: Document, hazard: SiteHazard, mesh: HazardMesh) -> dict[Piece, Sequence[Piece]]:
    """What the nodes have for the return periods of the grid that those of the limit states lie between."""
    first = [max(0, int(np.searchsorted(mesh.grid_years, years)) - 1) for years in hazard.return_periods]
    used = sorted({place for one in first for place in (one, one + 1)})
    rows = [(of, place) for of in range(len(_PARAMETERS)) for place in used]
    columns: dict[Piece, Sequence[Piece]] = {
        document.text(_("parameter")): [(symbol_of(_PARAMETERS[of][0]), _PARAMETERS[of][1]) for of, _place in rows],
        (symbol_of("T_R"), " [", document.text(_("years")), "]"): [
            number(mesh.grid_years[place]) for _of, place in rows
        ],
    }
    for node, values in zip(mesh.ids, mesh.values, strict=True):
        columns[document.text(_("node {number}"), number=str(node))] = [number(values[place, of]) for of, place in rows]
    columns[document.text(_("site"))] = [number(mesh.tabulated[place, of], 8) for of, place in rows]
    return columns
