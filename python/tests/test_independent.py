"""dondolo against independent.py: coefficients, restitutions and histories from rigid bodies and hinges."""

import dataclasses
import itertools

import independent
import numpy as np
import pytest

import dondolo as dd

COUNT = 30


def random_pairs(mechanism, **settings):
    """Walls of one mechanism and the same as bodies, always the same ones."""
    rng = np.random.default_rng(20110620)
    for i in range(COUNT):
        height, slenderness = rng.uniform(0.5, 8.0), rng.uniform(3.0, 40.0)
        size = {
            "height": height,
            "thickness": height / slenderness,
            "density": rng.uniform(1200.0, 2600.0),
            "gravity": rng.uniform(1.6, 12.0),
        }
        hinge, weights, place = rng.uniform(0.1, 0.9), rng.uniform(0.0, 4.0), rng.uniform(-1.0, 1.0)
        if mechanism != "two_block":
            kind = dd.OneSidedWall if mechanism == "one_sided" else dd.FreeStandingWall
            yield kind(**size, **settings), independent.block(**size)
            continue
        # Every third without a load, some with it on the hinge
        load = weights * size["density"] * height * size["thickness"] * size["gravity"] if i % 3 else 0.0
        e = (place if i % 5 else 1.0) * size["thickness"] / 2.0 if load else 0.0
        wall = dd.TwoBlockWall(**size, hinge=hinge, overburden=load, overburden_inertia=0.0, eccentricity=e, **settings)
        yield wall, independent.two_blocks(**size, hinge=hinge, load=load, eccentricity=e)


def rotations(wall):
    """Rotations of use, and some on the way to the end of the geometry."""
    end = wall.slenderness_angle + np.pi / 2.0
    if wall.mechanism == "two_block":
        upper = np.hypot((1.0 - wall.hinge) * wall.height, wall.thickness) / 2.0
        end = wall.slenderness_angle + np.arcsin(min(1.0, upper / wall.radius))
    return np.append(np.linspace(0.0, 1.2, 7) * wall.capacity_angle, end * np.array([0.5, 0.8, 0.95]))


def as_arrays(bodies, q, side):
    return independent.Coefficients(*np.array([bodies.coefficients(x, side) for x in q]).T)


MECHANISMS = pytest.mark.parametrize("mechanism", ["one_sided", "free_standing", "two_block"])


def impulse_model(mechanism):
    """Settings that every geometry accepts."""
    return {"restitution": "impulse"} if mechanism == "two_block" else {}


@MECHANISMS
def test_terms(mechanism):
    for i, (wall, bodies) in enumerate(random_pairs(mechanism, **impulse_model(mechanism))):
        q = rotations(wall)
        expected = as_arrays(bodies, q, side=1 if i % 2 else -1)
        for what, value in (*wall.terms(q)._asdict().items(), ("potential", wall.potential(q))):
            right = getattr(expected, what)
            # Terms vanish somewhere (C of one block everywhere), where only a size elsewhere can measure an error.
            size = np.abs(expected.inertia if what == "inertia_rate" else right)[:7].max()
            np.testing.assert_allclose(value, right, rtol=1e-12, atol=1e-13 * size, err_msg=f"{what} of {wall!r}")


@MECHANISMS
def test_acceleration_of_the_constrained_bodies(mechanism):
    rng = np.random.default_rng(1)
    for wall, bodies in random_pairs(mechanism, **impulse_model(mechanism)):
        for side in (1, -1):
            q, speed, ground = rng.uniform(0.0, 1.0) * wall.capacity_angle, rng.normal(), 5.0 * rng.normal()
            z = bodies.position(q, side)
            constrained = bodies.rotation_acceleration(z, bodies.tangent(z, side) * speed, side, ground)
            at = wall.terms(q)
            parts = np.array(
                [
                    -at.inertia_rate * speed**2,
                    -at.restoring_moment,
                    -side * at.excitation_lever * ground,
                    at.load_force,
                ]
            )
            error = abs(parts.sum() / at.inertia - constrained)
            assert error <= 1e-12 * np.abs(parts / at.inertia).max(), wall


@MECHANISMS
def test_static_quantities(mechanism):
    for wall, bodies in random_pairs(mechanism, **impulse_model(mechanism)):
        capacity, at = bodies.capacity(), bodies.coefficients(0.0)
        p = np.sqrt((at.restoring_moment - at.load_force) / (at.inertia * np.sin(capacity)))
        assert wall.trigger_acceleration == pytest.approx(bodies.trigger(), rel=1e-12)
        assert wall.capacity_angle == pytest.approx(capacity, rel=1e-12)
        assert wall.frequency_parameter == pytest.approx(p, rel=1e-12)


@pytest.mark.parametrize(
    ("mechanism", "model", "impact", "sense"),
    [
        ("one_sided", "sorrentino", independent.one_sided, -1.0),
        ("free_standing", "impulse", independent.impulse, 1.0),
        ("two_block", "impulse", independent.impulse, 1.0),
        ("two_block", "sorrentino", independent.base_balance, 1.0),
    ],
)
def test_restitution(mechanism, model, impact, sense):
    bounds = []
    for wall, bodies in random_pairs(mechanism, restitution_value=0.5):
        expected = sense * independent.coefficient(bodies, impact)
        bounds.append(expected)
        changed = {"restitution": model, "restitution_value": None}
        ratio = dataclasses.replace(wall, **changed).restitution_coefficient
        assert ratio == pytest.approx(max(0.0, expected), abs=1e-12), wall
    assert min(bounds) > 0.0
    assert max(bounds) > min(bounds) + 0.01


def test_a_squat_wall_stays_where_it_falls():
    # 1 - 3/2 cos^2 alpha is positive: the balances would push it through the wall behind.
    bodies = independent.block(1.0, 0.8, 1800.0)
    assert independent.coefficient(bodies, independent.one_sided) > 0.0
    assert dd.OneSidedWall(1.0, 0.8).restitution_coefficient == 0.0


# Histories

DT = 0.02
TIME = DT * np.arange(201)
SHAPE = np.sin(2.0 * np.pi * 0.9 * TIME) + 0.7 * np.sin(2.0 * np.pi * 1.7 * TIME + 1.0)
SHAPE = (SHAPE + 0.4 * np.sin(2.0 * np.pi * 3.1 * TIME + 2.0)) * np.sin(np.pi * TIME / TIME[-1])

LOADED = {"hinge": 0.7, "load": 6000.0, "eccentricity": 0.05}
HISTORIES = {
    "two blocks": (
        dd.TwoBlockWall(3.0, 0.25, hinge=0.6, restitution="impulse"),
        independent.two_blocks(3.0, 0.25, 1800.0, hinge=0.6),
        (independent.impulse, 1.0, (1, -1)),
        2.18,
    ),
    "two blocks, sorrentino and factor": (
        dd.TwoBlockWall(3.0, 0.25, hinge=0.5, restitution_factor=0.87),
        independent.two_blocks(3.0, 0.25, 1800.0, hinge=0.5),
        (independent.base_balance, 0.87, (1, -1)),
        2.42,
    ),
    "two blocks with overburden": (
        dd.TwoBlockWall(
            3.0, 0.25, hinge=0.7, overburden=6000.0, overburden_inertia=0.0, eccentricity=0.05, restitution="impulse"
        ),
        independent.two_blocks(3.0, 0.25, 1800.0, **LOADED),
        (independent.impulse, 1.0, (1, -1)),
        3.6,
    ),
    "free-standing": (
        dd.FreeStandingWall(3.0, 0.45),
        independent.block(3.0, 0.45, 1800.0),
        (independent.impulse, 1.0, (1, -1)),
        1.5,
    ),
    "one-sided": (
        dd.OneSidedWall(3.0, 0.35),
        independent.block(3.0, 0.35, 1800.0),
        (independent.one_sided, 1.0, (1,)),
        2.0,
    ),
}


@pytest.mark.parametrize("name", HISTORIES)
def test_history(name):
    wall, bodies, (impact, factor, sides), scale = HISTORIES[name]
    response = dd.simulate(wall, dd.Record(SHAPE, DT), scale, solver=dd.Solver(rtol=1e-12, atol=1e-14))
    expected = independent.history(bodies, scale * SHAPE, DT, impact, factor, sides)

    assert not response.collapsed
    assert 0.2 < response.edp < 1.0
    assert response.edp * wall.capacity_angle == pytest.approx(expected.peak, rel=1e-10)
    assert response.time_of_peak == pytest.approx(expected.time_of_peak, abs=1e-9)

    # dondolo closes a chain of bounces at once and shows rest; the bodies go through all of it.
    rotation = response.rotation[np.searchsorted(response.time, TIME - 0.5e-6)]
    error = np.abs(rotation - expected.rotation) / wall.capacity_angle
    rests = rotation == 0.0
    assert np.count_nonzero(~rests) > 80
    assert error[~rests].max() < 1e-9
    assert error[rests].max() < 1e-3

    rows = itertools.pairwise(zip(response.time, response.rotation, strict=True))
    times = [after for (before, q), (after, r) in rows if before == after and q == r == 0.0 and after <= TIME[-1]]
    assert len(times) == response.impacts > 4
    found = {int(np.abs(expected.impacts - time).argmin()) for time in times}
    assert np.abs(np.sort(expected.impacts[list(found)]) - times).max() < 1e-9
    others = np.delete(expected.impacts, list(found))
    assert np.all(rests[np.searchsorted(TIME, others)]), others


@pytest.mark.parametrize("engine", ["rk45", "lanes"])
def test_bounces_that_hardly_lose_speed(engine):
    """A wall that still bounces when a push just above the trigger comes: EDPs of an independent program.

    That is an extrapolation method in long double and in 33 digits, with every bounce integrated. A guard that puts the
    wall to rest among its bounces changes the EDP in the third to the sixth digit, and survives the last push.
    """
    wall = dd.FreeStandingWall(3.0, 0.25, restitution_value=0.999)
    for over, expected, rel in ((1e-5, 0.0038075, 1e-5), (1e-4, 0.038673567, 2e-8), (1e-3, 0.5103246, 1e-7)):
        push = np.array([0.0, 1.001, *[0.99] * 20, *[1.0 + over] * 600, 0.0, 0.0])
        record = dd.Record(-wall.trigger_acceleration * push, 0.005)
        motion = dd.simulate(wall, record, solver=dd.Solver(engine=engine), history=False)
        assert motion.edp == pytest.approx(expected, rel=rel)
    push[22:622] = 1.0 + 1.31460e-3
    record = dd.Record(-wall.trigger_acceleration * push, 0.005)
    assert dd.simulate(wall, record, solver=dd.Solver(engine=engine), history=False).collapsed
