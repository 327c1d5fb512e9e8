"""The hinge of a wall of two blocks that collapses first, against single runs and the statics in closed form."""

from types import SimpleNamespace

import numpy as np
import pytest

import dondolo as dd
from dondolo.populations.weakest_hinge import _warnings

LEVELS = np.arange(0.2, 3.2, 0.2)
HINGES = [0.45, 0.55, 0.65, 0.75, 0.85]


@pytest.fixture(scope="module")
def records():
    return dd.synthetic_records(magnitude=6.5, distance=10.0, site="shallow", n_records=20)


@pytest.fixture(scope="module")
def found(records):
    wall = dd.TwoBlockWall(3.0, 0.25, restitution_factor=0.87, name="strip")
    return dd.weakest_hinge(wall, records, LEVELS, hinges=HINGES, progress=False)


def test_bare_wall(found):
    """A bare strip begins to rock at 2 t / (r h), so that the highest hinge is the first."""
    assert found.triggers == pytest.approx(2.0 * 0.25 / (3.0 * np.array(HINGES)), rel=1e-12)
    assert found.first_to_rock == 0.85


def test_each_height_alone(found, records):
    """Each height has the curve of a wall of its own, and the lowest median decides."""
    thetas = []
    for hinge in HINGES:
        wall = dd.TwoBlockWall(3.0, 0.25, hinge=hinge, restitution_factor=0.87)
        thetas.append(dd.multiple_stripe(wall, records, LEVELS, progress=False).fit().theta)
    assert found.thetas.tolist() == thetas
    assert found.hinge == HINGES[int(np.argmin(thetas))]
    assert found.curve.theta == min(thetas)
    assert found.wall.hinge == found.hinge
    assert found.wall.name == f"strip, hinge at {found.hinge:g}"


def test_load(records):
    """A load on the top holds the short upper block: the weakest height is in between."""
    wall = dd.TwoBlockWall(3.0, 0.25, restitution_factor=0.87, overburden=5e3, overburden_inertia=0.0)
    found = dd.weakest_hinge(wall, records, LEVELS, progress=False)
    assert len(found.hinges) == 26
    assert 0.6 < found.first_to_rock < 0.8
    assert 0.6 < found.hinge < 0.9


def test_levels_that_miss_the_weakest(records):
    """Heights without a curve may be the weakest: nothing is said then."""
    wall = dd.TwoBlockWall(3.0, 0.25, restitution_factor=1.0)
    with pytest.raises(dd.errors.DondoloError, match=r"hinge at 0\.9: may be weaker than all others"):
        dd.weakest_hinge(wall, records, [1.1, 1.2, 1.3, 1.4], hinges=[0.3, 0.9], progress=False)


def test_files_and_figure(found, tmp_path):
    found.save(tmp_path / "hinges.npz")
    assert dd.load(tmp_path / "hinges.npz").thetas.tolist() == found.thetas.tolist()
    ax = found.plot()
    assert ax.get_xlabel() == "height of the hinge / height of the wall"
    assert f"collapses first: {found.hinge:g}" in [text.get_text() for text in ax.get_legend().get_texts()]
    assert "hinge that collapses first" in repr(found)


def test_refused(records):
    wall = dd.TwoBlockWall(3.0, 0.25)
    for walls, hinges, message in (
        (dd.OneSidedWall(3.0, 0.25), HINGES, "must be a TwoBlockWall, not OneSidedWall"),
        (wall, [0.5, 1.2], "must lie between 0.01 and 0.99|hinge = 1.2"),
        (wall, [0.6, 0.5], "must increase"),
        (wall, [0.6], "at least two"),
    ):
        with pytest.raises(dd.errors.InputError, match=message):
            dd.weakest_hinge(walls, records, LEVELS, hinges=hinges, progress=False)
    with pytest.raises(dd.errors.DondoloError, match="no height has a curve"):
        dd.weakest_hinge(wall, records, [0.01, 0.02], hinges=HINGES, progress=False)


def test_the_end_of_the_range_is_warned_of(found, records):
    wall = dd.TwoBlockWall(3.0, 0.25, restitution_factor=0.87, name="strip")
    lower, higher = ([height for height in HINGES if sign * (height - found.hinge) <= 0.0] for sign in (1.0, -1.0))
    cases = [(lower, "higher"), (higher, "lower")]
    assert any(len(heights) > 1 for heights, _ in cases)
    for heights, side in cases:
        if len(heights) > 1:
            with pytest.warns(
                dd.errors.DondoloWarning, match=f"at an end of the range, {found.hinge:g}: {side} ones"
            ) as told:
                dd.weakest_hinge(wall, records, LEVELS, hinges=heights, progress=False)
            assert told[-1].message.code == "hinge_at_end"


@pytest.mark.parametrize(
    ("hinges", "thetas", "count"),
    [
        ([0.01, 0.5], [0.4, 0.5], 0),
        ([0.02, 0.5], [0.4, 0.5], 1),
        ([0.5, 0.99], [0.5, 0.4], 0),
        ([0.5, 0.98], [0.5, 0.4], 1),
        ([0.4, 0.5, 0.6], [0.5, 0.4, 0.5], 0),
        ([0.4, 0.5], [0.5, np.nan], 0),
    ],
)
def test_no_wall_has_a_hinge_beyond_its_limits(hinges, thetas, count):
    search = SimpleNamespace(
        hinges=np.array(hinges),
        thetas=np.array(thetas),
        hinge=hinges[int(np.nanargmin(thetas))],
        wall=dd.TwoBlockWall(3.0, 0.25),
    )
    assert len(_warnings(search)) == count
