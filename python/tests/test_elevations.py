"""Facades given by their elevation: the same masonry described otherwise, thin strips, hinges, refusals."""

from __future__ import annotations

import re

import numpy as np
import pytest

import dondolo as dd

SITE = dd.Site(0.2, 2.5, 0.35)
BOX = {"elevation_x": [0.0, 6.0, 6.0, 0.0], "elevation_z": [0.0, 0.0, 7.0, 7.0]}
HOUSE = {"elevation_x": [0.0, 6.0, 6.0, 3.0, 0.0], "elevation_z": [0.0, 0.0, 6.0, 7.5, 6.0]}
OPENINGS = [
    dd.Opening(x=2.5, z=0.0, width=1.0, height=2.2),
    dd.Opening(x=0.8, z=4.0, width=0.9, height=1.4),
    dd.Opening(x=4.3, z=4.0, width=0.9, height=1.4),
]
TERMS = ("inertia", "excitation_lever", "restoring_moment", "load_force")
ROTATIONS = np.linspace(0.0, 0.06, 4)


def facade(**more):
    given = {"thickness": 0.5, "density": 1900.0, "facade_length": 6.0, "hinge_depth": 0.02}
    return dd.OneSidedWall(**given | HOUSE | {"openings": OPENINGS} | more)


def same(one, other, rel=1e-13):
    for name in TERMS:
        assert getattr(one.terms(ROTATIONS), name) == pytest.approx(getattr(other.terms(ROTATIONS), name), rel=rel), (
            name
        )
    assert one.capacity_angle == pytest.approx(other.capacity_angle, rel=rel)
    assert one.restitution_coefficient == pytest.approx(other.restitution_coefficient, rel=rel)


def test_a_rectangle_is_a_plain_wall():
    loads = [dd.Load(6e3, depth=0.3, height=3.5, inertia="both")]
    ties = [dd.Tie(height=6.8, area=5e-5, length=8.0)]
    more = {"loads": loads, "ties": ties, "density": 1900.0, "hinge_depth": 0.02, "restitution": "impulse"}
    same(dd.OneSidedWall(thickness=0.5, facade_length=6.0, **BOX, **more), dd.OneSidedWall(7.0, 0.5, **more))


@pytest.mark.parametrize("turned", [False, True])
def test_a_gable_is_a_section_that_narrows(turned):
    """Storeys of a box and a gable have closed forms of their own; either way round the corners may stand."""
    storeys = [dd.Section(6.0, 0.5, base_width=1.0, top_width=1.0), dd.Section(1.5, 0.5, base_width=1.0, top_width=0.0)]
    corners = {name: values[::-1] for name, values in HOUSE.items()} if turned else HOUSE
    more = {"density": 1900.0, "hinge_depth": 0.02, "restitution": "impulse"}
    one = facade(**corners, openings=[])
    same(one, dd.OneSidedWall(sections=storeys, **more))
    assert one.height == 7.5
    # And above a hinge in the storey, and in the gable
    for level in (2.0, 6.5):
        whole = dd.OneSidedWall(sections=storeys, hinge_level=level, **more)
        same(facade(**corners, openings=[], hinge_level=level), whole)


def test_thin_strips():
    """Weights of strips of the house less its openings."""
    edges = np.linspace(0.0, 7.5, 300_001)
    z, dz = 0.5 * (edges[1:] + edges[:-1]), np.diff(edges)
    width = np.where(z < 6.0, 6.0, 6.0 * (7.5 - z) / 1.5)
    for one in OPENINGS:
        width -= np.where((z > one.z) & (z < one.z + one.height), one.width, 0.0)
    mass, e = 1900.0 * 0.5 / 6.0 * width * dz, 0.25 - 0.02
    terms = facade().terms(0.0)
    assert terms.excitation_lever == pytest.approx(np.sum(mass * z), rel=1e-6)
    assert terms.restoring_moment == pytest.approx(9.81 * e * np.sum(mass), rel=1e-6)
    assert terms.inertia == pytest.approx(np.sum(mass * (z**2 + e**2 + 0.5**2 / 12.0)), rel=1e-6)


def test_openings_at_storeys_are_their_fill():
    """Openings over the whole width of a storey's height are a storey with less masonry."""
    belt = [dd.Opening(x=1.0, z=3.0, width=2.4, height=2.0)]
    storeys = [dd.Section(3.0, 0.5, fill=1.0), dd.Section(2.0, 0.5, fill=0.6), dd.Section(2.0, 0.5, fill=1.0)]
    more = {"density": 1900.0, "hinge_depth": 0.02, "restitution": "impulse"}
    one = facade(**BOX, openings=belt)
    same(one, dd.OneSidedWall(sections=storeys, **more))
    # A hinge that cuts the openings
    whole = dd.OneSidedWall(sections=storeys, hinge_level=4.0, **more)
    same(facade(**BOX, openings=belt, hinge_level=4.0), whole)


def test_check_and_wedges():
    """The sheet has the masonry of the elevation once; wedges stand beside it."""
    wedge = dd.Wedge(thickness=0.45, angle=20.0, bottom=0.0, top=6.0, length=2.0)
    wall = facade(wedges=[wedge, wedge])
    check, alone = dd.check_ntc(wall, SITE), dd.check_ntc(facade(), SITE)
    assert [item.item for item in check.items] == ["section 1", "wedge 1", "wedge 2", "masonry"]
    area = 6.0 * 6.0 + 4.5 - 2.2 - 2.0 * 0.9 * 1.4
    assert check.items[0].force == pytest.approx(1900.0 * 0.5 * area / 6.0 * 9.81, rel=1e-13)
    assert check.value("mechanism", "", "bare_alpha_0") == pytest.approx(
        alone.value("mechanism", "", "alpha_0"), rel=1e-13
    )
    terms = wall.terms(0.0)
    alpha_0 = check.value("mechanism", "", "alpha_0")
    assert alpha_0 == pytest.approx(terms.restoring_moment / terms.excitation_lever / 9.81, rel=1e-12)


@pytest.mark.parametrize(
    ("more", "match"),
    [
        ({"facade_length": None}, "facade_length: must be given with"),
        ({"elevation_z": None, "height": 7.5}, "elevation_z: must be given with elevation_x"),
        ({"elevation_z": [0.0, 0.0, 6.0, 7.5]}, "elevation_z: has 4 values, must have 5 as elevation_x"),
        ({"elevation_x": [0.0, 6.0], "elevation_z": [0.0, 7.0], "openings": []}, "must have at least 3"),
        ({"elevation_x": [0.0, 6.0, 0.0, 6.0], "elevation_z": [0.0, 0.0, 7.0, 7.0]}, "after corners 2 and 4 cross"),
        ({"openings": [dd.Opening(x=5.5, z=1.0, width=1.0, height=1.0)]}, r"0\.5 m2 of its 1 m2 lie outside"),
        ({"openings": [OPENINGS[0], dd.Opening(x=3.0, z=1.0, width=1.0, height=2.0)]}, "overlaps one before it"),
        ({"height": 8.0}, r"height = 8: must be 7\.5, that of the highest corner"),
        ({"elevation_x": None, "elevation_z": None, "height": 7.0}, "only with elevation_x"),
        ({"free": True, "young_modulus": 1e9}, "not with"),
        ({"hinge_level": 7.5}, "less than the height of the wall"),
        ({"hinge_depth": 0.0, "compressive_strength": 2e6}, "doors shorten the masonry that is crushed"),
        ({"restitution": "sorrentino"}, "must be one of 'default', 'impulse'"),
        ({"facade_length": 3.0}, r"facade_length = 3: must be 6 m, the width of the elevation"),
        ({"facade_length": 6.07}, r"facade_length = 6\.07: must be 6 m"),
        ({"openings": [dd.Opening(x=0.0, z=2.0, width=6.0, height=1.0)]}, "whole width of the facade from 2 to 3 m"),
        (
            {
                "openings": [
                    dd.Opening(x=0.0, z=2.0, width=4.0, height=2.0),
                    dd.Opening(x=4.0, z=1.0, width=2.0, height=1.5),
                ]
            },
            r"whole width of the facade from 2 to 2\.5 m above the base, what is above rests on nothing",
        ),
        ({"openings": [dd.Opening(x=0.0, z=0.0, width=6.0, height=2.0)]}, "whole width of the facade from 0 to 2 m"),
        # The neck of a polygon, in which an opening begins below and ends above it
        (
            {
                "elevation_x": [0.0, 6.0, 6.0, 4.0, 4.0, 6.0, 6.0, 0.0, 0.0, 2.0, 2.0, 0.0],
                "elevation_z": [0.0, 0.0, 3.0, 3.0, 4.0, 4.0, 7.0, 7.0, 4.0, 4.0, 3.0, 3.0],
                "openings": [dd.Opening(x=2.0, z=2.0, width=2.0, height=3.0)],
            },
            "whole width of the facade from 3 to 4 m",
        ),
        # Heights above the ground, of a facade that stands 3 m above it
        ({"elevation_z": [3.0, 3.0, 9.0, 10.5, 9.0], "openings": []}, "no masonry is from 0 to 3 m above the base"),
        ({"wedges": [dd.Wedge(thickness=0.45, angle=20.0, bottom=0.0, top=7.0, length=2.0)]}, "at most 6 m, the"),
    ],
)
def test_refusals(more, match):
    with pytest.raises(dd.errors.InputError, match=match):
        facade(**more)


@pytest.mark.parametrize(
    ("x", "z", "match"),
    [
        # The first corner again at the end
        ([0.0, 6.0, 6.0, 0.0, 0.0], [0.0, 0.0, 7.0, 7.0, 0.0], "corners 1 and 4 touch or overlap"),
        # The same corner twice
        ([0.0, 6.0, 6.0, 6.0, 0.0], [0.0, 0.0, 0.0, 7.0, 7.0], "touch or overlap"),
        # A corner on the base, between its ends
        ([0.0, 6.0, 6.0, 3.0, 0.0], [0.0, 0.0, 7.0, 0.0, 7.0], "corners 1 and 3 touch or overlap"),
        # An edge that goes back on the one before it
        ([0.0, 6.0, 6.0, 6.0, 0.0], [0.0, 0.0, 9.0, 7.0, 7.0], "corners 2 and 3 touch or overlap"),
        # Two towers whose bases lie on each other
        ([0.0, 4.0, 4.0, 2.0, 6.0, 6.0, 0.0], [0.0, 0.0, 3.0, 0.0, 0.0, 7.0, 7.0], "touch or overlap"),
        # Around it twice
        ([0.0, 6.0, 6.0, 0.0] * 2, [0.0, 0.0, 7.0, 7.0] * 2, "touch or overlap"),
        # A corner that lies on an edge but for rounding
        ([0.0, 6.0, 6.0, 0.3, 0.0], [0.0, 0.7, 7.0, 0.035 + 1e-12, 7.0], "touch or overlap"),
        # A line
        ([0.0, 3.0, 6.0], [0.0, 3.0, 6.0], "touch or overlap"),
    ],
)
def test_edges_that_touch(x, z, match):
    with pytest.raises(dd.errors.InputError, match=match):
        facade(elevation_x=x, elevation_z=z, openings=[])


def test_corners_on_a_straight_edge():
    corners = {"elevation_x": [0.0, 2.0, 6.0, 6.0, 6.0, 0.0], "elevation_z": [0.0, 0.0, 0.0, 3.0, 7.0, 7.0]}
    same(facade(**corners, openings=[]), facade(**BOX, openings=[]))


def test_nothing_above_the_base():
    with pytest.raises(dd.errors.InputError, match="no masonry is above the base") as found:
        facade(elevation_z=[-8.0, -8.0, -2.0, -0.5, -2.0], openings=[])
    assert "height: must be given" not in str(found.value)


def test_restitution():
    """That of a wall with wedges, not of a rectangular block; where it gains energy, a value is asked for."""
    assert facade().restitution_coefficient == facade(restitution="impulse").restitution_coefficient
    storeys = [dd.Section(6.0, 0.5, base_width=1.0, top_width=1.0), dd.Section(1.5, 0.5, base_width=1.0, top_width=0.0)]
    block = dd.OneSidedWall(sections=storeys, density=1900.0, hinge_depth=0.02)
    assert facade(openings=[]).restitution_coefficient != pytest.approx(block.restitution_coefficient, rel=1e-3)
    cross = {
        "elevation_x": [2.8, 3.2, 3.2, 6.0, 6.0, 3.2, 3.2, 2.8, 2.8, 0.0, 0.0, 2.8],
        "elevation_z": [0.0, 0.0, 4.5, 4.5, 6.0, 6.0, 7.0, 7.0, 6.0, 6.0, 4.5, 4.5],
    }
    with pytest.raises(dd.errors.InputError, match=r"restitution_value: must be given, .* as 1\.\d+, it must be less"):
        facade(**cross, openings=[])
    assert facade(**cross, openings=[], restitution_value=0.4).restitution_coefficient == 0.4


def test_hinges_of_a_population(tmp_path):
    """The height of an elevation bounds levels, and facade_length stays where no wedge is above the hinge."""
    wedge = dd.Wedge(thickness=0.45, angle=20.0, bottom=0.0, top=3.0, length=2.0)
    levels = [0.0, 2.0, 6.5]
    walls = dd.Population.of_facade(facade(wedges=[wedge]), hinge_level=levels)
    assert [wall.height for wall in walls] == pytest.approx([7.5, 5.5, 1.0])
    same(walls[2], facade(hinge_level=6.5))
    lists = {f"elevation{i + 1}_{c}": HOUSE[f"elevation_{c}"][i] for i in range(5) for c in "xz"}
    row = {"name": "a", "mechanism": "one_sided", "thickness": 0.5, "density": 1900.0, "facade_length": 6.0} | lists
    table = tmp_path / "people.csv"
    row |= {"hinge_depth": 0.02, "hinge1_level": 0.0, "hinge2_level": 2.0, "hinge3_level": 6.5}
    table.write_text(",".join(row) + "\n" + ",".join(map(str, row.values())) + "\n")
    again = dd.Population.from_csv(table)
    assert [wall.height for wall in again] == pytest.approx([7.5, 5.5, 1.0])
    same(again[1], facade(openings=[], hinge_level=2.0))
    table.write_text(",".join(row) + "\n" + ",".join(map(str, (row | {"hinge3_level": 7.5}).values())) + "\n")
    with pytest.raises(dd.errors.InputError, match=r"hinge_level = 7\.5: must be less than the height of the wall"):
        dd.Population.from_csv(table)


def test_case_and_table(root, run, tmp_path):
    """The executable and tables have the same facade as Python."""
    lists = {name: ", ".join(map(str, values)) for name, values in HOUSE.items()}
    for name in ("x", "z", "width", "height"):
        lists[f"opening_{name}"] = ", ".join(str(getattr(one, name)) for one in OPENINGS)
    words = ", ".join(f"{name} = {values}" for name, values in lists.items())
    case = tmp_path / "case.nml"
    case.write_text(
        f"&job task = 'stripes' output = '{tmp_path}/out' /\n&wall mechanism = 'one_sided', thickness = 0.5,"
        f" density = 1900, facade_length = 6, hinge_depth = 0.02, {words} /\n"
        f"&records catalogue = '{root}/data/records/synthetic44.csv' /\n&stripes levels = 0.1, 0.2, 0.3, 0.5 /\n"
    )
    assert run(case).returncode == 0
    found = dd.read_results(tmp_path / "out").stripes.wall
    assert found.openings == tuple(OPENINGS)
    same(found, facade(), rel=1e-12)
    table = tmp_path / "people.csv"
    dd.Population([facade()]).to_csv(table)
    (again,) = dd.Population.from_csv(table)
    assert again.elevation_z == tuple(HOUSE["elevation_z"])
    same(again, facade(), rel=1e-12)
    assert re.search("elevation1_x", table.read_text())
