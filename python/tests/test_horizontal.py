"""Horizontal bending by its geometry: the chain that it is, its weakest hinge, its messages, reports and routes."""

import dataclasses
import math
import subprocess

import numpy as np
import pytest
from test_rigid_chains import SITE, G

import dondolo as dd
from dondolo.walls.chains import TABLES

BAND = {
    "length": 5.0, "thickness": 0.45, "density": 1900.0, "end_thrust": 25e3, "compressive_strength": 1.5e6,
    "push": [400.0, 300.0], "push_x": [1.5, 3.2], "sides": 1, "restitution_value": 0.7,
}  # fmt: skip


def band(**more):
    return dd.HorizontalBending(**{**BAND, **more})


def multiplier(at, wall):
    """By virtual work of the thrust, of the pushes and of the inertia of both leaves."""
    length, lever = wall.length, wall.thickness - 2.0 * wall.base_hinge_depth
    turn = at / (length - at)
    work = wall.end_thrust * lever * (1.0 + turn)
    work -= sum(f * (x if x < at else turn * (length - x)) for f, x in zip(wall.push, wall.push_x, strict=True))
    return work / (wall.thickness * wall.density * G * 0.5 * at * length)


@pytest.mark.parametrize("more", [{}, {"sides": 2, "push": None, "push_x": None}, {"hinge_x": 2.2}])
def test_it_is_the_chain_of_its_rows(more):
    """Terms, ends of motions and checks are those of a chain that has its rows, to the bit."""
    wall = band(**more)
    tables = {name: wall._rows(name).ravel().tolist() or None for name in TABLES}
    chain = dd.Chain(height=5.0, gravity_share=0.0, sides=wall.sides, restitution_value=0.7, name=wall.name, **tables)
    assert wall._statics[3:6] == chain._statics[3:6]
    assert wall.impact_bound == chain.impact_bound
    q = np.linspace(0.0, 0.9 * wall.capacity_angle, 5)
    for one, other in zip(wall.terms(q), chain.terms(q), strict=True):
        assert one.tolist() == other.tolist()
    records = dd.synthetic_records(6.5, 10.0, "shallow", n_records=4)
    edp = [dd.multiple_stripe(one, records, (0.5, 1.0), progress=False).edp for one in (wall, chain)]
    assert edp[0].tolist() == edp[1].tolist()
    checks = [dd.check_ntc(one, SITE) for one in (wall, chain)]
    values = [[(row.quantity, row.value) for row in one.rows if row.method == "mechanism"] for one in checks]
    assert values[0] == values[1]
    assert wall.base_hinge_depth == pytest.approx(25e3 / (2.0 * 0.85 * 1.5e6), rel=1e-14)


def test_the_hinge_is_where_the_multiplier_is_least():
    wall = band()
    alpha = dd.check_ntc(wall, SITE).value("mechanism", "", "alpha_0")
    assert alpha == pytest.approx(multiplier(wall.hinge_x, wall), rel=1e-12)
    places = np.linspace(0.01, 4.99, 4999)
    least = min(multiplier(at, wall) for at in places)
    assert alpha <= least * (1.0 + 1e-12)
    # Pushes in any order are the same wall.
    turned = band(push=[300.0, 400.0], push_x=[3.2, 1.5])
    assert turned.hinge_x == wall.hinge_x
    assert turned.trigger_acceleration == pytest.approx(wall.trigger_acceleration, rel=1e-14)
    # The place is kept until another is asked for.
    assert dataclasses.replace(wall, push=[400.0, 4e3]).hinge_x == wall.hinge_x
    assert dataclasses.replace(wall, push=[400.0, 4e3], hinge_x=None).hinge_x > wall.hinge_x


def test_ends_move_with_one_level():
    """On a building it leans on nothing: both ends move alike, and the motion is that of its level."""
    house = dd.Building(period=0.3, storeys=3, level=8.5, building_height=9.0)
    wall = band(building=house)
    assert (wall.support_share, wall.support_tilt) == (0.0, 0.0)
    record = dd.example_records()[0]
    felt = wall._felt(record.acceleration, None, record.dt, "wall")
    parapet = dd.OneSidedWall(1.0, 0.4, building=dataclasses.replace(house, level=8.5))
    below = parapet._felt(record.acceleration, None, record.dt, "base")
    np.testing.assert_array_equal(felt[0], below[0])


def test_certified():
    """The chain is sampled again in 33 digits, with the same place of the hinge."""
    records = dd.synthetic_records(6.5, 10.0, "shallow", n_records=2)
    stripes = dd.multiple_stripe(band(), records, (0.5, 1.2), certify=True, progress=False)
    assert (stripes.status <= dd.results.Certified.QUADRUPLE).all()


CASE = """&job output = 'out/band' /
&wall
   name = 'top', mechanism = 'horizontal', length = 5.0, thickness = 0.45, density = 1900, end_thrust = 25e3
   compressive_strength = 1.5e6, push = 400, 300, push_x = 1.5, 3.2, sides = 1, restitution_value = 0.7
/
&records catalogue = '{root}/data/records/synthetic44.csv', polarity = 'both' /
&stripes levels = 0.4, 0.6, 0.8, 1.0 /
&check ag = 0.104, 0.261, 0.334, f0 = 2.332, 2.364, 2.4, tc_star = 0.281, 0.347, 0.364, soil = 'B' /
"""


@pytest.fixture(scope="module")
def stored(executable, root, tmp_path_factory):
    folder = tmp_path_factory.mktemp("band")
    (folder / "case.nml").write_text(CASE.format(root=root))
    subprocess.run([executable, "--quiet", "case.nml"], cwd=folder, check=True)
    return dd.read_results(folder / "out/band")


def test_a_case_is_the_wall(stored):
    wall = stored.stripes.wall
    assert type(wall) is dd.HorizontalBending
    assert wall._properties() == band(name="top")._properties()
    assert wall._statics == band()._statics


def test_tables_of_walls(executable, root, tmp_path):
    """A mechanism a row: geometry stands in columns, beside walls that have a height."""
    (tmp_path / "walls.csv").write_text(
        "name,mechanism,height,length,thickness,density,end_thrust,hinge_depth,push1,push1_x,sides,restitution_value\n"
        "a,horizontal,,5.0,0.45,1900,25e3,0.01,400,1.5,1,0.7\n"
        "b,one_sided,3.0,,0.4,1900,,,,,,\n"
        "c,horizontal,,4.0,0.45,1900,20e3,0.02,,,2,0.7\n"
    )
    (tmp_path / "case.nml").write_text(
        "&job task = 'typology', output = 'out/walls' /\n&population file = 'walls.csv' /\n"
        f"&records catalogue = '{root}/data/records/synthetic44.csv' /\n&stripes levels = 0.4, 0.8, 1.2 /\n"
    )
    subprocess.run([executable, "--quiet", "case.nml"], cwd=tmp_path, check=True)
    walls = dd.read_results(tmp_path / "out/walls").population.walls
    assert [wall.mechanism for wall in walls] == ["horizontal", "one_sided", "horizontal"]
    alone = band(hinge_depth=0.01, compressive_strength=None, push=[400.0], push_x=[1.5])
    assert walls[0]._statics == alone._statics
    assert walls[2].hinge_x == 2.0


def test_it_is_checked_and_told(executable, root, tmp_path):
    (tmp_path / "case.nml").write_text(CASE.format(root=root))
    said = subprocess.run(
        [executable, "--check", "case.nml"], cwd=tmp_path, capture_output=True, text=True, check=True
    ).stdout
    place = band().hinge_x
    assert f"leaves:   {place:.4g}" in said
    assert "of a band of 1 m height; the hinge between them is where alpha_0 is least" in said
    assert "m behind the faces, of crushed masonry" in said


@pytest.mark.parametrize("lang", ["en", "it"])
def test_reports(stored, lang, tmp_path):
    dd.report(stored, tmp_path / "report.html", lang=lang)
    left = dd.calculation_report(stored, tmp_path / "pages.html", lang=lang)
    text = (tmp_path / "pages.html").read_text(encoding="utf-8")
    assert "end_thrust" in left
    assert "chain_hinges" not in left
    words = {
        "en": ("horizontal bending", "an arch of two leaves in its thickness", "places along the wall"),
        "it": ("flessione orizzontale", "un arco di due tratti nel suo spessore", "posizioni lungo la parete"),
    }[lang]
    for word in words:
        assert word in text


def test_drawing():
    ax = band().plot(rotation=0.05)
    assert ax.get_xlabel() == "x [m]"
    assert len(ax.patches) >= 4


@pytest.mark.parametrize(
    ("more", "sentence"),
    [
        ({"length": None}, "length: must be given with mechanism = 'horizontal', between the transverse walls"),
        ({"end_thrust": None}, "end_thrust: must be given with mechanism = 'horizontal', which nothing else holds"),
        ({"compressive_strength": None}, "hinge_depth: must be given with mechanism = 'horizontal', or compressive"),
        ({"hinge_depth": 0.02}, "give either hinge_depth or compressive_strength"),
        ({"height": 3.0}, "height = 3: must be 5, the length; leave it out"),
        ({"push_x": [1.5, 5.0]}, "push_x = 5: must lie within the length of 5 m"),
        ({"push_x": [1.5]}, "push_x = 1.5: is one value for 2 values of push"),
        ({"push": None}, "push_x: only with push"),
        ({"push": [-1.0, 1.0]}, "push = -1"),
        ({"hinge_x": 5.0}, "hinge_x = 5: must lie within the length of 5 m"),
        ({"end_thrust": 1e6}, "puts the hinge at depth 0.3922 m, must be less deep than half of the thickness"),
        ({"sides": None}, "sides: must be given with mechanism = 'horizontal'"),
        ({"push": [4e4, 4e4]}, "moment: is "),
        ({"sides": 2, "push": [4e3, 4e3]}, "sides = 2: outwards and inwards differ"),
        ({"restitution_value": None}, "restitution_value: must be given, the mechanism has no model"),
    ],
)
def test_messages(more, sentence):
    with pytest.raises(dd.errors.InputError) as caught:
        band(**more)
    assert sentence in str(caught.value)
    assert "\n" not in str(caught.value)


def test_nothing_holds_it_but_its_thrust():
    """The multiplier is proportional to the thrust, and has no part of gravity."""
    given = {"hinge_depth": 0.01, "compressive_strength": None, "push": None, "push_x": None}
    one, two = (band(**given, end_thrust=thrust).trigger_acceleration for thrust in (10e3, 20e3))
    assert two == pytest.approx(2.0 * one, rel=1e-13)
    assert math.isclose(band(**given, gravity=1.62).trigger_acceleration, band(**given).trigger_acceleration)
