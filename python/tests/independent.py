"""The mechanisms once more, as rigid bodies: nothing here knows a formula of dondolo's.

A wall is one or two rigid blocks in the plane with three coordinates each (x, y of the centroid and the angle theta,
counterclockwise), in the frame that moves with the ground. Its hinges are holonomic constraints, and its motion is

    [M  -A^T] [z'']   [F    ]        A = dPhi/dz        gamma = -A' z'
    [A   0  ] [lam] = [gamma]

(Lagrange multipliers, index 1). Restitutions are linear systems for velocities and impulses. The one degree of freedom
appears only where results are compared: q = -side*theta of the lower block.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from typing import NamedTuple

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

# Complex step: derivatives without a difference, exact to rounding
STEP = 1e-30

X = (0,)
BOTH = (0, 1)


class Hinge(NamedTuple):
    """A point of a body (from its centroid, at rest) held where it was, or to a point of another body."""

    axes: tuple[int, ...]
    body: int
    point: tuple[float, float]
    other: int | None = None
    other_point: tuple[float, float] = (0.0, 0.0)


class Coefficients(NamedTuple):
    """The terms of the reduced equation at one rotation, and the potential energy."""

    inertia: float
    inertia_rate: float
    restoring_moment: float
    excitation_lever: float
    load_force: float
    potential: float


class Constraints:
    """Hinges as equations Phi(z) = 0: points that coincided at rest still do."""

    def __init__(self, hinges: Sequence[Hinge], upright: np.ndarray) -> None:
        rows = []
        for hinge in hinges:
            for axis in hinge.axes:
                rows.append([(1.0, hinge.body, hinge.point, axis)])
                if hinge.other is not None:
                    rows[-1].append((-1.0, hinge.other, hinge.other_point, axis))
        parts = [(row, *part) for row, both in enumerate(rows) for part in both]
        self.count = len(rows)
        self.row, self.sign, self.body, point, self.axis = (np.array(column) for column in zip(*parts, strict=True))
        self.px, self.py = point.T
        self.linear = np.zeros((self.count, len(upright)))
        self.linear[self.row, 3 * self.body + self.axis] = self.sign
        self.target = np.zeros(self.count)
        self.target = self.value(upright)

    def value(self, z: np.ndarray) -> np.ndarray:
        """Phi."""
        cos, sin = np.cos(z[2::3][self.body]), np.sin(z[2::3][self.body])
        turned = np.where(self.axis == 0, cos * self.px - sin * self.py, sin * self.px + cos * self.py)
        value = self.linear @ z - self.target
        np.add.at(value, self.row, self.sign * turned)
        return value

    def jacobian(self, z: np.ndarray) -> np.ndarray:
        """A."""
        cos, sin = np.cos(z[2::3][self.body]), np.sin(z[2::3][self.body])
        turned = np.where(self.axis == 0, -sin * self.px - cos * self.py, cos * self.px - sin * self.py)
        matrix = self.linear.astype(z.dtype)
        matrix[self.row, 3 * self.body + 2] = self.sign * turned
        return matrix

    def convective(self, z: np.ndarray, v: np.ndarray) -> np.ndarray:
        """The right side gamma = -A' z'."""
        return -self.jacobian(z + 1j * STEP * v).imag @ v / STEP


@dataclass(frozen=True)
class Bodies:
    """Blocks stacked on each other, per metre of wall length, and what acts on them.

    Attributes
    ----------
    sizes : sequence of (half thickness, half height)
        From the ground up [m].
    density, gravity : float
        [kg/m3, m/s2].
    hinges : callable
        The hinges of a side, +1 or -1: the wall moves towards +x or -x.
    load, eccentricity : float
        Vertical force on the top block [N] and its distance from the centreline towards the side [m].
    """

    sizes: tuple[tuple[float, float], ...]
    density: float
    gravity: float
    hinges: Callable[[int], list[Hinge]]
    load: float = 0.0
    eccentricity: float = 0.0
    mass: np.ndarray = field(init=False)
    upright: np.ndarray = field(init=False)
    sides: dict[int, Constraints] = field(init=False)

    def __post_init__(self) -> None:
        mass, upright, base = [], [], 0.0
        for b, h in self.sizes:
            m = self.density * 4.0 * b * h
            mass += [m, m, m * (b * b + h * h) / 3.0]
            upright += [0.0, base + h, 0.0]
            base += 2.0 * h
        object.__setattr__(self, "mass", np.array(mass))
        object.__setattr__(self, "upright", np.array(upright))
        sides = {side: Constraints(self.hinges(side), self.upright) for side in (1, -1)}
        object.__setattr__(self, "sides", sides)

    def weights(self) -> np.ndarray:
        """Generalised forces of gravity."""
        force = np.zeros_like(self.mass)
        force[1::3] = -self.gravity * self.mass[1::3]
        return force

    def push(self) -> np.ndarray:
        """Generalised inertia forces of a ground acceleration of 1 m/s2."""
        force = np.zeros_like(self.mass)
        force[0::3] = -self.mass[0::3]
        return force

    def load_point(self, z: np.ndarray, side: int) -> tuple[float, float]:
        """The loaded point of the top block from its centroid, as the block is turned."""
        e, h = side * self.eccentricity, self.sizes[-1][1]
        cos, sin = np.cos(z[-1]), np.sin(z[-1])
        return cos * e - sin * h, sin * e + cos * h

    def load_forces(self, z: np.ndarray, side: int) -> np.ndarray:
        """Generalised forces of the load: a force on the centroid and its moment."""
        force = np.zeros_like(self.mass)
        force[-2:] = -self.load, -self.load * self.load_point(z, side)[0]
        return force

    def accelerations(self, z: np.ndarray, v: np.ndarray, side: int, ground: float) -> np.ndarray:
        """Accelerations z'' of the constrained bodies in the frame of the ground."""
        held = self.sides[side]
        force = self.weights() + self.load_forces(z, side) + ground * self.push()
        return saddle(self.mass, held.jacobian(z), force, held.convective(z, v))

    def tangent(self, z: np.ndarray, side: int) -> np.ndarray:
        """Velocities z' where q' = 1: those that the hinges allow."""
        matrix, right = self._with_rotation(z, side)
        right[-1] = -side
        return np.linalg.solve(matrix, right)

    def settle(self, z: np.ndarray, side: int) -> np.ndarray:
        """The position nearby that the hinges allow, with the same rotation of the lowest block (Newton's method)."""
        for _ in range(20):
            matrix, right = self._with_rotation(z, side)
            right[:-1] = -self.sides[side].value(z)
            change = np.linalg.solve(matrix, right)
            z = z + change
            if np.abs(change).max() < 1e-14:
                break
        return z

    def _with_rotation(self, z: np.ndarray, side: int) -> tuple[np.ndarray, np.ndarray]:
        last = np.zeros((1, len(z)), dtype=z.dtype)
        last[0, 2] = 1.0
        return np.vstack([self.sides[side].jacobian(z), last]), np.zeros(len(z), dtype=z.dtype)

    def position(self, q: float, side: int = 1) -> np.ndarray:
        """The position of a rotation, followed from the upright one."""
        z = self.upright
        for part in np.linspace(0.0, q, 2 + int(q / 0.05))[1:]:
            z = z.copy()
            z[2] = -side * part
            z = self.settle(z, side)
        return z

    def coefficients(self, q: float, side: int = 1) -> Coefficients:
        """J, C, G, L and Q: the equations of the bodies projected on the velocities that the hinges allow."""
        z = self.position(q, side)
        along = self.tangent(z, side)
        change = self.tangent(z + 1j * STEP * along, side).imag / STEP
        height = z[1::3] @ self.mass[1::3] * self.gravity + self.load * (z[-2] + self.load_point(z, side)[1])
        return Coefficients(
            along @ (self.mass * along),
            along @ (self.mass * change),
            -along @ self.weights(),
            -side * along @ self.push(),
            along @ self.load_forces(z, side),
            height,
        )

    def rotation_acceleration(self, z: np.ndarray, v: np.ndarray, side: int, ground: float) -> float:
        """Acceleration q'' of the constrained bodies."""
        return -side * self.accelerations(z, v, side, ground)[2]

    def trigger(self) -> float:
        """Ground acceleration at which q'' of the upright wall changes its sign [m/s2]."""
        still = np.zeros_like(self.upright)
        at_rest, pushed = (self.rotation_acceleration(self.upright, still, 1, ground) for ground in (0.0, -1.0))
        return -at_rest / (pushed - at_rest)

    def capacity(self) -> float:
        """Rotation at which the still wall, let go, does not move: the root of G - Q."""

        def moment(q: float) -> float:
            at = self.coefficients(q)
            return at.restoring_moment - at.load_force

        b, h = self.sizes[0]
        steps = np.linspace(0.0, 1.1 * np.arctan(b / h), 12)
        above = next(i for i, q in enumerate(steps) if moment(q) < 0.0)
        return brentq(moment, steps[above - 1], steps[above], xtol=1e-15, rtol=1e-15)


def saddle(mass: np.ndarray, jacobian: np.ndarray, top: np.ndarray, bottom: np.ndarray) -> np.ndarray:
    """Upper part z of the solution of [M -A^T; A 0] [z; lambda] = [top; bottom]."""
    n, m = len(mass), len(jacobian)
    matrix = np.zeros((n + m, n + m))
    matrix[:n, :n] = np.diag(mass)
    matrix[:n, n:] = -jacobian.T
    matrix[n:, :n] = jacobian
    return np.linalg.solve(matrix, np.concatenate([top, bottom]))[:n]


def block(height: float, thickness: float, density: float, gravity: float = 9.81) -> Bodies:
    """One block on its base corner of the side."""
    b, h = thickness / 2.0, height / 2.0
    return Bodies(((b, h),), density, gravity, lambda side: [Hinge(BOTH, 0, (side * b, -h))])


def two_blocks(
    height: float,
    thickness: float,
    density: float,
    hinge: float,
    load: float = 0.0,
    eccentricity: float = 0.0,
    gravity: float = 9.81,
) -> Bodies:
    """Two blocks that fold out: hinges at the base and the top on the side, the one in between on the other face."""
    b, lower, upper = thickness / 2.0, hinge * height / 2.0, (1.0 - hinge) * height / 2.0

    def hinges(side: int) -> list[Hinge]:
        return [
            Hinge(BOTH, 0, (side * b, -lower)),
            Hinge(BOTH, 0, (-side * b, lower), 1, (-side * b, -upper)),
            Hinge(X, 1, (side * b, upper)),
        ]

    return Bodies(((b, lower), (b, upper)), density, gravity, hinges, load, eccentricity)


# Impacts: velocities before, of the upright wall -> velocities after


def collide(bodies: Bodies, v: np.ndarray, held: Constraints) -> np.ndarray:
    """Velocities after the impact on hinges that hold from now on: M (z'+ - z'-) = A^T impulses, A z'+ = 0."""
    return saddle(bodies.mass, held.jacobian(bodies.upright), bodies.mass * v, np.zeros(held.count))


def impulse(bodies: Bodies, v: np.ndarray, side: int) -> tuple[np.ndarray, int]:
    """All hinges jump to the other face, each with its impulse; for one block this is Housner's balance (1963)."""
    return collide(bodies, v, bodies.sides[-side]), -side


def base_balance(bodies: Bodies, v: np.ndarray, side: int) -> tuple[np.ndarray, int]:
    """All hinges jump to the other face; the angular momentum about the new base hinge is the same before and after.

    It is the sum over both blocks of I theta' + M (r x v), with r from that hinge to the centroid. Of the impulses at
    the new hinges only the top support's has a moment about it (those in between cancel): it is left out, and so this
    is not the impact of the bodies. Their velocities keep to all five hinges, which takes five impulses.
    """
    held = bodies.sides[-side]
    pole = np.array([-side * bodies.sizes[0][0], 0.0])
    arm = bodies.upright.reshape(-1, 3)[:, :2] - pole
    mass = bodies.mass.reshape(-1, 3)
    about_pole = np.stack([-mass[:, 0] * arm[:, 1], mass[:, 1] * arm[:, 0], mass[:, 2]], axis=1).ravel()
    matrix = np.vstack([held.jacobian(bodies.upright), about_pole])
    right = np.zeros(len(v))
    right[-1] = about_pole @ v
    return np.linalg.solve(matrix, right), -side


def one_sided(bodies: Bodies, v: np.ndarray, side: int) -> tuple[np.ndarray, int]:
    """Three impacts at once, equation (2): the wall falls back between the ground and the transverse wall behind it.

    1. Its inner base corner strikes the ground; the wall turned about the outer one. Housner: 1 - 3/2 sin^2 alpha.
    2. Turning inwards about the inner base corner, its inner top corner strikes the transverse wall. That is Housner's
       impact once more, with the back of the wall for a base: 1 - 3/2 cos^2 alpha, which is negative for alpha below
       35.26 degrees: the sense of the rotation is reversed.
    3. Turning outwards about the inner base corner, its outer base corner strikes the ground: Housner again.

    Each factor is a balance of angular momentum about the corner that is struck. What no balance gives is the change of
    the pole between 2 and 3: after the second impact the wall turns about the inner top corner, and the third begins
    with that angular velocity about the inner base corner.
    """
    b, h = bodies.sizes[0]
    inner_base, inner_top, outer_base = (
        Constraints([Hinge(BOTH, 0, corner)], bodies.upright)
        for corner in ((-side * b, -h), (-side * b, h), (side * b, -h))
    )
    v = collide(bodies, v, inner_base)
    v = collide(bodies, v, inner_top)
    v = np.linalg.solve(np.vstack([inner_base.jacobian(bodies.upright), [0.0, 0.0, 1.0]]), [0.0, 0.0, v[2]])
    return collide(bodies, v, outer_base), side


Impact = Callable[[Bodies, np.ndarray, int], tuple[np.ndarray, int]]


def coefficient(bodies: Bodies, impact: Impact) -> float:
    """Angular velocity of the lowest block after / before an impact."""
    before = -bodies.tangent(bodies.upright, 1)
    return impact(bodies, before, 1)[0][2] / before[2]


# Histories


class History(NamedTuple):
    """A motion: signed rotation at the samples, times of the impacts, the peak and its time."""

    rotation: np.ndarray
    impacts: np.ndarray
    peak: float
    time_of_peak: float


def history(
    bodies: Bodies,
    samples: np.ndarray,
    dt: float,
    impact: Impact,
    factor: float = 1.0,
    sides: Sequence[int] = (1, -1),
) -> History:
    """The motion of the bodies under an accelerogram, from rest to its end, by SciPy's DOP853."""
    motion = _Motion(bodies, impact, factor, sides)
    rotations = [0.0]
    for k in range(len(samples) - 1):
        motion.interval(k * dt, dt, samples[k], (samples[k + 1] - samples[k]) / dt)
        rotations.append(-motion.z[2])
    return History(np.array(rotations), np.array(motion.impacts), motion.peak, motion.time_of_peak)


class _Motion:
    """Where a motion is. A bounce whose flight is shorter than `shortest` is the end of its chain."""

    shortest = 1e-5

    def __init__(self, bodies: Bodies, impact: Impact, factor: float, sides: Sequence[int]) -> None:
        self.bodies, self.impact, self.factor, self.sides = bodies, impact, factor, sides
        self.z, self.v, self.side = bodies.upright, np.zeros_like(bodies.upright), sides[0]
        self.moving = False
        self.impacts: list[float] = []
        self.peak = self.time_of_peak = 0.0

    def interval(self, start: float, dt: float, ground: float, slope: float) -> None:
        """From one sample to the next; within them the ground acceleration is linear."""
        self.start, self.ground, self.slope = start, ground, slope
        time = 0.0
        while time < dt:
            time = self.rock(time, dt) if self.moving else self.wait(time, dt)

    def upright_acceleration(self, side: int, time: float) -> float:
        """Acceleration q'' of the upright wall, negative where the wall is held inwards."""
        still, ground = np.zeros_like(self.v), self.ground + self.slope * time
        return self.bodies.rotation_acceleration(self.bodies.upright, still, side, ground)

    def wait(self, time: float, dt: float) -> float:
        """At rest until q'' of the upright wall becomes positive on a side: it is linear between samples."""
        for side in self.sides:
            now, then = (self.upright_acceleration(side, at) for at in (time, dt))
            if now < 0.0 < then:
                self.moving, self.side = True, side
                return time - now / (then - now) * (dt - time)
        return dt

    def rate(self, time: float, y: np.ndarray) -> np.ndarray:
        z, v = np.split(y, 2)
        return np.concatenate([v, self.bodies.accelerations(z, v, self.side, self.ground + self.slope * time)])

    def integrate(self, time: float, end: float, longest: float, events: Sequence[Callable] = ()) -> object:
        y = np.concatenate([self.z, self.v])
        settings = {"method": "DOP853", "rtol": 1e-12, "atol": 1e-14, "max_step": longest}
        return solve_ivp(self.rate, (time, end), y, events=events or None, **settings)

    def rock(self, time: float, dt: float) -> float:
        """Until the next sample or impact."""
        n = len(self.z)
        longest = dt
        upright = self.z[2] == 0.0
        inwards = -self.upright_acceleration(self.side, time)
        if upright and self.v[2] != 0.0 and inwards > 0.0:
            # The first step must end before the wall is back, or its return would not be seen.
            longest = min(dt, -self.side * self.v[2] / (2.0 * inwards))

        def down(t: float, y: np.ndarray) -> float:
            return -self.side * y[2]

        def turning(t: float, y: np.ndarray) -> float:
            return -self.side * y[n + 2]

        down.terminal, down.direction, turning.direction = True, -1, -1
        run = self.integrate(time, dt, longest, [down, turning])
        for t, y in zip(run.t_events[1], run.y_events[1], strict=True):
            if -self.side * y[2] > self.peak:
                self.peak, self.time_of_peak = -self.side * y[2], self.start + t
        if len(run.t_events[0]):
            return self.strike(time, run.t_events[0][0], longest)
        # The drift off the hinges within an interval is of the order of the tolerance.
        self.z = self.bodies.settle(run.y[:n, -1], self.side)
        self.v = self.bodies.tangent(self.z, self.side) * (-self.side * run.y[n + 2, -1])
        return dt

    def strike(self, time: float, end: float, longest: float) -> float:
        """An impact: located by Newton's method on the integration itself, since its dense output knows less."""
        n = len(self.z)
        for _ in range(2):
            y = self.integrate(time, end, longest).y[:, -1]
            end -= y[2] / y[n + 2]
        before = self.bodies.tangent(self.bodies.upright, self.side) * (-self.side * y[n + 2])
        v, self.side = self.impact(self.bodies, before, self.side)
        self.z, self.v = self.bodies.upright, self.factor * v
        self.impacts.append(self.start + end)
        inwards = -self.upright_acceleration(self.side, end)
        if inwards > 0.0 and 2.0 * abs(self.v[2]) < self.shortest * inwards:
            self.moving = False
            self.v = np.zeros_like(self.v)
        return end
