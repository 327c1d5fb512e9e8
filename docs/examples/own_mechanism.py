"""A mechanism of your own: the masonry arch of Oppenheim (1992), which rocks as a linkage of three bodies."""

# %% The arch: circular, seven voussoirs, mean radius 10 m, thickness 1.5 m, angle of embrace 157.5 degrees
import itertools
from pathlib import Path

import numpy as np

import dondolo as dd

radius, thickness, embrace, voussoirs, density, gravity = 10.0, 1.5, np.radians(157.5), 7, 2400.0, 9.81
joints = np.linspace(-0.5 * embrace, 0.5 * embrace, voussoirs + 1)  # from the crown, clockwise


# %% Vectors have x to the right and y upwards in their first axis; angles are clockwise
def at(r, angle):
    """A point of the arch."""
    return np.array([[r * np.sin(angle)], [r * np.cos(angle)]])


def turned(v, angle):
    """A vector, turned."""
    return np.stack([np.cos(angle) * v[0] + np.sin(angle) * v[1], np.cos(angle) * v[1] - np.sin(angle) * v[0]])


def speed(v):
    """Velocity of the end of a vector that turns by 1 rad/s."""
    return np.stack([v[1], -v[0]])


def direction(v):
    """Angle of a vector."""
    return np.arctan2(v[0], v[1])


# %% The linkage ABCD: three parts of the arch, between hinges that are in turn at the extrados and at the intrados
def arch(hinges, first, q):
    """J, L and S of the arch with hinges in some joints, the first at the extrados (1) or the intrados (-1)."""
    q = np.atleast_1d(q)
    a, b, c, d = (at(radius + 0.5 * thickness * first * (-1) ** k, joints[i]) for k, i in enumerate(hinges))
    # AB turns by q; C is where circles about B and D meet, on the side of BD where it was
    b_now = a + turned(b - a, q)
    to_d = d - b_now
    apart = np.hypot(*to_d)
    along = (np.sum((c - b) ** 2) - np.sum((c - d) ** 2) + apart**2) / (2.0 * apart)
    across = np.sqrt(np.sum((c - b) ** 2) - along**2)
    side = np.sign((d - b)[0] * (c - b)[1] - (d - b)[1] * (c - b)[0])
    c_now = b_now + (along * to_d + side * across * np.stack([-to_d[1], to_d[0]])) / apart
    # C moves with BC as it moves with CD: two equations for their speeds
    v, p, r = speed(b_now - a), speed(c_now - b_now), speed(c_now - d)
    det = p[1] * r[0] - p[0] * r[1]
    w2, w3 = (v[0] * r[1] - v[1] * r[0]) / det, (v[0] * p[1] - v[1] * p[0]) / det
    parts = [
        (hinges[0], hinges[1], a, q, np.ones_like(q), 0.0),
        (hinges[1], hinges[2], b, direction(c_now - b_now) - direction(c - b), w2, v),
        (hinges[2], hinges[3], d, direction(c_now - d) - direction(c - d), w3, 0.0),
    ]
    inertia = lever = vertical = 0.0
    outer, inner = radius + 0.5 * thickness, radius - 0.5 * thickness
    for i, k, pivot, angle, w, start in parts:
        width = joints[k] - joints[i]
        mass = density * radius * thickness * width
        reach = 4.0 / 3.0 * (outer**3 - inner**3) / (outer**2 - inner**2) * np.sin(0.5 * width) / width
        central = density * width * (outer**4 - inner**4) / 4.0 - mass * reach**2
        move = start + w * speed(turned(at(reach, 0.5 * (joints[i] + joints[k])) - pivot, angle))
        inertia = inertia + mass * np.sum(move**2, axis=0) + central * w**2
        lever = lever + mass * move[0]
        vertical = vertical + mass * move[1]
    # What the hinges open by, each on the side away from it
    opens = -first * np.stack([np.ones_like(q), 1.0 - w2, w3 - w2, w3])
    return inertia, lever, vertical, opens


# %% Where are the hinges? Of all mechanisms that open at every hinge, that which begins at the least acceleration
def multiplier(mechanism):
    """Ground acceleration at which a mechanism begins [g]."""
    _, lever, vertical, opens = arch(*mechanism, 0.0)
    return vertical[0] / lever[0] if lever[0] > 0.0 and np.all(opens > 0.0) else np.inf


mechanisms = itertools.product(itertools.combinations(range(voussoirs + 1), 4), (1, -1))
least = min(mechanisms, key=multiplier)
print(f"hinges in joints {least[0]}, the first at the {'extrados' if least[1] > 0 else 'intrados'}")
print(f"the arch begins to rock at {multiplier(least):.4f} g")

# %% Its terms as functions. To the other side it rocks as its mirror image: two sides, the same terms
wall = dd.TabulatedWall(
    height=radius * (1.0 - np.cos(0.5 * embrace)),
    rotation=0.08,
    inertia=lambda q: arch(*least, q)[0],
    lever=lambda q: arch(*least, q)[1],
    moment=lambda q: gravity * arch(*least, q)[2],
    vertical_lever=lambda q: arch(*least, q)[2],
    sides=2,
    restitution_value=0.9,
    gravity=gravity,
    name="arch",
)
print(wall)

# %% From here on it is a wall like any other
out = Path("out/examples")
out.mkdir(parents=True, exist_ok=True)
records = dd.synthetic_records(7.0, 5.0, "deep", n_records=20)
stripes = dd.multiple_stripe(wall, records, [0.6, 0.8, 1.0, 1.2, 1.5, 2.0, 2.5])
print(stripes.fit())
wall.plot().figure.savefig(out / "own_mechanism.png")
