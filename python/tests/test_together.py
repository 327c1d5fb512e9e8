"""Every pair of groups of properties: either it is refused in one line, or the wall is that of a hand calculation."""

import itertools
import math
import re

import numpy as np
import pytest

import dondolo as dd
from dondolo._fortran.library import properties
from dondolo.errors import InputError, silent

SITE = dd.Site(0.2, 2.5, 0.35)
DENSITY, GRAVITY = 1800.0, 9.81
BARE = {"height": 6.0, "thickness": 0.6}
PLATE = {"bar": 0.02, "spacing": 2.0, "plate_width": 0.3, "plate_height": 0.3, "plate_thickness": 0.03}

GROUPS = {
    "sections": {"sections": [dd.Section(3.5, 0.6, fill=0.9), dd.Section(2.5, 0.6, fill=0.7)]},
    "thinner": {"sections": [dd.Section(3.5, 0.6), dd.Section(2.5, 0.4)]},
    "set_back": {"sections": [dd.Section(3.5, 0.6, offset=0.0), dd.Section(2.5, 0.6, offset=0.05)]},
    "leaves": {"leaves": 3},
    "hinge_level": {"hinge_level": 2.0},
    "mass": {"mass": 5500.0, "centroid_depth": 0.31, "centroid_height": 2.7, "hinge_inertia": 9.0e4},
    "hinge_depth": {"hinge_depth": 0.025},
    "strength": {"compressive_strength": 2.0e6, "stress_block": 0.8},
    "edge": {"edge_radius": 0.03},
    "loads": {"loads": [dd.Load(9e3, depth=0.25, height=5.5, inertia="both")]},
    "seats": {"loads": [dd.Load(4e3, depth=0.3, height=4.0, lifted=0.5, pushed=0.2, seat=0.15)]},
    "masses": {"inertial_masses": [dd.InertialMass(400.0, depth=0.3, height=4.5)]},
    "thrusts": {"thrusts": [dd.Thrust(700.0, height=5.0, decay=0.5)]},
    "springs": {"springs": [dd.Spring(4.0e3, depth=0.1, height=5.0)]},
    "distributed_springs": {"distributed_springs": [dd.DistributedSpring(3.0e3, depth=0.1, bottom=3.0, top=5.0)]},
    "ties": {"ties": [dd.Tie(height=4.8, area=4.0e-5, length=7.0)]},
    "anchors": {"ties": [dd.Tie(height=4.5, area=6.0e-5, length=7.0, anchor_force=5.0e3)]},
    "plates": {
        "ties": [dd.Tie(height=4.4, length=7.0, **PLATE)],
        **{"masonry_compression": 2.0e6, "masonry_shear": 4.0e4, "masonry_tension": 5.0e4},
    },
    "interlock": {"interlock": dd.Interlock(overlap=0.15, course=0.1, thickness=0.3, spacing=5.0)},
    "wedges": {
        "facade_length": 5.0,
        "wedges": [
            dd.Wedge(thickness=0.4, angle=18.0, bottom=0.0, top=5.5, length=1.1),
            dd.Wedge(thickness=0.4, angle=25.0, bottom=2.5, top=5.5, length=1.1),
        ],
    },
    "building": {"building": dd.Building(0.3, storeys=3, level=0.0, building_height=9.0)},
    "modes": {"building": dd.Building([0.4, 0.15], participation=[0.9, -0.3])},
    "restitution": {"restitution_value": 0.4},
    "scatter": {"restitution_sd": 0.02},
}

# On one leaf of several; what says the same thing; what does not say how much is where
REFUSED = {
    *(
        frozenset({"leaves", name})
        for name in (
            *(
                "loads",
                "seats",
                "masses",
                "thrusts",
                "springs",
                "distributed_springs",
                "ties",
                "anchors",
                "plates",
                "interlock",
            ),
            *("mass", "thinner", "wedges"),
        )
    ),
    *(frozenset({"wedges", name}) for name in ("mass", "interlock")),
    *(frozenset({"mass", name}) for name in ("sections", "thinner", "set_back", "hinge_level")),
    *(frozenset(pair) for pair in itertools.combinations(("hinge_depth", "strength", "edge"), 2)),
    # The level of modes that are given is that of the base
    frozenset({"hinge_level", "modes"}),
}


def together(*names):
    """Keywords of several groups; None where two cannot stand in one wall because they have one name."""
    found = {}
    for name in names:
        if found.keys() & GROUPS[name].keys():
            return None
        found |= GROUPS[name]
    return found if "sections" in found else BARE | found


def by_hand(given, anchor_forces):
    """alpha_0 of all leaves together: moments of weights, ties, friction and thrusts about the hinges."""
    level, leaves = given.get("hinge_level", 0.0), given.get("leaves", 1)
    storeys = [(one.height, one.thickness, one.fill or 1.0, one.offset or 0.0) for one in given.get("sections", ())]
    storeys = storeys or [(given["height"], given["thickness"], 1.0, 0.0)]
    parts, bottom, face = [], 0.0, None
    for height, thickness, fill, offset in storeys:
        top = bottom + height
        if top > level:
            face = offset if face is None else face
            low = max(bottom, level)
            weight = DENSITY * GRAVITY * (top - low) * thickness * fill / leaves
            parts.append((weight, offset - face + 0.5 * thickness / leaves, 0.5 * (low + top) - level))
        bottom = top
    for wedge in given.get("wedges", ()):
        parts += slices(wedge, storeys, level, face, given["facade_length"])
    if "mass" in given:
        parts = [(GRAVITY * given["mass"], given["centroid_depth"], given["centroid_height"])]
    loads = [(one.force, one.depth - face, one.height - level) for one in given.get("loads", ()) if one.height > level]
    weight = sum(part[0] for part in (*parts, *loads))
    hinge = given.get("hinge_depth", given.get("edge_radius", 0.0))
    if "compressive_strength" in given:
        hinge = weight / (2.0 * 0.8 * 2.0e6)
    held = sum(w * (d - hinge) for w, d, _ in parts) * leaves + sum(w * (d - hinge) for w, d, _ in loads)
    moved = sum(w * z for w, _, z in parts) * leaves + sum(w * z for w, _, z in loads)
    moved += sum(GRAVITY * one.mass * (one.height - level) for one in given.get("inertial_masses", ()))
    held -= sum(one.force * (one.height - level) for one in given.get("thrusts", ()))
    held += sum(force * (one.height - level) for one, force in zip(given.get("ties", ()), anchor_forces, strict=True))
    if "interlock" in given:
        tall = bottom - level
        density = given["mass"] / (6.0 * 0.6) if "mass" in given else DENSITY
        n = math.floor(tall / 0.1 + 1e-9)
        held += 0.4 * n * (n + 1) * 0.1 * 0.15 * 0.577 * 0.3 * density * GRAVITY / 5.0 * tall / 3.0
    return held / moved


def slices(wedge, storeys, level, face, length, count=4):
    """Weights and places of a wedge, by Gauss's rule between storeys and where it is cut off: exact for its sums."""
    foot = max(wedge.bottom, level)
    slope = math.tan(math.radians(wedge.angle))
    edges = [foot, wedge.top, foot + wedge.length / slope, *np.cumsum([height for height, *_ in storeys])]
    edges = sorted({min(max(edge, foot), wedge.top) for edge in edges})
    nodes, weights = np.polynomial.legendre.leggauss(count)
    for low, high in itertools.pairwise(edges):
        for node, weight in zip(nodes, weights, strict=True):
            z = 0.5 * (low + high) + 0.5 * (high - low) * node
            reach = min((z - foot) * slope, wedge.length)
            bottoms = np.cumsum([0.0, *(height for height, *_ in storeys)])
            _, thickness, _, offset = storeys[np.searchsorted(bottoms, z) - 1]
            force = DENSITY * GRAVITY * wedge.thickness / length * reach * 0.5 * (high - low) * weight
            yield force, offset - face + thickness + 0.5 * reach, z - level


def tie_forces(given, check):
    """Largest force of each tie per metre: of bars and given anchors by hand, of plates by the sheet."""
    of_plates = {row.item: row.value for row in check.rows if row.quantity == "tie_force_per_m"}
    return [
        min(1.8e8 * one.area, one.anchor_force or math.inf) if one.area else of_plates[f"tie {number}"]
        for number, one in enumerate(given.get("ties", ()), 1)
    ]


@pytest.mark.parametrize(
    "names", [*((name,) for name in GROUPS), *itertools.combinations(GROUPS, 2)], ids=lambda names: "-".join(names)
)
def test_pair(names):
    given = together(*names)
    if given is None:
        pytest.skip("one name")
    if frozenset(names) in REFUSED:
        with pytest.raises(InputError) as refused:
            dd.OneSidedWall(**given)
        assert [one.code for one in refused.value.errors] == ["not_together"], refused.value
        assert "\n" not in str(refused.value)
        return
    check = dd.check_ntc(dd.OneSidedWall(**given), SITE)
    expected = by_hand(given, tie_forces(given, check))
    assert check.value("mechanism", "", "alpha_0") == pytest.approx(expected, rel=1e-11), names


STRIP = {
    "hinge": {"hinge": 0.65},
    "overburden": {"overburden": 12e3, "overburden_inertia": 0.5},
    "hinge_depth": {"hinge_depth": 0.015},
    "strength": {"compressive_strength": 2.0e6},
    "building": {"building": dd.Building(0.3, storeys=3, level=3.0, building_height=9.0)},
    "diaphragm": {"building": dd.Building(0.3, participation=1.1, diaphragm_period=0.4)},
    "restitution": {"restitution_value": 0.7},
    "scatter": {"restitution_sd": 0.02},
}
PLACES = {
    "eccentricity": {"eccentricity": -0.04},
    "bearing": {"bearing": "inner", "bearing_distance": 0.07},
}


@pytest.mark.parametrize("place", [*PLACES, "centre"])
@pytest.mark.parametrize("names", [*itertools.combinations(STRIP, 2)], ids="-".join)
def test_pair_of_a_strip(names, place):
    given = {"height": 3.0, "thickness": 0.25, **STRIP["overburden"], **PLACES.get(place, {})}
    if {"building", "diaphragm"} <= set(names):
        pytest.skip("one name")
    for name in names:
        given |= STRIP[name]
    if {"hinge_depth", "strength"} <= set(names):
        with pytest.raises(
            InputError, match=r"^hinge_depth = 0\.015: give either hinge_depth or compressive_strength$"
        ):
            dd.TwoBlockWall(**given)
        return
    weight, load = DENSITY * GRAVITY * 3.0 * 0.25, given["overburden"]
    depth = (weight + load) / (2.0 * 0.85 * 2.0e6) if "strength" in names else given.get("hinge_depth", 0.0)
    w, n = 0.125 - depth, load / weight
    e = given.get("eccentricity", given.get("bearing_distance", 0.125) - 0.125)

    def multiplier(r):
        return 4.0 * w * (1.0 + n) / (r * 3.0) + 2.0 * n * (w + e) / (3.0 * (1.0 - r))

    # A given hinge is that of the check if it is next to the weakest one.
    expected = min(map(multiplier, np.linspace(0.1, 0.9, 200_001)))
    if "hinge" in given and multiplier(given["hinge"]) <= 1.01 * expected:
        expected = multiplier(given["hinge"])
    with silent():
        check = dd.check_ntc(dd.TwoBlockWall(**given), SITE)
    assert check.value("mechanism", "", "alpha_0") == pytest.approx(expected, rel=1e-10)


def test_both_places_of_a_load():
    with pytest.raises(InputError, match=r"eccentricity = -0\.04: give either eccentricity or bearing"):
        dd.TwoBlockWall(3.0, 0.25, **STRIP["overburden"], **PLACES["eccentricity"], **PLACES["bearing"])


def test_the_table_says_what_goes_together(root):
    """Each exclusion of the table is one that a wall has, and the page of variables has it."""
    import runpy

    page = runpy.run_path(str(root / "docs/variables.py"))["page"]()
    rows = {row.name: row for row in properties("wall")}
    excluded = {name for name, row in rows.items() if "leaves" in row.not_with}
    assert excluded == {
        *(
            "mass",
            "load",
            "inertia_mass",
            "thrust",
            "spring",
            "distributed_spring",
            "tie_height",
            "interlock_overlap",
            "wedge_thickness",
            "elevation_x",
        ),
    }
    for group in ("wall", "building"):
        for row in properties(group):
            for other in row.not_with:
                assert other in {one.name for one in properties(group)}
                assert re.search(rf"\| `{row.name}` \|.*; not with .*`{other}`", page), (row.name, other)
