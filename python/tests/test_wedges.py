"""Wedges of transverse walls: values of an independent program in 30 digits, a wall without them, hinges, refusals."""

from __future__ import annotations

from dataclasses import replace

import matplotlib
import numpy as np
import pytest

import dondolo as dd
from dondolo.walls.shape import shape, wedges

matplotlib.use("Agg")

SITE = dd.Site(0.2, 2.5, 0.35)
WEDGE = dd.Wedge(thickness=0.45, angle=20.0, bottom=0.0, top=7.0, length=9.0)
# Length of the facade [m]: the values below are of the whole facade
LENGTH = 6.0
TERMS = ("inertia", "excitation_lever", "restoring_moment", "load_force")


def facade(**more):
    """Two wedges of 45 cm, two loads that go with the wall, a thrust."""
    given = {
        "density": 1900.0,
        "hinge_depth": 0.02,
        "facade_length": LENGTH,
        "wedges": [WEDGE, WEDGE],
        "loads": [
            dd.Load(8e3, depth=0.40, height=3.5, inertia="both"),
            dd.Load(4e3, depth=0.35, height=7.0, inertia="both"),
        ],
        "thrusts": [dd.Thrust(250.0, depth=0.35, height=7.0)],
    }
    return dd.OneSidedWall(7.0, 0.55, **given | more)


def bare(**more):
    return facade(facade_length=None, wedges=[], **more)


def pulses(amplitude, period, cycles):
    """Sine pulses with samples every 0.01 s, then half a minute of rest."""
    time = np.arange(round(cycles * period / 0.01) + 1) * 0.01
    shaking = -amplitude * np.sin(2.0 * np.pi * time / period)
    return dd.Record(np.concatenate([shaking, np.zeros(3000)]), 0.01, name="pulses")


def test_terms():
    wall = facade()
    assert wall.capacity_angle == pytest.approx(0.1298069200437978, rel=1e-13)
    assert wall.restitution_coefficient == pytest.approx(0.5581665833684304, rel=1e-13)
    terms = wall.terms([0.0, 0.02, 0.04, 0.06])
    assert LENGTH * terms.inertia == pytest.approx(np.full(4, 1309716.208509633), rel=1e-13)
    levers = [259025.5850273791, 259671.5424657686, 260213.6347494128, 260651.6450486261]
    assert LENGTH * terms.excitation_lever == pytest.approx(levers, rel=1e-13)
    moments = [331774.5042627726, 280880.8204382273, 229874.7880305344, 178776.8087725856]
    assert LENGTH * (terms.restoring_moment - terms.load_force) == pytest.approx(moments, rel=1e-13)


def test_check():
    check = dd.check_ntc(facade(), SITE)
    expected = {
        "alpha_0": 0.1305663724762879,
        "mass": 64878.97578721274 / LENGTH,
        "mass_ratio": 0.9759468224157812,
        "a_0": 1.312424083539567 / check.value("mechanism", "", "knowledge_factor"),
        "d_0": 0.5167925042373393,
    }
    for name, value in expected.items():
        assert check.value("mechanism", "", name) == pytest.approx(value, rel=1e-13), name
    # The facade without its wedges stands beside it, as a wall of its own
    alone = dd.check_ntc(bare(), SITE)
    assert check.value("mechanism", "", "bare_alpha_0") == pytest.approx(
        alone.value("mechanism", "", "alpha_0"), rel=1e-13
    )
    assert [row.quantity for row in alone.rows if row.quantity == "bare_alpha_0"] == []
    assert [item.item for item in check.items] == [
        *("section 1", "wedge 1", "wedge 2", "masonry", "load 1", "load 2", "thrust 1")
    ]


@pytest.mark.parametrize("engine", ["rk45", "lanes"])
def test_history(engine):
    wall = facade()
    found = dd.simulate(wall, pulses(3.0, 1.0, 2), solver=dd.Solver(engine=engine, rtol=1e-12, atol=1e-14))
    assert found.edp * wall.capacity_angle == pytest.approx(0.1035798273192243, abs=1e-11)


def test_supports():
    building = dd.Building(0.3, storeys=2, level=0.0, building_height=7.0)
    wall = facade(building=building)
    assert wall.support_share == pytest.approx(0.7223314078476, rel=1e-12)
    assert wall.support_tilt == pytest.approx(1.401701572591, rel=1e-12)


def test_long_wedges_ask_for_a_restitution():
    """Where the model of impacts would have the wall not bounce at all, as for corners."""
    long = replace(WEDGE, angle=60.0, length=20.0)
    with pytest.raises(dd.errors.InputError, match=r"restitution_value: must be given, .* must be more than 0"):
        facade(wedges=[long, long])
    assert facade(wedges=[long, long], restitution_value=0.3).restitution_coefficient == 0.3


@pytest.mark.parametrize("loaded", [True, False])
def test_an_angle_of_0_is_no_wedge(loaded):
    """To the bit, the impacts and their default model too."""
    none = replace(WEDGE, angle=0.0)
    if loaded:
        one, other = facade(wedges=[none, none]), bare()
    else:
        one, other = dd.OneSidedWall(7.0, 0.55, facade_length=6.0, wedges=[none]), dd.OneSidedWall(7.0, 0.55)
    rotations = np.linspace(0.0, 0.1, 11)
    for name in TERMS:
        assert np.array_equal(getattr(one.terms(rotations), name), getattr(other.terms(rotations), name)), name
    assert (one.capacity_angle, one.restitution_coefficient) == (other.capacity_angle, other.restitution_coefficient)
    shaken = [dd.simulate(wall, pulses(2.0, 1.0, 2)).edp for wall in (one, other)]
    assert shaken[0] == shaken[1] > 0.0


def test_a_wall_given_by_its_body():
    """The same body by its numbers, whose mean density is no reason for a warning; and no wedges beside them."""
    wall = facade()
    mass, inertia = 59138.53296458255 / LENGTH, 257040.2571467526 / LENGTH
    depth, height = 0.564885020391734, 3.800818336768694
    body = {
        "mass": mass,
        "centroid_depth": depth,
        "centroid_height": height,
        "hinge_inertia": inertia + mass * ((depth - 0.02) ** 2 + height**2),
    }
    same = bare(**body, density=None)
    rotations = np.linspace(0.0, 0.1, 6)
    for name in TERMS:
        assert getattr(same.terms(rotations), name) == pytest.approx(getattr(wall.terms(rotations), name), rel=1e-12)
    with pytest.raises(dd.errors.InputError, match="not with mass"):
        facade(**body, density=None)


def test_no_false_warning_of_a_density(run, root, tmp_path):
    """A body of 59 t beside a section of 7 x 0.55 m has no density of 15360 kg/m3."""
    case = tmp_path / "case.nml"
    body = "mass = 59138.5, centroid_depth = 0.565, centroid_height = 3.8, hinge_inertia = 1.2e6"
    case.write_text(
        f"&wall mechanism = 'one_sided', height = 7.0, thickness = 0.55, {body} /\n"
        f"&records catalogue = '{root}/data/records/synthetic44.csv' /\n&stripes levels = 0.2, 0.4 /\n"
    )
    found = run("--check", case)
    assert found.returncode == 0
    assert "density" not in found.stderr


def test_hinge_levels():
    """Above a hinge cracks begin at the hinge, or where they begin above it; a hinge above all wedges leaves none."""
    storeys = [dd.Section(3.6, 0.55), dd.Section(3.4, 0.45)]
    high = replace(WEDGE, bottom=5.0)
    whole = dd.OneSidedWall(sections=storeys, facade_length=6.0, wedges=[WEDGE, high], hinge_level=3.6)
    above = dd.OneSidedWall(
        3.4, 0.45, facade_length=6.0, wedges=[replace(WEDGE, top=3.4), replace(high, bottom=1.4, top=3.4)]
    )
    assert whole.capacity_angle == pytest.approx(above.capacity_angle, rel=1e-14)
    low = replace(WEDGE, top=3.6)
    assert dd.OneSidedWall(sections=storeys, facade_length=6.0, wedges=[low], hinge_level=3.6).wedges == ()
    hinges = dd.Population.of_facade(dd.OneSidedWall(sections=storeys, facade_length=6.0, wedges=[WEDGE]))
    assert [wall.wedges[0].top for wall in hinges] == pytest.approx([7.0, 3.4])


def test_length_and_storeys():
    """Weight and moment of a wedge that an opening cuts off, over two storeys, by quadrature of thin slices."""
    storeys = [dd.Section(3.6, 0.55, offset=0.0), dd.Section(3.4, 0.45, offset=0.05)]
    cut = replace(WEDGE, bottom=1.0, top=6.5, length=1.1)
    wall = dd.OneSidedWall(sections=storeys, density=1900.0, facade_length=6.0, wedges=[cut])
    alone = dd.OneSidedWall(sections=storeys, density=1900.0)
    edges = np.linspace(1.0, 6.5, 220_001)
    z = 0.5 * (edges[1:] + edges[:-1])
    reach = np.minimum((z - 1.0) * np.tan(np.radians(20.0)), 1.1)
    mass = 1900.0 * 0.45 / 6.0 * reach * np.diff(edges)
    depth = np.where(z < 3.6, 0.55, 0.5) + 0.5 * reach
    more = {name: getattr(wall.terms(0.0), name) - getattr(alone.terms(0.0), name) for name in TERMS}
    assert more["excitation_lever"] == pytest.approx(np.sum(mass * z), rel=1e-8)
    assert more["restoring_moment"] == pytest.approx(wall.gravity * np.sum(mass * depth), rel=1e-8)
    assert more["inertia"] == pytest.approx(np.sum(mass * (z**2 + depth**2 + reach**2 / 12.0)), rel=1e-8)


def test_loads_behind_the_wall():
    """A load may stand on a wedge, not behind it."""
    load = dd.Load(1e3, depth=3.0, height=7.0, inertia="both")
    assert facade(loads=[load]).capacity_angle > facade(loads=[]).capacity_angle
    with pytest.raises(dd.errors.InputError, match=r"depth = 1\.9: must lie between 0 and 1\.824 m"):
        facade(loads=[replace(load, depth=1.9, height=3.5)])
    with pytest.raises(dd.errors.InputError, match=r"depth = 3: must lie between 0 and 0\.55 m"):
        bare(loads=[load])


@pytest.mark.parametrize(
    ("more", "match"),
    [
        (
            {"facade_length": None},
            "facade_length: must be given with wedges of transverse walls or an elevation, and only",
        ),
        ({"wedges": []}, "facade_length: must be given with wedges of transverse walls or an elevation, and only"),
        ({"facade_length": 0.9}, r"0\.9 m in all, must be less than facade_length = 0\.9"),
        ({"wedges": [replace(WEDGE, top=7.5)]}, r"wedges\[0\]\.top = 7\.5: must be at most 7 m, the height"),
        (
            {"wedges": [WEDGE, replace(WEDGE, bottom=4.0, top=3.0)]},
            r"wedges\[1\]\.top = 3: must be above its bottom",
        ),
        ({"wedges": [replace(WEDGE, angle=90.0)]}, r"wedges\[0\]\.angle = 90: must lie between 0 and 80"),
        ({"interlock": dd.Interlock(overlap=0.1, course=0.1, thickness=0.3, spacing=5.0)}, "not with overlap"),
        ({"free": True}, "it is no free element"),
        ({"restitution": "sorrentino"}, "must be one of 'default', 'impulse'"),
        ({"hinge_depth": 0.3}, r"less deep than half the thickness of the facade, 0\.275 m"),
        ({"thrusts": [dd.Thrust(5e4, height=7.0)]}, "not stable at rest"),
    ],
)
def test_refusals(more, match):
    with pytest.raises(dd.errors.InputError, match=match) as refused:
        facade(**more)
    assert "\n" not in str(refused.value)


def test_other_mechanisms():
    with pytest.raises((dd.errors.InputError, TypeError)):
        dd.FreeStandingWall(3.0, 0.25, wedges=[WEDGE])


def test_an_angle_is_an_uncertain_property(records, root, run, tmp_path):
    """One angle for all wedges: the larger, the stronger; by Python and by the executable."""
    wall = facade()
    levels = [0.2, 0.4, 0.6, 0.9, 1.3, 2.0, 3.0]
    sources = {"wedge_angle": dd.distributions.Uniform(10.0, 30.0)}
    found = dd.propagate_uncertainty(wall, records, levels, sources=sources, n_variants=12, progress=False)
    angles = [one.wedges[0].angle for one in found.sample]
    assert all(one.wedges[0].angle == one.wedges[1].angle for one in found.sample)
    assert min(angles) < 12.0 < 28.0 < max(angles)
    ordered = sorted(found.sample, key=lambda one: one.wedges[0].angle)
    assert np.all(np.diff([one.trigger_acceleration for one in ordered]) > 0.0)
    with pytest.raises(dd.errors.InputError, match="must be one of"):
        dd.propagate_uncertainty(bare(), records, levels, sources=sources, n_variants=12, progress=False)
    case = tmp_path / "case.nml"
    case.write_text(
        f"&job task = 'typology' output = '{tmp_path}/out' /\n&wall mechanism = 'one_sided', height = 7.0, "
        "thickness = 0.55, facade_length = 6.0, wedge_thickness = 0.45, 0.45, wedge_angle = 20.0, wedge_bottom = 0.0, "
        "wedge_top = 7.0, wedge_length = 9.0 /\n&uncertainty variants = 12, wedge_angle = 'uniform(10.0, 30.0)' /\n"
        f"&records catalogue = '{root}/data/records/synthetic44.csv' /\n"
        "&stripes levels = 0.2, 0.4, 0.6, 0.9, 1.3, 2.0, 3.0 /\n"
    )
    assert run(case).returncode == 0
    walls = dd.read_results(tmp_path / "out").typology.walls
    assert {len({wedge.angle for wedge in one.wedges}) for one in walls} == {1}
    assert len({one.wedges[0].angle for one in walls}) > 12


def test_drawing():
    wall = facade()
    (wedge,) = wedges(wall)
    corners = np.array([(0.0, 0.0), (0.0, 7.0), (-7.0 * np.tan(np.radians(20.0)), 7.0), (0.0, 0.0)])
    assert wedge == pytest.approx(corners, abs=1e-14)
    turned = shape(wall, 0.1)
    assert [len(block) for block in turned.blocks] == [4, 4]
    axes = wall.plot(rotation=0.1)
    assert axes.get_xlim()[0] < -2.6
