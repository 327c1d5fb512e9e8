"""Walls: values, errors, immutability."""

import copy
import dataclasses
import math
import pickle

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

import dondolo as dd
from dondolo.walls.shape import shape

WALLS = [
    dd.OneSidedWall(height=3.0, thickness=0.25),
    dd.FreeStandingWall(height=2.0, thickness=0.4, restitution_value=0.7, name="block"),
    dd.TwoBlockWall(height=3.6, thickness=0.3, hinge=0.6, overburden=8000.0, overburden_inertia=0.0, eccentricity=0.05),
]


def test_values_of_the_theory():
    wall = dd.OneSidedWall(height=3.0, thickness=0.25)
    assert wall.radius == pytest.approx(1.50519932234904, rel=1e-14)
    assert wall.slenderness_angle == pytest.approx(0.0831412318884412, rel=1e-14)
    assert wall.frequency_parameter == pytest.approx(2.21089505499269, rel=1e-14)
    assert wall.restitution_coefficient == pytest.approx(0.479576776415597, rel=1e-14)
    assert wall.trigger_acceleration / wall.gravity == pytest.approx(1.0 / 12.0, rel=1e-14)
    assert wall.capacity_angle == wall.slenderness_angle
    assert not wall.two_sided
    two = dd.TwoBlockWall(height=3.0, thickness=0.25, hinge=0.6)
    assert two.slenderness_angle == pytest.approx(0.138006023657519, rel=1e-14)
    assert two.restitution_coefficient == pytest.approx(0.957519116397621, rel=1e-14)
    assert two.two_sided


def test_defaults_come_from_fortran():
    wall = dd.TwoBlockWall(height=3.0, thickness=0.25)
    assert (wall.density, wall.hinge, wall.overburden, wall.eccentricity) == (1800.0, 0.9, 0.0, 0.0)
    assert (wall.restitution, wall.restitution_factor, wall.gravity, wall.name) == ("default", 1.0, 9.81, "wall")
    assert wall.restitution_value is None


@pytest.mark.parametrize("wall", WALLS, ids=lambda wall: wall.mechanism)
def test_immutable_comparable_picklable(wall):
    with pytest.raises(dataclasses.FrozenInstanceError):
        wall.height = 4.0
    for other in (pickle.loads(pickle.dumps(wall)), copy.deepcopy(wall), dataclasses.replace(wall)):
        assert other == wall
        assert hash(other) == hash(wall)
        assert other.frequency_parameter == wall.frequency_parameter
    assert dataclasses.replace(wall, thickness=0.28) != wall


@pytest.mark.parametrize("wall", WALLS, ids=lambda wall: wall.mechanism)
def test_shown(wall):
    for text in (repr(wall), wall._repr_html_()):
        assert wall.name in text
        assert f"{wall.frequency_parameter:.6g} rad/s" in text
        assert f"{wall.restitution_coefficient:.6g}" in text


def test_html_is_escaped():
    assert "<b>" not in dd.OneSidedWall(3.0, 0.25, name="<b>")._repr_html_()


@pytest.mark.parametrize(
    ("make", "sentence"),
    [
        (lambda: dd.OneSidedWall(3.0, -0.25), "thickness = -0.25: must be positive"),
        (lambda: dd.OneSidedWall(math.nan, 0.25), "height = NaN: must be positive"),
        (lambda: dd.OneSidedWall(3.0, 0.25, gravity=0.0), "gravity = 0: must be positive"),
        (
            lambda: dd.OneSidedWall(3.0, 0.25, restitution="elastic"),
            "restitution = 'elastic': must be one of 'default', 'sorrentino', 'impulse'",
        ),
        (
            lambda: dd.OneSidedWall(3.0, 0.25, restitution="impulse", restitution_value=0.5),
            "restitution_value = 0.5: give either it or restitution",
        ),
        (lambda: dd.TwoBlockWall(3.0, 0.25, hinge=1.0), "hinge = 1: must lie between 0.01 and 0.99"),
        (
            lambda: dd.TwoBlockWall(3.0, 0.25, eccentricity=0.0, bearing="centre"),
            "eccentricity = 0: give either eccentricity or bearing and bearing_distance",
        ),
        (
            lambda: dd.TwoBlockWall(3.0, 0.25, bearing="in", bearing_distance=0.1),
            "bearing = 'in': must be one of 'inner', 'outer', 'centre'",
        ),
        (
            lambda: dd.TwoBlockWall(3.0, 0.25, bearing_distance=math.nan),
            "bearing_distance = NaN: only with bearing = 'inner' or 'outer'",
        ),
        (lambda: dd.OneSidedWall("3", 0.25), "height = '3': must be a number"),
        (lambda: dd.OneSidedWall(3.0, None), "thickness: must be given"),
        (
            lambda: dd.OneSidedWall(3.0, 0.25, name="a\nb"),
            r"name = 'a\nb': must be one line without control characters and marks of direction",
        ),
    ],
)
def test_errors(make, sentence):
    with pytest.raises(dd.errors.InputError) as caught:
        make()
    assert str(caught.value) == sentence
    assert isinstance(caught.value, ValueError)
    assert isinstance(caught.value, dd.errors.DondoloError)


def test_a_hinge_is_for_two_blocks_only():
    with pytest.raises(TypeError):
        dd.OneSidedWall(3.0, 0.25, hinge=0.5)
    with pytest.raises(TypeError):
        dd.Wall(3.0, 0.25)


@given(height=st.floats(0.2, 30.0), slenderness=st.floats(2.0, 60.0))
def test_one_block(height, slenderness):
    wall = dd.OneSidedWall(height, height / slenderness)
    assert wall.frequency_parameter**2 == pytest.approx(0.75 * wall.gravity / wall.radius, rel=1e-12)
    assert wall.trigger_acceleration == pytest.approx(wall.gravity / slenderness, rel=1e-12)
    assert 0.0 <= wall.restitution_coefficient < 1.0


def test_terms_of_the_theory():
    wall = dd.TwoBlockWall(height=4.0, thickness=0.38, hinge=0.7)
    terms = wall.terms([0.0, wall.slenderness_angle / 2.0])
    expected = (7420.00158382046, -2070.03401639077, 5059.50054100952, 3856.72544168463, 0.0)
    assert [row[1] for row in terms] == pytest.approx(expected, rel=1e-14)
    assert wall.trigger_acceleration == terms.restoring_moment[0] / terms.excitation_lever[0]
    one = dd.OneSidedWall(height=3.0, thickness=0.25)
    terms = one.terms(one.capacity_angle)
    assert (terms.inertia, terms.inertia_rate, terms.load_force) == (pytest.approx(4078.125), 0.0, 0.0)
    assert terms.restoring_moment == 0.0


@pytest.mark.parametrize("wall", WALLS, ids=lambda wall: wall.mechanism)
def test_terms_and_potential_belong_together(wall):
    q, h = np.linspace(0.02, 1.0, 20) * wall.capacity_angle, 1e-5
    at, after, before = (wall.terms(q + step) for step in (0.0, h, -h))
    assert at.inertia_rate == pytest.approx((after.inertia - before.inertia) / (4.0 * h), rel=1e-8, abs=1e-6)
    slope = (wall.potential(q + h) - wall.potential(q - h)) / (2.0 * h)
    assert at.restoring_moment - at.load_force == pytest.approx(slope, rel=1e-7, abs=1e-3)
    assert at.load_force.any() == (wall.mechanism == "two_block")


@pytest.mark.parametrize(("bearing", "place"), [("inner", 0.06), ("outer", 0.19)])
def test_a_bearing_is_on_its_face_of_a_wall_that_folds_outwards(bearing, place):
    """Minus the load times the rise of the point where it bears, of the wall as it is drawn."""
    load = {"hinge": 0.6, "overburden": 8000.0, "overburden_inertia": 0.0, "hinge_depth": 0.012}
    wall = dd.TwoBlockWall(3.0, 0.25, bearing=bearing, bearing_distance=0.06, **load)
    assert wall == dd.TwoBlockWall(3.0, 0.25, eccentricity=wall.eccentricity, **load)
    q, h = 0.03, 1e-5

    def height(rotation):
        # Outwards is to the right
        _, _, outer, inner = shape(wall, rotation).blocks[1][:, 1]
        return inner + place / 0.25 * (outer - inner)

    rise = (height(q + h) - height(q - h)) / (2.0 * h)
    assert wall.terms(q).load_force == pytest.approx(-8000.0 * rise, rel=1e-7)


@pytest.mark.parametrize("wall", WALLS, ids=lambda wall: wall.mechanism)
def test_shape_of_terms(wall):
    table = [[0.0, 0.01, 0.02], [0.03, 0.04, 0.05]]
    for one, row in zip(wall.terms(table), wall.terms(np.ravel(table)), strict=True):
        assert np.array_equal(one, np.reshape(row, (2, 3)))
    assert wall.potential(table).shape == (2, 3)
    assert wall.potential(0.03) == wall.potential(table)[1, 0]
    assert wall.terms(0.03).inertia == wall.terms(table).inertia[1, 0]


@pytest.mark.parametrize("of", ["terms", "potential"])
@pytest.mark.parametrize(
    ("wall", "rotation", "sentence"),
    [
        (WALLS[0], -0.01, "rotation = -0.01: must be at least 0 and less than 1.65"),
        (WALLS[0], [0.1, math.nan], "rotation = NaN: must be at least 0"),
        (WALLS[1], [0.1, 1.8, 1.9], "rotation = 1.8: must be at least 0 and less than 1.768"),
        (WALLS[2], 0.97, "rotation = 0.97: must be at least 0 and less than 0.87"),
        (WALLS[0], [], "rotation: must be given"),
        (WALLS[0], [[0.1], [0.1, 0.2]], "rotation: must be numbers"),
        (WALLS[0], "0.1", "rotation: must be numbers"),
    ],
)
def test_rotations_that_a_wall_cannot_have(wall, rotation, sentence, of):
    with pytest.raises(dd.errors.InputError) as caught:
        getattr(wall, of)(rotation)
    assert str(caught.value).startswith(sentence)
    assert "\n" not in str(caught.value)


def test_population(root):
    population = dd.Population.from_csv(root / "data/walls/population.csv")
    assert len(population) == len(population.walls) == len(population.weights) == 24
    assert {wall.mechanism for wall in population} == {"one_sided", "two_block"}
    assert not population.weights.flags.writeable
    heavier = dd.Population.from_csv(root / "data/walls/population.csv", gravity=10.0)
    assert all(wall.gravity == 10.0 for wall in heavier)


@pytest.mark.parametrize("weights", [[1.0], [1.0, -1.0], [0.0, 0.0], [1.0, math.nan]])
def test_wrong_weights(weights):
    with pytest.raises(dd.errors.InputError):
        dd.Population((WALLS[0], WALLS[1]), weights)


def loaded_population():
    """Walls with different numbers of loads, one with sections, and a bare one."""
    facade = dd.OneSidedWall(
        sections=[dd.Section(4.0, 0.6), dd.Section(3.5, 0.45)],
        loads=[
            dd.Load(12000.0, depth=0.5, height=4.0, inertia="both"),
            dd.Load(6000.0, depth=0.35, height=7.5, inertia="none"),
        ],
        thrusts=[dd.Thrust(500.0, height=7.5)],
        compressive_strength=2e6,
    )
    coping = dd.FreeStandingWall(2.0, 0.3, loads=[dd.Load(500.0, depth=0.15, height=2.0, inertia="both")])
    return dd.Population([facade, coping, dd.TwoBlockWall(3.0, 0.25)])


def test_loads_have_a_home_in_tables_and_archives(tmp_path):
    population = loaded_population()
    assert population[0].height == 7.5
    assert [(load.force, load.inertia) for load in population[0].loads] == [(12e3, "both"), (6e3, "none")]
    population.to_csv(tmp_path / "walls.csv")
    head = (tmp_path / "walls.csv").read_text().splitlines()[0]
    assert "load1,load2,load1_depth,load2_depth" in head
    assert list(dd.Population.from_csv(tmp_path / "walls.csv")) == list(population)
    for wall in population:
        assert pickle.loads(pickle.dumps(wall)) == wall


def test_a_table_says_which_load_is_missing(tmp_path):
    table = tmp_path / "walls.csv"
    table.write_text("mechanism,height,thickness,load1,load2\none_sided,3,0.25,,1000\n")
    with pytest.raises(dd.errors.InputError, match="load2: only behind load1"):
        dd.Population.from_csv(table)


def test_sampled_loads():
    common = {"height": 3.0, "thickness": 0.25, "load_depth": 0.175, "load_height": 3.0, "load_inertia": "both"}
    walls = dd.Population.sample("one_sided", 4, 1, load=dd.distributions.Uniform(5e3, 10e3), **common)
    assert all(5e3 < wall.loads[0].force < 10e3 for wall in walls)
    common["load_height"] = [2.0, 3.0]
    loads = dd.Population.sample("one_sided", 2, 1, load=[1e3, 2e3], **common)[1].loads
    assert [(load.force, load.height) for load in loads] == [(1e3, 2.0), (2e3, 3.0)]


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ({"height": 3.0, "sections": []}, "thickness: must be given"),
        ({"height": 3.0, "sections": [dd.Section(2.0, 0.3)]}, "height = 3: must be 2, the sum of heights of sections"),
        ({"height": 3.0, "thickness": 0.25, "compressive_strength": 2.0}, r"at depth 3895 m.*: is it in MPa\?"),
        ({"height": 3.0, "thickness": 0.25, "hinge_depth": 200.0}, r"at depth 200 m.*0\.125 m$"),
        ({"height": 3.0, "thickness": 0.25, "compressive_strength": 2e4}, r"at depth 0\.3895 m.*0\.125 m$"),
    ],
)
def test_what_is_missing_is_named(given, message):
    with pytest.raises(dd.errors.InputError, match=message):
        dd.OneSidedWall(**given)
