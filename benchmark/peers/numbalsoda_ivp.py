"""numbalsoda: DOP853 and LSODA from sample to sample, the whole program compiled by Numba. Methods: dop853, lsoda.

It has no event location without allocations, so events are found by steps of adjusted length, as in C++. The setting is
the relative tolerance; the absolute tolerance is a single number.
"""

import math
from importlib.metadata import version

import numpy as np
from numba import carray, cfunc, njit
from numbalsoda import lsoda_sig
from numbalsoda.driver import lsoda_wrapper
from numbalsoda.driver_dop853 import dop853_wrapper
from wall import IMPACT, LIMIT, NONE, PEAK, run_peer, simulate

FALLS, TURNS_IN, TURNS_OUT, REACHES = range(4)


@cfunc(lsoda_sig)
def right_side(t, y, dy, data):
    """Derivatives of rotation and velocity; data: capacity, p2, present value and slope of the ground acceleration."""
    data = carray(data, (4,))
    x = data[0] - y[0]
    dy[0] = y[1]
    dy[1] = -data[1] * (math.sin(x) + (data[2] + data[3] * t) * math.cos(x))


address = right_side.address


def compiled(solver, rtol):
    """Function of one history, compiled for a solver and a tolerance."""

    @njit
    def after(data, q, v, h):
        # The end is omitted if the last step misses it by rounding: then integrate slightly further, and interpolate.
        y0, t, y, flag = np.array([q, v]), np.array([0.0, h, 1.001 * h]), np.full((3, 2), np.nan), np.zeros(1, np.int32)
        for points in (2, 3):
            solver(
                address,
                2,
                y0.ctypes.data,
                data.ctypes.data,
                points,
                t.ctypes.data,
                y.ctypes.data,
                rtol,
                0.01 * rtol * data[0],
                100000,
                flag.ctypes.data,
            )
            if not math.isnan(y[1, 0]):
                break
        return y[1, 0], y[1, 1]

    @njit
    def gap_of(kind, data, t, q, v):
        x = data[0] - q
        f = -data[1] * (math.sin(x) + (data[2] + data[3] * t) * math.cos(x))
        if kind == FALLS:
            return q, v
        if kind == TURNS_IN:
            return v, f
        if kind == TURNS_OUT:
            return -v, -f
        return data[0] - q, -v

    @njit
    def root(kind, data, q, v, h):
        """Root of a gap within (0, h], by Newton's method in a bracket."""
        low, high, x = 0.0, h, h
        for _ in range(60):
            q_new, v_new = after(data, q, v, x)
            gap, rate = gap_of(kind, data, x, q_new, v_new)
            if gap > 0.0:
                low = x
            else:
                high = x
            if gap == 0.0 or high - low <= 4e-16 * high:
                break
            change = -gap / rate if rate < 0.0 else 0.0
            if rate < 0.0 and abs(change) <= 1e-8 * x:
                # The last Newton step needs no evaluation: its error is the square of the change.
                _, rate = gap_of(TURNS_IN, data, x, q_new, v_new)
                q_new += change * (v_new + 0.5 * change * rate)
                v_new += change * rate
                x += change
                break
            x += change
            if not low < x < high:
                x = 0.5 * (low + high)
        return x, q_new, v_new

    @njit
    def event_in(data, q, v, h, q_new, v_new, peak):
        """First event of a step, its position, and the state there."""
        capacity = data[0]
        if v > 0.0 and v_new < 0.0 and max(q + h * v, q_new - h * v_new) > peak:
            x, top, _ = root(TURNS_IN, data, q, v, h)
            if top >= capacity:
                return LIMIT, x, capacity, 0.0
            if top > peak:
                return PEAK, x, top, 0.0
        if q_new >= capacity:
            return LIMIT, h, capacity, v_new
        if q > 0.0 and v < 0.0 and v_new > 0.0 and q_new > 0.0:
            if min(q + h * v, q_new - h * v_new) > 0.0:
                return NONE, h, q_new, v_new
            x, bottom, _ = root(TURNS_OUT, data, q, v, h)
            if bottom > 0.0:
                return NONE, h, q_new, v_new
            h = x
        elif q_new > 0.0 or (q_new == 0.0 and v_new > 0.0):
            return NONE, h, q_new, v_new
        x, _, v_new = root(FALLS, data, q, v, h)
        return IMPACT, x, 0.0, v_new

    @njit
    def flight(wall, a, dt, i, t, side, q, v, peak):
        data = np.array([wall.capacity, wall.p2, 0.0, 0.0])
        while i < len(a) - 1:
            data[3] = side * (a[i + 1] - a[i]) / dt
            while t < dt:
                data[2] = side * a[i] + data[3] * t  # time is measured from the start of a step
                h = dt - t
                q_new, v_new = after(data, q, v, h)
                event, x, q, v = event_in(data, q, v, h, q_new, v_new, peak)
                peak = max(peak, q)
                t = dt if event == NONE else t + x
                if event in (IMPACT, LIMIT):
                    return event, i, t, q, v, peak
            i, t = i + 1, 0.0
        return NONE, i, 0.0, q, v, peak

    @njit
    def history(wall, a, dt):
        return simulate(wall, a, dt, flight)

    return history


def make(wall, method, rtol):
    """Function that runs histories one by one, compiled by a first history."""
    history = compiled(dop853_wrapper if method == "dop853" else lsoda_wrapper, rtol)
    history(wall, np.array([0.0, -1.0, 0.0]), 0.01)
    return lambda histories: [history(wall, a, float(dt)) for a, dt in histories]


run_peer(f"numbalsoda {version('numbalsoda')}", make)
