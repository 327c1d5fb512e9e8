"""Walls: values, errors, immutability."""

import copy
import dataclasses
import math
import pickle

import pytest
from hypothesis import given
from hypothesis import strategies as st

import dondolo as dd

WALLS = [
    dd.OneSidedWall(height=3.0, thickness=0.25),
    dd.FreeStandingWall(height=2.0, thickness=0.4, restitution="constant", restitution_value=0.7, name="block"),
    dd.TwoBlockWall(height=3.6, thickness=0.3, hinge=0.6, overburden=8000.0, eccentricity=0.05),
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
    assert (wall.density, wall.hinge, wall.overburden, wall.eccentricity) == (1800.0, 0.5, 0.0, 0.0)
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
            "restitution = 'elastic': must be one of 'default', 'sorrentino', 'constant'",
        ),
        (
            lambda: dd.OneSidedWall(3.0, 0.25, restitution="constant"),
            "restitution_value: must be given with restitution = 'constant'",
        ),
        (lambda: dd.TwoBlockWall(3.0, 0.25, hinge=1.0), "hinge = 1: must lie between 0.01 and 0.99"),
        (lambda: dd.OneSidedWall("3", 0.25), "height = '3': must be a number"),
        (lambda: dd.OneSidedWall(3.0, None), "thickness: must be given"),
        (lambda: dd.OneSidedWall(3.0, 0.25, name="a\nb"), "name: must stand on one line"),
    ],
)
def test_errors(make, sentence):
    with pytest.raises(dd.InputError) as caught:
        make()
    assert str(caught.value) == sentence
    assert isinstance(caught.value, ValueError)
    assert isinstance(caught.value, dd.DondoloError)


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


def test_population(root):
    population = dd.read_population(root / "data/walls/population.csv")
    assert len(population) == len(population.walls) == len(population.weights) == 24
    assert {wall.mechanism for wall in population} == {"one_sided", "two_block"}
    assert not population.weights.flags.writeable
    heavier = dd.read_population(root / "data/walls/population.csv", gravity=10.0)
    assert all(wall.gravity == 10.0 for wall in heavier)


@pytest.mark.parametrize("weights", [[1.0], [1.0, -1.0], [0.0, 0.0], [1.0, math.nan]])
def test_wrong_weights(weights):
    with pytest.raises(dd.InputError):
        dd.Population((WALLS[0], WALLS[1]), weights)
