"""Strips between two floors: the weakest hinge, what they carry between their floors, and forces on these.

The geometry is made again here: every body is four points, moved by the exact rotations of both blocks, and derivatives
are differences.
"""

import dataclasses
import subprocess

import matplotlib
import matplotlib.pyplot as plt
import numpy as np
import pytest

import dondolo as dd
from dondolo.reporting.blocks import CaptionedTable, Formula, Paragraph
from dondolo.reporting.language import Language
from dondolo.reporting.relazione.document import Document
from dondolo.reporting.relazione.drawings import draw_wall
from dondolo.reporting.relazione.project import read_project
from dondolo.reporting.relazione.strip_items import moved_strip, strip_of_items
from dondolo.reporting.relazione.subjects import Subject, Subjects

AQUILA = dd.Site(ag=[0.104, 0.261, 0.334], f0=[2.332, 2.364, 2.4], tc_star=[0.281, 0.347, 0.364], soil="B")
LOW = dd.Site(ag=[0.05, 0.13, 0.165], f0=[2.5, 2.5, 2.5], tc_star=[0.28, 0.30, 0.31], soil="B")
G = 9.81


class Strip:
    """A strip as points that the fold moves."""

    def __init__(self, wall: dd.TwoBlockWall, hinge: float, rides_below: bool = True) -> None:
        self.height, t = wall.height, wall.thickness
        self.w = 0.5 * t - wall.base_hinge_depth
        self.joint = hinge * wall.height
        # x, z, is it above; weight, weight that moves, masses pushed and lifted, dead weight, force outwards
        rows = []
        mass = wall.density * t * wall.height
        for bottom, top in ((0.0, self.joint), (self.joint, wall.height)):
            part = 0.25 * mass * (top - bottom) / wall.height
            for x in (-1.0, 1.0):
                for z in (-1.0, 1.0):
                    at = 0.5 * (bottom + top) + z * (top - bottom) / np.sqrt(12.0)
                    rows.append((x * t / np.sqrt(12.0), at, bottom > 0.0, G * part, G * part, part, part, 0.0, 0.0))
        if wall.overburden > 0.0:
            n, i = wall.overburden, wall.overburden_inertia
            rows.append((wall.eccentricity, wall.height, True, n, 0.0, 0.0, i * n / G, (1.0 - i) * n, 0.0))

        def add(depth, z, weight=0.0, pushed=0.0, lifted=0.0, push=0.0):
            near = abs(z - self.joint) <= 1e-9 * wall.height
            above = not rides_below if near else z > self.joint
            moving = G * max(pushed, lifted)
            rows.append((0.5 * t - depth, z, above, weight, moving, pushed, lifted, weight - G * lifted, push))

        for load in wall.loads:
            lifted, pushed = {"none": (0, 0), "vertical": (1, 0), "both": (1, 1), None: (load.lifted, load.pushed)}[
                load.inertia
            ]
            add(load.depth, load.height, load.force, pushed * load.force / G, lifted * load.force / G)
        for one in wall.inertial_masses:
            add(one.depth, one.height, 0.0, one.mass)
        for thrust in wall.thrusts:
            add(t if thrust.depth is None else thrust.depth, thrust.height, push=thrust.force)
        for tie in wall.ties:
            add(tie.depth or 0.0, tie.height, push=-1.8e8 * tie.section)
        self.rows = np.array(rows, float)

    @classmethod
    def at_hinges(cls, wall: dd.TwoBlockWall, hinges: np.ndarray) -> "Strip":
        """The strip with each of several hinges, whose multipliers are found at once."""
        several = [cls(wall, hinge) for hinge in hinges]
        together = several[0]
        together.rows = np.stack([one.rows for one in several])
        together.joint = np.array([[one.joint] for one in several])
        return together

    def places(self, q: float, drift: float = 0.0) -> np.ndarray:
        """Where the points are: the lower block has turned by q, the top is moved outwards by drift."""
        w, joint, above = self.w, self.joint, self.height - self.joint
        x, z, is_above = self.rows[..., 0], self.rows[..., 1], self.rows[..., 2] > 0.5
        middle = np.array([w - 2.0 * w * np.cos(q) + joint * np.sin(q), joint * np.cos(q) + 2.0 * w * np.sin(q)])
        # The hinge on top stays on its vertical
        p = np.arccos((w + drift - middle[0]) / np.hypot(2.0 * w, above)) - np.arccos(
            2.0 * w / np.hypot(2.0 * w, above)
        )
        low = (w + (x - w) * np.cos(q) + z * np.sin(q), z * np.cos(q) - (x - w) * np.sin(q))
        high = (
            middle[0] + (x + w) * np.cos(p) - (z - joint) * np.sin(p),
            middle[1] + (z - joint) * np.cos(p) + (x + w) * np.sin(p),
        )
        return np.array([np.where(is_above, high[i], low[i]) for i in range(2)])

    def rates(self, q: float, step: float = 1e-5) -> np.ndarray:
        """Levers dx/dq and dy/dq."""
        two, one = self.places(q + step) - self.places(q - step), self.places(q + 2 * step) - self.places(q - 2 * step)
        return (8.0 * two - one) / (12.0 * step)

    def multiplier(self, q: float = 0.0) -> float | np.ndarray:
        dx, dy = self.rates(q)
        weight, moving, push = (self.rows[..., place] for place in (3, 4, 8))
        return np.sum(weight * dy - push * dx, axis=-1) / np.sum(moving * dx, axis=-1)

    def terms(self, q: float) -> tuple[float, ...]:
        """J, G, L and Q."""
        (dx, dy), (pushed, lifted, dead, push) = self.rates(q), self.rows[:, 5:].T
        return pushed @ dx**2 + lifted @ dy**2, G * lifted @ dy, pushed @ dx, push @ dx - dead @ dy


def tie(force: float, height: float, depth: float, strain: float = 0.25) -> dd.Tie:
    """A tie of a yield force, which does not break before the strip falls."""
    return dd.Tie(height, depth=depth, area=force / 1.8e8, length=50.0, strain=strain)


def made(rng: np.random.Generator, *, ties: bool = True) -> dd.TwoBlockWall:
    """A strip with anything on it, its hinge not given."""
    height, t = rng.uniform(2.5, 8.0), rng.uniform(0.12, 0.7)
    how = {"density": rng.uniform(1400, 2200), "overburden": rng.choice([0.0, rng.uniform(1e3, 4e4)])}
    if how["overburden"]:
        how |= {"overburden_inertia": rng.choice([0.0, 0.5, 1.0]), "eccentricity": t * rng.uniform(-0.3, 0.3)}
    if rng.random() < 0.3:
        how["hinge_depth"] = 0.1 * t
    inertia = ("none", "vertical", "both")
    how["loads"] = [
        dd.Load(rng.uniform(1e3, 2e4), depth=t * rng.uniform(0.1, 0.9), height=height * rng.uniform(0.1, 0.95),
                inertia=inertia[rng.integers(3)])
        for _ in range(rng.integers(0, 3))
    ]  # fmt: skip
    if rng.random() < 0.3:
        how["inertial_masses"] = [
            dd.InertialMass(rng.uniform(50, 500), depth=0.5 * t, height=height * rng.uniform(0.1, 0.9))
        ]
    if rng.random() < 0.5:
        how["thrusts"] = [
            dd.Thrust(rng.uniform(10, 300), height=height * rng.uniform(0.1, 0.9), depth=t * rng.random())
        ]
    if ties and rng.random() < 0.5:
        how["ties"] = [tie(rng.uniform(1e3, 2e4), height * rng.uniform(0.2, 0.8), 0.5 * t)]
    return dd.TwoBlockWall(height, t, **how)


def _five() -> dict[str, tuple[dd.TwoBlockWall, dd.Site]]:
    loaded = {"density": 1800, "overburden": 20000, "overburden_inertia": 0, "eccentricity": -0.10}
    floor = [dd.Load(12000, depth=0.375, height=3.2, inertia="vertical")]
    held = {"thrusts": [dd.Thrust(3000, height=2.6, depth=0.225)], "ties": [tie(15000, 3.0, 0.225)]}
    walls = {
        "A1": dd.TwoBlockWall(3.0, 0.14, density=1500, overburden=1800, overburden_inertia=0, eccentricity=-0.025),
        "A2": dd.TwoBlockWall(6.4, 0.45, loads=floor, **loaded),
        "A3": dd.TwoBlockWall(6.4, 0.45, loads=floor, **held, **loaded),
        "A4": dd.TwoBlockWall(4.0, 0.30, density=1900, overburden=6000, overburden_inertia=0,
                              thrusts=[dd.Thrust(1500, height=1.2, depth=0.15)]),
        "A5": dd.TwoBlockWall(7.0, 0.60, density=2000, overburden=9000, overburden_inertia=0, eccentricity=0.05,
                              loads=[dd.Load(8000, depth=0.5, height=3.5, inertia="none")],
                              ties=[tie(9000, 5.25, 0.3)]),
    }  # fmt: skip
    return {name: (wall, LOW if name == "A1" else AQUILA) for name, wall in walls.items()}


FIVE = _five()
# alpha_0, r*, e*, d_0, d_SLV/d_D, zeta_E of SLV and SLC; a given hinge, its alpha_0 and zeta_E; by another program
EXPECTED = {
    "A1": (0.194154012245299, 0.787861781890992, 1.0, 0.0487564837435716, 0.679240995245366, 0.92190889005365,
           0.726352458830148, 0.5, 0.258507839425271, 1.22748261835361),
    "A2": (0.273321818884956, 0.762922213383229, 0.986882183919681, 0.169450578414459, 0.735463652602235,
           0.735463652602235, 0.671434340115703, 0.5, 0.324667250194509, 1.02329204350576),
    "A3": (0.494446180954248, 0.823734019292354, 0.993513756885813, 0.125750139314308, 0.990596812562342,
           1.22480467333601, 1.04382130408884, 0.6, 0.568463795941686, 1.47460341063239),
    "A4": (0.279989315174467, 0.731939020274512, 1.0, 0.102818481396683, 0.576648224815528, 0.689069696707124,
           0.575300701374344, 0.5, 0.34023821020441, 0.837345668593239),
    "A5": (0.500805672565806, 0.638267013907597, 1.0, 0.28419266735026, 1.4084622639473, 1.4084622639473,
           1.41624164090705, 0.5, 0.539102817477654, 1.42671210257694),
}  # fmt: skip


def _numbers(value) -> list[float]:
    """What EXPECTED begins with, out of the numbers of a sheet."""
    names = ("alpha_0", "hinge", "mass_ratio", "d_0")
    ratio = value("nonlinear", "SLV", "displacement") / value("nonlinear", "SLV", "demand")
    return [
        *(value("mechanism", "", name) for name in names), ratio,
        value("nonlinear", "SLV", "zeta_e"), value("nonlinear", "SLC", "zeta_e"),
    ]  # fmt: skip


@pytest.mark.parametrize("name", FIVE)
def test_weakest_hinge(name):
    """The check is at the weakest hinge; a hinge that is given stands beside, and is that of the histories."""
    (wall, site), expected = FIVE[name], EXPECTED[name]
    assert _numbers(dd.check_ntc(wall, site).value) == pytest.approx(expected[:7], rel=1e-12)
    given = dataclasses.replace(wall, hinge=expected[7])
    check = dd.check_ntc(given, site)
    assert _numbers(check.value) == pytest.approx(expected[:7], rel=1e-12)
    beside = [check.value("assigned", "", name) for name in ("hinge", "alpha_0")]
    assert [*beside, check.value("assigned", "SLV", "zeta_e")] == pytest.approx(expected[7:], rel=1e-12)
    assert "hinge_not_weakest" in [note.code for note in check.notes]
    assert given.hinge == expected[7]
    # Within 1 % of the least the given hinge is checked itself, and nothing stands beside
    near = dd.check_ntc(dataclasses.replace(wall, hinge=wall.hinge + 0.004), site)
    assert near.value("mechanism", "", "hinge") == wall.hinge + 0.004
    assert not [row for row in near.rows if row.method == "assigned"]


def test_least_index():
    """The least zeta_E over the hinges is information, with a note where it is more than 2 % less."""
    check = dd.check_ntc(*FIVE["A2"])
    found = [check.value("nonlinear", "SLV", name) for name in ("least_zeta", "least_zeta_hinge")]
    assert found == pytest.approx([0.692828800310466, 0.828706936921597], rel=1e-12)
    assert "least_elsewhere" in [note.code for note in check.notes]
    check = dd.check_ntc(*FIVE["A5"])
    assert check.value("nonlinear", "SLV", "least_zeta") == pytest.approx(1.359, abs=5e-4)
    assert check.value("nonlinear", "SLV", "least_zeta_hinge") == pytest.approx(0.9, rel=1e-9)


@pytest.mark.parametrize(
    ("wall", "forces", "needed"),
    [
        (FIVE["A1"][0], (398.75802093981, 801.17202093981), (0.1004, 0.0464, 0.2215)),
        (dd.TwoBlockWall(3.0, 0.25, hinge=0.6, overburden=20000, overburden_inertia=0, eccentricity=0.02),
         (5782.00694444444, 8285.63194444444), (0.2492, 0.0061, 0.2891)),
        (dd.TwoBlockWall(3.3, 0.30, hinge=0.65, overburden=15000, overburden_inertia=0, eccentricity=-0.05),
         (4137.85633366633, 7545.25815184815), (0.2323, 0.0023, 0.2759)),
        (dd.TwoBlockWall(3.0, 0.25, hinge=0.6, hinge_range=(0.55, 0.601)), (1287.5625, 2391.1875), (0.1806, 0.0347)),
    ],
    ids=["A1", "TB2", "D3", "bare"],
)  # fmt: skip
def test_forces_on_floors(wall, forces, needed):
    check = dd.check_ntc(wall, AQUILA)
    method = "assigned" if check._has("assigned", "", "hinge") else "mechanism"
    assert [check.value(method, "", name) for name in ("floor_top", "floor_base")] == pytest.approx(forces, rel=1e-12)
    friction = [row.value for row in check.rows if row.quantity == "friction_needed" and row.method == method]
    assert friction == pytest.approx(needed, abs=5e-5)
    assert ("top_without_load" in [note.code for note in check.notes]) is (len(needed) == 2)


CASE = """&job task = 'stripes' output = 'out/strip' /
&wall mechanism = 'two_block' height = 6.4 thickness = 0.45 density = 1800.0 overburden = 20000.0
   overburden_inertia = 0.0 eccentricity = -0.1 load = 12000.0 load_depth = 0.375 load_height = 3.2
   load_inertia = 'vertical' thrust = 3000.0 thrust_depth = 0.225 thrust_height = 2.6
   tie_height = 3.0 tie_depth = 0.225 tie_area = 8.333333333333333e-5 tie_length = 50.0 tie_strain = 0.25 {hinge}/
&records catalogue = '{root}/data/records/synthetic44.csv' polarity = 'both' /
&stripes im = 'pga' first = 0.8, last = 1.2, count = 2 /
&check ag = 0.104, 0.261, 0.334 f0 = 2.332, 2.364, 2.4 tc_star = 0.281, 0.347, 0.364 soil = 'B' /
"""


@pytest.mark.parametrize("hinge", ["", "hinge = 0.6 "])
def test_executable(root, executable, tmp_path, hinge):
    """The executable has the same numbers, a dynamic check that says its hinge, and both polarities of a tied strip."""
    (tmp_path / "strip.nml").write_text(CASE.format(root=root, hinge=hinge))
    subprocess.run([executable, "--quiet", "strip.nml"], cwd=tmp_path, check=True)
    results = dd.read_results(tmp_path / "out/strip")
    check = results.check
    assert _numbers(check.value) == pytest.approx(EXPECTED["A3"][:7], rel=1e-12)
    wall = FIVE["A3"][0] if not hinge else dataclasses.replace(FIVE["A3"][0], hinge=0.6)
    again = {
        (row.method, row.limit_state, row.quantity, row.item): row.value for row in dd.check_ntc(wall, AQUILA).rows
    }
    rows = {(row.method, row.limit_state, row.quantity, row.item): row.value for row in check.rows}
    assert {key: rows[key] for key in again} == pytest.approx(again, rel=1e-12)
    assert check.wall == dataclasses.replace(wall, name=check.wall.name)
    assert (("dynamic", "SLV", "hinge", "") in rows) is bool(hinge)
    assert check.value("dynamic", "SLV", "histories") == 2 * check.value("dynamic", "SLV", "records")


def test_closed_form_is_least():
    """On random strips no hinge of a fine scan, by virtual work of points, is weaker than the closed form."""
    rng = np.random.default_rng(64)
    scan = np.linspace(0.1, 0.9, 321)
    done = 0
    while done < 500:
        try:
            wall = made(rng)
        except dd.errors.InputError:
            # Thrusts or loads that fold it at rest
            continue
        done += 1
        both = [Strip(wall, wall.hinge, below).multiplier() for below in (True, False)]
        least = Strip.at_hinges(wall, scan).multiplier().min()
        assert min(both) <= least * (1.0 + 1e-9)
        if done % 25:
            continue
        check = dd.check_ntc(wall, AQUILA)
        assert check.value("mechanism", "", "alpha_0") == pytest.approx(min(both), rel=1e-8)


def test_steps_of_a_calculation_report():
    """Levers of the items at d_C are those of points that the fold moves; their sums give the a(d_C) of the check."""
    rng = np.random.default_rng(5)
    done = 0
    while done < 40:
        try:
            wall = made(rng)
            check = dd.check_ntc(wall, AQUILA)
        except dd.errors.InputError:
            continue
        if not (wall.loads or wall.ties or wall.thrusts or wall.inertial_masses):
            continue
        done += 1
        one = Subject(wall, check, None, None)
        document = Document(Language("en"), read_project(None), Subjects((one,)))
        blocks = strip_of_items(document, one)
        assert [type(block) for block in blocks[:2]] == [Paragraph, Formula]
        assert sum(isinstance(block, CaptionedTable) for block in blocks) == 2
        strip = Strip(wall, check.value("mechanism", "", "hinge"))
        for state in ("SLV", "SLC"):
            moved = moved_strip(wall, check.items, state, check.value("nonlinear", state, "displacement"))
            rates = strip.rates(moved.lower)
            # Blocks are four points each, then come the load on top and what is at a height
            places = [slice(0, 4), slice(4, 8), *(slice(place, place + 1) for place in range(8, strip.rows.shape[0]))]
            for item, at in enumerate(places):
                assert moved.across[item] == pytest.approx(rates[0][at].mean(), rel=1e-7, abs=1e-8)
                assert moved.up[item] == pytest.approx(rates[1][at].mean(), rel=1e-7, abs=1e-8)


def test_scheme_of_a_calculation_report():
    """The load on top is drawn at its eccentricity, and the weights of the blocks at their centroids."""
    matplotlib.use("agg")
    wall = dd.TwoBlockWall(
        3.0, 0.28, hinge=0.6, overburden=15e3, overburden_inertia=0.0, eccentricity=-0.03, hinge_range=(0.6, 0.61)
    )
    one = Subject(wall, dd.check_ntc(wall, AQUILA), None, None)
    ax = draw_wall(Document(Language("it"), read_project(None), Subjects((one,))), one)
    words = {text.get_text(): text.xy for text in ax.texts}
    assert words["N = 15"][0] == pytest.approx(0.14 - 0.03)
    weight = 1800.0 * G * 0.28 * 3.0 * 1e-3
    hinge = one.checked.hinge
    for name, share, height in (("P1", hinge, 0.5 * hinge), ("P2", 1.0 - hinge, 0.5 * (1.0 + hinge))):
        label = f"{name} = {share * weight:.4g}".replace(".", ",")
        assert words[label][1] == pytest.approx(3.0 * height)
        assert any(
            line.get_ydata()[0] == pytest.approx(3.0 * height) for line in ax.lines if len(line.get_ydata()) == 1
        )
    plt.close("all")


def test_terms():
    """Equation of motion, potential and the curve of the check, by differences of the places of points."""
    rng = np.random.default_rng(8)
    for _ in range(40):
        try:
            wall = made(rng, ties=False)
        except dd.errors.InputError:
            continue
        strip = next(
            one
            for one in (Strip(wall, wall.hinge, below) for below in (True, False))
            if one.multiplier() == min(Strip(wall, wall.hinge, b).multiplier() for b in (True, False))
        )
        q = 0.4 * wall.capacity_angle
        found = wall.terms(q)
        expected = strip.terms(q)
        got = (found.inertia, found.restoring_moment, found.excitation_lever, found.load_force)
        scale = strip.rows[:, 3].sum() * wall.height
        assert np.array(got) == pytest.approx(np.array(expected), rel=1e-8, abs=1e-9 * scale)
        step = 1e-4
        slope = (strip.terms(q + step)[0] - strip.terms(q - step)[0]) / (4.0 * step)
        assert float(found.inertia_rate) == pytest.approx(slope, rel=1e-4, abs=1e-4 * float(found.inertia))
        rise = (wall.potential(q + step) - wall.potential(q - step)) / (2.0 * step)
        assert float(rise) == pytest.approx(
            float(found.restoring_moment - found.load_force), rel=1e-5, abs=1e-7 * scale
        )
        total = wall.terms(wall.capacity_angle)
        assert float(total.restoring_moment - total.load_force) == pytest.approx(0.0, abs=1e-9 * scale)


def test_motion_of_supports():
    """How its two floors move a strip with things on it: couplings in the energies, with a tilted line of supports."""
    rng = np.random.default_rng(5)
    house = dd.Building(period=0.3, damping=0.05, storeys=3, level=3.0, level_top=6.0, building_height=12.0)
    for _ in range(20):
        try:
            wall = made(rng, ties=False)
        except dd.errors.InputError:
            continue
        wall = dataclasses.replace(wall, building=house)
        strip = min((Strip(wall, wall.hinge, below) for below in (True, False)), key=Strip.multiplier)
        weight, pushed, lifted, push = strip.rows[:, [3, 5, 6, 8]].T
        h = 1e-3

        def place(q, drift, strip=strip, wall=wall):
            return strip.places(q + drift / wall.height, drift)

        dx, dy = (place(h, 0.0) - place(-h, 0.0)) / (2.0 * h)
        tilted = (place(0.0, h) - place(0.0, -h)) / (2.0 * h)
        share = (pushed @ (dx * tilted[0]) + lifted @ (dy * tilted[1])) / (pushed @ dx)
        mixed = (place(h, h) - place(h, -h) - place(-h, h) + place(-h, -h)) / (4.0 * h**2)
        tilt = (push @ mixed[0] - weight @ mixed[1]) / (pushed @ dx)
        assert wall.support_share == pytest.approx(share, rel=1e-4)
        assert wall.support_tilt == pytest.approx(tilt, rel=1e-3, abs=1e-3)


def test_range_of_hinges():
    """The end of the range that is hit is named."""
    bare = dd.TwoBlockWall(3.0, 0.25)
    assert bare.hinge == 0.9
    assert "hinge_above_usual" in [note.code for note in dd.check_ntc(bare, AQUILA).notes]
    low = dd.TwoBlockWall(3.0, 0.25, hinge_range=(0.3, 0.7))
    assert low.hinge == 0.7
    with pytest.raises(dd.errors.InputError, match=r"hinge_range = 0\.7, 0\.3: must increase"):
        dd.TwoBlockWall(3.0, 0.25, hinge_range=(0.7, 0.3))
    with pytest.raises(dd.errors.InputError, match="hinge_range: has 1 values"):
        dd.TwoBlockWall(3.0, 0.25, hinge_range=(0.7,))


def test_floor_at_the_hinge():
    """A load at the height of the hinge goes with the block for which alpha_0 is less, whatever the hinge."""
    for depth in (0.05, 0.4):
        floor = dd.Load(15e3, depth=depth, height=3.0, inertia="vertical")
        wall = dd.TwoBlockWall(5.0, 0.45, hinge=0.6, hinge_range=(0.595, 0.6), loads=[floor])
        alpha = min(Strip(wall, 0.6, below).multiplier() for below in (True, False))
        check = dd.check_ntc(wall, AQUILA)
        found = [row.value for row in check.rows if row.quantity == "alpha_0"]
        assert found[-1] == pytest.approx(alpha, rel=1e-8)


def test_ties_hold_outwards(root):
    """A strip that is let go on its inner side moves as one without ties; from outside a tie brings it back sooner."""
    record = dd.Record(np.zeros(3000), 0.002, name="still")
    bare = dd.TwoBlockWall(4.0, 0.3, hinge=0.7, overburden=3e3, overburden_inertia=0, restitution_value=0.8)
    held = dataclasses.replace(bare, ties=[tie(2e4, 2.8, 0.15)])
    first = {}
    for sign in (-1.0, 1.0):
        traces = [
            dd.simulate(
                wall,
                record,
                scale=1.0,
                initial_rotation=sign * 0.3 * wall.capacity_angle,
                solver=dd.Solver(engine="rk45"),
            )
            for wall in (bare, held)
        ]
        first[sign] = [trace.time[trace.after_impact][0] for trace in traces]
    assert first[-1.0][1] == pytest.approx(first[-1.0][0], rel=1e-9)
    assert first[1.0][0] == pytest.approx(first[-1.0][0], rel=1e-9)
    assert first[1.0][1] < 0.8 * first[1.0][0]


def test_engines_agree(root):
    """Both engines give the same motion of a strip with everything on it, which no tie holds on its inner side."""
    records = dd.read_catalogue(root / "data/records/synthetic44.csv")[:12]
    floor = {"loads": [dd.Load(8e3, depth=0.25, height=2.5, inertia="both")], "thrusts": [dd.Thrust(150.0, height=2.5)]}
    for height in (2.5, 4.0):
        wall = dd.TwoBlockWall(
            5.0, 0.35, hinge=0.6, overburden=5e3, overburden_inertia=0.5, restitution_factor=0.9,
            ties=[dd.Tie(height, depth=0.1, area=2e-5, length=8.0)], **floor,
        )  # fmt: skip
        peaks = [
            dd.multiple_stripe(wall, records, levels=[0.5, 0.8], polarity="both", progress=False,
                               solver=dd.Solver(engine=engine)).edp
            for engine in ("rk45", "lanes")
        ]  # fmt: skip
        # The tie yields, and breaks, in many of them
        assert np.median(peaks[0]) > wall.capacity_angle * 0.1
        assert peaks[0] == pytest.approx(peaks[1], rel=1e-5, abs=1e-7)
    sure = dd.multiple_stripe(wall, records[:4], levels=[0.8], polarity="both", progress=False, certify=True,
                              solver=dd.Solver(engine="rk45"))  # fmt: skip
    assert sure.edp.max() > 0.0
