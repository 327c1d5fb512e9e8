"""heyoka: Taylor's method with its own events, one step from sample to sample if the tolerance allows it.

Methods: scalar; batch: histories in the lanes of a vector, each at its own time, refilled when one ends. Everything
except the integration is compiled by Numba. The setting is the tolerance.

The wheel has heyoka's library without the headers of its C++ interface, so that it is called from Python. Of a batch
the time within the library's own steps is printed too: a step of all lanes is one call.
"""

import time

import heyoka as hy
import numpy as np
from numba import njit
from wall import IMPACT, LIMIT, NONE, PEAK, SHORTEST, next_start, peak_after, run_peer, simulate, stays

hy.set_logger_level_error()  # its warnings of multiple roots would go to standard output

LOWEST = 1e-20  # a stationary rotation [rad] below this is rest
LANES = 32  # several vectors, to distribute the overhead of a step in Python
OUTCOMES = {hy.taylor_outcome(-1): IMPACT, hy.taylor_outcome(-2): PEAK, hy.taylor_outcome(-3): LIMIT}


def system(wall, event):
    """Equation of motion and its events; par: present value and slope of the ground acceleration."""
    q, v = hy.make_vars("q", "v")
    x = wall.capacity - q
    push = hy.par[0] + hy.par[1] * hy.time
    equations = [(q, v), (v, -wall.p2 * (hy.sin(x) + push * hy.cos(x)))]
    falls, rises = hy.event_direction.negative, hy.event_direction.positive
    events = [event(q, direction=falls), event(v, direction=falls), event(q - wall.capacity, direction=rises)]
    return equations, events


def starter(equations, tolerance):
    """Function for the motion from rest to the next sample, in which the push of the ground increases monotonically.

    No event can occur there, and none is searched for: at the start they have multiple roots, at which root finding
    fails.
    """
    integrator = hy.taylor_adaptive(equations, [0.0, 0.0], tol=tolerance)
    state, pars, step = integrator.state, integrator.pars, integrator.step

    def start(push, slope, remaining):
        state[:] = 0.0
        pars[:] = push, slope
        integrator.time = 0.0
        while remaining > 0.0:
            remaining -= step(remaining)[1]
        return float(state[0]), float(state[1])

    return start


def scalar(wall, tolerance):
    """Function that runs histories one by one."""
    equations, events = system(wall, hy.t_event)
    start = starter(equations, tolerance)
    integrator = hy.taylor_adaptive(equations, [0.0, 0.0], t_events=events, tol=tolerance)
    state, pars, step = integrator.state, integrator.pars, integrator.step

    def flight(_, a, dt, i, t, side, q, v, peak):
        if v == 0.0:
            slope = side * (a[i + 1] - a[i]) / dt
            q, v = start(side * a[i] + slope * t, slope, dt - t)
            i, t, peak = i + 1, 0.0, max(peak, q)
        state[0], state[1] = q, v
        integrator.reset_cooldowns()
        here, last = side * float(a[i]), len(a) - 1
        while i < last:
            following = side * float(a[i + 1])
            slope = (following - here) / dt
            while t < dt:
                pars[0], pars[1] = here + slope * t, slope
                integrator.time = 0.0
                remaining = dt - t
                q, v = float(state[0]), float(state[1])
                outcome, h = step(remaining)
                while state[0] < 0.0 and outcome not in OUTCOMES and h > SHORTEST * dt:
                    # Root finding failed and missed an impact: repeat with half the step.
                    state[0], state[1] = q, v
                    integrator.time = 0.0
                    outcome, h = step(0.5 * h)
                t = dt if h == remaining else t + h
                q = float(state[0])
                if q > peak:
                    peak = q
                # The step has been halved down to rounding: the impact is at this time.
                event = OUTCOMES.get(outcome, IMPACT if q < 0.0 else NONE)
                if event == PEAK and h == 0.0 and q < LOWEST:
                    event = IMPACT
                if event in (IMPACT, LIMIT):
                    return event, i, t, q, float(state[1]), peak
            i, t, here = i + 1, 0.0, following
        return NONE, i, 0.0, float(state[0]), float(state[1]), peak

    def run_all(histories):
        return [simulate(wall, a, float(dt), flight) for a, dt in histories]

    return run_all


LANE = np.dtype(
    [
        ("history", np.int64),  # -1: the lane is idle
        ("interval", np.int64),
        ("time", np.float64),
        ("side", np.float64),
        ("peak", np.float64),
        ("impacts", np.int64),
        ("collapsed", np.bool_),
        ("first", np.int64),  # interval and time of the last start
        ("start", np.float64),
        ("halved", np.bool_),  # whether the next step is half of one that missed an impact
    ]
)


@njit
def rest(wall, lane, a, dt, state, k):
    """Advance a lane at rest to its next start; false if its history is over."""
    lane["interval"], lane["time"], lane["side"] = next_start(wall, a, dt, lane["interval"], lane["time"])
    lane["first"], lane["start"] = lane["interval"], lane["time"]
    state[:, k] = 0.0
    return lane["side"] != 0.0


@njit
def follow(wall, lane, a, dt, state, k, event, whole, h):
    """Apply the result of a step to its lane; false if its history is over."""
    q, v = state[0, k], state[1, k]
    lane["peak"] = max(lane["peak"], q)
    lane["time"] = dt if whole else min(lane["time"] + h, dt)
    if event == LIMIT:
        lane["collapsed"] = True
        return False
    if event == IMPACT:
        lane["impacts"] += 1
        speed = wall.restitution * max(0.0, -v)
        if wall.two_sided:
            lane["side"] = -lane["side"]
        if stays(wall, a, dt, lane["interval"], lane["time"], lane["side"], speed, lane["peak"]):
            if lane["interval"] == lane["first"] and lane["time"] - lane["start"] <= SHORTEST * dt:
                lane["interval"] += 1
                lane["time"] = 0.0
            return rest(wall, lane, a, dt, state, k)
        state[0, k], state[1, k] = 0.0, speed
    if lane["time"] >= dt:
        lane["interval"] += 1
        lane["time"] = 0.0
        if lane["interval"] == len(a) - 1:
            lane["peak"] = max(lane["peak"], peak_after(wall, state[0, k], state[1, k]))
            lane["collapsed"] = lane["peak"] >= wall.capacity
            return False
    return True


@njit
def prepare(lane, a, dt, pars, remaining, k):
    """Set the ground motion for the next step of a lane."""
    i, t, side = lane["interval"], lane["time"], lane["side"]
    slope = side * (a[i + 1] - a[i]) / dt
    pars[0, k], pars[1, k] = side * a[i] + slope * t, slope
    remaining[k] = dt - t


@njit
def turn(wall, lanes, samples, ends, steps, before, state, pars, remaining, done, events, outcomes, following):
    """Apply a step of all lanes, refill lanes that have ended, and return the next history to start."""
    for k in range(len(lanes)):
        lane = lanes[k]
        n = lane["history"]
        alive = n >= 0
        if alive:
            a, dt = samples[ends[n] : ends[n + 1]], steps[n]
            if events[k] == NONE and state[0, k] < 0.0 and done[k] > SHORTEST * dt:
                # Root finding failed and missed an impact: repeat with half the step.
                state[:, k] = before[:, k]
                lane["halved"] = True
                remaining[k] = 0.5 * done[k]
                continue
            # The step has been halved down to rounding: the impact is at this time.
            event = IMPACT if events[k] == NONE and state[0, k] < 0.0 else events[k]
            if event == PEAK and done[k] == 0.0 and state[0, k] < LOWEST:
                event = IMPACT
            whole = done[k] == remaining[k] and not lane["halved"]
            alive = follow(wall, lane, a, dt, state, k, event, whole, done[k])
            lane["halved"] = False
        while not alive:
            if lane["history"] >= 0:
                n = lane["history"]
                edp = 1.0 if lane["collapsed"] else lane["peak"] / wall.capacity
                outcomes[n, 0], outcomes[n, 1], outcomes[n, 2] = edp, lane["collapsed"], lane["impacts"]
            lane["history"] = -1
            if following == len(steps):
                break
            n = following
            following += 1
            lane["history"], lane["interval"], lane["time"] = n, 0, 0.0
            lane["peak"], lane["impacts"], lane["collapsed"] = 0.0, 0, False
            a, dt = samples[ends[n] : ends[n + 1]], steps[n]
            alive = rest(wall, lane, a, dt, state, k)
        if alive:
            prepare(lane, a, dt, pars, remaining, k)
        else:
            # An idle lane does not move.
            state[:, k] = 0.5 * wall.capacity, 0.0
            remaining[k] = 0.0
    return following


def batch(wall, tolerance):
    """Function that runs histories in lanes."""
    equations, events = system(wall, hy.t_event_batch)
    anywhere = np.full((2, LANES), 0.5 * wall.capacity)
    integrator = hy.taylor_adaptive_batch(
        equations, anywhere, t_events=events, tol=tolerance, pars=np.zeros((2, LANES))
    )
    state, pars = integrator.state, integrator.pars
    start_one = starter(equations, tolerance)

    def run_all(histories):
        samples = np.concatenate([a for a, _ in histories])
        ends = np.concatenate([[0], np.cumsum([len(a) for a, _ in histories])])
        steps = np.array([dt for _, dt in histories])
        outcomes = np.zeros((len(histories), 3))
        lanes = np.zeros(LANES, LANE)
        lanes["history"] = -1
        happened = np.zeros(LANES, dtype=np.int64)
        remaining, done, before = np.zeros(LANES), np.zeros(LANES), state.copy()
        following = 0
        while True:
            following = turn(
                wall, lanes, samples, ends, steps, before, state, pars, remaining, done, happened, outcomes, following
            )
            if following == len(steps) and (lanes["history"] < 0).all():
                return outcomes
            for k in np.flatnonzero((state[1] == 0.0) & (state[0] == 0.0)):
                # Integrate from rest to the sample separately; the lane does not move in this round.
                state[:, k] = start_one(pars[0, k], pars[1, k], remaining[k])
                remaining[k] = 0.0
            before[:] = state
            integrator.set_time(0.0)
            begin = time.perf_counter()
            integrator.step(remaining)
            run_all.own += time.perf_counter() - begin
            done[:] = integrator.last_h
            happened[:] = NONE
            for k in np.flatnonzero(done != remaining):
                happened[k] = OUTCOMES.get(integrator.step_res[k][0], NONE)
                if happened[k] == IMPACT:
                    integrator.reset_cooldowns(k)

    run_all.own = 0.0
    return run_all


def make(wall, method, tolerance):
    """Function that runs histories, compiled by a first history."""
    run_all = batch(wall, tolerance) if method == "batch" else scalar(wall, tolerance)
    run_all([(np.array([0.0, -1.0, 0.0]), np.float64(0.01))])
    return run_all


run_peer(f"heyoka {hy.__version__}", make)
