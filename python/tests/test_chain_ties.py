"""Ties of chains: walls of dondolo with ties as chains, an independent integration, the check, files and refusals."""

import math
import subprocess

import matplotlib
import numpy as np
import pytest
from numpy.polynomial import Chebyshev
from scipy.integrate import solve_ivp
from test_rigid_chains import CHAINS, HALVES, SITE, G, body, portal_joint, rectangle

import dondolo as dd

matplotlib.use("agg")

BAR = {"area": 5e-5, "length": 8.0, "strength": 1.6e8, "strain": 0.004}
# Between the head of the right pier of the portal and the ground on its left: 12.4 kN
ROD = dd.PointTie(3, (1.5, 3.5), area=6.2e-5, length=5.0, strength=2.0e8, strain=0.02)


def portal(**more):
    return dd.Chain(**{**CHAINS["portal"], "sides": 1, "restitution_value": 0.6} | more)


def facade(*ties):
    """A facade, and the same as a chain."""
    wall = dd.OneSidedWall(4.0, 0.4, density=1800.0, hinge_depth=0.02, ties=[dd.Tie(**one) for one in ties])
    chain = dd.Chain(
        height=4.0, sides=1, restitution_value=wall.restitution_coefficient,
        bodies=[body(rectangle(-0.4, 0.0, 0.0, 4.0, 1800.0))], joints=[dd.Pin(1, 0, (-0.02, 0.0))],
        ties=[dd.PointTie(1, (-one["depth"], one["height"]), **{name: one[name] for name in
                          ("area", "length", "strength", "strain", "preload")}) for one in ties],
    )  # fmt: skip
    return wall, chain


def strip():
    """A strip with a tie on each of its blocks, and the same as a chain."""
    places = (0.05, 1.2, 1), (0.1, 2.4, 2)
    ties = [dd.Tie(height, depth=depth, **BAR) for depth, height, _body in places]
    wall = dd.TwoBlockWall(3.0, 0.25, hinge=0.6, hinge_depth=0.02, ties=ties)
    chain = dd.Chain(
        height=3.0, sides=2, restitution_value=wall.restitution_coefficient, bodies=HALVES,
        joints=[dd.Pin(1, 0, (-0.02, 0.0)), dd.Pin(1, 2, (-0.23, 1.8)), dd.Guide(2, 0, (-0.02, 3.0))],
        ties=[dd.PointTie(number, (-depth, height), **BAR) for depth, height, number in places],
    )  # fmt: skip
    return wall, chain


def motions(count=6):
    return dd.synthetic_records(6.5, 10.0, "shallow", n_records=count)


TIES = (
    {"height": 3.8, "depth": 0.0, "preload": 2e7} | BAR,
    {"height": 2.5, "depth": 0.1, "preload": 0.0} | BAR | {"strain": 0.01},
)


@pytest.mark.parametrize("pair", [facade(*TIES), strip()], ids=["facade", "strip"])
@pytest.mark.parametrize("engine", ["lanes", "rk45"])
def test_walls_with_ties_as_chains(pair, engine):
    """Terms to 12 digits, histories and what they do to the ties."""
    wall, chain = pair
    q = np.linspace(0.0, 0.9 * wall.capacity_angle, 9)
    for one, other in zip(chain.terms(q), wall.terms(q), strict=True):
        np.testing.assert_allclose(one, other, rtol=0.0, atol=1e-12 * wall.terms(0.0).inertia)
    levels, solver = (0.3, 0.6, 1.0, 1.6), dd.Solver(engine=engine, rtol=1e-10)
    found, expected = (
        dd.multiple_stripe(one, motions(), levels, solver=solver, progress=False) for one in (chain, wall)
    )
    np.testing.assert_allclose(found.edp, expected.edp, rtol=0.0, atol=1e-8)
    assert found.broken_ties.shape == (len(levels), 2)
    assert found.broken_ties.tolist() == expected.broken_ties.tolist()
    assert 0.0 < found.broken_ties.mean() < 1.0
    np.testing.assert_allclose(found.ties.largest_elongation, expected.ties.largest_elongation, rtol=1e-6, atol=1e-10)
    assert chain.greatest_acceleration == pytest.approx(wall.greatest_acceleration, rel=1e-12)


def test_an_elastic_end_tie_of_horizontal_bending():
    """Travel y of the thrust point and its rate, of another program in 30 digits."""
    tie = dd.PointTie(2, (-0.01, 4.0), area=1e-6, length=1.0, angle=90.0, strength=1e10, modulus=1e12, strain=0.5)
    bare, tied = (
        dd.Chain(**{**CHAINS["horizontal"], "sides": 1, "restitution_value": 0.7}, ties=ties) for ties in ([], [tie])
    )
    for q, y, rate in (
        (0.01, 0.009308552557058132, 0.9061527253559692),
        (0.05, 0.04160045743127027, 0.7084067213228205),
    ):
        held = bare.terms(q).load_force - tied.terms(q).load_force
        assert held == pytest.approx(1e6 * y * rate, rel=1e-12)


class Linkage:
    """The portal as a linkage of four hinges, from its geometry alone: by Newton's method and implicit derivatives."""

    def __init__(self):
        self.hinges = [np.array(portal_joint(2, False)), np.array(portal_joint(5, True)),
                       np.array(portal_joint(7, False)), np.array([2.5, 0.0])]  # fmt: skip
        bodies = []
        for stones in ((2, 3, 4), (5, 6), (7, 8)):
            parts = []
            for i in stones:
                half, middle = math.radians(11.25), math.radians(191.25 - 22.5 * i)
                mass = 1900.0 * half * (2.0**2 - 1.5**2)
                reach = 2.0 / 3.0 * (2.0**3 - 1.5**3) / (2.0**2 - 1.5**2) * math.sin(half) / half
                at = np.array([reach * math.cos(middle), 3.5 + reach * math.sin(middle)])
                polar = 1900.0 * half * (2.0**4 - 1.5**4) / 2.0 - mass * reach**2
                parts.append((mass, at, polar))
            bodies.append(parts)
        bodies[2].append((1900.0 * 3.5, np.array([2.0, 1.75]), 1900.0 * 3.5 * (1.0 + 3.5**2) / 12.0))
        self.masses = [sum(mass for mass, _, _ in parts) for parts in bodies]
        self.centres = [
            sum(mass * at for mass, at, _ in parts) / whole for parts, whole in zip(bodies, self.masses, strict=True)
        ]
        self.inertias = [
            sum(polar + mass * np.sum((at - centre) ** 2) for mass, at, polar in parts)
            for parts, centre in zip(bodies, self.centres, strict=True)
        ]

    @staticmethod
    def turned(offset, angle):
        c, s = math.cos(angle), math.sin(angle)
        return np.array([offset[0] * c + offset[1] * s, offset[1] * c - offset[0] * s])

    @staticmethod
    def across(r):
        return np.array([r[1], -r[0]])

    def state(self, q):
        """Places and rates of centroids and of the anchor, turns' rates."""
        h = self.hinges
        spans = [h[1] - h[0], h[2] - h[1], h[3] - h[2]]
        a, b = 0.0, 0.0
        change = np.ones(2)
        while np.abs(change).max() > 1e-13:
            r = [self.turned(span, angle) for span, angle in zip(spans, (q, a, b), strict=True)]
            gap = h[0] + sum(r) - h[3]
            change = np.linalg.solve(np.column_stack([self.across(r[1]), self.across(r[2])]), gap)
            a, b = np.array([a, b]) - change
        r = [self.turned(span, angle) for span, angle in zip(spans, (q, a, b), strict=True)]
        matrix = np.column_stack([self.across(r[1]), self.across(r[2])])
        rates = np.r_[1.0, np.linalg.solve(matrix, -self.across(r[0]))]
        origins = [h[0], h[0] + r[0], h[0] + r[0] + r[1]]
        moving = [np.zeros(2), self.across(r[0]), self.across(r[0]) + rates[1] * self.across(r[1])]
        points = []
        for k, at in [*enumerate(self.centres), (2, np.array([1.5, 3.5]))]:
            arm = self.turned(at - h[k], (q, a, b)[k])
            points.append((origins[k] + arm, moving[k] + rates[k] * self.across(arm)))
        return points, rates

    def terms(self, q):
        """J, L, V' of gravity; travel D and lever X of the tie."""
        points, rates = self.state(q)
        j = sum(m * np.sum(v**2) for m, (_, v) in zip(self.masses, points, strict=False))
        j += sum(i * rate**2 for i, rate in zip(self.inertias, rates, strict=True))
        lever = sum(m * v[0] for m, (_, v) in zip(self.masses, points, strict=False))
        moment = G * sum(m * v[1] for m, (_, v) in zip(self.masses, points, strict=False))
        return j, lever, moment, points[-1][0][0] - 1.5, points[-1][1][0]

    def curves(self, last):
        """The terms as polynomials of a high degree, and the slope of J."""
        nodes = 0.5 * last * (1.0 - np.cos(np.pi * (np.arange(64) + 0.5) / 64))
        values = np.array([self.terms(q) for q in nodes])
        found = [Chebyshev.fit(nodes, column, 56, domain=[0.0, last]) for column in values.T]
        return [*found, found[0].deriv()]


def integrated(ground, dt, restitution):
    """Largest rotation of the portal with its rod, and its plastic elongation."""
    curves = Linkage().curves(0.13)

    def travel(q):
        return float(curves[3](q))

    def acceleration(q, v, ground, pull):
        j, lever, moment, _, x, slope = (curve(q) for curve in curves)
        return float((-lever * ground - moment - pull * x - 0.5 * slope * v**2) / j)

    stiffness, strength = 2.06e11 * ROD.area / ROD.length, ROD.strength * ROD.area
    q, v, plastic, largest, mode = 0.0, 0.0, 0.0, 0.0, "elastic"

    def force(d):
        if mode == "flows":
            return strength
        return max(0.0, stiffness * (d - plastic)) if mode == "elastic" else 0.0

    for k in range(len(ground) - 1):
        t, end = 0.0, dt
        for _ in range(50):
            if t >= end:
                break

            def ground_at(time, k=k):
                return ground[k] + (ground[k + 1] - ground[k]) * time / dt

            if q <= 0.0 and v <= 0.0 and acceleration(0.0, 0.0, ground_at(t), force(0.0)) <= 0.0:
                # At rest until the ground pushes it
                if acceleration(0.0, 0.0, ground_at(end), force(0.0)) <= 0.0:
                    q, v, t = 0.0, 0.0, end
                    continue
                low, high = t, end
                for _halving in range(60):
                    middle = 0.5 * (low + high)
                    pushed = acceleration(0.0, 0.0, ground_at(middle), force(0.0)) > 0.0
                    low, high = (low, middle) if pushed else (middle, high)
                q, v, t = 0.0, 0.0, high

            def hits(_t, y):
                return y[0]

            def changes(_t, y, mode=mode, plastic=plastic):
                if mode == "flows":
                    return y[1]
                return travel(y[0]) - (plastic if mode == "slack" else plastic + strength / stiffness)

            def slackens(_t, y, mode=mode, plastic=plastic):
                return travel(y[0]) - plastic + (1.0 if mode != "elastic" or plastic == 0.0 else 0.0)

            hits.terminal = changes.terminal = slackens.terminal = True
            hits.direction = slackens.direction = -1.0
            changes.direction = -1.0 if mode == "flows" else 1.0
            step = solve_ivp(
                lambda time, y: [y[1], acceleration(y[0], y[1], ground_at(time), force(travel(y[0])))],
                (t, end), [q, v], method="DOP853", rtol=1e-9, atol=1e-12, events=[hits, changes, slackens],
            )  # fmt: skip
            t, (q, v) = step.t[-1], step.y[:, -1]
            largest = max(largest, float(step.y[0].max()))
            assert largest < 0.12
            if step.t_events[0].size:
                q, v = 0.0, -restitution * v
                if v < 1e-6:
                    v = 0.0
                # A tie that has stretched hangs slack at rest
                mode = "slack" if plastic > 0.0 else "elastic"
            elif step.t_events[1].size:
                if mode == "elastic":
                    mode = "flows"
                elif mode == "slack":
                    mode = "elastic"
                else:
                    mode, plastic = "elastic", travel(q) - strength / stiffness
            elif step.t_events[2].size:
                mode = "slack"
    return largest, plastic


@pytest.mark.parametrize("engine", ["lanes", "rk45"])
def test_an_independent_integration(engine):
    """The portal with a rod, from the geometry of its four hinges alone."""
    time = np.arange(0.0, 1.6001, 0.01)
    ground = np.r_[-3.7 * np.sin(2.0 * np.pi * time / 0.8), np.zeros(60)]
    largest, plastic = integrated(ground, 0.01, 0.6)
    wall = portal(ties=[ROD])
    record = dd.Record(np.r_[ground, np.zeros(300)], 0.01, name="sine")
    response = dd.simulate(wall, record, solver=dd.Solver(engine=engine, rtol=1e-11))
    assert 0.15 < largest / wall.capacity_angle < 0.9
    assert plastic > 1e-3
    assert response.edp * wall.capacity_angle == pytest.approx(largest, rel=1e-9)
    assert response.ties.plastic_elongation[0] == pytest.approx(plastic, rel=1e-8)


def test_check():
    """The rod holds with its yield force, and is left out of the curves without it."""
    bare, wall = portal(), portal(ties=[ROD])
    sheets = [dd.check_ntc(one, SITE, knowledge_factor=1.35) for one in (bare, wall)]
    values = [{row.quantity: row.value for row in one.rows if row.method == "mechanism"} for one in sheets]
    lever = (bare.motion(1e-6).x[2] - bare.motion(0.0).x[2]) / 1e-6  # of the centroid of the pier
    turn = (bare.motion(1e-6).turn[2] - bare.motion(0.0).turn[2]) / 1e-6
    lever += turn * (3.5 - bare.motion(0.0).y[2])
    (item,) = [one for one in sheets[1].items if one.item == "tie 1"]
    assert item.force == pytest.approx(6.2e-5 * 2e8, rel=1e-14)
    assert item.lever == pytest.approx(lever, rel=1e-5)
    first = sum(one.force_lever for one in sheets[0].items if math.isfinite(one.force_lever))
    assert values[1]["alpha_0"] == pytest.approx(values[0]["alpha_0"] + item.force * item.lever / first, rel=1e-12)
    assert sheets[1].value("tie", "", "tie_force_per_m", item="tie 1") == pytest.approx(12.4e3, rel=1e-14)
    assert {row.unit for row in sheets[1].rows if row.quantity == "tie_force_per_m"} == {"N"}
    assert sheets[1].open_ties == {"tie 1": ("anchor_checked",)}


def test_between_two_bodies():
    """A chord across the springings of an arch on piers: its travel is that of the distance of its ends."""
    ring = dd.arch(1.75, 0.5, 180.0, voussoirs=8, pier=(1.0, 3.5), density=1900.0, sides=1, restitution_value=0.5)
    tables = {name: getattr(ring, name) for name in ("body_table", "joint_table")}
    chord = dd.PointTie(3, (1.6, 3.3), area=1e-4, length=3.0, other=1, other_at=(-1.2, 4.5))
    wall = dd.Chain(height=ring.height, sides=1, restitution_value=0.5, **tables, ties=[chord])
    q = np.linspace(0.0, 0.8 * wall.capacity_angle, 5)

    def apart(rotation):
        one, other = wall._moved([chord.at], 3, rotation)[0], wall._moved([chord.other_at], 1, rotation)[0]
        return math.dist(one, other)

    stiffness = 2.06e11 * 1e-4 / 3.0
    held = ring.terms(q).load_force - wall.terms(q).load_force
    for rotation, force in zip(q, held, strict=True):
        step = 1e-5
        travel = apart(rotation) - apart(0.0)
        lever = (apart(rotation + step) - apart(max(0.0, rotation - step))) / (step + min(step, rotation))
        assert force == pytest.approx(stiffness * travel * lever, rel=1e-4, abs=1e-3)


def test_what_a_table_leaves_out(root):
    """Numbers of a bar whose columns are empty, or not there, are those of ties of other walls."""
    wall = dd.read_case(root / "data/cases/tied_portal.nml").population[0]
    assert list(wall.tie_table[7:]) == [3.1e-4, 5.0, 2.06e11, 1.8e8, 0.0, 0.02, 0.0]


def test_files(executable, root, tmp_path):
    """Tables of ties give the same wall in a case, whose results, report and drawing have them."""
    wall = portal(ties=[ROD, dd.PointTie(2, (0.5, 5.4), area=5e-5, length=4.0, anchor_force=5e3)], name="tied")
    wall.write_tables(tmp_path / "tied")
    files = ", ".join(f"{name} = 'tied_{name}.csv'" for name in ("bodies", "joints", "ties"))
    (tmp_path / "case.nml").write_text(
        "&job output = 'out/tied' /\n&wall name = 'tied', mechanism = 'chain', height = 5.5, sides = 1\n"
        f"restitution_value = 0.6, {files} /\n"
        f"&records catalogue = '{root}/data/records/synthetic44.csv' /\n"
        "&stripes levels = 0.4, 0.8 /\n&check ag = 0.104, 0.261, 0.334, f0 = 2.332, 2.364, 2.4,"
        " tc_star = 0.281, 0.347, 0.364, soil = 'B' /\n"
    )
    case = dd.read_case(tmp_path / "case.nml")
    # Roundings of zero are 0 in files.
    (read,) = case.population
    for table in ("body_table", "joint_table", "tie_table"):
        np.testing.assert_allclose(getattr(read, table), getattr(wall, table), rtol=0.0, atol=1e-11)
    assert read.tie_table == wall.tie_table
    subprocess.run([executable, "--quiet", "case.nml"], cwd=tmp_path, check=True)
    stored = dd.read_results(tmp_path / "out/tied")
    assert np.asarray(stored.stripes.wall.tie_table).tolist() == np.asarray(wall.tie_table).tolist()
    assert stored.stripes.broken_ties.shape == (2, 2)
    dd.report(stored, tmp_path / "report.html", lang="it")
    assert "catena" in (tmp_path / "report.html").read_text(encoding="utf-8")
    for lang in ("en", "it"):
        dd.calculation_report(stored, tmp_path / "pages.html", lang=lang)
        text = (tmp_path / "pages.html").read_text(encoding="utf-8")
        # Forces of a whole body, and steps that give the numbers of the check
        assert "kN/m<" not in text
        assert "per metro" not in text
        assert ("do not give" if lang == "en" else "non danno") not in text
    ax = wall.plot(rotation=0.05)
    assert any("tie 0.62 cm²" in text.get_text() for text in ax.texts)


STRIP = {
    "height": 3.0, "sides": 1, "restitution_value": 0.9, "bodies": HALVES,
    "joints": [dd.Pin(1, 0, (0.0, 0.0)), dd.Pin(1, 2, (-0.25, 1.8)), dd.Guide(2, 0, (0.0, 3.0))],
}  # fmt: skip


def rod(body, at, **more):
    return dd.PointTie(body, at, **{"area": 1e-4, "length": 5.0} | more)


@pytest.mark.parametrize(
    ("tie", "words"),
    [
        (rod(3, (0.0, 1.8)), "tie 1 is between 3 and 0, must be between one of 2 bodies"),
        (rod(1, (0.0, 1.8), area=100.0), "tie 1 has area = 100, must lie between 1e-8 and 0.1: is it in mm2"),
        (rod(1, (0.0, 1.8), length=0.0), "tie 1 has length = 0, must lie between 0.1 and 1000"),
        (rod(1, (0.0, 1.8), strength=180.0), "strength = 180, .*: is it in MPa"),
        (rod(1, (0.0, 1.8), preload=2e8), "preload = 200000000, must be less than its strength"),
        (rod(1, (0.0, 1.8), preload=1e8, anchor_force=5e3), "at which its anchor gives way"),
        (rod(1, (0.0, 1.8), strain=5e-4), "strain = 0.0005, must be more than 0.000873"),
        (rod(1, (2.0, 1.8)), "tie 1 at depth -2 m, height 1.8 m is 2 m off body 1"),
        (rod(1, (0.0, 1.8), angle=180.0), "tie 1 would become shorter before the chain has turned"),
        (rod(1, (0.0, 1.0), angle=30.0, other=2, other_at=(0.0, 2.5)),
         "tie 1 has an angle, which only ties to the ground have"),
        (rod(1, (0.0, 1.8), other=2, other_at=(0.0, 1.8)), "tie 1 has both its ends at one point"),
    ],
)  # fmt: skip
def test_refusals(tie, words):
    with pytest.raises(dd.errors.InputError, match=words):
        dd.Chain(**STRIP, ties=[tie])


def test_more_refusals():
    with pytest.raises(dd.errors.InputError, match="other_at: must be given with other"):
        dd.PointTie(1, (0.0, 1.8), area=1e-4, length=5.0, other=2)
    with pytest.raises(dd.errors.InputError, match="anchor_force = 0: must be positive"):
        dd.Chain(**STRIP, ties=[dd.PointTie(1, (0.0, 1.8), area=1e-4, length=5.0, anchor_force=0.0)])
    chord = dd.PointTie(1, (0.0, 1.0), area=1e-4, length=5.0, other=2, other_at=(0.0, 2.5))
    with pytest.raises(dd.errors.InputError, match="tie 1 between two bodies would act to both sides"):
        dd.Chain(**STRIP | {"sides": 2}, ties=[chord])
    with pytest.raises(dd.errors.InputError, match="tie_table: has 3 values, must have rows of 14"):
        dd.Chain(**STRIP, tie_table=[1.0, 0.0, 0.0])
    with pytest.raises(dd.errors.InputError, match=r"ties: must be dondolo\.PointTie, not Tie"):
        dd.Chain(**STRIP, ties=[dd.Tie(2.0, area=1e-4, length=5.0)])
