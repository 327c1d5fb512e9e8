"""Numbers that others have published, made again."""

import warnings

import numpy as np
import pytest

import dondolo as dd

G = 9.81


def record(velocity, dt, second=None):
    """An impulse, and from a sample on the opposite one; each lasts two steps."""
    a = np.zeros((second or 0) + 3 + int(2.5 / dt))
    a[1] = velocity / dt
    if second is not None:
        a[second + 1] = -velocity / dt
    return dd.Record(a, dt)


def overturns(wall, velocity, dt):
    """Does the second impulse, which begins at the impact, overturn the wall? Its step is chosen so that it can."""
    step = dt
    for _ in range(2):
        motion = dd.simulate(wall, record(velocity, step))
        impact = motion.time[np.flatnonzero(motion.after_impact)[0]]
        second = int(np.ceil(impact / dt))
        step = impact / second
    return dd.simulate(wall, record(velocity, step, second), history=False).collapsed


def excess(wall, published, dt):
    """Relative difference of the smallest velocity that overturns a wall from a published one, to 1e-6."""
    low, high = 0.995, 1.005
    assert not overturns(wall, low * published, dt)
    assert overturns(wall, high * published, dt)
    while high - low > 1e-6:
        middle = 0.5 * (low + high)
        low, high = (low, middle) if overturns(wall, middle * published, dt) else (middle, high)
    return 0.5 * (low + high) - 1.0


@pytest.mark.parametrize(
    ("height", "thickness", "published"), [(3.0, 0.6, 0.462848), (6.0, 0.8, 0.425959), (1.5, 0.5, 0.586983)]
)
def test_double_impulse(height, thickness, published):
    """The velocity of the double impulse that overturns a rigid block: Nabeshima and others (2016).

    Its second impulse comes at the impact. The published limit is that of impulses without a duration; a short one
    is above it in proportion to its duration, so that two durations tell the limit.
    """
    angle, radius = np.arctan2(thickness, height), 0.5 * np.hypot(height, thickness)
    inertia = 4.0 / 3.0 * radius**2  # for each unit of mass
    ratio = 1.0 - 1.5 * np.sin(angle) ** 2
    energy = G * radius * (1.0 - np.cos(angle))
    limit = inertia / (radius * np.cos(angle)) * np.sqrt(2.0 * energy / inertia) / (1.0 + ratio)
    assert limit == pytest.approx(published, abs=1e-6)

    wall = dd.FreeStandingWall(height, thickness)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", dd.errors.DondoloWarning)  # impulses of some 100 g
        longer, shorter = (excess(wall, limit, dt) for dt in (4e-4, 2e-4))
    assert 0.0 < shorter < longer < 0.002
    assert 2.0 * shorter - longer == pytest.approx(0.0, abs=1e-5)
