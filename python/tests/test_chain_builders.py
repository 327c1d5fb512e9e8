"""Builders of chains against published and computed values; the other side of a chain, its impact, and its files."""

import itertools
import math
import subprocess
import warnings

import numpy as np
import pytest
from test_rigid_chains import CHAINS, SHEETS, SITE, body, rectangle

import dondolo as dd
from dondolo.walls.chain_builders import _stones, _weakest_hinges

G = 9.81


def check_values(wall):
    check = dd.check_ntc(wall, SITE, knowledge_factor=1.35)
    return {row.quantity: row.value for row in check.rows if row.method == "mechanism"}


def band(thickness=0.4, thrust=1e5, **more):
    own = {"sides": 1, "restitution_value": 0.7} | more
    if "compressive_strength" not in own:
        own.setdefault("hinge_depth", 0.0)
    return dd.horizontal_bending(4.0, thickness, 1900.0, thrust=thrust, **own)


def ring(voussoirs=7, thickness=1.5, embrace=157.5, **more):
    return dd.arch(
        10.0, thickness, embrace, voussoirs=voussoirs, density=2400.0, **{"sides": 2, "restitution_value": 0.7} | more
    )


def test_horizontal_bending_has_the_terms_of_another_program():
    """Case H of the design values, in 12 digits, with the largest rotation of its history."""
    value = 0.7425584481757533
    wall = dd.horizontal_bending(
        4.0, 0.45, 1900.0, thrust=25e3, hinge_at=2.2, hinge_depth=0.01, sides=2, restitution_value=value
    )
    alpha, mass, part, a0, d0, capacity, inertia, (amplitude, period, cycles), peak = SHEETS["horizontal"]
    values = check_values(wall)
    found = (values["alpha_0"], values["mass"], values["mass_ratio"], 1.35 * values["a_0"], values["d_0"])
    assert found == pytest.approx((alpha, mass, part, a0, d0), rel=1e-12)
    assert (wall.capacity_angle, wall.terms(0.0).inertia) == pytest.approx((capacity, inertia), rel=1e-12)
    assert alpha == pytest.approx(2.0 * 25e3 * 0.43 * (1.0 + 2.2 / 1.8) / (1900.0 * G * 0.45 * 4.0 * 2.2), rel=1e-12)
    assert wall.impact_bound == pytest.approx(value, rel=1e-12)
    time = np.arange(0.0, cycles * period + 1e-9, 0.01)
    motion = np.r_[-amplitude * np.sin(2.0 * np.pi * time / period), np.zeros(500)]
    record = dd.Record(motion, 0.01)
    edp = dd.multiple_stripe(
        wall, [record], [record.peak_acceleration / G], solver=dd.Solver(rtol=1e-11), progress=False
    ).edp
    assert edp[0, 0] * wall.capacity_angle == pytest.approx(peak, rel=1e-8)


def test_the_weakest_place_of_horizontal_bending():
    """In the middle without pushes; with some no other place has a lesser multiplier."""
    bare = dd.horizontal_bending(4.0, 0.45, 1900.0, thrust=25e3, hinge_depth=0.01, sides=2, restitution_value=0.7)
    assert bare._rows("joint_table")[1, 4] == 2.0
    own = {"pushes": [(1.0, 4e3), (3.1, 1e3)], "compressive_strength": 1.5e6, "sides": 1, "restitution_value": 0.7}
    pushed = dd.horizontal_bending(4.0, 0.45, 1900.0, thrust=25e3, **own)
    place, depth = pushed._rows("joint_table")[1, 4], 25e3 / (1.7 * 1.5e6)
    assert pushed._rows("joint_table")[0, 3] == pytest.approx(depth, rel=1e-12)
    least = check_values(pushed)["alpha_0"]
    assert place != 2.0
    for other in (0.7, 0.95, place - 0.02, place + 0.02, 1.6, 2.0, 3.0):
        one = dd.horizontal_bending(4.0, 0.45, 1900.0, thrust=25e3, hinge_at=other, **own)
        assert check_values(one)["alpha_0"] > least


@pytest.mark.parametrize(("voussoirs", "alpha"), [(7, 0.3700097380218768), (14, 0.3589), (21, 0.3557), (28, 0.3547)])
def test_the_arch_of_oppenheim(voussoirs, alpha):
    assert check_values(ring(voussoirs))["alpha_0"] == pytest.approx(alpha, rel=1e-12 if voussoirs == 7 else 2e-4)


def test_the_weakest_portal_and_its_impact():
    """The chain and the bound of another program: hinges 2, 5, 7 and 10, the impact with all joints."""
    wall = dd.arch(1.75, 0.5, 180.0, voussoirs=8, pier=(1.0, 3.5), density=1900.0, sides=2, restitution_value=0.8)
    values = check_values(wall)
    alpha, mass, part, a0, d0, capacity, inertia, *_ = SHEETS["portal"]
    found = (values["alpha_0"], values["mass"], values["mass_ratio"], 1.35 * values["a_0"], values["d_0"])
    assert found == pytest.approx((alpha, mass, part, a0, d0), rel=1e-12)
    assert (wall.capacity_angle, wall.terms(0.0).inertia) == pytest.approx((capacity, inertia), rel=1e-12)
    assert wall.impact_bound == pytest.approx(0.8266624574104, rel=1e-12)
    assert ring().impact_bound == pytest.approx(0.7478202942782, rel=1e-12)


def test_the_thinnest_semicircle():
    """Milankovitch's ratio 0.1075 stands, a thinner one does not."""
    stones = _stones(10.0, 1.075, 180.0, 30, 2400.0, 1.0, None)
    assert [one.multiplier for one in _weakest_hinges(stones, (), 0.0)] == pytest.approx([0.00015, 0.00015], abs=5e-6)
    assert check_values(ring(30, 1.2, 180.0))["alpha_0"] > 0.02
    with pytest.raises(dd.errors.InputError, match=r"the arch falls by itself, its multiplier is -0\.009397"):
        ring(30, 1.05, 180.0)


def test_no_other_joints_of_an_arch_are_weaker():
    """Chains of neighbouring joints, made by hand, have greater multipliers."""
    least = check_values(ring())["alpha_0"]
    angles = [math.radians(90.0 + (0.5 - k / 7.0) * 157.5) for k in range(8)]

    def at(joint, radius):
        return radius * math.cos(angles[joint]), radius * math.sin(angles[joint])

    def stone(k):
        end, start = math.degrees(angles[k]), math.degrees(angles[k + 1])
        return dd.Sector((0.0, 0.0), 9.25, 10.75, start=start, end=end, width=1.0, density=2400.0)

    for second, third in ((2, 4), (2, 5), (3, 4), (3, 6)):
        wall = dd.Chain(
            height=10.75, sides=1, restitution_value=0.7,
            bodies=[body(*map(stone, run)) for run in (range(second), range(second, third), range(third, 7))],
            joints=[
                dd.Pin(1, 0, at(0, 9.25)), dd.Pin(1, 2, at(second, 10.75)), dd.Pin(2, 3, at(third, 9.25)),
                dd.Pin(3, 0, at(7, 10.75)),
            ],
        )  # fmt: skip
        assert check_values(wall)["alpha_0"] > least


def test_loads_on_one_side_of_an_arch():
    """Sides that differ are refused for both; one side is the weaker, wherever the load is."""
    load = dd.PointLoad(2, (-6.0, 8.0), 60e3, inertia="both")
    with pytest.raises(dd.errors.InputError, match="sides = 2: to the right and to the left the multipliers differ"):
        ring(loads=[load])
    mirror = dd.PointLoad(6, (6.0, 8.0), 60e3, inertia="both")
    weaker, same = ring(loads=[load], sides=1), ring(loads=[mirror], sides=1)
    assert check_values(weaker)["alpha_0"] == pytest.approx(check_values(same)["alpha_0"], rel=1e-12)
    # Of both sways it is the lesser: that towards the side without the load
    sways = [one.multiplier for one in _weakest_hinges(_stones(10.0, 1.5, 157.5, 7, 2400.0, 1.0, None), [load], 0.0)]
    assert abs(sways[0] - sways[1]) > 0.02 * min(sways)
    assert check_values(weaker)["alpha_0"] == pytest.approx(min(sways), rel=1e-9)
    assert [one._rows("action_table")[0, 1] for one in (weaker, same)] == [6.0, 6.0]
    both = ring(loads=[load, mirror])
    assert math.isfinite(both.impact_bound)


def flipped(name, **more):
    return dd.Chain(**{**CHAINS[name], **more})


def test_sides_that_differ_a_little_take_the_lesser():
    """Strip of the design values: 0.19879 outwards, 0.19920 inwards; seen from behind it is the same wall."""
    outwards = flipped("strip")
    assert check_values(outwards)["alpha_0"] == pytest.approx(0.1987898448399373, rel=1e-12)
    # Hinges at the other ends of the joints, mirrored
    turned = {
        "bodies": [
            body(rectangle(0.0, 0.5, 0.0, 3.6, 1900.0), rectangle(0.0, 0.4, 3.6, 4.2, 1900.0)),
            body(rectangle(0.0, 0.4, 4.2, 6.8, 1900.0)),
        ],
        "joints": [dd.Pin(1, 0, (0.49, 0.0)), dd.Pin(1, 2, (0.01, 4.2)), dd.Guide(2, 0, (0.39, 6.8))],
        "actions": [
            dd.PointLoad(1, (0.38, 3.6), 12e3, inertia="both"),
            dd.PointLoad(2, (0.2, 6.8), 8e3, inertia="vertical", held=True),
        ],
    }
    alone = check_values(flipped("strip", sides=1, **turned))
    assert alone["alpha_0"] == pytest.approx(0.1991966109872402, rel=1e-12)
    assert flipped("strip", sides=1, **turned).capacity_angle == pytest.approx(0.09027627727072662, rel=1e-12)
    both = flipped("strip", **turned)
    assert check_values(both)["alpha_0"] == pytest.approx(0.1987898448399373, rel=1e-12)
    assert both.capacity_angle == pytest.approx(outwards.capacity_angle, rel=1e-12)
    q = np.linspace(0.0, 0.08, 5)
    np.testing.assert_allclose(both.terms(q).inertia, outwards.terms(q).inertia, rtol=1e-12)
    # It moves inwards, towards -x
    assert both.motion(0.05).turn[0] == pytest.approx(-0.05, rel=1e-12)
    assert both.motion(0.0).x[0] > 0.0


def test_sides_that_differ_are_refused():
    load = dd.PointLoad(1, (-0.45, 3.6), 30e3, inertia="both")
    with pytest.raises(
        dd.errors.InputError, match=r"sides = 2: outwards and inwards differ \(alpha_0 .*two walls of one"
    ):
        flipped("strip", actions=[load])
    push = dd.PointThrust(1, (-0.4, 3.6), 20e3, angle=180.0)
    with pytest.raises(dd.errors.InputError, match="inwards the chain falls by itself"):
        flipped("strip", actions=[push])


@pytest.mark.parametrize("name", ["cavity", "frame", "horizontal"])
def test_symmetrical_stacks_keep_their_terms(name):
    assert check_values(flipped(name))["alpha_0"] == pytest.approx(SHEETS[name][0], rel=1e-12)


def test_impacts_of_blocks_and_strips():
    """Housner's block, and strips of two_block with a lifted mass."""
    b, h = 0.3, 3.0
    block = dd.Chain(
        height=h, sides=2, restitution_value=0.9, bodies=[body(rectangle(-b, 0.0, 0.0, h, 1800.0))],
        joints=[dd.Pin(1, 0, (0.0, 0.0))],
    )  # fmt: skip
    assert block.impact_bound == pytest.approx(1.0 - 1.5 * math.sin(math.atan(b / h)) ** 2, rel=1e-12)
    strip = dd.TwoBlockWall(
        h, b, hinge=0.5, hinge_depth=0.02, overburden=20e3, overburden_inertia=1.0, restitution="impulse"
    )
    chain = dd.Chain(
        height=h, sides=2, restitution_value=0.4,
        bodies=[body(rectangle(-b, 0.0, 0.0, 1.5, 1800.0)), body(rectangle(-b, 0.0, 1.5, h, 1800.0))],
        joints=[dd.Pin(1, 0, (-0.02, 0.0)), dd.Pin(1, 2, (0.02 - b, 1.5)), dd.Guide(2, 0, (-0.02, h))],
        actions=[dd.PointLoad(2, (-0.5 * b, h), 20e3, inertia="vertical", held=True)],
    )  # fmt: skip
    assert chain.impact_bound == pytest.approx(strip.restitution_coefficient, rel=1e-12)
    assert math.isnan(flipped("portal").impact_bound)
    with pytest.raises(dd.errors.InputError, match="restitution_value: must be given, the mechanism has no model"):
        flipped("cavity", restitution_value=None, restitution="impulse")


def heard(wall):
    with warnings.catch_warnings(record=True) as found:
        warnings.simplefilter("always")
        dd.simulate(wall, dd.Record(np.sin(np.arange(60.0)), 0.02))
    return {one.message.code: str(one.message) for one in found if isinstance(one.message, dd.errors.DondoloWarning)}


def test_warnings_of_chains():
    """Mirror images that the tables do not show, a restitution above its bound, and bodies that meet."""
    assert "add what stands still as body 0" in heard(flipped("portal"))["mirror_image"]
    said = heard(ring(restitution_value=0.8))
    assert "restitution of 0.8 is more than 0.7478" in said["restitution_above_bound"]
    assert "mirror_image" not in said
    assert heard(ring()) == {}
    # A buttress of the lower leaf stands behind the upper one, which leans on it as it turns
    stub = body(rectangle(-0.25, 0.0, 0.0, 1.5, 1800.0), rectangle(-0.45, -0.255, 0.0, 2.0, 1800.0))
    upper = body(rectangle(-0.25, 0.0, 1.5, 3.0, 1800.0))
    wall = dd.Chain(
        height=3.0, sides=1, restitution_value=0.8, bodies=[stub, upper],
        joints=[dd.Pin(1, 0, (0.0, 0.0)), dd.Pin(1, 2, (-0.25, 1.5)), dd.Guide(2, 0, (0.0, 3.0))],
    )  # fmt: skip
    assert "bodies 1 and 2 move into each other by" in heard(wall)["bodies_meet"]


def test_hinges_of_arches_on_the_wrong_side_are_refused():
    """Sectors are compared in convex slices."""
    wrong = [*ring().joint_table]
    x, y = wrong[8 + 3], wrong[8 + 4]
    scale = 9.25 / math.hypot(x, y)
    wrong[8 + 3 : 8 + 5] = wrong[8 + 6 : 8 + 8] = x * scale, y * scale
    with pytest.raises(dd.errors.InputError, match=r"would close|must be positive|lever"):
        dd.Chain(height=10.75, sides=1, restitution_value=0.7, body_table=ring().body_table, joint_table=wrong)


def test_files_have_the_same_chain(tmp_path, executable, root):
    """Written and read, every number is the same; the executable says what it knows of sides and impact."""
    load = dd.PointLoad(1, (-2.2, 3.5), 10e3, inertia="both")
    other = dd.PointLoad(10, (2.2, 3.5), 10e3, inertia="both")
    wall = dd.arch(
        1.75,
        0.5,
        180.0,
        voussoirs=8,
        pier=(1.0, 3.5),
        density=1900.0,
        sides=2,
        restitution_value=0.8,
        loads=[load, other],
    )
    files = wall.write_tables(tmp_path / "gate")
    assert [path.name for path in files] == ["gate_bodies.csv", "gate_joints.csv", "gate_actions.csv"]
    own = dict(zip(("bodies", "joints", "actions"), files, strict=True))
    again = dd.Chain(height=wall.height, sides=2, restitution_value=0.8, **own)
    for table in ("body_table", "joint_table", "action_table"):
        rows = wall._rows(table).ravel()
        # Roundings of zero are written as 0
        assert list(getattr(again, table)) == np.where(np.abs(rows) < 1e-12 * wall.height, 0.0, rows).tolist()
    assert again.impact_bound == wall.impact_bound
    # The ready case is this portal, with depths from its right face
    case = dd.read_case(root / "data/cases/portal.nml").population[0]
    assert case.capacity_angle == pytest.approx(wall.capacity_angle, rel=1e-12)
    assert case.impact_bound == pytest.approx(wall.impact_bound, rel=1e-12)
    said = subprocess.run(
        [executable, "--check", root / "data/cases/portal.nml"], capture_output=True, text=True, check=True
    ).stdout
    assert "it moves inwards as its mirror image, which all of it is" in said
    assert f"restitution: 0.8 given; an impact on all joints leaves {case.impact_bound:.4g}"[:70] in said
    assert "behind the edge" not in said


def test_roundings_of_zero_are_not_written(tmp_path):
    """A hinge at the crown of a round number of degrees has a depth of 1e-16 m."""
    x = 1.5 * math.cos(math.radians(90.0))
    assert 0.0 < abs(x) < 1e-15
    leaf = body(rectangle(-0.25, 0.0, 0.0, 3.0, 1800.0))
    wall = dd.Chain(height=3.0, sides=1, restitution_value=0.9, bodies=[leaf], joints=[dd.Pin(1, 0, (-x, 0.0))])
    _bodies, joints = wall.write_tables(tmp_path / "leaf")
    assert joints.read_text().splitlines()[1].split(",")[3] == "0"


def opening_fours(embrace, thickness, voussoirs):
    """How many fours of hinges open, of any pattern and to both sides, by the equations of three links one by one."""
    angles = np.radians(90.0 + embrace * (0.5 - np.arange(voussoirs + 1) / voussoirs))
    edges = [radius * np.column_stack([np.cos(angles), np.sin(angles)]) for radius in
             (10.0 - 0.5 * thickness, 10.0 + 0.5 * thickness)]  # fmt: skip
    count = 0
    for joints in itertools.combinations(range(voussoirs + 1), 4):
        for sides in itertools.product((0, 1), repeat=4):
            hinges = [edges[side][joint] for side, joint in zip(sides, joints, strict=True)]
            ends = [edges[1 - side][joint] for side, joint in zip(sides, joints, strict=True)]
            first, second, third = (hinges[k + 1] - hinges[k] for k in range(3))
            links = np.column_stack([second, third])
            if abs(np.linalg.det(links)) < 1e-12:
                continue
            turns = np.array([0.0, 1.0, *np.linalg.solve(links, -first), 0.0])
            # A joint opens where what is behind it moves away from what is before it
            steps = [
                (turns[k + 1] - turns[k]) * (1.0 if sides[k] == 0 else -1.0) * np.sum((ends[k] - hinges[k]) ** 2)
                for k in range(4)
            ]
            count += all(step > 0.0 for step in steps) + all(step < 0.0 for step in steps)
    return count


def test_a_thick_shallow_arch_has_no_hinges():
    """None of its fours opens, of any pattern; those of a thinner one and of a less shallow one do."""
    assert opening_fours(60.0, 1.5, 8) == 0
    assert opening_fours(60.0, 0.6, 8) > 0
    assert opening_fours(90.0, 1.5, 8) > 0
    given = {"voussoirs": 8, "density": 2400.0, "sides": 2, "restitution_value": 0.7}
    with pytest.raises(dd.errors.InputError, match=r"embrace = 60: .* no four hinges among its 9 joints that open"):
        dd.arch(10.0, 1.5, 60.0, **given)
    assert dd.arch(10.0, 0.6, 60.0, **given).trigger_acceleration > 2.0 * 9.81


def portal(**more):
    return dd.arch(
        1.75, 0.5, 180.0, voussoirs=8, pier=(1.0, 3.5), density=1900.0, sides=1, restitution_value=0.8, **more
    )


def again_with(wall, **tables):
    """The same chain with other tables."""
    own = {name: getattr(wall, name) for name in ("body_table", "joint_table", "action_table")} | tables
    return dd.Chain(height=wall.height, sides=1, restitution_value=0.8, **own)


def test_pins_off_their_bodies_are_refused():
    """The right base of a portal, 0.3 m outside its pier, raises its multiplier; nearer than 1 % is kept."""
    wall = portal()
    joints = wall._rows("joint_table")
    place = int(np.flatnonzero((joints[:, 1] == 3) & (joints[:, 2] == 0))[0])
    moved = joints.copy()
    moved[place, [3, 6]] -= 0.05
    assert check_values(again_with(wall, joint_table=moved.ravel()))["alpha_0"] > 0.0
    for off, depth in ((0.06, r"-2\.56"), (0.3, r"-2\.8")):
        moved = joints.copy()
        moved[place, [3, 6]] -= off
        words = rf"joint {place + 1}, a pin, at depth {depth} m, height 0 m is {off} m off body 3, must be at most 0.05"
        with pytest.raises(dd.errors.InputError, match=words):
            again_with(wall, joint_table=moved.ravel())
    # A body that has a given mass has no outline to compare with
    heavy = dd.Body([rectangle(-0.5, 0.0, 0.0, 3.0, 1800.0), dd.GivenMass(500.0, (-1.5, 2.0), 50.0)])
    dd.Chain(height=3.0, sides=1, restitution_value=0.5, bodies=[heavy], joints=[dd.Pin(1, 0, (0.4, 0.0))])


@pytest.mark.parametrize(
    "action",
    [
        dd.PointLoad(1, (100.0, 2.0), 100.0, inertia="both"),
        dd.PointMass(1, (100.0, 2.0), 10.0),
        dd.PointThrust(1, (100.0, 2.0), 1.0),
    ],
)
def test_what_acts_far_from_its_body_is_refused(action):
    def wall(**more):
        leaf = body(rectangle(-0.25, 0.0, 0.0, 3.0, 1800.0))
        own = {"bodies": [leaf], "joints": [dd.Pin(1, 0, (0.0, 0.0))], **more}
        return dd.Chain(height=3.0, sides=1, restitution_value=0.9, **own)

    words = "actions: the action at depth -100 m, height 2 m is 100 m off body 1, must be at most 0.5 m"
    with pytest.raises(dd.errors.InputError, match=words):
        wall(actions=[action])
    # On a corbel
    assert check_values(wall(actions=[dd.PointLoad(1, (-0.74, 2.0), 100.0, inertia="both")]))["alpha_0"] > 0.0


def test_masonry_that_stands_still_is_compared():
    """Body 0 may not lie in others at rest, no hinge on it may close, and bodies that move into it are warned of."""
    leaf = body(rectangle(-0.25, 0.0, 1.0, 3.0, 1800.0))

    def wall(standing, hinge=(0.0, 1.0)):
        return dd.Chain(
            height=3.0, sides=1, restitution_value=0.8, bodies=[leaf, dd.Body([standing], stands=True)],
            joints=[dd.Pin(1, 0, hinge)],
        )  # fmt: skip

    assert heard(wall(rectangle(-0.25, 0.0, 0.0, 1.0, 1800.0))) == {}
    with pytest.raises(dd.errors.InputError, match=r"bodies: bodies 0 and 1 overlap at rest by 0\.05 m2"):
        wall(rectangle(-0.25, 0.0, 0.0, 1.2, 1800.0))
    # A wall in front of it, on which it leans as it turns
    front = rectangle(0.02, 0.3, 0.0, 3.0, 1800.0)
    assert "bodies 0 and 1 move into each other by" in heard(wall(front))["bodies_meet"]
    # It cannot turn about its upper corner on masonry in front of it
    with pytest.raises(dd.errors.InputError, match="would close: bodies 1 and 0 move into each other"):
        wall(rectangle(0.0, 0.3, 0.0, 3.0, 1800.0))


@pytest.mark.parametrize(
    ("make", "words"),
    [
        (lambda: band(0.0), "thickness = 0: must be positive"),
        (lambda: band(hinge_depth=None), "hinge_depth: must be given with mechanism = 'horizontal', or compressive"),
        (lambda: band(thrust=1e6, compressive_strength=1e6), "puts the hinge at depth 0.5882 m, must be less deep"),
        (lambda: band(compressive_strength=1e6, hinge_depth=0.01), "must be at most 0.85 f 2 u = 17000 N/m, which"),
        (lambda: band(compressive_strength=0.0), "compressive_strength = 0: must be positive"),
        (lambda: band(pushes=[(4.0, 1.0)]), "push_x = 4: must lie within the length of 4 m"),
        (lambda: band(hinge_at=4.0), "hinge_x = 4: must lie within"),
        (lambda: ring(2), "voussoirs"),
        (lambda: ring(embrace=200.0), "embrace = 200: must be at most 180"),
        (lambda: ring(thickness=25.0), "thickness = 25: must be less than twice the radius"),
        (lambda: ring(hinge_depth=0.8), "hinge_depth = 0.8: must be 0 to half"),
        (lambda: ring(pier=(1.0, 3.0)), "embrace = 157.5: must be at most 180, and 180 on piers"),
        (lambda: ring(embrace=180.0, pier=(1.0, 3.0)), "its width must be at least the thickness"),
        (lambda: ring(loads=[dd.PointLoad(8, (0.0, 10.0), 1e3, inertia="both")]), "stone 8 must be one of 1 to 7"),
        (lambda: ring(loads=[1.0]), "must be dondolo.PointLoad"),
    ],
)  # fmt: skip
def test_messages_of_builders(make, words):
    with pytest.raises(dd.errors.DondoloError, match=words):
        make()
