"""The histories, and the physics common to all peers in Python: theory.md, sections 1 to 4.

Rest, the end of a chain of bounces and the motion after the record; the integration of rocking between two impacts is
specific to each peer. Everything is compiled by Numba. Ground accelerations are in units of g.
"""

import math
import sys
import time
from typing import NamedTuple

import numpy as np
from numba import njit
from numba.extending import register_jitable

SHORTEST = 2.2e-13  # flights shorter than this part of a sample interval are rounding
TINY_HEIGHT, MOST_TINY = 1e-12, 1000  # height, in units of q_c, and number of consecutive bounces treated as rest
NONE, IMPACT, PEAK, LIMIT = 0, 1, 2, 3  # events


class Wall(NamedTuple):
    """A rectangular block that rocks about a corner, its terms divided by its inertia."""

    capacity: float
    p2: float
    restitution: float
    two_sided: bool
    moment: float
    lever: float
    height: float  # height up to which the bounds of a chain hold
    slack: float  # change of the terms up to that height


def new_wall(capacity, p2, restitution, two_sided):
    """Wall with all quantities derived from the four numbers."""
    height = 1e-3 * capacity
    while True:
        slack = abs(math.sin(capacity - height) / math.sin(capacity) - 1.0)
        slack += abs(math.cos(capacity - height) / math.cos(capacity) - 1.0)
        if slack <= 4e-3:
            break
        height *= 0.5
    moment, lever = p2 * math.sin(capacity), p2 * math.cos(capacity)
    return Wall(capacity, p2, restitution, two_sided, moment, lever, height, slack)


@njit
def next_start(wall, a, dt, i, t):
    """Interval, time within it and side at which a wall at rest starts to rock, in closed form; side 0: never."""
    last = len(a) - 1
    if i >= last:
        return i, t, 0.0
    trigger = wall.moment / wall.lever
    here = a[i] + (a[i + 1] - a[i]) * (t / dt)
    while True:
        following = a[i + 1]
        already = -here > trigger or (wall.two_sided and here > trigger)
        if already or -following > trigger or (wall.two_sided and following > trigger):
            side = -1.0 if (here if already else following) > 0.0 else 1.0
            if not already:
                t += (dt - t) * ((-side * trigger - here) / (following - here))
            return i, t, side
        i += 1
        if i == last:
            return i, t, 0.0
        t = 0.0
        here = following


@njit
def stays(wall, a, dt, i, t, side, speed, peak):
    """Whether the wall is at rest after an impact, or its chain of bounces provably ends at rest."""
    if speed == 0.0:
        return True
    last = len(a) - 1
    e = wall.restitution
    push = a[i] if i == last else a[i] + (a[i + 1] - a[i]) * (t / dt)
    inward = wall.moment + side * wall.lever * push
    if inward > 0.0 and 2.0 * speed / inward <= SHORTEST * dt:
        return True
    push *= side
    active = (1.0 - wall.slack) * wall.moment + wall.lever * push - wall.slack * wall.lever * abs(push)
    other = active - 2.0 * wall.lever * push if wall.two_sided else active
    least_active, least_other = active, other
    growth = 1.0
    elapsed = -t
    while True:
        push = side * a[i + 1] if i < last else 0.0
        to_active = (1.0 - wall.slack) * wall.moment + wall.lever * push - wall.slack * wall.lever * abs(push)
        to_other = to_active - 2.0 * wall.lever * push if wall.two_sided else to_active
        least_active = min(least_active, to_active)
        least_other = min(least_other, to_other)
        least = min(least_active, least_other)
        if not least > 0.0:
            return False
        growth *= max(1.0, to_active / active, to_other / other)
        rise = 0.5 * speed**2 * 1.03 * growth / least
        if rise > min(wall.height, peak) or growth > 10.0:
            return False
        duration = 2.0 * speed * math.sqrt(1.03 * growth) * (1.0 / least_active + e / least_other) / (1.0 - e * e)
        elapsed += dt
        if duration <= elapsed or i >= last:
            return True
        active, other = to_active, to_other
        i += 1


@njit
def peak_after(wall, q, v):
    """Peak of the motion after the record from its energy; the capacity for a collapse."""
    rest = wall.p2 * math.cos(wall.capacity)
    energy = 0.5 * v * v + wall.p2 * math.cos(wall.capacity - q)
    if v <= 0.0:
        energy = rest + wall.restitution**2 * (energy - rest)
    if energy >= wall.p2:
        return wall.capacity
    return wall.capacity - math.acos(energy / wall.p2)


@register_jitable
def simulate(wall, a, dt, flight):
    """EDP, collapse and impacts of one history.

    flight(wall, a, dt, i, t, side, q, v, peak) integrates from time t after sample i to the next impact, collapse or
    the last sample, and returns event, i, t, q, v and the peak so far.
    """
    i, t, peak, impacts = 0, 0.0, 0.0, 0
    while True:
        i, t, side = next_start(wall, a, dt, i, t)
        if side == 0.0:
            return peak / wall.capacity, False, impacts
        first, start = i, t
        q = v = 0.0
        tiny = 0
        while True:
            event, i, t, q, v, peak = flight(wall, a, dt, i, t, side, q, v, peak)
            if event == LIMIT:
                return 1.0, True, impacts
            if event == NONE:
                peak = max(peak, peak_after(wall, q, v))
                return peak / wall.capacity, peak >= wall.capacity, impacts
            impacts += 1
            q, v = 0.0, wall.restitution * max(0.0, -v)
            if wall.two_sided:
                side = -side
            tiny = tiny + 1 if 0.5 * v * v < TINY_HEIGHT * wall.capacity * wall.moment else 0
            if tiny > MOST_TINY or stays(wall, a, dt, i, t, side, v, peak):
                break
        # A start exactly at the threshold that rounding undoes at once is not repeated.
        if i == first and t - start <= SHORTEST * dt:
            i, t = i + 1, 0.0


def read_problem(path):
    """Read the wall, and accelerogram (scaled, in units of g) and time step of every history."""
    numbers = np.fromfile(path)
    capacity, p2, gravity, restitution, two_sided = numbers[:5]
    records, histories = numbers[5:7].astype(int)
    sizes = numbers[7 : 7 + 2 * records].reshape(-1, 2)
    ends = 7 + 2 * records + np.cumsum(sizes[:, 1]).astype(int)
    samples = [numbers[end - int(size) : end] / gravity for end, size in zip(ends, sizes[:, 1], strict=True)]
    pairs = numbers[ends[-1] :].reshape(histories, 2)
    wall = new_wall(capacity, p2, restitution, bool(two_sided))
    return wall, [(scale * samples[int(record)], sizes[int(record), 0]) for record, scale in pairs]


def turns(repeats):
    """As many turns as repeats, or, with 0, one for each line of standard input."""
    return range(repeats) if repeats else sys.stdin


def run_peer(version, make):
    """Run all histories as often as `turns` says, with arguments PROBLEM METHOD SETTING REPEATS EVERY.

    make(wall, method, setting) returns a function of all histories (accelerogram and time step), already compiled. It
    may add up in its attribute `own` the seconds that a library called from Python spends in its own steps.
    """
    path, method, setting, repeats, every = sys.argv[1:]
    wall, histories = read_problem(path)
    histories = histories[:: int(every)]
    run_all = make(wall, method, float(setting))
    print("version", version)
    outcomes = []
    for _ in turns(int(repeats)):
        if hasattr(run_all, "own"):
            run_all.own = 0.0
        start = time.perf_counter()
        outcomes = run_all(histories)
        seconds = time.perf_counter() - start
        if hasattr(run_all, "own"):
            print("own", run_all.own)
        print("seconds", seconds, flush=True)
    for edp, collapsed, impacts in outcomes:
        print(repr(float(edp)), int(collapsed), int(impacts))
