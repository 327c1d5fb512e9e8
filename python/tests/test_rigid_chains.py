"""Chains of rigid bodies: nine mechanisms of masonry against another program, walls of dondolo as chains, messages."""

import dataclasses
import json
import math
import subprocess
from typing import Any

import matplotlib
import numpy as np
import pytest

import dondolo as dd

matplotlib.use("agg")

G = 9.81
SITE = dd.Site((0.104, 0.261, 0.334), (2.332, 2.364, 2.4), (0.281, 0.347, 0.364), soil="B")


def rectangle(x0, x1, y0, y1, density, width=1.0):
    return dd.Part([(x0, y0), (x1, y0), (x1, y1), (x0, y1)], width=width, density=density)


def body(*parts):
    return dd.Body(parts)


def arch_joint(joint, outer):
    angle = math.radians(90.0 + (0.5 - joint / 7.0) * 157.5)
    return (10.75 if outer else 9.25) * math.cos(angle), (10.75 if outer else 9.25) * math.sin(angle)


def voussoir(i):
    step = 157.5 / 7.0
    end = 90.0 + 0.5 * 157.5 - i * step
    return dd.Sector((0.0, 0.0), 9.25, 10.75, start=end - step, end=end, width=1.0, density=2400.0)


def portal_joint(joint, outer):
    angle = math.pi * (1.0 - (joint - 1) / 8.0)
    radius = 2.0 if outer else 1.5
    return radius * math.cos(angle), 3.5 + radius * math.sin(angle)


def portal_voussoir(i):
    return dd.Sector((0.0, 3.5), 1.5, 2.0, start=180.0 - 22.5 * i, end=202.5 - 22.5 * i, width=1.0, density=1900.0)


def wedge():
    long = 7.0 * math.tan(math.radians(20.0))
    return dd.Part([(-0.55, 0.0), (-0.55, 7.0), (-0.55 - long, 7.0)], width=0.9, density=1900.0)


def load(number, x, y, force, inertia="both", held=False):
    return dd.PointLoad(number, (x, y), force, inertia=inertia, held=held)


BETA = math.atan(1.5 / 1.8)
APEX = 2.4 * math.cos(BETA)
# Bodies, joints, actions, and what else belongs to a chain
CHAINS: dict[str, dict[str, Any]] = {
    "compound": {
        "height": 7.0, "sides": 1, "restitution_value": 0.5581665833684304,
        "bodies": [body(rectangle(-0.55, 0.0, 0.0, 7.0, 1900.0, 6.0), wedge())], "joints": [dd.Pin(1, 0, (-0.02, 0.0))],
        "actions": [load(1, -0.40, 3.5, 48e3), load(1, -0.35, 7.0, 24e3), dd.PointThrust(1, (-0.35, 7.0), 1.5e3)],
    },
    "corner": {
        "height": 3.2, "sides": 1, "restitution_value": 0.6348743655272488,
        "bodies": [body(dd.GivenMass(7136.463418676679, (-0.8353932042949779, 2.019738318673118), 5903.577167197559))],
        "joints": [dd.Pin(1, 0, (-0.03, 0.0))],
        "actions": [load(1, -0.45, 3.2, 6e3), dd.PointThrust(1, (-0.4, 3.2), 2e3)],
    },
    "horizontal": {
        "height": 4.0, "sides": 2, "restitution_value": 0.7425584481757533, "gravity_share": 0.0,
        "bodies": [body(rectangle(-0.45, 0.0, 0.0, 2.2, 1900.0)), body(rectangle(-0.45, 0.0, 2.2, 4.0, 1900.0))],
        "joints": [dd.Pin(1, 0, (-0.01, 0.0)), dd.Pin(1, 2, (-0.44, 2.2)), dd.Guide(2, 0, (-0.01, 4.0))],
        "actions": [dd.PointThrust(2, (-0.01, 4.0), 25e3, angle=-90.0)],
    },
    "gable": {
        "height": APEX, "sides": 1, "restitution_value": 0.2534796753046842, "gravity_share": math.cos(BETA),
        "bodies": [body(dd.GivenMass(
            1900.0 * 0.4 * 2.16, (-0.2, APEX / 3.0), 1900.0 * 0.4 * 2.16 * (APEX**2 / 18.0 + 0.16 / 12.0)
        ))],
        "joints": [dd.Pin(1, 0, (-0.01, 0.0))], "actions": [load(1, -0.2, APEX, 4.5e3)],
    },
    "strip": {
        "height": 6.8, "sides": 2, "restitution_value": 0.9267425136975547,
        "bodies": [
            body(rectangle(-0.5, 0.0, 0.0, 3.6, 1900.0), rectangle(-0.4, 0.0, 3.6, 4.2, 1900.0)),
            body(rectangle(-0.4, 0.0, 4.2, 6.8, 1900.0)),
        ],
        "joints": [dd.Pin(1, 0, (-0.01, 0.0)), dd.Pin(1, 2, (-0.39, 4.2)), dd.Guide(2, 0, (-0.01, 6.8))],
        "actions": [load(1, -0.38, 3.6, 12e3), load(2, -0.2, 6.8, 8e3, "vertical", held=True)],
    },
    "arch": {
        "height": 10.75, "sides": 2, "restitution_value": 0.6449595399261409,
        "bodies": [body(*map(voussoir, range(3))), body(*map(voussoir, (3, 4))), body(*map(voussoir, (5, 6)))],
        "joints": [
            dd.Pin(1, 0, arch_joint(0, False)), dd.Pin(1, 2, arch_joint(3, True)),
            dd.Pin(2, 3, arch_joint(5, False)), dd.Pin(3, 0, arch_joint(7, True)),
        ],
    },
    "portal": {
        "height": 5.5, "sides": 2, "restitution_value": 0.1628916324974953,
        "bodies": [
            body(*map(portal_voussoir, (2, 3, 4))), body(*map(portal_voussoir, (5, 6))),
            body(*map(portal_voussoir, (7, 8)), rectangle(1.5, 2.5, 0.0, 3.5, 1900.0)),
        ],
        "joints": [
            dd.Pin(1, 0, portal_joint(2, False)), dd.Pin(1, 2, portal_joint(5, True)),
            dd.Pin(2, 3, portal_joint(7, False)), dd.Pin(3, 0, (2.5, 0.0)),
        ],
    },
    "cavity": {
        "height": 2.7, "sides": 2, "restitution_value": 0.9264592782182839,
        "bodies": [
            body(rectangle(-0.28, -0.16, 0.0, 1.62, 1900.0)), body(rectangle(-0.28, -0.16, 1.62, 2.7, 1900.0)),
            body(rectangle(-0.10, 0.0, 0.0, 1.62, 1800.0)), body(rectangle(-0.10, 0.0, 1.62, 2.7, 1800.0)),
        ],
        "joints": [
            dd.Pin(1, 0, (-0.16, 0.0)), dd.Pin(1, 2, (-0.28, 1.62)), dd.Guide(2, 0, (-0.16, 2.7)),
            dd.Pin(3, 0, (0.0, 0.0)), dd.Pin(3, 4, (-0.10, 1.62)), dd.Guide(4, 0, (0.0, 2.7)),
            dd.Guide(1, 3, (-0.22, 1.62), other_at=(-0.05, 1.62)),
        ],
        "actions": [load(2, -0.22, 2.7, 4e3, "vertical", held=True)],
    },
    "frame": {
        "height": 3.2, "sides": 2, "restitution_value": 0.9369732555225377,
        "bodies": [
            body(rectangle(-0.6, 0.0, 0.0, 3.2, 1900.0)), body(rectangle(-3.6, -3.0, 0.0, 3.2, 1900.0)),
            body(dd.GivenMass(6000.0, (-1.8, 4.0), 5000.0)),
        ],
        "joints": [
            dd.Pin(1, 0, (0.0, 0.0)), dd.Pin(2, 0, (-3.0, 0.0)), dd.Pin(1, 3, (-0.6, 3.2)), dd.Pin(2, 3, (-3.6, 3.2)),
        ],
    },
}  # fmt: skip

# alpha_0, M*, e*, a_0* (FC 1), d_0*, q_c, J(0); amplitude, period and cycles of a motion, and its largest rotation.
# d_0* of one body here counts e (1 - cos q), that of the tables does not: NaN
SHEETS = {
    "compound": (0.1305663724762879, 64878.97578721274, 0.9759468224157812, 1.312424083539567, math.nan,
                 0.1298069200437978, 1309716.208509633, (3.0, 1.0, 2), 0.1035798273192243),
    "corner": (0.3269288666929932, 7576.204550631349, 0.9778164952251560, 3.279932582360217, math.nan,
               0.3146202024143832, 46015.67083560998, (7.0, 0.7, 2), 0.1862748597311918),
    "horizontal": (0.6473037930376486, 3420.0, 1.0, 6.350050209699333, 0.215,
                   0.1930211345591561, 6413.716, (11.0, 0.5, 2), 0.1335465563070292),
    "gable": (0.1652971534749786, 1578.289769789383, 0.7514536256108421, 2.157904387341802, math.nan,
              0.2119373752252902, 2587.102213602045, (4.5, 0.6, 2), 0.1424319422701765),
    "strip": (0.1987898448399373, 6661.264893153547, 0.9414893906049652, 2.071322733256407, 0.2238595595909472,
              0.09013930214699716, 51040.13094653324, (4.0, 0.7, 2), 0.05400592547903514),
    "arch": (0.3700097380218768, 86317.27628237473, 0.8722426155281750, 4.161451716959090, 0.5607206113261415,
             0.06906469353926901, 15812526.73133656, (9.1, 0.8, 2), 0.02488930309312892),
    "portal": (0.1616336718994472, 10461.41905953887, 0.9323873351869296, 1.700609029632178, 0.1826393369902618,
               0.1300737596987163, 46160.16047093719, (4.0, 0.8, 2), 0.06634815819537347),
    "cavity": (0.2332173531148685, 1101.6, 1.0, 2.287862234056860, 0.04910587645922369,
               0.06053081274337541, 1002.248291376147, (3.5, 0.3, 1), 0.04430183595491612),
    "frame": (0.1875, 11897.22699386503, 0.8947974574206551, 2.055632796836712, 0.4865671641791045,
              0.1853479499956948, 89379.2, (3.0, 0.8, 2), 0.06824485227910873),
}  # fmt: skip


@pytest.fixture(scope="module")
def chains():
    return {name: dd.Chain(name=name, **of) for name, of in CHAINS.items()}


@pytest.mark.parametrize("name", SHEETS)
def test_statics(name, chains):
    wall = chains[name]
    alpha, mass, part, a0, d0, capacity, inertia, _, _ = SHEETS[name]
    assert wall.capacity_angle == pytest.approx(capacity, rel=1e-12)
    assert wall.terms(0.0).inertia == pytest.approx(inertia, rel=1e-12)
    assert wall.misfit < 1e-13
    check = dd.check_ntc(wall, SITE, knowledge_factor=1.35)
    values = {row.quantity: row.value for row in check.rows if row.method == "mechanism"}
    assert values["alpha_0"] == pytest.approx(alpha, rel=1e-12)
    assert values["mass"] == pytest.approx(mass, rel=1e-12)
    assert values["mass_ratio"] == pytest.approx(part, rel=1e-12)
    assert values["a_0"] * 1.35 == pytest.approx(a0, rel=1e-12)
    if math.isfinite(d0):
        assert values["d_0"] == pytest.approx(d0, rel=1e-12)


@pytest.mark.parametrize("engine", ["lanes", "rk45"])
@pytest.mark.parametrize("name", SHEETS)
def test_histories(name, engine, chains):
    """Largest rotations under sine motions, against an independent integrator of the kernel's own equations."""
    amplitude, period, cycles = SHEETS[name][7]
    time = np.arange(0.0, cycles * period + 1e-9, 0.01)
    motion = np.r_[-amplitude * np.sin(2.0 * np.pi * time / period), np.zeros(500)]
    record = dd.Record(motion, 0.01, name="sine")
    solver, level = dd.Solver(engine=engine, rtol=1e-11), record.peak_acceleration / G
    found = dd.multiple_stripe(chains[name], [record], [level], solver=solver, progress=False)
    assert found.edp[0, 0] * chains[name].capacity_angle == pytest.approx(SHEETS[name][8], rel=1e-8)


@pytest.mark.parametrize("name", ["horizontal", "arch", "portal", "cavity"])
def test_a_chain_at_rest_has_no_displacement(name, chains):
    """Not a rounding of the polynomial of d, of either sign."""
    record = dd.Record(0.2 * np.sin(np.arange(300) * 0.1), 0.01)
    check = dd.check_ntc(chains[name], dd.Site(0.02, 2.5, 0.3)).dynamic([record])
    assert check.value("dynamic", "SLV", "mean_displacement") == 0.0
    assert check.value("dynamic", "SLV", "beyond") == 0


def test_a_strip_is_a_two_block_wall():
    """Every history of a strip, at a hinge of 20 mm and with half of its load lifted.

    An eccentric load would change sides with a two_block wall, and not with a chain, whose sides then differ.
    """
    strip = dd.TwoBlockWall(3.0, 0.25, hinge=0.6, hinge_depth=0.02, overburden=8e3, overburden_inertia=0.5)
    u, t = 0.02, 0.25
    top = dd.PointLoad(2, (-0.125, 3.0), 8e3, inertia="vertical", held=True)
    numbers = top._row()
    numbers[4] = 0.5
    chain = dd.Chain(
        height=3.0, sides=2, restitution_value=strip.restitution_coefficient,
        bodies=[body(rectangle(-t, 0.0, 0.0, 1.8, 1800.0)), body(rectangle(-t, 0.0, 1.8, 3.0, 1800.0))],
        joints=[dd.Pin(1, 0, (-u, 0.0)), dd.Pin(1, 2, (u - t, 1.8)), dd.Guide(2, 0, (-u, 3.0))],
        action_table=numbers,
    )  # fmt: skip
    q = np.linspace(0.0, 0.9 * strip.capacity_angle, 7)
    for one, other in zip(chain.terms(q), strip.terms(q), strict=True):
        np.testing.assert_allclose(one, other, rtol=0.0, atol=1e-12 * strip.terms(0.0).inertia)
    motions = dd.synthetic_records(6.5, 10.0, "shallow", n_records=8)
    edp = [dd.multiple_stripe(wall, motions, (0.6, 1.0, 1.4), progress=False).edp for wall in (strip, chain)]
    np.testing.assert_allclose(edp[1], edp[0], rtol=0.0, atol=1e-9)
    house = dd.Building(period=0.3, storeys=3, level=3.0, building_height=9.0)
    on = [dataclasses.replace(wall, building=house) for wall in (strip, chain)]
    assert on[1].support_share == pytest.approx(on[0].support_share, rel=1e-12)
    assert on[1].support_tilt == pytest.approx(on[0].support_tilt, rel=1e-12)


def test_motion(chains):
    """Joints stay closed, and the driver turns by the rotation."""
    wall = chains["portal"]
    at = wall.motion([0.0, 0.05])
    assert at.x.shape == (2, 3)
    assert at.turn[1, 0] == pytest.approx(0.05, rel=1e-14)
    hinge = portal_joint(5, True)
    places = [wall._moved([hinge], number, 0.05)[0] for number in (1, 2)]
    np.testing.assert_allclose(places[0], places[1], atol=1e-13)
    with pytest.raises(dd.errors.InputError, match="rotation"):
        wall.motion(3.0)


def test_files_are_lists(executable, root, tmp_path):
    """A case with files has the same histories as the chain in Python, and carries its rows into the results."""
    case = dd.read_case(root / "data/cases/portal.nml")
    wall = case.population[0]
    beam = dd.PointLoad(3, (2.2, 3.5), 10e3, inertia="both")
    given = dd.Chain(**{**CHAINS["portal"], "restitution_value": 0.8, "actions": [beam]})
    assert wall.capacity_angle == pytest.approx(given.capacity_angle, rel=1e-13)
    subprocess.run([executable, "--quiet", root / "data/cases/portal.nml"], cwd=tmp_path, check=True)
    stored = dd.read_results(tmp_path / "out/portal")
    assert np.asarray(stored.stripes.wall.body_table).tolist() == np.asarray(wall.body_table).tolist()
    facts = json.loads((tmp_path / "out/portal_run.json").read_text())
    assert [one["role"] for one in facts["inputs"]].count("table") == 3
    assert stored.check.value("mechanism", "", "alpha_0") == pytest.approx(
        dd.check_ntc(given, SITE).value("mechanism", "", "alpha_0"), rel=1e-12
    )
    dd.report(stored, tmp_path / "report.html", lang="it")


@pytest.mark.parametrize(
    ("word", "way"),
    [("arch", "'chain', whose tables dd.arch of Python"), ("horizontal_bending", "mechanism = 'horizontal'"),
     ("panel", "'one_sided' with elevation_x"), ("strip", "'two_block'"), ("frame", "from tables of its bodies")],
)  # fmt: skip
def test_a_word_for_a_mechanism_names_the_way(word, way, executable, tmp_path):
    case = tmp_path / "case.nml"
    case.write_text(f"&wall mechanism = '{word}', height = 3.0 /\n&stripes levels = 0.1 /\n")
    done = subprocess.run([executable, case], capture_output=True, text=True, check=False)
    assert done.returncode == 2
    assert f"mechanism = '{word}': must be one of 'one_sided'" in done.stderr
    assert way in done.stderr


def test_saved(chains, tmp_path):
    wall = chains["strip"]
    response = dd.simulate(wall, dd.Record(np.full(50, -4.0), 0.01))
    response.save(tmp_path / "response.npz")
    again = dd.load(tmp_path / "response.npz")
    assert again.wall._properties() == wall._properties()
    assert again.wall.motion(0.02).x.tolist() == wall.motion(0.02).x.tolist()


@pytest.mark.parametrize("name", ["portal", "strip", "corner"])
def test_drawing(name, chains, tmp_path):
    ax = chains[name].plot(rotation=0.05)
    assert "0.05 rad" in ax.get_title(loc="left")
    ax.figure.savefig(tmp_path / "chain.png")
    outlines = chains[name].outlines()
    areas = [
        0.5 * abs(np.sum(x * np.roll(y, -1) - y * np.roll(x, -1)))
        for _, _, (x, y) in ((b, o, c.T) for b, o, c in outlines)
    ]
    assert sum(areas) == pytest.approx(
        {"portal": 3.5 + 7 / 16 * math.pi * (4 - 2.25), "strip": 3.08, "corner": 0.0}[name], rel=1e-3
    )


def test_certified(chains):
    """In 33 digits the kernel itself is sampled again."""
    motions = dd.synthetic_records(6.5, 10.0, "shallow", n_records=3)
    stripes = dd.multiple_stripe(chains["cavity"], motions, (0.6, 1.2), certify=True, progress=False)
    assert set(np.unique(stripes.status)) <= {dd.results.Certified.DOUBLE, dd.results.Certified.QUADRUPLE}


PIN, TOP = dd.Pin(1, 0, (0.0, 0.0)), dd.Guide(2, 0, (0.0, 3.0))
HALVES = [body(rectangle(-0.25, 0.0, 0.0, 1.8, 1800.0)), body(rectangle(-0.25, 0.0, 1.8, 3.0, 1800.0))]
FOLD = dd.Pin(1, 2, (-0.25, 1.8))
GOOD = {"height": 3.0, "sides": 2, "restitution_value": 0.9, "bodies": HALVES, "joints": [PIN, FOLD, TOP]}


@pytest.mark.parametrize(
    ("more", "words"),
    [
        ({"sides": None}, "sides: must be given with mechanism = 'chain'"),
        ({"bodies": None}, "bodies: must be given with mechanism = 'chain'"),
        ({"joints": None}, "joints: must be given with mechanism = 'chain'"),
        ({"restitution_value": None}, "restitution_value: must be given"),
        ({"joints": [PIN, FOLD]}, "2 bodies with 4 equations have 6 - 4 = 2 degrees of freedom, must have 1: a pin"),
        ({"joints": [PIN, FOLD, dd.Pin(2, 0, (0.0, 3.0))]},
         "6 - 6 = 0 degrees of freedom, must have 1: it is a structure"),
        ({"joints": [PIN, dd.Pin(1, 2, (0.0, 1.8)), dd.Guide(2, 0, (0.0, 3.0), angle=90.0)]},
         "at rest depend on the others"),
        ({"joints": [PIN, dd.Pin(1, 3, (-0.25, 1.8)), TOP]},
         "joint 2 is between 1 and 3, must be between two of 2 bodies"),
        ({"bodies": [HALVES[0], body(rectangle(-0.25, 0.0, 1.7, 3.0, 1800.0))]},
         "bodies: bodies 1 and 2 overlap at rest by 0.025 m2"),
        ({"bodies": [HALVES[0], body(rectangle(-0.25, 0.0, 1.8, 3.0, 1800.0, -1.0))]}, "body 2 has a mass of -540 kg"),
        ({"bodies": [HALVES[0], body(rectangle(-0.25, 0.0, 1.8, 3.0, 18.0))]},
         "a part of body 2 has a density of 18 kg/m3, must lie between 100 and 10000: is it in kN/m3"),
        ({"bodies": [HALVES[0], body(dd.Part([(0.0, 1.8), (0.0, 3.0)], width=1.0, density=1800.0))]},
         "a part of body 2 has 2 corners, must have 3 at least"),
        ({"bodies": [body(dd.Sector((0, 0), 2.0, 1.0, start=0.0, end=90.0, width=1.0, density=1800.0))],
          "joints": [PIN]},
         "a sector of body 1 has radii of 2 and 1 m"),
        ({"actions": [dd.PointThrust(1, (0.0, 1.8), 50e3)]},
         "at rest, must be positive: the mechanism falls by itself; the thrust at depth 0 m, height 1.8 m pushes it"),
        ({"actions": [dd.PointLoad(3, (0.0, 1.8), 50e3, inertia="both")]}, "action 1 is on body 3, must be one of 2"),
        ({"actions": [dd.PointThrust(1, (0.0, 1.8), -50.0)]}, "action 1 has a negative load, mass or thrust"),
        ({"driver": 3}, "driver = 3: must be one of 2 bodies"),
        ({"gravity_share": 1.2}, "gravity_share = 1.2: must lie between 0 and 1"),
        ({"joint_table": [1.0]}, "joint_table: give either it or joints"),
        ({"joints": None, "joint_table": [1.0] * 7}, "joint_table: has 7 values, must have rows of 8"),
        ({"bodies": "none.csv"}, "none.csv"),
        ({"joints": [PIN, dd.Pin(1, 2, (0.0, 1.8)), TOP], "actions": [dd.PointThrust(1, (0.0, 1.8), 1e3, angle=180.0)]},
         "the joint at depth 0 m, height 1.8 m would close: bodies 1 and 2 move into each other"),
    ],
)  # fmt: skip
def test_messages(more, words):
    with pytest.raises((dd.errors.InputError, FileNotFoundError), match=words):
        dd.Chain(**(GOOD | more))


@pytest.mark.parametrize(
    ("name", "text", "words"),
    [
        ("bodies.csv", "body,width,density [kg/m3],depth [m],height [m]\n", "column 'width': must be one of 'body'"),
        ("bodies.csv", "body,width [m]\n1,2\n", r"column 'depth \[m\]': must be given"),
        (
            "joints.csv",
            "type,body,other,depth [m],height [m]\nhinge,1,0,0,0\n",
            "type = 'hinge': must be one of 'guide', 'pin'",
        ),
        ("joints.csv", "type,body,other,depth [m],height [m]\npin,1,0,0,x\n", r"line 2: height \[m\] = 'x'"),
        (
            "actions.csv",
            "body,depth [m],height [m],load [N],inertia\n1,0.1,1,10,half\n",
            "inertia = 'half': must be one of",
        ),
    ],
)
def test_messages_of_files(name, text, words, tmp_path):
    (tmp_path / name).write_text(text)
    with pytest.raises(dd.errors.InputError, match=words):
        dd.Chain(**(GOOD | {name.split(".")[0]: str(tmp_path / name)}))
