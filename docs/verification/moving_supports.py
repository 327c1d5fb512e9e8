"""Motions of two supports, and a stepper of rocking histories: no code, numbers or methods of dondolo.

A building of one linear mode, with a diaphragm in series, is discretised exactly as one system (scipy.signal) under an
acceleration that is linear between samples. Histories are stepped together by classical Runge-Kutta steps of fixed
length; events inside a step are located on its cubic Hermite polynomial, then by Newton steps on the step itself.
"""

from dataclasses import dataclass

import numpy as np
from scipy.signal import cont2discrete

G = 9.81
BASE, DELTA, SPEED, RISE = range(4)  # channels: acceleration of the base; delta, its rate and its second derivative
FINISHED = 9  # mode of a history that has collapsed
EVENTS = 8  # most events within one step
CALM = 0.5  # a wall at rest is left alone while what it feels is below this part of g times its capacity
TINY = 0.2  # a bounce shorter than this part of a step is no longer followed


@dataclass(frozen=True)
class House:
    """One mode, its participation at base and top, and a diaphragm in series with the top (period in s; 0: none)."""

    period: float
    base: float
    top: float
    damping: float = 0.05
    diaphragm: float = 0.0
    diaphragm_damping: float = 0.05
    share: float = 1.3  # participation of the diaphragm


def system(house):
    """Matrices A, B, C, D of the whole state (d, d', D, D'), from the ground acceleration to the four channels."""
    omega = 2.0 * np.pi / house.period
    mode = np.array([-(omega**2), -2.0 * house.damping * omega, 0.0, 0.0])  # d'' without - u''
    unit = np.eye(4)
    a, b = np.zeros((4, 4)), np.array([0.0, -1.0, 0.0, 0.0])
    a[0], a[1], a[2] = unit[1], mode, unit[3]
    step = house.top - house.base
    c = np.array([house.base * mode, step * unit[0], step * unit[1], step * mode])
    d = np.array([1.0 - house.base, 0.0, 0.0, -step])
    if house.diaphragm > 0.0:
        floor, floor_ground = house.top * mode, 1.0 - house.top  # acceleration of the floor that carries it
        own = 2.0 * np.pi / house.diaphragm
        a[3] = -floor - own**2 * unit[2] - 2.0 * house.diaphragm_damping * own * unit[3]
        b[3] = -floor_ground
        c = c + house.share * np.array([0.0 * mode, unit[2], unit[3], a[3]])
        d = d + house.share * np.array([0.0, 0.0, 0.0, b[3]])
    return a, b[:, None], c, d[:, None]


def supports(house, ground, dt, parts=1, after=8.0):
    """Channels at half steps of dt/parts, an array (2 n + 1, 4, records), for `ground` (records, samples), padded."""
    half = 0.5 * dt / parts
    times = np.arange(ground.shape[1] * 2 * parts + 2 * round(after / dt) * parts + 1) * half
    own = np.arange(ground.shape[1]) * dt
    fine = np.array([np.interp(times, own, each, right=0.0) for each in ground]).T
    a, b, c, d, _ = cont2discrete(system(house), half, "foh")
    state = np.zeros((4, ground.shape[0]))
    out = np.empty((len(times), 4, ground.shape[0]))
    for k, u in enumerate(fine):
        out[k] = c @ state + d * u
        state = a @ state + b * u
    return out


def between(x, f):
    """Channels at the part f of a step, by the parabola through its beginning, middle and end."""
    return x[0] * ((1.0 - f) * (1.0 - 2.0 * f)) + x[1] * (4.0 * f * (1.0 - f)) + x[2] * (f * (2.0 * f - 1.0))


def advance(model, who, mode, y, v, x, f0, f1, h):
    """One Runge-Kutta step from part f0 to part f1 of a step."""
    span = (f1 - f0) * h
    if not f0.any() and (f1 == 1.0).all():
        xa, xm, xb = x
    else:
        xa, xm, xb = between(x, f0), between(x, 0.5 * (f0 + f1)), between(x, f1)
    k1 = model.rate(who, mode, y, v, xa)
    v2 = v + 0.5 * span * k1
    k2 = model.rate(who, mode, y + 0.5 * span * v, v2, xm)
    v3 = v + 0.5 * span * k2
    k3 = model.rate(who, mode, y + 0.5 * span * v2, v3, xm)
    v4 = v + span * k3
    k4 = model.rate(who, mode, y + span * v3, v4, xb)
    return y + span * (v + 2.0 * v2 + 2.0 * v3 + v4) / 6.0, v + span * (k1 + 2.0 * k2 + 2.0 * k3 + k4) / 6.0


def hermite(g0, s0, g1, s1, z):
    """Cubic through values and slopes (times the span) at both ends."""
    return (
        g0 * (1.0 + 2.0 * z) * (1.0 - z) ** 2
        + s0 * z * (1.0 - z) ** 2
        + g1 * z * z * (3.0 - 2.0 * z)
        + s1 * z * z * (z - 1.0)
    )


def crossing(g0, s0, g1, s1):
    """Part of the span at which the cubic falls through zero, from positive (or zero and rising) to negative."""
    low, high = np.zeros_like(g0), np.ones_like(g0)
    for _ in range(30):
        middle = 0.5 * (low + high)
        above = hermite(g0, s0, g1, s1, middle) > 0.0
        low, high = np.where(above, middle, low), np.where(above, high, middle)
    return 0.5 * (low + high)


class Histories:
    """Histories of a model under `scale` times the motions `which`: channels of `supports`, steps of h seconds.

    `peak` is a part of the capacity, 1 for collapse; `start` and `turn` are times of the first start and of the peak.
    """

    def __init__(self, model, motion, which, scale, h):
        count = len(which)
        self.model, self.motion, self.which, self.scale, self.h = model, motion, which, scale, h
        self.y, self.v, self.mode = np.zeros(count), np.zeros(count), np.zeros(count, dtype=int)
        self.peak, self.start, self.turn = np.zeros(count), np.full(count, np.nan), np.full(count, np.nan)
        model.begin(count)

    def run(self):
        """Step through the motions."""
        calm = CALM * G * self.model.limit
        to_come = np.maximum.accumulate(strength(self.motion)[::-1])[::-1]
        alive = np.arange(len(self.which))
        for i in range((self.motion.shape[0] - 1) // 2):
            if i % 100 == 0:
                over = to_come[2 * i, self.which[alive]] * np.abs(self.scale[alive]) < calm
                over &= np.abs(self.y[alive]) < 1e-3 * self.model.limit
                alive = alive[~over & (self.mode[alive] != FINISHED)]
            if len(alive) == 0:
                break
            self.step(i, alive[self.mode[alive] != FINISHED])
        return self

    def step(self, i, who):
        """One step of these histories, from event to event."""
        x = self.motion[2 * i : 2 * i + 3][:, :, self.which[who]] * self.scale[who]
        f = np.zeros(len(who))
        for _ in range(EVENTS):
            left = np.flatnonzero((f < 1.0) & (self.mode[who] != FINISHED))
            if len(left) == 0:
                break
            moving = self.model.moves(self.mode[who[left]])
            at_rest, flying = left[~moving], left[moving]
            if len(at_rest):
                f[at_rest] = self.rest(i, who[at_rest], x[:, :, at_rest], f[at_rest])
            if len(flying):
                f[flying] = self.fly(i, who[flying], x[:, :, flying], f[flying])

    def rest(self, i, who, x, f):
        """Until they leave, or the end of the step."""
        f, *state = self.model.release(who, self.mode[who], self.y[who], self.v[who], x, f)
        self.mode[who], self.y[who], self.v[who] = state
        first = self.model.moves(self.mode[who]) & np.isnan(self.start[who])
        self.start[who[first]] = (i + f[first]) * self.h
        return f

    def fly(self, i, who, x, f0):
        """Until their first event, or the end of the step."""
        model, mode, h, y0, v0 = self.model, self.mode[who], self.h, self.y[who], self.v[who]
        end = np.ones(len(who))
        y1, v1 = advance(model, who, mode, y0, v0, x, f0, end, h)
        event, part = first_event(model, mode, (y0, v0, y1, v1), x, f0, h)
        hit = np.flatnonzero(event)
        if len(hit):
            inside = (who[hit], mode[hit], y0[hit], v0[hit], x[:, :, hit], f0[hit])
            end[hit], y1[hit], v1[hit] = land(model, inside, part, event[hit], h)
        x1 = between(x, end)
        top, when = highest(y0, v0, y1, v1, (end - f0) * h)
        top = top / model.limit
        higher = top > self.peak[who]
        self.peak[who[higher]] = np.minimum(top[higher], 1.0)
        self.turn[who[higher]] = (i + f0[higher]) * h + when[higher]
        model.remember(who, np.where(event > 0, y1, top * model.limit), x1)
        if len(hit):
            after = model.jump(who[hit], mode[hit], v1[hit], x1[:, hit], event[hit], h)
            mode[hit], y1[hit], v1[hit] = after
        mode[top >= 1.0] = FINISHED
        self.y[who], self.v[who], self.mode[who] = y1, v1, mode
        return end


def strength(motion):
    """More, m/s2, than what a wall feels of its supports."""
    size = np.abs(motion)
    return size[:, BASE] + 1.5 * size[:, RISE] + 5.0 * size[:, DELTA]


def window(motion, scale, calm, after):
    """The motions from where they, times `scale`, first exceed `calm` to `after` half steps from where they last do."""
    strong = strength(motion) * scale >= calm
    first = np.where(strong.any(axis=0), strong.argmax(axis=0), 0)
    last = motion.shape[0] - strong[::-1].argmax(axis=0)
    first = 2 * (np.maximum(first - 1, 0) // 2)
    length = 2 * ((min(int((last - first).max()) + after, motion.shape[0])) // 2) + 1
    out = np.zeros((length, *motion.shape[1:]))
    for k, begin in enumerate(first):
        each = motion[begin : begin + length, :, k]
        out[: len(each), :, k] = each
    return out


def first_event(model, mode, ends, x, f0, h):
    """Which level each history passes first within its step (0: none), and the part of the rest at which it does."""
    y0, v0, y1, v1 = ends
    event, part = np.zeros(len(mode), dtype=int), np.ones(len(mode))
    x0, x1 = between(x, f0), x[2]
    span = (1.0 - f0) * h
    for number in range(1, model.levels + 1):
        g1, s1 = model.level(number, mode, y1, v1, x1)
        down = np.flatnonzero(g1 < 0.0)
        if len(down):
            g0, s0 = model.level(number, mode[down], y0[down], v0[down], x0[:, down])
            where = crossing(np.maximum(g0, 0.0), s0 * span[down], g1[down], s1[down] * span[down])
            sooner = where < part[down]
            part[down[sooner]], event[down[sooner]] = where[sooner], number
    return event, part[event > 0]


def land(model, inside, part, event, h):
    """Part of the step, position and speed at an event: Newton steps on the Runge-Kutta step."""
    who, mode, y0, v0, x, f0 = inside
    end = f0 + part * (1.0 - f0)
    for _ in range(2):
        y1, v1 = advance(model, who, mode, y0, v0, x, f0, end, h)
        g, s = np.empty(len(who)), np.empty(len(who))
        for number in np.unique(event):
            these = event == number
            g[these], s[these] = model.level(number, mode[these], y1[these], v1[these], between(x, end)[:, these])
        shift = np.where(s < 0.0, -g / np.where(s < 0.0, s, -1.0) / h, 0.0)
        end = np.clip(end + np.clip(shift, -0.1, 0.1), f0, 1.0)
    return end, *advance(model, who, mode, y0, v0, x, f0, end, h)


def highest(y0, v0, y1, v1, span):
    """Highest value of the cubic over a step, and when."""
    top, when = np.maximum(y0, y1), np.where(y1 >= y0, span, 0.0)
    turned = np.flatnonzero((v0 > 0.0) & (v1 < 0.0))
    if len(turned):
        g0, s0, g1, s1 = y0[turned], v0[turned] * span[turned], y1[turned], v1[turned] * span[turned]
        # Slope s0 + 2 z b + 3 z2 c of the cubic
        b, c = 3.0 * (g1 - g0) - 2.0 * s0 - s1, s0 + s1 - 2.0 * (g1 - g0)
        z = -s0 / (b - np.sqrt(np.maximum(b * b - 3.0 * s0 * c, 0.0)))
        top[turned], when[turned] = hermite(g0, s0, g1, s1, z), z * span[turned]
    return top, when
