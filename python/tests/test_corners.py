"""Corners: values of an independent program in 30 digits, thin slices, hinges, refusals, and every route to them."""

from __future__ import annotations

import re
from dataclasses import replace
from html import unescape

import matplotlib
import numpy as np
import pytest

import dondolo as dd
from dondolo.walls.shape import shape, wedges
from dondolo.walls.wall import notes_on_supports

matplotlib.use("Agg")

SITE = dd.Site(0.2, 2.5, 0.35)
RAFTER = dd.Load(total=6e3, depth=0.45, height=3.2, inertia="both")
PUSH = dd.Thrust(total=2e3, depth=0.4, height=3.2)
TERMS = ("inertia", "excitation_lever", "restoring_moment", "load_force")


def corner(**more):
    """Walls of half a metre under a hip rafter that pushes."""
    given = {"density": 1900.0, "hinge_depth": 0.03, "wing_angle": 30.0, "loads": [RAFTER], "thrusts": [PUSH]}
    return dd.Corner(3.2, 0.5, **given | more)


def pulses(amplitude, period, cycles):
    """Sine pulses with samples every 0.01 s, then half a minute of rest."""
    time = np.arange(round(cycles * period / 0.01) + 1) * 0.01
    shaking = -amplitude * np.sin(2.0 * np.pi * time / period)
    return dd.Record(np.concatenate([shaking, np.zeros(3000)]), 0.01, name="pulses")


def test_terms():
    wall = corner()
    assert wall.capacity_angle == pytest.approx(0.3146202024143832, rel=1e-13)
    assert wall.restitution_coefficient == pytest.approx(0.6348743655272488, rel=1e-13)
    terms = wall.terms([0.0, 0.02, 0.04, 0.06])
    assert terms.inertia == pytest.approx(np.full(4, 46015.67083560998), rel=1e-13)
    levers = [16370.97517085276, 16487.78387654486, 16597.99768852053, 16701.57252272447]
    assert terms.excitation_lever == pytest.approx(levers, rel=1e-13)
    moments = [52504.53616439967, 49267.46539339062, 46010.68829311499, 42735.50753098978]
    assert terms.restoring_moment - terms.load_force == pytest.approx(moments, rel=1e-13)


def test_check():
    check = dd.check_ntc(corner(), SITE)
    expected = {
        "alpha_0": 0.3269288666929932,
        "mass": 7576.204550631349,
        "mass_ratio": 0.9778164952251560,
        "a_0": 3.279932582360217 / check.value("mechanism", "", "knowledge_factor"),
        "d_0": 0.6686838552012641,
    }
    for name, value in expected.items():
        assert check.value("mechanism", "", name) == pytest.approx(value, rel=1e-13), name
    # The corner without its wings stands beside it, as one of its own
    alone = dd.check_ntc(corner(wing_angle=0.0), SITE)
    bare = check.value("mechanism", "", "bare_alpha_0")
    assert bare == pytest.approx(alone.value("mechanism", "", "alpha_0"), rel=1e-13)
    assert all(row.quantity != "bare_alpha_0" for row in alone.rows)
    names = ["corner 1", "wing 1", "wing 2", "masonry", "load 1", "thrust 1"]
    assert [item.item for item in check.items] == names
    assert [item.item for item in alone.items] == [name for name in names if "wing" not in name]
    # Whole, not per metre
    assert {row.unit for row in check.rows if row.quantity == "mass"} == {"kg"}
    assert not any(row.unit.endswith("/m") for row in check.rows)
    square, one, other, whole, rafter, push = check.items
    assert square.force == pytest.approx(1900.0 * 0.5**2 * 3.2 * 9.81, rel=1e-14)
    np.testing.assert_array_equal(one[1:], other[1:])
    assert square.force + 2.0 * one.force == pytest.approx(7136.463418676679 * 9.81, rel=1e-13)
    assert (whole.depth, whole.lever) == pytest.approx((0.8353932042949779, 2.019738318673118), rel=1e-13)
    assert (rafter.force, push.force) == (6e3, 2e3)


@pytest.mark.parametrize("engine", ["rk45", "lanes"])
def test_history(engine):
    wall = corner()
    found = dd.simulate(wall, pulses(7.0, 0.7, 2), solver=dd.Solver(engine=engine, rtol=1e-12, atol=1e-14))
    assert found.edp * wall.capacity_angle == pytest.approx(0.1862748597311918, abs=1e-11)


def test_supports():
    wall = corner(building=dd.Building(0.3, storeys=1, level=0.0, building_height=3.2))
    assert wall.support_share == pytest.approx(0.8783775545473, rel=1e-12)
    assert wall.support_tilt == pytest.approx(3.079750609354, rel=1e-12)


def test_a_body_given_by_its_numbers():
    """The same solid as a wall of 1 m whose numbers are given: 13 digits of another program."""
    mass, inertia = 7136.463418676679, 5903.577167197559
    depth, height = 0.8353932042949779, 2.019738318673118
    same = dd.OneSidedWall(
        3.2,
        1.8,
        mass=mass,
        centroid_depth=depth,
        centroid_height=height,
        hinge_inertia=inertia + mass * ((depth - 0.03) ** 2 + height**2),
        hinge_depth=0.03,
        loads=[dd.Load(6e3, depth=0.45, height=3.2, inertia="both")],
        thrusts=[dd.Thrust(2e3, depth=0.4, height=3.2)],
    )
    rotations = np.linspace(0.0, 0.3, 7)
    for name in TERMS:
        found, expected = (getattr(wall.terms(rotations), name) for wall in (corner(), same))
        assert found == pytest.approx(expected, rel=1e-12), name


@pytest.mark.parametrize(("length", "angle"), [(None, 25.0), (0.8, 25.0), (0.3, 60.0), (9.0, 5.0)])
def test_thin_slices(length, angle):
    """The three parts of the plan, in thin slices of the height."""
    t, h, u, density = 0.45, 2.8, 0.02, 1700.0
    wall = dd.Corner(h, t, density=density, hinge_depth=u, wing_angle=angle, wing_length=length)
    edges = np.linspace(0.0, h, 200_001)
    z = 0.5 * (edges[1:] + edges[:-1])
    w = np.minimum(z * np.tan(np.radians(angle)), np.inf if length is None else length)
    inertia, first, moment = 0.0, 0.0, 0.0
    # The square, and the wing along each axis: sizes and centres in plan
    for size, centre in (
        ((t + 0.0 * w, t + 0.0 * w), (0.5 * t + 0.0 * w, 0.5 * t + 0.0 * w)),
        ((w, t + 0.0 * w), (t + 0.5 * w, 0.5 * t + 0.0 * w)),
        ((t + 0.0 * w, w), (0.5 * t + 0.0 * w, t + 0.5 * w)),
    ):
        mass = density * size[0] * size[1] * np.diff(edges)
        e = (centre[0] + centre[1]) / np.sqrt(2.0) - u
        # About the centre of a rectangle, along the bisector
        own = (size[0] ** 2 + size[1] ** 2) / 24.0
        inertia += np.sum(mass * (e**2 + own + z**2))
        first += np.sum(mass * z)
        moment += np.sum(mass * e)
    terms = wall.terms(0.0)
    assert terms.inertia == pytest.approx(inertia, rel=1e-8)
    assert terms.excitation_lever == pytest.approx(first, rel=1e-8)
    assert terms.restoring_moment == pytest.approx(wall.gravity * moment, rel=1e-8)


def test_hinge_levels():
    """Cracks begin at the hinge; what is loaded below it is left out."""
    low = dd.Load(total=3e3, depth=0.4, height=1.8, inertia="both")
    high = [replace(RAFTER, height=5.0)]
    whole = dd.Corner(5.0, 0.5, wing_angle=20.0, wing_length=0.6, hinge_depth=0.03, loads=[low, *high], hinge_level=1.8)
    above = dd.Corner(3.2, 0.5, wing_angle=20.0, wing_length=0.6, hinge_depth=0.03, loads=[RAFTER])
    assert whole.capacity_angle == pytest.approx(above.capacity_angle, rel=1e-14)
    assert (whole.height, len(whole.loads)) == (pytest.approx(3.2), 1)
    uncut = dd.Corner(5.0, 0.5, wing_angle=20.0, wing_length=0.6, hinge_depth=0.03, loads=[low, *high])
    hinges = dd.Population.of_facade(uncut, hinge_level=[0.0, 1.8])
    assert [wall.height for wall in hinges] == pytest.approx([5.0, 3.2])
    assert hinges[1].capacity_angle == whole.capacity_angle
    with pytest.raises(dd.errors.InputError, match="only with sections"):
        dd.Population.of_facade(uncut)


def test_crushed_masonry():
    """A triangle on the bisector, a deep and 2 a wide, whose centroid is the hinge."""
    strength = 3e6
    wall = corner(hinge_depth=None, compressive_strength=strength)
    weight = 7136.463418676679 * 9.81 + 6e3
    side = np.sqrt(weight / (0.85 * strength))
    assert wall.base_hinge_depth == pytest.approx(2.0 / 3.0 * side, rel=1e-12)
    assert corner(hinge_depth=wall.base_hinge_depth).capacity_angle == pytest.approx(wall.capacity_angle, rel=1e-12)
    half = corner(hinge_depth=None, compressive_strength=strength, stress_block=0.425)
    assert half.base_hinge_depth == pytest.approx(np.sqrt(2.0) * wall.base_hinge_depth, rel=1e-12)
    # Up to half of the square the triangle is one
    least = weight / 0.85 / (0.5 * 0.5**2)
    corner(hinge_depth=None, compressive_strength=1.001 * least)
    with pytest.raises(dd.errors.InputError, match="a third of the diagonal of the base"):
        corner(hinge_depth=None, compressive_strength=0.999 * least)


@pytest.mark.parametrize(
    ("more", "match"),
    [
        ({"wing_angle": None}, "wing_angle: must be given with mechanism = 'corner'"),
        ({"wing_angle": 90.0}, "wing_angle = 90: must lie between 0 and 80"),
        ({"hinge_depth": None}, "hinge_depth: must be given and positive"),
        ({"hinge_depth": 0.0}, "hinge_depth: must be given and positive"),
        ({"hinge_depth": 0.24}, r"less deep than a third of the diagonal of the base, 0\.2357 m"),
        ({"wing_angle": 60.0}, r"restitution_value: must be given, .* as -0\.\d+, it must be more than 0"),
        ({"restitution": "sorrentino"}, "must be one of 'default', 'impulse'"),
        ({"thrusts": [replace(PUSH, total=5e4)]}, "not stable at rest; its weights resist with .* N m, thrusts"),
        (
            {"loads": [replace(RAFTER, depth=3.0)]},
            r"depth = 3: must lie between 0 and 2\.014 m, the outer edge and the ends of the wings",
        ),
        ({"loads": [replace(RAFTER, depth=0.01)]}, r"must be less deep than loads\[0\]\.depth = 0\.01"),
        ({"loads": [replace(RAFTER, inertia=None)]}, "must be given"),
        ({"loads": [dd.Load(6e3, depth=0.45, height=3.2, inertia="both")]}, "only for mechanism = 'one_sided'"),
    ],
)
def test_refusals(more, match):
    with pytest.raises(dd.errors.InputError, match=match):
        corner(**more)


def test_wide_wings_need_a_restitution():
    assert corner(wing_angle=60.0, restitution_value=0.3).restitution_coefficient == 0.3


def test_loads_of_walls_are_per_metre():
    with pytest.raises(dd.errors.InputError, match="only for mechanism = 'corner'"):
        dd.OneSidedWall(3.0, 0.25, loads=[dd.Load(total=6e3, depth=0.1, height=3.0, inertia="both")])
    with pytest.raises(dd.errors.InputError, match="only for mechanism = 'one_sided'"):
        corner(ties=[dd.Tie(3.0, area=5e-5, length=6.0)])
    with pytest.raises(dd.errors.InputError, match="only for mechanism = 'corner'"):
        dd.OneSidedWall(3.0, 0.25, ties=[dd.Tie(2.8, area=5e-5, length=6.0, anchor_total=1e3)])


BAR = dd.Tie(3.0, bar=0.016, length=6.0, strength=2e8, preload=1e7, strain=0.01, anchor_total=60e3)


def as_chain(*ties):
    """The corner as one rigid body in the plane of its bisector, with a tie there."""
    wall = corner()
    body = dd.Body([dd.GivenMass(7136.463418676679, (-0.8353932042949779, 2.019738318673118), 5903.577167197559)])
    actions = [dd.PointLoad(1, (-0.45, 3.2), 6e3, inertia="both"), dd.PointThrust(1, (-0.4, 3.2), 2e3)]
    return dd.Chain(
        height=3.2, sides=1, restitution_value=wall.restitution_coefficient, bodies=[body],
        joints=[dd.Pin(1, 0, (-0.03, 0.0))], actions=actions, ties=ties,
    )  # fmt: skip


@pytest.mark.parametrize("engine", ["rk45", "lanes"])
def test_ties(engine):
    """Each along one wall: stretched by 1/sqrt 2 of the way on the bisector, where it has 1/sqrt 2 of its force."""
    wall = corner(ties=[BAR, replace(BAR, height=2.0, depth=0.2, preload=0.0)])
    area, root = 0.25 * np.pi * 0.016**2, np.sqrt(2.0)
    share = {"strength": 2e8, "strain": 0.01, "anchor_force": 60e3 / root}
    chain = as_chain(
        dd.PointTie(1, (0.0, 3.0), area=area / root, length=6.0 * root, preload=1e7, **share),
        dd.PointTie(1, (-0.2, 2.0), area=area / root, length=6.0 * root, **share),
    )
    q = np.linspace(0.0, 0.28, 8)
    for one, other in zip(wall.terms(q), chain.terms(q), strict=True):
        np.testing.assert_allclose(one, other, rtol=0.0, atol=1e-12 * chain.terms(0.0).inertia)
    # By hand: the elastic forces of both at a rotation
    at = 0.002
    way = 2.97 * 0.0 + 3.0 * np.sin(at) - 0.03 * (1.0 - np.cos(at))
    bare = corner().terms(at).load_force
    stiffness = 2.06e11 * area / 6.0
    one = (1e7 * area + stiffness * way / root) / root * (3.0 * np.cos(at) - 0.03 * np.sin(at))
    far = 2.0 * np.sin(at) + 0.17 * (1.0 - np.cos(at))
    two = stiffness * far / root / root * (2.0 * np.cos(at) + 0.17 * np.sin(at))
    assert bare - wall.terms(at).load_force == pytest.approx(one + two, rel=1e-12)
    motions, solver = dd.synthetic_records(6.5, 10.0, "shallow", n_records=6), dd.Solver(engine=engine, rtol=1e-10)
    found, expected = (
        dd.multiple_stripe(each, motions, (0.6, 1.0, 1.6), solver=solver, progress=False) for each in (wall, chain)
    )
    np.testing.assert_allclose(found.edp, expected.edp, rtol=0.0, atol=1e-8)
    assert found.broken_ties.tolist() == expected.broken_ties.tolist()


def test_check_of_ties(tmp_path):
    check = dd.check_ntc(corner(ties=[BAR]), SITE)
    bare = dd.check_ntc(corner(), SITE)
    force = 2e8 * 0.25 * np.pi * 0.016**2
    (item,) = [one for one in check.items if one.item == "tie 1"]
    assert item.force == pytest.approx(force / np.sqrt(2.0), rel=1e-13)
    assert item.lever == pytest.approx(3.0, rel=1e-13)
    first = sum(one.force_lever for one in bare.items if one.item in ("corner 1", "wing 1", "wing 2", "load 1"))
    grown = check.value("mechanism", "", "alpha_0") - bare.value("mechanism", "", "alpha_0")
    assert grown == pytest.approx(item.force * 3.0 / first, rel=1e-12)
    assert check.value("tie", "", "bar_force_per_m", item="tie 1") == pytest.approx(force, rel=1e-13)
    assert not any(row.unit.endswith("/m") for row in check.rows)
    brittle = dd.check_ntc(corner(ties=[replace(BAR, anchor_total=30e3)]), SITE)
    notes = [note for note in brittle.notes if note.code == "anchor_before_bar"]
    assert ["N/m" in str(note) for note in notes] == [False]
    with pytest.raises(dd.errors.InputError, match="must be positive for each tie of a corner"):
        corner(ties=[replace(BAR, bar=0.0)])


def test_case_and_tables(root, run, tmp_path):
    """The executable, tables of walls and Python have the same corner, which no value makes doubtful."""
    line = "corner, 3.2, 0.5, 1900, 0.03, 30, 6e3, 0.45, 3.2, both, 2e3, 0.4, 3.2"
    names = (
        "mechanism, height, thickness, density, hinge_depth, wing_angle, load1_total, load1_depth, load1_height,"
        " load1_inertia, thrust1_total, thrust1_depth, thrust1_height"
    )
    table = tmp_path / "walls.csv"
    table.write_text(f"name, {names}\nc, {line}\n".replace(" ", ""))
    (read,) = dd.Population.from_csv(table)
    assert isinstance(read, dd.Corner)
    assert (read.loads, read.thrusts) == (corner().loads, corner().thrusts)
    assert read.capacity_angle == corner().capacity_angle
    frame = dd.Population([read]).to_frame()
    assert frame["load1_total_n"].tolist() == [6e3]
    case = tmp_path / "case.nml"
    case.write_text(
        f"&job task = 'stripes' output = '{tmp_path}/out' /\n&wall mechanism = 'corner', height = 3.2, thickness = 0.5,"
        " density = 1900, hinge_depth = 0.03, wing_angle = 30, load_total = 6e3, load_depth = 0.45, load_height = 3.2,"
        " load_inertia = 'both', thrust_total = 2e3, thrust_depth = 0.4, thrust_height = 3.2 /\n"
        f"&records catalogue = '{root}/data/records/synthetic44.csv' /\n&check ag = 0.2, f0 = 2.5, tc_star = 0.35 /\n"
        "&stripes levels = 0.5, 1.0, 1.5, 2.0 /\n"
    )
    planned = run("--check", case)
    assert planned.returncode == 0
    assert "7136 kg, centroid 0.8354 m behind the outer edge" in planned.stdout
    assert "N/m" not in planned.stdout
    assert "usual" not in planned.stderr
    assert run(case).returncode == 0
    results = dd.read_results(tmp_path / "out")
    assert results.stripes.wall.capacity_angle == corner().capacity_angle
    assert results.check.value("mechanism", "", "alpha_0") == pytest.approx(0.3269288666929932, rel=1e-6)
    # No column of its calculation is per metre
    lines = (tmp_path / "out_calculation.csv").read_text().splitlines()
    head, first = [line.split(",") for line in lines if not line.startswith("#")][:2]
    assert head == [
        *("item", "force_n", "depth_m", "arm_m", "lever_m"),
        *("stabilising_nm", "overturning_nm", "force_lever_nm", "force_lever2_nm2"),
    ]
    assert float(first[1]) == pytest.approx(results.check.items[0].force, rel=1e-12)


def test_all_modes_move_it_along_the_bisector():
    """What is said of a building with modes of two directions, and not of one with a single mode."""
    several = dd.Building([0.3, 0.2], participation=[1.2, 0.4])
    said = [text for _, text in notes_on_supports((corner(building=several),))]
    assert any("along the bisector of the corner; modes of its two directions" in text for text in said)
    for wall in (corner(building=dd.Building(0.3, participation=1.2)), dd.OneSidedWall(3.0, 0.3, building=several)):
        assert not any("bisector" in text for _, text in notes_on_supports((wall,)))


def test_an_uncertain_angle(records, root, run, tmp_path):
    """The larger the angle, the stronger; by Python and by the executable."""
    levels = [0.5, 1.0, 1.5, 2.0, 3.0, 4.0]
    sources = {"wing_angle": dd.distributions.Uniform(10.0, 30.0)}
    found = dd.propagate_uncertainty(corner(), records, levels, sources=sources, n_variants=12, progress=False)
    ordered = sorted(found.sample, key=lambda one: one.wing_angle)
    assert ordered[0].wing_angle < 12.0 < 28.0 < ordered[-1].wing_angle
    assert np.all(np.diff([one.trigger_acceleration for one in ordered]) > 0.0)
    case = tmp_path / "case.nml"
    case.write_text(
        f"&job task = 'typology' output = '{tmp_path}/out' /\n&wall mechanism = 'corner', height = 3.2, "
        "thickness = 0.5, hinge_depth = 0.03, wing_angle = 20.0 /\n"
        "&uncertainty variants = 12, wing_angle = 'uniform(10.0, 30.0)' /\n"
        f"&records catalogue = '{root}/data/records/synthetic44.csv' /\n"
        "&stripes levels = 0.5, 1.0, 1.5, 2.0, 3.0, 4.0 /\n"
    )
    assert run(case).returncode == 0
    walls = dd.read_results(tmp_path / "out").typology.walls
    assert len({one.wing_angle for one in walls}) > 12


@pytest.mark.parametrize("lang", ["en", "it"])
def test_calculation_report(lang, root, tmp_path):
    """The same in all: no number of a corner is per metre, and steps lead to the numbers of the check."""
    case = tmp_path / "case.nml"
    case.write_text(
        "&wall mechanism = 'corner', height = 3.2, thickness = 0.5, density = 1900, compressive_strength = 3e6,"
        " wing_angle = 30, load_total = 6e3, load_depth = 0.45, load_height = 3.2, load_inertia = 'both',"
        " thrust_total = 2e3, thrust_depth = 0.4, thrust_height = 3.2 /\n"
        f"&records catalogue = '{root}/data/records/synthetic44.csv' /\n&check ag = 0.2, f0 = 2.5, tc_star = 0.35 /\n"
        "&stripes levels = 0.5, 1.0, 1.5, 2.0, 3.0 /\n"
    )
    results = dd.run_case(case, progress=False)
    dd.calculation_report(results, tmp_path / "out.html", lang=lang)
    text = unescape(re.sub(r"<[^>]*>", " ", (tmp_path / "out.html").read_text(encoding="utf-8")))
    text = re.sub(r"\s+", " ", text)
    for unit in ("N/m", "kNm/m", "kNm²/m", "kg/m ", "t/m "):
        assert unit not in text, unit
    words = {
        "en": ("corner 1", "wing 2", "of the whole corner", "along the bisector", "Forces of a corner are those of"),
        "it": ("spigolo 1", "ala 2", "per l'intero cantonale", "lungo la bisettrice", "ribaltamento del cantonale"),
    }
    for one in words[lang]:
        assert one in text, one
    # The steps of the hinge, d_0* and a(d_C): without them a sentence says why
    for missing in ("is that of the code: springs", "is that of the capacity curve", "è quella della curva"):
        assert missing not in text
    assert "2/3" in text
    assert ("per metro di parete" if lang == "it" else "per metre of wall") not in text
    # A strength divided by FC makes the triangle that is crushed deeper by the root of FC.
    depth = 100.0 * results.population[0].base_hinge_depth * 1.35**0.5
    assert f"{depth:.4g}".replace(".", "," if lang == "it" else ".") in text


def test_archive(tmp_path):
    """A study of a corner is the same when it is loaded again."""
    response = dd.simulate(corner(wing_length=1.0), pulses(5.0, 0.7, 2))
    response.save(tmp_path / "corner.npz")
    again = dd.load(tmp_path / "corner.npz")
    assert again.wall == response.wall
    assert again.edp == response.edp


def test_drawing():
    """The section along the bisector: the diagonal of the square, and behind it both wings as one."""
    wall = corner(wing_length=1.0)
    (wing,) = wedges(wall)
    far, full = 1.0 / np.sqrt(2.0), 1.0 / np.tan(np.radians(30.0))
    assert wing == pytest.approx(np.array([(0.0, 0.0), (0.0, 3.2), (-far, 3.2), (-far, full), (0.0, 0.0)]), abs=1e-14)
    rest = shape(wall, 0.0)
    assert rest.blocks[0][1] == pytest.approx((0.5 * np.sqrt(2.0), 0.0))
    assert rest.hinges[0] == pytest.approx((0.5 * np.sqrt(2.0) - 0.03, 0.0))
    texts = [text.get_text() for text in wall.plot().texts]
    assert any("6 kN" in text and "kN/m" not in text for text in texts)
    assert any("2 kN thrust" in text for text in texts)
