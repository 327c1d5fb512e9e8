"""Do the intervals of fragility curves contain the truth as often as they say? Writes docs/studies/coverage.md.

With --quick only a few draws are made, and the page is out/quick/coverage.md.

A population of synthetic records of many scenarios stands for the earthquakes that there could be. The curve of all of
them is the truth; curves of a few records, drawn with replacement, are what a study gets. Histories are run once.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Callable, Iterable, Iterator
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from scipy.special import ndtr, ndtri, stdtrit

import dondolo as dd
from dondolo.curves.fitting import fit
from dondolo.curves.fragility import Fragility
from dondolo.curves.sample import Sample, cluster_labels

QUICK = "--quick" in sys.argv[1:]
FOLDER = Path(__file__).parent
PAGE = (FOLDER.parent / "out/quick" if QUICK else FOLDER / "studies") / "coverage.md"
RECORDS, SEED = 60 if QUICK else 600, 11
# Studies by their number of records: with 44, shares to a third of a per cent
DRAWS = dict.fromkeys((44, 22, 11), 10) if QUICK else {44: 4000, 22: 1000, 11: 1000}
# Of the frequencies, and of the studentized bootstrap
FREQUENCIES, RESAMPLES = (5, 50) if QUICK else (1000, 2000)
SIZES, LEVELS = tuple(DRAWS), (8,) if QUICK else (8, 12, 20)
# Of exactly lognormal capacities: records of a study, draws, of these with a goodness of fit, and its samples
EXACT_SIZES, EXACT_DRAWS, EXACT_FITS, EXACT_RESAMPLES = (22, 44, 100), *((20, 5, 49) if QUICK else (4000, 1000, 199))
# Levels by their number, and by how many dispersions they reach from the median
DESIGNS = {"12, from 5 to 95 %": (12, 1.645), "20, from 0.1 to 99.9 %": (20, 3.09)}
# Hazard curves: a power law, and one that bends down
HAZARDS = {
    "power law": dd.HazardCurve.power_law(1e-4, 2.5),
    "bent": dd.HazardCurve(
        [0.01, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0], [0.5, 0.05, 0.015, 4e-3, 5e-4, 8e-5, 1e-5, 2e-7]
    ),
}
WALLS = {"one_sided": dd.OneSidedWall(1.5, 0.25), "two_block": dd.TwoBlockWall(3.0, 0.25, hinge=0.5)}
CONFIDENCE = 0.95
# Of the comparison of chosen levels with equally spaced ones
STRIPES = (4,) if QUICK else (4, 6, 8, 12)
CHOSEN_WALLS = {
    "one_sided": dd.OneSidedWall(1.5, 0.25),
    "free_standing": dd.FreeStandingWall(2.0, 0.4),
    "two_block": dd.TwoBlockWall(3.0, 0.25, hinge=0.5),
}

Flags = np.ndarray[Any, np.dtype[np.bool_]]


class Outcomes(NamedTuple):
    """Which histories of a population of records collapse (levels, polarities, records)."""

    levels: np.ndarray[Any, np.dtype[np.float64]]
    collapsed: Flags

    def curve(self, records: np.ndarray[Any, Any], polarity: np.ndarray[Any, Any] | slice = slice(None)) -> Fragility:
        """Curve of some records, as Stripes.fit makes it; with a polarity of each, or all polarities."""
        several = isinstance(polarity, slice)
        drawn = (
            self.collapsed[:, polarity, :][:, :, records] if several else self.collapsed[:, polarity, records][:, None]
        )
        flags = drawn.reshape(len(self.levels), -1)
        # Each draw is a record of its own, even of the same record twice.
        labels = cluster_labels(len(records))
        index = np.tile(np.arange(len(records)), drawn.shape[1])
        sample = Sample(
            levels=self.levels,
            collapsed=flags,
            ran=np.ones_like(flags),
            record_index=index,
            record_names=labels,
            clusters=labels,
        )
        counts = flags.sum(axis=1).astype(float)
        return fit(self.levels, counts, np.full(len(self.levels), float(flags.shape[1])), sample=sample)


def population(count: int, seed: int) -> list[dd.Record]:
    """Synthetic records, each of a scenario of its own."""
    rng = np.random.default_rng(seed)
    records = []
    for i in range(count):
        scenario = rng.uniform(5.2, 6.9), rng.uniform(4.0, 40.0), str(rng.choice(["rock", "shallow", "deep"]))
        deviations = float(np.clip(rng.normal(), -2.0, 2.0))
        records += dd.synthetic_records(*scenario, n_records=1, seed=1000 + i, deviations=deviations)
    return records


def outcomes(wall: dd.Wall, records: list[dd.Record], number: int) -> Outcomes:
    """Histories of all records at some levels, from 5 to 95 % of collapses."""
    pilot = dd.multiple_stripe(wall, records, np.linspace(0.2, 2.5, 12), polarity="both", progress=False).fit()
    levels = pilot.theta * np.exp(pilot.beta * np.linspace(-1.645, 1.645, number))
    stripes = dd.multiple_stripe(wall, records, levels, polarity="both", progress=False)
    return Outcomes(levels, stripes.collapsed.reshape(number, -1, len(records)))


def draws(count: int, size: int, n: int, rng: np.random.Generator) -> Iterator[np.ndarray[Any, Any]]:
    """Records of each of n studies."""
    return iter(rng.integers(count, size=(n, size)))


def intervals(curve: Fragility) -> dict[str, dict[str, tuple[float, float]]]:
    """Intervals of a curve by its own covariance and by others."""
    size = curve.clusters
    upper = 0.5 + 0.5 * CONFIDENCE
    normal, student = float(ndtri(upper)), float(stdtrit(size - 1, upper))
    # Where all clusters have the same histories, corrections are factors.
    share = (size - 1) / size
    others = {
        "naive": (curve.naive_covariance, normal),
        "CR0, normal": (curve.covariance * share**2, normal),
        "CR1 = CR2, t": (curve.covariance * share, student),
    }
    found = {}
    for name, (covariance, quantile) in others.items():
        errors = quantile * np.sqrt(np.diag(covariance)) / [1.0, curve.beta]
        middle = (("theta", curve.theta), ("beta", curve.beta))
        found[name] = {
            what: (value * np.exp(-error), value * np.exp(error))
            for (what, value), error in zip(middle, errors, strict=True)
        }
    return found | {"CR3, t (dondolo)": curve.parameter_interval()}


def coverage(of: Outcomes, polarity: slice, size: int, n: int, seed: int) -> tuple[dict[str, dict[str, float]], float]:
    """Share of the intervals that contain the population's parameters; and of the draws without standard errors."""
    rng, count = np.random.default_rng(seed), of.collapsed.shape[2]
    truth = of.curve(np.arange(count), polarity)
    inside: dict[str, dict[str, list[bool]]] = {}
    without = 0
    for records in draws(count, size, n, rng):
        curve = of.curve(records, polarity)
        if not curve.has_fit or curve.errors != "clustered":
            without += 1
            continue
        for method, ends in intervals(curve).items():
            for what, (low, high) in ends.items():
                inside.setdefault(method, {}).setdefault(what, []).append(low <= getattr(truth, what) <= high)
    shares = {method: {what: float(np.mean(hits)) for what, hits in one.items()} for method, one in inside.items()}
    return shares, without / n


def rejections(
    pair: Callable[[np.random.Generator], tuple[Fragility, Fragility]], n: int, seed: int
) -> dict[str, float]:
    """Share of the tests of equality that reject, of pairs of curves whose populations are equal."""
    rng = np.random.default_rng(seed)
    level = 1.0 - CONFIDENCE
    found = []
    for _ in range(n):
        one, other = pair(rng)
        if not all(curve.has_fit and curve.errors == "clustered" for curve in (one, other)):
            continue
        clustered = one.compare(other)
        naive = np.log(one.theta / other.theta) / np.sqrt(one.naive_covariance[0, 0] + other.naive_covariance[0, 0])
        p_values = (clustered.p_value, clustered.beta_p_value, clustered.curves_p_value)
        found.append([*(p < level for p in p_values), 2.0 * ndtr(-abs(naive)) < level])
    return dict(zip(("theta", "beta", "both", "naive theta"), np.mean(found, axis=0).tolist(), strict=True))


def same_records(of: Outcomes, size: int) -> Callable[[np.random.Generator], tuple[Fragility, Fragility]]:
    """Curves of the same records: one with a polarity of each at random, the other with the other polarity."""

    def pair(rng: np.random.Generator) -> tuple[Fragility, Fragility]:
        records, turned = rng.integers(of.collapsed.shape[2], size=size), rng.integers(2, size=size)
        return of.curve(records, turned), of.curve(records, 1 - turned)

    return pair


def other_records(of: Outcomes, size: int) -> Callable[[np.random.Generator], tuple[Fragility, Fragility]]:
    """Curves of one wall on two draws of records."""

    def pair(rng: np.random.Generator) -> tuple[Fragility, Fragility]:
        one, other = (of.curve(rng.integers(of.collapsed.shape[2], size=size)) for _ in range(2))
        labels = cluster_labels(2 * size)[size:]
        assert other.sample is not None
        sample = Sample(**(vars(other.sample) | {"clusters": labels}))
        return one, fit(other.levels, other.collapses, other.histories, sample=sample)

    return pair


def frequencies(of: Outcomes, polarity: slice, size: int, n: int, seed: int) -> dict[str, float]:
    """Share of the intervals that contain the annual frequency of the population, by hazard."""
    rng, count = np.random.default_rng(seed), of.collapsed.shape[2]
    whole = of.curve(np.arange(count), polarity)
    truth = {name: whole.risk(hazard).annual_frequency for name, hazard in HAZARDS.items()}
    inside: dict[str, list[bool]] = {name: [] for name in HAZARDS}
    for records in draws(count, size, n, rng):
        curve = of.curve(records, polarity)
        if not curve.has_fit or curve.errors != "clustered":
            continue
        for name, hazard in HAZARDS.items():
            low, high = curve.risk(hazard).uncertainty(n_draws=2000, rng=rng).interval()
            inside[name].append(low <= truth[name] <= high)
    return {name: float(np.mean(hits)) for name, hits in inside.items()}


def exactly_lognormal() -> list[str]:
    """Intervals and goodness of fit where the model is true: each record is one capacity, lognormal."""
    rows = []
    for design, (number, reach) in DESIGNS.items():
        levels = np.exp(0.4 * np.linspace(-reach, reach, number))
        for size in EXACT_SIZES:
            rng = np.random.default_rng([SEED, number, size])
            inside, rejected = [], []
            for draw in range(EXACT_DRAWS):
                capacities = np.exp(0.4 * rng.standard_normal(size))
                of = Outcomes(levels, (capacities <= levels[:, None])[:, None, :])
                curve = of.curve(np.arange(size))
                if not curve.has_fit or curve.errors != "clustered":
                    continue
                found = curve.parameter_interval(confidence=CONFIDENCE)
                inside.append(
                    [found[name][0] <= true <= found[name][1] for name, true in (("theta", 1.0), ("beta", 0.4))]
                )
                if draw < EXACT_FITS:
                    fitted = curve.goodness_of_fit(n_resamples=EXACT_RESAMPLES, rng=rng)
                    rejected.append(fitted.p_value <= 1.0 - CONFIDENCE)
            theta, beta = np.mean(inside, axis=0)
            cells = (theta, beta, float(np.mean(rejected)))
            rows.append([design, str(size), *(f"{100.0 * share:.1f}" for share in cells)])
            print(rows[-1], flush=True)
    head = ["levels", "records", "θ", "β", "p ≤ 0.05"]
    return [EXACT.format(draws=EXACT_DRAWS, fits=EXACT_FITS), table(head, rows)]


def recorded() -> list[str]:
    """Intervals on recorded accelerograms against the bootstrap over events, where the records are at hand."""
    folder = os.environ.get("DONDOLO_RECORDS")
    if not folder:
        return []
    records = dd.read_catalogue(Path(folder) / "italy44.csv")
    levels = np.linspace(0.05, 1.0, 20)
    rows = []
    for wall in (dd.OneSidedWall(3.0, 0.25), dd.TwoBlockWall(3.0, 0.25, hinge=0.6, restitution_factor=0.87)):
        stripes = dd.multiple_stripe(wall, records, levels, progress=False)
        for what, events in (("recordings", [i // 2 for i in range(44)]), ("earthquakes", stripes.events)):
            rows += recorded_rows(wall.mechanism, what, stripes.fit(events=events))
    head = ["wall", "clusters", "by", "θ, g", "β", "width in ln θ"]
    return ["## On recorded accelerograms\n", RECORDED, table(head, rows)]


def recorded_rows(mechanism: str, what: str, curve: Fragility) -> list[list[str]]:
    """Rows of the clustered interval, and of the bootstrap's with and without its own standard errors."""
    ends = {
        "clustered": curve.parameter_interval(),
        "bootstrap, studentized": studentized(curve, RESAMPLES, SEED),
        "bootstrap, percentiles": curve.bootstrap(n_resamples=10_000).parameter_interval(),
    }
    widths = [float(np.log(one["theta"][1] / one["theta"][0])) for one in ends.values()]
    rows = []
    for (name, one), width in zip(ends.items(), widths, strict=True):
        cells = [f"{one[letter][0]:.4f} to {one[letter][1]:.4f}" for letter in ("theta", "beta")]
        rows.append([mechanism, f"{curve.clusters} {what}", name, *cells, f"{width:.3f}"])
    return rows


def studentized(curve: Fragility, n: int, seed: int) -> dict[str, tuple[float, float]]:
    """Intervals by the bootstrap of each change over its own standard error (bootstrap-t), clusters drawn."""
    sample, rng = curve.sample, np.random.default_rng(seed)
    assert sample is not None
    cluster = np.unique(sample.clusters, return_inverse=True)[1][sample.record_index]
    histories = [np.flatnonzero(cluster == g) for g in range(curve.clusters)]
    ratios = []
    for drawn in rng.integers(curve.clusters, size=(n, curve.clusters)):
        columns = np.concatenate([histories[g] for g in drawn])
        # Each draw is a cluster of its own, even of the same cluster twice.
        labels = tuple(f"draw {i}" for i, g in enumerate(drawn) for _ in histories[g])
        collapsed, ran = sample.collapsed[:, columns], sample.ran[:, columns]
        again = Sample(
            levels=sample.levels,
            collapsed=collapsed,
            ran=ran,
            record_index=np.arange(len(columns)),
            record_names=labels,
            clusters=labels,
        )
        counts = ((collapsed & ran).sum(axis=1).astype(float), ran.sum(axis=1).astype(float))
        other = fit(sample.levels, *counts, sample=again)
        if other.has_fit and other.errors == "clustered":
            ratios.append(
                (
                    np.log(other.theta / curve.theta) / other.se_ln_theta,
                    (1.0 / other.beta - 1.0 / curve.beta) / (other.se_beta / other.beta**2),
                )
            )
    (above, below), (steeper, flatter) = np.quantile(ratios, [0.5 + 0.5 * CONFIDENCE, 0.5 - 0.5 * CONFIDENCE], axis=0).T
    slopes = 1.0 / curve.beta - np.array([flatter, steeper]) * curve.se_beta / curve.beta**2
    low, high = curve.theta * np.exp(-np.array([above, below]) * curve.se_ln_theta)
    return {"theta": (float(low), float(high)), "beta": (float(1.0 / slopes[0]), float(1.0 / slopes[1]))}


def chosen() -> list[str]:
    """Widths of intervals with chosen levels and with equally spaced ones, on the embedded records."""
    records = dd.read_catalogue(Path(__file__).parents[1] / "data/records/synthetic44.csv")
    rows, every = [], []
    for wall in CHOSEN_WALLS.values():
        dense = dd.multiple_stripe(wall, records, np.geomspace(0.1, 4.0, 50), progress=False).fit()
        for number in STRIPES:
            known = np.linspace(2.0 * dense.theta / number, 2.0 * dense.theta, number)
            best = dense.theta * np.exp(dense.beta * np.linspace(-1.645, 1.645, number))
            curves = [dd.adaptive_stripes(wall, records, budget=44 * number, progress=False).fit()]
            curves += [dd.multiple_stripe(wall, records, levels, progress=False).fit() for levels in (known, best)]
            every.append((number, [widths(curve) for curve in (*curves, dense)]))
    for number in STRIPES:
        means = np.mean([found for own, found in every if own == number], axis=0)
        rows.append([str(number), *map(in_words, means)])
    head = ["stripes", "chosen", "equally spaced to 2 θ", "equally spaced in ln", "50 stripes"]
    return ["## Adaptive levels\n", CHOSEN, table(head, rows)]


def widths(curve: Fragility) -> list[float]:
    """Widths of the intervals of theta and beta, in logarithms."""
    ends = curve.parameter_interval()
    return [float(np.log(high / low)) for low, high in (ends["theta"], ends["beta"])]


def in_words(values: Iterable[float]) -> str:
    """Two widths."""
    return " / ".join(f"{value:.2f}" for value in values)


def table(head: list[str], rows: list[list[str]]) -> str:
    """A table in Markdown."""
    lines = [head, ["---"] * len(head), *rows]
    return "\n".join(f"| {' | '.join(line)} |" for line in lines) + "\n"


class Row(NamedTuple):
    """Shares of the studies of one wall with a number of records, and of levels; of theta and beta in pairs."""

    wall: str
    kind: str
    records: int
    shares: tuple[tuple[float, ...], ...]


def over_levels(rows: list[Row], worst: Callable[[Iterable[float]], float]) -> list[list[str]]:
    """Rows of a table, most records first: of each share the worst over the numbers of levels, in %."""
    found: dict[tuple[str, str, int], list[Any]] = {}
    for row in sorted(rows, key=lambda row: -row.records):
        found.setdefault(row[:3], []).append(row.shares)
    lines = []
    for (wall, kind, records), several in found.items():
        cells = [[worst(values) for values in zip(*pairs, strict=True)] for pairs in zip(*several, strict=True)]
        lines.append([wall, kind, str(records), *(" / ".join(f"{100 * x:.1f}" for x in cell) for cell in cells)])
    return lines


def main() -> None:
    """Run the experiment and write the page."""
    records = population(RECORDS, seed=7)
    rows: list[Row] = []
    tests: list[Row] = []
    risks: list[Row] = []
    methods: list[str] = []
    excluded = 0.0
    for name, wall in WALLS.items():
        for number in LEVELS:
            of = outcomes(wall, records, number)
            both = of.collapsed.shape[1] == 2
            polarities = {"as_recorded": slice(0, 1), **({"both": slice(None)} if both else {})}
            for size in SIZES:
                for polarity, part in polarities.items():
                    shares, without = coverage(of, part, size, DRAWS[size], SEED + len(rows))
                    methods = list(shares)
                    rows.append(Row(name, polarity, size, tuple(tuple(one.values()) for one in shares.values())))
                    excluded = max(excluded, without)
                    print(number, rows[-1], flush=True)
                    if number == LEVELS[0]:
                        contained = frequencies(of, part, size, FREQUENCIES, SEED + len(risks)).values()
                        risks.append(Row(name, polarity, size, tuple((share,) for share in contained)))
                        print(number, risks[-1], flush=True)
                pairs = {
                    "other records": other_records(of, size),
                    **({"same records": same_records(of, size)} if both else {}),
                }
                for pairing, pair in pairs.items():
                    found = rejections(pair, DRAWS[size], SEED + len(tests))
                    tests.append(Row(name, pairing, size, tuple((share,) for share in found.values())))
                    print(number, tests[-1], flush=True)
    write_page(rows, tests, risks, methods, excluded)


def write_page(rows: list[Row], tests: list[Row], risks: list[Row], methods: list[str], excluded: float) -> None:
    """Write the page with the rows of the tables."""
    head = ["wall", "polarity", "records"]
    levels = ", ".join(map(str, LEVELS))
    parts = [
        TEXT,
        f"## Coverage\n\n{RECORDS} records, {DRAWS[44]} draws of 44 and {DRAWS[22]} of fewer in each row. Share of the"
        " 95 % intervals of θ / β that contain the value of the population, in %: the least of studies with"
        f" {levels} levels. The standard error of a share is 0.35 and 0.7. At most {100 * excluded:.1f} % of the draws"
        " have no fit or standard errors, and are left out.\n",
        table([*head, *methods], over_levels(rows, min)),
        "## Tests of equality\n\nShare of the comparisons (`Curve.compare`) that reject equal curves at 5 %,"
        " in %, in as many draws: the largest of the same studies. On the same records one curve takes a random"
        " polarity of each record, and the other the other.\n",
        table(["wall", "curves on", "records", "θ", "β", "both", "θ, naive"], over_levels(tests, max)),
        f"## Annual frequencies\n\n{FREQUENCIES} draws of {LEVELS[0]} levels in each row. Share of the 95 % intervals"
        " of `risk.uncertainty()` that contain the annual frequency of the population, in %, under a hazard curve that"
        " is a power law, x^-2.5, and under one that bends down; the standard error of a share is 0.7.\n",
        table([*head, *HAZARDS], over_levels(risks, min)),
        *exactly_lognormal(),
        *recorded(),
        *chosen(),
    ]
    PAGE.parent.mkdir(parents=True, exist_ok=True)
    PAGE.write_text("\n".join(parts), encoding="utf-8")


EXACT = """## Exactly lognormal capacities

Each record is one history, whose capacity is lognormal with β = 0.4, so that the model is true. Share of the 95 %
intervals that contain θ and β, in %, in {draws} draws, and share of the draws of which the goodness of fit has
p ≤ 0.05, in the first {fits}. The standard error of a share of β is 0.4, that of the last column 0.7. **Intervals of
β are somewhat too narrow where levels reach far into the tails**: few records decide β there, and the standard error
is small where β comes out too small.
"""

RECORDED = """44 horizontal components recorded in Italy, 20 levels from 0.05 to 1.00 g, clustered by recording (both
components together) and by earthquake; the bootstrap draws the same clusters. Studentized, each draw is
divided by its own clustered standard error (bootstrap-t, Efron 1981). Percentile intervals are too narrow
with few clusters.
"""

CHOSEN = """Widths of the 95 % intervals in ln θ / in ln β under the 44 embedded records, means of three walls: with
levels chosen one after the other; with as many equally spaced up to 2 θ; with as many from the 5th to
the 95th percentile of the curve, which is unknown beforehand; and with 50 levels from 0.1 to 4 g. With
one draw of records, differences of a tenth are chance. The records limit the precision: fifty stripes
add little to twelve.
"""

TEXT = """# Coverage of intervals

`./run intervals` writes this page. [The intervals](../reading_a_curve.md#the-intervals) explains what they are. The
first table decided the estimator: with few records intervals with CR0 and the normal quantile are too narrow for β.
"""


if __name__ == "__main__":
    main()
