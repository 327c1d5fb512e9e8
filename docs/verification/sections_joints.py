"""Joints that bend before they open, section 11: values in 33 digits, and an independent program under random motions.

python sections_joints.py RECORDS writes this section of docs/studies/verification.md alone; with --quick a part of it
is computed, and nothing is written. Fails if anything is off.
"""

import sys
import warnings
from dataclasses import dataclass, replace

import numpy as np
from cases import ROOT, TABLES, motions, read_table
from joints import Program, Strip
from markdown import bullets, paragraph, small, table
from sections_accuracy import demand

import dondolo as dd

TITLE = "## 11. Joints that bend before they open"
PAGE = ROOT / "docs" / "studies" / "verification.md"
TIGHT = dd.Solver(engine="rk45", rtol=1e-12, atol=1e-14)
DEFAULT = dd.Solver(engine="rk45")
WALLS, FEW, SEED = 1000, 60, 1
#: Largest relative errors of peaks that are accepted: of the values, and of random walls, tight and at the defaults
EXACT, RANDOM, USUAL = 1e-9, 1e-6, 1e-3
#: Walls of the table with the ratios of speeds that equation (4) gives them, times 0.87
RATIOS = {"SAFEGo": 0.847411697381, "SIN-01": 0.862626406073, "docs": 0.833041631266}


@dataclass
class Pair:
    """Histories by the program and by dondolo."""

    own: np.ndarray  # EDPs of dondolo
    peak: np.ndarray  # of the program, over the capacity
    time: np.ndarray  # difference of the times of the peaks, s
    flags: int  # that differ
    fast: int  # histories that never opened, but passed the middle faster than at the speed of the opening

    @property
    def error(self):
        """Relative differences of the peaks."""
        return np.abs(self.own / self.peak - 1.0)


def compare(program, strips, records, histories, solver=TIGHT, after=2.0):
    """Run histories by both."""
    found = program.follow(strips, records, histories, after)
    walls = [strip.wall() for strip in strips]
    made = [dd.Record(motion, dt, name="motion") for motion, dt in records]
    ran = [
        dd.simulate(walls[strip], made[record], factor, solver=solver, history=False)
        for strip, record, factor in histories
    ]
    capacity = found.joints[[strip for strip, _, _ in histories], 0]
    own = np.array([one.edp for one in ran])
    fell = np.array([one.collapsed for one in ran])
    fast = int(((found.openings == 0.0) & (found.passages > 0.0)).sum())
    peak = np.abs(found.peak) / capacity
    time = np.array([one.time_of_peak for one in ran]) - found.time
    return Pair(own, peak, time, int((fell != found.collapsed).sum()), fast)


def strip_of(row):
    """The strip of a line of the table."""
    sizes = [float(row[name]) for name in ("height", "thickness", "density", "hinge", "overburden")]
    return Strip(*sizes, 0.0, 0.0, RATIOS[row["wall"]], float(row["elastic_period"]))


def wave(periods, period, amplitude, dt=0.01):
    """Periods of a sine, as samples of six decimals and their step."""
    time = dt * np.arange(round(periods * period / dt) + 1)
    return np.round(amplitude * np.sin(2.0 * np.pi * time / period), 6), dt


def values(program):
    """Rows of the values in 33 digits, of the program and of dondolo."""
    rows = read_table(TABLES / "bent_strips.csv")
    strips = [strip_of(row) for row in rows]
    records = [wave(*(float(row[name]) for name in ("n", "period", "amplitude"))) for row in rows]
    histories = [(k, k, 1.0) for k in range(len(rows))]
    found = program.follow(strips, records, histories)
    pair = compare(program, strips, records, histories)
    fell = np.array([row["peak"].endswith("collapse") for row in rows])
    joints = np.array([[float(row[name]) for name in ("opening", "restitution", "lever", "k")] for row in rows])
    peak = np.array([found.joints[k, 0] if fell[k] else abs(float(row["peak"])) for k, row in enumerate(rows)])
    time = np.array([float(row["time"]) for row in rows])
    own = np.array([strip.wall().opening_edp * limit for strip, limit in zip(strips, found.joints[:, 0], strict=True)])
    program_off = np.abs(np.abs(found.peak) / peak - 1.0).max(), np.abs(found.time - time).max()
    own_off = np.abs(pair.own * found.joints[:, 0] / peak - 1.0).max(), np.abs(found.time + pair.time - time).max()
    joint_off = np.abs(found.joints[:, 1:] / joints - 1.0).max(), np.abs(own / joints[:, 0] - 1.0).max()
    demand(max(*program_off, *own_off) < EXACT, "peaks and their times are those of 33 digits to 1e-9")
    demand(max(joint_off) < 1e-11 and pair.flags == 0, "joints are those of 33 digits to 1e-11, and flags are equal")
    demand((found.collapsed == fell).all(), "the program has the flags of the values")
    head = [f"{len(rows)} histories of three strips", "joints", "peaks", "times, s"]
    return table(
        head,
        [
            ["independent program", small(joint_off[0]), small(program_off[0]), small(program_off[1])],
            ["dondolo, `rtol = 1e-12`", small(joint_off[1]), small(own_off[0]), small(own_off[1])],
        ],
    )


def random_strip(rng):
    """A strip, realistic or not, whose joints do not open too late."""
    while True:
        height = rng.uniform(2.0, 5.0)
        thickness = height / rng.uniform(6.0, 25.0)
        load = 10.0 ** rng.uniform(2.0, 4.7) if rng.uniform() < 0.7 else 0.0
        strip = Strip(
            height,
            thickness,
            rng.uniform(1500.0, 2200.0),
            rng.uniform(0.4, 0.85),
            load,
            float(rng.choice([0.0, 0.5, 1.0])),
            rng.uniform(-0.3, 0.3) * thickness,
            rng.uniform(0.5, 0.99),
            10.0 ** rng.uniform(-1.7, -0.4),
            rng.uniform(0.0, 0.2),
        )
        try:
            strip.wall()
        except dd.errors.InputError:
            continue  # it bends, or its load turns it over
        return strip


def random_walls(program, number):
    """Lines on random strips under random motions."""
    rng = np.random.default_rng(SEED)
    strips, records = [], []
    for _ in range(number):
        strips.append(random_strip(rng))
        motion = rng.normal(size=rng.integers(20, 120)) * rng.uniform(0.3, 1.5) * strips[-1].wall().trigger_acceleration
        records.append((motion, float(rng.choice([0.005, 0.01, 0.02]))))
    histories = [(k, k, 1.0) for k in range(number)]
    pairs = [compare(program, strips, records, histories, solver, 6.0) for solver in (TIGHT, DEFAULT)]
    opened = sum(pair > strip.wall().opening_edp for pair, strip in zip(pairs[0].peak, strips, strict=True))
    fell = int((pairs[0].peak >= 1.0).sum())
    demand(all(pair.flags == 0 for pair in pairs), "all flags of random strips are those of the program")
    errors = [pair.error for pair in pairs]
    demand(errors[0].max() < RANDOM, "peaks of random strips are those of the program to 1e-6")
    demand(errors[1].max() < USUAL, "those at the defaults to 1e-3")
    demand(pairs[0].fast > 0, "some lose energy and never open")
    quantiles = [[*np.quantile(error, (0.5, 0.99)), error.max()] for error in errors]
    rows = [
        [name, pair.flags, *map(small, three)]
        for name, pair, three in zip(("`rtol = 1e-12`", "defaults"), pairs, quantiles, strict=True)
    ]
    text = (
        f"{number} random strips, each under a random motion of 20 to 120 samples: {opened} open, {fell} collapse, "
        f"{pairs[0].fast} lose energy in passages and never open. "
        "Relative differences of the peaks:"
    )
    return [*paragraph(text), *table(["", "flags that differ", "median", "99th percentile", "largest"], rows)]


def limits(program):
    """Largest difference at the ends of the ranges of period and damping, and how many histories."""
    strips, records, histories = [], [], []
    for row in read_table(TABLES / "bent_strips.csv"):
        if row["elastic_period"] != "0.03" or row["n"] != "2":
            continue
        longest = longest_period(strip_of(row))
        motion = wave(*(float(row[name]) for name in ("n", "period", "amplitude")))
        for period in (1e-4, 1e-3, longest):
            for damping in (0.0, 0.2):
                strips.append(replace(strip_of(row), elastic_period=period, elastic_damping=damping))
                records.append(motion)
                histories.append((len(strips) - 1, len(records) - 1, 1.0))
    pair = compare(program, strips, records, histories, after=1.0)
    demand(pair.flags == 0 and np.isfinite(pair.own).all(), "no flag differs at the ends of the ranges")
    demand(pair.error.max() < 1e-5, "peaks at the ends of the ranges are those of the program to 1e-5")
    return len(histories), pair.error.max()


def longest_period(strip):
    """The longest period that is accepted, to a millisecond."""
    low, high = 0.03, 3.0
    while high - low > 1e-3:
        middle = 0.5 * (low + high)
        try:
            replace(strip, elastic_period=middle).wall()
        except dd.errors.InputError:
            high = middle
        else:
            low = middle
    return low


def energy():
    """Largest relative error of the loss of energy of each swing of a free strip without damping, "
    "and how many swings.
    """
    strip = Strip(3.0, 0.25, 1800.0, 0.6, 5e3, 0.0, 0.0, RATIOS["docs"], 0.1, 0.0)
    wall = strip.wall()
    motion, dt = wave(1, 0.37, 6.2)
    padded = np.append(motion, np.zeros(round(6.0 / dt)))
    free = dd.simulate(wall, dd.Record(padded, dt, name="pulse"), solver=TIGHT)
    after = free.time > dt * len(motion)
    q, v = np.abs(free.rotation[after]), free.velocity[after]
    opening = wall.opening_edp * wall.capacity_angle
    at = wall.terms(opening)
    stiffness = float(at.inertia) * (2.0 * np.pi / strip.elastic_period) ** 2
    closed = q <= opening
    own = np.where(
        closed,
        0.5 * float(at.inertia) * v**2 + 0.5 * stiffness * (q**2 - opening**2),
        0.5 * wall.terms(q).inertia * v**2 + wall.potential(q) - wall.potential(opening),
    )
    # Energies above that of the opening, one for each swing
    swings = [own[0]]
    for energy in own[1:]:
        if abs(energy / swings[-1] - 1.0) > 1e-6:
            swings.append(energy)
    swings = np.array(swings)
    # Those that are far above the rounding of the first
    opened = swings[swings > 1e-3 * swings[0]]
    error = np.abs(opened[1:] / opened[:-1] / strip.restitution_value**2 - 1.0).max()
    demand(error < 1e-8, "each swing keeps the share e^2 of the energy with which the joints closed")
    return error, len(opened)


def grazing():
    """Change of the EDP over that of the factor across a grazed opening, and across a passage at its speed."""
    slopes = []
    for row in read_table(TABLES / "bent_strips.csv")[::7]:
        wall, record = strip_of(row).wall(), dd.Record(*wave(2, 0.17, 1.0), name="wave")

        def edp(factor, wall=wall, record=record):
            return dd.simulate(wall, record, factor, solver=TIGHT, history=False)

        unit = edp(1e-3).edp / 1e-3
        grazed = [wall.opening_edp / unit]
        # The least factor at which a passage loses energy
        low, high = grazed[0], 3.0 * grazed[0]
        if edp(high).impacts > 0:
            while high / low > 1.0 + 1e-13:
                middle = 0.5 * (low + high)
                low, high = (low, middle) if edp(middle).impacts > 0 else (middle, high)
            grazed.append(high)
        for factor in grazed:
            for off in (1e-6, 1e-8, 1e-10):
                change = edp(factor * (1.0 + off)).edp / edp(factor * (1.0 - off)).edp - 1.0
                slopes.append(abs(change) / (2.0 * off))
    demand(min(slopes) > 0.5 and max(slopes) < 1000.0, "EDPs are continuous where a strip grazes")
    return len(slopes), min(slopes), max(slopes)


def details(program):
    """Lines on the ends of ranges, energy and grazing."""
    number, far = limits(program)
    lost, swings = energy()
    points, least, most = grazing()
    return bullets(
        [
            f"Ends of the ranges (periods of 0.0001, 0.001 s and the longest that is accepted, "
            f"damping 0 and 20 %): {number} "
            f"histories, no flag differs, peaks by {small(far)} at most.",
            f"Energy: in {swings} free swings without damping each keeps the share e² of the energy above that of the "
            f"opening, to {small(lost)}.",
            f"Grazing: {points} motions that just reach the opening, or pass the middle at the speed "
            "from which energy is "
            f"lost, scaled by 1e-10 to 1e-6 up and down: the EDP changes {least:.1f} to {most:.0f} "
            "times as much as the scale, at "
            "every step alike, so that nothing jumps.",
        ]
    )


def recorded(program, folder):
    """Lines on strips under the recorded accelerograms, and for shorter and shorter periods."""
    records = dd.read_catalogue(motions(folder)["recorded"].catalogue)
    arrays = [(record.acceleration, record.dt) for record in records]
    rows = []
    for name, levels in (
        ("SAFEGo", 0.3 + 0.12 * np.arange(26)),
        ("SIN-01", 0.1 + 0.06 * np.arange(26)),
        ("docs", 0.1 + 0.1 * np.arange(26)),
    ):
        strip = replace(
            next(strip_of(row) for row in read_table(TABLES / "bent_strips.csv") if row["wall"] == name),
            elastic_period=0.1,
        )
        stripes, tight = (
            dd.multiple_stripe(
                strip.wall(), records, levels, solver=solver, estimate_error=solver is DEFAULT, progress=False
            )
            for solver in (DEFAULT, TIGHT)
        )
        histories = [(0, k, float(scale)) for row in stripes.scale for k, scale in enumerate(row)]
        found = program.follow([strip], arrays, histories, 10.0)
        peak = (np.abs(found.peak) / found.joints[0, 0]).reshape(stripes.edp.shape)
        fell = found.collapsed.reshape(stripes.edp.shape)
        theta = dd.fit_fragility(levels, fell.sum(axis=1), len(records), im="pga").theta
        own = stripes.fit().theta
        off = np.abs(stripes.edp - peak)
        stood = ~(fell | stripes.collapsed)
        wrong = fell != stripes.collapsed
        doubted = wrong & (stripes.edp_error > 1e-6)
        demand(abs(own / theta - 1.0) < 5e-3, "medians are those of the program to 0.5 %")
        demand((doubted == wrong).all(), "the estimated error finds flags that differ")
        demand((fell == tight.collapsed).all(), "no flag differs at a tight tolerance")
        rows.append(
            [
                name,
                f"{own:.4f}, {theta:.4f}",
                f"{wrong.sum()}, {(fell != tight.collapsed).sum()} of {fell.size}",
                small(np.median(off[stood])),
                f"{(off[stood] > 1e-6).sum()}",
            ]
        )
    head = [
        "strip, T₁ 0.10 s",
        "θ of dondolo, of the program, g",
        "flags that differ, at `rtol = 1e-12`",
        "median difference of EDPs",
        "above 1e-6",
    ]
    lines = [
        *paragraph(
            "Under the 44 recorded accelerograms at 26 levels, at the defaults of `rk45`; "
            "`estimate_error` finds what differs:"
        ),
        *table(head, rows),
    ]
    return lines + shrinking(records)


def shrinking(records):
    """Lines on shorter and shorter periods."""
    strip = next(strip_of(row) for row in read_table(TABLES / "bent_strips.csv") if row["wall"] == "docs")
    given = vars(strip) | {"elastic_period": None, "elastic_damping": None}
    levels = [0.5, 0.7, 0.9, 1.1]
    rigid = dd.multiple_stripe(dd.TwoBlockWall(**given), records, levels, solver=DEFAULT, progress=False)
    rows, medians = [], []
    for period in (0.03, 0.01, 0.003, 0.001):
        bent = dd.multiple_stripe(
            replace(strip, elastic_period=period).wall(), records, levels, solver=DEFAULT, progress=False
        )
        off = np.abs(bent.edp - rigid.edp)
        medians.append(np.median(off))
        differ = (bent.collapsed != rigid.collapsed).sum()
        rows.append([f"{period} s", differ, small(medians[-1]), f"{100.0 * np.mean(off < 0.01):.0f} %"])
    falls = np.array(medians[1:]) / medians[:-1]
    demand((falls <= [1.0 / 3.0, 0.3, 1.0 / 3.0]).all(), "differences from rigid blocks fall as the period or faster")
    number = rigid.edp.size
    text = f"Shorter and shorter periods against rigid blocks, {number} histories of the strip docs at 0.5 to 1.1 g:"
    head = ["T₁", "flags that differ", "median difference of EDPs", "within 0.01"]
    return [*paragraph(text), *table(head, rows)]


def joints(folder):
    """Lines of the section."""
    program = Program()
    about = (
        "Strips with `elastic_period`. The values are of a program with closed forms and Runge-Kutta "
        "steps in 33 digits "
        "(test/reference/bent_strips.csv), and the independent program (docs/verification/joints) "
        "shares no code, number "
        "or method with either: a Lagrangian of complex numbers, extrapolated midpoint steps in both branches. Largest "
        "relative differences from the values:"
    )
    return [
        TITLE,
        "",
        *paragraph(about),
        *values(program),
        *random_walls(program, WALLS),
        *details(program),
        *recorded(program, folder),
    ]


def main():
    """Replace the section, or compute a part of it."""
    warnings.simplefilter("ignore", dd.errors.DondoloWarning)
    if sys.argv[1] == "--quick":
        program = Program()
        print("\n".join([*values(program), *random_walls(program, FEW), *details(program)]))
        return
    before = PAGE.read_text(encoding="utf-8").split(TITLE)[0].rstrip()
    PAGE.write_text(before + "\n\n" + "\n".join(joints(sys.argv[1])).rstrip() + "\n", encoding="utf-8")


if __name__ == "__main__":
    main()
