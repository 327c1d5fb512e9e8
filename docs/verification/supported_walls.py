"""Walls between two moving supports, as they are: two blocks whose ends move apart, and a block before a surface.

Own models for moving_supports.simulate, without any code or number of dondolo. Signs: accelerations, displacements and
rotations are positive outwards, on side +1.
"""

from dataclasses import dataclass

import numpy as np
from moving_supports import BASE, DELTA, RISE, SPEED, TINY, G, between
from scipy.optimize import brentq


@dataclass
class Strip:
    """Two blocks between two supports; y is the opening from the straight wall, mode the side, 0 at rest."""

    height: float
    thickness: float
    hinge: float
    ratio_of_speeds: float | None = None  # None: by `balance`, times `factor`
    factor: float = 1.0
    load: float = 0.0  # N/m
    lifted: float = 0.0  # part of the load whose mass moves
    eccentricity: float = 0.0
    depth: float = 0.0  # of the hinges behind the faces
    density: float = 1800.0

    levels = 1

    def __post_init__(self):
        self.b = 0.5 * self.thickness - self.depth
        self.h1, self.h2 = 0.5 * self.hinge * self.height, 0.5 * (1.0 - self.hinge) * self.height
        self.m1, self.m2 = (2.0 * self.density * self.thickness * h for h in (self.h1, self.h2))
        self.i1, self.i2 = (
            m * (0.25 * self.thickness**2 + h**2) / 3.0 for m, h in ((self.m1, self.h1), (self.m2, self.h2))
        )
        self.r1, self.r2 = np.hypot(self.b, self.h1), np.hypot(self.b, self.h2)
        self.mv = self.lifted * self.load / G
        self.limit = self.capacity()
        if self.ratio_of_speeds is None:
            self.ratio_of_speeds = self.factor * self.balance()

    def balance(self):
        """Ratio of speeds by the balance of angular momentum about the new base hinge, repaired."""
        a1, ratio = np.arctan2(self.b, self.h1), self.h1 / self.h2
        i1, i2 = self.m1 * self.r1**2 / 3.0, self.m2 * self.r2**2 / 3.0
        sine, cosine = np.sin(a1), np.cos(a1)
        cot2 = self.h2 / self.b
        fixed, top = self.m1 * self.r1**2 + i1 - i2 * ratio, self.m2 * self.r1**2
        after = fixed + top * (2.0 + sine * cosine * (cot2 + 1.0 / cot2))
        before = fixed - 2.0 * self.m1 * (self.r1 * sine) ** 2
        return (before + top * (2.0 + sine * cosine * cot2 - sine**2 * (4.0 + ratio))) / after

    def terms(self, q, d):
        """J, C, D, E, F, G - Q and L of the equation of motion, for the lower block's rotation q and s delta."""
        b, h1, h2, r2, m2 = self.b, self.h1, self.h2, self.r2, self.m2
        sine, cosine = np.sin(q), np.cos(q)
        s1, c1 = b * cosine - h1 * sine, h1 * cosine + b * sine
        s2 = s1 + 0.5 * d
        c2 = np.sqrt(r2 * r2 - s2 * s2)
        k, p = c1 / c2, 0.5 / c2
        k_q, k_d, p_d = (s1 - k * k * s2) / c2, k * p * s2 / c2, p * p * s2 / c2
        w = 2.0 * s1 + s2 * k
        w_q, w_d = -2.0 * c1 - c1 * k + s2 * k_q, s2 * k_d + 0.5 * k
        z, z_d = -s2 * p, -0.5 * p - s2 * p_d
        j = self.m1 * self.r1**2 + self.i1 + m2 * (c1 * c1 + w * w) + self.i2 * k * k
        c = m2 * (c1 * s1 + w * w_q) + self.i2 * k * k_q
        mixed = m2 * w * w_d + self.i2 * k * k_d
        e = m2 * w * z_d - self.i2 * k * p_d
        f = m2 * (0.5 * c1 + z * w) - self.i2 * k * p
        moment = G * (self.m1 * s1 + m2 * w)
        if self.load > 0.0:
            arm = b - self.eccentricity
            # psi = a2 - b2 with tan a2 = b/h2
            cos, sin = (h2 * c2 + b * s2) / r2**2, (b * c2 - h2 * s2) / r2**2
            y, y_up = 2.0 * s1 + 2.0 * s2 * k - arm * k * cos, -2.0 * s2 * p + arm * p * cos
            moment = moment + self.load * y
            if self.mv > 0.0:
                y_q = -2.0 * c1 * (1.0 + k) + 2.0 * s2 * k_q - arm * (k_q * cos - k * k * sin)
                y_d = k + 2.0 * s2 * k_d - arm * (k_d * cos + k * p * sin)
                up_d = -p - 2.0 * s2 * p_d + arm * (p_d * cos + p * p * sin)
                j, c, mixed = j + self.mv * y * y, c + self.mv * y * y_q, mixed + self.mv * y * y_d
                f, e = f + self.mv * y * y_up, e + self.mv * y * up_d
        return j, c, mixed, e, f, moment, (self.m1 + m2) * c1

    def begin(self, count):
        """No memory."""

    def capacity(self):
        """Rotation at which the restoring moment vanishes."""
        alpha = np.arctan2(self.b, self.h1)
        moments = [self.terms(q, 0.0)[5] for q in (0.5 * alpha, alpha)]
        return alpha if moments[1] >= 0.0 else brentq(lambda q: self.terms(q, 0.0)[5], 0.0, alpha, xtol=1e-14)

    def rate(self, who, side, o, v, x):
        """Relative opening acceleration of a side."""
        d, speed, rise = side * x[DELTA], side * x[SPEED], side * x[RISE]
        root = np.sqrt(self.height**2 - d * d)
        tilt_rise = rise / root + d * speed * speed / root**3
        turning = v + speed / root
        j, c, mixed, e, f, moment, lever = self.terms(o + np.arcsin(d / self.height), d)
        push = (
            c * turning**2 + 2.0 * mixed * turning * speed + e * speed**2 + f * rise + moment + lever * side * x[BASE]
        )
        return -push / j - tilt_rise

    def moves(self, mode):
        """Whether it is off its supports' line."""
        return mode != 0

    def remember(self, who, o, x):
        """No memory."""

    def level(self, number, mode, o, v, x):
        """The opening closes."""
        return o, v

    def release(self, who, mode, o, v, x, f):
        """Whether and when one side opens within the rest of a step."""
        zero, mode, f = np.zeros(len(who)), mode.copy(), f.copy()
        x0 = between(x, f)
        end = np.ones(len(who))
        for side in (1, -1):
            a0, a1 = self.rate(who, side, zero, zero, x0), self.rate(who, side, zero, zero, x[2])
            opens = (a0 > 0.0) | (a1 > 0.0)
            part = np.where(a0 > 0.0, 0.0, -a0 / np.where(a1 > a0, a1 - a0, 1.0))
            end = np.where(opens, f + part * (1.0 - f), end)
            mode[opens] = side
        return end, mode, zero, zero

    def jump(self, who, mode, v, x, event, h):
        """All joints close: the wall opens to its other side with a part of its relative speed, or is at rest."""
        speed = self.ratio_of_speeds * np.abs(v)
        zero = np.zeros(len(who))
        there, back = (self.rate(who, side, zero, zero, x) for side in (-mode, mode))
        stop = (there < 0.0) & (back < 0.0) & (2.0 * speed < TINY * h * np.abs(there))
        return np.where(stop, 0, -mode), zero, np.where(stop, 0.0, speed)


OUTER_CONTACT, STANDING, OUTER, INNER, INNER_CONTACT = range(5)


@dataclass
class Tie:
    """An elastic, perfectly plastic tie that cannot push; the building holds its other end."""

    height: float
    stiffness: float  # N/m, per metre of wall
    preload: float  # N
    strength: float  # N
    longest: float  # elongation at which it breaks, m


@dataclass
class Facade:
    """A block on either edge of its base, before a surface that turns with the building; y is the rotation outwards."""

    height: float
    thickness: float
    span: float  # height over which the building turns, m
    tie: Tie | None = None
    density: float = 1800.0

    levels = 2

    def __post_init__(self):
        h, b = 0.5 * self.height, 0.5 * self.thickness
        self.radius, self.limit = np.hypot(h, b), np.arctan2(b, h)
        self.mass = self.density * self.height * self.thickness
        self.inertia = 4.0 / 3.0 * self.mass * self.radius**2
        sine2 = np.sin(self.limit) ** 2
        self.edge_ratio = 1.0 - 1.5 * sine2
        self.surface_ratio = max(0.0, -(self.edge_ratio**2) * (1.0 - 1.5 * (1.0 - sine2)))
        self.largest = np.zeros(0)

    def begin(self, count):
        """Ties as new, for `count` histories."""
        self.largest = np.zeros(count)

    def pull(self, who, q, x):
        """Moment of the tie."""
        tie = self.tie
        if tie is None:
            return 0.0
        most = self.largest[who]
        yields = (tie.strength - tie.preload) / tie.stiffness
        plastic = np.maximum(0.0, np.minimum(most, tie.longest) - yields)
        elongation = tie.height * (np.sin(q) - x[DELTA] / self.span)
        force = np.clip(tie.preload + tie.stiffness * (elongation - plastic), 0.0, tie.strength)
        return np.where(most >= tie.longest, 0.0, force) * tie.height * np.cos(q)

    def rate(self, who, mode, q, v, x):
        """Angular acceleration about the edge that the mode says."""
        edge = np.where((mode == INNER) | (mode == INNER_CONTACT), -1.0, 1.0)
        angle = self.limit - edge * q
        weight = self.mass * self.radius
        push = edge * G * weight * np.sin(angle) + self.pull(who, q, x) + weight * np.cos(angle) * x[BASE]
        return -push / self.inertia

    def surface(self, x):
        """Rotation of the surface, its rate and second derivative."""
        return x[DELTA] / self.span, x[SPEED] / self.span, x[RISE] / self.span

    def moves(self, mode):
        """Whether it is neither on its whole base nor on the surface."""
        return (mode == OUTER) | (mode == INNER)

    def remember(self, who, q, x):
        """Ties keep their largest elongation."""
        if self.tie is not None:
            elongation = self.tie.height * (np.sin(q) - x[DELTA] / self.span)
            self.largest[who] = np.maximum(self.largest[who], elongation)

    def level(self, number, mode, q, v, x):
        """The surface is met (1), or the edge of the base changes (2)."""
        if number == 1:
            place, speed, _ = self.surface(x)
            return q - place, v - speed
        edge = np.where(mode == INNER, -1.0, 1.0)
        return edge * q, edge * v

    def release(self, who, mode, q, v, x, f):
        """What happens first to walls at rest within the rest of a step: they leave, or the surface leaves or comes."""
        xs = (between(x, f), x[2])
        places = [self.surface(each)[0] for each in xs]
        rising = [self.surface(each)[2] for each in xs]
        standing, inner = mode == STANDING, mode == INNER_CONTACT
        where = [np.where(standing, 0.0, each) for each in places]
        zero = np.zeros(len(who))
        carried = [np.where(standing, 0.0, each) for each in rising]
        own = np.where(inner, INNER, OUTER)
        # Excess of outward acceleration; of a standing wall also inwards, over the inner edge
        out = [self.rate(who, own, y, zero, each) - a for y, each, a in zip(where, xs, carried, strict=True)]
        into = [-self.rate(who, np.full(len(who), INNER), zero, zero, each) for each in xs]
        into = [np.where(standing, each, -1.0) for each in into]
        # The surface passes through the vertical: downwards it leaves a wall on its outer edge, upwards it meets others
        passes = [np.where(mode == OUTER_CONTACT, -each, each) for each in places]
        passes[0] = np.minimum(passes[0], 0.0)
        part, event = np.full(len(who), 2.0), np.zeros(len(who), dtype=int)
        for number, (g0, g1) in enumerate((out, into, passes), start=1):
            happens = (g1 > 0.0) | (g0 > 0.0)
            at = np.where(g0 > 0.0, 0.0, -g0 / np.where(g1 > g0, g1 - g0, 1.0))
            sooner = happens & (at < part)
            part[sooner], event[sooner] = at[sooner], number
        end = np.where(event > 0, f + np.minimum(part, 1.0) * (1.0 - f), 1.0)
        x1 = between(x, end)
        place, speed, _ = self.surface(x1)
        new, q1, v1 = mode.copy(), np.where(standing, 0.0, place), np.where(standing, 0.0, speed)
        new[event == 1] = own[event == 1]
        new[(event == 2)] = INNER
        leaves = (event == 3) & (mode == OUTER_CONTACT)
        new[leaves], q1[leaves], v1[leaves] = INNER, 0.0, self.edge_ratio * speed[leaves]
        new[(event == 3) & inner] = OUTER_CONTACT
        met = (event == 3) & standing
        kicked = (1.0 + self.surface_ratio) * speed
        new[met], q1[met], v1[met] = OUTER, 0.0, kicked[met]
        self.remember(who, q1, x1)
        return end, new, q1, v1

    def jump(self, who, mode, v, x, event, h):
        """Impact on the surface, or change of edge; bounces that are too short end at rest."""
        place, speed, rise = self.surface(x)
        met = event == 1
        # On the surface
        away = self.surface_ratio * np.maximum(speed - v, 0.0)
        pressed = rise - self.rate(who, mode, place, v, x)
        stuck = met & (pressed > 0.0) & (2.0 * away < TINY * h * pressed)
        # On the other edge
        over = self.edge_ratio * v
        zero = np.zeros(len(who))
        outwards = self.rate(who, np.full(len(who), OUTER), zero, zero, x)
        inwards = self.rate(who, np.full(len(who), INNER), zero, zero, x)
        holds = np.minimum(-outwards, inwards)
        stands = ~met & (holds > 0.0) & (2.0 * np.abs(over) < TINY * h * holds) & (place < 0.0)
        new = np.where(met, mode, np.where(mode == OUTER, INNER, OUTER))
        new = np.where(stuck, np.where(mode == OUTER, OUTER_CONTACT, INNER_CONTACT), np.where(stands, STANDING, new))
        q1 = np.where(met, place, 0.0)
        return new, q1, np.where(stuck, speed, np.where(met, speed + away, np.where(stands, 0.0, over)))
