"""Hard histories of one block by another program in 60 digits: python forty_digits.py RECORDS (needs python-flint).

Nothing of dondolo is used but its accelerograms. Taylor series of degree 24 in ball arithmetic (Arb) follow the
equation of a block about its corner,

    q'' = -p^2 [sin(alpha - q) + s a(t)/g cos(alpha - q)],    p^2 = 3 g/(4 R),

from one sample, impact or start to the next. Chains of bounces are followed bounce by bounce until the speed is below
1e-26 rad/s. The tables hard_*.csv of test/reference are held against it, with the factor on the record one unit in the
last place smaller and greater too; walls of two blocks and restitutions above 0.97 are left out, whose chains are too
long for this.
"""

import csv
import math
import multiprocessing
import sys

import numpy as np
from cases import TABLES, motions
from flint import arb, arb_series, ctx

import dondolo as dd

DIGITS = 60
DEGREE = 24
PARTS = 8  # of a step in which signs are looked at
STILL = arb("1e-26")  # speed below which a wall is at rest [rad/s]
LIMIT = 0.97  # largest restitution that is followed
AGREES = 1e-7  # how far two EDPs may be apart
G = 9.81  # as a double
SHOWN = ("mechanism", "height", "record", "status", "edp", "edp_lowest", "edp_highest")


def exact(ball):
    """The middle of a ball, as a number."""
    return ball.mid()


class Block:
    """A block, and its motion under one accelerogram."""

    def __init__(self, row, record, scale):
        height, thickness = arb(float(row["height"])), arb(float(row["thickness"]))
        self.g = arb(G)
        self.two_sided = row["mechanism"] == "free_standing"
        self.alpha = exact((thickness / height).atan())
        self.p2 = exact(3 * self.g / (2 * (height**2 + thickness**2).sqrt()))
        sine2 = self.alpha.sin() ** 2
        if row["restitution_value"]:
            loss = arb(float(row["restitution_value"]))
        elif self.two_sided:
            loss = 1 - sine2 * 3 / 2
        else:
            loss = abs((1 - sine2 * 3 / 2) ** 2 * (1 - (1 - sine2) * 3 / 2))
        self.e = exact(loss * arb(float(row["restitution_factor"])))
        self.a = [exact(arb(float(a)) * arb(scale)) for a in record.acceleration]
        self.dt = arb(float(record.dt))
        self.threshold = exact(self.g * self.alpha.tan())
        self.side, self.peak = 1, arb(0)

    def ground(self, i, time):
        """Ground acceleration in an interval: its value at a time, and its slope."""
        if i >= len(self.a) - 1:
            return arb(0), arb(0)
        slope = (self.a[i + 1] - self.a[i]) / self.dt
        return exact(self.a[i] + slope * time), exact(slope)

    def series(self, q, v, a, slope):
        """The motion as a power series in time."""
        push = arb_series([self.side * a / self.g, self.side * slope / self.g], DEGREE + 1)
        x = arb_series([q, v], DEGREE + 1)
        for _ in range(DEGREE // 2):
            angle = self.alpha - x
            x = arb_series([q, v], DEGREE + 1) + (-self.p2 * (angle.sin() + push * angle.cos())).integral().integral()
        return [exact(x[k]) for k in range(DEGREE + 1)]

    def start(self, i, time):
        """Interval and time at which a block at rest begins to rock; None if it does not."""
        while i < len(self.a) - 1:
            here, slope = self.ground(i, time)
            end = self.a[i + 1]
            for side in (1, -1) if self.two_sided else (1,):
                if -side * here > self.threshold:
                    self.side = side
                    return i, time
                if -side * end > self.threshold:
                    self.side = side
                    return i, exact(time + (-side * self.threshold - here) / slope)
            i, time = i + 1, arb(0)
        return None

    def run(self):
        """The EDP: largest rotation / alpha, at most 1."""
        place = self.start(0, arb(0))
        while place is not None:
            i, time = place
            place = self.rock(i, time)
            if self.peak >= self.alpha:
                return 1.0
        return float(exact(self.peak / self.alpha))

    def rock(self, i, time):
        """Rock from rest; where it rests again it is asked for the next start."""
        q, v, struck = arb(0), arb(0), 0
        last = len(self.a) - 1
        while True:
            a, slope = self.ground(i, time)
            # Beyond the record the ground is still: a second impact is followed by lower peaks only.
            whole = exact(self.dt - time) if i < last else self.dt
            d = self.series(q, v, a, slope)
            x, event = self.first_event(d, whole)
            q, v = value(d, x), rate(d, x)
            self.peak = max(self.peak, q)
            if self.peak >= self.alpha:
                return None
            if event is None:
                i, time = i + 1, arb(0)
                continue
            time = exact(time + x)
            if event == "turn":
                v = arb(0)
                continue
            struck += i >= last
            q, v = arb(0), exact(-self.e * v)
            ground = self.side * self.ground(i, time)[0]
            if self.two_sided:
                self.side = -self.side
                ground = -ground
            if struck == 2:
                return None
            if v < STILL and ground > -self.threshold:
                return self.start(i, time) if i < last else None

    def first_event(self, d, whole):
        """First impact, or outer turn beyond the peak, in a step."""
        # A zero at the start is no impact: it is divided out.
        above = d[1:] if d[0] == 0 else d
        if above[0] == 0:
            above = above[1:]
        before, rises = arb(0), next(c for c in d[1:] if c != 0) > 0
        for k in range(1, PARTS + 1):
            x = exact(whole * k / PARTS)
            falls = rate(d, x) <= 0
            if rises and falls:
                turn = root([k * c for k, c in enumerate(d)][1:], before, x)
                if value(d, turn) > self.peak:
                    return turn, "turn"
            if value(above, x) < 0:
                # Whether it goes below and comes back eight parts of a sample show.
                return root(above, before, x), "impact"
            before, rises = x, not falls
        return whole, None


def value(d, x):
    """A series."""
    total = arb(0)
    for c in reversed(d):
        total = total * x + c
    return exact(total)


def rate(d, x):
    """Its rate of change."""
    total = arb(0)
    for k in range(len(d) - 1, 0, -1):
        total = total * x + k * d[k]
    return exact(total)


def root(d, low, high):
    """Where a series falls to zero between two places: Newton's method from that of its parabola."""
    discriminant = d[1] ** 2 - 4 * d[0] * d[2]
    x = exact(2 * d[0] / (discriminant.sqrt() - d[1])) if discriminant > 0 else low
    for _ in range(60):
        if not low < x < high:
            x = exact((low + high) / 2)
        f = value(d, x)
        low, high = (x, high) if f > 0 else (low, x)
        step = exact(f / rate(d, x))
        x = exact(x - step)
        if abs(step) <= abs(x) * arb("1e-50"):
            break
    return x


def compare(task):
    """One row of a table: EDPs with the factor and with its neighbours."""
    row, record = task
    ctx.dps = DIGITS
    scale = float(row["scale"])
    factors = (scale, math.nextafter(scale, 0.0), math.nextafter(scale, math.copysign(math.inf, scale)))
    return row, [Block(row, record, factor).run() for factor in factors]


def can_be_followed(row):
    """One block whose chains are short enough?"""
    if row["mechanism"] == "two_block":
        return False
    return not row["restitution_value"] or float(row["restitution_value"]) <= LIMIT


def main(folder):
    """Compare the tables."""
    tasks = []
    for kind, each in motions(folder).items():
        named = {record.name: record for record in dd.read_catalogue(each.catalogue)}
        lines = (TABLES / f"hard_{kind}.csv").read_text().splitlines()
        for row in csv.DictReader(line for line in lines if not line.startswith("#")):
            if can_be_followed(row):
                tasks.append((row, named[row["record"]]))
    agree = {"quadruple": [0, 0], "not_computable": [0, 0]}
    with multiprocessing.Pool() as pool:
        for row, edps in pool.imap(compare, tasks):
            count = agree[row["status"]]
            if row["status"] == "quadruple":
                fits = np.ptp(edps) <= 2e-6 and abs(edps[0] - float(row["edp"])) <= AGREES
            else:
                fits = np.ptp([*edps, float(row["edp"])]) > 1e-6
            count[0] += fits
            count[1] += 1
            print(*(row[name] for name in SHOWN), *edps, fits, flush=True)
    for status, (fits, of) in agree.items():
        print(f"{status}: {fits} of {of} agree")


if __name__ == "__main__":
    main(sys.argv[1])
