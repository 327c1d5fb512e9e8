"""Panels that turn about a line of their face: values of an independent program in 30 digits, level lines, refusals."""

from __future__ import annotations

import math
from dataclasses import replace

import matplotlib
import numpy as np
import pytest

import dondolo as dd
from dondolo.walls.elevation import axis_of, height_of, outline_of, turning
from dondolo.walls.shape import shape

matplotlib.use("Agg")

SITE = dd.Site(0.2, 2.5, 0.35)
# Half of a gable above the line to a roof slope: the values below are of the whole half
WIDTH = 1.8
BETA = math.atan(1.5 / 1.8)
TERMS = ("inertia", "excitation_lever", "restoring_moment", "load_force")
ROTATIONS = np.array([0.0, 0.02, 0.04, 0.06])


def gable(**more):
    given = {
        "thickness": 0.4,
        "density": 1900.0,
        "facade_length": WIDTH,
        "hinge_depth": 0.01,
        "elevation_x": [0.0, 1.8, 0.0],
        "elevation_z": [0.0, 1.5, 2.4],
        "axis_x": [0.0, 1.8],
        "axis_z": [0.0, 1.5],
        "loads": [dd.Load(4.5e3 / WIDTH, depth=0.2, height=2.4, x=0.0, inertia="both")],
    }
    return dd.OneSidedWall(**given | more)


def facade(**more):
    """A facade with two windows, of which one lies on the crack of the panels below."""
    given = {
        "thickness": 0.5,
        "density": 1900.0,
        "facade_length": 6.0,
        "hinge_depth": 0.02,
        "elevation_x": [0.0, 6.0, 6.0, 0.0],
        "elevation_z": [0.0, 0.0, 6.5, 6.5],
        "openings": [
            dd.Opening(x=0.8, z=4.0, width=0.9, height=1.4),
            dd.Opening(x=4.3, z=4.0, width=0.9, height=1.4),
        ],
    }
    return dd.OneSidedWall(**given | more)


@pytest.mark.parametrize("kind", ["load", "inertia", "thrust"])
def test_what_acts_on_a_panel_is_on_its_elevation(kind):
    """The end of a beam may lie a little outside; what is farther off has no place on the masonry."""

    def gable_with(x, height):
        place = {"x": x, "depth": 0.2, "height": height}
        things = {
            "load": {"loads": [dd.Load(1e3, inertia="both", **place)]},
            "inertia": {"inertial_masses": [dd.InertialMass(100.0, **place)]},
            "thrust": {"thrusts": [dd.Thrust(10.0, **place)]},
        }
        return gable(**{"loads": [], **things[kind]})

    assert gable_with(0.9, 1.9).height == gable_with(0.9, 2.0).height
    # Above the line, but beyond the ridge or beside the axis of the gable
    for x, height, off in ((0.0, 2.7, "0.3"), (-0.5, 1.5, "0.5")):
        with pytest.raises(dd.errors.InputError, match=f"is {off} m off the elevation, must be on it or within 0.1 m"):
            gable_with(x, height)


def test_terms():
    wall = gable()
    assert wall.height == pytest.approx(2.4 * math.cos(BETA), rel=1e-14)
    assert wall.capacity_angle == pytest.approx(0.2119373752252902, rel=1e-12)
    assert wall.restitution_coefficient == pytest.approx(0.2534796753046842, rel=1e-12)
    terms = wall.terms(ROTATIONS)
    assert WIDTH * terms.inertia == pytest.approx(np.full(4, 2587.102213602045), rel=1e-12)
    levers = [1854.637839791523, 1862.247591784398, 1869.112469570196, 1875.229727289333]
    assert WIDTH * terms.excitation_lever == pytest.approx(levers, rel=1e-12)
    moments = [3007.415948872763, 2727.292805052663, 2446.078780473962, 2163.886356997020]
    assert WIDTH * (terms.restoring_moment - terms.load_force) == pytest.approx(moments, rel=1e-12)
    # The moment is the slope of the potential energy
    step = 1e-4
    slope = (wall.potential(0.04 + step) - wall.potential(0.04 - step)) / (2.0 * step)
    assert WIDTH * slope == pytest.approx(moments[2], rel=1e-8)


def test_check():
    check = dd.check_ntc(gable(), SITE)
    expected = {
        "alpha_0": 0.1652971534749786,
        "mass": 1578.289769789383 / WIDTH,
        "mass_ratio": 0.7514536256108421,
        "a_0": 2.157904387341802 / check.value("mechanism", "", "knowledge_factor"),
        "d_0": 0.2471859665252724,
    }
    for name, value in expected.items():
        assert check.value("mechanism", "", name) == pytest.approx(value, rel=1e-12), name
    # The table of items gives the multiplier: of weights the share cos beta holds
    items = {item.item: item for item in check.items}
    assert list(items) == ["section 1", "masonry", "load 1"]
    held = items["section 1"].stabilising + items["load 1"].stabilising
    moved = items["section 1"].force_lever + items["load 1"].force_lever
    assert held / moved == pytest.approx(expected["alpha_0"], rel=1e-12)
    load = items["load 1"]
    assert load.stabilising == pytest.approx(load.force * load.arm * math.cos(BETA), rel=1e-12)
    # Along an inclined line the forces at the hinge are not known
    assert check._row("mechanism", "", "friction_needed") is None
    assert "sliding_unknown" in {note.code for note in check.notes}


@pytest.mark.parametrize("engine", ["rk45", "lanes"])
def test_history(engine):
    time = np.arange(round(2 * 0.6 / 0.01) + 1) * 0.01
    shaking = np.r_[-4.5 * np.sin(2.0 * np.pi * time / 0.6), np.zeros(3000)]
    wall = gable()
    found = dd.simulate(wall, dd.Record(shaking, 0.01), solver=dd.Solver(engine=engine, rtol=1e-12, atol=1e-14))
    assert found.edp * wall.capacity_angle == pytest.approx(0.1424319422701765, abs=1e-11)


@pytest.mark.filterwarnings("ignore::dondolo.errors.DondoloWarning")
def test_vertical_motion_shakes_its_share_of_gravity():
    """A record whose vertical component halves gravity for good is the same panel with half of gravity."""
    time = np.arange(400) * 0.01
    ground = -2.5 * np.sin(2.0 * np.pi * time / 0.8)
    shaken = dd.Record(ground, 0.01, vertical=np.full(400, -0.5 * 9.81))
    wall = gable(loads=[], restitution_value=0.3)
    light = replace(wall, gravity=0.5 * 9.81)
    edp = [dd.simulate(one, record).edp for one, record in ((wall, shaken), (light, dd.Record(ground, 0.01)))]
    assert edp[0] == pytest.approx(edp[1], rel=1e-9)
    assert edp[0] > 0.1


def same(one, other, rel=1e-13):
    for name in TERMS:
        assert getattr(one.terms(ROTATIONS), name) == pytest.approx(getattr(other.terms(ROTATIONS), name), rel=rel), (
            name
        )
    assert one.capacity_angle == pytest.approx(other.capacity_angle, rel=rel)
    assert one.restitution_coefficient == pytest.approx(other.restitution_coefficient, rel=rel)


def test_a_level_line_is_a_hinge_at_its_level():
    """With what leans on a building: a hinge there has the same panel, whatever points the line goes through."""
    loads = [dd.Load(3e3, depth=0.3, height=6.0, inertia="both")]
    thrusts = [dd.Thrust(100.0, height=6.0)]
    whole = facade(loads=loads, thrusts=thrusts, hinge_level=3.0)
    placed = {"loads": [replace(loads[0], x=1.0)], "thrusts": [replace(thrusts[0], x=5.0)]}
    for points in ([0.0, 6.0], [5.0, 1.0]):
        same(facade(axis_x=points, axis_z=[3.0, 3.0], **placed), whole)
    house = dd.Building(0.3, storeys=2, level=0.0, building_height=6.5)
    level = facade(axis_x=[0.0, 6.0], axis_z=[0.0, 0.0], building=house)
    assert level.support_share == pytest.approx(facade(building=house).support_share, rel=1e-13)
    tilted = facade(axis_x=[0.0, 6.0], axis_z=[3.0, 4.0], building=house)
    assert tilted.support_share == 0.0
    with pytest.raises(
        dd.errors.InputError, match="level_top: not of a free-standing wall nor of one with an inclined"
    ):
        facade(axis_x=[0.0, 6.0], axis_z=[3.0, 4.0], building=replace(house, level_top=6.5))


def test_thin_grid():
    """Weights of small squares above an inclined crack that cuts a window."""
    wall = facade(axis_x=[0.0, 6.0], axis_z=[5.0, 3.4])
    step = 0.005
    x, z = np.meshgrid(np.arange(0.5 * step, 6.0, step), np.arange(0.5 * step, 6.5, step))
    solid = np.ones_like(x, dtype=bool)
    for hole in wall.openings:
        solid &= ~((x > hole.x) & (x < hole.x + hole.width) & (z > hole.z) & (z < hole.z + hole.height))
    f = axis_of(wall).above(np.stack([x, z], axis=-1))
    f = f[solid & (f > 0.0)]
    mass, e, cosine = 1900.0 * 0.5 / 6.0 * step**2, 0.25 - 0.02, 6.0 / math.hypot(6.0, 1.6)
    terms = wall.terms(0.0)
    assert terms.excitation_lever == pytest.approx(mass * f.sum(), rel=2e-4)
    assert terms.restoring_moment == pytest.approx(9.81 * cosine * e * mass * f.size, rel=2e-4)
    assert terms.inertia == pytest.approx(mass * np.sum(f**2 + e**2 + 0.5**2 / 12.0), rel=2e-4)


def test_a_mirror_image_is_the_same_panel():
    wall = gable()
    mirrored = gable(
        elevation_x=[0.0, -1.8, 0.0],
        axis_x=[-1.8, 0.0],
        axis_z=[1.5, 0.0],
        loads=[replace(wall.loads[0], x=-0.0)],
    )
    same(mirrored, wall)


def test_drawings():
    wall = gable()
    assert height_of(wall, wall.loads[0]) == pytest.approx(2.4 * math.cos(BETA), rel=1e-14)
    assert turning(wall, outline_of(wall)).tolist() == outline_of(wall).tolist()
    assert shape(wall, 0.0).blocks[0][:, 1].max() == pytest.approx(wall.height)
    ax = wall.plot_elevation()
    assert [text.get_text() for text in ax.texts] == ["", "2.5 kN/m"]
    # The load is drawn where it acts, above the panel in its section
    section = wall.plot()
    assert section.get_ylim()[1] > wall.height
    crack = facade(axis_x=[0.0, 6.0], axis_z=[5.0, 3.4])
    above = turning(crack, outline_of(crack))
    np.testing.assert_allclose(above, [[6.0, 3.4], [6.0, 6.5], [0.0, 6.5], [0.0, 5.0]], rtol=0.0, atol=1e-12)
    line = facade().plot_elevation().lines[0]
    assert line.get_xydata().tolist() == [[0.0, 0.0], [6.0, 0.0]]
    with pytest.raises(dd.errors.InputError, match="no elevation to draw"):
        dd.OneSidedWall(3.0, 0.25).plot_elevation()
    matplotlib.pyplot.close("all")


def test_case_and_table(root, run, tmp_path):
    """The executable and tables have the same panel."""
    finished = run("--check", root / "data/cases/panel.nml")
    assert finished.returncode == 0, finished.stderr
    assert "heights are above the line through (0, 5) and (6, 3.4) m; share of gravity 0.96" in finished.stdout
    table = tmp_path / "people.csv"
    dd.Population([gable(), facade(name="facade")]).to_csv(table)
    again = dd.Population.from_csv(table)
    same(again[0], gable(), rel=1e-12)
    assert again[0].loads[0].x == 0.0


@pytest.mark.parametrize(
    ("more", "match"),
    [
        ({"axis_z": None}, "axis_z: must be given with axis_x"),
        ({"axis_x": None, "loads": []}, "axis_x: must be given with axis_z"),
        ({"axis_x": [0.0, 1.8, 2.0]}, "axis_x: has 3 values, must have 2"),
        ({"axis_x": [1.8, 1.8]}, "are 0 m from each other along the facade, the line .* at most 80 degrees"),
        ({"axis_z": [0.0, 30.0]}, "at most 80 degrees"),
        ({"loads": [dd.Load(2.5e3, depth=0.2, height=2.4, inertia="both")]}, "x: must be given with load"),
        (
            {"loads": [dd.Load(2.5e3, depth=0.2, height=1.0, x=1.8, inertia="both")]},
            r"0\.384\d* m above the axis, must lie between 0 and 1\.844 m, the panel",
        ),
        ({"axis_x": None, "axis_z": None}, "x: only with axis_x"),
        ({"axis_z": [2.4, 3.9]}, "no masonry is above the axis"),
        ({"ties": [dd.Tie(height=2.0, area=5e-5, length=8.0)]}, "axis_x: not with heights of ties"),
        ({"hinge_level": 0.5}, "not with hinge_level"),
        ({"free": True}, "not with free"),
        ({"height": 2.4}, r"height = 2\.4: must be 1\.84"),
    ],
)
def test_refusals(more, match):
    with pytest.raises(dd.errors.InputError, match=match):
        gable(**more)


def test_an_axis_needs_an_elevation():
    with pytest.raises(dd.errors.InputError, match="axis_x: only with elevation_x"):
        dd.OneSidedWall(3.0, 0.25, axis_x=[0.0, 1.0], axis_z=[0.0, 0.5])


def half(**more):
    return gable(half_gable=True, **more)


def test_half_of_a_gable_has_a_check_alone():
    """Its sheet is that of the panel, with how far both halves would overlap: 50 mm at 0.1 rad."""
    check, panel = dd.check_ntc(half(), SITE), dd.check_ntc(gable(), SITE)
    for name in ("alpha_0", "mass", "mass_ratio", "d_0"):
        assert check.value("mechanism", "", name) == panel.value("mechanism", "", name)
    overlap = check.value("mechanism", "", "halves_overlap")
    assert overlap == pytest.approx(2.0 * 0.39 * math.sin(BETA) * half().capacity_angle, rel=1e-12)
    assert overlap * 0.1 / half().capacity_angle == pytest.approx(0.050, abs=1e-3)
    assert "halves_jam" in {note.code for note in check.notes}
    assert "halves_jam" not in {note.code for note in panel.notes}
    assert panel._row("mechanism", "", "halves_overlap") is None
    records = dd.example_records()[:2]
    runs = (
        lambda: dd.simulate(half(), records[0]),
        lambda: dd.multiple_stripe(half(), records, [0.2, 0.4], progress=False),
        lambda: dd.typology(dd.Population([gable(name="a"), half(name="b")]), records, [0.2, 0.4], progress=False),
    )
    for run in runs:
        with pytest.raises(dd.errors.InputError, match=r"half_gable: has a check and no time histories, .* jam"):
            run()
    with pytest.raises(dd.errors.InputError, match="half_gable: only with an inclined axis"):
        half(axis_z=[0.0, 0.0])
    with pytest.raises(dd.errors.InputError, match="half_gable: only with an inclined axis"):
        dd.OneSidedWall(3.0, 0.25, half_gable=True)


def test_what_rests_on_nothing_above_the_axis():
    """A window across the whole panel, parallel to no edge of it."""
    corners = {"elevation_x": [0.0, 2.0, 2.0, 0.0], "elevation_z": [0.0, 0.0, 6.0, 6.0]}
    window = dd.Opening(x=0.0, z=2.0, width=2.0, height=2.5)
    with pytest.raises(dd.errors.InputError, match=r"openings take the whole width .* above the axis"):
        facade(facade_length=2.0, axis_x=[0.0, 2.0], axis_z=[1.0, 1.3], openings=[window], **corners)
