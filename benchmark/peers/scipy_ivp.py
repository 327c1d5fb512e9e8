"""SciPy's solve_ivp with its event location.

Methods: RK45, DOP853, LSODA, from sample to sample; with /record: over the whole record. The right-hand side is
compiled by Numba. The setting is the relative tolerance.
"""

import math

import numpy as np
import scipy
from numba import njit
from scipy.integrate import solve_ivp
from wall import IMPACT, LIMIT, NONE, run_peer, simulate


def make(wall, method, rtol):
    """Function that runs histories one by one."""
    method, _, whole = method.partition("/")
    capacity, p2 = wall.capacity, wall.p2
    atol = [0.01 * rtol * capacity, 0.01 * rtol * capacity * math.sqrt(p2)]

    def falls(t, y, *_):
        return y[0]

    def reaches(t, y, *_):
        return y[0] - capacity

    def turns(t, y, *_):
        return y[1]

    falls.terminal, falls.direction = True, -1
    reaches.terminal, reaches.direction = True, 1
    turns.direction = -1

    @njit
    def by_sample(t, y, start, slope):
        x = capacity - y[0]
        return y[1], -p2 * (math.sin(x) + (start + slope * t) * math.cos(x))

    @njit
    def by_record(t, y, a, dt, side):
        i = min(int(t / dt), len(a) - 2)
        x = capacity - y[0]
        push = side * (a[i] + (a[i + 1] - a[i]) * (t / dt - i))
        return y[1], -p2 * (math.sin(x) + push * math.cos(x))

    def solve(function, span, first, state, peak, arguments):
        found = solve_ivp(
            function,
            span,
            state,
            method=method,
            first_step=first,
            events=(falls, reaches, turns),
            rtol=rtol,
            atol=atol,
            args=arguments,
        )
        q, v = found.y[:, -1]
        peak = max([peak, q, *(top[0] for top in found.y_events[2])])
        event = IMPACT if found.t_events[0].size else LIMIT if found.t_events[1].size else NONE
        return event, found.t[-1], q, v, peak

    def sample_by_sample(_, a, dt, i, t, side, q, v, peak):
        for k in range(i, len(a) - 1):
            if t < dt:
                arguments = side * a[k], side * (a[k + 1] - a[k]) / dt
                event, t, q, v, peak = solve(by_sample, (t, dt), dt - t, (q, v), peak, arguments)
                if event != NONE:
                    return event, k, t, q, v, peak
            t = 0.0
        return NONE, len(a) - 1, 0.0, q, v, peak

    def whole_record(_, a, dt, i, t, side, q, v, peak):
        last = len(a) - 1
        event, t, q, v, peak = solve(by_record, (i * dt + t, last * dt), None, (q, v), peak, (a, dt, side))
        if event == NONE:
            return event, last, 0.0, q, v, peak
        i = min(int(t / dt), last - 1)
        return event, i, t - i * dt, q, v, peak

    flight = whole_record if whole else sample_by_sample

    def run_all(histories):
        return [simulate(wall, a, float(dt), flight) for a, dt in histories]

    run_all([(np.array([0.0, -1.0, 0.0]), 0.01)])  # compiles
    return run_all


run_peer(f"SciPy {scipy.__version__}", make)
