"""Friction of transverse walls: its force, its effect at rest and in motion against another integration, refusals."""

from dataclasses import replace

import matplotlib
import numpy as np
import pytest
from scipy.integrate import solve_ivp

import dondolo as dd

matplotlib.use("Agg")

G = 9.81
# 18 kN/m3, as the value of the force that is known
DENSITY = 18000.0 / G
OVERLAP = dd.Interlock(overlap=0.12, course=0.10, thickness=0.25, spacing=5.0)
# Of one transverse wall of 3 m [N]
FORCE = 11590.776
TIGHT = dd.Solver(rtol=1e-12, atol=1e-14)


def wall(**more):
    return dd.OneSidedWall(3.0, 0.25, density=DENSITY, **{"interlock": OVERLAP} | more)


BARE = dd.OneSidedWall(3.0, 0.25, density=DENSITY)


class Reference:
    """The wall of 3 m by 0.25 m and friction, by SciPy's Runge-Kutta method of eighth order from event to event.

    At rest, moving outwards with friction where it has not been, moving freely, or held by friction where it turned.
    """

    def __init__(self, force, travel, samples, dt):
        self.height, self.thickness = 3.0, 0.25
        self.mass = DENSITY * self.height * self.thickness
        self.inertia = self.mass * (self.height**2 + self.thickness**2) / 3.0
        self.force, self.travel, self.place = force, travel, (self.thickness, self.height / 3.0)
        self.samples, self.dt = np.append(samples, 0.0), dt
        self.largest, self.visited = 0.0, set()

    def ground(self, t):
        return np.interp(t, self.dt * np.arange(len(self.samples)), self.samples)

    def acceleration(self, t, q, rubs):
        s, c, (d, z) = np.sin(q), np.cos(q), self.place
        moment = 0.5 * self.mass * G * (self.thickness * c - self.height * s)
        lever = 0.5 * self.mass * (self.height * c + self.thickness * s)
        if rubs:
            slid = z * s + d * (1.0 - c)
            moment += self.force * max(0.0, 1.0 - slid / self.travel) * (z * c + d * s)
        return -(moment + lever * self.ground(t)) / self.inertia

    def run(self, restitution, limit):
        """The largest rotation, at most the limit."""
        state, q, v, t, end = "rest", 0.0, 0.0, 0.0, self.dt * (len(self.samples) - 2)
        for following in self.dt * np.arange(1, len(self.samples) - 1):
            while t < following:
                self.visited.add(state)
                if state in ("rest", "stick"):
                    q, v = (self.largest if state == "stick" else 0.0), 0.0
                    state, t = self.wait(state, q, t, following)
                    continue
                state, q, v, t = self.move(state, q, v, t, following, restitution, limit)
                if q >= limit:
                    return limit
        assert t == pytest.approx(end)
        return self.largest

    def wait(self, state, q, t, following):
        """Stay at rest, or where friction holds, until one of the two accelerations changes its sign."""
        virgin = state == "stick" or self.largest == 0.0
        out = self.zero(t, following, q, virgin, 1.0)
        back = self.zero(t, following, q, False, -1.0) if state == "stick" else np.inf
        if min(out, back) >= following:
            return state, following
        return ("slides" if virgin and out < back else "moves"), min(out, back)

    def zero(self, t, following, q, rubs, sign):
        """When an acceleration that is linear in time has a sign."""
        now, then = (sign * self.acceleration(at, q, rubs) for at in (t, following))
        if now > 0.0:
            return t
        return t + (following - t) * now / (now - then) if then > 0.0 else np.inf

    def move(self, state, q, v, t, following, restitution, limit):
        """Move to the next event."""
        rubs = state == "slides"

        def turns(_, y):
            return y[1]

        def strikes(_, y):
            return y[0]

        def comes_back(_, y):
            return y[0] - self.largest

        def falls(_, y):
            return y[0] - limit

        turns.direction, strikes.direction, comes_back.direction, falls.direction = -1, -1, 1, 1
        events = [turns if rubs else strikes, falls if rubs else comes_back]
        for event in events:
            event.terminal = True
        found = solve_ivp(
            lambda at, y: (y[1], self.acceleration(at, y[0], rubs)),
            (t, following),
            (q, v),
            method="DOP853",
            rtol=1e-12,
            atol=1e-15,
            max_step=self.dt / 4,
            events=events,
        )
        t, (q, v) = found.t[-1], found.y[:, -1]
        if found.status == 0:
            self.largest = max(self.largest, q)
            return state, q, v, following
        if len(found.t_events[1]):
            return ("falls", limit, v, t) if rubs else ("slides", self.largest, v, t)
        if rubs:
            self.largest = max(self.largest, q)
            return ("stick" if self.acceleration(t, q, False) > 0.0 else "moves"), self.largest, 0.0, t
        v = abs(restitution * v)
        return ("rest" if v < 1e-9 else "moves"), 0.0, v, t


def test_force_and_statics():
    lever = DENSITY * 0.75 * 1.5
    alpha = 0.25 / 3.0
    force = FORCE / 5.0
    assert BARE.trigger_acceleration / G == pytest.approx(alpha, rel=1e-12)
    held = wall()
    expected = alpha + force * 1.0 / (G * lever)
    assert held.trigger_acceleration / G == pytest.approx(expected, rel=1e-12)
    assert held.plastic_acceleration / G == pytest.approx(expected, rel=1e-12)
    assert held.greatest_acceleration / G == pytest.approx(expected, rel=1e-12)
    assert held.trigger_acceleration / BARE.trigger_acceleration == pytest.approx(2.4, abs=0.03)
    assert held.capacity_angle == BARE.capacity_angle
    assert held.frequency_parameter == pytest.approx(BARE.frequency_parameter, rel=1e-12)
    # A height that whole courses do not fill
    assert wall(interlock=replace(OVERLAP, course=0.11)).trigger_acceleration / G == pytest.approx(
        alpha + 0.4 * 27 * 28 * 0.11 * 0.12 * 0.577 * 0.25 * 18000.0 / 5.0 / (G * lever), rel=1e-12
    )
    half = wall(interlock=replace(OVERLAP, friction=0.577 / 2.0))
    assert half.trigger_acceleration / G - alpha == pytest.approx((expected - alpha) / 2.0, rel=1e-12)


@pytest.fixture(scope="module")
def records():
    rng = np.random.default_rng(19)
    pulses = [np.cumsum(rng.normal(0.0, 1.0, 60)) * np.hanning(60) for _ in range(12)]
    return [dd.Record(3.0 * a / np.abs(a).max(), 0.05, name=f"pulses {i}") for i, a in enumerate(pulses)]


def test_against_an_integration_of_its_own(records):
    """Largest rotations of walls that slide, stick, come back and slide on."""
    visited, slid = set(), 0
    held = wall()
    for record in records:
        for scale in (0.8, 1.0, 1.5):
            found = dd.simulate(held, record, scale, solver=TIGHT, history=False)
            reference = Reference(FORCE / 5.0, 0.12, scale * record.acceleration, record.dt)
            largest = reference.run(held.restitution_coefficient, held.capacity_angle)
            visited |= reference.visited
            if found.collapsed or largest >= held.capacity_angle:
                assert found.collapsed == (largest >= held.capacity_angle)
                continue
            slid += largest > 0.0
            # The reference ends with the record
            if found.time_of_peak < record.duration:
                assert found.edp * held.capacity_angle == pytest.approx(largest, abs=1e-9)
    assert visited >= {"rest", "slides", "moves", "stick"}
    assert slid >= 10


def test_the_trigger_of_the_picture_is_that_of_the_first_motion(records):
    for one, words in ((wall(), "trigger, first motion"), (BARE, "trigger acceleration")):
        above, below = dd.simulate(one, records[0]).plot().figure.axes
        assert above.get_legend_handles_labels()[1] == [words]
        assert words in [text.get_text() for text in below.get_legend().get_texts()]


def test_limits(records):
    """Friction of nothing is no friction; it helps, and a wall that has moved starts like a bare one."""
    nothing = wall(interlock=replace(OVERLAP, friction=1e-12))
    for record in records[:4]:
        bare = dd.simulate(BARE, record, solver=TIGHT, history=False)
        assert dd.simulate(nothing, record, solver=TIGHT, history=False).edp == pytest.approx(bare.edp, abs=1e-9)
    pulse = dd.Record([0.0, -2.0, -2.0, 0.0, 0.0, 0.0, 0.0, 0.0, -1.0, -1.0, 0.0, 0.0, 0.0], 0.1, name="two pulses")
    first = dd.simulate(wall(), pulse, 1.0)
    assert first.edp > 0.0
    moving = np.abs(first.rotation[first.time > 0.82]) > 0.0
    assert moving.any()
    assert dd.simulate(wall(), pulse, 0.6).edp == 0.0


def test_first_swing():
    """Launched at rest by a jump of the ground: work of the friction F D (1 - D/(2 l)) until it turns."""
    held = wall()
    response = dd.simulate(held, dd.Record([0.0, -2.4, -2.4, -2.4, 0.0, 0.0], 0.02, name="jump"), 1.0, solver=TIGHT)
    rotation, velocity = response.rotation, response.velocity
    after = np.argmin(np.abs(response.time - 0.08))
    q, peak = rotation[after], response.edp * held.capacity_angle
    assert velocity[after] > 0.0
    terms = held.terms(0.0)
    mass = DENSITY * 0.75

    def energy(at):
        slid = np.sin(at) + 0.25 * (1.0 - np.cos(at))
        return mass * G * 0.5 * (3.0 * np.cos(at) + 0.25 * np.sin(at)) + FORCE / 5.0 * slid * (1.0 - slid / 0.24)

    kinetic = 0.5 * mass * (9.0 + 0.0625) / 3.0 * velocity[after] ** 2
    assert energy(peak) - energy(q) == pytest.approx(kinetic, rel=1e-9)
    assert terms.inertia == pytest.approx(mass * (9.0 + 0.0625) / 3.0, rel=1e-12)


def test_with_ties(records):
    """Both hold a wall: forces at rest add up, and neither knows of the other."""
    ties = [dd.Tie(2.8, area=1e-5, length=6.0, preload=2e7)]
    both, tied = wall(ties=ties), dd.OneSidedWall(3.0, 0.25, density=DENSITY, ties=ties)
    assert both.plastic_acceleration - tied.plastic_acceleration == pytest.approx(
        wall().plastic_acceleration - BARE.plastic_acceleration, rel=1e-12
    )
    response = dd.simulate(both, records[0], 1.5)
    assert response.ties.broken.shape == (1,)
    assert response.tie_times.shape == (1, 2)
    stripes = dd.multiple_stripe(both, records, [0.2, 0.4], progress=False)
    assert stripes.broken_ties.shape == (2, 1)
    assert dd.multiple_stripe(wall(), records, [0.2], progress=False).broken_ties.shape == (1, 0)


def test_tolerances(records):
    held = wall()
    usual = dd.multiple_stripe(
        held, records, [0.15, 0.25, 0.35], polarity="both", progress=False, solver=dd.Solver(engine="lanes")
    )
    tight = dd.multiple_stripe(
        held, records, [0.15, 0.25, 0.35], polarity="both", progress=False, solver=dd.Solver(rtol=1e-13, atol=1e-15)
    )
    assert np.array_equal(usual.collapsed, tight.collapsed)
    assert np.abs(usual.edp - tight.edp).max() < 1e-6


def test_a_motion_that_friction_holds_in_both_engines(records):
    """The rows of a time history at the samples, and where it is held the same rotation in all of them."""
    held = 0
    for record in records:
        motions = [
            dd.simulate(wall(), record, 1.5, solver=dd.Solver(rtol=1e-12, atol=1e-14, engine=engine))
            for engine in ("lanes", "rk45")
        ]
        assert motions[0].edp == pytest.approx(motions[1].edp, abs=1e-9)
        times = record.dt * np.arange(len(record.acceleration))
        times = times[times < min(motion.time[-1] for motion in motions)]
        lanes, rk45 = (motion.rotation[np.abs(motion.time[:, None] - times).argmin(axis=0)] for motion in motions)
        assert lanes == pytest.approx(rk45, abs=1e-8)
        stays = (np.diff(motions[0].rotation) == 0.0) & (motions[0].rotation[1:] > 0.0)
        held += stays.any()
    assert held


def test_hinge_level():
    """Above a hinge there are fewer courses."""
    above = dd.OneSidedWall(6.0, 0.25, density=DENSITY, hinge_level=3.0, interlock=OVERLAP)
    assert above.trigger_acceleration == pytest.approx(wall().trigger_acceleration, rel=1e-12)


def test_what_the_executable_says(run, tmp_path):
    (tmp_path / "shaking.txt").write_text("0\n-3\n-3\n0\n0\n")
    (tmp_path / "records.csv").write_text("file,dt_s,units\nshaking.txt,0.1,m/s2\n")
    words = "interlock_overlap = 0.12, interlock_course = 0.1, interlock_thickness = 0.25, interlock_spacing = 5"
    case = tmp_path / "case.nml"
    case.write_text(
        f"&job task = 'stripes' output = '{tmp_path}/out' /\n&wall mechanism = 'one_sided', height = 3, "
        f"thickness = 0.25, density = {DENSITY}, {words} /\n"
        "&records catalogue = 'records.csv' /\n&stripes levels = 0.2, 0.6 /\n"
    )
    plan = run("--check", case).stdout
    assert "2318 N/m of transverse walls, 1 m high, gone at 0.11" in plan
    assert "first motion at 0.1978 g" in plan
    run(case)
    assert not (tmp_path / "out_ties.csv").exists()
    assert dd.read_results(tmp_path / "out").stripes.wall.interlock == OVERLAP


@pytest.mark.parametrize(
    ("change", "sentence"),
    [
        (
            {"interlock": replace(OVERLAP, course=3.5)},
            r"interlock\.course = 3.5: must be at most 3 m, the height of the",
        ),
        ({"interlock": replace(OVERLAP, overlap=0.0)}, r"interlock\.overlap = 0: must be positive"),
        ({"leaves": 2}, r"interlock\.overlap = .*: not with leaves = 2"),
    ],
)
def test_refusals(change, sentence):
    with pytest.raises(dd.errors.InputError, match=sentence):
        wall(**change)


def test_other_mechanisms():
    with pytest.raises((dd.errors.InputError, TypeError)):
        dd.FreeStandingWall(3.0, 0.25, interlock=OVERLAP)


def test_drawing():
    assert any("friction" in text.get_text() for text in wall().plot().texts)
